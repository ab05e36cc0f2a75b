"""Drive gains from currents: a bare run, and a run with a load of known mass.

Gains and parameters are found together, by mixed total least squares with one gain for each drive.
The rows of drive j are g_j V = W beta + m w, with V the measured current, g_j its torque per unit
and w the torque of a known load, per unit of m = 1. V alone is noisy, so

    [-V_1 .. -V_n | W | w] X = 0,   X = [g_1 .. g_n | beta | m],

is no least-squares problem: with V on the right-hand side of nothing, X = 0 would solve it, and
with m w there, the noise of V pulls every gain to 0. X is the null vector of the matrix nearest to
it that has one, V changed and W not (mixed LS-TLS, Van Huffel and Vandewalle 1991, ch. 3; for
drive gains Gautier and Briot 2012). The load of known size sets the length of X.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec, ModuleSpec
from modeler.core.table import format_percent
from modeler.estimation.covariance import ResidualAutocorrelation, estimate_hac_covariance
from modeler.estimation.doubts import find_heterogeneous_logs
from modeler.estimation.identify import Equations, find_disconnected_joints, fit_equations
from modeler.estimation.least_squares import Estimate, Rows, solve_by_qr, solve_least_squares
from modeler.estimation.payload import LoadedEquations, Payload, build_loaded_equations
from modeler.estimation.result import FitResult, ParameterEstimate
from modeler.numerics.least_squares import (
    CompressedRegression,
    Rank,
    compute_triangle,
    find_independent_columns,
)
from modeler.regression import Log, LogReport, Observation
from modeler.runtime import CompiledModel

MAX_ITERATIONS = 30  # a dozen is enough where the gains are told
_SETTLED = 1e-9  # relative change of the gains
_SMALLEST = 1e-12  # singular values below are rounding


@dataclass(frozen=True, eq=False)
class GainEstimate:
    """The solution; n joints, d of them driven, c columns.

    Attributes:
        gains: (n,) torque per unit of V; 1 for joints without a motor; NaN if nothing bounds them.
        beta: (c,) of all columns, with `known` at its place; 0 for those set aside.
        covariance: (d + c, d + c) of the gains of the driven joints and of beta, for white
            residuals; 0 for columns set aside and for the known one; its diagonal infinite where
            nothing bounds them.
        sigma: (n,) standard deviation of a row of each joint, N m or N.
        rank: columns kept and set aside.
        singular: (d,) singular values of what W leaves of V, descending, every column of V in
            units of its noise: a combination of currents that is all noise has 1.
        vague: (n,) shares of the drives in the combination of the last but one singular value.
        settled: weights and gains reached their fixed point.
    """

    gains: np.ndarray
    beta: np.ndarray
    covariance: np.ndarray
    sigma: np.ndarray
    rank: Rank
    singular: np.ndarray
    vague: np.ndarray
    is_converged: bool

    @property
    def gap(self) -> float:
        """s[-2] / s[-1]; infinite with one drive, or without noise."""
        if len(self.singular) < 2 or self.singular[-1] <= _SMALLEST * self.singular[-2]:
            return float("inf")
        return float(self.singular[-2] / self.singular[-1])


def solve_mixed_tls(data: CompressedRegression, known: int) -> GainEstimate | None:
    """Gains and beta of diag(g) V = W beta; None if W cannot tell the known column from others.

    QR takes the columns without noise away, [W | -V] = Q [R11 R12; 0 R22]; the gains are the
    smallest right singular vector of R22, and beta = -R11^-1 R12 g. Rows of drive j are divided by
    the standard deviation sigma_j of its residual, and column j of V by that of its own noise,
    sigma_j / g_j: both are iterated. At the fixed point g and beta are those of greatest
    likelihood for white noise of V (its equations are r_j^T V_j g_j = r_j^T r_j, r = g V - W beta),
    and the result does not depend on the units of the drives.

    Args:
        data: compressed rows of W and V; W includes the column of the known load.
        known: index of that column, whose parameter is 1.
    """
    units = np.where(data.free, 1.0, data.compute_torque_rms())
    scaled = _scale_torque(data, 1.0 / np.where(units > 0.0, units, 1.0))
    size = np.linalg.norm(data.triangles[:, :, :-1], axis=(1, 2)) + 1e-300
    sigma = np.where(data.free & (data.compute_torque_rms() == 0.0), size, 1.0)
    whole = scaled.combine_joints(sigma)[:, :-1]
    rank = find_independent_columns(whole, data.names)
    others = [i for i in range(len(data.names)) if i != known]
    without = find_independent_columns(whole[:, others], [data.names[i] for i in others])
    if known not in rank.kept_columns or len(without.kept_columns) == len(rank.kept_columns):
        return None
    kept_columns = np.asarray(rank.kept_columns, dtype=int)
    gains, settled, iterations = np.ones(len(units)), False, 0
    sigma = solve_least_squares(data).sigma
    while not settled and iterations < MAX_ITERATIONS:
        beta, updated, singular, vague = _solve_null_vector(data, kept_columns, sigma, gains)
        length = 1.0 / beta[known] if beta[known] else 1.0
        beta, updated = length * beta, np.where(data.free, 1.0, length * updated)
        if not (np.isfinite(updated).all() and updated.all()):
            gains = np.full(len(gains), np.nan)  # nothing holds them: they run to 0, or away
            break
        settled = bool(np.all(np.abs(updated / gains - 1.0) < _SETTLED))
        gains, iterations = updated, iterations + 1
        sigma = _estimate_sigma(data, gains, known)
    covariance = _compute_covariance(data, kept_columns, known, gains, beta, sigma)
    return GainEstimate(gains, beta, covariance, sigma, rank, singular, vague, settled)


def _combine_columns(
    data: CompressedRegression, kept_columns: np.ndarray, sigma: np.ndarray, torque: np.ndarray
) -> np.ndarray:
    """[W | V] over sigma: kept columns, then one for each drive with its torque (n, c + 1)."""
    driven, c = np.flatnonzero(~data.free), len(kept_columns)
    stacked = np.zeros((*data.triangles.shape[:2], c + len(driven)))
    stacked[:, :, :c] = data.triangles[:, :, kept_columns] / sigma[:, None, None]
    stacked[driven, :, c + np.arange(len(driven))] = torque[driven]
    return stacked.reshape(-1, stacked.shape[2])


def _solve_null_vector(
    data: CompressedRegression, kept_columns: np.ndarray, sigma: np.ndarray, gains: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """One mixed LS-TLS with given weights and given noise of the columns of V.

    Returns the null vector, of any length, beta (c,) and gains (n,); singular (d,); vague (n,).
    """
    n, c = len(data.rows), len(kept_columns)
    driven = np.flatnonzero(~data.free)
    noise = np.abs(gains) / np.sqrt(np.maximum(data.rows, 1))
    torque = -data.triangles[:, :, -1] * noise[:, None] / sigma[:, None]
    stacked = _combine_columns(data, kept_columns, sigma, torque)
    lengths = np.linalg.norm(stacked[:, :c], axis=0)
    stacked[:, :c] /= lengths
    R = compute_triangle(stacked)
    _, singular, right = np.linalg.svd(R[c:, c:])
    u = right[-1]
    new_gains, beta = np.ones(n), np.zeros(len(data.names))
    new_gains[driven] = noise[driven] * u
    beta[kept_columns] = -np.linalg.solve(R[:c, :c], R[:c, c:] @ u) / lengths
    vague = np.zeros(n)
    vague[driven] = np.abs(right[-2]) if len(driven) > 1 else 0.0
    return beta, new_gains, singular, vague


def _scale_torque(data: CompressedRegression, gains: np.ndarray) -> CompressedRegression:
    """The data with the right-hand side of joint j multiplied by gains[j]."""
    triangles = data.triangles.copy()
    triangles[:, :, -1] *= gains[:, None]
    return CompressedRegression(data.names, triangles, data.rows, data.free)


def _estimate_sigma(data: CompressedRegression, gains: np.ndarray, known: int) -> np.ndarray:
    """(n,) standard deviation of the rows with these gains, of the weighted fit of the others."""
    right = _scale_torque(data, gains)
    right.triangles[:, :, -1] -= data.triangles[:, :, known]
    return solve_least_squares(right.drop_columns([data.names[known]])).sigma


def _compute_covariance(
    data: CompressedRegression,
    kept_columns: np.ndarray,
    known: int,
    gains: np.ndarray,
    beta: np.ndarray,
    sigma: np.ndarray,
) -> np.ndarray:
    """(J^T S^-1 J)^-1 with J = [-V | W], V without its noise: W beta / g; the known one left out.

    With the measured V in J, its noise would count as information.
    """
    driven = np.flatnonzero(~data.free)
    d = len(driven)
    kept_columns = kept_columns[kept_columns != known]
    torque = -(data.triangles[:, :, :-1] @ beta) / gains[:, None] / sigma[:, None]
    R = compute_triangle(np.roll(_combine_columns(data, kept_columns, sigma, torque), d, axis=1))
    places = np.concatenate([np.arange(d), d + kept_columns])
    covariance = np.zeros((d + len(beta),) * 2)
    lengths = np.linalg.norm(R, axis=0)  # 0 for the gain of a joint whose torque is noise
    if not (np.isfinite(R).all() and lengths.all()) or np.linalg.cond(R / lengths) > 1e12:
        covariance[places, places] = np.inf
        return covariance
    _, root = solve_by_qr(R, np.zeros(len(R)))
    covariance[np.ix_(places, places)] = root @ root.T
    return covariance


# Drive gains from the currents of bare and of loaded runs.


LOOSE = 0.1
"""Share of a gain that its sigma may be; beyond, a maker's data sheet is as good."""

_FAR = 5.0  # standard deviations of a singular value of noise
_KNOWN = "known weight"  # its column; no parameter is called so
_MORE = (
    "record a motion that is livelier and moves all joints at once, bare and loaded, or a heavier "
    "load"
)


@dataclass(frozen=True, eq=False)
class GainFit:
    """Drive gains and the fit with them.

    Attributes:
        gains: torque per drive unit, by joint, N m or N.
        sigmas: their standard deviations.
        result: with the torques that these gains make of the currents.
    """

    gains: Mapping[str, float]
    sigmas: Mapping[str, float]
    result: FitResult


def set_unit_gains(spec: ModuleSpec) -> ModuleSpec:
    """The manifest to read logs with before gains are known: 1 where the robot file states none."""
    joints = tuple(
        dataclasses.replace(joint, drive_gain=1.0) if joint.drive_gain is None else joint
        for joint in spec.joints
    )
    return dataclasses.replace(spec, joints=joints)


def check_currents(logs: Sequence[Log], joints: Sequence[JointSpec]) -> None:
    """Nothing, if every motor's current is logged, or the duty that makes it.

    Raises:
        DataError: a log gives a torque instead; names it.
    """
    for log in logs:
        for joint, source in zip(joints, log.torque_source, strict=True):
            if joint.actuated and not source.startswith(("current", "duty")):
                raise DataError(
                    f"{log.name}: got {source}, a torque; --method tls finds the gain of each "
                    f"drive and expects its current in drive units; log current{joint.name}, or "
                    "use another --method"
                )


def are_currents(logs: Sequence[Log | LogReport]) -> bool:
    """True if no torque of the logs was measured as a torque."""
    return not any(source.startswith("tau") for log in logs for source in log.torque_source)


def identify_gains(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> GainFit:
    """One gain for each drive, base parameters and loads: g_j V = W beta + W_L chi_L.

    Gautier 2012, section 3; see `solve_mixed_tls`). Sigmas are those of gains and parameters
    together, raised for residuals that remember; the error of the scale, which the load's mass
    sets, is not in them.

    Args:
        model: the robot, read with gains that are taken for starts: `set_unit_gains`.
        observation: of bare and loaded logs of currents, times these gains.
        payloads: at least one of known mass.

    Raises:
        DataError: no load of known mass, a current that is 0 throughout, or logs that do not tell
            the gains; says by which figure.
    """
    loaded = build_loaded_equations(model, observation, payloads)
    if not loaded.weighed:
        raise DataError(
            "--method tls: no load of known mass, and without one all gains and all parameters may "
            "be larger by one factor; weigh the load of the --payload-log and give --payload-mass"
        )
    if dead := find_disconnected_joints(observation):
        names = ", ".join(observation.joints[j].name for j in dead)
        raise DataError(
            f"joint {names}: the current is 0 in every row, so no gain can be found; is it "
            "connected? if the joint has no motor, mark it passive in the robot file (mu = 0)"
        )
    estimate = _estimate_gains(observation, loaded)
    scaled = dataclasses.replace(observation, torque=observation.torque * estimate.gains)
    equations = dataclasses.replace(loaded.equations, y=scaled.y - loaded.torques.sum(axis=1))
    fit = fit_equations(scaled, equations, "weighted")
    autocorrelation = _estimate_autocorrelation(scaled, equations, estimate)
    if why := _explain_ambiguity(observation, estimate, autocorrelation):
        raise DataError("; ".join([why, *find_heterogeneous_logs(model, observation, payloads)]))
    return _build_result(model.spec, fit, estimate, autocorrelation, loaded)


def _estimate_gains(observation: Observation, loaded: LoadedEquations) -> GainEstimate:
    equations = loaded.equations.append_columns(loaded.torques.sum(axis=1), [_KNOWN])
    rows, columns = len(observation.y), len(equations.names)
    if rows < columns + len(observation.joints):
        raise DataError(
            f"{', '.join(observation.logs)}: {rows} rows for {columns} parameters "
            f"and {len(observation.joints)} gains; record more motion"
        )
    data = equations.compress_rows(np.ones(rows, dtype=bool))
    estimate = solve_mixed_tls(data, known=columns - 1)
    if estimate is None:
        raise DataError(
            "--method tls: the weight of the known load cannot be told from the robot's own "
            "parameters, or from the load's inertia, in these logs, so nothing sets the scale of "
            f"the gains; {_MORE}"
        )
    if not np.isfinite(estimate.covariance).all():
        raise DataError(
            f"--method tls: the gain of joint {_find_worst_joints(observation, estimate)} has a "
            "sigma without "
            f"bound, as where it rests; {_MORE}"
        )
    return estimate


def _estimate_autocorrelation(
    observation: Observation, equations: Equations, estimate: GainEstimate
) -> ResidualAutocorrelation:
    """What memory of the residuals does to the sigmas of gains and parameters."""
    driven = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    predicted = observation.y - equations.y + equations.W @ estimate.beta[:-1]
    is_of_joint = observation.row_joint[:, None] == np.array(driven)
    J = np.column_stack(
        [is_of_joint * (-predicted / estimate.gains[observation.row_joint])[:, None], equations.W]
    )
    values = np.concatenate([estimate.gains[driven], estimate.beta[:-1]])
    residual = equations.y - equations.W @ estimate.beta[:-1]
    white = Estimate(
        values, estimate.covariance[:-1, :-1], estimate.sigma, estimate.rank,
        0, estimate.is_converged, 0.0, 0.0, 0,
    )  # fmt: skip
    every = np.ones(len(residual), dtype=bool)
    return estimate_hac_covariance(Rows(observation, J, residual + J @ values, every), white)


def _explain_ambiguity(
    observation: Observation, estimate: GainEstimate, autocorrelation: ResidualAutocorrelation
) -> str:
    """Why the logs do not tell the gains apart: no gap of singular values, or a large sigma."""
    driven = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    d = len(driven)
    sigma = autocorrelation.factors[:d] * np.sqrt(np.diag(estimate.covariance)[:d])
    share = sigma / np.abs(estimate.gains[driven])
    rows = np.bincount(observation.row_joint, minlength=len(observation.joints))[driven]
    noise = 1.0 + _FAR * float(autocorrelation.factors[:d].max()) * float(np.sqrt(2.0 / rows.min()))
    if estimate.gap**2 < noise:
        names = _find_worst_joints(observation, estimate)
        return (
            f"--method tls: no gap between the singular values that tell the drive gains: the last "
            f"two are {_format_values(estimate.singular[-2:])}, s[-2]/s[-1] = {estimate.gap:.4g}, "
            "and "
            f"noise alone makes up to {noise**0.5:.4g}; least told: joint {names}; {_MORE}"
        )
    if not np.all(share <= LOOSE):
        worst = int(np.argmax(np.where(np.isnan(share), np.inf, share)))
        return (
            f"--method tls: the gain of joint {observation.joints[driven[worst]].name} has a sigma "
            f"of {format_percent(share[worst])}, no better than a data sheet; expected at most "
            f"{format_percent(LOOSE)} (s[-2]/s[-1] = {estimate.gap:.4g}); {_MORE}"
        )
    return ""


def _find_worst_joints(observation: Observation, estimate: GainEstimate) -> str:
    order = np.argsort(-estimate.vague)
    worst = [j for j in order if estimate.vague[j] > 0.5 * estimate.vague[order[0]]]
    return ", ".join(observation.joints[j].name for j in worst[:3])


def _format_values(values: np.ndarray) -> str:
    return ", ".join(f"{value:.4g}" for value in values)


def _build_result(
    spec: ModuleSpec,
    fit: FitResult,
    estimate: GainEstimate,
    autocorrelation: ResidualAutocorrelation,
    loaded: LoadedEquations,
) -> GainFit:
    driven = [j for j, joint in enumerate(spec.joints) if joint.actuated]
    d, c = len(driven), len(fit.parameters)
    covariance = estimate.covariance[:-1, :-1] * np.outer(
        autocorrelation.factors, autocorrelation.factors
    )
    sigma = np.sqrt(np.diag(covariance))
    starts = [1.0 if (gain := spec.joints[j].drive_gain) is None else gain for j in driven]
    gains = tuple(
        ParameterEstimate(
            f"g_tau{spec.joints[j].name}", f"{spec.joints[j].effort_unit}/unit",
            start * float(estimate.gains[j]), abs(start) * float(s), True, "estimated",
        )
        for j, start, s in zip(driven, starts, sigma[:d], strict=True)
    )  # fmt: skip
    values = [
        p if p.sigma is None else dataclasses.replace(p, sigma=float(s))
        for p, s in zip((*fit.parameters, *fit.loads), sigma[d:], strict=True)
    ]
    result = dataclasses.replace(
        fit,
        method="tls",
        status=fit.status if estimate.is_converged else "not settled",
        parameters=tuple(values[:c]),
        loads=tuple(values[c:]),
        covariance=covariance[d : d + c, d : d + c],
        gains=gains,
        singular_values=tuple(map(float, estimate.singular)),
        sentences=(*fit.sentences, *_describe_gains(estimate, loaded)),
    )
    names = [spec.joints[j].name for j in driven]
    return GainFit(
        {name: gain.value for name, gain in zip(names, gains, strict=True)},
        {name: gain.sigma or 0.0 for name, gain in zip(names, gains, strict=True)},
        result,
    )


def _describe_gains(estimate: GainEstimate, loaded: LoadedEquations) -> list[str]:
    masses = ", ".join(f"{payload.mass:g} kg" for payload in loaded.weighed)
    said = [
        f"the known load ({masses}) sets the scale: 1 % of its mass is 1 % of every drive gain and "
        "every parameter, beyond the sigmas"
    ]
    if len(estimate.singular) > 1:
        gap = f"{estimate.gap:.4g}" if np.isfinite(estimate.gap) else "infinite"
        said.append(
            "singular values of the currents beside the model: "
            f"{_format_values(estimate.singular)} "
            f"(noise has 1); gap s[-2]/s[-1] = {gap}"
        )
    if not estimate.is_converged:
        said.append(f"gains and weights still change after {MAX_ITERATIONS} iterations")
    return said
