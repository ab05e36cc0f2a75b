"""Findings that are no columns: a contact, play in a gear."""

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from modeler.core.table import format_error_pair, format_percent
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.events import PushWindow, compute_burst_ratio
from modeler.diagnosis.generate import is_ruled_out
from modeler.diagnosis.judge import ScoredCandidate
from modeler.diagnosis.orders import compute_burst_share
from modeler.diagnosis.result import Finding
from modeler.diagnosis.score import Score
from modeler.diagnosis.search import Search
from modeler.diagnosis.state import State
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, EffectTarget

_NO_FALL = "no column of play surely lowers the error"


def detect_events(
    search: Search,
    window: PushWindow | None,
    errors: Mapping[str, float],
    score_candidate: Callable[[Candidate], Score],
    findings: Sequence[Finding],
) -> list[Finding]:
    """The findings with contact and play among them.

    Its knocks ring like a spring: where there is play, elasticity that explains little is no effect
    of its own. Play that is heard only before columns on its joint were put in goes ahead of those
    that explain little.

    Args:
        search: of the training logs.
        window: of a contact that was masked.
        errors: relative, by joint, with all effects put in.
        score_candidate: the score of a column beside them.
        findings: that are columns.
    """
    contact = [] if window is None else _detect_contact(search, window, errors)
    alone = all(f.is_refinement for f in findings)
    rings = any(_is_ringing(f) for f in findings)
    least = THRESHOLDS.min_faint_burst_ratio if alone else THRESHOLDS.min_faint_burst_ratio_beside
    play = _detect_backlash(
        search, search.end, THRESHOLDS.min_burst_ratio
    ) or _detect_faint_backlash(search, least, knocks=not rings)
    if play is not None:
        beside = [
            dataclasses.replace(
                f,
                is_refinement=f.is_refinement
                or (_is_ringing(f) and f.gain < THRESHOLDS.max_weak_gain),
            )
            for f in findings
        ]
        return [*beside, *contact, _score_backlash(search, play, errors, score_candidate)]
    play = _detect_backlash(search, search.start, THRESHOLDS.min_loud_burst_ratio)
    if play is None or contact:
        return [*findings, *contact]
    play = _score_backlash(search, play, errors, score_candidate)
    same_joint = [f for f in findings if f.joint == play.joint]
    if any(f.gain > THRESHOLDS.max_weak_gain and not f.is_refinement for f in same_joint):
        return list(findings)
    rest = [dataclasses.replace(f, is_refinement=True) if f in same_joint else f for f in findings]
    return [play, *rest] if same_joint or alone else [*rest, play]


def _is_ringing(finding: Finding) -> bool:
    return finding.pick is not None and finding.pick.candidate.effect.is_oscillator


def _find_impact_effects(search: Search) -> list[Effect]:
    """Effects that knock; one at most."""
    return [e for e in search.catalogue if e.knocks][:1]


def _detect_contact(
    search: Search, window: PushWindow, errors: Mapping[str, float]
) -> list[Finding]:
    """The push, if it lowers the error; held-out motion that is not explained speaks against it."""
    if window.change is None:
        return []
    event = next(e for e in search.catalogue if e.acts is EffectTarget.WINDOW)
    units = {f"tau{j.name}": j.effort_unit for j in search.spec.joints}
    torque = {f"tau{name}": value for name, value in window.torque.items()}
    ends, doubt = (window.change.before, window.change.after), ""
    for name, y, r in zip(
        search.end.joint_names, search.end.rows.y, search.end.residual, strict=True
    ):
        least = (
            THRESHOLDS.min_recurrence_ratio
            * np.linalg.norm(r)
            / max(float(np.linalg.norm(y)), 1e-300)
        )
        if y.size and errors.get(name, 0.0) > least and not doubt:
            doubt = f"something unexplained acts on joint {name} in the held-out motion too"
    text = (
        f"a torque acts from {window.start:.1f} to {window.end:.1f} s that the motion does not "
        f"explain, {window.ratio:.0f} times the energy of any other window: with it the error of "
        f"these logs is {' -> '.join(format_error_pair(*ends))}; these rows are left out of "
        "everything else"
    )
    values = {"t0": window.start, "t1": window.end} | torque
    units = {"t0": "s", "t1": "s"} | units
    return [
        Finding(
            event.id, None, *ends, values, {}, units, (), text, None, False, doubt, is_event=True
        )
    ]


def _list_backlash_joints(search: Search) -> list[int]:
    """Joints whose gear may have play."""
    return [
        j
        for j, joint in enumerate(search.spec.joints)
        for effect in _find_impact_effects(search)
        if joint.actuated and not is_ruled_out(effect.id, joint.name, search.without)
    ]


def _detect_backlash(search: Search, state: State, least: float) -> Finding | None:
    """Play in a gear, on the joint that bursts most and whose column describes most."""
    ratios = {j: compute_burst_ratio(state, j) for j in _list_backlash_joints(search)}
    bursting = [j for j, ratio in ratios.items() if ratio > least]
    if not bursting:
        return None
    shares = {
        k: candidate_score.total_variance_reduction
        for k, candidate_score in _collect_backlash_columns(search).items()
    }
    j = max(
        bursting, key=lambda k: ratios[k] * max(shares.get(k, 0.0), THRESHOLDS.floor_backlash_share)
    )
    return _build_backlash_finding(search, [j, *bursting], _format_burst_ratio(ratios[j]))


def _format_burst_ratio(ratio: float) -> str:
    return (
        f"{ratio:.0f} times the residual energy of other moments within 0.1 s after the load "
        "changes sign, while the joint moves on"
    )


def _collect_backlash_columns(search: Search) -> dict[int, ScoredCandidate]:
    """What the column of play explains, by joint."""
    return {j.candidate.index: j for j in search.last.ranked if j.candidate.effect.knocks}


def _detect_faint_backlash(search: Search, least: float, knocks: bool) -> Finding | None:
    """Play whose bursts noise covers, or that knocks without rule: its column tells it then.

    Args:
        search: of the training logs.
        least: ratio of the bursts.
        knocks: False where something else may knock.
    """
    shares = {
        j: candidate_score.total_variance_reduction
        for j, candidate_score in _collect_backlash_columns(search).items()
        if j in _list_backlash_joints(search)
        and candidate_score.variance_reduction > THRESHOLDS.min_variance_reduction
        and candidate_score.t_ratio > THRESHOLDS.min_t_ratio
    }
    for j in sorted(shares, key=lambda j: -shares[j]):
        ratio, share = compute_burst_ratio(search.end, j), compute_burst_share(search.end, j)
        if ratio > least:
            return _build_backlash_finding(search, [j], _format_burst_ratio(ratio))
        if knocks and share > THRESHOLDS.min_burst_share:
            text = f"{format_percent(share)} of the residual's energy comes in brief outbursts"
            doubt = "its outbursts do not follow the sign of the load"
            return _build_backlash_finding(search, [j], text, doubt)
    return None


def _build_backlash_finding(
    search: Search, bursting: Sequence[int], text: str, objection: str = ""
) -> Finding:
    """Play on the first of some joints; any of the others may be the one."""
    (effect,), names, first = _find_impact_effects(search), search.end.joint_names, bursting[0]
    others = tuple((effect.id, names[k]) for k in bursting if k != first)
    return Finding(
        effect.id,
        names[first],
        math.nan,
        math.nan,
        {},
        {},
        {},
        others,
        f"joint {names[first]}: {text}",
        None,
        False,
        objection,
    )


def _score_backlash(
    search: Search,
    play: Finding,
    errors: Mapping[str, float],
    score_candidate: Callable[[Candidate], Score],
) -> Finding:
    """Play with its errors; where its column does not lower them, it is a description at most."""
    column = _collect_backlash_columns(search).get(search.end.joint_names.index(str(play.joint)))
    score = None if column is None else score_candidate(column.candidate)
    if score is not None and score.is_better:
        ends = score.whole.before, score.whole.after
        text = f"{play.evidence}; error {' -> '.join(format_error_pair(*ends))}"
        return dataclasses.replace(play, error_before=ends[0], error_after=ends[1], evidence=text)
    before, doubt = errors.get(str(play.joint), math.nan), play.objection or _NO_FALL
    return dataclasses.replace(play, error_before=before, objection=doubt)
