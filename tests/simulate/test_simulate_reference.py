"""The commanded motion: smooth, within limits, lively, different for each seed."""

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.robot.robot import Limits
from modeler.simulation.trajectory import build_exciting_reference, build_one_joint_reference

LIMITS = (Limits(-1.5, 1.5, 2.0, 8.0), Limits(0.1, 0.3, 0.5, 3.0), Limits(-3.0, -1.0, 1.0, 20.0))


def check_limits(reference):
    for i, limit in enumerate(LIMITS):
        assert limit.lower < reference.q[:, i].min()
        assert reference.q[:, i].max() < limit.upper
        assert np.abs(reference.qd[:, i]).max() < limit.speed
        assert np.abs(reference.qdd[:, i]).max() < limit.acceleration


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("duration", [0.3, 4.0, 20.0])
def test_within_the_limits_and_at_rest_at_both_ends(seed, duration):
    reference = build_exciting_reference(LIMITS, duration, 500.0, seed)
    assert reference.q.shape == (round(duration * 500), 3)
    check_limits(reference)
    for end in (0, -1):
        np.testing.assert_allclose(reference.qd[end], 0, atol=1e-12)
        np.testing.assert_allclose(reference.qdd[end], 0, atol=1e-9)


def test_derivatives_are_those_of_the_positions_and_continuous():
    rate = 2000.0
    motion = build_exciting_reference(LIMITS, 12.0, rate, 0)
    for value, slope, scale in ((motion.q, motion.qd, 2.0), (motion.qd, motion.qdd, 8.0)):
        difference = (value[2:] - value[:-2]) * rate / 2
        assert np.abs(difference - slope[1:-1]).max() < 2e-3 * scale
    # A jump of the acceleration would show as a step that does not shrink with the sampling.
    coarse, fine = (
        np.abs(np.diff(build_exciting_reference(LIMITS, 12.0, r, 0).qdd, axis=0)).max()
        for r in (1000.0, 4000.0)
    )
    assert fine < 0.3 * coarse


def test_it_uses_the_range_and_several_speeds_both_ways():
    reference = build_exciting_reference(LIMITS, 20.0, 500.0, 1)
    for i, limit in enumerate(LIMITS):
        assert np.ptp(reference.q[:, i]) > 0.5 * (limit.upper - limit.lower)
        share = reference.qd[:, i] / limit.speed
        for low, high in ((0.02, 0.1), (0.1, 0.25), (0.25, 1.0)):
            for way in (1, -1):
                assert np.sum((way * share > low) & (way * share < high)) > 50


@pytest.mark.parametrize("ways", [np.eye(3), np.array([[1, -0.4, 0.2], [0, 1, -0.5], [0, 0, 1]])])
def test_one_joint_at_a_time(ways, seed=0):
    """Within the limits; most of the time at most one joint moves, each at several poses."""
    reference = build_one_joint_reference(LIMITS, 150.0, 200.0, seed, ways)
    check_limits(reference)
    difference = (reference.q[2:] - reference.q[:-2]) * 100.0
    assert np.abs(difference - reference.qd[1:-1]).max() < 2e-2
    joints = reference.qd @ np.linalg.inv(ways)
    moving = np.abs(joints) > 1e-9
    assert np.mean(moving.sum(axis=1) <= 1) > 0.8
    for i in range(3):
        alone = moving[:, i] & (moving.sum(axis=1) == 1)
        poses = np.delete(reference.q @ np.linalg.inv(ways), i, axis=1)[alone]
        assert len(np.unique(np.round(poses, 6), axis=0)) > 1


def test_seeds_and_times_that_are_too_short():
    first, again, other = (build_exciting_reference(LIMITS, 3.0, 500.0, s) for s in (1, 1, 2))
    assert np.array_equal(first.q, again.q)
    assert np.abs(first.q - other.q).max() > 0.01
    with pytest.raises(DataError, match=r"holds 1 samples .* expected at least 2"):
        build_exciting_reference(LIMITS, 0.001, 1000.0, 0)
    with pytest.raises(DataError, match="too short for one joint to move there and back"):
        build_one_joint_reference(LIMITS, 1.0, 200.0, 0)
