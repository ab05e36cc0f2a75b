"""`python -m tests.bad_input [WORD]`: every row with its outcome, and the share that is right.

`python -m tests.bad_input --mutants N --seed S --out FILE`: so many mutants, and all that was said.
"""

import argparse
import contextlib
import os
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from tests.bad_input.drawn import run_mutants
from tests.bad_input.judge import faults
from tests.bad_input.table import ROWS
from tests.bad_input.yard import Ground, Yard


def table(words: list[str]) -> int:
    """Print the rows whose id holds one of the words; the number that fails."""
    wrong: Counter[str] = Counter()
    rows = [row for row in ROWS if not words or any(word in row.id for word in words)]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ.setdefault("MODELER_CACHE", str(folder / "cache"))
        (folder / "ground").mkdir()
        with contextlib.redirect_stdout(None):
            ground = Ground(folder / "ground")
        for number, row in enumerate(rows):
            start = time.perf_counter()
            yard = folder / f"{number}"
            yard.mkdir()
            found = faults(row, Yard(yard, ground))
            wrong[found[0].partition(":")[0] if found else ""] += 1
            seconds = time.perf_counter() - start
            print(f"{'FAILS' if found else 'ok':6}{row.outcome:8}{seconds:5.1f} s  {row.id}")
            for line in found:
                print(f"          {line}")
    good, failing = wrong.pop("", 0), sum(wrong.values())
    print(f"{good} of {len(rows)} rows end as they must ({good / max(len(rows), 1):.1%})")
    print(f"failing: {dict(wrong)}" if failing else "none fails")
    return failing


def mutants(words: list[str]) -> int:
    """Draw and run mutants; the number that ends as none may."""
    parser = argparse.ArgumentParser(prog="python -m tests.bad_input")
    parser.add_argument("--mutants", type=int, default=500, help="how many")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=lambda place: Path(place).resolve(), help="file of all lines")
    args = parser.parse_args(words)
    with tempfile.TemporaryDirectory() as name:
        with contextlib.redirect_stdout(None):
            ground = Ground(Path(name))
        bad = run_mutants(args.mutants, args.seed, args.out, ground)
    print("\n".join(bad))
    return len(bad)


if __name__ == "__main__":
    given = sys.argv[1:]
    run = mutants if given and given[0].startswith("--") else table
    sys.exit(min(run(given), 1))
