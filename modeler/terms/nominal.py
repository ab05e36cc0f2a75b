"""Which base parameters are 0 at the nominal values: what printed models leave out."""

from dataclasses import replace

from modeler.base import BaseParameters
from modeler.core.errors import RobotError
from modeler.symbolic import SymbolicModel

_ROUNDING = 1e-12
"""Of the terms of a base parameter: what is left of those that cancel."""


def nonzero_base(model: SymbolicModel, base: BaseParameters) -> BaseParameters:
    """The base parameters that are not 0 at the nominal values of `[parameters]`.

    Parameters of effects stay: their values are rarely known beforehand. The formulas hold for any
    values of those that are left, the others being 0.

    Raises:
        RobotError: the robot file states no values of inertial parameters.
    """
    known, lengths = model.robot.parameters, model.geometry.values
    kept = []
    for parameter in base.parameters:
        sizes = []
        for term in parameter.terms:
            letters = {s: lengths[s.name] for s in term.coefficient.free_symbols}
            sizes.append(float(term.coefficient.subs(letters)) * known.get(term.parameter, 0.0))
        link = base.columns[parameter.column].kind == "inertial"
        if not link or abs(sum(sizes)) > _ROUNDING * sum(map(abs, sizes)):
            kept.append(parameter)
    if not any(base.columns[parameter.column].kind == "inertial" for parameter in kept):
        raise RobotError(
            f"robot {model.robot.name}: all inertial base parameters are 0 at its nominal values; "
            "state them in [parameters], or leave out --nonzero"
        )
    return replace(base, parameters=tuple(kept))
