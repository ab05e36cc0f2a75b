"""The tables [own_effects.<id>] of a robot file: effects that the catalogue lacks."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.core.expression import FUNCTIONS
from modeler.effects import (
    CATALOGUE,
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
from modeler.robot.finite import check_combinations, check_finite
from modeler.robot.place import Place, listed, near, shown
from modeler.robot.robot import INERTIAL

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
        found.append(_effect(name, table_at(cell, here, _EXAMPLE), (*CATALOGUE, *found), here))
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


def _effect(name: str, table: Mapping[str, Any], known: Sequence[Effect], place: Place) -> Effect:
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
