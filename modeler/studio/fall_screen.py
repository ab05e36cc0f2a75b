"""The screen "watch it fall": the error after each step, the way back, and what is left."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from nicegui import ui

from modeler.core.picture_file import pictures_from_json
from modeler.core.table import percent
from modeler.studio import figures
from modeler.studio.elements import (
    Light,
    busy_with,
    command_line,
    doubt_lines,
    go_button,
    head,
    light,
    page_button,
    part,
    told,
)
from modeler.studio.project import MAKING, Project, Step
from modeler.studio.studio import Studio


async def draw(studio: Studio) -> None:
    """Draws it."""
    project = studio.project
    head("Watch it fall", "The error after every step; press a bar, or a step, to go back to it.")
    path = project.path()
    if not path:
        ui.label("There is no model yet: fit one first.")
        go_button(studio, "To the fit", "fit")
        return
    results = {step.number: studio.result(step) for step in path}
    with part("The way of this model"):
        _pictures(studio, path, results)
        for step in path:
            _step(studio, step, results[step.number], here=step is path[-1])
    _aside(studio, {step.number for step in path})
    await _left(studio)
    with ui.row():
        go_button(studio, "Look what is missing still", "missing")
        go_button(studio, "Take it away", "take")


def waterfall(result: Mapping[str, Any]) -> Sequence[Mapping[str, Any]]:
    """Errors after each effect; of a fit none."""
    found: Sequence[Mapping[str, Any]] = result.get("waterfall", ())
    return found


def leads_to(path: Sequence[Step], results: Mapping[int, Mapping[str, Any]], bar: int) -> Step:
    """The step whose model is that of a bar; of several effects in one step the one before it."""
    counts = [max(1, len(waterfall(results[step.number]))) for step in path]
    return next(s for s, n in zip(reversed(path), reversed(counts), strict=True) if n - 1 <= bar)


def _pictures(
    studio: Studio, path: Sequence[Step], results: Mapping[int, Mapping[str, Any]]
) -> None:
    last = path[-1]
    if not waterfall(results[last.number]):
        told(["Nothing was added to it yet."])
        return
    for picture in pictures_from_json(studio.folder / last.pictures):
        plot = figures.draw(picture)
        if picture.name == "waterfall":
            plot.on(
                "plotly_click",
                lambda event: _back(
                    studio, leads_to(path, results, int(event.args["points"][0]["pointNumber"]))
                ),
            )
    doubt_lines(
        f"{one['effect']} {one['joint'] or ''}: the error does not surely fall with it"
        for one in waterfall(results[last.number])
        if not one["falls"]
    )


def _step(studio: Studio, step: Step, result: Mapping[str, Any], here: bool) -> None:
    """One step: what it made of the error, its command, the way back to it."""
    with ui.row().classes("items-center no-wrap w-full"):
        ui.label(f"{step.number}  {step.title}").classes("studio-step")
        ui.label(_error(result)).classes("studio-step-error")
        if here:
            ui.label("you are here").classes("studio-soft")
        else:
            name = f"Undo to step {step.number}"
            busy_with(studio, ui.button(name, on_click=lambda: _back(studio, step))).props(
                "no-caps outline dense icon=undo"
            )
        command_line(step.words)


def _error(result: Mapping[str, Any]) -> str:
    steps = waterfall(result)
    if not steps:
        return f"{percent(result['relative_error'])} where it was fitted"
    last = steps[-1]
    where = "held out" if last["held_out"] else "left out in turn"
    return f"{percent(last['error'])} {where}, {percent(last['training_error'])} fitted"


def _back(studio: Studio, step: Step) -> None:
    if studio.change(redraw=True, current=step.number):
        studio.show_error("")


def _aside(studio: Studio, path: set[int]) -> None:
    """Steps that were set aside, or only tried: nothing is lost."""
    aside = [s for s in studio.project.steps if s.kind in MAKING and s.number not in path]
    if not aside:
        return
    with part("Set aside"):
        for step in aside:
            with ui.row().classes("items-center no-wrap w-full"):
                ui.label(f"{step.number}  {step.title}, {_from(studio.project, step)}")
                ui.label(_error(studio.result(step))).classes("studio-step-error")
                name = f"Go to step {step.number}"
                button = ui.button(name, on_click=lambda _, step=step: _back(studio, step))
                busy_with(studio, button.props("no-caps outline dense icon=redo"))
                command_line(step.words)


def _from(project: Project, step: Step) -> str:
    parent = project.step(step.parent)
    return "a model of its own" if parent is None else f"from step {parent.number}"


async def _left(studio: Studio) -> None:
    """What is left of each joint, and whether it is noise."""
    project = studio.project
    logs = project.words("test") or project.words("train")
    with part("What is left" + (" on held-out motion" if project.words("test") else "")):
        found = await studio.view("verdict", project.model, logs)
        for joint, kind, sentence in zip(found.joints, found.kinds, found.sentences, strict=True):
            light(*_KINDS[kind](joint))
            ui.label(sentence)
        page_button(studio, project.path()[-1])


_KINDS: Mapping[str, Callable[[str], tuple[Light, str]]] = {
    "noise": lambda joint: ("good", f"joint {joint}: what is left looks like noise"),
    "pattern": lambda joint: ("doubtful", f"joint {joint}: what is left has a pattern"),
    "other": lambda joint: ("doubtful", f"joint {joint}: no noise, and no pattern that was tried"),
}
