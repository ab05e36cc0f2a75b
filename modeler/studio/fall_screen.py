"""The screen "watch it fall": the error after each step, the way back, and what is left."""

from collections.abc import Mapping, Sequence
from typing import Any

from nicegui import ui

from modeler.core.errors import ModelerError
from modeler.core.picture_file import pictures_from_json
from modeler.core.table import percent
from modeler.studio import elements, figures
from modeler.studio.commands import judged_on
from modeler.studio.studio import Studio
from modeler.studio.tasks import Step


async def draw(studio: Studio) -> None:
    """Draws it."""
    project, path = studio.project, studio.project.path()
    elements.head(
        "Watch it fall",
        "The error after every step. Press a bar, or a step, to go back to it: the robot file goes "
        "along, unless it was edited since.",
    )
    if not path:
        elements.lacks_model(studio)
        return
    elements.stale(studio)
    with elements.part("The way of this model"):
        _pictures(studio, path)
        for step in path:
            _step(studio, step, "" if step is path[-1] else f"Undo to step {step.number}")
    aside = [step for step in project.steps if step.model and step not in path]
    if aside:
        with elements.part("Set aside"):
            for step in aside:
                _step(studio, step, f"Go to step {step.number}")
    logs = judged_on(project, project.parts("test") or project.parts("train"))
    with elements.part("What is left" + (" on held-out motion" if project.words("test") else "")):
        found = await studio.view("verdict", project.model, logs)
        for joint, error, kind, sentence in zip(
            found.joints, found.errors, found.kinds, found.sentences, strict=True
        ):
            elements.what_is_left(joint, error, kind)
            ui.label(sentence).classes("studio-soft")
        elements.page_button(studio, path[-1])
    with ui.row():
        elements.go_button(studio, "Look what is missing still", "missing")
        elements.go_button(studio, "Take it away", "take")


def _waterfall(studio: Studio, step: Step) -> Sequence[Mapping[str, Any]]:
    """Errors after each effect; of a fit none."""
    found: Sequence[Mapping[str, Any]] = studio.result(step).get("waterfall", ())
    return found


def _pictures(studio: Studio, path: Sequence[Step]) -> None:
    """The error after every step, over all joints and by joint; a bar leads back to its step."""
    counts = [max(1, len(_waterfall(studio, step))) for step in path]
    if counts[-1] == 1:
        ui.label("Nothing was added to it yet.")
        return

    def pressed(bar: int) -> None:
        own = [step for step, n in zip(path, counts, strict=True) if n - 1 == bar]
        if own:
            _back(studio, own[0])
        else:
            studio.show_error(
                "that effect came with others in one step; go back to the step before, and add "
                "them one by one"
            )

    for picture in pictures_from_json(studio.folder / path[-1].pictures):
        plot = figures.draw(picture)
        if picture.name == "waterfall":
            plot.on("plotly_click", lambda e: pressed(int(e.args["points"][0]["pointNumber"])))
    elements.doubt_lines(
        f"{one['effect']} {one['joint'] or ''}: the error does not surely fall with it"
        for one in _waterfall(studio, path[-1])
        if not one["falls"]
    )


def _step(studio: Studio, step: Step, way: str) -> None:
    """One step: what it made of the error, the way to it, its command."""
    with ui.row().classes("items-center no-wrap w-full"):
        origin = f", from step {step.parent}" if step.parent else ""
        ui.label(f"{step.number}  {step.task.title}{origin}").classes("studio-step")
        ui.label(_error(studio, step)).classes("studio-step-error")
        if way:
            button = ui.button(way, on_click=lambda: _back(studio, step))
            elements.busy_with(studio, button.props("no-caps outline dense icon=history"))
        else:
            ui.label("you are here").classes("studio-soft")
        elements.step_line(studio, step)


def _error(studio: Studio, step: Step) -> str:
    try:
        result = studio.result(step)
    except ModelerError as error:
        return str(error)
    if "waterfall" not in result:
        return f"error {percent(result['relative_error'])}"
    last = result["waterfall"][-1]
    kind = "held-out" if last["held_out"] else "cross-validated"
    return f"{kind} error {percent(last['error'])}, rms over the joints"


def _back(studio: Studio, step: Step) -> None:
    if studio.hub.running is not None and not studio.hub.gives_way:  # it is about the current model
        title = studio.hub.running.title
        studio.show_error(f"step {step.number}: {title} runs still; wait for it, or cancel it")
    elif studio.take(step):
        studio.show_error("")
