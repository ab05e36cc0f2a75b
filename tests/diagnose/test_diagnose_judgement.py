"""What a diagnosis may not say: effects a joint cannot have, sizes, errors beyond all measure."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

from modeler.diagnosis import messages, scoring, search
from modeler.diagnosis.candidates import Candidate, StatedEffects, compute_scales, list_candidates
from modeler.diagnosis.findings import _add_event_caveat, decide_verdict
from modeler.diagnosis.messages import describe_rejected
from modeler.diagnosis.plausibility import DRIVES
from modeler.diagnosis.result import CrossCheck, Finding, explain_weak_evidence
from modeler.diagnosis.scoring import (
    ErrorChange,
    RankedCandidates,
    Score,
    ScoredCandidate,
    is_possible,
    select_alternatives,
    select_best,
)
from modeler.diagnosis.search import CandidateScan
from modeler.effects.catalogue import find_effect
from modeler.regression import DataWarning
from tests.diagnose.conftest import Case
from tests.rotation import with_cases


def candidate(name: str, joint: str | None = "1") -> Candidate:
    """An effect on a joint, with shapes that are in no grid."""
    effect = find_effect(name)
    assert effect is not None
    shapes = {shape.name: 0.123 for shape in effect.forms[0].nonlinear_parameters}
    return Candidate(effect, effect.forms[0], joint, 0, shapes)


def at_its_best(name, share, value=1.0, drop=None):
    """An effect that explains so much, by these values."""
    one = candidate(name)
    values, drop = np.full(len(one.effect.columns), value), np.ones(40) if drop is None else drop
    return ScoredCandidate(
        one, share, share, drop, values, 0.1 * values, 20.0, 0.1, 0.5, is_possible=True
    )


def joint_left(error: float, unexplained: bool = False) -> dict[str, SimpleNamespace]:
    """What is left on the only joint."""
    return {"1": SimpleNamespace(error_after=error, is_unexplained=unexplained)}


def finding(name: str, joint: str | None, after: float = 0.1, **others: object) -> Finding:
    """An effect that lowers an error of 20 %."""
    return Finding(name, joint, 0.2, after, {}, {}, {}, (), "", 1.0, False, **others)  # type: ignore[arg-type]


def test_a_joint_that_slides_has_no_lever_and_no_disc(case: Case) -> None:
    spec = case.compiled.spec
    slides = [dataclasses.replace(j, unit="m") if j.name == "2" else j for j in spec.joints]
    spec = dataclasses.replace(spec, joints=tuple(slides))
    motion = [np.random.default_rng(1).normal(size=(50, len(spec.joints)))]
    scales = compute_scales(spec, motion, motion, motion)
    names = {c.key for c in list_candidates(spec, scales, {}, set(), StatedEffects())}
    turning = ("counterbalance", "constant_force_spring", "encoder_eccentricity")
    assert not {(name, "2") for name in turning} & names
    assert {("counterbalance", "1"), ("encoder_eccentricity", "3"), ("spring", "2")} <= names


def test_signs_and_sizes_that_physics_forbids() -> None:
    for law, can_be, cannot in (
        ("encoder_offset", (0.19, -0.19), (0.21, -0.21)),
        ("rotor_inertia", (30.0,), (-0.1,)),
        ("offset", (-30.0,), ()),
        ("load_friction", (0.45,), (0.97,)),
    ):
        assert all(is_possible(candidate(law), np.array([value])) for value in can_be), law
        assert not any(is_possible(candidate(law), np.array([value])) for value in cannot), law


@pytest.mark.parametrize(("error", "said"), [(1.4, "cannot tell"), (0.9, "nothing significant")])
def test_of_motion_that_is_not_explained_at_all_nothing_can_be_told(error, said):
    time = np.linspace(0.0, 30.0, 3000)
    observation = SimpleNamespace(time=time, run=np.zeros(3000), logs=("a",))
    start = SimpleNamespace(y=[np.zeros(3000)], data=SimpleNamespace(observation=observation))
    result = SimpleNamespace(start=start)
    assert decide_verdict((), joint_left(error), result) == said  # type: ignore[arg-type]


@pytest.mark.parametrize(("stiffness", "named"), [(2.0, "spring"), (-2.0, "counterbalance")])
def test_of_two_that_explain_the_same_a_rare_sign_loses(stiffness: float, named: str) -> None:
    """A spring has fewer numbers than a lever, but pushes away from its rest in cables only."""
    drop = np.random.default_rng(2).uniform(0.5, 1.5, 40)
    others = (("spring", stiffness), ("counterbalance", 1.0))
    both = [at_its_best(name, 0.9, value, drop) for name, value in others]
    best = select_best(None, both).best  # type: ignore[arg-type]
    assert best is not None and best.candidate.effect.id == named


@with_cases(
    "effect, left, said",
    ("external_force", False, "missing"),
    ("external_force", True, "closest description"),
    ("backlash", True, "missing"),
)
def test_a_push_is_no_fact_while_something_acts_all_the_time(effect, left, said):
    joints = joint_left(0.1, left)
    event = finding(effect, None, is_event=effect == "external_force")
    first = _add_event_caveat(event, joints)  # type: ignore[arg-type]
    assert decide_verdict((first,), joints, None) == said  # type: ignore[arg-type]
    assert first.status == ("confirmed" if said == "missing" else "likely")


LED = CrossCheck("up to 9 Hz", ("stribeck", "2"), False, 0.3, 0.4)
FAINT = CrossCheck("up to 9 Hz", None, True, 0.01, 0.1)
DROWNED = CrossCheck("up to 9 Hz", None, True, -0.01, 0.015)


@with_cases(
    "name, after, others, why",
    ("spring", 0.1, {}, ""),
    ("spring", 0.185, {}, "falls by less than 10 %"),
    ("spring", 0.185, {"closed": 0.96}, ""),
    ("spring", 0.185, {"refines": True}, ""),
    ("spring", 0.65, {}, "the error is 65 % still"),
    ("spring", 0.1, {"caveat": "too heavy"}, "too heavy"),
    ("spring", 0.1, {"ties": (candidate("spring", "3"),)}, "one of joint 3"),
    ("spring", 0.1, {"ties": (candidate("counterbalance"), candidate("base_tilt", None))}, ""),
    ("spring", 0.1, {"ties": (candidate("cable_hysteresis"),)}, "kind: cable_hysteresis"),
    ("spring", 0.1, {"checks": (LED,)}, "stribeck explains its joint better (up to 9 Hz)"),
    ("spring", 0.1, {"checks": (FAINT,)}, "explains nothing up to 9 Hz"),
    ("spring", 0.1, {"checks": (DROWNED,)}, ""),
    ("drive_gain", 0.1, {"caveat": "1000 times", "checks": (LED, FAINT)}, ""),
    ("joint_ripple", 0.1, {"sigmas": {"m": 0.01}}, "no number of teeth"),
)
def test_one_rule_says_in_words_why_an_effect_is_perhaps_and_no_more(name, after, others, why):
    said = explain_weak_evidence(candidate(name), (0.2 if after < 0.2 else 0.9, after), **others)  # type: ignore[arg-type]
    assert why in said and bool(said) is bool(why)
    first = finding(name, "2", warning=said)
    assert first.status == ("possible" if why else "confirmed")
    assert decide_verdict((first,), joint_left(0.1), None) == (  # type: ignore[arg-type]
        "closest description" if why else "missing"
    )


@pytest.mark.parametrize(("share", "goes_first"), [(0.6, True), (0.4, False)])
def test_plain_friction_goes_before_what_refines_it(share: float, goes_first: bool) -> None:
    drop = np.random.default_rng(2).uniform(0.5, 1.5, 40)
    finer = at_its_best("position_friction", 0.9, drop=drop)
    plain = at_its_best("coulomb", 0.9 * share, drop=share * drop)
    best = select_best(None, [finer, plain]).best  # type: ignore[arg-type]
    assert best is (plain if goes_first else finer)


@with_cases(
    "named, other, tie",
    ("viscous", "nonlinear_viscous", False),
    ("viscous", "coulomb", True),
    ("offset", "spring", False),
    ("offset", "drift", True),
    ("spring", "counterbalance", True),
    ("presliding", "stribeck", True),
)
def test_laws_that_every_joint_has_have_no_finer_rivals(named: str, other: str, tie: bool) -> None:
    drop = np.random.default_rng(3).uniform(0.5, 1.5, 40)
    best, alternative = (at_its_best(name, 0.9, drop=drop) for name in (named, other))
    nothing = RankedCandidates((), None)
    assert select_alternatives(best, [alternative], nothing) == ([alternative] if tie else [])


@pytest.mark.parametrize(
    ("gain", "share", "taken"), [(0.5, 0.49, True), (0.5, 0.3, False), (0.1, 0.05, True)]
)
def test_what_is_doubted_gives_way_to_a_rival_that_explains_as_much(gain, share, taken):
    doubted = dataclasses.replace(at_its_best("elasticity", gain), reason="too heavy")
    other = search.RankedCandidates((), at_its_best("spring", share))
    survey = SimpleNamespace(judge_candidates=lambda vetoed, tick: other)
    for judged, gives_way in ((doubted, taken), (dataclasses.replace(doubted, reason=""), False)):
        instead = search._choose_alternative(survey, [], judged, SimpleNamespace(), print)  # type: ignore[arg-type]
        assert instead is (other if gives_way else None)


def test_what_was_refused_is_told_once_the_best_first_with_its_reason() -> None:
    def at(effect_id: str, joint: str, gain: float, confirmed: bool = True) -> SimpleNamespace:
        one = SimpleNamespace(key=(effect_id, joint), effect=find_effect(effect_id))
        why = DRIVES if effect_id == "drift" else ""
        return SimpleNamespace(
            candidate=one, variance_reduction=gain, is_confirmed=confirmed, reason=why
        )

    vetoed = [at("spring", "1", 0.3), at("spring", "1", 0.5), at("drift", "2", 0.4)]
    vetoed.append(at("offset", "1", 0.8))  # named later
    ranked = [at("elasticity", "3", 0.7, confirmed=False), at("stribeck", "3", 0.9)]
    ranked.append(at("encoder_offset", "2", 0.6, confirmed=False))
    last, named = SimpleNamespace(ranked=ranked), SimpleNamespace(effect="offset", joint="1")
    steps = [SimpleNamespace(candidate=SimpleNamespace(key=("offset", "1")), score=None)]
    whole = SimpleNamespace(vetoed_candidates=vetoed, steps=steps, last=last)
    lines = describe_rejected(SimpleNamespace(search=whole, effects=(named,), refinements=()))  # type: ignore[arg-type]
    for line, (what, why) in zip(
        lines,
        (
            ("(encoder_offset), joint 2, explains 60 %", "errors of timing"),
            ("(spring), joint 1, explains 50 %", "motion left out"),
            ("(drift), joint 2, explains 40 %", "would drive"),
        ),
        strict=True,
    ):
        assert what in line and why in line


@pytest.mark.parametrize(
    ("after", "expected", "refused"),
    [(0.5, 0.9, False), (0.999, 0.04, True), (0.92, 0.9, True), (0.92, 0.3, False)],
)
def test_an_effect_keeps_on_other_motion_what_it_promises(monkeypatch, after, expected, refused):
    """Errors there without it are 1; a little falls by chance, or by what the effect is not."""
    change = ErrorChange("", 1.0, after, 5.0)
    monkeypatch.setattr(scoring, "find_affected_joints", lambda score, before, after: [0])
    monkeypatch.setattr(scoring, "compute_holdout_residuals", lambda state, other: state)
    monkeypatch.setattr(scoring, "compare_residuals", lambda *a: Score((change,), change))
    veto = scoring.make_veto("held out")  # type: ignore[arg-type]
    judged_at = SimpleNamespace(variance_reduction=expected, is_local=True)
    assert veto("before", "after", judged_at) is refused  # type: ignore[arg-type]
    chance = ErrorChange("", 1.0, after, 1.9)
    monkeypatch.setattr(scoring, "compare_residuals", lambda *a: Score((chance,), chance))
    assert veto("before", "after", judged_at), "no more than chance"  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("left", "certain", "text"), [(0.4, False, 0), (0.6, False, 1), (0.4, True, 1)]
)
def test_what_an_effect_explains_is_no_matter_of_the_channel(monkeypatch, left, certain, text):
    for name in ("_check_position_delay", "_describe_delay_shift", "describe_data_problems"):
        monkeypatch.setattr(messages, name, lambda *a: [])
    data = SimpleNamespace(observation=SimpleNamespace(report=SimpleNamespace(collect_notes=list)))
    start, end = (
        SimpleNamespace(residual=[np.full(10, size)], data=data, picks=()) for size in (1.0, left)
    )
    faults = [DataWarning("torque 1 is 0.7 times the predicted", certain, joint=0)]
    search = SimpleNamespace(start=start, end=end)
    assert len(messages.collect_warnings(None, search, None, faults)) == text  # type: ignore[arg-type]


def test_what_gave_way_is_a_tie_of_what_explains_as_much() -> None:
    refused = [
        dataclasses.replace(at_its_best(name, share), reason=why)
        for name, share, why in (
            ("counterbalance", 0.51, "no gravity"),
            ("elasticity", 0.9, "too heavy"),
            ("drift", 0.5, DRIVES),
            ("payload", 0.5, ""),
        )
    ]
    matches = search._find_displaced_candidates(refused, at_its_best("spring", 0.5))
    assert [judged.candidate.effect.id for judged in matches] == ["counterbalance"]


@pytest.mark.parametrize(("before", "now", "again"), [(0.5, 0.8, True), (0.5, 0.7, False)])
def test_a_veto_is_asked_again_where_an_effect_leaves_half_as_much(before, now, again):
    better = dataclasses.replace(at_its_best("spring", now))
    survey = CandidateScan(None, (), (better,))  # type: ignore[arg-type]
    mending = dataclasses.replace(at_its_best("stribeck", 0.2), values=-np.ones(1))
    refused = [at_its_best("spring", before), mending]
    stored = survey.list_still_refused(refused)
    assert (refused[0] not in stored) is again
    assert mending in stored, "what only mends a law stays refused"
