"""Quasi-Newton descent inside an open set; evolution, a search that needs values only."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

_ENOUGH = 1e-4  # share of the promised fall that a step must bring (Armijo)
_SHORTEST = 1e-6
_NEAR = 0.95  # of the way to the boundary
_LOOK = 10  # steps that are to bring something


@dataclass(frozen=True)
class ObjectiveFunction:
    """A function on an open set.

    Attributes:
        value: f(x), infinite outside of the set.
        slope: its gradient where it is finite; called at the point last asked for.
        reach: how far from x along d the set's flat walls stand, in lengths of d.
    """

    value: Callable[[np.ndarray], float]
    gradient: Callable[[np.ndarray], np.ndarray]
    boundary_distance: Callable[[np.ndarray, np.ndarray], float]


def minimise_bfgs(
    landscape: ObjectiveFunction,
    x: np.ndarray,
    steps: int,
    tolerance: float,
    proceed: Callable[[], bool],
) -> np.ndarray:
    """The lowest point that BFGS comes to from x, (d,).

    Args:
        landscape: the function.
        x: inside of the set.
        steps: at most so many.
        tolerance: it ends where ten steps together bring less than this.
        proceed: asked before each value; False ends it.
    """
    value = landscape.value(x)
    slope = landscape.gradient(x)
    curve, fresh, values = _build_initial_inverse_hessian(slope), True, [value]
    for _ in range(steps):
        if not proceed():
            break
        way = -curve @ slope
        lower_point = _search_line(landscape, x, value, way, float(way @ slope), proceed)
        if lower_point is None:
            if fresh:
                break
            curve, fresh = (
                _build_initial_inverse_hessian(slope),
                True,
            )  # a kink: what was learnt of curvature misleads
            continue
        ahead, new = lower_point
        after = landscape.gradient(ahead)
        curve, fresh = _update_inverse_hessian(curve, ahead - x, after - slope, fresh), False
        x, value, slope = ahead, new, after
        values.append(value)
        if len(values) > _LOOK and values[-1 - _LOOK] - value < tolerance:
            break
    return x


def _build_initial_inverse_hessian(slope: np.ndarray) -> np.ndarray:
    return np.eye(len(slope)) / max(float(np.linalg.norm(slope)), 1e-12)


def _search_line(
    landscape: ObjectiveFunction, x: np.ndarray, value: float, way: np.ndarray, fall: float,
    proceed: Callable[[], bool],
) -> tuple[np.ndarray, float] | None:  # fmt: skip
    """A point along `way` that is lower than promised in part, and its value."""
    share = min(1.0, _NEAR * landscape.boundary_distance(x, way))
    while fall < 0.0 and share > _SHORTEST and proceed():
        ahead = x + share * way
        new = landscape.value(ahead)
        if new <= value + _ENOUGH * share * fall:
            return ahead, new
        share *= 0.4
    return None


def _update_inverse_hessian(
    curve: np.ndarray, step: np.ndarray, change: np.ndarray, first: bool
) -> np.ndarray:
    """The inverse of the second derivative, with what one step taught of it (BFGS)."""
    along = float(step @ change)
    if not along > 1e-10 * float(np.linalg.norm(step) * np.linalg.norm(change)):
        return curve
    if first:
        curve = np.eye(len(step)) * (along / float(change @ change))
    turned = curve @ change
    return (
        curve
        + np.outer(step, step) * ((along + change @ turned) / along**2)
        - (np.outer(turned, step) + np.outer(step, turned)) / along
    )


def minimise_cma_es(
    value: Callable[[np.ndarray], float],
    x: np.ndarray,
    size: float,
    generations: int,
    rng: np.random.Generator,
    proceed: Callable[[int], bool],
) -> np.ndarray:
    """The lowest point found from x, (d,), by CMA-ES.

    N. Hansen, The CMA Evolution Strategy: A Tutorial, arXiv:1604.00772, appendix A.

    Args:
        value: to be made small; any point may be asked for.
        x: where it begins.
        size: standard deviation of the first points.
        generations: at most so many.
        rng: draws the points.
        proceed: asked before each point, with the number of its generation; False ends it.
    """
    d = len(x)
    count = 8 + int(3 * np.log(d))
    parents = count // 2
    share = np.log(parents + 0.5) - np.log(np.arange(1, parents + 1))
    share /= share.sum()
    mu = 1.0 / np.sum(share**2)
    c_size, c_path = (mu + 2) / (d + mu + 5), (4 + mu / d) / (d + 4 + 2 * mu / d)
    damp = 1 + 2 * max(0.0, np.sqrt((mu - 1) / (d + 1)) - 1) + c_size
    c_one = 2 / ((d + 1.3) ** 2 + mu)
    c_many = min(1 - c_one, 2 * (mu - 2 + 1 / mu) / ((d + 2) ** 2 + mu))
    usual = np.sqrt(d) * (1 - 1 / (4 * d) + 1 / (21 * d**2))
    covariance, path, size_path = np.eye(d), np.zeros(d), np.zeros(d)
    best, lowest = x, value(x)
    for generation in range(generations):
        spread, turn = np.linalg.eigh(covariance)
        spread = np.sqrt(np.maximum(spread, 1e-20))
        steps = (rng.normal(size=(count, d)) * spread) @ turn.T
        values = np.full(count, np.inf)
        for k, step in enumerate(steps):
            if not proceed(generation):
                return best
            values[k] = value(x + size * step)
            if values[k] < lowest:
                best, lowest = x + size * step, values[k]
        order = np.argsort(values, kind="stable")
        chosen = steps[order[:parents]]
        mean = share @ chosen
        x = x + size * mean
        whitened = turn @ ((turn.T @ mean) / spread)
        size_path = (1 - c_size) * size_path + np.sqrt(c_size * (2 - c_size) * mu) * whitened
        path = (1 - c_path) * path + np.sqrt(c_path * (2 - c_path) * mu) * mean
        covariance = (
            (1 - c_one - c_many) * covariance
            + c_one * np.outer(path, path)
            + c_many * (chosen.T * share) @ chosen
        )
        size *= float(np.exp(c_size / damp * (np.linalg.norm(size_path) / usual - 1)))
    return best
