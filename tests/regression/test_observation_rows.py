"""The filters and the stacking: exact laws of y = W beta."""

import dataclasses

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from modeler.core.errors import DataError
from modeler.numerics.filters import apply_zero_phase_lowpass, build_row_filter
from modeler.regression.log import Log
from modeler.regression.motion import Processing, apply_low_pass
from modeler.regression.observe import observe
from modeler.regression.segments import find_shafts
from tests.oracles.numpy_model import NumpyModel, Row, planar_arm, rotor, slider
from tests.regression.motions import exact_log, motion, some_beta
from tests.rotation import rotating, with_cases


def row_filter(whole, step, cutoff, every):
    """A filter whose rows are so many samples apart, in the middle of what is whole."""
    inside = np.flatnonzero(whole)
    centres = inside[(len(inside) - 1) % every // 2 :: every]
    return build_row_filter(centres, len(whole), step, cutoff)


@pytest.mark.parametrize("cutoff", [0.0, 3.0])
def test_means_of_a_constant_and_a_line_are_themselves(cutoff):
    rows = row_filter(np.ones(400, dtype=bool), 0.01, cutoff, 4)
    usable = np.ones(400, dtype=bool)
    np.testing.assert_allclose(rows.average_samples(np.full(400, 3.0), usable), 3.0)
    inner = (rows.centres > 60) & (rows.centres < 340)
    np.testing.assert_allclose(
        rows.average_samples(np.arange(400.0), usable)[inner], rows.centres[inner], rtol=1e-12
    )
    assert np.all(np.diff(rows.centres) == 4)


def test_the_gain_is_minus_3_db_at_the_cutoff():
    t = np.arange(4000) / 1000.0
    for hertz, gain in ((10.0, np.sqrt(0.5)), (1.0, 0.9965), (40.0, 0.004)):
        rows = row_filter(np.ones(4000, dtype=bool), 1e-3, 10.0, 1)
        out = rows.average_samples(np.sin(2 * np.pi * hertz * t), np.ones(4000, dtype=bool))
        assert np.max(np.abs(out[500:3500])) == pytest.approx(gain, abs=0.005)


def test_masked_samples_have_no_influence_at_all():
    random = np.random.default_rng(3)
    values, usable = random.normal(size=(300, 2)), random.random(300) > 0.3
    rows = row_filter(np.ones(300, dtype=bool), 0.01, 5.0, 3)
    poisoned = np.where(usable[:, None], values, 1e12)
    np.testing.assert_allclose(
        rows.average_samples(values, usable), rows.average_samples(poisoned, usable), rtol=1e-12
    )


@pytest.mark.parametrize("cutoff", [0.0, 2.0, *rotating(30.0)])
def test_exact_motion_gives_exact_equations_whatever_the_filter(cutoff):
    model = planar_arm()
    beta = some_beta(model)
    seen = observe(model, [exact_log(model, beta)], Processing(parallel_cutoff=cutoff))
    assert len(seen.y) > 150
    np.testing.assert_allclose(seen.W @ beta, seen.y, atol=1e-11)
    np.testing.assert_allclose(seen.predict(beta), seen.torque, atol=1e-11)
    assert seen.report.logs[0].derivatives == "qd and qdd as logged"


def test_differentiated_positions_come_close():
    model = planar_arm()
    beta = some_beta(model)
    seen = observe(model, [exact_log(model, beta, logged=False, rate=1000, seconds=10)])
    assert np.linalg.norm(seen.W @ beta - seen.y) < 1e-3 * np.linalg.norm(seen.y)


def test_rows_know_their_joint_sample_and_log():
    model = planar_arm()
    beta = some_beta(model)
    logs = [exact_log(model, beta, "a"), exact_log(model, beta, "b", seed=9, seconds=10)]
    seen = observe(model, logs)
    assert seen.logs == ("a", "b") and set(seen.row_run) == {0, 1}
    order = seen.row_sample * 2 + seen.row_joint
    assert np.all(np.diff(order) > 0)
    for row in (0, 17, len(seen.y) - 1):
        sample, joint = seen.row_sample[row], seen.row_joint[row]
        assert seen.y[row] == seen.torque[sample, joint]
        np.testing.assert_array_equal(seen.W[row], seen.columns[sample, joint])
    assert np.all(np.diff(seen.time[seen.run == 1]) > 0)
    assert [log.samples for log in seen.report.logs] == [np.sum(seen.run == i) for i in (0, 1)]
    assert seen.names == tuple(base.name for base in model.spec.base)


def test_a_burst_on_masked_samples_does_not_reach_any_row():
    """Missing, saturated and slow samples: whatever stands there, the equations hold."""
    model = planar_arm()
    beta = some_beta(model)
    log = exact_log(model, beta)
    slow = np.abs(log.qd) < 0.019 * np.quantile(np.abs(log.qd), 0.98, axis=0)
    assert slow.sum() > 20
    tau = np.where(slow, 1e6, log.tau)
    tau[700:720, 1] = np.nan
    tau[1500:1530, 0] = 2.0 * np.nanmax(log.tau[:, 0])  # one long clip
    seen = observe(model, [dataclasses.replace(log, tau=np.where(tau == 1e6, 1.0, tau))])
    np.testing.assert_allclose(seen.W @ beta, seen.y, atol=1e-10)
    report = seen.report
    assert report.logs[0].saturated == {"1": 30}
    text = "\n".join(report.format_lines())
    assert "torque stuck at its limit in 30 rows" in text and "not used" in text
    rows = observe(model, [dataclasses.replace(log, tau=tau)], Processing(keep_saturated=True))
    assert np.max(np.abs(rows.W @ beta - rows.y)) > 1.0


def test_shafts_are_found_from_the_columns_alone():
    wrist = NumpyModel([Row(), Row(-np.pi / 2), Row(np.pi / 2)], coupling={2: (0.0, 1.0, 0.5)})
    table = {shaft.name: shaft for shaft in find_shafts(wrist)}
    assert set(table) == {"1", "2", "3", "2+3"}
    assert table["2"].joints == (1,) and table["2+3"].joints == (1, 2)
    ratio = table["2+3"].coefficients[2] / table["2+3"].coefficients[1]
    assert ratio == pytest.approx(0.5) and table["2+3"].coefficients[0] == 0.0
    assert find_shafts(planar_arm(friction=False)) == ()


def test_rows_are_masked_where_a_coupled_shaft_stands_still():
    wrist = NumpyModel([Row(), Row(-np.pi / 2), Row(np.pi / 2)], coupling={2: (0.0, 1.0, 1.0)})
    t, q, qd, qdd = motion(3)
    q[:, 2], qd[:, 2], qdd[:, 2] = -q[:, 1], -qd[:, 1], -qdd[:, 1]  # the shaft never turns
    log = Log("a", ("1", "2", "3"), t, q, np.ones_like(q), qd, qdd)
    seen = observe(wrist, [log])
    assert seen.used[:, 0].any() and not seen.used[:, 1:].any()
    assert seen.report.processing.speed_floors["2+3"] == float("inf")


def test_a_joint_that_never_moves_keeps_its_rows_and_has_no_friction():
    t, q, qd, qdd = motion(2)
    q[:, 1], qd[:, 1], qdd[:, 1] = 0.3, 0.0, 0.0
    log = Log("a", ("1", "2"), t, q, np.ones_like(q), qd, qdd)
    seen = observe(planar_arm(), [log])
    assert seen.used[:, 0].any() and seen.used[:, 1].all()
    assert any("rows; it never moves: its friction is" in row for row in seen.report.format_lines())
    friction = [k for k, name in enumerate(seen.names) if name.startswith("F") and name[-1] == "2"]
    assert friction and not seen.columns[..., friction].any()
    assert observe(planar_arm(friction=False), [log]).used.all()


def test_held_out_logs_are_treated_like_the_fitted_ones():
    model = rotor()
    beta = some_beta(model)
    seen = observe(model, [exact_log(model, beta)])
    held = exact_log(model, beta, seed=4)
    slower = dataclasses.replace(held, time=10.0 * held.time, qd=0.1 * held.qd, qdd=0.01 * held.qdd)
    again = observe(model, [slower], seen.report.processing)
    assert again.report.processing == seen.report.processing
    fresh = observe(model, [slower])
    assert fresh.report.joints[0].slow < again.report.joints[0].slow


def test_what_cannot_be_observed_is_refused():
    model = planar_arm()
    log = exact_log(model, some_beta(model), logged=False)
    with pytest.raises(DataError, match="no logs; give at least one"):
        observe(model, [])
    with pytest.raises(DataError, match="run: joints 1, 2; numpy_model has 1; read the log with"):
        observe(slider(), [log])
    with pytest.raises(DataError, match="no logged velocities qd1"):
        observe(model, [log], Processing(derivatives="log"))
    still = dataclasses.replace(log, q=np.zeros_like(log.q))
    with pytest.raises(DataError, match="run: no joint moves; expected a motion"):
        observe(model, [still])
    short = dataclasses.replace(log, time=log.time[:30], q=log.q[:30], tau=log.tau[:30])
    with pytest.raises(DataError, match=r"0\.\d+ s without a gap; expected more than 2 s"):
        observe(model, [short], Processing(edge=1.0))
    torn = dataclasses.replace(short, segment=np.arange(30.0))
    with pytest.raises(DataError, match="no uninterrupted motion"):
        observe(model, [torn])


@pytest.mark.parametrize("column", ["q", "qd", "tau"])
def test_values_that_no_robot_has_are_refused(column):
    arm = planar_arm()
    log = exact_log(arm, some_beta(arm))
    values = getattr(log, column).copy()
    values[50, 1] = -1e200
    with pytest.raises(DataError, match=rf"run: {column} of joint 2 is -1e\+200 at 0.25 s"):
        observe(arm, [dataclasses.replace(log, **{column: values})])


def lossy(model, missing, rate=1000):
    """A log whose q1 lacks the samples of `missing`, positions only, and its beta."""
    beta = some_beta(model)
    log = exact_log(model, beta, logged=False, rate=rate, seconds=10)
    q = log.q.copy()
    q[missing, 0] = np.nan
    return dataclasses.replace(log, q=q), beta


@pytest.mark.parametrize("run", [3, *rotating(1)])
def test_a_few_missing_positions_cost_only_themselves(run):
    """One loss in 160 rows at 1 kHz: the filter follows the motion across it."""
    arm = planar_arm()
    missing = np.add.outer(np.arange(100, 9900, 160), np.arange(run)).ravel()
    log, beta = lossy(arm, missing)
    whole = observe(arm, [lossy(arm, [])[0]])
    seen = observe(arm, [log])
    assert seen.used.sum() > 0.98 * whole.used.sum()
    error = np.abs(seen.y - seen.W @ beta)
    assert error.max() < 3e-3 * np.abs(seen.y).max()


def test_the_cause_of_no_rows_is_named():
    arm = planar_arm()
    tops = np.add.outer(np.arange(100, 9900, 100), np.arange(4)).ravel()
    log, _ = lossy(arm, tops)
    with pytest.raises(DataError, match=r"joint 2: 0 rows; .* % of its samples lie beside miss"):
        observe(arm, [log])
    exact = exact_log(arm, some_beta(arm))
    relay = np.clip(100.0 * np.sin(12.7 * exact.time), -1.0, 1.0)
    stuck = dataclasses.replace(exact, tau=np.column_stack([relay, relay]))
    with pytest.raises(DataError, match=r"joint 1: 0 rows; 9.* % of its samples have a torque at"):
        observe(arm, [stuck])
    fitted = observe(arm, [exact]).report.processing
    slow = dataclasses.replace(exact, time=1000.0 * exact.time, qd=None, notes=("is it ms?",))
    slow = dataclasses.replace(slow, qdd=None)
    with pytest.raises(DataError, match=r"Nyquist frequency of 0.1 Hz; .*run: is it ms"):
        observe(arm, [slow], fitted)
    words = r"masked below .* the time column is not in seconds.*run: is it ms"
    with pytest.raises(DataError, match=words):
        observe(arm, [slow], dataclasses.replace(fitted, position_cutoff=0.0))


@with_cases(
    "chosen, text",
    ({"parallel_cutoff": 1e-6}, r"--parallel-cutoff\) of 1e-06 Hz.* 20 s; expected more than"),
    ({"position_cutoff": 1e-300}, r"--cutoff\) of 1e-300 Hz.* 20 s; expected more than 0.05"),
    ({"decimation": 10**21}, r"--decimate\) from 4000 samples .* expected at most 2000"),
)
def test_a_filter_longer_than_the_log_is_refused_before_work(chosen, text):
    model = planar_arm()
    log = exact_log(model, some_beta(model), logged=False)
    with pytest.raises(DataError, match=text):
        observe(model, [log], Processing(**chosen))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("cutoff", [1e4, 1e300])
def test_a_filter_far_above_the_sampling_rate_is_none(cutoff):
    whole = np.ones(50, dtype=bool)
    rows = row_filter(whole, 0.01, cutoff, 1)
    np.testing.assert_array_equal(rows.weights.toarray(), np.eye(50))


# samples, cut-off in Hz, rate in Hz, padding, largest difference relative to the values
CASES = {
    "usual": (5000, 10.0, 1000.0, 200, 1e-11),
    "slow": (20_000, 0.5, 1000.0, 4000, 1e-9),
    "as far as it goes": (300, 0.05, 100.0, 299, 1e-9),
    "high": (1000, 400.0, 1000.0, 15, 1e-11),
    "beside Nyquist": (500, 499.0, 1000.0, 15, 1e-10),
    "few": (4, 20.0, 100.0, 3, 1e-11),
}


@pytest.mark.parametrize("case", CASES)
def test_it_is_that_of_scipy(case: str) -> None:
    samples, cutoff, rate, padding, bound = CASES[case]
    walk = np.random.default_rng(len(case)).normal(size=(samples, 3)).cumsum(axis=0) + 50.0
    theirs = sosfiltfilt(butter(4, cutoff, fs=rate, output="sos"), walk, axis=0, padlen=padding)
    ours = apply_zero_phase_lowpass(walk, 1.0 / rate, cutoff, padding)
    assert np.abs(ours - theirs).max() < bound * np.abs(walk).max()


def test_what_stands_still_stays() -> None:
    still = np.full((100, 2, 2), 3.25)
    assert (apply_low_pass(still, 1e-3, 20.0) == still).all()
    assert apply_low_pass(still, 1e-3, 0.0) is still
