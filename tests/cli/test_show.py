"""`modeler show`: what it prints, writes and refuses."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from modeler.api import load, show
from modeler.cli import main
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import DataError
from modeler.derivation.assembly_modes import complete_home
from modeler.robot.read import read_robot
from modeler.views.robot_drawing import render_picture
from modeler.views.robot_skeleton import build_skeleton, find_home_posture
from tests.cli.running import answer, refusal
from tests.robots import ROBOTS
from tests.rotation import with_cases


@pytest.fixture
def workdir(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_page_beside_the_user(workdir: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = answer(capsys, "show", "wrist")
    assert out.splitlines()[-1] == "page: wrist.html"
    assert "gravity 9.81 m/s2 along -y0" in out
    assert re.search(r"^3 +2 +revolute, actuated +0.0000 +0.0000 +0.0000 +0.3000 +\+z0$", out, re.M)
    assert [path.name for path in workdir.iterdir()] == ["wrist.html"]


@pytest.mark.parametrize("name", ROBOTS)
def test_a_page_needs_nothing_else(workdir: Path, name: str) -> None:
    assert main(["show", name, "--out", "p.html", "--json", "p.json"]) == 0
    page = (workdir / "p.html").read_text(encoding="utf-8")
    assert "default-src 'none'" in page
    assert not re.search(r"https?://|<link|<iframe|\bsrc=|@import|url\(", page)
    assert len(page) < 400_000
    robot, result = read_robot(name), json.loads((workdir / "p.json").read_text())
    for joint in robot.joints:
        assert f">{joint.name}</td>" in page
    assert result["is_closed"] and result["is_as_stated"] and result["page"] == "p.html"
    assert [frame["name"] for frame in result["frames"]] == [joint.name for joint in robot.joints]
    assert set(result["home"]) == {joint.variable for joint in robot.moving_joints}
    assert len(result["loops"]) == len(robot.loops)
    for loop in result["loops"]:
        assert loop["is_closed"] and loop["gap"] < 1e-9 and loop["angle"] < 1e-7
    if robot.loops:
        by_name = {frame["name"]: np.array(frame["pose"]) for frame in result["frames"]}
        loop = result["loops"][0]
        gap = by_name[loop["frame"]][:3, 3] - by_name[loop["meets"]][:3, 3]
        assert np.linalg.norm(gap) < 1e-9


@pytest.mark.parametrize(
    "name", ["wrist", *(pytest.param(n, marks=pytest.mark.rotating) for n in ("stewart", "emps"))]
)
def test_a_picture_is_drawn(workdir: Path, name: str) -> None:
    from matplotlib.image import imread

    kinds = ("pdf", "png", "svg") if name == "wrist" else ("png", "svg")
    for kind in kinds:
        assert main(["show", name, "--picture", f"{name}.{kind}"]) == 0
    assert sorted(path.name for path in workdir.iterdir()) == [f"{name}.{k}" for k in kinds]
    pixels = imread(workdir / f"{name}.png")[:, :, :3]
    assert pixels.shape[1] == 1400  # 3.5 inches of 400 dots
    inked = np.mean(np.any(pixels < 0.95, axis=2))
    assert 0.01 < inked < 0.6
    margin = pixels[:8], pixels[-8:], pixels[:, :8], pixels[:, -8:]
    assert all(np.all(edge == 1.0) for edge in margin)  # nothing is cut off
    svg = (workdir / f"{name}.svg").read_text()
    for joint in read_robot(name).joints:
        if not joint.name.startswith("P"):
            assert f">{joint.name}</text>" in svg
    if "pdf" in kinds:
        assert (workdir / f"{name}.pdf").read_bytes().startswith(b"%PDF")


def test_the_same_robot_gives_the_same_picture() -> None:
    skeleton = build_skeleton(read_robot("emps"))
    posture = find_home_posture(skeleton)
    for kind in (".svg", ".pdf"):
        first, again = (render_picture(skeleton, posture, kind) for _ in range(2))
        assert first == again


BARE = re.sub(r"\[home\][^\[]*", "", read_builtin_robot("five-bar"))


def test_a_home_that_is_found_is_shown_and_said(workdir, capsys) -> None:
    """The posture that a derivation starts from, on the page and in words."""
    (workdir / "bare.toml").write_text(BARE)
    out = answer(capsys, "show", "bare.toml", "--out", "b.html", "--json", "b.json")
    result = json.loads((workdir / "b.json").read_text())
    note = "five-bar: [home] found: mode A at q11 = 2.2, q12 = 0.9; 2 assembly modes"
    assert note in out and result["note"].startswith(note)
    assert note in (workdir / "b.html").read_text()
    actual = complete_home(read_robot("bare.toml")).robot.home
    assert {name: result["home"][f"q{name}"] for name in actual} == pytest.approx(actual, abs=1e-5)
    assert result["is_closed"] and result["loose_joints"] == []
    out = answer(capsys, "show", "five-bar", "--out", "b.html", "--json", "b.json")
    assert "found" not in out
    assert json.loads((workdir / "b.json").read_text())["note"] == ""


def test_what_cannot_be_derived_is_shown_with_the_reason(workdir, capsys) -> None:
    (workdir / "bare.toml").write_text(BARE.replace("L0 = 0.20", "L0 = 5.0"))
    out = answer(capsys, "show", "bare.toml", "--out", "b.html")
    assert "the loops do not close near all joints at 0: drawn so; move" in out
    assert 'five-bar: [home]: loop "tip" cannot close near that posture' in out
    page = (workdir / "b.html").read_text()
    assert "[home]: loop &#34;tip&#34; cannot close" in page


def test_a_robot_is_drawn_from_python(workdir) -> None:
    shown = show(load("five-bar"), page="p.html", picture="p.svg")
    assert shown.posture.is_closed and shown.posture.note == ""
    assert sorted(path.name for path in workdir.iterdir()) == ["p.html", "p.svg"]
    with pytest.raises(DataError, match=r"^p.bmp: got .bmp; expected a name that ends in .png"):
        show(load("five-bar"), picture="p.bmp")


def test_loops_that_do_not_close_are_shown_and_told(workdir, capsys) -> None:
    (workdir / "bad.toml").write_text(
        read_builtin_robot("five-bar").replace("L0 = 0.20", "L0 = 5.0")
    )
    words = "show bad.toml --out b.html --picture b.svg --json b.json"
    out = answer(capsys, *words.split())
    assert 'loop "tip": 31 meets 32 (revolute): OPEN by ' in out
    assert "the loops do not close near [home]: drawn as it is stated" in out
    result = json.loads((workdir / "b.json").read_text())
    assert not result["is_closed"] and result["loops"][0]["gap"] > 3.0
    assert "#e00000" in (workdir / "b.svg").read_text()  # the gap, in red


@with_cases(
    "words, message",
    ("wrist --picture w.jpg", "w.jpg: got .jpg; expected a name that ends in .png, .svg, .pdf"),
    ("wrost", '"wrost" is neither a file nor a built-in robot'),
    ("wrist --out w.html --picture w.html", "--picture w.html: --out writes this file too"),
    ("wrist --out a/b", "a/b: cannot be written"),
)
def test_what_is_refused_is_one_line_and_leaves_nothing(workdir, capsys, words, message) -> None:
    (workdir / "a").write_text("a file")
    assert refusal(capsys, "show", *words.split()).startswith(f"modeler: {message}")
    assert {path.name for path in workdir.iterdir()} == {"a"}
