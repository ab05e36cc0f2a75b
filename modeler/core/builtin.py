"""What comes with the tool, by name: known before anything that takes long is loaded."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

_PACKAGE = Path(__file__).resolve().parents[1]

TEMPLATES = ("serial", "parallelogram", "parallel")
"""Kinds of robots to start from."""

CONVENTIONS = ("khalil", "craig", "classical")
"""Whose table that of a robot file may be."""

OTHER_PROGRAMS = (".par", ".urdf", ".xml", ".mjcf", ".xacro", ".sdf")
"""Endings of robot files of other programs: nothing of ours is ever written into one."""

LOG_ENDINGS = (
    ".csv", ".parquet", ".mat", ".h5", ".hdf5", ".mcap", ".db3", ".bag", ".npz", ".npy", ".xlsx",
    ".tsv", ".lvm",
)  # fmt: skip
"""How the name of a log ends, and of nothing else."""

MOTIONS = ("exciting", "point-to-point", "one-joint")
"""What the commanded motion of a simulation may be."""

MOST_SAMPLES = 20_000_000
"""Of a simulation: 5.5 hours at 1 kHz, gigabytes of states already."""

SIMULATED: Mapping[str, float] = MappingProxyType(
    {
        "duration": 20.0, "rate": 1000.0, "seed": 0, "parameter_seed": 0,
        "encoder_counts": 1_000_000, "torque_noise": 0.01, "process_noise": 0.0,
    }
)  # fmt: skip
"""What a simulation is unless something else is asked for."""

EFFECTS = (
    "rotor_inertia", "viscous", "coulomb", "offset", "coupled_inertia", "coupled_friction",
    "asymmetric_viscous", "stribeck", "nonlinear_viscous", "load_friction", "position_friction",
    "presliding", "cable_hysteresis", "temperature_friction", "passive_friction", "spring",
    "counterbalance", "constant_force_spring", "payload", "link_inertia", "base_tilt",
    "external_force", "elasticity", "backlash", "motor_ripple", "joint_ripple",
    "encoder_eccentricity", "encoder_offset", "time_delay", "drive_gain", "drift",
)  # fmt: skip
"""Ids of the catalogue that a simulated machine may hide, in its order."""


def list_builtin_robots() -> tuple[str, ...]:
    """Names of the built-in robots, sorted."""
    return tuple(sorted(file.stem for file in (_PACKAGE / "robot" / "library").glob("*.toml")))


def read_builtin_robot(name: str) -> str:
    """The TOML text of a built-in robot.

    Raises:
        KeyError: there is none of that name.
    """
    if name not in list_builtin_robots():
        raise KeyError(name)
    return locate_builtin_robot(name).read_text(encoding="utf-8")


def locate_builtin_robot(name: str) -> Path:
    """Where the text of a built-in robot stands."""
    return _PACKAGE / "robot" / "library" / f"{name}.toml"


def read_template(name: str) -> str:
    """The text of a robot file to start from, with what is to be put in marked by $."""
    return (_PACKAGE / "robot" / "templates" / f"{name}.toml").read_text(encoding="utf-8")


def list_papers() -> tuple[str, ...]:
    """Names of the papers that there are."""
    return tuple(sorted(path.stem for path in (_PACKAGE / "papers" / "library").glob("*.toml")))
