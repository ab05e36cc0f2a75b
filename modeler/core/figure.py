"""What a picture is, whoever draws it: panels of series, nothing about matplotlib or plotly."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

# Okabe and Ito, "Color Universal Design" (2008): told apart by colour-blind readers.
BLACK, ORANGE, BLUE, VERMILLION = "#000000", "#E69F00", "#0072B2", "#D55E00"
GREEN, PINK, SKY = "#009E73", "#CC79A7", "#56B4E9"
GREY, SLATE = "#9A9A9A", "#6F6F6F"
PALE_BLUE, PALE_ORANGE, PALE_GREEN = "#CFE4F3", "#FBE3B0", "#C3EADD"
PALE_PINK, PALE_YELLOW, PALE_BROWN = "#F3D9E7", "#F7F3B5", "#E6D5C3"
SHADE = "#D0D0D0"
"""Of the interval that a panel points out."""
COLORS = (BLUE, VERMILLION, GREEN, ORANGE, PINK, SKY, BLACK)
"""Seven that colour-blind people tell apart (Okabe and Ito), for curves of many joints."""

COLOR_NAMES = {
    BLACK: "black", ORANGE: "orange", BLUE: "blue", VERMILLION: "dark orange", GREEN: "green",
    PINK: "pink", SKY: "light blue", GREY: "grey", SLATE: "dark grey",
    PALE_BLUE: "pale blue", PALE_ORANGE: "pale orange", PALE_GREEN: "pale green",
    PALE_PINK: "pale pink", PALE_YELLOW: "pale yellow", PALE_BROWN: "pale brown",
    SHADE: "light grey",
}  # fmt: skip
"""How captions call the colours."""


@dataclass(frozen=True)
class Style:
    """Colour and size of a series."""

    color: str
    width: float = 1.3  # points, of a line; diameter of a dot
    opacity: float = 1.0
    dash: bool = False

    @property
    def named(self) -> str:
        """Its colour in a caption, and whether the line is dashed."""
        return f"dashed {COLOR_NAMES[self.color]}" if self.dash else COLOR_NAMES[self.color]


@dataclass(frozen=True, eq=False)
class Curve:
    """A line; NaN breaks it."""

    label: str
    x: np.ndarray
    y: np.ndarray
    style: Style


@dataclass(frozen=True, eq=False)
class Points:
    """Dots."""

    label: str
    x: np.ndarray
    y: np.ndarray
    style: Style


@dataclass(frozen=True, eq=False)
class Means:
    """Dots, joined by a line if that has a width, with whiskers of plus and minus `error`."""

    label: str
    x: np.ndarray
    y: np.ndarray
    error: np.ndarray
    style: Style


@dataclass(frozen=True, eq=False)
class Band:
    """What lies between two curves over the same x, filled; NaN breaks it."""

    label: str
    x: np.ndarray
    low: np.ndarray
    high: np.ndarray
    style: Style


@dataclass(frozen=True, eq=False)
class Bars:
    """One bar for each name, its number printed at its end; inside it where bars are stacked."""

    label: str
    names: tuple[str, ...]
    values: np.ndarray
    texts: tuple[str, ...]
    style: Style
    base: np.ndarray | None = None  # where each bar begins, of stacked bars


@dataclass(frozen=True, eq=False)
class Heat:
    """Cells coloured white (0) to blue (`top`), the number printed in each; NaN stays empty."""

    label: str
    columns: tuple[str, ...]
    rows: tuple[str, ...]
    values: np.ndarray  # (rows, columns)
    texts: tuple[tuple[str, ...], ...]
    top: float


Series = Curve | Points | Means | Band | Bars | Heat


@dataclass(frozen=True, eq=False)
class Span:
    """Intervals of x that are shaded over the whole height, with an entry in the legend."""

    label: str
    ends: np.ndarray  # (k, 2)
    color: str


@dataclass(frozen=True, eq=False)
class Panel:
    """One pair of axes."""

    title: str
    x_label: str  # with unit
    y_label: str  # with unit
    series: tuple[Series, ...]
    scale: Literal["linear", "log"] = "linear"  # of both axes
    marks: tuple[tuple[float, str], ...] = ()  # vertical lines: place, text
    shade: tuple[float, float] | None = None  # an interval of x to point out
    zero: bool = False  # a thin line at y = 0
    x_range: tuple[float, float] | None = None  # of the axis; None: all that is drawn
    y_range: tuple[float, float] | None = None
    spans: tuple[Span, ...] = ()  # below all else


@dataclass(frozen=True, eq=False)
class Picture:
    """Panels on a grid, with the caption that says how to read them."""

    name: str  # file name without ending: "joint_2_time"
    title: str
    caption: str
    panels: tuple[tuple[Panel, ...], ...]  # rows of panels, all of one length
    heights: tuple[float, ...]  # relative, one per row
    widths: tuple[float, ...]  # relative, one per column
    height: int  # pixels, at a width of 1200
    shared_time: bool = False  # panels of one column share their x axis


def picture_csv(picture: Picture) -> str:
    """The numbers behind a picture: panel, series, x, y, error; five significant digits."""
    lines = ["panel,series,x,y,error"]
    for panel in (panel for row in picture.panels for panel in row):
        for series in panel.series:
            lines += [
                f"{_quote(panel.title)},{_quote(series.label)},{row}" for row in _rows(series)
            ]
    return "\n".join(lines) + "\n"


def _rows(series: Series) -> list[str]:
    if isinstance(series, Heat):
        return [
            f"{_quote(column)} / {_quote(row)},{series.values[i, j]:.5g},"
            for i, row in enumerate(series.rows)
            for j, column in enumerate(series.columns)
        ]
    if isinstance(series, Bars):
        pairs = zip(series.names, series.values, strict=True)
        return [f"{_quote(name)},{value:.5g}," for name, value in pairs]
    if isinstance(series, Means):
        triples = zip(series.x, series.y, series.error, strict=True)
        return [f"{x:.5g},{y:.5g},{error:.5g}".replace("nan", "") for x, y, error in triples]
    if isinstance(series, Band):
        middle, half = 0.5 * (series.low + series.high), 0.5 * (series.high - series.low)
        triples = zip(series.x, middle, half, strict=True)
        return [f"{x:.7g},{y:.5g},{error:.5g}" for x, y, error in triples if np.isfinite(y)]
    both = zip(series.x, series.y, strict=True)
    return [f"{x:.7g},{y:.5g}," for x, y in both if np.isfinite(y)]


def _quote(text: str) -> str:
    """Commas would shift the columns; line breaks of labels are no part of a name."""
    return text.replace(",", ";").replace("\n", " ")


# Fewer points for a picture, without losing a peak.


LIMIT = 1200


def thin_curves(curves: tuple[np.ndarray, ...], limit: int = LIMIT) -> np.ndarray:
    """Row numbers to keep, increasing, at most `limit`, the same for all curves.

    The rows are cut into bins; of each bin stay the smallest and the largest value of each
    curve, so every extreme of every curve stays, and curves thinned together stay comparable
    sample by sample. NaN never counts as an extreme.

    Args:
        curves: values of each curve, (n,) each.
        limit: largest number of rows; at least 2 per curve plus 2.
    """
    rows = curves[0].size
    if rows <= limit:
        return np.arange(rows)
    bins = max(1, (limit - 2) // (2 * len(curves)))
    edges = np.linspace(0, rows, bins + 1).astype(int)
    kept = [np.array([0, rows - 1])]
    for values in curves:
        low = np.where(np.isnan(values), np.inf, values)
        high = np.where(np.isnan(values), -np.inf, values)
        for start, stop in pairwise(edges):
            low_at, high_at = np.argmin(low[start:stop]), np.argmax(high[start:stop])
            kept.append(start + np.array([low_at, high_at]))
    return np.unique(np.concatenate(kept))


def thin_points(x: np.ndarray, y: np.ndarray, limit: int = LIMIT) -> np.ndarray:
    """Row numbers of a scatter to keep, increasing, at most `limit`.

    Half are the extremes of y along x, half are evenly spaced samples, so that both the
    outline and the density of the cloud stay.
    """
    if x.size <= limit:
        return np.arange(x.size)
    order = np.argsort(x, kind="stable")
    outline = order[thin_curves((y[order],), limit // 2)]
    even = np.linspace(0, x.size - 1, limit - limit // 2).astype(int)
    return np.unique(np.concatenate((outline, even)))
