"""What a picture is, whoever draws it: panels of series, nothing about matplotlib or plotly."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.core.style import Style


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
    height: int  # pixels, at a width of 1200
    shared_time: bool = False  # panels of one column share their x axis
    heights: tuple[float, ...] = ()  # relative, one per row; alike if they are left out
    widths: tuple[float, ...] = ()  # relative, one per column; likewise

    def __post_init__(self) -> None:
        rows, columns = len(self.panels), len(self.panels[0])
        object.__setattr__(self, "heights", self.heights or (1.0 / rows,) * rows)
        object.__setattr__(self, "widths", self.widths or (1.0 / columns,) * columns)
