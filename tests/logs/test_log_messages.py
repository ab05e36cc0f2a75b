"""MCAP of every profile, messages of ros2_control, and which stamps are the clock."""

import json
import math
import struct

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.logs.columns import ColumnRequest
from modeler.logs.readers import read_columns
from tests.logs import writers
from tests.logs.writers import JOINTS, joined, json_states, mcap_of, serialized, stamps, states
from tests.rotation import rotating

pytest.importorskip("rosbags", reason="NOT CHECKED: needs rosbags; pip install rosbags")
pytest.importorskip("mcap.writer", reason="NOT CHECKED: needs mcap; pip install mcap")
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

ROS1_HEADER = f"{writers.LINE}\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
MAPPING = ["auto", "names=1:waist,2:shoulder,3:elbow"]


@pytest.mark.parametrize(
    ("profile", "encoding", "packing"),
    [("ros1", "ros1", "LZ4"), ("", "cdr", "ZSTD"), *rotating(("ros2", "cdr", "NONE"))],
)
def test_messages_of_every_profile(profile, encoding, packing, short, tmp_path):
    messages = (
        ("/joint_states", stamp + 50_000, data)
        for stamp, data in serialized(short.table, encoding == "ros1")
    )
    form, kind, header = {
        "ros1": ("ros1msg", "sensor_msgs/JointState", ROS1_HEADER),
        "cdr": ("ros2msg", writers.KIND, writers.HEADER),
    }[encoding]
    path = mcap_of(
        tmp_path / "run.mcap",
        profile,
        messages,
        encoding,
        form,
        kind,
        (writers.FIELDS + header).encode(),
        packing,
    )
    assert "by their headers" in read_columns(path, ColumnRequest()).notes[0]
    short.check(path, MAPPING)


def test_messages_as_objects_of_json(short, tmp_path):
    """By lists, by an object for each joint; what is missing is null."""
    by_joint = []
    for stamp, names, q, tau in states(short.table):
        rows = zip(names, q, tau, strict=True)
        joints = [{"name": n, "position": a, "effort": b} for n, a, b in rows]
        message = {"timestamp": {"sec": stamp // 10**9, "nsec": stamp % 10**9}, "joints": joints}
        by_joint.append(("/js", stamp + 9, json.dumps(message).encode()))
    for messages in (json_states(short.table), by_joint):
        path = mcap_of(tmp_path / "run.mcap", "", messages)
        short.check(path, MAPPING)
    nulls = [("/js", 10**9 + k, b'{"name":["a","b"],"position":[1,null]}') for k in range(12)]
    columns = dict(read_columns(mcap_of(tmp_path / "n.mcap", "", nulls), ColumnRequest()).columns)
    assert math.isnan(columns["js.position[b]"].read_numbers()[0])


def test_an_encoding_that_is_not_read_is_named(tmp_path):
    messages = [("/js", 10**9 + k, b"\x0a\x01a") for k in range(20)]
    path = mcap_of(tmp_path / "run.mcap", "", messages, "protobuf", "protobuf")
    with pytest.raises(
        DataError, match=r"its messages are protobuf JointStates; expected ROS 1, ROS 2 \(cdr\)"
    ):
        read_columns(path, ColumnRequest())


@pytest.mark.parametrize("stated", [10**8, 2**40])
def test_a_chunk_that_states_another_size_is_not_unpacked(stated, tmp_path):
    """Of 1 GiB of zeros in 1 MB never more than is stated is unpacked."""
    import lz4.frame

    data = lz4.frame.compress(bytes(2**27))
    chunk = struct.pack("<QQQI", 0, 0, stated, 0) + struct.pack("<I", 3) + b"lz4"
    chunk += struct.pack("<Q", len(data)) + data
    path = tmp_path / "run.mcap"
    path.write_bytes(b"\x89MCAP0\r\n" + struct.pack("<BQ", 6, len(chunk)) + chunk)
    words = r"another size than it states|unpacks to [\d,]+ MiB"
    with pytest.raises(DataError, match=words):
        read_columns(path, ColumnRequest())


CONTROL = {
    "control_msgs/msg/InterfaceValue": "string[] interface_names\nfloat64[] values",
    "control_msgs/msg/DynamicJointState": "std_msgs/Header header\nstring[] joint_names\n"
    "control_msgs/InterfaceValue[] interface_values",
    "trajectory_msgs/msg/JointTrajectoryPoint": "float64[] positions\nfloat64[] velocities\n"
    "float64[] accelerations\nfloat64[] effort\nbuiltin_interfaces/Duration time_from_start",
    "control_msgs/msg/JointTrajectoryControllerState": "std_msgs/Header header\n"
    "string[] joint_names\n"
    + "\n".join(
        f"trajectory_msgs/JointTrajectoryPoint {part}"
        for part in ("reference", "feedback", "error", "output")
    ),
    "trajectory_msgs/msg/JointTrajectory": "std_msgs/Header header\nstring[] joint_names\n"
    "trajectory_msgs/JointTrajectoryPoint[] points",
}


class Control:
    """Messages of ros2_control in a bag."""

    def __init__(self) -> None:
        self.store = get_typestore(Stores.ROS2_HUMBLE)
        for kind, text in CONTROL.items():
            if kind not in self.store.fielddefs:
                self.store.register(get_types_from_msg(text, kind))

    def header(self, stamp):
        time = self.of("builtin_interfaces/msg/Time", sec=stamp // 10**9, nanosec=stamp % 10**9)
        return self.of("std_msgs/msg/Header", stamp=time, frame_id="")

    def of(self, kind, **fields):
        return self.store.types[kind](**fields)

    def point(self, q=(), effort=(), since=0.0):
        none = np.zeros(0)
        return self.of(
            "trajectory_msgs/msg/JointTrajectoryPoint",
            positions=np.array(q, float),
            velocities=none,
            accelerations=none,
            effort=np.array(effort, float),
            time_from_start=self.of(
                "builtin_interfaces/msg/Duration", sec=int(since), nanosec=round(since % 1.0 * 1e9)
            ),
        )

    def bag(self, path, kind, messages):
        from rosbags.rosbag2 import Writer

        with Writer(path, version=9) as writer:
            channel = writer.add_connection("/arm_controller/state", kind, typestore=self.store)
            for received, message in messages:
                writer.write(channel, received, self.store.serialize_cdr(message, kind))
        return path


@pytest.mark.parametrize("headers", ["valid", *rotating("empty")])
def test_values_by_the_names_of_interfaces(headers, short, tmp_path):
    ros, kind, messages = Control(), "control_msgs/msg/DynamicJointState", []
    for stamp, names, q, tau in states(short.table):
        values = [
            ros.of(
                "control_msgs/msg/InterfaceValue",
                interface_names=["effort", "position"],
                values=np.array([b, a]),
            )
            for a, b in zip(q, tau, strict=True)
        ]
        header = ros.header(stamp if headers == "valid" else 0)
        late = 700_000 if headers == "valid" and len(messages) % 2 else 0
        message = ros.of(kind, header=header, joint_names=names, interface_values=values)
        messages.append((stamp + late, message))
    short.check(ros.bag(tmp_path / "bag", kind, messages), MAPPING)


def test_feedback_is_measured_and_reference_is_commanded(short, tmp_path):
    ros, kind = Control(), "control_msgs/msg/JointTrajectoryControllerState"
    messages = []
    for stamp, names, q, tau in states(short.table):
        points = {"reference": ros.point(q + 0.1), "feedback": ros.point(q, tau)}
        points |= {"error": ros.point(0.1 + 0.0 * q), "output": ros.point((), 9.0 * tau)}
        message = ros.of(kind, header=ros.header(stamp), joint_names=names, **points)
        messages.append((stamp, message))
    log = short.check(ros.bag(tmp_path / "bag", kind, messages), MAPPING)
    assert log.commanded == pytest.approx(log.q + 0.1)


def test_points_of_a_trajectory_are_planned_rows(short, tmp_path):
    ros, kind = Control(), "trajectory_msgs/msg/JointTrajectory"
    q, start = joined(short.table, "q")[:200], stamps(short.table)[0]
    points = [ros.point(row, since=0.01 * k) for k, row in enumerate(q)]
    message = ros.of(kind, header=ros.header(start), joint_names=[*JOINTS], points=points)
    result = read_columns(ros.bag(tmp_path / "bag", kind, [(start + 7, message)]), ColumnRequest())
    columns = {name: column.read_numbers() for name, column in result.columns}
    assert columns["time"] == pytest.approx(0.01 * np.arange(200))
    assert columns["arm_controller/state.points.positions[elbow]"] == pytest.approx(q[:, 2])
    with pytest.raises(DataError, match="no column q1"):  # planned is not measured
        short.check(tmp_path / "bag", MAPPING)


def test_headers_that_stand_still_are_no_clock(tmp_path):
    header = {"stamp": {"sec": 5, "nsec": 0}}
    messages = [
        ("/js", 10**9 + k * 10**6, json.dumps({"header": header, "q": k}).encode())
        for k in range(30)
    ]
    result = read_columns(mcap_of(tmp_path / "run.mcap", "", messages), ColumnRequest())
    assert dict(result.columns)["time"].read_numbers()[-1] == pytest.approx(0.029)
