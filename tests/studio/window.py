"""A studio as a process, and windows of a real browser that look at it."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler.studio.project import FILE, Project, parse_project
from tests.browser.chromium import PATIENCE, chromium


@dataclass
class Served:
    """A studio that runs.

    Attributes:
        folder: of the project.
        address: with its token.
        process: of the server.
    """

    folder: Path
    address: str
    process: subprocess.Popen[str]

    @property
    def root(self) -> str:
        """The address without the token."""
        return self.address.partition("?")[0].rstrip("/")

    @property
    def project(self) -> Project:
        """As its file says."""
        place = self.folder / FILE
        text = place.read_text(encoding="utf-8") if place.exists() else ""
        return parse_project(text, str(place))

    def end(self, number: int = signal.SIGINT) -> int:
        """Its status, after a signal."""
        self.process.send_signal(number)
        return self.process.wait(30)


@contextmanager
def served(folder: Path, *options: str) -> Iterator[Served]:
    """A studio of a folder, as the command starts it."""
    words = [sys.executable, "-m", "modeler", "studio", str(folder), "--no-open", *options]
    environment = os.environ | {"PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, text=True, env=environment, start_new_session=True
    ) as process:
        try:
            assert process.stdout is not None
            result = next((m for x in process.stdout if (m := re.search(r"http://\S+", x))), None)
            assert result, "the studio printed no address"
            yield Served(folder, result[0], process)
        finally:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()


class Window:
    """A window of the browser, as a person uses it.

    Attributes:
        page: of Playwright.
        complaints: errors of the console, and requests that failed.
    """

    def __init__(self, page: Any) -> None:
        self.page = page
        self.complaints: list[str] = []
        page.set_default_timeout(1000.0 * PATIENCE)
        page.on("console", self._heard)
        page.on("pageerror", lambda error: self.complaints.append(str(error)))

    def _heard(self, message: Any) -> None:
        if message.type == "error":
            self.complaints.append(message.text)

    def open(self, studio: Served) -> "Window":
        """With the token, and until the first screen is there."""
        self.page.goto(studio.address)
        self.page.wait_for_selector(".studio-screen")
        return self

    def go(self, job: str) -> None:
        """To one of the nine jobs, by its title."""
        self.page.get_by_role("button", name=job).first.click()
        self.idle()

    def click(self, name: str, exact: bool = False) -> None:
        """A button."""
        self.page.get_by_role("button", name=name, exact=exact).first.click()

    def idle(self) -> None:
        """Until no command runs and the screen is drawn."""
        self.page.wait_for_function(
            "() => document.querySelector('.studio-screen')"
            " && !document.querySelector('.studio-running:not(.hidden)')",
            polling=100,
        )

    def until(self, holds: Callable[[], Any]) -> None:
        """Waits for what the page brings about elsewhere."""
        for _ in range(2400):
            if holds():
                return
            self.page.wait_for_timeout(50)
        raise TimeoutError

    def sees(self, text: str) -> None:
        """Until this stands on the page."""
        self.page.get_by_text(text).first.wait_for()


@contextmanager
def opened() -> Iterator[Any]:
    """A function that opens windows of one browser, each as of another person."""
    with chromium() as browser:
        size = {"width": 1280, "height": 800}
        yield lambda **more: Window(browser.new_context(**{"viewport": size} | more).new_page())
