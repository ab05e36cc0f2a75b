"""What a fit found that physics does not allow, or that does not deserve trust: in sentences."""

from modeler.core.contract import BaseSpec, ModuleSpec
from modeler.fit.result import FitResult

_FAR = 3.0  # standard deviations below zero
_LITTLE = 0.3  # relative error above which a model does not describe its own data


def doubts(spec: ModuleSpec, result: FitResult) -> tuple[str, ...]:
    """Sentences on impossible values and on torques that the model does not describe.

    A base parameter cannot be negative if all its terms are parameters that cannot be, with
    coefficients that are not: friction, rotor inertias, moments of inertia, masses.
    """
    found = []
    possible = {parameter.name for parameter in spec.standard if parameter.nonnegative}
    for base, estimate in zip(spec.base, result.parameters, strict=True):
        far = estimate.sigma is not None and estimate.value < -_FAR * estimate.sigma
        if far and _nonnegative(base, possible):
            found.append(
                f"{base.name} = {estimate.value:.4g} {base.unit} is negative, which physics does "
                "not allow: a sign, a unit or the order of columns in the log may be wrong, or an "
                "effect is missing that this parameter stands in for"
            )
    for joint in result.joints:
        if joint.relative_error is not None and joint.relative_error > _LITTLE:
            found.append(
                f"joint {joint.name}: {100.0 * joint.relative_error:.0f} % of the torque is not "
                "described even on the data of the fit; check units, signs and columns of the log, "
                "the table, and the effects in the robot file"
            )
    return tuple(found)


def _nonnegative(base: BaseSpec, possible: set[str]) -> bool:
    return all(term.value >= 0.0 and term.parameter in possible for term in base.terms)
