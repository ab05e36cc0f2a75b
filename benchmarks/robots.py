"""The robots that are measured, with the same losses at every joint."""

import dataclasses
import functools

from modeler.codegen import derive, generate
from modeler.core.manifest import EmittedModule
from modeler.robot import EffectUse, Robot, read_robot
from modeler.runtime import CompiledModel, load_module

ROBOTS = ("wrist", "puma560", "panda")
EFFECTS = ("rotor_inertia", "viscous", "coulomb")


def with_losses(robot: Robot) -> Robot:
    """The robot with rotor inertia, viscous and Coulomb friction at every joint, nothing else."""
    names = tuple(joint.name for joint in robot.moving_joints)
    return dataclasses.replace(robot, effects=tuple(EffectUse(e, names) for e in EFFECTS))


@functools.cache
def lossy(name: str) -> Robot:
    """A built-in robot with these losses."""
    return with_losses(read_robot(name))


@functools.cache
def emitted(name: str) -> EmittedModule:
    """Its C."""
    return generate(derive(lossy(name)))


@functools.cache
def compiled(name: str) -> CompiledModel:
    """Its C, compiled."""
    module = emitted(name)
    return load_module(module.spec, module.files)
