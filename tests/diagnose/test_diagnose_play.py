"""Play in a gear: when it is named, on which joint, and what is said beside it."""

from types import SimpleNamespace

import numpy as np
import pytest

from modeler.diagnosis import events as module
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.events import detect_events
from modeler.diagnosis.scoring import ErrorChange, Score
from modeler.effects.catalogue import CATALOGUE, find_effect
from modeler.views.evidence import draw_play_picture
from tests.diagnose.conftest import Case, motion, on_joint
from tests.rotation import with_cases

ERRORS = {"1": 0.05, "2": 0.05, "3": 0.05}


def falls(after):
    """What the column of play makes of an error of 5 %."""
    change = ErrorChange("", 0.05, after, 5.0)
    return lambda candidate: Score((change,), change)


def searched(monkeypatch, start, end, knocks=(0.0, 0.0, 0.0), columns=None):
    """A search over three joints: ratios of bursts before and after it, and impacts, by joint.

    Columns: (gain, share, ratio to its standard error) of play, by joint.
    """
    joints = [SimpleNamespace(name=str(j), actuated=True) for j in (1, 2, 3)]
    spec, names = SimpleNamespace(joints=joints), [joint.name for joint in joints]
    states = [SimpleNamespace(joint_names=names, ratios=ratios) for ratios in (start, end)]
    monkeypatch.setattr(module, "compute_burst_ratio", lambda state, j: state.ratios[j])
    monkeypatch.setattr(module, "compute_burst_share", lambda state, j: knocks[j])
    effect = find_effect("backlash")
    ranked = [
        SimpleNamespace(
            candidate=SimpleNamespace(effect=effect, index=j),
            variance_reduction=g,
            total_share=s,
            t_ratio=r,
        )
        for j, (g, s, r) in (columns or {}).items()
    ]
    ends = {"start": states[0], "end": states[1], "last": SimpleNamespace(ranked=ranked)}
    return SimpleNamespace(**ends, without=(), spec=spec, catalogue=CATALOGUE)


def column(effect, joint, gain, refines=False):
    left = 0.1 * (1.0 - gain) ** 0.5
    pick = SimpleNamespace(candidate=SimpleNamespace(effect=find_effect(effect)))
    return module.Finding(effect, joint, 0.1, left, {}, {}, {}, (), "", 1.0, refines, pick=pick)


def said(found, findings=()):
    every = detect_events(found, None, ERRORS, falls(0.04), list(findings))
    return [(f.effect, f.joint) for f in every if not f.is_refinement]


QUIET = (1.0, 1.0, 1.0)


@pytest.mark.parametrize("others", [(), (column("spring", "3", 0.9),)])
def test_bursts_name_play_alone_and_beside_others(monkeypatch, others):
    loud = (1.0, 12.0, 1.0)
    result = searched(monkeypatch, loud, loud)
    assert said(result, others) == [*((f.effect, f.joint) for f in others), ("backlash", "2")]
    assert said(searched(monkeypatch, QUIET, (1.0, 10.0, 1.0)), others) == [
        (f.effect, f.joint) for f in others
    ]


@with_cases(
    "ratio, column_of_play, beside, alone",
    (4.5, (0.1, 0.1, 8.0), False, True),
    (5.5, (0.1, 0.1, 8.0), True, True),
    (5.5, (0.015, 0.01, 8.0), False, False),
    (5.5, (0.1, 0.1, 4.0), False, False),
)
def test_faint_bursts_count_where_the_column_of_play_explains_something(
    monkeypatch, ratio, column_of_play, beside, alone
):
    result = searched(monkeypatch, QUIET, (1.0, ratio, 1.0), columns={1: column_of_play})
    assert (("backlash", "2") in said(result)) is alone
    assert (("backlash", "2") in said(result, [column("spring", "3", 0.9)])) is beside


def test_knocks_without_rule_are_a_description_at_most(monkeypatch):
    knocks, columns = (0.0, 0.9, 0.0), {1: (0.1, 0.1, 5.0)}
    result = searched(monkeypatch, QUIET, QUIET, knocks, columns)
    (play,) = detect_events(result, None, ERRORS, falls(0.04), [])
    assert (play.effect, play.joint) == ("backlash", "2")
    assert "do not follow the sign of the load" in play.caveat
    assert "90 % of the residual energy" in play.evidence
    rings = column("elasticity", "3", 0.9)
    assert said(result, [rings]) == [("elasticity", "3")], "what rings has impacts too"


def test_the_joint_bursts_most_and_its_column_describes_most(monkeypatch):
    loud = (14.0, 52.0, 30.0)
    columns = {0: (0.5, 0.25, 9.0), 1: (0.4, 0.22, 9.0), 2: (0.1, 0.0, 9.0)}
    result = searched(monkeypatch, loud, loud, columns=columns)
    (play,) = detect_events(result, None, ERRORS, falls(0.04), [])
    assert play.joint == "2"
    assert play.equivalents == (("backlash", "1"), ("backlash", "3"))


def test_play_whose_column_does_not_lower_the_error_is_no_fact(monkeypatch):
    """And what nobody knows is not reported as a number."""
    loud = (1.0, 52.0, 1.0)
    for columns, after in (({}, 0.04), ({1: (0.4, 0.2, 9.0)}, 0.05)):
        result = searched(monkeypatch, loud, loud, columns=columns)
        (play,) = detect_events(result, None, ERRORS, falls(after), [])
        assert not play.is_confirmed and "no column of play" in play.caveat
        assert play.error_before == 0.05 and np.isnan([play.error_after, play.gain]).all()
    (play,) = detect_events(result, None, ERRORS, falls(0.04), [])
    assert play.status == "confirmed" and (play.error_before, play.error_after) == (0.05, 0.04)
    assert "error 5 % -> 4 %" in play.evidence


@pytest.mark.parametrize(
    ("end", "effect", "joint", "weak"),
    [
        ((1.0, 40.0, 1.0), "elasticity", "3", "backlash"),  # which the impacts ring
        ((1.0, 1.0, 1.0), "presliding", "2", "backlash"),  # which hides play
    ],
)
def test_play_stands_where_a_weak_column_says_less(monkeypatch, end, effect, joint, weak):
    result = searched(monkeypatch, (1.0, 40.0, 1.0), end)
    assert said(result, [column(effect, joint, 0.2)]) == [(weak, "2")]
    assert said(result, [column(effect, joint, 0.9)])[0] == (effect, joint)


@pytest.mark.rotating("long tests of diagnose")
def test_play_is_found_beside_a_spring_in_simulated_runs(case: Case) -> None:
    """Joint 1 turns about the vertical: its load is inertia, and changes sign at top speed."""
    signs = np.random.default_rng(3).choice([-1.0, 1.0], 1000)

    def torque(log):
        q, v = motion(log)
        load = np.gradient(v[:, 0], log.time)
        turns = np.flatnonzero(np.diff(np.sign(load)) != 0)
        knocks = np.zeros(len(q))
        for turn, sign in zip(turns, signs[: len(turns)], strict=True):
            since = log.time[turn:] - log.time[turn]
            knocks[turn:] += 2.0 * sign * np.exp(-since / 0.03)
        return on_joint(log, 0, knocks) + on_joint(log, 2, 1.5 * q[:, 2])

    model, train, holdout = case.hidden(torque)
    result = diagnose(model, case.compiled, [train], [holdout])
    assert {(f.effect, f.joint) for f in result.effects} == {("backlash", "1"), ("spring", "3")}
    picture = draw_play_picture(result.search.end, 0)
    ((panel,),) = picture.panels
    means = panel.series[1]
    near, far = (means.y[(np.abs(means.x) < 0.05) == inside].mean() for inside in (True, False))
    assert near > 3.0 * far
