"""Run the suite: `python -m tests.log_faults --help`."""

import argparse
import time
from collections import defaultdict
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor

from tests.log_faults.judge import Answer, ask
from tests.log_faults.machines import FAULTS, NONE, ROBOTS, make_log, open_machine


def main(arguments: Sequence[str] | None = None) -> None:
    """Prints a line for each log that is not told right, and the table."""
    parser = argparse.ArgumentParser("python -m tests.log_faults", description=__doc__)
    parser.add_argument("--kinds", default=",".join([*FAULTS, NONE]), help="default: all")
    parser.add_argument("--seeds", default="1-20", help="first and last; default: %(default)s")
    parser.add_argument("--jobs", type=int, default=1, help="processes; default: 1")
    options = parser.parse_args(arguments)
    first, _, last = options.seeds.partition("-")
    seeds = range(int(first), int(last or first) + 1)
    by_machine = defaultdict(list)
    for kind in options.kinds.split(","):
        for seed in seeds:
            by_machine[seed % len(ROBOTS)].append((kind, seed))
    if options.jobs > 1:
        for name in ROBOTS:
            open_machine(name)  # compiled before processes ask for it at a time
    start, answers = time.perf_counter(), defaultdict[str, list[Answer]](list)
    with ProcessPoolExecutor(options.jobs) as pool:
        for done in pool.map(_ask_all, by_machine.values()):
            for kind, answer in done:
                answers[kind].append(answer)
    print(f"\n{'fault':12} logs  told  right  false  ({time.perf_counter() - start:.0f} s)")
    for kind in options.kinds.split(","):
        every = answers[kind]
        told, false = sum(a.told for a in every), sum(bool(a.false) for a in every)
        right = sum((a.told or kind == NONE) and not a.false for a in every)
        print(f"{kind:12} {len(every):4}  {told:4}  {right:5}  {false:5}")


def _ask_all(cases: Sequence[tuple[str, int]]) -> list[tuple[str, Answer]]:
    answers = []
    for kind, seed in cases:
        log = make_log(kind, seed)
        answer = ask(log)
        answers.append((kind, answer))
        if answer.false or not answer.told:
            mark = "FALSE" if answer.false else "ok" if kind == NONE else "MISS"
            what = " | ".join(answer.false or answer.lines)
            print(f"{mark:5} {kind} {seed} ({log.machine}, {log.about}): {what}", flush=True)
    return answers


if __name__ == "__main__":
    main()
