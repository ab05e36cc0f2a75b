"""From a search to a diagnosis: errors on other motion, ties, closure, verdict, blind spots."""

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from modeler.core.brief import Brief
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.cross_checks import CrossCheck, ParameterChange
from modeler.diagnosis.data_checks import SHORT, doubts, length, one_speed
from modeler.diagnosis.detected import detected
from modeler.diagnosis.drive_gains import gain_deviations, gain_visible, is_gain
from modeler.diagnosis.events import Window
from modeler.diagnosis.generate import generate_candidates, ruled_out
from modeler.diagnosis.judge import compared, holdout_residuals, on_logs, touched_joints
from modeler.diagnosis.orders import systematic_share
from modeler.diagnosis.plausible import objection
from modeler.diagnosis.profile import named_intervals, profile_of, shape_units, values_of
from modeler.diagnosis.ranking import VISIBLE
from modeler.diagnosis.result import (
    Diagnosis,
    Finding,
    JointState,
    Key,
    Pick,
    doubt,
    explained_fraction,
    mean_square,
)
from modeler.diagnosis.score import Change, Residuals, Score, errors_of
from modeler.diagnosis.search import Search, Step, Tick, extended
from modeler.diagnosis.sentences import NOT_JUDGED, evidence, sentences
from modeler.diagnosis.state import SearchData, State, cutoff, state_of
from modeler.diagnosis.timing import instrumental
from modeler.effects import Acts, effect_named
from modeler.estimation import IdentifiedModel
from modeler.observation import Doubt
from modeler.runtime import mapped

LOST = 1.0
"""Held-out error from which on a model says nothing about that motion, nor what it lacks."""


@dataclass(frozen=True, eq=False)
class BandSearch(Brief):
    """A search in one band, and what is made of it.

    Attributes:
        found: of the training logs.
        other: held-out ones in that band.
        seen: what the states of the search leave of these.
        share: systematic share of what the last leaves on a joint.
        findings: its effects.
    """

    found: Search
    other: SearchData | None
    seen: Sequence[Residuals]
    share: Callable[[int], float]
    findings: Sequence[Finding]

    @property
    def named(self) -> tuple[Step, ...]:
        """The steps whose effects are named."""
        named = {(f.effect, f.joint) for f in self.findings if not f.doubt}
        return tuple(step for step in self.found.steps if step.pick.key in named)


def band_search(
    found: Search, other: SearchData | None, looks: Sequence[tuple[CrossCheck, ...]], tick: Tick
) -> BandSearch:
    """The findings of a search.

    Args:
        found: of the training logs.
        other: held-out ones in the same band.
        looks: what other looks say of every effect, in order.
        tick: called whenever something is done.
    """
    picks, beta = [*found.start.picks, *(step.pick for step in found.steps)], found.end.beta
    ends = range(len(found.start.picks) + 1, len(picks))
    middle = (state_of(found.start.data, picks[:k], beta) for k in ends)
    chain = [found.start, *middle, *([found.end] if found.steps else [])]
    seen = [holdout_residuals(state, other) for state in chain]
    looks_at = [(found.end, [state.residual for state in chain])]
    if other is not None:
        looks_at.append((on_logs(found.end, other), [left.residual for left in seen]))
    shares = [_systematic(state, left[-1], tick) for state, left in looks_at]  # what is asked for
    squares = [[[*map(mean_square, own)] for own in left] for _, left in looks_at]
    findings = list[Finding]()
    for k, step in enumerate(found.steps):
        touched = touched_joints(step.judged, *chain[k : k + 2])
        score = compared(seen[k], seen[k + 1], touched, found.end)
        if score.better and score.whole.after <= LOST:
            closed = min(
                explained_fraction(own[k:], touched, share, chain[k].sigma)
                for own, share in zip(squares, shares, strict=True)
            )
            names = [found.end.names[j] for j in touched]
            left = [change.after for change in score.joints if change.joint in names]
            findings.append(_finding(found, k, touched, score.whole, closed, looks[k], left))
        tick()
    return BandSearch(found, other, seen, shares[0], findings)


def _systematic(state: State, left: Sequence[np.ndarray], tick: Tick) -> Callable[[int], float]:
    """Systematic share of what is left on a joint of some logs; it takes long."""

    @cache
    def share(j: int) -> float:
        tick()
        return systematic_share(state, j, left[j])

    return share


def assembled(
    model: IdentifiedModel, bands: Sequence[BandSearch], window: Window | None,
    faults: Sequence[Doubt] = (), moved: Sequence[ParameterChange] = (),
) -> Diagnosis:  # fmt: skip
    """The diagnosis.

    Args:
        model: as given.
        bands: the search in the band of the diagnosis; then, if there is one, that in a wider band.
        window: of a contact that was masked.
        faults: channels that contradict the model; if one is certain, nothing is named.
        moved: parameters in which the machine of the held-out logs differs; then nothing is judged.
    """
    first, last = bands[0], bands[-1]
    found, other = first.found, first.other
    contradicted = any(fault.certain for fault in faults)

    def falls(candidate: Candidate) -> Score:
        after = holdout_residuals(extended(last.found.end, candidate), last.other)
        return compared(last.seen[-1], after, [candidate.index], last.found.end)

    every: list[Finding] = []
    end, seen = found.end, first.seen[-1]
    if not contradicted:
        every = _once([finding for band in bands for finding in band.findings])
        every, end, seen = _in_band_of_table(every, bands)
        every = detected(last.found, window, errors_of(last.seen[-1]), falls, every)
    joints = _joints(found, end, (first.seen[0], seen), first.share)
    every = [_doubted(finding, joints) for finding in every]
    if moved:
        every = [dataclasses.replace(finding, doubt=NOT_JUDGED) for finding in every]
    every.sort(key=lambda finding: finding.status == "perhaps")
    effects, refinements = (tuple(f for f in every if f.refines is r) for r in (False, True))
    diagnosis = Diagnosis(
        robot=model.spec.robot,
        verdict="cannot tell" if contradicted or moved else verdict(effects, joints, found),
        effects=effects,
        refinements=refinements,
        rivals=tuple((*rival.key, rival.gain) for rival in found.ranked[:8]),
        blind_spots=undetectable_effects(found),
        joints=joints,
        unmoved=tuple(j.name for j in model.spec.joints if j.name not in joints),
        held_out=other.observation.logs if other else (),
        sentences=(),
        fit_band=model.processing.parallel_cutoff or 0.0,
        data=doubts(model, found, other, faults, window),
        contradicted=contradicted, machine_changed=tuple(moved), window=window, search=found,
    )  # fmt: skip
    return sentences(diagnosis)


def _once(findings: Sequence[Finding]) -> list[Finding]:
    """What two bands say of an effect: as it is named, if it is, or as it was seen first."""
    found: dict[tuple[object, ...], Finding] = {}
    for k, finding in enumerate(findings):
        several = finding.pick is not None and finding.pick.candidate.effect.several
        key = (finding.effect, finding.joint, k if several else 0)
        if key not in found or (found[key].doubt and not finding.doubt):
            found[key] = finding
    return list(found.values())


def _in_band_of_table(
    every: Sequence[Finding], bands: Sequence[BandSearch]
) -> tuple[list[Finding], State, Residuals]:
    """Findings of the wider band with the errors that they have in the band of the table.

    And the state with all that is named, and what it leaves of unseen motion.
    """
    first, found = bands[0], list(every)
    state, seen = first.found.end, first.seen[-1]
    for i, finding in enumerate(every):
        if finding.doubt or finding.pick is None or finding in first.findings:
            continue
        pick, wider = finding.pick.candidate, bands[-1].found
        (step,) = (step for step in wider.steps if step.pick is pick)
        later = extended(state, pick)
        left = holdout_residuals(later, first.other)
        score = compared(seen, left, touched_joints(step.judged, state, later), later)
        ends, why = (score.whole.before, score.whole.after), ""
        if score.better:
            state, seen = later, left
        else:
            why = f"the error falls only up to {cutoff(wider.start.data):.2g} Hz"
        text = evidence(step, *ends)
        found[i] = dataclasses.replace(
            finding, error_before=ends[0], error_after=ends[1], doubt=why, evidence=text
        )
    return found, state, seen


def _doubted(finding: Finding, joints: Mapping[str, JointState]) -> Finding:
    """An event, where something acts all the time: what stood out of it may be none."""
    if not finding.event or finding.objection or not any(j.unexplained for j in joints.values()):
        return finding
    return dataclasses.replace(finding, objection="something unexplained acts all the time")


def _finding(
    found: Search, k: int, touched: Sequence[int], change: Change, closed: float,
    looks: tuple[CrossCheck, ...], after: Sequence[float],
) -> Finding:  # fmt: skip
    """What the k-th step put in."""
    step, end, first = found.steps[k], found.end, k == 0 and not found.given
    k += len(found.given)
    judged, pick, before = step.judged, step.pick, step.before
    left = [end.residual[j] / before.sigma[j] for j in touched]
    values = end.values[k]
    deviations = judged.deviations * float(np.sqrt(np.mean(np.concatenate(left) ** 2)))
    if pick.delays:  # least squares make delays too small
        values, deviations = instrumental(before, pick)
    visible = judged.visible
    if is_gain(pick):
        deviations, visible = gain_deviations(end, k), gain_visible(end, k)
    along = profile_of(end, k)
    if along is not None:
        deviations = along.deviations()
    named = values_of(end, pick, values, deviations)
    parameters = named.value | dict(pick.shapes)
    rivals = [tie.candidate for tie in step.ties]
    ties = [*(rival.key for rival in rivals), *_same(pick, found)]
    refines = _refines(found, k)
    against = objection(end, pick, parameters)
    sigmas = named.deviation | ({} if along is None else along.shape_deviations())
    errors = (change.before, change.after)
    return Finding(
        effect=pick.effect.id,
        joint=pick.joint,
        error_before=change.before,
        error_after=change.after,
        parameters=parameters,
        sigmas=sigmas,
        intervals={} if along is None else named_intervals(along, named),
        units=named.unit | shape_units(end, pick),
        ties=tuple(dict.fromkeys(ties)),
        evidence=evidence(step, change.before, change.after),
        closure=closed,
        refines=refines,
        objection=against,
        looks=looks,
        doubt=doubt(pick, errors, against, sigmas, closed, looks, rivals, refines, after),
        first=first,
        pick=Pick(pick, values, end, visible),
    )


def _same(pick: Candidate, found: Search) -> list[Key]:
    """Effects that no data tell from it."""
    same = [(other, pick.joint) for other in pick.effect.same_as]
    return [key for key in same if not ruled_out(*key, found.without)]


def _refines(found: Search, k: int) -> bool:
    """True if it mends a law in the model, or an effect of its family named before on its joint.

    Those are smaller than what they mend. What moves the links is felt next to its joint too.
    """
    steps = (*found.given, *found.steps)[: k + 1]
    mends = [
        step.pick.effect.mends(float(values[0]))
        for step, values in zip(steps, found.end.values, strict=False)
    ]
    step = steps[k]
    for i, earlier in enumerate(steps[:k]):
        first, later = earlier.pick, step.pick
        if mends[i]:
            continue
        alike = first.joint == later.joint and first.effect.family == later.effect.family
        moves = first.effect is later.effect and first.effect.acts is Acts.POSITION
        beside = moves and abs(first.index - later.index) <= 1
        if (alike or beside) and step.judged.felt < earlier.judged.felt:
            return True
    return mends[k]


def _joints(
    found: Search, end: State, seen: Sequence[Residuals], systematic: Callable[[int], float]
) -> dict[str, JointState]:
    states, ends = {}, [errors_of(seen[k]) for k in (0, -1)]
    shown = [j for j, y in enumerate(found.start.rows.y) if y.size]
    # what all joints share is made by the first
    shares = dict(zip(shown, [*map(systematic, shown[:1]), *mapped(systematic, shown[1:])],
                      strict=True))  # fmt: skip
    for j, joint in enumerate(found.spec.joints):
        if j not in shares:
            continue
        size = mean_square(found.start.rows.y[j])
        before, after = (mean_square(s.residual[j]) for s in (found.start, end))
        share = after / size if size > 0.0 else math.nan
        states[joint.name] = JointState(
            error_before=ends[0].get(joint.name, math.nan),
            error_after=ends[1].get(joint.name, math.nan),
            unit=joint.effort_unit,
            rms_before=math.sqrt(before),
            rms_after=math.sqrt(after),
            explained=1.0 - share,
            systematic=share * shares[j],
            noise=share * (1.0 - shares[j]),
        )
    return states


def verdict(effects: Sequence[Finding], joints: dict[str, JointState], found: Search) -> str:
    """One of the five answers.

    Args:
        effects: that are named, best first.
        joints: by name.
        found: of the training logs.
    """
    if effects:
        return "missing" if effects[0].stated else "closest description"
    if length(found.start) < SHORT or not any(y.size > 100 for y in found.start.y):
        return "cannot tell"
    if any(state.error_after > LOST for state in joints.values()):
        return "cannot tell"
    if any(state.unexplained for state in joints.values()):
        return "unexplained"
    return "nothing significant"


def undetectable_effects(found: Search) -> tuple[Key, ...]:
    """Effects that these data cannot show: hidden by the model, or on joints that do not move."""
    has = {(p.effect, p.joint) for p in found.spec.standard}
    judged = [j for j in found.ranked if j.key not in has]
    seen = {j.key for j in judged}
    hidden: list[Key] = [
        (effect.id, joint.name)
        for joint in found.spec.joints if joint.actuated
        for effect in found.catalogue if effect.whole_axis and (effect.id, joint.name) not in seen
    ]  # fmt: skip
    if found.start.data.kept is None:
        hidden += [(effect.id, None) for effect in found.catalogue if effect.last_link]
    hidden += _unmoved(found.start)
    shown = [key for key in hidden if not ruled_out(*key, found.without)]
    named = {pick.key for step in found.steps for pick in (step.judged, *step.ties)}
    every = [*(j.key for j in judged if j.visible < 2.0 * VISIBLE), *shown]
    kept = [key for key in dict.fromkeys(every) if key not in named]
    assert all(effect_named(name, found.catalogue) is not None for name, _ in kept)
    return tuple(kept)


def _unmoved(state: State) -> list[Key]:
    """All that could be on joints of which no row can be used, or that have one speed only.

    At one speed, functions of the speed are one column: only the moments of reversal differ.
    """
    own = (Acts.JOINT, Acts.MOTOR, Acts.POSITION)
    steady = [one_speed(state, j) is not None for j in range(state.rows.joints)]
    if not any(steady) and all(y.size for y in state.rows.y):
        return []
    return [
        candidate.key for candidate in generate_candidates(state)
        if candidate.effect.acts in own
        and (
            not state.rows.y[candidate.index].size
            or (steady[candidate.index] and candidate.form.names == {"v"})
        )
    ]  # fmt: skip
