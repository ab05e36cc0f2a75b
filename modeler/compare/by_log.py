"""The error of each log by itself, when several are compared."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from modeler.compare.prediction import JointInfo
from modeler.compare.sums import LogSums
from modeler.core.brief import Brief
from modeler.core.by_unit import errors_by_unit


@dataclass(frozen=True)
class LogError(Brief):
    """||measured - predicted|| / ||measured|| over the rows of one log that count."""

    log: str
    samples: int  # rows that count for at least one joint
    relative_error: float  # all joints; NaN without torque
    joints: tuple[tuple[str, float], ...]  # by joint name; NaN where nothing counts
    by_unit: Mapping[str, float]  # all joints of one unit; NaN without torque


def log_error(sums: LogSums, joints: Sequence[JointInfo]) -> LogError:
    """Of one log, from the sums over its rows."""
    every = list(zip(joints, sums.joints, strict=True))
    return LogError(
        log=sums.log,
        samples=sums.samples,
        relative_error=sums.relative_error,
        joints=tuple((info.name, own.relative_error) for info, own in every),
        by_unit=errors_by_unit((info.effort_unit, own.energy, own.size) for info, own in every),
    )
