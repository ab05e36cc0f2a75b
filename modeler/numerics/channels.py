"""How the values of a sampled channel came about: lattice, sample-and-hold, noise, clipping."""

from dataclasses import dataclass

import numpy as np

from modeler.core.json import ShortRepr
from modeler.numerics.noise import estimate_white_noise
from modeler.numerics.thresholds import THRESHOLDS


@dataclass(frozen=True)
class Clip:
    """A value that a position does not pass, although its motion goes on.

    Attributes:
        value: that it stays at.
        upper: True if it is the largest, False if it is the smallest.
    """

    value: float
    upper: bool


@dataclass(frozen=True)
class ChannelModel(ShortRepr):
    """How a channel was sampled.

    Attributes:
        step: of the lattice that its values lie on, in its unit; 0: none.
        hold: rows for which each value is held; 1: none.
        period: s, between two of its own samples: `hold` usual time steps.
        noise: standard deviation of white noise or quantisation, the larger, in its unit.
        stay: samples for which it usually repeats one value, at most.
        missing: rows without a value.
        spread: between 1 % and 99 % of its values, in its unit.
        top_step: change from row to row that 98 % of the changes stay below, in its unit.
        clips: ends of its range at which it is cut off; none of a held channel.
    """

    step: float
    hold: int
    period: float
    noise: float
    stay: int
    missing: int
    spread: float
    top_step: float
    clips: tuple[Clip, ...]

    @property
    def is_held(self) -> bool:
        """Returns True if the channel is sampled more slowly than the rows."""
        return self.hold > 1

    @property
    def resolution(self) -> float:
        """Returns the change that is certainly no rounding: 5 steps of the lattice."""
        return THRESHOLDS.min_outlier_steps * self.step


def model_channel(time: np.ndarray, values: np.ndarray) -> ChannelModel:
    """Returns how a channel (n,) was sampled at the times (n,) of the rows, s."""
    known = np.isfinite(values)
    there, steps = values[known], np.diff(time)
    usual = float(np.median(steps[steps > 0.0])) if (steps > 0.0).any() else float("nan")
    step = estimate_lattice_step(there)
    hold = estimate_hold_length(there, step)
    noise = estimate_channel_noise(there if hold == 1 else there[_flag_changes(there)], step)
    low, high = np.quantile(there, THRESHOLDS.spread_quantiles) if len(there) else (0.0, 0.0)
    changes = np.abs(np.diff(there, prepend=there[:1]))
    return ChannelModel(
        step=step,
        hold=hold,
        period=hold * usual,
        noise=noise,
        stay=find_longest_usual_run(there),
        missing=int(len(values) - len(there)),
        spread=float(high - low),
        top_step=float(np.quantile(changes, THRESHOLDS.top_step_quantile)) if len(there) else 0.0,
        clips=find_clips(time, values, noise) if hold == 1 else (),
    )


def estimate_channel_noise(values: np.ndarray, step: float | None = None) -> float:
    """Returns noise or quantisation of a channel (n,), the larger, 1 sigma; 0 of a few samples.

    Args:
        values: of it, in order.
        step: of their lattice; None: it is estimated.
    """
    if len(values) < THRESHOLDS.min_channel_samples:
        return 0.0
    step = estimate_lattice_step(values) if step is None else step
    return max(step / float(np.sqrt(12.0)), estimate_white_noise(values))


_SINGLE = 2.4e-7  # of the largest value: two steps of single precision


def estimate_lattice_step(values: np.ndarray) -> float:
    """Estimates the step of the lattice that the values (n,) lie on; 0 without one.

    Least squares over small differences of neighbours, or of levels where neighbours are too far
    apart. Differences at the level of single precision are arithmetic.
    """
    there = values[np.isfinite(values)]
    rounding = _SINGLE * float(np.max(np.abs(there), initial=0.0))
    levels = np.unique(there)
    new = len(levels) / max(1, len(there))
    for gaps, share in ((np.abs(np.diff(there)), new), (np.diff(levels), 1.0)):
        step = _fit_lattice_step(gaps[gaps > rounding], share, rounding)
        if step > 4.0 * rounding:
            return step
    return 0.0


def _fit_lattice_step(gaps: np.ndarray, new: float, rounding: float) -> float:
    """Returns the least-squares step of differences (m,); 0 if they have none.

    Args:
        gaps: differences above the rounding.
        new: share of the values that are new; few differences do where it is small.
        rounding: of the values.
    """
    if not len(gaps):
        return 0.0
    least = float(np.quantile(gaps, 0.01, method="lower"))
    gaps = gaps[gaps < THRESHOLDS.max_lattice_steps * least]
    if len(gaps) < THRESHOLDS.min_lattice_gaps and new >= 0.1:
        return 0.0
    # differences of one size may be a constant speed, where no value comes again
    even = np.mean(np.round(gaps / least) == 1.0) >= THRESHOLDS.max_new_levels
    if even and new >= THRESHOLDS.max_new_levels:
        return 0.0
    for parts in (1, 2, 3):  # the least may be several steps
        whole = np.round(parts * gaps / least)
        step = float(whole @ gaps / (whole @ whole))
        off = float(np.quantile(np.abs(gaps - step * np.round(gaps / step)), 0.9))
        if off < THRESHOLDS.max_lattice_deviation * step + rounding:
            return step
    return 0.0


# Values that stay: held channels, repeated rows, frozen and clipped channels.


RESTS = 10.0
"""Times the usual number of equal rows that a robot at rest exceeds, and a recorder does not."""

COARSE = 3.0
"""Lattice steps that a change of a held channel exceeds."""


def _flag_changes(values: np.ndarray) -> np.ndarray:
    """Returns (n,) True where a value differs from the one before, and at 0."""
    return np.concatenate([[True], np.diff(values) != 0.0])[: len(values)]


def find_equal_rows(values: np.ndarray) -> np.ndarray:
    """Returns (n,) True where a row of values (n, k) equals the one before; NaN is NaN."""
    same = (values[1:] == values[:-1]) | (np.isnan(values[1:]) & np.isnan(values[:-1]))
    return np.concatenate([[False], same.all(axis=1)])


def find_run_lengths(new: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns starts and lengths of the runs that begin where new (n,) is True, and at 0."""
    starts = np.flatnonzero(np.concatenate([[True], new[1:]]))
    return starts, np.diff(starts, append=len(new))


def estimate_hold_length(values: np.ndarray, step: float | None = None) -> int:
    """Estimates for how many rows a slower channel (n,) repeats each value; 1: none.

    The median of the runs between two changes of more than `COARSE` lattice steps: a slow motion
    stays on a count of its encoder too, but for shorter runs as well.

    Args:
        values: of it; NaN where missing.
        step: of their lattice; None: it is estimated.
    """
    there = values[np.isfinite(values)]
    if len(there) < THRESHOLDS.min_channel_samples:
        return 1
    starts, length = find_run_lengths(_flag_changes(there))
    if len(starts) < THRESHOLDS.min_hold_runs:
        return 1
    step = estimate_lattice_step(there) if step is None else step
    jumps = np.abs(np.diff(there[starts])) > COARSE * step
    both = np.append(False, jumps[:-1] & jumps[1:])
    runs = length[:-1][both]
    if len(runs) < THRESHOLDS.min_hold_runs:
        return 1
    usual = float(np.median(runs))
    held = usual >= 2.0 and np.mean(length < 0.7 * usual) < THRESHOLDS.max_short_runs
    return round(usual) if held else 1


def find_repeated_rows(
    positions: np.ndarray, others: np.ndarray, always: bool = False
) -> np.ndarray:
    """Returns (n,) True at rows that a recorder faster than the robot wrote again.

    Then all channels repeat together, again and again, a few rows each time, and one at least goes
    on by more than `COARSE` lattice steps. One channel repeats alone where it is coarse; all of
    them do for long where the robot rests.

    Args:
        positions: (n, J).
        others: (n, k) all other channels that were measured at the same time.
        always: it is known already that the log has such rows.
    """
    still = find_equal_rows(positions)
    same = still & find_equal_rows(others)
    _, length = find_run_lengths(~same)
    usual = max(float(np.median(length)), 1.0)
    same &= ~np.repeat(length > RESTS * usual, length)
    every = np.column_stack([positions, others])
    fresh = every[~same]
    often = (
        len(fresh) > 1
        and same.mean() > THRESHOLDS.min_repeated_rows
        and same.sum() > THRESHOLDS.min_joint_repeats * still.sum()
        and np.mean(fresh[1:] != fresh[:-1], axis=0).max() > THRESHOLDS.min_new_values
    )
    if always:
        return np.asarray(same)
    if often and all(estimate_hold_length(channel) == 1 for channel in fresh.T):
        ends = np.flatnonzero(same[:-1] & ~same[1:])
        steps = COARSE * np.array([estimate_lattice_step(channel) for channel in every.T])
        coarse = (np.abs(every[ends + 1] - every[ends]) > steps).any(axis=1)
        if ends.size and coarse.mean() > THRESHOLDS.min_joint_repeats:
            return np.asarray(same)
    return np.zeros(len(same), dtype=bool)


def find_longest_usual_run(values: np.ndarray) -> int:
    """Returns the samples of the longest run of equal values (n,), the three longest left out."""
    _, length = find_run_lengths(_flag_changes(values))
    if len(length) > THRESHOLDS.ignored_long_runs:
        return int(np.sort(length)[-THRESHOLDS.ignored_long_runs - 1])
    return len(values)


def find_frozen_runs(
    values: np.ndarray, model: ChannelModel, position: np.ndarray, noise: float
) -> list[tuple[int, int]]:
    """Finds [start, stop) where a channel repeats a value unusually long during motion.

    Then it goes on by more than `COARSE` lattice steps. Not at its largest and smallest value,
    where it may be at a limit, and not at 0: switched off.

    Args:
        values: (n,) of the channel, without gaps.
        model: of the whole channel.
        position: (n,) of its joint.
        noise: of the position.
    """
    starts, length = find_run_lengths(_flag_changes(values))
    least_rows = THRESHOLDS.min_frozen_length * model.stay
    long = length > max(THRESHOLDS.min_channel_samples, least_rows)
    least = 2.0 * THRESHOLDS.min_motion_deviations * noise
    return [
        (int(start) + 1, int(stop))
        for start, stop in zip(starts[long], (starts + length)[long], strict=True)
        if values.min() < values[start] < values.max()
        and values[start] != 0.0
        and abs(float(position[stop - 1] - position[start])) > least
        and np.any(np.abs(values[stop : stop + 1] - values[start]) > COARSE * model.step)
    ]


def interpolate_held_channel(
    time: np.ndarray, values: np.ndarray, rows: int, smooth: bool
) -> np.ndarray:
    """Interpolates (n,) a held channel, linearly or smoothly between its new values.

    Args:
        time: (n,) s.
        values: (n,), NaN where missing.
        rows: for which values are held; one that stays longer was sampled again.
        smooth: by a cubic spline, whose second derivative does not leap.
    """
    there = np.flatnonzero(np.isfinite(values))
    starts, length = find_run_lengths(_flag_changes(values[there]))
    age = np.arange(len(there)) - np.repeat(starts, length)
    fresh = there[(age % rows == 0) & (age < np.repeat(np.maximum(length - rows // 2, 1), length))]
    if smooth and len(fresh) > 1:
        from scipy.interpolate import CubicSpline  # takes long to load

        inside = np.clip(time, time[fresh[0]], time[fresh[-1]])
        between = CubicSpline(time[fresh], values[fresh])(inside)
    else:
        between = np.interp(time, time[fresh], values[fresh])
    return np.where(np.isfinite(values), between, np.nan)


def find_clips(time: np.ndarray, values: np.ndarray, noise: float) -> tuple[Clip, ...]:
    """Finds the ends of the range at which a position (n,) is clipped.

    A motion that is cut off reaches the end without slowing down, stays there to the bit, and
    leaves it as fast: twice, or once for 20 rows that come evenly.

    Args:
        time: (n,) s.
        values: (n,), NaN where missing.
        noise: of the channel.
    """
    known = np.isfinite(values)
    t, clips = time[known], list[Clip]()
    for sign in (1.0, -1.0):
        x = sign * values[known]
        if len(x) <= THRESHOLDS.min_channel_samples or np.ptp(x) == 0.0:
            continue
        top, least = float(x.max()), THRESHOLDS.min_motion_deviations * noise
        starts, length = find_run_lengths(np.concatenate([[True], np.diff(x == top) != 0]))
        stays = [
            (int(start), int(start + count))
            for start, count in zip(starts, length, strict=True)
            if x[start] == top
            and count >= 5
            and _is_unbraked(t[:start], x[:start], least)
            and _is_unbraked(-t[: start + count - 1 : -1], x[: start + count - 1 : -1], least)
        ]
        rows = [stop - start for start, stop in stays]
        single = max(rows, default=0) >= THRESHOLDS.min_single_stay and all(
            np.ptp(steps := np.diff(t[start:stop])) < np.median(steps) for start, stop in stays
        )
        if (len(stays) > 1 or single) and sum(rows) > 0.5 * np.sum(x == top):
            clips.append(Clip(sign * top, sign > 0.0))
    return tuple(clips)


def _is_unbraked(time: np.ndarray, before: np.ndarray, least: float) -> bool:
    """Returns True if a motion (m,) goes on to its last value as fast as before, and not slowly.

    Over three rows, or so many that it goes farther than its noise.
    """
    for rows in (3, 6, 12):
        if len(before) <= 2 * rows:
            return False
        places = [-1 - 2 * rows, -1 - rows, -1]
        earlier, last = np.diff(before[places])
        if max(earlier, last) > least:
            before_s, last_s = np.diff(time[places])
            least_speed = THRESHOLDS.min_end_speed * earlier * (1.0 - 1e-6)
            return bool(last * before_s > least_speed * last_s)
    return False
