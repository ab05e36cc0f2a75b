"""From a robot to its symbolic model."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from modeler.core.errors import DerivationError, LoopError, RobotError
from modeler.core.result import Result
from modeler.derivation.assembly_modes import (
    AssemblyMode,
    find_assembly_modes,
    flip_negative_travels,
)
from modeler.derivation.closure import check_mobility, describe_open_loop, find_nearest_closed
from modeler.derivation.columns import build_standard_columns
from modeler.derivation.geometry import build_exact_geometry
from modeler.derivation.graph import Graph
from modeler.derivation.model import SymbolicModel
from modeler.derivation.thresholds import THRESHOLDS
from modeler.derivation.walks import Linkage, build_linkage
from modeler.robot import Robot, parse_robot_text, replace_home

# [home]: taken as stated where it is good, else found; refused where it is singular.
#
# Singular postures: which joints could move there although the actuated ones are locked.


def describe_free_motions(linkage: Linkage, u: np.ndarray) -> list[str]:
    """Describes the motions that a singular posture leaves free: `q11 : q12 : qP = 1 : -0.5 : 0.3`.

    Travels count in sizes of the robot. Joints that move little are left out.

    Args:
        linkage: the robot.
        u: (u,) closed posture.
    """
    names = [f"q{linkage.free[k].name}" for k in linkage.loops.solved]
    _, values, turned = np.linalg.svd(linkage.loops.compute_passive_jacobian(u[None])[0])
    descriptions = []
    for motion in turned[values <= THRESHOLDS.min_singular_value]:
        motion = motion / motion[np.argmax(np.abs(motion) > (1 - 1e-6) * np.max(np.abs(motion)))]
        moved = [k for k, share in enumerate(motion) if abs(share) > THRESHOLDS.min_motion_share]
        who = " : ".join(names[k] for k in moved)
        descriptions.append(who + " = " + " : ".join(f"{motion[k]:.2g}" for k in moved))
    return descriptions


@dataclass(frozen=True)
class HomeModes(Result):
    """The assembly modes of a robot, and which of them its file means.

    Attributes:
        linkage: the robot.
        modes: the best first; at least one.
        own: place among them of the posture that the file means as it stands; None if [home] is
            missing or poor, so that the first is taken.
    """

    linkage: Linkage
    modes: tuple[AssemblyMode, ...]
    stated_index: int | None


@dataclass(frozen=True)
class ClosedHome:
    """A robot with a [home] from which its loops close.

    Attributes:
        robot: with its home; the robot itself where that was good as it stood.
        told: one line on what was found or moved; "" where nothing was.
    """

    robot: Robot
    message: str = ""

    def write_to_text(self, robot: Robot) -> Robot:
        """Returns the robot whose file's text states the home too, for model files."""
        if not self.message:
            return robot
        try:
            text = replace_home(robot.text, robot.home, self.robot.home)
        except RobotError:  # it is found again, the same
            return self.robot
        return parse_robot_text(text, f"{robot.name} with its [home]")


def resolve_home(model: SymbolicModel) -> ClosedHome:
    """Returns the robot with a [home] from which its loops close and that is not singular.

    A home stays as it is if the passive joints close the loops near it: none moves further than
    `max_home_move`, rows left out counting as 0, and the posture is not singular. Else the assembly
    modes are searched, and the best one near to what is stated is taken.

    Raises:
        LoopError: the posture stated is singular, the loops leave more or less free than is
            actuated, or cannot close.
    """
    robot, linkage = model.robot, build_linkage(model)
    if linkage is None:
        return ClosedHome(robot)
    stated = linkage.build_vector(robot.home)
    if _close_stated_home(linkage, stated) is not None:
        return ClosedHome(robot)
    start = np.nan_to_num(stated)
    check_mobility(linkage.loops, start, linkage.geometry, linkage.owners)
    modes = find_assembly_modes(linkage, stated)
    posture = find_nearest_closed(linkage.loops, start)
    if (
        posture is not None
        and linkage.loops.compute_singularity_distance(posture[None])[0]
        <= THRESHOLDS.min_singular_value
    ):
        # Meant, if all actuated joints on which the loops depend are stated.
        loop_joints = [k for k in linkage.loops.actuated if linkage.is_tied[k]]
        if np.all(np.isfinite(stated[loop_joints])):
            raise LoopError(_describe_singularity(linkage, posture, modes))
    if not modes:
        raise _build_closure_error(linkage, start)
    home = express_as_home(linkage, modes[0].posture)
    return ClosedHome(dataclasses.replace(robot, home=home), _describe_home(linkage, modes, stated))


def find_modes_near(robot: Robot, near: Mapping[str, float]) -> HomeModes:
    """Returns the assembly modes of a robot with loops, the best one near a posture first.

    Args:
        robot: as read.
        near: values that are meant, by row; what is left out is found.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: the robot has no loops that are left to close, they leave more or less free than
            is actuated, or no closed posture is found that is not singular.
    """
    linkage = build_linkage(_build_model(robot))
    if linkage is None:
        raise LoopError(
            f"{robot.name}: there is no loop to close; [home] is asked for robots with [loops] "
            "that no relations close already"
        )
    hints = linkage.build_vector(near)
    start = np.nan_to_num(hints)
    check_mobility(linkage.loops, start, linkage.geometry, linkage.owners)
    stated_posture = _close_stated_home(linkage, linkage.build_vector(robot.home))
    if stated_posture is not None and not near:  # [home] is left out where all joints at 0 will do
        hints[list(linkage.loops.actuated)] = stated_posture[list(linkage.loops.actuated)]
    modes = find_assembly_modes(linkage, hints)
    if not modes:
        raise _build_closure_error(linkage, np.nan_to_num(hints))
    if stated_posture is None:
        return HomeModes(linkage, modes, None)
    shapes = linkage.compute_shape(np.array([stated_posture, *(mode.posture for mode in modes)]))
    away = np.max(np.abs(shapes[1:] - shapes[0]), axis=1)
    at = int(np.argmin(away))
    return HomeModes(linkage, modes, at if away[at] < THRESHOLDS.stated_shape else None)


def _build_closure_error(linkage: Linkage, start: np.ndarray) -> LoopError:
    reason = describe_open_loop(linkage.loops, start, linkage.owners)
    return LoopError(
        f"{linkage.robot.name}: [home]: {reason}, nor from "
        f"{THRESHOLDS.assembly_starts} others without being singular; check the lengths, and the joints of [loops]"
    )


def express_as_home(linkage: Linkage, u: np.ndarray) -> dict[str, float]:
    """Returns a posture as [home] states it: actuated joints exact, the others to 1e-6.

    Rows that follow others are stated where they were before.
    """
    robot, actuated = linkage.robot, linkage.loops.actuated
    home = {
        joint.name: float(u[k]) if k in actuated else round(float(u[k]), 6) + 0.0
        for k, joint in enumerate(linkage.free)
    }
    values = {**robot.evaluate_symbols(), **{f"q{name}": value for name, value in home.items()}}
    left = dict(robot.relations)
    while left:  # there are no circles
        for name in [n for n, relation in left.items() if relation.names <= values.keys()]:
            values[f"q{name}"] = left.pop(name).evaluate(values)
    stated = {name: values[f"q{name}"] for name in robot.relations if name in robot.home}
    return {**home, **stated}


def _close_stated_home(linkage: Linkage, stated: np.ndarray) -> np.ndarray | None:
    """The closed posture that was stated, rows left out at 0; None if it is no good one."""
    posture = find_nearest_closed(linkage.loops, np.nan_to_num(stated))
    if (
        posture is None
        or linkage.loops.compute_singularity_distance(posture[None])[0]
        <= THRESHOLDS.min_singular_value
    ):
        return None
    moved = linkage.compute_distances(posture[None], np.nan_to_num(stated))
    turned = flip_negative_travels(linkage, posture[None], stated)
    return (
        posture
        if np.max(moved) <= THRESHOLDS.max_home_move and np.array_equal(turned[0], posture)
        else None
    )


def _describe_home(linkage: Linkage, modes: tuple[AssemblyMode, ...], stated: np.ndarray) -> str:
    robot, posture = linkage.robot, modes[0].posture
    others = f"{len(modes)} assembly modes: `modeler home` shows them, --write writes one down"
    if len(modes) == 1:
        others = "the only assembly mode found; `modeler home --write` writes it down"
    if not modes[0].is_within_limits:
        others += "; it is outside [limits], which none keeps there: check the lengths"
    if not np.any(np.isfinite(stated)):
        actuated = linkage.loops.actuated
        return (
            f"{robot.name}: [home] found: mode A at "
            f"{_format_values(linkage, posture, actuated)}; {others}"
        )
    moved = linkage.compute_distances(posture[None], stated)[0]
    far = [k for k in np.argsort(-moved, kind="stable") if moved[k] > 0.01]
    change = ", ".join(
        f"q{linkage.free[k].name} {stated[k]:.4g} -> {posture[k]:.4g}"
        for k in far[: THRESHOLDS.listed_moves]
    )
    change = f"moved {change}" if far else "what it leaves out was found"
    return f"{robot.name}: [home] completed: {change}; mode A of {others}"


def _format_values(linkage: Linkage, u: np.ndarray, places: tuple[int, ...] | range) -> str:
    return ", ".join(f"q{linkage.free[k].name} = {float(f'{u[k]:.5g}') + 0.0:g}" for k in places)


def _describe_singularity(linkage: Linkage, u: np.ndarray, modes: tuple[AssemblyMode, ...]) -> str:
    names = [f"q{joint.name}" for joint in linkage.free]
    motions = describe_free_motions(linkage, u)
    lost = [name for name in names if any(name in m.split(" = ")[0].split(" : ") for m in motions)]
    away = linkage.loops.compute_singularity_distance(u[None])[0]
    advice = "state another posture"
    if modes:
        advice += f", such as {_format_values(linkage, modes[0].posture, range(len(names)))}"
    joints = ", ".join(name[1:] for name in lost)
    return (
        f"{linkage.robot.name}: the loops are singular at [home]: joint"
        f"{'s' if len(lost) > 1 else ''} {joints} could move there with the actuated joints "
        f"locked ({'; '.join(motions)}; singular value {away:.1e}); {advice}"
    )


def derive_model(robot: Robot) -> SymbolicModel:
    """Returns the symbolic model of a robot.

    The robot of the model has a [home] that is found where it is missing or poor, and states the
    relations that its loops imply.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: the loops leave more or less free than is actuated, are singular at home, or
            cannot close.
    """
    model = _build_model(robot)
    home = resolve_home(model)
    if home.robot is not robot:
        robot = home.robot
        model = _build_model(robot)
    if model.closure is None:
        return model
    from modeler.derivation.implied import find_implied_relations  # of loops alone

    implied = find_implied_relations(model)
    if implied.relations:
        model = _build_model(replace(robot, relations={**robot.relations, **implied.relations}))
    return replace(model, special=implied.special, unproven=implied.unproven)


def complete_home(robot: Robot) -> ClosedHome:
    """Returns the robot with a [home] from which its loops close, found where it is missing.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: see `resolve_home`.
    """
    return resolve_home(_build_model(robot))


def _build_model(robot: Robot) -> SymbolicModel:
    try:
        geometry = build_exact_geometry(robot)
    except DerivationError as error:
        raise DerivationError(f"{robot.name}: {error}") from None
    return SymbolicModel(robot, geometry, Graph(), build_standard_columns(geometry))
