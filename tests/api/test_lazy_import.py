"""`import modeler as md`: nothing is loaded before it is used; all of `modeler.api` is there."""

import ast
import importlib
import subprocess
import sys
from pathlib import Path

import pytest

import modeler
import modeler.api as api
from tests.rotation import rotating

ROOT = Path(modeler.__file__).parent
ROOMS = {path.parent.name for path in ROOT.glob("*/__init__.py")}


LOADED = """
import sys
heavy = {'numpy', 'sympy', 'pandas', 'sklearn', 'pyarrow', 'lazy_loader', 'pathlib'}
def loaded():
    return {n for n in sys.modules if n.startswith('modeler') or n in heavy}
before = loaded()
import modeler as md
print(loaded() - before)
from modeler import numerics  # it asks the package for the name first
print('modeler.api' in loaded())
"""
FITTED = """
run = md.simulate(md.load('two-link'), duration=3.0, rate=250.0, seed=5)
model = md.identify('two-link', [{'time': run.time, 'q': run.q, 'tau': run.tau}, sys.argv[1]])
print(model.predict({'time': run.time, 'q': run.q})['tau'].shape, loaded() & {'pandas', 'sklearn'})
"""


@pytest.mark.parametrize(
    ("program", "printed"), [(LOADED, ""), *rotating((LOADED + FITTED, "(750, 2) set()\n"))]
)
def test_nothing_is_loaded_before_it_is_used(program: str, printed: str, tmp_path: Path) -> None:
    """Arrow loads pandas by itself where it makes tables; a dict and a file need none."""
    place = tmp_path / "run.parquet"
    if printed:
        modeler.simulate(modeler.load("two-link"), place, duration=3.0, rate=250.0, seed=6)
    command = [sys.executable, "-c", program, str(place)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.stdout == f"{{'modeler'}}\nFalse\n{printed}", ran.stderr
    assert {*modeler._PACKAGES} == ROOMS


def test_all_of_the_api_is_at_the_door_but_what_rooms_are_called() -> None:
    tree = ast.parse((ROOT / "__init__.pyi").read_text(encoding="utf-8"))
    lines = {a.asname for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) for a in n.names}
    assert lines == {*api.__all__} - ROOMS
    assert {*api.__all__} & ROOMS == {"effects"}
    assert lines <= {*dir(modeler)}
    for name in sorted(lines):
        assert getattr(modeler, name) is getattr(api, name)


def test_what_is_not_there_is_told_as_python_does() -> None:
    for name in ("identfy", "_private", "__path_of__"):
        with pytest.raises(AttributeError, match=f"module 'modeler' has no attribute '{name}'"):
            getattr(modeler, name)
    assert importlib.import_module("modeler.effects") is modeler.effects  # type: ignore[attr-defined]
