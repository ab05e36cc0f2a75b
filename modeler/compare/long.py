"""Long logs: the rows of all their chunks, compared as those of a log that is read whole."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from modeler.compare.comparison import Comparison, compare
from modeler.compare.predict import full_rate, of_rows, on_rows
from modeler.compare.prediction import Prediction
from modeler.compiled import CompiledModel
from modeler.core.errors import DataError
from modeler.fit import IdentifiedModel
from modeler.fit.streamed import all_rows, by_threads
from modeler.observation import Observation
from modeler.observation.chunk import Chunk
from modeler.observation.log import FINGER
from modeler.observation.report import DataReport
from modeler.observation.row_filter import spacing
from modeler.observation.seen import Chosen, seen
from modeler.observation.source import Source
from modeler.observation.stack import stacked
from modeler.observation.streamed_report import streamed_report
from modeler.observation.tally import Facts

MOST = 400_000
"""Rows of a comparison, after decimation; of longer logs fewer rows are taken."""


@dataclass(frozen=True, eq=False)
class _Part:
    """Some consecutive rows of a log: what is compared of each chunk, and what they say of it."""

    rows: tuple[Prediction, ...]
    facts: Facts

    def over(self, later: "_Part") -> "_Part":
        """Of these rows, and of those that follow them."""
        return _Part(self.rows + later.rows, self.facts.over(later.facts))


def compare_long(
    model: IdentifiedModel,
    sources: Sequence[Source],
    compiled: CompiledModel,
    progress: Callable[[float], None] = lambda share: None,
    rows: int = FINGER,
) -> tuple[Comparison, Observation]:
    """As `compare` of what `predict` makes of logs, of any length in flat memory.

    Args:
        model: fitted.
        sources: of the logs.
        compiled: its robot.
        progress: is told the share of the rows that are done.
        rows: of a chunk, at least.

    Raises:
        DataError: as `fit.streamed.stream`.
    """

    def reduced(_: CompiledModel, chunk: Chunk, chosen: Chosen) -> _Part:
        return _part(model, compiled, chunk, chosen)

    processing = model.processing
    least = -(-sum(source.rows for source in sources) // MOST)
    step = sources[0].window(0.5, 1000).step
    if least > spacing(step, processing.parallel_cutoff or 0.0, processing.decimation):
        processing = dataclasses.replace(processing, decimation=least)
    reducer = partial(by_threads, reduce_by=reduced)
    passes, parts = all_rows(compiled, sources, processing, progress, rows, reducer)
    looked = passes.found.observation
    steps = [own.step * (own.processing.decimation or 1) for own in passes.found.chosen]
    prediction = _joined([source.name for source in sources], [own.rows for own in parts], steps)
    full = full_rate(looked, compiled, model.beta)
    ripples = dataclasses.replace(on_rows(looked, looked.torque), full=full)
    report = streamed_report(compiled, sources, passes)
    return compare(prediction, ripples), dataclasses.replace(looked, report=report)


def _part(model: IdentifiedModel, compiled: CompiledModel, chunk: Chunk, chosen: Chosen) -> _Part:
    stretches, facts = seen(compiled, chunk, chosen)
    some = tuple(part for part in stretches if len(part.rows.centres))
    report = DataReport(chosen.processing, (), (), ())
    found = stacked(compiled, (chunk.log.name,), some, report) if some else None
    return _Part(() if found is None else (of_rows(model, found, compiled),), facts)


def _joined(
    names: Sequence[str], logs: Sequence[Sequence[Prediction]], steps: Sequence[float]
) -> Prediction:
    """The rows of all logs, `steps` s apart; what goes on in the next chunk is one segment."""
    number, found = -1, list[Prediction]()
    for run, (parts, step) in enumerate(zip(logs, steps, strict=True)):
        last = -np.inf
        for part in parts:
            number += not 0.5 < (part.time[0] - last) / step < 1.5
            segment, runs = part.segment + number, np.full(len(part.time), run)
            found.append(dataclasses.replace(part, segment=segment, run=runs))
            number, last = int(segment[-1]), float(part.time[-1])
    if not found:
        raise DataError(f"{', '.join(names)}: no row is left; record longer motion")
    columns = [
        name for name in vars(found[0])
        if all(isinstance(getattr(part, name), np.ndarray) for part in found)
    ]  # fmt: skip
    every: dict[str, Any] = {"temperature": None} | {
        name: np.concatenate([getattr(part, name) for part in found]) for name in columns
    }
    return dataclasses.replace(found[0], logs=tuple(names), **every)
