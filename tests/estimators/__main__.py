"""Ask what estimators are worth: `python -m tests.estimators --help`."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from modeler.estimation.identify import METHODS
from tests.estimators.coverage import CASES, covered, table
from tests.estimators.measured import HEADER, here, lines, tried
from tests.measured_sets.sets import DATA, SETS

EPILOG = """\
coverage    are the sigmas what repetition shows? Simulated machines of known values
measured    training and held-out error, seconds, on the logs of real machines
"""


def parser() -> argparse.ArgumentParser:
    """Options."""
    made = argparse.ArgumentParser(
        "python -m tests.estimators",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = made.add_subparsers(dest="command", required=True, metavar="COMMAND")
    one = commands.add_parser("coverage", help="sigmas against repetition")
    one.add_argument("--seeds", type=int, default=50, help="machines; default: %(default)s")
    one.add_argument("--first", type=int, default=1, help="number of the first; default: 1")
    one.add_argument("--cases", default=",".join(CASES), help="default: %(default)s")
    one.add_argument("--jobs", type=int, default=1, help="processes; default: %(default)s")
    two = commands.add_parser("measured", help="errors on real machines")
    two.add_argument("--sets", default=",".join(SETS), help="default: %(default)s")
    two.add_argument("--data", type=Path, default=DATA, help="folder of the measured logs")
    for command in (one, two):
        command.add_argument("--methods", default=",".join(METHODS), help="default: %(default)s")
    return made


def named(text: str, known: Sequence[str]) -> list[str]:
    """The names in a list with commas; ends the program with a line if one is unknown."""
    names = text.split(",")
    if unknown := [name for name in names if name not in known]:
        sys.exit(f"unknown: {', '.join(unknown)}; expected of {', '.join(known)}")
    return names


def main(arguments: Sequence[str] | None = None) -> int:
    """Ask, print."""
    options = parser().parse_args(arguments)
    methods = named(options.methods, list(METHODS))
    if options.command == "measured":
        print(HEADER, "|---|---|---|---|---|---|---|", sep="\n", flush=True)
        for name in here(named(options.sets, list(SETS)), options.data):
            print(lines(name, tried(name, options.data, methods)), flush=True)
        return 0
    seeds = range(options.first, options.first + options.seeds)
    for case in named(options.cases, list(CASES)):
        print(table(case, covered(seeds, case, methods, options.jobs)), flush=True)
        print(flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
