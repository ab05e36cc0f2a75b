"""What emitted arithmetic is made of: number type, literals, functions.

One emitter writes a function for doubles, for floats, and for a vector whose lanes are samples.
Templates are given the words of the target of their module (`words`). The hand-written runtime is
the same text for both precisions: there `modeler_real.h` says what a number is, and names the
external functions of floats `modelerf_...`, since a program may hold robots of both kinds.
"""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any

from modeler.core.choices import Precision
from modeler.core.errors import EmitError

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
        smallest: least positive number with all its digits.
        largest: greatest finite number.
        functions: {function of the graph: C name}, all of `FUNCTIONS`.
        sincos: C name of the function that gives sine and cosine at once.
        smooth_sign: C name of the sign that turns over a width.
        law: call of a law that was learned, of `{name}`, `{axes}`, `{along}` (which derivative,
            "", "x" or "y") and `{arguments}`.
        spread: C text of a value of all lanes that are alike, of `{0}`, one number.
        constant: target of values that do not depend on the motion; None: this one.
        point: True if a literal has a point before its exponent, 1.0E-05.
        temporary: statement that names a value.
        stored: statement that writes an output.
        turn: statements that make sine and cosine of an angle.
        remark: comment.
    """

    number: str
    suffix: str
    precision: Precision
    exact: int
    smallest: Fraction
    largest: Fraction
    functions: Mapping[str, str]
    sincos: str
    smooth_sign: str
    law: str = "modeler_law_{axes}{along}(&{name}, {arguments})"
    spread: str = "{0}"
    constant: "Target | None" = None
    point: bool = False
    temporary: str = "const {number} {name} = {text};"
    stored: str = "{place} = {text};"
    turn: tuple[str, str] = ("{number} s{name}, c{name};", "{sincos}({angle}, &s{name}, &c{name});")
    remark: str = "/* {} */"

    @property
    def constant_target(self) -> "Target":
        """Returns the target of constants of the geometry."""
        return self.constant or self

    def round_number(self, value: Fraction) -> float:
        """Returns the double next to a number that this target can hold.

        Raises:
            EmitError: it is too large or too small; says what the target holds.
        """
        size = abs(value)
        if size > self.largest or (0 < size < self.smallest and self.precision == "single"):
            number = str(value) if size > DOUBLE.largest else repr(float(value))
            raise EmitError(
                f"number {number} is too {'large' if size > 1 else 'small'} for {self.precision} "
                f"precision, which has {float(self.smallest):.2g} to {float(self.largest):.2g}; "
                f"rescale it{', or generate in double precision' * (self.precision == 'single')}"
            )
        return float(value)

    def format_literal(self, value: float) -> str:
        """Returns a number as C has it.

        Raises:
            EmitError: it is too large or too small.
        """
        self.round_number(Fraction(value))
        digits, power, exponent = repr(value).partition("e")
        if power and self.point:
            digits, power = digits if "." in digits else f"{digits}.0", "E"
        return f"{digits}{power}{exponent}{self.suffix}"

    @property
    def template_words(self) -> dict[str, Any]:
        """Returns what templates write numbers with."""
        single = self.precision == "single"
        return {
            "single": single,
            "real": self.number,  # the type
            "f": self.suffix,  # of literals, and of the functions of <math.h>
            "literal": self.format_literal,
            "wide": "(double)" if single else "",  # before what printf prints
        }


DOUBLE = Target(
    number="double",
    suffix="",
    precision="double",
    exact=2**53,
    smallest=Fraction(1, 2**1022),
    largest=Fraction(2**53 - 1) * 2 ** (1024 - 53),
    functions=MappingProxyType(_MATH | {"sign": "modeler_sign"}),
    sincos="modeler_sincos",
    smooth_sign="smooth_sign",
)

SINGLE = Target(
    number="float",
    suffix="f",
    precision="single",
    exact=2**24,
    smallest=Fraction(1, 2**126),
    largest=Fraction(2**24 - 1) * 2 ** (128 - 24),
    functions=MappingProxyType(
        {name: f"{c}f" for name, c in _MATH.items()} | {"sign": "modeler_sign"}
    ),
    sincos="modeler_sincos",
    smooth_sign="smooth_sign",
)

OF_PRECISION: Mapping[Precision, Target] = MappingProxyType({"double": DOUBLE, "single": SINGLE})
"""Targets of one sample."""

CUDA = dataclasses.replace(DOUBLE, sincos="sincos")
"""CUDA has all functions of math.h, and one of its own for both."""

TILES: Mapping[Precision, Target] = MappingProxyType(
    {
        precision: dataclasses.replace(
            target,
            number="modeler_lanes",
            functions=MappingProxyType({name: f"modeler_lanes_{c}" for name, c in _MATH.items()}),
            sincos="modeler_lanes_sincos",
            smooth_sign="modeler_lanes_smooth_sign",
            law="modeler_lanes_law_{axes}{along}(&{name}, {arguments})",
            spread="modeler_lanes_spread({0})",
            constant=target,
        )
        for precision, target in OF_PRECISION.items()
    }
)
"""Targets of vectors whose lanes are samples."""
