"""The screens of residuals of one model, and of several logs and models."""

import math
from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from nicegui import ui

from modeler.api.front_end import format_percent, read_pictures
from modeler.studio import commands, figures
from modeler.studio.elements import (
    RobotFrame,
    add_card,
    add_robot_frame,
    add_run_button,
    draw_head,
    draw_lines,
    draw_note,
    draw_residual_state,
    draw_stale_warnings,
    draw_table,
    explain_missing,
    explain_missing_model,
)
from modeler.studio.project import ProjectLog
from modeler.studio.studio import Studio
from modeler.studio.tasks import LogPart, Step, Task, TimeRange
from modeler.studio.timeline import add_player

if TYPE_CHECKING:  # who only draws loads nothing that computes
    from modeler.api.model_on_logs import Verdict

_TIME = "fails"  # that all pictures of the screen share
_ROLES = {"test": "held out", "train": "training"}


async def draw_fails(studio: Studio) -> None:
    """Draws the screen of where the model fails."""
    draw_head(
        "Where it fails",
        "Measured against predicted torque, and what the rest follows. Drag in a picture to zoom, "
        "double click for all of it.",
    )
    project = studio.project
    if not project.model_file:
        return explain_missing_model(studio)
    roles = {role: name for role, name in _ROLES.items() if project.collect_words(role)}
    if not roles:
        line = "No log has a training or held-out segment: choose some first."
        return explain_missing(studio, line, "Data", "data")
    state = studio.state.setdefault("fails", {})
    if state.get("role") not in roles:
        state["role"] = next(iter(roles))
    logs = project.collect_parts(state["role"])
    with ui.row().classes("items-center w-full"):

        def store_role(event: Any) -> None:
            state["role"] = event.value
            studio.redraw()

        ui.toggle(roles, value=state["role"], on_change=store_role).props("no-caps")
        with ui.element("div").classes("col"):
            add_run_button(studio, "Compare", lambda: commands.compare(project, logs), small=True)
    draw_stale_warnings(studio)
    viewer_words = commands.build_viewer_words(project, logs)
    with ui.row().classes("items-center") as waiting:
        ui.spinner(size="sm")
        ui.label("predicting ...")
    try:
        verdict: Verdict = await studio.ask_viewer("verdict", project.model_file, viewer_words)
    finally:
        waiting.delete()
    if verdict.joints:
        await _FailureView(studio, project.model_file, viewer_words, verdict, state).draw()
    draw_lines(verdict.unjudged)
    step = project.find_step_about("compare")
    if step is not None and step.task == commands.compare(project, logs):
        expansion = ui.expansion("All that the command drew: spectra, waves per turn, shares")
        expansion.classes("w-full").on_value_change(lambda: _draw_more(studio, expansion, step))
    return None


def _draw_more(studio: Studio, place: ui.expansion, step: Step) -> None:
    """Draws what `modeler compare` drew, where that was opened."""
    place.clear()
    with studio.show_errors(), place:
        for picture in read_pictures(studio.folder / step.pictures_file) if place.value else ():
            if not picture.name.endswith("_time"):  # which stands above
                figures.draw_picture(picture)


class _FailureView:
    """The screen of one model on logs; `state` is what was chosen last in this window."""

    def __init__(
        self, studio: Studio, model: str, logs: list[str], verdict: "Verdict", state: dict[str, Any]
    ) -> None:
        self.studio, self.model, self.logs = studio, model, logs
        self.verdict, self.state = verdict, state
        if state.get("joint") not in verdict.joints:
            errors = [-1.0 if math.isnan(error) else error for error in verdict.errors]
            state["joint"] = verdict.joints[errors.index(max(errors))]
        self.rows: dict[str, ui.element] = {}
        self.robot: RobotFrame | None = None

    async def draw(self) -> None:
        """Draws the verdict, the torques, the map and the residual."""
        with ui.column().classes("w-full gap-4") as self.body:
            await self._draw_parts()
        await self._draw_joint()

    async def _draw_parts(self) -> None:
        with ui.row().classes("w-full fails-top"):
            with add_card("Verdict").classes("fails-said"):
                self._draw_verdict()
            self.robot = await self._draw_robot()
        with add_card("Measured and predicted"):
            time, positions = await self.studio.ask_viewer("poses", self.model, self.logs)
            line = add_player(_TIME, (self.verdict.start, self.verdict.end))
            line.frame = "" if self.robot is None else self.robot.element_id
            line.show_motion(time, positions)
            every = ui.switch("all joints", value=self.state.get("every", False))
            every.on_value_change(self._make_store("every", self._draw_torques))
            self.torques = ui.column().classes("w-full gap-2")
        with add_card("What the residual follows"), ui.row().classes("w-full fails-halves"):
            with ui.column().classes("fails-half"):
                where = await self.studio.ask_viewer("where_picture", self.model, self.logs)
                heat = where.panels[0][0].series[0]
                if np.isnan(heat.values).all():
                    ui.label("These segments have too few samples to show what it follows.")
                else:
                    figures.draw_picture(where).on("plotly_click", self._select_cell)
                self._select_strongest_channel(heat)
            with ui.column().classes("fails-half"):
                choice, chosen = dict(self.verdict.channels), self.state["channel"]
                self.channel = ui.select(choice, value=chosen, label="residual over")
                self.channel.on_value_change(self._make_store("channel", self._draw_residual))
                self.channel.classes("w-64")
                self.residual = ui.column().classes("w-full")

    async def _draw_robot(self) -> RobotFrame | None:
        """In 3-D, its joints to be clicked; None where it cannot be drawn."""
        with self.studio.show_errors(), ui.card().classes("studio-card fails-robot"):
            frame = await add_robot_frame(self.studio, "100%", alone=True)
            frame.connect_joint(self._select_joint)
            return frame
        return None

    def _draw_verdict(self) -> None:
        verdict = self.verdict
        rows = zip(verdict.joints, verdict.errors, verdict.kinds, verdict.sentences, strict=True)
        with ui.element("div").classes("fails-verdict").props("role=listbox aria-label=joints"):
            for joint, error, kind, sentence in rows:
                row = ui.element("button").classes("fails-joint").props("type=button role=option")
                row.props["data-rows"] = joint
                row.on("click", lambda _, name=joint: self._select_joint(name))
                self.rows[joint] = row
                with row:
                    draw_residual_state(joint, error, kind)
                    ui.label(sentence).classes("fails-sentence")

    async def _select_joint(self, joint: str, channel: str | None = None) -> None:
        """Another joint, and possibly another channel, is looked at."""
        if joint not in self.verdict.joints:
            return
        self.state["joint"] = joint
        if channel is not None and channel != self.state["channel"]:
            self.state["channel"] = channel
            self.channel.set_value(channel)  # which draws the residual anew
        await self._draw_joint()

    def _select_strongest_channel(self, heat: Any) -> None:
        """At first the channel is looked at that the joint follows most."""
        if self.state.get("channel") not in heat.columns:
            shares = np.nan_to_num(heat.values[heat.rows.index(self.state["joint"])], nan=-1.0)
            self.state["channel"] = heat.columns[int(shares.argmax())]

    async def _select_cell(self, event: Any) -> None:
        point = event.args["points"][0]
        await self._select_joint(point["y"], point["x"])

    def _make_store(self, name: str, redraw: Callable[[], Any]) -> Callable[[Any], Any]:
        """What is called when that is changed: it is kept, and drawn."""

        def store_value(event: Any) -> Any:
            self.state[name] = event.value
            return redraw()

        return store_value

    async def _draw_joint(self) -> None:
        for joint, row in self.rows.items():
            here = joint == self.state["joint"]
            row.classes(add="fails-here" if here else "", remove="" if here else "fails-here")
            row.props(f"aria-selected={'true' if here else 'false'}")
        self.body.props["data-rows"] = self.state["joint"]  # lit wherever the mouse is
        if self.robot is not None:
            self.robot.show_clearly([self.state["joint"]])
        await self._draw_torques()
        await self._draw_residual()

    async def _draw_torques(self) -> None:
        joints = self.verdict.joints if self.state.get("every") else (self.state["joint"],)
        loaders = [
            partial(load_torque, self.studio, [self.model], self.logs, joint) for joint in joints
        ]
        pictures = [await load() for load in loaders]
        self.torques.clear()
        with self.torques:
            for load, picture in zip(loaders, pictures, strict=True):
                draw_zoomable(picture, _TIME, load)

    async def _draw_residual(self) -> None:
        subject = self.state["joint"], self.state["channel"]
        await _draw_residual(self.studio, self.residual, [self.model], self.logs, *subject)


async def _draw_residual(
    studio: Studio, place: ui.element, models: list[str], logs: list[str], *subject: Any
) -> None:
    """Draws a residual in its place; `subject` is the joint, the channel, and if by log."""
    picture = await studio.try_viewer("residual_picture", models, logs, *subject, kind="residual")
    if picture is not None:
        place.clear()
        with place:
            figures.draw_picture(picture)


async def load_torque(
    studio: Studio, models: list[str], logs: list[str], joint: str, *ends: float
) -> Any:
    """Loads the picture of the torques of a joint, all of it or between two times, s."""
    kind = f"torque {joint} of {models}"
    return await studio.try_viewer("torque_picture", models, logs, joint, *ends, kind=kind)


def draw_zoomable(picture: Any, time: str, load_window: Callable[..., Awaitable[Any]]) -> None:
    """Draws a picture that is loaded anew, and finer, when another time range is shown.

    Args:
        picture: of all; None is not drawn.
        time: that pictures share.
        load_window: from both ends, s, to the picture of what is between, or None.
    """
    if picture is None:
        return
    plot = figures.draw_picture(picture, time)

    async def update_picture(event: Any) -> None:
        ends = figures.read_x_range(event.args)
        finer = None if ends is False else await load_window(*(ends or ()))
        if finer is not None:
            plot.update_figure(figures.build_plot(finer, time))

    plot.on("plotly_relayout", update_picture)


_DAYS_TIME = "days"  # that pictures of several models share


async def draw_days(studio: Studio) -> None:
    """Draws the screen of what changes from day to day and machine to machine."""
    draw_head(
        "Compare and drift",
        "One model on two logs, two models on the same logs, and what changed from log to log.",
    )
    state = studio.state.setdefault("days", {"tab": "logs"})
    with ui.tabs(value=state["tab"]).props("no-caps align=left") as tabs:
        ui.tab("logs", "Two logs")
        ui.tab("models", "Two models")
        ui.tab("drift", "What drifted")
    body = ui.column().classes("w-full gap-4")

    async def draw_tab() -> None:
        state["tab"] = tabs.value
        body.clear()
        with body:
            await {"logs": _draw_logs, "models": _draw_models, "drift": _draw_drift}[tabs.value](
                studio, state
            )

    tabs.on_value_change(draw_tab)
    await draw_tab()


def _collect_parts(log: ProjectLog) -> list[LogPart]:
    """All of a log but what is left out of it."""
    return [LogPart(log.file, time_range) for time_range in TimeRange().subtract_gaps(log.out)]


def _draw_menu(
    state: dict[str, Any], name: str, known: Mapping[Any, str], changed: Callable[[], Any]
) -> None:
    """A menu; what is chosen is kept under its name, which is its label too."""
    if state.get(name) not in known:
        state[name] = next(iter(known))

    def store_choice(event: Any) -> Any:
        state[name] = event.value
        return changed()

    ui.select(dict(known), value=state[name], label=name, on_change=store_choice).classes("w-64")


def _draw_pair(state: dict[str, Any], what: str, known: Mapping[Any, str], studio: Studio) -> None:
    """Menus of two that are compared; at first the first two."""
    for name, default in zip((f"first {what}", f"second {what}"), known, strict=False):
        if state.get(name) not in known:
            state[name] = default
        _draw_menu(state, name, known, studio.redraw)


async def _draw_logs(studio: Studio, state: dict[str, Any]) -> None:
    """Errors and residuals of two logs under the current model."""
    project = studio.project
    if not project.model_file:
        return explain_missing_model(studio)
    if len(project.logs) < 2:
        line = "The project has fewer than two logs: add another day or machine first."
        return explain_missing(studio, line, "Data", "data")
    known = {log.file: log.file.rpartition("/")[2] for log in project.logs}
    with ui.row().classes("items-center"):
        _draw_pair(state, "log", known, studio)
    chosen = {state["first log"], state["second log"]}
    parts = [part for log in project.logs if log.file in chosen for part in _collect_parts(log)]
    add_run_button(studio, "Compare", lambda: commands.compare(project, parts), small=True)
    viewer_words = commands.build_viewer_words(project, parts)
    verdict = await studio.ask_viewer("verdict", project.model_file, viewer_words)
    errors = await studio.ask_viewer("log_errors", project.model_file, viewer_words)
    with add_card("Relative error"):
        by_joint = {joint: [each[joint] for _, _, each in errors] for joint in verdict.joints}
        rows = [[f"joint {j}", *map(format_percent, shares)] for j, shares in by_joint.items()]
        rows.append(["all", *(format_percent(whole) for _, whole, _ in errors)])
        draw_table(["", *(name for name, _, _ in errors)], rows)

    async def draw_residuals() -> None:
        subject = state["joint"], state["residual over"], True
        await _draw_residual(studio, place, [project.model_file], viewer_words, *subject)

    with add_card("Residuals of both logs"):
        with ui.row():
            joints = {joint: f"joint {joint}" for joint in verdict.joints}
            _draw_menu(state, "joint", joints, draw_residuals)
            state.setdefault("residual over", "velocity")
            _draw_menu(state, "residual over", dict(verdict.channels), draw_residuals)
        place = ui.column().classes("w-full")
        await draw_residuals()


async def _draw_models(studio: Studio, state: dict[str, Any]) -> None:
    """Two models of the project on the same logs: which is significantly better where."""
    project = studio.project
    models = [step for step in project.steps if step.model_file]
    known = {step.number: f"{step.number}  {step.task.title}" for step in models}
    logs = project.collect_judged_parts()
    if len(known) < 2 or not logs:
        line = "The project has fewer than two models: fit another one, or add an effect first."
        return explain_missing(studio, line, "What is missing", "missing")
    with ui.row().classes("items-center"):
        _draw_pair(state, "model", known, studio)
    pair = state["first model"], state["second model"]
    if pair[0] == pair[1]:
        ui.label("Choose two different models.")
        return None
    viewer_words = commands.build_viewer_words(project, logs)
    task = commands.compare_models(project, pair)
    add_run_button(studio, "Compare both", lambda: task)
    comparison_steps = [step for step in project.steps if step.task == task]
    if comparison_steps:
        _draw_model_comparison(studio, comparison_steps[-1])
    files = [f"models/{number}.json" for number in pair]
    verdict = await studio.ask_viewer("verdict", files[0], viewer_words)

    async def draw_torques() -> None:
        load = partial(load_torque, studio, files, viewer_words, state["joint shown"])
        picture = await load()
        if picture is not None:
            place.clear()
            with place:
                draw_zoomable(picture, _DAYS_TIME, load)

    with add_card("Measured and predicted by both"):
        errors = dict(zip(verdict.joints, verdict.errors, strict=True))
        state.setdefault("joint shown", max(errors, key=lambda one: errors[one]))
        joints = {joint: f"joint {joint}" for joint in verdict.joints}
        _draw_menu(state, "joint shown", joints, draw_torques)
        place = ui.column().classes("w-full")
        await draw_torques()


def _draw_model_comparison(studio: Studio, step: Step) -> None:
    """What `modeler compare A B LOG...` found."""
    model_entries = studio.read_result(step)["models"]
    with add_card("Who is better"):
        for each in model_entries:
            if each["best_joints"]:
                joints = ", ".join(each["best_joints"])
                ui.label(f"{each['model']} predicts joint {joints} significantly better.")
        if not any(each["best_joints"] for each in model_entries):
            ui.label("No model is significantly better than the other on any joint.")
        rows = []
        for joint in model_entries[0]["joints"]:
            every = [each["joints"][joint] for each in model_entries]
            cells = [
                f"{format_percent(one['relative_error'])}{' *' * one['is_best']}" for one in every
            ]
            rows.append([f"joint {joint}", *cells])
        draw_table(["", *(each["model"] for each in model_entries)], rows)
        draw_note("*: significantly better than the other.")
    _draw_pictures(studio, step, _DAYS_TIME)


async def _draw_drift(studio: Studio, state: dict[str, Any]) -> None:
    """What changes from log to log, machine by machine."""
    project = studio.project
    if not project.robot or len(project.logs) < 2:
        line = "Drift needs a robot and two logs at least, of several days or machines."
        return explain_missing(studio, line, "Data", "data")
    parts = [part for log in project.logs for part in _collect_parts(log)]

    def build_task() -> Task:
        return commands.fleet(project, parts, state.get("pattern", ""))

    def store_pattern(event: Any) -> None:
        state["pattern"] = event.value.strip()
        renew()

    pattern = ui.input("File name pattern", value=state.get("pattern", ""), on_change=store_pattern)
    pattern.classes("w-80").props["placeholder"] = "{machine}-{period}.csv"
    draw_note("Left out: the folder is the machine and the file the period, in order of names.")
    renew = add_run_button(studio, "Detect drift", build_task)
    steps = [step for step in project.steps if step.verb == "fleet"]
    if steps:
        _draw_fleet(studio, steps[-1])
    return None


def _draw_fleet(studio: Studio, step: Step) -> None:
    """What `modeler fleet` found."""
    result = studio.read_result(step)
    with add_card("Drift, steps and outliers"):
        ui.label(result["verdict"])
        if result["findings"]:
            names = ("machine", "parameter", "shape", "begin", "end")
            rows = [
                (
                    *map(one.get, names),
                    f"{one['change']:.4g} {one['unit']}",
                    f"{one['score']:.1f} sigma",
                )
                for one in result["findings"]
            ]
            heads = ("machine", "what", "how", "from", "to", "change", "certainty")
            draw_table(heads, rows)
        left = [f"{one['log']} left out: {one['reason']}" for one in result["skipped_logs"]]
        for line in [f"{one['sentence']}." for one in result["findings"]]:
            ui.label(line)
        for line in (*result["warnings"], *result["notes"], *left):
            draw_note(line)
    _draw_pictures(studio, step)


def _draw_pictures(studio: Studio, step: Step, time: str = "") -> None:
    """All that a command drew."""
    for picture in read_pictures(studio.folder / step.pictures_file):
        with ui.card().classes("studio-card w-full"):
            figures.draw_picture(picture, time)
