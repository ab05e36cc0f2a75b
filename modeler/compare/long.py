"""Long logs: their numbers from every row, read in chunks; what residuals follow from windows."""

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from modeler.compare.comparison import Comparison, compare
from modeler.compare.predict import on_rows, predict_observed
from modeler.compare.prediction import Prediction
from modeler.compare.sums import NOTHING, LogSums, sums_of
from modeler.compiled import CompiledModel
from modeler.fit import IdentifiedModel
from modeler.fit.streamed import all_rows, by_threads
from modeler.observation import Observation
from modeler.observation.chunk import Chunk
from modeler.observation.facts import Facts
from modeler.observation.log import FINGER
from modeler.observation.report import DataReport
from modeler.observation.seen import Chosen, seen
from modeler.observation.source import Source
from modeler.observation.stack import stacked
from modeler.observation.streamed_report import streamed_report
from modeler.observation.torque import model_torque

_FOR = "the choices below, what residuals follow, pictures and doubts about channels"


@dataclass(frozen=True, eq=False)
class _Part:
    """What a comparison needs of some rows of a log."""

    sums: LogSums
    facts: Facts

    def over(self, later: "_Part") -> "_Part":
        """Of these rows, and of those that follow them."""
        return _Part(self.sums.over(later.sums), self.facts.over(later.facts))


def compare_long(
    model: IdentifiedModel,
    sources: Sequence[Source],
    compiled: CompiledModel,
    progress: Callable[[float], None] = lambda share: None,
    rows: int = FINGER,
) -> tuple[Comparison, Observation]:
    """As `compare` of what `predict` makes of logs, of any length in flat memory.

    Errors, R^2, scales, largest residuals and worst moments are those of all rows; a worst moment
    lies within a chunk. Structure, spectra, regions, sigmas and pictures are those of the windows,
    each as a log by itself.

    Args:
        model: fitted.
        sources: of the logs.
        compiled: its robot.
        progress: is told the share of the rows that are done.
        rows: of a chunk, at least.

    Raises:
        DataError: as `fit.streamed.stream`.
    """

    def reduced(model_: CompiledModel, chunk: Chunk, chosen: Chosen) -> _Part:
        return _part(model_, chunk, chosen, model.beta)

    reducer = partial(by_threads, reduce_by=reduced)
    passes, parts = all_rows(compiled, sources, model.processing, progress, rows, reducer)
    looked, spans = passes.found.observation, passes.found.spans
    report = streamed_report(compiled, sources, passes, _FOR)
    shown = _by_window(predict_observed(model, looked, compiled), spans)
    return compare(shown, [part.sums for part in parts]), dataclasses.replace(looked, report=report)


def _part(model: CompiledModel, chunk: Chunk, chosen: Chosen, beta: np.ndarray) -> _Part:
    stretches, facts = seen(model, chunk, chosen)
    name = chunk.log.name
    stretches = tuple(part for part in stretches if len(part.rows.centres))
    if not stretches:
        return _Part(LogSums(name, 0, 0, (NOTHING,) * len(chunk.log.joints)), facts)
    report = DataReport(chosen.processing, (), (), ())
    observation = stacked(model, (name,), stretches, report)
    found = on_rows(observation, model_torque(observation, model, beta))
    (sums,) = sums_of(dataclasses.replace(found, run=np.zeros_like(found.run)))
    return _Part(sums, facts)


def _by_window(
    prediction: Prediction, spans: Sequence[Sequence[tuple[float, float]]]
) -> Prediction:
    """Every window as a log: nothing goes on from one to the next."""
    names, first = list[str](), list[int]()
    for log, own in zip(prediction.logs, spans, strict=True):
        first.append(len(names))
        names += [f"{log}@{start:.9g}:{end:.9g}" for start, end in own]

    def numbers(run: np.ndarray, time: np.ndarray) -> np.ndarray:
        found = np.empty_like(run)
        for k, own in enumerate(spans):
            between = [0.5 * (a[1] + b[0]) for a, b in zip(own, own[1:], strict=False)]
            found[run == k] = first[k] + np.searchsorted(between, time[run == k])
        return found

    full = prediction.full
    assert full is not None
    return dataclasses.replace(
        prediction,
        logs=tuple(names),
        run=numbers(prediction.run, prediction.time),
        full=dataclasses.replace(full, run=numbers(full.run, full.time)),
    )
