"""A robot with loops through the whole story: simulate, fit, compare, diagnose, add, diagnose."""

import json
from pathlib import Path

from modeler.cli import main
from modeler.robot.read import read_robot

EFFECT = "asymmetric_viscous"


def check_chain(source: str, folder: Path) -> None:
    """A hidden friction of the second motor is named first, added, and gone after.

    Args:
        source: name of a built-in robot, or a robot file.
        folder: for logs and models.
    """
    robot = read_robot(source)
    motors = [joint.name for joint in robot.coordinates if joint.actuated]
    hidden = (EFFECT, motors[min(1, len(motors) - 1)])
    a, b, m, m2, out = (str(folder / n) for n in ("a.csv", "b.csv", "m.json", "m2.json", "out"))
    own = () if robot.effects else ("--effects", "viscous,coulomb")
    seconds = "6" if len(robot.coordinates) > 1 else "20"  # one motor gives one row a sample
    hide = ("--hide", "@".join(hidden), "--duration", seconds, "--rate", "150")

    def told(*words: str) -> dict:
        assert main([*words, "--json", out]) == 0, words
        return json.loads(Path(out).read_text())

    def effects(*words: str) -> list[tuple[str, str | None]]:
        return [(f["effect"], f["joint"]) for f in told("diagnose", *words)["effects"]]

    told("simulate", source, *own, *hide, "--seed", "1", "--out", a)
    told("simulate", source, *own, *hide, "--seed", "2", "--out", b)
    told("fit", source, *own, a, "--out", m)
    told("compare", m, b)
    assert effects(m, a, "--holdout", b)[:1] == [hidden]
    steps = told("add", m, "auto", a, "--holdout", b, "--out", m2)["waterfall"]
    assert steps[-1]["error"] < steps[0]["error"]
    assert hidden not in effects(m2, a, "--holdout", b)
