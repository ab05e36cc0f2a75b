"""Columns of effects as expressions of the graph, from the equations that define them."""

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import partial
from typing import Protocol

from modeler.core.errors import DerivationError
from modeler.effects import ENCODERS, Acts
from modeler.symbolic.columns import ShaftColumn
from modeler.symbolic.derivative import derivatives
from modeler.symbolic.geometry import Geometry
from modeler.symbolic.graph import Expr, Graph
from modeler.symbolic.signals import Signal, signals_read


class Dynamics(Protocol):
    """What columns of effects read of a model."""

    @property
    def graph(self) -> Graph:
        """Of its expressions."""

    @property
    def geometry(self) -> Geometry:
        """Of its robot."""

    @property
    def signals(self) -> tuple[Signal, ...]:
        """What effects read besides the motion."""

    def inputs(self, kind: str) -> list[Expr]:
        """The symbols of "q", "qd" or "qdd"."""

    def reference_torque(self, kind: str) -> list[Expr]:
        """Torques at the parameters of `[reference]`."""


def effect_entries(model: Dynamics, column: ShaftColumn) -> dict[int, Expr]:
    """{free variable: torque along it per unit of the column's parameter}."""
    if column.acts is Acts.POSITION:
        return _moved(model, column)
    torque = _equation(model, column)
    return {k: torque * coefficient for k, coefficient in column.shaft.items()}


def _equation(model: Dynamics, column: ShaftColumn) -> Expr:
    """The equation of the column on its shaft."""
    graph = model.graph
    values: dict[str, Expr] = {
        name: graph.constant(Fraction(repr(float(value)))) for name, value in column.shapes.items()
    }
    for name, kind in (("q", "q"), ("v", "qd"), ("a", "qdd")):
        values[name] = along(model, column.shaft, kind)
    names = column.equation.names
    for name in ("load", "static", "torque"):
        if name in names:
            values[name] = _on_shaft(graph, column.shaft, model.reference_torque(name))
    zero = graph.constant(0)
    for signal in signals_read(column):
        read = graph.symbol(f"s[{model.signals.index(signal)}]")
        if signal.kind == "time":
            values["t"] = read - values.get("t0", zero)
        elif signal.kind == "temperature":
            values["T"] = read - values.get("T0", zero)
        else:
            values["z"] = read
    pi = graph.constant(Fraction(repr(math.pi)))
    return graph.lift(column.equation.fold(values, functions_of(graph), pi, graph.constant))


def functions_of(graph: Graph) -> Mapping[str, Callable[[Expr], Expr]]:
    """The functions of the expression language on the graph."""
    names = ("sin", "cos", "tan", "sqrt", "exp", "abs", "sign", "tanh")
    return {name: partial(graph.call, name) for name in names}


def along(model: Dynamics, shaft: Mapping[int, Fraction], kind: str) -> Expr:
    """Position, speed or acceleration of a shaft."""
    total = model.graph.constant(0)
    for k, coefficient in shaft.items():
        total = total + model.inputs(kind)[k] * coefficient
    return total


def _on_shaft(graph: Graph, shaft: Mapping[int, Fraction], torques: list[Expr]) -> Expr:
    """Torque of the joint that the shaft is; effects on motors of several joints read no load."""
    total = graph.constant(0)
    for k, coefficient in shaft.items():
        total = total + torques[k] / coefficient
    return total


def _moved(model: Dynamics, column: ShaftColumn) -> dict[int, Expr]:
    """Torque of the links at the reference, differentiated along a small change of position.

    The change is the column's equation, dq(q); speeds and accelerations change by its time
    derivatives. An encoder's error moves the rotor too.

    Raises:
        DerivationError: the equation has a part without derivative.
    """
    n = model.geometry.coordinates
    speeds = {f"q[{k}]": model.inputs("qd")[k] for k in range(n)}
    rates = speeds | {f"qd[{k}]": model.inputs("qdd")[k] for k in range(n)}
    dq = _equation(model, column)
    try:
        (dv,) = derivatives([dq], speeds)
        (da,) = derivatives([dv], rates)
    except DerivationError as error:
        raise DerivationError(
            f'{column.name}: "{column.equation.text}" moves the position and is '
            f"differentiated twice, but {error}; expected sums, products, whole powers, sqrt, exp, "
            "sin, cos, tan, tanh"
        ) from None
    direction: dict[str, Expr] = {}
    for k, coefficient in column.shaft.items():
        for kind, change in (("q", dq), ("qd", dv), ("qdd", da)):
            direction[f"{kind}[{k}]"] = change * coefficient
    kind = "axis" if column.effect in ENCODERS else "load"
    moved = derivatives(model.reference_torque(kind), direction)
    return {k: value for k, value in enumerate(moved) if not value.is_zero}
