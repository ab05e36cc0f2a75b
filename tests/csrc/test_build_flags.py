"""The build files of an emitted folder take the flags that matter, and let the user's win."""

import json
from pathlib import Path

import pytest

from modeler.codegen.package import write_emitted
from tests.csrc.emitted_folders import run
from tests.modules import compiler, module

TUNED = ["-fno-tree-slp-vectorize", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=fast"]


@pytest.fixture
def folder(tmp_path) -> Path:
    write_emitted(module("emps").emitted, tmp_path / "emps_c")
    return tmp_path / "emps_c"


def compiled_with(folder: Path, *words: str) -> list[list[str]]:
    """The words of each compilation that `make` with these words would carry out."""
    log, wrapped = folder.parent / "log", folder.parent / "any-cc"
    log.write_text("")
    wrapped.write_text(
        f'#!/bin/sh\ncase "$*" in *-fsyntax-only*-fno-math-errno*|*-fno-math-errno*-fsyntax-only*) '
        f'exit 1;; *" -c "*) echo "$*" >>"{log}"; while [ "$1" != -o ]; do shift; done; : >"$2"; '
        f'exit;; esac\nexec {compiler("gcc")} "$@"\n'
    )
    wrapped.chmod(0o755)
    run(compiler("make"), f"CC={wrapped}", *words, where=folder)
    return [line.split() for line in log.read_text().splitlines()]


def test_make_takes_what_the_compiler_knows_and_compiles_anew_for_another_processor(folder) -> None:
    """Flags of the user come last."""
    first = compiled_with(folder)
    for words in first:
        assert [w for w in words if w in TUNED] == TUNED[:1] + TUNED[2:]
        assert "-O3" in words and "-march=native" not in words
    assert first and compiled_with(folder) == []
    native = compiled_with(folder, "NATIVE=1")
    assert len(native) == len(first)
    assert compiled_with(folder, "NATIVE=1") == []
    assert compiled_with(folder) == first
    run("make", "clean", where=folder)
    assert not list(folder.glob("known_flags*"))
    of_user = compiled_with(folder, "CFLAGS=-O1 -ffp-contract=off")
    for words in of_user:
        assert words.index("-ffp-contract=off") > words.index("-ffp-contract=fast")
        assert "-O3" not in words
    assert len(of_user) == len(first)


def test_cmake_takes_the_same_before_those_of_the_user(folder) -> None:
    compiler("cmake")
    for native in (False, True):
        run(
            *"""
                cmake -S . -B b -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
                -DCMAKE_C_FLAGS=-ffp-contract=off
            """.split(),
            f"-DEMPS_NATIVE={'ON' if native else 'OFF'}",
            where=folder,
        )
        commands = json.loads((folder / "b" / "compile_commands.json").read_text())
        for words in (entry["command"].split() for entry in commands):
            assert [w for w in words if w in TUNED] == TUNED and "-O3" in words
            assert words.index("-ffp-contract=off") > words.index("-ffp-contract=fast")
            assert ("-march=native" in words) is native
