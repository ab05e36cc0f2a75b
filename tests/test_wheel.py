"""Wheel and sdist, installed elsewhere and used from another folder, do what the checkout does."""

import json
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.repository import ROOT, kept_files
from tests.rotation import slow_rotating

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The sdist, and the wheel made of what is in the sdist."""
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    (sdist,), (wheel,) = folder.glob("*.tar.gz"), folder.glob("*.whl")
    return sdist, wheel


def test_the_wheel_holds_the_package_its_data_and_nothing_else(built: tuple[Path, Path]) -> None:
    with zipfile.ZipFile(built[1]) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
    moved = {"templates": "modeler/_templates", "csrc": "modeler/_csrc", "modeler": "modeler"}
    expected = set()
    for name in kept_files():
        top, _, rest = name.partition("/")
        if top in moved:
            expected.add(f"{moved[top]}/{rest}")
    assert names == expected
    assert {
        "modeler/py.typed",
        "modeler/_templates/module.c.jinja",
        "modeler/_csrc/include/modeler_runtime.h",
        "modeler/effects/catalogue.toml",
        "modeler/robot/library/wrist.toml",
        "modeler/robot/templates/parallelogram.toml",
        "modeler/_templates/plotly/plotly-basic.min.js",
        "modeler/_templates/plotly/LICENSE",
        "modeler/_templates/pages/page.css",
        *(f"modeler/_templates/pages/robot_{name}.js" for name in ("view", "panel", "closing")),
    } <= names


def test_the_sdist_can_be_tested(built: tuple[Path, Path]) -> None:
    with tarfile.open(built[0]) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert set(kept_files()) <= names
    assert {"Makefile", "constraints.txt", "tests/test_wheel.py", "LICENSE"} <= names


def _installed(place: Path, archive: Path) -> Path:
    """The folder of programs of a new environment: ours, and what it needs from this one."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(place)], check=True)
    programs = place / "bin"
    # A folder named in a .pth file is searched last, and its own .pth files (which make an
    # editable modeler importable) are not followed: only what is installed is found as modeler.
    (packages,) = place.glob("lib/python*/site-packages")
    (packages / "needs.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    pip = [sys.executable, "-m", "pip", "--python", str(programs / "python"), "install", "-q"]
    command = [*pip, "--no-deps", "--no-index", "--no-build-isolation", "--ignore-installed"]
    subprocess.run([*command, str(archive)], check=True)
    return programs


@pytest.fixture(scope="module")
def installed(built: tuple[Path, Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Programs of the wheel."""
    return _installed(tmp_path_factory.mktemp("environment with a space"), built[1])


@pytest.fixture(scope="module")
def from_sdist(built: tuple[Path, Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Programs of the sdist."""
    return _installed(tmp_path_factory.mktemp("sdist"), built[0])


Run = Callable[..., str]


def _runner(programs: Path, folder: Path) -> Run:
    """Runs a program of that environment in that folder; gives what it prints."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    environment |= {
        "MODELER_CACHE": str(folder / "cache"),
        "OPENBLAS_NUM_THREADS": "1",
        "CFLAGS": "-O1",
    }

    def run(name: str, *words: str) -> str:
        item = programs / name
        command = [str(item) if item.exists() else name, *words]
        result = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        assert result.returncode == 0, result.stdout + result.stderr
        return result.stdout

    return run


_USE = """
import sys
import numpy as np
import modeler
from modeler.runtime import load_module, load_folder
assert modeler.__file__.startswith(sys.prefix), modeler.__file__
model = load_folder(sys.argv[1])
assert not {"sympy", "casadi", "jinja2"} & set(sys.modules)

from modeler.derivation import derive_base_parameters
from modeler.codegen.emit import emit
from modeler.robot import read_robot
from modeler.derivation import derive_model
symbolic = derive_model(read_robot("two-link"))
emitted = emit(symbolic, derive_base_parameters(symbolic))
assert emitted.spec.compute_signature() == model.spec.compute_signature()

rng = np.random.default_rng(5)
chi, q = rng.normal(size=len(model.spec.standard)), rng.normal(size=(7, 2))
value = dict(zip((column.name for column in model.spec.standard), chi))
for compiled in (model, load_module(emitted.spec, emitted.files)):
    got = compiled.gravity(q, compiled.base_parameters(chi))
    # The textbook arm, Y up: each joint carries the moments of what comes after it.
    c1, s1, c12, s12 = np.cos(q[:, 0]), np.sin(q[:, 0]), np.cos(q.sum(1)), np.sin(q.sum(1))
    outer = 9.81 * (value["MX2"] * c12 - value["MY2"] * s12)
    inner = 9.81 * ((value["MX1"] + 0.4 * value["M2"]) * c1 - value["MY1"] * s1)
    assert np.allclose(got, np.stack([inner + outer, outer], axis=1), rtol=1e-12, atol=1e-12)
print("used")
"""


def test_the_sdist_installs_what_the_wheel_does(installed: Path, from_sdist: Path) -> None:
    """File by file, so that what one does the other does; and its program starts."""
    of_wheel, of_sdist = (
        {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in folder.rglob("*")
            if path.is_file() and "__pycache__" not in path.parts
        }
        for programs in (installed, from_sdist)
        for folder in programs.parent.glob("lib/python*/site-packages/modeler")
    )
    assert len(of_wheel) > 100 and of_sdist == of_wheel
    out = _runner(from_sdist, from_sdist)("modeler", "--version")
    assert re.fullmatch(r"modeler \d+\.\d+\.\d+\S*\n", out)


@slow_rotating("the wheel used")
def test_what_a_stranger_does_first(installed: Path, tmp_path: Path) -> None:
    """A log, a fit, a page, C that checks itself; the C in Python, against a textbook."""
    run = _runner(installed, tmp_path)
    assert re.fullmatch(r"modeler \d+\.\d+\.\d+\S*\n", run("modeler", "--version"))
    for seed in ("1", "2"):
        words = ("--duration", "6", "--rate", "200", "--seed", seed, "--out", f"{seed}.csv")
        run("modeler", "simulate", "two-link", *words)
    run("modeler", "fit", "two-link", "1.csv", "--out", "arm.model.json")
    compare = ("compare", "arm.model.json", "2.csv")
    assert "written: a.html" in run("modeler", *compare, "--report", "a.html")
    assert (tmp_path / "a.html").stat().st_size > 100_000
    run("modeler", "generate", "two-link", "--out", "arm")
    assert "agree with the stored states" in run("make", "-C", "arm", "check")
    assert run("python", "-c", _USE, "arm") == "used\n"


@slow_rotating("the wheel used")
def test_the_demonstration_from_the_wheel(installed: Path, tmp_path: Path) -> None:
    """Short: on the arm the hidden effect is found all the same."""
    out = _runner(installed, tmp_path)("modeler", "demo", "--duration", "5", "--out", "demo")
    assert "the truth: load_friction on joint 2" in out
    arm = json.loads((tmp_path / "demo" / "demo-arm" / "improved.json").read_text("utf-8"))
    assert "load_friction" in json.dumps(arm)
    assert len([*tmp_path.glob("demo/*/improved.html")]) >= 1
    assert (tmp_path / "demo" / "index.html").is_file()


def test_the_description_needs_no_file(built: tuple[Path, Path]) -> None:
    """An index of packages shows it without ours: no picture, no link leads to one of them."""
    with zipfile.ZipFile(built[1]) as archive:
        (place,) = (n for n in archive.namelist() if n.endswith(".dist-info/METADATA"))
        head, _, text = archive.read(place).decode().partition("\n\n")
    assert "Description-Content-Type: text/markdown" in head and text.startswith("# modeler\n")
    assert not re.findall(r"\]\((?!https?:|#)[^)]*\)", text)
    named = set(re.findall(r"\(`([\w/.-]+)`\)", text))
    with tarfile.open(built[0]) as archive:
        assert len(named) > 5
        assert named <= {name.partition("/")[2] for name in archive.getnames()}


_STORY = """
import sys
import modeler as md
assert md.__file__.startswith(sys.prefix), md.__file__
for seed, name in enumerate(("mon.csv", "tue.parquet"), start=1):
    md.simulate(md.load("two-link"), name, duration=4.0, seed=seed)
model = md.identify("two-link", ["mon.csv"])
low, high = model["Fv2"].conf_int(0.95)
assert low < model["Fv2"].value < high and model["Fv2"].unit == "N m s/rad"
run = md.simulate(md.load("two-link"), duration=2.0, seed=4)
torque = model.predict({"time": run.time, "q": run.q})["tau"]
assert torque.shape == run.tau.shape
model.to_c("out")
again = md.load(model.save("arm.json"))
assert again.error("tue.parquet") == model.error("tue.parquet") < 0.02
assert again.resid is not None
print("reported")
"""


@slow_rotating("the wheel used")
def test_the_story_of_one_object_from_the_wheel(installed: Path, tmp_path: Path) -> None:
    assert _runner(installed, tmp_path)("python", "-c", _STORY) == "reported\n"
    assert (tmp_path / "out" / "manifest.json").is_file()
