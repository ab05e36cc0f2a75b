"""A model on a graph of its own, prepared for formulas that people read."""

from collections.abc import Mapping
from dataclasses import replace

import sympy

from modeler.base import BaseParameters
from modeler.symbolic import Expr, Graph, SymbolicModel
from modeler.symbolic.algebra import GraphAlgebra
from modeler.symbolic.geometry import Geometry, Row


def fresh_model(model: SymbolicModel) -> SymbolicModel:
    """The same model on another graph, which knows the sines of sums over parallel axes.

    Lengths, gravity, speeds times these sines are known too: the recursions multiply by them first.
    The graph of `model` is left as it is: emitted code would read these sines otherwise.
    """
    found = replace(model, graph=Graph())
    graph, geometry = found.graph, found.geometry
    lengths = {x for row in geometry.rows for x in (row.b, row.d, row.r)} | {*geometry.gravity}
    factors = [found.algebra.static(x) for x in sorted(lengths, key=str) if not x.is_Number]
    factors += found.inputs("qd") + found.inputs("qdd")
    for angle in _angles(geometry, found.algebra):
        for turned in (graph.call("cos", angle), graph.call("sin", angle)):
            for factor in factors:
                graph.lift(factor * turned)
    return found


def letters_of(model: SymbolicModel, base: BaseParameters) -> dict[str, str]:
    """{symbol of the graph: how it is written}: positions, speeds, signals, base parameters."""
    found = {name: name for name in model.geometry.values}
    for k, joint in enumerate(model.robot.free):
        found |= {f"{kind}[{k}]": f"{kind}{joint.name}" for kind in ("q", "qd", "qdd")}
    for i, parameter in enumerate(base.parameters):
        found[f"beta[{i}]"] = parameter.name
    kinds = {"time": "t", "temperature": "T", "slip": "z"}
    for k, signal in enumerate(model.signals):
        found[f"s[{k}]"] = f"{kinds[signal.kind]}{k + 1}"
    return found


def base_symbols(model: SymbolicModel, base: BaseParameters) -> Mapping[int, Expr]:
    """{column: the base parameter that has it}."""
    return {p.column: model.graph.symbol(f"beta[{i}]") for i, p in enumerate(base.parameters)}


def _angles(geometry: Geometry, algebra: GraphAlgebra) -> list[Expr]:
    """Angles of the rows that turn, and those between frames whose z axes are parallel."""
    found: list[Expr] = []
    for k, row in enumerate(geometry.rows):
        angle = _turn(row, algebra)
        found.append(angle)
        at, sign = k, _flip(row)
        while sign and (parent := geometry.rows[at].parent) is not None:
            at = parent
            before = _turn(geometry.rows[at], algebra)
            angle = angle + (before if sign > 0 else -before)
            found.append(angle)
            sign *= _flip(geometry.rows[at])
    return found


def _flip(row: Row) -> int:
    """1 if z is parallel to that of the antecedent, -1 if opposite, 0 if neither."""
    quarters = row.alpha / (sympy.pi / 2)
    return {0: 1, 2: -1}.get(int(quarters) % 4, 0) if quarters.is_Integer else 0


def _turn(row: Row, algebra: GraphAlgebra) -> Expr:
    """Rate * q and constant of a row that turns, right angles left out."""
    angle = algebra.graph.constant(0)
    if row.index is not None and row.joint.angular:
        q = algebra.combined("q", row)
        angle = q if row.rate > 0 else -q
    for constant in (row.theta, row.gamma):
        if not (constant / (sympy.pi / 2)).is_Integer:
            angle = angle + algebra.static(constant)
    return angle
