"""Messages of MCAP files, of any profile: ROS 1, ROS 2 (CDR) and JSON.

MCAP format specification, version 0: records of a type, a length of 64 bits and that many bytes,
some of them in chunks that are packed by LZ4 or Zstandard.
"""

import json
import struct
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pyarrow as pa

from modeler.core.files import check_unpacked_size

_MAGIC = b"\x89MCAP0\r\n"
_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _END = 3, 4, 5, 6, (2, 15)  # footer, end of data

Read = Callable[[bytes], Any]


def read_mcap_messages(path: Path) -> Iterator[tuple[str, str, int, Any]]:
    """Topic, type, time of receipt [ns] and content of all messages, in the order of the file.

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
    """Type and content of every record, of chunks those inside.

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
    """So many bytes; never more are unpacked.

    Raises:
        ValueError: it unpacks to more or less.
    """
    if packing not in ("", "none"):
        data = pa.CompressedInputStream(pa.BufferReader(data), packing).read(size + 1)
    if len(data) != size:
        raise ValueError("a chunk unpacks to another size than it states")
    return data
