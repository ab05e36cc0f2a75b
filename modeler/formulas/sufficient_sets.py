"""Which sets of known physical parameters suffice: counted, listed, the easiest first.

A set K suffices, generically, if the columns of d data / d unknowns are independent: the unknowns
are independent in the matroid of the Jacobian, so K spans its dual. The dual has a matrix, the
kernel of the Jacobian; it falls apart into components, whose counts multiply. Ranks are taken
modulo a prime of 31 bits at a random point: a rank that is too low by chance is less likely than
one in a million, and the count is repeated at another point with another prime.
"""

import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import combinations, islice
from math import comb

import numpy as np

from modeler.core.brief import Brief
from modeler.core.errors import ModelerError
from modeler.formulas.coefficients import BLOCK, components, reduced_by, span, spanning_sets
from modeler.formulas.identifiability import SEED
from modeler.formulas.physical_system import PhysicalSystem

EASE: Mapping[str, int] = {
    "mass": 0, "length": 0, "rotor inertia": 1, "centre": 2, "inertia": 3,
}  # fmt: skip
"""How hard a parameter is to measure: scales and ruler, data sheet, balancing, pendulum."""

MOST = 30_000_000  # sets of one component that are looked at


@dataclass(frozen=True)
class KnownSets(Brief):
    """The sets of `size` known parameters that make all others follow.

    Attributes:
        system: data and parameters.
        size: number of known parameters.
        smallest: the least number that suffices: parameters - rank.
        possible: number of sets of that size.
        count: number of those that suffice.
        classes: {(masses and lengths, centres, inertias): how many of them}, rotor inertias with
            the lengths; fewest inertias first, then fewest centres.
        easiest: sets of the easiest class, in order of letters.
        contains: {letter: number of sufficing sets that contain it}.
        seeds: of the random points, which agree.
    """

    system: PhysicalSystem
    size: int
    smallest: int
    possible: int
    count: int
    classes: Mapping[tuple[int, int, int], int]
    easiest: tuple[tuple[str, ...], ...]
    contains: Mapping[str, int]
    seeds: tuple[int, ...]


def smallest_number(system: PhysicalSystem) -> int:
    """How many parameters must be known at least that all others follow."""
    return len(system.letters) - system.rank(system.letters)


def easiest_set(system: PhysicalSystem, seed: int = SEED) -> tuple[str, ...]:
    """A smallest sufficing set that is measured with the least trouble.

    Greedy, which is best for a matroid: fewest inertias, of these fewest mass centres.
    """
    kernel, prime = _kernel(system, seed)
    order = sorted(range(len(system.letters)), key=lambda k: _trouble(system, k))
    chosen: list[int] = []
    work = kernel.copy()
    for k in order:
        if len(chosen) == len(kernel):
            break
        if work[:, k].any():
            chosen.append(k)
            work = reduced_by(work[None], np.array([k]), prime)[0]
    return tuple(system.letters[k] for k in sorted(chosen))


def known_sets(
    system: PhysicalSystem,
    size: int | None = None,
    tell: Callable[[float], None] = lambda share: None,
    seed: int = SEED,
) -> KnownSets:
    """All sets of `size` known parameters, smallest number if None, that suffice.

    Args:
        system: data as polynomials of the parameters.
        size: of the sets.
        tell: called with the share done.
        seed: of the random points.

    Raises:
        ModelerError: a size that no set has, or too many sets to look at.
    """
    letters, smallest = system.letters, smallest_number(system)
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
    tables = [_Counted(system, size, s, _part(tell, i)).table() for i, s in enumerate(seeds)]
    if tables[0] != tables[1]:
        raise ModelerError(f"{system.robot}: two random points disagree; choose another seed")
    table = tables[0]
    order = sorted(table, key=lambda key: (key[2], key[1], key[0]))
    classes = {key: table[key][0] for key in order}
    contains = {x: sum(e[1][k] for e in table.values()) for k, x in enumerate(letters)}
    easiest = _members(system, size, order[0], seed) if order else ()
    count = sum(classes.values())
    return KnownSets(system, size, smallest, possible, count, classes, easiest, contains, seeds)


def _part(tell: Callable[[float], None], number: int) -> Callable[[float], None]:
    return lambda share: tell((number + share) / 2)


def _trouble(system: PhysicalSystem, k: int) -> tuple[int, int]:
    return EASE[system.kinds[system.letters[k]]], k


def _kernel(system: PhysicalSystem, seed: int) -> tuple[np.ndarray, int]:
    """Rows that span the kernel of the Jacobian modulo a prime: the matrix of the dual."""
    prime, columns = system.jacobian_modulo(random.Random(seed))
    n = len(system.letters)
    work = np.zeros((len(system.data), n), dtype=np.int64)
    for k, letter in enumerate(system.letters):
        for i, value in columns[letter].items():
            work[i, k] = value
    pivots: list[int] = []
    for k in range(n):
        rows = np.flatnonzero(work[len(pivots) :, k])
        if not len(rows):
            continue
        r = len(pivots)
        work[[r, r + rows[0]]] = work[[r + rows[0], r]]
        work[r] = work[r] * pow(int(work[r, k]), -1, prime) % prime
        for i in range(len(work)):
            if i != r and work[i, k]:
                work[i] = (work[i] - work[i, k] * work[r]) % prime
        pivots.append(k)
        if len(pivots) == len(work):
            break
    free = [k for k in range(n) if k not in pivots]
    kernel = np.zeros((len(free), n), dtype=np.int64)
    for row, k in enumerate(free):
        kernel[row, k] = 1
        for r, pivot in enumerate(pivots):
            kernel[row, pivot] = -work[r, k] % prime
    return kernel, prime


Entry = tuple[int, tuple[int, ...]]
Table = dict[tuple[int, int, int], Entry]
"""{class: (number of sets, per letter the number of them with it)}."""


class _Counted:
    """The spanning sets of the dual, per class."""

    def __init__(
        self, system: PhysicalSystem, size: int, seed: int, tell: Callable[[float], None]
    ) -> None:
        self.system, self.size, self.tell = system, size, tell
        self.kernel, self.prime = _kernel(system, seed)
        self.parts = components(self.kernel)

    def table(self) -> Table:
        """Counts of sets of the wanted size."""
        spare = self.size - len(self.kernel)
        n = len(self.system.letters)
        total: dict[int, Table] = {0: {(0, 0, 0): (1, (0,) * n)}}
        work = sum(self._work(part, spare) for part in self.parts)
        if work > MOST:
            raise ModelerError(
                f"{self.system.robot}: about {work:.1e} sets to look at, more than {MOST:.0e}; "
                "choose fewer known parameters, or leave --sets out: the easiest set is told "
                "without counting"
            )
        done = 0.0
        for part in self.parts:
            share = self._work(part, spare)
            total = _product(total, self._part_table(part, spare, done / work, share / work), spare)
            done += share
        return total.get(spare, {})

    def _work(self, part: tuple[list[int], list[int]], spare: int) -> float:
        rows, columns = part
        return float(
            sum(comb(len(columns), len(rows) + more)
                for more in range(min(spare, len(columns) - len(rows)) + 1))
        )  # fmt: skip

    def _part_table(
        self, part: tuple[list[int], list[int]], spare: int, start: float, share: float
    ) -> dict[int, Table]:
        """{parameters more than its rank: counts} of one component."""
        rows, columns = part
        matrix = self.kernel[np.ix_(rows, columns)]
        found: dict[int, Table] = {}
        n = len(self.system.letters)
        ease = np.array([EASE[self.system.kinds[self.system.letters[k]]] for k in columns])
        for more in range(min(spare, len(columns) - len(rows)) + 1):
            counts: dict[tuple[int, int, int], np.ndarray] = {}
            for at, sets in spanning_sets(matrix, len(rows) + more, self.prime):
                kinds = ease[sets]
                easy, centres, hard = ((kinds < 2).sum(1), (kinds == 2).sum(1), (kinds == 3).sum(1))
                keys = (easy * 1000 + centres) * 1000 + hard
                for key in np.unique(keys):
                    chosen = sets[keys == key]
                    name = (int(key) // 1000000, int(key) // 1000 % 1000, int(key) % 1000)
                    entry = counts.setdefault(name, np.zeros(n + 1, dtype=np.int64))
                    entry[0] += len(chosen)
                    entry[1:][columns] += np.bincount(chosen.ravel(), minlength=len(columns))
                self.tell(start + share * at)
            found[more] = {k: (int(e[0]), tuple(map(int, e[1:]))) for k, e in counts.items()}
        return found


def _product(a: Mapping[int, Table], b: Mapping[int, Table], spare: int) -> dict[int, Table]:
    """Counts of the unions of sets of two parts."""
    found: dict[int, Table] = {}
    for i, first in a.items():
        for j, second in b.items():
            if i + j > spare:
                continue
            table = found.setdefault(i + j, {})
            for key, (count, with_it) in first.items():
                for other, (times, with_other) in second.items():
                    name = (key[0] + other[0], key[1] + other[1], key[2] + other[2])
                    old, old_with = table.get(name, (0, (0,) * len(with_it)))
                    new = tuple(
                        x + p * times + q * count
                        for x, p, q in zip(old_with, with_it, with_other, strict=True)
                    )
                    table[name] = (old + count * times, new)
    return found


def _members(
    system: PhysicalSystem, size: int, wanted: tuple[int, int, int], seed: int, most: int = 100_000
) -> tuple[tuple[str, ...], ...]:
    """Sufficing sets of one class, found among all sets of that class; () if there are too many."""
    kernel, prime = _kernel(system, seed)
    groups: list[list[int]] = [[], [], []]
    for k, letter in enumerate(system.letters):
        ease = EASE[system.kinds[letter]]
        groups[0 if ease < 2 else ease - 1].append(k)
    number = 1
    for group, count in zip(groups, wanted, strict=True):
        number *= comb(len(group), count)
    if number > most:
        return ()
    candidates = (
        sorted((*a, *b, *c))
        for a in combinations(groups[0], wanted[0])
        for b in combinations(groups[1], wanted[1])
        for c in combinations(groups[2], wanted[2])
    )
    found = []
    while block := list(islice(candidates, BLOCK)):
        sets = np.array(block, dtype=np.int64).reshape(len(block), size)
        for members in sets[span(kernel, sets, prime)]:
            found.append(tuple(system.letters[k] for k in members))
    return tuple(sorted(found, key=lambda s: [system.letters.index(x) for x in s]))
