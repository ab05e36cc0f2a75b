"""The fit of an effect with given shapes, beside all else that a model has."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.hypotheses.blocks import blocks_of
from modeler.hypotheses.candidates import Candidate, JointScale
from modeler.hypotheses.orthonormal import orthonormal
from modeler.hypotheses.rows import Columns, Rows
from modeler.observation import Observation


@dataclass(frozen=True, eq=False)
class Point:
    """One set of shapes, and the fit with it.

    Attributes:
        shapes: values by name, SI.
        squares: S, weighted.
        values: (k,) parameters of the effect.
        deviations: (k,) theirs, for white residuals of variance 1.
        others: (c,) the other parameters.
        weight: of its cell among the shapes; not the likelihood.
    """

    shapes: Mapping[str, float]
    squares: float
    values: np.ndarray
    deviations: np.ndarray
    others: np.ndarray
    weight: float = 1.0


@dataclass(frozen=True, eq=False)
class Problem:
    """What a profile is made from; J joints.

    Attributes:
        rows: where columns come from.
        observation: the rows' samples and segments.
        others: (rows_j, c) by joint: columns of all else.
        y: (rows_j,) by joint.
        sigma: (J,) rms residual with the effect in.
        scale: what is large on its joint.
    """

    rows: Rows
    observation: Observation
    others: Sequence[np.ndarray]
    y: Sequence[np.ndarray]
    sigma: np.ndarray
    scale: JointScale

    @cached_property
    def block(self) -> np.ndarray:
        """(samples,) number of the block of time of each sample."""
        return blocks_of(self.observation).number

    @cached_property
    def base(self) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
        """Orthonormal weighted columns of all else by joint, and (c, r): columns = W turn."""
        return orthonormal(self.others, self.sigma)

    @cached_property
    def target(self) -> tuple[tuple[np.ndarray, ...], np.ndarray, float]:
        """Weighted y by joint, its products with the base, and what the base leaves of y.y."""
        scaled = tuple(t / s for t, s in zip(self.y, self.sigma, strict=True))
        u = sum(q.T @ t for q, t in zip(self.base[0], scaled, strict=True))
        return scaled, np.asarray(u), float(sum(t @ t for t in scaled) - u @ u)

    def weighted(self, columns: Columns) -> tuple[np.ndarray, ...]:
        """(rows_j, k) by joint, divided by sigma; zeros where there are none."""
        size = next(c.shape[1] for c in columns if c is not None)
        return tuple(
            np.zeros((len(t), size)) if c is None else c / s
            for c, t, s in zip(columns, self.y, self.sigma, strict=True)
        )

    def at(self, candidate: Candidate) -> Point | None:
        """The fit with these shapes; None where the columns cannot be told from all else."""
        columns = self.rows.columns(candidate)
        if not all(c is None or np.isfinite(c).all() for c in columns):
            return None
        if all(c is None for c in columns):
            return None
        y, u, left = self.target
        felt = [j for j, c in enumerate(columns) if c is not None]
        own = [np.asarray(columns[j]) / self.sigma[j] for j in felt]
        T = sum(self.base[0][j].T @ c for j, c in zip(felt, own, strict=True))
        M = sum(c.T @ c for c in own) - T.T @ T
        h = sum(c.T @ y[j] for j, c in zip(felt, own, strict=True)) - T.T @ u
        length = np.sqrt(sum(np.sum(c**2, axis=0) for c in own))
        if not (length > 0.0).all():
            return None
        inverse = np.linalg.pinv(M / np.outer(length, length), rcond=1e-9, hermitian=True)
        inverse = inverse / np.outer(length, length)
        values = inverse @ h
        others = self.base[1] @ (u - T @ values)
        deviations = np.sqrt(np.maximum(np.diag(inverse), 0.0))
        return Point(dict(candidate.shapes), left - float(h @ values), values, deviations, others)

    def off(self, columns: Sequence[np.ndarray]) -> np.ndarray:
        """(rows of all joints, k) what all else leaves of weighted columns."""
        T = sum(q.T @ c for q, c in zip(self.base[0], columns, strict=True))
        return np.concatenate([c - q @ T for q, c in zip(self.base[0], columns, strict=True)])

    def by_joint(self) -> Iterator[tuple[slice, np.ndarray]]:
        """Where the rows of each joint stand among all, and their samples."""
        first = 0
        for j, y in enumerate(self.y):
            yield slice(first, first + len(y)), np.flatnonzero(self.observation.used[:, j])
            first += len(y)
