"""A simulated measurement, and the files it goes to."""

import io
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.choices import MOST_SAMPLES, MOTIONS
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.core.json import ShortRepr, convert_to_plain
from modeler.core.result import Result
from modeler.robot import Limits, Robot

if TYPE_CHECKING:
    from modeler.simulation.trajectory import Reference


_MOST = {
    "seed": math.inf,
    "parameter_seed": math.inf,
    "encoder_counts": 1e12,
    "linear_resolution": 1.0,
    "torque_noise": 100.0,
    "process_noise": 100.0,
}
"""What may be 0 and more, up to this."""
_FORM = "EFFECT, EFFECT@JOINT or EFFECT@JOINT:name=value,..., as in stribeck@2:extra=3"


@dataclass(frozen=True)
class HiddenEffect:
    """One effect that the robot file does not know of.

    Attributes:
        effect: id.
        joint: name of the joint or link; None for an effect of the whole machine, and, where one
            is requested, for a joint that is drawn.
        values: physical parameters by name, SI; those left out are drawn.
    """

    effect: str
    joint: str | None = None
    values: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class SimulationSettings(ShortRepr):
    """Motion, controller and sensors of a simulated measurement.

    Attributes:
        motion: "exciting" (moves at several speeds, then a Fourier series), "point-to-point"
            (moves between random points, as fast as the limits allow) or "one-joint" (one joint
            after the other moves alone, at random configurations).
        duration: s.
        rate: control ticks and samples per second.
        seed: of motion and noise; another seed is another measurement of the same robot.
        parameter_seed: of the true parameters that the robot file leaves open.
        encoder_counts: per turn of a revolute joint; 0 for an ideal encoder.
        linear_resolution: of the encoder of a prismatic joint, m; 0 for an ideal encoder.
        torque_noise: standard deviation of the white noise on measured torques, as a share of the
            rms torque of the joint.
        controller: True if a robot with loops is moved by a controller, as all others are; False:
            it carries out the commanded motion exactly.
        bandwidth: of the velocity loops, Hz; lowered where `rate` is too slow for it.
        feedforward: True if the controller uses commanded speed and acceleration.
        limits: range of motion by joint, in place of the robot file's.
        torque_limits: largest motor torque by joint, N m or N; where none is given, twice what the
            commanded motion needs.
        process_noise: standard deviation of a random torque on the machine itself, correlated over
            30 ms, as a share of the rms torque that the commanded motion needs.
        hidden: effects that the machine has and the robot file lacks.
        drive_gains: torque per drive unit by joint, N m or N; what the log holds of such a joint
            is the current, its torque over this, and not the torque.
        commanded: the motion itself, at `rate`, in place of `motion` and `duration`.
    """

    motion: str = "exciting"
    duration: float = 20.0
    rate: float = 1000.0
    seed: int = 0
    parameter_seed: int = 0
    encoder_counts: int = 1_000_000
    linear_resolution: float = 1e-6
    torque_noise: float = 0.01
    controller: bool = False
    bandwidth: float = 20.0
    feedforward: bool = True
    limits: Mapping[str, Limits] = field(default_factory=dict)
    torque_limits: Mapping[str, float] = field(default_factory=dict)
    process_noise: float = 0.0
    hidden: tuple[HiddenEffect, ...] = ()
    drive_gains: Mapping[str, float] = field(default_factory=dict)
    commanded: "Reference | None" = None


def check_settings(settings: SimulationSettings, joints: tuple[str, ...]) -> None:
    """Checks that the settings can be simulated with these joints.

    Raises:
        DataError: names the setting, what was got and what is expected.
    """
    if settings.motion not in MOTIONS:
        raise DataError(
            f"simulation, motion: got {settings.motion}; expected one of {', '.join(MOTIONS)}"
        )
    for name in ("duration", "rate", "bandwidth"):
        value = getattr(settings, name)
        if not (math.isfinite(value) and value > 0):
            raise DataError(f"simulation, {name}: got {value}; expected a number above 0")
    if settings.duration * settings.rate > MOST_SAMPLES:
        raise DataError(
            f"simulation, duration: got {settings.duration:g} s at {settings.rate:g} samples per "
            f"second, {settings.duration * settings.rate:.3g} samples; expected at most "
            f"{MOST_SAMPLES:.0e}; simulate a shorter motion or lower the rate"
        )
    for name, most in _MOST.items():
        value = getattr(settings, name)
        if not 0 <= value <= most or value == math.inf:
            upto = f", at most {most:g}" if math.isfinite(most) else ""
            raise DataError(f"simulation, {name}: got {value}; expected 0 or more{upto}")
    for joint, value in settings.torque_limits.items():
        if joint not in joints:
            raise DataError(
                f"simulation, torque_limits: no moving joint {joint}; "
                f"expected one of {', '.join(joints)}"
            )
        if not value > 0:
            raise DataError(
                f"simulation, torque_limits of joint {joint}: got {value}; expected a number "
                "above 0"
            )


def parse_hidden_effect(text: str) -> HiddenEffect:
    """Parses an effect such as "stribeck", "stribeck@2" or "stribeck@2:extra=3,speed=0.1".

    Raises:
        DataError: the text has another form, or a value is no number.
    """
    place, colon, listed = text.partition(":")
    effect, at, joint = place.partition("@")
    if not effect or (at and not joint) or (colon and not listed):
        raise DataError(f"hidden effect: got {text!r}; expected {_FORM}")
    values: dict[str, float] = {}
    for entry in listed.split(",") if colon else []:
        name, equals, number = (part.strip() for part in entry.partition("="))
        if not (name and equals) or name in values:
            raise DataError(
                f"hidden effect {text!r}: got {entry!r}; expected each value once as name=value"
            )
        values[name] = _parse_number(number)
        if not math.isfinite(values[name]):
            raise DataError(f"hidden effect {text!r}, {name}: got {number!r}; expected a number")
    return HiddenEffect(effect.strip(), joint.strip() or None, values)


def parse_drive_gains(texts: Sequence[str], robot: Robot) -> dict[str, float]:
    """Returns torque per drive unit by joint, N m or N, from texts such as "11=2110".

    Raises:
        DataError: another form, no such joint or one without a motor, a joint twice, a gain that
            is no number or 0.
    """
    motors = [joint.name for joint in robot.coordinates if joint.actuated]
    gains: dict[str, float] = {}
    for text in texts:
        joint, equals, number = (part.strip() for part in text.partition("="))
        if not equals or joint in gains:
            raise DataError(
                f"--drive-gain {text}: expected each joint once as JOINT=VALUE, as in "
                f"{motors[0] if motors else 1}=12.5"
            )
        if joint not in motors:
            raise DataError(
                f"--drive-gain {text}: {robot.name} has no joint {joint} with a motor; expected "
                f"one of {', '.join(motors)}"
            )
        gains[joint] = _parse_number(number)
        if not math.isfinite(gains[joint]) or gains[joint] == 0.0:
            raise DataError(
                f"--drive-gain {text}: got {number or 'nothing'}; expected torque per drive unit, "
                "a number other than 0"
            )
    return gains


def _parse_number(text: str) -> float:
    """NaN of what is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan


# A simulated measurement, and the files it goes to.


@dataclass(frozen=True, eq=False)
class Truth(ShortRepr):
    """The exact motion and torque of a simulated robot, which no sensor sees.

    Attributes:
        q, qd, qdd: (n, joints) exact motion at each sample; qdd just after the torque's step.
        tau: (n, joints) motor torque, constant from each sample to the next, N m or N.
        parameters: true standard parameters by name, in table order, SI units.
        random_parameters: names among these that the robot file leaves open.
        hidden_effects: effects that the robot file lacks, with all their values.
    """

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    tau: np.ndarray
    parameters: Mapping[str, float]
    random_parameters: tuple[str, ...]
    hidden_effects: tuple[HiddenEffect, ...] = ()


@dataclass(frozen=True, eq=False)
class SimulatedLog(Result):
    """What a robot's logger would have written.

    Attributes:
        robot: its name.
        joints: names, in the order of the columns of all arrays.
        driven: (joints,) False for a joint without motor: it has no command and no torque.
        time: (n,) s.
        q: (n, joints) encoder positions, rad or m.
        qc: (n, joints) commanded positions.
        tau: (n, joints) measured torques, N m or N: the mean over the sampling interval that is
            centred at the sample (as current sensors integrate), with noise.
        settings: how it was made.
        truth: what it was made of.
        further: (n,) other measured columns by name.
        range_share: of the way from home to the limits, that the commanded motion was given; less
            than 1 where a robot with loops would come near a singular posture.
    """

    robot: str
    joints: tuple[str, ...]
    driven: np.ndarray
    time: np.ndarray
    q: np.ndarray
    qc: np.ndarray
    tau: np.ndarray
    settings: SimulationSettings
    truth: Truth
    further: Mapping[str, np.ndarray] = field(default_factory=dict)
    range_share: float = 1.0


def build_log_columns(log: SimulatedLog) -> dict[str, np.ndarray]:
    """Returns columns by name: time, q1.., qc1.., tau1.. or current1.., further ones.

    A joint without motor has only its q; one whose drive gain is set logs its current.
    """
    columns = {"time": log.time}
    columns |= {f"q{name}": log.q[:, i] for i, name in enumerate(log.joints)}
    driven = [(i, name) for i, name in enumerate(log.joints) if log.driven[i]]
    columns |= {f"qc{name}": log.qc[:, i] for i, name in driven}
    gains = log.settings.drive_gains
    names = {i: f"current{name}" if name in gains else f"tau{name}" for i, name in driven}
    columns |= {names[i]: log.tau[:, i] / gains.get(name, 1.0) for i, name in driven}
    return columns | dict(log.further)


def write_log(path: Path, log: SimulatedLog) -> None:
    """Writes the log as Parquet or CSV, by the suffix of `path`.

    Raises:
        DataError: another suffix.
        ModelerError: the file cannot be written.
    """
    path = Path(path)
    check_suffix(path)
    columns = build_log_columns(log)
    if path.suffix == ".csv":
        rows = [",".join(columns)]
        rows += [",".join(map(repr, row)) for row in np.column_stack([*columns.values()]).tolist()]
        write_atomically(path, "\n".join(rows) + "\n")
        return
    import pyarrow as pa  # half of the time of a start
    import pyarrow.parquet as pq

    buffer = io.BytesIO()
    pq.write_table(pa.table({name: pa.array(v) for name, v in columns.items()}), buffer)
    write_atomically(path, buffer.getvalue())


def check_suffix(path: Path) -> None:
    """Checks that `write_log` knows the suffix of `path`; ask before a long simulation.

    Raises:
        DataError: it does not.
    """
    if Path(path).suffix not in (".parquet", ".csv"):
        raise DataError(
            f"{path}: got suffix {Path(path).suffix or '(none)'}; expected .parquet or .csv"
        )


def write_truth(path: Path, log: SimulatedLog) -> None:
    """Writes the true parameters and the seeds as JSON.

    Raises:
        ModelerError: the file cannot be written.
    """
    content = {
        "robot": log.robot,
        "seed": log.settings.seed,
        "parameter_seed": log.settings.parameter_seed,
        "torque_noise": log.settings.torque_noise,
        "parameters": dict(log.truth.parameters),
        "random_parameters": list(log.truth.random_parameters),
        "hidden_effects": list(log.truth.hidden_effects),
        "drive_gains": dict(log.settings.drive_gains),
    }
    text = json.dumps(convert_to_plain(content), indent=1, allow_nan=False)
    write_atomically(Path(path), f"{text}\n")
