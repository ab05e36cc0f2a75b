"""The energy model: work of the motors over windows, and its fit (Houda et al., section 4)."""

import dataclasses
from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.table import format_percent
from modeler.estimation.covariance import estimate_autocorrelation, sum_lagged_products
from modeler.estimation.identify import (
    build_base_equations,
    build_result,
    find_disconnected_joints,
    find_method,
    identify,
)
from modeler.estimation.least_squares import Estimate, compute_condition_numbers, expand_columns
from modeler.estimation.parameters import EssentialParameters, select_essential_parameters
from modeler.estimation.result import EnergyReport, FitResult, ModelFigures
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics import least_squares
from modeler.regression import Observation, Segment, compute_signals, find_runs
from modeler.runtime import CompiledModel

Rule = Literal["simpson", "trapezoid"]
"""How powers are integrated."""


@dataclass(frozen=True, eq=False)
class EnergyRows:
    """Holds y = W beta of r windows; n joints, c base parameters.

    Attributes:
        W: (r, c) work of each base parameter at value one over the window; W beta in J.
        y: (r,) work of the motors, J.
        balance: (r, c) the same as W with the difference of kinetic energy replaced by the
            integral of its power, which needs accelerations: W and it differ by the quadrature.
        spread: (r, n) variance of y for white torque noise of variance one on a joint, m2 or rad2.
        stretch: (r,) number of the uninterrupted segment, unique over the logs; the windows of
            one follow each other.
        time: (r, 2) s, first and last sample.
        run: (r,) index of the log.
        window: s, length of a window.
    """

    W: np.ndarray
    y: np.ndarray
    balance: np.ndarray
    spread: np.ndarray
    stretch: np.ndarray
    time: np.ndarray
    run: np.ndarray
    window: float

    def estimate(self, names: tuple[str, ...], method: Method) -> "HeteroscedasticEstimate":
        """Estimates beta by `solve_heteroscedastic`."""
        return solve_heteroscedastic(self.W, self.y, self.spread, names, self.stretch, method)


def build_energy_rows(
    model: CompiledModel,
    observation: Observation,
    window: float | None = None,
    rule: Rule = "simpson",
) -> EnergyRows:
    """Returns the rows of the energy model of Houda, Amouri, Beji and Mallem, eqs. (13) to (17).

        y = int tau^T qd dt = (Delta h) beta + int of the power of all other parameters,

    over windows that follow each other. A parameter of inertia has the power of its kinetic energy
    E = qd^T M(q) qd / 2, whose integral is E(t2) - E(t1) without any acceleration, and that of
    gravity, qd^T g(q); all others the power qd^T phi. One rule integrates y and all powers over the
    same samples: the kinks of |qd| cancel. Rows at low speed stay, for the power of dry friction
    has no jump. A window counts if every sample of every joint does: the energy is the machine's.

    Args:
        model: the compiled robot.
        observation: of the logs; full-rate motion and torque are taken from its segments.
        window: s, rounded to an even number of samples; None: the spacing of the observation's
            rows, so that both models see the same band.
        rule: Simpson's rule, or the trapezoid, whose error is of order h^2 and not h^4.

    Raises:
        DataError: a window longer than any motion, no window without a missing sample, or a robot
            that stands still.
    """
    windows, logs = _choose_windows(observation, window), ", ".join(observation.logs)
    counts = [len(at) for _, at, _ in windows]
    if not sum(counts):
        valid = np.concatenate([part.segment.valid for part in observation.stretches])
        bad = [
            f"joint {joint.name} has {format_percent(share)} of its samples"
            for joint, share in zip(observation.joints, valid.mean(axis=0), strict=True)
        ]
        raise DataError(
            f"{logs}: no window in which every sample of every joint is a measurement "
            f"({', '.join(bad)}); the energy is that of the whole machine: repair the log, give a "
            "shorter --window, or take --model torque"
        )
    rows = [_integrate_rows(model, segment, at, rule) for segment, at, _ in windows if len(at)]
    W, y, balance, spread, time = (np.concatenate(group) for group in zip(*rows, strict=True))
    # J are compared with the largest torque over a unit of travel:
    least = THRESHOLDS.rounding_share * float(np.abs(observation.torque).max(initial=0.0))
    if not np.abs(W).max() > 0.0 or not np.abs(y).max() > least:
        raise DataError(
            f"{logs}: the motors do no work in any window: no joint with a torque moves; record a "
            "motion of every joint"
        )
    stretch = np.concatenate([stretch for _, _, stretch in windows])
    run = np.repeat([segment.run for segment, _, _ in windows], counts)
    length = (windows[0][1].shape[1] - 1) * windows[0][0].step
    return EnergyRows(W, y, balance, spread, stretch, time, run, length)


def _choose_windows(
    observation: Observation, window: float | None
) -> list[tuple[Segment, np.ndarray, np.ndarray]]:
    """Returns segments, samples (r, k) of their windows, and the segment (r,) of each window.

    Windows are placed in the uninterrupted segments of good samples.
    """
    windows, number = [], 0
    if window is not None:
        _check_window(observation, window)
    for part in observation.stretches:
        s = part.segment
        spacing = part.decimation if len(part.rows.centres) > 1 else 2
        intervals = 2 * max(1, round((spacing if window is None else window / s.step) / 2))
        inside = np.arange(intervals + 1)
        every, stretch = [np.zeros((0, len(inside)), dtype=int)], [np.zeros(0, dtype=int)]
        for first, stop in find_runs(s.whole & s.valid.all(axis=1)):
            fitting, rest = divmod(stop - first - 1, intervals)
            if fitting:
                starts = first + rest // 2 + intervals * np.arange(fitting)
                every.append(starts[:, None] + inside)
                stretch.append(np.full(fitting, number))
                number += 1
        windows.append((s, np.concatenate(every), np.concatenate(stretch)))
    return windows


def _check_window(observation: Observation, window: float) -> None:
    segments = [part.segment for part in observation.stretches]
    shortest = 2.0 * min(s.step for s in segments)
    longest = max(s.step * max(0, int(s.whole.sum()) - 1) for s in segments)
    where = f"{', '.join(observation.logs)}: --window of {window:g} s"
    if not window >= shortest * (1.0 - 1e-6):
        raise DataError(f"{where}; expected two samples or more, {shortest:.4g} s")
    if window > longest:
        raise DataError(
            f"{where} is longer than the longest motion without a gap, {longest:.4g} s; give a "
            "shorter one, or leave it out"
        )


def compute_weights(intervals: int, step: float, rule: Rule) -> np.ndarray:
    """Returns (intervals + 1,) s, of the samples of a window; intervals is even."""
    inner, unit = np.where(np.arange(intervals + 1) % 2, 4.0, 2.0), step / 3.0
    if rule == "trapezoid":
        inner, unit = np.ones(intervals + 1), step
    inner[[0, -1]] *= 0.5
    return inner * unit


def _integrate_rows(
    model: CompiledModel, s: Segment, windows: np.ndarray, rule: Rule
) -> tuple[np.ndarray, ...]:
    """Returns W, y, balance, spread and times of the windows of one segment."""
    w = compute_weights(windows.shape[1] - 1, s.step, rule)
    signals = compute_signals(model, s)
    per_block = max(1, THRESHOLDS.energy_block_samples // len(w))
    blocks = []
    for first in range(0, len(windows), per_block):
        at = windows[first : first + per_block]
        flat = at.ravel()
        read = None if signals is None else signals[flat]
        total, power, energy = _compute_powers(model, s.q[flat], s.qd[flat], s.qdd[flat], read)
        powers = (values.reshape(*at.shape, -1) for values in (power, total))
        integral, whole = (np.einsum("k,rkc->rc", w, values) for values in powers)
        energy = energy.reshape(*at.shape, -1)
        work = np.sum(s.tau[at] * s.qd[at], axis=2) @ w
        spread = np.einsum("k,rkj->rj", w**2, s.qd[at] ** 2)
        change = energy[:, -1] - energy[:, 0]
        blocks.append((integral + change, work, whole, spread, s.time[at[:, [0, -1]]]))
    return tuple(np.concatenate(group) for group in zip(*blocks, strict=True))


def _compute_powers(
    model: CompiledModel, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, read: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns all power; power but that of kinetic energy; kinetic energy: (samples, c) each.

    The regressor gives them all: E_c = qd^T (phi_c(q, 0, qd) - phi_c(q, 0, 0)) / 2.
    """
    still = np.zeros_like(qd)
    total, gravity, moved = (
        np.einsum("sj,sjc->sc", qd, model.base_regressor(q, v, a, read))
        for v, a in ((qd, qdd), (still, still), (still, qd))
    )
    inertial = find_kinetic_columns(model)
    energy = np.where(inertial, 0.5 * (moved - gravity), 0.0)
    return total, np.where(inertial, gravity, total), energy


def find_kinetic_columns(model: CompiledModel) -> np.ndarray:
    """Returns (c,) True for base parameters of bodies and rotors: their work is a difference."""
    return np.array([base.kind in ("inertial", "rotor_inertia") for base in model.spec.base])


# Least squares over rows of unequal, modelled variance: one sum of known shares per row.


@dataclass(frozen=True, eq=False, kw_only=True)
class HeteroscedasticEstimate(Estimate):
    """Holds the solution; its condition numbers are those of W unweighted, its sigma is 1.

    Attributes:
        row_sigma: (rows,) modelled standard deviation of each row.
        autocorrelation_factor: largest factor by which autocorrelation raises a sigma.
    """

    row_sigma: np.ndarray
    autocorrelation_factor: float


def solve_heteroscedastic(
    W: np.ndarray,
    y: np.ndarray,
    shares: np.ndarray,
    names: tuple[str, ...],
    stretch: np.ndarray,
    method: Method = "weighted",
) -> HeteroscedasticEstimate:
    """Returns beta in y = W beta + rho, var(rho_r) = sum_j shares_rj s_j, s_j >= 0.

    The variances s_j, and one more that all rows have alike (what no source of noise explains:
    rows at rest must not weigh without bound), follow from the squares of the residuals by
    Fisher's scoring, which is their maximum likelihood for normal noise: weighted non-negative
    least squares of r^2 / (1 - h), h the leverage, with weights 1 / var^2, until they converge.

    Weighted: rows divided by their standard deviations, (W^T V^-1 W)^-1. Ordinary: eq. (18) of
    Houda et al., all rows alike; its covariance is (W^T W)^-1 W^T V W (W^T W)^-1, for the rows are
    no more alike than before. Both are raised for autocorrelated residuals.

    Args:
        W: (rows, c).
        y: (rows,).
        shares: (rows, sources) not negative.
        names: (c,).
        stretch: (rows,) number of the segment of each row; within one, rows are neighbours.
        method: "weighted" or "ordinary".
    """
    rank = least_squares.find_independent_columns(least_squares.compute_triangle(W), names)
    columns = np.asarray(rank.kept_columns, dtype=int)
    X = W[:, columns]
    used = shares[:, shares.max(axis=0) > 0.0]
    sources = np.column_stack([used / used.mean(axis=0), np.ones(len(y))])  # the last: all alike
    deviation, is_converged = _iterate_deviations(X, y, sources, method)
    A = _compute_influence(X, deviation, method)
    values, C = A @ y, (A * deviation**2) @ A.T
    # Neighbours share the sample between them, so a little autocorrelation is always there.
    sample, white = np.arange(len(y)), (y - X @ values) / deviation
    r = estimate_autocorrelation(white, sample, stretch)
    extra = sum_lagged_products((A * deviation).T, r, sample, stretch)
    factors = np.sqrt(np.maximum(1.0 + np.diag(extra) / np.diag(C), 1.0))
    covariance = C * np.outer(factors, factors)
    beta, covariance = expand_columns(len(names), columns, values, covariance)
    raw, scaled = compute_condition_numbers(X)
    factor, degrees = float(factors.max(initial=1.0)), max(1, len(y) - len(columns))
    numbers = np.ones(1), rank, 0, is_converged, raw, scaled, degrees
    whole = beta, covariance, *numbers
    return HeteroscedasticEstimate(*whole, row_sigma=deviation, autocorrelation_factor=factor)


def _iterate_deviations(
    X: np.ndarray, y: np.ndarray, sources: np.ndarray, method: Method
) -> tuple[np.ndarray, bool]:
    """Returns (rows,) standard deviations, and whether they no longer change."""
    from scipy.optimize import nnls  # it takes long to load

    deviation = np.ones(len(y))
    least = max(THRESHOLDS.tiny_share * float(np.mean(y**2)), np.finfo(float).tiny)
    for _ in range(THRESHOLDS.max_variance_iterations):
        weight = 1.0 / deviation**2
        A = _compute_influence(X, deviation, method)
        leverage = np.clip(np.einsum("rc,cr->r", X, A), 0.0, 0.99)
        squares = (y - X @ (A @ y)) ** 2 / (1.0 - leverage)
        scale = float(np.mean(squares * weight)) or 1.0
        variances, _ = nnls(sources * weight[:, None], squares * weight / scale)  # of scoring
        updated = np.sqrt(np.maximum(sources @ variances * scale, least))
        if np.all(np.abs(updated / deviation - 1.0) < THRESHOLDS.variance_tolerance):
            return updated, True
        deviation = updated
    return deviation, False


def _compute_influence(X: np.ndarray, deviation: np.ndarray, method: Method) -> np.ndarray:
    """Returns (c, rows) A of beta = A y."""
    weight = 1.0 / deviation if method == "weighted" else np.ones(len(X))
    lengths = np.linalg.norm(X * weight[:, None], axis=0)
    q, r = np.linalg.qr(X * weight[:, None] / lengths)
    return np.asarray(np.linalg.solve(r, q.T) / lengths[:, None] * weight)


@dataclass(frozen=True, eq=False)
class EnergyFit:
    """Holds a fit of the energy model, and its rows for whoever leaves some of them out.

    Attributes:
        result: of all rows.
        rows: that were fitted.
        deviation: (r,) standard deviation of each, J.
        observation: of the same logs.
    """

    result: FitResult
    rows: EnergyRows
    deviation: np.ndarray
    observation: Observation

    def fit_without(self, held: np.ndarray) -> np.ndarray:
        """Fits beta (c,) to the windows that touch no held-out sample (s,) of the observation.

        A window touches the samples nearest to its ends.
        """
        seen = self.observation
        free = np.ones(len(self.rows.y), dtype=bool)
        for run in range(len(seen.logs)):
            samples, windows = np.flatnonzero(seen.run == run), self.rows.run == run
            if samples.size and windows.any():
                near = np.searchsorted(seen.time[samples], self.rows.time[windows])
                touched = held[samples][near.clip(0, len(samples) - 1)].any(axis=1)
                free[np.flatnonzero(windows)[touched]] = False
        W, y = self.rows.W / self.deviation[:, None], self.rows.y / self.deviation
        return least_squares.solve_scaled_least_squares(
            W[free], y[free], THRESHOLDS.min_singular_share
        )


def identify_energy(
    model: CompiledModel,
    observation: Observation,
    window: float | None = None,
    method: Method = "weighted",
    below: float | None = None,
) -> EnergyFit:
    """Returns the base parameters from energies over windows, and the torque model beside them.

    Args:
        model: the compiled robot.
        observation: of the logs.
        window: s; None: as `build_energy_rows`.
        method: "weighted" by the modelled variance of each window, or "ordinary" (eq. 18).
        below: as for `identify`.

    Raises:
        DataError: a motor without torque, few windows, no such method, or as `build_energy_rows`.
    """
    find_method(method, "windows")
    logs, names = ", ".join(observation.logs), observation.names
    dead = [observation.joints[j].name for j in find_disconnected_joints(observation)]
    if dead:
        raise DataError(
            f"{logs}: the torque of joint {', '.join(dead)} is 0 in every row; the energy model "
            "needs the torque of every motor, for it adds up their work; connect it, or take "
            "--model torque"
        )
    rows = build_energy_rows(model, observation, window)
    if len(rows.y) < len(names):
        raise DataError(
            f"{logs}: {len(rows.y)} windows of {rows.window:.4g} s for {len(names)} parameters; "
            "record more motion, or give a shorter --window"
        )
    estimate, equations = rows.estimate(names, method), build_base_equations(observation)
    torques = equations.compress_rows(np.ones(len(observation.y), dtype=bool))
    essential = _select_essential(rows, names, estimate, below)
    lines = [dropped.describe() for dropped in estimate.rank.dropped_columns]
    if not estimate.is_converged:
        lines.append("the variances of the windows have not converged; record more rows")
    factor = estimate.autocorrelation_factor
    if factor > THRESHOLDS.reported_sigma_factor:
        lines.append(
            "Residuals of neighbouring windows are autocorrelated; standard deviations are "
            f"corrected for it (up to x {factor:.2g})."
        )
    result = build_result(
        equations,
        method,
        estimate,
        essential,
        torques,
        rows=len(rows.y),
        sentences=(*lines, essential.describe(torques, estimate.beta)),
        reduced=np.ones(len(essential.names)),
        energy=_build_report(model, observation, rows, estimate, window, method),
    )
    return EnergyFit(result, rows, estimate.row_sigma, observation)


def _select_essential(
    rows: EnergyRows, names: tuple[str, ...], estimate: HeteroscedasticEstimate, below: float | None
) -> EssentialParameters:
    """Returns the essential parameters by the F-test of the windows."""
    weight, zeros = 1.0 / estimate.row_sigma, np.zeros(len(rows.y), dtype=int)
    data = least_squares.compress_rows(rows.W * weight[:, None], rows.y * weight, zeros, 1, names)
    essential = select_essential_parameters(data, estimate, "ordinary", below)
    at = [names.index(name) for name in essential.names]
    raw, scaled = compute_condition_numbers(rows.W[:, at])
    covariance = essential.reduced.covariance * estimate.autocorrelation_factor**2
    reduced = dataclasses.replace(essential.reduced, covariance=covariance)
    reduced = dataclasses.replace(reduced, condition_number=raw, condition_scaled=scaled)
    return dataclasses.replace(essential, reduced=reduced)


def _build_report(
    model: CompiledModel,
    observation: Observation,
    rows: EnergyRows,
    estimate: HeteroscedasticEstimate,
    window: float | None,
    method: Method,
) -> EnergyReport:
    torque = identify(observation, method)
    rough = build_energy_rows(model, observation, window, "trapezoid")
    coarse = rough.estimate(observation.names, method)
    figures = [_compute_figures("torque", observation, torque.rows, torque)]
    for rule, part, fit in (("Simpson", rows, estimate), ("trapezoid", rough, coarse)):
        columns = list(fit.rank.kept_columns)
        missed = (part.balance - part.W) @ estimate.beta
        # What the energy that integration misses moves at most, in sigmas.
        weighted = part.W[:, columns] / fit.row_sigma[:, None]
        least = THRESHOLDS.min_singular_share
        moved = least_squares.solve_scaled_least_squares(weighted, missed / fit.row_sigma, least)
        sigma = np.sqrt(np.diag(fit.covariance)[columns])
        figure = _compute_figures(f"energy, {rule}", observation, len(part.y), fit)
        imbalance = float(np.linalg.norm(missed) / np.linalg.norm(part.y))
        bias = float(np.max(np.abs(moved) / sigma, initial=0.0))
        figures.append(dataclasses.replace(figure, imbalance=imbalance, bias=bias))
    residual = rows.y - rows.W @ estimate.beta
    error = float(np.linalg.norm(residual) / np.linalg.norm(rows.y))
    count = len(estimate.rank.kept_columns)
    return EnergyReport(rows.window, error, tuple(figures), count)


def _compute_figures(
    name: str, observation: Observation, rows: int, fit: Estimate | FitResult
) -> ModelFigures:
    W, y, beta, covariance = observation.W, observation.y, fit.beta, fit.covariance
    sigma = np.sqrt(np.diag(covariance))
    squares = np.einsum("rc,cd,rd->r", W, covariance, W, optimize=True)
    joint, size = observation.row_joint, np.linalg.norm(y)
    is_known = 100.0 * sigma < THRESHOLDS.known_below_percent * np.abs(beta)
    error, spread = np.linalg.norm(y - W @ beta) / size, np.sqrt(squares.sum()) / size
    rms = {k: float(np.sqrt(squares[joint == k].mean())) for k in np.unique(joint)}
    by_joint = {observation.joints[k].name: value for k, value in rms.items()}
    numbers = int(np.sum((sigma > 0.0) & is_known)), float(error), float(spread)
    return ModelFigures(name, rows, fit.condition_scaled, *numbers, joint_sigma=by_joint)
