"""An exciting motion, what it is worth, and the files it goes to."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from modeler.core.errors import DataError
from modeler.core.json import Change, Document, ShortRepr
from modeler.core.result import Result
from modeler.core.table import align_columns
from modeler.core.toml_cells import join_names
from modeler.excitation.limits import ClearanceReport, ClosestApproach, MotionBounds
from modeler.excitation.series import MotionSeries, compute_signals, export_coefficients
from modeler.excitation.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel


@dataclass(frozen=True)
class MotionQuality:
    """How well a motion distinguishes parameters.

    Attributes:
        condition: of W, rows weighted, columns of length one.
        condition_raw: of W, rows weighted.
        log_det: log det(W^T W), rows weighted.
    """

    condition: float
    condition_raw: float
    log_det: float


@dataclass(frozen=True, eq=False)
class LimitUsage(ShortRepr):
    """What a motion uses of its limits, (J,) each, SI.

    Attributes:
        lower, upper: least and largest position.
        speed, acceleration: largest ones.
        torque: largest one; None where no parameters are known.
        posture: largest share of what boxes, joints that follow and loops allow; None without.
        loops: of it, what the distance from singular postures allows; None without loops.
    """

    lower: np.ndarray
    upper: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray
    torque: np.ndarray | None
    posture: float | None
    loops: float | None


@dataclass(frozen=True)
class BoundUsage:
    """A limit, what a motion uses of it, and what is left; None of infinite and unknown ones."""

    limit: float | None
    value: float | None
    slack: float | None


@dataclass(frozen=True)
class JointUsage:
    """What a motion uses of the limits of one joint, SI."""

    lower: BoundUsage
    upper: BoundUsage
    speed: BoundUsage
    acceleration: BoundUsage
    torque: BoundUsage


@dataclass(frozen=True)
class RandomMotions:
    """Random motions as large as the limits allow; condition numbers of columns of length one."""

    count: int
    condition_scaled_best: float
    condition_scaled_median: float
    log_det_best: float


@dataclass(frozen=True, eq=False)
class InformationGain(ShortRepr, Document):
    """What a log of a motion adds to logs that there are.

    Attributes:
        names, units: (c,) of the base parameters.
        before: their sigmas by the logs that there are; None: those do not identify it.
        after: those to expect of these logs and the next one, by the rules of the same fit.
        logs: names of the logs that there are.
        condition: of their rows, and with those of the next one; columns of length one.
    """

    KEYS = "logs condition_scaled=condition_change sigmas=sigma_changes"

    names: tuple[str, ...]
    units: tuple[str, ...]
    before: tuple[float | None, ...]
    after: tuple[float | None, ...]
    logs: tuple[str, ...]
    condition: tuple[float, float]

    def format_lines(self) -> list[str]:
        """Formats lines of text: what gains most, first."""
        rows = []
        for name, unit, a, b in zip(self.names, self.units, self.before, self.after, strict=True):
            cells = ["not determined" if value is None else f"{value:.3g}" for value in (a, b)]
            gain = a / b if a and b else np.inf if b else 1.0
            rows.append((gain, (name, *cells, unit, f"/ {gain:.3g}" if a and b else "")))
        rows.sort(key=lambda row: -row[0])
        count = THRESHOLDS.max_listed_parameters
        head, shown = ("parameter", "sigma before", "expected after", "unit", ""), rows[:count]
        table = align_columns([head, *(cells for _, cells in shown)], (0, 3))
        return [
            f"beside {', '.join(self.logs)}: condition number with columns of length one "
            "{:.4g} before, {:.4g} with it; it sharpens".format(*self.condition),
            *(line.rstrip() for line in table),
            *([f"and {len(rows) - count} others, less"] if len(rows) > count else []),
        ]

    @property
    def condition_change(self) -> Change:
        """Returns the condition number of the rows, and with those of the next log."""
        return Change(*self.condition)

    @property
    def sigma_changes(self) -> dict[str, Change]:
        """Returns the sigmas by parameter."""
        rows = zip(self.names, self.before, self.after, strict=True)
        return {name: Change(before, after) for name, before, after in rows}


@dataclass(frozen=True, eq=False)
class ExcitingMotion(Result, Document):
    """A motion that excites a robot.

    Attributes:
        robot: name.
        bounds: its limits.
        request: what was requested.
        series: of the motion.
        x: (J, 2 K - 1) its coefficients.
        quality: of it.
        random_count: random motions that it is compared with, as large as limits allow.
        random: best and median condition number of them.
        random_log_det: the best of them.
        usage: of the limits.
        columns: names of the parameters that count.
        beta: (c,) for torques; None where unknown.
        has_ended_early: True if the time limit ended the search.
        seconds: that it took.
        closest_approach: where links come closest; None where they are not looked at.
        information_gain: what it adds to logs; None without.
    """

    KEYS = """
        robot *request condition_number=quality.condition_raw condition_scaled=quality.condition
        log_det=quality.log_det random_motions parameters=columns joints=joint_usage
        boxes=bounds.boxes posture_share=usage.posture singular_share=usage.loops clearance
        has_ended_early information_gain series=coefficients
    """

    robot: str
    bounds: MotionBounds
    request: Mapping[str, Any]
    series: MotionSeries
    x: np.ndarray
    quality: MotionQuality
    random_count: int
    random: tuple[float, float]
    random_log_det: float
    usage: LimitUsage
    columns: tuple[str, ...]
    beta: np.ndarray | None
    has_ended_early: bool
    seconds: float
    closest_approach: ClosestApproach | None = None
    information_gain: InformationGain | None = None

    def sample_motion(self, rate: float) -> dict[str, np.ndarray]:
        """Samples time, q, qd and qdd of every joint, from rest to rest, by name."""
        laps, period = int(self.request["laps"]), self.series.duration
        count = int(np.ceil(laps * period * rate - 1e-9)) + 1
        times = np.arange(count) / rate
        # The last sample is at or just after the end, where the robot rests.
        place = np.where(times >= laps * period, 0.0, np.mod(times, period))
        here, columns = self.series.resample_at(place).evaluate_motion(self.x), {"time": times}
        for prefix, values in zip(("q", "qd", "qdd"), here, strict=True):
            for j, name in enumerate(self.bounds.joints):
                columns[f"{prefix}{name}"] = np.round(values[:, j], THRESHOLDS.sample_digits) + 0.0
        return columns

    def format_lines(self) -> list[str]:
        """Formats the motion's quality and its use of the limits as lines of text."""
        best, median = self.random
        lines = [
            f"condition number {self.quality.condition:.4g} with columns of length one "
            f"({self.quality.condition_raw:.4g} as they are); best of {self.random_count} random "
            f"motions {best:.4g}, median {median:.4g}",
            f"log det of the information {self.quality.log_det:.5g}, best of {self.random_count} "
            f"random {self.random_log_det:.5g}",
            f"{'joint':<6}{'positions':>20}{'of limits':>20}{'speed':>14}{'acceleration':>16}"
            f"{'torque':>16}",
        ]
        b, u = self.bounds, self.usage
        for j, name in enumerate(b.joints):
            torque = "-" if u.torque is None else f"{u.torque[j]:.4g}"
            if np.isfinite(b.torque[j]):
                torque += f" of {b.torque[j]:.4g}"
            lines.append(
                f"{name:<6}{_format_range(u.lower[j], u.upper[j]):>20}"
                f"{_format_range(b.lower[j], b.upper[j]):>20}"
                f"{f'{u.speed[j]:.3g} of {b.speed[j]:.3g}':>14}"
                f"{f'{u.acceleration[j]:.3g} of {b.acceleration[j]:.3g}':>16}{torque:>16}"
            )
        if b.assumed:
            lines.append(
                f"no limits are stated for {join_names(b.assumed)}: those above are assumed; "
                "correct them by [limits] or --limit before a robot moves"
            )
        if u.loops is not None:
            lines.append(
                f"joints that follow turn at most {2.0 * u.loops:.3g} times as fast as at home, of "
                "2 allowed: near a singular posture they would be infinitely fast"
            )
        if b.clearance is not None:
            lines.append(b.clearance.format_line(self.closest_approach))
        if self.has_ended_early:
            lines.append("the time limit ended the search: another run may find another motion")
        return [*lines, *(self.information_gain.format_lines() if self.information_gain else [])]

    @property
    def random_motions(self) -> "RandomMotions":
        """Returns the random motions that it is compared with."""
        return RandomMotions(self.random_count, *self.random, self.random_log_det)

    @property
    def joint_usage(self) -> dict[str, "JointUsage"]:
        """Returns the limits of each joint, and what the motion uses of them."""
        b, u = self.bounds, self.usage
        return {
            name: JointUsage(
                _build_bound_usage(b.lower[j], u.lower[j], least=True),
                _build_bound_usage(b.upper[j], u.upper[j]),
                _build_bound_usage(b.speed[j], u.speed[j]),
                _build_bound_usage(b.acceleration[j], u.acceleration[j]),
                _build_bound_usage(b.torque[j], None if u.torque is None else u.torque[j]),
            )
            for j, name in enumerate(b.joints)
        }

    @property
    def clearance(self) -> ClearanceReport | None:
        """Returns what links keep from each other; None where they are not looked at."""
        clearance = self.bounds.clearance
        return None if clearance is None else ClearanceReport(clearance, self.closest_approach)

    @property
    def coefficients(self) -> Mapping[str, Any]:
        """Returns the family of the motion, its period and its coefficients by joint."""
        return export_coefficients(self.series, self.x, self.bounds.joints)


def encode_parquet(columns: Mapping[str, np.ndarray]) -> bytes:
    """Encodes columns as Parquet."""
    buffer = io.BytesIO()
    pq.write_table(pa.table({name: pa.array(values) for name, values in columns.items()}), buffer)
    return buffer.getvalue()


def format_csv(columns: Mapping[str, np.ndarray]) -> str:
    """Formats columns as CSV, twelve digits."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    rows = np.column_stack([*columns.values()])
    writer.writerows([f"{value:.12g}" for value in row] for row in rows)
    return out.getvalue()


def _build_bound_usage(limit: float, used: float | None, least: bool = False) -> BoundUsage:
    most = float(limit) if np.isfinite(limit) else None
    value = None if used is None else float(used)
    slack = None if most is None or value is None else value - most if least else most - value
    return BoundUsage(most, value, slack)


def _format_range(low: float, high: float) -> str:
    return f"{low:.3g} to {high:.3g}"


# A picture of a motion against its limits.


KINDS = ("png", "svg", "pdf")

_SETTINGS: Any = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 9.5,
    "svg.hashsalt": "modeler",
}
_NO_DATE: dict[str, dict[str, None]] = {
    "png": {"Software": None},
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Producer": None, "Creator": None},
}


def check_picture_kind(name: str) -> str:
    """Returns the kind of picture that a file name asks for.

    Raises:
        DataError: none of ours.
    """
    kind = name.rpartition(".")[2].lower()
    if kind not in KINDS:
        raise DataError(f"{name}: got .{kind}; expected the name of a .png, .svg or .pdf picture")
    return kind


def draw_motion(motion: ExcitingMotion, compiled: CompiledModel, kind: str) -> bytes:
    """Draws position, speed, acceleration and torque of every joint as shares of limits.

    Torques have a panel where parameters are known; where a joint has no limit they are shown as
    shares of their largest value.
    """
    import matplotlib  # which takes long to load
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(_SETTINGS):
        panels = _build_panels(motion, compiled)
        figure = Figure(figsize=(10.0, 1.0 + 1.9 * len(panels)), layout="constrained")
        FigureCanvasAgg(figure)
        axes = np.atleast_1d(figure.subplots(len(panels), 1, sharex=True))
        time = np.linspace(0.0, motion.series.duration, THRESHOLDS.picture_samples)
        for axis, (title, shares) in zip(axes, panels, strict=True):
            for wall in (-1.0, 1.0):
                axis.axhline(wall, color="0.4", linewidth=0.8, linestyle="--")
            for j, name in enumerate(motion.bounds.joints):
                axis.plot(time, shares[:, j], linewidth=1.1, label=name, color=f"C{j % 10}")
            axis.set_title(title)
            axis.set_ylim(-1.12, 1.12)
        axes[-1].set_xlabel("time, s")
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside right upper", title="joint")
        figure.suptitle(
            f"{motion.robot}: condition number {motion.quality.condition:.3g}, best of "
            f"{motion.random_count} random {motion.random[0]:.3g}",
            x=0.01,
            ha="left",
            fontweight="bold",
            fontsize=11,
        )
        stream = io.BytesIO()
        figure.savefig(stream, format=kind, dpi=120, metadata=_NO_DATE[kind])
        return stream.getvalue()


def _build_panels(motion: ExcitingMotion, compiled: CompiledModel) -> list[tuple[str, np.ndarray]]:
    b = motion.bounds
    time = np.linspace(0.0, motion.series.duration, THRESHOLDS.picture_samples)
    q, qd, qdd = motion.series.resample_at(time).evaluate_motion(motion.x)
    panels = [
        ("position: -1 and 1 are the ends of the range", (q - b.mid_range) / b.half_range),
        ("speed, share of its limit", qd / b.speed),
        ("acceleration, share of its limit", qdd / b.acceleration),
    ]
    if motion.beta is not None:
        read = compute_signals(compiled, (q, qd, qdd), time)
        torque = compiled.inverse_dynamics(q, qd, qdd, motion.beta, read)
        largest = np.abs(torque).max(axis=0)
        most = np.where(np.isfinite(b.torque), b.torque, np.where(largest > 0.0, largest, 1.0))
        panels.append(("torque, share of its limit, or of its largest value", torque / most))
    return panels
