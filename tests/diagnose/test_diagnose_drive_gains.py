"""Wrong drive gains, also by factors: the right joint, its value, and the same after adding."""

from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest

from modeler.diagnosis.add import add_effect, add_findings
from modeler.diagnosis.added_model import LogSplit
from modeler.diagnosis.plausibility import compute_gain_visibility
from modeler.runtime.model import load_module
from tests.diagnose.conftest import Case, Torque
from tests.rotation import rotating

BOTH = (1.0, 0.7, 1.5)


@cache
def logged(*factors: float) -> Torque:
    """Torques of the joints logged so many times too large."""
    return lambda log: log.tau * (np.array(factors) - 1.0)


def eps_of(model, names) -> Mapping[str, float]:
    """Parameters of a model."""
    return {p.name: p.value for p in model.fit.parameters if p.name in names}


@pytest.mark.rotating("long tests of diagnose")
@pytest.mark.parametrize("factors", [BOTH, *rotating(((3, 1, 1),), ((1, 1, 0.4),))])
def test_wrong_gains_are_named_with_their_values_and_added(case: Case, factors) -> None:
    """Where a fit bends most to one, that joint is described best, and others look wrong.

    Of two, one alone would raise the error of other joints: they are put in together.
    """
    diagnosis = case.found(logged(*factors))
    wrong = {f"eps{j + 1}": factor for j, factor in enumerate(factors) if factor != 1.0}
    assert {(f.effect, f"eps{f.joint}") for f in diagnosis.effects} == {
        ("drive_gain", name) for name in wrong
    }
    for finding in diagnosis.effects:
        name = f"eps{finding.joint}"
        value, sigma = finding.parameters[name], finding.sigmas[name]
        assert abs(value - (1.0 - wrong[name])) < 3.0 * sigma + 1e-3 * wrong[name]
        assert sigma < 0.01 * wrong[name] and finding.caveat == ""
    assert not any("torque is" in line for line in diagnosis.data_warnings)
    model, train, holdout = case.hidden(logged(*factors))
    logs = LogSplit([train], [holdout])
    better, left = add_findings(model, case.compiled, diagnosis.effects, logs)
    assert left == () and all(step.is_improvement for step in better.history[1:])
    for f in diagnosis.effects:
        (name,) = f.parameters
        added = eps_of(better, [name])[name]
        assert added == pytest.approx(f.parameters[name], abs=3e-3 * (1.0 + wrong[name]))
    if factors == (1, 1, 0.4):
        # A bent fit describes joint 3 so well that its gain seems hidden.
        assert diagnosis.search.steps[0].score.visible_share < 0.01
        assert compute_gain_visibility(diagnosis.search.end, 0) > 0.05


@pytest.mark.rotating("diagnoses of simulated runs")
def test_a_second_gain_mends_the_first_that_was_added(case: Case) -> None:
    """The first one's column was about a model that the second had bent."""
    model, train, holdout = case.hidden(logged(*BOTH))
    compiled = case.compiled
    for joint in ("2", "3"):
        model = add_effect(model, compiled, "drive_gain", joint, LogSplit([train], [holdout]))
        compiled = load_module(model.spec, model.sources)
    added = eps_of(model, ["eps2", "eps3"])
    assert added == pytest.approx({"eps2": 0.3, "eps3": -0.5}, abs=0.01)
