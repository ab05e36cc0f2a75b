"""The screen "fit": values from the training segments, and what they are worth, joint by joint."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, get_args, get_type_hints

from nicegui import ui

from modeler.api.front_end import (
    ABOUT,
    APART,
    EFFECTS,
    FitOptions,
    format_percent,
    parse_robot_text,
)
from modeler.studio import commands, elements
from modeler.studio.elements import LIGHTS, Light, Markup, format_number
from modeler.studio.studio import Studio
from modeler.studio.tasks import FIT_OPTIONS, ROBOT, Step, Task

_LIGHT: Mapping[str | None, Light] = {"parameters": "good", "prediction": "doubtful"}
_STATE: Mapping[str, Light] = {"good": "good", "doubtful": "doubtful", "undetermined": "bad"}
_BUILT: Mapping[bool | None, tuple[Light, str]] = {
    True: ("good", "yes: masses, inertias and friction of a possible machine give the same"),
    False: ("doubtful", "no, see the warnings"),
    None: ("doubtful", "not asked: the logs are at fault first"),
}
_WIDTH = 160  # pixels of a drawn value


async def draw(studio: Studio) -> None:
    """Draws the screen of the fit."""
    project = studio.project
    elements.draw_head("Fit", "Base parameters from the training segments, each with its sigma.")
    if not project.robot or not project.collect_words("train"):
        line = "A fit needs a robot, and a segment of a log that is marked for training."
        where = "data" if project.robot else "robot"
        return elements.explain_missing(studio, line, f"To the {where}", where)
    step = project.find_step(project.current)
    with elements.add_card("What is fitted"):
        chosen: dict[str, Any] = studio.state.setdefault("fit", {})

        def build_task() -> Task:
            options = {name: value for name, value in chosen.items() if value not in ("", None)}
            return commands.fit(studio.project, tuple(options.items()))

        def update_choice() -> None:
            renew()
            draw_lost_effects.refresh()

        @ui.refreshable  # type: ignore[untyped-decorator, unused-ignore]
        def draw_lost_effects() -> None:
            elements.draw_warnings(find_lost_effects(studio, build_task()))

        renew = elements.add_run_button(studio, "Fit", build_task)
        draw_lost_effects()
        _draw_advanced(chosen, update_choice)
    if step is None:
        return None
    fit = studio.read_result(step)
    _draw_stale(studio, step)
    _draw_verdict(fit)
    names = [one["name"] for one in (*fit["gains"], *fit["parameters"], *fit["loads"])]
    relations = await studio.ask_viewer("parameter_relations", step.model_file, names)
    _draw_values(fit, relations)
    _draw_choices(fit)
    elements.add_page_button(studio, step)
    elements.add_go_button(studio, "Diagnose", "missing")
    return None


def find_lost_effects(studio: Studio, task: Task) -> Iterator[str]:
    """Finds effects of the current model that a new fit would lose."""
    if not studio.project.model_file:
        return
    known = parse_robot_text(str(studio.read_model(studio.model_step)["robot_text"]), "model")
    robot = parse_robot_text(studio.read_text(ROBOT), ROBOT)
    for use in known.effects:
        joints = [one.joint for one in use.instances]
        if use.effect in task.effects:
            continue
        lost_joints = [j for j in joints if task.effects or not robot.has_effect(use.effect, j)]
        if lost_joints:
            yield (
                f"this fit leaves out {use.effect} of joint {', '.join(lost_joints)}, which the "
                "current model has; add it to the robot to keep it"
            )


def _draw_advanced(chosen: dict[str, Any], renew: Callable[[], None]) -> None:
    """Options of the fit, as `FitOptions` declares them, and its effects."""
    abouts = {about.id: about for about in (*ABOUT.values(), *APART) if about.id != "tls"}

    def store_choice(name: str, value: Any) -> None:
        chosen[name] = value
        renew()
        draw_estimator.refresh()

    @ui.refreshable  # type: ignore[untyped-decorator, unused-ignore]
    def draw_estimator() -> None:
        about = abouts[chosen.get("method") or FitOptions.method]
        ui.label(about.title).classes("studio-part")
        facts = {"what it solves": about.law, "source": about.source}
        facts |= {"not suitable": about.limitations, "of the motion": about.motion}
        elements.draw_table(("", ""), list(facts.items()))

    with ui.expansion("Advanced: estimator, band, effects").classes("w-full studio-folded"):
        with ui.row().classes("items-end w-full"):
            for option in FIT_OPTIONS:
                titles = {id: about.title for id, about in abouts.items()}
                field = _add_option(option, titles if option.name == "method" else {})
                about = option.metadata["help"].replace("%(default)s", str(option.default))
                field.classes("min-w-48").tooltip(about)
                field.value = chosen.get(option.name, field.value)
                field.on_value_change(lambda e, to=option.name: store_choice(to, e.value))
            label = "effects, in place of the robot file's"
            chosen_effects = list(chosen.get("effects", ()))
            effects = ui.select(list(EFFECTS), label=label, multiple=True, value=chosen_effects)
            effects.on_value_change(lambda e: store_choice("effects", tuple(e.value or ())))
            effects.classes("w-96").props("use-chips clearable")
        draw_estimator()


def _add_option(option: dataclasses.Field[Any], titles: Mapping[str, str]) -> Any:
    """A menu where the option has few values, else a number; without a choice the default counts.

    Args:
        option: of `FitOptions`.
        titles: of its values; empty: those that its type allows.
    """
    label, default = option.name.replace("_", " "), option.default
    if isinstance(default, str):
        titles = titles or {
            name: name for name in get_args(get_type_hints(FitOptions)[option.name])
        }
        names = {name: title for name, title in titles.items() if name != default}
        return ui.select({"": f"{titles[default]} (default)", **names}, label=label, value="")
    unit = _UNITS[option.metadata["unit"]]
    usual = "from the logs" if default is None else f"{default:g}"
    return ui.number(f"{label} [{unit}]", min=0, placeholder=usual)


_UNITS = {"HZ": "Hz", "PERCENT": "%", "SHARE": "share"}


def _draw_stale(studio: Studio, step: Step) -> None:
    """Says where these values are not those of the project as it is now, and where from."""
    elements.draw_stale_warnings(studio)
    with ui.row().classes("items-center no-wrap w-full"):
        elements.draw_note("these values come from")
        elements.draw_step_line(studio, step)


def _draw_verdict(fit: Mapping[str, Any]) -> None:
    """Lights of the whole and of every joint, with the reasons."""
    with elements.add_card("Fit quality"):
        by_joint = {name: one for name, one in fit["joints"].items() if "state" in one}
        lights = {name: _STATE[one["state"]] for name, one in by_joint.items()}
        every = [_LIGHT.get(fit["valid_for"], "bad"), *lights.values()]
        doubtful_joints = [name for name, light in lights.items() if light != "good"]
        worst = max(every, key=LIGHTS.index)
        where = f": joint {', '.join(doubtful_joints)}" if doubtful_joints else ""
        elements.draw_light(worst, f"{worst}{where}")
        ui.label(fit["verdict"] or "nobody has judged this fit")
        with ui.element("div").classes("studio-joints"):
            for name, joint in fit["joints"].items():
                joint_result = by_joint.get(name, {"state": "doubtful", "why": ["not judged"]})
                light = _STATE[joint_result["state"]]
                with ui.card().classes(f"studio-card studio-joint studio-edge-{light}"):
                    ui.label(f"joint {name}").classes("studio-part")
                    elements.draw_light(light, joint_result["state"])
                    left, rms = format_percent(joint["relative_error"]), format_number(joint["rms"])
                    text = f"error {left}, residual {rms} {joint['unit']} rms"
                    elements.draw_note(text)
                    elements.draw_lines(joint_result["why"])
        ui.label("Physical consistency").classes("studio-part")
        elements.draw_light(*_BUILT[fit.get("physically_consistent")])
        reasons = {reason for joint in by_joint.values() for reason in joint["why"]}
        lines = dict.fromkeys(warning["text"] for warning in fit["warnings"])
        elements.draw_warnings(line for line in lines if line not in reasons)
        elements.draw_folded("Notes", [*fit["sentences"], *fit.get("undetectable_faults", ())])


def _draw_values(fit: Mapping[str, Any], relations: Mapping[str, str]) -> None:
    """The parameters with their sigmas, drawn among those of the same unit."""
    parameters = [*fit["gains"], *fit["parameters"], *fit["loads"]]
    tops: dict[str, float] = {}
    for p in parameters:
        tops[p["unit"]] = max(tops.get(p["unit"], 0.0), abs(p["value"]) + (p["sigma"] or 0.0))
    with elements.add_card(f"{len(parameters)} values"):
        elements.draw_note(
            "The whisker is one sigma to either side, among values of the same unit; a name that "
            "is underlined shows what it is the sum of. Grey: the model does as well without."
        )
        heads = ("parameter", "value", "sigma", "% sigma", "unit", "")
        rows = [_format_row(p, relations.get(p["name"], ""), tops[p["unit"]]) for p in parameters]
        elements.draw_table(heads, rows, [not p["essential"] for p in parameters])


def _format_row(p: Mapping[str, Any], relation: str, top: float) -> Sequence[str]:
    name, value, sigma = p["name"], p["value"], p["sigma"]
    shown = f"{name}\t{relation}" if relation else name
    if sigma is None:
        return (shown, "fixed", "", "", p["unit"], "")
    share = p["relative_sigma_percent"]
    percent = "-" if share is None else f"{share:.3g}" if share < 1e4 else ">10000"
    mark = "" if p["essential"] else " not essential"
    whisker = Markup(_draw_whisker(value, sigma, top))
    return (shown, f"{value:.5g}", f"{sigma:.2g}", percent + mark, p["unit"], whisker)


def _draw_whisker(value: float, sigma: float, top: float) -> str:
    """A dot with a whisker of one sigma on an axis from -top to top."""

    def compute_pixel(x: float) -> float:
        return (0.5 + 0.48 * x / (top or 1.0)) * _WIDTH

    low, high = compute_pixel(value - sigma), compute_pixel(value + sigma)
    description = f"{value:.3g} plus or minus {sigma:.2g}"
    return (
        f'<svg width={_WIDTH} height=14 role=img aria-label="{description}">'
        f'<path d="M{compute_pixel(0.0):.1f} 0V14" class=studio-axis />'
        f'<path d="M{low:.1f} 7H{high:.1f}M{low:.1f} 3V11M{high:.1f} 3V11" class=studio-whisker />'
        f"<circle cx={compute_pixel(value):.1f} cy=7 r=3 class=studio-dot /></svg>"
    )


def _draw_choices(fit: Mapping[str, Any]) -> None:
    """What was chosen from the logs, and why."""
    processing, bands = fit["processing"], fit["bands"] or {"reasons": [], "noise": []}
    cutoffs = {"position filter": "position_cutoff", "parallel filter": "parallel_cutoff"}
    with elements.add_card("How the logs were processed, and why"):
        elements.draw_lines(bands["reasons"])
        rows = []
        for title, name in cutoffs.items():
            why = (
                "chosen from the logs"
                if name in processing["automatic_cutoffs"]
                else "as it was requested"
            )
            rows.append((title, f"{format_number(processing[name])} Hz", why))
        counts, condition = f"{fit['samples']}, {fit['rows']}", fit["condition_scaled"]
        rows.append(("samples, rows", counts, "what the filters leave to know"))
        scaled = "of W, columns of length one"
        rows.append(("condition number", format_number(condition), scaled))
        for noise in bands["noise"]:
            level = f"{format_number(noise['deviation'])} {noise['unit']}"
            why = f"exceeds the motion above {format_number(noise['noise_crossover_hz'])} Hz"
            rows.append((f"noise of position {noise['joint']}", level, why))
        elements.draw_table(("", "", ""), rows)
