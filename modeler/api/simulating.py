"""Measurements by simulation."""

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from modeler.core.errors import DataError
from modeler.robot import Robot
from modeler.simulate import (
    HiddenEffect,
    SimulatedLog,
    SimulationSettings,
    at_rate,
    check_suffix,
    hidden_from_text,
    read_motion,
    write_log,
)
from modeler.simulate import simulate as simulated


def simulate(
    robot: Robot,
    path: str | Path | None = None,
    *,
    hide: Sequence[str | HiddenEffect] = (),
    motion: str | Path = "exciting",
    progress: Callable[[float], None] | None = None,
    **settings: Any,
) -> SimulatedLog:
    """A measurement of a robot under its controller; `observe` and the others take it as a log.

        simulate(load("demo-arm"), "run.parquet", hide=["load_friction@2"], duration=20, seed=1)

    Args:
        robot: parameters that its file leaves open are drawn from `parameter_seed`.
        path: .parquet or .csv file to write; None: none.
        hide: physics that the machine has and the robot file lacks, as "stribeck@2:extra=3".
        motion: "exciting", "point-to-point", "one-joint", or a file of a motion or log.
        progress: called with the share done, 0 to 1.
        settings: of `SimulationSettings`: duration [s], rate [Hz], seed, parameter_seed,
            torque_noise [share of rms], encoder_counts, process_noise, controller, drive_gains ...

    Raises:
        DataError: a setting that is none, or that cannot be; what the simulation refuses.
    """
    if path is not None:
        check_suffix(Path(path))
    asked = _settings(robot, hide, motion, settings)
    log = simulated(robot, asked, progress)
    if path is not None:
        write_log(Path(path), log)
    return log


def _settings(
    robot: Robot, hide: Sequence[str | HiddenEffect], motion: str | Path, given: dict[str, Any]
) -> SimulationSettings:
    known = {field.name for field in dataclasses.fields(SimulationSettings)}
    for name in given:
        if name not in known:
            raise DataError(f"simulate: got {name}; expected some of {', '.join(sorted(known))}")
    hidden = tuple(hidden_from_text(each) if isinstance(each, str) else each for each in hide)
    if not str(motion).endswith((".csv", ".parquet")):
        return SimulationSettings(hidden=hidden, motion=str(motion), **given)
    rate = given.get("rate", SimulationSettings().rate)
    joints = [joint.name for joint in robot.coordinates]
    commanded = at_rate(read_motion(motion, joints), rate)
    return SimulationSettings(hidden=hidden, commanded=commanded, **given)
