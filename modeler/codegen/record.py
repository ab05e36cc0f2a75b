"""Which files of a folder an earlier `modeler generate` wrote, and as what.

The record is the file `generated.sha256` beside them, in the form that `sha256sum -c` reads: one
line per file, checksum and name.
"""

import hashlib
import re
from collections.abc import Mapping
from pathlib import Path

RECORD = "generated.sha256"
_LINE = re.compile(r"([0-9a-f]{64})  (\S.*)")

Record = Mapping[str, frozenset[str]]
"""Checksums by name of file; two of a file while it is being replaced."""


def checksum(content: bytes) -> str:
    """SHA-256, in hexadecimal digits."""
    return hashlib.sha256(content).hexdigest()


def read_record(folder: Path) -> Record | None:
    """What was written into the folder; empty if nothing is known; None if that file is no record.

    Raises:
        OSError: the record cannot be read.
    """
    path = folder / RECORD
    if not path.exists():
        return {}
    if not path.is_file():
        return None
    found: dict[str, frozenset[str]] = {}
    for line in path.read_bytes().decode(errors="replace").splitlines():
        match = _LINE.fullmatch(line)
        if match is None:
            return None
        found[match[2]] = found.get(match[2], frozenset()) | {match[1]}
    return found


def record_text(record: Record) -> str:
    """The record as a file."""
    lines = [f"{sum_}  {name}" for name in sorted(record) for sum_ in sorted(record[name])]
    return "".join(f"{line}\n" for line in lines)
