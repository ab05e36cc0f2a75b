"""Play in a gear: bursts of the residual where the load changes sign, not the speed."""

import numpy as np

from modeler.scoring.state import State

AFTER = 0.1
"""s: how long a burst lasts."""

BURST = 11.0
"""Energy within that time over that elsewhere from which on play is named."""

LOUD = 30.0
"""The same where columns are named that take the bursts away."""

EVENTS = 5
"""Least number of sign changes of the load."""


def burst_ratio(state: State, j: int) -> float:
    """Mean squared residual within 0.1 s after sign changes of the load, over that elsewhere.

    The loudest fifth of the events, and of the rows elsewhere the loudest hundredth, are left out:
    play bursts every time. 0 where the load changes sign, far from speed reversals, less than
    `EVENTS` times.
    """
    label, events = [], 0
    for s, turns in zip(state.rows.signals, load_turns(state, j), strict=True):
        span = max(1, round(AFTER / s.step))
        flags = np.zeros(len(s.q))
        for turn in turns:
            events += 1
            flags[turn : turn + span] = events
        label.append(flags)
    if events < EVENTS:
        return 0.0
    return _ratio(state.residual[j] ** 2, _nearest(state, j, label), events)


def load_turns(state: State, j: int) -> list[np.ndarray]:
    """Samples, by stretch, where the load on joint j changes sign while the joint moves on."""
    found = []
    for s in state.rows.signals:
        span, least = max(1, round(AFTER / s.step)), 0.02 * state.scales[j].speed
        turns = np.flatnonzero(np.diff(np.sign(s.load[:, j])) != 0)
        speed = np.abs(s.v[:, j])
        moving = [turn for turn in turns if speed[turn : turn + span].min() > least]
        found.append(np.array(moving, dtype=int))
    return found


def _nearest(state: State, j: int, label: list[np.ndarray]) -> np.ndarray:
    """(rows,) event of each row, 0 for none: that of the sample in the middle of its weights."""
    found = []
    for own, flags in zip(state.rows.filters, label, strict=True):
        middle = own[j] @ np.arange(len(flags))
        found.append(flags[np.clip(np.round(middle).astype(int), 0, len(flags) - 1)])
    return np.concatenate(found)


def _ratio(square: np.ndarray, event: np.ndarray, events: int) -> float:
    loud = np.sort([square[event == k].mean() for k in range(1, events + 1) if (event == k).any()])
    quiet = np.sort(square[event == 0])
    if len(loud) < EVENTS or len(quiet) < 8:
        return 0.0
    kept = loud[: len(loud) - max(1, len(loud) // 5)]
    rest = quiet[: len(quiet) - len(quiet) // 100]
    return float(kept.mean() / max(float(rest.mean()), 1e-300))
