"""What users may choose: built-in robots, effects, estimators, options of commands.

It is known before anything that takes long is loaded; words and lists stand in choices.toml.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, cast, get_args

from modeler.core.json import Document

_PACKAGE = Path(__file__).resolve().parents[1]
_CHOICES: Mapping[str, Any] = tomllib.loads(
    Path(__file__).with_name("choices.toml").read_text("utf-8")
)

TEMPLATES = ("serial", "parallelogram", "parallel")
"""Kinds of robots to start from."""

CONVENTIONS = ("khalil", "craig", "classical")
"""Whose table that of a robot file may be."""

OTHER_PROGRAMS = (".par", ".urdf", ".xml", ".mjcf", ".xacro", ".sdf")
"""Endings of robot files of other programs: nothing of ours is ever written into one."""

LOG_ENDINGS = tuple(_CHOICES["log_endings"].split())
"""How the name of a log ends, and of nothing else."""

MOTIONS = ("exciting", "point-to-point", "one-joint")
"""What the commanded motion of a simulation may be."""

MOST_SAMPLES = 20_000_000
"""Of a simulation: 5.5 hours at 1 kHz, gigabytes of states already."""

SIMULATED: Mapping[str, float] = MappingProxyType(_CHOICES["simulation"])
"""What a simulation is unless something else is requested."""

EFFECTS = tuple(_CHOICES["effects"].split())
"""Ids of the catalogue that a simulated machine may hide, in its order."""

Method = Literal[
    "weighted",
    "ordinary",
    "robust",
    "ridge",
    "iv",
    "iv-direct",
    "didim",
    "didim-robust",
    "consistent",
    "iv-consistent",
    "iv-direct-consistent",
    "didim-consistent",
]
"""Estimators; `ABOUT` says what each is."""

ModelKind = Literal["torque", "energy"]
"""What a row of the fit states: a joint's torque, or the energy balance of a window."""

Precision = Literal["double", "single"]
"""Of the emitted C: its numbers are `double`, or `float`."""

Machine = Literal["cortex-m7", "cortex-m4", "host"]
"""What the cost of the emitted C is measured for; host: this machine."""

GAIN_METHOD = "tls"
"""Total least squares, for drive gains besides."""

TWO_STEPS = "two-step"
"""Each joint that moves alone, then the parameters."""

Derivatives = Literal["auto", "log", "position"]
"""Whether velocities are taken from the log or differentiated; auto: the quieter."""

LOW_SPEED = 0.02
"""Rows below this share of a joint's top speed are left out, where friction depends on its sign."""


def list_builtin_robots() -> tuple[str, ...]:
    """Returns names of the built-in robots, sorted."""
    return tuple(sorted(file.stem for file in (_PACKAGE / "robot" / "library").glob("*.toml")))


def read_builtin_robot(name: str) -> str:
    """Returns the TOML text of a built-in robot.

    Raises:
        KeyError: there is none of that name.
    """
    if name not in list_builtin_robots():
        raise KeyError(name)
    return locate_builtin_robot(name).read_text(encoding="utf-8")


def locate_builtin_robot(name: str) -> Path:
    """Returns where the text of a built-in robot stands."""
    return _PACKAGE / "robot" / "library" / f"{name}.toml"


def read_template(name: str) -> str:
    """Returns the text of a robot file to start from, with what is to be put in marked by $."""
    return (_PACKAGE / "robot" / "templates" / f"{name}.toml").read_text(encoding="utf-8")


def list_papers() -> tuple[str, ...]:
    """Returns names of the papers that there are."""
    return tuple(sorted(path.stem for path in (_PACKAGE / "papers" / "library").glob("*.toml")))


@dataclass(frozen=True)
class EstimatorInfo(Document):
    """An estimator in words.

    Attributes:
        id: as typed.
        title: as in "weighted least squares".
        law: its equation.
        source: where it comes from.
        limitations: when not to use it.
        motion: what it assumes of the noise of the measured motion.
    """

    KEYS = "method=id title law source limitations motion"

    id: str
    title: str
    law: str
    source: str
    limitations: str
    motion: str

    @property
    def is_consistent(self) -> bool:
        """Returns True of estimators that end in physically consistent standard parameters."""
        return self.id.endswith("consistent")


_EVERY = {
    name: EstimatorInfo(
        name, **{**row, "motion": _CHOICES["motions"].get(row["motion"], row["motion"])}
    )
    for name, row in _CHOICES["estimators"].items()
}

ABOUT: dict[Method, EstimatorInfo] = {
    cast(Method, name): about for name, about in _EVERY.items() if name in get_args(Method)
}
"""By id, in the order in which they are reported."""

APART = (_EVERY[GAIN_METHOD], _EVERY[TWO_STEPS])
"""Beside the others: they take other logs."""


def find_estimator_title(method: str) -> str:
    """Returns the title of an estimator; the id itself if a later version wrote it."""
    return _EVERY[method].title if method in _EVERY else method
