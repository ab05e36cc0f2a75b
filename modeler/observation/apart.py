"""Logs that are used together: every row has one part, fitted, explained or held out."""

from collections.abc import Sequence

from modeler.core.errors import DataError
from modeler.observation.log import Rows, shared_rows


def check_apart(
    logs: Sequence[Rows], holdout: Sequence[Rows] = (), places: Sequence[str] = ()
) -> None:
    """Refuse rows that are given twice, and held-out rows that are also explained.

    Args:
        logs: as they were read, or their reports.
        holdout: of which errors are to be told.
        places: what the user typed for `logs`; none: their names.

    Raises:
        DataError: names the two logs.
    """
    for given, typed in ((logs, places), (holdout, ())):
        names = typed or [log.name for log in given]
        for index, log in enumerate(given):
            for first, other in zip(names, given[:index], strict=False):
                if _shared(log, other):
                    raise DataError(
                        f"{names[index]}: got rows of {first} again; rows that repeat count "
                        "twice, and their noise looks like something that returns; give each row "
                        "once"
                    )
    for other in holdout:
        for log in logs:
            if _shared(other, log):
                raise DataError(
                    f"--holdout {other.name}: shares rows with {log.name}; expected other motion; "
                    "leave it out, or split the log with FILE@START:END"
                )


def _shared(log: Rows, other: Rows) -> bool:
    return shared_rows(log, other.content, *other.span)
