"""The rows of logs for a robot, also with other effects, and what a model leaves of them."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.compiled import CompiledModel
from modeler.fit import IdentifiedModel
from modeler.hypotheses.blocks import blocks_of
from modeler.observation import Log, Observation, Processing
from modeler.observation.dry_friction import shafts
from modeler.observation.prepare import Prepared, prepare
from modeler.observation.stack import observed, observed_alike
from modeler.observation.torque import model_torque
from modeler.scoring.gram import base_of
from modeler.scoring.score import Unseen


@dataclass(frozen=True, eq=False)
class Logs:
    """What the model is fitted to, and what it is judged on."""

    fitted: Sequence[Log]
    held_out: Sequence[Log] = ()


@dataclass(frozen=True, eq=False)
class Rows:
    """Logs as one robot sees them.

    Attributes:
        logs: they.
        compiled: the robot.
        prepared: filtered and differentiated; those that are held out second, if there are any.
        seen: the observations, in that order.
    """

    logs: Logs
    compiled: CompiledModel
    prepared: tuple[Prepared, ...]
    seen: tuple[Observation, ...]

    @property
    def fitted(self) -> Observation:
        """What a model is fitted to."""
        return self.seen[0]

    @property
    def held_out(self) -> bool:
        """True if there are logs to judge on."""
        return len(self.seen) > 1

    def of(self, compiled: CompiledModel) -> "Rows":
        """The rows of the same robot with other effects; nothing is filtered again."""
        if shafts(compiled) == shafts(self.compiled):
            seen = tuple(observed_alike(compiled, observation) for observation in self.seen)
            return dataclasses.replace(self, compiled=compiled, seen=seen)
        return _rows(compiled, self.logs, self.prepared)


def rows_of(compiled: CompiledModel, logs: Logs, processing: Processing) -> Rows:
    """The rows of logs.

    Args:
        compiled: the robot.
        logs: read with its manifest.
        processing: that of the model.

    Raises:
        DataError: no usable row.
    """
    given = (logs.fitted, logs.held_out) if logs.held_out else (logs.fitted,)
    prepared = tuple(prepare(compiled.spec, some, processing) for some in given)
    return _rows(compiled, logs, prepared)


def _rows(compiled: CompiledModel, logs: Logs, prepared: tuple[Prepared, ...]) -> Rows:
    given = (logs.fitted, logs.held_out)[: len(prepared)]
    pairs = zip(given, prepared, strict=True)
    return Rows(logs, compiled, prepared, tuple(observed(compiled, *pair) for pair in pairs))


def left_of(model: IdentifiedModel, compiled: CompiledModel, observation: Observation) -> Unseen:
    """What it leaves of logs."""
    left = observation.torque - model_torque(observation, compiled, model.beta)
    return _unseen_of(observation, [left[own, j] for j, own in enumerate(observation.used.T)])


def left_out(
    model: IdentifiedModel, observation: Observation, free: np.ndarray | None = None
) -> Unseen:
    """What it leaves of its own logs, each eighth predicted from a fit to the others.

    Args:
        model: fitted.
        observation: of its logs.
        free: (c, k) the directions of beta that are fitted, beside the model; None: all of it.
    """
    used = observation.used.T
    W = [observation.columns[own, j] for j, own in enumerate(used)]
    y = [observation.torque[own, j] for j, own in enumerate(used)]
    if free is not None:
        y = [tau - w @ model.beta for w, tau in zip(W, y, strict=True)]
        W = [w @ free for w in W]
    blocks = blocks_of(observation)
    number = [blocks.number[own] for own in used]
    sigma = np.array([joint.sigma if joint.sigma > 0.0 else 1.0 for joint in model.fit.joints])
    base = base_of(W, y, sigma, number, blocks.fold)
    return _unseen_of(observation, [s * e for s, e in zip(sigma, base.left_out, strict=True)])


def _unseen_of(observation: Observation, left: list[np.ndarray]) -> Unseen:
    used = observation.used.T
    return Unseen(
        tuple(joint.name for joint in observation.joints),
        tuple(left),
        tuple(observation.torque[own, j] for j, own in enumerate(used)),
        tuple(observation.time[own] for own in used),
        tuple(observation.run[own] for own in used),
    )
