"""The page of a model's history: the error after every effect that was added, and the values."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from modeler.core import figure as fig
from modeler.core.manifest import BaseSpec, TermSpec
from modeler.core.table import DIGITS, WORDS, Column, format_error_pair, format_percent
from modeler.effects import Effect, find_effect
from modeler.estimation import (
    Addition,
    FitResult,
    IdentifiedModel,
    ParameterEstimate,
    format_prior,
    format_spread,
)
from modeler.robot import Robot, parse_robot_text
from modeler.views import page
from modeler.views.thresholds import THRESHOLDS

# Tables of fitted values: parameters with sigma, what each is the sum of, errors by joint.

_KINDS = {"% sigma": "bar", "unit": "unit", "is the sum of": "why"}


def tabulate_values(
    parameters: Sequence[ParameterEstimate], base: Sequence[BaseSpec] = (), caption: str = ""
) -> page.PageTable:
    """Tabulates value, sigma, %sigma, unit, and the sum that each parameter is.

    Args:
        parameters: estimated ones.
        base: the base parameters of the robot, for the sums; parameters without one have none.
        caption: below the table.
    """
    sums = {b.name: format_relation(b) for b in base}
    known = any(p.prior is not None for p in parameters)
    rows: list[list[str | page.PageCell]] = [
        [
            p.name,
            "set aside" if p.sigma is None else f"{p.value:.5g}",
            "" if p.sigma is None else _format_spread(p.value, p.sigma, p.interval) or "0",
            _build_sigma_cell(p),
            *([format_prior(p)] if known else []),
            p.unit,
            sums.get(p.name, ""),
        ]
        for p in parameters
    ]
    prior = ("from the prior",) if known else ()
    head = ("parameter", "value", "sigma", "% sigma", *prior, "unit", "is the sum of")
    return page.PageTable(head, rows, caption, _KINDS)


def format_relation(base: BaseSpec) -> str:
    """Formats the sum of a base parameter: "ZZ1 + Ia1 + D2**2*M2"; "" for a single term."""
    if len(base.terms) == 1 and base.terms[0].coefficient == "1":
        return ""
    text = " ".join(_format_term(term) for term in base.terms)
    return text.removeprefix("+ ")


def _format_term(term: TermSpec) -> str:
    coefficient = term.coefficient
    if coefficient in ("1", "-1"):
        return f"{'-' if coefficient == '-1' else '+'} {term.parameter}"
    outside = coefficient
    depth = 0
    for k, letter in enumerate(coefficient):
        depth += (letter == "(") - (letter == ")")
        if letter in "+-" and k and depth == 0 and coefficient[k - 1] not in "*/(e":
            outside = f"({coefficient})"
            break
    if outside.startswith("-"):
        return f"- {outside[1:]}*{term.parameter}"
    return f"+ {outside}*{term.parameter}"


def _build_sigma_cell(parameter: ParameterEstimate) -> page.PageCell:
    share = parameter.relative_sigma_percent
    if share is None:
        return page.PageCell("-")
    text = f"{share:.3g}" if share < 1e4 else ">10000"
    mark = "" if parameter.essential else " not essential"
    return page.PageCell(f"{text}{mark}", min(1.0, share / THRESHOLDS.full_bar_percent))


JOINT_COLUMNS = (
    Column("joint", "name"),
    Column("relative error", "relative_error", "%", kind="bar"),
    Column("rms", "rms", ".3g", "unit"),
    Column("unit", "unit", None),
    Column("rows", "rows"),
)
"""Of what a fit leaves on the logs that were fitted."""


def tabulate_joint_errors(fit: FitResult) -> page.PageTable:
    """Tabulates errors by joint on the fitted logs, in parts of the joint's own torque."""
    return page.tabulate(
        JOINT_COLUMNS,
        fit.joints,
        "On the logs that were fitted. Relative error: norm of the residual over the norm of the "
        "joint's own torque or force.",
    )


def find_added_names(model: IdentifiedModel) -> set[str]:
    """Finds the base parameters that the effects of a model's history added."""
    steps = {(step.effect, step.joint) for step in model.history if step.effect}
    effect_parameters = {p.name for p in model.spec.standard if (p.effect, p.joint) in steps}
    return {b.name for b in model.spec.base if b.column_of in effect_parameters}


def tabulate_nonlinear_parameters(
    steps: Sequence[tuple[Addition, Mapping[str, str]]],
) -> page.PageTable | None:
    """Tabulates nonlinear parameters of the added effects; None without any.

    Args:
        steps: of a model's history, each with the units of its shapes by name.
    """
    rows = [
        (
            step.effect,
            step.joint or "all",
            name,
            f"{value:.5g}",
            _format_step_spread(step, name),
            units[name],
        )
        for step, units in steps
        for name, value in step.nonlinear_parameters.items()
    ]
    if not rows:
        return None
    return page.PageTable(
        ("effect", "joint", "shape", "value", "sigma", "unit"),
        rows,
        "Shapes enter the torque not as factors; they were searched for.",
        dict.fromkeys(("joint", "shape", "unit"), "text"),
    )


def _format_step_spread(step: Addition, name: str) -> str:
    sigma, interval = step.nonlinear_sigmas.get(name, 0.0), step.nonlinear_intervals.get(name)
    return _format_spread(step.nonlinear_parameters[name], sigma, interval) or "-"


def _format_spread(value: float, sigma: float, interval: tuple[float, float] | None) -> str:
    """As behind a value, without the signs that part it from that."""
    spread = format_spread(value, sigma, interval).strip()
    return spread.removeprefix("+- ").removeprefix("(").removesuffix(")")


HELD, FITTED, LEARNED = fig.Style(fig.BLUE), fig.Style(fig.ORANGE), fig.Style(fig.PINK)
SAME, BETTER, WORSE = fig.Style(fig.SKY), fig.Style(fig.GREEN), fig.Style(fig.VERMILLION)
_ACROSS = 3  # panels side by side


def build_history_page(
    model: IdentifiedModel, left_out: Sequence[str] = (), origin: page.Origin | None = None
) -> page.Page:
    """Builds the page of a model's history: error after every effect, by joint, and values.

    Args:
        model: with its history.
        left_out: effects that were not added, and why.
        origin: model, logs, and whether some were held out.
    """
    history, robot = model.history, model.spec.robot
    held, last = history[-1].held_out_logs, history[-1].error
    fact = f"judged on {', '.join(held)}" if held else "training only: nothing was held out"
    several = len(history[-1].joints) > 1
    return page.Page(
        title=f"{robot}: effects added",
        headline=(
            format_percent(last, DIGITS),
            f"error left of {format_percent(history[0].error, DIGITS)}"
            + (", rms over the joints" if several else ""),
        ),
        sections=_build_sections(model, left_out),
        origin=origin or page.Origin(robot, held, bool(held)),
        facts=_collect_facts(model, fact, left_out),
        provenance=[*model.warning, f"fitted on {', '.join(log.name for log in model.logs)}"],
        command="add",
    )


def build_effect_page(
    effect: Effect,
    definition: str,
    robot: Robot,
    model: IdentifiedModel | None,
    drawn: tuple[str, Sequence[float], Sequence[float]],
) -> page.Page:
    """Builds the page of an effect of a robot file: equation, origin, values.

    Args:
        effect: it.
        definition: the file that defines it.
        robot: that has it.
        model: of the robot, with sigmas; None: the values of the robot file.
        drawn: axis, points of it, and the torque there per unit of its first parameter.
    """
    at = [i for use in robot.effects if use.effect == effect.id for i in use.instances]
    names = [f"{c.prefix}{i.joint}{i.label}" for i in at for c in effect.columns]
    rows = [(n, f"{robot.parameters[n]:.5g}") for n in names if n in robot.parameters]
    rows += [
        (f"{n}, joint {i.joint}", f"{x:.5g}") for i in at for n, x in i.nonlinear_parameters.items()
    ]
    values = [page.PageTable(("of the robot file", "value, SI"), rows)]
    if model is not None:
        steps = [
            (s, _collect_units(s, effect, model)) for s in model.history if s.effect == effect.id
        ]
        effect_parameters = [p for p in model.fit.parameters if p.name in names]
        shapes = tabulate_nonlinear_parameters(steps)
        caption = "SI units; sigma is one standard deviation."
        values = [tabulate_values(effect_parameters, (), caption), *([shapes] if shapes else [])]
    joints = ", ".join(dict.fromkeys(i.joint for i in at)) or "none"
    units = ", ".join(f"{c.prefix}: {c.unit_revolute}" for c in effect.columns)
    label, x, y = drawn
    curve = fig.Curve(effect.id, np.array(x), np.array(y), LEARNED if effect.is_learned else HELD)
    torque = f"torque per unit of {effect.columns[0].prefix}"
    picture = fig.Picture(
        name=effect.id,
        title=effect.title,
        height=380,
        caption=f"The torque against {label}; what else it depends on stands at 1.",
        panels=((fig.Panel(effect.equation, label, torque, (curve,), zero=True),),),
    )
    return page.Page(
        title=f"{robot.name}: {effect.id}",
        headline=(effect.id, effect.title),
        sections=[
            page.Section("Its torque", [page.Figure(picture)]),
            page.Section("Its values", values if names else [page.Paragraph("No joint has it.")]),
            page.Section("To be found on other robots", [page.Code(definition)]),
        ],
        origin=page.Origin(robot.name),
        facts=[("Equation", effect.equation), ("Unit", units), ("Joints", joints)],
        command="effects",
    )


def _collect_facts(
    model: IdentifiedModel, data: str, left_out: Sequence[str]
) -> list[tuple[str, str]]:
    history = model.history
    facts = [("Effects", ", ".join(s.effect for s in history[1:]) or "none"), ("Data", data)]
    if len(history) > 1:
        start, end = (_collect_errors(step) for step in (history[0], history[-1]))
        most = max(end, key=lambda name: start.get(name, 0.0) - end[name], default=None)
        if most is not None:
            change = " \u2192 ".join(format_error_pair(start.get(most, math.nan), end[most]))
            facts.append(("Gains most", f"joint {most}: {change}"))
    if (parts := model.error_reduction_shares) is not None:
        physics, learned = (f"{100.0 * part:.2g}" for part in parts)
        facts.append(("Of the fall", f"physics {physics}, learned laws {learned} points"))
    if left_out:
        facts.append(("Refused", f"{len(left_out)}, see below"))
    if model.fit.verdict is not None:
        facts.append(("The new fit", model.fit.verdict.line))
    return facts


def _collect_errors(step: Addition) -> dict[str, float]:
    """By joint, with the effect."""
    return {name: after for name, (_, after) in step.joints.items()}


def _build_sections(model: IdentifiedModel, left_out: Sequence[str]) -> list[page.Section]:
    history = model.history
    sections = [page.Section("The error falls", [page.Figure(draw_waterfall_picture(history))])]
    if history[-1].joints:
        units = {joint.name: joint.effort_unit for joint in model.spec.joints}
        sections.append(
            page.Section(
                "Joint by joint",
                [
                    _tabulate_joints(history),
                    page.Figure(draw_joints_picture(history, units), titled=False),
                ],
            )
        )
    sections.append(page.Section("What was added", _build_added_blocks(model)))
    if left_out:
        sections.append(page.Section("What was refused, and why", [_build_refusal_items(left_out)]))
    caption = "SI units; sigma is one standard deviation. The bar is full at 30 %."
    values = tabulate_values(model.fit.parameters, model.spec.base, caption)
    sections.append(page.Section("All values", [tabulate_joint_errors(model.fit), values]))
    if len(history) > 1:
        again = [
            f"modeler add MODEL {'learned' if step.is_learned else step.effect}"
            + (f" --joint {step.joint}" if step.joint else "")
            + " LOG... --out MODEL"
            for step in history[1:]
        ]
        sections.append(
            page.Section("To do this again, in this order", [page.Code(line) for line in again])
        )
    return sections


def _tabulate_joints(history: Sequence[Addition]) -> page.PageTable:
    """Errors before, and after each addition."""
    rows: list[list[str | page.PageCell]] = []
    for name in history[-1].joints:
        errors = [_collect_errors(step).get(name) for step in history]
        top = max((e for e in errors if e is not None), default=0.0) or 1.0
        changed = [" *" if name in step.changed_joints else "" for step in history]
        cells = [
            page.PageCell("-") if e is None else page.PageCell(format_percent(e) + mark, e / top)
            for e, mark in zip(errors, changed, strict=True)
        ]
        rows.append([name, *cells])
    steps, held = [format_step_name(step) for step in history], ", ".join(history[-1].held_out_logs)
    judged = (
        f"the held-out logs {held}" if held else "parts of the fitted logs, each left out in turn"
    )
    return page.PageTable(
        ["joint", *steps],
        rows,
        "Relative error of each joint, in parts of its own rms torque or force, on "
        f"{judged}. * a change beyond chance, paired over blocks of time.",
        dict.fromkeys(steps, "bar"),
    )


def _build_added_blocks(model: IdentifiedModel) -> list[page.Block]:
    catalogue = parse_robot_text(model.robot_text, "robot").catalogue
    steps = [step for step in model.history if step.effect]
    if not steps:
        return [page.Paragraph("Nothing: the model is as it was fitted.")]
    effects = {step.effect: find_effect(step.effect, catalogue) for step in steps}
    blocks: list[page.Block] = [
        page.Items(
            [
                (f"{format_step_name(step)[2:]}:", effect.title)
                for step in steps
                if (effect := effects[step.effect]) is not None
            ]
        )
    ]
    added = find_added_names(model)
    added_parameters = [parameter for parameter in model.fit.parameters if parameter.name in added]
    if added_parameters:
        caption = (
            "SI units; sigma is one standard deviation, and knows that shapes were fitted too."
        )
        blocks.append(tabulate_values(added_parameters, model.spec.base, caption))
    blocks += [
        page.Paragraph(
            f"{format_step_name(step)[2:]} moved, in their sigmas: "
            + ", ".join(f"{name} {by:.2g}" for name, by in step.shifts_in_sigmas.items())
            + "."
        )
        for step in steps
        if step.is_learned
    ]
    shapes = tabulate_nonlinear_parameters(
        [(s, _collect_units(s, effects[s.effect], model)) for s in steps]
    )
    return blocks if shapes is None else [*blocks, shapes]


def _collect_units(step: Addition, effect: Effect | None, model: IdentifiedModel) -> dict[str, str]:
    """Of the shapes of a step, by name; "" for a plain number."""
    linear = any(j.name == step.joint and j.unit == "m" for j in model.spec.joints)
    shapes = (
        []
        if effect is None
        else [shape for form in effect.forms for shape in form.nonlinear_parameters]
    )
    units = {shape.name: shape.get_unit(linear) for shape in shapes}
    return {
        name: "" if units.get(name, "1") == "1" else units[name]
        for name in step.nonlinear_parameters
    }


def _build_refusal_items(left_out: Sequence[str]) -> page.Items:
    """The effect bold, the reason behind it."""
    lines = []
    for line in left_out:
        what, _, why = line.removeprefix("left out: ").partition(" (")
        lines.append((f"{what}:", why.removesuffix(")")) if why else ("", line))
    return page.Items(lines)


def format_step_name(step: Addition) -> str:
    """Formats the name of a step: "as fitted", "+ spring @2"."""
    if not step.effect:
        return "as fitted"
    return f"+ {step.effect}" + (f" @{step.joint}" if step.joint else "")


def _break_step_name(step: Addition) -> str:
    """Its name on several lines, so that bars may be narrow."""
    return format_step_name(step).replace("_", "\n").replace(" @", "\n@")


def draw_waterfall_picture(history: Sequence[Addition]) -> fig.Picture:
    """Draws the error over the joints after every effect, on held-out and on fitted logs."""
    names = tuple(_break_step_name(step) for step in history)
    held, fitted = 100.0 * np.array([(s.error, s.training_error) for s in history]).T
    first = (
        "held-out logs"
        if history[-1].held_out_logs
        else "parts of the fitted logs, left out in turn"
    )
    learned = np.array([step.is_learned for step in history])

    def build_bars(label: str, errors: np.ndarray, style: fig.Style) -> tuple[fig.Bars, ...]:
        physics = _build_bars(label, names, np.where(learned, np.nan, errors), style)
        law = _build_bars("learned, not physics", names, np.where(learned, errors, np.nan), LEARNED)
        return (physics, law) if learned.any() else (physics,)

    panels = (
        fig.Panel(f"On {first}", "", "error [%]", build_bars("judged", held, HELD)),
        fig.Panel("On the fitted logs", "", "error [%]", build_bars("fitted", fitted, FITTED)),
    )
    several = len(history[-1].joints) > 1
    return fig.Picture(
        name="waterfall",
        title="Error after every effect",
        caption=(
            f"{HELD.description.capitalize()}: the error that counts, on {first}; "
            f"{FITTED.description}: on the "
            "logs that were fitted. Each joint's error is in parts of its own rms torque or force"
            + ", and the bar is their root mean square: N m and N are not added" * several
            + ". "
            + f"{LEARNED.description.capitalize()}: a learned law, not physics. "
            * bool(learned.any())
            + "`modeler add MODEL undo LOG... --out MODEL` takes the last effect back."
        ),
        panels=(panels,),
        height=380,
    )


def draw_joints_picture(history: Sequence[Addition], units: Mapping[str, str]) -> fig.Picture:
    """Draws the error of every joint after every effect.

    Args:
        history: of a model.
        units: of the efforts, by joint.
    """
    panels = [_build_joint_panel(history, name, units[name]) for name in history[-1].joints]
    panels += [fig.Panel("", "", "", ())] * (-len(panels) % min(_ACROSS, len(panels)))
    across = min(_ACROSS, len(panels))
    rows = tuple(tuple(panels[k : k + across]) for k in range(0, len(panels), across))
    caption = (
        f"{SAME.description.capitalize()}: the error of each joint on motion that was not fitted, "
        "in parts of its own rms torque or force, before any effect and after each"
    )
    drawn = {bars.style for panel in panels for bars in panel.series if isinstance(bars, fig.Bars)}
    for style, what in ((BETTER, "fall"), (WORSE, "rise")):
        caption += f"; {style.description}: a clear {what}" * (style in drawn)
    return fig.Picture(
        name="waterfall_joints",
        title="Error of every joint after every effect",
        caption=f"{caption}.",
        panels=rows,
        height=270 * len(rows) + 40,
    )


def _build_joint_panel(history: Sequence[Addition], name: str, unit: str) -> fig.Panel:
    """Bars of one joint: no clear change, lower, higher."""
    steps = [step for step in history if name in step.joints]
    names = tuple(_break_step_name(step) for step in steps)
    errors = np.array([100.0 * step.joints[name][1] for step in steps])
    surely = np.array([name in step.changed_joints for step in steps])
    rises = np.array([step.joints[name][1] > step.joints[name][0] for step in steps])
    kinds = (
        ("no clear change", SAME, ~surely),
        ("clearly lower", BETTER, surely & ~rises),
        ("clearly higher", WORSE, surely & rises),
    )
    series = [
        _build_bars(label, names, np.where(mask, errors, np.nan), style)
        for label, style, mask in kinds
        if mask.any()
    ]
    return fig.Panel(f"Joint {name}", "", f"error [% of {WORDS[unit]}]", tuple(series))


def _build_bars(
    label: str, names: tuple[str, ...], errors: np.ndarray, style: fig.Style
) -> fig.Bars:
    return fig.Bars(
        label, names, errors, tuple("" if np.isnan(e) else f"{e:.{DIGITS}g}" for e in errors), style
    )
