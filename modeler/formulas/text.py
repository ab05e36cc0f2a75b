"""Monomials, polynomials and linear forms as text and LaTeX."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from modeler.core.expression import format_decimal
from modeler.core.formula import format_latex_name
from modeler.derivation import convert_to_fraction
from modeler.formulas.ring import Poly
from modeler.robot import Robot


@dataclass(frozen=True)
class TextStyle:
    """How signs of operation look.

    Attributes:
        times: between factors.
        latex: True to write names and powers as LaTeX.
        halves: True to write 1/2 as 0.5: so the robot file writes its numbers.
    """

    times: str
    latex: bool
    halves: bool = False

    def format_name(self, name: str) -> str:
        """Returns the text of one letter."""
        return format_latex_symbol(name) if self.latex else name

    def format_power(self, name: str, exponent: int) -> str:
        """Returns the text of name ** exponent."""
        base = self.format_name(name)
        if exponent == 1:
            return base
        if not self.latex:
            return f"{base}**{exponent}"
        function = re.fullmatch(r"\\(cos|sin)\{\((.*)\)\}", base)
        if function:
            return f"\\{function[1]}^{{{exponent}}}{{({function[2]})}}"
        return f"{base}^{{{exponent}}}"

    def add_brackets(self, text: str) -> str:
        """Returns a sum as a factor."""
        return rf"\left({text}\right)" if self.latex else f"({text})"

    def adjust_to_robot(self, robot: Robot) -> "TextStyle":
        """Returns the style for numbers of that robot."""
        return replace(self, halves=robot.has_binary_fractions)

    def format_decimal(self, value: Fraction) -> str | None:
        """Returns the digits of a number that is written as a decimal."""
        return format_decimal(value, self.halves)

    def format_fraction(self, value: Fraction) -> str:
        """Returns the text of a positive number."""
        if digits := self.format_decimal(value):
            return digits
        if self.latex and value.denominator != 1:
            return f"\\tfrac{{{value.numerator}}}{{{value.denominator}}}"
        return str(value)


TEXT = TextStyle("*", False)
LATEX = TextStyle(r"\,", True)


def format_latex_symbol(name: str) -> str:
    """Returns LaTeX of a letter; sines, cosines and roots as functions."""
    function = re.fullmatch(r"(cos|sin|sqrt)\((.*)\)", name)
    if function:
        return f"\\{function[1]}{{({format_latex_symbol(function[2])})}}"
    angle = re.fullmatch(r"(\d[\d.]*)?\*?(pi)?(/\d+)?", name)
    if angle:
        return (angle[1] or "") + (r"\pi" if angle[2] else "") + (angle[3] or "")
    return format_latex_name(name)


def format_monomial(exponents: Sequence[int], names: Sequence[str], style: TextStyle = TEXT) -> str:
    """Returns the monomial, as "c2*s1**2"; cosines before sines, "1" for the empty product."""
    factors = [(name, e) for name, e in zip(names, exponents, strict=True) if e]
    return style.times.join(style.format_power(name, e) for name, e in sorted(factors)) or "1"


def format_polynomial(poly: Poly, names: Sequence[str], style: TextStyle = TEXT) -> str:
    """Returns a polynomial, highest monomial first; "0" if it has none."""
    return format_signed_sum(
        (
            (convert_to_fraction(value), _format_plain(at, names, style))
            for at, value in poly.terms()
        ),
        style,
    )


def format_linear_form(form: Mapping[int, Poly], parameters: Sequence[str], names: Sequence[str],
              style: TextStyle = TEXT) -> str:  # fmt: skip
    """Returns a linear form of parameters, e.g. "2*XZ3 - 2*bl1*MX3"."""
    terms: list[tuple[Fraction, str]] = []
    for column, factor in form.items():
        letter = style.format_name(parameters[column])
        if len(factor) == 1:
            ((at, value),) = factor.items()
            plain = _format_plain(at, names, style)
            terms.append(
                (convert_to_fraction(value), f"{plain}{style.times}{letter}" if plain else letter)
            )
        else:
            inside = format_polynomial(factor, names, style)
            terms.append((Fraction(1), f"({inside}){style.times}{letter}"))
    return format_signed_sum(terms, style)


def format_physical(poly: Poly, names: Sequence[str], masses: Iterable[str],
                  style: TextStyle = TEXT) -> str:  # fmt: skip
    """Returns a polynomial of physical parameters with each mass in front of its own bracket."""
    wanted = [i for i, name in enumerate(names) if name in set(masses)]
    loose: dict[tuple[int, ...], Any] = {}
    brackets: dict[int, dict[tuple[int, ...], Any]] = {}
    for at, value in poly.terms():
        mass = next((i for i in wanted if at[i] == 1), None)
        if mass is None:
            loose[at] = value
        else:
            rest = (*at[:mass], 0, *at[mass + 1 :])
            brackets.setdefault(mass, {})[rest] = value
    terms = [(convert_to_fraction(v), _format_plain(at, names, style)) for at, v in loose.items()]
    for mass, inside in sorted(brackets.items()):
        letter = style.format_name(names[mass])
        if len(inside) == 1:
            ((at, value),) = inside.items()
            plain = _format_plain(at, names, style)
            terms.append(
                (convert_to_fraction(value), f"{letter}{style.times}{plain}" if plain else letter)
            )
        else:
            values = [convert_to_fraction(value) for value in inside.values()]
            smallest = min(abs(value) for value in values)
            shared = all((value / smallest).denominator == 1 for value in values)
            content = smallest if shared else Fraction(1)
            content = content if any(value > 0 for value in values) else -content
            parts = [
                (convert_to_fraction(v) / content, _format_plain(at, names, style))
                for at, v in inside.items()
            ]
            terms.append((content, f"{letter}{style.times}({format_signed_sum(parts, style)})"))
    return format_signed_sum(terms, style)


def format_combination(combination: Mapping[str, Fraction], style: TextStyle = TEXT) -> str:
    """Returns a combination of named coefficients: "2*PJ1 + 2*PJ3", "-PJ5/2"."""
    return format_signed_sum(
        ((value, style.format_name(name)) for name, value in combination.items()), style
    )


def format_signed_sum(terms: Iterable[tuple[Fraction, str]], style: TextStyle = TEXT) -> str:
    """Returns the sum of number * text with the signs pulled out; an empty text is 1."""
    out = ""
    for value, text in terms:
        size = abs(value)
        if not text:
            piece = style.format_fraction(size)
        elif size == 1:
            piece = text
        elif size.denominator == 1 or style.latex or style.format_decimal(size):
            piece = f"{style.format_fraction(size)}{style.times}{text}"
        elif size.numerator == 1:
            piece = f"{text}/{size.denominator}"
        else:
            piece = f"{size.numerator}{style.times}{text}/{size.denominator}"
        if out:
            out += f" - {piece}" if value < 0 else f" + {piece}"
        else:
            out = f"-{piece}" if value < 0 else piece
    return out or "0"


def _format_plain(at: Sequence[int], names: Sequence[str], style: TextStyle) -> str:
    """The monomial in the order of its generators; empty for 1."""
    return style.times.join(
        style.format_power(name, e) for name, e in zip(names, at, strict=True) if e
    )
