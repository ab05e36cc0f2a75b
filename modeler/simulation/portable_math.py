"""sin, cos, exp, tanh and powers out of + - * / sqrt floor alone: the same bits on every machine.

A controller that sees encoder counts does not see what happens below one count. What is unstable
there (an arm that stands upright) grows from the last digit to a whole count within seconds, so a
library that rounds sin(x) another way gives another measurement. Libraries of mathematics differ
between machines, even with the processor's instruction set; IEEE 754 fixes the five operations.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from modeler.simulation.thresholds import THRESHOLDS

# pi/2 and ln 2 in parts of 33 and 32 bits: a product with a count of quarter turns or halvings
# below 2**20 is exact.
_QUARTER = (1.5707963267341256, 6.077100506303966e-11, 2.0222662487111665e-21)
_LN2 = (0.6931471803691238, 1.9082149292705877e-10)
_SINE = tuple((-1) ** k / math.factorial(2 * k + 1) for k in range(8))
_COSINE = tuple((-1) ** k / math.factorial(2 * k) for k in range(9))
_EXP = tuple(1 / math.factorial(k) for k in range(15))
_ATANH = tuple(1 / (2 * k + 1) for k in range(12))


class _PortableAlgebra(NamedTuple):
    """What numbers, arrays and expressions spell differently."""

    floor: Callable[[Any], Any]
    where: Callable[[Any, Any, Any], Any]
    clip: Callable[[Any, float, float], Any]
    two_to: Callable[[Any], Any]  # of a whole number
    sqrt: Callable[[Any], Any]


_ARRAYS = _PortableAlgebra(
    np.floor, np.where, np.clip, lambda k: np.ldexp(1.0, np.asarray(k).astype(int)), np.sqrt
)
_EXPRESSIONS = _PortableAlgebra(
    ca.floor,
    ca.if_else,
    lambda x, low, high: ca.fmin(ca.fmax(x, low), high),
    lambda k: 2**k,  # the power of two is a number of floating point, so every library hits it
    ca.sqrt,
)


def compute_sine_and_cosine(x: Any) -> tuple[Any, Any]:
    """Returns sin(x), cos(x) to 1e-16; x number, array or CasADi expression, rad, |x| below 1e6."""
    to = _choose_algebra(x)
    turns = to.floor(x * (2 / math.pi) + 0.5)
    r = x - turns * _QUARTER[0] - turns * _QUARTER[1] - turns * _QUARTER[2]
    square = r * r
    s, c = r * _evaluate_series(_SINE, square), _evaluate_series(_COSINE, square)
    quadrant = turns - 4 * to.floor(turns / 4)
    half = to.floor(quadrant / 2)
    odd = quadrant - 2 * half
    back = to.floor((quadrant + 1) / 2)  # 0 1 1 2
    sine = (1 - 2 * half) * to.where(odd, c, s)
    cosine = (1 - 2 * back * (2 - back)) * to.where(odd, s, c)
    return sine, cosine


def compute_exponential(x: Any) -> Any:
    """Returns exp(x) to 1e-16 of itself; beyond |x| = 700 that of 700."""
    to = _choose_algebra(x)
    exponent = to.clip(x, -THRESHOLDS.max_exponent, THRESHOLDS.max_exponent)
    halvings = to.floor(exponent / math.log(2.0) + 0.5)
    r = exponent - halvings * _LN2[0] - halvings * _LN2[1]
    return _evaluate_series(_EXP, r) * to.two_to(halvings)


def compute_hyperbolic_tangent(x: Any) -> Any:
    """Returns tanh(x) to 1e-16."""
    return 1 - 2 / (compute_exponential(2 * x) + 1)


def compute_power(x: Any, exponent: Any) -> Any:
    """Returns x**exponent = exp(exponent log x) to 1e-14 of itself, x between 1e-12 and 1e12."""
    root = x
    for _ in range(THRESHOLDS.logarithm_roots):
        root = _choose_algebra(root).sqrt(root)
    t = (root - 1) / (root + 1)
    return compute_exponential(
        exponent * (2.0 ** (THRESHOLDS.logarithm_roots + 1) * t * _evaluate_series(_ATANH, t * t))
    )


def round_to_ten_digits(value: float) -> float:
    """Rounds a number to ten digits, in which all machines agree.

    What is left differs where a digit is on the edge, for one number in a million.
    """
    return float(f"{value:.10g}")


def make_portable(function: ca.Function) -> ca.Function:
    """Returns the same function of CasADi scalars, with the functions of this module."""
    arguments = [ca.SX.sym(name, *function.size_in(name)) for name in function.name_in()]
    elements = [argument.nz for argument in arguments]
    results = [[ca.SX(0)] * function.nnz_out(k) for k in range(function.n_out())]
    values = [ca.SX(0)] * function.sz_w()
    rounded = _Functions()
    for k in range(function.n_instructions()):
        operation, read = function.instruction_id(k), function.instruction_input(k)
        written = function.instruction_output(k)
        if operation == ca.OP_INPUT:
            values[written[0]] = elements[read[0]][read[1]]
        elif operation == ca.OP_OUTPUT:
            results[written[0]][written[1]] = values[read[0]]
        elif operation == ca.OP_CONST:
            values[written[0]] = ca.SX(function.instruction_constant(k))
        else:
            values[written[0]] = rounded.apply_operation(operation, [values[i] for i in read])
    shapes = enumerate(results)
    columns = ((k, ca.vertcat(ca.SX(0, 1), *result)) for k, result in shapes)
    outputs = [ca.SX(function.sparsity_out(k), column) for k, column in columns]
    return ca.Function(function.name(), arguments, outputs, function.name_in(), function.name_out())


class _Functions:
    """Elementary functions of scalars; sine and cosine of one angle are computed once."""

    def __init__(self) -> None:
        self._turned: dict[int, tuple[ca.SX, tuple[ca.SX, ca.SX]]] = {}

    def apply_operation(self, operation: int, x: list[ca.SX]) -> ca.SX:
        if operation in (ca.OP_SIN, ca.OP_COS, ca.OP_TAN):
            sine, cosine = self._compute_sine_and_cosine(x[0])
            ratio = sine / cosine if operation == ca.OP_TAN else sine
            return cosine if operation == ca.OP_COS else ratio
        if operation == ca.OP_EXP:
            return compute_exponential(x[0])
        if operation == ca.OP_TANH:
            return compute_hyperbolic_tangent(x[0])
        if operation in (ca.OP_POW, ca.OP_CONSTPOW):
            return compute_power(*x)
        return ca.SX.unary(operation, *x) if len(x) == 1 else ca.SX.binary(operation, *x)

    def _compute_sine_and_cosine(self, x: ca.SX) -> tuple[ca.SX, ca.SX]:
        key = x.element_hash()
        if key not in self._turned:  # the expression is kept too, or its number could be reused
            self._turned[key] = x, compute_sine_and_cosine(x)
        return self._turned[key][1]


def _choose_algebra(x: Any) -> _PortableAlgebra:
    return _EXPRESSIONS if isinstance(x, ca.SX) else _ARRAYS


def _evaluate_series(coefficients: tuple[float, ...], x: Any) -> Any:
    """sum of coefficients[k] x**k, by Horner."""
    value = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        value = value * x + coefficient
    return value
