"""The odd machine out: whose value of a quantity is apart from that of all others."""

from dataclasses import dataclass

import numpy as np

from modeler.fleet.series import quantile

LEAST = 5
"""Machines from which an odd one can be told: with fewer, the others say too little of each other.
"""

_SHARE, _STEPS = 5, 3  # one of so many machines may be odd, and so many of a fleet


@dataclass(frozen=True)
class Odd:
    """A machine apart.

    Attributes:
        machine: index.
        difference: to the median of the others.
        spread: standard deviation among the others.
        score: difference in these.
    """

    machine: int
    difference: float
    spread: float
    score: float


def critical_deviate(count: int, step: int, chance: float) -> float:
    """What the most extreme of `count` normal numbers less `step` - 1 exceeds with that chance.

    (Rosner 1983, eq. 2.5), lambda = (n - i) t / sqrt((n - i - 1 + t^2) (n - i + 1)), t with
    n - i - 1 degrees of freedom at chance / 2 (n - i + 1).

    Args:
        count: n.
        step: i, from 1.
        chance: of the larger of both sides.
    """
    left = count - step
    t = quantile(left - 1, chance / (left + 1))
    return float(left * t / np.sqrt((left - 1 + t**2) * (left + 1)))


def odd_ones(values: np.ndarray, sigmas: np.ndarray, chance: float) -> tuple[Odd, ...]:
    """Machines apart, by the generalized extreme Studentized deviate.

    The most extreme machine is taken away, then the next, up to three and every fifth; the odd ones
    are all up to the last whose deviate exceeds its critical value, so that two do not hide each
    other (Rosner 1983, Technometrics 25(2), eqs. 2.2 and 2.5). The chance is shared among these
    steps: far out in the tails, Rosner's values alone are too small. Machines must besides differ
    by more than their own standard deviations explain.

    Args:
        values: (m,) one of each machine; NaN where it is not known.
        sigmas: (m,) standard deviations of them.
        chance: that any machine of a fleet of alike machines comes out.
    """
    left = [int(k) for k in np.flatnonzero(np.isfinite(values))]
    count = len(left)
    if count < LEAST:
        return ()
    taken: list[int] = []
    last = 0
    steps = min(_STEPS, count // _SHARE)
    for i in range(1, steps + 1):
        rest = values[left]
        spread = float(np.std(rest, ddof=1))
        if spread <= 0.0:
            break
        most = left[int(np.argmax(np.abs(rest - rest.mean())))]
        deviate = abs(values[most] - rest.mean()) / spread
        left.remove(most)
        taken.append(most)
        last = i if deviate > critical_deviate(count, i, chance / steps) else last
    others = [k for k in np.flatnonzero(np.isfinite(values)) if k not in taken[:last]]
    middle, spread = float(np.median(values[others])), float(np.std(values[others], ddof=1))
    beyond = quantile(1e9, chance / count)
    return tuple(
        Odd(int(k), difference, spread, difference / spread)
        for k in taken[:last]
        for difference in [float(values[k]) - middle]
        if abs(difference) > beyond * sigmas[k]
    )
