"""Faults of logs: one rule decides what is wrong with channels, before any physics is blamed.

A fault is a hypothesis: undo it, and what a machine leaves of the torques of joint j,

    e_j = ||tau_j - W_j beta|| / ||tau_j||,

falls. beta is that of the nearest machine that could be built to a fit in which every joint weighs
1 / e_j^2, so that sum_j log e_j is least, or that of a model whose torques are compared. A fault
is told if it lowers that sum by log 3 or more, halves the error of a joint, and does so as well as
any other. What it would be seen by can be computed beforehand: made of the torques of the machine
itself, a fault that raises the sum by no more is one that these logs cannot show.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import combinations

import numpy as np

from modeler.estimation.gravity import ABSENT, extract_gravity
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.nearest_body import (
    PhysicalParameters,
    define_physical_parameters,
    project_parameters,
)
from modeler.regression import (
    DataWarning,
    MotionTransform,
    Observation,
    ThinnedRows,
    propose_clocks,
    propose_transforms,
    propose_zero,
    thin_rows,
)
from modeler.runtime import CompiledModel, map_parts

HALF = 0.5
"""Share of its error that a fault, undone, leaves of a joint: physics that a model lacks
(elasticity, friction that lags) looks like a fault for a part of the torque only."""

ALSO = 1.3
"""Times the least that another fault may leave and still explain the logs as well."""

FLOOR = 0.001
"""Relative error below which all are alike."""

SUSPECT = 0.1
"""Relative error of a joint from which on its channels may be those of another, or another's."""

WRONG = 0.5
"""Relative error of a joint from which on a prediction of its torque is no matter of physics."""

ENOUGH = float(np.log(3.0))
"""What a fault adds to the sum of the logarithms of the errors, at least: physics that a model
lacks, and noise of the motion, look like a delay by up to 1."""

GAIN = 1.4
"""A torque is wrong by more than this factor, or a drive gain is not known better."""

SCALE = 5.0
"""A torque that is off by this factor is a matter of units, not of a drive gain or a load."""

_MILLI = 1e-3  # N m in mN m
_UNITS = 1e9  # units are no farther apart
_LEAST_ROWS = 20  # of a joint whose torque is exchanged
_FOR_EACH = 3  # rows for every parameter, at least: fewer are described by anything
_RIDGE = 1e-11  # of the normal equations, of columns of length one
_TURNS = 4  # of weights; they settle by a digit each time
_SUBSETS = 8  # joints of which every subset is tried
_MACHINES = 8  # subsets of which the machine is asked for


@dataclass(frozen=True, eq=False)
class NormalEquations:
    """Of the rows of k joints, torques of length one: all that a fit of them needs.

    Attributes:
        gram: (k, c, c) X_j^T X_j.
        cross: (k, c) X_j^T y_j.
    """

    gram: np.ndarray
    cross: np.ndarray

    def scale_torques(self, gains: np.ndarray) -> "NormalEquations":
        """Of torques that are multiplied by gains (k,)."""
        return NormalEquations(self.gram / gains[:, None, None] ** 2, self.cross / gains[:, None])

    def compute_errors(self, beta: np.ndarray) -> np.ndarray:
        """(k,) relative error of each joint."""
        square = 1.0 - 2.0 * self.cross @ beta + np.einsum("c,kcd,d->k", beta, self.gram, beta)
        return np.asarray(np.sqrt(np.maximum(square, 0.0)))


def _compute_lengths(y: np.ndarray) -> np.ndarray:
    """(k,) norms of the torques of joints; none so small beside others that rows overflow."""
    length = np.linalg.norm(y, axis=0)
    return np.asarray(np.maximum(length, 1e-9 * length.max(initial=0.0) or 1.0))


def _build_normal_equations(
    W: np.ndarray, tau: np.ndarray, used: np.ndarray, joints: Sequence[int]
) -> NormalEquations:
    """Of rows W (m, n, c), tau (m, n), used (m, n)."""
    y = np.where(used, tau, 0.0)[:, joints]
    length = _compute_lengths(y)
    X = (np.where(used[..., None], W, 0.0)[:, joints] / length[:, None]).transpose(1, 2, 0)
    return NormalEquations(X @ X.transpose(0, 2, 1), np.einsum("kcm,mk->kc", X, y / length))


@dataclass(frozen=True, eq=False)
class ResidualModel:
    """What a machine leaves of torques.

    Attributes:
        machine: that can be built.
        beta: (c,) of a model that predicts; None: each time it is fitted.
    """

    machine: PhysicalParameters
    beta: np.ndarray | None = None

    def solve(self, data: NormalEquations) -> tuple[np.ndarray, np.ndarray]:
        """beta (c,) and weights (k,) that make the sum of the logarithms of the errors least."""
        weights = np.ones(len(data.gram))
        if self.beta is not None:
            return self.beta, weights
        for _ in range(_TURNS):
            beta = _solve_weighted(data, weights)
            weights = 1.0 / np.maximum(data.compute_errors(beta), FLOOR) ** 2
        return beta, weights

    def compute_errors(self, data: NormalEquations, possible: bool = True) -> np.ndarray:
        """(k,) relative errors, of a machine that can be built if asked for."""
        beta, weights = self.solve(data)
        if possible and self.beta is None:
            beta = self.project_fit(data, beta, weights)
        return data.compute_errors(beta)

    def project_fit(
        self, data: NormalEquations, beta: np.ndarray, weights: np.ndarray
    ) -> np.ndarray:
        """(c,) the nearest machine that can be built; the fit itself where none is found."""
        values, vectors = np.linalg.eigh(np.tensordot(weights, data.gram, 1))
        root = np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T
        nearest = project_parameters(self.machine, beta, root)
        return beta if nearest is None else nearest.beta


def _solve_weighted(data: NormalEquations, weights: np.ndarray) -> np.ndarray:
    return _solve_normal_equations(np.tensordot(weights, data.gram, 1), weights @ data.cross)


def _solve_normal_equations(gram: np.ndarray, cross: np.ndarray) -> np.ndarray:
    """Of normal equations: many fits of a few digits; a ridge for what the data cannot tell."""
    size = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    scaled = gram / np.outer(size, size) + _RIDGE * np.eye(len(gram))
    return np.asarray(np.linalg.solve(scaled, cross / size) / size)


def _compute_log_error(errors: np.ndarray) -> float:
    return float(np.sum(np.log(np.maximum(errors, FLOOR))))


def _compute_evidence(without: np.ndarray, with_it: np.ndarray) -> float:
    """What a fault adds to the sum of logarithms; 0 if it doubles the error of no joint."""
    doubles = np.maximum(without, FLOOR) <= HALF * np.maximum(with_it, FLOOR)
    return _compute_log_error(with_it) - _compute_log_error(without) if doubles.any() else 0.0


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """A fault that a log may have.

    Attributes:
        fault: in words.
        data: of the log with the fault undone.
        touches: joints that it concerns; empty: all.
        least: what it must add to the sum of logarithms.
        judge: of its columns, where they are not those of the robot.
    """

    fault: DataWarning
    data: NormalEquations
    joints: tuple[int, ...] = ()
    min_evidence: float = ENOUGH
    judge: ResidualModel | None = None


@dataclass(frozen=True, eq=False)
class Evidence:
    """Some rows of logs, and who judges them.

    Attributes:
        compiled: the robot.
        observation: of the logs.
        judge: of their torques.
        rows: some of them.
        joints: with a motor and a torque; none of too few rows.
    """

    compiled: CompiledModel
    observation: Observation
    judge: ResidualModel
    rows: ThinnedRows
    joints: tuple[int, ...]

    @cached_property
    def data(self) -> NormalEquations:
        """Of the log as it is."""
        return _build_normal_equations(self.rows.W, self.rows.tau, self.rows.used, self.joints)

    @cached_property
    def errors(self) -> np.ndarray:
        """(k,) of the log as it is."""
        return self.judge.compute_errors(self.data)

    @cached_property
    def has_large_errors(self) -> bool:
        """True if much is left, or no machine that could be built leaves as little as the fit."""
        free = self.judge.compute_errors(self.data, possible=False)
        return bool(self.errors.max() > SUSPECT) or _compute_evidence(free, self.errors) > ENOUGH

    @property
    def is_tree(self) -> bool:
        """True if joints move on their own: positions that do not close loops have no torque."""
        return self.compiled.spec.closure is None

    def get_joint_name(self, place: int) -> str:
        """Of one of the joints."""
        return self.observation.joints[self.joints[place]].name


def _gather_evidence(
    compiled: CompiledModel, observation: Observation, beta: np.ndarray | None = None
) -> Evidence:
    rows = thin_rows(compiled, observation)
    joints = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    joints = [j for j in joints if rows.tau[rows.used[:, j], j].any()]
    enough = bool(joints) and rows.used[:, joints].sum() >= _FOR_EACH * rows.W.shape[2]
    judge = ResidualModel(define_physical_parameters(compiled.spec), beta)
    return Evidence(compiled, observation, judge, rows, tuple(joints if enough else ()))


# What contradicts.


def find_log_faults(
    compiled: CompiledModel, observation: Observation, model: IdentifiedModel | None = None
) -> tuple[DataWarning, ...]:
    """What is wrong with the channels and the samples of logs; alike wherever it is asked for.

    The one fault that explains most of what a fit to the logs leaves; if there is none, and no
    model either, which faults could not be seen in any case. A model that was fitted to other logs
    is asked first, for the joints that it misses by more than half.

    Args:
        compiled: the robot.
        observation: of the logs.
        model: whose torques are compared, or explained; None: the logs are fitted.
    """
    others = model is not None and not any(
        used.has_rows_of(log) for used in model.logs for log in observation.report.logs
    )
    faults = _find_by_prediction(compiled, observation, model.beta) if model and others else []
    faults = faults or _find_by_fit(compiled, observation, unseen=model is None)
    return (*faults, *(DataWarning(line) for line in observation.report.collect_warnings()))


def _find_by_fit(
    compiled: CompiledModel, observation: Observation, unseen: bool
) -> list[DataWarning]:
    seen = _gather_evidence(compiled, observation)
    if not seen.joints:
        return []
    explanation = _select_hypothesis(seen)
    if explanation is not None:
        return [explanation.fault]
    return _find_undetectable(seen) if unseen else []


def _find_by_prediction(
    compiled: CompiledModel, observation: Observation, beta: np.ndarray
) -> list[DataWarning]:
    seen, faults = _gather_evidence(compiled, observation, beta), list[DataWarning]()
    while seen.joints and seen.errors.max() > WRONG:
        explanation = _select_hypothesis(seen)
        if explanation is None:
            break
        faults.append(explanation.fault)
        rest = [j for j in seen.joints if explanation.joints and j not in explanation.joints]
        seen = replace(seen, joints=tuple(rest))
    return faults


def _select_hypothesis(seen: Evidence) -> Hypothesis | None:
    """The hypothesis that explains most, with those that do as well in its words."""
    gravities = [*_propose_gravity_faults(seen)]
    tried = [
        *_propose_torque_faults(seen),
        *gravities,
        *_propose_motion_faults(seen, bool(gravities)),
    ]
    scores = map_parts(partial(_compute_reduction, seen), tried)
    candidates = [
        (score, one) for score, one in zip(scores, tried, strict=True) if score >= one.min_evidence
    ]
    if not candidates:
        return None
    if any(one.fault.line.startswith(ABSENT) for _, one in candidates):
        candidates = [pair for pair in candidates if "the clock seems" not in pair[1].fault.line]
    most = max(score for score, _ in candidates)
    candidates.sort(key=lambda pair: -pair[0])
    likely = [one for score, one in candidates if score >= most - np.log(ALSO)]
    line = "; or: ".join(dict.fromkeys(one.fault.line for one in likely[:3]))
    certain = all(one.fault.is_certain for one in likely)
    touched = tuple({j for one in likely for j in one.joints})
    about = tuple(seen.observation.joints[j].name for j in sorted(touched))
    fault = replace(likely[0].fault, line=line, is_certain=certain, joints=about)
    return Hypothesis(fault, likely[0].data, touched)


def _compute_reduction(seen: Evidence, one: Hypothesis) -> float:
    """By how much a hypothesis lowers the sum of logarithms; 0 if it is none."""
    score = 0.0
    for possible in (False, True):  # machines that can be built leave more, and take longer
        errors = (one.judge or seen.judge).compute_errors(one.data, possible)
        score = _compute_evidence(errors, seen.errors)
        if score < one.min_evidence or errors.max() > WRONG:
            return 0.0
    return score


# Hypotheses about torques.


def _propose_torque_faults(seen: Evidence) -> Iterator[Hypothesis]:
    """Torques of another scale or sign, and exchanged ones."""
    every = range(len(seen.joints))
    for place in every if len(seen.joints) > 1 or seen.judge.beta is not None else ():
        estimated_gain = _estimate_gain(seen, place)
        for gain in (
            (_MILLI,) if abs(estimated_gain - _MILLI) < 0.1 * _MILLI else (estimated_gain, _MILLI)
        ):
            if not 1.0 / _UNITS < gain < _UNITS or 1.0 / GAIN < gain < GAIN:
                continue
            unit = " (is it in mN m?)" if gain == _MILLI else ""
            line = (
                f"joint {seen.get_joint_name(place)}: the measured torque is {1.0 / gain:.3g} "
                "times what it "
                f"should be{unit}; check unit and drive gain of that channel"
            )
            j = seen.joints[place]
            fault = DataWarning(line, not 1.0 / SCALE < gain < SCALE, joint=j)
            yield Hypothesis(fault, _apply_gain(seen.data, place, gain), (j,))
    yield from _propose_sign_faults(seen)
    if not seen.has_large_errors:
        return
    rows, J = seen.rows, len(seen.observation.joints)
    for a, b in combinations(every, 2):
        order, (j, k) = np.arange(J), (seen.joints[a], seen.joints[b])
        order[[j, k]] = order[[k, j]]
        both = rows.used & rows.used[:, order]
        if both[:, [j, k]].sum(axis=0).min() >= _LEAST_ROWS:
            line = (
                f"joints {seen.get_joint_name(a)} and {seen.get_joint_name(b)}: their torques look "
                "exchanged; check "
                "the order of the columns"
            )
            data = _build_normal_equations(rows.W, rows.tau[:, order], both, seen.joints)
            yield Hypothesis(DataWarning(line, True), data, (j, k))


def _estimate_gain(seen: Evidence, place: int) -> float:
    """What the torque of a joint is to be multiplied by, from the torques of the others.

    X_j beta - gain y_j = 0 beside X_k beta = y_k: linear in beta and the gain.
    """
    data, weights, gain = seen.data, np.ones(len(seen.joints)), 0.0
    if seen.judge.beta is not None:
        return float(data.cross[place] @ seen.judge.beta)
    for _ in range(_TURNS):
        weight, side = weights[place], -weights[place] * data.cross[place]
        gram = np.tensordot(weights, data.gram, 1)
        whole = np.block([[gram, side[:, None]], [side[None], np.array([[weight]])]])
        solved = _solve_normal_equations(whole, np.append(weights @ data.cross + side, 0.0))
        gain = float(solved[-1])
        if not 1.0 / _UNITS < abs(gain) < _UNITS:
            break
        weights = (
            1.0
            / np.maximum(_apply_gain(seen.data, place, gain).compute_errors(solved[:-1]), FLOOR)
            ** 2
        )
        weights[place] /= gain**2
    return gain


def _apply_gain(data: NormalEquations, places: int | Sequence[int], gain: float) -> NormalEquations:
    """Of the log with the torques of some joints multiplied by a gain."""
    return data.scale_torques(np.where(np.isin(np.arange(len(data.gram)), places), gain, 1.0))


def _propose_sign_faults(seen: Evidence) -> Iterator[Hypothesis]:
    """Some torques of the other sign: every subset of a few joints, all and single ones of many.

    A subset and the rest leave the same without a machine: friction and inertia tell them apart.
    """
    count = len(seen.joints)
    sizes = range(1, count + 1) if count <= _SUBSETS else (1, count)
    tried = [subset for size in sizes for subset in combinations(range(count), size)]
    least = _compute_log_error(seen.errors) + np.log(HALF)
    plausible, scores = [], dict[tuple[int, ...], float]()
    for subset in tried:
        rest = tuple(k for k in range(count) if k not in subset)
        if seen.judge.beta is not None or rest not in scores:
            data = _apply_gain(seen.data, subset, -1.0)
            scores[subset] = _compute_log_error(seen.judge.compute_errors(data, possible=False))
        else:
            scores[subset] = scores[rest]
        if scores[subset] <= least:
            plausible.append(subset)
    for subset in sorted(plausible, key=lambda subset: (round(scores[subset], 1), len(subset)))[
        :_MACHINES
    ]:
        names, s = ", ".join(seen.get_joint_name(k) for k in subset), "s" * (len(subset) > 1)
        whose = f"joint{s} {names}: the measured torque{s} ha{'ve' if s else 's'}"
        if len(subset) == count > 1:
            whose = "all measured torques have"
        line = f"{whose} the other sign of what a machine that can be built needs; check the sign"
        j = tuple(seen.joints[k] for k in subset)
        yield Hypothesis(DataWarning(line, True), _apply_gain(seen.data, subset, -1.0), j)


# Hypotheses about gravity.


def _propose_gravity_faults(seen: Evidence) -> Iterator[Hypothesis]:
    """Gravity absent, compensated by the drives, of another size, sense or direction."""
    gravity = extract_gravity(seen.compiled, seen.rows, free=seen.judge.beta is None)
    if gravity is None:
        return
    judge, rows = replace(seen.judge, machine=gravity.machine), seen.rows
    parts = np.concatenate([gravity.motion, *gravity.per_axis], axis=2)
    every, count = (
        _build_normal_equations(parts, rows.tau, rows.used, seen.joints),
        len(gravity.per_axis),
    )

    def data_of(g: np.ndarray) -> NormalEquations:
        v, split = np.append(1.0, g), (len(every.gram), count + 1, -1)
        gram = every.gram.reshape(*split, count + 1, gravity.motion.shape[2])
        cross = np.einsum("kap,a->kp", every.cross.reshape(split), v)
        return NormalEquations(np.einsum("kapbq,a,b->kpq", gram, v, v, optimize=True), cross)

    def left(g: np.ndarray) -> float:
        return _compute_log_error(judge.compute_errors(data_of(g), possible=False))

    def step(g: np.ndarray) -> np.ndarray:
        p = gravity.motion.shape[2]
        beta, _ = judge.solve(data_of(g))
        axes = np.kron(np.eye(count + 1)[:, 1:], beta[:, None])  # torques of single axes
        mixed = np.hstack([np.kron(np.append(1.0, g)[:, None], np.eye(p)), axes])
        gram = np.matmul(mixed.T, every.gram @ mixed)
        return judge.solve(NormalEquations(gram, every.cross @ mixed))[0][p:]

    for g in gravity.propose_candidates(left, step, seen.has_large_errors):
        yield Hypothesis(DataWarning(gravity.format_line(g), True), data_of(g), judge=judge)


# Hypotheses about positions and times.


def _propose_motion_faults(seen: Evidence, clocked: bool) -> Iterator[Hypothesis]:
    """Positions in other units, reversed, exchanged, from another zero; what comes late.

    Other clocks where much is left, or where gravity looks like another.
    """
    tried = [*propose_clocks(seen.observation)] if seen.has_large_errors or clocked else []
    tried += (
        propose_transforms(seen.observation, zeros_only=not seen.has_large_errors)
        if seen.is_tree
        else []
    )
    for turn, turned in zip(tried, map_parts(partial(_transform_rows, seen), tried), strict=True):
        if turned is not None:
            yield Hypothesis(DataWarning(turn.line, True), turned)
    if seen.judge.beta is None:
        yield from _propose_delays(seen)


def _transform_rows(seen: Evidence, turn: MotionTransform) -> NormalEquations | None:
    """Of other positions; None where too few rows count."""
    used = seen.rows.used & seen.rows.used[:, turn.torque]
    if used[:, list(seen.joints)].sum(axis=0).min() < _LEAST_ROWS:
        return None
    W, tau = seen.rows.transform_columns(seen.compiled, turn), seen.rows.tau[:, turn.torque]
    return _build_normal_equations(W, tau, used, seen.joints)


LONGEST = 0.15
"""s, the largest delay that is looked for: beyond it, channels do not look late but wrong."""

_STARTS = (-0.1, -0.05, 0.05, 0.1)  # s; a step along the slope goes astray from farther away
_DELAY = 0.01  # s; a shorter one is not asked for where nothing is late
_SHOWN = 0.02  # s; from what it does that of other delays is taken: it grows with the delay
_NEAR = 5e-3  # s between the motions of which a slope is taken
_STEPS = 4  # of Gauss and Newton
_HINT = 0.2  # of the sum of logarithms; what a small part of a shift explains at least
_DECAY = tuple(zip(*np.polynomial.laguerre.laggauss(5), strict=True))
"""Of 1/(tau s + 1) = int exp(-u) exp(-u tau s) du: delays over tau, and their weights."""

Columns = Callable[[float, np.ndarray | None], np.ndarray]
"""(m, n, c) columns with a channel taken some seconds later; with beta (c,) torques (m, n)."""


@dataclass(frozen=True)
class _Channel:
    """What may be late.

    Attributes:
        what: it comes.
        other: what would then be early.
        sign: of its lateness, by the shift of the motion.
        columns: with the motion that many seconds later.
        lagged: of a torque behind a first-order filter, of that time constant (negative), s.
    """

    what: str
    other: str
    sign: float
    columns: Columns
    lagged: Columns | None = None


def _propose_delays(seen: Evidence) -> Iterator[Hypothesis]:
    """Channels of another time: all torques, and of one joint torque, position, or both.

    W(t + d) beta = tau(t) is fitted for a shift d of the motion of all joints, for the rows of a
    joint alone (its torque is late), and of the motion of a joint alone (its position is late), by
    Gauss and Newton.
    """
    step = float(np.median([part.segment.step for part in seen.observation.stretches]))
    channels = _collect_channels(seen)
    shifts = map_parts(partial(_find_best_shift, seen), [channel.columns for channel in channels])
    for channel, (shift, data) in zip(channels, shifts, strict=True):
        way, back = ("late", "early") if channel.sign * shift > 0.0 else ("early", "late")
        line = (
            f"{channel.what} {1e3 * abs(shift):.0f} ms {way}, by a fit at other times (or "
            f"{channel.other} {back}); check the clocks of the channels, and shift the column"
        )
        if abs(shift) > 0.5 * step:
            yield Hypothesis(DataWarning(line), data, min_evidence=_require_evidence(shift))
        if channel.lagged is not None and shift < -0.5 * step:
            tau, data = _find_best_shift(seen, channel.lagged)
            line = (
                f"{channel.what} through a first-order low-pass filter with a time constant of "
                f"{-1e3 * tau:.0f} ms; log the unfiltered torque"
            )
            if tau < -0.5 * step:
                yield Hypothesis(DataWarning(line), data, min_evidence=_require_evidence(tau))


def _require_evidence(shift: float) -> float:
    """What a delay must explain; more the less usual it is: physics looks like any delay."""
    seconds = abs(shift)
    return ENOUGH + float(np.log(max(seconds / _SHOWN, _DELAY / seconds, 1.0)))


def _find_best_shift(seen: Evidence, columns: Columns) -> tuple[float, NormalEquations]:
    """The shift of a channel that leaves least, s, and what it leaves that of.

    A channel whose shift, to first order, does not help is given up; where torques are missed by
    far, a long delay is looked for too.
    """
    rows, judge = seen.rows, seen.judge

    def data_of(W: np.ndarray) -> NormalEquations:
        return _build_normal_equations(W, rows.tau, rows.used, seen.joints)

    def left(data: NormalEquations) -> float:
        return _compute_log_error(judge.compute_errors(data, possible=False))

    least, shift, W, data = left(seen.data), 0.0, rows.W, seen.data
    for start in _STARTS if seen.has_large_errors else ():
        other = data_of(moved := columns(start, None))
        if (score := left(other)) < least:
            least, shift, W, data = score, start, moved, other
    for _ in range(_STEPS):
        beta, _ = judge.solve(data)
        near = 0.5 * _NEAR  # both sides alike: columns of other times have samples of their own
        slope = (columns(shift + near, beta) - columns(shift - near, beta)) / _NEAR
        both = _append_column(data, seen, W, slope)
        coefficients, _ = judge.solve(both)
        if shift == 0.0 and _compute_log_error(both.compute_errors(coefficients)) > least - _HINT:
            break
        further = float(np.clip(shift + coefficients[-1], -LONGEST, LONGEST))
        closer = columns(further, None)
        reached = left(other := data_of(closer))
        if reached >= least:
            break
        shift, W, data, least = further, closer, other, reached
    return shift, data


def _append_column(
    data: NormalEquations, seen: Evidence, W: np.ndarray, column: np.ndarray
) -> NormalEquations:
    """Of rows W (m, n, c), whose products are there, with a column (m, n) more."""
    joints, used = list(seen.joints), seen.rows.used
    y, z = (np.where(used, x, 0.0)[:, joints] for x in (seen.rows.tau, column))
    length = _compute_lengths(y)
    counted = (np.where(used[:, j, None], W[:, j], 0.0) for j in joints)
    beside = np.stack([side @ w for side, w in zip(z.T, counted, strict=True)])
    beside /= length[:, None] ** 2
    side = np.sum(z**2, axis=0) / length**2
    sides = np.concatenate([beside, side[:, None]], axis=1)
    gram = np.concatenate([data.gram, beside[:, :, None]], axis=2)
    gram = np.concatenate([gram, sides[:, None]], axis=1)
    cross = np.column_stack([data.cross, np.sum(z * y, axis=0) / length**2])
    return NormalEquations(gram, cross)


def _collect_channels(seen: Evidence) -> list[_Channel]:
    """What may be late."""
    n = len(seen.observation.joints)
    compiled, rows = seen.compiled, seen.rows

    cached_columns: dict[
        float, np.ndarray
    ] = {}  # columns of all, which every torque by itself needs

    def all_later(shift: float, beta: np.ndarray | None) -> np.ndarray:
        if beta is not None or shift not in cached_columns:
            columns = rows.shift_columns(compiled, np.full(n, shift), beta)
            return columns if beta is not None else cached_columns.setdefault(shift, columns)
        return cached_columns[shift]

    def all_lagged(tau: float, beta: np.ndarray | None) -> np.ndarray:
        every = [w * rows.shift_columns(compiled, np.full(n, tau * u), beta) for u, w in _DECAY]
        return np.asarray(np.sum(every, axis=0))

    def torque_alone(
        all_moved: Columns, j: int, shift: float, beta: np.ndarray | None
    ) -> np.ndarray:
        columns = (rows.W if beta is None else rows.W @ beta).copy()
        columns[:, j] = all_moved(shift, beta)[:, j]
        return columns

    def one_later(j: int, shift: float, beta: np.ndarray | None) -> np.ndarray:
        return rows.shift_columns(compiled, shift * np.eye(n)[j], beta)

    def both_later(j: int, shift: float, beta: np.ndarray | None) -> np.ndarray:
        columns = one_later(j, shift, beta)
        columns[:, j] = rows.shift_columns(compiled, shift * (np.eye(n)[j] - 1.0), beta)[:, j]
        return columns

    channels = [_Channel("all torques come", "the positions", -1.0, all_later, all_lagged)]
    if not seen.is_tree or len(seen.joints) == 1:
        return channels  # positions that are not of one time do not close the loops
    for place, j in enumerate(seen.joints):
        name, rest = f"joint {seen.get_joint_name(place)}:", "all the others"
        channels += [
            _Channel(f"{name} its torque comes", rest, -1.0, partial(torque_alone, all_later, j),
                     partial(torque_alone, all_lagged, j)),
            _Channel(f"{name} its position comes", rest, 1.0, partial(one_later, j)),
            _Channel(f"{name} its position and torque come", rest, 1.0, partial(both_later, j)),
        ]  # fmt: skip
    return channels


# What could not be seen in any case.


A_THIRD = 4.0 / 3.0
"""Times the error of a joint that a delay must make of it before it is detectable."""

SURELY = 1.5
"""Times the evidence that is told, below which a fault would not be seen for sure."""


def _find_undetectable(seen: Evidence) -> list[DataWarning]:
    """Faults that torques of the machine itself would not show, beside what is left of them."""
    if seen.errors.max() > WRONG:
        return []
    beta = seen.judge.project_fit(seen.data, *seen.judge.solve(seen.data))
    hidden: dict[str, list[str]] = {}
    for place in range(len(seen.joints)):
        for what, data in _simulate_faults(seen, place, beta):
            if _is_hidden(seen, data):
                hidden.setdefault(what, []).append(seen.get_joint_name(place))
    parts = [f"{what} of joint {', '.join(hidden[what])}" for what in sorted(hidden)]
    parts += _bound_delays(seen, beta) if seen.is_tree and len(seen.joints) > 1 else []
    line = f"Not detectable in these logs: {'; '.join(parts)}"
    return [DataWarning(line, is_undetectable=True)] if parts else []


def _simulate_faults(
    seen: Evidence, place: int, beta: np.ndarray
) -> Iterator[tuple[str, NormalEquations]]:
    """Logs of the machine with a fault of one joint."""
    data, joint = (
        _simulate_data(seen, seen.rows.W, beta),
        seen.observation.joints[seen.joints[place]],
    )
    yield "a wrong sign of the torque", _apply_gain(data, place, -1.0)
    yield "a scale error of 2 on the torque", _apply_gain(data, place, 0.5)
    if seen.is_tree and joint.unit == "rad":
        W = seen.rows.transform_columns(
            seen.compiled, propose_zero(seen.observation, seen.joints[place], 90)
        )
        yield "a zero off by 90 degrees", _simulate_data(seen, W, beta)


def _bound_delays(seen: Evidence, beta: np.ndarray) -> list[str]:
    """How late a joint may be before its error rises by a third, beside a fit."""
    short, never = list[str](), list[str]()
    for place, j in enumerate(seen.joints):
        joint_error, least = max(float(seen.errors[place]), FLOOR), _SHOWN
        for _ in range(2):  # what a delay makes grows with it: hypot(made, own) = A_THIRD own
            later = seen.rows.shift_columns(
                seen.compiled, least * np.eye(len(seen.observation.joints))[j]
            )
            made = seen.judge.compute_errors(_simulate_data(seen, later, beta), possible=False)[
                place
            ]
            least *= joint_error * (A_THIRD**2 - 1.0) ** 0.5 / max(float(made), 1e-3 * joint_error)
            least = min(least, 1.1 * LONGEST)
        if least > LONGEST:
            never.append(seen.get_joint_name(place))
        elif least > _DELAY:
            short.append(f"{1e3 * least:.2g} ms of joint {seen.get_joint_name(place)}")
    parts = [f"a delay below {', '.join(short)}"] if short else []
    any_delay = f"any delay up to {1e3 * LONGEST:.0f} ms of joint {', '.join(never)}"
    return [*parts, any_delay] if never else parts


def _is_hidden(seen: Evidence, data: NormalEquations) -> bool:
    """True if a fault, made of the torques of the machine, adds too little to what is left now."""
    for possible in (False, True):  # what shows without a machine that can be built shows with it
        made = np.hypot(seen.judge.compute_errors(data, possible), seen.errors)
        if _compute_evidence(seen.errors, made) >= SURELY * ENOUGH:
            return False
    return True


def _simulate_data(seen: Evidence, W: np.ndarray, beta: np.ndarray) -> NormalEquations:
    """Of columns W and the torques that a machine makes in the logs as they are."""
    return _build_normal_equations(W, seen.rows.W @ beta, seen.rows.used, seen.joints)
