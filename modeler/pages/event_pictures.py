"""Pictures of what is no column: knocks of play around the moments they follow, a push in time."""

import numpy as np

from modeler.diagnose.bursts import AFTER, load_turns
from modeler.diagnose.contact import MARGIN, Window
from modeler.pages.evidence import MEANS, ROWS, scatter
from modeler.pictures.picture import COLORS, Curve, Panel, Picture, Style
from modeler.scoring.state import State

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
    panel = Panel(panel.title, panel.x_label, panel.y_label, panel.series, shade=(0.0, AFTER))
    return _picture(
        f"evidence_backlash_{joint.name}",
        f"Play in the gear: joint {joint.name}",
        "The teeth knock when the load pushes them to the other side. "
        f"{ROWS.named.capitalize()}: rows; {MEANS.named}: means of bins with 95 % intervals; "
        "shaded: where the knocks are looked for. Friction and springs do not know these moments.",
        panel,
    )


def _since(state: State, j: int) -> np.ndarray:
    """(rows_j,) s since the nearest change of sign, negative before it; infinite without any."""
    found = np.full(len(state.residual[j]), np.inf)
    for number, (signals, turns) in enumerate(
        zip(state.rows.signals, load_turns(state, j), strict=True)
    ):
        at = signals.segment.time[:: signals.every][turns]
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
        for j, (joint, color) in enumerate(zip(seen.joints, _colors(len(size)), strict=True))
        if size[j] > 0.0
    )
    name = seen.logs[window.log]
    panel = Panel(
        name, "time [s]", "residual over rms torque", curves,
        shade=(window.start, window.end), zero=True,
    )  # fmt: skip
    return _picture(
        "evidence_external_force",
        "Something pushed",
        "What the model leaves of the torques; shaded: while it pushed. These rows are left out of "
        "everything else.",
        panel,
    )


def _colors(count: int) -> list[str]:
    return [COLORS[k % len(COLORS)] for k in range(count)]


def _picture(name: str, title: str, caption: str, panel: Panel) -> Picture:
    return Picture(name, title, caption, ((panel,),), (1.0,), (1.0,), 380)
