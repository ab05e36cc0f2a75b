"""How frames that controllers steer stand and move: pose, Jacobian, its rate, twist.

A frame is that of a row of the table, a link of `[frames]`, or the tool. Linear before angular:
rows 0 to 2 belong to the velocity of the frame's origin, 3 to 5 to its angular velocity.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from modeler.core.errors import DerivationError
from modeler.derivation.geometry import placement
from modeler.derivation.graph import Expr, Vector
from modeler.derivation.kinematics import (
    AxesOrigin,
    cross,
    dot,
    plus,
    poses_from,
    static_rotation,
    times,
    turned_axes,
    unit_axes,
)
from modeler.derivation.model import SymbolicModel
from modeler.robot import LinkFrame, Robot


@dataclass(frozen=True)
class BodyFrame:
    """A frame that moves with a row.

    Attributes:
        row: place of the row in the table.
        axes: x, y, z of the frame in that of the row.
        origin: in that of the row, m.
    """

    row: int
    axes: Sequence[Vector]
    origin: Vector


def known_frames(robot: Robot) -> dict[str, LinkFrame | None]:
    """Names of the frames that move: rows of the table (None), then links of `[frames]`."""
    links = {name: frame for name, frame in robot.frames.items() if frame.row != "0"}
    return links | {joint.name: None for joint in robot.joints}


def body_frame(model: SymbolicModel, name: str = "") -> BodyFrame:
    """The frame of that name; without one that of the tool.

    Where the robot states none, that of the platform, or of the last row.

    Raises:
        DerivationError: no frame has the name.
    """
    robot, names = model.robot, [joint.name for joint in model.robot.joints]
    known = known_frames(robot)
    if name and name not in known:
        raise DerivationError(
            f'frame "{name}": {robot.name} has none of that name; expected {", ".join(known)}'
        )
    link = known[name] if name else robot.tool
    row = link.row if link else name or (*names, *robot.platform)[-1]
    return BodyFrame(names.index(row), *_on_row(model, link))


def _on_row(model: SymbolicModel, link: LinkFrame | None) -> AxesOrigin:
    """Axes and origin of a frame in that of its row."""
    if link is None:
        return unit_axes(model.algebra)
    at = _on_row(model, link.on)
    position, angles = placement(model.robot, link)
    x, y, z = at[0]
    roll, pitch, yaw = (static_rotation(angle, model.algebra) for angle in angles)
    x, y = turned_axes(yaw, x, y)
    z, x = turned_axes(pitch, z, x)
    y, z = turned_axes(roll, y, z)
    return [x, y, z], plus(at[1], _turned(at, list(map(model.algebra.static, position))))


def frame_pose(model: SymbolicModel, frame: BodyFrame) -> list[list[Expr]]:
    """[R | p], 3 x 4: the axes in the columns of R, and the origin, in frame 0."""
    at = poses_from(model.geometry, model.frames, model.algebra, None, {frame.row})[frame.row]
    axes, origin = (
        [_turned(at, axis) for axis in frame.axes],
        plus(at[1], _turned(at, frame.origin)),
    )
    return [[*(axis[i] for axis in axes), origin[i]] for i in range(3)]


def _turned(at: AxesOrigin, v: Vector) -> Vector:
    """A vector of the frame in the axes in which its own are given."""
    x, y, z = (times(c, axis) for c, axis in zip(v, at[0], strict=True))
    return plus(plus(x, y), z)


def jacobian(model: SymbolicModel, frame: BodyFrame) -> list[list[Expr]]:
    """J of (v, w) = J qd, 6 x n, in the axes of frame 0."""
    geometry, zero = model.geometry, model.graph.constant(0)
    found = poses_from(geometry, model.frames, model.algebra, None, {frame.row})
    arm = _turned(found[frame.row], frame.origin)  # from the origin of the row at hand
    rows = [[zero] * geometry.joints for _ in range(6)]
    for k in geometry.ancestors(frame.row):
        row = geometry.rows[k]
        if row.index is not None:
            axis = times(row.rate, found[k][0][2])
            column = [*cross(axis, arm), *axis] if row.joint.angular else [*axis, *[zero] * 3]
            for line, value in zip(rows, column, strict=True):
                line[row.index] = value
        arm = plus(_turned(found[row.parent], model.frames[k].p), arm)
    return [model.free_efforts(line) for line in rows]


def jacobian_dot_qd(model: SymbolicModel, frame: BodyFrame) -> list[Expr]:
    """dJ/dt qd, 6: the accelerations of the frame while qdd = 0, in the axes of frame 0."""
    qd, zero = model.inputs("qd"), model.graph.constant(0)
    moved = model.link_motions(qd, [zero] * len(qd), gravity=False)[frame.row]
    a, wd = plus(moved.vd, [dot(line, frame.origin) for line in moved.U]), moved.wd
    for k in model.geometry.ancestors(frame.row):
        a, wd = model.frames[k].to_antecedent(a), model.frames[k].to_antecedent(wd)
    return [*a, *wd]


def twist(model: SymbolicModel, frame: BodyFrame) -> list[Expr]:
    """(v, w) of the frame, 6, in its own axes."""
    still = [model.graph.constant(0)] * model.geometry.coordinates
    with model.speeds_for_accelerations():
        moved = model.link_motions(still, model.inputs("qd"), gravity=False)[frame.row]
    v = plus(moved.vd, cross(moved.wd, frame.origin))
    return [dot(axis, x) for x in (v, moved.wd) for axis in frame.axes]
