"""What emitted arithmetic is made of: the number type, its literals and the names of its functions.

One emitter writes a function for doubles, for floats, and for a vector whose lanes are samples.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType

from modeler.core.choices import Precision

FUNCTIONS = ("sin", "cos", "tan", "sqrt", "exp", "tanh", "abs", "pow", "sign")
"""Functions of the graph: those of math.h, and the sign of modeler_runtime.h."""

_MATH = {name: name for name in FUNCTIONS} | {"abs": "fabs"}


@dataclass(frozen=True)
class Target:
    """How a value is written.

    Attributes:
        number: C type of a value that depends on the motion.
        suffix: of a literal.
        precision: "double" or "single", for messages.
        exact: integers up to here are exact, so a quotient of two such literals is rounded once.
        largest: greatest finite number.
        functions: {function of the graph: C name}, all of `FUNCTIONS`.
        sincos: C name of the function that gives sine and cosine at once.
        smooth_sign: C name of the sign that turns over a width.
        spread: C text of a value of all lanes that are alike, of `{0}`, one number.
        constant: target of values that do not depend on the motion; None: this one.
    """

    number: str
    suffix: str
    precision: Precision
    exact: int
    largest: Fraction
    functions: Mapping[str, str]
    sincos: str
    smooth_sign: str
    spread: str = "{0}"
    constant: "Target | None" = None

    @property
    def still(self) -> "Target":
        """The target of constants of the geometry."""
        return self.constant or self


def _largest(digits: int, exponent: int) -> Fraction:
    return Fraction(2**digits - 1) * 2 ** (exponent - digits)


DOUBLE = Target(
    number="double",
    suffix="",
    precision="double",
    exact=2**53,
    largest=_largest(53, 1024),
    functions=MappingProxyType(_MATH | {"sign": "modeler_sign"}),
    sincos="modeler_sincos",
    smooth_sign="smooth_sign",
)

SINGLE = Target(
    number="float",
    suffix="f",
    precision="single",
    exact=2**24,
    largest=_largest(24, 128),
    functions=MappingProxyType(
        {name: f"{c}f" for name, c in _MATH.items()} | {"sign": "modelerf_sign"}
    ),
    sincos="modelerf_sincos",
    smooth_sign="smooth_sign",
)

OF_PRECISION: Mapping[Precision, Target] = MappingProxyType({"double": DOUBLE, "single": SINGLE})
"""Targets of one sample."""

TILE = Target(
    number="modeler_lanes",
    suffix="",
    precision="double",
    exact=DOUBLE.exact,
    largest=DOUBLE.largest,
    functions=MappingProxyType({name: f"modeler_lanes_{c}" for name, c in _MATH.items()}),
    sincos="modeler_lanes_sincos",
    smooth_sign="modeler_lanes_smooth_sign",
    spread="modeler_lanes_spread({0})",
    constant=DOUBLE,
)
