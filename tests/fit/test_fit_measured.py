"""Fits of measured logs with automatic processing, against published and earlier figures."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from stand_in import Row, StandIn, rotor, slider

from modeler.fit import identify
from modeler.observation import observe, read_log

DATA = next(
    (p / "shared" / "data" for p in Path(__file__).resolve().parents
     if (p / "shared" / "data").is_dir()),
    None,
)  # fmt: skip
pytestmark = [
    pytest.mark.measured,
    pytest.mark.skipif(DATA is None, reason="no measured logs: shared/data is not beside us"),
]
QUARTER = np.pi / 2


def held_out_errors(model, training, held_out):
    """(n,) relative error per joint and overall, %, on logs that were not used; and the fit."""
    seen = observe(model, training)
    fit = identify(seen)
    held = observe(model, held_out, fit.processing)
    residual = np.where(held.used, held.torque - held.predicted(fit.beta), 0.0)
    torque = np.where(held.used, held.torque, 0.0)
    joints = 100 * np.linalg.norm(residual, axis=0) / np.linalg.norm(torque, axis=0)
    return joints, 100 * np.linalg.norm(residual) / np.linalg.norm(torque), fit


def logs(model, folder, *names):
    return [read_log(DATA / folder / f"{name}.parquet", model.spec) for name in names]


def test_emps_published_values():
    """Janot, Gautier, Brunot 2019: M 95.1, Fv 203.5, Fc 20.4, offset -3.16; errors 4.08, 5.98 %."""
    axis = slider()
    _, error, fit = held_out_errors(axis, logs(axis, "emps", "train"), logs(axis, "emps", "pulses"))
    values = {parameter.name[:-1]: parameter for parameter in fit.parameters}
    assert values["M"].value == pytest.approx(95.1, rel=0.005)
    assert values["Fv"].value == pytest.approx(203.5, rel=0.01)
    assert values["Fs"].value == pytest.approx(20.4, rel=0.01)
    assert values["Off"].value == pytest.approx(-3.16, rel=0.02)
    assert all(parameter.essential for parameter in fit.parameters)
    assert 100 * fit.relative_error < 3.96 and error < 5.63
    assert fit.processing.position_cutoff == pytest.approx(100.0, rel=0.2)
    assert fit.processing.parallel_cutoff == pytest.approx(16.0, rel=0.2)


def test_odrive_irregular_stamps():
    motor = rotor(gain=1.0)
    training = logs(motor, "odrive_cogging", "slow2__nocomp_0", "slow2__nocomp_1")
    _, error, _ = held_out_errors(motor, training, logs(motor, "odrive_cogging", "slow2__nocomp_2"))
    assert error < 93.5


def test_tx40_coupled_wrist():
    rows = [Row(), Row(-QUARTER), Row(0, 0.225, 0, 0.035), Row(QUARTER, 0, 0, 0.225),
            Row(-QUARTER), Row(QUARTER, 0, np.pi)]  # fmt: skip
    arm = StandIn(rows, coupling={5: (0, 0, 0, 0, 1, 1)})
    (log,) = logs(arm, "tx40", "log_joint")

    def part(start, stop):
        rows = (log.time >= start) & (log.time < stop)
        return [dataclasses.replace(log, time=log.time[rows], q=log.q[rows], tau=log.tau[rows])]

    joints, _, fit = held_out_errors(arm, part(0, 4.6), part(4.6, 7.45))
    assert np.all(joints < [7.3, 6.6, 12.9, 11.5, 22.1, 16.3])
    values = {parameter.name: parameter.value for parameter in fit.parameters}
    assert values["Fv1"] == pytest.approx(8.1, abs=0.2)
    assert values["Ia3"] == pytest.approx(0.0988, rel=0.1)


def test_ur10e_jitter_and_currents():
    rows = [Row(r=0.181), Row(QUARTER), Row(d=-0.613), Row(d=-0.571, r=0.174),
            Row(QUARTER, r=0.12), Row(-QUARTER, r=0.117)]  # fmt: skip
    arm = StandIn(rows, gains=(14.87, 13.26, 11.13, 10.62, 11.03, 11.47))
    training = logs(arm, "ur10e", "ur-20_02_19_14harm50sec", "ur-20_02_12-50sec_12harm",
                    "ur-20_02_05-20sec_8harm")  # fmt: skip
    held = logs(arm, "ur10e", "ur-20_02_19_15harm50sec", "ur-20_01_17-ptp_10_points")
    joints, _, _ = held_out_errors(arm, training, held)
    assert np.all(joints < [10.4, 3.3, 3.4, 7.2, 11.3, 18.3])


def kinova_errors(offsets):
    """% per joint on runs 2 and 4 of a fit on 1, 3 and 5, and overall."""
    alpha = [np.pi, QUARTER, -QUARTER, QUARTER, -QUARTER, QUARTER, -QUARTER]
    r = [-0.28481, -0.01175, -0.42076, -0.01275, -0.31436, -0.00035, -0.10593]
    arm = StandIn([Row(a, r=x) for a, x in zip(alpha, r, strict=True)], offsets=offsets)
    training = logs(arm, "kinova_gen3", "traj_1", "traj_3", "traj_5")
    held = logs(arm, "kinova_gen3", "traj_2", "traj_4")
    return held_out_errors(arm, training, held)[:2]


def test_kinova_short_segments():
    """Earlier plain script, offsets everywhere: 28.8 16.0 15.0 9.2 12.5 15.7 6.9 %."""
    joints, error = kinova_errors(offsets=(6,))
    assert np.all(joints < [15.0, 11.2, 15.8, 11.8, 9.4, 16.0, 6.2])
    assert error < 12.4


def test_kinova_offset_of_joint_1_does_not_carry_over():
    with_it, _ = kinova_errors(offsets=(0, 6))
    without, _ = kinova_errors(offsets=(6,))
    assert with_it[0] > 1.5 * without[0]
