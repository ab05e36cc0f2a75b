"""Rows of one robot serve the same robot with other effects."""

import numpy as np

from modeler.diagnosis.add import add_effect
from modeler.diagnosis.added_model import Logs, rows_of
from modeler.observation.observation import model_torque
from modeler.runtime.model import load
from tests.diagnose.conftest import Case, spring


def test_rows_are_those_that_the_new_robot_would_make_itself(case: Case) -> None:
    model, train, holdout = case.hidden(spring)
    logs = Logs([train], [holdout])
    before = rows_of(case.compiled, logs, model.processing)
    better = add_effect(model, case.compiled, "spring", "3", logs)
    compiled = load(better.spec, better.sources)
    alike, fresh = before.of(compiled), rows_of(compiled, logs, model.processing)
    for ours, own in zip(alike.seen, fresh.seen, strict=True):
        np.testing.assert_array_equal(ours.W, own.W)
        np.testing.assert_array_equal(ours.y, own.y)
        assert (ours.names, ours.units, ours.joints) == (own.names, own.units, own.joints)
        assert ours.report == own.report


def test_the_inverse_dynamics_give_the_torque_of_the_columns(case: Case) -> None:
    model, train, _ = case.hidden(spring)
    seen = rows_of(case.compiled, Logs([train]), model.processing).fitted
    torque = model_torque(seen, case.compiled, model.beta)
    np.testing.assert_allclose(torque, seen.predicted(model.beta), atol=1e-9)
