"""Pictures as plain data: panels of series, their colours, files, thinning of points."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Final, Literal, TypedDict, get_args

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import read_text
from modeler.core.json import (
    Document,
    JsonError,
    SchemaError,
    build_instance,
    convert_to_plain,
    parse_json,
)

# Okabe and Ito, "Color Universal Design" (2008): distinguished by colour-blind readers.
BLACK, ORANGE, BLUE, VERMILLION = "#000000", "#E69F00", "#0072B2", "#D55E00"
GREEN, PINK, SKY = "#009E73", "#CC79A7", "#56B4E9"
GREY, SLATE = "#9A9A9A", "#6F6F6F"
PALE = {
    "blue": "#CFE4F3",
    "orange": "#FBE3B0",
    "green": "#C3EADD",
    "pink": "#F3D9E7",
    "yellow": "#F7F3B5",
    "brown": "#E6D5C3",
}
"""Of shaded segments, by what captions call them after "pale"."""

SHADE = "#D0D0D0"
"""Of the interval that a panel points out."""

COLORS = (BLUE, VERMILLION, GREEN, ORANGE, PINK, SKY, BLACK)
"""Seven that colour-blind people can distinguish (Okabe and Ito), for curves of many joints."""

COLOR_NAMES = {
    BLACK: "black",
    ORANGE: "orange",
    BLUE: "blue",
    VERMILLION: "dark orange",
    GREEN: "green",
    PINK: "pink",
    SKY: "light blue",
    GREY: "grey",
    SLATE: "dark grey",
    SHADE: "light grey",
} | {color: f"pale {name}" for name, color in PALE.items()}
"""How captions call the colours."""


@dataclass(frozen=True)
class Style:
    """Colour and size of a series."""

    color: str
    width: float = 1.3  # points, of a line; diameter of a dot
    opacity: float = 1.0
    dash: bool = False

    @property
    def description(self) -> str:
        """Returns the colour in a caption, and whether the line is dashed."""
        return f"dashed {COLOR_NAMES[self.color]}" if self.dash else COLOR_NAMES[self.color]


# What a picture is, whoever draws it: panels of series, nothing about matplotlib or plotly.


class _Drawn(Document):
    """A series; a file names its kind by the class."""

    @property
    def kind(self) -> str:
        """Returns the name of its class, in small letters."""
        return type(self).__name__.lower()


@dataclass(frozen=True, eq=False)
class Curve(_Drawn):
    """A line; NaN breaks it."""

    KEYS = "kind label x y style"

    label: str
    x: np.ndarray
    y: np.ndarray
    style: Style


@dataclass(frozen=True, eq=False)
class Points(_Drawn):
    """A series drawn as dots."""

    KEYS = "kind label x y style"

    label: str
    x: np.ndarray
    y: np.ndarray
    style: Style


@dataclass(frozen=True, eq=False)
class Means(_Drawn):
    """Dots, joined by a line if that has a width, with whiskers of plus and minus `error`."""

    KEYS = "kind label x y error style"

    label: str
    x: np.ndarray
    y: np.ndarray
    error: np.ndarray
    style: Style


@dataclass(frozen=True, eq=False)
class Band(_Drawn):
    """What lies between two curves over the same x, filled; NaN breaks it."""

    KEYS = "kind label x low high style"

    label: str
    x: np.ndarray
    low: np.ndarray
    high: np.ndarray
    style: Style


@dataclass(frozen=True, eq=False)
class Bars(_Drawn):
    """One bar for each name, its number printed at its end; inside it where bars are stacked."""

    KEYS = "kind label names values texts style base"

    label: str
    names: tuple[str, ...]
    values: np.ndarray
    texts: tuple[str, ...]
    style: Style
    base: np.ndarray | None = None  # where each bar begins, of stacked bars


@dataclass(frozen=True, eq=False)
class Heat(_Drawn):
    """Cells coloured white (0) to blue (`top`), the number printed in each; NaN stays empty."""

    KEYS = "kind label columns rows values texts top"

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


# Fewer points for a picture, without losing a peak.


LIMIT = 1200


def thin_curves(curves: tuple[np.ndarray, ...], limit: int = LIMIT) -> np.ndarray:
    """Returns row numbers to keep, increasing, at most `limit`, the same for all curves.

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
    size = -(-rows // max(1, (limit - 2) // (2 * len(curves))))
    row_groups = [np.array([0, rows - 1])]
    for values in curves:
        row_groups += [
            _find_bin_extremes(values, size, np.argmin, np.inf),
            _find_bin_extremes(values, size, np.argmax, -np.inf),
        ]
    return np.unique(np.concatenate(row_groups))


def _find_bin_extremes(
    values: np.ndarray, size: int, find: Callable[..., Any], gap: float
) -> np.ndarray:
    """The row of an extreme of each bin of so many rows; the last bin has what is left."""
    missing = np.isnan(values)
    filled = np.where(missing, gap, values) if missing.any() else values
    whole = values.size - values.size % size
    extreme_rows = find(filled[:whole].reshape(-1, size), axis=1) + np.arange(0, whole, size)
    return (
        extreme_rows
        if whole == values.size
        else np.append(extreme_rows, whole + find(filled[whole:]))
    )


def thin_points(x: np.ndarray, y: np.ndarray, limit: int = LIMIT) -> np.ndarray:
    """Returns row numbers of a scatter to keep, increasing, at most `limit`.

    Half are the extremes of y along x, half are evenly spaced samples, so that both the
    outline and the density of the cloud stay.
    """
    if x.size <= limit:
        return np.arange(x.size)
    order = np.argsort(x, kind="stable")
    outline = order[thin_curves((y[order],), limit // 2)]
    even = np.linspace(0, x.size - 1, limit - limit // 2).astype(int)
    return np.unique(np.concatenate((outline, even)))


# Pictures as plain data in a file, and back: every number in full, whoever draws them.


SCHEMA: Final = "urn:modeler:schema:pictures:1"

_KINDS = {kind.__name__.lower(): kind for kind in get_args(Series)}


class PictureFile(TypedDict):
    """A file of pictures."""

    schema: Literal["urn:modeler:schema:pictures:1"]
    pictures: list[Picture]


def format_pictures(pictures: Sequence[Picture]) -> str:
    """Returns the text of a file of pictures; a number that is not finite is null."""
    content: PictureFile = {"schema": SCHEMA, "pictures": list(pictures)}
    return json.dumps(convert_to_plain(content), allow_nan=False, ensure_ascii=False) + "\n"


def read_pictures(path: str | Path) -> tuple[Picture, ...]:
    """Returns the pictures of a file that `--picture FILE.json` wrote; null is NaN.

    Raises:
        DataError: the file cannot be read, or is not like that; says where.
    """
    try:
        raw = parse_json(read_text(Path(path)))
        if not isinstance(raw, Mapping) or raw.get("schema") != SCHEMA:
            raise SchemaError(f"it lacks schema {SCHEMA}")
        return tuple(
            _build_picture(raw_picture, f"pictures[{k}]")
            for k, raw_picture in enumerate(_get_list(raw, "pictures", "it"))
        )
    except OSError as error:
        raise DataError(
            f"{path}: cannot be read ({error.strerror}); run the command again"
        ) from None
    except (JsonError, SchemaError) as error:
        raise DataError(
            f"{path}: {error}; expected what --picture {path} of a command writes; run it again"
        ) from None


def _build_picture(raw: Any, place: str) -> Picture:
    rows = [
        [_build_panel(panel, f"{place}.panels[{i}][{j}]") for j, panel in enumerate(row)]
        for i, row in enumerate(_get_list(raw, "panels", place))
    ]
    if not rows or not rows[0] or any(len(row) != len(rows[0]) for row in rows):
        raise SchemaError(f"{place}.panels has no rows, or rows of different lengths")
    return build_instance(Picture, {**raw, "panels": rows}, place)


def _build_panel(raw: Any, place: str) -> Panel:
    series = [
        _build_with_arrays(
            _find_series_class(raw_entry, f"{place}.series[{k}]"),
            raw_entry,
            f"{place}.series[{k}]",
            "kind",
        )
        for k, raw_entry in enumerate(_get_list(raw, "series", place))
    ]
    spans = [
        _build_with_arrays(Span, raw_entry, f"{place}.spans[{k}]")
        for k, raw_entry in enumerate(_get_list(raw, "spans", place))
    ]
    return build_instance(Panel, {**raw, "series": series, "spans": spans}, place)


def _find_series_class(raw: Any, place: str) -> type:
    kind = raw.get("kind") if isinstance(raw, Mapping) else None
    if kind not in _KINDS:
        raise SchemaError(f"{place}.kind is {kind!r}, expected one of {', '.join(_KINDS)}")
    return _KINDS[kind]


def _build_with_arrays(cls: type, raw: Any, place: str, left_out: str = "") -> Any:
    """One with arrays of floats where its fields are arrays."""
    arrays = {f.name for f in fields(cls) if f.type in (np.ndarray, np.ndarray | None)}
    arguments = {}
    for name, value in raw.items():
        if name in arrays and value is not None:
            try:
                value = np.array(value, dtype=float)  # null becomes NaN
            except (TypeError, ValueError):
                raise SchemaError(f"{place}.{name} is not an array of numbers") from None
        if name != left_out:
            arguments[name] = value
    return build_instance(cls, arguments, place)


def _get_list(raw: Any, name: str, place: str) -> list[Any]:
    entries = raw.get(name) if isinstance(raw, Mapping) else None
    if not isinstance(entries, list):
        raise SchemaError(f"{place}.{name} is no list")
    return entries
