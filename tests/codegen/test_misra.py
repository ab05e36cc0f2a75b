"""MISRA C:2012, rules 13.4, 14.4, 15.6, over all emitted and runtime C; no cast that misaligns."""

from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.codegen.wrappers import build_fmu_files
from tests.codegen.fitted_library import fitted_of, robot_module
from tests.codegen.misra import violations
from tests.repository import ROOT
from tests.rotation import rotating, with_cases

_OTHERWISE = ("-DMODELER_BOUNDED_ANGLES", "-D__OPTIMIZE_SIZE__", "-U__GNUC__")


def written(folder: Path, files) -> list[str]:
    """The C files, written to the folder."""
    texts = {name: text for name, text in files.items() if name.endswith((".c", ".h"))}
    for name, text in texts.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    return [name for name in texts if name.endswith(".c")]


@with_cases(
    "name, precision",
    ("two-link", "double"),
    *rotating(("five-bar", "single"), ("slow-arm", "single")),
    pytest.param("3rrr", "double", marks=pytest.mark.slow),
)
def test_no_emitted_or_runtime_file_breaks_the_three_rules(name, precision, tmp_path) -> None:
    made = robot_module(name)
    fitted = fitted_of(made.emitted.spec)
    emitted = emit(made.model, made.base, fitted, precision, control=Control(vectors=True))
    names = written(tmp_path, emitted.files)
    assert {f"{emitted.spec.prefix}_control.c", "programs/self_check.c"} < set(names)
    if name == "five-bar":  # its regressors are of one kind, its programs those of the other
        names = [n for n in names if "regressor" not in n and not n.startswith("programs/")]
    values = [v for file in names for v in violations(tmp_path, file)]
    for word in _OTHERWISE:
        values += violations(tmp_path, f"{emitted.spec.prefix}.c", word)
        values += violations(tmp_path, "modeler_batch.c", word)
    assert not values, sorted(set(values))


def test_the_wrapper_of_the_fmu_and_the_runtime_of_fits_keep_them_too(tmp_path) -> None:
    made = robot_module("two-link")
    emitted = emit(made.model, made.base, control=Control())
    files = build_fmu_files(emitted, made.model, made.base, np.zeros(len(emitted.spec.base)))
    written(tmp_path, {Path(name).name: text for name, text in files.items()})
    assert not violations(tmp_path, "modeler_fmu.c")
    runtime = [p for p in (ROOT / "csrc").rglob("*.[ch]") if "single" not in p.parts]
    written(tmp_path, {p.name: p.read_text() for p in runtime})
    for name in ("modeler_fused.c", "modeler_tile.c"):
        broken = violations(tmp_path, name)
        assert not broken, sorted(set(broken))


@with_cases(
    "text, rules",
    ("a = b = 1;", ["13.4"]),
    ("if (a) { b = 1; }", ["14.4"]),
    ("while (a - 1) { a = 2; }", ["14.4"]),
    ("if (a > 0) { b = 1; } else b = 2;", ["15.6"]),
    ("if (a > 0) { b = 1; } else if (b > 0) { b = 2; } else { a = 3; }", []),
    ("for (a = 0, b = 1; a < 2 && !b; a++) ;", ["15.6"]),
    ("do { a = 1; } while (a != 1 || b == 2);", []),
    ("switch (a) { case 1: a = 2; break; default: b = 1; }", []),
    ("f(a = 1); a += b; b++;", ["13.4"]),
)
def test_the_check_tells_what_breaks_a_rule(text: str, rules: list[str], tmp_path) -> None:
    (tmp_path / "x.c").write_text(f"void f(int); void g(int a, int b)\n{{\n    {text}\n}}\n")
    assert [v.split()[0] for v in violations(tmp_path, "x.c")] == rules
