"""Torque and residual before and after an effect, where the model without it is worst."""

import itertools
from dataclasses import replace

import numpy as np

from modeler.core.figure import Curve, Panel, Picture
from modeler.core.style import BLACK, COLOR_NAMES, COLORS, GREEN, SHADE, VERMILLION, Style
from modeler.core.table import WORDS
from modeler.diagnosis import THRESHOLDS, PushWindow, State, find_load_reversals
from modeler.validation import WINDOW, break_at_gaps
from modeler.views.effect_evidence import Evidence
from modeler.views.evidence import MEANS, ROWS, build_scatter_panel

MEASURED = Style(BLACK, width=1.2)
BEFORE = Style(VERMILLION, width=1.6, dash=True)
AFTER_STYLE = Style(GREEN, width=1.6)
LEFT = Style(VERMILLION, width=1.2, dash=True)
STAYS = Style(GREEN, width=1.2)
_DRAWN_BESIDE = 1.5  # s on either side that are drawn too


def draw_torque_picture(item: Evidence) -> Picture:
    """Measured, model without and with the effect; below, what either leaves."""
    rows = item.without.rows
    joint = item.without.data.compiled.spec.joints[item.j]
    log, start, end = find_worst_window(item)
    time, pieces = rows.time[item.j], _find_pieces(item)
    near = (
        (rows.run[item.j] == log) & (time >= start - _DRAWN_BESIDE) & (time <= end + _DRAWN_BESIDE)
    )
    measured, what = rows.y[item.j], WORDS[joint.effort_unit]

    def build_curve(label: str, y: np.ndarray, style: Style) -> Curve:
        return Curve(label, *break_at_gaps(pieces[near], time[near], y[near]), style)

    name = item.without.data.observation.logs[log]
    x_label, pick = f"time in {name} [s]", item.step.candidate
    above = Panel(
        "Torque" if what == "torque" else "Force", x_label, f"{what} [{joint.effort_unit}]",
        (build_curve("measured", measured, MEASURED),
         build_curve("model before", measured - item.before, BEFORE),
         build_curve("model after", measured - item.after, AFTER_STYLE)),
        shade=(start, end),
    )  # fmt: skip
    below = Panel(
        "Residual",
        x_label,
        f"residual [{joint.effort_unit}]",
        (
            build_curve("residual before", item.before, LEFT),
            build_curve("residual after", item.after, STAYS),
        ),
        shade=(start, end),
        zero=True,
    )
    return Picture(
        name=f"torque_{pick.effect.id}_{pick.joint or 'robot'}",
        title=f"Joint {joint.name} where it is worst: before and after",
        caption=_write_caption(item, what, (start, end), name),
        panels=((above,), (below,)),
        heights=(0.58, 0.42),
        height=430,
        shared_time=True,
    )


def find_worst_window(item: Evidence) -> tuple[int, float, float]:
    """Index of the log, start and end in s of the half second where the model is worst.

    By its squared residual without the effect, on the joint where the effect is seen.
    """
    rows, j = item.without.rows, item.j
    time, run, square = rows.time[j], rows.run[j], np.where(item.is_inlier, item.before, 0.0) ** 2
    best = (-1.0, 0, 0.0, 0.0)
    for log in np.unique(run):
        is_of_log = run == log
        t, energy = time[is_of_log], np.concatenate([[0.0], np.cumsum(square[is_of_log])])
        stop = np.searchsorted(t, t + WINDOW, side="right")
        inside = energy[stop] - energy[:-1]
        k = int(np.argmax(inside))
        if inside[k] > best[0]:
            best = (float(inside[k]), int(log), float(t[k]), float(t[stop[k] - 1]))
    return best[1], best[2], best[3]


def _find_pieces(item: Evidence) -> np.ndarray:
    """(rows_j,) number of the piece of each row: no line is drawn over rows that do not count."""
    time, segment = item.without.rows.time[item.j], item.without.rows.segment[item.j]
    steps = np.diff(time)
    inside = steps[np.diff(segment) == 0]
    longest = 1.5 * float(np.median(inside)) if inside.size else np.inf
    return np.concatenate([[0], np.cumsum((np.diff(segment) != 0) | (steps > longest))])


def _write_caption(item: Evidence, what: str, window: tuple[float, float], log: str) -> str:
    rows, j = item.without.rows, item.j
    time = rows.time[j]
    number = item.without.data.observation.logs.index(log)
    inside = (rows.run[j] == number) & (time >= window[0]) & (time <= window[1])
    before, after = (float(np.sqrt(np.mean(e[inside] ** 2))) for e in (item.before, item.after))
    return (
        f"Above, {MEASURED.description}: measured {what}; {BEFORE.description}: the model without "
        "the effect, "
        f"fitted to the same rows; {AFTER_STYLE.description}: with it. Below, what they leave: "
        f"{LEFT.description} before, {STAYS.description} after. Shaded {COLOR_NAMES[SHADE]}: the "
        f"{WINDOW} s "
        f"with the largest squared residual before, {window[0]:.2f} to {window[1]:.2f} s; the rms "
        f"residual there falls from {before:.3g} to {after:.3g} {item.unit}. Filtered rows of the "
        "logs that are explained; rows that do not count are left out."
    )


# Pictures of what is no column: knocks of play around the moments they follow, a push in time.


_AROUND = 0.5  # s before and after a change of sign that are drawn
_BESIDE = 3.0  # s before and after a push


def draw_play_picture(state: State, j: int) -> Picture:
    """Size of the residual of joint j against the time to the nearest change of its load's sign.

    Args:
        state: with the effects that are columns.
        j: index of the joint.
    """
    joint = state.data.compiled.spec.joints[j]
    since = _compute_time_since_reversal(state, j)
    near = np.abs(since) < _AROUND
    panel = build_scatter_panel(
        "", "time since the load changed its sign [s]", f"|residual| [{joint.effort_unit}]",
        since[near], np.abs(state.residual[j][near]), state.gram_blocks.block[j][near],
    )  # fmt: skip
    panel = replace(panel, shade=(0.0, THRESHOLDS.burst_duration))
    return Picture(
        f"evidence_backlash_{joint.name}",
        f"Play in the gear: joint {joint.name}",
        "The teeth knock when the load pushes them to the other side. "
        f"{ROWS.description.capitalize()}: rows; {MEANS.description}: means of bins with 95 % "
        "intervals; "
        "shaded: where the knocks are looked for. Friction and springs do not know these moments.",
        ((panel,),),
        380,
    )


def _compute_time_since_reversal(state: State, j: int) -> np.ndarray:
    """(rows_j,) s since the nearest change of sign, negative before it; infinite without any."""
    since = np.full(len(state.residual[j]), np.inf)
    for number, (signals, turns) in enumerate(
        zip(state.rows.signals, find_load_reversals(state, j), strict=True)
    ):
        at = signals.segment.time[turns]
        is_of_segment = state.rows.segment[j] == number
        if at.size and is_of_segment.any():
            time = state.rows.time[j][is_of_segment]
            after = np.clip(np.searchsorted(at, time), 1, max(1, len(at) - 1))
            pairs = time[:, None] - at[np.column_stack([after - 1, np.minimum(after, len(at) - 1)])]
            since[is_of_segment] = pairs[np.arange(len(time)), np.argmin(np.abs(pairs), axis=1)]
    return since


def draw_push_picture(state: State, window: PushWindow) -> Picture:
    """Residuals of all joints around a push, each in parts of the joint's rms torque.

    Args:
        state: without the rows of the push.
        window: when it pushed.
    """
    seen = state.data.observation
    left = seen.torque - seen.predict(state.beta)
    shown = (seen.run == window.log) & (seen.time > window.start - _BESIDE)
    shown &= seen.time < window.end + _BESIDE
    masked = (seen.time > window.start - THRESHOLDS.push_margin) & (
        seen.time < window.end + THRESHOLDS.push_margin
    )
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
