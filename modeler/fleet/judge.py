"""From the deviations of all logs to what drifts: chances, look-alikes, temperatures."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.fleet.drift import (
    Drift,
    Outlier,
    PeriodSeries,
    Scatter,
    compute_line,
    compute_smallest_detectable,
    estimate_scatters,
    find_outlying_machines,
    fit_drift,
)
from modeler.fleet.joint_fit import GAIN, LOAD, FleetFit, FleetLayout, Quantity
from modeler.fleet.summary import LogSummary

FALSE_ALARM = 0.05
"""Chance of any finding in a fleet in which nothing drifts: half for drifts, half for odd ones."""


@dataclass(frozen=True, eq=False)
class QuantityTests:
    """What was tested; k logs machine after machine in time, d quantities.

    Attributes:
        quantities: (d,) what.
        machine: (k,) index of the machine of each log.
        at: (k,) when.
        values: (k, d) of gains in %; NaN where a log does not tell it.
        sigmas: (k, d) by the rows of each log.
        scatters: (d,) from period to period.
        moves: (machine, quantity) of those that drift, and how.
        odd: (machine, quantity) of those apart from the others.
        scores: (machine, quantity) of the greatest change of every series, in sigmas.
        loaded: machines whose deviations a load describes better than gains; None: not known yet.
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
        """How many."""
        return int(self.machine.max()) + 1

    def can_report(self, m: int, i: int) -> bool:
        """False of a load in a machine that gains describe better: it would be told twice."""
        return (
            self.loaded_machines is None
            or self.quantities[i].effect != LOAD
            or m in self.loaded_machines
        )

    def find_logs(self, m: int, i: int) -> np.ndarray:
        """Indices of the logs of a machine that tell a quantity."""
        return np.flatnonzero((self.machine == m) & np.isfinite(self.values[:, i]))

    def get_series(self, m: int, i: int) -> PeriodSeries:
        """A quantity of a machine."""
        log_indices = self.find_logs(m, i)
        return PeriodSeries(
            self.at[log_indices], self.values[log_indices, i], self.sigmas[log_indices, i]
        )

    def find_smallest_drift(self, i: int) -> float | None:
        """The smallest straight drift that the machine seen best would show."""
        limits = [
            compute_smallest_detectable(series, self.scatters[i], self.significance_level)
            for m in range(self.machine_count)
            if len((series := self.get_series(m, i)).at) > 1
        ]
        return min(limits, default=None)

    @property
    def significance_level(self) -> float:
        """The chance that one series may have."""
        return 0.5 * FALSE_ALARM / (self.machine_count * len(self.quantities))


def evaluate_quantities(
    layout: FleetLayout, fit: FleetFit, logs: Sequence[LogSummary], at: np.ndarray
) -> QuantityTests:
    """Tests all quantities of all machines; look-alikes are told by what they explain.

    A load enters the torques of several joints, a gain those of one: of machines whose load seems
    to change, the one that leaves less unexplained holds for all their logs, and the other is no
    finding. Friction and offset are in units of the logged torque; where a gain drifts, they are
    freed of it.
    """
    names = list(dict.fromkeys(each.log_name.machine for each in logs))
    machine = np.array([names.index(each.log_name.machine) for each in logs])
    values, sigmas = _collect_arrays(layout, fit)
    tests = QuantityTests(layout.quantities, machine, at, values, sigmas)
    tests = dataclasses.replace(tests, scatters=_estimate_scatters(tests))
    if fit.load_fits:
        tests = _apply_loads(tests, layout, fit)
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
    groups = [
        [tests.get_series(m, i) for m in range(tests.machine_count)]
        for i in range(len(tests.quantities))
    ]
    return tuple(estimate_scatters(groups))


def _apply_loads(tests: QuantityTests, layout: FleetLayout, fit: FleetFit) -> QuantityTests:
    """The fits with a load in place of gains, of machines that these describe better."""
    load = len(tests.quantities) - 1
    tested = _detect_drifts(tests, [load])
    suspects = {m for m, _ in (*tested.drifts, *tested.outliers)}
    values, sigmas = tests.values.copy(), tests.sigmas.copy()
    first, loaded = len(layout.drift_columns), set[int]()
    for m in range(tests.machine_count):
        log_indices = np.flatnonzero(tests.machine == m)
        gain, with_load = (
            sum(fits[k].misfit for k in log_indices) for fits in (fit.logs, fit.load_fits)
        )
        if m not in suspects or gain <= with_load:
            continue
        loaded.add(m)
        for k in log_indices:
            values[k, :first] = fit.load_fits[k].values[:first]
            sigmas[k, :first] = fit.load_fits[k].sigmas[:first]
        values[log_indices, first:load] = np.nan
    return dataclasses.replace(
        tests, values=values, sigmas=sigmas, loaded_machines=frozenset(loaded)
    )


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
        for each in find_outlying_machines(means, spreads, 0.5 * FALSE_ALARM / families):
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
        log_indices = tests.find_logs(m, g)
        for i, each in enumerate(tests.quantities):
            if each.place == tests.quantities[g].place and each.column >= 0 and each.is_of_joint:
                values[log_indices, i] /= scale
                sigmas[log_indices, i] /= scale
    return dataclasses.replace(tests, values=values, sigmas=sigmas)


def _compute_gain_scales(tests: QuantityTests) -> dict[tuple[int, int], np.ndarray]:
    """(periods,) 1 + gain / 100 of each gain that drifts or is apart."""
    scales = {
        key: 1.0 + compute_line(move, tests.get_series(*key).at) / 100.0
        for key, move in tests.drifts.items()
        if tests.quantities[key[1]].effect == GAIN
    }
    for key, outlier in tests.outliers.items():
        if tests.quantities[key[1]].effect == GAIN:
            scales[key] = np.full(len(tests.find_logs(*key)), 1.0 + outlier.difference / 100.0)
    return {key: np.maximum(scale, 0.1) for key, scale in scales.items()}
