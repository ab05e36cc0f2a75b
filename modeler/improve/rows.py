"""The rows of logs for a robot, and for the same robot with other effects."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

from modeler.compiled import CompiledModel
from modeler.observation import Log, Observation, Processing
from modeler.observation.dry_friction import shafts
from modeler.observation.prepare import Prepared, prepare
from modeler.observation.stack import observed, observed_alike


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
