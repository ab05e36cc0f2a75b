"""Messages of a recording as columns: numeric fields by topic and name, on the clock of one topic.

The clock is the topic whose messages are the rows, as a rule a sensor_msgs/JointState with its
header stamps. What other topics said stands in the rows from the moment it was said: nothing is
interpolated.
"""

import os
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked
from modeler.logs.columns import (
    Column,
    Columns,
    ColumnValues,
    Stream,
    Wanted,
    missing_package,
    reading,
)

LONGEST = 64
"""Entries of an array that become columns; longer ones are images and the like."""

JOINT_STATE = "sensor_msgs/msg/JointState"
"""Type of the topics that are taken as the clock where none is asked for."""

_NAMES = ("name", "joint_names")  # lists of text that say which entry of an array is whose
_LEAST = 10


@dataclass(eq=False)
class Recorded:
    """The messages of one topic that name the same joints.

    Attributes:
        topic: with its slash.
        kind: type of its messages.
        labels: of the values of a message.
        stamps: of the messages, ns.
        rows: values of each message, in the order of the labels.
        stamped: True if the stamps are those of the headers.
    """

    topic: str
    kind: str
    labels: tuple[str, ...]
    stamps: list[int] = field(default_factory=list)
    rows: list[list[float]] = field(default_factory=list)
    stamped: bool = True


class Recording:
    """All that a bag holds, message after message."""

    def __init__(self) -> None:
        self._parts: dict[tuple[str, tuple[str, ...]], Recorded] = {}
        self.unreadable: list[str] = []

    def add(self, topic: str, kind: str, received: int, message: Any) -> bool:
        """One message; False if it has no numbers to keep."""
        labels: list[str] = []
        values: list[float] = []
        _flatten(message, "", _names(message), labels, values)
        if not labels:
            return False
        key = (topic, tuple(sorted(labels)))
        part = self._parts.get(key)
        if part is None:
            part = self._parts[key] = Recorded(topic, kind, tuple(labels))
        if part.labels != tuple(labels):  # the same joints in another order
            value_of = dict(zip(labels, values, strict=True))
            values = [value_of[label] for label in part.labels]
        stamp = _stamp(message)
        part.stamped &= stamp > 0
        part.stamps.append(stamp or received)
        part.rows.append(values)
        return True

    def columns(self, path: object, wanted: Wanted) -> Columns:
        """All topics on the clock of one.

        Raises:
            DataError: none can be the clock, or several can.
        """
        parts = sorted(self._parts.values(), key=lambda part: -len(part.stamps))
        clock = _clock(path, parts, wanted)
        start, stamps = clock.stamps[0], np.array(clock.stamps, dtype=np.int64)
        found: dict[str, Column] = {"time": ColumnValues((stamps - start) / 1e9)}
        notes = [
            f"rows are the messages of {clock.topic}, time from the first, by "
            + ("their headers" if clock.stamped else "when they were received")
        ]
        for part in (clock, *(part for part in parts if part is not clock)):
            table = np.array(part.rows, dtype=float)
            if part is not clock:
                table, oldest = _held(part, table, stamps)
                notes.append(
                    f"{part.topic} joined to that clock: the last message before each row, at "
                    f"most {oldest * 1e-9:.3g} s old"
                )
            for k, label in enumerate(part.labels):
                name = f"{part.topic.strip('/')}.{label}"
                found.setdefault(name, ColumnValues(table[:, k]))
        if self.unreadable:
            notes.append(f"{', '.join(self.unreadable)} left out: messages of unknown types")
        streams = [Stream(p.topic, p.kind, len(p.stamps), p is clock) for p in parts]
        return Columns(tuple(found.items()), len(stamps), {}, tuple(notes), tuple(streams))


def _clock(path: object, parts: Sequence[Recorded], wanted: Wanted) -> Recorded:
    """The topic that is asked for, else the only JointState, else the only one."""
    parts = [part for part in parts if len(part.stamps) >= _LEAST] or list(parts)
    topics = [part.topic for part in parts]
    listed = ", ".join(dict.fromkeys(topics)) or "none with numbers"
    if wanted.topic:
        named = [part for part in parts if part.topic.strip("/") == wanted.topic.strip("/")]
        if not named:
            raise DataError(
                f"{path}: topic {wanted.topic}: no messages of it; the topics are {listed}"
            )
        return named[0]
    states = [part for part in parts if part.kind == JOINT_STATE] or list(parts)
    if not states:
        raise DataError(f"{path}: no topic with numbers; expected sensor_msgs/JointState messages")
    if len({part.topic for part in states}) > 1 and not wanted.any:
        raise DataError(
            f"{path}: {len({part.topic for part in states})} topics may hold the motion: {listed}; "
            f'choose one: --map topic={states[0].topic}, or topic = "{states[0].topic}" in [log]'
        )
    return states[0]


def _held(part: Recorded, table: np.ndarray, clock: np.ndarray) -> tuple[np.ndarray, float]:
    """The last message of a topic at each stamp of the clock, NaN before the first; its age, ns."""
    order = np.argsort(np.array(part.stamps, dtype=np.int64), kind="stable")
    stamps = np.array(part.stamps, dtype=np.int64)[order]
    last = np.searchsorted(stamps, clock, side="right") - 1
    joined = table[order][np.maximum(last, 0)]
    joined[last < 0] = np.nan
    known = last >= 0
    age = (clock - stamps[np.maximum(last, 0)])[known]
    return joined, float(age.max()) if known.any() else 0.0


def _stamp(message: Any) -> int:
    """Of the header, ns; 0 without one."""
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    return 0 if stamp is None else int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)


def _names(message: Any) -> tuple[str, ...]:
    for field_name in _NAMES:
        names = getattr(message, field_name, None)
        if isinstance(names, list | tuple) and names and all(isinstance(n, str) for n in names):
            return tuple(names)
    return ()


def _flatten(
    value: Any, label: str, names: Sequence[str], labels: list[str], values: list[float]
) -> None:
    """Every number in a message: fields after a point, entries of arrays in brackets."""
    if isinstance(value, bool | int | float | np.number | np.bool_):
        labels.append(label)
        values.append(float(value))
        return
    if isinstance(value, str | bytes) or value is None:
        return
    if isinstance(value, list | tuple | np.ndarray):
        if len(value) > LONGEST:
            return
        own = names if len(names) == len(value) else [str(k + 1) for k in range(len(value))]
        for name, entry in zip(own, value, strict=True):
            _flatten(entry, f"{label}[{name}]", names, labels, values)
        return
    fields: dict[str, Callable[[], Any]] = getattr(value, "__dataclass_fields__", {})
    for name in fields:
        if not (name.startswith("__") or name.isupper() or (name == "header" and not label)):
            _flatten(getattr(value, name), f"{label}.{name}" if label else name, names, labels,
                     values)  # fmt: skip


# ROS bags as columns: MCAP files, folders and .db3 files of ROS 2, .bag files of ROS 1.


def read_bag(path: Path, wanted: Wanted) -> Columns:
    """The columns of the messages of a bag; of each topic that has numbers."""
    kind = path.suffix.lower()
    what = "ROS bag" if kind != ".mcap" else "MCAP"
    repair = {".mcap": "mcap recover", ".bag": "rosbag reindex"}.get(kind, "ros2 bag reindex")
    try:
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
    except ModuleNotFoundError:
        raise missing_package(path, f"a {what}", "rosbags") from None
    for file in path.rglob("*") if path.is_dir() else (path,):
        check_unpacked(path, _declared(file))
    recording = Recording()
    with (
        reading(path, what, f"record it again, or repair it (`{repair}`)"),
        AnyReader([path], default_typestore=get_typestore(Stores.LATEST)) as bag,
    ):
        known = [c for c in bag.connections if c.msgtype in bag.typestore.fielddefs]
        recording.unreadable = sorted({c.topic for c in bag.connections if c not in known})
        empty: set[int] = set()
        for connection, received, raw in bag.messages(connections=known) if known else ():
            if connection.id in empty:
                continue
            message = bag.deserialize(raw, connection.msgtype)
            if not recording.add(connection.topic, connection.msgtype, received, message):
                empty.add(connection.id)
    return recording.columns(path, wanted)


def _declared(path: Path) -> int:
    """Bytes of all chunks of an MCAP file or of a ROS 1 bag once unpacked, by their own headers.

    MCAP: records of a type (6: chunk), a length of 64 bits, then two times and the size unpacked.
    ROS 1 (bag format 2.0): records of a header of named fields (`op`, 5: chunk; `size`) and data,
    each after its length of 32 bits.
    """
    size, mcap = 0, path.suffix.lower() == ".mcap"
    if not mcap and path.suffix.lower() != ".bag":
        return 0
    with path.open("rb") as file:
        file.seek(8 if mcap else 13)
        while len(head := file.read(9 if mcap else 4)) == (9 if mcap else 4):
            if mcap:
                kind, length = struct.unpack("<BQ", head)
                body = file.read(min(length, 24))
                size += struct.unpack("<Q", body[16:])[0] if kind == 6 and len(body) == 24 else 0
            else:
                body = file.read(min(struct.unpack("<I", head)[0], 4096)) + file.read(4)
                at = body.find(b"size=") + 5
                size += int.from_bytes(body[at : at + 4], "little") if b"op=\x05" in body else 0
                length = len(body) + int.from_bytes(body[-4:], "little")
            file.seek(min(length - len(body), 2**40), os.SEEK_CUR)
    return size
