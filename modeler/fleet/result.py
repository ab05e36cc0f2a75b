"""What a fleet shows: findings, and the values behind them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.brief import Brief
from modeler.core.json_text import nulled
from modeler.core.presented import Presented
from modeler.fleet.layout import Quantity
from modeler.fleet.times import Unit


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
class Finding(Brief):
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
    findings: tuple[Finding, ...]
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

    def as_dict(self) -> dict[str, Any]:
        """The result for scripts; numbers that mean nothing are null."""
        from modeler.fleet.text import sentence

        return nulled({
            "robot": self.robot,
            "verdict": self.verdict,
            "time": self.unit,
            "logs": self.logs,
            "machines": {name: list(periods) for name, periods in self.machines.items()},
            "findings": [_finding(found) | {"sentence": sentence(found, self.unit)}
                         for found in self.findings],
            "quantities": [_followed(each) for each in self.followed],
            "false_alarm": self.false_alarm,
            "not_told": list(self.aside),
            "left_out": [{"log": place, "why": why} for place, why in self.left],
            "doubts": list(self.doubts),
            "notes": list(self.notes),
        })  # fmt: skip


def _finding(found: Finding) -> dict[str, Any]:
    warmth = found.warmth
    return {
        "machine": found.machine,
        "effect": found.quantity.effect,
        "joint": found.quantity.joint,
        "parameter": found.quantity.parameter,
        "unit": found.quantity.unit,
        "shape": found.shape,
        "from": found.begin,
        "to": found.end,
        "periods_since": found.since,
        "before": found.before,
        "change": found.change,
        "change_percent": found.percent,
        "sigma": found.sigma,
        "score": found.score,
        "chance": found.chance,
        "temperature": None if warmth is None else {
            "lowest": warmth.lowest, "highest": warmth.highest,
            "correlation": warmth.correlation, "moves_along": warmth.along,
            "others_alike": warmth.shared,
        },
    }  # fmt: skip


def _followed(each: Followed) -> dict[str, Any]:
    return {
        "effect": each.quantity.effect,
        "joint": each.quantity.joint,
        "parameter": each.quantity.parameter,
        "unit": each.quantity.unit,
        "level": each.level,
        "scatter_factor": each.factor,
        "would_be_told": each.told,
        "machines": {
            name: {"periods": list(own.periods), "at": own.at,
                   "values": own.values, "sigmas": own.sigmas,
                   "score": each.scores.get(name)}
            for name, own in each.machines.items()
        },
    }  # fmt: skip
