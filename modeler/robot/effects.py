"""Effects of a robot file: those it names, and [own_effects] that the catalogue lacks."""

import dataclasses
import re
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from modeler.core.toml_cells import Place, listed, near, shown
from modeler.effects import (
    CATALOGUE,
    EXAMPLE,
    PASSIVE_FRICTION,
    PASSIVE_FRICTION_IS,
    Acts,
    Effect,
    check_finite,
    effect_named,
    read_definition,
)
from modeler.robot.cells import number_at
from modeler.robot.robot import INERTIAL, EffectInstance, EffectUse, Joint
from modeler.robot.sections import Coupling, joint_at

_ID = re.compile(r"[a-z][a-z0-9_]*")
_WORDS = ("all", "auto", "undo", "rigid_body")  # mean something else where ids stand
_LOGGED = ("q", "qc", "qd", "qdd", "tau", "current", "temperature")  # columns of logs


def read_own_effects(
    value: Any, place: Place, joints: Collection[str] | None = None, before: Sequence[Effect] = ()
) -> tuple[Effect, ...]:
    """The effects that the file defines, in its order.

    Args:
        value: the table `own_effects`: id -> title, columns, shapes, unit, nonnegative, acts.
        place: of the file.
        joints: of the robot, whose motion equations may read; None: of a file that was read before.
        before: other effects of the robot, whose parameters are taken.

    Raises:
        RobotError: names that the catalogue has, and what `read_definition` refuses.
    """
    found: list[Effect] = []
    for name, cell in place.at("[own_effects]", value).table(EXAMPLE).items():
        here = place.at(f"[own_effects.{name}]", cell)
        if not _ID.fullmatch(name) or name in _WORDS:
            raise here.error(
                f"got the name {shown(name)}; expected small letters, digits and _, such as brake, "
                f"and not {listed(_WORDS)}"
            )
        if effect := effect_named(name):
            raise here.error(
                f"{shown(name)} is {effect.id} of the catalogue, which stays as it is; choose "
                "another name"
            )
        taken = parameter_owners((*CATALOGUE, *before, *found)) | dict.fromkeys(
            INERTIAL, "the links"
        )
        taken |= dict.fromkeys(_LOGGED, "the logs")
        found.append(read_definition(name, here, taken, joints=joints))
    return tuple(found)


def parameter_owners(effects: Sequence[Effect]) -> dict[str, str]:
    """Name of a parameter without its joint -> the effect that has it."""
    return {c.prefix: e.id for e in effects for form in e.forms for c in form.columns}


# The table [effects] of a robot file: which joint has which effect, and of what shape.


_ZERO = {"t": "t0", "T": "T0"}
"""Variable -> the key that says where it is 0; not needed, 0 if left out."""


def read_effects(
    place: Place,
    moving: Mapping[str, Joint],
    coupling: Coupling,
    catalogue: Sequence[Effect],
    platform: Sequence[str] = (),
) -> tuple[EffectUse, ...]:
    """Effects and their joints, in catalogue order.

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
    for name, cell in place.table('[effects] viscous = "all"').items():
        effect = _effect(name, catalogue, place)
        if effect.id in uses:
            raise place.error(
                f"{shown(name)} is {effect.id}, which stands there already; keep one of them"
            )
        here = place.at(name, cell)
        if effect.coupled and not coupling:
            raise here.error(
                "acts on motors that turn with several joints, and the file couples none; add a "
                'table [coupling] with a line such as "6" = "q5 + q6"'
            )
        away = platform if effect.acts is Acts.PASSIVE else ()
        rows = {row: joint for row, joint in moving.items() if row not in away}
        if isinstance(cell, list) and any(isinstance(entry, dict) for entry in cell):
            uses[effect.id] = _shaped(effect, rows, coupling, here)
        elif effect.forms[0].free:
            raise here.mismatch(f"its shapes, as in {_example(effect)}")
        else:  # shapes of one value have that value
            joints = _joints(effect, rows, coupling, here)
            fixed = {shape.name: shape.grid[0] for shape in effect.forms[0].shapes}
            shaped = tuple(EffectInstance(joint, 0, fixed) for joint in joints) if fixed else ()
            uses[effect.id] = EffectUse(effect.id, joints, shaped)
        for name in uses[effect.id].joints:
            if read := effect.forms[0].reads_as_other(name):
                raise here.error(
                    f"joint {shown(name)} is the one whose {listed(read)} it reads as another's; "
                    f"write {listed(r[0] for r in read)} for its own, or take the joint out"
                )
    if rubbing := uses.pop(PASSIVE_FRICTION, None):  # it becomes what it is made of
        for part in PASSIVE_FRICTION_IS:
            has = uses[part].joints if part in uses else ()
            if twice := [name for name in rubbing.joints if name in has]:
                raise place.at(PASSIVE_FRICTION).error(
                    f"joint {shown(twice[0])} has {part} already, which is a part of it; take the "
                    "joint out of one of them"
                )
            both = {*has, *rubbing.joints}
            uses[part] = EffectUse(part, tuple(name for name in moving if name in both))
    return tuple(uses[e.id] for e in catalogue if e.id in uses and uses[e.id].joints)


def needs_reference(effect: Effect, instance: EffectInstance) -> bool:
    """True if the effect depends on the torques of the links."""
    loads = {"load", "static", "torque"}
    named = not effect.forms[instance.form].names.isdisjoint(loads)
    return named or effect.acts is Acts.POSITION


def _effect(name: str, catalogue: Sequence[Effect], place: Place) -> Effect:
    effect = effect_named(name, catalogue)
    if effect is None:
        written = [e for e in catalogue if e.written]
        names = [known for e in written for known in (e.id, *e.aliases)]
        raise place.error(
            f"there is no effect {shown(name)}{near(name, names)}; expected one of "
            f"{listed(e.id for e in written)}, or [own_effects.{name}]"
        )
    if not effect.written:
        raise place.error(
            f"{effect.id} is no function of the joints' motion, so it has no column; see "
            f"`modeler effects {effect.id}`, and `modeler add` for what can be done"
        )
    return effect


def _joints(
    effect: Effect, moving: Mapping[str, Joint], coupling: Coupling, place: Place
) -> tuple[str, ...]:
    passive = effect.acts is Acts.PASSIVE
    if passive and all(joint.actuated for joint in moving.values()):
        raise place.error("acts on joints without motor, and every joint has one; leave it out")
    if place.value == "all":
        return tuple(
            name
            for name, joint in moving.items()
            if (name in coupling if effect.coupled else joint.actuated is not passive)
        )
    if not isinstance(place.value, list):
        raise place.mismatch('the joints that have it: "all" or ["1", "2"]')
    named = [joint_at(entry, moving, place).name for entry in place.value]
    for name in named:
        if named.count(name) > 1:
            raise place.error(f"joint {shown(name)} stands there twice; name it once")
        _check_coupled(effect, name, coupling, place)
        if passive and moving[name].actuated:
            raise place.error(f"joint {shown(name)} has a motor; write viscous and coulomb for it")
    return tuple(name for name in moving if name in named)


def _check_coupled(effect: Effect, name: str, coupling: Coupling, place: Place) -> None:
    if effect.coupled and name not in coupling:
        raise place.error(
            f"joint {shown(name)} has no line in [coupling], which has {listed(coupling)}; "
            "add one, or take the joint out"
        )


def _shaped(
    effect: Effect, moving: Mapping[str, Joint], coupling: Coupling, place: Place
) -> EffectUse:
    found: list[EffectInstance] = []
    for entry in place.value:
        if not isinstance(entry, dict) or "joint" not in entry:
            raise place.error(f"got {shown(entry)}; expected tables, as in {_example(effect)}")
        name = joint_at(entry["joint"], moving, place).name
        _check_coupled(effect, name, coupling, place)
        given = {key: value for key, value in entry.items() if key != "joint"}
        number = _form_of(effect, given, place)
        form = effect.forms[number]
        shapes = {s.name: s.grid[0] for s in form.shapes if len(s.grid) == 1}
        for key, worth in given.items():
            at = place.at(key, worth)  # "30 deg" of an angle
            shapes[key] = number_at(at, {}) if isinstance(worth, str) else at.number("0.1")
        here = place.at(f"joint {shown(name)}")
        for shape in form.shapes:  # lengths, times, powers below zero; ripples without waves
            worth, waves = shapes[shape.name], shape.scale == "waves"
            positive = waves or (shape.scale != "own" and min(shape.grid) >= 0.0)
            if positive and (worth < 0.0 or (waves and worth == 0.0)):
                raise here.at(shape.name).error(
                    f"got {worth:g} ({shape.meaning}); expected a number above 0"
                )
        check_finite(form, here, shapes)
        if EffectInstance(name, number, shapes) in [
            dataclasses.replace(other, label="") for other in found
        ]:
            raise here.error(
                f"{listed(f'{k} = {v:g}' for k, v in shapes.items())} stands twice; remove one"
            )
        before = sum(other.joint == name for other in found)
        found.append(EffectInstance(name, number, shapes, f"_{before + 1}" if before else ""))
    joints = tuple(name for name in moving if any(i.joint == name for i in found))
    return EffectUse(effect.id, joints, tuple(found))


def _form_of(effect: Effect, given: Mapping[str, Any], place: Place) -> int:
    """Place of the form that these shapes belong to."""
    for number, form in enumerate(effect.forms):
        zeros = {_ZERO[name] for name in form.names if name in _ZERO}
        if {s.name for s in form.free} <= given.keys() <= {s.name for s in form.shapes} | zeros:
            return number
    raise place.error(
        f"got the shapes {listed(given) if given else 'none'}; expected {_example(effect)}"
    )


def _example(effect: Effect) -> str:
    """How the effect is written."""
    shapes = effect.forms[0].free or effect.forms[-1].free
    values = "".join(f", {s.name} = {s.grid[0] if s.grid else 7:g}" for s in shapes)
    return f'{effect.id} = [{{joint = "2"{values}}}]'
