"""A simulated machine that a program of ours drives over pipes, and the C folder of its fit."""

import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from modeler.api import IdentifiedModel, compile_model, derive, fit, generate, observe
from modeler.robot import Robot
from modeler.simulate import HiddenEffect, SimulationSettings, simulate, write_log
from modeler.simulate.integrate import steps_per_tick, tick_function
from modeler.simulate.limits import motion_limits
from modeler.simulate.native import FastFunction
from modeler.simulate.parameters import plant_parameters
from modeler.simulate.run import _closed_task, _postures, _task
from modeler.simulate.sensors import encoder_resolution, quantised


class Driven(NamedTuple):
    """What a program did with a machine, one row per sample."""

    error: np.ndarray  # q - q_d, (n, joints)
    qd: np.ndarray
    tau: np.ndarray  # sent to the motors
    answers: np.ndarray  # all that the program printed


class Machine:
    """The physics of modeler's simulator, one control tick a call; it shares nothing with the C."""

    def __init__(self, robot: Robot, settings: SimulationSettings) -> None:
        every = motion_limits(robot, settings.limits)
        parameters = plant_parameters(robot, every, settings.parameter_seed)
        make = _closed_task if robot.loops else _task
        self.settings = settings
        self.task = make(robot, parameters, every, settings, settings.hidden)
        self.reference = self.task.reference
        self.resolution = encoder_resolution(robot.coordinates, settings)
        plant, tick = self.task.plant, 1 / settings.rate
        steps = steps_per_tick(plant, self.task.limits, tick, _postures(self.task))
        self._advance = FastFunction(tick_function(plant, tick, steps))
        self._n = len(plant.joints)

    def drive(
        self,
        program: Sequence[object],
        line: Callable[[int, np.ndarray, np.ndarray, np.ndarray], np.ndarray],
        push: Callable[[float], np.ndarray] | None = None,
    ) -> Driven:
        """Along the reference: the program's first numbers are the torques held for one tick.

        Args:
            program: command; it answers a line of numbers by a line of numbers.
            line: (sample, encoder positions, true speeds, torques held since the last) -> what it
                is told.
            push: s -> torques from outside, (joints,).
        """
        n, ticks = self._n, self.reference.time.size
        plant, start = self.task.plant, self.reference.q[0]
        x = np.concatenate([start, np.zeros(n), self.task.along[0]])
        tau = np.zeros(n)
        rows = []
        words = [str(word) for word in program]
        with subprocess.Popen(
            words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as own:
            assert own.stdin is not None and own.stdout is not None
            for k in range(ticks):
                q = quantised(x[:n], self.resolution)
                told = line(k, q, x[n : 2 * n], tau)
                own.stdin.write(" ".join(repr(float(value)) for value in told) + "\n")
                own.stdin.flush()
                answer = np.array([float(word) for word in own.stdout.readline().split()])
                assert answer.size >= n, f"{words} ended at sample {k}"
                error = x[:n] - self.reference.q[k]
                tau = np.where(plant.driven, answer[:n], 0.0)
                rows.append((error, x[n : 2 * n].copy(), tau, answer))
                outside = push(self.reference.time[k]) if push else 0.0
                x = self._advance(x, tau + outside)
            own.stdin.close()
            assert own.wait() == 0
        return Driven(*(np.array(values) for values in zip(*rows, strict=True)))


def observed(command: Sequence[object], rows: np.ndarray) -> np.ndarray:
    """What a program answers to lines that are known beforehand."""
    text = "\n".join(" ".join(repr(float(value)) for value in row) for row in rows)
    words = [str(word) for word in command]
    ran = subprocess.run(words, input=text, capture_output=True, text=True, check=True)
    return np.array([[float(word) for word in line.split()] for line in ran.stdout.splitlines()])


def fitted_folder(
    modelled: Robot, real: Robot, folder: Path, hidden: tuple[HiddenEffect, ...] = ()
) -> IdentifiedModel:
    """The C of a model fitted to a simulated log of the real robot, written to the folder."""
    settings = SimulationSettings(duration=12.0, rate=500.0, seed=1, hidden=hidden)
    log = folder.with_suffix(".parquet")
    write_log(log, simulate(real, settings))
    derivation = derive(modelled)
    emitted = generate(derivation)
    model = fit(derivation, emitted, observe(compile_model(emitted), [log]))
    generate(model, folder)
    return model


def rms(values: np.ndarray) -> np.ndarray:
    """(joints,) root of the mean square."""
    return np.sqrt(np.mean(values**2, axis=0))
