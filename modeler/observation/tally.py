"""What the chunks of a log say of its rows: counts that add up, and facts, put together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.observation.chunk import Chunk
from modeler.observation.consistency import Consistency, Contradiction
from modeler.observation.log import Log
from modeler.observation.motion import CAUSES, Segment
from modeler.observation.outliers import Defects
from modeler.observation.read import Ranges
from modeler.observation.segments import GAP, Piece
from modeler.observation.stretch import Stretch


@dataclass(frozen=True, eq=False)
class Tally:
    """Numbers, or arrays by joint.

    Attributes:
        sums: what adds up.
        most: of which the largest counts.
    """

    sums: Mapping[str, Any]
    most: Mapping[str, Any]

    def over(self, other: "Tally") -> "Tally":
        """That of both."""
        return Tally(
            {name: self.sums[name] + other.sums[name] for name in self.sums},
            {name: np.maximum(self.most[name], other.most[name]) for name in self.most},
        )

    def by_joint(self, name: str) -> np.ndarray:
        """(J,) a sum."""
        return np.asarray(self.sums[name])

    def count(self, name: str) -> int:
        """A sum that is one number."""
        return int(self.sums[name])


def tally(
    chunk: Chunk,
    pieces: Sequence[Piece],
    stretches: Sequence[Stretch],
    left_out: Sequence[Piece],
    check: Consistency | None,
) -> Tally:
    """Counts of a chunk's own rows.

    Args:
        chunk: of the log.
        pieces: of it and its margins.
        stretches: of the pieces that are long enough, with the rows that are the chunk's own.
        left_out: the other pieces.
        check: of its logged derivatives.
    """
    none = np.zeros(len(chunk.log.joints), dtype=int)
    own = [_own(chunk, piece) for piece in pieces]
    clipped = [piece.clipped[rows].sum(axis=0) for piece, rows in zip(pieces, own, strict=True)]
    bad = () if check is None else check.bad
    sums: dict[str, Any] = {
        **_of_rows(chunk, pieces, left_out),
        **{f"missing {name}": count for name, count in missing(chunk).items()},
        "clipped": sum(clipped, none),
        "contradicted": sum(int(flags[rows].sum()) for flags, rows in zip(bad, own, strict=False)),
        **_of_samples(chunk, stretches, none),
    }
    return Tally(sums, {"jitter": _jitter(chunk.log), "gap": _gaps(chunk)[1]})


def _of_samples(chunk: Chunk, stretches: Sequence[Stretch], none: np.ndarray) -> dict[str, Any]:
    sums: dict[str, Any] = {"samples": 0, "full": 0}
    sums |= {name: none for name in ("used", "valid", "usable", *CAUSES)}
    for part in stretches:
        s, rows = part.segment, _slice(_own(chunk, part.segment))
        valid = s.valid[rows].sum(axis=0)
        assert s.cause is not None
        counts = {"valid": valid, "usable": part.usable[rows].sum(axis=0),
                  "used": part.used.sum(axis=0), "samples": len(part.rows.centres),
                  "full": rows.stop - rows.start}  # fmt: skip
        if (valid < counts["full"]).any():
            cause = s.cause[rows]
            counts |= {name: (cause == k).sum(axis=0) for k, name in enumerate(CAUSES)}
        sums |= {name: sums[name] + count for name, count in counts.items()}
    return sums


def _slice(flags: np.ndarray) -> slice:
    """The one stretch of True."""
    rows = np.flatnonzero(flags)
    return slice(int(rows[0]), int(rows[-1]) + 1) if rows.size else slice(0, 0)


def _own(chunk: Chunk, part: Piece | Segment) -> np.ndarray:
    """(n,) samples of a piece that are the chunk's own."""
    start, stop = chunk.span
    return np.asarray((part.time >= start) & (part.time < stop))


def _of_rows(chunk: Chunk, pieces: Sequence[Piece], left_out: Sequence[Piece]) -> dict[str, int]:
    start, stop = chunk.span
    begun = [piece for piece in pieces if start <= piece.time[0] < stop]
    return {
        "chunks": 1,
        "rows": chunk.rows,
        "gaps": _gaps(chunk)[0],
        "pieces": len(begun),
        "resampled": sum(piece.resampled for piece in begun),
        "short": _rows_outside(chunk, pieces)
        + sum(int(_own(chunk, piece).sum()) for piece in left_out),
    }


def _moved(log: Log) -> np.ndarray:
    """(n,) rows with a position of every joint."""
    return np.asarray(np.isfinite(log.q).all(axis=1))


def _gaps(chunk: Chunk) -> tuple[int, float]:
    """Gaps that end in the chunk's own rows, and the longest, s."""
    log = chunk.log
    rows = np.flatnonzero(_moved(log))
    steps = np.diff(log.time[rows])
    ends = rows[1:]
    long = (steps > GAP * log.step) & (ends >= chunk.own.start) & (ends < chunk.own.stop)
    return int(long.sum()), float(steps[long].max(initial=0.0))


def _jitter(log: Log) -> float:
    stamps, step = np.diff(log.time), log.step
    inside = stamps[stamps <= GAP * step]
    return float(np.max(np.abs(inside / step - 1.0))) if inside.size else 0.0


def _rows_outside(chunk: Chunk, pieces: Sequence[Piece]) -> int:
    """Own rows with a position that are in no piece."""
    time = chunk.log.time[chunk.own]
    inside = np.zeros(len(time), dtype=bool)
    for piece in pieces:
        inside |= (time >= piece.time[0]) & (time <= piece.time[-1])
    return int((_moved(chunk.log)[chunk.own] & ~inside).sum())


def missing(chunk: Chunk) -> dict[str, int]:
    """Column -> own rows without a value; every column that a fit reads."""
    log, found = chunk.log, dict[str, int]()
    columns = {"q": log.q, "qd": log.qd, "qdd": log.qdd, "qc": log.commanded, "tau": log.tau}
    for prefix, values in columns.items():
        if values is None:
            continue
        for j, name in enumerate(log.joints):
            column = f"{prefix}{name}"
            if prefix == "tau" and log.torque_source:
                column = log.torque_source[j].split()[0]
            if column != "0":  # of a passive joint
                found[column] = int(np.isnan(values[chunk.own, j]).sum())
    return found


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
