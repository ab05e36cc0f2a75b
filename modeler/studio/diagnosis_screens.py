"""The screens of missing effects, ranked and added, and of the error after every step."""

import contextlib
import dataclasses
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from nicegui import ui

from modeler.api.front_end import (
    CATALOGUE,
    ModelerError,
    Picture,
    find_effect,
    format_error_pair,
    format_percent,
    format_spread,
    read_pictures,
)
from modeler.studio import commands, elements, figures
from modeler.studio.commands import build_viewer_words
from modeler.studio.comparison_screens import connect_zoom
from modeler.studio.elements import Light
from modeler.studio.project import Project
from modeler.studio.studio import Studio
from modeler.studio.tasks import Step, Task

Found = Mapping[str, Any]
"""An effect, as the JSON of a diagnosis has it."""

_STATUS: Mapping[str, tuple[Light, str]] = {
    "confirmed": ("good", "Confirmed"),
    "likely": ("good", "Likely"),
    "possible": ("doubtful", "Possible"),
}
_RANKS = ("confirmed", "likely", "possible")


async def draw_missing(studio: Studio) -> None:
    """Draws the screen of what is missing in the model."""
    project = studio.project
    elements.draw_head(
        "What is missing", "Which physical effect the model lacks, on which joint, how large."
    )
    if not project.model_file:
        elements.explain_missing_model(studio)
        return
    step = project.find_step_about("diagnose")
    elements.draw_stale_warnings(studio)
    with elements.add_card("Diagnose"):
        elements.add_run_button(studio, "Diagnose", lambda: commands.diagnose(studio.project))
        _draw_bans(studio)
    if step is not None:
        if commands.diagnose(project) != step.task:
            elements.draw_warnings(
                ["segments or bans were changed since this was found; diagnose again"]
            )
        await _draw_diagnosis(studio, step)
    _draw_catalogue(studio)


async def _draw_diagnosis(studio: Studio, step: Step) -> None:
    """What was found, ranked, and what the data cannot show."""
    result, project = studio.read_result(step), studio.project
    kind = "held-out error" if step.task.held else "cross-validated error"
    effect_keys = {(one["effect"], one["joint"]) for one in result["effects"]}
    every = [*result["effects"], *result["refinements"]]
    pictures: Mapping[str, Picture] = {}
    with contextlib.suppress(ModelerError):  # a page of words is a page
        pictures = {p.name: p for p in read_pictures(studio.folder / step.pictures_file)}
    with elements.add_card(f"Verdict: {result['verdict']}"):
        elements.draw_lines(result["sentences"] if not every else result["sentences"][:1])
        elements.draw_warnings(
            result["data_warnings"] if every else ()
        )  # else the sentences say it
        if every:
            elements.draw_folded("Command output", result["sentences"])
        else:
            _draw_remainder(result["joints"], kind)
    ranked = sorted(every, key=lambda one: _RANKS.index(one["status"]))
    for one in ranked:
        refines = (one["effect"], one["joint"]) not in effect_keys
        await _draw_card(studio, one, pictures, refines, kind, first=one is ranked[0])
    with elements.add_card("What else"):
        if any(one["status"] != "possible" for one in every):
            every_one = partial(commands.add, project, "auto", None)
            then = partial(_accept_step, studio)
            elements.add_run_button(studio, "Add all that is named", every_one, then, small=True)
        rivals = [
            (_describe_place(rival), format_percent(rival["gain"]))
            for rival in result["alternatives"]
        ]
        blind = [
            (_describe_place(one), _describe_effect(one["effect"], "confounders"))
            for one in result["undetectable"]
        ]
        elements.draw_folded(
            "Alternatives that explain less", rivals, "effect", "of the residual's variance"
        )
        elements.draw_folded("What these logs cannot show", blind, "effect", "it is mistaken for")
        elements.add_page_button(studio, step)


async def _draw_card(
    studio: Studio, one: Found, pictures: Mapping[str, Picture], refines: bool, kind: str,
    first: bool,
) -> None:  # fmt: skip
    """One effect: what it is, how large, what it gains, why, and what to do with it."""
    effect, joint = one["effect"], one["joint"]
    which, status = _STATUS[one["status"]]
    with elements.add_card(
        f"{_describe_effect(effect)}: {f'joint {joint}' if joint else 'the whole robot'}"
    ):
        with ui.row().classes("items-center"):
            elements.draw_light(which, f"{status}: {one['warning']}" if one["warning"] else status)
            ui.label(f"id {effect}").classes("studio-soft")
            if refines:
                ui.label("refines a law of the model").classes("studio-soft")
        with ui.row().classes("items-baseline"):
            ui.label(_format_errors(one["error_before"], one["error_after"])).classes(
                "studio-figure"
            )
            ui.label(f"{kind} of its joints, without and with it")
        law = find_effect(effect)
        meanings = (
            {}
            if law is None
            else {
                shape.name: f": {shape.meaning}"
                for form in law.forms
                for shape in form.nonlinear_parameters
            }
        )
        for name, value in one["parameters"].items():
            ui.label(f"{name} = {_format_value(one, name, value)}{meanings.get(name, '')}")
        ui.label(one["evidence"])
        elements.draw_warnings([one["caveat"]] if one["caveat"] else [])
        if one["ties"]:
            others = "; ".join(map(_describe_place, one["ties"]))
            elements.draw_warnings([f"these data do not distinguish it from: {others}"])
            elements.add_go_button(studio, "The motion that distinguishes them", "motion")
        _draw_actions(studio, effect, joint)
        await _draw_preview(studio, effect, joint)
        names = [f"{kind}_{effect}_{joint or 'robot'}" for kind in ("evidence", "torque")]
        _draw_evidence([pictures[name] for name in names if name in pictures], unfolded=first)


def _draw_evidence(pictures: Sequence[Picture], unfolded: bool) -> None:
    """Of the first effect at once, of others when they are requested: closed they have no size."""
    with ui.expansion("Evidence", value=unfolded).classes("w-full studio-folded") as folded:
        inside = ui.column().classes("w-full")

    def draw_pictures() -> None:
        inside.clear()
        with inside:
            for picture in pictures:
                figures.draw_picture(picture)

    folded.on("show", draw_pictures)
    if unfolded:
        draw_pictures()


def _format_value(one: Found, name: str, value: float | None) -> str:
    if value is None:
        return "not known"
    sigma, unit = one["sigmas"].get(name) or 0.0, one["units"].get(name, "")
    interval = one["intervals"].get(name)
    spread = format_spread(value, sigma, None if interval is None else (interval[0], interval[1]))
    return f"{value:.4g}{spread} {'' if unit == '1' else unit}".replace("+-", "\u00b1")


def _format_errors(before: float | None, after: float | None) -> str:
    if before is None or after is None:
        return "it is not known from these logs"
    return " \u2192 ".join(format_error_pair(before, after))


def _draw_actions(studio: Studio, effect: str, joint: str | None) -> None:
    """Preview, add, ban."""
    build_task = partial(commands.add, studio.project, effect, joint)
    ready = find_trial(studio.project, effect, joint)
    if ready is None:
        elements.add_run_button(studio, "Preview", build_task, current=False, small=True)
        elements.add_run_button(
            studio, "Add", build_task, partial(_accept_step, studio), small=True
        )
    else:
        with ui.row().classes("items-center no-wrap w-full"):
            button = ui.button("Add", on_click=lambda: _accept_step(studio, ready))
            elements.disable_while_busy(studio, button.props("no-caps unelevated"))
            elements.draw_step_line(studio, ready)
    with ui.row():
        for ban in dict.fromkeys([f"{effect}@{joint}" if joint else effect, effect]):
            where = "this joint" if "@" in ban else "this robot"
            button = ui.button(f"Not on {where}", on_click=lambda _, ban=ban: _add_ban(studio, ban))
            elements.disable_while_busy(studio, button.props("no-caps flat dense icon=block"))


def find_trial(project: Project, effect: str, joint: str | None) -> Step | None:
    """Finds the step that added an effect to the current model with the same options."""
    task = commands.add(project, effect, joint)
    child_steps = [step for step in project.steps if step.parent == project.current]
    return next((step for step in reversed(child_steps) if step.task == task), None)


def _accept_step(studio: Studio, step: Step) -> None:
    """The model of a step is the current one, and one sees the error fall."""
    if studio.project.current == step.number or studio.take_step(step):
        studio.open_screen("fall")


def _add_ban(studio: Studio, ban: str) -> None:
    others = [
        other_ban for other_ban in studio.project.without if other_ban.partition("@")[0] != ban
    ]
    studio.change_project(redraw=True, without=tuple(dict.fromkeys([*others, ban])))


def _draw_bans(studio: Studio) -> None:
    """What this robot does not have, each to be taken back."""
    if not studio.project.without:
        return
    with ui.row().classes("items-center"):
        ui.label("not on this robot:").classes("studio-soft")
        for ban in studio.project.without:
            left = tuple(other_ban for other_ban in studio.project.without if other_ban != ban)
            button = ui.button(
                ban, on_click=lambda _, left=left: studio.change_project(True, without=left)
            )
            button.props("no-caps outline dense icon=close")
            button.props["aria-label"] = f"take back the ban of {ban}"
            elements.disable_while_busy(studio, button)


async def _draw_preview(studio: Studio, effect: str, joint: str | None) -> None:
    """Measured, predicted, and predicted with the effect, once it was tried; both errors."""
    project = studio.project
    step = find_trial(project, effect, joint)
    if step is None:
        return
    logs = commands.build_viewer_words(
        project, project.collect_parts("test") or project.collect_parts("train")
    )
    models = [project.model_file, step.model_file]
    verdicts = [await studio.ask_viewer("verdict", model, logs) for model in models]
    before, after = (dict(zip(verdict.joints, verdict.errors, strict=True)) for verdict in verdicts)
    falls = {name: (before[name], after[name]) for name in before if name in after}
    most = max(falls, key=lambda name: falls[name][0] - falls[name][1])
    shown_joint = joint if joint in falls else most
    where = "held-out" if project.collect_words("test") else "fitted"
    ui.label(f"Error on the {where} logs, without and with it:").classes("studio-soft")
    elements.draw_lines(
        f"joint {name}: {_format_errors(*errors)}" for name, errors in falls.items()
    )

    async def load_window(*ends: float) -> Picture:
        picture: Picture = await studio.ask_viewer(
            "torque_picture", models, logs, shown_joint, *ends
        )
        return picture

    plot = figures.draw_picture(
        _add_model_names(await load_window(), models, _describe_effect(effect)), "ghost"
    )
    connect_zoom(studio, plot, load_window)


def _add_model_names(picture: Picture, models: Sequence[str], effect: str) -> Picture:
    """With what its models are called."""
    before, after = (f"model {Path(model).stem}" for model in models)
    title, caption = f"Preview. {picture.title}", f"{before}: as it is; {after}: with {effect}"
    return dataclasses.replace(picture, title=title, caption=caption)


def _draw_remainder(joints: Mapping[str, Mapping[str, float | None]], kind: str) -> None:
    """Where nothing is missing: what is left of each joint's torque."""
    names = ("error_before", "explained_share", "systematic_share", "noise_share")
    rows = [
        (joint, *(format_percent(shares[name]) for name in names))
        for joint, shares in joints.items()
    ]
    elements.draw_table(("joint", kind, "explained", "of physics", "noise (of the variance)"), rows)


def _draw_catalogue(studio: Studio) -> None:
    """Any effect of the catalogue, found by its id or in plain words."""
    with elements.add_card("Any effect of the catalogue"):
        names = {effect.id: f"{effect.title} ({effect.id})" for effect in CATALOGUE}
        chosen = studio.state.setdefault("by hand", {"effect": "viscous", "joint": ""})
        manifest = studio.read_model(studio.model_step)["manifest"]
        joints = [joint["name"] for joint in manifest["joints"]]
        passive = (manifest["closure"] or {}).get("variables", ())
        joints += [name for name in passive if name not in joints]
        about = ui.label().classes("studio-soft")
        with ui.row().classes("items-end"):
            effect = ui.select(names, label="effect", value=chosen["effect"], with_input=True)
            joint = ui.select({"": "where it explains most", **{j: f"joint {j}" for j in joints}},
                              label="joint", value=chosen["joint"])  # fmt: skip
            ban = ui.button("Not on this robot", on_click=lambda: _add_ban(studio, build_ban()))
            elements.disable_while_busy(studio, ban.props("no-caps flat icon=block"))
        effect.classes("w-96")
        joint.classes("w-56")

        def build_task() -> Task:
            return commands.add(studio.project, chosen["effect"], chosen["joint"] or None)

        def build_ban() -> str:
            effect_id, place = chosen["effect"], chosen["joint"]
            return f"{effect_id}@{place}" if place else effect_id

        renew = elements.add_run_button(
            studio, "Add it", build_task, partial(_accept_step, studio), small=True
        )

        def update_choice() -> None:
            chosen["effect"], chosen["joint"] = effect.value or "viscous", joint.value or ""
            parts = [_describe_effect(chosen["effect"], what) for what in ("equation", "signature")]
            about.text = "; ".join(parts)
            renew()

        effect.on_value_change(update_choice)
        joint.on_value_change(update_choice)
        update_choice()


def _describe_effect(name: str, what: str = "title") -> str:
    """What the catalogue says of an effect; the id of one that only the robot file defines."""
    effect = find_effect(name)
    return name if effect is None else str(getattr(effect, what))


def _describe_place(one: Mapping[str, str | None]) -> str:
    """An effect in words, and its joint."""
    return f"{_describe_effect(str(one['effect']))}, joint {one['joint'] or 'all'}"


async def draw_history(studio: Studio) -> None:
    """Draws the screen of how the error fell, effect after effect."""
    project, path = studio.project, studio.project.collect_path()
    elements.draw_head(
        "Error history",
        "The error after every step. Press a bar, or a step, to go back to it: the robot file goes "
        "along, unless it was edited since.",
    )
    if not path:
        elements.explain_missing_model(studio)
        return
    elements.draw_stale_warnings(studio)
    with elements.add_card("History"):
        _draw_pictures(studio, path)
        for step in path:
            _draw_step(studio, step, "" if step is path[-1] else f"Undo to step {step.number}")
    aside = [step for step in project.steps if step.model_file and step not in path]
    if aside:
        with elements.add_card("Other branches"):
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
        f"{one['effect']} {one['joint'] or ''}: the error does not fall significantly with it"
        for one in _read_waterfall(studio, path[-1])
        if not one["is_improvement"]
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
    kind = "held-out" if last["held_out_logs"] else "cross-validated"
    return f"{kind} error {format_percent(last['error'])}, rms over the joints"


def _restore_step(studio: Studio, step: Step) -> None:
    if studio.hub.running is not None and not studio.hub.gives_way:  # it is about the current model
        title = studio.hub.running.title
        studio.show_error(f"step {step.number}: {title} runs still; wait for it, or cancel it")
    elif studio.take_step(step):
        studio.show_error("")
