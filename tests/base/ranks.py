"""What any experiment could show at most: a rank that knows nothing of the grouping."""

import numpy as np

from modeler.derivation.numeric_rank import draw_random_states, evaluate_regressor


def seen(model) -> int:
    """Rank of the torques at random states, structural zeros recognised by size."""
    states = draw_random_states(model, 80, np.random.default_rng(11))
    W = evaluate_regressor(model, states).reshape(-1, len(model.columns))
    W = W[:, np.linalg.norm(W, axis=0) > 1e-12 * np.linalg.norm(W)]
    singular = np.linalg.svd(W / np.linalg.norm(W, axis=0), compute_uv=False)
    return int(np.sum(singular > 1e-9 * singular[0]))
