"""What happened to the rows of the logs, in numbers and in words."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from modeler.core.brief import ShortRepr
from modeler.core.result import Result
from modeler.core.table import format_percent
from modeler.logs import Mark
from modeler.regression.consistency import SCATTERS, SHARE, STEPS, Contradiction
from modeler.regression.motion_noise import ChannelNoise, MotionNoise
from modeler.regression.outliers import Damage
from modeler.regression.segments import JITTER
from modeler.regression.settings import ChosenProcessing


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

    def format_lines(self) -> list[str]:
        """Text, the first line always, the others where there is something to say."""
        text = [
            f"{self.name}: {self.rows} rows at {self.rate:.4g} Hz -> {self.samples} samples "
            f"(one of {self.decimation}), {self.derivatives}"
        ]
        if self.gaps or self.pieces != 1:
            gap = f", {self.gaps} gaps up to {self.longest_gap:.3g} s" if self.gaps else ""
            text.append(f"  {self.pieces} pieces{gap}; no filter runs across their ends")
        if self.resampled and self.jitter > JITTER:  # else a few rows were bridged
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
        """What is wrong with the measurements, one sentence each, with the name of the file."""
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
        """What no robot does, where it lies."""
        marks = [
            Mark(one.kind, one.column, start, start + lasts, one.line)
            for one in self.damages
            if one.is_mended
            for start, lasts in zip(one.times, one.lasts, strict=True)
        ]
        loops = "the loops cannot be closed here; not used, but check positions and geometry"
        return marks + [Mark("open", "all joints", t, t, loops) for t in self.open_times]

    def _describe_open_loops(self) -> list[str]:
        """A sentence where loops cannot be closed."""
        if not self.open_times:
            return []
        count = len(self.open_times)
        return [
            f"the loops cannot be closed at {count} of {self.rows} samples, "
            f"{'first ' if count > 1 else ''}at {self.open_times[0]:.6g} s; not used, but check "
            "positions and geometry there"
        ]


def join_lines(damages: Sequence[Damage]) -> list[str]:
    """Their lines; of channels of which the same is said, one."""
    columns_by_text: dict[str, list[str]] = {}
    for one in damages:
        columns_by_text.setdefault(one.line.removeprefix(f"{one.column}: "), []).append(one.column)
    return [f"{', '.join(columns)}: {rest}" for rest, columns in columns_by_text.items()]


@dataclass(frozen=True)
class JointReport(ShortRepr):
    """Rows of one joint.

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
        """Text."""
        if self.used == 0:
            return f"joint {self.name}: {self._explain_empty()}"
        if self.speed_floor is None:
            return f"joint {self.name}: {self.used} rows"
        if self.speed_floor == float("inf"):
            return (
                f"joint {self.name}: {self.used} rows; it never moves: its friction is not "
                "identifiable"
            )
        return (
            f"joint {self.name}: {self.used} rows; {format_percent(self.slow)} of the samples "
            "masked "
            f"below {self.speed_floor:.3g} {self.unit}, where the sign of the speed is "
            "doubtful"
        )

    def _explain_empty(self) -> str:
        """The cause that most samples share, when no row is left."""
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
class Bands(ShortRepr):
    """The cut-offs, what chose them, and the noise of the motion, as plain data.

    Attributes:
        position_cutoff, parallel_cutoff: Hz; None if there was no fit.
        noise: of every channel of the motion.
        widest: Hz of both filters, as the motion alone asks for; empty where one was given.
        chosen_by: sentences.
        limited_by: joint that they were lowered for; None if the parallel filter is the widest.
        trembling: how many times as much as the measured torque that of the model trembles behind
            the first filters of which it is too much; 0 if behind none.
        trembling_left: the same behind the filters that were chosen.
        widest_values: (c,) base parameters behind the widest filters; empty where they were chosen.
    """

    position_cutoff: float | None
    parallel_cutoff: float | None
    noise: tuple[ChannelNoise, ...]
    widest: Mapping[str, float] = field(default_factory=dict)
    chosen_by: tuple[str, ...] = ()
    limited_by: str | None = None
    trembling: float = 0.0
    trembling_left: float = 0.0
    widest_values: tuple[float, ...] = ()


def build_bands(noise: MotionNoise | None, processing: ChosenProcessing | None = None) -> Bands:
    """What is known of the noise of the motion, and of cut-offs that nothing was lowered for."""
    joints = noise.joints if noise else ()
    if processing is None:
        return Bands(None, None, joints)
    return Bands(processing.position_cutoff, processing.parallel_cutoff, joints)


@dataclass(frozen=True)
class DataReport(Result):
    """All of it.

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
        """The cut-offs and the noise of the motion as plain data."""
        return self.lowered or build_bands(self.noise, self.processing)

    def collect_warnings(self) -> list[str]:
        """What is wrong with the measurements of all logs, one sentence each."""
        return [line for log in self.logs for line in log.collect_warnings()]

    def collect_notes(self) -> list[str]:
        """What looks like a defect of a log and is used as logged, one sentence each."""
        return [
            f"note: {log.name}: {damage.line}"
            for log in self.logs
            for damage in log.damages
            if not damage.is_mended
        ]

    def format_lines(self) -> list[str]:
        """Lines of text for people."""
        lines = [line for log in self.logs for line in log.format_lines()]
        lines += [*(self.noise.format_lines() if self.noise else ()), *self.choices]
        if any(log.saturated for log in self.logs):
            used = "used" if self.processing.keep_saturated else "not used"
            lines.append(f"rows with a torque at its limit are {used}")
        if any(log.damages for log in self.logs):
            lines.append(
                "all values are used as logged"
                if self.processing.keep_damaged
                else "values are mended or left out only where a fit predicts left-out rows better "
                "with it; --keep-damaged uses all as logged"
            )
        if any(log.contradicted for log in self.logs):
            used = "used" if self.processing.keep_contradicted else "not used"
            lines.append(
                f"samples with impossible derivatives are {used}: over a window of the parallel "
                "filter the mean of the logged derivative and the change of the signal below it "
                f"differ by more than {SCATTERS:g} robust standard deviations, "
                f"{100 * SHARE:g} % of the derivative's size and {STEPS:g} resolution steps per "
                "window; --derivatives position differentiates the positions instead"
            )
        return lines + [joint.format_line() for joint in self.joints]
