"""What positions must keep to besides the ranges of the motors: boxes, loops, joints behind."""

from dataclasses import dataclass

import numpy as np

from modeler.compiled import CompiledModel
from modeler.core.errors import DataError, LoopError
from modeler.excite.bounds import Bounds

FARTHEST = 2.0
"""Times that of home: how fast the joints that follow may be, per speed of the motors."""

_STEP = 1e-5  # of the half ranges


@dataclass(frozen=True, eq=False)
class Posture:
    """Shares of limits that hang on the positions alone.

    Loops stay away from singular postures by G of ud = G qd: near one, joints that follow are
    infinitely fast. Rows of G are taken together by unit, motors weighed by their ranges.

    Attributes:
        compiled: the robot.
        bounds: limits.
        kinds: (rows,) places of u by unit, those that follow.
        fastest: of the same groups, the size of G that counts as the limit.
    """

    compiled: CompiledModel
    bounds: Bounds
    kinds: tuple[np.ndarray, ...] = ()
    fastest: tuple[float, ...] = ()

    def shares(self, q: np.ndarray) -> np.ndarray:
        """(n, r) numbers that must stay between -1 and 1.

        Raises:
            LoopError: a posture does not close.
        """
        parts = []
        if self.kinds:
            parts.append(self.sizes(q) / np.array(self.fastest))
        if self.bounds.passive:
            u = self.compiled.close(q)
            for place, lower, upper in self.bounds.passive:
                parts.append((2.0 * u[:, place, None] - lower - upper) / (upper - lower))
        if self.bounds.boxes:
            poses = self.compiled.forward_kinematics(q)
            for box in self.bounds.boxes:
                low, high = np.array(box.lower), np.array(box.upper)
                parts.append((2.0 * poses[:, box.row, :, 3] - low - high) / (high - low))
        return np.hstack(parts) if parts else np.zeros((len(q), 0))

    def sizes(self, q: np.ndarray) -> np.ndarray:
        """(n, groups) sizes of G of the joints that follow."""
        G = self.compiled.coupling(q) * self.bounds.half
        return np.column_stack([
            np.sqrt(np.sum(G[:, places] ** 2, axis=(1, 2))) for places in self.kinds
        ])  # fmt: skip

    def pulled_back(self, q: np.ndarray, pull: np.ndarray) -> np.ndarray:
        """(n, J) derivative by q of a number whose derivative by `shares` is `pull`."""
        if pull.shape[1] == 0:
            return np.zeros_like(q)
        slope = np.empty_like(q)
        for j, size in enumerate((_STEP * self.bounds.half).tolist()):
            step = np.zeros(q.shape[1])
            step[j] = size
            try:
                change = self.shares(q + step) - self.shares(q - step)
            except LoopError:  # beyond the wall: the barrier has brought us as near as can be
                change = np.zeros_like(pull)
            slope[:, j] = np.sum(change * pull, axis=1) / (2.0 * size)
        return slope


def posture_of(compiled: CompiledModel, bounds: Bounds) -> Posture:
    """What the positions of a robot must keep to.

    Raises:
        DataError: home itself is outside.
    """
    closure = compiled.spec.closure
    plain = Posture(compiled, bounds)
    if closure is None or bounds.home is None:
        return plain
    driven = set(closure.given)
    places = [
        np.array([i for i, unit in enumerate(closure.units) if i not in driven and unit == kind])
        for kind in ("rad", "m")
    ]
    kinds = tuple(group for group in places if len(group))
    loops = Posture(compiled, bounds, kinds, ())
    home = loops.sizes(bounds.home[None, :])[0]
    found = Posture(compiled, bounds, kinds, tuple(FARTHEST * home))
    at_home = found.shares(bounds.home[None, :])
    if not np.abs(at_home).max(initial=0.0) < 1.0:
        raise DataError(
            f"{compiled.spec.robot}: [home] is outside of the boxes or of [limits] of joints that "
            "follow; expected limits around it"
        )
    return found
