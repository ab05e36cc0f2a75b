"""Whether loops imply linear relations: a proof, in letters or at the given values.

Let f(u) = 0 be r independent closure equations with a regular home u0, so that the closed
postures near u0 are a manifold V of dimension n - r. Let L be the postures that fulfil k linear
relations, u0 among them. If the functions f restricted to L span a space of dimension r - k only,
then r - k of them cut out of L (dimension n - k) a set of dimension n - r or more through u0, on
which the others vanish too: it lies in V and has the dimension of V, so the two coincide near u0,
and, both being analytic, on the whole branch of closed postures that is connected with u0. So every
relation holds there. (A parallelogram: both equations vanish identically, r - k = 0.)

The dimension of the span is a rank of exact functions: values with 40 digits at random postures of
L, and at random lengths and angles where the relations are to hold in letters. What is of lower
rank there to 25 digits is so identically.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

import numpy as np

from modeler.core.expression import FUNCTIONS, Expression
from modeler.core.rounded import precise
from modeler.robot import Robot
from modeler.symbolic.closure import Closure
from modeler.symbolic.graph import Graph
from modeler.symbolic.precise import Number, decimal, precise_values

_SEED = 47
_SPARE = 3
_DIGITS = 25
_MOST_TRIES = 64
_CHANGE = 0.1
"""Relative, of lengths and angles where a relation is to hold in letters."""


@dataclass(frozen=True)
class Proposal:
    """A relation to be proven: the variable `pivot` of u equals `expression` of the others."""

    pivot: int
    expression: Expression


class Prover:
    """Tells which relations the loops of a robot imply on the branch of home."""

    def __init__(
        self, closure: Closure, graph: Graph, robot: Robot, values: Mapping[str, float]
    ) -> None:
        """A prover for the loops of a robot.

        Args:
            closure: the loops.
            graph: of their equations.
            robot: whose symbols and variables the relations name.
            values: of the geometric symbols of the equations.
        """
        self.closure, self.graph, self.robot, self.values = closure, graph, robot, values

    def proves(self, relations: Sequence[Proposal], letters: bool) -> bool:
        """True if the loops imply all these relations together.

        Args:
            relations: that home fulfils.
            letters: True for all lengths and angles, False for the given ones only.
        """
        rng = np.random.default_rng(_SEED)
        geometry = self._symbols(rng, letters)
        left = len(self.closure.equations) - len(relations)
        rows = []
        for _ in range(left + _SPARE):
            at = {**geometry, **self._posture(relations, rng, geometry)}
            rows.append(precise_values(self.graph, self.closure.equations, at))
        return _rank(rows) <= left

    def _symbols(self, rng: np.random.Generator, letters: bool) -> dict[str, Number]:
        """Numbers for all symbols: as given, or random near that."""
        known: dict[str, Number] = {}
        for name, expression in self.robot.symbols.items():
            if name in self.values:
                change = float(rng.uniform(-_CHANGE, _CHANGE)) if letters else 0.0
                known[name] = decimal(self.values[name]) * (1 + decimal(change))
            else:
                known[name] = _folded(expression, known)
        return known

    def _posture(
        self,
        relations: Sequence[Proposal],
        rng: np.random.Generator,
        geometry: Mapping[str, Number],
    ) -> dict[str, Number]:
        """Random values of `q[k]` that fulfil the relations."""
        u = [
            decimal(float(at + rng.uniform(-1.0, 1.0) * (self.closure.size if length else 1.0)))
            for at, length in zip(self.closure.home, self.closure.lengths, strict=True)
        ]
        names = [joint.variable for joint in self.robot.free]
        known = {**geometry, **dict(zip(names, u, strict=True))}
        for relation in relations:
            u[relation.pivot] = _folded(relation.expression, known)
        return {f"q[{k}]": value for k, value in enumerate(u)}


def _folded(expression: Expression, known: Mapping[str, Number]) -> Number:
    mp = precise()
    functions = {name: getattr(mp, name) for name in FUNCTIONS if name != "abs"} | {"abs": abs}
    return expression.fold(known, functions, +mp.pi, _number, mp.power)


def _number(value: Fraction) -> Number:
    return precise().mpf(value.numerator) / value.denominator


def _rank(rows: Sequence[Sequence[Number]]) -> int:
    """Rank of a matrix of numbers of 40 digits, each column counted relative to its largest."""
    mp = precise()
    matrix = [list(row) for row in rows]
    nothing = mp.mpf(10) ** -_DIGITS
    rank = 0
    for column in range(len(matrix[0])):
        below = matrix[rank:]
        if not below:
            break
        best = max(range(len(below)), key=lambda i: abs(below[i][column]))
        if abs(below[best][column]) < nothing:
            continue
        matrix[rank], matrix[rank + best] = matrix[rank + best], matrix[rank]
        pivot = matrix[rank]
        for i in range(rank + 1, len(matrix)):
            factor = matrix[i][column] / pivot[column]
            matrix[i] = [x - factor * y for x, y in zip(matrix[i], pivot, strict=True)]
        rank += 1
    return rank


def largest_proven(
    prover: Prover, relations: Sequence[Proposal], letters: bool
) -> tuple[Proposal, ...]:
    """The largest set of the relations that is proven; sets are tried from the largest down."""
    tries = 0
    for size in range(len(relations), 0, -1):
        for chosen in combinations(relations, size):
            if prover.proves(chosen, letters):
                return chosen
            tries += 1
            if tries == _MOST_TRIES:
                return ()
    return ()
