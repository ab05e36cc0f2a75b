"""The page of a model's history: the error after every effect that was added."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeler.diagnose.sentences import percent
from modeler.fit import Addition
from modeler.pages.sheet import Code, Figure, Items, Origin, Section, Sheet, write_page
from modeler.pictures.picture import BLUE, ORANGE, Bars, Panel, Picture, Style


def write_additions(
    path: Path,
    robot: str,
    history: Sequence[Addition],
    left_out: Sequence[str] = (),
    origin: Origin | None = None,
    following: Sequence[str] = (),
) -> Path:
    """Write the page of a model's history: the error after every effect that was added.

    Args:
        path: an `.html` file, or a folder, which then gets `improved.html`.
        robot: name.
        history: of the model.
        left_out: effects that were not added, and why.
        origin: model, logs, and whether some were held out.
        following: commands to go on with.

    Raises:
        ModelerError: the place cannot be written.
    """
    held, last = history[-1].held_out, history[-1].error
    fact = f"judged on {', '.join(held)}" if held else "training only: nothing was held out"
    sections = [Section("The error falls", [Figure(waterfall_picture(history))])]
    if left_out:
        sections.append(Section("Left out", [Items([("", line) for line in left_out])]))
    sections.append(
        Section("To do this again, in this order", [Code(_again(step)) for step in history[1:]])
    )
    sheet = Sheet(
        title=f"{robot}: effects added",
        headline=(percent(last), f"error left of {percent(history[0].error)}"),
        sections=sections,
        origin=origin or Origin(robot, held, bool(held)),
        facts=[("Effects", ", ".join(s.effect for s in history[1:])), ("Data", fact)],
        next=following,
        command="add",
    )
    return write_page(path, sheet, "improved.html")


def _again(step: Addition) -> str:
    joint = f" --joint {step.joint}" if step.joint else ""
    return f"modeler add MODEL {step.effect}{joint} LOG... --out MODEL"


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
