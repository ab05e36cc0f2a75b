"""The cube that the Orthoglide is built for, and the choice of ten motions."""

import itertools

import numpy as np
import pytest
from scipy.optimize import brentq

from modeler.papers import guegan

D, STRAIGHT = 0.31, 0.19


def motors(p):
    """Bars hold the platform on spheres."""
    return np.array(
        [STRAIGHT + p[i] + D - np.sqrt(D**2 - p[i - 1] ** 2 - p[i - 2] ** 2) for i in range(3)]
    )


def speeds(p, h=1e-6):
    """Singular values of J_p: the platform's speeds over the motors', by differences."""
    slopes = [(motors(p + h * e) - motors(p - h * e)) / (2 * h) for e in np.eye(3)]
    return 1.0 / np.linalg.svd(np.array(slopes).T, compute_uv=False)


def test_the_platform_is_half_to_twice_as_fast_over_the_cube():
    lower, upper = guegan.compute_cube_range(D, STRAIGHT)
    low = lower - STRAIGHT
    high = brentq(lambda t: motors(np.full(3, t))[0] - upper, 0.0, 0.2)
    assert high - low == pytest.approx(0.2, abs=1e-3)  # the Orthoglide's cube
    corners = np.array(list(itertools.product((low, high), repeat=3)))
    inside = np.random.default_rng(5).uniform(low, high, (100, 3))
    every = np.concatenate([speeds(p) for p in [*corners, *inside]])
    assert every.min() == pytest.approx(0.5, abs=1e-4)
    assert every.max() == pytest.approx(2.0, abs=1e-4)
    travelled = np.concatenate([motors(p) for p in [*corners, *inside, np.array([low, 0, 0])]])
    assert travelled.min() == pytest.approx(lower, abs=1e-6)
    assert travelled.max() == pytest.approx(upper, abs=1e-6)


def test_the_choice_finds_motions_that_excite_what_others_leave():
    """Twenty alike that hardly show one parameter, and two that show it: both are taken."""
    rng = np.random.default_rng(11)
    W = rng.normal(size=(22, 50, 3)) * [1.0, 1.0, 1e-4]
    W[[4, 17], :, 2] = rng.normal(size=(2, 50))
    every = np.einsum("nri,nrj->nij", W, W)
    wanted = guegan._compute_condition_number(
        every[[4, 17]].sum(axis=0) + every[:8].sum(axis=0) - every[4]
    )
    start = np.array([k for k in range(22) if k not in (4, 17)][: guegan.RUNS])
    result = guegan._exchange_motions(every, start)
    assert result < 1.5 * wanted < 0.01 * guegan._compute_condition_number(every[start].sum(axis=0))
