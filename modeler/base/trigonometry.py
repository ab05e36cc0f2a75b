"""Turning rational functions of t = tan(a/2) back into what people write: cos(a) and sin(a)."""

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

import sympy
from sympy import QQ
from sympy.polys.rings import PolyElement, ring

Terms = Sequence[tuple[tuple[int, ...], Any]]
"""(exponents, coefficient) of a polynomial."""

Letters = Mapping[sympy.Expr, str]
"""What each generator stands for -> "symbol", "angle" or "opaque"."""


def in_cosines(numerator: PolyElement, denominator: PolyElement, letters: Letters) -> sympy.Expr:
    """numerator / denominator, polynomials in the letters (t for an angle), as an expression.

    Both are divided by (1 + t**2)**K, after which they are polynomials in cos and sin:
    t**2/(1 + t**2) = (1 - c)/2, 1/(1 + t**2) = (1 + c)/2, t/(1 + t**2) = s/2. Sums are written
    expanded, with s**2 or c**2 eliminated, whichever leaves fewer terms.
    """
    degrees = [
        max((m[i] for part in (numerator, denominator) for m in part), default=0)
        for i in range(len(letters))
    ]
    used = [i for i, degree in enumerate(degrees) if degree]
    names = list(letters)
    target = _Target({names[i]: letters[names[i]] for i in used})
    pairs = [(degrees[i] + 1) // 2 for i in used]
    parts = [
        [(tuple(m[i] for i in used), c) for m, c in part.terms()]
        for part in (numerator, denominator)
    ]
    top, bottom = (target.converted(part, pairs) for part in parts)
    top, bottom = top.cancel(bottom)
    return target.shortest(top) / target.shortest(bottom)


_ALL_CHOICES = 4


class _Target:
    """The ring Q[letters, cosines, sines]: each angle has two generators there."""

    def __init__(self, letters: Letters) -> None:
        self.names: list[sympy.Expr] = []
        self.slots: list[int] = []
        self.angles: list[int] = []
        for letter, kind in letters.items():
            self.slots.append(len(self.names))
            if kind == "angle":
                self.angles.append(len(self.names))
                self.names += [letter.doit(), sympy.sin(letter.args[0])]
            else:
                self.names.append(letter)
        self.ring, *self.generators = ring([f"x{i}" for i in range(len(self.names))], QQ)

    def converted(self, terms: Terms, pairs: Sequence[int]) -> PolyElement:
        """The polynomial divided by (1 + t**2)**pairs for each angle."""
        total = self.ring.zero
        for monomial, coefficient in terms:
            term = self.ring.one * coefficient
            for slot, exponent, K in zip(self.slots, monomial, pairs, strict=True):
                term = term * self._factor(slot, exponent, K)
            total = total + term
        return self.reduced(total, (True,) * len(self.angles))

    def _factor(self, slot: int, exponent: int, K: int) -> Any:
        if slot not in self.angles:
            return self.generators[slot] ** exponent
        c, s = self.generators[slot], self.generators[slot + 1]
        squares, single = divmod(exponent, 2)
        half = QQ(1, 2)
        factor = ((1 - c) * half) ** squares * ((1 + c) * half) ** (K - squares - single)
        return factor * (s * half) if single else factor

    def reduced(self, poly: PolyElement, keep_cosines: Sequence[bool]) -> PolyElement:
        """With s**2 = 1 - c**2 (keep cosines) or c**2 = 1 - s**2, per angle."""
        for slot, keep in zip(self.angles, keep_cosines, strict=True):
            gone, stays = (slot + 1, slot) if keep else (slot, slot + 1)
            square = 1 - self.generators[stays] ** 2
            total = self.ring.zero
            for monomial, coefficient in poly.terms():
                pairs, rest = divmod(monomial[gone], 2)
                left = list(monomial)
                left[gone] = rest
                total = total + self.ring({tuple(left): coefficient}) * square**pairs
            poly = total
        return poly

    def shortest(self, poly: PolyElement) -> sympy.Expr:
        """The expanded form of fewest terms; with many angles the choices are made in turn."""
        count = len(self.angles)
        if count <= _ALL_CHOICES:
            choices = product((True, False), repeat=count)
            best = min((self.reduced(poly, keep) for keep in choices), key=len)
        else:
            keep = [True] * count
            best = self.reduced(poly, keep)
            for i in range(count):
                other = [k != (i == j) for j, k in enumerate(keep)]
                form = self.reduced(poly, other)
                if len(form) < len(best):
                    best, keep = form, other
        return sympy.Add(*(self._term(m, c) for m, c in best.terms()))

    def _term(self, monomial: tuple[int, ...], coefficient: Any) -> sympy.Expr:
        number = sympy.Rational(int(coefficient.numerator), int(coefficient.denominator))
        return sympy.Mul(
            number, *(name**e for name, e in zip(self.names, monomial, strict=True) if e)
        )
