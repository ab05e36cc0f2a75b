"""The screen "watch it fall": the error after each step, the way back, and what is left."""

from collections.abc import Mapping, Sequence
from typing import Any

from nicegui import ui

from modeler.core.errors import ModelerError
from modeler.core.figure import read_pictures
from modeler.core.table import format_percent
from modeler.studio import elements, figures
from modeler.studio.commands import build_viewer_words
from modeler.studio.studio import Studio
from modeler.studio.tasks import Step


async def draw(studio: Studio) -> None:
    """Draws it."""
    project, path = studio.project, studio.project.collect_path()
    elements.draw_head(
        "Watch it fall",
        "The error after every step. Press a bar, or a step, to go back to it: the robot file goes "
        "along, unless it was edited since.",
    )
    if not path:
        elements.explain_missing_model(studio)
        return
    elements.draw_stale_warnings(studio)
    with elements.add_card("The way of this model"):
        _draw_pictures(studio, path)
        for step in path:
            _draw_step(studio, step, "" if step is path[-1] else f"Undo to step {step.number}")
    aside = [step for step in project.steps if step.model_file and step not in path]
    if aside:
        with elements.add_card("Set aside"):
            for step in aside:
                _draw_step(studio, step, f"Go to step {step.number}")
    logs = build_viewer_words(
        project, project.collect_parts("test") or project.collect_parts("train")
    )
    with elements.add_card(
        "What is left" + (" on held-out motion" if project.collect_words("test") else "")
    ):
        verdict = await studio.ask_viewer("verdict", project.model_file, logs)
        for joint, error, kind, sentence in zip(
            verdict.joints, verdict.errors, verdict.kinds, verdict.sentences, strict=True
        ):
            elements.draw_residual_state(joint, error, kind)
            ui.label(sentence).classes("studio-soft")
        elements.add_page_button(studio, path[-1])
    with ui.row():
        elements.add_go_button(studio, "Look what is missing still", "missing")
        elements.add_go_button(studio, "Take it away", "take")


def _read_waterfall(studio: Studio, step: Step) -> Sequence[Mapping[str, Any]]:
    """Errors after each effect; of a fit none."""
    waterfall: Sequence[Mapping[str, Any]] = studio.read_result(step).get("waterfall", ())
    return waterfall


def _draw_pictures(studio: Studio, path: Sequence[Step]) -> None:
    """The error after every step, over all joints and by joint; a bar leads back to its step."""
    counts = [max(1, len(_read_waterfall(studio, step))) for step in path]
    if counts[-1] == 1:
        ui.label("Nothing was added to it yet.")
        return

    def restore_bar(bar: int) -> None:
        matching_steps = [step for step, n in zip(path, counts, strict=True) if n - 1 == bar]
        if matching_steps:
            _restore_step(studio, matching_steps[0])
        else:
            studio.show_error(
                "that effect came with others in one step; go back to the step before, and add "
                "them one by one"
            )

    for picture in read_pictures(studio.folder / path[-1].pictures_file):
        plot = figures.draw_picture(picture)
        if picture.name == "waterfall":
            plot.on("plotly_click", lambda e: restore_bar(int(e.args["points"][0]["pointNumber"])))
    elements.draw_warnings(
        f"{one['effect']} {one['joint'] or ''}: the error does not surely fall with it"
        for one in _read_waterfall(studio, path[-1])
        if not one["falls"]
    )


def _draw_step(studio: Studio, step: Step, action: str) -> None:
    """One step: what it made of the error, the way to it, its command."""
    with ui.row().classes("items-center no-wrap w-full"):
        origin = f", from step {step.parent}" if step.parent else ""
        ui.label(f"{step.number}  {step.task.title}{origin}").classes("studio-step")
        ui.label(_describe_error(studio, step)).classes("studio-step-error")
        if action:
            button = ui.button(action, on_click=lambda: _restore_step(studio, step))
            elements.disable_while_busy(studio, button.props("no-caps outline dense icon=history"))
        else:
            ui.label("you are here").classes("studio-soft")
        elements.draw_step_line(studio, step)


def _describe_error(studio: Studio, step: Step) -> str:
    try:
        result = studio.read_result(step)
    except ModelerError as error:
        return str(error)
    if "waterfall" not in result:
        return f"error {format_percent(result['relative_error'])}"
    last = result["waterfall"][-1]
    kind = "held-out" if last["held_out"] else "cross-validated"
    return f"{kind} error {format_percent(last['error'])}, rms over the joints"


def _restore_step(studio: Studio, step: Step) -> None:
    if studio.hub.running is not None and not studio.hub.gives_way:  # it is about the current model
        title = studio.hub.running.title
        studio.show_error(f"step {step.number}: {title} runs still; wait for it, or cancel it")
    elif studio.take_step(step):
        studio.show_error("")
