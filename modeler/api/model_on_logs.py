"""A model on logs as screens show it: torques over time, residuals over any channel of the logs."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler import validation
from modeler.api.log_windows import LogWindows
from modeler.api.thresholds import THRESHOLDS
from modeler.core.errors import DataError
from modeler.core.figure import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PINK,
    SKY,
    VERMILLION,
    Curve,
    Heat,
    Means,
    Panel,
    Picture,
    Points,
    Series,
    Style,
    thin_curves,
    thin_points,
)
from modeler.validation import Prediction, compute_residual, concatenate_time

_MEASURED = Style(BLACK, width=1.1)
_OF_MODELS = (ORANGE, BLUE, GREEN, PINK, VERMILLION, SKY)
_SHARES = (
    "Share of each joint's residual variance, in percent, that a curve over that channel predicts "
    "on motion not used to draw it; empty: too few samples. Coordinates move together: "
    "shares overlap. Choose a cell to look at it."
)


@dataclass(frozen=True)
class Verdict:
    """How good a model is on logs, joint by joint.

    Attributes:
        joints: names, in order.
        errors: relative, of each.
        sentences: of each, as `modeler compare` says it.
        channels: of each: id and label of what its residual can be drawn over.
        start, end: of the time axis of the pictures, s.
        kinds: of each, what is left: "pattern", "noise", "other", or "untold" by too few samples.
        unjudged: lines on joints that cannot be judged, and why.
    """

    joints: tuple[str, ...]
    errors: tuple[float, ...]
    sentences: tuple[str, ...]
    channels: tuple[tuple[str, str], ...]
    start: float
    end: float
    kinds: tuple[str, ...]
    unjudged: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class ModelOnLogs:
    """A model and its comparison with logs.

    Attributes:
        title: of the model in pictures of several.
        comparison: with the logs.
        logs: places of them.
        open_log: reads all columns of one of them, by the names that the model has for them.
    """

    title: str
    comparison: validation.Comparison
    logs: tuple[str, ...]
    open_log: Callable[[str], LogWindows]

    @property
    def prediction(self) -> Prediction:
        """Returns measured and predicted torques."""
        return self.comparison.prediction

    def find_joint(self, joint: str) -> int:
        """Returns the index of a joint."""
        names = [info.name for info in self.prediction.joints]
        return names.index(joint)

    def describe(self) -> Verdict:
        """Returns the result of `modeler compare MODEL LOG...` for every joint."""
        time, items = concatenate_time(self.prediction)[0], self.comparison.joints
        return Verdict(
            tuple(item.joint.name for item in items),
            tuple(float(item.relative_error) for item in items),
            tuple(map(validation.write_joint_verdict, items)),
            tuple(self.list_channels()),
            float(time.min()),
            float(time.max()),
            tuple(map(_classify_remainder, items)),
            tuple(f"Joint {j}: not judged: {why}" for j, why in self.comparison.excluded_joints),
        )

    def list_channels(self) -> list[tuple[str, str]]:
        """Returns id and label: coordinates of the motion, then all other columns of the log."""
        joints = self.prediction.joints
        channels = {
            coordinate.id: coordinate.label
            for j in range(len(joints))
            for coordinate in validation.select_coordinates(self.prediction, j)
        }
        first = self.open_log(self.logs[0])
        if not first.is_coarse:  # of a long log only windows are held
            motion = {f"{k}{joint.name}" for joint in joints for k in ("q", "qd", "qdd", "tau")}
            channels |= {name: name for name in first.values if name not in {*motion, "segment"}}
        return list(channels.items())

    def read_channel(self, j: int, channel: str) -> tuple[np.ndarray, str]:
        """Returns values of a channel on all rows, NaN where the log has none, and its label.

        Args:
            j: index of the joint.
            channel: an id of `list_channels`.
        """
        p = self.prediction
        labels = {each.id: each.label for each in validation.select_coordinates(p, j)}
        if channel in labels:
            unit = validation.format_coordinate_unit(p, j, channel)
            values = validation.evaluate_coordinate(p, j, channel)
            return np.asarray(values, dtype=float), f"{labels[channel]} [{unit}]"
        values, label = np.full(p.time.size, np.nan), channel
        for run, place in enumerate(self.logs):
            rows, log = p.run == run, self.open_log(place)
            if channel in log.values and rows.any():
                values[rows] = np.interp(p.time[rows], log.time, log.values[channel])
                unit = log.units.get(channel, "")
                label = f"{channel} [{unit}]" if unit else channel
        return values, label

    def sample_motion(self, points: int = 6000) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Returns time on the axis of the pictures and position of every joint, rad or m."""
        p, time = self.prediction, concatenate_time(self.prediction)[0]
        rows = np.arange(0, time.size, -(-time.size // points))
        return time[rows], {info.name: p.q[rows, j] for j, info in enumerate(p.joints)}

    def draw_explained_shares(self) -> Picture:
        """Draws the share of each joint's residual variance that each channel explains.

        Of coordinates of the motion as `modeler compare` has it, of other columns as
        `compute_explained_share`.
        """
        p, items = self.prediction, self.comparison.joints
        names = [channel for channel, _ in self.list_channels()]
        values = np.full((len(items), len(names)), np.nan)
        for i, item in enumerate(items):
            if item.structure is None:
                continue
            coordinates = {c.id for c in validation.select_coordinates(p, item.index)}
            for k, name in enumerate(names):
                if name in coordinates:
                    values[i, k] = 100.0 * item.structure.get_share(name)
                    continue
                x, _ = self.read_channel(item.index, name)
                rows = p.used[:, item.index] & np.isfinite(x)
                e = compute_residual(p)[rows, item.index]
                values[i, k] = 100.0 * compute_explained_share(x[rows], e)
        texts = tuple(tuple("" if np.isnan(v) else f"{v:.0f}" for v in row) for row in values)
        joints = tuple(item.joint.name for item in items)
        heat = Heat("explained share", tuple(names), joints, values, texts, 100.0)
        title, panels = "Residual: which joint follows what", ((Panel("", "", "joint", (heat,)),),)
        return Picture("where", title, _SHARES, panels, 110 + 34 * len(joints))


def _classify_remainder(item: validation.JointComparison) -> str:
    """What is left of a joint, which too few samples may not show; a large error is no noise."""
    kind = validation.classify_residual(item)
    is_determined = kind != "other" or item.structure is not None or validation.is_too_large(item)
    return kind if is_determined else "untold"


def draw_torques(
    models: Sequence[ModelOnLogs], joint: str, start: float = -np.inf, end: float = np.inf
) -> Picture:
    """Draws measured and predicted torque of a joint over time, and the residual below.

    Args:
        models: on the same logs; each is overlaid.
        joint: its name.
        start: on the axis of the picture, s; logs stand one after the other.
        end: the same.
    """
    first, j = models[0].prediction, models[0].find_joint(joint)
    time, label, marks = concatenate_time(first)
    rows = _select_between(time, start, end)

    def build_curve(
        p: Prediction, name: str, values: np.ndarray, shown: np.ndarray, style: Style
    ) -> Curve:
        thinned = thin_curves((np.asarray(values[shown], dtype=float),), THRESHOLDS.curve_points)
        part, axis = shown[thinned], concatenate_time(p)[0]
        return validation.build_time_curve(name, p.segment[part], axis[part], values[part], style)

    above: list[Series] = [build_curve(first, "measured", first.measured[:, j], rows, _MEASURED)]
    below: list[Series] = []
    for k, model in enumerate(models):
        style = Style(_OF_MODELS[k % len(_OF_MODELS)], width=1.4, opacity=0.9)
        p, alone = model.prediction, len(models) == 1
        shown = _select_between(concatenate_time(p)[0], start, end)  # rows of another model differ
        predicted, residual = ("predicted", "residual") if alone else (model.title, model.title)
        above.append(build_curve(p, predicted, p.predicted[:, j], shown, style))
        below.append(build_curve(p, residual, compute_residual(p)[:, j], shown, style))
    unit = first.joints[j].effort_unit
    spans = validation.find_masked_spans(first, j, time, rows)
    ends = float(time[rows[0]]), float(time[rows[-1]])
    both = {"marks": marks, "spans": spans, "x_range": ends}
    torque, left = validation.build_torque_panels("", label, unit, above, below, **both)
    title, caption = f"Joint {joint}: measured and predicted", validation.describe_masks(first, j)
    panels = ((torque,), (left,))
    return Picture(f"torque_{joint}", title, caption, panels, 430, True, (0.6, 0.4))


def _select_between(time: np.ndarray, start: float, end: float) -> np.ndarray:
    """Rows from one time to another; all where there are none."""
    rows = np.flatnonzero((time >= start) & (time <= end))
    return np.arange(time.size) if rows.size < 2 else rows


def draw_residuals(
    models: Sequence[ModelOnLogs], joint: str, channel: str, by_log: bool = False
) -> Picture:
    """Draws the residual of a joint over a channel: samples, means with two standard errors.

    Args:
        models: on the same logs.
        joint: its name.
        channel: an id of `Verdict.channels`.
        by_log: True: means of each log; else of each model.
    """
    parts: list[tuple[str, np.ndarray, np.ndarray]] = []
    unit = label = ""
    for model in models:
        p, j = model.prediction, model.find_joint(joint)
        x, label = model.read_channel(j, channel)
        e, rows = compute_residual(p)[:, j], p.used[:, j] & np.isfinite(x)
        name = f"{model.title}: " if len(models) > 1 else ""
        for run, log in enumerate(p.logs) if by_log else [(-1, "")]:
            log_rows = rows & (p.run == run) if by_log else rows
            parts.append((name + log, x[log_rows], e[log_rows]))
        unit = p.joints[j].effort_unit
    if not any(x.size for _, x, _ in parts):
        raise DataError(f"joint {joint}: no row that counts has a value of {channel}")
    series: list[Series] = []
    for k, (name, x, e) in enumerate(parts):
        style = Style(_OF_MODELS[(k + 1) % len(_OF_MODELS)], width=1.6)
        thinned = thin_points(x, e, THRESHOLDS.curve_points)
        cloud = Style(style.color if len(parts) > 1 else GREY, width=2.6, opacity=0.35)
        series.append(Points(f"{name} samples".strip(), x[thinned], e[thinned], cloud))
        if x.size:
            means = f"{name} mean, 2 standard errors".strip()
            series.append(Means(means, *validation.compute_binned_means(x, e), style))
    panel = Panel("", label, f"residual [{unit}]", tuple(series), zero=True)
    title = f"Joint {joint}: residual over {label}"
    return Picture(f"residual_{joint}_{channel}", title, "", ((panel,),), 360)


def compute_explained_share(x: np.ndarray, e: np.ndarray) -> float:
    """Computes the cross-validated share of the variance of e that bin means over x explain.

    1 - sum (e - m)^2 / sum (e - mean e)^2, 0 at least; m is the mean of the bin over all other
    parts of the time. Bins are alike in count, or one for each value where there are few.

    Args:
        x: (n,) channel, in time order.
        e: (n,) residual.
    """
    bins, folds = THRESHOLDS.explained_bins, THRESHOLDS.explained_folds
    if x.size < 4 * bins or np.ptp(x) == 0.0:
        return np.nan
    edges, which = np.unique(x, return_inverse=True)
    if edges.size > bins:
        edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, bins + 1)))
        which = np.searchsorted(edges[1:-1], x, side="right")
    fold, predicted = np.arange(x.size) * folds // x.size, np.empty(x.size)
    for part in range(folds):
        other = fold != part
        count = np.bincount(which[other], minlength=which.max() + 1)
        total = np.bincount(which[other], e[other], minlength=which.max() + 1)
        mean = np.where(count > 0, total / np.maximum(count, 1), e[other].mean())
        predicted[~other] = mean[which[~other]]
    whole = float(np.sum((e - e.mean()) ** 2))
    return max(0.0, 1.0 - float(np.sum((e - predicted) ** 2)) / whole) if whole else 0.0
