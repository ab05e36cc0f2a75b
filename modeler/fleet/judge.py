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
    least_detectable,
    line_of,
    move_of,
    outlying_machines,
    scatters,
)
from modeler.fleet.joint_fit import GAIN, LOAD, FleetFit, Layout, Quantity
from modeler.fleet.summary import LogSummary

FALSE_ALARM = 0.05
"""Chance of any finding in a fleet in which nothing drifts: half for drifts, half for odd ones."""


@dataclass(frozen=True, eq=False)
class JudgedQuantity:
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
    moves: dict[tuple[int, int], Drift] = dataclasses.field(default_factory=dict)
    odd: dict[tuple[int, int], Outlier] = dataclasses.field(default_factory=dict)
    scores: dict[tuple[int, int], float] = dataclasses.field(default_factory=dict)
    loaded: frozenset[int] | None = None

    @property
    def machines(self) -> int:
        """How many."""
        return int(self.machine.max()) + 1

    def may(self, m: int, i: int) -> bool:
        """False of a load in a machine that gains describe better: it would be told twice."""
        return self.loaded is None or self.quantities[i].effect != LOAD or m in self.loaded

    def known(self, m: int, i: int) -> np.ndarray:
        """Indices of the logs of a machine that tell a quantity."""
        return np.flatnonzero((self.machine == m) & np.isfinite(self.values[:, i]))

    def series(self, m: int, i: int) -> PeriodSeries:
        """A quantity of a machine."""
        own = self.known(m, i)
        return PeriodSeries(self.at[own], self.values[own, i], self.sigmas[own, i])

    def smallest_drift(self, i: int) -> float | None:
        """The smallest straight drift that the machine seen best would show."""
        found = [
            least_detectable(series, self.scatters[i], self.level)
            for m in range(self.machines)
            if len((series := self.series(m, i)).at) > 1
        ]
        return min(found, default=None)

    @property
    def level(self) -> float:
        """The chance that one series may have."""
        return 0.5 * FALSE_ALARM / (self.machines * len(self.quantities))


def judged(
    layout: Layout, fit: FleetFit, logs: Sequence[LogSummary], at: np.ndarray
) -> JudgedQuantity:
    """Tests all quantities of all machines; look-alikes are told by what they explain.

    A load enters the torques of several joints, a gain those of one: of machines whose load seems
    to change, the one that leaves less unexplained holds for all their logs, and the other is no
    finding. Friction and offset are in units of the logged torque; where a gain drifts, they are
    freed of it.
    """
    names = list(dict.fromkeys(each.named.machine for each in logs))
    machine = np.array([names.index(each.named.machine) for each in logs])
    values, sigmas = _arrays(layout, fit)
    found = JudgedQuantity(layout.quantities, machine, at, values, sigmas)
    found = dataclasses.replace(found, scatters=_scatters(found))
    if fit.loaded:
        found = _with_loads(found, layout, fit)
    gains = [i for i, each in enumerate(found.quantities) if each.effect == GAIN]
    others = [i for i, each in enumerate(found.quantities) if each.effect != GAIN]
    found = _without_gains(_tested(found, gains))
    return _tested(dataclasses.replace(found, scatters=_scatters(found)), others)


def _arrays(layout: Layout, fit: FleetFit) -> tuple[np.ndarray, np.ndarray]:
    """(k, d) values and sigmas, of friction and gains as without loads."""
    values = np.array([log.values for log in fit.logs])
    sigmas = np.array([log.sigmas for log in fit.logs])
    first = len(layout.columns)
    for array in (values, sigmas):
        array[:, first:] *= 100.0
    if fit.loaded:
        values = np.column_stack([values, [log.values[first] for log in fit.loaded]])
        sigmas = np.column_stack([sigmas, [log.sigmas[first] for log in fit.loaded]])
    return values, sigmas


def _scatters(found: JudgedQuantity) -> tuple[Scatter, ...]:
    groups = [
        [found.series(m, i) for m in range(found.machines)] for i in range(len(found.quantities))
    ]
    return tuple(scatters(groups))


def _with_loads(found: JudgedQuantity, layout: Layout, fit: FleetFit) -> JudgedQuantity:
    """The fits with a load in place of gains, of machines that these describe better."""
    load = len(found.quantities) - 1
    tested = _tested(found, [load])
    suspects = {m for m, _ in (*tested.moves, *tested.odd)}
    values, sigmas = found.values.copy(), found.sigmas.copy()
    first, loaded = len(layout.columns), set[int]()
    for m in range(found.machines):
        own = np.flatnonzero(found.machine == m)
        gain, with_load = (sum(fits[k].misfit for k in own) for fits in (fit.logs, fit.loaded))
        if m not in suspects or gain <= with_load:
            continue
        loaded.add(m)
        for k in own:
            values[k, :first] = fit.loaded[k].values[:first]
            sigmas[k, :first] = fit.loaded[k].sigmas[:first]
        values[own, first:load] = np.nan
    return dataclasses.replace(found, values=values, sigmas=sigmas, loaded=frozenset(loaded))


def _tested(found: JudgedQuantity, places: Sequence[int]) -> JudgedQuantity:
    """With the drifts and the odd machines of some quantities."""
    moves, odd, scores = dict(found.moves), dict(found.odd), dict(found.scores)
    level, families = found.level, len(found.quantities)
    for i in places:
        for m in range(found.machines):
            move = move_of(found.series(m, i), found.scatters[i])
            if move is not None:
                scores[m, i] = abs(move.score)
            if move is not None and move.chance < level and found.may(m, i):
                count = found.machines * families
                moves[m, i] = dataclasses.replace(move, chance=min(1.0, move.chance * count))
        means, spreads = _means(found, moves, i)
        for each in outlying_machines(means, spreads, 0.5 * FALSE_ALARM / families):
            if found.may(each.machine, i):
                odd[each.machine, i] = each
    return dataclasses.replace(found, moves=moves, odd=odd, scores=scores)


def _means(
    found: JudgedQuantity, moves: dict[tuple[int, int], Drift], i: int
) -> tuple[np.ndarray, np.ndarray]:
    """(machines,) means over the periods and their sigmas; NaN of machines that drift."""
    means, spreads = (np.full(found.machines, np.nan) for _ in range(2))
    for m in range(found.machines):
        series = found.series(m, i)
        if len(series.at) and (m, i) not in moves:
            weights = 1.0 / found.scatters[i].sigmas(series) ** 2
            means[m] = np.sum(weights * series.values) / weights.sum()
            spreads[m] = 1.0 / np.sqrt(weights.sum())
    return means, spreads


def _without_gains(found: JudgedQuantity) -> JudgedQuantity:
    """Friction and offset of joints whose gain drifts, or is apart, in units without that."""
    values, sigmas = found.values.copy(), found.sigmas.copy()
    for (m, g), scale in _gain_scales(found).items():
        own = found.known(m, g)
        for i, each in enumerate(found.quantities):
            if each.place == found.quantities[g].place and each.column >= 0 and each.own:
                values[own, i] /= scale
                sigmas[own, i] /= scale
    return dataclasses.replace(found, values=values, sigmas=sigmas)


def _gain_scales(found: JudgedQuantity) -> dict[tuple[int, int], np.ndarray]:
    """(periods,) 1 + gain / 100 of each gain that drifts or is apart."""
    scales = {
        key: 1.0 + line_of(move, found.series(*key).at) / 100.0
        for key, move in found.moves.items()
        if found.quantities[key[1]].effect == GAIN
    }
    for key, odd in found.odd.items():
        if found.quantities[key[1]].effect == GAIN:
            scales[key] = np.full(len(found.known(*key)), 1.0 + odd.difference / 100.0)
    return {key: np.maximum(scale, 0.1) for key, scale in scales.items()}
