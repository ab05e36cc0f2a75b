"""Pictures of a free run: one a joint."""

import numpy as np

from modeler.freerun.result import FreeRun
from modeler.pictures.picture import BLACK, GREY, ORANGE, VERMILLION, Curve, Panel, Picture, Style
from modeler.pictures.thinning import thin_curves

_MEASURED = Style(BLACK, width=1.1)
_SIMULATED = Style(ORANGE, width=1.6, opacity=0.9)
_ERROR = Style(VERMILLION, width=1.0)
_BOUND = Style(GREY, width=1.0, dash=True)


def free_run_pictures(found: FreeRun) -> tuple[Picture, ...]:
    """Positions above, their error below, window after window."""
    return tuple(free_run_picture(found, j) for j in range(len(found.joints)))


def free_run_picture(found: FreeRun, j: int) -> Picture:
    """Position of joint `j` above, its error below."""
    joint = found.joints[j]
    above, below = _panels(found, j)
    return Picture(
        name=f"joint_{joint.name}_free_run",
        title=f"Joint {joint.name}: measured and free-running position",
        caption=(
            f"Above: measured ({_MEASURED.named}) and simulated ({_SIMULATED.named}) under the "
            f"logged torques, from the measured state at the start of each window of "
            f"{found.window:g} s. Below ({_ERROR.named}): the difference, with the bound "
            f"({_BOUND.named}) of {100 * found.bound:g} % of the range of motion."
        ),
        panels=((above,), (below,)),
        heights=(0.58, 0.42),
        widths=(1.0,),
        height=440,
        shared_time=True,
    )


def _panels(found: FreeRun, j: int) -> tuple[Panel, Panel]:
    unit = found.joints[j].unit
    time, measured, simulated = _running(found, j)
    error = simulated - measured
    kept = thin_curves((measured, simulated, error))
    bound, ends = found.bound * float(found.ranges[j]), time[[0, -2]]
    one = len(found.logs) == 1
    label = f"time in {found.logs[0]} [s]" if one else "time, logs one after the other [s]"
    bounds = [
        Curve("bound", ends, np.full(2, sign * bound), _BOUND)
        for sign in (1.0, -1.0)
        if np.isfinite(bound)
    ]
    curves = (
        Curve("measured", time[kept], measured[kept], _MEASURED),
        Curve("simulated", time[kept], simulated[kept], _SIMULATED),
    )
    return (
        Panel("Position", label, f"position [{unit}]", curves),
        Panel(
            "Error", label, f"error [{unit}]",
            (Curve("error", time[kept], error[kept], _ERROR), *bounds), zero=True,
        ),
    )  # fmt: skip


def _running(found: FreeRun, j: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time on one axis, measured and simulated positions, a NaN between windows."""
    times: list[np.ndarray] = []
    measured: list[np.ndarray] = []
    simulated: list[np.ndarray] = []
    offset, last, log = 0.0, 0.0, found.paths[0].log
    for path in found.paths:
        if path.log != log:
            offset, log = last - path.time[0], path.log
        times.append(np.append(path.time, path.time[-1]) + offset)
        last = float(times[-1][-1])
        measured.append(np.append(path.measured[:, j], np.nan))
        simulated.append(np.append(path.simulated[:, j], np.nan))
    return np.concatenate(times), np.concatenate(measured), np.concatenate(simulated)
