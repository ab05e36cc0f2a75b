"""Did a change of a model lower the error on motion that it was not fitted to? On which joints?"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.hypotheses.blocks import BLOCK, MOST

SURE = 2.0
"""Standard errors beyond which a change is sure."""

FELT = 0.01
"""Share of an error by which it must change to be worth a word."""

LEAST = 1e-3
"""Relative errors below are as good as none."""

WORSE = math.sqrt(2.0)
"""Ratio of the errors of a joint from which on more comes on top than its own noise."""


@dataclass(frozen=True, eq=False)
class Unseen:
    """Rows of every joint that count; J joints.

    Attributes:
        names: of the joints.
        residual: (rows_j,) by joint, measured minus predicted torque, N m or N.
        torque: (rows_j,) by joint, measured.
        time: (rows_j,) by joint, s.
        run: (rows_j,) by joint, index of the log.
    """

    names: tuple[str, ...]
    residual: tuple[np.ndarray, ...]
    torque: tuple[np.ndarray, ...]
    time: tuple[np.ndarray, ...]
    run: tuple[np.ndarray, ...]


@dataclass(frozen=True)
class Change:
    """One joint before and after, or all of them.

    Attributes:
        joint: name.
        before, after: relative error on unseen motion.
        scatter: change over its standard error, from blocks of time; positive where the error
            falls.
    """

    joint: str
    before: float
    after: float
    scatter: float

    @property
    def sure(self) -> bool:
        """True if the change is more than chance."""
        return abs(self.scatter) > SURE

    @property
    def falls(self) -> bool:
        """True if the error surely falls."""
        return self.sure and self.ratio < 1.0 - FELT

    @property
    def rises(self) -> bool:
        """True if it surely rises."""
        return self.sure and self.ratio > 1.0 + FELT

    @property
    def ratio(self) -> float:
        """After over before."""
        return max(self.after, LEAST) / max(self.before, LEAST)


@dataclass(frozen=True)
class Score:
    """Of a change of a model.

    Attributes:
        joints: those with rows and torque.
        whole: product over them, so that each counts in units of its own error; 1 before.
    """

    joints: tuple[Change, ...]
    whole: Change

    @property
    def better(self) -> bool:
        """True if the whole falls by more than its standard error, or a joint surely falls.

        The latter counts if none surely rises and the whole falls at all; neither, if a joint is
        spoilt.
        """
        shown = any(c.scatter > 1.0 and c.ratio < 1.0 - FELT for c in self.joints)
        alone = any(c.falls for c in self.joints) and not any(c.rises for c in self.joints)
        falls = (shown and self.whole.scatter > 1.0) or (alone and self.whole.ratio < 1.0)
        return falls and not self.spoilt

    @property
    def spoilt(self) -> bool:
        """True if the error of a joint surely rises by more than its noise."""
        return any(change.rises and change.ratio > WORSE for change in self.joints)

    @property
    def errors(self) -> dict[str, tuple[float, float]]:
        """Before and after, by joint."""
        return {change.joint: (change.before, change.after) for change in self.joints}

    @property
    def most(self) -> Change:
        """The joint whose error changes most."""
        return max(self.joints, key=lambda change: abs(math.log(change.ratio)))

    @property
    def changed(self) -> tuple[str, ...]:
        """Joints whose error falls or rises."""
        return tuple(change.joint for change in self.joints if change.falls or change.rises)


def scored(before: Unseen, after: Unseen) -> Score:
    """The score of a change.

    S_jb and T_jb are the sums of the squared residuals of joint j over block b of time, before and
    after; S_j and T_j those over all B blocks. The change of a joint is L_j = log(S_j / T_j),
    twice the logarithm of the ratio of its errors, so that each joint counts in units of its own
    noise. Blocks are paired, and residuals are coloured within them but not beyond: the variance
    of L_j is B / (B - 1) sum_b u_jb^2 with u_jb = S_jb / S_j - T_jb / T_j, that of sum_j L_j the
    same with sum_j u_jb.

    Args:
        before: residuals of the model without the change.
        after: with it, on the same logs.
    """
    grid = _Grid.of(before)
    old, new = errors_of(before), errors_of(after)
    changes, shares = [], np.zeros(grid.blocks)
    for j, name in enumerate(before.names):
        if name not in old or name not in new:
            continue
        sums = [grid.sums(seen, j) for seen in (before, after)]
        share = np.subtract(*(of / max(float(of.sum()), 1e-300) for of in sums))
        blocks = int(np.count_nonzero(sums[0]))
        changes.append(_judged(name, old[name], new[name], share, blocks))
        shares += share
    mean = math.exp(sum(math.log(c.ratio) for c in changes))
    return Score(tuple(changes), _judged("", 1.0, mean, shares, grid.blocks))


def _judged(name: str, before: float, after: float, shares: np.ndarray, blocks: int) -> Change:
    """A change whose scatter over blocks has the shares u_b."""
    log = 2.0 * math.log(max(before, LEAST) / max(after, LEAST))
    spread = float(np.sqrt(np.sum(shares**2) * blocks / max(1, blocks - 1)))
    scatter = log / max(spread, 1e-9) if blocks > 1 else 0.0
    return Change(name, before, after, scatter)


def rms_error(errors: Iterable[float]) -> float:
    """Root mean square of relative errors over joints."""
    found = list(errors)
    return float(np.sqrt(np.mean(np.square(found)))) if found else 0.0


def errors_of(seen: Unseen) -> dict[str, float]:
    """Relative error of every joint that has a torque."""
    sizes = [(float(np.linalg.norm(e)), float(np.linalg.norm(y)))
             for e, y in zip(seen.residual, seen.torque, strict=True)]  # fmt: skip
    return {name: e / y for name, (e, y) in zip(seen.names, sizes, strict=True) if y > 0.0}


def told(joints: Mapping[str, tuple[float, float]], changed: Sequence[str]) -> str:
    """The errors that change: "joint 7 11.4 -> 7.1 %; joint 2 rises, 3 -> 3.2 %".

    Args:
        joints: error before and after, by joint.
        changed: joints whose error falls or rises.
    """
    pairs = {name: "{:.3g} -> {:.3g} %".format(*(100.0 * e for e in joints[name]))
             for name in changed}  # fmt: skip
    rising = [name for name in changed if joints[name][1] > joints[name][0]]
    parts = [", ".join(f"joint {name} {text}" for name, text in pairs.items()
                       if name not in rising)]  # fmt: skip
    parts += [f"joint {name} rises, {pairs[name]}" for name in rising]
    if len(changed) < len(joints):
        parts.append("other joints unchanged" if changed else "no joint changes")
    return "; ".join(part for part in parts if part)


@dataclass(frozen=True, eq=False)
class _Grid:
    """Blocks of time, alike for all models that see the same logs."""

    start: Mapping[int, float]  # s, by log
    ends: Mapping[int, tuple[int, int]]  # numbers of its first and its last block, by log
    length: float  # s
    blocks: int

    @classmethod
    def of(cls, seen: Unseen) -> "_Grid":
        """Of half a second, longer where logs are long."""
        run, time = np.concatenate(seen.run), np.concatenate(seen.time)
        spans = {int(r): (time[run == r].min(), time[run == r].max()) for r in np.unique(run)}
        length = max(BLOCK, sum(b - a for a, b in spans.values()) / MOST)
        count, ends = 0, {}
        for r, (a, b) in spans.items():
            last = count + int((b - a) / length)
            ends[r], count = (count, last), last + 1
        return cls({r: float(a) for r, (a, _) in spans.items()}, ends, float(length), count)

    def sums(self, seen: Unseen, j: int) -> np.ndarray:
        """(blocks,) squared residuals of one joint."""
        number = np.zeros(len(seen.run[j]), dtype=int)
        for r, start in self.start.items():
            own = seen.run[j] == r
            since = np.floor((seen.time[j][own] - start) / self.length).astype(int)
            number[own] = np.clip(self.ends[r][0] + since, *self.ends[r])
        return np.bincount(number, seen.residual[j] ** 2, self.blocks)
