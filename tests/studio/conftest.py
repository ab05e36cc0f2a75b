"""The demonstration, carried out once; a server; the windows of a browser."""

import asyncio
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.studio.in_process import windows
from tests.studio.window import Served, Window, opened, served, without_browser


@pytest.fixture(scope="session")
def demonstration(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The arm with a hidden effect, from the empty page on: fitted, diagnosed, the effect tried."""
    folder = tmp_path_factory.mktemp("demonstration") / "arm"

    async def clicked() -> None:
        async with windows(folder) as window:
            page = await window().open()
            await page.click("Try the demo")
            await page.go("Fit")
            await page.click("Fit")
            await page.go("What is missing")
            await page.click("Look")
            await page.click("Preview")

    asyncio.run(clicked())
    return folder


@pytest.fixture
def arm(demonstration: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    return shutil.copytree(demonstration, tmp_path / "arm")


@pytest.fixture(scope="session")
def served_studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """A studio whose tests only ask for what it must not give, or drop files."""
    with served(tmp_path_factory.mktemp("served") / "project") as running:
        yield running


@pytest.fixture(scope="module")
def window() -> Iterator[Callable[..., Window]]:
    """Opens a window; each call another one, as of another person.

    Of a module: while Playwright runs, the tests of others could run no event loop.
    """
    if why := without_browser():
        pytest.skip(why)
    with opened() as open_window:
        yield open_window
