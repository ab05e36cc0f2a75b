"""Hanssen, Hovland and Brogardh 2000, section 5: J11 of the wrist in two steps, and what follows.

The simulated wrist has the J11 of the paper's eq. (3); its other parameters are made up. Joint 1
moves alone at configurations of joints 2 and 3 (step 1), and P = pinv(Phi) J11 (step 2), with the
rows of eq. (2).
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from modeler import formulas
from modeler.codegen import Derivation, derive, generate
from modeler.core.choices import read_builtin_robot
from modeler.core.expression import parse_expression
from modeler.core.figure import BLUE, GREEN, GREY, VERMILLION, Curve, Panel, Picture, Style
from modeler.core.table import format_percent
from modeler.estimation import JointDirections, TwoStepFit, identify_in_two_steps
from modeler.papers import methods
from modeler.papers.methods import MethodRow, MethodTable, Outcome, judge_outcome, read_quotation
from modeler.papers.paper import Paper
from modeler.regression import observe
from modeler.robot import Limits, Robot, compute_joint_directions, parse_robot_text
from modeler.runtime import CompiledModel, load_cached_model
from modeler.simulation import Reference, SimulationSettings, simulate

SECONDS, RATE, BANDWIDTH, NOISE = 240.0, 400.0, 60.0, 0.02
SEED = 11
"""Of the configurations: of 60, the one with the best Phi; the paper chose its paths so too."""
LIMITS = Limits(-1.4, 1.4, 4.0, 25.0)
COULOMB = {"Fs1": 3.0, "Fs2": 2.0, "Fs3": 1.2}
KNOWN = ("am", "bm", "bl1", "bt2", "ct1", "bJ33", "cJ33")
"""What section 4 takes as known."""

FOLLOW = 6
"""Parameters that follow from these alone; the others need an eighth."""

SETTING = (
    "simulated: a wrist with the J11 of eq. (3), the rest made up; Coulomb friction;",
    "one joint at a time for 240 s at 400 Hz, 2 % torque noise",
)


def reproduce_hanssen(paper: Paper, report: Callable[[float], None]) -> list[MethodTable]:
    """Reproduces J11 in two steps, the singular values of Phi, and which parameters follow."""
    names = tuple(f"PJ{k}" for k in range(1, 8))
    truth = dict(zip(names, read_quotation(paper, "J11 = 0.0398")[-7:], strict=True))
    text = read_builtin_robot("wrist") + '\n[effects]\ncoulomb = "all"\n'
    robot = parse_robot_text(text, "wrist")
    derivation = derive(robot)
    compiled = load_cached_model(generate(derivation))
    settings = SimulationSettings(
        duration=SECONDS,
        rate=RATE,
        seed=SEED,
        bandwidth=BANDWIDTH,
        torque_noise=NOISE,
        motion="one-joint",
        limits=dict.fromkeys("123", LIMITS),
    )
    run = simulate(_build_machine(robot, derivation, truth), settings)
    report(0.5)
    observation = observe(compiled, [methods.build_log(run, run.joints, run.tau)])
    directions = JointDirections(compute_joint_directions(robot))
    steps = identify_in_two_steps(compiled, observation, directions)
    monomials = next(line.quote for line in paper.lines if line.check == "monomials").split(";")
    tables = [*_build_inertia_tables(paper, truth, steps, monomials), _build_one_step_table(steps)]
    tables.append(_build_figure_2(_build_machine(robot, derivation, truth), compiled, steps))
    report(0.8)
    tables.append(_build_known_table(paper, derivation))
    return tables


def _build_machine(robot: Robot, derivation: Derivation, truth: Mapping[str, float]) -> Robot:
    """Links whose J11 has these coefficients; body 3 carries PJ1, PJ2, PJ4, PJ5.

    PJ1 = YY3 - XX3, PJ2 = -2 XY3, PJ4 = -2 YZ3 + 2 bl1 MY3, PJ5 = 2 XZ3 - 2 bl1 MX3,
    PJ3 = XX2R - PJ1 - ZZ3, PJ6 = 2 XY2, PJ7 = ZZ1 + YY2 + ZZ3; MX3 = MY3 = 0.
    """
    values = dict.fromkeys((column.name for column in derivation.base.columns), 0.0)
    bl1 = robot.symbols["bl1"].evaluate()
    values |= {"M1": 12.0, "MX1": -0.36, "MY1": -0.24, "M2": 6.0, "MX2": -0.12, "MZ2": 0.06}
    values |= {"M3": 4.0, "MZ3": 0.24, "YY3": 0.3, "ZZ3": 0.3, "YY2": 0.08, "ZZ2": 0.08}
    values["XX3"] = values["YY3"] - truth["PJ1"]
    values |= {"XY3": -truth["PJ2"] / 2, "YZ3": -truth["PJ4"] / 2, "XZ3": truth["PJ5"] / 2}
    carried = values["YY3"] + 2 * bl1 * values["MZ3"] + bl1**2 * values["M3"]
    values["XX2"] = truth["PJ3"] + truth["PJ1"] + values["ZZ3"] + values["YY2"] - carried
    values["XY2"] = truth["PJ6"] / 2
    values["ZZ1"] = truth["PJ7"] - values["YY2"] - values["ZZ3"]
    values |= {"XX1": 0.3, "YY1": 0.3}
    return replace(robot, parameters=values | COULOMB)


def _build_inertia_tables(
    paper: Paper, truth: Mapping[str, float], steps: TwoStepFit, monomials: list[str]
) -> list[MethodTable]:
    """P = pinv(Phi) J11 with rows as sure as step 1 is of them."""
    moved = [c for c in steps.steps.configurations if c.joint == 0]
    inertia, sigma = np.array([c.compute_coefficients(0)[0][1:] for c in moved]).T
    texts = (text.strip().replace("^", "**").replace(" ", "*") for text in monomials)
    functions = [parse_expression(text) for text in texts]
    phi = np.array([[f.evaluate(_compute_trigonometry(c.pose)) for f in functions] for c in moved])
    inverse = np.linalg.pinv(phi / sigma[:, None])
    values, deviations = inverse @ (inertia / sigma), np.linalg.norm(inverse, axis=1)
    triples = zip(truth.items(), values.tolist(), deviations.tolist(), strict=True)
    rows = [
        methods.judge_recovery(n, f"{x:g}", x, value, sigma) for (n, x), value, sigma in triples
    ]
    printed, ours = read_quotation(paper, "3.63")[:7], np.linalg.svd(phi, compute_uv=False)
    title = f"Eq. (3): J11 from {len(moved)} configurations"
    table = _build_singular_values_table(printed, ours)
    return [MethodTable(title, SETTING, tuple(rows)), table]


def _compute_trigonometry(pose: np.ndarray) -> dict[str, float]:
    sines = {f"s{k + 1}": float(np.sin(angle)) for k, angle in enumerate(pose)}
    return sines | {f"c{k + 1}": float(np.cos(angle)) for k, angle in enumerate(pose)}


def _build_singular_values_table(printed: tuple[float, ...], ours: np.ndarray) -> MethodTable:
    theirs, computed = (" ".join(f"{value:.2f}" for value in row) for row in (printed, ours))
    first, second = (f"{row[-1] / row[0]:.3f}" for row in (printed, ours))
    rank, why = int(np.sum(ours > 1e-8 * ours[0])), "the paper asks for about 0.1"
    rows = (
        MethodRow("singular values", theirs, computed, Outcome.SHOWN, "of other configurations"),
        MethodRow("last over first", first, second, Outcome.SHOWN, why),
        MethodRow("rank of Phi", f"{len(printed)}", f"{rank}", judge_outcome(len(printed) == rank)),
    )
    return MethodTable("Persistent excitation of J11", (), rows)


def _build_one_step_table(steps: TwoStepFit) -> MethodTable:
    """What the paper does not print: both ways on the same data."""
    two, one = steps.result, steps.one_step
    known = [sum(p.sigma is not None for p in fit.parameters) for fit in (two, one)]
    errors = [format_percent(fit.relative_error) for fit in (two, one)]
    text = "{} in two steps, {} in one"
    why = "joints that stand with dry friction show nothing of J12"
    rows = (
        MethodRow("parameters found", "-", text.format(*known), Outcome.SHOWN, why),
        MethodRow("relative error of the torques", "-", text.format(*errors), Outcome.SHOWN),
    )
    return MethodTable("Two steps beside one step", (), rows)


def _build_figure_2(machine: Robot, compiled: CompiledModel, steps: TwoStepFit) -> MethodTable:
    """A ramp of joint 1 at a configuration that no step has seen: measured and modelled torque."""
    settings = SimulationSettings(
        rate=RATE,
        seed=2,
        bandwidth=BANDWIDTH,
        torque_noise=NOISE,
        commanded=_build_ramp(),
        limits=dict.fromkeys("123", LIMITS),
    )
    run = simulate(machine, settings)
    beta = np.array([parameter.value for parameter in steps.result.parameters])
    (part,) = observe(compiled, [methods.build_log(run, run.joints, run.tau)]).stretches
    moved, known = part.segment, part.usable[:, 0]  # at rest dry friction is anything
    time, torque = moved.time, moved.tau[:, 0]
    model = (compiled.base_regressor(moved.q, moved.qd, moved.qdd) @ beta)[:, 0]
    exact = np.interp(time, run.time + 0.5 / RATE, run.truth.tau[:, 0])
    missed, noise, size = (float(np.std(x[known])) for x in (model - exact, torque - exact, exact))
    why = "less than the noise; joint 1 at a configuration that the fit has not seen"
    outcome = judge_outcome(missed < noise)
    rows = (
        MethodRow("noise of the measured torque", "-", format_percent(noise / size), Outcome.SHOWN),
        MethodRow("the model's error", "-", format_percent(missed / size), outcome, why),
    )
    left = (
        Curve("measured", time, torque, Style(GREY, 0.7)),
        Curve("modelled", time, np.where(known, model, np.nan), Style(BLUE)),
    )
    right = (
        Curve("position, rad", time, moved.q[:, 0], Style(BLUE)),
        Curve("velocity, rad/s", time, moved.qd[:, 0], Style(GREEN)),
        Curve("acceleration, rad/s2", time, moved.qdd[:, 0], Style(VERMILLION)),
    )
    panels = (
        Panel("Torque of axis 1", "time, s", "torque, N m", left),
        Panel("A ramp response in axis 1", "time, s", "rad, rad/s, rad/s2", right),
    )
    title = "Figure 2 of the simulated wrist: measured and modelled torque, and the motion"
    picture = Picture("figure_2", title, _CAPTION, (panels,), 400)
    return MethodTable("Figure 2: a ramp of axis 1", (), rows, picture)


_CAPTION = (
    "Left: torque of axis 1 as measured (grey, with noise) and by the model of the two-step fit "
    "(blue; none at rest, where dry friction is anything). Right: position, velocity and "
    "acceleration, filtered forwards and backwards."
)


def _build_ramp() -> Reference:
    """Joint 1 from -1 to 1 rad and back at 2 rad/s, its speed changing in half a second."""
    time, rise = np.arange(round(3.4 * RATE)) / RATE, 0.5
    motion = np.zeros((3, len(time), 3))
    motion[0] = (-1.0, 0.7, -0.5)
    for start, speed in ((0.1, 2.0), (1.1, -2.0), (1.7, -2.0), (2.7, 2.0)):
        s = np.clip((time - start) / rise, 0.0, 1.0)
        turn, after = 2 * np.pi * s, np.maximum(time - start - rise, 0.0)
        lag = (np.cos(turn) - 1) / (2 * np.pi) ** 2
        motion[0, :, 0] += speed * (rise * (s**2 / 2 + lag) + after)
        motion[1, :, 0] += speed * (s - np.sin(turn) / (2 * np.pi))
        motion[2, :, 0] += speed / rise * (1 - np.cos(turn))
    return Reference(time, *motion)


def _build_known_table(paper: Paper, derivation: Derivation) -> MethodTable:
    """Which physical parameters follow: the paper's claim, and the count of all choices."""
    system = formulas.build_physical_system(derivation.model, derivation.base, "coefficients")
    claim, rest = read_quotation(paper, "From these, 18")
    determined_parameters, _ = formulas.find_determined(system, KNOWN)
    what = "parameters that follow from " + ", ".join(KNOWN)
    why = "the statement is wrong: " + ", ".join(determined_parameters) + " alone"
    outcome = judge_outcome(len(determined_parameters) == FOLLOW, Outcome.DERIVED)
    rows = [MethodRow(what, f"{claim:g}", str(len(determined_parameters)), outcome, why)]
    for size, expected in ((int(rest), 0), (formulas.count_smallest_set(system), 61_879)):
        sets = formulas.find_known_sets(system, size)
        what = f"sets of {size} from which all others follow"
        outcome = judge_outcome(sets.count == expected, Outcome.DERIVED)
        counted = f"{sets.count} of {sets.candidate_count}"
        rows.append(MethodRow(what, "-", counted, outcome, "our consequence"))
    return MethodTable("Physical parameters that must be known", (), tuple(rows))
