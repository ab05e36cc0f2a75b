"""Status 0 means closed, every equation as written, on the branch connected with home.

Random postures near and far, and random paths, against the oracle's kinematics and a continuation
in small steps.
"""

from collections.abc import Iterator
from copy import copy
from dataclasses import astuple, dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.emit import emit
from modeler.codegen.workflow import Derivation
from modeler.derivation.assembly_modes import find_modes_near
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.geometry import build_exact_geometry
from modeler.derivation.graph import Graph
from modeler.derivation.model import SymbolicModel, build_standard_columns
from modeler.robot.read import parse_robot_text, read_robot
from tests.loops.derived import WEIGHED, compiled_plainly, of_drawing, of_file
from tests.modules import loaded, module, plain
from tests.oracles.closed_ways import followed, open_at
from tests.oracles.complex_step import Oracle
from tests.robot_texts import RHOMBUS
from tests.robots import LOOPED, one_always
from tests.rotation import ROTATING, rotating

SAME = ("orthoglide-2003-similar-legs",)  # the same loops as another's
BUILT_IN = one_always((name for name in LOOPED if name not in SAME), "five-bar")
FOLDER = "loop_robots_folder"
OUTSIDE = [
    *rotating("rccc_wide", "offset_parallelogram", "twoloops"),
    *(pytest.param(n, marks=ROTATING) for n in ("3rpr_sim", "excavator_bucket")),
]

POSTURES, PATHS, LENGTH = 40, 1, 60
OPEN = 1e-9  # sizes of the robot, or 1
STEPS = 60  # of the continuation
SHORT = 6  # of it from one sample of a path to the next
FINE = (600, 2000)  # where the way comes near a singularity
CLEAR = 0.02  # smallest singular value on the way above which nobody may be refused
ALIKE = 1e-5  # sizes of the robot, or rad: postures that are the same
ROUNDING = 1e-7  # of the continuation, amplified near a singularity
NEAR = 1e-3  # and by no more than this


class Closed:
    """A robot with loops, compiled, beside its oracle."""

    def __init__(self, derivation, compiled=None) -> None:
        self.closure = derivation.model.closure
        self.oracle, self.model = Oracle(derivation.robot), Oracle(derivation.model.robot)
        if self.closure is not None:
            self.compiled = compiled or compiled_plainly(derivation)
            self.home = self.whole(np.array(self.closure.home)[None])[0]

    def whole(self, u: np.ndarray) -> np.ndarray:
        """Free variables of the robot as written, from those that the relations found leave."""
        values = self.model.variables(u)
        return np.stack([values[joint.name] for joint in self.oracle.robot.free_joints], axis=1)

    def from_home(self, q: np.ndarray) -> np.ndarray:
        """Postures (n, len(u)), NaN where the status is not 0."""
        done = self.compiled.closing_status(q) == 0
        u = np.full((len(q), len(self.home)), np.nan)
        u[done] = self.whole(self.compiled.close(q[done]))
        return u

    def related(self, rng: np.random.Generator, count: int) -> np.ndarray:
        """Random postures of a robot whose relations say all."""
        free = self.model.robot.free_joints
        reach = [1.0 if joint.is_revolute else 0.3 * self.oracle.size for joint in free]
        return self.whole(rng.uniform(-np.pi, np.pi, (count, len(free))) * reach)

    def follow(self, q: np.ndarray) -> np.ndarray:
        """Postures along a path, each closed from the one before; the last may be refused: NaN."""
        items, u = [], np.array(self.closure.home)
        out, status = np.empty((1, len(u))), np.zeros(1, dtype=np.intc)
        library = self.compiled._library
        function = next(f for f in library.spec.functions if f.name.endswith("close_from"))
        for row in q:
            library.run_batch(function, [row[None].copy(), u[None].copy()], out, status)
            u = out[0].copy() if status[0] == 0 else np.full(len(u), np.nan)
            items.append(u)
            if status[0]:
                break
        return self.whole(np.array(items).reshape(len(items), len(u)))

    def ranges(self) -> tuple[np.ndarray, np.ndarray]:
        """Of the coordinates: half a turn or half a size around home."""
        middle = self.home[self.oracle.given]
        joints = self.oracle.robot.coordinates
        reach = np.array([1.5 if j.is_revolute else 0.5 * self.oracle.size for j in joints])
        return middle - reach, middle + reach


@dataclass(frozen=True)
class Verdict:
    """How many postures break the law, and how many there were.

    Attributes:
        open: status 0, and a loop as written is open.
        other: status 0, and not where the continuation from the start leads.
        refused: no status 0, though the continuation arrives, far from singularities.
        clear: postures where it does.
        done: postures with status 0.
    """

    open: int
    other: int
    refused: int
    clear: int
    done: int

    def __add__(self, more: "Verdict") -> "Verdict":
        return Verdict(*(a + b for a, b in zip(astuple(self), astuple(more), strict=True)))


def judged(oracle, start, q, u, steps=STEPS):
    """Postures u (n, len(u)), NaN where there is no status 0, against straight ways from start.

    Args:
        oracle: of the robot.
        start: (len(u),) or (n, len(u)) closed postures.
        q: (n, given) where the ways lead.
        u: what the emitted C says.
        steps: of the continuation.
    """
    start = np.broadcast_to(start, u.shape)
    done = np.isfinite(u[:, 0])
    open_ = np.max(np.abs(open_at(oracle, u[done])), axis=1) > OPEN
    way, distance = followed(oracle, start, q, steps)
    clear = np.isfinite(way[:, 0]) & (distance > CLEAR)
    confirmed = clear & _same(oracle, u, way, distance)
    for fine in FINE:
        near = np.flatnonzero(done & ~clear & ~confirmed)
        if len(near):
            again = followed(oracle, start[near], q[near], fine)
            confirmed[near] = _same(oracle, u[near], *again)
    counts = (open_, done & ~confirmed, clear & ~done, clear, done)
    return Verdict(*(int(x.sum()) for x in counts))


def _same(oracle: Oracle, u: np.ndarray, way: np.ndarray, distance: np.ndarray) -> np.ndarray:
    apart = np.max(np.abs(u - way) / oracle.scale, axis=1)
    return apart < ALIKE + np.minimum(ROUNDING / np.maximum(distance, ROUNDING), NEAR)


def postures(closed: Closed, seed: int, count: int = POSTURES) -> Verdict:
    """Random postures, near home and far."""
    oracle, rng = closed.oracle, np.random.default_rng(seed)
    low, high = closed.ranges()
    near = rng.uniform(0.05, 1.0, (count, 1))
    here = closed.home[oracle.given]
    q = here + near * (rng.uniform(low, high, (count, len(low))) - here)
    return judged(oracle, closed.home, q, closed.from_home(q))


def paths(closed: Closed, seed: int, count: int) -> Iterator[np.ndarray]:
    """Smooth closed paths of the coordinates, (LENGTH, given) each, from home."""
    oracle, rng = closed.oracle, np.random.default_rng(seed)
    low, high = closed.ranges()
    t = np.linspace(0.0, 2 * np.pi, LENGTH)[:, None]
    for _ in range(count):
        phase = rng.uniform(0, 2 * np.pi, len(low))
        wave = np.sin(rng.integers(1, 3, len(low)) * t + phase) - np.sin(phase)
        yield closed.home[oracle.given] + 0.2 * (high - low) * wave


def along(oracle: Oracle, home: np.ndarray, q: np.ndarray, u: np.ndarray) -> Verdict:
    """Postures u along a path q, each against the way from the one before."""
    return judged(oracle, np.concatenate([home[None], u[:-1]]), q[: len(u)], u, SHORT)


def walk(closed: Closed, seed: int, count: int = PATHS) -> Verdict:
    """Smooth paths, until a sample is refused."""
    total = Verdict(0, 0, 0, 0, 0)
    for q in paths(closed, seed, count):
        total += along(closed.oracle, closed.home, q, closed.follow(q))
    return total


@cache
def closed_robot(name: str, folder: Path | None = None) -> Closed:
    if folder is not None:
        return Closed(of_file(folder / f"{name}.toml"))
    made = module(name)
    return Closed(Derivation(read_robot(name), made.model, made.base), plain(name))


def check(closed: Closed, name: str) -> None:
    seed = int.from_bytes(name.encode()) % 2**32
    if closed.closure is None:  # relations say all that the loops do
        u = closed.related(np.random.default_rng(seed), POSTURES)
        assert np.max(np.abs(open_at(closed.oracle, u))) < OPEN
        return
    result = postures(closed, seed)
    lawful(result)
    assert result.clear > 0.02 * POSTURES
    lawful(walk(closed, seed))


def lawful(found: Verdict) -> None:
    assert (found.open, found.other) == (0, 0), found
    assert found.refused <= 1e-3 * found.clear, found


@pytest.mark.parametrize("name", [*BUILT_IN, *OUTSIDE])
def test_status_0_is_closed_on_the_branch_of_home(name, request):
    inside = name in LOOPED
    check(closed_robot(name, None if inside else request.getfixturevalue(FOLDER)), name)


@pytest.mark.parametrize("kind", WEIGHED)
def test_status_0_is_closed_on_the_branch_of_home_on_drawn_robots(kind):
    check(Closed(of_drawing(kind)), kind)


def test_postures_of_another_branch_are_seen():
    """Of a start in the other assembly mode: the ways from there end elsewhere than the C does."""
    closed = copy(closed_robot("five-bar"))
    names = [joint.name for joint in closed.oracle.robot.free_joints]
    q = {names[k]: closed.home[k] for k in closed.oracle.given}
    modes = find_modes_near(closed.oracle.robot, q)
    mode = dict(zip([j.name for j in modes.linkage.free], modes.modes[1].posture, strict=True))
    closed.home = np.array([mode[name] for name in names])
    result = postures(closed, 1)
    assert result.open == 0 and result.other == result.done > 0.5 * POSTURES


def test_a_way_through_a_bifurcation_ends_there():
    """Four equal bars folded flat can go on as a parallelogram or crossed: neither is chosen."""
    robot = parse_robot_text(RHOMBUS, "rhombus")
    model = _without_relations(robot)
    closed = loaded(emit(model, derive_base_parameters(model)))
    q = np.linspace(1.0, -1.0, 41)[:, None]
    status = closed.closing_status(q)
    assert np.all(status[q[:, 0] > 0.01] == 0) and np.all(status[q[:, 0] < -0.01] != 0)


def _without_relations(robot) -> SymbolicModel:
    geometry = build_exact_geometry(robot)
    return SymbolicModel(robot, geometry, Graph(), build_standard_columns(geometry))
