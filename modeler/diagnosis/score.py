"""Is a change of a model for the better? The one rule of `diagnose`, `add` and `auto`.

A change is kept, or stated as missing, if the error that is printed for it falls as printed on
blocks of time that were not fitted, by more than two standard errors of the paired differences.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.table import format_error_pair
from modeler.diagnosis.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class Residuals:
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
class ErrorChange:
    """One joint before and after, or some of them together.

    Attributes:
        joint: name.
        before, after: relative error on unseen motion; NaN where none is known.
        scatter: fall of the error in blocks of time over the standard error of that.
    """

    joint: str
    before: float
    after: float
    t_ratio: float

    @property
    def is_different(self) -> bool:
        """True if the two printed numbers differ."""
        return len(set(format_error_pair(self.before, self.after))) > 1

    @property
    def is_reduced(self) -> bool:
        """True if the error surely falls."""
        return (
            self.t_ratio > THRESHOLDS.max_chance_t
            and self.is_different
            and self.after < self.before
        )

    @property
    def is_increased(self) -> bool:
        """True if it surely rises."""
        return (
            self.t_ratio < -THRESHOLDS.max_chance_t
            and self.is_different
            and self.after > self.before
        )

    @property
    def variance_reduction(self) -> float:
        """Fall of the squared error, as a share of it."""
        return 1.0 - (self.after / self.before) ** 2 if self.before > 0.0 else 0.0

    @property
    def error_ratio(self) -> float:
        """After over before."""
        return max(self.after, THRESHOLDS.negligible_error) / max(
            self.before, THRESHOLDS.negligible_error
        )


@dataclass(frozen=True)
class Score:
    """Of a change of a model.

    Attributes:
        joints: those with rows and torque.
        whole: the error that is printed for the change: root mean square over joints.
    """

    joints: tuple[ErrorChange, ...]
    whole: ErrorChange

    @property
    def is_better(self) -> bool:
        """True if the printed error surely falls, and no joint is spoilt.

        Or if that of a joint surely falls by more than its noise, and none rises: what other
        effects leave of other joints may be more than all of it.
        """
        is_reduced = any(
            change.is_reduced and change.error_ratio < 1.0 / THRESHOLDS.min_spoiling_ratio
            for change in self.joints
        )
        mends = is_reduced and not any(change.is_increased for change in self.joints)
        return mends or (self.whole.is_reduced and not self.has_spoilt_joint)

    @property
    def has_spoilt_joint(self) -> bool:
        """True if the error of a joint surely rises by more than its noise."""
        return any(
            change.is_increased and change.error_ratio > THRESHOLDS.min_spoiling_ratio
            for change in self.joints
        )

    @property
    def errors(self) -> dict[str, tuple[float, float]]:
        """Before and after, by joint."""
        return {change.joint: (change.before, change.after) for change in self.joints}

    @property
    def changed_joints(self) -> tuple[str, ...]:
        """Joints whose error falls or rises."""
        return tuple(
            change.joint for change in self.joints if change.is_reduced or change.is_increased
        )


def score_change(
    before: Residuals,
    after: Residuals,
    weights: Mapping[str, float] | None = None,
    block: float = 0.0,
) -> Score:
    """The score of a change.

    With S_jb and T_jb the sums of the squared residuals of joint j over block b of time, before and
    after, and Y_j those of its torque over all B blocks, the squared relative errors of the joint
    are sum_b S_jb / Y_j and sum_b T_jb / Y_j;
    the errors of a block sqrt(S_jb / Y_j) and sqrt(T_jb / Y_j), and d_b is their difference (of
    the squares, a few blocks of fast motion would be all that counts): blocks are paired, and
    residuals are coloured within them but not beyond, so the standard error of sum_b d_b is
    `sqrt(B / (B - 1) sum_b (d_b - mean)^2)`. The whole is the weighted mean of the squares over
    joints, in every block as in all.

    Args:
        before: residuals of the model without the change.
        after: with it, on the same logs.
        weights: of the joints, by name; None: the same of all.
        block: s; 0: half a second, longer where logs are long.
    """
    by_block = _build_block_function(before, block)
    old, new = compute_errors(before), compute_errors(after)
    shares = {
        name: (by_block(before, j), by_block(after, j))
        for j, name in enumerate(before.names)
        if name in old and name in new
    }
    changes = tuple(
        ErrorChange(name, old[name], new[name], compute_t_ratio(np.sqrt(a) - np.sqrt(b)))
        for name, (a, b) in shares.items()
    )
    share = {name: 1.0 if weights is None else weights.get(name, 0.0) for name in shares}
    total = sum(share.values())
    if not total > 0.0:
        return Score(changes, ErrorChange("", math.nan, math.nan, 0.0))
    first, last = (
        math.sqrt(sum(share[name] * of[name] ** 2 for name in shares) / total) for of in (old, new)
    )
    a, b = (
        np.sqrt(
            np.sum([share[name] * joint_shares[k] for name, joint_shares in shares.items()], axis=0)
        )
        for k in (0, 1)
    )
    return Score(changes, ErrorChange("", first, last, compute_t_ratio(a - b)))


def compute_t_ratio(differences: np.ndarray) -> float:
    """The sum of differences (blocks,) over its standard error; 0 of fewer than two blocks."""
    count = len(differences)
    spread = float(np.std(differences)) * count / math.sqrt(max(1, count - 1))
    total = float(np.sum(differences))
    return total / max(spread, 1e-9 * abs(total), 1e-300) if count > 1 else 0.0


def compute_rms_error(errors: Iterable[float]) -> float:
    """Root mean square of relative errors over joints."""
    values = list(errors)
    return float(np.sqrt(np.mean(np.square(values)))) if values else 0.0


def compute_errors(residuals: Residuals) -> dict[str, float]:
    """Relative error of every joint that has a torque."""
    sizes = [
        (float(np.linalg.norm(e)), float(np.linalg.norm(y)))
        for e, y in zip(residuals.residual, residuals.torque, strict=True)
    ]
    return {name: e / y for name, (e, y) in zip(residuals.names, sizes, strict=True) if y > 0.0}


def format_error_changes(joints: Mapping[str, tuple[float, float]], changed: Sequence[str]) -> str:
    """The errors that change: "joint 7 11.4 % -> 7.1 %; joint 2 rises, 3 % -> 3.2 %".

    Args:
        joints: error before and after, by joint.
        changed: joints whose error falls or rises.
    """
    pairs = {name: " -> ".join(format_error_pair(*joints[name])) for name in changed}
    rising = [name for name in changed if joints[name][1] > joints[name][0]]
    parts = [
        ", ".join(f"joint {name} {text}" for name, text in pairs.items() if name not in rising)
    ]
    parts += [f"joint {name} rises, {pairs[name]}" for name in rising]
    if len(changed) < len(joints):
        parts.append("other joints unchanged" if changed else "no joint changes")
    return "; ".join(part for part in parts if part)


def explain_no_improvement(
    joints: Mapping[str, tuple[float, float]], changed: Sequence[str]
) -> str:
    """Why a change is none for the better, of errors as for `format_error_changes`."""
    changes, errors = (
        format_error_changes(joints, changed),
        list(zip(*joints.values(), strict=True)),
    )
    if any(
        ErrorChange(name, *joints[name], 0.0).error_ratio > THRESHOLDS.min_spoiling_ratio
        for name in changed
    ):
        return f"the error rises: {changes}"
    total = " -> ".join(format_error_pair(*map(compute_rms_error, errors)))
    return f"the error does not fall by more than chance: {total} over all joints; {changes}"


def _build_block_function(logs: Residuals, block: float) -> Callable[[Residuals, int], np.ndarray]:
    """The function that gives the squared residuals of a joint, over its squared torque, by block.

    Blocks of that many s, of 0 half a second, longer where logs are long; the same for all models
    that see the same logs.
    """
    run, time = np.concatenate(logs.run), np.concatenate(logs.time)
    spans = {int(r): (time[run == r].min(), time[run == r].max()) for r in np.unique(run)}
    length = float(
        block
        or max(
            THRESHOLDS.block_duration, sum(b - a for a, b in spans.values()) / THRESHOLDS.max_blocks
        )
    )
    count, ends = 0, {}
    for r, (a, b) in spans.items():  # numbers of the first and the last block of a log
        last = count + int((b - a) / length)
        ends[r], count = (count, last), last + 1

    def compute_shares(residuals: Residuals, j: int) -> np.ndarray:
        number = np.zeros(len(residuals.run[j]), dtype=int)
        for r, (start, _) in spans.items():
            is_in_log = residuals.run[j] == r
            since = np.floor((residuals.time[j][is_in_log] - float(start)) / length).astype(int)
            number[is_in_log] = np.clip(ends[r][0] + since, *ends[r])
        size = float(residuals.torque[j] @ residuals.torque[j])
        return np.bincount(number, residuals.residual[j] ** 2, count) / size

    return compute_shares
