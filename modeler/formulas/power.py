"""The power balance at one exact state: the law that exposes a wrong Christoffel coefficient."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from sympy.polys.domains import QQ

from modeler.formulas.closed_form import Exponents
from modeler.formulas.coefficients import CoefficientTable, vector_of
from modeler.formulas.evaluation import number, poly_value
from modeler.formulas.text import as_fraction

_HALF_TANGENTS = (Fraction(1, 2), Fraction(-1, 3), Fraction(2, 5))
_SPEEDS = (Fraction(1), Fraction(-2), Fraction(3))
STATE = "tan(q/2) = (1/2, -1/3, 2/5), qd = (1, -2, 3) rad/s"
"""The state, for people; more joints repeat it."""


@dataclass(frozen=True)
class PowerState:
    """Rational numbers for everything, so that a law holds exactly or not at all.

    Attributes:
        motion: sines and cosines, rational points of the circle.
        speeds: (joints,).
        static: generators of the geometry.
        chi: {column: standard parameter}.
    """

    motion: tuple[Fraction, ...]
    speeds: tuple[Fraction, ...]
    static: tuple[Fraction, ...]
    chi: Mapping[int, Fraction]

    def value(self, at: Exponents, vector: Mapping[Any, Any]) -> Fraction:
        """monomial * linear form of the standard parameters."""
        total = Fraction(0)
        for (column, geometry), value in vector.items():
            total += as_fraction(value) * number(geometry, self.static) * self.chi[column]
        return total * number(at, self.motion)

    def speed_product(self, joints: tuple[int, ...]) -> Fraction:
        """qd_i qd_j qd_k."""
        product = Fraction(1)
        for joint in joints:
            product *= self.speeds[joint]
        return product


def example_values(table: CoefficientTable, twin: bool = False) -> dict[str, Fraction]:
    """Physical parameters of the example; lengths that it leaves out are nominal."""
    nominal = table.closed.algebra.geometry.values
    values = {name: Fraction(repr(float(value))) for name, value in nominal.items()}
    values |= table.printed.example
    return {**values, **table.printed.twin} if twin else values


def exact_state(table: CoefficientTable) -> PowerState:
    """The test state of the example; physical parameters that it leaves out are 0."""
    motion: list[Fraction] = []
    for index, joint in enumerate(table.closed.algebra.motions):
        t = _HALF_TANGENTS[index % len(_HALF_TANGENTS)]
        turning = [2 * t / (1 + t * t), (1 - t * t) / (1 + t * t)]
        motion += turning if joint.variable is None else [t]
    values = example_values(table)
    physical = [values.get(name, Fraction(0)) for name in table.physical.names]
    shift = len(physical) - table.closed.algebra.static_ring.ngens
    chi = {c: poly_value(poly, physical) for c, poly in table.physical.standard.items()}
    count = table.closed.algebra.geometry.coordinates
    speeds = tuple(_SPEEDS[i % len(_SPEEDS)] for i in range(count))
    return PowerState(tuple(motion), speeds, tuple(physical[shift:]), chi)


def power_balance(table: CoefficientTable, state: PowerState) -> Fraction:
    """qd'S - qd' (dM/dt) qd / 2 of the derived functions, which is 0 for any mechanism, W."""
    total = Fraction(0)
    for function in table.closed.functions:
        for at, form in function.terms.items():
            if function.kind == "christoffel":
                total += state.value(at, vector_of(form)) * state.speed_product(function.joints)
            elif function.kind == "inertia":
                total -= _half_slope_power(table, state, function.joints, at, vector_of(form))
    return total


def _half_slope_power(
    table: CoefficientTable,
    state: PowerState,
    joints: tuple[int, ...],
    at: Exponents,
    vector: Mapping[Any, Any],
) -> Fraction:
    """One term's part of qd' (dM/dt) qd / 2; entries beside the diagonal stand there twice."""
    algebra = table.closed.algebra
    rest = (0,) * algebra.static_ring.ngens
    monomial = algebra.ring.zero.new({at + rest: QQ(1)})
    total = Fraction(0)
    for k in range(algebra.geometry.coordinates):
        for moved, value in algebra.derivative(monomial, k).items():
            slope = as_fraction(value) * state.value(moved[: algebra.moving], vector)
            total += slope * state.speed_product((*joints, k))
    return total / 2 if joints[0] == joints[1] else total
