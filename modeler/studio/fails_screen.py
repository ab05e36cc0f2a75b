"""Where it fails: measured against predicted torque by joint, and what the residual follows."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from nicegui import ui
from nicegui.elements.plotly import Plotly

from modeler.core.errors import ModelerError
from modeler.core.picture_file import pictures_from_json
from modeler.studio import commands, figures
from modeler.studio.elements import go_button, head, part, run_button, stale, told, what_is_left
from modeler.studio.robot_frame import RobotFrame, robot_frame
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
    head(
        "Where it fails",
        "Measured against predicted torque, and what the rest follows. Drag in a picture to zoom, "
        "double click for all of it.",
    )
    project = studio.project
    if not project.model:
        ui.label("There is no model yet: fit one first.")
        go_button(studio, "Fit", "fit")
        return
    roles = {role: name for role, name in _ROLES.items() if project.words(role)}
    if not roles:
        ui.label("No log has a training or held-out stretch: choose some first.")
        go_button(studio, "Data", "data")
        return
    kept = studio.kept.setdefault("fails", {})
    if kept.get("role") not in roles:
        kept["role"] = next(iter(roles))
    logs = project.parts(kept["role"])
    with ui.row().classes("items-center w-full"):

        def chosen(event: Any) -> None:
            kept["role"] = event.value
            studio.redraw()

        ui.toggle(roles, value=kept["role"], on_change=chosen).props("no-caps")
        with ui.element("div").classes("col"):
            run_button(studio, "Compare", lambda: commands.compare(project, logs), small=True)
    stale(studio)
    judged = commands.judged_on(project, logs)
    with ui.row().classes("items-center") as waiting:
        ui.spinner(size="sm")
        ui.label("predicting ...")
    try:
        found: Verdict = await studio.view("verdict", project.model, judged)
    finally:
        waiting.delete()
    if found.joints:
        await _Fails(studio, project.model, judged, found, kept).draw()
    told(found.unjudged)
    step = project.about("compare")
    if step is not None and step.task == commands.compare(project, logs):
        more = ui.expansion("All that the command drew: spectra, waves per turn, shares")
        more.classes("w-full").on_value_change(lambda: _more(studio, more, step))


def _more(studio: Studio, place: ui.expansion, step: Step) -> None:
    """Draws what `modeler compare` drew, where that was opened."""
    place.clear()
    try:
        pictures = pictures_from_json(studio.folder / step.pictures) if place.value else ()
    except ModelerError as error:
        studio.show_error(str(error))
        return
    with place:
        for picture in pictures:
            if not picture.name.endswith("_time"):  # which stands above
                figures.draw(picture)


class _Fails:
    """The screen of one model on logs; `kept` is what was chosen last in this window."""

    def __init__(
        self, studio: Studio, model: str, logs: list[str], found: "Verdict", kept: dict[str, Any]
    ) -> None:
        self.studio, self.model, self.logs, self.found, self.kept = studio, model, logs, found, kept
        if kept.get("joint") not in found.joints:
            errors = [-1.0 if math.isnan(error) else error for error in found.errors]
            kept["joint"] = found.joints[errors.index(max(errors))]
        self.rows: dict[str, ui.element] = {}
        self.robot: RobotFrame | None = None

    async def draw(self) -> None:
        """Verdict, torques, map, residual."""
        with ui.column().classes("w-full gap-4") as self.body:
            await self._parts()
        await self._joint_drawn()

    async def _parts(self) -> None:
        with ui.row().classes("w-full fails-top"):
            with part("Verdict").classes("fails-said"):
                self._verdict()
            self.robot = await self._robot()
        with part("Measured and predicted"):
            await self._clock()
            every = ui.switch("all joints", value=self.kept.get("every", False))
            every.on_value_change(self._keeps("every", self._torques_drawn))
            self.torques = ui.column().classes("w-full gap-2")
        with part("What the residual follows"), ui.row().classes("w-full fails-halves"):
            with ui.column().classes("fails-half"):
                where = await self.studio.view("where_picture", self.model, self.logs)
                heat = where.panels[0][0].series[0]
                if np.isnan(heat.values).all():
                    ui.label("These stretches have too few samples to tell what it follows.")
                else:
                    figures.draw(where).on("plotly_click", self._cell)
                self._strongest(heat)
            with ui.column().classes("fails-half"):
                choice = dict(self.found.channels)
                self.channel = ui.select(
                    choice, value=self.kept["channel"], label="residual over",
                    on_change=self._keeps("channel", self._residual_drawn),
                ).classes("w-64")  # fmt: skip
                self.residual = ui.column().classes("w-full")

    async def _robot(self) -> RobotFrame | None:
        """In 3-D, its joints to be clicked; None where it cannot be drawn."""
        try:
            with ui.card().classes("studio-card fails-robot"):
                found = await robot_frame(self.studio, "100%", alone=True)
        except ModelerError as error:
            self.studio.show_error(str(error))
            return None
        found.on_joint(self._pick)
        return found

    async def _clock(self) -> None:
        """The time that all pictures share, played on a line; the robot goes along."""
        time, positions = await self.studio.view("poses", self.model, self.logs)
        with ui.row().classes("w-full items-center no-wrap"):
            play = ui.button(icon="play_arrow").props('dense round unelevated aria-label="play"')
            speed = ui.select(_SPEEDS, value=1.0).props('dense borderless aria-label="speed"')
            with ui.element("div").classes("col"):
                line = Timeline(_TIME, (self.found.start, self.found.end))
        if self.robot is not None:
            line.frame = self.robot.id
        line.on("playing", lambda event: play.set_icon("pause" if event.args else "play_arrow"))
        play.on_click(lambda: line.play(speed.value))
        line.show(time, positions)

    def _verdict(self) -> None:
        found = self.found
        rows = zip(found.joints, found.errors, found.kinds, found.sentences, strict=True)
        with ui.element("div").classes("fails-verdict").props("role=listbox aria-label=joints"):
            for joint, error, kind, sentence in rows:
                row = ui.element("button").classes("fails-joint").props("type=button role=option")
                row.props["data-rows"] = joint
                row.on("click", lambda _, name=joint: self._pick(name))
                self.rows[joint] = row
                with row:
                    what_is_left(joint, error, kind)
                    ui.label(sentence).classes("fails-sentence")

    async def _pick(self, joint: str, channel: str | None = None) -> None:
        """Another joint, and perhaps another channel, is looked at."""
        if joint not in self.found.joints:
            return
        self.kept["joint"] = joint
        if channel is not None and channel != self.kept["channel"]:
            self.kept["channel"] = channel
            self.channel.set_value(channel)  # which draws the residual anew
        await self._joint_drawn()

    def _strongest(self, heat: Any) -> None:
        """At first the channel is looked at that the joint follows most."""
        if self.kept.get("channel") not in heat.columns:
            shares = np.nan_to_num(heat.values[heat.rows.index(self.kept["joint"])], nan=-1.0)
            self.kept["channel"] = heat.columns[int(shares.argmax())]

    async def _cell(self, event: Any) -> None:
        point = event.args["points"][0]
        await self._pick(point["y"], point["x"])

    def _keeps(self, name: str, drawn: Callable[[], Any]) -> Callable[[Any], Any]:
        """What is called when that is changed: it is kept, and drawn."""

        def changed(event: Any) -> Any:
            self.kept[name] = event.value
            return drawn()

        return changed

    async def _joint_drawn(self) -> None:
        for joint, row in self.rows.items():
            here = joint == self.kept["joint"]
            row.classes(add="fails-here" if here else "", remove="" if here else "fails-here")
            row.props(f"aria-selected={'true' if here else 'false'}")
        self.body.props["data-rows"] = self.kept["joint"]  # lit wherever the mouse is
        if self.robot is not None:
            self.robot.light([self.kept["joint"]])
        await self._torques_drawn()
        await self._residual_drawn()

    async def _torques_drawn(self) -> None:
        joints = self.found.joints if self.kept.get("every") else (self.kept["joint"],)
        pictures = [await self._torque(joint) for joint in joints]
        self.torques.clear()
        with self.torques:
            for joint, picture in zip(joints, pictures, strict=True):
                if picture is not None:
                    plot = figures.draw(picture, _TIME)
                    zooms(self.studio, plot, lambda *ends, name=joint: self._torque(name, *ends))

    async def _torque(self, joint: str, *ends: float) -> Any:
        return await asked(
            self.studio, "torque_picture", [self.model], self.logs, joint, *ends,
            kind=f"torque {joint}",
        )  # fmt: skip

    async def _residual_drawn(self) -> None:
        picture = await asked(
            self.studio, "residual_picture", [self.model], self.logs, self.kept["joint"],
            self.kept["channel"], kind="residual",
        )  # fmt: skip
        if picture is not None:
            self.residual.clear()
            with self.residual:
                figures.draw(picture)


async def asked(studio: Studio, question: str, *arguments: Any, kind: str) -> Any:
    """The answer of the viewer; None where it has none, whose line is shown then, or is stale."""
    try:
        return await studio.view(question, *arguments, kind=kind)
    except ModelerError as error:
        studio.show_error(str(error))
        return None


def zooms(studio: Studio, plot: Plotly, window: Any) -> None:
    """The picture is asked for anew, finer, when another stretch of time is looked at.

    Args:
        studio: the window.
        plot: drawn by `figures.draw`, one of the pictures of a time.
        window: from both ends, s, to the picture of what is between, or None.
    """

    async def changed(event: Any) -> None:
        ends = figures.x_range(event.args)
        if ends is False:
            return
        try:
            picture = await window(*(ends or ()))
        except ModelerError as error:
            studio.show_error(str(error))
            return
        if picture is not None:
            plot.update_figure(figures.figure(picture, plot.figure["layout"]["meta"]["time"]))

    plot.on("plotly_relayout", changed)
