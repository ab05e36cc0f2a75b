"""Parameters of a robot that could be built: the nearest to a fit, and the fit of such parameters.

Base parameters are sums beta = K chi of standard parameters, and chi are those of a machine if and
only if the pseudo-inertia of every link is positive semi-definite,

    P_j = | (tr I_j / 2) 1 - I_j   l_j |  >= 0,   l_j = (MX, MY, MZ)_j,
          | l_j^T                  M_j |

and friction and rotor inertias are not negative (Sousa and Cortesao 2014, IJRR 33(6); Wensing, Kim
and Slotine 2018, IEEE RA-L 3(1)). Whatever chi the base parameters leave open may be chosen. The
consistent fit

    minimise  1/2 ||R (K chi) - z||^2 + gamma sum_j (tr(P0_j^-1 P_j) - log det(P0_j^-1 P_j) - 4)

has the weighted rows R, z of a fit, so that the first term counts standard deviations; the second,
the log-determinant divergence from a reference body P0_j, does not depend on units or frames, and
decides what no torque depends on (Lee, Wensing and Park 2020, IEEE T-RO 36(2)).
"""

import dataclasses
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec, ParameterSpec
from modeler.estimation.least_squares import Estimate, Problem, solve_least_squares
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import Rank, compute_column_norms, minimize_over_cones

PREFIXES = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
"""The ten standard parameters of a body, in this order."""


@dataclass(frozen=True, eq=False)
class Projection:
    """Holds the physically consistent parameters nearest to a fit.

    Attributes:
        beta: (c,) base parameters, SI.
        distance: ||root (beta - fit)||: with the root of the information, standard deviations.
    """

    beta: np.ndarray
    distance: float


@dataclass(frozen=True, eq=False)
class PhysicalParameters:
    """Describes the unknowns chi, those that no torque depends on included.

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
        """Returns the names of what physics bounds: links, then parameters."""
        return (*self.links, *self.positive)


def define_physical_parameters(spec: ModuleSpec) -> PhysicalParameters:
    """Returns the unknowns of a robot; a link has all ten parameters."""
    place = {parameter.name: i for i, parameter in enumerate(spec.standard)}
    links: dict[str, np.ndarray] = {}
    inertial = [p for p in spec.standard if p.effect == "rigid_body"]
    for link in dict.fromkeys(p.joint for p in inertial):
        stated = {}
        for p in inertial:
            prefix = p.name.removesuffix(p.joint)
            if prefix not in PREFIXES:  # the XX of XX2 that similar legs share
                prefix = next(q for q in PREFIXES if p.name.startswith(q))
            if p.joint == link:
                stated[prefix] = p.name
        names = [stated.get(prefix, f"{prefix}{link}") for prefix in PREFIXES]
        links[link] = np.array([place.setdefault(name, len(place)) for name in names])
    K = np.zeros((len(spec.base), len(place)))
    for row, base in zip(K, spec.base, strict=True):
        for term in base.terms:
            row[place[term.parameter]] += term.value
    others = (p for p in spec.standard if p.nonnegative and p.effect != "rigid_body")
    return PhysicalParameters(tuple(place), K, links, {p.name: place[p.name] for p in others})


def define_body(parameters: Sequence[ParameterSpec]) -> PhysicalParameters:
    """Returns the unknowns of one body; beta are those of its parameters that are given."""
    names = [p.name.removesuffix(p.joint) for p in parameters]
    names += [prefix for prefix in PREFIXES if prefix not in names]
    places = np.array([names.index(prefix) for prefix in PREFIXES])
    return PhysicalParameters(tuple(names), np.eye(len(parameters), 10), {"body": places}, {})


def compute_pseudo_inertia(ten: np.ndarray) -> np.ndarray:
    """Returns (4, 4, ...) P of ten standard parameters (10, ...)."""
    xx, xy, xz, yy, yz, zz, mx, my, mz, m = ten
    half = (xx + yy + zz) / 2.0
    first, second = [half - xx, -xy, -xz, mx], [-xy, half - yy, -yz, my]
    return np.array([first, second, [-xz, -yz, half - zz, mz], [mx, my, mz, m]])


def extract_parameters(P: np.ndarray) -> np.ndarray:
    """Returns (10, ...) the standard parameters of P (4, 4, ...)."""
    (x, xy, xz, mx), (_, y, yz, my), (_, _, z, mz), (_, _, _, m) = P
    return np.array([y + z, -xy, -xz, x + z, -yz, x + y, mx, my, mz, m])


def project_parameters(
    machine: PhysicalParameters, beta: np.ndarray, root: np.ndarray, free: Collection[str] = ()
) -> Projection | None:
    """Returns the consistent parameters of least ||root (K chi - beta)||; None if none is found.

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
    scale, bodies = compute_scales(machine, matrix), []
    for name, places in machine.links.items():
        if name not in free:
            kilogram, metre = scale[places[9]], scale[places[6]] / scale[places[9]]
            unit, moves = np.array([metre, metre, metre, 1.0]), np.zeros((len(scale), 4, 4))
            body = compute_pseudo_inertia(np.diag(scale[places])).transpose(2, 0, 1)
            moves[places] = body / (kilogram * np.outer(unit, unit))
            bodies.append((np.zeros((4, 4)), moves))
    alone = [place for name, place in machine.positive.items() if name not in free]
    bounds = np.eye(len(scale))[alone], np.zeros(len(alone))
    x = minimize_over_cones((matrix * scale, root @ beta / size), bounds, bodies)
    if x is None:
        return None
    best = machine.K @ (scale * x)
    return Projection(best, float(np.linalg.norm(root @ (best - beta))))


def compute_scales(machine: PhysicalParameters, matrix: np.ndarray) -> np.ndarray:
    """Returns (m,) one mass and one length per link: P = D P' D, D diagonal, keeps its sign."""
    length = np.linalg.norm(matrix, axis=0)
    scale = 1.0 / compute_column_norms(matrix)
    for places in machine.links.values():
        inertia, moment, weight = (length[places[i:j]].max() for i, j in ((0, 6), (6, 9), (9, 10)))
        metre = moment / inertia if moment > 0.0 and inertia > 0.0 else 1.0
        largest = max(inertia * metre**2, moment * metre, weight)
        kilogram = 1.0 / largest if largest > 0.0 else 1.0
        scale[places] = kilogram * metre ** np.repeat([2, 1, 0], [6, 3, 1])
    return scale


def attribute_distance(
    machine: PhysicalParameters, beta: np.ndarray, root: np.ndarray, distance: float
) -> Sequence[str]:
    """Returns names of up to three bounds that a distance comes from, the largest part first.

    That without which the nearest parameters come nearest, and those that do half as much.
    """
    fall = {}
    for name in machine.bounds:
        other = project_parameters(machine, beta, root, [name])
        fall[name] = distance**2 - other.distance**2 if other is not None else 0.0
    largest = max(fall.values(), default=0.0)
    named = [name for name in fall if largest > 0.0 and fall[name] >= 0.5 * largest]
    return sorted(named, key=lambda name: -fall[name])[:3]


_ROUNDS = (1e4, 1e2, 1.0, 1.0)
"""Factors of gamma, one round after the other, each written around the solution before: the first
rounds need few digits, the last have them."""


@dataclass(frozen=True, eq=False)
class ConsistentSolution:
    """Holds physically consistent parameters.

    Attributes:
        chi: (m,) the standard parameters, all ten of every link.
        beta: (c,) K chi.
        covariance: (c, c) of beta, from the curvature of what is minimised: the reference counts
            as knowledge, an active bound does not.
        bounded_links: that would be no bodies without their bound; in `covariance` they have none,
            and no reference.
        excess_squares: by how much the weighted squares are above their least, variances of a row.
        bodies: by link, the pseudo-inertia, SI.
        zero_parameters: friction and rotor inertias that are 0.
    """

    chi: np.ndarray
    beta: np.ndarray
    covariance: np.ndarray
    bounded_links: tuple[str, ...]
    excess_squares: float
    bodies: Mapping[str, np.ndarray]
    zero_parameters: tuple[str, ...]


def solve_consistent(
    machine: PhysicalParameters, whole: np.ndarray, reference: Mapping[str, np.ndarray]
) -> ConsistentSolution:
    """Returns the consistent parameters that fit best.

    Args:
        machine: unknowns and bounds.
        whole: (c + 1, c + 1) or fewer rows, triangle [R z; 0 .] of the rows over their standard
            deviations.
        reference: (4, 4) pseudo-inertias of known links, positive definite; others get one.

    Raises:
        DataError: the solver finds none.
    """
    R, z = whole[:, :-1], whole[:, -1]
    weights = THRESHOLDS.reference_weight, THRESHOLDS.known_reference_weight
    gamma = {name: weights[name in reference] for name in machine.links}
    size = max(float(np.linalg.norm(z)), 1e-300)
    scale, near = compute_scales(machine, R @ machine.K / size), {}
    for name, places in machine.links.items():  # as known, or round, as large as the torques allow
        mass, metre = scale[places[9]] / len(gamma), scale[places[6]] / scale[places[9]]
        body = mass * np.diag([metre**2, metre**2, metre**2, 1.0])
        near[name] = _compute_root(reference.get(name, body))
    problem = _Problem(machine, R @ machine.K, z, gamma, near)
    roots, others = problem.solve_rounds()
    bodies = {name: root @ root.T for name, root in roots.items()}
    chi = problem.assemble_chi(bodies, others)
    bounded = problem.find_bounded_links(roots, chi)
    curvature = problem.compute_covariance(roots, bounded)
    beta = machine.K @ chi
    best = np.linalg.lstsq(R, z, rcond=None)[0]
    excess = float(np.sum((R @ beta - z) ** 2) - np.sum((R @ best - z) ** 2))
    covariance = machine.K @ curvature @ machine.K.T
    zero = problem.find_zero_parameters(others)
    return ConsistentSolution(chi, beta, covariance, bounded, excess, bodies, zero)


_GRADIENT = extract_parameters(np.eye(16).reshape(4, 4, 4, 4))
_PICKS = (_GRADIENT + _GRADIENT.transpose(0, 2, 1)) / 2.0
"""(10, 4, 4) symmetric: each parameter is its inner product with the pseudo-inertia."""

_ROW, _COLUMN = np.triu_indices(4)
_BASIS = np.zeros((10, 4, 4))
_BASIS[range(10), _ROW, _COLUMN] = np.where(_ROW == _COLUMN, 1.0, np.sqrt(0.5))
_BASIS[range(10), _COLUMN, _ROW] = _BASIS[range(10), _ROW, _COLUMN]
"""Of the symmetric matrices, orthonormal."""


_Matrices = Mapping[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class _Problem:
    """Describes the rows A chi = z, and what is added to their squares."""

    machine: PhysicalParameters
    A: np.ndarray
    z: np.ndarray
    gamma: Mapping[str, float]
    reference: Mapping[str, np.ndarray]  # roots of P0: root root' = P0

    @cached_property
    def other_places(self) -> np.ndarray:
        """Returns places in chi of what is no link's: friction, rotor inertias, offsets, loads."""
        return np.setdiff1d(np.arange(self.A.shape[1]), [*self.machine.links.values()])

    @cached_property
    def is_nonnegative(self) -> np.ndarray:
        """Returns True, (others,), for the parameters that cannot be negative."""
        return np.isin(self.other_places, list(self.machine.positive.values()))

    @cached_property
    def scale(self) -> np.ndarray:
        """Returns the scales (others,) of values of no link that give their columns length one."""
        return 1.0 / compute_column_norms(self.A[:, self.other_places])

    def assemble_chi(self, bodies: Mapping[str, np.ndarray], others: np.ndarray) -> np.ndarray:
        """Returns chi (m,), assembled from the bodies and the other values."""
        chi = np.zeros(self.A.shape[1])
        for name, places in self.machine.links.items():
            chi[places] = extract_parameters(bodies[name])
        chi[self.other_places] = others
        return chi

    def solve_rounds(self) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """Returns roots of the bodies, and the other values.

        Raises:
            DataError: the solver finds none.
        """
        roots, others = dict(self.reference), np.zeros(len(self.other_places))
        is_converged = False
        for factor in _ROUNDS:
            solution = self.solve_round(roots, others, factor)
            if solution is not None:
                (roots, others), is_converged = solution, factor == 1.0
        if not is_converged:
            raise DataError(
                "no physically consistent parameters for these logs: the solver does not converge; "
                "use --method weighted and read its warnings"
            )
        return roots, others

    def solve_round(
        self, roots: Mapping[str, np.ndarray], others: np.ndarray, factor: float
    ) -> tuple[dict[str, np.ndarray], np.ndarray] | None:
        """Returns the solution with gamma times a factor, written around near bodies and values.

        None if the solver finds none.
        """
        count, total = len(others), len(others) + 10 * len(roots)
        error, linear = [self.A[:, self.other_places] * self.scale], np.zeros(total)
        bodies = []
        for k, (name, root) in enumerate(roots.items()):
            slots, moves = slice(count + 10 * k, count + 10 * k + 10), np.zeros((total, 4, 4))
            moves[slots] = _BASIS
            bodies.append((np.zeros((4, 4)), moves))
            picks = root.T @ _PICKS @ root  # of X, where P = root X root'
            columns = self.A[:, self.machine.links[name]] @ picks.reshape(-1, 16)
            error.append(columns @ _BASIS.reshape(-1, 16).T)
            turned = np.linalg.solve(self.reference[name], root)
            pull = np.tensordot(_BASIS, turned.T @ turned, 2)
            linear[slots] = 2.0 * factor * self.gamma[name] * pull
        bound = np.flatnonzero(self.is_nonnegative)
        x = minimize_over_cones(
            (np.hstack(error), self.z - self.A[:, self.other_places] @ others),
            (np.eye(count, total)[bound] * self.scale[bound, None], others[bound]),
            bodies,
            [2.0 * factor * self.gamma[name] for name in roots],
            linear,
        )
        if x is None:
            return None
        new = (np.tensordot(part, _BASIS, 1) for part in x[count:].reshape(-1, 10))
        pairs = zip(roots.items(), new, strict=True)
        bodies_of = {name: root @ _compute_root(X) for (name, root), X in pairs}
        least = np.where(self.is_nonnegative, 0.0, -np.inf)
        return bodies_of, np.maximum(others + self.scale * x[:count], least)

    def find_zero_parameters(self, others: np.ndarray) -> tuple[str, ...]:
        """Returns the parameters at their bound: less than a millionth of the torque."""
        size = THRESHOLDS.zero_share * max(float(np.linalg.norm(self.z)), 1e-300) * self.scale
        zero = set(self.other_places[others <= size].tolist())
        return tuple(name for name, place in self.machine.positive.items() if place in zero)

    def build_moves(self, roots: Mapping[str, np.ndarray]) -> np.ndarray:
        """Returns (m, others + 10 links) of chi: scales of others, then P = root (1 + .) root'."""
        unknowns = self.A.shape[1]
        moves = [np.eye(unknowns)[:, self.other_places] * self.scale]
        for name, places in self.machine.links.items():
            move = np.zeros((unknowns, len(_BASIS)))
            body = (roots[name] @ _BASIS @ roots[name].T).transpose(1, 2, 0)
            move[places] = extract_parameters(body)
            moves.append(move)
        return np.hstack(moves)

    def find_bounded_links(self, roots: _Matrices, chi: np.ndarray) -> tuple[str, ...]:
        """Returns links that leave their bound on the shortest way to the least squares."""
        T = self.build_moves(roots)
        step = np.linalg.lstsq(self.A @ T, self.z - self.A @ chi, rcond=1e-12)[0]
        turns = step[len(self.other_places) :].reshape(-1, len(_BASIS)) @ _BASIS.reshape(-1, 16)
        least = np.linalg.eigvalsh(np.eye(4) + turns.reshape(-1, 4, 4))[:, 0]
        return tuple(name for name, x in zip(self.machine.links, least, strict=True) if x < 0.0)

    def compute_covariance(self, roots: _Matrices, bounded: Sequence[str]) -> np.ndarray:
        """Returns (m, m) inverse of the curvature.

        Around X = 1 the curvature of -log det X is the identity in an orthonormal basis of the
        symmetric matrices. Along a bound it is infinite, and says nothing of how far the truth is
        from it: bounded links have none.
        """
        roots = {name: (self.reference if name in bounded else roots)[name] for name in roots}
        stiffness = [0.0 if name in bounded else self.gamma[name] for name in roots]
        T = self.build_moves(roots)
        root = np.hstack([0.0 * self.scale, np.repeat(stiffness, len(_BASIS))]) ** 0.5
        spread = T @ np.linalg.pinv(np.vstack([self.A @ T, np.diag(root)]), rcond=1e-12)
        return np.asarray(spread @ spread.T)


def _compute_root(matrix: np.ndarray) -> np.ndarray:
    """Returns the lower triangle of a positive definite matrix, raised above rounding."""
    values, vectors = np.linalg.eigh((matrix + matrix.T) / 2.0)
    values = np.maximum(values, 1e-12 * max(float(values[-1]), 1e-300))
    return np.asarray(np.linalg.cholesky((vectors * values) @ vectors.T))


def estimate_consistent(problem: Problem) -> Estimate:
    """Returns the consistent estimate, weighted as `solve_least_squares` weights."""
    return make_consistent(problem, solve_least_squares(problem.data, "weighted"), "consistent")


def make_consistent(problem: Problem, start: Estimate, method: str) -> Estimate:
    """Returns the consistent parameters nearest to an estimate in the metric of its equations.

    Of R beta = z, the triangle whose least squares `start` is: those of the weighted rows, or what
    instruments make of them, whose R^T R is the inverse of its covariance as well (Hansen 1982,
    Econometrica 50(4): moments with their best weights).

    Links of which the robot file states all ten parameters are references: a guide, that the data
    overrule. What the data cannot determine has a value here, which follows from the bounds and the
    references, but no sigma.

    Args:
        problem: beta in the units of its columns, y N m or N.
        start: the estimate without bounds.
        method: for the error messages.

    Raises:
        DataError: no compiled robot, or loads beside it; the solver finds no solution.
    """
    model = problem.require_robot(method)
    machine, known = define_physical_parameters(model.spec), collect_references(model.spec)
    whole = problem.data.combine_joints(start.sigma) if start.whole is None else start.whole
    solution = solve_consistent(machine, whole, known)
    is_estimated = np.isin(np.arange(len(solution.beta)), start.rank.kept_columns)
    # d beta = C R^T R d start, with C the covariance: what moves the start moves this along.
    follows = solution.covariance @ whole[:, :-1].T @ whole[:, :-1]
    influence = start.influence
    return dataclasses.replace(
        start,
        beta=solution.beta,
        covariance=solution.covariance * np.outer(is_estimated, is_estimated),
        rank=Rank(start.rank.kept_columns, (), start.rank.last_kept, start.rank.first_dropped),
        standard=dict(zip(machine.names, solution.chi.tolist(), strict=True)),
        sentences=(*start.sentences, *_describe_solution(model.spec, solution, start, known)),
        influence=None if influence is None else influence @ (follows * is_estimated[:, None]).T,
    )


def collect_references(spec: ModuleSpec) -> dict[str, np.ndarray]:
    """Returns (4, 4) pseudo-inertias of links of which the robot file states all ten parameters."""
    nominal = {p.name: p.nominal for p in spec.standard if p.nominal is not None}
    bodies = {}
    for link in dict.fromkeys(p.joint for p in spec.standard if p.effect == "rigid_body"):
        ten = [nominal[name] for p in PREFIXES if (name := f"{p}{link}") in nominal]
        if len(ten) == len(PREFIXES) and ten[-1] > 0.0:
            body = compute_pseudo_inertia(np.array(ten))
            size = np.sqrt(np.maximum(np.diag(body), 0.0))
            size = np.maximum(size, 1e-3 * size[:3].max() * np.array([1.0, 1.0, 1.0, 0.0]))
            body = body + THRESHOLDS.plate_thickness * np.diag(size**2)
            if size.all() and np.linalg.eigvalsh(body / np.outer(size, size))[0] > 0.0:
                bodies[link] = body
    return bodies


def _describe_solution(
    spec: ModuleSpec, solution: ConsistentSolution, start: Estimate, known: Mapping[str, np.ndarray]
) -> list[str]:
    degrees, lines = len(solution.beta), []
    if solution.excess_squares > degrees:
        lines.append(
            f"physical consistency raises the weighted squares by {solution.excess_squares:.3g} "
            f"(expected at most {degrees}): a model term is missing; see the warnings of --method "
            "weighted"
        )
    if solution.bounded_links:
        lines.append(
            f"link {', '.join(solution.bounded_links)}: at the bound of physical consistency, by "
            "noise or a missing effect; its sigmas are those without the bound"
        )
    # Of the parameters at 0: which the data would have below it, and which they do not determine.
    sums = [[term.parameter for term in base.terms] for base in spec.base]
    negative = [name for name in solution.zero_parameters if [name] in sums]
    if negative:
        lines.append(f"{', '.join(negative)} held at 0, which would be negative")
    for name in solution.zero_parameters:
        if name not in negative:
            beside = dict.fromkeys(x for terms in sums if name in terms for x in terms)
            others = " and ".join(x for x in beside if x != name)
            lines.append(f"{name} is not identifiable apart from {others} and is put at 0")
    if start.rank.dropped_columns:
        names = ", ".join(dropped.name for dropped in start.rank.dropped_columns)
        lines.append(f"not identifiable from these data; fixed by physical consistency: {names}")
    loose = [link for link in solution.bodies if link not in known]
    if loose:
        lines.append(
            f"link {', '.join(loose)}: not all ten parameters are stated in [parameters]; those "
            "without effect on the torques are of a round body and mean nothing by themselves"
        )
    return lines
