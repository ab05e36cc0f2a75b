"""One simulated run of the demonstration arm, and its fit."""

import dataclasses

import numpy as np
import pytest

from modeler.api import compile_model, derive, generate, load, observe
from modeler.estimation.identify import identify
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate
from modeler.simulation.log import log_columns
from tests.logs.writers import Run, parquet


@dataclasses.dataclass(frozen=True, eq=False)
class Case:
    """A robot, a run as columns in our names, and the parameters that its Parquet file gives."""

    compiled: CompiledModel
    table: Run
    beta: np.ndarray

    def fitted(self, path, mapping) -> np.ndarray:
        return identify(observe(self.compiled, [path], mapping=mapping)).beta


@pytest.fixture(scope="package")
def case(tmp_path_factory) -> Case:
    derivation = derive(load("demo-arm"))
    compiled = compile_model(generate(derivation))
    run = simulate(derivation.robot, SimulationSettings(duration=2.5, seed=3, torque_noise=0.01))
    table = Run(log_columns(run))
    path = parquet(tmp_path_factory.mktemp("run") / "run.parquet", table)
    return Case(compiled, table, identify(observe(compiled, [path])).beta)
