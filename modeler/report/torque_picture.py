"""Torque and residual before and after an effect, where the model without it is worst."""

import itertools
from dataclasses import replace

import numpy as np

from modeler.core.figure import Curve, Panel, Picture
from modeler.core.style import BLACK, COLOR_NAMES, COLORS, GREEN, SHADE, VERMILLION, Style
from modeler.core.table import WORDS
from modeler.diagnosis import AFTER, MARGIN, State, Window, load_turns
from modeler.report.effect_evidence import Evidence
from modeler.report.evidence import MEANS, ROWS, scatter
from modeler.validation import WINDOW, broken

MEASURED = Style(BLACK, width=1.2)
BEFORE = Style(VERMILLION, width=1.6, dash=True)
AFTER_STYLE = Style(GREEN, width=1.6)
LEFT = Style(VERMILLION, width=1.2, dash=True)
STAYS = Style(GREEN, width=1.2)
_DRAWN_BESIDE = 1.5  # s on either side that are drawn too


def torque_picture(item: Evidence) -> Picture:
    """Measured, model without and with the effect; below, what either leaves."""
    rows = item.without.rows
    joint = item.without.data.compiled.spec.joints[item.j]
    log, start, end = worst_stretch(item)
    time, pieces = rows.time[item.j], _pieces(item)
    near = (
        (rows.run[item.j] == log) & (time >= start - _DRAWN_BESIDE) & (time <= end + _DRAWN_BESIDE)
    )
    measured, what = rows.y[item.j], WORDS[joint.effort_unit]

    def curve(label: str, y: np.ndarray, style: Style) -> Curve:
        return Curve(label, *broken(pieces[near], time[near], y[near]), style)

    name = item.without.data.observation.logs[log]
    x_label, pick = f"time in {name} [s]", item.step.pick
    above = Panel(
        "Torque" if what == "torque" else "Force", x_label, f"{what} [{joint.effort_unit}]",
        (curve("measured", measured, MEASURED),
         curve("model before", measured - item.before, BEFORE),
         curve("model after", measured - item.after, AFTER_STYLE)),
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
        height=430,
        shared_time=True,
    )


def worst_stretch(item: Evidence) -> tuple[int, float, float]:
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


def _pieces(item: Evidence) -> np.ndarray:
    """(rows_j,) number of the piece of each row: no line is drawn over rows that do not count."""
    time, segment = item.without.rows.time[item.j], item.without.rows.segment[item.j]
    steps = np.diff(time)
    inside = steps[np.diff(segment) == 0]
    longest = 1.5 * float(np.median(inside)) if inside.size else np.inf
    return np.concatenate([[0], np.cumsum((np.diff(segment) != 0) | (steps > longest))])


def _caption(item: Evidence, what: str, window: tuple[float, float], log: str) -> str:
    rows, j = item.without.rows, item.j
    time = rows.time[j]
    number = item.without.data.observation.logs.index(log)
    inside = (rows.run[j] == number) & (time >= window[0]) & (time <= window[1])
    before, after = (float(np.sqrt(np.mean(e[inside] ** 2))) for e in (item.before, item.after))
    return (
        f"Above, {MEASURED.named}: measured {what}; {BEFORE.named}: the model without the effect, "
        f"fitted to the same rows; {AFTER_STYLE.named}: with it. Below, what they leave: "
        f"{LEFT.named} before, {STAYS.named} after. Shaded {COLOR_NAMES[SHADE]}: the {WINDOW} s "
        f"with the largest squared residual before, {window[0]:.2f} to {window[1]:.2f} s; the rms "
        f"residual there falls from {before:.3g} to {after:.3g} {item.unit}. Filtered rows of the "
        "logs that are explained; rows that do not count are left out."
    )


# Pictures of what is no column: knocks of play around the moments they follow, a push in time.


_AROUND = 0.5  # s before and after a change of sign that are drawn
_BESIDE = 3.0  # s before and after a push


def play_picture(state: State, j: int) -> Picture:
    """Size of the residual of joint j against the time to the nearest change of its load's sign.

    Args:
        state: with the effects that are columns.
        j: index of the joint.
    """
    joint = state.data.compiled.spec.joints[j]
    since = _since(state, j)
    near = np.abs(since) < _AROUND
    panel = scatter(
        "", "time since the load changed its sign [s]", f"|residual| [{joint.effort_unit}]",
        since[near], np.abs(state.residual[j][near]), state.base.block[j][near],
    )  # fmt: skip
    panel = replace(panel, shade=(0.0, AFTER))
    return Picture(
        f"evidence_backlash_{joint.name}",
        f"Play in the gear: joint {joint.name}",
        "The teeth knock when the load pushes them to the other side. "
        f"{ROWS.named.capitalize()}: rows; {MEANS.named}: means of bins with 95 % intervals; "
        "shaded: where the knocks are looked for. Friction and springs do not know these moments.",
        ((panel,),),
        380,
    )


def _since(state: State, j: int) -> np.ndarray:
    """(rows_j,) s since the nearest change of sign, negative before it; infinite without any."""
    found = np.full(len(state.residual[j]), np.inf)
    for number, (signals, turns) in enumerate(
        zip(state.rows.signals, load_turns(state, j), strict=True)
    ):
        at = signals.segment.time[turns]
        own = state.rows.segment[j] == number
        if at.size and own.any():
            time = state.rows.time[j][own]
            after = np.clip(np.searchsorted(at, time), 1, max(1, len(at) - 1))
            pairs = time[:, None] - at[np.column_stack([after - 1, np.minimum(after, len(at) - 1)])]
            found[own] = pairs[np.arange(len(time)), np.argmin(np.abs(pairs), axis=1)]
    return found


def push_picture(state: State, window: Window) -> Picture:
    """Residuals of all joints around a push, each in parts of the joint's rms torque.

    Args:
        state: without the rows of the push.
        window: when it pushed.
    """
    seen = state.data.observation
    left = seen.torque - seen.predicted(state.beta)
    shown = (seen.run == window.log) & (seen.time > window.start - _BESIDE)
    shown &= seen.time < window.end + _BESIDE
    masked = (seen.time > window.start - MARGIN) & (seen.time < window.end + MARGIN)
    left[~(seen.used | masked[:, None])] = np.nan  # reversals of a joint: nobody looks at them
    size = np.sqrt(np.mean(seen.torque**2, axis=0))
    curves = tuple(
        Curve(f"joint {joint.name}", seen.time[shown], left[shown, j] / size[j], Style(color))
        for j, (joint, color) in enumerate(zip(seen.joints, itertools.cycle(COLORS), strict=False))
        if size[j] > 0.0
    )
    name = seen.logs[window.log]
    panel = Panel(
        name, "time [s]", "residual over rms torque", curves,
        shade=(window.start, window.end), zero=True,
    )  # fmt: skip
    return Picture(
        "evidence_external_force",
        "Something pushed",
        "What the model leaves of the torques; shaded: while it pushed. These rows are left out of "
        "everything else.",
        ((panel,),),
        380,
    )
