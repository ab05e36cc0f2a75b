"""Where it fails, days and machines: as a person looks at them, on an arm with a hidden effect."""

import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from modeler.api import load, simulate
from modeler.core.builtin import builtin_text
from modeler.robot import robot_from_text
from modeler.robot.edit import with_parameters
from modeler.studio.project import FOLDERS, Project, ProjectLog, Workspace
from modeler.studio.tasks import LogPart, Step, Stretch, Task, command_line
from tests.rotation import rotating_with
from tests.studio.window import Served, Window, served

MONDAY, TUESDAY = (LogPart(f"logs/{day}.parquet") for day in ("monday", "tuesday"))
FIT = Step(1, 0, Task("fit", (MONDAY,)))
ADD = Step(2, 1, Task("add", (MONDAY,), (TUESDAY,), effect="load_friction", joint="2"))
RANGES = """() => [...document.querySelectorAll('.js-plotly-plot')]
    .filter((p) => p._fullLayout && p._fullLayout.meta.time)
    .map((p) => p._fullLayout.xaxis.range.map(Number))"""


def command(folder: Path, *words: str) -> None:
    subprocess.run(
        [sys.executable, "-m", "modeler", *words, "-q"], cwd=folder, check=True,
        stdout=subprocess.DEVNULL, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
    )  # fmt: skip


@pytest.fixture(scope="module")
def studio(tmp_path_factory) -> Iterator[Served]:
    """A project with two logs, a fit, and a model with one effect more."""
    folder = tmp_path_factory.mktemp("fails")
    for name in FOLDERS:
        (folder / name).mkdir()
    (folder / "robot.toml").write_text(builtin_text("demo-arm"))
    hidden = ("--hide", "load_friction@2", "--noise", "0.01", "--duration", "20")
    for seed, day in enumerate(("monday", "tuesday"), start=31):
        log = f"logs/{day}.parquet"
        command(folder, "simulate", "demo-arm", *hidden, "--seed", str(seed), "--out", log)
    (folder / FIT.robot).write_text(builtin_text("demo-arm"))
    for step in (FIT, ADD):
        command(folder, *command_line(step))
    whole = (Stretch(),)
    logs = (
        ProjectLog("logs/monday.parquet", train=whole),
        ProjectLog("logs/tuesday.parquet", test=whole),
    )
    Workspace(folder).save(Project("robot.toml", 1, logs=logs, steps=(FIT, ADD)))
    with served(folder) as running:
        yield running


@pytest.fixture
def look(window: Callable[..., Window], studio: Served) -> Iterator[Callable[..., Window]]:
    """Opens the one window of a test; the next test's may change things again."""
    opened: list[Window] = []

    def open_window(height: int = 800) -> Window:
        opened.append(window(viewport={"width": 1280, "height": height}).open(studio))
        return opened[-1]

    yield open_window
    for own in opened:
        own.page.context.close()


def drawn(window: Window, title: str) -> None:
    """Until a picture of that title is drawn."""
    window.page.locator(".picture", has_text=title).locator(".main-svg").first.wait_for()


def until(frame: Any, expression: str) -> None:
    """Until that is so in a frame, whose page allows no script to be made of text."""
    for _ in range(300):
        if frame.evaluate(expression):
            return
        frame.page.wait_for_timeout(100)
    raise AssertionError(f"never so: {expression}")


def test_where_it_fails_is_seen_by_joint_and_channel(look) -> None:
    own = look()
    page = own.page
    own.go("Where it fails")
    drawn(own, "Joint 2: measured and predicted")  # the worst one at first
    assert "modeler compare models/1.json logs/tuesday.parquet" in page.inner_text("main")
    said = page.locator(".fails-joint")
    assert said.count() == 3 and "a repeatable function of" in said.nth(1).inner_text()
    # Another joint, by its sentence; then a cell of the map, which is a joint and a channel.
    said.nth(0).click()
    drawn(own, "Joint 1: measured and predicted")
    drawn(own, "Joint 1: residual over")
    heat = page.locator(".picture", has_text="which joint follows what")
    heat.scroll_into_view_if_needed()
    at = heat.locator(".js-plotly-plot").evaluate(
        """(p) => { const b = p.getBoundingClientRect(), l = p._fullLayout, d = p._fullData[0];
        return [b.x + l.xaxis._offset + l.xaxis.c2p(d.x.indexOf('load')),
                b.y + l.yaxis._offset + l.yaxis.c2p(d.y.indexOf('2'))]; }"""
    )
    page.mouse.click(*at)
    drawn(own, "Joint 2: measured and predicted")
    drawn(own, "Joint 2: residual over |predicted| x direction of motion [N m]")
    page.get_by_label("residual over").click()
    page.get_by_role("option", name="qc3").click()
    drawn(own, "Joint 2: residual over qc3")
    # The command itself, and all that it draws.
    own.click("Compare", exact=True)
    page.get_by_text("All that the command drew").click()
    drawn(own, "All joints")
    drawn(own, "Joint 3: does the residual still have structure?")
    # The training stretch instead of the held-out one.
    page.get_by_role("button", name="training").click()
    page.get_by_text("modeler compare models/1.json logs/monday.parquet").wait_for()
    drawn(own, "Joint 2: measured and predicted")
    assert own.complaints == []


def test_one_zoom_and_one_cursor_in_all_pictures(look) -> None:
    own = look(2400)
    page = own.page
    own.go("Where it fails")
    drawn(own, "Joint 2: measured and predicted")
    page.get_by_role("switch", name="all joints").click()
    drawn(own, "Joint 3: measured and predicted")
    page.wait_for_function(f"({RANGES})().length === 3")
    whole = page.evaluate(RANGES)[0]
    box = page.locator(".picture", has_text="Joint 1: measured").locator(".nsewdrag").first
    where = box.bounding_box()
    assert where is not None
    middle = where["y"] + 0.5 * where["height"]
    page.mouse.move(where["x"] + 0.4 * where["width"], middle)
    page.mouse.down()
    page.mouse.move(where["x"] + 0.6 * where["width"], middle + 3, steps=6)
    page.mouse.up()
    low, high = (whole[0] + share * (whole[1] - whole[0]) for share in (0.4, 0.6))
    page.wait_for_function(
        f"({RANGES})().every(([a, b]) => Math.abs(a - {low}) < 0.3 && Math.abs(b - {high}) < 0.3)"
    )
    # What is drawn then is asked for anew: it has only rows of that window.
    page.wait_for_function(
        f"""() => [...document.querySelectorAll('.js-plotly-plot')]
        .filter((p) => p._fullLayout && p._fullLayout.meta.time)
        .every((p) => {{ const x = p._fullData.find((t) => t.name === 'measured').x;
            return x[0] > {low - 0.5} && x[x.length - 1] < {high + 0.5}; }})"""
    )
    page.mouse.move(where["x"] + 0.5 * where["width"], middle)
    page.wait_for_function("document.querySelectorAll('.studio-cursor:not([hidden])').length === 3")
    told = {line.inner_text() for line in page.locator(".studio-cursor").all()}
    assert len(told) == 1
    assert abs(float(told.pop().removesuffix(" s")) - 0.5 * (low + high)) < 0.1
    page.mouse.dblclick(where["x"] + 0.5 * where["width"], middle)
    page.wait_for_function(
        f"({RANGES})().every(([a, b]) => b - a > {0.95 * (whole[1] - whole[0])})"
    )
    assert own.complaints == []


def test_the_robot_plays_along_and_its_joints_are_clicked(look) -> None:
    own = look(1600)
    page = own.page
    own.go("Where it fails")
    drawn(own, "Joint 2: measured and predicted")
    frame = page.locator("iframe.studio-robot").element_handle().content_frame()
    until(frame, "window.modelerShow && modelerShow.view.lit.size === 1")
    before = frame.evaluate("[...modelerShow.u]")
    page.get_by_role("button", name="play").click()
    page.wait_for_function("document.querySelector('.studio-cursor:not([hidden])')")
    until(frame, f"modelerShow.u.some((u, k) => Math.abs(u - {before}[k]) > 0.02)")
    page.get_by_role("button", name="play").click()
    frame.evaluate("tell('joint', { name: '3' })")  # what a click on it does
    drawn(own, "Joint 3: measured and predicted")
    until(frame, "[...modelerShow.view.lit].join() === '2'")
    assert own.complaints == []


@rotating_with("screens of the studio")
def test_days_models_and_drift_are_compared(look, studio) -> None:
    own = look()
    page = own.page
    own.go("Days and machines")
    drawn(own, "Joint 1: residual over velocity")
    table = page.locator("table").first.inner_text()
    assert "monday.parquet" in table and re.search(r"joint 2\s+[\d.]+ %\s+[\d.]+ %", table)
    page.get_by_role("tab", name="Two models").click()
    own.click("Compare both")
    own.sees("2.json predicts joint 2 best, beyond doubt")
    drawn(own, "Joint 2: what each model leaves")
    drawn(own, "Joint 2: measured and predicted")
    contest = studio.project.steps[-1]
    words = ("compare", "models/1.json", "models/2.json", "logs/tuesday.parquet")
    assert command_line(contest) == words
    assert studio.project.current == 1  # a comparison makes no model
    page.get_by_role("tab", name="What drifted").click()
    own.click("Look for drift")
    own.sees("What drifted, leapt or is apart")
    own.sees("nothing drifts")
    drawn(own, "Changes")
    assert studio.project.steps[-1].verb == "fleet"
    assert own.complaints == []


@rotating_with("screens of the studio")
def test_what_drifted_is_named_with_its_picture(window: Callable[..., Window], tmp_path) -> None:
    """Two machines on five days; from the third on, joint 2 of r2 rubs by half as much again."""
    robot = load("two-link")
    motion = {"duration": 6.0, "rate": 200.0, "parameter_seed": 4}
    truth = simulate(robot, **motion, seed=1).truth.parameters
    worn = robot_from_text(
        with_parameters(robot.text, {**truth, "Fs2": 1.5 * truth["Fs2"]}), "worn"
    )
    logs = []
    for m, machine in enumerate(("r1", "r2")):
        (tmp_path / "logs" / machine).mkdir(parents=True)
        for day in range(1, 6):
            logs.append(f"logs/{machine}/2026-03-{day:02d}.parquet")
            own = worn if machine == "r2" and day >= 3 else robot
            simulate(own, tmp_path / logs[-1], **motion, seed=10 * m + day)
    (tmp_path / "robot.toml").write_text(robot.text)
    whole = tuple(ProjectLog(log, train=(Stretch(),)) for log in logs)
    Workspace(tmp_path).save(Project("robot.toml", logs=whole))
    with served(tmp_path) as studio:
        own = window().open(studio)
        own.go("Days and machines")
        own.page.get_by_role("tab", name="What drifted").click()
        own.page.get_by_label("how paths end").fill("{machine}/{period}.parquet")
        own.click("Look for drift")
        row = own.page.locator("tr", has_text="Fs2").first
        row.wait_for()
        told = row.inner_text()
        assert "r2" in told and "jump" in told and "2026-03-03" in told and "sigma" in told
        drawn(own, "Fs2 [N m]")
        assert studio.project.steps[-1].task.name
        assert own.complaints == []


def test_a_log_that_went_away_is_told_in_place(look, studio) -> None:
    own = look()
    place = studio.folder / "logs" / "tuesday.parquet"
    content = place.read_bytes()
    try:
        place.unlink()
        own.go("Where it fails")
        own.sees("logs/tuesday.parquet: cannot be read")
        own.sees("put the file back")
    finally:
        place.write_bytes(content)
    own.go("Fit")
    own.go("Where it fails")
    drawn(own, "Joint 2: measured and predicted")
    assert own.complaints == []
