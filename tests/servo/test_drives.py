"""[drives]: currents from duties, the same filter over both, and what is reported and refused."""

import numpy as np
import pytest

from modeler.api import compile_model, derive, generate, read_logs
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import DataError, RobotError
from modeler.estimation import check_currents
from modeler.regression import Processing, observe
from modeler.robot import parse_robot_text, replace_drive_gains
from tests.rotation import with_cases

VOLTAGE, RESISTANCE, K_E, GAIN = 11.1, 3.7, 0.9, 0.8
DRIVE = f"{{voltage = {VOLTAGE}, resistance = {RESISTANCE}, k_e = {K_E}, gain = {GAIN}}}"


def robot(drives, more=""):
    return parse_robot_text(
        f"{read_builtin_robot('two-link')}\n[drives]\n{drives}\n{more}", "arm.toml"
    )


def compiled(drives, more=""):
    return compile_model(generate(derive(robot(drives, more))))


BOTH = f"1 = {DRIVE}\n2 = {DRIVE}"


@pytest.fixture(scope="module")
def arm():
    return compiled(BOTH)


def motion(rate=200.0, seconds=6.0):
    rng = np.random.default_rng()
    t = np.arange(int(seconds * rate)) / rate
    w, phase = 2 * np.pi * rng.uniform(0.3, 0.9, (2, 3)), rng.uniform(0, 6, (2, 3))
    q = np.sin(w * t[:, None, None] + phase).sum(axis=2)
    qd = (w * np.cos(w * t[:, None, None] + phase)).sum(axis=2)
    tau = rng.normal(size=2) * q + rng.normal(size=2) * qd
    return t, q, qd, tau


def duty_of(tau, qd, voltage=VOLTAGE):
    """The share of the voltage of a motor that gives that torque at that speed."""
    return (tau / GAIN * RESISTANCE + K_E * qd) / voltage


def test_a_duty_gives_the_torque_that_the_motor_made(arm):
    t, q, qd, tau = motion()
    bands = Processing(position_cutoff=20.0, parallel_cutoff=8.0)
    rows = [
        observe(arm, read_logs(arm, [{"time": t, "q": q} | torques]), bands)
        for torques in ({"duty": duty_of(tau, qd)}, {"tau": tau})
    ]
    assert np.allclose(rows[0].torque, rows[1].torque, atol=1e-3 * np.abs(tau).max())


def test_the_voltage_of_the_log_goes_before_that_of_the_file(arm):
    t, q, qd, tau = motion()
    sagging = np.linspace(12.6, 9.9, len(t))
    columns = {"time": t, "q": q} | {
        f"{kind}{j + 1}": values
        for j in range(2)
        for kind, values in (("duty", duty_of(tau[:, j], qd[:, j], sagging)), ("voltage", sagging))
    }
    (log,) = read_logs(arm, [columns])
    assert np.allclose(log.tau - np.multiply(log.induced, qd), tau)
    assert log.torque_source[0].startswith("duty1 x voltage1 x ")
    assert "voltage1" not in log.extra


def test_torques_and_currents_go_before_duties(arm):
    t, q, qd, tau = motion()
    columns = {"time": t, "q": q, "duty": duty_of(tau, qd)}
    (log,) = read_logs(arm, [columns | {"current2": tau[:, 1], "tau1": tau[:, 0]}])
    assert np.allclose(log.tau, tau * [1.0, GAIN])
    assert log.induced == ()


def test_units_of_duties(arm):
    t, q, qd, tau = motion()
    duty = duty_of(tau, qd)
    columns = {"time": t, "q": q, "load_1": 1000 * duty[:, 0], "load_2": 1000 * duty[:, 1]}
    (log,) = read_logs(arm, [columns], ["duty<j>=load_{j}:0.1 %"])
    assert np.allclose(log.tau - np.multiply(log.induced, qd), tau)
    check_currents([log], arm.spec.joints)  # gains of duties can be sought
    with pytest.raises(DataError, match="is a share of the supply voltage"):
        read_logs(arm, [columns], ["duty<j>=load_{j}:mA"])
    percent = 80.0 * duty / np.abs(duty).max(axis=0)
    (log,) = read_logs(arm, [{"time": t, "q": q, "duty": percent}])
    assert "duty1 reaches 80: expected a share from -1 to 1; is it in %?" in log.notes[0]


def test_what_is_not_told_apart_is_told():
    arm = compiled(BOTH.replace(f", k_e = {K_E}", "", 1))
    t, q, qd, tau = motion()
    (log,) = read_logs(arm, [{"time": t, "q": q, "duty": duty_of(tau, qd)}])
    assert log.induced == (0.0, pytest.approx(GAIN * K_E / RESISTANCE))
    assert log.reading_notes[-1].startswith(
        "joint 1: without k_e in [drives], the back-EMF is part of"
    )


def test_a_duty_without_a_voltage_model_is_refused():
    arm = compiled(f"1 = {DRIVE}\n2 = {{gain = 2}}")
    t, q, qd, tau = motion()
    with pytest.raises(DataError, match=r"duty2 is a share of a voltage.* no voltage model for j"):
        read_logs(arm, [{"time": t, "q": q, "duty": duty_of(tau, qd)}])
    with pytest.raises(DataError, match="no column tau1 or current1 or duty1"):
        read_logs(arm, [{"time": t, "q": q}])


def test_gains_are_put_where_they_stand():
    alone = robot("1 = {gain = 2.5}\n2 = {gain = -3}")  # is what [drive_gains] says
    assert alone.drive_gains == {"1": 2.5, "2": -3.0} and not alone.drives
    text = robot(f"1 = {DRIVE}", "[drive_gains]\n2 = 3.0").text
    read = parse_robot_text(replace_drive_gains(text, {"1": 0.7, "2": 2.9}), "arm.toml")
    assert read.drive_gains == {"1": 0.7, "2": 2.9}
    assert read.drives == robot(f"1 = {DRIVE}").drives
    only = parse_robot_text(replace_drive_gains(robot(BOTH).text, {"1": 0.7, "2": 2.9}), "arm.toml")
    assert only.drive_gains == {"1": 0.7, "2": 2.9}
    assert "[drive_gains]" not in only.text


@with_cases(
    "drives, text",
    ("3 = {gain = 1}", 'there is no moving joint "3"'),
    ("1 = 2.0", "expected a table, as in [drives] 1 = {voltage"),
    ("1 = {gain = 1, ohm = 2}", 'unknown key "ohm"'),
    ("1 = {voltage = 12, resistance = 2}", "gain is missing; write joint torque per unit"),
    ("1 = {gain = 1, voltage = 12}", "resistance: got 0; expected a number above 0"),
    ("1 = {gain = 1, k_e = 2}", "voltage: got 0; expected a number above 0"),
    ("1 = {gain = 1, voltage = 9, resistance = 2, k_e = -1}", "k_e: got -1; expected the sign"),
    ("1 = {gain = nan}", "expected a finite number"),
    ("1 = {gain = 1}\n[drive_gains]\n1 = 2.0", "stands in [drive_gains] too"),
)
def test_what_is_refused(drives, text):
    with pytest.raises(RobotError) as caught:
        robot(drives)
    line = str(caught.value)
    assert text in line
    assert line.startswith("arm.toml: [drives]")
    assert "\n" not in line


def test_a_gain_beyond_what_a_motor_can_is_told():
    read = robot("1 = {voltage = 12, resistance = 2, k_e = 0.01, gain = 1}")
    assert "a gain of 1 is 100 times k_e" in read.readings[-1]
    assert not robot(BOTH).readings
