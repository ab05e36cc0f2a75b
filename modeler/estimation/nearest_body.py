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
from modeler.numerics.least_squares import column_lengths

PREFIXES = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
CORNER = {
    (0, 0): {"XX": -0.5, "YY": 0.5, "ZZ": 0.5},
    (0, 1): {"XY": -1.0},
    (1, 1): {"XX": 0.5, "YY": -0.5, "ZZ": 0.5},
    (0, 2): {"XZ": -1.0},
    (1, 2): {"YZ": -1.0},
    (2, 2): {"XX": 0.5, "YY": 0.5, "ZZ": -0.5},
    (0, 3): {"MX": 1.0},
    (1, 3): {"MY": 1.0},
    (2, 3): {"MZ": 1.0},
    (3, 3): {"M": 1.0},
}
"""Upper triangle of P, column after column: {prefix: factor}."""

_ANSWERS = ("Solved", "AlmostSolved")


@dataclass(frozen=True, eq=False)
class Nearest:
    """The possible machine nearest to a fit.

    Attributes:
        beta: (c,) its base parameters, SI.
        distance: ||root (beta - fit)||: with the root of the information, standard deviations.
    """

    beta: np.ndarray
    distance: float


@dataclass(frozen=True, eq=False)
class Machine:
    """The unknowns of the problem: chi, those that no torque feels included.

    Attributes:
        K: (c, m) beta = K chi.
        links: by link, the places in chi of its ten parameters, by prefix.
        positive: names and places of the other parameters that cannot be negative.
    """

    K: np.ndarray
    links: Mapping[str, Mapping[str, int]]
    positive: Mapping[str, int]

    @property
    def bounds(self) -> tuple[str, ...]:
        """Names of what physics bounds: links, then parameters."""
        return (*self.links, *self.positive)


def machine_of(spec: ModuleSpec) -> Machine:
    """The unknowns of a robot; a link has all ten parameters, whichever the torques feel."""
    place = {parameter.name: i for i, parameter in enumerate(spec.standard)}
    links: dict[str, dict[str, int]] = {}
    count = len(place)
    for parameter in spec.standard:
        if parameter.effect == "rigid_body":
            links.setdefault(parameter.joint, {})
    for joint, own in links.items():
        for prefix in PREFIXES:
            own[prefix] = place.get(f"{prefix}{joint}", count)
            count += own[prefix] == count
    K = np.zeros((len(spec.base), count))
    for row, base in zip(K, spec.base, strict=True):
        for term in base.terms:
            row[place[term.parameter]] += term.value
    positive = {
        p.name: place[p.name] for p in spec.standard if p.nonnegative and p.effect != "rigid_body"
    }
    return Machine(K, links, positive)


def body(felt: Sequence[ParameterSpec]) -> Machine:
    """The unknowns of one body; beta are those of its parameters that are felt."""
    place = {p.name.removesuffix(p.joint): i for i, p in enumerate(felt)}
    unfelt = [prefix for prefix in PREFIXES if prefix not in place]
    place |= {prefix: len(felt) + i for i, prefix in enumerate(unfelt)}
    return Machine(np.eye(len(felt), len(place)), {"body": place}, {})


def nearest_possible(
    machine: Machine, beta: np.ndarray, root: np.ndarray, free: Iterable[str] = ()
) -> Nearest | None:
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
    scale = scales(machine, matrix)
    bounds, cones = _bounds(machine, scale, set(free))
    x = _solved(matrix * scale, root @ beta / size, bounds, cones)
    if x is None:
        return None
    best = machine.K @ (scale * x)
    return Nearest(best, float(np.linalg.norm(root @ (best - beta))))


def _solved(
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
    found = clarabel.DefaultSolver(
        squares.tocsc(),
        np.zeros(unknowns + rows),
        vstack([equations, limits]).tocsc(),
        np.concatenate([target, np.zeros(bounds.shape[0])]),
        [clarabel.ZeroConeT(rows), *cones],
        settings,
    ).solve()
    return np.array(found.x[:unknowns]) if str(found.status) in _ANSWERS else None


def scales(machine: Machine, matrix: np.ndarray) -> np.ndarray:
    """(m,) one mass and one length per link: P = D P' D with a diagonal D keeps its sign."""
    length = np.linalg.norm(matrix, axis=0)
    scale = 1.0 / column_lengths(matrix)
    for own in machine.links.values():
        inertia, moment = (
            max(length[own[p]] for p in prefixes) for prefixes in (PREFIXES[:6], PREFIXES[6:9])
        )
        metre = moment / inertia if moment > 0.0 and inertia > 0.0 else 1.0
        largest = max(inertia * metre**2, moment * metre, length[own["M"]])
        kilogram = 1.0 / largest if largest > 0.0 else 1.0
        for power, prefixes in ((2, PREFIXES[:6]), (1, PREFIXES[6:9]), (0, ("M",))):
            scale[[own[p] for p in prefixes]] = kilogram * metre**power
    return scale


def _bounds(machine: Machine, scale: np.ndarray, free: set[str]) -> tuple[csc_array, list]:
    """Matrix of the bounds, -B x in the cones, and the cones."""
    import clarabel

    rows: list[dict[int, float]] = []
    alone = [place for name, place in machine.positive.items() if name not in free]
    rows += [{place: -1.0} for place in alone]
    cones: list = [clarabel.NonnegativeConeT(len(alone))] if alone else []
    for name, own in machine.links.items():
        if name in free:
            continue
        kilogram = scale[own["M"]]
        for (i, j), terms in CORNER.items():
            outside = 1.0 if i == j else np.sqrt(2.0)
            power = (i < 3) + (j < 3)
            metre = scale[own["MX"]] / kilogram
            units = kilogram * metre**power
            rows.append({own[p]: -outside * v * scale[own[p]] / units for p, v in terms.items()})
        cones.append(clarabel.PSDTriangleConeT(4))
    entries = [(r, c, v) for r, row in enumerate(rows) for c, v in row.items()]
    shape = (len(rows), machine.K.shape[1])
    if not entries:
        return csc_array(shape), cones
    r, c, v = zip(*entries, strict=True)
    return csc_array((v, (r, c)), shape=shape), cones


def carried_by(
    machine: Machine, beta: np.ndarray, root: np.ndarray, distance: float, most: int = 3
) -> Sequence[str]:
    """Names of the bounds that a distance comes from, the gravest first.

    That without which the nearest machine comes nearest, and those that do half as much.
    """
    fall = {}
    for name in machine.bounds:
        other = nearest_possible(machine, beta, root, [name])
        fall[name] = distance**2 - other.distance**2 if other is not None else 0.0
    largest = max(fall.values(), default=0.0)
    named = [name for name in fall if largest > 0.0 and fall[name] >= 0.5 * largest]
    return sorted(named, key=lambda name: -fall[name])[:most]
