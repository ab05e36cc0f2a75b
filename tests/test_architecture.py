"""Data flows one way, and other rules of the architecture, for every module of the package."""

import ast
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from modeler.effects.catalogue import CATALOGUE
from modeler.effects.effect import EnergyBlock
from tests.architecture import (
    MODULE_LINES,
    MOST_CIRCLES,
    MOST_CODE_LINES,
    MOST_MODULES,
    MOST_PACKAGES,
    NORTH,
    ONLY_IN,
    PACKAGES,
    ROUND,
    SOUTH,
    STAGES,
    broken_rules,
    circles,
    code_lines,
    imported_packages,
    modules,
)

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "modeler"


def test_the_package_follows_the_architecture_rules() -> None:
    assert len(modules(PACKAGE)) > 100  # it is the package that was read
    assert not (breaks := broken_rules(PACKAGE)), "\n".join(["", *breaks])


def test_every_stage_has_its_rules_and_every_rule_its_stage() -> None:
    stages = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    stages |= {path.stem for path in PACKAGE.glob("*.py")} - {"__init__", "__main__"}
    assert stages == STAGES.keys() == PACKAGES.keys()
    for stage, before in STAGES.items():
        assert stage not in before
        for earlier in before:
            assert stage not in STAGES[earlier], f"{stage} and {earlier} may import each other"


def test_code_lines_and_modules_stay_within_their_limits() -> None:
    """Whoever raises one of these says why, beside the number."""
    files = modules(PACKAGE)
    assert len({path.parent for path in files} - {PACKAGE}) <= MOST_PACKAGES
    assert len(files) <= MOST_MODULES
    assert code_lines(PACKAGE) <= MOST_CODE_LINES
    assert len(rings := circles(PACKAGE)) <= MOST_CIRCLES, rings


def test_circles_are_seen(tmp_path: Path) -> None:
    core = tmp_path / "modeler" / "core"
    core.mkdir(parents=True)
    (core / "a.py").write_text("def f():\n    from modeler.core.b import x\n")
    (core / "b.py").write_text("import modeler.core.c\n\nx = 1\n")
    (core / "c.py").write_text('"""Two\nlines."""\n\nfrom modeler.core import a  # late\n')
    (core / "d.py").write_text("from modeler.core.a import f\n")
    assert circles(tmp_path / "modeler") == [{f"modeler.core.{name}" for name in "abc"}]
    assert code_lines(tmp_path / "modeler") == 6


def test_exceptions_are_still_needed() -> None:
    assert all((PACKAGE / file).exists() for file in ROUND)
    for places in ONLY_IN.values():
        assert all((PACKAGE / place).exists() for place in places)


OURS = ("test", "docs")
"""Extras of those who work on the project."""


def test_what_is_imported_is_what_is_declared() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    declared = _names(project["dependencies"])
    groups = project["optional-dependencies"]
    extras = {name for group, rows in groups.items() if group not in OURS for name in _names(rows)}
    imported = imported_packages(PACKAGE)
    assert declared <= imported <= declared | extras
    assert extras <= imported


def _names(lines: list[str]) -> set[str]:
    names = {re.split("[<>=!~; ]", line)[0] for line in lines}
    bare = {
        name.replace("python-flint", "flint").removesuffix("-cuda12x").removesuffix("-core")
        for name in names
    }
    return {name.replace("-", "_").replace("scikit_learn", "sklearn") for name in bare}


# file, its text, what the checker must say of it
PLANTED = [
    ("estimation/a.py", "from modeler.derivation import X", "a.py:1: imports modeler"),
    ("runtime/a.py", "import modeler.robot.read", "runtime may import core"),
    ("validation/a.py", "def f():\n    import sympy", "a.py:2: imports sympy"),
    ("regression/a.py", "from modeler import derivation", "imports modeler.derivation"),
    (
        "estimation/a.py",
        "from modeler.runtime.bind import X",
        "what others may use is in modeler/runtime/__init__.pyi",
    ),
    ("core/a.py", "import lazy_loader", "only a package's __init__.py"),
    ("derivation/a.py", "from modeler.codegen import X", "imports modeler.codegen"),
    ("regression/a.py", "from modeler import estimation", "imports modeler.estimation"),
    ("core/a.py", "import modeler.effects", "core may import nothing"),
    ("estimation/a.py", "from modeler.cli import main", "imports modeler.cli"),
    ("simulation/a.py", "import modeler.derivation", "may import core, numerics, robot"),
    ("estimation/a.py", "from modeler.simulation import X", "modeler.simulation"),
    ("diagnosis/search.py", "from modeler.codegen import X", "imports modeler.codegen"),
    ("codegen/emit.py", "import jinja2", "only codegen/package.py, views/"),
    ("runtime/build.py", "from cffi import FFI", "only runtime/bind.py"),
    ("derivation/a.py", "import casadi as ca", "only codegen/casadi_"),
    ("core/a.py", "import requests", "imports requests"),
    ("estimation/a.py", "from .rank import rank", "relative import"),
    ("estimation/a.py", "from . import rank", "relative import"),
    ("estimation/a.py", "print('done')", "only cli prints"),
    ("estimation/a.py", "run(log=print)", "only cli prints"),
    ("estimation/a.py", "importlib.import_module('sympy')", "import by name"),
    ("estimation/utils.py", "", "name the idea"),
    ("magic/a.py", "import sympy", "magic is no stage we know"),
    ("__init__.py", "from modeler.robot import Robot", "imports nothing"),
    ("estimation/a.py", "x = 1\n" * (MODULE_LINES + 1), "at most 700"),
]


@pytest.mark.parametrize(("file", "text", "words"), PLANTED)
def test_a_planted_violation_is_found(tmp_path: Path, file: str, text: str, words: str) -> None:
    path = tmp_path / file
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    breaks = broken_rules(tmp_path)
    assert len(breaks) == 1 and words in breaks[0], breaks


ALLOWED = {
    "codegen/package.py": "import jinja2\nfrom modeler.formulas import X",
    "simulation/plant.py": "import casadi\nfrom modeler.robot import Robot",
    "cli/main.py": "from modeler.views import X\nfrom modeler.simulation import Y\nprint(1)",
    "estimation/long.py": "x = 1\n" * MODULE_LINES,
    "estimation/words.py": '"""print("a"), import sympy"""\nimport modeler.numerics.noise',
    "diagnosis/add.py": "from modeler.codegen import emit",
    "api.py": "from modeler import validation",
    "cli/version.py": "from modeler import __version__, api",
}


@pytest.mark.parametrize("file", ALLOWED)
def test_what_is_allowed_is_not_found(tmp_path: Path, file: str) -> None:
    path = tmp_path / file
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(ALLOWED[file], encoding="utf-8")
    assert broken_rules(tmp_path) == []


_LOADED = """
import importlib, pkgutil, sys
for stage in sys.argv[1:]:
    package = importlib.import_module(f"modeler.{stage}")
    for module in pkgutil.walk_packages(package.__path__, f"modeler.{stage}."):
        if module.name not in %r:
            importlib.import_module(module.name)
names = {n for n in sys.modules if n.startswith("modeler.")}
print(*sorted({n.split(".")[0] for n in sys.modules} | {".".join(n.split(".")[:2]) for n in names}))
""" % [f"modeler.{file.removesuffix('.py').replace('/', '.')}" for file in ROUND]


def loaded_by(*stages: str) -> set[str]:
    """What a fresh interpreter has loaded after importing every module of these stages."""
    command = [sys.executable, "-c", _LOADED, *stages]
    return set(subprocess.run(command, capture_output=True, text=True, check=True).stdout.split())


SYMBOLIC = {"sympy", "casadi", "jinja2"}


# Stages that may load nothing of the north are tried together: what all of them load, no one may.
STRICT = tuple(s for s in SOUTH if not {*NORTH} & STAGES[s] and not SYMBOLIC & PACKAGES[s])


@pytest.mark.parametrize(
    "stages",
    [STRICT, *(pytest.param((s,), marks=pytest.mark.rotating) for s in SOUTH if s not in STRICT)],
    ids=str,
)
def test_numbers_do_not_need_symbols(stages: tuple[str, ...]) -> None:
    loaded = loaded_by(*stages)
    assert {"numpy", *(f"modeler.{stage}" for stage in stages)} <= loaded
    for stage in stages:
        forbidden = {f"modeler.{north}" for north in NORTH if north not in STAGES[stage]}
        assert not loaded & ((SYMBOLIC - PACKAGES[stage]) | forbidden)


@pytest.mark.rotating("fresh interpreters")
def test_the_simulator_shares_no_dynamics_with_the_model() -> None:
    """The rules of imports say so too; and what loads symbols is seen."""
    assert loaded_by("derivation", "codegen") >= SYMBOLIC
    ours = {name for name in loaded_by("simulation") if name.startswith("modeler.")}
    assert ours == {f"modeler.{n}" for n in ("core", "effects", "numerics", "robot", "simulation")}


@pytest.mark.parametrize("stage", ["diagnosis", "views"])
def test_the_engine_knows_no_effect_by_its_name(stage: str) -> None:
    """What is special about an effect stands in its definition: users' own effects are alike."""
    names = {e.id for e in CATALOGUE if e.columns[0].block is EnergyBlock.OWN}
    for path in modules(PACKAGE / stage):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        words = {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)}
        assert not words & names, path.name
