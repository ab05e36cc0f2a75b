"""From a ranking to a judgement: what is big enough, sure enough, possible, and what ties."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import Brief
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import Columns
from modeler.diagnosis.ranking import VISIBLE, Ranking, pool_of, total_falls
from modeler.diagnosis.score import STANDARD_ERRORS, Residuals, Score, scored, standard_errors
from modeler.diagnosis.state import SearchData, State, picked_columns
from modeler.diagnosis.timing import confirmed
from modeler.effects import Acts

GATE = 0.03
"""Least share of the residual variance on held-out motion that is worth a name."""

FELT = 0.002
"""Least fall of the error, as a share of the rms torque of its joints: filters distort as much."""

NAMED_T_RATIO = 4.5
"""Least ratio of a fall to its standard error over blocks: random signs of the blocks reach it by
chance with one candidate in a hundred thousand."""

SAME = 0.3
"""Share of its fall that may be left for either with the other put in, if both explain the same."""

NEARLY = 0.95
"""Share of the best fall with which a simpler effect is preferred, if the data do not tell."""


PLAIN = ("coulomb", "viscous")
"""Friction that all other friction refines."""

EVERY = (*PLAIN, "offset", "rotor_inertia")
"""Laws that every joint with a motor has."""


@dataclass(frozen=True, eq=False)
class Judged(Brief):
    """One effect on one joint at its best shapes.

    Attributes:
        candidate: effect, joint, shapes.
        gain: expected fall of the residual variance of its joints on other motion.
        share: the same of all joints.
        drop: (blocks,) fall there of the squared residual, weighted.
        values: of its parameters, SI.
        deviations: their standard deviations for residuals of the size that the state has, SI.
        sure: fall over its standard error.
        felt: rms of what it explains over the rms torque of its joints.
        visible: share that the model does not hide.
        possible: False for a sign or a size that physics forbids.
        confirmed: False if only errors of timing speak for it.
        why: physics forbids it on this robot, if it does.
    """

    candidate: Candidate
    gain: float
    share: float
    drop: np.ndarray
    values: np.ndarray
    deviations: np.ndarray
    sure: float
    felt: float
    visible: float
    possible: bool
    confirmed: bool = True
    why: str = ""

    @property
    def key(self) -> tuple[str, str | None]:
        """Effect and joint."""
        return self.candidate.key

    @property
    def fall(self) -> float:
        """Of the squared residual on held-out motion, weighted."""
        return float(self.drop.sum())

    @property
    def alone(self) -> bool:
        """True if only its own joint feels it.

        A drive gain is a matter of all joints that share parameters, and so is what explains more
        than there is to explain on its joint.
        """
        candidate = self.candidate
        return candidate.local and "torque" not in candidate.form.names and self.gain < 1.0

    @property
    def mends(self) -> bool:
        """True if its sign says that it mends the form of a law in the model."""
        return self.candidate.effect.mends(float(self.values[0]))

    @property
    def unlikely(self) -> bool:
        """True if it is possible, but rare, or its sign is."""
        effect = self.candidate.effect
        return effect.rare or (effect.rarely_negative and float(self.values[0]) < 0.0)

    @property
    def significant(self) -> bool:
        """True if it is worth a name."""
        big = self.gain > GATE and self.sure > NAMED_T_RATIO and self.felt > FELT
        return big and self.possible and self.confirmed and self.visible > VISIBLE


@dataclass(frozen=True, eq=False)
class Judgement(Brief):
    """All effects in one state, best first; `best` is None if none is worth a name."""

    ranked: tuple[Judged, ...]
    best: Judged | None


@dataclass(frozen=True, eq=False)
class Trial(Brief):
    """A candidate, and what chooses among the shapes of its effect.

    Attributes:
        candidate: effect, joint, shapes.
        possible: False for a sign or a size that physics forbids.
        fall: of the squared residual on held-out motion, weighted.
    """

    candidate: Candidate
    possible: bool
    fall: float


def tried(state: State, pairs: Sequence[tuple[Candidate, Columns]]) -> list[Trial]:
    """All candidates, each with its columns."""
    pool = pool_of(state.folded, [columns for _, columns in pairs])
    return [
        Trial(candidate, possible(candidate, value), float(fall))
        for (candidate, _), fall, value in zip(pairs, *total_falls(state.folded, pool), strict=True)
    ]


def leading(trials: Sequence[Trial]) -> list[Trial]:
    """The best shapes of every effect on every joint."""
    best: dict[tuple[str, str | None], Trial] = {}
    for trial in trials:
        other = best.setdefault(trial.candidate.key, trial)
        if (trial.possible, trial.fall) > (other.possible, other.fall):
            best[trial.candidate.key] = trial
    return list(best.values())


def judged_at(state: State, pairs: Sequence[tuple[Candidate, Columns]]) -> list[Judged]:
    """Some of the candidates judged, each with its columns; best first."""
    if not pairs:
        return []
    ranking = state.ranked([columns for _, columns in pairs])
    judged = [_judged(state, candidate, ranking, i) for i, (candidate, _) in enumerate(pairs)]
    return sorted(judged, key=lambda j: -j.fall)


def _judged(state: State, candidate: Candidate, ranking: Ranking, i: int) -> Judged:
    drop, concerned = ranking.drop[:, i], candidate.concerns(len(ranking.before))
    fall, at_stake = float(drop.sum()), float(ranking.before[concerned].sum())
    torque = sum(float(np.sum((state.rows.y[j] / state.sigma[j]) ** 2)) for j in concerned)
    return Judged(
        candidate=candidate,
        gain=min(1.0, fall / max(at_stake, 1e-300)),
        share=fall / max(float(ranking.before.sum()), 1e-300),
        drop=drop,
        values=ranking.value[i],
        deviations=ranking.deviation[i],
        sure=float(ranking.sure[i]),
        felt=float(np.sqrt(max(0.0, fall) / (torque + 1e-300))),
        visible=float(ranking.visible[i]),
        possible=possible(candidate, ranking.value[i]),
    )


def possible(candidate: Candidate, values: np.ndarray) -> bool:
    """False for a sign or a size of the candidate's parameters that physics forbids.

    With l the length of a spring on a lever, Gamma = k (l - l0) dl/dq for a helical one and F dl/dq
    for one of constant force: in sin(q - q0) / l the first has the coefficient -k l0 b, the second
    F b. The rest of the first, k b sin(q - q0), is mostly that of the link's first moment: the sign
    tells them apart, unless the second pushes. What a tilt is depends on the robot (`plausible`).
    """
    if candidate.effect.acts is Acts.GRAVITY:
        return True
    turned = candidate.effect.sign * float(values[-1]) < 0.0
    return not turned and not any(
        (column.nonnegative and value < 0.0) or abs(value) > column.largest
        for value, column in zip(map(float, values), candidate.form.columns, strict=False)
    )


def decide(state: State, judged: list[Judged]) -> Judgement:
    """The first that passes, or a simpler one that the data do not tell from it.

    Timing-like ones are confirmed only when they lead.
    """
    for place, item in enumerate(judged):
        if not item.significant:
            continue
        stem = _stem(item, judged)
        if stem is not None:
            return Judgement(tuple(judged), stem)
        if item.candidate.effect.timing and not confirmed(state, item.candidate, item.values):
            judged[place] = dataclasses.replace(item, confirmed=False)
            continue
        return Judgement(tuple(judged), _simplest(state, item, judged))
    return Judgement(tuple(judged), None)


STEM = 0.5
"""Share of what finer friction explains with which the plain one that is absent goes before it."""


def refines(finer: Candidate, plain: Candidate) -> bool:
    """True for what says more of a joint than a law that every joint has.

    It is friction too, or has more free numbers: where it explains no more, it is no rival.
    """
    laws = plain.effect.id in EVERY and finer.effect.id not in EVERY
    own = finer.joint == plain.joint and finer.effect.acts in (Acts.JOINT, Acts.MOTOR)
    friction = finer.effect.family == plain.effect.family == "friction"
    return laws and own and (friction or numbers(finer) > numbers(plain))


def _stem(best: Judged, judged: Sequence[Judged]) -> Judged | None:
    """Dry or viscous friction of a joint that has none, before friction that refines it."""
    if best.candidate.effect.family != "friction":
        return None
    return next((
        j for j in judged
        if j.candidate.effect.id in PLAIN and refines(best.candidate, j.candidate)
        and j.significant and j.share > STEM * best.share
    ), None)  # fmt: skip


def _simplest(state: State, best: Judged, judged: Sequence[Judged]) -> Judged:
    """Of those tied with the best and nearly as good, that with the fewest free numbers.

    What only mends a law in the model comes last, before it what is rare, or has a rare sign.

    A timing-like effect may stand for another timing-like one only.
    """
    timing = best.candidate.effect.timing
    near = [
        other for other in tied(best, judged)
        if other.significant and (timing or not other.candidate.effect.timing)
        and other.fall > NEARLY * best.fall
    ]  # fmt: skip

    def place(j: Judged) -> tuple[bool, bool, float, float]:
        return j.mends, j.unlikely, numbers(j.candidate), -j.fall

    order = sorted([best, *near], key=place)
    return next(
        j
        for j in order
        if j is best or not j.candidate.effect.timing or confirmed(state, j.candidate, j.values)
    )


def numbers(candidate: Candidate) -> float:
    """Free numbers: parameters, and shapes that are refined."""
    shapes = candidate.form.shapes
    free = sum(s.smooth or candidate.shapes[s.name] not in s.grid for s in shapes)
    ratios = len(candidate.shapes) - len(shapes)
    return len(candidate.form.columns) + free + 0.5 * ratios


def alternatives(best: Judged, others: Sequence[Judged], after: Judgement) -> list[Judged]:
    """Tied ones that explain the same: with the best put in, little is left for them.

    What only refines a law that every joint has is none.


    Args:
        best: that was put in.
        others: its rivals then.
        after: the judgement with it.
    """
    left = {j.key: j.fall for j in after.ranked}
    return [
        o for o in tied(best, others)
        if left.get(o.key, 0.0) < SAME * o.fall and not refines(o.candidate, best.candidate)
    ]  # fmt: skip


def tied(best: Judged, others: Sequence[Judged]) -> list[Judged]:
    """Those that explain as much as the best: paired differences over blocks decide."""
    found = []
    for other in others:
        if other is best or not other.possible or other.gain < GATE:
            continue
        same = other.candidate.effect.id in best.candidate.effect.same_as
        if same or standard_errors(best.drop - other.drop) <= STANDARD_ERRORS:
            found.append(other)
    return found


# Errors of a state on motion it was not fitted to, and whether an effect lowers them.


def holdout_residuals(state: State, other: SearchData | None) -> Residuals:
    """What a state leaves of held-out logs; without any, of its own, each fold from the others.

    Args:
        state: fitted.
        other: held-out logs, in the same band.
    """
    if other is not None:
        return left_of(state, other)
    left = (s * e for s, e in zip(state.sigma, state.base.left_out, strict=True))
    return _of(state.data, tuple(left))


def on_logs(state: State, data: SearchData) -> State:
    """A state fitted to other logs, linearised about the same reference."""
    rows = data.about(state.reference)
    return State(data, state.picks, state.reference, rows, picked_columns(rows, state.picks))


def left_of(state: State, data: SearchData) -> Residuals:
    """What a state leaves of logs, with its parameters as they are."""
    there = on_logs(state, data)
    rows = there.rows
    found = [y - W @ state.beta for y, W in zip(rows.y, rows.W, strict=True)]
    for columns, values in zip(there.extra, state.values, strict=True):
        for j, own in enumerate(columns):
            if own is not None:
                found[j] = found[j] - own @ values
    return _of(data, tuple(found))


def _of(data: SearchData, left: tuple[np.ndarray, ...]) -> Residuals:
    names, rows = tuple(joint.name for joint in data.spec.joints), data.rows
    return Residuals(names, left, rows.y, rows.time, rows.run)


def compared(
    before: Residuals, after: Residuals, concerned: Sequence[int], state: State, block: float = 0.0
) -> Score:
    """The score of an effect on the joints that it concerns, in blocks of some s.

    The torque of each counts in units of what the state leaves of it, so that N m and N are never
    added.
    """
    weights = {}
    for j in concerned:
        y = state.rows.y[j] / state.sigma[j]
        weights[before.names[j]] = float(np.mean(y**2)) if y.size else 0.0
    return scored(before, after, weights, block)


KEPT = 0.2
"""Share of the expected gain that must come true on held-out motion, which may excite it less."""

TOUCHED = 0.1
"""Least fall of a joint's squared residual, as a share of the largest, that counts as touched."""


def touched_joints(judged: Judged, before: State, after: State) -> list[int]:
    """Joints whose residuals an effect explains: its own, or all where they fall most."""
    if judged.alone:
        return [judged.candidate.index]
    sizes = zip(before.residual, after.residual, before.sigma, strict=True)
    fall = np.array([float(np.sum((b / s) ** 2) - np.sum((a / s) ** 2)) for b, a, s in sizes])
    if fall.max() <= 0.0:
        return [int(np.argmax(fall))]
    return [int(j) for j in np.flatnonzero(fall >= TOUCHED * fall.max())]


def vetoing(other: SearchData | None) -> Callable[[State, State, Judged], bool]:
    """A veto by unseen motion: True if a state with an effect more is not the better one there.

    The error of the joints that it touches must surely fall (`scored`), and on held-out logs by a
    good part of what the effect lets expect.

    Args:
        other: held-out logs.
    """

    def veto(before: State, after: State, judged: Judged) -> bool:
        touched = touched_joints(judged, before, after)
        score = compared(
            holdout_residuals(before, other), holdout_residuals(after, other), touched, before
        )
        expected = judged.gain
        if not judged.alone:  # what is gone of the squared residuals of these joints
            first, last = (
                sum(float(np.sum((s.residual[j] / before.sigma[j]) ** 2)) for j in touched)
                for s in (before, after)
            )
            expected = 1.0 - last / max(first, 1e-300)
        least = 0.0 if other is None else KEPT * expected
        return not score.better or score.whole.gain < least

    return veto
