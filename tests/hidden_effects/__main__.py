"""Run the suite: `python -m tests.hidden_effects --help`."""

import argparse
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from tests.hidden_effects.asked import names_of
from tests.hidden_effects.case import NONE, Case
from tests.hidden_effects.drives import NOISE
from tests.hidden_effects.effects import EFFECTS
from tests.hidden_effects.score import Score
from tests.hidden_effects.sensor_kinds import FINE, SENSORS
from tests.hidden_effects.suite import ACCEPTANCE, DEVELOPMENT, cases_with, run
from tests.hidden_effects.table import line, page

SEEDS = 3  # of every effect at every noise
PAIRS = 20
MORE = {
    "two": f"N (default {PAIRS}) pairs of effects at every noise",
    "clean": "N arms without any, at every noise",
    "withheld": "N effects at every noise that the diagnosis may not name",
    "held-out": "every cause outside the catalogue at every noise, with the first N seeds",
}


def parser() -> argparse.ArgumentParser:
    """Options."""
    made = argparse.ArgumentParser("python -m tests.hidden_effects", description=__doc__)
    add = made.add_argument
    add("--effects", help="names with commas, or none; default: all")
    add("--noise", default=",".join(NOISE), help="default: %(default)s")
    add("--sensors", default=FINE, help=f"of {', '.join(SENSORS)}; default: %(default)s")
    seeds = made.add_mutually_exclusive_group()
    seeds.add_argument("--seeds", help=f"numbers with commas; default: 1 to {SEEDS}")
    seeds.add_argument(
        "--acceptance",
        nargs="?",
        type=int,
        const=SEEDS,
        metavar="N",
        help=f"the first N (default {SEEDS}) of the seeds {ACCEPTANCE[0]} to {ACCEPTANCE[-1]}",
    )
    add("--first", type=int, default=0, metavar="SEED", help="leave out seeds below this one")
    for name, text in MORE.items():
        usual = {"nargs": "?", "const": PAIRS} if name == "two" else {}
        add(f"--{name}", type=int, default=0, metavar="N", help=f"and {text}", **usual)
    add("--out", type=Path, help="folder that keeps cases and results: run again, and it goes on")
    add("--table", type=Path, help="page to write, in Markdown; default: printed")
    add("--jobs", type=int, default=1, help="processes; default: 1")
    return made


def cases_of(options: argparse.Namespace) -> list[Case]:
    """What the options ask for; ends the program with a line if they make no sense."""
    names = [] if options.effects == NONE else names_of(options.effects, EFFECTS)
    noises, sensors = names_of(options.noise, NOISE), names_of(options.sensors, SENSORS)
    every = ACCEPTANCE if options.acceptance else DEVELOPMENT
    pool = range(max(every.start, options.first), every.stop)
    seeds = list(pool[: options.acceptance or SEEDS])
    if options.seeds:
        seeds = [int(seed) for seed in options.seeds.split(",")]
    if not set(seeds) <= set(pool):
        sys.exit(f"seeds {options.seeds}: expected of {pool[0]} to {pool[-1]}, or --acceptance")
    asked = (options.clean, options.two, options.withheld, options.held_out)
    made = cases_with(names, noises, seeds, pool, *asked)
    return [replace(case, sensor=sensor) for sensor in sensors for case in made]


def _tell(score: Score) -> None:
    mark = ("ok  " if score.right else "MISS") if score.detectable else "hard"
    mark = "LIE " if score.false and not score.held_out else mark
    print(f"{mark} {line(score)} [{score.seconds:.1f} s]", flush=True)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run; print or write the page."""
    options = parser().parse_args(arguments)
    cases = cases_of(options)
    with tempfile.TemporaryDirectory() as folder:
        scores = run(cases, options.out or Path(folder), options.jobs, _tell)
    if options.table:
        options.table.parent.mkdir(parents=True, exist_ok=True)
        options.table.write_text(page(scores), encoding="utf-8")
    else:
        print(page(scores))


if __name__ == "__main__":
    main()
