"""What the chunks of a long log say of it, put together."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.observation.consistency import Contradiction
from modeler.observation.damage import Defects
from modeler.observation.read import Ranges
from modeler.observation.tally import Tally


@dataclass(frozen=True, eq=False)
class Facts:
    """Of some consecutive rows of a log; J joints.

    Attributes:
        tally: counts.
        defects: values that no robot can have made.
        contradictions: of logged derivatives.
        ranges: of the channels.
        fingers: fingerprints, in the order of the rows.
        clipped: (2, J) the largest of the lower and the smallest of the upper torques that were
            taken for a limit of the drive; NaN without any.
        awake: shafts that stood still where choices were made and move here -> top speed.
        open_times: s, of samples with which the loops cannot be closed.
        span: s, first and last row.
    """

    tally: Tally
    defects: Defects
    contradictions: tuple[Contradiction, ...]
    ranges: Ranges
    fingers: tuple[bytes, ...]
    clipped: np.ndarray
    awake: Mapping[str, float]
    open_times: tuple[float, ...]
    span: tuple[float, float]

    def over(self, later: "Facts") -> "Facts":
        """Of these rows, and of those that follow them."""
        names = list(dict.fromkeys([*self.defects, *later.defects]))
        low, high = np.stack([self.clipped, later.clipped], axis=1)
        return Facts(
            tally=self.tally.over(later.tally),
            defects={name: _both(self.defects.get(name, []), later.defects.get(name, []))
                     for name in names},
            contradictions=_contradictions(self.contradictions, later.contradictions),
            ranges=self.ranges.over(later.ranges),
            fingers=self.fingers + later.fingers,
            clipped=np.stack([np.fmax(*low), np.fmin(*high)]),
            awake={name: max(self.awake.get(name, 0.0), later.awake.get(name, 0.0))
                   for name in {**self.awake, **later.awake}},
            open_times=self.open_times + later.open_times,
            span=(self.span[0], later.span[1]),
        )  # fmt: skip

    def wrongly_clipped(self) -> bool:
        """True if torques were taken for a limit that others exceed: only a later pass knows."""
        low, high = self.clipped
        return bool(np.any(low > self.ranges.low[1]) or np.any(high < self.ranges.high[1]))

    def first(self, kind: str) -> dict[int, float]:
        """Joints whose position has a defect of a kind -> time of the first, s."""
        return {
            j: own[0].time
            for j, every in enumerate(self.defects.get("q", []))
            if (own := [one for one in every if one.kind == kind])
        }


def _both(first: list, later: list) -> list:
    if not first or not later:
        return first or later
    return [one + other for one, other in zip(first, later, strict=True)]


def _contradictions(
    first: tuple[Contradiction, ...], later: tuple[Contradiction, ...]
) -> tuple[Contradiction, ...]:
    """By column, in the order in which they were found."""
    found: dict[str, Contradiction] = {}
    for one in (*first, *later):
        before = found.get(one.column)
        if before is None:
            found[one.column] = one
            continue
        worse = one if one.largest > before.largest else before
        found[one.column] = Contradiction(
            one.column, one.of, before.samples + one.samples, max(before.limit, one.limit),
            worse.largest, worse.time,
        )  # fmt: skip
    return tuple(found.values())
