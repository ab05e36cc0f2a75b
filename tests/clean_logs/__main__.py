"""`python -m tests.clean_logs [--first 0] [--count 40] [--all]`: wrong lines, or every line."""

import argparse
import tempfile
from pathlib import Path

from tests.clean_logs.judge import find_wrong_lines, print_all
from tests.clean_logs.machines import make_machine

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--first", type=int, default=0)
parser.add_argument("--count", type=int, default=40)
parser.add_argument("--all", action="store_true", help="every line, for reading")
args = parser.parse_args()
total = 0
for seed in range(args.first, args.first + args.count):
    with tempfile.TemporaryDirectory() as place:
        truth = make_machine(seed, Path(place))
        lines = print_all(Path(place))
    wrong = find_wrong_lines(lines, truth)
    total += bool(wrong)
    print(f"## {seed} {'+'.join(truth.ways)} {truth.rate:g} Hz held {truth.held}", flush=True)
    print(*(lines if args.all else wrong), sep="\n", flush=True)
print(f"{total} of {args.count} machines with a wrong line")
