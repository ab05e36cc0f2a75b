"""Logs that do not belong to one robot: each is described alone, and all together are not."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from modeler.estimate.compressed import Compressed, compress
from modeler.estimate.least_squares import least_squares
from modeler.fit.payload import Payload, loaded_equations
from modeler.observation import Observation

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

WORSE = 2.0
"""Ratio of what is left together to what is left alone from which on logs are not of one robot."""

_TELLS = 0.02  # of a joint's torque: less is left of it together than any two machines differ


def not_alike(
    model: "CompiledModel", observation: Observation, payloads: Sequence[Payload]
) -> list[str]:
    """A line if the logs are described alone, loaded ones with another last link, but not together.

    Together every log has the same base parameters, loads come beside them, and every load has its
    own mass; torques are taken as they are. The line names the joint where it shows most.

    Args:
        model: the robot.
        observation: of all logs.
        payloads: which of them carry what.
    """
    loaded = loaded_equations(model, observation, payloads)
    W = np.column_stack([loaded.equations.W, loaded.torques])
    every = np.ones(len(observation.y), dtype=bool)
    together = _left(observation, W, every) ** 2
    alone = np.zeros(len(together))
    for run in range(len(observation.logs)):
        alone += _left(observation, observation.W, observation.row_run == run) ** 2
    torque = _compressed(observation, W, every).torque_norms()
    felt = (torque > 0.0) & (together > (_TELLS * torque) ** 2)
    if not felt.any():
        return []
    ratio = np.where(felt, together / np.maximum(alone, 1e-300), 0.0)
    worst = int(np.argmax(ratio))
    if ratio[worst] < WORSE**2:
        return []
    apart, all_of_them = (
        100.0 * float(np.sqrt(v[worst])) / float(torque[worst]) for v in (alone, together)
    )
    return [
        f"the logs {', '.join(observation.logs)} do not fit one robot: joint "
        f"{observation.joints[worst].name} has {apart:.2g} % of its torque left if each is "
        f"described alone, and {all_of_them:.2g} % together; are all of the same robot, is the "
        "load on the link that is said to carry it, and does friction grow with the load?"
    ]


def _left(observation: Observation, W: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """(n,) norm of what a weighted fit of these rows leaves of each joint, N m or N.

    Raised by as much as the parameters lower it: few rows are described by many parameters.
    """
    if rows.sum() <= W.shape[1]:
        return np.full(len(observation.joints), np.inf)  # nothing can be said of so few
    data = _compressed(observation, W, rows)
    raised = float(np.sqrt(rows.sum() / (rows.sum() - W.shape[1])))
    return raised * data.residual_norms(least_squares(data).beta)


def _compressed(observation: Observation, W: np.ndarray, rows: np.ndarray) -> Compressed:
    return compress(
        W[rows],
        observation.y[rows],
        observation.row_joint[rows],
        len(observation.joints),
        [str(i) for i in range(W.shape[1])],
        [j for j, joint in enumerate(observation.joints) if not joint.actuated],
    )
