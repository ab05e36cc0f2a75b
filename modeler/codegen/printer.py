"""One operation as C99 text.

Texts are combined from the texts of their operands; a level tells where parentheses are needed.
Sums and products keep the order of evaluation of the graph: floating point is not associative.
"""

from dataclasses import dataclass
from fractions import Fraction

from modeler.codegen.target import DOUBLE, FUNCTIONS, Target
from modeler.core.errors import EmitError

SUM, PRODUCT, ATOM = 1, 2, 3

PI = "3.14159265358979323846"


@dataclass(frozen=True, slots=True)
class Text:
    """C text of a value and its outermost operation: SUM, PRODUCT (or quotient), ATOM."""

    text: str
    level: int

    def within(self, level: int) -> str:
        """The text, in parentheses if its outermost operation binds less than `level`."""
        return self.text if self.level >= level else f"({self.text})"


def number_text(value: Fraction, target: Target = DOUBLE) -> Text:
    """Text of a number that is not negative: the one of the target nearest to it.

    A decimal literal where that is exact (`9.81`), else a quotient (`(1.0/3.0)`), which is rounded
    once as well.

    Raises:
        EmitError: too large for the target.
    """
    assert value >= 0
    if value > target.largest:
        raise EmitError(f"number {value} is too large for {target.precision} precision; rescale it")
    nearest, end = float(value), target.suffix
    if Fraction(repr(nearest)) == value or max(value.numerator, value.denominator) > target.exact:
        return Text(f"{nearest!r}{end}", ATOM)
    return Text(f"({value.numerator}.0{end}/{value.denominator}.0{end})", ATOM)


def pi_text(target: Target = DOUBLE) -> Text:
    """Text of pi."""
    return Text(f"{PI}{target.suffix}", ATOM)


def float_text(value: float) -> str:
    """Text of a double, of either sign, as what a macro stands for: `0.2`, `(-0.1)`."""
    return repr(value) if value >= 0 else f"({value!r})"


def negative(value: Text) -> Text:
    """-value."""
    return Text(f"-{value.within(PRODUCT)}", SUM)


def sum_text(a: Text, a_positive: bool, b: Text, b_positive: bool) -> Text:
    """(+-a) + (+-b); the positive one stands first, and a sum on the left."""
    if not a_positive and b_positive:
        return sum_text(b, True, a, False)
    if a_positive and b_positive and b.level == SUM and a.level != SUM:
        a, b = b, a
    first = a.text if a_positive else negative(a).text
    return Text(f"{first} {'+' if b_positive else '-'} {b.within(PRODUCT)}", SUM)


def product_text(a: Text, b: Text) -> Text:
    """a * b; the one that is a product itself stands first."""
    if b.level == PRODUCT and a.level != PRODUCT:
        a, b = b, a
    return Text(f"{a.within(PRODUCT)}*{b.within(ATOM)}", PRODUCT)


def quotient_text(a: Text, b: Text) -> Text:
    """a / b."""
    return Text(f"{a.within(PRODUCT)}/{b.within(ATOM)}", PRODUCT)


def power_text(base: Text, exponent: Text, target: Target = DOUBLE) -> Text:
    """base to the power of exponent."""
    return Text(f"{target.functions['pow']}({base.text}, {exponent.text})", ATOM)


def call_text(name: str, argument: Text, target: Target = DOUBLE) -> Text:
    """name(argument).

    Raises:
        EmitError: no such function in C99.
    """
    if name not in target.functions:
        expected = ", ".join(f for f in FUNCTIONS if f != "pow")
        raise EmitError(f"function {name} has no C99 form here; expected {expected}")
    return Text(f"{target.functions[name]}({argument.text})", ATOM)
