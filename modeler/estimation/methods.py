"""The table of estimators: one row each, from a problem to an estimate, and what each works on."""

from collections.abc import Callable
from dataclasses import dataclass

from modeler.core.choices import ABOUT, EstimatorInfo, Method
from modeler.core.errors import DataError
from modeler.estimation.consistent import estimate_consistent
from modeler.estimation.instrumental import (
    estimate_didim,
    estimate_didim_consistent,
    estimate_didim_robust,
    estimate_iv,
    estimate_iv_consistent,
    estimate_iv_direct,
    estimate_iv_direct_consistent,
)
from modeler.estimation.least_squares import (
    Estimate,
    Problem,
    estimate_ordinary,
    solve_least_squares,
)
from modeler.estimation.ridge import estimate_ridge
from modeler.estimation.robust import estimate_robust

_REFUSALS = {
    "rows": 'method is "{method}"; expected {capable}',
    "triangles": "fit: method {method} reads every row again and again, and long logs are not kept "
    "in memory; expected {capable}, or a part of the log, FILE@START:END",
    "windows": "--method {method}: the energy model takes {capable}; leave out --method or --model "
    "energy",
}
"""What an estimator may work on, and the sentence for one that does not."""


@dataclass(frozen=True)
class Estimator:
    """A way to estimate.

    Attributes:
        about: id, title, law, source, and when not to use it.
        estimate: the function. Raises DataError where the problem gives it nothing to work on.
        works_on: "rows"; "triangles", if it needs no row again once these are there; "windows" of
            the energy model.
    """

    about: EstimatorInfo
    estimate: Callable[[Problem], Estimate]
    works_on: tuple[str, ...]

    @property
    def takes_prior(self) -> bool:
        """False of those that have one of their own: what a robot file states would be a second."""
        return not (self.about.is_consistent or self.about.id == "ridge")


_EVERYTHING, _FEW = tuple(_REFUSALS), ("weighted", "ordinary")
_ESTIMATES: dict[Method, Callable[[Problem], Estimate]] = {
    "weighted": lambda problem: solve_least_squares(problem.data, "weighted"),
    "ordinary": estimate_ordinary,
    "robust": estimate_robust,
    "ridge": estimate_ridge,
    "iv": estimate_iv,
    "iv-direct": estimate_iv_direct,
    "didim": estimate_didim,
    "didim-robust": estimate_didim_robust,
    "consistent": estimate_consistent,
    "iv-consistent": estimate_iv_consistent,
    "iv-direct-consistent": estimate_iv_direct_consistent,
    "didim-consistent": estimate_didim_consistent,
}
METHODS: dict[Method, Estimator] = {
    id: Estimator(ABOUT[id], estimate, _EVERYTHING if id in _FEW else ("rows",))
    for id, estimate in _ESTIMATES.items()
}
"""By id, in the order in which they are told."""


def find_methods(of: str) -> tuple[Method, ...]:
    """Ids of the estimators that work on such data."""
    return tuple(id for id, estimator in METHODS.items() if of in estimator.works_on)


def find_method(method: str, of: str = "rows") -> Estimator:
    """The estimator of that id.

    Raises:
        DataError: there is none, or it does not work on such data.
    """
    for id in find_methods(of):
        if id == method:
            return METHODS[id]
    *first, last = find_methods(of)
    raise DataError(_REFUSALS[of].format(method=method, capable=f"{', '.join(first)} or {last}"))
