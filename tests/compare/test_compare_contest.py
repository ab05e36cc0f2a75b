"""Models side by side: who is better, and only where that is more than chance."""

import dataclasses
from functools import cache

import numpy as np
import pytest
from known_defects import prediction
from scipy.signal import lfilter

from modeler.core.errors import DataError
from modeler.validation.models import Contest, contest
from modeler.validation.prediction import Prediction


@cache
def truth() -> Prediction:
    """What the models are errors beside."""
    return prediction(rows=3000, noise=0.0)


def coloured(seed: int, size: float, memory: float = 0.2) -> np.ndarray:
    """(rows, 3) errors of a model that last for some time, in N m."""
    pole = np.exp(-0.01 / memory)
    white = np.random.default_rng(seed).normal(size=truth().measured.shape)
    return size * np.sqrt(1.0 - pole**2) * lfilter([1.0], [1.0, -pole], white, axis=0)


def model(seed: int, size: float) -> Prediction:
    return dataclasses.replace(truth(), predicted=truth().predicted + coloured(seed, size))


def judged(*models: Prediction) -> Contest:
    return contest([f"{k}.json" for k in range(len(models))], models)


def test_equally_good_models_are_hardly_ever_told_apart() -> None:
    """50 seeds of 3 joints: a chance of 0.27 % each; four are rarer than 1 in 1000."""
    claims = sum(
        item.best is not None
        for seed in range(50)
        for item in judged(model(2 * seed, 1.0), model(2 * seed + 1, 1.0)).joints
    )
    assert claims <= 3


def test_of_three_that_are_equally_good_none_wins() -> None:
    claims = sum(
        item.best is not None
        for seed in range(20)
        for item in judged(*(model(1000 + 3 * seed + k, 1.0) for k in range(3))).joints
    )
    assert claims <= 1


def test_a_better_model_is_found_on_every_joint() -> None:
    found = judged(model(1, 1.0), model(2, 0.7), model(3, 1.2))
    assert [item.best for item in found.joints] == [1, 1, 1]
    assert found.wins(1) == ["1", "2", "3"] and found.wins(0) == []
    for j, item in enumerate(found.joints):
        left = [p.measured[:, j] - p.predicted[:, j] for p in found.predictions]
        for k, e in enumerate(left):
            assert item.rms[k] == pytest.approx(np.sqrt(np.mean(e**2)))
            size = np.linalg.norm(truth().measured[:, j])
            assert item.errors[k] == pytest.approx(np.linalg.norm(e) / size)
    plain = found.as_dicts()
    assert [entry["model"] for entry in plain] == ["0.json", "1.json", "2.json"]
    assert plain[1]["best_on"] == ["1", "2", "3"]
    assert plain[1]["joints"]["2"]["best"] and not plain[0]["joints"]["2"]["best"]


def test_one_joint_alone_is_named() -> None:
    one = model(5, 1.0)
    predicted = one.predicted.copy()
    predicted[:, 2] = truth().predicted[:, 2] + 0.5 * coloured(6, 1.0)[:, 2]
    found = judged(one, dataclasses.replace(one, predicted=predicted))
    assert [item.best for item in found.joints] == [None, None, 1]


def test_a_burst_is_no_proof() -> None:
    """One second of 30 makes most of the difference: bad luck, perhaps, but no better model."""
    one = model(7, 1.0)
    predicted = one.predicted.copy()
    predicted[500:600] += 6.0
    found = judged(one, dataclasses.replace(one, predicted=predicted))
    assert all(item.errors[1] > 1.3 * item.errors[0] for item in found.joints)
    assert all(item.best is None for item in found.joints)


def test_one_model_is_no_contest() -> None:
    with pytest.raises(DataError, match="expected two or more"):
        judged(model(1, 1.0))
