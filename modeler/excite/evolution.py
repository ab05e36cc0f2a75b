"""A search that needs values only: evolution with an adapted covariance."""

from collections.abc import Callable

import numpy as np


def evolve(
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
