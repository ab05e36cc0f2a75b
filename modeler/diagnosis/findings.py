"""From a search to findings: other data, held-out errors, equivalents, verdict."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial

import numpy as np

from modeler.core.json import ShortRepr
from modeler.diagnosis import messages, result
from modeler.diagnosis.candidates import Candidate, to_dense
from modeler.diagnosis.events import detect_events
from modeler.diagnosis.generation import (
    compute_systematic_share,
    estimate_instrumental,
    generate_candidates,
    is_ruled_out,
    smooth_rows,
)
from modeler.diagnosis.plausibility import (
    compute_gain_deviations,
    compute_gain_visibility,
    find_caveat,
    is_gain,
)
from modeler.diagnosis.profile import estimate_effect
from modeler.diagnosis.scoring import (
    ErrorChange,
    Residuals,
    Score,
    ScoredCandidate,
    compare_residuals,
    compute_errors,
    compute_holdout_residuals,
    count_free_numbers,
    find_affected_joints,
    find_equivalents,
    fit_on_logs,
    is_refinement,
    select_best,
)
from modeler.diagnosis.search import (
    Search,
    SearchStep,
    Tick,
    extend_state,
    linearise_state,
    scan_candidates,
)
from modeler.diagnosis.state import SearchData, State, build_columns, build_state, get_cutoff
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import EffectTarget, find_effect
from modeler.estimation import (
    IdentifiedModel,
    MachineComparison,
    compare_machines,
    fit_machine,
    sum_machine_rows,
)
from modeler.regression import DataWarning, compute_prior_weights
from modeler.runtime import map_parts


@dataclass(frozen=True, eq=False)
class CrossCheckData:
    """Another look at the logs, by which an effect is checked.

    Attributes:
        what: which, in words.
        data: the logs in it.
        is_required: True if an effect must show there; held-out logs have vetoed what does not.
    """

    what: str
    data: SearchData
    is_required: bool = True


def cross_check_effects(
    search: Search, data_sets: Sequence[CrossCheckData], tick: Tick = lambda: None
) -> list[tuple[result.CrossCheck, ...]]:
    """Checks on other data every effect that was put in, in order.

    Args:
        search: the search in the first look.
        data_sets: others.
        tick: called after each.
    """
    checks_by_step: list[list[result.CrossCheck]] = [[] for _ in search.steps]
    for data_set in data_sets:
        for place, step_checks in enumerate(checks_by_step):
            step_checks.append(_cross_check_step(data_set, search, place))
            tick()
    pairs = zip(checks_by_step, search.steps, strict=True)
    return [(*checks, *_check_excluded(search, step)) for checks, step in pairs]


def _check_excluded(search: Search, step: SearchStep) -> list[result.CrossCheck]:
    """What would have been named had the user ruled nothing out, or explains as much as simply."""
    if not search.without:
        return []
    state = step.before
    barred = [c for c in generate_candidates(state) if is_ruled_out(*c.key, search.without)]
    if not barred:
        return []
    asked = scan_candidates(state, [step.candidate, *barred]).judge_candidates()
    same_effect = [j for j in asked.ranked if j.key == step.candidate.key]
    least = THRESHOLDS.parsimony_share * same_effect[0].total_reduction if same_effect else 0.0
    numbers = count_free_numbers(step.candidate)
    others = (j for j in asked.ranked if j not in same_effect and j.total_reduction >= least)
    alike = (j for j in others if j.is_significant and count_free_numbers(j.candidate) <= numbers)
    best = next(alike, asked.best)
    if best is None or best.key == step.candidate.key:
        return []
    return [result.CrossCheck("ruled out", best.key, False)]


def _cross_check_step(data_set: CrossCheckData, search: Search, place: int) -> result.CrossCheck:
    what, data, step = data_set.what, data_set.data, search.steps[place]
    picks = [*search.start.picks, *(s.candidate for s in search.steps[: place + 1])]
    if not all(_is_logged(data, pick) for pick in picks):
        return result.CrossCheck(what, None, True)
    # the state in which the effect was chosen, from other data
    state = linearise_state(build_state(data, picks[:-1], step.before.beta))
    scores = _rescan_candidates(state, step, search)
    gains = [j.variance_reduction for j in scores if j.key == step.candidate.key]
    gain = gains[0] if gains else 0.0
    expected = _compute_expected_gain(state, step) if data_set.is_required else 0.0
    joint = step.candidate.joint
    near = [j for j in scores if joint is None or j.key[1] in (None, joint)]
    best = select_best(state, near).best
    if best is None:
        return result.CrossCheck(what, None, True, gain, expected)
    alike = {best.key, *(j.key for j in find_equivalents(best, scores))}
    if is_refinement(best.candidate, step.candidate):
        alike.add(step.candidate.key)
    return result.CrossCheck(what, best.key, step.candidate.key in alike, gain, expected)


def _compute_expected_gain(state: State, step: SearchStep) -> float:
    """Fall of the residual variance of its joints that the values of an effect let expect.

    Of the smooth motion: what the noise of the positions does to its columns explains nothing.
    """
    columns, base = build_columns(smooth_rows(state), step.candidate), state.gram_blocks
    torques = [
        to_dense(columns, j, len(y)) @ step.score.values / s
        for j, (y, s) in enumerate(zip(base.y, base.sigma, strict=True))
    ]
    pairs = zip(base.whitened_columns, torques, strict=True)
    hidden = sum(basis.T @ torque for basis, torque in pairs)
    fall = sum(float(torque @ torque) for torque in torques) - float(np.sum(hidden**2))
    before = state.rank_columns([]).before[step.candidate.list_affected_joints(len(torques))]
    return fall / max(float(before.sum()), 1e-300)


def _is_logged(data: SearchData, candidate: Candidate) -> bool:
    """False for what reads a temperature that these logs lack, or a resonance above their rows."""
    temperature = data.rows.signals[0].reference.temperature
    if candidate.elastic is not None and not candidate.elastic.is_resolved(data.rows.signals):
        return False
    return "T" not in candidate.form.names or candidate.joint in temperature


def _rescan_candidates(state: State, step: SearchStep, search: Search) -> list[ScoredCandidate]:
    """The effect and the next best alternatives, each at the best of its shapes."""
    refused = {j.key for j in search.vetoed_candidates}
    rivals = [j.candidate for j in step.alternatives if j.key not in refused]
    first = [step.candidate, *rivals[: THRESHOLDS.max_rechecked_alternatives]]
    keys = {c.key for c in first}
    again = [c for c in generate_candidates(state, None, search.without, keys) if c.key in keys]
    logged = [c for c in (*first, *again) if _is_logged(state.data, c)]
    return list(scan_candidates(state, logged).best)


# Is the machine of the held-out logs that of the training logs?


def compare_holdout(search: Search, other: SearchData) -> MachineComparison | None:
    """Compares the machine of the held-out logs, beside all effects; None with a fixed robot.

    Args:
        search: the search on the training logs.
        other: the held-out logs.
    """
    if other.fixed_parameters is not None:
        return None
    states = search.end, fit_on_logs(search.end, other)
    rows = [(state.W, state.y, state.data.observation) for state in states]
    sums = [sum_machine_rows(W, y, o.used, compute_prior_weights(o)) for W, y, o in rows]
    return compare_machines(search.spec, fit_machine(sums[0]), sums[1])


def remove_changes(data: SearchData, comparison: MachineComparison) -> SearchData:
    """Removes from the torques of held-out logs what changed since the training logs."""
    observation, width = data.observation, len(data.spec.base)
    torque = observation.torque.copy()
    for j, used in enumerate(observation.used.T):
        columns = comparison.torque_columns[j]
        torque[used, j] -= data.rows.W[j] @ columns[:width] + columns[-1]
    return replace(data, observation=replace(observation, torque=torque))


@dataclass(frozen=True, eq=False)
class BandSearch(ShortRepr):
    """A search in one band, and what is made of it.

    Attributes:
        search: of the training logs.
        other: held-out ones in that band.
        held_out_residuals: what the states of the search leave of these.
        share: systematic share of what the last leaves on a joint.
        findings: its effects.
    """

    search: Search
    other: SearchData | None
    held_out_residuals: Sequence[Residuals]
    share: Callable[[int], float]
    findings: Sequence[result.Finding]

    @property
    def named_steps(self) -> tuple[SearchStep, ...]:
        """Returns the steps whose effects are named."""
        named = {(f.effect, f.joint) for f in self.findings if not f.warning}
        return tuple(step for step in self.search.steps if step.candidate.key in named)


def evaluate_search(
    search: Search,
    other: SearchData | None,
    checks: Sequence[tuple[result.CrossCheck, ...]],
    tick: Tick,
) -> BandSearch:
    """Evaluates the effects of a search on held-out data.

    Args:
        search: of the training logs.
        other: held-out ones in the same band.
        checks: what other looks say of every effect, in order.
        tick: called whenever something is done.
    """
    picks, beta = [*search.start.picks, *(step.candidate for step in search.steps)], search.end.beta
    ends = range(len(search.start.picks) + 1, len(picks))
    middle = (build_state(search.start.data, picks[:k], beta) for k in ends)
    chain = [search.start, *middle, *([search.end] if search.steps else [])]
    residuals = [compute_holdout_residuals(state, other) for state in chain]
    looks_at = [(search.end, [state.residual for state in chain])]
    if other is not None:
        looks_at.append((fit_on_logs(search.end, other), [left.residual for left in residuals]))

    def compute_share(state: State, left: Sequence[np.ndarray], j: int) -> float:
        tick()  # it takes long
        return compute_systematic_share(state, j, left[j])

    shares = [cache(partial(compute_share, state, left[-1])) for state, left in looks_at]
    squares = [[[*map(result.compute_mean_square, r)] for r in left] for _, left in looks_at]
    findings = list[result.Finding]()
    for k, step in enumerate(search.steps):
        touched = find_affected_joints(step.score, *chain[k : k + 2])
        score = compare_residuals(residuals[k], residuals[k + 1], touched, search.end)
        if score.is_better and score.whole.after <= THRESHOLDS.max_predictive_error:
            closed = min(
                result.compute_explained_fraction(values[k:], touched, share, chain[k].sigma)
                for values, share in zip(squares, shares, strict=True)
            )
            names = [search.end.joint_names[j] for j in touched]
            after = [change.after for change in score.joints if change.joint in names]
            finding = _build_finding(search, k, touched, score.whole, closed, checks[k], after)
            findings.append(finding)
        tick()
    return BandSearch(search, other, residuals, shares[0], findings)


def assemble_diagnosis(
    model: IdentifiedModel,
    bands: Sequence[BandSearch],
    window: result.PushWindow | None,
    faults: Sequence[DataWarning] = (),
    machine: MachineComparison | None = None,
) -> result.Diagnosis:
    """Assembles the diagnosis.

    Args:
        model: as given.
        bands: the search in the band of the diagnosis; then, if there is one, that in a wider band.
        window: of a contact that was masked.
        faults: channels that contradict the model; if one is certain, nothing is named.
        machine: that of the held-out logs, compared; None where there are none.
    """
    first, last = bands[0], bands[-1]
    search, other = first.search, first.other
    contradicted, left = any(fault.is_certain for fault in faults), last.held_out_residuals[-1]

    def score_candidate(candidate: Candidate) -> Score:
        after = compute_holdout_residuals(extend_state(last.search.end, candidate), last.other)
        return compare_residuals(left, after, [candidate.index], last.search.end)

    every: list[result.Finding] = []
    end, residuals = search.end, first.held_out_residuals[-1]
    if not contradicted:
        every = _deduplicate_findings([finding for band in bands for finding in band.findings])
        every, end, residuals = _evaluate_in_table_band(every, bands)
        every = detect_events(last.search, window, compute_errors(left), score_candidate, every)
    joints = _summarise_joints(search, end, (first.held_out_residuals[0], residuals), first.share)
    every = [_add_event_caveat(finding, joints) for finding in every]
    every.sort(key=lambda finding: finding.status == "possible")
    effects, refinements = (tuple(f for f in every if f.is_refinement is r) for r in (False, True))
    rivals = tuple((*rival.key, rival.variance_reduction) for rival in search.ranked[:8])
    diagnosis = result.Diagnosis(
        robot=model.spec.robot,
        verdict="cannot tell" if contradicted else decide_verdict(effects, joints, search),
        effects=effects,
        refinements=refinements,
        alternatives=rivals,
        undetectable=list_undetectable_effects(search),
        joints=joints,
        unmoved_joints=tuple(j.name for j in model.spec.joints if j.name not in joints),
        held_out_logs=other.observation.logs if other else (),
        sentences=(),
        fit_band=model.processing.parallel_cutoff or 0.0,
        data_warnings=messages.collect_warnings(model, search, other, faults, window),
        has_contradictions=contradicted,
        machine=machine,
        window=window,
        search=search,
    )
    return messages.add_sentences(diagnosis)


def _deduplicate_findings(findings: Sequence[result.Finding]) -> list[result.Finding]:
    """What two bands say of an effect: as it is named, if it is, or as it was seen first."""
    unique: dict[tuple[object, ...], result.Finding] = {}
    for k, finding in enumerate(findings):
        several = finding.pick is not None and finding.pick.candidate.effect.is_repeatable
        key = (finding.effect, finding.joint, k if several else 0)
        if key not in unique or (unique[key].warning and not finding.warning):
            unique[key] = finding
    return list(unique.values())


def _evaluate_in_table_band(
    every: Sequence[result.Finding], bands: Sequence[BandSearch]
) -> tuple[list[result.Finding], State, Residuals]:
    """Findings of the wider band with the errors that they have in the band of the table.

    And the state with all that is named, and what it leaves of unseen motion.
    """
    first, updated = bands[0], list(every)
    state, residuals = first.search.end, first.held_out_residuals[-1]
    for i, finding in enumerate(every):
        if finding.warning or finding.pick is None or finding in first.findings:
            continue
        pick, wider = finding.pick.candidate, bands[-1].search
        (step,) = (step for step in wider.steps if step.candidate is pick)
        later = extend_state(state, pick)
        left = compute_holdout_residuals(later, first.other)
        touched = find_affected_joints(step.score, state, later)
        score = compare_residuals(residuals, left, touched, later)
        ends, why = (score.whole.before, score.whole.after), ""
        if score.is_better:
            state, residuals = later, left
        else:
            why = f"the error falls only up to {get_cutoff(wider.start.data):.2g} Hz"
        text = messages.describe_evidence(step, *ends)
        better = replace(finding, error_before=ends[0], error_after=ends[1])
        updated[i] = replace(better, warning=why, evidence=text)
    return updated, state, residuals


def _add_event_caveat(
    finding: result.Finding, joints: Mapping[str, result.JointState]
) -> result.Finding:
    """An event, where something acts all the time: what stood out of it may be none."""
    unexplained = any(j.is_unexplained for j in joints.values())
    if finding.is_event and not finding.caveat and unexplained:
        return replace(finding, caveat="something unexplained acts all the time")
    return finding


def _build_finding(
    search: Search,
    k: int,
    touched: Sequence[int],
    change: ErrorChange,
    closed: float,
    checks: tuple[result.CrossCheck, ...],
    after: Sequence[float],
) -> result.Finding:
    """The finding of the k-th step."""
    step, end, first = search.steps[k], search.end, k == 0 and not search.prior_steps
    k += len(search.prior_steps)
    pick, before, visible = step.candidate, step.before, step.score.visible_share
    left = np.concatenate([end.residual[j] / before.sigma[j] for j in touched])
    values, deviations = end.values[k], step.score.deviations * float(np.sqrt(np.mean(left**2)))
    if pick.is_delay:  # least squares make delays too small
        values, deviations = estimate_instrumental(before, pick)
    if is_gain(pick):
        deviations, visible = compute_gain_deviations(end, k), compute_gain_visibility(end, k)
    estimate = estimate_effect(end, k, pick, values, deviations)
    rivals, refines = [tie.candidate for tie in step.equivalents], _is_refinement(search, k)
    same = [
        (other, pick.joint) for other in pick.effect.equivalent_effects
    ]  # no data distinguish these
    same = [key for key in same if not is_ruled_out(*key, search.without)]
    against, errors = find_caveat(end, pick, estimate.parameters), (change.before, change.after)
    seen = closed, checks, rivals, refines, after
    doubt = result.explain_weak_evidence(pick, errors, against, estimate.sigmas, *seen)
    equivalents = tuple(dict.fromkeys([*(rival.key for rival in rivals), *same]))
    numbers = *errors, estimate.parameters, estimate.sigmas, estimate.units
    evidence = messages.describe_evidence(step, *errors)
    said = equivalents, evidence, closed, refines, against, estimate.intervals, checks
    fitted = result.FittedCandidate(pick, values, end, visible)
    whole = *pick.key, *numbers, *said
    return result.Finding(*whole, fitted, warning=doubt, is_first=first)


def _is_refinement(search: Search, k: int) -> bool:
    """True if it mends a law in the model, or an effect of its family named before on its joint.

    Those are smaller than what they mend. What moves the links acts beside its joint too.
    """
    steps = (*search.prior_steps, *search.steps)[: k + 1]
    mends = [
        step.candidate.effect.refines_model_term(float(values[0]))
        for step, values in zip(steps, search.end.values, strict=False)
    ]
    step = steps[k]
    for i, earlier in enumerate(steps[:k]):
        first, later = earlier.candidate, step.candidate
        if mends[i]:
            continue
        alike = first.joint == later.joint and first.effect.family == later.effect.family
        moves = first.effect is later.effect and first.effect.acts is EffectTarget.POSITION
        moves = moves and later.elastic is None  # the fit of several keeps them apart
        beside = moves and abs(first.index - later.index) <= 1
        if (alike or beside) and step.score.torque_share < earlier.score.torque_share:
            return True
    return mends[k]


def _summarise_joints(
    search: Search, end: State, residuals: Sequence[Residuals], systematic: Callable[[int], float]
) -> dict[str, result.JointState]:
    states, ends = {}, [compute_errors(residuals[k]) for k in (0, -1)]
    shown = [j for j, y in enumerate(search.start.rows.y) if y.size]
    # what all joints share is made by the first
    values = [*map(systematic, shown[:1]), *map_parts(systematic, shown[1:])]
    shares = dict(zip(shown, values, strict=True))
    for j, joint in enumerate(search.spec.joints):
        if j not in shares:
            continue
        size = result.compute_mean_square(search.start.rows.y[j])
        before, after = (result.compute_mean_square(s.residual[j]) for s in (search.start, end))
        share = after / size if size > 0.0 else math.nan
        first, last = (errors.get(joint.name, math.nan) for errors in ends)
        rms, apart = map(math.sqrt, (before, after)), (shares[j], 1.0 - shares[j])
        seen = *rms, 1.0 - share, *(share * part for part in apart)
        states[joint.name] = result.JointState(first, last, joint.effort_unit, *seen)
    return states


def decide_verdict(
    effects: Sequence[result.Finding], joints: dict[str, result.JointState], search: Search
) -> str:
    """Decides one of the five verdicts, of the joints that are predicted.

    Args:
        effects: that are named, best first.
        joints: by name.
        search: of the training logs.
    """
    if effects:
        return "missing" if effects[0].is_confirmed else "closest description"
    few = not any(y.size > 100 for y in search.start.y)
    if few or messages.compute_duration(search.start) < THRESHOLDS.min_duration:
        return "cannot tell"
    most = THRESHOLDS.max_predictive_error
    judged = [state for state in joints.values() if not state.error_after > most]
    if not judged:
        return "cannot tell"
    if any(state.is_unexplained for state in judged):
        return "unexplained"
    return "nothing significant"


def list_undetectable_effects(search: Search) -> tuple[result.Key, ...]:
    """Lists effects that these data cannot show."""
    has = {(p.effect, p.joint) for p in search.spec.standard}
    scores, least = [j for j in search.ranked if j.key not in has], THRESHOLDS.min_visible_share
    shown_keys = {j.key for j in scores}
    names = [joint.name for joint in search.spec.joints if joint.actuated]
    axes = [effect.id for effect in search.catalogue if effect.acts_on_whole_axis]
    hidden: list[result.Key] = [(x, n) for n in names for x in axes if (x, n) not in shown_keys]
    if search.start.data.fixed_parameters is None:
        hidden += [(effect.id, None) for effect in search.catalogue if effect.is_on_last_link]
    hidden += _list_unmoved(search.start)
    shown = [key for key in hidden if not is_ruled_out(*key, search.without)]
    named_keys = {pick.key for step in search.steps for pick in (step.score, *step.equivalents)}
    every = [*(j.key for j in scores if j.visible_share < 2.0 * least), *shown]
    undetectable = [key for key in dict.fromkeys(every) if key not in named_keys]
    assert all(find_effect(name, search.catalogue) is not None for name, _ in undetectable)
    return tuple(undetectable)


def _list_unmoved(state: State) -> list[result.Key]:
    """All that could be on joints of which no row can be used, or that have one speed only.

    At one speed, functions of the speed are one column: only the moments of reversal differ.
    """
    joint_actions = (EffectTarget.JOINT, EffectTarget.MOTOR, EffectTarget.POSITION)
    joints = range(state.rows.joint_count)
    steady = [messages.find_single_speed(state, j) is not None for j in joints]
    if not any(steady) and all(y.size for y in state.rows.y):
        return []
    every = [c for c in generate_candidates(state) if c.effect.acts in joint_actions]
    slow = {id(c) for c in every if steady[c.index] and c.form.names == {"v"}}
    return [c.key for c in every if id(c) in slow or not state.rows.y[c.index].size]
