"""Days and machines: two logs under one model, two models on the same logs, and what drifted."""

from collections.abc import Callable
from typing import Any

from nicegui import ui

from modeler.core.json import shown
from modeler.core.picture_file import pictures_from_json
from modeler.core.table import percent
from modeler.studio import commands, figures
from modeler.studio.commands import Asked
from modeler.studio.elements import go_button, head, part, run_button, table
from modeler.studio.fails_screen import asked, zooms
from modeler.studio.project import MAKING, ProjectLog, Step, Stretch
from modeler.studio.studio import Studio

_TIME = "days"  # that pictures of several models share
_EVERY = (Stretch(),)


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

    async def chosen(event: Any) -> None:
        kept["tab"] = event.value
        await shown_now()

    async def shown_now() -> None:
        body.clear()
        with body:
            await {"logs": _logs, "models": _models, "drift": _drift}[kept["tab"]](studio, kept)

    tabs.on_value_change(chosen)
    await shown_now()


def _words(log: ProjectLog) -> list[str]:
    """All of a log but what is left out of it."""
    return [own.word(log.file) for part in _EVERY for own in part.without(log.out)]


def _pair(
    kept: dict[str, Any], name: str, known: dict[str, str], labels: tuple[str, str],
    changed: Callable[[], Any],
) -> tuple[str, str]:  # fmt: skip
    """Two menus of the same things, of which two are chosen; what is chosen now."""
    names = list(known)
    pair = kept.get(name)
    if pair is None or not {*pair} <= {*names}:
        pair = kept[name] = [names[0], names[min(1, len(names) - 1)]]

    def chosen(place: int, value: str) -> None:
        pair[place] = value
        changed()

    for place, label in enumerate(labels):
        menu = ui.select(known, value=pair[place], label=label).classes("w-64")
        menu.on_value_change(lambda event, place=place: chosen(place, event.value))
    return pair[0], pair[1]


async def _logs(studio: Studio, kept: dict[str, Any]) -> None:
    """Errors and residuals of two logs under the current model."""
    project = studio.project
    if not project.model:
        ui.label("There is no model yet: fit one first.")
        go_button(studio, "Fit", "fit")
        return
    if len(project.logs) < 2:
        ui.label("The project has fewer than two logs: add another day or machine first.")
        go_button(studio, "Data", "data")
        return
    known = {log.file: log.file.rpartition("/")[2] for log in project.logs}
    with ui.row().classes("items-center"):
        pair = _pair(kept, "logs", known, ("first log", "second log"), studio.redraw)
    chosen = [log for log in project.logs if log.file in pair]
    words = [word for log in chosen for word in _words(log)]
    run_button(studio, "Compare", lambda: commands.compare(project, words), small=True)
    verdict = await studio.view("verdict", project.model, words)
    errors = await studio.view("log_errors", project.model, words)
    with part("Relative error"):
        rows = [[f"joint {joint}", *(percent(each[joint]) for _, _, each in errors)]
                for joint in verdict.joints]  # fmt: skip
        table(["", *(name for name, _, _ in errors)],
              [*rows, ["all", *(percent(whole) for _, whole, _ in errors)]])  # fmt: skip
    with part("Residuals of both logs"):
        joints = {joint: f"joint {joint}" for joint in verdict.joints}
        channels = dict(verdict.channels)
        kept.setdefault("joint", verdict.joints[0])
        kept.setdefault("channel", "velocity")
        if kept["joint"] not in joints:
            kept["joint"] = verdict.joints[0]
        if kept["channel"] not in channels:
            kept["channel"] = "velocity"
        with ui.row():
            which = ui.select(joints, value=kept["joint"], label="joint").classes("w-40")
            over = ui.select(channels, value=kept["channel"], label="residual over").classes("w-64")
        place = ui.column().classes("w-full")

        async def residuals() -> None:
            kept["joint"], kept["channel"] = which.value, over.value
            picture = await asked(
                studio, "residual_picture", [project.model], words, which.value, over.value, True,
                kind="days",
            )  # fmt: skip
            if picture is not None:
                place.clear()
                with place:
                    figures.draw(picture)

        which.on_value_change(residuals)
        over.on_value_change(residuals)
        await residuals()


async def _models(studio: Studio, kept: dict[str, Any]) -> None:
    """Two models of the project on the same logs: who is better where, beyond doubt."""
    project = studio.project
    models = [step for step in project.steps if step.kind in MAKING]
    known = {step.model: f"{step.number}  {step.title}" for step in models}
    logs = project.words("test") or project.words("train")
    if len(known) < 2 or not logs:
        ui.label("The project has fewer than two models: fit another one, or add an effect first.")
        go_button(studio, "What is missing", "missing")
        return
    with ui.row().classes("items-center"):
        pair = _pair(kept, "models", known, ("first model", "second model"), studio.redraw)
    if pair[0] == pair[1]:
        ui.label("Choose two different models.")
        return
    words = ("compare", *pair, *logs, *commands.guessing(project))
    wanted = Asked("contest", words, "compare two models")
    run_button(studio, "Compare both", lambda: wanted)
    step = _last(studio, "contest", wanted.words)
    if step is not None:
        _contest(studio, step)
    with part("Measured and predicted by both"):
        found = await studio.view("verdict", pair[0], logs)
        joints = {joint: f"joint {joint}" for joint in found.joints}
        if kept.get("of models") not in joints:
            errors = dict(zip(found.joints, found.errors, strict=True))
            kept["of models"] = max(found.joints, key=lambda joint: errors[joint])
        which = ui.select(joints, value=kept["of models"], label="joint").classes("w-40")
        place = ui.column().classes("w-full")

        async def torques() -> None:
            kept["of models"] = which.value

            async def window(*ends: float) -> Any:
                return await asked(
                    studio,
                    "torque_picture",
                    list(pair),
                    logs,
                    which.value,
                    *ends,
                    kind="days torque",
                )

            picture = await window()
            if picture is not None:
                place.clear()
                with place:
                    zooms(studio, figures.draw(picture, _TIME), window)

        which.on_value_change(torques)
        await torques()


def _contest(studio: Studio, step: Step) -> None:
    """What `modeler compare A B LOG...` found."""
    found = studio.result(step)["models"]
    names = [each["model"] for each in found]
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
        table(["", *names], rows)
        ui.label("*: better than the other beyond doubt.").classes("studio-soft")
    _pictures(studio, step, _TIME)


async def _drift(studio: Studio, kept: dict[str, Any]) -> None:
    """What changes from log to log, machine by machine."""
    project = studio.project
    if not project.robot or len(project.logs) < 2:
        ui.label("Drift needs a robot and two logs at least, of several days or machines.")
        go_button(studio, "Data", "data")
        return
    pattern = ui.input("how paths end", placeholder="{machine}-{period}.csv").classes("w-80")
    pattern.value = kept.get("pattern", "")
    ui.label(
        "Left out, the folder of a log is its machine and the file its period, in the order of "
        "their names."
    ).classes("studio-soft")
    logs = [word for log in project.logs for word in _words(log)]
    maps = [word for own in project.mapping for word in ("--map", own)]

    def wanted() -> Asked:
        named = ["--name", kept["pattern"]] if kept.get("pattern") else []
        return Asked(
            "fleet",
            ("fleet", commands.robot_copy(project), *logs, *named, *maps),
            "what drifted",
            about=0,
        )

    renew = run_button(studio, "Look for drift", wanted)

    def typed(event: Any) -> None:
        kept["pattern"] = event.value.strip()
        renew()

    pattern.on_value_change(typed)
    steps = [step for step in project.steps if step.kind == "fleet"]
    if steps:
        _fleet(studio, steps[-1])


def _fleet(studio: Studio, step: Step) -> None:
    """What `modeler fleet` found."""
    found = studio.result(step)
    with part("What drifted, leapt or is apart"):
        ui.label(found["verdict"])
        if found["findings"]:
            table(
                ["machine", "what", "how", "from", "to", "change", "certainty"],
                [[one["machine"], f"{one['parameter']}\t{one['sentence']}", one["shape"],
                  one["from"], one["to"], f"{one['change']:.4g} {one['unit']}",
                  f"{one['score']:.1f} sigma"] for one in found["findings"]],
            )  # fmt: skip
            for one in found["findings"]:
                ui.label(f"{one['sentence']}.")
        for line in (*found["doubts"], *found["notes"]):
            ui.label(line).classes("studio-soft")
        for one in found["left_out"]:
            ui.label(f"{one['log']} left out: {shown(one['why'])}").classes("studio-soft")
    _pictures(studio, step)


def _last(studio: Studio, kind: str, words: tuple[str, ...]) -> Step | None:
    """The last time that this very command was carried out."""
    own = [step for step in studio.project.steps if (step.kind, step.words) == (kind, words)]
    return own[-1] if own else None


def _pictures(studio: Studio, step: Step, time: str = "") -> None:
    """All that a command drew."""
    for picture in pictures_from_json(studio.folder / step.pictures):
        with ui.card().classes("studio-card w-full"):
            figures.draw(picture, time)
