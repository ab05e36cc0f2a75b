"""All joints at once: how large the errors are, where, and what they follow."""

import numpy as np

from modeler.compare.comparison import Comparison
from modeler.compare.coordinates import COORDINATES, coordinates_of
from modeler.compare.table import METHODS
from modeler.compare.where import REGIONS
from modeler.pictures.picture import BLUE, SLATE, VERMILLION, Bars, Heat, Panel, Picture, Style

_READABLE = 8.0  # percent: a shorter stretch of a bar has no room for its number


def overview_picture(comparison: Comparison) -> Picture:
    """Relative error, regions of velocity; stacked shares; coordinates, other joints."""
    names = tuple(item.joint.name for item in comparison.joints)
    errors = np.array([100.0 * item.relative_error for item in comparison.joints])
    bars = Bars("relative error", names, errors, tuple(f"{e:.1f}" for e in errors), Style(BLUE))
    panels = (
        (
            Panel("Relative error", "joint", "||residual|| / ||torque|| [%]", (bars,)),
            Panel("Where: share of squared residual [%]", "velocity", "joint",
                  (_regions(comparison),)),
        ),
        share_panels(comparison),
        (
            Panel("Follows its own ... [%]", "coordinate", "joint", (_shares(comparison),)),
            Panel("Follows the velocity of ... [%]", "joint or motor moving", "joint",
                  (_across(comparison),)),
        ),
    )  # fmt: skip
    return Picture(
        name="overview",
        title="All joints",
        caption=_caption(comparison),
        panels=panels,
        heights=(1 / 3, 1 / 3, 1 / 3),
        widths=(0.5, 0.5),
        height=max(780, 360 + 3 * 44 * len(names)),
    )


def _caption(comparison: Comparison) -> str:
    methods = {item.shares.method for item in comparison.joints if item.shares is not None}
    how = "; ".join(METHODS[name] for name in METHODS if name in methods)
    return (
        "Relative error: unexplained share of each joint's own torque or force. Variance: of it, "
        "and of what is left alone. "
        + (f"Repeatable is {how}; noise is the rest. " if how else "")
        + "Where: in which velocity region the squared residual sits, and in brackets the share of "
        "the samples there; fast is beyond 40 %, around zero within 5 % of the joint's own top "
        "speed. Follows: share of the residual variance that a curve over that coordinate predicts "
        "on motion not used to fit it; noise gives 0. Coordinates move together: shares overlap. "
        "Where the velocity of another joint or motor beats that of the joint itself, look for a "
        "motor that turns with several joints: its friction follows the speed of the motor, and "
        "that is a sum of joint speeds."
    )


def _regions(comparison: Comparison) -> Heat:
    energy = np.array([[r.energy_share for r in item.regions] for item in comparison.joints])
    texts = tuple(
        tuple(f"{r.energy_share:.0%} ({r.time_share:.0%})" for r in item.regions)
        for item in comparison.joints
    )
    return _heat(comparison, "share of squared residual", REGIONS, energy, texts)


def _shares(comparison: Comparison) -> Heat:
    held = {
        coordinate.id
        for item in comparison.joints
        for coordinate in coordinates_of(comparison.prediction, item.index)
    }
    names = [coordinate.id for coordinate in COORDINATES if coordinate.id in held]
    columns = (*names, "all motion")
    rows = [
        [np.nan] * len(columns)
        if item.structure is None
        else [*(item.structure.share(name) for name in names), item.structure.together]
        for item in comparison.joints
    ]
    return _heat(comparison, "explained share", columns, np.array(rows), None)


def _across(comparison: Comparison) -> Heat:
    prediction = comparison.prediction
    columns = (
        *(f"joint {info.name}" for info in prediction.joints),
        *(f"motor {motor.name}" for motor in prediction.motors),
    )
    rows = [
        [np.nan] * len(columns)
        if item.structure is None
        else [share for _, share in (*item.structure.across, *item.structure.motors)]
        for item in comparison.joints
    ]
    return _heat(comparison, "explained share", columns, np.array(rows), None)


def _heat(
    comparison: Comparison,
    label: str,
    columns: tuple[str, ...],
    values: np.ndarray,
    texts: tuple[tuple[str, ...], ...] | None,
) -> Heat:
    if texts is None:
        texts = tuple(
            tuple("" if np.isnan(value) else f"{100 * value:.0f}" for value in row)
            for row in values
        )
    names = tuple(item.joint.name for item in comparison.joints)
    return Heat(label, columns, names, 100.0 * values, texts, top=100.0)


def share_panels(comparison: Comparison) -> tuple[Panel, Panel]:
    """Shares of the torque's variance, and the same of what is not explained."""
    items = [item for item in comparison.joints if item.shares is not None]
    names = tuple(item.joint.name for item in items)
    found = [item.shares for item in items if item.shares is not None]
    repeats = np.array([100.0 * each.repeats for each in found])
    # a prediction worse than a constant explains nothing: the rest is then all there is
    explained = np.array([100.0 * max(0.0, each.explained) for each in found])
    left = 100.0 - explained
    systematic = left * repeats / 100.0
    return (
        Panel(
            "Variance of the torque [%]", "joint", "share of the variance [%]",
            _stacked(names, [("explained", explained, BLUE),
                             ("repeatable, not explained", systematic, VERMILLION),
                             ("noise", left - systematic, SLATE)]),
        ),
        Panel(
            "Variance that is not explained [%]", "joint", "share of the residual [%]",
            _stacked(names, [("repeatable, not explained", repeats, VERMILLION),
                             ("noise", 100.0 - repeats, SLATE)]),
        ),
    )  # fmt: skip


def _stacked(names: tuple[str, ...], parts: list[tuple[str, np.ndarray, str]]) -> tuple[Bars, ...]:
    series, base = [], np.zeros(len(names))
    for label, values, colour in parts:
        texts = tuple(f"{value:.1f}" if value >= _READABLE else "" for value in values)
        series.append(Bars(label, names, values, texts, Style(colour), base))
        base = base + values
    return tuple(series)
