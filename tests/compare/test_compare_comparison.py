"""A comparison worked by hand; models side by side: who is better, if more than chance."""

import dataclasses
from functools import cache

import numpy as np
import pytest
from known_defects import PERIOD, prediction
from scipy.signal import lfilter

from modeler.core.errors import DataError
from modeler.validation.comparison import REGIONS, WINDOW, compare
from modeler.validation.models import ModelComparison, compare_models
from modeler.validation.prediction import JointInfo, Prediction
from modeler.validation.verdict import write_headline, write_joint_verdict, write_verdict


def by_hand() -> Prediction:
    """One prismatic joint, four samples, all numbers computable in the head."""
    column = np.array([[-1.0], [0.0], [0.5], [1.0]])
    return Prediction(
        robot="slide",
        joints=(JointInfo("1", "m", "N"),),
        logs=("a.csv",),
        run=np.zeros(4, dtype=int),
        segment=np.zeros(4, dtype=int),
        time=np.array([10.0, 11.0, 12.0, 13.0]),
        q=column,
        qd=column,
        qdd=column,
        measured=np.array([[3.0], [4.0], [100.0], [0.0]]),
        predicted=np.array([[3.0], [1.0], [0.0], [4.0]]),
        used=np.array([[True], [True], [False], [True]]),
    )


def test_numbers_of_a_case_worked_by_hand() -> None:
    # residual 0, 3, masked, -4: norm 5; torque 3, 4, 0: norm 5, mean 7/3, spread 26/3
    result = compare(by_hand())
    joint = result.joints[0]
    assert result.samples == joint.samples == 3
    assert joint.relative_error == pytest.approx(1.0)
    assert joint.rms == pytest.approx(5.0 / np.sqrt(3.0))
    assert joint.bias == pytest.approx(-1.0 / 3.0)
    assert joint.r2 == pytest.approx(1.0 - 25.0 / (26.0 / 3.0))
    assert (joint.largest.value, joint.largest.log, joint.largest.time) == (4.0, "a.csv", 13.0)
    assert joint.structure is None and joint.spectrum is None
    shares = {region.name: region.energy_share for region in joint.regions}
    assert shares == pytest.approx(
        {"fast -": 0.0, "slow -": 0.0, "around zero": 9 / 25, "slow +": 0.0, "fast +": 16 / 25}
    )
    assert (joint.worst.start, joint.worst.end) == (13.0, 13.0)
    assert joint.worst.energy_share == pytest.approx(16 / 25)


def test_whole_is_the_stacked_joints() -> None:
    p = prediction(rows=1500)
    result = compare(p)
    e = p.measured - p.predicted
    assert result.relative_error == pytest.approx(np.linalg.norm(e) / np.linalg.norm(p.measured))
    energy = sum(item.rms**2 * item.samples for item in result.joints)
    assert energy == pytest.approx(np.sum(e**2))
    data = result.to_json()
    assert data["samples"] == 1500 and data["relative_error"] == result.relative_error
    assert [data["joints"][n]["max"] for n in "123"] == [j.largest.value for j in result.joints]


def test_summary_has_units_and_every_joint() -> None:
    text = compare(by_hand()).summary()
    assert "100 %" in text and "2.89 N" in text and "13.00 s of a.csv" in text
    first = [row.split()[0] for row in compare(prediction(rows=1500)).summary().splitlines() if row]
    assert first == ["joint", "1", "2", "3", "all", "R2,", "log", "one.parquet", "two.parquet"]


def test_masked_rows_do_not_count() -> None:
    p = prediction(rows=1500)
    used = p.used.copy()
    used[::2, 1] = False
    spoilt = np.where(used, p.measured, np.nan)
    whole, part = compare(p), compare(dataclasses.replace(p, measured=spoilt, used=used))
    assert part.joints[1].samples == 750
    assert part.joints[0].rms == whole.joints[0].rms
    subset = (p.measured - p.predicted)[1::2, 1]
    assert part.joints[1].rms == pytest.approx(np.sqrt(np.mean(subset**2)))


def test_joints_that_cannot_be_judged_are_named() -> None:
    p = prediction(lambda q, qd, qdd, tau, t: 2.0 * qd, rows=1500)
    used = p.used.copy()
    used[:, 0] = False
    measured = p.measured.copy()
    measured[:, 2] = 0.0
    result = compare(dataclasses.replace(p, used=used, measured=measured))
    assert [item.joint.name for item in result.joints] == ["2"]
    assert dict(result.excluded_joints)["1"] == "no sample counts (all masked)"
    assert write_headline(compare(dataclasses.replace(p, used=used))).endswith("(joint 2).")
    assert "Joint 1 is not judged: no sample counts (all masked)." in write_verdict(result)
    nothing = compare(dataclasses.replace(p, measured=np.zeros_like(measured)))
    assert write_headline(nothing) == "three: no joint could be judged."
    assert "measured torque is zero" in result.summary()


def test_without_any_torque_the_error_is_undefined_not_nan() -> None:
    p = by_hand()
    result = compare(dataclasses.replace(p, measured=np.zeros((4, 1))))
    assert result.to_json()["relative_error"] is None
    assert "nan" not in result.summary() and result.summary().splitlines()[-1].split()[1] == "-"
    constant = compare(dataclasses.replace(p, measured=np.ones((4, 1))))
    assert constant.to_json()["joints"]["1"]["r2"] is None
    assert "nan" not in constant.summary()


def test_a_burst_is_found_where_it_is() -> None:
    # 0.2 s wide, around 41 s, in the second log
    result = compare(prediction(lambda q, qd, qdd, tau, t: 20.0 * (np.abs(t - 41.0) < 0.1)))
    worst = result.joints[1].worst
    assert worst.log == "two.parquet"
    assert "of the squared residual in 0.833 % of the time" in write_joint_verdict(result.joints[1])
    assert worst.start <= 40.91 and worst.end >= 41.09
    assert worst.end - worst.start <= WINDOW
    burst = 19 * 400.0
    assert worst.energy_share == pytest.approx(burst / (burst + 6000 * 0.25), abs=0.05)
    assert worst.time_share == pytest.approx(WINDOW / PERIOD / 6000)
    assert result.joints[1].largest.time == pytest.approx(41.0, abs=0.1)


def test_worst_window_stays_inside_a_segment() -> None:
    p = prediction(lambda q, qd, qdd, tau, t: 20.0 * (np.abs(t - 41.0) < 0.1))
    cut = dataclasses.replace(p, segment=p.segment + (p.time > 41.0))
    worst = compare(cut).joints[1].worst
    assert worst.end <= 41.0 + 1e-9 or worst.start > 41.0


def test_regions_split_the_velocity() -> None:
    result = compare(prediction(lambda q, qd, qdd, tau, t: 5.0 * (qd > 0.4 * np.abs(qd).max())))
    regions = result.joints[1].regions
    assert tuple(region.name for region in regions) == REGIONS
    assert sum(region.samples for region in regions) == 6000
    assert sum(region.energy_share for region in regions) == pytest.approx(1.0)
    assert regions[4].energy_share > 0.8
    assert regions[4].bias == pytest.approx(5.0, abs=0.1)
    assert abs(regions[1].bias) < 0.1


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


def judged(*models: Prediction) -> ModelComparison:
    return compare_models([f"{k}.json" for k in range(len(models))], models)


@pytest.mark.parametrize(("models", "seeds", "most"), [(2, range(50), 3), (3, range(334, 354), 1)])
def test_equally_good_models_are_hardly_ever_told_apart(models, seeds, most) -> None:
    """Two and 50 seeds of 3 joints: a chance of 0.27 % each; four are rarer than 1 in 1000."""
    claims = sum(
        item.best is not None
        for seed in seeds
        for item in judged(*(model(models * seed + k, 1.0) for k in range(models))).joints
    )
    assert claims <= most


def test_a_better_model_is_found_on_every_joint() -> None:
    result = judged(model(1, 1.0), model(2, 0.7), model(3, 1.2))
    assert [item.best for item in result.joints] == [1, 1, 1]
    assert result.find_best_joints(1) == ["1", "2", "3"] and result.find_best_joints(0) == []
    for j, item in enumerate(result.joints):
        left = [p.measured[:, j] - p.predicted[:, j] for p in result.predictions]
        for k, e in enumerate(left):
            assert item.rms[k] == pytest.approx(np.sqrt(np.mean(e**2)))
            size = np.linalg.norm(truth().measured[:, j])
            assert item.errors[k] == pytest.approx(np.linalg.norm(e) / size)
    plain = result.to_json()["models"]
    assert [entry["model"] for entry in plain] == ["0.json", "1.json", "2.json"]
    assert plain[1]["best_joints"] == ["1", "2", "3"]
    assert plain[1]["joints"]["2"]["is_best"] and not plain[0]["joints"]["2"]["is_best"]


def test_one_joint_alone_is_named() -> None:
    one = model(5, 1.0)
    predicted = one.predicted.copy()
    predicted[:, 2] = truth().predicted[:, 2] + 0.5 * coloured(6, 1.0)[:, 2]
    result = judged(one, dataclasses.replace(one, predicted=predicted))
    assert [item.best for item in result.joints] == [None, None, 1]


def test_a_burst_is_no_proof() -> None:
    """One second of 30 makes most of the difference: bad luck, possibly, but no better model."""
    one = model(7, 1.0)
    predicted = one.predicted.copy()
    predicted[500:600] += 6.0
    result = judged(one, dataclasses.replace(one, predicted=predicted))
    assert all(item.errors[1] > 1.3 * item.errors[0] for item in result.joints)
    assert all(item.best is None for item in result.joints)


def test_one_model_is_no_contest() -> None:
    with pytest.raises(DataError, match="expected two or more"):
        judged(model(1, 1.0))
