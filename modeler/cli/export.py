"""`modeler export MODEL or ROBOT --out FILE`: URDF, MJCF, SDF."""

import argparse
from pathlib import Path

from modeler.api.exporting import export
from modeler.api.model import open_model
from modeler.cli.console import Json, print_lines, print_note, print_result, show_activity
from modeler.cli.lists import read_robot_with_notes


def run_export(args: argparse.Namespace) -> Json:
    """Writes the file; prints its numbers and what it cannot hold."""
    model = open_model(args.source) if Path(args.source).suffix.lower() == ".json" else None
    thing = read_robot_with_notes(args.source) if model is None else model
    for line in () if model is None else model.warning:
        print_note(line)
    with show_activity(f"exporting {args.source}"):
        exported = export(thing, args.out, args.to, args.like, args.force)
    first, *lines = exported.summary().splitlines()
    print_result(f"{first}, written to {args.out}")
    changed = exported.table("changed")
    if exported.like and len(changed):
        same = len(exported.values) - len(changed)
        print_lines(
            [
                "",
                *changed.to_text().splitlines()[1:],
                f"{same} others are as they were, in these digits",
                "",
            ]
        )
    print_lines(lines, "* ")
    return {**exported.to_dict(), "out": str(args.out)}
