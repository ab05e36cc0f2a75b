"""The screen "data": logs come in, are mapped, cut into stretches, looked at, and played."""

import asyncio
from dataclasses import replace
from pathlib import Path

from nicegui import background_tasks, ui
from nicegui.element import Element

from modeler.core.builtin import LOG_ENDINGS
from modeler.core.errors import ModelerError
from modeler.studio import commands
from modeler.studio.chooser import choose
from modeler.studio.dropped import drop_zone
from modeler.studio.elements import head, part
from modeler.studio.log_view import LogView
from modeler.studio.places import size_text
from modeler.studio.project import ProjectLog
from modeler.studio.project_logs import AUTO, ProjectLogs
from modeler.studio.studio import Studio
from modeler.studio.tasks import Task
from modeler.studio.timeline import ALL, Timeline, by_default, legend, told

_QUIET = 0.5  # s without another file that comes, until the screen is drawn anew
_FORMATS = (
    "CSV, text, Excel, Parquet, MAT, HDF5, NumPy, MCAP and ROS bags, with the names and units that "
    "your logger wrote."
)
_FIRST = (
    "At first the last 30 % of one log is held out, of several that come together the last one; "
    "a log that comes later is training, and leaves the others as they are."
)


async def draw(studio: Studio) -> None:
    """Draws it."""
    await DataScreen(studio).draw()


class DataScreen(ProjectLogs):
    """One drawing of it.

    Attributes:
        view: of the log that is looked at.
    """

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self._rows: dict[str, Element] = {}
        self.view: LogView | None = None
        studio.kept["data"] = self

    @property
    def live(self) -> bool:
        """False as soon as the screen is drawn anew, or another one is shown."""
        studio = self.studio
        here = studio in studio.hub.studios and studio.screen == "data"
        return here and studio.kept["data"] is self

    async def draw(self) -> None:
        """Logs first, then the one that is looked at."""
        studio = self.studio
        head("Data", "Drop logs, say which column is which, and what is fitted and what held out.")
        with ui.row().classes("items-center w-full data-in"):
            label = "Drop logs here, several at once, or press +"
            drop_zone("logs", label, self._came, studio.show_error).classes("data-drop")
            pick = ui.button("Choose where it lies", icon="folder_open").props("no-caps outline")
            pick.on_click(lambda: choose(studio, LOG_ENDINGS, self._came))
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
        for step in (self.learn, self.read):
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

    def _settle(self) -> None:
        """The mapping, while it is only a guess; roles of logs that came and can be read.

        What was set for the logs that were there stays.
        """
        project, ends = self.studio.project, {}
        if self.studio.read_only:
            return
        guesses = [known.guess for known in self.logs.values() if known.guess is not None]
        try:
            every = list(dict.fromkeys(map(self.guessed, guesses)))
        except ModelerError as error:  # a name that no word can say
            self.studio.show_error(str(error))
            every = []
        mapping = every[0] if len(every) == 1 else (AUTO,)
        guessed = not project.mapped and project.mapping in ((), (AUTO,), *every)
        if every and guessed and mapping != project.mapping:
            self.studio.change(mapping=mapping)
        ends = {file: known.ends for file, known in self.logs.items() if known.rows}
        new = [log for log in project.logs if not (log.train or log.test) and log.file in ends]
        if new:
            usual = by_default(project.logs, ends)
            if len(new) < len(project.logs):
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
            short = Path(file).name if Path(file).is_absolute() else file
            name = ui.button(short, on_click=lambda: self.open(file)).tooltip(self.path(file))
            name.props("flat dense no-caps align=left").classes("data-name")
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
                self.view = view = LogView(self, file, self.renew, self.look)
                await view.draw()

    # What `modeler log` says.

    def look(self) -> None:
        """Runs `modeler log` for logs that were never looked at, and for the one that is open."""
        background_tasks.create(self._look(), name="look at logs")

    async def _look(self) -> None:
        studio, hub = self.studio, self.studio.hub
        failed = studio.kept.setdefault("failed", set())

        def leave() -> None:  # nobody waits for this
            if not self.live and hub.running is not None and hub.gives_way:
                hub.running.cancel()

        while self.live and not studio.read_only:
            if hub.running is not None:  # maybe what the screen before this one asked for
                await asyncio.sleep(0.1)
                continue
            every = (commands.look(studio.project, file) for file in self.logs)
            left = [task for task in every if task not in failed and self._unseen(task)]
            if not left:
                return
            studio.listeners.append(leave)
            try:
                step = await hub.run(left[0], keep=False, aside=True)
                old = self.checked(step.task.file)
                steps = [own for own in studio.project.steps if own is not old]
                studio.change(steps=(*steps, step))
            except ModelerError as error:
                if str(error).endswith(": cancelled") or not self.live:
                    return
                failed.add(left[0])
                studio.show_error(str(error))
            finally:
                studio.listeners.remove(leave)
            if self.live:
                self.row(left[0].file)
                if self.view is not None and self.view.file == left[0].file:
                    self.view.judged()

    def _unseen(self, task: Task) -> bool:
        file, step = task.file, self.checked(task.file)
        if self.logs[file].error or step is None or self.studio.newer(file, step):
            return not self.logs[file].error
        return step.task != task and file == self.studio.kept["log"]
