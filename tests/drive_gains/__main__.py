"""Whether the sigmas of gains and parameters are true: `python -m tests.drive_gains [ROBOT]`.

Two runs, bare and loaded, are simulated once; torque noise is drawn anew for every seed. Printed is
z = (found - true) / sigma of each gain, and of all base parameters together: rms 1 and mean 0 are
perfect.
"""

import argparse
import sys

import numpy as np

from modeler.core.errors import DataError
from modeler.estimation.drive_gains import identify_gains
from tests.drive_gains.runs import runs_of


def main() -> int:
    """Print the table."""
    made = argparse.ArgumentParser("python -m tests.drive_gains", description=__doc__)
    made.add_argument("robot", nargs="?", default="demo-arm")
    for name, kind, default in (
        ("--mass", float, 2.0),
        ("--noise", float, 0.03),
        ("--seeds", int, 50),
        ("--duration", float, 20.0),
        ("--rate", float, 250.0),
    ):
        made.add_argument(name, type=kind, default=default, help="default: %(default)s")
    args = made.parse_args()
    runs = runs_of(args.robot, args.mass, args.duration, args.rate)
    names = [f"g_tau{joint.name}" for joint in runs.compiled.spec.joints if joint.actuated]
    z: dict[str, list[float]] = {name: [] for name in (*names, "parameters")}
    refused = 0
    for seed in range(args.seeds):
        seen = runs.seen(np.ones(len(runs.compiled.spec.joints)), args.noise, seed)
        try:
            fit = identify_gains(runs.compiled, seen, [runs.payload()]).result
        except DataError as error:
            refused += 1
            print(f"seed {seed}: {error}")
            continue
        for name, gain in zip(names, fit.gains, strict=True):
            z[name].append((gain.value - 1.0) / (gain.sigma or np.inf))
        pairs = zip(fit.parameters, runs.beta, strict=True)
        z["parameters"] += [(p.value - true) / p.sigma for p, true in pairs if p.sigma]
    print(
        f"{args.robot}: {args.seeds} seeds, {refused} refused, noise {args.noise:g} of the torque"
    )
    print(f"{'':<12} {'rms z':>6} {'mean z':>7}")
    for name, values in z.items() if refused < args.seeds else ():
        print(f"{name:<12} {np.sqrt(np.mean(np.square(values))):6.2f} {np.mean(values):7.2f}")
    return int(refused == args.seeds)


if __name__ == "__main__":
    sys.exit(main())
