"""From an observation to a fitted model."""

from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.fit.compressed import Compressed, compress
from modeler.fit.essential import Essential, essential_parameters
from modeler.fit.least_squares import MAX_ITERATIONS, Estimate, Method, least_squares
from modeler.fit.result import FitResult, JointFit, ParameterEstimate
from modeler.observation import Observation


@dataclass(frozen=True, eq=False)
class Equations:
    """y = W beta, row for row those of an observation; first the base parameters, then loads.

    Attributes:
        W: (rows, c + loads).
        y: (rows,) N m or N.
        names: (c + loads,) of the columns.
        units: (c + loads,) of the parameters.
        sentences: what a reader of the fit must know of them.
    """

    W: np.ndarray
    y: np.ndarray
    names: tuple[str, ...]
    units: tuple[str, ...]
    sentences: tuple[str, ...] = ()


def identify(observation: Observation, method: Method = "weighted") -> FitResult:
    """The least-squares fit of the base parameters to an observation.

    Parameters that the data cannot tell are set aside by name; the essential ones are marked.

    Args:
        observation: of one or several logs.
        method: "weighted" (per joint, iterated) or "ordinary".

    Raises:
        DataError: fewer rows than parameters.
    """
    return fit_equations(observation, base_equations(observation), method)


def base_equations(observation: Observation) -> Equations:
    """The equations of the bare robot."""
    return Equations(observation.W, observation.y, observation.names, observation.units)


def fit_equations(observation: Observation, equations: Equations, method: Method) -> FitResult:
    """The fit of y = W beta.

    Args:
        observation: says which row is which joint.
        equations: row for row those of the observation.
        method: as for `identify`.

    Raises:
        DataError: fewer rows than parameters.
    """
    _check_enough_rows(observation, equations)
    joints, count = len(observation.joints), len(observation.names)
    data = compress(equations.W, equations.y, observation.row_joint, joints, equations.names)
    estimate = least_squares(data, method)
    essential = essential_parameters(data, estimate, method)
    every = _parameters(estimate, essential, equations)
    return FitResult(
        robot=observation.robot,
        method=method,
        status=_status(estimate),
        samples=len(observation.time),
        rows=len(equations.y),
        condition_number=estimate.condition_number,
        condition_scaled=estimate.condition_scaled,
        relative_error=essential.error_before,
        essential_error=essential.error_after,
        joints=_joints(observation, data, estimate),
        parameters=every[:count],
        covariance=estimate.covariance[:count, :count],
        loads=every[count:],
        sentences=(*equations.sentences, *_sentences(estimate, essential)),
        processing=observation.report.processing,
    )


def _check_enough_rows(observation: Observation, equations: Equations) -> None:
    rows, columns = equations.W.shape
    if rows < columns:
        raise DataError(
            f"{', '.join(observation.logs)}: {rows} rows for {columns} parameters; record "
            "more motion, or filter less (a higher parallel_cutoff gives more rows)"
        )


def _parameters(
    estimate: Estimate, essential: Essential, equations: Equations
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
        for i, (name, unit) in enumerate(zip(equations.names, equations.units, strict=True))
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
