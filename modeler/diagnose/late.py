"""A position channel whose clock is late: nothing in the catalogue shifts one joint in time."""

from functools import partial

import numpy as np

from modeler.diagnose.search import Search
from modeler.hypotheses.rows import Rows
from modeler.scoring.timing import CONVENTION

SHARE = 0.2
"""Least share of the error variance left that the shift of one position explains."""

AHEAD = 1.5
"""Least ratio of what it explains to what the best effect of the catalogue would."""

_SURE = 4.5  # falls over their standard error


def late_lines(found: Search) -> list[str]:
    """A sentence on the joint whose position comes late, or early, beside all other channels.

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
        drop[best] < SHARE * float(ranking.before.sum())
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
