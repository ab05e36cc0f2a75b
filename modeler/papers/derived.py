"""What is derived of a robot, in the form in which quotations are compared with it."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

import sympy

from modeler.base import BaseParameters, base_parameters
from modeler.core.expression import parse
from modeler.papers.paper import Variant
from modeler.papers.quotation import Amount, Monomial, Sum, read_sum, sum_text, times
from modeler.robot import Robot, read_robot
from modeler.symbolic import SymbolicModel, derive_model
from modeler.terms import CoefficientTable, coefficient_table


@dataclass(frozen=True)
class Derived:
    """A robot with its model and base parameters."""

    robot: Robot
    model: SymbolicModel
    base: BaseParameters

    @property
    def values(self) -> Mapping[str, float]:
        """Nominal values of the geometric symbols."""
        return self.model.geometry.values

    @cached_property
    def relations(self) -> Mapping[str, Sum]:
        """Every base parameter as a sum of standard parameters."""
        return {
            p.name: {
                times(monomial, ((term.parameter, 1),)): value
                for term in p.terms
                for monomial, value in sum_of(term.coefficient).items()
            }
            for p in self.base.parameters
        }

    @cached_property
    def standard(self) -> tuple[str, ...]:
        """Names of the standard parameters."""
        return tuple(column.name for column in self.base.columns)

    @cached_property
    def kept(self) -> frozenset[str]:
        """Standard parameters whose columns are those of base parameters."""
        return frozenset(self.base.columns[p.column].name for p in self.base.parameters)

    @cached_property
    def grouping(self) -> Mapping[str, list[sympy.Rational]]:
        """By standard parameter: how much of it is in each base parameter, at nominal values."""
        found = {name: [sympy.S.Zero] * self.base.rank for name in self.standard}
        for k, parameter in enumerate(self.base.parameters):
            for term in parameter.terms:
                put = {s: self.values[s.name] for s in term.coefficient.free_symbols}
                found[term.parameter][k] = sympy.Rational(float(term.coefficient.subs(put)))
        return found

    @cached_property
    def table(self) -> CoefficientTable:
        """Coefficients of the closed form."""
        return coefficient_table(self.model, self.base)

    @cached_property
    def tied(self) -> Mapping[str, Sum]:
        """Joint variables that follow others, and those that follow themselves."""
        free = {j.variable: read_sum(j.variable, str) for j in self.robot.moving}
        tied = {f"q{name}": read_sum(text.text, str) for name, text in self.robot.relations.items()}
        return free | tied


def derived_robot(name: str, variant: Variant | None = None) -> Derived:
    """A built-in robot, or one of that name that differs from a built-in one as `variant` says."""
    robot = read_robot(name if variant is None else variant.of)
    if variant is not None:
        robot = replace(robot.opened() if variant.open else robot, name=name)
        if variant.gravity:
            x, y, z = (parse(text) for text in variant.gravity)
            robot = replace(robot, gravity=(x, y, z))
    model = derive_model(robot)
    return Derived(robot, model, base_parameters(model))


def sum_of(expression: sympy.Expr) -> Sum:
    """An expression of symbols, sines and cosines as a sum."""
    found: dict[Monomial, Amount] = {}
    for term in sympy.Add.make_args(sympy.expand(expression)):
        number, rest = term.as_coeff_Mul()
        if number:
            value = sympy.Rational(number)
            powers = sorted((str(b), int(e)) for b, e in rest.as_powers_dict().items() if b != 1)
            found[tuple(powers)] = Amount(Fraction(int(value.p), int(value.q)))
    return found


def expression_of(whole: Sum, symbols: Mapping[str, sympy.Expr]) -> sympy.Expr:
    """A sum as an expression, with these for its names where they are given."""
    return sympy.sympify(sum_text(whole).replace("^", "**"), symbols)
