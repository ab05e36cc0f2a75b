"""Without a C compiler: what works all the same, and what says in one line what to install."""

import json
import shlex

import pytest

import modeler.runtime.model as compiled_model
from modeler.cli import main
from modeler.cli.parser import read_commands
from modeler.core.choices import read_builtin_robot
from tests.rotation import rotating

WORKS = {
    "derive": ("derive five-bar --json out.json", "out.json"),
    "show": ("show wrist --out page.html", "page.html"),
    "generate": ("generate m.json --out folder", "folder/manifest.json"),
    "log": ("log a.parquet --robot two-link --report page.html", "page.html"),
    "physical": ("physical m.json --known m1=3,m2=2 --json out.json", "out.json"),
    "convert": ("convert arm.urdf --out arm.toml", "arm.toml"),
    "export": ("export m.json --like arm.urdf --out better.urdf", "better.urdf"),
    "simulate": ("simulate two-link --duration 1 --out b.csv", "b.csv"),
    "home": ("home five-bar", None),
    "new": ("new own.toml --template parallel", "own.toml"),
    "robots": ("robots wrist", None),
    "effects": ("effects load_friction", None),
    "estimators": ("estimators", None),
    "completion": ("completion bash", None),
}
"""A command of each name, and what it writes."""

REFUSES = {
    "fit": "fit two-link a.parquet --out n.json",
    "compare": "compare m.json a.parquet",
    "diagnose": "diagnose m.json a.parquet",
    "add": "add m.json load_friction --joint 2 a.parquet --out n.json",
    "excite": "excite two-link --out motion.csv",
    "fleet": "fleet two-link a.parquet",
    "demo": "demo --out demo",
    "reproduce": "reproduce hanssen-2000",
}

ELSEWHERE = {"studio"}
"""It starts, and its jobs are commands."""

FORMATS = ("urdf", "mjcf", "sdf", "fmu", "casadi", "ros2")


@pytest.fixture(scope="module")
def urdf(two_link, tmp_path_factory):
    """What is written of the model where there is a compiler."""
    place = tmp_path_factory.mktemp("given") / "arm.urdf"
    assert main(f"export {two_link}/m.json --to urdf --out {place}".split()) == 0
    return place


@pytest.fixture
def workdir(two_link, urdf, tmp_path, monkeypatch):
    """Log, model and URDF on a machine without a compiler and with nothing compiled."""
    (tmp_path / "nothing").mkdir()
    folder = tmp_path / "work"
    folder.mkdir()
    for place in (two_link / "a.parquet", two_link / "m.json", urdf):
        (folder / place.name).write_bytes(place.read_bytes())
    monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("MODELER_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(compiled_model, "_MODELS", {})
    monkeypatch.chdir(folder)
    return folder


def test_every_command_stands_here() -> None:
    assert {*WORKS, *REFUSES, *ELSEWHERE} == set(read_commands())


@pytest.mark.parametrize(
    "name", ["derive", "export", *rotating(*sorted({*WORKS} - {"derive", "export"}))]
)
def test_these_work(workdir, name, capsys) -> None:
    words, written = WORKS[name]
    assert main(shlex.split(words)) == 0, capsys.readouterr().err
    assert written is None or (workdir / written).stat().st_size > 100


def test_every_way_out_works(workdir, capsys) -> None:
    for kind in FORMATS:
        assert main(["export", "m.json", "--to", kind, "--out", kind]) == 0
    assert "sources only, for nothing could be compiled here" in capsys.readouterr().out


@pytest.mark.parametrize("name", REFUSES)
def test_these_say_what_to_install(workdir, name, capsys) -> None:
    assert main(REFUSES[name].split()) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("modeler: C compiler: none of cc, gcc, clang is found; install one: ")
    assert "MinGW-w64 or Visual Studio" in line


def test_a_log_tells_that_no_fit_was_tried(workdir, capsys) -> None:
    """All else of the log is as with a compiler; a mapping is not written untried."""
    assert main(["log", "a.parquet", "--robot", "two-link", "--json", "log.json"]) == 0
    doubts = json.loads((workdir / "log.json").read_text())["warnings"]
    (line,) = [doubt for doubt in doubts if "C compiler" in doubt]
    assert line.startswith("not tried by a fit of two-link: C compiler: none of cc")
    text = read_builtin_robot("two-link")
    (workdir / "own.toml").write_text(text, encoding="utf-8")
    assert main(["log", "a.parquet", "--robot", "own.toml", "--write"]) == 1
    assert "C compiler: none of cc" in capsys.readouterr().err
    assert (workdir / "own.toml").read_text(encoding="utf-8") == text
