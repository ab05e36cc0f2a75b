"""Physical parameters in closed form: given which are known, which others follow, and how.

Elimination over Q: a quantity with one unknown gives it; where none is left, an unknown that
stands linearly in a quantity is taken out of the others. A factor that is zero, or that cannot be
zero, is told by its value at a consistent random point modulo a prime: so no quotient is 0/0.
"""

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from modeler.core.errors import ModelerError
from modeler.terms.identifiability import SEED, value_modulo
from modeler.terms.physical_system import PhysicalSystem
from modeler.terms.relations import independent_modulo
from modeler.terms.ring import Poly

_EASY = ("mass", "length", "centre", "inertia", "rotor inertia")
_LARGEST = 400  # terms of a polynomial that is worth factoring


@dataclass(frozen=True)
class Step:
    """One parameter that follows.

    Attributes:
        letter: its name.
        numerator, denominator: letter = numerator / denominator, polynomials of data, constants,
            known letters and letters of earlier steps.
        equation: a polynomial of degree 2 or more in the letter that is zero, where there is no
            quotient; None otherwise.
    """

    letter: str
    numerator: Poly
    denominator: Poly
    equation: Poly | None = None


@dataclass(frozen=True)
class ClosedSolution:
    """What follows from the data and the known parameters.

    Attributes:
        system: data and parameters.
        known: parameters that are given.
        steps: in an order in which each can be computed.
        undetermined: parameters that do not follow: adding any one of them to the known ones makes
            `missing` one less.
        without_formula: parameters that the data determine, in equations that were not brought to
            one unknown.
        missing: how many parameters more must be known that all follow.
        surplus: number of relations that known parameters and data must satisfy by themselves.
    """

    system: PhysicalSystem
    known: tuple[str, ...]
    steps: tuple[Step, ...]
    undetermined: tuple[str, ...]
    without_formula: tuple[str, ...]
    missing: int
    surplus: int

    @property
    def follows(self) -> tuple[str, ...]:
        """Parameters with a formula, in order."""
        return tuple(step.letter for step in self.steps)


def determined(
    system: PhysicalSystem, known: Iterable[str], seed: int = SEED
) -> tuple[list[str], int]:
    """(parameters that the data determine, rank of their Jacobian): generic, locally unique.

    An unknown x follows if its column of d data / d unknowns is no combination of the others.
    """
    given = set(known)
    unknown = [x for x in system.letters if x not in given]
    prime, columns = system.jacobian_modulo(random.Random(seed))
    vectors = [columns[x] for x in unknown]
    rank = len(independent_modulo(vectors, prime))
    if rank == len(unknown):
        return unknown, rank
    found = []
    for i, x in enumerate(unknown):
        others = vectors[:i] + vectors[i + 1 :]
        if len(independent_modulo(others, prime)) < rank:
            found.append(x)
    return found, rank


def solve(system: PhysicalSystem, known: Iterable[str], seed: int = SEED) -> ClosedSolution:
    """The parameters that follow from data and known parameters, in closed form.

    Args:
        system: data as polynomials of the parameters.
        known: names of parameters of it.
        seed: of the random points.
    """
    given = tuple(x for x in system.letters if x in set(known))
    follow, rank = determined(system, given, seed)
    unknown = [x for x in system.letters if x not in given]
    steps = _Elimination(system, unknown, follow, random.Random(seed)).run()
    have = {step.letter for step in steps}
    return ClosedSolution(
        system,
        given,
        tuple(steps),
        tuple(x for x in unknown if x not in follow),
        tuple(x for x in follow if x not in have),
        len(unknown) - rank,
        len(system.data) - rank,
    )


class _Elimination:
    """Unknowns get formulas one by one; each has the equations as defined to begin with.

    An unknown with a formula counts as known for the others: so formulas stay short.
    """

    def __init__(
        self, system: PhysicalSystem, unknown: Sequence[str], follow: Sequence[str],
        chance: random.Random,
    ) -> None:  # fmt: skip
        self.system = system
        self.place = system.place
        self.prime, self.point = system.modular_point(chance)
        gens = system.ring.gens
        self.defined = [p - gens[self.place[d]] for d, p in system.definitions.items()]
        self.equations = self.defined
        self.open, self.wanted = set(unknown), set(follow)

    def run(self) -> list[Step]:
        """The steps, in order."""
        steps: list[Step] = []
        while self.wanted:
            step = self._direct(self.wanted) or self._from_several()
            if step is None:
                break
            steps.append(step)
            self.open.discard(step.letter)
            self.wanted.discard(step.letter)
        return steps

    def _from_several(self) -> Step | None:
        """The unknown that the fewest equations tell, by elimination in these."""
        unsolved = set(self.open)
        for letter, needed in self._needed():
            self.equations, self.open = [self.defined[i] for i in needed], set(unsolved)
            step = self._direct({letter})
            while step is None and self._eliminate(letter):
                step = self._direct({letter})
            step = step or self._root(letter)
            self.equations, self.open = self.defined, set(unsolved)
            if step is not None:
                return step
        return None

    def _needed(self) -> list[tuple[str, list[int]]]:
        """(letter, equations that tell it, none of them too many), the fewest first.

        They tell x if the unit vector of x is a combination of their rows of the Jacobian.
        """
        letters = [x for x in self.system.letters if x in self.open]
        rows = [
            {k: value_modulo(self.system.slopes[x][i], self.point, self.prime)
             for k, x in enumerate(letters) if self.system.slopes[x][i]}
            for i in range(len(self.defined))
        ]  # fmt: skip
        order = sorted(range(len(rows)), key=lambda i: -len(self.defined[i]))
        found = []
        for letter in sorted(self.wanted):
            at = letters.index(letter)
            keep = [i for i in order if rows[i]]
            for i in list(keep):
                fewer = [k for k in keep if k != i]
                if self._told([rows[k] for k in fewer], at):
                    keep = fewer
            kind = _EASY.index(self.system.kinds[letter])
            found.append((len(keep), kind, letter, sorted(keep)))
        return [(letter, keep) for _, _, letter, keep in sorted(found)]

    def _told(self, rows: Sequence[Mapping[int, int]], at: int) -> bool:
        """Is the unit vector of that place a combination of the rows?"""
        rank = len(independent_modulo(rows, self.prime))
        return len(independent_modulo([*rows, {at: 1}], self.prime)) == rank

    def _used(self, poly: Poly) -> set[str]:
        names = self.system.names
        return {names[i] for at in poly for i, e in enumerate(at) if e}

    def _unknowns(self, poly: Poly) -> set[str]:
        """Unknowns in it that have no formula yet."""
        return self._used(poly) & self.open

    def _zero(self, poly: Poly) -> bool:
        """Is it zero for every robot, as far as a consistent random point tells?"""
        return value_modulo(poly, self.point, self.prime) == 0

    def _direct(self, wanted: set[str]) -> Step | None:
        """A quotient for an unknown that stands alone in an equation, the shortest first."""
        for poly in sorted(self.equations, key=len):
            letters = self._unknowns(poly)
            if len(letters) == 1 and letters <= wanted:
                step = self._quotient(poly, next(iter(letters)))
                if step is not None:
                    return step
        return None

    def _root(self, letter: str) -> Step | None:
        """A polynomial of the one unknown, of the lowest degree."""
        alone = [p for p in self.equations if self._unknowns(p) == {letter}]
        if not alone:
            return None
        ring = self.system.ring
        best = min(alone, key=lambda p: (_degree(p, self.place[letter]), len(p)))
        return Step(letter, ring.zero, ring.one, best)

    def _quotient(self, poly: Poly, letter: str) -> Step | None:
        """The letter from a linear equation; None if it is not linear or tells nothing."""
        place = self.place[letter]
        if _degree(poly, place) != 1:
            return None
        slope, rest = _split(poly, place)[1], _split(poly, place)[0]
        if self._zero(slope):
            return None
        numerator, denominator = _reduced(-rest, slope)
        return Step(letter, numerator, denominator)

    def _eliminate(self, wanted: str) -> bool:
        """Take an unknown out of all equations but one, where that is linear in it."""
        choices = []
        for at, poly in enumerate(self.equations):
            letters = self._unknowns(poly)
            for letter in letters - {wanted}:
                if _degree(poly, self.place[letter]) == 1:
                    choices.append((self._cost(poly, letter), at, letter))
        for _, at, letter in sorted(choices):
            step = self._quotient(self.equations[at], letter)
            if step is None:
                continue
            others = self.equations[:at] + self.equations[at + 1 :]
            self.open.discard(letter)
            self.equations = [self._without(poly, step) for poly in others]
            self.equations = [poly for poly in self.equations if poly]
            return all(len(poly) <= _LARGEST for poly in self.equations)
        return False

    def _cost(self, poly: Poly, letter: str) -> tuple[int, ...]:
        """Small for what is quickly done: few other unknowns, few other places."""
        place = self.place[letter]
        slope = _split(poly, place)[1]
        return (
            len(self._unknowns(poly)),
            len(self._unknowns(slope)),
            sum(_degree(other, place) for other in self.equations),
            -_EASY.index(self.system.kinds[letter]),
            len(poly),
        )

    def _without(self, poly: Poly, step: Step) -> Poly:
        """The equation with the step put in, and only its factor that is zero."""
        place = self.place[step.letter]
        top = _degree(poly, place)
        if top == 0:
            return poly
        parts = _split(poly, place)
        total = poly.ring.zero
        for degree, part in parts.items():
            total += part * step.numerator**degree * step.denominator ** (top - degree)
        total = self.system.normal(total)
        if not self._unknowns(total):
            return poly.ring.zero
        if len(total) > _LARGEST:
            return total
        for factor, _ in total.factor_list()[1]:
            if self._zero(factor):
                return factor
        raise ModelerError(
            f"{self.system.robot}: no factor of {total} is zero at a random point; another seed"
        )


def _degree(poly: Poly, place: int) -> int:
    return max((at[place] for at in poly), default=0)


def _split(poly: Poly, place: int) -> dict[int, Poly]:
    """{degree in a generator: factor}; degrees 0 and 1 always."""
    found: dict[int, dict[tuple[int, ...], object]] = {0: {}, 1: {}}
    for at, value in poly.items():
        found.setdefault(at[place], {})[(*at[:place], 0, *at[place + 1 :])] = value
    return {degree: poly.ring.zero.new(part) for degree, part in found.items()}


def _reduced(numerator: Poly, denominator: Poly) -> tuple[Poly, Poly]:
    """The quotient in lowest terms, the denominator with whole numbers and a positive lead."""
    if denominator.is_ground:
        return numerator.quo_ground(denominator.LC), denominator.ring.one
    _, top, bottom = _cofactors(numerator, denominator)
    content, bottom = bottom.primitive()
    if bottom.LC < 0:
        content, bottom = -content, -bottom
    return top.quo_ground(content), bottom


def _cofactors(a: Poly, b: Poly) -> tuple[Poly, Poly, Poly]:
    return a.cofactors(b) if a else (b, a, b.ring.one)
