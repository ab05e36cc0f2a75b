"""The catalogue of physical effects, as `catalogue.toml` defines them."""

import dataclasses
import itertools
import math
import re
import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from modeler.core.expression import BESIDE, FUNCTIONS, LAW, MOST as MOST_VALUES, Expression, Law
from modeler.core.toml_cells import LARGEST, TomlCell, join_names, quote_value, suggest_name
from modeler.effects.effect import (
    MOTION,
    TURN,
    VARIABLES,
    Effect,
    EffectColumn,
    EffectTarget,
    EnergyBlock,
    Form,
    InternalState,
    NonlinearParameter,
    Requirement,
    SignatureAxis,
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
_FURTHER = (
    "scale limits meaning prismatic_unit kind energy largest resonance windup bouc_wen forms needs"
)
_CATALOGUE_KEYS = (*_KEYS, *_FURTHER.split())
"""What the catalogue says of an effect, besides fields of `Effect` as they are."""

_PREFIX = re.compile(r"[A-Za-z]([A-Za-z0-9]*[A-Za-z])?")
_SHAPE = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_UNIT = re.compile(r"[A-Za-z0-9 .^()-]+([*/][A-Za-z0-9 .^()-]+)*")  # it becomes a comment in C
_RESERVED = ("joint", "t0", "T0", "pi", "lambda", *FUNCTIONS, LAW)  # [effects], and the language
_STATES = 12  # of a joint, in which equations are tried, besides rest

_PLAIN = {"q": "position", "v": "speed", "a": "acceleration", "load": "load", "static": "load"}
_PLAIN |= {"torque": "torque", "t": "time", "T": "temperature"}
_PLAIN |= {"since": "time since the last reversal", "z": "travel since the last reversal"}
_AXES: dict[str, SignatureAxis] = {"T": "T", "t": "t", "load": "load", "static": "load"}
_AXES |= {"torque": "torque", "since": "since", "z": "travel", "q": "q", "a": "a"}
"""Variable -> axis; the first that an equation uses shows it: friction that also depends on
something else shows itself there, turned with the motion."""


def read_definition(
    name: str,
    place: TomlCell,
    taken: Mapping[str, str],
    is_user_defined: bool = True,
    joints: Collection[str] | None = (),
) -> Effect:
    """Returns the effect of one table.

    Args:
        name: its id.
        place: the table: title, columns, shapes, unit, nonnegative, acts, lag, law; in the
            catalogue also what else an `Effect` says of itself.
        taken: names of parameters that it must not have -> whose they are.
        is_user_defined: of a robot file: it has the first keys only, and its equations are tried.
        joints: whose motion its equations may read, as `v3`; None: they were checked before.

    Raises:
        RobotError: equations that cannot be read or that have no finite value, unknown variables,
            shapes that no equation uses, other mistakes.
    """
    read = partial(place.read_checked_table, _KEYS) if is_user_defined else place.read_table
    table = read(EXAMPLE)
    acts, variables = _read_target(place.enter("acts", table.get("acts", "joint")), is_user_defined)
    known = _Names(variables, joints if acts is EffectTarget.JOINT else ())
    every = [{**table, **form} for form in table.get("forms", [{}])]
    forms = tuple(_read_form(form, known, taken, place) for form in every)
    if is_user_defined:
        _check_form(forms[0], acts, place)
    columns, used = forms[0].columns, forms[0].names
    read_names = [_PLAIN[v] for v in _PLAIN if v in used]
    late = ""
    if (memory := forms[0].internal_state) is not None and memory.lagged_input is not None:
        late = f", z' = ({memory.lagged_input.text} - z)/tau"
        read_names[read_names.index(_PLAIN["z"])] = f"{memory.lagged_input.text} of a while ago"
    others = sorted(forms[0].other_joint_names)
    read_names += [f"{_PLAIN[other[0]]} of joint {other[1:]}" for other in others]
    quantities = " and ".join(dict.fromkeys(read_names)) or "time"
    axis = next((axis for variable, axis in _AXES.items() if variable in used), "v")
    axis = "itself" if late else axis
    title = place.enter("title", table.get("title", f"{name} of the robot file"))
    stated: dict[str, Any] = {
        "aliases": (),
        "equation": " + ".join(f"{c.prefix} * ({c.equation.text})" for c in columns) + late,
        "family": name,
        "signature": f"residual against {quantities}: the curve of its equation",
        "signature_axis": "itself" if acts is EffectTarget.POSITION else axis,
        "confounders": "whatever has nearly the same curve on the motion of the logs; log more of "
        f"the range of {quantities}",
        "range": "parameters not negative" if columns[0].nonnegative else "either sign",
        "source": "the robot file",
        "is_timing_sensitive": "a" in used,
    }
    for key in table.keys() - set(_CATALOGUE_KEYS):
        stated[key] = tuple(table[key]) if isinstance(table[key], list) else table[key]
    stated["needs"] = tuple(Requirement[need.upper()] for need in table.get("needs", []))
    return Effect(id=name, title=title.read_text('"drag"'), forms=forms, acts=acts, **stated)


def _read_target(place: TomlCell, is_user_defined: bool) -> tuple[EffectTarget, Sequence[str]]:
    """On what it acts, and the variables that its equations may use."""
    if not is_user_defined:
        return EffectTarget[place.value.upper()], tuple(VARIABLES)
    if place.value == "joint":
        return EffectTarget.JOINT, tuple(name for name in VARIABLES if name != "rate")
    if place.value == "position":
        return EffectTarget.POSITION, ("q",)
    raise place.make_mismatch(
        '"joint" (adds to the torque of its joint) or "position" (moves the links from the '
        "measured position)"
    )


@dataclass(frozen=True)
class _Names:
    """What equations may read: variables, q, v and a of joints, shapes."""

    variables: Sequence[str]
    joints: Collection[str] | None
    nonlinear_parameters: Sequence[str] = ()
    law: Law | None = None

    def is_motion(self, name: str) -> bool:
        """Returns True of `v3`, if there is a joint 3, or nobody knows."""
        head, joint = name[0], name[1:]
        known = joint != "" if self.joints is None else joint in self.joints
        return head in MOTION and known

    def read_equation(self, place: TomlCell) -> Expression:
        """Returns the equation at a place, which reads nothing else."""
        equation = place.read_expression(self.law)
        known_names = (*self.variables, *self.nonlinear_parameters)
        for name in sorted(equation.names):
            if name not in known_names and not self.is_motion(name):
                joints = f", q, v, a with the name of a joint ({join_names(self.joints or ())})"
                raise place.make_error(
                    f"got {quote_value(equation.text)}: {name} is "
                    f"unknown{suggest_name(name, known_names)}; expected "
                    f"names among {join_names(known_names)}{joints * bool(self.joints)}; list "
                    "others under "
                    "shapes"
                )
        return equation


def _read_form(
    table: Mapping[str, Any], known: _Names, taken: Mapping[str, str], place: TomlCell
) -> Form:
    shapes = _read_nonlinear_parameters(
        table, known, place.enter("shapes", table.get("shapes", {}))
    )
    law = _read_law(place.enter("law", table["law"])) if "law" in table else None
    known = dataclasses.replace(
        known, nonlinear_parameters=[shape.name for shape in shapes], law=law
    )
    if "windup" in table:
        return Form((), shapes, InternalState("windup", *table["windup"]))
    columns = _read_columns(table, known, taken, place)
    memory, remembers = None, any("z" in column.equation.names for column in columns)
    if "resonance" in table:
        memory = InternalState("resonance", *table["resonance"])
    elif "bouc_wen" in table:
        distance, share = table["bouc_wen"]
        memory = InternalState("bouc_wen", distance, share=share)
    elif "lag" in table:
        plain = [name for name in known.variables if name != "z"]
        follows = dataclasses.replace(known, variables=plain).read_equation(
            place.enter("lag", table["lag"])
        )
        memory = InternalState("lag", "tau", lagged_input=follows)
        if not remembers:
            raise place.enter("lag").make_error(
                "no equation uses z, which lags; use it, or take lag out"
            )
    elif remembers:
        memory = InternalState("slip", "d")
    for kind, name, turns in (("slip", "d", _SLIPS), ("lag", "tau", _LAGS)):
        known_shape = any(shape.name == name and shape.grid[0] > 0.0 for shape in shapes)
        if memory is not None and memory.kind == kind and not known_shape:
            raise place.enter("shapes").make_error(f"z {turns}]}}")
    return Form(columns, shapes, memory)


def _read_nonlinear_parameters(
    table: Mapping[str, Any], known: _Names, place: TomlCell
) -> tuple[NonlinearParameter, ...]:
    shapes = []
    scales, limits, meanings = (table.get(key, {}) for key in ("scale", "limits", "meaning"))
    for name, cell in place.read_table("shapes = {c = [-1, 0, 1]}").items():
        scale = scales.get(name, "own")
        named = _SHAPE.fullmatch(name) and name not in VARIABLES and name not in _RESERVED
        if not named and scale == "own":
            raise place.make_error(
                f"got the name {quote_value(name)}; expected letters, digits and _, and neither a "
                f"variable ({join_names(VARIABLES)}) nor {join_names(_RESERVED)}"
            )
        if scale == "own" and known.joints and known.is_motion(name):
            raise place.make_error(
                f"got the name {quote_value(name)}, which is the {_PLAIN[name[0]]} of joint "
                f"{name[1:]}; choose another"
            )
        here = place.enter(name, cell)
        entries = cell if isinstance(cell, list) else [cell]
        grid = sorted(here.with_value(entry).read_number("0.1") for entry in entries)
        if not grid and scale == "own":
            raise here.make_error(
                "got an empty list; expected values to try first, as in [0.1, 0.3]"
            )
        if len(set(grid)) < len(grid):
            raise here.make_error(
                f"got {quote_value(cell)}; a value stands there twice, name it once"
            )
        low, high = (
            _compute_limits(grid) if scale == "own" else map(float, limits.get(name, (0, 0)))
        )
        meaning = meanings.get(name, f"first tried at {' '.join(f'{entry:g}' for entry in grid)}")
        shapes.append(NonlinearParameter(name, scale, tuple(grid), (low, high), meaning))
    count = math.prod(len(shape.grid) for shape in shapes)
    if count > MOST:
        raise place.make_error(
            f"got {count} combinations of {join_names(shape.name for shape in shapes)}; expected "
            "at "
            f"most {MOST}: give fewer values, they are refined"
        )
    return tuple(shapes)


def _compute_limits(grid: Sequence[float]) -> tuple[float, float]:
    """How far refining may go: one step of the grid beyond its ends; positive stays positive."""
    if len(grid) == 1:
        return grid[0], grid[0]
    if grid[0] > 0.0:
        return grid[0] * grid[0] / grid[1], grid[-1] * grid[-1] / grid[-2]
    return 2.0 * grid[0] - grid[1], 2.0 * grid[-1] - grid[-2]


def _read_columns(
    table: Mapping[str, Any], known: _Names, taken: Mapping[str, str], place: TomlCell
) -> tuple[EffectColumn, ...]:
    here = place.enter("columns", table.get("columns"))
    if not here.value:
        raise here.make_error(
            f"is missing; expected parameters and their equations, as in {EXAMPLE}"
        )
    cells = here.read_table(EXAMPLE)
    units = _read_units(table.get("unit", "SI"), list(cells), place.enter("unit"))
    prismatic = _read_units(table.get("prismatic_unit", units), list(cells), place.enter("unit"))
    nonnegative = table.get("nonnegative", False)
    if not isinstance(nonnegative, bool):
        raise place.enter("nonnegative", nonnegative).make_mismatch("true or false")
    energy = table.get("energy", "own")
    columns = []
    for prefix, cell in cells.items():
        if not _PREFIX.fullmatch(prefix):
            raise here.make_error(
                f"got the parameter {quote_value(prefix)}; expected letters and digits, a letter "
                "first "
                "and last, such as Keb (the name of the joint follows)"
            )
        if prefix in taken:
            raise here.make_error(
                f"the parameter {quote_value(prefix)} is that of {taken[prefix]} already; choose "
                "another name"
            )
        equation = known.read_equation(here.enter(prefix, cell))
        block = EnergyBlock[(energy[prefix] if isinstance(energy, dict) else energy).upper()]
        kind, largest = table.get("kind", "other"), table.get("largest", math.inf)
        unit, other = units[prefix], prismatic[prefix]
        columns.append(
            EffectColumn(prefix, equation, unit, other, kind, block, nonnegative, largest)
        )
    return tuple(columns)


def _read_law(place: TomlCell) -> Law:
    """The table that `law` of the equations is."""
    keys = ("low", "high", "cells", "values")
    table = place.read_checked_table(keys, _LAW, missing=f"as in {_LAW}")

    def read_numbers(key: str) -> tuple[float, ...]:
        entries, here = _read_list(place, key, table[key]), place.enter(key)
        return tuple(here.with_value(entry).read_number("0.1") for entry in entries)

    low, high, cells, values = map(read_numbers, keys)
    if not 1 <= len(low) <= 2 or not len(low) == len(high) == len(cells):
        raise place.make_error(
            f"got {len(low)}, {len(high)} and {len(cells)} entries of low, high and cells; "
            "expected one of each for every argument of the law, which has one or two"
        )
    for a, b, count in zip(low, high, cells, strict=True):
        if not a < b or count < 1 or count != int(count) or math.isinf(count / (b - a)):
            raise place.make_error(
                f"got an axis from {a:g} to {b:g} of {count:g} cells; expected low < high, and a "
                "whole number above 0"
            )
    counts = tuple(map(int, cells))
    expected = math.prod(count + BESIDE for count in counts)
    if len(values) != expected or expected > MOST_VALUES:
        raise place.enter("values").make_error(
            f"got {len(values)} numbers; expected {expected}, {BESIDE} more than cells along each "
            f"axis, and at most {MOST_VALUES}"
        )
    return Law(low, high, counts, values)


def _read_list(place: TomlCell, key: str, cell: Any) -> Sequence[Any]:
    if not isinstance(cell, list):
        raise place.enter(key, cell).make_mismatch(f"a list of numbers, as in {_LAW}")
    return cell


def _read_units(value: Any, prefixes: Sequence[str], place: TomlCell) -> dict[str, str]:
    cells = value if isinstance(value, dict) else dict.fromkeys(prefixes, value)
    for prefix, unit in cells.items():
        if prefix not in prefixes:
            raise place.make_error(
                f"got {quote_value(prefix)}, which is no parameter of this effect; expected "
                f"{join_names(prefixes)}"
            )
        if not isinstance(unit, str) or not _UNIT.fullmatch(unit):
            raise place.make_error(f'got {quote_value(unit)}; expected text such as "N*m*s/rad"')
    return dict.fromkeys(prefixes, "SI") | cells


def _check_form(form: Form, acts: EffectTarget, place: TomlCell) -> None:
    """Every shape is used, and every equation has a value wherever a joint may be."""
    memory = {form.internal_state.parameter} if form.internal_state else set()
    follows = form.internal_state and form.internal_state.lagged_input
    equations = [column.equation for column in form.columns] + ([follows] if follows else [])
    used = frozenset().union(memory, *(equation.names for equation in equations))
    used |= {TURN} if "since" in used else set()
    for shape in form.nonlinear_parameters:
        if shape.name not in used:
            raise place.enter("shapes").make_error(
                f"no equation uses {shape.name}; use it or take it out"
            )
    if "law" in place.read_table(EXAMPLE) and not any(
        re.search(r"\blaw\b", c.equation.text) for c in form.columns
    ):
        raise place.enter("law").make_error(
            "no equation calls law; use it, as in law(q), or take it out"
        )
    for column in form.columns:
        if acts is EffectTarget.POSITION and re.search(r"\b(abs|sign)\b", column.equation.text):
            raise place.enter(f"columns, {column.prefix}").make_error(
                f"got {quote_value(column.equation.text)}; what moves the position is "
                "differentiated "
                "twice: expected an equation without abs and sign"
            )
    check_finite(form, place.enter("columns"))


def check_finite(
    form: Form, place: TomlCell, parameter_values: Mapping[str, float] | None = None
) -> None:
    """Refuses equations that have no real value up to `LARGEST` at rest or in a random state.

    Args:
        form: of an effect.
        place: of its equations.
        parameter_values: values of its shapes; None for all combinations of their first values.

    Raises:
        RobotError: says the equation and where it has no value.
    """
    names = [shape.name for shape in form.nonlinear_parameters]
    grid = itertools.product(*(shape.grid for shape in form.nonlinear_parameters))
    parameter_grid = (dict(zip(names, values, strict=True)) for values in grid)
    states = list(_generate_states(form))
    named = [(column.prefix, column.equation) for column in form.columns]
    follows = form.internal_state and form.internal_state.lagged_input
    named = [*([("lag", follows)] if follows else []), *named]
    for shapes in parameter_grid if parameter_values is None else [parameter_values]:
        for state in states:
            values = {**state, **shapes}
            for name, equation in named:
                result = _evaluate_equation(equation, values)
                if result is None:
                    used = equation.names
                    shown_values = {**{n: v for n, v in values.items() if n in used}, **shapes}
                    point = join_names(f"{n} = {v:.3g}" for n, v in shown_values.items())
                    raise place.make_error(
                        f"{name} = {quote_value(equation.text)} has no finite value at {point}; "
                        f"expected one of at most {LARGEST:g} in every state of the joint, at rest "
                        "too"
                    )
                values |= {"z": result} if name == "lag" else {}  # z lies among such values


def _generate_states(form: Form) -> Iterator[Mapping[str, float]]:
    """Rest, and states with both signs of everything."""
    import random  # as long to load as the whole catalogue is to read, and seldom needed

    names = (*VARIABLES, *sorted(form.other_joint_names))
    yield dict.fromkeys(names, 0.0)
    draw = random.Random(0)
    for _ in range(_STATES):
        values = {name: draw.uniform(-3.0, 3.0) for name in names}
        yield values | {"since": abs(values["since"])}


def _evaluate_equation(equation: Expression, values: Mapping[str, float]) -> float | None:
    """Its value; None where it has none, or one that is too large."""
    try:
        result = equation.evaluate(values)
    except (ArithmeticError, ValueError, TypeError):  # a root of a negative number is complex
        return None
    return result if abs(result) <= LARGEST else None


# The catalogue of physical effects, as `catalogue.toml` defines them.


def _read_catalogue() -> tuple[Effect, ...]:
    file = Path(__file__).with_name("catalogue.toml")
    effects: list[Effect] = []
    for name, table in tomllib.loads(file.read_text(encoding="utf-8")).items():
        cell = TomlCell(file.name, f"[{name}]", table)
        effects.append(read_definition(name, cell, {}, is_user_defined=False))
    return tuple(effects)


CATALOGUE: tuple[Effect, ...] = _read_catalogue()
"""The effects, in the order in which their parameters stand after the link's own."""

ENCODERS = tuple(effect.id for effect in CATALOGUE if effect.acts_on_whole_axis)
"""What moves the position of the whole axis, motor and links: the encoder shows it wrongly."""

PASSIVE_FRICTION = "passive_friction"
PASSIVE_FRICTION_IS = ("viscous", "coulomb")
"""What friction of a joint without motor is made of: a robot file that names it has these two."""


def find_effect(name: str, among: Sequence[Effect] = CATALOGUE) -> Effect | None:
    """Returns the effect with that id or alias; None if there is none.

    Args:
        name: as in robot files.
        among: the catalogue, or that of a robot with effects of its own (`Robot.catalogue`).
    """
    return next((e for e in among if name == e.id or name in e.aliases), None)
