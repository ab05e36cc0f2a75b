"""From a robot to its symbolic model."""

from modeler.robot import Robot
from modeler.symbolic.columns import standard_columns
from modeler.symbolic.geometry import exact_geometry
from modeler.symbolic.graph import Graph
from modeler.symbolic.implied import with_implied_relations
from modeler.symbolic.model import SymbolicModel


def derive_model(robot: Robot) -> SymbolicModel:
    """The symbolic model of a robot; relations that its loops imply are stated in its robot.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: the loops leave more or less free than is actuated, are singular at home, or
            cannot close.
    """
    model = _model(robot)
    if model.closure is None:
        return model
    stated = with_implied_relations(model)
    return model if stated is robot else _model(stated)


def _model(robot: Robot) -> SymbolicModel:
    geometry = exact_geometry(robot)
    return SymbolicModel(robot, geometry, Graph(), standard_columns(geometry))
