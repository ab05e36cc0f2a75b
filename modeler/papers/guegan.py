"""Guegan, Khalil and Lemoine 2003, section 5: ten motions, least squares with 23 and 13 parameters.

The simulated Orthoglide is as the paper concludes: the values of its Table 3, links of the
parallelograms too light to be seen. 2.5 ms, encoders of 1 um, 10 % torque noise.
"""

import tempfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeler.codegen import derive, generate, load
from modeler.estimation import FitResult, identify
from modeler.papers.guegan_blocks import build_block_table
from modeler.papers.guegan_motion import build_motion_table
from modeler.papers.methods import (
    MethodRow,
    MethodTable,
    Outcome,
    judge_outcome,
    judge_recovery,
    read_quotation,
    read_table,
)
from modeler.papers.paper import Paper
from modeler.regression import Observation, observe, read_log
from modeler.robot import Limits, Robot
from modeler.runtime import CompiledModel, load_cached_model
from modeler.simulation import SimulationSettings, simulate, write_log

WHOLE, ROBOT = "orthoglide-2003", "orthoglide-2003-similar-legs"
RUNS, SECONDS, RATE, NOISE = 10, 4.0, 400.0, 0.1
LIMITS = Limits(0.02, 0.32, 0.8, 8.0)
WEAK = ("ZZ2R", "MX2", "XX3R", "MX4")
DIRECTION = {"ZZ2R": 0.62, "MX2": 1.0, "XX3R": -0.31, "MX4": -1.0}
BAD = 15.0
"""Percent, of the paper: "a parameter with sigma >= 15 is not good identified"."""
FALL = 10.0
SETTING = (
    "simulated: the values of Table 3, links of the parallelograms without mass;",
    "ten motions between random points, 4 s at 2.5 ms, encoders of 1 um, 10 % torque noise",
)
SLIDE = 0.8
"""kg, of the slide of leg 3: M1R3, which gravity makes a part of Off3."""

LETTERS = {
    "MRP": "MPR", "Ma1R1": "Ia11R", "Ma1R2": "Ia12R", "Ma13": "Ia13R", "Off1": "Off11",
    "Off2": "Off12", "Off3": "Off13R", "MX4R": "MX4",
}  # fmt: skip
"""Names of Tables 2 and 3 that are not ours with small letters."""


def reproduce_guegan(paper: Paper, report: Callable[[float], None]) -> list[MethodTable]:
    """Tables 2 and 3, the condition numbers, and the direction along which Table 2 is noise."""
    table_2, table_3 = (
        {
            LETTERS.get(word, word.replace("FV", "Fv").replace("FS", "Fs")): values
            for word, values in read_table(paper, place).items()
        }
        for place in ("Table 2", "Table 3")
    )
    truth = {name: values[0] for name, values in table_3.items()}
    each, derivation = (derive(load(name)) for name in (WHOLE, ROBOT))
    compiled = load_cached_model(generate(derivation))
    blocks = build_block_table((each, load_cached_model(generate(each))), (derivation, compiled))
    observation, exact = _simulate_logs(derivation.robot, truth, compiled, report)
    full, reduced = identify(observation), identify(_select_parameters(observation, truth))
    printed = [read_table(paper, f"{place}, condition number")["Condition"][0]
               for place in ("Table 2", "Table 3")]  # fmt: skip
    robot_limits, rows = derivation.robot.limits["11"], read_quotation(paper, "65814 x 23")[0]
    return [
        blocks,
        _build_all_parameters_table(table_2, truth, full),
        _build_weak_direction_table(table_2, observation.names, exact),
        _build_essential_table(table_3, full, reduced),
        _build_condition_table(printed, full, reduced),
        build_motion_table(compiled, robot_limits, rows, printed),
    ]


def _build_machine(robot: Robot, truth: Mapping[str, float]) -> Robot:
    """Slides and platform alone, with the values of Table 3."""
    parameters = {"MP": truth["MPR"]}
    for leg in "123":
        third = leg == "3"
        parameters |= {f"{name}1{leg}": truth[f"{name}1{leg}"] for name in ("Fv", "Fs")}
        parameters[f"M1{leg}"] = SLIDE
        parameters[f"Ia1{leg}"] = truth[f"Ia1{leg}R"] - SLIDE
        parameters[f"Off1{leg}"] = truth["Off13R"] + 9.81 * SLIDE if third else truth[f"Off1{leg}"]
    empty = {f"{row}{leg}": () for row in "23457" for leg in "123"}
    return replace(robot, shared=(), links={**robot.links, **empty}, parameters=parameters)


def _simulate_logs(
    robot: Robot,
    truth: Mapping[str, float],
    compiled: CompiledModel,
    report: Callable[[float], None],
) -> tuple[Observation, np.ndarray]:
    """What is measured on all motions, and the regressor along the motions as they were."""
    machine, logs, exact = _build_machine(robot, truth), [], []
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(RUNS):
            settings = SimulationSettings(
                duration=SECONDS, rate=RATE, seed=seed, torque_noise=NOISE, linear_resolution=1e-6,
                motion="point-to-point", limits={f"1{leg}": LIMITS for leg in "123"},
            )  # fmt: skip
            log = simulate(machine, settings)
            place = Path(folder) / f"run{seed}.parquet"
            write_log(place, log)
            logs.append(read_log(place, compiled.spec))
            exact.append(compiled.observation(log.truth.q, log.truth.qd, log.truth.qdd))
            report((seed + 1) / RUNS)
    return observe(compiled, logs), np.concatenate(exact)


def _select_parameters(observation: Observation, names: Mapping[str, float]) -> Observation:
    """The same rows with the columns of these parameters only."""
    columns = [i for i, name in enumerate(observation.names) if name in names]
    return replace(
        observation,
        regressor=lambda segment, window: observation.regressor(segment, window)[..., columns],
        names=tuple(observation.names[i] for i in columns),
        units=tuple(observation.units[i] for i in columns),
    )


def _build_all_parameters_table(
    printed: Mapping[str, tuple[float, ...]], truth: Mapping[str, float], full: FitResult
) -> MethodTable:
    """Table 2; the truth of what Table 3 leaves out is 0."""
    rows = _compare_parameters(printed, truth, full)
    theirs = [abs(printed[name][1]) for name in WEAK]
    ours = [p.relative_sigma_percent or 0.0 for p in full.parameters if p.name in WEAK]
    what, why = "%sigma of " + ", ".join(WEAK), f"{BAD:g} % and more: not well identified"
    outcome = judge_outcome(min(*theirs, *ours) >= BAD, Outcome.HOLDS)
    rows.append(MethodRow(what, _format_range(theirs), _format_range(ours), outcome, why))
    return MethodTable("Table 2: all base parameters", SETTING, tuple(rows))


def _compare_parameters(
    printed: Mapping[str, tuple[float, ...]], truth: Mapping[str, float], fit: FitResult
) -> list[MethodRow]:
    rows = []
    for p in fit.parameters:
        value, percent = printed[p.name]
        text = f"{value:.5g} ({abs(percent):.3g} %)"
        rows.append(judge_recovery(p.name, text, truth.get(p.name, 0.0), p.value, p.sigma or 0.0))
    return rows


def _format_range(values: list[float]) -> str:
    return f"{min(values):.3g} % to {max(values):.3g} %"


def _build_weak_direction_table(
    printed: Mapping[str, tuple[float, ...]], names: tuple[str, ...], exact: np.ndarray
) -> MethodTable:
    """The right singular vector of the smallest singular value: Table 2 is noise along it."""
    weakest = np.linalg.svd(exact, full_matrices=False)[2][-1]
    ours = {name: weakest[i] / weakest[names.index("MX2")] for i, name in enumerate(names)}
    theirs = {name: printed[name][0] / printed["MX2"][0] for name in WEAK}
    rows = [
        MethodRow(
            f"{name}/MX2", f"{theirs[name]:.3f}", f"{ours[name]:.3f}",
            judge_outcome(abs(theirs[name] - ours[name]) < 0.05),
            f"within 0.05; derived {DIRECTION[name]:.3g}",
        )
        for name in WEAK
        if name != "MX2"
    ]  # fmt: skip
    rest = max(abs(value) for name, value in ours.items() if name not in WEAK)
    outcome = judge_outcome(rest < 0.1, Outcome.DERIVED)
    rows.append(MethodRow("all others", "-", f"{rest:.2g}", outcome, "less than 0.1"))
    return MethodTable(
        "The direction that noise follows in Table 2",
        ("values of Table 2 divided by its MX2, beside the weakest singular vector of W;",
         "derived: (ZZ2R, MX2, XX3R, MX4) = (2 D4, 1, -D4, -1)"),
        tuple(rows),
    )  # fmt: skip


def _build_essential_table(
    printed: Mapping[str, tuple[float, ...]], full: FitResult, reduced: FitResult
) -> MethodTable:
    """Table 3, its selection, and both condition numbers."""
    rows = _compare_parameters(
        printed, {name: value for name, (value, _) in printed.items()}, reduced
    )
    left = [p.name for p in full.parameters if not p.essential]
    theirs, ours = str(len(full.parameters) - len(printed)), f"{len(left)} by the F-test"
    rows.append(MethodRow("left out", theirs, ours, Outcome.SHOWN, ", ".join(left)))
    return MethodTable("Table 3: essential parameters", SETTING[:1], tuple(rows))


def _build_condition_table(
    printed: list[float], full: FitResult, reduced: FitResult
) -> MethodTable:
    """Condition numbers, each of its own motions; what must agree is what leaving ten out does."""
    rows = []
    for theirs, fit in zip(printed, (full, reduced), strict=True):
        what, number = f"{len(fit.parameters)} columns", f"{fit.condition_number:.4g}"
        why = "of other motions: see the next table"
        rows.append(MethodRow(what, f"{theirs:g}", number, Outcome.SHOWN, why))
    fall, ours = printed[0] / printed[1], full.condition_number / reduced.condition_number
    outcome = judge_outcome(min(fall, ours) > FALL, Outcome.HOLDS)
    rows.append(
        MethodRow("their ratio", f"{fall:.3g}", f"{ours:.3g}", outcome, f"more than {FALL:g}")
    )
    return MethodTable("Condition numbers of W", (), tuple(rows))
