"""What of a fit goes into the C of a controller."""

from modeler.core.contract import FittedParameter, FittedSpec, ModuleSpec
from modeler.fit.model_file import IdentifiedModel


def fitted_spec(model: IdentifiedModel) -> FittedSpec:
    """The values of a model for `codegen.emit`: all parameters, as `compare` predicts with them.

    Parameters that were set aside are 0. Drive gains, fitted or not, are those of the robot file;
    they are left out unless every joint has one.
    """
    fit = model.fit
    verdict = fit.verdict
    return FittedSpec(
        method=fit.method,
        usable=None if verdict is None else verdict.usable,
        verdict="" if verdict is None else verdict.line,
        doubts=() if verdict is None else verdict.doubts,
        remarks=tuple(_remarks(model)),
        parameters=tuple(
            FittedParameter(p.name, p.unit, p.value, p.sigma, p.essential) for p in fit.parameters
        ),
        gains=_gains(model.spec),
    )


def _remarks(model: IdentifiedModel) -> list[str]:
    """Sentences on what the values are of."""
    fit = model.fit
    energy = "" if fit.energy is None else ", of the energies instead of the torques"
    told = [
        f"Values by the method {fit.method}{energy}, {fit.samples} samples, relative error "
        f"{100.0 * fit.relative_error:.3g} %."
    ]
    added = [
        step.effect if step.joint is None else f"{step.effect} (joint {step.joint})"
        for step in model.history
        if step.effect
    ]
    if added:
        told.append(f"Effects added since the first fit: {', '.join(added)}.")
    if fit.processing.delay:
        side = "before" if fit.processing.delay > 0.0 else "after"
        told.append(
            f"The torques of the logs stood {1e3 * abs(fit.processing.delay):.3g} ms {side} the "
            "motion that they belong to; the values are without that delay."
        )
    if fit.loads:
        loads = ", ".join(f"{load.name} {load.value:.6g} {load.unit}" for load in fit.loads)
        told.append(f"Without the load that some logs carried: {loads}.")
    return told


def _gains(spec: ModuleSpec) -> tuple[float, ...]:
    """Torque per drive unit, in the order of the joints; empty unless all are known."""
    known = [joint.drive_gain for joint in spec.joints if joint.drive_gain is not None]
    return tuple(known) if len(known) == len(spec.joints) else ()
