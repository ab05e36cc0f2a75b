"""Expressions of the robot file as exact sympy expressions."""

from collections.abc import Mapping

import sympy

from modeler.core.errors import DerivationError
from modeler.core.expression import Expression

_FUNCTIONS = {
    "sin": sympy.sin, "cos": sympy.cos, "sqrt": sympy.sqrt,
    "tan": lambda x: sympy.sin(x) / sympy.cos(x),
    "exp": sympy.exp, "abs": sympy.Abs, "sign": sympy.sign, "tanh": sympy.tanh,
}  # fmt: skip


def folded(expression: Expression, values: Mapping[str, sympy.Expr]) -> sympy.Expr:
    """The expression with `values` for its names, decimals as the fractions that were written.

    Raises:
        DerivationError: it is not finite.
    """
    value = sympy.sympify(
        expression.fold(
            values, _FUNCTIONS, sympy.pi, lambda x: sympy.Rational(x.numerator, x.denominator)
        )
    )
    if value.has(sympy.zoo, sympy.oo, sympy.nan):
        raise DerivationError(f'"{expression.text}" is not finite; expected a finite number')
    return sympy.expand_trig(value) if value.has(sympy.cos, sympy.sin) else value
