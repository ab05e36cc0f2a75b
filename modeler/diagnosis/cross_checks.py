"""Other looks at the same machine: what names an effect must hold in all of them.

The first look is at the training logs, in the band of the diagnosis. The others change what has
nothing to do with the robot: the held-out logs take the place of the training logs, and the band is
another, wide or narrow. An effect that another one on its joint surely beats there, or that no
longer explains anything, is a matter of the look. And what the user ruled out is asked beside every
effect: if it would have been named instead, the effect stands in for it.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.json import select_attributes
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import expand_columns
from modeler.diagnosis.generate import generate_candidates, is_ruled_out
from modeler.diagnosis.judge import (
    ScoredCandidate,
    compute_holdout_residuals,
    count_free_numbers,
    find_equivalents,
    fit_on_logs,
    is_refinement,
    select_best,
)
from modeler.diagnosis.score import Residuals, compute_errors
from modeler.diagnosis.search import Search, SearchStep, Tick, linearise_state, scan_candidates
from modeler.diagnosis.state import SearchData, State, build_columns, build_state
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.diagnosis.timing import smooth_rows
from modeler.estimation import IdentifiedModel, identify
from modeler.regression import Log, build_observation, prepare_logs

Key = tuple[str, str | None]
"""Effect and joint; the joint of an effect of the whole robot is None."""


@dataclass(frozen=True)
class CrossCheck:
    """What another look says of one effect.

    Attributes:
        what: which look, in words.
        leads: effect and joint that lead there on its joint; None if nothing surely does.
        agrees: True if that is the effect, if the data there do not tell it from the effect, or if
            nothing is sure there.
        gain: fall of the residual variance of its joints there, cross-validated; NaN if unknown.
        expected: what the values that it was named with let expect of it there; 0 if unknown.
    """

    what: str
    leads: Key | None
    agrees: bool
    gain: float = math.nan
    expected: float = 0.0

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        leads = (
            None if self.leads is None else dict(zip(("effect", "joint"), self.leads, strict=True))
        )
        return {"leads": leads, **select_attributes(self, "what agrees gain expected")}


@dataclass(frozen=True, eq=False)
class CrossCheckData:
    """Another look.

    Attributes:
        what: which, in words.
        data: the logs in it.
        asks: True if an effect must show there; held-out logs have vetoed what does not.
    """

    what: str
    data: SearchData
    is_required: bool = True


def cross_check_effects(
    search: Search, data_sets: Sequence[CrossCheckData], tick: Tick = lambda: None
) -> list[tuple[CrossCheck, ...]]:
    """What the other looks say of every effect that was put in, in order.

    Args:
        search: the search in the first look.
        data_sets: others.
        tick: called after each.
    """
    checks_by_step: list[list[CrossCheck]] = [[] for _ in search.steps]
    for data_set in data_sets:
        for place, step_checks in enumerate(checks_by_step):
            step_checks.append(_cross_check_step(data_set, search, place))
            tick()
    return [
        (*step_checks, *_check_excluded(search, s))
        for step_checks, s in zip(checks_by_step, search.steps, strict=True)
    ]


def _check_excluded(search: Search, step: SearchStep) -> list[CrossCheck]:
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
    alike = (
        j
        for j in asked.ranked
        if j not in same_effect
        and j.is_significant
        and j.total_reduction >= least
        and count_free_numbers(j.candidate) <= count_free_numbers(step.candidate)
    )
    best = next(alike, asked.best)
    if best is None or best.key == step.candidate.key:
        return []
    return [CrossCheck("ruled out", best.key, False)]


def _cross_check_step(data_set: CrossCheckData, search: Search, place: int) -> CrossCheck:
    what, data, step = data_set.what, data_set.data, search.steps[place]
    picks = [*search.start.picks, *(s.candidate for s in search.steps[: place + 1])]
    if not all(_is_logged(data, pick) for pick in picks):
        return CrossCheck(what, None, True)
    # the state in which the effect was chosen, from other data
    state = linearise_state(build_state(data, picks[:-1], step.before.beta))
    candidate_scores = _rescan_candidates(state, step, search)
    gains = [j.variance_reduction for j in candidate_scores if j.key == step.candidate.key]
    gain = gains[0] if gains else 0.0
    expected = _compute_expected_gain(state, step) if data_set.is_required else 0.0
    joint = step.candidate.joint
    near = [j for j in candidate_scores if joint is None or j.key[1] in (None, joint)]
    best = select_best(state, near).best
    if best is None:
        return CrossCheck(what, None, True, gain, expected)
    alike = {best.key, *(j.key for j in find_equivalents(best, candidate_scores))}
    if is_refinement(best.candidate, step.candidate):
        alike.add(step.candidate.key)
    return CrossCheck(what, best.key, step.candidate.key in alike, gain, expected)


def _compute_expected_gain(state: State, step: SearchStep) -> float:
    """Fall of the residual variance of its joints that the values of an effect let expect.

    Of the smooth motion: what the noise of the positions does to its columns explains nothing.
    """
    columns, base = build_columns(smooth_rows(state), step.candidate), state.gram_blocks
    torques = [
        expand_columns(columns, j, len(y)) @ step.score.values / s
        for j, (y, s) in enumerate(zip(base.y, base.sigma, strict=True))
    ]
    hidden = sum(
        basis.T @ torque for basis, torque in zip(base.whitened_columns, torques, strict=True)
    )
    fall = sum(float(torque @ torque) for torque in torques) - float(np.sum(hidden**2))
    before = state.rank_columns([]).before[step.candidate.list_affected_joints(len(torques))]
    return fall / max(float(before.sum()), 1e-300)


def _is_logged(data: SearchData, candidate: Candidate) -> bool:
    """False for what reads a temperature that these logs lack."""
    temperature = data.rows.signals[0].reference.temperature
    return "T" not in candidate.form.names or candidate.joint in temperature


def _rescan_candidates(state: State, step: SearchStep, search: Search) -> list[ScoredCandidate]:
    """The effect and its nearest rivals, each at the best of its shapes."""
    refused = {j.key for j in search.vetoed_candidates}
    rivals = [j.candidate for j in step.alternatives if j.key not in refused][
        : THRESHOLDS.max_rechecked_alternatives
    ]
    first = [step.candidate, *rivals]
    keys = {c.key for c in first}
    again = [c for c in generate_candidates(state, None, search.without, keys) if c.key in keys]
    return list(
        scan_candidates(state, [c for c in (*first, *again) if _is_logged(state.data, c)]).best
    )


# Is the machine of the held-out logs that of the training logs?


@dataclass(frozen=True)
class ParameterChange:
    """A base parameter that differs between the training and the held-out logs.

    Attributes:
        name: of the parameter.
        before, after: fitted to the training logs, and to the held-out logs alone.
        sigma_before, sigma_after: standard deviations.
        unit: of all four.
        share: rms torque of the change over that of the joint where it is largest.
    """

    name: str
    before: float
    after: float
    sigma_before: float
    sigma_after: float
    unit: str
    share: float


def find_changed_parameters(
    model: IdentifiedModel, search: Search, other: SearchData, left: Residuals, logs: Sequence[Log]
) -> tuple[ParameterChange, ...]:
    """Parameters in which the machine of the held-out logs differs, the most important first.

    Args:
        model: as given.
        search: the search on the training logs.
        other: the held-out logs.
        left: what the model with all effects leaves of these.
        logs: the same logs.
    """
    there = fit_on_logs(search.end, other)
    alone, training = (
        compute_errors(compute_holdout_residuals(state, None)) for state in (there, search.end)
    )
    most = {
        joint: THRESHOLDS.min_machine_error_ratio * max(alone[joint], training.get(joint, 0.0))
        for joint in alone
    }
    misses = any(error > most.get(joint, math.inf) for joint, error in compute_errors(left).items())
    if not misses or other.fixed_parameters is not None:
        return ()
    rows = build_observation(other.compiled, logs, prepare_logs(other.spec, logs, model.processing))
    fitted = identify(rows, "weighted", other.compiled).parameters
    changes = []
    for i, (a, b) in enumerate(zip(model.fit.parameters, fitted, strict=True)):
        change = b.value - a.value
        share = max(
            abs(change) * float(np.linalg.norm(w[:, i])) / (float(np.linalg.norm(y)) or math.inf)
            for w, y in zip(there.rows.W, there.rows.y, strict=True)
        )
        if a.sigma is None or b.sigma is None or share < THRESHOLDS.min_changed_torque_share:
            continue
        if abs(change) > THRESHOLDS.min_changed_parameter_t * math.hypot(a.sigma, b.sigma):
            changes.append(
                ParameterChange(a.name, a.value, b.value, a.sigma, b.sigma, a.unit, share)
            )
    return tuple(sorted(changes, key=lambda training: -training.share))
