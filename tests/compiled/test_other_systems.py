"""macOS and Windows from here: which options their compilers get, and where their files go.

Nothing here ran on either. The compilers are scripts that take and refuse what those take and
refuse, and pass it on to gcc; what is written for Windows is written by clang, which can.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import modeler.runtime.build as build
from modeler.api.log_maps import parse_time_range
from modeler.core.errors import BuildError, DataError
from modeler.logs import parse_map_options
from modeler.runtime.build import find_toolchain
from modeler.runtime.model import load_module
from tests.modules import compiler, module, states
from tests.rotation import with_cases

COMPILERS = Path(__file__).with_name("compilers")
WINDOWS = COMPILERS / "windows"
"""What the C needs of a C library: that of Windows is not here."""


def program(name: str, folder: Path, **known: object) -> str:
    """A compiler of the folder beside, a program of Python that knows these names."""
    lines = "".join(f"{key} = {value!r}\n" for key, value in known.items())
    text = f"#!{sys.executable}\n{lines}{(COMPILERS / name).read_text()}"
    (folder / name).write_text(text, encoding="utf-8")
    (folder / name).chmod(0o755)
    return str(folder / name)


@pytest.fixture
def cl(tmp_path, monkeypatch):
    """A cl that knows these values of /fp, as CC; its options stand in a file."""
    compiler("gcc"), compiler("clang")
    folder = tmp_path / "Visual Studio"
    folder.mkdir()
    monkeypatch.setenv("MODELER_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("CFLAGS", raising=False)

    def made(*known: str) -> Path:
        monkeypatch.setenv("CC", program("cl", folder, KNOWN=known, HEADERS=str(WINDOWS)))
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
    out = cl()
    made = module(robot).emitted
    model = load_module(made.spec, made.files)
    q, qd, qdd = states(len(made.spec.joints), 2000)
    if (loops := made.spec.closure) is not None:
        q = 0.05 * q + np.array([loops.home[i] for i in loops.actuated])
    W = model.observation(q, qd, qdd)
    assert np.isfinite(W).all() and np.linalg.norm(W) > 1
    beta = np.random.default_rng(3).normal(size=W.shape[1])
    tau = model.inverse_dynamics(q, qd, qdd, beta)
    np.testing.assert_allclose(tau.ravel(), W @ beta, rtol=1e-9, atol=1e-9)
    assert "/nologo /std:c11 /utf-8 /O2 /LD" in out.read_text().splitlines()


def test_what_it_says_is_quoted_and_a_portable_library_of_it(cl, monkeypatch) -> None:
    out = cl("/fp:contract")
    assert build.build_portable_library({"one.c": "int one(void)\n{\n    return 1;\n}\n"})
    assert "/nologo /std:c11 /utf-8 /O2 /fp:precise /c" in out.read_text().splitlines()
    monkeypatch.setenv("CFLAGS", "/fp:wrong")
    made = module("emps").emitted
    with pytest.raises(BuildError, match="D8021 : invalid numeric argument '/fp:wrong'"):
        load_module(made.spec, made.files)


def test_clang_for_the_linker_of_microsoft_is_given_the_list(tmp_path) -> None:
    compiler("clang")
    (tmp_path / "one.c").write_text("int one(void)\n{\n    return 1;\n}\n")
    tools = build.Toolchain((program("clang", tmp_path),), ("-O1",), "#define _MSC_VER 1939\n")
    build.compile_library(tools, tmp_path, ["one.c"], tmp_path / "one.dll")
    text = (tmp_path / "told").read_text()
    assert f"-Wl,/DEF:{tmp_path / 'exports.def'}" in text and "-lm" not in text
    assert (tmp_path / "exports.def").read_text() == "EXPORTS\none\n"


def test_the_clang_of_apple_has_other_names_of_flags(tmp_path, monkeypatch) -> None:
    compiler("gcc")
    monkeypatch.setenv("CC", program("cc", tmp_path))
    monkeypatch.delenv("CFLAGS", raising=False)
    monkeypatch.setenv("MODELER_CACHE", str(tmp_path / "cache"))
    flags = find_toolchain().flags
    assert {"-mcpu=native", "-fno-slp-vectorize", "-ffp-contract=fast"} < set(flags)
    assert "-march=native" not in flags


_ELSEWHERE = """
import concurrent.futures, os, pathlib, subprocess, sys, tempfile
sys.platform = sys.argv[1]
import modeler.runtime.build as build
print(build.SUFFIX, "-fPIC" in build._ALWAYS, build._NAMES[-1], end=" ")
print(build.find_cache_folder().as_posix())
"""


@with_cases(
    "system, says",
    ("linux", ".so True clang /u/.cache/modeler"),
    ("darwin", ".dylib True clang /u/Library/Caches/modeler"),
    ("win32", ".dll False cl C:/Users/u/AppData/Local/modeler"),
)
def test_names_and_places_of_each_system(system, says) -> None:
    local = {"LOCALAPPDATA": "C:/Users/u/AppData/Local"} if system == "win32" else {}
    environment = {"HOME": "/u", "PYTHONPATH": str(Path(build.__file__).parents[2]), **local}
    command = [sys.executable, "-c", _ELSEWHERE, system]
    ran = subprocess.run(command, capture_output=True, text=True, env=environment, check=True)
    assert ran.stdout.strip() == says


def test_backslashes_in_cc_are_of_paths_on_windows(monkeypatch) -> None:
    monkeypatch.setattr(build, "_WINDOWS", True)
    words = build._split_words("CC", r'"C:\Program Files\LLVM\bin\clang.exe" -m64')
    assert words == ("C:/Program Files/LLVM/bin/clang.exe", "-m64")


def test_a_library_that_another_process_has_loaded_stays(tmp_path, monkeypatch) -> None:
    """Windows refuses to replace it; it is the same, for its name says so."""

    def refused(*_: object) -> None:
        raise PermissionError(13, "in use")

    monkeypatch.setattr(Path, "replace", refused)
    sources, tools = {"a.c": "int modeler_a(void) { return 1; }\n"}, find_toolchain()
    monkeypatch.setattr(build, "is_intact", lambda _: True)
    build._build_entry(sources, tools, tmp_path / "cache", "key")
    monkeypatch.setattr(build, "is_intact", lambda _: False)
    with pytest.raises(PermissionError):
        build._build_entry(sources, tools, tmp_path / "cache", "key")


@with_cases(
    "place, file, span",
    (r"C:\logs\run.csv@0:10", r"C:\logs\run.csv", (0.0, 10.0)),
    (r"\\host\share\me@home\run.csv@5:", r"\\host\share\me@home\run.csv", (5.0, None)),
)
def test_the_letter_of_a_drive_is_no_window_of_a_log_and_no_unit_of_a_map(place, file, span):
    assert parse_time_range(place) == (file, span)
    assert parse_time_range(r"C:\logs\run.csv") == (r"C:\logs\run.csv", None)
    with pytest.raises(DataError, match=re.escape(r"mapping C:\maps\arm.toml: cannot be read")):
        parse_map_options([r"C:\maps\arm.toml"])


@pytest.mark.parametrize("letters", ["cp1252", "cp437"])
def test_greek_letters_on_a_console_of_windows(letters) -> None:
    """What it has no letter for is shown as its code."""
    command = [
        sys.executable,
        "-c",
        ""
        "from modeler.cli.console import print_result, escape_unprintable\n"
        "escape_unprintable()\n"
        "print_result('\u03c3 \u03b8 \u03c4\u0308 \u2264 \u00b1')",
    ]
    environment = {**os.environ, "PYTHONIOENCODING": letters}
    ran = subprocess.run(command, capture_output=True, env=environment, check=True)
    assert b"\\u03b8" in ran.stdout or "\u03b8".encode(letters) in ran.stdout
