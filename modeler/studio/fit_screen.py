"""The screen "fit": values from the training stretches, and what they are worth, joint by joint."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from nicegui import ui

from modeler.core.builtin import EFFECTS
from modeler.core.errors import TWO_STEPS
from modeler.core.estimators import ABOUT, APART, About
from modeler.core.json import built
from modeler.core.manifest import BaseSpec
from modeler.core.table import percent
from modeler.report import relation
from modeler.studio import commands
from modeler.studio.elements import (
    LIGHTS,
    Light,
    Markup,
    command_line,
    doubt_lines,
    folded,
    go_button,
    head,
    light,
    page_button,
    part,
    run_button,
    table,
    told,
)
from modeler.studio.project import MAKING, Step
from modeler.studio.studio import Studio

_LIGHT: Mapping[str | None, Light] = {"physics": "good", "like motion": "doubtful"}
_WIDTH = 160  # pixels of a drawn value


async def draw(studio: Studio) -> None:
    """Draws it."""
    project = studio.project
    head("Fit", "Base parameters from the training stretches, each with its sigma.")
    if not project.robot or not project.words("train"):
        ui.label("A fit needs a robot, and a stretch of a log that is marked for training.")
        go_button(studio, "To the robot" if not project.robot else "To the data",
                  "robot" if not project.robot else "data")  # fmt: skip
        return
    step = project.step(project.current)
    with part("What is fitted"):
        chosen: dict[str, str] = studio.kept.setdefault("fit", {})
        renew = run_button(
            studio, "Fit", lambda: commands.fit(studio.project, _options(chosen)),
        )  # fmt: skip
        _advanced(studio, chosen, renew)
    if step is None or step.kind not in MAKING or not step.result:
        return
    fit = studio.result(step)
    _stale(studio, step, chosen)
    _verdict(fit)
    _values(fit, studio.model(step))
    _choices(fit)
    with part("More of it"):
        page_button(studio, step)
        run_button(studio, "Physical parameters", partial(commands.physical, project), small=True)
        _physical(studio)
    go_button(studio, "Look for what is missing", "missing")


def _advanced(studio: Studio, chosen: dict[str, str], renew: Any) -> None:
    """Estimator, band, weights: what there is, and what is taken where nothing is said."""
    every = [*ABOUT.values(), *(about for about in APART if about.id == TWO_STEPS)]
    with ui.expansion("Advanced: estimator, band, effects").classes("w-full studio-folded"):
        told = ui.column().classes("gap-1")

        def kept(name: str, value: Any) -> None:
            chosen[name] = "" if value is None else str(value).strip()
            renew()
            if name == "--method":
                told.clear()
                with told:
                    _estimator(next((a for a in every if a.id == value), every[0]))

        with ui.row().classes("items-end w-full"):
            names = {"": "weighted least squares (default)"}
            names |= {about.id: about.title for about in every if about.id != "weighted"}
            ui.select(names, label="estimator", value=chosen.get("--method", ""),
                      on_change=lambda e: kept("--method", e.value)).classes("w-80")  # fmt: skip
            for name, label in _NUMBERS:
                field = ui.input(label, placeholder="chosen", value=chosen.get(name, ""))
                field.on_value_change(lambda e, to=name: kept(to, e.value)).classes("w-56")
            ways = ui.select(["", "log", "position"], label="velocities from")
            ways.set_value(chosen.get("--derivatives", ""))
            ways.on_value_change(lambda e: kept("--derivatives", e.value)).classes("w-40")
            label = "effects, in place of the robot file's"
            own = [effect for effect in chosen.get("--effects", "").split(",") if effect]
            effects = ui.select(list(EFFECTS), label=label, multiple=True, value=own)
            effects.on_value_change(lambda e: kept("--effects", ",".join(e.value or ())))
            effects.classes("w-96").props("use-chips clearable")
        told.move(target_index=-1)
        with told:
            _estimator(next((a for a in every if a.id == chosen.get("--method")), every[0]))


_NUMBERS = (
    ("--cutoff", "position filter [Hz]"),
    ("--parallel-cutoff", "parallel filter [Hz]"),
    ("--low-speed", "low speed [share of top]"),
    ("--essential-below", "essential below [% sigma]"),
)


def _estimator(about: About) -> None:
    ui.label(about.title).classes("studio-part")
    table(("", ""), [("what it solves", about.law), ("source", about.source),
                     ("the wrong one", about.avoid), ("of the motion", about.motion)])  # fmt: skip


def _options(chosen: Mapping[str, str]) -> list[str]:
    return [word for name, value in chosen.items() if value for word in (name, value)]


def _stale(studio: Studio, step: Step, chosen: Mapping[str, str]) -> None:
    """Says where these values are not those of the robot and the stretches as they are now."""
    first = studio.project.path()[0]
    now = commands.fit(studio.project, ())
    copy = next((word for word in first.words if word.startswith("robots/")), "")
    if copy and studio.text(copy) != studio.text(studio.project.robot):
        doubt_lines(["the robot was changed since these values were fitted; fit again"])
    logs = {word for word in now.words if "@" in word or word.startswith("logs/")}
    if logs != {word for word in first.words if "@" in word or word.startswith("logs/")}:
        doubt_lines(["the training stretches were changed since; fit again"])
    with ui.row().classes("items-center no-wrap w-full"):
        ui.label("these values come from").classes("studio-soft")
        command_line(step.words)


def _verdict(fit: Mapping[str, Any]) -> None:
    """Lights of the whole and of every joint, with the reasons."""
    with part("What it is worth"):
        by_joint = fit.get("by_joint") or {}
        every = [_LIGHT.get(fit["usable_for"], "bad"), *(one["light"] for one in by_joint.values())]
        named = [name for name, one in by_joint.items() if one["light"] != "good"]
        worst = max(every, key=LIGHTS.index)
        light(worst, worst + (f": joint {', '.join(named)}" if named else ""))
        ui.label(fit["verdict"] or "nobody has judged this fit")
        with ui.element("div").classes("studio-joints"):
            for name, joint in fit["joints"].items():
                judged = by_joint.get(name, {"light": "doubtful", "reasons": ["not judged"]})
                with ui.card().classes(f"studio-card studio-joint studio-edge-{judged['light']}"):
                    ui.label(f"joint {name}").classes("studio-part")
                    light(judged["light"])
                    left = percent(joint["relative_error"])
                    text = f"{left} of its torque is left, {joint['rms']:.3g} {joint['unit']} rms"
                    ui.label(text).classes("studio-soft")
                    told(judged["reasons"])
        ui.label("Can such a machine be built?").classes("studio-part")
        possible = fit.get("possible")
        if possible is None:
            light("doubtful", "not asked: the logs are at fault first")
        elif possible:
            light("good", "yes: masses, inertias and friction of a possible machine give the same")
        else:
            light("doubtful", "no, see the doubts")
        reasons = {reason for joint in by_joint.values() for reason in joint["reasons"]}
        doubt_lines(line for line in fit["doubts"] if line not in reasons)
        folded("What else is to be known", [*fit["sentences"], *fit.get("unseen", ())])


def _values(fit: Mapping[str, Any], model: Mapping[str, Any]) -> None:
    """The parameters with their sigmas, drawn among those of the same unit."""
    own = [*fit["gains"], *fit["parameters"], *fit["loads"]]
    every = [built(BaseSpec, raw) for raw in model["manifest"]["base"]]
    sums = {base.name: relation(base) for base in every}
    tops: dict[str, float] = {}
    for p in own:
        tops[p["unit"]] = max(tops.get(p["unit"], 0.0), abs(p["value"]) + (p["sigma"] or 0.0))
    with part(f"{len(own)} values"):
        ui.label(
            "The whisker is one sigma to either side, among values of the same unit; a name that "
            "is underlined tells what it is the sum of. Grey: the model does as well without."
        ).classes("studio-soft")
        heads = ("parameter", "value", "sigma", "% sigma", "unit", "")
        rows = [_row(p, sums.get(p["name"], ""), tops[p["unit"]]) for p in own]
        table(heads, rows, [not p["essential"] for p in own])


def _row(p: Mapping[str, Any], relation: str, top: float) -> Sequence[str]:
    name, value, sigma = p["name"], p["value"], p["sigma"]
    shown = f"{name}\t{name} = {relation}" if relation else name
    if sigma is None:
        return (shown, "set aside", "", "", p["unit"], "")
    share = p["relative_sigma_percent"]
    percent = "-" if share is None else f"{share:.3g}" if share < 1e4 else ">10000"
    mark = "" if p["essential"] else " not essential"
    drawn = Markup(_drawn(value, sigma, top))
    return (shown, f"{value:.5g}", f"{sigma:.2g}", percent + mark, p["unit"], drawn)


def _drawn(value: float, sigma: float, top: float) -> str:
    """A dot with a whisker of one sigma on an axis from -top to top."""

    def at(x: float) -> float:
        return (0.5 + 0.48 * x / (top or 1.0)) * _WIDTH

    low, high = at(value - sigma), at(value + sigma)
    said = f"{value:.3g} plus or minus {sigma:.2g}"
    return (
        f'<svg width={_WIDTH} height=14 role=img aria-label="{said}">'
        f'<path d="M{at(0.0):.1f} 0V14" class=studio-axis />'
        f'<path d="M{low:.1f} 7H{high:.1f}M{low:.1f} 3V11M{high:.1f} 3V11" class=studio-whisker />'
        f"<circle cx={at(value):.1f} cy=7 r=3 class=studio-dot /></svg>"
    )


def _choices(fit: Mapping[str, Any]) -> None:
    """What was chosen from the logs, and why."""
    own = fit["processing"]
    bands = fit["bands"] or {"chosen_by": [], "noise": []}
    with part("How the logs were processed, and why"):
        told(bands["chosen_by"])
        rows: list[Sequence[str]] = [
            ("position filter", f"{own['position_cutoff']:g} Hz", _by(own, "position_cutoff")),
            ("parallel filter", f"{own['parallel_cutoff']:g} Hz", _by(own, "parallel_cutoff")),
            ("samples, rows", f"{fit['samples']}, {fit['rows']}", "what the filters leave to know"),
            ("condition number", f"{fit['condition_scaled'] or np.inf:.3g}",
             "of W with columns of length one"),
            *_noise(bands["noise"]),
        ]  # fmt: skip
        table(("", "", ""), rows)


def _by(own: Mapping[str, Any], name: str) -> str:
    return "chosen from the logs" if name in own["chosen"] else "as it was asked for"


def _noise(every: Sequence[Mapping[str, Any]]) -> Iterator[Sequence[str]]:
    for noise in every:
        above = noise["hides_above_hz"]
        yield (f"noise of position {noise['joint']}", f"{noise['deviation']:.2g} {noise['unit']}",
               "" if above is None else f"hides the motion above {above:.3g} Hz")  # fmt: skip


def _physical(studio: Studio) -> None:
    step = studio.project.about("physical")
    if step is None:
        return
    found = studio.result(step)
    own = found.get("easiest_set") or []
    if own:
        told([f"{found['smallest_number']} of {len(found['parameters'])} physical parameters must "
              f"be known that all others follow; measured with the least trouble: "
              f"{', '.join(own)}"])  # fmt: skip
        command_line(("physical", studio.project.model, "--known",
                      ",".join(f"{name}=VALUE" for name in own)))  # fmt: skip
