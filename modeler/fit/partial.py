"""One chunk of a long log, reduced to what a fit needs of it: pure functions, for any worker."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial, reduce
from typing import TYPE_CHECKING

import numpy as np

from modeler.compiled.fused import no_rows
from modeler.estimate.compressed import Compressed, compress, merged
from modeler.observation.chunk import Chunk
from modeler.observation.evaluated import Evaluated
from modeler.observation.facts import Facts
from modeler.observation.motion import Segment
from modeler.observation.passing import with_stretch
from modeler.observation.seen import Chosen, seen
from modeler.observation.stretch import Stretch

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel


@dataclass(frozen=True, eq=False)
class Partial:
    """What a fit needs of some rows of a log; it can be pickled.

    Attributes:
        data: their triangles.
        facts: what the rows say of the log.
    """

    data: Compressed
    facts: Facts

    def over(self, later: "Partial") -> "Partial":
        """Of these rows, and of those that follow them."""
        return Partial(merged(self.data, later.data), self.facts.over(later.facts))


def reduce_chunk(model: "CompiledModel", chunk: Chunk, chosen: Chosen) -> Partial:
    """The rows y = W beta of a chunk, as triangles. Pure: equal chunks give equal bits.

    Args:
        model: the compiled robot.
        chunk: of a log.
        chosen: for that log.

    Raises:
        DataError: a value that cannot be.
    """
    stretches, facts = seen(model, chunk, chosen)
    return Partial(_compressed(model, stretches), facts)


def merge_all(parts: Iterable[Partial]) -> Partial:
    """Of all chunks of a log, one after the other."""
    return reduce(Partial.over, parts)


def _compressed(model: "CompiledModel", stretches: Iterable[Stretch]) -> Compressed:
    """Triangles of some stretches; W is never there as a whole."""
    parts = [part for part in stretches if part.used.any()]
    regressor, state = Evaluated(model, parts), no_rows(model.pattern)
    for part in parts:
        torque = part.filtered(partial(_torque, part.segment))
        state = with_stretch(regressor, part, torque, part.used, state)
    like = none_of(model)
    return Compressed(like.names, state.triangles, state.rows.astype(np.intp), like.free)


def _torque(segment: Segment, window: slice) -> np.ndarray:
    return segment.tau[window]


def none_of(model: "CompiledModel") -> Compressed:
    """The triangles of no rows."""
    names, joints = [base.name for base in model.spec.base], model.spec.joints
    free = [j for j, joint in enumerate(joints) if not joint.actuated]
    nothing = np.empty((0, len(names)))
    return compress(nothing, np.empty(0), np.empty(0, dtype=int), len(joints), names, free)
