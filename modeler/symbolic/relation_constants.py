"""The constant of a linear relation between joints, as a combination of the robot's symbols.

u_p = sum c_k u_k + constant. How the constant depends on a symbol is seen by closing the loops anew
with a slightly different value of it: the derivative is a rational number, of a length also a
rational multiple of the cosine or sine of an angle. What is left is a multiple of pi/12, a short
decimal number of the table, or both. This only proposes; `modeler.symbolic.relation_proof` proves.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from modeler.symbolic.closing import Closing

Term = tuple[Fraction, str]
"""factor * text."""

_SAME = 1e-9
_STEP = 1e-4
_NEAR = 0.1
_ITERATIONS = 5
_SLOPE = 1e-6
_LARGEST_DENOMINATOR = 4
_SHARES = [Fraction(sign * n, d) for n, d in ((1, 1), (2, 1), (1, 2)) for sign in (1, -1)]
_DECIMALS = 10
_EXACT = 1e-13
"""Home is polished to the digits of a double."""
_TWELFTHS = 24


class Constants:
    """Constants of relations of one robot at its home."""

    def __init__(self, closing: Closing, home: np.ndarray, derived: Mapping[str, float]) -> None:
        """Constants at a closed posture.

        Args:
            closing: the independent equations of the robot's loops, which say its symbols.
            home: the posture.
            derived: values of symbols that are given by expressions of others.
        """
        self.closing, self.home, self.derived = closing, home, derived
        self._moved: dict[str, np.ndarray] | None = None

    def terms(self, coefficients: np.ndarray, angular: bool) -> list[Term] | None:
        """The constant coefficients . home as a sum of terms; None where none is found.

        Args:
            coefficients: by variable: 1 for the one that follows, -c_k for the others.
            angular: True for an angle, False for a travel.
        """
        value = float(coefficients @ self.home)
        terms = list(self._slopes(coefficients, angular))
        left = value - sum(float(c) * self._value(text) for c, text in terms)
        rest = _turns(left, angular)
        if rest is not None:
            return [*terms, *rest]
        derived = self._of_derived(value, angular)
        if derived is not None:
            return derived
        rest = _with_decimal(left, angular)
        return None if rest is None else [*terms, *rest]

    def _of_derived(self, value: float, angular: bool) -> list[Term] | None:
        """The constant by one symbol that is no combination of the others: w = sqrt(v)."""
        for name, size in self.derived.items():
            for share in _SHARES:
                rest = _turns(value - float(share) * size, angular)
                if rest is not None:
                    return [(share, name), *rest]
        return None

    def _slopes(self, coefficients: np.ndarray, angular: bool) -> Iterator[Term]:
        """The symbols on which the constant depends."""
        for name, moved in self._perturbed().items():
            change = float(coefficients @ (moved - self.home)) / _STEP
            for factor, size in self._factors(name, angular):
                if abs(size) > _STEP:
                    share = Fraction(change / size).limit_denominator(_LARGEST_DENOMINATOR)
                    if abs(float(share) * size - change) < _SLOPE:
                        if share:
                            yield share, f"{name}{factor}"
                        break

    def _factors(self, name: str, angular: bool) -> Iterator[tuple[str, float]]:
        """What a symbol may be multiplied by: text and value."""
        yield "", 1.0
        if not angular:
            for other, value in self.closing.values.items():
                if other not in (name, "g"):
                    yield f"*cos({other})", math.cos(value)
                    yield f"*sin({other})", math.sin(value)

    def _value(self, text: str) -> float:
        name, _, factor = text.partition("*")
        value = float(self.closing.values[name])
        if not factor:
            return value
        function, other = factor[:3], factor[4:-1]
        return value * getattr(math, function)(self.closing.values[other])

    def _perturbed(self) -> Mapping[str, np.ndarray]:
        """By symbol, home closed anew with another value of it; where it does not, left out."""
        if self._moved is None:
            names, closing = list(self.closing.values), self.closing
            with np.errstate(all="ignore"):  # the root of a length that became negative
                moved = self._closed_anew(names)
            far = np.abs(moved - self.home) / closing.scale
            near = np.max(far, axis=1, initial=0.0) < _NEAR
            self._moved = {
                name: u for name, u, good in zip(names, moved, near, strict=True) if good
            }
        return self._moved

    def _closed_anew(self, names: Sequence[str]) -> np.ndarray:
        """(names, unknowns): Newton from home, one sample for each symbol."""
        closing, count = self.closing, len(names)
        values: dict[str, Any] = {n: np.full(count, self.closing.values[n]) for n in names}
        for i, name in enumerate(names):
            values[name][i] += _STEP
        moved = replace(closing, values=values)
        u = np.tile(self.home, (count, 1))
        solved = list(closing.solved)
        for _ in range(_ITERATIONS):
            inner, open_by = moved.jacobians(u)[:, :, solved], moved.residuals(u)
            u[:, solved] -= np.linalg.solve(inner, open_by[:, :, None])[:, :, 0]
        return u


def _turns(value: float, angular: bool) -> list[Term] | None:
    """A multiple of pi/12 for an angle, nothing for a travel."""
    twelfths = round(value / (math.pi / 12)) if angular else 0
    if abs(value - twelfths * math.pi / 12) > _SAME:
        return None
    return [(Fraction(twelfths, 12), "pi")]


def _with_decimal(value: float, angular: bool) -> list[Term] | None:
    """A short decimal number, with a multiple of pi/12 for an angle."""
    most = _TWELFTHS if angular else 0
    for size in sorted(range(-most, most + 1), key=abs):
        rest = value - size * math.pi / 12
        short = round(rest, _DECIMALS)
        if abs(rest - short) < _EXACT:
            return [(Fraction(size, 12), "pi"), (Fraction(repr(short)), "")]
    return None
