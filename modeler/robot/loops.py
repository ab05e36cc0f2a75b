"""`[loops]`, `[home]`, `[relations]`, legs and platforms of a robot file."""

import math
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from modeler.core.expression import Expression
from modeler.core.toml_cells import Place, listed, near, shown
from modeler.robot.angles import exact_terms
from modeler.robot.cells import check_count, joint_sum, name_of, number_at
from modeler.robot.conventions import Row, RowPlace
from modeler.robot.robot import LOOP_KINDS, Joint, JointKind, Loop
from modeler.robot.table import HOME, ROW_NAME, Rows, row_kind

MOST_LOOPS = 50
"""As many as legs."""
OTHER_JOINTS = Path(__file__).with_name("other_joints.toml")
_COLUMNS = ("loop", "frame", "meets", "joint")
_EXAMPLE = 'columns = ["loop", "frame", "meets", "joint"], rows = [["A", "9", "10", "rigid"]]'


_ROUNDING = 1e-3
"""rad by which a full turn may be rounded up."""


def read_loops(place: Place, joints: Sequence[Joint]) -> tuple[Loop, ...]:
    """The loops of a file.

    Raises:
        RobotError: columns, rows, frames or joints are wrong, or there is nothing to close.
    """
    if place.value is None:
        return ()
    advice = f"write {_EXAMPLE}"
    table = place.checked_table(("columns", "rows"), f"[loops] {_EXAMPLE}", advice)
    here = place.at("columns", table.get("columns", list(_COLUMNS)))
    columns = here.entries(_EXAMPLE)
    if sorted(map(str, columns)) != sorted(_COLUMNS):
        raise here.mismatch(listed(_COLUMNS))
    if "rows" not in table:
        raise place.error(f"rows is missing; {advice}")
    rows = place.at("rows", table["rows"]).entries(_EXAMPLE)
    told = "loops, those of all legs counted"
    check_count(len(rows), MOST_LOOPS, told, place.at("rows"))
    loops = []
    for number, cells in enumerate(rows, start=1):
        here = place.at(f"row {number}", cells)
        cells = here.entries('["A", "9", "10", "rigid"]', length=len(_COLUMNS))
        loops.append(_loop(dict(zip(columns, cells, strict=True)), joints, here))
    if not loops:
        raise place.at("rows").error(
            'the table is empty; write one row per loop, as in ["A", "9", "10", "rigid"], or leave '
            "[loops] out"
        )
    names = [loop.name for loop in loops]
    for number, name in enumerate(names, start=1):
        if name in names[: number - 1]:
            raise place.at(f"row {number}").error(
                f"{shown(name)} is the name of row {names.index(name) + 1} too; give every loop "
                "its own name"
            )
    return tuple(loops)


def _loop(cells: Mapping[str, Any], joints: Sequence[Joint], place: Place) -> Loop:
    name = place.at("column loop", name_of(cells["loop"])).text('"A"')
    here = place.at(shown(name))
    names = [joint.name for joint in joints]
    frames = []
    for column, known in (("frame", names), ("meets", ["0", *names])):
        frame = name_of(cells[column])
        if frame not in known:
            raise here.at(f"column {column}").error(
                f"got {shown(frame)}, which is no row of the table{near(frame, known)}; expected "
                f"one of {listed(joint.name for joint in joints)}"
            )
        frames.append(frame)
    kind = cells["joint"]
    if kind not in LOOP_KINDS:
        instead = _other_joint(kind) if isinstance(kind, str) else None
        other = f"{near(kind, LOOP_KINDS)}; expected one of {listed(LOOP_KINDS)}"
        raise here.at("column joint").error(
            f"got {shown(kind)}{f'; {instead}' if instead else other}"
        )
    rows, bodies = {joint.name: joint for joint in joints}, []
    for frame in frames:  # the moving row that carries it, "0" for the base
        while frame != "0" and not rows[frame].moves:
            frame = rows[frame].antecedent
        bodies.append(frame)
    if bodies[0] == bodies[1]:
        raise here.error(
            f"frames {frames[0]} and {frames[1]} are both fixed on "
            f"{'the base' if bodies[0] == '0' else f'link {bodies[0]}'}: there is nothing to "
            "close; name a frame of another link"
        )
    return Loop(name, frames[0], frames[1], kind)


def _other_joint(kind: str) -> str | None:
    """What to write instead of a joint of that name; None if the name says nothing."""
    name = kind.strip().lower().replace("_", " ").replace("-", " ").removesuffix(" joint")
    advice = tomllib.loads(OTHER_JOINTS.read_text(encoding="utf-8"))
    return next((instead for instead, names in advice.items() if name in names), None)


def read_home(
    place: Place, moving: Mapping[str, Joint], symbols: Mapping[str, float]
) -> dict[str, float]:
    """The posture from which loops are closed, by row: `[home] q2 = "-pi/2"`.

    Raises:
        RobotError: no such joint variable, or no number.
    """
    variables = {joint.variable: name for name, joint in moving.items()}
    home = {}
    for key, here in place.items('[home] q2 = "-pi/2"'):
        if key not in variables:
            raise here.error(
                f"is no joint variable{near(key, variables)}; expected some of "
                f"{listed(list(variables)[:12])}"
            )
        angle = number_at(here, symbols, moving[variables[key]].unit)
        if moving[variables[key]].angular and abs(angle) > 2 * math.pi + _ROUNDING:
            raise here.error(
                f"got {angle:g} rad, which is more than a turn; angles are in radians: write "
                f'"{angle:g} deg" for degrees'
            )
        home[variables[key]] = angle
    return home


# Joints that follow others: `[relations]`, and cells that hold other rows' variables.


_RELATION_EXAMPLE = '[relations] q4 = "-q3"'


def read_relations(
    place: Place,
    driven: Mapping[str, str],
    rows: Rows,
    symbols: Mapping[str, float],
    rounded: dict[str, str],
    readings: list[str],
) -> dict[str, Expression]:
    """The relations of a file, by row; rows that follow others become passive in `rows`.

    A row whose theta (revolute) or r (prismatic) holds other rows' variables and not its own
    follows them: its variable is that cell.

    Args:
        place: the table.
        driven: relations of joints that follow motors, as it would have them.
        rows: of the table of joints and motors.
        symbols: values of the declared symbols.
        rounded: grows by the decimal angles that are taken for multiples of pi.
        readings: grows by what is told of a cell that looks like a slip.

    Raises:
        RobotError: unknown joints, a relation that is not linear, a circle, an actuated joint
            that follows others, or one that follows another joint and motors.
    """
    stated = place.table("[relations]")
    for name in stated:
        if name in driven:
            raise place.at(name).error(
                f"follows motors of [motors] too; take {name} out of the sums there, or remove "
                "the relation"
            )
    kinds = {row["j"]: row_kind(row, spot) for row, spot in rows}
    variables = {f"q{name}": name for name, kind in kinds.items() if kind in HOME}
    by_name = {row["j"]: (row, spot) for row, spot in rows}
    found: dict[str, tuple[Expression, Place]] = {}
    for row, spot in rows:  # a cell that is a relation is taken out of its row
        column, own = HOME.get(kinds[row["j"]]), f"q{row['j']}"
        if column is None or not isinstance(row.get(column), str):
            continue
        here = spot.column(column, row[column])
        expression = here.expression()
        others = {n for n in expression.names if n.startswith("q") and n[1:] in kinds and n != own}
        if others and own not in expression.names:
            found[row["j"]] = (expression, here)
            row[column] = own
    for key, here in place.holding({**driven, **stated}).items(_RELATION_EXAMPLE):
        if key not in variables:
            raise here.error(
                f"is no joint variable{near(key, variables)}; expected one such as "
                f"{_RELATION_EXAMPLE}"
            )
        if variables[key] in found:
            raise here.error(f"{key} stands as a relation in the table too; keep one of them")
        found[variables[key]] = (here.expression(), here)
    for name, (expression, here) in found.items():
        got = f"got {shown(expression.text)}"
        if f"q{name}" in expression.names:
            raise here.error(f"{got}, which holds q{name} itself; expected other joints")
        form = joint_sum(expression, symbols, variables, here, "-q2 - pi/2")
        if not form.coefficients:
            raise here.error(f"{got}, a constant; a joint that does not move has sigma 2")
        row, spot = by_name[name]
        if row.get("mu", 0) == 1:
            raise spot.column("mu").error(
                f"got 1, and q{name} follows other joints ({here.spot}); write 0, or remove the "
                "relation"
            )
        [(other, factor), *more] = form.coefficients.items()
        if "mu" not in row and f"q{name}" not in {**driven, **stated} and factor == 1 and not more:
            readings.append(
                f'row "{name}" moves with {other}, as row "{other[1:]}" does; write q{name} if it '
                "is a joint of its own"
            )
        row["mu"] = 0
    relations = {
        name: expression.rewritten(lambda tree: exact_terms(tree, rounded))
        if kinds[name] is JointKind.REVOLUTE
        else expression
        for name, (expression, _) in found.items()
    }
    left = dict(relations)
    while left:
        names = {f"q{name}" for name in left}
        ready = [name for name, expression in left.items() if not expression.names & names]
        if not ready:
            raise place.error(
                f"{', '.join(f'q{name}' for name in left)} follow each other in a circle; leave "
                "one of them free"
            )
        for name in ready:
            del left[name]
    return relations


# Legs that are alike: what holds {i} is written once and stands for every leg.


MARK = "{i}"
MOST_LEGS = 50
"""Legs of three rows fill the longest table."""
_UNTOUCHED = ("legs", "shared", "notes", "title", "name", "log")


def expanded(document: dict[str, Any], place: Place) -> dict[str, Any]:
    """The document with every {i} replaced by the names of the legs.

    Consecutive rows of a table with {i} are repeated leg after leg; so is an entry of a list, and
    a line `key = value`.

    Raises:
        RobotError: {i} without `legs`, wrong names of legs, another mark in braces.
    """
    legs = leg_names(place.at("legs", document.get("legs")))
    return {
        key: value if key in _UNTOUCHED else _expanded(value, legs, place.at(key))
        for key, value in document.items()
    }


def leg_names(place: Place) -> tuple[str, ...]:
    """Names of the legs; empty if the file has no `legs`.

    Raises:
        RobotError: not a list of different letters and digits.
    """
    if place.value is None:
        return ()
    legs = [name_of(leg) for leg in place.entries('["1", "2", "3"]')]
    check_count(len(legs), MOST_LEGS, "legs", place)
    for leg in legs:
        if not isinstance(leg, str) or not ROW_NAME.fullmatch(leg):
            raise place.error(
                f'got {shown(leg)}; expected names of letters and digits, as in ["1", "2", "3"]'
            )
        if legs.count(leg) > 1:
            raise place.error(f"{shown(leg)} stands there twice; give each leg its own name")
    if not legs:
        raise place.error('got no legs; expected their names, as in ["1", "2", "3"]')
    return tuple(legs)


def _expanded(value: Any, legs: Sequence[str], place: Place) -> Any:
    if isinstance(value, dict):
        found: dict[str, Any] = {}
        for key, entry in value.items():
            if MARK in key:
                _need(legs, key, place)
                found |= {_filled(key, leg): _filled(entry, leg) for leg in legs}
            else:
                found[_checked(key, place)] = _expanded(entry, legs, place.at(key))
        return found
    if isinstance(value, list):
        return _expanded_list(value, legs, place)
    return _checked(value, place)


def _expanded_list(value: list[Any], legs: Sequence[str], place: Place) -> list[Any]:
    found: list[Any] = []
    block: list[Any] = []
    for entry in [*value, None]:
        marked = entry is not None and _marked(entry)
        if marked:
            _need(legs, entry, place)
            block.append(entry)
        # Rows of a table go leg by leg; single entries each for itself.
        if block and not (marked and isinstance(entry, list)):
            found += [_filled(one, leg) for leg in legs for one in block]
            block = []
        if not marked and entry is not None:
            found.append(_expanded(entry, legs, place))
    return found


def _marked(value: Any) -> bool:
    if isinstance(value, list):
        return any(_marked(entry) for entry in value)
    return isinstance(value, str) and MARK in value


def _filled(value: Any, leg: str) -> Any:
    if isinstance(value, list):
        return [_filled(entry, leg) for entry in value]
    return value.replace(MARK, leg) if isinstance(value, str) else value


def _need(legs: Sequence[str], value: Any, place: Place) -> None:
    if not legs:
        raise place.error(
            f"got {shown(value)}: {MARK} stands for the legs, and the file names none; write "
            'legs = ["1", "2", "3"] at its top'
        )


def _checked(value: Any, place: Place) -> Any:
    if isinstance(value, str) and (mark := re.search(r"\{[^}]*\}?", value)):
        raise place.error(
            f"got {shown(value)} with {shown(mark[0])}; the only mark is {MARK}, "
            "for the legs; correct it"
        )
    return value


# The moving platform of a parallel robot: rows of the table that move it freely.


_PLATFORM_EXAMPLE = '[platform] name = "P", motion = "translation"'
_MOTIONS = {
    "translation": ("x1", "y1", "1"),
    "planar": ("x1", "y1", "0"),
    "free": ("x1", "y1", "z1", "a0", "b0", "0"),
}
"""Per motion, the rows: suffix of the name and sigma."""


def read_platform(place: Place) -> tuple[list[tuple[Row, RowPlace]], tuple[str, ...]]:
    """Rows that carry the platform, and their names; none without a platform.

    They stand before the table's, so that frames may be fixed on the platform. Each turns the axes
    cyclically (gamma = alpha = pi/2: z is the x axis of the frame before), so that the travels are
    along x0, y0, z0 and the platform's axes at rest those of frame 0.

    translation: travels x, y, z; planar: travels x, y and a turn about z; free: travels x, y, z
    and turns with R = Rx(a) Ry(b) Rz(c). Only the last row carries the platform.

    Raises:
        RobotError: unknown keys or motion, no name.
    """
    if place.value is None:
        return [], ()
    advice = f"write {_PLATFORM_EXAMPLE}"
    table = place.checked_table(("name", "motion"), _PLATFORM_EXAMPLE, missing=advice)
    here = place.at("name", name_of(table["name"]))
    name = here.text('"P"')
    if not ROW_NAME.fullmatch(name):
        raise here.mismatch('letters and digits such as "P"')
    motion = table["motion"]
    if motion not in list(_MOTIONS):
        raise place.at("motion").error(
            f"got {shown(motion)}{near(motion, _MOTIONS)}; expected {listed(_MOTIONS)}"
        )
    names = [name if len(step) == 1 else f"{name}{step[0]}" for step in _MOTIONS[motion]]
    antecedents = ["0", *names]
    rows = []
    for step, own, antecedent in zip(_MOTIONS[motion], names, antecedents, strict=False):
        sigma = int(step[-1])
        row: Row = {
            "j": own, "a": antecedent, "mu": 0, "sigma": sigma, "gamma": "pi/2", "alpha": "pi/2",
            ("r" if sigma else "theta"): f"q{own}",
        }  # fmt: skip
        rows.append((row, RowPlace(place.file, place.spot, row=own)))
    return rows, tuple(names)
