"""Rigid links in the world frame: Newton and Euler about each mass centre.

Nothing here is written in link frames or at frame origins, and no regressor is formed: an error of
the modeling stages cannot repeat itself in the simulated measurements.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.robot import Robot
from modeler.simulate.body import Body
from modeler.simulate.geometry import BASE, Frame, gravity_vector, world_frames


@dataclass(frozen=True)
class RigidDynamics:
    """M(q) qdd + h(q, qd) = tau of the links alone, as CasADi expressions.

    Attributes:
        q, qd: (joints, 1) symbols, rad or m and their rates.
        inertia: (joints, joints) M.
        bias: (joints, 1) h = Coriolis, centrifugal and gravity torques, N m or N.
        kinetic: T, J. From velocities by differentiation of positions, not from `inertia`.
        potential: U of gravity, J; 0 with all mass centres at the world's origin.
    """

    q: ca.SX
    qd: ca.SX
    inertia: ca.SX
    bias: ca.SX
    kinetic: ca.SX
    potential: ca.SX


@dataclass(frozen=True)
class _Motion:
    """Angular velocity, angular acceleration, acceleration of the frame's origin; (3, 1) each."""

    spin: ca.SX
    spin_rate: ca.SX
    acceleration: ca.SX


def rigid_dynamics(robot: Robot, bodies: Mapping[str, Body]) -> RigidDynamics:
    """Equations of motion of a serial or tree robot.

    Args:
        robot: geometry, gravity.
        bodies: mass, mass centre and inertia of each moving link, by joint name.
    """
    n = len(robot.moving)
    q, qd, qdd = (ca.SX.sym(name, n) for name in ("q", "qd", "qdd"))
    frames = world_frames(robot, q)
    motions = _motions(robot, frames, qd, qdd)
    torque = _joint_torques(robot, frames, motions, bodies)
    kinetic, potential = _energies(robot, frames, bodies, q, qd)
    return RigidDynamics(
        q=q,
        qd=qd,
        inertia=ca.jacobian(torque, qdd),
        bias=ca.substitute(torque, qdd, ca.SX.zeros(n)),
        kinetic=kinetic,
        potential=potential,
    )


def tied_dynamics(links: RigidDynamics, turns: np.ndarray, offset: np.ndarray) -> RigidDynamics:
    """The same in fewer coordinates u of which all joints follow: q = turns u + offset.

    M_u = turns^T M turns, h_u = turns^T h (the principle of virtual work).
    """
    F = ca.SX(turns)
    u, ud = (ca.SX.sym(name, turns.shape[1]) for name in ("u", "ud"))
    tree = [links.inertia, links.bias, links.kinetic, links.potential]
    inertia, bias, kinetic, potential = ca.substitute(
        tree, [links.q, links.qd], [F @ u + offset, F @ ud]
    )
    return RigidDynamics(u, ud, F.T @ inertia @ F, F.T @ bias, kinetic, potential)


def _motions(
    robot: Robot, frames: Mapping[str, Frame], qd: ca.SX, qdd: ca.SX
) -> dict[str, _Motion]:
    """From the base outwards; a sliding joint sees the Coriolis acceleration of its antecedent."""
    zero = ca.SX.zeros(3)
    motions = {BASE: _Motion(zero, zero, zero)}
    index = {joint.name: i for i, joint in enumerate(robot.moving)}
    for joint in robot.joints:
        before, frame = motions[joint.antecedent], frames[joint.name]
        arm = frame.position - frames[joint.antecedent].position
        spin, spin_rate = before.spin, before.spin_rate
        acceleration = (
            before.acceleration + ca.cross(spin_rate, arm) + ca.cross(spin, ca.cross(spin, arm))
        )
        if joint.moves:
            axis, i = frame.axis, index[joint.name]
            if joint.angular:
                spin_rate = spin_rate + axis * qdd[i] + ca.cross(spin, axis * qd[i])
                spin = spin + axis * qd[i]
            else:
                acceleration += axis * qdd[i] + 2 * ca.cross(spin, axis * qd[i])
        motions[joint.name] = _Motion(spin, spin_rate, acceleration)
    return motions


def _joint_torques(
    robot: Robot,
    frames: Mapping[str, Frame],
    motions: Mapping[str, _Motion],
    bodies: Mapping[str, Body],
) -> ca.SX:
    """From the tips inwards: what each joint must carry, projected on its axis."""
    gravity = ca.SX(gravity_vector(robot))
    force = {name: ca.SX.zeros(3) for name in frames}
    moment = {name: ca.SX.zeros(3) for name in frames}  # about the frame's own origin
    torques = {}
    for joint in reversed(robot.joints):
        name, frame, motion = joint.name, frames[joint.name], motions[joint.name]
        if joint.moves:
            body, spin = bodies[name], motion.spin
            arm = frame.rotation @ body.centre
            centre_acceleration = (
                motion.acceleration
                + ca.cross(motion.spin_rate, arm)
                + ca.cross(spin, ca.cross(spin, arm))
            )
            inertia = frame.rotation @ body.inertia @ frame.rotation.T
            push = body.mass * (centre_acceleration - gravity)
            turn = inertia @ motion.spin_rate + ca.cross(spin, inertia @ spin)
            force[name] += push
            moment[name] += turn + ca.cross(arm, push)
            carried = moment[name] if joint.angular else force[name]
            torques[name] = ca.dot(frame.axis, carried)
        lever = frame.position - frames[joint.antecedent].position
        force[joint.antecedent] += force[name]
        moment[joint.antecedent] += moment[name] + ca.cross(lever, force[name])
    return ca.vertcat(*(torques[joint.name] for joint in robot.moving))


def _energies(
    robot: Robot, frames: Mapping[str, Frame], bodies: Mapping[str, Body], q: ca.SX, qd: ca.SX
) -> tuple[ca.SX, ca.SX]:
    gravity = ca.SX(gravity_vector(robot))
    kinetic = potential = ca.SX(0)
    for joint in robot.moving:
        frame, body = frames[joint.name], bodies[joint.name]
        centre = frame.position + frame.rotation @ body.centre
        velocity = ca.jtimes(centre, q, qd)
        turning = ca.reshape(ca.jtimes(ca.vec(frame.rotation), q, qd), 3, 3)
        spin = ca.inv_skew(frame.rotation.T @ turning)  # in frame j, where the inertia is constant
        kinetic += body.mass * ca.dot(velocity, velocity) / 2
        kinetic += ca.dot(spin, ca.SX(np.asarray(body.inertia)) @ spin) / 2
        potential -= body.mass * ca.dot(gravity, centre)
    return kinetic, potential
