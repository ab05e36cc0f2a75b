"""ROS bags as columns: MCAP files, folders and .db3 files of ROS 2, .bag files of ROS 1."""

import os
import struct
from pathlib import Path

from modeler.core.files import check_unpacked
from modeler.logs.columns import Columns, Wanted, missing_package, reading
from modeler.logs.messages import Recording


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
