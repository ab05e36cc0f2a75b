"""All lines in one run: `python -m benchmarks --json FILE`."""

import argparse
import fnmatch
import json
import sys
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from benchmarks.all import LINES
from benchmarks.line import Key, Line, Missing
from benchmarks.machine import machine
from benchmarks.markdown import markdown


def main(words: list[str] | None = None) -> int:
    """Measure what is requested; the exit status."""
    asked = _parser().parse_args(words)
    if asked.markdown:
        report = json.loads(Path(asked.markdown).read_text(encoding="utf-8"))
        print(markdown(report, lambda name: _named([name], asked.only)))
        return 0
    lines = [line for line in LINES if _named([key.name for key in line.keys], asked.only)]
    if asked.list:
        for line in lines:
            for key in line.keys:
                print(f"{key.name:<50}{key.unit:<4}{key.meaning}")
        return 0
    if not lines:
        print(f"benchmarks: no line matches {' '.join(asked.only)}; see --list", file=sys.stderr)
        return 1
    measured(lines, asked.quick, Path(asked.json) if asked.json else None)
    return 0


def measured(lines: list[Line], quick: bool, place: Path | None = None) -> dict[str, Any]:
    """The report: machine, values, and why some are missing; shows each as it comes.

    It is written anew after every line, so what is there is kept where a run is ended early.
    """
    start = time.perf_counter()
    report: dict[str, Any] = {"machine": machine(), "quick": quick, "values": {}, "missing": {}}
    for line in lines:
        for key, value in _values(line, quick):
            report["values"][key.name] = None if isinstance(value, Missing) else value
            text = f"missing: {value}"
            if isinstance(value, Missing):
                report["missing"][key.name] = str(value)
            else:
                text = f"{value:.4g} {key.unit}"
            print(f"{key.name:<50}{text}", flush=True)
        report["seconds"] = round(time.perf_counter() - start, 1)
        if place is not None:
            place.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    return report


def _values(line: Line, quick: bool) -> Iterator[tuple[Key, float | Missing]]:
    """Of every key of a line, in their order."""
    values: Mapping[str, float | Missing] = {}
    why = Missing("not part of a quick run" if quick else "the line gave no such value")
    try:
        values = line.measure(quick)
    except Missing as missing:
        why = missing
    except Exception as error:  # one line that breaks must not take the others along
        why = Missing(f"{type(error).__name__}: {error}")
    for key in line.keys:
        yield key, values.get(key.name, why)


def _named(names: list[str], patterns: list[str]) -> bool:
    return not patterns or any(fnmatch.filter(names, f"{pattern}*") for pattern in patterns)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks",
        description="How fast modeler is on this machine, side by side with its peers.",
        epilog="example: python -m benchmarks --only help_seconds scalar_vs --json speed.json",
    )
    parser.add_argument("--json", metavar="FILE", help="write machine and numbers, by stable keys")
    parser.add_argument(
        "--only", metavar="KEY", nargs="+", default=[], help="lines with such a key (start, or *)"
    )
    parser.add_argument("--quick", action="store_true", help="a tenth of the work, less accurate")
    parser.add_argument("--list", action="store_true", help="what there is to measure, and leave")
    parser.add_argument("--markdown", metavar="FILE", help="print a table of such a JSON file")
    return parser


if __name__ == "__main__":
    sys.exit(main())
