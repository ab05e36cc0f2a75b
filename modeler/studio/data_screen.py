"""The screen "data": logs come in, are mapped, cut into stretches, looked at, and played."""

import asyncio
import dataclasses
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from nicegui import background_tasks, ui
from nicegui.element import Element

from modeler.core.builtin import LOG_ENDINGS
from modeler.core.errors import ModelerError
from modeler.core.files import read_text
from modeler.core.manifest import JointSpec
from modeler.logs import map_from_words
from modeler.studio import commands, timeline
from modeler.studio.chooser import Chooser
from modeler.studio.dropped import drop_zone
from modeler.studio.elements import head, part
from modeler.studio.log_desk import Desk
from modeler.studio.log_mapping import Choice, LogGuess, anybody, choices, said, words_of
from modeler.studio.places import size_text
from modeler.studio.project import ProjectLog, Step
from modeler.studio.studio import Studio
from modeler.studio.timeline import Timeline

_QUIET = 0.5  # s without another file that comes, until the screen is drawn anew
AUTO = "auto"


@dataclass
class Known:
    """A log as far as it could be read; else the line that says why not.

    Attributes:
        guess: of its columns.
        clock: words of `--map` that say what its time is.
        rows: of it.
        ends: first and last time, s.
        units: of its columns, as the viewer answers them.
        size: bytes.
        error: line.
    """

    guess: LogGuess | None = None
    clock: tuple[str, ...] = ()
    rows: int = 0
    ends: tuple[float, float] = (0.0, 1.0)
    units: Mapping[str, str] = field(default_factory=dict)
    size: int = 0
    error: str = ""


async def draw(studio: Studio) -> None:
    """Draws it."""
    await DataScreen(studio).draw()


class DataScreen:
    """One drawing of it.

    Attributes:
        studio: the window.
        joints: of the robot; as many as the logs have positions where there is none yet.
        stated: [log] of the robot file.
        logs: what is known of them, by file.
    """

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self.joints: tuple[JointSpec, ...] = ()
        self.stated: Mapping[str, Any] = {}
        self.logs: dict[str, Known] = {}
        self._rows: dict[str, Element] = {}
        self._lines: dict[str, Timeline] = {}
        self._detail: Element | None = None
        self._desk: Desk | None = None
        studio.kept["data"] = self

    @property
    def live(self) -> bool:
        """False as soon as the screen is drawn anew, or another one is shown."""
        studio = self.studio
        here = studio in studio.hub.studios and studio.screen == "data"
        return here and studio.kept["data"] is self

    def path(self, file: str) -> str:
        """Of a file of the project, wherever it lies."""
        return str(self.studio.folder / file)

    async def draw(self) -> None:
        """Logs first, then the one that is looked at."""
        studio = self.studio
        if studio.project.robot:
            robot = self.path(studio.project.robot)
            self.joints, self.stated = await studio.view("robot_logging", robot)
        head("Data", "Drop logs, say which column is which, and what is fitted and what held out.")
        with ui.row().classes("items-center w-full data-in"):
            label = "Drop logs here, several at once, or press +"
            drop_zone("logs", label, self._came, studio.show_error).classes("data-drop")
            choose = ui.button("Choose where it lies", icon="folder_open")
            choose.on_click(lambda: Chooser(studio, LOG_ENDINGS, self._came))
            choose.props("no-caps outline")
        if not studio.project.logs:
            background_tasks.create(studio.view("forget"), name="start the viewer")
            ui.label(
                "CSV, text, Excel, Parquet, MAT, HDF5, NumPy, MCAP and ROS bags, with the names "
                "and units that your logger wrote."
            ).classes("studio-soft")
            return
        with part("Logs"):
            for log in studio.project.logs:
                with ui.element("div").classes("data-log") as self._rows[log.file]:
                    ui.label(log.file)
                    ui.label("is read").classes("studio-soft")
            with ui.row().classes("items-center gap-6"):
                timeline.legend()
                ui.label(
                    "At first the last 30 % of one log is held out, of several logs the last one."
                ).classes("studio-soft")
        self._detail = ui.column().classes("w-full gap-4")
        for log in studio.project.logs:
            await self._learn(log.file)
            if not self.live:
                return
        self._begin()
        for log in studio.project.logs:
            await self._read(log.file)
            if not self.live:
                return
        self._roles()
        for log in studio.project.logs:
            self.row(log.file)
        readable = [file for file, known in self.logs.items() if not known.error]
        if studio.kept.get("log") not in readable:
            studio.kept["log"] = readable[0] if readable else ""
        if studio.kept["log"]:
            await self.open(studio.kept["log"])
            background_tasks.create(self._check(), name="look at logs")

    # What is known of logs.

    async def _learn(self, file: str) -> None:
        """Looks at the columns of a log."""
        robot = self.studio.project.robot
        try:
            path = Path(self.path(file))
            guess = await self.studio.view("log_guess", str(path), robot and self.path(robot))
            self.logs[file] = Known(guess, size=path.stat().st_size)
            if not robot:
                self.joints = anybody(max(len(self.joints), guess.joints))
        except ModelerError as error:
            self.logs[file] = Known(error=str(error))
        except OSError as error:
            why = f"cannot be read ({error.strerror}); put it back, or take it off the list"
            self.logs[file] = Known(error=f"{file}: {why}")

    async def _read(self, file: str) -> None:
        """Reads a log, unless it is known as it is now."""
        known = self.logs[file]
        if known.guess is None:
            return
        memory: dict[Any, Known] = self.studio.kept.setdefault("known", {})
        try:
            clock = self._clock(known.guess)
            path = Path(self.path(file))
            key = (file, path.stat().st_mtime_ns, known.size, clock)
            if key not in memory:
                facts = await self.studio.view("log_facts", str(path), clock)
                ends = facts.start, facts.end
                memory[key] = Known(known.guess, clock, facts.rows, ends, facts.units, known.size)
            self.logs[file] = dataclasses.replace(memory[key], guess=known.guess)
        except (ModelerError, OSError) as error:
            self.logs[file] = Known(error=str(error))

    def _clock(self, guess: LogGuess) -> tuple[str, ...]:
        """Words that say what the time is, whatever the other columns are."""
        kept = [
            word for word in self.studio.project.mapping if word.startswith(("topic=", "rate="))
        ]
        time = self.chosen(guess).get("time", Choice("time"))
        own = words_of({"time": time}, {"time": Choice("time")}, self.joints)
        return (*kept, *own) if time.column in guess.columns else tuple(kept)

    def chosen(self, guess: LogGuess) -> dict[str, Choice]:
        """What the columns of a log are taken as."""
        words = self.studio.project.mapping
        found = choices(
            said(words, self.stated, self.studio.project.robot), self.joints, guess.columns
        )
        if AUTO in words:
            stated = map_from_words(words).entries(self.joints)
            found |= {own: one for own, one in guess.choices.items() if own not in stated}
        return found

    def under(self, guess: LogGuess) -> dict[str, Choice]:
        """The same without any words."""
        return choices(said((), self.stated, self.studio.project.robot), self.joints, guess.columns)

    def guessed(self, guess: LogGuess) -> tuple[str, ...]:
        """Words of what a log looks like."""
        under = self.under(guess)
        topic = (f"topic={guess.topic}",) if guess.topic else ()
        return (*topic, *words_of({**under, **guess.choices}, under, self.joints))

    def _begin(self) -> None:
        """The mapping, while it is only a guess: one of all logs, or each by its own."""
        project = self.studio.project
        guesses = [known.guess for known in self.logs.values() if known.guess is not None]
        try:
            every = dict.fromkeys(self.guessed(guess) for guess in guesses)
        except ModelerError as error:
            self.studio.show_error(str(error))
            return
        if every and project.mapping in ((), (AUTO,), *every) and not self.studio.read_only:
            mapping = next(iter(every)) if len(every) == 1 else (AUTO,)
            if mapping != project.mapping:
                self.studio.change(mapping=mapping)

    def _roles(self) -> None:
        """What logs that came are for."""
        logs = self.studio.project.logs
        ends = {file: known.ends for file, known in self.logs.items() if not known.error}
        new = [log for log in logs if not (log.train or log.test) and log.file in ends]
        if not new or self.studio.read_only:
            return
        old = tuple(log for log in logs if log.train or log.test)
        if old == timeline.by_default(old, ends):
            self.studio.change(logs=timeline.by_default(logs, ends))
        else:
            made = (timeline.all_training(log) if log in new else log for log in logs)
            self.studio.change(logs=tuple(made))

    # Logs come and go.

    def _came(self, files: list[str]) -> None:
        """Files that were dropped or chosen; many come one after the other, in any order."""
        kept = self.studio.kept
        before = [log for log in self.studio.project.logs if log.file not in kept.get("coming", ())]
        there = {log.file for log in before}
        coming = sorted({*kept.get("coming", ()), *files} - there)
        new = tuple(ProjectLog(file) for file in coming)
        if not new or not self.studio.change(logs=(*before, *new)):
            return
        kept["coming"] = tuple(coming)

        async def drawn() -> None:
            await asyncio.sleep(_QUIET)
            if kept["coming"] == tuple(coming):
                kept["coming"] = ()
                self.studio.redraw()

        background_tasks.create(drawn(), name="logs came")

    def _remove(self, file: str) -> None:
        logs = tuple(log for log in self.studio.project.logs if log.file != file)
        self.studio.change(redraw=True, logs=logs)

    def row(self, file: str) -> None:
        """One log in the list."""
        log, known, place = self.log(file), self.logs[file], self._rows[file]
        place.clear()
        with place:
            name = ui.button(file, on_click=lambda: self.open(file)).props(
                "flat dense no-caps align=left"
            )
            name.classes("data-name")
            if known.error:
                ui.label(known.error).classes("studio-error data-told").props("role=alert")
            else:
                seconds = known.ends[1] - known.ends[0]
                rate = (known.rows - 1) / seconds if seconds > 0.0 else float("nan")
                ui.label(
                    f"{known.rows} rows, {rate:.4g} Hz, {seconds:.4g} s, {size_text(known.size)}"
                ).classes("studio-soft data-facts")
                line = self._lines[file] = Timeline(file, known.ends, active=False)
                line.renew(log, self.result(file).get("marks", ()))
                ui.label(timeline.told(log)).classes("data-told")
                count = len(self.result(file).get("doubts", ()))
                doubts = f"{count} doubt{'s' * (count > 1)}" if count else "no doubts"
                doubts = doubts if self.checked(file) else ""
                ui.label(doubts).classes("studio-soft")
            off = ui.button(icon="close", on_click=lambda: self._remove(file)).props(
                "flat dense round"
            )
            off.tooltip("takes it off the list; the file stays")
            off._props["aria-label"] = f"take {file} off the list"

    def log(self, file: str) -> ProjectLog:
        """As the project has it."""
        return next(log for log in self.studio.project.logs if log.file == file)

    def renew(self, log: ProjectLog) -> None:
        """Another log in place of the one of that file."""
        logs = tuple(log if own.file == log.file else own for own in self.studio.project.logs)
        if self.studio.change(logs=logs):
            self.row(log.file)

    async def open(self, file: str) -> None:
        """Looks at a log."""
        if self.logs[file].error or self._detail is None:
            return
        self.studio.kept["log"] = file
        self._detail.clear()
        with self._detail:
            self._desk = Desk(self, file)
            await self._desk.draw()

    # What `modeler log` says.

    def checked(self, file: str) -> Step | None:
        """The last look at a log."""
        steps = self.studio.project.steps
        return next((s for s in reversed(steps) if s.kind == "log" and s.words[1] == file), None)

    def result(self, file: str) -> dict[str, Any]:
        """What it said; nothing before there is one."""
        step = self.checked(file)
        try:
            return dict(json.loads(read_text(self.studio.folder / step.result))) if step else {}
        except (OSError, ValueError):
            return {}

    async def _check(self) -> None:
        """Runs `modeler log` for logs that were never looked at, and for the one that is open."""
        studio, hub = self.studio, self.studio.hub
        failed: set[tuple[str, ...]] = studio.kept.setdefault("failed", set())

        def leave() -> None:  # nobody waits for this
            if not self.live and hub.running is not None and hub.gives_way:
                hub.running.cancel()

        while self.live and hub.running is None and not studio.read_only:
            wanted = [
                commands.look(studio.project, file) for file in self.logs if self._unseen(file)
            ]
            left = [asked for asked in wanted if asked.words not in failed]
            if not left:
                return
            asked = left[0]
            studio.listeners.append(leave)
            try:
                step = await hub.run(asked, keep=False, aside=True)
            except ModelerError as error:
                if str(error).endswith(": cancelled") or not self.live:
                    return
                failed.add(asked.words)
                studio.show_error(str(error))
                continue
            finally:
                studio.listeners.remove(leave)
            studio.change(steps=(*studio.project.steps, step))
            if self.live:
                self.row(asked.words[1])
                if self._desk is not None and self._desk.file == asked.words[1]:
                    self._desk.judged()

    def _unseen(self, file: str) -> bool:
        if self.logs[file].error:
            return False
        step = self.checked(file)
        stale = step is not None and step.words != commands.look(self.studio.project, file).words
        return step is None or (stale and file == self.studio.kept.get("log"))

    def look_again(self) -> None:
        """After the mapping was changed."""
        background_tasks.create(self._check(), name="look at logs")
