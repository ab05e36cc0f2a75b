"""Graph expressions in ball arithmetic: numbers that carry a bound of their own error.

A ball [m +- r] holds the true value, whatever was rounded on the way (Johansson 2017, "Arb"). What
a ball excludes is excluded for certain: that is a proof, where a small number in floating point is
not. Numbers of the robot file are the decimals that it says, symbols are their own expressions.
"""

import functools
import itertools
import math
import operator
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Any

from modeler.core.expression import FUNCTIONS, LAW, get_precise_context
from modeler.derivation.graph import OPERATIONS, Arithmetic, Expr, Graph, Plan, Table
from modeler.robot import Robot

Ball = Any
"""An `arb` of python-flint: a real ball."""


@cache
def load_flint() -> Any:
    """Returns the library of ball arithmetic, whose precision is that of its context."""
    # Only here: most derivations need no balls.
    import flint as library

    return library


def build_ball(value: Any) -> Ball:
    """Returns the ball around a fraction, or the exact ball of a double or whole number."""
    if isinstance(value, int | float):
        return load_flint().arb(value)
    return load_flint().arb(load_flint().fmpq(value.numerator, value.denominator))


def enclose_symbols(robot: Robot) -> dict[str, Ball]:
    """Returns the value of every symbol of a robot, by name, as its expression says it."""
    known: dict[str, Ball] = {}
    for name, expression in robot.symbols.items():
        pi = load_flint().arb.pi()
        known[name] = expression.fold(known, _CALLS, pi, build_ball, operator.pow)
    return known


def _enclose_law(table: Table, *x: Ball) -> Ball:
    """A law that was learned: of all cells in which x may lie."""
    law, places = table.law, []
    for axis, coordinate in enumerate(x):
        count, scale = law.cells[axis], build_ball(law.scales[axis])
        free = (coordinate - build_ball(law.low[axis])) * scale
        u = free.max(build_ball(0)).min(build_ball(count))
        cells = [int(end.floor().unique_fmpz()) for end in (u.lower(), u.upper())]
        rate = scale if table.along == axis and u.overlaps(free) else build_ball(0)
        unit, slope = load_flint().arb(0.5, 0.5), table.along == axis
        inside = range(min(cells[0], count - 1), min(cells[1], count - 1) + 1)
        weights = (_compute_weights((u - k).intersection(unit), rate, slope) for k in inside)
        places.append(list(zip(inside, weights, strict=True)))
    cell_values = []
    for place in itertools.product(*places):
        total = build_ball(0)
        for term in itertools.product(*(list(enumerate(weights, k)) for k, weights in place)):
            value = build_ball(float(law.coefficients[tuple(m for m, _ in term)]))
            total += math.prod((weight for _, weight in term), start=value)
        cell_values.append(total)
    return functools.reduce(lambda a, b: a.union(b), cell_values)


def _compute_weights(f: Ball, rate: Ball, slope: bool) -> list[Ball]:
    g = 1 - f
    if slope:
        return [rate * w / 2 for w in (-g * g, f * (3 * f - 4), 1 + 2 * f - 3 * f * f, f * f)]
    return [w / 6 for w in (g**3, 4 - 6 * f**2 + 3 * f**3, 4 - 6 * g**2 + 3 * g**3, f**3)]


_CALLS: Mapping[str, Callable[..., Ball]] = {
    **OPERATIONS,
    "pow": operator.pow,
    **{name: operator.methodcaller({"sign": "sgn"}.get(name, name)) for name in FUNCTIONS},
    "abs": abs,
    LAW: _enclose_law,
}


def build_ball_function(
    graph: Graph, outputs: Sequence[Expr], symbols: Mapping[str, Ball]
) -> Callable[[Mapping[str, Ball]], list[Ball]]:
    """Returns expressions as one function of their inputs, in ball arithmetic.

    Args:
        graph: of the expressions.
        outputs: the expressions.
        symbols: geometric symbols by name.
    """
    plan = Plan(graph, outputs, Arithmetic(build_ball, lambda: load_flint().arb.pi(), _CALLS))
    return lambda inputs: plan({**symbols, **inputs})


def is_proven_regular(matrix: Sequence[Sequence[Ball]]) -> bool:
    """Returns True if every square matrix within the balls is regular, False if uncertain.

    The system with the right side 1 is solved in balls, which Arb does only where the matrix is
    proven regular (by the product with an approximate inverse, or by pivots without zero).
    """
    rows = load_flint().arb_mat(matrix)
    try:
        rows.solve(load_flint().arb_mat([[1]] * rows.nrows()))
    except ZeroDivisionError:
        return False
    return True


# Constants of the geometry that are zero for certain: in rational numbers, as they are written.


def is_surely_zero(expression: Expr, robot: Robot) -> bool:
    """Returns True if an expression is 0 at the given values; False if it moves or is not rational.

    Lengths in a file are decimals, so sums and products of them are rational numbers: the offsets
    along the axes of a plane loop add up to 0, or they do not.
    """
    values: dict[str, Fraction] = {}
    for name, text in robot.symbols.items():
        try:
            values[name] = text.fold(values, {}, None, Fraction)
        except (KeyError, TypeError, ZeroDivisionError):
            continue  # an angle: missed where it is needed
    rational = Arithmetic(Fraction, lambda: None, OPERATIONS)  # no roots, and nothing with pi
    try:
        return bool(Plan(expression.graph, [expression], rational)(values)[0] == 0)
    except (KeyError, TypeError, ZeroDivisionError):
        return False


# Graph expressions with 40 digits, for numbers that must be the same on every machine.
#
# Sines, sums and solutions of linear systems in double precision differ in the last digit from one
# processor to the next. What goes into the emitted C and its signature is computed here: its
# nearest double is the same everywhere.


Number = Any
"""A number of the context `modeler.core.expression.precise()`."""


def evaluate_precisely(
    graph: Graph, outputs: Sequence[Expr], values: Mapping[str, float | Number]
) -> list[Number]:
    """Returns values of the outputs, 40 digits; `values` gives a number per symbol.

    A double counts as the decimal that it prints, which is what was written: 0.3 is 3/10.
    """
    pi, functions = (lambda: +get_precise_context().pi), get_precise_functions()
    plan = Plan(graph, outputs, Arithmetic(convert_fraction, pi, functions))
    return plan({name: convert_to_precise(value) for name, value in values.items()})


def convert_to_precise(value: float | Number) -> Number:
    """Returns a double as the decimal that it prints; a number of 40 digits as it is."""
    return get_precise_context().mpf(repr(float(value)) if isinstance(value, float) else value)


def convert_fraction(value: Fraction) -> Number:
    """Returns a rational number with 40 digits."""
    return get_precise_context().mpf(value.numerator) / value.denominator


@cache
def get_precise_functions() -> Mapping[str, Callable[..., Number]]:
    """Returns the operations of expressions on numbers of 40 digits."""
    mp = get_precise_context()
    named_functions = {name: getattr(mp, name) for name in FUNCTIONS if name != "abs"}
    return {**OPERATIONS, **named_functions, "abs": abs, "pow": mp.power}
