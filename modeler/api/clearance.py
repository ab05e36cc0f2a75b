"""Whether links run into each other: capsules of a robot, and the nearest two along a motion."""

import dataclasses
import math
from pathlib import Path

import numpy as np

from modeler import excitation, exports, simulation
from modeler.api.workflow import compile_model, derive, generate
from modeler.core.errors import DataError
from modeler.robot import Robot
from modeler.runtime import CompiledModel

USUAL = 0.01
"""m between links of a robot whose file has [capsules]."""


def with_clearance(
    robot: Robot, compiled: CompiledModel, bounds: excitation.Bounds, margin: float | None
) -> excitation.Bounds:
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
    solids = _solids(robot, compiled)
    drawn = excitation.drawn_postures(bounds.lower, bounds.upper)
    clearance = excitation.without_neighbours(compiled, solids, margin, drawn, bounds.home)
    return dataclasses.replace(bounds, clearance=clearance)


def _solids(robot: Robot, compiled: CompiledModel) -> excitation.Solids:
    """All capsules, and all pairs of links that share no joint."""
    moving, closure = [joint.name for joint in robot.moving], compiled.spec.closure
    at = {} if closure is None else dict(zip(closure.variables, closure.home, strict=True))
    shapes = exports.capsules_on_links(robot, at)
    on = {row: carrier for row, carrier, _ in shapes}
    links = [carrier for _, carrier, _ in shapes]
    joined = {(on.get(j.name), on.get(j.antecedent)) for j in robot.joints}
    joined |= {(on.get(loop.frame), on.get(loop.meets)) for loop in robot.loops}
    pairs = [
        (i, k)
        for k, other in enumerate(links)
        for i, one in enumerate(links[:k])
        if one != other and (one, other) not in joined and (other, one) not in joined
    ]
    planes = [excitation.Plane(name, v[:3], v[3]) for name, v in robot.planes.items()]
    flat = [(i, k) for i, link in enumerate(links) if link in moving for k in range(len(planes))]
    places = [moving.index(link) if link in moving else excitation.BASE for link in links]
    return excitation.Solids(
        tuple("base" if row == "0" else row for row, *_ in shapes), np.array(places),
        np.array([(shape.start, shape.end) for *_, shape in shapes]),
        np.array([shape.radius for *_, shape in shapes]), tuple(planes),
        np.array(pairs, dtype=int).reshape(-1, 2), np.array(flat, dtype=int).reshape(-1, 2),
    )  # fmt: skip


def nearest_along(
    compiled: CompiledModel, clearance: excitation.Clearance, path: str | Path
) -> excitation.Nearest | None:
    """The nearest two along the motion of a file; None if there are none to look at."""
    names = [joint.name for joint in compiled.spec.joints]
    motion = simulation.read_motion(path, names)
    curve = simulation.curve_of(motion)
    return excitation.nearest(compiled, clearance.solids, curve, float(motion.time[-1]))


def check_motion(
    robot: Robot, path: str | Path, *, clearance: float = USUAL
) -> excitation.Nearest | None:
    """Where a motion brings two links, or a link and a plane, closest to each other.

    >>> excite(robot, duration=4.0, harmonics=2, starts=1).write("next.csv", rate=100.0)
    >>> check_motion(robot, "next.csv") is None  # its two links share a joint
    True

    Args:
        robot: its [capsules] are what links fill; without, as `modeler show` draws them.
        path: of a motion or log, .csv or .parquet; commanded positions, if it has them.
        clearance: m; pairs that are nearer in all postures are left out.

    Raises:
        DataError: the file has no motion of this robot.
    """
    from modeler.api.motion import bounds_of

    compiled = compile_model(generate(derive(robot)))
    bounds = bounds_of(robot, compiled, {}, {}, clearance)
    assert bounds.clearance is not None
    return nearest_along(compiled, bounds.clearance, path)
