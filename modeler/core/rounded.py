"""Functions of doubles that give the same double on every machine.

The mathematical library of a machine, and which instructions it uses, move the last digit of a
sine or a power. Numbers of a robot file go into its C and its signature, which must not depend on
that: so the value is taken to 40 digits, and the double next to it is the answer. The four
operations and the square root are exact to the last digit by IEEE 754 and need no help.
"""

import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

_DIGITS = 40


@cache
def get_precise_context() -> Any:
    """Arithmetic with 40 digits, a context of mpmath of its own: no global precision is touched."""
    # Only here: most robot files have no sine among their numbers.
    import mpmath

    context = mpmath.MPContext()
    context.dps = _DIGITS
    return context


def compute_power(base: float, exponent: float) -> Any:
    """The double next to base**exponent; what Python gives where that is no finite real number.

    Raises:
        ArithmeticError: 0 to a negative power, or an overflow.
    """
    rough = base**exponent
    if isinstance(rough, complex) or not math.isfinite(rough):
        return rough
    return float(
        get_precise_context().power(
            get_precise_context().mpf(base), get_precise_context().mpf(exponent)
        )
    )


def _round_function(name: str, rough: Callable[[float], float]) -> Callable[[float], float]:
    def evaluate(x: float) -> float:
        value = rough(x)  # raises what an argument outside the domain raises
        if not math.isfinite(value):
            return value
        return float(getattr(get_precise_context(), name)(get_precise_context().mpf(x)))

    return evaluate


FUNCTIONS: Mapping[str, Callable[[float], float]] = {
    "sin": _round_function("sin", math.sin),
    "cos": _round_function("cos", math.cos),
    "tan": _round_function("tan", math.tan),
    "sqrt": math.sqrt,
    "exp": _round_function("exp", math.exp),
    "abs": abs,
    "sign": lambda x: float((x > 0) - (x < 0)),
    "tanh": _round_function("tanh", math.tanh),
}
"""The functions of the expression language, of doubles."""
