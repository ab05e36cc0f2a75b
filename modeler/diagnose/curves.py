"""Functions of the motion that no effect needs to have: curves, waves, what rings."""

import numpy as np

from modeler.diagnose.orders import order_spectrum
from modeler.diagnose.state import State
from modeler.hypotheses.signals import Signals, resonance

_KNOTS = {"q": 14, "v": 24, "a": 10, "load": 12, "torque": 16}
_LIGHT = 0.1  # damping ratio of what rings
_RINGING = (0.7, 1.5, 3.0, 6.0, 12.0)
"""Hz of the oscillators that the motion excites: sloshing, swinging, springs."""


def curve_sets(state: State, j: int) -> list[np.ndarray]:
    """(rows_j, ...) features of joint j: own curves; waves; all, and of other joints, and ringing.

    A curve is a sum of hats over the quantiles of a coordinate, with and without the direction of
    the joint: friction and other torques of any shape. Waves have the orders that stand out.
    """
    knots = _knots(state)
    own, *more = [
        state.rows.filtered(j, [features(s, j, knots) for s in state.rows.signals])
        for features in (_own, _others, _ringing)
    ]
    waves = _waves(state, j)
    return [own, waves, np.hstack([own, waves, *more])]


def _waves(state: State, j: int) -> np.ndarray:
    """(rows_j, 2 k) cosine and sine of the k orders that stand out in the residual."""
    found = order_spectrum(state, j)
    if found is None or not found.peaks:
        return np.zeros((len(state.residual[j]), 0))
    angles = [np.outer(s.q[:, j], found.peaks) for s in state.rows.signals]
    return state.rows.filtered(j, [np.hstack([np.cos(x), np.sin(x)]) for x in angles])


_Knots = dict[tuple[str, int], np.ndarray]


def _knots(state: State) -> _Knots:
    """Quantiles of each coordinate of each joint over all stretches."""
    found = {}
    for name, count in _KNOTS.items():
        every = np.concatenate([getattr(s, name)[::4] for s in state.rows.signals])
        for k in range(every.shape[1]):
            found[name, k] = np.unique(np.quantile(every[:, k], np.linspace(0.0, 1.0, count)))
    return found


def _hats(x: np.ndarray, knots: np.ndarray) -> np.ndarray:
    """(n, knots) linear B-splines; constant outside."""
    if len(knots) < 2:
        return np.zeros((len(x), 0))
    inside = np.clip(x, knots[0], knots[-1])
    place = np.clip(np.searchsorted(knots, inside, side="right") - 1, 0, len(knots) - 2)
    share = (inside - knots[place]) / (knots[place + 1] - knots[place])
    found = np.zeros((len(x), len(knots)))
    every = np.arange(len(x))
    found[every, place] = 1.0 - share
    found[every, place + 1] = share
    return found


def _own(signals: Signals, j: int, knots: _Knots) -> np.ndarray:
    direction = np.sign(signals.v[:, j])[:, None]
    parts = []
    for name in _KNOTS:
        curve = _hats(getattr(signals, name)[:, j], knots[name, j])
        parts.append(curve)
        if name != "v":
            parts.append(curve * direction)
    return np.hstack(parts)


def _others(signals: Signals, j: int, knots: _Knots) -> np.ndarray:
    direction = np.sign(signals.v[:, j])[:, None]
    parts = [direction]
    for k in range(signals.q.shape[1]):
        if k == j:
            continue
        place = _hats(signals.q[:, k], knots["q", k][::2])
        parts += [place, place * direction, _hats(signals.v[:, k], knots["v", k][::3])]
        plain = np.column_stack([signals.a[:, k], signals.load[:, k], signals.torque[:, k]])
        parts += [plain, np.abs(plain) * direction]
    return np.hstack(parts)


def _ringing(signals: Signals, j: int, knots: _Knots) -> np.ndarray:
    del j, knots
    parts = []
    for k in range(signals.q.shape[1]):
        for frequency in _RINGING:
            z = resonance(signals.a[:, k], signals.step, frequency, _LIGHT)
            parts += [z, np.gradient(z)]
    return np.column_stack(parts)
