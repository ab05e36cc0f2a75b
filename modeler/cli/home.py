"""`modeler home ROBOT`."""

import argparse
from pathlib import Path

import numpy as np

from modeler.api.postures import chosen_mode
from modeler.api.postures import home as home_modes
from modeler.cli.console import Json, say, working
from modeler.cli.lists import read_told
from modeler.core.builtin import OTHER_PROGRAMS, builtin_names
from modeler.core.errors import DataError
from modeler.core.files import check_writable, write_atomically
from modeler.derivation.assembly_modes import AssemblyMode
from modeler.derivation.derive import HomeModes, written
from modeler.derivation.walks import Linkage
from modeler.report.robot import modes_html
from modeler.report.robot_closing import Posture
from modeler.report.robot_skeleton import PICTURE_KINDS, size_of, skeleton_of
from modeler.robot.edit import home_lines, with_home_text
from modeler.robot.loops import read_home
from modeler.robot.robot import Place, Robot

# A small picture of every assembly mode, beside each other.


MODE_PICTURES = (*PICTURE_KINDS, ".html")


def modes_file(found: HomeModes, kind: str) -> bytes:
    """The modes as a file that needs no other.

    Args:
        found: the modes.
        kind: one of `MODE_PICTURES`.
    """
    if kind in PICTURE_KINDS:
        return _drawn(found, kind)
    robot, svg = found.linkage.robot, _drawn(found, ".svg").decode()
    return modes_html(robot.name, robot.title, len(found.modes), svg).encode()


def _drawn(found: HomeModes, kind: str) -> bytes:
    from modeler.report.robot_drawing import modes_bytes

    skeleton = skeleton_of(found.linkage.robot)
    size = size_of(skeleton, found.modes[0].posture)
    postures = [Posture(mode.posture, size, closed=True, held=True) for mode in found.modes]
    titles = [
        mode.letter + (" (as in the file)" if k == found.own else "")
        for k, mode in enumerate(found.modes)
    ]
    return modes_bytes(skeleton, postures, titles, kind)


_MOST_VALUES = 6


def run_home(args: argparse.Namespace) -> Json:
    """Prints the assembly modes, draws them, writes one into the robot file."""
    kind = _kind_of(args.pictures)
    if args.write:
        _check_ours(args.robot)
    robot = read_told(args.robot)
    near = _near(args, robot)
    with working(f"closing the loops of {robot.name}"):
        found = home_modes(robot, near, args.anew)
    chosen = chosen_mode(found, args.mode, args.near is not None)
    for line in _table(found):
        say(line)
    if args.pictures is not None:
        with working("drawing"):
            write_atomically(Path(args.pictures), modes_file(found, kind))
        say(f"written: {args.pictures}")
    home = written(found.linkage, found.modes[chosen].posture)
    if args.write:
        _write(Path(args.robot), robot, home)
        say(f"mode {found.modes[chosen].letter} written into {args.robot} as [home]")
    else:
        say(f"[home] of mode {found.modes[chosen].letter} (--write puts it into the file):")
        for line in home_lines(home):
            say(f"  {line}")
    return _as_json(robot, found, chosen)


def _check_ours(robot: str) -> None:
    """What --write cannot write into is refused before any work."""
    if robot in builtin_names():
        raise DataError(
            f"--write: {robot} is built in; save it with `modeler robots --show {robot}` "
            "as a file of your own, and write into that"
        )
    path = Path(robot)
    if path.suffix.lower() in OTHER_PROGRAMS:
        raise DataError(
            f"--write: {path} is another program's file, which states no posture; convert it with "
            f"`modeler convert {path} --out {path.with_suffix('.toml')}`, and write into that"
        )
    if path.is_file():
        check_writable(path)


def _kind_of(pictures: str | None) -> str:
    kind = "" if pictures is None else Path(pictures).suffix.lower()
    if pictures is not None and kind not in MODE_PICTURES:
        raise DataError(
            f"--pictures {pictures}: got {kind or 'no ending'}; expected a name that ends in "
            f"{', '.join(MODE_PICTURES)}"
        )
    return kind


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
    return dict(read_home(values, moving, robot.symbol_values(), Place("--near")))


def _table(found: HomeModes) -> list[str]:
    linkage, modes = found.linkage, found.modes
    given = list(linkage.closing.given)
    count = f"{len(modes)} assembly mode{'s' if len(modes) > 1 else ''}"
    lines = [
        f"{linkage.robot.name}: {count} with {_values(linkage, modes[0].posture, given)}",
        "",
    ]
    shown = _shown(linkage)
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


def _shown(linkage: Linkage) -> list[int]:
    """The joints by which people tell modes apart: the platform's, else the first that follow."""
    names = [joint.name for joint in linkage.free]
    platform = [names.index(name) for name in linkage.robot.platform if name in names]
    return platform or list(linkage.closing.solved)[:_MOST_VALUES]


def _values(linkage: Linkage, u: np.ndarray, places: list[int]) -> str:
    """`q1 = 1.571 rad (90.00 deg), q3 = 0.33 m`."""
    told = []
    for k in places:
        value = float(f"{u[k]:.4g}") if abs(u[k]) > 1e-9 else 0.0
        degrees = f" ({np.degrees(value):.1f} deg)" if linkage.free[k].angular else ""
        told.append(f"q{linkage.free[k].name} = {value:g} {linkage.free[k].unit}{degrees}")
    return ", ".join(told)


def _write(path: Path, robot: Robot, home: dict[str, float]) -> None:
    """The file with that home; its line ends as they were."""
    text = with_home_text(robot.text, robot.home, home)
    if b"\r\n" in path.read_bytes():
        text = text.replace("\n", "\r\n")
    write_atomically(path, text)


def _as_json(robot: Robot, found: HomeModes, chosen: int) -> Json:
    return {
        "robot": robot.name,
        "chosen": found.modes[chosen].letter,
        "of_the_file": None if found.own is None else found.modes[found.own].letter,
        "modes": [_mode_json(found.linkage, mode) for mode in found.modes],
    }


def _mode_json(linkage: Linkage, mode: AssemblyMode) -> Json:
    return {
        "letter": mode.letter,
        "home": written(linkage, mode.posture),
        "singular_value": mode.sigma,
        "within_limits": mode.kept,
        "copies": mode.copies,
        "away": mode.away,
    }
