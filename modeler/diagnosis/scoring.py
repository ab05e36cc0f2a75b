"""From a ranking to a choice: errors on other motion, what is significant, what is equivalent."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeler.core.json import ShortRepr
from modeler.core.table import format_error_pair
from modeler.diagnosis.candidates import Candidate, Columns
from modeler.diagnosis.generation import is_confirmed
from modeler.diagnosis.ranking import Ranking, build_batch, compute_total_reductions
from modeler.diagnosis.state import SearchData, State, collect_pick_columns
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import EffectTarget

_Weights = Mapping[str, float] | None
_Pairs = Sequence[tuple[Candidate, Columns]]


@dataclass(frozen=True, eq=False)
class Residuals:
    """Rows of every joint that count; J joints.

    Attributes:
        names: of the joints.
        residual: (rows_j,) by joint, measured minus predicted torque, N m or N.
        torque: (rows_j,) by joint, measured.
        time: (rows_j,) by joint, s.
        run: (rows_j,) by joint, index of the log.
    """

    names: tuple[str, ...]
    residual: tuple[np.ndarray, ...]
    torque: tuple[np.ndarray, ...]
    time: tuple[np.ndarray, ...]
    run: tuple[np.ndarray, ...]


@dataclass(frozen=True)
class ErrorChange:
    """One joint before and after, or some of them together.

    Attributes:
        joint: name.
        before, after: relative error on unseen motion; NaN where none is known.
        t_ratio: fall of the error in blocks of time over the standard error of that.
    """

    joint: str
    before: float
    after: float
    t_ratio: float

    @property
    def is_different(self) -> bool:
        """Returns whether the two printed numbers differ."""
        return len(set(format_error_pair(self.before, self.after))) > 1

    @property
    def is_reduced(self) -> bool:
        """Returns whether the error falls significantly."""
        lower = self.is_different and self.after < self.before
        return lower and self.t_ratio > THRESHOLDS.max_chance_t

    @property
    def is_increased(self) -> bool:
        """Returns whether it rises significantly."""
        higher = self.is_different and self.after > self.before
        return higher and self.t_ratio < -THRESHOLDS.max_chance_t

    @property
    def variance_reduction(self) -> float:
        """Returns the relative fall of the squared error."""
        return 1.0 - (self.after / self.before) ** 2 if self.before > 0.0 else 0.0

    @property
    def error_ratio(self) -> float:
        """Returns the ratio of the errors, after over before."""
        least = THRESHOLDS.negligible_error
        return max(self.after, least) / max(self.before, least)


@dataclass(frozen=True)
class Score:
    """The score of a change of a model.

    Attributes:
        joints: those with rows and torque.
        whole: the error that is printed for the change: root mean square over joints.
    """

    joints: tuple[ErrorChange, ...]
    whole: ErrorChange

    @property
    def is_better(self) -> bool:
        """Returns whether the printed error falls significantly, and no joint is spoilt.

        Or if that of a joint falls significantly by more than its noise, and none rises: what other
        effects leave of other joints may be more than all of it.
        """
        least = 1.0 / THRESHOLDS.min_spoiling_ratio
        is_reduced = any(c.is_reduced and c.error_ratio < least for c in self.joints)
        mends = is_reduced and not any(change.is_increased for change in self.joints)
        return mends or (self.whole.is_reduced and not self.has_spoilt_joint)

    @property
    def has_spoilt_joint(self) -> bool:
        """Returns whether the error of a joint rises by more than its noise."""
        most = THRESHOLDS.min_spoiling_ratio
        return any(c.is_increased and c.error_ratio > most for c in self.joints)

    @property
    def errors(self) -> dict[str, tuple[float, float]]:
        """Returns errors before and after, by joint."""
        return {change.joint: (change.before, change.after) for change in self.joints}

    @property
    def changed_joints(self) -> tuple[str, ...]:
        """Returns the joints whose error falls or rises."""
        return tuple(c.joint for c in self.joints if c.is_reduced or c.is_increased)


def score_change(
    before: Residuals, after: Residuals, weights: _Weights = None, block: float = 0.0
) -> Score:
    """Scores a change.

    With S_jb and T_jb the sums of the squared residuals of joint j over block b of time, before and
    after, and Y_j those of its torque over all B blocks, the squared relative errors of the joint
    are sum_b S_jb / Y_j and sum_b T_jb / Y_j;
    the errors of a block sqrt(S_jb / Y_j) and sqrt(T_jb / Y_j), and d_b is their difference (of
    the squares, a few blocks of fast motion would be all that counts): blocks are paired, and
    residuals are coloured within them but not beyond, so the standard error of sum_b d_b is
    `sqrt(B / (B - 1) sum_b (d_b - mean)^2)`. The whole is the weighted mean of the squares over
    joints, in every block as in all. A joint that neither model predicts judges none.

    Args:
        before: residuals of the model without the change.
        after: with it, on the same logs.
        weights: of the joints, by name; None: the same of all.
        block: s; 0: half a second, longer where logs are long.
    """
    by_block = _build_block_function(before, block)
    old, new = compute_errors(before), compute_errors(after)
    known = [(j, name) for j, name in enumerate(before.names) if name in old and name in new]
    most = THRESHOLDS.max_predictive_error
    predicted = [pair for pair in known if min(old[pair[1]], new[pair[1]]) <= most] or known
    shares = {name: (by_block(before, j), by_block(after, j)) for j, name in predicted}
    changes = tuple(
        ErrorChange(name, old[name], new[name], compute_t_ratio(np.sqrt(a) - np.sqrt(b)))
        for name, (a, b) in shares.items()
    )
    share = {name: 1.0 if weights is None else weights.get(name, 0.0) for name in shares}
    total = sum(share.values())
    if not total > 0.0:
        return Score(changes, ErrorChange("", math.nan, math.nan, 0.0))
    squares = (sum(share[name] * of[name] ** 2 for name in shares) for of in (old, new))
    first, last = (math.sqrt(square / total) for square in squares)
    weighted = [[share[name] * x for x in pair] for name, pair in shares.items()]
    a, b = (np.sqrt(np.sum([pair[k] for pair in weighted], axis=0)) for k in (0, 1))
    return Score(changes, ErrorChange("", first, last, compute_t_ratio(a - b)))


def compute_t_ratio(differences: np.ndarray) -> float:
    """Computes the sum of differences (blocks,) over its standard error; 0 below two blocks."""
    count = len(differences)
    spread = float(np.std(differences)) * count / math.sqrt(max(1, count - 1))
    total = float(np.sum(differences))
    return total / max(spread, 1e-9 * abs(total), 1e-300) if count > 1 else 0.0


def compute_rms_error(errors: Iterable[float]) -> float:
    """Computes the root mean square of relative errors over joints."""
    values = list(errors)
    return float(np.sqrt(np.mean(np.square(values)))) if values else 0.0


def compute_errors(residuals: Residuals) -> dict[str, float]:
    """Computes the relative error of every joint that has a torque."""
    parts = residuals.residual, residuals.torque
    lefts, torques = ([float(np.linalg.norm(x)) for x in part] for part in parts)
    rows = zip(residuals.names, lefts, torques, strict=True)
    return {name: left / torque for name, left, torque in rows if torque > 0.0}


def format_error_changes(joints: Mapping[str, tuple[float, float]], changed: Sequence[str]) -> str:
    """Formats the errors that change: "joint 7 11.4 % -> 7.1 %; joint 2 rises, 3 % -> 3.2 %".

    Args:
        joints: error before and after, by joint.
        changed: joints whose error falls or rises.
    """
    pairs = {name: " -> ".join(format_error_pair(*joints[name])) for name in changed}
    rising = [name for name in changed if joints[name][1] > joints[name][0]]
    falling = [f"joint {name} {text}" for name, text in pairs.items() if name not in rising]
    parts = [", ".join(falling)]
    parts += [f"joint {name} rises, {pairs[name]}" for name in rising]
    if len(changed) < len(joints):
        parts.append("other joints unchanged" if changed else "no joint changes")
    return "; ".join(part for part in parts if part)


def explain_no_improvement(
    joints: Mapping[str, tuple[float, float]], changed: Sequence[str]
) -> str:
    """Explains why a change is no improvement."""
    changes, errors = format_error_changes(joints, changed), zip(*joints.values(), strict=True)
    ratios = (ErrorChange(name, *joints[name], 0.0).error_ratio for name in changed)
    if any(ratio > THRESHOLDS.min_spoiling_ratio for ratio in ratios):
        return f"the error rises: {changes}"
    total = " -> ".join(format_error_pair(*map(compute_rms_error, errors)))
    return f"the error does not fall by more than chance: {total} over all joints; {changes}"


def _build_block_function(logs: Residuals, block: float) -> Callable[[Residuals, int], np.ndarray]:
    """The function that gives the squared residuals of a joint, over its squared torque, by block.

    Blocks of that many s, of 0 half a second, longer where logs are long; the same for all models
    that see the same logs.
    """
    run, time = np.concatenate(logs.run), np.concatenate(logs.time)
    spans = {int(r): (time[run == r].min(), time[run == r].max()) for r in np.unique(run)}
    total = sum(b - a for a, b in spans.values())
    length = float(block or max(THRESHOLDS.block_duration, total / THRESHOLDS.max_blocks))

    def key_rows(run: np.ndarray, time: np.ndarray) -> np.ndarray:
        """A number for each row, of its log and its block there; equal in a block, and rising."""
        start = np.array([spans[int(r)][0] for r in run])
        return np.asarray(run.astype(np.int64) * 2**32 + ((time - start) / length).astype(np.int64))

    blocks = np.unique(key_rows(run, time))  # those with rows: a log may pause for days

    def compute_shares(residuals: Residuals, j: int) -> np.ndarray:
        number = np.searchsorted(blocks, key_rows(residuals.run[j], residuals.time[j]))
        size = float(residuals.torque[j] @ residuals.torque[j])
        return np.bincount(number, residuals.residual[j] ** 2, len(blocks)) / size

    return compute_shares


PLAIN = ("coulomb", "viscous")
"""Friction that all other friction refines."""

EVERY = (*PLAIN, "offset", "rotor_inertia")
"""Laws that every joint with a motor has."""


@dataclass(frozen=True, eq=False)
class ScoredCandidate(ShortRepr):
    """One effect on one joint at its best shapes.

    Attributes:
        candidate: effect, joint, shapes.
        variance_reduction: expected fall of the residual variance of its joints on other motion.
        total_share: the same of all joints.
        reductions: (blocks,) fall there of the squared residual, weighted.
        values: of its parameters, SI.
        deviations: their standard deviations for residuals of the size that the state has, SI.
        t_ratio: fall over its standard error.
        torque_share: rms of what it explains over the rms torque of its joints.
        visible_share: share that the model does not hide.
        is_possible: False for a sign or a size that physics forbids.
        is_confirmed: False if only errors of timing speak for it.
        reason: physics forbids it on this robot, if it does.
    """

    candidate: Candidate
    variance_reduction: float
    total_share: float
    reductions: np.ndarray
    values: np.ndarray
    deviations: np.ndarray
    t_ratio: float
    torque_share: float
    visible_share: float
    is_possible: bool
    is_confirmed: bool = True
    reason: str = ""

    @property
    def key(self) -> tuple[str, str | None]:
        """Returns effect and joint."""
        return self.candidate.key

    @property
    def total_reduction(self) -> float:
        """Returns the fall of the weighted squared residual on held-out motion."""
        return float(self.reductions.sum())

    @property
    def is_local(self) -> bool:
        """Returns whether it acts on its own joint only.

        A drive gain is a matter of all joints that share parameters, and so is what explains more
        than there is to explain on its joint.
        """
        candidate = self.candidate
        alone = candidate.is_local and "torque" not in candidate.form.names
        return alone and self.variance_reduction < 1.0

    @property
    def refines_model_term(self) -> bool:
        """Returns whether its sign shows that it corrects the form of a term of the model."""
        return self.candidate.effect.refines_model_term(float(self.values[0]))

    @property
    def is_unlikely(self) -> bool:
        """Returns whether it, or its sign, is possible but rare."""
        effect = self.candidate.effect
        return effect.is_rare or (effect.is_rarely_negative and float(self.values[0]) < 0.0)

    def is_near(self, best: "ScoredCandidate") -> bool:
        """Returns whether it explains nearly as much as the best: both are then refined."""
        return self.total_share > THRESHOLDS.refinement_share * best.total_share

    @property
    def is_significant(self) -> bool:
        """Returns whether it is significant.

        Filters distort as an effect of a small share of the torque does, but not as a fitted windup
        with a certain stiffness.
        """
        big = self.variance_reduction > THRESHOLDS.min_variance_reduction
        large = self.torque_share > THRESHOLDS.min_torque_share
        big = big and (large or self.candidate.elastic is not None)
        shown = self.visible_share > THRESHOLDS.min_visible_share
        certain = self.t_ratio > THRESHOLDS.min_t_ratio and self.is_confirmed
        return big and shown and certain and self.is_possible


@dataclass(frozen=True, eq=False)
class RankedCandidates(ShortRepr):
    """All effects in one state, best first; `best` is None if none is worth a name."""

    ranked: tuple[ScoredCandidate, ...]
    best: ScoredCandidate | None


@dataclass(frozen=True, eq=False)
class CandidateFit(ShortRepr):
    """A candidate, and what chooses among the shapes of its effect.

    Attributes:
        candidate: effect, joint, shapes.
        is_possible: False for a sign or a size that physics forbids.
        total_reduction: of the squared residual on held-out motion, weighted.
    """

    candidate: Candidate
    is_possible: bool
    total_reduction: float


def fit_candidates(state: State, pairs: _Pairs) -> list[CandidateFit]:
    """Fits all candidates, each with its columns."""
    pool = build_batch(state.fold_grams, [columns for _, columns in pairs])
    falls, values = compute_total_reductions(state.fold_grams, pool)
    rows = zip((candidate for candidate, _ in pairs), values, map(float, falls), strict=True)
    return [CandidateFit(c, is_possible(c, value), fall) for c, value, fall in rows]


def select_best_fits(trials: Sequence[CandidateFit]) -> list[CandidateFit]:
    """Selects the best fit of every effect on every joint."""
    best: dict[tuple[str, str | None], CandidateFit] = {}
    for trial in trials:
        other = best.setdefault(trial.candidate.key, trial)
        if (trial.is_possible, trial.total_reduction) > (other.is_possible, other.total_reduction):
            best[trial.candidate.key] = trial
    return list(best.values())


def score_candidates(state: State, pairs: _Pairs) -> list[ScoredCandidate]:
    """Scores candidates, each with its columns; best first."""
    if not pairs:
        return []
    ranking = state.rank_columns([columns for _, columns in pairs])
    scores = (_build_score(state, c, ranking, i) for i, (c, _) in enumerate(pairs))
    return sorted(scores, key=lambda score: -score.total_reduction)


def _build_score(state: State, candidate: Candidate, ranking: Ranking, i: int) -> ScoredCandidate:
    drop = ranking.reductions[:, i]
    concerned = candidate.list_affected_joints(len(ranking.before))
    fall, at_stake = float(drop.sum()), float(ranking.before[concerned].sum())
    torque = sum(float(np.sum((state.rows.y[j] / state.sigma[j]) ** 2)) for j in concerned)
    values, possible = ranking.value[i], is_possible(candidate, ranking.value[i])
    share = fall / max(float(ranking.before.sum()), 1e-300)
    gains = min(1.0, fall / max(at_stake, 1e-300)), share, drop, values, ranking.deviation[i]
    torque_share = float(np.sqrt(max(0.0, fall) / (torque + 1e-300)))
    sizes = float(ranking.t_ratios[i]), torque_share, float(ranking.visible_shares[i])
    return ScoredCandidate(candidate, *gains, *sizes, possible)


def is_possible(candidate: Candidate, values: np.ndarray) -> bool:
    """Returns whether physics allows the signs and sizes of the candidate's parameters.

    With l the length of a spring on a lever, Gamma = k (l - l0) dl/dq for a helical one and F dl/dq
    for one of constant force: in sin(q - q0) / l the first has the coefficient -k l0 b, the second
    F b. The rest of the first, k b sin(q - q0), is mostly that of the link's first moment: the sign
    distinguishes them, unless the second pushes. What a tilt is depends on the robot (`plausible`).
    """
    if candidate.effect.acts is EffectTarget.GRAVITY:
        return True
    if candidate.elastic is not None and not candidate.elastic.is_plausible:
        return False
    turned = candidate.effect.sign * float(values[-1]) < 0.0
    return not turned and not any(
        (column.nonnegative and value < 0.0) or abs(value) > column.largest
        for value, column in zip(map(float, values), candidate.form.columns, strict=False)
    )


def select_best(state: State, scores: list[ScoredCandidate]) -> RankedCandidates:
    """Selects the first significant candidate, or an equivalent simpler one.

    Timing-like ones are confirmed only when they lead.
    """
    for place, item in enumerate(scores):
        if not item.is_significant:
            continue
        stem = _find_plain_friction(item, scores)
        if stem is not None:
            return RankedCandidates(tuple(scores), stem)
        if item.candidate.effect.is_timing_sensitive and not is_confirmed(
            state, item.candidate, item.values
        ):
            scores[place] = replace(item, is_confirmed=False)
            continue
        simplest = _select_simplest(state, item, scores)
        return RankedCandidates(tuple(scores), simplest)
    return RankedCandidates(tuple(scores), None)


def is_refinement(finer: Candidate, plain: Candidate) -> bool:
    """Returns whether it refines a law that every joint has.

    It is friction too, or has more free numbers: where it explains no more, it is no alternative.
    """
    laws = plain.effect.id in EVERY and finer.effect.id not in EVERY
    on_joint = finer.effect.acts in (EffectTarget.JOINT, EffectTarget.MOTOR)
    friction = finer.effect.family == plain.effect.family == "friction"
    more = friction or count_free_numbers(finer) > count_free_numbers(plain)
    return laws and on_joint and finer.joint == plain.joint and more


def _find_plain_friction(
    best: ScoredCandidate, scores: Sequence[ScoredCandidate]
) -> ScoredCandidate | None:
    """Dry or viscous friction of a joint that has none, before friction that refines it."""
    if best.candidate.effect.family != "friction":
        return None
    least = THRESHOLDS.plain_friction_share * best.total_share
    plain = (j for j in scores if j.candidate.effect.id in PLAIN and j.is_significant)
    plain = (j for j in plain if is_refinement(best.candidate, j.candidate))
    return next((j for j in plain if j.total_share > least), None)


def _select_simplest(
    state: State, best: ScoredCandidate, scores: Sequence[ScoredCandidate]
) -> ScoredCandidate:
    """Of those tied with the best and nearly as good, that with the fewest free numbers.

    What only mends a law in the model comes last, before it what is rare, or has a rare sign.

    A timing-like effect may stand for another timing-like one only.
    """
    timing = best.candidate.effect.is_timing_sensitive
    least = THRESHOLDS.parsimony_share * best.total_reduction

    near = [
        j
        for j in find_equivalents(best, scores)
        if j.total_reduction > least
        and j.is_significant
        and (timing or not j.candidate.effect.is_timing_sensitive)
    ]

    def compute_sort_key(j: ScoredCandidate) -> tuple[bool, bool, float, float]:
        numbers = count_free_numbers(j.candidate)
        return j.refines_model_term, j.is_unlikely, numbers, -j.total_reduction

    def confirms(j: ScoredCandidate) -> bool:
        return is_confirmed(state, j.candidate, j.values)

    order = sorted([best, *near], key=compute_sort_key)
    likely = (
        j for j in order if j is best or not j.candidate.effect.is_timing_sensitive or confirms(j)
    )
    return next(likely)


def count_free_numbers(candidate: Candidate) -> float:
    """Counts free numbers: parameters, and nonlinear parameters that are refined."""
    shapes = candidate.form.nonlinear_parameters
    values = candidate.nonlinear_parameters
    free = sum(s.is_continuous or values[s.name] not in s.grid for s in shapes)
    ratios = len(candidate.nonlinear_parameters) - len(shapes)
    return len(candidate.form.columns) + free + 0.5 * ratios


def select_alternatives(
    best: ScoredCandidate, others: Sequence[ScoredCandidate], after: RankedCandidates
) -> list[ScoredCandidate]:
    """Selects equivalents that explain the same: little is left for them beside the best.

    What only refines a law that every joint has is none.


    Args:
        best: that was put in.
        others: its alternatives then.
        after: the judgement with it.
    """
    left = {j.key: j.total_reduction for j in after.ranked}
    share, equals = THRESHOLDS.equivalence_share, find_equivalents(best, others)
    equals = [o for o in equals if left.get(o.key, 0.0) < share * o.total_reduction]
    return [o for o in equals if not is_refinement(o.candidate, best.candidate)]


def find_equivalents(
    best: ScoredCandidate, others: Sequence[ScoredCandidate]
) -> list[ScoredCandidate]:
    """Finds candidates that explain as much as the best, by paired differences over blocks."""

    def is_equivalent(other: ScoredCandidate) -> bool:
        same = other.candidate.effect.id in best.candidate.effect.equivalent_effects
        most, apart = THRESHOLDS.max_chance_t, best.reductions - other.reductions
        return same or compute_t_ratio(apart) <= most

    least = THRESHOLDS.min_variance_reduction
    large = [o for o in others if o.is_possible and o.variance_reduction >= least]
    return [other for other in large if other is not best and is_equivalent(other)]


# Errors of a state on motion it was not fitted to, and whether an effect lowers them.


def compute_holdout_residuals(state: State, other: SearchData | None) -> Residuals:
    """Computes residuals on held-out logs; without any, cross-validated ones.

    Args:
        state: fitted.
        other: held-out logs, in the same band.
    """
    if other is not None:
        return compute_residuals(state, other)
    left = (s * e for s, e in zip(state.sigma, state.gram_blocks.out_of_fold, strict=True))
    return _build_residuals(state.data, tuple(left))


def fit_on_logs(state: State, data: SearchData) -> State:
    """Fits a state to other logs, linearised about the same reference."""
    rows = data.linearise_rows(state.reference)
    return State(data, state.picks, state.reference, rows, collect_pick_columns(rows, state.picks))


def compute_residuals(state: State, data: SearchData) -> Residuals:
    """Computes the residuals of a state on logs, with its parameters as they are."""
    there = fit_on_logs(state, data)
    rows = there.rows
    residuals = [y - W @ state.beta for y, W in zip(rows.y, rows.W, strict=True)]
    for columns, values in zip(there.extra, state.values, strict=True):
        for j, joint_columns in enumerate(columns):
            if joint_columns is not None:
                residuals[j] = residuals[j] - joint_columns @ values
    return _build_residuals(data, tuple(residuals))


def _build_residuals(data: SearchData, left: tuple[np.ndarray, ...]) -> Residuals:
    names, rows = tuple(joint.name for joint in data.spec.joints), data.rows
    return Residuals(names, left, rows.y, rows.time, rows.run)


def compare_residuals(
    before: Residuals, after: Residuals, concerned: Sequence[int], state: State, block: float = 0.0
) -> Score:
    """Scores an effect on the joints that it concerns, in blocks of some s.

    The torque of each counts in units of what the state leaves of it, so that N m and N are never
    added.
    """
    weights = {}
    for j in concerned:
        y = state.rows.y[j] / state.sigma[j]
        weights[before.names[j]] = float(np.mean(y**2)) if y.size else 0.0
    return score_change(before, after, weights, block)


def find_affected_joints(score: ScoredCandidate, before: State, after: State) -> list[int]:
    """Finds the joints that an effect explains: its own, or all where residuals fall most."""
    if score.is_local:
        return [score.candidate.index]
    sizes = zip(before.residual, after.residual, before.sigma, strict=True)
    fall = np.array([float(np.sum((b / s) ** 2) - np.sum((a / s) ** 2)) for b, a, s in sizes])
    if fall.max() <= 0.0:
        return [int(np.argmax(fall))]
    return [int(j) for j in np.flatnonzero(fall >= THRESHOLDS.min_affected_share * fall.max())]


def make_veto(other: SearchData | None) -> Callable[[State, State, ScoredCandidate], bool]:
    """Makes a veto by unseen motion: True if a state with one more effect is not better.

    The error of the joints that it touches must fall significantly (`score_change`), and on
    held-out logs by a good part of what the effect lets expect.

    Args:
        other: held-out logs.
    """

    def is_vetoed(before: State, after: State, item: ScoredCandidate) -> bool:
        touched = find_affected_joints(item, before, after)
        old, new = (compute_holdout_residuals(state, other) for state in (before, after))
        score, expected = compare_residuals(old, new, touched, before), item.variance_reduction
        if not item.is_local:  # what is gone of the squared residuals of these joints
            parts = ([s.residual[j] / before.sigma[j] for j in touched] for s in (before, after))
            first, last = (sum(float(np.sum(x**2)) for x in part) for part in parts)
            expected = 1.0 - last / max(first, 1e-300)
        least = 0.0 if other is None else THRESHOLDS.min_confirmed_share * expected
        return not score.is_better or score.whole.variance_reduction < least

    return is_vetoed
