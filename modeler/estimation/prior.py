"""What is known beforehand: nominal values as a Gaussian prior of the base parameters.

The robot file says chi ~ N(chi_0, S) of standard parameters; base parameters are beta = K chi, so

    beta ~ N(K chi_0, K S K^T).

Of a body of mass m, centre c, inertia I about it and relative uncertainty r, independent are: the
mass, sd r m; the first moments about the centre, r m max(|c|, rho) with rho = sqrt(tr I / m); the
six inertias about the centre, r tr(I) / 2. In the frame of the joint they are those of

    P = A | Sigma  0 | A^T,   A = | 1  c |,   Sigma = tr(I)/2 1 - I,
          |   0    m |            | 0  1 |

the pseudo-inertia, to first order: a congruence of small symmetric matrices. Parameters of which
nothing is said are free: whatever they may be, only what is left of beta without them is known.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import chdtrc, chdtri

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_error_pair, format_percent
from modeler.estimation import physical_consistency
from modeler.estimation.covariance import compute_roots
from modeler.estimation.least_squares import Estimate, expand_columns, solve_by_qr
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics import least_squares


@dataclass(frozen=True, eq=False)
class Prior:
    """Holds N(K chi_0, K S K^T) of c base parameters, m standard ones.

    Attributes:
        names: (c,) base parameters.
        K: (c, m) beta = K chi.
        mean: (m,) chi_0; 0 for those that are free.
        S: (m, m); 0 for those that are free.
        groups: what is known together: "link 2", or a name, and its places in chi.
        fixed_names: base parameters that cannot move.
        skipped_bodies: that have no prior, and why.
    """

    names: tuple[str, ...]
    K: np.ndarray
    mean: np.ndarray
    S: np.ndarray
    groups: Mapping[str, list[int]]
    fixed_names: tuple[str, ...]
    skipped_bodies: Mapping[str, str]

    @property
    def has_bodies(self) -> bool:
        """Returns True if something is known of the mass of a link."""
        return any(len(places) > 1 for places in self.groups.values())

    def exclude_groups(self, names: Sequence[str]) -> "Prior":
        """Returns the prior without some groups."""
        groups = {name: places for name, places in self.groups.items() if name not in names}
        return dataclasses.replace(self, groups=groups)

    def scale_sigmas(self, factors: Mapping[str, float]) -> "Prior":
        """Returns the prior with standard deviations of some groups so many times as large."""
        scale = np.ones(len(self.S))
        for name, factor in factors.items():
            scale[self.groups[name]] *= factor
        return dataclasses.replace(self, S=self.S * np.outer(scale, scale))

    def evaluate_prior(self, M: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns what is known of M beta: N (r, k), N M K chi_0 (r,), a root of its covariance.

        The rows of N are orthonormal and see nothing of parameters that are free; the root is
        (r, m).

        Args:
            M: (k, c).
        """
        every = [i for places in self.groups.values() for i in places]
        K, least = M @ self.K, THRESHOLDS.rounding_share
        loose = np.delete(K, every, axis=1)
        U, s, _ = np.linalg.svd(loose / least_squares.compute_column_norms(loose))
        N = U[:, int(np.sum(s > least * s.max(initial=1.0))) :].T
        largest = np.abs(N @ K[:, every]).max(axis=1, initial=0.0)
        N = N[largest > least * np.abs(K).max(initial=0.0)]
        part = N @ K[:, every]
        return N, part @ self.mean[every], part @ self._root[every]

    @cached_property
    def _root(self) -> np.ndarray:
        """(m, m) S = root root^T; groups stay apart."""
        size = np.sqrt(np.diag(self.S))
        safe = np.where(size > 0.0, size, 1.0)
        values, vectors = np.linalg.eigh(self.S / np.outer(safe, safe))
        half = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
        return np.asarray(size[:, None] * half)

    def build_rows(self, lengths: np.ndarray) -> np.ndarray:
        """Returns (r, c + 1) [R, R beta_0] with R^T R the information on beta.

        Args:
            lengths: (c,) of the weighted columns of the data, 1 / sd of each parameter alone: what
                is fixed is `fixed_sigma_share` of that.
        """
        scale = np.where(lengths > 0.0, lengths, 1.0)
        N, mean, root = self.evaluate_prior(np.diag(scale))
        vectors, values, _ = np.linalg.svd(root)
        values = np.pad(values, (0, len(vectors) - len(values)))
        turn = vectors / np.maximum(values, THRESHOLDS.fixed_sigma_share)
        return np.column_stack([turn.T @ N * scale, turn.T @ mean])

    def extend_rows(self, lengths: np.ndarray) -> np.ndarray:
        """Returns (r, k + 1) rows of the k columns of a fit, first the base parameters."""
        rows = self.build_rows(lengths[: len(self.names)])
        return np.insert(rows, [len(self.names)] * (len(lengths) - len(self.names)), 0.0, axis=1)

    def find_unlikely_groups(self, beta: np.ndarray) -> list[str]:
        """Returns groups whose likeliest chi of beta (c,) is improbably far off."""
        N, mean, root = self.evaluate_prior(np.eye(len(beta)))
        size = np.linalg.norm(root, axis=1)
        is_free = size > THRESHOLDS.rounding_share * size.max(initial=0.0)
        size = np.where(is_free, size, np.inf)  # fixed: moves nothing
        apart = np.linalg.lstsq(root / size[:, None], (N @ beta - mean) / size, rcond=1e-9)[0]
        squares = {name: np.sum(apart[places] ** 2) for name, places in self.groups.items()}
        chance = THRESHOLDS.chance_probability
        return [k for k, square in squares.items() if chdtrc(len(self.groups[k]), square) < chance]

    def find_contradictions(
        self, M: np.ndarray, value: np.ndarray, covariance: np.ndarray
    ) -> dict[str, str]:
        """Returns a line for each body or value that the data contradict.

        d = M beta_0 - value has the covariance V + M K S K^T M^T, and d^T (..)^-1 d is chi-square.
        Without the prior of a group it falls, by chi-square of as many degrees as are lost; that
        which falls by least chance is reported, and those that fall by half as much.

        Args:
            M: (k, c) what the data determine of beta.
            value: (k,).
            covariance: (k, k) V.
        """

        def compute_misfit(prior: "Prior") -> tuple[float, int]:
            N, mean, root = prior.evaluate_prior(M)
            d, total = mean - N @ value, root @ root.T + N @ covariance @ N.T
            size = np.sqrt(np.maximum(np.diag(total), 1e-300))
            apart = np.linalg.lstsq(total / np.outer(size, size), d / size, rcond=1e-12)[0]
            return float(d / size @ apart), len(d)

        whole, degrees = compute_misfit(self)
        chance = THRESHOLDS.chance_probability / max(1, len(self.groups))
        falls = {}
        for name in self.groups:
            left, rest = compute_misfit(self.exclude_groups([name]))
            lost, fall = degrees - rest, max(whole - left, 0.0)
            if lost and chdtrc(lost, fall) < chance:
                falls[name] = fall**0.5, chdtri(lost, chance) ** 0.5
        most = max((fall for fall, _ in falls.values()), default=0.0)
        named = sorted(falls.items(), key=lambda item: -item[1][0])
        left_out = ", and it is left out of the prior"
        return {
            name: f"{name}: the data contradict the robot file: distance {fall:.3g} sigma "
            f"(threshold {limit:.2g}){'' if self._is_fixed(name) else left_out}; correct "
            "[parameters] or its uncertainty, or run `modeler diagnose`"
            for name, (fall, limit) in named
            if fall**2 >= 0.5 * most**2
        }

    def _is_fixed(self, name: str) -> bool:
        """Returns True if a group cannot move."""
        return not self.S[self.groups[name]].any()

    def combine_with_data(
        self,
        estimate: Estimate,
        data: least_squares.CompressedRegression,
        covariance: np.ndarray,
        more: np.ndarray | float = 0.0,
        joints: Sequence[str] = (),
    ) -> Estimate:
        """Returns the estimate of data and prior together.

        The data determine theta = M beta of covariance V, raised for autocorrelated rows, and
        M = [1 T] where T carries columns that were dropped: least squares of
        [V^-1/2 (M beta - theta); R (beta - beta_0)].

        Args:
            estimate: of the data.
            data: of which columns; first the base parameters, then those of loads.
            covariance: (c, c) V, 0 for dropped columns.
            more: (c,) variance of what halves of the data disagree about. It is no noise: beside
                V, it would part values of which the data know the sum. Data that contradict the
                prior do so beyond it, and it stays in the standard deviations.
            joints: names, for a line on each that the prior makes worse.
        """
        whole = data.combine_joints(estimate.sigma)
        columns, c = np.asarray(estimate.rank.kept_columns, dtype=int), len(estimate.beta)
        M, V = np.zeros((len(columns), c)), covariance[np.ix_(columns, columns)]
        rest = np.setdiff1d(np.arange(c), columns)
        M[:, columns] = np.eye(len(columns))
        M[:, rest] = least_squares.solve_scaled_least_squares(whole[:, columns], whole[:, rest])
        values = estimate.beta[columns]
        whitened = compute_roots(V)[1] @ np.column_stack([M, values])
        doubt = V + np.diag(np.broadcast_to(more, c)[columns])
        against = self.find_contradictions(M[:, : len(self.names)], values, doubt)
        prior = self.exclude_groups([name for name in against if not self._is_fixed(name)])
        lengths = np.linalg.norm(whitened[:, :-1], axis=0)
        both = np.vstack([whitened, prior.extend_rows(lengths)])
        rank = least_squares.find_independent_columns(both[:, :-1], data.names)
        used = list(rank.kept_columns)
        values, half = solve_by_qr(both[:, used], both[:, -1])
        beta, posterior = expand_columns(c, used, values, half @ half.T)
        before, after = np.full(c, np.inf), np.diag(posterior)
        before[columns] = np.diag(V)
        share = np.clip(1.0 - after / before, 0.0, 1.0)
        posterior = posterior + np.diag(np.where(after > 0.0, more, 0.0))
        noise = np.zeros((1, c + 1))
        noise[0, -1] = max(1, estimate.degrees) ** 0.5
        raised = _find_raised_errors(data, estimate.beta, beta, joints)
        return dataclasses.replace(
            estimate,
            beta=beta,
            covariance=posterior,
            rank=rank,
            whole=least_squares.compute_triangle(np.vstack([both, noise])),
            prior_share=share,
            fixed_names=self.fixed_names,
            contradicted=(*against.values(), *raised),
            sentences=(*estimate.sentences, *prior.format_sentences(share)),
        )

    def combine_if_useful(
        self,
        estimate: Estimate,
        data: least_squares.CompressedRegression,
        covariance: np.ndarray,
        more: np.ndarray,
        joints: Sequence[str],
    ) -> tuple[Estimate, "Prior | None", list[str]]:
        """Returns `combine_with_data`, the prior that is used, and a line if it is not all of this.

        Bodies of a drawing, or of another build, may be sure of themselves only: where a joint's
        torque is predicted worse with them than by none at all, and better without, they are left
        out.
        """
        both = self.combine_with_data(estimate, data, covariance, more, joints)
        torque = np.where(data.free, np.inf, data.compute_torque_norms())
        free, bound = (data.compute_residual_norms(fit.beta) for fit in (estimate, both))
        worst = int(np.argmax(np.where(free < torque, bound / np.maximum(torque, 1e-300), 0.0)))
        if not self.has_bodies or bound[worst] <= torque[worst]:
            return both, self, []
        bodies = [name for name, places in self.groups.items() if len(places) > 1]
        error, before = format_error_pair(*(x[worst] / torque[worst] for x in (bound, free)))
        line = (
            f"prior of the robot file on {', '.join(bodies)}: left out, as the fit error of joint "
            f"{joints[worst]} is {error} with it and {before} without"
        )
        others = self.exclude_groups(bodies)
        if not others.groups:
            return estimate, None, [line]
        rest = others.combine_with_data(estimate, data, covariance, more, joints)
        return rest, others, [line]

    def format_sentences(self, share: np.ndarray) -> list[str]:
        """Returns what the prior did."""
        count, lines = len(self.names), []
        if self.groups:
            lines.append(
                f"prior of the robot file on {', '.join(self.groups)}: it gives "
                f"{format_percent(share[:count].mean())} of the information on {count} parameters"
            )
        if self.skipped_bodies:
            reasons = ", ".join(f"{name} ({why})" for name, why in self.skipped_bodies.items())
            lines.append(f"no prior from [parameters] on placeholders: {reasons}")
        return lines


def _find_raised_errors(
    data: least_squares.CompressedRegression,
    free: np.ndarray,
    beta: np.ndarray,
    joints: Sequence[str],
) -> list[str]:
    """Returns a line for each joint whose error the prior raises beyond three standard errors."""
    torque = data.compute_torque_norms()
    before, after = data.compute_residual_norms(free), data.compute_residual_norms(beta)
    chance = 3.0 / np.sqrt(2.0 * np.maximum(data.rows, 1))
    return [
        f"joint {name}: the prior of the robot file raises its fit error from "
        f"{format_percent(a / t)} to {format_percent(b / t)}; correct [parameters] or its "
        "uncertainty"
        for name, t, a, b, most in zip(joints, torque, before, after, chance, strict=False)
        if t > 0.0 and b > (1.0 + max(THRESHOLDS.max_prior_error, float(most))) * a
    ]


def build_prior(spec: ModuleSpec) -> Prior | None:
    """Returns the prior of a robot file; None without `[parameters.uncertainty]` and `held`."""
    machine, every = physical_consistency.define_physical_parameters(spec), spec.standard
    share = spec.inertial_uncertainty
    if share is None and all(p.deviation is None for p in every):
        return None
    count = len(machine.names)
    mean, S = np.zeros(count), np.zeros((count, count))
    groups: dict[str, list[int]] = {}
    skipped: dict[str, str] = {}
    value = {p.name: p.nominal for p in every}
    for link, places in machine.links.items() if share else ():
        ten = [value.get(machine.names[i], 0.0) for i in places]  # 0 where no torque depends on it
        stated = np.array([worth or 0.0 for worth in ten])
        why, block = compute_body_covariance(stated, share or 0.0)
        if None in ten:
            why = "its ten parameters are not all stated"
        elif not why and not block[0, 0] and max(places) < len(every):
            why = "inertia of 0"
        if why:
            skipped[f"link {link}"] = why
        else:
            mean[places], S[np.ix_(places, places)] = stated, block
            groups[f"link {link}"] = places.tolist()
    of_links = {i for group in groups.values() for i in group}
    for i, parameter in enumerate(every):
        if parameter.deviation is not None:
            S[i], S[:, i] = 0.0, 0.0
            S[i, i], mean[i] = parameter.deviation**2, parameter.nominal or 0.0
            if i not in of_links:
                groups[parameter.name] = [i]
    names = tuple(base.name for base in spec.base)
    held = {p.name for p in every if p.deviation == 0.0}
    fixed = tuple(b.name for b in spec.base if all(term.parameter in held for term in b.terms))
    return Prior(names, machine.K, mean, S, groups, fixed, skipped)


def compute_body_covariance(ten: np.ndarray, share: float) -> tuple[str, np.ndarray]:
    """Returns why these are the ten parameters of no body, or (10, 10) their covariance.

    A body that its own uncertainty makes possible is one.

    Args:
        ten: in the order of `PREFIXES`, SI.
        share: relative uncertainty.
    """
    none, mass, P = np.zeros((10, 10)), ten[9], physical_consistency.compute_pseudo_inertia(ten)
    if mass <= 0.0:
        return "mass of 0" if mass == 0.0 else "negative mass", none
    centre = P[:3, 3] / mass
    second = P[:3, :3] - mass * np.outer(centre, centre)
    moments = float(np.trace(second))  # tr(I) / 2 about the centre
    if np.allclose(second, 0.5 * np.eye(3), atol=1e-9):
        return "identity inertia", none
    if np.linalg.eigvalsh(second)[0] < -share * moments or moments < 0.0:
        return "not physically possible", none
    metre = max(float(np.linalg.norm(centre)), (2.0 * moments / mass) ** 0.5)
    # About the centre: inertias, and with them Sigma; first moments; mass.
    about = share * np.repeat([moments, mass * metre, mass], [6, 3, 1])
    carry = np.eye(4)
    carry[:3, 3] = centre
    moved = np.einsum(
        "ai,ijk,bj->abk", carry, physical_consistency.compute_pseudo_inertia(np.diag(about)), carry
    )
    turned = physical_consistency.extract_parameters(moved)
    return "", turned @ turned.T


def describe_unused_prior(spec: ModuleSpec, what: str, use: str) -> tuple[str, ...]:
    """Returns what an estimator without a prior makes of [parameters]; nothing without them.

    Args:
        spec: of the robot.
        what: estimates.
        use: of the values of the bodies.

    Raises:
        DataError: the robot file states uncertainties of single parameters, or holds them.
    """
    if named := [p.name for p in spec.standard if p.deviation is not None]:
        raise DataError(
            f"{what} cannot hold parameters or weigh them one by one; got {', '.join(named)} in "
            f"[parameters.uncertainty] or held of {spec.robot}; leave them out there, or use "
            "method weighted"
        )
    share = spec.inertial_uncertainty
    if share is None:
        return ()
    return (f"{what} does not use inertial = {share:g} of [parameters.uncertainty]{use}",)
