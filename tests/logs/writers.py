"""Logs as other people's programs write them."""

import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import scipy.io

JOINTS = ("waist", "shoulder", "elbow")
"""What the logs call the joints 1, 2, 3."""

Table = Mapping[str, np.ndarray]
"""Ours: time, q1.., tau1.., SI."""

START = 1_700_000_000_123_456_789  # ns, an hour of some day


def joined(table: Table, prefix: str) -> np.ndarray:
    return np.column_stack([table[f"{prefix}{j}"] for j in (1, 2, 3)])


class Run(dict[str, np.ndarray]):
    """A run in our columns and SI units, and the same numbers as other people log them.

    `other` is in ms, degrees, one joint the other way, and mN m; ours are what these mean.
    """

    def __init__(self, table: Table) -> None:
        q = np.rad2deg(joined(table, "q")) * [1.0, -1.0, 1.0]
        tau = joined(table, "tau") * 1e3
        self.other = {"t": table["time"] * 1e3, "pos": q, "load": tau}
        super().__init__(time=self.other["t"] * 1e-3)
        q = np.deg2rad(q) * [1.0, -1.0, 1.0]
        self.update({f"q{j + 1}": q[:, j] for j in range(3)})
        self.update({f"tau{j + 1}": tau[:, j] * 1e-3 for j in range(3)})


MAPPING = {
    "time": "t [ms]",
    "q<j>": "pos[{n}] [deg]",
    "q2": {"column": "pos[2]", "unit": "deg", "sign": -1},
    "tau<j>": {"column": "load[{n}]", "unit": "mN m"},
}


def under(head: str, mapping: Mapping[str, object]) -> dict[str, object]:
    """The mapping with a name in front of every column."""
    table: dict[str, object] = {}
    for item, entry in mapping.items():
        if isinstance(entry, str):
            table[item] = head + entry
        else:
            table[item] = {**entry, "column": head + entry["column"]}  # type: ignore[dict-item]
    return table


def parquet(path: Path, table: Table) -> Path:
    pq.write_table(pa.table({name: pa.array(values) for name, values in table.items()}), path)
    return path


def mat(path: Path, table: Run) -> Path:
    """A struct `data` of (n, 1) and (n, 3) arrays, and things that are no columns."""
    other = table.other | {"t": table.other["t"][:, None]}
    content = {"data": other, "fs": 500.0, "who": "me", "pose": np.eye(4)}
    scipy.io.savemat(path, content, do_compression=True)
    return path


def mat73(path: Path, table: Run) -> Path:
    """As MATLAB writes -v7.3: HDF5 after a block, arrays by columns, classes as attributes."""
    h5py = pytest.importorskip("h5py", reason="NOT CHECKED: needs h5py; pip install h5py")
    with h5py.File(path, "w", userblock_size=512) as file:
        group = file.create_group("data")
        group.attrs["MATLAB_class"] = np.bytes_("struct")
        for name, values in table.other.items():
            values = values[:, None] if values.ndim == 1 else values
            item = group.create_dataset(name, data=values.T, chunks=True, compression="gzip")
            item.attrs["MATLAB_class"] = np.bytes_("double")
        text = file.create_dataset("who", data=np.array([[109], [101]], dtype=np.uint16))
        text.attrs["MATLAB_class"] = np.bytes_("char")
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM")
    return path


def hdf5(path: Path, table: Run) -> Path:
    """A group `arm`; the current of the unit is an attribute of the positions."""
    h5py = pytest.importorskip("h5py", reason="NOT CHECKED: needs h5py; pip install h5py")
    with h5py.File(path, "w") as file:
        for name, values in table.other.items():
            file[f"arm/{name}"] = values
        file["arm/pos"].attrs["units"] = "deg"
        file["version"] = 3
    return path


def npz(path: Path, table: Run) -> Path:
    np.savez(path, **{name: values.T for name, values in table.other.items()})
    return path


ROS = {
    "names": dict(zip("123", JOINTS, strict=True)),
    "q<j>": "joint_states.position[{name}]",
    "tau<j>": "joint_states.effort[{name}]",
}


def stamps(table: Table) -> list[int]:
    return [START + round(t * 1e9) for t in table["time"]]


ORDERS = ((0, 1, 2), (2, 0, 1))
"""Of the joints in messages: drivers sort them as they like."""


def states(table: Table):
    """(stamp, names, positions, efforts) of every message."""
    q, tau = joined(table, "q"), joined(table, "tau")
    for k, stamp in enumerate(stamps(table)):
        order = list(ORDERS[k % 2])
        yield stamp, [JOINTS[i] for i in order], q[k, order], tau[k, order]


def mcap(path: Path, table: Run) -> Path:
    """By the library of the format: joint states, and a slower temperature."""
    reason = "NOT CHECKED: needs mcap-ros2-support; pip install mcap-ros2-support"
    writer_of = pytest.importorskip("mcap_ros2.writer", reason=reason)
    with path.open("wb") as file:
        writer = writer_of.Writer(file)
        joint = writer.register_msgdef(KIND, FIELDS + HEADER)
        fields = "std_msgs/Header header\nfloat64 temperature\nfloat64 variance\n"
        heat = writer.register_msgdef("sensor_msgs/msg/Temperature", fields + HEADER)
        text = writer.register_msgdef("std_msgs/msg/String", "string data")
        writer.write_message("/rosout", text, {"data": "hello"}, START)
        for k, (stamp, names, q, tau) in enumerate(states(table)):
            header = {"stamp": _stamp(stamp), "frame_id": ""}
            message = {
                "header": header,
                "name": names,
                "position": q.tolist(),
                "velocity": [],
                "effort": tau.tolist(),
            }
            writer.write_message("/joint_states", joint, message, stamp + 50_000)
            if k % 100 == 50:
                message = {"header": header, "temperature": 20.0 + k, "variance": 0.0}
                writer.write_message("/motor/heat", heat, message, stamp + 60_000)
        writer.finish()
    return path


def mcap_of(
    path: Path,
    profile: str,
    messages: Iterable[tuple],
    encoding: str = "json",
    form: str = "jsonschema",
    kind: str = "JointStates",
    definition: bytes = b"{}",
    compression: str = "LZ4",
) -> Path:
    """Messages as (topic, ns, bytes); the library of the format writes them."""
    reason = "NOT CHECKED: needs mcap; pip install mcap"
    writer_of = pytest.importorskip("mcap.writer", reason=reason)
    with path.open("wb") as file:
        writer = writer_of.Writer(file, compression=writer_of.CompressionType[compression])
        writer.start(profile)
        schema = writer.register_schema(kind, form, definition)
        channels = {}
        for topic, stamp, data in messages:
            if topic not in channels:
                channels[topic] = writer.register_channel(topic, encoding, schema)
            writer.add_message(channels[topic], stamp, data, stamp)
        writer.finish()
    return path


def json_states(table: Run) -> Iterator[tuple]:
    """Joint states as objects of JSON, by lists."""
    for stamp, names, q, tau in states(table):
        header = {"stamp": {"sec": stamp // 10**9, "nsec": stamp % 10**9}}
        message = {"header": header, "name": names, "position": [*q], "effort": [*tau]}
        yield "/js", stamp + 9, json.dumps(message).encode()


def serialized(table: Run, ros1: bool = False, gripper: bool = False) -> Iterator[tuple]:
    """(stamp, bytes) of every message of joint states; with a gripper, those of it between them."""
    reason = "NOT CHECKED: needs rosbags; pip install rosbags"
    typesys = pytest.importorskip("rosbags.typesys", reason=reason)
    store = typesys.get_typestore(store_of(ros1))
    types, write = store.types, store.serialize_ros1 if ros1 else store.serialize_cdr

    def message(stamp: int, names: list[str], q: np.ndarray, tau: np.ndarray) -> bytes:
        time = types["builtin_interfaces/msg/Time"](**_stamp(stamp))
        seq = {"seq": 7} if ros1 else {}
        header = types["std_msgs/msg/Header"](stamp=time, frame_id="", **seq)
        joints = types[KIND](
            header=header, name=names, position=q, velocity=np.zeros(0), effort=tau
        )
        return bytes(write(joints, KIND))

    for k, (stamp, names, q, tau) in enumerate(states(table)):
        if gripper and k % 7 == 3:
            one, early = np.full(1, 0.01 * k), stamp - 300_000
            yield early, message(early, ["finger"], one, one)
        yield stamp, message(stamp, names, q, tau)


def store_of(ros1: bool) -> Any:
    """The types of a version of ROS."""
    from rosbags.typesys import Stores

    return Stores.ROS1_NOETIC if ros1 else Stores.ROS2_HUMBLE


def bag(path, table, storage="SQLITE3", extra_topic="", gripper=False):
    """A ROS 2 bag as a folder; with another robot's joint states if a topic is given for them."""
    reason = "NOT CHECKED: needs rosbags; pip install rosbags"
    rosbag2 = pytest.importorskip("rosbags.rosbag2", reason=reason)
    plugin = rosbag2.StoragePlugin[storage]
    with rosbag2.Writer(path, version=9, storage_plugin=plugin) as writer:
        _write(writer, serialized(table, False, gripper), store_of(False), extra_topic)
    return path


def bag1(path: Path, table: Run) -> Path:
    """A bag of ROS 1."""
    reason = "NOT CHECKED: needs rosbags; pip install rosbags"
    rosbag1 = pytest.importorskip("rosbags.rosbag1", reason=reason)
    with rosbag1.Writer(path) as writer:
        _write(writer, serialized(table, True), store_of(True))
    return path


def _write(writer: Any, messages: Iterable[tuple], store: Any, extra_topic: str = "") -> None:
    from rosbags.typesys import get_typestore

    topics = ["/joint_states", *([extra_topic] if extra_topic else [])]
    channels = [writer.add_connection(t, KIND, typestore=get_typestore(store)) for t in topics]
    for stamp, data in messages:
        for channel in channels:
            writer.write(channel, stamp + 50_000, data)


def _stamp(stamp: int) -> dict[str, int]:
    return {"sec": stamp // 10**9, "nanosec": stamp % 10**9}


KIND = "sensor_msgs/msg/JointState"
LINE = "=" * 80
HEADER = f"""{LINE}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
{LINE}
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
FIELDS = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
"""
