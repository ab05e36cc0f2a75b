"""Which spring hangs on a lever: a helical one, or one of constant force?"""

from collections.abc import Sequence

import numpy as np

from modeler.effects import Effect
from modeler.hypotheses.candidates import Candidate, over_grid
from modeler.scoring.polish import polished
from modeler.scoring.state import State, all_columns_of, columns_of

CLEAR = 1.01
"""Ratio of two falls that decides, and of what they leave of the squared residuals."""

_STARTS = 4  # shapes of a sign that are refined


def constant_force(state: State, helical: Candidate, other: Effect) -> Candidate | None:
    """The spring of constant force that explains more than any helical one; None if none does.

    With l the length of the spring, Gamma = k (l - l0) dl/dq for a helical one and F dl/dq for a
    constant pull: in sin(q - q0) / l the first has the coefficient -k l0 b, the second +F b. The
    rest of the first, k b sin(q - q0), is mostly that of the link's first moment.

    Args:
        state: without either.
        helical: its candidate.
        other: the effect of constant force.
    """
    pull = _best(state, helical, other, 1.0)
    if pull is None:
        return None
    _, ranking = state.ranked([columns_of(state.rows, helical, state.cache)])
    total = float(ranking.before[helical.index])
    if _better(float(ranking.drop.sum()), pull[1], total):
        return None
    spring = _best(state, helical, helical.effect, -1.0)
    return pull[0] if spring is None or _better(pull[1], spring[1], total) else None


def _better(fall: float, other: float, total: float) -> bool:
    """True if a fall of the joint's squared residuals is clearly larger than another."""
    left, others = (max(total - f, 1e-3 * total) for f in (fall, other))
    return fall > CLEAR * other or CLEAR * left < others


def _best(
    state: State, like: Candidate, effect: Effect, sign: float
) -> tuple[Candidate, float] | None:
    """The best shapes with which the part sin / l has that sign, and the fall they give."""
    scale = state.scales[like.index]
    grid = list(over_grid(effect, effect.forms[0], str(like.joint), like.index, scale))
    tried = _signed(state, grid, sign)[:_STARTS]
    refined = [polished(state, candidate) for candidate, _ in tried]
    return next(iter(_signed(state, [*refined, *(c for c, _ in tried)], sign)), None)


def _signed(
    state: State, candidates: Sequence[Candidate], sign: float
) -> list[tuple[Candidate, float]]:
    """Those whose last parameter has that sign, and the fall of each, best first."""
    if not candidates:
        return []
    seen = state.sifted(all_columns_of(state.rows, candidates, state.cache))
    last, fall = [value[-1] for value in seen.value], seen.total
    order = [k for k in np.argsort(-fall) if sign * last[k] > 0.0 and fall[k] > 0.0]
    return [(candidates[k], float(fall[k])) for k in order]
