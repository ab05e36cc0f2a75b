"""What screens work with: the project, commands, questions to the viewer, and the other windows."""

from __future__ import annotations  # a hub has studios, and each studio its hub

import asyncio
import contextlib
import dataclasses
import hashlib
import secrets
import time
from collections import OrderedDict
from collections.abc import Awaitable, Callable, Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from nicegui import background_tasks, ui
from nicegui.element import Element

from modeler.api.front_end import DataError, ModelerError, parse_json, read_text, write_atomically
from modeler.studio import commands
from modeler.studio.places import Roots
from modeler.studio.processes import RunningCommand, Viewer
from modeler.studio.project import DRAFT, FILE, FOLDERS, FOREIGN, Project, Workspace
from modeler.studio.tasks import MAKING, ROBOT, Step, Task, build_bookkeeping_words
from modeler.studio.thresholds import THRESHOLDS

Screen = Callable[["Studio"], Awaitable[None]]
"""Draws a screen into the element that is open."""


class Hub:
    """One project folder, and all windows that look at it.

    Attributes:
        workspace: the folder.
        viewer: the process that holds logs and predictions.
        running: the command that runs; None: none.
        last: words of the command that was requested last, a step or not.
        gives_way: whether it is cancelled as soon as another one is requested.
        studios: of the windows, the first of which may change things.
        sheets: HTML of frames inside the page, by its digest.
        downloads: what may be taken away, by a key that nobody guesses, with its name.
        own: takes the folder, where another process has let go of it.
        allowed: folders whose files may be chosen where they lie.
        screens: by name.
    """

    def __init__(
        self, workspace: Workspace, allowed: tuple[Path, ...], screens: Mapping[str, Screen]
    ) -> None:
        self.workspace, self.allowed, self.screens = workspace, allowed, screens
        self._roots = Roots((workspace.folder, *allowed))
        self._roots.check_links(workspace.folder, (FILE, ROBOT, DRAFT, *FOLDERS, "originals"))
        self.viewer = Viewer(workspace.folder, self._roots.folders)
        self.running: RunningCommand | None = None
        self.acquire_folder: Callable[[], bool] = lambda: False
        self.gives_way = False
        self.last: tuple[str, ...] = ()
        self.studios: list[Studio] = []
        self.sheets: OrderedDict[str, str] = OrderedDict()
        self.downloads: OrderedDict[str, tuple[Path | bytes, str]] = OrderedDict()

    @property
    def project(self) -> Project:
        """Returns the current project."""
        return self.workspace.project

    def refresh(self) -> None:
        """Redraws every window."""
        for studio in self.studios:
            studio.redraw()

    def follow_changes(self) -> None:
        """Reads what another process has written since."""
        before = self.project
        if not self.workspace.writable:
            with contextlib.suppress(ModelerError):  # edited by hand, and not done
                self.workspace.reload_project()
        if self.project != before:
            self.refresh()

    def give_control(self, studio: Studio) -> None:
        """Lets that window change the project; all others only read.

        Raises:
            ModelerError: another process has the folder open.
        """
        if not self.workspace.writable and not self.acquire_folder():
            raise ModelerError(
                f"{self.workspace.folder}: another studio has it open; end that with Ctrl-C where "
                "it was started, then take over"
            )
        if not self.workspace.writable:
            self.workspace.writable = True
            self.workspace.reload_project()
        self.studios.remove(studio)
        self.studios.insert(0, studio)
        self.refresh()

    def notify_windows(self) -> None:
        """Shows the progress of the command in every window."""
        for studio in self.studios:
            studio.notify_listeners()

    async def run(
        self, task: Task, current: bool = True, keep: bool = True, aside: bool = False
    ) -> Step:
        """Carries out a task, and keeps it as a step.

        Args:
            task: to be carried out.
            current: True if a model that it makes is looked at from now on.
            keep: False for what is no step of the project.
            aside: True for what nobody waits for: it is cancelled when another command comes.

        Raises:
            ModelerError: it failed or was cancelled; its line. Nothing is kept then.
        """
        await self._cancel_background()
        if self.running is not None:
            raise ModelerError(
                f"{task.title}: {self.running.title} runs still; wait for it, or cancel it"
            )
        if not self.workspace.can_change:
            self.workspace.save(self.project)  # says why not
        step = self.project.make_next_step(task)
        words = commands.build_command_words(self.project, step)
        self._roots.check_words(self.workspace.folder, words)
        self._prepare_step(step)
        self.gives_way, self.last = aside, words
        self.running = RunningCommand(
            [*words, *build_bookkeeping_words(step)], self.workspace.folder, task.title
        )
        self.notify_windows()
        start_time = time.perf_counter()
        try:
            outcome = await self.running.wait(self.notify_windows)
        finally:
            self.running = None
            self.notify_windows()
        if outcome.status != 0 or (aside and not self.gives_way):
            raise ModelerError(outcome.error or f"{task.title}: cancelled")
        seconds, end_time = round(time.perf_counter() - start_time, 2), datetime.now(UTC)
        step = dataclasses.replace(
            step, seconds=seconds, made=end_time.isoformat(timespec="seconds")
        )
        if keep:
            steps = (*self.project.steps, step)
            self.workspace.save(dataclasses.replace(self.project, steps=steps))
            if current and step.model_file:
                self.take_step(step)
            self.refresh()
        return step

    def take_step(self, step: Step) -> None:
        """Makes the model of a step the current one; an unedited robot file goes along.

        Raises:
            ModelerError: something cannot be written.
        """
        before = self.project.find_step(self.project.current)
        place = self.workspace.folder / ROBOT
        now = self.read_step_robot(step)
        if before is not None and now and read_text(place) == self.read_step_robot(before):
            write_atomically(place, now)
        self.workspace.save(dataclasses.replace(self.project, current=step.number))

    def read_step_robot(self, step: Step) -> str:
        """Reads the robot of a step, with its added effects; "" if its file is gone."""
        with contextlib.suppress(OSError, ValueError, TypeError, KeyError):
            text = read_text(self.workspace.folder / (step.robot_copy or step.model_file))
            return text if step.robot_copy else str(parse_json(text)["robot_text"])
        return ""

    async def _cancel_background(self) -> None:
        """What gives way ends."""
        before = self.running
        if before is not None and self.gives_way:
            self.gives_way = False
            before.cancel()
            while self.running is before:
                await asyncio.sleep(0.02)

    def _prepare_step(self, step: Step) -> None:
        """Folders, and the robot as it is now if the command works on a copy of it."""
        for name in FOLDERS:
            (self.workspace.folder / name).mkdir(parents=True, exist_ok=True)
        if step.robot_copy:
            text = read_text(self.workspace.folder / ROBOT)
            write_atomically(self.workspace.folder / step.robot_copy, text)

    def register_sheet(self, html: str, place: str = "/sheet/") -> str:
        """Registers a page of its own and returns its address.

        Args:
            html: that was made here and now.
            place: `access.REPORTS` for what stands in a file.
        """
        digest = hashlib.sha256(html.encode()).hexdigest()[:20]
        self.sheets[digest] = html
        self.sheets.move_to_end(digest)
        while len(self.sheets) > THRESHOLDS.max_sheets:
            self.sheets.popitem(last=False)
        return f"{place}{digest}.html"

    def register_download(self, content: Path | bytes, name: str) -> str:
        """Registers a file, a folder (as ZIP) or bytes and returns the download address.

        Args:
            content: what it is; no address leads to any other file.
            name: that the browser gives it.

        Raises:
            DataError: there is no such file in the project.
        """
        if isinstance(content, Path):
            content = self._roots.resolve_inside(content)
        key = secrets.token_urlsafe(16)
        self.downloads[key] = content, name
        while len(self.downloads) > THRESHOLDS.max_downloads:
            self.downloads.popitem(last=False)
        return f"/download/{key}"

    def close(self) -> None:
        """Ends the running processes."""
        if self.running is not None:
            self.running.cancel()
        self.viewer.end()


class Studio:
    """One window of the studio.

    Attributes:
        hub: of the folder.
        screen: that is shown.
        kept: what screens keep in this window, by their own names.
    """

    def __init__(self, hub: Hub, screen: str) -> None:
        self.hub, self.screen = hub, screen
        self.state: dict[str, Any] = {}
        self.room: Element | None = None
        self._drawing: asyncio.Task[None] | None = None
        self.listeners: list[Callable[[], None]] = []

    @property
    def project(self) -> Project:
        """Returns the current project."""
        return self.hub.project

    @property
    def folder(self) -> Path:
        """Returns the folder of the project."""
        return self.hub.workspace.folder

    @property
    def is_read_only(self) -> bool:
        """Returns True for all windows but the first, and for locked or foreign projects."""
        return not self.hub.workspace.can_change or self.hub.studios[:1] != [self]

    def check_writable(self) -> None:
        """Refuses what changes things in a window that only reads.

        Raises:
            ModelerError: says why it only reads.
        """
        if self.is_read_only:
            raise ModelerError(self.read_only_reason)

    @property
    def read_only_reason(self) -> str:
        """Returns the line that explains why the window only reads."""
        foreign = self.hub.workspace.foreign
        return FOREIGN.format(self.folder) if foreign else READ_ONLY

    def change_project(self, redraw: bool = False, **fields: Any) -> bool:
        """Makes the project another one; other windows show it.

        Args:
            redraw: True if this window is drawn anew too.
            fields: of `Project`.

        Returns:
            True if it is saved; else the line is shown.
        """
        with self.show_errors():
            self.check_writable()
            self.hub.workspace.save(dataclasses.replace(self.project, **fields))
            for studio in self.hub.studios:
                if studio is not self or redraw:
                    studio.redraw()
                studio.notify_listeners()
            return True
        return False

    def take_step(self, step: Step) -> bool:
        """Makes the model of a step the current one, in all windows; False if it cannot be."""
        with self.show_errors():
            self.check_writable()
            self.hub.take_step(step)
            self.hub.refresh()
            return True
        return False

    async def run(self, task: Task, current: bool = True, keep: bool = True) -> Step | None:
        """Carries out a task; None if it failed, whose line is shown then. See `Hub.run`."""
        self.show_error("")
        with self.show_errors():
            self.check_writable()
            return await self.hub.run(task, current, keep)
        return None

    async def ask_viewer(self, question: str, *arguments: Any, kind: str = "") -> Any:
        """Asks the viewer for a function of `studio.viewing`; see `Viewer.ask`.

        Args:
            question: name of the function.
            arguments: of it; files relative to the folder.
            kind: of questions of this window of which only the newest is answered, others None.

        Raises:
            ModelerError: it has none; its line.
        """
        kind_key = f"{id(self)} {kind}" if kind else ""
        return await self.hub.viewer.ask(question, *arguments, kind=kind_key)

    def read_text(self, file: str) -> str:
        """Reads a text file of the project.

        Raises:
            DataError: it cannot be read; says what to do.
        """
        try:
            return read_text(self.folder / file)
        except (OSError, UnicodeDecodeError) as error:
            why = getattr(error, "strerror", None) or "it is no text"
            raise DataError(
                f"{file}: cannot be read ({why}); put the file back, or take the step again"
            ) from None

    def read_result(self, step: Step) -> dict[str, Any]:
        """Reads the JSON result of a step.

        Raises:
            DataError: the file is gone, or no JSON.
        """
        return self._read_json(step.result_file)

    @property
    def model_step(self) -> Step:
        """Returns the step that made the current model.

        Raises:
            DataError: there is none.
        """
        step = self.project.find_step(self.project.current)
        if step is None or step.verb not in MAKING:
            raise DataError("there is no model yet; fit one first")
        return step

    def read_model(self, step: Step) -> dict[str, Any]:
        """Reads the model file of a step.

        Raises:
            DataError: the file is gone, or no JSON.
        """
        return self._read_json(step.model_file)

    def is_newer(self, file: str, step: Step) -> bool:
        """Returns True if a file was written after a step was done."""
        with contextlib.suppress(OSError, ValueError):
            done = datetime.fromisoformat(step.made).timestamp() + 1.0  # of whole seconds
            return (self.folder / file).stat().st_mtime > done
        return False

    def _read_json(self, file: str) -> dict[str, Any]:
        try:
            content: dict[str, Any] = parse_json(self.read_text(file))
        except ValueError as error:
            raise DataError(f"{file}: {error}; take the step again") from None
        return content

    def show_error(self, line: str) -> None:
        """Shows one error line in this window; "" removes it."""
        self.state["error"] = line
        self.notify_listeners()

    @contextlib.contextmanager
    def show_errors(self) -> Iterator[None]:
        """Shows the line of an error that is raised inside, and goes on behind."""
        try:
            yield
        except ModelerError as error:
            self.show_error(str(error))

    async def try_viewer(self, question: str, *arguments: Any, kind: str = "") -> Any:
        """Asks the viewer and shows its error; returns None without an answer."""
        with self.show_errors():
            return await self.ask_viewer(question, *arguments, kind=kind)

    def open_screen(self, screen: str) -> None:
        """Shows another screen."""
        self.screen = screen
        self.state["error"] = ""
        if self.room is not None:
            with self.room:  # the button that was pressed may be gone
                ui.navigate.history.push(f"/{screen}")
                ui.run_javascript("window.scrollTo(0, 0)")
        self.redraw()

    def redraw(self) -> None:
        """Draws the screen again."""
        if self._drawing is not None:
            self._drawing.cancel()  # what it would still draw is no longer wanted
        if self.room is not None:
            drawing = self._draw_screen(self.room)
            self._drawing = background_tasks.create(drawing, name=f"draw {self.screen}")
        self.notify_listeners()

    async def _draw_screen(self, room: Element) -> None:
        with room:
            room.clear()
            waiting = ui.spinner(size="2rem").classes("studio-waiting")
            try:
                with ui.column().classes("studio-screen"):
                    await self.hub.screens[self.screen](self)
            except ModelerError as error:
                with ui.column().classes("studio-screen"):
                    ui.label(str(error)).classes("studio-error").props("role=alert")
            finally:
                if not waiting.is_deleted:
                    waiting.delete()

    def notify_listeners(self) -> None:
        """Updates what stands around the screen, such as its head."""
        for listener in self.listeners:
            listener()


READ_ONLY = "this window only reads: another one has the project open; go on there or take over"
