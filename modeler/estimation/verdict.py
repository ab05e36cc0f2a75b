"""What a fit is valid for, why, and what to do: warnings, and the verdict of each joint."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
from scipy.special import chdtri

from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_joints, format_percent
from modeler.estimation import physical_consistency
from modeler.estimation.covariance import estimate_autocorrelation
from modeler.estimation.identify import (
    CrossValidation,
    Equations,
    build_base_equations,
    compress_all_rows,
    compute_errors,
    cross_validate,
    find_connected_rows,
)
from modeler.estimation.least_squares import solve_by_qr
from modeler.estimation.prior import build_prior
from modeler.estimation.result import (
    PREDICTED,
    FitResult,
    JointFit,
    JointVerdict,
    State,
    Use,
    Verdict,
    VerdictWarning,
    compute_friction_by_direction,
)
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics import least_squares
from modeler.regression import (
    MASKS,
    REST_TRAVEL,
    THRESHOLDS as REGRESSION,
    DataWarning,
    Observation,
    classify_rows,
    compute_model_torque,
    find_nearest_closed,
)
from modeler.runtime import CompiledModel

_CAUSES = {
    "no_motor": ("it has no motor", ""),
    "no_torque": ("no row was fitted", "; log its torque, or mark it passive (mu = 0)"),
    "little_motion": ("too little motion in these logs", "; record the motion of `modeler excite`"),
    "lack_of_fit": (
        f"fit error above {format_percent(THRESHOLDS.max_fit_error)}",
        "; check units, signs and columns, and run `modeler diagnose`",
    ),
    "few_rows": (
        f"cross-validated error above {format_percent(THRESHOLDS.max_cross_validated_error)}",
        "; record the motion of `modeler excite`",
    ),
}
"""Why a joint is doubtful or undetermined, in a few words, and what to do."""

_EARTH = 9.81  # m/s^2
_TIME_UNITS = {"milliseconds": 1e-3, "microseconds": 1e-6, "nanoseconds": 1e-9}
_TIME_UNITS |= {"minutes": 60.0, "hours": 3600.0}
_LOG_RATES = (20.0, 2e4)  # Hz; at which robots are logged


def find_joints_of_parameters(spec: ModuleSpec, names: Sequence[str]) -> tuple[str, ...]:
    """Returns joints that base or standard parameters belong to, in the order of the names."""
    row = {parameter.name: parameter.joint for parameter in spec.standard}
    row |= {base.name: row[base.column_of] for base in spec.base if base.column_of in row}
    return tuple(dict.fromkeys(row[name] for name in names if name in row))


def find_negative_values(spec: ModuleSpec, result: FitResult) -> list[DataWarning]:
    """Returns a warning on each value below zero that physics does not allow.

    A base parameter cannot be negative if all its terms are parameters that cannot be, with
    coefficients that are not: friction, rotor inertias, moments of inertia, masses.
    """
    possible = {parameter.name for parameter in spec.standard if parameter.nonnegative}
    return [
        DataWarning(
            f"{base.name} = {estimate.value:.4g} {base.unit} is negative, which physics does not "
            "allow; check signs, units and order of the columns, and run `modeler diagnose`",
            affects_values=True,
            joints=find_joints_of_parameters(spec, [base.name]),
            code="negative_value",
        )
        for base, estimate in zip(spec.base, result.parameters, strict=True)
        if estimate.sigma is not None
        and estimate.value < -THRESHOLDS.negative_sigmas * estimate.sigma
        and all(term.value >= 0.0 and term.parameter in possible for term in base.terms)
    ]


def _list_moving_joints(result: FitResult) -> list[JointFit]:
    """Returns joints with an error that move: at rest, dry friction is no error of the model."""
    floors = result.processing.speed_floors or {}
    moving = [joint for joint in result.joints if floors.get(joint.name) != float("inf")]
    return [joint for joint in moving if joint.relative_error is not None]


def find_lack_of_fit(result: FitResult) -> list[DataWarning]:
    """Returns a warning on each joint whose torque is not described even where it was fitted."""
    return [
        DataWarning(
            f"joint {joint.name}: {format_percent(joint.relative_error)} of the torque is not "
            "described, even on the data of the fit; check units, signs and columns of the log, "
            "the table and the effects; run `modeler diagnose`",
            is_certain=joint.relative_error > THRESHOLDS.half_variance_error,
            affects_values=True,
            joints=(joint.name,),
            code="lack_of_fit",
        )
        for joint in _list_moving_joints(result)
        if joint.relative_error is not None and joint.relative_error > THRESHOLDS.max_fit_error
    ]


def check_motion_noise(observation: Observation) -> list[DataWarning]:
    """Returns a warning if the predicted torque is noise even behind the lowest filters."""
    bands = observation.report.bands
    if bands.chatter_ratio_filtered <= REGRESSION.max_chatter_ratio:
        return []
    line = (
        f"above {bands.parallel_cutoff:g} Hz, the lowest cut-off that the motion allows, the "
        f"predicted torque has {bands.chatter_ratio_filtered:.2g} times the high-frequency content "
        "of the measured one: values may be biased towards zero; run `modeler diagnose`, move "
        "farther and faster, or measure positions more finely"
    )
    return [DataWarning(line, affects_values=True, code="motion_noise")]


def find_systematic_residuals(result: FitResult, systematic_share: np.ndarray) -> list[DataWarning]:
    """Returns a warning on joints whose residual is large and no noise.

    Args:
        result: of the fit.
        systematic_share: (n,) what of the residual is the same in the next row, rms over that of
            the torque.
    """
    moving = {joint.name for joint in _list_moving_joints(result)}
    large = {
        joint.name: float(share)
        for joint, share in zip(result.joints, systematic_share, strict=True)
        if share > THRESHOLDS.max_systematic_share
        and joint.name in moving
        and (joint.relative_error or 0.0) <= THRESHOLDS.max_fit_error  # else it is reported already
    }
    if not large:
        return []
    where, most = format_joints([*large]), format_percent(max(large.values()))
    line = (
        f"{where}: up to {most} of the torque is a residual that is no noise: an effect is "
        "missing, and values absorb it; run `modeler diagnose`"
    )
    joints = tuple(large)
    return [DataWarning(line, affects_values=True, joints=joints, code="systematic_residual")]


def find_unexplained_joints(
    result: FitResult, seen: CrossValidation, scale: np.ndarray
) -> list[DataWarning]:
    """Returns a warning on joints described worse on all rows than windows of them let expect.

    Relatively, and in N m too: where the windows show a faster motion, noise alone is a larger
    share of the other torques.

    Args:
        result: of all rows.
        seen: in the windows.
        scale: (n,) rms torque of all rows over that of the windows.
    """
    return [
        DataWarning(
            f"joint {joint.name}: fit error {format_percent(joint.relative_error)} on all rows, "
            f"{format_percent(error)} in the windows: some rows hold what the windows do not show; "
            "fit pieces, FILE@START:END, to find them",
            is_certain=True,
            joints=(joint.name,),
            code="unexplained_rows",
        )
        for joint, error, torque in zip(result.joints, seen.errors, scale, strict=True)
        if joint.relative_error is not None
        and joint.relative_error * min(1.0, float(torque)) > THRESHOLDS.max_window_ratio * error
    ]


def find_undetermined_parameters(
    spec: ModuleSpec, result: FitResult, spread: np.ndarray
) -> list[DataWarning]:
    """Returns warnings on parameters of which only sums with others are known.

    Args:
        spec: the robot.
        result: of the fit.
        spread: (c,) one standard deviation of each parameter, as torque over that of the joint
            where it is largest.
    """
    vague = [base.name for base, share in zip(spec.base, spread, strict=True) if share > 1.0]
    dropped = [p.name for p in result.parameters if p.sigma is None]

    def shorten(names: list[str]) -> str:
        return ", ".join(names[:5]) + (f" and {len(names) - 5} more" if len(names) > 5 else "")

    causes = {
        "practically unidentifiable, the standard deviation exceeds the joint's rms torque; record "
        "poses and accelerations that the logs lack": vague,
        "not identifiable from these data; record a motion that moves all joints over a wide "
        "range": dropped,
    }
    return [
        DataWarning(
            f"{shorten(names)}: {cause}",
            affects_values=True,
            joints=find_joints_of_parameters(spec, names),
            code="undetermined_parameters",
        )
        for cause, names in causes.items()
        if names
    ]


def check_time(
    model: CompiledModel, observation: Observation, result: FitResult
) -> list[DataWarning]:
    """Returns warnings on time steps that no log has, and on inertias of another unit of time.

    Accelerations scale with 1/time^2, gravity does not. With the time in milliseconds inertias
    come out a million times too large beside first moments: a joint with its links, inertia J and
    greatest gravity torque m, is a pendulum as long as J g / m, which is about as long as the
    links are, counterweights and rotors included. A hundred times the robot's reach, on all joints
    that gravity loads, is another unit of time.
    """
    warnings = []
    for log in observation.report.logs:
        step, is_slow = 1.0 / log.rate, 1.0 / log.rate > THRESHOLDS.max_time_step
        if is_slow or step < 1.0 / _LOG_RATES[1]:
            rates = {name: 1.0 / (step * seconds) for name, seconds in _TIME_UNITS.items()}
            low, high = _LOG_RATES
            likely = [name for name, rate in rates.items() if low <= rate <= high]
            why = "accelerations are not resolved" if is_slow else "faster than robots are logged"
            advice = (
                f"in {likely[0]}, the rate would be {rates[likely[0]]:.4g} Hz; multiply the column "
                f"time by {_TIME_UNITS[likely[0]]:g} if it is"
                if likely
                else "is the column time in seconds, or a count of rows? give seconds"
            )
            line = f"{log.name}: median time step {step:.3g} s, {why}: {advice}"
            warnings.append(DataWarning(line, is_slow, not is_slow, code="time_step"))
    ratio, density = _compute_pendulum(model, observation, result)
    if not warnings and ratio > THRESHOLDS.max_pendulum_ratio:
        line = (
            f"the clock seems to be wrong: the inertias are {ratio:.2g} times those of links of "
            f"this reach, as if all motion were {ratio**0.5:.2g} times as fast; check "
            "the time column, its unit and rate, and whether the lengths are in metres"
        )
        warnings.append(DataWarning(line, is_certain=True, code="clock"))
    elif density > THRESHOLDS.max_density and result.status != "rank deficient":
        line = (
            f"the links would weigh {density:.2g} kg for every cubic metre within its reach: "
            "the torques look like mN m, or the lengths are not in metres; give N m and metres"
        )
        warnings.append(DataWarning(line, is_certain=True, code="mass_density"))
    return warnings


def _compute_pendulum(
    model: CompiledModel, observation: Observation, result: FitResult
) -> tuple[float, float]:
    """Returns the least J g / m over the reach, over the joints that gravity loads; 0 if none.

    Of a slide J and m / g are masses, and the reach is none of it. And the mass that makes the
    largest inertia, over the cube of the reach, kg/m^3.
    """
    q = observation.q[:: max(1, len(observation.q) // THRESHOLDS.pendulum_poses)]
    nearest = find_nearest_closed(model, q)
    if nearest is None:
        return 0.0, 0.0
    q = np.ascontiguousarray(q[nearest])
    origins = model.forward_kinematics(q)[..., 3]
    reach = float(np.linalg.norm(origins[:, :, None] - origins[:, None], axis=-1).max())  # m
    if reach == 0.0:
        return 0.0, 0.0
    is_inertial = np.array([base.kind == "inertial" for base in model.spec.base])
    weight = np.abs(model.gravity(q, np.where(is_inertial, result.beta, 0.0))).max(axis=0)
    matrices = model.inertia_matrix(q, result.beta)
    inertia = np.median(np.abs(np.diagonal(matrices, axis1=1, axis2=2)), axis=0)
    torque = np.sqrt(np.mean(observation.torque**2, axis=0))
    length = np.array([reach if joint.unit == "rad" else 1.0 for joint in model.spec.joints])
    mass = np.maximum(inertia / length**2, weight / length / _EARTH)
    loaded = np.array([joint.actuated for joint in model.spec.joints])
    loaded &= (weight > THRESHOLDS.min_gravity_share * torque) & (weight > 0.0)
    swings = (inertia * _EARTH / np.where(loaded, weight, 1.0) / length)[loaded]
    swing = float(np.min(swings)) if loaded.any() else 0.0
    beyond = max(swing, 1.0)  # axes alone place the frames: links reach as far as they swing
    return swing, float(mass.max() / beyond**2 / (reach * beyond) ** 3)


def judge_fit(
    model: CompiledModel,
    observation: Observation,
    result: FitResult,
    log_warnings: Sequence[DataWarning] = (),
    equations: Equations | None = None,
    refit: Callable[[np.ndarray], np.ndarray] | None = None,
    data: least_squares.CompressedRegression | None = None,
) -> FitResult:
    """Returns the fit with its verdict.

    A joint is good if the fit predicts segments that are left out, and samples at low speed, with
    a small error, and in no fifth of the time with a large one; undetermined if it does not
    predict them, or if its channels are certainly wrong. A fit is valid for its parameters if all
    joints are good, a machine that could be built lies in the confidence region, the logs
    determine the values, and what is left of the torques is small or noise.

    Args:
        model: the robot.
        observation: that was fitted.
        result: of the fit.
        log_warnings: of other stages about the logs; a certain one makes its joints undetermined.
        equations: that were fitted; None: those of the bare robot.
        refit: how the fit is made without some samples; None: by least squares of the torques.
        data: all rows that were fitted, where the observation has a part of them only.
    """
    equations = equations or build_base_equations(observation)
    rows = find_connected_rows(observation)
    is_part, data = data is not None, data or equations.compress_rows(rows)
    sigma = np.array([joint.sigma for joint in result.joints])
    has_prior = any(parameter.prior for parameter in result.parameters)
    prior = build_prior(model.spec) if has_prior else None
    seen = cross_validate(equations, rows, sigma, refit, prior)
    warnings = [warning for warning in log_warnings if not warning.is_undetectable]
    possible = None
    if not any(warning.is_certain for warning in warnings):  # else the fit describes the fault
        warnings += [*check_time(model, observation, result), *check_motion_noise(observation)]
        warnings += find_lack_of_fit(result)
        if is_part:
            scale = _compute_torque_ratio(data, observation, rows)
            warnings += find_unexplained_joints(result, seen, scale)
        share = _estimate_systematic_share(equations, rows, result)
        warnings += find_systematic_residuals(result, share)
        for line in result.prior_conflicts:
            names = (j.name for j in result.joints if line.startswith(f"joint {j.name}: "))
            warnings.append(DataWarning(line, False, True, joints=tuple(names), code="prior"))
        spread = _compute_spread(data, result)
        if equations.torque_prior is not None:  # which bounds what the logs leave open
            weight = np.diag(equations.torque_prior)[: len(spread)]
            known = weight * np.sqrt(np.diag(result.covariance)) / THRESHOLDS.max_prior_share
            spread = np.maximum(spread, known)
        warnings += find_undetermined_parameters(model.spec, result, spread)
        impossible = _find_impossible(model.spec, result, data)
        possible = not impossible
        warnings += [*impossible, *find_negative_values(model.spec, result)]
        warnings += result.joint_warnings
    block, blocks = observation.row_sample, THRESHOLDS.time_blocks
    block = block * blocks // len(observation.time)
    every = [compute_errors(equations, seen.residual, rows & (block == k)) for k in range(blocks)]
    sampled = _compute_sample_errors(model, observation, result)
    errors = seen.errors, np.nan_to_num(every).max(axis=0), sampled
    by_joint = _judge_joints(warnings, observation, result, errors)
    text = _describe_prediction(equations, rows, result, seen, _list_predicted_joints(by_joint))
    verdict = dataclasses.replace(
        _write_verdict(warnings, by_joint, text),
        undetectable_faults=tuple(
            warning.line for warning in log_warnings if warning.is_undetectable
        ),
        physically_consistent=possible,
    )
    directions = compute_friction_by_direction(model.spec, result)
    return dataclasses.replace(result, verdict=verdict, directions=directions)


def _compute_sample_errors(
    model: CompiledModel, observation: Observation, result: FitResult
) -> np.ndarray:
    """Returns (n,) errors of the fit on all undamaged samples, those at low speed included.

    Rows are means of all samples, not of those that count: friction near standstill is what other
    motion meets, and no row of the fit. 0 with loads, which the model is without.
    """
    nothing = np.zeros(len(result.joints))
    if result.by_load:
        return nothing
    rows = observation.used | (classify_rows(observation) == MASKS.index("low speed"))
    whole = observation.select_rows(np.zeros_like(observation.used))
    torque = np.concatenate([part.filter_torque() for part in whole.stretches])
    left = torque - compute_model_torque(whole, model, result.beta)
    squares, total = (np.sum(x**2, axis=0, where=rows) for x in (left, torque))
    return np.sqrt(np.divide(squares, total, out=nothing, where=total > 0.0))


def _is_fault(warning: DataWarning) -> bool:
    """Returns True of what makes a prediction wrong, and not values alone."""
    return warning.is_certain and not warning.affects_values


def _judge_joints(
    warnings: Sequence[DataWarning],
    observation: Observation,
    result: FitResult,
    errors: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> dict[str, JointVerdict]:
    """Returns the state of each joint by its errors; faults of it and of the robot go before.

    Args:
        warnings: of all joints.
        observation: that was fitted.
        result: of the fit.
        errors: (n,) cross-validated, the same in the worst block of time, and on all samples.
    """
    names, verdicts = {joint.name for joint in result.joints}, {}
    general = [w for w in warnings if _is_fault(w) and not names & set(w.joints)]
    travel = np.ptp(observation.q, axis=0)
    for j, (joint, spec) in enumerate(zip(result.joints, observation.joints, strict=True)):
        about = [w for w in warnings if joint.name in w.joints]
        faults = [w for w in (*general, *about) if _is_fault(w)]
        error, worst, sampled = (float(x[j]) for x in errors)
        fit_error, rests = joint.relative_error, travel[j] < REST_TRAVEL[spec.unit]
        state, cause = _classify_errors(max(fit_error or 0.0, error), worst), ""
        if not spec.actuated:
            state, cause = "undetermined", "no_motor"
        elif faults:
            state, cause = "undetermined", faults[0].code
        elif fit_error is None:
            is_slow = rests or observation.torque[:, j].any()
            state, cause = "undetermined", "little_motion" if is_slow else "no_torque"
        elif rests:
            state, cause = "doubtful" if state == "good" else state, "little_motion"
        elif state == "undetermined":
            cause = "lack_of_fit" if fit_error > THRESHOLDS.max_fit_error else "few_rows"
        elif state == "good" and sampled > THRESHOLDS.max_sample_error:
            state, cause = "doubtful", "low_speed"
        parts = [f"fit error {format_percent(fit_error)}"]
        parts += [f"cross-validated error {format_percent(error)}"] * bool(np.isfinite(error))
        if worst > THRESHOLDS.max_block_error:
            parts.append(f"in a fifth of the time {format_percent(worst)}")
        if sampled > THRESHOLDS.max_sample_error:
            parts.append(f"error with low speeds {format_percent(sampled)}")
        first = faults[0].line if faults else _CAUSES.get(cause, (", ".join(parts),))[0]
        first = ", ".join(parts) if cause in ("lack_of_fit", "few_rows") else first
        lines = dict.fromkeys([first, *(warning.line for warning in about)])
        verdicts[joint.name] = JointVerdict(state, tuple(lines), cause)
    return verdicts


def _classify_errors(error: float, worst: float) -> State:
    """Returns the state of a joint by its error, and by that of the worst block of time."""
    if error > THRESHOLDS.max_cross_validated_error:
        return "undetermined"
    is_small = error <= THRESHOLDS.good_error and worst <= THRESHOLDS.max_block_error
    return "good" if is_small else "doubtful"


def _describe_prediction(
    equations: Equations,
    rows: np.ndarray,
    result: FitResult,
    seen: CrossValidation,
    names: Sequence[str],
) -> str:
    """Returns how well torques of some joints are predicted; no better than they are fitted."""

    def find_largest(errors: np.ndarray, joints: Sequence[JointFit]) -> str:
        pairs = zip(np.nan_to_num(errors), joints, strict=True)
        both = [max(float(e), j.relative_error or 0.0) for e, j in pairs if j.name in names]
        return format_percent(max(both, default=0.0))

    parts = [
        f"{find_largest(compute_errors(equations, seen.residual, part), joints)} {name}"
        for name, part in equations.select_conditions(rows).items()
        if (joints := result.by_load.get(name))
    ]
    errors = " and ".join(parts) or find_largest(seen.errors, result.joints)
    return f"cross-validated error at most {errors}"


def _compute_torque_ratio(
    data: least_squares.CompressedRegression, observation: Observation, rows: np.ndarray
) -> np.ndarray:
    """Returns (n,) rms torque of all rows over the observation's; 1 where either has none."""
    count = len(data.rows)
    joint, y = observation.row_joint[rows], observation.y[rows]
    here = np.sqrt(np.bincount(joint, y**2, count) / np.fmax(np.bincount(joint, None, count), 1))
    there = data.compute_torque_rms()
    both = (here > 0.0) & (there > 0.0)
    return np.where(both, there / np.where(both, here, 1.0), 1.0)


def find_contradictions(
    model: CompiledModel,
    observation: Observation,
    result: FitResult,
    log_warnings: Sequence[DataWarning] = (),
    data: least_squares.CompressedRegression | None = None,
) -> list[str]:
    """Returns why a fit is certainly not valid, other than for lack of data.

    A log that is too short for a fit of its own may still say something beside others.

    Args:
        model: the robot.
        observation: that was fitted.
        result: of the fit.
        log_warnings: of other stages about the logs.
        data: all rows that were fitted; None: those of the observation.
    """
    warnings = list(log_warnings)
    if not any(warning.is_certain for warning in warnings):
        warnings += [*check_time(model, observation, result), *find_lack_of_fit(result)]
        warnings += _find_impossible(model.spec, result, data or compress_all_rows(observation))
    return list(dict.fromkeys(warning.line for warning in warnings if warning.is_certain))


def _estimate_systematic_share(
    equations: Equations, rows: np.ndarray, result: FitResult
) -> np.ndarray:
    """Returns (n,) e_j sqrt(r_j(1)): relative error, and lag-1 autocorrelation of the residual."""
    observation, every = equations.observation, np.ones(len(rows), dtype=bool)
    residual = equations.compute_residual(_collect_values(result), every)
    shares = np.zeros(len(result.joints))
    for j, joint in enumerate(result.joints):
        part = rows & (observation.row_joint == j)
        if joint.relative_error is None or not part.any():
            continue
        sample = observation.row_sample[part]
        r = estimate_autocorrelation(residual[part], sample, observation.segment)
        if len(r) > 1 and r[1] > THRESHOLDS.filter_correlation:
            shares[j] = joint.relative_error * float(r[1]) ** 0.5
    return shares


def _collect_values(result: FitResult) -> np.ndarray:
    """Returns (c + loads,) of all columns that were fitted."""
    return np.append(result.beta, [load.value for load in result.loads])


def _compute_spread(data: least_squares.CompressedRegression, result: FitResult) -> np.ndarray:
    """Returns (c,) ||W_jc|| sigma_c / ||y_j|| of the joint where it is largest."""
    sigma = np.sqrt(np.diag(result.covariance))
    column = np.linalg.norm(data.triangles[:, :, : len(sigma)], axis=1)
    torque = data.compute_torque_norms()
    driven = torque > 0.0
    share = column[driven] * sigma / torque[driven, None]
    return np.asarray(share.max(axis=0, initial=0.0))


def _find_impossible(
    spec: ModuleSpec, result: FitResult, data: least_squares.CompressedRegression
) -> list[DataWarning]:
    """Returns a warning if no completion of the values is physically consistent."""
    machine, c = physical_consistency.define_physical_parameters(spec), len(result.beta)
    # A root of what the rows determine of the robot's parameters, whatever those of loads are.
    whole = data.combine_joints(np.array([joint.sigma for joint in result.joints]))
    loads = whole.shape[1] - 1 - c
    white = least_squares.compute_triangle(np.hstack([whole[:, c:-1], whole[:, :c]]))[
        loads:, loads:
    ]
    root = white / _estimate_sigma_factors(white, result)
    nearest = physical_consistency.project_parameters(machine, result.beta, root)
    degrees = max(1, np.linalg.matrix_rank(root))
    limit = float(chdtri(degrees, THRESHOLDS.chance_probability)) ** 0.5
    if nearest is None or nearest.distance <= limit:
        return []
    blamed = physical_consistency.attribute_distance(machine, result.beta, root, nearest.distance)
    names = [name if name in machine.positive else f"the mass of link {name}" for name in blamed]
    # Relative errors with both, and the joint that loses most.
    torque, values = data.compute_torque_norms(), _collect_values(result)
    driven = np.flatnonzero(torque > 0.0)
    moved = np.append(nearest.beta, values[c:])
    norms = (data.compute_residual_norms(beta)[driven] for beta in (values, moved))
    before, after = (norm / torque[driven] for norm in norms)
    worst = int(np.argmax(after - before))
    fit_error, error = float(before[worst]), float(after[worst])
    line = (
        f"not physically consistent: distance {nearest.distance:.3g} sigma (threshold "
        f"{limit:.2g}), mainly from {', '.join(names) or 'no single link'}"
    )
    if error >= THRESHOLDS.reported_error_ratio * fit_error:
        line += (
            f"; the nearest consistent parameters have a fit error of {format_percent(error)} on "
            f"joint {result.joints[driven[worst]].name}, not {format_percent(fit_error)}"
        )
    line += "; check signs, order and units of those channels, and run `modeler diagnose`"
    largest = max(THRESHOLDS.max_fit_error, THRESHOLDS.max_error_ratio * fit_error)
    joints = [j for name in blamed for j in find_joints_of_parameters(spec, [name]) or (name,)]
    is_certain, code = error > largest, "physical_consistency"
    return [DataWarning(line, is_certain, True, joints=tuple(joints), code=code)]


def _estimate_sigma_factors(white: np.ndarray, result: FitResult) -> np.ndarray:
    """Returns (c,) factors of the standard deviations over those of white residuals, 1 and more.

    All are the largest if columns were dropped: others carry their effect, and must go on to.
    """
    raised = np.sqrt(np.diag(result.covariance))
    names = [parameter.name for parameter in result.parameters]
    rank = least_squares.find_independent_columns(white, names)
    columns = np.intersect1d(np.flatnonzero(raised), rank.kept_columns)
    factors = np.ones(len(raised))
    if columns.size:
        _, root = solve_by_qr(white[:, columns], np.zeros(len(white)))
        factors[columns] = np.maximum(raised[columns] / np.linalg.norm(root, axis=1), 1.0)
    return factors if columns.size == len(factors) else np.full(len(factors), factors.max())


def _write_verdict(
    warnings: Sequence[DataWarning], by_joint: Mapping[str, JointVerdict], error: str
) -> Verdict:
    """Returns for what a fit is valid, and on which joints; `error` says how well it predicts."""
    entries = [
        VerdictWarning(warning.code, name, warning.line)
        for warning in warnings
        for name in (*(n for n in warning.joints if n in by_joint),) or (None,)
    ]
    lines = list(dict.fromkeys(warning.line for warning in warnings))
    fatal = [w.line for w in warnings if _is_fault(w) and not by_joint.keys() & set(w.joints)]
    valid = [name for name, one in by_joint.items() if one.state != "undetermined"]
    left_out = list[str]()
    for cause, names, text in _describe_left_joints(by_joint):
        left_out.append(text)
        entries += [VerdictWarning(cause, name, text) for name in names if cause in _CAUSES]
    reasons = [warning.line for warning in warnings if warning.affects_values]
    doubtful = {n: f"joint {n}, {x.why[0]}" for n, x in by_joint.items() if x.state == "doubtful"}
    reasons += [text for name, text in doubtful.items() if not by_joint[name].cause]
    use: Use = "prediction"
    if fatal or not valid:
        causes = {one.cause for one in by_joint.values()}
        explained = [w.line for w in warnings if w.is_certain or w.code in causes]
        use, line = "nothing", f"Not valid: {[*fatal, *explained, *left_out][0]}"
    elif left_out:
        where = format_joints(_list_predicted_joints(by_joint))
        parts = "; ".join([f"Valid for prediction on {where}", *left_out])
        line = f"{parts}. {error[:1].upper()}{error[1:]} on {where}."
    elif reasons:
        line = (
            f"Valid for torque prediction on similar motions only: {error} on every joint. "
            f"Individual parameters are not reliable: {reasons[0]}"
        )
    else:
        use, line = "parameters", f"Valid for torque prediction: {error} on every joint. "
        lines += doubtful.values()
        line += f"Note: {lines[0]}" if lines else "Parameters are physically consistent."
    return Verdict(use != "nothing", use, line, tuple(entries), (), by_joint)


def _list_predicted_joints(by_joint: Mapping[str, JointVerdict]) -> list[str]:
    """Returns the joints that are predicted; those at rest only where nothing moves."""
    valid = [name for name, one in by_joint.items() if one.state != "undetermined"]
    return [name for name in valid if by_joint[name].cause != "little_motion"] or valid


def _describe_left_joints(
    by_joint: Mapping[str, JointVerdict],
) -> Iterator[tuple[str, list[str], str]]:
    """Yields causes, the joints that are not predicted for each, and what, why and what to do."""
    groups: dict[tuple[str, str], list[str]] = {}
    for name, one in by_joint.items():
        if one.cause not in PREDICTED:
            why, remedy = _CAUSES.get(one.cause, (one.why[0].removeprefix(f"joint {name}: "), ""))
            groups.setdefault((one.cause, f"{one.state}: {why}{remedy}"), []).append(name)
    for (cause, text), names in groups.items():
        yield cause, names, f"{format_joints(names)} {text}"
