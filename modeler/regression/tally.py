"""What the rows of a log say: counts that add up over its chunks, facts, and their report."""

import dataclasses
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.manifest import JointSpec, ModuleSpec
from modeler.regression.chunk import Chunk
from modeler.regression.consistency import Contradiction, DerivativeCheck
from modeler.regression.log import Log
from modeler.regression.low_speed import FrictionShaft
from modeler.regression.motion import CAUSES
from modeler.regression.outliers import Defects, describe_damages
from modeler.regression.prepare import PreparedLog
from modeler.regression.read import ChannelRanges, cut_rows
from modeler.regression.report import JointReport, LogReport
from modeler.regression.segments import RawSegment, SplitReport
from modeler.regression.stretch import FilteredSegment


@dataclass(frozen=True, eq=False)
class Tally:
    """Numbers, or arrays by joint.

    Attributes:
        sums: what adds up.
        most: of which the largest counts.
    """

    sums: Mapping[str, Any]
    most: Mapping[str, Any]

    def merged_with(self, other: "Tally") -> "Tally":
        """That of both."""
        return Tally(
            {name: self.sums[name] + other.sums[name] for name in self.sums},
            {name: np.maximum(self.most[name], other.most[name]) for name in self.most},
        )

    def count(self, name: str) -> int:
        """A sum that is one number."""
        return int(self.sums[name])


def count_rows(
    chunk: Chunk,
    pieces: Sequence[RawSegment],
    cuts: SplitReport,
    stretches: Sequence[FilteredSegment],
    check: DerivativeCheck | None,
) -> Tally:
    """Counts of a chunk's own rows.

    Args:
        chunk: of the log.
        pieces: of it and its margins.
        cuts: where it was cut into them.
        stretches: of the pieces that are long enough, with the rows that are the chunk's own.
        check: of its logged derivatives.
    """
    none = np.zeros(len(chunk.log.joints), dtype=int)
    inner_masks = [chunk.is_inside(piece.time) for piece in pieces]
    begun = [piece for piece, rows in zip(pieces, inner_masks, strict=True) if rows[0]]
    clipped = [
        piece.clipped[rows].sum(axis=0) for piece, rows in zip(pieces, inner_masks, strict=True)
    ]
    bad = () if check is None else check.bad
    widths = cuts.widths[chunk.is_inside(cuts.gaps)]
    sums: dict[str, Any] = {
        "chunks": 1,
        "rows": chunk.rows,
        "gaps": len(widths),
        "pieces": len(begun),
        "resampled": sum(piece.resampled for piece in begun),
        "short": chunk.is_inside(cuts.short).sum() + sum(int(rows.sum()) for rows in inner_masks),
        "missing": Counter(cut_rows(chunk.log, chunk.inner_rows).missing),
        "clipped": sum(clipped, none),
        "contradicted": sum(
            int(flags[rows].sum()) for flags, rows in zip(bad, inner_masks, strict=False)
        ),
        "samples": 0,
        "full": 0,
        **{name: none for name in ("used", "valid", "usable", *CAUSES)},
    }
    for part in stretches:
        s, inside = part.segment, np.flatnonzero(chunk.is_inside(part.segment.time))
        rows = slice(inside[0], inside[-1] + 1) if inside.size else slice(0, 0)
        valid, full = s.valid[rows].sum(axis=0), rows.stop - rows.start
        counts = {"valid": valid, "usable": part.usable[rows].sum(axis=0), "full": full,
                  "used": part.used.sum(axis=0), "samples": len(part.rows.centres)}  # fmt: skip
        if (valid < full).any():
            cause = s.cause[rows]
            counts |= {name: (cause == k).sum(axis=0) for k, name in enumerate(CAUSES)}
        counts["short"] = -full  # what no stretch is made of
        sums |= {name: sums[name] + count for name, count in counts.items()}
    return Tally(sums, {"jitter": cuts.jitter, "gap": widths.max(initial=0.0)})


@dataclass(frozen=True, eq=False)
class LogFacts:
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
    ranges: ChannelRanges
    block_hashes: tuple[bytes, ...]
    clipped: np.ndarray
    moving_shafts: Mapping[str, float]
    open_times: tuple[float, ...]
    span: tuple[float, float]

    def merged_with(self, later: "LogFacts") -> "LogFacts":
        """Of these rows, and of those that follow them."""
        low, high = np.stack([self.clipped, later.clipped], axis=1)
        defects = dict(self.defects)
        for name, more in later.defects.items():
            before = defects.get(name) or [[] for _ in more]
            defects[name] = [a + b for a, b in zip(before, more, strict=True)] if more else before
        return LogFacts(
            tally=self.tally.merged_with(later.tally),
            defects=defects,
            contradictions=_merge_contradictions(self.contradictions, later.contradictions),
            ranges=self.ranges.merged_with(later.ranges),
            block_hashes=self.block_hashes + later.block_hashes,
            clipped=np.stack([np.fmax(*low), np.fmin(*high)]),
            moving_shafts={
                name: max(self.moving_shafts.get(name, 0.0), later.moving_shafts.get(name, 0.0))
                for name in {**self.moving_shafts, **later.moving_shafts}
            },
            open_times=self.open_times + later.open_times,
            span=(self.span[0], later.span[1]),
        )

    def is_wrongly_clipped(self) -> bool:
        """True if torques were taken for a limit that others exceed: only a later pass knows."""
        low, high = self.clipped
        return bool(np.any(low > self.ranges.low[1]) or np.any(high < self.ranges.high[1]))

    def find_first(self, kind: str) -> dict[int, float]:
        """Joints whose position has a defect of a kind -> time of the first, s."""
        return {
            j: same_kind[0].time
            for j, every in enumerate(self.defects.get("q", []))
            if (same_kind := [one for one in every if one.kind == kind])
        }


def _merge_contradictions(
    first: tuple[Contradiction, ...], later: tuple[Contradiction, ...]
) -> tuple[Contradiction, ...]:
    """By column, in the order in which they were found."""
    by_column = {one.column: one for one in first}
    for one in later:
        before = by_column.get(one.column, one)
        worse = one if one.largest > before.largest else before
        samples = one.samples + (before.samples if before is not one else 0)
        limit = max(before.limit, one.limit)
        by_column[one.column] = dataclasses.replace(worse, samples=samples, limit=limit)
    return tuple(by_column.values())


# The counts in the words of a report.


_TOLD = ("rows", "gaps", "pieces", "resampled", "short", "samples", "contradicted")


def build_log_report(
    log: Log, spec: ModuleSpec, prepared: PreparedLog, facts: Tally, defects: Defects,
    contradictions: Sequence[Contradiction], decimation: int, open_times: tuple[float, ...],
) -> LogReport:  # fmt: skip
    """What became of the rows of a log.

    Args:
        log: it, or some rows of it, with the notes and the content of all.
        spec: the robot's manifest.
        prepared: the log by which all was chosen.
        facts: counts of all rows.
        defects: values that no robot can have made.
        contradictions: of logged derivatives.
        decimation: samples per row.
        open_times: of samples with which the loops cannot be closed, s.
    """
    counts: dict[str, Any] = {name: facts.count(name) for name in _TOLD}
    clipped = zip(log.joints, facts.sums["clipped"], strict=True)
    return LogReport(
        name=log.name,
        missing=dict(facts.sums["missing"]),
        saturated={name: int(count) for name, count in clipped if count},
        rate=1.0 / log.step,
        jitter=float(facts.most["jitter"]),
        longest_gap=float(facts.most["gap"]),
        derivatives=prepared.derivatives,
        decimation=decimation,
        notes=log.notes + prepared.rings + (prepared.check.notes if prepared.check else ()),
        contradictions=tuple(contradictions),
        **counts,
        damages=describe_damages(log, counts["rows"], spec, defects, prepared.repairs),
        content=log.content,
        span=log.span,
        torque_source=log.torque_source,
        open_times=open_times,
        path=log.path,
        reading_notes=log.reading_notes,
    )


def build_joint_reports(
    joints: Sequence[JointSpec],
    parts: Sequence[FrictionShaft],
    floors: Mapping[str, float],
    tallies: Sequence[Tally],
) -> tuple[JointReport, ...]:
    """What became of the samples of each joint.

    Args:
        joints: of the robot.
        parts: its shafts.
        floors: speeds below which they do not count.
        tallies: of all logs.
    """
    counted = ("full", "used", "valid", "usable", *CAUSES)
    reports, sums = [], {name: sum(values.sums[name] for values in tallies) for name in counted}
    for j, joint in enumerate(joints):
        values = [floors[part.name] for part in parts if j in part.joints]
        reports.append(
            JointReport(
                name=joint.name,
                used=int(sums["used"][j]),
                slow=float(1.0 - sums["usable"][j] / max(1, sums["valid"][j])),
                speed_floor=max(values) if values else None,
                unit=f"{joint.unit}/s",
                samples=int(sums["full"]),
                lost={cause: int(sums[cause][j]) for cause in CAUSES if sums[cause][j]},
            )
        )
    return tuple(reports)
