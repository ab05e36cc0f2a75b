"""`modeler demo`: the whole chain on a built-in robot."""

import argparse
from pathlib import Path

import numpy as np

from modeler.api import Derivation, compile_model, derive, fit, generate, load, observe
from modeler.base import grouping_matrix
from modeler.base.render import as_text
from modeler.cli.console import Json, progress, say, working
from modeler.cli.fit import judged
from modeler.cli.options import add_number
from modeler.compare import verdict, write_pictures, write_report
from modeler.fit import IdentifiedModel, save_model
from modeler.robot import Robot
from modeler.simulate import SimulatedLog, SimulationSettings, simulate, write_log

_ROBOT = "demo-arm"
_RUNS = (("train1", 1), ("train2", 2), ("held_out", 3))


def add_demo(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """`modeler demo`."""
    parser = commands.add_parser(
        "demo",
        help="the whole chain on a built-in robot",
        description=f"Derives {_ROBOT}, generates and compiles its C, simulates measurements in "
        "closed loop, fits the base parameters, and compares the prediction with a motion that the "
        "fit has not seen.",
        epilog="example: modeler demo --out demo",
    )
    parser.add_argument("--out", metavar="DIR", default="demo", help="folder (default %(default)s)")
    add_number(parser, "--duration", "S", float, "seconds of each simulated run", default=20.0)
    parser.add_argument("--json", metavar="FILE", help="write the comparison for machines")
    parser.set_defaults(run=run_demo)


def run_demo(args: argparse.Namespace) -> Json:
    """Runs the chain and says what was found, step by step."""
    out = Path(args.out)
    robot = load(_ROBOT)
    say(f"1. derive: {robot.title}")
    with working("deriving"):
        derivation = derive(robot)
    say(as_text(derivation.base))
    say(f"\n2. generate: C in {out / 'c'}")
    emitted = generate(derivation, out / "c")
    compiled = compile_model(emitted)
    say(f"\n3. simulate: {len(_RUNS)} runs of {args.duration:g} s in closed loop")
    logs = [_simulated(robot, out, name, seed, args.duration) for name, seed in _RUNS]
    say("\n4. fit: " + ", ".join(f"{name}.parquet" for name, _ in _RUNS[:2]))
    observation = observe(compiled, [out / f"{name}.parquet" for name, _ in _RUNS[:2]])
    model = fit(derivation, emitted, observation)
    save_model(out / "model.json", model)
    for line in _fitted_against_truth(derivation, model, logs[0]):
        say(line)
    held_out = out / f"{_RUNS[-1][0]}.parquet"
    say(f"\n5. compare: {held_out.name}, which the fit has not seen")
    comparison, lines = judged(model, [str(held_out)], compiled)
    say(comparison.summary())
    for sentence in verdict(comparison):
        say(sentence)
    page = write_report(out / "compare.html", comparison, lines)
    write_pictures(out / "pictures", comparison)
    say(f"\nopen {page} in a browser; pictures are in {out / 'pictures'}")
    return comparison.as_dict()


def _simulated(robot: Robot, out: Path, name: str, seed: int, duration: float) -> SimulatedLog:
    with progress(f"simulating {name}") as report:
        log = simulate(robot, SimulationSettings(duration=duration, seed=seed), report)
    write_log(out / f"{name}.parquet", log)
    return log


def _fitted_against_truth(
    derivation: Derivation, model: IdentifiedModel, log: SimulatedLog
) -> list[str]:
    """The fitted base parameters beside the true ones: beta = K chi."""
    chi = np.array([log.truth.parameters[name] for name in derivation.model.names])
    beta = grouping_matrix(derivation.model, derivation.base) @ chi
    lines = [f"{'parameter':<10} {'fitted':>11} {'true':>11} {'sigma':>9}  unit"]
    for estimate, true in zip(model.fit.parameters, beta, strict=True):
        sigma = "-" if estimate.sigma is None else f"{estimate.sigma:.2g}"
        lines.append(
            f"{estimate.name:<10} {estimate.value:>11.5g} {true:>11.5g} {sigma:>9}  {estimate.unit}"
        )
    lines.append(f"relative error {100 * model.fit.relative_error:.2f} %")
    return lines
