"""Errors of a state on motion it was not fitted to, and whether an effect lowers them."""

from collections.abc import Callable, Sequence

import numpy as np

from modeler.diagnosis.judge import Judged
from modeler.diagnosis.score import Score, Unseen, scored
from modeler.diagnosis.state import SearchData, State, picked_columns


def holdout_residuals(state: State, other: SearchData | None) -> Unseen:
    """What a state leaves of held-out logs; without any, of its own, each fold from the others.

    Args:
        state: fitted.
        other: held-out logs, in the same band.
    """
    if other is not None:
        return left_of(state, other)
    left = (s * e for s, e in zip(state.sigma, state.base.left_out, strict=True))
    return _of(state.data, tuple(left))


def left_of(state: State, data: SearchData) -> Unseen:
    """What a state leaves of logs, with its parameters as they are."""
    rows = data.about(state.reference)
    extra = picked_columns(rows, state.picks)
    found = [y - W @ state.beta for y, W in zip(rows.y, rows.W, strict=True)]
    for columns, values in zip(extra, state.values, strict=True):
        for j, own in enumerate(columns):
            if own is not None:
                found[j] = found[j] - own @ values
    return _of(data, tuple(found))


def _of(data: SearchData, left: tuple[np.ndarray, ...]) -> Unseen:
    names, rows = tuple(joint.name for joint in data.spec.joints), data.rows
    return Unseen(names, left, rows.y, rows.time, rows.run)


def compared(
    before: Unseen, after: Unseen, concerned: Sequence[int], state: State, block: float = 0.0
) -> Score:
    """The score of an effect on the joints that it concerns, in blocks of some s.

    The torque of each counts in units of what the state leaves of it, so that N m and N are never
    added.
    """
    weights = {}
    for j in concerned:
        y = state.rows.y[j] / state.sigma[j]
        weights[before.names[j]] = float(np.mean(y**2)) if y.size else 0.0
    return scored(before, after, weights, block)


KEPT = 0.2
"""Share of the expected gain that must come true on held-out motion, which may excite it less."""

TOUCHED = 0.1
"""Least fall of a joint's squared residual, as a share of the largest, that counts as touched."""


def touched_joints(judged: Judged, before: State, after: State) -> list[int]:
    """Joints whose residuals an effect explains: its own, or all where they fall most."""
    if judged.alone:
        return [judged.candidate.index]
    sizes = zip(before.residual, after.residual, before.sigma, strict=True)
    fall = np.array([float(np.sum((b / s) ** 2) - np.sum((a / s) ** 2)) for b, a, s in sizes])
    if fall.max() <= 0.0:
        return [int(np.argmax(fall))]
    return [int(j) for j in np.flatnonzero(fall >= TOUCHED * fall.max())]


def vetoing(other: SearchData | None) -> Callable[[State, State, Judged], bool]:
    """A veto by unseen motion: True if a state with an effect more is not the better one there.

    The error of the joints that it touches must surely fall (`scored`), and on held-out logs by a
    good part of what the effect lets expect.

    Args:
        other: held-out logs.
    """

    def veto(before: State, after: State, judged: Judged) -> bool:
        touched = touched_joints(judged, before, after)
        score = compared(
            holdout_residuals(before, other), holdout_residuals(after, other), touched, before
        )
        expected = judged.gain
        if not judged.alone:  # what is gone of the squared residuals of these joints
            first, last = (
                sum(float(np.sum((s.residual[j] / before.sigma[j]) ** 2)) for j in touched)
                for s in (before, after)
            )
            expected = 1.0 - last / max(first, 1e-300)
        least = 0.0 if other is None else KEPT * expected
        return not score.better or score.whole.gain < least

    return veto
