"""`modeler home`: modes are reported, drawn and written; commands say what they found."""

import json
import os
import re
from pathlib import Path

import numpy as np
import pytest

from modeler.robot.read import read_robot
from tests.cli.running import answer, refusal, run
from tests.robot_texts import CRANK
from tests.rotation import rotating

BARE = CRANK[: CRANK.index("[home]")].rstrip() + "\n"


@pytest.fixture
def crank(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("crank.toml").write_text(CRANK)
    Path("bare.toml").write_text(BARE)
    return tmp_path


def test_modes_are_told(crank, capsys) -> None:
    out = answer(capsys, "home", "crank.toml", "--json", "modes.json")
    assert out.startswith("crank: 2 assembly modes with q1 = 1.571 rad (90.0 deg)\n")
    assert "A   q2 = -1.861 rad (-106.6 deg), q3 = 0.3354 m\n" in out
    assert out.count("as [home] of the file") == 1
    assert '  q1 = "pi/2"\n  q2 = -1.860548\n  q3 = 0.33541\n' in out
    result = json.loads(Path("modes.json").read_text())
    assert result["chosen_mode"] == result["as_given"] == "A"
    assert [mode["letter"] for mode in result["modes"]] == ["A", "B"]
    assert result["modes"][1]["home"]["3"] == pytest.approx(-0.33541, abs=1e-5)
    assert Path("crank.toml").read_text() == CRANK


def test_the_posture_may_be_said(crank, capsys) -> None:
    out = answer(capsys, "home", "crank.toml", "--near", "q1 = pi/4, q3=-0.2")
    assert "with q1 = 0.7854 rad (45.0 deg)" in out and "as [home] of the file" not in out
    assert "[home] of mode A" in out and "q3 = -0.2721" in out
    assert "q1 = 1.571" not in answer(capsys, "home", "crank.toml", "--anew")


@pytest.mark.parametrize("words", [("bare.toml",), ("bare.toml", "--mode", "b")], ids=" ".join)
def test_a_mode_is_written_and_used(crank, capsys, words) -> None:
    out = answer(capsys, "home", *words, "--write")
    letter = words[-1].upper() if len(words) > 1 else "A"
    assert f"mode {letter} written into bare.toml as [home]" in out
    assert Path("bare.toml").read_text().startswith(BARE)
    assert set(read_robot("bare.toml").home) == {"1", "2", "3"}
    out = answer(capsys, "derive", "bare.toml")
    assert "[home] found" not in out and "[home] completed" not in out
    out = answer(capsys, "home", "bare.toml", "--json", "a.json")
    assert out.count("as [home] of the file") == 1
    home = read_robot("bare.toml").home
    first = json.loads(Path("a.json").read_text())["modes"][0]
    assert first["home"] == pytest.approx(home, abs=1e-6)
    assert (home["3"] > 0) == (letter == "A")


def test_the_file_stays_a_file_of_its_system(crank, capsys) -> None:
    """Line ends as they were; through a link, the file itself is written."""
    Path("bare.toml").write_bytes(BARE.replace("\n", "\r\n").encode())
    Path("link.toml").symlink_to("bare.toml")
    answer(capsys, "home", "link.toml", "--write")
    written = Path("bare.toml").read_bytes()
    assert Path("link.toml").is_symlink() and written.count(b"\n") == written.count(b"\r\n")
    assert set(read_robot("bare.toml").home) == {"1", "2", "3"}


@pytest.mark.parametrize("kind", ["svg", *rotating("html", "png", "pdf")])
def test_pictures_show_every_mode_and_need_no_other_file(crank, capsys, kind) -> None:
    name = f"modes.{kind}"
    assert f"written: {name}" in answer(capsys, "home", "crank.toml", "--picture", name)
    if kind == "pdf":
        assert Path(name).read_bytes().startswith(b"%PDF")
    elif kind == "png":
        from matplotlib.image import imread

        pixels = imread(name)[:, :, :3]
        assert pixels.shape[1] == 1400  # 3.5 inches of 400 dots
        halves = pixels[:, :700], pixels[:, 700:]
        assert all(0.01 < np.mean(np.any(half < 0.95, axis=2)) < 0.5 for half in halves)
        assert np.mean(np.any(np.abs(halves[0] - halves[1]) > 0.05, axis=2)) > 0.005
    else:
        text = Path(name).read_text()
        assert all(f">{title}</text>" in text for title in ("A (as in the file)", "B"))
        assert not re.search(r"<link|<iframe|\bsrc=|@import|<script|url\((?!#)", text)


@pytest.mark.rotating("long tests of cli")
def test_commands_say_which_home_was_found(crank, capsys) -> None:
    """And the log, the model and the C are of that mode."""
    for line in (
        "derive bare.toml",
        "simulate bare.toml --duration 2 --rate 100 --out log.csv",
        "fit bare.toml log.csv --out model.json",
    ):
        status, out, _ = run(capsys, *line.split())
        assert status == 0 and "crank: [home] found: mode A at q1 = " in out
        assert "2 assembly modes: `modeler home` shows them" in out
    assert "[home]" in json.loads(Path("model.json").read_text())["robot_text"]


MISTAKES = [
    (("wrist",), "wrist: there is no loop to close"),
    (("crank.toml", "--near", "q9=1"), '--near: "q9": is no joint variable'),
    (("crank.toml", "--near", "q1=x"), '--near: "q1": got "x": x is not declared'),
    (("crank.toml", "--near", "q1"), "--near q1: got 'q1'; expected values as in q1=0.3,q2=pi"),
    (("crank.toml", "--mode", "C"), "--mode C: there is no such mode; expected one of A, B"),
    (("crank.toml", "--picture", "a.gif"), "--picture a.gif: got .gif; expected a name that"),
    (("crank.toml", "--picture", "a"), "--picture a: got no ending; expected a name that"),
    (("five-bar", "--write"), "--write: five-bar is built in; save it with `modeler robots"),
    (("none.toml", "--write"), "none.toml: there is no such file"),
]


@pytest.mark.parametrize(("words", "message"), MISTAKES, ids=[" ".join(m[0]) for m in MISTAKES])
def test_mistakes_are_told_in_a_line(crank, capsys, words, message) -> None:
    assert message in refusal(capsys, "home", *words)
    assert sorted(path.name for path in crank.iterdir()) == ["bare.toml", "crank.toml"]
    assert Path("crank.toml").read_text() == CRANK


def test_a_file_that_may_not_be_written_is_told_before_the_work(crank, capsys, monkeypatch) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    monkeypatch.setattr("modeler.api.postures.home", lambda *inputs: pytest.fail("searched"))
    err = refusal(capsys, "home", "bare.toml", "--write")
    assert "bare.toml: cannot be written (Permission denied)" in err
    assert Path("bare.toml").read_text() == BARE


def test_another_programs_file_is_never_written_over(crank, capsys, monkeypatch) -> None:
    monkeypatch.setattr("modeler.api.postures.home", lambda *inputs: pytest.fail("searched"))
    for name in ("ARM2.PAR", "none.par"):
        err = refusal(capsys, "home", name, "--write")
        hint = f"convert it with `modeler convert {name} --out {Path(name).with_suffix('.toml')}`"
        assert f"--write: {name} is another program's file" in err and hint in err
