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
    kept = int(np.sum(singular > CERTAIN * singular[0]))
    return kept, singular[kept - 1], singular[kept] if kept < len(singular) else 0.0


@pytest.mark.parametrize("kind", WEIGHED)
def test_base_parameters_of_drawn_robots(kind: str) -> None:
    """The rank is that of the torques, and the base parameters give the same torques."""
    found = of_drawing(kind)
    assert found.base.proof.kind == "exact" or kind == NUMERIC
    oracle = Oracle(found.robot)
    home = np.array([found.robot.home[joint.name] for joint in found.robot.free_joints])
    u = reached(oracle, home, POSTURES, 1, REACH)
    qd, qdd = np.random.default_rng(2).normal(size=(2, len(u), oracle.n))
    torques = oracle.regressor(u, qd, qdd)
    W = np.stack([torques[name] for name in found.model.names], axis=2)
    W = W.reshape(-1, W.shape[2])
    count, kept, dropped = rank(W)
    assert count == found.base.rank
    assert kept > 1e3 * dropped
    base = W[:, [parameter.column for parameter in found.base.parameters]]
    size = np.linalg.norm(W, axis=0) / np.sqrt(len(W)) + 1e-4 * np.abs(W).max()
    K = build_grouping_matrix(found.model, found.base.parameters)
    assert np.all(np.abs(W - base @ K) < 1e-7 * size)
