"""The reduced model: values of its own, told, saved, and what predicts with it."""

import dataclasses
import json

import numpy as np
import pytest
from stand_in import planar_arm
from test_observation_rows import exact_log, some_beta

from modeler.core.errors import DataError
from modeler.fit import identify
from modeler.fit.model_file import IdentifiedModel, load_model, provenance, save_model
from modeler.fit.reduced import with_essential_only
from modeler.fit.result import fit_from_json
from modeler.observation import observe

NOISE = 0.3


@pytest.fixture(scope="module")
def robot():
    """An arm with some parameters of 0."""
    arm = planar_arm()
    beta = some_beta(arm)
    beta[[2, 5, 9]] = 0.0
    return arm, beta


def seen_and_fit(robot, seed=0):
    arm, beta = robot
    log = exact_log(arm, beta, seed=seed, seconds=10)
    noise = NOISE * np.random.default_rng(70 + seed).normal(size=log.tau.shape)
    seen = observe(arm, [dataclasses.replace(log, tau=log.tau + noise)])
    return seen, identify(seen, "ordinary")


@pytest.fixture(scope="module")
def fitted(robot):
    return seen_and_fit(robot)


def test_it_is_the_fit_of_the_smaller_table(fitted):
    seen, fit = fitted
    reduced = fit.essential
    assert 0 < len(reduced.dropped) <= 5
    names = [p.name for p in reduced.parameters]
    assert names == [p.name for p in fit.parameters if p.essential]
    W = seen.W[:, [seen.names.index(name) for name in names]]
    beta, squares, _, _ = np.linalg.lstsq(W, seen.y, rcond=None)
    np.testing.assert_allclose([p.value for p in reduced.parameters], beta, rtol=1e-8)
    sigma = np.sqrt(squares[0] / (len(W) - len(names)) * np.diag(np.linalg.inv(W.T @ W)))
    ratio = [p.sigma for p in reduced.parameters] / sigma
    assert np.all((ratio > 0.99) & (ratio < 1.5))  # raised where residuals have a memory
    assert reduced.condition_number == pytest.approx(np.linalg.cond(W), rel=1e-8)
    assert reduced.condition_number < fit.condition_number
    assert reduced.relative_error == fit.essential_error
    assert reduced.ratio < reduced.limit


def test_its_sigmas_cover_the_truth_and_are_smaller(robot):
    arm, beta = robot
    truth = dict(zip((base.name for base in arm.spec.base), beta, strict=True))
    z, shrunk = [], []
    for seed in range(50):
        _, fit = seen_and_fit(robot, seed)
        if set(fit.essential.dropped) <= {name for name, value in truth.items() if value == 0.0}:
            full = {p.name: p.sigma for p in fit.parameters}
            z += [(p.value - truth[p.name]) / p.sigma for p in fit.essential.parameters]
            shrunk += [p.sigma / full[p.name] for p in fit.essential.parameters]
    assert len(z) > 200 and np.sqrt(np.mean(np.square(z))) == pytest.approx(1.0, abs=0.15)
    # Each is raised for the memory of its own residuals, which scatters by a tenth.
    assert max(shrunk) < 1.2 and np.mean(shrunk) < 0.97


def test_it_is_told_and_saved(fitted):
    _, fit = fitted
    lines = fit.lines()
    (told,) = (line for line in lines if line.startswith("reduced model: "))
    assert f"{len(fit.essential.parameters)} essential of 13 parameters" in told
    (head,) = (line for line in lines if line.startswith("parameter "))  # one table
    assert head.split() == ["parameter", "value", "sigma", "%sigma", "reduced", "unit"]
    rows = {line.split()[0]: line.split() for line in lines[1:14]}
    for parameter in fit.essential.parameters:
        assert rows[parameter.name][4] == f"{parameter.value:.6g}"
    assert all(rows[name][4] == "-" for name in fit.essential.dropped)
    raw = json.loads(json.dumps(fit.to_json(), allow_nan=False))
    assert {"parameters", "dropped", "condition_number", "relative_error"} <= set(raw["essential"])
    assert fit_from_json(raw, fit.covariance).essential == fit.essential
    del raw["essential"]  # a file of an earlier version
    assert fit_from_json(raw, fit.covariance).essential is None


def test_a_fit_of_essential_parameters_only_prints_one_table(robot):
    arm, beta = robot
    seen = observe(arm, [exact_log(arm, np.where(beta == 0.0, 0.7, beta), seconds=10)])
    fit = identify(seen)
    assert fit.essential.dropped == () and fit.essential.limit is None
    assert "reduced model" not in "\n".join(fit.lines())


def test_a_model_predicts_with_it(robot, fitted, tmp_path):
    (arm, _), (seen, fit) = robot, fitted
    model = IdentifiedModel("name = 'arm'\n", arm.spec, {}, fit, provenance(seen.report))
    save_model(tmp_path / "m.json", model)
    small = with_essential_only(load_model(tmp_path / "m.json"), "m.json")
    values = {p.name: p.value for p in fit.essential.parameters}
    assert list(small.beta) == [values.get(name, 0.0) for name in seen.names]
    assert small.fit.relative_error == fit.essential_error
    old = dataclasses.replace(model, fit=dataclasses.replace(fit, essential=None))
    with pytest.raises(DataError, match=r"m.json: holds no reduced model .*; fit it again"):
        with_essential_only(old, "m.json")


def test_errors_that_fall_are_not_said_to_be_raised(robot):
    """Weighted squares are least with all parameters; the relative error is unweighted."""
    _, fit = seen_and_fit(robot)
    sentence = next(text for text in fit.sentences if "are essential; " in text)
    assert "leaving the others out changes the relative error from" in sentence
