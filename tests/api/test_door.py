"""`import modeler as md`: nothing is loaded before it is used; all of `modeler.api` is there."""

import ast
import importlib
import subprocess
import sys
from pathlib import Path

import pytest

import modeler
import modeler.api as api

ROOT = Path(modeler.__file__).parent
ROOMS = {path.parent.name for path in ROOT.glob("*/__init__.py")}


def in_new_process(program: str) -> str:
    ran = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def test_import_loads_nothing_before_a_name_is_used() -> None:
    loaded = "sorted(n for n in sys.modules if n.startswith('modeler') or n in heavy)"
    heavy = "heavy = {'numpy', 'sympy', 'pandas', 'sklearn', 'pyarrow', 'lazy_loader', 'pathlib'}"
    told = in_new_process(
        f"import sys\n{heavy}\nbefore = {loaded}\nimport modeler as md\n"
        f"print([n for n in {loaded} if n not in before])\n"
        "print(md.__version__, md.load.__module__, 'pandas' in sys.modules, "
        "'sklearn' in sys.modules)"
    )
    first, second = told.splitlines()
    assert first == "['modeler']"
    assert second == f"{modeler.__version__} modeler.api.model False False"


def test_rooms_are_not_loaded_by_the_names_of_others() -> None:
    """`from modeler import numerics` asks the package for the name first."""
    told = in_new_process(
        "import sys\nfrom modeler import numerics\nprint('modeler.api' in sys.modules)"
    )
    assert told == "False\n"
    assert {*modeler._ROOMS} == ROOMS


def test_all_of_the_api_is_at_the_door_but_what_rooms_are_called() -> None:
    tree = ast.parse((ROOT / "__init__.pyi").read_text(encoding="utf-8"))
    told = {a.asname for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) for a in n.names}
    assert told == {*api.__all__} - ROOMS
    assert {*api.__all__} & ROOMS == {"effects", "fleet"}
    assert told <= {*dir(modeler)}
    for name in sorted(told):
        assert getattr(modeler, name) is getattr(api, name)


def test_what_is_not_there_is_told_as_python_does() -> None:
    for name in ("identfy", "_private", "__path_of__"):
        with pytest.raises(AttributeError, match=f"module 'modeler' has no attribute '{name}'"):
            getattr(modeler, name)
    assert importlib.import_module("modeler.effects") is modeler.effects  # type: ignore[attr-defined]
