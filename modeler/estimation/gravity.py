"""Gravity as one hypothesis: a vector g of frame 0 that the torques of logs carry.

Torques are linear in it beside standard parameters, tau = (W_motion + sum_d g_d G_d) chi, where
G_d chi = -d/dq (e_d . sum_j (M_j p_j + R_j MS_j)) for the frames [R_j | p_j] of the links. A log
of drives that take gravity out has g = 0, a table with a wrong sign -g, a base that hangs another
direction. Where positions close loops, a factor of the stated gravity is all that is asked for.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from modeler.estimation.nearest_body import PhysicalParameters, define_physical_parameters
from modeler.regression import ThinnedRows
from modeler.runtime import CompiledModel

ABSENT = "the torques carry no gravity"
"""What a line says beside which no clock is to blame: at rest, none makes gravity vanish."""

TURNED = 0.3
"""rad between two directions of gravity, from which on no tilt of a base looks like it."""

NEAR = 0.05
"""Of the stated gravity: a smaller difference is none."""

_STEP = 1e-5  # rad or m of differences
_EARTH = 9.81  # m/s^2
_SCAN = (-2.0, -1.0, -0.5, 0.0, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0, 4.0)  # factors
_FINER = 5  # scans, each within two steps of the one before: factors to 0.002
_ROUND = (0.0, 0.5, 2.0, -1.0)  # preferred where they do as well
_AS_WELL = 0.5  # of the sum of logarithms of the errors
_STARTS = 3  # axes from which a direction is sought
_STEPS = 6  # of Gauss and Newton
_ROUNDING = 1e-9  # of a column, or of m/s2 along an axis
_MOST_COLUMNS = 150  # of standard parameters; larger robots are asked for a factor alone


@dataclass(frozen=True, eq=False)
class GravityModel:
    """What rows of logs feel of gravity.

    Attributes:
        machine: whose parameters the p columns belong to.
        motion: (m, n, p) columns without gravity.
        along: (k, m, n, p) of 1 m/s^2 along the axes of frame 0, or of the stated gravity alone.
        stated: (k,) in the robot file.
    """

    machine: PhysicalParameters
    motion: np.ndarray
    per_axis: np.ndarray
    stated: np.ndarray

    def propose_candidates(
        self, left: Callable[[np.ndarray], float], step: Callable[[np.ndarray], np.ndarray],
        turned: bool,
    ) -> list[np.ndarray]:  # fmt: skip
        """Gravities that may explain torques better than the stated one.

        Args:
            left: sum of the logarithms of the errors with a gravity (k,).
            step: by Gauss and Newton, from a gravity to a better one.
            turned: True if other directions are asked for.
        """
        candidates: list[np.ndarray] = []
        if self.stated.any():
            scan = list(_SCAN)
            for _ in range(_FINER):
                scores = [left(x * self.stated) for x in scan]
                best = int(np.argmin(scores))
                least, least_score = scan[best], scores[best]
                span = scan[max(0, best - 1)], scan[min(len(scan) - 1, best + 1)]
                scan = [float(x) for x in np.linspace(*span, 9)]
            enough = least_score + _AS_WELL
            rounded = [x for x in _ROUND if left(x * self.stated) <= enough]
            factor = rounded[0] if rounded else least
            if factor == 0.0 or min(abs(factor), abs(factor - 1.0)) > NEAR:
                candidates.append(factor * self.stated)
        if turned and len(self.stated) == 3:
            axes = [sign * _EARTH * axis for axis in np.eye(3) for sign in (1.0, -1.0)]
            starts = [self.stated, *sorted(axes, key=left)[:_STARTS]]
            g = min((_minimize_error(start, left, step) for start in starts), key=left)
            size = float(np.linalg.norm(self.stated)) or _EARTH
            as_large = g * size / max(float(np.linalg.norm(g)), _ROUNDING)
            if not 0.5 < np.linalg.norm(g) / size < 2.0 or left(as_large) <= left(g) + _AS_WELL:
                g = as_large
            if self._compare_stated(g)[1] > TURNED:
                candidates.append(g)
        return candidates

    def _compare_stated(self, g: np.ndarray) -> tuple[float, float]:
        """Factor of the stated gravity, and rad between the two; 0 and pi / 2 where it is none."""
        size, length = float(np.linalg.norm(self.stated)), float(np.linalg.norm(g))
        factor = float(g @ self.stated / max(size, 1e-9) ** 2)
        cosine = abs(g @ self.stated) / max(size * length, 1e-9) if length else 1.0
        return factor, float(np.arccos(min(1.0, cosine)))

    def format_line(self, g: np.ndarray) -> str:
        """What is to be said of it."""
        factor, angle = self._compare_stated(g)
        if angle > TURNED:
            stated, asked = (str((v.round(1) + 0.0).tolist()) for v in (self.stated, g))
            return (
                f"gravity of the robot file, {stated} m/s2, does not fit the torques: they ask "
                f"for about {asked} in frame 0; check gravity there and how the base is mounted"
            )
        if factor == 0.0:
            return (
                f"{ABSENT}: the drives compensate it or the log leaves it out; "
                "log the whole torque, or fit with gravity = [0, 0, 0]"
            )
        if factor < 0.0:
            return (
                f"gravity acts against its direction in the robot file, {-factor:.2g} times as "
                "large. Its sign there, the sign of an alpha and a zero off by 180 degrees are "
                "equal in the equations; check all three"
            )
        cause = "the drives compensate the rest, or" if factor < 1.0 else "check whether"
        return (
            f"the torques carry {factor:.2g} times the gravity of the robot file: {cause} gravity "
            "there is not in m/s2 or not that of the logs; check both"
        )


def _minimize_error(
    g: np.ndarray, left: Callable[[np.ndarray], float], step: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    least = left(g)
    for _ in range(_STEPS):
        further = g + step(g)
        if (score := left(further)) >= least:
            break
        g, least = further, score
    return g


def extract_gravity(compiled: CompiledModel, rows: ThinnedRows, free: bool) -> GravityModel | None:
    """What rows feel of gravity; None where they feel none of any direction.

    Args:
        compiled: the robot.
        rows: of logs.
        free: True if parameters are to be fitted; else a factor of gravity alone is asked for.
    """
    q, qd, qdd = rows.motion
    whole = compiled.base_regressor(q, qd, qdd, rows.read)
    at_rest = compiled.base_regressor(q, 0.0 * q, 0.0 * q, rows.read)
    at_rest *= np.array([base.kind == "inertial" for base in compiled.spec.base])
    moving = whole - at_rest
    moving *= np.abs(moving).max(axis=(0, 1)) > _ROUNDING * np.abs(whole).max(axis=(0, 1))
    motion, still = rows.filter_values(moving), rows.filter_values(at_rest)
    machine = define_physical_parameters(compiled.spec)
    if free and compiled.spec.closure is None and len(machine.names) <= _MOST_COLUMNS:
        along = _evaluate_axes(compiled, rows, machine, q)
        if along is not None:
            felt = (still @ machine.K).ravel()
            flat = along.reshape(3, -1)
            stated = np.linalg.lstsq(flat @ flat.T, flat @ felt, rcond=1e-9)[0]
            if np.linalg.norm(stated @ flat - felt) <= 1e-4 * np.linalg.norm(felt):
                standard_parameters = replace(machine, K=np.eye(len(machine.names)))
                rounded = np.asarray(np.round(stated, 6) + 0.0)
                return GravityModel(standard_parameters, motion @ machine.K, along, rounded)
    if not still.any():
        return None
    return GravityModel(machine, motion, still[None], np.ones(1))


def _evaluate_axes(
    compiled: CompiledModel, rows: ThinnedRows, machine: PhysicalParameters, q: np.ndarray
) -> np.ndarray | None:
    """(3, m, n, p) of 1 m/s^2 along each axis of frame 0; None where frames have no names."""
    slopes = [
        compiled.forward_kinematics(q + step) - compiled.forward_kinematics(q - step)
        for step in _STEP * np.eye(q.shape[1])
    ]
    if slopes[0].shape[1] != len(machine.links):
        return None
    every = -np.stack(slopes, axis=1) / (2.0 * _STEP)  # (samples, n, links, 3, 4)
    every[np.abs(every) < _ROUNDING] = 0.0
    felt = rows.filter_values(every.reshape(*every.shape[:2], -1))
    felt = felt.reshape(*felt.shape[:2], *every.shape[2:])
    along = np.zeros((3, *felt.shape[:2], len(machine.names)))
    for link, places in enumerate(machine.links.values()):
        along[..., places[6:]] = np.moveaxis(felt[:, :, link], 2, 0)  # MX, MY, MZ, M
    return along
