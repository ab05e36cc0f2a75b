"""The machine nearest to a fit that could be built: semidefinite least squares.

Base parameters are sums beta = K chi of standard parameters, and chi are those of a machine if and
only if the pseudo-inertia of every link is positive semi-definite,

    P_j = | (tr I_j / 2) 1 - I_j   l_j |  >= 0,   l_j = (MX, MY, MZ)_j,
          | l_j^T                  M_j |

and friction and rotor inertias are not negative (Sousa and Cortesao 2014, IJRR 33(6); Wensing, Kim
and Slotine 2018, IEEE RA-L 3(1)). Whatever chi the base parameters leave open may be chosen: a fit
is impossible only if no completion mends it.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, diags_array, eye_array, hstack, vstack

from modeler.core.manifest import ModuleSpec, ParameterSpec
from modeler.numerics.least_squares import compute_column_norms

PREFIXES = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
"""The ten standard parameters of a body, in this order."""

_ANSWERS = ("Solved", "AlmostSolved")


@dataclass(frozen=True, eq=False)
class Projection:
    """The possible machine nearest to a fit.

    Attributes:
        beta: (c,) its base parameters, SI.
        distance: ||root (beta - fit)||: with the root of the information, standard deviations.
    """

    beta: np.ndarray
    distance: float


@dataclass(frozen=True, eq=False)
class PhysicalParameters:
    """The unknowns of the problem: chi, those that no torque feels included.

    Attributes:
        names: (m,) of chi.
        K: (c, m) beta = K chi.
        links: by link, (10,) the places in chi of its ten parameters.
        positive: names and places of the other parameters that cannot be negative.
    """

    names: tuple[str, ...]
    K: np.ndarray
    links: Mapping[str, np.ndarray]
    positive: Mapping[str, int]

    @property
    def bounds(self) -> tuple[str, ...]:
        """Names of what physics bounds: links, then parameters."""
        return (*self.links, *self.positive)


def define_physical_parameters(spec: ModuleSpec) -> PhysicalParameters:
    """The unknowns of a robot; a link has all ten parameters, whichever the torques feel."""
    place = {parameter.name: i for i, parameter in enumerate(spec.standard)}
    links: dict[str, np.ndarray] = {}
    inertial = [p for p in spec.standard if p.effect == "rigid_body"]
    for link in dict.fromkeys(p.joint for p in inertial):
        felt = {_find_prefix(p): p.name for p in inertial if p.joint == link}
        names = [felt.get(prefix, f"{prefix}{link}") for prefix in PREFIXES]
        links[link] = np.array([place.setdefault(name, len(place)) for name in names])
    K = np.zeros((len(spec.base), len(place)))
    for row, base in zip(K, spec.base, strict=True):
        for term in base.terms:
            row[place[term.parameter]] += term.value
    positive = {
        p.name: place[p.name] for p in spec.standard if p.nonnegative and p.effect != "rigid_body"
    }
    return PhysicalParameters(tuple(place), K, links, positive)


def _find_prefix(parameter: ParameterSpec) -> str:
    """The XX of XX21, and of XX2 that similar legs share."""
    prefix = parameter.name.removesuffix(parameter.joint)
    return (
        prefix if prefix in PREFIXES else next(p for p in PREFIXES if parameter.name.startswith(p))
    )


def define_body(parameters: Sequence[ParameterSpec]) -> PhysicalParameters:
    """The unknowns of one body; beta are those of its parameters that are felt."""
    names = [p.name.removesuffix(p.joint) for p in parameters]
    names += [prefix for prefix in PREFIXES if prefix not in names]
    places = np.array([names.index(prefix) for prefix in PREFIXES])
    return PhysicalParameters(
        tuple(names), np.eye(len(parameters), len(names)), {"body": places}, {}
    )


def compute_pseudo_inertia(ten: np.ndarray) -> np.ndarray:
    """(4, 4, ...) P of ten standard parameters (10, ...)."""
    xx, xy, xz, yy, yz, zz, mx, my, mz, m = ten
    half = (xx + yy + zz) / 2.0
    return np.array([
        [half - xx, -xy, -xz, mx],
        [-xy, half - yy, -yz, my],
        [-xz, -yz, half - zz, mz],
        [mx, my, mz, m],
    ])  # fmt: skip


def extract_parameters(P: np.ndarray) -> np.ndarray:
    """(10, ...) the standard parameters of P (4, 4, ...)."""
    (x, xy, xz, mx), (_, y, yz, my), (_, _, z, mz), (_, _, _, m) = P
    return np.array([y + z, -xy, -xz, x + z, -yz, x + y, mx, my, mz, m])


def project_parameters(
    machine: PhysicalParameters, beta: np.ndarray, root: np.ndarray, free: Iterable[str] = ()
) -> Projection | None:
    """The possible machine of least ||root (K chi - beta)||; None if the solver found none.

    Args:
        machine: unknowns and bounds.
        beta: (c,) of a fit.
        root: (r, c); of W / sigma: the distance squared is what the weighted squares would rise by.
        free: names of `machine.bounds` that are let go.
    """
    size = float(np.linalg.norm(root @ beta))
    if size == 0.0 or not np.isfinite(root).all():
        return None
    matrix = root @ machine.K / size
    scale = compute_scales(machine, matrix)
    bounds, cones = _build_bounds(machine, scale, set(free))
    x = _solve_cone_problem(matrix * scale, root @ beta / size, bounds, cones)
    if x is None:
        return None
    best = machine.K @ (scale * x)
    return Projection(best, float(np.linalg.norm(root @ (best - beta))))


def _solve_cone_problem(
    matrix: np.ndarray, target: np.ndarray, bounds: csc_array, cones: list
) -> np.ndarray | None:
    """x of least ||matrix x - target|| with -bounds x in the cones; None without an answer."""
    # Only here: a fit that is not judged needs no solver.
    import clarabel

    rows, unknowns = matrix.shape
    # matrix x - z = target, least z.z
    equations = hstack([csc_array(matrix), -eye_array(rows)])
    limits = hstack([bounds, csc_array((bounds.shape[0], rows))])
    squares = diags_array(np.repeat([0.0, 2.0], [unknowns, rows]))
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    solution = clarabel.DefaultSolver(
        squares.tocsc(),
        np.zeros(unknowns + rows),
        vstack([equations, limits]).tocsc(),
        np.concatenate([target, np.zeros(bounds.shape[0])]),
        [clarabel.ZeroConeT(rows), *cones],
        settings,
    ).solve()
    return np.array(solution.x[:unknowns]) if str(solution.status) in _ANSWERS else None


def compute_scales(machine: PhysicalParameters, matrix: np.ndarray) -> np.ndarray:
    """(m,) one mass and one length per link: P = D P' D with a diagonal D keeps its sign."""
    length = np.linalg.norm(matrix, axis=0)
    scale = 1.0 / compute_column_norms(matrix)
    for places in machine.links.values():
        inertia, moment, weight = (length[places[i:j]].max() for i, j in ((0, 6), (6, 9), (9, 10)))
        metre = moment / inertia if moment > 0.0 and inertia > 0.0 else 1.0
        largest = max(inertia * metre**2, moment * metre, weight)
        kilogram = 1.0 / largest if largest > 0.0 else 1.0
        scale[places] = kilogram * metre ** np.repeat([2, 1, 0], [6, 3, 1])
    return scale


_UPPER = np.tril_indices(4)[::-1]  # of P, column after column, as the solver has it


def _build_bounds(
    machine: PhysicalParameters, scale: np.ndarray, free: set[str]
) -> tuple[csc_array, list]:
    """Matrix of the bounds, -B x in the cones, and the cones."""
    import clarabel

    unknowns = len(scale)
    alone = [place for name, place in machine.positive.items() if name not in free]
    rows = [-np.eye(unknowns)[alone]]
    cones: list = [clarabel.NonnegativeConeT(len(alone))] if alone else []
    for name, places in machine.links.items():
        if name not in free:
            kilogram, metre = scale[places[9]], scale[places[6]] / scale[places[9]]
            size = np.array([metre, metre, metre, 1.0])
            twice = np.where(np.eye(4), 1.0, np.sqrt(2.0)) / (kilogram * np.outer(size, size))
            block = np.zeros((10, unknowns))
            block[:, places] = -(
                twice[:, :, None] * compute_pseudo_inertia(np.diag(scale[places]))
            )[_UPPER]
            rows.append(block)
            cones.append(clarabel.PSDTriangleConeT(4))
    return csc_array(np.vstack(rows)), cones


def attribute_distance(
    machine: PhysicalParameters, beta: np.ndarray, root: np.ndarray, distance: float, most: int = 3
) -> Sequence[str]:
    """Names of the bounds that a distance comes from, the gravest first.

    That without which the nearest machine comes nearest, and those that do half as much.
    """
    fall = {}
    for name in machine.bounds:
        other = project_parameters(machine, beta, root, [name])
        fall[name] = distance**2 - other.distance**2 if other is not None else 0.0
    largest = max(fall.values(), default=0.0)
    named = [name for name in fall if largest > 0.0 and fall[name] >= 0.5 * largest]
    return sorted(named, key=lambda name: -fall[name])[:most]
