"""Values of a machine that could be built, down to every standard parameter of every link.

    minimise  1/2 ||R (K chi) - z||^2 + gamma sum_j (tr(P0_j^-1 P_j) - log det(P0_j^-1 P_j) - 4)

over the standard parameters chi with every pseudo-inertia P_j positive definite (`possible`) and
friction and rotor inertias not negative. R and z are the weighted rows of the fit, so that the
first term counts standard deviations; the second, the log-determinant divergence from a reference
body P0_j, keeps every link inside what can be built, does not depend on units or frames, and
decides what no torque feels (Lee, Wensing and Park 2020, IEEE T-RO 36(2); Sousa and Cortesao 2014,
IJRR 33(6)). Convex: solved by cvxpy with Clarabel.
"""

import contextlib
import dataclasses
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.estimation.least_squares import Estimate, Problem, solve_least_squares
from modeler.estimation.nearest_body import (
    PREFIXES,
    PhysicalParameters,
    compute_pseudo_inertia,
    compute_scales,
    define_physical_parameters,
    extract_parameters,
)
from modeler.numerics.least_squares import Rank, compute_column_norms

WEIGHT = 0.01
"""gamma where nothing is known of the links: so small that no value which the data tell moves."""

KNOWN_WEIGHT = 1.0
"""gamma of a link that the robot file states: to be off by its own size, in any direction of the
pseudo-inertia, costs about as much as one standard deviation of a row. A guide, not a fact."""

_ROUNDS = (1e4, 1e2, 1.0, 1.0)
"""Factors of gamma, one round after the other, each written around the answer before: the first
rounds need few digits, the last have them."""

_AT_ZERO = 1e-6  # of its scale: a friction this small is at its bound


@dataclass(frozen=True, eq=False)
class ConsistentSolution:
    """A machine that could be built.

    Attributes:
        chi: (m,) unknowns of the `PhysicalParameters`: the standard parameters, all ten of every
            link.
        beta: (c,) K chi.
        covariance: (c, c) of beta, from the curvature of what is minimised: the reference counts
            as knowledge, a bound that holds does not.
        held: links that would be no bodies without their bound; in `covariance` they have none,
            and no reference.
        rise: by how much the weighted squares are above their least, in variances of a row.
        bodies: by link, the pseudo-inertia, SI.
        at_bound: friction and rotor inertias that are 0.
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
    """The machine that fits best.

    Args:
        machine: unknowns and bounds.
        whole: (c + 1, c + 1) or fewer rows, triangle [R z; 0 .] of the rows over their standard
            deviations.
        reference: (4, 4) pseudo-inertias of known links, positive definite; others get one.

    Raises:
        DataError: the solver finds no answer.
    """
    R, z = whole[:, :-1], whole[:, -1]
    gamma = {name: KNOWN_WEIGHT if name in reference else WEIGHT for name in machine.links}
    near = {
        name: _compute_root(P) for name, P in _build_references(machine, R, z, reference).items()
    }
    problem = _Problem(machine, R @ machine.K, z, gamma, near)
    roots, others = problem.solve_rounds()
    bodies = {name: root @ root.T for name, root in roots.items()}
    chi = problem.assemble_chi(bodies, others)
    held = problem.find_bounded_links(roots, chi)
    curvature = problem.compute_covariance(roots, held)
    beta = machine.K @ chi
    best = np.linalg.lstsq(R, z, rcond=None)[0]
    rise = float(np.sum((R @ beta - z) ** 2) - np.sum((R @ best - z) ** 2))
    return ConsistentSolution(
        chi,
        beta,
        machine.K @ curvature @ machine.K.T,
        held,
        rise,
        bodies,
        problem.find_zero_parameters(others),
    )


_GRADIENT = extract_parameters(np.eye(16).reshape(4, 4, 4, 4))
_PICKS = (_GRADIENT + _GRADIENT.transpose(0, 2, 1)) / 2.0
"""(10, 4, 4) symmetric: each parameter is its inner product with the pseudo-inertia."""

_ROW, _COLUMN = np.triu_indices(4)
_BASIS = np.zeros((10, 4, 4))
_BASIS[range(10), _ROW, _COLUMN] = np.where(_ROW == _COLUMN, 1.0, np.sqrt(0.5))
_BASIS[range(10), _COLUMN, _ROW] = _BASIS[range(10), _ROW, _COLUMN]
"""Of the symmetric matrices, orthonormal."""


@dataclass(frozen=True, eq=False)
class _Problem:
    """The rows A chi = z, and what is added to their squares."""

    machine: PhysicalParameters
    A: np.ndarray
    z: np.ndarray
    gamma: Mapping[str, float]
    reference: Mapping[str, np.ndarray]  # roots of P0: root root' = P0

    @cached_property
    def other_places(self) -> list[int]:
        """Places in chi of what is no link's: friction, rotor inertias, offsets, loads."""
        inertial = [place for places in self.machine.links.values() for place in places]
        return np.setdiff1d(np.arange(self.A.shape[1]), inertial).tolist()

    @cached_property
    def is_nonnegative(self) -> np.ndarray:
        """(others,) True for those that cannot be negative."""
        return np.isin(self.other_places, list(self.machine.positive.values()))

    @cached_property
    def scale(self) -> np.ndarray:
        """(others,) of their values, so that their columns have length one."""
        return 1.0 / compute_column_norms(self.A[:, self.other_places])

    def assemble_chi(self, bodies: Mapping[str, np.ndarray], others: np.ndarray) -> np.ndarray:
        """(m,) all unknowns."""
        chi = np.zeros(self.A.shape[1])
        for name, places in self.machine.links.items():
            chi[places] = extract_parameters(bodies[name])
        chi[self.other_places] = others
        return chi

    def solve_rounds(self) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """Roots of the bodies, and the other values.

        Raises:
            DataError: the solver does not get there.
        """
        roots, others, settled = dict(self.reference), np.zeros(len(self.other_places)), False
        for factor in _ROUNDS:
            solution = self.solve_round(roots, others, factor)
            if solution is not None:
                (roots, others), settled = solution, factor == 1.0
        if not settled:
            raise DataError(
                "no machine that could be built was found for these logs (the solver does not "
                "settle); use --method weighted, and look at what its doubts say"
            )
        return roots, others

    def solve_round(
        self, roots: Mapping[str, np.ndarray], others: np.ndarray, factor: float
    ) -> tuple[dict[str, np.ndarray], np.ndarray] | None:
        """The answer with gamma times a factor, written around bodies and values near to it.

        None if the solver does not get there.
        """
        import cvxpy as cp  # only here: other fits need not wait for it

        scale = self.scale
        error = -self.z + self.A[:, self.other_places] @ others
        step = cp.Variable(len(others))
        total = (self.A[:, self.other_places] * scale) @ step
        bounds = [
            others[i] + scale[i] * step[i] >= 0.0 for i in np.flatnonzero(self.is_nonnegative)
        ]
        X = {name: cp.Variable((4, 4), PSD=True) for name in roots}
        divergence = cp.Constant(0.0)
        for name, root in roots.items():
            picks = root.T @ _PICKS @ root  # of X, where P = root X root'
            columns = self.A[:, self.machine.links[name]] @ picks.reshape(-1, 16)
            error = error + columns @ np.eye(4).ravel()
            total = total + columns @ cp.vec(X[name] - np.eye(4), order="C")
            turned = np.linalg.solve(self.reference[name], root)
            pull = cp.trace(turned.T @ turned @ X[name]) - cp.log_det(X[name])
            divergence = divergence + factor * self.gamma[name] * pull
        goal = cp.Minimize(0.5 * cp.sum_squares(total + error) + divergence)
        problem = cp.Problem(goal, bounds)
        with contextlib.suppress(cp.SolverError), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # the status is looked at below
            problem.solve(solver=cp.CLARABEL)
        if problem.status not in ("optimal", "optimal_inaccurate"):
            return None
        new_roots = {
            name: root @ _compute_root(np.asarray(X[name].value)) for name, root in roots.items()
        }
        moved = others if step.value is None else others + scale * step.value
        return new_roots, np.maximum(moved, np.where(self.is_nonnegative, 0.0, -np.inf))

    def find_zero_parameters(self, others: np.ndarray) -> tuple[str, ...]:
        """The parameters at their bound: less than a millionth of the torque."""
        size = _AT_ZERO * max(float(np.linalg.norm(self.z)), 1e-300) * self.scale
        zero = {self.other_places[i] for i in np.flatnonzero(others <= size)}
        return tuple(name for name, place in self.machine.positive.items() if place in zero)

    def build_moves(self, roots: Mapping[str, np.ndarray]) -> np.ndarray:
        """(m, others + 10 links) of chi: by the scales of others, then P = root (1 + .) root'."""
        unknowns = self.A.shape[1]
        moves = [np.eye(unknowns)[:, self.other_places] * self.scale]
        for name, places in self.machine.links.items():
            move = np.zeros((unknowns, len(_BASIS)))
            move[places] = extract_parameters(
                (roots[name] @ _BASIS @ roots[name].T).transpose(1, 2, 0)
            )
            moves.append(move)
        return np.hstack(moves)

    def find_bounded_links(
        self, roots: Mapping[str, np.ndarray], chi: np.ndarray
    ) -> tuple[str, ...]:
        """Links that leave their bound on the shortest way to the least squares of the rows."""
        T = self.build_moves(roots)
        step = np.linalg.lstsq(self.A @ T, self.z - self.A @ chi, rcond=1e-12)[0]
        turns = step[len(self.other_places) :].reshape(-1, len(_BASIS)) @ _BASIS.reshape(-1, 16)
        least = np.linalg.eigvalsh(np.eye(4) + turns.reshape(-1, 4, 4))[:, 0]
        return tuple(
            name
            for name, eigenvalue in zip(self.machine.links, least, strict=True)
            if eigenvalue < 0.0
        )

    def compute_covariance(
        self, roots: Mapping[str, np.ndarray], held: Sequence[str]
    ) -> np.ndarray:
        """(m, m) inverse of the curvature.

        Around X = 1 the curvature of -log det X is the identity in an orthonormal basis of the
        symmetric matrices. Along a bound it is endless, and says nothing of how far the truth is
        from it: links that are held have none.
        """
        roots = {name: self.reference[name] if name in held else roots[name] for name in roots}
        stiffness = [0.0 if name in held else self.gamma[name] for name in roots]
        T = self.build_moves(roots)
        root = np.hstack([0.0 * self.scale, np.repeat(stiffness, len(_BASIS))]) ** 0.5
        spread = T @ np.linalg.pinv(np.vstack([self.A @ T, np.diag(root)]), rcond=1e-12)
        return np.asarray(spread @ spread.T)


def _build_references(
    machine: PhysicalParameters, R: np.ndarray, z: np.ndarray, known: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """Reference bodies: as known, or round, of the mass and size that the torques allow."""
    size = max(float(np.linalg.norm(z)), 1e-300)
    scale = compute_scales(machine, R @ machine.K / size)
    bodies = {}
    for name, places in machine.links.items():
        mass, metre = scale[places[9]] / len(machine.links), scale[places[6]] / scale[places[9]]
        bodies[name] = known.get(name, mass * np.diag([metre**2, metre**2, metre**2, 1.0]))
    return bodies


def _compute_root(matrix: np.ndarray) -> np.ndarray:
    """Lower triangle of a positive definite matrix; what rounding made negative is raised."""
    values, vectors = np.linalg.eigh((matrix + matrix.T) / 2.0)
    values = np.maximum(values, 1e-12 * max(float(values[-1]), 1e-300))
    return np.asarray(np.linalg.cholesky((vectors * values) @ vectors.T))


# The physically consistent estimator: from a problem to a machine that could be built.


_LEAST = 1e-6  # a plate or a rod of a drawing is given so much thickness, relative


def estimate_consistent(problem: Problem) -> Estimate:
    """The machine that fits best, weighted as `solve_least_squares` weights.

    See " "`make_consistent`.
    """
    return make_consistent(problem, solve_least_squares(problem.data, "weighted"), "consistent")


def make_consistent(problem: Problem, start: Estimate, method: str) -> Estimate:
    """The machine nearest to an estimate in the metric of its own equations.

    Of R beta = z, the triangle whose least squares `start` is: those of the weighted rows, or what
    instruments make of them, whose R^T R is the inverse of its covariance as well (Hansen 1982,
    Econometrica 50(4): moments with their best weights).

    Links of which the robot file states all ten parameters are references: a guide, that the data
    overrule. What the data cannot tell has a value here, which follows from the bounds and the
    references, but no sigma.

    Args:
        problem: beta in the units of its columns, y N m or N.
        start: the estimate without bounds.
        method: for the refusals.

    Raises:
        DataError: no compiled robot, or loads beside it; the solver finds no answer.
    """
    model = problem.require_robot(method)
    machine = define_physical_parameters(model.spec)
    known = collect_references(model.spec)
    whole = problem.data.combine_joints(start.sigma) if start.whole is None else start.whole
    solution = solve_consistent(machine, whole, known)
    is_estimated = np.isin(np.arange(len(solution.beta)), start.rank.kept_columns)
    # d beta = C R^T R d start, with C the covariance: what moves the start moves this along.
    follows = solution.covariance @ whole[:, :-1].T @ whole[:, :-1]
    return dataclasses.replace(
        start,
        beta=solution.beta,
        covariance=solution.covariance * np.outer(is_estimated, is_estimated),
        rank=Rank(start.rank.kept_columns, (), start.rank.last_kept, start.rank.first_dropped),
        standard=dict(zip(machine.names, solution.chi.tolist(), strict=True)),
        sentences=(*start.sentences, *_describe_solution(model.spec, solution, start, known)),
        influence=None
        if start.influence is None
        else start.influence @ (follows * is_estimated[:, None]).T,
    )


def collect_references(spec: ModuleSpec) -> dict[str, np.ndarray]:
    """(4, 4) pseudo-inertias of the links of which the robot file states all ten parameters."""
    nominal = {p.name: p.nominal for p in spec.standard if p.nominal is not None}
    bodies = {}
    for link in dict.fromkeys(p.joint for p in spec.standard if p.effect == "rigid_body"):
        ten = [nominal[name] for p in PREFIXES if (name := f"{p}{link}") in nominal]
        if len(ten) == len(PREFIXES) and ten[-1] > 0.0:
            body = compute_pseudo_inertia(np.array(ten))
            size = np.sqrt(np.maximum(np.diag(body), 0.0))
            size = np.maximum(size, 1e-3 * size[:3].max() * np.array([1.0, 1.0, 1.0, 0.0]))
            body = body + _LEAST * np.diag(size**2)
            if size.all() and np.linalg.eigvalsh(body / np.outer(size, size))[0] > 0.0:
                bodies[link] = body
    return bodies


def _describe_solution(
    spec: ModuleSpec, solution: ConsistentSolution, start: Estimate, known: Mapping[str, np.ndarray]
) -> list[str]:
    degrees = len(solution.beta)
    said = []
    if solution.excess_squares > degrees:
        said.append(
            f"a machine that could be built leaves {solution.excess_squares:.3g} variances more "
            "than least "
            f"squares, where its {degrees} values would raise it by {degrees} if they were wrong "
            "by one sigma each: these logs hold something that the model does not; see the doubts "
            "of --method weighted"
        )
    if solution.bounded_links:
        said.append(
            f"link {', '.join(solution.bounded_links)}: at the bound of what can be built, which "
            "noise or a "
            "missing effect would cross; the sigmas of such a link are those without the bound"
        )
    # Of the parameters at 0: which the data would have below it, and which they do not tell.
    sums = [[term.parameter for term in base.terms] for base in spec.base]
    negative_names = [name for name in solution.zero_parameters if [name] in sums]
    if negative_names:
        said.append(f"{', '.join(negative_names)} held at 0, which would be negative")
    for name in solution.zero_parameters:
        if name not in negative_names:
            beside = dict.fromkeys(x for terms in sums if name in terms for x in terms)
            others = " and ".join(x for x in beside if x != name)
            said.append(f"{name} cannot be told from {others} and is put at 0")
    if start.rank.dropped_columns:
        names = ", ".join(tangle.name for tangle in start.rank.dropped_columns)
        said.append(f"not told by these data, but by what can be built: {names}")
    loose = [link for link in solution.bodies if link not in known]
    if loose:
        said.append(
            f"link {', '.join(loose)}: no drawing in the robot file ([parameters]); what no torque "
            "feels of it is that of a round body, and means nothing by itself"
        )
    return said
