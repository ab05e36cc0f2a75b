"""Which sets of known physical parameters suffice: counted, listed, the easiest first.

A set K suffices, generically, if the columns of d data / d unknowns are independent: the unknowns
are independent in the matroid of the Jacobian, so K spans its dual. The dual has a matrix, the
kernel of the Jacobian; it falls apart into components, whose counts multiply. Ranks are taken
modulo a prime of 31 bits at a random point: a rank that is too low by chance is less likely than
one in a million, and the count is repeated at another point with another prime.
"""

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, combinations, islice, product
from math import comb, prod

import numpy as np

from modeler.core.errors import ModelerError
from modeler.core.json import ShortRepr
from modeler.derivation import compute_kernel
from modeler.formulas.physical_system import NumericPolynomial, PhysicalSystem
from modeler.formulas.thresholds import THRESHOLDS

# Sets of columns of a matrix over a prime field that span its rows, many at once.


def find_components(kernel: np.ndarray) -> list[tuple[list[int], list[int]]]:
    """Returns (rows, columns) of the parts of a matrix that share no entry."""
    label = list(range(len(kernel)))
    for k in range(kernel.shape[1]):
        merged = {label[r] for r in np.flatnonzero(kernel[:, k])}
        label = [min(merged) if x in merged else x for x in label]
    parts: list[tuple[list[int], list[int]]] = []
    for x in sorted(set(label)):
        rows = [r for r, y in enumerate(label) if y == x]
        parts.append((rows, [int(k) for k in np.flatnonzero(kernel[rows].any(axis=0))]))
    for k in np.flatnonzero(~kernel.any(axis=0)).tolist():
        parts.append(([], [k]))
    return parts


def enumerate_spanning_sets(
    matrix: np.ndarray, size: int, prime: int
) -> Iterator[tuple[float, np.ndarray]]:
    """Returns (share done, sets of `size` columns that span the rows), in blocks.

    Elimination grows with the set: a column joins a set that comes before it, and the rest of the
    matrix is reduced by it; all sets of a block at once.
    """
    rows, n = matrix.shape
    start = (matrix[None], np.zeros((1, 0), dtype=np.int64), np.zeros(1, dtype=np.int64))
    stack = [start]
    done = 0.0
    total = float(comb(n, size))
    while stack:
        work, sets, rank = stack.pop()
        k = sets.shape[1]
        if k == size:
            done += len(sets)
            yield done / total, sets
            continue
        if k == size - 1 and rows:
            sets = _complete_sets(work, sets, rank, rows)
            done += len(sets)
            yield min(1.0, done / total), sets
            continue
        grown = _extend_sets(work, sets, rank, size, prime)
        for at in range(0, len(grown[0]), THRESHOLDS.sets_per_block):
            part = slice(at, at + THRESHOLDS.sets_per_block)
            stack.append((grown[0][part], grown[1][part], grown[2][part]))


def _complete_sets(work: np.ndarray, sets: np.ndarray, rank: np.ndarray, rows: int) -> np.ndarray:
    """Sets made full by one column more, those that span."""
    n = work.shape[2]
    after = np.arange(n)[None] > (sets[:, -1:] if sets.shape[1] else -1)
    joins: np.ndarray = np.any(work, axis=1)
    fits = after & np.where((rank == rows)[:, None], True, joins & (rank == rows - 1)[:, None])
    which, column = np.nonzero(fits)
    return np.concatenate([sets[which], column[:, None]], axis=1)


def _extend_sets(
    work: np.ndarray, sets: np.ndarray, rank: np.ndarray, size: int, prime: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Every set with every later column, if it can still span in the end."""
    rows, n = work.shape[1:]
    k = sets.shape[1]
    columns = np.arange(n)[None]
    after = (columns > (sets[:, -1:] if k else -1)) & (columns <= n - size + k)
    joins: np.ndarray = np.any(work, axis=1)
    reach = rank[:, None] + joins + (size - k - 1) >= rows
    which, column = np.nonzero(after & reach)
    joined = joins[which, column]
    grown = work[which]
    grown[joined] = reduce_by_column(grown[joined], column[joined], prime)
    return grown, np.concatenate([sets[which], column[:, None]], axis=1), rank[which] + joined


def reduce_by_column(work: np.ndarray, column: np.ndarray, prime: int) -> np.ndarray:
    """Returns matrices reduced by one of their columns, its pivot row set to zero."""
    if not len(work):
        return work
    at = np.arange(len(work))
    entries = work[at, :, column]
    pivot = (entries != 0).argmax(axis=1)
    row = work[at, pivot]
    # No inverse is needed: rows times the pivot have the same zeros.
    scale = entries[at, pivot]
    reduced = work * scale[:, None, None] % prime - entries[:, :, None] * row[:, None, :] % prime
    reduced %= prime
    reduced[at, pivot] = 0
    return reduced


def are_spanning(kernel: np.ndarray, sets: np.ndarray, prime: int) -> np.ndarray:
    """Returns (sets,) True for sets of columns with the rank of the matrix."""
    work = np.broadcast_to(kernel, (len(sets), *kernel.shape)).copy()
    rank = np.zeros(len(sets), dtype=np.int64)
    at = np.arange(len(sets))
    for k in range(sets.shape[1]):
        joins: np.ndarray = np.any(work[at, :, sets[:, k]], axis=1)
        work[joins] = reduce_by_column(work[joins], sets[joins, k], prime)
        rank += joins
    return np.asarray(rank == len(kernel))


# Sets of known parameters.


EASE: Mapping[str, int] = {"mass": 0, "length": 0, "rotor inertia": 1, "centre": 2, "inertia": 3}
"""How hard a parameter is to measure: scales and ruler, data sheet, balancing, pendulum."""


@dataclass(frozen=True)
class KnownSets(ShortRepr):
    """The sets of `size` known parameters that make all others follow.

    Attributes:
        system: data and parameters.
        size: number of known parameters.
        smallest: the least number that suffices: parameters - rank.
        candidate_count: number of sets of that size.
        count: number of those that suffice.
        classes: {(masses and lengths, centres, inertias): how many of them}, rotor inertias with
            the lengths; fewest inertias first, then fewest centres.
        easiest_sets: sets of the easiest class, in order of letters.
        contains: {letter: number of sufficing sets that contain it}.
        seeds: of the random points, which agree.
    """

    system: PhysicalSystem
    size: int
    smallest: int
    candidate_count: int
    count: int
    classes: Mapping[tuple[int, int, int], int]
    easiest_sets: tuple[tuple[str, ...], ...]
    contains: Mapping[str, int]
    seeds: tuple[int, ...]


def count_smallest_set(system: PhysicalSystem) -> int:
    """Returns the smallest number of known parameters from which all others follow."""
    return len(system.letters) - system.compute_rank(system.letters)


def find_easiest_set(system: PhysicalSystem, seed: int = THRESHOLDS.seed) -> tuple[str, ...]:
    """Returns a smallest sufficing set that is easiest to measure.

    Greedy, which is best for a matroid: fewest inertias, of these fewest mass centres.
    """
    kernel, prime = _compute_kernel(system, seed)
    letters = system.letters
    order = sorted(range(len(letters)), key=lambda k: (EASE[system.kinds[letters[k]]], k))
    chosen: list[int] = []
    work = kernel.copy()
    for k in order:
        if len(chosen) == len(kernel):
            break
        if work[:, k].any():
            chosen.append(k)
            work = reduce_by_column(work[None], np.array([k]), prime)[0]
    return tuple(system.letters[k] for k in sorted(chosen))


def find_known_sets(
    system: PhysicalSystem,
    size: int | None = None,
    progress: Callable[[float], None] = lambda share: None,
    seed: int = THRESHOLDS.seed,
) -> KnownSets:
    """Returns all sets of `size` known parameters, smallest number if None, that suffice.

    Args:
        system: data as polynomials of the parameters.
        size: of the sets.
        progress: called with the share done.
        seed: of the random points.

    Raises:
        ModelerError: a size that no set has, or too many sets to look at.
    """
    letters, smallest = system.letters, count_smallest_set(system)
    size = smallest if size is None else size
    if not 0 <= size <= len(letters):
        raise ModelerError(
            f"{system.robot}: got sets of {size}; expected 0 to {len(letters)}, the number of "
            "physical parameters with an effect"
        )
    possible = comb(len(letters), size)
    seeds = (seed, seed + 1)
    if size < smallest:
        return KnownSets(system, size, smallest, possible, 0, {}, (), {}, seeds)
    halves = (lambda share: progress(share / 2), lambda share: progress((1 + share) / 2))
    tables = [_SetCounter(system, size, *x).count_sets() for x in zip(seeds, halves, strict=True)]
    if tables[0] != tables[1]:
        raise ModelerError(f"{system.robot}: two random points disagree; choose another seed")
    table = tables[0]
    order = sorted(table, key=lambda key: (key[2], key[1], key[0]))
    classes = {key: table[key][0] for key in order}
    contains = {x: sum(e[k + 1] for e in table.values()) for k, x in enumerate(letters)}
    easiest = _find_members(system, size, order[0], seed) if order else ()
    count = sum(classes.values())
    return KnownSets(system, size, smallest, possible, count, classes, easiest, contains, seeds)


def _compute_kernel(system: PhysicalSystem, seed: int) -> tuple[np.ndarray, int]:
    """Rows that span the kernel of the Jacobian modulo a prime: the matrix of the dual."""
    prime, columns = system.compute_jacobian_modulo(random.Random(seed))
    n = len(system.letters)
    work = np.zeros((len(system.data), n), dtype=np.int64)
    for k, letter in enumerate(system.letters):
        for i, value in columns[letter].items():
            work[i, k] = value
    return compute_kernel(work, prime), prime


Table = dict[tuple[int, int, int], np.ndarray]
"""{class: (1 + letters,) number of sets, then for each letter of those with it}."""


class _SetCounter:
    """The spanning sets of the dual, per class."""

    def __init__(
        self, system: PhysicalSystem, size: int, seed: int, progress: Callable[[float], None]
    ) -> None:
        self.system, self.size, self.progress = system, size, progress
        self.kernel, self.prime = _compute_kernel(system, seed)
        self.parts = find_components(self.kernel)

    def count_sets(self) -> dict[tuple[int, int, int], list[int]]:
        """Counts the sets of the wanted size, and those with each letter, by class."""
        spare = self.size - len(self.kernel)
        n = len(self.system.letters)
        total: dict[int, Table] = {0: {(0, 0, 0): np.array([1] + [0] * n, dtype=object)}}
        work = sum(self._estimate_work(part, spare) for part in self.parts)
        if work > THRESHOLDS.max_sets:
            raise ModelerError(
                f"{self.system.robot}: about {work:.1e} sets to look at, more than "
                f"{THRESHOLDS.max_sets:.0e}; choose fewer known parameters, or leave --sets "
                "out: the easiest set is found without counting"
            )
        done = 0.0
        for part in self.parts:
            share = self._estimate_work(part, spare)
            count = self._count_part(part, spare, done / work, share / work)
            total = _combine_counts(total, count, spare)
            done += share
        return {key: [int(x) for x in entry] for key, entry in total.get(spare, {}).items()}

    def _estimate_work(self, part: tuple[list[int], list[int]], spare: int) -> float:
        rows, columns = part
        most = min(spare, len(columns) - len(rows)) + 1
        return float(sum(comb(len(columns), len(rows) + more) for more in range(most)))

    def _count_part(
        self, part: tuple[list[int], list[int]], spare: int, start: float, share: float
    ) -> dict[int, Table]:
        """{parameters more than its rank: counts} of one component."""
        rows, columns = part
        matrix = self.kernel[np.ix_(rows, columns)]
        counts_by_surplus: dict[int, Table] = {}
        n = len(self.system.letters)
        ease = np.array([EASE[self.system.kinds[self.system.letters[k]]] for k in columns])
        for more in range(min(spare, len(columns) - len(rows)) + 1):
            counts = counts_by_surplus[more] = {}
            for at, sets in enumerate_spanning_sets(matrix, len(rows) + more, self.prime):
                kinds = ease[sets]
                sums = np.stack([(kinds < 2).sum(1), (kinds == 2).sum(1), (kinds == 3).sum(1)], 1)
                for name in np.unique(sums, axis=0):
                    chosen = sets[(sums == name).all(axis=1)]
                    key = (int(name[0]), int(name[1]), int(name[2]))
                    entry = counts.setdefault(key, np.zeros(n + 1, dtype=object))
                    entry[0] += len(chosen)
                    having = np.bincount(chosen.ravel(), minlength=len(columns))
                    entry[1:][columns] += having.astype(object)
                self.progress(start + share * at)
        return counts_by_surplus


def _combine_counts(a: Mapping[int, Table], b: Mapping[int, Table], spare: int) -> dict[int, Table]:
    """Counts of the unions of sets of two parts."""
    combined: dict[int, Table] = {}
    for (i, first), (j, second) in product(a.items(), b.items()):
        if i + j <= spare:
            table = combined.setdefault(i + j, {})
            for (key, one), (other, two) in product(first.items(), second.items()):
                name = (key[0] + other[0], key[1] + other[1], key[2] + other[2])
                both = one * two[0] + two * one[0]
                both[0] = one[0] * two[0]
                table[name] = table.get(name, 0) + both
    return combined


def _find_members(
    system: PhysicalSystem, size: int, wanted: tuple[int, int, int], seed: int, most: int = 100_000
) -> tuple[tuple[str, ...], ...]:
    """Sufficing sets of one class, found among all sets of that class; () if there are too many."""
    kernel, prime = _compute_kernel(system, seed)
    groups: list[list[int]] = [[], [], []]
    for k, letter in enumerate(system.letters):
        ease = EASE[system.kinds[letter]]
        groups[0 if ease < 2 else ease - 1].append(k)
    if prod(map(comb, map(len, groups), wanted)) > most:
        return ()
    members_of = map(combinations, groups, wanted)
    candidates = (sorted(chain(*parts)) for parts in product(*members_of))
    member_sets = []
    while block := list(islice(candidates, THRESHOLDS.sets_per_block)):
        sets = np.array(block, dtype=np.int64).reshape(len(block), size)
        for members in sets[are_spanning(kernel, sets, prime)]:
            member_sets.append(tuple(system.letters[k] for k in members))
    return tuple(sorted(member_sets, key=lambda s: [system.letters.index(x) for x in s]))


@dataclass(frozen=True)
class RatedSet:
    """How errors grow with one set of known parameters.

    Attributes:
        known_parameters: the set.
        median_error: median over the parameters that follow: per cent of error, root mean square,
            for independent errors of 1 % in every identified quantity and every known parameter.
        largest_error: the largest.
        letter: whose that is.
    """

    known_parameters: tuple[str, ...]
    median_error: float
    largest_error: float
    letter: str


def rate_sets(
    system: PhysicalSystem, sets: Sequence[Sequence[str]], values: Mapping[str, float]
) -> tuple[RatedSet, ...]:
    """Rates the sets by how little errors grow at one robot, the least median first.

    dU = J_U^-1 (dd - J_K dK), d data, U unknowns, K known; parameters that are 0 have no per cent.

    Args:
        system: data as polynomials of the parameters.
        sets: smallest sufficing sets.
        values: of all parameters, SI units; sets that fail there are left out.
    """
    point = system.build_point(values)
    polys = [NumericPolynomial(system.definitions[d]) for d in system.data]
    J = np.array([poly.evaluate_slopes(point) for poly in polys])
    data = np.array([poly.evaluate(point) for poly in polys])
    ratings = []
    for known in sets:
        U = [system.place[x] for x in system.letters if x not in known]
        K = [system.place[x] for x in known]
        inner = J[:, U]
        if inner.shape[0] != inner.shape[1] or np.linalg.matrix_rank(inner) < len(U):
            continue
        G = np.linalg.solve(inner, np.hstack([np.diag(data), -J[:, K] * point[K]]))
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.linalg.norm(G, axis=1) / np.abs(point[U])
        share[~np.isfinite(share)] = np.nan
        k = int(np.nanargmax(share))
        middle, letter = float(np.nanmedian(share)), system.names[U[k]]
        ratings.append(RatedSet(tuple(known), middle, float(share[k]), letter))
    return tuple(sorted(ratings, key=lambda r: (r.median_error, r.largest_error)))
