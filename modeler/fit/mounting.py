"""One load in several logs: whether it sat on its link alike in all of them."""

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from modeler.fit.identify import fit_equations
from modeler.fit.payload import Payload, loaded_equations
from modeler.fit.result import ParameterEstimate
from modeler.observation import Observation

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

_FAR = 4.0  # standard deviations between two logs
_WORTH = 0.1  # share of the largest first moment
_FIRST = ("MX", "MY", "MZ")


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
