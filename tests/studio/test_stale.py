"""What was found is about the model, the files and the time that it was found with."""

import dataclasses
import os
from pathlib import Path
from typing import Any

import pytest

from modeler.studio import commands
from modeler.studio.project import Project, Workspace
from modeler.studio.running import Outcome
from modeler.studio.tasks import Step, Task
from tests.studio.hubs import hub_of, run_tasks


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
        monkeypatch.setattr("modeler.studio.studio.Running", lambda *given: Slow(hub))
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
    assert studio.newer("a.csv", step) is later
    assert not studio.newer("none.csv", step)
