"""From an observation to a fitted model."""

from collections.abc import Sequence

import numpy as np

from modeler.core.errors import DataError
from modeler.fit.compressed import Compressed, compress
from modeler.fit.essential import Essential, essential_parameters, relative_error
from modeler.fit.least_squares import MAX_ITERATIONS, Estimate, Method, least_squares
from modeler.fit.result import FitResult, JointFit, ParameterEstimate
from modeler.observation import Observation


def identify(observation: Observation, method: Method = "weighted") -> FitResult:
    """The least-squares fit of the base parameters to an observation.

    Parameters that the data cannot tell are set aside by name; the essential ones are marked.

    Args:
        observation: of one or several logs.
        method: "weighted" (per joint, iterated) or "ordinary".

    Raises:
        DataError: fewer rows than parameters.
    """
    names = observation.names
    return fit_columns(observation, observation.W, observation.y, names, observation.units, method)


def fit_columns(
    observation: Observation,
    W: np.ndarray,
    y: np.ndarray,
    names: Sequence[str],
    units: Sequence[str],
    method: Method,
    sentences: Sequence[str] = (),
) -> FitResult:
    """The fit of y = W beta, where the first columns of W are the base parameters.

    Args:
        observation: says which row is which joint.
        W: (rows, c + loads).
        y: (rows,).
        names: of all columns; those beyond the base parameters belong to loads.
        units: of all columns.
        method: as for `identify`.
        sentences: remarks to pass on.

    Raises:
        DataError: fewer rows than parameters.
    """
    if len(y) < len(names):
        raise DataError(
            f"{', '.join(observation.logs)}: {len(y)} rows for {len(names)} parameters; record "
            "more motion, or filter less (a higher parallel_cutoff gives more rows)"
        )
    data = compress(W, y, observation.row_joint, len(observation.joints), names)
    estimate = least_squares(data, method)
    essential = essential_parameters(data, estimate, method)
    every = _parameters(estimate, essential, names, units)
    count = len(observation.names)
    return FitResult(
        robot=observation.robot,
        method=method,
        status=_status(estimate),
        samples=len(observation.time),
        rows=len(y),
        condition_number=estimate.condition_number,
        condition_scaled=estimate.condition_scaled,
        relative_error=relative_error(data, estimate.beta),
        essential_error=essential.error_after,
        joints=_joints(observation, data, estimate),
        parameters=every[:count],
        covariance=estimate.covariance[:count, :count],
        loads=every[count:],
        sentences=(*sentences, *_sentences(estimate, essential)),
        processing=observation.report.processing,
    )


def _parameters(
    estimate: Estimate, essential: Essential, names: Sequence[str], units: Sequence[str]
) -> tuple[ParameterEstimate, ...]:
    kept, needed = set(estimate.rank.kept), set(essential.names)
    sigma = np.sqrt(np.diag(estimate.covariance))
    return tuple(
        ParameterEstimate(
            name=name,
            unit=unit,
            value=float(estimate.beta[i]),
            sigma=float(sigma[i]) if i in kept else None,
            essential=name in needed,
            status="estimated" if i in kept else "set aside",
        )
        for i, (name, unit) in enumerate(zip(names, units, strict=True))
    )


def _joints(observation: Observation, data: Compressed, estimate: Estimate) -> tuple[JointFit, ...]:
    residual, torque = data.residual_norms(estimate.beta), data.torque_norms()
    return tuple(
        JointFit(
            name=joint.name,
            unit=joint.effort_unit,
            rows=int(data.rows[j]),
            relative_error=float(residual[j] / torque[j]) if torque[j] > 0.0 else None,
            rms=float(residual[j] / np.sqrt(max(1, data.rows[j]))),
            sigma=float(estimate.sigma[j]),
        )
        for j, joint in enumerate(observation.joints)
    )


def _status(estimate: Estimate) -> str:
    if estimate.rank.aside:
        return "rank deficient"
    return "ok" if estimate.settled else "not settled"


def _sentences(estimate: Estimate, essential: Essential) -> list[str]:
    said = [tangle.sentence() for tangle in estimate.rank.aside]
    if not estimate.settled:
        said.append(
            f"the joint weights still change after {MAX_ITERATIONS} iterations; "
            'record more rows, or use method "ordinary"'
        )
    return [*said, essential.sentence()]
