"""Are the logged velocities and accelerations the derivatives of what they claim?"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.core.errors import DataError
from modeler.logs import describe_clock_factor, find_common_factor, is_derivative, is_moving
from modeler.numerics.channels import estimate_channel_noise
from modeler.numerics.least_squares import compute_weighted_median
from modeler.numerics.noise import estimate_robust_deviation, estimate_white_noise
from modeler.regression.log import Log, RawSegment
from modeler.regression.thresholds import THRESHOLDS

# Means of a logged derivative and difference quotients of what it derives from, over windows.


Column = Literal["qd", "qdd"]


@dataclass(frozen=True, eq=False)
class DerivativeWindows:
    """Window means of one piece: logged derivative and difference quotient, (n - 2m, joints)."""

    time: np.ndarray
    step: float
    half: int
    logged: np.ndarray
    quotient: np.ndarray
    slope: np.ndarray  # of the logged derivative, for its delay

    @property
    def error(self) -> np.ndarray:
        """Returns the logged derivative less the difference quotient, by window and joint."""
        return self.logged - self.quotient


def build_windows(
    piece: RawSegment, column: Column, lower: str, cutoff: float, delay: np.ndarray
) -> DerivativeWindows:
    """Returns the windows of one period of the parallel filter, 7 samples at least.

    Args:
        piece: with the column logged.
        column: of the logged derivative.
        lower: of what it derives from.
        cutoff: of the parallel filter, Hz; 0: windows of 7 samples.
        delay: (joints,) s by which the logged derivative is late, taken out.
    """
    below, logged = getattr(piece, lower), getattr(piece, column)
    if delay.any():
        logged = np.column_stack(
            [np.interp(piece.time + d, piece.time, v) for d, v in zip(delay, logged.T, strict=True)]
        )
    half = max(THRESHOLDS.min_half_window, round(0.5 / (cutoff * piece.step)) if cutoff else 0)
    half = min(half, (len(piece.time) - 1) // 2)
    length = 2 * half * piece.step
    trapezoids = 0.5 * piece.step * (logged[1:] + logged[:-1])
    integral = np.concatenate([np.zeros((1, logged.shape[1])), np.cumsum(trapezoids, axis=0)])
    signals = integral, below, logged
    mean, quotient, slope = ((v[2 * half :] - v[: -2 * half]) / length for v in signals)
    return DerivativeWindows(piece.time[half:-half], piece.step, half, mean, quotient, slope)


def compute_size(values: np.ndarray) -> np.ndarray:
    """Returns (joints,) of (n, joints): root mean square weighted by energy, not by rests."""
    total = np.sum(values**2, axis=0)
    return np.sqrt(np.sum(values**4, axis=0) / np.where(total > 0.0, total, 1.0))


# Logged velocities and accelerations that come late, of one joint or of all alike.


AS_LOGGED = "used as logged; fit with --derivatives position to avoid it"
POSITIONS = "the positions are differentiated instead"


_EARLIEST, _LATEST = -0.05, 0.2  # s


@dataclass(frozen=True)
class DerivativeDelay:
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

    def describe(self, used: str) -> str:
        """Returns the delay as text, with what becomes of the column."""
        way = "lags behind" if self.seconds > 0.0 else "runs ahead of"
        whose = "in all joints" if self.column in ("qd", "qdd") else "and not all joints do"
        return (
            f"{self.column} {way} the derivative of {self.of} by {abs(self.seconds):.3g} s "
            f"({abs(self.samples):.2g} samples) {whose}; {used}"
        )


def estimate_delays(
    pieces: Sequence[RawSegment], joints: Sequence[str], column: Column, lower: str, cutoff: float
) -> tuple[list[DerivativeDelay], np.ndarray]:
    """Returns what is late, and (joints,) s by which each column is; 0 if small or unknown.

    A delay is that which makes the sum of the absolute differences least, between the window means
    of the logged derivative and the difference quotients. Gross errors of a few samples do not
    move it. It is believed where it halves that sum. That of all joints is the median of theirs,
    and given up if a joint is the worse for it.

    Args:
        pieces: with the column logged.
        joints: names.
        column: of the logged derivative.
        lower: of what it derives from.
        cutoff: of the parallel filter, Hz.
    """
    errors = _DelayErrors(pieces, column, lower, cutoff)
    none, step = np.zeros(len(joints)), pieces[0].step
    before = errors.sum_errors(none)
    far = np.any((before > THRESHOLDS.scanned_disagreement * errors.whole) & (errors.whole > 0.0))
    delays = errors.refine_delays(errors.scan_delays(before) if far else none)
    left = errors.sum_errors(delays)
    median = np.median(delays[errors.size > 0.0]) if errors.size.any() else 0.0
    common = np.full(len(joints), median)
    together = errors.sum_errors(common)
    is_significant = (np.abs(delays) >= THRESHOLDS.min_delay_steps * step) & (
        left <= THRESHOLDS.max_delayed_error * before
    )
    is_significant &= left < THRESHOLDS.max_single_error * errors.whole
    delays = np.where(is_significant, delays, 0.0)
    halves = together.sum() <= THRESHOLDS.max_delayed_error * before.sum()
    halves = halves and abs(common[0]) >= THRESHOLDS.min_delay_steps * step
    if halves and np.all(together <= 2.0 * errors.sum_errors(delays)):
        mean = float(before.sum() / max(float(errors.whole.sum()), 1e-300))
        return [DerivativeDelay(column, lower, common[0], common[0] / step, mean)], common
    share = before / np.maximum(errors.whole, 1e-300)
    late = []
    for j in map(int, np.flatnonzero(delays)):
        names = f"{column}{joints[j]}", f"{lower}{joints[j]}"
        late.append(DerivativeDelay(*names, delays[j], delays[j] / step, float(share[j])))
    return late, delays


class _DelayErrors:
    """Differences between window means and quotients, by joint, for delays that are taken out."""

    def __init__(
        self, pieces: Sequence[RawSegment], column: Column, lower: str, cutoff: float
    ) -> None:
        self._pieces, self._levels, self._cutoff = pieces, (column, lower), cutoff
        quotient, _, _ = self._collect_parts(np.zeros(getattr(pieces[0], lower).shape[1]))
        self.size = compute_size(quotient)
        self.whole = np.sum(np.abs(quotient), axis=0)

    def _collect_parts(self, delay: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        levels, cutoff = self._levels, self._cutoff
        windows = [build_windows(piece, *levels, cutoff, delay) for piece in self._pieces]
        parts = [(part.quotient, part.error, part.slope) for part in windows]
        quotient, error, slope = (np.concatenate(group) for group in zip(*parts, strict=True))
        return quotient, error, slope

    def sum_errors(self, delay: np.ndarray) -> np.ndarray:
        """Returns (joints,) of the absolute differences."""
        return np.asarray(np.sum(np.abs(self._collect_parts(delay)[1]), axis=0))

    def scan_delays(self, before: np.ndarray) -> np.ndarray:
        """Returns (joints,) the best of delays in steps of 5 ms."""
        best, least = np.zeros(len(before)), before.copy()
        for candidate in np.arange(
            _EARLIEST, _LATEST + 0.5 * THRESHOLDS.delay_scan_step, THRESHOLDS.delay_scan_step
        ):
            sums = self.sum_errors(np.full(len(before), candidate))
            better = sums < least
            best[better], least[better] = candidate, sums[better]
        return best

    def refine_delays(self, delay: np.ndarray) -> np.ndarray:
        """Returns (joints,) the delays after a few steps of least absolute values."""
        delay = delay.copy()
        for _ in range(THRESHOLDS.delay_iterations):
            _, error, slope = self._collect_parts(delay)
            for j in np.flatnonzero(self.size):
                there = slope[:, j] != 0.0
                e, v = error[there, j], slope[there, j]
                delay[j] += compute_weighted_median(-e / v, np.abs(v)) if v.size else 0.0
        return delay


_DEGREES = 180.0 / np.pi
_CAUSES = ((_DEGREES, "is it in degrees?"), (1.0 / _DEGREES, "is it the position in degrees?"))


@dataclass(frozen=True)
class Contradiction:
    """A logged column that disagrees with the signal it is the derivative of, at times.

    Attributes:
        column: of the log, "qdd4".
        of: the column it should be the derivative of, "qd4".
        samples: where it disagrees.
        limit: disagreement that is tolerated, in the column's unit.
        largest: disagreement.
        time: of the largest, s.
    """

    column: str
    of: str
    samples: int
    limit: float
    largest: float
    time: float

    def format_line(self) -> str:
        """Returns the contradiction as text."""
        return (
            f"{self.column}: {self.samples} samples disagree with the difference quotient of "
            f"{self.of} by more than {self.limit:.3g}, at worst {self.largest:.3g} at "
            f"{self.time:.2f} s"
        )


@dataclass(frozen=True, eq=False)
class DerivativeCheck:
    """What the check of one log found.

    Attributes:
        bad: (n,) True at contradicted samples, for each piece.
        contradictions: by column.
        late: delays.
        used: what becomes of late columns, in words.
    """

    bad: tuple[np.ndarray, ...]
    contradictions: tuple[Contradiction, ...]
    delays: tuple[DerivativeDelay, ...] = ()
    used: str = AS_LOGGED

    @property
    def notes(self) -> tuple[str, ...]:
        """Returns the delays that were found, one sentence each."""
        return tuple(late.describe(self.used) for late in self.delays)

    @property
    def is_harmful(self) -> bool:
        """Returns True if a delay is large enough to spoil what is made of the column."""
        return any(late.share > THRESHOLDS.max_delay_share for late in self.delays)


def discard_contradictions(check: DerivativeCheck, pieces: Sequence[RawSegment]) -> DerivativeCheck:
    """Returns the check where positions are differentiated: delays, and no contradictions."""
    bad = tuple(np.zeros(len(piece.time), dtype=bool) for piece in pieces)
    return DerivativeCheck(bad, (), check.delays, POSITIONS)


def check_derivatives(
    log: Log, pieces: Sequence[RawSegment], parallel_cutoff: float, refuse: bool = True
) -> DerivativeCheck:
    """Returns which samples of a log carry a velocity or acceleration that cannot be.

    Over every window of T = 1 / parallel_cutoff (7 samples at least) the mean of a derivative is,
    exactly, the change of what it is the derivative of:

        mean(qd) = (q(t + T/2) - q(t - T/2)) / T,  mean(qdd) = (qd(t + T/2) - qd(t - T/2)) / T,

    so both sides are smoothed alike and neither steps of the time nor of the resolution grow in
    it. A sample is contradicted where the two sides of its window (at the ends of a piece: of the
    nearest whole window) differ by more than the largest of
    - 8 robust standard deviations (1.4826 median) of that joint's differences over the log,
    - a quarter of the joint's derivative, sqrt(sum d^4 / sum d^2): its size while it moves,
    - 5 resolution steps of the lower signal, divided by T.
    Noise and rounding stay below the first and the last, discretisation below the second. A delay
    of a joint, or of all alike, is taken out before and reported from 3/4 of a sample on.

    Args:
        log: as read: resampling hides the resolution of its columns.
        pieces: its uniform pieces, with logged qd and possibly qdd.
        parallel_cutoff: Hz; 0: windows of 7 samples.
        refuse: a column that is wrong throughout is an error; otherwise all its samples may pass.

    Raises:
        DataError: a column that disagrees by half and more wherever its joint moves.
    """
    bad = [np.zeros(len(piece.time), dtype=bool) for piece in pieces]
    contradictions: list[Contradiction] = []
    late: list[DerivativeDelay] = []
    levels: tuple[tuple[Column, str], ...] = (("qd", "q"), ("qdd", "qd"))
    models = log.channel_models
    for column, lower in levels:
        if not pieces or getattr(pieces[0], column) is None:
            break
        found_late, delay = estimate_delays(pieces, log.joints, column, lower, parallel_cutoff)
        late += found_late
        windows = [build_windows(piece, column, lower, parallel_cutoff, delay) for piece in pieces]
        steps = np.array([one.step for one in models[lower]])
        if refuse:
            noise = [list(map(estimate_white_noise, getattr(piece, lower).T)) for piece in pieces]
            noises = np.maximum(steps, np.median(noise, axis=0))
            _refuse_wrong(log, column, lower, windows, noises)
        for j, joint in enumerate(log.joints):
            flags, limit = _find_contradicted(windows, steps[j], j)
            pairs = zip(flags, windows, strict=True)
            masks = [np.pad(flag, part.half, mode="edge") for flag, part in pairs]
            for mask, values in zip(bad, masks, strict=True):
                mask |= values
            if np.any(np.concatenate(flags)):
                error = np.concatenate([np.abs(part.error[:, j]) for part in windows])
                worst = int(np.argmax(np.where(np.concatenate(flags), error, 0.0)))
                time = np.concatenate([part.time for part in windows])
                names, samples = (f"{column}{joint}", f"{lower}{joint}"), sum(map(np.sum, masks))
                largest, at = float(error[worst]), float(time[worst])
                contradictions.append(Contradiction(*names, int(samples), limit, largest, at))
    return DerivativeCheck(tuple(bad), tuple(contradictions), tuple(late))


def _find_contradicted(
    windows: Sequence[DerivativeWindows], resolution: float, j: int
) -> tuple[list[np.ndarray], float]:
    """Returns windows of joint j beyond the limit, by piece, and the limit of a full window."""
    full = max(part.half for part in windows)
    # A piece too short for the full window has the more noise in its quotients.
    noisier = [full / part.half for part in windows]
    scaled = [part.error[:, j] / n for part, n in zip(windows, noisier, strict=True)]
    scatter = estimate_robust_deviation(np.concatenate(scaled))
    size = float(compute_size(np.concatenate([part.quotient[:, [j]] for part in windows]))[0])
    length = 2 * full * windows[0].step
    random = max(
        THRESHOLDS.contradiction_sigmas * scatter,
        THRESHOLDS.contradiction_steps * resolution / length,
    )
    flags = [
        np.abs(part.error[:, j]) > max(THRESHOLDS.contradiction_share * size, random * n)
        for part, n in zip(windows, noisier, strict=True)
    ]
    return flags, max(THRESHOLDS.contradiction_share * size, random)


def _refuse_wrong(
    log: Log, column: Column, lower: str, windows: Sequence[DerivativeWindows], noise: np.ndarray
) -> None:
    """Raises DataError if a column is no derivative of the one below it at all.

    One factor on the speeds of all joints is that of the clock. `noise` (J,) is that of the lower
    signals, their resolution included; a joint that moves less has nothing to compare with.
    """
    quotients = np.concatenate([part.quotient for part in windows])
    logged = np.concatenate([part.logged for part in windows])
    size = compute_size(quotients)
    length = 2 * min(part.half for part in windows) * windows[0].step
    places = map(int, np.flatnonzero(size))
    gains = {j: _estimate_gain(logged[:, j], quotients[:, j]) for j in places}
    used = [(j, logged[:, j] / gain, quotients[:, j]) for j, gain in gains.items() if gain]
    most = THRESHOLDS.max_column_error
    scaled = {j for j, values, other in used if _compute_misfit(values, other, size[j]) < most}
    like = [gain for j, gain in gains.items() if j in scaled and gain > 0.0]
    factor = find_common_factor(like) if len(like) > max(1.0, 0.5 * len(gains)) else None
    if column == "qd" and factor is not None and abs(factor - 1.0) > THRESHOLDS.max_column_error:
        raise DataError(
            f"{log.name}: {describe_clock_factor(factor, 1.0 / log.step)}; or fit with "
            "--derivatives "
            "position, which believes the clock"
        )
    for j in map(int, np.flatnonzero(size * length > THRESHOLDS.min_signal_to_noise * noise)):
        others = zip(quotients.T, size, strict=True)
        misfits = [_compute_misfit(logged[:, j], *other) for other in others]
        both = getattr(log, lower)[:, j], getattr(log, column)[:, j], log.time
        near = abs(gains[j] - 1.0) < THRESHOLDS.contradiction_share and is_derivative(
            *both
        )  # it is coarse, and no more
        if misfits[j] <= THRESHOLDS.max_column_error or near or not is_moving(both[0]):
            continue
        other = int(np.argmin(misfits))
        if other != j and misfits[other] < 0.5 * THRESHOLDS.max_column_error:
            guess = f"it is that of {lower}{log.joints[other]}: are columns exchanged?"
        elif j in scaled:
            known = (words for factor, words in _CAUSES if abs(abs(gains[j] / factor) - 1.0) < 0.1)
            cause = next(known, "is it in another unit, or on the motor's side of the gear?")
            cause = "is its sign swapped?" if abs(gains[j] + 1.0) < 0.1 else cause
            guess = f"it is {gains[j]:.3g} times that: {cause}"
        else:
            guess = f"it follows no {lower}"
        name = log.joints[j]
        raise DataError(
            f"{log.name}: {column}{name} is not the derivative of {lower}{name}; {guess}; "
            "correct the column, or fit with --derivatives position, which differentiates q"
        )


def _estimate_gain(logged: np.ndarray, quotient: np.ndarray) -> float:
    """Returns what a logged derivative is times the difference quotient."""
    there = quotient != 0.0
    return compute_weighted_median(logged[there] / quotient[there], np.abs(quotient[there]))


def _compute_misfit(logged: np.ndarray, quotient: np.ndarray, size: float) -> float:
    """Returns mean absolute disagreement as a share of the quotient's, while either moves."""
    moving = np.maximum(np.abs(logged), np.abs(quotient)) > THRESHOLDS.contradiction_share * size
    total = float(np.sum(np.abs(quotient[moving])))
    return float(np.sum(np.abs(logged - quotient)[moving])) / total if total else float("inf")


def is_position_quieter(pieces: Sequence[RawSegment], cutoff: float) -> bool:
    """Returns True if the differentiated position is quieter than the logged velocity.

    White noise of standard deviation s_q on the position, through the position filter of cut-off
    f, is noise of (2 pi f) s_q / sqrt(3) on the velocity. A lattice of step s is noise of
    s / sqrt(12). Only joints that move count.

    Args:
        pieces: with logged velocities, of all logs.
        cutoff: of the position filter, Hz.
    """
    moved, logged = [], []
    for piece in pieces:
        if piece.qd is None or piece.qdd is not None or len(piece.time) < 8:
            return False
        gain = 2.0 * np.pi * min(cutoff, 0.5 / piece.step) / np.sqrt(3.0)
        moved.append([gain * estimate_channel_noise(column) for column in piece.q.T])
        logged.append([estimate_channel_noise(column) for column in piece.qd.T])
    if not logged:
        return False
    travel = np.ptp(np.concatenate([piece.q for piece in pieces]), axis=0)
    steps = np.max([piece.q_step or np.zeros_like(travel) for piece in pieces], axis=0)
    moves = travel > THRESHOLDS.contradiction_steps * steps
    noisier = np.median(logged, axis=0) > THRESHOLDS.max_noise_ratio * np.median(moved, axis=0)
    return bool(moves.any() and np.mean(noisier[moves]) > 0.5)
