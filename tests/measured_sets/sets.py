"""The measured sets: robot, what it is fitted to, what is held out; and the cases made of them."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from modeler.core.choices import read_builtin_robot
from tests.repository import ROOT

DATA = ROOT.parent / "shared" / "data"
"""The measured logs beside the checkout."""

PAGE = ROOT / "docs" / "studies" / "measured-sets.md"

DIRECTIONS = ("forward", "exchanged")
FACTORS = (1.0, 0.7, 1.4)


@dataclass(frozen=True)
class MeasuredSet:
    """One machine.

    Attributes:
        name: of its folder.
        robot: gives the robot file.
        training, held_out: logs without folder and ending; `name@start:end` is a piece.
    """

    name: str
    robot: Callable[[], str]
    training: tuple[str, ...]
    held_out: tuple[str, ...]

    def logs(self, data: Path, direction: str) -> tuple[list[str], list[str]]:
        """What is fitted and what is held out, as places; the other way round if exchanged."""
        pair = [
            [_place(data / self.name, log) for log in some]
            for some in (self.training, self.held_out)
        ]
        first, second = pair if direction == "forward" else pair[::-1]
        return first, second


@dataclass(frozen=True)
class Case:
    """One question.

    Attributes:
        set: name.
        direction: "forward", or "exchanged" with training and held-out logs in each other's place.
        factor: of both cut-offs, over those that the fit chooses; 1: they are chosen.
    """

    set: str
    direction: str
    factor: float = 1.0

    @property
    def name(self) -> str:
        """Short."""
        return f"{self.set}-{self.direction}-{self.factor:g}"


def _place(folder: Path, log: str) -> str:
    name, at, piece = log.partition("@")
    return f"{folder / name}.parquet{at}{piece}"


def _builtin(name: str) -> Callable[[], str]:
    return lambda: read_builtin_robot(name)


def _panda() -> str:
    """The built-in arm with friction; its sensors stand behind the gears and measure no rotor."""
    return read_builtin_robot("panda") + (
        '\n[effects]\nviscous = "all"\ncoulomb = "all"\noffset = "all"\n'
    )


def _dualarm7() -> str:
    """As the page of studies has it."""
    text = PAGE.read_text("utf-8")
    result = re.search(r"^```toml\n# dualarm7\.toml\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert result is not None
    return result[1]


def _ur10e(*names: str) -> tuple[str, ...]:
    return tuple(f"ur-20_{name}" for name in names)


_EVERY = (
    MeasuredSet("emps", _builtin("emps"), ("train",), ("pulses",)),
    MeasuredSet(
        "ur10e",
        _builtin("ur10e"),
        _ur10e("02_19_14harm50sec", "02_12-50sec_12harm", "02_05-20sec_8harm"),
        _ur10e("02_19_15harm50sec", "01_17-ptp_10_points"),
    ),
    MeasuredSet("tx40", _builtin("tx40"), ("log_joint@0:4.6",), ("log_joint@4.6:7.45",)),
    MeasuredSet(
        "odrive_cogging",
        _builtin("odrive"),
        ("slow2__nocomp_0", "slow2__nocomp_1"),
        ("slow2__nocomp_2",),
    ),
    MeasuredSet("dvrk_psm", _builtin("dvrk-psm"), ("one",), ("two",)),
    MeasuredSet(
        "kinova_gen3", _builtin("kinova_gen3"), ("traj_1", "traj_3", "traj_5"), ("traj_2", "traj_4")
    ),
    MeasuredSet("panda", _panda, ("excitation@:11.55",), ("excitation@11.55:",)),
    MeasuredSet("dualarm7", _dualarm7, ("excitation_13", "excitation_15"), ("excitation_52",)),
)
SETS = {item.name: item for item in _EVERY}
"""By name of the folder."""
