"""All that contradicts in the data of a fit or of a prediction, the gravest first."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from modeler.numerics.filters import RowFilter
from modeler.numerics.least_squares import scaled_least_squares, whitening
from modeler.observation.channels import SCALE, WRONG, Fault, faults, turns
from modeler.observation.low_speed import signals_of
from modeler.observation.motion import Segment
from modeler.observation.observation import Observation
from modeler.observation.prepare import nearest_closed
from modeler.observation.reduce import columns_at
from modeler.observation.stretch import Stretch
from modeler.runtime import CompiledModel

_MOST = 1200  # rows: enough for any fit, and quick with every change that is tried
_CELLS = 8000  # joints times rows, at most: many joints make many pairs to exchange
_TAPS = 16  # samples of each row, of the many over which the parallel filter takes its mean


@dataclass(frozen=True, eq=False)
class ThinnedPart:
    """A stretch with some of its rows, and some of the samples that those reach."""

    segment: Segment
    samples: np.ndarray
    rows: RowFilter
    usable: np.ndarray
    used: np.ndarray
    read: np.ndarray | None

    def motion(self) -> tuple[np.ndarray, ...]:
        """q, qd, qdd of the samples."""
        s = self.segment
        return s.q[self.samples], s.qd[self.samples], s.qdd[self.samples]

    def means(self, values: np.ndarray, j: int) -> np.ndarray:
        """(m, ...) of values (samples, ...) of a joint, through the filter of its rows."""
        whole = self.segment.whole[self.samples]
        return self.rows.means(values, self.usable[:, j], self.used[:, j], whole)

    def columns(self, compiled: CompiledModel, motion: Sequence[np.ndarray]) -> np.ndarray:
        """(m, n, c) filtered columns of a motion q, qd, qdd of the samples."""
        q, qd, qdd = motion
        nearest = nearest_closed(compiled, q)  # a motion that was changed may leave what closes
        if nearest is not None:
            q = np.ascontiguousarray(q[nearest])
        values = compiled.base_regressor(q, qd, qdd, self.read)
        return np.stack([self.means(own, j) for j, own in enumerate(values.swapaxes(0, 1))], axis=1)


@dataclass(frozen=True, eq=False)
class ThinnedRows:
    """Some rows of an observation.

    Attributes:
        W: (m, n, c).
        tau: (m, n).
        used: (m, n) that count.
        speed: (m, n).
        parts: to build W anew of a motion that was changed.
    """

    W: np.ndarray
    tau: np.ndarray
    used: np.ndarray
    speed: np.ndarray
    parts: tuple[ThinnedPart, ...]

    def turned(self, compiled: CompiledModel, turn: np.ndarray) -> np.ndarray:
        """(m, n, c) columns of the motion q turn."""
        return np.concatenate(
            [part.columns(compiled, [x @ turn for x in part.motion()]) for part in self.parts]
        )

    def shifted(self, compiled: CompiledModel, shift: np.ndarray) -> np.ndarray:
        """(m, n, c) columns of the motion of each joint, shift (n,) s later."""
        found = []
        for part in self.parts:
            s = part.segment
            at = (s.time[part.samples][:, None] + shift).T
            motion = [
                np.column_stack([np.interp(t, s.time, own) for t, own in zip(at, x.T, strict=True)])
                for x in (s.q, s.qd, s.qdd)
            ]
            found.append(part.columns(compiled, motion))
        return np.concatenate(found)


def thinned(compiled: CompiledModel, observation: Observation) -> ThinnedRows:
    """At most 1200 of the rows of the observation, evenly; fewer of many joints."""
    most = max(1, min(_MOST, _CELLS // len(observation.joints)))
    every = max(1, -(-len(observation.time) // most))
    parts, chosen, at = [], [], 0
    for part in observation.stretches:
        rows = np.arange(-at % every, len(part.used), every)
        chosen.append(at + rows)
        at += len(part.used)
        if rows.size:
            parts.append(_part(compiled, part, rows))
    place = np.concatenate(chosen)
    return ThinnedRows(
        W=columns_at(observation, place),
        tau=observation.torque[place],
        used=observation.used[place],
        speed=observation.qd[place],
        parts=tuple(parts),
    )


def _part(compiled: CompiledModel, part: Stretch, rows: np.ndarray) -> ThinnedPart:
    weights = part.rows.weights[rows]
    width = max(1, int(np.max(np.diff(weights.indptr))))
    reached = np.unique(weights.indices)
    samples = reached[reached % max(1, width // _TAPS) == 0]
    read = signals_of(compiled.spec, part.segment)
    return ThinnedPart(
        segment=part.segment,
        samples=samples,
        rows=RowFilter(weights[:, samples], part.rows.centres[rows]),
        usable=part.usable[samples],
        used=part.used[rows],
        read=None if read is None else read[samples],
    )


# What contradicts.


HALF = 0.5
"""Share of the error of the robot that one change of a channel, or one shift of it, leaves, to be
believed: physics that a model lacks (elasticity, friction that lags) looks like a shift of a part
of the torque only."""

_LEAST_ROWS = 20  # of a joint whose torque is exchanged
_FOR_EACH = 3  # rows for every parameter, at least: fewer are described by anything


def findings_of_fit(
    compiled: CompiledModel, observation: Observation, beta: np.ndarray
) -> tuple[Fault, ...]:
    """Doubts about the channels and the samples of logs that a model was fitted to.

    Args:
        compiled: the robot.
        observation: that was fitted.
        beta: (c,) base parameters of the fit.
    """
    found = faults_of_fit(compiled, observation, beta)
    if not found:
        found = tuple(Fault(line, False) for line in late_channels(compiled, observation))
    return (*found, *(Fault(line, False) for line in observation.report.doubts()))


def findings_of_prediction(
    compiled: CompiledModel, observation: Observation, beta: np.ndarray
) -> tuple[Fault, ...]:
    """Doubts about the channels and the samples of logs whose torque a model predicts.

    Args:
        compiled: the robot.
        observation: of the logs.
        beta: (c,) base parameters of the model.
    """
    doubts = (Fault(line, False) for line in observation.report.doubts())
    return (*faults(compiled, observation, beta), *doubts)


def _judged(compiled: CompiledModel, observation: Observation) -> tuple[ThinnedRows, list[int]]:
    """Some rows, and the joints with a motor and a torque; none of too few rows."""
    rows = thinned(compiled, observation)
    joints = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    joints = [j for j in joints if rows.tau[rows.used[:, j], j].any()]
    enough = bool(joints) and rows.used[:, joints].sum() >= _FOR_EACH * rows.W.shape[2]
    return rows, joints if enough else []


# Every joint weighs the same: its rows are divided by the size of its torque.


def _sizes(tau: np.ndarray, used: np.ndarray, joints: Sequence[int]) -> dict[int, float]:
    """Of the torques (m, n) of some joints."""
    return {j: max(float(np.linalg.norm(tau[used[:, j], j])), 1e-300) for j in joints}


def _stacked(values: np.ndarray, used: np.ndarray, sizes: Mapping[int, float]) -> np.ndarray:
    """The used rows (m, n) of values (m, n, ...), joint after joint."""
    return np.concatenate([values[used[:, j], j] / size for j, size in sizes.items()])


# Channels that contradict each other, in logs to which the model itself was fitted.


SUSPECT = 0.2
"""Relative error of a joint from which on its fit is suspected."""

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
_TOLD = 1e-11  # eigenvalue over the largest


def faults_of_fit(
    compiled: CompiledModel, observation: Observation, beta: np.ndarray
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
    rows, joints = _judged(compiled, observation)
    if not joints:
        return ()
    errors = _errors(rows.W, rows.tau, rows.used, joints)
    if max(errors) > SUSPECT:
        changes = _changes(compiled, observation, rows, joints)
        sizes = [(float(np.linalg.norm(e)), line) for line, e in changes if max(e) < WRONG]
        least = min((size for size, _ in sizes), default=np.inf)
        if least <= HALF * float(np.linalg.norm(errors)):
            likely = sorted(
                (one for one in sizes if one[0] <= ALSO * least), key=lambda one: one[0]
            )
            return (Fault("; or: ".join(line for _, line in likely[:3]), True),)
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
    if free is not None:
        gain = _gain(W, tau, used, joints, free)
        with np.errstate(over="ignore"):
            tau = tau * np.where(np.arange(tau.shape[1]) == free, gain, 1.0)
    if not np.isfinite(tau[used]).all():
        return [np.inf] * len(joints)
    sizes = _sizes(tau, used, joints)
    X, y = (_stacked(values, used, sizes) for values in (W, tau))
    ends = np.cumsum([used[:, j].sum() for j in joints])[:-1]
    return [float(np.linalg.norm(part)) for part in np.split(y - X @ _solved(X, y), ends)]


def _gain(W: np.ndarray, tau: np.ndarray, used: np.ndarray, joints: list[int], free: int) -> float:
    """What the torque of a joint is to be multiplied by, from the torques of the others.

    W_j beta - gain y_j = 0 beside W_k beta = y_k: linear in beta and the gain.
    """
    sizes = _sizes(tau, used, joints)
    X, y = (_stacked(values, used, sizes) for values in (W, tau))
    own = np.repeat(joints, [used[:, j].sum() for j in joints]) == free
    solved = _solved(np.column_stack([X, np.where(own, -y, 0.0)]), np.where(own, 0.0, y))
    return float(solved[-1])


def _solved(X: np.ndarray, y: np.ndarray) -> np.ndarray:
    # Many fits of a few digits: normal equations, without what the data cannot tell.
    turn = whitening(X.T @ X, _TOLD)
    return np.asarray(turn @ (turn.T @ (X.T @ y)))


def _changes(
    compiled: CompiledModel, observation: Observation, rows: ThinnedRows, joints: list[int]
) -> Iterator[tuple[str, list[float]]]:
    """Changes of the channels, and the error of each joint that each of them leaves."""
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
        yield line, _errors(rows.W, rows.tau, rows.used, joints, free=j)
    for j, k in ((j, k) for place, j in enumerate(joints) for k in joints[:place]):
        order = np.arange(len(names))
        order[[j, k]] = order[[k, j]]
        both = rows.used & rows.used[:, order]
        if both[:, [j, k]].sum(axis=0).min() >= _LEAST_ROWS:
            line = (
                f"joints {names[k]} and {names[j]}: their torques look exchanged; check the order "
                "of the columns"
            )
            yield line, _errors(rows.W, rows.tau[:, order], both, joints)
    if compiled.spec.closure is not None:
        return  # positions that do not close the loops have no torque
    for turn in turns(observation):
        used = rows.used & rows.used[:, turn.torque]
        if used[:, joints].sum(axis=0).min() >= _LEAST_ROWS:
            W, tau = rows.turned(compiled, turn.motion), rows.tau[:, turn.torque]
            yield turn.line, _errors(W, tau, used, joints)


def _driven(
    compiled: CompiledModel, observation: Observation, rows: ThinnedRows, beta: np.ndarray,
    errors: dict[int, float],
) -> tuple[Fault, ...]:  # fmt: skip
    """Joints whose friction, as it was fitted, gives energy, or whose inertia pushes back.

    Where the inertia is felt no more than what the model lacks, noise may take it below 0.
    """
    friction, inertia = [], []
    for j, joint in enumerate(observation.joints):
        used = rows.used[:, j]
        speed, tau = rows.speed[used, j], rows.tau[used, j]
        own = _pure_friction(compiled, joint.name)
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


def _pure_friction(compiled: CompiledModel, joint: str) -> list[int]:
    """Base parameters that are the viscous or Coulomb friction of a joint, and nothing besides."""
    own = {
        p.name for p in compiled.spec.standard
        if p.effect in ("viscous", "coulomb") and p.joint == joint
    }  # fmt: skip
    return [
        k for k, base in enumerate(compiled.spec.base)
        if len(base.terms) == 1 and base.terms[0].parameter in own
    ]  # fmt: skip


def _pushes_back(compiled: CompiledModel, rows: ThinnedRows, beta: np.ndarray, j: int) -> float:
    """Share of the torque that the inertia M_jj makes, if it is negative wherever the joint was.

    M_jj qdd_j is the torque at rest with that acceleration less the torque at rest. 0 if M_jj is
    positive somewhere, or if loops tie the accelerations of the joints together.
    """
    if compiled.spec.closure is not None:
        return 0.0
    felt, seen = 0.0, []
    for part in rows.parts:
        q, _, qdd = part.motion()
        still, moved = np.zeros_like(q), np.zeros_like(q)
        moved[:, j] = 1.0
        columns = compiled.base_regressor(q, still, moved, part.read)[:, j]
        own = (columns - compiled.base_regressor(q, still, still, part.read)[:, j]) @ beta
        felt += float(np.sum(part.means(own * qdd[:, j], j)[part.used[:, j]] ** 2))
        seen.append(own)
    inertia = np.concatenate(seen)
    size = float(np.sum(rows.tau[rows.used[:, j], j] ** 2))
    if size == 0.0 or np.quantile(inertia, 0.98) >= 0.0:
        return 0.0
    return float(np.sqrt(felt / size))


# Channels that come late.


LONGEST = 0.15
"""s, the largest delay that is looked for: beyond it, channels do not look late but wrong."""

_STARTS = (-0.1, -0.05, 0.05, 0.1)  # s; a step along the slope goes astray from farther away
_LEAST = 0.02  # relative error of the robot below which nothing is looked for
_STEPS = 4  # of Gauss and Newton
Columns = Callable[[float], np.ndarray]
"""(m, n, c) columns with a channel taken some seconds later."""


@dataclass(frozen=True)
class _Channel:
    """What may be late.

    Attributes:
        what: it comes.
        other: what would then be early.
        sign: of its lateness, by the shift of the motion.
        columns: with the motion that many seconds later.
    """

    what: str
    other: str
    sign: float
    columns: Columns


def late_channels(compiled: CompiledModel, observation: Observation) -> tuple[str, ...]:
    """A sentence on the channel that fits far better at another time; none where none does.

    W(t + d) beta = tau(t) is fitted for a shift d of the motion of all joints, for the rows of
    each joint alone (its torque is late), and of the motion of each joint alone (its position is
    late), by Gauss and Newton; what halves the error of the robot, the root of the sum of
    e_j**2 with e_j = ||tau_j - W_j beta|| / ||tau_j||, is told.

    Args:
        compiled: the robot.
        observation: that was fitted.
    """
    rows, joints = _judged(compiled, observation)
    if not joints:
        return ()
    sizes = _sizes(rows.tau, rows.used, joints)
    step = float(np.median([part.segment.step for part in observation.stretches]))

    def left(W: np.ndarray) -> tuple[float, np.ndarray]:
        """The error that a fit leaves in which every joint weighs the same, and its solution."""
        X, y = (_stacked(values, rows.used, sizes) for values in (W, rows.tau))
        beta = scaled_least_squares(X, y, 1e-6)
        return float(np.linalg.norm(y - X @ beta)), beta

    def best(columns: Columns) -> tuple[float, float]:
        """The least error that a shift of a channel leaves, and the shift, s."""
        tried = [(before, 0.0, rows.W)]
        for start in _STARTS:
            W = columns(start)
            tried.append((left(W)[0], start, W))
        error, shift, W = min(tried, key=lambda one: one[0])
        for _ in range(_STEPS):
            slope = (columns(shift + step) - W) @ left(W)[1] / step
            _, found = left(np.concatenate([W, slope[..., None]], axis=2))
            further = float(np.clip(shift + found[-1], -LONGEST, LONGEST))
            closer = columns(further)
            reached, _ = left(closer)
            if reached >= error:
                break
            shift, W, error = further, closer, reached
        return error, shift

    before, _ = left(rows.W)
    if before < _LEAST:
        return ()
    found = [(*best(one.columns), one) for one in _channels(compiled, observation, rows, joints)]
    error, shift, channel = min(found, key=lambda one: one[0])
    if error > HALF * before:
        return ()
    way, back = ("late", "early") if channel.sign * shift > 0.0 else ("early", "late")
    return (
        f"{channel.what} {1e3 * abs(shift):.0f} ms {way}, by a fit at other times (or "
        f"{channel.other} {back}); check the clocks of the channels, and shift the column",
    )


def _channels(
    compiled: CompiledModel, observation: Observation, rows: ThinnedRows, joints: Sequence[int]
) -> list[_Channel]:
    """What may be late."""
    n = rows.tau.shape[1]

    @cache
    def all_later(shift: float) -> np.ndarray:
        return rows.shifted(compiled, np.full(n, shift))

    def torque_earlier(j: int, shift: float) -> np.ndarray:
        W = rows.W.copy()
        W[:, j] = all_later(shift)[:, j]
        return W

    def one_later(j: int, shift: float) -> np.ndarray:
        return rows.shifted(compiled, shift * np.eye(n)[j])

    found = [_Channel("all torques come", "the positions", -1.0, all_later)]
    if compiled.spec.closure is not None or len(joints) == 1:
        return found  # positions that are not of one time do not close the loops
    for j in joints:
        name, rest = f"joint {observation.joints[j].name}:", "all the others"
        found += [
            _Channel(f"{name} its torque comes", rest, -1.0, partial(torque_earlier, j)),
            _Channel(f"{name} its position comes", rest, 1.0, partial(one_later, j)),
        ]
    return found
