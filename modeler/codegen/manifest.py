"""The manifest of an emitted module: everything the numeric stages will know of the robot."""

from collections.abc import Iterable, Mapping, Sequence

import sympy

from modeler.base.relation_text import coefficient_text
from modeler.base.result import BaseParameters
from modeler.codegen.block import Block
from modeler.codegen.functions import Function
from modeler.codegen.names import module_prefix
from modeler.core.contract import (
    FORMAT,
    BaseSpec,
    ClosureSpec,
    FunctionSpec,
    JointSpec,
    ModuleSpec,
    ParameterSpec,
    SignalSpec,
    SymbolSpec,
    TermSpec,
)
from modeler.robot import Joint, Robot
from modeler.symbolic import StandardColumn, SymbolicModel
from modeler.symbolic.precise import precise_values
from modeler.symbolic.signals import Signal


def module_spec(
    model: SymbolicModel, base: BaseParameters, blocks: Iterable[tuple[Function, Block | None]]
) -> ModuleSpec:
    """The manifest of the module with these functions; None is a function that is all zeros."""
    robot = model.robot
    prefix = module_prefix(robot.name)
    values = model.geometry.values
    return ModuleSpec(
        robot=robot.name,
        title=robot.title,
        prefix=prefix,
        format=FORMAT,
        symbols=tuple(SymbolSpec(name, value) for name, value in values.items()),
        joints=tuple(_joint(robot, joint) for joint in robot.coordinates),
        standard=tuple(_standard(model, column) for column in model.columns),
        base=_bases(model, base),
        unidentifiable=tuple(base.unidentifiable),
        functions=function_specs(prefix, list(blocks)),
        closure=_closure(model),
        signals=tuple(_signal(model, signal) for signal in model.signals),
    )


def _signal(model: SymbolicModel, signal: Signal) -> SignalSpec:
    joint = model.robot.joints[signal.row].name if signal.row >= 0 else ""
    unit = {"time": "s", "temperature": "K or degC", "slip": "1"}[signal.kind]
    return SignalSpec(signal.kind, joint, unit, signal.value)


def _closure(model: SymbolicModel) -> ClosureSpec | None:
    closure = model.closure
    if closure is None:
        return None
    return ClosureSpec(
        variables=tuple(joint.name for joint in model.robot.free),
        units=tuple(joint.unit for joint in model.robot.free),
        given=closure.given,
        platform=closure.platform or (),
        home=closure.home,
        carrier=model.robot.platform[-1] if model.robot.platform else "",
    )


def _joint(robot: Robot, joint: Joint) -> JointSpec:
    return JointSpec(
        name=joint.name,
        kind="revolute" if joint.angular else "prismatic",
        unit=joint.unit,
        effort_unit=joint.effort_unit,
        actuated=joint.actuated,
        drive_gain=robot.drive_gains.get(joint.name),
    )


def _standard(model: SymbolicModel, column: StandardColumn) -> ParameterSpec:
    return ParameterSpec(
        name=column.name,
        unit=column.unit,
        kind=column.kind,
        effect=column.effect,
        joint=model.robot.joints[column.row].name,
        nominal=model.robot.parameters.get(column.name),
        nonnegative=column.nonnegative,
    )


def _bases(model: SymbolicModel, base: BaseParameters) -> tuple[BaseSpec, ...]:
    """The base parameters; entries of the regressor and equal coefficients are looked at once."""
    rows: dict[int, list[int]] = {}
    for joint, place in model.regressor:
        rows.setdefault(place, []).append(joint)
    every = range(len(model.closure.given)) if model.closure is not None else None
    terms: dict[sympy.Expr, tuple[str, float]] = {}
    for parameter in base.parameters:
        for term in parameter.terms:
            if term.coefficient not in terms:
                number = _number(model, term.coefficient, model.geometry.values)
                terms[term.coefficient] = coefficient_text(term.coefficient), number
    found = []
    for parameter in base.parameters:
        column = model.columns[parameter.column]
        found.append(
            BaseSpec(
                name=parameter.name,
                column_of=column.name,
                unit=column.unit,
                kind=column.kind,
                # With loops a column can enter the torque of every coordinate.
                rows=tuple(every or sorted(rows.get(parameter.column, ()))),
                terms=tuple(TermSpec(*terms[t.coefficient], t.parameter) for t in parameter.terms),
            )
        )
    return tuple(found)


def _number(model: SymbolicModel, coefficient: sympy.Expr, values: Mapping[str, float]) -> float:
    return float(precise_values(model.graph, [model.algebra.static(coefficient)], values)[0])


def function_specs(
    prefix: str,
    blocks: Sequence[tuple[Function, Block | None]],
    called: Sequence[tuple[Function, Block | None]] = (),
) -> tuple[FunctionSpec, ...]:
    """The public ones; one that closes loops has the operations of all that it calls, once each.

    Args:
        prefix: of the module.
        blocks: the functions.
        called: functions of other units that they may call.
    """
    own = {function.role: _operations(block) for function, block in (*called, *blocks)}
    found = []
    for function, block in blocks:
        if function.internal:
            continue
        parts = [_operations(block)]
        if function.closed is not None:
            parts = [own[role] for role in function.closed.calls if role in own]
        found.append(
            FunctionSpec(
                name=f"{prefix}_{function.role}",
                equation=function.equation,
                inputs=function.inputs,
                outputs=(function.output,),
                additions=sum(additions for additions, _ in parts),
                multiplications=sum(multiplications for _, multiplications in parts),
                status=function.closed is not None,
            )
        )
    return tuple(found)


def _operations(block: Block | None) -> tuple[int, int]:
    return (block.additions, block.multiplications) if block else (0, 0)
