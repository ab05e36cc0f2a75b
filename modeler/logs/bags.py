"""ROS bags as columns: MCAP files, folders and .db3 files of ROS 2, .bag files of ROS 1."""

from pathlib import Path

from modeler.logs.columns import Columns, Wanted, missing_package, reading
from modeler.logs.messages import Recording


def read_bag(path: Path, wanted: Wanted) -> Columns:
    """The columns of the messages of a bag; of each topic that has numbers."""
    what = "ROS bag" if path.suffix.lower() != ".mcap" else "MCAP"
    try:
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
    except ImportError:
        raise missing_package(path, f"a {what}", "rosbags") from None
    recording = Recording()
    with (
        reading(path, what, "record it again, or repair it (`ros2 bag reindex`, `mcap recover`)"),
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
