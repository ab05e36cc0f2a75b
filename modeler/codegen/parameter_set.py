"""Functions that take the widths of dry friction while they run, beside the parameters.

With beta they are what a parameter set of a controller holds; see templates/parameter_set.jinja.
"""

import dataclasses
from collections.abc import Mapping

from modeler.codegen import functions as layout
from modeler.codegen.fitted import Width, widths
from modeler.codegen.functions import Arguments, CFunction
from modeler.core.manifest import ArgumentSpec
from modeler.derivation import BaseParameters, Expr, SymbolicModel

UNIT = "_control"
"""C file of these functions, without the robot's name and `.c`."""

SMOOTH = "smooth_"
"""Start of their roles."""


def smooth_functions(
    model: SymbolicModel, beta: Mapping[int, Expr], given: Arguments
) -> tuple[CFunction, ...]:
    """Inverse dynamics and friction with an argument `widths`; none where no friction leaps."""
    found = [
        function
        for function in layout.dynamics_functions(model, beta, given)
        if function.role in ("inverse_dynamics", "friction")
    ]
    count = len(dict.fromkeys(widths("", model, found).values()))
    units = " or ".join(f"{unit}/s" for unit in given.q.unit.split(" or "))
    spec = ArgumentSpec("widths", (count,), units, "of sign(v) as tanh(v/width); 0: it leaps")
    return tuple(
        dataclasses.replace(
            function, unit=UNIT, role=f"{SMOOTH}{function.role}",
            inputs=(*function.inputs, spec),
        )
        for function in found if count
    )  # fmt: skip


def turning_joints(model: SymbolicModel, base: BaseParameters) -> list[str]:
    """Names of the joints, or motors, that `widths` are of, in its order."""
    beta = layout.beta_symbols(model, base)
    given = layout.arguments_of(model.robot.free, model, base)
    found = widths("", model, smooth_functions(model, beta, given))
    return [turning_joint(width) for width in dict.fromkeys(found.values())]


def turning_joint(width: Width) -> str:
    """Name of the joint, or motor, that a width is of."""
    return width.macro.partition("_COULOMB_WIDTH_")[2]
