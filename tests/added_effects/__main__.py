"""Run the table: `python -m tests.added_effects --help`."""

import argparse
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor

from modeler.simulation.physics import HIDDEN
from tests.added_effects.case import LAG, Case, Outcome, draw_cases, judge

WITHOUT_A_PLACE = ("coupled_inertia", "coupled_friction", "passive_friction")
"""They need motors that turn several joints, or loops."""
MOST = 1.25
"""Error on the third log over that of the machine without the effect."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Prints a line for each case, and how many reach the floor."""
    every = [name for name in HIDDEN if name not in WITHOUT_A_PLACE] + [LAG]
    parser = argparse.ArgumentParser("python -m tests.added_effects", description=__doc__)
    parser.add_argument("--effects", default=",".join(every), help="default: all")
    parser.add_argument("--robots", default="demo-arm,puma560", help="default: %(default)s")
    parser.add_argument("--counts", default="1000000,65536", help="default: %(default)s")
    parser.add_argument("--jobs", type=int, default=1, help="processes; default: 1")
    options = parser.parse_args(arguments)
    counts = [int(each) for each in options.counts.split(",")]
    cases = [*draw_cases(options.effects.split(","), options.robots.split(","), counts)]
    print(
        "effect@joint, robot, counts | verdict | next, status | third log: % by the fit, held out"
    )
    print("promised, added, floor, added / floor", flush=True)
    reached = 0
    with ProcessPoolExecutor(options.jobs) as pool:
        for case, outcome in zip(cases, pool.map(ask, cases), strict=True):
            print(format_row(case, outcome), flush=True)
            reached += isinstance(outcome, Outcome) and outcome.ratio <= MOST
    print(f"{reached} of {len(cases)} reach {MOST} x the floor")


def ask(case: Case) -> Outcome | str:
    """Returns the outcome of a case, or why there is none."""
    try:
        return judge(case)
    except Exception as error:  # one line of a table, the others still count
        return f"{type(error).__name__}: {str(error)[-200:]}".replace("\n", " ")


def format_row(case: Case, outcome: Outcome | str) -> str:
    """Writes a line of the table."""
    head = f"{case.effect}@{case.joint} {case.robot} {case.counts}"
    if isinstance(outcome, str):
        return f"{head} | {outcome}"
    o = outcome
    numbers = [f"{100 * x:.3g}" for x in (o.spoilt, o.promised, o.added, o.floor)]
    words = o.next_line.split()
    command = f"{' '.join(words[2:3])} {words[4] if words[2:3] == ['add'] else ''}".strip()
    return f"{head} | {o.verdict} | {command} {o.status} | {' '.join(numbers)} | {o.ratio:.2f}"


if __name__ == "__main__":
    main()
