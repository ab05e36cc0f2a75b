"""The logs as the diagnosis sees them: the model's processing in a wider band."""

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING

from modeler.observation import Log, Observation, Processing, observe

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

BAND = 30.0
"""Hz: cut-off of the parallel filter of a diagnosis, if the position filter leaves that much.

Fits use a narrow band, where torque noise is least; ripple, elasticity, delays and reversals show
above it."""


def analysis_processing(fitted: Processing) -> Processing:
    """That of the fit with the wider band."""
    position = fitted.position_cutoff or BAND
    narrow = fitted.parallel_cutoff or 0.0
    return dataclasses.replace(
        fitted, parallel_cutoff=max(narrow, min(BAND, 0.8 * position)), decimation=None
    )


def analysed(
    compiled: "CompiledModel", logs: Sequence[Log], fitted: Processing, chosen: bool = False
) -> Observation:
    """The observation of a diagnosis.

    Args:
        compiled: the robot.
        logs: to look at.
        fitted: processing of the fit.
        chosen: True if `fitted` is that of a diagnosis already.
    """
    processing = fitted if chosen else analysis_processing(fitted)
    return observe(compiled, logs, processing, every_joint=True)
