"""The moving platform of a parallel robot: rows of the table that move it freely."""

from typing import Any

from modeler.robot.cells import name_of, table_at, text_at
from modeler.robot.place import Place, listed, near, shown
from modeler.robot.table import ROW_NAME, Row

_EXAMPLE = '[platform] name = "P", motion = "translation"'
_MOTIONS = {
    "translation": ("x1", "y1", "1"),
    "planar": ("x1", "y1", "0"),
    "free": ("x1", "y1", "z1", "a0", "b0", "0"),
}
"""Per motion, the rows: suffix of the name and sigma."""


def read_platform(value: Any, place: Place) -> tuple[list[tuple[Row, Place]], tuple[str, ...]]:
    """Rows that carry the platform, and their names; none without a platform.

    They stand before the table's, so that frames may be fixed on the platform. Each turns the axes
    cyclically (gamma = alpha = pi/2: z is the x axis of the frame before), so that the travels are
    along x0, y0, z0 and the platform's axes at rest those of frame 0.

    translation: travels x, y, z; planar: travels x, y and a turn about z; free: travels x, y, z
    and turns with R = Rx(a) Ry(b) Rz(c). Only the last row carries the platform.

    Raises:
        RobotError: unknown keys or motion, no name.
    """
    if value is None:
        return [], ()
    name, motion = _stated(table_at(value, place, _EXAMPLE), place)
    names = [name if len(step) == 1 else f"{name}{step[0]}" for step in _MOTIONS[motion]]
    antecedents = ["0", *names]
    rows = []
    for step, own, antecedent in zip(_MOTIONS[motion], names, antecedents, strict=False):
        sigma = int(step[-1])
        row: Row = {
            "j": own, "a": antecedent, "mu": 0, "sigma": sigma, "gamma": "pi/2", "alpha": "pi/2",
            ("r" if sigma else "theta"): f"q{own}",
        }  # fmt: skip
        rows.append((row, place))
    return rows, tuple(names)


def _stated(table: dict[str, Any], place: Place) -> tuple[str, str]:
    """Name and motion of the platform."""
    keys = ("name", "motion")
    for key in table:
        if key not in keys:
            raise place.error(f"unknown key {shown(key)}{near(key, keys)}; expected {listed(keys)}")
    for key in ("name", "motion"):
        if key not in table:
            raise place.error(f"{key} is missing; write {_EXAMPLE}")
    name = text_at(name_of(table["name"]), place.at("name"), '"P"')
    if not ROW_NAME.fullmatch(name):
        raise place.at("name").error(f'got {shown(name)}; expected letters and digits such as "P"')
    motion = table["motion"]
    if motion not in _MOTIONS:
        hint = near(motion, _MOTIONS) if isinstance(motion, str) else ""
        raise place.at("motion").error(f"got {shown(motion)}{hint}; expected {listed(_MOTIONS)}")
    return name, motion
