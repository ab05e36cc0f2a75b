"""Evidence of faults of logs: what a machine leaves of some rows, with a fault and with it undone.

Of the torques of joint j, e_j = ||tau_j - W_j beta|| / ||tau_j||, where beta is that of the
physically consistent parameters nearest to a fit in which every joint weighs 1 / e_j^2, so that
sum_j log e_j is least, or that of a model.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.estimation import physical_consistency
from modeler.estimation.gravity import ThinnedRows, thin_rows
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import solve_normal_equations
from modeler.regression import DataWarning, Observation
from modeler.runtime import CompiledModel


@dataclass(frozen=True, eq=False)
class NormalEquations:
    """Holds all that a fit of the rows of k joints needs, torques of length one.

    Attributes:
        gram: (k, c, c) X_j^T X_j.
        cross: (k, c) X_j^T y_j.
    """

    gram: np.ndarray
    cross: np.ndarray

    def scale_torques(self, places: int | Sequence[int], gain: float) -> "NormalEquations":
        """Returns the equations with the torques of some joints of the log multiplied by a gain."""
        gains = np.where(np.isin(np.arange(len(self.gram)), places), gain, 1.0)
        return NormalEquations(self.gram / gains[:, None, None] ** 2, self.cross / gains[:, None])

    def compute_errors(self, beta: np.ndarray) -> np.ndarray:
        """Returns (k,) relative error of each joint."""
        square = 1.0 - 2.0 * self.cross @ beta + np.einsum("c,kcd,d->k", beta, self.gram, beta)
        return np.asarray(np.sqrt(np.maximum(square, 0.0)))


def compute_lengths(y: np.ndarray) -> np.ndarray:
    """Returns (k,) norms of torques; none so small beside others that rows overflow."""
    length = np.linalg.norm(y, axis=0)
    return np.asarray(np.maximum(length, 1e-9 * length.max(initial=0.0) or 1.0))


def build_normal_equations(
    W: np.ndarray, tau: np.ndarray, used: np.ndarray, joints: Sequence[int]
) -> NormalEquations:
    """Returns those of rows W (m, n, c), tau (m, n), used (m, n)."""
    y = np.where(used, tau, 0.0)[:, joints]
    length = compute_lengths(y)
    X = (np.where(used[..., None], W, 0.0)[:, joints] / length[:, None]).transpose(1, 2, 0)
    return NormalEquations(X @ X.transpose(0, 2, 1), np.einsum("kcm,mk->kc", X, y / length))


@dataclass(frozen=True, eq=False)
class ResidualModel:
    """Describes what a machine leaves of torques.

    Attributes:
        machine: its parameters and their bounds.
        beta: (c,) of a model that predicts; None: each time it is fitted.
    """

    machine: physical_consistency.PhysicalParameters
    beta: np.ndarray | None = None

    def solve(self, data: NormalEquations) -> tuple[np.ndarray, np.ndarray]:
        """Returns beta (c,) and weights (k,) of least sum of the logarithms of the errors."""
        weights = np.ones(len(data.gram))
        if self.beta is not None:
            return self.beta, weights
        prior = np.einsum("kcc->c", data.gram) / THRESHOLDS.max_thinned_rows
        for _ in range(THRESHOLDS.fault_reweightings):
            gram, cross = np.tensordot(weights, data.gram, 1), weights @ data.cross
            beta = solve_normal_equations(gram, cross, prior)
            weights = 1.0 / np.maximum(data.compute_errors(beta), THRESHOLDS.min_error) ** 2
        return beta, weights

    def compute_errors(self, data: NormalEquations, possible: bool = True) -> np.ndarray:
        """Returns (k,) relative errors, of physically consistent parameters if requested."""
        beta, weights = self.solve(data)
        if possible and self.beta is None:
            beta = self.project_fit(data, beta, weights)
        return data.compute_errors(beta)

    def project_fit(
        self, data: NormalEquations, beta: np.ndarray, weights: np.ndarray
    ) -> np.ndarray:
        """Returns (c,) the nearest consistent parameters; the fit itself where none are found."""
        values, vectors = np.linalg.eigh(np.tensordot(weights, data.gram, 1))
        root = np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T
        nearest = physical_consistency.project_parameters(self.machine, beta, root)
        return beta if nearest is None else nearest.beta


def compute_log_error(errors: np.ndarray) -> float:
    """Returns the sum of the logarithms of relative errors (k,)."""
    return float(np.sum(np.log(np.maximum(errors, THRESHOLDS.min_error))))


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Describes a fault that a log may have.

    Attributes:
        fault: in words.
        data: of the log with the fault undone.
        joints: that it concerns; empty: all.
        min_evidence: by which it must lower the sum of logarithms, of the fit too.
        judge: of its columns, where they are not those of the robot.
        speed: of the motion, over that which was logged.
    """

    fault: DataWarning
    data: NormalEquations
    joints: tuple[int, ...] = ()
    min_evidence: float = THRESHOLDS.min_evidence
    judge: ResidualModel | None = None
    speed: float = 1.0


@dataclass(frozen=True, eq=False)
class Evidence:
    """Holds some rows of logs, and who judges them.

    Attributes:
        compiled: the robot.
        observation: of the logs.
        judge: of their torques.
        rows: some of them.
        joints: with a motor and a torque; none of too few rows.
    """

    compiled: CompiledModel
    observation: Observation
    judge: ResidualModel
    rows: ThinnedRows
    joints: tuple[int, ...]

    @cached_property
    def data(self) -> NormalEquations:
        """Returns the normal equations of the log as it is."""
        return self.build_equations(self.rows.W)

    @cached_property
    def errors(self) -> np.ndarray:
        """Returns the errors (k,) that the judge finds in the log as it is."""
        return self.judge.compute_errors(self.data)

    @cached_property
    def free_errors(self) -> np.ndarray:
        """Returns the errors (k,) that a fit leaves of the log as it is, of any parameters."""
        return self.judge.compute_errors(self.data, possible=False)

    @cached_property
    def has_large_errors(self) -> bool:
        """Returns True if much is left, or consistent parameters leave far more than the fit."""
        lost = compute_log_error(self.errors) - compute_log_error(self.free_errors)
        return (
            bool(self.errors.max() > THRESHOLDS.suspicious_error) or lost > THRESHOLDS.min_evidence
        )

    @cached_property
    def residual(self) -> np.ndarray:
        """Returns `predict_blocks` of the log as it is."""
        return self.predict_blocks(self.rows.W)

    @property
    def is_tree(self) -> bool:
        """Returns True without loops: positions that do not close loops have no torque."""
        return self.compiled.spec.closure is None

    def get_joint_name(self, place: int) -> str:
        """Returns the name of one of the joints."""
        return self.observation.joints[self.joints[place]].name

    def build_equations(
        self, W: np.ndarray, tau: np.ndarray | None = None, used: np.ndarray | None = None
    ) -> NormalEquations:
        """Builds the equations of W (m, n, c), with the measured torques or others (m, n)."""
        tau, used = self.rows.tau if tau is None else tau, self.rows.used if used is None else used
        return build_normal_equations(W, tau, used, self.joints)

    def predict_blocks(self, W: np.ndarray) -> np.ndarray:
        """Returns (blocks, k) squares of what fits of W (m, n, c) to the other blocks leave."""
        squares = []
        for block in np.array_split(np.arange(len(W)), THRESHOLDS.time_blocks):
            others = self.rows.used.copy()
            others[block] = False
            beta, _ = self.judge.solve(self.build_equations(W, used=others))
            left = self.normalize(self.rows.tau - W @ beta)
            squares.append(np.sum(left[block] ** 2, axis=0))
        return np.stack(squares)

    def normalize(self, torque: np.ndarray) -> np.ndarray:
        """Returns (m, k) the rows of torques (m, n) that count, over the length of the measured."""
        every = (np.where(self.rows.used, x, 0.0)[:, self.joints] for x in (torque, self.rows.tau))
        some, measured = every
        return np.asarray(some / compute_lengths(measured))


def gather_evidence(
    compiled: CompiledModel, observation: Observation, beta: np.ndarray | None = None
) -> Evidence:
    """Returns some rows of logs, of joints that have enough; beta (c,) of a model that judges."""
    rows = thin_rows(compiled, observation)
    joints = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    joints = [j for j in joints if rows.tau[rows.used[:, j], j].any()]
    least = THRESHOLDS.min_rows_each * rows.W.shape[2]
    if not joints or rows.used[:, joints].sum() < least:
        joints = []
    judge = ResidualModel(physical_consistency.define_physical_parameters(compiled.spec), beta)
    return Evidence(compiled, observation, judge, rows, tuple(joints))
