"""Effects of a robot file: those it names, and [own_effects] that the catalogue lacks."""

import dataclasses
import re
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.effects import (
    CATALOGUE,
    EXAMPLE,
    PASSIVE_FRICTION,
    PASSIVE_FRICTION_IS,
    Effect,
    EffectTarget,
    check_finite,
    find_effect,
    read_definition,
)
from modeler.robot.cells import read_number
from modeler.robot.robot import INERTIAL, EffectInstance, EffectUse, Robot
from modeler.robot.sections import Coupling, Joints, find_joint

_ID = re.compile(r"[a-z][a-z0-9_]*")
_WORDS = ("all", "auto", "undo", "rigid_body")  # mean something else where ids stand
_LOGGED = ("q", "qc", "qd", "qdd", "tau", "current", "temperature")  # columns of logs


def read_own_effects(
    value: Any,
    place: TomlCell,
    joints: Collection[str] | None = None,
    before: Sequence[Effect] = (),
) -> tuple[Effect, ...]:
    """Returns the effects that the file defines, in its order.

    Args:
        value: the table `own_effects`: id -> title, columns, shapes, unit, nonnegative, acts.
        place: of the file.
        joints: of the robot, whose motion equations may read; None: of a file that was read before.
        before: other effects of the robot, whose parameters are taken.

    Raises:
        RobotError: names that the catalogue has, and what `read_definition` refuses.
    """
    effects: list[Effect] = []
    for name, cell in place.enter("[own_effects]", value).read_table(EXAMPLE).items():
        here = place.enter(f"[own_effects.{name}]", cell)
        if not _ID.fullmatch(name) or name in _WORDS:
            raise here.make_error(
                f"got the name {quote_value(name)}; expected small letters, digits and _, such as "
                f"brake, and not {join_names(_WORDS)}"
            )
        if effect := find_effect(name):
            raise here.make_error(
                f"{quote_value(name)} is {effect.id} of the catalogue, which stays as it is; "
                "choose another name"
            )
        taken = collect_parameter_owners((*CATALOGUE, *before, *effects))
        taken |= dict.fromkeys(INERTIAL, "the links")
        taken |= dict.fromkeys(_LOGGED, "the logs")
        effects.append(read_definition(name, here, taken, joints=joints))
    return tuple(effects)


def collect_parameter_owners(effects: Sequence[Effect]) -> dict[str, str]:
    """Returns name of a parameter without its joint -> the effect that has it."""
    return {c.prefix: e.id for e in effects for form in e.forms for c in form.columns}


# The table [effects] of a robot file: which joint has which effect, and of what shape.


_ZERO = {"t": "t0", "T": "T0"}
"""Variable -> the key that says where it is 0; not needed, 0 if left out."""


def read_effects(
    place: TomlCell,
    moving: Joints,
    coupling: Coupling,
    catalogue: Sequence[Effect],
    platform: Sequence[str] = (),
) -> tuple[EffectUse, ...]:
    """Returns effects and their joints, in catalogue order.

    "all" means every actuated joint, and every motor of `[coupling]` for effects of coupled
    motors; passive joints have an effect only if they are named. `passive_friction` is viscous and
    Coulomb friction of joints without motor, "all" of them; it is read as these two. Effects with
    shape parameters stand as a list of tables: stribeck = [{joint = "2", vs = 0.1, d = 1}].

    Args:
        place: the table.
        moving: the joints by name.
        coupling: motors that turn with several of them.
        catalogue: the effects there are, those of the file included.
        platform: rows that move the platform: no joints that rub.

    Raises:
        RobotError: unknown effects, joints or shapes.
    """
    uses: dict[str, EffectUse] = {}
    for name, cell in place.read_table('[effects] viscous = "all"').items():
        effect = _read_effect(name, catalogue, place)
        if effect.id in uses:
            what = f"{quote_value(name)} is {effect.id}, which stands there already"
            raise place.make_error(f"{what}; keep one of them")
        here = place.enter(name, cell)
        if effect.is_coupled and not coupling:
            raise here.make_error(
                "acts on motors that turn with several joints, and the file couples none; add a "
                'table [coupling] with a line such as "6" = "q5 + q6"'
            )
        excluded_rows = platform if effect.acts is EffectTarget.PASSIVE else ()
        rows = {row: joint for row, joint in moving.items() if row not in excluded_rows}
        if isinstance(cell, list) and any(isinstance(entry, dict) for entry in cell):
            uses[effect.id] = _read_effect_instances(effect, rows, coupling, here)
        elif effect.usual_form.free_parameters:
            raise here.make_mismatch(f"its shapes, as in {_format_example(effect)}")
        else:  # shapes of one value have that value
            joints = _read_effect_joints(effect, rows, coupling, here)
            fixed = {shape.name: shape.grid[0] for shape in effect.forms[0].nonlinear_parameters}
            shaped = tuple(EffectInstance(joint, 0, fixed) for joint in joints) if fixed else ()
            uses[effect.id] = EffectUse(effect.id, joints, shaped)
        for name in uses[effect.id].joints:
            if read := effect.forms[0].find_references_to(name):
                raise here.make_error(
                    f"joint {quote_value(name)} is the one whose {join_names(read)} it reads as "
                    "another's; "
                    f"write {join_names(r[0] for r in read)} for its own, or take the joint out"
                )
    if passive_friction := uses.pop(PASSIVE_FRICTION, None):  # it becomes what it is made of
        for part in PASSIVE_FRICTION_IS:
            has = uses[part].joints if part in uses else ()
            if repeated_joints := [name for name in passive_friction.joints if name in has]:
                raise place.enter(PASSIVE_FRICTION).make_error(
                    f"joint {quote_value(repeated_joints[0])} has {part} already, which is a part "
                    "of it; take the joint out of one of them"
                )
            both = {*has, *passive_friction.joints}
            uses[part] = EffectUse(part, tuple(name for name in moving if name in both))
    return tuple(uses[e.id] for e in catalogue if e.id in uses and uses[e.id].joints)


def needs_reference(effect: Effect, instance: EffectInstance) -> bool:
    """Returns True if the effect depends on the torques of the links."""
    loads = {"load", "static", "torque"}
    form = effect.forms[instance.form]
    if form.is_windup:
        return False
    return not form.names.isdisjoint(loads) or effect.acts is EffectTarget.POSITION


def check_elastic_joints(robot: Robot, place: TomlCell) -> None:
    """Refuses elastic joints whose motion the C cannot step.

    Raises:
        RobotError: of a robot with loops, of a joint that turns with others, or without rotor.
    """
    tied = {*robot.coupling, *(name for row in robot.coupling.values() for name in row)}
    tied |= {*robot.relations, *(q[1:] for x in robot.relations.values() for q in x.names)}
    every = {joint: robot.find_joint_effects(joint.name) for joint in robot.moving_joints}
    forms = [form for effects in every.values() for _, form, _ in effects]
    for joint, effects in every.items():
        name = joint.name
        windups = [effect.id for effect, form, _ in effects if form.is_windup]
        why = ""
        if len(windups) > 1:
            why = "stands there twice; keep one of them"
        elif robot.loops:
            why = "cannot be elastic in a robot with loops; leave it out"
        elif name in tied:
            why = "turns with other joints, by [relations], [coupling] or [motors]; leave it out"
        elif not joint.actuated:
            why = "has no motor, which the elasticity would carry; leave it out"
        elif any(form.internal_state and form.internal_state.kind == "lag" for form in forms):
            why = "and an effect that lags need each other's motion; leave one of them out"
        elif not robot.has_effect("rotor_inertia", name):
            why = f'has no inertia of its motor; add "{name}" to rotor_inertia'
        if windups and why:
            raise place.enter(windups[0]).make_error(f"joint {quote_value(name)} {why}")


def _read_effect(name: str, catalogue: Sequence[Effect], place: TomlCell) -> Effect:
    effect = find_effect(name, catalogue)
    if effect is None:
        written = [e for e in catalogue if e.can_be_stated]
        names = [known for e in written for known in (e.id, *e.aliases)]
        raise place.make_error(
            f"there is no effect {quote_value(name)}{suggest_name(name, names)}; expected one of "
            f"{join_names(e.id for e in written)}, or [own_effects.{name}]"
        )
    if not effect.can_be_stated:
        raise place.make_error(
            f"{effect.id} is no function of the joints' motion, so it has no column; see "
            f"`modeler effects {effect.id}`, and `modeler add` for what can be done"
        )
    return effect


def _read_effect_joints(
    effect: Effect, moving: Joints, coupling: Coupling, place: TomlCell
) -> tuple[str, ...]:
    passive = effect.acts is EffectTarget.PASSIVE
    if passive and all(joint.actuated for joint in moving.values()):
        what = "acts on joints without motor, and every joint has one"
        raise place.make_error(f"{what}; leave it out")
    if place.value == "all":
        return tuple(
            name
            for name, joint in moving.items()
            if (name in coupling if effect.is_coupled else joint.actuated is not passive)
        )
    if not isinstance(place.value, list):
        raise place.make_mismatch('the joints that have it: "all" or ["1", "2"]')
    named = [find_joint(entry, moving, place).name for entry in place.value]
    for name in named:
        if named.count(name) > 1:
            raise place.make_error(f"joint {quote_value(name)} stands there twice; name it once")
        _check_coupled(effect, name, coupling, place)
        if passive and moving[name].actuated:
            what = f"joint {quote_value(name)} has a motor"
            raise place.make_error(f"{what}; write viscous and coulomb for it")
    return tuple(name for name in moving if name in named)


def _check_coupled(effect: Effect, name: str, coupling: Coupling, place: TomlCell) -> None:
    if effect.is_coupled and name not in coupling:
        raise place.make_error(
            f"joint {quote_value(name)} has no line in [coupling], which has "
            f"{join_names(coupling)}; add one, or take the joint out"
        )


def _read_effect_instances(
    effect: Effect, moving: Joints, coupling: Coupling, place: TomlCell
) -> EffectUse:
    instances: list[EffectInstance] = []
    for entry in place.value:
        if not isinstance(entry, dict) or "joint" not in entry:
            example = _format_example(effect)
            raise place.make_error(f"got {quote_value(entry)}; expected tables, as in {example}")
        name = find_joint(entry["joint"], moving, place).name
        _check_coupled(effect, name, coupling, place)
        stated_values = {key: value for key, value in entry.items() if key != "joint"}
        number = _find_form(effect, stated_values, place)
        form = effect.forms[number]
        shapes = {s.name: s.grid[0] for s in form.nonlinear_parameters if len(s.grid) == 1}
        for key, parameter_value in stated_values.items():
            at = place.enter(key, parameter_value)  # "30 deg" of an angle
            is_text = isinstance(parameter_value, str)
            shapes[key] = read_number(at, {}) if is_text else at.read_number("0.1")
        here = place.enter(f"joint {quote_value(name)}")
        for (
            shape
        ) in form.nonlinear_parameters:  # lengths, times, powers below zero; ripples without waves
            parameter_value, waves = shapes[shape.name], shape.scale == "waves"
            positive = waves or (shape.scale != "own" and min(shape.grid) >= 0.0)
            above = waves or shape.scale == "stiffness"
            if positive and (parameter_value < 0.0 or (above and parameter_value == 0.0)):
                raise here.enter(shape.name).make_error(
                    f"got {parameter_value:g} ({shape.meaning}); expected a number above 0"
                )
        check_finite(form, here, shapes)
        unlabelled = [dataclasses.replace(other, label="") for other in instances]
        if EffectInstance(name, number, shapes) in unlabelled:
            values = join_names(f"{key} = {value:g}" for key, value in shapes.items())
            raise here.make_error(f"{values} stands twice; remove one")
        before = sum(other.joint == name for other in instances)
        instances.append(EffectInstance(name, number, shapes, f"_{before + 1}" if before else ""))
    joints = tuple(name for name in moving if any(i.joint == name for i in instances))
    return EffectUse(effect.id, joints, tuple(instances))


def _find_form(effect: Effect, stated_values: Mapping[str, Any], place: TomlCell) -> int:
    """Place of the form that these shapes belong to."""
    for number, form in enumerate(effect.forms):
        if effect.usual_form.is_windup and not form.is_windup:
            continue  # what a diagnosis tries
        zeros = {_ZERO[name] for name in form.names if name in _ZERO}
        if (
            {s.name for s in form.free_parameters}
            <= stated_values.keys()
            <= {s.name for s in form.nonlinear_parameters} | zeros
        ):
            return number
    raise place.make_error(
        f"got the shapes {join_names(stated_values) if stated_values else 'none'}; expected "
        f"{_format_example(effect)}"
    )


def _format_example(effect: Effect) -> str:
    """How the effect is written."""
    shapes = effect.usual_form.free_parameters or effect.forms[-1].free_parameters
    values = "".join(f", {s.name} = {s.grid[0] if s.grid else 7:g}" for s in shapes)
    return f'{effect.id} = [{{joint = "2"{values}}}]'
