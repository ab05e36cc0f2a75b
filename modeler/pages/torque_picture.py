"""Torque and residual before and after an effect, where the model without it is worst."""

import numpy as np

from modeler.compare.time_picture import broken
from modeler.compare.where import WINDOW
from modeler.core.by_unit import WORDS
from modeler.pages.shown import Shown
from modeler.pictures.picture import (
    BLACK,
    COLOR_NAMES,
    GREEN,
    SHADE,
    VERMILLION,
    Curve,
    Panel,
    Picture,
    Style,
)

MEASURED = Style(BLACK, width=1.2)
BEFORE = Style(VERMILLION, width=1.6, dash=True)
AFTER = Style(GREEN, width=1.6)
LEFT = Style(VERMILLION, width=1.2, dash=True)
STAYS = Style(GREEN, width=1.2)
_BESIDE = 1.5  # s on either side that are drawn too


def torque_picture(item: Shown) -> Picture:
    """Measured, model without and with the effect; below, what either leaves."""
    rows = item.without.rows
    joint = item.without.data.compiled.spec.joints[item.j]
    log, start, end = worst_stretch(item)
    time, pieces = rows.time[item.j], _pieces(item)
    near = (rows.run[item.j] == log) & (time >= start - _BESIDE) & (time <= end + _BESIDE)
    measured, what = rows.y[item.j], WORDS[joint.effort_unit]

    def curve(label: str, y: np.ndarray, style: Style) -> Curve:
        return Curve(label, *broken(pieces[near], time[near], y[near]), style)

    name = item.without.data.observation.logs[log]
    x_label, pick = f"time in {name} [s]", item.step.pick
    above = Panel(
        "Torque" if what == "torque" else "Force", x_label, f"{what} [{joint.effort_unit}]",
        (curve("measured", measured, MEASURED),
         curve("model before", measured - item.before, BEFORE),
         curve("model after", measured - item.after, AFTER)),
        shade=(start, end),
    )  # fmt: skip
    below = Panel(
        "Residual", x_label, f"residual [{joint.effort_unit}]",
        (curve("residual before", item.before, LEFT), curve("residual after", item.after, STAYS)),
        shade=(start, end), zero=True,
    )  # fmt: skip
    return Picture(
        name=f"torque_{pick.effect.id}_{pick.joint or 'robot'}",
        title=f"Joint {joint.name} where it is worst: before and after",
        caption=_caption(item, what, (start, end), name),
        panels=((above,), (below,)),
        heights=(0.58, 0.42),
        widths=(1.0,),
        height=430,
        shared_time=True,
    )


def worst_stretch(item: Shown) -> tuple[int, float, float]:
    """Index of the log, start and end in s of the half second where the model is worst.

    By its squared residual without the effect, on the joint where the effect is seen.
    """
    rows, j = item.without.rows, item.j
    time, run, square = rows.time[j], rows.run[j], np.where(item.calm, item.before, 0.0) ** 2
    best = (-1.0, 0, 0.0, 0.0)
    for log in np.unique(run):
        own = run == log
        t, energy = time[own], np.concatenate([[0.0], np.cumsum(square[own])])
        stop = np.searchsorted(t, t + WINDOW, side="right")
        inside = energy[stop] - energy[:-1]
        k = int(np.argmax(inside))
        if inside[k] > best[0]:
            best = (float(inside[k]), int(log), float(t[k]), float(t[stop[k] - 1]))
    return best[1], best[2], best[3]


def _pieces(item: Shown) -> np.ndarray:
    """(rows_j,) number of the piece of each row: no line is drawn over rows that do not count."""
    time, segment = item.without.rows.time[item.j], item.without.rows.segment[item.j]
    steps = np.diff(time)
    inside = steps[np.diff(segment) == 0]
    longest = 1.5 * float(np.median(inside)) if inside.size else np.inf
    return np.concatenate([[0], np.cumsum((np.diff(segment) != 0) | (steps > longest))])


def _caption(item: Shown, what: str, window: tuple[float, float], log: str) -> str:
    rows, j = item.without.rows, item.j
    time = rows.time[j]
    number = item.without.data.observation.logs.index(log)
    inside = (rows.run[j] == number) & (time >= window[0]) & (time <= window[1])
    before, after = (float(np.sqrt(np.mean(e[inside] ** 2))) for e in (item.before, item.after))
    return (
        f"Above, {MEASURED.named}: measured {what}; {BEFORE.named}: the model without the effect, "
        f"fitted to the same rows; {AFTER.named}: with it. Below, what they leave: "
        f"{LEFT.named} before, {STAYS.named} after. Shaded {COLOR_NAMES[SHADE]}: the {WINDOW} s "
        f"with the largest squared residual before, {window[0]:.2f} to {window[1]:.2f} s; the rms "
        f"residual there falls from {before:.3g} to {after:.3g} {item.unit}. Filtered rows of the "
        "logs that are explained; rows that do not count are left out."
    )
