"""Wrong drive gains, also by factors: the right joint, its value, and the same after adding."""

from collections.abc import Mapping

import numpy as np
import pytest

from modeler.diagnosis.add import add_effect, add_findings
from modeler.diagnosis.added_model import Logs
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.drive_gains import gain_visible
from modeler.diagnosis.result import Diagnosis
from modeler.observation.log import Log
from modeler.runtime.model import load
from tests.diagnose.conftest import Case, Torque


def logged(factors: Mapping[int, float]) -> Torque:
    """Torques of some joints logged so many times too large."""
    scale = np.ones(3)
    scale[[*factors]] = [*factors.values()]
    return lambda log: log.tau * (scale - 1.0)


def found(case: Case, factors: Mapping[int, float]) -> tuple[Diagnosis, dict[str, float], Logs]:
    """The diagnosis, its values of eps, and the logs; only true gains may be named."""
    model, train, holdout = case.hidden(logged(factors))
    diagnosis = diagnose(model, case.compiled, [train], [holdout])
    assert {(f.effect, f.joint) for f in diagnosis.effects} == {
        ("drive_gain", str(j + 1)) for j in factors
    }
    for j, factor in factors.items():
        finding = next(f for f in diagnosis.effects if f.joint == str(j + 1))
        name = f"eps{j + 1}"
        value, sigma = finding.parameters[name], finding.sigmas[name]
        assert abs(value - (1.0 - factor)) < 3.0 * sigma + 1e-3 * factor
        assert sigma < 0.01 * factor
        assert finding.objection == ""
    assert not any("torque is" in line for line in diagnosis.data)
    values = {k: v for f in diagnosis.effects for k, v in f.parameters.items()}
    return diagnosis, values, Logs([train], [holdout])


@pytest.mark.parametrize(
    ("joint", "factor"), [(0, 0.4), (0, 3.0), (1, 0.7), (1, 1.5), (1, 3.0), (2, 0.4), (2, 3.0)]
)
def test_one_wrong_gain_is_named_with_its_value(case: Case, joint: int, factor: float) -> None:
    """Where a fit bends most to it, that joint is described best, and others look wrong."""
    diagnosis, values, logs = found(case, {joint: factor})
    model = case.fitted(logs.fitted[0])
    better, left = add_findings(model, case.compiled, diagnosis.effects, logs)
    added = {p.name: p.value for p in better.fit.parameters}
    assert left == ()
    assert added[f"eps{joint + 1}"] == pytest.approx(values[f"eps{joint + 1}"], abs=3e-3 * factor)


@pytest.mark.parametrize("factors", [{1: 0.7, 2: 1.5}, {0: 3.0, 1: 0.7}])
def test_two_wrong_gains_are_put_in_together(case: Case, factors: dict[int, float]) -> None:
    """One alone would raise the error of other joints."""
    diagnosis, values, logs = found(case, factors)
    model = case.fitted(logs.fitted[0])
    better, left = add_findings(model, case.compiled, diagnosis.effects, logs)
    assert left == () and all(step.falls for step in better.history[1:])
    added = {p.name: p.value for p in better.fit.parameters}
    for name, value in values.items():
        assert added[name] == pytest.approx(value, abs=3e-3 * (1.0 + abs(value)))


def test_a_second_gain_mends_the_first_that_was_added(case: Case) -> None:
    """The first one's column was about a model that the second had bent."""
    _, values, logs = found(case, {0: 3.0, 1: 0.7})
    model, compiled = case.fitted(logs.fitted[0]), case.compiled
    for joint in ("1", "2"):
        model = add_effect(model, compiled, "drive_gain", joint, logs)
        compiled = load(model.spec, model.sources)
    added = {p.name: p.value for p in model.fit.parameters}
    for name, value in values.items():
        assert added[name] == pytest.approx(value, abs=0.01 * (1.0 + abs(value)))


def test_what_hides_a_gain_is_asked_with_the_weights_that_it_leaves(case: Case) -> None:
    """A bent fit describes joint 3 so well that its gain seems hidden."""
    diagnosis, _, _ = found(case, {2: 0.4})
    assert diagnosis.search.steps[0].judged.visible < 0.01
    assert gain_visible(diagnosis.search.end, 0) > 0.05


def test_a_torque_in_another_unit_is_a_matter_of_its_channel_still(case: Case) -> None:
    def millis(log: Log) -> np.ndarray:
        return logged({1: 1000.0})(log)

    model, train, holdout = case.hidden(millis)
    diagnosis = diagnose(model, case.compiled, [train], [holdout])
    said = [*diagnosis.data, *(f.objection for f in diagnosis.effects)]
    assert any("unit" in line for line in said)
