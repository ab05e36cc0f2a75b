"""The screen "data": logs come in, are mapped, cut into segments, looked at, and played."""

import asyncio
from dataclasses import replace
from functools import partial
from pathlib import Path

from nicegui import background_tasks, ui
from nicegui.element import Element

from modeler.api.front_end import LOG_ENDINGS, ModelerError
from modeler.studio import commands
from modeler.studio.elements import add_button, add_card, draw_error, draw_head, draw_note
from modeler.studio.file_inputs import add_drop_zone, choose_files
from modeler.studio.log_view import LogView
from modeler.studio.places import format_size
from modeler.studio.project import ProjectLog
from modeler.studio.project_logs import AUTO, ProjectLogs
from modeler.studio.studio import Studio
from modeler.studio.tasks import Task
from modeler.studio.thresholds import THRESHOLDS
from modeler.studio.timeline import ALL, Timeline, assign_default_roles, describe_roles, draw_legend

_FORMATS = (
    "CSV, text, Excel, Parquet, MAT, HDF5, NumPy, MCAP and ROS bags, with the names and units that "
    "your logger wrote."
)
_FIRST = (
    "At first the last 30 % of one log is held out, of several that come together the last one; "
    "a log that comes later is training, and leaves the others as they are."
)


async def draw(studio: Studio) -> None:
    """Draws the screen of the logs."""
    await DataScreen(studio).draw()


class DataScreen(ProjectLogs):
    """One drawing of the screen of the logs.

    Attributes:
        view: of the log that is looked at.
    """

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self._rows: dict[str, Element] = {}
        self.view: LogView | None = None
        studio.state["data"] = self

    @property
    def is_live(self) -> bool:
        """Returns False when this screen was replaced by a newer one or another."""
        studio = self.studio
        here = studio in studio.hub.studios and studio.screen == "data"
        return here and studio.state["data"] is self

    async def draw(self) -> None:
        """Draws the logs, then the one that is open."""
        studio = self.studio
        draw_head(
            "Data", "Drop logs, say which column is which, and what is fitted and what held out."
        )
        with ui.row().classes("items-center w-full data-in"):
            label = "Drop logs here, several at once, or press +"
            add_drop_zone("logs", label, self._add_files, studio.show_error).classes("data-drop")
            browse = partial(choose_files, studio, LOG_ENDINGS, self._add_files)
            add_button("Browse (no copy)", browse, "outline", icon="folder_open")
        if not studio.project.logs:
            background_tasks.create(studio.ask_viewer("forget"), name="start the viewer")
            draw_note(_FORMATS)
            return
        with add_card("Logs"):
            for log in studio.project.logs:
                with ui.element("div").classes("data-log") as self._rows[log.file]:
                    ui.label(log.file)
                    draw_note("Loading")
            with ui.row().classes("items-center gap-4"):
                draw_legend()
                draw_note(_FIRST)
        self._detail = ui.column().classes("w-full gap-4")
        if studio.project.robot:
            robot = self.resolve_path(studio.project.robot)
            self.joints, self.stated = await studio.ask_viewer("robot_logging", robot)
        for step in (self.learn_columns, self.read_time):
            for log in studio.project.logs:
                await step(log.file)
                if not self.is_live:
                    return
            self._settle_mapping()
        for log in studio.project.logs:
            self.draw_row(log.file)
        readable = [file for file, known in self.logs.items() if not known.error]
        if readable:
            last = studio.state.get("log")
            await self.open_log(last if last in readable else readable[0])
            self.begin_inspection()

    def _settle_mapping(self) -> None:
        """The mapping, while it is only a guess; roles of logs that came and can be read.

        What was set for the logs that were there stays.
        """
        project, ends = self.studio.project, {}
        if self.studio.is_read_only:
            return
        guesses = [known.guess for known in self.logs.values() if known.guess is not None]
        try:
            every = list(dict.fromkeys(map(self.build_guess_words, guesses)))
        except ModelerError as error:  # a name that no word can say
            self.studio.show_error(str(error))
            every = []
        mapping = every[0] if len(every) == 1 else (AUTO,)
        guessed = not project.mapped and project.mapping in ((), (AUTO,), *every)
        if every and guessed and mapping != project.mapping:
            self.studio.change_project(mapping=mapping)
        ends = {file: known.ends for file, known in self.logs.items() if known.rows}
        new = [log for log in project.logs if not (log.train or log.test) and log.file in ends]
        if new:
            log_roles = assign_default_roles(project.logs, ends)
            if len(new) < len(project.logs):
                every_log = project.logs
                log_roles = tuple(replace(x, train=ALL) if x in new else x for x in every_log)
            self.studio.change_project(logs=log_roles)

    # Logs come and go.

    def _add_files(self, files: list[str]) -> None:
        """Files that were dropped or chosen; many come one after the other, in any order."""
        state = self.studio.state
        coming = state.get("coming", ())
        before = [log for log in self.studio.project.logs if log.file not in coming]
        coming = tuple(sorted({*coming, *files} - {log.file for log in before}))
        if not self.studio.change_project(logs=(*before, *map(ProjectLog, coming))):
            return
        state["coming"] = coming

        async def redraw_later() -> None:
            await asyncio.sleep(THRESHOLDS.redraw_delay)
            if state["coming"] == coming:
                state["coming"] = ()
                self.studio.redraw()

        background_tasks.create(redraw_later(), name="logs came")

    def _remove_log(self, file: str) -> None:
        logs = tuple(log for log in self.studio.project.logs if log.file != file)
        self.studio.change_project(redraw=True, logs=logs)

    def draw_row(self, file: str) -> None:
        """Draws one log of the list."""
        known, place, result = self.logs[file], self._rows[file], self.read_result(file)
        place.clear()
        with place:
            short = Path(file).name if Path(file).is_absolute() else file
            name = add_button(short, lambda: self.open_log(file), "flat dense align=left")
            name.tooltip(self.resolve_path(file)).classes("data-name")
            if known.error:
                draw_error(known.error)
            else:
                span = known.ends[1] - known.ends[0]
                rate = f"{(known.rows - 1) / span:.4g} Hz" if span else "no time"
                facts = f"{known.rows} rows, {rate}, {span:.4g} s, {format_size(known.size)}"
                draw_note(facts)
                line = Timeline(file, known.ends, active=False)
                line.update_log(self.get_log(file), result.get("marks", ()))
                ui.label(describe_roles(self.get_log(file)))
                count = len(result.get("warnings", ()))
                doubts = f"{count or 'no'} warning{'s' * (count != 1)}" if result else ""
                draw_note(doubts)
            off = ui.button(icon="close", on_click=lambda: self._remove_log(file))
            off.props("flat dense round").tooltip("takes it off the list; the file stays")
            off._props["aria-label"] = f"take {file} off the list"

    def replace_log(self, log: ProjectLog) -> None:
        """Replaces the log of the same file in the project."""
        logs = tuple(log if log.file == x.file else x for x in self.studio.project.logs)
        if self.studio.change_project(logs=logs):
            self.draw_row(log.file)

    async def open_log(self, file: str) -> None:
        """Opens a log below the list, to look at it."""
        if not self.logs[file].error:
            self.studio.state["log"] = file
            self._detail.clear()
            with self._detail:
                self.view = view = LogView(self, file, self.replace_log, self.begin_inspection)
                await view.draw()

    # What `modeler log` says.

    def begin_inspection(self) -> None:
        """Runs `modeler log` for logs that were never looked at, and for the one that is open."""
        background_tasks.create(self._inspect_logs(), name="look at logs")

    async def _inspect_logs(self) -> None:
        studio, hub = self.studio, self.studio.hub
        failed = studio.state.setdefault("failed", set())

        def cancel_if_left() -> None:  # nobody waits for this
            if not self.is_live and hub.running is not None and hub.gives_way:
                hub.running.cancel()

        while self.is_live and not studio.is_read_only:
            if hub.running is not None:  # maybe what the screen before this one requested
                await asyncio.sleep(0.1)
                continue
            every = (commands.inspect_log(studio.project, file) for file in self.logs)
            left = [task for task in every if task not in failed and self._needs_inspection(task)]
            if not left:
                return
            studio.listeners.append(cancel_if_left)
            try:
                step = await hub.run(left[0], keep=False, aside=True)
                old = self.find_last_inspection(step.task.file)
                steps = [each for each in studio.project.steps if each is not old]
                studio.change_project(steps=(*steps, step))
            except ModelerError as error:
                if str(error).endswith(": cancelled") or not self.is_live:
                    return
                failed.add(left[0])
                studio.show_error(str(error))
            finally:
                studio.listeners.remove(cancel_if_left)
            if self.is_live:
                self.draw_row(left[0].file)
                if self.view is not None and self.view.file == left[0].file:
                    self.view.draw_findings()

    def _needs_inspection(self, task: Task) -> bool:
        file, step = task.file, self.find_last_inspection(task.file)
        if self.logs[file].error or step is None or self.studio.is_newer(file, step):
            return not self.logs[file].error
        return step.task != task and file == self.studio.state["log"]
