"""Faults of logs: one rule decides what is wrong with channels, before any physics is blamed.

A fault is a hypothesis: undo it, and what a machine leaves of the torques of joint j,

    e_j = ||tau_j - W_j beta|| / ||tau_j||,

falls. beta is that of the physically consistent parameters nearest to a fit in which every joint
weighs 1 / e_j^2, so that sum_j log e_j is least, or that of a model whose torques are compared. A
fault is reported if it lowers that sum enough, and does so as well as any other. A fault with a
value that is fitted explains physics that the model lacks, too: it must explain more, and a delay
must lower the error in all blocks of time but one, predicted from the others. What would stay
unseen can be computed: the size at which a fault raises a joint's error by a third, beside a refit.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations
from typing import NamedTuple

import numpy as np

from modeler.estimation.evidence import (
    Evidence,
    Hypothesis,
    NormalEquations,
    compute_lengths,
    compute_log_error,
    gather_evidence,
)
from modeler.estimation.gravity import (
    ABSENT,
    MotionTransform,
    extract_gravity,
    propose_clocks,
    propose_transforms,
    propose_zero,
    propose_zeros,
)
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import solve_normal_equations
from modeler.regression import DataWarning, Observation
from modeler.runtime import CompiledModel, map_parts

_MILLI = 1e-3  # N m in mN m


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
        seen = gather_evidence(compiled, observation, model.beta)
        while seen.joints and seen.errors.max() > THRESHOLDS.wrong_channel_error:
            explanation = _select_hypothesis(seen)
            if explanation is None:
                break
            faults.append(explanation.fault)
            touched = explanation.joints or seen.joints
            seen = replace(seen, joints=tuple(j for j in seen.joints if j not in touched))
    if not faults:
        seen = gather_evidence(compiled, observation)
        explanation = _select_hypothesis(seen) if seen.joints else None
        if explanation is not None:
            faults = [explanation.fault]
        elif seen.joints and model is None:
            faults = _find_undetectable(seen)
    return (*faults, *(DataWarning(line) for line in observation.report.collect_warnings()))


def _select_hypothesis(seen: Evidence) -> Hypothesis | None:
    """Returns the hypothesis that explains most, with those that do as well in its words."""
    tried = [*_propose_torque_faults(seen), *_propose_gravity_faults(seen)]
    tried += _propose_motion_faults(seen)
    scores = map_parts(partial(_compute_reduction, seen), tried)
    pairs = sorted(zip(scores, tried, strict=True), key=lambda pair: -pair[0])
    tie, least = np.log(THRESHOLDS.equivalent_fault_ratio), 0.0
    if seen.judge.beta is None:
        least = tie + _compute_inertia_reduction(seen)
    every = [pair for pair in pairs if pair[0] >= least or not pair[1].fault.is_certain]
    candidates = [pair for pair in every if pair[0] >= pair[1].min_evidence]
    if any(one.fault.line.startswith(ABSENT) for _, one in candidates):
        candidates = [pair for pair in candidates if pair[1].fault.code != "clock"]
    if not candidates:
        return None
    likely = [one for score, one in candidates if score >= candidates[0][0] - tie]
    line = "; or: ".join(dict.fromkeys(one.fault.line for one in likely[:3]))
    certain = all(one.fault.is_certain for one in likely)
    touched = tuple({j for one in likely for j in one.joints})
    names = tuple(seen.observation.joints[j].name for j in sorted(touched))
    fault = replace(likely[0].fault, line=line, is_certain=certain, joints=names)
    return Hypothesis(fault, likely[0].data, touched)


def _compute_inertia_reduction(seen: Evidence) -> float:
    """Returns the fall of the sum of logarithms by inertias of motors that a model lacks."""
    inertia = seen.rows.motion[2][:, :, None] * np.eye(len(seen.observation.joints))
    columns = np.concatenate([seen.rows.W, seen.rows.filter_values(inertia.__getitem__)], axis=2)
    errors = seen.judge.compute_errors(seen.build_equations(columns), possible=False)
    return compute_log_error(seen.free_errors) - compute_log_error(errors)


def _compute_reduction(seen: Evidence, one: Hypothesis) -> float:
    """Returns the fall of the sum of logarithms by a hypothesis; -inf if it is none.

    It must be more where consistent parameters alone are better by it, and not the fit itself.
    """
    judge, before = one.judge or seen.judge, compute_log_error(seen.errors)
    errors, least = judge.compute_errors(one.data, possible=False), one.min_evidence
    reached = compute_log_error(errors)
    if compute_log_error(seen.free_errors) - reached < least:
        least = THRESHOLDS.min_evidence
    if before - reached >= least:  # consistent parameters leave more, and take longer
        errors = judge.compute_errors(one.data)
        reached = compute_log_error(errors)
    explains = before - reached >= least and errors.max() <= THRESHOLDS.wrong_channel_error
    if one.fault.code == "clock" and len(errors) > 1:  # one joint alone shows its own physics
        sizes = [np.maximum(each, THRESHOLDS.min_error) for each in (seen.errors, errors)]
        falls = np.log(sizes[0] / sizes[1])
        explains &= float(np.sum(falls) - np.max(falls)) >= THRESHOLDS.min_shared_evidence
    return before - reached if explains else -np.inf


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
        solved = solve_normal_equations(whole, np.append(weights @ data.cross + side, 0.0))
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
            scores[subset] = compute_log_error(seen.judge.compute_errors(data, possible=False))
        else:
            scores[subset] = scores[rest]
    least = compute_log_error(seen.errors) - THRESHOLDS.min_evidence
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
        return compute_log_error(judge.compute_errors(combine_axes(g), possible=False))

    def improve(g: np.ndarray) -> np.ndarray:
        beta, _ = judge.solve(combine_axes(g))
        axes = np.kron(np.eye(count + 1)[:, 1:], beta[:, None])  # torques of single axes
        mixed = np.hstack([np.kron(np.append(1.0, g)[:, None], np.eye(p)), axes])
        gram = np.matmul(mixed.T, every.gram @ mixed)
        return judge.solve(NormalEquations(gram, every.cross @ mixed))[0][p:]

    for g in gravity.propose_candidates(compute_score, improve, seen.has_large_errors):
        fault = DataWarning(gravity.format_line(g), True, code="gravity")
        yield Hypothesis(fault, combine_axes(g), judge=judge)


def _propose_motion_faults(seen: Evidence) -> Iterator[Hypothesis]:
    """Yields positions in other units, reversed, exchanged, from another zero; what comes late.

    All of them where much is left; else zeros and the clock.
    """
    large, observation = seen.has_large_errors, seen.observation
    likely = [*propose_clocks(observation, nearest_only=not large)]
    likely += propose_zeros(observation) if seen.is_tree else []
    others = [*propose_transforms(observation)] if seen.is_tree and large else []
    least = [THRESHOLDS.min_evidence_without_value] * len(likely)
    least += [THRESHOLDS.min_evidence] * len(others)
    tried = [*likely, *others]
    equations = map_parts(partial(_transform_rows, seen), tried)
    for transform, data, evidence in zip(tried, equations, least, strict=True):
        if data is not None:
            code = "positions" if transform.speed == 1.0 else "clock"
            fault = DataWarning(transform.line, True, code=code)
            yield Hypothesis(fault, data, min_evidence=evidence, speed=transform.speed)
    if seen.judge.beta is None:
        yield from _propose_delays(seen)


def _transform_rows(seen: Evidence, transform: MotionTransform) -> NormalEquations | None:
    """Returns the equations of other positions; None where too few rows count."""
    used = seen.rows.used & seen.rows.used[:, transform.torque]
    if used[:, list(seen.joints)].sum(axis=0).min() < THRESHOLDS.min_exchanged_rows:
        return None
    W, tau = seen.rows.transform_columns(seen.compiled, transform), seen.rows.tau
    return seen.build_equations(W, tau[:, transform.torque], used)


_STARTS = (-0.04, -0.012, 0.012, 0.04, -0.1, 0.1)  # s; the last where torques are missed by far
_DECAY = tuple(zip(*np.polynomial.laguerre.laggauss(5), strict=True))
"""Of 1/(tau s + 1) = int exp(-u) exp(-u tau s) du: delays over tau, and their weights."""


class _Kind(NamedTuple):
    """Describes a fault whose size is stated: what it is, its unit, the largest that is stated."""

    what: str
    unit: str
    largest: float


_DELAY = _Kind("torque delays", "ms", 1e3 * THRESHOLDS.max_delay)
_SCALE = _Kind("scale errors of the torque", "%", 100.0)
_ZERO = _Kind("zero errors", "degrees", 90.0)

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
        places: of the joints whose errors it lowers.
        is_torque: True if it may be filtered instead.
    """

    what: str
    other: str
    sign: float
    seen: Evidence
    shifts: np.ndarray
    places: list[int]
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
    first, *others = _collect_channels(seen)
    channels, search = [first, *others], partial(_find_best_shift, seen)
    # what all joints share is made by the first
    shifts = [search(first.shift_columns)]
    shifts += map_parts(search, [channel.shift_columns for channel in others])
    tried = []
    for channel, (shift, W) in zip(channels, shifts, strict=True):
        way, back = ("late", "early") if channel.sign * shift > 0.0 else ("early", "late")
        line = (
            f"{channel.what} {1e3 * abs(shift):.0f} ms {way}, by a fit at other times (or "
            f"{channel.other} {back}); check the clocks of the channels, and shift the column"
        )
        tried.append((channel, shift, W, DataWarning(line, code="delay")))
        if channel.is_torque and shift < -0.5 * step:
            tau, W = search(channel.filter_columns)
            line = (
                f"{channel.what} through a first-order low-pass filter with a time constant of "
                f"{-1e3 * tau:.0f} ms; log the unfiltered torque"
            )
            tried.append((channel, min(tau, 0.0), W, DataWarning(line, code="torque_filter")))
    for channel, shift, W, fault in tried:
        if abs(shift) > 0.5 * step and _is_delay(channel, shift, W):
            yield Hypothesis(fault, seen.build_equations(W), min_evidence=0.0)


def _is_delay(channel: _Channel, shift: float, W: np.ndarray) -> bool:
    """Returns True if a shift lowers the error, and by half of that in all blocks of time but one.

    More of a long one: physics that the model lacks may look like any.
    """
    every = (channel.seen.residual, channel.seen.predict_blocks(W))
    before, after = (x[:, channel.places].sum(axis=1) for x in every)  # squares
    limit = THRESHOLDS.max_delay_ratio / max(1.0, abs(shift) / THRESHOLDS.typical_delay)
    lower = after.sum() < limit**2 * before.sum() and np.sum(after >= limit * before) < 2
    return bool(lower) and abs(shift) < THRESHOLDS.max_delay


def _find_best_shift(seen: Evidence, columns: Columns) -> tuple[float, np.ndarray]:
    """Returns the shift of a channel that leaves least, s, and the columns with it.

    A fit with the torques of some shifts, less those without, as one column more says which of
    them helps: friction that turns makes of the slope at none a poor guide. Then Gauss and Newton.
    """
    judge, longest, step = seen.judge, THRESHOLDS.max_delay, THRESHOLDS.delay_difference

    def compute_score(data: NormalEquations) -> float:
        return compute_log_error(judge.compute_errors(data, possible=False))

    W, shift, least, data = seen.rows.W, 0.0, compute_score(seen.data), seen.data
    beta, _ = judge.solve(data)
    starts = _STARTS if seen.has_large_errors else _STARTS[:4]
    helped = [
        compute_score(_append_column(data, seen, W, columns(x, beta) - W @ beta)) for x in starts
    ]
    if min(helped) > least - THRESHOLDS.min_shift_hint:
        return shift, W
    further = starts[int(np.argmin(helped))]
    for _ in range(THRESHOLDS.delay_steps):
        other = seen.build_equations(closer := columns(further, None))
        reached = compute_score(other)
        if reached >= least:
            break
        shift, W, data, least = further, closer, other, reached
        beta, _ = judge.solve(data)
        near = 0.5 * step  # both sides alike: columns of other times have samples of their own
        slope = (columns(shift + near, beta) - columns(shift - near, beta)) / step
        coefficients, _ = judge.solve(_append_column(data, seen, W, slope))
        further = float(np.clip(shift + coefficients[-1], -longest, longest))
    return shift, W


def _append_column(
    data: NormalEquations, seen: Evidence, W: np.ndarray, column: np.ndarray
) -> NormalEquations:
    """Returns those of rows W (m, n, c), whose products are there, with a column (m, n) more."""
    joints, used = list(seen.joints), seen.rows.used
    y, z = seen.normalize(seen.rows.tau), seen.normalize(column)
    counted = (np.where(used[:, j, None], W[:, j], 0.0) for j in joints)
    beside = np.stack([side @ w for side, w in zip(z.T, counted, strict=True)])
    beside /= compute_lengths(np.where(used, seen.rows.tau, 0.0)[:, joints])[:, None]
    sides = np.column_stack([beside, np.sum(z**2, axis=0)])
    gram = np.concatenate([data.gram, beside[:, :, None]], axis=2)
    gram = np.concatenate([gram, sides[:, None]], axis=1)
    return NormalEquations(gram, np.column_stack([data.cross, np.sum(z * y, axis=0)]))


def _collect_channels(seen: Evidence) -> list[_Channel]:
    """Returns what may be late."""
    one, every = np.eye(len(seen.observation.joints)), np.ones((len(seen.observation.joints),) * 2)
    whole = [*range(len(seen.joints))]
    channels = [_Channel("all torques come", "the positions", -1.0, seen, every, whole, True)]
    if not seen.is_tree or len(seen.joints) == 1:
        return channels  # positions that are not of one time do not close the loops
    for place, j in enumerate(seen.joints):
        name, rest = f"joint {seen.get_joint_name(place)}:", "all the others"
        rows, motion = one[j][:, None] * every, one[j] * every
        channels += [
            _Channel(f"{name} its torque comes", rest, -1.0, seen, rows, [place], True),
            _Channel(f"{name} its position comes", rest, 1.0, seen, motion, [place]),
        ]
    return channels


def _find_undetectable(seen: Evidence) -> list[DataWarning]:
    """Returns the sizes below which faults would not show beside the residual, in words."""
    joints: dict[str, list[str]] = {}
    for (kind, place), size in sorted(_compute_undetectable_sizes(seen).items()):
        fits = seen.errors[place] <= THRESHOLDS.wrong_channel_error
        if fits and size >= THRESHOLDS.reported_size_share * kind.largest:
            below = f"below {_round_size(size):g} {kind.unit}"
            words = f"{kind.what} {below if size < kind.largest else 'of any size'}"
            joints.setdefault(words, []).append(seen.get_joint_name(place))
    parts = [f"{w} (joint{'s' * (len(j) > 1)} {', '.join(j)})" for w, j in joints.items()]
    line = f"Not detectable in these logs: {'; '.join(parts)}"
    return [DataWarning(line, is_undetectable=True, code="undetectable")] if parts else []


def _round_size(size: float) -> float:
    """Returns the nearest of 1, 2, 5, 10, 20 ... by ratio."""
    decade = 10.0 ** np.floor(np.log10(size))
    return float(decade * min((1.0, 2.0, 5.0, 10.0), key=lambda x: abs(np.log(x * decade / size))))


def _compute_undetectable_sizes(seen: Evidence) -> dict[tuple[_Kind, int], float]:
    """Returns the size of each fault that raises the error of a joint by a third, or the largest.

    With s what the torques change by a unit of it, near that size, and r_j = ||s_j - W_j gamma|| /
    ||tau_j|| what the fit leaves of that, the error e_j of any joint becomes hypot(e_j, size r_j).
    """
    beta, weights = seen.judge.solve(seen.data)
    least = (THRESHOLDS.detectable_error_ratio**2 - 1.0) ** 0.5
    least = least * np.maximum(seen.errors, THRESHOLDS.min_error)
    sizes = {}
    for place, j in enumerate(seen.joints):
        turns = seen.is_tree and seen.observation.joints[j].unit == "rad"
        for kind in (_DELAY, _SCALE, _ZERO) if turns else (_DELAY, _SCALE):
            size = 0.1 * kind.largest
            for _ in range(2):
                change = _change_torque(seen, beta, kind, j, size) / size
                both = _append_column(seen.data, seen, seen.rows.W, change)
                gram = np.tensordot(weights, both.gram, 1)
                refit = np.append(-solve_normal_equations(gram[:-1, :-1], gram[:-1, -1]), 1.0)
                left = np.sqrt(np.maximum(refit @ both.gram @ refit, 1e-18))
                size = min(float(np.min(least / left)), kind.largest)
            sizes[kind, place] = size
    return sizes


def _change_torque(
    seen: Evidence, beta: np.ndarray, kind: _Kind, j: int, size: float
) -> np.ndarray:
    """Returns (m, n) what a fault of joint j, of that size, changes of the torques of a machine."""
    rows, one = seen.rows, np.eye(len(seen.observation.joints))[j]
    torque = rows.W @ beta
    if kind is _ZERO:
        zero = propose_zero(seen.observation, j, size)
        return rows.transform_columns(seen.compiled, zero, beta) - torque
    if kind is _SCALE:
        return 0.01 * size * torque * one
    late = np.full(len(one), -1e-3 * size)
    return (rows.shift_columns(seen.compiled, late, beta) - torque) * one
