"""Briot and Gautier 2012, section 3: drive gains from a bare run and a weighed load.

The simulated Orthoglide has the drive gains, slides and motors of the paper's Table 3, light bars,
a platform of 0.75 kg, and no friction where it has no motor: 41 base parameters, none left out.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from modeler.codegen import derive, generate
from modeler.core.choices import read_builtin_robot
from modeler.core.figure import BLACK, ORANGE, SKY, Curve, Panel, Picture, Style
from modeler.core.table import format_percent
from modeler.estimation import GainFit, Payload, identify_gains, identify_with_payloads
from modeler.papers import methods
from modeler.papers.methods import MethodRow, MethodTable, Outcome, judge_outcome, read_quotation
from modeler.papers.paper import Paper
from modeler.regression import Log, observe
from modeler.robot import Limits, Robot, parse_robot_text, replace_drive_gains
from modeler.runtime import CompiledModel, load_cached_model
from modeler.simulation import SimulatedLog, SimulationSettings, parse_hidden_effect, simulate

ROBOT = "orthoglide-2012"
SECONDS, RATE, NOISE = 15.0, 400.0, 0.02
LIMITS = Limits(0.02, 0.32, 0.8, 8.0)
JOINTS = ("11", "12", "13")
SHOWN = 5.0  # s, of figure 3
FELT = 2.0
"""Times what the model of the loaded robot leaves, that the model without the load leaves."""
BAR, SLIDE, PLATFORM = 0.2, 1.0, 0.75
"""kg: a bar with its centre in the middle, a slide of legs 1 and 2, the platform."""

SETTING = (
    "simulated: gains, slides and motors of Table 3; bars of 0.2 kg, a platform of 0.75 kg;",
    "moves between random points, 15 s at 2.5 ms, encoders of 1 um, currents with 2 % noise",
)


def reproduce_briot(paper: Paper, report: Callable[[float], None]) -> list[MethodTable]:
    """Reproduces gains, slides and motors of Table 3, and the second load by both sets of gains."""
    table = methods.read_table(paper, "Table 3")
    gains = {f"1{k}": table[f"gtau{k}"][0] for k in "123"}
    (maker,) = read_quotation(paper, "637pi")[1:]
    mass = read_quotation(paper, "M7 = 1.983kg")[0]
    second = read_quotation(paper, "a second payload")[0]
    # The motors' effects only, and gains of 1: logs in drive units.
    pattern = r"^(rotor_inertia|viscous|coulomb) = .*$"
    text = re.sub(pattern, r'\1 = ["1{i}"]', read_builtin_robot(ROBOT), flags=re.M)
    robot = parse_robot_text(replace_drive_gains(text, dict.fromkeys(JOINTS, 1.0)), ROBOT)
    derivation = derive(robot)
    compiled = load_cached_model(generate(derivation))
    machine = _build_machine(robot, table, [c.name for c in derivation.base.columns])
    runs = []
    for seed, load in enumerate((0.0, mass, second), 1):
        settings = SimulationSettings(
            duration=SECONDS,
            rate=RATE,
            seed=seed,
            torque_noise=0.0,
            linear_resolution=1e-6,
            motion="point-to-point",
            limits=dict.fromkeys(JOINTS, LIMITS),
            hidden=(parse_hidden_effect(f"payload:mass={load}"),) if load else (),
        )
        runs.append(simulate(machine, settings))
        report(seed / 3)
    rng = np.random.default_rng(2012)
    bare, loaded, other = (_simulate_currents(run, gains, rng) for run in runs)
    known = Payload((loaded.name,), mass=mass)
    gain_fit = identify_gains(
        compiled, observe(compiled, [bare, loaded], is_compared=False), [known]
    )
    both = (dict.fromkeys(JOINTS, maker), gain_fit.gains)
    cases = [_weigh_load(compiled, bare, other, each) for each in both]
    figure = _build_figure_3(compiled, gain_fit, loaded, mass)
    return [_build_table_3(table, gain_fit), figure, _build_second_load_table(paper, cases)]


def _build_machine(robot: Robot, table: Mapping[str, tuple[float, ...]], names: list[str]) -> Robot:
    """Slides and motors such that M11R, M12R, M13R and Ia13 are those of Table 3.

    M1iR is Ia1i + M1i + M3i - MX3i/d4, and for leg 1, which carries the platform, besides
    M6 + MX31/d4 + MX32/d4 + MX33/d4; a bar's MX3i/d4 is half its mass.
    """
    values = dict.fromkeys(names, 0.0)
    half, d4 = BAR / 2, 0.31
    slides = {"1": SLIDE, "2": SLIDE, "3": table["M13R"][0] - half}
    rotors = {
        "1": table["M11R"][0] - SLIDE - 2 * BAR - PLATFORM,
        "2": table["M12R"][0] - SLIDE - half,
        "3": table["Ia13"][0],
    }
    values["M6"] = PLATFORM
    for leg in "123":
        values |= {f"Ia1{leg}": rotors[leg], f"M1{leg}": slides[leg], f"M3{leg}": BAR}
        values |= {f"{name}1{leg}": table[f"{name}1{leg}"][0] for name in ("Fv", "Fs")}
        values |= {f"MX3{leg}": half * d4, f"YY3{leg}": BAR * d4**2 / 3}
        values[f"ZZ3{leg}"] = BAR * d4**2 / 3
    return replace(robot, parameters=values)


def _simulate_currents(
    run: SimulatedLog, gains: Mapping[str, float], rng: np.random.Generator
) -> Log:
    """What is logged: torque over gain, with noise."""
    tau = run.tau[:, [run.joints.index(joint) for joint in JOINTS]]
    tau = tau + NOISE * np.sqrt(np.mean(tau**2, axis=0)) * rng.normal(size=tau.shape)
    return methods.build_log(
        run, JOINTS, tau / np.array([gains[j] for j in JOINTS]), "current{} x 1"
    )


def _weigh_load(
    compiled: CompiledModel, bare: Log, loaded: Log, gains: Mapping[str, float]
) -> tuple[float, float]:
    """Mass of the load of `loaded`, kg, and its sigma, with these gains."""
    scale = np.array([gains[joint] for joint in JOINTS])
    logs = [replace(log, tau=log.tau * scale) for log in (bare, loaded)]
    fit = identify_with_payloads(
        compiled, observe(compiled, logs, is_compared=False), [Payload((loaded.name,))]
    )
    (mass,) = fit.loads
    return mass.value, mass.sigma or 0.0


def _build_table_3(table: Mapping[str, tuple[float, ...]], gain_fit: GainFit) -> MethodTable:
    rows = []
    for word, values in table.items():
        name = word.replace("gtau", "g_tau1")
        for p in (*gain_fit.result.gains, *gain_fit.result.parameters):
            if p.name == name and (p.name[0] == "g" or p.name[:-1] in _SET):
                printed = f"{values[0]:.5g} ({values[-1]:.3g} %)"
                rows.append(
                    methods.judge_recovery(word, printed, values[0], p.value, p.sigma or 0.0)
                )
    last = gain_fit.result.singular_values[-2:]
    why = "singular values of the currents beside the model: a gap, or no gains"
    outcome = judge_outcome(last[0] > 2 * last[1], Outcome.DERIVED)
    rows.append(MethodRow("s[-2]/s[-1]", "-", f"{last[0] / last[1]:.4g}", outcome, why))
    return MethodTable("Table 3: drive gains, slides and motors", SETTING, tuple(rows))


def _build_figure_3(
    compiled: CompiledModel, gain_fit: GainFit, log: Log, mass: float
) -> MethodTable:
    """Efforts of the loaded run by the gains that were found, rebuilt with the load and without."""
    tau = log.tau * np.array([gain_fit.gains[joint] for joint in JOINTS])
    observation = observe(compiled, [replace(log, tau=tau)])
    load = compiled.base_parameters([mass * (p.name == "M6") for p in compiled.spec.standard])
    used, measured = observation.used, observation.torque

    def compute_efforts(beta: np.ndarray) -> np.ndarray:
        return observation.filter_columns(
            lambda s, w: compiled.inverse_dynamics(s.q[w], s.qd[w], s.qdd[w], beta)[:, :, None]
        )[:, :, 0]

    beta = gain_fit.result.beta
    efforts = {"computed with the load": compute_efforts(beta + load)}
    efforts |= {"computed without it": compute_efforts(beta), "measured": measured}
    size = np.linalg.norm(np.where(used, measured, 0.0), axis=0)
    models = list(efforts.values())[:2]
    left = (np.linalg.norm(np.where(used, measured - x, 0.0), axis=0) for x in models)
    loaded, bare = (each / size for each in left)
    why, rows = f"{FELT:g} times as much without", []
    for joint, a, b in zip(JOINTS, loaded, bare, strict=True):
        text = f"{format_percent(a)}; without load {format_percent(b)}"
        outcome = judge_outcome(FELT * a < b, Outcome.HOLDS)
        rows.append(MethodRow(f"motor {joint}", '"well simulated"', text, outcome, why))
    shown = observation.time < SHOWN
    panels = []
    for j, joint in enumerate(JOINTS):
        curves = zip(efforts, efforts.values(), _STYLES, strict=True)
        parts = (Curve(n, observation.time[shown], x[shown, j], style) for n, x, style in curves)
        panels.append((Panel(f"Motor {joint}", "time, s", "force, N", tuple(parts)),))
    title = f"Figure 3: efforts with the load of {mass:g} kg, what the model leaves"
    drawn = f"Figure 3 of the simulated Orthoglide: efforts with the load of {mass:g} kg"
    picture = Picture("figure_3", drawn, _CAPTION, tuple(panels), 600, shared_time=True)
    return MethodTable(title, SETTING[1:], tuple(rows), picture)


_STYLES = (Style(SKY, 2.6), Style(ORANGE, 1.0), Style(BLACK, 0.6))
_CAPTION = (
    "Black: measured currents times the gains that were found. Broad and blue: computed with the "
    "load of known mass in the model. Orange: computed without it."
)
_SET = ("M11", "M12", "M13", "Ia1", "Fv1", "Fs1")
"""What the simulated machine has of Table 3, the last letter left out."""


def _build_second_load_table(paper: Paper, cases: list[tuple[float, float]]) -> MethodTable:
    load, *printed, width = read_quotation(paper, "a second payload")[:4]
    rows = [MethodRow("weighed", f"{load:g} kg", f"{load:g} kg", Outcome.SHOWN)]
    names = ("case 1: the maker's gains", "case 2: the identified gains")
    why = f"within {width:g} kg, the paper's 2 sigma"
    for which, theirs, (ours, sigma) in zip(names, printed, cases, strict=True):
        mass_text = f"{ours:.4f} +- {sigma:.2g} kg"
        outcome = judge_outcome(abs(ours - theirs) <= width)
        rows.append(MethodRow(which, f"{theirs:g} kg", mass_text, outcome, why))
    return MethodTable("The second load, weighed by the robot", SETTING[:1], tuple(rows))
