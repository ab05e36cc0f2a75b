"""All that may be wrong with the logs of a diagnosis, the gravest first."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from modeler.diagnose.contact import Window
from modeler.diagnose.data_checks import data_lines
from modeler.diagnose.search import Search
from modeler.fit import IdentifiedModel
from modeler.hypotheses.rows import Rows
from modeler.observation.channels import Fault
from modeler.scoring.state import Data, State
from modeler.scoring.timing import CONVENTION

MENDED = 0.25
"""Share of a joint's squared residual: with less of it left, its torque has the scale it should."""


LATE_SHARE = 0.2
"""Least share of the error variance left that the shift of one position explains."""

AHEAD = 1.5
"""Least ratio of what it explains to what the best effect of the catalogue would."""

_SURE = 4.5  # falls over their standard error


def doubts(
    model: IdentifiedModel, found: Search, other: Data | None, faults: Sequence[Fault],
    window: Window | None = None,
) -> tuple[str, ...]:  # fmt: skip
    """Sentences on the logs.

    Args:
        model: as given.
        found: of the training logs.
        other: held-out logs.
        faults: channels that contradict the model.
        window: that was left out.
    """
    lines = [fault.line for fault in faults if fault.certain or not _explained(found, fault.joint)]
    if not any(fault.certain for fault in faults):
        lines += late_lines(found)
    lines += [*_left_out(window, found.start.data), *_moved(model, found.start.data)]
    lines += data_lines(found.start)
    if other is not None:
        lines += [f"held out: {line}" for line in other.observation.report.doubts()]
        lines += [*_without_temperature(found.start, other), *_fitted_before(model, other)]
    return tuple(lines)


def _left_out(window: Window | None, data: Data) -> list[str]:
    """What comes only once and is no push."""
    if window is None or window.change is not None:
        return []
    return [
        f"{data.observation.logs[window.log]}, {window.start:.1f} to {window.end:.1f} s: torques "
        f"that come only once, {window.ratio:.0f} times the energy of any other window, and are "
        "no steady push: a shock, or a spike of the measurement; left out of everything"
    ]


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


def late_lines(found: Search) -> list[str]:
    """A sentence on the joint whose position comes late, or early, beside all other channels.

    Nothing in the catalogue shifts one joint in time.

    With q measured T too late, the torque is that of q + T qd; its derivative with respect to T is
    a column like any other. It is believed if it explains more of what the named effects leave
    than anything in the catalogue.
    """
    state = found.end
    joints = state.data.compiled.spec.joints
    driven = [j for j, joint in enumerate(joints) if joint.actuated]
    columns = []
    for j in driven:
        columns.append(state.rows.spread(partial(_later, state.rows, j)))
    shown = [i for i, own in enumerate(columns) if any(c is not None for c in own)]
    if not shown:
        return []
    _, ranking = state.ranked([columns[i] for i in shown])
    drop = ranking.drop.sum(axis=0)
    best = int(np.argmax(drop))
    rivals = [float(judged.drop.sum()) for judged in found.last.ranked if judged.possible]
    step = float(np.median([signals.segment.step for signals in state.rows.signals]))
    late = float(ranking.value[best])
    if (
        drop[best] < LATE_SHARE * float(ranking.before.sum())
        or drop[best] < AHEAD * max(rivals, default=0.0)
        or ranking.sure[best] < _SURE
        or abs(late) < CONVENTION * step
    ):
        return []
    name = joints[driven[shown[best]]].name
    return [
        f"joint {name}: its position comes {1e3 * abs(late):.2g} ms too "
        f"{'late' if late > 0.0 else 'early'} beside the other channels; check the clock or the "
        "filter of that channel"
    ]


def _later(rows: Rows, j: int, stretch: int, window: slice) -> np.ndarray:
    """(n, J, 1) torque by the delay of the position of joint j."""
    signals = rows.signals[stretch]
    return signals.moved(j, signals.v[:, [j]], True, window)
