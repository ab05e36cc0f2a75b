"""Runs with a load on a link: its parameters beside those of the robot; mounted again."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.estimation.identify import Equations, build_base_equations, fit_equations
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.result import FitResult
from modeler.numerics.least_squares import (
    compute_column_norms,
    compute_triangle,
    solve_scaled_least_squares,
)
from modeler.regression import Observation, Segment, compute_signals
from modeler.runtime import CompiledModel

_ORDER = ("M", "MX", "MY", "MZ", "ZZ", "XX", "YY", "XY", "XZ", "YZ")
"""Where two load parameters cannot be told apart, the first in this order stays."""

_TOLERANCE = 1e-8  # what is left of a column, as a share of its length, counts as zero


AnyModel = TypeVar("AnyModel", bound=IdentifiedModel)

LARGEST_MASS = 1e6
"""kg. Nothing that a robot carries weighs more."""


@dataclass(frozen=True)
class Payload:
    """A load that is fixed on a link during some logs.

    Attributes:
        logs: names of those logs (`Log.name`).
        link: row of the table; None: the platform, or the last joint's link.
        mass: kg, if it is known; its weight and inertia go to the side of the measurement.
        name: suffix of its parameters.
    """

    logs: tuple[str, ...]
    link: str | None = None
    mass: float | None = None
    name: str = "load"


def identify_with_payloads(
    model: CompiledModel,
    observation: Observation,
    payloads: Sequence[Payload],
    method: Method = "weighted",
    below: float | None = None,
) -> FitResult:
    """The fit of robot and loads together: y - m w_M = W beta + W_L chi_L.

    W_L holds the ten standard inertial columns of the link on the rows of the loaded logs, zero on
    the others, reduced to those that base and other load columns do not reproduce (Khalil, Gautier
    and Lemoine 2007). The result's `parameters` are the bare robot, `loads` the loads.

    Args:
        model: the compiled robot.
        observation: of loaded and unloaded logs together.
        payloads: which logs carry what.
        method: as for `identify`.
        below: as for `identify`.

    Raises:
        DataError: a log or link that is not there, every log loaded, a mass that is not positive.
    """
    equations = build_loaded_equations(model, observation, payloads).equations
    return fit_equations(observation, equations, method, model, below)


@dataclass(frozen=True, eq=False)
class LoadedEquations:
    """The equations of robot and loads.

    Attributes:
        equations: with the known weights on the side of the measurement.
        weighed: the payloads of known mass.
        torques: (rows, weighed) N m or N that each of these masses accounts for.
    """

    equations: Equations
    weighed: tuple[Payload, ...]
    torques: np.ndarray

    def can_identify_mass(self, i: int) -> bool:
        """True if the logs tell the mass of a weighed payload from all other parameters."""
        return bool(select_independent(self.equations.W, self.torques[:, [i]]))


def build_loaded_equations(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> LoadedEquations:
    """The equations that `identify_with_payloads` fits.

    Raises:
        DataError: see there.
    """
    _check_payloads(model, observation, payloads)
    equations = build_base_equations(observation)
    sides = [equations.y]
    for payload in payloads:
        equations = _add_load(equations, model, observation, payload)
        sides.append(equations.y)
    known = [i for i, payload in enumerate(payloads) if payload.mass is not None]
    weighed = tuple(payloads[i] for i in known)
    loaded = LoadedEquations(equations, weighed, -np.diff(sides, axis=0)[known].T)
    blind = [
        f"{payload.name}: its mass of {payload.mass:g} kg is taken as given: these logs do not "
        "tell it from its other parameters"
        for i, payload in enumerate(weighed)
        if not loaded.can_identify_mass(i)
    ]
    annotated = dataclasses.replace(equations, sentences=(*equations.sentences, *blind))
    return dataclasses.replace(loaded, equations=annotated)


def _add_load(
    equations: Equations, model: CompiledModel, observation: Observation, payload: Payload
) -> Equations:
    """The equations with the columns of a load that can be told apart, beside those there are."""
    link = payload.link or find_carrier(model.spec)
    place = {p.name: i for i, p in enumerate(model.spec.standard) if p.effect == "rigid_body"}
    labels = [label for label in _ORDER if f"{label}{link}" in place]
    places = [place[f"{label}{link}"] for label in labels]
    units = [model.spec.standard[i].unit for i in places]

    def evaluate(s: Segment, w: slice) -> np.ndarray:
        read = compute_signals(model, s)
        part = None if read is None else read[w]
        return model.regressor(s.q[w], s.qd[w], s.qdd[w], part)[:, :, places]

    columns = observation.filter_columns(evaluate)[observation.used]
    runs = [i for i, name in enumerate(observation.logs) if name in payload.logs]
    columns[~np.isin(observation.row_run, runs)] = 0.0
    y = equations.y
    if payload.mass is not None:
        y = y - payload.mass * columns[:, labels.index("M")]
        columns, labels, units = columns[:, 1:], labels[1:], units[1:]
    kept_columns = select_independent(equations.W, columns)
    names = [f"{label}{link}" for label in labels]
    sums = _group_columns(equations.W, columns, names, kept_columns)
    load_names = [f"{names[i]}{'R' if i in sums else ''}_{payload.name}" for i in kept_columns]
    remarks = _describe_load(payload, columns, names, kept_columns, sums)
    return dataclasses.replace(
        equations,
        extra=np.column_stack([equations.extra, columns[:, kept_columns]]),
        y=y,
        names=(*equations.names, *load_names),
        units=(*equations.units, *(units[i] for i in kept_columns)),
        sentences=(*equations.sentences, *remarks),
        loaded_logs=(*equations.loaded_logs, *payload.logs),
    )


def find_carrier(spec: ModuleSpec) -> str:
    """The link that carries loads: the platform of a parallel robot, or the last one."""
    closure = spec.closure  # whose joints are the coordinates only
    return spec.joints[-1].name if closure is None else closure.carrier or closure.variables[-1]


def add_known_load(
    model: AnyModel, mass: float, centre: Sequence[float] = (0.0, 0.0, 0.0), link: str | None = None
) -> AnyModel:
    """The model of the robot with a load that is known: beta + K d(chi).

    A mass m at c of a link's frame adds m to M, m c to MX, MY, MZ and m (c'c 1 - c c') to the
    inertia of the link; the base parameters that these are grouped with change by as much.

    Args:
        model: of the bare robot.
        mass: of the load, kg.
        centre: of its mass, m, in the frame of the link.
        link: row of the table; None: the platform, or the last joint's link.

    Raises:
        DataError: no such link, or a load that can be none.
    """
    place = link or find_carrier(model.spec)
    links = {p.joint: None for p in model.spec.standard if p.effect == "rigid_body"}
    if place not in links:
        raise DataError(
            f"payload: no link {place}; {model.spec.robot} has {', '.join(sorted(links))}"
        )
    c = np.asarray(centre, dtype=float)
    if not 0.0 < mass <= LARGEST_MASS or c.shape != (3,) or not np.all(np.isfinite(c)):
        raise DataError(
            f"payload: got {mass:g} kg at {', '.join(f'{x:g}' for x in c.ravel())}; expected a "
            f"mass above 0 and at most {LARGEST_MASS:g}, and x, y, z of its centre in m"
        )
    J = mass * (c @ c * np.eye(3) - np.outer(c, c))
    added = {"M": mass, **dict(zip(("MX", "MY", "MZ"), mass * c, strict=True))}
    added |= {f"{a}{b}": J[i, k] for i, a in enumerate("XYZ") for k, b in enumerate("XYZ")}
    named = {f"{label}{place}": value for label, value in added.items()}
    fit = model.fit
    loaded = [
        dataclasses.replace(p, value=p.value + sum(t.value * named.get(t.parameter, 0.0)
                                                   for t in base.terms))
        for p, base in zip(fit.parameters, model.spec.base, strict=True)
    ]  # fmt: skip
    return dataclasses.replace(model, fit=dataclasses.replace(fit, parameters=tuple(loaded)))


def _check_payloads(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> None:
    loaded: set[str] = set()
    links = {parameter.joint for parameter in model.spec.standard}
    for payload in payloads:
        unknown = [name for name in payload.logs if name not in observation.logs]
        if unknown or not payload.logs:
            raise DataError(
                f"payload {payload.name}: no log {unknown[0] if unknown else 'is named'}; there "
                f"are {', '.join(observation.logs)}"
            )
        if payload.link is not None and payload.link not in links:
            raise DataError(
                f"payload {payload.name}: no link {payload.link}; {model.spec.robot} has "
                f"{', '.join(sorted(links))}"
            )
        if payload.mass is not None and not 0.0 < payload.mass <= LARGEST_MASS:
            raise DataError(
                f"payload {payload.name}: mass {payload.mass} kg; expected above 0 and at most "
                f"{LARGEST_MASS:g}"
            )
        loaded |= set(payload.logs)
    if len({payload.name for payload in payloads}) < len(payloads):
        raise DataError("two payloads have the same name; give each its own")
    if loaded >= set(observation.logs):
        raise DataError(
            "every log carries a load, so it cannot be told from the last link; add a log of the "
            "bare robot"
        )


def _group_columns(
    base: np.ndarray, columns: np.ndarray, names: Sequence[str], kept_columns: Sequence[int]
) -> dict[int, str]:
    """{kept column: the sum that its parameter stands for, "M3 + 11.1*YY3"}, of those that are."""
    basis, lengths = (
        np.column_stack([base, columns[:, kept_columns]]),
        np.linalg.norm(columns, axis=0),
    )
    relations: dict[int, str] = {}
    for i, name in enumerate(names):
        if i in kept_columns or lengths[i] == 0.0 or not kept_columns:
            continue
        factors = solve_scaled_least_squares(basis, columns[:, i])[-len(kept_columns) :]
        for k, factor in zip(kept_columns, factors, strict=True):
            if abs(factor) * lengths[k] > _TOLERANCE**0.5 * lengths[i]:
                term = f"{'-' if factor < 0.0 else '+'} {abs(factor):.4g}*{name}"
                relations[k] = f"{relations.get(k, names[k])} {term}"
    return relations


def _describe_load(
    payload: Payload, columns: np.ndarray, names: Sequence[str], kept_columns: Sequence[int],
    sums: Mapping[int, str],
) -> list[str]:  # fmt: skip
    """What became of the load's parameters that are not estimated."""
    idle = [name for i, name in enumerate(names) if not columns[:, i].any()]
    gone = [n for i, n in enumerate(names) if i not in kept_columns and n not in idle]
    said = []
    if idle:
        said.append(f"{payload.name}: {', '.join(idle)} of the load have no effect on the torques")
    if gone:
        said.append(
            f"{payload.name}: {', '.join(gone)} of the load cannot be told from the others "
            "and are grouped with them"
        )
    said += [f"{payload.name}: {names[k]}R_{payload.name} = {text}" for k, text in sums.items()]
    return said


def select_independent(base: np.ndarray, columns: np.ndarray) -> list[int]:
    """Indices of the columns that neither `base` nor earlier columns reproduce."""
    every = np.column_stack([base, columns])
    left = np.diag(compute_triangle(every / compute_column_norms(every)))[base.shape[1] :]
    return np.flatnonzero(np.abs(left) > _TOLERANCE).tolist()
