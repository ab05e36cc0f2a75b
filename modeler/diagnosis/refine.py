"""Refining the shape parameters of one candidate between the values of the grid."""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import minimize, minimize_scalar

from modeler.diagnosis.candidates import Candidate, coded
from modeler.diagnosis.gram import pool_of
from modeler.diagnosis.ranking import fall
from modeler.diagnosis.state import State, visible
from modeler.effects.effect import Shape

_STEPS = 8


WHOLE = 0.85
"""Share of the best fall with which a whole number of waves per turn is preferred: teeth, poles and
rollers are counted."""


def best_refined(state: State, starts: Sequence[Candidate]) -> Candidate:
    """The best of several shapes of one effect, each refined."""
    found = [refined(state, start) for start in starts]
    if len(found) == 1:
        return found[0]
    return max(found, key=lambda candidate: _explained(state, candidate))


def refined(state: State, candidate: Candidate) -> Candidate:
    """The candidate at the shapes that explain most: variable projection, one shape at a time."""
    smooth = [shape for shape in candidate.form.shapes if candidate.refinable(shape)]
    if not smooth:
        return candidate
    scale = state.scales[candidate.scaled]
    start = np.array([coded(shape, candidate.shapes[shape.name]) for shape in smooth])
    reach = np.array([_reach(state, candidate, shape) for shape in smooth])
    if smooth[0].scale == "waves":
        low, high = np.zeros(1), np.full(1, np.inf)
    else:
        low, high = (
            np.array([coded(shape, scale.value(shape, shape.limits[k])) for shape in smooth])
            for k in (0, 1)
        )

    def lost(x: np.ndarray) -> float:
        return -_explained(state, candidate.moved(smooth, np.clip(x, low, high)))

    if len(smooth) == 1:
        found = minimize_scalar(
            lambda x: lost(np.array([x])),
            bounds=(max(start[0] - reach[0], low[0]), min(start[0] + reach[0], high[0])),
            method="bounded",
            options={"maxiter": _STEPS},
        )
        x, score = np.array([found.x]), float(found.fun)
        whole = np.round(x)
        if smooth[0].scale == "waves" and lost(whole) < WHOLE * score:
            return candidate.moved(smooth, whole)
    else:
        corners = np.vstack([start, start + 0.5 * np.diag(reach)])
        found = minimize(
            lost, start, method="Nelder-Mead",
            options={"maxfev": _STEPS * 4, "initial_simplex": corners},
        )  # fmt: skip
        x, score = found.x, float(found.fun)
    better = score < lost(start)
    return candidate.moved(smooth, np.clip(x, low, high)) if better else candidate


def _reach(state: State, candidate: Candidate, shape: Shape) -> float:
    """How far a value may lie from that of the grid: to the next; half a wave in the stroke."""
    if shape.scale == "angle":
        return 0.3
    if shape.scale == "waves":
        return float(np.pi / state.scales[candidate.index].range)
    if len(shape.grid) == 1:
        return np.log(2.0)
    unit = state.scales[candidate.index].unit(shape)
    gaps = np.diff([coded(shape, unit * value) for value in shape.grid])
    return float(gaps.max() if shape.scale == "own" else gaps[0])


def _explained(state: State, candidate: Candidate) -> float:
    """Fall of the squared residual, weighted, in held-out blocks."""
    columns = state.rows.columns(candidate)
    if not visible(columns):
        return 0.0
    base = state.folded
    return float(fall(base, pool_of(base, [columns])).sum())
