"""Where it fails: measured against predicted torque by joint, and what the residual follows."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from nicegui import ui
from nicegui.elements.plotly import Plotly

from modeler.core.errors import ModelerError
from modeler.core.figure import read_pictures
from modeler.studio import commands, figures
from modeler.studio.elements import (
    add_card,
    add_go_button,
    add_run_button,
    draw_head,
    draw_lines,
    draw_residual_state,
    draw_stale_warnings,
)
from modeler.studio.robot_frame import RobotFrame, add_robot_frame
from modeler.studio.studio import Studio
from modeler.studio.tasks import Step
from modeler.studio.timeline import Timeline

if TYPE_CHECKING:
    from modeler.studio.viewing import Verdict

_TIME = "fails"  # that all pictures of the screen share
_SPEEDS = {0.1: "0.1x", 0.5: "0.5x", 1.0: "1x", 2.0: "2x", 5.0: "5x"}
_ROLES = {"test": "held out", "train": "training"}


async def draw(studio: Studio) -> None:
    """Draws it."""
    draw_head(
        "Where it fails",
        "Measured against predicted torque, and what the rest follows. Drag in a picture to zoom, "
        "double click for all of it.",
    )
    project = studio.project
    if not project.model_file:
        ui.label("There is no model yet: fit one first.")
        add_go_button(studio, "Fit", "fit")
        return
    roles = {role: name for role, name in _ROLES.items() if project.collect_words(role)}
    if not roles:
        ui.label("No log has a training or held-out stretch: choose some first.")
        add_go_button(studio, "Data", "data")
        return
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


def _draw_more(studio: Studio, place: ui.expansion, step: Step) -> None:
    """Draws what `modeler compare` drew, where that was opened."""
    place.clear()
    try:
        pictures = read_pictures(studio.folder / step.pictures_file) if place.value else ()
    except ModelerError as error:
        studio.show_error(str(error))
        return
    with place:
        for picture in pictures:
            if not picture.name.endswith("_time"):  # which stands above
                figures.draw_picture(picture)


class _FailureView:
    """The screen of one model on logs; `state` is what was chosen last in this window."""

    def __init__(
        self, studio: Studio, model: str, logs: list[str], verdict: "Verdict", state: dict[str, Any]
    ) -> None:
        self.studio, self.model, self.logs, self.verdict, self.state = (
            studio,
            model,
            logs,
            verdict,
            state,
        )
        if state.get("joint") not in verdict.joints:
            errors = [-1.0 if math.isnan(error) else error for error in verdict.errors]
            state["joint"] = verdict.joints[errors.index(max(errors))]
        self.rows: dict[str, ui.element] = {}
        self.robot: RobotFrame | None = None

    async def draw(self) -> None:
        """Verdict, torques, map, residual."""
        with ui.column().classes("w-full gap-4") as self.body:
            await self._draw_parts()
        await self._draw_joint()

    async def _draw_parts(self) -> None:
        with ui.row().classes("w-full fails-top"):
            with add_card("Verdict").classes("fails-said"):
                self._draw_verdict()
            self.robot = await self._draw_robot()
        with add_card("Measured and predicted"):
            await self._draw_clock()
            every = ui.switch("all joints", value=self.state.get("every", False))
            every.on_value_change(self._make_store("every", self._draw_torques))
            self.torques = ui.column().classes("w-full gap-2")
        with add_card("What the residual follows"), ui.row().classes("w-full fails-halves"):
            with ui.column().classes("fails-half"):
                where = await self.studio.ask_viewer("where_picture", self.model, self.logs)
                heat = where.panels[0][0].series[0]
                if np.isnan(heat.values).all():
                    ui.label("These stretches have too few samples to tell what it follows.")
                else:
                    figures.draw_picture(where).on("plotly_click", self._select_cell)
                self._select_strongest_channel(heat)
            with ui.column().classes("fails-half"):
                choice = dict(self.verdict.channels)
                self.channel = ui.select(
                    choice, value=self.state["channel"], label="residual over",
                    on_change=self._make_store("channel", self._draw_residual),
                ).classes("w-64")  # fmt: skip
                self.residual = ui.column().classes("w-full")

    async def _draw_robot(self) -> RobotFrame | None:
        """In 3-D, its joints to be clicked; None where it cannot be drawn."""
        try:
            with ui.card().classes("studio-card fails-robot"):
                frame = await add_robot_frame(self.studio, "100%", alone=True)
        except ModelerError as error:
            self.studio.show_error(str(error))
            return None
        frame.connect_joint(self._select_joint)
        return frame

    async def _draw_clock(self) -> None:
        """The time that all pictures share, played on a line; the robot goes along."""
        time, positions = await self.studio.ask_viewer("poses", self.model, self.logs)
        with ui.row().classes("w-full items-center no-wrap"):
            play = ui.button(icon="play_arrow").props('dense round unelevated aria-label="play"')
            speed = ui.select(_SPEEDS, value=1.0).props('dense borderless aria-label="speed"')
            with ui.element("div").classes("col"):
                line = Timeline(_TIME, (self.verdict.start, self.verdict.end))
        if self.robot is not None:
            line.frame = self.robot.element_id
        line.on("playing", lambda event: play.set_icon("pause" if event.args else "play_arrow"))
        play.on_click(lambda: line.toggle_play(speed.value))
        line.show_motion(time, positions)

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
        """Another joint, and perhaps another channel, is looked at."""
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
        pictures = [await self._load_torque(joint) for joint in joints]
        self.torques.clear()
        with self.torques:
            for joint, picture in zip(joints, pictures, strict=True):
                if picture is not None:
                    plot = figures.draw_picture(picture, _TIME)
                    connect_zoom(
                        self.studio, plot, lambda *ends, name=joint: self._load_torque(name, *ends)
                    )

    async def _load_torque(self, joint: str, *ends: float) -> Any:
        return await ask_viewer(
            self.studio, "torque_picture", [self.model], self.logs, joint, *ends,
            kind=f"torque {joint}",
        )  # fmt: skip

    async def _draw_residual(self) -> None:
        picture = await ask_viewer(
            self.studio, "residual_picture", [self.model], self.logs, self.state["joint"],
            self.state["channel"], kind="residual",
        )  # fmt: skip
        if picture is not None:
            self.residual.clear()
            with self.residual:
                figures.draw_picture(picture)


async def ask_viewer(studio: Studio, question: str, *arguments: Any, kind: str) -> Any:
    """The answer of the viewer; None where it has none, whose line is shown then, or is stale."""
    try:
        return await studio.ask_viewer(question, *arguments, kind=kind)
    except ModelerError as error:
        studio.show_error(str(error))
        return None


def connect_zoom(studio: Studio, plot: Plotly, load_window: Any) -> None:
    """The picture is asked for anew, finer, when another stretch of time is looked at.

    Args:
        studio: the window.
        plot: drawn by `figures.draw_picture`, one of the pictures of a time.
        load_window: from both ends, s, to the picture of what is between, or None.
    """

    async def update_picture(event: Any) -> None:
        ends = figures.read_x_range(event.args)
        if ends is False:
            return
        try:
            picture = await load_window(*(ends or ()))
        except ModelerError as error:
            studio.show_error(str(error))
            return
        if picture is not None:
            plot.update_figure(figures.build_figure(picture, plot.figure["layout"]["meta"]["time"]))

    plot.on("plotly_relayout", update_picture)
