"""Ordinary least squares whose sigmas know that joints are not alike."""

import dataclasses

import numpy as np

from modeler.estimate.least_squares import Estimate, Influence, least_sigma, least_squares
from modeler.estimate.passing import residual_of
from modeler.estimate.problem import Problem


def ordinary(problem: Problem) -> Estimate:
    """min |y - W beta|^2; covariance A^-1 (sum_j s_j^2 W_j^T W_j) A^-1, A = W^T W.

    s_j^2 = |r_j|^2 / (rows_j - h_j) of joint j, h_j = trace(A^-1 W_j^T W_j). The textbook's
    sigma^2 A^-1 holds where all s_j are one sigma (White 1980, Econometrica 48(4)); a quiet wrist
    beside a loud shoulder then has sigmas that are too large, and the shoulder too small ones.

    Args:
        problem: beta in the units of its columns, y N m or N.
    """
    data = problem.data
    found = least_squares(data, "ordinary")
    bread = found.covariance / found.sigma[0] ** 2
    own = data.triangles[:, :, :-1]
    squares = np.einsum("jik,jil->jkl", own, own)
    share = np.einsum("kl,jlk->j", bread, squares)
    spread = data.residual_norms(found.beta) / np.sqrt(np.maximum(data.rows - share, 0.5))
    spread = np.maximum(spread, least_sigma(data))
    middle = np.einsum("j,jkl->kl", spread**2, squares)
    return dataclasses.replace(
        found,
        covariance=bread @ middle @ bread,
        influence=_influence(problem, found.beta, bread),
    )


def _influence(problem: Problem, beta: np.ndarray, bread: np.ndarray) -> Influence:
    if problem.streamed:
        residual = problem.y - problem.observation.y + residual_of(problem.observation, beta)
        return Influence(None, residual, bread)
    return Influence(problem.W @ bread * problem.counted[:, None], problem.y - problem.W @ beta)
