"""The robot as a regressor of scikit-learn: its tools, and its checks of estimators."""

from typing import Any

import numpy as np
import pytest

import modeler as md
from modeler.core.errors import DataError
from tests.when_used import WhenUsed

base = WhenUsed("sklearn.base")
selection = WhenUsed("sklearn.model_selection")
estimator_checks = WhenUsed("sklearn.utils.estimator_checks")
exceptions = WhenUsed("sklearn.exceptions")
regressor = WhenUsed("modeler.api.regressor", "NOT CHECKED: scikit-learn is not installed")


@pytest.fixture(scope="module")
def runs() -> list[Any]:
    robot = md.open_robot("two-link")
    return [md.simulate(robot, duration=4.0, rate=250.0, seed=seed) for seed in (51, 52, 53)]


@pytest.fixture(scope="module")
def rows(runs: list[Any]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return regressor.read_log_rows("two-link", runs)


def test_rows_are_those_of_the_logs(runs: list[Any], rows: Any) -> None:
    X, y, groups = rows
    assert X.shape == (3000, 4) and y.shape == (3000, 2)
    for k, run in enumerate(runs):
        np.testing.assert_array_equal(X[groups == k, 1], run.time)
        np.testing.assert_array_equal(X[groups == k, 2:], run.q)
        np.testing.assert_array_equal(y[groups == k], run.tau)
    missing = {"time": runs[0].time, "q": runs[0].q.copy(), "tau": runs[0].tau}
    missing["q"][100:103, 1] = np.nan
    assert len(regressor.read_log_rows("two-link", missing)[0]) == 997


def test_with_speeds_and_accelerations_where_every_log_has_them(runs: list[Any]) -> None:
    truth = [r.truth for r in runs[:2]]
    logs = [
        {"time": r.time, "q": r.q, "qd": t.qd, "qdd": t.qdd, "tau": r.tau}
        for r, t in zip(runs, truth, strict=False)
    ]
    assert regressor.read_log_rows("two-link", logs)[0].shape[1] == 8
    del logs[1]["qdd"]
    X, y, _ = regressor.read_log_rows("two-link", logs)
    assert X.shape[1] == 6
    assert regressor.TorqueRegressor("two-link").fit(X, y).score(X, y) > 0.98


def test_a_fit_is_that_of_identify(runs: list[Any], rows: Any) -> None:
    X, y, groups = rows
    some = groups < 2
    fitted = regressor.TorqueRegressor("two-link", "robust").fit(X[some], y[some])
    model = md.identify(
        "two-link", [{"time": r.time, "q": r.q, "tau": r.tau} for r in runs[:2]], method="robust"
    )
    np.testing.assert_allclose(fitted.model_.beta, model.beta, rtol=1e-9)
    held = {"time": runs[2].time, "q": runs[2].q}
    expected, values = model.predict(held)["tau"], fitted.predict(X[~some])
    sure = np.isfinite(expected)
    np.testing.assert_allclose(values[sure], expected[sure], rtol=1e-9)
    assert np.isfinite(values).all()


@pytest.mark.slow  # some seconds
def test_one_group_a_log(rows: Any) -> None:
    X, y, logs = rows
    robot = regressor.TorqueRegressor("two-link")
    assert base.is_regressor(robot) and base.clone(robot).get_params() == robot.get_params()
    scores = selection.cross_val_score(robot, X, y, groups=logs, cv=selection.LeaveOneGroupOut())
    assert scores.shape == (3,) and (scores > 0.95).all()
    out = selection.cross_val_predict(robot, X, y, groups=logs, cv=selection.GroupKFold(3))
    left = y[logs == 1] - out[logs == 1]
    r2 = 1.0 - (left**2).sum(axis=0) / ((y[logs == 1] - y[logs == 1].mean(axis=0)) ** 2).sum(axis=0)
    assert scores[1] == pytest.approx(r2.mean())
    grid = {"method": ["weighted", "ordinary"]}
    search = selection.GridSearchCV(robot, grid, cv=selection.GroupKFold(3)).fit(X, y, groups=logs)
    assert search.best_estimator_.model_.fit.method in grid["method"]


CHECKS = tuple(
    """
    estimator_cloneable estimator_repr no_attributes_set_in_init get_params_invariance set_params
    parameters_default_constructible do_not_raise_errors_in_init_or_set_params mixin_order
    estimators_unfitted estimator_tags_renamed valid_tag_types complex_data fit1d requires_y_none
    estimator_sparse_matrix estimator_sparse_array estimators_empty_data_messages
    supervised_y_no_nan
""".split()
)


@pytest.mark.parametrize("name", CHECKS)
def test_checks_of_estimators_that_need_no_data_of_a_robot(name: str) -> None:
    """The others fit random rows of any width, which are the motion of no robot."""
    getattr(estimator_checks, f"check_{name}")(
        "TorqueRegressor", regressor.TorqueRegressor("two-link")
    )


def test_what_cannot_be_is_refused_in_one_line(rows: Any) -> None:
    X, y, _ = rows
    robot = regressor.TorqueRegressor("two-link")
    with pytest.raises(exceptions.NotFittedError):
        robot.predict(X)
    for entry, said in (
        ((X[:, :3], y), "X has 3 columns; expected number of the log, time, .* of 2 joints"),
        ((X, y[:, 0]), "y has 1 columns; expected the torque of 2 joints"),
        ((X[::-1], y), "X: got 1000 rows of log 0; expected at least 10, their time increasing"),
    ):
        with pytest.raises(DataError, match=said):
            robot.fit(*entry)
    robot.fit(X, y)
    X = np.concatenate([X[:500], [[7.0, 0.0, 0.1, 0.1], [7.0, 0.1, 0.1, 0.1]]])
    with pytest.raises(DataError, match="got 2 rows of log 7; expected at least 10"):
        robot.predict(X)
