"""Houda et al., section 4: the energy model of Evr@, beside the torque model of the same data.

The simulated machine has the masses and the friction of the paper's Table 1 and of its axis B4P4,
read in N s/m; friction of the other axes is that of B4P4 without its directions.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from modeler.codegen import derive, generate
from modeler.core.choices import read_builtin_robot
from modeler.estimation import FitResult, compute_friction_by_direction, identify, identify_energy
from modeler.papers import methods
from modeler.papers.methods import MethodRow, MethodTable, Outcome, read_quotation
from modeler.papers.paper import Paper
from modeler.regression import Log, observe
from modeler.robot import Robot, parse_robot_text
from modeler.runtime import CompiledModel, load_cached_model
from modeler.simulation import SimulatedLog, SimulationSettings, simulate

RUNS, SECONDS, RATE, NOISE = 6, 10.0, 204.0, 0.02
FRICTION = ("Fv{}+", "Fs{}+", "Fv{}-", "Fs{}-")
RAM = 0.25  # kg, of the third link of a leg
LEG = "34"
"""Our name of the motor of axis B4P4."""

SETTING = (
    "simulated: masses and friction of the paper, viscous friction in N s/m;",
    "six motions of 10 s at 204 Hz, encoders of 1 um, 2 % torque noise",
)


def reproduce_houda(paper: Paper, report: Callable[[float], None]) -> list[MethodTable]:
    """Reproduces masses and friction by direction from both models, and their sigmas."""
    first, second = read_quotation(paper, "First"), read_quotation(paper, "Second")
    axis = read_quotation(paper, "Fs1 = 1,39")
    fs1, fv1, fs2, fv2 = axis
    friction = {"s1": first[1:], "s2": second[1:], LEG: (fv1, fs1, fv2, fs2)}
    (platform,) = read_quotation(paper, "MRp")
    truth = {"Ms1": first[0], "Ms2R": second[0], "MPR": platform}
    for joint, values in friction.items():
        truth |= dict(zip((n.format(joint) for n in FRICTION), values, strict=True))
    machine = _build_machine(truth, friction)
    robot = parse_robot_text(_write_robot_text(both_ways=True), "evra")
    compiled = load_cached_model(generate(derive(robot)))
    runs = []
    for seed in range(RUNS):
        settings = SimulationSettings(
            duration=SECONDS, rate=RATE, seed=seed, torque_noise=0.0, linear_resolution=1e-6
        )
        runs.append(simulate(machine, settings))
        report((seed + 1) / (RUNS + 1))
    rng = np.random.default_rng(90)
    observation = observe(compiled, [_simulate_log(compiled, run, friction, rng) for run in runs])
    torque, energy = identify(observation), identify_energy(compiled, observation).result
    return [
        _build_value_table(f"Table 1 and axis B4P4, {name} model", truth, compiled, fit)
        for name, fit in (("torque", torque), ("energy", energy))
    ] + [_build_comparison_table(energy)]


def _write_robot_text(both_ways: bool) -> str:
    effects = ["viscous", "coulomb", "offset"] + ["asymmetric_viscous"] * both_ways
    return read_builtin_robot("evra") + "\n[effects]\n" + "\n".join(f'{e} = "all"' for e in effects)


def _build_machine(truth: Mapping[str, float], friction: Mapping[str, tuple[float, ...]]) -> Robot:
    """Slides, platform and legs such that Ms1, Ms2R and MPR are those of the paper.

    Ms2R carries the two lower links of each leg, MPR the third.
    """
    robot = parse_robot_text(_write_robot_text(both_ways=False), "evra")
    values = dict(robot.parameters)
    legs = "123456"
    values["Ms1"] = truth["Ms1"]
    values["Ms2"] = truth["Ms2R"] - sum(values[f"M{k}{leg}"] for k in "12" for leg in legs)
    for leg in legs:
        lighter = RAM / values[f"M3{leg}"]
        values |= {f"{n}3{leg}": values[f"{n}3{leg}"] * lighter for n in ("M", "MZ", "XX", "YY")}
    values["MP"] = truth["MPR"] - 6 * RAM
    for joint in ("s1", "s2", *(f"3{leg}" for leg in legs)):
        there, level, back, back_level = friction.get(joint, friction[LEG])
        values[f"Fv{joint}"] = (there + back) / 2
        values[f"Fs{joint}"] = (level + back_level) / 2
        values[f"Off{joint}"] = (level - back_level) / 2 if joint in friction else 0.0
    return replace(robot, parameters=values)


def _simulate_log(
    compiled: CompiledModel,
    run: SimulatedLog,
    friction: Mapping[str, tuple[float, ...]],
    rng: np.random.Generator,
) -> Log:
    """What is logged; the part Fva |qd| of friction, which the simulator leaves out, put in."""
    joints = tuple(joint.name for joint in compiled.spec.joints)
    tau = run.tau[:, [run.joints.index(joint) for joint in joints]].copy()
    for joint, (there, _, back, _) in friction.items():
        speed = run.truth.qd[:, run.joints.index(joint)]
        tau[:, joints.index(joint)] += (there - back) / 2 * np.abs(speed)
    tau += NOISE * np.sqrt(np.mean(tau**2, axis=0)) * rng.normal(size=tau.shape)
    return methods.build_log(run, joints, tau)


def _build_value_table(
    title: str, truth: Mapping[str, float], compiled: CompiledModel, fit: FitResult
) -> MethodTable:
    estimates = {p.name: (p.value, p.sigma or 0.0) for p in fit.parameters}
    friction = compute_friction_by_direction(compiled.spec, fit)
    estimates |= {d.name: (d.value, d.sigma) for d in friction}
    rows = [
        methods.judge_recovery(n, f"{value:g}", value, *estimates[n]) for n, value in truth.items()
    ]
    return MethodTable(title, SETTING, tuple(rows))


def _build_comparison_table(energy: FitResult) -> MethodTable:
    """What the paper does not print: both models on the same data."""
    assert energy.energy is not None, "identify_energy compares"
    rows = []
    torque, simpson, trapezoid = energy.energy.figures
    for model in (torque, simpson, trapezoid):
        text = (
            f"condition {model.condition_scaled:.4g}, {model.precise_count} parameters below 10 %"
        )
        rows.append(MethodRow(model.model, "-", f"{model.rows} rows, {text}", Outcome.SHOWN))
    ratio = simpson.torque_sigma / torque.torque_sigma
    what = "uncertainty of predicted torques, energy over torque"
    why = "our consequence: at equal data the torque model is the surer"
    outcome = methods.judge_outcome(ratio > 1.0, Outcome.DERIVED)
    rows.append(MethodRow(what, "-", f"{ratio:.3g}", outcome, why))
    return MethodTable("The energy model beside the torque model", (), tuple(rows))
