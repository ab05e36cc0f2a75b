"""Stacked bars: what the torque of each joint is made of, and what is left of it."""

import numpy as np

from modeler.compare.comparison import Comparison
from modeler.pictures.picture import BLUE, SLATE, VERMILLION, Bars, Panel, Style

_READABLE = 8.0  # percent: a shorter stretch of a bar has no room for its number


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
