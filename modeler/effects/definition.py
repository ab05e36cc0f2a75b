"""An effect from its table: one of the catalogue, or one that a robot file defines itself."""

import dataclasses
import itertools
import math
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from modeler.core.expression import FUNCTIONS, LAW, Expression
from modeler.core.law import BESIDE, MOST as MOST_VALUES, Law
from modeler.core.toml_cells import LARGEST, Place, listed, near, shown
from modeler.effects.effect import (
    MOTION,
    TURN,
    VARIABLES,
    Acts,
    Effect,
    EffectColumn,
    EnergyBlock,
    Form,
    Memory,
    Needs,
    Shape,
    Shows,
)

EXAMPLE = '[own_effects.brake] columns = {Keb = "v*abs(v)"}'
MOST = 100
"""Combinations of the first values of shapes: a diagnosis tries each on each joint."""

_KEYS = ("title", "columns", "shapes", "unit", "nonnegative", "acts", "lag", "law")
_LAW = "law = {low = [-1], high = [1], cells = [2], values = [0, 0, 0, 1, 1]}"
_SLIPS = (
    "turns over a travel of the joint, which has no positive values here; add it, as in shapes = "
    "{d = [0.002, 0.02"
)
_LAGS = "lags by a time, which has no positive values here; add it, as in shapes = {tau = [0.1, 1"
_CATALOGUE_KEYS = (
    *_KEYS, "scale", "limits", "meaning", "prismatic_unit", "kind", "energy", "largest",
    "resonance", "forms", "needs",
)  # fmt: skip
"""What the catalogue says of an effect, besides fields of `Effect` as they are."""

_PREFIX = re.compile(r"[A-Za-z]([A-Za-z0-9]*[A-Za-z])?")
_SHAPE = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_UNIT = re.compile(r"[A-Za-z0-9 .^()-]+([*/][A-Za-z0-9 .^()-]+)*")  # it becomes a comment in C
_RESERVED = ("joint", "t0", "T0", "pi", "lambda", *FUNCTIONS, LAW)  # [effects], and the language
_STATES = 12  # of a joint, in which equations are tried, besides rest

_PLAIN = {
    "q": "position", "v": "speed", "a": "acceleration", "load": "load", "static": "load",
    "torque": "torque", "t": "time", "T": "temperature", "since": "time since the last reversal",
    "z": "travel since the last reversal",
}  # fmt: skip
_AXES: dict[str, Shows] = {
    "T": "T", "t": "t", "load": "load", "static": "load", "torque": "torque", "since": "since",
    "z": "travel", "q": "q", "a": "a",
}  # fmt: skip
"""Variable -> axis; the first that an equation uses shows it: friction that also depends on
something else shows itself there, turned with the motion."""


def read_definition(
    name: str, place: Place, taken: Mapping[str, str], own: bool = True,
    joints: Collection[str] | None = (),
) -> Effect:  # fmt: skip
    """The effect of one table.

    Args:
        name: its id.
        place: the table: title, columns, shapes, unit, nonnegative, acts, lag, law; in the
            catalogue also what else an `Effect` says of itself.
        taken: names of parameters that it must not have -> whose they are.
        own: of a robot file: it has the first keys only, and its equations are tried.
        joints: whose motion its equations may read, as `v3`; None: they were checked before.

    Raises:
        RobotError: equations that cannot be read or that have no finite value, unknown variables,
            shapes that no equation uses, other mistakes.
    """
    table = place.checked_table(_KEYS, EXAMPLE) if own else place.table(EXAMPLE)
    acts, variables = _acts(place.at("acts", table.get("acts", "joint")), own)
    known = _Names(variables, joints if acts is Acts.JOINT else ())
    forms = tuple(
        _form({**table, **form}, known, taken, place) for form in table.get("forms", [{}])
    )
    if own:
        _check_form(forms[0], acts, place)
    columns, used = forms[0].columns, forms[0].names
    told = [_PLAIN[v] for v in _PLAIN if v in used]
    late = ""
    if (memory := forms[0].memory) is not None and memory.follows is not None:
        late = f", z' = ({memory.follows.text} - z)/tau"
        told[told.index(_PLAIN["z"])] = f"{memory.follows.text} of a while ago"
    told += [f"{_PLAIN[other[0]]} of joint {other[1:]}" for other in sorted(forms[0].others)]
    quantities = " and ".join(dict.fromkeys(told)) or "time"
    axis = next((axis for variable, axis in _AXES.items() if variable in used), "v")
    axis = "itself" if late else axis
    title = place.at("title", table.get("title", f"{name} of the robot file"))
    stated: dict[str, Any] = {
        "aliases": (),
        "equation": " + ".join(f"{c.prefix} * ({c.equation.text})" for c in columns) + late,
        "family": name,
        "signature": f"residual against {quantities}: the curve of its equation",
        "shows": "itself" if acts is Acts.POSITION else axis,
        "look_alikes": "whatever has nearly the same curve on the motion of the logs; log more of "
        f"the range of {quantities}",
        "range": "parameters not negative" if columns[0].nonnegative else "either sign",
        "source": "the robot file",
        "timing": "a" in used,
    }
    for key in table.keys() - set(_CATALOGUE_KEYS):
        stated[key] = tuple(table[key]) if isinstance(table[key], list) else table[key]
    return Effect(
        id=name,
        title=title.text('"drag"'),
        forms=forms,
        acts=acts,
        needs=tuple(Needs[need.upper()] for need in table.get("needs", [])),
        **stated,
    )


def _acts(place: Place, own: bool) -> tuple[Acts, Sequence[str]]:
    """On what it acts, and the variables that its equations may use."""
    if not own:
        return Acts[place.value.upper()], tuple(VARIABLES)
    if place.value == "joint":
        return Acts.JOINT, tuple(name for name in VARIABLES if name != "rate")
    if place.value == "position":
        return Acts.POSITION, ("q",)
    raise place.mismatch(
        '"joint" (adds to the torque of its joint) or "position" (moves the links from the '
        "measured position)"
    )


@dataclass(frozen=True)
class _Names:
    """What equations may read: variables, q, v and a of joints, shapes."""

    variables: Sequence[str]
    joints: Collection[str] | None
    shapes: Sequence[str] = ()
    law: Law | None = None

    def is_motion(self, name: str) -> bool:
        """True of `v3`, if there is a joint 3, or nobody knows."""
        head, joint = name[0], name[1:]
        known = joint != "" if self.joints is None else joint in self.joints
        return head in MOTION and known

    def equation(self, place: Place) -> Expression:
        """The equation at a place, which reads nothing else."""
        equation = place.expression(self.law)
        every = (*self.variables, *self.shapes)
        for name in sorted(equation.names):
            if name not in every and not self.is_motion(name):
                joints = f", q, v, a with the name of a joint ({listed(self.joints or ())})"
                raise place.error(
                    f"got {shown(equation.text)}: {name} is unknown{near(name, every)}; expected "
                    f"names among {listed(every)}{joints * bool(self.joints)}; list others under "
                    "shapes"
                )
        return equation


def _form(table: Mapping[str, Any], known: _Names, taken: Mapping[str, str], place: Place) -> Form:
    shapes = _shapes(table, known, place.at("shapes", table.get("shapes", {})))
    law = _law(place.at("law", table["law"])) if "law" in table else None
    known = dataclasses.replace(known, shapes=[shape.name for shape in shapes], law=law)
    columns = _columns(table, known, taken, place)
    memory, remembers = None, any("z" in column.equation.names for column in columns)
    if "resonance" in table:
        memory = Memory("resonance", *table["resonance"])
    elif "lag" in table:
        plain = [name for name in known.variables if name != "z"]
        follows = dataclasses.replace(known, variables=plain).equation(
            place.at("lag", table["lag"])
        )
        memory = Memory("lag", "tau", follows=follows)
        if not remembers:
            raise place.at("lag").error("no equation uses z, which lags; use it, or take lag out")
    elif remembers:
        memory = Memory("slip", "d")
    for kind, name, turns in (("slip", "d", _SLIPS), ("lag", "tau", _LAGS)):
        known_shape = any(shape.name == name and shape.grid[0] > 0.0 for shape in shapes)
        if memory is not None and memory.kind == kind and not known_shape:
            raise place.at("shapes").error(f"z {turns}]}}")
    return Form(columns, shapes, memory)


def _shapes(table: Mapping[str, Any], known: _Names, place: Place) -> tuple[Shape, ...]:
    shapes = []
    scales, limits, meanings = (table.get(key, {}) for key in ("scale", "limits", "meaning"))
    for name, cell in place.table("shapes = {c = [-1, 0, 1]}").items():
        scale = scales.get(name, "own")
        named = _SHAPE.fullmatch(name) and name not in VARIABLES and name not in _RESERVED
        if not named and scale == "own":
            raise place.error(
                f"got the name {shown(name)}; expected letters, digits and _, and neither a "
                f"variable ({listed(VARIABLES)}) nor {listed(_RESERVED)}"
            )
        if scale == "own" and known.joints and known.is_motion(name):
            raise place.error(
                f"got the name {shown(name)}, which is the {_PLAIN[name[0]]} of joint "
                f"{name[1:]}; choose another"
            )
        here = place.at(name, cell)
        entries = cell if isinstance(cell, list) else [cell]
        grid = sorted(here.holding(entry).number("0.1") for entry in entries)
        if not grid and scale == "own":
            raise here.error("got an empty list; expected values to try first, as in [0.1, 0.3]")
        if len(set(grid)) < len(grid):
            raise here.error(f"got {shown(cell)}; a value stands there twice, name it once")
        low, high = _limits(grid) if scale == "own" else map(float, limits.get(name, (0, 0)))
        meaning = meanings.get(name, f"first tried at {' '.join(f'{entry:g}' for entry in grid)}")
        shapes.append(Shape(name, scale, tuple(grid), (low, high), meaning))
    count = math.prod(len(shape.grid) for shape in shapes)
    if count > MOST:
        raise place.error(
            f"got {count} combinations of {listed(shape.name for shape in shapes)}; expected at "
            f"most {MOST}: give fewer values, they are refined"
        )
    return tuple(shapes)


def _limits(grid: Sequence[float]) -> tuple[float, float]:
    """How far refining may go: one step of the grid beyond its ends; positive stays positive."""
    if len(grid) == 1:
        return grid[0], grid[0]
    if grid[0] > 0.0:
        return grid[0] * grid[0] / grid[1], grid[-1] * grid[-1] / grid[-2]
    return 2.0 * grid[0] - grid[1], 2.0 * grid[-1] - grid[-2]


def _columns(
    table: Mapping[str, Any], known: _Names, taken: Mapping[str, str], place: Place
) -> tuple[EffectColumn, ...]:
    here = place.at("columns", table.get("columns"))
    if not here.value:
        raise here.error(f"is missing; expected parameters and their equations, as in {EXAMPLE}")
    cells = here.table(EXAMPLE)
    units = _units(table.get("unit", "SI"), list(cells), place.at("unit"))
    prismatic = _units(table.get("prismatic_unit", units), list(cells), place.at("unit"))
    nonnegative = table.get("nonnegative", False)
    if not isinstance(nonnegative, bool):
        raise place.at("nonnegative", nonnegative).mismatch("true or false")
    energy = table.get("energy", "own")
    columns = []
    for prefix, cell in cells.items():
        if not _PREFIX.fullmatch(prefix):
            raise here.error(
                f"got the parameter {shown(prefix)}; expected letters and digits, a letter first "
                "and last, such as Keb (the name of the joint follows)"
            )
        if prefix in taken:
            raise here.error(
                f"the parameter {shown(prefix)} is that of {taken[prefix]} already; choose "
                "another name"
            )
        equation = known.equation(here.at(prefix, cell))
        block = EnergyBlock[(energy[prefix] if isinstance(energy, dict) else energy).upper()]
        kind, largest = table.get("kind", "other"), table.get("largest", math.inf)
        unit, other = units[prefix], prismatic[prefix]
        columns.append(
            EffectColumn(prefix, equation, unit, other, kind, block, nonnegative, largest)
        )
    return tuple(columns)


def _law(place: Place) -> Law:
    """The table that `law` of the equations is."""
    table = place.checked_table(("low", "high", "cells", "values"), _LAW, missing=f"as in {_LAW}")
    low, high, cells, values = (
        tuple(place.at(key).holding(entry).number("0.1") for entry in _listed(place, key, cell))
        for key, cell in ((key, table[key]) for key in ("low", "high", "cells", "values"))
    )
    if not 1 <= len(low) <= 2 or not len(low) == len(high) == len(cells):
        raise place.error(
            f"got {len(low)}, {len(high)} and {len(cells)} entries of low, high and cells; "
            "expected one of each for every argument of the law, which has one or two"
        )
    for a, b, count in zip(low, high, cells, strict=True):
        if not a < b or count < 1 or count != int(count) or math.isinf(count / (b - a)):
            raise place.error(
                f"got an axis from {a:g} to {b:g} of {count:g} cells; expected low < high, and a "
                "whole number above 0"
            )
    counts = tuple(map(int, cells))
    expected = math.prod(count + BESIDE for count in counts)
    if len(values) != expected or expected > MOST_VALUES:
        raise place.at("values").error(
            f"got {len(values)} numbers; expected {expected}, {BESIDE} more than cells along each "
            f"axis, and at most {MOST_VALUES}"
        )
    return Law(low, high, counts, values)


def _listed(place: Place, key: str, cell: Any) -> Sequence[Any]:
    if not isinstance(cell, list):
        raise place.at(key, cell).mismatch(f"a list of numbers, as in {_LAW}")
    return cell


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


def _check_form(form: Form, acts: Acts, place: Place) -> None:
    """Every shape is used, and every equation has a value wherever a joint may be."""
    memory = {form.memory.shape} if form.memory else set()
    follows = form.memory and form.memory.follows
    equations = [column.equation for column in form.columns] + ([follows] if follows else [])
    used = frozenset().union(memory, *(equation.names for equation in equations))
    used |= {TURN} if "since" in used else set()
    for shape in form.shapes:
        if shape.name not in used:
            raise place.at("shapes").error(f"no equation uses {shape.name}; use it or take it out")
    if "law" in place.table(EXAMPLE) and not any(re.search(r"\blaw\b", c.equation.text)
                                                 for c in form.columns):  # fmt: skip
        raise place.at("law").error("no equation calls law; use it, as in law(q), or take it out")
    for column in form.columns:
        if acts is Acts.POSITION and re.search(r"\b(abs|sign)\b", column.equation.text):
            raise place.at(f"columns, {column.prefix}").error(
                f"got {shown(column.equation.text)}; what moves the position is differentiated "
                "twice: expected an equation without abs and sign"
            )
    check_finite(form, place.at("columns"))


def check_finite(form: Form, place: Place, given: Mapping[str, float] | None = None) -> None:
    """Refuse equations that have no real value up to `LARGEST` at rest or in a random state.

    Args:
        form: of an effect.
        place: of its equations.
        given: values of its shapes; None for all combinations of their first values.

    Raises:
        RobotError: says the equation and where it has no value.
    """
    names = [shape.name for shape in form.shapes]
    grid = itertools.product(*(shape.grid for shape in form.shapes))
    every = (dict(zip(names, values, strict=True)) for values in grid)
    states = list(_states(form))
    named = [(column.prefix, column.equation) for column in form.columns]
    follows = form.memory and form.memory.follows
    named = [*([("lag", follows)] if follows else []), *named]
    for shapes in every if given is None else [given]:
        for state in states:
            values = {**state, **shapes}
            for name, equation in named:
                result = _number(equation, values)
                if result is None:
                    used = equation.names
                    told = {**{n: v for n, v in values.items() if n in used}, **shapes}
                    raise place.error(
                        f"{name} = {shown(equation.text)} has no finite value at "
                        f"{listed(f'{name} = {value:.3g}' for name, value in told.items())}; "
                        f"expected one of at most {LARGEST:g} in every state of the joint, at rest "
                        "too"
                    )
                values |= {"z": result} if name == "lag" else {}  # z lies among such values


def _states(form: Form) -> Iterator[Mapping[str, float]]:
    """Rest, and states with both signs of everything."""
    import random  # as long to load as the whole catalogue is to read, and seldom needed

    names = (*VARIABLES, *sorted(form.others))
    yield dict.fromkeys(names, 0.0)
    draw = random.Random(0)
    for _ in range(_STATES):
        values = {name: draw.uniform(-3.0, 3.0) for name in names}
        yield values | {"since": abs(values["since"])}


def _number(equation: Expression, values: Mapping[str, float]) -> float | None:
    """Its value; None where it has none, or one that is too large."""
    try:
        result = equation.number(values)
    except (ArithmeticError, ValueError, TypeError):  # a root of a negative number is complex
        return None
    return result if abs(result) <= LARGEST else None
