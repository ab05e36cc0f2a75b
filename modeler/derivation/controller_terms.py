"""Terms of a controller: Coriolis matrix, momenta, regressors, poses and Jacobians of frames.

C is that of Christoffel symbols: of a body made of points, C = sum of m J^T dJ/dt over the points,
where J dq/dt is the velocity of the point. So C v is linear in v, C qd is the Coriolis torque, and
dM/dt = C + C^T. (Echeandia and Wensing 2021 compute the same by spatial vectors.)
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

from modeler.core.errors import DerivationError
from modeler.derivation.geometry import Geometry, GeometryRow, compute_placement
from modeler.derivation.graph import Expr, Scalar, Vector, attach_labels, attach_matrix_labels
from modeler.derivation.kinematics import (
    AxesOrigin,
    Composite,
    Motion,
    Pose,
    Screw,
    accumulate_wrenches,
    build_unit_axes,
    compute_frame_gravity,
    compute_inverse_dynamics,
    compute_link_wrench,
    compute_relative_poses,
    compute_steiner_term,
    compute_wrench_columns,
    cross,
    dot,
    evaluate_rotation,
    plus,
    project_wrench,
    rotate_axes,
    times,
)
from modeler.derivation.model import (
    Entries,
    LinkColumn,
    ShaftColumn,
    SymbolicModel,
    combine_along_shaft,
    derive_effect_entries,
)
from modeler.robot import LinkFrame, Robot


def cross_z(v: Vector) -> Vector:
    """Returns z x v."""
    return [-v[1], v[0], 0 * v[2]]


def project_on_axis(row: GeometryRow, force: Vector, moment: Vector) -> Scalar:
    """Returns torque of the row's joint under a force and a moment at its frame's origin."""
    return (moment if row.joint.is_revolute else force)[2] * row.rate


def compute_slide_velocity(row: GeometryRow, frame: Pose, speed: Scalar) -> Vector:
    """Returns velocity of the frame's origin in its antecedent, where its joint slides."""
    none = [0 * speed] * 3
    if row.index is None or row.joint.is_revolute:
        return none
    return frame.rotate_to_antecedent([*none[:2], speed])


class MovingComposite(Composite):
    """A link with all that it carries, and how that changes seen from the link.

    Attributes:
        MS_rate: d MS/dt, of the components in the link's frame; likewise
        J_rate: d J/dt.
        h: moment of momentum about the origin of what moves in the frame.
    """

    def __init__(self, parameters: Mapping[str, Any], zero: Scalar, link: str = "") -> None:
        super().__init__(parameters, zero, link)
        self.MS_rate: Vector = [zero] * 3
        self.J_rate: list[Vector] = [[zero] * 3 for _ in range(3)]
        self.h: Vector = [zero] * 3

    def compute_turned_rates(self, speed: Scalar) -> tuple[Vector, list[Vector], Vector]:
        """Returns MS_rate, J_rate and h seen from a frame in which the link turns about its z axis.

        d MS/dt += speed z x MS; d J/dt += speed ([z x] J - J [z x]); h += speed J z.
        """
        J = self.J
        turned = [
            [-2 * J[0][1], J[0][0] - J[1][1], -J[1][2]],
            [J[0][0] - J[1][1], 2 * J[0][1], J[0][2]],
            [-J[1][2], J[0][2], 0 * J[2][2]],
        ]
        rates = [plus(a, times(speed, b)) for a, b in zip(self.J_rate, turned, strict=True)]
        first = plus(self.MS_rate, times(speed, cross_z(self.MS)))
        h = plus(self.h, times(speed, [line[2] for line in J]))
        attach_matrix_labels("Jd", self.link, rates, "t")
        attach_labels("MSd", self.link, first, "t")
        return first, rates, attach_labels("hc", self.link, h, "t")

    def add_moving_composite(
        self, other: "MovingComposite", frame: Pose, row: GeometryRow, speed: Scalar
    ) -> None:
        """Adds what hangs on the row's frame, whose joint has this speed."""
        p, dp = frame.p, compute_slide_velocity(row, frame, speed)
        turning = speed if row.index is not None and row.joint.is_revolute else 0 * speed
        first, rates, h = other.compute_turned_rates(turning)
        S, dS = frame.rotate_to_antecedent(other.MS), frame.rotate_to_antecedent(first)
        shifted = plus(S, times(other.M, p))
        turned = attach_matrix_labels("Jd", other.link, frame.rotate_inertia(rates), "a")
        zero = 0 * other.M
        for i in range(3):
            for j in range(3):
                moved = compute_steiner_term(p, dS, zero, i, j)
                moved += compute_steiner_term(dp, shifted, zero, i, j)
                self.J_rate[i][j] = self.J_rate[i][j] + turned[i][j] + moved
        self.h = plus(self.h, frame.rotate_to_antecedent(h))
        self.h = plus(self.h, plus(cross(p, dS), cross(shifted, dp)))
        self.MS_rate = plus(self.MS_rate, plus(dS, times(other.M, dp)))
        attach_labels("MSd", self.link, self.MS_rate), attach_labels("hc", self.link, self.h)
        attach_matrix_labels("Jd", self.link, self.J_rate)
        self.add_composite(other, frame)

    def compute_column(self, row: GeometryRow, w: Vector) -> tuple[Vector, Vector]:
        """Returns force and moment per unit of v of the joint: sum of m dJ/dt and m r x dJ/dt.

        With z the axis, f = z x d MS/dt + w x (z x MS) and
        n = (d J/dt z + z x h)/2 + z x (J w) - tr(J)/2 z x w for a joint that turns.
        """
        spun = times(row.rate, cross_z(w))  # z x w
        if not row.joint.is_revolute:
            f = times(self.M, [-x for x in spun])
            return f, cross(spun, self.MS)
        f = plus(cross_z(self.MS_rate), cross(w, cross_z(self.MS)))
        Jw = [dot(line, w) for line in self.J]
        n = plus(self._compute_half_rate(cross_z(self.h)), cross_z(Jw))
        return times(row.rate, f), plus(times(row.rate, n), times(-self._halve_trace(), spun))

    def compute_arm_rate(self, row: GeometryRow, w: Vector) -> Vector:
        """Returns the moment of the changing arms: sum of m dr/dt x J for unit speed of the joint.

        (d J/dt z - z x h)/2 + tr(J)/2 w x z - J (w x z) for a joint that turns.
        """
        spun = times(-row.rate, cross_z(w))  # w x z
        if not row.joint.is_revolute:
            h = plus(self.MS_rate, cross(w, self.MS))
            return times(-row.rate, cross_z(h))
        n = self._compute_half_rate([-x for x in cross_z(self.h)])
        turned = [-dot(line, spun) for line in self.J]
        return plus(times(row.rate, n), plus(times(self._halve_trace(), spun), turned))

    def _compute_half_rate(self, h: Vector) -> Vector:
        return times(Fraction(1, 2), plus([line[2] for line in self.J_rate], h))

    def _halve_trace(self) -> Scalar:
        return (self.J[0][0] + self.J[1][1] + self.J[2][2]) * Fraction(1, 2)


def compute_coriolis_matrix(
    geometry: Geometry,
    frames: Sequence[Pose],
    moved: Sequence[Motion],
    speeds: Sequence[Scalar],
    parameters: Sequence[Mapping[str, Any]],
    zero: Scalar,
) -> list[list[Scalar]]:
    """Returns C(q, qd) of the rigid links, (joints, joints).

    Args:
        geometry: the table.
        frames: poses of the rows.
        moved: motions of the rows' links, of which the angular velocities are read.
        speeds: of the joints.
        parameters: per row, the inertial parameters that are not zero.
        zero: the algebra's zero.
    """
    pairs = zip(parameters, geometry.rows, strict=True)
    links = [MovingComposite(p, zero, row.joint.name) for p, row in pairs]
    at_rest = [zero] * 3
    arms: list[Vector] = []  # how fast p turns and grows
    for row, frame in zip(geometry.rows, frames, strict=True):
        w = at_rest if row.parent is None else moved[row.parent].w
        speed = _get_joint_speed(row, speeds, zero)
        arms.append(plus(cross(w, frame.p), compute_slide_velocity(row, frame, speed)))
    matrix = [[zero] * geometry.joint_count for _ in range(geometry.joint_count)]
    for k in reversed(range(len(links))):
        row = geometry.rows[k]
        if row.index is not None:
            _fill_column(matrix, geometry, frames, moved, arms, links[k], k)
        if row.parent is not None:
            speed = _get_joint_speed(row, speeds, zero)
            links[row.parent].add_moving_composite(links[k], frames[k], row, speed)
    return matrix


def _get_joint_speed(row: GeometryRow, speeds: Sequence[Scalar], zero: Scalar) -> Scalar:
    return zero if row.index is None else speeds[row.index] * row.rate


def _fill_column(
    matrix: list[list[Scalar]],
    geometry: Geometry,
    frames: Sequence[Pose],
    moved: Sequence[Motion],
    arms: Sequence[Vector],
    link: MovingComposite,
    k: int,
) -> None:
    """Column of joint k in the rows of the joints below, and its row in their columns.

    With F, N the force and moment of column k, C_ik = z_i . N of joints i that turn. With f, n the
    momentum of unit speed of joint k and a that of its arms' change, carried to frame i,
    C_ki = (w_i x z_i) . n + z_i . a: what M'_ki = C_ki + C_ik leaves.
    """
    row = geometry.rows[k]
    assert row.index is not None
    F, N = link.compute_column(row, moved[k].w)
    f, n = link.compute_momentum(row)
    a, name = link.compute_arm_rate(row, moved[k].w), row.joint.name
    for letter, vector in (("fu", F), ("nu", N), ("angd", a)):
        attach_labels(letter, name, vector, of=name)
    for at in geometry.find_ancestors(k):
        other = geometry.rows[at]
        if other.index is not None:
            matrix[other.index][row.index] = project_on_axis(other, F, N)
            if at != k:
                (x, y, _), momentum = moved[at].w, n if other.joint.is_revolute else f
                turning = y * momentum[0] - x * momentum[1]
                along = turning + a[2] if other.joint.is_revolute else turning
                matrix[row.index][other.index] = along * other.rate
        frame = frames[at]
        F, f = frame.rotate_to_antecedent(F), frame.rotate_to_antecedent(f)
        N = plus(frame.rotate_to_antecedent(N), cross(frame.p, F))
        n = plus(frame.rotate_to_antecedent(n), cross(frame.p, f))
        a = plus(frame.rotate_to_antecedent(a), cross(arms[at], f))
        for letter, vector in (("fu", F), ("nu", N), ("lin", f), ("ang", n), ("angd", a)):
            attach_labels(letter, other.joint.name, vector, "a", row.joint.name)


# What controllers read of momentum, energy and speeds that are not the robot's own.
#
# Momentum p = M qd is the torque that accelerations qd ask of a robot at rest without gravity, so
# the recursions of the torque give it. With T = qd^T M qd/2, dT/dq = C^T qd and
#
#     tau = M qdd + C qd + g + f = dp/dt - C^T qd + g + f,
#     tau . qd = d/dt (T + U) + f . qd.


_HALF = Fraction(1, 2)


def derive_coriolis_matrix(
    model: SymbolicModel, parameters: Mapping[int, Expr]
) -> list[list[Expr]]:
    """Returns C(q, qd) of the free variables by Christoffel symbols: dM/dt = C + C^T.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    qd, zero = model.get_inputs("qd"), model.graph.constant(0)
    motions = model.derive_link_motions(qd, [zero] * len(qd), gravity=False)
    rows = model.collect_link_parameters(parameters)
    tree = compute_coriolis_matrix(
        model.geometry, model.frames, motions, model.expand_to_rows(qd), rows, zero
    )
    half = [model.reduce_to_free(line) for line in zip(*tree, strict=True)]
    return [model.reduce_to_free([line[i] for line in half]) for i in range(len(qd))]


def _propagate_twists(model: SymbolicModel) -> list[Motion]:
    """Motions whose accelerations are the speeds: wd and vd are the twists of the links."""
    still = [model.graph.constant(0)] * model.geometry.coordinate_count
    with model.relabel_speeds():
        return model.derive_link_motions(still, model.get_inputs("qd"), gravity=False)


def derive_momentum(model: SymbolicModel, parameters: Mapping[int, Expr]) -> list[Expr]:
    """Returns M(q) qd along the free variables, rotor inertias included.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    rows, zero = model.collect_link_parameters(parameters), model.graph.constant(0)
    moved, qd = _propagate_twists(model), model.get_inputs("qd")
    with model.relabel_speeds():
        momenta = compute_inverse_dynamics(model.geometry, model.frames, moved, rows, zero)
    momenta = model.reduce_to_free(momenta)
    for i, j, value in model.enumerate_rotor_inertias(parameters):
        momenta[i] = momenta[i] + value * qd[j]
    return momenta


def derive_coriolis_transpose(model: SymbolicModel, parameters: Mapping[int, Expr]) -> list[Expr]:
    """Returns C(q, qd)^T qd along the free variables, which is dT/dq.

    Args:
        model: as derived.
        parameters: {column: value}; the others are 0.
    """
    rows, zero = model.collect_link_parameters(parameters), model.graph.constant(0)
    moved = _propagate_twists(model)
    row_torques = [zero] * model.geometry.joint_count
    with model.relabel_speeds():
        momenta = list(
            accumulate_wrenches(
                model.geometry, model.frames, lambda k: compute_link_wrench(moved[k], rows[k], zero)
            )
        )
    for k, f, n in momenta:
        row = model.geometry.rows[k]
        if row.index is not None:
            row_torques[row.index] = project_wrench(_differentiate_twist(row, moved[k]), f, n)
    return model.reduce_to_free(row_torques)


def _differentiate_twist(row: GeometryRow, motion: Motion) -> Screw:
    """d w/d q and d v/d q of the row's link for its own joint: (w x z, v x z), or (0, w x z)."""
    w, v = (times(-row.rate, cross_z(x)) for x in (motion.wd, motion.vd))
    return Screw(w, v) if row.joint.is_revolute else Screw([0 * x for x in w], w)


def _differentiate_twists(
    geometry: Geometry, frames: Sequence[Pose], moved: Sequence[Motion]
) -> list[dict[int, Screw]]:
    """For every row, how the twist of its link changes with each joint that moves it."""
    twist_changes: list[dict[int, Screw]] = []
    for k, row in enumerate(geometry.rows):
        before = {} if row.parent is None else twist_changes[row.parent]
        carried = {}
        for index, s in before.items():
            e, pose = frames[k].rotate_to_link(s.e), frames[k]
            carried[index] = Screw(e, pose.rotate_to_link(plus(s.m, cross(s.e, pose.p))))
        if row.index is not None:
            carried[row.index] = _differentiate_twist(row, moved[k])
        twist_changes.append(carried)
    return twist_changes


def derive_slotine_li_regressor(model: SymbolicModel) -> Entries:
    """Returns Y of Y chi = M(q) a + C(q, qd) v + g(q) + f(v), over all standard columns.

    Slotine and Li 1987; by the recursion of Newton and Euler with two speeds. Friction takes v for
    qd, rotor inertia takes a.
    """
    qd, v, a = (model.get_inputs(kind) for kind in ("qd", "v", "a"))
    links = model.build_projection(model.derive_link_motions(qd, a, v=v))
    derive_effects = partial(derive_effect_entries, model, motion=("q", "v", "a"))
    return model.assemble_entries(links, derive_effects)


def derive_momentum_regressor(model: SymbolicModel) -> Entries:
    """Returns P of p = P chi, over all standard columns."""

    def build_shaft_entries(part: ShaftColumn) -> dict[int, Expr]:
        if part.kind != "rotor_inertia":
            return {}
        speed = combine_along_shaft(model, part.shaft, "qd")
        return {k: speed * coefficient for k, coefficient in part.shaft.items()}

    moved = _propagate_twists(model)
    with model.relabel_speeds():
        links = model.build_projection(moved)
    return model.assemble_entries(links, build_shaft_entries)


def derive_momentum_rest_regressor(model: SymbolicModel) -> Entries:
    """Returns R of tau = d/dt (P chi) + R chi: gravity and friction less dT/dq."""
    zero = model.graph.constant(0)
    still, moved = [zero] * model.geometry.coordinate_count, _propagate_twists(model)
    gravity = model.build_projection(model.derive_link_motions(still, still))
    momenta = [compute_wrench_columns(motion) for motion in moved]
    changes = _differentiate_twists(model.geometry, model.frames, moved)

    def build_link_entries(part: LinkColumn) -> dict[int, Expr]:
        f, n = momenta[part.row][part.prefix]
        rows = [zero] * model.geometry.joint_count
        for index, change in changes[part.row].items():
            rows[index] = project_wrench(change, f, n)
        weight = gravity(part)
        return {k: weight.get(k, zero) - x for k, x in enumerate(model.reduce_to_free(rows))}

    return model.assemble_entries(build_link_entries, partial(_derive_losses, model))


def _derive_losses(model: SymbolicModel, part: ShaftColumn) -> dict[int, Expr]:
    return {} if part.kind == "rotor_inertia" else derive_effect_entries(model, part)


def derive_energy_regressor(model: SymbolicModel) -> Entries:
    """Returns h of T + U = h chi, one row; the energy is 0 at height 0 of frame 0."""
    geometry, algebra = model.geometry, model.algebra
    moved, down = _propagate_twists(model), compute_frame_gravity(geometry, model.frames, algebra)
    momenta = [compute_wrench_columns(motion) for motion in moved]
    base = [algebra.static(entry) for entry in geometry.gravity]
    heights: list[Expr] = []  # -g . p of the frames' origins
    for row, frame in zip(geometry.rows, model.frames, strict=True):
        below = base if row.parent is None else down[row.parent]
        before = model.graph.constant(0) if row.parent is None else heights[row.parent]
        heights.append(before - dot(below, frame.p))

    def build_link_entries(part: LinkColumn) -> dict[int, Expr]:
        twist = Screw(moved[part.row].wd, moved[part.row].vd)
        kinetic = project_wrench(twist, *momenta[part.row][part.prefix]) * _HALF
        weight: Vector = down[part.row]
        potential = dict(zip(("MX", "MY", "MZ"), (-x for x in weight), strict=True))
        potential["M"] = heights[part.row]
        return {0: kinetic + potential.get(part.prefix, 0)}

    def build_shaft_entries(part: ShaftColumn) -> dict[int, Expr]:
        if part.kind != "rotor_inertia":
            return {}
        speed = combine_along_shaft(model, part.shaft, "qd")
        return {0: speed * speed * _HALF}

    return model.assemble_entries(build_link_entries, build_shaft_entries)


def derive_power_regressor(model: SymbolicModel) -> Entries:
    """Returns the row d of tau . qd = d/dt (h chi) + d chi: power of friction and offsets."""
    qd, zero = model.get_inputs("qd"), model.graph.constant(0)

    def build_shaft_entries(part: ShaftColumn) -> dict[int, Expr]:
        return {0: sum((qd[k] * x for k, x in _derive_losses(model, part).items()), zero)}

    return model.assemble_entries(lambda part: {}, build_shaft_entries)


# How frames that controllers steer stand and move: pose, Jacobian, its rate, twist.
#
# A frame is that of a row of the table, a link of `[frames]`, or the tool. Linear before angular:
# rows 0 to 2 belong to the velocity of the frame's origin, 3 to 5 to its angular velocity.


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
    row = frame.row
    at = compute_relative_poses(model.geometry, model.frames, model.algebra, None, {row})[row]
    axes = [_rotate_vector(at, axis) for axis in frame.axes]
    origin = plus(at[1], _rotate_vector(at, frame.origin))
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
