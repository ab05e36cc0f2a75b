"""Energy of a robot with relations or loops, summed over its bodies."""

import dataclasses

import casadi as ca

from modeler.robot.read import read_robot
from modeler.robot.robot import INERTIAL
from modeler.simulation.closing import sampled
from modeler.simulation.rigid import body_from_standard, gravity_vector, world_frames


def without_effects(name):
    """The robot with rotor inertias only, so that no energy is lost."""
    source = read_robot(name)
    kept = tuple(use for use in source.effects if use.effect == "rotor_inertia")
    return dataclasses.replace(source, effects=kept)


def energies(source, parameters, v, vd):
    """(n,) T + U summed over the bodies, of positions and speeds of all joints of the tree."""
    x, xd = (ca.SX.sym(n, v.shape[1]) for n in ("x", "xd"))
    total, gravity = ca.SX(0), ca.SX(gravity_vector(source))
    frames = world_frames(source, x)
    for k, joint in enumerate(source.moving):
        ten = {p: parameters.standard.get(p + joint.name, 0.0) for p in INERTIAL}
        body, frame = body_from_standard(ten), frames[joint.name]
        centre = frame.position + frame.rotation @ body.centre
        velocity = ca.jtimes(centre, x, xd)
        turning = ca.reshape(ca.jtimes(ca.vec(frame.rotation), x, xd), 3, 3)
        spin = ca.inv_skew(frame.rotation.T @ turning)
        total += body.mass * (ca.dot(velocity, velocity) / 2 - ca.dot(gravity, centre))
        total += ca.dot(spin, ca.SX(body.inertia) @ spin) / 2
        total += parameters.standard.get(f"Ia{joint.name}", 0.0) * xd[k] ** 2 / 2
    return sampled(ca.Function("energy", [x, xd], [ca.densify(total)]), v, vd)[:, 0, 0]
