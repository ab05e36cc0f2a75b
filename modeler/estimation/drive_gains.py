"""Drive gains from currents: a bare run, and a run with a load of known mass.

Gains and parameters are found together, by mixed total least squares with one gain for each drive.
The rows of drive j are g_j V = W beta + m w, with V the measured current, g_j its torque per unit
and w the torque of a known load, per unit of m = 1. V alone is noisy, so

    [-V_1 .. -V_n | W | w] X = 0,   X = [g_1 .. g_n | beta | m],

is no least-squares problem: with V on the right-hand side of nothing, X = 0 would solve it, and
with m w there, the noise of V pulls every gain to 0. X is the null vector of the matrix nearest to
it that has one, V changed and W not (mixed LS-TLS, Van Huffel and Vandewalle 1991, ch. 3; for
drive gains Gautier and Briot 2012). The load of known size sets the length of X. What a fit takes
for known, weights of loads and drive gains, is tested against the data.
"""

import contextlib
import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec, ModuleSpec
from modeler.core.table import format_percent
from modeler.estimation.covariance import ResidualAutocorrelation, estimate_hac_covariance
from modeler.estimation.identify import Equations, find_disconnected_joints, fit_equations
from modeler.estimation.least_squares import Estimate, Rows, solve_by_qr, solve_least_squares
from modeler.estimation.payload import (
    LoadedEquations,
    Payload,
    build_loaded_equations,
    find_heterogeneous_logs,
)
from modeler.estimation.result import FitResult, ParameterEstimate
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import (
    CompressedRegression,
    Rank,
    compute_triangle,
    find_independent_columns,
)
from modeler.regression import DataWarning, Log, LogReport, Observation
from modeler.runtime import CompiledModel

_KNOWN = "known weight"  # its column; no parameter is called so
_ADVICE = "record a livelier motion of all joints at once, bare and loaded, or a heavier load"


@dataclass(frozen=True, eq=False)
class GainEstimate:
    """Holds the solution; n joints, d of them driven, c columns.

    Attributes:
        gains: (n,) torque per unit of V; 1 for joints without a motor; NaN if nothing bounds them.
        beta: (c,) of all columns, with `known` at its place; 0 for those that were dropped.
        covariance: (d + c, d + c) of the gains of the driven joints and of beta, for white
            residuals; 0 for dropped columns and for the known one; its diagonal infinite where
            nothing bounds them.
        sigma: (n,) standard deviation of a row of each joint, N m or N.
        rank: columns kept and dropped.
        singular: (d,) singular values of what W leaves of V, descending, every column of V in
            units of its noise: a combination of currents that is all noise has 1.
        vague: (n,) shares of the drives in the combination of the last but one singular value.
        is_converged: weights and gains reached their fixed point.
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
        """Returns s[-2] / s[-1], singular values; infinite with one drive, or without noise."""
        last = self.singular[-2:]
        if len(last) < 2 or last[1] <= THRESHOLDS.tiny_share * last[0]:
            return float("inf")
        return float(last[0] / last[1])


def solve_mixed_tls(data: CompressedRegression, known: int) -> GainEstimate | None:
    """Returns gains and beta of diag(g) V = W beta; None if others reproduce the known column.

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
    rms = data.compute_torque_rms()
    units = np.where(data.free, 1.0, rms)
    scaled = _scale_torque(data, 1.0 / np.where(units > 0.0, units, 1.0))
    size = np.linalg.norm(data.triangles[:, :, :-1], axis=(1, 2)) + 1e-300
    whole = scaled.combine_joints(np.where(data.free & (rms == 0.0), size, 1.0))[:, :-1]
    rank = find_independent_columns(whole, data.names)
    others = [i for i in range(len(data.names)) if i != known]
    without = find_independent_columns(whole[:, others], [data.names[i] for i in others])
    if known not in rank.kept_columns or len(without.kept_columns) == len(rank.kept_columns):
        return None
    columns = np.asarray(rank.kept_columns, dtype=int)
    gains, is_converged, iterations = np.ones(len(units)), False, 0
    sigma = solve_least_squares(data).sigma
    while not is_converged and iterations < THRESHOLDS.max_variance_iterations:
        beta, updated, singular, vague = _solve_null_vector(data, columns, sigma, gains)
        length = 1.0 / beta[known] if beta[known] else 1.0
        beta, updated = length * beta, np.where(data.free, 1.0, length * updated)
        if not (np.isfinite(updated).all() and updated.all()):
            gains = np.full(len(gains), np.nan)  # nothing holds them: they run to 0, or away
            break
        is_converged = bool(np.all(np.abs(updated / gains - 1.0) < THRESHOLDS.weight_tolerance))
        gains, iterations = updated, iterations + 1
        right = _scale_torque(data, gains)  # the weighted fit of the others gives the sigmas
        right.triangles[:, :, -1] -= data.triangles[:, :, known]
        sigma = solve_least_squares(right.drop_columns([data.names[known]])).sigma
    covariance = _compute_covariance(data, columns, known, gains, beta, sigma)
    return GainEstimate(gains, beta, covariance, sigma, rank, singular, vague, is_converged)


def _combine_columns(
    data: CompressedRegression, columns: np.ndarray, sigma: np.ndarray, torque: np.ndarray
) -> np.ndarray:
    """Returns [W | V] over sigma: columns, then one for each drive with its torque (n, c + 1)."""
    driven, c = np.flatnonzero(~data.free), len(columns)
    combined = np.zeros((*data.triangles.shape[:2], c + len(driven)))
    combined[:, :, :c] = data.triangles[:, :, columns] / sigma[:, None, None]
    combined[driven, :, c + np.arange(len(driven))] = torque[driven]
    return combined.reshape(-1, combined.shape[2])


def _solve_null_vector(
    data: CompressedRegression, columns: np.ndarray, sigma: np.ndarray, gains: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Returns one mixed LS-TLS with given weights and given noise of the columns of V.

    The null vector, of any length, beta (c,) and gains (n,); singular (d,); vague (n,).
    """
    c, driven = len(columns), np.flatnonzero(~data.free)
    noise = np.abs(gains) / np.sqrt(np.maximum(data.rows, 1))
    torque = -data.triangles[:, :, -1] * noise[:, None] / sigma[:, None]
    combined = _combine_columns(data, columns, sigma, torque)
    lengths = np.linalg.norm(combined[:, :c], axis=0)
    combined[:, :c] /= lengths
    R = compute_triangle(combined)
    _, singular, right = np.linalg.svd(R[c:, c:])
    u = right[-1]
    new_gains, vague, beta = np.ones(len(gains)), np.zeros(len(gains)), np.zeros(len(data.names))
    new_gains[driven] = noise[driven] * u
    beta[columns] = -np.linalg.solve(R[:c, :c], R[:c, c:] @ u) / lengths
    vague[driven] = np.abs(right[-2]) if len(driven) > 1 else 0.0
    return beta, new_gains, singular, vague


def _scale_torque(data: CompressedRegression, gains: np.ndarray) -> CompressedRegression:
    """Returns the data with the right-hand side of joint j multiplied by gains[j]."""
    triangles = data.triangles.copy()
    triangles[:, :, -1] *= gains[:, None]
    return dataclasses.replace(data, triangles=triangles)


def _compute_covariance(
    data: CompressedRegression,
    columns: np.ndarray,
    known: int,
    gains: np.ndarray,
    beta: np.ndarray,
    sigma: np.ndarray,
) -> np.ndarray:
    """Returns (J^T S^-1 J)^-1, J = [-V | W], V without noise: W beta / g; without the known one.

    With the measured V in J, its noise would count as information.
    """
    d = int(np.sum(~data.free))
    columns = columns[columns != known]
    torque = -(data.triangles[:, :, :-1] @ beta) / gains[:, None] / sigma[:, None]
    R = compute_triangle(np.roll(_combine_columns(data, columns, sigma, torque), d, axis=1))
    places = np.concatenate([np.arange(d), d + columns])
    covariance = np.zeros((d + len(beta),) * 2)
    lengths = np.linalg.norm(R, axis=0)  # 0 for the gain of a joint whose torque is noise
    if not (np.isfinite(R).all() and lengths.all()) or np.linalg.cond(R / lengths) > 1e12:
        covariance[places, places] = np.inf
        return covariance
    _, root = solve_by_qr(R, np.zeros(len(R)))
    covariance[np.ix_(places, places)] = root @ root.T
    return covariance


@dataclass(frozen=True, eq=False)
class GainFit:
    """Holds drive gains and the fit with them.

    Attributes:
        gains: torque per drive unit, by joint, N m or N.
        sigmas: their standard deviations.
        result: with the torques that these gains make of the currents.
    """

    gains: Mapping[str, float]
    sigmas: Mapping[str, float]
    result: FitResult


def set_unit_gains(spec: ModuleSpec) -> ModuleSpec:
    """Returns the manifest with gain 1 where the robot file states none, to read logs with."""
    joints = tuple(
        dataclasses.replace(joint, drive_gain=1.0) if joint.drive_gain is None else joint
        for joint in spec.joints
    )
    return dataclasses.replace(spec, joints=joints)


def check_currents(logs: Sequence[Log], joints: Sequence[JointSpec]) -> None:
    """Checks that every motor's current is logged, or the duty that makes it.

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
    """Returns True if no torque of the logs was measured as a torque."""
    return not any(source.startswith("tau") for log in logs for source in log.torque_source)


def identify_gains(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> GainFit:
    """Returns one gain for each drive, base parameters and loads: g_j V = W beta + W_L chi_L.

    Gautier 2012, section 3; see `solve_mixed_tls`. Sigmas are those of gains and parameters
    together, raised for autocorrelated residuals; the error of the scale, which the load's mass
    sets, is not in them.

    Args:
        model: the robot, read with gains that are taken for starts: `set_unit_gains`.
        observation: of bare and loaded logs of currents, times these gains.
        payloads: at least one of known mass.

    Raises:
        DataError: no load of known mass, a current that is 0 throughout, or logs from which the
            gains are not identifiable; says by which figure.
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
    y = scaled.y - loaded.torques.sum(axis=1)
    equations = dataclasses.replace(loaded.equations, observation=scaled, y=y)
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
            "--method tls: the weight of the known load is not identifiable apart from parameters "
            f"of robot and load, so nothing sets the scale of the gains; {_ADVICE}"
        )
    if not np.isfinite(estimate.covariance).all():
        raise DataError(
            f"--method tls: the gain of joint {_find_worst_joints(observation, estimate)} has an "
            f"unbounded sigma, as where it rests; {_ADVICE}"
        )
    return estimate


def _find_driven(joints: Sequence[JointSpec]) -> list[int]:
    return [j for j, joint in enumerate(joints) if joint.actuated]


def _estimate_autocorrelation(
    observation: Observation, equations: Equations, estimate: GainEstimate
) -> ResidualAutocorrelation:
    """Returns what autocorrelated residuals do to the sigmas of gains and parameters."""
    driven, beta = _find_driven(observation.joints), estimate.beta[:-1]
    predicted = observation.y - equations.y + equations.W @ beta
    is_of_joint = observation.row_joint[:, None] == np.array(driven)
    currents = is_of_joint * (-predicted / estimate.gains[observation.row_joint])[:, None]
    J, values = np.column_stack([currents, equations.W]), estimate.gains[driven]
    values, residual = np.concatenate([values, beta]), equations.y - equations.W @ beta
    covariance, rank = estimate.covariance[:-1, :-1], estimate.rank
    settled = estimate.is_converged
    white = Estimate(values, covariance, estimate.sigma, rank, 0, settled, 0.0, 0.0, 0)
    every = np.ones(len(residual), dtype=bool)
    return estimate_hac_covariance(Rows(observation, J, residual + J @ values, every), white)


def _explain_ambiguity(
    observation: Observation, estimate: GainEstimate, autocorrelation: ResidualAutocorrelation
) -> str:
    """Returns why gains are not identifiable: no gap of singular values, or a large sigma."""
    driven = _find_driven(observation.joints)
    d, gap = len(driven), f"s[-2]/s[-1] = {estimate.gap:.4g}"
    factors = autocorrelation.factors[:d]
    share = factors * np.sqrt(np.diag(estimate.covariance)[:d]) / np.abs(estimate.gains[driven])
    rows = np.bincount(observation.row_joint, minlength=len(observation.joints))[driven]
    spread = float(factors.max()) * float(np.sqrt(2.0 / rows.min()))
    noise = 1.0 + THRESHOLDS.noise_gap_sigmas * spread
    if estimate.gap**2 < noise:
        names = _find_worst_joints(observation, estimate)
        return (
            f"--method tls: no gap between the singular values of the drive gains: {gap}, and "
            f"noise alone makes up to {noise**0.5:.4g}; least determined: joint {names}; {_ADVICE}"
        )
    if not np.all(share <= THRESHOLDS.max_gain_sigma):
        worst = int(np.argmax(np.where(np.isnan(share), np.inf, share)))
        return (
            f"--method tls: the gain of joint {observation.joints[driven[worst]].name} has a sigma "
            f"of {format_percent(share[worst])}, no better than a data sheet; expected at most "
            f"{format_percent(THRESHOLDS.max_gain_sigma)} ({gap}); {_ADVICE}"
        )
    return ""


def _find_worst_joints(observation: Observation, estimate: GainEstimate) -> str:
    order = np.argsort(-estimate.vague)
    worst = [j for j in order if estimate.vague[j] > 0.5 * estimate.vague[order[0]]]
    return ", ".join(observation.joints[j].name for j in worst[:3])


def _build_result(
    spec: ModuleSpec,
    fit: FitResult,
    estimate: GainEstimate,
    autocorrelation: ResidualAutocorrelation,
    loaded: LoadedEquations,
) -> GainFit:
    driven = _find_driven(spec.joints)
    d, c, factors = len(driven), len(fit.parameters), autocorrelation.factors
    covariance = estimate.covariance[:-1, :-1] * np.outer(factors, factors)
    sigma, gains = np.sqrt(np.diag(covariance)), {}
    for j, s in zip(driven, sigma[:d], strict=True):
        joint, start = spec.joints[j], spec.joints[j].drive_gain
        start = 1.0 if start is None else start
        name, unit = f"g_tau{joint.name}", f"{joint.effort_unit}/unit"
        value, deviation = start * float(estimate.gains[j]), abs(start) * float(s)
        gain = ParameterEstimate(name, unit, value, deviation, True, "estimated")
        gains[joint.name] = gain
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
        gains=tuple(gains.values()),
        singular_values=tuple(map(float, estimate.singular)),
        sentences=(*fit.sentences, *_describe_gains(estimate, loaded)),
    )
    sigmas = {name: gain.sigma or 0.0 for name, gain in gains.items()}
    return GainFit({name: gain.value for name, gain in gains.items()}, sigmas, result)


def _describe_gains(estimate: GainEstimate, loaded: LoadedEquations) -> list[str]:
    masses = ", ".join(f"{payload.mass:g} kg" for payload in loaded.weighed)
    lines = [
        f"the known load ({masses}) sets the scale: 1 % of its mass is 1 % of every drive gain and "
        "every parameter, beyond the sigmas"
    ]
    if len(estimate.singular) > 1:
        gap = f"{estimate.gap:.4g}" if np.isfinite(estimate.gap) else "infinite"
        values = ", ".join(f"{value:.4g}" for value in estimate.singular)
        lines.append(
            f"singular values of the currents beside the model: {values} (noise has 1); gap "
            f"s[-2]/s[-1] = {gap}"
        )
    if not estimate.is_converged:
        count = THRESHOLDS.max_variance_iterations
        lines.append(f"gains and weights have not converged after {count} iterations")
    return lines


def check_known_quantities(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload], currents: bool
) -> list[DataWarning]:
    """Returns warnings on known quantities that the logs contradict, each with the factor.

    First that a load sits alike in all its logs, and that all are of one robot; if not, nothing
    else is tested.

    Each is set free with all parameters: the mass of a load as the factor of its torques, drive
    gains as in `identify_gains`. It is contradicted if it is farther from what was given than
    so many of its own standard deviations, autocorrelation included, and a share of it.

    Args:
        model: the robot.
        observation: of bare and loaded logs.
        payloads: of which those of known mass are tested.
        currents: True if the torques are logged currents times the gains of the robot file.
    """
    lines = find_heterogeneous_logs(model, observation, payloads)
    if not lines and any(payload.mass is not None for payload in payloads):
        loaded = build_loaded_equations(model, observation, payloads)
        lines = _check_weights(observation, loaded, currents)
        if currents:
            with contextlib.suppress(DataError):  # unidentifiable gains contradict none
                gains = identify_gains(model, observation, payloads)
                if doubtful := describe_deviations(model.spec, gains, only_doubtful=True):
                    lines.append(
                        "by the weight of the load, the drive gains are not those of the robot "
                        f"file: {'; '.join(doubtful)}; check them, or use --method tls"
                    )
    return [DataWarning(line, affects_values=True, code="known_quantity") for line in lines]


def _check_weights(observation: Observation, loaded: LoadedEquations, currents: bool) -> list[str]:
    lines = []
    for i, payload in enumerate(loaded.weighed):
        if not loaded.can_identify_mass(i):
            continue
        # The factor on its torques that the logs ask for; 1 if its mass is right.
        column = loaded.torques[:, i]
        equations = loaded.equations.append_columns(column, ["factor"])
        equations = dataclasses.replace(equations, y=loaded.equations.y + column)
        fit = fit_equations(observation, equations, "weighted", noise_only=True)
        factor = fit.loads[-1]
        if factor.sigma is None or not _is_contradicted(factor.value, factor.sigma):
            continue
        stated = payload.mass or 0.0
        mass, sigma = factor.value * stated, factor.sigma * stated
        more = format_percent(abs(factor.value - 1.0))
        more += " more" if factor.value > 1.0 else " less"
        cause = f"all torques are logged {factor.value:.3g} times as large as they are, by wrong "
        cause += "drive gains in the controller"
        if currents:
            wrong = f"{1.0 / factor.value:.3g} times what the robot file says"
            cause = f"all drive gains are {wrong}; --method tls finds the gains"
        lines.append(
            f"payload {payload.name}: the logs say that it weighs {mass:.4g} +- {sigma:.1g} kg, "
            f"{more} than the {stated:g} kg given; check the weight, or {cause}"
        )
    return lines


def _is_contradicted(factor: float, sigma: float) -> bool:
    limit = max(THRESHOLDS.known_sigmas * sigma, THRESHOLDS.min_known_share)
    return abs(factor - 1.0) > limit


def describe_deviations(
    spec: ModuleSpec, gain_fit: GainFit, only_doubtful: bool = False
) -> list[str]:
    """Returns how far gains are from those of the robot file, a phrase for each that differs."""
    lines = []
    for joint in spec.joints:
        if (gain := gain_fit.gains.get(joint.name)) is None:
            continue
        sigma, stated = gain_fit.sigmas[joint.name], joint.drive_gain
        label = f"joint {joint.name} {gain:.4g} +- {sigma:.1g}"
        if stated is None or gain * stated < 0.0:
            if stated is None and gain >= 0.0:
                continue
            beside = "negative" if stated is None else f"of the other sign than {stated:.4g}"
            lines.append(
                f"{label}, {beside}: current{joint.name} or q{joint.name} has the wrong sign; if "
                "the log is wrong, give that column sign = -1 in [log]"
            )
        elif not only_doubtful or _is_contradicted(gain / stated, sigma / abs(stated)):
            share = gain / stated - 1.0
            side = "above" if share > 0.0 else "below"
            lines.append(f"{label}, {format_percent(abs(share))} {side} {stated:.4g}")
    return lines
