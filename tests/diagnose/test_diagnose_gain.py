"""The gain of an effect is what its two printed errors imply, and nothing else."""

import math

import numpy as np
import pytest

from modeler.core.table import printed
from modeler.diagnosis.diagnosis import diagnose
from modeler.observation.log import Log
from tests.diagnose.conftest import Case, motion, on_joint, spring, two


def coupled(log: Log) -> np.ndarray:
    """Springs on two joints, friction on the third: what one explains is felt on others."""
    return two(log) + on_joint(log, 1, 2.0 * np.sin(2.0 * motion(log)[0][:, 1]))


def late(log: Log) -> np.ndarray:
    """A delay, and a push."""
    slope = np.gradient(log.tau, log.time, axis=0)
    push = np.where((log.time > 8.0) & (log.time < 9.0), 6.0, 0.0)
    return -0.004 * slope + on_joint(log, 0, push)


@pytest.mark.parametrize(("hidden", "held_out"), [(coupled, True), (late, False)])
def test_gain_is_computed_from_the_printed_errors(case: Case, hidden, held_out: bool) -> None:  # type: ignore[no-untyped-def]
    model, train, holdout = case.hidden(hidden)
    found = diagnose(model, case.compiled, [train], [holdout] if held_out else [])
    findings = [*found.effects, *found.refinements]
    assert findings
    told = found.to_json()
    for plain, finding in zip([*told["effects"], *told["refinements"]], findings, strict=True):
        before, after = plain["error_before"], plain["error_after"]
        assert math.isclose(plain["gain"], 1.0 - (after / before) ** 2, abs_tol=1e-12)
        numbers = printed(before, after)
        assert numbers[0] != numbers[1] and after < before
        assert " -> ".join(numbers) in finding.evidence


def test_an_effect_of_one_joint_has_the_errors_of_that_joint(case: Case) -> None:
    """Alone, they are those of the table of joints: same rows, same weights."""
    found = case.found(spring)
    (first,) = [*found.effects, *found.refinements]
    joint = found.joints["3"]
    assert first.error_before == pytest.approx(joint.error_before)
    assert first.error_after == pytest.approx(joint.error_after)
