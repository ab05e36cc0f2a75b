"""What a fleet shows: findings, and the values behind them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.json import convert_to_plain, select_attributes
from modeler.core.result import Result
from modeler.core.table import align_columns, format_percent
from modeler.effects import CATALOGUE, find_effect
from modeler.fleet.drift import Unit
from modeler.fleet.joint_fit import GAIN, LOAD, Quantity


@dataclass(frozen=True)
class TemperatureEffect:
    """A temperature beside a finding.

    Attributes:
        lowest, highest: means of the logs, in the unit of their column.
        correlation: with the values of the machine.
        along: True if it moves along, so that it may be the cause.
        shared: True if other machines that warm alike change alike, False if they do not; None
            where too few of them warm.
    """

    lowest: float
    highest: float
    correlation: float
    is_correlated: bool
    is_shared: bool | None = None


@dataclass(frozen=True)
class FleetFinding(ShortRepr):
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
        chance: that a fleet in which nothing drifts shows this, all that was looked at counted.
        warmth: None where no temperature was logged.
        since: periods from begin on; a jump stays if it is in two.
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
    chance: float
    temperature: TemperatureEffect | None = None
    since: int = 0

    @property
    def change_percent(self) -> float | None:
        """The change in % of the value before; None of what has no size of its own."""
        if self.quantity.unit == "%":
            return self.change
        if self.quantity.effect in ("payload", "offset") or self.before == 0.0:
            return None
        return 100.0 * self.change / abs(self.before)


@dataclass(frozen=True, eq=False)
class QuantityValues(ShortRepr):
    """One quantity of one machine; p periods.

    Attributes:
        at: (p,) in days or periods since the first of the fleet.
        periods: (p,) their names.
        values: (p,) NaN where a log does not tell it.
        sigmas: (p,) scatter from one period to the next included.
    """

    at: np.ndarray
    periods: tuple[str, ...]
    values: np.ndarray
    sigmas: np.ndarray


@dataclass(frozen=True, eq=False)
class QuantityHistory(ShortRepr):
    """One quantity of all machines.

    Attributes:
        quantity: what.
        level: median over machines and periods; NaN if no log tells it.
        factor: by which it scatters from one period to the next more than its rows say; 1: no more.
        told: the smallest change over all periods that would be told; None with one period.
        machines: its values by machine.
        scores: its greatest change in sigmas, by machine with two periods and more.
    """

    quantity: Quantity
    level: float
    factor: float
    smallest_detectable: float | None
    machines: Mapping[str, QuantityValues]
    scores: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Fleet(Result):
    """What drifts where.

    Attributes:
        robot: kind of the machines.
        unit: of times: "days" or "periods".
        machines: names and their periods, in order.
        findings: the surest first.
        followed: all that was looked at, and a load if one could be told.
        false_alarm: chance that a fleet in which nothing drifts has any finding, at most.
        aside: common parameters that the logs cannot tell.
        left: logs that were not used, and why.
        doubts: what is wrong with the measurements.
        notes: what a reader must know.
    """

    robot: str
    unit: Unit
    machines: Mapping[str, tuple[str, ...]]
    findings: tuple[FleetFinding, ...]
    histories: tuple[QuantityHistory, ...]
    false_alarm: float
    unidentified: tuple[str, ...]
    skipped_logs: tuple[tuple[str, str], ...]
    doubts: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def logs(self) -> int:
        """Logs that were used."""
        return sum(len(periods) for periods in self.machines.values())

    @property
    def verdict(self) -> str:
        """Either "drift", "odd machine" or "nothing drifts"."""
        if any(finding.shape != "odd machine" for finding in self.findings):
            return "drift"
        return "odd machine" if self.findings else "nothing drifts"

    def to_json(self) -> dict[str, Any]:
        """The result for scripts; numbers that mean nothing are null."""
        return convert_to_plain(
            {
                "robot": self.robot,
                "verdict": self.verdict,
                "time": self.unit,
                **select_attributes(self, "logs machines"),
                "findings": [
                    _build_finding_json(finding)
                    | {"sentence": describe_finding(finding, self.unit)}
                    for finding in self.findings
                ],
                "quantities": [_build_history_json(each) for each in self.histories],
                "false_alarm": self.false_alarm,
                "not_told": self.unidentified,
                "left_out": [{"log": place, "why": why} for place, why in self.skipped_logs],
                **select_attributes(self, "doubts notes"),
            }
        )


_QUANTITY = "effect joint parameter unit"


def _build_finding_json(finding: FleetFinding) -> dict[str, Any]:
    temperature = finding.temperature
    return {
        "machine": finding.machine,
        **select_attributes(finding.quantity, _QUANTITY),
        "shape": finding.shape,
        "from": finding.begin,
        "to": finding.end,
        "periods_since": finding.since,
        **select_attributes(finding, "before change"),
        "change_percent": finding.change_percent,
        **select_attributes(finding, "sigma score chance"),
        "temperature": temperature
        and {
            **select_attributes(temperature, "lowest highest correlation"),
            "moves_along": temperature.is_correlated,
            "others_alike": temperature.is_shared,
        },
    }


def _build_history_json(each: QuantityHistory) -> dict[str, Any]:
    return {
        **select_attributes(each.quantity, _QUANTITY),
        "level": each.level,
        "scatter_factor": each.factor,
        "would_be_told": each.smallest_detectable,
        "machines": {
            name: select_attributes(values, "periods at values sigmas")
            | {"score": each.scores.get(name)}
            for name, values in each.machines.items()
        },
    }


# What a fleet shows, in words and as tables of text.


def format_effect_title(quantity: Quantity) -> str:
    """What drifts, in words of the catalogue."""
    if quantity.effect == GAIN:
        return "drive gain"
    if quantity.effect == LOAD:
        return "load on the last link"
    effect = find_effect(quantity.effect, CATALOGUE)
    return quantity.effect.replace("_", " ") if effect is None else effect.title


def describe_finding(finding: FleetFinding, unit: Unit) -> str:
    """One finding, with what it may be instead."""
    quantity = finding.quantity
    where = f"machine {finding.machine}" + (
        "" if quantity.joint is None else f", joint {quantity.joint}"
    )
    named = format_effect_title(quantity) + (
        "" if quantity.column < 0 else f" ({quantity.parameter})"
    )
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
    """A figure and what it is."""
    machines = f"{len(fleet.machines)} machine{'s' * (len(fleet.machines) != 1)}"
    less = ""
    if fleet.skipped_logs:
        less = f"; {len(fleet.skipped_logs)} log{'s' * (len(fleet.skipped_logs) > 1)} left out"
    if not fleet.findings:
        return "nothing", f"drifts beyond doubt on {machines} in {fleet.logs} logs{less}"
    hit = len({one.machine for one in fleet.findings})
    return f"{hit} of {machines}", f"drift or are apart from the others, beyond doubt{less}"


def format_fleet(fleet: Fleet) -> list[str]:
    """All of it, for people."""
    figure, what = format_headline(fleet)
    lines = [f"{fleet.robot}: {figure} {what}"]
    lines += [f"  {describe_finding(one, fleet.unit)}" for one in fleet.findings]
    lines += ["", *align_columns(build_table_rows(fleet), (0, 1)), ""]
    lines.append(
        "told: the smallest straight drift over all periods that would be a finding; chance of any "
        f"finding where nothing drifts: {format_percent(fleet.false_alarm)}"
    )
    lines += fleet.notes
    if any(one.quantity.effect == GAIN for one in fleet.findings):
        lines.append(
            "a drive gain above the others: the logged torque (current times gain) is more than "
            "the motion needs, as with a weaker magnet, or a torque sensor that reads too much"
        )
    lines += format_skipped(fleet)
    if fleet.unidentified:
        lines.append(f"not told by any log, taken as 0: {', '.join(fleet.unidentified)}")
    return lines


def format_skipped(fleet: Fleet) -> list[str]:
    """Logs that were not used, and why; most reasons begin with the place already."""
    return [
        f"left out: {why if place in why else f'{place}: {why}'}"
        for place, why in fleet.skipped_logs
    ]


HEAD = "joint, effect, parameter, level, unit, scatter, told"
"""Of the table of what was looked at."""


def build_table_rows(fleet: Fleet) -> list[list[str]]:
    """Header, and a row for each quantity."""
    return [
        HEAD.split(", "),
        *(
            [
                each.quantity.joint or "-",
                format_effect_title(each.quantity),
                each.quantity.parameter,
                f"{each.level:.4g}" if each.level == each.level else "-",
                each.quantity.unit,
                f"{each.factor:.2f}",
                "-" if each.smallest_detectable is None else f"{each.smallest_detectable:.2g}",
            ]
            for each in fleet.histories
        ),
    ]
