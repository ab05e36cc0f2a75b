"""How much of the axes a picture shows: where the effect acts and most means are."""

from dataclasses import dataclass

import numpy as np

from modeler.pages.shown import Shown

_TAIL = 0.005  # of the rows, and of the square of the effect, beyond either end of the x axis
_BESIDE = 1.0  # widths of the place where an effect acts that are shown on either side of it
_MEANS = 0.05  # of the ends of all intervals beyond either end of the y axis
_PAD = 0.08  # of a range, on either side


@dataclass(frozen=True)
class View:
    """Ranges of both axes, and sentences on what lies outside."""

    x: tuple[float, float]
    y: tuple[float, float]
    outside: tuple[str, ...]


def view_of(item: Shown) -> View:
    """Of both panels, alike, so that they can be compared.

    The ends are quantiles: neither one spike nor a few rows may flatten everything else. The curve
    of the effect is always inside.
    """
    x = _across(item)
    y = _upward(item, x)
    return View(x, y, tuple(_outside(item, x, y)))


def _across(item: Shown) -> tuple[float, float]:
    """Most of the rows, and no more than the neighbourhood of the place where the effect acts."""
    x, adds = item.axis.x[item.calm], item.weight[item.calm]
    low, high = np.quantile(x, (_TAIL, 1.0 - _TAIL))
    order = np.argsort(x)
    share = np.cumsum(adds[order] ** 2)
    if share[-1] > 0.0 and item.axis.shows not in ("t", "waves"):
        first, last = np.searchsorted(share, np.array((_TAIL, 1.0 - _TAIL)) * share[-1])
        near, far = x[order[first]], x[order[min(last, len(x) - 1)]]
        low = max(low, near - _BESIDE * (far - near))
        high = min(high, far + _BESIDE * (far - near))
    pad = 0.5 * _PAD * (high - low) or 1.0
    return float(low - pad), float(high + pad)


def _upward(item: Shown, x: tuple[float, float]) -> tuple[float, float]:
    inside = (item.bins.centre >= x[0]) & (item.bins.centre <= x[1])
    ends, error = [], np.nan_to_num(item.errors())
    for y in (item.before, item.after):
        turned = item.axis.turned(y)
        means = item.bins.means(turned)
        ends += [(means - error)[inside], (means + error)[inside]]
    curve = item.bins.means(item.axis.turned(item.before - item.after))[inside]
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
