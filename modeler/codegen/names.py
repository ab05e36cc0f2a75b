"""C names: of the module, of geometric symbols, of arrays."""

import re
from collections.abc import Iterable

from modeler.core.errors import EmitError

# Headers of C99: a file of that name beside the code would stand in their place.
_HEADERS = (
    "assert", "complex", "ctype", "errno", "fenv", "float", "inttypes", "iso646", "limits",
    "locale", "math", "setjmp", "signal", "stdarg", "stdbool", "stddef", "stdint", "stdio",
    "stdlib", "string", "tgmath", "time", "wchar", "wctype",
)  # fmt: skip


def module_prefix(robot: str) -> str:
    """Start of all C names of a robot: `sr400-tree` -> `sr400_tree`, `3rrr` -> `robot_3rrr`.

    Raises:
        EmitError: the name would clash with the runtime's or a header of C.
    """
    prefix = re.sub(r"[^A-Za-z0-9_]+", "_", robot).strip("_").lower() or "robot"
    if prefix[0].isdigit():
        prefix = f"robot_{prefix}"
    if prefix == "modeler" or prefix.startswith("modeler_"):
        raise EmitError(f'name "{robot}": names that start with modeler_ are taken; choose another')
    if prefix in _HEADERS:
        raise EmitError(f'name "{robot}": {prefix}.h is a header of C; choose another')
    return prefix


def symbol_macros(prefix: str, symbols: Iterable[str]) -> dict[str, str]:
    """{geometric symbol: macro}, spelled as in the table: D4 -> PUMA560_GEO_D4.

    The `GEO` keeps them apart from macros of the header (PUMA560_JOINTS) and of <math.h>: robot
    `fp` with a symbol `NAN` would define FP_NAN.

    Raises:
        EmitError: a symbol is not a C name.
    """
    macros: dict[str, str] = {}
    for symbol in symbols:
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", symbol):
            raise EmitError(
                f"symbol {symbol} has letters that C names cannot have; use a-z, A-Z, 0-9 and _"
            )
        macros[symbol] = f"{prefix.upper()}_GEO_{symbol}"
    return macros


def enumerators(prefix: str, kind: str, names: Iterable[str]) -> list[str]:
    """C constants of places in a list of parameters: PUMA560_BETA_ZZ1R, spelled as it is printed.

    `BETA` and `CHI` keep them apart from the header's other names, as GEO does symbols. The reader
    of robot files sees to it that parameters have different names of letters, digits and `_`.

    Args:
        prefix: of the module.
        kind: "beta" or "chi".
        names: of the parameters, in order.
    """
    return [f"{prefix}_{kind}_".upper() + name for name in names]


def symbol_constants(prefix: str, symbols: Iterable[str]) -> dict[str, str]:
    """{geometric symbol: C constant that the functions read}: D4 -> puma560_geo_D4.

    What stands in a macro is text, and may be any expression: `-0.613-0.01` squared would be no
    square. As the initialiser of a `const double` it is one number.
    """
    return {symbol: f"{prefix}_geo_{symbol}" for symbol in symbols}


def graph_places(joints: int, symbols: dict[str, str], arrays: Iterable[str]) -> dict[str, str]:
    """C text of every graph symbol: entries of arrays as they are named, geometric symbols."""
    kinds = ("q", "qd", "qdd", "dq")
    inputs = [f"{kind}[{i}]" for kind in kinds for i in range(joints)]
    return {**symbols, **{name: name for name in (*inputs, *arrays)}}
