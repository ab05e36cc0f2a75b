"""Link data keep inertias from standing in for a spring that balances gravity."""

import numpy as np
import pytest

from modeler.api import add, diagnose, read_logs
from modeler.diagnosis.add import add_findings
from modeler.diagnosis.added_model import LogSplit
from modeler.robot import parse_robot_text
from modeler.runtime.model import load_module
from modeler.simulation import HiddenEffect, SimulationSettings, simulate
from tests.chain import chain_of
from tests.link_data import buildable, links, text

NOMINAL = links(4)
BALANCE = HiddenEffect(
    "counterbalance",
    "2",
    {"lever": 0.12, "base": 0.3, "angle": 0.8, "length": 0.1, "stiffness": 6000.0},
)
LINE = "a counterbalance on joint 2 cannot be distinguished from gravity: give link data"


def fitted(values, seed, hidden=(), uncertainty=None):
    """A machine whose links are about the stated ones, its model, logs to fit and to judge on."""
    machine = buildable(0.1, np.random.default_rng(seed), NOMINAL)
    true = parse_robot_text(text(machine), "true")
    runs = [
        simulate(
            true,
            SimulationSettings(
                duration=seconds, rate=400.0, seed=seed + k, torque_noise=0.02, hidden=hidden
            ),
        )
        for k, seconds in enumerate((16.0, 10.0))
    ]
    return machine, chain_of(text(values, uncertainty)).fit(runs[:1]), runs[:1], runs[1:]


@pytest.mark.rotating("long tests of diagnose")
@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_with_link_data_a_counterbalance_is_named(seed):
    machine, model, *logs = fitted(NOMINAL, seed, (BALANCE,), {"inertial": 0.1})
    result = diagnose(model, *logs)
    assert (result.effects[0].effect, result.effects[0].joint) == ("counterbalance", "2")
    assert result.effects[0].error_after < 0.2 * result.effects[0].error_before
    assert not any(LINE in line for line in result.sentences)
    assert any("link 2: the data contradict" in line for line in model.fit.verdict.lines)
    compiled = load_module(model.spec, model.sources)
    read = LogSplit(*(read_logs(compiled, some) for some in logs))
    named, _ = add_findings(model, compiled, result.effects, read)
    for better in (add(model, "counterbalance", *logs, joint="2"), named):
        assert [step.effect for step in better.history] == ["", "counterbalance"]
        assert better.history[-1].is_improvement and not better.fit.prior_conflicts
        z = []
        for base, p in zip(better.spec.base, better.fit.parameters, strict=True):
            if all(term.parameter in machine for term in base.terms):
                truth = sum(term.value * machine[term.parameter] for term in base.terms)
                z.append((p.value - truth) / p.sigma)
        assert len(z) == 15 and np.sqrt(np.mean(np.square(z))) < 1.6
        assert max(p.prior for p in better.fit.parameters) > 0.2


@pytest.mark.rotating("diagnoses of simulated runs")
@pytest.mark.parametrize(
    ("values", "seed", "uncertainty"), [({}, 3, None), (NOMINAL, 5, {"inertial": 0.1})]
)
def test_a_true_machine_lacks_nothing_and_free_inertias_look_like_gravity(
    values, seed, uncertainty
):
    _, model, *logs = fitted(values, seed, (), uncertainty)
    result = diagnose(model, *logs)
    assert result.verdict == "nothing significant" and not model.fit.prior_conflicts
    assert any(line.startswith(LINE) for line in result.sentences) is (not values)
