"""How frames that controllers steer stand and move: pose, Jacobian, its rate, twist.

A frame is that of a row of the table, a link of `[frames]`, or the tool. Linear before angular:
rows 0 to 2 belong to the velocity of the frame's origin, 3 to 5 to its angular velocity.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from modeler.core.errors import DerivationError
from modeler.derivation.geometry import compute_placement
from modeler.derivation.graph import Expr, Vector
from modeler.derivation.kinematics import (
    AxesOrigin,
    build_unit_axes,
    compute_relative_poses,
    cross,
    dot,
    evaluate_rotation,
    plus,
    rotate_axes,
    times,
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


def collect_frames(robot: Robot) -> dict[str, LinkFrame | None]:
    """Returns the names of frames that move: rows of the table (None), then `[frames]`."""
    links = {name: frame for name, frame in robot.frames.items() if frame.row != "0"}
    return links | {joint.name: None for joint in robot.joints}


def find_body_frame(model: SymbolicModel, name: str = "") -> BodyFrame:
    """Returns the frame of that name; without a name that of the tool.

    Where the robot states none, that of the platform, or of the last row.

    Raises:
        DerivationError: no frame has the name.
    """
    robot, names = model.robot, [joint.name for joint in model.robot.joints]
    known = collect_frames(robot)
    if name and name not in known:
        raise DerivationError(
            f'frame "{name}": {robot.name} has none of that name; expected {", ".join(known)}'
        )
    link = known[name] if name else robot.tool
    row = link.row if link else name or (*names, *robot.platform)[-1]
    return BodyFrame(names.index(row), *_place_on_row(model, link))


def _place_on_row(model: SymbolicModel, link: LinkFrame | None) -> AxesOrigin:
    """Axes and origin of a frame in that of its row."""
    if link is None:
        return build_unit_axes(model.algebra)
    at = _place_on_row(model, link.on)
    position, angles = compute_placement(model.robot, link)
    x, y, z = at[0]
    roll, pitch, yaw = (evaluate_rotation(angle, model.algebra) for angle in angles)
    x, y = rotate_axes(yaw, x, y)
    z, x = rotate_axes(pitch, z, x)
    y, z = rotate_axes(roll, y, z)
    return [x, y, z], plus(at[1], _rotate_vector(at, list(map(model.algebra.static, position))))


def derive_frame_pose(model: SymbolicModel, frame: BodyFrame) -> list[list[Expr]]:
    """Returns [R | p], 3 x 4: the axes in the columns of R, and the origin, in frame 0."""
    at = compute_relative_poses(model.geometry, model.frames, model.algebra, None, {frame.row})[
        frame.row
    ]
    axes, origin = (
        [_rotate_vector(at, axis) for axis in frame.axes],
        plus(at[1], _rotate_vector(at, frame.origin)),
    )
    return [[*(axis[i] for axis in axes), origin[i]] for i in range(3)]


def _rotate_vector(at: AxesOrigin, v: Vector) -> Vector:
    """A vector of the frame in the axes in which its own are given."""
    x, y, z = (times(c, axis) for c, axis in zip(v, at[0], strict=True))
    return plus(plus(x, y), z)


def derive_jacobian(model: SymbolicModel, frame: BodyFrame) -> list[list[Expr]]:
    """Returns J of (v, w) = J qd, 6 x n, in the axes of frame 0."""
    geometry, zero = model.geometry, model.graph.constant(0)
    frame_poses = compute_relative_poses(geometry, model.frames, model.algebra, None, {frame.row})
    arm = _rotate_vector(frame_poses[frame.row], frame.origin)  # from the origin of the row at hand
    rows = [[zero] * geometry.joint_count for _ in range(6)]
    for k in geometry.find_ancestors(frame.row):
        row = geometry.rows[k]
        if row.index is not None:
            axis = times(row.rate, frame_poses[k][0][2])
            column = [*cross(axis, arm), *axis] if row.joint.is_revolute else [*axis, *[zero] * 3]
            for line, value in zip(rows, column, strict=True):
                line[row.index] = value
        arm = plus(_rotate_vector(frame_poses[row.parent], model.frames[k].p), arm)
    return [model.reduce_to_free(line) for line in rows]


def derive_jacobian_dot_qd(model: SymbolicModel, frame: BodyFrame) -> list[Expr]:
    """Returns dJ/dt qd, 6: the accelerations of the frame while qdd = 0, in the axes of frame 0."""
    qd, zero = model.get_inputs("qd"), model.graph.constant(0)
    moved = model.derive_link_motions(qd, [zero] * len(qd), gravity=False)[frame.row]
    a, wd = plus(moved.vd, [dot(line, frame.origin) for line in moved.U]), moved.wd
    for k in model.geometry.find_ancestors(frame.row):
        a, wd = model.frames[k].rotate_to_antecedent(a), model.frames[k].rotate_to_antecedent(wd)
    return [*a, *wd]


def derive_twist(model: SymbolicModel, frame: BodyFrame) -> list[Expr]:
    """Returns (v, w) of the frame, 6, in its own axes."""
    still = [model.graph.constant(0)] * model.geometry.coordinate_count
    with model.relabel_speeds():
        moved = model.derive_link_motions(still, model.get_inputs("qd"), gravity=False)[frame.row]
    v = plus(moved.vd, cross(moved.wd, frame.origin))
    return [dot(axis, x) for x in (v, moved.wd) for axis in frame.axes]
