"""Ask about measured machines: `python -m tests.measured_sets --help`."""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from tests.hidden_effects.asked import names_of
from tests.measured_sets.answer import Answer
from tests.measured_sets.chain import diagnosed, improved
from tests.measured_sets.sets import DATA, DIRECTIONS, FACTORS, SETS, Case
from tests.measured_sets.suite import Ask, run
from tests.measured_sets.table import improvement, line, sanity, stability, wrong

COMMANDS: dict[str, tuple[Ask, str, Callable[[Sequence[Answer]], str]]] = {
    "stability": (diagnosed, "diagnoses.jsonl", stability),
    "auto": (improved, "auto.jsonl", improvement),
    "check": (diagnosed, "diagnoses.jsonl", sanity),
}

EPILOG = """\
stability   is the same said with logs exchanged, and with other cut-offs?
auto        the error of the held-out motion before and after `modeler add auto`
check       can the stated values be those of a machine? Status 1 if a fact cannot be
"""


def parser() -> argparse.ArgumentParser:
    """Options."""
    made = argparse.ArgumentParser(
        "python -m tests.measured_sets",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = made.add_argument
    add("command", choices=COMMANDS, help="what to ask, see below")
    add("--sets", help=f"names with commas; default: {','.join(SETS)}")
    add("--directions", default=",".join(DIRECTIONS), help="default: %(default)s")
    add(
        "--factors",
        default=",".join(f"{factor:g}" for factor in FACTORS),
        help="cut-offs over those that the fit chooses, both; not for auto; default: %(default)s",
    )
    add("--data", type=Path, default=DATA, help="folder of the measured logs, one folder a set")
    add("--out", type=Path, help="folder that keeps results: run again, and it goes on")
    add("--jobs", type=int, default=1, help="processes; default: 1")
    return made


def cases_of(options: argparse.Namespace) -> list[Case]:
    """What the options ask for; ends the program with a line if they make no sense."""
    names, directions = names_of(options.sets, SETS), names_of(options.directions, DIRECTIONS)
    try:
        factors = [float(factor) for factor in options.factors.split(",")]
    except ValueError:
        sys.exit(f"--factors {options.factors}: expected numbers with commas")
    if options.command == "auto":
        factors = [1.0]
    return [Case(n, way, factor) for n in names for way in directions for factor in factors]


def _here(cases: Sequence[Case], data: Path) -> list[Case]:
    """Those whose logs are here; says which are not."""
    for name in dict.fromkeys(case.set for case in cases):
        if not (data / name).is_dir():
            print(f"NOT CHECKED: {name}, no measured logs in {data / name}", file=sys.stderr)
    return [case for case in cases if (data / case.set).is_dir()]


def main(arguments: Sequence[str] | None = None) -> int:
    """Ask, print."""
    options = parser().parse_args(arguments)
    ask, file, page = COMMANDS[options.command]
    cases = _here(cases_of(options), options.data)
    memory = options.out / file if options.out else None
    answers = run(
        cases,
        options.data,
        ask,
        memory,
        options.jobs,
        lambda answer: print(line(answer), file=sys.stderr, flush=True),
    )
    if answers:
        print(page(answers))
    return int(options.command == "check" and any(map(wrong, answers)))


if __name__ == "__main__":
    sys.exit(main())
