"""Expressions that are linear in the joint variables, taken apart."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from modeler.core import rounded
from modeler.core.expression import FUNCTIONS, LARGEST_EXPONENT, Expression


class NotLinear(ValueError):
    """The expression is not linear in the variables."""


class HighPower(ArithmeticError):
    """An exponent beyond `LARGEST_EXPONENT`."""


@dataclass(frozen=True)
class Linear:
    """constant + sum of coefficient * variable."""

    constant: float
    coefficients: Mapping[str, float] = field(default_factory=dict)

    def __add__(self, other: "Linear") -> "Linear":
        names = {**self.coefficients, **other.coefficients}
        return Linear(
            self.constant + other.constant,
            {n: self.coefficients.get(n, 0.0) + other.coefficients.get(n, 0.0) for n in names},
        )

    def __neg__(self) -> "Linear":
        return self._times(-1.0)

    def __sub__(self, other: "Linear") -> "Linear":
        return self + -other

    def __mul__(self, other: "Linear") -> "Linear":
        if self.coefficients and other.coefficients:
            raise NotLinear
        if self.coefficients:
            return self._times(other.constant)
        return other._times(self.constant)

    def __truediv__(self, other: "Linear") -> "Linear":
        if other.coefficients:
            raise NotLinear
        if other.constant == 0.0:
            raise ZeroDivisionError
        return Linear(
            self.constant / other.constant,
            {n: c / other.constant for n, c in self.coefficients.items()},
        )

    def __pow__(self, exponent: "Linear | int") -> "Linear":
        power = exponent if isinstance(exponent, int) else exponent._number()
        if abs(power) > LARGEST_EXPONENT:
            raise HighPower
        return Linear(_real(rounded.power(self._number(), power)))

    def _times(self, factor: float) -> "Linear":
        return Linear(self.constant * factor, {n: c * factor for n, c in self.coefficients.items()})

    def _number(self) -> float:
        if self.coefficients:
            raise NotLinear
        return self.constant


def linear_form(expression: Expression, symbols: Mapping[str, float]) -> Linear:
    """The expression as constant + sum of coefficient * variable; zero coefficients left out.

    Every name that is not among `symbols` is a variable.

    Raises:
        NotLinear: a variable stands in a product, a power or a function.
        HighPower: an exponent is beyond `LARGEST_EXPONENT`.
        ArithmeticError: division by zero, overflow, or no real value.
    """
    values = {
        name: Linear(symbols[name]) if name in symbols else Linear(0.0, {name: 1.0})
        for name in expression.names
    }
    form = expression.fold(values, _LIFTED, Linear(math.pi), _constant)
    form = Linear(form.constant, {n: c for n, c in form.coefficients.items() if c != 0.0})
    if not all(map(math.isfinite, (form.constant, *form.coefficients.values()))):
        raise OverflowError
    return form


def _lifted(name: str) -> Callable[["Linear"], "Linear"]:
    function = rounded.FUNCTIONS[name]

    def lifted(argument: Linear) -> Linear:
        try:
            return Linear(function(argument._number()))
        except NotLinear:
            raise
        except ValueError as error:  # sqrt(-1)
            raise ArithmeticError from error

    return lifted


_LIFTED = {name: _lifted(name) for name in FUNCTIONS}


def _constant(value: Fraction) -> Linear:
    return Linear(float(value))


def _real(value: complex | float) -> float:
    if isinstance(value, complex):
        raise ArithmeticError
    return float(value)
