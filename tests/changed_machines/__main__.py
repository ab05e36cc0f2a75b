"""Run the suite: `python -m tests.changed_machines --help`."""

import argparse
import re
import time
from collections import Counter
from collections.abc import Sequence

from tests.changed_machines.judge import name_changes
from tests.changed_machines.machines import KINDS, NONE, make_machine


def main(arguments: Sequence[str] | None = None) -> None:
    """Prints a line for each machine that is not named right, and the table."""
    parser = argparse.ArgumentParser("python -m tests.changed_machines", description=__doc__)
    parser.add_argument("--kinds", default=",".join([*KINDS, NONE]), help="default: all")
    parser.add_argument("--seeds", default="1-20", help="first and last; default: %(default)s")
    parser.add_argument("--counts", type=int, help="of the encoders; default: drawn")
    options = parser.parse_args(arguments)
    first, _, last = options.seeds.partition("-")
    start, table = time.perf_counter(), Counter[tuple[str, str]]()
    for kind in options.kinds.split(","):
        for seed in range(int(first), int(last or first) + 1):
            machine = make_machine(kind, seed, options.counts)
            lines = name_changes(machine)
            right = len(lines) == 1 and re.search(machine.pattern, lines[0])
            verdict = "right" if (not lines if kind == NONE else right) else "wrong"
            verdict = verdict if lines or kind == NONE else "unseen"
            table[kind, verdict] += 1
            if verdict != "right":
                about = f"{machine.robot}, {machine.about}"
                print(f"{verdict:6} {kind} {seed} ({about}): {' | '.join(lines)}", flush=True)
    print(f"\n{'change':10} machines  right  unseen  wrong  ({time.perf_counter() - start:.0f} s)")
    for kind in options.kinds.split(","):
        right, unseen, wrong = (table[kind, each] for each in ("right", "unseen", "wrong"))
        print(f"{kind:10} {right + unseen + wrong:8}{right:7}{unseen:8}{wrong:7}")


if __name__ == "__main__":
    main()
