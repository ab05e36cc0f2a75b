"""macOS and Windows from here: what their compilers are told, and where their files go.

Nothing here ran on either. The compilers are scripts that take and refuse what those take and
refuse, and pass it on to gcc; what is written for Windows is written by clang, which can.
"""

import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest

import modeler.runtime.build as build
from modeler.api.log_maps import file_and_span
from modeler.core.errors import BuildError, DataError
from modeler.core.files import resource_dir
from modeler.logs import map_from_words
from modeler.runtime import microsoft
from modeler.runtime.build import find_toolchain
from modeler.runtime.model import load
from tests.modules import compiler, module, states

HEADERS = {
    "math.h": re.sub(r"(\w+)(?= )", r"double \1(double);", "sin cos tan sqrt fabs exp tanh ")
    + re.sub(r"(\w+)(?= )", r"double \1(double, double);", "pow fmin fmax hypot copysign ")
    + """
#define isnan(x) ((x) != (x))
#define isfinite(x) ((x) - (x) == 0)
#define INFINITY __builtin_inff()
#define NAN __builtin_nanf("")
""",
    "string.h": "#include <stddef.h>\nvoid *memcpy(void *, const void *, size_t);\n"
    "void *memset(void *, int, size_t);\nvoid *memmove(void *, const void *, size_t);\n",
}
"""What the C needs of a C library: that of Windows is not here."""

# Options of cl, the Microsoft compiler, as its reference lists them. An object is written twice:
# as Windows has it, which our list of exports is read from, and as this system can link it. What
# that list does not name is hidden.
CL = r"""
import re, subprocess, sys
from pathlib import Path
words = sys.argv[1:]
if not words:
    print("Microsoft (R) C/C++ Optimizing Compiler Version 19.39.33523 for x64", file=sys.stderr)
    sys.exit("usage: cl [ option... ] filename... [ /link linkoption... ]")
flags, files, folders, made, listed = [], [], [], None, None
while words:
    word = words.pop(0)
    if word == "/I":
        folders.append("-I" + words.pop(0))
    elif word.startswith(("/Fo", "/Fe")):
        made = Path(word[3:])
    elif word == "/link":
        listed = Path(words.pop(0).removeprefix("/DEF:"))
    elif word in ("/nologo", "/std:c11", "/utf-8", "/O2", "/c", "/Zs", "/LD", "/arch:AVX2",
                  "/fp:precise", *KNOWN):
        flags.append(word)
    elif word.startswith(("/", "-")) and not Path(word).exists():
        print(f"cl : Command line error D8021 : invalid numeric argument '{word}'")
        sys.exit(2)
    else:
        files.append(word)
with Path(sys.argv[0]).with_name("told").open("a") as told:
    print(*flags, file=told)
if "/c" in flags:
    windows = ["clang", "--target=x86_64-pc-windows-msvc", "-U__clang__", "-isystem", HEADERS]
    strict = ["-std=c11", "-Wvla", "-Wgnu", "-pedantic-errors", "-Wno-unused-function", "-Werror"]
    for command, place in ((windows, made), (["gcc", "-fPIC"], made.with_suffix(".elf"))):
        subprocess.run([*command, *strict[:1 if "gcc" in command else None], "-O1", *folders,
                        "-c", "-o", place, *files], check=True)
elif "/LD" in flags:
    names = listed.read_text().split()
    assert names.pop(0) == "EXPORTS"
    script = listed.with_suffix(".map")
    script.write_text("{ global: " + " ".join(name + ";" for name in names) + " local: *; };")
    objects = [Path(file).with_suffix(".elf") for file in files]
    subprocess.run(["gcc", "-shared", f"-Wl,--version-script={script}", "-o", made, *objects,
                    "-lm"], check=True)
elif "/Zs" not in flags:
    sys.exit(2)
"""


def script(place: Path, text: str) -> str:
    """A program of Python."""
    place.write_text(f"#!{sys.executable}\n{text}", encoding="utf-8")
    place.chmod(0o755)
    return str(place)


@pytest.fixture
def cl(tmp_path, monkeypatch):
    """A cl that knows these values of /fp, as CC; what it is told stands in a file."""
    compiler("gcc"), compiler("clang")
    folder = tmp_path / "Visual Studio"
    (folder / "include").mkdir(parents=True)
    for name, text in HEADERS.items():
        (folder / "include" / name).write_text(text)
    monkeypatch.setenv("MODELER_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("CFLAGS", raising=False)

    def made(*known: str) -> Path:
        text = f"KNOWN = {known!r}\nHEADERS = {str(folder / 'include')!r}\n{CL}"
        monkeypatch.setenv("CC", script(folder / "cl", text))
        return folder / "told"

    return made


def test_the_compiler_of_microsoft_is_known_by_what_it_says(cl, monkeypatch) -> None:
    cl("/fp:contract")
    tools = find_toolchain()
    assert tools.microsoft and "19.39.33523" in tools.identity
    assert tools.flags == ("/nologo", "/std:c11", "/utf-8", "/O2", "/fp:contract")
    monkeypatch.setenv("CFLAGS", "/O2 /arch:AVX2")
    assert find_toolchain().flags == ("/nologo", "/std:c11", "/utf-8", "/O2", "/arch:AVX2")


@pytest.mark.parametrize("robot", ["emps", pytest.param("five-bar", marks=pytest.mark.rotating)])
def test_a_library_of_it_has_all_that_is_called(cl, robot) -> None:
    """Whole: batches, tables that closing loops reads, tiles; an old cl without /fp:contract."""
    told = cl()
    made = module(robot).emitted
    model = load(made.spec, made.files)
    q, qd, qdd = states(len(made.spec.joints), 2000)
    if (loops := made.spec.closure) is not None:
        q = 0.05 * q + np.array([loops.home[i] for i in loops.given])
    W = model.observation(q, qd, qdd)
    assert np.isfinite(W).all() and np.linalg.norm(W) > 1
    beta = np.random.default_rng(3).normal(size=W.shape[1])
    np.testing.assert_allclose(model.inverse_dynamics(q, qd, qdd, beta).ravel(), W @ beta,
                               rtol=1e-9, atol=1e-9)  # fmt: skip
    assert "/nologo /std:c11 /utf-8 /O2 /LD" in told.read_text().splitlines()


def test_what_it_says_is_quoted(cl, monkeypatch) -> None:
    cl()
    monkeypatch.setenv("CFLAGS", "/fp:wrong")
    made = module("emps").emitted
    with pytest.raises(BuildError, match="D8021 : invalid numeric argument '/fp:wrong'"):
        load(made.spec, made.files)


def test_a_portable_library_of_it(cl) -> None:
    told = cl("/fp:contract")
    assert build.portable_library({"one.c": "int one(void)\n{\n    return 1;\n}\n"})
    assert "/nologo /std:c11 /utf-8 /O2 /fp:precise /c" in told.read_text().splitlines()


@pytest.mark.rotating("other compilers")
def test_exports_are_those_that_binutils_sees(tmp_path) -> None:
    """Of all C that is shipped, long names and short ones; against llvm-nm."""
    compiler("clang"), compiler("llvm-nm")
    for name, text in HEADERS.items():
        (tmp_path / name).write_text(text)
    csrc = resource_dir("csrc")
    command = ["clang", "--target=x86_64-pc-windows-msvc", "-isystem", tmp_path, "-O1", "-c",
               f"-I{csrc / 'include'}", *sorted(csrc.glob("modeler_[bcf]*.c"))]  # fmt: skip
    subprocess.run(command, cwd=tmp_path, check=True)
    objects = [str(place) for place in sorted(tmp_path.glob("*.o"))]
    seen = subprocess.run(["llvm-nm", "-g", "--defined-only", "-j", *objects],
                          capture_output=True, text=True, check=True).stdout  # fmt: skip
    names = {word for word in seen.split() if word.isidentifier()}
    assert len(names) > 30
    assert microsoft.exports(objects).split() == ["EXPORTS", *sorted(names)]


def test_clang_for_the_linker_of_microsoft_is_given_the_list(tmp_path) -> None:
    clang = script(tmp_path / "clang", textwrap.dedent('''
        import subprocess, sys
        from pathlib import Path
        Path(sys.argv[0]).with_name("told").write_text(" ".join(sys.argv[1:]))
        if "-shared" in sys.argv:
            Path(sys.argv[sys.argv.index("-o") + 1]).touch()
        else:
            sys.exit(subprocess.call(["clang", "--target=x86_64-pc-windows-msvc", *sys.argv[1:]]))
    '''))  # fmt: skip
    compiler("clang")
    (tmp_path / "one.c").write_text("int one(void)\n{\n    return 1;\n}\n")
    tools = build.Toolchain((clang,), ("-O1",), "#define _MSC_VER 1939\n")
    build.compile_library(tools, tmp_path, ["one.c"], tmp_path / "one.dll")
    told = (tmp_path / "told").read_text()
    assert f"-Wl,/DEF:{tmp_path / 'exports.def'}" in told and "-lm" not in told
    assert (tmp_path / "exports.def").read_text() == "EXPORTS\none\n"


def test_the_clang_of_apple_has_other_names_of_flags(tmp_path, monkeypatch) -> None:
    """That of an M1 before version 15 refused -march=native; its vectoriser is called otherwise."""
    apple = script(tmp_path / "cc", textwrap.dedent('''
        import subprocess, sys
        for word in sys.argv[1:]:
            if word in ("-march=native", "-fno-tree-slp-vectorize"):
                sys.exit(f"clang: error: unsupported argument in '{word}'")
        words = [w for w in sys.argv[1:] if w not in ("-mcpu=native", "-fno-slp-vectorize")]
        sys.exit(subprocess.call(["gcc", *words]))
    '''))  # fmt: skip
    compiler("gcc")
    monkeypatch.setenv("CC", apple)
    monkeypatch.delenv("CFLAGS", raising=False)
    monkeypatch.setenv("MODELER_CACHE", str(tmp_path / "cache"))
    flags = find_toolchain().flags
    assert {"-mcpu=native", "-fno-slp-vectorize", "-ffp-contract=fast"} < set(flags)
    assert "-march=native" not in flags


_ELSEWHERE = """
import concurrent.futures, os, pathlib, subprocess, sys, tempfile
sys.platform = sys.argv[1]
import modeler.runtime.build as build
print(build.SUFFIX, "-fPIC" in build._ALWAYS, build._NAMES[-1], build.cache_folder().as_posix())
"""


@pytest.mark.parametrize(
    ("system", "says"),
    [("linux", ".so True clang /u/.cache/modeler"),
     ("darwin", ".dylib True clang /u/Library/Caches/modeler"),
     ("win32", ".dll False cl C:/Users/u/AppData/Local/modeler")],
)  # fmt: skip
def test_names_and_places_of_each_system(system, says) -> None:
    local = {"LOCALAPPDATA": "C:/Users/u/AppData/Local"} if system == "win32" else {}
    environment = {"HOME": "/u", "PYTHONPATH": str(Path(build.__file__).parents[2]), **local}
    command = [sys.executable, "-c", _ELSEWHERE, system]
    ran = subprocess.run(command, capture_output=True, text=True, env=environment, check=True)
    assert ran.stdout.strip() == says


def test_backslashes_in_cc_are_of_paths_on_windows(monkeypatch) -> None:
    monkeypatch.setattr(build, "_WINDOWS", True)
    words = build._words("CC", r'"C:\Program Files\LLVM\bin\clang.exe" -m64')
    assert words == ("C:/Program Files/LLVM/bin/clang.exe", "-m64")


@pytest.mark.parametrize("whole", [True, False])
def test_a_library_that_another_process_has_loaded_stays(tmp_path, monkeypatch, whole) -> None:
    """Windows refuses to replace it; it is the same, for its name says so."""

    def refused(*_: object) -> None:
        raise PermissionError(13, "in use")

    monkeypatch.setattr(Path, "replace", refused)
    monkeypatch.setattr(build, "whole", lambda _: whole)
    made, final = tmp_path / "made", tmp_path / "entry" / "final.dll"
    if whole:
        build.placed(made, final)
    else:
        with pytest.raises(PermissionError):
            build.placed(made, final)


@pytest.mark.parametrize(
    ("place", "file", "span"),
    [(r"C:\logs\run.csv", r"C:\logs\run.csv", None),
     (r"C:\logs\run.csv@0:10", r"C:\logs\run.csv", (0.0, 10.0)),
     (r"\\host\share\me@home\run.csv@5:", r"\\host\share\me@home\run.csv", (5.0, None))],
)  # fmt: skip
def test_the_letter_of_a_drive_is_no_window_of_a_log(place, file, span) -> None:
    assert file_and_span(place) == (file, span)


def test_the_letter_of_a_drive_is_no_unit_of_a_map() -> None:
    with pytest.raises(DataError, match=re.escape(r"--map C:\maps\arm.toml: cannot be read")):
        map_from_words([r"C:\maps\arm.toml"])


@pytest.mark.parametrize("letters", ["cp1252", "cp437"])
def test_greek_letters_on_a_console_of_windows(letters) -> None:
    """What it has no letter for is shown as its code."""
    command = [sys.executable, "-c", ""
               "from modeler.cli.console import say, escape_unprintable\n"
               "escape_unprintable(); say('\u03c3 \u03b8 \u03c4\u0308 \u2264 \u00b1')"]  # fmt: skip
    environment = {**os.environ, "PYTHONIOENCODING": letters}
    ran = subprocess.run(command, capture_output=True, env=environment, check=True)
    assert b"\\u03b8" in ran.stdout or "\u03b8".encode(letters) in ran.stdout
