"""What a model leaves of motion that it was not fitted to."""

import numpy as np

from modeler.compiled import CompiledModel
from modeler.fit import IdentifiedModel
from modeler.hypotheses.blocks import blocks_of
from modeler.observation import Observation
from modeler.observation.torque import model_torque
from modeler.scoring.gram import base_of, pieces
from modeler.scoring.score import Unseen


def left_of(model: IdentifiedModel, compiled: CompiledModel, observation: Observation) -> Unseen:
    """What it leaves of logs."""
    left = observation.torque - model_torque(observation, compiled, model.beta)
    return _rows(observation, [left[own, j] for j, own in enumerate(observation.used.T)])


def left_out(model: IdentifiedModel, observation: Observation) -> Unseen:
    """What it leaves of its own logs, each eighth predicted from a fit to the others."""
    used = observation.used.T
    W = [observation.columns[own, j] for j, own in enumerate(used)]
    y = [observation.torque[own, j] for j, own in enumerate(used)]
    blocks = blocks_of(observation)
    number = [blocks.number[own] for own in used]
    sigma = np.array([joint.sigma if joint.sigma > 0.0 else 1.0 for joint in model.fit.joints])
    base = base_of(W, y, sigma, number, blocks.fold)
    crossed, left = base.crossed, []
    for j, own in enumerate(number):
        predicted = np.zeros(len(own))
        for b, rows in pieces(own):
            predicted[rows] = base.columns[j][rows] @ crossed.beta[crossed.place[b]]
        left.append(y[j] - sigma[j] * predicted)
    return _rows(observation, left)


def _rows(observation: Observation, left: list[np.ndarray]) -> Unseen:
    used = observation.used.T
    return Unseen(
        tuple(joint.name for joint in observation.joints),
        tuple(left),
        tuple(observation.torque[own, j] for j, own in enumerate(used)),
        tuple(observation.time[own] for own in used),
        tuple(observation.run[own] for own in used),
    )
