"""Does an effect explain what is systematic, or only part of it?"""

from collections.abc import Sequence

import numpy as np

from modeler.scoring.state import State

CLOSED = 0.95
"""Share of what is systematic that an effect must explain to be stated as the cause."""

ALIKE = 1.2
"""Noise on held-out logs over that on training logs, variances, that is no sign of physics."""


def closure(
    chain: Sequence[State],
    touched: Sequence[int],
    systematic: Sequence[float],
    held_out: Sequence[np.ndarray] | None,
) -> float:
    """What one effect explains, over that, what later ones explain and what stays systematic.

    Squared residuals of the joints it touches, in units of their first residual. What a wrong name
    leaves, others are found to mend; so what they explain there counts as left. On held-out logs
    all that exceeds the noise of the training logs is systematic: a wrong form fails there. The
    smaller share counts.

    Args:
        chain: the state before the effect, the one with it, those with the later ones.
        touched: joints whose residuals it explains.
        systematic: (J,) share of the variance of each joint's last residual.
        held_out: (J,) mean squared residual on held-out logs, by state of the chain.
    """
    squares = [np.array([mean_square(r) for r in state.residual]) for state in chain]
    noise = [(1.0 - systematic[j]) * squares[-1][j] for j in range(len(squares[-1]))]
    sigma = chain[0].base.sigma
    shares = [_share(squares, touched, noise, sigma)]
    if held_out is not None:
        shares.append(_share(held_out, touched, [ALIKE * n for n in noise], sigma))
    return min(shares)


def mean_square(values: np.ndarray) -> float:
    """0 of none."""
    return float(np.mean(values**2)) if values.size else 0.0


def _share(
    squares: Sequence[np.ndarray], touched: Sequence[int], noise: Sequence[float], sigma: np.ndarray
) -> float:
    """Explained over explained and left; 0 if nothing is explained."""
    before, after, end = squares[0], squares[1], squares[-1]
    explained = left = 0.0
    for j in touched:
        unit = float(sigma[j]) ** 2
        explained += max(0.0, float(before[j] - after[j])) / unit
        left += max(0.0, float(after[j] - end[j])) / unit
        left += max(0.0, float(end[j] - noise[j])) / unit
    return explained / (explained + left) if explained > 0.0 else 0.0
