"""The page of a model's history: the error after every effect that was added, and the values."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from modeler.core.figure import Bars, Curve, Panel, Picture
from modeler.core.style import BLUE, GREEN, ORANGE, PINK, SKY, VERMILLION, Style
from modeler.core.table import DIGITS, WORDS, percent, printed
from modeler.effects import Effect, effect_named
from modeler.estimation import Addition, IdentifiedModel
from modeler.report.blocks import Block, Code, Figure, Items, PageCell, PageTable, Paragraph
from modeler.report.page import Origin, Page, Section
from modeler.report.values import added_names, joints_table, shapes_table, values_table
from modeler.robot import Robot, robot_from_text

HELD, FITTED, LEARNED = Style(BLUE), Style(ORANGE), Style(PINK)
SAME, BETTER, WORSE = Style(SKY), Style(GREEN), Style(VERMILLION)
_ACROSS = 3  # panels side by side


def additions_page(
    model: IdentifiedModel, left_out: Sequence[str] = (), origin: Origin | None = None
) -> Page:
    """The page of a model's history: the error after every effect, joint by joint; values.

    Args:
        model: with its history.
        left_out: effects that were not added, and why.
        origin: model, logs, and whether some were held out.
    """
    history, robot = model.history, model.spec.robot
    held, last = history[-1].held_out, history[-1].error
    fact = f"judged on {', '.join(held)}" if held else "training only: nothing was held out"
    several = len(history[-1].joints) > 1
    return Page(
        title=f"{robot}: effects added",
        headline=(percent(last, DIGITS), f"error left of {percent(history[0].error, DIGITS)}"
                  + (", rms over the joints" if several else "")),
        sections=_sections(model, left_out),
        origin=origin or Origin(robot, held, bool(held)),
        facts=_facts(model, fact, left_out),
        provenance=[*model.warning, f"fitted on {', '.join(log.name for log in model.logs)}"],
        command="add",
    )  # fmt: skip


def effect_page(
    effect: Effect, definition: str, robot: Robot, model: IdentifiedModel | None,
    drawn: tuple[str, Sequence[float], Sequence[float]],
) -> Page:  # fmt: skip
    """The page of an effect that a robot file defines: its equation, where it was found, values.

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
    rows += [(f"{n}, joint {i.joint}", f"{x:.5g}") for i in at for n, x in i.shapes.items()]
    values = [PageTable(("of the robot file", "value, SI"), rows)]
    if model is not None:
        steps = [(s, _units(s, effect, model)) for s in model.history if s.effect == effect.id]
        own = [p for p in model.fit.parameters if p.name in names]
        shapes, caption = shapes_table(steps), "SI units; sigma is one standard deviation."
        values = [values_table(own, (), caption), *([shapes] if shapes else values[:0])]
    joints = ", ".join(dict.fromkeys(i.joint for i in at)) or "none"
    units = ", ".join(f"{c.prefix}: {c.unit_revolute}" for c in effect.columns)
    label, x, y = drawn
    curve = Curve(effect.id, np.array(x), np.array(y), LEARNED if effect.learned else HELD)
    torque = f"torque per unit of {effect.columns[0].prefix}"
    picture = Picture(
        name=effect.id, title=effect.title, height=380,
        caption=f"The torque against {label}; what else it depends on stands at 1.",
        panels=((Panel(effect.equation, label, torque, (curve,), zero=True),),),
    )  # fmt: skip
    return Page(
        title=f"{robot.name}: {effect.id}",
        headline=(effect.id, effect.title),
        sections=[Section("Its torque", [Figure(picture)]),
                  Section("Its values", values if names else [Paragraph("No joint has it.")]),
                  Section("To be found on other robots", [Code(definition)])],
        origin=Origin(robot.name),
        facts=[("Equation", effect.equation), ("Unit", units), ("Joints", joints)],
        command="effects",
    )  # fmt: skip


def _facts(
    model: IdentifiedModel, data: str, left_out: Sequence[str]
) -> list[tuple[str, str]]:  # fmt: skip
    history = model.history
    facts = [("Effects", ", ".join(s.effect for s in history[1:]) or "none"), ("Data", data)]
    if len(history) > 1:
        start, end = (_errors(step) for step in (history[0], history[-1]))
        most = max(end, key=lambda name: start.get(name, 0.0) - end[name], default=None)
        if most is not None:
            change = " \u2192 ".join(printed(start.get(most, math.nan), end[most]))
            facts.append(("Gains most", f"joint {most}: {change}"))
    if (parts := model.fall_shares) is not None:
        physics, learned = (f"{100.0 * part:.2g}" for part in parts)
        facts.append(("Of the fall", f"physics {physics}, learned laws {learned} points"))
    if left_out:
        facts.append(("Refused", f"{len(left_out)}, see below"))
    if model.fit.verdict is not None:
        facts.append(("The new fit", model.fit.verdict.line))
    return facts


def _errors(step: Addition) -> dict[str, float]:
    """By joint, with the effect."""
    return {name: after for name, (_, after) in step.joints.items()}


def _sections(model: IdentifiedModel, left_out: Sequence[str]) -> list[Section]:
    history = model.history
    sections = [Section("The error falls", [Figure(waterfall_picture(history))])]
    if history[-1].joints:
        units = {joint.name: joint.effort_unit for joint in model.spec.joints}
        sections.append(Section("Joint by joint", [
            _by_joint(history), Figure(joints_picture(history, units), titled=False),
        ]))  # fmt: skip
    sections.append(Section("What was added", _added(model)))
    if left_out:
        sections.append(Section("What was refused, and why", [_refused(left_out)]))
    sections.append(Section("All values", [
        joints_table(model.fit),
        values_table(model.fit.parameters, model.spec.base,
                     "SI units; sigma is one standard deviation. The bar is full at 30 %."),
    ]))  # fmt: skip
    if len(history) > 1:
        again = [
            f"modeler add MODEL {'learned' if step.learned else step.effect}"
            + (f" --joint {step.joint}" if step.joint else "")
            + " LOG... --out MODEL"
            for step in history[1:]
        ]
        sections.append(Section("To do this again, in this order", [Code(line) for line in again]))
    return sections


def _by_joint(history: Sequence[Addition]) -> PageTable:
    """Errors before, and after each addition."""
    rows: list[list[str | PageCell]] = []
    for name in history[-1].joints:
        errors = [_errors(step).get(name) for step in history]
        top = max((e for e in errors if e is not None), default=0.0) or 1.0
        changed = [" *" if name in step.changed else "" for step in history]
        rows.append([name, *(
            PageCell("-") if e is None else PageCell(percent(e) + mark, e / top)
            for e, mark in zip(errors, changed, strict=True)
        )])  # fmt: skip
    steps, held = [step_name(step) for step in history], ", ".join(history[-1].held_out)
    judged = (
        f"the held-out logs {held}" if held else "parts of the fitted logs, each left out in turn"
    )
    return PageTable(
        ["joint", *steps], rows,
        "Relative error of each joint, in parts of its own rms torque or force, on "
        f"{judged}. * a change beyond chance, paired over blocks of time.",
        dict.fromkeys(steps, "bar"),
    )  # fmt: skip


def _added(model: IdentifiedModel) -> list[Block]:
    catalogue = robot_from_text(model.robot_text, "robot").catalogue
    steps = [step for step in model.history if step.effect]
    if not steps:
        return [Paragraph("Nothing: the model is as it was fitted.")]
    found = {step.effect: effect_named(step.effect, catalogue) for step in steps}
    blocks: list[Block] = [
        Items([(f"{step_name(step)[2:]}:", effect.title)
               for step in steps if (effect := found[step.effect]) is not None])
    ]  # fmt: skip
    added = added_names(model)
    own = [parameter for parameter in model.fit.parameters if parameter.name in added]
    if own:
        caption = (
            "SI units; sigma is one standard deviation, and knows that shapes were fitted too."
        )
        blocks.append(values_table(own, model.spec.base, caption))
    blocks += [
        Paragraph(f"{step_name(step)[2:]} moved, in their sigmas: "
                  + ", ".join(f"{name} {by:.2g}" for name, by in step.moved.items()) + ".")
        for step in steps if step.learned
    ]  # fmt: skip
    shapes = shapes_table([(s, _units(s, found[s.effect], model)) for s in steps])
    return blocks if shapes is None else [*blocks, shapes]


def _units(step: Addition, effect: Effect | None, model: IdentifiedModel) -> dict[str, str]:
    """Of the shapes of a step, by name; "" for a plain number."""
    linear = any(j.name == step.joint and j.unit == "m" for j in model.spec.joints)
    shapes = [] if effect is None else [shape for form in effect.forms for shape in form.shapes]
    units = {shape.name: shape.unit(linear) for shape in shapes}
    return {name: "" if units.get(name, "1") == "1" else units[name] for name in step.shapes}


def _refused(left_out: Sequence[str]) -> Items:
    """The effect bold, the reason behind it."""
    lines = []
    for line in left_out:
        what, _, why = line.removeprefix("left out: ").partition(" (")
        lines.append((f"{what}:", why.removesuffix(")")) if why else ("", line))
    return Items(lines)


def step_name(step: Addition) -> str:
    """What a step is called: "as fitted", "+ spring @2"."""
    if not step.effect:
        return "as fitted"
    return f"+ {step.effect}" + (f" @{step.joint}" if step.joint else "")


def _broken(step: Addition) -> str:
    """Its name on several lines, so that bars may be narrow."""
    return step_name(step).replace("_", "\n").replace(" @", "\n@")


def waterfall_picture(history: Sequence[Addition]) -> Picture:
    """Error over the joints after every effect, on held-out and on fitted logs."""
    names = tuple(_broken(step) for step in history)
    held, fitted = 100.0 * np.array([(s.error, s.training_error) for s in history]).T
    first = (
        "held-out logs" if history[-1].held_out else "parts of the fitted logs, left out in turn"
    )
    learned = np.array([step.learned for step in history])

    def bars(label: str, errors: np.ndarray, style: Style) -> tuple[Bars, ...]:
        physics = _bars(label, names, np.where(learned, np.nan, errors), style)
        law = _bars("learned, not physics", names, np.where(learned, errors, np.nan), LEARNED)
        return (physics, law) if learned.any() else (physics,)

    panels = (
        Panel(f"On {first}", "", "error [%]", bars("judged", held, HELD)),
        Panel("On the fitted logs", "", "error [%]", bars("fitted", fitted, FITTED)),
    )
    several = len(history[-1].joints) > 1
    return Picture(
        name="waterfall",
        title="Error after every effect",
        caption=(
            f"{HELD.named.capitalize()}: the error that counts, on {first}; {FITTED.named}: on the "
            "logs that were fitted. Each joint's error is in parts of its own rms torque or force"
            + (", and the bar is their root mean square: N m and N are not added. " if several
               else ". ")
            + (f"{LEARNED.named.capitalize()}: a learned law, not physics. " * bool(learned.any()))
            + "`modeler add MODEL undo LOG... --out MODEL` takes the last effect back."
        ),
        panels=(panels,),
        height=380,
    )  # fmt: skip


def joints_picture(history: Sequence[Addition], units: Mapping[str, str]) -> Picture:
    """The same for every joint by itself.

    Args:
        history: of a model.
        units: of the efforts, by joint.
    """
    panels = [_joint(history, name, units[name]) for name in history[-1].joints]
    panels += [Panel("", "", "", ())] * (-len(panels) % min(_ACROSS, len(panels)))
    across = min(_ACROSS, len(panels))
    rows = tuple(tuple(panels[k : k + across]) for k in range(0, len(panels), across))
    said = (
        f"{SAME.named.capitalize()}: the error of each joint on motion that was not fitted, in "
        "parts of its own rms torque or force, before any effect and after each"
    )
    drawn = {own.style for panel in panels for own in panel.series if isinstance(own, Bars)}
    for style, what in ((BETTER, "fall"), (WORSE, "rise")):
        said += f"; {style.named}: a clear {what}" * (style in drawn)
    return Picture(
        name="waterfall_joints",
        title="Error of every joint after every effect",
        caption=f"{said}.",
        panels=rows,
        height=270 * len(rows) + 40,
    )


def _joint(history: Sequence[Addition], name: str, unit: str) -> Panel:
    """Bars of one joint: no clear change, lower, higher."""
    steps = [step for step in history if name in step.joints]
    names = tuple(_broken(step) for step in steps)
    errors = np.array([100.0 * step.joints[name][1] for step in steps])
    surely = np.array([name in step.changed for step in steps])
    rises = np.array([step.joints[name][1] > step.joints[name][0] for step in steps])
    kinds = (
        ("no clear change", SAME, ~surely),
        ("clearly lower", BETTER, surely & ~rises),
        ("clearly higher", WORSE, surely & rises),
    )
    series = [
        _bars(label, names, np.where(own, errors, np.nan), style)
        for label, style, own in kinds
        if own.any()
    ]
    return Panel(f"Joint {name}", "", f"error [% of {WORDS[unit]}]", tuple(series))


def _bars(label: str, names: tuple[str, ...], errors: np.ndarray, style: Style) -> Bars:
    return Bars(
        label, names, errors, tuple("" if np.isnan(e) else f"{e:.{DIGITS}g}" for e in errors), style
    )
