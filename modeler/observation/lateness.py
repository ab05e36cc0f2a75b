"""Logged velocities and accelerations that come late, of one joint or of all alike."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.observation.difference_windows import Column, size_of, windows_of
from modeler.observation.segments import Piece
from modeler.observation.weighted_median import weighted_median

AS_LOGGED = "used as logged; fit with --derivatives position to avoid it"
POSITIONS = "the positions are differentiated instead"

HARM = 0.02
"""Mean disagreement, as a share of the derivative, from which on a late column is not used."""

_TOLD = 0.75  # steps; a leap between two samples already looks half a step early or late
_BELIEVED = 0.5  # of the sum of errors: what may be left without the delay
_CLEAR = 0.25  # of the derivative's mean: what may be left where one joint alone is late
_TURNS = 3  # the equation is linear for small delays only
_FAR = 0.3  # disagreement from which on a delay may be too large for the linear equation
_EARLIEST, _LATEST = -0.05, 0.2  # s
_STEP = 5e-3  # s


@dataclass(frozen=True)
class Late:
    """A logged derivative that lags behind, or runs ahead of, what it derives from.

    Attributes:
        column: of the log, "qd2", or "qd" for those of all joints.
        of: what it is the derivative of, "q2" or "q".
        seconds: of the delay; negative if it runs ahead.
        samples: the same in time steps.
        share: mean disagreement that it makes, as a share of the derivative.
    """

    column: str
    of: str
    seconds: float
    samples: float
    share: float

    def sentence(self, used: str) -> str:
        """Text, with what becomes of the column."""
        way = "lags behind" if self.seconds > 0.0 else "runs ahead of"
        whose = "in all joints" if self.column in ("qd", "qdd") else "and not all joints do"
        return (
            f"{self.column} {way} the derivative of {self.of} by {abs(self.seconds):.3g} s "
            f"({abs(self.samples):.2g} samples) {whose}; {used}"
        )


def lateness(
    pieces: Sequence[Piece], joints: Sequence[str], column: Column, lower: str, cutoff: float
) -> tuple[list[Late], np.ndarray]:
    """What is late, and (joints,) s by which each column is; 0 if small or not to be told.

    A delay is that which makes the sum of the absolute differences least, between the window means
    of the logged derivative and the difference quotients. Gross errors of a few samples do not
    move it. It is believed where it halves that sum. One delay for all joints is tried first, and
    given up if a joint is the worse for it.

    Args:
        pieces: with the column logged.
        joints: names.
        column: of the logged derivative.
        lower: of what it derives from.
        cutoff: of the parallel filter, Hz.
    """
    errors = _Errors(pieces, column, lower, cutoff)
    none = np.zeros(len(joints))
    before = errors.sums(none)
    common = errors.refined(none, together=True)
    together = errors.sums(common)
    step = pieces[0].step
    own = _own(errors, before, step)
    alone = errors.sums(own)
    share = before / np.maximum(errors.whole, 1e-300)
    halves = together.sum() <= _BELIEVED * before.sum()
    if halves and abs(common[0]) >= _TOLD * step and np.all(together <= 2.0 * alone):
        mean = float(before.sum() / max(float(errors.whole.sum()), 1e-300))
        return [Late(column, lower, common[0], common[0] / step, mean)], common
    late = [
        Late(f"{column}{joints[j]}", f"{lower}{joints[j]}", own[j], own[j] / step, float(share[j]))
        for j in map(int, np.flatnonzero(own))
    ]
    return late, own


def _own(errors: "_Errors", before: np.ndarray, step: float) -> np.ndarray:
    """(joints,) the delay of each joint by itself; 0 where it is not to be believed."""
    start = np.zeros(len(before))
    if np.any((before > _FAR * errors.whole) & (errors.whole > 0.0)):
        start = errors.scanned(before)
    own = errors.refined(start, together=False)
    left = errors.sums(own)
    told = (np.abs(own) >= _TOLD * step) & (left <= _BELIEVED * before)
    return np.where(told & (left < _CLEAR * errors.whole), own, 0.0)


class _Errors:
    """Differences between window means and quotients, by joint, for delays that are taken out."""

    def __init__(self, pieces: Sequence[Piece], column: Column, lower: str, cutoff: float) -> None:
        self._pieces, self._levels, self._cutoff = pieces, (column, lower), cutoff
        joints = getattr(pieces[0], lower).shape[1]
        quotient, _, _ = self._parts(np.zeros(joints))
        self.size = size_of(quotient)
        self.whole = np.sum(np.abs(quotient), axis=0)

    def _parts(self, delay: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        found = [windows_of(piece, *self._levels, self._cutoff, delay) for piece in self._pieces]
        parts = [(part.quotient, part.error, part.slope) for part in found]
        quotient, error, slope = (np.concatenate(own) for own in zip(*parts, strict=True))
        return quotient, error, slope

    def sums(self, delay: np.ndarray) -> np.ndarray:
        """(joints,) of the absolute differences."""
        return np.asarray(np.sum(np.abs(self._parts(delay)[1]), axis=0))

    def scanned(self, before: np.ndarray) -> np.ndarray:
        """(joints,) the best of delays in steps of 5 ms."""
        best, least = np.zeros(len(before)), before.copy()
        for candidate in np.arange(_EARLIEST, _LATEST + 0.5 * _STEP, _STEP):
            sums = self.sums(np.full(len(before), candidate))
            better = sums < least
            best[better], least[better] = candidate, sums[better]
        return best

    def refined(self, delay: np.ndarray, together: bool) -> np.ndarray:
        """(joints,) the delays after a few steps of least absolute values, error + delay slope."""
        kept = self.size > 0.0
        groups = [kept] if together else [np.eye(len(kept), dtype=bool)[j] & kept
                                          for j in np.flatnonzero(kept)]  # fmt: skip
        delay = delay.copy()
        for _ in range(_TURNS):
            _, error, slope = self._parts(delay)
            for group in groups:
                e, v = error[:, group] / self.size[group], slope[:, group] / self.size[group]
                there = v != 0.0
                if there.any():
                    move = weighted_median(-e[there] / v[there], np.abs(v[there]))
                    delay[group if not together else slice(None)] += move
        return delay
