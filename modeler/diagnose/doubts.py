"""All that may be wrong with the logs of a diagnosis, the gravest first."""

from collections.abc import Sequence

from modeler.diagnose.channels import Fault
from modeler.diagnose.data_checks import data_lines, log_lines
from modeler.diagnose.late import late_lines
from modeler.diagnose.search import Search
from modeler.diagnose.state import Data
from modeler.fit import IdentifiedModel


def doubts(
    model: IdentifiedModel, found: Search, other: Data | None, faults: Sequence[Fault]
) -> tuple[str, ...]:
    """Sentences on the logs.

    Args:
        model: as given.
        found: of the training logs.
        other: held-out logs.
        faults: channels that contradict the model.
    """
    lines = [fault.line for fault in faults]
    if not any(fault.certain for fault in faults):
        lines += late_lines(found)
    lines += data_lines(found.start)
    if other is not None:
        lines += [f"held out: {line}" for line in log_lines(other.observation.report)]
        lines += _fitted_before(model, other)
    return tuple(lines)


def _fitted_before(model: IdentifiedModel, other: Data) -> list[str]:
    """Held-out logs that the model was fitted to."""
    cost = "its errors there are too small"
    if other.kept is None:
        cost = "here it is fitted to the other logs only"
    return [
        f"held out: the model was fitted to {log.name}; {cost}"
        for log in other.observation.report.logs
        if any(
            log.content != "" and used.content == log.content
            and used.start <= log.span[1] and log.span[0] <= used.end
            for used in model.logs
        )
    ]  # fmt: skip
