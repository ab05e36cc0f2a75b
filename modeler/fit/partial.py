"""One chunk of a long log, reduced to what a fit needs of it: pure functions, for any worker."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from modeler.estimate.compressed import Compressed, compress, merged
from modeler.observation.chunk import Chunk
from modeler.observation.facts import Facts
from modeler.observation.seen import Chosen, seen
from modeler.observation.signals import signals_of
from modeler.observation.stretch import Stretch

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

_SAMPLES = (
    4096  # evaluated at a time: with 6 joints x 48 columns 9 MB, which the caches hold in part
)
_HELD = 10_000  # rows after which they become a triangle

_Rows = tuple[np.ndarray, np.ndarray, np.ndarray]


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
    """Triangles of some stretches; W is never there as a whole."""
    data, held, rows = none_of(model), list[_Rows](), 0
    for block in (block for part in stretches for block in _blocks(model, part)):
        held.append(block)
        rows += len(block[1])
        if rows > _HELD:
            data, held, rows = merged(data, _of(held, data)), [], 0
    return merged(data, _of(held, data)) if held else data


def _blocks(model: "CompiledModel", part: Stretch) -> Iterator[_Rows]:
    """The rows of a stretch that count: W, y and joint."""
    if not part.used.any():
        return
    s, read = part.segment, signals_of(model.spec, part.segment)

    def columns(w: slice) -> np.ndarray:
        return model.base_regressor(s.q[w], s.qd[w], s.qdd[w], None if read is None else read[w])

    torque = part.filtered(lambda w: s.tau[w])
    for rows, W in part.blocks(columns, _SAMPLES):
        used = part.used[rows]
        yield W[used], torque[rows][used], np.nonzero(used)[1]


def _of(held: Sequence[_Rows], like: Compressed) -> Compressed:
    """Triangles of some rows."""
    W, y, joint = (np.concatenate(values) for values in zip(*held, strict=True))
    free = [int(j) for j in np.flatnonzero(like.free)]
    return compress(W, y, joint, len(like.rows), like.names, free)


def none_of(model: "CompiledModel") -> Compressed:
    """The triangles of no rows."""
    names, joints = [base.name for base in model.spec.base], model.spec.joints
    free = [j for j, joint in enumerate(joints) if not joint.actuated]
    nothing = np.empty((0, len(names)))
    return compress(nothing, np.empty(0), np.empty(0, dtype=int), len(joints), names, free)
