"""From an observation to a fitted model: the estimators, the fit, and its cross-validation."""

import dataclasses
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from modeler.core.choices import ABOUT, EstimatorInfo, Method
from modeler.core.errors import DataError, ModelerError
from modeler.core.json import Document, ShortRepr, select_attributes
from modeler.core.result import Result
from modeler.estimation import instrumental, least_squares, parameters
from modeler.estimation.covariance import (
    HalvesComparison,
    compare_bands,
    compare_halves,
    estimate_hac_covariance,
)
from modeler.estimation.physical_consistency import estimate_consistent
from modeler.estimation.prior import Prior, build_prior, describe_unused_prior
from modeler.estimation.result import FitResult, JointFit
from modeler.estimation.thresholds import THRESHOLDS
from modeler.estimation.windup import fit_elastic_joints
from modeler.numerics.least_squares import (
    CompressedRegression,
    compress_rows,
    solve_scaled_least_squares,
)
from modeler.regression import Observation, compute_prior_weights, compute_triangles, is_streamed
from modeler.runtime import CompiledModel

_REFUSALS = {
    "rows": 'method is "{method}"; expected {capable}',
    "triangles": "fit: method {method} reads every row again and again, and long logs are not kept "
    "in memory; expected {capable}, or a part of the log, FILE@START:END",
    "windows": "--method {method}: the energy model takes {capable}; leave out --method or --model "
    "energy",
    "elastic": "--method {method}: the robot has elastic joints; expected {capable}",
}
"""What an estimator may work on, and the sentence for one that does not."""


@dataclass(frozen=True)
class Estimator:
    """Describes a way to estimate.

    Attributes:
        about: id, title, law, source, and when not to use it.
        estimate: the function. Raises DataError where the problem gives it nothing to work on.
        works_on: "rows"; "triangles", if no row is needed again once these are there; "windows" of
            the energy model; "loads", if logs may carry some; "elastic" joints.
    """

    about: EstimatorInfo
    estimate: Callable[[least_squares.Problem], least_squares.Estimate]
    works_on: tuple[str, ...]

    @property
    def takes_prior(self) -> bool:
        """Returns False of estimators with their own prior: a robot file's would be a second."""
        return not (self.about.is_consistent or self.about.id == "ridge")

    @property
    def takes_torque_prior(self) -> bool:
        """Returns True of estimators that keep small what the motion does not show."""
        return self.about.id in ("weighted", "consistent")


_ESTIMATES: dict[Method, Callable[[least_squares.Problem], least_squares.Estimate]] = {
    "weighted": lambda problem: least_squares.solve_least_squares(problem.data, "weighted"),
    "ordinary": least_squares.estimate_ordinary,
    "robust": least_squares.estimate_robust,
    "ridge": least_squares.estimate_ridge,
    "iv": instrumental.estimate_iv,
    "iv-direct": instrumental.estimate_iv_direct,
    "didim": instrumental.estimate_didim,
    "didim-robust": instrumental.estimate_didim_robust,
    "consistent": estimate_consistent,
    "iv-consistent": instrumental.estimate_iv_consistent,
    "iv-direct-consistent": instrumental.estimate_iv_direct_consistent,
    "didim-consistent": instrumental.estimate_didim_consistent,
}
_LEAST_SQUARES, _WITH_LOADS = ("weighted", "ordinary"), ("weighted", "ordinary", "robust", "ridge")
METHODS: dict[Method, Estimator] = {
    id: Estimator(
        ABOUT[id],
        estimate,
        ("rows",)
        + ("triangles", "windows") * (id in _LEAST_SQUARES)
        + ("loads", "elastic") * (id in _WITH_LOADS),
    )
    for id, estimate in _ESTIMATES.items()
}
"""By id, in the order in which they are listed."""


def find_methods(of: str) -> tuple[Method, ...]:
    """Returns ids of the estimators that work on such data."""
    return tuple(id for id, estimator in METHODS.items() if of in estimator.works_on)


def find_method(method: str, of: str = "rows") -> Estimator:
    """Returns the estimator of that id.

    Raises:
        DataError: there is none, or it does not work on such data.
    """
    for id in find_methods(of):
        if id == method:
            return METHODS[id]
    *first, last = find_methods(of)
    raise DataError(_REFUSALS[of].format(method=method, capable=f"{', '.join(first)} or {last}"))


@dataclass(frozen=True, eq=False)
class Equations:
    """Holds y = W beta, row for row those of an observation; first base parameters, then loads.

    Attributes:
        observation: whose W stands first.
        extra: (rows, loads) further columns.
        y: (rows,) N m or N.
        names: (c + loads,) of the columns.
        units: (c + loads,) of the parameters.
        sentences: what a reader of the fit must know of them.
        loaded_logs: names of the logs with a load.
    """

    observation: Observation
    extra: np.ndarray
    y: np.ndarray
    names: tuple[str, ...]
    units: tuple[str, ...]
    sentences: tuple[str, ...] = ()
    loaded_logs: tuple[str, ...] = ()

    @cached_property
    def W(self) -> np.ndarray:
        """Returns W (rows, c + loads): columns of the base parameters, then of the loads."""
        W = self.observation.W
        return np.column_stack([W, self.extra]) if self.extra.shape[1] else W

    @cached_property
    def torque_prior(self) -> np.ndarray | None:
        """Returns (c, c + loads + 1) rows of `compute_prior_weights`; None if it knows nothing."""
        weights = compute_prior_weights(self.observation)
        rows = np.zeros((len(weights), len(self.names) + 1))
        rows[:, : len(weights)] = np.diag(weights)
        return rows if weights.any() else None

    @property
    def stored_matrix(self) -> np.ndarray | None:
        """Returns W; None where it is large and without loads: then its rows are streamed."""
        return None if not self.loaded_logs and is_streamed(self.observation) else self.W

    def select_conditions(self, counted: np.ndarray) -> dict[str, np.ndarray]:
        """Returns (rows,) True for the counted ones, "bare" and "loaded"; empty without loads."""
        if not self.loaded_logs:
            return {}
        logs = np.array(self.observation.logs)
        loaded = np.isin(logs, self.loaded_logs)[self.observation.row_run]
        return {"bare": counted & ~loaded, "loaded": counted & loaded}

    def append_columns(self, columns: np.ndarray, names: Sequence[str]) -> "Equations":
        """Returns the equations with further columns (rows, k), and the torques as measured."""
        wider = dataclasses.replace(self, extra=np.column_stack([self.extra, columns]))
        units = (*self.units, *("1" for _ in names))
        names = (*self.names, *names)
        return dataclasses.replace(wider, y=self.observation.y, names=names, units=units)

    def compress_rows(
        self, counted: np.ndarray, weight: np.ndarray | None = None
    ) -> CompressedRegression:
        """Returns some rows, compressed; each with its weight (rows,), if that is given."""
        joints, row_joint = self.observation.joints, self.observation.row_joint[counted]
        free = [j for j, joint in enumerate(joints) if not joint.actuated]
        W = self.W if weight is not None else self.stored_matrix
        if W is None:
            selected = least_squares.select_rows(self.observation, counted)
            triangles = compute_triangles(self.observation, selected)
            rows, idle = triangles.rows.astype(np.intp), np.isin(np.arange(len(joints)), free)
            return CompressedRegression(self.names, triangles.triangles, rows, idle)
        W, y = W[counted], self.y[counted]
        if weight is not None:
            root = np.sqrt(weight[counted])
            W, y = W * root[:, None], y * root
        return compress_rows(W, y, row_joint, len(joints), self.names, free)

    def compute_residual(self, beta: np.ndarray, counted: np.ndarray) -> np.ndarray:
        """Returns y - W beta of some rows."""
        if (W := self.stored_matrix) is None:
            return least_squares.compute_base_residual(self.observation, beta, counted)
        return np.asarray(self.y[counted] - W[counted] @ beta)


def identify(
    observation: Observation,
    method: Method = "weighted",
    model: CompiledModel | None = None,
    below: float | None = None,
) -> FitResult:
    """Returns the fit of the base parameters to an observation.

    Parameters that are not identifiable are dropped by name; the essential ones are marked.

    Args:
        observation: of one or several logs.
        method: the estimator, see `METHODS`.
        model: the compiled robot, for estimators that simulate it or know its nominal values.
        below: percent, of the rule by sigmas for what is essential; see
            `select_essential_parameters`.

    Raises:
        DataError: fewer rows than parameters, no torque, no such method, or nothing it works on.
    """
    if model is not None and model.spec.windups:
        return identify_elastic(observation, method, model, below)[0]
    return fit_equations(observation, build_base_equations(observation), method, model, below)


def identify_elastic(
    observation: Observation, method: Method, model: CompiledModel, below: float | None = None
) -> tuple[FitResult, Equations]:
    """Returns the fit of a robot with elastic joints, K and D too; and the equations of beta.

    These are linear about the fit: W holds the slopes of the torque by beta, the windup's included.

    Raises:
        DataError: as `identify`; or no windup can be integrated.
    """
    find_method(method, "elastic")
    about = fit_elastic_joints(observation, model)
    seen, y = about.linearise_rows(observation)
    equations = Equations(seen, build_base_equations(seen).extra, y, seen.names, seen.units)
    return about.extend_fit(fit_equations(seen, equations, method, model, below)), equations


def build_base_equations(observation: Observation) -> Equations:
    """Returns the equations of the bare robot."""
    none = np.zeros((len(observation.y), 0))
    return Equations(observation, none, observation.y, observation.names, observation.units)


def fit_equations(
    observation: Observation,
    equations: Equations,
    method: Method,
    model: CompiledModel | None = None,
    below: float | None = None,
    noise_only: bool = False,
    data: CompressedRegression | None = None,
    share: float = 1.0,
) -> FitResult:
    """Returns the fit of y = W beta; equations row for row those of the observation.

    Sigmas of noise only leave out what halves of the motion disagree about: for tests of it.

    Of long logs the data are all rows, and the observation's are windows, that share of them: how
    long residuals are correlated, what halves disagree about, and by what factors that raises the
    sigmas, comes from the windows. Else as `identify`.
    """
    estimator, is_part = find_method(method), data is not None
    dead, alive = find_disconnected_joints(observation), find_connected_rows(observation)
    data = data or equations.compress_rows(alive)
    if estimator.takes_torque_prior:
        data = dataclasses.replace(data, prior=equations.torque_prior)
    columns, count = len(equations.names), int(data.rows.sum())
    if count < columns and not estimator.takes_torque_prior:
        raise DataError(
            f"{', '.join(observation.logs)}: {count} rows for {columns} parameters, and method "
            f"{method} has no prior; expected --method weighted, or more motion"
        )
    matrix, joints = equations.stored_matrix, [joint.name for joint in observation.joints]
    problem = least_squares.Problem(
        observation, matrix, equations.y, alive, equations.names, data, model
    )
    prior, notes = None, list(equations.sentences)
    if model is not None and not noise_only:
        if estimator.takes_prior:
            prior = build_prior(model.spec)
        else:
            use = "; the values of the robot file are a guide that the data overrule"
            notes += describe_unused_prior(model.spec, f"method {method}", use)
    estimate = estimator.estimate(problem)
    autocorrelation = estimate_hac_covariance(problem, estimate, share=share)
    white = np.sqrt(np.diag(estimate.covariance))
    differ = HalvesComparison(np.ones(len(white)))
    if not noise_only:
        differ = compare_halves(  # windows show a difference by so much less clearly than all rows
            observation,
            lambda rows: equations.compress_rows(rows, estimate.weight),
            alive,
            estimate,
            autocorrelation.factors * white / share**0.5,
            np.zeros(len(joints)) if is_part else autocorrelation.lag1,
            equations.select_conditions(alive).get("loaded"),
            data.prior,
        )
    warnings = differ.collect_warnings(equations.names, joints)
    raised = np.sqrt(1.0 + (differ.factors**2 - 1.0) / share)
    factors = autocorrelation.factors * raised
    covariance = estimate.covariance * np.outer(factors, factors)
    if prior is not None:  # rows that repeat each other weigh less beside it
        full = autocorrelation.inflate_covariance(estimate.covariance)
        more = np.maximum(np.diag(covariance) - np.diag(full), 0.0)
        both, prior, lines = prior.combine_if_useful(estimate, data, full, more, joints)
        estimate, notes = both, [*notes, *lines]
    essential = parameters.select_essential_parameters(data, estimate, method, below)
    sigma = estimate.sigma
    if essential.dropped and below is None and not noise_only:
        some = [equations.names.index(name) for name in essential.names]
        errors, as_good = compute_held_out_errors(equations, alive, sigma, prior, some)
        if not as_good:
            keep_all = THRESHOLDS.keep_all_percent
            essential = parameters.select_essential_parameters(data, estimate, method, keep_all)
        essential = dataclasses.replace(essential, held_out=errors)
    at = [equations.names.index(name) for name in essential.names]
    reduced = np.ones(len(at))
    if prior is None:
        hac = estimate_hac_covariance(problem, essential.reduced, at, share)
        reduced = raised[at] * hac.factors
        estimate = dataclasses.replace(estimate, covariance=covariance)
    notes += [
        f"joint {joints[j]}: its torque is 0 in every row, so none of them is used; is it "
        "connected? if it has no motor, mark it passive in the robot file (mu = 0)"
        for j in dead
    ]
    notes += estimate.sentences
    notes += [dropped.describe() for dropped in estimate.rank.dropped_columns]
    notes += [*estimate.describe_nonconvergence(), essential.describe(data, estimate.beta)]
    notes += [*autocorrelation.format_sentences(), *(warning.line for warning in warnings)]
    return build_result(
        equations,
        method,
        estimate,
        essential,
        data,
        sigma,
        rows=count,
        sentences=(*notes, *compare_bands(observation, estimate)),
        reduced=reduced,
        standard=estimate.standard,
        estimator_notes=estimate.sentences,
        joint_warnings=tuple(warnings),
        by_load={
            name: build_joint_fits(observation, equations.compress_rows(part), estimate.beta, sigma)
            for name, part in equations.select_conditions(alive).items()
        },
    )


def build_result(
    equations: Equations,
    method: str,
    estimate: least_squares.Estimate,
    essential: parameters.EssentialParameters,
    data: CompressedRegression,
    sigma_of_rows: np.ndarray | None = None,
    reduced: np.ndarray | None = None,
    **further: Any,
) -> FitResult:
    """Returns the result that an estimate makes.

    Args:
        equations: that were fitted.
        method: id.
        estimate: its solution, the covariance raised where residuals are autocorrelated.
        essential: of its parameters.
        data: the torques that its errors are of.
        sigma_of_rows: (n,) of each joint; None: from the residual.
        reduced: (essential,) factors on the sigmas of the reduced model; None: it has none.
        **further: fields of the result.
    """
    observation, count = equations.observation, len(equations.observation.names)
    before, after = essential.compute_errors(data, estimate.beta)
    units = dict(zip(equations.names, equations.units, strict=True))
    is_estimated = np.isin(np.arange(len(units)), estimate.rank.kept_columns)
    is_estimated &= ~np.isin(equations.names, [one.name for one in estimate.rank.dropped_columns])
    sigma, share = np.sqrt(np.diag(estimate.covariance)), estimate.prior_share

    def describe(i: int, name: str, unit: str) -> parameters.ParameterEstimate:
        status = ("set aside", "estimated")[int(is_estimated[i])]
        status = "held" if name in estimate.fixed_names else status
        numbers = float(estimate.beta[i]), float(sigma[i]) if is_estimated[i] else None
        prior = float(share[i]) if share is not None and is_estimated[i] else None
        known = *numbers, name in essential.names, status, None, prior
        return parameters.ParameterEstimate(name, unit, *known)

    every = tuple(describe(i, *both) for i, both in enumerate(units.items()))
    status = "ok" if estimate.is_converged else "not settled"
    return FitResult(
        robot=observation.robot,
        method=method,
        status="rank deficient" if estimate.rank.dropped_columns else status,
        samples=len(observation.time),
        **select_attributes(estimate, "condition_number condition_scaled"),
        prior_conflicts=estimate.contradicted,
        relative_error=before,
        essential_error=after,
        joints=build_joint_fits(observation, data, estimate.beta, sigma_of_rows),
        parameters=every[:count],
        covariance=(estimate.covariance * np.outer(is_estimated, is_estimated))[:count, :count],
        loads=every[count:],
        processing=observation.report.processing,
        bands=observation.report.bands,
        essential=reduced
        if reduced is None
        else parameters.build_reduced_model(essential, reduced, units, after),
        **further,
    )


def compress_all_rows(observation: Observation) -> CompressedRegression:
    """Returns the equations of the bare robot on all joints whose torque is connected."""
    return build_base_equations(observation).compress_rows(find_connected_rows(observation))


def find_connected_rows(observation: Observation) -> np.ndarray:
    """Returns (rows,) True for those of joints whose torque is connected."""
    return ~np.isin(observation.row_joint, find_disconnected_joints(observation))


def find_disconnected_joints(observation: Observation) -> list[int]:
    """Returns indices of the joints that have a motor and a torque of 0 in all their rows.

    0 = W_j beta from a channel that is not connected would pull all of beta to 0.

    Raises:
        DataError: no joint has a torque.
    """
    driven = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    seen = [j for j in driven if observation.used[:, j].any()]
    dead = [j for j in seen if not observation.torque[observation.used[:, j], j].any()]
    if len(dead) == len(seen):
        raise DataError(
            f"{', '.join(observation.logs)}: the torque of every joint with a motor is 0 in all "
            "rows that are used; expected joint torques; check the recording, or take another part"
        )
    return dead


def compute_relative_errors(observation: Observation, beta: np.ndarray) -> dict[str, float]:
    """Returns ||y_j - W_j beta|| / ||y_j|| by joint: the one number that is called error."""
    equations = build_base_equations(observation)
    residual = least_squares.compute_base_residual(observation, beta)
    errors = compute_errors(equations, residual, np.ones(len(residual), dtype=bool))
    pairs = zip(observation.joints, errors.tolist(), strict=True)
    return {joint.name: error for joint, error in pairs if np.isfinite(error)}


def build_joint_fits(
    observation: Observation,
    data: CompressedRegression,
    beta: np.ndarray,
    sigma: np.ndarray | None = None,
) -> tuple[JointFit, ...]:
    """Returns the residual of each joint; a `sigma` (n,) of its rows that is None follows."""
    residual, torque = data.compute_residual_norms(beta), data.compute_torque_norms()
    count = np.maximum(data.rows, 1)
    if sigma is None:
        sigma = np.maximum(residual / np.sqrt(count), least_squares.compute_least_sigma(data))
    fits = []
    for j, joint in enumerate(observation.joints):
        error = float(residual[j] / torque[j]) if torque[j] > 0.0 else None
        rms, rows = float(residual[j] / np.sqrt(count[j])), int(data.rows[j])
        fits.append(JointFit(joint.name, joint.effort_unit, rows, error, rms, float(sigma[j])))
    return tuple(fits)


# Does the fit predict motion like that of its logs? Rows that were left out show it.


@dataclass(frozen=True, eq=False)
class CrossValidation:
    """Holds errors of the fit on segments that it was not fitted to.

    Attributes:
        errors: (n,) ||y_j - W_j beta|| / ||y_j||, each segment predicted from the others; nan for
            a joint without rows or torque.
        residual: (rows,) y - W beta, each row predicted from other segments; 0 for those left out.
        fold: (rows,) which segments were left out together; of rows that were used.
    """

    errors: np.ndarray
    residual: np.ndarray = field(default_factory=lambda: np.zeros(0))
    fold: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=int))


def compute_errors(equations: Equations, residual: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Returns (n,) ||y_j - W_j beta|| / ||y_j|| on some rows, of a residual (rows,) of all."""
    joint, count = equations.observation.row_joint[rows], len(equations.observation.joints)
    left = np.bincount(joint, residual[rows] ** 2, count)
    total = np.bincount(joint, equations.y[rows] ** 2, count)
    return np.sqrt(np.divide(left, total, out=np.full(count, np.nan), where=total > 0.0))


def cross_validate(
    equations: Equations,
    rows: np.ndarray,
    sigma: np.ndarray,
    refit: Callable[[np.ndarray], np.ndarray] | None = None,
    prior: Prior | None = None,
    columns: Sequence[int] | None = None,
) -> CrossValidation:
    """Returns the cross-validation over segments of half a period.

    A segment is as long as the motion needs to turn round, pi rms(qd) / rms(qdd), the median over
    joints: neighbouring samples are alike, and would answer for each other. Every eighth segment
    is held out together, so that the motions of a log stand in all parts.

    Args:
        equations: of all logs, with the columns of loads.
        rows: (rows,) True for those to use.
        sigma: (n,) standard deviation of a row of each joint.
        refit: beta without the samples (s,) that are held out; None: least squares of the
            other rows.
        prior: beside those of least squares.
        columns: that are fitted by least squares, others are 0; None: all.
    """
    observation, folds = equations.observation, THRESHOLDS.folds
    motion = observation.qd, observation.qdd
    speed, acceleration = (np.sqrt(np.mean(values**2, axis=0)) for values in motion)
    moving = (speed > 1e-6 * speed.max(initial=0.0)) & (acceleration > 0.0)
    periods = np.pi * speed[moving] / acceleration[moving]
    half_period = float(np.median(periods)) if moving.any() else 0.0
    number = _count_stretches(observation, half_period)
    seen = np.unique(number[observation.row_sample[rows]])
    sample_fold = np.searchsorted(seen, number) % folds
    fold = sample_fold[observation.row_sample]
    held_out = [rows & (fold == k) for k in range(min(folds, len(seen)))]
    parts = [equations.compress_rows(part).combine_joints(sigma) for part in held_out]
    residual, known = np.zeros(len(equations.y)), parts[0][:0]
    if equations.torque_prior is not None:
        known = equations.torque_prior
    if prior is not None:
        lengths = np.linalg.norm(np.vstack(parts)[:, :-1], axis=0)
        known = np.vstack([known, prior.extend_rows(lengths)])
    every = np.arange(parts[0].shape[1] - 1) if columns is None else np.asarray(columns)
    for k, part in enumerate(held_out):
        if refit is None:
            others = np.vstack([known, *parts[:k], *parts[k + 1 :]])
            beta = np.zeros(others.shape[1] - 1)
            least = THRESHOLDS.min_singular_share
            beta[every] = solve_scaled_least_squares(others[:, every], others[:, -1], least)
        else:
            beta = refit(sample_fold == k)
        residual[part] = equations.compute_residual(beta, part)
    errors = compute_errors(equations, residual, rows)
    return CrossValidation(errors, residual, fold)


def compute_held_out_errors(
    equations: Equations,
    rows: np.ndarray,
    sigma: np.ndarray,
    prior: Prior | None,
    columns: Sequence[int],
) -> tuple[tuple[float, float], bool]:
    """Returns cross-validated errors of all columns and of some; whether these are as good.

    They are if the mean over the folds of the logarithm of their error, rows weighed, is larger
    than that of all by no more than its standard error.
    """
    both = [cross_validate(equations, rows, sigma, None, prior, some) for some in (None, columns)]
    residuals = [validation.residual[rows] for validation in both]
    size = sigma[equations.observation.row_joint[rows]]
    left = [np.bincount(both[1].fold[rows], (residual / size) ** 2) for residual in residuals]
    seen = (left[0] > 0.0) & (left[1] > 0.0)
    change = 0.5 * np.log(left[1][seen] / left[0][seen])
    spread = np.std(change, ddof=1) / len(change) ** 0.5 if len(change) > 1 else 0.0
    total = float(np.linalg.norm(equations.y[rows])) or np.nan
    before, after = (float(np.linalg.norm(residual)) / total for residual in residuals)
    return (before, after), bool(len(change) and change.mean() <= spread)


def _count_stretches(observation: Observation, half_period: float) -> np.ndarray:
    """Returns (s,) number of the segment of each sample, ascending over the logs."""
    number, first = np.zeros(len(observation.time), dtype=int), 0
    for run in np.unique(observation.run):
        part = observation.run == run
        since = observation.time[part] - observation.time[part].min()
        steps = np.floor(since / half_period).astype(int) if half_period > 0.0 else 0
        number[part] = first + steps
        first = int(number[part].max()) + 1
    return number


# All estimators on the same rows: values, errors, time, and what each says of itself.


FIRST: Method = "weighted"
"""The method that the others are compared with."""


@dataclass(frozen=True, eq=False)
class MethodResult(ShortRepr, Document):
    """Holds what one estimator gives.

    Attributes:
        method: id.
        fit: None where it was refused.
        refusal: why; empty if it was not.
        seconds: of the fit.
        held_out_error: ||y - W beta|| / ||y|| of other logs, processed alike; None without any.
        largest_shift: parameter whose value is farthest from that of the weighted fit, and by how
            many of the larger sigma; None for the weighted fit itself.
        notes: what this fit says of itself; else when not to use it.
    """

    KEYS = """
        method title=info.title limitations=info.limitations refusal=known_refusal seconds
        held_out_error largest_shift notes fit
    """

    method: Method
    fit: FitResult | None
    refusal: str
    seconds: float
    held_out_error: float | None
    largest_shift: tuple[str, float] | None
    notes: tuple[str, ...]

    @property
    def info(self) -> EstimatorInfo:
        """Returns what the estimator is."""
        return ABOUT[self.method]

    @property
    def known_refusal(self) -> str | None:
        """Returns why there is no fit; None where there is one."""
        return self.refusal or None


@dataclass(frozen=True, eq=False)
class MethodComparison(Result):
    """Holds estimators on the same logs.

    Attributes:
        robot: name.
        results: one each.
        data: what was done with the logs, lines of text.
    """

    robot: str
    results: tuple[MethodResult, ...]
    data: tuple[str, ...]


def compare_methods(
    observation: Observation,
    model: CompiledModel,
    held_out: Observation | None = None,
    methods: Sequence[Method] = tuple(ABOUT),
    progress: Callable[[float], None] | None = None,
) -> tuple[MethodResult, ...]:
    """Fits by every method on the same rows.

    Args:
        observation: of the training logs.
        model: the compiled robot.
        held_out: of other logs, with the processing of the training ones.
        methods: ids; the weighted fit is made besides, as the others are compared with it.
        progress: called with the share done, 0 to 1.

    Raises:
        DataError: what the weighted fit raises. What another method refuses stands in its row.
    """
    first = identify(observation, FIRST, model)
    results = []
    for count, method in enumerate(methods, start=1):
        start, refusal, fit = time.perf_counter(), "", None
        try:
            fit = identify(observation, method, model)
        except ModelerError as error:
            refusal = str(error)
        seconds = time.perf_counter() - start
        apart = [
            (a.name, abs(a.value - b.value) / max(a.sigma, b.sigma))
            for a, b in zip((fit or first).parameters, first.parameters, strict=True)
            if fit and method != FIRST and a.sigma and b.sigma
        ]
        missed = compute_held_out_error(held_out, fit.beta) if fit and held_out else None
        farthest = max(apart, key=lambda pair: pair[1], default=None)
        notes = fit.estimator_notes if fit else ()
        remarks = notes or (f"not {ABOUT[method].limitations}",)
        results.append(MethodResult(method, fit, refusal, seconds, missed, farthest, remarks))
        if progress is not None:
            progress(count / len(methods))
    return tuple(results)


def compute_held_out_error(observation: Observation, beta: np.ndarray) -> float:
    """Returns ||y - W beta|| / ||y|| over the rows of joints that have a torque."""
    y, rest, joint = observation.y, observation.y - observation.W @ beta, observation.row_joint
    seen = (np.bincount(joint, y**2) > 0.0)[joint]
    return float(np.linalg.norm(rest[seen]) / max(float(np.linalg.norm(y)), 1e-300))
