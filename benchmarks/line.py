"""What one line of the benchmark is: keys that stay, unit, meaning, and how it is measured."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal


class Missing(Exception):
    """A peer or a tool that a line needs is not on this machine; says which."""


@dataclass(frozen=True)
class Key:
    """One number of the report.

    Attributes:
        name: dotted, e.g. "scalar_vs_pinocchio_gcc.puma560"; never renamed.
        unit: "x" for ratios.
        meaning: one sentence.
        must: what it has to reach; None if it is reported only.
        aim: what would be best.
        better: which way is better.
    """

    name: str
    unit: str
    meaning: str
    must: float | None = None
    aim: float | None = None
    better: Literal["more", "less"] = "less"


@dataclass(frozen=True)
class Line:
    """Numbers that are measured together.

    Attributes:
        keys: of the report.
        measure: gives {name: value, or why there is none}; `quick` asks for a tenth of the work.
        seconds: how long it takes, about.
    """

    keys: tuple[Key, ...]
    measure: Callable[[bool], Mapping[str, float | Missing]]
    seconds: float


def ratio(name: str, meaning: str, must: float | None = None, aim: float | None = None) -> Key:
    """A ratio of which more is better."""
    return Key(name, "x", meaning, must, aim, "more")
