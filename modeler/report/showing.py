"""A robot as it looks in the posture that every other command starts from."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path

from modeler.core.brief import Brief
from modeler.core.errors import DataError, DerivationError, LoopError
from modeler.core.files import write_atomically
from modeler.report.robot_closing import Posture, home_posture
from modeler.report.robot_page import robot_html
from modeler.report.robot_skeleton import PICTURE_KINDS, Skeleton, skeleton_of
from modeler.robot.robot import Robot


@dataclass(frozen=True)
class ShownRobot(Brief):
    """A robot as it is drawn: its table in numbers, and where its joints stand."""

    skeleton: Skeleton
    posture: Posture


def show(
    robot: Robot, page: str | Path | None = None, picture: str | Path | None = None
) -> ShownRobot:
    """Draw a robot at its [home], found where that is missing or poor.

    What cannot be derived (loops that do not close, or are singular at [home]) is drawn as it is
    stated; `posture.note` says so.

    Args:
        robot: as read.
        page: HTML file to write, with sliders; it needs no other file.
        picture: file to write, .png, .svg or .pdf, as wide as a column of a paper.

    Raises:
        DataError: the picture's name ends in something else.
        ModelerError: a file cannot be written.
    """
    kind = "" if picture is None else _kind(Path(picture))
    found = _shown(robot)
    contents: list[tuple[str | Path, str | bytes]] = []
    if page is not None:
        contents.append((page, robot_html(found.skeleton, found.posture)))
    if picture is not None:
        from modeler.report.robot_drawing import picture_bytes

        contents.append((picture, picture_bytes(found.skeleton, found.posture, kind)))
    for place, content in contents:
        write_atomically(Path(place), content)
    return found


def _kind(picture: Path) -> str:
    kind = picture.suffix.lower()
    if kind not in PICTURE_KINDS:
        raise DataError(
            f"{picture}: got {kind or 'no ending'}; expected a name that ends in "
            f"{', '.join(PICTURE_KINDS)}"
        )
    return kind


def _shown(robot: Robot) -> ShownRobot:
    note = ""
    if robot.loops:
        from modeler.derivation.derive import with_home  # only loops need symbols

        try:
            home = with_home(robot)
            robot, note = home.robot, home.told
        except (LoopError, DerivationError) as error:
            note = str(error)
    skeleton = skeleton_of(robot)
    return ShownRobot(skeleton, dataclasses.replace(home_posture(skeleton), note=note))
