"""`modeler compare --free-run` as a user types it."""

import json
from pathlib import Path

import pytest

from modeler.cli import main


@pytest.fixture(scope="module")
def slide(tmp_path_factory) -> Path:
    """A simulated log of one axis, and a model fitted to it."""
    folder = tmp_path_factory.mktemp("slide")
    log, model = str(folder / "a.parquet"), str(folder / "m.json")
    words = ["simulate", "emps", "--duration", "4", "--rate", "250", "--out", log]
    assert main(words) == 0
    assert main(["fit", "emps", log, "--out", model]) == 0
    return folder


def test_text_json_and_pictures(capsys, slide: Path) -> None:
    words = ["compare", str(slide / "m.json"), str(slide / "a.parquet"), "--free-run"]
    words += ["--window", "0.5", "--report", str(slide / "f.html")]
    capsys.readouterr()
    assert main([*words, "--json", str(slide / "f.json"), "--picture", str(slide / "p")]) == 0
    out, err = capsys.readouterr()
    assert err == "" and out.startswith("emps: free run under the logged torques on a.parquet: 7")
    assert "integrated twice" in out and "written: 3 files in" in out
    page = (slide / "f.html").read_text()
    assert "emps: free run in windows of 0.5 s" in page and "Joint 1: measured and free" in page
    found = json.loads((slide / "f.json").read_text())
    joint = found["joints"]["1"]
    assert joint["fit"] > 99.0 > joint["constant_speed"] and joint["unit"] == "m"
    assert found["stability"]["unstable"] is False and "controller" in found
    assert {p.name for p in (slide / "p").iterdir()} == {
        f"joint_1_free_run.{kind}" for kind in ("png", "svg", "csv")
    }


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("--controller 20", "--controller 20: expected two to four numbers that are not negative"),
        ("--controller 20,x", "--controller 20,x: expected two to four numbers"),
        ("--controller=-2,1", "--controller -2,1: expected two to four numbers"),
        ("--controller 20,inf", "--controller 20,inf: expected two to four numbers"),
        ("--controller 0,1", "--controller 0,1: a loop of 0 holds nothing; expected a speed loop"),
        ("--window 0", "--window: got 0; expected a number above 0"),
        ("--bound inf", "--bound: got inf; expected a number above 0"),
        ("--window 9", "--window 9: the longest uninterrupted motion of these logs is "),
    ],
)
def test_bad_input_is_one_line(capsys, slide: Path, words: str, told: str) -> None:
    argv = ["compare", "--free-run", str(slide / "m.json"), str(slide / "a.parquet")]
    argv += words.split()
    assert main(argv) == 1
    out, err = capsys.readouterr()
    assert out == "" and err.startswith(f"modeler: {told}") and err.count("\n") == 1


def test_a_log_given_twice_is_refused(capsys, slide: Path) -> None:
    log = str(slide / "a.parquet")
    assert main(["compare", "--free-run", str(slide / "m.json"), log, log]) == 1
    assert "rows of" in capsys.readouterr().err
