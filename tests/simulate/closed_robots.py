"""Robots with loops for the simulator's tests, and the energy of any robot by the oracle."""

import dataclasses

from modeler.robot.robot import Robot
from tests.oracles.complex_step import Oracle
from tests.robots import LOOPED, TIED, kinds_first, one_always

LOOPS = one_always(LOOPED, "five-bar")
RELATIONS = kinds_first([name for name in TIED if name not in LOOPED])


def without_effects(source: Robot) -> Robot:
    """The robot with rotor inertias only, so that no energy is lost."""
    rest = tuple(use for use in source.effects if use.effect == "rotor_inertia")
    return dataclasses.replace(source, effects=rest)


def energies(source, parameters, v, vd):
    """(n,) T + U, of positions and speeds (n, moving) of all joints of the tree."""
    names = [joint.name for joint in source.moving_joints]
    free = [names.index(joint.name) for joint in source.free_joints]
    return Oracle(source, parameters.standard).energies(v[:, free], vd[:, free])
