"""Make the machines of a law and say what its true form explains.

python -m tests.unnamed_laws.study --law load_speed --seeds 3 --encoder fine --out FOLDER

With --learn, what a learned law takes of that; with --discover, the equations that are proposed.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path

from tests.unnamed_laws.found import what_is_learned, what_is_proposed
from tests.unnamed_laws.judge import errors
from tests.unnamed_laws.laws import LAWS
from tests.unnamed_laws.machines import CLEAN, ENCODERS, machine


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the machines; a line for each."""
    parser = argparse.ArgumentParser("python -m tests.unnamed_laws.study", description=__doc__)
    names = ["all", CLEAN, *LAWS]
    parser.add_argument("--law", action="append", choices=names, required=True)
    parser.add_argument("--seeds", type=int, default=3, help="the first so many")
    parser.add_argument("--first", type=int, default=1, help="seed")
    parser.add_argument("--encoder", action="append", choices=list(ENCODERS), required=True)
    parser.add_argument("--out", type=Path, required=True, help="folder that keeps the machines")
    parser.add_argument("--learn", action="store_true", help="what a learned law takes")
    parser.add_argument("--discover", action="store_true", help="equations that are proposed")
    options = parser.parse_args(arguments)
    asked = [what_is_learned] * options.learn + [what_is_proposed] * options.discover_equations
    laws = list(LAWS) if "all" in options.law else options.law
    for law in laws:
        for seed in range(options.first, options.first + options.seeds):
            for encoder in options.encoder:
                if not asked:
                    print(line(law, seed, encoder, options.out), flush=True)
                for tell in asked:
                    print(tell(machine(law, seed, encoder, options.out)), flush=True)


def line(law: str, seed: int, encoder: str, folder: Path) -> str:
    """Errors on held-out motion by joint."""
    plant = machine(law, seed, encoder, folder)
    result = errors(plant)
    parts = [
        f"{'*' if plant.joint == str(j + 1) else ''}{j + 1}: {before:.2f} -> {after:.2f} %"
        for j, (before, after) in enumerate(zip(result.without, result.with_form, strict=True))
    ]
    taken = "" if plant.truth is None else f"  takes {100 * result.taken[plant.truth.joint]:.0f} %"
    return f"{plant.name}{taken}  [{',  '.join(parts)}]"


if __name__ == "__main__":
    main()
