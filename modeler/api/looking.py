"""What is in a log, before anything is fitted to it."""

from pathlib import Path

from modeler.api.chain import Mapped, file_and_span, given_map, log_map
from modeler.compiled import CompiledModel
from modeler.logs import Table
from modeler.logs.blocks import blocks_of, windows_of
from modeler.logs.look import Look, look
from modeler.logs.table import Part
from modeler.observation.log import FINGER, LONG
from modeler.observation.survey import WINDOW, WINDOWS


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
    names = given_map(mapping) if compiled is None else log_map(compiled, mapping)
    joints = () if compiled is None else compiled.spec.joints
    blocks, span = blocks_of(Path(path)), span or (None, None)
    if blocks is None or blocks.rows <= LONG:
        table = Table(Path(path), names, joints, any_topic=True)
        return look(table, names, joints, span)
    seen = Part(windows_of(blocks, WINDOWS, WINDOW))
    every = (Table(Path(path), names, joints, part=Part(own)) for own in blocks.blocks(FINGER))
    return look(Table(Path(path), names, joints, part=seen), names, joints, span, every)
