"""Robot files of other programs: what a file is, by what stands in it, and who reads it."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from modeler.core.choices import OTHER_PROGRAMS
from modeler.core.errors import RobotError
from modeler.core.files import read_file
from modeler.robot.robot_text import ConvertedRobot

# Atomic: comments are not tried in all ways of taking them together.
_FIRST = re.compile(
    rb"(?:\xef\xbb\xbf)?(?>\s+|<\?.*?\?>|<!--.*?-->)*+<(robot|mujoco|sdf)", re.DOTALL
)


def convert_robot_file(
    path: str | Path, exact_decimals: bool = False, **part: Any
) -> ConvertedRobot:
    """Another program's robot file as the text of ours.

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
        raise RobotError(
            f"{path}: is a robot file already; expected one of another program, such as x.urdf, "
            "x.xml or x.par"
        )
    if path.suffix.lower() in OTHER_PROGRAMS[1:] or is_robot_xml(data):
        return _convert_xml(path, data, exact_decimals, part)
    if exact_decimals or any(part.values()):
        raise RobotError(
            f"{path}: --base, --tip, --lock and --exact-decimals are for URDF and MJCF; leave them "
            "out"
        )
    from modeler.robot.par_convert import convert_par_file

    return convert_par_file(data, str(path))


def is_robot_xml(data: bytes) -> bool:
    """True if the first element is that of a robot of another program."""
    return _FIRST.match(data) is not None


def _convert_xml(
    path: Path, data: bytes, exact_decimals: bool, part: Mapping[str, Any]
) -> ConvertedRobot:
    from modeler.robot.tree_cuts import cut_tree
    from modeler.robot.tree_text import convert_tree
    from modeler.robot.urdf import read_urdf_tree

    first = root_match[1] if (root_match := _FIRST.match(data)) else b""
    if first == b"sdf":
        raise RobotError(
            f"{path}: is SDF, which is not read; give the URDF that it was made from, or an MJCF"
        )
    if first == b"mujoco":  # or what one includes, as is told there
        from modeler.robot.mjcf import read_mjcf_tree

        tree = read_mjcf_tree(path, exact_decimals)
    else:
        tree = read_urdf_tree(data, str(path), exact_decimals)
    return convert_tree(cut_tree(tree, **part), str(path))
