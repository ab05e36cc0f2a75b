"""Fits to all blocks of time but one: what they predict of it, with a weak prior on the torque."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.json import ShortRepr
from modeler.regression.log import Log
from modeler.regression.observation import ModelRegressor, Observation
from modeler.regression.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class BlockSums(ShortRepr):
    """Normal equations of rows by joint and block of time; J joints, B blocks.

    Attributes:
        gram: (J, B, c, c) W^T W.
        cross: (J, B, c) W^T y.
        squares: (J, B) y^T y.
        count: (J, B) rows.
        prior: (c,) weights of the torque prior.
    """

    gram: np.ndarray
    cross: np.ndarray
    squares: np.ndarray
    count: np.ndarray
    prior: np.ndarray

    @cached_property
    def solutions(self) -> np.ndarray:
        """Returns (B, c) the weighted fit to all blocks but one, each in turn."""
        return np.stack([self._solve_without(b) for b in range(self.count.shape[1])])

    def _solve_without(self, block: int) -> np.ndarray:
        others = np.arange(self.count.shape[1]) != block
        gram, cross = self.gram[:, others].sum(axis=1), self.cross[:, others].sum(axis=1)
        squares, count = (x[:, others].sum(axis=1) for x in (self.squares, self.count))
        driven = np.flatnonzero(squares > 0.0)
        gram, cross, squares, count = (x[driven] for x in (gram, cross, squares, count))
        least, beta = 1e-12 * squares, np.zeros(gram.shape[-1])
        left = squares
        for _ in range(THRESHOLDS.block_reweightings):
            weight = count / np.maximum(left, least)
            whole = np.diag(self.prior**2) + np.tensordot(weight, gram, 1)
            size = np.sqrt(np.diag(whole))
            size[size == 0.0] = 1.0
            right, tolerance = weight @ cross / size, THRESHOLDS.block_tolerance
            scaled = whole / np.outer(size, size)
            beta = np.linalg.lstsq(scaled, right, rcond=tolerance)[0] / size
            left = squares - 2.0 * cross @ beta + np.einsum("c,jcd,d->j", beta, gram, beta)
        return beta

    def compute_log_errors(self, solutions: np.ndarray) -> np.ndarray:
        """Returns (J, B) log rms of y - W beta, beta (B, c) that of the block; nan without rows."""
        linear = np.einsum("jbc,bc->jb", self.cross, solutions)
        square = np.einsum("bc,jbcd,bd->jb", solutions, self.gram, solutions, optimize=True)
        least = np.maximum(1e-12 * self.squares, 1e-300)
        left = np.maximum(self.squares - 2.0 * linear + square, least)
        enough = (self.count > THRESHOLDS.min_curvature_rows) & (self.squares > 0.0)
        return np.where(enough, 0.5 * np.log(left / np.maximum(self.count, 1)), np.nan)


def number_blocks(rows: Observation, logs: Sequence[Log]) -> np.ndarray:
    """Returns (s,) block of each sample: a fifth of the time of all logs, one after the other."""
    spans = np.array([log.span for log in logs])
    lengths = spans[:, 1] - spans[:, 0]
    before = np.cumsum(lengths) - lengths
    since = before[rows.run] + rows.time - spans[rows.run, 0]
    blocks = THRESHOLDS.time_blocks
    return np.clip(blocks * since / max(float(lengths.sum()), 1e-300), 0, blocks - 1).astype(int)


def sum_blocks(rows: Observation, block: np.ndarray, prior: np.ndarray) -> BlockSums:
    """Returns the normal equations of an observation; joints without a torque have no rows.

    Args:
        rows: all that it has, in memory.
        block: (s,) of each sample.
        prior: (c,) of `compute_prior_weights`.
    """
    used = rows.used & np.isin(range(len(rows.joints)), rows.driven)
    W = [rows.columns[part, j] for j, part in enumerate(used.T)]
    y = [rows.torque[part, j] for j, part in enumerate(used.T)]
    blocks = [block[part] for part in used.T]
    return sum_joint_rows(W, y, blocks, prior)


def sum_joint_rows(
    W: Sequence[np.ndarray], y: Sequence[np.ndarray], block: Sequence[np.ndarray], prior: np.ndarray
) -> BlockSums:
    """Returns the normal equations of rows W_j (rows_j, c), y_j and their blocks of each joint.

    Args:
        W: rows of each joint.
        y: their torques.
        block: from 0 on, of each row.
        prior: (c,) of `compute_prior_weights`.
    """
    every = [[part == b for b in range(THRESHOLDS.time_blocks)] for part in block]
    rows = list(zip(W, y, every, strict=True))
    gram = [[w[some].T @ w[some] for some in of] for w, _, of in rows]
    cross = [[w[some].T @ t[some] for some in of] for w, t, of in rows]
    squares = [[float(t[some] @ t[some]) for some in of] for _, t, of in rows]
    count = [[int(some.sum()) for some in of] for of in every]
    return BlockSums(np.array(gram), np.array(cross), np.array(squares), np.array(count), prior)


def predict_left_out(rows: Observation, logs: Sequence[Log]) -> np.ndarray:
    """Returns (s, n) torque less what a weighted fit to other blocks of time predicts; or nan."""
    block = number_blocks(rows, logs)
    solutions = sum_blocks(rows, block, compute_prior_weights(rows)).solutions
    residual = rows.torque - np.einsum("snc,sc->sn", rows.columns, solutions[block])
    return np.where(rows.used, residual, np.nan)


# What a machine has shown of its torques: no parameter makes more.


def compute_prior_weights(observation: Observation) -> np.ndarray:
    """Returns (c,) w_i / tau_i of the prior beta_i ~ N(0, (tau_i / w_i)^2) of base parameters.

    Alone, in a motion of all joints as lively as that of the liveliest one, a parameter makes about
    the torque tau that its joint has shown, w_i the rms of its column there. It weighs as much as
    one row whose error is the whole torque: what the logs determine stays as it is, and what the
    motion does not show stays small. 0 where no compiled robot says what a motion would show,
    and for a robot with joints without motors, in which larger torques cancel.
    """
    regressor, weights = observation.regressor, np.zeros(len(observation.names))
    squares = np.sum(np.where(observation.used, observation.torque, 0.0) ** 2, axis=0)
    torque = np.sqrt(squares / np.maximum(observation.used.sum(axis=0), 1))
    has_motors = all(joint.actuated for joint in observation.joints)  # else torques cancel unseen
    if not isinstance(regressor, ModelRegressor) or not torque.any() or not has_motors:
        return weights
    motion = _enliven_motion(observation, regressor.is_tree)
    columns = np.sqrt(np.mean(regressor.evaluate_motion(*motion) ** 2, axis=0))
    columns[torque == 0.0] = 0.0
    return columns.max(axis=0) / np.where(torque > 0.0, torque, 1.0)[columns.argmax(axis=0)]


def _enliven_motion(
    observation: Observation, is_tree: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns q, qd, qdd (m, n) in which every joint moves like the liveliest of its unit.

    Where all of them rest, by 1 rad, rad/s, rad/s^2, of slides a tenth of it in metres; a closed
    loop stays in its postures.
    """
    places = np.linspace(0, len(observation.time) - 1, THRESHOLDS.prior_postures).astype(int)
    q, qd, qdd = (x[places] for x in (observation.q, observation.qd, observation.qdd))
    units = np.array([joint.unit for joint in observation.joints])
    speed, random = np.sum(qd**2, axis=0), np.random.default_rng(0)
    lively = [int(np.argmax(np.where(units == unit, speed, -1.0))) for unit in units]
    least = np.where(units == "rad", 1.0, THRESHOLDS.slide_share) * THRESHOLDS.prior_motion
    moved, travel = [], np.std(q[:, lively], axis=0)
    least = np.where(travel < THRESHOLDS.rest_share * least, least, 0.0)
    for values in (q - q.mean(axis=0), qd, qdd):
        size = np.sqrt(np.mean(values[:, lively] ** 2, axis=0))
        unit_motion = random.permuted(values[:, lively] / np.maximum(size, 1e-300), axis=0)
        still = random.standard_normal(unit_motion.shape)
        moved.append(np.where(size > 0.0, unit_motion, still) * np.maximum(size, least))
    return q.mean(axis=0) + moved[0] if is_tree else q, moved[1], moved[2]
