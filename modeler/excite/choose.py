"""Which of given motions to take: the subset with the smallest condition number."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.excite.criterion import condition

_ALL = 20_000
"""Subsets that are looked at one by one; of more, the best is built up and exchanged."""


@dataclass(frozen=True)
class Choice:
    """A subset of motions.

    Attributes:
        places: of those chosen, in the order given.
        condition: of their rows together, columns of length one.
        whole: of all motions together.
        alone: of each motion by itself.
        exhaustive: True if every subset was looked at.
    """

    places: tuple[int, ...]
    condition: float
    whole: float
    alone: tuple[float, ...]
    exhaustive: bool


def choose(rows: Sequence[np.ndarray], count: int) -> Choice:
    """The `count` motions whose rows together have the smallest condition number.

    How Guegan, Khalil and Lemoine 2003 (section 5) and Gautier and Khalil 1992 choose
    trajectories. All subsets where there are at most 20 000, else one motion after the other and
    then exchanges of one for one as long as they help.

    Args:
        rows: (rows, c) of each motion, weighted.
        count: how many to take.

    Raises:
        DataError: more wanted than given, or no subset that determines all columns.
    """
    if not 1 <= count <= len(rows):
        raise DataError(f"choose: got {count} of {len(rows)} motions; expected 1 to {len(rows)}")
    triangles = [np.asarray(np.linalg.qr(W, mode="r")) for W in rows]

    def value(places: Sequence[int]) -> float:
        return condition(np.vstack([triangles[k] for k in places]))

    exhaustive = math.comb(len(rows), count) <= _ALL
    if exhaustive:
        best = min(itertools.combinations(range(len(rows)), count), key=value)
    else:
        best = _exchanged(triangles, count)
    if not math.isfinite(value(best)):
        raise DataError(
            f"choose: no {count} of these {len(rows)} motions excite all parameters; take more, or "
            "motions that move other joints"
        )
    every = tuple(value([k]) for k in range(len(rows)))
    return Choice(tuple(best), value(best), value(range(len(rows))), every, exhaustive)


def _exchanged(triangles: list[np.ndarray], count: int) -> tuple[int, ...]:
    """Greedy, then one for one: by the weakest singular value first, where columns lack."""
    lengths = np.sqrt(sum(np.sum(R**2, axis=0) for R in triangles))
    scaled = [R / np.where(lengths > 0.0, lengths, 1.0) for R in triangles]

    def value(places: Sequence[int]) -> float:
        sizes = np.linalg.svd(np.vstack([scaled[k] for k in places]), compute_uv=False)
        full = np.zeros(scaled[0].shape[1])
        full[: len(sizes)] = sizes
        # Sum of 1/s^2, bounded so that what lacks rank can still be compared.
        return float(np.sum(1.0 / (full**2 + 1e-12 * full[0] ** 2)))

    chosen: list[int] = []
    left = list(range(len(triangles)))
    while len(chosen) < count:
        chosen.append(min((k for k in left if k not in chosen), key=lambda k: value([*chosen, k])))
    chosen.sort()

    def measured(places: Sequence[int]) -> float:
        return condition(np.vstack([triangles[k] for k in places]))

    here = measured(chosen)
    improving = True
    while improving:
        trials = [
            sorted([*(c for c in chosen if c != out), into])
            for out in chosen for into in left if into not in chosen
        ]  # fmt: skip
        best = min(trials, key=measured)
        improving = measured(best) < here * (1.0 - 1e-12)
        if improving:
            chosen, here = best, measured(best)
    return tuple(chosen)
