"""Files on the server's side: what may be chosen where it lies, what a project uses, its lock."""

import contextlib
import errno
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from glob import escape
from pathlib import Path

from modeler.api.front_end import LOG_ENDINGS, OTHER_PROGRAMS, DataError, ModelerError
from modeler.studio.project import FOLDERS, Project
from modeler.studio.tasks import MAKING

ROBOT_ENDINGS = (".toml", *OTHER_PROGRAMS)
"""How the name of a robot file ends."""

BEGUN = ".dropping-"
"""How the name of a file begins that is not yet there as a whole."""

_LOCK = ".studio.lock"
_LEFT = re.compile(rf"{re.escape(BEGUN)}[0-9a-f]+|\.modeler-[0-9a-f]{{16}}")  # of who was killed
_OF_STEP = re.compile(r"(\d+)\.(?:json|toml|pictures\.json)")


def format_size(count: float) -> str:
    """Formats a number of bytes."""
    for unit in ("B", "kB", "MB", "GB"):
        if count < 1000:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.4g} TB"


# One server writes a project; another one that opens its folder only reads.


@contextlib.contextmanager
def lock_folder(folder: Path) -> Iterator[bool]:
    """Locks a folder; yields False if another studio has it or it is write-protected.

    The system gives the lock back when a process ends, however it ends. What a killed one left
    half-written is swept away.

    Raises:
        ModelerError: the folder is none, or cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = (folder / _LOCK).open("a+b")
    except OSError as error:
        if folder.is_dir() and error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
            yield False
            return
        raise ModelerError(
            f"{folder}: cannot be used as a project folder ({error.strerror}); name another one"
        ) from error
    with file:
        is_locked = _try_lock(file.fileno())
        if is_locked:
            _remove_leftovers(folder)
        yield is_locked


def _try_lock(descriptor: int) -> bool:
    try:
        if os.name == "nt":
            import msvcrt

            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
        else:
            import fcntl

            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _remove_leftovers(folder: Path) -> None:
    for place in (folder, *(folder / name for name in FOLDERS)):
        with contextlib.suppress(OSError):
            for leftover in place.iterdir():
                if _LEFT.fullmatch(leftover.name):
                    leftover.unlink()


# The picker: folders and files under a few roots.


@dataclass(frozen=True)
class Entry:
    """A folder or a file that may be chosen.

    Attributes:
        name: as it is listed.
        place: of it, its links followed.
        size: bytes of a file; None: a folder.
    """

    name: str
    place: Path
    size: int | None

    @property
    def is_folder(self) -> bool:
        """Returns True for a folder."""
        return self.size is None


@dataclass(frozen=True)
class Roots:
    """Folders below which the user may choose.

    Attributes:
        folders: of the project, and those of `--allow`.
    """

    folders: tuple[Path, ...]

    def resolve_inside(self, place: Path | str) -> Path:
        """Resolves a place and checks that it is in one of the folders.

        Raises:
            DataError: it is not, or is not there.
        """
        try:
            target = Path(place).resolve(strict=True)
        except (OSError, ValueError, RuntimeError):  # ValueError: a NUL; RuntimeError: a ring
            raise DataError(f"{place}: no such file; choose another one") from None
        self.check_inside(str(place), target)
        return target

    def check_inside(self, place: str, target: Path) -> None:
        """Refuses a place that is in none of the folders.

        Args:
            place: as it is called.
            target: the same; its links are followed.

        Raises:
            DataError: it is not; says how to allow it.
        """
        try:
            target = target.resolve()
        except (OSError, RuntimeError):  # RuntimeError: a ring of links
            raise DataError(f"{place}: its links lead nowhere; remove them") from None
        if not any(target.is_relative_to(folder.resolve()) for folder in self.folders):
            raise DataError(
                f"{place}: lies outside the folders that this studio may use; start it with "
                f"--allow {target if target.is_dir() else target.parent}"
            )

    def check_tree(self, place: str, target: Path) -> None:
        """Checks a place and all links below it, or with the same beginning of the name.

        A log may be a folder, or several files of which it is the beginning of the names.
        """
        self.check_inside(place, target)
        others = (
            target.rglob("*") if target.is_dir() else target.parent.glob(f"{escape(target.name)}*")
        )
        for below in others:
            if below.is_symlink():
                self.check_inside(str(below), below)

    def check_words(self, folder: Path, words: Iterable[str]) -> None:
        """Refuses a command that would read or write elsewhere.

        Words that are no files stand for names in the folder here, which are inside.

        Raises:
            DataError: a word leads out of the folders; says which.
        """
        for word in words:
            for file in {word, word.rpartition("@")[0]} - {""}:
                self.check_tree(word, folder / file)

    def check_links(self, folder: Path, names: Iterable[str]) -> None:
        """Refuses a project whose own places are links that lead out.

        Args:
            folder: of the project.
            names: of files, and of folders with all that is in them; logs are only read.

        Raises:
            DataError: one is; says which.
        """
        for name in names:
            if name != "logs" or (folder / name).is_symlink():
                self.check_tree(str(folder / name), folder / name)

    def read_entries(self, folder: Path | str, endings: Sequence[str] = LOG_ENDINGS) -> list[Entry]:
        """Returns the folders, then the files with these endings, of a folder.

        Raises:
            DataError: the folder is none, is outside, or may not be read.
        """
        top = self.resolve_inside(folder)
        try:
            names = sorted((p.name for p in top.iterdir()), key=lambda name: (name.lower(), name))
        except OSError as error:
            raise DataError(f"{top}: cannot be listed ({error.strerror}); choose another") from None
        entries = [
            self._read_entry(top, name, endings) for name in names if not name.startswith(".")
        ]
        return sorted(filter(None, entries), key=lambda entry: not entry.is_folder)

    def _read_entry(self, top: Path, name: str, endings: Sequence[str]) -> Entry | None:
        try:
            place = self.resolve_inside(top / name)
            if place.is_dir():
                return Entry(name, place, None)
            if place.is_file() and place.suffix.lower() in endings:
                return Entry(name, place, place.stat().st_size)
        except (DataError, OSError):
            pass
        return None


READABLE = Roots(())
"""Where the process of the viewer may read; without folders everywhere."""


# Disk: what a project uses, and what of it nobody needs.


def compute_disk_use(folder: Path) -> dict[str, int]:
    """Computes the bytes of a project by folder; the rest is "other"."""
    used = dict.fromkeys((*FOLDERS, "other"), 0)
    for top, folders, names in os.walk(folder):
        kind = Path(top).relative_to(folder).parts[:1] or ("other",)
        for name in names:
            with contextlib.suppress(OSError):
                used[kind[0] if kind[0] in used else "other"] += os.lstat(f"{top}/{name}").st_size
        folders[:] = [name for name in folders if not Path(top, name).is_symlink()]
    return used


@dataclass(frozen=True)
class UnusedFiles:
    """What no step on the way to the current one needs.

    Attributes:
        project: without the steps that were set aside.
        files: theirs, and those of steps that never ended; relative to the folder.
        size: bytes of them.
    """

    project: Project
    files: tuple[str, ...]
    size: int

    def remove(self, folder: Path) -> None:
        """Removes the files, after the project was saved."""
        for file in self.files:
            with contextlib.suppress(OSError):
                (folder / file).unlink()


def find_unused_files(folder: Path, project: Project) -> UnusedFiles:
    """Finds the steps and files that the current model does not need."""
    path_numbers = {step.number for step in project.collect_path()}
    steps = tuple(
        step
        for step in project.steps
        if step.number in path_numbers
        or (step.verb not in MAKING and step.parent in {0, *path_numbers})
    )
    needed = {n for step in steps for n in (step.number, *step.task.models)}
    files = [
        f"{name}/{candidate.name}"
        for name in ("robots", "models", "results")
        for candidate in _iterate_files(folder / name)
        if (match := _OF_STEP.fullmatch(candidate.name)) and int(match[1]) not in needed
    ]
    size = sum((folder / file).lstat().st_size for file in files)
    return UnusedFiles(replace(project, steps=steps), tuple(files), size)


def _iterate_files(folder: Path) -> Iterable[Path]:
    return sorted(folder.iterdir()) if folder.is_dir() else ()
