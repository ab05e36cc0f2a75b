"""One hidden effect through the commands that are printed, up to a log that nothing has seen."""

import contextlib
import io
import json
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from scipy.signal import lfilter

from modeler.cli import main

LAG = "torque_lag"
"""Not in the simulator: the logged torque of a clean machine through a first-order filter."""
LAG_SECONDS = 0.015
ROBOT_EFFECTS = ("payload", "base_tilt", "external_force", "drift", "time_delay")
"""They are of the whole robot, not of a joint."""
TEXTBOOK = ("rotor_inertia", "viscous", "coulomb", "offset")
"""They are in the robot files: the machine has them anyway, and the fit is told to lack one."""
LOGS = {"train": 1, "other": 2, "third": 3}
"""Log -> seed of its motion and noise; the machine is the same."""


@dataclass(frozen=True)
class Case:
    """What is hidden where, and by what encoders it is seen."""

    effect: str
    robot: str = "demo-arm"
    joint: str = "2"
    counts: int = 1_000_000
    machine: int = 0


@dataclass(frozen=True)
class Outcome:
    """What came of it; errors are shares of the torque, of the joint that the effect spoils most.

    Attributes:
        verdict: of `diagnose`, and the first effect it names.
        next_line: the command it prints.
        status: exit status of that.
        spoilt: error of the fitted model on the third log.
        promised: error on held-out logs with the effects named, as `diagnose` says.
        added: error on the third log by the model of the printed command; NaN: it adds none.
        floor: error on the third log of the same machine without the effect.
    """

    verdict: str
    next_line: str
    status: int
    spoilt: float
    promised: float
    added: float
    floor: float

    @property
    def ratio(self) -> float:
        """Error with what was added over that of the machine without the effect."""
        return self.added / self.floor


def judge(case: Case) -> Outcome:
    """Runs the commands of one case in a folder of its own."""
    floors = measure_clean(replace(case, effect=""))
    with TemporaryDirectory() as name, contextlib.chdir(name):
        write_logs(case)
        run(f"fit {case.robot} train.parquet --out model.json {leave_out(case.effect)}")
        spoilt = compare("model.json")
        printed = run("diagnose model.json train.parquet --holdout other.parquet --json said.json")
        said = json.loads(Path("said.json").read_text("utf-8"))
        joint = max(spoilt, key=lambda name: spoilt[name] / floors[name])
        first = said["effects"][0] if said["effects"] else None
        verdict = said["verdict"]
        if first is not None:
            verdict += f": {first['effect']}" + (f"@{first['joint']}" if first["joint"] else "")
        line = next((x for x in printed.splitlines() if x.startswith("next: modeler ")), "")
        words, status, added = shlex.split(line)[2:], 0, {joint: np.nan}
        if words:
            status, _ = run_command(words)
        if words[:1] == ["add"] and status == 0:
            added = compare(words[words.index("--out") + 1])
        promised = said["joints"][joint]["error_after"]
    return Outcome(verdict, line, status, spoilt[joint], promised, added[joint], floors[joint])


def leave_out(effect: str) -> str:
    """Returns the option by which a fit lacks an effect that its robot file has."""
    others = ",".join(name for name in TEXTBOOK if name != effect)
    return f"--effects {others}" if effect in TEXTBOOK else ""


@cache
def measure_clean(case: Case) -> Mapping[str, float]:
    """Error of each joint on the third log of a machine without the effect, by a fit of its own."""
    with TemporaryDirectory() as name, contextlib.chdir(name):
        write_logs(case)
        run(f"fit {case.robot} train.parquet --out model.json")
        return compare("model.json")


def write_logs(case: Case) -> None:
    """Simulates the logs of a case into the folder."""
    hidden = case.effect if case.effect in ROBOT_EFFECTS else f"{case.effect}@{case.joint}"
    hide = "" if case.effect in ("", LAG, *TEXTBOOK) else f"--hide {hidden}"
    for name, seed in LOGS.items():
        clean = case.effect == "external_force" and name == "third"  # another push is no error
        run(
            f"simulate {case.robot} {'' if clean else hide} --rate 500 --seed {seed} "
            f"--parameter-seed {case.machine} --encoder-counts {case.counts} --out {name}.parquet"
        )
        if case.effect == LAG:
            table = pq.read_table(f"{name}.parquet")
            columns = {key: table[key].to_numpy().copy() for key in table.column_names}
            tau, keep = columns[f"tau{case.joint}"], np.exp(-1.0 / 500.0 / LAG_SECONDS)
            columns[f"tau{case.joint}"] = lfilter([1 - keep], [1, -keep], tau, zi=[keep * tau[0]])[
                0
            ]
            pq.write_table(pa.table(columns), f"{name}.parquet")


def compare(model: str) -> dict[str, float]:
    """Errors of the joints on the third log."""
    run(f"compare {model} third.parquet --json compared.json")
    joints = json.loads(Path("compared.json").read_text("utf-8"))["joints"]
    return {name: joint["relative_error"] for name, joint in joints.items()}


def run(words: str) -> str:
    """Runs a command that must succeed, and returns what it prints."""
    status, printed = run_command(shlex.split(words))
    assert status == 0, (words, printed)
    return printed


def run_command(words: list[str]) -> tuple[int, str]:
    """Returns the exit status of a command, and what it prints."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        try:
            status = main(words)
        except SystemExit as end:
            status = int(end.code or 0)
    return status, printed.getvalue()


def draw_cases(effects: list[str], robots: list[str], counts: list[int]) -> Iterator[Case]:
    """Yields every effect on three joints of each robot, by each encoder."""
    for effect in effects:
        for robot in robots:
            for joint in ("1", "2", "3")[: 1 if effect in ROBOT_EFFECTS else 3]:
                for each in counts:
                    yield Case(effect, robot, joint, each)
