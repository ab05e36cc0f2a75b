"""The fit of a fleet, its judgement, and what is handed back."""

from collections.abc import Sequence

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.fleet.drift import LEAST, in_time, line_of
from modeler.fleet.joint_fit import LOAD, joint_fit, layout_of
from modeler.fleet.judge import FALSE_ALARM, JudgedQuantity, judged
from modeler.fleet.result import Fleet, FleetFinding, Followed, Values, Warmth
from modeler.fleet.summary import LogSummary, SkippedLog, of_another_robot


def fleet_of(spec: ModuleSpec, given: Sequence[LogSummary | SkippedLog]) -> Fleet:
    """What drifts where, from the summaries of all logs.

    Each log k and joint j obeys y_kj = W_j (theta + D phi_k) + gamma_kj W_j theta with theta of the
    whole fleet; phi_k (friction, offset) and gamma_k (gain) of a machine over its periods are then
    tested for a straight line, a step and one period apart, and their means against those of the
    other machines. Chances are shared among all that is tested (Bonferroni): a fleet in which
    nothing drifts, its values scattering from period to period without memory and its machines
    differing as normal numbers do, has any finding with chance `FALSE_ALARM` at most.

    Args:
        spec: of the robot.
        given: from `reduce_log`.

    Raises:
        DataError: no usable logs, too few to compare, rows given twice, nothing that may drift.
    """
    used, foreign, said = of_another_robot([log for log in given if isinstance(log, LogSummary)])
    apart = [*(each for each in given if isinstance(each, SkippedLog)), *foreign]
    left = tuple((each.named.place, each.why) for each in apart)
    _check(used, left)
    logs, at, unit = in_time(used)
    layout = layout_of(spec)
    fit = joint_fit(layout, logs)
    found = judged(layout, fit, logs, at)
    findings = _findings(found, logs)
    machines = _machines(logs)
    gone = dict.fromkeys(e.named.machine for e in apart if e.named.machine not in machines)
    unseen = [f"{name}: none of its logs could be used: nothing is known of it" for name in gone]
    return Fleet(
        robot=spec.robot,
        unit=unit,
        machines=machines,
        findings=tuple(sorted(findings, key=lambda one: (one.chance, -abs(one.score)))),
        followed=_followed(found, logs),
        false_alarm=FALSE_ALARM,
        aside=fit.aside,
        left=left,
        doubts=tuple(f"{e.named.machine}, {e.named.period}: {d}" for e in logs for d in e.doubts),
        notes=(*_processed(logs), *_notes(found, logs), *said, *unseen),
    )


def _check(used: Sequence[LogSummary], left: Sequence[tuple[str, str]]) -> None:
    if not used:
        raise DataError(f"fleet: none of {len(left)} logs can be used; the first: {left[0][1]}")
    machines = sorted({each.named.machine for each in used})
    gone = f" (left out: {len(left)}, the first: {left[0][1]})" if left else ""
    if len(machines) == len(used) and len(machines) < LEAST:
        raise DataError(
            f"fleet: got one log each of {', '.join(machines)}{gone}; expected two periods of a "
            f"machine, or {LEAST} machines; the folder of a log is its machine unless --name or "
            "--list says otherwise"
        )
    for k, each in enumerate(used):
        for other in used[:k]:
            overlap = each.span[0] <= other.span[1] and other.span[0] <= each.span[1]
            if each.content and each.content == other.content and overlap:
                raise DataError(
                    f"{each.named.place}: got rows of {other.named.place} again; expected each row "
                    "once; leave one of the two out"
                )


def _findings(found: JudgedQuantity, logs: Sequence[LogSummary]) -> list[FleetFinding]:
    findings = []
    for (m, i), move in found.moves.items():
        own, quantity = found.known(m, i), found.quantities[i]
        periods = [logs[k].named.period for k in own]
        trend = move.shape == "trend"
        both = [
            ([logs[k] for k in found.known(other, i)], found.values[found.known(other, i), i])
            for other in (m, *(o for o in range(found.machines) if o != m))
        ]
        findings.append(
            FleetFinding(
                machine=logs[own[0]].named.machine,
                quantity=quantity,
                shape=move.shape,
                begin=periods[move.begin],
                end=periods[-1 if trend else move.begin],
                length=float(found.at[own[-1]] - found.at[own[0]]) if trend else 0.0,
                before=move.level,
                change=move.change,
                sigma=move.sigma,
                score=move.score,
                chance=move.chance,
                warmth=warmth_of(both[0], quantity.joint, line_of(move, found.at[own]), both[1:]),
                since=len(own) - move.begin,
            )
        )
    for (m, i), odd in found.odd.items():
        own = found.known(m, i)
        mean = float(np.average(found.values[own, i], weights=found.sigmas[own, i] ** -2.0))
        findings.append(
            FleetFinding(
                machine=logs[own[0]].named.machine,
                quantity=found.quantities[i],
                shape="odd machine",
                begin=logs[own[0]].named.period,
                end=logs[own[-1]].named.period,
                length=float(found.at[own[-1]] - found.at[own[0]]),
                before=mean - odd.difference,
                change=odd.difference,
                sigma=odd.spread,
                score=odd.score,
                chance=0.5 * FALSE_ALARM,
                since=len(own),
            )
        )
    return findings


def _followed(found: JudgedQuantity, logs: Sequence[LogSummary]) -> tuple[Followed, ...]:
    followed = []
    for i, quantity in enumerate(found.quantities):
        machines, scores = {}, {}
        for m in range(found.machines):
            own = found.known(m, i)
            if len(own):
                name = logs[own[0]].named.machine
                sigmas = found.scatters[i].sigmas(found.series(m, i))
                names = tuple(logs[k].named.period for k in own)
                machines[name] = Values(found.at[own], names, found.values[own, i], sigmas)
                if (m, i) in found.scores:
                    scores[name] = found.scores[m, i]
        known = found.values[np.isfinite(found.values[:, i]), i]
        level = float(np.median(known)) if known.size else float("nan")
        factor = found.scatters[i].factor
        followed.append(
            Followed(quantity, level, factor, found.smallest_drift(i), machines, scores)
        )
    return tuple(followed)


def _processed(logs: Sequence[LogSummary]) -> list[str]:
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
        f"positions below {_span(position)} Hz, torques and columns below {_span(parallel)} Hz"
    ]


def _span(values: np.ndarray) -> str:
    """As "5" or "3 to 5"."""
    return " to ".join(dict.fromkeys(f"{end:.4g}" for end in (values.min(), values.max())))


def _machines(logs: Sequence[LogSummary]) -> dict[str, tuple[str, ...]]:
    """Periods by machine."""
    machines: dict[str, tuple[str, ...]] = {}
    for each in logs:
        machines[each.named.machine] = (*machines.get(each.named.machine, ()), each.named.period)
    return machines


def _notes(found: JudgedQuantity, logs: Sequence[LogSummary]) -> list[str]:
    machines = _machines(logs)
    said = [*undetectable_drifts(found, logs), *scatter_known(found, len(logs))]
    single = [name for name, periods in machines.items() if len(periods) < 2]
    if single:
        said.append(
            f"{', '.join(single)}: one period, so a drift of its own cannot be seen; record another"
        )
    if len(machines) < LEAST:
        said.append(
            f"{len(machines)} machine{'s' * (len(machines) > 1)}: an odd one among fewer than "
            f"{LEAST} is not told"
        )
    blind = [q.parameter for i, q in enumerate(found.quantities)
             if not np.isfinite(found.values[:, i]).any()]  # fmt: skip
    if blind:
        said.append(f"{', '.join(blind)}: no log tells it from the other parameters")
    return said


FAR = 5.0
"""Times by which a machine's sigmas exceed those of the others, from which it is told."""

FEW = 5
"""Changes from period to period below which the scatter of a quantity is not known by them."""


def undetectable_drifts(found: JudgedQuantity, logs: Sequence[LogSummary]) -> list[str]:
    """A sentence on each machine that would hide a drift which the others would show."""
    names = list(dict.fromkeys(each.named.machine for each in logs))
    sigmas = np.array([[_sigma(found, m, i) for i in range(len(found.quantities))]
                       for m in range(found.machines)])  # fmt: skip
    said = []
    for m, name in enumerate(names):
        hidden = []
        for i, quantity in enumerate(found.quantities):
            others = np.delete(sigmas[:, i], m)
            others = others[np.isfinite(others)]
            if quantity.effect == LOAD or not others.size:
                continue
            times = sigmas[m, i] / float(np.median(others))
            if times > FAR:
                count = f"{times:.2g} times" if np.isfinite(times) else "not at all"
                hidden.append(f"{quantity.parameter} ({count})")
        if hidden:
            said.append(
                f"machine {name}: its logs tell {', '.join(hidden)} far worse than those of the "
                "others do (times their sigma): a drift that would be found there may hide here; "
                "record a motion like theirs"
            )
    return said


def _sigma(found: JudgedQuantity, m: int, i: int) -> float:
    """Usual sigma of one log; infinite if none tells it, NaN of gains that a load stands for."""
    own = found.known(m, i)
    if own.size:
        return float(np.median(found.sigmas[own, i]))
    load = found.quantities[i].column < 0 and found.loaded is not None and m in found.loaded
    return float("nan") if load else float("inf")


def scatter_known(found: JudgedQuantity, logs: int) -> list[str]:
    """A sentence if the scatter from period to period comes from few changes."""
    count = max(sum(len(found.series(m, i).changes) for m in range(found.machines))
                for i in range(len(found.quantities)))  # fmt: skip
    if count >= FEW or logs == found.machines:
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


def warmth_of(
    own: Machine, joint: str | None, line: np.ndarray, others: Sequence[Machine]
) -> Warmth | None:
    """The temperature beside the values of one machine; None where a log has none.

    It moves along if a straight line in it explains nearly as much as the shape that was found. If
    other machines warm too, it may be the cause only if they change with it.

    Args:
        own: the machine.
        joint: whose; its own column `temperature<joint>` rules over `temperature`.
        line: (p,) what the finding says that its values do.
        others: the same quantity of other machines.
    """
    degrees, values = _degrees(own[0], joint), own[1]
    if degrees is None:
        return None
    span, total = float(np.ptp(degrees)), float(np.var(values))
    told = span > 0.0 and total > 0.0
    correlation = float(np.corrcoef(degrees, values)[0, 1]) if told else np.nan
    shape = 1.0 - float(np.var(values - line)) / total if told else 1.0
    along = span >= _SPAN and correlation**2 >= max(_LEAST, _ALONG * shape)
    slopes = [slope for other in others if (slope := _slope(other, joint, 0.5 * span)) is not None]
    shared = None
    if along and len(slopes) >= _OTHERS:
        change = float(np.polyfit(degrees, values, 1)[0])
        shared = bool(np.median(slopes) / change >= _ENOUGH)
    return Warmth(float(degrees.min()), float(degrees.max()), correlation, along, shared)


def _slope(machine: Machine, joint: str | None, least: float) -> float | None:
    """Change a kelvin of a machine that warms so much."""
    degrees = _degrees(machine[0], joint)
    if degrees is None or float(np.ptp(degrees)) < max(least, _SPAN):
        return None
    return float(np.polyfit(degrees, machine[1], 1)[0])


def _degrees(logs: Sequence[LogSummary], joint: str | None) -> np.ndarray | None:
    """(p,) temperatures of the logs; None if one has none."""
    found = [_of_joint(log, joint) for log in logs]
    known = [degree for degree in found if degree is not None]
    return np.array(known) if len(known) == len(found) else None


def _of_joint(log: LogSummary, joint: str | None) -> float | None:
    """Its temperature; of a robot with one column for all, that; of no joint, the mean of all."""
    found = log.temperatures
    if joint is not None and joint in found:
        return found[joint]
    if "" in found:
        return found[""]
    return float(np.mean(list(found.values()))) if found and joint is None else None
