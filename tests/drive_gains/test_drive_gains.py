"""Drive gains by mixed total least squares: against the likelihood, the truth, and real logs."""

import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import least_squares as nonlinear

from modeler.api import compile_model, derive, generate, load, read_currents
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import DataError
from modeler.estimation import Payload, check_known_quantities, describe_deviations
from modeler.estimation.drive_gains import identify_gains, solve_mixed_tls
from modeler.estimation.payload import find_heterogeneous_logs, separate_payload
from modeler.numerics.least_squares import compress_rows
from modeler.regression.observe import observe
from modeler.robot.edit import replace_drive_gains
from tests.drive_gains.runs import Runs, runs_of
from tests.rotation import slow_rotating

TRUE = np.array([1.2, 0.9, 25.0])  # N m per unit
ROWS = 400  # of each drive


@pytest.fixture(scope="module")
def arm() -> Runs:
    return runs_of("demo-arm", 2.0, duration=20.0, rate=250.0)


def drawn(seed, noise, units=1.0):
    """Rows of three drives with four parameters and a load of 1: W and V, as `solve_mixed_tls` "
    "has it."""
    rng = np.random.default_rng(seed)
    W = rng.normal(size=(3 * ROWS, 5)) * [1.0, 3.0, 0.2, 1.0, 2.0]
    W[: 2 * ROWS, 4] *= rng.integers(0, 2, 2 * ROWS)  # the load is carried in some rows
    joint = np.repeat(np.arange(3), ROWS)
    torque = W @ [1.0, -0.7, 2.0, 0.5, 1.0]
    torque += noise * np.array([1.0, 0.3, 2.0])[joint] * rng.normal(size=len(joint))
    return W, torque / TRUE[joint] / units, joint


def estimated(W, V, joint):
    return solve_mixed_tls(compress_rows(W, V, joint, 3, [*"abcd", "load"]), known=4)


def test_without_noise_gains_and_parameters_are_exact():
    fit = estimated(*drawn(1, 0.0))
    assert_allclose(fit.gains, TRUE, rtol=1e-9)
    assert_allclose(fit.beta, [1.0, -0.7, 2.0, 0.5, 1.0], rtol=1e-9)
    assert fit.gap > 1e6


def test_the_units_of_the_drives_do_not_matter_and_the_load_must_be_told():
    W, V, joint = drawn(2, 0.3)
    here, there = estimated(W, V, joint), estimated(W, V * np.array([1e4, 1.0, 1e-3])[joint], joint)
    assert_allclose(there.gains * [1e4, 1.0, 1e-3], here.gains, rtol=1e-7)
    assert_allclose(there.beta, here.beta, rtol=1e-7)
    assert_allclose(there.singular, here.singular, rtol=1e-6)
    W[:, 4] = W[:, 0] - W[:, 1]  # a column that others reproduce cannot set the scale
    assert estimated(W, V, joint) is None


def test_it_is_the_estimate_of_greatest_likelihood():
    """V = (W beta + w) / g + noise, solved by another program as the nonlinear problem it is."""
    W, V, joint = drawn(3, 0.3)
    fit = estimated(W, V, joint)
    spread = (fit.sigma / fit.gains)[joint]  # of V

    def residual(x):
        return (V - (W[:, :4] @ x[3:] + W[:, 4]) / x[joint]) / spread

    start = np.concatenate([TRUE, [1.0, -0.7, 2.0, 0.5]])
    other = nonlinear(residual, start, x_scale=np.abs(start), xtol=1e-14, ftol=1e-14, gtol=1e-12)
    sigma = np.sqrt(np.diag(fit.covariance))[:7]
    both = np.concatenate([fit.gains, fit.beta[:4]])
    assert np.all(np.abs(both - other.x) < 0.02 * sigma)  # degrees of freedom are counted nearly
    assert_allclose(sigma, np.sqrt(np.diag(np.linalg.inv(other.jac.T @ other.jac))), rtol=1e-3)


def test_standard_deviations_are_those_of_many_draws():
    z = []
    for seed in range(50):
        fit = estimated(*drawn(seed, 1.0))
        sigma = np.sqrt(np.diag(fit.covariance))[:7]
        z.append((np.append(fit.gains, fit.beta[:4]) - [*TRUE, 1.0, -0.7, 2.0, 0.5]) / sigma)
    rms = np.sqrt(np.mean(np.square(z), axis=0))
    assert np.all((rms > 0.8) & (rms < 1.2))
    assert np.all(np.abs(np.mean(z, axis=0)) < 0.35)
    assert estimated(*drawn(1, 1.0)).singular[-1] == pytest.approx(1.0, abs=0.02)


@slow_rotating("gains of drives")
def test_noisy_runs_of_an_arm_spread_as_the_sigmas_say(arm):
    gains, values = [], []
    for seed in range(25):
        fit = identify_gains(arm.compiled, arm.seen(TRUE, 0.03, seed), [arm.payload()]).result
        gains.append([(g.value - t) / g.sigma for g, t in zip(fit.gains, TRUE, strict=True)])
        values.append(
            [(p.value - t) / p.sigma for p, t in zip(fit.parameters, arm.beta, strict=True)]
        )
    assert np.sqrt(np.mean(np.square(gains))) == pytest.approx(1.0, abs=0.3)
    assert np.sqrt(np.mean(np.square(values))) == pytest.approx(1.0, abs=0.2)


@pytest.mark.rotating("long tests of drive_gains")
def test_gains_and_parameters_of_an_arm(arm):
    estimate = identify_gains(arm.compiled, arm.seen(TRUE), [arm.payload()])
    assert_allclose([*estimate.gains.values()], TRUE, rtol=0.01)
    fit = estimate.result
    assert [g.name for g in fit.gains] == ["g_tau1", "g_tau2", "g_tau3"]
    assert all(g.unit == "N m/unit" and 0.0 < g.sigma < 0.01 * g.value for g in fit.gains)
    assert fit.method == "tls" and fit.relative_error < 0.01
    assert fit.singular_values[-2] > 5.0 * fit.singular_values[-1]
    assert any("s[-2]/s[-1]" in line for line in fit.sentences)
    assert {"MX3_load", "XX3_load"} <= {p.name for p in fit.loads}


def test_parameters_do_not_depend_on_the_unit_of_the_currents(arm):
    """Nor on what is known beforehand of torques, which currents are not."""
    here, there = (
        identify_gains(arm.compiled, arm.seen(TRUE * unit), [arm.payload()]).result
        for unit in (1.0, 1e3)
    )
    assert_allclose(
        [p.value for p in there.parameters], [p.value for p in here.parameters], rtol=1e-6
    )


@pytest.mark.parametrize("factor", [0.95, pytest.param(1.05, marks=pytest.mark.rotating)])
def test_a_weight_that_contradicts_is_told_with_its_factor(arm, factor):
    """Gains are right, and the load is said to weigh so many times what it does."""
    seen = arm.seen(np.ones(3))
    (doubt,) = check_known_quantities(
        arm.compiled, seen, [arm.payload(factor * arm.mass)], currents=False
    )
    weighs, share, way = re.search(
        r"it weighs ([\d.]+) \+- [\d.]+ kg, ([\d.]+) % (more|less)", doubt.line
    ).groups()
    assert float(weighs) == pytest.approx(arm.mass, rel=0.01)
    assert float(share) == pytest.approx(abs(100.0 / factor - 100.0), abs=0.6)
    assert way == ("more" if factor < 1.0 else "less")
    assert doubt.affects_values and not doubt.is_certain
    assert f"the {factor * arm.mass:g} kg given" in doubt.line


def test_gains_of_the_file_that_contradict_are_told(arm):
    """All gains are taken for 1.05 times what they are."""
    weight, gains = check_known_quantities(
        arm.compiled, arm.seen(np.full(3, 1 / 1.05)), [arm.payload()], currents=True
    )
    assert " % more than the 2 kg given" in weight.line
    said = re.search(r"all drive gains are ([\d.]+) times what", weight.line)
    assert float(said[1]) == pytest.approx(1 / 1.05, rel=0.01)
    assert "the drive gains are not those of the robot file" in gains.line
    # one that is wrong is reported although the weight may agree
    one = arm.seen(np.array([1.0, 1.0, 1.05]))
    doubts = check_known_quantities(arm.compiled, one, [arm.payload()], currents=True)
    line = next(d.line for d in doubts if "not those of the robot file" in d.line)
    assert re.search(r"joint 3 1\.0(4[5-9]|5[0-4]?)", line)
    assert "joint 1" not in line and "joint 2" not in line


@pytest.mark.parametrize("noise", [0.005, pytest.param(0.05, marks=pytest.mark.rotating)])
def test_right_weights_and_gains_are_not_doubted(arm, noise):
    seen = arm.seen(np.ones(3), noise, 1)
    assert check_known_quantities(arm.compiled, seen, [arm.payload()], currents=True) == []


def test_logs_that_do_not_tell_the_gains_are_refused_with_the_figure(arm):
    with pytest.raises(DataError, match=r"no gap.*s\[-2\]/s\[-1\] = 1\.\d+, and noise alone"):
        identify_gains(arm.compiled, arm.seen(TRUE, noise=3.0), [arm.payload()])


def test_a_load_that_is_not_felt_sets_no_scale(arm):
    """The file says 0.01 kg was carried in a run without a load."""
    bare = arm.logs(TRUE, 0.02, 0)[0]
    seen = observe(arm.compiled, [bare, replace(arm.logs(TRUE, 0.02, 7)[0], name="loaded")])
    with pytest.raises(DataError, match=r"no gap|has an unbounded sigma"):
        identify_gains(arm.compiled, seen, [arm.payload(0.01)])


def test_logs_of_two_robots_are_named(arm):
    """The loaded run is of an arm with the base of this one, but other links and friction."""
    other = np.random.default_rng(1).uniform(0.5, 2.0, len(arm.beta)) * arm.beta
    seen = arm.seen(np.ones(3))
    rows = seen.run == 1
    seen.torque[rows] += seen.predict(other - arm.beta)[rows]
    words = "do not fit one robot: joint . has a fit error of .* % alone and .* % together"
    (doubt,) = check_known_quantities(arm.compiled, seen, [arm.payload()], currents=True)
    assert re.search(words, doubt.line)
    with pytest.raises(DataError, match=f"no gap.*{words}"):
        identify_gains(arm.compiled, seen, [arm.payload()])


def test_gains_are_not_found_without_a_known_mass_and_all_currents(arm):
    seen = arm.seen(TRUE)
    with pytest.raises(DataError, match="no load of known mass"):
        identify_gains(arm.compiled, seen, [Payload(("loaded",))])
    seen.torque[:, 1] = 0.0
    with pytest.raises(DataError, match="joint 2: the current is 0 in every row"):
        identify_gains(arm.compiled, seen, [arm.payload()])


@slow_rotating("gains of drives")
def test_a_real_arm_has_one_set_of_gains_and_a_load_that_was_turned(measured_folder):
    """UR10e: pairs of runs agree; both loaded runs together do not, until each has its own load."""
    folder = measured_folder / "ur10e"
    if not folder.is_dir():
        pytest.skip(f"NOT CHECKED: there is no {folder}")
    compiled = compile_model(generate(derive(load("ur10e"))))
    names = [f"ur-20_02_19_{n}harm50sec" for n in (14, 15)]
    places = [folder / f"{name}{end}.parquet" for end in ("", "Load") for name in names]
    logs = read_currents(compiled, places)
    alone = []
    for bare, loaded in ((0, 2), (1, 3)):
        payload = Payload((logs[loaded].name,), mass=2.805)
        seen = observe(compiled, [logs[bare], logs[loaded]])
        alone.append(identify_gains(compiled, seen, [payload]))
    for joint in compiled.spec.joints:
        a, b = (fit.gains[joint.name] for fit in alone)
        spread = np.hypot(*(fit.sigmas[joint.name] for fit in alone))
        assert abs(a - b) < 3.0 * spread
    both = Payload(tuple(log.name for log in logs[2:]), mass=2.805)
    seen = observe(compiled, logs)
    with pytest.raises(DataError, match=r"no gap.*disagree about where it sits: MY6"):
        identify_gains(compiled, seen, [both])
    result = identify_gains(compiled, seen, separate_payload(both)).result
    moments = {p.name: p.value for p in result.loads}
    assert moments["MY6_load1"] == pytest.approx(-moments["MY6_load2"], rel=0.1)
    assert moments["MZ6_load1"] == pytest.approx(moments["MZ6_load2"], rel=0.2)
    assert result.relative_error < 0.05


def test_a_load_that_sat_alike_is_not_said_to_have_moved(arm):
    first, second = arm.logs(np.ones(3), 0.02, 0)
    half = len(second.time) // 2
    parts = []
    for name, items in (("one", slice(None, half)), ("two", slice(half, None))):
        rows = {key: getattr(second, key)[items] for key in ("time", "q", "tau")}
        parts.append(replace(second, name=name, **rows))
    seen = observe(arm.compiled, [first, *parts])
    assert find_heterogeneous_logs(arm.compiled, seen, [Payload(("one", "two"))]) == []


@pytest.mark.rotating("long tests of drive_gains")
def test_a_robot_with_loops_carries_its_load_on_its_last_moving_row():
    """Not on that of the last coordinate, which the logs would call another robot."""
    arm = runs_of("five-bar", 2.0, duration=15.0, rate=250.0)
    assert check_known_quantities(arm.compiled, arm.seen(np.ones(2)), [arm.payload()], True) == []
    fit = identify_gains(arm.compiled, arm.seen(np.array([3.0, 0.2])), [arm.payload()])
    assert_allclose([*fit.gains.values()], [3.0, 0.2], rtol=0.01)


def test_gains_in_one_line_stay_there():
    text = read_builtin_robot("two-link")
    changed = replace_drive_gains("drive_gains = {1 = 3}\n" + text, {"1": 2.5})
    assert changed == "drive_gains = {1 = 2.5}\n" + text


@pytest.mark.parametrize("stated", [True, pytest.param(False, marks=pytest.mark.rotating)])
def test_a_negative_gain_is_called_negative(arm, stated):
    """The current of joint 2 is logged with the other sign."""
    fit = identify_gains(arm.compiled, arm.seen(TRUE * [1.0, -1.0, 1.0]), [arm.payload()])
    spec = arm.compiled.spec
    if not stated:
        spec = replace(spec, joints=tuple(replace(j, drive_gain=None) for j in spec.joints))
    (line,) = (line for line in describe_deviations(spec, fit) if line.startswith("joint 2 "))
    assert ("of the other sign than 1" if stated else "negative") in line
    assert "current2 or q2 has the wrong sign" in line and "sign = -1" in line
    assert "below" not in line and "%" not in line
