"""How much of the axes a picture shows: where the effect acts and most means are."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.pages.shown import Shown

_TAIL = 0.005  # of the rows, and of the square of the effect, beyond either end of the x axis
_LEAST = 0.25  # of the rows that are shown, however small the place is where the effect acts
_MEANS = 0.05  # of the ends of all intervals beyond either end of the y axis
_PAD = 0.08  # of a range, on either side


@dataclass(frozen=True)
class View:
    """Ranges of the axes, y of residuals, law of the effect's torque; what lies outside."""

    x: tuple[float, float]
    y: tuple[float, float]
    law: tuple[float, float]
    outside: tuple[str, ...]


def view_of(item: Shown) -> View:
    """Of both panels, alike, so that they can be compared.

    The ends are quantiles: neither one spike nor a few rows may flatten everything else. The curve
    of the effect is always inside.
    """
    x = _across(item)
    y = _upward(item, x, item.adds, (item.before, item.after))
    own = item.adds if item.own is None else item.own
    law = _upward(item, x, own, (own + item.after,))
    return View(x, y, law, tuple(_outside(item, x, y)))


def _across(item: Shown) -> tuple[float, float]:
    """Most of the rows, and no more than the neighbourhood of the place where the effect acts."""
    x, adds = item.axis.x[item.calm], (item.adds if item.own is None else item.own)[item.calm]
    low, high = np.quantile(x, (_TAIL, 1.0 - _TAIL))
    order = np.argsort(x)
    share = np.cumsum(adds[order] ** 2)
    if share[-1] > 0.0 and item.axis.shows not in ("t", "waves"):
        ends = np.searchsorted(share, np.array((_TAIL, 1.0 - _TAIL)) * share[-1])
        near, far = x[order[np.minimum(ends, len(x) - 1)]]
        first, last = _around(x, near, far)
        low, high = max(low, first), min(high, last)
    pad = 0.5 * _PAD * (high - low) or 1.0
    return float(low - pad), float(high + pad)


def _around(x: np.ndarray, near: float, far: float) -> tuple[float, float]:
    """As wide on either side of a place as the place itself, or wider: many rows are inside."""
    beside = far - near
    while beside > 0.0 and np.mean((x >= near - beside) & (x <= far + beside)) < _LEAST:
        beside *= 2.0
    return near - beside, far + beside


def _upward(
    item: Shown, x: tuple[float, float], effect: np.ndarray, drawn: Sequence[np.ndarray]
) -> tuple[float, float]:
    inside = (item.bins.centre >= x[0]) & (item.bins.centre <= x[1])
    ends, error = [], np.nan_to_num(item.errors())
    for y in drawn:
        turned = item.axis.turned(y)
        means = item.bins.means(turned)
        ends += [(means - error)[inside], (means + error)[inside]]
    curve = item.bins.means(item.axis.turned(effect))[inside]
    every = np.concatenate(ends)
    low = min(float(np.quantile(every, _MEANS)), float(curve.min()), 0.0)
    high = max(float(np.quantile(every, 1.0 - _MEANS)), float(curve.max()), 0.0)
    pad = _PAD * (high - low) or 1.0
    return low - pad, high + pad


def _outside(item: Shown, x: tuple[float, float], y: tuple[float, float]) -> list[str]:
    """What the picture does not show."""
    beside = (item.axis.x < x[0]) | (item.axis.x > x[1])
    turned = item.axis.turned(item.before)
    above = ~beside & ((turned < y[0]) | (turned > y[1]))
    count = len(turned)
    lines = [
        f"{int(rows.sum())} of {count} rows lie {where}."
        for rows, where in ((beside, "left or right of the axes"), (above, "above or below"))
        if rows.any()
    ]
    means = item.bins.means(turned)
    shown = (item.bins.centre >= x[0]) & (item.bins.centre <= x[1])
    lost = shown & ((means < y[0]) | (means > y[1]))
    if lost.any():
        farthest = float(means[lost][np.argmax(np.abs(means[lost]))])
        lines.append(
            f"{int(lost.sum())} of {int(shown.sum())} means without the effect lie above or "
            f"below, the farthest at {farthest:.3g} {item.unit}."
        )
    wild = int((~item.calm).sum())
    if wild:
        what = "wild row counts" if wild == 1 else "wild rows count"
        lines.append(f"{wild} {what} in no mean.")
    return lines
