"""A simulated machine that a program of ours drives over pipes, and the C folder of its fit."""

import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from modeler.api import derive, fit, generate, observe
from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from modeler.core.manifest import FittedParameter, FittedSpec
from modeler.robot.robot import Robot
from modeler.simulation import SimulationSettings, run, simulate, write_log
from modeler.simulation.hidden_draw import complete_effects
from modeler.simulation.parameters import draw_plant_parameters
from modeler.simulation.plant import FastFunction, build_tick_function, choose_steps_per_tick
from modeler.simulation.trajectory import collect_motion_limits
from tests.modules import loaded


class Driven(NamedTuple):
    """What a program did with a machine, one row per sample."""

    error: np.ndarray  # q - q_d, (n, joints)
    qd: np.ndarray
    tau: np.ndarray  # sent to the motors
    answers: np.ndarray  # all that the program printed


class Machine:
    """The physics of modeler's simulator, one control tick a call; it shares nothing with the C.

    Attributes:
        reference: the commanded motion.
        joints: how many.
        moved: (n, joints) the motion about its mean.
        torque: rms torque that the motion needs, of the joint that needs least.
        standard: true standard parameters by name.
        hidden: effects beside them, all their values known.
    """

    def __init__(self, robot: Robot, settings: SimulationSettings) -> None:
        every = collect_motion_limits(robot, settings.limits)
        parameters = draw_plant_parameters(robot, every, settings.parameter_seed)
        self.hidden = complete_effects(robot, parameters, every, settings)
        self.standard = parameters.standard
        self.task = run.build_task(robot, parameters, every, settings, self.hidden)
        self.reference = self.task.reference
        self.resolution = run.compute_encoder_resolution(robot.coordinates, settings)
        plant, tick = self.task.plant, 1 / settings.rate
        steps = choose_steps_per_tick(plant, self.task.limits, tick, run.select_postures(self.task))
        self._advance = FastFunction(build_tick_function(plant, tick, steps))
        self.joints = len(plant.joints)
        self.moved = self.reference.q - self.reference.q.mean(axis=0)
        needed = run.compute_needed_torques(self.task)
        self.torque = float(np.min(rms(needed)))

    def tracking(self, k: int, q: np.ndarray, qd: np.ndarray, tau: np.ndarray) -> np.ndarray:
        """A line for programs that follow the reference."""
        ref = self.reference
        return np.concatenate([q, qd, ref.q[k], ref.qd[k], ref.qdd[k]])

    def drive(self, program, line, push=None):
        """Along the reference: the program's first numbers are the torques held for one tick.

        Args:
            program: command; it answers a line of numbers by a line of numbers.
            line: (sample, encoder positions, true speeds, torques held since the last) -> what it
                is reported.
            push: s -> torques from outside, (joints,).
        """
        n, ticks = self.joints, self.reference.time.size
        plant, start = self.task.plant, self.reference.q[0]
        x = np.concatenate([start, np.zeros(n), self.task.states_along[0]])
        tau = np.zeros(n)
        rows = []
        words = [str(word) for word in program]
        with subprocess.Popen(
            words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as item:
            assert item.stdin is not None and item.stdout is not None
            for k in range(ticks):
                q = run.quantise_position(x[:n], self.resolution)
                stated = line(k, q, x[n : 2 * n], tau)
                item.stdin.write(" ".join(repr(float(value)) for value in stated) + "\n")
                item.stdin.flush()
                answer = np.array([float(word) for word in item.stdout.readline().split()])
                assert answer.size >= n, f"{words} ended at sample {k}"
                error = x[:n] - self.reference.q[k]
                tau = np.where(plant.driven, answer[:n], 0.0)
                rows.append((error, x[n : 2 * n].copy(), tau, answer))
                outside = push(self.reference.time[k]) if push else 0.0
                x = self._advance(x, tau + outside)
            item.stdin.close()
            assert item.wait() == 0
        return Driven(*(np.array(values) for values in zip(*rows, strict=True)))


def replies(command: Sequence[object], rows: Sequence[np.ndarray]) -> tuple[np.ndarray, int, str]:
    """What a program answers to lines that are known beforehand, its status, and what it says."""
    text = "\n".join(" ".join(repr(float(value)) for value in row) for row in rows)
    words = [str(word) for word in command]
    ran = subprocess.run(words, input=text, capture_output=True, text=True)
    numbers = [[float(word) for word in line.split()] for line in ran.stdout.splitlines()]
    return np.array(numbers), ran.returncode, ran.stderr


def observed(command: Sequence[object], rows: np.ndarray) -> np.ndarray:
    answers, status, said = replies(command, rows)
    assert status == 0, said
    return answers


def fitted_folder(robot: Robot, folder: Path) -> None:
    """The C of a model fitted to a simulated log, written to the folder."""
    log = folder.with_suffix(".parquet")
    write_log(log, simulate(robot, SimulationSettings(duration=6.0, rate=250.0, seed=1)))
    derivation = derive(robot)
    emitted = generate(derivation)
    model = fit(derivation, emitted, observe(loaded(emitted), [log]))
    generate(model, folder)


def true_folder(robot: Robot, standard: Mapping[str, float], folder: Path) -> None:
    """The C with base parameters of true standard ones, written to the folder."""
    derivation = derive(robot)
    emitted = generate(derivation)
    spec = emitted.spec
    chi = np.array([standard[parameter.name] for parameter in spec.standard])
    beta = loaded(emitted).base_parameters(chi)
    known = tuple(
        FittedParameter(base.name, base.unit, float(value), 0.0)
        for base, value in zip(spec.base, beta, strict=True)
    )
    values = FittedSpec("weighted", True, "usable: true values", (), (), known)
    write_emitted(emit(derivation.model, derivation.base, values, control=Control()), folder)


def rms(values: np.ndarray) -> np.ndarray:
    """(joints,) root of the mean square."""
    return np.sqrt(np.mean(values**2, axis=0))
