"""From a search to a diagnosis: errors on other motion, ties, closure, verdict, blind spots."""

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.cross_checks import CrossCheck
from modeler.diagnosis.data_checks import SHORT, doubts, length, one_speed
from modeler.diagnosis.detected import detected
from modeler.diagnosis.drive_gains import gain_deviations, gain_visible, is_gain
from modeler.diagnosis.effect_values import named_intervals, profile_of, shape_units, values_of
from modeler.diagnosis.errors import compared, touched_joints, unseen
from modeler.diagnosis.events import Window
from modeler.diagnosis.gram import VISIBLE
from modeler.diagnosis.judge import Judged
from modeler.diagnosis.orders import systematic_share
from modeler.diagnosis.plausible import objection
from modeler.diagnosis.propose import proposals, ruled_out
from modeler.diagnosis.result import Diagnosis, Finding, JointState, Key, Pick, closure, mean_square
from modeler.diagnosis.score import Change, Score, Unseen, errors_of
from modeler.diagnosis.search import Search, Step, extended
from modeler.diagnosis.sentences import evidence, sentences
from modeler.diagnosis.state import Data, State, state_of
from modeler.diagnosis.timing import instrumental
from modeler.effects.catalogue import effect_named
from modeler.effects.effect import Acts
from modeler.estimation.model_file import IdentifiedModel
from modeler.observation.channels import Fault

LOST = 1.0
"""Held-out error from which on a model says nothing about that motion, nor what it lacks."""


SAME_WAVES = 0.1
"""Orders that differ by less than this share are one."""


Tick = Callable[[], None]


def _silent() -> None:
    """Nobody is told."""


def assembled(
    model: IdentifiedModel, found: Search, other: Data | None, window: Window | None,
    looks: Sequence[tuple[CrossCheck, ...]] = (), faults: Sequence[Fault] = (),
    tick: Tick = _silent,
) -> Diagnosis:  # fmt: skip
    """The diagnosis.

    Args:
        model: as given.
        found: of the training logs.
        other: held-out ones.
        window: of a contact that was masked.
        looks: what other looks say of every effect, in order.
        faults: channels that contradict the model; if one is certain, nothing is named.
        tick: called whenever something is done.
    """
    chain, shares = _chain(found), _shares(found.end, tick)
    seen = [unseen(state, other) for state in chain]
    contradicted = any(fault.certain for fault in faults)
    every = []
    if not contradicted:
        every = _findings(found, chain, window, shares, seen, other, looks, tick)
    joints = _joints(found, seen, shares)
    every = [_doubted(finding, joints) for finding in every]
    effects, refinements = (tuple(f for f in every if f.refines is r) for r in (False, True))
    diagnosis = Diagnosis(
        robot=model.spec.robot,
        verdict="cannot tell" if contradicted else verdict(effects, joints, found),
        effects=effects,
        refinements=refinements,
        rivals=_rivals(found),
        blind_spots=blind_spots(found),
        joints=joints,
        unmoved=tuple(j.name for j in model.spec.joints if j.name not in joints),
        held_out=other.observation.logs if other else (),
        sentences=(),
        fit_band=model.processing.parallel_cutoff or 0.0,
        data=doubts(model, found, other, faults, window),
        contradicted=contradicted, window=window, search=found,
    )  # fmt: skip
    return sentences(diagnosis)


def _shares(state: State, tick: Callable[[], None]) -> list[float]:
    """(J,) of the variance of what is left, systematic."""
    shares = []
    for j in range(state.rows.joints):
        tick()
        shares.append(systematic_share(state, j))
    return shares


def _doubted(finding: Finding, joints: Mapping[str, JointState]) -> Finding:
    """An event, where something acts all the time: what stood out of it may be none."""
    if not finding.event or finding.objection or not any(j.unexplained for j in joints.values()):
        return finding
    return dataclasses.replace(finding, objection="something unexplained acts all the time")


def _rivals(found: Search) -> tuple[tuple[str, str | None, float], ...]:
    """Effect, joint and gain of the rivals of the first effect, best first."""
    ranked = found.steps[0].rivals if found.steps else found.last.ranked
    return tuple((*r.candidate.key, r.gain) for r in ranked[:8])


def _findings(
    found: Search,
    chain: Sequence[State],
    window: Window | None,
    systematic: Sequence[float],
    seen: Sequence[Unseen],
    other: Data | None,
    looks: Sequence[tuple[CrossCheck, ...]],
    tick: Callable[[], None],
) -> list[Finding]:
    """Effects that were put in and lower the error there, and those that are no columns."""
    findings = []
    squares = [np.array([mean_square(left) for left in own.residual]) for own in seen]
    for k, step in enumerate(found.steps):
        touched = touched_joints(step.judged, *chain[k : k + 2])
        score = compared(seen[k], seen[k + 1], touched, found.end)
        if score.better and score.whole.after <= LOST:
            closed = closure(chain[k:], touched, systematic, squares[k:] if other else None)
            finding = _finding(found, step, touched, score.whole, closed)
            findings.append(dataclasses.replace(finding, looks=looks[k] if looks else ()))
        tick()

    def falls(candidate: Candidate) -> Score:
        after = unseen(extended(found.end, candidate), other)
        return compared(seen[-1], after, [candidate.index], found.end)

    return detected(found, window, errors_of(seen[-1]), falls, findings)


def _chain(found: Search) -> list[State]:
    """The states after none, one, two ... of the effects."""
    picks = [step.pick for step in found.steps]
    middle = [state_of(found.start.data, picks[:k], found.end.beta) for k in range(1, len(picks))]
    return [found.start, *middle, *([found.end] if picks else [])]


def _finding(
    found: Search,
    step: Step,
    touched: Sequence[int],
    change: Change,
    closed: float,
) -> Finding:
    judged, pick = step.judged, step.pick
    place = next(i for i, s in enumerate(found.steps) if s is step)
    values, deviations = found.end.values[place], judged.deviations * _left(found, step, touched)
    if pick.effect.acts is Acts.TORQUE:  # least squares make delays too small
        values, deviations = instrumental(step.before, pick)
    visible = judged.visible
    if is_gain(pick):
        deviations, visible = gain_deviations(found.end, place), gain_visible(found.end, place)
    along = profile_of(found.end, place)
    if along is not None:
        deviations = along.deviations()
    named = values_of(found.end, pick, values, deviations)
    intervals = {} if along is None else named_intervals(along, named)
    parameters = named.value | dict(pick.shapes)
    ties = tuple(dict.fromkeys([*(t.candidate.key for t in step.ties),
                                *_same(judged, found)]))  # fmt: skip
    return Finding(
        effect=pick.effect.id,
        joint=pick.joint,
        error_before=change.before,
        error_after=change.after,
        parameters=parameters,
        sigmas=named.deviation | ({} if along is None else along.shape_deviations()),
        intervals=intervals,
        units=named.unit | shape_units(found.end, pick),
        ties=ties,
        evidence=evidence(step, change.before, change.after),
        closure=closed,
        refines=_refines(found, step),
        objection=objection(found.end, pick, parameters),
        pick=Pick(pick, values, found.end, visible),
    )


def _left(found: Search, step: Step, touched: Sequence[int]) -> float:
    """Rms of the residual that stays on some joints over that before the effect."""
    sigma = step.before.sigma
    rest = [found.end.residual[j] / sigma[j] for j in touched]
    return float(np.sqrt(np.mean(np.concatenate(rest) ** 2)))


def _same(judged: Judged, found: Search) -> list[Key]:
    """Effects that no data tell from it; whose motor turns two joints is a matter of words."""
    pick = judged.candidate
    same: list[Key] = [(other, pick.joint) for other in pick.effect.same_as]
    if pick.effect.acts is Acts.MOTOR and "c" in pick.shapes:
        same.append((pick.effect.id, found.start.spec.joints[pick.index - 1].name))
    return [key for key in same if not ruled_out(*key, found.without)]


def _refines(found: Search, step: Step) -> bool:
    """True if it mends a law in the model, or an effect of its family named before on its joint.

    Those are smaller than what they mend. What moves the links is felt next to its joint too.
    """
    if _mends(found, step):
        return True
    for earlier in found.steps:
        if earlier is step:
            return False
        if _mends(found, earlier):
            continue
        first, later = earlier.pick, step.pick
        if first.joint == later.joint and _same_waves(first, later):
            return True
        alike = first.joint == later.joint and first.effect.family == later.effect.family
        moves = first.effect is later.effect and first.effect.acts is Acts.POSITION
        beside = moves and abs(first.index - later.index) <= 1
        if (alike or beside) and step.judged.felt < earlier.judged.felt:
            return True
    return False


def _mends(found: Search, step: Step) -> bool:
    place = next(i for i, s in enumerate(found.steps) if s is step)
    return step.pick.effect.mends(float(found.end.values[place][0]))


def _same_waves(first: Candidate, later: Candidate) -> bool:
    """True for ripple and run-out of the same order: what one leaves looks like the other."""
    orders = [c.order for c in (first, later)]
    waves = all(c.effect.orders is not None for c in (first, later))
    return waves and abs(orders[0] - orders[1]) < SAME_WAVES * max(orders)


def _joints(
    found: Search, seen: Sequence[Unseen], systematic: Sequence[float]
) -> dict[str, JointState]:
    states, ends = {}, [errors_of(seen[k]) for k in (0, -1)]
    for j, joint in enumerate(found.start.spec.joints):
        if not found.start.rows.y[j].size:
            continue
        size = mean_square(found.start.rows.y[j])
        before, after = (mean_square(s.residual[j]) for s in (found.start, found.end))
        share = after / size if size > 0.0 else math.nan
        states[joint.name] = JointState(
            error_before=ends[0].get(joint.name, math.nan),
            error_after=ends[1].get(joint.name, math.nan),
            unit=joint.effort_unit,
            rms_before=math.sqrt(before),
            rms_after=math.sqrt(after),
            explained=1.0 - share,
            systematic=share * systematic[j],
            noise=share * (1.0 - systematic[j]),
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


def blind_spots(found: Search) -> tuple[Key, ...]:
    """Effects that these data cannot show: hidden by the model, or on joints that do not move."""
    ranked = found.steps[0].rivals if found.steps else found.last.ranked
    spec = found.start.spec
    has = {(p.effect, p.joint) for p in spec.standard}
    judged = [j for j in ranked if j.candidate.key not in has]
    seen = {j.candidate.key for j in judged}
    hidden: list[Key] = [j.candidate.key for j in judged if j.visible < 2.0 * VISIBLE]

    def ruled(effect: str, joint: str | None) -> bool:
        return ruled_out(effect, joint, found.without)

    catalogue = found.start.data.known.catalogue
    for joint in spec.joints:
        for name in [effect.id for effect in catalogue if effect.whole_axis]:
            if joint.actuated and (name, joint.name) not in seen and not ruled(name, joint.name):
                hidden.append((name, joint.name))
    for name in [effect.id for effect in catalogue if effect.last_link]:
        if found.start.data.kept is None and not ruled(name, None):
            hidden.append((name, None))
    hidden += [key for key in _unmoved(found.start) if not ruled(*key)]
    named = {step.pick.key for step in found.steps}
    named |= {tie.candidate.key for step in found.steps for tie in step.ties}
    kept = [key for key in dict.fromkeys(hidden) if key not in named]
    assert all(effect_named(name, found.start.data.known.catalogue) is not None for name, _ in kept)
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
        candidate.key for candidate in proposals(state)
        if candidate.effect.acts in own
        and (
            not state.rows.y[candidate.index].size
            or (steady[candidate.index] and candidate.form.names == {"v"})
        )
    ]  # fmt: skip
