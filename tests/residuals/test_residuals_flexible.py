"""The nonparametric baseline, where it is known how much of a residual is noise."""

import numpy as np
import pytest
from scipy.signal import lfilter

from modeler.numerics.splines import (
    Measurements,
    assign_folds,
    fit_nonparametric_baseline,
    generate_function_sets,
)
from tests.rotation import with_cases

STEP, ROWS, JOINTS = 1.0 / 80.0, 1600, 7


def measured(seed: int, joint: int = 0, rows: int = ROWS, joints: int = JOINTS) -> Measurements:
    """Six harmonics on each joint for 20 s."""
    rng = np.random.default_rng(seed)
    t = np.arange(rows)[:, None] * STEP
    q, v, a = (np.zeros((rows, joints)) for _ in range(3))
    for harmonic in range(1, 7):
        w = 0.2 * np.pi * harmonic * (1.0 + 0.07 * np.arange(joints))
        size, phase = rng.normal(size=joints) / harmonic, rng.uniform(0.0, 6.3, joints)
        q += size * np.sin(w * t + phase)
        v += size * w * np.cos(w * t + phase)
        a -= size * w**2 * np.sin(w * t + phase)
    load = 2.0 * a + 8.0 * np.cos(q)
    torque = load + 3.0 * v + 2.0 * np.sign(v)
    none = np.zeros((rows, 0))
    return Measurements(joint, q, v, a, load, torque, np.sign(v[:, joint]), none, {})


def noise(seed: int, memory: float = 0.0, rows: int = ROWS) -> np.ndarray:
    """Of unit variance, forgotten as exp(-t / memory)."""
    pole = np.exp(-STEP / memory) if memory else 0.0
    white = np.random.default_rng(1000 + seed).normal(size=rows + 500)
    return np.asarray(lfilter([np.sqrt(1.0 - pole**2)], [1.0, -pole], white))[500:]


def fold(rows: int = ROWS) -> np.ndarray:
    return assign_folds(np.zeros(rows, dtype=int))


@pytest.mark.parametrize(
    "memory", [0.1, *(pytest.param(x, marks=pytest.mark.rotating) for x in (0.0, 0.03, 0.2))]
)
def test_noise_of_any_colour_is_not_predicted(memory: float) -> None:
    values = [
        fit_nonparametric_baseline(generate_function_sets(measured(s)), noise(s, memory), fold())
        for s in range(4)
    ]
    assert np.mean([each.share for each in values]) < 0.03
    assert np.mean([each.is_significant and each.share > 0.05 for each in values]) < 0.1
    if memory < 0.1:
        assert max(each.share for each in values) < 0.05


@with_cases(
    "function",
    lambda m: np.sign(m.v[:, 0]) * np.exp(-np.abs(m.v[:, 0]) / 0.3),
    lambda m: np.abs(m.load[:, 0]) * np.sign(m.v[:, 0]),
    lambda m: np.abs(m.torque[:, 0]),
    lambda m: np.tanh(3.0 * np.sin(4.0 * m.q[:, 1])),
    lambda m: m.load[:, 3],
)
def test_functions_of_what_was_measured_are_predicted(function) -> None:
    """Half of the variance; every row by fits that did not see it."""
    m = measured(1)
    known = function(m)
    known = (known - known.mean()) / known.std()
    fit = fit_nonparametric_baseline(
        generate_function_sets(m), 3.0 * (known + noise(1)) + 7.0, fold()
    )
    assert fit.share > 0.35 and fit.is_significant
    assert fit.prediction.mean() == pytest.approx(7.0, abs=0.3)
    assert np.corrcoef(fit.prediction, known)[0, 1] > 0.85


def test_a_row_is_predicted_from_others() -> None:
    """What the residual is in one fold changes nothing there but the mean."""
    m, where = measured(1), fold() == 3
    y = np.sin(3.0 * m.q[:, 1]) + noise(1)
    other = y.copy()
    other[where] = other[where][::-1]
    sets = [*generate_function_sets(m)]
    one, two = (fit_nonparametric_baseline(sets, r, fold()).prediction[where] for r in (y, other))
    np.testing.assert_allclose(one, two, atol=1e-5)


def test_the_set_that_suffices_is_told_and_the_answer_is_the_same_twice() -> None:
    m = measured(2)
    y = np.sin(4.0 * m.q[:, 4]) + 0.3 * noise(2)
    fit = fit_nonparametric_baseline(generate_function_sets(m), y, fold())
    assert max(fit.share_by_set, key=lambda name: fit.share_by_set[name]) == "4"
    np.testing.assert_array_equal(
        fit.prediction, fit_nonparametric_baseline(generate_function_sets(m), y, fold()).prediction
    )


def test_nothing_is_said_of_few_rows_or_a_constant() -> None:
    m = measured(4, rows=90)
    fit = fit_nonparametric_baseline(generate_function_sets(m), noise(4, rows=90), fold(90))
    assert fit.share == 0.0
    m = measured(4, rows=300)
    fit = fit_nonparametric_baseline(generate_function_sets(m), np.full(300, 2.0), fold(300))
    assert fit.share == 0.0 and not fit.is_significant
    np.testing.assert_array_equal(fit.prediction, np.full(300, 2.0))
    assert fit_nonparametric_baseline({}, noise(4), fold()).share == 0.0
