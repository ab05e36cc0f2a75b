"""Rows of energy: against a textbook's energies, against the power of the torques, and masked."""

import dataclasses

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.estimation.energy_fit import build_energy_rows, compute_weights, find_kinetic_columns
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.regression.observe import observe
from tests.modules import compiled
from tests.oracles.numpy_model import planar_arm
from tests.regression.motions import exact_log, some_beta
from tests.rotation import rotating, with_cases

SWING = {"sr400-tree": 0.4, "five-bar": 0.15, "wrist": 0.8, "two-link": 1.0}
BROAD = Processing(derivatives="log", position_cutoff=0.0, parallel_cutoff=10.0)


def log_of(name: str, rate: float, seconds: float = 1.0) -> Log:
    """Sines about home, exact derivatives, torques of ones."""
    model = compiled(name)
    joints = len(model.spec.joints)
    loops = model.spec.closure
    middle = np.zeros(joints) if loops is None else np.asarray(loops.home)[list(loops.actuated)]
    t = np.arange(round(seconds * rate) + 1) / rate
    w = 2 * np.pi * np.linspace(0.8, 1.7, joints)
    angle = t[:, None] * w + np.arange(joints)
    q, qd = middle + SWING[name] * np.sin(angle), SWING[name] * w * np.cos(angle)
    qdd = -SWING[name] * w**2 * np.sin(angle)
    beta = np.ones(len(model.spec.base))
    tau = model.base_regressor(q, qd, qdd) @ beta
    return Log(f"{rate:g} Hz", tuple(j.name for j in model.spec.joints), t, q, tau, qd, qdd)


def rows_of(name, rate, rule="simpson", window=0.1):
    model = compiled(name)
    return build_energy_rows(model, observe(model, [log_of(name, rate)], BROAD), window, rule)


@pytest.mark.parametrize("name", ["five-bar", *rotating("sr400-tree", "wrist")])
def test_work_of_inertia_is_a_difference_of_energies(name):
    """Newton-Euler's power, integrated, comes to the energies of M(q): h^4 by Simpson, h^2 else."""
    error = {}
    for rule in ("simpson", "trapezoid"):
        for rate in (200.0, 400.0):
            rows = rows_of(name, rate, rule)
            inertial = find_kinetic_columns(compiled(name))
            missed = np.linalg.norm((rows.W - rows.balance)[:, inertial])
            error[rule, rate] = missed / np.linalg.norm(rows.W[:, inertial])
            np.testing.assert_array_equal(rows.W[:, ~inertial], rows.balance[:, ~inertial])
    assert error["simpson", 200.0] < 2e-5 < error["trapezoid", 200.0] < 2e-2
    assert error["simpson", 200.0] / error["simpson", 400.0] == pytest.approx(16.0, rel=0.2)
    assert error["trapezoid", 200.0] / error["trapezoid", 400.0] == pytest.approx(4.0, rel=0.1)


def test_the_energies_are_those_of_a_textbook():
    """Planar arm with two links: kinetic and potential energy written out by hand."""
    spec = compiled("two-link").spec
    log = log_of("two-link", 200.0, 2.0)
    rows = build_energy_rows(compiled("two-link"), observe(compiled("two-link"), [log], BROAD), 0.2)
    at = np.searchsorted(log.time, rows.time - 1e-9)
    for name in ("ZZ2", "MX2", "MY2"):
        column = [base.name for base in spec.base].index(name)
        energy = textbook(name, log.q, log.qd, spec)
        change = energy[at[:, 1]] - energy[at[:, 0]]
        np.testing.assert_allclose(rows.W[:, column], change, atol=3e-6 * np.abs(change).max())


def textbook(name, q, qd, spec):
    """Energy of one unit of a parameter of link 2, whose origin is L1 from joint 1."""
    value = {symbol.name: symbol.value for symbol in spec.symbols}
    reach, g = value["L1"], value["g"]
    turn, total = qd.sum(axis=1), q.sum(axis=1)
    if name == "ZZ2":
        return 0.5 * turn**2
    s2, c2 = np.sin(q[:, 1]), np.cos(q[:, 1])
    across = c2 if name == "MX2" else -s2  # of the first moment, along the velocity of the origin
    height = np.sin(total) if name == "MX2" else np.cos(total)
    return reach * qd[:, 0] * turn * across + g * height


@pytest.mark.parametrize("rule", ["simpson", "trapezoid"])
def test_weights_integrate_cubics_or_lines(rule):
    t = np.linspace(0.0, 1.0, 7)
    w = compute_weights(6, t[1], rule)
    assert w @ np.ones(7) == pytest.approx(1.0) and w @ t == pytest.approx(0.5)
    assert (w @ t**3 == pytest.approx(0.25)) == (rule == "simpson")


@pytest.fixture(scope="module")
def arm():
    model = planar_arm()
    beta = some_beta(model)
    return model, beta, exact_log(model, beta, seconds=10)


def test_friction_and_offset_are_works_and_slow_rows_stay(arm):
    """Kinks at rest cancel: exact torques meet W beta to the quadrature of the inertia alone."""
    model, beta, log = arm
    seen = observe(model, [log])
    rows = build_energy_rows(model, seen)
    np.testing.assert_allclose(rows.W @ beta, rows.y, atol=2e-4 * np.abs(rows.y).max())
    np.testing.assert_allclose(rows.balance @ beta, rows.y, atol=1e-12 * np.abs(rows.y).max())
    assert seen.used.all(axis=1).sum() < len(rows.y)  # where a sign is doubtful, no torque row
    assert rows.window == pytest.approx(np.diff(seen.time)[0], abs=2 * log.step)
    assert np.all(np.diff(rows.time, axis=1) == pytest.approx(rows.window))


def test_a_missing_torque_costs_its_windows_only(arm):
    model, beta, log = arm
    tau = log.tau.copy()
    tau[700:703, 1] = np.nan
    whole = build_energy_rows(model, observe(model, [log]), 0.05)
    rows = build_energy_rows(model, observe(model, [dataclasses.replace(log, tau=tau)]), 0.05)
    assert 1 <= len(whole.y) - len(rows.y) <= 3
    lost = log.time[700], log.time[702]
    assert not np.any((rows.time[:, 0] <= lost[1]) & (rows.time[:, 1] >= lost[0]))
    assert len(set(rows.stretch)) == 2
    np.testing.assert_allclose(rows.W @ beta, rows.y, atol=2e-4 * np.abs(rows.y).max())


def test_an_empty_channel_or_a_robot_that_stands_leaves_no_window(arm):
    model, _, log = arm
    tau = np.column_stack([log.tau[:, 0], np.full(log.rows, np.nan)])
    seen = observe(model, [dataclasses.replace(log, tau=tau)])
    with pytest.raises(DataError, match=r"run: no window .* joint 2 has 0 % .*--model torque"):
        build_energy_rows(model, seen)
    still = dataclasses.replace(log, q=0.0 * log.q + 0.3, qd=0.0 * log.qd, qdd=0.0 * log.qdd)
    smooth = planar_arm(friction=False)
    with pytest.raises(DataError, match=r"run: the motors do no work in any window: no joint"):
        build_energy_rows(smooth, observe(smooth, [still]))


@with_cases(
    "window, text",
    (60.0, r"run: --window of 60 s is longer than the longest motion without a gap, 9.995 s"),
    (0.005, r"run: --window of 0.005 s; expected two samples or more, 0.01 s"),
    (-1.0, r"--window of -1 s; expected two samples"),
    (float("nan"), r"--window of nan s; expected two samples"),
)
def test_windows_that_cannot_be(arm, window, text):
    model, _, log = arm
    with pytest.raises(DataError, match=text):
        build_energy_rows(model, observe(model, [log]), window)
