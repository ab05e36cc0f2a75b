"""The loops of a robot as functions of many postures at once, and what a posture looks like."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.brief import Brief
from modeler.robot import Joint, Robot
from modeler.symbolic.closing import Closing
from modeler.symbolic.closure import loop_closing
from modeler.symbolic.geometry import Geometry
from modeler.symbolic.kinematics import base_poses
from modeler.symbolic.loop_equations import Frame
from modeler.symbolic.model import SymbolicModel


@dataclass(frozen=True)
class Linkage(Brief):
    """A robot with loops, as arrays of postures u of its free joints.

    Attributes:
        robot: as read.
        geometry: its exact table.
        closing: the loop equations.
        owners: by equation, the loop that it comes from.
        frames: axes and origin of every row in frame 0, as expressions.
    """

    robot: Robot
    geometry: Geometry
    closing: Closing
    owners: Sequence[str]
    frames: Sequence[Frame]

    @property
    def free(self) -> tuple[Joint, ...]:
        """Rows whose variables are u."""
        return self.robot.free

    @cached_property
    def lengths(self) -> np.ndarray:
        """By u, True for a travel in m."""
        return np.array(self.closing.lengths, dtype=bool)

    @cached_property
    def tied(self) -> np.ndarray:
        """By u, True for a joint that a loop depends on; the others stand anywhere."""
        columns = zip(*self.closing.jacobian, strict=True)
        return np.array([any(not entry.is_zero for entry in column) for column in columns])

    def vector(self, values: Mapping[str, float]) -> np.ndarray:
        """(u,) values by row name; NaN for rows without."""
        return np.array([values.get(joint.name, np.nan) for joint in self.free])

    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """(u,) lower and upper [limits]; infinite for joints without."""
        limits = [self.robot.limits.get(joint.name) for joint in self.free]
        lower = np.array([-np.inf if one is None else one.lower for one in limits])
        upper = np.array([np.inf if one is None else one.upper for one in limits])
        return lower, upper

    @cached_property
    def middles(self) -> np.ndarray:
        """(u,) middles of [limits]; NaN for joints without."""
        lower, upper = self.bounds()
        with np.errstate(invalid="ignore"):
            middle = np.where(np.isfinite(lower + upper), 0.5 * (lower + upper), np.nan)
        return np.array([float(f"{x:.12g}") for x in middle])

    def origins(self, u: np.ndarray) -> np.ndarray:
        """(n, rows, 3) origins of all frames in frame 0, m."""
        flat = [x for _, origin in self.frames for x in origin]
        return self.closing.evaluate(flat, u).reshape(len(u), len(self.frames), 3)

    def shape(self, u: np.ndarray) -> np.ndarray:
        """(n, numbers) where all frames and joint axes are, an axis being a line without a sense.

        Postures of one shape are symmetric copies: a fork turned over with its universal joint, a
        cylinder of negative length that points the other way.
        """
        z = self.closing.evaluate([x for axes, _ in self.frames for x in axes[2]], u)
        z = z.reshape(len(u), len(self.frames), 3)
        lines = np.einsum("nri,nrj->nrij", z, z)[:, :, *np.triu_indices(3)]
        points = self.origins(u) / self.closing.size
        return np.concatenate([points, lines], axis=2).reshape(len(u), 9 * len(self.frames))

    def apart(self, u: np.ndarray, other: np.ndarray) -> np.ndarray:
        """(n, u) distances of joints, rad and sizes, angles the shorter way round; NaN as 0."""
        way = u - other
        way = np.where(self.lengths, way / self.closing.size, wrapped(way))
        return np.abs(np.nan_to_num(way))

    def outside(self, u: np.ndarray) -> np.ndarray:
        """(n,) by how much [limits] are left, rad and sizes."""
        lower, upper = self.bounds()
        beyond = np.maximum(np.maximum(lower - u, u - upper), 0.0)
        return np.asarray(np.sum(beyond / self.closing.scale, axis=1))


def linkage_of(model: SymbolicModel) -> Linkage | None:
    """The linkage of a model; None if no loop equation is left to be solved."""
    robot = model.robot
    if not robot.loops:
        return None
    closing, owners = loop_closing(model.geometry, model.graph, model.frames, model.algebra)
    if not closing.equations or not closing.solved:
        return None
    frames = base_poses(model.geometry, model.frames, model.algebra)
    return Linkage(robot, model.geometry, closing, owners, frames)


def wrapped(angle: np.ndarray) -> np.ndarray:
    """Angles in [-pi, pi)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi
