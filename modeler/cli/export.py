"""`modeler export MODEL or ROBOT --out FILE`: URDF, MJCF, SDF."""

import argparse
from pathlib import Path

from modeler.api.exporting import export
from modeler.api.model import open_model
from modeler.cli.console import Json, note, say, say_lines, working
from modeler.cli.lists import read_robot_with_notes


def run_export(args: argparse.Namespace) -> Json:
    """Writes the file; prints its numbers and what it cannot hold."""
    model = open_model(args.source) if Path(args.source).suffix.lower() == ".json" else None
    thing = read_robot_with_notes(args.source) if model is None else model
    for line in () if model is None else model.warning:
        note(line)
    with working(f"exporting {args.source}"):
        found = export(thing, args.out, args.to, args.like, args.force)
    first, *lines = found.summary().splitlines()
    say(f"{first}, written to {args.out}")
    changed = found.table("changed")
    if found.like and len(changed):
        same = len(found.values) - len(changed)
        say_lines(
            [
                "",
                *changed.text().splitlines()[1:],
                f"{same} others are as they were, in these digits",
                "",
            ]
        )
    say_lines(lines, "* ")
    return {**found.to_dict(), "out": str(args.out)}
