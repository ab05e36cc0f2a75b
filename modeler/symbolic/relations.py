"""Linear relations between joint variables: every row's variable in the free ones, exactly."""

from collections.abc import Mapping
from fractions import Fraction

import sympy

from modeler.core.errors import DerivationError
from modeler.robot import Joint, Robot
from modeler.symbolic.folding import folded

Form = Mapping[int, Fraction]
"""Sum of coefficient * u[k] over the free variables u."""


def resolved_relations(
    robot: Robot, symbols: Mapping[str, sympy.Expr]
) -> tuple[tuple[Form, ...], dict[str, sympy.Expr]]:
    """Forms of the moving rows, in table order, and the constants of the relations, by row.

    q_row = sum of form[k] u[k] + constant. A symbol in a coefficient counts with its value: the
    coefficients are rational numbers.

    Raises:
        DerivationError: a relation is not linear.
    """
    numbers = {name: sympy.Rational(repr(x)) for name, x in robot.symbol_values().items()}
    order = {joint.name: k for k, joint in enumerate(robot.free)}
    variables = {joint.variable: _symbol(joint) for joint in robot.moving}
    values = {_symbol(joint): _symbol(joint) for joint in robot.free}
    waiting = {joint for joint in robot.moving if joint.name in robot.relations}
    while waiting:
        for joint in sorted(waiting, key=lambda joint: joint.name):
            expression = robot.relations[joint.name]
            if all(variables[n] in values for n in expression.names if n in variables):
                value = folded(expression, {**symbols, **variables})
                values[_symbol(joint)] = sympy.expand(value.subs(values))
                waiting.discard(joint)
    forms, constants = [], {}
    for joint in robot.moving:
        value = values[_symbol(joint)]
        coefficients = {k: value.coeff(_symbol(robot.free[k]), 1) for k in order.values()}
        constant = value - sum(c * _symbol(robot.free[k]) for k, c in coefficients.items())
        constant = sympy.expand(constant)
        if constant.free_symbols & set(variables.values()):
            raise DerivationError(
                f"the relation of joint {joint.name} is not linear; expected a sum such as q1 - q2"
            )
        constants[joint.name] = constant
        forms.append({k: _fraction(c, numbers) for k, c in coefficients.items() if c != 0})
    return tuple(forms), constants


def _symbol(joint: Joint) -> sympy.Symbol:
    return sympy.Symbol(joint.variable, real=True)


def _fraction(value: sympy.Expr, numbers: Mapping[str, sympy.Rational]) -> Fraction:
    at = sympy.nsimplify(value.subs({s: numbers[s.name] for s in value.free_symbols}))
    if not at.is_Rational:
        raise DerivationError(f"the coefficient {value} of a relation is no rational number")
    return Fraction(int(at.p), int(at.q))
