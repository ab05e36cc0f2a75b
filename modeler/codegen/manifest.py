"""The manifest of an emitted module: everything the numeric stages will know of the robot."""

from collections.abc import Iterable, Mapping

import sympy

from modeler.base.result import BaseParameter, BaseParameters
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
        base=tuple(_base(model, parameter) for parameter in base.parameters),
        unidentifiable=tuple(base.unidentifiable),
        functions=tuple(
            _function(prefix, function, block)
            for function, block in blocks
            if not function.internal
        ),
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
        nonnegative=_nonnegative(column),
    )


def _nonnegative(column: StandardColumn) -> bool:
    if column.column is None:
        return column.prefix in ("XX", "YY", "ZZ", "M")
    return column.column.nonnegative


def _base(model: SymbolicModel, parameter: BaseParameter) -> BaseSpec:
    column = model.columns[parameter.column]
    return BaseSpec(
        name=parameter.name,
        column_of=column.name,
        unit=column.unit,
        kind=column.kind,
        rows=_rows(model, parameter.column),
        terms=tuple(
            TermSpec(
                str(term.coefficient),
                _number(model, term.coefficient, model.geometry.values),
                term.parameter,
            )
            for term in parameter.terms
        ),
    )


def _rows(model: SymbolicModel, column: int) -> tuple[int, ...]:
    """Coordinates whose torque the column can enter; with loops all."""
    if model.closure is not None:
        return tuple(range(len(model.closure.given)))
    return tuple(sorted(joint for joint, k in model.regressor if k == column))


def _number(model: SymbolicModel, coefficient: sympy.Expr, values: Mapping[str, float]) -> float:
    return float(model.graph.evaluate([model.algebra.static(coefficient)], values)[0])


def _function(prefix: str, function: Function, block: Block | None) -> FunctionSpec:
    return FunctionSpec(
        name=f"{prefix}_{function.role}",
        equation=function.equation,
        inputs=function.inputs,
        outputs=(function.output,),
        additions=block.additions if block else 0,
        multiplications=block.multiplications if block else 0,
        status=function.body is not None,
    )
