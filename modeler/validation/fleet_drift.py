"""Drift of one quantity of a machine over its periods, and outlying machines."""

import dataclasses
import datetime
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import digamma, ndtri, polygamma, stdtr, stdtrit

from modeler.core.manifest import ModuleSpec
from modeler.estimation import MachineComparison, compare_machines, fit_machine, merge_sums
from modeler.validation.fleet_logs import (
    FLEET_THRESHOLDS,
    GAIN,
    LOAD,
    FleetFit,
    FleetLayout,
    LogSummary,
    Quantity,
    make_natural_key,
)

Shape = Literal["trend", "jump", "one period"]


@dataclass(frozen=True, eq=False)
class PeriodSeries:
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
    def standardised_changes(self) -> np.ndarray:
        """Returns changes between periods, in standard deviations, less their median.

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

    def compute_sigmas(self, series: PeriodSeries) -> np.ndarray:
        """Computes standard deviations, (p,), of the values of a series that stays."""
        return np.hypot(series.sigmas, self.extra)


def estimate_scatters(groups: Sequence[Sequence[PeriodSeries]]) -> list[Scatter]:
    """Estimates the scatter of each quantity, from all machines, moderated by all quantities.

    Few changes say little of a variance: that of each quantity is drawn to the usual one, the more
    the less they differ (Smyth 2004, Stat. Appl. Genet. Mol. Biol. 3(1), section 6.2; trimmed
    variances in place of plain ones, so that what drifts does not hide itself).

    Args:
        groups: the series of all machines, quantity by quantity.
    """
    each = ([series.standardised_changes for series in group] for group in groups)
    changes = [np.concatenate([np.zeros(0), *parts]) for parts in each]
    degrees = np.array([FLEET_THRESHOLDS.degrees_per_change * len(entry) for entry in changes])
    squares = np.array([_estimate_trimmed_variance(entry) for entry in changes])
    usual, prior = _estimate_typical_variance(squares[squares > 0.0], degrees[squares > 0.0])
    scatters = []
    for group, square, entry in zip(groups, squares, degrees, strict=True):
        variance = (entry * square + prior * usual) / max(entry + prior, 1e-9)
        extra = max(0.0, variance - 1.0)
        sigmas = np.concatenate([np.zeros(0), *(series.sigmas for series in group)])
        size = float(np.sqrt(np.median(sigmas**2))) if sigmas.size else 0.0
        known = max(1.0, entry + prior)
        scatters.append(Scatter(np.sqrt(extra) * size, known, np.sqrt(1.0 + extra)))
    return scatters


def _estimate_trimmed_variance(changes: np.ndarray) -> float:
    """Variance of normal numbers of mean 0 from the smaller ones; 0 without any."""
    count = len(changes)
    if not count:
        return 0.0
    used_count = int(np.ceil(FLEET_THRESHOLDS.trimmed_share * count))
    expected = ndtri(0.5 + 0.5 * (np.arange(1, used_count + 1) - 0.375) / (count + 0.25))
    return float(np.sum(np.sort(changes**2)[:used_count]) / np.sum(expected**2))


def _estimate_typical_variance(squares: np.ndarray, degrees: np.ndarray) -> tuple[float, float]:
    """Variance that quantities have, and the degrees of freedom that it stands for.

    Moments of log s^2: mean log s0^2 + (digamma - log)(d / 2) - (digamma - log)(d0 / 2), variance
    trigamma(d / 2) + trigamma(d0 / 2).
    """
    if len(squares) < 2:
        return 1.0, 0.0
    half = 0.5 * degrees
    logs = np.log(squares) - digamma(half) + np.log(half)
    spread = float(np.var(logs, ddof=1) - np.mean(polygamma(1, half)))
    grid = np.geomspace(0.1, FLEET_THRESHOLDS.max_prior_degrees, 100)
    prior = float(grid[np.argmin(np.abs(polygamma(1, 0.5 * grid) - max(spread, 0.0)))])
    return float(np.exp(np.mean(logs) + digamma(0.5 * prior) - np.log(0.5 * prior))), prior


@dataclass(frozen=True)
class Drift:
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


def fit_drift(series: PeriodSeries, scatter: Scatter) -> Drift | None:
    """Fits the best description of what a series does; None for one period.

    Weighted least squares of a constant and one shape, each shape in turn; the chance is that of
    one shape, Student's t, times their number (Bonferroni).
    """
    if len(series.at) < 2:
        return None
    sigma = scatter.compute_sigmas(series)
    fits = [_fit_shape(series, sigma, *shape) for shape in _build_shapes(series.at)]
    best = max(fits, key=lambda move: abs(move.score))
    chance = 2.0 * float(stdtr(scatter.degrees, -abs(best.score))) * len(fits)
    return dataclasses.replace(best, chance=min(1.0, chance))


def _build_shapes(at: np.ndarray) -> list[tuple[Shape, int, np.ndarray]]:
    periods = len(at)
    place = np.arange(periods)
    shapes: list[tuple[Shape, int, np.ndarray]] = []
    if periods > 2:
        shapes.append(("trend", 0, (at - at[0]) / (at[-1] - at[0])))
    shapes += [("jump", i, (place >= i).astype(float)) for i in range(1, periods)]
    shapes += [("one period", i, (place == i).astype(float)) for i in range(1, periods - 1)]
    return shapes


def _fit_shape(
    series: PeriodSeries, sigma: np.ndarray, shape: Shape, begin: int, column: np.ndarray
) -> Drift:
    weights = 1.0 / sigma**2
    centre = np.sum(weights * column) / weights.sum()
    spread = float(np.sum(weights * (column - centre) ** 2))
    change = float(np.sum(weights * (column - centre) * series.values)) / spread
    level = float(np.sum(weights * (series.values - change * column)) / weights.sum())
    score = change * np.sqrt(spread)
    return Drift(shape, begin, change, float(1.0 / np.sqrt(spread)), level, float(score), 1.0)


def compute_line(move: Drift, at: np.ndarray) -> np.ndarray:
    """Computes what a drift adds to the level at each period, (p,)."""
    columns = {(shape, begin): column for shape, begin, column in _build_shapes(at)}
    return move.change * columns[move.shape, move.begin]


def compute_smallest_detectable(series: PeriodSeries, scatter: Scatter, level: float) -> float:
    """Computes the smallest straight drift that is detected at this chance.

    Args:
        series: of two periods and more.
        scatter: of the quantity.
        level: chance that one series may have.
    """
    shapes = _build_shapes(series.at)
    move = _fit_shape(series, scatter.compute_sigmas(series), *shapes[0])
    return move.sigma * compute_quantile(scatter.degrees, level / len(shapes))


def compute_quantile(degrees: float, chance: float) -> float:
    """Computes the |t| that Student's t exceeds with that chance, both sides together."""
    return float(-stdtrit(degrees, 0.5 * chance))


# When the periods of a fleet are: days by their names or clocks, or just their order.


Unit = Literal["days", "periods"]

_DATE = re.compile(
    r"(?<!\d)(\d{4})[-_.]?(\d{2})[-_.]?(\d{2})(?:[T _-](\d{2})[-:_h]?(\d{2})(?:[-:_m]?(\d{2}))?)?"
    r"(?!\d)"
)
_DAY = 86400.0  # s


def arrange_by_time(summaries: Sequence[LogSummary]) -> tuple[list[LogSummary], np.ndarray, Unit]:
    """Arranges the logs by machine and time; returns when each is, and the unit.

    Dates in the names of all periods rule; else the clocks of the logs, where those of each machine
    do not overlap (logs that each begin at 0 do); else the names in natural order.
    """
    dates = [parse_date(each.log_name.period) for each in summaries]
    if all(date is not None for date in dates):
        days = np.array([0.0 if date is None else date.timestamp() for date in dates]) / _DAY
        if _is_disjoint(summaries, days, days):
            return _arrange_logs(summaries, days, "days")
    starts, ends = (np.array([each.span[k] for each in summaries]) / _DAY for k in (0, 1))
    several = len({each.log_name.machine for each in summaries}) < len(summaries)
    if several and _is_disjoint(summaries, starts, ends):
        return _arrange_logs(summaries, starts, "days")
    keys = sorted({each.log_name.period for each in summaries}, key=make_natural_key)
    places = np.array([float(keys.index(each.log_name.period)) for each in summaries])
    return _arrange_logs(summaries, places, "periods")


def parse_date(period: str) -> datetime.datetime | None:
    """Parses the day, and hour if any, of a name such as 2026-03-01 or 20260301_0930."""
    match = _DATE.search(period)
    if match is None:
        return None
    parts = [int(part) for part in match.groups() if part is not None]
    try:
        year, month, day, hour, minute, second = (*parts, 0, 0, 0)[:6]
        return datetime.datetime(year, month, day, hour, minute, second, tzinfo=datetime.UTC)
    except ValueError:
        return None


def _is_disjoint(summaries: Sequence[LogSummary], starts: np.ndarray, ends: np.ndarray) -> bool:
    """True if no two logs of a machine overlap, or begin together."""
    machines = np.array([each.log_name.machine for each in summaries])
    for machine in set(machines):
        logs = np.flatnonzero(machines == machine)
        order = logs[np.argsort(starts[logs], kind="stable")]
        later, earlier = starts[order][1:], ends[order][:-1]
        if np.any(later <= starts[order][:-1]) or np.any(later < earlier):
            return False
    return True


def _arrange_logs(
    summaries: Sequence[LogSummary], at: np.ndarray, unit: Unit
) -> tuple[list[LogSummary], np.ndarray, Unit]:
    machines = [make_natural_key(each.log_name.machine) for each in summaries]
    order = sorted(range(len(summaries)), key=lambda k: (machines[k], at[k]))
    return [summaries[k] for k in order], at[order] - at.min(), unit


# The odd machine out: whose value of a quantity is apart from that of all others.


@dataclass(frozen=True)
class Outlier:
    """A machine that stands apart from the others.

    Attributes:
        machine: index.
        difference: to the median of the others.
        spread: standard deviation among the others.
        score: difference in these.
    """

    machine: int
    difference: float
    spread: float
    score: float


def compute_critical_deviate(count: int, step: int, chance: float) -> float:
    """Computes what the most extreme of `count` less `step` - 1 normal numbers exceeds.

    (Rosner 1983, eq. 2.5), lambda = (n - i) t / sqrt((n - i - 1 + t^2) (n - i + 1)), t with
    n - i - 1 degrees of freedom at chance / 2 (n - i + 1).

    Args:
        count: n.
        step: i, from 1.
        chance: of the larger of both sides.
    """
    left = count - step
    t = compute_quantile(left - 1, chance / (left + 1))
    return float(left * t / np.sqrt((left - 1 + t**2) * (left + 1)))


def find_outlying_machines(
    values: np.ndarray, sigmas: np.ndarray, chance: float
) -> tuple[Outlier, ...]:
    """Finds outlying machines by the generalized extreme Studentized deviate.

    The most extreme machine is taken away, then the next, up to three and every fifth; the odd ones
    are all up to the last whose deviate exceeds its critical value, so that two do not hide each
    other (Rosner 1983, Technometrics 25(2), eqs. 2.2 and 2.5). The chance is shared among these
    steps: far out in the tails, Rosner's values alone are too small. Machines must besides differ
    by more than their own standard deviations explain.

    Args:
        values: (m,) one of each machine; NaN where it is not known.
        sigmas: (m,) standard deviations of them.
        chance: that any machine of a fleet of alike machines comes out.
    """
    left = [int(k) for k in np.flatnonzero(np.isfinite(values))]
    count = len(left)
    if count < FLEET_THRESHOLDS.min_machines:
        return ()
    taken: list[int] = []
    last = 0
    steps = min(FLEET_THRESHOLDS.max_outliers, count // FLEET_THRESHOLDS.machines_per_outlier)
    for i in range(1, steps + 1):
        rest = values[left]
        spread = float(np.std(rest, ddof=1))
        if spread <= 0.0:
            break
        most = left[int(np.argmax(np.abs(rest - rest.mean())))]
        deviate = abs(values[most] - rest.mean()) / spread
        left.remove(most)
        taken.append(most)
        last = i if deviate > compute_critical_deviate(count, i, chance / steps) else last
    others = [k for k in np.flatnonzero(np.isfinite(values)) if k not in taken[:last]]
    middle, spread = float(np.median(values[others])), float(np.std(values[others], ddof=1))
    beyond = compute_quantile(1e9, chance / count)
    differences = [(int(k), float(values[k]) - middle) for k in taken[:last]]
    large = [(k, x) for k, x in differences if abs(x) > beyond * sigmas[k]]
    return tuple(Outlier(k, x, spread, x / spread) for k, x in large)


@dataclass(frozen=True, eq=False)
class QuantityTests:
    """The tests of quantities for drift; k logs, machine after machine in time, d quantities.

    Attributes:
        quantities: (d,) what.
        machine: (k,) index of the machine of each log.
        at: (k,) when.
        values: (k, d) of gains in %; NaN where a log does not determine it.
        sigmas: (k, d) by the rows of each log.
        scatters: (d,) from period to period.
        drifts: (machine, quantity) of those that drift, and how.
        outliers: (machine, quantity) of those apart from the others.
        scores: (machine, quantity) of the greatest change of every series, in sigmas.
        loaded_machines: machines that a load describes better than gains; None: not known yet.
    """

    quantities: tuple[Quantity, ...]
    machine: np.ndarray
    at: np.ndarray
    values: np.ndarray
    sigmas: np.ndarray
    scatters: tuple[Scatter, ...] = ()
    drifts: dict[tuple[int, int], Drift] = dataclasses.field(default_factory=dict)
    outliers: dict[tuple[int, int], Outlier] = dataclasses.field(default_factory=dict)
    scores: dict[tuple[int, int], float] = dataclasses.field(default_factory=dict)
    loaded_machines: frozenset[int] | None = None

    @property
    def machine_count(self) -> int:
        """Returns the number of machines."""
        return int(self.machine.max()) + 1

    def can_report(self, m: int, i: int) -> bool:
        """Returns whether a quantity counts: no load in a machine that gains describe better."""
        loaded = self.loaded_machines
        return loaded is None or self.quantities[i].effect != LOAD or m in loaded

    def find_logs(self, m: int, i: int) -> np.ndarray:
        """Finds the indices of the logs of a machine that determine a quantity."""
        return np.flatnonzero((self.machine == m) & np.isfinite(self.values[:, i]))

    def get_series(self, m: int, i: int) -> PeriodSeries:
        """Returns a quantity of a machine."""
        logs = self.find_logs(m, i)
        values, sigmas = self.values[logs, i], self.sigmas[logs, i]
        return PeriodSeries(self.at[logs], values, sigmas)

    def find_smallest_drift(self, i: int) -> float | None:
        """Finds the smallest straight drift that the best observed machine would show."""
        every = [self.get_series(m, i) for m in range(self.machine_count)]
        known, level = self.scatters[i], self.significance_level
        limits = [compute_smallest_detectable(s, known, level) for s in every if len(s.at) > 1]
        return min(limits, default=None)

    @property
    def significance_level(self) -> float:
        """Returns the chance that one series may have."""
        return 0.5 * FLEET_THRESHOLDS.false_alarm / (self.machine_count * len(self.quantities))


def evaluate_quantities(
    spec: ModuleSpec, layout: FleetLayout, fit: FleetFit, logs: Sequence[LogSummary], at: np.ndarray
) -> QuantityTests:
    """Tests all quantities of all machines; confounders by what they explain.

    A load enters the torques of several joints, a gain those of one: of machines whose load seems
    to change, what `compare_machines` says of logs before and after holds for all of them, and the
    other is no finding. Friction and offset are in units of the logged torque; where a gain
    drifts, they are freed of it.
    """
    names = list(dict.fromkeys(each.log_name.machine for each in logs))
    machine = np.array([names.index(each.log_name.machine) for each in logs])
    values, sigmas = _collect_arrays(layout, fit)
    tests = QuantityTests(layout.quantities, machine, at, values, sigmas)
    tests = dataclasses.replace(tests, scatters=_estimate_scatters(tests))
    if fit.load_fits:
        tests = _apply_loads(tests, layout, fit, spec, logs)
    gains = [i for i, each in enumerate(tests.quantities) if each.effect == GAIN]
    others = [i for i, each in enumerate(tests.quantities) if each.effect != GAIN]
    tests = _remove_gains(_detect_drifts(tests, gains))
    return _detect_drifts(dataclasses.replace(tests, scatters=_estimate_scatters(tests)), others)


def _collect_arrays(layout: FleetLayout, fit: FleetFit) -> tuple[np.ndarray, np.ndarray]:
    """(k, d) values and sigmas, of friction and gains as without loads."""
    values = np.array([log.values for log in fit.logs])
    sigmas = np.array([log.sigmas for log in fit.logs])
    first = len(layout.drift_columns)
    for array in (values, sigmas):
        array[:, first:] *= 100.0
    if fit.load_fits:
        values = np.column_stack([values, [log.values[first] for log in fit.load_fits]])
        sigmas = np.column_stack([sigmas, [log.sigmas[first] for log in fit.load_fits]])
    return values, sigmas


def _estimate_scatters(tests: QuantityTests) -> tuple[Scatter, ...]:
    machines, columns = range(tests.machine_count), range(len(tests.quantities))
    groups = [[tests.get_series(m, i) for m in machines] for i in columns]
    return tuple(estimate_scatters(groups))


def compare_periods(
    spec: ModuleSpec, logs: Sequence[LogSummary], before: np.ndarray, after: np.ndarray
) -> MachineComparison:
    """Compares some logs with others, by their indices."""
    both = [merge_sums([logs[k].sums for k in some]) for some in (before, after)]
    return compare_machines(spec, fit_machine(both[0]), both[1])


def split_logs(tests: QuantityTests, m: int, i: int) -> tuple[np.ndarray, np.ndarray]:
    """Splits logs where a quantity of a machine changes; of an odd machine from all others."""
    logs, move = tests.find_logs(m, i), tests.drifts.get((m, i))
    if move is None:
        return np.flatnonzero(tests.machine != m), logs
    if move.shape == "trend":
        return logs[:1], logs[-1:]
    after = logs[move.begin :] if move.shape == "jump" else logs[[move.begin]]
    return np.setdiff1d(logs, after), after


def _apply_loads(
    tests: QuantityTests,
    layout: FleetLayout,
    fit: FleetFit,
    spec: ModuleSpec,
    summaries: Sequence[LogSummary],
) -> QuantityTests:
    """The fits with a load in place of gains, of machines that these describe better."""
    load = len(tests.quantities) - 1
    tested = _detect_drifts(tests, [load])
    suspects = sorted({m for m, _ in (*tested.drifts, *tested.outliers)})
    values, sigmas = tests.values.copy(), tests.sigmas.copy()
    first, loaded = len(layout.drift_columns), set[int]()
    for m in suspects:
        if compare_periods(spec, summaries, *split_logs(tested, m, load)).likeliest != LOAD:
            continue
        loaded.add(m)
        logs = np.flatnonzero(tests.machine == m)
        for k in logs:
            values[k, :first] = fit.load_fits[k].values[:first]
            sigmas[k, :first] = fit.load_fits[k].sigmas[:first]
        values[logs, first:load] = np.nan
    machines = frozenset(loaded)
    return dataclasses.replace(tests, values=values, sigmas=sigmas, loaded_machines=machines)


def _detect_drifts(tests: QuantityTests, places: Sequence[int]) -> QuantityTests:
    """With the drifts and the odd machines of some quantities."""
    moves, outliers, scores = dict(tests.drifts), dict(tests.outliers), dict(tests.scores)
    level, families = tests.significance_level, len(tests.quantities)
    for i in places:
        for m in range(tests.machine_count):
            move = fit_drift(tests.get_series(m, i), tests.scatters[i])
            if move is not None:
                scores[m, i] = abs(move.score)
            if move is not None and move.chance < level and tests.can_report(m, i):
                count = tests.machine_count * families
                moves[m, i] = dataclasses.replace(move, chance=min(1.0, move.chance * count))
        means, spreads = _compute_means(tests, moves, i)
        chance = 0.5 * FLEET_THRESHOLDS.false_alarm / families
        for each in find_outlying_machines(means, spreads, chance):
            if tests.can_report(each.machine, i):
                outliers[each.machine, i] = each
    return dataclasses.replace(tests, drifts=moves, outliers=outliers, scores=scores)


def _compute_means(
    tests: QuantityTests, moves: dict[tuple[int, int], Drift], i: int
) -> tuple[np.ndarray, np.ndarray]:
    """(machines,) means over the periods and their sigmas; NaN of machines that drift."""
    means, spreads = (np.full(tests.machine_count, np.nan) for _ in range(2))
    for m in range(tests.machine_count):
        series = tests.get_series(m, i)
        if len(series.at) and (m, i) not in moves:
            weights = 1.0 / tests.scatters[i].compute_sigmas(series) ** 2
            means[m] = np.sum(weights * series.values) / weights.sum()
            spreads[m] = 1.0 / np.sqrt(weights.sum())
    return means, spreads


def _remove_gains(tests: QuantityTests) -> QuantityTests:
    """Friction and offset of joints whose gain drifts, or is apart, in units without that."""
    values, sigmas = tests.values.copy(), tests.sigmas.copy()
    for (m, g), scale in _compute_gain_scales(tests).items():
        logs = tests.find_logs(m, g)
        for i, each in enumerate(tests.quantities):
            if each.place == tests.quantities[g].place and each.column >= 0 and each.is_of_joint:
                values[logs, i] /= scale
                sigmas[logs, i] /= scale
    return dataclasses.replace(tests, values=values, sigmas=sigmas)


def _compute_gain_scales(tests: QuantityTests) -> dict[tuple[int, int], np.ndarray]:
    """(periods,) 1 + gain / 100 of each gain that drifts or is apart."""
    gains = [key for key in tests.drifts if tests.quantities[key[1]].effect == GAIN]
    lines = {key: compute_line(tests.drifts[key], tests.get_series(*key).at) for key in gains}
    scales = {key: 1.0 + line / 100.0 for key, line in lines.items()}
    for key, outlier in tests.outliers.items():
        if tests.quantities[key[1]].effect == GAIN:
            scales[key] = np.full(len(tests.find_logs(*key)), 1.0 + outlier.difference / 100.0)
    return {key: np.maximum(scale, 0.1) for key, scale in scales.items()}


# What changed, by the rule of `diagnose` and `compare`.


def name_changes(
    spec: ModuleSpec, tests: QuantityTests, logs: Sequence[LogSummary]
) -> tuple[str, ...]:
    """Names what changed where a finding begins, and between the periods of a machine with two."""
    splits = [(m, *split_logs(tests, m, i)) for m, i in (*tests.drifts, *tests.outliers)]
    for m in range(tests.machine_count):
        every = np.flatnonzero(tests.machine == m)
        if len(every) == 2:
            splits.append((m, every[:1], every[1:]))
    lines = list[str]()
    for m, before, after in splits:
        comparison = compare_periods(spec, logs, before, after)
        if comparison.changes:
            first, last = (
                _format_span([logs[k].log_name.period for k in some]) for some in (before, after)
            )
            first = "the other machines" if tests.machine[before[0]] != m else first
            machine = logs[after[0]].log_name.machine
            changed = comparison.describe(f"{first} and {last}")
            lines += [f"machine {machine}: {line}" for line in changed]
    return tuple(dict.fromkeys(lines))


def _format_span(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{names[0]} to {names[-1]}"
