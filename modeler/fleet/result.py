"""What a fleet shows: findings, and the values behind them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.brief import Brief
from modeler.core.json import entries, nulled
from modeler.core.result import Presented
from modeler.core.table import aligned, percent
from modeler.effects import CATALOGUE, effect_named
from modeler.fleet.drift import Unit
from modeler.fleet.joint_fit import GAIN, LOAD, Quantity


@dataclass(frozen=True)
class Warmth:
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
    along: bool
    shared: bool | None = None


@dataclass(frozen=True)
class FleetFinding(Brief):
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
    warmth: Warmth | None = None
    since: int = 0

    @property
    def percent(self) -> float | None:
        """The change in % of the value before; None of what has no size of its own."""
        if self.quantity.unit == "%":
            return self.change
        if self.quantity.effect in ("payload", "offset") or self.before == 0.0:
            return None
        return 100.0 * self.change / abs(self.before)


@dataclass(frozen=True, eq=False)
class Values(Brief):
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
class Followed(Brief):
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
    told: float | None
    machines: Mapping[str, Values]
    scores: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Fleet(Presented):
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
    followed: tuple[Followed, ...]
    false_alarm: float
    aside: tuple[str, ...]
    left: tuple[tuple[str, str], ...]
    doubts: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def logs(self) -> int:
        """Logs that were used."""
        return sum(len(periods) for periods in self.machines.values())

    @property
    def verdict(self) -> str:
        """Either "drift", "odd machine" or "nothing drifts"."""
        if any(found.shape != "odd machine" for found in self.findings):
            return "drift"
        return "odd machine" if self.findings else "nothing drifts"

    def to_json(self) -> dict[str, Any]:
        """The result for scripts; numbers that mean nothing are null."""
        return nulled({
            "robot": self.robot,
            "verdict": self.verdict,
            "time": self.unit,
            **entries(self, "logs machines"),
            "findings": [_finding(found) | {"sentence": sentence(found, self.unit)}
                         for found in self.findings],
            "quantities": [_followed(each) for each in self.followed],
            "false_alarm": self.false_alarm,
            "not_told": self.aside,
            "left_out": [{"log": place, "why": why} for place, why in self.left],
            **entries(self, "doubts notes"),
        })  # fmt: skip


_QUANTITY = "effect joint parameter unit"


def _finding(found: FleetFinding) -> dict[str, Any]:
    warmth = found.warmth
    return {
        "machine": found.machine,
        **entries(found.quantity, _QUANTITY),
        "shape": found.shape,
        "from": found.begin,
        "to": found.end,
        "periods_since": found.since,
        **entries(found, "before change"),
        "change_percent": found.percent,
        **entries(found, "sigma score chance"),
        "temperature": warmth and {
            **entries(warmth, "lowest highest correlation"),
            "moves_along": warmth.along, "others_alike": warmth.shared,
        },
    }  # fmt: skip


def _followed(each: Followed) -> dict[str, Any]:
    return {
        **entries(each.quantity, _QUANTITY),
        "level": each.level,
        "scatter_factor": each.factor,
        "would_be_told": each.told,
        "machines": {
            name: entries(own, "periods at values sigmas") | {"score": each.scores.get(name)}
            for name, own in each.machines.items()
        },
    }


# What a fleet shows, in words and as tables of text.


def effect_title(quantity: Quantity) -> str:
    """What drifts, in words of the catalogue."""
    if quantity.effect == GAIN:
        return "drive gain"
    if quantity.effect == LOAD:
        return "load on the last link"
    effect = effect_named(quantity.effect, CATALOGUE)
    return quantity.effect.replace("_", " ") if effect is None else effect.title


def sentence(found: FleetFinding, unit: Unit) -> str:
    """One finding, with what it may be instead."""
    quantity = found.quantity
    where = f"machine {found.machine}" + (
        "" if quantity.joint is None else f", joint {quantity.joint}"
    )
    named = effect_title(quantity) + ("" if quantity.column < 0 else f" ({quantity.parameter})")
    line = f"{where}: {named} {_happens(found, unit)}"
    warmth = found.warmth
    if warmth is None or not warmth.along:
        return line
    cause = "and may be the cause: compare periods of one temperature"
    if warmth.shared is False:
        cause = "but machines that warm alike do not change so"
    return (
        f"{line}; the temperature of the logs moves along, {warmth.lowest:.4g} to "
        f"{warmth.highest:.4g} (correlation {warmth.correlation:.2f}), {cause}"
    )


def _happens(found: FleetFinding, unit: Unit) -> str:
    up = found.change > 0.0
    size = f"{abs(found.change):.3g} {found.quantity.unit}"
    if found.percent is not None:
        size = percent(0.01 * abs(found.percent))
    after = f"{found.before:.4g} to {found.before + found.change:.4g} {found.quantity.unit}"
    if found.shape == "odd machine":
        side = "above" if up else "below"
        return f"is {size} {side} that of the other machines ({found.score:+.1f} of their spread)"
    if found.shape == "trend":
        verb = "rises" if up else "falls"
        span = f"{found.length:.3g} {unit}"
        return f"{verb} by {size} over {span}, from {after} ({abs(found.score):.1f} sigma)"
    stays = " and is back after it"
    if found.shape == "jump":  # of the time after a leap in the last period nothing is known
        told = ", the last period (whether it stays is not known)"
        stays = " and stays" if found.since > 1 else told
    verb = "leaps up" if up else "leaps down"
    return f"{verb} by {size} at {found.begin}{stays}, from {after} ({abs(found.score):.1f} sigma)"


def headline_of(found: Fleet) -> tuple[str, str]:
    """A figure and what it is."""
    machines = f"{len(found.machines)} machine{'s' * (len(found.machines) != 1)}"
    less = ""
    if found.left:
        less = f"; {len(found.left)} log{'s' * (len(found.left) > 1)} left out"
    if not found.findings:
        return "nothing", f"drifts beyond doubt on {machines} in {found.logs} logs{less}"
    hit = len({one.machine for one in found.findings})
    return f"{hit} of {machines}", f"drift or are apart from the others, beyond doubt{less}"


def fleet_lines(found: Fleet) -> list[str]:
    """All of it, for people."""
    figure, what = headline_of(found)
    lines = [f"{found.robot}: {figure} {what}"]
    lines += [f"  {sentence(one, found.unit)}" for one in found.findings]
    lines += ["", *aligned(rows_of(found), (0, 1)), ""]
    lines.append(
        "told: the smallest straight drift over all periods that would be a finding; chance of any "
        f"finding where nothing drifts: {percent(found.false_alarm)}"
    )
    lines += found.notes
    if any(one.quantity.effect == GAIN for one in found.findings):
        lines.append(
            "a drive gain above the others: the logged torque (current times gain) is more than "
            "the motion needs, as with a weaker magnet, or a torque sensor that reads too much"
        )
    lines += skipped_lines(found)
    if found.aside:
        lines.append(f"not told by any log, taken as 0: {', '.join(found.aside)}")
    return lines


def skipped_lines(found: Fleet) -> list[str]:
    """Logs that were not used, and why; most reasons begin with the place already."""
    return [f"left out: {why if place in why else f'{place}: {why}'}" for place, why in found.left]


HEAD = "joint, effect, parameter, level, unit, scatter, told"
"""Of the table of what was looked at."""


def rows_of(found: Fleet) -> list[list[str]]:
    """Header, and a row for each quantity."""
    return [HEAD.split(", "), *(
        [
            each.quantity.joint or "-", effect_title(each.quantity), each.quantity.parameter,
            f"{each.level:.4g}" if each.level == each.level else "-", each.quantity.unit,
            f"{each.factor:.2f}", "-" if each.told is None else f"{each.told:.2g}",
        ]
        for each in found.followed
    )]  # fmt: skip
