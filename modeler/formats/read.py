"""The robot of any file: robot files (TOML), URDF, MJCF, SYMORO files, by what stands in them."""

import dataclasses
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from modeler.core.choices import OTHER_PROGRAMS, list_builtin_robots
from modeler.core.errors import RobotError
from modeler.core.files import read_file, write_without_overwriting
from modeler.robot import Robot, parse_robot_text, read_file_text, read_robot as read_toml_robot

if TYPE_CHECKING:
    from modeler.robot import ConvertedRobot

# Atomic: comments are not tried in all ways of taking them together.
_FIRST = re.compile(
    rb"(?:\xef\xbb\xbf)?(?>\s+|<\?.*?\?>|<!--.*?-->)*+<(robot|mujoco|sdf)", re.DOTALL
)


def read_robot(robot: str | Path) -> Robot:
    """Reads the robot of a file of any format, or the built-in one of that name.

    A text that is the name of a built-in robot means that one; write `./wrist` for a file `wrist`.

    Raises:
        RobotError: no such file or name, or a mistake in the file.
    """
    path = Path(robot)
    if robot not in list_builtin_robots() and str(robot).strip():
        other = path.suffix.lower() in OTHER_PROGRAMS
        if other or is_robot_xml(read_file_text(path).encode()):  # under another name
            return build_converted_robot(convert_robot_file(path), path)
    return read_toml_robot(robot)


def convert_robot_file(
    path: str | Path, exact_decimals: bool = False, **part: Any
) -> "ConvertedRobot":
    """Returns another program's robot file as the text of ours.

    What begins with `<robot>` is a URDF, with `<mujoco>` an MJCF, whatever the file is called.

    Args:
        path: the file.
        exact_decimals: take printed angles and lengths as they are: 1.5708 is no pi/2.
        part: base, tip, locks of `tree_cuts.cut_tree`.

    Raises:
        RobotError: no such file, a format that is not read, or a mistake in it.
    """
    path = Path(path)
    try:
        data = read_file(path)
    except OSError as error:
        raise RobotError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    if path.suffix.lower() == ".toml" and not is_robot_xml(data):
        expected = "expected one of another program, such as x.urdf, x.xml or x.par"
        raise RobotError(f"{path}: is a robot file already; {expected}")
    if path.suffix.lower() in OTHER_PROGRAMS[1:] or is_robot_xml(data):
        return _convert_xml(path, data, exact_decimals, part)
    if exact_decimals or any(part.values()):
        options = "--base, --tip, --lock and --exact-decimals"
        raise RobotError(f"{path}: {options} are for URDF and MJCF; leave them out")
    from modeler.formats.par_convert import convert_par_file

    return convert_par_file(data, str(path))


def is_robot_xml(data: bytes) -> bool:
    """Returns True if the first element is that of a robot of another program."""
    return _FIRST.match(data) is not None


def _convert_xml(
    path: Path, data: bytes, exact_decimals: bool, part: Mapping[str, Any]
) -> "ConvertedRobot":
    from modeler.formats.tree_cuts import cut_tree
    from modeler.formats.tree_text import convert_tree
    from modeler.formats.urdf import read_urdf_tree

    first = root_match[1] if (root_match := _FIRST.match(data)) else b""
    if first == b"sdf":
        todo = "give the URDF that it was made from, or an MJCF"
        raise RobotError(f"{path}: is SDF, which is not read; {todo}")
    if first == b"mujoco":  # or what one includes, as is reported there
        from modeler.formats.mjcf import read_mjcf_tree

        tree = read_mjcf_tree(path, exact_decimals)
    else:
        tree = read_urdf_tree(data, str(path), exact_decimals)
    return convert_tree(cut_tree(tree, **part), str(path))


def build_converted_robot(converted: "ConvertedRobot", path: str | Path) -> Robot:
    """Returns the robot of another program's file; its readings say what was decided."""
    read = parse_robot_text(converted.text, f"{path}, as a robot file")
    return dataclasses.replace(read, readings=(*converted.notes, *read.readings))


def convert(
    file: str | Path,
    out: str | Path | None = None,
    base: str = "",
    tip: str = "",
    lock: Mapping[str, str | float] | None = None,
    exact_decimals: bool = False,
    force: bool = False,
) -> Robot:
    """Returns robot of a URDF, MJCF or SYMORO file; written as a robot file if `out` says where.

    >>> exported = export(model, "arm.urdf", force=True)
    >>> convert("arm.urdf", "arm-again.toml", force=True).moving_joints[1].name
    '2'

    Args:
        file: of the other program.
        out: robot file to write.
        base: link that stands still; by default the first.
        tip: last link of the chain that is meant; by default all branches are.
        lock: joint -> position at which it is held: rad, m, or text such as "30 deg".
        exact_decimals: take printed angles and lengths as they are: 1.5708 is no pi/2.
        force: write over a file that is there and holds something else.

    Returns:
        The robot; its `readings` say what was decided and what was left out.

    Raises:
        RobotError: no such file, a format that is not read, or a mistake in it.
        DataError: a file that is there.
    """
    converted = convert_robot_file(file, exact_decimals, base=base, tip=tip, locks=lock)
    robot = build_converted_robot(converted, file)
    if out is not None:
        write_without_overwriting(Path(out), converted.text, force)
    return robot
