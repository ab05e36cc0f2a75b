"""Speeds against the derivatives of their positions: units, signs, exchanged columns."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np

from modeler.core.table import format_percent
from modeler.logs.thresholds import THRESHOLDS
from modeler.numerics.channels import estimate_channel_noise, model_channel

RATES: Mapping[str, float] = {
    "rad/s": 1.0,
    "deg/s": np.pi / 180.0,
    "rpm": np.pi / 30.0,
    "rev/s": 2.0 * np.pi,
}
"""Units of speeds of revolute joints, in rad/s."""


@dataclass(frozen=True)
class RatePair:
    """A position, and the speed that should be its derivative.

    Attributes:
        position, speed: names of the columns.
        ratio: of the speed to the derivative; NaN if they are not alike, or the joint rests.
    """

    position: str
    speed: str
    ratio: float


def pair_rates(
    names: Sequence[tuple[str, str]], values: Mapping[str, np.ndarray], time: np.ndarray
) -> list[RatePair]:
    """Returns the ratio of every speed to the derivative of its position."""
    pairs = []
    for position, speed in names:
        slope, mean = compare_slopes(values[position], values[speed], time)
        like = (
            is_moving(values[position])
            and abs(_correlate(slope, mean)) >= THRESHOLDS.min_derivative_correlation
        )
        pairs.append(RatePair(position, speed, _fit_ratio(slope, mean) if like else np.nan))
    return pairs


def compare_slopes(
    position: np.ndarray, speed: np.ndarray, time: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Returns slopes of a position over windows, and means of a speed over the same; (m,) each.

    The windows are as short as resolution and noise of both let a slope be seen, and longer than
    the slower of them holds a value.
    """
    there = np.flatnonzero(np.isfinite(time) & np.isfinite(position) & np.isfinite(speed))
    there = there[np.diff(np.maximum.accumulate(time[there]), prepend=-np.inf) > 0.0]
    t, q, v = time[there], position[there], speed[there]
    if len(t) < THRESHOLDS.min_compared_rows:
        return np.zeros(0), np.zeros(0)
    models = [model_channel(t, x) for x in (q, v)]
    area = np.append(0.0, np.cumsum(0.5 * np.diff(t) * (v[1:] + v[:-1])))
    for rows in (2, 4, 8, 16, 32, 64):
        long = t[rows:] - t[:-rows]
        slope, mean = ((x[rows:] - x[:-rows]) / long for x in (q, area))
        doubtful = models[0].noise * np.sqrt(2.0) / np.median(long) + models[1].noise / np.sqrt(
            rows
        )
        whole = rows > THRESHOLDS.min_window_holds * max(one.hold - 1 for one in models)
        if (whole and doubtful < THRESHOLDS.max_slope_noise * np.std(slope)) or 4 * rows > len(t):
            break
    near = long < THRESHOLDS.max_window_ratio * np.median(long)  # not across gaps
    return slope[near], mean[near]


def is_derivative(position: np.ndarray, speed: np.ndarray, time: np.ndarray) -> bool:
    """Returns False if a joint moves, and its speed does not follow."""
    alike = abs(_correlate(*compare_slopes(position, speed, time)))
    return not is_moving(position) or not alike < THRESHOLDS.min_derivative_correlation


def is_moving(values: np.ndarray) -> bool:
    """Returns True of a position that goes beyond its resolution and its noise.

    The noise is that of third differences, the median of their size: a motion has none.
    """
    known = values[np.isfinite(values)]
    if len(known) < THRESHOLDS.min_compared_rows:
        return False
    return float(np.ptp(known)) > THRESHOLDS.min_motion_to_noise * estimate_channel_noise(known)


def is_on_grid(steps: np.ndarray, step: float) -> bool:
    """Returns True if steps, but for a tenth of them, are whole multiples of one."""
    off = np.abs(steps / step - np.round(steps / step))
    return float(np.quantile(off, 0.9)) < 0.05


def infer_units(ratio: float) -> tuple[str, str] | None:
    """Returns units of position and speed that such a ratio looks like; ("", "") if they agree."""
    if not np.isfinite(ratio):
        return None
    if abs(abs(ratio) - 1.0) < THRESHOLDS.max_agreeing_deviation:
        return "", ""
    pairs = [(a, b) for a, b in permutations(RATES, 2) if a != "rpm"]
    offs = ((abs(abs(ratio) * RATES[b] / RATES[a] - 1.0), a, b) for a, b in pairs)
    tried = [(off, a.removesuffix("/s"), b) for off, a, b in offs]
    off, first, second = min(tried)
    return (first, second) if off < THRESHOLDS.max_ratio_deviation else None


def check_rates(
    names: Sequence[tuple[str, str]], values: Mapping[str, np.ndarray], time: np.ndarray
) -> list[str]:
    """Returns speeds that are not the derivative of their position, of the joints that move."""
    names = [(q, qd) for q, qd in names if is_moving(values[q])]
    lines, pairs = list[str](), pair_rates(names, values, time)
    factor = find_common_factor([pair.ratio for pair in pairs])
    steps = np.diff(time[np.isfinite(time)])
    if factor is not None and len(pairs) > 1 and steps.size:
        return [describe_clock_factor(factor, 1.0 / float(np.median(steps)))]
    for pair in pairs:
        if np.isfinite(pair.ratio):
            line = _describe_ratio(pair)
        else:
            line = _describe_mismatch(pair, names, values, time)
        lines += [line] if line else []
    return lines


def find_common_factor(ratios: Sequence[float]) -> float | None:
    """Returns by what all speeds are off the derivatives of their positions.

    None if by 1, or not alike.

    Args:
        ratios: of speeds to derivatives, of the joints that move.
    """
    known = np.array([ratio for ratio in ratios if np.isfinite(ratio)])
    if not known.size or known.size < len(ratios) or not (known > 0.0).all():
        return None
    factor = float(np.median(known))
    alike = np.all(np.abs(known / factor - 1.0) < THRESHOLDS.max_ratio_deviation)
    is_wrong = abs(factor - 1.0) > THRESHOLDS.max_agreeing_deviation
    return factor if alike and is_wrong else None


def describe_clock_factor(factor: float, rate: float) -> str:
    """Returns what one factor on all joints means.

    Args:
        factor: of the speeds to the derivatives.
        rate: of the rows, Hz.
    """
    units, unit = infer_units(factor), ""
    if units is not None and any(units):
        unit = f", or positions are in {units[0]} and speeds in {units[1]}"
    return (
        f"the logged speeds of all joints are {factor:.3g} times the derivatives of their "
        "positions: the clock seems to be wrong by that factor, and the rows to come at "
        f"{rate * factor:.4g} Hz, not at {rate:.4g}{unit}; check the time column, then the units "
        "of the speeds"
    )


def describe_repeats(repeated: int, rows: int, rate: float) -> str:
    """Returns what rows that repeat the one before them in all channels mean.

    Args:
        repeated: rows.
        rows: in all.
        rate: of them, Hz.
    """
    return (
        f"all channels: {repeated} rows ({format_percent(repeated / rows)}) repeat the row "
        "before them: "
        "the recorder is faster than the robot, which gave about "
        f"{rate * (1.0 - repeated / rows):.3g} rows a second; record at the rate of the robot"
    )


def _describe_mismatch(
    pair: RatePair,
    names: Sequence[tuple[str, str]],
    values: Mapping[str, np.ndarray],
    time: np.ndarray,
) -> str:
    speed = values[pair.speed]
    like = {q: _correlate(*compare_slopes(values[q], speed, time)) for q, _ in names}
    correlation = like.pop(pair.position)
    if not np.isfinite(correlation):
        return ""
    others = {q: abs(other) for q, other in like.items()}
    other = max(others, key=lambda q: np.nan_to_num(others[q]), default="")
    if other and others[other] > THRESHOLDS.min_derivative_correlation:
        return (
            f"{pair.speed} is the derivative of {other}, not of {pair.position}: are columns "
            "exchanged?"
        )
    return f"{pair.speed} is not the derivative of {pair.position} (correlation {correlation:.2f})"


def _describe_ratio(pair: RatePair) -> str:
    """What a speed is times the derivative of its position, if not 1, and what that looks like."""
    if abs(pair.ratio - 1.0) < THRESHOLDS.max_agreeing_deviation:
        return ""
    if abs(pair.ratio + 1.0) < THRESHOLDS.max_ratio_deviation:
        return f"{pair.speed} has the other sign of the derivative of {pair.position}"
    units = infer_units(pair.ratio)
    words = f": {pair.position} in {units[0]} and {pair.speed} in {units[1]}?" if units else ""
    return f"{pair.speed} is {pair.ratio:.3g} times the derivative of {pair.position}{words}"


def _correlate(a: np.ndarray, b: np.ndarray) -> float:
    both = np.isfinite(a) & np.isfinite(b)
    if both.sum() < THRESHOLDS.min_compared_rows:
        return np.nan
    with np.errstate(all="ignore"):
        if not a[both].std() > 0.0 or not b[both].std() > 0.0:
            return np.nan
        return float(np.corrcoef(a[both], b[both])[0, 1])


def _fit_ratio(slope: np.ndarray, speed: np.ndarray) -> float:
    both = np.isfinite(slope) & np.isfinite(speed)
    size = float(slope[both] @ slope[both])
    return float(slope[both] @ speed[both]) / size if 0.0 < size < np.inf else np.nan
