"""Can the values that a diagnosis states be those of a machine?

What it says with a caveat of its own is left alone: there the reader is warned.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from modeler.diagnosis.result import Diagnosis, Finding
from modeler.diagnosis.state import State
from modeler.effects.effect import Requirement

SLACK = 0.05
"""Of the whole friction of a joint: less is rounding."""

MOST_MU = 0.5
"""Load friction above which it is none: half the load."""

BINS = 8
"""Parts of the range of speeds, each way."""

FEWEST = 20
"""Rows of a part that says something."""


def faults(found: Diagnosis) -> tuple[str, ...]:
    """What cannot be, one line each: "fact: payload@6: mass -2 kg" or "hedged: ...".

    A fact is what stands under the verdict `missing` and leads in all other looks.
    """
    lines = []
    for finding in (*found.effects, *found.refinements):
        name = finding.effect + (f"@{finding.joint}" if finding.joint else "")
        way = "fact" if finding.status == "confirmed" else "hedged"
        wrong = list(gain_faults(finding.to_json()))
        if not finding.caveat:
            wrong += [*value_faults(finding.parameters), *_friction_faults(found, finding)]
        lines += [f"{way}: {name}: {what}" for what in wrong]
    return tuple(lines)


def gain_faults(finding: Mapping[str, Any]) -> Iterator[str]:
    """The gain that is said must be the one that the two errors imply."""
    before, after, gain = (finding[name] for name in ("error_before", "error_after", "gain"))
    implied = 1.0 - (after / before) ** 2 if before > 0.0 else 0.0
    if abs(gain - implied) > 1e-9:
        yield f"gain {gain:.3g}, and its errors imply {implied:.3g}"


def value_faults(parameters: Mapping[str, float]) -> Iterator[str]:
    """Values that no machine has."""
    for name, value in parameters.items():
        if name == "mass" and value < 0.0:
            yield f"mass {value:.3g} kg"
        if name.startswith("mu") and abs(value) > MOST_MU:
            yield f"{name} = {value:.3g}, more than {MOST_MU:g}"


def level_fault(name: str, level: float, friction: np.ndarray) -> Iterator[str]:
    """A dry part of a friction is no larger than the largest of all of it.

    Args:
        name: of the part.
        level: its torque, N m or N.
        friction: (rows,) all of it.
    """
    largest = float(np.abs(friction).max(initial=0.0))
    if abs(level) > (1.0 + SLACK) * largest:
        yield f"{name} = {level:.3g}, and all friction of its joint is {largest:.3g} at most"


def driving_fault(friction: np.ndarray, speed: np.ndarray) -> Iterator[str]:
    """Friction brakes at every speed, either way.

    Args:
        friction: (rows,) all that a joint has, N m or N.
        speed: (rows,) of the joint.
    """
    braking, largest = friction * np.sign(speed), float(np.abs(friction).max(initial=0.0))
    for way in (speed > 0.0, speed < 0.0):
        order = np.argsort(np.abs(speed[way]))
        parts = np.array_split(np.flatnonzero(way)[order], BINS)
        for part in (part for part in parts if len(part) >= FEWEST):
            mean = float(braking[part].mean())
            if mean < -SLACK * largest:
                at = float(speed[part].mean())
                yield f"all friction of its joint drives with {-mean:.3g} at a speed of {at:.3g}"
                return


def _friction_faults(found: Diagnosis, finding: Finding) -> Iterator[str]:
    """Levels, and the whole, of the joint whose friction is said to be another."""
    if finding.pick is None:
        return
    pick, state = finding.pick.candidate, found.search.end
    if pick.effect.family != "friction" or not pick.is_local:
        return
    columns, torque, speed = _friction(state, pick.index)
    if not columns:
        return  # a model without friction says nothing of the whole
    levels = {
        c.prefix: finding.parameters[name]
        for c, name in zip(pick.form.columns, pick.list_parameter_names(), strict=True)
        if Requirement.FRICTION in pick.effect.needs
    }
    for name, level in (levels | _coulomb(state, columns)).items():
        yield from level_fault(name, level, torque)
    yield from driving_fault(torque, speed)


def _coulomb(state: State, columns: Sequence[int]) -> dict[str, float]:
    """The level of Coulomb friction beside all effects named."""
    spec = state.data.compiled.spec
    dry = {p.name for p in spec.standard if p.effect == "coulomb"}
    items = [i for i in columns if spec.base[i].column_of in dry]
    return {spec.base[i].name: float(state.beta[i]) for i in items}


def _friction(state: State, j: int) -> tuple[list[int], np.ndarray, np.ndarray]:
    """Base columns of the friction of joint j, (rows_j,) all its friction, (rows_j,) its speed.

    Without what turns gradually: after a reversal that gives back what it has stored.
    """
    base = state.data.compiled.spec.base
    items = [i for i, b in enumerate(base) if b.kind == "friction" and b.rows == (j,)]
    torque = state.rows.W[j][:, items] @ state.beta[items]
    for pick, columns, values in zip(state.picks, state.extra, state.values, strict=True):
        local = pick.effect.family == "friction" and pick.is_local and pick.index == j
        column = columns[j]
        if local and pick.form.internal_state is None and column is not None:
            torque = torque + column @ values
    return items, torque, state.rows.filter_samples(j, [s.v[:, j] for s in state.rows.signals])
