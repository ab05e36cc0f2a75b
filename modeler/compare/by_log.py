"""The error of each log by itself, when several are compared."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.compare.prediction import Prediction, residual, unit_errors
from modeler.core.brief import Brief


@dataclass(frozen=True)
class LogError(Brief):
    """||measured - predicted|| / ||measured|| over the rows of one log that count."""

    log: str
    samples: int  # rows that count for at least one joint
    relative_error: float  # all joints; NaN without torque
    joints: tuple[tuple[str, float], ...]  # by joint name; NaN where nothing counts
    by_unit: Mapping[str, float]  # all joints of one unit; NaN without torque


def errors_by_log(prediction: Prediction) -> tuple[LogError, ...]:
    """In the order of the logs."""
    e = np.nan_to_num(residual(prediction))
    measured = np.where(prediction.used, prediction.measured, 0.0)
    found = []
    for run, log in enumerate(prediction.logs):
        rows = prediction.run == run
        found.append(
            LogError(
                log=log,
                samples=int(prediction.used[rows].any(axis=1).sum()),
                relative_error=_relative(e[rows], measured[rows]),
                joints=tuple(
                    (info.name, _relative(e[rows, j], measured[rows, j]))
                    for j, info in enumerate(prediction.joints)
                ),
                by_unit=unit_errors(prediction, rows),
            )
        )
    return tuple(found)


def _relative(e: np.ndarray, measured: np.ndarray) -> float:
    size = float(np.linalg.norm(measured))
    return float(np.linalg.norm(e)) / size if size > 0.0 else float("nan")
