"""From an observation to a fitted model."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.json import select_attributes
from modeler.estimation.covariance import HalvesComparison, compare_halves, estimate_hac_covariance
from modeler.estimation.essential import (
    NONE_LEAVES,
    EssentialParameters,
    build_reduced_model,
    select_essential_parameters,
)
from modeler.estimation.least_squares import (
    Estimate,
    Problem,
    compute_base_residual,
    compute_least_sigma,
    select_rows,
)
from modeler.estimation.methods import find_method
from modeler.estimation.parameter import ParameterEstimate
from modeler.estimation.prior import Prior, build_prior, describe_unused_prior
from modeler.estimation.result import FitResult, JointFit
from modeler.numerics.least_squares import (
    CompressedRegression,
    compress_rows,
    solve_scaled_least_squares,
)
from modeler.regression import SAMPLES, Observation, compute_triangles, is_streamed
from modeler.runtime import CompiledModel


@dataclass(frozen=True, eq=False)
class Equations:
    """y = W beta, row for row those of an observation; first the base parameters, then loads.

    Attributes:
        observation: whose W stands first.
        extra: (rows, loads) further columns.
        y: (rows,) N m or N.
        names: (c + loads,) of the columns.
        units: (c + loads,) of the parameters.
        sentences: what a reader of the fit must know of them.
        carried: names of the logs with a load.
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
        """(rows, c + loads)."""
        W = self.observation.W
        return np.column_stack([W, self.extra]) if self.extra.shape[1] else W

    @property
    def stored_matrix(self) -> np.ndarray | None:
        """W; None where it is large and the base parameters' alone: then rows are to pass by."""
        return None if not self.loaded_logs and is_streamed(self.observation) else self.W

    def select_conditions(self, counted: np.ndarray) -> dict[str, np.ndarray]:
        """(rows,) True for the counted ones, "bare" and "loaded"; empty if no log has a load."""
        if not self.loaded_logs:
            return {}
        logs = np.array(self.observation.logs)
        loaded = np.isin(logs, self.loaded_logs)[self.observation.row_run]
        return {"bare": counted & ~loaded, "loaded": counted & loaded}

    def append_columns(self, columns: np.ndarray, names: Sequence[str]) -> "Equations":
        """The same with further columns (rows, k), and the torques as they were measured."""
        return dataclasses.replace(
            self,
            extra=np.column_stack([self.extra, columns]),
            y=self.observation.y,
            names=(*self.names, *names),
            units=(*self.units, *("1" for _ in names)),
        )

    def compress_rows(
        self, counted: np.ndarray, weight: np.ndarray | None = None
    ) -> CompressedRegression:
        """Some rows, compressed; each with its weight (rows,), if that is given."""
        joints, row_joint = self.observation.joints, self.observation.row_joint[counted]
        free = [j for j, joint in enumerate(joints) if not joint.actuated]
        if weight is not None:
            root = np.sqrt(weight[counted])
            W, y = self.W[counted] * root[:, None], self.y[counted] * root
            return compress_rows(W, y, row_joint, len(joints), self.names, free)
        if (W := self.stored_matrix) is None:
            joint_triangles = compute_triangles(
                self.observation, select_rows(self.observation, counted)
            )
            rows, idle = joint_triangles.rows.astype(np.intp), np.isin(np.arange(len(joints)), free)
            return CompressedRegression(self.names, joint_triangles.triangles, rows, idle)
        return compress_rows(W[counted], self.y[counted], row_joint, len(joints), self.names, free)

    def compute_residual(self, beta: np.ndarray, counted: np.ndarray) -> np.ndarray:
        """y - W beta of some rows."""
        if (W := self.stored_matrix) is None:
            return compute_base_residual(self.observation, beta, counted)
        return np.asarray(self.y[counted] - W[counted] @ beta)


def identify(
    observation: Observation,
    method: Method = "weighted",
    model: CompiledModel | None = None,
    below: float | None = None,
) -> FitResult:
    """The fit of the base parameters to an observation.

    Parameters that the data cannot tell are set aside by name; the essential ones are marked.

    Args:
        observation: of one or several logs.
        method: the estimator, see `estimation.methods`.
        model: the compiled robot, for estimators that simulate it or know its nominal values.
        below: percent, of the rule by sigmas for what is essential; see
            `select_essential_parameters`.

    Raises:
        DataError: fewer rows than parameters, no torque at all, no such method, or one that these
            logs or this robot give nothing to work on.
    """
    return fit_equations(observation, build_base_equations(observation), method, model, below)


def build_base_equations(observation: Observation) -> Equations:
    """The equations of the bare robot."""
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
    """The fit of y = W beta; equations row for row those of the observation, else as `identify`.

    Sigmas of noise only leave out what halves of the motion disagree about: for tests of it.

    Of long logs the data are all rows, and the observation's are windows, that share of them: how
    far residuals remember, what halves disagree about, and by what factors that raises the sigmas,
    comes from the windows.
    """
    estimator, windows = find_method(method), data is not None
    dead, alive = find_disconnected_joints(observation), find_connected_rows(observation)
    data = data or equations.compress_rows(alive)
    columns, count = len(equations.names), int(data.rows.sum())
    if count < columns:
        raise DataError(
            f"{', '.join(observation.logs)}: {count} rows for {columns} parameters; record "
            "more motion, or filter less (a higher --parallel-cutoff keeps more rows)"
        )
    problem = Problem(
        observation, equations.stored_matrix, equations.y, alive, equations.names, data, model
    )
    prior, unused = None, tuple[str, ...]()
    if model is not None and not noise_only:
        if estimator.takes_prior:
            prior = build_prior(model.spec)
        else:
            use = "; the values of the robot file are a guide that the data overrule"
            unused = describe_unused_prior(model.spec, f"method {method}", use)
    estimate = estimator.estimate(problem)
    autocorrelation = estimate_hac_covariance(problem, estimate, share=share)
    white = np.sqrt(np.diag(estimate.covariance))
    differ = HalvesComparison(np.ones(len(white)))
    if not noise_only:
        lasting = np.zeros(len(observation.joints)) if windows else autocorrelation.lag1
        differ = compare_halves(  # windows tell a difference by so much less surely than all rows
            observation,
            lambda rows: equations.compress_rows(rows, estimate.weight),
            alive,
            estimate,
            autocorrelation.factors * white / share**0.5,
            lasting,
            equations.select_conditions(alive).get("loaded"),
        )
    warnings = differ.collect_warnings(
        equations.names, [joint.name for joint in observation.joints]
    )
    raised = np.sqrt(1.0 + (differ.factors**2 - 1.0) / share)
    factors = autocorrelation.factors * raised
    covariance = estimate.covariance * np.outer(factors, factors)
    if prior is not None:  # rows that repeat each other weigh less beside it
        full = autocorrelation.inflate_covariance(estimate.covariance)
        more = np.maximum(np.diag(covariance) - np.diag(full), 0.0)
        estimate = prior.combine_with_data(
            estimate, data, full, more, [j.name for j in observation.joints]
        )
    essential = select_essential_parameters(data, estimate, method, below)
    at = [equations.names.index(name) for name in essential.names]
    if essential.dropped and below is None and not noise_only:
        errors, as_good = compute_held_out_errors(equations, alive, estimate.sigma, prior, at)
        if not as_good:
            essential = select_essential_parameters(data, estimate, method, NONE_LEAVES)
        essential = dataclasses.replace(essential, held_out=errors)
        at = [equations.names.index(name) for name in essential.names]
    reduced = np.ones(len(at))
    if prior is None:
        reduced = (
            raised[at] * estimate_hac_covariance(problem, essential.reduced, at, share).factors
        )
        estimate = dataclasses.replace(estimate, covariance=covariance)
    return build_result(
        equations,
        method,
        estimate,
        essential,
        data,
        estimate.sigma,
        rows=count,
        sentences=(
            *equations.sentences,
            *unused,
            *_describe_disconnected(observation, dead),
            *estimate.sentences,
            *(tangle.describe() for tangle in estimate.rank.dropped_columns),
            *estimate.describe_nonconvergence(),
            essential.describe(data, estimate.beta),
            *autocorrelation.format_sentences(),
            *(doubt.line for doubt in warnings),
            *compare_bands(observation, estimate),
        ),
        reduced=reduced,
        standard=estimate.standard,
        estimator_notes=estimate.sentences,
        joint_warnings=tuple(warnings),
        by_load={
            name: build_joint_fits(
                observation, equations.compress_rows(is_counted), estimate.beta, estimate.sigma
            )
            for name, is_counted in equations.select_conditions(alive).items()
        },
    )


def build_result(
    equations: Equations,
    method: str,
    estimate: Estimate,
    essential: EssentialParameters,
    data: CompressedRegression,
    sigma_of_rows: np.ndarray | None = None,
    reduced: np.ndarray | None = None,
    **further: Any,
) -> FitResult:
    """The result that an estimate makes.

    Args:
        equations: that were fitted.
        method: id.
        estimate: its solution, the covariance raised where residuals repeat each other.
        essential: of its parameters.
        data: the torques that its errors are of.
        sigma_of_rows: (n,) of each joint; None: what is left of it.
        reduced: (essential,) factors on the sigmas of the reduced model; None: it has none.
        **further: fields of the result.
    """
    observation, count = equations.observation, len(equations.observation.names)
    before, after = essential.compute_errors(data, estimate.beta)
    labels = list(zip(equations.names, equations.units, strict=True))
    alone = (
        None if reduced is None else build_reduced_model(essential, reduced, dict(labels), after)
    )
    settled = "ok" if estimate.is_converged else "not settled"
    sigma, estimated = np.sqrt(np.diag(estimate.covariance)), set(estimate.rank.kept_columns)
    every = tuple(
        ParameterEstimate(
            name=name,
            unit=unit,
            value=float(estimate.beta[i]),
            sigma=float(sigma[i]) if i in estimated else None,
            essential=name in essential.names,
            status="held"
            if name in estimate.fixed_names
            else "estimated"
            if i in estimated
            else "set aside",
            prior=float(estimate.prior_share[i])
            if estimate.prior_share is not None and i in estimated
            else None,
        )
        for i, (name, unit) in enumerate(labels)
    )
    return FitResult(
        robot=observation.robot,
        method=method,
        status="rank deficient" if estimate.rank.dropped_columns else settled,
        samples=len(observation.time),
        **select_attributes(estimate, "condition_number condition_scaled contradicted"),
        relative_error=before,
        essential_error=after,
        joints=build_joint_fits(observation, data, estimate.beta, sigma_of_rows),
        parameters=every[:count],
        covariance=estimate.covariance[:count, :count],
        loads=every[count:],
        processing=observation.report.processing,
        bands=observation.report.bands,
        essential=alone,
        **further,
    )


def compress_all_rows(observation: Observation) -> CompressedRegression:
    """The equations of the bare robot on all joints whose torque is connected."""
    return build_base_equations(observation).compress_rows(find_connected_rows(observation))


def find_connected_rows(observation: Observation) -> np.ndarray:
    """(rows,) True for those of joints whose torque is connected.

    See " "`find_disconnected_joints`.
    """
    return ~np.isin(observation.row_joint, find_disconnected_joints(observation))


def find_disconnected_joints(observation: Observation) -> list[int]:
    """Indices of the joints that have a motor and a torque of 0 in all their rows.

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


def _describe_disconnected(observation: Observation, dead: Sequence[int]) -> list[str]:
    """A line on each joint whose torque is not connected."""
    return [
        f"joint {observation.joints[j].name}: its torque is 0 in every row, so none of them is "
        "used; is it connected? if it has no motor, mark it passive in the robot file (mu = 0)"
        for j in dead
    ]


def compute_relative_errors(observation: Observation, beta: np.ndarray) -> dict[str, float]:
    """||y_j - W_j beta|| / ||y_j|| by joint: the one number that is called error."""
    count, joint = len(observation.joints), observation.row_joint
    left = np.bincount(joint, compute_base_residual(observation, beta) ** 2, count)
    total = np.bincount(joint, observation.y**2, count)
    return {
        each.name: float(np.sqrt(a / b))
        for each, a, b in zip(observation.joints, left, total, strict=True)
        if b > 0.0
    }


def build_joint_fits(
    observation: Observation,
    data: CompressedRegression,
    beta: np.ndarray,
    sigma: np.ndarray | None = None,
) -> tuple[JointFit, ...]:
    """What is left of each joint; without a `sigma` (n,) of its rows, that is it."""
    residual, torque = data.compute_residual_norms(beta), data.compute_torque_norms()
    if sigma is None:
        sigma = np.maximum(residual / np.sqrt(np.maximum(data.rows, 1)), compute_least_sigma(data))
    return tuple(
        JointFit(
            name=joint.name,
            unit=joint.effort_unit,
            rows=int(data.rows[j]),
            relative_error=float(residual[j] / torque[j]) if torque[j] > 0.0 else None,
            rms=float(residual[j] / np.sqrt(max(1, data.rows[j]))),
            sigma=float(sigma[j]),
        )
        for j, joint in enumerate(observation.joints)
    )


DISAGREE = 4.0
"""Standard deviations by which the widest cut-offs and the chosen ones may disagree unsaid."""


def compare_bands(observation: Observation, estimate: Estimate) -> list[str]:
    """A sentence where wider filters give other values: the noise of the motion bends those."""
    values = np.array(observation.report.bands.widest_values)
    if not values.size:
        return []
    sigma = np.sqrt(np.diag(estimate.covariance))[: len(values)]
    d = np.abs(values - estimate.beta[: len(values)])
    apart = np.divide(d, sigma, out=np.zeros(len(d)), where=sigma > 0.0)
    worst = int(apart.argmax())
    # of long logs, only a part was looked at
    share = min(1.0, SAMPLES / sum(log.rows for log in observation.report.logs))
    if apart[worst] < DISAGREE / share**0.5:
        return []
    return [
        f"the widest cut-offs and the chosen ones disagree by {apart[worst]:.2g} sigma "
        f"({observation.names[worst]}): behind the wider ones, the noise of the motion bends values"
    ]


# Does the fit predict motion like that of its logs? What was left out answers.


FOLDS = 8

SEEN = 1e-8
"""Share of the largest singular value, columns scaled, below which a fold sees no direction."""


@dataclass(frozen=True, eq=False)
class CrossValidation:
    """Errors of the fit on stretches that it was not fitted to.

    Attributes:
        errors: (n,) ||y_j - W_j beta|| / ||y_j||, each stretch predicted from the others; nan for
            a joint without rows or torque.
        swing: s, half a period of the mean motion: the length of a stretch.
        stretches: that many.
        residual: (rows,) y - W beta, each row predicted from other stretches; 0 for those left out.
        fold: (rows,) which stretches were left out together; of rows that were used.
    """

    errors: np.ndarray
    half_period: float
    stretches: int
    residual: np.ndarray = field(default_factory=lambda: np.zeros(0))
    fold: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=int))


def compute_errors(equations: Equations, residual: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """(n,) ||y_j - W_j beta|| / ||y_j|| on some of the rows, of a residual (rows,) of all."""
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
    """Cross-validation over stretches of half a swing.

    A stretch is as long as the motion needs to turn round, pi rms(qd) / rms(qdd), the median over
    joints: neighbouring samples are alike, and would answer for each other. Every eighth stretch
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
    observation = equations.observation
    speed, acceleration = (
        np.sqrt(np.mean(values**2, axis=0)) for values in (observation.qd, observation.qdd)
    )
    moving = (speed > 1e-6 * speed.max(initial=0.0)) & (acceleration > 0.0)
    periods = np.pi * speed[moving] / acceleration[moving]
    swing = float(np.median(periods)) if moving.any() else 0.0
    number = _count_stretches(observation, swing)
    seen = np.unique(number[observation.row_sample[rows]])
    fold = np.searchsorted(seen, number[observation.row_sample]) % FOLDS
    folds = [rows & (fold == k) for k in range(min(FOLDS, len(seen)))]
    parts = [equations.compress_rows(fold_rows).combine_joints(sigma) for fold_rows in folds]
    residual, known = np.zeros(len(equations.y)), parts[0][:0]
    if prior is not None:
        known = prior.extend_rows(np.linalg.norm(np.vstack(parts)[:, :-1], axis=0))
    for k, fold_rows in enumerate(folds):
        if refit is None:
            others = np.vstack([known, *parts[:k], *parts[k + 1 :]])
            beta = np.zeros(others.shape[1] - 1)
            own_columns = np.arange(len(beta)) if columns is None else np.asarray(columns)
            beta[own_columns] = solve_scaled_least_squares(
                others[:, own_columns], others[:, -1], SEEN
            )
        else:
            beta = refit(np.searchsorted(seen, number) % FOLDS == k)
        residual[fold_rows] = equations.compute_residual(beta, fold_rows)
    errors = compute_errors(equations, residual, rows)
    return CrossValidation(errors, swing, len(seen), residual, fold)


def compute_held_out_errors(
    equations: Equations, rows: np.ndarray, sigma: np.ndarray, prior: Prior | None,
    columns: Sequence[int],
) -> tuple[tuple[float, float], bool]:  # fmt: skip
    """Cross-validated relative errors of all columns and of some; whether these are as good.

    They are if the mean over the folds of the logarithm of their error, rows weighed, is larger
    than that of all by no more than its standard error.
    """
    every, some = (
        cross_validate(equations, rows, sigma, None, prior, selection)
        for selection in (None, columns)
    )
    size = sigma[equations.observation.row_joint[rows]]
    left = [
        np.bincount(some.fold[rows], (selection.residual[rows] / size) ** 2)
        for selection in (every, some)
    ]
    seen = (left[0] > 0.0) & (left[1] > 0.0)
    change = 0.5 * np.log(left[1][seen] / left[0][seen])
    spread = np.std(change, ddof=1) / len(change) ** 0.5 if len(change) > 1 else 0.0
    total = float(np.linalg.norm(equations.y[rows])) or np.nan
    before, after = (
        float(np.linalg.norm(selection.residual[rows])) / total for selection in (every, some)
    )
    return (before, after), bool(len(change) and change.mean() <= spread)


def _count_stretches(observation: Observation, swing: float) -> np.ndarray:
    """(s,) number of the stretch of each sample, ascending over the logs."""
    number, first = np.zeros(len(observation.time), dtype=int), 0
    for run in range(len(observation.logs)):
        is_in_run = observation.run == run
        if not is_in_run.any():
            continue
        since = observation.time[is_in_run] - observation.time[is_in_run].min()
        number[is_in_run] = first + (np.floor(since / swing).astype(int) if swing > 0.0 else 0)
        first = int(number[is_in_run].max()) + 1
    return number
