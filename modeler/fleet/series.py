"""One quantity of one machine over its periods: does it stay, drift or jump?"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import digamma, ndtri, polygamma, stdtr, stdtrit

Shape = Literal["trend", "jump", "one period"]

_KEPT = 0.8  # of the changes, the smaller ones, that the scatter is taken from
_EFFICIENCY = 0.4  # degrees of freedom of a change, of those that share their periods and are cut
_MOST_PRIOR = 12.0  # degrees of freedom that other quantities may stand for


@dataclass(frozen=True, eq=False)
class Series:
    """Values of one quantity of one machine; p periods.

    Attributes:
        at: (p,) when, ascending.
        values: (p,).
        sigmas: (p,) standard deviations by the rows of each log.
    """

    at: np.ndarray
    values: np.ndarray
    sigmas: np.ndarray

    @property
    def changes(self) -> np.ndarray:
        """From each period to the next, in standard deviations, the machine's usual one taken out.

        With three periods, what a straight line leaves; with two, the change itself.
        """
        steps = np.diff(self.values) / np.hypot(self.sigmas[1:], self.sigmas[:-1])
        if len(steps) < 2:
            return steps
        if len(steps) == 2:
            return np.diff(steps) / np.sqrt(3.0)
        apart: np.ndarray = steps - np.median(steps)
        return apart * np.sqrt(len(steps) / (len(steps) - 1.0))


@dataclass(frozen=True)
class Scatter:
    """How much a quantity changes from one period to the next where nothing drifts.

    Attributes:
        extra: standard deviation beside that by the rows, in the unit of the quantity.
        degrees: of freedom that it is known with.
        factor: by which the sigmas rise, of a usual log.
    """

    extra: float
    degrees: float
    factor: float

    def sigmas(self, series: Series) -> np.ndarray:
        """(p,) standard deviations of the values of a series that stays."""
        return np.hypot(series.sigmas, self.extra)


def scatters(groups: Sequence[Sequence[Series]]) -> list[Scatter]:
    """The scatter of each quantity, from all machines, moderated by all other quantities.

    Few changes say little of a variance: that of each quantity is drawn to the usual one, the more
    the less they differ (Smyth 2004, Stat. Appl. Genet. Mol. Biol. 3(1), section 6.2; trimmed
    variances in place of plain ones, so that what drifts does not hide itself).

    Args:
        groups: the series of all machines, quantity by quantity.
    """
    changes = [np.concatenate([np.zeros(0), *(own.changes for own in group)]) for group in groups]
    degrees = np.array([_EFFICIENCY * len(own) for own in changes])
    squares = np.array([_trimmed(own) for own in changes])
    usual, prior = _usual(squares[squares > 0.0], degrees[squares > 0.0])
    found = []
    for group, square, own in zip(groups, squares, degrees, strict=True):
        variance = (own * square + prior * usual) / max(own + prior, 1e-9)
        extra = max(0.0, variance - 1.0)
        sigmas = np.concatenate([np.zeros(0), *(series.sigmas for series in group)])
        size = float(np.sqrt(np.median(sigmas**2))) if sigmas.size else 0.0
        found.append(Scatter(np.sqrt(extra) * size, max(1.0, own + prior), np.sqrt(1.0 + extra)))
    return found


def _trimmed(changes: np.ndarray) -> float:
    """Variance of normal numbers of mean 0 from the smaller ones; 0 without any."""
    count = len(changes)
    if not count:
        return 0.0
    kept = int(np.ceil(_KEPT * count))
    expected = ndtri(0.5 + 0.5 * (np.arange(1, kept + 1) - 0.375) / (count + 0.25))
    return float(np.sum(np.sort(changes**2)[:kept]) / np.sum(expected**2))


def _usual(squares: np.ndarray, degrees: np.ndarray) -> tuple[float, float]:
    """Variance that quantities have, and the degrees of freedom that it stands for.

    Moments of log s^2: mean log s0^2 + (digamma - log)(d / 2) - (digamma - log)(d0 / 2), variance
    trigamma(d / 2) + trigamma(d0 / 2).
    """
    if len(squares) < 2:
        return 1.0, 0.0
    half = 0.5 * degrees
    logs = np.log(squares) - digamma(half) + np.log(half)
    spread = float(np.var(logs, ddof=1) - np.mean(polygamma(1, half)))
    tried = np.geomspace(0.1, _MOST_PRIOR, 100)
    prior = float(tried[np.argmin(np.abs(polygamma(1, 0.5 * tried) - max(spread, 0.0)))])
    return float(np.exp(np.mean(logs) + digamma(0.5 * prior) - np.log(0.5 * prior))), prior


@dataclass(frozen=True)
class Move:
    """The change that describes a series best.

    Attributes:
        shape: a straight line, a step that stays, or one period apart from all others.
        begin: index of the first period that is different; 0 of a trend.
        change: from the first to the last value of that line, or the height of the step.
        sigma: of the change, scatter included.
        level: of the line at its begin, or beside the step.
        score: change in sigmas.
        chance: that a series which stays shows as much, of any of these shapes.
    """

    shape: Shape
    begin: int
    change: float
    sigma: float
    level: float
    score: float
    chance: float


def move_of(series: Series, scatter: Scatter) -> Move | None:
    """The best description of what a series does; None for one period.

    Weighted least squares of a constant and one shape, each shape in turn; the chance is that of
    one shape, Student's t, times their number (Bonferroni).
    """
    if len(series.at) < 2:
        return None
    sigma = scatter.sigmas(series)
    tried = [_moved(series, sigma, *shape) for shape in _shapes(series.at)]
    best = max(tried, key=lambda move: abs(move.score))
    chance = 2.0 * float(stdtr(scatter.degrees, -abs(best.score))) * len(tried)
    return Move(best.shape, best.begin, best.change, best.sigma, best.level, best.score,
                min(1.0, chance))  # fmt: skip


def _shapes(at: np.ndarray) -> list[tuple[Shape, int, np.ndarray]]:
    periods = len(at)
    place = np.arange(periods)
    found: list[tuple[Shape, int, np.ndarray]] = []
    if periods > 2:
        found.append(("trend", 0, (at - at[0]) / (at[-1] - at[0])))
    found += [("jump", i, (place >= i).astype(float)) for i in range(1, periods)]
    found += [("one period", i, (place == i).astype(float)) for i in range(1, periods - 1)]
    return found


def _moved(series: Series, sigma: np.ndarray, shape: Shape, begin: int, column: np.ndarray) -> Move:
    weights = 1.0 / sigma**2
    centre = np.sum(weights * column) / weights.sum()
    spread = float(np.sum(weights * (column - centre) ** 2))
    change = float(np.sum(weights * (column - centre) * series.values)) / spread
    level = float(np.sum(weights * (series.values - change * column)) / weights.sum())
    score = change * np.sqrt(spread)
    return Move(shape, begin, change, float(1.0 / np.sqrt(spread)), level, float(score), 1.0)


def line_of(move: Move, at: np.ndarray) -> np.ndarray:
    """(p,) what a move adds to the level at each period."""
    columns = {(shape, begin): column for shape, begin, column in _shapes(at)}
    return move.change * columns[move.shape, move.begin]


def least_told(series: Series, scatter: Scatter, level: float) -> float:
    """The smallest straight drift over all periods that would be told at this chance.

    Args:
        series: of two periods and more.
        scatter: of the quantity.
        level: chance that one series may have.
    """
    shapes = _shapes(series.at)
    move = _moved(series, scatter.sigmas(series), *shapes[0])
    return move.sigma * quantile(scatter.degrees, level / len(shapes))


def quantile(degrees: float, chance: float) -> float:
    """|t| that Student's t exceeds with that chance, both sides together."""
    return float(-stdtrit(degrees, 0.5 * chance))
