"""The table of estimators: one row each, from a problem to an estimate."""

from collections.abc import Callable
from dataclasses import dataclass

from modeler.core.errors import DataError, Method
from modeler.core.estimators import ABOUT, About
from modeler.estimation.consistent import buildable
from modeler.estimation.instrumental import didim, iv, iv_direct
from modeler.estimation.least_squares import Estimate, least_squares, ordinary
from modeler.estimation.problem import Problem
from modeler.estimation.ridge import ridge
from modeler.estimation.robust import robust


@dataclass(frozen=True)
class Estimator:
    """A way to estimate.

    Attributes:
        about: id, title, law, source, and when not to use it.
        estimate: the function. Raises DataError where the problem gives it nothing to work on.
    """

    about: About
    estimate: Callable[[Problem], Estimate]


def method_of(method: str) -> Estimator:
    """The estimator of that id.

    Raises:
        DataError: there is none.
    """
    if method not in METHODS:
        *first, last = METHODS
        raise DataError(f'method is "{method}"; expected {", ".join(first)} or {last}')
    return METHODS[method]


_FUNCTIONS: dict[Method, Callable[[Problem], Estimate]] = {
    "weighted": lambda problem: least_squares(problem.data, "weighted"),
    "ordinary": ordinary,
    "robust": robust,
    "ridge": ridge,
    "iv": iv,
    "iv-direct": iv_direct,
    "didim": didim,
    "consistent": buildable,
}
METHODS: dict[str, Estimator] = {id: Estimator(ABOUT[id], _FUNCTIONS[id]) for id in _FUNCTIONS}
"""By id, in the order in which they are told."""
