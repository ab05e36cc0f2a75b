"""A robot or a model as a file for another program."""

import dataclasses
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.estimation import IdentifiedModel
from modeler.exports.bodies import Original, physics_of, written
from modeler.exports.fresh import LINK, fresh, gravity_of, joint_names
from modeler.exports.held import Torques, not_held
from modeler.exports.like import rewritten
from modeler.exports.original import original_of, placed, source_of
from modeler.exports.result import Exported, Value, body_values, drive_values, with_comment
from modeler.robot import Robot, robot_from_text

ENDINGS = {".urdf": "urdf", ".xml": "mjcf", ".mjcf": "mjcf", ".sdf": "sdf"}
"""Formats by the ending of a file."""


def format_of(to: str | None, like: str, out: str) -> str:
    """The format that is meant; "" where the original says it.

    Raises:
        DataError: nothing says it.
    """
    if to is not None or like:
        return to or ""
    ending = Path(out).suffix.lower()
    if ending not in ENDINGS:
        raise DataError(
            f"export: {out or 'nothing'} does not say the format; give --to urdf, mjcf or sdf, or "
            f"an ending {', '.join(ENDINGS)}"
        )
    return ENDINGS[ending]


def exported(
    thing: Robot | IdentifiedModel,
    to: str = "",
    like: Path | None = None,
    torques: Torques | None = None,
) -> Exported:
    """The file, and what it holds.

    Args:
        thing: a robot with values, or a model.
        to: "urdf", "mjcf", "sdf"; "" for that of the original.
        like: the original whose numbers are replaced; None for a file of its own.
        torques: of the logs of the fit, see `held`.

    Raises:
        DataError: no values, another robot, or what the format cannot state.
        RobotError: a mistake in the original.
    """
    robot = thing
    if isinstance(thing, IdentifiedModel):
        robot = robot_from_text(thing.robot_text, f"model of {thing.spec.robot}, robot_text")
    assert isinstance(robot, Robot)
    if like is None:
        physics = physics_of(thing, Original())
        notes, data, values = list(physics.notes), fresh(physics, to), list[Value]()
        g = float(np.linalg.norm(gravity_of(physics)))
        if to != "mjcf" and abs(g - 9.81) > 0.02:
            notes.append(f"gravity is {g:.4g} m/s2 here; {to.upper()} states none, most take 9.81")
        names = joint_names(robot)
        for joint in robot.moving:
            if physics.ten_places(joint.name):
                given = physics.stated_before(joint.name)
                was = None if given is None else written(given)
                values += body_values(physics, joint.name, LINK + joint.name, was)
            stated = {
                quantity: sum(c * physics.nominal[name] for name, c in terms.items())
                for quantity, terms in physics.drive(joint.name, to).items()
                if terms.keys() <= physics.nominal.keys()
            }
            values += drive_values(physics, joint, names[joint.name], to, stated)
    else:
        source = source_of(like)
        if to and to != source.format:
            raise DataError(
                f"--like {like}: is {source.format.upper()}, and --to says {to}; leave out one"
            )
        to = source.format
        links = placed(source, robot)
        physics = physics_of(thing, original_of(source, links))
        notes = list(physics.notes)
        data, values = rewritten(physics, source, links, notes)
    lost = not_held(physics, to, torques)
    name = "" if like is None else like.name
    found = Exported(
        robot.name, to, name, data, tuple(values), lost, physics.now.moved, tuple(notes)
    )
    if like is not None and data == source.data:
        return found
    return dataclasses.replace(found, data=with_comment(data, found))
