"""`modeler log FILE`: what is in a log, before anything is fitted to it."""

import argparse
import dataclasses
from collections.abc import Sequence
from pathlib import Path

from modeler.api.chain import compile_model, derive, generate, log_map
from modeler.api.looking import look_at
from modeler.cli.console import Json, progress, say, working
from modeler.cli.log_fit import doubts_of_fit
from modeler.cli.robots import read_told
from modeler.compiled import CompiledModel
from modeler.logs import map_from_words
from modeler.logs.look import Look
from modeler.pages.log import channel_rows, clock_line, log_pictures, write_log_page
from modeler.pictures.files import write_files

_WIDEST = 44  # letters of a cell


def run_log(args: argparse.Namespace) -> Json:
    """Prints what the log holds, its doubts, and a [log] to start from."""
    compiled = _compiled(args.robot)
    mapping = map_from_words(args.map) if compiled is None else log_map(compiled, args.map)
    seen = look_at(args.log, compiled, args.map)
    doubts = [*seen.doubts]
    if compiled is not None:
        heard, stands = doubts_of_fit(compiled, args.log, mapping, seen)
        if stands:  # it fits as it is: a range alone is no doubt
            doubts = [line for line in doubts if line not in seen.ranged]
            seen = dataclasses.replace(seen, suggested=seen.plain)
        doubts += [line for line in heard if line not in doubts]
    for line in _lines(seen, doubts):
        say(line)
    written = _written(args, seen, doubts)
    if written:
        say(f"written: {written}")
    return seen.to_json() | {"doubts": doubts}


def _compiled(robot: str | None) -> CompiledModel | None:
    if robot is None:
        return None
    read = read_told(robot)
    with working(f"deriving {read.name}"):
        return compile_model(generate(derive(read)))


def _lines(seen: Look, doubts: Sequence[str]) -> list[str]:
    lines = [f"{seen.name}: {seen.rows} rows"]
    lines += [
        f"  {stream.name}  {stream.kind}, {stream.rows} messages{', the clock' * stream.clock}"
        for stream in seen.streams
    ]
    lines.append("clock: none found" if seen.clock is None else f"clock {clock_line(seen.clock)}")
    lines += ["", *_aligned(channel_rows(seen)), ""]
    lines += [f"note: {note}" for note in seen.notes]
    lines += [f"doubt: {doubt}" for doubt in doubts] or ["no doubts"]
    if seen.suggested:
        told = "a mapping to start from, a guess: paste it into the robot file, or --map FILE.toml"
        lines += ["", told, "", seen.suggested.rstrip()]
    return lines


def _aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    cut = [[c if len(c) <= _WIDEST else f"...{c[3 - _WIDEST :]}" for c in row[:-1]] for row in rows]
    widths = [max(map(len, column)) for column in zip(*cut, strict=True)]
    lines = []
    for cells, row in zip(cut, rows, strict=True):
        texts = [
            cell.ljust(width) if k < 2 else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(cells, widths, strict=True))
        ]
        lines.append("  ".join([*texts, row[-1]]).rstrip())
    return lines


def _written(args: argparse.Namespace, seen: Look, doubts: Sequence[str]) -> str:
    """Writes page and pictures if they are asked for; says which."""
    places = []
    if args.page is not None:
        with working("drawing the page"):
            places.append(str(write_log_page(Path(args.page), seen, doubts, [])))
    if args.pictures is not None:
        with progress("drawing pictures") as bar:
            written = write_files(Path(args.pictures), log_pictures(seen), bar)
        places.append(f"{len(written)} files in {args.pictures}")
    return ", ".join(places)
