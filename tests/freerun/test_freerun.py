"""A free run against what must come out: other physics, closed solutions, the definition."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from modeler.api import compile, load
from modeler.core.errors import DataError
from modeler.estimation.model_file import IdentifiedModel
from modeler.regression import Log, Processing
from modeler.regression.read import cut_rows
from modeler.robot import Robot, parse_robot_text, replace_effects
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate
from modeler.validation.forward_dynamics import (
    FittedPlant,
    compute_fit_percentage,
    compute_horizons,
)
from modeler.validation.free_run import (
    FreeRunSettings,
    RobotBatch,
    simulate_batch,
    simulate_free_run,
)
from modeler.validation.free_run_result import draw_free_run_pictures
from tests.chain import chain_of
from tests.rotation import ROTATING, slow_rotating

PENDULUM = """\
name = "pendulum"
title = "One link on a horizontal axis, q from the vertical"
gravity = [{up}, 0, 0]
effects = {{viscous = "all"}}
[mdh]
columns = ["j", "a", "sigma", "theta"]
rows = [["1", "0", 0, "q1"]]
"""
INERTIA, MOMENT, RUBS, G = 0.5, 0.6, 0.2, 9.81  # kg m^2, kg m, N m s/rad, m/s^2
STEP = 0.01  # s


@cache
def pendulum(stands: bool) -> tuple[IdentifiedModel, Log]:
    """The pendulum about the upright posture, or hanging, swung by 0.1 rad; nothing is noisy.

    I qdd + b qd -+ m l g sin q = tau, written down by hand.
    """
    robot = parse_robot_text(PENDULUM.format(up=-G if stands else G), "pendulum")
    time = np.arange(0.0, 2.0 * np.pi, STEP)  # whole periods of both sines
    q, qd, qdd = np.sum(
        [
            (a * np.sin(w * time), a * w * np.cos(w * time), -a * w**2 * np.sin(w * time))
            for a, w in ((0.06, 2.0), (0.04, 5.0))
        ],
        axis=0,
    )
    pull = MOMENT * G * np.sin(q) * (-1.0 if stands else 1.0)
    tau = INERTIA * qdd + RUBS * qd + pull
    log = Log("swing.parquet", ("1",), time, q[:, None], tau[:, None], qd[:, None], qdd[:, None])
    return fitted(robot, [log])[0], log


def fitted(robot: Robot, logs: list[Log]) -> tuple[IdentifiedModel, CompiledModel]:
    """A fit to logs, and the compiled robot."""
    chain = chain_of(robot)
    processing = Processing(position_cutoff=40.0, parallel_cutoff=8.0)
    return chain.fit(logs, processing, "ordinary"), chain.compiled


def with_values(model: IdentifiedModel, beta: np.ndarray) -> IdentifiedModel:
    """The model with other values."""
    parameters = tuple(
        replace(p, value=float(value)) for p, value in zip(model.fit.parameters, beta, strict=True)
    )
    return replace(model, fit=replace(model.fit, parameters=parameters))


def true_model(name: str | Robot, duration: float, **settings):
    """Model with the true values, compiled robot, log of the simulator with ideal sensors."""
    robot = name if isinstance(name, Robot) else load(name)
    actual = {"encoder_counts": 0, "torque_noise": 0.0, "rate": 500.0, "seed": 1} | settings
    made = simulate(robot, SimulationSettings(duration=duration, **actual))
    log = Log("run1.parquet", made.joints, made.time, made.q, made.tau, commanded=made.qc)
    model, compiled = fitted(robot, [log])
    chi = [made.truth.parameters[p.name] for p in compiled.spec.standard]
    return with_values(model, compiled.base_parameters(chi)), compiled, log


@pytest.fixture(scope="module")
def arm():
    """Two links with dry friction in a vertical plane: simulated by physics that are not ours."""
    return true_model("two-link", 5.0)


@pytest.fixture(scope="module")
def arm_run(arm):
    model, compiled, log = arm
    return simulate_free_run(model, [log], compiled)


@slow_rotating("long tests of freerun")
def test_the_true_values_give_the_simulated_motion(arm_run) -> None:
    """Within 0.5 % of the spread of positions, on joints that reverse and stick many times.

    What is left is the torque between samples, which no log has, grown by the arm's own nature.
    """
    for joint in arm_run.joints:
        assert joint.fit > 99.5 and joint.fit > joint.constant_speed_fit + 20.0
    assert arm_run.numerical < 2e-3


@slow_rotating("long tests of freerun")
@pytest.mark.parametrize(
    ("name", "share"), [("ZZ1R", 1.1), pytest.param("Fs1", 1.3, marks=ROTATING)]
)
def test_a_wrong_value_is_seen(arm, arm_run, name: str, share: float) -> None:
    """10 % more of the inertia that joint 1 turns, or 30 % more dry friction on it."""
    model, compiled, log = arm
    beta = model.beta.copy()
    beta[[p.name for p in model.fit.parameters].index(name)] *= share
    wrong = simulate_free_run(with_values(model, beta), [replace(log, commanded=None)], compiled)
    ours, theirs = wrong.joints[0], arm_run.joints[0]
    assert 100.0 - ours.fit > 4.0 * (100.0 - theirs.fit)
    assert wrong.stability.is_unstable == arm_run.stability.is_unstable


@pytest.fixture(scope="module")
def five_bar():
    """Its passive joints rub: directions of dry friction turn with the posture."""
    rubs = ["11", "21", "12", "22"]
    text = replace_effects(load("five-bar").text, {"viscous": rubs, "coulomb": rubs})
    return true_model(parse_robot_text(text, "five-bar that rubs"), 3.0)


@slow_rotating("free runs")
def test_loops_are_run_too(five_bar) -> None:
    model, compiled, log = five_bar
    bare = replace(log, commanded=None)
    run = simulate_free_run(model, [bare], compiled, FreeRunSettings(window=0.5))
    assert all(joint.fit > 99.0 for joint in run.joints)
    assert FittedPlant(compiled, model.beta).shafts == 4


@pytest.mark.rotating("free runs of simulated machines")
def test_a_loop_that_cannot_close_ends_a_run(five_bar) -> None:
    model, compiled, log = five_bar
    arm = FittedPlant(compiled, model.beta)
    q, far = log.q[:1], np.array([50.0, 50.0])
    tau = np.tile([400.0, -400.0], (1000, 1, 1))  # tears it apart
    path = simulate_batch(arm, RobotBatch(q, 0.0 * q, tau, None, 0.002, far, np.zeros_like(tau)), 1)
    assert np.isfinite(path[0]).all() and np.isnan(path[-1]).all()


@pytest.mark.parametrize("stands", [True, pytest.param(False, marks=pytest.mark.rotating)])
def test_the_rate_of_a_pendulum(stands: bool) -> None:
    """Upright, x'' = (m l g x - b x') / I: errors grow by the positive root; hanging they fade."""
    model, log = pendulum(stands)
    result = simulate_free_run(model, [log], compile(model)).stability
    pull = MOMENT * G / INERTIA * (1.0 if stands else -1.0)
    roots = np.roots([1.0, RUBS / INERTIA, -pull])
    assert result.rate == pytest.approx(roots.real.max(), rel=0.01)
    assert result.is_unstable == stands
    if stands:
        assert result.doubling_time == pytest.approx(np.log(2.0) / roots.real.max(), rel=0.01)
        assert result.describe().startswith("unstable by nature: along this motion any error doubl")
    else:
        assert result.doubling_time is None and result.describe().startswith("stable by nature")


@pytest.mark.rotating("free runs of simulated machines")
def test_errors_of_an_upright_pendulum_grow_at_that_rate() -> None:
    """Two runs that start 1e-6 rad apart, simulated."""
    model, log = pendulum(True)
    compiled = compile(model)
    plant = FittedPlant(compiled, model.beta)
    rate = simulate_free_run(model, [log], compiled).stability.rate
    q = np.array([[0.0], [1e-6]])
    tau, around = (np.repeat(values[:200, None], 2, axis=1) for values in (log.tau, log.q))
    lanes = RobotBatch(q, np.full((2, 1), log.qd[0, 0]), tau, None, STEP, np.ones(1), around)
    apart = np.log(np.diff(simulate_batch(plant, lanes, 1)[:, :, 0])[[100, 180], 0])
    assert (apart[1] - apart[0]) / 0.8 == pytest.approx(rate, rel=0.01)


def test_a_swinging_pendulum_of_order_2() -> None:
    """Against an integrator of order 8 on the equation as it stands in books."""
    model, _ = pendulum(False)
    plant = FittedPlant(compile(model), np.array([INERTIA, MOMENT, 0.0, RUBS]))
    assert [p.name for p in model.fit.parameters] == ["ZZ1", "MX1", "MY1", "Fv1"]
    time = np.arange(0.0, 2.0, 0.01)
    wave = np.sin(3.0 * time)

    def rate(t, x):
        tau = np.interp(t, time, wave)
        return x[1], (tau - RUBS * x[1] - MOMENT * G * np.sin(x[0])) / INERTIA

    truth = solve_ivp(rate, (0, time[-1]), [1.5, 0.0], "DOP853", time, rtol=1e-10, atol=1e-12).y[0]
    errors = []
    for inner in (2, 4, 8):
        lanes = RobotBatch(
            np.array([[1.5]]),
            np.zeros((1, 1)),
            wave[:, None, None],
            None,
            0.01,
            np.full(1, 9.0),
            np.zeros((200, 1, 1)),
        )
        errors.append(np.abs(simulate_batch(plant, lanes, inner)[:, 0, 0] - truth).max())
    assert errors[0] < 1e-3 and errors[0] > 3.0 * errors[1] > 9.0 * errors[2]


SLIDE = """\
name = "slide"
title = "A mass that rubs"
gravity = [0, 0, 0]
effects = {coulomb = "all"}
[mdh]
columns = ["j", "a", "sigma", "r"]
rows = [["1", "0", 1, "q1"]]
"""


@pytest.fixture(scope="module")
def slide():
    return true_model(parse_robot_text(SLIDE, "slide"), 2.4, rate=200.0)


def test_a_free_axis_is_neither_stable_nor_unstable_and_what_is_said_of_it(slide) -> None:
    """A mass that only rubs: no eigenvalue but 0."""
    model, compiled, log = slide
    run = simulate_free_run(model, [log], compiled)
    assert run.stability.rate == pytest.approx(0.0, abs=1e-6) and not run.stability.is_unstable
    assert "integrated twice" in run.stability.describe()
    text, raw = run.summary(), run.to_json()
    assert len(repr(run)) < 150 and "slide" in repr(run)
    assert "free run under the logged torques on run1.parquet: 2 windows of 1 s" in text
    assert set(raw["joints"]) == {"1"} and raw["joints"]["1"]["fit"] > 99.5
    row = next(line.split() for line in text.splitlines() if line.startswith("1 "))
    assert row[1:3] == [f"{raw['joints']['1']['fit']:.2f}", "%"]
    assert raw["stability"]["is_unstable"] is False
    (picture,) = draw_free_run_pictures(run)
    measured, simulated = picture.panels[0][0].series
    assert picture.name == "joint_1_free_run"
    assert np.nanmax(np.abs(measured.y - simulated.y)) < 0.05 * np.nanmax(np.abs(measured.y))
    assert run.controlled is not None and run.controlled.fit["1"] > 97.0
    assert "under a controller (nearest to the log" in text


def test_dry_friction_holds_lets_go_and_stops(slide) -> None:
    """m = 2 kg, Fs = 3 N: 2.9 N move nothing; 5 N for 1 s, then none: it slides on and stays."""
    model, compiled, _ = slide
    assert [p.name for p in model.fit.parameters] == ["M1", "Fs1"]
    plant = FittedPlant(compiled, np.array([2.0, 3.0]))
    tau = np.zeros((2500, 2, 1))
    tau[:, 0] = 2.9
    tau[:1000, 1] = 5.0
    start, around = np.zeros((2, 1)), np.zeros_like(tau)
    path = simulate_batch(
        plant, RobotBatch(start, start, tau, None, 0.001, np.full(1, 9.0), around), 1
    )[:, :, 0]
    assert not path[:, 0].any()
    reached = 0.5 * 1.0 + 1.0 / (2 * 1.5)  # 1 m/s^2 for 1 s, then 1.5 m/s^2 against it
    assert path[-1, 1] == pytest.approx(reached, rel=2e-3)
    assert np.ptp(path[1800:, 1]) == 0.0  # it stands from 1.67 s on, without chatter


def test_bristles_turn_as_in_the_c(slide) -> None:
    bristly = 'presliding = [{joint = "1", d = 0.01}]'
    robot = parse_robot_text(SLIDE.replace('coulomb = "all"', bristly), "slide")
    model, compiled = fitted(robot, [slide[2]])
    plant, s = FittedPlant(compiled, model.beta), np.array([0.3])
    for moved in (0.002, -0.004, 0.0, 0.03):
        way = np.sign(moved)
        expected = way + (s - way) * np.exp(-abs(moved) / 0.01)
        assert compiled.advance([moved], 0.002, s) == pytest.approx(expected, abs=1e-14)
        s = plant.advance_signals(s[None], np.array([[moved]]), 0.002, np.zeros((3, 1, 1)))[0]
        assert s == pytest.approx(expected, abs=1e-14)


def test_fit_percentage_is_that_of_matlab() -> None:
    """100 (1 - NRMSE): 100 for the same, 0 for the mean, below 0 for worse."""
    q = np.array([0.0, 1.0, 2.0, 1.0])
    assert compute_fit_percentage(q, q) == 100.0
    assert compute_fit_percentage(q, np.full(4, 1.0)) == pytest.approx(0.0)
    assert compute_fit_percentage(q, 2.0 - q) == pytest.approx(-100.0)
    assert compute_fit_percentage(np.ones(3), np.zeros(3)) is None
    assert compute_fit_percentage(q, np.array([0.0, 1.0, np.nan, np.nan])) < 0.0

    # and how long a run is near
    error = np.array([[0.0, 0.0], [0.1, 0.3], [0.3, np.nan]])[:, None, :]
    assert compute_horizons(error, np.array([0.2, 0.2]), 0.5).tolist() == [[1.0, 0.5]]
    assert compute_horizons(error[:2], np.array([0.2, 0.4]), 0.5).tolist() == [[np.inf, np.inf]]


@slow_rotating("long tests of freerun")
def test_under_a_controller(arm_run) -> None:
    """The simulated controller is not one of ours; the nearest still explains its errors."""
    under = arm_run.controlled
    assert under is not None and not under.has_given_gains
    assert all(fit > 99.8 for fit in under.fit.values())
    assert all(20.0 < share <= 100.0 for share in under.tracking.values())
    assert all(fit > 95.0 for fit in under.torque.values())
    assert "under a controller (nearest to the log" in arm_run.summary()


@pytest.mark.rotating("free runs of simulated machines")
def test_given_gains_are_used(slide) -> None:
    model, compiled, log = slide
    settings = FreeRunSettings(gains=(8.0, 0.5, 0.0, 0.0))
    log = cut_rows(log, slice(0, 250))
    run = simulate_free_run(model, [log], compiled, settings)
    assert run.controlled is not None and run.controlled.has_given_gains
    assert run.to_json()["controller"]["speed"] == pytest.approx(8.0)
    bare = replace(log, commanded=None)
    with pytest.raises(DataError, match=r"--controller: run1.parquet: no complete columns qc1"):
        simulate_free_run(model, [bare], compiled, settings)


@pytest.mark.rotating("free runs of simulated machines")
def test_a_joint_that_stands_still_is_not_judged(arm) -> None:
    model, compiled, log = arm
    q, tau = log.q.copy(), log.tau.copy()
    q[:, 1] = 0.3
    still = replace(log, q=q, tau=tau, commanded=None)
    run = simulate_free_run(model, [still], compiled)
    assert run.joints[1].fit is None and "still" in run.summary()


@pytest.mark.parametrize("asked", [{"window": 0.0}, {"window": np.nan}, {"bound": -0.1}])
def test_what_cannot_be_is_refused(slide, asked) -> None:
    model, compiled, log = slide
    ((name, value),) = asked.items()
    with pytest.raises(DataError, match=f"--{name}: got {value:g}; expected a number above 0"):
        simulate_free_run(model, [log], compiled, FreeRunSettings(**asked))


@pytest.mark.rotating("free runs of simulated machines")
def test_values_without_inertia_and_gains_that_lose_the_robot_are_refused(arm) -> None:
    model, compiled, log = arm
    words = "is not positive definite in 100 % of the postures, most a"
    with pytest.raises(DataError, match=words):
        simulate_free_run(with_values(model, -model.beta), [log], compiled)
    with pytest.raises(DataError, match="--controller: with these gains two-link is lost"):
        simulate_free_run(model, [log], compiled, FreeRunSettings(gains=(60.0, 9.0, 9.0, 0.0)))


@pytest.mark.rotating("free runs of simulated machines")
def test_an_error_that_grows_by_nature_is_not_blamed_on_the_model() -> None:
    """True values, an upright pendulum: the run is lost, and the reason is reported."""
    model, log = pendulum(True)
    run = simulate_free_run(model, [log], compile(model), FreeRunSettings(window=2.0))
    assert run.joints[0].whole_run_fit < 90.0 and run.stability.is_unstable
    assert any(
        "an error grows tenfold and more by nature; `--window 0.3`" in d for d in run.warnings
    )
