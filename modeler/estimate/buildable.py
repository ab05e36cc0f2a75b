"""The physically consistent estimator: from a problem to a machine that could be built."""

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from modeler.core.contract import ModuleSpec
from modeler.estimate.consistent import Consistent, consistent, pseudo_inertia_of
from modeler.estimate.least_squares import Estimate, least_squares
from modeler.estimate.possible import PREFIXES, Machine, machine_of
from modeler.estimate.problem import Problem
from modeler.estimate.rank import Rank

_LEAST = 1e-6  # a plate or a rod of a drawing is given so much thickness, relative


def buildable(problem: Problem) -> Estimate:
    """The machine that fits best, weighted as `least_squares` weights.

    Links of which the robot file states all ten parameters are references: a guide, that the data
    overrule. What the data cannot tell has a value here, which follows from the bounds and the
    references, but no sigma.

    Raises:
        DataError: no compiled robot, or loads beside it; the solver finds no answer.
    """
    model = problem.robot("consistent")
    start = least_squares(problem.data, "weighted")
    machine = machine_of(model.spec)
    known = references(model.spec)
    found = consistent(machine, problem.data.whole(start.sigma), known)
    told = np.isin(np.arange(len(found.beta)), start.rank.kept)
    return dataclasses.replace(
        start,
        beta=found.beta,
        covariance=found.covariance * np.outer(told, told),
        rank=Rank(start.rank.kept, (), start.rank.last_kept, start.rank.first_dropped),
        standard=_named(model.spec, machine, found.chi),
        sentences=tuple(_sentences(model.spec, found, start, known)),
    )


def references(spec: ModuleSpec) -> dict[str, np.ndarray]:
    """(4, 4) pseudo-inertias of the links of which the robot file states all ten parameters."""
    stated: dict[str, dict[str, float]] = {}
    for parameter in spec.standard:
        if parameter.effect == "rigid_body" and parameter.nominal is not None:
            prefix = parameter.name.removesuffix(parameter.joint)
            stated.setdefault(parameter.joint, {})[prefix] = parameter.nominal
    found = {}
    for link, values in stated.items():
        if len(values) == len(PREFIXES) and values["M"] > 0.0:
            body = pseudo_inertia_of(values)
            size = np.sqrt(np.maximum(np.diag(body), 0.0))
            size = np.maximum(size, 1e-3 * size[:3].max() * np.array([1.0, 1.0, 1.0, 0.0]))
            body = body + _LEAST * np.diag(size**2)
            if size.all() and np.linalg.eigvalsh(body / np.outer(size, size))[0] > 0.0:
                found[link] = body
    return found


def _named(spec: ModuleSpec, machine: Machine, chi: np.ndarray) -> dict[str, float]:
    names = {i: parameter.name for i, parameter in enumerate(spec.standard)}
    for link, own in machine.links.items():
        names |= {place: f"{prefix}{link}" for prefix, place in own.items()}
    return {names[i]: float(value) for i, value in enumerate(chi)}


def _at_zero(spec: ModuleSpec, names: Sequence[str]) -> list[str]:
    """Of the parameters at 0: which the data would have below it, and which they do not tell."""
    sums = [[term.parameter for term in base.terms] for base in spec.base]
    own = [name for name in names if [name] in sums]
    said = [f"{', '.join(own)} held at 0, which would be negative"] if own else []
    for name in names:
        if name not in own:
            beside = dict.fromkeys(x for terms in sums if name in terms for x in terms)
            others = " and ".join(x for x in beside if x != name)
            said.append(f"{name} cannot be told from {others} and is put at 0")
    return said


def _sentences(
    spec: ModuleSpec, found: Consistent, start: Estimate, known: Mapping[str, np.ndarray]
) -> list[str]:
    degrees = len(found.beta)
    said = []
    if found.rise > degrees:
        said.append(
            f"a machine that could be built leaves {found.rise:.3g} variances more than least "
            f"squares, where its {degrees} values would raise it by {degrees} if they were wrong "
            "by one sigma each: these logs hold something that the model does not; see the doubts "
            "of --method weighted"
        )
    said += _at_zero(spec, found.at_bound)
    if start.rank.aside:
        names = ", ".join(tangle.name for tangle in start.rank.aside)
        said.append(f"not told by these data, but by what can be built: {names}")
    loose = [link for link in found.bodies if link not in known]
    if loose:
        said.append(
            f"link {', '.join(loose)}: no drawing in the robot file ([parameters]); what no torque "
            "feels of it is that of a round body, and means nothing by itself"
        )
    return said
