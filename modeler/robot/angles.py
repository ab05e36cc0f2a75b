"""Angles printed as rounded decimals, and the multiples of pi/12 that they mean.

One rule for every file that is read: robot files and those of other programs.
"""

import ast
import math
from decimal import Decimal
from fractions import Fraction

FINE, COARSE = 3, 2
"""Decimals that an angle must have to be taken for a multiple of pi/12, and of pi/2: with fewer,
a measured angle is near one by chance too often."""

_SINES = (0.0, math.sin(math.pi / 12), 0.5, math.sqrt(0.5), math.sqrt(0.75),
          math.cos(math.pi / 12), 1.0)  # fmt: skip
"""Of 0, pi/12, .. pi/2, each the double next to it."""


def recognise_angle(digits: str) -> str | None:
    """The multiple of pi/12 that the printed number is a rounding of; None if it is of none.

    Args:
        digits: a decimal number, rad.
    """
    count = count_twelfths(digits)
    return None if count is None else format_pi_multiple(Fraction(count, 12))


def count_twelfths(digits: str) -> int | None:
    """How many twelfths of pi the printed number is a rounding of; None if of no whole number.

    `1.5708`, `1.571`, `1.57080` and the cut-off `3.1415` are: from the multiple to the number it
    is half a unit of its last digit, or towards 0 a whole one. Zeros at the end are taken for
    padding as long as enough decimals are left without them.

    Args:
        digits: a decimal number, rad.
    """
    number = abs(Decimal(digits))
    count = round(float(number) / (math.pi / 12))
    if count == 0 or count > 24:
        return None
    least = COARSE if count % 6 == 0 else FINE
    decimals = _count_decimals(number.normalize())
    if decimals < least:
        decimals = _count_decimals(number)
    if decimals < least:
        return None
    unit = 10.0 ** -min(decimals, 15)
    if not -unit <= float(number) - count * math.pi / 12 <= unit / 2:
        return None
    return -count if digits.startswith("-") else count


def compute_cosine_sine(angle: float) -> tuple[float, float]:
    """Both, of the double next to a multiple of pi/12 as that multiple has them: cos pi/2 is 0."""
    count = round(angle * 12 / math.pi)
    if abs(angle - count * math.pi / 12) > 2 * math.ulp(max(1.0, abs(angle))):
        return math.cos(angle), math.sin(angle)
    return _compute_twelfth_sine(count + 6), _compute_twelfth_sine(count)


def _compute_twelfth_sine(count: int) -> float:
    half, place = divmod(count % 24, 12)
    return (-1.0 if half and place else 1.0) * _SINES[min(place, 12 - place)]


def _count_decimals(number: Decimal) -> int:
    exponent = number.as_tuple().exponent
    assert isinstance(exponent, int)
    return -exponent


def recognise_angle_terms(tree: ast.expr, rounded: dict[str, str]) -> ast.expr:
    """The angle with its decimal terms, and whole multiples of such, put as what they mean.

    Args:
        tree: of Python's arithmetic.
        rounded: grows by digits -> multiple, for what was put.
    """
    if isinstance(tree, ast.BinOp):
        sides = (tree.left, tree.right)
        whole = [isinstance(s, ast.Constant) and isinstance(s.value, int) for s in sides]
        if isinstance(tree.op, ast.Add | ast.Sub) or any(whole):
            return ast.BinOp(
                recognise_angle_terms(sides[0], rounded),
                tree.op,
                recognise_angle_terms(sides[1], rounded),
            )
    minus = isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.USub)
    number = tree.operand if isinstance(tree, ast.UnaryOp) else tree
    if isinstance(number, ast.Constant) and isinstance(number.value, float):
        digits = f"{'-' if minus else ''}{number.value!r}"
        angle = recognise_angle(digits)
        if angle is not None:
            rounded[digits] = angle
            return ast.parse(angle, mode="eval").body
    elif isinstance(tree, ast.UnaryOp):
        return ast.UnaryOp(tree.op, recognise_angle_terms(tree.operand, rounded))
    return tree


def describe_rounded_angles(rounded: dict[str, str]) -> str:
    """What to tell of them."""
    return "rounded angles are exact here: " + ", ".join(f"{d} is {a}" for d, a in rounded.items())


def format_pi_multiple(turns: Fraction) -> str:
    """`turns` times pi as text: `pi/2`, `-pi`, `3*pi/4`, `0`."""
    if turns == 0:
        return "0"
    head = "" if abs(turns.numerator) == 1 else f"{abs(turns.numerator)}*"
    tail = "" if turns.denominator == 1 else f"/{turns.denominator}"
    return f"{'-' if turns < 0 else ''}{head}pi{tail}"
