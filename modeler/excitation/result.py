"""An exciting motion, what it is worth, and the files it goes to."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from modeler.core.brief import Brief
from modeler.core.errors import DataError
from modeler.core.result import Presented
from modeler.core.table import aligned
from modeler.core.toml_cells import listed
from modeler.excitation.clearance import Nearest
from modeler.excitation.criterion import signals
from modeler.excitation.families import Series, coefficients_json
from modeler.excitation.motion import Bounds
from modeler.runtime import CompiledModel

_TOLD = 12  # parameters of a gain, for people
_DIGITS = 13  # after the point: rest is 0, not a rounding of it


@dataclass(frozen=True)
class Quality:
    """How well a motion tells parameters apart.

    Attributes:
        condition: of W, rows weighted, columns of length one.
        condition_raw: of W, rows weighted.
        log_det: log det(W^T W), rows weighted.
    """

    condition: float
    condition_raw: float
    log_det: float


@dataclass(frozen=True, eq=False)
class Used(Brief):
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


@dataclass(frozen=True, eq=False)
class Gain(Brief):
    """What a log of a motion adds to logs that there are.

    Attributes:
        names, units: (c,) of the base parameters.
        before: their sigmas by the logs that there are; None: those do not tell.
        after: those to expect of these logs and the next one, by the rules of the same fit.
        logs: names of the logs that there are.
        condition: of their rows, and with those of the next one; columns of length one.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    before: tuple[float | None, ...]
    after: tuple[float | None, ...]
    logs: tuple[str, ...]
    condition: tuple[float, float]

    def lines(self) -> list[str]:
        """Lines of text: what gains most, first."""
        rows = []
        for name, unit, a, b in zip(self.names, self.units, self.before, self.after, strict=True):
            cells = ["not told" if value is None else f"{value:.3g}" for value in (a, b)]
            gain = a / b if a and b else np.inf if b else 1.0
            rows.append((gain, (name, *cells, unit, f"/ {gain:.3g}" if a and b else "")))
        rows.sort(key=lambda row: -row[0])
        head, shown = ("parameter", "sigma before", "expected after", "unit", ""), rows[:_TOLD]
        table = aligned([head, *(cells for _, cells in shown)], (0, 3))
        return [
            f"beside {', '.join(self.logs)}: condition number with columns of length one "
            "{:.4g} before, {:.4g} with it; it sharpens".format(*self.condition),
            *(line.rstrip() for line in table),
            *([f"and {len(rows) - _TOLD} others, less"] if len(rows) > _TOLD else []),
        ]

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        sigmas = zip(self.names, self.before, self.after, strict=True)
        first, then = (c if np.isfinite(c) else None for c in self.condition)
        return {
            "logs": list(self.logs),
            "condition_scaled": {"before": first, "after": then},
            "sigmas": {name: {"before": a, "after": b} for name, a, b in sigmas},
        }


@dataclass(frozen=True, eq=False)
class Exciting(Presented):
    """A motion that excites a robot.

    Attributes:
        robot: name.
        bounds: its limits.
        wish: what was asked for.
        series: of the motion.
        x: (J, 2 K - 1) its coefficients.
        quality: of it.
        drawn: random motions that it is compared with, as large as limits allow.
        random: best and median condition number of them.
        random_log_det: the best of them.
        used: of the limits.
        columns: names of the parameters that count.
        beta: (c,) for torques; None where unknown.
        ended_early: True if the time limit ended the search.
        seconds: that it took.
        nearest: where links come closest; None where they are not looked at.
        gain: what it adds to logs; None without.
    """

    robot: str
    bounds: Bounds
    wish: Mapping[str, Any]
    series: Series
    x: np.ndarray
    quality: Quality
    drawn: int
    random: tuple[float, float]
    random_log_det: float
    used: Used
    columns: tuple[str, ...]
    beta: np.ndarray | None
    ended_early: bool
    seconds: float
    nearest: Nearest | None = None
    gain: Gain | None = None

    def sampled(self, rate: float) -> dict[str, np.ndarray]:
        """Columns by name: time, q, qd and qdd of every joint, from rest to rest."""
        laps, period = int(self.wish["laps"]), self.series.duration
        count = int(np.ceil(laps * period * rate - 1e-9)) + 1
        times = np.arange(count) / rate
        # The last sample is at or just after the end, where the robot rests.
        place = np.where(times >= laps * period, 0.0, np.mod(times, period))
        here, columns = self.series.at(place).motion(self.x), {"time": times}
        for prefix, values in zip(("q", "qd", "qdd"), here, strict=True):
            for j, name in enumerate(self.bounds.joints):
                columns[f"{prefix}{name}"] = np.round(values[:, j], _DIGITS) + 0.0
        return columns

    def lines(self) -> list[str]:
        """Lines of text."""
        best, median = self.random
        lines = [
            f"condition number {self.quality.condition:.4g} with columns of length one "
            f"({self.quality.condition_raw:.4g} as they are); best of {self.drawn} random "
            f"motions {best:.4g}, median {median:.4g}",
            f"log det of the information {self.quality.log_det:.5g}, best of {self.drawn} random "
            f"{self.random_log_det:.5g}",
            f"{'joint':<6}{'positions':>20}{'of limits':>20}{'speed':>14}{'acceleration':>16}"
            f"{'torque':>16}",
        ]
        b, u = self.bounds, self.used
        for j, name in enumerate(b.joints):
            torque = "-" if u.torque is None else f"{u.torque[j]:.4g}"
            if np.isfinite(b.torque[j]):
                torque += f" of {b.torque[j]:.4g}"
            lines.append(
                f"{name:<6}{_pair(u.lower[j], u.upper[j]):>20}{_pair(b.lower[j], b.upper[j]):>20}"
                f"{f'{u.speed[j]:.3g} of {b.speed[j]:.3g}':>14}"
                f"{f'{u.acceleration[j]:.3g} of {b.acceleration[j]:.3g}':>16}{torque:>16}"
            )
        if b.assumed:
            lines.append(
                f"no limits are stated for {listed(b.assumed)}: those above are assumed; correct "
                "them by [limits] or --limit before a robot moves"
            )
        if u.loops is not None:
            lines.append(
                f"joints that follow turn at most {2.0 * u.loops:.3g} times as fast as at home, of "
                "2 allowed: near a singular posture they would be infinitely fast"
            )
        if b.clearance is not None:
            lines.append(b.clearance.line(self.nearest))
        if self.ended_early:
            lines.append("the time limit ended the search: another run may find another motion")
        return [*lines, *(self.gain.lines() if self.gain else [])]

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        b, u = self.bounds, self.used
        joints = {}
        for j, name in enumerate(b.joints):
            torque = None if u.torque is None else u.torque[j]
            joints[name] = {
                what: _of(getattr(b, what)[j], getattr(u, what)[j], what == "lower")
                for what in ("lower", "upper", "speed", "acceleration")
            } | {"torque": _of(b.torque[j], torque)}
        return {
            "robot": self.robot,
            **self.wish,
            "condition_number": self.quality.condition_raw,
            "condition_scaled": self.quality.condition,
            "log_det": self.quality.log_det,
            "random": {
                "motions": self.drawn,
                "condition_scaled_best": self.random[0],
                "condition_scaled_median": self.random[1],
                "log_det_best": self.random_log_det,
            },
            "parameters": list(self.columns),
            "joints": joints,
            "boxes": [vars(box) for box in b.boxes],
            "posture_share": u.posture,
            "singular_share": u.loops,
            "clearance": None if b.clearance is None else b.clearance.to_json(self.nearest),
            "ended_early": self.ended_early,
            "next": None if self.gain is None else self.gain.to_json(),
            "series": coefficients_json(self.series, self.x, b.joints),
        }


def motion_table(columns: Mapping[str, np.ndarray]) -> bytes:
    """Columns as Parquet."""
    buffer = io.BytesIO()
    pq.write_table(pa.table({name: pa.array(values) for name, values in columns.items()}), buffer)
    return buffer.getvalue()


def csv_text(columns: Mapping[str, np.ndarray]) -> str:
    """Columns as CSV, every digit that counts."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(
        [f"{value:.12g}" for value in row] for row in np.column_stack([*columns.values()])
    )
    return out.getvalue()


def _of(limit: float, used: float | None, least: bool = False) -> dict[str, float | None]:
    """A limit, what is used of it, and what is left; infinite ones are None."""
    most = float(limit) if np.isfinite(limit) else None
    value = None if used is None else float(used)
    slack = None if most is None or value is None else value - most if least else most - value
    return {"limit": most, "used": value, "slack": slack}


def _pair(low: float, high: float) -> str:
    return f"{low:.3g} to {high:.3g}"


# A picture of a motion against its limits.


KINDS = ("png", "svg", "pdf")

_SAMPLES = 800
_SETTINGS: Any = {
    "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
    "axes.titlelocation": "left", "axes.titlesize": 9.5, "svg.hashsalt": "modeler",
}  # fmt: skip
_NO_DATE: dict[str, dict[str, None]] = {
    "png": {"Software": None}, "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Producer": None, "Creator": None},
}  # fmt: skip


def check_kind(name: str) -> str:
    """The kind of picture that a file name asks for.

    Raises:
        DataError: none of ours.
    """
    kind = name.rpartition(".")[2].lower()
    if kind not in KINDS:
        raise DataError(f"{name}: got .{kind}; expected the name of a .png, .svg or .pdf picture")
    return kind


def picture(motion: Exciting, compiled: CompiledModel, kind: str) -> bytes:
    """Position, speed, acceleration and torque of every joint, each as a share of its limit.

    Torques have a panel where parameters are known; where a joint has no limit they are shown as
    shares of their largest value.
    """
    import matplotlib  # which takes long to load
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(_SETTINGS):
        panels = _panels(motion, compiled)
        figure = Figure(figsize=(10.0, 1.0 + 1.9 * len(panels)), layout="constrained")
        FigureCanvasAgg(figure)
        axes = np.atleast_1d(figure.subplots(len(panels), 1, sharex=True))
        time = np.linspace(0.0, motion.series.duration, _SAMPLES)
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
            f"{motion.drawn} random {motion.random[0]:.3g}",
            x=0.01, ha="left", fontweight="bold", fontsize=11,
        )  # fmt: skip
        stream = io.BytesIO()
        figure.savefig(stream, format=kind, dpi=120, metadata=_NO_DATE[kind])
        return stream.getvalue()


def _panels(motion: Exciting, compiled: CompiledModel) -> list[tuple[str, np.ndarray]]:
    b = motion.bounds
    time = np.linspace(0.0, motion.series.duration, _SAMPLES)
    q, qd, qdd = motion.series.at(time).motion(motion.x)
    panels = [
        ("position: -1 and 1 are the ends of the range", (q - b.middle) / b.half),
        ("speed, share of its limit", qd / b.speed),
        ("acceleration, share of its limit", qdd / b.acceleration),
    ]
    if motion.beta is not None:
        read = signals(compiled, (q, qd, qdd), time)
        torque = compiled.inverse_dynamics(q, qd, qdd, motion.beta, read)
        largest = np.abs(torque).max(axis=0)
        most = np.where(np.isfinite(b.torque), b.torque, np.where(largest > 0.0, largest, 1.0))
        panels.append(("torque, share of its limit, or of its largest value", torque / most))
    return panels
