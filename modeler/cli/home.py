"""`modeler home ROBOT`."""

import argparse
from pathlib import Path

import numpy as np

from modeler.api.postures import home as home_modes, select_mode
from modeler.cli.console import Json, print_lines, print_result, show_activity
from modeler.cli.lists import check_own_file, read_robot_with_notes
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.derivation import HomeModes, Linkage, express_as_home
from modeler.robot import Robot, TomlCell, format_home_lines, read_home, replace_home
from modeler.views import (
    PICTURE_KINDS,
    Posture,
    build_skeleton,
    estimate_robot_size,
    render_modes_page,
)

MODE_PICTURES = (*PICTURE_KINDS, ".html")

_MOST_VALUES = 6


def run_home(args: argparse.Namespace) -> Json:
    """Prints the assembly modes, draws them, writes one into the robot file."""
    kind = "" if args.picture is None else Path(args.picture).suffix.lower()
    if args.picture is not None and kind not in MODE_PICTURES:
        raise DataError(
            f"--picture {args.picture}: got {kind or 'no ending'}; expected a name that ends in "
            f"{', '.join(MODE_PICTURES)}"
        )
    if args.write:
        check_own_file(args.robot, "posture")
    robot = read_robot_with_notes(args.robot)
    near = _parse_near(args, robot)
    with show_activity(f"closing the loops of {robot.name}"):
        modes = home_modes(robot, near, args.anew)
    chosen = select_mode(modes, args.mode, args.near is not None)
    print_lines(_format_table(modes))
    for place, ending in ((args.picture, kind), (args.report, ".html")):
        if place is not None:
            with show_activity("drawing"):
                write_atomically(Path(place), _draw_modes(modes, ending))
            print_result(f"written: {place}")
    home = express_as_home(modes.linkage, modes.modes[chosen].posture)
    if args.write:
        path, text = Path(args.robot), replace_home(robot.text, robot.home, home)
        if b"\r\n" in path.read_bytes():  # its line ends stay as they were
            text = text.replace("\n", "\r\n")
        write_atomically(path, text)
        print_result(f"mode {modes.modes[chosen].letter} written into {args.robot} as [home]")
    else:
        print_result(
            f"[home] of mode {modes.modes[chosen].letter} (--write puts it into the file):"
        )
        print_lines(format_home_lines(home), "  ")
    return {
        "robot": robot.name,
        "chosen": modes.modes[chosen].letter,
        "of_the_file": None
        if modes.stated_index is None
        else modes.modes[modes.stated_index].letter,
        "modes": [
            {
                "letter": mode.letter,
                "home": express_as_home(modes.linkage, mode.posture),
                "singular_value": mode.singularity_distance,
                "within_limits": mode.is_within_limits,
                "copies": mode.copy_count,
                "away": mode.distance_from_stated,
            }
            for mode in modes.modes
        ],
    }


def _draw_modes(modes: HomeModes, kind: str) -> bytes:
    """A small picture of every assembly mode, beside each other: a file that needs no other."""
    from modeler.views import render_modes

    robot = modes.linkage.robot
    skeleton = build_skeleton(robot)
    size = estimate_robot_size(skeleton, modes.modes[0].posture)
    postures = [Posture(mode.posture, size, closed=True, held=True) for mode in modes.modes]
    titles = [
        mode.letter + (" (as in the file)" if k == modes.stated_index else "")
        for k, mode in enumerate(modes.modes)
    ]
    picture = render_modes(skeleton, postures, titles, ".svg" if kind == ".html" else kind)
    if kind != ".html":
        return picture
    return render_modes_page(robot.name, robot.title, len(modes.modes), picture.decode()).encode()


def _parse_near(args: argparse.Namespace, robot: Robot) -> dict[str, float] | None:
    """The values of --near; None without."""
    if args.near is None:
        return None
    values: dict[str, str] = {}
    for entry in args.near.split(","):
        name, equals, value = (part.strip() for part in entry.partition("="))
        if not equals or not name or not value:
            raise DataError(
                f"--near {args.near}: got {entry!r}; expected values as in q1=0.3,q2=pi"
            )
        values[name] = value
    moving = {joint.name: joint for joint in robot.moving_joints}
    return dict(read_home(TomlCell("--near", value=values), moving, robot.evaluate_symbols()))


def _format_table(assembly: HomeModes) -> list[str]:
    linkage, modes = assembly.linkage, assembly.modes
    actuated_joints = list(linkage.loops.actuated)
    count = f"{len(modes)} assembly mode{'s' if len(modes) > 1 else ''}"
    lines = [
        f"{linkage.robot.name}: {count} with "
        f"{_format_values(linkage, modes[0].posture, actuated_joints)}",
        "",
    ]
    # The joints by which people tell modes apart: the platform's, else the first that follow.
    names = [joint.name for joint in linkage.free]
    shown_places = [names.index(name) for name in linkage.robot.platform if name in names]
    shown_places = shown_places or list(linkage.loops.solved)[:_MOST_VALUES]
    for k, mode in enumerate(modes):
        facts = [f"singular value {mode.singularity_distance:.2g}"]
        if linkage.robot.limits:
            facts.append("within [limits]" if mode.is_within_limits else "outside [limits]")
        if mode.copy_count > 1:
            facts.append(f"{mode.copy_count} symmetric copies")
        if k == assembly.stated_index:
            facts.append("as [home] of the file" if linkage.robot.home else "as without [home]")
        lines.append(f"{mode.letter:<3} {_format_values(linkage, mode.posture, shown_places)}")
        lines.append(f"    {', '.join(facts)}")
    return [*lines, ""]


def _format_values(linkage: Linkage, u: np.ndarray, places: list[int]) -> str:
    """`q1 = 1.571 rad (90.00 deg), q3 = 0.33 m`."""
    texts = []
    for k in places:
        value = float(f"{u[k]:.4g}") if abs(u[k]) > 1e-9 else 0.0
        degrees = f" ({np.degrees(value):.1f} deg)" if linkage.free[k].is_revolute else ""
        texts.append(f"q{linkage.free[k].name} = {value:g} {linkage.free[k].unit}{degrees}")
    return ", ".join(texts)
