"""What an estimator is given."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.errors import DataError
from modeler.estimate.compressed import Compressed
from modeler.observation import Observation
from modeler.observation.passing import is_streamed

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel


@dataclass(frozen=True, eq=False)
class Problem:
    """y = W beta + rho, row for row those of an observation; c columns.

    Attributes:
        observation: says which row is which joint and sample, and holds the motion.
        given: (rows, c) W; None: that of the observation.
        y: (rows,) N m or N.
        counted: (rows,) rows to fit; the others are of joints without a torque.
        names: (c,) base parameters first, then those of loads.
        units: (c,).
        data: the counted rows, compressed.
        model: the compiled robot; None where nobody gave it.
    """

    observation: Observation
    given: np.ndarray | None
    y: np.ndarray
    counted: np.ndarray
    names: tuple[str, ...]
    units: tuple[str, ...]
    data: Compressed
    model: "CompiledModel | None" = None

    @property
    def W(self) -> np.ndarray:
        """(rows, c)."""
        return self.observation.W if self.given is None else self.given

    @property
    def streamed(self) -> bool:
        """True if W is better not asked for: it is large."""
        return self.given is None and is_streamed(self.observation)

    @property
    def joint(self) -> np.ndarray:
        """(rows,) index of the joint of each row."""
        return self.observation.row_joint

    def robot(self, method: str) -> "CompiledModel":
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
