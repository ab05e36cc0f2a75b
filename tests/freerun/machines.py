"""Machines whose motion is known, their models with the true values, and logs of them."""

import dataclasses
from functools import cache
from pathlib import Path

import numpy as np

from modeler.api import load
from modeler.estimation.model_file import IdentifiedModel
from modeler.observation.log import Log
from modeler.observation.settings import Processing
from modeler.robot.read import robot_from_text
from modeler.robot.robot import Robot
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate
from tests.chain import chain_of

PENDULUM = """\
name = "pendulum"
title = "One link on a horizontal axis, q from the vertical"
gravity = [{up}, 0, 0]
[mdh]
columns = ["j", "a", "sigma", "theta"]
rows = [["1", "0", 0, "q1"]]
[effects]
viscous = "all"
"""
INERTIA, MOMENT, RUBS, G = 0.5, 0.6, 0.2, 9.81  # kg m^2, kg m, N m s/rad, m/s^2


@cache
def pendulum(stands: bool) -> tuple[IdentifiedModel, Log]:
    """The pendulum about the upright posture, or hanging, swung by 0.1 rad; nothing is noisy.

    I qdd + b qd -+ m l g sin q = tau, written down by hand.
    """
    robot = robot_from_text(PENDULUM.format(up=-G if stands else G), "pendulum")
    time = np.arange(0.0, 2.0 * np.pi, 0.002)  # whole periods of both sines
    q, qd, qdd = swing(time)
    pull = MOMENT * G * np.sin(q) * (-1.0 if stands else 1.0)
    tau = INERTIA * qdd + RUBS * qd + pull
    log = Log("swing.parquet", ("1",), time, q[:, None], tau[:, None], qd[:, None], qdd[:, None])
    return fitted(robot, [log])[0], log


def swing(time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Two slow sines about 0, with their derivatives."""
    parts = [(0.06, 2.0), (0.04, 5.0)]
    q = sum(a * np.sin(w * time) for a, w in parts)
    qd = sum(a * w * np.cos(w * time) for a, w in parts)
    qdd = sum(-a * w**2 * np.sin(w * time) for a, w in parts)
    return np.asarray(q), np.asarray(qd), np.asarray(qdd)


def fitted(robot: Robot, logs: list[Log]) -> tuple[IdentifiedModel, CompiledModel]:
    """A fit to logs, and the compiled robot."""
    chain = chain_of(robot)
    processing = Processing(position_cutoff=40.0, parallel_cutoff=8.0)
    return chain.fit(logs, processing, "ordinary"), chain.compiled


def with_values(model: IdentifiedModel, beta: np.ndarray) -> IdentifiedModel:
    """The model with other values."""
    parameters = tuple(
        dataclasses.replace(p, value=float(value))
        for p, value in zip(model.fit.parameters, beta, strict=True)
    )
    return dataclasses.replace(model, fit=dataclasses.replace(model.fit, parameters=parameters))


def without_commands(log: Log) -> Log:
    """The log of a machine whose controller tells nothing."""
    return dataclasses.replace(log, commanded=None)


def simulated(robot: Robot, duration: float, seed: int, **settings) -> tuple[Log, np.ndarray]:
    """A log of the independent simulator with ideal sensors, and the true standard parameters."""
    own = {"encoder_counts": 0, "torque_noise": 0.0, "rate": 500.0} | settings
    made = simulate(robot, SimulationSettings(duration=duration, seed=seed, **own))
    log = Log(f"run{seed}.parquet", made.joints, made.time, made.q, made.tau, commanded=made.qc)
    return log, made.truth.parameters


def true_model(name: Path | str | Robot, duration: float = 8.0, seed: int = 1, **settings):
    """Model with the true values, compiled robot, log."""
    robot = name if isinstance(name, Robot) else load(str(name))
    log, truth = simulated(robot, duration, seed, **settings)
    model, compiled = fitted(robot, [log])
    chi = [truth[p.name] for p in compiled.spec.standard]
    return with_values(model, compiled.base_parameters(chi)), compiled, log
