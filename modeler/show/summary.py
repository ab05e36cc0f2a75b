"""What is shown, in words and for machines."""

from typing import Any

import numpy as np

from modeler.show.closing import CLOSED, Gap, Posture, gaps_of
from modeler.show.pose import poses
from modeler.show.skeleton import Row, Skeleton, kind_word
from modeler.show.table import gravity_text

_HEAD = ("j", "a", "joint", "q", "x", "y", "z", "axis")


def told(skeleton: Skeleton, posture: Posture) -> list[str]:
    """Lines for people: where every frame stands at home, and whether the loops close."""
    robot = skeleton.robot
    frames = poses(skeleton, posture.u)
    cells = [_HEAD, *(_cells(row, frames[i], posture) for i, row in enumerate(skeleton.rows))]
    widths = [max(len(line[k]) for line in cells) for k in range(len(_HEAD))]
    table = [
        "  ".join(text.rjust(w) if 3 <= k <= 6 else text.ljust(w)
                  for k, (text, w) in enumerate(zip(line, widths, strict=True))).rstrip()
        for line in cells
    ]  # fmt: skip
    plain = gravity_text(skeleton).replace("\u2212", "-").replace("\u00b2", "2")
    lines = [f"{robot.name}: {robot.title}", plain]
    lines += ["frames at home: origin in frame 0 [m], direction of the joint's axis", *table]
    return [*lines, *_loop_lines(skeleton, posture)]


def _cells(row: Row, frame: np.ndarray, posture: Posture) -> tuple[str, ...]:
    joint = row.joint
    kind = kind_word(joint)
    if joint.moves:
        kind += ", actuated" if joint.actuated else ", platform" if row.virtual else ", passive"
    q = _number(row.constant + row.coefficients @ posture.u) if joint.moves else ""
    return (joint.name, joint.antecedent, kind, q, *map(_number, frame[:3, 3]),
            _direction(frame[:3, 2]))  # fmt: skip


def _loop_lines(skeleton: Skeleton, posture: Posture) -> list[str]:
    lines = []
    for gap in gaps_of(skeleton, posture.u):
        loop = gap.loop
        state = "closed"
        if not _is_closed(gap, posture):
            angle = f" and {np.degrees(gap.angle):.3g} degrees" if gap.angle > CLOSED else ""
            state = f"OPEN by {gap.distance:.3g} m{angle}"
        lines.append(f'loop "{loop.name}": {loop.frame} meets {loop.meets} ({loop.kind}): {state}')
    if not posture.closed:
        where = "near [home]: drawn as it is stated"
        if not skeleton.robot.home:
            where = "near all joints at 0: drawn so"
        lines.append(
            f"the loops do not close {where}; move the joints by hand on the page, close the "
            "loops there, and copy [home]"
        )
    elif not posture.held:
        lines.append(
            "the loops do not close with the actuated joints as [home] states them: drawn nearby"
        )
    if posture.note:
        lines.append(posture.note)
    elif posture.loose:
        lines.append(
            f"joints {', '.join(posture.loose)} could move there with the actuated joints locked: "
            "[home] is singular, or the loops determine too little"
        )
    return lines


def described(skeleton: Skeleton, posture: Posture) -> dict[str, Any]:
    """The same for machines: poses are 4x4 matrices, rows first, in frame 0, m."""
    frames = poses(skeleton, posture.u)
    return {
        "robot": skeleton.robot.name,
        "title": skeleton.robot.title,
        "coordinates": [skeleton.free[k] for k in skeleton.given],
        "home": {
            row.joint.variable: float(row.constant + row.coefficients @ posture.u)
            for row in skeleton.rows
            if row.joint.moves
        },
        "frames": [
            {"name": row.joint.name, "antecedent": row.joint.antecedent,
             "joint": kind_word(row.joint), "actuated": row.joint.actuated,
             "pose": frames[i].tolist()}
            for i, row in enumerate(skeleton.rows)
        ],
        "loops": [
            {"loop": gap.loop.name, "frame": gap.loop.frame, "meets": gap.loop.meets,
             "joint": gap.loop.kind, "gap": gap.distance, "angle": gap.angle,
             "closed": _is_closed(gap, posture)}
            for gap in gaps_of(skeleton, posture.u)
        ],
        "closed": posture.closed,
        "as_stated": posture.held,
        "loose": list(posture.loose),
        "note": posture.note,
        "gravity": skeleton.gravity.tolist(),
    }  # fmt: skip


def _is_closed(gap: Gap, posture: Posture) -> bool:
    return gap.distance < 10.0 * CLOSED * posture.size and gap.angle < 10.0 * CLOSED


def _number(x: float) -> str:
    return f"{0.0 if abs(x) < 5e-5 else x:.4f}"


def _direction(z: np.ndarray) -> str:
    """`+z`, `-y`, or its three components."""
    k = int(np.argmax(np.abs(z)))
    if abs(z[k]) > 1.0 - 1e-9:
        return f"{'-' if z[k] < 0 else '+'}{'xyz'[k]}0"
    return " ".join(f"{0.0 if abs(x) < 5e-4 else x:.3f}" for x in z)
