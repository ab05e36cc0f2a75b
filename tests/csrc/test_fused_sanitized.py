"""Least squares on the fly, in C: memory, undefined behaviour and threads."""

import subprocess
from pathlib import Path

import pytest

from modeler.core.files import locate_resources
from tests.modules import STRICT, compiler

HERE = Path(__file__).resolve().parent


@pytest.mark.slow
@pytest.mark.parametrize("checked", ["address,undefined", "thread"])
@pytest.mark.parametrize("cc", ["gcc", "clang"])
def test_fused_least_squares_under_sanitizers(cc, checked, tmp_path):
    run(compiler(cc), ["-O1", "-g", f"-fsanitize={checked}", "-fno-sanitize-recover=all"], tmp_path)


@pytest.mark.parametrize("cc", ["gcc", pytest.param("clang", marks=pytest.mark.rotating)])
def test_fused_least_squares_in_c(cc, tmp_path):
    run(compiler(cc), ["-O2"], tmp_path)


def run(cc: str, flags: list[str], folder: Path) -> None:
    csrc = locate_resources("csrc")
    strict = [flag for flag in STRICT if flag != "-Wconversion"]
    command = [cc, *strict, "-D_POSIX_C_SOURCE=200112L", *flags, "-I", csrc / "include"]
    command += [HERE / "test_fused.c", csrc / "modeler_fused.c", "-o", folder / "test"]
    built = subprocess.run([*command, "-lm", "-pthread"], capture_output=True, text=True)
    if "cannot find" in built.stderr and "san" in built.stderr:
        pytest.skip(f"NOT CHECKED: {cc} has no sanitizer libraries")
    assert built.returncode == 0, built.stderr
    ran = subprocess.run([folder / "test"], capture_output=True, text=True, check=False)
    if "unexpected memory mapping" in ran.stderr:
        pytest.skip(f"NOT CHECKED: the thread sanitizer of {cc} does not run on this kernel")
    assert ran.returncode == 0, ran.stdout + ran.stderr
