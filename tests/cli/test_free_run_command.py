"""`modeler compare --free-run` as a user types it."""

import json
from pathlib import Path

import pytest

from tests.cli.inputs import folder_after
from tests.cli.running import answer, refusal
from tests.rotation import with_cases


@pytest.fixture(scope="module")
def slide(tmp_path_factory) -> Path:
    """A simulated log of one axis, and a model fitted to it."""
    return folder_after(
        tmp_path_factory.mktemp("slide"),
        "simulate emps --duration 4 --rate 250 --out {}/a.parquet",
        "fit emps {0}/a.parquet --out {0}/m.json",
    )


@pytest.mark.rotating("long tests of cli")
def test_text_json_and_pictures(capsys, slide: Path) -> None:
    words = "compare {0}/m.json {0}/a.parquet --free-run --window 0.5 --report {0}/f.html"
    outputs = " --json {0}/f.json --picture {0}/p"
    out = answer(capsys, *(words + outputs).format(slide).split())
    assert out.startswith("emps: free run under the logged torques on a.parquet: 7")
    assert "integrated twice" in out and "written: 3 files in" in out
    page = (slide / "f.html").read_text()
    assert "emps: free run in windows of 0.5 s" in page and "Joint 1: measured and free" in page
    result = json.loads((slide / "f.json").read_text())
    joint = result["joints"]["1"]
    assert joint["fit"] > 99.0 > joint["constant_speed_fit"] and joint["unit"] == "m"
    assert result["stability"]["is_unstable"] is False and "controller" in result
    assert {p.name for p in (slide / "p").iterdir()} == {
        f"joint_1_free_run.{kind}" for kind in ("png", "svg", "csv")
    }


@with_cases(
    "words, message",
    ("--controller 20", "--controller 20: expected two to four numbers that are not negative"),
    ("--controller 20,inf", "--controller 20,inf: expected two to four numbers"),
    ("--controller 0,1", "--controller 0,1: a loop of 0 holds nothing; expected a speed loop"),
    ("--window 0", "--window: got 0; expected a number above 0"),
    ("--bound inf", "--bound: got inf; expected a number above 0"),
    ("--window 9", "--window 9: the longest uninterrupted motion of these logs is "),
)
def test_bad_input_is_one_line(capsys, slide: Path, words: str, message: str) -> None:
    run = ("compare", "--free-run", slide / "m.json", slide / "a.parquet")
    assert refusal(capsys, *run, *words.split()).startswith(f"modeler: {message}")


def test_a_log_given_twice_is_refused(capsys, slide: Path) -> None:
    log = slide / "a.parquet"
    assert "rows of" in refusal(capsys, "compare", "--free-run", slide / "m.json", log, log)
