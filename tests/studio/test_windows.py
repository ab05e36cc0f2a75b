"""Two windows on one folder; what was found is about the model, the files and the time it had."""

import dataclasses
import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.core.choices import read_builtin_robot
from modeler.studio import commands
from modeler.studio.commands import build_command_words
from modeler.studio.processes import Outcome
from modeler.studio.project import Project, ProjectLog, Workspace
from modeler.studio.tasks import Step, Task, TimeRange
from tests.rotation import slow_rotating
from tests.studio.hubs import hub_of, run_tasks
from tests.studio.window import served


@slow_rotating("screens of the studio")
def test_a_second_studio_reads_and_follows_and_takes_over_when_the_first_ends(tmp_path, window):
    folder = tmp_path / "arm"
    with served(folder) as one, served(folder) as other:
        writer, reader = window().open(one), window().open(other)
        reader.sees("this window only reads")
        reader.click("Take over")
        reader.sees("another studio has it open; end that with Ctrl-C")
        writer.click("Try the demo")
        writer.page.wait_for_url("**/data")
        reader.go("3  Fit")
        reader.sees("modeler fit")
        steps = one.project.steps
        one.end()
        reader.click("Take over")
        reader.page.get_by_role("button", name="Take over").wait_for(state="hidden")
        reader.click("Fit", exact=True)
        reader.sees("Fit quality")
        assert other.project.steps[: len(steps)] == steps and other.project.current


def test_a_motion_keeps_to_the_limits_that_the_robot_file_has_now(tmp_path: Path) -> None:
    from modeler.studio.motion_screen import find_changed_limits
    from modeler.studio.studio import Studio

    text, place = read_builtin_robot("demo-arm"), tmp_path / "robot.toml"
    slow = text.replace("1 = [-2.6, 2.6, 2.5, 10.0]", "1 = [-0.3, 0.3, 0.5, 4]")
    place.write_text(slow, encoding="utf-8")
    (tmp_path / "models").mkdir()
    (tmp_path / "models/1.json").write_text(json.dumps({"robot_text": text}), encoding="utf-8")
    fit = Step(1, 0, Task("fit"))
    Workspace(tmp_path).save(Project(robot="robot.toml", steps=(fit,), current=1))
    with hub_of(tmp_path) as hub:
        studio = Studio(hub, "motion")
    assert find_changed_limits(studio) == ["1=-0.3,0.3,0.5,4"]
    task = Task("excite", duration=5.0, limit=tuple(find_changed_limits(studio)))
    words = build_command_words(studio.project, task)
    assert words[:2] == ("excite", "models/1.json")
    assert words[words.index("--limit") + 1] == "1=-0.3,0.3,0.5,4"
    place.write_text(text, encoding="utf-8")
    assert find_changed_limits(studio) == []


class Slow:
    """A command that does nothing, during which somebody goes elsewhere."""

    def __init__(self, hub: Any) -> None:
        self.hub, self.title, self.doing, self.share = hub, "slow", "", None

    async def wait(self, told) -> Outcome:
        self.hub.workspace.save(dataclasses.replace(self.hub.project, current=1))
        return Outcome(0, "", (), 0.0)


def test_a_step_is_about_the_model_that_it_began_with(tmp_path: Path, monkeypatch) -> None:
    steps = tuple(Step(n, n - 1, Task("fit")) for n in (1, 2))
    Workspace(tmp_path).save(Project("robot.toml", 2, steps=steps))
    with hub_of(tmp_path) as hub:
        monkeypatch.setattr("modeler.studio.studio.RunningCommand", lambda *inputs: Slow(hub))
        (step,) = run_tasks(hub, commands.diagnose)
        assert step.parent == 2 and hub.project.current == 1


@pytest.mark.parametrize(
    ("made", "later"), [("2026-01-01T00:00:00+00:00", True), ("2999-01-01", False), ("", False)]
)
def test_a_file_that_was_written_after_a_step(tmp_path: Path, made: str, later: bool) -> None:
    from modeler.studio.studio import Studio

    (tmp_path / "a.csv").write_text("time\n")
    os.utime(tmp_path / "a.csv", (1.79e9, 1.79e9))
    step = Step(1, 0, Task("fit"), made=made)
    with hub_of(tmp_path) as hub:
        studio = Studio(hub, "fit")
    assert studio.is_newer("a.csv", step) is later
    assert not studio.is_newer("none.csv", step)


TOPIC = "/left_arm_controller/joint_trajectory_state_broadcaster/joint_states."
LINK = "left_arm_shoulder_upper_link_revolute_joint"


@pytest.mark.rotating("screens of the studio")
def test_no_page_is_wider_than_its_window_with_the_long_names_of_ros(tmp_path, window):
    folder, log = tmp_path / "arm", f"logs/{'recording_of_the_left_arm_' * 4}.csv"
    (folder / "logs").mkdir(parents=True)
    (folder / "robot.toml").write_text(read_builtin_robot("two-link"), encoding="utf-8")
    kinds = {"q": "position", "qd": "velocity", "tau": "effort"}
    names = [f"{TOPIC}{kind}[{LINK}_{j}]" for kind in kinds.values() for j in (1, 2)]
    time = np.arange(400) * 0.01
    rows = np.column_stack([time, *(np.sin(time * k + k) for k in range(1, 7))])
    head = ",".join(["time", *names])
    np.savetxt(folder / log, rows, delimiter=",", header=head, comments="", fmt="%.6f")
    mapping = tuple(f"{item}<j>={TOPIC}{kind}[{LINK}_{{j}}]" for item, kind in kinds.items())
    logs = (ProjectLog(log, (TimeRange(),)),)
    Workspace(folder).save(Project("robot.toml", mapping=mapping, mapped=True, logs=logs))
    with served(folder) as studio:
        file = window(viewport={"width": 1280, "height": 800}).open(studio)
        file.go("2  Data")
        file.page.wait_for_selector(".mapping-chip")
        file.page.wait_for_selector(".js-plotly-plot .main-svg")
        assert file.page.evaluate("document.documentElement.scrollWidth") <= 1280
        file.go("3  Fit")
        assert file.page.evaluate("document.documentElement.scrollWidth") <= 1280
        assert file.complaints == []
