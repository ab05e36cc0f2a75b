"""Functions that take the widths of dry friction while they run, beside the parameters.

With beta they are what a parameter set of a controller holds; see templates/parameter_set.jinja.
"""

import dataclasses
from collections.abc import Mapping

from modeler.codegen import functions as layout
from modeler.codegen.fitted import Width, find_widths
from modeler.codegen.functions import Arguments, CFunction
from modeler.core.manifest import ArgumentSpec
from modeler.derivation import BaseParameters, Expr, SymbolicModel

UNIT = "_control"
"""C file of these functions, without the robot's name and `.c`."""

SMOOTH = "smooth_"
"""Start of their roles."""


def build_smooth_functions(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> tuple[CFunction, ...]:
    """Inverse dynamics and friction with an argument `find_widths`.

    None where no friction " "leaps.
    """
    functions = [
        function
        for function in layout.build_dynamics_functions(model, beta, arguments)
        if function.role in ("inverse_dynamics", "friction")
    ]
    count = len(dict.fromkeys(find_widths("", model, functions).values()))
    units = " or ".join(f"{unit}/s" for unit in arguments.q.unit.split(" or "))
    spec = ArgumentSpec("widths", (count,), units, "of sign(v) as tanh(v/width); 0: it leaps")
    return tuple(
        dataclasses.replace(
            function, unit=UNIT, role=f"{SMOOTH}{function.role}",
            inputs=(*function.inputs, spec),
        )
        for function in functions if count
    )  # fmt: skip


def list_turning_joints(model: SymbolicModel, base: BaseParameters) -> list[str]:
    """Names of the joints, or motors, that `find_widths` are of, in its order."""
    beta = layout.make_beta_symbols(model, base)
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    widths = find_widths("", model, build_smooth_functions(model, beta, arguments))
    return [get_turning_joint(width) for width in dict.fromkeys(widths.values())]


def get_turning_joint(width: Width) -> str:
    """Name of the joint, or motor, that a width is of."""
    return width.macro.partition("_COULOMB_WIDTH_")[2]
