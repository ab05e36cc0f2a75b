"""What a format cannot hold, and how much of the torque that is.

The parameters chi_e of an effect put K chi_e into beta, and W K chi_e into the torques of a motion.
Where the logs of the fit are at hand, its share is that of the root mean squares over their rows,
at its joint. Without them about what it was in the fit is told by beta and its covariance C, for
W^T W is C^-1 but for the noise: sqrt((K chi_e)^T C^-1 K chi_e / beta^T C^-1 beta), of all torques.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.table import format_percent
from modeler.exports.bodies import ExportParameters
from modeler.exports.completion import compute_distance
from modeler.exports.linkage import SAME_GRAVITY, compute_gravity

Torques = Callable[[np.ndarray], tuple[np.ndarray, tuple[str, ...]]]
"""From base parameters to the (rows, n) torques of the fit, and the names of their joints."""

_NOTHING = 1e-6  # of a torque: prints as 0 %
_USUAL = 9.81  # m/s2, of programs that are told no gravity


@dataclass(frozen=True)
class LostEffect(ShortRepr):
    """An effect of a joint that the format has no place for.

    Attributes:
        effect: id; "" of a parameter of no effect.
        joint: row; "" of gravity.
        values: by name, SI.
        share: of the torque; None of a robot, or where it is not told.
        of: "joint 2", or "all torques" of shares that C tells.
    """

    effect: str
    joint: str
    values: dict[str, float]
    share: float | None = None
    of: str = ""

    @property
    def summary_line(self) -> str:
        """For people."""
        values = ", ".join(f"{name} = {value:.4g}" for name, value in self.values.items())
        share_text = (
            "" if self.share is None else f", about {format_percent(self.share, 2)} of {self.of}"
        )
        where = f" of joint {self.joint}" if self.joint else ""
        return f"{self.effect or 'parameter'}{where} ({values}){share_text}"


def find_lost_effects(
    physics: ExportParameters, to: str, torques: Torques | None = None
) -> tuple[LostEffect, ...]:
    """Effects that the format cannot hold, those that carry most first; none that carries nothing.

    URDF and SDF models hold the direction of gravity alone, and programs take 9.81 m/s2.

    Args:
        physics: all numbers.
        to: the format.
        torques: of the logs of the fit, if they are there.
    """
    robot, lost_effects = physics.robot, list[LostEffect]()
    g = float(np.linalg.norm(compute_gravity(robot)))
    if to != "mjcf" and abs(g - _USUAL) > SAME_GRAVITY * _USUAL:
        lost_effects.append(LostEffect("size of gravity", "", {"g": g}))
    stated_names = {
        name
        for joint in robot.moving_joints
        for terms in physics.collect_drive_terms(joint.name, to).values()
        for name in terms
    }
    for joint in robot.moving_joints:
        for effect, form, instance in robot.find_joint_effects(joint.name):
            names = [f"{column.prefix}{joint.name}{instance.label}" for column in form.columns]
            values = {n: float(physics.completion.chi[physics.indices[n]]) for n in names
                      if n in physics.indices and n not in stated_names}  # fmt: skip
            if any(values.values()):
                share, of = _compute_torque_share(physics, list(values), joint.name, torques)
                if share is None or share >= _NOTHING:
                    lost_effects.append(LostEffect(effect.id, joint.name, values, share, of))
    return tuple(sorted(lost_effects, key=lambda one: -(one.share or float(not one.joint))))


def _compute_torque_share(
    physics: ExportParameters, names: list[str], joint: str, torques: Torques | None
) -> tuple[float | None, str]:
    if physics.fit is None:
        return None, ""
    at = [physics.indices[name] for name in names]
    contribution = physics.machine.K[:, at] @ physics.completion.chi[at]
    beta, C = physics.fit
    if torques is None:
        whole = compute_distance(beta, C)
        return (compute_distance(contribution, C) / whole if whole else None), "all torques"
    part, joints = torques(contribution)
    total_torques, _ = torques(beta)
    place, of = [*range(len(joints))], "all torques"
    if joint in joints:
        place, of = [joints.index(joint)], f"the torque of joint {joint}"
    size = float(np.linalg.norm(total_torques[:, place]))
    return (float(np.linalg.norm(part[:, place])) / size if size else None), of
