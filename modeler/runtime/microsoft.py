"""Microsoft's compiler and linker: the flags that they take, and what a library of theirs exports.

Only what a list names is exported. `clang` for that system writes the same objects.
"""

import struct
from collections.abc import Iterable, Sequence
from pathlib import Path

BANNER = "Microsoft (R)"
"""What `cl` says of itself when it is started alone."""

ALWAYS = ("/nologo", "/std:c11", "/utf-8")
PORTABLE = (*ALWAYS, "/O2", "/fp:precise")
WANTED = ("/fp:contract",)
"""Fused multiply-add, where /arch allows it; cl of before 2022 does not know it."""

_EXTERNAL = 2  # IMAGE_SYM_CLASS_EXTERNAL


def build_check_arguments(flag: str, empty: Path) -> list[str]:
    """Arguments that end without a mistake if the compiler knows the flag."""
    return [*ALWAYS, flag, "/Zs", str(empty)]


def build_compile_arguments(folder: Path, source: Path, result: str) -> list[str]:
    """Arguments beside the flags."""
    return ["/I", str(folder), "/c", f"/Fo{result}", str(source)]


def build_link_arguments(objects: Sequence[str], output: Path, export_list: Path) -> list[str]:
    """The same, for a library of objects whose exports `export_list` names."""
    return ["/LD", *objects, f"/Fe{output}", "/link", f"/DEF:{export_list}"]


def format_exports(objects: Iterable[str]) -> str:
    """The list for the linker (a module-definition file) of all that the objects define."""
    names = {name for place in objects for name in read_exported_names(Path(place).read_bytes())}
    return "\n".join(["EXPORTS", *sorted(names), ""])


def read_exported_names(coff: bytes) -> list[str]:
    """Functions and tables that an object defines for others.

    From its symbol table, as in "PE Format", sections "COFF File Header" and "COFF Symbol Table":
    18 bytes each, long names in the table of strings after them.
    """
    start, count = struct.unpack_from("<II", coff, 8)
    names, k = list[str](), 0
    while k < count:
        at = start + 18 * k
        short, _, section, _, storage, more = struct.unpack_from("<8sIhHBB", coff, at)
        if short[:4] == bytes(4):
            first = start + 18 * count + int.from_bytes(short[4:], "little")
            short = coff[first : coff.index(b"\0", first)]
        name = short.rstrip(b"\0").decode()
        if storage == _EXTERNAL and section > 0 and name.isidentifier():  # no `__real@...`
            names.append(name)
        k += 1 + more  # what follows a symbol tells more of it
    return names
