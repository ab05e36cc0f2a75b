"""Logs that are used together: every row has one part, explained or held out."""

from collections.abc import Sequence

from modeler.core.errors import DataError
from modeler.observation import Log
from modeler.observation.log import shared_rows


def check_apart(logs: Sequence[Log], holdout: Sequence[Log] = ()) -> None:
    """Refuse rows that are given twice, and held-out rows that are also explained.

    Both would flatter every effect.

    Raises:
        DataError: names the two logs.
    """
    for given in (logs, holdout):
        for index, log in enumerate(given):
            for first in given[:index]:
                if _shared(log, first):
                    raise DataError(
                        f"{log.name}: got rows of {first.name} again; rows that repeat make all "
                        "that is found look too sure; give each row once"
                    )
    for other in holdout:
        for log in logs:
            if _shared(other, log):
                raise DataError(
                    f"--holdout {other.name}: shares rows with {log.name}; expected other motion; "
                    "leave it out, or split the log with FILE@START:END"
                )


def _shared(log: Log, other: Log) -> bool:
    return shared_rows(log, other.content, other.time[0], other.time[-1])
