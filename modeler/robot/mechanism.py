"""`[loops]`, `[home]`, `[relations]`, legs and platforms of a robot file."""

import fnmatch
import math
import re
import tomllib
from collections.abc import Mapping, Sequence
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import Any

from modeler.core.expression import Expression, format_decimal
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.robot.cells import (
    Values,
    check_count,
    check_name_length,
    normalise_row_name,
    read_joint_sum,
    read_number,
    recognise_angle_terms,
)
from modeler.robot.robot import INERTIAL, LOOP_KINDS, Joint, JointKind, Loop, Robot, SharedParameter
from modeler.robot.sections import Joints, find_joint
from modeler.robot.table import HOME, ROW_NAME, Row, RowPlace, Rows, read_row_kind
from modeler.robot.thresholds import THRESHOLDS

OTHER_JOINTS = Path(__file__).with_name("other_joints.toml")
_COLUMNS = ("loop", "frame", "meets", "joint")
_EXAMPLE = 'columns = ["loop", "frame", "meets", "joint"], rows = [["A", "9", "10", "rigid"]]'


def read_loops(place: TomlCell, joints: Sequence[Joint]) -> tuple[Loop, ...]:
    """Returns the loops of a file.

    Raises:
        RobotError: columns, rows, frames or joints are wrong, or there is nothing to close.
    """
    if place.value is None:
        return ()
    advice = f"write {_EXAMPLE}"
    table = place.read_checked_table(("columns", "rows"), f"[loops] {_EXAMPLE}", advice)
    here = place.enter("columns", table.get("columns", list(_COLUMNS)))
    columns = here.read_list(_EXAMPLE)
    if sorted(map(str, columns)) != sorted(_COLUMNS):
        raise here.make_mismatch(join_names(_COLUMNS))
    if "rows" not in table:
        raise place.make_error(f"rows is missing; {advice}")
    rows = place.enter("rows", table["rows"]).read_list(_EXAMPLE)
    description = "loops, those of all legs counted"
    check_count(len(rows), THRESHOLDS.max_loops, description, place.enter("rows"))
    loops = []
    for number, cells in enumerate(rows, start=1):
        here = place.enter(f"row {number}", cells)
        cells = here.read_list('["A", "9", "10", "rigid"]', length=len(_COLUMNS))
        loops.append(_read_loop(dict(zip(columns, cells, strict=True)), joints, here))
    if not loops:
        raise place.enter("rows").make_error(
            'the table is empty; write one row per loop, as in ["A", "9", "10", "rigid"], or leave '
            "[loops] out"
        )
    names = [loop.name for loop in loops]
    for number, name in enumerate(names, start=1):
        if name in names[: number - 1]:
            raise place.enter(f"row {number}").make_error(
                f"{quote_value(name)} is the name of row {names.index(name) + 1} too; give every "
                "loop its own name"
            )
    return tuple(loops)


def _read_loop(cells: Mapping[str, Any], joints: Sequence[Joint], place: TomlCell) -> Loop:
    name = place.enter("column loop", normalise_row_name(cells["loop"])).read_text('"A"')
    here = place.enter(quote_value(name))
    names = [joint.name for joint in joints]
    frames = []
    for column, known in (("frame", names), ("meets", ["0", *names])):
        frame = normalise_row_name(cells[column])
        if frame not in known:
            raise here.enter(f"column {column}").make_error(
                f"got {quote_value(frame)}, which is no row of the "
                f"table{suggest_name(frame, known)}; expected "
                f"one of {join_names(joint.name for joint in joints)}"
            )
        frames.append(frame)
    kind = cells["joint"]
    if kind not in LOOP_KINDS:
        suggestion = _suggest_joint(kind) if isinstance(kind, str) else None
        other = f"{suggest_name(kind, LOOP_KINDS)}; expected one of {join_names(LOOP_KINDS)}"
        wrong = f"; {suggestion}" if suggestion else other
        raise here.enter("column joint").make_error(f"got {quote_value(kind)}{wrong}")
    rows, bodies = {joint.name: joint for joint in joints}, []
    for frame in frames:  # the moving row that carries it, "0" for the base
        while frame != "0" and not rows[frame].is_moving:
            frame = rows[frame].antecedent
        bodies.append(frame)
    if bodies[0] == bodies[1]:
        raise here.make_error(
            f"frames {frames[0]} and {frames[1]} are both fixed on "
            f"{'the base' if bodies[0] == '0' else f'link {bodies[0]}'}: there is nothing to "
            "close; name a frame of another link"
        )
    return Loop(name, frames[0], frames[1], kind)


def _suggest_joint(kind: str) -> str | None:
    """What to write instead of a joint of that name; None if the name says nothing."""
    name = kind.strip().lower().replace("_", " ").replace("-", " ").removesuffix(" joint")
    advice = tomllib.loads(OTHER_JOINTS.read_text(encoding="utf-8"))
    return next((suggestion for suggestion, names in advice.items() if name in names), None)


def read_home(place: TomlCell, moving: Joints, symbols: Values) -> dict[str, float]:
    """Returns the posture from which loops are closed, by row: `[home] q2 = "-pi/2"`.

    Raises:
        RobotError: no such joint variable, or no number.
    """
    variables = {joint.variable: name for name, joint in moving.items()}
    home = {}
    for key, here in place.read_items('[home] q2 = "-pi/2"'):
        if key not in variables:
            raise here.make_error(
                f"is no joint variable{suggest_name(key, variables)}; expected some of "
                f"{join_names(list(variables)[:12])}"
            )
        angle = read_number(here, symbols, moving[variables[key]].unit)
        most = 2 * math.pi + THRESHOLDS.max_full_turn_excess
        if moving[variables[key]].is_revolute and abs(angle) > most:
            raise here.make_error(
                f"got {angle:g} rad, which is more than a turn; angles are in radians: write "
                f'"{angle:g} deg" for degrees'
            )
        home[variables[key]] = angle
    return home


# Joints that follow others: `[relations]`, and cells that hold other rows' variables.


_RELATION_EXAMPLE = '[relations] q4 = "-q3"'


def read_relations(
    place: TomlCell,
    driven: Mapping[str, str],
    rows: Rows,
    symbols: Values,
    rounded: dict[str, str],
    readings: list[str],
) -> dict[str, Expression]:
    """Returns the relations of a file, by row; rows that follow others become passive in `rows`.

    A row whose theta (revolute) or r (prismatic) holds other rows' variables and not its own
    follows them: its variable is that cell.

    Args:
        place: the table.
        driven: relations of joints that follow motors, as it would have them.
        rows: of the table of joints and motors.
        symbols: values of the declared symbols.
        rounded: grows by the decimal angles that are taken for multiples of pi.
        readings: grows by what is reported about a cell that looks like a slip.

    Raises:
        RobotError: unknown joints, a relation that is not linear, a circle, an actuated joint
            that follows others, or one that follows another joint and motors.
    """
    stated = place.read_table("[relations]")
    for name in stated:
        if name in driven:
            raise place.enter(name).make_error(
                f"follows motors of [motors] too; take {name} out of the sums there, or remove "
                "the relation"
            )
    kinds = {row["j"]: read_row_kind(row, spot) for row, spot in rows}
    variables = {f"q{name}": name for name, kind in kinds.items() if kind in HOME}
    by_name = {row["j"]: (row, spot) for row, spot in rows}
    stated_relations = _take_relations(rows, kinds)
    for key, here in place.with_value({**driven, **stated}).read_items(_RELATION_EXAMPLE):
        if key not in variables:
            raise here.make_error(
                f"is no joint variable{suggest_name(key, variables)}; expected one such as "
                f"{_RELATION_EXAMPLE}"
            )
        if variables[key] in stated_relations:
            raise here.make_error(f"{key} stands as a relation in the table too; keep one of them")
        stated_relations[variables[key]] = (here.read_expression(), here)
    for name, (expression, here) in stated_relations.items():
        got = f"got {quote_value(expression.text)}"
        if f"q{name}" in expression.names:
            raise here.make_error(f"{got}, which holds q{name} itself; expected other joints")
        form = read_joint_sum(expression, symbols, variables, here, "-q2 - pi/2")
        if not form.coefficients:
            raise here.make_error(f"{got}, a constant; a joint that does not move has sigma 2")
        row, spot = by_name[name]
        if row.get("mu", 0) == 1:
            raise spot.locate_column("mu").make_error(
                f"got 1, and q{name} follows other joints ({here.location}); write 0, or remove "
                "the relation"
            )
        [(other, factor), *more] = form.coefficients.items()
        if "mu" not in row and f"q{name}" not in {**driven, **stated} and factor == 1 and not more:
            readings.append(
                f'row "{name}" moves with {other}, as row "{other[1:]}" does; write q{name} if it '
                "is a joint of its own"
            )
        row["mu"] = 0
    relations = {name: expression for name, (expression, _) in stated_relations.items()}
    for name in [name for name in relations if kinds[name] is JointKind.REVOLUTE]:
        relations[name] = relations[name].rewrite(lambda tree: recognise_angle_terms(tree, rounded))
    order = TopologicalSorter({f"q{name}": cell.names for name, cell in relations.items()})
    try:
        order.prepare()
    except CycleError as error:
        circle = ", ".join(sorted(set(error.args[1])))
        what = f"{circle} follow each other in a circle; leave one of them free"
        raise place.make_error(what) from None
    return relations


def _take_relations(
    rows: Rows, kinds: Mapping[str, JointKind]
) -> dict[str, tuple[Expression, TomlCell]]:
    """Takes the cells that are relations out of their rows, by row."""
    relations = {}
    for row, spot in rows:
        column, variable = HOME.get(kinds[row["j"]]), f"q{row['j']}"
        if column is None or not isinstance(row.get(column), str):
            continue
        here = spot.locate_column(column, row[column])
        expression = here.read_expression()
        joints = {n for n in expression.names if n.startswith("q") and n[1:] in kinds}
        if joints and variable not in expression.names:
            relations[row["j"]] = (expression, here)
            row[column] = variable
    return relations


# Legs that are alike: what holds {i} is written once and stands for every leg.


MARK = "{i}"
_UNTOUCHED = ("legs", "shared", "notes", "title", "name", "log")


def expand_legs(document: dict[str, Any], place: TomlCell) -> dict[str, Any]:
    """Returns the document with every {i} replaced by the names of the legs.

    Consecutive rows of a table with {i} are repeated leg after leg; so is an entry of a list, and
    a line `key = value`.

    Raises:
        RobotError: {i} without `legs`, wrong names of legs, another mark in braces.
    """
    legs = read_leg_names(place.enter("legs", document.get("legs")))
    return {
        key: value if key in _UNTOUCHED else _expand_value(value, legs, place.enter(key))
        for key, value in document.items()
    }


def read_leg_names(place: TomlCell) -> tuple[str, ...]:
    """Returns names of the legs; empty if the file has no `legs`.

    Raises:
        RobotError: not a list of different letters and digits.
    """
    if place.value is None:
        return ()
    legs = [normalise_row_name(leg) for leg in place.read_list('["1", "2", "3"]')]
    check_count(len(legs), THRESHOLDS.max_legs, "legs", place)
    for leg in legs:
        if not isinstance(leg, str) or not ROW_NAME.fullmatch(leg):
            expected = 'expected names of letters and digits, as in ["1", "2", "3"]'
            raise place.make_error(f"got {quote_value(leg)}; {expected}")
        if legs.count(leg) > 1:
            what = f"{quote_value(leg)} stands there twice"
            raise place.make_error(f"{what}; give each leg its own name")
    if not legs:
        raise place.make_error('got no legs; expected their names, as in ["1", "2", "3"]')
    return tuple(legs)


def _expand_value(value: Any, legs: Sequence[str], place: TomlCell) -> Any:
    if isinstance(value, dict):
        expanded_table: dict[str, Any] = {}
        for key, entry in value.items():
            if MARK in key:
                _require_legs(legs, key, place)
                expanded_table |= {_fill_mark(key, leg): _fill_mark(entry, leg) for leg in legs}
            else:
                expanded = _expand_value(entry, legs, place.enter(key))
                expanded_table[_check_marks(key, place)] = expanded
        return expanded_table
    if isinstance(value, list):
        return _expand_list(value, legs, place)
    return _check_marks(value, place)


def _expand_list(value: list[Any], legs: Sequence[str], place: TomlCell) -> list[Any]:
    entries: list[Any] = []
    block: list[Any] = []
    for entry in [*value, None]:
        marked = entry is not None and _has_mark(entry)
        if marked:
            _require_legs(legs, entry, place)
            block.append(entry)
        # Rows of a table go leg by leg; single entries each for itself.
        if block and not (marked and isinstance(entry, list)):
            entries += [_fill_mark(one, leg) for leg in legs for one in block]
            block = []
        if not marked and entry is not None:
            entries.append(_expand_value(entry, legs, place))
    return entries


def _has_mark(value: Any) -> bool:
    if isinstance(value, list):
        return any(_has_mark(entry) for entry in value)
    return isinstance(value, str) and MARK in value


def _fill_mark(value: Any, leg: str) -> Any:
    if isinstance(value, list):
        return [_fill_mark(entry, leg) for entry in value]
    return value.replace(MARK, leg) if isinstance(value, str) else value


def _require_legs(legs: Sequence[str], value: Any, place: TomlCell) -> None:
    if not legs:
        raise place.make_error(
            f"got {quote_value(value)}: {MARK} stands for the legs, and the file names none; write "
            'legs = ["1", "2", "3"] at its top'
        )


def _check_marks(value: Any, place: TomlCell) -> Any:
    if isinstance(value, str) and (mark := re.search(r"\{[^}]*\}?", value)):
        raise place.make_error(
            f"got {quote_value(value)} with {quote_value(mark[0])}; the only mark is {MARK}, "
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


def read_platform(place: TomlCell) -> tuple[list[tuple[Row, RowPlace]], tuple[str, ...]]:
    """Returns rows that carry the platform, and their names; none without a platform.

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
    table = place.read_checked_table(("name", "motion"), _PLATFORM_EXAMPLE, missing=advice)
    here = place.enter("name", normalise_row_name(table["name"]))
    name = here.read_text('"P"')
    if not ROW_NAME.fullmatch(name):
        raise here.make_mismatch('letters and digits such as "P"')
    motion = table["motion"]
    if motion not in list(_MOTIONS):
        raise place.enter("motion").make_error(
            f"got {quote_value(motion)}{suggest_name(motion, _MOTIONS)}; expected "
            f"{join_names(_MOTIONS)}"
        )
    names = [name if len(step) == 1 else f"{name}{step[0]}" for step in _MOTIONS[motion]]
    antecedents = ["0", *names]
    rows = []
    for step, row_name, antecedent in zip(_MOTIONS[motion], names, antecedents, strict=False):
        sigma = int(step[-1])
        row: Row = dict.fromkeys(("gamma", "alpha"), "pi/2") | {"j": row_name, "a": antecedent}
        row |= {"mu": 0, "sigma": sigma, ("r" if sigma else "theta"): f"q{row_name}"}
        rows.append((row, RowPlace(place.file, place.location, row=row_name)))
    return rows, tuple(names)


# Motors that drive the joints through a coupling: `[motors]`, for logs of the motor side.


_MOTOR_EXAMPLE = '[motors] m1 = "q1", m2 = "q2 - 0.4*q1"'

Ratios = Mapping[str, Mapping[str, Fraction]]
"""{motor: {joint: coefficient}}, the rows of G."""


def build_motor_rows(place: TomlCell, rows: Rows) -> Rows:
    """Returns rows of the motors, to stand below the table; the joints that they drive get mu 0.

    Raises:
        RobotError: a name that is taken or no name, a motor that drives no joint of the table.
    """
    taken = {row["j"]: (row, spot) for row, spot in rows}
    new_rows = []
    for name, here in place.read_items(_MOTOR_EXAMPLE):
        if not ROW_NAME.fullmatch(name) or name == "0":
            raise here.make_error('expected a name of letters and digits such as "m1"')
        check_name_length(name, here)
        if name in taken:
            raise here.make_error(
                f"row {quote_value(name)} of [mdh] has that name; call the motor m{name}: its "
                f"columns are then qm{name} and taum{name}"
            )
        expression = here.read_expression()
        joints = [
            taken[variable[1:]]
            for variable in sorted(expression.names)
            if variable.startswith("q") and variable[1:] in taken
        ]
        if not joints:
            raise here.make_error(
                f"got {quote_value(expression.text)}, without a joint variable; expected the "
                f"position of the motor as a sum of {join_names(f'q{row}' for row in taken)}"
            )
        sliding = all(read_row_kind(*joint) is JointKind.PRISMATIC for joint in joints)
        kind = JointKind.PRISMATIC if sliding else JointKind.REVOLUTE
        motor: Row = {"j": name, "a": "0", "mu": 1, "sigma": kind.value, HOME[kind]: f"q{name}"}
        new_rows.append((motor, RowPlace(here.file, here.location, row=name)))
        for joint, _ in joints:
            joint["mu"] = 0
    return tuple(new_rows)


def read_motors(place: TomlCell, rows: Rows, symbols: Values) -> tuple[Ratios, dict[str, str]]:
    """Returns G, and the relations of the joints to the motors, as cells of `[relations]`.

    Args:
        place: the table `[motors]`.
        rows: of the table, those of the motors included.
        symbols: values of the declared symbols.

    Raises:
        RobotError: no sum of joint variables, not as many motors as joints, or a singular G.
    """
    table = place.read_table(_MOTOR_EXAMPLE)
    if not table:
        return {}, {}
    names = [row["j"] for row, _ in rows if row["j"] not in table]
    variables = {f"q{name}": name for name in names}
    ratios: dict[str, dict[str, Fraction]] = {}
    for motor, here in place.read_items(_MOTOR_EXAMPLE):
        expression = here.read_expression()
        only = ": the motor reads 0 where the joints do"
        form = read_joint_sum(expression, symbols, variables, here, "q2 - 0.4*q1", only)
        coefficients = form.coefficients.items()
        ratios[motor] = {variables[name]: _recover_fraction(c) for name, c in coefficients}
    joints = [name for name in names if any(name in row for row in ratios.values())]
    if len(ratios) != len(joints):
        raise place.make_error(
            f"got {len(ratios)} motors ({join_names(list(ratios))}) for the {len(joints)} joints "
            f"{join_names(joints)}; expected one motor for each joint"
        )
    inverse = _compute_checked_inverse(ratios, joints, place)
    return ratios, {
        f"q{joint}": _format_sum({f"q{motor}": c for motor, c in zip(ratios, row, strict=True)})
        for joint, row in zip(joints, inverse, strict=True)
    }


def check_driven(robot: Robot, place: TomlCell) -> None:
    """Refuses joints with a motor of their own beside those of `[motors]`.

    Raises:
        RobotError: names the first.
    """
    others = [j.name for j in robot.free_joints if j.actuated and j.name not in robot.motors]
    if robot.motors and others:
        raise place.make_error(
            f"no motor turns with q{others[0]}, which has one; expected every joint with a motor "
            f'in some sum; add m{others[0]} = "q{others[0]}", or write mu 0 in its row'
        )


def compute_joint_directions(robot: Robot) -> dict[str, tuple[float, ...]]:
    """Returns how fast the coordinates move when one joint moves alone at speed 1: columns of G.

    Unit vectors where the coordinates are the joints themselves. Joints in table order, entries in
    the order of `robot.coordinates`.
    """
    coordinates = [joint.name for joint in robot.coordinates]
    if not robot.motors:
        return {name: tuple(float(name == other) for other in coordinates) for name in coordinates}
    joints = [j.name for j in robot.joints if any(j.name in row for row in robot.motors.values())]
    rows = {joint: [robot.motors[m].get(joint, 0.0) for m in coordinates] for joint in joints}
    return {joint: tuple(row) for joint, row in rows.items()}


def _recover_fraction(value: float) -> Fraction:
    """1/3 as it was meant, 0.4 as it was written."""
    simple = Fraction(value).limit_denominator(THRESHOLDS.max_ratio_denominator)
    return simple if float(simple) == value else Fraction(repr(value))


def _compute_checked_inverse(
    ratios: Ratios, joints: Sequence[str], place: TomlCell
) -> list[list[Fraction]]:
    """G^-1.

    Raises:
        RobotError: G is singular, or so nearly that joints outrun the motors.
    """
    rows = [[row.get(joint, Fraction(0)) for joint in joints] for row in ratios.values()]
    inverse = _invert_exactly(rows)
    if inverse is None:
        raise place.make_error(
            f"{_format_ratios(ratios)}: singular, some motion of {join_names(joints)} turns no "
            "motor; expected motors whose positions determine those of all joints; correct the "
            "coefficients"
        )
    largest = max(abs(c) for row in inverse for c in row)
    if largest > THRESHOLDS.max_joint_ratio:
        raise place.make_error(
            f"{_format_ratios(ratios)}: nearly singular, a joint moves {float(largest):.3g} times "
            "as far "
            f"as a motor; expected at most {THRESHOLDS.max_joint_ratio:g}; correct the coefficients"
        )
    return inverse


def _invert_exactly(matrix: Sequence[Sequence[Fraction]]) -> list[list[Fraction]] | None:
    """The exact inverse by Gauss and Jordan; None of a singular matrix."""
    n = len(matrix)
    work = [[*row, *(Fraction(i == j) for j in range(n))] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if work[i][k] != 0), None)
        if pivot is None:
            return None
        work[k], work[pivot] = work[pivot], work[k]
        work[k] = [entry / work[k][k] for entry in work[k]]
        for i in range(n):
            if i != k and work[i][k] != 0:
                work[i] = [a - work[i][k] * b for a, b in zip(work[i], work[k], strict=True)]
    return [row[n:] for row in work]


def _format_sum(terms: Mapping[str, Fraction]) -> str:
    """`0.4*qm1 + qm2`."""
    text = " + ".join(
        name if c == 1 else f"-{name}" if c == -1 else f"{format_decimal(c) or c}*{name}"
        for name, c in terms.items()
        if c
    )
    return text.replace("+ -", "- ")


def _format_ratios(ratios: Ratios) -> str:
    return ", ".join(
        f"{motor} = {_format_sum({f'q{joint}': c for joint, c in row.items()})}"
        for motor, row in ratios.items()
    )


# Links that have not all ten parameters, and parameters that similar legs share.


def read_links(place: TomlCell, moving: Joints) -> dict[str, tuple[str, ...]]:
    """Returns inertial parameters of the rows that have not all ten: `[links] 5 = []`, `P = ["M"]`.

    Raises:
        RobotError: unknown rows or parameters.
    """
    links = {}
    for name, here in place.read_items('[links] 5 = [], P = ["M"]'):
        find_joint(name, moving, here)
        entries = here.read_list('["M"]')
        for entry in entries:
            if entry not in INERTIAL:
                expected = f"expected some of {join_names(INERTIAL)}"
                raise here.make_error(f"got {quote_value(entry)}; {expected}")
        links[name] = tuple(prefix for prefix in INERTIAL if prefix in entries)
    return links


def read_shared(
    place: TomlCell, known: Sequence[str], legs: Sequence[str]
) -> tuple[SharedParameter, ...]:
    """Reads the parameters that legs share: `shared = ["*2{i}"]` makes XX2 of XX21, XX22.

    Raises:
        RobotError: patterns without {i} or without a parameter, a name that is taken.
    """
    shared_parameters: dict[str, SharedParameter] = {}
    for entry in place.read_list('["*2{i}", "*3{i}"]'):
        pattern = place.with_value(normalise_row_name(entry)).read_text('"*2{i}"')
        if MARK not in pattern or not legs:
            expected = f'expected {MARK} in it and legs = ["1", "2"] at the top'
            raise place.make_error(f"got {quote_value(pattern)}; {expected}")
        first = pattern.replace(MARK, legs[0])
        stem = pattern.split(MARK)[0].rsplit("*", 1)[-1]
        matching = [name for name in known if fnmatch.fnmatchcase(name, first)]
        if not matching:
            raise place.make_error(
                f"{quote_value(pattern)} matches no parameter of leg {legs[0]}; expected names or "
                f"patterns of {join_names(known[:12])} ..."
            )
        for name in matching:
            head = name[: len(name) - len(first.rsplit("*", 1)[-1])]
            shared_name = head + stem + pattern.split(MARK)[1]
            members = tuple(head + stem + leg + pattern.split(MARK)[1] for leg in legs)
            for member in members:
                if member not in known:
                    raise place.make_error(
                        f"{quote_value(members[0])} has no counterpart {quote_value(member)}; "
                        "share what all legs have"
                    )
            if shared_name in known:
                raise place.make_error(
                    f"{quote_value(shared_name)} would be shared by the legs and is a parameter "
                    "already; rename that row"
                )
            shared_parameters[shared_name] = SharedParameter(shared_name, members)
    return tuple(shared_parameters.values())


def merge_shared_names(known: Sequence[str], shared: Sequence[SharedParameter]) -> tuple[str, ...]:
    """Returns the parameters' names with shared ones once, where their first member stood."""
    first = {parameter.members[0]: parameter.name for parameter in shared}
    merged_names = {member for parameter in shared for member in parameter.members[1:]}
    return tuple(first.get(name, name) for name in known if name not in merged_names)
