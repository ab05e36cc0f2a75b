"""Coverage by package, and the functions least covered: `make coverage` prints it each night."""

import json
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import coverage

LISTED = 20
LEAST = 3
"""Statements of a function that is listed: below, it is a property or a line handed on."""


def report_lines(report: Mapping[str, Any]) -> Iterator[str]:
    """The table of packages and the list of functions, of coverage's JSON report."""
    packages: dict[str, list[int]] = defaultdict(lambda: [0, 0, 0, 0])
    functions = []
    for path, file in report["files"].items():
        for package in (Path(path).parts[1] if len(Path(path).parts) > 2 else "modeler", "all"):
            for k, count in enumerate(_counts(file["summary"])):
                packages[package][k] += count
        functions += [
            (counts["summary"]["percent_covered"], -counts["summary"]["num_statements"], path, name)
            for name, counts in file["functions"].items()
            if name and counts["summary"]["num_statements"] >= LEAST  # else: rest of a module
        ]
    yield f"{'package':<14}{'lines':>8}{'covered':>9}{'branches':>10}{'covered':>9}"
    for package, (lines, run, branches, taken) in sorted(packages.items()):
        row = f"{package:<14}{lines:>8}{run / max(lines, 1):>9.1%}"
        yield f"{row}{branches:>10}{taken / max(branches, 1):>9.1%}"
    yield f"the {LISTED} functions least covered (test or delete them):"
    for percent, lines, path, name in sorted(functions)[:LISTED]:
        yield f"{percent:>4.0f} % of {-lines} lines  {path}: {name}"


def _counts(summary: Mapping[str, int]) -> tuple[int, int, int, int]:
    """Lines, of them run; branches, of them taken."""
    return (
        summary["num_statements"],
        summary["covered_lines"],
        summary["num_branches"],
        summary["covered_branches"],
    )


def main() -> None:
    """Print the report of the data file that the run has left."""
    data = coverage.Coverage()
    data.load()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "coverage.json"
        data.json_report(outfile=str(place))
        report = json.loads(place.read_text(encoding="utf-8"))
    sys.stdout.writelines(f"{line}\n" for line in report_lines(report))


if __name__ == "__main__":
    main()
