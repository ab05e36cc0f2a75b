"""What a diagnosis evaluates a window at a time, and what it lets go of."""

import gc
import weakref
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import cont2discrete, lfilter

from modeler.core.expression import parse_expression
from modeler.diagnosis import candidates as rows_module, signals as signals_module
from modeler.diagnosis.candidates import thin_samples
from modeler.diagnosis.generation import generate_candidates
from modeler.diagnosis.ranking import estimate_sigma
from modeler.diagnosis.state import SearchData, analyse_logs, build_all_columns, build_state
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.numerics.least_squares import ReducedRows
from modeler.regression.motion import Processing
from modeler.regression.prepare import LogRepair
from tests.chain import chain_of


@pytest.fixture(scope="module")
def arm():
    return chain_of("demo-arm").compiled


@pytest.fixture(scope="module")
def log():
    return chain_of("demo-arm").log("log", duration=8.0, rate=400.0)


def columns(arm, observation):
    """Of everything that could be missing, and those of the model."""
    data = SearchData(arm, observation)
    beta = np.linspace(-1.0, 2.0, len(arm.spec.base))
    state = build_state(data, (), beta)
    return state.rows.W, build_all_columns(state.rows, generate_candidates(state))


def test_columns_do_not_depend_on_the_windows(arm, log, monkeypatch) -> None:
    """Differences of differences, states with a memory and filters reach across every border."""
    observation = analyse_logs(arm, [log], Processing())
    whole = columns(arm, observation)
    for module in (rows_module, signals_module):
        monkeypatch.setattr(module, "THRESHOLDS", replace(THRESHOLDS, sample_window=101))
    parts = columns(arm, observation)
    assert len(whole[1]) == len(parts[1]) > 100
    np.testing.assert_equal(parts, whole)


def test_logs_are_mended_once_for_any_filters(arm, log) -> None:
    mending = LogRepair([log], arm.spec)
    for cutoff in (15.0, 25.0):
        processing = Processing(position_cutoff=40.0, parallel_cutoff=cutoff)
        shared, alone = (
            analyse_logs(arm, [log], processing, repair=items) for items in (mending, None)
        )
        np.testing.assert_array_equal(shared.torque, alone.torque)
        np.testing.assert_array_equal(shared.qdd, alone.qdd)
    assert mending.get_repaired(0, processing)[0] is mending.get_repaired(0, processing)[0]


@pytest.fixture
def without_collection():
    """Columns of a long log are large: they go without a collection of garbage."""
    gc.disable()
    yield
    gc.enable()


def test_an_expression_lets_go_of_its_values(without_collection) -> None:
    expression, values = parse_expression("x*abs(x) + x**2"), np.ones(3)
    gone = weakref.ref(values)
    expression.fold({"x": values}, {"abs": np.abs}, np.pi, float)
    del values
    assert gone() is None


def test_a_state_lets_go_of_its_rows(arm, log, without_collection) -> None:
    data = SearchData(arm, analyse_logs(arm, [log], Processing()))
    state = build_state(data, (), np.zeros(len(arm.spec.base)))
    state.rank_columns([(np.ones((len(state.y[0]), 1)), None, None)])
    first = weakref.ref(state.gram_blocks.whitened_columns[0])
    del state
    assert first() is None


def test_samples_that_the_band_has_no_use_for_are_let_go(arm, log) -> None:
    """The rows stay the same, and so does what half a sample of the log is."""
    whole = analyse_logs(arm, [log], Processing(position_cutoff=40.0, parallel_cutoff=8.0))
    few = thin_samples(whole, arm)
    (part,), (left,) = whole.stretches, few.stretches
    assert left.segment.samples < 0.3 * part.segment.samples
    assert left.segment.logged_step == pytest.approx(part.segment.step)
    assert all(x is y for x, y in zip(thin_samples(few, arm).stretches, few.stretches, strict=True))
    one, other = (SearchData(arm, items).rows for items in (whole, few))
    for name in ("y", "W", "time", "segment"):
        np.testing.assert_equal(getattr(one, name), getattr(other, name))


@pytest.mark.parametrize(("frequency", "damping"), [(0.7, 0.1), (6.0, 0.02), (55.0, 0.7)])
def test_what_rings_is_that_of_scipy(frequency: float, damping: float) -> None:
    step, w = 4e-3, 2.0 * np.pi * frequency
    load = np.random.default_rng(int(frequency)).normal(size=5000).cumsum() + 20.0
    system = [w**2], [1.0, 2.0 * damping * w, w**2]
    numerator, denominator, _ = cont2discrete(system, step, method="foh")
    theirs = load[0] + lfilter(np.ravel(numerator), denominator, load - load[0])
    ours = signals_module.simulate_resonance(load, step, frequency, damping)
    np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=1e-9 * np.abs(load).max())


def test_rows_without_torque_do_not_drive_the_parameters_to_zero() -> None:
    """They hold to the accuracy of the columns, and beta = 0 would satisfy them exactly."""
    rng = np.random.default_rng(0)
    beta = np.array([3.0, -2.0, 1.0])
    driven = rng.normal(size=(400, 3))
    swinging = rng.normal(size=(400, 3))
    swinging -= np.outer(swinging @ beta, beta) / (beta @ beta)
    swinging += 0.01 * rng.normal(size=(400, 3))
    torques = driven @ beta + 0.05 * rng.normal(size=400)
    rows = ReducedRows((driven, swinging), (torques, np.zeros(400)), np.array([400, 400]))
    sigma = estimate_sigma(rows)
    np.testing.assert_allclose(sigma[0], 0.05, rtol=0.2)
    assert 0.01 < sigma[1] < 0.2
