"""The unit of a fitted model: its functions with the values in the place of beta.

The values are numbers to the graph, so products of values and lengths are constants, and what a
value of 0 multiplies is gone. Only here may the sign of a speed be smooth: functions that read beta
stay those of the regressors, phi beta, which fits and their checks rely on.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from modeler.codegen import functions as layout
from modeler.codegen.block import OF_PRECISION
from modeler.codegen.closed import build_closed_dynamics
from modeler.codegen.functions import CFunction
from modeler.core.errors import EmitError
from modeler.core.manifest import FittedSpec, ModuleSpec
from modeler.derivation import BaseParameters, Expr, ShaftColumn, SymbolicModel, combine_along_shaft

UNIT = "_fitted"
"""C file of these functions, without the robot's name and `.c`."""

_TREE = "fitted_tree"


@dataclass(frozen=True)
class Width:
    """The width over which dry friction of a joint, or of its motor, turns.

    Attributes:
        macro: that says it.
        constant: C constant that the macro initialises.
        unit: "rad/s" or "m/s".
    """

    macro: str
    constant: str
    unit: str


def check_values(base: BaseParameters, fitted: FittedSpec) -> None:
    """Checks that there is one finite value of every base parameter, in order.

    Raises:
        EmitError: says what is there instead.
    """
    names = [parameter.name for parameter in base.parameters]
    fitted_names = [parameter.name for parameter in fitted.parameters]
    if fitted_names != names:
        raise EmitError(
            f"values of {', '.join(fitted_names)}; expected those of the base parameters "
            f"{', '.join(names)}; fit the model again"
        )
    for parameter in fitted.parameters:
        if not math.isfinite(parameter.value):
            raise EmitError(
                f"{parameter.name}: got the value {parameter.value}; expected a number; fit the "
                "model again"
            )


def build_fitted_functions(
    model: SymbolicModel, base: BaseParameters, fitted: FittedSpec
) -> tuple[CFunction, ...]:
    """Returns the twins without their argument beta: internal ones, then those of the header."""
    values = fitted_constants(model, base, fitted)
    if model.closure is None:
        arguments = layout.make_arguments(model.robot.free_joints, model, base)
        twins = layout.build_dynamics_functions(model, values, arguments)
        return tuple(remove_beta(f, UNIT) for f in twins)
    tree, public = build_closed_dynamics(model, base, values)
    inner = [replace(remove_beta(f, UNIT), role=f"{_TREE}_{f.role}", internal=True) for f in tree]
    return (*inner, *(remove_beta(f, UNIT) for f in public))


def fitted_constants(
    model: SymbolicModel, base: BaseParameters, fitted: FittedSpec
) -> dict[int, Expr]:
    """Returns the fitted values as constants of the graph, by standard column."""
    values = (Fraction(repr(float(known.value))) for known in fitted.parameters)
    pairs = zip(base.parameters, values, strict=True)
    return {parameter.column: model.graph.constant(value) for parameter, value in pairs}


def remove_beta(function: CFunction, unit: str) -> CFunction:
    """Returns the twin of a function that reads beta, for the fitted values."""
    closed, composed = function.closed, function.composed
    if closed is not None:
        reads = ", ".join(name for name in closed.reads.split(", ") if name != "beta")
        closed = replace(closed, tree=_TREE, reads=reads)
    if composed is not None:
        roles = {word: _twin(role) for word, role in composed.roles.items()}
        composed = replace(composed, roles=roles)
    inputs, role = tuple(a for a in function.inputs if a.name != "beta"), _twin(function.role)
    changed = replace(function, unit=unit, role=role, inputs=inputs)
    return replace(changed, closed=closed, composed=composed)


def _twin(role: str) -> str:
    return role if role == "jacobian" else f"fitted_{role}"  # which reads no parameters


def find_widths(
    prefix: str, model: SymbolicModel, functions: Sequence[CFunction]
) -> Mapping[int, Width]:
    """Returns {speed: its width} of joints and motors of whose speed functions read the sign.

    Joints that always move alike have one speed, and the width of the first of them; a joint and
    its motor have one width. A sign of anything else than such a speed leaps where it did.
    """
    values = [value for function in functions for _, value in function.entries]
    if values:
        model = replace(model, graph=values[0].graph)
    nodes = [model.graph.nodes[index] for index in model.graph.find_reachable(values)]
    read = {node.args[0] for node in nodes if node.op == "sign"}
    widths: dict[int, Width] = {}
    for column in model.columns:
        for part in column.parts if isinstance(column, ShaftColumn) else ():
            speed = abs(combine_along_shaft(model, part.shaft, "qd").ref)
            if speed in read and speed not in widths:
                joint = model.robot.joints[part.row]
                macro, name = (
                    f"{prefix.upper()}_COULOMB_WIDTH_{joint.name}",
                    f"{prefix}_width_{joint.name}",
                )
                widths[speed] = Width(macro, name, f"{joint.unit}/s")
    return widths


def format_fitted_texts(
    spec: ModuleSpec, fitted: FittedSpec, widths: Sequence[Width]
) -> dict[str, Any]:
    """Returns finished strings for the templates of the unit."""
    line = fitted.verdict or "one that nobody has judged"
    verdict = f"The fit of this model is {line[:1].lower()}{line[1:]}"
    doubts = [f"Doubt: {doubt}" for doubt in fitted.warnings if doubt not in fitted.verdict]
    warning = "" if fitted.valid else "WARNING. "
    # Lines of the C table: the value, which it is, its unit, its uncertainty.
    places = layout.name_enumerators(spec.prefix, "beta", [base.name for base in spec.base])
    lines, literal = list[str](), OF_PRECISION[spec.precision].format_literal
    for parameter, place in zip(fitted.parameters, places, strict=True):
        sure = "set aside: the logs do not identify it"
        if parameter.sigma is not None:
            sure = f"sigma {parameter.sigma:.2g}{'' if parameter.essential else ', not essential'}"
        comma = "," if len(lines) + 1 < len(fitted.parameters) else " "
        about = layout.format_comment_line(f"{place} [{parameter.unit}], {sure}")
        lines.append(f"    {literal(parameter.value):>24}{comma} /* {about} */")
    return {
        "widths": widths,
        "remarks": layout.format_comment_lines([f"{warning}{verdict}", *doubts, *fitted.notes]),
        "effort": " or ".join(dict.fromkeys(joint.effort_unit for joint in spec.joints)),
        "lines": lines,
        "gains": layout.wrap_names([literal(gain) for gain in fitted.gains]),
    }
