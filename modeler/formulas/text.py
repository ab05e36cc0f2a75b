"""Monomials, polynomials and linear forms as text and LaTeX."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from modeler.core.expression import decimal_text
from modeler.core.formula import latex_name
from modeler.derivation import as_fraction
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

    def name(self, name: str) -> str:
        """One letter."""
        return latex_symbol(name) if self.latex else name

    def power(self, name: str, exponent: int) -> str:
        """name ** exponent."""
        base = self.name(name)
        if exponent == 1:
            return base
        if not self.latex:
            return f"{base}**{exponent}"
        function = re.fullmatch(r"\\(cos|sin)\{\((.*)\)\}", base)
        if function:
            return f"\\{function[1]}^{{{exponent}}}{{({function[2]})}}"
        return f"{base}^{{{exponent}}}"

    def bracket(self, text: str) -> str:
        """A sum as a factor."""
        return rf"\left({text}\right)" if self.latex else f"({text})"

    def of(self, robot: Robot) -> "TextStyle":
        """The same for numbers of that robot."""
        return replace(self, halves=robot.halves)

    def decimal(self, value: Fraction) -> str | None:
        """The digits of a number that is written as a decimal."""
        return decimal_text(value, self.halves)

    def fraction(self, value: Fraction) -> str:
        """A positive number."""
        if digits := self.decimal(value):
            return digits
        if self.latex and value.denominator != 1:
            return f"\\tfrac{{{value.numerator}}}{{{value.denominator}}}"
        return str(value)


TEXT = TextStyle("*", False)
LATEX = TextStyle(r"\,", True)


def latex_symbol(name: str) -> str:
    """LaTeX of a letter; sines, cosines and roots as functions."""
    function = re.fullmatch(r"(cos|sin|sqrt)\((.*)\)", name)
    if function:
        return f"\\{function[1]}{{({latex_symbol(function[2])})}}"
    angle = re.fullmatch(r"(\d[\d.]*)?\*?(pi)?(/\d+)?", name)
    if angle:
        return (angle[1] or "") + (r"\pi" if angle[2] else "") + (angle[3] or "")
    return latex_name(name)


def monomial_text(exponents: Sequence[int], names: Sequence[str], style: TextStyle = TEXT) -> str:
    """The monomial, as "c2*s1**2"; cosines before sines, "1" for the empty product."""
    factors = [(name, e) for name, e in zip(names, exponents, strict=True) if e]
    return style.times.join(style.power(name, e) for name, e in sorted(factors)) or "1"


def polynomial_text(poly: Poly, names: Sequence[str], style: TextStyle = TEXT) -> str:
    """A polynomial, highest monomial first; "0" if it has none."""
    return signed_sum(
        ((as_fraction(value), _plain(at, names, style)) for at, value in poly.terms()), style
    )


def form_text(form: Mapping[int, Poly], parameters: Sequence[str], names: Sequence[str],
              style: TextStyle = TEXT) -> str:  # fmt: skip
    """A linear form of parameters, e.g. "2*XZ3 - 2*bl1*MX3"."""
    terms: list[tuple[Fraction, str]] = []
    for column, factor in form.items():
        letter = style.name(parameters[column])
        if len(factor) == 1:
            ((at, value),) = factor.items()
            plain = _plain(at, names, style)
            terms.append((as_fraction(value), f"{plain}{style.times}{letter}" if plain else letter))
        else:
            inside = polynomial_text(factor, names, style)
            terms.append((Fraction(1), f"({inside}){style.times}{letter}"))
    return signed_sum(terms, style)


def physical_text(poly: Poly, names: Sequence[str], masses: Iterable[str],
                  style: TextStyle = TEXT) -> str:  # fmt: skip
    """A polynomial of physical parameters with each mass in front of its own bracket."""
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
    terms = [(as_fraction(v), _plain(at, names, style)) for at, v in loose.items()]
    for mass, inside in sorted(brackets.items()):
        letter = style.name(names[mass])
        if len(inside) == 1:
            ((at, value),) = inside.items()
            plain = _plain(at, names, style)
            terms.append((as_fraction(value), f"{letter}{style.times}{plain}" if plain else letter))
        else:
            values = [as_fraction(value) for value in inside.values()]
            smallest = min(abs(value) for value in values)
            shared = all((value / smallest).denominator == 1 for value in values)
            content = smallest if shared else Fraction(1)
            content = content if any(value > 0 for value in values) else -content
            parts = [
                (as_fraction(v) / content, _plain(at, names, style)) for at, v in inside.items()
            ]
            terms.append((content, f"{letter}{style.times}({signed_sum(parts, style)})"))
    return signed_sum(terms, style)


def combination_text(combination: Mapping[str, Fraction], style: TextStyle = TEXT) -> str:
    """A combination of named coefficients: "2*PJ1 + 2*PJ3", "-PJ5/2"."""
    return signed_sum(((value, style.name(name)) for name, value in combination.items()), style)


def signed_sum(terms: Iterable[tuple[Fraction, str]], style: TextStyle = TEXT) -> str:
    """Sum of number * text with the signs pulled out; an empty text is 1."""
    out = ""
    for value, text in terms:
        size = abs(value)
        if not text:
            piece = style.fraction(size)
        elif size == 1:
            piece = text
        elif size.denominator == 1 or style.latex or style.decimal(size):
            piece = f"{style.fraction(size)}{style.times}{text}"
        elif size.numerator == 1:
            piece = f"{text}/{size.denominator}"
        else:
            piece = f"{size.numerator}{style.times}{text}/{size.denominator}"
        if out:
            out += f" - {piece}" if value < 0 else f" + {piece}"
        else:
            out = f"-{piece}" if value < 0 else piece
    return out or "0"


def _plain(at: Sequence[int], names: Sequence[str], style: TextStyle) -> str:
    """The monomial in the order of its generators; empty for 1."""
    return style.times.join(style.power(name, e) for name, e in zip(names, at, strict=True) if e)
