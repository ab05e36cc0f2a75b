"""A robot or a model for programs that compute with its equations: CasADi."""

from collections.abc import Iterator

from modeler.api.workflow import derive, emitted_anew
from modeler.core.errors import DataError
from modeler.estimation import IdentifiedModel, model_file
from modeler.exports import Exported, Value
from modeler.robot import Robot

TITLES = {"casadi": "CasADi"}
"""What is made of the equations, by format."""


def code_exported(thing: Robot | IdentifiedModel, to: str) -> Exported:
    """The file, and what it holds.

    Args:
        thing: a robot, or a model.
        to: one of `TITLES`.

    Raises:
        DataError: what the format cannot hold.
    """
    return _casadi(thing)


def _casadi(thing: Robot | IdentifiedModel) -> Exported:
    """Functions of q, qd, qdd and beta; of a model with its values in place of beta."""
    from modeler.codegen import casadi_file  # slow to load

    fitted = isinstance(thing, IdentifiedModel)
    derivation = emitted_anew(thing)[0] if fitted else derive(thing)
    robot = derivation.robot
    values = tuple(_values(thing)) if fitted else ()
    data, functions, missing = casadi_file(
        derivation.model, derivation.base, [value.now for value in values] if fitted else None
    )
    notes = ("casadi.FileDeserializer(FILE).unpack() gives the list of functions", *missing)
    return Exported(robot.name, "casadi", "", data, values, (), 0.0, notes, functions)


def _values(model: IdentifiedModel) -> Iterator[Value]:
    """The base parameters of a model, beside those that the robot file states."""
    spec = model.spec
    standard = {parameter.name: parameter for parameter in spec.standard}
    fitted = model_file.fitted_spec(model).parameters
    for base, known in zip(spec.base, fitted, strict=True):
        stated = [(term.value, standard[term.parameter].nominal) for term in base.terms]
        nominal = [x for _, x in stated if x is not None]
        was = sum(k * x for k, x in stated if x is not None) if len(nominal) == len(stated) else None
        joint = standard[base.column_of].joint
        yield Value(joint, base.name, base.unit, was, known.value, known.sigma, was != known.value)
