"""Expressions of the robot file as exact sympy expressions."""

from collections.abc import Mapping
from fractions import Fraction

import sympy

from modeler.core.errors import DerivationError
from modeler.core.expression import Expression
from modeler.symbolic.angles import is_short
from modeler.symbolic.writing_out import TooLong, check_length, power

_LONGEST = 60  # letters of the user's text that are quoted

_FUNCTIONS = {
    "sin": sympy.sin, "cos": sympy.cos, "sqrt": sympy.sqrt,
    "tan": lambda x: sympy.sin(x) / sympy.cos(x),
    "exp": sympy.exp, "abs": sympy.Abs, "sign": sympy.sign, "tanh": sympy.tanh,
}  # fmt: skip


def folded(expression: Expression, values: Mapping[str, sympy.Expr]) -> sympy.Expr:
    """The expression with `values` for its names, decimals as the fractions that were written.

    Raises:
        DerivationError: it is not finite, or too long to be written out.
    """
    try:
        value = sympy.sympify(expression.fold(values, _FUNCTIONS, sympy.pi, _rational, power))
        check_length(value)
    except TooLong as error:
        raise DerivationError(
            f'"{_shortened(expression.text)}" {error}; give its value as a number'
        ) from None
    if value.has(sympy.zoo, sympy.oo, sympy.nan):
        raise DerivationError(
            f'"{_shortened(expression.text)}" is not finite; expected a finite number'
        )
    turned = value.atoms(sympy.cos, sympy.sin)
    if not turned or not all(is_short(function.args[0]) for function in turned):
        return value
    return sympy.expand_trig(value)


def _rational(value: Fraction) -> sympy.Rational:
    return sympy.Rational(value.numerator, value.denominator)


def _shortened(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."
