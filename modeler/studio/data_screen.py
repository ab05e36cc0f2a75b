"""The screen "data": logs come in, are mapped, cut into stretches, looked at, and played."""

import asyncio
import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from nicegui import background_tasks, ui
from nicegui.element import Element

from modeler.core.builtin import LOG_ENDINGS
from modeler.core.errors import ModelerError
from modeler.core.files import read_text
from modeler.core.json import entries
from modeler.core.manifest import JointSpec
from modeler.logs import map_from_words
from modeler.studio import commands
from modeler.studio.chooser import Chooser
from modeler.studio.dropped import drop_zone
from modeler.studio.elements import head, part
from modeler.studio.log_desk import Desk
from modeler.studio.log_mapping import Choice, LogGuess, anybody, choices, said, words_of
from modeler.studio.places import size_text
from modeler.studio.project import ProjectLog, Step
from modeler.studio.studio import Studio
from modeler.studio.timeline import ALL, Timeline, by_default, legend, told

_QUIET = 0.5  # s without another file that comes, until the screen is drawn anew
AUTO = "auto"
_FORMATS = (
    "CSV, text, Excel, Parquet, MAT, HDF5, NumPy, MCAP and ROS bags, with the names and units that "
    "your logger wrote."
)
_FIRST = "At first the last 30 % of one log is held out, of several logs the last one."


@dataclass(frozen=True)
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
        desk: of the log that is looked at.
    """

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self.joints: tuple[JointSpec, ...] = ()
        self.stated: Mapping[str, Any] = {}
        self.logs: dict[str, Known] = {}
        self._rows: dict[str, Element] = {}
        self.desk: Desk | None = None
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
        head("Data", "Drop logs, say which column is which, and what is fitted and what held out.")
        with ui.row().classes("items-center w-full data-in"):
            label = "Drop logs here, several at once, or press +"
            drop_zone("logs", label, self._came, studio.show_error).classes("data-drop")
            choose = ui.button("Choose where it lies", icon="folder_open").props("no-caps outline")
            choose.on_click(lambda: Chooser(studio, LOG_ENDINGS, self._came))
        if not studio.project.logs:
            background_tasks.create(studio.view("forget"), name="start the viewer")
            ui.label(_FORMATS).classes("studio-soft")
            return
        with part("Logs"):
            for log in studio.project.logs:
                with ui.element("div").classes("data-log") as self._rows[log.file]:
                    ui.label(log.file)
                    ui.label("is read").classes("studio-soft")
            with ui.row().classes("items-center gap-4"):
                legend()
                ui.label(_FIRST).classes("studio-soft")
        self._detail = ui.column().classes("w-full gap-4")
        if studio.project.robot:
            robot = self.path(studio.project.robot)
            self.joints, self.stated = await studio.view("robot_logging", robot)
        for step in (self._learn, self._read):
            for log in studio.project.logs:
                await step(log.file)
                if not self.live:
                    return
            self._settle()
        for log in studio.project.logs:
            self.row(log.file)
        readable = [file for file, known in self.logs.items() if not known.error]
        if readable:
            await self.open(
                studio.kept["log"] if studio.kept.get("log") in readable else readable[0]
            )
            self.look()

    # What is known of logs.

    async def _learn(self, file: str) -> None:
        """Looks at the columns of a log."""
        robot, place = self.studio.project.robot, self.path(file)
        try:
            guess = await self.studio.view("log_guess", place, robot and self.path(robot))
            self.logs[file] = Known(guess, size=Path(place).stat().st_size)
            if not robot:
                self.joints = anybody(max(len(self.joints), guess.joints))
        except (ModelerError, OSError) as error:
            self.logs[file] = Known(error=str(error))

    async def _read(self, file: str) -> None:
        """Reads its time, as the mapping says it."""
        known = self.logs[file]
        if known.guess is None:
            return
        try:
            time = self.chosen(known.guess).get("time", Choice("time"))
            own = words_of({"time": time}, {"time": Choice("time")}, self.joints)
            clock = (*self.settings, *own) if time.column in known.guess.columns else self.settings
            clock = tuple(word for word in clock if word != AUTO)
            facts = await self.studio.view("log_facts", self.path(file), clock)
            found = {"ends": (facts.start, facts.end), **entries(facts, "rows units")}
            self.logs[file] = replace(known, clock=clock, **found)
        except ModelerError as error:
            self.logs[file] = Known(error=str(error))

    @property
    def settings(self) -> tuple[str, ...]:
        """Words of the mapping that are about no column."""
        kinds = (AUTO, "topic=", "rate=", "names=")
        return tuple(word for word in self.studio.project.mapping if word.startswith(kinds))

    def guess(self, file: str) -> LogGuess:
        """Of a log that can be read."""
        guess = self.logs[file].guess
        assert guess is not None
        return guess

    def chosen(self, guess: LogGuess) -> dict[str, Choice]:
        """What the columns of a log are taken as."""
        words = self.studio.project.mapping
        own = map_from_words(words).entries(self.joints)
        found = self._choices(words, guess)
        under = guess.choices if AUTO in words else {}
        return found | {name: one for name, one in under.items() if name not in own}

    def under(self, guess: LogGuess) -> dict[str, Choice]:
        """The same without words about columns."""
        found = self._choices((), guess)
        return {**found, **(guess.choices if AUTO in self.settings else {})}

    def _choices(self, words: tuple[str, ...], guess: LogGuess) -> dict[str, Choice]:
        names = said(words, self.stated, self.studio.project.robot)
        return choices(names, self.joints, guess.columns)

    def _guessed(self, guess: LogGuess) -> tuple[str, ...]:
        """Words of what a log looks like."""
        under = self._choices((), guess)
        topic = (f"topic={guess.topic}",) if guess.topic else ()
        return (*topic, *words_of({**under, **guess.choices}, under, self.joints))

    def is_guess(self, guess: LogGuess) -> bool:
        """Whether a log is taken as what it looks like."""
        own = self.studio.project.mapping in ((AUTO,), self._guessed(guess))
        return own and bool(guess.choices)

    def guess_each(self) -> None:
        """Every log by its own guess."""
        self.studio.change(redraw=True, mapping=(AUTO,))

    def _settle(self) -> None:
        """The mapping, while it is only a guess; roles of logs that came and can be read."""
        project, ends = self.studio.project, {}
        if self.studio.read_only:
            return
        guesses = [known.guess for known in self.logs.values() if known.guess is not None]
        try:
            every = list(dict.fromkeys(map(self._guessed, guesses)))
        except ModelerError as error:  # a name that no word can say
            self.studio.show_error(str(error))
            every = []
        mapping = every[0] if len(every) == 1 else (AUTO,)
        if every and project.mapping in ((), (AUTO,), *every) and mapping != project.mapping:
            self.studio.change(mapping=mapping)
        ends = {file: known.ends for file, known in self.logs.items() if known.rows}
        new = [log for log in project.logs if not (log.train or log.test) and log.file in ends]
        if new:
            old = tuple(log for log in project.logs if log.train or log.test)
            usual = by_default(project.logs, ends)
            if old != by_default(old, ends):
                usual = tuple(
                    replace(log, train=ALL) if log in new else log for log in project.logs
                )
            self.studio.change(logs=usual)

    # Logs come and go.

    def _came(self, files: list[str]) -> None:
        """Files that were dropped or chosen; many come one after the other, in any order."""
        kept = self.studio.kept
        coming = kept.get("coming", ())
        before = [log for log in self.studio.project.logs if log.file not in coming]
        coming = tuple(sorted({*coming, *files} - {log.file for log in before}))
        if not self.studio.change(logs=(*before, *map(ProjectLog, coming))):
            return
        kept["coming"] = coming

        async def drawn() -> None:
            await asyncio.sleep(_QUIET)
            if kept["coming"] == coming:
                kept["coming"] = ()
                self.studio.redraw()

        background_tasks.create(drawn(), name="logs came")

    def _remove(self, file: str) -> None:
        logs = tuple(log for log in self.studio.project.logs if log.file != file)
        self.studio.change(redraw=True, logs=logs)

    def row(self, file: str) -> None:
        """One log in the list."""
        known, place, result = self.logs[file], self._rows[file], self.result(file)
        place.clear()
        with place:
            name = ui.button(file, on_click=lambda: self.open(file)).classes("data-name")
            name.props("flat dense no-caps align=left")
            if known.error:
                ui.label(known.error).classes("studio-error").props("role=alert")
            else:
                span = known.ends[1] - known.ends[0]
                rate = f"{(known.rows - 1) / span:.4g} Hz" if span else "no time"
                facts = f"{known.rows} rows, {rate}, {span:.4g} s, {size_text(known.size)}"
                ui.label(facts).classes("studio-soft")
                line = Timeline(file, known.ends, active=False)
                line.renew(self.log(file), result.get("marks", ()))
                ui.label(told(self.log(file)))
                count = len(result.get("doubts", ()))
                doubts = f"{count or 'no'} doubt{'s' * (count != 1)}" if result else ""
                ui.label(doubts).classes("studio-soft")
            off = ui.button(icon="close", on_click=lambda: self._remove(file))
            off.props("flat dense round").tooltip("takes it off the list; the file stays")
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
        if not self.logs[file].error:
            self.studio.kept["log"] = file
            self._detail.clear()
            with self._detail:
                self.desk = desk = Desk(self, file)
                await desk.draw()

    # What `modeler log` says.

    def _checked(self, file: str) -> Step | None:
        """The last look at a log."""
        steps = self.studio.project.steps
        return next((s for s in reversed(steps) if s.kind == "log" and s.words[1] == file), None)

    def result(self, file: str) -> dict[str, Any]:
        """What it said; nothing before there is one."""
        step = self._checked(file)
        try:
            return dict(json.loads(read_text(self.studio.folder / step.result))) if step else {}
        except (OSError, ValueError):
            return {}

    def look(self) -> None:
        """Runs `modeler log` for logs that were never looked at, and for the one that is open."""
        background_tasks.create(self._look(), name="look at logs")

    async def _look(self) -> None:
        studio, hub = self.studio, self.studio.hub
        failed = studio.kept.setdefault("failed", set())

        def leave() -> None:  # nobody waits for this
            if not self.live and hub.running is not None and hub.gives_way:
                hub.running.cancel()

        while self.live and hub.running is None and not studio.read_only:
            every = (commands.look(studio.project, file) for file in self.logs)
            left = [a for a in every if a.words not in failed and self._unseen(a.words)]
            if not left:
                return
            studio.listeners.append(leave)
            try:
                step = await hub.run(left[0], keep=False, aside=True)
                studio.change(steps=(*studio.project.steps, step))
            except ModelerError as error:
                if str(error).endswith(": cancelled") or not self.live:
                    return
                failed.add(left[0].words)
                studio.show_error(str(error))
            finally:
                studio.listeners.remove(leave)
            if self.live:
                self.row(left[0].words[1])
                if self.desk is not None and self.desk.file == left[0].words[1]:
                    self.desk.judged()

    def _unseen(self, words: tuple[str, ...]) -> bool:
        file, step = words[1], self._checked(words[1])
        if self.logs[file].error or step is None or self.studio.newer(file, step):
            return not self.logs[file].error
        return step.words != words and file == self.studio.kept["log"]
