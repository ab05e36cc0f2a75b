"""Which columns the data can tell apart."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import qr, solve_triangular

TOLERANCE = 1e-8
"""Pivots below this share of the first, columns scaled to length one, count as zero. Dependencies
by structure or by a joint that stands still come out near 1e-15, weakly excited parameters on
real logs above 1e-4."""

_IDLE = 1e-12  # a column this short beside the longest one is zero
_TOLD = 1e-3  # share of a column's length that another must carry to be named


@dataclass(frozen=True)
class Tangle:
    """A column that was set aside.

    Attributes:
        name: its parameter.
        into: kept parameters whose columns reproduce it; empty if the column is zero.
        pivot: its pivot, as a share of the first.
    """

    name: str
    into: tuple[str, ...]
    pivot: float

    def sentence(self) -> str:
        """What happened and what to do."""
        if not self.into:
            return (
                f"{self.name} is not excited: its column is zero on these data; it is set to 0; "
                "move the joints it belongs to"
            )
        return (
            f"{self.name} cannot be told from {', '.join(self.into)} on these data (pivot "
            f"{self.pivot:.1g}, tolerance {TOLERANCE:g}): it is set to 0 and they carry its "
            "effect; record a motion that moves all joints over a wide range"
        )


@dataclass(frozen=True)
class Rank:
    """Columns kept (indices, ascending), columns set aside, and the gap between them.

    Attributes:
        kept: indices.
        aside: one entry per column set aside.
        last_kept: smallest pivot kept, as a share of the first.
        first_dropped: largest pivot dropped; 0 if none.
    """

    kept: tuple[int, ...]
    aside: tuple[Tangle, ...]
    last_kept: float
    first_dropped: float


def independent_columns(R: np.ndarray, names: Sequence[str]) -> Rank:
    """Independent columns of R (or W), by QR with column pivoting of the scaled columns.

    Args:
        R: (rows, c).
        names: (c,).
    """
    lengths = np.linalg.norm(R, axis=0)
    active = np.flatnonzero(lengths > _IDLE * lengths.max(initial=0.0))
    aside = [Tangle(names[i], (), 0.0) for i in range(len(names)) if i not in set(active)]
    if not active.size:
        return Rank((), tuple(aside), 0.0, 0.0)
    triangle, order = qr(R[:, active] / lengths[active], mode="r", pivoting=True)
    pivots = np.abs(np.diag(triangle)) / abs(triangle[0, 0])
    rank = int(np.sum(pivots > TOLERANCE))
    kept, dropped = active[order[:rank]], active[order[rank:]]
    if len(dropped):
        shares = solve_triangular(triangle[:rank, :rank], triangle[:rank, rank:])
        for position, column in enumerate(dropped):
            share = shares[:, position]
            into = tuple(names[kept[i]] for i in np.argsort(-np.abs(share))
                         if abs(share[i]) > _TOLD)  # fmt: skip
            pivot = pivots[rank + position] if rank + position < len(pivots) else 0.0
            aside.append(Tangle(names[column], into[:6], float(pivot)))
    return Rank(
        kept=tuple(int(i) for i in sorted(kept)),
        aside=tuple(aside),
        last_kept=float(pivots[rank - 1]),
        first_dropped=float(pivots[rank]) if rank < len(pivots) else 0.0,
    )
