"""The page of a model's history: the error after every effect that was added."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeler.compare.picture import BLUE, ORANGE, Bars, Panel, Picture, Style
from modeler.compare.report import figure_html
from modeler.core.files import write_atomically
from modeler.diagnose.sentences import percent
from modeler.fit import Addition
from modeler.pages.sheet import page, section


def write_additions(
    path: Path, robot: str, history: Sequence[Addition], left_out: Sequence[str] = ()
) -> Path:
    """Write the page of a model's history: the error after every effect that was added.

    Args:
        path: of an .html file.
        robot: name.
        history: of the model.
        left_out: effects that were not added, and why.

    Raises:
        ModelerError: the place cannot be written.
    """
    first, last = history[0].error, history[-1].error
    held = history[-1].held_out
    fact = f"judged on {', '.join(held)}" if held else "training only: nothing was held out"
    lines = [
        f"modeler add MODEL {s.effect}{f' --joint {s.joint}' if s.joint else ''} LOG... --out MODEL"
        for s in history[1:]
    ]
    text = page(
        title=f"{robot}: effects added",
        headline=(percent(last), f"error left of {percent(first)}"),
        facts=[("Effects", ", ".join(s.effect for s in history[1:])), ("Data", fact)],
        sections=section("The error falls", figure_html(waterfall_picture(history))),
        provenance=["To do this again, in this order:", *lines, *left_out],
    )
    write_atomically(Path(path), text)
    return Path(path)


def waterfall_picture(history: Sequence[Addition]) -> Picture:
    """Held-out and training error after every effect."""
    names = tuple(
        (f"+ {s.effect}" + (f" @{s.joint}" if s.joint else "")) if s.effect else "as fitted"
        for s in history
    )
    held = np.array([100.0 * s.error for s in history])
    fitted = np.array([100.0 * s.training_error for s in history])
    label = "error on held-out logs [%]" if history[-1].held_out else "error on fitted logs [%]"
    panels = (
        Panel("held out", "", label,
              (Bars("held out", names, held, tuple(f"{e:.2f}" for e in held), Style(BLUE)),)),
        Panel("fitted", "", "error on fitted logs [%]",
              (Bars("fitted", names, fitted, tuple(f"{e:.2f}" for e in fitted), Style(ORANGE)),)),
    )  # fmt: skip
    return Picture(
        name="waterfall",
        title="Error after every effect",
        caption="Relative error, root mean square over the joints. Left the error that counts: "
        "motion that was never fitted. `modeler add MODEL undo LOG... --out MODEL` takes the last "
        "one back.",
        panels=(panels,),
        heights=(1.0,),
        widths=(0.5, 0.5),
        height=380,
    )
