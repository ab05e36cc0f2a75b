"""What of a fit deserves no trust, in sentences; logs that tell different values."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_percent
from modeler.estimation.identify import (
    CrossValidation,
    Equations,
    build_base_equations,
    fit_equations,
)
from modeler.estimation.least_squares import solve_least_squares
from modeler.estimation.payload import Payload, build_loaded_equations
from modeler.estimation.result import FitResult
from modeler.regression import TREMBLES, DataWarning, Observation
from modeler.runtime import CompiledModel

_FAR = 3.0  # standard deviations below zero

LITTLE = 0.3
"""Relative error above which a model does not describe a joint: 9 % of the torque's variance."""

HALF = 0.5**0.5
"""Relative error above which more of a joint's torque is left, in variance, than is described."""

WIDE = 2.0
"""Ratio of the error on left-out motion to that on fitted motion above which rows are too few."""

ELSEWHERE = 3.0
"""Ratio of the error on all rows to that in windows of them above which other rows differ; where
logs are all of one kind it is 0.6 to 1.3."""

STRUCTURE = 0.03
"""Rms of what is left and lasts, over that of the torque, above which values carry some of it."""

MOST = 0.5
"""Share of the parameters that logs may leave open; beyond it they are a glimpse of a motion."""

_TORQUES = "check units, signs and columns of the log, the table, and the effects in the robot file"


def find_negative_values(spec: ModuleSpec, result: FitResult) -> list[DataWarning]:
    """Values below zero that physics does not allow, whatever the other parameters are.

    A base parameter cannot be negative if all its terms are parameters that cannot be, with
    coefficients that are not: friction, rotor inertias, moments of inertia, masses.
    """
    possible = {parameter.name for parameter in spec.standard if parameter.nonnegative}
    return [
        DataWarning(
            f"{base.name} = {estimate.value:.4g} {base.unit} is negative, which physics does "
            "not allow: a sign, a unit or the order of columns in the log may be wrong, or an "
            "effect is missing that this parameter stands in for; let `modeler diagnose` look",
            affects_values=True,
            joints=find_joints_of_parameters(spec, [base.name]),
        )
        for base, estimate in zip(spec.base, result.parameters, strict=True)
        if estimate.sigma is not None
        and estimate.value < -_FAR * estimate.sigma
        and all(term.value >= 0.0 and term.parameter in possible for term in base.terms)
    ]


def find_joints_of_parameters(spec: ModuleSpec, names: Sequence[str]) -> tuple[str, ...]:
    """Rows of the table that base or standard parameters belong to, in the order of the names."""
    row = {parameter.name: parameter.joint for parameter in spec.standard}
    row |= {base.name: row[base.column_of] for base in spec.base if base.column_of in row}
    return tuple(dict.fromkeys(row[name] for name in names if name in row))


def find_lack_of_fit(result: FitResult) -> list[DataWarning]:
    """Joints whose torques the model does not describe, even where it was fitted."""
    return [
        DataWarning(
            f"joint {joint.name}: {format_percent(joint.relative_error)} of the torque is not "
            f"described even on the data of the fit; {_TORQUES}; `modeler diagnose` names what is "
            "missing",
            is_certain=joint.relative_error > HALF,
            affects_values=True,
            joints=(joint.name,),
        )
        for joint in result.joints
        if joint.relative_error is not None
        and joint.relative_error > LITTLE
        and joint.name not in find_resting_joints(result)
    ]


def find_resting_joints(result: FitResult) -> list[str]:
    """Joints that never move: what dry friction holds there is no error of the model."""
    floors = result.processing.speed_floors or {}
    return [name for name, floor in floors.items() if floor == float("inf")]


def check_motion_noise(observation: Observation) -> list[DataWarning]:
    """Torques that do not answer to the motion even behind the lowest filters: no sigma says so."""
    bands = observation.report.bands
    if bands.trembling_left <= TREMBLES:
        return []
    return [
        DataWarning(
            f"behind filters as low as the motion allows ({bands.parallel_cutoff:g} Hz) the torque "
            f"of the model still trembles {bands.trembling_left:.2g} times as much as the measured "
            "one: the positions are noisy there, or an effect is missing that smooths the torque; "
            "values may be drawn to zero by more than their sigmas; let `modeler diagnose` look, "
            "move farther and faster, or measure positions more finely",
            affects_values=True,
        )
    ]


def find_systematic_residuals(result: FitResult, systematic_share: np.ndarray) -> list[DataWarning]:
    """Joints whose residual is so large, and so little noise, that values must carry some of it.

    Args:
        result: of the fit.
        systematic_share: (n,) what of the residual is the same in the next row, rms over that of
            the torque.
    """
    large = {
        joint.name: float(share)
        for joint, share in zip(result.joints, systematic_share, strict=True)
        if share > STRUCTURE
        and (joint.relative_error or 0.0) <= LITTLE  # else it is told already
        and joint.name not in find_resting_joints(result)
    }
    if not large:
        return []
    return [
        DataWarning(
            f"joint {', '.join(large)}: up to {format_percent(max(large.values()))} of the "
            "torque is left and is no noise: an effect is missing, and the values of others stand "
            "in for it; `modeler diagnose` names it",
            affects_values=True,
            joints=tuple(large),
        )
    ]


def find_few_rows(result: FitResult, seen: CrossValidation) -> list[DataWarning]:
    """Joints whose torques the fit does not predict where it was not fitted: rows are too few."""
    lost = [
        (joint.name, error)
        for joint, error in zip(result.joints, seen.errors, strict=True)
        if joint.relative_error is not None
        and joint.name not in find_resting_joints(result)
        and np.isfinite(error)
        and error > max(LITTLE, WIDE * joint.relative_error)
    ]
    if not lost:
        return []
    names = ", ".join(name for name, _ in lost)
    much = max(error for _, error in lost)
    miss = "all of the torque" if much >= 1.0 else f"up to {format_percent(much)} of the torque"
    swings = f"swings of the motion ({seen.half_period:.2g} s each)"
    moved = (
        f"the logs hold less than two {swings}"
        if seen.stretches < 2
        else f"of {seen.stretches} {swings}, a fit to the others misses each by {miss}"
    )
    return [
        DataWarning(
            f"joint {names}: not enough data for {len(result.parameters)} parameters, or columns "
            f"that do not belong together: {moved}; record a longer motion of all joints, at many "
            "speeds and poses, if `modeler log` finds no column exchanged, shifted or spoilt",
            is_certain=True,
            joints=tuple(name for name, _ in lost),
        )
    ]


def find_unexplained_joints(
    result: FitResult, seen: CrossValidation, scale: np.ndarray
) -> list[DataWarning]:
    """Joints whose torques are described worse on all rows than windows of them let expect.

    Relatively, and in N m too: where the windows show a faster motion, noise alone is a larger
    share of the other torques.

    Args:
        result: of all rows.
        seen: in the windows.
        scale: (n,) rms torque of all rows over that of the windows.
    """
    warnings = []
    for joint, error, torque in zip(result.joints, seen.errors, scale, strict=True):
        joint_error = joint.relative_error
        if joint_error is None or not joint_error * min(1.0, float(torque)) > ELSEWHERE * error:
            continue
        warnings.append(
            DataWarning(
                f"joint {joint.name}: all rows are described to {format_percent(joint_error)}, the "
                "windows "
                f"to {format_percent(error)}: some rows hold what the windows do not show; fit "
                "pieces, FILE@START:END, to find them",
                is_certain=True,
                joints=(joint.name,),
            )
        )
    return warnings


def find_undetermined_parameters(
    spec: ModuleSpec, result: FitResult, spread: np.ndarray
) -> list[DataWarning]:
    """Parameters that could be anything: only their sums with others are known.

    Args:
        spec: the robot.
        result: of the fit.
        spread: (c,) one standard deviation of each parameter, as torque over that of the joint
            that feels it most.
    """
    vague = [base.name for base, share in zip(spec.base, spread, strict=True) if share > 1.0]
    aside = [p.name for p in result.parameters if p.sigma is None]
    unknown, count = len({*vague, *aside}), len(result.parameters)
    if unknown > MOST * count:
        return [
            DataWarning(
                f"not enough data for {count} parameters: {unknown} of them are not told by these "
                f"logs ({_shorten_names([*aside, *vague])}); record a longer motion of all joints, "
                "at many "
                "speeds and poses",
                is_certain=True,
            )
        ]
    warnings = []
    if vague:
        warnings.append(
            DataWarning(
                f"{_shorten_names(vague)}: one sigma is more than the whole torque of a joint, so "
                "only sums "
                "with other parameters are known, not the values; record poses and accelerations "
                "that the logs lack",
                affects_values=True,
                joints=find_joints_of_parameters(spec, vague),
            )
        )
    if aside:
        warnings.append(
            DataWarning(
                f"{_shorten_names(aside)}: not told by these logs and set aside; record a motion "
                "that moves "
                "all joints over a wide range",
                affects_values=True,
                joints=find_joints_of_parameters(spec, aside),
            )
        )
    return warnings


def _shorten_names(names: list[str]) -> str:
    rest = f" and {len(names) - 5} more" if len(names) > 5 else ""
    return ", ".join(names[:5]) + rest


# Whether logs belong together: one robot, and a load that sits on its link alike in all.


WORSE = 2.0
"""Ratio of what is left together to what is left alone from which on logs are not of one robot."""

_TELLS = 0.02  # of a joint's torque: less is left of it together than any two machines differ
_FAR_APART = 4.0  # standard deviations between two logs
_WORTH = 0.1  # share of the largest first moment
_FIRST = ("MX", "MY", "MZ")


def find_heterogeneous_logs(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """Why logs do not belong together: `find_moved_payloads`, or else `find_different_robots`."""
    lines = find_moved_payloads(model, observation, payloads)
    return lines or find_different_robots(model, observation, payloads)


def separate_payload(payload: Payload) -> list[Payload]:
    """A load for each log: the same mass, its own centre and inertia."""
    if len(payload.logs) == 1:
        return [payload]
    return [
        dataclasses.replace(payload, logs=(log,), name=f"{payload.name}{i}")
        for i, log in enumerate(payload.logs, start=1)
    ]


def find_moved_payloads(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """A line for each load whose centre of mass is not the same in all its logs.

    Each of its logs gets a load of its own. Two logs disagree if a first moment MX, MY, MZ differs
    by more than _FAR of its standard deviations and _WORTH of the largest one.
    """
    every = (payload for payload in payloads if len(payload.logs) > 1)
    return [
        line for payload in every if (line := _describe_disagreement(model, observation, payload))
    ]


def _describe_disagreement(model: CompiledModel, observation: Observation, payload: Payload) -> str:
    parts = separate_payload(payload)
    equations = build_loaded_equations(model, observation, parts).equations
    fit = fit_equations(observation, equations, "weighted", noise_only=True)
    first_moments = [  # first moments that the logs tell, by name without that of the load
        {
            p.name.removesuffix(f"_{part.name}"): p
            for p in fit.loads
            if p.name.endswith(f"_{part.name}")
            and p.sigma is not None
            and p.name.startswith(_FIRST)
        }
        for part in parts
    ]
    largest = max(
        (abs(p.value) for moments in first_moments for p in moments.values()), default=0.0
    )
    worst, line = _FAR_APART, ""
    for label in sorted(set.intersection(*(set(moments) for moments in first_moments))):
        a, b = (pick(first_moments, key=lambda m: m[label].value)[label] for pick in (max, min))
        apart = (a.value - b.value) / float(np.hypot(a.sigma or np.inf, b.sigma or np.inf))
        if apart > worst and a.value - b.value > _WORTH * largest:
            worst = apart
            line = (
                f"payload {payload.name}: the logs {', '.join(payload.logs)} disagree about where "
                f"it sits: {label} is from {b.value:.3g} to {a.value:.3g} {a.unit}; if it was "
                "taken off in between, give --payload-moved"
            )
    return line


def find_different_robots(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """A line if the logs are described alone, loaded ones with another last link, but not together.

    Together every log has the same base parameters, loads come beside them, and every load has its
    own mass; torques are taken as they are. The line names the joint where it shows most.

    Args:
        model: the robot.
        observation: of all logs.
        payloads: which of them carry what.
    """
    loaded = build_loaded_equations(model, observation, payloads)
    weights = [f"weight {i}" for i in range(len(loaded.weighed))]
    free = loaded.equations.append_columns(loaded.torques, weights)
    bare, every = build_base_equations(observation), np.ones(len(observation.y), dtype=bool)
    together = _compute_residual_norms(free, every) ** 2
    alone = np.zeros(len(together))
    for run in range(len(observation.logs)):
        alone += _compute_residual_norms(bare, observation.row_run == run) ** 2
    torque = bare.compress_rows(every).compute_torque_norms()
    felt = (torque > 0.0) & (together > (_TELLS * torque) ** 2)
    if not felt.any():
        return []
    ratio = np.where(felt, together / np.maximum(alone, 1e-300), 0.0)
    worst = int(np.argmax(ratio))
    if ratio[worst] < WORSE**2:
        return []
    apart, all_of_them = (np.sqrt(v[worst]) / torque[worst] for v in (alone, together))
    return [
        f"the logs {', '.join(observation.logs)} do not fit one robot: joint "
        f"{observation.joints[worst].name} has {format_percent(apart)} of its torque left if each "
        "is "
        f"described alone, and {format_percent(all_of_them)} together; are all of the same robot, "
        "is the "
        "load on the link that is said to carry it, and does friction grow with the load?"
    ]


def _compute_residual_norms(equations: Equations, rows: np.ndarray) -> np.ndarray:
    """(n,) norm of what a weighted fit of these rows leaves of each joint, N m or N.

    Raised by as much as the parameters lower it: few rows are described by many parameters.
    """
    count, columns = int(rows.sum()), len(equations.names)
    if count <= columns:
        return np.full(len(equations.observation.joints), np.inf)  # nothing to be said of so few
    data = equations.compress_rows(rows)
    return float(np.sqrt(count / (count - columns))) * data.compute_residual_norms(
        solve_least_squares(data).beta
    )
