"""Inner states of effects along a motion: few lines of another kind, and the C step by step."""

import math

import numpy as np
import pytest

from modeler.api import derive, generate, load, own_effect
from modeler.observation.low_speed import signals_along, since_reversal
from modeler.robot.edit import with_effect
from modeler.robot.read import robot_from_text
from modeler.runtime.model import CompiledModel
from tests.modules import loaded

STEP = 0.002
TIME = STEP * np.arange(6000)
NOISE = 2e-5  # rad, of the positions


def moves(seed: int) -> tuple[np.ndarray, list[float]]:
    """A joint that goes forth, forth, back, forth, rests between and before; when it turned back.

    Rests between two ways forth are no reversal.
    """
    ways, q, at = [0.0, 0.5, 0.4, -0.7, 0.3], np.zeros(len(TIME)), 0.0
    turned, before = [], 0.0
    for k, way in enumerate(ways):
        begin, end = 2.3 * k, 2.3 * k + 1.6  # rests of 0.7 s
        x = np.clip((TIME - begin) / (end - begin), 0.0, 1.0)
        q = q + way * (x - np.sin(2.0 * np.pi * x) / (2.0 * np.pi))
        if way * before < 0.0:
            turned.append(begin)
        before, at = way or before, end
    assert at < TIME[-1]
    return q + NOISE * np.random.default_rng(seed).normal(size=len(q)), turned


@pytest.mark.parametrize("seed", range(3))
def test_since_counts_from_the_last_reversal_and_from_nothing_else(seed: int) -> None:
    q, turned = moves(seed)
    _, since = since_reversal(q, STEP, 3e-4)
    past = [max([0.0, *(at for at in turned if at <= t)]) for t in TIME]
    expected = TIME - past
    # it shows once the joint has come back by 0.2 mrad; the noise of its speed is then told from
    sure = expected > 0.1
    late = since[sure] - expected[sure]
    assert np.abs(late).max() < 0.06  # of a start that is slower than at constant acceleration
    assert since[0] == 0.0 and (since >= 0.0).all() and (since <= TIME + 1e-9).all()
    assert np.count_nonzero(np.diff(since) < 0.0) == len(turned)


def test_since_is_right_at_constant_acceleration() -> None:
    """Whatever the travel that shows it: q = a t |t| / 2."""
    t = np.arange(-500, 500) * 0.001 + 0.0004
    for acceleration, distance in ((1.0, 3e-4), (4.0, 1e-3), (0.3, 1e-4)):
        q = -0.5 * acceleration * t**2
        _, since = since_reversal(q, 0.001, distance)
        shown = t > math.sqrt(2.0 * distance / acceleration) + 0.002
        np.testing.assert_allclose(since[shown], t[shown], atol=0.002)


def test_a_joint_that_never_moves_has_not_turned() -> None:
    q = NOISE * np.random.default_rng(5).normal(size=len(TIME))
    np.testing.assert_allclose(since_reversal(q, STEP, 3e-4)[1], TIME)


def arm_with(name: str, shapes: dict[str, float], **definition: object) -> CompiledModel:
    """The demonstration arm with an effect on joint 2."""
    text = own_effect(load("demo-arm"), name, **definition).text
    return loaded(generate(derive(robot_from_text(with_effect(text, name, "2", shapes), name))))


def test_the_c_steps_what_logs_are_read_with() -> None:
    """From the state after the first reversal on: how a bristle starts is forgotten then."""
    compiled = arm_with("tired", {}, columns={"Kt": "v*exp(-since)"})
    assert [(s.kind, s.joint, s.unit) for s in compiled.spec.signals] == [
        ("direction", "2", "1"), ("since", "2", "s"),
    ]  # fmt: skip
    motion = np.zeros((3, len(TIME), 3))
    motion[0, :, 1] = moves(1)[0]
    read = signals_along(compiled, motion, TIME, lambda joint: TIME)
    assert read is not None
    s = np.zeros(2)
    stepped = [s]
    for dq in np.diff(motion[0], axis=0):
        stepped.append(s := compiled.advance(dq, STEP, s))
    later = TIME > 7.5
    np.testing.assert_allclose(np.array(stepped)[later], read[later], rtol=0, atol=1e-9)
