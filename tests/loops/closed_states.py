"""Closed states of a built-in robot, as its compiled model sees them."""

import numpy as np

from modeler.derivation.numeric_rank import random_states, regressor_values
from tests.modules import module


def closed(name: str, samples: int, seed: int = 5):
    """(q, qd, qdd) of the coordinates, (u, ud, udd), and phi of the standard columns there."""
    model = module(name).model
    free = random_states(model, samples, np.random.default_rng(seed))
    places = list(model.closure.given) if model.closure else list(range(free[0].shape[1]))
    return [x[:, places] for x in free], free, regressor_values(model, free)
