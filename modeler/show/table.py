"""The table of a robot for people: HTML, and what stands beside it."""

import html
import re

import numpy as np

from modeler.robot import JointKind, Robot
from modeler.robot.joint import Joint
from modeler.show.skeleton import Skeleton

_COLUMNS = ("gamma", "b", "alpha", "d", "theta", "r")
_LETTERS = {"gamma": "γ", "alpha": "α", "theta": "θ"}


def table_html(robot: Robot) -> str:
    """The rows of an HTML table: its head, the rows in table order, the platform's last."""
    used = [name for name in _COLUMNS if any(not getattr(j, name).is_zero for j in robot.joints)]
    heads = ["j", "a", "μ", "σ", *(_LETTERS.get(name, name) for name in used)]
    head = "".join(f"<th>{name}</th>" for name in [*heads, "q"])
    own = [(i, j) for i, j in enumerate(robot.joints) if j.name not in robot.platform]
    moved = [(i, j) for i, j in enumerate(robot.joints) if j.name in robot.platform]
    lines = [f"<thead><tr>{head}</tr></thead><tbody>"]
    lines += [_row(i, joint, used) for i, joint in own]
    if moved:
        lines.append(f'<tr class="part"><td colspan="{len(heads) + 1}">platform</td></tr>')
        lines += [_row(i, joint, used) for i, joint in moved]
    return "\n".join([*lines, "</tbody>"])


def _row(i: int, joint: Joint, used: list[str]) -> str:
    kind = "fixed" if not joint.moves else "actuated" if joint.actuated else "passive"
    cells = [joint.name, joint.antecedent, f"{joint.actuated:d}", f"{JointKind(joint.kind):d}"]
    filled = "".join(f"<td>{html.escape(cell)}</td>" for cell in cells)
    filled += "".join(
        f'<td data-cell="{name}">{html.escape(_typeset(getattr(joint, name).text))}</td>'
        for name in used
    )
    return f'<tr class="{kind}" data-row="{i}">{filled}<td class="value"></td></tr>'


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
