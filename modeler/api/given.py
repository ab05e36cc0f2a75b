"""Logs as a user gave them."""

from collections.abc import Sequence

from modeler.core.errors import DataError
from modeler.observation import Log
from modeler.observation.log import shared_rows

Given = tuple[str, Log]
"""A log and what the user typed for it."""


def given(places: Sequence[str], logs: Sequence[Log]) -> list[Given]:
    """Each log beside its place."""
    return list(zip(places, logs, strict=True))


def check_logs(bare: Sequence[Given], loaded: Sequence[Given]) -> None:
    """Refuse rows that are given twice, and a loaded log named like a bare one."""
    every = [*bare, *loaded]
    for index, (place, log) in enumerate(every):
        for first, other in every[:index]:
            if shared_rows(log, other.content, other.time[0], other.time[-1]):
                raise DataError(
                    f"{place}: got rows of {first} again; rows that repeat count twice, and their "
                    "noise looks like something that returns; give each row once"
                )
    places = {log.name: place for place, log in bare}
    for place, log in loaded:
        if log.name in places:
            raise DataError(
                f"{place}: carries the load, and {places[log.name]} has the same file name; "
                "rename one, loads are assigned by name"
            )
