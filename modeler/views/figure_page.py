"""A picture as plain data, from which the script of a page draws it."""

import base64
import gzip
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.figure import Band, Bars, Curve, Heat, Means, Panel, Picture, Points, Series
from modeler.core.files import write_atomically
from modeler.core.json import select_attributes
from modeler.views.thresholds import THRESHOLDS

# The numbers of all pictures of a page in one compressed block, each array once.


_LEVELS = 65534  # between the smallest and the largest value; one more level is NaN


class ArrayStore:
    """Arrays by number; `encode_block()` holds them all.

    What a screen shows is kept: values on linear axes to 1/65534 of their range, those that must
    stay apart (x of a curve) or span decades in single precision, or double where that is too
    coarse (a clock that counts from 1970). Of an array the bytes of one significance stand
    together, highest first, so that they compress.
    """

    def __init__(self) -> None:
        self._places: dict[bytes, int] = {}
        self._kinds: list[list[float]] = []
        self._bytes: list[bytes] = []

    def add_coarse(self, values: np.ndarray) -> int:
        """Returns the number of an array for a linear axis; what is not finite becomes NaN."""
        exact = np.asarray(values, dtype=np.float64)
        held = np.isfinite(exact)
        low, span = (float(exact[held].min()), float(np.ptp(exact[held]))) if held.any() else (0, 0)
        step = span / _LEVELS or 1.0
        levels = np.full(exact.shape, _LEVELS + 1, dtype="<u2")
        levels[held] = np.round((exact[held] - low) / step)
        return self._add_array(levels, [float(low), float(step)])

    def add_exact(self, values: np.ndarray) -> int:
        """Returns the number of an array in single or double precision."""
        whole = np.asarray(values, dtype=np.float64)
        held = whole[np.isfinite(whole)]
        with np.errstate(over="ignore"):
            single = whole.astype(np.float32)
        away = np.abs(held - held.astype(np.float32)).max() if held.size else 0.0
        enough = (
            not held.size
            or away <= THRESHOLDS.single_precision_share * np.ptp(held)
            or np.ptp(held) == 0.0
        )
        return self._add_array(single if enough else whole, [])

    def _add_array(self, values: np.ndarray, scale: list[float]) -> int:
        count, size = values.size, values.itemsize
        content = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<")).tobytes()
        key = repr((size, scale)).encode() + content
        if key not in self._places:
            self._places[key] = len(self._kinds)
            self._kinds.append([count, size, *scale])
            planes = np.frombuffer(content, np.uint8).reshape(count, size).T[::-1]
            self._bytes.append(planes.tobytes())
        return self._places[key]

    def encode_block(self) -> dict[str, Any]:
        """Returns the arrays that the page holds.

        `arrays`: of each its count, the bytes of a value, and of two-byte levels the lowest value
        and the step. `data`: gzip of them all, as base64.
        """
        return {"arrays": self._kinds, "data": compress_base64(b"".join(self._bytes))}


def compress_base64(content: bytes) -> str:
    """Compresses by gzip and encodes as base64, reproducibly."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode("ascii")


def describe_picture(picture: Picture, numbers: ArrayStore) -> dict[str, Any]:
    """Describes panels and series of a picture; arrays by their number.

    Maps of cells (`Heat`) are left out: a page shows them as tables.

    Args:
        picture: what to draw.
        numbers: takes the arrays.
    """
    rows, heights, widths = arrange_panels(picture)
    return {
        "name": picture.name,
        "height": round(picture.height * sum(heights) / sum(picture.heights)),
        "shared": picture.shared_time,
        "heights": list(heights),
        "widths": list(widths),
        "rows": [[_describe_panel(panel, numbers) for panel in row] for row in rows],
    }


def arrange_panels(
    picture: Picture,
) -> tuple[Sequence[Sequence[Panel]], Sequence[float], Sequence[float]]:
    """Returns rows of panels with axes, their heights and the widths of the columns.

    Where maps of cells stand between them, the others are put side by side.
    """
    panels = [panel for row in picture.panels for panel in row]
    if not find_heat_maps(picture):
        return picture.panels, picture.heights, picture.widths
    plotted_panels = [
        panel
        for panel in panels
        if not any(isinstance(s, Heat) for s in panel.series)
        and any(len(s.values if isinstance(s, Bars | Heat) else s.x) for s in panel.series)
    ]
    return (
        ([plotted_panels], picture.heights[:1], [1.0] * len(plotted_panels))
        if plotted_panels
        else ((), (), ())
    )


def find_heat_maps(picture: Picture) -> list[tuple[Panel, Heat]]:
    """Finds the maps of cells of a picture, each with its panel."""
    panels = [panel for row in picture.panels for panel in row]
    return [(panel, s) for panel in panels for s in panel.series if isinstance(s, Heat)]


def collect_legend(picture: Picture) -> list[tuple[str, str, str]]:
    """Collects the legend of panels with several series: label, colour, kind of mark."""
    legend: dict[str, tuple[str, str, str]] = {}
    for panel in (panel for row in arrange_panels(picture)[0] for panel in row):
        for series in panel.series if len(panel.series) > 1 else ():
            if not isinstance(series, Heat):
                mark = (series.label, _mix_colour(series), _choose_mark(series))
                legend.setdefault(series.label, mark)
        for span in panel.spans:
            legend.setdefault(span.label, (span.label, span.color, "span"))
    return list(legend.values())


def _mix_colour(series: Curve | Points | Means | Band | Bars) -> str:
    """The colour; of a band, whose ground shines through, mixed with white."""
    style = series.style
    if not isinstance(series, Band):
        return style.color
    parts = (int(style.color[k : k + 2], 16) for k in (1, 3, 5))
    return "#" + "".join(f"{round(255 - style.opacity * (255 - part)):02x}" for part in parts)


def _choose_mark(series: Series) -> str:
    if isinstance(series, Curve):
        return "dashes" if series.style.dash else "line"
    return "bar" if isinstance(series, Bars | Band) else "dots"


def _describe_panel(panel: Panel, numbers: ArrayStore) -> dict[str, Any]:
    return {
        "title": panel.title,
        "x": panel.x_label,
        "y": panel.y_label,
        "log": panel.scale == "log",
        "zero": panel.zero,
        "marks": [[float(place), text] for place, text in panel.marks],
        "shade": _convert_range(panel.shade),
        "spans": [[span.color, span.ends.round(4).tolist()] for span in panel.spans],
        "xrange": _convert_range(panel.x_range),
        "yrange": _convert_range(panel.y_range),
        "series": [
            _describe_series(s, numbers, panel.scale == "log")
            for s in panel.series
            if not isinstance(s, Heat)
        ],
    }


def _convert_range(ends: tuple[float, float] | None) -> list[float] | None:
    return None if ends is None else [float(ends[0]), float(ends[1])]


def _describe_series(
    series: Curve | Points | Means | Band | Bars, numbers: ArrayStore, log: bool
) -> dict[str, Any]:
    style = series.style
    fields: dict[str, Any] = {
        "label": series.label,
        **select_attributes(style, "color width opacity"),
    }
    if isinstance(series, Bars):
        base = None if series.base is None else numbers.add_exact(series.base)
        y = numbers.add_exact(series.values)
        return fields | {
            "kind": "bars",
            **select_attributes(series, "names texts"),
            "y": y,
            "base": base,
        }
    if isinstance(series, Band):
        places = {"low": numbers.add_exact(series.low), "high": numbers.add_exact(series.high)}
        return fields | {"kind": "band", "x": numbers.add_exact(series.x)} | places
    along = numbers.add_exact if log else numbers.add_coarse
    across = along if isinstance(series, Points) else numbers.add_exact
    fields |= {"x": across(series.x), "y": along(series.y)}
    if isinstance(series, Means):
        return fields | {"kind": "means", "error": along(series.error)}
    if isinstance(series, Points):
        return fields | {"kind": "points"}
    return fields | {"kind": "curve", "dash": style.dash}


def write_files(
    folder: Path, pictures: Sequence[Picture], progress: Callable[[float], None] | None = None
) -> tuple[Path, ...]:
    """Writes every picture; returns the paths written.

    Args:
        folder: made if it is not there.
        pictures: what to draw.
        progress: called with the share done, 0 to 1.

    Raises:
        ModelerError: the folder cannot be written.
    """
    from modeler.views.figure_matplotlib import render_images  # matplotlib takes long to load

    written = []
    for number, picture in enumerate(pictures, start=1):
        files = {**render_images(picture), "csv": format_csv(picture).encode()}
        for kind, content in files.items():
            place = Path(folder) / f"{picture.name}.{kind}"
            write_atomically(place, content)
            written.append(place)
        if progress is not None:
            progress(number / len(pictures))
    return tuple(written)


def format_csv(picture: Picture) -> str:
    """Formats the numbers of a picture: panel, series, x, y, error; five significant digits."""
    lines = ["panel,series,x,y,error"]
    for panel in (panel for row in picture.panels for panel in row):
        for series in panel.series:
            lines += [
                f"{_quote_label(panel.title)},{_quote_label(series.label)},{row}"
                for row in _format_rows(series)
            ]
    return "\n".join(lines) + "\n"


def _format_rows(series: Series) -> list[str]:
    if isinstance(series, Heat):
        return [
            f"{_quote_label(column)} / {_quote_label(row)},{series.values[i, j]:.5g},"
            for i, row in enumerate(series.rows)
            for j, column in enumerate(series.columns)
        ]
    if isinstance(series, Bars):
        pairs = zip(series.names, series.values, strict=True)
        return [f"{_quote_label(name)},{value:.5g}," for name, value in pairs]
    if isinstance(series, Means):
        triples = zip(series.x, series.y, series.error, strict=True)
        return [f"{x:.5g},{y:.5g},{error:.5g}".replace("nan", "") for x, y, error in triples]
    if isinstance(series, Band):
        middle, half = 0.5 * (series.low + series.high), 0.5 * (series.high - series.low)
        triples = zip(series.x, middle, half, strict=True)
        return [f"{x:.7g},{y:.5g},{error:.5g}" for x, y, error in triples if np.isfinite(y)]
    both = zip(series.x, series.y, strict=True)
    return [f"{x:.7g},{y:.5g}," for x, y in both if np.isfinite(y)]


def _quote_label(text: str) -> str:
    """Commas would shift the columns; line breaks of labels are no part of a name."""
    return text.replace(",", ";").replace("\n", " ")
