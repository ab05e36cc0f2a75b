"""Whole folders with values: no warning of two compilers, as C or C++, no fault of sanitizers."""

import shutil
import subprocess

import pytest

from tests.control.emitted_folder import Folder
from tests.control.test_every_function import derivation

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Wundef", "-Werror"]
ALIGNED = {"gcc": "-Wcast-align=strict", "clang": "-Wcast-align"}
ROBOTS = ("two-link", "tree 1", "five-bar")  # a chain with friction, a tree, loops


def folder(name: str, path, single: bool = False) -> Folder:
    return Folder(derivation(name), path, single)


@pytest.mark.slow
@pytest.mark.parametrize("single", [False, True])
@pytest.mark.parametrize("name", ROBOTS)
def test_no_compiler_warns(name, single, tmp_path):
    made = folder(name, tmp_path, single)
    sources = [str(p.relative_to(tmp_path)) for p in tmp_path.glob("**/*.c")]
    assert len(sources) > 5
    for cc in filter(shutil.which, ALIGNED):
        for language, standard in (("c", "c99"), ("c++", "c++17")):
            words = [*STRICT, ALIGNED[cc], *["-Wdouble-promotion"] * single, f"-std={standard}"]
            made.command(cc, "-fsyntax-only", *words, "-I.", "-x", language, *sources)


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_sanitizers_find_nothing(name, tmp_path):
    """In the folder's own check, which calls every function."""
    made = folder(name, tmp_path)
    words = ["-std=c99", "-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    probe = subprocess.run(
        ["gcc", *words, "-x", "c", "-", "-o", str(tmp_path / "probe")],
        input="int main(void) { return 0; }\n", text=True, capture_output=True, check=False,
    )  # fmt: skip
    if probe.returncode:
        pytest.skip("NOT CHECKED: gcc has no sanitizers here")
    made.command("gcc", *words, "-I.", "programs/self_check.c", *made.sources, "-lm", "-o", "check")
    assert "agree" in made.command("./check")
