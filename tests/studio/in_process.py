"""The studio in this process: its commands, its viewer and its windows, without a browser."""

import asyncio
import io
import re
import time
from collections.abc import AsyncIterator, Callable, Iterator, Sequence
from contextlib import asynccontextmanager, chdir, contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
from nicegui import Client, ElementFilter, core, ui
from nicegui.testing import User
from nicegui.testing.user_interaction import UserInteraction
from nicegui.testing.user_simulation import user_simulation

from modeler.cli import main
from modeler.studio import app, places, processes, studio as studio_module
from modeler.studio.processes import Outcome
from modeler.studio.project import Project, Workspace
from modeler.studio.studio import Hub

SHORT = ("--duration", "24", "--rate", "200")
"""Of what is simulated here, whatever was requested."""


class InProcess:
    """A command as `Running` is one, carried out when it is waited for."""

    share, doing = None, "starting"

    def __init__(self, words: Sequence[str], folder: Path, title: str) -> None:
        self.words, self.folder, self.title = words, folder, title

    async def wait(self, told: Callable[[], None] = lambda: None) -> Outcome:
        """Its end."""
        await asyncio.sleep(0.0)
        told()
        words = (*self.words, *(SHORT if self.words[0] == "simulate" else ()))
        status, lines, error = run_command(self.folder, words)
        return Outcome(status, error, lines, 0.0)

    def cancel(self) -> None:
        """Too late."""


def run_command(folder: Path, words: Sequence[str]) -> tuple[int, tuple[str, ...], str]:
    """Status of a command in a folder, what it prints, and its last word on what went wrong."""
    out, error = io.StringIO(), io.StringIO()
    with chdir(folder), redirect_stdout(out), redirect_stderr(error):
        status = main([*words])
    line = error.getvalue().strip().rpartition("\n")[2].removeprefix("modeler: ")
    return status, tuple(out.getvalue().splitlines()), line if status else ""


async def answer(asked: processes.Viewer, function: str, arguments: tuple[Any, ...]) -> Any:
    """As the process of the viewer answers."""
    folder, allowed = asked._places
    before, places.READABLE = places.READABLE, places.Roots(allowed)
    try:
        with chdir(folder):
            return processes.compute_answer(function, arguments)
    finally:
        places.READABLE = before


@contextmanager
def without_processes() -> Iterator[None]:
    """Commands and questions of a studio start no process."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(studio_module, "RunningCommand", InProcess)
        patch.setattr(processes.Viewer, "_compute_answer", answer)
        yield


class Page:
    """A window of a studio, with what a person does in it."""

    def __init__(self, user: User, hub: Hub) -> None:
        self.user, self.hub = user, hub

    @property
    def project(self) -> Project:
        """As it is now."""
        return self.hub.project

    async def open(self, place: str = "/") -> "Page":
        """Until it is drawn."""
        await self.user.open(place)
        await self.idle()
        return self

    def every(self, kind: str = "element", text: str | None = None) -> list[Any]:
        """What is visible, of that kind of `nicegui.ui`, with that text in it."""
        local = getattr(ui, kind)
        with self.user:
            return [*ElementFilter(kind=local, content=text, local_scope=False, only_visible=True)]

    def listeners(self, event: str) -> list[Any]:
        """What is reported about an event, in the order of the page."""
        return [
            one
            for one in self.user.client.elements.values()
            if event in {listener.type for listener in one._event_listeners.values()}
        ]

    def texts(self) -> str:
        """All that is written."""
        return "\n".join(getattr(one, "text", "") or "" for one in self.every())

    def field(self, label: str) -> Any:
        """What is filled in or pressed, by its label or its name for a screen reader."""
        names = ("label", "aria-label")
        return next(one for one in self.every() if label in (one.props.get(name) for name in names))

    def change(self, field: str, value: Any) -> None:
        """Another value in a field."""
        element = self.field(field)
        with self.user:
            element.value = value

    def choose(self, kind: str, value: Any, text: str | None = None) -> None:
        """Another value of the first of that kind and text: tabs, a switch, a toggle."""
        element = self.every(kind, text)[0]
        with self.user:
            element.value = value

    def trigger(self, element: Any, event: str, args: Any = None) -> None:
        """What the script of an element shows."""
        UserInteraction(self.user, {element}, None).trigger(event, args)

    async def click(self, name: str, event: str = "click") -> None:
        """A button of exactly that name, as soon as it can be pressed."""

        def named(button: Any) -> bool:
            texts = [getattr(one, "text", "") for one in (button, *button.descendants())]
            return name in (*texts, button.props.get("aria-label"))

        def ready() -> list[Any]:
            return [one for one in self.every("button") if one.enabled and named(one)]

        await self.until(ready, name)
        self.trigger(ready()[0], event)
        await self.idle()

    async def go(self, job: str) -> None:
        """To one of the nine jobs."""
        await self.click(next(b.text for b in self.every("button") if b.text.endswith(f"  {job}")))

    async def saves(self, button: str) -> bytes:
        """What a button downloads."""
        before = len(self.user.download.http_responses)
        await self.click(button)
        await self.until(lambda: len(self.user.download.http_responses) > before, "a download")
        content: bytes = self.user.download.http_responses[-1].content
        return content

    async def drops(self, *files: Path) -> None:
        """Files on the screen, as the browser sends them and reports them."""
        zone = self.every("upload")[-1]
        kind = zone.props["url"]
        sent = [
            await self.user.http_client.post(
                kind, content=file.read_bytes(), headers={"x-name": quote(file.name)}
            )
            for file in files
        ]
        for answered in sent:
            self.trigger(zone, "uploaded", answered.json())

    async def idle(self) -> None:
        """Until no command runs, and all is drawn."""
        await asyncio.sleep(0.0)

        def still() -> bool:
            drawn = [studio._drawing for studio in self.hub.studios]
            return self.hub.running is None and all(one and one.done() for one in drawn)

        for _ in range(3):
            await self.until(still, "a screen")
            await asyncio.sleep(0.0)

    async def sees(self, text: str) -> None:
        """Until that stands on the page."""
        await self.until(lambda: self.every(text=text), text)

    async def until(self, holds: Callable[[], Any], what: str = "") -> None:
        """Waits for a condition."""
        end = time.monotonic() + 60.0
        while not holds():
            if time.monotonic() > end:
                raise TimeoutError(f"{what} is not there")
            await asyncio.sleep(0.01)


@asynccontextmanager
async def windows(folder: Path, allow: Sequence[Path] = ()) -> AsyncIterator[Callable[[], Page]]:
    """A function that makes windows of the studio of a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with without_processes():
        Client.page_routes.clear()
        async with user_simulation(lambda: None) as first:
            screens = {name: draw for name, (_, draw) in app.JOBS.items()}
            hub = Hub(Workspace(folder), (folder, *allow), {"start": app.draw_start, **screens})
            app._add_routes(core.app, hub)
            app._add_pages(hub, demo=False)

            def window() -> Page:
                user = User(first.http_client)
                user.javascript_rules[re.compile(".*matchMedia")] = lambda _: True
                return Page(user, hub)

            try:
                yield window
            finally:
                hub.close()
                for client in Client.instances.values():
                    client.outbox.stop()  # a wait that has just ended does not heed a cancel
                Client.page_routes.clear()  # else the simulation forgets our modules
