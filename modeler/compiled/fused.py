"""Triangles of [W_j y_j], joint by joint, while samples pass: W is never built.

Samples are reduced in blocks of a fixed size, each from a state of zeros, and the states are merged
in the order of the blocks: results depend on nothing but the samples, however many threads there
are.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.compiled.bind_fused import Functions, FusedLibrary, Samples, fused_library
from modeler.compiled.threads import mapped

BLOCK = 16384
"""Samples that are reduced by themselves."""

PAST = 64
"""Rows that are multiplied with each other are at most so many samples apart."""

_DENSE = 4096  # those of a robot whose whole regressor is evaluated: 13 MB of 400 values each


@dataclass(frozen=True, eq=False)
class Pattern:
    """Which columns can enter the rows of each joint; n joints, c columns.

    Attributes:
        columns: of each joint, ascending.
        width: c.
    """

    columns: tuple[np.ndarray, ...]
    width: int

    @cached_property
    def sizes(self) -> list[int]:
        """Of the packed triangles: columns and torque, then zeros up to a multiple of 4."""
        return [(len(own) + 1 + 3) // 4 * 4 for own in self.columns]

    @cached_property
    def rows_of_entries(self) -> np.ndarray:
        """(entries,) joint of each entry, joint after joint."""
        counts = [len(own) for own in self.columns]
        return np.repeat(np.arange(len(counts), dtype=np.intc), counts)

    def parts(self, packed: np.ndarray) -> list[np.ndarray]:
        """The square triangle of each joint, views."""
        ends = np.cumsum([size * size for size in self.sizes])
        return [
            part.reshape(size, size)
            for part, size in zip(np.split(packed, ends[:-1]), self.sizes, strict=True)
        ]


def pattern_of(entries: Sequence[tuple[int, int]], joints: int, width: int) -> Pattern:
    """The pattern of (joint, column) entries."""
    columns = [sorted(c for joint, c in entries if joint == j) for j in range(joints)]
    return Pattern(tuple(np.array(own, dtype=np.intc) for own in columns), width)


@dataclass(frozen=True, eq=False)
class Triangles:
    """R of [W_j y_j] = Q R for the rows of each joint; n joints, c columns.

    Attributes:
        pattern: which columns each joint has.
        packed: the triangles over these columns only, one after another.
        rows: (n,) rows that were added.
        left_out: (samples,) of the last call: True where a row in use was not finite.
    """

    pattern: Pattern
    packed: np.ndarray
    rows: np.ndarray
    left_out: np.ndarray

    @property
    def triangles(self) -> np.ndarray:
        """(n, c + 1, c + 1) over all columns and the torque; 0 for columns a joint does not have.

        ||y_j - W_j beta|| = ||R_j [-beta; 1]||.
        """
        size = self.pattern.width + 1
        whole = np.zeros((len(self.rows), size, size))
        parts = self.pattern.parts(self.packed)
        for own, columns, part in zip(whole, self.pattern.columns, parts, strict=True):
            places = np.append(columns, size - 1)
            own[np.ix_(places, places)] = part[: len(places), : len(places)]
        return whole


def no_rows(pattern: Pattern) -> Triangles:
    """The triangles of no rows."""
    packed = np.zeros(sum(size * size for size in pattern.sizes))
    rows = np.zeros(len(pattern.columns), dtype=np.uintp)
    return Triangles(pattern, packed, rows, np.zeros(0, dtype=bool))


def of_samples(
    pattern: Pattern, functions: Functions, given: Samples, state: Triangles | None = None,
    level: int = 0,
) -> Triangles:  # fmt: skip
    """Triangles of samples whose entries a compiled function evaluates, sample by sample.

    Args:
        pattern: of the entries, whose order is joint after joint.
        functions: that evaluate them.
        given: checked arrays.
        state: of earlier samples, which these are added to.
        level: of instructions; 0: the best of this processor.
    """
    library = fused_library()

    def one(block: slice) -> Triangles:
        own, part = no_rows(pattern), given.part(block)
        bad = library.triangles(
            pattern.rows_of_entries, functions, part, level, own.packed, own.rows
        )
        return Triangles(pattern, own.packed, own.rows, bad)

    return _merged(library, pattern, mapped(one, _blocks(len(given.q), BLOCK)), state)


def products_of_samples(
    pattern: Pattern, functions: Functions, given: Samples, last: np.ndarray, first: int = 0
) -> list[np.ndarray]:
    """Sums over t of x_j(t - k) x_j(t)^T, x_j = [W_j y_j], for k = first .. last_j, joint by joint.

    Rows out of use, and of samples with a row that is not finite, count as zeros; k = 0 is the Gram
    matrix. Threads and blocks as for triangles.

    Args:
        pattern: of the entries, whose order is joint after joint.
        functions: that evaluate them.
        given: checked arrays, samples one step apart.
        last: (n,) at most `PAST`.
        first: smallest k.

    Returns:
        (last_j - first + 1, k + 1, k + 1) of each joint, over its own k columns and the torque.
    """
    library, lags = fused_library(), np.ascontiguousarray(last, dtype=np.intc)
    assert lags.max(initial=0) <= PAST and len(lags) == len(pattern.columns)
    rows, counts = pattern.rows_of_entries, [max(int(lag) - first + 1, 0) for lag in lags]
    sizes = [count * size * size for count, size in zip(counts, pattern.sizes, strict=True)]

    def one(block: slice) -> np.ndarray:
        out, past, level = np.zeros(sum(sizes)), min(PAST, block.start), library.level()
        part = given.part(slice(block.start - past, block.stop))
        library.products(rows, functions, part, past, level, first, lags, out)
        return out

    total = np.zeros(sum(sizes))
    for part in mapped(one, _blocks(len(given.q), BLOCK)):
        total += part
    parts = np.split(total, np.cumsum(sizes)[:-1])
    return [
        part.reshape(count, size, size)[:, : len(own) + 1, : len(own) + 1]
        for part, count, size, own in zip(
            parts, counts, pattern.sizes, pattern.columns, strict=True
        )
    ]


def of_dense(
    pattern: Pattern,
    evaluate: Callable[[slice], tuple[np.ndarray, np.ndarray]],
    given: Samples,
    state: Triangles | None = None,
) -> Triangles:
    """Triangles of samples whose whole regressor is evaluated, some at a time.

    Args:
        pattern: of the entries.
        evaluate: (b, n, c) of the b samples of a block, and (b,) True where it has no value.
        given: checked arrays.
        state: of earlier samples, which these are added to.
    """
    library = fused_library()

    def one(block: slice) -> Triangles:
        phi, without = evaluate(block)
        part = given.part(block)
        use = np.ones(part.tau.shape, dtype=bool) if part.use is None else part.use
        tau, known = part.tau, np.isfinite(phi).all(axis=2) & np.isfinite(part.tau)
        if part.weight is not None:
            phi, tau = phi * part.weight[:, :, None], tau * part.weight
            known &= np.isfinite(part.weight)
        left = (use & (~known | without[:, None])).any(axis=1)
        own = of_rows(pattern, phi, tau, use & ~left[:, None])
        return Triangles(pattern, own.packed, own.rows, left)

    return _merged(library, pattern, mapped(one, _blocks(len(given.q), _DENSE)), state)


def of_rows(
    pattern: Pattern, phi: np.ndarray, y: np.ndarray, use: np.ndarray | None,
    state: Triangles | None = None, level: int = 0,
) -> Triangles:  # fmt: skip
    """Triangles of rows that stand in memory.

    Args:
        pattern: which columns to use.
        phi: (b, n, c); copied unless C-contiguous.
        y: (b, n).
        use: (b, n) bool; None for all.
        state: of earlier rows, which these are added to.
        level: of instructions; 0: the best of this processor.
    """
    library, before = fused_library(), no_rows(pattern) if state is None else state
    packed, rows, phi = before.packed.copy(), before.rows.copy(), np.ascontiguousarray(phi)
    kept = None if use is None else use.view(np.uint8)
    for j, (columns, triangle) in enumerate(
        zip(pattern.columns, pattern.parts(packed), strict=True)
    ):
        flags = None if kept is None else kept[:, j]
        added, _ = library.rows(phi[:, j], y[:, j], flags, columns, level, triangle)
        rows[j] += np.uintp(added)
    return Triangles(pattern, packed, rows, np.zeros(0, dtype=bool))


def _merged(
    library: FusedLibrary,
    pattern: Pattern,
    parts: Iterable[Triangles],
    state: Triangles | None,
) -> Triangles:
    """The rows of all parts, added to those of a state."""
    found = no_rows(pattern) if state is None else state
    packed, rows, left = found.packed.copy(), found.rows.copy(), [np.zeros(0, dtype=bool)]
    fresh = state is None
    for part in parts:
        if fresh:
            packed, fresh = part.packed, False
        else:
            library.merge(pattern.rows_of_entries, len(rows), packed, part.packed)
        rows += part.rows
        left.append(part.left_out)
    return Triangles(pattern, packed, rows, np.concatenate(left))


def _blocks(samples: int, size: int) -> list[slice]:
    return [slice(i, min(i + size, samples)) for i in range(0, samples, size)]
