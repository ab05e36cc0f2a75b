"""One simulated run of the demonstration arm, and two of a slide in the formats of others."""

import dataclasses
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
import scipy.io

from modeler.api import compile_model, derive, generate, load, read_logs
from modeler.cli import main
from modeler.core.choices import read_builtin_robot
from modeler.regression.log import Log
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate
from modeler.simulation.log import build_log_columns
from tests.logs.programs import text_of, written
from tests.logs.writers import Run, joined, parquet


@dataclasses.dataclass(frozen=True, eq=False)
class Case:
    """A robot, and a run as columns in our names."""

    compiled: CompiledModel
    table: Run

    def check(self, path, mapping=(), digits: float = 1e-9) -> Log:
        """A log that has the numbers of the run, but for what its digits lose."""
        (log,) = read_logs(self.compiled, [path], mapping)
        time = self.table["time"]
        assert log.time - log.time[0] == pytest.approx(time - time[0], abs=max(1e-9, digits))
        for prefix, values in (("q", log.q), ("tau", log.tau)):
            true = joined(self.table, prefix)
            assert values == pytest.approx(true, abs=digits * np.abs(true).max()), prefix
        return log


@pytest.fixture(scope="package")
def case() -> Case:
    derivation = derive(load("demo-arm"))
    run = simulate(derivation.robot, SimulationSettings(duration=2.5, seed=3, torque_noise=0.01))
    return Case(compile_model(generate(derivation)), Run(build_log_columns(run)))


@pytest.fixture(scope="package")
def short(case) -> Case:
    """The first 0.4 s."""
    return Case(case.compiled, Run({name: values[:400] for name, values in case.table.items()}))


MAT = """
[log]
time = "run.t [ms]"
"q<j>" = {column = "run.x", unit = "mm", sign = -1}
"tau<j>" = "run.F [kN]"
"""
TEXT = "Zeit [ms];Weg [mm];Strom (soll);Kraft [kN]\n"


@pytest.fixture(scope="package")
def slide(tmp_path_factory) -> Path:
    """A folder: two runs of EMPS as Parquet, MAT file and German text, emps.toml with [log].

    And the models of the first as Parquet, p.json, and as MAT file, m.json.
    """
    folder = tmp_path_factory.mktemp("slide")
    (folder / "emps.toml").write_text(read_builtin_robot("emps") + MAT)
    for name, seed in (("a", "1"), ("b", "2")):
        out = folder / f"{name}.parquet"
        words = f"simulate emps --duration 8 --noise 0.5 --seed {seed} --out {out}".split()
        assert main(words) == 0
        table = {column: np.array(v) for column, v in pq.read_table(out).to_pydict().items()}
        other = {"t": table["time"] * 1e3, "x": -1e3 * table["q1"], "F": table["tau1"] * 1e-3}
        scipy.io.savemat(folder / f"{name}.mat", {"run": other})
        rows = np.column_stack([other["t"], -other["x"], 0.0 * other["t"], other["F"]])
        written(folder / f"{name}.txt", TEXT + text_of(rows, ";", ","), "cp1252")
        twin = {"time": other["t"] * 1e-3, "q1": -1.0 * other["x"] * 1e-3, "tau1": other["F"] * 1e3}
        parquet(out, twin)
    for robot, log, out in (("emps", "a.parquet", "p"), (folder / "emps.toml", "a.mat", "m")):
        argv = ["fit", robot, folder / log, "--out", folder / f"{out}.json"]
        assert main([*map(str, argv)]) == 0
    return folder


@pytest.fixture
def run(capsys) -> Callable[..., tuple[int, str, str]]:
    """Runs a command; gives its status, and what it printed on both streams."""

    def run(*argv: object) -> tuple[int, str, str]:
        status = main([str(word) for word in argv])
        return status, *capsys.readouterr()

    return run
