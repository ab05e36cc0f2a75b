"""The torque of a model over the samples of an observation, through the filter of its rows."""

from typing import TYPE_CHECKING

import numpy as np

from modeler.observation.motion import Segment
from modeler.observation.observation import Observation
from modeler.observation.signals import signals_of

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel


def model_torque(
    observation: Observation,
    model: "CompiledModel",
    beta: np.ndarray,
    turn: np.ndarray | None = None,
) -> np.ndarray:
    """(s, n) `observation.predicted(beta)` without its columns, by the inverse dynamics.

    Args:
        observation: of the robot.
        model: it, or one with other effects on the same joints.
        beta: (c,) base parameters of the model.
        turn: (n, n) if given, the motion is q turn instead of q.
    """

    def torque(segment: Segment, window: slice) -> np.ndarray:
        read = signals_of(model.spec, segment)
        q, qd, qdd = (x[window] for x in (segment.q, segment.qd, segment.qdd))
        if turn is not None:
            q, qd, qdd = q @ turn, qd @ turn, qdd @ turn
        return model.inverse_dynamics(q, qd, qdd, beta, None if read is None else read[window])

    return observation.filtered(torque)
