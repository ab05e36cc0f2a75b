"""A robot or a model as a file for another program."""

import dataclasses
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.estimation import IdentifiedModel
from modeler.exports.bodies import (
    Equations,
    Original,
    Physics,
    physics_of,
    robot_of,
    symmetric,
    written,
)
from modeler.exports.fresh import LEAST, Names, fresh
from modeler.exports.held import Torques, not_held
from modeler.exports.like import rewritten
from modeler.exports.original import TENSOR, original_of, placed, source_of
from modeler.exports.result import Exported, Value, body_values, drive_values, sigmas, with_comment
from modeler.robot import Robot

ENDINGS = {
    ".urdf": "urdf", ".xml": "mjcf", ".mjcf": "mjcf", ".sdf": "sdf", ".casadi": "casadi",
    ".fmu": "fmu",
}  # fmt: skip
"""Formats by the ending of a file."""

FORMATS = ("urdf", "mjcf", "sdf", "casadi", "fmu", "simulink", "ros2")
"""All that --to may name."""


def format_of(to: str | None, like: str, out: str) -> str:
    """The format that is meant; "" where the original says it.

    Raises:
        DataError: nothing says it.
    """
    ending = Path(out).suffix.lower()
    if to is not None or like:  # .xml may be both
        return to or ("" if ending == ".xml" else ENDINGS.get(ending, ""))
    if ending not in ENDINGS:
        raise DataError(
            f"export: {out or 'nothing'} does not say the format; give --to {', '.join(FORMATS)}, "
            f"or an ending {', '.join(ENDINGS)}"
        )
    return ENDINGS[ending]


def exported(
    thing: Robot | IdentifiedModel,
    to: str = "",
    like: Path | None = None,
    torques: Torques | None = None,
    equations: Callable[[], Equations] | None = None,
) -> Exported:
    """The file, and what it holds.

    Args:
        thing: a robot with values, or a model.
        to: "urdf", "mjcf", "sdf"; "" for that of the original.
        like: the original whose numbers are replaced; None for a file of its own.
        torques: of the logs of the fit, see `held`.
        equations: of a robot, which are asked for where parameters of bodies are open.

    Raises:
        DataError: no values, another robot, or what the format cannot state.
        RobotError: a mistake in the original.
    """
    robot = robot_of(thing)
    if like is None:
        physics, notes = physics_of(thing, Original(), equations), list[str]()
        data, values = fresh(physics, to, notes), list(_values(physics, to))
    else:
        source = source_of(like)
        if to and to != source.format:
            raise DataError(
                f"--like {like}: is {source.format.upper()}, and --to or the ending of --out says "
                f"{to}; leave out --like for a file of another format"
            )
        to, there = source.format, placed(source, robot)
        physics, notes = physics_of(thing, original_of(there.links)), list(there.notes)
        data, values = rewritten(physics, source, there, notes)
    notes = [*physics.notes, *notes, *_too_small(values, to)]
    lost = not_held(physics, to, torques)
    name = "" if like is None else like.name
    found = Exported(
        robot.name, to, name, data, tuple(values), lost, physics.now.moved, tuple(notes)
    )
    if like is not None and data == source.data:
        return found
    return dataclasses.replace(found, data=with_comment(data, found))


def _values(physics: Physics, to: str) -> Iterator[Value]:
    """The numbers of a file of its own, and what the robot file says of them."""
    names = Names.of(physics.robot)
    for joint in physics.robot.moving:
        ten = physics.ten(joint.name)
        if ten is not None and ten[9]:
            given = physics.stated_before(joint.name)
            was = None if given is None else written(given)
            sigma = sigmas(physics, joint.name)
            yield from body_values(names.links[joint.name], was, written(ten), sigma)
        stated = {
            quantity: sum(c * physics.nominal[name] for name, c in terms.items())
            for quantity, terms in physics.drive(joint.name, to).items()
            if terms.keys() <= physics.nominal.keys()
        }
        yield from drive_values(physics, joint, names.joints[joint.name], to, stated)


def _too_small(values: Iterable[Value], to: str) -> Iterator[str]:
    """Tells of bodies that MuJoCo refuses."""
    bodies: dict[str, list[float]] = {}
    for value in values:
        if value.quantity in TENSOR:
            bodies.setdefault(value.part, []).append(value.now)
    small = [name for name, six in bodies.items()
             if 0.0 < np.linalg.eigvalsh(symmetric(np.array(six)))[0] < LEAST]  # fmt: skip
    if small and to != "sdf":
        yield (
            f"{', '.join(small)}: too small for MuJoCo, which takes no moment of inertia below "
            f"{LEAST:g} kg m2"
        )
