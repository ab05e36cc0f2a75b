"""Status 0 means closed, every equation as written, on the branch connected with home.

Random postures near and far, and random paths, against the table's kinematics in plain numpy and a
continuation in small steps.
"""

import itertools
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.api import compile_model
from modeler.base import base_parameters
from modeler.codegen import emit
from modeler.derivation import derive, generate
from modeler.robot import builtin_names, read_robot, robot_from_text
from modeler.symbolic import SymbolicModel
from modeler.symbolic.columns import standard_columns
from modeler.symbolic.geometry import exact_geometry
from modeler.symbolic.graph import Graph
from tests.loops.table_kinematics import Table

ALIKE = ("orthoglide-2003-similar-legs",)  # the same loops as another's
BUILT_IN = [name for name in builtin_names() if read_robot(name).loops and name not in ALIKE]
OUTSIDE = ["3rpr_sim", "excavator", "excavator_bucket", "offset_parallelogram",
           "rccc", "rccc_wide", "twoloops", "twoloops_mixed", "twoloops_poorhome"]  # fmt: skip

POSTURES, PATHS, LENGTH = 60, 2, 60
OPEN = 1e-8  # sizes of the robot, or 1
STEPS = 60  # of the continuation
CLEAR = 0.02  # smallest singular value on the way above which nobody may be refused


class Closed:
    """A robot with loops, compiled, beside its table."""

    def __init__(self, robot) -> None:
        derivation = derive(robot)
        self.closure = derivation.model.closure
        self.table = Table(derivation.robot)
        self.stated = [joint.name for joint in derivation.model.robot.free]
        if self.closure is not None:
            self.compiled = compile_model(generate(derivation))
            self.home = self.whole(np.array(self.closure.home)[None], derivation.model.robot)[0]
        self.model_robot = derivation.model.robot

    def whole(self, u: np.ndarray, robot=None) -> np.ndarray:
        """Free variables of the robot as written, from those that the relations found leave."""
        robot = robot or self.model_robot
        values = dict(self.table.symbols)
        values |= {f"q{name}": u[:, k] for k, name in enumerate(self.stated)}
        waiting = dict(robot.relations)
        while waiting:
            for name in [k for k, r in waiting.items() if r.names <= values.keys()]:
                values[f"q{name}"] = self.table._value(waiting.pop(name), values)
        return np.stack(
            [np.broadcast_to(values[f"q{j.name}"], len(u)) for j in self.table.robot.free], axis=1
        )

    def follow(self, q: np.ndarray) -> np.ndarray:
        """Postures along a path, each closed from the one before; up to where it ends."""
        found, u = [], np.array(self.closure.home)
        out, status = np.empty((1, len(u))), np.zeros(1, dtype=np.intc)
        library = self.compiled._library
        function = next(f for f in library.spec.functions if f.name.endswith("close_from"))
        for row in q:
            library.batch(function, [row[None].copy(), u[None].copy()], out, status)
            if status[0]:
                break
            u = out[0].copy()
            found.append(u)
        return self.whole(np.array(found).reshape(len(found), len(u)))

    def ranges(self) -> tuple[np.ndarray, np.ndarray]:
        """Of the coordinates: half a turn or half a size around home."""
        middle = self.home[self.table.given]
        joints = self.table.robot.coordinates
        reach = np.array([1.5 if j.angular else 0.5 * self.table.size for j in joints])
        return middle - reach, middle + reach


def judge(closed: Closed, seed: int) -> tuple[int, int, int, int]:
    """(status 0 and open, status 0 on another branch, refused though clear, clear) of postures."""
    table, rng = closed.table, np.random.default_rng(seed)
    low, high = closed.ranges()
    near = rng.uniform(0.05, 1.0, (POSTURES, 1))
    q = closed.home[table.given] + near * (rng.uniform(low, high, (POSTURES, len(low)))
                                           - closed.home[table.given])  # fmt: skip
    status = closed.compiled.closing_status(q)
    done = status == 0
    u = closed.whole(closed.compiled.close(q[done]))
    open_ = np.max(np.abs(table.errors(u)), axis=1) > OPEN
    way, distance = table.followed(closed.home, q, STEPS)
    clear = np.isfinite(way[:, 0]) & (distance > CLEAR)
    told = clear[done]
    other = np.max(np.abs(u - way[done]) / table.scale, axis=1)[told] > 1e-5
    refused = clear & ~done
    return int(open_.sum()), int(other.sum()), int(refused.sum()), int(clear.sum())


def walk(closed: Closed, seed: int) -> tuple[int, int]:
    """(samples with status 0 that are open, leaps from one to the next) along smooth paths."""
    table, rng = closed.table, np.random.default_rng(seed)
    low, high = closed.ranges()
    t = np.linspace(0.0, 2 * np.pi, LENGTH)[:, None]
    open_ = leaps = 0
    for _ in range(PATHS):
        phase = rng.uniform(0, 2 * np.pi, len(low))
        wave = np.sin(rng.integers(1, 3, len(low)) * t + phase) - np.sin(phase)
        q = closed.home[table.given] + 0.2 * (high - low) * wave
        u = closed.follow(q)
        open_ += int(np.sum(np.max(np.abs(table.errors(u)), axis=1) > OPEN))
        # A passive joint is as fast as the actuated ones, times what the Jacobian says.
        for before, after in itertools.pairwise(u):
            inner = np.linalg.svd(table.slopes(before[None], table.solved)[0], compute_uv=False)
            step = np.max(np.abs((after - before) / table.scale)[table.given], initial=0.0)
            bound = 10.0 * (step + 1e-9) / max(float(inner[-1]), 1e-6)
            leaps += bool(np.max(np.abs(after - before) / table.scale) > max(bound, 0.05))
    return open_, leaps


@cache
def closed_robot(name: str, folder: Path | None = None) -> Closed:
    return Closed(read_robot(name if folder is None else folder / f"{name}.toml"))


def check(closed: Closed, name: str) -> None:
    if closed.closure is None:
        return  # relations say all that the loops do: nothing is left to close
    seed = int.from_bytes(name.encode()) % 2**32
    open_, other, refused, clear = judge(closed, seed)
    assert (open_, other) == (0, 0)
    assert refused <= 1e-3 * clear and clear > 0.02 * POSTURES
    assert walk(closed, seed) == (0, 0)


@pytest.mark.parametrize("name", BUILT_IN)
def test_status_0_is_closed_on_the_branch_of_home(name):
    check(closed_robot(name), name)


@pytest.mark.parametrize("name", OUTSIDE)
def test_status_0_is_closed_on_the_branch_of_home_elsewhere(name, loop_robots_folder):
    check(closed_robot(name, loop_robots_folder), name)


def test_a_way_through_a_bifurcation_ends_there():
    """Four equal bars folded flat can go on as a parallelogram or crossed: neither is chosen."""
    robot = robot_from_text(RHOMBUS, "rhombus")
    model = _without_relations(robot)
    closed = compile_model(emit(model, base_parameters(model)))
    q = np.linspace(1.0, -1.0, 41)[:, None]
    status = closed.closing_status(q)
    assert np.all(status[q[:, 0] > 0.01] == 0) and np.all(status[q[:, 0] < -0.01] != 0)


RHOMBUS = """
name = "rhombus"
gravity = [0, 0, 0]
[symbols]
L = 0.5
[mdh]
columns = ["j", "a", "mu", "sigma", "d", "theta"]
rows = [
  ["1", "0", 1, 0, 0, "q1"],
  ["2", "1", 0, 0, "L", "q2"],
  ["3", "2", 0, 0, "L", "q3"],
  ["4", "3", 0, 2, "L", 0],
  ["5", "0", 0, 2, "L", 0],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["A", "4", "5", "position"]]
[home]
q1 = 1.0
q2 = -1.0
q3 = -2.1415926535897931
"""


def _without_relations(robot) -> SymbolicModel:
    geometry = exact_geometry(robot)
    return SymbolicModel(robot, geometry, Graph(), standard_columns(geometry))
