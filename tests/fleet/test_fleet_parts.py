"""The parts of a fleet's judgement against what is known of them otherwise."""

import numpy as np
import pytest
from scipy.special import stdtrit

from modeler.estimation.least_squares import solve_least_squares
from modeler.regression.observe import observe
from modeler.validation import fleet_drift as drift
from modeler.validation.fleet_drift import (
    PeriodSeries,
    estimate_scatters,
    find_outlying_machines,
    fit_drift,
)
from modeler.validation.fleet_logs import GAIN, LOAD, build_layout, fit_fleet
from tests.fleet.machines import PROCESSING, Scene, compiled, emitted, logs, parameters, summaries

ROSNER = """
-0.25 0.68 0.94 1.15 1.20 1.26 1.26 1.34 1.38 1.43 1.49 1.49 1.55 1.56 1.58 1.65 1.69 1.70 1.76 1.77
1.81 1.91 1.94 1.96 1.99 2.06 2.09 2.10 2.14 2.15 2.23 2.24 2.26 2.35 2.37 2.40 2.47 2.54 2.62 2.64
2.90 2.92 2.92 2.93 3.21 3.26 3.30 3.59 3.68 4.30 4.64 5.34 5.42 6.01
"""
"""Rosner 1983, as reprinted in the NIST/SEMATECH e-Handbook, section 1.3.5.17.3."""


def test_critical_values_are_those_of_the_handbook() -> None:
    printed = [3.159, 3.151, 3.144, 3.136, 3.128, 3.120, 3.112, 3.103, 3.094, 3.085]
    values = [drift.compute_critical_deviate(54, i, 0.05) for i in range(1, 11)]
    assert np.allclose(values, printed, atol=1.1e-3)


def test_the_largest_of_rosners_data_are_odd() -> None:
    """His three at 5 %, reported here where each step gets all of the 5 %: three steps, 15 %."""
    data = np.array(list(map(float, ROSNER.split())))
    matches = find_outlying_machines(data, np.full(54, 1e-3), 0.15)
    assert sorted(data[odd.machine] for odd in matches) == [5.34, 5.42, 6.01]


def test_alike_machines_are_rarely_odd_and_a_far_one_is() -> None:
    rng = np.random.default_rng(5)
    for machines in (5, 12, 20):
        sigmas = np.full(machines, 0.01)
        alarms = sum(
            bool(find_outlying_machines(rng.normal(size=machines), sigmas, 0.05))
            for _ in range(600)
        )
        assert alarms / 600 < 0.05 + 3.0 * np.sqrt(0.05 / 600)
    two = rng.normal(size=20) + np.where(np.arange(20) < 2, 15.0, 0.0)
    assert {odd.machine for odd in find_outlying_machines(two, np.full(20, 0.01), 0.001)} == {0, 1}
    assert not find_outlying_machines(
        two, np.full(20, 10.0), 0.001
    )  # explained by what they are known to
    assert not find_outlying_machines(np.array([0.0, 0.1, 0.2, 50.0]), np.full(4, 0.01), 0.05)


def test_a_quantile_is_students() -> None:
    assert drift.compute_quantile(7.0, 0.01) == pytest.approx(stdtrit(7.0, 0.995))


def series(rng: np.random.Generator, extra: float, plan: np.ndarray) -> PeriodSeries:
    sigmas = np.exp(0.3 * rng.normal(size=len(plan)))
    values = plan + rng.normal(size=len(plan)) * np.hypot(sigmas, extra)
    return PeriodSeries(np.arange(len(plan), dtype=float), values, sigmas)


@pytest.mark.parametrize("extra", [(0.0,), (2.0,), (0.0, 0.0, 5.0)])
def test_series_that_stay_are_rarely_told(extra: tuple[float, ...]) -> None:
    """All of a fleet of 3 machines, 5 periods, 12 quantities at 5 %, whatever scatters."""
    alarms = 0
    for seed in range(60):
        rng = np.random.default_rng([3, seed])
        groups = [
            [series(rng, extra[i % len(extra)], np.zeros(5)) for _ in range(3)] for i in range(12)
        ]
        fit = estimate_scatters(groups)
        chances = [
            move.chance
            for group, scatter in zip(groups, fit, strict=True)
            for each in group
            if (move := fit_drift(each, scatter)) is not None
        ]
        alarms += min(chances) < 0.05 / 36
    assert alarms <= 3 + 4  # 5 % of 60, and two standard deviations and more


def test_what_a_series_does_is_told() -> None:
    rng = np.random.default_rng(8)
    still = [series(rng, 0.0, np.zeros(8)) for _ in range(6)]
    plans = {
        "trend": np.linspace(0.0, 30.0, 8),
        "jump": np.where(np.arange(8) >= 3, 25.0, 0.0),
        "one period": np.where(np.arange(8) == 4, -25.0, 0.0),
    }
    for shape, plan in plans.items():
        local = series(rng, 0.0, plan)
        [scatter] = estimate_scatters([[local, *still]])
        move = fit_drift(local, scatter)
        assert move is not None and move.shape == shape and move.chance < 1e-6
        assert abs(move.change) == pytest.approx(np.abs(plan).max(), abs=4.0 * move.sigma)
        assert move.begin == {"trend": 0, "jump": 3, "one period": 4}[shape]
        text = drift.compute_smallest_detectable(local, scatter, 1e-3)
        assert 3.0 < text < 30.0
    assert fit_drift(PeriodSeries(np.zeros(1), np.zeros(1), np.ones(1)), scatter) is None


def test_common_parameters_are_those_of_one_large_least_squares() -> None:
    """All rows of all logs in one matrix: theta in common, a block of friction for each log."""
    model, scene = compiled(), Scene(machines=2, periods=2, noise=0.01)
    reduced = summaries(scene, 4)
    layout = build_layout(model.spec)
    drifting, common = layout.drift_columns, np.flatnonzero(layout.common)
    blocks, sides = [], []
    for k, (_, log) in enumerate(logs(scene, 4)):
        seen = observe(model, [log], reduced[0].processing or PROCESSING)
        weight = 1.0 / solve_least_squares(reduced[k].data).sigma[seen.row_joint]
        actual = np.zeros((len(seen.y), len(reduced) * len(drifting)))
        actual[:, k * len(drifting) : (k + 1) * len(drifting)] = seen.W[:, drifting]
        blocks.append(np.column_stack([actual, seen.W[:, common]]) * weight[:, None])
        sides.append(seen.y * weight)
    whole = np.linalg.lstsq(np.vstack(blocks), np.concatenate(sides), rcond=None)[0]
    theta = whole[len(reduced) * len(drifting) :]
    fit = fit_fleet(layout, reduced)
    assert np.allclose(fit.theta[common], theta, rtol=1e-8, atol=1e-10)


def test_sigmas_are_those_of_coloured_noise() -> None:
    """Friction of 20 logs whose truth is known: their pulls have a standard deviation of 1."""
    scene, pulls = Scene(machines=4, periods=5, apart=0.0), []
    fit = fit_fleet(build_layout(emitted().spec), summaries(scene, 2))
    layout = build_layout(emitted().spec)
    truth = parameters(2, compiled())[layout.drift_columns]
    for log in fit.logs:
        pulls.append((log.values[: len(truth)] - truth) / log.sigmas[: len(truth)])
    spread = np.sqrt(np.mean(np.square(pulls)))
    assert 0.85 < spread < 1.35


def test_what_may_drift_and_what_a_load_changes() -> None:
    layout = build_layout(emitted().spec)
    names = [*"Fv1 Fs1 Fv2 Fs2".split(), "gain 1", "gain 2", "load"]
    assert [q.parameter for q in layout.quantities] == names
    assert layout.gain_joints == [0, 1] and layout.quantities[-1].effect == LOAD
    assert {q.effect for q in layout.drifting} == {"viscous", "coulomb", GAIN}
    model, rng = compiled(), np.random.default_rng(1)
    q, qd, qdd = rng.normal(size=(3, 20, 2))
    names = [p.name for p in model.spec.standard]
    one = model.regressor(q, qd, qdd)[:, :, names.index("M2")]
    assert np.allclose(model.base_regressor(q, qd, qdd) @ layout.load[:, 0], one, atol=1e-12)
