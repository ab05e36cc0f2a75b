"""The screen "what is missing": effects ranked, tried as a ghost, added, or banned for good."""

import contextlib
import dataclasses
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from nicegui import ui

from modeler.core.errors import ModelerError
from modeler.core.figure import Picture
from modeler.core.picture_file import pictures_from_json
from modeler.core.table import percent, printed
from modeler.effects import CATALOGUE, effect_named
from modeler.estimation import spread_text
from modeler.studio import commands, elements, figures
from modeler.studio.elements import Light
from modeler.studio.fails_screen import zooms
from modeler.studio.project import Project
from modeler.studio.studio import Studio
from modeler.studio.tasks import Step, Task

Found = Mapping[str, Any]
"""An effect, as the JSON of a diagnosis has it."""

_STATUS: Mapping[str, tuple[Light, str]] = {
    "fact": ("good", "fact: it is stated as missing"),
    "named": ("good", "named: large enough and sure enough to go in"),
    "perhaps": ("doubtful", "perhaps"),
}
_RANKS = ("fact", "named", "perhaps")


async def draw(studio: Studio) -> None:
    """Draws it."""
    project = studio.project
    elements.head(
        "What is missing", "Which physical effect the model lacks, on which joint, how large."
    )
    if not project.model:
        elements.lacks_model(studio)
        return
    step = project.about("diagnose")
    elements.stale(studio)
    with elements.part("Look"):
        elements.run_button(studio, "Look", lambda: commands.diagnose(studio.project))
        _bans(studio)
    if step is not None:
        if commands.diagnose(project) != step.task:
            elements.doubt_lines(
                ["stretches or bans were changed since this was found; look again"]
            )
        await _diagnosis(studio, step)
    _by_hand(studio)


async def _diagnosis(studio: Studio, step: Step) -> None:
    """What was found, ranked, and what the data cannot tell."""
    found, project = studio.result(step), studio.project
    kind = "held-out error" if step.task.held else "cross-validated error"
    named = {(one["effect"], one["joint"]) for one in found["effects"]}
    every = [*found["effects"], *found["refinements"]]
    pictures: Mapping[str, Picture] = {}
    with contextlib.suppress(ModelerError):  # a page of words is a page
        pictures = {p.name: p for p in pictures_from_json(studio.folder / step.pictures)}
    with elements.part(f"Verdict: {found['verdict']}"):
        elements.told(found["sentences"] if not every else found["sentences"][:1])
        elements.doubt_lines(found["data"] if every else ())  # else the sentences say it
        if every:
            elements.folded("In the words of the command", found["sentences"])
        else:
            _left(found["joints"], kind)
    ranked = sorted(every, key=lambda one: _RANKS.index(one["status"]))
    for one in ranked:
        refines = (one["effect"], one["joint"]) not in named
        await _card(studio, one, pictures, refines, kind, first=one is ranked[0])
    with elements.part("What else"):
        if any(one["status"] != "perhaps" for one in every):
            every_one = partial(commands.add, project, "auto", None)
            then = partial(_taken, studio)
            elements.run_button(studio, "Add all that is named", every_one, then, small=True)
        rivals = [(_at(rival), percent(rival["gain"])) for rival in found["rivals"]]
        blind = [(_at(one), _words(one["effect"], "look_alikes")) for one in found["blind_spots"]]
        elements.folded("Rivals that explain less", rivals, "effect", "of the residual's variance")
        elements.folded("What these logs cannot show", blind, "effect", "it is mistaken for")
        elements.page_button(studio, step)


async def _card(
    studio: Studio, one: Found, pictures: Mapping[str, Picture], refines: bool, kind: str,
    first: bool,
) -> None:  # fmt: skip
    """One effect: what it is, how large, what it gains, why, and what to do with it."""
    effect, joint = one["effect"], one["joint"]
    which, status = _STATUS[one["status"]]
    with elements.part(f"{_words(effect)}: {f'joint {joint}' if joint else 'the whole robot'}"):
        with ui.row().classes("items-center"):
            elements.light(which, f"{status}: {one['doubt']}" if one["doubt"] else status)
            ui.label(f"id {effect}").classes("studio-soft")
            if refines:
                ui.label("refines a law of the model").classes("studio-soft")
        with ui.row().classes("items-baseline"):
            ui.label(_fall(one["error_before"], one["error_after"])).classes("studio-figure")
            ui.label(f"{kind} of its joints, without and with it")
        law = effect_named(effect)
        meant = (
            {}
            if law is None
            else {shape.name: f": {shape.meaning}" for form in law.forms for shape in form.shapes}
        )
        for name, value in one["parameters"].items():
            ui.label(f"{name} = {_value(one, name, value)}{meant.get(name, '')}")
        ui.label(one["evidence"])
        elements.doubt_lines([one["objection"]] if one["objection"] else [])
        if one["ties"]:
            others = "; ".join(map(_at, one["ties"]))
            elements.doubt_lines([f"these data do not tell it from: {others}"])
            elements.go_button(studio, "The motion that tells them apart", "motion")
        _deeds(studio, effect, joint)
        await _ghost(studio, effect, joint)
        names = [f"{kind}_{effect}_{joint or 'robot'}" for kind in ("evidence", "torque")]
        _evidence([pictures[name] for name in names if name in pictures], unfolded=first)


def _evidence(pictures: Sequence[Picture], unfolded: bool) -> None:
    """Of the first effect at once, of others when they are asked for: closed they have no size."""
    with ui.expansion("Evidence", value=unfolded).classes("w-full studio-folded") as folded:
        inside = ui.column().classes("w-full")

    def opened() -> None:
        inside.clear()
        with inside:
            for picture in pictures:
                figures.draw(picture)

    folded.on("show", opened)
    if unfolded:
        opened()


def _value(one: Found, name: str, value: float | None) -> str:
    if value is None:
        return "not known"
    sigma, unit = one["sigmas"].get(name) or 0.0, one["units"].get(name, "")
    interval = one["intervals"].get(name)
    spread = spread_text(value, sigma, None if interval is None else (interval[0], interval[1]))
    return f"{value:.4g}{spread} {'' if unit == '1' else unit}".replace("+-", "\u00b1")


def _fall(before: float | None, after: float | None) -> str:
    if before is None or after is None:
        return "it is not known from these logs"
    return " \u2192 ".join(printed(before, after))


def _deeds(studio: Studio, effect: str, joint: str | None) -> None:
    """Preview, add, ban."""
    asked = partial(commands.add, studio.project, effect, joint)
    ready = tried(studio.project, effect, joint)
    if ready is None:
        elements.run_button(studio, "Preview", asked, current=False, small=True)
        elements.run_button(studio, "Add", asked, partial(_taken, studio), small=True)
    else:
        with ui.row().classes("items-center no-wrap w-full"):
            button = ui.button("Add", on_click=lambda: _taken(studio, ready))
            elements.busy_with(studio, button.props("no-caps unelevated"))
            elements.step_line(studio, ready)
    with ui.row():
        for ban in dict.fromkeys([f"{effect}@{joint}" if joint else effect, effect]):
            where = "this joint" if "@" in ban else "this robot"
            button = ui.button(f"Not on {where}", on_click=lambda _, ban=ban: _banned(studio, ban))
            elements.busy_with(studio, button.props("no-caps flat dense icon=block"))


def tried(project: Project, effect: str, joint: str | None) -> Step | None:
    """The step that has added an effect to the current model, as it would be added now."""
    asked = commands.add(project, effect, joint)
    own = [step for step in project.steps if step.parent == project.current]
    return next((step for step in reversed(own) if step.task == asked), None)


def _taken(studio: Studio, step: Step) -> None:
    """The model of a step is the current one, and one sees the error fall."""
    if studio.project.current == step.number or studio.take(step):
        studio.go("fall")


def _banned(studio: Studio, ban: str) -> None:
    others = [own for own in studio.project.without if own.partition("@")[0] != ban]
    studio.change(redraw=True, without=tuple(dict.fromkeys([*others, ban])))


def _bans(studio: Studio) -> None:
    """What this robot does not have, each to be taken back."""
    if not studio.project.without:
        return
    with ui.row().classes("items-center"):
        ui.label("not on this robot:").classes("studio-soft")
        for ban in studio.project.without:
            left = tuple(own for own in studio.project.without if own != ban)
            button = ui.button(ban, on_click=lambda _, left=left: studio.change(True, without=left))
            button.props("no-caps outline dense icon=close")
            button.props["aria-label"] = f"take back the ban of {ban}"
            elements.busy_with(studio, button)


async def _ghost(studio: Studio, effect: str, joint: str | None) -> None:
    """Measured, predicted, and predicted with the effect, once it was tried; both errors."""
    project = studio.project
    step = tried(project, effect, joint)
    if step is None:
        return
    logs = commands.judged_on(project, project.parts("test") or project.parts("train"))
    models = [project.model, step.model]
    verdicts = [await studio.view("verdict", model, logs) for model in models]
    before, after = (dict(zip(own.joints, own.errors, strict=True)) for own in verdicts)
    falls = {name: (before[name], after[name]) for name in before if name in after}
    most = max(falls, key=lambda name: falls[name][0] - falls[name][1])
    shown = joint if joint in falls else most
    where = "held-out" if project.words("test") else "fitted"
    ui.label(f"Error on the {where} logs, without and with it:").classes("studio-soft")
    elements.told(f"joint {name}: {_fall(*errors)}" for name, errors in falls.items())

    async def window(*ends: float) -> Picture:
        picture: Picture = await studio.view("torque_picture", models, logs, shown, *ends)
        return picture

    plot = figures.draw(_named(await window(), models, _words(effect)), "ghost")
    zooms(studio, plot, window)


def _named(picture: Picture, models: Sequence[str], effect: str) -> Picture:
    """With what its models are called."""
    before, after = (f"model {Path(model).stem}" for model in models)
    title, caption = f"Preview. {picture.title}", f"{before}: as it is; {after}: with {effect}"
    return dataclasses.replace(picture, title=title, caption=caption)


def _left(joints: Mapping[str, Mapping[str, float | None]], kind: str) -> None:
    """Where nothing is missing: what is left of each joint's torque."""
    names = ("error_before", "explained", "systematic", "noise")
    rows = [(joint, *(percent(own[name]) for name in names)) for joint, own in joints.items()]
    elements.table(("joint", kind, "explained", "of physics", "noise (of the variance)"), rows)


def _by_hand(studio: Studio) -> None:
    """Any effect of the catalogue, found by its id or in plain words."""
    with elements.part("Any effect of the catalogue"):
        names = {effect.id: f"{effect.title} ({effect.id})" for effect in CATALOGUE}
        chosen = studio.kept.setdefault("by hand", {"effect": "viscous", "joint": ""})
        manifest = studio.model(studio.made)["manifest"]
        joints = [joint["name"] for joint in manifest["joints"]]
        passive = (manifest["closure"] or {}).get("variables", ())
        joints += [name for name in passive if name not in joints]
        about = ui.label().classes("studio-soft")
        with ui.row().classes("items-end"):
            effect = ui.select(names, label="effect", value=chosen["effect"], with_input=True)
            joint = ui.select({"": "where it explains most", **{j: f"joint {j}" for j in joints}},
                              label="joint", value=chosen["joint"])  # fmt: skip
            ban = ui.button("Not on this robot", on_click=lambda: _banned(studio, word()))
            elements.busy_with(studio, ban.props("no-caps flat icon=block"))
        effect.classes("w-96")
        joint.classes("w-56")

        def asked() -> Task:
            return commands.add(studio.project, chosen["effect"], chosen["joint"] or None)

        def word() -> str:
            own, place = chosen["effect"], chosen["joint"]
            return f"{own}@{place}" if place else own

        renew = elements.run_button(studio, "Add it", asked, partial(_taken, studio), small=True)

        def changed() -> None:
            chosen["effect"], chosen["joint"] = effect.value or "viscous", joint.value or ""
            parts = [_words(chosen["effect"], what) for what in ("equation", "signature")]
            about.text = "; ".join(parts)
            renew()

        effect.on_value_change(changed)
        joint.on_value_change(changed)
        changed()


def _words(name: str, what: str = "title") -> str:
    """What the catalogue says of an effect; the id of one that only the robot file defines."""
    effect = effect_named(name)
    return name if effect is None else str(getattr(effect, what))


def _at(one: Mapping[str, str | None]) -> str:
    """An effect in words, and its joint."""
    return f"{_words(str(one['effect']))}, joint {one['joint'] or 'all'}"
