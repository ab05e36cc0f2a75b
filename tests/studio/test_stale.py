"""What was found is about the model, the files and the time that it was found with."""

import asyncio
import dataclasses
import os
from pathlib import Path

import pytest

from modeler.studio import commands, studio as hubs
from modeler.studio.project import Project, Workspace
from modeler.studio.running import Outcome
from modeler.studio.studio import Hub, Studio
from modeler.studio.tasks import Step, Task


class Slow:
    """A command that does nothing, during which somebody goes elsewhere."""

    def __init__(self, hub: Hub) -> None:
        self.hub, self.title, self.doing, self.share = hub, "slow", "", None

    async def wait(self, told) -> Outcome:
        self.hub.workspace.save(dataclasses.replace(self.hub.project, current=1))
        return Outcome(0, "", (), 0.0)


def test_a_step_is_about_the_model_that_it_began_with(tmp_path: Path, monkeypatch) -> None:
    hub = Hub(Workspace(tmp_path), (), {})
    steps = tuple(Step(n, n - 1, Task("fit")) for n in (1, 2))
    hub.workspace.save(Project("robot.toml", 2, steps=steps))
    monkeypatch.setattr(hubs, "Running", lambda *given: Slow(hub))
    step = asyncio.run(hub.run(commands.diagnose(hub.project)))
    assert step.parent == 2
    assert hub.project.current == 1


@pytest.mark.parametrize(
    ("made", "later"), [("2026-01-01T00:00:00+00:00", True), ("2999-01-01", False), ("", False)]
)
def test_a_file_that_was_written_after_a_step(tmp_path: Path, made: str, later: bool) -> None:
    (tmp_path / "a.csv").write_text("time\n")
    os.utime(tmp_path / "a.csv", (1.79e9, 1.79e9))
    studio = Studio(Hub(Workspace(tmp_path), (), {}), "fit")
    step = Step(1, 0, Task("fit"), made=made)
    assert studio.newer("a.csv", step) is later
    assert not studio.newer("none.csv", step)
