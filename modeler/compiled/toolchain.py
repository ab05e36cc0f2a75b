"""The C compiler of this machine: which one, and which of our flags it knows."""

import os
import shlex
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from modeler.compiled.threads import mapped
from modeler.core.errors import BuildError

_INSTALL = (
    "install one: Debian, Ubuntu `apt install gcc`, Fedora `dnf install gcc`, "
    "macOS `xcode-select --install`; or set CC"
)

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
_ALWAYS = ("-std=c99", "-fPIC")
_OPTIMISED = "-O3"


@dataclass(frozen=True)
class Toolchain:
    """A compiler and its flags.

    Attributes:
        command: e.g. ("gcc",) or ("ccache", "gcc").
        flags: all of them known to it.
        identity: everything about compiler and processor that can change the library.
    """

    command: tuple[str, ...]
    flags: tuple[str, ...]
    identity: str


def find_toolchain() -> Toolchain:
    """The compiler named by the environment variable CC, else the first of cc, gcc, clang.

    The environment variable CFLAGS takes the place of the flags that are chosen otherwise: -O3,
    code for this very processor, fused multiply-add. Where CC has a flag, what is chosen of its
    kind is left out: `CC="gcc -march=x86-64-v2"` gives code for that processor.

    Raises:
        BuildError: there is none, or it does not know a flag of CFLAGS; says what to do.
    """
    wanted = os.environ.get("CC", "").strip()
    if wanted:
        command = _words("CC", wanted)
        if shutil.which(command[0]) is None:
            raise BuildError(
                f'C compiler: got CC="{wanted}", which is not found; correct it, or {_INSTALL}'
            )
        return _examined(command, _own_flags())
    for name in ("cc", "gcc", "clang"):
        if shutil.which(name) is not None:
            return _examined((name,), _own_flags())
    raise BuildError(f"C compiler: none of cc, gcc, clang is found; {_INSTALL}")


def _own_flags() -> tuple[str, ...]:
    return _words("CFLAGS", os.environ.get("CFLAGS", ""))


def _words(variable: str, text: str) -> tuple[str, ...]:
    try:
        return tuple(shlex.split(text))
    except ValueError as error:
        raise BuildError(
            f'C compiler: got {variable}="{text}" ({error}); expected words as in a shell; '
            "correct it"
        ) from None


@lru_cache(maxsize=8)
def _examined(command: tuple[str, ...], own: tuple[str, ...]) -> Toolchain:
    used = (*_ALWAYS, *(own or _chosen(command)))
    # The predefined macros name the compiler's version and, with -march=native, this processor.
    macros = _run(command, [*used, "-dM", "-E", "-x", "c", os.devnull])
    if own and macros.returncode != 0 and _knows(command, []):
        said = macros.stderr.strip().partition("\n")[0]
        raise BuildError(
            f'C compiler: {shlex.join(command)} refuses CFLAGS="{shlex.join(own)}" ({said}); '
            "correct it, or leave it empty"
        )
    return Toolchain(command, used, macros.stdout)


def _chosen(command: tuple[str, ...]) -> list[str]:
    """The wanted flags that the compiler knows; none of a kind that its command has already."""
    stated = {_kind(word) for word in command[1:]}
    wanted = [each for each in _WANTED if not stated & {_kind(flag) for flag in each}]
    optimised = [] if _kind(_OPTIMISED) in stated else [_OPTIMISED]
    favourites = [alternatives[0] for alternatives in wanted]
    if _knows(command, favourites):  # one start of the compiler instead of one per flag
        return optimised + favourites
    flags = optimised
    for alternatives in wanted:
        flags += [flag for flag in alternatives if _knows(command, [flag])][:1]
    return flags


def _kind(flag: str) -> str:
    """What a flag says something of: -O2 and -Os, -march=native and -march=core2 are of a kind."""
    if flag.startswith("-O"):
        return "-O"
    return flag.partition("=")[0].replace("-fno-", "-f", 1)


def _knows(command: Sequence[str], flags: Sequence[str]) -> bool:
    # clang only warns of flags that it ignores.
    test = ["-Werror", *flags, "-fsyntax-only", "-x", "c", os.devnull]
    return _run(command, test).returncode == 0


def _run(command: Sequence[str], arguments: Sequence[str]) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(
            [*command, *arguments], capture_output=True, text=True, errors="replace", check=False
        )
    except OSError as error:
        raise BuildError(
            f"C compiler: {shlex.join(command)} does not start ({error.strerror}); {_INSTALL}"
        ) from error


def compile_library(tools: Toolchain, folder: Path, sources: Sequence[str], output: Path) -> None:
    """Compile C files of `folder` into the shared library `output`; one compiler per processor.

    Raises:
        BuildError: the compiler refused; quotes its own words.
    """

    def compile_one(source: str) -> str:
        result = str(folder / f"{source}.o")
        _checked(tools, ["-I", str(folder), "-c", "-o", result, str(folder / source)])
        return result

    # Threads only wait here: each for a compiler that is a process of its own.
    objects = list(mapped(compile_one, sources))
    _checked(tools, ["-shared", "-o", str(output), *objects, "-lm"])
    if not output.is_file():
        raise BuildError(
            f"C compiler: {shlex.join(tools.command)} ended without a mistake, and made nothing; "
            "expected a C compiler, such as gcc; correct CC"
        )


def _checked(tools: Toolchain, arguments: Sequence[str]) -> None:
    result = _run([*tools.command, *tools.flags], arguments)
    if result.returncode != 0:
        words = result.stderr.strip() or f"exit status {result.returncode}, without a word"
        raise BuildError(
            f"C compiler: {shlex.join(tools.command)} refused the emitted code:\n{words}\n"
            "(check it, or name another one in CC)"
        )
