"""What is in a log, before anything is fitted to it."""

from collections.abc import Mapping
from pathlib import Path

from modeler.api.chain import Mapped, file_and_span, log_map
from modeler.compiled import CompiledModel
from modeler.logs import Table, map_from_table, map_from_words
from modeler.logs.look import Look, look


def look_at(place: str | Path, compiled: CompiledModel | None = None, mapping: Mapped = ()) -> Look:
    """Channels, clock, gaps and doubts of a log.

    Args:
        place: of any format of `modeler.logs`; with `@start:end` a piece of it.
        compiled: the robot that it may be of; None: the columns speak for themselves.
        mapping: whose column is which, as of `read_logs`; what it leaves open is guessed.

    Raises:
        DataError: the file cannot be read, or has no rows in that piece.
    """
    path, span = file_and_span(str(place))
    if compiled is not None:
        names = log_map(compiled, mapping)
    elif isinstance(mapping, Mapping):
        names = map_from_table(mapping, "mapping", strict=True)
    else:
        names = map_from_words(mapping)
    joints = () if compiled is None else compiled.spec.joints
    table = Table(Path(path), names, joints, any_topic=True)
    return look(table, names, joints, span or (None, None))
