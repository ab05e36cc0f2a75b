"""The fit of long logs, from the triangles of all rows and windows of them."""

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.estimate.coloured import Colour, coloured
from modeler.estimate.compressed import Compressed
from modeler.estimate.halves import halves
from modeler.estimate.least_squares import Estimate
from modeler.estimate.methods import method_of
from modeler.estimate.passing import Neighbours, compressed, rows_of
from modeler.estimate.problem import Problem
from modeler.fit.essential import Essential, essential_parameters
from modeler.fit.identify import (
    base_equations,
    check_enough_rows,
    dead_joints,
    dead_sentences,
    joints_of,
    parameters_of,
    sentences_of,
    status_of,
)
from modeler.fit.reduced import Reduced, reduced_model
from modeler.fit.result import FitResult
from modeler.fit.streamed import Streamed

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

OF_TRIANGLES: tuple[Method, ...] = ("weighted", "ordinary")
"""Methods that need no row again once the triangles are there."""


def identify_long(
    streamed: Streamed, method: Method = "weighted", model: "CompiledModel | None" = None
) -> FitResult:
    """The fit of the base parameters to long logs.

    Values, sigmas, errors and the essential parameters come from all rows; how far residuals
    remember, and by what factor that raises the sigmas, from the windows.

    Args:
        streamed: the logs.
        method: "weighted" or "ordinary".
        model: the compiled robot.

    Raises:
        DataError: another method, fewer rows than parameters, or no torque at all.
    """
    _check_method(method)
    observation = streamed.observation
    dead = dead_joints(observation)
    problem = _problem(streamed, dead, model)
    data, estimate = problem.data, method_of(method).estimate(problem)
    essential = essential_parameters(data, estimate, method)
    rows, every = rows_of(observation, problem.counted), np.arange(len(data.names))
    colour = _coloured(problem, rows, every, estimate, streamed.share)
    white = np.sqrt(np.diag(estimate.covariance))
    differ = halves(  # windows tell a difference by so much less surely than all rows
        observation, lambda own: compressed(observation, own), problem.counted, estimate,
        colour.factors * white / streamed.share**0.5, np.zeros(len(observation.joints)),
    )  # fmt: skip
    raised = np.sqrt(1.0 + (differ.factors**2 - 1.0) / streamed.share)
    factors = colour.factors * raised
    covariance = estimate.covariance * np.outer(factors, factors)
    return FitResult(
        robot=observation.robot, method=method, status=status_of(estimate),
        samples=streamed.samples, rows=int(data.rows.sum()),
        condition_number=estimate.condition_number, condition_scaled=estimate.condition_scaled,
        relative_error=essential.error_before, essential_error=essential.error_after,
        joints=joints_of(observation, data, estimate.beta, estimate.sigma),
        parameters=parameters_of(estimate, essential, base_equations(observation),
                                 np.sqrt(np.diag(covariance))),
        covariance=covariance, loads=(),
        sentences=(*dead_sentences(observation, dead), *estimate.sentences,
                   *sentences_of(estimate, essential), *colour.sentences(),
                   *differ.sentences(observation.names, [j.name for j in observation.joints])),
        processing=observation.report.processing, own=estimate.sentences,
        essential=_reduced(problem, rows, essential, streamed.share, raised),
        reading=streamed.reading,
    )  # fmt: skip


def _problem(streamed: Streamed, dead: list[int], model: "CompiledModel | None") -> Problem:
    """Rows of the windows, and triangles of all."""
    observation = streamed.observation
    data = _without_joints(streamed.data, dead)
    check_enough_rows(observation, len(data.names), int(data.rows.sum()))
    alive = ~np.isin(observation.row_joint, dead)
    return Problem(
        observation, None, observation.y, alive, observation.names, observation.units, data, model
    )  # fmt: skip


def _check_method(method: str) -> None:
    if method not in OF_TRIANGLES:
        raise DataError(
            f"fit: method {method} reads every row again and again, and long logs are not kept in "
            f"memory; expected {' or '.join(OF_TRIANGLES)}, or a part of the log, FILE@START:END"
        )


def _without_joints(data: Compressed, dead: list[int]) -> Compressed:
    """The data without rows of joints whose torque is not connected."""
    gone = np.isin(np.arange(len(data.rows)), dead)
    return dataclasses.replace(
        data,
        triangles=np.where(gone[:, None, None], 0.0, data.triangles),
        rows=np.where(gone, 0, data.rows),
    )


def _coloured(
    problem: Problem,
    rows: np.ndarray | Neighbours,
    at: np.ndarray,
    estimate: Estimate,
    share: float,
) -> Colour:
    """The colour that a share of the rows shows; the estimate is of all of them.

    The covariance of that share alone is larger by its inverse, and so is the pull of its rows.
    """
    influence = estimate.influence
    if influence is not None:
        influence = influence.times(1.0 / share)
    scaled = dataclasses.replace(
        estimate, covariance=estimate.covariance / share, influence=influence
    )
    own = rows if isinstance(rows, Neighbours) else rows[:, at]
    return coloured(problem.observation, own, problem.y, problem.counted, scaled, list(at))


def _reduced(
    problem: Problem,
    rows: np.ndarray | Neighbours,
    essential: Essential,
    share: float,
    raised: np.ndarray,
) -> Reduced | None:
    """The essential parameters alone, as sure as their own residuals let them be."""
    at = np.array([problem.names.index(name) for name in essential.names], dtype=int)
    reduced = essential.reduced
    factors = _coloured(problem, rows, at, reduced, share).factors
    sigma = raised[at] * factors * np.sqrt(np.diag(reduced.covariance))
    units = dict(zip(problem.names, problem.units, strict=True))
    return reduced_model(essential, reduced, sigma, units)
