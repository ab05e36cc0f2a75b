"""Fractions of polynomials in few of many letters.

sympy's divisors (Liao and Fateman 1995, heuristic gcd) go through every letter of the ring, one
inside the other. Of the letters of a parallel robot two occur in a fraction; its derivation spent
40 % of its time on the others.
"""

from functools import cache, lru_cache
from typing import Any

from sympy.polys.fields import FracElement
from sympy.polys.rings import PolyElement, PolyRing


class Fraction(FracElement):
    """numer / denom without common divisors, which are looked for among the letters in them."""

    def new(self, numer: PolyElement, denom: PolyElement) -> "Fraction":
        """numer / denom, cancelled."""
        # sympy is quick where one of them has one term.
        found = numer.cancel(denom) if min(len(numer), len(denom)) < 2 else cancelled(numer, denom)
        return self.raw_new(*found)


@lru_cache(maxsize=4096)
def cancelled(numer: PolyElement, denom: PolyElement) -> tuple[PolyElement, PolyElement]:
    """Both without their common divisors, as `numer.cancel(denom)`; most ask again."""
    ring = numer.ring
    degrees = [max(exponents) for exponents in zip(*numer, *denom, strict=True)]
    used = tuple(i for i, degree in enumerate(degrees) if degree)
    if len(used) == ring.ngens or not used:
        return numer.cancel(denom)
    small = _of(ring, used)
    top, bottom = (_carried(part, small, used) for part in (numer, denom))
    top, bottom = top.cancel(bottom)
    return _returned(top, ring, used), _returned(bottom, ring, used)


@cache
def _of(ring: PolyRing, used: tuple[int, ...]) -> PolyRing:
    """The ring of these letters alone, in the same order."""
    return ring.clone(symbols=[ring.symbols[i] for i in used])


def _carried(part: PolyElement, small: PolyRing, used: tuple[int, ...]) -> PolyElement:
    return small.from_dict({tuple(m[i] for i in used): c for m, c in part.items()})


def _returned(part: PolyElement, ring: PolyRing, used: tuple[int, ...]) -> PolyElement:
    found: dict[tuple[int, ...], Any] = {}
    for monomial, coefficient in part.items():
        whole = [0] * ring.ngens
        for place, exponent in zip(used, monomial, strict=True):
            whole[place] = exponent
        found[tuple(whole)] = coefficient
    return ring.from_dict(found)
