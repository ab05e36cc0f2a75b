"""How large a torque on a joint of a robot with loops is for the motors, which carry them."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from modeler.robot import Limits, Robot
from modeler.simulate.closed_motion import closed_motion
from modeler.simulate.closing import motor_torques, rates
from modeler.simulate.constraints import constraints_of, sampled
from modeler.simulate.parameters import PlantParameters
from modeler.simulate.plant import torque_function
from modeler.simulate.trajectory import Reference, exciting_reference

_DURATION, _RATE = 6.0, 50.0  # s and Hz of the motion that is looked at
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
    names = [moving.name for moving in robot.moving]
    own = tuple(limits[names.index(moving.name)] for moving in robot.coordinates)
    motion = closed_motion(robot, constraints, own, partial(_exciting, seed=seed))
    v, qd = motion.v, motion.reference.qd
    vd, vdd = rates(constraints, v, qd, motion.reference.qdd)
    torque, states = torque_function(robot, parameters, tuple(limits))
    load = sampled(torque, v, vd, vdd, np.zeros((len(v), states)))[:, :, 0]
    needed = np.sqrt(np.mean(motor_torques(constraints, v, load) ** 2, axis=0))
    row = names.index(joint)
    shares = []
    for m, torque_m in enumerate(needed):
        moved = np.zeros_like(qd)
        moved[:, m] = 1.0
        slope = rates(constraints, v, moved, np.zeros_like(qd))[0][:, row]
        if torque_m > 0.0:
            shares.append(float(np.sqrt(np.mean(slope**2))) / torque_m)
    speed = float(np.quantile(np.abs(vd[:, row]), _TOP))
    return (1.0 / max(shares) if any(shares) else 1.0), speed or limits[row].speed


def _exciting(limits: tuple[Limits, ...], seed: int) -> Reference:
    return exciting_reference(limits, _DURATION, _RATE, seed)
