"""One chunk of a long log, reduced to what a fit needs of it: pure functions, for any worker."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial, reduce
from typing import TYPE_CHECKING

import numpy as np

from modeler.estimate.compressed import Compressed, compress, merged
from modeler.observation.chunk import Chunk
from modeler.observation.evaluated import Evaluated
from modeler.observation.facts import Facts
from modeler.observation.motion import Segment
from modeler.observation.passing import is_plain
from modeler.observation.seen import Chosen, seen
from modeler.observation.stretch import Stretch

if TYPE_CHECKING:
    from modeler.compiled import CompiledModel

_SAMPLES = 4096  # evaluated at a time: 6 joints x 48 columns of them are 9 MB
_HELD = 10_000  # rows after which they become a triangle

_Rows = tuple[np.ndarray, np.ndarray, np.ndarray]
"""W, y and the joint of some rows."""


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


def _compressed(model: "CompiledModel", stretches: Sequence[Stretch]) -> Compressed:
    """Triangles of some stretches; W is never there as a whole."""
    evaluated, data = Evaluated(model, stretches), _of([], model)
    held, rows = list[_Rows](), 0
    for part in stretches:
        if not part.used.any():
            continue
        if is_plain(part) and hasattr(model, "triangles"):
            data = merged(data, _plain(evaluated, part, data))
            continue
        torque = part.filtered(partial(_tau, part.segment))
        for block, W in part.blocks(partial(evaluated, part.segment), _SAMPLES):
            used = part.used[block]
            held.append((W[used], torque[block][used], np.nonzero(used)[1]))
            rows += len(held[-1][1])
            if rows > _HELD:
                data, held, rows = merged(data, _of(held, model)), [], 0
    return merged(data, _of(held, model)) if held else data


def _plain(evaluated: Evaluated, part: Stretch, like: Compressed) -> Compressed:
    """Triangles of a stretch whose rows are its samples, while they pass."""
    found = evaluated.triangles(part, part.used, None)
    return Compressed(like.names, found.triangles, found.rows.astype(int), like.free)


def _of(held: Sequence[_Rows], model: "CompiledModel") -> Compressed:
    """Triangles of some rows."""
    names, joints = [base.name for base in model.spec.base], model.spec.joints
    nothing = (np.empty((0, len(names))), np.empty(0), np.empty(0, dtype=int))
    W, y, joint = (np.concatenate(values) for values in zip(nothing, *held, strict=True))
    free = [j for j, one in enumerate(joints) if not one.actuated]
    return compress(W, y, joint, len(joints), names, free)


def _tau(segment: Segment, window: slice) -> np.ndarray:
    return segment.tau[window]
