"""Two windows on one folder: one writes, the other reads and follows; either may take over."""

import json
from pathlib import Path

from modeler.core.builtin import builtin_text
from modeler.studio.motion_screen import changed_limits, excite
from modeler.studio.project import Project, Step, Workspace
from modeler.studio.studio import Hub, Studio
from tests.studio.window import served
from tests.turns import in_turn


def test_a_second_window_reads_until_it_takes_over(tmp_path: Path, window) -> None:
    with served(tmp_path / "arm") as studio:
        first, second = window().open(studio), window().open(studio)
        second.sees("this window only reads")
        second.click("Try the demo")
        second.sees("this window only reads: another one has the project open; go on there")
        assert studio.project.steps == ()
        second.click("Take over")
        first.sees("this window only reads")
        second.page.get_by_role("button", name="Take over").wait_for(state="hidden")
        second.click("Try the demo")
        second.page.wait_for_url("**/data")
        first.go("3  Fit")  # it follows what the other did
        first.sees("modeler fit")
        second.page.close()
        first.page.get_by_role("button", name="Take over").wait_for(state="hidden")


@in_turn("screens of the studio")
def test_a_second_studio_reads_and_follows_and_takes_over_when_the_first_ends(
    tmp_path: Path, window
) -> None:
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
        reader.sees("What it is worth")
        assert other.project.steps[: len(steps)] == steps and other.project.current


def test_a_motion_keeps_to_the_limits_that_the_robot_file_has_now(tmp_path: Path) -> None:
    text = builtin_text("demo-arm")
    model = {"robot_text": text}
    (tmp_path / "robot.toml").write_text(
        text.replace("1 = [-2.6, 2.6, 2.5, 10.0]", "1 = [-0.3, 0.3, 0.5, 4]"), encoding="utf-8"
    )
    (tmp_path / "1.json").write_text(json.dumps(model), encoding="utf-8")
    steps = (Step(1, 0, "fit", (), model="1.json"),)
    workspace = Workspace(tmp_path)
    workspace.project = Project(robot="robot.toml", steps=steps, current=1)
    studio = Studio(Hub(workspace, (), {}), "motion")
    assert changed_limits(studio) == ["1=-0.3,0.3,0.5,4"]
    words = excite(studio.project, "", 5.0, changed_limits(studio)).words
    assert words[:4] == ("excite", "1.json", "--limit", "1=-0.3,0.3,0.5,4")
    (tmp_path / "robot.toml").write_text(text, encoding="utf-8")
    assert changed_limits(studio) == []
