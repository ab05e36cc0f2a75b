"""Reading ROBOT as every command does, and what is built in: robots, effects, estimators."""

import argparse
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from modeler.cli.console import print_lines, print_note, print_result, show_activity, show_progress
from modeler.cli.documents import EffectSummary, RobotFile, RobotSummary
from modeler.cli.parser import describe_unknown
from modeler.cli.places import Output, check_places
from modeler.cli.thresholds import THRESHOLDS
from modeler.core.choices import ABOUT, EstimatorInfo, list_builtin_robots
from modeler.core.errors import DataError, RobotError
from modeler.core.files import write_all_without_overwriting
from modeler.core.options import OptionError, Options
from modeler.core.toml_cells import quote_value
from modeler.effects import CATALOGUE, Effect, Form, find_effect
from modeler.formats import read_robot
from modeler.robot import Robot, parse_robot_text, suggest_name

if TYPE_CHECKING:
    from modeler.core.jobs import Reporter
    from modeler.estimation import IdentifiedModel

O = TypeVar("O", bound=Options)


def build_reporter() -> "Reporter":
    """Builds the reporter of what an API function does, on the terminal."""
    from modeler.core.jobs import Reporter  # loads what starts processes

    return Reporter(show_activity, show_progress, print_note)


# The signature of an effect: torque against what it depends on.


_FUNCTIONS: dict[str, Callable[[float], float]] = {
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "sqrt": math.sqrt, "exp": math.exp,
    "abs": abs, "sign": lambda x: (x > 0) - (x < 0), "tanh": math.tanh,
}  # fmt: skip
_AXES = {
    "v": "speed, in top speeds", "q": "position, half a turn each way", "a": "acceleration",
    "load": "load times direction of motion", "t": "time", "T": "temperature above its mean",
    "torque": "predicted torque", "z": "position, back and forth",
    "since": "time since the last reversal",
}  # fmt: skip


def _sample_effect(form: Form, shapes: Mapping[str, float]) -> tuple[str, list[float], list[float]]:
    """The axis on which a form is drawn, points of it, and the first column there."""
    order = ("T", "t", "since", "load", "z", "q", "torque", "a", "v")
    late = {"z"} if form.internal_state is not None and form.internal_state.kind == "lag" else set()
    axis = next((name for name in order if name in form.names - late), "v")
    laws = [column.equation.law for column in form.columns]
    ends = [abs(end) for law in laws if law is not None for end in (*law.low, *law.high)]
    reach = max(ends, default=math.pi if axis == "q" else 1.0)
    x = [
        reach * (2.0 * k / (THRESHOLDS.curve_points - 1) - 1.0)
        for k in range(THRESHOLDS.curve_points)
    ]
    return axis, x, [_compute_effect_torque(form, axis, at, shapes) for at in x]


def _compute_effect_torque(form: Form, axis: str, x: float, shapes: Mapping[str, float]) -> float:
    """The column that is drawn, at one point of the axis, other variables at 1; 0 where it ends."""
    values: dict[str, float] = {}
    for shape in form.nonlinear_parameters:
        values[shape.name] = shape.grid[-1] if shape.grid else 6.0
    values |= {**shapes} | dict.fromkeys((*form.names, "v", "load", "static", "z"), 1.0)
    if axis == "load":  # both directions, the load growing outwards
        values |= {"load": abs(x), "static": abs(x), "v": _FUNCTIONS["sign"](x)}
    elif axis == "z":
        back = x < 0.0
        values["z"] = 1 - 2 * math.exp(-4 * (x + 1)) if back else 2 * math.exp(-4 * x) - 1
        values["v"] = 1.0 if back else -1.0
    elif axis == "since":
        values["since"] = x + 1.0
    else:
        values[axis] = x
    column = form.columns[-1] if axis == "q" else form.columns[0]
    try:
        result = float(column.equation.fold(values, _FUNCTIONS, math.pi, float))
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        return 0.0
    return result if math.isfinite(result) else 0.0


def resolve_robot(args: argparse.Namespace) -> Robot:
    """Reads the robot of the arguments; finds [home] where it is missing or poor, and prints it."""
    robot = read_robot_with_effects(args)
    if not robot.loops:
        return robot
    from modeler.derivation import complete_home  # not needed by commands that answer at once

    with show_activity(f"closing the loops of {robot.name}"):
        home = complete_home(robot)
    if home.message:
        print_result(home.message)
    return home.write_to_text(robot)


def read_robot_or_model(args: argparse.Namespace) -> "Robot | IdentifiedModel":
    """Reads what a command takes as ROBOT|MODEL; the model has the effects of its fit.

    Raises:
        DataError: other effects are wanted of a model.
    """
    if not args.robot.endswith(".json"):
        return resolve_robot(args)
    if args.effects is not None:
        raise OptionError(
            f"{{--effects}}: of a robot file only; {args.robot} is a model, which has those that "
            "it was fitted with; leave {--effects} out, or fit the robot with them"
        )
    from modeler.estimation import load_model  # a robot needs no fits

    return load_model(args.robot)


def read_options(
    args: argparse.Namespace, kind: type[O], head: str, stated: Mapping[str, Any]
) -> O:
    """Returns the options of a command: what was typed, over what the robot file states."""
    applied = {name: value for name, value in stated.items() if name not in args.typed}
    if applied:
        listed = ", ".join(f"{name} = {quote_value(value)}" for name, value in applied.items())
        print_note(f"by [{head}] of the robot file: {listed}")
    return kind.from_names({**vars(args), **applied})


def read_robot_with_effects(args: argparse.Namespace) -> Robot:
    """Reads the robot of the arguments, with the effects of --effects."""
    robot = read_robot_with_notes(args.robot)
    if args.effects is None:
        return robot
    from modeler.robot import replace_robot_effects  # most runs state none

    return replace_robot_effects(robot, args.effects, "--effects")


def read_robot_with_notes(name: str) -> Robot:
    """Reads a robot by name or file and prints the notes of the reader on stderr."""
    robot = read_robot(name)
    if len(robot.readings) > 1:
        print_note("\n  * ".join([f"{name}, read as a robot file:", *robot.readings]))
    elif robot.readings:
        print_note(f"{name}: {robot.readings[0]}")
    return robot


def run_robots(args: argparse.Namespace) -> RobotFile | list[RobotSummary]:
    """Prints the table of built-in robots, or one robot's file."""
    if args.robot is not None:
        text = read_robot_with_notes(args.robot).text
        print_result(text.rstrip())
        return {"name": args.robot, "text": text}
    robots = [read_robot(name) for name in list_builtin_robots()]
    width = max(len(robot.name) for robot in robots)
    for robot in robots:
        effects = ", ".join(use.effect for use in robot.effects) or "rigid links only"
        count = len(robot.coordinates)
        tree = len(robot.moving_joints)
        joints = f"{count} joints" + (f" of {tree}" if tree > count else "")
        print_result(f"{robot.name:<{width}}  {joints:<12}  {robot.title} ({effects})")
    return [
        {
            "name": robot.name,
            "title": robot.title,
            "joints": [joint.name for joint in robot.coordinates],
            "effects": [use.effect for use in robot.effects],
        }
        for robot in robots
    ]


def run_effects(args: argparse.Namespace) -> list[EffectSummary]:
    """Prints the catalogue, or one page of it; writes an effect of a robot as files."""
    model = robot = None
    if args.robot is not None and Path(args.robot).suffix.lower() == ".json":
        from modeler.estimation import load_model  # the catalogue needs no fits

        model = load_model(args.robot)
        robot = parse_robot_text(model.robot_text, f"{args.robot}, robot")
    elif args.robot is not None:
        robot = read_robot(args.robot)
    if args.export is not None and robot is not None:
        return _export_effect(args, robot, model)
    known = CATALOGUE if robot is None else robot.catalogue
    chosen = known
    if args.effect is not None:
        effect = find_effect(args.effect, known)
        if effect is None:
            names = [each.id for each in known]
            raise RobotError(
                f"effects: got {args.effect}{suggest_name(args.effect, names)}; expected one of "
                f"{', '.join(names)}, or one that the file of --robot defines"
            )
        chosen = (effect,)
    facts = [_describe_effect(effect) for effect in chosen]
    for fact in facts:
        print_result(f"{fact['id']:<22} {fact['equation']}")
        print_result(f"  {fact['title']}")
        if args.effect is not None:
            for name, value in fact.items():
                if name not in ("id", "equation", "title") and value:
                    print_result(
                        f"  {name:<12} {', '.join(value) if isinstance(value, list) else value}"
                    )
    return facts


def _export_effect(
    args: argparse.Namespace, robot: Robot, model: "IdentifiedModel | None"
) -> list[EffectSummary]:
    """Writes the definition of one effect, and its page."""
    from modeler import views  # the catalogue needs no pages
    from modeler.robot import export_effect

    text = export_effect(robot, args.export)
    effect = find_effect(args.export, robot.own_effects)
    assert effect is not None
    instance_shapes = [
        at.nonlinear_parameters
        for use in robot.effects
        if use.effect == effect.id
        for at in use.instances
    ]
    axis, x, y = _sample_effect(effect.forms[0], instance_shapes[0] if instance_shapes else {})
    label = {"q": "position [rad or m]", "v": "speed [rad/s or m/s]"}.get(axis, _AXES[axis])
    page = views.build_effect_page(effect, text, robot, model, (label, x, y))
    args.out = [Output(Path(args.out or ".", f"{effect.id}{end}")) for end in (".toml", ".html")]
    check_places(args)
    places = [place.file for place in args.out]
    write_all_without_overwriting(list(zip(places, (text, str(page)), strict=True)), args.force)
    print_lines(map(str, places), "written: ")
    return [_describe_effect(effect)]


def run_estimators(args: argparse.Namespace) -> list[EstimatorInfo]:
    """Prints the list, or some of it."""
    method_ids = list(ABOUT) if args.methods is None else args.methods.split(",")
    if unknown := [name for name in method_ids if name not in ABOUT]:
        raise DataError(f"estimators: {describe_unknown(unknown[0], list(ABOUT))}")
    chosen = [about for about in ABOUT.values() if about.id in method_ids]
    for about in chosen:
        print_result(f"{about.id:<10} {about.title}")
        print_result(f"  law        {about.law}")
        print_result(f"  source     {about.source}")
        print_result(f"  not        {about.limitations}")
        print_result(f"  assumes    {about.motion}")
    return chosen


def _describe_effect(effect: Effect) -> EffectSummary:
    return {
        "id": effect.id,
        "aliases": list(effect.aliases),
        "title": effect.title,
        "equation": effect.equation,
        "parameters": [column.prefix for column in effect.columns],
        "unit": [column.unit_revolute for column in effect.columns],
        "nonlinear_parameters": [
            f"{s.name}: {s.meaning}" for f in effect.forms for s in f.free_parameters
        ],
        "equivalent_effects": list(effect.equivalent_effects),
        "signature": effect.signature,
        "confounders": effect.confounders,
        "range": effect.range,
        "source": effect.source,
    }
