"""Runs with a load on a link: its parameters, and whether the logs are of one robot and load."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from modeler.core.choices import Method
from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_percent
from modeler.estimation.identify import Equations, build_base_equations, fit_equations
from modeler.estimation.least_squares import solve_least_squares
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.result import FitResult
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import (
    compute_column_norms,
    compute_triangle,
    solve_scaled_least_squares,
)
from modeler.regression import Observation, Segment, compute_signals
from modeler.runtime import CompiledModel

ORDER = ("M", "MX", "MY", "MZ", "ZZ", "XX", "YY", "XY", "XZ", "YZ")
"""Where two load parameters cannot be distinguished, the first in this order stays."""

AnyModel = TypeVar("AnyModel", bound=IdentifiedModel)

LARGEST_MASS = 1e6
"""kg. Nothing that a robot carries weighs more."""


@dataclass(frozen=True)
class Payload:
    """Describes a load that is fixed on a link during some logs.

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
    """Returns the fit of robot and loads together: y - m w_M = W beta + W_L chi_L.

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
    """Holds the equations of robot and loads.

    Attributes:
        equations: with the known weights on the side of the measurement.
        weighed: the payloads of known mass.
        torques: (rows, weighed) N m or N that each of these masses accounts for.
    """

    equations: Equations
    weighed: tuple[Payload, ...]
    torques: np.ndarray

    def can_identify_mass(self, i: int) -> bool:
        """Returns True if the mass of a weighed payload is identifiable beside all parameters."""
        return bool(select_independent(self.equations.W, self.torques[:, [i]]))


def build_loaded_equations(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> LoadedEquations:
    """Returns the equations that `identify_with_payloads` fits.

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
    notes = [
        f"{payload.name}: its mass of {payload.mass:g} kg is taken as given: it is not "
        "identifiable from these logs beside its other parameters"
        for i, payload in enumerate(weighed)
        if not loaded.can_identify_mass(i)
    ]
    noted = dataclasses.replace(equations, sentences=(*equations.sentences, *notes))
    return dataclasses.replace(loaded, equations=noted)


def _add_load(
    equations: Equations, model: CompiledModel, observation: Observation, payload: Payload
) -> Equations:
    """Returns the equations with the columns of a load that are independent of those there are."""
    link = payload.link or find_carrier(model.spec)
    place = {p.name: i for i, p in enumerate(model.spec.standard) if p.effect == "rigid_body"}
    labels = [label for label in ORDER if f"{label}{link}" in place]
    places = [place[f"{label}{link}"] for label in labels]

    def evaluate(s: Segment, w: slice) -> np.ndarray:
        signals = compute_signals(model, s)
        part = None if signals is None else signals[w]
        return model.regressor(s.q[w], s.qd[w], s.qdd[w], part)[:, :, places]

    columns = observation.filter_columns(evaluate)[observation.used]
    runs = [i for i, name in enumerate(observation.logs) if name in payload.logs]
    columns[~np.isin(observation.row_run, runs)] = 0.0
    y = equations.y
    if payload.mass is not None:
        y = y - payload.mass * columns[:, labels.index("M")]
        columns, labels, places = columns[:, 1:], labels[1:], places[1:]
    kept_columns = select_independent(equations.W, columns)
    names = [f"{label}{link}" for label in labels]
    sums = _group_columns(equations.W, columns, names, kept_columns)
    load_names = [f"{names[i]}{'R' if i in sums else ''}_{payload.name}" for i in kept_columns]
    idle = [name for i, name in enumerate(names) if not columns[:, i].any()]
    gone = [n for i, n in enumerate(names) if i not in kept_columns and n not in idle]
    notes = [f"{names[k]}R_{payload.name} = {text}" for k, text in sums.items()]
    if gone:
        why = "are not identifiable apart from the others and are grouped with them"
        notes.insert(0, f"{', '.join(gone)} of the load {why}")
    if idle:
        notes.insert(0, f"{', '.join(idle)} of the load have no effect on the torques")
    units = (*equations.units, *(model.spec.standard[places[i]].unit for i in kept_columns))
    extra = np.column_stack([equations.extra, columns[:, kept_columns]])
    every = *equations.names, *load_names
    equations = dataclasses.replace(equations, extra=extra, y=y, names=every, units=units)
    notes = [*equations.sentences, *(f"{payload.name}: {note}" for note in notes)]
    logs = *equations.loaded_logs, *payload.logs
    return dataclasses.replace(equations, sentences=tuple(notes), loaded_logs=logs)


def find_carrier(spec: ModuleSpec) -> str:
    """Returns the link that carries loads: the platform of a parallel robot, or the last one."""
    closure = spec.closure  # whose joints are the coordinates only
    return spec.joints[-1].name if closure is None else closure.carrier or closure.variables[-1]


def add_known_load(
    model: AnyModel, mass: float, centre: Sequence[float] = (0.0, 0.0, 0.0), link: str | None = None
) -> AnyModel:
    """Returns the model of the robot with a load that is known: beta + K d(chi).

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
    links = {p.joint for p in model.spec.standard if p.effect == "rigid_body"}
    if place not in links:
        there = ", ".join(sorted(links))
        raise DataError(f"payload: no link {place}; {model.spec.robot} has {there}")
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
    changes = (sum(t.value * named.get(t.parameter, 0.0) for t in b.terms) for b in model.spec.base)
    pairs = zip(model.fit.parameters, changes, strict=True)
    parameters = tuple(dataclasses.replace(p, value=p.value + change) for p, change in pairs)
    fit = dataclasses.replace(model.fit, parameters=parameters)
    return dataclasses.replace(model, fit=fit)


def _check_payloads(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> None:
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
    if len({payload.name for payload in payloads}) < len(payloads):
        raise DataError("two payloads have the same name; give each its own")
    if {name for payload in payloads for name in payload.logs} >= set(observation.logs):
        raise DataError(
            "every log carries a load, so the load is not identifiable apart from the last link; "
            "add a log of the bare robot"
        )


def _group_columns(
    base: np.ndarray, columns: np.ndarray, names: Sequence[str], kept_columns: Sequence[int]
) -> dict[int, str]:
    """Returns {kept column: the sum that its parameter stands for, "M3 + 11.1*YY3"}."""
    basis = np.column_stack([base, columns[:, kept_columns]])
    lengths = np.linalg.norm(columns, axis=0)
    relations: dict[int, str] = {}
    for i, name in enumerate(names):
        if i in kept_columns or lengths[i] == 0.0 or not kept_columns:
            continue
        factors = solve_scaled_least_squares(basis, columns[:, i])[-len(kept_columns) :]
        for k, factor in zip(kept_columns, factors, strict=True):
            if abs(factor) * lengths[k] > THRESHOLDS.column_tolerance**0.5 * lengths[i]:
                term = f"{'-' if factor < 0.0 else '+'} {abs(factor):.4g}*{name}"
                relations[k] = f"{relations.get(k, names[k])} {term}"
    return relations


def select_independent(base: np.ndarray, columns: np.ndarray) -> list[int]:
    """Returns indices of the columns that neither `base` nor earlier columns reproduce."""
    every = np.column_stack([base, columns])
    left = np.diag(compute_triangle(every / compute_column_norms(every)))[base.shape[1] :]
    return np.flatnonzero(np.abs(left) > THRESHOLDS.column_tolerance).tolist()


def find_heterogeneous_logs(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """Returns why logs do not belong together: moved payloads, or else different robots."""
    every = (payload for payload in payloads if len(payload.logs) > 1)
    moved = [line for payload in every if (line := _find_moved_load(model, observation, payload))]
    return moved or find_different_robots(model, observation, payloads)


def separate_payload(payload: Payload) -> list[Payload]:
    """Returns a load for each log: the same mass, its own centre and inertia."""
    if len(payload.logs) == 1:
        return [payload]
    return [
        dataclasses.replace(payload, logs=(log,), name=f"{payload.name}{i}")
        for i, log in enumerate(payload.logs, start=1)
    ]


def _find_moved_load(model: CompiledModel, observation: Observation, payload: Payload) -> str:
    """Returns a line if the centre of mass of a load is not the same in all its logs.

    Each of its logs gets a load of its own. Two logs disagree if a first moment MX, MY, MZ differs
    by more than so many of its standard deviations and a share of the largest one.
    """
    parts = separate_payload(payload)
    equations = build_loaded_equations(model, observation, parts).equations
    fit = fit_equations(observation, equations, "weighted", noise_only=True)
    moments = [p for p in fit.loads if p.sigma is not None and p.name[:2] in ("MX", "MY", "MZ")]
    ends = [f"_{part.name}" for part in parts]
    every = [[p for p in moments if p.name.endswith(end)] for end in ends]
    named = zip(ends, every, strict=True)
    first_moments = [{p.name.removesuffix(end): p for p in some} for end, some in named]
    values = [abs(p.value) for moments in first_moments for p in moments.values()]
    least = THRESHOLDS.min_moment_share * max(values, default=0.0)
    worst, line = THRESHOLDS.different_log_sigmas, ""
    for label in sorted(set.intersection(*(set(moments) for moments in first_moments))):
        b, *_, a = sorted((moments[label] for moments in first_moments), key=lambda p: p.value)
        apart = (a.value - b.value) / float(np.hypot(a.sigma or np.inf, b.sigma or np.inf))
        if apart > worst and a.value - b.value > least:
            worst = apart
            line = (
                f"payload {payload.name}: the logs {', '.join(payload.logs)} disagree about where "
                f"it sits: {label} is from {b.value:.3g} to {a.value:.3g} {a.unit}; if it was "
                "taken off in between, give --payload-moved"
            )
    return line


def find_different_robots(
    model: CompiledModel, observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """Returns a line if a fit describes the logs alone, but not together.

    Together every log has the same base parameters, loads come beside them, and every load has its
    own mass; torques are taken as they are. Alone, loaded logs have another last link. The line
    names the joint where it shows most.

    Args:
        model: the robot.
        observation: of all logs.
        payloads: which of them carry what.
    """
    loaded = build_loaded_equations(model, observation, payloads)
    weights = [f"weight {i}" for i in range(len(loaded.weighed))]
    free = loaded.equations.append_columns(loaded.torques, weights)
    bare, every = build_base_equations(observation), np.ones(len(observation.y), dtype=bool)
    together = _compute_residual_norms(free, every) ** 2
    runs = (observation.row_run == run for run in range(len(observation.logs)))
    alone = np.sum([_compute_residual_norms(bare, rows) ** 2 for rows in runs], axis=0)
    torque = bare.compress_rows(every).compute_torque_norms()
    is_large = together > (THRESHOLDS.min_different_share * torque) ** 2
    ratio = np.where((torque > 0.0) & is_large, together / np.maximum(alone, 1e-300), 0.0)
    worst = int(np.argmax(ratio))
    if ratio[worst] < THRESHOLDS.max_joint_ratio**2:
        return []
    errors = (format_percent(np.sqrt(v[worst]) / torque[worst]) for v in (alone, together))
    return [
        f"the logs {', '.join(observation.logs)} do not fit one robot: joint "
        f"{observation.joints[worst].name} has a fit error of {' alone and '.join(errors)} "
        "together; are all of the same robot, and is the load on the link that carries it?"
    ]


def _compute_residual_norms(equations: Equations, rows: np.ndarray) -> np.ndarray:
    """Returns (n,) norm of the residual of a weighted fit of these rows, by joint, N m or N.

    Raised by as much as the parameters lower it: few rows are described by many parameters.
    """
    count, columns = int(rows.sum()), len(equations.names)
    if count <= columns:
        return np.full(len(equations.observation.joints), np.inf)  # nothing to be said of so few
    data = equations.compress_rows(rows)
    norms = data.compute_residual_norms(solve_least_squares(data).beta)
    return float(np.sqrt(count / (count - columns))) * norms
