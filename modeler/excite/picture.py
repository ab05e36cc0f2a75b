"""A picture of a motion against its limits."""

import io
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from modeler.compiled import CompiledModel
from modeler.core.errors import DataError
from modeler.excite.columns import signals
from modeler.excite.result import Exciting
from modeler.excite.series import series

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
            f"{motion.robot}: condition number {motion.quality.condition:.3g}, best of 50 random "
            f"{motion.random[0]:.3g}", x=0.01, ha="left", fontweight="bold", fontsize=11,
        )  # fmt: skip
        stream = io.BytesIO()
        figure.savefig(stream, format=kind, dpi=120, metadata=_NO_DATE[kind])
        return stream.getvalue()


def _panels(motion: Exciting, compiled: CompiledModel) -> list[tuple[str, np.ndarray]]:
    b = motion.bounds
    time = np.linspace(0.0, motion.series.duration, _SAMPLES)
    q, qd, qdd = series(motion.series.duration, motion.series.harmonics, time).motion(motion.x)
    panels = [
        ("position: -1 and 1 are the ends of the range", (q - b.middle) / b.half),
        ("speed, share of its limit", qd / b.speed),
        ("acceleration, share of its limit", qdd / b.acceleration),
    ]
    if motion.beta is not None:
        read = signals(compiled.spec, q, time)
        torque = compiled.inverse_dynamics(q, qd, qdd, motion.beta, read)
        largest = np.abs(torque).max(axis=0)
        most = np.where(np.isfinite(b.torque), b.torque, np.where(largest > 0.0, largest, 1.0))
        panels.append(("torque, share of its limit, or of its largest value", torque / most))
    return panels
