"""How large a torque on a joint of a robot with loops is for the motors, which carry them."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.core.errors import DataError
from modeler.robot import Limits, Robot
from modeler.simulate.closing import followed, motor_torques, rates
from modeler.simulate.constraints import Constraints, constraints_of, sampled
from modeler.simulate.parameters import PlantParameters
from modeler.simulate.plant import torque_function
from modeler.simulate.trajectory import exciting_reference

_DURATION, _RATE = 6.0, 50.0  # s and Hz of the motion that is looked at
_NARROWER = 3  # times, by half, where the loops do not close over the whole range
_TOP = 0.98


def felt_by_motors(
    robot: Robot, parameters: PlantParameters, limits: Sequence[Limits], joint: str, seed: int
) -> tuple[float, float]:
    """(torque, speed) of a joint that are large for the closed machine around it.

    The torque is the one that asks of some motor as much as its rms torque tau_m, and of none
    more: 1 / max_m(rms(G_m) / tau_m), with G_m = d speed / d speed of motor m; of a joint with a
    motor, its rms torque. The speed is the joint's 98 % quantile. Both along an exciting motion of
    the closed machine.

    Args:
        robot: with loops.
        parameters: of its links and effects.
        limits: in the order of `robot.moving`.
        joint: name of a row.
        seed: of the motion.

    Raises:
        RobotError: `home` does not close.
        DataError: the loops close on no such motion.
    """
    constraints = constraints_of(robot)
    v, qd, qdd = _motion(robot, constraints, limits, seed)
    vd, vdd = rates(constraints, v, qd, qdd)
    torque, states = torque_function(robot, parameters, tuple(limits))
    load = sampled(torque, v, vd, vdd, np.zeros((len(v), states)))[:, :, 0]
    needed = np.sqrt(np.mean(motor_torques(constraints, v, load) ** 2, axis=0))
    row = [moving.name for moving in robot.moving].index(joint)
    shares = []
    for m, torque_m in enumerate(needed):
        moved = np.zeros_like(qd)
        moved[:, m] = 1.0
        slope = rates(constraints, v, moved, np.zeros_like(qd))[0][:, row]
        if torque_m > 0.0:
            shares.append(float(np.sqrt(np.mean(slope**2))) / torque_m)
    speed = float(np.quantile(np.abs(vd[:, row]), _TOP))
    return (1.0 / max(shares) if any(shares) else 1.0), speed or limits[row].speed


def _motion(
    robot: Robot, constraints: Constraints, limits: Sequence[Limits], seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Closed postures, speeds and accelerations of the motors: in the limits, or nearer home."""
    names = [joint.name for joint in robot.moving]
    own = [limits[names.index(joint.name)] for joint in robot.coordinates]
    home = [robot.home.get(joint.name, 0.0) for joint in robot.coordinates]
    for narrower in range(_NARROWER + 1):
        near = tuple(_narrowed(li, at, 0.5**narrower) for li, at in zip(own, home, strict=True))
        motion = exciting_reference(near, _DURATION, _RATE, seed)
        try:
            return followed(robot, constraints, motion.q), motion.qd, motion.qdd
        except DataError:
            if narrower == _NARROWER:
                raise
    raise AssertionError("unreachable")


def _narrowed(limits: Limits, home: float, share: float) -> Limits:
    """The same share of the way from home to both limits."""
    middle = min(max(home, limits.lower), limits.upper)
    return dataclasses.replace(
        limits,
        lower=middle + share * (limits.lower - middle),
        upper=middle + share * (limits.upper - middle),
    )
