"""`python -m tests.bad_input --mutants N --seed S --out FILE`: so many, and all that was said."""

import argparse
import contextlib
import sys
import tempfile
from pathlib import Path

from tests.bad_input.drawn import run_mutants
from tests.bad_input.workdir import Inputs

parser = argparse.ArgumentParser(prog="python -m tests.bad_input")
parser.add_argument("--mutants", type=int, default=500, help="how many")
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--out", type=lambda place: Path(place).resolve(), help="file of all lines")
args = parser.parse_args()
with tempfile.TemporaryDirectory() as name:
    with contextlib.redirect_stdout(None):
        inputs = Inputs(Path(name))
    bad = run_mutants(args.mutants, args.seed, args.out, inputs)
print("\n".join(bad))
sys.exit(min(len(bad), 1))
