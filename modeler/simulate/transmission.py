"""Transmissions that give way: motor and link as two bodies with a spring between them."""

from dataclasses import dataclass

import casadi as ca
import numpy as np

from modeler.robot import Robot
from modeler.simulate.hidden import HiddenEffect
from modeler.simulate.hidden_catalogue import HIDDEN

_FARTHEST = 0.3  # rad or m, that a link may be ahead of its motor at rest
_HALVINGS = 60
_SWEEPS = 4  # gravity couples what lies behind several transmissions, weakly


@dataclass(frozen=True)
class Transmissions:
    """Those of a robot that give way.

    Attributes:
        rows: places of their joints among the free ones.
        turns: (free joints, free joints + transmissions) F: positions of the links are F times
            those of the motors and, after these, how far the links are ahead of them.
        effects: of each.
    """

    rows: tuple[int, ...]
    turns: np.ndarray
    effects: tuple[HiddenEffect, ...]

    def torque(self, ahead: ca.SX, rate: ca.SX) -> ca.SX:
        """(transmissions, 1) torques that pull the links back to their motors, N m or N."""
        torques = [ca.SX(0, 1)]
        for i, effect in enumerate(self.effects):
            spring = HIDDEN[effect.effect].spring
            assert spring is not None
            torques.append(spring(ahead[i], rate[i], effect.values))
        return ca.vertcat(*torques)


def transmissions_of(robot: Robot, hidden: tuple[HiddenEffect, ...]) -> Transmissions:
    """The hidden effects that lie between motors and links."""
    names = [joint.name for joint in robot.free]
    effects = tuple(h for h in hidden if HIDDEN[h.effect].role == "transmission")
    rows = tuple(names.index(effect.joint) for effect in effects if effect.joint)
    unit = np.eye(len(names))
    return Transmissions(rows, np.hstack([unit, unit[:, rows]]), effects)


def settled(strain: ca.Function, q: np.ndarray, z: np.ndarray) -> np.ndarray:
    """(states,) inner states of a robot at rest: links sag until their springs carry them.

    Args:
        strain: (q, z) -> torque on each such link, rising with how far it is ahead.
        q: motor positions.
        z: (states,) of a robot whose links do not sag, those of the transmissions first.
    """
    z = z.copy()
    for _ in range(_SWEEPS if strain.size1_out(0) else 0):
        for i in range(strain.size1_out(0)):
            low, high = -_FARTHEST, _FARTHEST
            for _ in range(_HALVINGS):
                z[i] = (low + high) / 2
                pull = float(strain(q, z).full()[i, 0])
                low, high = (low, z[i]) if pull > 0 else (z[i], high)
    return z
