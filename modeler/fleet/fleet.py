"""The fit of a fleet, its judgement, and what is handed back."""

from collections.abc import Sequence

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.fleet.drift import LEAST, arrange_by_time, compute_line
from modeler.fleet.joint_fit import LOAD, build_layout, fit_fleet
from modeler.fleet.judge import FALSE_ALARM, QuantityTests, evaluate_quantities
from modeler.fleet.result import (
    Fleet,
    FleetFinding,
    QuantityHistory,
    QuantityValues,
    TemperatureEffect,
)
from modeler.fleet.summary import LogSummary, SkippedLog, separate_foreign_logs


def analyse_fleet(spec: ModuleSpec, summaries: Sequence[LogSummary | SkippedLog]) -> Fleet:
    """What drifts where, from the summaries of all logs.

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
    used, foreign, foreign_notes = separate_foreign_logs(
        [log for log in summaries if isinstance(log, LogSummary)]
    )
    apart = [*(each for each in summaries if isinstance(each, SkippedLog)), *foreign]
    left = tuple((each.log_name.place, each.reason) for each in apart)
    _check_logs(used, left)
    logs, at, unit = arrange_by_time(used)
    layout = build_layout(spec)
    fit = fit_fleet(layout, logs)
    tests = evaluate_quantities(layout, fit, logs, at)
    findings = _build_findings(tests, logs)
    machines = _list_machines(logs)
    unused_machines = dict.fromkeys(
        e.log_name.machine for e in apart if e.log_name.machine not in machines
    )
    unseen = [
        f"{name}: none of its logs could be used: nothing is known of it"
        for name in unused_machines
    ]
    return Fleet(
        robot=spec.robot,
        unit=unit,
        machines=machines,
        findings=tuple(sorted(findings, key=lambda one: (one.chance, -abs(one.score)))),
        histories=_summarise_quantities(tests, logs),
        false_alarm=FALSE_ALARM,
        unidentified=fit.unidentified,
        skipped_logs=left,
        doubts=tuple(
            f"{e.log_name.machine}, {e.log_name.period}: {d}" for e in logs for d in e.doubts
        ),
        notes=(*_describe_filters(logs), *_collect_notes(tests, logs), *foreign_notes, *unseen),
    )


def _check_logs(used: Sequence[LogSummary], left: Sequence[tuple[str, str]]) -> None:
    if not used:
        raise DataError(f"fleet: none of {len(left)} logs can be used; the first: {left[0][1]}")
    machines = sorted({each.log_name.machine for each in used})
    skipped_text = f" (left out: {len(left)}, the first: {left[0][1]})" if left else ""
    if len(machines) == len(used) and len(machines) < LEAST:
        raise DataError(
            f"fleet: got one log each of {', '.join(machines)}{skipped_text}; expected two periods "
            "of a "
            f"machine, or {LEAST} machines; the folder of a log is its machine unless --name or "
            "--list says otherwise"
        )
    for k, each in enumerate(used):
        for other in used[:k]:
            overlap = each.span[0] <= other.span[1] and other.span[0] <= each.span[1]
            if each.content and each.content == other.content and overlap:
                raise DataError(
                    f"{each.log_name.place}: got rows of {other.log_name.place} again; expected "
                    "each row "
                    "once; leave one of the two out"
                )


def _build_findings(tests: QuantityTests, logs: Sequence[LogSummary]) -> list[FleetFinding]:
    findings = []
    for (m, i), move in tests.drifts.items():
        log_indices, quantity = tests.find_logs(m, i), tests.quantities[i]
        periods = [logs[k].log_name.period for k in log_indices]
        trend = move.shape == "trend"
        both = [
            (
                [logs[k] for k in tests.find_logs(other, i)],
                tests.values[tests.find_logs(other, i), i],
            )
            for other in (m, *(o for o in range(tests.machine_count) if o != m))
        ]
        findings.append(
            FleetFinding(
                machine=logs[log_indices[0]].log_name.machine,
                quantity=quantity,
                shape=move.shape,
                begin=periods[move.begin],
                end=periods[-1 if trend else move.begin],
                length=float(tests.at[log_indices[-1]] - tests.at[log_indices[0]])
                if trend
                else 0.0,
                before=move.level,
                change=move.change,
                sigma=move.sigma,
                score=move.score,
                chance=move.chance,
                temperature=compare_temperature(
                    both[0], quantity.joint, compute_line(move, tests.at[log_indices]), both[1:]
                ),
                since=len(log_indices) - move.begin,
            )
        )
    for (m, i), outlier in tests.outliers.items():
        log_indices = tests.find_logs(m, i)
        mean = float(
            np.average(tests.values[log_indices, i], weights=tests.sigmas[log_indices, i] ** -2.0)
        )
        findings.append(
            FleetFinding(
                machine=logs[log_indices[0]].named.machine,
                quantity=tests.quantities[i],
                shape="odd machine",
                begin=logs[log_indices[0]].named.period,
                end=logs[log_indices[-1]].named.period,
                length=float(tests.at[log_indices[-1]] - tests.at[log_indices[0]]),
                before=mean - outlier.difference,
                change=outlier.difference,
                sigma=outlier.spread,
                score=outlier.score,
                chance=0.5 * FALSE_ALARM,
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
                machines[name] = QuantityValues(
                    tests.at[log_indices], names, tests.values[log_indices, i], sigmas
                )
                if (m, i) in tests.scores:
                    scores[name] = tests.scores[m, i]
        known = tests.values[np.isfinite(tests.values[:, i]), i]
        level = float(np.median(known)) if known.size else float("nan")
        factor = tests.scatters[i].factor
        histories.append(
            QuantityHistory(quantity, level, factor, tests.find_smallest_drift(i), machines, scores)
        )
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
        machines[each.log_name.machine] = (
            *machines.get(each.log_name.machine, ()),
            each.log_name.period,
        )
    return machines


def _collect_notes(tests: QuantityTests, logs: Sequence[LogSummary]) -> list[str]:
    machines = _list_machines(logs)
    notes = [
        *describe_undetectable_drifts(tests, logs),
        *describe_unknown_scatter(tests, len(logs)),
    ]
    single = [name for name, periods in machines.items() if len(periods) < 2]
    if single:
        notes.append(
            f"{', '.join(single)}: one period, so a drift of its own cannot be seen; record another"
        )
    if len(machines) < LEAST:
        notes.append(
            f"{len(machines)} machine{'s' * (len(machines) > 1)}: an odd one among fewer than "
            f"{LEAST} is not told"
        )
    blind = [
        q.parameter
        for i, q in enumerate(tests.quantities)
        if not np.isfinite(tests.values[:, i]).any()
    ]
    if blind:
        notes.append(f"{', '.join(blind)}: no log tells it from the other parameters")
    return notes


FAR = 5.0
"""Times by which a machine's sigmas exceed those of the others, from which it is told."""

FEW = 5
"""Changes from period to period below which the scatter of a quantity is not known by them."""


def describe_undetectable_drifts(tests: QuantityTests, logs: Sequence[LogSummary]) -> list[str]:
    """A sentence on each machine that would hide a drift which the others would show."""
    names = list(dict.fromkeys(each.log_name.machine for each in logs))
    sigmas = np.array(
        [
            [_compute_usual_sigma(tests, m, i) for i in range(len(tests.quantities))]
            for m in range(tests.machine_count)
        ]
    )
    sentences = []
    for m, name in enumerate(names):
        hidden = []
        for i, quantity in enumerate(tests.quantities):
            others = np.delete(sigmas[:, i], m)
            others = others[np.isfinite(others)]
            if quantity.effect == LOAD or not others.size:
                continue
            times = sigmas[m, i] / float(np.median(others))
            if times > FAR:
                count = f"{times:.2g} times" if np.isfinite(times) else "not at all"
                hidden.append(f"{quantity.parameter} ({count})")
        if hidden:
            sentences.append(
                f"machine {name}: its logs tell {', '.join(hidden)} far worse than those of the "
                "others do (times their sigma): a drift that would be found there may hide here; "
                "record a motion like theirs"
            )
    return sentences


def _compute_usual_sigma(tests: QuantityTests, m: int, i: int) -> float:
    """Usual sigma of one log; infinite if none tells it, NaN of gains that a load stands for."""
    log_indices = tests.find_logs(m, i)
    if log_indices.size:
        return float(np.median(tests.sigmas[log_indices, i]))
    load = (
        tests.quantities[i].column < 0
        and tests.loaded_machines is not None
        and m in tests.loaded_machines
    )
    return float("nan") if load else float("inf")


def describe_unknown_scatter(tests: QuantityTests, logs: int) -> list[str]:
    """A sentence if the scatter from period to period comes from few changes."""
    count = max(
        sum(len(tests.get_series(m, i).standardised_changes) for m in range(tests.machine_count))
        for i in range(len(tests.quantities))
    )
    if count >= FEW or logs == tests.machine_count:
        return []
    return [
        f"{logs} logs: too few to know how values scatter from one period to the next; a drift "
        "must be large to be told, and that nothing drifts says little; record more periods"
    ]


# A temperature that moves along with what drifts may be its cause.


_SPAN = 2.0  # K; less is no warming
_ALONG = 0.8  # of what the shape of a finding explains, that a line in the temperature explains too
_LEAST = 0.5  # of the variance of the values
_OTHERS = 3  # machines that warmed too, from which they say whether warmth does it
_ENOUGH = 0.5  # of the change, that others must show over the same warming

Machine = tuple[Sequence[LogSummary], np.ndarray]
"""Logs of a machine, and (p,) values of a quantity."""


def compare_temperature(
    machine: Machine, joint: str | None, line: np.ndarray, others: Sequence[Machine]
) -> TemperatureEffect | None:
    """The temperature beside the values of one machine; None where a log has none.

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
    along = span >= _SPAN and correlation**2 >= max(_LEAST, _ALONG * shape)
    slopes = [
        slope
        for other in others
        if (slope := _fit_temperature_slope(other, joint, 0.5 * span)) is not None
    ]
    shared = None
    if along and len(slopes) >= _OTHERS:
        change = float(np.polyfit(degrees, values, 1)[0])
        shared = bool(np.median(slopes) / change >= _ENOUGH)
    return TemperatureEffect(float(degrees.min()), float(degrees.max()), correlation, along, shared)


def _fit_temperature_slope(machine: Machine, joint: str | None, least: float) -> float | None:
    """Change a kelvin of a machine that warms so much."""
    degrees = _collect_temperatures(machine[0], joint)
    if degrees is None or float(np.ptp(degrees)) < max(least, _SPAN):
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
