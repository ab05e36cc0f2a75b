"""Where a write to a path lands: its links followed, and what is there now."""

import enum
import errno
import os
import re
import stat
from dataclasses import dataclass
from pathlib import Path

from modeler.core.errors import ModelerError

# Files that a process has open, by number. These look like links, and lead to a place that may be
# a pipe without a name, or a file at whose end we stand already: they are written to, not followed.
_OPEN_FILES = re.compile(r"(?:/proc/(\d+)(?:/task/\d+)?|/dev)/fd")
_MOST_LINKS = 40  # as in Linux


class Kind(enum.Enum):
    """What is at a place, as far as writing is concerned."""

    NEW = enum.auto()
    FILE = enum.auto()
    NODE = enum.auto()  # a device, a pipe, a file that another process holds open
    DESCRIPTOR = enum.auto()  # a file that we hold open, such as stdout


@dataclass(frozen=True)
class Destination:
    """The place that a path leads to.

    Attributes:
        place: with all links followed.
        kind: what is there.
        status: of what is there; None if it is new.
    """

    place: Path
    kind: Kind
    status: os.stat_result | None

    @property
    def descriptor(self) -> int:
        """The number of our open file; only of kind DESCRIPTOR."""
        return int(self.place.name)

    @property
    def identity(self) -> object:
        """Equal for two paths that lead to one file, by any link; None for a device."""
        if self.status is None:
            return self.place
        if self.kind is Kind.NODE and not stat.S_ISFIFO(self.status.st_mode):
            return None
        return self.status.st_dev, self.status.st_ino


def destination(path: Path) -> Destination:
    """Where a write to `path` lands.

    Raises:
        ModelerError: a folder or a socket is there.
        OSError: the links lead in a circle, or may not be followed.
    """
    if "\0" in str(path):
        raise ModelerError(f"{path}: has a NUL in its name; expected the name of a file")
    place = _followed(Path(path))
    owner = _OPEN_FILES.fullmatch(str(place.parent))
    if owner is not None and place.name.isdigit() and owner[1] in (None, str(os.getpid())):
        return _told(path, Destination(place, Kind.DESCRIPTOR, os.fstat(int(place.name))))
    try:
        status = place.stat()
    except FileNotFoundError:
        return Destination(place, Kind.NEW, None)
    except NotADirectoryError:
        return Destination(place, Kind.NEW, None)
    replaceable = stat.S_ISREG(status.st_mode) and owner is None
    return _told(path, Destination(place, Kind.FILE if replaceable else Kind.NODE, status))


def _followed(path: Path) -> Path:
    for _ in range(_MOST_LINKS):
        place = Path(os.path.realpath(path.parent), path.name)
        if _OPEN_FILES.fullmatch(str(place.parent)) or not place.is_symlink():
            return place
        path = place.parent / place.readlink()
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))


def _told(path: Path, found: Destination) -> Destination:
    assert found.status is not None
    mode = found.status.st_mode
    if stat.S_ISDIR(mode):
        raise ModelerError(f"{path}: is a folder; expected the name of a file to write")
    if stat.S_ISSOCK(mode) and found.kind is not Kind.DESCRIPTOR:
        raise ModelerError(f"{path}: is a socket; expected the name of a file to write")
    return found
