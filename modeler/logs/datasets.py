"""Columns of lists, of the names of joints, of a LeRobot dataset with its `meta/info.json`.

Hugging Face, LeRobotDataset v2.1 and v3.0.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import lazy_loader
import pyarrow as pa

from modeler.core.errors import DataError
from modeler.core.files import read_file
from modeler.core.json import JsonError, parse_json
from modeler.logs.guess import split_label
from modeler.logs.thresholds import THRESHOLDS

pc: Any = lazy_loader.load("pyarrow.compute", suppress_warning=True)  # it takes long

INFO = "meta/info.json"
_NAMES = re.compile(r"(.*?)(?:joint_?)?names?(?:\{\}|\[\{\}\])", re.IGNORECASE | re.DOTALL)
_CLOCK = ("timestamp", "index", "episode_index")


@dataclass(frozen=True)
class Dataset:
    """What a dataset says of its files.

    Attributes:
        info_path: its `info.json`.
        fps: Hz; None if it does not say.
        names: of the entries of columns of lists.
    """

    info_path: Path
    fps: float | None
    names: Mapping[str, tuple[str, ...]]


def find_dataset(path: Path) -> Dataset | None:
    """Returns the dataset that a file or a folder belongs to; None without any.

    Raises:
        DataError: its `info.json` is damaged.
    """
    for folder in [path, *path.absolute().parents][: THRESHOLDS.max_parent_folders + 1]:
        place = folder / INFO
        if place.is_file():
            break
    else:
        return None
    try:
        info = parse_json(read_file(place))
    except (OSError, JsonError) as error:
        raise DataError(f"{place}: cannot be read ({error}); copy the dataset again") from None
    info = info if isinstance(info, dict) else {}
    fps, features = info.get("fps"), info.get("features")
    rate = float(fps) if isinstance(fps, int | float) and fps > 0 else None
    feature_items = features.items() if isinstance(features, dict) else ()
    named = {n: f.get("names") for n, f in feature_items if isinstance(f, dict)}
    names = {n: tuple(_collect_texts(x)) for n, x in named.items()}
    return Dataset(place, rate, names)


def _collect_texts(names: Any) -> list[str]:
    """All texts of a list, or of the lists in a table: `{"motors": ["shoulder", ...]}`."""
    if isinstance(names, dict):
        return [n for inner in names.values() for n in _collect_texts(inner)]
    if isinstance(names, list):
        return [n for inner in names for n in _collect_texts(inner)]
    return [names] if isinstance(names, str) else []


def flatten_table(table: pa.Table, dataset: Dataset | None) -> pa.Table:
    """Returns every entry of a column of lists as a column, `observation.state[shoulder_pan]`.

    Fields of structs are columns too, `state.q`.
    """
    while any(pa.types.is_struct(kind) for kind in table.schema.types):
        table = table.flatten()
    names, columns = list[str](), list[pa.ChunkedArray]()
    for name, column in zip(table.column_names, table.columns, strict=True):
        count = _count_entries(column)
        known = dataset.names.get(name, ()) if dataset is not None else ()
        labels = known if len(known) == count else [str(k + 1) for k in range(count)]
        names += [f"{name}[{label}]" for label in labels] or [name]
        columns += [pc.list_element(column, k) for k in range(count)] or [column]
    return pa.table(columns, names=names)


def _count_entries(column: pa.ChunkedArray) -> int:
    """How many numbers or names each row has; 0 of others, or if they are not equally many."""
    kind, t = column.type, pa.types
    lists = t.is_list(kind) or t.is_large_list(kind) or t.is_fixed_size_list(kind)
    held = (t.is_integer, t.is_floating, t.is_string)
    if not lists or not any(is_one(kind.value_type) for is_one in held):
        return 0
    ends = pc.min_max(pc.list_value_length(column)).as_py()
    if ends["min"] == ends["max"] and (ends["max"] or 0) <= THRESHOLDS.max_list_entries:
        return ends["max"] or 0
    return 0


def join_episodes(
    table: pa.Table, dataset: Dataset | None, first: int
) -> tuple[pa.Table, tuple[str, ...]]:
    """Joins episodes: the frame over fps becomes `timestamp`, the episode `segment`.

    Args:
        table: of some rows.
        dataset: that says the fps.
        first: `index` of the first row of the file.

    Returns:
        The table, and what is reported about it.
    """
    if dataset is None or dataset.fps is None or not {*_CLOCK} <= set(table.column_names):
        return table, ()
    frames = pc.cast(pc.subtract(table.column("index"), first), pa.float64())
    at = table.column_names.index("timestamp")
    table = table.set_column(at, "timestamp", pc.divide(frames, dataset.fps))
    if "segment" not in table.column_names:
        table = table.append_column("segment", table.column("episode_index"))
    return table, (
        f"time is that of the frames at {dataset.fps:g} Hz, as {dataset.info_path.name} says; "
        "every "
        "episode is a segment",
    )


def select_needed_columns(names: list[str], stored: list[str]) -> list[str]:
    """Returns the columns of the file that hold these; none where it takes others to know."""
    whole = [n if n in stored else n.rpartition("[")[0] for n in names]
    if not whole or {*whole} - {*stored}:
        return []
    clock = [n for n in _CLOCK if n in stored] if {*names} & {"timestamp", "segment"} else []
    joints = [n for n in stored if n.lower().endswith(("name", "names"))]  # that cells may name
    return [n for n in dict.fromkeys([*whole, *clock, *joints]) if n in stored]


def rename_by_joint_names(table: pa.Table) -> tuple[pa.Table, tuple[str, ...]]:
    """Returns columns by the names that columns of text state, in whatever order each row has them.

    `name[1]` that holds "elbow" makes `position[1]` to `position[elbow]`.

    Returns:
        The table, and what is reported about it.
    """
    families: dict[str, dict[str, str]] = {}  # template -> label -> column
    for name in table.column_names:
        template, label = split_label(name)
        families.setdefault(template, {})[label] = name
    notes = list[str]()
    for template, named in families.items():
        if not table.num_rows or (match := _NAMES.fullmatch(template)) is None:
            continue
        others = [
            t
            for t, candidates in families.items()
            if t != template and t.startswith(match[1]) and [*candidates] == [*named]
        ]
        texts = [table.column(name) for name in named.values()]
        if not others or not all(pa.types.is_string(text.type) for text in texts):
            continue
        joints = [text[0].as_py() for text in texts]
        if None in joints or len({*joints}) < len(joints):
            continue
        for other in others:
            values = [table.column(name) for name in families[other].values()]
            for name, joint in zip(families[other].values(), joints, strict=True):
                pairs = zip(texts, values, strict=True)
                candidates = [
                    pc.if_else(pc.equal(text, joint), value, None) for text, value in pairs
                ]
                head = other.partition("{}")[0].removesuffix("[")
                at = table.column_names.index(name)
                table = table.set_column(at, f"{head}[{joint}]", pc.coalesce(*candidates))
        table = table.drop_columns([*named.values()])
        notes.append(f"joints by the names in {template.replace('{}', '*')}")
    return table, tuple(notes)
