"""The deriving half of the chain: a robot, its model, its base parameters, its C."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path

from modeler.base import BaseParameters, base_parameters
from modeler.codegen import emit, write_emitted
from modeler.core.contract import Emitted, FittedSpec
from modeler.robot import Robot, read_robot
from modeler.symbolic import SymbolicModel, derive_model


@dataclass(frozen=True)
class Derivation:
    """A robot, its symbolic model and its base parameters."""

    robot: Robot
    model: SymbolicModel
    base: BaseParameters


def load(robot: str | Path) -> Robot:
    """The robot of that file, or the built-in robot of that name."""
    return read_robot(robot)


def derive(robot: Robot) -> Derivation:
    """The symbolic model and the base parameters with their proof."""
    model = derive_model(robot)
    return Derivation(robot, model, base_parameters(model))


def generate(
    derivation: Derivation,
    folder: str | Path | None = None,
    force: bool = False,
    fitted: FittedSpec | None = None,
) -> Emitted:
    """The C module; written to `folder` if one is given.

    Args:
        derivation: of the robot.
        folder: made if it is not there.
        force: write also over files that no earlier run wrote, or that were edited since.
        fitted: values of its base parameters; functions that have them are added.

    Raises:
        ModelerError: the folder holds files of these names that no earlier `generate` wrote, or
            that were edited since, and `force` is not given; or it cannot be written.
    """
    emitted = emit(derivation.model, derivation.base, fitted)
    emitted = dataclasses.replace(emitted, log=derivation.robot.log)
    if folder is not None:
        write_emitted(emitted, Path(folder), force)
    return emitted
