"""Measured against predicted: the numbers of each joint, as table and as JSON."""

import dataclasses
import json
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.compare.prediction import (
    JointInfo,
    Prediction,
    check_prediction,
    relative_error,
    residual,
)
from modeler.compare.spectrum import Spectrum, spectrum
from modeler.compare.structure import Structure, structure
from modeler.compare.where import Region, Window, velocity_regions, worst_window


@dataclass(frozen=True)
class Moment:
    """The sample with the largest absolute residual."""

    value: float  # N m or N, absolute
    log: str
    time: float  # s, as in the log


@dataclass(frozen=True, eq=False)
class JointComparison:
    """How one joint is predicted; N m for a revolute joint, N for a prismatic one."""

    joint: JointInfo
    index: int  # column of the prediction
    samples: int  # rows that count
    relative_error: float  # ||measured - predicted|| / ||measured||
    rms: float  # of the residual
    measured_rms: float
    r2: float  # 1 - ||residual||^2 / ||measured - mean||^2; NaN for a constant torque
    bias: float  # mean residual
    largest: Moment
    regions: tuple[Region, ...]
    worst: Window
    structure: Structure | None  # None: too few samples to tell
    spectrum: Spectrum | None  # None: no segment long enough


@dataclass(frozen=True, eq=False)
class Comparison:
    """What `compare` found; carries the prediction so that pictures can be drawn from it."""

    prediction: Prediction
    samples: int  # rows that count for at least one joint
    relative_error: float  # over all joints, rows stacked (N m and N together); NaN: no torque
    joints: tuple[JointComparison, ...]
    unjudged: tuple[tuple[str, str], ...]  # joint name, why

    def as_dict(self) -> dict[str, Any]:
        """The comparison as plain numbers and text; undefined numbers are None."""
        return {
            "robot": self.prediction.robot,
            "logs": list(self.prediction.logs),
            "samples": self.samples,
            "relative_error": _defined(self.relative_error),
            "joints": {joint.joint.name: _joint_dict(joint) for joint in self.joints},
            "unjudged": dict(self.unjudged),
        }

    def to_json(self) -> str:
        """JSON for scripts; fields may be added, never renamed."""
        return json.dumps(self.as_dict(), indent=1, allow_nan=False) + "\n"

    def summary(self) -> str:
        """Plain-text table, one line per joint, units in the table."""
        head = (
            f"{'joint':<6}{'error':>8}{'rms':>13}{'largest':>13}  {'at':<28}{'R2':>7}{'bias':>13}"
        )
        lines = [head]
        for item in self.joints:
            unit = item.joint.effort_unit
            moment = f"{item.largest.time:.2f} s of {item.largest.log}"
            lines.append(
                f"{item.joint.name:<6}{item.relative_error:>7.1%} "
                f"{item.rms:>8.3g} {unit:<4}{item.largest.value:>8.3g} {unit:<4}  {moment:<28}"
                f"{_or_dash(item.r2, '.3f'):>6} {item.bias:>8.2g} {unit}"
            )
        lines += [f"{name:<6}not judged: {reason}" for name, reason in self.unjudged]
        lines.append(
            f"{'all':<6}{_or_dash(self.relative_error, '.1%'):>7}  of {self.samples} samples"
        )
        return "\n".join(line.rstrip() for line in lines)


def compare(prediction: Prediction) -> Comparison:
    """How well the torque is predicted, where it fails, and whether the residual has structure.

    A joint none of whose rows count, or whose measured torque is zero in all of them, is listed
    in `unjudged` with the reason.

    Raises:
        ShapeError: an array of the prediction has the wrong shape.
        DataError: nothing counts, or a value that counts is not finite.
    """
    check_prediction(prediction)
    e = residual(prediction)
    judged, unjudged = [], []
    for index, info in enumerate(prediction.joints):
        rows = prediction.used[:, index]
        if not rows.any():
            unjudged.append((info.name, "no sample counts (all masked)"))
        elif not prediction.measured[rows, index].any():
            unjudged.append((info.name, "measured torque is zero in every sample that counts"))
        else:
            judged.append(_compare_joint(prediction, index, e[:, index]))
    used = prediction.used
    return Comparison(
        prediction=prediction,
        samples=int(used.any(axis=1).sum()),
        relative_error=relative_error(prediction),
        joints=tuple(judged),
        unjudged=tuple(unjudged),
    )


def _compare_joint(prediction: Prediction, index: int, e: np.ndarray) -> JointComparison:
    rows = prediction.used[:, index]
    counted, measured = e[rows], prediction.measured[rows, index]
    top = int(np.nanargmax(np.abs(e)))
    spread = float(np.sum((measured - measured.mean()) ** 2))
    energy = float(counted @ counted)
    return JointComparison(
        joint=prediction.joints[index],
        index=index,
        samples=int(rows.sum()),
        relative_error=float(np.sqrt(energy) / np.linalg.norm(measured)),
        rms=float(np.sqrt(energy / counted.size)),
        measured_rms=float(np.sqrt(np.mean(measured**2))),
        r2=1.0 - energy / spread if spread > 0.0 else math.nan,
        bias=float(counted.mean()),
        largest=Moment(
            value=float(abs(e[top])),
            log=prediction.logs[prediction.run[top]],
            time=float(prediction.time[top]),
        ),
        regions=velocity_regions(prediction.qd[rows, index], counted),
        worst=worst_window(prediction, e),
        structure=structure(prediction, index),
        spectrum=spectrum(prediction, e),
    )


def _defined(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _or_dash(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else "-"


def _joint_dict(item: JointComparison) -> dict[str, Any]:
    found, colour = item.structure, item.spectrum
    return {
        "relative_error": item.relative_error,
        "rms": item.rms,
        "max": item.largest.value,
        "r2": _defined(item.r2),
        "max_at": {"log": item.largest.log, "time": item.largest.time},
        "unit": item.joint.effort_unit,
        "samples": item.samples,
        "bias": item.bias,
        "regions": [dataclasses.asdict(region) for region in item.regions],
        "worst_window": dataclasses.asdict(item.worst),
        "structure": None
        if found is None
        else {
            "shares": dict(found.shares),
            "together": found.together,
            "across": dict(found.across),
        },
        "spectrum": None
        if colour is None
        else {
            "memory": colour.memory,
            "lag_one": _defined(float(colour.correlation[1])),
            "peak": colour.peak,
            "peak_share": colour.peak_share,
        },
    }
