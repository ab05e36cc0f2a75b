"""The rows of an observation without W: compressed, explained, and beside their neighbours."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.errors import DataError
from modeler.numerics.least_squares import Compressed
from modeler.observation import Evaluated, Observation, blocks, fitted_torque, is_streamed, products
from modeler.runtime import CompiledModel

_PRODUCTS = 8  # lags up to which products of rows are cheaper than the rows times a matrix


def residual_of(
    observation: Observation, beta: np.ndarray, counted: np.ndarray | None = None
) -> np.ndarray:
    """y - W beta of the base parameters, for all rows or those that are counted (rows,)."""
    keep = observation.used if counted is None else kept_rows(observation, counted)
    return np.asarray((observation.torque - fitted_torque(observation, beta, keep))[keep])


class Neighbours:
    """Rows of the base parameters that are counted, beside those before them in their segment.

    Attributes:
        observation: of the rows.
        keep: (s, n) True where they are counted.
    """

    def __init__(self, observation: Observation, counted: np.ndarray) -> None:
        self.observation, self.keep = observation, kept_rows(observation, counted)
        # Of rows up to so far apart; kept, as most fits ask twice.
        self._products: tuple[list[int], list[np.ndarray] | None] | None = None

    def repeated(self, matrices: Sequence[np.ndarray], r: Sequence[np.ndarray]) -> np.ndarray:
        """(k, k) sum_j sum_l r_j(l) sum_t a_j(t) a_j(t + l)^T and its transpose; l = 1, 2, ...

        a_j(t) = w_j(t) A_j, w_j(t) the row of joint j at sample t, 0 where it is not counted.

        Args:
            matrices: A_j (c, k) of each joint.
            r: r_j(0), r_j(1), ... of each joint; one value and no more for a joint to leave out.
        """
        last = [len(own) - 1 for own in r]
        found = None
        if max(last) <= _PRODUCTS:
            if self._products is None or np.any(np.array(last) > self._products[0]):
                self._products = last, products(self.observation, self.keep, last)
            found = self._products[1]
        if found is None:
            return _by_blocks(self.observation, self.keep, matrices, r)
        total = np.zeros((matrices[0].shape[1],) * 2)
        for j, own in enumerate(found):
            A = matrices[j][_columns(self.observation, j)]
            for weight, product in zip(r[j][1:], own, strict=False):
                total += weight * (A.T @ product @ A)
        return total + total.T


def kept_rows(observation: Observation, counted: np.ndarray) -> np.ndarray:
    """(s, n) True for the rows that are counted (rows,)."""
    keep = np.zeros(observation.used.shape, dtype=bool)
    keep[observation.used] = counted
    return keep


def _columns(observation: Observation, joint: int) -> np.ndarray:
    """Columns that can differ from 0 in the rows of a joint."""
    regressor = observation.regressor
    if isinstance(regressor, Evaluated):
        return regressor.pattern.columns[joint]
    return np.arange(len(observation.names))


def _by_blocks(
    observation: Observation,
    keep: np.ndarray,
    matrices: Sequence[np.ndarray],
    r: Sequence[np.ndarray],
) -> np.ndarray:
    """As `Neighbours.repeated`, from the columns of samples, and the last rows before them."""
    k, longest = matrices[0].shape[1], max(len(own) - 1 for own in r)
    total = np.zeros((k, k))
    before: list[np.ndarray] = []
    own_columns = [_columns(observation, j) for j in range(len(r))]
    at = -1
    for samples, columns in blocks(observation):
        if observation.segment[samples.start] != at:
            before = [np.zeros((longest, k))] * len(r)
        at = int(observation.segment[samples.start])
        for j, correlation in enumerate(r):
            if len(correlation) < 2:
                continue
            own = own_columns[j]
            now = (columns[:, j, own] * keep[samples, j, None]) @ matrices[j][own]
            rows = np.concatenate([before[j], now])
            for lag, weight in enumerate(correlation[1:], start=1):
                earlier = rows[longest - lag : len(rows) - lag]
                total += weight * (earlier.T @ now)
            before[j] = rows[len(rows) - longest :]
    return total + total.T


# What an estimator is given.


@dataclass(frozen=True, eq=False)
class Rows:
    """Row for row those of an observation; c columns.

    Attributes:
        observation: says which row is which joint and sample, and holds the motion.
        given: (rows, c) W; None: that of the observation.
        y: (rows,) N m or N.
        counted: (rows,) rows to fit; the others are of joints without a torque.
    """

    observation: Observation
    given: np.ndarray | None
    y: np.ndarray
    counted: np.ndarray

    @property
    def W(self) -> np.ndarray:
        """(rows, c)."""
        return self.observation.W if self.given is None else self.given

    @property
    def streamed(self) -> bool:
        """True if W is better not asked for: it is large."""
        return self.given is None and is_streamed(self.observation)

    @cached_property
    def neighbours(self) -> Neighbours:
        """The rows where W is not asked for."""
        return Neighbours(self.observation, self.counted)

    @property
    def joint(self) -> np.ndarray:
        """(rows,) index of the joint of each row."""
        return self.observation.row_joint

    def residual(self, beta: np.ndarray) -> np.ndarray:
        """(rows,) y - W beta."""
        if self.streamed:
            return residual_of(self.observation, beta)
        return np.asarray(self.y - self.W @ beta)


@dataclass(frozen=True, eq=False)
class Problem(Rows):
    """y = W beta + rho.

    Attributes:
        names: (c,) base parameters first, then those of loads.
        data: the counted rows, compressed.
        model: the compiled robot; None where nobody gave it.
    """

    names: tuple[str, ...]
    data: Compressed
    model: CompiledModel | None = None

    def scattered(self, kept: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(rows, c) of values (counted rows, kept columns); 0 elsewhere."""
        every = np.zeros((len(self.y), len(self.names)))
        every[np.ix_(self.counted, kept)] = values
        return every

    def robot(self, method: str) -> CompiledModel:
        """The compiled robot, for an estimator that cannot do without it.

        Raises:
            DataError: it was not given, or there are loads beside it.
        """
        if self.model is None:
            raise DataError(
                f'method "{method}" evaluates the robot; got no compiled model; give it as '
                "identify(observation, method, model)"
            )
        if len(self.names) != len(self.observation.names):
            extra = ", ".join(self.names[len(self.observation.names) :])
            raise DataError(
                f'method "{method}" knows the columns of the bare robot only; got {extra} besides; '
                'fit logs without a load, or use method "weighted"'
            )
        return self.model
