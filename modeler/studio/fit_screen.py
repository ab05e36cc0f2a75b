"""The screen "fit": values from the training stretches, and what they are worth, joint by joint."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from nicegui import ui

from modeler.core.builtin import EFFECTS
from modeler.core.errors import TWO_STEPS
from modeler.core.estimators import ABOUT, APART
from modeler.core.json import built
from modeler.core.manifest import BaseSpec
from modeler.core.table import percent
from modeler.report import relation
from modeler.robot import robot_from_text
from modeler.studio import commands, elements
from modeler.studio.elements import LIGHTS, Light, Markup, number
from modeler.studio.studio import Studio
from modeler.studio.tasks import ROBOT, Step, Task

_LIGHT: Mapping[str | None, Light] = {"parameters": "good", "prediction": "doubtful"}
_STATE: Mapping[str, Light] = {"good": "good", "doubtful": "doubtful", "undetermined": "bad"}
_BUILT: Mapping[bool | None, tuple[Light, str]] = {
    True: ("good", "yes: masses, inertias and friction of a possible machine give the same"),
    False: ("doubtful", "no, see the doubts"),
    None: ("doubtful", "not asked: the logs are at fault first"),
}
_WIDTH = 160  # pixels of a drawn value


async def draw(studio: Studio) -> None:
    """Draws it."""
    project = studio.project
    elements.head("Fit", "Base parameters from the training stretches, each with its sigma.")
    if not project.robot or not project.words("train"):
        ui.label("A fit needs a robot, and a stretch of a log that is marked for training.")
        where = "data" if project.robot else "robot"
        elements.go_button(studio, f"To the {where}", where)
        return
    step = project.step(project.current)
    with elements.part("What is fitted"):
        chosen: dict[str, Any] = studio.kept.setdefault("fit", {})

        def task() -> Task:
            own = {name: value for name, value in chosen.items() if value not in ("", None)}
            return commands.fit(studio.project, tuple(own.items()))

        def changed() -> None:
            renew()
            lost.refresh()

        @ui.refreshable  # type: ignore[untyped-decorator, unused-ignore]
        def lost() -> None:
            elements.doubt_lines(lost_effects(studio, task()))

        renew = elements.run_button(studio, "Fit", task)
        lost()
        _advanced(chosen, changed)
    if step is None:
        return
    fit = studio.result(step)
    _stale(studio, step)
    _verdict(fit)
    _values(fit, studio.model(step))
    _choices(fit)
    elements.page_button(studio, step)
    elements.go_button(studio, "Look for what is missing", "missing")


def lost_effects(studio: Studio, task: Task) -> Iterator[str]:
    """Effects that the current model has, and a fit would not have."""
    if not studio.project.model:
        return
    known = robot_from_text(str(studio.model(studio.made)["robot_text"]), "model")
    robot = robot_from_text(studio.text(ROBOT), ROBOT)
    for use in known.effects:
        joints = [one.joint for one in use.instances]
        if use.effect in task.effects:
            continue
        lost = [j for j in joints if task.effects or not robot.has_effect(use.effect, j)]
        if lost:
            yield (
                f"this fit leaves out {use.effect} of joint {', '.join(lost)}, which the current "
                "model has; add it to the robot to keep it"
            )


def _advanced(chosen: dict[str, Any], renew: Callable[[], None]) -> None:
    """Estimator, band, weights: what there is, and what is taken where nothing is said."""
    every = [*ABOUT.values(), *(about for about in APART if about.id == TWO_STEPS)]

    def kept(name: str, value: Any) -> None:
        chosen[name] = value
        renew()
        _estimator.refresh()

    @ui.refreshable  # type: ignore[untyped-decorator, unused-ignore]
    def _estimator() -> None:
        about = next((a for a in every if a.id == chosen.get("method")), every[0])
        told = {"what it solves": about.law, "source": about.source,
                "the wrong one": about.avoid, "of the motion": about.motion}  # fmt: skip
        ui.label(about.title).classes("studio-part")
        elements.table(("", ""), list(told.items()))

    with ui.expansion("Advanced: estimator, band, effects").classes("w-full studio-folded"):
        with ui.row().classes("items-end w-full"):
            names = {"": f"{every[0].title} (default)"}
            names |= {about.id: about.title for about in every[1:]}
            fields = {
                "method": ui.select(names, label="estimator", value="").classes("w-80"),
                "derivatives": ui.select(
                    ["", "log", "position"], label="velocities from", value=""
                ),
                **{name: ui.number(label, min=0, placeholder="chosen")
                   for name, label in _NUMBERS.items()},
            }  # fmt: skip
            for name, field in fields.items():
                field.value = chosen.get(name, field.value)
                field.on_value_change(lambda e, to=name: kept(to, e.value)).classes("min-w-48")
            label = "effects, in place of the robot file's"
            taken = list(chosen.get("effects", ()))
            effects = ui.select(list(EFFECTS), label=label, multiple=True, value=taken)
            effects.on_value_change(lambda e: kept("effects", tuple(e.value or ())))
            effects.classes("w-96").props("use-chips clearable")
        _estimator()


_NUMBERS = {
    "cutoff": "position filter [Hz]", "parallel_cutoff": "parallel filter [Hz]",
    "low_speed": "low speed [share of top]", "essential_below": "essential below [% sigma]",
}  # fmt: skip


def _stale(studio: Studio, step: Step) -> None:
    """Says where these values are not those of the project as it is now, and where from."""
    elements.stale(studio)
    with ui.row().classes("items-center no-wrap w-full"):
        ui.label("these values come from").classes("studio-soft")
        elements.step_line(studio, step)


def _verdict(fit: Mapping[str, Any]) -> None:
    """Lights of the whole and of every joint, with the reasons."""
    with elements.part("What it is worth"):
        by_joint = {name: one for name, one in fit["joints"].items() if "state" in one}
        lights = {name: _STATE[one["state"]] for name, one in by_joint.items()}
        every = [_LIGHT.get(fit["valid_for"], "bad"), *lights.values()]
        named = [name for name, light in lights.items() if light != "good"]
        worst = max(every, key=LIGHTS.index)
        elements.light(worst, worst + (f": joint {', '.join(named)}" if named else ""))
        ui.label(fit["verdict"] or "nobody has judged this fit")
        with ui.element("div").classes("studio-joints"):
            for name, joint in fit["joints"].items():
                judged = by_joint.get(name, {"state": "doubtful", "why": ["not judged"]})
                light = _STATE[judged["state"]]
                with ui.card().classes(f"studio-card studio-joint studio-edge-{light}"):
                    ui.label(f"joint {name}").classes("studio-part")
                    elements.light(light, judged["state"])
                    left, rms = percent(joint["relative_error"]), number(joint["rms"])
                    text = f"error {left}, residual {rms} {joint['unit']} rms"
                    ui.label(text).classes("studio-soft")
                    elements.told(judged["why"])
        ui.label("Can such a machine be built?").classes("studio-part")
        elements.light(*_BUILT[fit.get("possible")])
        reasons = {reason for joint in by_joint.values() for reason in joint["why"]}
        elements.doubt_lines(line for line in fit["doubts"] if line not in reasons)
        elements.folded("What else is to be known", [*fit["sentences"], *fit.get("unseen", ())])


def _values(fit: Mapping[str, Any], model: Mapping[str, Any]) -> None:
    """The parameters with their sigmas, drawn among those of the same unit."""
    own = [*fit["gains"], *fit["parameters"], *fit["loads"]]
    every = [built(BaseSpec, raw) for raw in model["manifest"]["base"]]
    sums = {base.name: relation(base) for base in every}
    tops: dict[str, float] = {}
    for p in own:
        tops[p["unit"]] = max(tops.get(p["unit"], 0.0), abs(p["value"]) + (p["sigma"] or 0.0))
    with elements.part(f"{len(own)} values"):
        ui.label(
            "The whisker is one sigma to either side, among values of the same unit; a name that "
            "is underlined tells what it is the sum of. Grey: the model does as well without."
        ).classes("studio-soft")
        heads = ("parameter", "value", "sigma", "% sigma", "unit", "")
        rows = [_row(p, sums.get(p["name"], ""), tops[p["unit"]]) for p in own]
        elements.table(heads, rows, [not p["essential"] for p in own])


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
    own, bands = fit["processing"], fit["bands"] or {"chosen_by": [], "noise": []}
    cutoffs = {"position filter": "position_cutoff", "parallel filter": "parallel_cutoff"}
    with elements.part("How the logs were processed, and why"):
        elements.told(bands["chosen_by"])
        rows = [
            (title, f"{number(own[name])} Hz",
             "chosen from the logs" if name in own["chosen"] else "as it was asked for")
            for title, name in cutoffs.items()
        ] + [
            ("samples, rows", f"{fit['samples']}, {fit['rows']}", "what the filters leave to know"),
            ("condition number", number(fit["condition_scaled"]), "of W, columns of length one"),
        ] + [
            (f"noise of position {noise['joint']}", f"{number(noise['deviation'])} {noise['unit']}",
             f"hides the motion above {number(noise['hides_above_hz'])} Hz")
            for noise in bands["noise"]
        ]  # fmt: skip
        elements.table(("", "", ""), rows)
