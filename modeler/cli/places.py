"""What an argument means: a word, a file that is read, a file or folder that is written.

Parsers declare it as the `type` of the argument. So one rule holds for every command: before any
work, nothing that is read is written over, nothing is written twice, and all can be written.
"""

import argparse
import fnmatch
import io
import os
import stat
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from modeler.core import files
from modeler.core.choices import (
    LOG_ENDINGS,
    MOTIONS,
    OTHER_PROGRAMS,
    list_builtin_robots,
    locate_builtin_robot,
)
from modeler.core.errors import DataError, ModelerError, split_time_range

_MOTIONS = (".csv", ".parquet")


class Word(str):
    """A text that names no file."""


class FilePlace(str):
    """The place of a file on the command line.

    Attributes:
        endings: of the names of such files.
    """

    endings: tuple[str, ...] = ("",)

    @property
    def file(self) -> Path:
        """Returns the path of the file."""
        return Path(self)

    @staticmethod
    def names() -> tuple[str, ...]:
        """Returns words that stand for such a file."""
        return ()


class Input(FilePlace):
    """A file that is read."""

    what = "the file that is read"


class MapWord(Input):
    """A line of a mapping, or a file of such lines."""

    what = "the mapping that is read"


class ModelFile(Input):
    """A model file."""

    what = "the model that is read"
    endings = (".json",)


class RobotFile(Input):
    """A robot file, or the name of a built-in robot."""

    what = "the robot file that is read"
    endings: tuple[str, ...] = (".toml", *OTHER_PROGRAMS)
    names = staticmethod(list_builtin_robots)

    @property
    def file(self) -> Path:
        """Returns the path; the name of a built-in robot means its file."""
        return locate_builtin_robot(self) if self in list_builtin_robots() else Path(self)


class RobotOrModel(RobotFile):
    """A robot file, the name of a built-in robot, or a model file."""

    endings = (*RobotFile.endings, *ModelFile.endings)

    def __new__(cls, text: str) -> Any:
        """A model, by its ending; else a robot."""
        return ModelFile(text) if text.endswith(ModelFile.endings) else super().__new__(cls, text)


class LogFile(Input):
    """A log, as FILE or FILE@START:END."""

    what = "a log"
    endings = LOG_ENDINGS

    @property
    def file(self) -> Path:
        """Returns the path without the time range."""
        return Path(split_time_range(self)[0])


class ListFile(Input):
    """A list of logs with their machines and periods."""

    what = "the list that is read"


def parse_model_or_log(text: str) -> Input:
    """Classifies a word as a robot, a model or a log, by ending or content."""
    path = Path(text)
    if path.suffix.lower() in LOG_ENDINGS:
        return LogFile(text)
    if path.suffix.lower() in RobotOrModel.endings:
        return RobotOrModel(text)
    try:
        with path.open("rb") if path.is_file() else io.BytesIO() as file:  # a pipe may never end
            begins = file.read(64).lstrip()[:1] == b"{"
    except OSError:
        return LogFile(text)  # which says what is wrong with it
    return ModelFile(text) if begins else LogFile(text)


class MotionFile(Input):
    """A table of a motion: a whole log, or what `modeler excite` writes."""

    what = LogFile.what
    endings = LOG_ENDINGS


class MotionOrKind(MotionFile):
    """A table of a motion, or the name of a kind of motion."""

    @staticmethod
    def names() -> tuple[str, ...]:
        """Returns the kinds of motion."""
        return MOTIONS

    def __new__(cls, text: str) -> "MotionOrKind":
        """Refuses what is neither, as a wrong usage."""
        if text not in MOTIONS and not text.endswith(_MOTIONS):
            raise argparse.ArgumentTypeError(
                f"got {text}; expected {', '.join(MOTIONS)}, or a .csv or .parquet file"
            )
        return super().__new__(cls, text)


class Output(FilePlace):
    """A file that is written; it is no log."""


class NewRobot(Output):
    """A robot file that is written: what its command is about."""


class OtherProgramsFile(Output):
    """A robot file of another program that is written."""

    endings = (".urdf", ".xml", ".sdf", ".casadi", ".fmu")

    @property
    def file(self) -> Path:
        """Returns the path; of an existing folder the file package.xml in it."""
        return Path(self, "package.xml") if Path(self).is_dir() else Path(self)


class OriginalFile(Input):
    """A robot file of another program that is written anew with other numbers."""

    what = "the original that is read"
    endings = (".urdf", ".xml", ".mjcf", ".sdf")


class NewLog(Output):
    """A log that is written."""


class PageOrFolder(Output):
    """A page that is written, or a folder that it is written into."""

    @property
    def file(self) -> Path:
        """Returns the path of the page."""
        return files.resolve_page_path(Path(self), "compare.html")


class JsonFile(Output):
    """The result for machines; "-" is stdout."""


class OutputFolder(str):
    """A folder that files are written into.

    Attributes:
        writes: patterns of the files in it that are written.
    """

    writes: tuple[str, ...] = ()


class ModuleFolder(OutputFolder):
    """The folder of an emitted module."""

    writes = (
        *("*.c", "*.h", "*.hpp", "*.cu", "*.st", "*.a2l", "*.md", "*.sha256", "*.pc.in", "*.cmake"),
        *("manifest.json", "Makefile", "CMakeLists.txt"),
    )


class PictureData(Output):
    """A file of pictures as plain data."""


class Pictures(OutputFolder):
    """A folder for a page's pictures; a name that ends in .json is one file with their numbers."""

    writes: tuple[str, ...] = ("*.png", "*.svg", "*.csv")

    def __new__(cls, text: str) -> Any:
        """The folder, or the file."""
        return PictureData(text) if text.lower().endswith(".json") else super().__new__(cls, text)


_OF_JOINTS = ("time", "residual", "free_run", "models")


class PictureFolder(Pictures):
    """The folder of the pictures of a comparison."""

    writes = ("overview.*", *(f"joint_*_{kind}.*" for kind in _OF_JOINTS))


class LogPictures(Pictures):
    """The folder of the pictures of a log."""

    writes = ("clock.*", "channels_*.*")


class DemoFolder(OutputFolder):
    """The folder of `modeler demo`: it holds a folder for each story."""

    writes = ("demo-arm/*", "orthoglide-2003/*")


def check_places(args: argparse.Namespace) -> None:
    """Refuses outputs that would replace an input or each other, before any work.

    Links are followed; a window of a log is that log.

    Raises:
        ModelerError: an output is an input, is named like a log or like another program's robot
            file, is named twice, or cannot be written; or it lies where a folder of this command
            has a file of its own.
    """
    typed_places = list(_yield_typed_arguments(args))
    for _, place in typed_places:
        if isinstance(place, Input) and not place:
            raise DataError(f'got "" for {place.what}; expected the name of a file')
    inputs = ((p.what, _find_input(p.file)) for _, p in typed_places if isinstance(p, Input))
    read = [(what, target) for what, target in inputs if target is not None]
    folders = [(option, place) for option, place in typed_places if isinstance(place, OutputFolder)]
    for option, folder in folders:
        files.check_folder_writable(Path(folder))
        for what, target in read:
            _check_inside(option, folder, target, what)
    outputs: list[tuple[str, files.Destination]] = []
    for option, place in typed_places:
        if isinstance(place, Output) and not (place == "-" and isinstance(place, JsonFile)):
            target = _check_output(option, place, read, outputs)
            for other, folder in folders:
                _check_inside(other, folder, target, f"what {option} writes")
            outputs.append((option, target))


def _yield_typed_arguments(args: argparse.Namespace) -> Iterator[tuple[str, object]]:
    """Every argument, with its name as it is typed."""
    for name, value in vars(args).items():
        for each in value if isinstance(value, list) else [value]:
            yield "new" if isinstance(each, NewRobot) else "--" + name.replace("_", "-"), each


def _find_input(path: Path) -> files.Destination | None:
    """An input; None if it is not there, or no file: nothing of it can be lost."""
    try:
        target = files.resolve_destination(path)
    except (OSError, ModelerError):
        return None
    return target if target.kind is files.DestinationKind.FILE else None


def _check_output(
    option: str,
    place: Output,
    read: list[tuple[str, files.Destination]],
    outputs: list[tuple[str, files.Destination]],
) -> files.Destination:
    """Where an output goes, if it may go there."""
    argument_text = f"{option} {place}"
    if place == "-":
        raise DataError(
            f"{argument_text}: only --json takes - for stdout; expected the name of a file"
        )
    for path in {Path(place), place.file}:
        existing = _find_input(path)
        what = next(
            (what for what, other in read if existing and _is_same_file(existing, other)), None
        )
        if what is None and path.suffix.lower() in LOG_ENDINGS and not isinstance(place, NewLog):
            what = LogFile.what
        if what is not None:
            raise DataError(f"{argument_text}: this is {what}; expected a name of its own")
        ending = path.suffix.lower()
        if ending in OTHER_PROGRAMS and not isinstance(place, OtherProgramsFile):
            raise DataError(
                f"{argument_text}: got {ending}, which is another program's robot file; expected "
                "another "
                "ending, .toml for a robot file"
            )
    files.check_writable(place.file)
    target = files.resolve_destination(place.file)
    if target.kind is files.DestinationKind.FILE:
        outputs = _find_stdout_file() + outputs
    for other_option, other in outputs:
        if _is_same_file(target, other):
            raise DataError(
                f"{argument_text}: {other_option} writes this file too; expected a name of its own"
            )
    return target


def _is_same_file(one: files.Destination, other: files.Destination) -> bool:
    return one.identity is not None and one.identity == other.identity


def _find_stdout_file() -> list[tuple[str, files.Destination]]:
    """The file that stdout goes to, if it is one."""
    try:
        status = os.fstat(sys.stdout.fileno())
    except (AttributeError, io.UnsupportedOperation, OSError):
        return []
    if not stat.S_ISREG(status.st_mode):
        return []
    return [("stdout", files.Destination(Path("stdout"), files.DestinationKind.FILE, status))]


def _check_inside(option: str, folder: OutputFolder, target: files.Destination, what: str) -> None:
    """Refuse a file that stands where the folder gets one of its own."""
    top = Path(os.path.realpath(folder))
    if target.path.is_relative_to(top):
        name = target.path.relative_to(top).as_posix()
        if any(fnmatch.fnmatchcase(name, pattern) for pattern in folder.writes):
            raise DataError(
                f"{option} {folder}: {name} in it is {what}; expected a folder of its own"
            )
