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
from modeler.core.json import JsonError, SchemaError, build_instance, convert_to_plain, parse_json

SCHEMA = "urn:modeler:schema:pictures:1"

_KINDS = {kind.__name__.lower(): kind for kind in get_args(Series)}


def format_pictures(pictures: Sequence[Picture]) -> str:
    """The text of a file of pictures; a number that is not finite is null."""
    plain = convert_to_plain(
        {"schema": SCHEMA, "pictures": [_convert_picture(picture) for picture in pictures]}
    )
    return json.dumps(plain, allow_nan=False, ensure_ascii=False) + "\n"


def _convert_picture(picture: Picture) -> dict[str, Any]:
    rows = [[vars(panel) | {"series": [_get_kind(s) | vars(s) for s in panel.series]}
             for panel in row] for row in picture.panels]  # fmt: skip
    return vars(picture) | {"panels": rows}


def _get_kind(series: Series) -> dict[str, Any]:
    return {"kind": type(series).__name__.lower()}


def read_pictures(path: str | Path) -> tuple[Picture, ...]:
    """The pictures of a file that `--picture FILE.json` wrote; null is NaN.

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
                raise SchemaError(f"{place}.{name} is no array of numbers") from None
        if name != left_out:
            arguments[name] = value
    return build_instance(cls, arguments, place)


def _get_list(raw: Any, name: str, place: str) -> list[Any]:
    entries = raw.get(name) if isinstance(raw, Mapping) else None
    if not isinstance(entries, list):
        raise SchemaError(f"{place}.{name} is no list")
    return entries
