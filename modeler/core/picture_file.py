"""Pictures as plain data in a file, and back: every number in full, whoever draws them."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any, get_args

import numpy as np

from modeler.core.errors import DataError
from modeler.core.figure import Panel, Picture, Series, Span
from modeler.core.files import read_text
from modeler.core.json import JsonError, UndeclaredEntry, built, nulled, parse_json

SCHEMA = "urn:modeler:schema:pictures:1"

_KINDS = {kind.__name__.lower(): kind for kind in get_args(Series)}


def pictures_text(pictures: Sequence[Picture]) -> str:
    """The text of a file of pictures; a number that is not finite is null."""
    plain = nulled({"schema": SCHEMA, "pictures": [_plain(picture) for picture in pictures]})
    return json.dumps(plain, allow_nan=False, ensure_ascii=False) + "\n"


def _plain(picture: Picture) -> dict[str, Any]:
    rows = [[vars(panel) | {"series": [_kind(s) | vars(s) for s in panel.series]}
             for panel in row] for row in picture.panels]  # fmt: skip
    return vars(picture) | {"panels": rows}


def _kind(series: Series) -> dict[str, Any]:
    return {"kind": type(series).__name__.lower()}


def pictures_from_json(path: str | Path) -> tuple[Picture, ...]:
    """The pictures of a file that `--picture FILE.json` wrote; null is NaN.

    Raises:
        DataError: the file cannot be read, or is not like that; says where.
    """
    try:
        raw = parse_json(read_text(Path(path)))
        if not isinstance(raw, Mapping) or raw.get("schema") != SCHEMA:
            raise UndeclaredEntry(f"it lacks schema {SCHEMA}")
        return tuple(
            _picture(own, f"pictures[{k}]") for k, own in enumerate(_list(raw, "pictures", "it"))
        )
    except OSError as error:
        raise DataError(
            f"{path}: cannot be read ({error.strerror}); run the command again"
        ) from None
    except (JsonError, UndeclaredEntry) as error:
        raise DataError(
            f"{path}: {error}; expected what --picture {path} of a command writes; run it again"
        ) from None


def _picture(raw: Any, place: str) -> Picture:
    rows = [
        [_panel(panel, f"{place}.panels[{i}][{j}]") for j, panel in enumerate(row)]
        for i, row in enumerate(_list(raw, "panels", place))
    ]
    if not rows or not rows[0] or any(len(row) != len(rows[0]) for row in rows):
        raise UndeclaredEntry(f"{place}.panels has no rows, or rows of different lengths")
    return built(Picture, {**raw, "panels": rows}, place)


def _panel(raw: Any, place: str) -> Panel:
    series = [
        _with_arrays(_kind_of(own, f"{place}.series[{k}]"), own, f"{place}.series[{k}]", "kind")
        for k, own in enumerate(_list(raw, "series", place))
    ]
    spans = [
        _with_arrays(Span, own, f"{place}.spans[{k}]")
        for k, own in enumerate(_list(raw, "spans", place))
    ]
    return built(Panel, {**raw, "series": series, "spans": spans}, place)


def _kind_of(raw: Any, place: str) -> type:
    kind = raw.get("kind") if isinstance(raw, Mapping) else None
    if kind not in _KINDS:
        raise UndeclaredEntry(f"{place}.kind is {kind!r}, expected one of {', '.join(_KINDS)}")
    return _KINDS[kind]


def _with_arrays(cls: type, raw: Any, place: str, left_out: str = "") -> Any:
    """One with arrays of floats where its fields are arrays."""
    arrays = {f.name for f in fields(cls) if f.type in (np.ndarray, np.ndarray | None)}
    given = {}
    for name, value in raw.items():
        if name in arrays and value is not None:
            try:
                value = np.array(value, dtype=float)  # null becomes NaN
            except (TypeError, ValueError):
                raise UndeclaredEntry(f"{place}.{name} is no array of numbers") from None
        if name != left_out:
            given[name] = value
    return built(cls, given, place)


def _list(raw: Any, name: str, place: str) -> list[Any]:
    found = raw.get(name) if isinstance(raw, Mapping) else None
    if not isinstance(found, list):
        raise UndeclaredEntry(f"{place}.{name} is no list")
    return found
