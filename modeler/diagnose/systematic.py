"""How much of a residual is physics of whatever cause: predictable, back in every lap, no noise."""

import numpy as np

from modeler.compare.predictable import Moved
from modeler.compare.predictable import predictable as predictable_share
from modeler.diagnose.curves import curve_sets
from modeler.diagnose.noise import agreement, knocking, lasting, returning, runs
from modeler.diagnose.state import State
from modeler.observation.bristle import bristle

_SLIPS = (0.001, 0.01, 0.1)  # of the range of motion


def systematic_share(state: State, j: int) -> float:
    """Share of the variance of joint j's residual that cannot be noise."""
    again = repeatable(state, j)
    shares = (predictable(state, j), again or 0.0, lasting(state, j), knocking(state, j))
    return max(shares)


def predictable(state: State, j: int) -> float:
    """Share of the residual's variance on joint j that functions of the motion predict."""
    rows, observation = state.rows, state.data.observation
    used = observation.used[:, j]
    moved = Moved(
        joint=j,
        q=observation.q[used],
        v=observation.qd[used],
        a=observation.qdd[used],
        load=rows.filtered(j, [s.load[:, j] for s in rows.signals]),
        slips=[
            rows.filtered(j, [bristle(s.q[:, j], d * state.scales[j].range) for s in rows.signals])
            for d in _SLIPS
        ],
    )
    fold = state.data.blocks.fold[state.base.block[j]]
    residual = state.residual[j] / state.base.sigma[j]
    return predictable_share(moved, residual, fold, curve_sets(state, j))


def repeatable(state: State, j: int) -> float | None:
    """Share of the residual's variance that returns in the next lap; None without laps."""
    sums = [
        agreement(t, r, period)
        for (t, r), period in zip(runs(state, j), state.data.blocks.period, strict=True)
        if period > 0.0 and len(t) >= 20
    ]
    return returning(*np.sum(sums, axis=0)) if sums else None
