"""Inner states of effects along a motion: few lines of another kind, and the C step by step."""

import math
from typing import Literal

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from modeler.api import derive, generate, load
from modeler.core.errors import ShapeError
from modeler.regression import segments
from modeler.robot.edit import replace_effects
from modeler.robot.read import parse_robot_text
from tests.effects.test_own_effects_in_c import REFERENCE, arm_with
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
    _, since = segments.compute_time_since_reversal(q, STEP, 3e-4)
    past = [max([0.0, *(at for at in turned if at <= t)]) for t in TIME]
    expected = TIME - past
    # it shows once the joint has come back by 0.2 mrad; the noise of its speed then differs from
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
        _, since = segments.compute_time_since_reversal(q, 0.001, distance)
        shown = t > math.sqrt(2.0 * distance / acceleration) + 0.002
        assert_allclose(since[shown], t[shown], atol=0.002)


def test_a_joint_that_never_moves_has_not_turned() -> None:
    q = NOISE * np.random.default_rng(5).normal(size=len(TIME))
    assert_allclose(segments.compute_time_since_reversal(q, STEP, 3e-4)[1], TIME)


def test_a_lag_is_the_solution_of_its_equation() -> None:
    """Of sin(w t), in closed form; a constant stays."""
    w, tau = 3.0, 0.7
    x = np.sin(w * TIME)
    left = w * tau * (np.exp(-TIME / tau) - np.cos(w * TIME))
    expected = (x + left) / (1.0 + (w * tau) ** 2)
    assert_allclose(segments.apply_lag(x, STEP, tau), expected, atol=2e-6)
    assert_allclose(segments.apply_lag(np.full(9, 2.5), STEP, tau), 2.5, rtol=1e-14)


FOLLOWED = "abs(v)**p + load*q3 - since + t*a1"
SHAPES = {"p": 1.5, "tau": 0.3, "t0": 0.5}


@pytest.mark.parametrize("precision", ["double", "single"])
def test_the_c_steps_lags_as_the_equations_say(precision: Literal["double", "single"]) -> None:
    """At random states, what is followed by numpy from the columns of the same C."""
    definition = {"columns": {"Kz": "z"}, "lag": FOLLOWED, "shapes": {"p": [1, 2], "tau": [0.1, 1]}}
    robot = arm_with("late", definition, SHAPES, reference=True)
    compiled = loaded(generate(derive(robot), precision=precision))
    kinds = ["time", "direction", "since", "followed", "lag"]
    assert [s.kind for s in compiled.spec.signals] == kinds
    rng = np.random.default_rng(17)
    q, v, a, dq = rng.uniform(-1.0, 1.0, (4, 30, 3))
    s = rng.uniform(0.1, 0.9, (30, 5))
    after = compiled.advance(dq, 0.02, s, q, v, a)
    chi = np.array([REFERENCE.get(p.name, 0.0) for p in compiled.spec.standard])
    pull = (compiled.regressor(q, v, a, s) @ chi)[:, 1]
    clock, since = s[:, 0] + 0.02, after[:, 2]
    x = np.abs(v[:, 1]) ** 1.5 + pull * q[:, 2] - since + (clock - 0.5) * a[:, 0]
    z = s[:, 4] + (1.0 - np.exp(-0.02 / 0.3)) * (0.5 * (x + s[:, 3]) - s[:, 4])
    exact = 1e-12 if precision == "double" else 2e-5
    assert_allclose(after[:, [0, 3, 4]], np.column_stack([clock, x, z]), rtol=exact, atol=exact)
    way = np.sign(s[:, 1] + dq[:, 1] / 3e-3)  # each of these steps is far longer than a reversal
    assert_allclose(after[:, 1], way)
    ago = np.minimum(
        s[:, 2] + 0.02, 0.04 * (1.0 + np.abs(dq[:, 1] / 3e-3 + s[:, 1])) / np.abs(dq[:, 1] / 3e-3)
    )
    assert_allclose(since, np.where(way < 0.0, ago, s[:, 2] + 0.02), rtol=1e-4)
    with pytest.raises(ShapeError, match="its effects have lags; give q, qd, qdd"):
        compiled.advance(dq[0], 0.02, s[0])

    # Along a motion: the log as it is read, and the C one sample after the other.
    time = 0.02 * np.arange(200)
    motion = np.stack([np.sin(time[:, None] * [1.0, 2.0, 3.0] + 0.1 * k) for k in range(3)])
    read = segments.compute_signals_along(compiled, motion, time, lambda joint: time)
    assert read is not None
    state = read[0]
    assert state[3] == state[4]  # steady at the start
    for k in range(1, len(time)):
        now = motion[:, k]
        state = compiled.advance(now[0] - motion[0, k - 1], 0.02, state, *now)
        assert_allclose(state, read[k], rtol=10 * exact, atol=10 * exact)


# Bristles and loops of cables: z' = (v - b |v| z - (1 - b) v |z|)/d, by scipy and by the C.


def strokes(time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Positions and speeds of a joint that turns back after short and long ways, and rests."""
    moving = np.clip(time - 0.2, 0.0, 2.5)
    q = 0.2 * np.sin(5.0 * moving) + 0.1 * np.sin(17.0 * moving)
    v = np.where((time > 0.2) & (time < 2.7), np.cos(5.0 * moving) + 1.7 * np.cos(17.0 * moving), 0)
    return q, v


@pytest.mark.parametrize(("share", "start"), [(1.0, 0.0), (0.5, -0.6), (0.7, 0.9), (0.2, 0.3)])
def test_a_loop_is_the_solution_of_its_equation(share: float, start: float) -> None:
    distance, time = 0.08, 0.001 * np.arange(3000)

    def rate(t: float, z: np.ndarray) -> np.ndarray:
        v = strokes(np.array([t]))[1]
        return (v - share * np.abs(v) * z - (1.0 - share) * v * np.abs(z)) / distance

    solved = solve_ivp(rate, (0.0, time[-1]), [start], "LSODA", time, rtol=1e-9, atol=1e-10)
    z = segments.compute_bristle_state(strokes(time)[0], distance, share, start)
    # a turn between two samples is seen at the next: 2 rad/s in half a millisecond over d, at most
    assert_allclose(z, solved.y[0], atol=5e-4)
    assert np.ptp(z) > 1.0


def with_cable(share: float, precision: Literal["double", "single"] = "double"):
    text = load("demo-arm").text
    text = text[: text.index("[parameters]")]
    cable = {"cable_hysteresis": [{"joint": "2", "d": 0.08, "b": share}]}
    robot = parse_robot_text(replace_effects(text, cable), "cable")
    return loaded(generate(derive(robot), precision=precision))


@pytest.mark.parametrize("share", [1.0, 0.5, 0.7, 0.2])
@pytest.mark.parametrize(
    "precision", ["double", pytest.param("single", marks=pytest.mark.rotating)]
)
def test_the_c_steps_a_loop_as_the_log_is_read(share: float, precision) -> None:
    """Sample by sample, at a constant speed of any size, at rest, and from either end."""
    compiled, exact = with_cable(share, precision), 1e-11 if precision == "double" else 2e-4
    (signal,) = compiled.spec.signals
    assert (signal.kind, signal.value, signal.share) == ("bouc_wen", 0.08, share)
    time = 0.002 * np.arange(1500)
    q = np.zeros((len(time), 3))
    q[:, 1] = strokes(time)[0]
    read = segments.compute_signals_along(compiled, (q, 0 * q, 0 * q), time, lambda joint: time)
    assert read is not None and read[0, 0] == 0.0
    state = read[0]
    for k in range(1, len(time)):
        state = compiled.advance(q[k] - q[k - 1], 0.002, state)
        assert_allclose(state, read[k], atol=exact)
    for start in (-1.0, -0.4, 0.0, 0.7, 1.0):
        for moved in (1e-9, -0.05, 0.4, -1e9, 1e9):
            ways = np.concatenate([[0.0], np.linspace(0.0, moved, 5)[1:]])
            along = segments.compute_bristle_state(ways, 0.08, share, start)
            once = compiled.advance([0.0, moved, 0.0], 0.002, [start])
            assert_allclose(once, along[-1], atol=exact)
        assert compiled.advance([1.0, 0.0, 1.0], 0.002, [start]) == pytest.approx(start, abs=1e-7)


@pytest.mark.parametrize("share", [1.0, 0.5, 0.3])
def test_a_state_counts_once_its_start_is_forgotten(share: float) -> None:
    """From there on no start makes more than 0.05 of a difference; and never much later."""
    q, distance = strokes(0.001 * np.arange(3000))[0], 0.02
    count = segments.count_unsettled_samples(q, distance, share)
    ends = [segments.compute_bristle_state(q, distance, share, z) for z in (-1.0, -0.3, 0.6, 1.0)]
    spread = np.ptp(ends, axis=0)
    assert 200 < count < 400 and spread[count - 1] > 0.05 and spread[count:].max() <= 0.05
    # One that is hardly forgotten at all costs a quarter of the travel at most.
    most, travel = segments.count_unsettled_samples(q, 5.0, share), np.abs(np.diff(q))
    assert 0.24 < travel[: most - 1].sum() / travel.sum() < 0.26
    assert segments.count_unsettled_samples(0.0 * q, distance, share) == 0
