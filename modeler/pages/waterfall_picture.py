"""The error after every effect that was added, over all joints and joint by joint."""

from collections.abc import Mapping, Sequence

import numpy as np

from modeler.core.by_unit import WORDS
from modeler.fit import Addition
from modeler.pictures.picture import BLUE, GREEN, ORANGE, SKY, Bars, Panel, Picture, Style
from modeler.scoring.score import DIGITS

HELD, FITTED = Style(BLUE), Style(ORANGE)
SAME, CHANGED = Style(SKY), Style(GREEN)
_ACROSS = 3  # panels side by side


def step_name(step: Addition) -> str:
    """What a step is called: "as fitted", "+ spring @2"."""
    if not step.effect:
        return "as fitted"
    return f"+ {step.effect}" + (f" @{step.joint}" if step.joint else "")


def _broken(step: Addition) -> str:
    """Its name on several lines, so that bars may be narrow."""
    return step_name(step).replace("_", "\n").replace(" @", "\n@")


def waterfall_picture(history: Sequence[Addition]) -> Picture:
    """Error over the joints after every effect, on held-out and on fitted logs."""
    names = tuple(_broken(step) for step in history)
    held = np.array([100.0 * s.error for s in history])
    fitted = np.array([100.0 * s.training_error for s in history])
    apart = bool(history[-1].held_out)
    first = "held-out logs" if apart else "parts of the fitted logs, left out in turn"
    panels = (
        Panel(f"On {first}", "", "error [%]", (_bars("judged", names, held, HELD),)),
        Panel("On the fitted logs", "", "error [%]", (_bars("fitted", names, fitted, FITTED),)),
    )
    several = len(history[-1].joints) > 1
    return Picture(
        name="waterfall",
        title="Error after every effect",
        caption=(
            f"{HELD.named.capitalize()}: the error that counts, on {first}; {FITTED.named}: on the "
            "logs that were fitted. Each joint's error is in parts of its own rms torque or force"
            + (", and the bar is their root mean square: N m and N are not added. " if several
               else ". ")
            + "`modeler add MODEL undo LOG... --out MODEL` takes the last effect back."
        ),
        panels=(panels,),
        heights=(1.0,),
        widths=(0.5, 0.5),
        height=380,
    )  # fmt: skip


def joints_picture(history: Sequence[Addition], units: Mapping[str, str]) -> Picture:
    """The same for every joint by itself.

    Args:
        history: of a model.
        units: of the efforts, by joint.
    """
    panels = [_joint(history, name, units[name]) for name in history[-1].joints]
    panels += [Panel("", "", "", ())] * (-len(panels) % min(_ACROSS, len(panels)))
    across = min(_ACROSS, len(panels))
    rows = tuple(tuple(panels[k : k + across]) for k in range(0, len(panels), across))
    said = (
        f"{SAME.named.capitalize()}: the error of each joint on motion that was not fitted, in "
        "parts of its own rms torque or force, before any effect and after each"
    )
    if any(set(step.changed) & set(history[-1].joints) for step in history):
        said += f"; {CHANGED.named}: where it changes beyond chance"
    return Picture(
        name="waterfall_joints",
        title="Error of every joint after every effect",
        caption=f"{said}.",
        panels=rows,
        heights=tuple(1.0 / len(rows) for _ in rows),
        widths=tuple(1.0 / across for _ in range(across)),
        height=270 * len(rows) + 40,
    )


def _joint(history: Sequence[Addition], name: str, unit: str) -> Panel:
    """Bars of one joint, those that change by chance only and the others."""
    steps = [step for step in history if name in step.joints]
    names = tuple(_broken(step) for step in steps)
    errors = np.array([100.0 * step.joints[name][1] for step in steps])
    surely = np.array([name in step.changed for step in steps])
    series = [
        _bars(label, names, np.where(own, errors, np.nan), style)
        for label, style, own in (("as likely chance", SAME, ~surely), ("changes", CHANGED, surely))
        if own.any()
    ]
    return Panel(f"Joint {name}", "", f"error [% of {WORDS[unit]}]", tuple(series))


def _bars(label: str, names: tuple[str, ...], errors: np.ndarray, style: Style) -> Bars:
    return Bars(
        label, names, errors, tuple("" if np.isnan(e) else f"{e:.{DIGITS}g}" for e in errors), style
    )
