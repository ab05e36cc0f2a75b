"""All that contradicts in the data of a fit or of a prediction, the gravest first."""

from typing import TYPE_CHECKING

import numpy as np

from modeler.observation.adapted import faults_of_fit
from modeler.observation.channels import Fault, faults
from modeler.observation.late_channels import late_channels
from modeler.observation.observation import Observation

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel


def findings_of_fit(
    compiled: "CompiledModel", observation: Observation, beta: np.ndarray
) -> tuple[Fault, ...]:
    """Doubts about the channels and the samples of logs that a model was fitted to.

    Args:
        compiled: the robot.
        observation: that was fitted.
        beta: (c,) base parameters of the fit.
    """
    found = faults_of_fit(compiled, observation, beta)
    if not found:
        found = tuple(Fault(line, False) for line in late_channels(compiled, observation))
    return (*found, *_of_logs(observation))


def findings_of_prediction(
    compiled: "CompiledModel", observation: Observation, beta: np.ndarray
) -> tuple[Fault, ...]:
    """Doubts about the channels and the samples of logs whose torque a model predicts.

    Args:
        compiled: the robot.
        observation: of the logs.
        beta: (c,) base parameters of the model.
    """
    return (*faults(compiled, observation, beta), *_of_logs(observation))


def _of_logs(observation: Observation) -> tuple[Fault, ...]:
    return tuple(Fault(line, False) for line in observation.report.doubts())
