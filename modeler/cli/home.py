"""`modeler home ROBOT`."""

import argparse
from pathlib import Path

import numpy as np

from modeler.api.postures import chosen_mode, home as home_modes
from modeler.cli.console import Json, say, say_lines, working
from modeler.cli.lists import check_own_file, read_robot_with_notes
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.derivation import HomeModes, Linkage, written
from modeler.report import PICTURE_KINDS, Posture, modes_html, size_of, skeleton_of
from modeler.robot import Place, Robot, home_lines, read_home, with_home_text

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
    near = _near(args, robot)
    with working(f"closing the loops of {robot.name}"):
        found = home_modes(robot, near, args.anew)
    chosen = chosen_mode(found, args.mode, args.near is not None)
    say_lines(_table(found))
    for place, ending in ((args.picture, kind), (args.report, ".html")):
        if place is not None:
            with working("drawing"):
                write_atomically(Path(place), _pictures(found, ending))
            say(f"written: {place}")
    home = written(found.linkage, found.modes[chosen].posture)
    if args.write:
        path, text = Path(args.robot), with_home_text(robot.text, robot.home, home)
        if b"\r\n" in path.read_bytes():  # its line ends stay as they were
            text = text.replace("\n", "\r\n")
        write_atomically(path, text)
        say(f"mode {found.modes[chosen].letter} written into {args.robot} as [home]")
    else:
        say(f"[home] of mode {found.modes[chosen].letter} (--write puts it into the file):")
        say_lines(home_lines(home), "  ")
    return {
        "robot": robot.name,
        "chosen": found.modes[chosen].letter,
        "of_the_file": None if found.own is None else found.modes[found.own].letter,
        "modes": [
            {
                "letter": mode.letter,
                "home": written(found.linkage, mode.posture),
                "singular_value": mode.sigma,
                "within_limits": mode.kept,
                "copies": mode.copies,
                "away": mode.away,
            }
            for mode in found.modes
        ],
    }


def _pictures(found: HomeModes, kind: str) -> bytes:
    """A small picture of every assembly mode, beside each other: a file that needs no other."""
    from modeler.report import modes_bytes

    robot = found.linkage.robot
    skeleton = skeleton_of(robot)
    size = size_of(skeleton, found.modes[0].posture)
    postures = [Posture(mode.posture, size, closed=True, held=True) for mode in found.modes]
    titles = [
        mode.letter + (" (as in the file)" if k == found.own else "")
        for k, mode in enumerate(found.modes)
    ]
    drawn = modes_bytes(skeleton, postures, titles, ".svg" if kind == ".html" else kind)
    if kind != ".html":
        return drawn
    return modes_html(robot.name, robot.title, len(found.modes), drawn.decode()).encode()


def _near(args: argparse.Namespace, robot: Robot) -> dict[str, float] | None:
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
    moving = {joint.name: joint for joint in robot.moving}
    return dict(read_home(Place("--near", value=values), moving, robot.symbol_values()))


def _table(found: HomeModes) -> list[str]:
    linkage, modes = found.linkage, found.modes
    given = list(linkage.loops.given)
    count = f"{len(modes)} assembly mode{'s' if len(modes) > 1 else ''}"
    lines = [f"{linkage.robot.name}: {count} with {_values(linkage, modes[0].posture, given)}", ""]
    # The joints by which people tell modes apart: the platform's, else the first that follow.
    names = [joint.name for joint in linkage.free]
    shown = [names.index(name) for name in linkage.robot.platform if name in names]
    shown = shown or list(linkage.loops.solved)[:_MOST_VALUES]
    for k, mode in enumerate(modes):
        facts = [f"singular value {mode.sigma:.2g}"]
        if linkage.robot.limits:
            facts.append("within [limits]" if mode.kept else "outside [limits]")
        if mode.copies > 1:
            facts.append(f"{mode.copies} symmetric copies")
        if k == found.own:
            facts.append("as [home] of the file" if linkage.robot.home else "as without [home]")
        lines.append(f"{mode.letter:<3} {_values(linkage, mode.posture, shown)}")
        lines.append(f"    {', '.join(facts)}")
    return [*lines, ""]


def _values(linkage: Linkage, u: np.ndarray, places: list[int]) -> str:
    """`q1 = 1.571 rad (90.00 deg), q3 = 0.33 m`."""
    told = []
    for k in places:
        value = float(f"{u[k]:.4g}") if abs(u[k]) > 1e-9 else 0.0
        degrees = f" ({np.degrees(value):.1f} deg)" if linkage.free[k].angular else ""
        told.append(f"q{linkage.free[k].name} = {value:g} {linkage.free[k].unit}{degrees}")
    return ", ".join(told)
