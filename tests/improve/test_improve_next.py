"""What `diagnose` says to do next can be done: no effect that `add` refuses, no words that fail."""

import shlex
from dataclasses import replace

import pytest

from modeler import views
from modeler.core.errors import DataError
from modeler.diagnosis.add import resolve_effect
from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.plausibility import find_caveat
from modeler.effects import CATALOGUE, Effect, EffectTarget, find_effect
from tests.diagnose.conftest import Case, spring


@pytest.mark.parametrize(
    "effect",
    [effect for effect in CATALOGUE if effect.acts is not EffectTarget.PASSIVE],
    ids=lambda effect: effect.id,
)
def test_what_is_suggested_can_be_added(case: Case, effect: Effect) -> None:
    """After a diagnosis that names one effect, on joint 3 if it is of a joint."""
    model, result = case.hidden(spring)[0], case.found(spring)
    (first,) = result.effects
    whole = (
        effect.acts in (EffectTarget.TORQUE, EffectTarget.GRAVITY, EffectTarget.WINDOW)
        or effect.is_on_last_link
    )
    candidate = Candidate(effect, effect.forms[0], None if whole else "3", 2)
    pick = replace(first.pick, candidate=candidate)
    one = replace(first, effect=effect.id, joint=candidate.joint, pick=pick)
    commands = views.suggest_after_diagnosis("m", ["a"], ["b"], replace(result, effects=(one,)))
    for _, command, _, *rest in map(shlex.split, commands):
        if command == "add":
            joint = rest[rest.index("--joint") + 1] if "--joint" in rest else None
            assert resolve_effect(model, rest[0], joint) is effect
        else:  # `add` would refuse it
            assert command == "compare"
            with pytest.raises(DataError):
                resolve_effect(model, effect.id, "3" if effect.acts is EffectTarget.JOINT else None)
    assert commands


def test_no_command_has_a_name_that_is_no_file(case: Case) -> None:
    fit = case.hidden(spring)[0].fit
    every = [
        *views.suggest_after_fit("m", ["a"], "r", fit),
        *views.suggest_after_add("m", ["a"], [], fit),
        *views.suggest_after_add("m", ["a"], ["b"], fit),
        *(
            views.suggest_after_compare("m", ["a"], ["b"], held, noise)
            for held in (0, 1)
            for noise in (0, 1)
        ),
    ]
    files = {"m", "a", "b", "r", "m_c", "compare.html", "diagnosis.html"}
    for line in every:
        words = shlex.split(line)[2:]
        assert {word for word in words if not word.startswith("--")} <= files, line


@pytest.mark.rotating("effects are added to simulated runs")
def test_what_is_printed_runs(arm, tmp_path, monkeypatch, run):
    monkeypatch.chdir(tmp_path)
    words = ("--duration", 10, "--rate", 200, "--seed", 4, "--out", "a.csv")
    assert run("simulate", "demo-arm", "--hide", "viscous@2", *words)[0] == 0
    _, out, _ = run("fit", "demo-arm", "a.csv", "--out", "m.json")
    for _ in range(2):
        following = [shlex.split(line)[2:] for line in out.splitlines() if line[:6] == "next: "]
        assert following
        out = ""
        for item in following:
            status, more, err = run(*item)
            assert (status, err) == (0, ""), item
            out += more


def test_a_tilt_keeps_gravity(case: Case) -> None:
    tilt, state = find_effect("base_tilt"), case.found(spring).search.end
    assert tilt is not None
    pick = Candidate(tilt, tilt.forms[0], None, -1)
    assert not find_caveat(state, pick, {"gx": 1.0, "gy": -0.9, "gz": 0.0})
    said = find_caveat(state, pick, {"gx": 7189.0, "gy": 1.0, "gz": 0.0})
    assert said.startswith("gravity would change by 7.19e+03 m/s^2")
