"""A fit whose W is never built says what one with W says."""

import dataclasses
from typing import Any

import numpy as np
import pytest
from scipy.signal import lfilter

from modeler.estimation.identify import identify
from modeler.estimation.result import FitResult
from modeler.estimation.verdict import with_verdict
from modeler.observation import reduce as passing, stretch
from modeler.observation.channels import thinned
from modeler.observation.log import Log
from modeler.observation.observation import Evaluated, Observation
from modeler.observation.observe import observe
from modeler.observation.settings import Processing
from modeler.runtime.model import CompiledModel
from tests.modules import compiled

RATE = 200.0


def moved(model: CompiledModel, memory: float, size: float = 1.0, seed: int = 1) -> Log:
    """Twelve seconds with a gap, missing torques and noise of that memory, s."""
    rng = np.random.default_rng(seed)
    n, time = len(model.spec.joints), np.arange(12 * RATE) / RATE
    time = np.where(time < 5.0, time, time + 0.7)
    w = 2 * np.pi * rng.uniform(0.2, 2.0, (n, 4))
    angle = time[:, None, None] * w + rng.uniform(0, 6.28, (n, 4))
    a = size * rng.uniform(0.1, 0.4, (n, 4))
    q, qd, qdd = (x.sum(2) for x in (np.sin(angle) * a, np.cos(angle) * a * w,
                                     -np.sin(angle) * a * w * w))  # fmt: skip
    if model.spec.closure is not None:
        q = q + [model.spec.closure.home[i] for i in model.spec.closure.given]
    tau = model.inverse_dynamics(q, qd, qdd, rng.uniform(0.5, 2.0, len(model.spec.base)))
    pole = np.exp(-1.0 / (RATE * memory)) if memory else 0.0
    noise = np.sqrt(1 - pole**2) * lfilter([1.0], [1.0, -pole], rng.normal(size=q.shape), axis=0)
    tau = tau + 0.05 * np.std(tau, axis=0) * noise
    tau[700:720, 0] = np.nan
    return Log("x.csv", tuple(j.name for j in model.spec.joints), time, q, tau, qd, qdd)


def fitted(
    model: CompiledModel, log: Log, processing: Processing, method: Any
) -> tuple[Observation, FitResult]:
    observation = observe(model, [log], processing)
    result = identify(observation, method, model)
    return observation, with_verdict(model, observation, result)


def same(kept: Any, passed: Any, where: str = "") -> None:
    """Equal but for the rounding of numbers."""
    if isinstance(kept, dict):
        assert kept.keys() == passed.keys(), where
        for key in kept:
            same(kept[key], passed[key], f"{where}.{key}")
    elif isinstance(kept, list | tuple):
        assert len(kept) == len(passed), where
        for one, other in zip(kept, passed, strict=True):
            same(one, other, where)
    elif isinstance(kept, float):
        assert passed == pytest.approx(kept, rel=1e-9, abs=1e-12), where
    else:
        assert passed == kept, where


PLAIN = Processing(position_cutoff=0.0, parallel_cutoff=0.0, decimation=1, derivatives="log")
THIRD = Processing(position_cutoff=0.0, parallel_cutoff=0.0, decimation=3, derivatives="log")
SMOOTH = Processing(position_cutoff=0.0, parallel_cutoff=20.0, derivatives="log")


@pytest.mark.parametrize(
    ("name", "processing", "memory", "method"),
    [
        ("wrist", PLAIN, 0.0, "weighted"),
        ("wrist", PLAIN, 0.2, "weighted"),  # residuals that remember
        ("wrist", PLAIN, 0.0, "ordinary"),
        ("wrist", THIRD, 0.0, "weighted"),
        ("wrist", SMOOTH, 0.1, "ordinary"),
        ("five-bar", PLAIN, 0.0, "weighted"),
    ],
)
def test_a_fit_without_w_is_the_fit_with_it(monkeypatch, name, processing, memory, method):
    model = compiled(name)
    log = moved(model, memory, 1.0 if name == "wrist" else 0.1)
    kept, expected = fitted(model, log, processing, method)
    monkeypatch.setattr(passing, "KEPT", 0)
    monkeypatch.setattr(stretch, "_BLOCK", 50)  # fewer samples than lags
    observation, found = fitted(model, log, processing, method)
    assert len(kept.stretches) == 2 and not kept.used.all()
    assert "columns" in vars(kept) and "columns" not in vars(observation)
    same(expected.to_json(), found.to_json())


@pytest.mark.parametrize("processing", [PLAIN, THIRD, SMOOTH])
def test_rows_are_picked_and_explained_without_w(monkeypatch, processing):
    model = compiled("wrist")
    log = moved(model, 0.0)
    kept = observe(model, [log], processing)
    columns, rows = kept.columns, thinned(model, kept)
    monkeypatch.setattr(passing, "KEPT", 0)
    observation = observe(model, [log], processing)
    np.testing.assert_array_equal(thinned(model, observation).W, rows.W)
    beta = np.arange(1.0, columns.shape[2] + 1)
    scale = np.abs(columns * beta).max()
    keep = np.arange(len(columns))[:, None] % 3 == [0, 1, 1]
    for own in (keep | True, keep, keep & False):
        found = passing.fitted_torque(observation, beta, own)
        assert np.abs(found - np.where(own, columns @ beta, 0.0)).max() < 1e-12 * scale
    assert passing.is_streamed(observation)


def test_a_regressor_of_another_kind_is_kept(monkeypatch):
    """One that picks columns of the robot's: no compiled function evaluates it."""
    model = compiled("wrist")
    observation = observe(model, [moved(model, 0.0)], PLAIN)
    whole = observation.regressor
    assert isinstance(whole, Evaluated)
    fewer = dataclasses.replace(
        observation,
        names=observation.names[2:],
        units=observation.units[2:],
        regressor=lambda segment, window: whole(segment, window)[..., 2:],
    )
    expected = identify(dataclasses.replace(fewer))
    monkeypatch.setattr(passing, "KEPT", 0)
    found = identify(fewer)
    assert "columns" in vars(fewer)
    same(expected.to_json(), found.to_json())


def test_a_method_that_reads_rows_has_them(monkeypatch):
    model = compiled("wrist")
    log = moved(model, 0.0)
    _, expected = fitted(model, log, PLAIN, "robust")
    monkeypatch.setattr(passing, "KEPT", 0)
    observation, found = fitted(model, log, PLAIN, "robust")
    assert "columns" in vars(observation)
    same(expected.to_json(), found.to_json())
