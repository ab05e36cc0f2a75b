"""Projects that are carried out once; a server; the windows of a browser.

NiceGUI is imported in fixtures and functions: it costs each process of the tests a second.
"""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from modeler.cli import main
from modeler.core.choices import read_builtin_robot
from modeler.studio.project import FOLDERS, Project, ProjectLog, Workspace
from modeler.studio.tasks import TimeRange
from tests.coroutines import run_coroutine
from tests.studio.requests import let_in
from tests.studio.window import Served, Window, opened, served

SECRET = "what nobody may read"


@pytest.fixture(scope="session")
def demonstration(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The arm with a hidden effect, from the empty page on: fitted, diagnosed, the effect tried."""
    from tests.studio.in_process import windows

    folder = tmp_path_factory.mktemp("demonstration") / "arm"

    async def clicked() -> None:
        async with windows(folder) as window:
            page = await window().open()
            await page.click("Try the demo")
            await page.go("Fit")
            await page.click("Fit")
            await page.go("What is missing")
            await page.click("Diagnose")
            await page.click("Preview")

    run_coroutine(clicked())
    return folder


@pytest.fixture
def arm(demonstration: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    return shutil.copytree(demonstration, tmp_path / "arm")


@pytest.fixture(scope="session")
def axis(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """EMPS, a single axis with a hidden spring, and a log: nothing is fitted yet."""
    folder = tmp_path_factory.mktemp("axis") / "project"
    for name in FOLDERS:
        (folder / name).mkdir(parents=True)
    (folder / "robot.toml").write_text(read_builtin_robot("emps"))
    words = "simulate emps --duration 6 --rate 250 --hide spring:stiffness=40,rest=0.1 --out"
    assert main([*words.split(), str(folder / "logs/a.csv")]) == 0
    Workspace(folder).save(Project("robot.toml", logs=(ProjectLog("logs/a.csv", (TimeRange(),)),)))
    return folder


@pytest.fixture
def axis_project(axis: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    return shutil.copytree(axis, tmp_path / "project")


@pytest.fixture(scope="session")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """A server that is only requested what it must not give, or gets files.

    Beside its folder lies a file that a link in it leads to.
    """
    folder = tmp_path_factory.mktemp("served") / "project"
    (folder / "logs").mkdir(parents=True)
    (folder.parent / "secret.csv").write_text(SECRET)
    (folder / "logs" / "out.csv").symlink_to(folder.parent / "secret.csv")
    with served(folder) as running:
        yield running


@pytest.fixture(scope="session")
def cookie(studio: Served) -> str:
    return let_in(studio)


@pytest.fixture(scope="module")
def window() -> Iterator[Callable[..., Window]]:
    """Opens a window; each call another one, as of another person.

    Of a module: while Playwright runs, the tests of others could run no event loop.
    """
    with opened() as open_window:
        yield open_window
