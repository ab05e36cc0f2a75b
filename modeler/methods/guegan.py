"""Guegan, Khalil and Lemoine 2003, section 5: ten motions, least squares with 23 and 13 parameters.

The simulated Orthoglide is as the paper concludes: the values of its Table 3, links of the
parallelograms too light to be seen. 2.5 ms, encoders of 1 um, 10 % torque noise.
"""

import tempfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeler.compiled import CompiledModel
from modeler.compiled import load as load_compiled
from modeler.derivation import derive, generate, load
from modeler.fit import FitResult
from modeler.fit.identify import Equations, base_equations, fit_equations
from modeler.methods.report import ZMAX, MethodTable, Outcome, Row, figures, judged, recovered
from modeler.observation import Observation, observe, read_log
from modeler.papers import Paper
from modeler.robot import Robot
from modeler.simulate import SimulationSettings, simulate, write_log

ROBOT = "orthoglide-2003-similar-legs"
RUNS, SECONDS, RATE, NOISE = 10, 4.0, 400.0, 0.1
WEAK = ("ZZ2R", "MX2", "XX3R", "MX4")
SLIDE = 0.8
"""kg, of the slide of leg 3: M1R3, which gravity makes a part of Off3."""

LETTERS = {
    "MRP": "MPR", "Ma1R1": "Ia11R", "Ma1R2": "Ia12R", "Ma13": "Ia13R", "Off1": "Off11",
    "Off2": "Off12", "Off3": "Off13R", "MX4R": "MX4",
}  # fmt: skip
"""Names of Tables 2 and 3 that are not ours with small letters."""


def guegan_methods(paper: Paper, report: Callable[[float], None]) -> list[MethodTable]:
    """Tables 2 and 3, the condition numbers, and the direction along which Table 2 is noise."""
    table_2, table_3 = (_ours(figures(paper, place)) for place in ("Table 2", "Table 3"))
    truth = {name: values[0] for name, values in table_3.items()}
    derivation = derive(load(ROBOT))
    emitted = generate(derivation)
    compiled = load_compiled(emitted.spec, emitted.files)
    observation, exact = _simulated(derivation.robot, truth, compiled, report)
    full = fit_equations(observation, base_equations(observation), "weighted")
    kept = [i for i, name in enumerate(observation.names) if name in truth]
    whole = base_equations(observation)
    chosen = Equations(
        whole.W[:, kept], whole.y, tuple(whole.names[i] for i in kept),
        tuple(whole.units[i] for i in kept),
    )  # fmt: skip
    reduced = _reduced(observation, chosen)
    return [
        _all_parameters(table_2, truth, full),
        _weak_direction(table_2, exact),
        _essential(table_3, full, reduced),
    ]


def _ours(printed: Mapping[str, tuple[float, ...]]) -> dict[str, tuple[float, ...]]:
    names = {word: LETTERS.get(word, word.replace("FV", "Fv").replace("FS", "Fs")) for word in printed}
    return {names[word]: values for word, values in printed.items()}


def _machine(robot: Robot, truth: Mapping[str, float]) -> Robot:
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


def _simulated(
    robot: Robot, truth: Mapping[str, float], compiled: CompiledModel, report: Callable[[float], None]
) -> tuple[Observation, np.ndarray]:
    """What is measured on all motions, and the regressor along the motions as they were."""
    machine, logs, exact = _machine(robot, truth), [], []
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(RUNS):
            settings = SimulationSettings(
                duration=SECONDS, rate=RATE, seed=seed, torque_noise=NOISE, linear_resolution=1e-6,
                motion="point-to-point",
            )  # fmt: skip
            log = simulate(machine, settings)
            place = Path(folder) / f"run{seed}.parquet"
            write_log(place, log)
            logs.append(read_log(place, compiled.spec))
            exact.append(compiled.observation(log.truth.q, log.truth.qd, log.truth.qdd))
            report((seed + 1) / RUNS)
    return observe(compiled, logs), np.concatenate(exact)
