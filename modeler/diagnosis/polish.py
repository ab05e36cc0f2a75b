"""Refining the shape parameters of one candidate between the values of the grid."""

import dataclasses
from collections.abc import Sequence

import numpy as np
from scipy.optimize import minimize, minimize_scalar

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.gram import pool_of
from modeler.diagnosis.ranking import fall
from modeler.diagnosis.state import State, columns_of, visible
from modeler.effects.effect import Shape

_STEPS = 8


WHOLE = 0.85
"""Share of the best fall with which a whole number of waves per turn is preferred: teeth, poles and
rollers are counted."""


def best_polished(state: State, starts: Sequence[Candidate]) -> Candidate:
    """The best of several shapes of one effect, each refined."""
    found = [polished(state, start) for start in starts]
    if len(found) == 1:
        return found[0]
    return max(found, key=lambda candidate: _explained(state, candidate))


def polished(state: State, candidate: Candidate) -> Candidate:
    """The candidate at the shapes that explain most: variable projection, one shape at a time."""
    smooth = [s for s in candidate.form.shapes if _free(s, candidate)]
    if not smooth:
        return candidate
    start = np.array([_coded(shape, candidate.shapes[shape.name]) for shape in smooth])

    def lost(x: np.ndarray) -> float:
        return -_explained(state, _at(candidate, smooth, np.clip(x, low, high)))

    reach = np.array([_reach(state, candidate, shape) for shape in smooth])
    low, high = _limits(state, candidate, smooth)
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
            return _at(candidate, smooth, whole)
    else:
        corners = np.vstack([start, start + 0.5 * np.diag(reach)])
        found = minimize(
            lost, start, method="Nelder-Mead",
            options={"maxfev": _STEPS * 4, "initial_simplex": corners},
        )  # fmt: skip
        x, score = found.x, float(found.fun)
    return _at(candidate, smooth, np.clip(x, low, high)) if score < lost(start) else candidate


def _free(shape: Shape, candidate: Candidate) -> bool:
    """True if values beside that of the candidate make sense: orders are, if not given."""
    if shape.scale == "waves":
        return candidate.shapes[shape.name] not in shape.grid
    return shape.smooth


def _limits(
    state: State, candidate: Candidate, smooth: Sequence[Shape]
) -> tuple[np.ndarray, np.ndarray]:
    """Coded limits of the shapes on the candidate's joint."""
    scale = state.scales[candidate.scaled]
    if smooth[0].scale == "waves":
        return np.zeros(1), np.full(1, np.inf)
    ends = [[_coded(shape, scale.value(shape, end)) for end in shape.limits] for shape in smooth]
    return np.array([e[0] for e in ends]), np.array([e[1] for e in ends])


def _coded(shape: Shape, value: float) -> float:
    """Positive shapes by their logarithm."""
    return float(np.log(value)) if shape.limits[0] > 0.0 else value


def _decoded(shape: Shape, x: float) -> float:
    return float(np.exp(x)) if shape.limits[0] > 0.0 else float(x)


def _reach(state: State, candidate: Candidate, shape: Shape) -> float:
    """How far a value may lie from that of the grid: to the next; half a wave in the stroke."""
    if shape.scale == "angle":
        return 0.3
    if shape.scale == "waves":
        return float(np.pi / state.scales[candidate.index].range)
    if len(shape.grid) == 1:
        return np.log(2.0)
    unit = state.scales[candidate.index].unit(shape)
    gaps = np.diff([_coded(shape, unit * value) for value in shape.grid])
    return float(gaps.max() if shape.scale == "own" else gaps[0])


def _at(candidate: Candidate, smooth: Sequence[Shape], x: np.ndarray) -> Candidate:
    values = {shape.name: _decoded(shape, v) for shape, v in zip(smooth, x, strict=True)}
    return dataclasses.replace(candidate, shapes={**candidate.shapes, **values})


def _explained(state: State, candidate: Candidate) -> float:
    """Fall of the squared residual, weighted, in held-out blocks."""
    columns = columns_of(state.rows, candidate, {})
    if not visible(columns):
        return 0.0
    base = state.folded
    return float(fall(base, pool_of(base, [columns])).sum())
