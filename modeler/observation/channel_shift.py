"""Channels that contradict each other, in logs to which the model itself was fitted."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from modeler.numerics.least_squares import whitening
from modeler.observation.channels import SCALE, WRONG, Fault, turns
from modeler.observation.observation import Observation
from modeler.observation.thinned import ThinnedRows, thinned

if TYPE_CHECKING:
    from modeler.runtime.model import CompiledModel

SUSPECT = 0.2
"""Relative error of a joint from which on its fit is suspected."""

HALF = 0.5
"""Share of the error of the robot that one change of one channel leaves, to be believed."""

ALSO = 1.3
"""Times the least error that another change may leave and still explain the logs as well."""

DRIVES = -0.05
"""Power of the friction over that of the joint's torque and speed, below which friction drives."""

BOTH = 0.1
"""Least share of a joint's rows of each direction: one way only, friction is an offset."""

FELT = 0.1
"""Share of a joint's torque from which on its own inertia is felt, and ..."""

BEYOND = 2.0
"""... times the relative error of that joint: real wrists with cables have, fitted, negative
inertias as large as what their model lacks."""

_UNITS = 1e9  # units are no farther apart
_LEAST = 20  # rows of a joint whose torque is exchanged
_FOR_EACH = 3  # rows for every parameter, at least: fewer are described by anything
_TOLD = 1e-11  # eigenvalue over the largest


@dataclass(frozen=True)
class _Change:
    line: str
    error: float
    worst: float


def faults_of_fit(
    compiled: "CompiledModel", observation: Observation, beta: np.ndarray
) -> tuple[Fault, ...]:
    """Channels with a wrong sign or unit, or in the place of another, although the fit adapts.

    A fit to wrong channels has no prediction to compare with: it bends its parameters. What it
    cannot bend is that one set of them holds for all joints. So every joint's torque is tried
    with another sign and scale and in the place of another, every position reversed, in other
    units and exchanged, each time with a new fit; what alone halves the error of the robot is
    named. And friction takes energy and inertia resists: where they do not, a sign is wrong.

    Args:
        compiled: the robot.
        observation: that was fitted.
        beta: (c,) base parameters of the fit.
    """
    rows = thinned(compiled, observation)
    joints = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    joints = [j for j in joints if rows.tau[rows.used[:, j], j].any()]
    if not joints or rows.used[:, joints].sum() < _FOR_EACH * rows.W.shape[2]:
        return ()
    errors = _errors(rows.W, rows.tau, rows.used, joints)
    if max(errors) > SUSPECT:
        found = _changes(compiled, observation, rows, joints)
        least = min((change.error for change in found), default=np.inf)
        if least <= HALF * float(np.linalg.norm(errors)):
            likely = [c for c in sorted(found, key=lambda c: c.error) if c.error <= ALSO * least]
            alike = "".join(f"; or: {change.line}" for change in likely[1:3])
            return (Fault(f"{likely[0].line}{alike}", True),)
    left = dict(zip(joints, errors, strict=True))
    return _driven(compiled, observation, rows, beta, left)


def _errors(
    W: np.ndarray, tau: np.ndarray, used: np.ndarray, joints: list[int], free: int | None = None
) -> list[float]:
    """Relative error of each joint after a fit in which they weigh the same.

    Args:
        W: (m, n, c).
        tau: (m, n).
        used: (m, n).
        joints: that count.
        free: a joint whose torque has a scale of its own; its error is that of the scaled torque.
    """
    gain = _gain(W, tau, used, joints, free) if free is not None else 1.0
    blocks, right = [], []
    for j in joints:
        with np.errstate(over="ignore"):
            y = tau[used[:, j], j] * (gain if j == free else 1.0)
        if not np.isfinite(y).all():
            return [np.inf] * len(joints)
        size = max(float(np.linalg.norm(y)), 1e-300)
        blocks.append(W[used[:, j], j] / size)
        right.append(y / size)
    left = _left(np.concatenate(blocks), np.concatenate(right))
    ends = np.cumsum([len(y) for y in right])[:-1]
    return [float(np.linalg.norm(part)) for part in np.split(left, ends)]


def _gain(W: np.ndarray, tau: np.ndarray, used: np.ndarray, joints: list[int], free: int) -> float:
    """What the torque of a joint is to be multiplied by, from the torques of the others.

    W_j beta - gain y_j = 0 beside W_k beta = y_k: linear in beta and the gain.
    """
    blocks, right = [], []
    for j in joints:
        y = tau[used[:, j], j]
        size = max(float(np.linalg.norm(y)), 1e-300)
        own = -y / size if j == free else np.zeros(len(y))
        blocks.append(np.column_stack([W[used[:, j], j] / size, own]))
        right.append(np.zeros(len(y)) if j == free else y / size)
    return float(_solved(np.concatenate(blocks), np.concatenate(right))[-1])


def _solved(X: np.ndarray, y: np.ndarray) -> np.ndarray:
    # Many fits of a few digits: normal equations, without what the data cannot tell.
    turn = whitening(X.T @ X, _TOLD)
    return np.asarray(turn @ (turn.T @ (X.T @ y)))


def _left(X: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.asarray(y - X @ _solved(X, y))


def _changes(
    compiled: "CompiledModel", observation: Observation, rows: ThinnedRows, joints: list[int]
) -> list[_Change]:
    """What each change of the channels leaves; only those that describe every joint."""
    found = [*_torques(observation, rows, joints)]
    if compiled.spec.closure is None:  # positions that do not close the loops have no torque
        for turn in turns(observation):
            W, tau = rows.turned(compiled, turn.motion), rows.tau[:, turn.torque]
            used = rows.used & rows.used[:, turn.torque]
            if used[:, joints].sum(axis=0).min() >= _LEAST:
                found.append(_change(turn.line, _errors(W, tau, used, joints)))
    return [change for change in found if change.worst < WRONG]


def _change(line: str, errors: list[float]) -> _Change:
    return _Change(line, float(np.linalg.norm(errors)), max(errors))


def _torques(observation: Observation, rows: ThinnedRows, joints: list[int]) -> Iterator[_Change]:
    names = [joint.name for joint in observation.joints]
    for j in joints if len(joints) > 1 else ():
        gain = _gain(rows.W, rows.tau, rows.used, joints, j)
        if 1.0 / SCALE < gain < SCALE or not 1.0 / _UNITS < abs(gain) < _UNITS:
            continue
        says = "has the other sign of" if gain < 0.0 else f"is {1.0 / gain:.3g} times"
        line = (
            f"joint {names[j]}: the measured torque {says} what the other joints say of it; check "
            "sign, unit and drive gain of that channel"
        )
        yield _change(line, _errors(rows.W, rows.tau, rows.used, joints, free=j))
    for place, j in enumerate(joints):
        for k in joints[:place]:
            order = np.arange(len(names))
            order[[j, k]] = order[[k, j]]
            line = (
                f"joints {names[k]} and {names[j]}: their torques look exchanged; check the order "
                "of the columns"
            )
            both = rows.used & rows.used[:, order]
            if both[:, [j, k]].sum(axis=0).min() < _LEAST:
                continue
            yield _change(line, _errors(rows.W, rows.tau[:, order], both, joints))


def _driven(
    compiled: "CompiledModel", observation: Observation, rows: ThinnedRows, beta: np.ndarray,
    errors: dict[int, float],
) -> tuple[Fault, ...]:  # fmt: skip
    """Joints whose friction, as it was fitted, gives energy, or whose inertia pushes back.

    Where the inertia is felt no more than what the model lacks, noise may take it below 0.
    """
    friction, inertia = [], []
    for j, joint in enumerate(observation.joints):
        used = rows.used[:, j]
        speed, tau = rows.speed[used, j], rows.tau[used, j]
        own = _own_friction(compiled, joint.name)
        size = float(np.linalg.norm(speed) * np.linalg.norm(tau))
        both = min(np.mean(speed > 0.0), np.mean(speed < 0.0)) if size > 0.0 else 0.0
        if own and both > BOTH:
            power = float(speed @ (rows.W[used, j][:, own] @ beta[own])) / size
            if power < DRIVES:
                friction.append(joint.name)
        if j in errors and _pushes_back(compiled, rows, beta, j) > max(FELT, BEYOND * errors[j]):
            inertia.append(joint.name)
    names = list(dict.fromkeys([*friction, *inertia]))
    if not names:
        return ()
    causes = {"friction that drives the motion": friction, "a negative inertia": inertia}
    what = " and ".join(cause for cause, whose in causes.items() if whose)
    line = (
        f"joint{'s' if len(names) > 1 else ''} {', '.join(names)}: the fit has {what}; check the "
        "signs of torques and positions, their units, and whether columns are exchanged"
    )
    return (Fault(line, True),)


def _own_friction(compiled: "CompiledModel", joint: str) -> list[int]:
    """Base parameters that are the viscous or Coulomb friction of a joint, and nothing besides."""
    own = {
        p.name for p in compiled.spec.standard
        if p.effect in ("viscous", "coulomb") and p.joint == joint
    }  # fmt: skip
    return [
        k for k, base in enumerate(compiled.spec.base)
        if len(base.terms) == 1 and base.terms[0].parameter in own
    ]  # fmt: skip


def _pushes_back(compiled: "CompiledModel", rows: ThinnedRows, beta: np.ndarray, j: int) -> float:
    """Share of the torque that the inertia M_jj makes, if it is negative wherever the joint was.

    M_jj qdd_j is the torque at rest with that acceleration less the torque at rest. 0 if M_jj is
    positive somewhere, or if loops tie the accelerations of the joints together.
    """
    if compiled.spec.closure is not None:
        return 0.0
    felt, seen = 0.0, []
    for part in rows.parts:
        s = part.segment
        q, qdd = s.q[part.samples], s.qdd[part.samples]
        still, moved = np.zeros_like(q), np.zeros_like(q)
        moved[:, j] = 1.0
        columns = compiled.base_regressor(q, still, moved, part.read)[:, j]
        own = (columns - compiled.base_regressor(q, still, still, part.read)[:, j]) @ beta
        torque = part.rows.means(own * qdd[:, j], part.usable[:, j], part.used[:, j],
                                 s.whole[part.samples])  # fmt: skip
        felt += float(np.sum(torque[part.used[:, j]] ** 2))
        seen.append(own)
    inertia = np.concatenate(seen)
    size = float(np.sum(rows.tau[rows.used[:, j], j] ** 2))
    if size == 0.0 or np.quantile(inertia, 0.98) >= 0.0:
        return 0.0
    return float(np.sqrt(felt / size))
