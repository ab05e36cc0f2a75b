"""Closed states of a built-in robot, as its compiled model sees them."""

import numpy as np

from modeler.derivation.numeric_rank import draw_random_states, evaluate_regressor
from tests.modules import module


def closed(name: str, samples: int, seed: int = 5):
    """(q, qd, qdd) of the coordinates, (u, ud, udd), and phi of the standard columns there."""
    model = module(name).model
    free = draw_random_states(model, samples, np.random.default_rng(seed))
    places = list(model.closure.actuated) if model.closure else list(range(free[0].shape[1]))
    return [x[:, places] for x in free], free, evaluate_regressor(model, free)
