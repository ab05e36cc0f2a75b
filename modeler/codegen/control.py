"""What a controller calls besides torques and regressors: functions of the unit `<prefix>_control`.

Fits do without them, so they are emitted only where a folder for a controller is written.
"""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from modeler.codegen import functions as layout
from modeler.codegen.functions import Arguments, CFunction, entries_of
from modeler.core.manifest import ArgumentSpec, FittedSpec
from modeler.derivation import BaseParameters, Expr, SymbolicModel, derivatives

UNIT = "_control"
"""C file of these functions, without the robot's name and `.c`."""


@dataclass(frozen=True)
class Control:
    """What of the controller's unit is emitted.

    Attributes:
        frames: names of further frames whose Jacobians are wanted: rows, links of [frames].
    """

    frames: tuple[str, ...] = ()


def control_functions(
    model: SymbolicModel, base: BaseParameters, control: Control
) -> tuple[CFunction, ...]:
    """The functions of the unit, those that read the parameters with their argument beta.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        control: what is wanted.
    """
    if model.closure is not None:
        return ()
    given = layout.arguments_of(model.robot.free, model, base)
    return _dynamics(model, layout.beta_symbols(model, base), given)


def fitted_control_functions(
    model: SymbolicModel, base: BaseParameters, fitted: FittedSpec
) -> tuple[CFunction, ...]:
    """Twins of those that read beta, without it: the values are written into them."""
    if model.closure is not None:
        return ()
    given = layout.arguments_of(model.robot.free, model, base)
    values = {
        parameter.column: model.graph.constant(Fraction(repr(float(known.value))))
        for parameter, known in zip(base.parameters, fitted.parameters, strict=True)
    }
    return tuple(
        dataclasses.replace(
            function,
            role=f"fitted_{function.role}",
            inputs=tuple(a for a in function.inputs if a.name != "beta"),
        )
        for function in _dynamics(model, values, given)
    )


def _dynamics(
    model: SymbolicModel, beta: Mapping[int, Expr], given: Arguments
) -> tuple[CFunction, ...]:
    """Functions that read beta, of a robot without loops."""
    n = model.geometry.coordinates
    torque = model.torque(beta, accelerations=False, gravity=False, effects=False)
    columns = [derivatives(torque, {f"qd[{j}]": model.graph.constant(Fraction(1, 2))})
               for j in range(n)]  # fmt: skip
    return (
        CFunction(
            UNIT, "coriolis_matrix", "Coriolis matrix of Christoffel symbols: dM/dt - 2 C is skew.",
            "C qd = c(q, qd)", (given.q, given.qd, given.beta),
            ArgumentSpec("C", (n, n), "kg m2/s, kg m/s or kg/s", "Coriolis matrix"),
            entries_of([columns[j][i] for i in range(n) for j in range(n)]),
        ),
    )  # fmt: skip
