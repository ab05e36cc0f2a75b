"""What the kinematics needs of the numbers it computes with.

The recursions are written once with Python operators; an algebra says what a constant, a joint
variable and its sine and cosine are: graph expressions, trigonometric polynomials, floats.
"""

from fractions import Fraction
from typing import Any, Protocol

import sympy

from modeler.core.errors import DerivationError
from modeler.core.expression import FUNCTIONS
from modeler.symbolic.angles import cos_sin
from modeler.symbolic.geometry import Geometry, Row
from modeler.symbolic.graph import Expr, Graph

Scalar = Any
Vector = list[Scalar]
"""Three scalars."""


class Algebra(Protocol):
    """Abstract: holds no data."""

    def static(self, value: sympy.Expr) -> Scalar:
        """A geometric constant."""
        ...

    def variable(self, row: Row) -> Scalar:
        """rate * q + offset of a prismatic joint."""
        ...

    def cos_sin(self, row: Row) -> tuple[Scalar, Scalar]:
        """Cosine and sine of theta = rate * q + offset."""
        ...


class GraphAlgebra:
    """Expressions of a graph; its symbols `q[0]`, `qd[0]`, ... are those of the free variables."""

    def __init__(self, graph: Graph, geometry: Geometry) -> None:
        self.graph = graph
        self.geometry = geometry

    def static(self, value: sympy.Expr) -> Expr:
        """A geometric constant as a static expression."""
        if value.is_Rational:
            return self.graph.constant(_fraction(value))
        if value.is_Float:
            return self.graph.constant(Fraction(repr(float(value))))
        if value.is_Symbol:
            return self.graph.symbol(value.name, static=True)
        if value is sympy.pi:
            return self.graph.pi()
        if value is sympy.E:
            return self.graph.call("exp", self.graph.constant(1))
        args = [self.static(arg) for arg in value.args]
        if value.is_Add or value.is_Mul:
            total = args[0]
            for arg in args[1:]:
                total = total + arg if value.is_Add else total * arg
            return total
        if value.is_Pow:
            return self._power(value, args[0])
        name = value.func.__name__.lower()
        if name not in FUNCTIONS:
            raise DerivationError(f"{value}: {name} has no C form; expected {', '.join(FUNCTIONS)}")
        return self.graph.call(name, args[0])

    def _power(self, value: sympy.Expr, base: Expr) -> Expr:
        halves = 2 * value.exp
        if not halves.is_Integer:
            raise DerivationError(
                f"{value}: only whole powers and square roots have a C form; give the number"
            )
        whole, half = divmod(int(halves), 2)
        power = base**whole
        return power * self.graph.call("sqrt", base) if half else power

    def variable(self, row: Row) -> Expr:
        """rate * q + offset of a prismatic joint."""
        q = self.combined("q", row)
        return (q if row.rate > 0 else -q) + self.static(row.r)

    def combined(self, kind: str, row: Row) -> Expr:
        """The variable of a moving row ("q"), or its derivative ("qd", "qdd")."""
        assert row.index is not None
        total = self.graph.constant(0)
        for k, coefficient in self.geometry.forms[row.index].items():
            total = total + self.graph.symbol(f"{kind}[{k}]") * coefficient
        return total

    def cos_sin(self, row: Row) -> tuple[Expr, Expr]:
        """Cosine and sine of theta; right angles are taken out exactly."""
        if row.index is None or not row.joint.angular:
            c, s = cos_sin(row.theta)
            return self.static(c), self.static(s)
        q = self.combined("q", row)
        angle = q if row.rate > 0 else -q
        quarters = row.theta / (sympy.pi / 2)
        if not quarters.is_Integer:
            angle = angle + self.static(row.theta)
            quarters = sympy.Integer(0)
        c, s = self.graph.call("cos", angle), self.graph.call("sin", angle)
        for _ in range(int(quarters) % 4):
            c, s = -s, c
        return c, s


def _fraction(value: sympy.Rational) -> Fraction:
    return Fraction(int(value.p), int(value.q))
