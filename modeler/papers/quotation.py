"""Reads what a paper prints: sums of products, with decimals that know how many digits they have.

`ZZ2Ri = ZZ2i + YY3i + D4i^2 M4i`, `- 3.23MX32`, `1/D41 MX3R1`, `sin theta2 qd1`: factors may stand
side by side as in print. A number with a point stands for every value that rounds to it.
"""

import itertools
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction

Monomial = tuple[tuple[str, int], ...]
"""Names with their exponents, sorted."""

_TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d+)?)|([A-Za-z][A-Za-z0-9']*)|(\*\*|[-+*/^()\[\]]))")
_SUM = re.compile(r"sum_i\s*\[([^\]]*)\]")
_NUMBER = re.compile(r"(?<![A-Za-z\d.,])-?\d+(?:[.,]\d+)?")
_FUNCTIONS = ("sin", "cos")


class QuotationError(ValueError):
    """A quotation that cannot be read as what it is said to be."""


@dataclass(frozen=True)
class Amount:
    """A coefficient as a paper prints it, with its rounding.

    Attributes:
        value: as printed.
        half: half a unit of the last printed digit; 0 if it is exact.
    """

    value: Fraction
    half: Fraction = Fraction(0)

    def __add__(self, other: "Amount") -> "Amount":
        return Amount(self.value + other.value, self.half + other.half)

    def __mul__(self, other: "Amount") -> "Amount":
        half = abs(self.value) * other.half + abs(other.value) * self.half
        return Amount(self.value * other.value, half)

    def __neg__(self) -> "Amount":
        return Amount(-self.value, self.half)


Sum = Mapping[Monomial, Amount]


def read_amount(text: str) -> Amount:
    """Reads `3.23` with half a unit of its last digit, `3` exactly; a comma is a point."""
    text = text.replace(",", ".")
    digits = len(text.partition(".")[2])
    half = Fraction(1, 2 * 10**digits) if digits else Fraction(0)
    return Amount(Fraction(text), half)


def read_numbers(text: str) -> list[Amount]:
    """Reads the numbers of a quotation in order; digits of names such as `M7` are no numbers."""
    joined = re.sub(r"(?<=\d) (?=\d{3}(?!\d))", "", text)
    return [read_amount(number) for number in _NUMBER.findall(joined)]


def separate_sides(text: str) -> tuple[str, str]:
    """Separates the two sides of an equation."""
    left, equal, right = text.partition("=")
    if not equal:
        raise QuotationError(f'"{text}" is no equation')
    return left.strip(), right


def read_sum(text: str, rename: Callable[[str], str], legs: Iterable[str] = ()) -> Sum:
    """Reads a sum, its names changed by `rename`.

    Args:
        text: as printed; `sum_i [ ... ]` runs over `legs`.
        rename: from the paper's name to ours.
        legs: what stands for i in the terms of such a sum.

    Raises:
        QuotationError: it is no sum of products.
    """

    def expand_legs(match: re.Match[str]) -> str:
        term = match.group(1)
        return "(" + " + ".join(re.sub(r"(?<=\d)i\b", leg, term) for leg in legs) + ")"

    tokens = _read_tokens(_SUM.sub(expand_legs, text))
    reader = _QuotationReader(tokens, rename)
    parsed_sum = reader.read_terms()
    if reader.at != len(tokens):
        raise QuotationError(f'"{text}" cannot be read from "{"".join(tokens[reader.at :])}" on')
    return parsed_sum


def _read_tokens(text: str) -> list[str]:
    tokens, at = [], 0
    while at < len(text.rstrip()):
        match = _TOKEN.match(text, at)
        if match is None:
            raise QuotationError(f'"{text}" cannot be read from "{text[at:]}" on')
        tokens.append(match.group().strip().replace("**", "^"))
        at = match.end()
    return tokens


class _QuotationReader:
    """Sum, product, factor: each method reads on from token `at`."""

    def __init__(self, tokens: list[str], rename: Callable[[str], str]) -> None:
        self.tokens, self.rename, self.at = tokens, rename, 0

    def _get_next(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def _take_token(self) -> str:
        token = self._get_next()
        self.at += 1
        return token

    def read_terms(self) -> dict[Monomial, Amount]:
        parts: list[Sum] = []
        while not parts or self._get_next() in ("+", "-"):
            sign = self._take_token() if self._get_next() in ("+", "-") else "+"
            part = self._read_product()
            parts.append({m: -value for m, value in part.items()} if sign == "-" else part)
        return add_sums(*parts)

    def _read_product(self) -> dict[Monomial, Amount]:
        product = self._read_factor()
        while (token := self._get_next()) and token not in ("+", "-", ")", "]"):
            if token in ("*", "/"):
                self._take_token()
            factor = self._read_factor()
            product = _multiply_sums(product, _invert_monomial(factor) if token == "/" else factor)
        return product

    def _read_factor(self) -> dict[Monomial, Amount]:
        token = self._take_token()
        factor: dict[Monomial, Amount]
        if token in ("(", "["):
            factor = self.read_terms()
            self._take_token()
        elif token[:1].isdigit():
            factor = {(): read_amount(token)}
        elif token[:1].isalpha():
            if token in _FUNCTIONS:
                factor = {((f"{token}({self._read_argument()})", 1),): Amount(Fraction(1))}
            else:
                factor = {((self.rename(token), 1),): Amount(Fraction(1))}
        else:
            raise QuotationError(f'got "{token or "the end"}"; expected a name or a number')
        if self._get_next() == "^":
            self._take_token()
            power, base = self._take_token(), factor
            if not power.isdigit():
                raise QuotationError(f'got the exponent "{power}"; expected a number')
            for _ in range(int(power) - 1):
                factor = _multiply_sums(factor, base)
        return factor

    def _read_argument(self) -> str:
        """`theta2` or `(theta2)`."""
        token = self._take_token()
        if token != "(":
            return self.rename(token)
        name = self.rename(self._take_token())
        self._take_token()
        return name


def _multiply_sums(a: Sum, b: Sum) -> dict[Monomial, Amount]:
    pairs = itertools.product(a.items(), b.items())
    return add_sums(*({multiply_monomials(m, n): x * y} for (m, x), (n, y) in pairs))


def _invert_monomial(a: Sum) -> dict[Monomial, Amount]:
    if len(a) != 1:
        raise QuotationError("a sum stands below a fraction line; expected a product")
    ((monomial, value),) = a.items()
    if value.half or not value.value:
        raise QuotationError("expected an exact number below a fraction line")
    return {tuple((name, -power) for name, power in monomial): Amount(1 / value.value)}


def multiply_monomials(left: Monomial, right: Monomial) -> Monomial:
    """Multiplies two monomials."""
    powers = dict(left)
    for name, power in right:
        powers[name] = powers.get(name, 0) + power
    return tuple(sorted((n, p) for n, p in powers.items() if p))


def add_sums(*sums: Sum) -> dict[Monomial, Amount]:
    """Adds sums."""
    total: dict[Monomial, Amount] = {}
    for part in sums:
        for monomial, value in part.items():
            total[monomial] = total[monomial] + value if monomial in total else value
    return {monomial: value for monomial, value in total.items() if value.value}


def replace_names(a: Sum, values: Mapping[str, Sum]) -> dict[Monomial, Amount]:
    """Replaces names in a sum by sums."""
    total: dict[Monomial, Amount] = {}
    for monomial, value in a.items():
        part: dict[Monomial, Amount] = {(): value}
        for name, power in monomial:
            if name in values and power > 0:
                for _ in range(power):
                    part = _multiply_sums(part, values[name])
            else:
                part = _multiply_sums(part, {((name, power),): Amount(Fraction(1))})
        total = add_sums(total, part)
    return total


def format_sum(a: Sum) -> str:
    """Formats a sum as people read it: `ZZ2 + D4^2*M4`."""
    text = ""
    for monomial, value in a.items():
        above = [_format_power(name, power) for name, power in monomial if power > 0]
        below = [_format_power(name, -power) for name, power in monomial if power < 0]
        size = abs(value.value)
        number = f"{float(size):.4g}" if value.half or size.denominator > 1000 else str(size)
        if number != "1" or not above:
            above.insert(0, number)
        term = "*".join(above) + "".join(f"/{name}" for name in below)
        text += (" - " if value.value < 0 else " + ") + term
    return text.removeprefix(" + ").replace(" - ", "-", 1) if text[:3] == " - " else text[3:] or "0"


def _format_power(name: str, power: int) -> str:
    return name if power == 1 else f"{name}^{power}"
