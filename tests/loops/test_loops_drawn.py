"""Base parameters of robots with loops drawn from a seed, against the oracle of complex steps."""

import numpy as np
import pytest

from modeler.derivation.numeric_rank import build_grouping_matrix
from tests.loops.derived import WEIGHED, of_drawing
from tests.oracles.closed_ways import reached
from tests.oracles.complex_step import Oracle

POSTURES, REACH = 80, 3.0
ZERO = 1e-11  # length of a column without effect, of the longest
CERTAIN = 1e-10  # singular value of what torques determine, of the largest
NUMERIC = "on_a_plane"


def rank(W: np.ndarray) -> tuple[int, float, float]:
    """Rank of (rows, columns) scaled to length 1, last singular value kept and first dropped."""
    lengths = np.linalg.norm(W, axis=0)
    W = W[:, lengths > ZERO * lengths.max()]
    singular = np.linalg.svd(W / np.linalg.norm(W, axis=0), compute_uv=False)
    subset = int(np.sum(singular > CERTAIN * singular[0]))
    return subset, singular[subset - 1], singular[subset] if subset < len(singular) else 0.0


@pytest.mark.parametrize("kind", WEIGHED)
def test_base_parameters_of_drawn_robots(kind: str) -> None:
    """The rank is that of the torques, and the base parameters give the same torques."""
    result = of_drawing(kind)
    assert result.base.proof.kind == "exact" or kind == NUMERIC
    oracle = Oracle(result.robot)
    home = np.array([result.robot.home[joint.name] for joint in result.robot.free_joints])
    u = reached(oracle, home, POSTURES, 1, REACH)
    qd, qdd = np.random.default_rng(2).normal(size=(2, len(u), oracle.n))
    torques = oracle.regressor(u, qd, qdd)
    W = np.stack([torques[name] for name in result.model.names], axis=2)
    W = W.reshape(-1, W.shape[2])
    count, subset, dropped = rank(W)
    assert count == result.base.rank
    assert subset > 1e3 * dropped
    base = W[:, [parameter.column for parameter in result.base.parameters]]
    size = np.linalg.norm(W, axis=0) / np.sqrt(len(W)) + 1e-4 * np.abs(W).max()
    K = build_grouping_matrix(result.model, result.base.parameters)
    assert np.all(np.abs(W - base @ K) < 1e-7 * size)
