"""Faults of logs: one rule decides what is wrong with channels, before any physics is blamed.

A fault is a hypothesis: undo it, and what a machine leaves of the torques of joint j,

    e_j = ||tau_j - W_j beta|| / ||tau_j||,

falls. beta is that of the physically consistent parameters nearest to a fit in which every joint
weighs 1 / e_j^2, so that sum_j log e_j is least, or that of a model whose torques are compared. A
fault is reported if it lowers that sum by log 3 or more, halves the error of a joint, and does so
as well as any other. Whether it is detectable can be computed beforehand: made of the torques of
the machine itself, a fault that raises the sum by less is one that these logs cannot show.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import combinations

import numpy as np

from modeler.estimation import physical_consistency
from modeler.estimation.gravity import (
    ABSENT,
    MotionTransform,
    ThinnedRows,
    extract_gravity,
    propose_clocks,
    propose_transforms,
    propose_zero,
    thin_rows,
)
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.thresholds import THRESHOLDS
from modeler.regression import DataWarning, Observation
from modeler.runtime import CompiledModel, map_parts

_MILLI = 1e-3  # N m in mN m


@dataclass(frozen=True, eq=False)
class NormalEquations:
    """Holds all that a fit of the rows of k joints needs, torques of length one.

    Attributes:
        gram: (k, c, c) X_j^T X_j.
        cross: (k, c) X_j^T y_j.
    """

    gram: np.ndarray
    cross: np.ndarray

    def scale_torques(self, places: int | Sequence[int], gain: float) -> "NormalEquations":
        """Returns the equations with the torques of some joints of the log multiplied by a gain."""
        gains = np.where(np.isin(np.arange(len(self.gram)), places), gain, 1.0)
        return NormalEquations(self.gram / gains[:, None, None] ** 2, self.cross / gains[:, None])

    def compute_errors(self, beta: np.ndarray) -> np.ndarray:
        """Returns (k,) relative error of each joint."""
        square = 1.0 - 2.0 * self.cross @ beta + np.einsum("c,kcd,d->k", beta, self.gram, beta)
        return np.asarray(np.sqrt(np.maximum(square, 0.0)))


def _compute_lengths(y: np.ndarray) -> np.ndarray:
    """Returns (k,) norms of torques; none so small beside others that rows overflow."""
    length = np.linalg.norm(y, axis=0)
    return np.asarray(np.maximum(length, 1e-9 * length.max(initial=0.0) or 1.0))


def _build_normal_equations(
    W: np.ndarray, tau: np.ndarray, used: np.ndarray, joints: Sequence[int]
) -> NormalEquations:
    """Returns those of rows W (m, n, c), tau (m, n), used (m, n)."""
    y = np.where(used, tau, 0.0)[:, joints]
    length = _compute_lengths(y)
    X = (np.where(used[..., None], W, 0.0)[:, joints] / length[:, None]).transpose(1, 2, 0)
    return NormalEquations(X @ X.transpose(0, 2, 1), np.einsum("kcm,mk->kc", X, y / length))


@dataclass(frozen=True, eq=False)
class ResidualModel:
    """Describes what a machine leaves of torques.

    Attributes:
        machine: its parameters and their bounds.
        beta: (c,) of a model that predicts; None: each time it is fitted.
    """

    machine: physical_consistency.PhysicalParameters
    beta: np.ndarray | None = None

    def solve(self, data: NormalEquations) -> tuple[np.ndarray, np.ndarray]:
        """Returns beta (c,) and weights (k,) of least sum of the logarithms of the errors."""
        weights = np.ones(len(data.gram))
        if self.beta is not None:
            return self.beta, weights
        for _ in range(THRESHOLDS.fault_reweightings):
            gram, cross = np.tensordot(weights, data.gram, 1), weights @ data.cross
            beta = _solve_normal_equations(gram, cross)
            weights = 1.0 / np.maximum(data.compute_errors(beta), THRESHOLDS.min_error) ** 2
        return beta, weights

    def compute_errors(self, data: NormalEquations, possible: bool = True) -> np.ndarray:
        """Returns (k,) relative errors, of physically consistent parameters if requested."""
        beta, weights = self.solve(data)
        if possible and self.beta is None:
            beta = self.project_fit(data, beta, weights)
        return data.compute_errors(beta)

    def project_fit(
        self, data: NormalEquations, beta: np.ndarray, weights: np.ndarray
    ) -> np.ndarray:
        """Returns (c,) the nearest consistent parameters; the fit itself where none are found."""
        values, vectors = np.linalg.eigh(np.tensordot(weights, data.gram, 1))
        root = np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T
        nearest = physical_consistency.project_parameters(self.machine, beta, root)
        return beta if nearest is None else nearest.beta


def _solve_normal_equations(gram: np.ndarray, cross: np.ndarray) -> np.ndarray:
    """Returns the solution, to a few digits; a ridge for what the data cannot determine."""
    size = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    scaled = gram / np.outer(size, size) + THRESHOLDS.normal_equation_ridge * np.eye(len(gram))
    return np.asarray(np.linalg.solve(scaled, cross / size) / size)


def _compute_log_error(errors: np.ndarray) -> float:
    return float(np.sum(np.log(np.maximum(errors, THRESHOLDS.min_error))))


def _compute_evidence(without: np.ndarray, with_it: np.ndarray) -> float:
    """Returns what a fault adds to the sum of logarithms; 0 if it doubles the error of no joint."""
    least = THRESHOLDS.min_error
    halved = THRESHOLDS.max_repaired_error * np.maximum(with_it, least)
    doubles = np.maximum(without, least) <= halved
    return _compute_log_error(with_it) - _compute_log_error(without) if doubles.any() else 0.0


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Describes a fault that a log may have.

    Attributes:
        fault: in words.
        data: of the log with the fault undone.
        joints: that it concerns; empty: all.
        min_evidence: what it must add to the sum of logarithms.
        judge: of its columns, where they are not those of the robot.
    """

    fault: DataWarning
    data: NormalEquations
    joints: tuple[int, ...] = ()
    min_evidence: float = THRESHOLDS.min_evidence
    judge: ResidualModel | None = None


@dataclass(frozen=True, eq=False)
class Evidence:
    """Holds some rows of logs, and who judges them.

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
        """Returns the normal equations of the log as it is."""
        return self.build_equations(self.rows.W)

    @cached_property
    def errors(self) -> np.ndarray:
        """Returns the errors (k,) that the judge finds in the log as it is."""
        return self.judge.compute_errors(self.data)

    @cached_property
    def has_large_errors(self) -> bool:
        """Returns True if much is left, or consistent parameters leave far more than the fit."""
        free = self.judge.compute_errors(self.data, possible=False)
        suspicious = bool(self.errors.max() > THRESHOLDS.suspicious_error)
        return suspicious or _compute_evidence(free, self.errors) > THRESHOLDS.min_evidence

    @property
    def is_tree(self) -> bool:
        """Returns True without loops: positions that do not close loops have no torque."""
        return self.compiled.spec.closure is None

    def get_joint_name(self, place: int) -> str:
        """Returns the name of one of the joints."""
        return self.observation.joints[self.joints[place]].name

    def build_equations(
        self, W: np.ndarray, tau: np.ndarray | None = None, used: np.ndarray | None = None
    ) -> NormalEquations:
        """Builds the equations of W (m, n, c), with the measured torques or others (m, n)."""
        tau, used = self.rows.tau if tau is None else tau, self.rows.used if used is None else used
        return _build_normal_equations(W, tau, used, self.joints)


def _gather_evidence(
    compiled: CompiledModel, observation: Observation, beta: np.ndarray | None = None
) -> Evidence:
    rows = thin_rows(compiled, observation)
    joints = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    joints = [j for j in joints if rows.tau[rows.used[:, j], j].any()]
    least = THRESHOLDS.min_rows_each * rows.W.shape[2]
    if not joints or rows.used[:, joints].sum() < least:
        joints = []
    judge = ResidualModel(physical_consistency.define_physical_parameters(compiled.spec), beta)
    return Evidence(compiled, observation, judge, rows, tuple(joints))


def find_log_faults(
    compiled: CompiledModel, observation: Observation, model: IdentifiedModel | None = None
) -> tuple[DataWarning, ...]:
    """Returns what is wrong with the channels and the samples of logs; alike in every command.

    The one fault that explains most of what a fit to the logs leaves; if there is none, and no
    model either, which faults are not detectable. A model that was fitted to other logs comes
    first, for the joints whose torques it predicts with an error above one half.

    Args:
        compiled: the robot.
        observation: of the logs.
        model: whose torques are compared, or explained; None: the logs are fitted.
    """
    logs, faults = observation.report.logs, list[DataWarning]()
    if model and not any(used.has_rows_of(log) for used in model.logs for log in logs):
        seen = _gather_evidence(compiled, observation, model.beta)
        while seen.joints and seen.errors.max() > THRESHOLDS.wrong_channel_error:
            explanation = _select_hypothesis(seen)
            if explanation is None:
                break
            faults.append(explanation.fault)
            touched = explanation.joints or seen.joints
            seen = replace(seen, joints=tuple(j for j in seen.joints if j not in touched))
    if not faults:
        seen = _gather_evidence(compiled, observation)
        explanation = _select_hypothesis(seen) if seen.joints else None
        if explanation is not None:
            faults = [explanation.fault]
        elif seen.joints and model is None:
            faults = _find_undetectable(seen)
    return (*faults, *(DataWarning(line) for line in observation.report.collect_warnings()))


def _select_hypothesis(seen: Evidence) -> Hypothesis | None:
    """Returns the hypothesis that explains most, with those that do as well in its words."""
    gravities = [*_propose_gravity_faults(seen)]
    tried = [*_propose_torque_faults(seen), *gravities]
    tried += _propose_motion_faults(seen, bool(gravities))
    scores = map_parts(partial(_compute_reduction, seen), tried)
    pairs = zip(scores, tried, strict=True)
    candidates = [(score, one) for score, one in pairs if score >= one.min_evidence]
    if not candidates:
        return None
    if any(one.fault.line.startswith(ABSENT) for _, one in candidates):
        candidates = [c for c in candidates if "the clock seems" not in c[1].fault.line]
    candidates.sort(key=lambda pair: -pair[0])
    least = candidates[0][0] - np.log(THRESHOLDS.equivalent_fault_ratio)
    likely = [one for score, one in candidates if score >= least]
    line = "; or: ".join(dict.fromkeys(one.fault.line for one in likely[:3]))
    certain = all(one.fault.is_certain for one in likely)
    touched = tuple({j for one in likely for j in one.joints})
    names = tuple(seen.observation.joints[j].name for j in sorted(touched))
    fault = replace(likely[0].fault, line=line, is_certain=certain, joints=names)
    return Hypothesis(fault, likely[0].data, touched)


def _compute_reduction(seen: Evidence, one: Hypothesis) -> float:
    """Returns by how much a hypothesis lowers the sum of logarithms; 0 if it is none."""
    score = 0.0
    for possible in (False, True):  # consistent parameters leave more, and take longer
        errors = (one.judge or seen.judge).compute_errors(one.data, possible)
        score = _compute_evidence(errors, seen.errors)
        if score < one.min_evidence or errors.max() > THRESHOLDS.wrong_channel_error:
            return 0.0
    return score


def _propose_torque_faults(seen: Evidence) -> Iterator[Hypothesis]:
    """Yields torques of another scale or sign, and exchanged ones."""
    every, least = range(len(seen.joints)), THRESHOLDS.min_torque_factor
    for place in every if len(seen.joints) > 1 or seen.judge.beta is not None else ():
        estimated, limit = _estimate_gain(seen, place), THRESHOLDS.max_unit_factor
        for gain in (_MILLI,) if abs(estimated - _MILLI) < 0.1 * _MILLI else (estimated, _MILLI):
            if not 1.0 / limit < gain < limit or 1.0 / least < gain < least:
                continue
            unit = " (is it in mN m?)" if gain == _MILLI else ""
            line = (
                f"joint {seen.get_joint_name(place)}: the measured torque is {1.0 / gain:.3g} "
                f"times what it should be{unit}; check unit and drive gain of that channel"
            )
            j, factor = seen.joints[place], THRESHOLDS.unit_factor
            certain = not 1.0 / factor < gain < factor
            fault = DataWarning(line, certain, joint=j, code="torque_scale")
            yield Hypothesis(fault, seen.data.scale_torques(place, gain), (j,))
    yield from _propose_sign_faults(seen)
    for a, b in combinations(every, 2) if seen.has_large_errors else ():
        order, (j, k) = np.arange(len(seen.observation.joints)), (seen.joints[a], seen.joints[b])
        order[[j, k]] = order[[k, j]]
        both = seen.rows.used & seen.rows.used[:, order]
        if both[:, [j, k]].sum(axis=0).min() >= THRESHOLDS.min_exchanged_rows:
            line = (
                f"joints {seen.get_joint_name(a)} and {seen.get_joint_name(b)}: their torques look "
                "exchanged; check the order of the columns"
            )
            data = seen.build_equations(seen.rows.W, seen.rows.tau[:, order], both)
            yield Hypothesis(DataWarning(line, True, code="torque_exchange"), data, (j, k))


def _estimate_gain(seen: Evidence, place: int) -> float:
    """Returns what a joint's torque is to be multiplied by, from the torques of the others.

    X_j beta - gain y_j = 0 beside X_k beta = y_k: linear in beta and the gain.
    """
    data, weights, gain = seen.data, np.ones(len(seen.joints)), 0.0
    if seen.judge.beta is not None:
        return float(data.cross[place] @ seen.judge.beta)
    for _ in range(THRESHOLDS.fault_reweightings):
        weight, side = weights[place], -weights[place] * data.cross[place]
        gram = np.tensordot(weights, data.gram, 1)
        whole = np.block([[gram, side[:, None]], [side[None], np.array([[weight]])]])
        solved = _solve_normal_equations(whole, np.append(weights @ data.cross + side, 0.0))
        gain = float(solved[-1])
        if not 1.0 / THRESHOLDS.max_unit_factor < abs(gain) < THRESHOLDS.max_unit_factor:
            break
        errors = data.scale_torques(place, gain).compute_errors(solved[:-1])
        weights = 1.0 / np.maximum(errors, THRESHOLDS.min_error) ** 2
        weights[place] /= gain**2
    return gain


def _propose_sign_faults(seen: Evidence) -> Iterator[Hypothesis]:
    """Yields torques of the other sign: every subset of a few joints, all and single ones of many.

    A subset and the rest leave the same without a machine: friction and inertia decide.
    """
    count = len(seen.joints)
    sizes = range(1, count + 1) if count <= THRESHOLDS.max_sign_joints else (1, count)
    scores = dict[tuple[int, ...], float]()
    for subset in (s for size in sizes for s in combinations(range(count), size)):
        rest = tuple(k for k in range(count) if k not in subset)
        if seen.judge.beta is not None or rest not in scores:
            data = seen.data.scale_torques(subset, -1.0)
            scores[subset] = _compute_log_error(seen.judge.compute_errors(data, possible=False))
        else:
            scores[subset] = scores[rest]
    least = _compute_log_error(seen.errors) + np.log(THRESHOLDS.max_repaired_error)
    plausible = [subset for subset, score in scores.items() if score <= least]
    plausible.sort(key=lambda subset: (round(scores[subset], 1), len(subset)))
    for subset in plausible[: THRESHOLDS.max_sign_subsets]:
        names, s = ", ".join(map(seen.get_joint_name, subset)), "s" * (len(subset) > 1)
        whose = f"joint{s} {names}: the measured torque{s} ha{'ve' if s else 's'}"
        if len(subset) == count > 1:
            whose = "all measured torques have"
        line = f"{whose} the wrong sign for physically consistent parameters; check the sign"
        joints = tuple(seen.joints[k] for k in subset)
        data = seen.data.scale_torques(subset, -1.0)
        yield Hypothesis(DataWarning(line, True, code="torque_sign"), data, joints)


def _propose_gravity_faults(seen: Evidence) -> Iterator[Hypothesis]:
    """Yields gravity absent, compensated by the drives, of another size, sense or direction."""
    gravity = extract_gravity(seen.compiled, seen.rows, free=seen.judge.beta is None)
    if gravity is None:
        return
    judge, p = replace(seen.judge, machine=gravity.machine), gravity.motion.shape[2]
    every = seen.build_equations(np.concatenate([gravity.motion, *gravity.per_axis], axis=2))
    count = len(gravity.per_axis)

    def combine_axes(g: np.ndarray) -> NormalEquations:
        v, split = np.append(1.0, g), (len(every.gram), count + 1, -1)
        gram = every.gram.reshape(*split, count + 1, p)
        cross = np.einsum("kap,a->kp", every.cross.reshape(split), v)
        return NormalEquations(np.einsum("kapbq,a,b->kpq", gram, v, v, optimize=True), cross)

    def compute_score(g: np.ndarray) -> float:
        return _compute_log_error(judge.compute_errors(combine_axes(g), possible=False))

    def improve(g: np.ndarray) -> np.ndarray:
        beta, _ = judge.solve(combine_axes(g))
        axes = np.kron(np.eye(count + 1)[:, 1:], beta[:, None])  # torques of single axes
        mixed = np.hstack([np.kron(np.append(1.0, g)[:, None], np.eye(p)), axes])
        gram = np.matmul(mixed.T, every.gram @ mixed)
        return judge.solve(NormalEquations(gram, every.cross @ mixed))[0][p:]

    for g in gravity.propose_candidates(compute_score, improve, seen.has_large_errors):
        fault = DataWarning(gravity.format_line(g), True, code="gravity")
        yield Hypothesis(fault, combine_axes(g), judge=judge)


def _propose_motion_faults(seen: Evidence, clocked: bool) -> Iterator[Hypothesis]:
    """Yields positions in other units, reversed, exchanged, from another zero; what comes late.

    Other clocks where much is left, or where gravity looks like another.
    """
    large = seen.has_large_errors
    tried = [*propose_clocks(seen.observation)] if large or clocked else []
    tried += propose_transforms(seen.observation, zeros_only=not large) if seen.is_tree else []
    equations = map_parts(partial(_transform_rows, seen), tried)
    for transform, data in zip(tried, equations, strict=True):
        if data is not None:
            code = "positions" if transform.speed == 1.0 else "clock"
            yield Hypothesis(DataWarning(transform.line, True, code=code), data)
    if seen.judge.beta is None:
        yield from _propose_delays(seen)


def _transform_rows(seen: Evidence, transform: MotionTransform) -> NormalEquations | None:
    """Returns the equations of other positions; None where too few rows count."""
    used = seen.rows.used & seen.rows.used[:, transform.torque]
    if used[:, list(seen.joints)].sum(axis=0).min() < THRESHOLDS.min_exchanged_rows:
        return None
    W, tau = seen.rows.transform_columns(seen.compiled, transform), seen.rows.tau
    return seen.build_equations(W, tau[:, transform.torque], used)


_STARTS = (-0.1, -0.05, 0.05, 0.1)  # s; a step along the slope goes astray from farther away
_DECAY = tuple(zip(*np.polynomial.laguerre.laggauss(5), strict=True))
"""Of 1/(tau s + 1) = int exp(-u) exp(-u tau s) du: delays over tau, and their weights."""

Columns = Callable[[float, np.ndarray | None], np.ndarray]
"""(m, n, c) columns with a channel taken some seconds later; with beta (c,) torques (m, n)."""


@dataclass(frozen=True, eq=False)
class _Channel:
    """Describes what may be late.

    Attributes:
        what: it comes.
        other: what would then be early.
        sign: of its lateness, by the shift of the motion.
        seen: its rows.
        shifts: (n, n) how much the motion of all joints is shifted in the rows of each joint.
        is_torque: True if it may be filtered instead.
    """

    what: str
    other: str
    sign: float
    seen: Evidence
    shifts: np.ndarray
    is_torque: bool = False

    def shift_columns(self, seconds: float, beta: np.ndarray | None) -> np.ndarray:
        """Returns columns with the motion that many seconds later."""
        rows = self.seen.rows
        columns = (rows.W if beta is None else rows.W @ beta).copy()
        for vector in np.unique(self.shifts, axis=0):
            if vector.any():
                alike = (self.shifts == vector).all(axis=1)
                moved = rows.shift_columns(self.seen.compiled, seconds * vector, beta)
                columns[:, alike] = moved[:, alike]
        return columns

    def filter_columns(self, tau: float, beta: np.ndarray | None) -> np.ndarray:
        """Returns columns of a torque behind a first-order filter of that (negative) constant."""
        return np.asarray(sum(w * self.shift_columns(tau * u, beta) for u, w in _DECAY))


def _propose_delays(seen: Evidence) -> Iterator[Hypothesis]:
    """Yields channels of another time: all torques, and of one joint torque, position, or both.

    W(t + d) beta = tau(t) is fitted for a shift d of the motion of all joints, for the rows of a
    joint alone (its torque is late), and of the motion of a joint alone (its position is late), by
    Gauss and Newton.
    """
    step = float(np.median([part.segment.step for part in seen.observation.stretches]))
    channels = _collect_channels(seen)
    search = partial(_find_best_shift, seen)
    shifts = map_parts(search, [channel.shift_columns for channel in channels])
    for channel, (shift, data) in zip(channels, shifts, strict=True):
        way, back = ("late", "early") if channel.sign * shift > 0.0 else ("early", "late")
        line = (
            f"{channel.what} {1e3 * abs(shift):.0f} ms {way}, by a fit at other times (or "
            f"{channel.other} {back}); check the clocks of the channels, and shift the column"
        )
        if abs(shift) > 0.5 * step:
            late = DataWarning(line, code="delay")
            yield Hypothesis(late, data, min_evidence=_require_evidence(shift))
        if channel.is_torque and shift < -0.5 * step:
            tau, data = search(channel.filter_columns)
            line = (
                f"{channel.what} through a first-order low-pass filter with a time constant of "
                f"{-1e3 * tau:.0f} ms; log the unfiltered torque"
            )
            if tau < -0.5 * step:
                late = DataWarning(line, code="torque_filter")
                yield Hypothesis(late, data, min_evidence=_require_evidence(tau))


def _require_evidence(shift: float) -> float:
    """Returns what a delay must explain; more the rarer it is: physics looks like any delay."""
    seconds = abs(shift)
    rarity = max(seconds / THRESHOLDS.typical_delay, THRESHOLDS.min_delay / seconds, 1.0)
    return THRESHOLDS.min_evidence + float(np.log(rarity))


def _find_best_shift(seen: Evidence, columns: Columns) -> tuple[float, NormalEquations]:
    """Returns the shift of a channel that leaves least, s, and what it leaves that of.

    A channel whose shift, to first order, does not help is given up; where torques are missed by
    far, a long delay is searched too.
    """
    judge, longest, step = seen.judge, THRESHOLDS.max_delay, THRESHOLDS.delay_difference

    def compute_score(data: NormalEquations) -> float:
        return _compute_log_error(judge.compute_errors(data, possible=False))

    least, shift, W, data = compute_score(seen.data), 0.0, seen.rows.W, seen.data
    for start in _STARTS if seen.has_large_errors else ():
        other = seen.build_equations(moved := columns(start, None))
        if (score := compute_score(other)) < least:
            least, shift, W, data = score, start, moved, other
    for _ in range(THRESHOLDS.delay_steps):
        beta, _ = judge.solve(data)
        near = 0.5 * step  # both sides alike: columns of other times have samples of their own
        slope = (columns(shift + near, beta) - columns(shift - near, beta)) / step
        both = _append_column(data, seen, W, slope)
        coefficients, _ = judge.solve(both)
        promised = least - THRESHOLDS.min_shift_hint
        if shift == 0.0 and _compute_log_error(both.compute_errors(coefficients)) > promised:
            break
        further = float(np.clip(shift + coefficients[-1], -longest, longest))
        other = seen.build_equations(closer := columns(further, None))
        reached = compute_score(other)
        if reached >= least:
            break
        shift, W, data, least = further, closer, other, reached
    return shift, data


def _append_column(
    data: NormalEquations, seen: Evidence, W: np.ndarray, column: np.ndarray
) -> NormalEquations:
    """Returns those of rows W (m, n, c), whose products are there, with a column (m, n) more."""
    joints, used = list(seen.joints), seen.rows.used
    y, z = (np.where(used, x, 0.0)[:, joints] for x in (seen.rows.tau, column))
    length = _compute_lengths(y)
    counted = (np.where(used[:, j, None], W[:, j], 0.0) for j in joints)
    beside = np.stack([side @ w for side, w in zip(z.T, counted, strict=True)])
    beside /= length[:, None] ** 2
    squares = np.sum(z**2, axis=0) / length**2
    sides = np.concatenate([beside, squares[:, None]], axis=1)
    gram = np.concatenate([data.gram, beside[:, :, None]], axis=2)
    gram = np.concatenate([gram, sides[:, None]], axis=1)
    cross = np.column_stack([data.cross, np.sum(z * y, axis=0) / length**2])
    return NormalEquations(gram, cross)


def _collect_channels(seen: Evidence) -> list[_Channel]:
    """Returns what may be late."""
    one, every = np.eye(len(seen.observation.joints)), np.ones((len(seen.observation.joints),) * 2)
    channels = [_Channel("all torques come", "the positions", -1.0, seen, every, True)]
    if not seen.is_tree or len(seen.joints) == 1:
        return channels  # positions that are not of one time do not close the loops
    for place, j in enumerate(seen.joints):
        name, rest = f"joint {seen.get_joint_name(place)}:", "all the others"
        rows, motion = one[j][:, None] * every, one[j] * every
        channels += [
            _Channel(f"{name} its torque comes", rest, -1.0, seen, rows, True),
            _Channel(f"{name} its position comes", rest, 1.0, seen, motion),
            _Channel(f"{name} its position and torque come", rest, 1.0, seen, motion - rows),
        ]
    return channels


def _find_undetectable(seen: Evidence) -> list[DataWarning]:
    """Returns faults that torques of the machine itself would not show, beside their residual."""
    if seen.errors.max() > THRESHOLDS.wrong_channel_error:
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
    return [DataWarning(line, is_undetectable=True, code="undetectable")] if parts else []


def _simulate_faults(
    seen: Evidence, place: int, beta: np.ndarray
) -> Iterator[tuple[str, NormalEquations]]:
    """Yields logs of the machine with a fault of one joint."""
    W, j = seen.rows.W, seen.joints[place]
    data = seen.build_equations(W, W @ beta)
    yield "a wrong sign of the torque", data.scale_torques(place, -1.0)
    yield "a scale error of 2 on the torque", data.scale_torques(place, 0.5)
    if seen.is_tree and seen.observation.joints[j].unit == "rad":
        zero = propose_zero(seen.observation, j, 90)
        moved = seen.rows.transform_columns(seen.compiled, zero)
        yield "a zero off by 90 degrees", seen.build_equations(moved, W @ beta)


def _bound_delays(seen: Evidence, beta: np.ndarray) -> list[str]:
    """Returns how late a joint may be before its error rises by a third, beside a fit."""
    short, never = list[str](), list[str]()
    one, longest = np.eye(len(seen.observation.joints)), THRESHOLDS.max_delay
    rise = (THRESHOLDS.detectable_error_ratio**2 - 1.0) ** 0.5
    for place, j in enumerate(seen.joints):
        error = max(float(seen.errors[place]), THRESHOLDS.min_error)
        least = THRESHOLDS.typical_delay
        for _ in range(2):  # what a delay makes grows with it: hypot(made, error) = ratio error
            later = seen.rows.shift_columns(seen.compiled, least * one[j])
            data = seen.build_equations(later, seen.rows.W @ beta)
            made = seen.judge.compute_errors(data, possible=False)[place]
            least = min(least * error * rise / max(float(made), 1e-3 * error), 1.1 * longest)
        if least > longest:
            never.append(seen.get_joint_name(place))
        elif least > THRESHOLDS.min_delay:
            short.append(f"{1e3 * least:.2g} ms of joint {seen.get_joint_name(place)}")
    parts = [f"a delay below {', '.join(short)}"] if short else []
    any_delay = f"any delay up to {1e3 * longest:.0f} ms of joint {', '.join(never)}"
    return [*parts, any_delay] if never else parts


def _is_hidden(seen: Evidence, data: NormalEquations) -> bool:
    """Returns True if a fault, made of the torques of the machine, adds too little evidence."""
    least = THRESHOLDS.detectable_evidence_ratio * THRESHOLDS.min_evidence
    for possible in (False, True):  # what shows without consistent parameters shows with them
        made = np.hypot(seen.judge.compute_errors(data, possible), seen.errors)
        if _compute_evidence(seen.errors, made) >= least:
            return False
    return True
