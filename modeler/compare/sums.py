"""What the numbers of a comparison come from: sums over rows, which add up over chunks and logs."""

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np

from modeler.compare.prediction import Prediction, residual
from modeler.compare.where import WINDOW, Window, worst_window


@dataclass(frozen=True)
class Moment:
    """The sample with the largest absolute residual."""

    value: float  # N m or N, absolute
    log: str
    time: float  # s, as in the log


@dataclass(frozen=True, eq=False)
class JointSums:
    """Of the rows of one joint that count.

    Attributes:
        count: rows.
        mean: (3,) of residual, measured and predicted torque, N m or N.
        scatter: (3, 3) sums of their products, the means taken off.
        largest: residual; None without a row.
        worst: half second; its shares are of these rows.
        close: rows around that.
    """

    count: int
    mean: np.ndarray
    scatter: np.ndarray
    largest: Moment | None = None
    worst: Window | None = None
    close: Prediction | None = None

    @property
    def energy(self) -> float:
        """Sum of the squared residual."""
        return float(self.scatter[0, 0] + self.count * self.mean[0] ** 2)

    @property
    def size(self) -> float:
        """Sum of the squared measured torque."""
        return float(self.scatter[1, 1] + self.count * self.mean[1] ** 2)

    @property
    def relative_error(self) -> float:
        """||residual|| / ||measured||; NaN without torque."""
        return math.sqrt(self.energy / self.size) if self.size > 0.0 else math.nan

    def over(self, later: "JointSums") -> "JointSums":
        """Of both (Chan, Golub and LeVeque 1983, Am. Stat. 37, eq. 2.1)."""
        if not self.largest or not later.largest:
            return self if self.largest else later
        count, apart = self.count + later.count, later.mean - self.mean
        share = later.count / count
        both = JointSums(
            count,
            self.mean + share * apart,
            self.scatter + later.scatter + self.count * share * np.outer(apart, apart),
            max(self.largest, later.largest, key=lambda moment: moment.value),
        )
        by = max(self, later, key=lambda own: own.worst.energy_share * own.energy)  # type: ignore[union-attr]
        assert by.worst is not None
        worst = dataclasses.replace(
            by.worst,
            energy_share=by.worst.energy_share * (by.energy / both.energy if both.energy else 0.0),
            time_share=by.worst.time_share * by.count / count,
        )
        return dataclasses.replace(both, worst=worst, close=by.close)


NOTHING = JointSums(0, np.zeros(3), np.zeros((3, 3)))
"""Of no row."""


@dataclass(frozen=True, eq=False)
class LogSums:
    """Of the rows of one log: how many, those that count for a joint, and each joint."""

    log: str
    rows: int
    samples: int
    joints: tuple[JointSums, ...]

    def over(self, later: "LogSums") -> "LogSums":
        """Of these rows, and of those that follow them."""
        joints = zip(self.joints, later.joints, strict=True)
        return LogSums(
            self.log,
            self.rows + later.rows,
            self.samples + later.samples,
            tuple(one.over(other) for one, other in joints),
        )

    @property
    def relative_error(self) -> float:
        """Over all joints, rows stacked; NaN without torque."""
        size = sum(own.size for own in self.joints)
        return math.sqrt(sum(own.energy for own in self.joints) / size) if size > 0.0 else math.nan


def sums_of(prediction: Prediction) -> tuple[LogSums, ...]:
    """By log."""
    e = residual(prediction)
    return tuple(_of_log(prediction, e, run) for run in range(len(prediction.logs)))


def all_logs(sums: Sequence[LogSums]) -> LogSums:
    """Of all logs as one."""
    return reduce(LogSums.over, sums)


def _of_log(prediction: Prediction, e: np.ndarray, run: int) -> LogSums:
    rows = prediction.run == run
    own, left = some_rows(prediction, rows), e[rows]
    joints = tuple(_of_joint(own, j, left[:, j]) for j in range(e.shape[1]))
    return LogSums(prediction.logs[run], len(left), int(own.used.any(axis=1).sum()), joints)


def _of_joint(own: Prediction, j: int, e: np.ndarray) -> JointSums:
    rows = own.used[:, j]
    if not rows.any():
        return NOTHING
    values = np.stack([e[rows], own.measured[rows, j], own.predicted[rows, j]])
    mean = values.mean(axis=1)
    apart = values - mean[:, None]
    top, worst = int(np.nanargmax(np.abs(e))), worst_window(own, e)
    near = (own.time >= worst.start - 0.5 * WINDOW) & (own.time <= worst.end + 0.5 * WINDOW)
    return JointSums(
        count=int(rows.sum()),
        mean=mean,
        scatter=apart @ apart.T,
        largest=Moment(float(abs(e[top])), own.logs[own.run[top]], float(own.time[top])),
        worst=worst,
        close=some_rows(own, near & (own.segment == worst.segment)),
    )


def some_rows(prediction: Prediction, rows: np.ndarray) -> Prediction:
    """Some of the rows, without the samples behind them."""
    found = {name: x[rows] for name, x in vars(prediction).items() if isinstance(x, np.ndarray)}
    return dataclasses.replace(prediction, full=None, **found)
