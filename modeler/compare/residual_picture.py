"""The residual of one joint against each coordinate, and its spectrum."""

import numpy as np

from modeler.compare.comparison import JointComparison
from modeler.compare.coordinates import COORDINATES, coordinate_unit, coordinate_values
from modeler.compare.picture import BLUE, GREY, Curve, Means, Panel, Picture, Points, Style
from modeler.compare.prediction import Prediction
from modeler.compare.thinning import thin_points
from modeler.compare.time_picture import running_time

_DOTS = 1500
_BINS = 24
_FEWEST = 8  # samples of a bin whose mean is drawn
_CLOUD = Style(GREY, width=2.6, opacity=0.45)
_MEAN = Style(BLUE, width=1.6)


def residual_picture(prediction: Prediction, item: JointComparison) -> Picture:
    """Six panels: velocity, position, acceleration; load, time, spectrum."""
    panels = {
        coordinate.id: _against(prediction, item, coordinate.id, coordinate.label)
        for coordinate in COORDINATES
        if coordinate.id != "direction"
    }
    name = item.joint.name
    return Picture(
        name=f"joint_{name}_residual",
        title=f"Joint {name}: does the residual still have structure?",
        caption=(
            "Grey: samples. Blue: mean of the residual in each bin, whiskers two standard errors "
            "(widened for samples that resemble their neighbours). A blue line that leaves zero by "
            "more than its whiskers is a pattern the model does not have: a step at zero velocity "
            "is Coulomb friction, a slope viscous friction, a wave over position gravity or ripple,"
            " a slope over acceleration inertia. The percentage is the share of the residual "
            "variance that such a curve predicts on motion not used to draw it. A flat spectrum "
            "is noise; a narrow peak is an oscillation."
        ),
        panels=(
            (panels["velocity"], panels["position"], panels["acceleration"]),
            (panels["load"], panels["time"], _spectrum_panel(item)),
        ),
        heights=(0.5, 0.5),
        widths=(1 / 3, 1 / 3, 1 / 3),
        height=620,
    )


def binned_means(
    x: np.ndarray, e: np.ndarray, inflation: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean of x, mean of e and two standard errors in up to 24 bins of x, half of them by count.

    Args:
        x: coordinate, (n,).
        e: residual, (n,).
        inflation: variance of a mean of e over that of as many independent samples.
    """
    even = np.linspace(x.min(), x.max(), _BINS // 2 + 1)
    dense = np.quantile(x, np.linspace(0.0, 1.0, _BINS // 2 + 1))
    edges = np.unique(np.concatenate((even, dense)))
    which = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, max(edges.size - 2, 0))
    count = np.bincount(which)
    filled = np.flatnonzero(count >= _FEWEST)
    count = np.maximum(count, 1)
    centre = np.bincount(which, x) / count
    mean = np.bincount(which, e) / count
    variance = np.bincount(which, (e - mean[which]) ** 2) / np.maximum(count - 1, 1)
    independent = np.maximum(count / inflation, 1.0)
    error = 2.0 * np.sqrt(variance / independent)
    return centre[filled], mean[filled], error[filled]


def _against(
    prediction: Prediction, item: JointComparison, coordinate: str, label: str
) -> Panel:
    rows = prediction.used[:, item.index]
    e = (prediction.measured - prediction.predicted)[rows, item.index]
    if coordinate == "time":
        whole, _, marks = running_time(prediction)
        x, label = whole[rows], "time, all logs"
    else:
        x, marks = coordinate_values(prediction, item.index, coordinate)[rows], ()
    kept = thin_points(x, e, _DOTS)
    centre, mean, error = binned_means(x, e, _inflation(item))
    title = label[0].upper() + label[1:]
    if item.structure is not None:
        title = f"{title}: {item.structure.share(coordinate):.0%}"
    return Panel(
        title=title,
        x_label=f"{label} [{coordinate_unit(prediction, item.index, coordinate)}]",
        y_label=f"residual [{item.joint.effort_unit}]",
        series=(
            Points("samples", x[kept], e[kept], _CLOUD),
            Means("mean, 2 standard errors", centre, mean, error, _MEAN),
        ),
        marks=tuple((place, "") for place, _ in marks[1:]),
        zero=True,
    )


def _inflation(item: JointComparison) -> float:
    return item.spectrum.inflation if item.spectrum is not None else 1.0


def _spectrum_panel(item: JointComparison) -> Panel:
    unit = item.joint.effort_unit
    colour = item.spectrum
    nothing = np.array([np.nan])
    return Panel(
        title="Spectrum" if colour is None else f"Spectrum: peak at {colour.peak:.3g} Hz",
        x_label="frequency [Hz]",
        y_label=f"density [({unit})^2/Hz]",
        series=(
            Curve(
                "residual",
                nothing if colour is None else colour.frequency,
                nothing if colour is None else colour.density,
                _MEAN,
            ),
        ),
        scale="log",
    )
