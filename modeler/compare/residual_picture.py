"""The residual of one joint against each coordinate, and its spectrum."""

import numpy as np

from modeler.compare.comparison import JointComparison
from modeler.compare.coordinates import coordinate_unit, coordinate_values, coordinates_of
from modeler.compare.prediction import Prediction
from modeler.compare.ripple import lines, waves
from modeler.compare.time_picture import running_time
from modeler.pictures.picture import (
    BLUE,
    GREY,
    ORANGE,
    VERMILLION,
    Curve,
    Means,
    Panel,
    Picture,
    Points,
    Style,
)
from modeler.pictures.thinning import thin_curves, thin_points

_DOTS = 700
_BINS = 24
_FEWEST = 8  # samples of a bin whose mean is drawn
_CLOUD = Style(GREY, width=2.6, opacity=0.45)
_MEAN = Style(BLUE, width=1.6)
_BACK = Style(VERMILLION, width=1.6)
_FLOOR = Style(ORANGE, width=1.2, dash=True)
_WAVES = Style(BLUE, width=0.8)
_ACROSS = 3  # panels side by side


def residual_picture(prediction: Prediction, item: JointComparison) -> Picture:
    """A panel for each coordinate that the logs hold, then both spectra."""
    drawn = [
        _against(prediction, item, coordinate.id, coordinate.label)
        for coordinate in coordinates_of(prediction, item.index)
        if coordinate.id != "direction"
    ]
    drawn += [_spectrum_panel(item), _order_panel(item)]
    drawn += [_EMPTY] * (-len(drawn) % _ACROSS)
    rows = [tuple(drawn[k : k + _ACROSS]) for k in range(0, len(drawn), _ACROSS)]
    name = item.joint.name
    return Picture(
        name=f"joint_{name}_residual",
        title=f"Joint {name}: does the residual still have structure?",
        caption=_caption(any(panel.title.startswith("Temperature") for panel in drawn)),
        panels=tuple(rows),
        heights=tuple(1.0 / len(rows) for _ in rows),
        widths=(1 / 3, 1 / 3, 1 / 3),
        height=310 * len(rows),
    )


_EMPTY = Panel("", "", "", ())


def _caption(heated: bool) -> str:
    """How to read the panels; `heated` where one of them is over temperature."""
    return f"{_FIRST}{_HEATED if heated else ''} {_LAST}"


_FIRST = (
    f"{_CLOUD.named.capitalize()}: samples. {_MEAN.named.capitalize()}: mean of the residual in "
    "each bin, whiskers two standard errors (from the spread between separate passes through the "
    f"bin; none where there was only one). A {_MEAN.named} line that leaves zero by more than its "
    "whiskers is a pattern the model does not have: a step at zero velocity looks like Coulomb "
    "friction, a slope like viscous friction, a wave over position like gravity or ripple, a slope "
    "over acceleration like inertia, a curve that starts anew at every reversal (travel) like "
    "presliding."
)
_HEATED = (
    f" Over temperature, {_MEAN.named} is motion in the positive and {_BACK.named} in the negative "
    "direction: friction that changes moves them apart or together."
)
_LAST = (
    "The percentage is the share of the residual variance that such a curve predicts on motion not "
    "used to draw it; of a temperature, what it adds to the direction of motion. A flat spectrum "
    "is noise, a narrow peak over frequency an oscillation, a narrow peak over waves per turn "
    "something that turns: teeth, magnets, rollers. Waves per turn of the motor are those per turn "
    "of the joint over the gear ratio, which a robot file does not hold."
)


def binned_means(x: np.ndarray, e: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean of x, mean of e and two standard errors in up to 24 bins of x, half of them by count.

    Consecutive samples share their noise, so the standard error comes from the spread between
    separate passes through the bin: s^2 = G/(G-1) sum_g (sum_{i in g} (e_i - mean))^2 / n^2 with
    G passes g. A bin with one pass has no whisker (NaN).

    Args:
        x: coordinate, (n,), in time order.
        e: residual, (n,).
    """
    even = np.linspace(x.min(), x.max(), _BINS // 2 + 1)
    dense = np.quantile(x, np.linspace(0.0, 1.0, _BINS // 2 + 1))
    edges = np.unique(np.concatenate((even, dense)))
    which = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, max(edges.size - 2, 0))
    count = np.bincount(which)
    filled = np.flatnonzero(count >= _FEWEST)
    count = np.maximum(count, 1)
    mean = np.bincount(which, e) / count
    starts = np.concatenate(([0], np.flatnonzero(np.diff(which)) + 1))
    deviation = np.add.reduceat(e - mean[which], starts)
    passes = np.bincount(which[starts], minlength=count.size)
    scatter = np.bincount(which[starts], deviation**2, minlength=count.size)
    correction = np.where(passes > 1, passes / np.maximum(passes - 1, 1), np.nan)
    error = 2.0 * np.sqrt(correction * scatter) / count
    centre = np.bincount(which, x) / count
    return centre[filled], mean[filled], error[filled]


def _against(prediction: Prediction, item: JointComparison, coordinate: str, label: str) -> Panel:
    rows = prediction.used[:, item.index]
    e = (prediction.measured - prediction.predicted)[rows, item.index]
    if coordinate == "time":
        whole, _, marks = running_time(prediction)
        x, label = whole[rows], "time, all logs"
    else:
        x, marks = coordinate_values(prediction, item.index, coordinate)[rows], ()
    kept = thin_points(x, e, _DOTS)
    title = label[0].upper() + label[1:]
    if item.structure is not None:
        title = f"{title}: {item.structure.share(coordinate):.0%}"
    if coordinate == "temperature":
        means = _by_direction(x, e, prediction.qd[rows, item.index])
    else:
        means = (Means("mean, 2 standard errors", *binned_means(x, e), _MEAN),)
    return Panel(
        title=title,
        x_label=f"{label} [{coordinate_unit(prediction, item.index, coordinate)}]",
        y_label=f"residual [{item.joint.effort_unit}]",
        series=(Points("samples", x[kept], e[kept], _CLOUD), *means),
        marks=tuple((place, "") for place, _ in marks[1:]),
        zero=True,
    )


def _by_direction(x: np.ndarray, e: np.ndarray, qd: np.ndarray) -> tuple[Means, ...]:
    """A line of means for either direction of motion that occurs."""
    ways = (("moving in the positive direction", qd > 0.0, _MEAN),
            ("moving in the negative direction", qd < 0.0, _BACK))  # fmt: skip
    return tuple(
        Means(text, *binned_means(x[own], e[own]), style) for text, own, style in ways if own.any()
    )


def _spectrum_panel(item: JointComparison) -> Panel:
    unit = item.joint.effort_unit
    colour = item.spectrum
    nothing = np.array([np.nan])
    title = "Spectrum"
    if colour is not None:
        title += f": {colour.peak_share:.0%} of the power near {colour.peak:.3g} Hz"
    return Panel(
        title=title,
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


def _order_panel(item: JointComparison) -> Panel:
    unit, nothing = item.joint.effort_unit, np.array([np.nan])
    title, per = "Order spectrum", "turn" if item.joint.unit == "rad" else "m"
    if item.orders is None:
        x, y, floor = nothing, nothing, nothing
    else:
        x, _ = waves(item.orders, item.joint.unit)
        y, floor = item.orders.amplitude, item.orders.floor
        kept = thin_curves((y,))
        x, y, floor = x[kept], y[kept], floor[kept]
        found = lines(item.orders, item.joint.unit)
        if found:
            title += f": {found[0].waves:.4g} waves per {per}"
    return Panel(
        title=title,
        x_label=f"waves per {per} of the joint [1/{per}]",
        y_label=f"amplitude [{unit}]",
        series=(Curve("residual", x, y, _WAVES), Curve("floor", x, floor, _FLOOR)),
        scale="log",
    )
