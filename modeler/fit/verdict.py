"""Usable or not, what for, why, and what to do: how a fit ends."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtri

from modeler.core.contract import ModuleSpec
from modeler.estimate.coloured import autocorrelation
from modeler.estimate.compressed import Compressed, triangle
from modeler.estimate.least_squares import solve_by_qr
from modeler.estimate.possible import Nearest, carried_by, machine_of, nearest_possible
from modeler.estimate.rank import independent_columns
from modeler.fit.clock import time_doubts
from modeler.fit.crossed import Crossed, crossed
from modeler.fit.directions import friction_by_direction
from modeler.fit.doubts import (
    LITTLE,
    WIDE,
    Doubt,
    Told,
    negative,
    scarce,
    systematic,
    undescribed,
    undetermined,
    unshown,
)
from modeler.fit.identify import Equations, alive_rows, all_rows, base_equations
from modeler.fit.result import FitResult, JointFit, Verdict
from modeler.observation import Observation

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

CHANCE = 1e-3
"""Probability with which the machine that was measured lies outside of its confidence region."""

_FELT = 1.1  # ratio of errors that is worth a word


def with_verdict(
    model: "CompiledModel",
    observation: Observation,
    result: FitResult,
    told: Sequence[Told] = (),
    equations: Equations | None = None,
    refit: Callable[[np.ndarray], np.ndarray] | None = None,
    data: Compressed | None = None,
) -> FitResult:
    """The fit with its verdict.

    A fit is usable if it predicts the torques of motion like that of its logs: it describes every
    joint, foretells stretches that are left out, the time runs in seconds, and a machine that
    could be built describes the joints as well. Its values are usable as those of the machine if,
    beyond that, one such machine lies in their confidence region, the logs tell the values
    apart, and what is left of the torques is small or noise.

    Args:
        model: the robot.
        observation: that was fitted.
        result: of the fit.
        told: findings of other stages about the logs; one that is certain makes the fit unusable.
        equations: that were fitted; None: those of the bare robot.
        refit: how the fit is made without some samples; None: by least squares of the torques.
        data: all rows that were fitted, where the observation has a part of them only.
    """
    equations = equations or base_equations(observation)
    rows = alive_rows(observation)
    part, data = data is not None, data or equations.compressed(rows)
    seen = crossed(equations, rows, np.array([joint.sigma for joint in result.joints]), refit)
    found = [i if isinstance(i, Doubt) else Doubt(i.line, i.certain) for i in told]
    found += time_doubts(model, observation, result)
    found = _with_poor(found, [*scarce(result, seen), *undescribed(result)])
    if part:
        found += unshown(result, seen, _scale(data, observation, rows))
    found += systematic(result, _lasting(equations, rows, result))
    found += undetermined(model.spec, result, _spread(data, result))
    found += [*_impossible(model.spec, result, data), *negative(model.spec, result)]
    verdict = _verdict(found, _predicts(equations, rows, result, seen))
    directions = friction_by_direction(model.spec, result)
    return dataclasses.replace(result, verdict=verdict, directions=directions)


def _predicts(equations: Equations, rows: np.ndarray, result: FitResult, seen: Crossed) -> str:
    """What for a usable fit is good for; no better than it does where it was fitted."""

    def largest(errors: np.ndarray, joints: Sequence[JointFit]) -> str:
        own = [np.nan if j.relative_error is None else j.relative_error for j in joints]
        return f"{100.0 * float(np.fmax(np.nan_to_num(errors), np.nan_to_num(own)).max()):.2g} %"

    told = {
        name: largest(seen.on(equations, own), result.by_load[name])
        for name, own in equations.conditions(rows).items()
        if name in result.by_load
    }
    errors = " and ".join(f"{error} {name}" for name, error in told.items())
    return (
        f"predicts torques of motion like that of its logs to "
        f"{errors or largest(seen.errors, result.joints)} on every joint (stretches left out)"
    )


def _scale(data: Compressed, observation: Observation, rows: np.ndarray) -> np.ndarray:
    """(n,) rms torque of all rows over that of the observation's; 1 where either has none."""
    count = len(data.rows)
    joint, y = observation.row_joint[rows], observation.y[rows]
    here = np.sqrt(np.bincount(joint, y**2, count) / np.fmax(np.bincount(joint, None, count), 1))
    there = data.torque_norms() / np.sqrt(np.fmax(data.rows, 1))
    both = (here > 0.0) & (there > 0.0)
    return np.where(both, there / np.where(both, here, 1.0), 1.0)


def contradictions(
    model: "CompiledModel",
    observation: Observation,
    result: FitResult,
    told: Sequence[Told] = (),
    data: Compressed | None = None,
) -> list[str]:
    """Why a fit is certainly not usable, other than for want of data.

    A log that is too short for a fit of its own may still say something beside others.

    Args:
        model: the robot.
        observation: that was fitted.
        result: of the fit.
        told: findings of other stages about the logs.
        data: all rows that were fitted; None: those of the observation.
    """
    data = data or all_rows(observation)
    found = [i if isinstance(i, Doubt) else Doubt(i.line, i.certain) for i in told]
    found = _with_poor([*found, *time_doubts(model, observation, result)], undescribed(result))
    found += _impossible(model.spec, result, data)
    return list(dict.fromkeys(doubt.line for doubt in found if doubt.certain))


def _with_poor(found: list[Doubt], poor: list[Doubt]) -> list[Doubt]:
    """With torques that are badly described; where it is known why, that stands in their place."""
    if not any(doubt.explains for doubt in found):
        return [*found, *poor]
    fatal = any(doubt.certain for doubt in poor)
    return [
        dataclasses.replace(doubt, certain=doubt.certain or (doubt.explains and fatal))
        for doubt in found
    ]


def _lasting(equations: Equations, rows: np.ndarray, result: FitResult) -> np.ndarray:
    """(n,) e_j sqrt(r_j(1)): relative error, and autocorrelation of the residual over one row."""
    observation, every = equations.observation, np.ones(len(rows), dtype=bool)
    residual = equations.residual(_values(result), every)
    found = np.zeros(len(result.joints))
    for j, joint in enumerate(result.joints):
        own = rows & (observation.row_joint == j)
        if joint.relative_error is None or not own.any():
            continue
        r = autocorrelation(residual[own], observation.row_sample[own], observation.segment)
        found[j] = joint.relative_error * max(float(r[1]), 0.0) ** 0.5 if len(r) > 1 else 0.0
    return found


def _values(result: FitResult) -> np.ndarray:
    """(c + loads,) of all columns that were fitted."""
    return np.append(result.beta, [load.value for load in result.loads])


def _spread(data: Compressed, result: FitResult) -> np.ndarray:
    """(c,) ||W_jc|| sigma_c / ||y_j|| of the joint where it is largest."""
    sigma = np.sqrt(np.diag(result.covariance))
    column = np.linalg.norm(data.triangles[:, :, : len(sigma)], axis=1)
    torque = data.torque_norms()
    driven = torque > 0.0
    share = column[driven] * sigma / torque[driven, None]
    return np.asarray(share.max(axis=0, initial=0.0))


def _impossible(spec: ModuleSpec, result: FitResult, data: Compressed) -> list[Doubt]:
    """Values that no completion makes those of a machine that could be built."""
    machine = machine_of(spec)
    white = _told_of_robot(data, result)
    root = white / _colour(white, result)
    nearest = nearest_possible(machine, result.beta, root)
    limit = float(chdtri(max(1, np.linalg.matrix_rank(root)), CHANCE)) ** 0.5
    if nearest is None or nearest.distance <= limit:
        return []
    blamed = carried_by(machine, result.beta, root, nearest.distance)
    names = [name if name in machine.positive else f"the mass of link {name}" for name in blamed]
    cost = _cost(result, data, nearest)
    return [
        Doubt(
            f"no machine that could be built has these values: {nearest.distance:.3g} sigmas from "
            f"any, where {limit:.2g} are chance; carried by {', '.join(names) or 'no single link'}"
            f"{cost.told()}; check signs, order and units of those channels, and let `modeler "
            "diagnose` look for an effect that they stand in for",
            certain=cost.after > max(LITTLE, WIDE * cost.before),
            values=True,
        )
    ]


def _told_of_robot(data: Compressed, result: FitResult) -> np.ndarray:
    """(., c) root of what the rows tell of the robot's parameters, whatever those of loads are."""
    whole, c = data.whole(np.array([joint.sigma for joint in result.joints])), len(result.beta)
    loads = whole.shape[1] - 1 - c
    return triangle(np.hstack([whole[:, c:-1], whole[:, :c]]))[loads:, loads:]


def _colour(white: np.ndarray, result: FitResult) -> np.ndarray:
    """(c,) factors of the standard deviations over those of white residuals, 1 and more.

    All are the largest if columns were set aside: others carry their effect, and must go on to.
    """
    raised = np.sqrt(np.diag(result.covariance))
    names = [parameter.name for parameter in result.parameters]
    kept = np.intersect1d(np.flatnonzero(raised), independent_columns(white, names).kept)
    factors = np.ones(len(raised))
    if kept.size:
        _, root = solve_by_qr(white[:, kept], np.zeros(len(white)))
        factors[kept] = np.maximum(raised[kept] / np.linalg.norm(root, axis=1), 1.0)
    return factors if kept.size == len(factors) else np.full(len(factors), factors.max())


@dataclass(frozen=True)
class _Cost:
    """Relative error of the joint where a possible machine costs most, with the fit and with it."""

    joint: str
    before: float
    after: float

    def told(self) -> str:
        """What goes behind the sentence."""
        if self.after < _FELT * self.before:
            return ""
        return (
            f"; the nearest possible one leaves {100.0 * self.after:.3g} % of the torque of joint "
            f"{self.joint}, not {100.0 * self.before:.3g} %"
        )


def _cost(result: FitResult, data: Compressed, nearest: Nearest) -> _Cost:
    torque = data.torque_norms()
    driven = np.flatnonzero(torque > 0.0)
    values = _values(result)
    moved = np.append(nearest.beta, values[len(nearest.beta) :])
    after = data.residual_norms(moved)[driven] / torque[driven]
    before = data.residual_norms(values)[driven] / torque[driven]
    worst = int(np.argmax(after - before))
    return _Cost(result.joints[driven[worst]].name, float(before[worst]), float(after[worst]))


def _verdict(found: Sequence[Doubt], good: str) -> Verdict:
    lines = tuple(dict.fromkeys(doubt.line for doubt in found))
    fatal = [doubt for doubt in found if doubt.certain]
    if fatal:
        return Verdict(False, "nothing", f"not usable: {fatal[0].line}", lines)
    values = [doubt for doubt in found if doubt.values]
    if values:
        line = (
            f"usable for torques of like motion only: {good}; not for its values: {values[0].line}"
        )
        return Verdict(True, "like motion", line, lines)
    rest = f"; {found[0].line}" if found else "; a machine with these values could be built"
    return Verdict(True, "physics", f"usable: {good}{rest}", lines)
