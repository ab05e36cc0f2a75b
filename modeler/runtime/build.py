"""Compiling on this machine: compiler, flags, threads, the cache of libraries."""

import dataclasses
import hashlib
import os
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import TypeVar

from modeler.core.errors import BuildError

A = TypeVar("A")
T = TypeVar("T")


def count_processors() -> int:
    """Returns how many this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def split_samples(samples: int, least: int) -> list[slice]:
    """Returns the samples in about equal parts, one for each thread that is worth starting.

    Args:
        samples: how many.
        least: that a thread is worth starting for.
    """
    count = max(1, min(count_processors(), samples // least))
    borders = [samples * k // count for k in range(count + 1)]
    return [slice(a, b) for a, b in pairwise(borders)]


def map_parts(function: Callable[[A], T], parts: Sequence[A]) -> Iterator[T]:
    """Yields the function of each part, in their order; in threads where there are several."""
    threads = min(len(parts), count_processors())
    if threads < 2:
        yield from map(function, parts)
        return
    with ThreadPoolExecutor(threads) as pool:
        yield from pool.map(function, parts)


# Microsoft's compiler and linker: the flags that they take, and what a library of theirs exports.
#
# Only what a list names is exported. `clang` for that system writes the same objects.


MICROSOFT_BANNER = "Microsoft (R)"
"""What `cl` says of itself when it is started alone."""

MICROSOFT_ALWAYS = ("/nologo", "/std:c11", "/utf-8")
MICROSOFT_PORTABLE = (*MICROSOFT_ALWAYS, "/O2", "/fp:precise")
MICROSOFT_WANTED = ("/fp:contract",)
"""Fused multiply-add, where /arch allows it; cl of before 2022 does not know it."""

_EXTERNAL = 2  # IMAGE_SYM_CLASS_EXTERNAL


def read_exported_names(coff: bytes) -> list[str]:
    """Returns functions and tables that an object defines for others.

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
        k += 1 + more  # what follows a symbol shows more of it
    return names


# Compiling on this machine: the C compiler, its flags, the cache of libraries.


_WINDOWS = sys.platform == "win32"

_NAMES = ("cc", "gcc", "clang", *["cl"] * _WINDOWS)

_INSTALL = (
    "install one: Debian, Ubuntu `apt install gcc`, Fedora `dnf install gcc`, "
    "macOS `xcode-select --install`, Windows gcc of MinGW-w64 or Visual Studio; or set CC"
)

SUFFIX = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
"""How the name of a library ends."""

# Each line: alternatives, of which the first that the compiler knows is taken, or none.
# gcc's vectoriser of straight-line code costs half the speed of a regressor (172 against 89 ns);
# -ffast-math would change results, these do not but for fused multiply-add.
_WANTED = (
    ("-fno-tree-slp-vectorize", "-fno-slp-vectorize"),
    ("-fno-math-errno",),
    ("-fno-trapping-math",),
    ("-ffp-contract=fast",),
    ("-march=native", "-mcpu=native"),
)
_ALWAYS = ("-std=c99", *["-fPIC"] * (not _WINDOWS))
_OPTIMISED = "-O3"


@dataclass(frozen=True)
class Toolchain:
    """A compiler and its flags.

    Attributes:
        command: e.g. ("gcc",) or ("ccache", "gcc").
        flags: all of them known to it.
        identity: everything about compiler and processor that can change the library.
        microsoft: its arguments are spelled as those of cl.
    """

    command: tuple[str, ...]
    flags: tuple[str, ...]
    identity: str
    microsoft: bool = False


def find_toolchain() -> Toolchain:
    """Returns the compiler named by the environment variable CC, else the first of cc, gcc, clang.

    On Windows cl, Microsoft's, comes after them.

    The environment variable CFLAGS takes the place of the flags that are chosen otherwise: -O3,
    code for this very processor, fused multiply-add. Where CC has a flag, what is chosen of its
    kind is left out: `CC="gcc -march=x86-64-v2"` gives code for that processor.

    Raises:
        BuildError: there is none, or it does not know a flag of CFLAGS; says what to do.
    """
    wanted = os.environ.get("CC", "").strip()
    if wanted:
        command = (wanted,) if shutil.which(wanted) else _split_words("CC", wanted)
        if shutil.which(command[0]) is None:
            raise BuildError(
                f'C compiler: got CC="{wanted}", which is not found; correct it, or {_INSTALL}'
            )
    else:
        available = [(name,) for name in _NAMES if shutil.which(name) is not None]
        if not available:
            raise BuildError(f"C compiler: none of {', '.join(_NAMES)} is found; {_INSTALL}")
        command = available[0]
    return _examine_compiler(command, _split_words("CFLAGS", os.environ.get("CFLAGS", "")))


def _split_words(variable: str, text: str) -> tuple[str, ...]:
    try:
        return tuple(shlex.split(text.replace("\\", "/") if _WINDOWS else text))
    except ValueError as error:
        raise BuildError(
            f'C compiler: got {variable}="{text}" ({error}); expected words as in a shell; '
            "correct it"
        ) from None


@lru_cache(maxsize=8)
def _examine_compiler(command: tuple[str, ...], user_flags: tuple[str, ...]) -> Toolchain:
    used = (*_ALWAYS, *(user_flags or _choose_flags(command)))
    # The predefined macros name the compiler's version and, with -march=native, this processor.
    macros = _run_compiler(command, [*used, "-dM", "-E", "-x", "c", os.devnull])
    if macros.returncode != 0 and not _can_use(command, []):
        alone = _run_compiler(command, [])
        if MICROSOFT_BANNER in (banner := alone.stderr + alone.stdout):
            flags = (*MICROSOFT_ALWAYS, *(user_flags or ("/O2", *_find_microsoft_flags(command))))
            return Toolchain(command, flags, banner, microsoft=True)
    elif user_flags and macros.returncode != 0:
        message = macros.stderr.strip().partition("\n")[0]
        raise BuildError(
            f'C compiler: {shlex.join(command)} refuses CFLAGS="{shlex.join(user_flags)}" '
            f"({message}); "
            "correct it, or leave it empty"
        )
    return Toolchain(command, used, macros.stdout)


def _find_microsoft_flags(command: tuple[str, ...]) -> list[str]:
    """The wanted flags that this cl knows."""
    with tempfile.TemporaryDirectory() as scratch:
        empty = Path(scratch) / "empty.c"
        empty.touch()
        tried = {
            flag: _run_compiler(command, [*MICROSOFT_ALWAYS, flag, "/Zs", str(empty)])
            for flag in MICROSOFT_WANTED
        }
    return [flag for flag, ended in tried.items() if ended.returncode == 0]


def _choose_flags(command: tuple[str, ...]) -> list[str]:
    """The wanted flags that the compiler knows; none of a kind that its command has already."""
    stated = {_get_flag_kind(word) for word in command[1:]}
    wanted = [each for each in _WANTED if not stated & {_get_flag_kind(flag) for flag in each}]
    optimised = [] if _get_flag_kind(_OPTIMISED) in stated else [_OPTIMISED]
    favourites = [alternatives[0] for alternatives in wanted]
    if _can_use(command, favourites):  # one start of the compiler instead of one per flag
        return optimised + favourites
    flags = optimised
    if not _can_use(command, []):  # of another kind
        return flags
    for alternatives in wanted:
        flags += [flag for flag in alternatives if _can_use(command, [flag])][:1]
    return flags


def _get_flag_kind(flag: str) -> str:
    """What a flag says something of: -O2 and -Os, -march=native and -march=core2 are of a kind."""
    if flag.startswith("-O"):
        return "-O"
    return flag.partition("=")[0].replace("-fno-", "-f", 1)


def _can_use(command: Sequence[str], flags: Sequence[str]) -> bool:
    # clang only warns of flags that it ignores.
    test = ["-Werror", *flags, "-fsyntax-only", "-x", "c", os.devnull]
    return _run_compiler(command, test).returncode == 0


def _run_compiler(
    command: Sequence[str], arguments: Sequence[str]
) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(
            [*command, *arguments], capture_output=True, text=True, errors="replace", check=False
        )
    except OSError as error:
        raise BuildError(
            f"C compiler: {shlex.join(command)} does not start ({error.strerror}); {_INSTALL}"
        ) from error


def compile_library(tools: Toolchain, folder: Path, sources: Sequence[str], output: Path) -> None:
    """Compiles C files of `folder` into the shared library `output`; one compiler per processor.

    Raises:
        BuildError: the compiler refused; quotes its own words.
    """

    def compile_one(source: str) -> str:
        result = str(folder / f"{source}.obj")
        if tools.microsoft:
            words = ["/I", str(folder), "/c", f"/Fo{result}", str(folder / source)]
            _run_checked(tools, words)
        else:
            _run_checked(tools, ["-I", str(folder), "-c", "-o", result, str(folder / source)])
        return result

    # Threads only wait here: each for a compiler that is a process of its own.
    objects = list(map_parts(compile_one, sources))
    _run_checked(tools, _build_link_arguments(tools, folder / "exports.def", objects, output))
    if not output.is_file():
        raise BuildError(
            f"C compiler: {shlex.join(tools.command)} succeeded but wrote no library; "
            "expected a C compiler, such as gcc; correct CC"
        )


def _build_link_arguments(
    tools: Toolchain, export_list: Path, objects: Sequence[str], output: Path
) -> Sequence[str]:
    if not (tools.microsoft or "#define _MSC_VER " in tools.identity):
        return ["-shared", "-o", str(output), *objects, "-lm"]
    names = {name for place in objects for name in read_exported_names(Path(place).read_bytes())}
    export_list.write_text("\n".join(["EXPORTS", *sorted(names), ""]), encoding="ascii")
    if tools.microsoft:
        return ["/LD", *objects, f"/Fe{output}", "/link", f"/DEF:{export_list}"]
    return ["-shared", "-o", str(output), *objects, f"-Wl,/DEF:{export_list}"]


def _run_checked(tools: Toolchain, arguments: Sequence[str]) -> None:
    result = _run_compiler([*tools.command, *tools.flags], arguments)
    if result.returncode != 0:
        words = result.stderr.strip() or result.stdout.strip()  # cl writes there
        words = words or f"exit status {result.returncode}, no output"
        raise BuildError(
            f"C compiler: {shlex.join(tools.command)} refused the emitted code:\n{words}\n"
            "(check it, or name another one in CC)"
        )


_PORTABLE = (*_ALWAYS, "-O2", "-ffp-contract=off", "-fvisibility=hidden")


def build_portable_library(sources: Mapping[str, str]) -> bytes:
    """Returns a shared library of these C files that runs on any processor of this kind.

    Args:
        sources: {file name: text}, headers included.

    Raises:
        BuildError: no compiler, or it refused.
    """
    tools = find_toolchain()
    flags = MICROSOFT_PORTABLE if tools.microsoft else _PORTABLE
    tools = dataclasses.replace(tools, flags=flags)
    with tempfile.TemporaryDirectory() as scratch:
        for name, text in sources.items():
            (Path(scratch) / name).write_text(text, encoding="utf-8", newline="\n")
        made = Path(scratch) / f"library{SUFFIX}"
        compile_library(tools, Path(scratch), [n for n in sources if n.endswith(".c")], made)
        return made.read_bytes()


# The folder of compiled libraries: one file for each, named by a hash of all that can change it.
#
# It grows, and may be deleted at any time: the system keeps the content of a library that a process
# has loaded until the process ends. Any number of processes may use and build libraries at once.


def find_cache_folder() -> Path:
    """Returns $MODELER_CACHE, else $XDG_CACHE_HOME/modeler, else where the system keeps caches.

    That is ~/.cache/modeler, ~/Library/Caches/modeler on macOS, %LOCALAPPDATA%/modeler on Windows.
    """
    configured = os.environ.get("MODELER_CACHE", "")
    if configured:
        return Path(configured)
    shared = os.environ.get("XDG_CACHE_HOME", "")
    shared = shared or (_WINDOWS and os.environ.get("LOCALAPPDATA", "")) or ""
    usual = "Library/Caches" if sys.platform == "darwin" else ".cache"
    return (Path(shared) if shared else Path.home() / usual) / "modeler"


def is_intact(library: Path) -> bool:
    """Returns True for a library that is what was built: its name ends in the hash of its content.

    False too where another process has removed it.
    """
    try:
        digest = hashlib.sha256(library.read_bytes()).hexdigest()
    except FileNotFoundError:
        return False
    return digest == library.stem.partition("-")[2]


# A shared library from emitted files, kept in a cache.
#
# The cache is keyed by everything that can change the library: sources, flags, compiler, processor.
# The library's name has the hash of its own bytes too, so a damaged one is noticed and built again;
# it is renamed into place, so that any number of processes may build the same robot at once.


def build_library(sources: Mapping[str, str]) -> Path:
    """Returns path of the shared library of these C files, compiled unless the cache has it.

    Args:
        sources: {file name: text}, headers included.

    Raises:
        BuildError: no compiler, the compiler refused, or the cache cannot be written.
    """
    tools = find_toolchain()
    folder, key = find_cache_folder(), _compute_key(sources, tools)
    try:
        cached = _find_intact_library(folder, key)
        return cached if cached is not None else _build_entry(sources, tools, folder, key)
    except IsADirectoryError as error:
        raise BuildError(
            f"{error.filename}: is a folder; expected a compiled library of the cache; remove it"
        ) from None
    except OSError as error:
        raise BuildError(
            f"{folder}: the compiled library cannot be written ({error.strerror}); set "
            "MODELER_CACHE to a folder you may write to"
        ) from error


def _compute_key(sources: Mapping[str, str], tools: Toolchain) -> str:
    parts = [*tools.command, *tools.flags, tools.identity]
    for name in sorted(sources):
        parts += [name, sources[name]]
    # Lengths first: no two lists of parts give the same bytes.
    text = "".join(f"{len(part)}:{part}" for part in parts)
    return hashlib.sha256(text.encode()).hexdigest()


def _find_intact_library(cache: Path, key: str) -> Path | None:
    """Returns the library of that key, if it is still what was built."""
    return next((path for path in sorted(cache.glob(f"{key}-*")) if is_intact(path)), None)


def _build_entry(sources: Mapping[str, str], tools: Toolchain, cache: Path, key: str) -> Path:
    cache.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=cache, prefix=".build-") as scratch:
        for name, text in sources.items():
            (Path(scratch) / name).write_text(text, encoding="utf-8", newline="\n")
        made = Path(scratch) / f"library{SUFFIX}"
        units = [name for name in sorted(sources) if name.endswith(".c")]
        compile_library(tools, Path(scratch), units, made)
        digest = hashlib.sha256(made.read_bytes()).hexdigest()
        final = cache / f"{key}-{digest}{SUFFIX}"
        try:
            made.replace(final)
        except PermissionError:  # Windows: a process has it loaded, who built the same
            if not is_intact(final):
                raise
    for other in cache.glob(f"{key}-*"):
        if other != final and not is_intact(other):
            other.unlink(missing_ok=True)
    return final
