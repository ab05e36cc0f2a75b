"""Which velocity is taken: one that comes late or is noisier than that of the position is not."""

import dataclasses

import numpy as np
import pytest

from modeler.regression.consistency import check_derivatives, is_position_quieter
from modeler.regression.log import Log, split_log
from modeler.regression.motion import Processing
from modeler.regression.observe import observe
from modeler.regression.prepare import drop_speeds, prepare_logs
from modeler.regression.read import read_log
from tests.oracles.numpy_model import planar_arm
from tests.regression.motions import fourier, manifest_of, root_mean_square
from tests.rotation import rotating

ARM = planar_arm()


def drawn(random, rate, lags, joints=2):
    """A log whose velocities come late by `lags`, s, and the parameters of its torques."""
    t = np.arange(int(12.0 * rate)) / rate
    t, q, qd, qdd = fourier(random, t, joints, 1.2, (0.2, 0.8), slowest=0.2, falling=True)
    beta = random.uniform(0.5, 2.0, len(ARM.spec.base))
    tau = ARM.base_regressor(q, qd, qdd) @ beta if joints == 2 else 1.0 + q
    noisy = qd + 0.01 * np.std(qd, axis=0) * random.normal(size=qd.shape)
    late = np.column_stack([np.interp(t - lag, t, v) for lag, v in zip(lags, noisy.T, strict=True)])
    measured = np.round(q / 2e-4) * 2e-4
    names = tuple(str(j + 1) for j in range(joints))
    return Log("run", names, t, measured, tau, late), beta


def consistency_of(log, cutoff=5.0):
    pieces, _ = split_log(log, 0, True)
    return check_derivatives(log, pieces, cutoff)


@pytest.mark.parametrize(("rate", "joints"), [(100, 7), *rotating((1000, 2), (1000, 7))])
def test_the_late_joint_is_named_with_its_delay(rate, joints):
    """12 to 80 ms, drawn; three of each."""
    random = np.random.default_rng([rate, joints])
    for _ in range(3):
        j, lag = int(random.integers(joints)), random.uniform(0.012, 0.08)
        log, _ = drawn(random, rate, [lag * (k == j) for k in range(joints)], joints)
        result = consistency_of(log)
        (late,) = result.delays
        assert late.column == f"qd{j + 1}" and late.of == f"q{j + 1}"
        assert late.seconds == pytest.approx(lag, abs=max(0.1 * lag, 0.2 / rate))
        assert f"qd{j + 1} lags behind the derivative of q{j + 1} by 0.0" in result.notes[0]
        assert "and not all joints do" in result.notes[0]
        assert not np.concatenate(result.bad).any()


@pytest.mark.parametrize("joints", [1, 2, 7])
def test_velocities_in_time_are_believed(joints):
    random = np.random.default_rng(joints)
    for rate in (100, 250, 1000):
        log, _ = drawn(random, rate, [0.0] * joints, joints)
        assert consistency_of(log).delays == ()


def test_two_joints_late_by_different_times_are_told_apart():
    log, _ = drawn(np.random.default_rng(2), 500, [0.05, 0.0, 0.02, 0.0], 4)
    late = {one.column: one.seconds for one in consistency_of(log).delays}
    assert late == {"qd1": pytest.approx(0.05, abs=2e-3), "qd3": pytest.approx(0.02, abs=2e-3)}


def test_a_joint_that_reads_the_speed_backwards_is_not_called_late():
    log, _ = drawn(np.random.default_rng(3), 500, [0.0, 0.0])
    wrong = dataclasses.replace(log, qd=log.qd * [1.0, -1.0])
    pieces, _ = split_log(wrong, 0, True)
    assert check_derivatives(wrong, pieces, 5.0, refuse=False).delays == ()


@pytest.mark.parametrize("lags", [(0.0, 0.04), *rotating(((0.03, 0.03),))])
def test_late_velocities_are_not_used_where_they_do_harm(lags):
    """Positions are differentiated; with --derivatives log they are used too, and reported."""
    log, beta = drawn(np.random.default_rng(5), 500, lags)
    seen = observe(ARM, [log])
    (report,) = seen.report.logs
    assert report.derivatives == "qd and qdd by differentiating q, as logged derivatives come late"
    assert any("the positions are differentiated instead" in note for note in report.notes)
    assert report.contradicted == 0
    rows = observe(ARM, [log], Processing(derivatives="log"))
    (note,) = (note for note in rows.report.logs[0].notes if "lags behind" in note)
    assert "used as logged; fit with --derivatives position to avoid it" in note
    assert root_mean_square(rows, beta) > 5.0 * root_mean_square(seen, beta)


def test_a_small_delay_does_no_harm_and_the_velocities_are_used():
    """1.5 ms of motion below 2 Hz: 1 % of the speed."""
    log, _ = drawn(np.random.default_rng(6), 1000, (0.0015, 0.0015))
    quiet = dataclasses.replace(log, q=np.round(log.q / 1e-3) * 1e-3)
    (prepared,) = prepare_logs(ARM.spec, [quiet], Processing()).logs
    assert prepared.derivatives == "qd as logged, qdd from it"


@pytest.mark.measured
@pytest.mark.parametrize(
    ("folder", "joints"),
    [("panda", 7), *rotating(("ur10e", 6), ("dualarm7", 7), ("kinova_gen3", 7), ("dvrk_psm", 7))],
)
def test_only_the_panda_filters_its_velocities(measured_folder, folder, joints):
    """5 ms in all joints, from its controller's filter; reported, and small enough to use."""
    spec = manifest_of([str(j + 1) for j in range(joints)])
    for path in sorted((measured_folder / folder).glob("*.parquet")):
        late = consistency_of(read_log(path, spec), 10.0).delays
        if folder == "panda":
            (one,) = late
            assert one.column == "qd" and 0.004 < one.seconds < 0.007 and one.share < 0.02
        else:
            assert late == (), path.name


def piece(position_noise, velocity_noise):
    t, draw = np.arange(2000) * 0.002, np.random.default_rng(1).normal
    q = np.sin(2.0 * t) + position_noise * draw(size=len(t))
    qd = 2.0 * np.cos(2.0 * t) + velocity_noise * draw(size=len(t))
    return split_log(Log("run", ("1",), t, q[:, None], 1.0 + q[:, None], qd[:, None]), 0, True)[0][
        0
    ]


@pytest.mark.parametrize(
    ("position", "velocity", "taken"),
    [(1e-6, 1e-2, True), (1e-4, 1e-2, False), (1e-5, 1e-3, False), (1e-6, 1e-5, False)],
)
def test_the_position_is_differentiated_where_that_is_clearly_quieter(position, velocity, taken):
    """Noise s_q of the position is 2 pi f s_q / sqrt 3 = 181 s_q on the velocity."""
    one = piece(position, velocity)
    assert is_position_quieter([one], 50.0) is taken
    assert not is_position_quieter([drop_speeds(one)], 50.0) and not is_position_quieter([], 50.0)
