"""What a fit is valid for, why, and what to do: how a fit ends."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from scipy.special import chdtri

from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_percent
from modeler.estimation import doubts
from modeler.estimation.covariance import estimate_autocorrelation
from modeler.estimation.doubts import LITTLE, WIDE
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
from modeler.estimation.nearest_body import (
    attribute_distance,
    define_physical_parameters,
    project_parameters,
)
from modeler.estimation.prior import build_prior
from modeler.estimation.result import (
    FitResult,
    JointFit,
    JointVerdict,
    Verdict,
    compute_friction_by_direction,
)
from modeler.numerics.least_squares import (
    CompressedRegression,
    compute_triangle,
    find_independent_columns,
)
from modeler.regression import DataWarning, Observation, find_nearest_closed
from modeler.runtime import CompiledModel

# Is the time of the logs in seconds? The clock that a robot carries with it is gravity.


SLOW = 0.2
"""s; with fewer than five rows a second neither accelerations nor reversals are seen."""

ABSURD = 100.0
"""Length of the pendulum that a joint and its links swing like, over the reach of the robot."""

HEAVY = 3000.0
"""kg/m^3: mass of the links over the cube of the robot's reach; that of robots is 5 to 500."""

LOADED = 0.1
"""Gravity over torque of a joint, from which on it swings."""

_GRAVITY = 9.81  # m/s^2
_POSES = 40
_UNITS = (("milliseconds", 1e-3), ("microseconds", 1e-6), ("nanoseconds", 1e-9), ("minutes", 60.0),
          ("hours", 3600.0))  # fmt: skip
_USUAL = (20.0, 2e4)  # Hz; rates at which robots are logged


def check_time(
    model: CompiledModel, observation: Observation, result: FitResult
) -> list[DataWarning]:
    """Time steps that no log of a robot has, and inertias that belong to another unit of time.

    Accelerations scale with 1/time^2, gravity does not. With the time in milliseconds inertias
    come out a million times too large beside first moments: a joint with its links, inertia J and
    greatest gravity torque m, is a pendulum as long as J g / m, which is about as long as the
    links are, counterweights and rotors included. A hundred times the robot's reach, on all joints
    that gravity loads, is another unit of time.
    """
    warnings = []
    for log in observation.report.logs:
        step = 1.0 / log.rate
        if step > SLOW or step < 1.0 / _USUAL[1]:
            what = (
                "with which neither accelerations nor reversals are seen"
                if step > SLOW
                else "faster than robots are logged"
            )
            line = f"{log.name}: median time step {step:.3g} s, {what}: {_suggest_unit(step)}"
            warnings.append(DataWarning(line, is_certain=step > SLOW, affects_values=step <= SLOW))
    ratio, density = _compute_pendulum(model, observation, result)
    if not warnings and ratio > ABSURD:
        warnings.append(
            DataWarning(
                f"the clock seems to be wrong: the inertias are {ratio:.2g} times those of links "
                f"of this reach under this gravity, as if all motion were {ratio**0.5:.2g} times "
                "as fast, or the lengths of the table not in metres; check the time column, its "
                "unit and rate",
                is_certain=True,
            )
        )
    elif density > HEAVY and result.status != "rank deficient":
        line = (
            f"the links would weigh {density:.2g} kg for every cubic metre within the robot's "
            "reach: the torques look like mN m, or the lengths of the table are not in metres; "
            "give N m and metres"
        )
        warnings.append(DataWarning(line, is_certain=True))
    return warnings


def _suggest_unit(step: float) -> str:
    """What the unit may be, and what to do."""
    for name, seconds in _UNITS:
        rate = 1.0 / (step * seconds)
        if _USUAL[0] <= rate <= _USUAL[1]:
            return (
                f"were the column time in {name}, the rows came at {rate:.4g} Hz; multiply it by "
                f"{seconds:g} if they are"
            )
    return "is the column time in seconds, or a count of rows? give seconds"


def _compute_pendulum(
    model: CompiledModel, observation: Observation, result: FitResult
) -> tuple[float, float]:
    """Least J g / m over the reach, over the joints that gravity loads; 0 if none.

    Of a slide J and m / g are masses, and the reach is none of it. And the mass that makes the
    largest inertia, over the cube of the reach, kg/m^3.
    """
    q = observation.q[:: max(1, len(observation.q) // _POSES)]
    nearest = find_nearest_closed(model, q)
    if nearest is None:
        return 0.0, 0.0
    q = np.ascontiguousarray(q[nearest])
    origins = model.forward_kinematics(q)[..., 3]
    reach = float(np.linalg.norm(origins[:, :, None] - origins[:, None], axis=-1).max())  # m
    if reach == 0.0:
        return 0.0, 0.0
    kinds = np.array([base.kind for base in model.spec.base])
    links = np.where(kinds == "inertial", result.beta, 0.0)
    weight = np.abs(model.gravity(q, links)).max(axis=0)
    matrices = model.inertia_matrix(q, result.beta)
    inertia = np.median(np.abs(np.diagonal(matrices, axis1=1, axis2=2)), axis=0)
    torque = np.sqrt(np.mean(observation.torque**2, axis=0))
    length = np.array([reach if joint.unit == "rad" else 1.0 for joint in model.spec.joints])
    mass = np.maximum(inertia / length**2, weight / length / _GRAVITY)
    loaded = np.array([joint.actuated for joint in model.spec.joints])
    loaded &= (weight > LOADED * torque) & (weight > 0.0)
    swings = (inertia * _GRAVITY / np.where(loaded, weight, 1.0) / length)[loaded]
    swing = float(np.min(swings)) if loaded.any() else 0.0
    beyond = max(swing, 1.0)  # axes alone place the frames: links reach as far as they swing
    return swing, float(mass.max() / beyond**2 / (reach * beyond) ** 3)


CHANCE = 1e-3
"""Probability with which the machine that was measured lies outside of its confidence region."""

_FELT = 1.1  # ratio of errors that is worth a word


def judge_fit(
    model: CompiledModel,
    observation: Observation,
    result: FitResult,
    log_warnings: Sequence[DataWarning] = (),
    equations: Equations | None = None,
    refit: Callable[[np.ndarray], np.ndarray] | None = None,
    data: CompressedRegression | None = None,
) -> FitResult:
    """The fit with its verdict.

    A fit is valid for prediction of torques of motion like that of its logs if it describes every
    joint, predicts stretches that are left out, the time runs in seconds, and a machine that
    could be built describes the joints as well. It is valid for its parameters if, beyond that,
    no joint is doubtful, one such machine lies in their confidence region, the logs tell the
    values apart, and what is left of the torques is small or noise.

    Args:
        model: the robot.
        observation: that was fitted.
        result: of the fit.
        log_warnings: findings of other stages about the logs; one that is certain makes the fit
            invalid.
        equations: that were fitted; None: those of the bare robot.
        refit: how the fit is made without some samples; None: by least squares of the torques.
        data: all rows that were fitted, where the observation has a part of them only.
    """
    equations = equations or build_base_equations(observation)
    rows = find_connected_rows(observation)
    part, data = data is not None, data or equations.compress_rows(rows)
    sigma, prior = np.array([joint.sigma for joint in result.joints]), build_prior(model.spec)
    seen = cross_validate(equations, rows, sigma, refit, prior)
    unseen = tuple(doubt.line for doubt in log_warnings if doubt.is_undetectable)
    warnings = [doubt for doubt in log_warnings if not doubt.is_undetectable]
    possible = None
    if not any(
        doubt.is_certain for doubt in warnings
    ):  # else what the fit says is said of the fault
        warnings += [
            *check_time(model, observation, result),
            *doubts.check_motion_noise(observation),
        ]
        warnings += [*doubts.find_few_rows(result, seen), *doubts.find_lack_of_fit(result)]
        if part:
            warnings += doubts.find_unexplained_joints(
                result, seen, _compute_torque_ratio(data, observation, rows)
            )
        warnings += doubts.find_systematic_residuals(
            result, _estimate_systematic_share(equations, rows, result)
        )
        warnings += [
            DataWarning(line, affects_values=True, joints=_find_joint(line, result))
            for line in result.contradicted
        ]
        warnings += doubts.find_undetermined_parameters(
            model.spec, result, _compute_spread(data, result)
        )
        impossible = _find_impossible(model.spec, result, data)
        possible = not impossible
        warnings += [*impossible, *doubts.find_negative_values(model.spec, result)]
    worst = _find_worst_blocks(seen, equations, rows)
    by_joint = _judge_joints([*warnings, *result.joint_warnings], result, seen, worst)
    verdict = _write_verdict(
        warnings, by_joint, _describe_prediction(equations, rows, result, seen)
    )
    directions = compute_friction_by_direction(model.spec, result)
    verdict = dataclasses.replace(verdict, unseen=unseen, possible=possible)
    return dataclasses.replace(result, verdict=verdict, directions=directions)


GOOD = 0.15
"""Cross-validated error of a joint below which nothing speaks against its torques."""

LAPSE = 0.3
"""Cross-validated error in a fifth of the time above which a joint is doubtful."""

LOST = 0.5
"""Cross-validated error of a joint above which it is not determined."""

FILTERED = 0.2
"""Autocorrelation of residuals over one row up to which the filter of the rows makes it."""

NOT_FITTED = "no row was fitted"
"""Why a joint is not determined that has no motor, or no torque in its rows."""

_BLOCKS = 5  # in time


def _find_worst_blocks(seen: CrossValidation, equations: Equations, rows: np.ndarray) -> np.ndarray:
    """(n,) largest cross-validated error in a block of time."""
    observation = equations.observation
    block = observation.row_sample * _BLOCKS // len(observation.time)
    every = [compute_errors(equations, seen.residual, rows & (block == k)) for k in range(_BLOCKS)]
    return np.asarray(np.nan_to_num(every).max(axis=0))


def _judge_joints(
    warnings: Sequence[DataWarning], result: FitResult, seen: CrossValidation, worst: np.ndarray
) -> dict[str, JointVerdict]:
    """What speaks against each joint: what is said of it, of the whole robot, and its errors.

    What is said of no joint, and leaves prediction and values as they are, speaks against none.
    """
    names = {joint.name for joint in result.joints}
    judged = {}
    for joint, error, lapse in zip(result.joints, seen.errors, worst, strict=True):
        joint_warnings = [
            doubt
            for doubt in warnings
            if joint.name in doubt.joints
            or (not names & set(doubt.joints) and (doubt.is_certain or doubt.affects_values))
        ]
        lines = tuple(dict.fromkeys(doubt.line for doubt in joint_warnings))
        errors = f"fit error {format_percent(joint.relative_error)}"
        if np.isfinite(error):
            errors += f", cross-validated error {format_percent(float(error))}"
        if joint.relative_error is None:
            judged[joint.name] = JointVerdict("undetermined", (NOT_FITTED, *lines))
        elif any(doubt.is_certain for doubt in joint_warnings) or error > LOST:
            judged[joint.name] = JointVerdict("undetermined", lines or (errors,))
        elif joint_warnings or error > GOOD or lapse > LAPSE:
            judged[joint.name] = JointVerdict("doubtful", lines or (errors,))
        else:
            judged[joint.name] = JointVerdict("good", (errors,))
    return judged


def _describe_prediction(
    equations: Equations, rows: np.ndarray, result: FitResult, seen: CrossValidation
) -> str:
    """How well torques are predicted; no better than where they were fitted."""

    def largest(errors: np.ndarray, joints: Sequence[JointFit]) -> str:
        fit_errors = [np.nan if j.relative_error is None else j.relative_error for j in joints]
        return format_percent(
            float(np.fmax(np.nan_to_num(errors), np.nan_to_num(fit_errors)).max())
        )

    parts = {
        name: largest(compute_errors(equations, seen.residual, is_counted), result.by_load[name])
        for name, is_counted in equations.select_conditions(rows).items()
        if name in result.by_load
    }
    errors = " and ".join(f"{error} {name}" for name, error in parts.items())
    return f"cross-validated error at most {errors or largest(seen.errors, result.joints)}"


def _compute_torque_ratio(
    data: CompressedRegression, observation: Observation, rows: np.ndarray
) -> np.ndarray:
    """(n,) rms torque of all rows over that of the observation's; 1 where either has none."""
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
    data: CompressedRegression | None = None,
) -> list[str]:
    """Why a fit is certainly not valid, other than for want of data.

    A log that is too short for a fit of its own may still say something beside others.

    Args:
        model: the robot.
        observation: that was fitted.
        result: of the fit.
        log_warnings: findings of other stages about the logs.
        data: all rows that were fitted; None: those of the observation.
    """
    warnings = list(log_warnings)
    if not any(doubt.is_certain for doubt in warnings):
        warnings += [*check_time(model, observation, result), *doubts.find_lack_of_fit(result)]
        warnings += _find_impossible(model.spec, result, data or compress_all_rows(observation))
    return list(dict.fromkeys(doubt.line for doubt in warnings if doubt.is_certain))


def _estimate_systematic_share(
    equations: Equations, rows: np.ndarray, result: FitResult
) -> np.ndarray:
    """(n,) e_j sqrt(r_j(1)): relative error, and autocorrelation of the residual over one row."""
    observation, every = equations.observation, np.ones(len(rows), dtype=bool)
    residual = equations.compute_residual(_collect_values(result), every)
    shares = np.zeros(len(result.joints))
    for j, joint in enumerate(result.joints):
        is_of_joint = rows & (observation.row_joint == j)
        if joint.relative_error is None or not is_of_joint.any():
            continue
        r = estimate_autocorrelation(
            residual[is_of_joint], observation.row_sample[is_of_joint], observation.segment
        )
        lasts = float(r[1]) if len(r) > 1 and r[1] > FILTERED else 0.0
        shares[j] = joint.relative_error * lasts**0.5
    return shares


def _find_joint(line: str, result: FitResult) -> tuple[str, ...]:
    """The joint that a line begins with."""
    return tuple(j.name for j in result.joints if line.startswith(f"joint {j.name}: "))


def _collect_values(result: FitResult) -> np.ndarray:
    """(c + loads,) of all columns that were fitted."""
    return np.append(result.beta, [load.value for load in result.loads])


def _compute_spread(data: CompressedRegression, result: FitResult) -> np.ndarray:
    """(c,) ||W_jc|| sigma_c / ||y_j|| of the joint where it is largest."""
    sigma = np.sqrt(np.diag(result.covariance))
    column = np.linalg.norm(data.triangles[:, :, : len(sigma)], axis=1)
    torque = data.compute_torque_norms()
    driven = torque > 0.0
    share = column[driven] * sigma / torque[driven, None]
    return np.asarray(share.max(axis=0, initial=0.0))


def _find_impossible(
    spec: ModuleSpec, result: FitResult, data: CompressedRegression
) -> list[DataWarning]:
    """Values that no completion makes those of a machine that could be built."""
    machine, c = define_physical_parameters(spec), len(result.beta)
    # A root of what the rows tell of the robot's parameters, whatever those of loads are.
    whole = data.combine_joints(np.array([joint.sigma for joint in result.joints]))
    loads = whole.shape[1] - 1 - c
    white = compute_triangle(np.hstack([whole[:, c:-1], whole[:, :c]]))[loads:, loads:]
    root = white / _estimate_sigma_factors(white, result)
    nearest = project_parameters(machine, result.beta, root)
    limit = float(chdtri(max(1, np.linalg.matrix_rank(root)), CHANCE)) ** 0.5
    if nearest is None or nearest.distance <= limit:
        return []
    blamed = attribute_distance(machine, result.beta, root, nearest.distance)
    names = [name if name in machine.positive else f"the mass of link {name}" for name in blamed]
    # Relative errors with the fit and with the possible machine, and the joint that it costs most.
    torque, values = data.compute_torque_norms(), _collect_values(result)
    driven = np.flatnonzero(torque > 0.0)
    moved = np.append(nearest.beta, values[len(nearest.beta) :])
    errors = [
        data.compute_residual_norms(beta)[driven] / torque[driven] for beta in (values, moved)
    ]
    worst = int(np.argmax(errors[1] - errors[0]))
    before, after = (float(error[worst]) for error in errors)
    cost = (
        ""
        if after < _FELT * before
        else (
            f"; the nearest possible one leaves {format_percent(after)} of the torque of joint "
            f"{result.joints[driven[worst]].name}, not {format_percent(before)}"
        )
    )
    return [
        DataWarning(
            f"no machine that could be built has these values: {nearest.distance:.3g} sigmas from "
            f"any, where {limit:.2g} are chance; carried by {', '.join(names) or 'no single link'}"
            f"{cost}; check signs, order and units of those channels, and let `modeler "
            "diagnose` look for an effect that they stand in for",
            is_certain=after > max(LITTLE, WIDE * before),
            affects_values=True,
            joints=tuple(
                joint
                for name in blamed
                for joint in doubts.find_joints_of_parameters(spec, [name]) or (name,)
            ),
        )
    ]


def _estimate_sigma_factors(white: np.ndarray, result: FitResult) -> np.ndarray:
    """(c,) factors of the standard deviations over those of white residuals, 1 and more.

    All are the largest if columns were set aside: others carry their effect, and must go on to.
    """
    raised = np.sqrt(np.diag(result.covariance))
    names = [parameter.name for parameter in result.parameters]
    kept_columns = np.intersect1d(
        np.flatnonzero(raised), find_independent_columns(white, names).kept_columns
    )
    factors = np.ones(len(raised))
    if kept_columns.size:
        _, root = solve_by_qr(white[:, kept_columns], np.zeros(len(white)))
        factors[kept_columns] = np.maximum(raised[kept_columns] / np.linalg.norm(root, axis=1), 1.0)
    return factors if kept_columns.size == len(factors) else np.full(len(factors), factors.max())


def _write_verdict(
    warnings: Sequence[DataWarning], by_joint: Mapping[str, JointVerdict], error: str
) -> Verdict:
    lines = tuple(dict.fromkeys(doubt.line for doubt in warnings))
    fatal = [doubt for doubt in warnings if doubt.is_certain]
    if fatal:
        return Verdict(False, "nothing", f"Not valid: {fatal[0].line}", lines, (), by_joint)
    values = [doubt.line for doubt in warnings if doubt.affects_values]
    doubtful = {
        name: judged.why[0]
        for name, judged in by_joint.items()
        if judged.state != "good" and judged.why[0] != NOT_FITTED  # which blocks no other joint
    }
    if values or doubtful:
        named = (why if why.startswith("joint") else f"joint {name}, {why}"
                 for name, why in doubtful.items())  # fmt: skip
        reason = [*values, *named][0]
        line = (
            f"Valid for torque prediction on similar motions only: {error} on every joint. "
            f"Individual parameters are not reliable: {reason}"
        )
        return Verdict(True, "prediction", line, lines, (), by_joint)
    line = f"Valid for torque prediction: {error} on every joint. "
    line += f"Note: {warnings[0].line}" if warnings else "Parameters are physically consistent."
    return Verdict(True, "parameters", line, lines, (), by_joint)
