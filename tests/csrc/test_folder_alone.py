"""All C files beside the header are the library: they compile at once, and link with a program."""

import dataclasses
import subprocess
from pathlib import Path

import pytest

from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from modeler.core.files import locate_resources
from tests.codegen.fitted_library import with_values
from tests.modules import compiler, module
from tests.rotation import rotating, with_cases

USER = Path(__file__).with_name("programs") / "user.c"
KINDS = {
    "loops with values": lambda: with_values("five-bar"),
    "robot called as a program": lambda: renamed("self_check"),
}


def renamed(name):
    made = module("two-link")
    model = type(made.model).__new__(type(made.model))
    model.__dict__.update(made.model.__dict__)
    model.__dict__["robot"] = dataclasses.replace(made.model.robot, name=name)
    return emit(model, made.base)


@pytest.mark.parametrize("kind", ["robot called as a program", *rotating("loops with values")])
def test_every_c_file_of_the_folder_links_with_a_main_of_the_user(kind, tmp_path):
    emitted = KINDS[kind]()
    prefix = emitted.spec.prefix
    write_emitted(emitted, tmp_path / "c")
    text = USER.read_text().replace("PREFIX", prefix).replace("MACRO", prefix.upper())
    (tmp_path / "main.c").write_text(text)
    units = sorted((tmp_path / "c").glob("*.c"))
    command = [compiler("gcc"), "-std=c99", "-O0", "-I", tmp_path / "c", tmp_path / "main.c"]
    subprocess.run([*command, *units, "-lm", "-o", tmp_path / "main"], check=True)
    ran = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=True)
    assert ran.stdout == f"{len(emitted.spec.joints)} 1"
    assert sorted(unit.name for unit in units) == sorted(
        name for name in (*emitted.spec.sources, *emitted.spec.tile_sources) if name.endswith(".c")
    )


@with_cases(
    "cc, flag",
    ("gcc", "-ffast-math"),
    *(
        pytest.param(cc, flag, marks=pytest.mark.rotating)
        for cc, flag in (("gcc", "-ffinite-math-only"), ("clang", "-ffast-math"))
    ),
)
def test_no_unit_compiles_where_nan_would_not_stay_nan(cc, flag, tmp_path):
    """Tiles too, and what reduces samples in modeler itself."""
    write_emitted(with_values("five-bar"), tmp_path)
    csrc = locate_resources("csrc")
    for unit in (*sorted(tmp_path.glob("*.c")), *sorted(csrc.glob("*.c"))):
        include = ["-I", csrc / "include", "-I", csrc] if unit.parent == csrc else []
        command = [compiler(cc), "-std=c99", flag, *include, "-E", "-o", tmp_path / "text", unit]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode != 0, unit.name
        assert "NaN must stay NaN: compile without -ffast-math" in done.stderr
        subprocess.run([*command[:3], "-fno-finite-math-only", *command[3:]], check=True)
