"""C names: of the module, of geometric symbols, of arrays."""

import re
from collections.abc import Iterable

from modeler.core.errors import EmitError

# Macros of the header, and its include guard.
_TAKEN = {"JOINTS", "STANDARD_PARAMETERS", "BASE_PARAMETERS", "NONZEROS", "H"}


def module_prefix(robot: str) -> str:
    """Start of all C names of a robot: `sr400-tree` -> `sr400_tree`, `3rrr` -> `robot_3rrr`.

    Raises:
        EmitError: the name would clash with the runtime's.
    """
    prefix = re.sub(r"[^A-Za-z0-9_]+", "_", robot).strip("_").lower() or "robot"
    if prefix[0].isdigit():
        prefix = f"robot_{prefix}"
    if prefix == "modeler" or prefix.startswith("modeler_"):
        raise EmitError(f'name "{robot}": names that start with modeler_ are taken; choose another')
    return prefix


def symbol_macros(prefix: str, symbols: Iterable[str]) -> dict[str, str]:
    """{geometric symbol: macro}, spelled as in the table: D4 -> PUMA560_D4, al1 -> WRIST_al1.

    Raises:
        EmitError: a symbol is not a C name.
    """
    macros: dict[str, str] = {}
    for symbol in symbols:
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", symbol):
            raise EmitError(
                f"symbol {symbol} has letters that C names cannot have; use a-z, A-Z, 0-9 and _"
            )
        macros[symbol] = f"{prefix.upper()}_{symbol}" + ("_" if symbol in _TAKEN else "")
    if len(set(macros.values())) < len(macros):
        raise EmitError(f"symbols {', '.join(macros)} do not get different names in C; rename one")
    return macros


def graph_places(joints: int, macros: dict[str, str], arrays: Iterable[str]) -> dict[str, str]:
    """C text of every graph symbol: entries of arrays as they are named, geometric symbols."""
    inputs = [f"{kind}[{i}]" for kind in ("q", "qd", "qdd") for i in range(joints)]
    return {**macros, **{name: name for name in (*inputs, *arrays)}}
