"""Files: none is read without end, none half-written, and nothing but a file replaced; outputs."""

import contextlib
import enum
import errno
import os
import re
import signal
import stat
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Literal

from modeler.core.errors import DataError, ModelerError
from modeler.core.thresholds import THRESHOLDS

# Where a write to a path lands: its links followed, and what is there now.


# Files that a process has open, by number. These look like links, and lead to a place that may be
# a pipe without a name, or a file at whose end we stand already: they are written to, not followed.
_OPEN_FILES = re.compile(r"(?:/proc/(\d+)(?:/task/\d+)?|/dev)/fd")


class DestinationKind(enum.Enum):
    """What is at a place, as far as writing is concerned."""

    NEW = enum.auto()
    FILE = enum.auto()
    NODE = enum.auto()  # a device, a pipe, a file that another process holds open
    DESCRIPTOR = enum.auto()  # a file that we hold open, such as stdout


@dataclass(frozen=True)
class Destination:
    """The place that a path leads to.

    Attributes:
        path: with all links followed.
        kind: what is there.
        status: of what is there; None if it is new.
    """

    path: Path
    kind: DestinationKind
    status: os.stat_result | None

    @property
    def descriptor(self) -> int:
        """Returns the number of our open file; only of kind DESCRIPTOR."""
        return int(self.path.name)

    @property
    def identity(self) -> object:
        """Returns a value that is equal for two paths to one file, by any link.

        None for a device.
        """
        if self.status is None:
            return self.path
        if self.kind is DestinationKind.NODE and not stat.S_ISFIFO(self.status.st_mode):
            return None
        return self.status.st_dev, self.status.st_ino


def resolve_destination(path: Path) -> Destination:
    """Resolves where a write to `path` lands.

    Raises:
        ModelerError: a folder or a socket is there.
        OSError: the links lead in a circle, or may not be followed.
    """
    if "\0" in str(path):
        raise ModelerError(f"{path}: has a NUL in its name; expected the name of a file")
    place = _follow_links(Path(path))
    owner = _OPEN_FILES.fullmatch(str(place.parent))
    if owner is not None and place.name.isdigit() and owner[1] in (None, str(os.getpid())):
        return _check_replaceable(
            path, Destination(place, DestinationKind.DESCRIPTOR, os.fstat(int(place.name)))
        )
    try:
        status = place.stat()
    except (FileNotFoundError, NotADirectoryError):
        return Destination(place, DestinationKind.NEW, None)
    replaceable = stat.S_ISREG(status.st_mode) and owner is None
    return _check_replaceable(
        path,
        Destination(place, DestinationKind.FILE if replaceable else DestinationKind.NODE, status),
    )


def _follow_links(path: Path) -> Path:
    for _ in range(THRESHOLDS.max_links):
        place = Path(os.path.realpath(path.parent), path.name)
        if _OPEN_FILES.fullmatch(str(place.parent)) or not place.is_symlink():
            return place
        path = place.parent / place.readlink()
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))


def _check_replaceable(path: Path, destination: Destination) -> Destination:
    assert destination.status is not None
    mode = destination.status.st_mode
    if stat.S_ISDIR(mode):
        raise ModelerError(f"{path}: is a folder; expected the name of a file to write")
    if stat.S_ISSOCK(mode) and destination.kind is not DestinationKind.DESCRIPTOR:
        raise ModelerError(f"{path}: is a socket; expected the name of a file to write")
    return destination


_CREATE = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)


LARGEST = 64 * 2**20
"""Bytes of a text that is read whole: a robot, a model, a map, a list."""

PACKED = 100
"""Times that a log may be larger unpacked than its file: measured numbers pack 20 times at best."""

UNPACKED = 256 * 2**20
"""Bytes that any log may unpack to, however small its file."""


def read_file(path: Path, most: int = LARGEST) -> bytes:
    """Reads a regular file of at most so many bytes.

    Raises:
        OSError: it cannot be read, is a pipe or device, which may never end, or is larger.
    """
    mode = path.stat().st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise OSError(errno.EINVAL, "a pipe or a device, no file", str(path))
    with path.open("rb") as file:
        content = file.read(most + 1)
    if len(content) > most:
        raise OSError(errno.EFBIG, f"larger than {most >> 20} MiB", str(path))
    return content


def read_text(path: Path) -> str:
    r"""Reads a text in UTF-8, a byte order mark taken off; line ends are `\n`.

    Raises:
        OSError: as `read_file`.
        UnicodeDecodeError: it is no UTF-8.
    """
    return read_file(path).decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")


def compute_checksum(path: Path) -> str:
    """Returns SHA-256 of the bytes of a file, or of the names and bytes of the files in a folder.

    Raises:
        OSError: it cannot be read.
    """
    if not path.is_dir():
        status = path.stat()
        return _hash_file(path.absolute(), status.st_size, status.st_mtime_ns)
    import hashlib  # `modeler --help` has no use for it

    inside = sorted(one for one in path.rglob("*") if one.is_file())
    names = (one.relative_to(path).as_posix() for one in inside)
    lines = (f"{name}\0{compute_checksum(one)}\n" for name, one in zip(names, inside, strict=True))
    return hashlib.sha256("".join(lines).encode(errors="surrogateescape")).hexdigest()


@lru_cache(maxsize=256)
def _hash_file(path: Path, size: int, written: int) -> str:
    """Of a file; taken once for a state of it."""
    import hashlib

    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def check_unpacked_size(path: Path, size: int) -> None:
    """Refuses a log that would fill the memory, before it is unpacked to so many bytes.

    Raises:
        DataError: more than `PACKED` times its file, and more than `UNPACKED`.
    """
    inside = path.rglob("*") if path.is_dir() else (path,)
    packed = sum(one.stat().st_size for one in inside)
    if size > max(UNPACKED, PACKED * packed):
        raise DataError(
            f"{path}: unpacks to {size / 2**20:,.0f} MiB or more from {packed / 2**20:.3g} MiB; "
            f"expected at most {PACKED} times the file, or {UNPACKED >> 20} MiB; save only the "
            "samples of the motion"
        )


def write_atomically(path: Path, content: bytes | str) -> None:
    r"""Writes `content` to `path`; readers of a file see the old one or the new one.

    A regular file, or none, is written beside its place and renamed: through symbolic links, with
    the permissions of the old file, or those that the umask leaves to a new one. Devices, pipes
    and our own open files (/dev/stdout, /dev/fd/N) are written to as they are.

    Text is written as UTF-8 with `\n` line ends on every system; bytes of file names that are no
    UTF-8 as \udcXX.

    Raises:
        ModelerError: a folder or socket is there, the file is write-protected, or its folder is
            missing or not writable; says which.
        BrokenPipeError: the reader of a pipe has gone.
    """
    write_files([(path, content)])


def write_without_overwriting(path: Path, content: bytes | str, force: bool) -> None:
    """Writes a file, but over one with another content only with `force`.

    Raises:
        DataError: there is such a file.
        ModelerError, BrokenPipeError: as above.
    """
    write_all_without_overwriting([(path, content)], force)


def write_all_without_overwriting(files: list[tuple[Path, bytes | str]], force: bool) -> None:
    """Writes several files, all or none, as `write_unless_other` does.

    Raises:
        DataError, ModelerError, BrokenPipeError: as above.
    """
    for path, content in files:
        data = content.encode() if isinstance(content, str) else content
        there = resolve_destination(path).kind is DestinationKind.FILE
        if not force and there and path.read_bytes() != data:
            raise DataError(
                f"{path}: there is such a file with another content; choose another name, or write "
                "over it with --force (force=True)"
            )
    write_files(files)


def write_files(files: Iterable[tuple[Path, bytes | str]], removed: Iterable[Path] = ()) -> None:
    """Writes several files in their order: an interrupt leaves all as it was, or all new.

    All are written beside their places first; then nothing stops their renaming but the end of the
    process at once (SIGKILL, a power cut).

    Args:
        files: places and contents; of two contents for one place the last stays.
        removed: files that are removed together with that, where they can be.

    Raises:
        ModelerError, BrokenPipeError: as above; nothing has changed.
    """
    staged, created_folders = list[tuple[Path, Path]](), list[Path]()
    try:
        for path, content in files:
            with _wrap_errors(path):
                if isinstance(content, str):
                    content = content.encode(errors="backslashreplace")
                destination = resolve_destination(Path(path))
                if destination.kind in (DestinationKind.NEW, DestinationKind.FILE):
                    folders = (destination.path.parent, *destination.path.parent.parents)
                    created_folders += [folder for folder in folders if not folder.exists()]
                    staged.append((_choose_unused_name(destination.path.parent), destination.path))
                    _stage_file(destination, staged[-1][0], content)
                else:
                    _write_all(_open_destination(destination), content)
        with defer_signals():
            while staged:
                beside, place = staged.pop(0)
                with _wrap_errors(place):
                    beside.replace(place)
            for path in removed:
                with contextlib.suppress(OSError):  # what cannot be removed stays
                    path.unlink()
    except BaseException:
        with contextlib.suppress(OSError):
            for beside, _ in staged:
                beside.unlink(missing_ok=True)
            for folder in created_folders:
                folder.rmdir()
        raise


@contextlib.contextmanager
def defer_signals() -> Iterator[None]:
    """Delays signals that end a program until this is over."""
    names = ("SIGINT", "SIGTERM", "SIGHUP")
    here = threading.current_thread() is threading.main_thread()  # who alone hears of signals
    numbers = [getattr(signal, name) for name in names if here and hasattr(signal, name)]
    held = list[int]()
    before = {number: signal.getsignal(number) for number in numbers}
    for number in numbers:
        signal.signal(number, lambda number, _: held.append(number))
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler or signal.SIG_DFL)
        for number in held:
            signal.raise_signal(number)


def check_writable(path: Path) -> None:
    """Refuses a place that cannot be written, before the work that it is for.

    Nothing is left there.

    Raises:
        ModelerError: it is a folder or a socket, or write-protected, or its folder is missing and
            cannot be made, or is not writable; says which.
    """
    path = Path(path)
    with _wrap_errors(path):
        destination = resolve_destination(path)
        if destination.kind is DestinationKind.DESCRIPTOR:
            import fcntl  # where files have numbers in the file system, there is fcntl

            if fcntl.fcntl(destination.descriptor, fcntl.F_GETFL) & os.O_ACCMODE == os.O_RDONLY:
                raise OSError(errno.EBADF, "open for reading only")
            return
        _check_access(destination)
        if destination.kind is not DestinationKind.NODE:
            _check_folder(destination.path.parent)


def check_folder_writable(folder: Path) -> None:
    """Refuses a folder that cannot be made, or that new files cannot be put into; leaves nothing.

    Raises:
        ModelerError: says why.
    """
    folder = Path(folder)
    with _wrap_errors(folder):
        _check_folder(Path(os.path.realpath(folder)))


def resolve_page_path(path: Path, name: str) -> Path:
    """Returns where a page goes that is given as an `.html` file, as a pipe or device.

    Or as a folder.

    In a folder, which need not be there yet, it is called `name`.
    """
    path = Path(path)
    if path.suffix.lower() in (".html", ".htm"):
        return path
    try:
        destination = resolve_destination(path)
    except (ModelerError, OSError):
        return path / name
    return (
        path
        if destination.kind in (DestinationKind.NODE, DestinationKind.DESCRIPTOR)
        else path / name
    )


@contextlib.contextmanager
def _wrap_errors(path: Path) -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        what = error.strerror or str(error)
        raise ModelerError(
            f"{path}: cannot be written ({what}); choose a place you may write to"
        ) from error


def _stage_file(destination: Destination, beside: Path, data: bytes) -> None:
    """Write what will be renamed to its place."""
    beside.parent.mkdir(parents=True, exist_ok=True)
    _check_access(destination)
    # What replaces a private file is private from the start.
    _write_all(os.open(beside, _CREATE, 0o666 if destination.status is None else 0o600), data)
    if destination.status is not None:
        _copy_permissions(beside, destination.status)


def _choose_unused_name(folder: Path) -> Path:
    """A name that nobody has, short enough beside any other."""
    return folder / f".modeler-{os.urandom(8).hex()}"


def _copy_permissions(path: Path, status: os.stat_result) -> None:
    """Permissions of the old file; and its owner and group, where we may."""
    chown: Callable[[Path, int, int], None] | None = getattr(os, "chown", None)
    if chown is not None:
        for uid, gid in ((-1, status.st_gid), (status.st_uid, -1)):
            with contextlib.suppress(OSError):
                chown(path, uid, gid)
    path.chmod(stat.S_IMODE(status.st_mode) & 0o777)


def _open_destination(destination: Destination) -> int:
    if destination.kind is DestinationKind.NODE:
        return os.open(destination.path, os.O_WRONLY | os.O_APPEND | getattr(os, "O_NOCTTY", 0))
    for stream in (sys.stdout, sys.stderr):  # what was printed before comes before
        if stream is not None:
            stream.flush()
    return os.dup(destination.descriptor)


def _write_all(handle: int, data: bytes) -> None:
    """Write all and close."""
    try:
        left = memoryview(data)
        while left:
            left = left[os.write(handle, left) :]
    finally:
        os.close(handle)


def _check_access(destination: Destination) -> None:
    if destination.status is not None and not os.access(destination.path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


def _check_folder(folder: Path) -> None:
    """Try the folder, or the nearest one that there is, with a file that has no name."""
    there = next(place for place in (folder, *folder.parents) if place.exists())
    if not there.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR))
    nameless = getattr(os, "O_TMPFILE", None)
    if nameless is not None:
        try:
            os.close(os.open(there, nameless | os.O_WRONLY, 0o600))
            return
        except OSError as error:
            unknown = (errno.EOPNOTSUPP, errno.EISDIR, errno.ENOENT, errno.EINVAL)
            if error.errno not in unknown:
                raise
    beside = _choose_unused_name(there)
    try:
        os.close(os.open(beside, _CREATE, 0o600))
    finally:
        beside.unlink(missing_ok=True)


# The one place that knows where the templates and the C runtime live.


_PACKAGE = Path(__file__).resolve().parents[1]


def locate_resources(kind: Literal["templates", "csrc"]) -> Path:
    """Returns folder of shipped data.

    Inside the wheel (`_templates`), or at the top of a checkout.
    """
    for place in (_PACKAGE / f"_{kind}", _PACKAGE.parent / kind):
        if place.is_dir():
            return place
    raise FileNotFoundError(f"{kind}/ is neither inside the package ({_PACKAGE}) nor beside it")
