"""ROS bags and MCAP files: messages as columns on the clock of one topic."""

import json
import os
import struct
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked_size
from modeler.logs.columns import (
    Column,
    ColumnRequest,
    Columns,
    ColumnValues,
    Stream,
    make_package_error,
    wrap_read_errors,
)
from modeler.logs.thresholds import THRESHOLDS

_MAGIC = b"\x89MCAP0\r\n"
_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _END = 3, 4, 5, 6, (2, 15)  # footer, end of data

Read = Callable[[bytes], Any]


def read_mcap_messages(path: Path) -> Iterator[tuple[str, str, int, Any]]:
    """Returns topic, type, time of receipt [ns] and content of all messages.

    In the order of the file.

    The content of a message that is not read is None; its encoding stands before its type.

    Raises:
        DataError: the file unpacks to more than a log does.
        Exception: whatever a damaged file leads to.
    """
    from rosbags.typesys import Stores, get_typestore

    stores = {"ros1": get_typestore(Stores.EMPTY), "cdr": get_typestore(Stores.EMPTY)}
    schemas: dict[int, tuple[str, str, bytes]] = {}
    channels: dict[int, tuple[str, str, Read | None]] = {}
    for kind, body in read_mcap_records(path):
        number = struct.unpack_from("<H", body)[0] if len(body) > 1 else 0
        if kind == _SCHEMA:
            name, at = _read_text(body, 2)
            form, at = _read_text(body, at)
            schemas[number] = name, form, body[at + 4 :]
        elif kind == _CHANNEL:
            topic, at = _read_text(body, 4)
            encoding, _ = _read_text(body, at)
            schema = schemas.get(struct.unpack_from("<H", body, 2)[0], ("", "", b""))
            read = json.loads if encoding == "json" else _find_reader(stores.get(encoding), *schema)
            channels[number] = topic, schema[0] if read else f"{encoding} {schema[0]}".strip(), read
        elif kind == _MESSAGE:
            topic, name, read = channels[number]
            content = None if read is None else read(body[22:])
            yield topic, name, struct.unpack_from("<Q", body, 6)[0], content


def _find_reader(store: Any, name: str, form: str, definition: bytes) -> Read | None:
    """Of messages of a type of ROS, by its definition or by its name; None of others."""
    from rosbags.typesys import Stores, TypesysError, get_typestore
    from rosbags.typesys import get_types_from_idl, get_types_from_msg  # isort: skip

    if store is None or form not in ("ros1msg", "ros2msg", "ros2idl", "omgidl", ""):
        return None
    kind, text = name if "/msg/" in name else name.replace("/", "/msg/"), definition.decode()
    with suppress(TypesysError):  # a definition that is not understood
        if form.endswith("idl"):
            for part in filter(str.strip, text.split("=" * 80 + "\n")):
                idl_text = part.partition("\n")[2] if part.startswith("IDL:") else part
                store.register(get_types_from_idl(idl_text))
        elif text:
            store.register(get_types_from_msg(text, kind))
        else:
            store = get_typestore(Stores.LATEST)
    read = store.deserialize_ros1 if form == "ros1msg" else store.deserialize_cdr
    return (lambda data: read(data, kind)) if kind in store.fielddefs else None


def read_mcap_records(path: Path) -> Iterator[tuple[int, bytes]]:
    """Returns type and content of every record, of chunks those inside.

    A chunk is unpacked to the size that it states and no further.
    """
    size = kind = 0
    with path.open("rb") as file:
        if file.read(len(_MAGIC)) != _MAGIC:
            raise ValueError("it does not begin as an MCAP file")
        while kind not in _END:
            head = file.read(9)
            kind, length = struct.unpack("<BQ", head) if len(head) == 9 else (0, 1)
            start = file.read(min(length, 28))
            if kind == _CHUNK and len(start) >= 24:
                size += struct.unpack_from("<Q", start, 16)[0]
                check_unpacked_size(path, size)
            body = start + file.read(length - len(start))
            if len(body) < length:
                raise ValueError(f"it ends within a record, at byte {file.tell()}")
            yield from _read_chunk(body) if kind == _CHUNK else ((kind, body),)


def _read_chunk(body: bytes) -> Iterator[tuple[int, bytes]]:
    size, checksum = struct.unpack_from("<QI", body, 16)
    packing, at = _read_text(body, 28)
    data, at = unpack_bytes(body[at + 8 :], packing, size), 0
    if checksum and zlib.crc32(data) != checksum:
        raise ValueError("a chunk has another checksum than it states")
    while at < size:
        kind, length = struct.unpack_from("<BQ", data, at)
        if (end := at + 9 + length) > size:
            raise ValueError("a record is longer than its chunk")
        yield kind, data[at + 9 : end]
        at = end


def _read_text(body: bytes, at: int) -> tuple[str, int]:
    """A text after its length, and where what follows begins."""
    end = at + 4 + struct.unpack_from("<I", body, at)[0]
    return body[at + 4 : end].decode(), end


def unpack_bytes(data: bytes, packing: str, size: int) -> bytes:
    """Returns so many bytes; never more are unpacked.

    Raises:
        ValueError: it unpacks to more or less.
    """
    if packing not in ("", "none"):
        data = pa.CompressedInputStream(pa.BufferReader(data), packing).read(size + 1)
    if len(data) != size:
        raise ValueError("a chunk unpacks to another size than it states")
    return data


# Messages of a recording as columns: numeric fields by topic and name, on the clock of one topic.
#
# The clock is the topic whose messages are the rows, as a rule a sensor_msgs/JointState with its
# header stamps. What other topics said stands in the rows from the moment it was said: nothing is
# interpolated.


LONGEST = 64
"""Entries of an array that become columns; longer ones are images and the like."""

STATES = (
    "sensor_msgs/JointState",
    "control_msgs/DynamicJointState",
    "control_msgs/JointTrajectoryControllerState",
)
"""Types of the topics that are taken as the clock where none is requested, the first before all."""

_NAMES = ("name", "joint_names")  # lists of text that say which entry of an array is whose
_PIECE = 2**24  # bytes that are unpacked at a time, to be counted


@dataclass(eq=False)
class TopicMessages:
    """The messages of one topic that name the same joints.

    Attributes:
        topic: with its slash.
        kind: type of its messages.
        labels: of the values of a message.
        headers: stamps of the messages, ns; 0 without one.
        received: when they came, ns.
        rows: values of each message, in the order of the labels.
    """

    topic: str
    kind: str
    labels: tuple[str, ...]
    headers: list[int] = field(default_factory=list)
    received: list[int] = field(default_factory=list)
    rows: list[list[float]] = field(default_factory=list)

    @property
    def has_stamps(self) -> bool:
        """Returns True if the headers show the time: all of them do, and it passes."""
        return min(self.headers) > 0 and (len(self.headers) < 2 or len({*self.headers}) > 1)

    def get_stamps(self, by_header: bool) -> np.ndarray:
        """Returns (n,) ns, by the headers or as they were received."""
        return np.array(self.headers if by_header else self.received, dtype=np.int64)


class Recording:
    """All that a bag holds, message after message."""

    def __init__(self) -> None:
        self._parts: dict[tuple[str, tuple[str, ...]], TopicMessages] = {}
        self.unreadable: set[str] = set()

    @property
    def is_empty(self) -> bool:
        """Returns True if no message had numbers."""
        return not self._parts

    def add_message(self, topic: str, kind: str, received: int, message: Any) -> bool:
        """Adds one message; returns False if it has no numbers to keep."""
        fields, stamp = _get_fields(message), _read_stamp(message)
        if isinstance(points := fields.get("points"), list) and _find_names(fields):
            for point in points:  # of a planned trajectory, each at its own time
                since = _read_nanoseconds(_get_fields(point).get("time_from_start"))
                at = stamp + since if stamp else 0
                names = _find_names(fields)
                self._add_values(topic, kind, received + since, at, point, "points", names)
            return True
        return self._add_values(topic, kind, received, stamp, message, "", _find_names(fields))

    def _add_values(
        self,
        topic: str,
        kind: str,
        received: int,
        stamp: int,
        message: Any,
        head: str,
        names: Sequence[str],
    ) -> bool:
        labels: list[str] = []
        values: list[float] = []
        _flatten_message(message, head, names, labels, values)
        if not labels:
            return False
        key = (topic, tuple(sorted(labels)))
        part = self._parts.get(key)
        if part is None:
            part = self._parts[key] = TopicMessages(topic, kind, tuple(labels))
        if part.labels != tuple(labels):  # the same joints in another order
            value_of = dict(zip(labels, values, strict=True))
            values = [value_of[label] for label in part.labels]
        part.headers.append(stamp)
        part.received.append(received)
        part.rows.append(values)
        return True

    def build_columns(self, path: object, wanted: ColumnRequest) -> Columns:
        """Returns all topics on the clock of one.

        Raises:
            DataError: none can be the clock, or several can.
        """
        parts = sorted(self._parts.values(), key=lambda part: -len(part.rows))
        clock = _choose_clock(path, parts, wanted)
        stamps = clock.get_stamps(clock.has_stamps)
        order = np.argsort(clock.received, kind="stable")
        start = int(stamps[order[0]])
        columns: dict[str, Column] = {"time": ColumnValues((stamps[order] - start) / 1e9)}
        notes = [
            f"rows are the messages of {clock.topic}, time from the first, by "
            + ("their headers" if clock.has_stamps else "when they were received")
        ]
        for part in (clock, *(part for part in parts if part is not clock)):
            table = np.array(part.rows, dtype=float)
            if part is clock:
                table = table[order]
            else:
                alike = part.has_stamps and clock.has_stamps  # else by the clock of the recorder
                table, oldest = _join_to_clock(part, table, clock.get_stamps(alike)[order], alike)
                notes.append(
                    f"{part.topic} joined to that clock: the last message before each row, at "
                    f"most {oldest * 1e-9:.3g} s old"
                )
            for k, label in enumerate(part.labels):
                name = f"{part.topic.strip('/')}.{label}"
                columns.setdefault(name, ColumnValues(table[:, k]))
        if self.unreadable:
            listed = ", ".join(sorted(self.unreadable))
            notes.append(f"{listed} left out: messages of unknown types")
        streams = [Stream(p.topic, p.kind, len(p.rows), p is clock) for p in parts]
        return Columns(tuple(columns.items()), len(stamps), {}, tuple(notes), tuple(streams))


def _choose_clock(
    path: object, parts: Sequence[TopicMessages], wanted: ColumnRequest
) -> TopicMessages:
    """The topic that is requested, else the only JointState, else the only one."""
    parts = [part for part in parts if len(part.rows) >= THRESHOLDS.min_messages] or list(parts)
    topics = [part.topic for part in parts]
    listed = ", ".join(dict.fromkeys(topics)) or "none with numbers"
    if wanted.topic:
        named = [part for part in parts if part.topic.strip("/") == wanted.topic.strip("/")]
        if not named:
            raise DataError(
                f"{path}: topic {wanted.topic}: no messages of it; the topics are {listed}"
            )
        return named[0]
    kinds = {kind: k for k, kind in enumerate(STATES)}
    rank = {id(part): kinds.get(part.kind.replace("/msg/", "/"), len(STATES)) for part in parts}
    states = [part for part in parts if rank[id(part)] == min(rank.values())]
    if not states:
        raise DataError(f"{path}: no topic with numbers; expected sensor_msgs/JointState messages")
    if len({part.topic for part in states}) > 1 and not wanted.any:
        raise DataError(
            f"{path}: {len({part.topic for part in states})} topics may hold the motion: {listed}; "
            f'choose one: --map topic={states[0].topic}, or topic = "{states[0].topic}" in [log]'
        )
    return states[0]


def _join_to_clock(
    part: TopicMessages, table: np.ndarray, clock: np.ndarray, by_header: bool
) -> tuple[np.ndarray, float]:
    """The last message of a topic at each stamp of the clock, NaN before the first; its age, ns."""
    stamps = part.get_stamps(by_header)
    order = np.argsort(stamps, kind="stable")
    stamps = stamps[order]
    last = np.searchsorted(stamps, clock, side="right") - 1
    joined = table[order][np.maximum(last, 0)]
    joined[last < 0] = np.nan
    known = last >= 0
    age = (clock - stamps[np.maximum(last, 0)])[known]
    return joined, float(age.max()) if known.any() else 0.0


def _get_fields(value: Any) -> Mapping[str, Any]:
    """Of a message of ROS, or of an object of JSON; none of anything else."""
    if isinstance(value, Mapping):
        return value
    names = getattr(value, "__dataclass_fields__", ())
    return {n: getattr(value, n) for n in names if not (n.startswith("__") or n.isupper())}


def _read_stamp(message: Any) -> int:
    """Of the header, or of the message itself, ns; 0 without one."""
    fields = _get_fields(message)
    header = _get_fields(fields.get("header", message))
    return _read_nanoseconds(header.get("stamp", header.get("timestamp")))


def _read_nanoseconds(time: Any) -> int:
    """Of a time of ROS; 0 without one."""
    fields = _get_fields(time)
    names = (("sec", "secs"), ("nanosec", "nsec", "nsecs"))
    of = [next((fields[n] for n in each if n in fields), 0) for each in names]
    return int(of[0]) * 1_000_000_000 + int(of[1])


def _find_names(fields: Mapping[str, Any]) -> tuple[str, ...]:
    for field_name in _NAMES:
        names = fields.get(field_name)
        if isinstance(names, list | tuple) and names and all(isinstance(n, str) for n in names):
            return tuple(names)
    return ()


def _flatten_message(
    value: Any, label: str, names: Sequence[str], labels: list[str], values: list[float]
) -> None:
    """Every number in a message: fields after a point, entries of arrays in brackets.

    Entries that are messages and have a name have it behind their fields: `values.position[elbow]`.
    """
    if isinstance(value, bool | int | float | np.number | np.bool_):
        labels.append(label)
        values.append(float(value))
        return
    if isinstance(value, str | bytes) or value is None:
        return
    if isinstance(value, list | tuple | np.ndarray):
        if len(value) > LONGEST:
            return
        entry_names = names if len(names) == len(value) else [str(k + 1) for k in range(len(value))]
        for name, entry in zip(entry_names, value, strict=True):
            fields = _get_fields(entry)
            said = fields.get("name", name if entry_names is names else None)
            if not fields or not isinstance(said, str):
                entry = float("nan") if entry is None else entry
                _flatten_message(entry, f"{label}[{name}]", names, labels, values)
                continue
            first = len(labels)
            _flatten_message(entry, label, _find_names(fields), labels, values)
            labels[first:] = [f"{one}[{said}]" for one in labels[first:]]
        return
    fields = _get_fields(value)
    if "interface_names" in fields and "values" in fields:  # of control_msgs
        fields = dict(zip(fields["interface_names"], fields["values"], strict=True))
    for name, content in fields.items():
        if not (name == "header" and not label):
            _flatten_message(content, f"{label}.{name}" if label else name, names, labels, values)


# ROS bags as columns: MCAP files, folders and .db3 files of ROS 2, .bag files of ROS 1.


def read_bag(path: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of the messages of a bag; of each topic that has numbers."""
    kind = path.suffix.lower()
    what = "ROS bag" if kind != ".mcap" else "MCAP"
    repair = {".mcap": "mcap recover", ".bag": "rosbag reindex"}.get(kind, "ros2 bag reindex")
    try:
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
    except ModuleNotFoundError:
        raise make_package_error(path, f"a {what}", "rosbags") from None
    recording, encodings = Recording(), set[str]()
    with wrap_read_errors(path, what, f"record it again, or repair it (`{repair}`)"):
        if path.is_file() and kind == ".mcap":
            for topic, name, received, message in read_mcap_messages(path):
                if message is None:
                    recording.unreadable.add(topic)
                    encodings.add(name)
                else:
                    recording.add_message(topic, name, received, message)
            if recording.unreadable and recording.is_empty:
                raise DataError(
                    f"{path}: its messages are {' or '.join(sorted(encodings))}; expected ROS 1, "
                    "ROS 2 (cdr) or json; write the joint states as CSV, or record them as one"
                )
            return recording.build_columns(path, wanted)
        for file in path.rglob("*") if path.is_dir() else (path,):
            _check_packed(path, file)
        with AnyReader([path], default_typestore=get_typestore(Stores.LATEST)) as bag:
            known = [c for c in bag.connections if c.msgtype in bag.typestore.fielddefs]
            recording.unreadable |= {c.topic for c in bag.connections if c not in known}
            empty: set[int] = set()
            for connection, received, raw in bag.messages(connections=known) if known else ():
                if connection.id in empty:
                    continue
                message = bag.deserialize(raw, connection.msgtype)
                topic, kind = connection.topic, connection.msgtype
                if not recording.add_message(topic, kind, received, message):
                    empty.add(connection.id)
    return recording.build_columns(path, wanted)


def _check_packed(path: Path, file: Path) -> None:
    """Refuse a file of a bag that unpacks to more than a log does, or to more than it states.

    ROS 1 (bag format 2.0): records of a header of named fields (`op`, 5: chunk; `size`) and data,
    each after its length of 32 bits.
    """
    ending, size = file.suffix.lower(), 0
    if ending == ".mcap":
        for _ in read_mcap_records(file):
            pass
    elif ending == ".zstd":
        with pa.input_stream(str(file), compression="zstd") as packed:
            while piece := packed.read(_PIECE):
                size += len(piece)
                check_unpacked_size(path, size)
    elif ending == ".bag":
        with file.open("rb") as raw:
            raw.seek(13)
            while len(head := raw.read(4)) == 4:
                header = raw.read(min(struct.unpack("<I", head)[0], THRESHOLDS.max_header_bytes))
                length = int.from_bytes(raw.read(4), "little")
                if b"op=\x05" not in header:
                    raw.seek(length, os.SEEK_CUR)
                    continue
                at = header.find(b"size=") + 5
                size += (stated := int.from_bytes(header[at : at + 4], "little"))
                check_unpacked_size(path, size)
                words = {p: f"compression={p}".encode() for p in ("lz4", "bz2")}
                packing = next((p for p, word in words.items() if word in header), "")
                unpack_bytes(raw.read(length), packing, stated)
