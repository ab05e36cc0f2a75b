"""A simulated measurement, and the files it goes to."""

import io
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from modeler.core.brief import ShortRepr
from modeler.core.errors import DataError
from modeler.core.files import write_atomically
from modeler.core.json import convert_to_plain
from modeler.core.result import Result
from modeler.simulation.settings import HiddenEffect, SimulationSettings


@dataclass(frozen=True, eq=False)
class Truth(ShortRepr):
    """What no sensor sees.

    Attributes:
        q, qd, qdd: (n, joints) exact motion at each sample; qdd just after the torque's step.
        tau: (n, joints) motor torque, constant from each sample to the next, N m or N.
        parameters: true standard parameters by name, in table order, SI units.
        drawn: names among these that the robot file leaves open.
        hidden: effects that the robot file lacks, with all their values.
    """

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    tau: np.ndarray
    parameters: Mapping[str, float]
    drawn: tuple[str, ...]
    hidden: tuple[HiddenEffect, ...] = ()


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
    """Columns by name: time, q1.., qc1.., tau1.. or current1.., further ones.

    A joint without motor has only its q; one whose drive gain is set logs its current.
    """
    columns = {"time": log.time}
    columns |= {f"q{name}": log.q[:, i] for i, name in enumerate(log.joints)}
    driven = [(i, name) for i, name in enumerate(log.joints) if log.driven[i]]
    columns |= {f"qc{name}": log.qc[:, i] for i, name in driven}
    gains = log.settings.drive_gains
    columns |= {
        f"current{name}" if name in gains else f"tau{name}": log.tau[:, i] / gains.get(name, 1.0)
        for i, name in driven
    }
    return columns | dict(log.further)


def write_log(path: Path, log: SimulatedLog) -> None:
    """Write the log as Parquet or CSV, by the suffix of `path`.

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
    buffer = io.BytesIO()
    pq.write_table(pa.table({name: pa.array(v) for name, v in columns.items()}), buffer)
    write_atomically(path, buffer.getvalue())


def check_suffix(path: Path) -> None:
    """Nothing, if `write_log` knows the suffix of `path`; ask before a long simulation.

    Raises:
        DataError: it does not.
    """
    if Path(path).suffix not in (".parquet", ".csv"):
        raise DataError(
            f"{path}: got suffix {Path(path).suffix or '(none)'}; expected .parquet or .csv"
        )


def write_truth(path: Path, log: SimulatedLog) -> None:
    """Write the true parameters and the seeds as JSON.

    Raises:
        ModelerError: the file cannot be written.
    """
    content = {
        "robot": log.robot,
        "seed": log.settings.seed,
        "parameter_seed": log.settings.parameter_seed,
        "torque_noise": log.settings.torque_noise,
        "parameters": dict(log.truth.parameters),
        "drawn": list(log.truth.drawn),
        "hidden": serialise_hidden_effects(log),
        "drive_gains": dict(log.settings.drive_gains),
    }
    write_atomically(
        Path(path), json.dumps(convert_to_plain(content), indent=1, allow_nan=False) + "\n"
    )


def serialise_hidden_effects(log: SimulatedLog) -> list[dict[str, object]]:
    """The hidden effects for JSON."""
    return [
        {"effect": h.effect, "joint": h.joint, "values": dict(h.values)} for h in log.truth.hidden
    ]
