"""Files that a command reads and writes: none is both, and what it writes can be written."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from modeler.core.errors import DataError
from modeler.core.files import check_writable

_LOGS = (".csv", ".parquet")


def check_places(model: str, logs: Sequence[str], outputs: Mapping[str, str | None]) -> None:
    """Refuse, before any work, outputs that would replace an input or each other.

    Args:
        model: the model file that is read.
        logs: logs that are read, as FILE or FILE@START:END.
        outputs: option, as in "--out", to the file that it names; None or "-": no file.

    Raises:
        ModelerError: an output is an input, is named like a log, is named twice, or cannot be
            written.
    """
    read = {_file(place).resolve() for place in logs}
    taken: dict[Path, str] = {}
    for option, place in outputs.items():
        if place is None or place == "-":
            continue
        path = Path(place).resolve()
        if path in read or path.suffix.lower() in _LOGS:
            raise DataError(f"{option} {place}: this is a log; expected a name of its own")
        if path == Path(model).resolve():
            raise DataError(
                f"{option} {place}: this is the model that is read; expected a name of its own, "
                "so that the model stays"
            )
        if path in taken:
            raise DataError(
                f"{option} {place}: {taken[path]} writes this file too; expected a name of its own"
            )
        taken[path] = option
        check_writable(Path(place))


def _file(place: str) -> Path:
    """The file of FILE or FILE@START:END."""
    path = Path(place)
    return path if path.exists() else Path(place.rpartition("@")[0] or place)
