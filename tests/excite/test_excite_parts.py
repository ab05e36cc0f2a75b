"""The parts of the search against other ways to compute the same."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize, rosen, rosen_der

from modeler.core.errors import DataError
from modeler.excitation import choose_motions, draw_random_motion, separate as choosing, series
from modeler.excitation.search import BarrierProblem
from modeler.numerics.least_squares import ObjectiveFunction, minimise_bfgs, minimise_cma_es
from tests.excite.robots_to_excite import limits_of, small_task
from tests.rotation import with_cases


def test_between_samples_a_series_is_no_larger_than_its_room_says():
    rng = np.random.default_rng(2)
    for dense in (4, 16):
        even = series.build_series(1.0, 4, dense=dense)
        fine = series.build_series(1.0, 4, np.linspace(0.0, 1.0, 5000))
        for _ in range(50):
            x = rng.normal(size=(1, 7))
            assert np.abs(fine.values @ x.T).max() <= np.abs(even.values @ x.T).max() / even.room


@pytest.mark.parametrize("criterion", series.CRITERIA)
def test_slopes_of_the_criteria_are_their_derivatives(criterion):
    rng = np.random.default_rng(3)
    W, way = rng.normal(size=(2, 40, 6))
    W[:, 2] *= 1e3
    function, h = series.CRITERIA[criterion], 1e-6
    difference = (function(W + h * way)[0] - function(W - h * way)[0]) / (2 * h)
    assert np.sum(function(W)[1] * way) == pytest.approx(difference, rel=1e-5)


def test_the_criteria_are_what_they_are_called():
    W = np.random.default_rng(4).normal(size=(50, 5)) * [1, 10, 100, 0.1, 3]
    scaled = np.linalg.cond(W / np.linalg.norm(W, axis=0))
    assert series.compute_condition(W) == pytest.approx(scaled)
    assert series.compute_condition(W, scaled=False) == pytest.approx(np.linalg.cond(W))
    assert series.compute_log_det(W) == pytest.approx(np.linalg.slogdet(W.T @ W)[1])
    assert np.log(scaled) <= series.compute_log_condition(W)[0] <= np.log(scaled) + np.log(5) / 4
    assert series.CRITERIA["information"](W)[0] == pytest.approx(-series.compute_log_det(W) / 10)
    W[:, 1] = 0.0
    assert all(criterion(W)[0] == np.inf for criterion in series.CRITERIA.values())


@with_cases(
    "name, options",
    ("demo-arm", {"limited": 1e4, "boxes": ("3=-3,3,-3,3,-3,3",)}),
    ("five-bar", {"limited": 1e4}),
    pytest.param("wrist", {}, marks=pytest.mark.rotating),
    pytest.param("3rrr", {}, marks=pytest.mark.rotating),
)
def test_the_slope_of_the_search_is_the_derivative_of_its_value(name, options):
    task = small_task(name, **options)
    rng = np.random.default_rng(5)
    walled = BarrierProblem(task, 0.05)
    x = (0.9 * draw_random_motion(task, rng)).ravel()
    x[:: task.series.values.shape[1]] /= 0.9  # smaller, around the same place
    assert np.isfinite(walled.compute_value(x))
    slope = walled.compute_gradient()
    for _ in range(3):
        way, h = rng.normal(size=x.shape), 1e-6
        difference = (walled.compute_value(x + h * way) - walled.compute_value(x - h * way)) / (
            2 * h
        )
        assert slope @ way == pytest.approx(difference, rel=2e-3, abs=1e-3)


def test_descent_stays_within_walls_and_finds_what_scipy_finds():
    def value(x):
        return rosen(x) - 1e-3 * np.log(1.2 - x[0]) if x[0] < 1.2 else np.inf

    def slope(x):
        return rosen_der(x) + np.array([1e-3 / (1.2 - x[0]), 0.0])

    def reach(x, way):
        return (1.2 - x[0]) / way[0] if way[0] > 0 else np.inf

    start = np.array([-1.0, 1.0])
    result = minimise_bfgs(ObjectiveFunction(value, slope, reach), start, 200, 1e-9, lambda: True)
    best = minimize(value, start, method="Nelder-Mead", options={"xatol": 1e-7, "maxiter": 4000})
    assert np.allclose(result, best.x, atol=1e-3)


def test_evolution_finds_the_bottom_of_a_narrow_valley():
    actual = minimise_cma_es(
        rosen, np.array([-1.0, 1.0, 0.5]), 0.3, 400, np.random.default_rng(0), lambda n: True
    )
    assert np.allclose(actual, 1.0, atol=1e-3)


def test_dry_friction_turns_smoothly_and_is_itself_away_from_rest():
    compiled, _ = limits_of("demo-arm")
    task = small_task("demo-arm")
    coulomb = [k for k, base in enumerate(compiled.spec.base) if base.name.startswith("Fs")]
    assert set(np.flatnonzero(task.columns.half_jumps.any(axis=(0, 1)))) == set(coulomb)
    q = np.full((5, 3), 0.3)
    qd = task.bounds.speed * np.array([-0.9, -1e-6, 0.0, 1e-6, 0.9])[:, None]
    exact, smooth = (
        f(q, qd, q, None) for f in (task.columns.evaluate_exact, task.columns.evaluate_smooth)
    )
    assert np.allclose(exact[[0, 4]], smooth[[0, 4]], atol=1e-9)
    assert np.abs(smooth[1:4][:, :, coulomb]).max() < 1e-3


def test_the_choice_is_the_best_of_all_subsets(monkeypatch):
    rng = np.random.default_rng(6)
    rows = [rng.normal(size=(8, 6)) * rng.uniform(0, 1, 6) ** 3 for _ in range(9)]
    choice = choose_motions(rows, 3)

    def value(places):
        return series.compute_condition(np.vstack([rows[k] for k in places]))

    every = sorted(value(places) for places in itertools.combinations(range(9), 3))
    assert choice.is_exhaustive and choice.condition == pytest.approx(every[0])
    monkeypatch.setattr(choosing, "THRESHOLDS", replace(choosing.THRESHOLDS, max_subsets=1))
    quick = choose_motions(rows, 3)
    assert not quick.is_exhaustive and quick.condition <= every[3]
    with pytest.raises(DataError, match="got 10 of 9"):
        choose_motions(rows, 10)
    with pytest.raises(DataError, match="excite all"):
        choose_motions([W[:2] for W in rows], 2)
