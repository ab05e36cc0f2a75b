"""A small arm on position servos, as MuJoCo moves it and as a LeRobot data set keeps it."""

import json
from dataclasses import dataclass

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from modeler.robot import Robot

COUNTS = 4096  # of the encoder, a turn


@dataclass(frozen=True)
class Servo:
    """What moves a joint, SI: bridge, motor, gear, and the gain of the position loop."""

    voltage: float
    resistance: float
    k_e: float
    gain: float
    armature: float
    damping: float
    friction: float
    stiffness: float = 6.0  # share of the voltage per rad

    @property
    def per_duty(self) -> float:
        """Torque of the whole voltage on a motor that stands."""
        return self.gain * self.voltage / self.resistance


@dataclass(frozen=True)
class Frames:
    """What a recorder saw at its rate: rad, shares of the voltage."""

    time: np.ndarray
    asked: np.ndarray
    state: np.ndarray
    duty: np.ndarray


def recorded(robot: Robot, servo: Servo, goals: np.ndarray, fps: float) -> Frames:
    """Position servos that follow goals (frames, joints), seen through encoders of 12 bits."""
    from tests.oracles.mujoco_machine import mujoco, mujoco_model

    rotors = {f"Ia{joint.name}": servo.armature for joint in robot.joints}
    model = mujoco_model(robot, {**robot.parameters, **rotors}, light=0.0)
    data = mujoco.MjData(model)
    every, ticks = 2, round(1000.0 / fps)  # the servo's loop runs at 1 kHz, or nearly
    model.opt.timestep = 1.0 / (fps * ticks * every)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    model.dof_damping[:], model.dof_frictionloss[:] = servo.damping, servo.friction
    step, induced = 2 * np.pi / COUNTS, servo.gain * servo.k_e / servo.resistance
    data.qpos[:] = goals[0]
    state, duty = np.zeros_like(goals), np.zeros_like(goals)
    for k, goal in enumerate(goals):
        before = goals[max(k - 1, 0)]
        for tick in range(ticks):
            seen = np.round(data.qpos / step) * step
            ramp = before + (goal - before) * (tick / ticks)  # the servo's own profile
            share = np.round(np.clip(servo.stiffness * (ramp - seen), -1.0, 1.0), 3)
            if tick == 0:
                state[k], duty[k] = seen, share
            for _ in range(every):
                data.qfrc_applied[:] = servo.per_duty * share - induced * data.qvel
                mujoco.mj_step(model, data)
    return Frames(np.arange(len(goals)) / fps, goals, state, duty)


def write_dataset(folder, episodes, motors, fps, load=True):
    """A LeRobot data set (v2.1): degrees, and loads in units of 0.1 %, as the servos show them."""
    tables, index = [], 0
    names = [f"{motor}.pos" for motor in motors]
    for number, frames in enumerate(episodes):
        n = len(frames.time)
        columns = {
            "observation.state": _lists(np.rad2deg(frames.state)),
            "action": _lists(np.rad2deg(frames.asked)),
            "timestamp": pa.array(np.arange(n) / fps, pa.float32()),
            "frame_index": np.arange(n),
            "episode_index": np.full(n, number),
            "index": np.arange(index, index + n),
        }
        if load:
            columns["observation.load"] = _lists(1000.0 * frames.duty)
        tables.append(pa.table(columns))
        index += n
    features = {
        name: {"dtype": "float32", "names": names} for name in ("observation.state", "action")
    }
    features["observation.load"] = {"names": [f"{motor}.load" for motor in motors]}
    (folder / "meta").mkdir(parents=True)
    (folder / "data" / "chunk-000").mkdir(parents=True)
    info = {"codebase_version": "v2.1", "fps": fps, "features": features}
    (folder / "meta" / "info.json").write_text(json.dumps(info))
    pq.write_table(pa.concat_tables(tables), folder / "data" / "chunk-000" / "file-000.parquet")
    return folder


def _lists(values: np.ndarray) -> pa.Array:
    return pa.array(list(values.astype(np.float32)), pa.list_(pa.float32()))
