"""What a model leaves of motion that it was not fitted to."""

import numpy as np

from modeler.compiled import CompiledModel
from modeler.fit import IdentifiedModel
from modeler.hypotheses.blocks import blocks_of
from modeler.observation import Observation
from modeler.observation.torque import model_torque
from modeler.scoring.gram import base_of
from modeler.scoring.score import Unseen


def left_of(model: IdentifiedModel, compiled: CompiledModel, observation: Observation) -> Unseen:
    """What it leaves of logs."""
    left = observation.torque - model_torque(observation, compiled, model.beta)
    return _rows(observation, [left[own, j] for j, own in enumerate(observation.used.T)])


def left_out(
    model: IdentifiedModel, observation: Observation, free: np.ndarray | None = None
) -> Unseen:
    """What it leaves of its own logs, each eighth predicted from a fit to the others.

    Args:
        model: fitted.
        observation: of its logs.
        free: (c, k) the directions of beta that are fitted, beside the model; None: all of it.
    """
    used = observation.used.T
    W = [observation.columns[own, j] for j, own in enumerate(used)]
    y = [observation.torque[own, j] for j, own in enumerate(used)]
    if free is not None:
        y = [tau - w @ model.beta for w, tau in zip(W, y, strict=True)]
        W = [w @ free for w in W]
    blocks = blocks_of(observation)
    number = [blocks.number[own] for own in used]
    sigma = np.array([joint.sigma if joint.sigma > 0.0 else 1.0 for joint in model.fit.joints])
    base = base_of(W, y, sigma, number, blocks.fold)
    return _rows(observation, [s * e for s, e in zip(sigma, base.left_out, strict=True)])


def _rows(observation: Observation, left: list[np.ndarray]) -> Unseen:
    used = observation.used.T
    return Unseen(
        tuple(joint.name for joint in observation.joints),
        tuple(left),
        tuple(observation.torque[own, j] for j, own in enumerate(used)),
        tuple(observation.time[own] for own in used),
        tuple(observation.run[own] for own in used),
    )
