"""The studio killed at any moment: the project opens, and at most the step that ran is lost."""

import contextlib
import json
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from modeler.core.errors import ModelerError
from modeler.estimation import load_model
from modeler.studio import commands
from modeler.studio.places import lock_folder
from modeler.studio.project import FILE, Workspace
from tests.rotation import ROTATING
from tests.studio.hubs import full_disk, hub_of, run_tasks
from tests.studio.test_dropped import wait_until

# What windows do to a project, without windows: a fit, an effect more, back again, and so on.
WORKING = """
import asyncio, sys
from pathlib import Path
from modeler.studio import commands
from modeler.studio.places import lock_folder
from modeler.studio.project import Workspace
from modeler.studio.studio import Hub

async def work(hub):
    while True:
        await hub.run(commands.fit(hub.project))
        print(hub.project.next_number - 1, flush=True)
        await hub.run(commands.add(hub.project, "spring", None))
        print(hub.project.next_number - 1, flush=True)
        hub.take(hub.project.step(hub.project.next_number - 2))

folder = Path(sys.argv[1])
with lock_folder(folder) as own:
    assert own
    print("open", flush=True)
    asyncio.run(work(Hub(Workspace(folder), (), {})))
"""


def check(folder: Path, told: int) -> int:
    """Opens it as the next studio does; the steps that it holds."""
    with lock_folder(folder) as local:
        assert local
        project = Workspace(folder).project
        steps = [step.number for step in project.steps]
        assert steps == list(range(1, len(steps) + 1)) and told <= len(steps) <= told + 1
        for step in project.steps:
            load_model(folder / step.model_file)
            json.loads((folder / step.result_file).read_text())
        if project.current:
            assert project.model_file
        for path in folder.rglob("*"):
            assert not path.name.startswith((".modeler-", ".dropping-")), path
            if path.suffix == ".json":
                json.loads(path.read_text())
    return len(steps)


def working_in(folder: Path) -> list[str]:
    """Processes that run in the folder."""
    values = []
    for place in Path("/proc").glob("[0-9]*/cwd"):
        with contextlib.suppress(OSError):
            if place.readlink() == folder:
                values.append(place.parent.name)
    return values


@pytest.mark.rotating("long tests of studio")
@pytest.mark.skipif(not Path("/proc/self/cwd").exists(), reason="NOT CHECKED: needs /proc")
@pytest.mark.parametrize("times", [1, pytest.param(10, marks=ROTATING)])
def test_killed_at_random_moments(axis_project: Path, times: int) -> None:
    """Of one project, so that each studio goes on where the one before was killed."""
    folder = axis_project
    rng = random.Random()
    words = [sys.executable, "-c", WORKING, str(folder)]
    held = 0
    for _ in range(times):
        moment = rng.uniform(0.0, 4.0)
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as server:
            assert server.stdout is not None and server.stdout.readline() == "open\n"
            time.sleep(moment)
            server.kill()
            lines = [int(line) for line in server.stdout]
        wait_until(lambda: not working_in(folder))
        held = check(folder, max([held, *lines]))
    assert (held > 0 or times < 10) and (folder / FILE).exists()


def test_a_full_disk_is_a_line_and_the_project_stays(axis_project: Path) -> None:
    folder = axis_project
    with hub_of(folder) as hub:
        run_tasks(hub, commands.fit)
        before, text = hub.project, (folder / FILE).read_bytes()
        refused = pytest.raises(ModelerError, match=r"^models/2.json: cannot be written \(")
        with full_disk(4096), refused:
            run_tasks(hub, commands.fit)
        assert hub.project == before and (folder / FILE).read_bytes() == text
        assert check(folder, 1) == 1
        run_tasks(hub, commands.fit)
    assert check(folder, 2) == 2
