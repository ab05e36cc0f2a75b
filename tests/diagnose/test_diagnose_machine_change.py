"""Held-out logs of a machine that has changed: told, in what, and nothing is judged."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.sentences import lines
from modeler.observation import Log
from modeler.report import after_diagnosis
from tests.diagnose.conftest import Case, motion, nothing, on_joint, spring


def rubbing(log: Log, share: float) -> np.ndarray:
    """More friction of joint 2."""
    v = motion(log)[1][:, 1]
    return on_joint(log, 1, share * (3.0 * np.tanh(v / 0.002) + 2.0 * v))


CHANGES: dict[str, tuple[Callable[[Log], np.ndarray], set[str]]] = {
    "friction": (lambda log: rubbing(log, 1.0), {"Fs2", "Fv2"}),
    "less friction": (lambda log: rubbing(log, -0.4), {"Fs2", "Fv2"}),
    "bias": (lambda log: on_joint(log, 0, np.full(len(log.time), 2.0)), {"Off1"}),
}


@pytest.mark.parametrize("name", CHANGES)
def test_what_has_changed_is_told(case: Case, name: str) -> None:
    torque, moved = CHANGES[name]
    model, train, holdout = case.hidden(nothing)
    holdout = dataclasses.replace(holdout, tau=holdout.tau + torque(holdout), content="y")
    found = diagnose(model, case.compiled, [train], [holdout])
    assert {p.name for p in found.machine_changed} == moved, found.sentences
    assert found.verdict == "cannot tell" and "machine differs" in found.sentences[0]
    first = found.machine_changed[0]
    assert f"{first.name}: {first.before:.4g} +- " in "\n".join(lines(found))
    said = found.to_json()["machine_changed"][0]
    assert {"name", "before", "after", "sigma_before", "sigma_after", "unit"} <= set(said)
    assert not any("generate" in line for line in after_diagnosis("m", ["a"], ["b"], found))


def test_the_same_machine_has_not_changed(case: Case) -> None:
    assert case.found(nothing).machine_changed == ()
    assert case.found(spring).machine_changed == ()
