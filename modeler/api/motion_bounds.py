"""Bounds of a motion: limits of joints, boxes of frames, clearance of links; their check."""

import dataclasses
import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler import excitation, formats, simulation
from modeler.api.thresholds import THRESHOLDS
from modeler.api.workflow import compile_model, derive, generate
from modeler.core.errors import DataError
from modeler.core.expression import parse_expression
from modeler.core.json import Document
from modeler.core.options import OptionError
from modeler.robot import Limits, Robot, suggest_name
from modeler.runtime import CompiledModel

Assignments = Mapping[str, Sequence[float]] | Sequence[str]
"""Numbers by joint or frame, or texts of the form NAME=NUMBER,NUMBER; angles also as "90 deg"."""


def build_bounds(
    robot: Robot,
    compiled: CompiledModel,
    limits: Assignments,
    boxes: Assignments,
    clearance: float | None = None,
) -> excitation.MotionBounds:
    """Returns the limits of the robot file, replaced by given ones.

    Args:
        robot: as loaded.
        compiled: the same.
        limits: as of `excite`.
        boxes: as of `excite`.
        clearance: as of `excite`.

    Raises:
        DataError: another number of values, or no number; a joint or frame that is not there.
        RobotError: an empty range.
    """
    coordinates = [joint.name for joint in compiled.spec.joints]
    moving = [joint.name for joint in robot.moving_joints]
    form = "LOWER,UPPER,SPEED,ACCELERATION"
    changes, torques = {}, {}
    for name, values in parse_assignments("limits", limits, moving, (4, 5), form).items():
        changes[name] = Limits(*values[:4])
        if len(values) == 5:
            torques[name] = values[4]
    every = simulation.collect_motion_limits(robot, changes)
    of = {name: every[moving.index(name)] for name in moving}
    lower, upper, speed, acceleration = np.array(
        [dataclasses.astuple(of[name])[:4] for name in coordinates]
    ).T
    closure, home = compiled.spec.closure, None
    passive: list[tuple[int, float, float]] = []
    if closure is not None:
        home = np.array(closure.home)[list(closure.actuated)]
        stated = {**robot.limits, **changes}
        passive = [
            (place, stated[name].lower, stated[name].upper)
            for place, name in enumerate(closure.variables)
            if place not in closure.actuated and name in stated
        ]
    corners = parse_assignments("boxes", boxes, moving, (6,), "X0,X1,Y0,Y1,Z0,Z1")
    bounds = excitation.MotionBounds(
        *(tuple(coordinates), lower, upper, speed, acceleration),
        torque=np.array([torques.get(name, np.inf) for name in coordinates]),
        boxes=tuple(
            excitation.Box(name, moving.index(name), (x[0], x[2], x[4]), (x[1], x[3], x[5]))
            for name, x in corners.items()
        ),
        passive=tuple(passive),
        home=home,
        assumed=tuple(name for name in coordinates if name not in {**robot.limits, **changes}),
    )
    return add_clearance(robot, compiled, bounds, clearance)


def parse_assignments(
    option: str, given: Assignments, names: Sequence[str], counts: Sequence[int], form: str
) -> dict[str, list[float]]:
    """Returns the numbers by joint or frame.

    Args:
        option: name of the argument, for messages.
        given: a mapping, or texts.
        names: that there are.
        counts: how many numbers each may have.
        form: of these, for messages.

    Raises:
        DataError: another number of values, or no number; a joint or frame that is not there.
    """
    texts = (given,) if isinstance(given, str) else given
    pairs = texts.items() if isinstance(texts, Mapping) else (t.partition("=")[::2] for t in texts)
    result = {}
    for name, cells in pairs:
        where = f"{{--{option}}} {name}={cells}"
        try:
            parts = cells.split(",") if isinstance(cells, str) else cells
            values = [_parse_number(part) for part in parts]
        except (ValueError, ArithmeticError):
            values = []
        if len(values) not in counts or any(math.isnan(value) for value in values):
            raise OptionError(f"{where}: expected {names[0]}={form}, numbers in SI units")
        if name not in names:
            raise OptionError(
                f"{where}: no moving joint {name}{suggest_name(name, names)}; expected one of "
                f"{', '.join(names)}"
            )
        result[name] = values
    return result


def _parse_number(cell: str | float) -> float:
    """A number, or an angle as `90 deg` or `pi/2`."""
    try:
        return float(cell)
    except ValueError:
        expression = parse_expression(str(cell))
        if expression.names:
            raise
        return expression.evaluate()


def add_clearance(
    robot: Robot, compiled: CompiledModel, bounds: excitation.MotionBounds, margin: float | None
) -> excitation.MotionBounds:
    """Adds the minimum distance between links to the bounds.

    Looked at are all links that share no joint and touch in some postures only.

    Args:
        robot: its [capsules]; without, as `capsules_on_links` draws them.
        compiled: the same.
        bounds: ranges, from which postures are drawn.
        margin: m; None: 0.01 if the robot file has [capsules], else links are not looked at.

    Raises:
        DataError: a margin below 0.
    """
    if margin is None:
        if not (robot.capsules or robot.planes):
            return bounds
        margin = THRESHOLDS.link_clearance
    if not 0.0 <= margin < math.inf:
        raise DataError(f"clearance: got {margin:g} m; expected 0 or more")
    ranges = np.stack([bounds.lower, bounds.upper])
    solids = _collect_solids(robot, compiled)
    clearance = excitation.exclude_neighbours(compiled, solids, margin, ranges, bounds.home)
    return dataclasses.replace(bounds, clearance=clearance)


def _collect_solids(robot: Robot, compiled: CompiledModel) -> excitation.CollisionGeometry:
    """All capsules, and all pairs of links that share no joint."""
    moving, closure = [joint.name for joint in robot.moving_joints], compiled.spec.closure
    at = {} if closure is None else dict(zip(closure.variables, closure.home, strict=True))
    shapes = formats.locate_capsules(robot, at)
    on, links = {row: carrier for row, carrier, _ in shapes}, [carrier for _, carrier, _ in shapes]
    joined = {frozenset((on.get(j.name), on.get(j.antecedent))) for j in robot.joints}
    joined |= {frozenset((on.get(loop.frame), on.get(loop.meets))) for loop in robot.loops}
    pairs = [
        (i, k)
        for i, k in itertools.combinations(range(len(links)), 2)
        if links[i] != links[k] and frozenset((links[i], links[k])) not in joined
    ]
    moves = [i for i, link in enumerate(links) if link in moving]
    pairs += [(i, len(links) + k) for i in moves for k in range(len(robot.planes))]
    planes = np.array([*robot.planes.values()]).reshape(-1, 4)
    planes /= np.linalg.norm(planes[:, :3], axis=1)[:, None]
    places = [moving.index(link) if link in moving else excitation.BASE for link in links]
    return excitation.CollisionGeometry(
        (*("base" if row == "0" else row for row, *_ in shapes), *robot.planes),
        np.array(places + [excitation.BASE] * len(planes)),
        np.array([(shape.start, shape.end) for *_, shape in shapes]),
        np.array([shape.radius for *_, shape in shapes] + [0.0] * len(planes)),
        *(planes[:, :3], planes[:, 3], np.array(pairs, dtype=int).reshape(-1, 2)),
    )


def find_nearest_along(
    compiled: CompiledModel, clearance: excitation.Clearance, motion: simulation.Reference
) -> excitation.ClosestApproach | None:
    """Finds the two nearest links along a motion; None without pairs to check."""
    if not len(clearance.solids.pairs):
        return None
    curve, samples = (
        simulation.build_curve(motion),
        max(excitation.THRESHOLDS.clearance_samples, 2 * len(motion.time)),
    )
    return excitation.find_closest_approach(
        compiled, clearance.solids, curve, float(motion.time[-1]), samples
    )


@dataclass(frozen=True, eq=False)
class MotionCheck(Document):
    """How a motion keeps to the limits, and how near two links come along it.

    Attributes:
        place: of the motion.
        robot: whose.
        clearance: that links are to keep.
        closest_approach: of two links; None if no two are looked at.
        excess: limits that are exceeded.
        is_measured: True for a log, whose speeds are noisy.
        assumed: joints whose limits nobody states.
    """

    KEYS = "robot=robot.name clearance=clearance_report exceeded_limits=excess"

    place: str
    robot: Robot
    clearance: excitation.Clearance
    closest_approach: excitation.ClosestApproach | None
    excess: Sequence[excitation.LimitExcess]
    is_measured: bool
    assumed: Sequence[str]

    def format_lines(self) -> list[str]:
        """Returns the limits that are exceeded, and what comes nearest."""
        lines = [f"{self.place}: {each.format_line()}" for each in self.excess]
        if not lines:
            lines = [f"{self.place}: within the limits of position, speed and acceleration"]
        if self.assumed:
            joints = ", ".join(self.assumed)
            lines.append(f"joint {joints}: no [limits] in the robot file; these are assumed")
        return [*lines, f"{self.place}: {self.clearance.format_line(self.closest_approach)}"]

    def require_passed(self) -> None:
        """Raises an error if two links come too near, or a limit is exceeded."""
        near, margin = self.closest_approach, self.clearance.margin
        if near is not None and near.bound < margin:
            raise OptionError(
                f"{self.place}, {near.time:.4g} s: {near.pair[0]} and {near.pair[1]} are "
                f"{1e3 * near.distance:.1f} mm apart; expected {1e3 * margin:g} mm or more; take "
                "another motion, or a smaller {--clearance}"
            )
        wrong = [x for x in self.excess if not (self.is_measured and "speed at" in x.quantity)]
        if wrong:
            raise OptionError(
                f"{self.place}, {wrong[0].format_line()}; limits exceeded: {len(wrong)}; take "
                "another motion, or state other limits: [limits] of the robot file, or {--limits}"
            )

    @property
    def clearance_report(self) -> excitation.ClearanceReport:
        """Returns the clearance, and what comes nearest."""
        return excitation.ClearanceReport(self.clearance, self.closest_approach)


def judge_motion(
    robot: Robot,
    compiled: CompiledModel,
    bounds: excitation.MotionBounds,
    place: str,
    limits: Sequence[str] = (),
) -> MotionCheck:
    """Checks whether the motion of a file keeps to the limits, and links keep their distance."""
    clearance, joints = bounds.clearance, compiled.spec.joints
    assert clearance is not None
    motion = simulation.read_motion(place, bounds.joints)
    stated = (motion.qd, motion.qdd) if motion.is_complete else None
    units = tuple(joint.unit for joint in joints)
    excess = excitation.find_exceeded_limits(bounds, units, motion.time, motion.q, stated)
    near = find_nearest_along(compiled, clearance, motion)
    typed = {text.partition("=")[0] for text in limits}
    assumed = [name for name in bounds.joints if name not in {*robot.limits, *typed}]
    return MotionCheck(place, robot, clearance, near, excess, motion.is_measured, assumed)


def check_motion(
    robot: Robot, motion: str | Path, *, clearance: float = THRESHOLDS.link_clearance
) -> excitation.ClosestApproach | None:
    """Finds where a motion brings two links, or a link and a plane, closest together.

    >>> check_motion(robot, "mon.parquet").pair  # its two links share a joint
    ('base', '2')

    Args:
        robot: its [capsules] are what links fill; without, as `modeler excite` takes them.
        motion: file of a motion or log, .csv or .parquet; commanded positions, if it has them.
        clearance: m; pairs that are nearer in nearly all postures are left out.

    Returns:
        None if no two are left to look at.

    Raises:
        DataError: the file has no motion of this robot.
    """
    compiled = compile_model(generate(derive(robot)))
    bounds = build_bounds(robot, compiled, (), (), clearance)
    assert bounds.clearance is not None
    names = [joint.name for joint in compiled.spec.joints]
    return find_nearest_along(compiled, bounds.clearance, simulation.read_motion(motion, names))
