"""Values that halves of the motion tell differently: their sigmas hold what is missing."""

import numpy as np
import pytest

from modeler.api import observe
from modeler.cli import main
from modeler.estimation.identify import identify
from modeler.estimation.verdict import with_verdict
from modeler.simulation import SimulationSettings, hidden_from_text, simulate
from tests.modules import compiled, module

TOLD = "tell different"


def fitted(name, seed, hide=None, rate=500.0):
    """A fit, and the errors of its values in sigmas, by name."""
    hidden = () if hide is None else (hidden_from_text(hide),)
    made = simulate(
        module(name).model.robot,
        SimulationSettings(duration=12.0, rate=rate, seed=seed, hidden=hidden, parameter_seed=seed),
    )
    machine = compiled(name)
    observation = observe(machine, [made])
    fit = with_verdict(machine, observation, identify(observation))
    truth = made.truth.parameters
    errors = {}
    for base, found in zip(machine.spec.base, fit.parameters, strict=True):
        value = sum(term.value * truth.get(term.parameter, 0.0) for term in base.terms)
        errors[base.name] = abs(found.value - value) / found.sigma
    return fit, errors


# Without the halves, the worst friction value is this many sigmas off: 12.4, 11.2, 7.5.
BIASED = [
    ("demo-arm", 1, "load_friction"), ("demo-arm", 1, "position_friction"), ("emps", 1, "stribeck"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "seed", "effect"), BIASED)
def test_a_missing_effect_is_in_the_sigmas_of_what_carries_it(name, seed, effect):
    fit, errors = fitted(name, seed, effect)
    assert max(error for who, error in errors.items() if who.startswith("F")) < 4.0
    (told,) = (line for line in fit.sentences if TOLD in line)
    assert "`modeler diagnose`" in told


@pytest.mark.slow
def test_clean_logs_raise_no_alarm():
    """z of all values stays that of their sigmas."""
    z = []
    for name, seeds in (
        ("demo-arm", (20, 21)),
        ("emps", range(20, 24)),
        ("two-link", range(20, 24)),
    ):
        for seed in seeds:
            fit, errors = fitted(name, seed, rate=250.0)
            assert not [line for line in fit.sentences if TOLD in line]
            assert fit.verdict.valid_for == "parameters", fit.verdict.line
            z += errors.values()
    assert 0.6 < np.sqrt(np.mean(np.square(z))) < 1.4


def last(capsys, *words):
    assert main([str(word) for word in words]) == 0
    return capsys.readouterr().out.splitlines()


def test_the_terminal_ends_with_the_verdict_and_the_command_to_go_on_with(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    for name, words in (("good", ()), ("poor", ("--hide", "stribeck"))):
        last(capsys, "simulate", "emps", "--duration", 10, "--rate", 250, "--seed", 3,
             "--out", f"{name}.parquet", *words)  # fmt: skip
    *_, verdict, following = last(capsys, "fit", "emps", "good.parquet", "--out", "m.json",
                                  "--report", "m.html")  # fmt: skip
    assert verdict.startswith("Valid for torque prediction: ")
    assert following == "next: modeler compare m.json good.parquet --report compare.html"
    assert following.removeprefix("next: ") in (tmp_path / "m.html").read_text()
    *told, verdict, following = last(capsys, "fit", "emps", "poor.parquet", "--out", "p.json")
    assert verdict.startswith("Valid for torque prediction on similar motions only: ")
    assert following == "next: modeler diagnose p.json poor.parquet --report diagnosis.html"
    assert sum(line.startswith("parameter ") for line in told) == 1  # one table
    commands = (
        ("compare", "p.json", "poor.parquet"),
        ("diagnose", "p.json", "poor.parquet"),
        ("add", "p.json", "stribeck", "poor.parquet", "--out", "q.json"),
    )
    for words in commands:
        following = last(capsys, *words)[-1]
        assert following.startswith("next: modeler ") and words[0] not in following.split()[2]
