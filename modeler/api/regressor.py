"""A robot as a regressor of scikit-learn: a row is a sample, a group is a log.

from sklearn.model_selection import LeaveOneGroupOut, cross_val_score
from modeler.api.regressor import TorqueRegressor, read_log_rows

X, y, groups = read_log_rows("arm.toml", ["mon.csv", "tue.csv", "wed.csv"])
cross_val_score(TorqueRegressor("arm.toml"), X, y, groups=groups, cv=LeaveOneGroupOut())
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from sklearn.base import BaseEstimator, MultiOutputMixin, RegressorMixin
from sklearn.utils.validation import check_is_fitted, validate_data

from modeler import regression, validation
from modeler.api import fitting
from modeler.api.fitting import prepare_robot
from modeler.api.log_maps import Mapped
from modeler.api.workflow import (
    CompiledRobot,
    Logs,
    compile_model,
    convert_to_list,
    derive_text,
    read_logs,
)
from modeler.core.errors import DataError
from modeler.core.options import FitOptions
from modeler.logs import LEAST_ROWS
from modeler.robot import Robot
from modeler.runtime import CompiledModel

Rows = tuple[np.ndarray, np.ndarray, np.ndarray]


def _compile_robot(robot: Robot | str | Path) -> CompiledRobot:
    prepared_robot = prepare_robot(robot)
    derivation, emitted = derive_text(prepared_robot.text, prepared_robot.name)
    return CompiledRobot(derivation, emitted, compile_model(emitted))


def read_log_rows(robot: Robot | str | Path, logs: Logs, mapping: Mapped = ()) -> Rows:
    """Reads logs as arrays for scikit-learn.

    Args:
        robot: as loaded; its file, or the name of a built-in one.
        logs: as of `identify`.
        mapping: whose column is which.

    Returns:
        X: (n, 2 + J), (n, 2 + 2 J) or (n, 2 + 3 J): number of the log, time, positions of the J
            joints; velocities and accelerations too where every log has them.
        y: (n, J) torque, N m or N.
        groups: (n,) number of the log.

    Raises:
        DataError: a log cannot be read.
    """
    read = read_logs(_compile_robot(robot).compiled, convert_to_list(logs), mapping)
    names = ["q", *(["qd"] if all(log.qd is not None for log in read) else [])]
    names += ["qdd"] if "qd" in names and all(log.qdd is not None for log in read) else []
    row_blocks = [
        np.column_stack([log.time * 0 + k, log.time, *(getattr(log, n) for n in names), log.tau])
        for k, log in enumerate(read)
    ]
    rows = np.concatenate(row_blocks)
    rows = rows[np.isfinite(rows).all(axis=1)]  # what is missing is a gap
    torques = read[0].tau.shape[1]
    return rows[:, :-torques], rows[:, -torques:], rows[:, 0].astype(int)


class TorqueRegressor(MultiOutputMixin, RegressorMixin, BaseEstimator):
    """The torque of a robot from its motion: fitted by any estimator, and predicted.

    Rows are those of `read_log_rows`. Give whole logs to either side of a split: `GroupKFold`,
    `LeaveOneGroupOut`; what is missing of a log is a gap in it.

    Attributes:
        model_: the fitted model, as of `identify`.
    """

    def __init__(
        self,
        robot: Robot | str | Path,
        method: str = "weighted",
        processing: regression.Processing | None = None,
    ) -> None:
        """Takes a robot.

        Args:
            robot: as loaded; its file, or the name of a built-in one.
            method: one of `estimators()`.
            processing: of the logs; None: chosen from them.
        """
        self.robot, self.method, self.processing = robot, method, processing

    def fit(self, X: Any, y: Any) -> "TorqueRegressor":
        """Fits the base parameters.

        Raises:
            DataError: see `identify`.
        """
        X, y = validate_data(self, X, y, multi_output=True, y_numeric=True, dtype=float)
        robot = _compile_robot(self.robot)
        logs = [log for _, log in _split_logs(robot.compiled, X, y)]
        rows = regression.observe(robot.compiled, logs, self.processing)
        self.model_ = fitting.fit_observation(FitOptions(self.method), robot, rows)[0]
        return self

    def predict(self, X: Any) -> np.ndarray:
        """Predicts the (n, J) torque at every row.

        Raises:
            DataError: rows in pieces too short to differentiate.
        """
        check_is_fitted(self, "model_")
        X = validate_data(self, X, reset=False, dtype=float)
        compiled = _compile_robot(self.robot).compiled
        torque = np.empty((len(X), len(compiled.spec.joints)))
        for rows, log in _split_logs(compiled, X):
            torque[rows], _ = validation.predict_every_row(self.model_, log, compiled)
        if missing_rows := int(np.isnan(torque).any(axis=1).sum()):
            raise DataError(
                f"predict: {missing_rows} rows lie in pieces too short to differentiate; leave "
                "them out"
            )
        return torque


def _split_logs(
    compiled: CompiledModel, X: np.ndarray, y: np.ndarray | None = None
) -> Iterator[tuple[np.ndarray, regression.Log]]:
    """The logs behind rows, and which rows are whose."""
    joints = tuple(joint.name for joint in compiled.spec.joints)
    count = len(joints)
    if (X.shape[1] - 2) % count or not count <= X.shape[1] - 2 <= 3 * count:
        raise DataError(
            f"X has {X.shape[1]} columns; expected number of the log, time, and positions, speeds "
            f"or accelerations of {count} joints, as log_rows gives them"
        )
    for number in np.unique(X[:, 0]):
        rows = np.flatnonzero(X[:, 0] == number)
        parts: list[Any] = [X[rows, k : k + count] for k in range(2, X.shape[1], count)]
        tau = np.full((len(rows), count), np.nan) if y is None else y[rows].reshape(len(rows), -1)
        if tau.shape[1] != count:
            raise DataError(f"y has {tau.shape[1]} columns; expected the torque of {count} joints")
        time = X[rows, 1]
        if len(rows) < LEAST_ROWS or (np.diff(time) <= 0.0).any():
            raise DataError(
                f"X: got {len(rows)} rows of log {number:g}; expected at least {LEAST_ROWS}, their "
                "time increasing; keep the rows of a log together, and in order"
            )
        yield rows, regression.Log(f"log {number:g}", joints, time, parts[0], tau, *parts[1:])
