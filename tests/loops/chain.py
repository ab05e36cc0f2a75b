"""A robot with loops through the whole story: simulate, fit, compare, diagnose, add, diagnose."""

import contextlib
import dataclasses
import io
import json
from collections.abc import Mapping
from pathlib import Path

from modeler.cli import main
from modeler.robot.read import read_robot
from modeler.robot.robot import Robot

RATE = "200"
EFFECT = "asymmetric_viscous"


@dataclasses.dataclass
class Chain:
    """How the story went.

    Attributes:
        robot: its name.
        hidden: effect and joint that the robot file lacks.
        statuses: exit status by step, of the steps that were run.
        message: last line on standard error of the step that failed.
        errors: over all joints on motion not fitted to: as fitted, and after adding.
        found: effect and joint of every finding, the surest first.
        left: the same after adding.
    """

    robot: str
    hidden: tuple[str, str]
    statuses: dict[str, int] = dataclasses.field(default_factory=dict)
    message: str = ""
    errors: tuple[float, ...] = ()
    found: tuple[tuple[str, str | None], ...] = ()
    left: tuple[tuple[str, str | None], ...] = ()

    @property
    def named(self) -> bool:
        """True if the first finding is the hidden effect on its joint."""
        return self.found[:1] == (self.hidden,)


def chain(source: str, folder: Path, joint: str | None = None) -> Chain:
    """The story of a robot, in a folder; it ends with the first step that fails.

    Args:
        source: name of a built-in robot, or a robot file.
        folder: for logs and models.
        joint: with a motor; None: the second one that has one, or the only one.
    """
    robot = read_robot(source)
    story = Chain(robot.name, (EFFECT, joint or _second(robot)))
    place = {name: str(folder / name) for name in ("a.csv", "b.csv", "m.json", "m2.json", "out")}
    own = () if robot.effects else ("--effects", "viscous,coulomb")
    duration = "8" if len(robot.coordinates) > 1 else "20"  # one motor gives one row a sample
    hide = ("--hide", "@".join(story.hidden), "--duration", duration, "--rate", RATE)
    a, held = place["a.csv"], ("--holdout", place["b.csv"])
    steps = {
        "simulate": ("simulate", source, *own, *hide, "--seed", "1", "--out", a),
        "simulate 2": ("simulate", source, *own, *hide, "--seed", "2", "--out", place["b.csv"]),
        "fit": ("fit", source, *own, a, "--out", place["m.json"]),
        "compare": ("compare", place["m.json"], place["b.csv"]),
        "diagnose": ("diagnose", place["m.json"], a, *held),
        "add": ("add", place["m.json"], "auto", a, *held, "--out", place["m2.json"]),
        "again": ("diagnose", place["m2.json"], a, *held),
    }
    told: dict[str, Mapping] = {}
    for step, words in steps.items():
        said, erred = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(erred):
            status = main([*words, "--json", place["out"]])
        story.statuses[step] = status
        if status:
            story.message = erred.getvalue().strip().splitlines()[-1]
            break
        told[step] = json.loads(Path(place["out"]).read_text())
    _fill(story, told)
    return story


def _second(robot: Robot) -> str:
    """The second joint with a motor, or the only one."""
    names = [joint.name for joint in robot.coordinates if joint.actuated]
    return names[min(1, len(names) - 1)]


def _fill(story: Chain, told: Mapping[str, Mapping]) -> None:
    """What the steps told."""
    if "diagnose" in told:
        story.found = _findings(told["diagnose"])
    if "add" in told:
        story.errors = tuple(step["error"] for step in told["add"]["waterfall"])
    if "again" in told:
        story.left = _findings(told["again"])


def _findings(diagnosis: Mapping) -> tuple[tuple[str, str | None], ...]:
    return tuple((f["effect"], f["joint"]) for f in diagnosis["effects"])
