"""Long logs: whether some are, and their fit, which never has all rows in memory."""

from collections.abc import Callable, Sequence
from pathlib import Path

from modeler.api.chain import AnyLog, Mapped, file_and_span, identified, log_map, read_logs
from modeler.api.ways import Way, judged
from modeler.compiled import CompiledModel
from modeler.core.contract import Emitted
from modeler.core.errors import DataError
from modeler.derivation import Derivation
from modeler.fit import FitResult, IdentifiedModel, Method
from modeler.fit.streamed import OF_TRIANGLES, Reducer, Streamed, identify_long, stream
from modeler.logs.blocks import blocks_of
from modeler.observation import Log, Processing
from modeler.observation.apart import check_apart
from modeler.observation.log import LONG, MOST_WHOLE
from modeler.observation.source import MemorySource, Source, source_of


def rows_of(places: Sequence[AnyLog]) -> int:
    """Rows of logs, as far as their files tell without being read; of CSV files about.

    Raises:
        DataError: a file is damaged.
    """
    return sum(_rows_of(place) for place in places)


def _rows_of(place: AnyLog) -> int:
    if isinstance(place, Log):
        return place.rows
    if not isinstance(place, str | Path):
        return 0
    path, span = file_and_span(place)
    blocks = blocks_of(Path(path)) if span is None else None
    return 0 if blocks is None else blocks.rows


def are_long(places: Sequence[AnyLog]) -> bool:
    """True of logs whose fit reads them in chunks."""
    return rows_of(places) > LONG


def too_long(places: Sequence[AnyLog]) -> bool:
    """True of logs that are not read at once, whatever for."""
    return rows_of(places) > MOST_WHOLE


def check_whole(places: Sequence[AnyLog], what: str) -> None:
    """Refuse logs that are too long to be read at once.

    Raises:
        DataError: they have more rows than that.
    """
    if too_long(places):
        raise DataError(
            f"fit: {what} keeps all rows in memory; got {rows_of(places)} rows, expected "
            f"at most {MOST_WHOLE}; give a part of the log, FILE@START:END, or take --method "
            f"{' or '.join(OF_TRIANGLES)}, which read logs of any length"
        )


def sources_of(
    compiled: CompiledModel, places: Sequence[AnyLog], mapping: Mapped = ()
) -> list[Source]:
    """The rows of logs, in blocks where their format allows it.

    Raises:
        DataError: a log cannot be read.
    """
    names = log_map(compiled, mapping)
    found: list[Source] = []
    for place in places:
        source = None
        if isinstance(place, str | Path) and file_and_span(place)[1] is None:
            source = source_of(Path(place), compiled.spec, names)
        found.append(source or MemorySource(read_logs(compiled, [place], mapping)[0]))
    return found


def fit_long(
    derivation: Derivation,
    emitted: Emitted,
    compiled: CompiledModel,
    sources: Sequence[Source],
    method: Method = "weighted",
    processing: Processing | None = None,
    progress: Callable[[float], None] = lambda share: None,
    reducer: Reducer | None = None,
) -> tuple[IdentifiedModel, Streamed]:
    """The fitted model of logs of any length, in flat memory; see `fit.streamed.stream`.

    Args:
        derivation: of the robot.
        emitted: its C.
        compiled: that, callable.
        sources: of the logs.
        method: "weighted" or "ordinary".
        processing: None: automatic.
        progress: is told the share of the rows that are done.
        reducer: of one log; None: threads of this process. See `api.spread`.

    Raises:
        DataError: see `stream` and `identify_long`.
    """
    streamed = stream(compiled, sources, processing, progress, reducer=reducer)
    check_apart(streamed.observation.report.logs)
    result = judged_long(compiled, streamed, method)
    return identified(derivation, emitted, streamed.observation, result), streamed


def judged_long(compiled: CompiledModel, streamed: Streamed, method: Method) -> FitResult:
    """The fit of long logs with its verdict."""
    way = Way(identify_long(streamed, method, compiled))
    return judged(compiled, streamed.observation, way, streamed.data)
