"""Robot files of other programs: which are read, as what, and which are refused by name."""

from pathlib import Path

from modeler.core.builtin import NOT_READ
from modeler.core.errors import RobotError
from modeler.core.files import read_file
from modeler.robot.par_convert import par_to_toml
from modeler.robot.robot_text import Converted


def converted(path: Path) -> Converted:
    """Another program's robot file as the text of ours.

    Raises:
        RobotError: no such file, a format that is not read, or a mistake in it.
    """
    check_known_format(path)
    try:
        data = read_file(path)
    except OSError as error:
        raise RobotError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    if path.suffix.lower() == ".toml":
        raise RobotError(f"{path}: is a robot file already; expected a SYMORO file, such as x.par")
    return par_to_toml(data, str(path))


def check_known_format(path: Path) -> None:
    """Refuse a format that is not read, by its name.

    Raises:
        RobotError: says what to do instead.
    """
    name = NOT_READ.get(path.suffix.lower())
    if name is not None:
        raise RobotError(
            f"{path}: {name} is not read yet; expected a robot file (TOML) or a SYMORO file "
            "(.par); docs/converting.md tells how to write the table of a URDF by hand"
        )
