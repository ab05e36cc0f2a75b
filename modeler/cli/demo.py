"""`modeler demo`: a hidden effect is found and added, on an arm and on a robot with loops."""

import argparse
from dataclasses import dataclass
from pathlib import Path

from modeler.api.fitting import fit
from modeler.api.workflow import compile_model, derive, generate, load, observe, read_logs
from modeler.cli.compare import judged
from modeler.cli.console import Json, progress, say, say_lines, working
from modeler.cli.improve import waterfall
from modeler.diagnosis import Diagnosis, Logs, add_findings, diagnose, lines
from modeler.estimation import IdentifiedModel, save_model
from modeler.report import (
    additions_page,
    all_pictures,
    comparison_page,
    diagnosis_page,
    page as pages,
    write_files,
)
from modeler.runtime import CompiledModel
from modeler.simulation import HiddenEffect, SimulationSettings, check_settings, simulate, write_log
from modeler.validation import verdict

_RUNS = (("train", 1), ("held_out", 2))


@dataclass(frozen=True)
class Story:
    """A built-in robot, and what its simulated machine has that the robot file lacks."""

    robot: str
    hidden: HiddenEffect
    noise: float


_STORIES = (
    Story("demo-arm", HiddenEffect("load_friction", "2"), 0.01),
    Story("orthoglide-2003", HiddenEffect("passive_friction", "31", {"Fv": 0.3, "Fs": 1.0}), 0.005),
)


def run_demo(args: argparse.Namespace) -> Json:
    """Runs both stories."""
    check_settings(SimulationSettings(duration=args.duration), ())  # before anything is written
    told = {story.robot: _told(story, Path(args.out) / story.robot, args) for story in _STORIES}
    if (index := pages.write_index(Path(args.out), "modeler demo")) is not None:
        say(f"all pages: {index}")
    return told


def _told(story: Story, out: Path, args: argparse.Namespace) -> Json:
    robot = load(story.robot)
    say(f"{robot.title}\n{'=' * len(robot.title)}")
    say(f"1. derive and emit C into {out / 'c'}")
    with working("deriving"):
        derivation = derive(robot)
        emitted = generate(derivation, out / "c", args.force)
        compiled = compile_model(emitted)
    kinds = ", ".join(f"{count} {kind}" for kind, count in derivation.base.counts().items())
    say(f"   {derivation.base.rank} base parameters ({kinds}), proof: {derivation.base.proof.kind}")
    say(f"2. simulate two runs of {args.duration:g} s; the machine has something the file lacks")
    for name, seed in _RUNS:
        settings = SimulationSettings(
            duration=args.duration, seed=seed, torque_noise=story.noise, hidden=(story.hidden,)
        )
        with progress(f"simulating {name}") as report:
            write_log(out / f"{name}.parquet", simulate(load(story.robot), settings, report))
    train, held_out = (out / f"{name}.parquet" for name, _ in _RUNS)
    say(f"3. fit to {train.name}, compare with {held_out.name}")
    with working("fitting"):
        model = fit(derivation, emitted, observe(compiled, [train]))
    save_model(out / "model.json", model)
    _compared(model, compiled, out, held_out)
    say("4. diagnose: which effect is missing?")
    logs = Logs(read_logs(compiled, [train]), read_logs(compiled, [held_out]))
    with progress("looking for missing effects") as bar:
        found = diagnose(model, compiled, logs.fitted, logs.held_out, progress=bar)
    say_lines(lines(found), "   ")
    place = str(out / "model.json")
    following = pages.after_diagnosis(place, [str(train)], [str(held_out)], found)
    origin = pages.Origin(place, [train.name, held_out.name], True, following)
    pages.write_page(out / "diagnosis.html", diagnosis_page(found, (), origin))
    better = _improved(model, compiled, found, logs, out)
    say(f"   the truth: {story.hidden.effect} on joint {story.hidden.joint}\n")
    say(f"open {out / 'diagnosis.html'} and {out / 'improved.html'} in a browser\n")
    return found.to_json() | {"waterfall": [step.to_json() for step in better.history]}


def _compared(model: IdentifiedModel, compiled: CompiledModel, out: Path, log: Path) -> None:
    with working("predicting"):
        comparison, provenance, _ = judged(model, [str(log)], compiled)
    say_lines([*comparison.summary().splitlines(), *verdict(comparison)], "   ")
    with working("drawing the page"):
        place, fitted = str(out / "model.json"), [str(out / "train.parquet")]
        following = pages.after_compare(place, fitted, [str(log)], held_out=True)
        origin = pages.Origin(place, comparison.prediction.logs, True, [following])
        pages.write_page(out / "compare.html", comparison_page(comparison, provenance, origin))
    with progress("drawing pictures") as bar:
        write_files(out / "pictures", all_pictures(comparison), bar)


def _improved(
    model: IdentifiedModel, compiled: CompiledModel, found: Diagnosis, logs: Logs, out: Path
) -> IdentifiedModel:
    say("5. add it: new robot file, new C, new fit")
    with working("adding what is missing"):
        better, left_out = add_findings(model, compiled, found.effects, logs)
    save_model(out / "improved.json", better)
    say_lines([*waterfall(better), *left_out], "   ")
    if better.history:
        held = better.history[-1].held_out
        place, train = str(out / "improved.json"), str(out / "train.parquet")
        others = [str(out / name) for name in held]
        origin = pages.Origin(
            place, held, True, pages.after_add(place, [train], others, better.fit)
        )
        pages.write_page(out / "improved.html", additions_page(better, left_out, origin))
    return better
