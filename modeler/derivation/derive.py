"""From a robot to its symbolic model."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from modeler.core.errors import DerivationError, LoopError, RobotError
from modeler.core.result import Presented
from modeler.derivation.assembly_modes import STARTS, AssemblyMode, assembly_modes, lengthened
from modeler.derivation.closure import SINGULAR, check_freedom, nearest_closed, open_loop
from modeler.derivation.columns import standard_columns
from modeler.derivation.geometry import exact_geometry
from modeler.derivation.graph import Graph
from modeler.derivation.model import SymbolicModel
from modeler.derivation.walks import Linkage, linkage_of
from modeler.robot import Robot, robot_from_text, with_home_text

# [home]: taken as stated where it is good, else found; refused where it is singular.
#
# Singular postures: which joints could move there although the actuated ones are locked.


_TAKES_PART = 0.1
"""Of the largest share in a motion, from which a joint is named."""


def lost_directions(linkage: Linkage, u: np.ndarray) -> list[str]:
    """The motions that a singular posture leaves free, each as `q11 : q12 : qP = 1 : -0.5 : 0.3`.

    Travels count in sizes of the robot. Joints that move little are left out.

    Args:
        linkage: the robot.
        u: (u,) closed posture.
    """
    names = [f"q{linkage.free[k].name}" for k in linkage.loops.solved]
    _, values, turned = np.linalg.svd(linkage.loops.inner(u[None])[0])
    told = []
    for motion in turned[values <= SINGULAR]:
        motion = motion / motion[np.argmax(np.abs(motion) > (1 - 1e-6) * np.max(np.abs(motion)))]
        moved = [k for k, share in enumerate(motion) if abs(share) > _TAKES_PART]
        who = " : ".join(names[k] for k in moved)
        told.append(who + " = " + " : ".join(f"{motion[k]:.2g}" for k in moved))
    return told


@dataclass(frozen=True)
class HomeModes(Presented):
    """The assembly modes of a robot, and which of them its file means.

    Attributes:
        linkage: the robot.
        modes: the best first; at least one.
        own: place among them of the posture that the file means as it stands; None if [home] is
            missing or poor, so that the first is taken.
    """

    linkage: Linkage
    modes: tuple[AssemblyMode, ...]
    own: int | None


NEAR = 0.5
"""rad, or sizes of the robot: a joint that closing the loops moves further was not stated well."""
_MOST_NAMED = 6
_SAME_SHAPE = 1e-3


@dataclass(frozen=True)
class Home:
    """A robot with a [home] from which its loops close.

    Attributes:
        robot: with its home; the robot itself where that was good as it stood.
        told: one line on what was found or moved; "" where nothing was.
    """

    robot: Robot
    told: str = ""

    def in_text(self, robot: Robot) -> Robot:
        """The robot whose file's text says it too: that goes into model files."""
        if not self.told:
            return robot
        try:
            text = with_home_text(robot.text, robot.home, self.robot.home)
        except RobotError:  # it is found again, the same
            return self.robot
        return robot_from_text(text, f"{robot.name} with its [home]")


def settled_home(model: SymbolicModel) -> Home:
    """The robot with a good [home].

    A home stays as it is if the passive joints close the loops near it: none moves further than
    `NEAR`, rows left out counting as 0, and the posture is not singular. Else the assembly modes
    are searched, and the best one near to what is stated is taken.

    Raises:
        LoopError: the posture stated is singular, the loops leave more or less free than is
            actuated, or cannot close.
    """
    robot, linkage = model.robot, linkage_of(model)
    if linkage is None:
        return Home(robot)
    stated = linkage.vector(robot.home)
    if _good_as_stated(linkage, stated) is not None:
        return Home(robot)
    start = np.nan_to_num(stated)
    check_freedom(linkage.loops, start, linkage.geometry, linkage.owners)
    modes = assembly_modes(linkage, stated)
    found = nearest_closed(linkage.loops, start)
    if found is not None and linkage.loops.sigma(found[None])[0] <= SINGULAR:
        # Meant, if all actuated joints on which the loops depend are stated.
        given = [k for k in linkage.loops.given if linkage.tied[k]]
        if np.all(np.isfinite(stated[given])):
            raise LoopError(_singular(linkage, found, modes))
    if not modes:
        raise _nothing_found(linkage, start)
    home = written(linkage, modes[0].posture)
    return Home(dataclasses.replace(robot, home=home), _home_note(linkage, modes, stated))


def modes_near(robot: Robot, near: Mapping[str, float]) -> HomeModes:
    """The assembly modes of a robot with loops, the best one near to a posture first.

    Args:
        robot: as read.
        near: values that are meant, by row; what is left out is found.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: the robot has no loops that are left to close, they leave more or less free than
            is actuated, or no closed posture is found that is not singular.
    """
    linkage = linkage_of(_model(robot))
    if linkage is None:
        raise LoopError(
            f"{robot.name}: there is no loop to close; [home] is asked for robots with [loops] "
            "that no relations close already"
        )
    hints = linkage.vector(near)
    start = np.nan_to_num(hints)
    check_freedom(linkage.loops, start, linkage.geometry, linkage.owners)
    own = _good_as_stated(linkage, linkage.vector(robot.home))
    if own is not None and not near:  # [home] is left out where all joints at 0 will do
        hints[list(linkage.loops.given)] = own[list(linkage.loops.given)]
    modes = assembly_modes(linkage, hints)
    if not modes:
        raise _nothing_found(linkage, np.nan_to_num(hints))
    if own is None:
        return HomeModes(linkage, modes, None)
    shapes = linkage.shape(np.array([own, *(mode.posture for mode in modes)]))
    away = np.max(np.abs(shapes[1:] - shapes[0]), axis=1)
    at = int(np.argmin(away))
    return HomeModes(linkage, modes, at if away[at] < _SAME_SHAPE else None)


def _nothing_found(linkage: Linkage, start: np.ndarray) -> LoopError:
    found = open_loop(linkage.loops, start, linkage.owners)
    return LoopError(
        f"{linkage.robot.name}: [home]: {found}, nor from {STARTS} others without being singular; "
        "check the lengths, and the joints of [loops]"
    )


def written(linkage: Linkage, u: np.ndarray) -> dict[str, float]:
    """A posture as [home] states it: actuated joints as they are, the others to 1e-6.

    Rows that follow others are stated where they were before.
    """
    robot, given = linkage.robot, linkage.loops.given
    home = {
        joint.name: float(u[k]) if k in given else round(float(u[k]), 6) + 0.0
        for k, joint in enumerate(linkage.free)
    }
    values = {**robot.symbol_values(), **{f"q{name}": value for name, value in home.items()}}
    left = dict(robot.relations)
    while left:  # there are no circles
        for name in [n for n, relation in left.items() if relation.names <= values.keys()]:
            values[f"q{name}"] = left.pop(name).number(values)
    stated = {name: values[f"q{name}"] for name in robot.relations if name in robot.home}
    return {**home, **stated}


def _good_as_stated(linkage: Linkage, stated: np.ndarray) -> np.ndarray | None:
    """The closed posture that was stated, rows left out at 0; None if it is no good one."""
    found = nearest_closed(linkage.loops, np.nan_to_num(stated))
    if found is None or linkage.loops.sigma(found[None])[0] <= SINGULAR:
        return None
    moved = linkage.distances(found[None], np.nan_to_num(stated))
    turned = lengthened(linkage, found[None], stated)
    return found if np.max(moved) <= NEAR and np.array_equal(turned[0], found) else None


def _home_note(linkage: Linkage, modes: tuple[AssemblyMode, ...], stated: np.ndarray) -> str:
    robot, posture = linkage.robot, modes[0].posture
    others = f"{len(modes)} assembly modes: `modeler home` shows them, --write writes one down"
    if len(modes) == 1:
        others = "the only assembly mode found; `modeler home --write` writes it down"
    if not modes[0].kept:
        others += "; it is outside [limits], which none keeps there: check the lengths"
    if not np.any(np.isfinite(stated)):
        given = linkage.loops.given
        return f"{robot.name}: [home] found: mode A at {_values(linkage, posture, given)}; {others}"
    moved = linkage.distances(posture[None], stated)[0]
    far = [k for k in np.argsort(-moved, kind="stable") if moved[k] > 0.01]
    change = ", ".join(
        f"q{linkage.free[k].name} {stated[k]:.4g} -> {posture[k]:.4g}" for k in far[:_MOST_NAMED]
    )
    change = f"moved {change}" if far else "what it leaves out was found"
    return f"{robot.name}: [home] completed: {change}; mode A of {others}"


def _values(linkage: Linkage, u: np.ndarray, places: tuple[int, ...] | range) -> str:
    return ", ".join(f"q{linkage.free[k].name} = {float(f'{u[k]:.5g}') + 0.0:g}" for k in places)


def _singular(linkage: Linkage, u: np.ndarray, modes: tuple[AssemblyMode, ...]) -> str:
    names = [f"q{joint.name}" for joint in linkage.free]
    motions = lost_directions(linkage, u)
    lost = [name for name in names if any(name in m.split(" = ")[0].split(" : ") for m in motions)]
    away = linkage.loops.sigma(u[None])[0]
    advice = "state another posture"
    if modes:
        advice += f", such as {_values(linkage, modes[0].posture, range(len(names)))}"
    joints = ", ".join(name[1:] for name in lost)
    return (
        f"{linkage.robot.name}: the loops are singular at [home]: joint"
        f"{'s' if len(lost) > 1 else ''} {joints} could move there with the actuated joints "
        f"locked ({'; '.join(motions)}; singular value {away:.1e}); {advice}"
    )


def derive_model(robot: Robot) -> SymbolicModel:
    """The symbolic model of a robot.

    The robot of the model has a [home] that is found where it is missing or poor, and states the
    relations that its loops imply.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: the loops leave more or less free than is actuated, are singular at home, or
            cannot close.
    """
    model = _model(robot)
    home = settled_home(model)
    if home.robot is not robot:
        robot = home.robot
        model = _model(robot)
    if model.closure is None:
        return model
    from modeler.derivation.implied import implied_relations  # of loops alone

    implied = implied_relations(model)
    if implied.relations:
        model = _model(replace(robot, relations={**robot.relations, **implied.relations}))
    return replace(model, special=implied.special, unproven=implied.unproven)


def with_home(robot: Robot) -> Home:
    """The robot with a [home] from which its loops close, found where it is missing or poor.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: see `settled_home`.
    """
    return settled_home(_model(robot))


def _model(robot: Robot) -> SymbolicModel:
    try:
        geometry = exact_geometry(robot)
    except DerivationError as error:
        raise DerivationError(f"{robot.name}: {error}") from None
    return SymbolicModel(robot, geometry, Graph(), standard_columns(geometry))
