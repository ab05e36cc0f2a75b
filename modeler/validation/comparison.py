"""Measured against predicted: numbers of each joint, regions, logs, scale; table and JSON."""

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from modeler import regression
from modeler.core.errors import DataError
from modeler.core.json import Document, ShortRepr
from modeler.core.result import Result
from modeler.core.table import (
    POOLED,
    WORDS,
    Column,
    align_columns,
    format_percent,
    format_rows,
    select_columns,
)
from modeler.estimation import IdentifiedModel, read_all_rows, reduce_by_threads
from modeler.numerics import spectra
from modeler.numerics.filters import choose_row_spacing
from modeler.runtime import CompiledModel
from modeler.validation import residual_structure
from modeler.validation.prediction import (
    JointInfo,
    Prediction,
    build_prediction,
    compute_full_rate,
    compute_relative_error,
    compute_residual,
    compute_unit_errors,
    predict_rows,
)
from modeler.validation.thresholds import THRESHOLDS

# The comparison as a table of plain text.


_UNIT = "joint.effort_unit"
JOINT_COLUMNS = (
    Column("joint", "joint.name"),
    Column("relative error", "relative_error", "%", kind="bar", short="error"),
    Column("rms", "rms", ".3g", _UNIT),
    Column("sigma", "predicted_sigma", ".2g", _UNIT),
    Column("rms measured", "measured_rms", ".3g", _UNIT),
    Column("unit", _UNIT, None),
    Column("largest", "largest.value", ".3g", _UNIT),
    Column("at [s]", "largest.time", lambda item: item.largest.describe(), kind="text", short="at"),
    Column("of", "largest.log", None),
    Column("R2", "r2", ".3f"),
    Column("repeatable", "shares.systematic_share", "%"),
    Column("noise", "shares.noise_share", "%"),
    Column("bias", "bias", ".2g", _UNIT),
    Column("samples", "samples"),
)
"""Of the table of joints."""

_SHORT = "joint, relative error, rms, largest, at [s], R2, repeatable, noise, bias"
_LEFT = (0, 4)  # columns of text

METHODS = {
    "laps": "what returns in the other laps of the same log",
    "logs": "what returns in the other logs of the same motion",
    "smooth": "what smooth functions of the motion predict on segments held out (no motion was "
    "made twice)",
}
"""How the repeatable part of a residual was found."""


def describe_methods(comparison: "Comparison") -> list[str]:
    """Describes how the variance shares are estimated, by method."""
    methods = {item.shares.method for item in comparison.joints if item.shares is not None}
    text = "R2, repeatable, noise: shares of the torque's variance; repeatable is "
    return [f"{text}{METHODS[name]}" for name in METHODS if name in methods]


def build_log_columns(comparison: "Comparison") -> list[Column]:
    """Builds the columns of the table of logs: errors by unit, and of each joint."""

    def read(group: str, name: str) -> Callable[["LogError"], float]:
        return lambda log: dict(getattr(log, group))[name]

    several = len(comparison.by_unit) > 1
    units = [("error" + f" {unit}" * several, "by_unit", unit) for unit in comparison.by_unit]
    names = [(f"joint {name}", "joints", name) for name, _ in comparison.logs[0].joints]
    errors = [Column(head, read(group, name), "%") for head, group, name in units + names]
    return [Column("log", "log"), Column("samples", "samples"), *errors]


# Where a joint fails: velocity regions and the worst moment.


WINDOW = 0.5  # s

REGIONS = ("fast -", "slow -", "around zero", "slow +", "fast +")


@dataclass(frozen=True)
class Region(ShortRepr):
    """Residual of one joint in one region of its velocity."""

    name: str
    low: float  # rad/s or m/s
    high: float  # rad/s or m/s
    samples: int
    time_share: float  # of the samples that count
    energy_share: float  # of the summed squared residual
    rms: float  # N m or N; 0 without samples
    bias: float  # mean residual, N m or N; 0 without samples


@dataclass(frozen=True)
class WorstWindow:
    """The segment of one log with the largest summed squared residual."""

    log: str
    segment: int
    start: float  # s, as in the log
    end: float  # s
    energy_share: float  # of the joint's summed squared residual
    time_share: float  # of the joint's samples that count
    rms: float  # N m or N


def compute_velocity_regions(qd: np.ndarray, e: np.ndarray) -> tuple[Region, ...]:
    """Computes the five regions of REGIONS, limits as fractions of the largest speed.

    Args:
        qd: velocity of the rows that count, (n,).
        e: residual of the same rows, (n,).
    """
    top = float(np.abs(qd).max())
    slow, fast = THRESHOLDS.zero_speed_share, THRESHOLDS.fast_share
    edges = np.array([-fast, -slow, slow, fast]) * top
    which = np.searchsorted(edges, qd, side="right")
    which[np.abs(qd) <= slow * top] = 2  # also a joint that never moves
    limits = np.array([-top, *edges, top])
    total = float(e @ e)
    return tuple(
        Region(
            name=name,
            low=float(low),
            high=float(high),
            samples=part.size,
            time_share=part.size / e.size,
            energy_share=float(part @ part) / total if total else 0.0,
            rms=float(np.sqrt(part @ part / part.size)) if part.size else math.nan,
            bias=float(part.mean()) if part.size else math.nan,
        )
        for index, (name, (low, high)) in enumerate(zip(REGIONS, pairwise(limits), strict=True))
        for part in [e[which == index]]
    )


def find_worst_window(prediction: Prediction, e: np.ndarray, width: float = WINDOW) -> WorstWindow:
    """Finds the window of `width` seconds in one segment with the largest residual energy.

    Args:
        prediction: for log, segment and time of the rows.
        e: residual of one joint on all rows, (n,), NaN where the row does not count.
        width: s; a shorter segment is one window.
    """
    square = np.nan_to_num(e) ** 2
    energy = np.concatenate(([0.0], np.cumsum(square)))
    counted = np.concatenate(([0], np.cumsum(np.isfinite(e))))
    best, first, last = -1.0, 0, 0
    for span in spectra.find_segment_slices(prediction.segment):
        time = prediction.time[span]
        # half a sample of slack, so that rounding of the time stamps does not cost a row
        slack = 0.5 * float(np.median(np.diff(time))) if time.size > 1 else 0.0
        stop = span.start + np.searchsorted(time, time + width - slack, side="right")
        inside = energy[stop] - energy[span.start : span.stop]
        top = int(np.argmax(inside))
        if inside[top] > best:
            best, first, last = float(inside[top]), span.start + top, int(stop[top])
    rows = int(counted[last] - counted[first])
    total = float(energy[-1])
    return WorstWindow(
        log=prediction.logs[prediction.run[first]],
        segment=int(prediction.segment[first]),
        start=float(prediction.time[first]),
        end=float(prediction.time[last - 1]),
        energy_share=best / total if total else 0.0,
        time_share=rows / int(counted[-1]),
        rms=float(np.sqrt(best / rows)) if rows else 0.0,
    )


@dataclass(frozen=True)
class Scale:
    """measured = factor * predicted, by least squares: no constant, which nobody could apply."""

    factor: float
    variance_reduction: (
        float  # share of the squared residual that the factor of other blocks takes away
    )

    @property
    def has_opposite_sign(self) -> bool:
        """Returns True if the prediction has the wrong sign."""
        return (
            self.factor < THRESHOLDS.max_opposite_factor
            and self.variance_reduction > THRESHOLDS.min_scale_reduction
        )

    @property
    def has_wrong_factor(self) -> bool:
        """Returns True if the prediction is right but for a factor."""
        return (
            abs(self.factor - 1.0) > THRESHOLDS.min_scale_error
            and self.variance_reduction > THRESHOLDS.min_scale_reduction
        )


def estimate_scale(measured: np.ndarray, predicted: np.ndarray) -> Scale | None:
    """Estimates the factor between torques, (n,) in order of time; None for too few samples."""
    blocks = np.arange(measured.size) * THRESHOLDS.scale_blocks // max(1, measured.size)
    squares, cross = (
        np.bincount(blocks, predicted * x, THRESHOLDS.scale_blocks) for x in (predicted, measured)
    )
    if measured.size < THRESHOLDS.min_scale_samples or not np.all(squares.sum() - squares > 0.0):
        return None
    elsewhere = (cross.sum() - cross) / (squares.sum() - squares)
    before = float(np.sum((measured - predicted) ** 2))
    after = float(np.sum((measured - elsewhere[blocks] * predicted) ** 2))
    return Scale(
        factor=float(cross.sum() / squares.sum()),
        variance_reduction=1.0 - after / before if before > 0.0 else 0.0,
    )


@dataclass(frozen=True)
class LogError(ShortRepr, Document):
    """||measured - predicted|| / ||measured|| over the rows of one log that count."""

    KEYS = "log samples relative_error by_unit joints=joint_errors"

    log: str
    samples: int  # rows that count for at least one joint
    relative_error: float  # all joints; NaN without torque
    joints: tuple[tuple[str, float], ...]  # by joint name; NaN where nothing counts
    by_unit: Mapping[str, float]  # all joints of one unit; NaN without torque

    @property
    def joint_errors(self) -> dict[str, float]:
        """Returns the errors by joint; NaN where nothing counts."""
        return dict(self.joints)


def compute_errors_by_log(prediction: Prediction) -> tuple[LogError, ...]:
    """Computes the relative errors of each log, in their order."""
    e = np.nan_to_num(compute_residual(prediction))
    measured = np.where(prediction.used, prediction.measured, 0.0)
    log_errors = []
    for run, log in enumerate(prediction.logs):
        rows = prediction.run == run
        joints = tuple(
            (info.name, _compute_error_ratio(e[rows, j], measured[rows, j]))
            for j, info in enumerate(prediction.joints)
        )
        samples = int(prediction.used[rows].any(axis=1).sum())
        whole = _compute_error_ratio(e[rows], measured[rows])
        by_unit = compute_unit_errors(prediction, rows)
        log_errors.append(LogError(log, samples, whole, joints, by_unit))
    return tuple(log_errors)


def _compute_error_ratio(e: np.ndarray, measured: np.ndarray) -> float:
    size = float(np.linalg.norm(measured))
    return float(np.linalg.norm(e)) / size if size > 0.0 else float("nan")


@dataclass(frozen=True)
class Moment(Document):
    """The sample with the largest absolute residual."""

    KEYS = "log time"

    value: float  # N m or N, absolute
    log: str
    time: float  # s, as in the log

    def describe(self) -> str:
        """Returns when it was."""
        return f"{self.time:.2f} s of {self.log}"


@dataclass(frozen=True, eq=False)
class JointComparison(ShortRepr, Document):
    """How one joint is predicted; N m for a revolute joint, N for a prismatic one."""

    KEYS = """
        relative_error rms max=largest.value r2 max_at=largest unit=joint.effort_unit samples bias
        predicted_sigma regions worst_window=worst structure spectrum explained_share=r2
        systematic_share=shares.systematic_share noise_share=shares.noise_share method=shares.method
        systematic_sigma=shares.sigma scale orders=order_peaks
    """

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
    worst: WorstWindow
    structure: residual_structure.ResidualStructure | None  # None: too few samples to show
    spectrum: spectra.ResidualSpectrum | None  # None: no segment long enough
    shares: residual_structure.VarianceShares | None  # None: too few samples to show
    scale: Scale | None  # None: too few samples, or a constant
    orders: spectra.OrderSpectrum | None  # None: too few samples, or the joint rests
    predicted_sigma: float | None  # rms standard deviation of the prediction; None: not known

    @property
    def order_peaks(self) -> tuple[residual_structure.SpectralLine, ...] | None:
        """Returns the ripples of the residual, largest first; None where nothing tells."""
        if self.orders is None:
            return None
        return tuple(residual_structure.find_order_peaks(self.orders, self.joint.unit))


@dataclass(frozen=True, eq=False)
class Comparison(Result, Document):
    """What `compare` found; carries the prediction so that pictures can be drawn from it."""

    KEYS = """
        robot=prediction.robot logs=prediction.logs samples relative_error relative_error_pools
        by_unit joints=joints[joint.name] excluded_joints=excluded_reasons by_log=logs
        repeated_motions
    """

    prediction: Prediction
    samples: int  # rows that count for at least one joint
    relative_error: float  # over all joints, rows stacked (N m and N together); NaN: no torque
    joints: tuple[JointComparison, ...]
    excluded_joints: tuple[tuple[str, str], ...]  # joint name, why
    logs: tuple[LogError, ...]
    repeated_motions: tuple[residual_structure.Repetition, ...]  # empty: no motion was made twice
    by_unit: Mapping[str, float]  # relative error over the joints of one unit; NaN: no torque

    def summary(self) -> str:
        """Returns plain text: one line per joint, what the shares mean, one line per log."""
        rows = format_rows(select_columns(JOINT_COLUMNS, _SHORT), self.joints)
        lines = align_columns(rows, _LEFT)
        names = max((len(name) for name, _ in self.excluded_joints), default=0)
        width = max(7, names + 1, *(len(row[0]) + 2 for row in rows))
        lines += [f"{name:<{width}}not judged: {reason}" for name, reason in self.excluded_joints]
        if len(self.by_unit) == 1:
            lines.append(
                f"{'all':<{width}}{format_percent(self.relative_error)}  of {self.samples} samples"
            )
        else:  # N m and N add up to nothing
            lines += [
                f"{'all':<{width}}{format_percent(error)}  of the {WORDS[unit]}s ({unit})"
                for unit, error in self.by_unit.items()
            ]
            lines.append(f"{self.samples} samples")
        lines += describe_methods(self)
        if len(self.logs) > 1:
            lines += ["", *align_columns(format_rows(build_log_columns(self), self.logs), (0,))]
        return "\n".join(line.rstrip() for line in lines)

    @property
    def relative_error_pools(self) -> str:
        """Returns what `relative_error` puts together."""
        return POOLED

    @property
    def excluded_reasons(self) -> dict[str, str]:
        """Returns why joints are not judged, by name."""
        return dict(self.excluded_joints)


def compare(prediction: Prediction, ripple_windows: Prediction | None = None) -> Comparison:
    """Evaluates how well torques are predicted, where they fail, and the residual's structure.

    A joint none of whose rows count, or whose measured torque is zero in all of them, is listed
    in `unjudged` with the reason.

    Args:
        prediction: measured and predicted.
        ripple_windows: windows of long logs with the samples behind their rows, where ripple is
            looked for.
    """
    e = compute_residual(prediction)
    repeated = residual_structure.find_repetitions(prediction)
    judged, unjudged = [], []
    for index, info in enumerate(prediction.joints):
        rows = prediction.used[:, index]
        if not rows.any():
            unjudged.append((info.name, "no sample counts (all masked)"))
        elif not prediction.measured[rows, index].any():
            unjudged.append((info.name, "measured torque is zero in every sample that counts"))
        else:
            judged.append(_compare_joint(prediction, index, e[:, index], repeated, ripple_windows))
    used = prediction.used
    return Comparison(
        prediction=prediction,
        samples=int(used.any(axis=1).sum()),
        relative_error=compute_relative_error(prediction),
        joints=tuple(judged),
        excluded_joints=tuple(unjudged),
        logs=compute_errors_by_log(prediction),
        repeated_motions=repeated,
        by_unit=compute_unit_errors(prediction),
    )


def _compare_joint(
    prediction: Prediction,
    index: int,
    e: np.ndarray,
    repeated: tuple[residual_structure.Repetition, ...],
    ripple_windows: Prediction | None,
) -> JointComparison:
    rows = prediction.used[:, index]
    counted, measured = e[rows], prediction.measured[rows, index]
    top = int(np.nanargmax(np.abs(e)))
    spread = float(np.sum((measured - measured.mean()) ** 2))
    energy = float(counted @ counted)
    joint_structure, sigma = residual_structure.analyse_structure(prediction, index), None
    if prediction.sigma is not None:
        sigma = float(np.sqrt(np.mean(prediction.sigma[rows, index] ** 2)))
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
            float(abs(e[top])), prediction.logs[prediction.run[top]], float(prediction.time[top])
        ),
        regions=compute_velocity_regions(prediction.qd[rows, index], counted),
        worst=find_worst_window(prediction, e),
        structure=joint_structure,
        spectrum=spectra.estimate_residual_spectrum(prediction.time, prediction.segment, e),
        shares=residual_structure.split_variance(prediction, index, e, repeated, joint_structure),
        scale=estimate_scale(measured, prediction.predicted[rows, index]),
        orders=residual_structure.compute_ripple_spectrum(ripple_windows or prediction, index),
        predicted_sigma=sigma,
    )


# Comparisons of logs of any length.


@dataclass(frozen=True, eq=False)
class _ChunkPrediction:
    """Some consecutive rows of a log: what is compared of each chunk, and what they say of it."""

    rows: tuple[Prediction, ...]
    facts: regression.LogFacts

    def merged_with(self, later: "_ChunkPrediction") -> "_ChunkPrediction":
        """Returns these rows and those that follow them."""
        return _ChunkPrediction(self.rows + later.rows, self.facts.merged_with(later.facts))


def compare_long_logs(
    model: IdentifiedModel,
    sources: Sequence[regression.Source],
    compiled: CompiledModel,
    progress: Callable[[float], None] = lambda share: None,
    rows: int = regression.FINGER,
) -> tuple[Comparison, regression.Observation]:
    """Compares logs of any length in bounded memory, as `compare` does what `predict` returns.

    Args:
        model: fitted.
        sources: of the logs.
        compiled: its robot.
        progress: receives the share of the rows that are done.
        rows: of a chunk, at least.

    Raises:
        DataError: as `estimation.long_logs.stream`.
    """
    processing = model.processing
    least = -(-sum(source.rows for source in sources) // THRESHOLDS.max_rows)
    step = sources[0].read_window(0.5, 1000).step
    if least > choose_row_spacing(step, processing.parallel_cutoff or 0.0, processing.decimation):
        processing = dataclasses.replace(processing, decimation=least)
    reducer = partial(reduce_by_threads, reduce_by=partial(_predict_chunk, model))
    passes, parts = read_all_rows(compiled, sources, processing, progress, rows, reducer)
    windows = passes.survey.observation
    steps = [log_part.step * log_part.decimation for log_part in passes.survey.chosen]
    prediction = _join_chunks(
        [source.name for source in sources], [log_part.rows for log_part in parts], steps
    )
    full = compute_full_rate(windows, compiled, model.beta)
    ripples = dataclasses.replace(build_prediction(windows, windows.torque), full=full)
    report = regression.build_streamed_report(compiled, sources, passes)
    return compare(prediction, ripples), dataclasses.replace(windows, report=report)


def _predict_chunk(
    model: IdentifiedModel,
    compiled: CompiledModel,
    chunk: regression.Chunk,
    chosen: regression.LogChoices,
) -> _ChunkPrediction:
    stretches, facts = regression.build_chunk_rows(compiled, chunk, chosen)
    some = tuple(part for part in stretches if len(part.rows.centres))
    if not some:
        return _ChunkPrediction((), facts)
    report = regression.DataReport(chosen.processing, (), (), ())
    observation = regression.assemble_observation(compiled, (chunk.log.name,), some, report)
    return _ChunkPrediction((predict_rows(model, observation, compiled),), facts)


def _join_chunks(
    names: Sequence[str], logs: Sequence[Sequence[Prediction]], steps: Sequence[float]
) -> Prediction:
    """The rows of all logs, `steps` s apart; what goes on in the next chunk is one segment."""
    number, chunks = -1, list[Prediction]()
    for run, (parts, step) in enumerate(zip(logs, steps, strict=True)):
        last = -np.inf
        for part in parts:
            number += not 0.5 < (part.time[0] - last) / step < 1.5
            segment, runs = part.segment + number, np.full(len(part.time), run)
            chunks.append(dataclasses.replace(part, segment=segment, run=runs))
            number, last = int(segment[-1]), float(part.time[-1])
    if not chunks:
        raise DataError(f"{', '.join(names)}: no row is left; record longer motion")
    columns = [
        name
        for name in vars(chunks[0])
        if all(isinstance(getattr(part, name), np.ndarray) for part in chunks)
    ]
    every: dict[str, Any] = {"temperature": None} | {
        name: np.concatenate([getattr(part, name) for part in chunks]) for name in columns
    }
    return dataclasses.replace(chunks[0], logs=tuple(names), **every)
