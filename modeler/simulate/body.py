"""A rigid link as a workshop describes it: mass, mass centre, inertia about the mass centre."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.robot import INERTIAL


@dataclass(frozen=True, eq=False)
class Body:
    """One moving link, in the axes of its frame j.

    Attributes:
        mass: [kg].
        centre: (3,) mass centre in frame j, m.
        inertia: (3, 3) inertia matrix about the mass centre, kg m2; off-diagonal elements are
            minus the products of inertia.
    """

    mass: float
    centre: np.ndarray
    inertia: np.ndarray


_ROUNDING = 1e-11  # of the moments of inertia
_PLACE = {"XX": (0, 0), "XY": (0, 1), "XZ": (0, 2), "YY": (1, 1), "YZ": (1, 2), "ZZ": (2, 2)}


def body_from_standard(values: Mapping[str, float]) -> Body:
    """The body whose ten standard parameters (keys of `INERTIAL`) are `values`.

    J_centre = J_origin - M (c.c 1 - c c'), c = (MX, MY, MZ) / M (Huygens and Steiner).
    """
    mass = values["M"]
    moment = np.array([values["MX"], values["MY"], values["MZ"]])
    centre = moment / mass if mass else np.zeros(3)
    origin = np.zeros((3, 3))
    for name, (row, column) in _PLACE.items():
        origin[row, column] = origin[column, row] = values[name]
    return Body(mass, centre, origin - mass * _spread(centre))


def standard_from_body(body: Body) -> dict[str, float]:
    """The ten standard parameters at the origin of frame j, in the order of `INERTIAL`."""
    origin = body.inertia + body.mass * _spread(body.centre)
    moment = body.mass * body.centre
    values = {name: float(origin[place]) for name, place in _PLACE.items()}
    values |= {name: float(moment[i]) for i, name in enumerate(("MX", "MY", "MZ"))}
    values["M"] = float(body.mass)
    return {name: values[name] for name in INERTIAL}


def pseudo_inertia(values: Mapping[str, float]) -> np.ndarray:
    """(4, 4) second moments of the mass, [[int x x' dm, int x dm], [., M]], at the frame's origin.

    A set of ten parameters is that of some distribution of mass if and only if this matrix is
    positive semi-definite (Wensing, Kim and Slotine 2018, IEEE RA-L 3(1)).
    """
    origin = np.zeros((3, 3))
    for name, (row, column) in _PLACE.items():
        origin[row, column] = origin[column, row] = values[name]
    matrix = np.empty((4, 4))
    matrix[:3, :3] = np.trace(origin) / 2 * np.eye(3) - origin
    matrix[:3, 3] = matrix[3, :3] = [values["MX"], values["MY"], values["MZ"]]
    matrix[3, 3] = values["M"]
    return matrix


def standard_from_pseudo_inertia(matrix: np.ndarray) -> dict[str, float]:
    """Inverse of `pseudo_inertia`."""
    second = matrix[:3, :3]
    origin = np.trace(second) * np.eye(3) - second
    values = {name: float(origin[place]) for name, place in _PLACE.items()}
    values |= {name: float(matrix[i, 3]) for i, name in enumerate(("MX", "MY", "MZ"))}
    values["M"] = float(matrix[3, 3])
    return {name: values[name] for name in INERTIAL}


def is_physical(values: Mapping[str, float], tolerance: float = 1e-9) -> bool:
    """True if some distribution of mass has these parameters; rods, plates and no mass included."""
    matrix = pseudo_inertia(values)
    # A plate of which XX = YY + ZZ holds but for rounding is one.
    matrix[:3, :3] += _ROUNDING * abs(np.trace(matrix[:3, :3])) * np.eye(3)
    # Rows scaled to ones on the diagonal: kilograms and kilogram square metres become comparable.
    diagonal = np.diag(matrix)
    if np.any(diagonal < 0):
        return False
    scale = np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
    return bool(np.linalg.eigvalsh(matrix / np.outer(scale, scale))[0] >= -tolerance)


def _spread(centre: np.ndarray) -> np.ndarray:
    return float(np.sum(centre * centre)) * np.eye(3) - np.outer(centre, centre)
