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
from modeler.studio.comparison_screens import draw_zoomable, load_torque
from modeler.studio.elements import Light, add_button, draw_note
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
"""Light and word of a status; the surest first."""


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
            line = "segments or bans were changed since this was found; diagnose again"
            elements.draw_warnings([line])
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
    ranked = sorted(every, key=lambda one: [*_STATUS].index(one["status"]))
    for one in ranked:
        refines = (one["effect"], one["joint"]) not in effect_keys
        await _draw_card(studio, one, pictures, refines, kind, first=one is ranked[0])
    with elements.add_card("What else"):
        if any(one["status"] != "possible" for one in every):
            every_one = partial(commands.add, project, "auto", None)
            then = partial(_accept_step, studio)
            elements.add_run_button(studio, "Add all that is named", every_one, then, small=True)
        others = [
            (_describe_place(one), format_percent(one["gain"])) for one in result["alternatives"]
        ]
        hidden = [
            (_describe_place(one), _describe_effect(one["effect"], "confounders"))
            for one in result["undetectable"]
        ]
        heads = "effect", "of the residual's variance"
        elements.draw_folded("Alternatives that explain less", others, *heads)
        elements.draw_folded("Undetectable in these logs", hidden, "effect", "confounders")
        elements.add_page_button(studio, step)


async def _draw_card(
    studio: Studio,
    one: Found,
    pictures: Mapping[str, Picture],
    refines: bool,
    kind: str,
    first: bool,
) -> None:
    """One effect: what it is, how large, what it gains, why, and what to do with it."""
    effect, joint = one["effect"], one["joint"]
    which, status = _STATUS[one["status"]]
    where = f"joint {joint}" if joint else "the whole robot"
    with elements.add_card(f"{_describe_effect(effect)}: {where}"):
        with ui.row().classes("items-center"):
            elements.draw_light(which, f"{status}: {one['warning']}" if one["warning"] else status)
            draw_note(f"id {effect}")
            if refines:
                draw_note("refines a term of the model")
        with ui.row().classes("items-baseline"):
            errors = _format_errors(one["error_before"], one["error_after"])
            ui.label(errors).classes("studio-figure")
            ui.label(f"{kind} of its joints, without and with it")
        known = find_effect(effect)
        forms = () if known is None else known.forms
        every = [parameter for form in forms for parameter in form.nonlinear_parameters]
        meanings = {parameter.name: f": {parameter.meaning}" for parameter in every}
        for name, value in one["parameters"].items():
            ui.label(f"{name} = {_format_value(one, name, value)}{meanings.get(name, '')}")
        ui.label(one["evidence"])
        elements.draw_warnings([one["caveat"]] if one["caveat"] else [])
        if one["ties"]:
            others = "; ".join(map(_describe_place, one["ties"]))
            elements.draw_warnings([f"equivalent in these data: {others}"])
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
        accept = partial(_accept_step, studio)
        elements.add_run_button(studio, "Add", build_task, accept, small=True)
    else:
        with ui.row().classes("items-center no-wrap w-full"):
            button = add_button("Add", lambda: _accept_step(studio, ready), "unelevated")
            elements.disable_while_busy(studio, button)
            elements.draw_step_line(studio, ready)
    with ui.row():
        for ban in dict.fromkeys([f"{effect}@{joint}" if joint else effect, effect]):
            where = "this joint" if "@" in ban else "this robot"
            act = partial(_add_ban, studio, ban)
            button = add_button(f"Not on {where}", act, "flat dense icon=block")
            elements.disable_while_busy(studio, button)


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
    others = [other for other in studio.project.without if other.partition("@")[0] != ban]
    studio.change_project(redraw=True, without=tuple(dict.fromkeys([*others, ban])))


def _draw_bans(studio: Studio) -> None:
    """What this robot does not have, each to be taken back."""
    if not studio.project.without:
        return
    with ui.row().classes("items-center"):
        draw_note("not on this robot:")
        for ban in studio.project.without:
            left = tuple(other for other in studio.project.without if other != ban)
            act = partial(studio.change_project, True, without=left)
            button = add_button(ban, act, "outline dense icon=close")
            button.props["aria-label"] = f"take back the ban of {ban}"
            elements.disable_while_busy(studio, button)


async def _draw_preview(studio: Studio, effect: str, joint: str | None) -> None:
    """Measured, predicted, and predicted with the effect, once it was tried; both errors."""
    project = studio.project
    step = find_trial(project, effect, joint)
    if step is None:
        return
    logs = commands.build_viewer_words(project, project.collect_judged_parts())
    models = [project.model_file, step.model_file]
    verdicts = [await studio.ask_viewer("verdict", model, logs) for model in models]
    before, after = (dict(zip(verdict.joints, verdict.errors, strict=True)) for verdict in verdicts)
    falls = {name: (before[name], after[name]) for name in before if name in after}
    most = max(falls, key=lambda name: falls[name][0] - falls[name][1])
    shown_joint = joint if joint is not None and joint in falls else most
    where = "held-out" if project.collect_words("test") else "fitted"
    draw_note(f"Error on the {where} logs, without and with it:")
    elements.draw_lines(f"joint {name}: {_format_errors(*both)}" for name, both in falls.items())
    load = partial(load_torque, studio, models, logs, shown_joint)
    picture = await load()
    if picture is not None:
        old, new = (f"model {Path(model).stem}" for model in models)
        title = f"Preview. {picture.title}"
        caption = f"{old}: as it is; {new}: with {_describe_effect(effect)}"
        picture = dataclasses.replace(picture, title=title, caption=caption)
        draw_zoomable(picture, f"preview of {effect} {joint}", load)


def _draw_remainder(joints: Mapping[str, Mapping[str, float | None]], kind: str) -> None:
    """Where nothing is missing: what is left of each joint's torque."""
    names = ("error_before", "explained_share", "systematic_share", "noise_share")
    rows = [(j, *(format_percent(shares[n]) for n in names)) for j, shares in joints.items()]
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
        about = draw_note("")

        def ban_chosen() -> None:
            _add_ban(studio, "@".join(filter(None, (chosen["effect"], chosen["joint"]))))

        with ui.row().classes("items-end"):
            effect = ui.select(names, label="effect", value=chosen["effect"], with_input=True)
            places = {"": "where it explains most", **{name: f"joint {name}" for name in joints}}
            joint = ui.select(places, label="joint", value=chosen["joint"])
            ban = add_button("Not on this robot", ban_chosen, "flat icon=block")
            elements.disable_while_busy(studio, ban)
        effect.classes("w-96")
        joint.classes("w-56")

        def build_task() -> Task:
            return commands.add(studio.project, chosen["effect"], chosen["joint"] or None)

        accept = partial(_accept_step, studio)
        renew = elements.add_run_button(studio, "Add it", build_task, accept, small=True)

        def update_choice() -> None:
            chosen["effect"], chosen["joint"] = effect.value or "viscous", joint.value or ""
            words = (_describe_effect(chosen["effect"], what) for what in ("equation", "signature"))
            about.text = "; ".join(words)
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
    logs = commands.build_viewer_words(project, project.collect_judged_parts())
    where = " on held-out motion" if project.collect_words("test") else ""
    with elements.add_card(f"What is left{where}"):
        verdict = await studio.ask_viewer("verdict", project.model_file, logs)
        for joint, error, kind, sentence in zip(
            verdict.joints, verdict.errors, verdict.kinds, verdict.sentences, strict=True
        ):
            elements.draw_residual_state(joint, error, kind)
            draw_note(sentence)
        elements.add_page_button(studio, path[-1])
    with ui.row():
        elements.add_go_button(studio, "Diagnose", "missing")
        elements.add_go_button(studio, "Export", "take")


def _read_waterfall(studio: Studio, step: Step) -> Sequence[Mapping[str, Any]]:
    """Errors after each effect; of a fit none."""
    return list(studio.read_result(step).get("waterfall", ()))


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
            line = "that effect came with others in one step; go back a step, and add one by one"
            studio.show_error(line)

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
            act = partial(_restore_step, studio, step)
            button = add_button(action, act, "outline dense icon=history")
            elements.disable_while_busy(studio, button)
        else:
            draw_note("you are here")
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
