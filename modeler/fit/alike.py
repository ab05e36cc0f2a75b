"""Whether logs belong together: one robot, and a load that sits on its link alike in all."""

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from modeler.estimate.least_squares import least_squares
from modeler.fit.identify import Equations, base_equations, fit_equations
from modeler.fit.payload import Payload, loaded_equations
from modeler.fit.result import ParameterEstimate
from modeler.observation import Observation

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

WORSE = 2.0
"""Ratio of what is left together to what is left alone from which on logs are not of one robot."""

_TELLS = 0.02  # of a joint's torque: less is left of it together than any two machines differ
_FAR = 4.0  # standard deviations between two logs
_WORTH = 0.1  # share of the largest first moment
_FIRST = ("MX", "MY", "MZ")


def not_together(
    model: "CompiledModel", observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """Why logs do not belong together: `mounted_differently`, or else `not_alike`."""
    found = mounted_differently(model, observation, payloads)
    return found or not_alike(model, observation, payloads)


def remounted(payload: Payload) -> list[Payload]:
    """A load for each log: the same mass, its own centre and inertia."""
    if len(payload.logs) == 1:
        return [payload]
    return [
        dataclasses.replace(payload, logs=(log,), name=f"{payload.name}{i}")
        for i, log in enumerate(payload.logs, start=1)
    ]


def mounted_differently(
    model: "CompiledModel", observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """A line for each load whose centre of mass is not the same in all its logs.

    Each of its logs gets a load of its own. Two logs disagree if a first moment MX, MY, MZ differs
    by more than _FAR of its standard deviations and _WORTH of the largest one.
    """
    return [
        line
        for payload in payloads
        if len(payload.logs) > 1
        for line in _disagreement(model, observation, payload)
    ]


def _disagreement(model: "CompiledModel", observation: Observation, payload: Payload) -> list[str]:
    parts = remounted(payload)
    equations = loaded_equations(model, observation, parts).equations
    fit = fit_equations(observation, equations, "weighted", noise_only=True)
    found = [_moments(fit.loads, part.name) for part in parts]
    largest = max((abs(p.value) for moments in found for p in moments.values()), default=0.0)
    worst, line = max(_FAR, 0.0), ""
    for label in sorted(set.intersection(*(set(moments) for moments in found))):
        a, b = (pick(found, key=lambda m: m[label].value)[label] for pick in (max, min))
        apart = (a.value - b.value) / float(np.hypot(a.sigma or np.inf, b.sigma or np.inf))
        if apart > worst and a.value - b.value > _WORTH * largest:
            worst = apart
            line = (
                f"payload {payload.name}: the logs {', '.join(payload.logs)} disagree about where "
                f"it sits: {label} is from {b.value:.3g} to {a.value:.3g} {a.unit}; if it was "
                "taken off in between, give --payload-moved"
            )
    return [line] if line else []


def _moments(loads: Sequence[ParameterEstimate], name: str) -> dict[str, ParameterEstimate]:
    """First moments that the logs tell, by name without that of the load."""
    return {
        p.name.removesuffix(f"_{name}"): p
        for p in loads
        if p.name.endswith(f"_{name}") and p.sigma is not None and p.name.startswith(_FIRST)
    }


def not_alike(
    model: "CompiledModel", observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """A line if the logs are described alone, loaded ones with another last link, but not together.

    Together every log has the same base parameters, loads come beside them, and every load has its
    own mass; torques are taken as they are. The line names the joint where it shows most.

    Args:
        model: the robot.
        observation: of all logs.
        payloads: which of them carry what.
    """
    loaded = loaded_equations(model, observation, payloads)
    weights = [f"weight {i}" for i in range(len(loaded.weighed))]
    free = loaded.equations.with_columns(loaded.torques, weights)
    bare, every = base_equations(observation), np.ones(len(observation.y), dtype=bool)
    together = _left(free, every) ** 2
    alone = np.zeros(len(together))
    for run in range(len(observation.logs)):
        alone += _left(bare, observation.row_run == run) ** 2
    torque = bare.compressed(every).torque_norms()
    felt = (torque > 0.0) & (together > (_TELLS * torque) ** 2)
    if not felt.any():
        return []
    ratio = np.where(felt, together / np.maximum(alone, 1e-300), 0.0)
    worst = int(np.argmax(ratio))
    if ratio[worst] < WORSE**2:
        return []
    apart, all_of_them = (
        100.0 * float(np.sqrt(v[worst])) / float(torque[worst]) for v in (alone, together)
    )
    return [
        f"the logs {', '.join(observation.logs)} do not fit one robot: joint "
        f"{observation.joints[worst].name} has {apart:.2g} % of its torque left if each is "
        f"described alone, and {all_of_them:.2g} % together; are all of the same robot, is the "
        "load on the link that is said to carry it, and does friction grow with the load?"
    ]


def _left(equations: Equations, rows: np.ndarray) -> np.ndarray:
    """(n,) norm of what a weighted fit of these rows leaves of each joint, N m or N.

    Raised by as much as the parameters lower it: few rows are described by many parameters.
    """
    count, columns = int(rows.sum()), len(equations.names)
    if count <= columns:
        return np.full(len(equations.observation.joints), np.inf)  # nothing to be said of so few
    data = equations.compressed(rows)
    return float(np.sqrt(count / (count - columns))) * data.residual_norms(least_squares(data).beta)
