"""From a robot to its symbolic model."""

from collections.abc import Mapping
from dataclasses import replace

from modeler.core.errors import DerivationError
from modeler.derivation.columns import standard_columns
from modeler.derivation.geometry import exact_geometry
from modeler.derivation.graph import Graph
from modeler.derivation.home import Home, HomeModes, home_modes, settled_home
from modeler.derivation.implied import implied_relations
from modeler.derivation.model import SymbolicModel
from modeler.robot.robot import Robot


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


def modes_near(robot: Robot, near: Mapping[str, float]) -> HomeModes:
    """The assembly modes of a robot with loops, the best one near to a posture first.

    Args:
        robot: as read.
        near: values that are meant, by row; what is left out is found.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: see `home_modes`.
    """
    return home_modes(_model(robot), near)


def _model(robot: Robot) -> SymbolicModel:
    try:
        geometry = exact_geometry(robot)
    except DerivationError as error:
        raise DerivationError(f"{robot.name}: {error}") from None
    return SymbolicModel(robot, geometry, Graph(), standard_columns(geometry))
