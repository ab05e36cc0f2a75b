"""What emitted arithmetic is made of: number type, literals, functions; single precision.

One emitter writes a function for doubles, for floats, and for a vector whose lanes are samples.
"""

import dataclasses
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType

from modeler.core.errors import EmitError, Precision

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


DOUBLE = Target(
    number="double",
    suffix="",
    precision="double",
    exact=2**53,
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
    largest=Fraction(2**24 - 1) * 2 ** (128 - 24),
    functions=MappingProxyType(
        {name: f"{c}f" for name, c in _MATH.items()} | {"sign": "modelerf_sign"}
    ),
    sincos="modelerf_sincos",
    smooth_sign="smooth_sign",
)

OF_PRECISION: Mapping[Precision, Target] = MappingProxyType({"double": DOUBLE, "single": SINGLE})
"""Targets of one sample."""

CUDA = dataclasses.replace(DOUBLE, sincos="sincos")
"""CUDA has all functions of math.h, and one of its own for both."""

TILE = dataclasses.replace(
    DOUBLE,
    number="modeler_lanes",
    functions=MappingProxyType({name: f"modeler_lanes_{c}" for name, c in _MATH.items()}),
    sincos="modeler_lanes_sincos",
    smooth_sign="modeler_lanes_smooth_sign",
    spread="modeler_lanes_spread({0})",
    constant=DOUBLE,
)


# C of doubles as C of floats: the one source of a module in single precision.
#
# Templates, emitted functions and the runtime are written once, in double precision. Here their
# words change: types, literals, functions of <math.h>, and the names of the runtime, since a
# program may hold robots of both kinds (`modeler_batch_1` of doubles, `modelerf_batch_1` of
# floats). Comments, texts and preprocessor lines that include stay. What is arithmetic of its own
# in single precision, sine and cosine, stands in `csrc/single`.


SMALLEST, LARGEST = 2.0**-126, (2 - 2.0**-23) * 2.0**127
"""Normal numbers of single precision."""

WIDE = "(DOUBLE)"
"""Written before what stays double: floats that printf prints."""

_WORDS = re.compile(
    r"""
    (?P<kept> /\*.*?\*/ | \#[ ]*include[^\n]* | '(?:\\.|[^'\\])*' )
  | (?P<text> "(?:\\.|[^"\\])*" )
  | (?P<name> [A-Za-z_]\w* )
  | (?P<number> 0[xX][0-9a-fA-F]+[uUlL]* | (?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?[uUlLfF]* )
    """,
    re.DOTALL | re.VERBOSE,
)

_MATH_CALLS = (
    "acos", "asin", "atan", "atan2", "copysign", "cos", "exp", "expm1", "fabs", "floor", "fma",
    "fmax", "fmin", "fmod", "hypot", "ldexp", "log", "log1p", "pow", "rint", "round", "sin", "sqrt",
    "tan", "tanh", "trunc",
)  # fmt: skip
_NAMES = {"double": "float", "DOUBLE": "double", "atof": "(float)atof"}

_SHARED = ("modeler_status", "modeler_first")
"""Names of the runtime that both precisions have."""

# Bounds of the closing of loops that follow from the precision: the correction after which the
# error is its square, one that is not worth making, pivots that are zero, the shortest step.
_BOUNDS = {"MODELER_SMALLEST_PIVOT": "1e-5", "MODELER_CONVERGED": "1e-4", "CONVERGED": "2e-4", "EXACT": "2e-6", "FLAT": "1e-4", "SHORTEST": "1e-4"}


def of_precision(precision: Precision, files: Mapping[str, str]) -> dict[str, str]:
    """{name: text} of files in that precision; what is no C is left alone.

    Raises:
        EmitError: a number is too large or too small for it; says which.
    """
    if precision == "double":
        return dict(files)
    return {
        name: single_text(text) if name.endswith((".c", ".h")) else text
        for name, text in files.items()
    }


def single_text(text: str) -> str:
    """C text of doubles as one of floats."""
    for name, value in _BOUNDS.items():
        text = re.sub(rf"^(#define {name} )\S+", rf"\g<1>{value}", text, flags=re.MULTILINE)
    return _WORDS.sub(_word, text)


def _word(match: re.Match[str]) -> str:
    word = match[0]
    if match["name"]:
        if word in _SHARED:
            return word
        called = match.string[match.end() : match.end() + 1] == "("
        if called and word in _MATH_CALLS:
            return f"{word}f"
        return re.sub(r"^modeler_", "modelerf_", _NAMES.get(word, word))
    if match["text"]:
        return word.replace("%lf", "%f").replace("%.17g", "%.9g")
    if match["number"] and re.fullmatch(r"[\d.]+([eE][+-]?\d+)?f?", word) and not word.isdigit():
        literal = word.removesuffix("f")
        value = float(literal)
        if value != 0.0 and not SMALLEST <= value <= LARGEST:
            raise EmitError(
                f"number {literal} is too {'large' if value > 1 else 'small'} for single "
                f"precision, which has {SMALLEST:.2g} to {LARGEST:.2g}; rescale it, or generate in "
                "double precision"
            )
        return f"{literal}f"
    return word
