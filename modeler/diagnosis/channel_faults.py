"""Channels that contradict the model, once wrong drive gains are allowed for.

A wrong drive gain bends the fit: the torques of its joint, and of others, then look like those of
another unit, or of another joint. So where a model was fitted to these logs, the joints in doubt
are given gains first; those are effects, which the search names with their values. What is said of
a scale all the same must not be a matter of the filters.
"""

import dataclasses

import numpy as np

from modeler.diagnosis.analyse import analysed
from modeler.diagnosis.cross_checks import cut_off_otherwise
from modeler.diagnosis.drive_gains import with_gains
from modeler.diagnosis.state import Data, state_of
from modeler.estimation.model_file import IdentifiedModel
from modeler.observation.channels import Fault, faults, suspects
from modeler.observation.prepare import Mending


def channel_faults(
    model: IdentifiedModel, data: Data, other: Data | None, mending: Mending
) -> tuple[Fault, ...]:
    """Of the logs, then of the held-out ones.

    Args:
        model: as fitted.
        data: training logs.
        other: held-out ones.
        mending: of the training logs.
    """
    beta, gains = _allowed(model, data, other)
    found = faults(data.compiled, data.observation, beta, gains)
    if any(f.joint >= 0 and not f.certain for f in found):
        stable = _stable(data, mending, beta, gains)
        found = tuple(f for f in found if f.certain or f.joint in (-1, *stable))
    if other is None:
        return found
    held = faults(other.compiled, other.observation, beta, gains)
    said = {f.joint for f in found}
    held = tuple(f for f in held if f.certain or f.joint in said)
    return (*found, *(dataclasses.replace(f, line=f"held out: {f.line}") for f in held))


def _allowed(
    model: IdentifiedModel, data: Data, other: Data | None
) -> tuple[np.ndarray, np.ndarray | None]:
    """Parameters, and gains of the joints in doubt; as fitted where the fit is of other logs."""
    every = [data, *([other] if other is not None else [])]
    doubted = {j for d in every for j in suspects(d.compiled, d.observation, model.beta)}
    if data.kept is not None or not doubted or len(doubted) == data.rows.joints:
        return model.beta, None
    found = with_gains(state_of(data, (), model.beta), sorted(doubted))
    return (model.beta, None) if found is None else found


def _stable(data: Data, mending: Mending, beta: np.ndarray, gains: np.ndarray | None) -> set[int]:
    """Joints whose torque has another scale with other cut-offs too."""
    joints = [
        {f.joint for f in faults(data.compiled, seen, beta, gains)}
        for seen in (
            analysed(data.compiled, mending.logs, changed, chosen=True, mending=mending)
            for _, changed in cut_off_otherwise(data, mending.logs)
        )
    ]
    return set.intersection(*joints)
