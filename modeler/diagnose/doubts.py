"""All that may be wrong with the logs of a diagnosis, the gravest first."""

from collections.abc import Sequence

import numpy as np

from modeler.diagnose.data_checks import data_lines
from modeler.diagnose.late import late_lines
from modeler.diagnose.search import Search
from modeler.fit import IdentifiedModel
from modeler.observation.channels import Fault
from modeler.scoring.state import Data, State

MENDED = 0.25
"""Share of a joint's squared residual: with less of it left, its torque has the scale it should."""


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
    lines = [fault.line for fault in faults if fault.certain or not _explained(found, fault.joint)]
    if not any(fault.certain for fault in faults):
        lines += late_lines(found)
    lines += [*_moved(model, found.start.data), *data_lines(found.start)]
    if other is not None:
        lines += [f"held out: {line}" for line in other.observation.report.doubts()]
        lines += [*_without_temperature(found.start, other), *_fitted_before(model, other)]
    return tuple(lines)


def _explained(found: Search, j: int) -> bool:
    """True if the effects named explain most of what a joint's torque differs by."""
    if j < 0 or not found.start.residual[j].size:
        return False
    before, after = (float(np.mean(s.residual[j] ** 2)) for s in (found.start, found.end))
    return after < MENDED * before


def _moved(model: IdentifiedModel, data: Data) -> list[str]:
    """A delay that the diagnosis took out of the logs."""
    moved = data.observation.report.processing.delay - model.processing.delay
    if moved == 0.0:
        return []
    when = "before" if moved > 0.0 else "after"
    return [
        f"torques are logged {1e3 * abs(moved):.2g} ms {when} the motion that they belong to, "
        "about half a sample: a convention of the logger; the diagnosis has moved them back"
    ]


def _without_temperature(state: State, other: Data) -> list[str]:
    """Held-out logs without a temperature that the training logs have."""
    known = state.reference.temperature
    found = []
    for k, log in enumerate(other.observation.logs):
        extra = [s.segment.extra for s in other.rows.signals if s.segment.run == k]
        lacking = [
            joint for joint in known
            if not all({f"temperature{joint}", "temperature"} & part.keys() for part in extra)
        ]  # fmt: skip
        if lacking:
            found.append(
                f"held out: {log} has no temperature of joint {', '.join(lacking)}: taken as the "
                "mean of the training logs; log it"
            )
    return found


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
