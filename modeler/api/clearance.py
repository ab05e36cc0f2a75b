"""Whether links run into each other: capsules of a robot, and the nearest two along a motion."""

import dataclasses
import itertools
import math

import numpy as np

from modeler import excitation, exports, simulation
from modeler.core.errors import DataError
from modeler.robot import Robot
from modeler.runtime import CompiledModel

USUAL = 0.01
"""m between links of a robot whose file has [capsules]."""


def add_clearance(
    robot: Robot, compiled: CompiledModel, bounds: excitation.MotionBounds, margin: float | None
) -> excitation.MotionBounds:
    """The bounds, and that links stay so far from each other.

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
        margin = USUAL
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
    shapes = exports.locate_capsules(robot, at)
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
        planes[:, :3], planes[:, 3], np.array(pairs, dtype=int).reshape(-1, 2),
    )  # fmt: skip


def find_nearest_along(
    compiled: CompiledModel, clearance: excitation.Clearance, motion: simulation.Reference
) -> excitation.ClosestApproach | None:
    """The nearest two along a motion; None if there are none to look at."""
    if not len(clearance.solids.pairs):
        return None
    curve, samples = (
        simulation.build_curve(motion),
        max(excitation.THRESHOLDS.clearance_samples, 2 * len(motion.time)),
    )
    return excitation.find_closest_approach(
        compiled, clearance.solids, curve, float(motion.time[-1]), samples
    )
