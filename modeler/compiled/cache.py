"""The folder of compiled libraries: which entry is whole, and which have to go.

One folder for each library, named by a hash of all that can change it. At most `MOST` entries and
`LARGEST` bytes are kept, those that were used last; what was used within the last hour stays
whatever there is, so that no process loses a library between finding and loading it. A library that
a process has loaded may go: the system keeps its content until the process ends. Any number of
processes may use, build and remove entries at once, and none may trip over another.
"""

import contextlib
import hashlib
import os
import re
import secrets
import shutil
import time
from collections.abc import Iterator
from pathlib import Path

MOST = 500
LARGEST = 256 * 2**20
RECENT = 3600.0
"""Seconds since it was used, within which an entry stays."""

_AGAIN = 100
_ENTRY = re.compile(r"[0-9a-f]{64}")
_SCRATCH = (".build-", ".gone-")


def cache_folder() -> Path:
    """$MODELER_CACHE, else $XDG_CACHE_HOME/modeler, else ~/.cache/modeler."""
    own = os.environ.get("MODELER_CACHE", "")
    if own:
        return Path(own)
    shared = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(shared) if shared else Path.home() / ".cache") / "modeler"


def libraries(folder: Path) -> list[Path]:
    """The libraries of an entry; none where another process has removed it."""
    try:
        return sorted(path for path in folder.iterdir() if path.suffix == ".so")
    except FileNotFoundError:
        return []


def whole(library: Path) -> bool:
    """True for a library that is what was built: its name is the hash of its content.

    False too where another process has removed it.
    """
    try:
        return hashlib.sha256(library.read_bytes()).hexdigest() == library.stem
    except FileNotFoundError:
        return False


def placed(made: Path, final: Path) -> None:
    """Moves a library into its folder, which another process may just be removing."""
    for _ in range(_AGAIN):
        final.parent.mkdir(exist_ok=True)
        with contextlib.suppress(FileNotFoundError):
            made.replace(final)
            return
    made.replace(final)


def in_use(library: Path) -> None:
    """Notes that a library is used now."""
    with contextlib.suppress(OSError):  # a cache that may only be read
        os.utime(library)


def tidy(cache: Path) -> None:
    """Remove the entries that were not used for longest, beyond `MOST` and `LARGEST`.

    What cannot be removed stays: nobody waits for it.
    """
    now, count, size = time.time(), 0, 0
    for used, bytes_there, folder in sorted(_entries(cache), reverse=True):
        count, size = count + 1, size + bytes_there
        beyond = count > MOST or size > LARGEST or folder.name.startswith(_SCRATCH)
        if beyond and now - used > RECENT:
            _remove(folder)


def _entries(cache: Path) -> Iterator[tuple[float, int, Path]]:
    """When it was used, its size and its folder, of all that is ours; others may remove it."""
    try:
        folders = [*cache.iterdir()]
    except OSError:
        return
    for folder in folders:
        if _ENTRY.fullmatch(folder.name) or folder.name.startswith(_SCRATCH):
            with contextlib.suppress(OSError):
                found = [path.stat() for path in (folder, *folder.iterdir())]
                yield max(s.st_mtime for s in found), sum(s.st_size for s in found[1:]), folder


def _remove(folder: Path) -> None:
    """In one step for all others, who find it whole or not at all."""
    gone = folder.with_name(f".gone-{secrets.token_hex(8)}")
    with contextlib.suppress(OSError):
        folder.rename(gone)
        shutil.rmtree(gone, ignore_errors=True)
