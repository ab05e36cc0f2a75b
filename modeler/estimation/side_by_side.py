"""All estimators on the same rows: values, errors, time, and what each says of itself."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.choices import ABOUT, EstimatorInfo, Method
from modeler.core.errors import ModelerError
from modeler.core.json import Document
from modeler.core.result import Result
from modeler.estimation.identify import identify
from modeler.estimation.result import FitResult
from modeler.regression import Observation
from modeler.runtime import CompiledModel

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
