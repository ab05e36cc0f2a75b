"""The table of a robot for people, and what stands beside it."""

import re
from dataclasses import dataclass

import numpy as np

from modeler.robot import JointKind, Robot
from modeler.robot.joint import Joint
from modeler.show.skeleton import Skeleton

_COLUMNS = ("gamma", "b", "alpha", "d", "theta", "r")
_LETTERS = {"gamma": "γ", "alpha": "α", "theta": "θ"}


@dataclass(frozen=True)
class TableRow:
    """One row of the table, as it is printed.

    Attributes:
        number: index of the joint.
        kind: "fixed", "actuated" or "passive".
        cells: joint, antecedent, mu, sigma.
        entries: (column, text) of the columns that are used.
        platform: True for a row of the platform.
    """

    number: int
    kind: str
    cells: tuple[str, ...]
    entries: tuple[tuple[str, str], ...]
    platform: bool


def table_head(robot: Robot) -> tuple[str, ...]:
    """The names of the columns; those that are zero everywhere are left out."""
    return ("j", "a", "μ", "σ", *(_LETTERS.get(name, name) for name in _used(robot)), "q")


def table_rows(robot: Robot) -> tuple[TableRow, ...]:
    """The rows in table order, the platform's last."""
    used = _used(robot)
    rows = [_row(i, joint, used, robot) for i, joint in enumerate(robot.joints)]
    return tuple(sorted(rows, key=lambda row: row.platform))


def _used(robot: Robot) -> list[str]:
    return [name for name in _COLUMNS if any(not getattr(j, name).is_zero for j in robot.joints)]


def _row(i: int, joint: Joint, used: list[str], robot: Robot) -> TableRow:
    kind = "fixed" if not joint.moves else "actuated" if joint.actuated else "passive"
    cells = (joint.name, joint.antecedent, f"{joint.actuated:d}", f"{JointKind(joint.kind):d}")
    entries = tuple((name, _typeset(getattr(joint, name).text)) for name in used)
    return TableRow(i, kind, cells, entries, joint.name in robot.platform)


def _typeset(cell: str) -> str:
    """`pi/2` as it is printed; a minus as long as a minus."""
    return re.sub(r"\bpi\b", "π", cell).replace("-", "−")


def gravity_text(skeleton: Skeleton) -> str:
    """`gravity 9.81 m/s² along −z0`."""
    length = float(np.linalg.norm(skeleton.gravity))
    if length == 0.0:
        return "no gravity"
    along = skeleton.gravity / length
    k = int(np.argmax(np.abs(along)))
    if abs(along[k]) > 1.0 - 1e-12:
        return f"gravity {length:.4g} m/s² along {'−' if along[k] < 0 else '+'}{'xyz'[k]}0"
    return f"gravity {length:.4g} m/s² along ({', '.join(f'{x:.3g}' for x in along)})"


def relations_text(robot: Robot) -> str:
    """`q4 = -q3, q7 = q3`; nothing without relations."""
    found = [f"q{name} = {relation.text}" for name, relation in robot.relations.items()]
    return ", ".join(found)
