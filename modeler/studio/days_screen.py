"""Days and machines: two logs under one model, two models on the same logs, and what drifted."""

from collections.abc import Callable, Mapping
from typing import Any

from nicegui import ui

from modeler.core.picture_file import pictures_from_json
from modeler.core.table import percent
from modeler.studio import commands, figures
from modeler.studio.elements import go_button, head, part, run_button, table
from modeler.studio.fails_screen import asked, zooms
from modeler.studio.project import ProjectLog
from modeler.studio.studio import Studio
from modeler.studio.tasks import LogPart, Step, Stretch, Task

_TIME = "days"  # that pictures of several models share


async def draw(studio: Studio) -> None:
    """Draws it."""
    head(
        "Days and machines",
        "One model on two logs, two models on the same logs, and what changed from log to log.",
    )
    kept = studio.kept.setdefault("days", {"tab": "logs"})
    with ui.tabs(value=kept["tab"]).props("no-caps align=left") as tabs:
        ui.tab("logs", "Two logs")
        ui.tab("models", "Two models")
        ui.tab("drift", "What drifted")
    body = ui.column().classes("w-full gap-4")

    async def shown() -> None:
        kept["tab"] = tabs.value
        body.clear()
        with body:
            await {"logs": _logs, "models": _models, "drift": _drift}[tabs.value](studio, kept)

    tabs.on_value_change(shown)
    await shown()


def _lacks(studio: Studio, line: str, title: str, screen: str) -> None:
    """What is missing for this, and where it is made."""
    ui.label(line)
    go_button(studio, title, screen)


def _parts(log: ProjectLog) -> list[LogPart]:
    """All of a log but what is left out of it."""
    return [LogPart(log.file, own) for own in Stretch().without(log.out)]


def _choice(
    kept: dict[str, Any], name: str, known: Mapping[Any, str], default: Any,
    changed: Callable[[], Any],
) -> None:  # fmt: skip
    """A menu; what is chosen is kept under its name, which is its label too."""
    if kept.get(name) not in known:
        kept[name] = default

    def chosen(event: Any) -> Any:
        kept[name] = event.value
        return changed()

    ui.select(dict(known), value=kept[name], label=name, on_change=chosen).classes("w-64")


async def _logs(studio: Studio, kept: dict[str, Any]) -> None:
    """Errors and residuals of two logs under the current model."""
    project = studio.project
    if not project.model:
        return _lacks(studio, "There is no model yet: fit one first.", "Fit", "fit")
    if len(project.logs) < 2:
        line = "The project has fewer than two logs: add another day or machine first."
        return _lacks(studio, line, "Data", "data")
    known = {log.file: log.file.rpartition("/")[2] for log in project.logs}
    with ui.row().classes("items-center"):
        for name, default in zip(("first log", "second log"), known, strict=False):
            _choice(kept, name, known, default, studio.redraw)
    chosen = {kept["first log"], kept["second log"]}
    parts = [part for log in project.logs if log.file in chosen for part in _parts(log)]
    run_button(studio, "Compare", lambda: commands.compare(project, parts), small=True)
    judged = commands.judged_on(project, parts)
    verdict = await studio.view("verdict", project.model, judged)
    errors = await studio.view("log_errors", project.model, judged)
    with part("Relative error"):
        rows = [[f"joint {joint}", *(percent(each[joint]) for _, _, each in errors)]
                for joint in verdict.joints]  # fmt: skip
        rows.append(["all", *(percent(whole) for _, whole, _ in errors)])
        table(["", *(name for name, _, _ in errors)], rows)

    async def residuals() -> None:
        picture = await asked(
            studio, "residual_picture", [project.model], judged, kept["joint"],
            kept["residual over"], True, kind="days",
        )  # fmt: skip
        if picture is not None:
            place.clear()
            with place:
                figures.draw(picture)

    with part("Residuals of both logs"):
        with ui.row():
            joints = {joint: f"joint {joint}" for joint in verdict.joints}
            _choice(kept, "joint", joints, verdict.joints[0], residuals)
            _choice(kept, "residual over", dict(verdict.channels), "velocity", residuals)
        place = ui.column().classes("w-full")
        await residuals()


async def _models(studio: Studio, kept: dict[str, Any]) -> None:
    """Two models of the project on the same logs: who is better where, beyond doubt."""
    project = studio.project
    models = [step for step in project.steps if step.model]
    known = {step.number: f"{step.number}  {step.task.title}" for step in models}
    logs = project.parts("test") or project.parts("train")
    if len(known) < 2 or not logs:
        line = "The project has fewer than two models: fit another one, or add an effect first."
        return _lacks(studio, line, "What is missing", "missing")
    with ui.row().classes("items-center"):
        for name, default in zip(("first model", "second model"), known, strict=False):
            _choice(kept, name, known, default, studio.redraw)
    pair = kept["first model"], kept["second model"]
    if pair[0] == pair[1]:
        ui.label("Choose two different models.")
        return None
    judged = commands.judged_on(project, logs)
    wanted = commands.contest(project, pair)
    run_button(studio, "Compare both", lambda: wanted)
    own = [step for step in project.steps if step.task == wanted]
    if own:
        _contest(studio, own[-1])
    files = [f"models/{number}.json" for number in pair]
    found = await studio.view("verdict", files[0], judged)

    async def window(*ends: float) -> Any:
        return await asked(
            studio, "torque_picture", files, judged, kept["joint shown"], *ends, kind="days torque"
        )

    async def torques() -> None:
        picture = await window()
        if picture is not None:
            place.clear()
            with place:
                zooms(studio, figures.draw(picture, _TIME), window)

    with part("Measured and predicted by both"):
        errors = dict(zip(found.joints, found.errors, strict=True))
        joints = {joint: f"joint {joint}" for joint in found.joints}
        _choice(kept, "joint shown", joints, max(errors, key=lambda one: errors[one]), torques)
        place = ui.column().classes("w-full")
        await torques()


def _contest(studio: Studio, step: Step) -> None:
    """What `modeler compare A B LOG...` found."""
    found = studio.result(step)["models"]
    with part("Who is better"):
        for each in found:
            if each["best_on"]:
                joints = ", ".join(each["best_on"])
                ui.label(f"{each['model']} predicts joint {joints} best, beyond doubt.")
        if not any(each["best_on"] for each in found):
            ui.label("No model is better than the other beyond doubt on any joint.")
        rows = []
        for joint in found[0]["joints"]:
            own = [each["joints"][joint] for each in found]
            told = [f"{percent(one['relative_error'])}{' *' * one['best']}" for one in own]
            rows.append([f"joint {joint}", *told])
        table(["", *(each["model"] for each in found)], rows)
        ui.label("*: better than the other beyond doubt.").classes("studio-soft")
    _pictures(studio, step, _TIME)


async def _drift(studio: Studio, kept: dict[str, Any]) -> None:
    """What changes from log to log, machine by machine."""
    project = studio.project
    if not project.robot or len(project.logs) < 2:
        line = "Drift needs a robot and two logs at least, of several days or machines."
        return _lacks(studio, line, "Data", "data")
    parts = [part for log in project.logs for part in _parts(log)]

    def wanted() -> Task:
        return commands.fleet(project, parts, kept.get("pattern", ""))

    def typed(event: Any) -> None:
        kept["pattern"] = event.value.strip()
        renew()

    ui.input("how paths end", value=kept.get("pattern", ""), on_change=typed,
             placeholder="{machine}-{period}.csv").classes("w-80")  # fmt: skip
    ui.label(
        "Left out, the folder of a log is its machine and the file its period, in the order of "
        "their names."
    ).classes("studio-soft")
    renew = run_button(studio, "Look for drift", wanted)
    steps = [step for step in project.steps if step.verb == "fleet"]
    if steps:
        _fleet(studio, steps[-1])
    return None


def _fleet(studio: Studio, step: Step) -> None:
    """What `modeler fleet` found."""
    found = studio.result(step)
    with part("What drifted, leapt or is apart"):
        ui.label(found["verdict"])
        if found["findings"]:
            table(
                ["machine", "what", "how", "from", "to", "change", "certainty"],
                [[one["machine"], one["parameter"], one["shape"], one["from"], one["to"],
                  f"{one['change']:.4g} {one['unit']}", f"{one['score']:.1f} sigma"]
                 for one in found["findings"]],
            )  # fmt: skip
        left = [f"{one['log']} left out: {one['why']}" for one in found["left_out"]]
        for line in [f"{one['sentence']}." for one in found["findings"]]:
            ui.label(line)
        for line in (*found["doubts"], *found["notes"], *left):
            ui.label(line).classes("studio-soft")
    _pictures(studio, step)


def _pictures(studio: Studio, step: Step, time: str = "") -> None:
    """All that a command drew."""
    for picture in pictures_from_json(studio.folder / step.pictures):
        with ui.card().classes("studio-card w-full"):
            figures.draw(picture, time)
