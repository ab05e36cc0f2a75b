"""Whole folders with values: no warning of two compilers, as C or C++, no fault of sanitizers."""

import shutil
import subprocess

import pytest

from tests.control.emitted_folder import Folder
from tests.control.test_every_function import derivation
from tests.rotation import ROTATING, with_cases

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Wundef", "-Werror"]
ALIGNED = {"gcc": "-Wcast-align=strict", "clang": "-Wcast-align"}
MORE = ("tree 1", "five-bar")


@pytest.mark.rotating("long tests of control")
@with_cases(
    "name, single, compilers",
    ("two-link", False, ["gcc"]),
    pytest.param("two-link", True, ["gcc", "clang"], marks=ROTATING),
    *(
        pytest.param(name, single, ["gcc", "clang"], marks=ROTATING)
        for name in MORE
        for single in (False, True)
    ),
)
def test_no_compiler_warns(name, single, compilers, tmp_path):
    made = Folder(derivation(name), tmp_path, single)
    sources = [str(p.relative_to(tmp_path)) for p in tmp_path.glob("**/*.c")]
    assert len(sources) > 5
    for cc in filter(shutil.which, compilers):
        for language, standard in (("c", "c99"), ("c++", "c++17")):
            words = [*STRICT, ALIGNED[cc], *["-Wdouble-promotion"] * single, f"-std={standard}"]
            made.command(cc, "-fsyntax-only", *words, "-I.", "-x", language, *sources)


@pytest.mark.rotating("long tests of control")
@pytest.mark.parametrize("name", ["two-link", *(pytest.param(n, marks=ROTATING) for n in MORE)])
def test_sanitizers_find_nothing(name, tmp_path):
    """In the folder's own check, which calls every function."""
    made = Folder(derivation(name), tmp_path)
    words = ["-std=c99", "-O0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    probe = subprocess.run(
        ["gcc", *words, "-x", "c", "-", "-o", str(tmp_path / "probe")],
        input="int main(void) { return 0; }\n",
        text=True,
        capture_output=True,
        check=False,
    )
    if probe.returncode:
        pytest.skip("NOT CHECKED: gcc has no sanitizers here")
    made.command("gcc", *words, "-I.", "programs/self_check.c", *made.sources, "-lm", "-o", "check")
    assert "agree" in made.command("./check")
