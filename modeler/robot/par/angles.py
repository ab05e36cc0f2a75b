"""Angles printed as rounded decimals, and the multiples of pi/12 that they mean."""

import math
from decimal import Decimal
from fractions import Fraction

FINE, COARSE = 3, 2
"""Decimals that an angle must have to be taken for a multiple of pi/12, and of pi/2: with fewer,
a measured angle is near one by chance too often."""


def exact_angle(digits: str) -> str | None:
    """The multiple of pi/12 that the printed number is a rounding of; None if it is of none.

    `1.5708`, `1.571`, `1.57080` and the cut-off `3.1415` are: from the multiple to the number it
    is half a unit of its last digit, or towards 0 a whole one. Zeros at the end are taken for
    padding as long as enough decimals are left without them.

    Args:
        digits: a decimal number, rad.
    """
    number = abs(Decimal(digits))
    twelfths = round(float(number) / (math.pi / 12))
    if twelfths == 0 or twelfths > 24:
        return None
    least = COARSE if twelfths % 6 == 0 else FINE
    decimals = _decimals(number.normalize())
    if decimals < least:
        decimals = _decimals(number)
    if decimals < least:
        return None
    unit = 10.0 ** -min(decimals, 15)
    if not -unit <= float(number) - twelfths * math.pi / 12 <= unit / 2:
        return None
    return multiple(Fraction(-twelfths if digits.startswith("-") else twelfths, 12))


def _decimals(number: Decimal) -> int:
    exponent = number.as_tuple().exponent
    assert isinstance(exponent, int)
    return -exponent


def multiple(turns: Fraction) -> str:
    """`turns` times pi as text: `pi/2`, `-pi`, `3*pi/4`, `0`."""
    if turns == 0:
        return "0"
    head = "" if abs(turns.numerator) == 1 else f"{abs(turns.numerator)}*"
    tail = "" if turns.denominator == 1 else f"/{turns.denominator}"
    return f"{'-' if turns < 0 else ''}{head}pi{tail}"
