"""What a free run ends in: numbers, sentences, pictures."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.core import figure as fig
from modeler.core.json import Document, ShortRepr
from modeler.core.result import Result
from modeler.core.table import DIGITS, format_percent
from modeler.validation.forward_dynamics import Stability


@dataclass(frozen=True)
class JointFreeRun(ShortRepr, Document):
    """How one joint runs freely beside its log.

    Attributes:
        name: of the joint.
        unit: "rad" or "m".
        fit: 100 (1 - |q - q_s| / |q - mean q|) over all windows, %; 100 is perfect, 0 no better
            than the mean position. None: the joint hardly moves.
        constant_speed_fit: the same of going on at the speed that it has at the start of a window.
        whole_run_fit: the same of the runs from the start of each log; None as above.
        horizon: s, median over the windows' starts, until the error passes the bound; None: in more
            than half of them it does not.
        windows_over_bound: starts after which it passed the bound.
        largest_error: rad or m, largest error in a window.
    """

    KEYS = """
        unit fit constant_speed_fit whole_run_fit horizon windows_over_bound largest_error
    """

    name: str
    unit: str
    fit: float | None
    constant_speed_fit: float | None
    whole_run_fit: float | None
    horizon: float | None
    windows_over_bound: int
    largest_error: float


@dataclass(frozen=True)
class ControlledRun(ShortRepr):
    """The robot under a controller that follows the logged commands.

    Attributes:
        speed, ratio, integral, feedforward: of the cascade, see `estimation.direct_model`; speed in
            Hz.
        has_given_gains: its values were given; else those that bring the robot nearest to the log.
        fit: by joint, % of the positions, as above.
        tracking: by joint, 100 (1 - |q - q_s| / |q - q_c|), %: how much of what the controller
            leaves of the command the simulated robot leaves too.
        torque: by joint, % of the measured torque, after the filter of the fit.
    """

    speed: float
    ratio: float
    integral: float
    feedforward: float
    has_given_gains: bool
    fit: Mapping[str, float | None]
    tracking: Mapping[str, float | None]
    torque: Mapping[str, float | None]

    def format_lines(self) -> list[str]:
        """Formats the run as lines of text."""
        parts = [("integral action", self.integral), ("feedforward", self.feedforward)]
        fed = " and ".join(f"{'with' if there else 'no'} {name}" for name, there in parts)
        how = (
            "given"
            if self.has_given_gains
            else "nearest to the log of those tried; it is not known"
        )
        lines = [
            f"under a controller ({how}): speed loops of {self.speed:.3g} Hz, position loops of "
            f"{self.ratio:.2g} times that, {fed}",
            f"{'joint':<8}{'position':>10}{'tracking error':>16}{'torque':>10}",
        ]
        for name, fit in self.fit.items():
            lines.append(
                f"{name:<8}{_format_percent(fit):>10}{_format_percent(self.tracking[name]):>16}"
                f"{_format_percent(self.torque[name]):>10}"
            )
        return lines


@dataclass(frozen=True, eq=False)
class Path(ShortRepr):
    """Measured and simulated positions of one window, for pictures.

    Attributes:
        log: its name.
        time: (p,) s.
        measured, simulated: (p, n).
    """

    log: str
    time: np.ndarray
    measured: np.ndarray
    simulated: np.ndarray


@dataclass(frozen=True, eq=False)
class FreeRun(Result, Document):
    """The fitted robot left to itself under the logged torques.

    Attributes:
        robot: its name.
        logs: their names.
        window: s.
        bound: share of a joint's range of motion.
        ranges: (n,) those ranges, rad or m.
        windows: number of them.
        longest: s that a start was followed for the horizon.
        joints: in the order of the manifest.
        stability: whether errors grow whatever the model.
        numerical: largest change of a position by halving the step, as a share of its range, while
            its error is within the bound.
        controlled: under a controller, where commands were logged.
        paths: of the windows.
        warnings: one sentence each.
    """

    KEYS = """
        robot logs window windows bound joints=joints[name] stability numerical_error=numerical
        controller=controlled warnings
    """

    robot: str
    logs: tuple[str, ...]
    window: float
    bound: float
    ranges: np.ndarray
    windows: int
    longest: float
    joints: tuple[JointFreeRun, ...]
    stability: Stability
    numerical: float
    controlled: ControlledRun | None
    paths: tuple[Path, ...]
    warnings: tuple[str, ...]

    def __repr__(self) -> str:
        fits = ", ".join(f"{joint.name}: {_format_percent(joint.fit)}" for joint in self.joints)
        return f"<FreeRun of {self.robot}, {self.windows} windows of {self.window:g} s, {fits}>"

    def summary(self) -> str:
        """Returns the run as text."""
        lines = [
            f"{self.robot}: free run under the logged torques on {', '.join(self.logs)}: "
            f"{self.windows} windows of {self.window:g} s, each from the measured state",
            f"{'joint':<8}{'fit':>10}{'constant speed':>16}{'largest error':>18}"
            f"{f'within {100 * self.bound:g} % for':>22}{'whole run':>14}",
        ]
        for joint in self.joints:
            horizon = "" if joint.horizon is None else f"{joint.horizon:.2g} s"
            if joint.horizon is None and joint.fit is not None:
                horizon = f"over {self.longest:.2g} s"
            lines.append(
                f"{joint.name:<8}{_format_percent(joint.fit):>10}{_format_percent(joint.constant_speed_fit):>16}"
                f"{f'{joint.largest_error:.2g} {joint.unit}':>18}{horizon:>22}"
                f"{_format_percent(joint.whole_run_fit):>14}"
            )
        lines += ["", self.stability.describe()]
        if self.controlled is not None:
            lines += ["", *self.controlled.format_lines()]
        return "\n".join([*lines, *([""] if self.warnings else []), *self.warnings])


def _format_percent(value: float | None) -> str:
    if value is None:
        return "still"
    return format_percent(0.01 * value, DIGITS) if value > -1000.0 else "below -999 %"


# Pictures of a free run: one a joint.


_MEASURED = fig.Style(fig.BLACK, width=1.1)
_SIMULATED = fig.Style(fig.ORANGE, width=1.6, opacity=0.9)
_ERROR = fig.Style(fig.VERMILLION, width=1.0)
_BOUND = fig.Style(fig.GREY, width=1.0, dash=True)


def draw_free_run_pictures(result: FreeRun) -> tuple[fig.Picture, ...]:
    """Draws positions above, their error below, window after window, of every joint."""
    return tuple(draw_free_run_picture(result, j) for j in range(len(result.joints)))


def draw_free_run_picture(result: FreeRun, j: int) -> fig.Picture:
    """Draws the position of joint `j` above, its error below."""
    joint = result.joints[j]
    above, below = _build_panels(result, j)
    return fig.Picture(
        name=f"joint_{joint.name}_free_run",
        title=f"Joint {joint.name}: measured and free-running position",
        caption=(
            f"Above: measured ({_MEASURED.description}) and simulated ({_SIMULATED.description}) "
            "under the logged torques, from the measured state at the start of each window of "
            f"{result.window:g} s. Below ({_ERROR.description}): the difference, with the bound "
            f"({_BOUND.description}) of {100 * result.bound:g} % of the range of motion."
        ),
        panels=((above,), (below,)),
        heights=(0.58, 0.42),
        height=440,
        shared_time=True,
    )


def _build_panels(result: FreeRun, j: int) -> tuple[fig.Panel, fig.Panel]:
    unit = result.joints[j].unit
    time, measured, simulated = _concatenate_windows(result, j)
    error = simulated - measured
    plot_rows = fig.thin_curves((measured, simulated, error))
    bound, ends = result.bound * float(result.ranges[j]), time[[0, -2]]
    one = len(result.logs) == 1
    label = f"time in {result.logs[0]} [s]" if one else "time, logs one after the other [s]"
    bounds = [
        fig.Curve("bound", ends, np.full(2, sign * bound), _BOUND)
        for sign in (1.0, -1.0)
        if np.isfinite(bound)
    ]
    curves = (
        fig.Curve("measured", time[plot_rows], measured[plot_rows], _MEASURED),
        fig.Curve("simulated", time[plot_rows], simulated[plot_rows], _SIMULATED),
    )
    return (
        fig.Panel("Position", label, f"position [{unit}]", curves),
        fig.Panel(
            "Error",
            label,
            f"error [{unit}]",
            (fig.Curve("error", time[plot_rows], error[plot_rows], _ERROR), *bounds),
            zero=True,
        ),
    )


def _concatenate_windows(result: FreeRun, j: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time on one axis, measured and simulated positions, a NaN between windows."""
    times: list[np.ndarray] = []
    measured: list[np.ndarray] = []
    simulated: list[np.ndarray] = []
    offset, last, log = 0.0, 0.0, result.paths[0].log
    for path in result.paths:
        if path.log != log:
            offset, log = last - path.time[0], path.log
        times.append(np.append(path.time, path.time[-1]) + offset)
        last = float(times[-1][-1])
        measured.append(np.append(path.measured[:, j], np.nan))
        simulated.append(np.append(path.simulated[:, j], np.nan))
    return np.concatenate(times), np.concatenate(measured), np.concatenate(simulated)
