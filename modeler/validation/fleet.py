"""One robot kind, many machines and days: what drifts where."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.core.json import Document, ShortRepr
from modeler.core.manifest import ModuleSpec
from modeler.core.result import Result
from modeler.core.table import Column, align_columns, format_percent, format_rows
from modeler.effects import CATALOGUE, find_effect
from modeler.validation.fleet_drift import (
    QuantityTests,
    Unit,
    arrange_by_time,
    compute_line,
    evaluate_quantities,
    name_changes,
)
from modeler.validation.fleet_logs import (
    FLEET_THRESHOLDS,
    GAIN,
    LOAD,
    LogSummary,
    Quantity,
    SkippedLog,
    build_layout,
    fit_fleet,
    separate_foreign_logs,
)


@dataclass(frozen=True)
class TemperatureEffect:
    """A temperature beside a finding.

    Attributes:
        lowest, highest: means of the logs, in the unit of their column.
        correlation: with the values of the machine.
        is_correlated: True if it moves along, so that it may be the cause.
        is_shared: True if other machines that warm alike change alike, False if they do not; None
            where too few of them warm.
    """

    lowest: float
    highest: float
    correlation: float
    is_correlated: bool
    is_shared: bool | None = None


@dataclass(frozen=True)
class FleetFinding(ShortRepr, Document):
    """A machine that drifts, or is apart from the others.

    Attributes:
        machine: name.
        quantity: what.
        shape: "trend" | "jump" | "one period" | "odd machine".
        begin: period at which it begins; of an odd machine its first.
        end: last period of a trend or of an odd machine, else that of the change.
        length: from begin to end, in days or periods; 0 of a jump.
        before: value there; of an odd machine that of the others.
        change: from there on; of a gain in %.
        sigma: of the change.
        score: change in sigmas.
        p_value: that a fleet in which nothing drifts shows this, all that was looked at counted.
        temperature: None where no temperature was logged.
        since: periods from begin on; a jump stays if it is in two.
    """

    KEYS = """
        machine effect=quantity.effect joint=quantity.joint parameter=quantity.parameter
        unit=quantity.unit shape begin end periods_since=since before change change_percent sigma
        score p_value temperature
    """

    machine: str
    quantity: Quantity
    shape: str
    begin: str
    end: str
    length: float
    before: float
    change: float
    sigma: float
    score: float
    p_value: float
    temperature: TemperatureEffect | None = None
    since: int = 0

    @property
    def change_percent(self) -> float | None:
        """Returns the change in % of the value before; None of what has no size of its own."""
        if self.quantity.unit == "%":
            return self.change
        if self.quantity.effect in ("payload", "offset") or self.before == 0.0:
            return None
        return 100.0 * self.change / abs(self.before)


@dataclass(frozen=True, eq=False)
class QuantityValues(ShortRepr, Document):
    """One quantity of one machine; p periods.

    Attributes:
        times: (p,) in days or periods since the first of the fleet.
        periods: (p,) their names.
        values: (p,) NaN where a log does not determine it.
        sigmas: (p,) scatter from one period to the next included.
    """

    KEYS = "periods times values sigmas"

    times: np.ndarray
    periods: tuple[str, ...]
    values: np.ndarray
    sigmas: np.ndarray


@dataclass(frozen=True, eq=False)
class QuantityHistory(ShortRepr, Document):
    """One quantity of all machines.

    Attributes:
        quantity: what.
        level: median over machines and periods; NaN if no log determines it.
        factor: by which it scatters from one period to the next more than its rows say; 1: no more.
        smallest_detectable: the smallest detectable change over all periods; None with one period.
        machines: its values by machine.
        scores: its greatest change in sigmas, by machine with two periods and more.
    """

    KEYS = """
        effect=quantity.effect joint=quantity.joint parameter=quantity.parameter unit=quantity.unit
        level scatter_factor=factor smallest_detectable machines=machine_values
    """

    quantity: Quantity
    level: float
    factor: float
    smallest_detectable: float | None
    machines: Mapping[str, QuantityValues]
    scores: Mapping[str, float]

    @property
    def machine_values(self) -> dict[str, "MachineValues"]:
        """Returns its values by machine, with the greatest change in sigmas."""
        pairs = self.machines.items()
        return {name: MachineValues(values, self.scores.get(name)) for name, values in pairs}


@dataclass(frozen=True)
class MachineValues(Document):
    """A quantity of one machine; score: its greatest change in sigmas, None of one period."""

    KEYS = "*values score"

    values: QuantityValues
    score: float | None


@dataclass(frozen=True)
class DescribedFinding(Document):
    """A finding in numbers and in a sentence."""

    KEYS = "*finding sentence"

    finding: FleetFinding
    sentence: str


@dataclass(frozen=True)
class SkippedFile:
    """A log that was not used, and why."""

    log: str
    reason: str


@dataclass(frozen=True, eq=False)
class Fleet(Result, Document):
    """What drifts where in a fleet of machines.

    Attributes:
        robot: kind of the machines.
        unit: of times: "days" or "periods".
        machines: names and their periods, in order.
        findings: the surest first.
        changes: what of each machine that drifts changed, by name and size, a sentence each.
        histories: all that was looked at, and a load if one could be identified.
        false_alarm: chance that a fleet in which nothing drifts has any finding, at most.
        unresolved: common parameters that the logs cannot identify.
        skipped_logs: logs that were not used, and why.
        warnings: what is wrong with the measurements.
        notes: what a reader must know.
    """

    KEYS = """
        robot verdict time_unit=unit logs machines findings=described_findings changes
        quantities=histories false_alarm unresolved skipped_logs=skipped_files warnings notes
    """

    robot: str
    unit: Unit
    machines: Mapping[str, tuple[str, ...]]
    findings: tuple[FleetFinding, ...]
    changes: tuple[str, ...]
    histories: tuple[QuantityHistory, ...]
    false_alarm: float
    unresolved: tuple[str, ...]
    skipped_logs: tuple[tuple[str, str], ...]
    warnings: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def logs(self) -> int:
        """Returns the number of logs that were used."""
        return sum(len(periods) for periods in self.machines.values())

    @property
    def verdict(self) -> str:
        """Returns "drift", "odd machine" or "nothing drifts"."""
        if any(finding.shape != "odd machine" for finding in self.findings):
            return "drift"
        return "odd machine" if self.findings else "nothing drifts"

    @property
    def described_findings(self) -> tuple["DescribedFinding", ...]:
        """Returns the findings with a sentence each."""
        return tuple(DescribedFinding(f, describe_finding(f, self.unit)) for f in self.findings)

    @property
    def skipped_files(self) -> tuple["SkippedFile", ...]:
        """Returns the logs that were not used, and why."""
        return tuple(SkippedFile(*pair) for pair in self.skipped_logs)


# What a fleet shows, in words and as tables of text.


def format_effect_title(quantity: Quantity) -> str:
    """Formats what drifts, in words of the catalogue."""
    if quantity.effect == GAIN:
        return "drive gain"
    if quantity.effect == LOAD:
        return "load on the last link"
    effect = find_effect(quantity.effect, CATALOGUE)
    return quantity.effect.replace("_", " ") if effect is None else effect.title


def describe_finding(finding: FleetFinding, unit: Unit) -> str:
    """Describes one finding, with what it may be instead."""
    quantity = finding.quantity
    where = f"machine {finding.machine}"
    where += "" if quantity.joint is None else f", joint {quantity.joint}"
    named = format_effect_title(quantity)
    named += "" if quantity.column < 0 else f" ({quantity.parameter})"
    line = f"{where}: {named} {_describe_change(finding, unit)}"
    temperature = finding.temperature
    if temperature is None or not temperature.is_correlated:
        return line
    cause = "and may be the cause: compare periods of one temperature"
    if temperature.is_shared is False:
        cause = "but machines that warm alike do not change so"
    return (
        f"{line}; the temperature of the logs moves along, {temperature.lowest:.4g} to "
        f"{temperature.highest:.4g} (correlation {temperature.correlation:.2f}), {cause}"
    )


def _describe_change(finding: FleetFinding, unit: Unit) -> str:
    up = finding.change > 0.0
    size = f"{abs(finding.change):.3g} {finding.quantity.unit}"
    if finding.change_percent is not None:
        size = format_percent(0.01 * abs(finding.change_percent))
    after = f"{finding.before:.4g} to {finding.before + finding.change:.4g} {finding.quantity.unit}"
    if finding.shape == "odd machine":
        side = "above" if up else "below"
        return f"is {size} {side} that of the other machines ({finding.score:+.1f} of their spread)"
    if finding.shape == "trend":
        verb = "rises" if up else "falls"
        span = f"{finding.length:.3g} {unit}"
        return f"{verb} by {size} over {span}, from {after} ({abs(finding.score):.1f} sigma)"
    stays = " and is back after it"
    if finding.shape == "jump":  # of the time after a leap in the last period nothing is known
        unknown = ", the last period (whether it stays is not known)"
        stays = " and stays" if finding.since > 1 else unknown
    verb = "leaps up" if up else "leaps down"
    return (
        f"{verb} by {size} at {finding.begin}{stays}, from {after} ({abs(finding.score):.1f} sigma)"
    )


def format_headline(fleet: Fleet) -> tuple[str, str]:
    """Formats a figure and what it is."""
    machines = f"{len(fleet.machines)} machine{'s' * (len(fleet.machines) != 1)}"
    less = ""
    if fleet.skipped_logs:
        less = f"; {len(fleet.skipped_logs)} log{'s' * (len(fleet.skipped_logs) > 1)} left out"
    if not fleet.findings:
        return "nothing", f"drifts significantly on {machines} in {fleet.logs} logs{less}"
    hit = len({one.machine for one in fleet.findings})
    return f"{hit} of {machines}", f"drift or differ from the others significantly{less}"


def format_fleet(fleet: Fleet) -> list[str]:
    """Formats all of it, for people."""
    figure, what = format_headline(fleet)
    lines = [f"{fleet.robot}: {figure} {what}"]
    lines += [f"  {describe_finding(one, fleet.unit)}" for one in fleet.findings]
    lines += [f"  {line}" for line in fleet.changes]
    lines += ["", *align_columns(format_rows(QUANTITY_COLUMNS, fleet.histories), (0, 1)), ""]
    lines.append(
        "detectable: the smallest straight drift over all periods that is a finding; chance of any "
        f"finding where nothing drifts: {format_percent(fleet.false_alarm)}"
    )
    lines += fleet.notes
    if any(one.quantity.effect == GAIN for one in fleet.findings):
        lines.append(
            "a drive gain above the others: the logged torque (current times gain) is more than "
            "the motion needs, as with a weaker magnet, or a torque sensor that reads too much"
        )
    lines += format_skipped(fleet)
    if fleet.unresolved:
        lines.append(f"not identifiable from any log, taken as 0: {', '.join(fleet.unresolved)}")
    return lines


def format_skipped(fleet: Fleet) -> list[str]:
    """Formats the logs that were not used, and why."""
    texts = (why if place in why else f"{place}: {why}" for place, why in fleet.skipped_logs)
    return [f"left out: {text}" for text in texts]


QUANTITY_COLUMNS = (
    Column("joint", "quantity.joint"),
    Column("effect", lambda each: format_effect_title(each.quantity), kind="text"),
    Column("parameter", "quantity.parameter", kind="text"),
    Column("level", "level", ".4g"),
    Column("unit", "quantity.unit", kind="text"),
    Column("scatter", "factor", ".2f"),
    Column("detectable", "smallest_detectable", ".2g"),
)
"""Of the table of what was looked at."""


def analyse_fleet(spec: ModuleSpec, summaries: Sequence[LogSummary | SkippedLog]) -> Fleet:
    """Finds what drifts where, from the summaries of all logs.

    Each log k and joint j obeys y_kj = W_j (theta + D phi_k) + gamma_kj W_j theta with theta of the
    whole fleet; phi_k (friction, offset) and gamma_k (gain) of a machine over its periods are then
    tested for a straight line, a step and one period apart, and their means against those of the
    other machines. Chances are shared among all that is tested (Bonferroni): a fleet in which
    nothing drifts, its values scattering from period to period without memory and its machines
    differing as normal numbers do, has any finding with chance `FALSE_ALARM` at most.

    Args:
        spec: of the robot.
        summaries: from `reduce_log`.

    Raises:
        DataError: no usable logs, too few to compare, rows given twice, nothing that may drift.
    """
    reduced = [log for log in summaries if isinstance(log, LogSummary)]
    used, foreign, foreign_notes = separate_foreign_logs(reduced)
    apart = [*(each for each in summaries if isinstance(each, SkippedLog)), *foreign]
    left = tuple((each.log_name.place, each.reason) for each in apart)
    _check_logs(used, left)
    logs, at, unit = arrange_by_time(used)
    layout = build_layout(spec)
    fit = fit_fleet(layout, logs)
    tests = evaluate_quantities(spec, layout, fit, logs, at)
    findings = _build_findings(tests, logs)
    machines = _list_machines(logs)
    unused = dict.fromkeys(each.log_name.machine for each in apart)
    unused_machines = [name for name in unused if name not in machines]
    text = "none of its logs could be used: nothing is known of it"
    unseen = [f"{name}: {text}" for name in unused_machines]
    return Fleet(
        robot=spec.robot,
        unit=unit,
        machines=machines,
        changes=name_changes(spec, tests, logs),
        findings=tuple(sorted(findings, key=lambda one: (one.p_value, -abs(one.score)))),
        histories=_summarise_quantities(tests, logs),
        false_alarm=FLEET_THRESHOLDS.false_alarm,
        unresolved=fit.unidentified,
        skipped_logs=left,
        warnings=tuple(
            f"{e.log_name.machine}, {e.log_name.period}: {d}" for e in logs for d in e.doubts
        ),
        notes=(*_describe_filters(logs), *_collect_notes(tests, logs), *foreign_notes, *unseen),
    )


def _check_logs(used: Sequence[LogSummary], left: Sequence[tuple[str, str]]) -> None:
    if not used:
        raise DataError(f"fleet: none of {len(left)} logs can be used; the first: {left[0][1]}")
    machines = sorted({each.log_name.machine for each in used})
    skipped_text = f" (left out: {len(left)}, the first: {left[0][1]})" if left else ""
    if len(machines) == len(used) and len(machines) < FLEET_THRESHOLDS.min_machines:
        raise DataError(
            f"fleet: got one log each of {', '.join(machines)}{skipped_text}; expected two periods "
            f"of a machine, or {FLEET_THRESHOLDS.min_machines} machines; the folder of a log is "
            "its machine unless --name or --list says otherwise"
        )
    for k, each in enumerate(used):
        for other in used[:k]:
            overlap = each.span[0] <= other.span[1] and other.span[0] <= each.span[1]
            if each.content and each.content == other.content and overlap:
                raise DataError(
                    f"{each.log_name.place}: got rows of {other.log_name.place} again; expected "
                    "each row once; leave one of the two out"
                )


def _build_findings(tests: QuantityTests, logs: Sequence[LogSummary]) -> list[FleetFinding]:
    findings = []
    for (m, i), move in tests.drifts.items():
        log_indices, quantity = tests.find_logs(m, i), tests.quantities[i]
        periods = [logs[k].log_name.period for k in log_indices]
        trend, at = move.shape == "trend", tests.at[log_indices]
        line, span = compute_line(move, at), float(at[-1] - at[0])
        order = (m, *(o for o in range(tests.machine_count) if o != m))
        places = [tests.find_logs(other, i) for other in order]
        both = [([logs[k] for k in place], tests.values[place, i]) for place in places]
        findings.append(
            FleetFinding(
                machine=logs[log_indices[0]].log_name.machine,
                quantity=quantity,
                shape=move.shape,
                begin=periods[move.begin],
                end=periods[-1 if trend else move.begin],
                length=span if trend else 0.0,
                before=move.level,
                change=move.change,
                sigma=move.sigma,
                score=move.score,
                p_value=move.chance,
                temperature=compare_temperature(both[0], quantity.joint, line, both[1:]),
                since=len(log_indices) - move.begin,
            )
        )
    for (m, i), outlier in tests.outliers.items():
        log_indices = tests.find_logs(m, i)
        weights = tests.sigmas[log_indices, i] ** -2.0
        mean = float(np.average(tests.values[log_indices, i], weights=weights))
        findings.append(
            FleetFinding(
                machine=logs[log_indices[0]].log_name.machine,
                quantity=tests.quantities[i],
                shape="odd machine",
                begin=logs[log_indices[0]].log_name.period,
                end=logs[log_indices[-1]].log_name.period,
                length=float(tests.at[log_indices[-1]] - tests.at[log_indices[0]]),
                before=mean - outlier.difference,
                change=outlier.difference,
                sigma=outlier.spread,
                score=outlier.score,
                p_value=0.5 * FLEET_THRESHOLDS.false_alarm,
                since=len(log_indices),
            )
        )
    return findings


def _summarise_quantities(
    tests: QuantityTests, logs: Sequence[LogSummary]
) -> tuple[QuantityHistory, ...]:
    histories = []
    for i, quantity in enumerate(tests.quantities):
        machines, scores = {}, {}
        for m in range(tests.machine_count):
            log_indices = tests.find_logs(m, i)
            if len(log_indices):
                name = logs[log_indices[0]].log_name.machine
                sigmas = tests.scatters[i].compute_sigmas(tests.get_series(m, i))
                names = tuple(logs[k].log_name.period for k in log_indices)
                values = tests.values[log_indices, i]
                machines[name] = QuantityValues(tests.at[log_indices], names, values, sigmas)
                if (m, i) in tests.scores:
                    scores[name] = tests.scores[m, i]
        known = tests.values[np.isfinite(tests.values[:, i]), i]
        level = float(np.median(known)) if known.size else float("nan")
        factor = tests.scatters[i].factor
        least = tests.find_smallest_drift(i)
        histories.append(QuantityHistory(quantity, level, factor, least, machines, scores))
    return tuple(histories)


def _describe_filters(logs: Sequence[LogSummary]) -> list[str]:
    """Between what cut-offs the logs were filtered, and where they differ, why."""
    chosen = [each.processing for each in logs if each.processing is not None]
    position, parallel = (
        np.array([getattr(each, f"{what}_cutoff") or 0.0 for each in chosen])
        for what in ("position", "parallel")
    )
    if not parallel.any():
        return []
    alike = np.ptp(position) == 0.0 and np.ptp(parallel) == 0.0
    return [
        f"{'all logs are filtered alike' if alike else 'each log is filtered as its noise asks'}: "
        f"positions below {_format_range(position)} Hz, torques and columns below "
        f"{_format_range(parallel)} Hz"
    ]


def _format_range(values: np.ndarray) -> str:
    """As "5" or "3 to 5"."""
    return " to ".join(dict.fromkeys(f"{end:.4g}" for end in (values.min(), values.max())))


def _list_machines(logs: Sequence[LogSummary]) -> dict[str, tuple[str, ...]]:
    """Periods by machine."""
    machines: dict[str, tuple[str, ...]] = {}
    for each in logs:
        name = each.log_name
        machines[name.machine] = (*machines.get(name.machine, ()), name.period)
    return machines


def _collect_notes(tests: QuantityTests, logs: Sequence[LogSummary]) -> list[str]:
    machines = _list_machines(logs)
    notes = describe_undetectable_drifts(tests, logs) + describe_unknown_scatter(tests, len(logs))
    single = [name for name, periods in machines.items() if len(periods) < 2]
    if single:
        notes.append(
            f"{', '.join(single)}: one period, so a drift of its own cannot be seen; record another"
        )
    if len(machines) < FLEET_THRESHOLDS.min_machines:
        notes.append(
            f"{len(machines)} machine{'s' * (len(machines) > 1)}: an outlier among fewer than "
            f"{FLEET_THRESHOLDS.min_machines} is not reported"
        )
    known = np.isfinite(tests.values).any(axis=0)
    blind = [q.parameter for q, seen in zip(tests.quantities, known, strict=True) if not seen]
    if blind:
        notes.append(f"{', '.join(blind)}: no log distinguishes it from the other parameters")
    return notes


def describe_undetectable_drifts(tests: QuantityTests, logs: Sequence[LogSummary]) -> list[str]:
    """Describes each machine whose logs hide a drift that those of others would show."""
    names = list(dict.fromkeys(each.log_name.machine for each in logs))
    columns, count = range(len(tests.quantities)), tests.machine_count
    every = [[_compute_usual_sigma(tests, m, i) for i in columns] for m in range(count)]
    sigmas = np.array(every)
    sentences = []
    for m, name in enumerate(names):
        hidden = []
        for i, quantity in enumerate(tests.quantities):
            others = np.delete(sigmas[:, i], m)
            others = others[np.isfinite(others)]
            if quantity.effect == LOAD or not others.size:
                continue
            times = sigmas[m, i] / float(np.median(others))
            if times > FLEET_THRESHOLDS.max_sigma_ratio:
                worse = f"{times:.2g} times" if np.isfinite(times) else "not at all"
                hidden.append(f"{quantity.parameter} ({worse})")
        if hidden:
            sentences.append(
                f"machine {name}: its logs determine {', '.join(hidden)} far worse than the "
                "others do (times their sigma): a drift found there may be missed here; "
                "record a motion like theirs"
            )
    return sentences


def _compute_usual_sigma(tests: QuantityTests, m: int, i: int) -> float:
    """Usual sigma of one log; infinite if none shows it, NaN of gains that a load stands for."""
    log_indices = tests.find_logs(m, i)
    if log_indices.size:
        return float(np.median(tests.sigmas[log_indices, i]))
    load = tests.quantities[i].column < 0 and m in (tests.loaded_machines or ())
    return float("nan") if load else float("inf")


def describe_unknown_scatter(tests: QuantityTests, logs: int) -> list[str]:
    """Describes that the scatter from period to period comes from few changes."""
    machines, columns = range(tests.machine_count), range(len(tests.quantities))
    series = ((tests.get_series(m, i) for m in machines) for i in columns)
    count = max(sum(len(one.standardised_changes) for one in each) for each in series)
    if count >= FLEET_THRESHOLDS.min_changes or logs == tests.machine_count:
        return []
    return [
        f"{logs} logs: too few to know how values scatter from one period to the next; a drift "
        "must be large to be detected, and that nothing drifts says little; record more periods"
    ]


# A temperature that moves along with what drifts may be its cause.


Machine = tuple[Sequence[LogSummary], np.ndarray]
"""Logs of a machine, and (p,) values of a quantity."""


def compare_temperature(
    machine: Machine, joint: str | None, line: np.ndarray, others: Sequence[Machine]
) -> TemperatureEffect | None:
    """Compares the temperature with the values of one machine; None where a log has none.

    It moves along if a straight line in it explains nearly as much as the shape that was found. If
    other machines warm too, it may be the cause only if they change with it.

    Args:
        machine: the machine.
        joint: whose; its own column `temperature<joint>` rules over `temperature`.
        line: (p,) what the finding says that its values do.
        others: the same quantity of other machines.
    """
    degrees, values = _collect_temperatures(machine[0], joint), machine[1]
    if degrees is None:
        return None
    span, total = float(np.ptp(degrees)), float(np.var(values))
    is_varying = span > 0.0 and total > 0.0
    correlation = float(np.corrcoef(degrees, values)[0, 1]) if is_varying else np.nan
    shape = 1.0 - float(np.var(values - line)) / total if is_varying else 1.0
    limits = FLEET_THRESHOLDS
    least = max(limits.min_temperature_variance, limits.min_temperature_share * shape)
    along = span >= limits.min_temperature_span and correlation**2 >= least
    every = (_fit_temperature_slope(other, joint, 0.5 * span) for other in others)
    slopes = [slope for slope in every if slope is not None]
    shared = None
    if along and len(slopes) >= FLEET_THRESHOLDS.min_warmed_machines:
        change = float(np.polyfit(degrees, values, 1)[0])
        shared = bool(np.median(slopes) / change >= FLEET_THRESHOLDS.min_shared_change)
    return TemperatureEffect(float(degrees.min()), float(degrees.max()), correlation, along, shared)


def _fit_temperature_slope(machine: Machine, joint: str | None, least: float) -> float | None:
    """Change a kelvin of a machine that warms so much."""
    degrees = _collect_temperatures(machine[0], joint)
    least = max(least, FLEET_THRESHOLDS.min_temperature_span)
    if degrees is None or float(np.ptp(degrees)) < least:
        return None
    return float(np.polyfit(degrees, machine[1], 1)[0])


def _collect_temperatures(logs: Sequence[LogSummary], joint: str | None) -> np.ndarray | None:
    """(p,) temperatures of the logs; None if one has none."""
    temperatures = [_select_temperature(log, joint) for log in logs]
    known = [degree for degree in temperatures if degree is not None]
    return np.array(known) if len(known) == len(temperatures) else None


def _select_temperature(log: LogSummary, joint: str | None) -> float | None:
    """Its temperature; of a robot with one column for all, that; of no joint, the mean of all."""
    temperatures = log.temperatures
    if joint is not None and joint in temperatures:
        return temperatures[joint]
    if "" in temperatures:
        return temperatures[""]
    return float(np.mean(list(temperatures.values()))) if temperatures and joint is None else None
