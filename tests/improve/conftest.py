"""The demonstration arm of the diagnoses, its runs, commands about it; a robot with loops."""

from collections import namedtuple
from pathlib import Path

import numpy as np
import pytest

from modeler.diagnosis import add
from modeler.diagnosis.added_model import LogSplit
from modeler.regression.log import Log
from tests.diagnose import conftest
from tests.diagnose.conftest import Case, demonstration, made, motion, on_joint, spring

arm, case, run = conftest.arm, conftest.case, conftest.run  # fixtures

BRAKE = """
[own_effects.eddy_brake]
title = "drag of a magnet"
columns = {Keb = "v*exp(-((q - c)/w)**2)"}
shapes = {c = [-1, 0, 1], w = [0.1, 0.3]}
unit = "N*m*s/rad"
nonnegative = true
"""
DRAG, CENTRE, WIDTH = 4.0, 0.7, 0.2  # N m s/rad, rad, rad; the grid has neither value


def brake(log: Log) -> np.ndarray:
    """The torque of the magnet on joint 2."""
    q, v = motion(log)
    return on_joint(log, 1, DRAG * v[:, 1] * np.exp(-(((q[:, 1] - CENTRE) / WIDTH) ** 2)))


def long_runs() -> Case:
    """The arm in longer runs: a magnet that acts in one place is passed seldom."""
    return demonstration(500.0, seconds=(30.0, 20.0))


Mended = namedtuple("Mended", "model logs diagnosis better left_out")
"""A model, its logs, what is missing, and the model with that."""


@pytest.fixture(scope="session")
def sprung(case: Case) -> Mended:
    """Of a spring; nothing is searched for again."""
    model, train, holdout = case.hidden(spring)
    logs, diagnosis = LogSplit([train], [holdout]), case.found(spring)
    with pytest.MonkeyPatch.context() as patch:
        patch.delattr(add, "scan_catalogue")
        added = add.add_findings(model, case.compiled, diagnosis.effects, logs)
    return Mended(model, logs, diagnosis, *added)


@pytest.fixture(scope="session")
def loops(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Logs of a robot with a loop that rubs in a joint without motor, and a model without."""
    folder = tmp_path_factory.getbasetemp() / "five-bar-of-all-folders"
    if not folder.exists():
        folder.mkdir()
        hidden = ("five-bar", "--hide", "passive_friction@21", "--duration", "8", "--rate", "250")
        for name, seed in (("train", "1"), ("other", "2")):
            made("simulate", *hidden, "--seed", seed, "--out", folder / f"{name}.parquet")
        made("fit", "five-bar", folder / "train.parquet", "--out", folder / "m.json")
    return folder
