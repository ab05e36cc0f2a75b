"""The `[loops]` and `[home]` of a robot file."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.robot.cells import list_at, name_of, number_at, table_at, text_at
from modeler.robot.joint import Joint, JointKind
from modeler.robot.other_joints import other_joint
from modeler.robot.place import Place, listed, near, shown
from modeler.robot.robot import LOOP_KINDS, Loop

MOST_LOOPS = 50
"""As many as legs."""
_COLUMNS = ("loop", "frame", "meets", "joint")
_EXAMPLE = 'columns = ["loop", "frame", "meets", "joint"], rows = [["A", "9", "10", "rigid"]]'


_ROUNDING = 1e-3
"""rad by which a full turn may be rounded up."""


def read_loops(value: Any, joints: Sequence[Joint], place: Place) -> tuple[Loop, ...]:
    """The loops of a file.

    Raises:
        RobotError: columns, rows, frames or joints are wrong, or there is nothing to close.
    """
    if value is None:
        return ()
    table = table_at(value, place, f"[loops] {_EXAMPLE}")
    for key in table:
        if key not in ("columns", "rows"):
            raise place.error(
                f"unknown key {shown(key)}{near(key, ('columns', 'rows'))}; write {_EXAMPLE}"
            )
    columns = list_at(table.get("columns", list(_COLUMNS)), place.at("columns"), _EXAMPLE)
    if sorted(map(str, columns)) != sorted(_COLUMNS):
        raise place.at("columns").error(f"got {shown(columns)}; expected {listed(_COLUMNS)}")
    if "rows" not in table:
        raise place.error(f"rows is missing; write {_EXAMPLE}")
    rows = list_at(table["rows"], place.at("rows"), _EXAMPLE)
    if len(rows) > MOST_LOOPS:
        raise place.at("rows").error(
            f"got {len(rows)} loops, those of all legs counted; expected at most {MOST_LOOPS}: "
            "model parts of the robot in files of their own"
        )
    loops = []
    for number, cells in enumerate(rows, start=1):
        here = place.at(f"row {number}")
        cells = list_at(cells, here, '["A", "9", "10", "rigid"]', length=len(_COLUMNS))
        loops.append(_loop(dict(zip(columns, cells, strict=True)), joints, here))
    if not loops:
        raise place.at("rows").error(
            'the table is empty; write one row per loop, as in ["A", "9", "10", "rigid"], or leave '
            "[loops] out"
        )
    _check_names([loop.name for loop in loops], place)
    return tuple(loops)


def _check_names(names: Sequence[str], place: Place) -> None:
    for number, name in enumerate(names, start=1):
        if name in names[: number - 1]:
            raise place.at(f"row {number}").error(
                f"{shown(name)} is the name of row {names.index(name) + 1} too; give every loop "
                "its own name"
            )


def _loop(cells: Mapping[str, Any], joints: Sequence[Joint], place: Place) -> Loop:
    name = text_at(name_of(cells["loop"]), place.at("column loop"), '"A"')
    here = place.at(shown(name))
    names = {joint.name for joint in joints}
    frames = []
    for column, known in (("frame", names), ("meets", {"0", *names})):
        frame = name_of(cells[column])
        if frame not in known:
            hint = near(frame, known) if isinstance(frame, str) else ""
            raise here.at(f"column {column}").error(
                f"got {shown(frame)}, which is no row of the table{hint}; expected one of "
                f"{listed(joint.name for joint in joints)}"
            )
        frames.append(frame)
    kind = cells["joint"]
    if kind not in LOOP_KINDS:
        instead = other_joint(kind) if isinstance(kind, str) else None
        hint = near(kind, LOOP_KINDS) if isinstance(kind, str) else ""
        told = f"; {instead}" if instead else f"{hint}; expected one of {listed(LOOP_KINDS)}"
        raise here.at("column joint").error(f"got {shown(kind)}{told}")
    bodies = [_body(frame, joints) for frame in frames]
    if bodies[0] == bodies[1]:
        raise here.error(
            f"frames {frames[0]} and {frames[1]} are both fixed on "
            f"{'the base' if bodies[0] == '0' else f'link {bodies[0]}'}: there is nothing to "
            "close; name a frame of another link"
        )
    return Loop(name, frames[0], frames[1], kind)


def _body(frame: str, joints: Sequence[Joint]) -> str:
    """The moving row that carries the frame, "0" for the base."""
    rows = {joint.name: joint for joint in joints}
    while frame != "0" and not rows[frame].moves:
        frame = rows[frame].antecedent
    return frame


def read_home(
    value: Any, moving: Mapping[str, Joint], symbols: Mapping[str, float], place: Place
) -> dict[str, float]:
    """The posture from which loops are closed, by row: `[home] q2 = "-pi/2"`.

    Raises:
        RobotError: no such joint variable, or no number.
    """
    variables = {joint.variable: name for name, joint in moving.items()}
    home = {}
    for key, cell in table_at(value, place, '[home] q2 = "-pi/2"').items():
        here = place.at(shown(key))
        if key not in variables:
            raise here.error(
                f"is no joint variable{near(key, variables)}; expected some of "
                f"{listed(list(variables)[:12])}"
            )
        home[variables[key]] = number_at(cell, symbols, here)
        _check_turn(moving[variables[key]], home[variables[key]], here)
    return home


def _check_turn(joint: Joint, value: float, place: Place) -> None:
    if joint.kind is JointKind.REVOLUTE and abs(value) > 2 * math.pi + _ROUNDING:
        raise place.error(
            f"got {value:g} rad, which is more than a turn; angles are in radians: write "
            f'"{value:g}*pi/180" for degrees'
        )
