"""The studio killed at any moment: the project opens, and at most the step that ran is lost."""

import asyncio
import contextlib
import json
import random
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from modeler.cli import main
from modeler.core.builtin import builtin_text
from modeler.core.errors import ModelerError
from modeler.estimation import load_model
from modeler.studio import commands
from modeler.studio.places import folder_lock
from modeler.studio.project import FILE, FOLDERS, Project, ProjectLog, Workspace
from modeler.studio.studio import Hub
from modeler.studio.tasks import Stretch
from tests.rotation import ROTATING
from tests.studio.in_process import without_processes
from tests.studio.test_dropped import wait_until

# What windows do to a project, without windows: a fit, an effect more, back again, and so on.
WORKING = """
import asyncio, sys
from pathlib import Path
from modeler.studio import commands
from modeler.studio.places import folder_lock
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
with folder_lock(folder) as own:
    assert own
    print("open", flush=True)
    asyncio.run(work(Hub(Workspace(folder), (), {})))
"""


@pytest.fixture(scope="module")
def begun(tmp_path_factory) -> Path:
    """A project that may be worked on."""
    folder = tmp_path_factory.mktemp("killed") / "begun"
    for name in FOLDERS:
        (folder / name).mkdir(parents=True)
    (folder / "robot.toml").write_text(builtin_text("emps"))
    words = "simulate emps --duration 6 --rate 250 --hide spring:stiffness=40,rest=0.1 --out"
    assert main([*words.split(), str(folder / "logs/a.csv")]) == 0
    project = Project("robot.toml", logs=(ProjectLog("logs/a.csv", (Stretch(),)),))
    Workspace(folder).save(project)
    return folder


def check(folder: Path, told: int) -> int:
    """Opens it as the next studio does; the steps that it holds."""
    with folder_lock(folder) as own:
        assert own
        project = Workspace(folder).project
        steps = [step.number for step in project.steps]
        assert steps == list(range(1, len(steps) + 1)) and told <= len(steps) <= told + 1
        for step in project.steps:
            load_model(folder / step.model)
            json.loads((folder / step.result).read_text())
        if project.current:
            assert project.model
        for path in folder.rglob("*"):
            assert not path.name.startswith((".modeler-", ".dropping-")), path
            if path.suffix == ".json":
                json.loads(path.read_text())
    return len(steps)


def working_in(folder: Path) -> list[str]:
    """Processes that run in the folder."""
    found = []
    for place in Path("/proc").glob("[0-9]*/cwd"):
        with contextlib.suppress(OSError):
            if place.readlink() == folder:
                found.append(place.parent.name)
    return found


@pytest.mark.rotating("long tests of studio")
@pytest.mark.skipif(not Path("/proc/self/cwd").exists(), reason="NOT CHECKED: needs /proc")
@pytest.mark.parametrize("times", [1, pytest.param(10, marks=ROTATING)])
def test_killed_at_random_moments(begun: Path, tmp_path: Path, times: int) -> None:
    """Of one project, so that each studio goes on where the one before was killed."""
    folder = tmp_path / "project"
    shutil.copytree(begun, folder)
    rng = random.Random()
    words = [sys.executable, "-c", WORKING, str(folder)]
    held = 0
    for _ in range(times):
        moment = rng.uniform(0.0, 4.0)
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as server:
            assert server.stdout is not None and server.stdout.readline() == "open\n"
            time.sleep(moment)
            server.kill()
            told = [int(line) for line in server.stdout]
        wait_until(lambda: not working_in(folder))
        held = check(folder, max([held, *told]))
    assert (held > 0 or times < 10) and (folder / FILE).exists()


def test_a_full_disk_is_a_line_and_the_project_stays(begun: Path, tmp_path: Path) -> None:
    """Larger files than so are not written, by the command neither: what needs no rights for it."""
    folder = tmp_path / "project"
    shutil.copytree(begun, folder)

    async def work() -> None:
        hub = Hub(Workspace(folder), (), {})
        await hub.run(commands.fit(hub.project))
        held, kept = hub.project, (folder / FILE).read_bytes()
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
        try:
            with pytest.raises(ModelerError, match=r"^models/2.json: cannot be written \("):
                await hub.run(commands.fit(hub.project))
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
        assert hub.project == held and (folder / FILE).read_bytes() == kept
        assert check(folder, 1) == 1
        await hub.run(commands.fit(hub.project))
        hub.close()

    with without_processes():
        asyncio.run(work())
    assert check(folder, 2) == 2
