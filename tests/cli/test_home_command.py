"""`modeler home`: modes are told, drawn and written; commands say what they found."""

import json
import os
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from modeler.cli import main
from modeler.robot import builtin_text, read_robot
from tests.loops.test_loops_mistakes import CRANK

BARE = CRANK[: CRANK.index("[home]")].rstrip() + "\n"


@pytest.fixture
def crank(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("crank.toml").write_text(CRANK)
    Path("bare.toml").write_text(BARE)
    return tmp_path


def answer(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["home", *words]) == 0
    return capsys.readouterr().out


def refusal(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["home", *words]) == 1
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("modeler: ") and err.count("\n") == 1
    return err


def test_modes_are_told(crank, capsys) -> None:
    out = answer(capsys, "crank.toml", "--json", "modes.json")
    assert out.startswith("crank: 2 assembly modes with q1 = 1.571 rad (90.0 deg)\n")
    assert "A   q2 = -1.861 rad (-106.6 deg), q3 = 0.3354 m\n" in out
    assert out.count("as [home] of the file") == 1
    assert '  q1 = "pi/2"\n  q2 = -1.860548\n  q3 = 0.33541\n' in out
    told = json.loads(Path("modes.json").read_text())
    assert told["chosen"] == told["of_the_file"] == "A"
    assert [mode["letter"] for mode in told["modes"]] == ["A", "B"]
    assert told["modes"][1]["home"]["3"] == pytest.approx(-0.33541, abs=1e-5)
    assert Path("crank.toml").read_text() == CRANK


def test_the_posture_may_be_said(crank, capsys) -> None:
    out = answer(capsys, "crank.toml", "--near", "q1 = pi/4, q3=-0.2")
    assert "with q1 = 0.7854 rad (45.0 deg)" in out and "as [home] of the file" not in out
    assert "[home] of mode A" in out and "q3 = -0.2721" in out
    assert "q1 = 1.571" not in answer(capsys, "crank.toml", "--anew")


@pytest.mark.parametrize("words", [("bare.toml",), ("bare.toml", "--mode", "b")], ids=" ".join)
def test_a_mode_is_written_and_used(crank, capsys, words) -> None:
    out = answer(capsys, *words, "--write")
    letter = words[-1].upper() if len(words) > 1 else "A"
    assert f"mode {letter} written into bare.toml as [home]" in out
    assert Path("bare.toml").read_text().startswith(BARE)
    assert set(read_robot("bare.toml").home) == {"1", "2", "3"}
    assert main(["derive", "bare.toml"]) == 0
    out = capsys.readouterr().out
    assert "[home] found" not in out and "[home] completed" not in out
    written, told = read_robot("bare.toml").home, answer(capsys, "bare.toml", "--json", "a.json")
    assert told.count("as [home] of the file") == 1
    assert json.loads(Path("a.json").read_text())["modes"][0]["home"] == pytest.approx(
        written, abs=1e-6
    )
    assert (written["3"] > 0) == (letter == "A")


def test_the_file_stays_a_file_of_its_system(crank, capsys) -> None:
    """Line ends as they were; through a link, the file itself is written."""
    Path("bare.toml").write_bytes(BARE.replace("\n", "\r\n").encode())
    Path("link.toml").symlink_to("bare.toml")
    answer(capsys, "link.toml", "--write")
    written = Path("bare.toml").read_bytes()
    assert Path("link.toml").is_symlink() and written.count(b"\n") == written.count(b"\r\n")
    assert set(read_robot("bare.toml").home) == {"1", "2", "3"}


@pytest.mark.parametrize("name", ["modes.html", "modes.svg"])
def test_pictures_show_every_mode_and_need_no_other_file(crank, capsys, name) -> None:
    assert f"written: {name}" in answer(capsys, "stewart", "--pictures", name)
    text = Path(name).read_text()
    drawing = ET.fromstring(text[text.index("<svg") : text.index("</svg>") + 6])
    space = "{http://www.w3.org/2000/svg}"
    panels = drawing.findall(f"{space}g")
    letters = [panel.findtext(f"{space}text") for panel in panels]
    assert letters[0] == "A (as in the file)" and letters[1:] == list("BCDEFGH")
    width, height = float(drawing.attrib["width"]), float(drawing.attrib["height"])
    places = set()
    for panel in panels:
        x, y = map(float, panel.attrib["transform"][10:-1].split())
        dots = panel.findall(f"{space}circle")
        assert len(dots) == 18  # three joints a leg; a platform that moves freely has none
        where = np.array([[x + float(d.attrib["cx"]), y + float(d.attrib["cy"])] for d in dots])
        assert np.all(where >= 0) and np.all(where <= [width, height])
        places.add(tuple(np.round(where - [x, y], 0).ravel()))
    assert len(places) == 8
    assert "http" not in text.replace('xmlns="http://www.w3.org/2000/svg"', "")


def test_commands_say_which_home_was_found(crank, capsys) -> None:
    """And the log, the model and the C are of that mode."""
    assert main(["derive", "bare.toml"]) == 0
    told = "crank: [home] found: mode A at q1 = "
    out = capsys.readouterr().out
    assert out.startswith(told) and "2 assembly modes: `modeler home` shows them" in out
    words = ["simulate", "bare.toml", "--duration", "2", "--rate", "100", "--out", "log.csv"]
    assert main(words) == 0
    assert capsys.readouterr().out.startswith(told)
    assert main(["fit", "bare.toml", "log.csv", "--out", "model.json"]) == 0
    assert told in capsys.readouterr().out
    assert "[home]" in json.loads(Path("model.json").read_text())["robot_text"]


def test_a_home_in_one_line_is_found_all_the_same(crank, capsys) -> None:
    Path("line.toml").write_text("home = {q1 = 0.5}\n" + BARE)
    assert main(["derive", "line.toml"]) == 0
    assert "[home] completed" in capsys.readouterr().out
    before = Path("line.toml").read_bytes()
    assert "[home] cannot be replaced" in refusal_after(capsys, "line.toml", "--write")
    assert Path("line.toml").read_bytes() == before


def refusal_after(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """A refusal at the end of the work."""
    assert main(["home", *words]) == 1
    return capsys.readouterr().err


MISTAKES = [
    (("wrist",), "wrist: there is no loop to close"),
    (("crank.toml", "--near", "q9=1"), '--near: "q9": is no joint variable'),
    (("crank.toml", "--near", "q1=x"), '--near: "q1": got "x": x is not declared'),
    (("crank.toml", "--near", "q1"), "--near q1: got 'q1'; expected values as in q1=0.3,q2=pi"),
    (("crank.toml", "--mode", "C"), "--mode C: there is no such mode; expected one of A, B"),
    (("crank.toml", "--pictures", "a.png"), "--pictures a.png: got .png; expected a name that"),
    (("crank.toml", "--pictures", "a"), "--pictures a: got no suffix; expected a name that"),
    (("five-bar", "--write"), "--write: five-bar is built in; save it with `modeler robots"),
    (("none.toml", "--write"), "none.toml: there is no such file"),
]


@pytest.mark.parametrize(("words", "told"), MISTAKES, ids=[" ".join(m[0]) for m in MISTAKES])
def test_mistakes_are_told_in_a_line(crank, capsys, words, told) -> None:
    assert told in refusal(capsys, *words)
    assert sorted(path.name for path in crank.iterdir()) == ["bare.toml", "crank.toml"]
    assert Path("crank.toml").read_text() == CRANK


def test_a_file_that_may_not_be_written_is_told_before_the_work(crank, capsys, monkeypatch) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    monkeypatch.setattr("modeler.cli.home.modes_near", lambda robot, near: pytest.fail("searched"))
    assert "bare.toml: cannot be written (Permission denied)" in refusal(
        capsys, "bare.toml", "--write"
    )
    assert Path("bare.toml").read_text() == BARE


def test_lengths_that_never_meet_are_told(crank, capsys) -> None:
    Path("far.toml").write_text(BARE.replace('"R", "q2", 0]', '"R", "q2", 0.2]'))
    err = refusal(capsys, "far.toml")
    assert 'loop "pin" cannot close near that posture' in err and "nor from 300 others" in err


def test_a_built_in_robot_saved_as_a_file_can_be_written(crank, capsys) -> None:
    Path("mine.toml").write_text(builtin_text("orthoglide-2003"))
    answer(capsys, "mine.toml", "--write")
    # Nothing had to change but what the file leaves at 0.
    before, after = builtin_text("orthoglide-2003").splitlines(), Path("mine.toml").read_text()
    assert [line for line in after.splitlines() if line in before] == before
    assert '"q2{i}" = "-pi/2"' in after
