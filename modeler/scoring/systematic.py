"""How much of a residual is physics of whatever cause: predictable, back in every lap, no noise."""

import numpy as np

from modeler.hypotheses.signals import resonance
from modeler.observation.bristle import bristle
from modeler.residuals.features import SLIPS, Measured, functions
from modeler.residuals.flexible import LEAST, Flexible, flexible
from modeler.residuals.memory import forgotten, outbursts, returning
from modeler.scoring.orders import order_spectrum
from modeler.scoring.state import State

_LIGHT = 0.1  # damping ratio of what rings
_RINGING = (0.7, 1.5, 3.0, 6.0, 12.0)
"""Hz of the oscillators that the motion excites: sloshing, swinging, springs."""


def systematic_share(state: State, j: int) -> float:
    """Share of the variance of joint j's residual that cannot be noise."""
    rows, residual = state.rows, state.residual[j]
    log = rows.time[j], residual, rows.run[j]
    cutoff = state.data.observation.report.processing.parallel_cutoff or 0.0
    periods = state.data.blocks.period
    steps = (periods, [forgotten(cutoff)] * len(periods))
    again = [returning(*log, later) or 0.0 for later in steps]
    return max(rival(state, j).share, knocking(state, j), *again)


def knocking(state: State, j: int) -> float:
    """Share of the energy of joint j's residual in outbursts."""
    return outbursts(state.residual[j], state.base.block[j])


def rival(state: State, j: int) -> Flexible:
    """What a flexible smooth function of all that was measured says of joint j's residual."""
    fold = state.data.blocks.fold[state.base.block[j]]
    sets = functions(_measured(state, j)) if fold.size >= LEAST else {}
    return flexible(sets, state.residual[j], fold)


def _measured(state: State, j: int) -> Measured:
    rows, observation = state.rows, state.data.observation
    used = observation.used[:, j]
    loads = rows.filtered(j, [np.hstack([s.load, s.torque]) for s in rows.signals])
    way = [np.sign(s.v[:, j]) for s in rows.signals]
    slips = [
        np.column_stack([bristle(s.q[:, j], d * state.scales[j].range) for d in SLIPS])
        for s in rows.signals
    ]
    return Measured(
        joint=j,
        q=observation.q[used],
        v=observation.qd[used],
        a=observation.qdd[used],
        load=loads[:, : rows.joints],
        torque=loads[:, rows.joints :],
        direction=rows.filtered(j, way),
        slips=rows.filtered(j, slips),
        further={"waves": _waves(state, j), "ringing": _ringing(state, j)},
    )


def _waves(state: State, j: int) -> np.ndarray:
    """(rows_j, 2 k) cosine and sine of the k orders that stand out in the residual."""
    found = order_spectrum(state, j)
    if found is None or not found.peaks:
        return np.zeros((len(state.residual[j]), 0))
    angles = [np.outer(s.q[:, j], found.peaks) for s in state.rows.signals]
    return state.rows.filtered(j, [np.hstack([np.cos(x), np.sin(x)]) for x in angles])


def _ringing(state: State, j: int) -> np.ndarray:
    """(rows_j, ...) oscillators that the accelerations of all joints excite, and their speeds."""
    every = []
    for s in state.rows.signals:
        z = np.column_stack(
            [resonance(a, s.step, frequency, _LIGHT) for a in s.a.T for frequency in _RINGING]
        )
        every.append(np.hstack([z, np.gradient(z, axis=0)]))
    return state.rows.filtered(j, every)
