"""Days and machines: two logs under one model, two models on the same logs, and what drifted."""

from collections.abc import Callable, Mapping
from typing import Any

from nicegui import ui

from modeler.core.figure import read_pictures
from modeler.core.table import format_percent
from modeler.studio import commands, figures
from modeler.studio.elements import add_card, add_go_button, add_run_button, draw_head, draw_table
from modeler.studio.fails_screen import ask_viewer, connect_zoom
from modeler.studio.project import ProjectLog
from modeler.studio.studio import Studio
from modeler.studio.tasks import LogPart, Step, Task, TimeRange

_TIME = "days"  # that pictures of several models share


async def draw(studio: Studio) -> None:
    """Draws it."""
    draw_head(
        "Days and machines",
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


def _explain_missing(studio: Studio, line: str, title: str, screen: str) -> None:
    """What is missing for this, and where it is made."""
    ui.label(line)
    add_go_button(studio, title, screen)


def _collect_parts(log: ProjectLog) -> list[LogPart]:
    """All of a log but what is left out of it."""
    return [LogPart(log.file, time_range) for time_range in TimeRange().subtract_gaps(log.out)]


def _draw_menu(
    state: dict[str, Any], name: str, known: Mapping[Any, str], default: Any,
    changed: Callable[[], Any],
) -> None:  # fmt: skip
    """A menu; what is chosen is kept under its name, which is its label too."""
    if state.get(name) not in known:
        state[name] = default

    def store_choice(event: Any) -> Any:
        state[name] = event.value
        return changed()

    ui.select(dict(known), value=state[name], label=name, on_change=store_choice).classes("w-64")


async def _draw_logs(studio: Studio, state: dict[str, Any]) -> None:
    """Errors and residuals of two logs under the current model."""
    project = studio.project
    if not project.model_file:
        return _explain_missing(studio, "There is no model yet: fit one first.", "Fit", "fit")
    if len(project.logs) < 2:
        line = "The project has fewer than two logs: add another day or machine first."
        return _explain_missing(studio, line, "Data", "data")
    known = {log.file: log.file.rpartition("/")[2] for log in project.logs}
    with ui.row().classes("items-center"):
        for name, default in zip(("first log", "second log"), known, strict=False):
            _draw_menu(state, name, known, default, studio.redraw)
    chosen = {state["first log"], state["second log"]}
    parts = [part for log in project.logs if log.file in chosen for part in _collect_parts(log)]
    add_run_button(studio, "Compare", lambda: commands.compare(project, parts), small=True)
    viewer_words = commands.build_viewer_words(project, parts)
    verdict = await studio.ask_viewer("verdict", project.model_file, viewer_words)
    errors = await studio.ask_viewer("log_errors", project.model_file, viewer_words)
    with add_card("Relative error"):
        rows = [[f"joint {joint}", *(format_percent(each[joint]) for _, _, each in errors)]
                for joint in verdict.joints]  # fmt: skip
        rows.append(["all", *(format_percent(whole) for _, whole, _ in errors)])
        draw_table(["", *(name for name, _, _ in errors)], rows)

    async def draw_residuals() -> None:
        picture = await ask_viewer(
            studio, "residual_picture", [project.model_file], viewer_words, state["joint"],
            state["residual over"], True, kind="days",
        )  # fmt: skip
        if picture is not None:
            place.clear()
            with place:
                figures.draw_picture(picture)

    with add_card("Residuals of both logs"):
        with ui.row():
            joints = {joint: f"joint {joint}" for joint in verdict.joints}
            _draw_menu(state, "joint", joints, verdict.joints[0], draw_residuals)
            _draw_menu(state, "residual over", dict(verdict.channels), "velocity", draw_residuals)
        place = ui.column().classes("w-full")
        await draw_residuals()


async def _draw_models(studio: Studio, state: dict[str, Any]) -> None:
    """Two models of the project on the same logs: who is better where, beyond doubt."""
    project = studio.project
    models = [step for step in project.steps if step.model_file]
    known = {step.number: f"{step.number}  {step.task.title}" for step in models}
    logs = project.collect_parts("test") or project.collect_parts("train")
    if len(known) < 2 or not logs:
        line = "The project has fewer than two models: fit another one, or add an effect first."
        return _explain_missing(studio, line, "What is missing", "missing")
    with ui.row().classes("items-center"):
        for name, default in zip(("first model", "second model"), known, strict=False):
            _draw_menu(state, name, known, default, studio.redraw)
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

    async def load_window(*ends: float) -> Any:
        return await ask_viewer(
            studio,
            "torque_picture",
            files,
            viewer_words,
            state["joint shown"],
            *ends,
            kind="days torque",
        )

    async def draw_torques() -> None:
        picture = await load_window()
        if picture is not None:
            place.clear()
            with place:
                connect_zoom(studio, figures.draw_picture(picture, _TIME), load_window)

    with add_card("Measured and predicted by both"):
        errors = dict(zip(verdict.joints, verdict.errors, strict=True))
        joints = {joint: f"joint {joint}" for joint in verdict.joints}
        _draw_menu(
            state, "joint shown", joints, max(errors, key=lambda one: errors[one]), draw_torques
        )
        place = ui.column().classes("w-full")
        await draw_torques()


def _draw_model_comparison(studio: Studio, step: Step) -> None:
    """What `modeler compare A B LOG...` found."""
    model_entries = studio.read_result(step)["models"]
    with add_card("Who is better"):
        for each in model_entries:
            if each["best_on"]:
                joints = ", ".join(each["best_on"])
                ui.label(f"{each['model']} predicts joint {joints} best, beyond doubt.")
        if not any(each["best_on"] for each in model_entries):
            ui.label("No model is better than the other beyond doubt on any joint.")
        rows = []
        for joint in model_entries[0]["joints"]:
            joint_entries = [each["joints"][joint] for each in model_entries]
            cells = [
                f"{format_percent(one['relative_error'])}{' *' * one['best']}"
                for one in joint_entries
            ]
            rows.append([f"joint {joint}", *cells])
        draw_table(["", *(each["model"] for each in model_entries)], rows)
        ui.label("*: better than the other beyond doubt.").classes("studio-soft")
    _draw_pictures(studio, step, _TIME)


async def _draw_drift(studio: Studio, state: dict[str, Any]) -> None:
    """What changes from log to log, machine by machine."""
    project = studio.project
    if not project.robot or len(project.logs) < 2:
        line = "Drift needs a robot and two logs at least, of several days or machines."
        return _explain_missing(studio, line, "Data", "data")
    parts = [part for log in project.logs for part in _collect_parts(log)]

    def build_task() -> Task:
        return commands.fleet(project, parts, state.get("pattern", ""))

    def store_pattern(event: Any) -> None:
        state["pattern"] = event.value.strip()
        renew()

    ui.input("how paths end", value=state.get("pattern", ""), on_change=store_pattern,
             placeholder="{machine}-{period}.csv").classes("w-80")  # fmt: skip
    ui.label(
        "Left out, the folder of a log is its machine and the file its period, in the order of "
        "their names."
    ).classes("studio-soft")
    renew = add_run_button(studio, "Look for drift", build_task)
    steps = [step for step in project.steps if step.verb == "fleet"]
    if steps:
        _draw_fleet(studio, steps[-1])
    return None


def _draw_fleet(studio: Studio, step: Step) -> None:
    """What `modeler fleet` found."""
    result = studio.read_result(step)
    with add_card("What drifted, leapt or is apart"):
        ui.label(result["verdict"])
        if result["findings"]:
            draw_table(
                ["machine", "what", "how", "from", "to", "change", "certainty"],
                [[one["machine"], one["parameter"], one["shape"], one["from"], one["to"],
                  f"{one['change']:.4g} {one['unit']}", f"{one['score']:.1f} sigma"]
                 for one in result["findings"]],
            )  # fmt: skip
        left = [f"{one['log']} left out: {one['why']}" for one in result["left_out"]]
        for line in [f"{one['sentence']}." for one in result["findings"]]:
            ui.label(line)
        for line in (*result["doubts"], *result["notes"], *left):
            ui.label(line).classes("studio-soft")
    _draw_pictures(studio, step)


def _draw_pictures(studio: Studio, step: Step, time: str = "") -> None:
    """All that a command drew."""
    for picture in read_pictures(studio.folder / step.pictures_file):
        with ui.card().classes("studio-card w-full"):
            figures.draw_picture(picture, time)
