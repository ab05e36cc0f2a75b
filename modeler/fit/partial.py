"""One chunk of a long log, reduced to what a fit needs of it: pure functions, for any worker."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from modeler.estimate.compressed import Compressed, compress, merged
from modeler.observation.chunk import Chunk
from modeler.observation.facts import Facts
from modeler.observation.motion import Segment
from modeler.observation.seen import Chosen, seen
from modeler.observation.signals import signals_of
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


def merge(first: Partial, later: Partial) -> Partial:
    """Of rows of a log, and of those that follow them."""
    return Partial(merged(first.data, later.data), first.facts.over(later.facts))


def merge_all(parts: Iterable[Partial]) -> Partial:
    """Of all chunks of a log, one after the other."""
    return reduce(merge, parts)


def _compressed(model: "CompiledModel", stretches: Iterable[Stretch]) -> Compressed:
    """Triangles of some stretches, a block of rows after the other: W is never there as a whole."""
    data, free = none_of(model), _free(model)
    for part in stretches:
        if not part.used.any():
            continue
        s, read = part.segment, signals_of(model.spec, part.segment)

        def columns(w: slice, s: Segment = s, read: np.ndarray | None = read) -> np.ndarray:
            return model.base_regressor(
                s.q[w], s.qd[w], s.qdd[w], None if read is None else read[w]
            )

        def tau(w: slice, s: Segment = s) -> np.ndarray:
            return s.tau[w]

        torque = part.filtered(tau)
        for rows, W in part.blocks(columns):
            used = part.used[rows]
            own = compress(
                W[used], torque[rows][used], np.nonzero(used)[1], len(data.rows), data.names, free
            )
            data = merged(data, own)
    return data


def none_of(model: "CompiledModel") -> Compressed:
    """The triangles of no rows."""
    names = [base.name for base in model.spec.base]
    nothing = np.empty((0, len(names)))
    joints = len(model.spec.joints)
    return compress(nothing, np.empty(0), np.empty(0, dtype=int), joints, names, _free(model))


def _free(model: "CompiledModel") -> list[int]:
    return [j for j, joint in enumerate(model.spec.joints) if not joint.actuated]
