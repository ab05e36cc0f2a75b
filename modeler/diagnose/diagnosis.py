"""Which physical effect is missing: from a model and logs to a diagnosis."""

import dataclasses
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from threadpoolctl import threadpool_limits

from modeler.diagnose.analyse import analysed
from modeler.diagnose.assemble import assembled
from modeler.diagnose.channels import Fault, faults
from modeler.diagnose.contact import Window, contact_window
from modeler.diagnose.errors import vetoing
from modeler.diagnose.result import Diagnosis
from modeler.diagnose.search import MOST, search
from modeler.diagnose.state import Data, state_of
from modeler.effects import CATALOGUE, Effect
from modeler.fit import IdentifiedModel
from modeler.observation import Log, Observation

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

CHANGED = 1.3
"""Ratio of the residual variances with kept and with refitted parameters from which on the robot
has changed since the fit."""


@threadpool_limits.wrap(limits=1, user_api="blas")  # small matrices: a second thread only waits
def diagnose(
    model: IdentifiedModel, compiled: "CompiledModel", logs: Sequence[Log],
    holdout: Sequence[Log] = (),
    without: Sequence[str] = (),
    most: int = MOST,
    progress: Callable[[float], None] | None = None,
    catalogue: Sequence[Effect] = CATALOGUE,
) -> Diagnosis:  # fmt: skip
    """The effects that the model lacks on these logs, with what they would gain.

    Args:
        model: fitted.
        compiled: its robot.
        logs: to explain.
        holdout: other motion, from which the errors come: it never chooses an effect, but vetoes.
        without: ids of effects, or id@joint, that the user rules out.
        most: effects to name at most.
        progress: called with a share between 0 and 1.
        catalogue: the effects to try; for those of a robot file too, `Robot.catalogue`.

    Raises:
        DataError: no usable row.
    """
    observation = analysed(compiled, logs, model.processing)
    kept = kept_parameters(model, compiled, logs, observation)
    data = Data(compiled, observation, kept, catalogue)
    other = _held_out(data, holdout)
    doubted = _faults(model, compiled, observation, other)
    if any(fault.certain for fault in doubted):
        most = 0
    veto = vetoing(other) if other is not None else None
    found = search(data, model.beta, without, most, veto, progress)
    window = contact_window(found.end) if most and "external_force" not in without else None
    if window is not None:
        data = dataclasses.replace(data, observation=_masked(observation, window))
        found = search(data, model.beta, without, most, veto, progress)
    if progress is not None:
        progress(1.0)
    return assembled(model, found, other, window, doubted)


def _held_out(data: Data, holdout: Sequence[Log]) -> Data | None:
    """Held-out logs in the band of the training logs."""
    if not holdout:
        return None
    processing = data.observation.report.processing
    seen = analysed(data.compiled, holdout, processing, chosen=True)
    return dataclasses.replace(data, observation=seen)


def _faults(
    model: IdentifiedModel, compiled: "CompiledModel", observation: Observation, other: Data | None
) -> tuple[Fault, ...]:
    """Channels that contradict the model, of the logs and of the held-out ones."""
    found = faults(compiled, observation, model.beta)
    if other is None:
        return found
    held = faults(compiled, other.observation, model.beta)
    return (*found, *(dataclasses.replace(f, line=f"held out: {f.line}") for f in held))


def kept_parameters(
    model: IdentifiedModel, compiled: "CompiledModel", logs: Sequence[Log], seen: Observation
) -> np.ndarray | None:
    """The model's parameters if these logs are of a robot that has changed since; else None."""
    if any(used.shares_rows(log) for used in model.logs for log in logs):
        return None
    free = state_of(Data(compiled, seen), (), model.beta)
    pool, ranking = free.ranked([])
    del pool
    fitted = float(ranking.before.sum())
    given = sum(
        float(np.sum(((y - w @ model.beta) / s) ** 2))
        for y, w, s in zip(free.rows.y, free.rows.W, free.base.sigma, strict=True)
    )
    return model.beta if given > CHANGED * fitted else None


def _masked(observation: Observation, window: Window) -> Observation:
    """The observation without the rows of a window, and half a second around it."""
    hit = (observation.run == window.log) & (observation.time > window.start - 0.5)
    hit &= observation.time < window.end + 0.5
    used = observation.used & ~hit[:, None]
    parts, at = [], 0
    for part in observation.stretches:
        rows = len(part.used)
        parts.append(dataclasses.replace(part, used=used[at : at + rows]))
        at += rows
    return dataclasses.replace(observation, used=used, stretches=tuple(parts))
