"""Rigid links in the world frame: Newton and Euler about each mass centre.

Nothing here is written in link frames or at frame origins, and no regressor is formed: an error of
the modeling stages cannot repeat itself in the simulated measurements.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.robot import INERTIAL, Robot
from modeler.simulation.portable_math import compute_sine_and_cosine
from modeler.simulation.thresholds import THRESHOLDS

# Where the links are: frames of a modified Denavit-Hartenberg table in the world frame.


_SAME = {name: getattr(ca, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "sign", "tanh")}
FUNCTIONS = {**_SAME, "abs": ca.fabs}


@dataclass(frozen=True)
class Frame:
    """Frame j seen from the world (frame 0).

    Attributes:
        rotation: (3, 3), columns are the axes of frame j; a joint moves about or along column 2.
        position: (3, 1) origin of frame j, m.
        axis: (3, 1) turn or shift per unit of the joint variable: column 2, or its opposite where
            the table says -q; zeros where nothing moves.
    """

    rotation: ca.SX
    position: ca.SX
    axis: ca.SX


BASE = "0"
"""Name of the frame that stands still."""


def compute_world_frames(robot: Robot, q: ca.SX) -> dict[str, Frame]:
    """Returns every frame of the table by row name, and frame "0", in table order.

    0_T_j = 0_T_a Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r) (Khalil and Kleinfinger 1986).

    Args:
        robot: its table.
        q: (joints, 1) joint variables in the order of `robot.moving`.
    """
    symbols = robot.evaluate_symbols()
    variables = {joint.name: q[i] for i, joint in enumerate(robot.moving_joints)}
    frames = {BASE: Frame(ca.SX(np.eye(3)), ca.SX(np.zeros((3, 1))), ca.SX.zeros(3))}
    for joint in robot.joints:
        before, variable = frames[joint.antecedent], variables.get(joint.name)
        row_values = {**symbols, joint.variable: variable}
        gamma, b, alpha, d, theta, r = (
            cell.fold(row_values, FUNCTIONS, float(np.pi), float)
            if joint.variable in cell.names
            else cell.evaluate(symbols)
            for cell in (joint.gamma, joint.b, joint.alpha, joint.d, joint.theta, joint.r)
        )
        swing = before.rotation @ _compute_rotation(gamma, about="z")
        tilt = swing @ _compute_rotation(alpha, about="x")
        rotation = tilt @ _compute_rotation(theta, about="z")
        position = before.position + swing[:, 2] * b + tilt[:, 0] * d + rotation[:, 2] * r
        rate = ca.SX(0) if variable is None else ca.jacobian(ca.SX(theta + r), variable)
        frames[joint.name] = Frame(rotation, position, rotation[:, 2] * rate)
    return frames


def compute_gravity_vector(robot: Robot) -> np.ndarray:
    """Returns (3,) acceleration of gravity in the world frame, m/s2."""
    symbols = robot.evaluate_symbols()
    return np.array([component.evaluate(symbols) for component in robot.gravity])


def _compute_rotation(angle: ca.SX | float, about: str) -> ca.SX:
    if isinstance(angle, ca.SX):
        c, s = ca.cos(angle), ca.sin(angle)
    else:  # cos(pi/2) is 6e-17 in floating point; an exact 0 keeps the expressions small
        values = map(float, compute_sine_and_cosine(angle))
        s, c = (ca.SX(x if abs(x) > 1e-15 else 0.0) for x in values)
    if about == "z":
        return ca.vertcat(ca.horzcat(c, -s, 0), ca.horzcat(s, c, 0), ca.horzcat(0, 0, 1))
    return ca.vertcat(ca.horzcat(1, 0, 0), ca.horzcat(0, c, -s), ca.horzcat(0, s, c))


# A rigid link as a workshop describes it: mass, mass centre, inertia about the mass centre.


@dataclass(frozen=True, eq=False)
class Body:
    """One moving link, in the axes of its frame j.

    Attributes:
        mass: [kg].
        centre: (3,) mass centre in frame j, m.
        inertia: (3, 3) inertia matrix about the mass centre, kg m2; off-diagonal elements are
            minus the products of inertia.
    """

    mass: float
    centre: np.ndarray
    inertia: np.ndarray


_PLACE = {"XX": (0, 0), "XY": (0, 1), "XZ": (0, 2), "YY": (1, 1), "YZ": (1, 2), "ZZ": (2, 2)}


def compute_body(values: Mapping[str, float]) -> Body:
    """Returns the body whose ten standard parameters (keys of `INERTIAL`) are `values`.

    J_centre = J_origin - M (c.c 1 - c c'), c = (MX, MY, MZ) / M (Huygens and Steiner).
    """
    mass = values["M"]
    moment = np.array([values["MX"], values["MY"], values["MZ"]])
    centre = moment / mass if mass else np.zeros(3)
    return Body(
        mass, centre, _build_origin_inertia(values) - mass * _compute_parallel_axis_term(centre)
    )


def compute_standard_parameters(body: Body) -> dict[str, float]:
    """Returns the ten standard parameters at the origin of frame j, in the order of `INERTIAL`."""
    origin = body.inertia + body.mass * _compute_parallel_axis_term(body.centre)
    return _build_standard_parameters(origin, body.mass * body.centre, body.mass)


def compute_pseudo_inertia(values: Mapping[str, float]) -> np.ndarray:
    """Computes (4, 4) [[int x x' dm, int x dm], [., M]], at the frame's origin.

    A set of ten parameters is that of some distribution of mass if and only if this matrix is
    positive semi-definite (Wensing, Kim and Slotine 2018, IEEE RA-L 3(1)).
    """
    origin = _build_origin_inertia(values)
    matrix = np.empty((4, 4))
    matrix[:3, :3] = np.trace(origin) / 2 * np.eye(3) - origin
    matrix[:3, 3] = matrix[3, :3] = [values["MX"], values["MY"], values["MZ"]]
    matrix[3, 3] = values["M"]
    return matrix


def convert_pseudo_inertia(matrix: np.ndarray) -> dict[str, float]:
    """Returns inverse of `compute_pseudo_inertia`."""
    second = matrix[:3, :3]
    return _build_standard_parameters(
        np.trace(second) * np.eye(3) - second, matrix[:3, 3], matrix[3, 3]
    )


def is_physical(values: Mapping[str, float], tolerance: float = 1e-9) -> bool:
    """Returns True if some distribution of mass has these parameters; rods and plates too."""
    matrix = compute_pseudo_inertia(values)
    # A plate of which XX = YY + ZZ holds but for rounding is one.
    matrix[:3, :3] += THRESHOLDS.max_inertia_rounding * abs(np.trace(matrix[:3, :3])) * np.eye(3)
    # Rows scaled to ones on the diagonal: kilograms and kilogram square metres become comparable.
    diagonal = np.diag(matrix)
    if np.any(diagonal < 0):
        return False
    scale = np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
    return bool(np.linalg.eigvalsh(matrix / np.outer(scale, scale))[0] >= -tolerance)


def _build_origin_inertia(values: Mapping[str, float]) -> np.ndarray:
    origin = np.zeros((3, 3))
    for name, (row, column) in _PLACE.items():
        origin[row, column] = origin[column, row] = values[name]
    return origin


def _build_standard_parameters(
    origin: np.ndarray, moment: np.ndarray, mass: float
) -> dict[str, float]:
    values = {name: float(origin[place]) for name, place in _PLACE.items()}
    values |= dict(zip(("MX", "MY", "MZ"), map(float, moment), strict=True)) | {"M": float(mass)}
    return {name: values[name] for name in INERTIAL}


def _compute_parallel_axis_term(centre: np.ndarray) -> np.ndarray:
    return float(np.sum(centre * centre)) * np.eye(3) - np.outer(centre, centre)


@dataclass(frozen=True)
class RigidDynamics:
    """M(q) qdd + h(q, qd) = tau of the links alone, as CasADi expressions.

    Attributes:
        q, qd: (joints, 1) symbols, rad or m and their rates.
        inertia: (joints, joints) M.
        bias: (joints, 1) h = Coriolis, centrifugal and gravity torques, N m or N.

    """

    q: ca.SX
    qd: ca.SX
    inertia: ca.SX
    bias: ca.SX


@dataclass(frozen=True)
class _Motion:
    """Angular velocity, angular acceleration, acceleration of the frame's origin; (3, 1) each."""

    spin: ca.SX
    spin_rate: ca.SX
    acceleration: ca.SX


def build_rigid_dynamics(robot: Robot, bodies: Mapping[str, Body]) -> RigidDynamics:
    """Returns equations of motion of a serial or tree robot.

    Args:
        robot: geometry, gravity.
        bodies: mass, mass centre and inertia of each moving link, by joint name.
    """
    n = len(robot.moving_joints)
    q, qd, qdd = (ca.SX.sym(name, n) for name in ("q", "qd", "qdd"))
    frames = compute_world_frames(robot, q)
    motions = _compute_motions(robot, frames, qd, qdd)
    torque = _compute_joint_torques(robot, frames, motions, bodies)
    bias = ca.substitute(torque, qdd, ca.SX.zeros(n))
    return RigidDynamics(q, qd, ca.jacobian(torque, qdd), bias)


def reduce_dynamics(links: RigidDynamics, turns: np.ndarray, offset: np.ndarray) -> RigidDynamics:
    """Returns the dynamics in fewer coordinates u, of all joints q = turns u + offset.

    M_u = turns^T M turns, h_u = turns^T h (the principle of virtual work).
    """
    F = ca.SX(turns)
    u, ud = (ca.SX.sym(name, turns.shape[1]) for name in ("u", "ud"))
    tree, tied = [links.inertia, links.bias], [F @ u + offset, F @ ud]
    inertia, bias = ca.substitute(tree, [links.q, links.qd], tied)
    return RigidDynamics(u, ud, F.T @ inertia @ F, F.T @ bias)


def _compute_motions(
    robot: Robot, frames: Mapping[str, Frame], qd: ca.SX, qdd: ca.SX
) -> dict[str, _Motion]:
    """From the base outwards; a sliding joint sees the Coriolis acceleration of its antecedent."""
    zero = ca.SX.zeros(3)
    motions = {BASE: _Motion(zero, zero, zero)}
    index = {joint.name: i for i, joint in enumerate(robot.moving_joints)}
    for joint in robot.joints:
        before, frame = motions[joint.antecedent], frames[joint.name]
        arm = frame.position - frames[joint.antecedent].position
        spin, spin_rate = before.spin, before.spin_rate
        acceleration = before.acceleration + ca.cross(spin_rate, arm)
        acceleration += ca.cross(spin, ca.cross(spin, arm))
        if joint.is_moving:
            axis, i = frame.axis, index[joint.name]
            if joint.is_revolute:
                spin_rate = spin_rate + axis * qdd[i] + ca.cross(spin, axis * qd[i])
                spin = spin + axis * qd[i]
            else:
                acceleration += axis * qdd[i] + 2 * ca.cross(spin, axis * qd[i])
        motions[joint.name] = _Motion(spin, spin_rate, acceleration)
    return motions


def _compute_joint_torques(
    robot: Robot,
    frames: Mapping[str, Frame],
    motions: Mapping[str, _Motion],
    bodies: Mapping[str, Body],
) -> ca.SX:
    """From the tips inwards: what each joint must carry, projected on its axis."""
    gravity = ca.SX(compute_gravity_vector(robot))
    force = {name: ca.SX.zeros(3) for name in frames}
    moment = {name: ca.SX.zeros(3) for name in frames}  # about the frame's own origin
    torques = {}
    for joint in reversed(robot.joints):
        name, frame, motion = joint.name, frames[joint.name], motions[joint.name]
        if joint.is_moving:
            body, spin = bodies[name], motion.spin
            arm = frame.rotation @ body.centre
            acceleration = motion.acceleration + ca.cross(motion.spin_rate, arm)
            acceleration += ca.cross(spin, ca.cross(spin, arm))
            inertia = frame.rotation @ body.inertia @ frame.rotation.T
            push = body.mass * (acceleration - gravity)
            turn = inertia @ motion.spin_rate + ca.cross(spin, inertia @ spin)
            force[name] += push
            moment[name] += turn + ca.cross(arm, push)
            carried = moment[name] if joint.is_revolute else force[name]
            torques[name] = ca.dot(frame.axis, carried)
        lever = frame.position - frames[joint.antecedent].position
        force[joint.antecedent] += force[name]
        moment[joint.antecedent] += moment[name] + ca.cross(lever, force[name])
    return ca.vertcat(*(torques[joint.name] for joint in robot.moving_joints))
