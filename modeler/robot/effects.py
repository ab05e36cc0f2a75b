"""Effects of a robot file: those it names, and [own_effects] that the catalogue lacks."""

import dataclasses
import re
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.core.expression import FUNCTIONS
from modeler.effects.catalogue import CATALOGUE, PASSIVE_FRICTION, PASSIVE_FRICTION_IS, effect_named
from modeler.effects.effect import (
    VARIABLES,
    Acts,
    Effect,
    EffectColumn,
    EnergyBlock,
    Form,
    Memory,
    Shape,
    Shows,
)
from modeler.robot.cells import expression_at, list_at, plain_number, table_at, text_at
from modeler.robot.robot import (
    INERTIAL,
    EffectInstance,
    EffectUse,
    Joint,
    Place,
    listed,
    near,
    shown,
)
from modeler.robot.sections import Coupling, check_combinations, check_finite, joint_at

_EXAMPLE = '[own_effects.brake] columns = {Keb = "v*abs(v)"}'
_KEYS = ("title", "columns", "shapes", "unit", "nonnegative", "acts")
_ID = re.compile(r"[a-z][a-z0-9_]*")
_PREFIX = re.compile(r"[A-Za-z]([A-Za-z0-9]*[A-Za-z])?")
_SHAPE = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_UNIT = re.compile(r"[A-Za-z0-9 .^()-]+([*/][A-Za-z0-9 .^()-]+)*")  # it becomes a comment in C
_WORDS = ("all", "auto", "undo", "rigid_body")  # mean something else where ids stand
_LOGGED = ("q", "qc", "qd", "qdd", "tau", "current", "temperature")  # columns of logs
_RESERVED = ("joint", "t0", "T0", "pi", "lambda", *FUNCTIONS)  # keys of [effects], and the language
_READ = {
    "joint": (Acts.JOINT, tuple(name for name in VARIABLES if name != "rate")),
    "position": (Acts.POSITION, ("q",)),
}
"""acts -> what it is, and the variables that its equations may use."""


def read_own_effects(value: Any, place: Place) -> tuple[Effect, ...]:
    """The effects that the file defines, in its order.

    Args:
        value: the table `own_effects`: id -> title, columns, shapes, unit, nonnegative, acts.
        place: of the file.

    Raises:
        RobotError: names that the catalogue has, equations that cannot be read or that have no
            finite value, unknown variables, shapes that no equation uses, other mistakes.
    """
    found: list[Effect] = []
    for name, cell in table_at(value, place.at("[own_effects]"), _EXAMPLE).items():
        here = place.at(f"[own_effects.{name}]")
        _check_id(name, here)
        found.append(_own_effect(name, table_at(cell, here, _EXAMPLE), (*CATALOGUE, *found), here))
    return tuple(found)


def _check_id(name: str, place: Place) -> None:
    if not _ID.fullmatch(name) or name in _WORDS:
        raise place.error(
            f"got the name {shown(name)}; expected small letters, digits and _, such as brake, "
            f"and not {listed(_WORDS)}"
        )
    for effect in CATALOGUE:
        if name == effect.id or name in effect.aliases:
            raise place.error(
                f"{shown(name)} is {effect.id} of the catalogue, which stays as it is; choose "
                "another name"
            )


def _own_effect(
    name: str, table: Mapping[str, Any], known: Sequence[Effect], place: Place
) -> Effect:
    for key in table:
        if key not in _KEYS:
            raise place.error(
                f"unknown key {shown(key)}{near(key, _KEYS)}; expected {listed(_KEYS)}"
            )
    acts, variables = _acts(table.get("acts", "joint"), place.at("acts"))
    shapes = _shapes(table.get("shapes", {}), place.at("shapes"))
    allowed = (*variables, *(shape.name for shape in shapes))
    columns = _columns(table, allowed, known, place)
    form = Form(columns, shapes, _memory(columns, shapes, place))
    _check_form(form, acts, place)
    names = [_PLAIN[variable] for variable in _PLAIN if variable in form.names]
    quantities = " and ".join(dict.fromkeys(names)) or "time"
    return Effect(
        id=name,
        aliases=(),
        title=text_at(table.get("title", f"{name} of the robot file"), place.at("title"), '"drag"'),
        equation=" + ".join(f"{c.prefix} * ({c.equation.text})" for c in columns),
        forms=(form,),
        acts=acts,
        family=name,
        signature=f"residual against {quantities}: the curve of its equation",
        shows=_shows(form, acts),
        look_alikes="whatever has nearly the same curve on the motion of the logs; log more of the "
        f"range of {quantities}",
        range="parameters not negative" if columns[0].nonnegative else "either sign",
        source="the robot file",
        timing="a" in form.names,
    )


_PLAIN = {
    "q": "position", "v": "speed", "a": "acceleration", "load": "load", "static": "load",
    "torque": "torque", "t": "time", "T": "temperature", "z": "travel since the last reversal",
}  # fmt: skip


_AXES: dict[str, Shows] = {
    "T": "T", "t": "t", "load": "load", "static": "load", "torque": "torque", "z": "travel",
    "q": "q", "a": "a",
}  # fmt: skip
"""Variable -> axis; the first that an equation uses shows it."""


def _shows(form: Form, acts: Acts) -> Shows:
    """Friction that also depends on something else shows itself there, turned with the motion."""
    if acts is Acts.POSITION:
        return "itself"
    return next((axis for name, axis in _AXES.items() if name in form.names), "v")


def _acts(value: Any, place: Place) -> tuple[Acts, tuple[str, ...]]:
    if not isinstance(value, str) or value not in _READ:
        raise place.error(
            f'got {shown(value)}; expected "joint" (adds to the torque of its joint) or "position" '
            "(moves the links from the measured position)"
        )
    return _READ[value]


def _shapes(value: Any, place: Place) -> tuple[Shape, ...]:
    shapes = []
    for name, cell in table_at(value, place, "shapes = {c = [-1, 0, 1]}").items():
        if not _SHAPE.fullmatch(name) or name in VARIABLES or name in _RESERVED:
            raise place.error(
                f"got the name {shown(name)}; expected letters, digits and _, and neither a "
                f"variable ({listed(VARIABLES)}) nor {listed(_RESERVED)}"
            )
        here = place.at(name)
        cells = cell if isinstance(cell, list) else [cell]
        grid = sorted(plain_number(entry, here, "0.1") for entry in list_at(cells, here, "[0.1]"))
        if not grid:
            raise here.error("got an empty list; expected values to try first, as in [0.1, 0.3]")
        if len(set(grid)) < len(grid):
            raise here.error(f"got {shown(cell)}; a value stands there twice, name it once")
        meaning = f"first tried at {' '.join(f'{entry:g}' for entry in grid)}"
        shapes.append(Shape(name, "own", tuple(grid), _limits(grid), meaning))
    check_combinations(shapes, place)
    return tuple(shapes)


def _limits(grid: Sequence[float]) -> tuple[float, float]:
    """How far refining may go: one step of the grid beyond its ends; positive stays positive."""
    if len(grid) == 1:
        return grid[0], grid[0]
    if grid[0] > 0.0:
        return grid[0] * grid[0] / grid[1], grid[-1] * grid[-1] / grid[-2]
    return 2.0 * grid[0] - grid[1], 2.0 * grid[-1] - grid[-2]


def _columns(
    table: Mapping[str, Any], allowed: Sequence[str], known: Sequence[Effect], place: Place
) -> tuple[EffectColumn, ...]:
    here = place.at("columns")
    if not table.get("columns"):
        raise here.error(f"is missing; expected parameters and their equations, as in {_EXAMPLE}")
    cells = table_at(table["columns"], here, _EXAMPLE)
    units = _units(table.get("unit", "SI"), list(cells), place.at("unit"))
    nonnegative = table.get("nonnegative", False)
    if not isinstance(nonnegative, bool):
        raise place.at("nonnegative").error(f"got {shown(nonnegative)}; expected true or false")
    owners = {c.prefix: e.id for e in known for form in e.forms for c in form.columns}
    owners |= dict.fromkeys(INERTIAL, "the links") | dict.fromkeys(_LOGGED, "the logs")
    columns = []
    for prefix, cell in cells.items():
        _check_prefix(prefix, owners, here)
        equation = expression_at(cell, here.at(prefix))
        for name in sorted(equation.names):
            if name not in allowed:
                raise here.at(prefix).error(
                    f"got {shown(equation.text)}: {name} is unknown{near(name, allowed)}; expected "
                    f"names among {listed(allowed)}; list others under shapes"
                )
        unit = units[prefix]
        columns.append(
            EffectColumn(prefix, equation, unit, unit, "other", EnergyBlock.OWN, nonnegative)
        )
    return tuple(columns)


def _check_prefix(prefix: str, owners: Mapping[str, str], place: Place) -> None:
    if not _PREFIX.fullmatch(prefix):
        raise place.error(
            f"got the parameter {shown(prefix)}; expected letters and digits, a letter first and "
            "last, such as Keb (the name of the joint follows)"
        )
    if prefix in owners:
        raise place.error(
            f"the parameter {shown(prefix)} is that of {owners[prefix]} already; choose another "
            "name"
        )


def _units(value: Any, prefixes: Sequence[str], place: Place) -> dict[str, str]:
    cells = value if isinstance(value, dict) else dict.fromkeys(prefixes, value)
    for prefix, unit in cells.items():
        if prefix not in prefixes:
            raise place.error(
                f"got {shown(prefix)}, which is no parameter of this effect; expected "
                f"{listed(prefixes)}"
            )
        if not isinstance(unit, str) or not _UNIT.fullmatch(unit):
            raise place.error(f'got {shown(unit)}; expected text such as "N*m*s/rad"')
    return dict.fromkeys(prefixes, "SI") | cells


def _memory(
    columns: Sequence[EffectColumn], shapes: Sequence[Shape], place: Place
) -> Memory | None:
    """Of the inner state z, the bristle that turns over the travel d."""
    if not any("z" in column.equation.names for column in columns):
        return None
    for shape in shapes:
        if shape.name == "d" and shape.grid[0] > 0.0:
            return Memory("slip", "d")
    raise place.at("shapes").error(
        "z turns over a travel of the joint, which has no positive values here; add it, as in "
        "shapes = {d = [0.002, 0.02]}"
    )


def _check_form(form: Form, acts: Acts, place: Place) -> None:
    """Every shape is used, and every equation has a value wherever a joint may be."""
    memory = {form.memory.shape} if form.memory else set()
    used = frozenset().union(memory, *(column.equation.names for column in form.columns))
    for shape in form.shapes:
        if shape.name not in used:
            raise place.at("shapes").error(f"no equation uses {shape.name}; use it or take it out")
    for column in form.columns:
        here = place.at(f"columns, {column.prefix}")
        if acts is Acts.POSITION and re.search(r"\b(abs|sign)\b", column.equation.text):
            raise here.error(
                f"got {shown(column.equation.text)}; what moves the position is differentiated "
                "twice: expected an equation without abs and sign"
            )
    check_finite(form, place.at("columns"))


# The table [effects] of a robot file: which joint has which effect, and of what shape.


_ZERO = {"t": "t0", "T": "T0"}
"""Variable -> the key that says where it is 0; not needed, 0 if left out."""


def read_effects(
    value: Any,
    moving: Mapping[str, Joint],
    coupling: Coupling,
    catalogue: Sequence[Effect],
    place: Place,
    platform: Sequence[str] = (),
) -> tuple[EffectUse, ...]:
    """Effects and their joints, in catalogue order.

    "all" means every actuated joint, and every motor of `[coupling]` for effects of coupled
    motors; passive joints have an effect only if they are named. `passive_friction` is viscous and
    Coulomb friction of joints without motor, "all" of them; it is read as these two. Effects with
    shape parameters stand as a list of tables: stribeck = [{joint = "2", vs = 0.1, d = 1}].

    Args:
        value: the table.
        moving: the joints by name.
        coupling: motors that turn with several of them.
        catalogue: the effects there are, those of the file included.
        place: of the table.
        platform: rows that move the platform: no joints that rub.

    Raises:
        RobotError: unknown effects, joints or shapes.
    """
    uses: dict[str, EffectUse] = {}
    for name, cell in table_at(value, place, '[effects] viscous = "all"').items():
        effect = _effect(name, catalogue, place)
        if effect.id in uses:
            raise place.error(
                f"{shown(name)} is {effect.id}, which stands there already; keep one of them"
            )
        here = place.at(name)
        _check_motors(effect, coupling, here)
        away = platform if effect.acts is Acts.PASSIVE else ()
        rows = {row: joint for row, joint in moving.items() if row not in away}
        uses[effect.id] = _use(effect, cell, rows, coupling, here)
    _spell_out(uses, moving, place)
    return tuple(uses[e.id] for e in catalogue if e.id in uses and uses[e.id].joints)


def _use(
    effect: Effect, cell: Any, moving: Mapping[str, Joint], coupling: Coupling, place: Place
) -> EffectUse:
    """The effect with its joints, or with its shapes."""
    if isinstance(cell, list) and any(isinstance(entry, dict) for entry in cell):
        return _shaped(effect, cell, moving, coupling, place)
    if effect.forms[0].free:
        raise place.error(f"got {shown(cell)}; expected its shapes, as in {_example(effect)}")
    return _plain(effect, _joints(effect, cell, moving, coupling, place))


def _spell_out(uses: dict[str, EffectUse], moving: Mapping[str, Joint], place: Place) -> None:
    """`passive_friction` becomes what it is made of: viscous and Coulomb friction.

    Raises:
        RobotError: one of its joints has either already.
    """
    rubbing = uses.pop(PASSIVE_FRICTION, None)
    if rubbing is None:
        return
    for effect in PASSIVE_FRICTION_IS:
        own = uses[effect].joints if effect in uses else ()
        for name in rubbing.joints:
            if name in own:
                raise place.at(PASSIVE_FRICTION).error(
                    f"joint {shown(name)} has {effect} already, which is a part of it; take the "
                    "joint out of one of them"
                )
        both = tuple(name for name in moving if name in own or name in rubbing.joints)
        uses[effect] = EffectUse(effect, both)


def needs_reference(effect: Effect, instance: EffectInstance) -> bool:
    """True if the effect depends on the torques of the links."""
    loads = {"load", "static", "torque"}
    named = not effect.forms[instance.form].names.isdisjoint(loads)
    return named or effect.acts is Acts.POSITION


def _effect(name: str, catalogue: Sequence[Effect], place: Place) -> Effect:
    effect = effect_named(name, catalogue)
    written = [e for e in catalogue if e.written]
    if effect is None:
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


def _check_motors(effect: Effect, coupling: Coupling, place: Place) -> None:
    if effect.coupled and not coupling:
        raise place.error(
            "acts on motors that turn with several joints, and the file couples none; add a "
            'table [coupling] with a line such as "6" = "q5 + q6"'
        )


def _plain(effect: Effect, joints: tuple[str, ...]) -> EffectUse:
    """The effect on joints that are only named; shapes of one value have that value."""
    fixed = {shape.name: shape.grid[0] for shape in effect.forms[0].shapes}
    shaped = tuple(EffectInstance(name, 0, fixed) for name in joints) if fixed else ()
    return EffectUse(effect.id, joints, shaped)


def _joints(
    effect: Effect, cell: Any, moving: Mapping[str, Joint], coupling: Coupling, place: Place
) -> tuple[str, ...]:
    passive = effect.acts is Acts.PASSIVE
    if passive and all(joint.actuated for joint in moving.values()):
        raise place.error("acts on joints without motor, and every joint has one; leave it out")
    if cell == "all":
        return tuple(
            name
            for name, joint in moving.items()
            if (name in coupling if effect.coupled else joint.actuated is not passive)
        )
    if not isinstance(cell, list):
        raise place.error(
            f'got {shown(cell)}; expected the joints that have it: "all" or ["1", "2"]'
        )
    named = [joint_at(entry, moving, place).name for entry in cell]
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
    effect: Effect, cell: list[Any], moving: Mapping[str, Joint], coupling: Coupling, place: Place
) -> EffectUse:
    found: list[EffectInstance] = []
    for entry in cell:
        if not isinstance(entry, dict) or "joint" not in entry:
            raise place.error(f"got {shown(entry)}; expected tables, as in {_example(effect)}")
        name = joint_at(entry["joint"], moving, place).name
        _check_coupled(effect, name, coupling, place)
        given = {key: value for key, value in entry.items() if key != "joint"}
        form = _form(effect, given, place)
        shapes = {s.name: s.grid[0] for s in effect.forms[form].shapes if len(s.grid) == 1}
        shapes |= {k: plain_number(v, place.at(k), "0.1") for k, v in given.items()}
        here = place.at(f"joint {shown(name)}")
        _check_signs(effect.forms[form].shapes, shapes, here)
        check_finite(effect.forms[form], here, shapes)
        if EffectInstance(name, form, shapes) in [dataclasses.replace(i, label="") for i in found]:
            raise here.error(
                f"{listed(f'{k} = {v:g}' for k, v in shapes.items())} stands twice; remove one"
            )
        before = sum(other.joint == name for other in found)
        found.append(EffectInstance(name, form, shapes, f"_{before + 1}" if before else ""))
    joints = tuple(name for name in moving if any(i.joint == name for i in found))
    return EffectUse(effect.id, joints, tuple(found))


def _check_signs(shapes: Sequence[Shape], values: Mapping[str, float], place: Place) -> None:
    """Refuse lengths, times, powers and the like below zero, and ripples without waves."""
    for shape in shapes:
        value = values[shape.name]
        waves = shape.scale == "waves"
        positive = waves or (shape.scale != "own" and min(shape.grid) >= 0.0)
        if positive and (value < 0.0 or (waves and value == 0.0)):
            raise place.at(shape.name).error(
                f"got {value:g} ({shape.meaning}); expected a number above 0"
            )


def _form(effect: Effect, given: Mapping[str, Any], place: Place) -> int:
    """Place of the form that these shapes belong to."""
    for place_of, form in enumerate(effect.forms):
        needed = {shape.name for shape in form.free}
        allowed = needed | {s.name for s in form.shapes} | _zeros(form)
        if needed <= given.keys() <= allowed:
            return place_of
    raise place.error(
        f"got the shapes {listed(given) if given else 'none'}; expected {_example(effect)}"
    )


def _zeros(form: Form) -> set[str]:
    return {_ZERO[name] for name in form.names if name in _ZERO}


def _example(effect: Effect) -> str:
    """How the effect is written."""
    shapes = effect.forms[0].free or effect.forms[-1].free
    values = "".join(f", {s.name} = {s.grid[0] if s.grid else 7:g}" for s in shapes)
    return f'{effect.id} = [{{joint = "2"{values}}}]'
