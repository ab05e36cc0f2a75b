"""Did a change of a model lower the error on motion that it was not fitted to? On which joints?"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from modeler.diagnose.blocks import BLOCK, MOST
from modeler.improve.unseen import Unseen

CHANCE = 0.05
"""Probability with which an error that stays seems to change."""

FELT = 0.01
"""Share of an error by which it must change to be worth a word."""

LEAST = 1e-3
"""Relative errors below are as good as none."""

WORSE = math.sqrt(2.0)
"""Ratio of the errors of a joint from which on more comes on top than its own noise."""


@dataclass(frozen=True)
class Change:
    """One joint before and after, or all of them.

    Attributes:
        joint: name.
        before, after: relative error on unseen motion.
        sure: True if the change stands out of its scatter over blocks of time.
    """

    joint: str
    before: float
    after: float
    sure: bool

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
        whole: all of them, the error before as 1: geometric means, so that each counts in units of
            its own error.
    """

    joints: tuple[Change, ...]
    whole: Change

    @property
    def better(self) -> bool:
        """True if a joint surely falls, the whole with it, and no joint rises beyond its noise.

        The whole must surely fall too if another joint surely rises.
        """
        falls = any(change.falls for change in self.joints) and self.whole.ratio < 1.0
        rises = any(change.rises for change in self.joints)
        return falls and (self.whole.sure or not rises) and not self.spoilt

    @property
    def spoilt(self) -> bool:
        """True if the error of a joint rises by more than its noise."""
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
    same with sum_j u_jb. A change is sure if it exceeds t standard deviations, t of Student's
    distribution for B blocks.

    Args:
        before: residuals of the model without the change.
        after: with it, on the same logs.
    """
    grid = _Grid.of(before)
    changes, whole, shares = [], 0.0, np.zeros(grid.blocks)
    for j, name in enumerate(before.names):
        sizes = [float(np.mean(seen.torque[j] ** 2)) if seen.torque[j].size else 0.0
                 for seen in (before, after)]  # fmt: skip
        if min(sizes) == 0.0:
            continue
        old, new = (grid.sums(seen, j) for seen in (before, after))
        errors = [
            float(np.sqrt(np.mean(seen.residual[j] ** 2) / size))
            for seen, size in zip((before, after), sizes, strict=True)
        ]
        left = [max(error, LEAST) for error in errors]
        change = 2.0 * math.log(left[0] / left[1])
        share = old / max(float(old.sum()), 1e-300) - new / max(float(new.sum()), 1e-300)
        blocks = int(np.count_nonzero(old))
        changes.append(Change(name, errors[0], errors[1], _sure(change, share, blocks)))
        whole, shares = whole + change, shares + share
    sure = _sure(whole, shares, grid.blocks)
    mean = 0.5 * whole / max(1, len(changes))
    return Score(tuple(changes), Change("", 1.0, math.exp(-mean), sure))


def _sure(change: float, shares: np.ndarray, blocks: int) -> bool:
    """True if a change stands out of its scatter over blocks."""
    if blocks < 2:
        return False
    spread = float(np.sqrt(blocks / (blocks - 1) * np.sum(shares**2)))
    return abs(change) > float(student.ppf(1.0 - 0.5 * CHANCE, blocks - 1)) * spread


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
