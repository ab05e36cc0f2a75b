"""A robot or a model as a file for another program."""

import dataclasses
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.estimation import IdentifiedModel
from modeler.exports.bodies import (
    Equations,
    ExportParameters,
    Original,
    build_export_parameters,
    build_symmetric_matrix,
    compute_central_parameters,
    get_robot,
)
from modeler.exports.fresh import LEAST, Names, format_new_file
from modeler.exports.held import Torques, find_lost_effects
from modeler.exports.like import rewrite_file
from modeler.exports.original import TENSOR, assign_links, collect_original, read_original
from modeler.exports.result import (
    Exported,
    Value,
    build_body_values,
    build_drive_values,
    compute_sigmas,
    insert_comment,
)
from modeler.robot import Robot

ENDINGS = {
    ".urdf": "urdf", ".xml": "mjcf", ".mjcf": "mjcf", ".sdf": "sdf", ".casadi": "casadi",
    ".fmu": "fmu",
}  # fmt: skip
"""Formats by the ending of a file."""

FORMATS = ("urdf", "mjcf", "sdf", "casadi", "fmu", "simulink", "ros2")
"""All that --to may name."""


def choose_format(to: str | None, like: str, out: str) -> str:
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


def export_robot(
    robot_or_model: Robot | IdentifiedModel,
    to: str = "",
    like: Path | None = None,
    torques: Torques | None = None,
    equations: Callable[[], Equations] | None = None,
) -> Exported:
    """The file, and what it holds.

    Args:
        robot_or_model: a robot with values, or a model.
        to: "urdf", "mjcf", "sdf"; "" for that of the original.
        like: the original whose numbers are replaced; None for a file of its own.
        torques: of the logs of the fit, see `held`.
        equations: of a robot, which are asked for where parameters of bodies are open.

    Raises:
        DataError: no values, another robot, or what the format cannot state.
        RobotError: a mistake in the original.
    """
    robot = get_robot(robot_or_model)
    if like is None:
        physics, notes = build_export_parameters(robot_or_model, Original(), equations), list[str]()
        data, values = format_new_file(physics, to, notes), list(_build_values(physics, to))
    else:
        source = read_original(like)
        if to and to != source.format:
            raise DataError(
                f"--like {like}: is {source.format.upper()}, and --to or the ending of --out says "
                f"{to}; leave out --like for a file of another format"
            )
        to, placement = source.format, assign_links(source, robot)
        physics, notes = (
            build_export_parameters(robot_or_model, collect_original(placement.links)),
            list(placement.notes),
        )
        data, values = rewrite_file(physics, source, placement, notes)
    notes = [*physics.notes, *notes, *_find_too_small(values, to)]
    lost = find_lost_effects(physics, to, torques)
    name = "" if like is None else like.name
    exported = Exported(
        robot.name,
        to,
        name,
        data,
        tuple(values),
        lost,
        physics.completion.shift_in_sigmas,
        tuple(notes),
    )
    if like is not None and data == source.data:
        return exported
    return dataclasses.replace(exported, data=insert_comment(data, exported))


def _build_values(physics: ExportParameters, to: str) -> Iterator[Value]:
    """The numbers of a file of its own, and what the robot file says of them."""
    names = Names.choose_names(physics.robot)
    for joint in physics.robot.moving_joints:
        ten = physics.get_link_parameters(joint.name)
        if ten is not None and ten[9]:
            nominal = physics.get_nominal_parameters(joint.name)
            was = None if nominal is None else compute_central_parameters(nominal)
            sigma = compute_sigmas(physics, joint.name)
            yield from build_body_values(
                names.links[joint.name], was, compute_central_parameters(ten), sigma
            )
        stated = {
            quantity: sum(c * physics.nominal[name] for name, c in terms.items())
            for quantity, terms in physics.collect_drive_terms(joint.name, to).items()
            if terms.keys() <= physics.nominal.keys()
        }
        yield from build_drive_values(physics, joint, names.joints[joint.name], to, stated)


def _find_too_small(values: Iterable[Value], to: str) -> Iterator[str]:
    """Tells of bodies that MuJoCo refuses."""
    bodies: dict[str, list[float]] = {}
    for value in values:
        if value.quantity in TENSOR:
            bodies.setdefault(value.part, []).append(value.now)
    small = [
        name
        for name, six in bodies.items()
        if 0.0 < np.linalg.eigvalsh(build_symmetric_matrix(np.array(six)))[0] < LEAST
    ]
    if small and to != "sdf":
        yield (
            f"{', '.join(small)}: too small for MuJoCo, which takes no moment of inertia below "
            f"{LEAST:g} kg m2"
        )
