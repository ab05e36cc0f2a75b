"""What happened to the rows of the logs: counts that add up over chunks, and their report."""

import dataclasses
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from modeler.core.json import ShortRepr
from modeler.core.manifest import JointSpec, ModuleSpec
from modeler.core.result import Result
from modeler.core.table import format_percent
from modeler.logs import Mark, describe_repeats
from modeler.regression.chunk import Chunk
from modeler.regression.consistency import Contradiction, DerivativeCheck
from modeler.regression.faults import ALWAYS, Defect, Defects, find_column
from modeler.regression.log import Log, RawSegment, SplitReport
from modeler.regression.motion import CAUSES, UNSETTLED, ChosenProcessing
from modeler.regression.motion_noise import Bands, MotionNoise, build_bands
from modeler.regression.prepare import PreparedLog
from modeler.regression.read import ChannelRanges, cut_rows
from modeler.regression.segments import FilteredSegment, FrictionShaft
from modeler.regression.thresholds import THRESHOLDS


@dataclass(frozen=True)
class DataWarning(ShortRepr):
    """Says why a log, or a fit to it, may not be valid.

    Attributes:
        line: where and what; after the last semicolon what to do.
        is_certain: True if no physics can look like it: then the model is not valid.
        affects_values: True if the prediction of similar motions is not affected, and only the
            values of parameters are doubtful.
        joint: index of the joint whose torque has another scale; -1 for other warnings.
        is_undetectable: True if it says which faults these logs would not show.
        joints: names of the joints that it is about; empty: the whole robot.
        code: its kind, for scripts: "clock", "torque_sign" ...; "data": of rows and channels.
    """

    line: str
    is_certain: bool = False
    affects_values: bool = False
    joint: int = -1
    is_undetectable: bool = False
    joints: tuple[str, ...] = ()
    code: str = "data"


@dataclass(frozen=True)
class Damage:
    """One kind of defect of one channel of a log.

    Attributes:
        column: of the log, "q2"; "all channels" of repeated rows.
        joint: its name; "" of repeated rows.
        kind: of `Defect`.
        times: when each begins, s.
        lasts: for how long each is bad, s; 0 of a leap.
        samples: that are not used for it.
        size: the largest, in `unit`.
        unit: of the channel.
        line: what it is, where and when, what was done and what to do.
        is_mended: False where the data are used as logged.
    """

    column: str
    joint: str
    kind: str
    times: tuple[float, ...]
    lasts: tuple[float, ...]
    samples: int
    size: float
    unit: str
    line: str
    is_mended: bool = True


def describe_damages(
    log: Log, rows: int, spec: ModuleSpec, defects_by_channel: Defects, repairs: Mapping[str, float]
) -> tuple[Damage, ...]:
    """Returns what was found in the rows of a log, in words.

    Args:
        log: it, or a part of it.
        rows: of the whole log.
        spec: the robot's manifest.
        defects_by_channel: in all rows.
        repairs: by column and kind, the held-out error mended over that as logged.
    """
    repeats = [channel for channel in defects_by_channel.get("rows", ()) if channel]
    descriptions = [_describe_repeats(log, rows, channel, repairs) for channel in repeats]
    for name, by_joint in defects_by_channel.items():
        if name == "rows":
            continue
        for j, channel in enumerate(by_joint):
            joint, column = spec.joints[j], find_column(log, spec, name, j)
            unit = joint.unit + {"qd": "/s", "qdd": "/s^2"}.get(name, "")
            unit = joint.effort_unit if name == "tau" else unit
            for kind in dict.fromkeys(one.kind for one in channel):
                same = [one for one in channel if one.kind == kind]
                size = max((one.size for one in same), key=abs)
                samples, many = sum(one.stop - one.start for one in same), len(same) > 1
                first, rate = f"at {same[0].time:.6g} s", 1.0 / log.step
                words = _WORDS["torque" if kind == "spike" and name == "tau" else kind].format(
                    when=f"{len(same)} times, first {first}" if many else first,
                    size=f"{'up to ' * many}{abs(size):.3g} {unit}",
                    value=f"{size:.3g} {unit}",
                    rows=f"{size:.0f} rows: sampled at {rate / max(size, 1.0):.3g} Hz, not "
                    f"{rate:.4g} Hz",
                )
                share = f"({format_percent(samples / rows)} of the rows)"
                unused = f"{samples} sample{'s' * (samples > 1)} {share} not used"
                done, score = _DONE.get(kind, unused), repairs.get(f"{column} {kind}", np.nan)
                is_mended = kind in ALWAYS or score < THRESHOLDS.max_repair_ratio
                if score >= THRESHOLDS.max_noted_ratio and kind != "held":
                    continue
                if not is_mended:
                    done, samples = "used as logged", 0
                if np.isfinite(score):
                    done += f", held-out error x {score:.2f}"
                line = f"{column}: {words}; {done}"
                if is_mended and kind in _ADVICE:
                    line += f"; {_ADVICE[kind]}"
                when = _compute_times(same, log.step)
                seen = Damage(column, joint.name, kind, *when, samples, abs(size), unit, line)
                descriptions.append(dataclasses.replace(seen, is_mended=is_mended))
    return tuple(descriptions)


def _compute_times(
    defects: Sequence[Defect], step: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Returns when each begins, and how long it is bad, s."""
    lengths = tuple((one.stop - one.start) * step for one in defects)
    return tuple(one.time for one in defects), lengths


def _describe_repeats(
    log: Log, rows: int, defects: Sequence[Defect], repairs: Mapping[str, float]
) -> Damage:
    """Returns rows that were recorded more than once."""
    count = sum(one.stop - one.start for one in defects)
    when, rate = _compute_times(defects[:1], log.step), 1.0 / log.step
    score = repairs.get("all channels repeated", np.nan)
    is_mended = bool(score < THRESHOLDS.max_repair_ratio)
    done = "repeats are left out" if is_mended else "used as logged"
    done += f", held-out error x {score:.2f}" if np.isfinite(score) else ""
    line = f"{describe_repeats(count, rows, rate)}; {done}"
    column, count = "all channels", count * is_mended
    return Damage(column, "", "repeated", *when, count, rate, "Hz", line, is_mended)


_WORDS: Mapping[str, str] = {
    "wrap": "wraps by 2 pi rad, {when}",
    "spike": "jumps by {size} and back, {when}",
    "torque": "spike of {size}, {when}, that no other joint shows",
    "frozen": "repeats one value while the joint moves, {when}",
    "clipped": "stays at {value} at the end of its range without slowing down before, {when}",
    "zero": "jumps by {size} {when} and goes on from there",
    "lost": "jumps along its motion by {size}, {when}",
    "held": "holds each value for {rows}",
}


_DONE: Mapping[str, str] = {
    "wrap": "unwrapped",
    "zero": "joined to the longest part",
    "lost": "no filter runs across",
    "held": "interpolated between new values",
}


_ADVICE: Mapping[str, str] = {
    "spike": "check the sensor and its cable",
    "frozen": "check the bus and the logger",
    "clipped": "check the ranges of sensor and logger",
    "zero": "check the encoder",
    "lost": "log the true time of each row",
}


@dataclass(frozen=True)
class LogReport(ShortRepr):
    """One log on its way to rows of W.

    Attributes:
        name: file name.
        rows: rows read.
        missing: column -> rows without a value.
        saturated: joint -> rows with the torque at the drive's limit.
        rate: Hz.
        jitter: largest deviation of a time step from the median, as a share of it.
        gaps: time gaps longer than 5 steps.
        longest_gap: s.
        pieces: uniform pieces it was cut into.
        resampled: pieces whose rows were moved to a uniform grid.
        short: rows in pieces too short to use.
        derivatives: where qd and qdd come from.
        decimation: samples per row.
        samples: samples after decimation.
        notes: sentences.
        contradictions: logged derivatives that cannot be, by column.
        contradicted: samples that any of them makes unusable.
        damages: values that no robot can have made, by column and kind.
        content: fingerprint of the file's measurements.
        span: first and last time, s.
        torque_source: where each joint's torque comes from, in words.
        open_times: of samples with which the loops cannot be closed, s.
        path: of the file as it was given; "" if none was.
        told: how it was read, sentences.
        pushes: windows that are left out, as something pushed on the robot, s.
    """

    name: str
    rows: int
    missing: Mapping[str, int]
    saturated: Mapping[str, int]
    rate: float
    jitter: float
    gaps: int
    longest_gap: float
    pieces: int
    resampled: int
    short: int
    derivatives: str
    decimation: int
    samples: int
    notes: tuple[str, ...]
    contradictions: tuple[Contradiction, ...] = ()
    contradicted: int = 0
    damages: tuple[Damage, ...] = ()
    content: str = ""
    span: tuple[float, float] = (0.0, 0.0)
    torque_source: tuple[str, ...] = ()
    open_times: tuple[float, ...] = ()
    path: str = ""
    reading_notes: tuple[str, ...] = ()
    pushes: tuple[tuple[float, float], ...] = ()

    def format_lines(self) -> list[str]:
        """Returns text, the first line always, the others where there is something to say."""
        text = [
            f"{self.name}: {self.rows} rows at {self.rate:.4g} Hz -> {self.samples} samples "
            f"(one of {self.decimation}), {self.derivatives}"
        ]
        if self.gaps or self.pieces != 1:
            gap = f", {self.gaps} gaps up to {self.longest_gap:.3g} s" if self.gaps else ""
            text.append(f"  {self.pieces} pieces{gap}; no filter runs across their ends")
        if self.resampled and self.jitter > THRESHOLDS.max_jitter:  # else a few rows were bridged
            text.append(
                f"  time steps vary by up to {format_percent(self.jitter)}: {self.resampled} of "
                f"{self.pieces} pieces resampled on a uniform grid"
            )
        if self.short:
            text.append(f"  {self.short} rows in pieces too short to differentiate, not used")
        for column, count in self.missing.items():
            text.append(f"  {column}: {count} rows without a value; bridged, not used for the fit")
        for joint, count in self.saturated.items():
            text.append(f"  joint {joint}: torque stuck at its limit in {count} rows")
        text += [f"  {line}" for line in join_lines(self.damages)]
        if self.contradicted:
            text.append(f"  {self.contradicted} samples with impossible derivatives, all joints:")
        text += [f"  {contradiction.format_line()}" for contradiction in self.contradictions]
        text += [f"  {line}" for line in self._describe_open_loops()]
        return text + [f"  {note}" for note in (*self.reading_notes, *self.notes)]

    def collect_warnings(self) -> list[str]:
        """Returns what is wrong with the measurements, one sentence each, with the file's name."""
        warnings = [
            f"{column} has no value in {count} of {self.rows} rows; they are not used, but look "
            "why the logger left them out"
            for column, count in self.missing.items()
        ]
        warnings += join_lines([damage for damage in self.damages if damage.is_mended])
        warnings += [
            f"the torque of joint {joint} is clipped in {count} of {self.rows} rows; they are not "
            "used, but drive slower or with less load"
            for joint, count in self.saturated.items()
        ]
        if self.contradicted:
            warnings.append(
                "the logged speeds or accelerations are not those of the positions in "
                f"{self.contradicted} samples; they are not used, but check these channels"
            )
        warnings += self._describe_open_loops()
        return [f"{self.name}: {line}" for line in (*warnings, *self.notes)]

    def collect_marks(self) -> list[Mark]:
        """Returns what no robot does, where it lies."""
        marks = [
            Mark(one.kind, one.column, start, start + lasts, one.line)
            for one in self.damages
            if one.is_mended
            for start, lasts in zip(one.times, one.lasts, strict=True)
        ]
        loops = "the loops cannot be closed here; not used, but check positions and geometry"
        return marks + [Mark("open", "all joints", t, t, loops) for t in self.open_times]

    def _describe_open_loops(self) -> list[str]:
        """Returns a sentence where loops cannot be closed."""
        if not self.open_times:
            return []
        count = len(self.open_times)
        return [
            f"the loops cannot be closed at {count} of {self.rows} samples, "
            f"{'first ' if count > 1 else ''}at {self.open_times[0]:.6g} s; not used, but check "
            "positions and geometry there"
        ]


def join_lines(damages: Sequence[Damage]) -> list[str]:
    """Returns their lines; of channels of which the same is said, one."""
    columns_by_text: dict[str, list[str]] = {}
    for one in damages:
        columns_by_text.setdefault(one.line.removeprefix(f"{one.column}: "), []).append(one.column)
    return [f"{', '.join(columns)}: {rest}" for rest, columns in columns_by_text.items()]


@dataclass(frozen=True)
class JointReport(ShortRepr):
    """The rows of one joint: how many are used, and why others are not.

    Attributes:
        name: joint.
        used: rows in W.
        slow: share of its samples masked for low speed, before decimation.
        speed_floor: below it, rad/s or m/s; infinite if the joint never moves, None if it has no
            dry friction.
        unit: of the speed.
        samples: before decimation, of all pieces.
        lost: why samples do not count, low speed apart -> how many.
    """

    name: str
    used: int
    slow: float
    speed_floor: float | None
    unit: str
    samples: int = 0
    lost: Mapping[str, int] = field(default_factory=dict)

    def format_line(self) -> str:
        """Returns the rows of the joint as text."""
        if self.used == 0:
            return f"joint {self.name}: {self._explain_empty()}"
        rows = f"joint {self.name}: {self.used} rows"
        if self.speed_floor is None:
            return rows
        if self.speed_floor == float("inf"):
            return f"{rows}; it never moves: its friction is not identifiable"
        masked = f"{format_percent(self.slow)} of the samples masked"
        floor = f"below {self.speed_floor:.3g} {self.unit}"
        return f"{rows}; {masked} {floor}, where the sign of the speed is doubtful"

    def _explain_empty(self) -> str:
        """Returns the cause that most samples share, when no row is left."""
        slow = round(self.slow * (self.samples - sum(self.lost.values())))
        cause = max(self.lost, key=lambda name: self.lost[name], default="")
        if slow >= self.lost.get(cause, 0):
            return (
                f"0 rows; {format_percent(self.slow)} of the samples masked below "
                f"{self.speed_floor:.3g} {self.unit}: it hardly moves, or the time column is not "
                "in seconds"
            )
        return f"0 rows; {format_percent(self.lost[cause] / self.samples)} of its samples {cause}"


@dataclass(frozen=True)
class DataReport(Result):
    """All that is reported about the data: logs, joints, noise, and every choice.

    Attributes:
        processing: with every automatic choice filled in.
        choices: one sentence per automatic choice.
        logs: in the order given.
        joints: in the order of the manifest.
        noise: of the motion; None where the rows are a part of a log.
        band: Hz of the motion.
        lowered: cut-offs and what chose them; None where a parallel cut-off was given.
    """

    processing: ChosenProcessing
    choices: tuple[str, ...]
    logs: tuple[LogReport, ...]
    joints: tuple[JointReport, ...]
    noise: MotionNoise | None = None
    band: float = 0.0
    lowered: Bands | None = None

    @property
    def bands(self) -> Bands:
        """Returns the cut-offs and the noise of the motion as plain data."""
        return self.lowered or build_bands(self.noise, self.processing)

    def collect_warnings(self) -> list[str]:
        """Returns what is wrong with the measurements of all logs, one sentence each."""
        return [line for log in self.logs for line in log.collect_warnings()]

    def describe_pushes(self) -> list[str]:
        """Returns a sentence on each window that is left out, as something pushed there."""
        lines = []
        for log in self.logs:
            for push in log.pushes:
                first, last = (round((time - log.span[0]) * log.rate) + 1 for time in push)
                rows = f"{push[0]:.2f} to {push[1]:.2f} s, rows {first} to {last} of {log.rows}"
                lines.append(f"{log.name}: {rows}, left out: something pushed on the robot")
        return lines

    def collect_notes(self) -> list[str]:
        """Returns what looks like a defect of a log and is used as logged, one sentence each."""
        every = [(log.name, damage) for log in self.logs for damage in log.damages]
        notes = [f"note: {line}" for line in self.describe_pushes()]
        notes += [
            f"note: joint {joint.name}: {count} samples left out at the start of motions, where "
            "the state of its bristle or cable is unknown"
            for joint in self.joints
            if (count := joint.lost.get(UNSETTLED, 0))
        ]
        return notes + [f"note: {name}: {one.line}" for name, one in every if not one.is_mended]

    def format_lines(self) -> list[str]:
        """Returns lines of text for people."""
        lines = [line for log in self.logs for line in log.format_lines()]
        lines += [*(self.noise.format_lines() if self.noise else ()), *self.choices]
        if any(log.saturated for log in self.logs):
            used = "used" if self.processing.keep_saturated else "not used"
            lines.append(f"rows with a torque at its limit are {used}")
        if any(log.damages for log in self.logs):
            lines.append(
                "all values are used as logged"
                if self.processing.keep_damaged
                else "values are repaired or left out only where a fit then predicts left-out rows "
                "better; --keep-damaged uses all as logged"
            )
        if any(log.contradicted for log in self.logs):
            used = "used" if self.processing.keep_contradicted else "not used"
            limits = (
                f"{THRESHOLDS.contradiction_sigmas:g} robust standard deviations, "
                f"{100 * THRESHOLDS.contradiction_share:g} % of the derivative's size and "
                f"{THRESHOLDS.contradiction_steps:g} resolution steps per window"
            )
            lines.append(
                f"samples with impossible derivatives are {used}: over a window of the parallel "
                "filter the mean of the logged derivative and the change of the signal below it "
                f"differ by more than {limits}; --derivatives position differentiates the "
                "positions instead"
            )
        return lines + [joint.format_line() for joint in self.joints]


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
        """Returns the counts of both."""
        return Tally(
            {name: self.sums[name] + other.sums[name] for name in self.sums},
            {name: np.maximum(self.most[name], other.most[name]) for name in self.most},
        )

    def count(self, name: str) -> int:
        """Returns a sum that is one number."""
        return int(self.sums[name])


def count_rows(
    chunk: Chunk,
    pieces: Sequence[RawSegment],
    cuts: SplitReport,
    stretches: Sequence[FilteredSegment],
    check: DerivativeCheck | None,
) -> Tally:
    """Counts the chunk's own rows, by what became of them.

    Args:
        chunk: of the log.
        pieces: of it and its margins.
        cuts: where it was cut into them.
        stretches: of the pieces that are long enough, with the rows that are the chunk's own.
        check: of its logged derivatives.
    """
    none = np.zeros(len(chunk.log.joints), dtype=int)
    inner_rows = [chunk.find_inside(piece.time) for piece in pieces]
    pairs = list(zip(pieces, inner_rows, strict=True))
    begun = [piece for piece, rows in pairs if rows.start == 0 < rows.stop]
    clipped = [piece.clipped[rows].sum(axis=0) for piece, rows in pairs]
    bad = () if check is None else check.bad
    widths = cuts.widths[chunk.is_inside(cuts.gaps)]
    wrong = sum(int(flags[rows].sum()) for flags, rows in zip(bad, inner_rows, strict=False))
    short = chunk.is_inside(cuts.short).sum() + sum(rows.stop - rows.start for rows in inner_rows)
    missing = cut_rows(chunk.log, chunk.inner_rows).missing
    resampled = sum(piece.resampled for piece in begun)
    sums: dict[str, Any] = {"chunks": 1, "rows": chunk.rows, "gaps": len(widths)}
    sums |= {"pieces": len(begun), "resampled": resampled, "short": short, "samples": 0, "full": 0}
    sums |= {"missing": Counter(missing), "clipped": sum(clipped, none), "contradicted": wrong}
    sums |= dict.fromkeys(("used", "valid", "usable", *CAUSES), none)
    for part in stretches:
        s, rows = part.segment, chunk.find_inside(part.segment.time)
        valid, full = s.valid[rows].sum(axis=0), rows.stop - rows.start
        counts = {"valid": valid, "full": full, "usable": part.usable[rows].sum(axis=0)}
        counts |= {"used": part.used.sum(axis=0), "samples": len(part.rows.centres)}
        if (valid < full).any():
            cause = s.cause[rows]
            counts |= {name: (cause == k).sum(axis=0) for k, name in enumerate(CAUSES)}
        counts["short"] = -full  # what no segment is made of
        sums |= {name: sums[name] + count for name, count in counts.items()}
    return Tally(sums, {"jitter": cuts.jitter, "gap": widths.max(initial=0.0)})


@dataclass(frozen=True, eq=False)
class LogFacts:
    """What was found in some consecutive rows of a log; J joints.

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
        """Returns the facts of these rows, and of those that follow them."""
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
        """Returns True if torques were taken for a limit that others exceed."""
        low, high = self.clipped
        return bool(np.any(low > self.ranges.low[1]) or np.any(high < self.ranges.high[1]))

    def find_first(self, kind: str) -> dict[int, float]:
        """Returns joints whose position has a defect of a kind -> time of the first, s."""
        joints = enumerate(self.defects.get("q", []))
        first = {j: next((x.time for x in every if x.kind == kind), None) for j, every in joints}
        return {j: time for j, time in first.items() if time is not None}


def _merge_contradictions(
    first: tuple[Contradiction, ...], later: tuple[Contradiction, ...]
) -> tuple[Contradiction, ...]:
    """Returns by column, in the order in which they were found."""
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
    log: Log,
    spec: ModuleSpec,
    prepared: PreparedLog,
    facts: Tally,
    defects: Defects,
    contradictions: Sequence[Contradiction],
    decimation: int,
    open_times: tuple[float, ...],
) -> LogReport:
    """Returns what became of the rows of a log.

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
        pushes=prepared.pieces[0].pushes if prepared.pieces else (),
    )


def build_joint_reports(
    joints: Sequence[JointSpec],
    parts: Sequence[FrictionShaft],
    floors: Mapping[str, float],
    tallies: Sequence[Tally],
) -> tuple[JointReport, ...]:
    """Returns what became of the samples of each joint.

    Args:
        joints: of the robot.
        parts: its shafts.
        floors: speeds below which they do not count.
        tallies: of all logs.
    """
    counted = ("full", "used", "valid", "usable", *CAUSES)
    reports, sums = [], {name: sum(values.sums[name] for values in tallies) for name in counted}
    for j, joint in enumerate(joints):
        floor = max((floors[part.name] for part in parts if j in part.joints), default=None)
        slow = float(1.0 - sums["usable"][j] / max(1, sums["valid"][j]))
        lost = {cause: int(sums[cause][j]) for cause in CAUSES if sums[cause][j]}
        numbers = int(sums["used"][j]), slow, floor, f"{joint.unit}/s", int(sums["full"]), lost
        reports.append(JointReport(joint.name, *numbers))
    return tuple(reports)
