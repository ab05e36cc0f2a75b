"""Robot files to start from: templates that derive as they are, and files of other programs."""

import re
import string
from collections.abc import Mapping
from pathlib import Path

from modeler.core.choices import TEMPLATES, read_template
from modeler.core.errors import DataError, RobotError
from modeler.core.files import (
    DestinationKind,
    resolve_destination,
    write_atomically,
    write_without_overwriting,
)
from modeler.robot.cells import choose_robot_name
from modeler.robot.conventions import CONVENTIONS, GEOMETRY, STEPS
from modeler.robot.conversion import convert_robot_file
from modeler.robot.read import build_converted_robot, parse_robot_text
from modeler.robot.robot import Robot
from modeler.robot.robot_text import align_cells

MOST_JOINTS = 20
SERIAL = "serial"
_TITLES = {
    SERIAL: "a serial robot",
    "parallelogram": "an arm with a parallelogram",
    "parallel": "a planar parallel robot of three legs",
}
_WORDS = str.maketrans({"\u03b1": "alpha", "\u03b3": "gamma", "\u03b8": "theta", "\u2192": "->"})
_ALPHA = ("0", "-pi/2", "0", "pi/2", "-pi/2", "pi/2")  # shoulder, elbow, wrist


def new_robot(
    path: str | Path,
    template: str = "serial",
    joints: str = "RRR",
    convention: str = "khalil",
    force: bool = False,
) -> Robot:
    """Writes a commented robot file to start from, which derives as it is.

    >>> derive(new_robot("six.toml", joints="RRP")).base.proof.kind
    'exact'

    Args:
        path: of the file, ending in .toml; the robot is called as it is.
        template: `serial`, `parallelogram` or `parallel`.
        joints: of a serial robot, from the base: R revolute, P prismatic.
        convention: whose table a serial robot gets: `khalil`, `craig` or `classical`.
        force: write over a file that is there.

    Raises:
        RobotError: an unknown template or convention, or other letters for joints.
        DataError: another ending, or a file that is there.
    """
    place = Path(path)
    check_new_robot(place, force)
    text = fill_template(choose_robot_name(place.stem), template, joints, convention)
    robot = parse_robot_text(text, str(place))
    write_atomically(place, text)
    return robot


def convert(
    file: str | Path,
    out: str | Path | None = None,
    base: str = "",
    tip: str = "",
    lock: Mapping[str, str | float] | None = None,
    exact_decimals: bool = False,
    force: bool = False,
) -> Robot:
    """The robot of a URDF, MJCF or SYMORO file; written as a robot file if `out` says where.

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


def check_new_robot(place: Path, force: bool) -> None:
    """Refuse what `new_robot` would: another ending, or a file that is there."""
    if place.suffix.lower() != ".toml":
        raise DataError(
            f"{place}: got {place.suffix or 'no ending'}; expected a name such as arm.toml"
        )
    if resolve_destination(place).kind is DestinationKind.FILE and not force:
        raise DataError(
            f"{place}: there is such a file; choose another name, or write over it with --force "
            "(force=True)"
        )


def fill_template(
    name: str, template: str = SERIAL, joints: str = "RRR", convention: str = "khalil"
) -> str:
    """The text of a robot file that derives as it is, with comments on what to change.

    Args:
        name: of the robot.
        template: one of `TEMPLATES`.
        joints: of a serial robot, from the base: R revolute, P prismatic.
        convention: in whose letters the table of a serial robot is.

    Raises:
        RobotError: an unknown template or convention, or other letters for joints.
    """
    if template not in TEMPLATES:
        raise RobotError(f"template: got {template}; expected one of {', '.join(TEMPLATES)}")
    if convention not in CONVENTIONS:
        raise RobotError(f"convention: got {convention}; expected one of {', '.join(CONVENTIONS)}")
    kinds = joints.upper()
    if not re.fullmatch(rf"[RP]{{1,{MOST_JOINTS}}}", kinds):
        raise RobotError(
            f"joints: got {joints!r}; expected R (revolute) or P (prismatic) for each joint from "
            f"the base, {MOST_JOINTS} at most, such as RRPRRR"
        )
    if template != SERIAL and (kinds != "RRR" or convention != "khalil"):
        raise RobotError(
            f"joints, convention: got {joints}, {convention} with the template {template}, which "
            "has its own; leave them out, or take the template serial"
        )
    values = {"name": name, "title": f"{name}, {_TITLES[template]}"}
    return string.Template(read_template(template)).substitute(
        values | _build_serial_values(kinds, convention)
    )


def _build_serial_values(kinds: str, convention: str) -> dict[str, str]:
    """What stands in the template of a serial robot."""
    rows, lengths = [], dict[str, str]()
    for j, kind in enumerate(kinds, start=1):
        row = dict.fromkeys(GEOMETRY, "0") | {"alpha": _ALPHA[(j - 1) % len(_ALPHA)]}
        row |= {"j": f"{j}", "sigma": "1" if kind == "P" else "0"}
        if j > 1 and row["alpha"] == "0":
            row["d"], lengths[f"D{j}"] = f"D{j}", f"{0.25 + 0.03 * j:.2f}"
        if kind == "R" and j % 3 == 1:
            row["r"], lengths[f"R{j}"] = f"R{j}", f"{0.2 + 0.03 * j:.2f}"
        row["r" if kind == "P" else "theta"] = f"q{j}"
        rows.append(row)
    if convention == "classical":  # alpha and d stand in the row before
        for row, after in zip(rows, [*rows[1:], {"alpha": "0", "d": "0"}], strict=True):
            row |= {"alpha": after["alpha"], "d": after["d"]}
    letters = CONVENTIONS[convention]
    columns = [c for c in letters if c in ("j", "sigma", "alpha", "d", "theta", "r")]
    cells = [[f'"{letters[c]}"' for c in columns]]
    cells += [
        [row[c] if c != "j" and row[c] in "01" else f'"{row[c]}"' for c in columns] for row in rows
    ]
    head, *lines = align_cells(cells)
    stated = f'convention = "{convention}"\n' if convention != "khalil" else ""
    body = "".join(f"          [{line}],\n" for line in lines)
    symbols = [f"{name} = {length}".ljust(38) + "# m" for name, length in lengths.items()]
    ranges = {"R": ('["-90 deg", "90 deg", 2, 8]', "rad, rad/s, rad/s^2"),
              "P": ("[-0.3, 0.3, 0.5, 3]", "m, m/s, m/s^2")}  # fmt: skip
    limits = [
        f"{j} = {ranges[kind][0]}".ljust(38) + f"# {ranges[kind][1]}"
        for j, kind in enumerate(kinds, 1)
    ]
    return {
        "symbols": "\n".join(symbols), "limits": "\n".join(limits),
        "table": f"{stated}columns = [{head}]\nrows = [\n{body}]",
        "step": STEPS[convention].translate(_WORDS).replace("; ", "\n# "),
    }  # fmt: skip
