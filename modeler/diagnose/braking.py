"""Friction brakes: does that of a model with an effect, on the motion seen and where it has faded?

The friction of a joint takes energy: its torque times the speed is not negative, at any speed, load
and temperature of the logs (what turns gradually, as bristles do, gives back a little after a
reversal and is left out). What reads more than the motion of its joint may be absent: friction that
grows with the load, or fades as the joint warms up, adds to that of the unloaded or warm joint,
which brakes too. An effect with values that make friction drive describes something else.
"""

from collections.abc import Sequence

import numpy as np

from modeler.hypotheses.candidates import Candidate
from modeler.scoring.state import State

DRIVES = "with it the friction of its joint would drive instead of brake"
"""Why such an effect is refused."""

FADES = frozenset({"t", "load", "static"})
"""What may be absent while a joint moves: time since the start, load."""


def drives(before: State, after: State, pick: Candidate) -> bool:
    """True if friction drives with the effect by more than the model leaves, and not without it.

    Args:
        before: the state without the effect.
        after: with it, as the last that was put in.
        pick: the effect.
    """
    if pick.effect.family != "friction" or not pick.local:
        return False
    j = pick.index
    if not has_friction(after, j):
        return False  # a model without friction says nothing of the whole
    left = float(np.sqrt(np.mean(after.residual[j] ** 2)))
    own = [k for k, other in enumerate(after.picks) if _brakes(other, j)]
    worst = _driving(after, j, own)
    if pick.form.names & FADES:
        worst = max(worst, _driving(after, j, own[:-1]))
    earlier = [k for k, other in enumerate(before.picks) if _brakes(other, j)]
    return worst > max(left, _driving(before, j, earlier))


def has_friction(state: State, j: int) -> bool:
    """True if the model has friction of joint j alone."""
    return bool(_own(state, j))


def _brakes(pick: Candidate, j: int) -> bool:
    """True for friction of that joint without memory."""
    friction = pick.effect.family == "friction" and pick.local and pick.form.memory is None
    return friction and pick.index == j


def largest_friction(state: State, j: int) -> float:
    """The largest friction torque of joint j on its rows, but for one in fifty, N m or N."""
    picks = [k for k, other in enumerate(state.picks) if _brakes(other, j)]
    torque = np.abs(_friction(state, j, picks))
    return float(np.quantile(torque, 0.98)) if torque.size else 0.0


def _driving(state: State, j: int, picks: Sequence[int]) -> float:
    """Rms of the friction torque of joint j where it drives, N m or N; with some of the picks."""
    way = np.sign(state.rows.filtered(j, [s.v[:, j] for s in state.rows.signals]))
    return float(np.sqrt(np.mean(np.minimum(0.0, _friction(state, j, picks) * way) ** 2)))


def _own(state: State, j: int) -> list[int]:
    """Base columns of the friction of joint j alone."""
    base = state.data.compiled.spec.base
    return [i for i, b in enumerate(base) if b.kind == "friction" and b.rows == (j,)]


def _friction(state: State, j: int, picks: Sequence[int]) -> np.ndarray:
    """(rows_j,) friction torque of joint j, N m or N: of the model and some of the picks."""
    own = _own(state, j)
    torque = state.rows.W[j][:, own] @ state.beta[own]
    for k in picks:
        columns = state.extra[k][j]
        assert columns is not None, "it acts on its joint"
        torque = torque + columns @ state.values[k]
    return torque
