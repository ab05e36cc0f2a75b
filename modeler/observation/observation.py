"""The rows of y = W beta, and which is which."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from modeler.core.contract import JointSpec
from modeler.core.presented import Presented
from modeler.observation.motion import Segment
from modeler.observation.report import DataReport
from modeler.observation.stretch import Stretch


@dataclass(frozen=True, eq=False)
class Observation(Presented):
    """Filtered, decimated data of all logs: s samples, n joints, c base parameters.

    Attributes:
        robot: name.
        joints: order of the second axis below.
        names: (c,) base parameters, the columns.
        units: (c,) of the base parameters.
        logs: names of the logs.
        run: (s,) index into `logs`.
        segment: (s,) number of the uniform piece, unique over logs; never difference across it.
        time: (s,) s.
        q, qd, qdd: (s, n) motion, filtered alike.
        torque: (s, n) filtered torque, N m or N.
        used: (s, n) rows that count; the others are for pictures.
        stretches: full-rate data, for further columns.
        regressor: (b, n, c) at full rate, for the b samples of a segment in a window.
        report: what was done.
    """

    robot: str
    joints: tuple[JointSpec, ...]
    names: tuple[str, ...]
    units: tuple[str, ...]
    logs: tuple[str, ...]
    run: np.ndarray
    segment: np.ndarray
    time: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    torque: np.ndarray
    used: np.ndarray
    stretches: tuple[Stretch, ...]
    regressor: Callable[[Segment, slice], np.ndarray]
    report: DataReport

    @cached_property
    def columns(self) -> np.ndarray:
        """(s, n, c) filtered regressor: torque = columns beta + residual."""
        return self.filtered(self.regressor)

    @cached_property
    def W(self) -> np.ndarray:
        """(rows, c) observation matrix, joint after joint within each sample."""
        return self.columns[self.used]

    @cached_property
    def y(self) -> np.ndarray:
        """(rows,) torques, N m or N."""
        return self.torque[self.used]

    @cached_property
    def row_sample(self) -> np.ndarray:
        """(rows,) sample of each row."""
        return np.nonzero(self.used)[0]

    @cached_property
    def row_joint(self) -> np.ndarray:
        """(rows,) index of the joint of each row."""
        return np.nonzero(self.used)[1]

    @cached_property
    def row_run(self) -> np.ndarray:
        """(rows,) index of the log of each row."""
        return self.run[self.row_sample]

    def predicted(self, beta: np.ndarray) -> np.ndarray:
        """(s, n) torque of the model, filtered like the measurement: columns beta."""
        return self.columns @ beta

    def filtered(self, evaluate: Callable[[Segment, slice], np.ndarray]) -> np.ndarray:
        """Further columns (s, n, ...) through the same filter, row for row beside `columns`.

        Args:
            evaluate: (b, n, ...) for the b samples of a segment in a window.
        """
        return np.concatenate(
            [part.filtered(partial(evaluate, part.segment)) for part in self.stretches]
        )
