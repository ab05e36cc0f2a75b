"""`modeler convert FILE --out ROBOT.toml`."""

import argparse
from pathlib import Path

from modeler.cli.console import Json, say
from modeler.core.destination import Kind, destination
from modeler.core.errors import ModelerError
from modeler.core.files import write_atomically
from modeler.robot import robot_from_text
from modeler.robot.converted import converted


def run_convert(args: argparse.Namespace) -> Json:
    """Writes the robot file, when it has been read as one; prints the notes."""
    found = converted(Path(args.file))
    out = Path(args.out)
    robot = robot_from_text(found.text, f"{args.file}, as a robot file")
    if not args.force and _is_other(out, found.text):
        raise ModelerError(
            f"--out {out}: there is such a file with another content; choose another name, or "
            "write over it with --force"
        )
    write_atomically(out, found.text)
    loops = f", {len(robot.loops)} loops" if robot.loops else ""
    say(f"{robot.name}: {len(robot.moving)} joints{loops}, written to {out}")
    for note in found.notes:
        say(f"* {note}")
    return {
        "robot": robot.name,
        "file": str(args.file),
        "out": str(out),
        "joints": [joint.name for joint in robot.moving],
        "loops": [loop.name for loop in robot.loops],
        "notes": list(found.notes),
    }


def _is_other(out: Path, text: str) -> bool:
    """True of a file that would be lost."""
    if destination(out).kind is not Kind.FILE:
        return False
    return out.read_bytes() != text.encode()
