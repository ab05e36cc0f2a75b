"""A headless Chromium, driven by Playwright: pages in files, and windows that open any address."""

import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
_FLAGS = tuple(
    """
    --no-sandbox --disable-gpu --disable-dev-shm-usage --disable-quic --no-first-run
    --disable-background-networking --disable-component-update --disable-sync
""".split()
)
PATIENCE = 60.0  # s


@contextmanager
def chromium() -> Iterator[Any]:
    """The browser of Playwright; while it runs, its process can run no event loop."""
    playwright = pytest.importorskip("playwright.sync_api", reason="NOT CHECKED: no playwright")
    program = next((path for name in NAMES if (path := shutil.which(name))), None)
    if program is None:
        pytest.skip(f"NOT CHECKED: no browser, none of {', '.join(NAMES)} is on the path")
    with playwright.sync_playwright() as running:
        browser = running.chromium.launch(executable_path=program, args=[*_FLAGS])
        yield browser
        browser.close()


def until(frame: Any, condition: str) -> None:
    """Waits for a condition in a page whose policy lets nothing be evaluated by its scripts."""
    end = time.monotonic() + PATIENCE
    while not frame.evaluate(condition):
        if time.monotonic() > end:
            raise TimeoutError(condition)
        time.sleep(0.03)


class Chromium:
    """One page in one browser.

    Attributes:
        page: of Playwright.
        requests: addresses that were requested, the file itself included.
        complaints: errors and warnings of the console, uncaught exceptions, refused loads.
    """

    def __init__(self, browser: Any) -> None:
        self._browser = browser
        self.page: Any = None
        self._pages: dict[tuple[int, str], Any] = {}
        self.requests: list[str] = []
        self.complaints: list[str] = []

    def open(self, place: Path, width: int, height: int, script: str = "") -> None:
        """Loads a file into a window of that size; a script runs before those of the page."""
        if (width, script) not in self._pages:
            mobile = {"is_mobile": True} if width < 600 else {}
            page = self._pages[width, script] = self._browser.new_context(**mobile).new_page()
            page.on("request", lambda request: self.requests.append(request.url))
            page.on("console", self._heard)
            page.on("pageerror", lambda error: self.complaints.append(str(error)))
            page.add_init_script(script)
        self.page = self._pages[width, script]
        self.page.set_viewport_size({"width": width, "height": height})
        self.requests.clear()
        self.complaints.clear()
        self.page.goto(place.resolve().as_uri())

    def _heard(self, message: Any) -> None:
        if message.type in ("error", "warning"):
            self.complaints.append(message.text)

    def until(self, condition: str) -> None:
        """Waits until a condition in JavaScript holds."""
        until(self.page, condition)

    def value(self, expression: str) -> Any:
        """The value of a JavaScript expression."""
        return self.page.evaluate(expression)

    def download(self, folder: Path, link: int) -> Path:
        """Clicks the n-th link that downloads something; the file that the browser saved."""
        with self.page.expect_download() as coming:
            self.value(f"document.querySelectorAll('a[download]')[{link}].click()")
        coming.value.save_as(folder / coming.value.suggested_filename)
        return folder / coming.value.suggested_filename
