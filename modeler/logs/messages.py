"""Messages of a recording as columns: numeric fields by topic and name, on the clock of one topic.

The clock is the topic whose messages are the rows, as a rule a sensor_msgs/JointState with its
header stamps. What other topics said stands in the rows from the moment it was said: nothing is
interpolated.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.logs.columns import Column, Columns, Stream, Values, Wanted

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
        found: dict[str, Column] = {"time": Values((stamps - start) / 1e9)}
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
                found.setdefault(name, Values(table[:, k]))
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
    if stamp is None:
        return 0
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)


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
