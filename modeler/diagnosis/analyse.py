"""The logs as the diagnosis sees them: the model's processing in a wider band."""

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from modeler.observation.log import Log
from modeler.observation.observation import Observation, observe, observed
from modeler.observation.prepare import Mending, Prepared
from modeler.observation.settings import Processing

if TYPE_CHECKING:
    from modeler.runtime.model import CompiledModel

BAND = 30.0
"""Hz: cut-off of the parallel filter of a diagnosis, if the position filter leaves that much.

Fits use a narrow band, where torque noise is least; ripple, elasticity, delays and reversals show
above it."""

COMPLETE = 0.95
"""Least share of a row's weights on usable samples."""


def analysis_processing(fitted: Processing) -> Processing:
    """That of the fit with the wider band; a parallel filter that was given rules both."""
    position = fitted.position_cutoff or BAND
    cutoff = fitted.parallel_cutoff or 0.0
    if "parallel_cutoff" in fitted.chosen:
        cutoff = max(cutoff, min(BAND, 0.8 * position))
    return dataclasses.replace(fitted, parallel_cutoff=cutoff, decimation=None)


def bands_line(fitted: Processing, seen: Processing) -> list[str]:
    """A sentence on the band of a diagnosis where it is not that of the fit."""
    if seen.parallel_cutoff == fitted.parallel_cutoff:
        return []
    return [
        f"errors and values are those up to {seen.parallel_cutoff:g} Hz, beside all effects "
        f"named; `modeler fit` and `add` fit up to {fitted.parallel_cutoff:g} Hz: ripple, "
        "elasticity, delays and reversals show above; fit with --parallel-cutoff "
        f"{fitted.parallel_cutoff:g} to have both alike"
    ]


def analysed(
    compiled: "CompiledModel", logs: Sequence[Log], fitted: Processing, chosen: bool = False,
    prepared: Prepared | None = None, mending: Mending | None = None,
) -> Observation:  # fmt: skip
    """The observation of a diagnosis.

    Args:
        compiled: the robot.
        logs: to look at.
        fitted: processing of the fit.
        chosen: True if `fitted` is that of a diagnosis already.
        prepared: the logs as `fitted` prepares them; the motion is the same in the wider band,
            unless derivatives were logged, which are checked in the band of the rows.
        mending: of the same logs, where it is shared.
    """
    processing = fitted if chosen else analysis_processing(fitted)
    if prepared is not None and all(check is None for check in prepared.checks):
        band, every = processing.parallel_cutoff or 0.0, processing.decimation
        wide = dataclasses.replace(prepared.processing, parallel_cutoff=band, decimation=every)
        wider = dataclasses.replace(prepared, processing=wide)
        return _whole(observed(compiled, logs, wider, every_joint=True))
    return _whole(observe(compiled, logs, processing, True, mending))


def _whole(observation: Observation) -> Observation:
    """Only rows whose weights lie on usable samples all but wholly.

    A row at the edge of a masked reversal is the mean of few samples, and what the filter makes of
    the sign of a speed there looks like physics.
    """
    stretches = tuple(
        dataclasses.replace(part, used=part.used & (part.rows.share(part.usable) >= COMPLETE))
        for part in observation.stretches
    )
    used = np.concatenate([part.used for part in stretches])
    if not used.any():
        return observation
    return dataclasses.replace(observation, used=used, stretches=stretches)
