"""Every emitted file compiles as C and as C++ without a warning."""

import pytest

from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from tests.codegen.fitted_library import fitted_of, robot_module
from tests.csrc.emitted_folders import CPP, run
from tests.modules import STRICT, compiler
from tests.rotation import ROTATING, rotating
from tests.texts import read_rows

FLAGS = {
    "gcc": [*STRICT, "-Wundef", "-Wcast-align=strict"],
    "clang": [*STRICT, "-Wundef", "-Wcast-align"],
    "g++": [*CPP[:4], "-Werror", "-x", "c++"],
    "clang++": [*CPP[:4], "-Werror", "-x", "c++"],
}
FOLDERS = [
    *read_rows("gcc emps; clang emps; g++ emps"),
    *rotating(
        *read_rows("clang++ orthoglide-2003; gcc orthoglide-2003; clang slow-arm; gcc slow-arm"),
        *read_rows("g++ slow-arm; clang five-bar; gcc sr400; gcc wrist-coupled; clang sr400-tree"),
    ),
    pytest.param("gcc", "evra", marks=ROTATING),
]


@pytest.mark.parametrize(("cc", "name"), FOLDERS)
def test_every_file_compiles_without_a_warning(cc, name, tmp_path):
    """Of a fitted folder with all functions, its programs too; no cast raises an alignment."""
    made = robot_module(name)
    emitted = emit(made.model, made.base, fitted_of(made.emitted.spec), control=Control())
    write_emitted(emitted, tmp_path)
    units = sorted(path for path in tmp_path.rglob("*.c") if not path.name.startswith("count"))
    assert {f"{emitted.spec.prefix}_fitted.c", "self_check.c"} <= {path.name for path in units}
    assert all(emitted.files[file].isascii() for file in emitted.spec.sources)
    run(compiler(cc), *FLAGS[cc], "-fsyntax-only", "-I", tmp_path, *units, where=tmp_path)
