"""From logs to segments of filtered motion, with every automatic choice made and recorded."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.brief import Brief
from modeler.core.errors import DataError, LoopError
from modeler.core.manifest import JointSpec, ModuleSpec
from modeler.logs import Positions, is_derivative
from modeler.numerics.held import COARSE
from modeler.numerics.least_squares import weighted_median
from modeler.numerics.spectra import MotionSpectrum, coherence, motion_spectrum
from modeler.observation.consistency import Consistency, consistency, quieter, without_late
from modeler.observation.log import Log
from modeler.observation.motion import CAUSES, HIGHEST, OPEN, Segment, edge_of, segment_of
from modeler.observation.motion_noise import (
    RANDOM_WALK,
    MotionNoise,
    Ringing,
    motion_bands,
    motion_noise,
    ringing,
)
from modeler.observation.outliers import ChannelScales, Defects, confirmed, defects, repairs_named
from modeler.observation.report import Bands
from modeler.observation.segments import Piece, SplitReport, split
from modeler.observation.settings import ChosenProcessing, Processing
from modeler.runtime import CompiledModel

LARGEST = 1e12
"""Positions, velocities, accelerations and torques above are damage, not measurements."""

ANSWERS = 0.5
"""Coherence of a torque with a position that rings."""

PARALLEL_BANDS = 4.0
LEAST_PARALLEL = 5.0  # Hz


@dataclass(frozen=True, eq=False)
class PreparedLog(Brief):
    """A log, mended and cut into uniform pieces.

    Attributes:
        pieces: with velocities and accelerations where the logged ones are used.
        cuts: where it was cut into them.
        derivatives: where qd and qdd come from, in words.
        check: of the logged derivatives; None where positions are differentiated.
        rings: sentences on joints that ring.
        defects: values that no robot can have made.
        usual: what is usual in its channels.
        repairs: those of its defects that a fit tried, and their held-out errors.
    """

    pieces: tuple[Piece, ...]
    cuts: SplitReport
    derivatives: str
    check: Consistency | None
    rings: tuple[str, ...]
    defects: Defects
    usual: ChannelScales
    repairs: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Prepared(Brief):
    """All logs, and what is chosen for them.

    Attributes:
        processing: with both cut-offs chosen.
        choices: a sentence for each.
        logs: in the order given.
        noise: of the motion.
        band: Hz of the motion of the fastest joint, or what pieces of that length can show.
        lowered: cut-offs and what chose them; None where they are as the motion alone asks for.
    """

    processing: ChosenProcessing
    choices: tuple[str, ...]
    logs: tuple[PreparedLog, ...]
    noise: MotionNoise
    band: float
    lowered: Bands | None = None

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """Of all logs."""
        return tuple(piece for log in self.logs for piece in log.pieces)

    @cached_property
    def segments(self) -> tuple[Segment, ...]:
        """Of all logs: their pieces, filtered and differentiated, but for those that are all edge.

        Raises:
            DataError: all of them are.
        """
        every, chosen = self.pieces, self.processing
        filtered = [segment_of(piece, chosen) for piece in every]
        if any(filtered):
            return tuple(segment for segment in filtered if segment is not None)
        longest = max(every, key=lambda piece: len(piece.time))
        raise DataError(
            f"no more than {(len(longest.time) - 1) * longest.step:.2g} s without a gap; expected "
            f"more than {2.0 * edge_of(longest, chosen) * longest.step:.2g} s: the ends are lost "
            f"to the {chosen.position_cutoff:g} Hz low-pass of the positions; record longer motions"
        )

    def uncommanded(self) -> "Prepared":
        """Without commanded positions, of which rows of torques know nothing."""
        logs = tuple(
            dataclasses.replace(
                log, pieces=tuple(dataclasses.replace(p, commanded=None) for p in log.pieces)
            )
            for log in self.logs
        )
        return dataclasses.replace(self, logs=logs)

    def with_cutoffs(self, position: float, parallel: float) -> "Prepared":
        """With other filters."""
        chosen = dataclasses.replace(
            self.processing, position_cutoff=position, parallel_cutoff=parallel
        )
        return dataclasses.replace(self, processing=chosen)


@dataclass(frozen=True, eq=False)
class LogRepair(Brief):
    """Logs to be mended once, however often they are prepared: it is the same for any filters.

    Attributes:
        logs: as they were read.
        spec: the robot's manifest.
    """

    logs: Sequence[Log]
    spec: ModuleSpec

    @cached_property
    def _mended(self) -> "dict[tuple[int, frozenset[str]], tuple[Log, Defects, ChannelScales]]":
        return {}

    def mended(self, run: int, processing: Processing) -> tuple[Log, Defects, ChannelScales]:
        """What `defects` makes of a log, with the repairs that a fit confirmed."""
        log, spec = self.logs[run], self.spec
        key = run, confirmed(processing.repairs_of(log.name))
        if key not in self._mended:
            some = repairs_named(log, spec, key[1])
            self._mended[key] = defects(log, spec, repairs=some)
        return self._mended[key]

    def cut(self, processing: Processing) -> "CutLogs":
        """The logs in pieces; what is known of them as long as nothing is filtered."""
        used = tuple(_speeds_used(log, processing) for log in self.logs)
        key = processing.keep_damaged, used, confirmed(processing.repairs or {})
        if key not in self._cut:
            logs = self.logs
            if not processing.keep_damaged:
                logs = [self.mended(run, processing)[0] for run in range(len(logs))]
            cut = [
                split(log, run, own, logged=self.logs[run].tau)
                for run, (log, own) in enumerate(zip(logs, used, strict=True))
            ]
            self._cut[key] = CutLogs(self.spec, logs, cut)
        return self._cut[key]

    @cached_property
    def _cut(self) -> "dict[tuple[bool, tuple[bool, ...], frozenset[str]], CutLogs]":
        return {}


@dataclass(frozen=True, eq=False)
class CutLogs(Brief):
    """Logs in uniform pieces.

    Attributes:
        spec: the robot's manifest.
        logs: mended.
        cut: the pieces of each, and where it was cut into them.
    """

    spec: ModuleSpec
    logs: Sequence[Log]
    cut: Sequence[tuple[tuple[Piece, ...], SplitReport]]

    @cached_property
    def pieces(self) -> list[Piece]:
        """Of all logs."""
        return [piece for own, _ in self.cut for piece in own]

    @cached_property
    def spectra(self) -> list[MotionSpectrum]:
        """Of the positions of each piece."""
        return spectra_of(self.pieces)

    @cached_property
    def bands(self) -> np.ndarray:
        """(J,) `joint_bands`."""
        return joint_bands(self.pieces, self.spectra)

    @cached_property
    def noise(self) -> MotionNoise:
        """Of the positions."""
        pieces = [without_speeds(piece) for piece in self.pieces]
        return motion_noise(self.spec.joints, pieces, self.bands)


def prepare(
    spec: ModuleSpec, logs: Sequence[Log], processing: Processing, mending: LogRepair | None = None
) -> Prepared:
    """Mend, split and resample; the noise of the motion, and the cut-offs that it asks for.

    Args:
        spec: the robot's manifest.
        logs: read with it.
        processing: what is asked of it.
        mending: of the same logs, where it is shared.

    Raises:
        DataError: no logs, a log of another robot, a value that cannot be, nothing long enough to
            differentiate, or a logged derivative that is none.
    """
    check_logs(spec, logs, processing)
    mending = mending or LogRepair(logs, spec)
    seen = mending.cut(processing)
    logs, pieces = seen.logs, seen.pieces
    if not pieces:
        raise DataError(
            f"{logs[0].name}: no uninterrupted motion; every piece between two gaps has fewer "
            "than 4 rows; record without interruptions"
        )
    _check_windows(logs, pieces, processing)
    _check_nyquist(logs, pieces, processing)
    positions = seen.noise
    chosen, _ = choose_cutoffs(processing, pieces, positions)
    rated = [piece for piece in pieces if piece.qd is not None]
    noisy = processing.derivatives == "auto" and quieter(rated, chosen.position_cutoff)
    steps, prepared = [joint.step for joint in positions.joints], []
    for run, (log, (own, cuts)) in enumerate(zip(logs, seen.cut, strict=True)):
        _, damage, usual = mending.mended(run, processing)
        found, check, source = _derived(log, own, chosen, noisy)
        # what is left of rows that repeat comes unevenly, as it was stamped
        own_spectra = [s for p, s in zip(pieces, seen.spectra, strict=True) if p.run == run]
        rings = [] if usual.repeats else what_rings(own_spectra, steps, own)
        rings = [ring for ring in rings if usual.held["q"][ring.joint] == 1]
        said = tuple(ring.sentence(spec.joints[ring.joint].name) for ring in rings)
        repairs = processing.repairs_of(log.name)
        prepared.append(PreparedLog(found, cuts, source, check, said, damage, usual, repairs))
    pieces = [piece for log in prepared for piece in log.pieces]
    given = all(piece.qd is not None for piece in pieces)
    noise = motion_noise(spec.joints, pieces, seen.bands) if given else positions
    chosen, choices = choose_cutoffs(processing, pieces, noise)
    return Prepared(chosen, choices, tuple(prepared), noise, shown_band(noise.band, pieces))


def _speeds_used(log: Log, processing: Processing) -> bool:
    return processing.derivatives != "position" and log.qd is not None


def _derived(
    log: Log, pieces: tuple[Piece, ...], processing: ChosenProcessing, noisy: bool
) -> tuple[tuple[Piece, ...], Consistency | None, str]:
    """The pieces of a log with the logged velocities that are used; their check, and their source.

    Args:
        log: mended.
        pieces: of it.
        processing: of all logs.
        noisy: positions that are differentiated have less noise.
    """
    keep, check = processing.keep_contradicted, None
    if _speeds_used(log, processing):
        check = consistency(log, pieces, processing.parallel_cutoff, refuse=not keep)
    auto = processing.derivatives == "auto" and not keep
    wrong = [
        name for name, q, qd in zip(log.joints, log.q.T, log.qd.T, strict=True)
        if not is_derivative(q, qd, log.time)
    ] if auto and check is not None and log.qd is not None else []  # fmt: skip
    late = check is not None and check.harmful and auto
    if check is not None and not noisy and not late and not wrong:
        source = "qd and qdd as logged" if log.qdd is not None else "qd as logged, qdd from it"
        return pieces if keep else believed(pieces, check), check, source
    pieces, source = tuple(map(without_speeds, pieces)), "qd and qdd by differentiating q"
    if check is not None and late:
        check, why = without_late(check, pieces), ", as logged derivatives come late"
    else:
        why = ", whose noise is less than that of the logged qd" if check else ""
        why = f", as logged qd{wrong[0]} does not follow q{wrong[0]}" if wrong else why
        check = None
    return pieces, check, source + why


def believed(pieces: Sequence[Piece], check: Consistency) -> tuple[Piece, ...]:
    """The pieces without their contradicted samples: an acceleration enters every torque.

    Where accelerations come from the logged velocities, the filter carries a wrong velocity as far
    as its start-up reaches: like a bridge, it takes its surroundings with it.
    """
    return tuple(
        dataclasses.replace(piece, contradicted=bad)
        for piece, bad in zip(pieces, check.bad, strict=True)
    )


def check_logs(spec: ModuleSpec, logs: Sequence[Log], processing: Processing) -> None:
    """Refuse what is no log of this robot.

    Raises:
        DataError: no logs, of another robot, impossible values, or none of logged speeds.
    """
    if not logs:
        raise DataError("no logs; give at least one")
    names = tuple(joint.name for joint in spec.joints)
    for log in logs:
        if log.joints != names:
            raise DataError(
                f"{log.name}: joints {', '.join(log.joints)}; {spec.robot} has "
                f"{', '.join(names)}; read the log with this robot"
            )
        check_size(log, spec)
        if processing.derivatives == "log" and log.qd is None:
            raise DataError(
                f"{log.name}: no logged velocities qd{names[0]} ... for derivatives = "
                '"log"; use "auto" or "position"'
            )


def _check_nyquist(logs: Sequence[Log], pieces: Sequence[Piece], processing: Processing) -> None:
    """A filter above half the sampling rate does not exist; one that is not needed may be any."""
    given = processing.position_cutoff or 0.0
    for piece in pieces:
        rate = 1.0 / piece.step
        if given >= 0.5 * rate and piece.qdd is None:
            log = logs[piece.run]
            raise DataError(
                f"{log.name}: position filter (--cutoff) of {given:g} Hz on a log "
                f"sampled at {rate:.4g} Hz; expected less than its Nyquist frequency of "
                f"{0.5 * rate:.4g} Hz; give a lower --cutoff, or sample faster"
                + "".join(f"; {log.name}: {note}" for note in log.notes)
            )


def _check_windows(logs: Sequence[Log], pieces: Sequence[Piece], processing: Processing) -> None:
    """A filter that averages over more than the motion leaves one row of it, however long it takes.

    The longest piece holds at least a period of either cut-off, and two rows.
    """
    longest = max(pieces, key=lambda piece: len(piece.time))
    name, samples = logs[longest.run].name, len(longest.time)
    lowest = 1.0 / (samples * longest.step)
    for option in ("position", "parallel"):
        cutoff = getattr(processing, f"{option}_cutoff")
        if cutoff is not None and 0.0 < cutoff < lowest:
            flag = "--cutoff" if option == "position" else "--parallel-cutoff"
            raise DataError(
                f"{name}: {option} filter ({flag}) of {cutoff:g} Hz, whose period is longer than "
                f"the longest motion without a gap, {1.0 / lowest:.4g} s; expected more than "
                f"{lowest:.2g} Hz; give a higher {flag}, or leave it out"
            )
    if processing.decimation is not None and 2 * processing.decimation > samples:
        raise DataError(
            f"{name}: one row of {processing.decimation} samples (--decimate) from {samples} "
            f"samples without a gap; expected at most {samples // 2}; give a lower --decimate, or "
            "leave it out"
        )


def check_size(log: Log, spec: ModuleSpec) -> None:
    """No robot has such values, and their squares overflow.

    Raises:
        DataError: names the largest.
    """
    for label in ("q", "qd", "qdd", "tau"):
        values = getattr(log, label)
        if values is None or not np.isfinite(values).any():
            continue
        row, j = np.unravel_index(int(np.nanargmax(np.abs(values))), values.shape)
        if abs(values[row, j]) > LARGEST:
            raise DataError(
                f"{log.name}: {label} of joint {spec.joints[j].name} is {values[row, j]:.3g} at "
                f"{log.time[row]:.6g} s; expected at most {LARGEST:g} in SI units; repair the log, "
                "or leave the entry empty"
            )


def joint_bands(pieces: Sequence[Piece], spectra: Sequence[MotionSpectrum]) -> np.ndarray:
    """(J,) Hz below which 99 % of each velocity's energy lies; NaN of a joint at rest.

    The median over the pieces in which the joint moves, by their lengths.

    Args:
        pieces: of all logs.
        spectra: of their positions.
    """
    lengths = np.array([len(piece.time) * piece.step for piece in pieces])
    found = np.stack([motion_bands(*pair) for pair in zip(pieces, spectra, strict=True)])
    bands = np.full(found.shape[1], np.nan)
    for j, own in enumerate(found.T):
        moved = np.isfinite(own)
        if moved.any():
            bands[j] = weighted_median(own[moved], lengths[moved])
    return bands


def noise_of_positions(seen: Positions | None) -> MotionNoise | None:
    """The noise of the positions of a log whose robot is not known; None without motion.

    Args:
        seen: as logged; rows whose time repeats or goes back are left out.
    """
    if seen is None:
        return None
    known = np.isfinite(seen.time) & np.isfinite(seen.values).all(axis=1)
    time, values = seen.time[known], seen.values[known]
    rises = np.diff(np.maximum.accumulate(time), prepend=-np.inf) > 0.0
    if rises.sum() < 2:
        return None
    joints = [
        JointSpec(name, "prismatic" if unit == "m" else "revolute", unit, "", True, None)
        for name, unit in zip(seen.names, seen.units, strict=True)
    ]
    q = values[rises]
    pieces, _ = split(Log("", seen.names, time[rises], q, np.zeros_like(q)), 0, False)
    if not pieces:
        return None
    found = motion_noise(joints, pieces, joint_bands(pieces, spectra_of(pieces)))
    return found.of_last_floors(lambda joint: joint.colour > RANDOM_WALK)


def shown_band(band: float, pieces: Sequence[Piece]) -> float:
    """Hz of the fastest joint, as the window of a piece shows it: 2/T at least."""
    lengths = np.array([len(piece.time) * piece.step for piece in pieces])
    return float(np.hypot(band, 2.0 / weighted_median(lengths, lengths)))


def without_speeds(piece: Piece) -> Piece:
    """The piece with its velocities to be taken from the positions."""
    return dataclasses.replace(piece, qd=None, qdd=None)


def spectra_of(pieces: Sequence[Piece]) -> list[MotionSpectrum]:
    """The spectrum of each piece's positions."""
    return [motion_spectrum(piece.q, piece.step) for piece in pieces]


def what_rings(
    spectra: Sequence[MotionSpectrum], steps: Sequence[float], pieces: Sequence[Piece]
) -> list[Ringing]:
    """Joints that ring in the longest of some pieces, by more than the steps of their encoders.

    A joint that passes count after count shows lines too, but none that are as large as a few
    counts; and torque answers to a controller that oscillates.

    Args:
        spectra: of the positions of the pieces.
        steps: (J,) resolution of each joint, rad or m; 0: none.
        pieces: of the log.
    """
    if not spectra:
        return []
    longest, piece = max(zip(spectra, pieces, strict=True), key=lambda own: len(own[0].frequency))
    speed = longest.above * longest.frequency[:, None] ** 2
    found = []
    for j, own in enumerate(speed.T):
        ring, first = ringing(longest.frequency, own, j)
        size = float(np.sqrt(longest.above[first:, j].sum()))
        if ring is None or size <= COARSE * steps[j]:
            continue
        if coherence(piece.q[:, j], piece.tau[:, j], ring.frequency * piece.step) > ANSWERS:
            found.append(ring)
    return found


def choose_cutoffs(
    processing: Processing, pieces: Sequence[Piece], noise: MotionNoise
) -> tuple[ChosenProcessing, tuple[str, ...]]:
    """The processing with the widest cut-offs that the motion asks for, and what it was chosen by.

    Parallel filter: 4 times the motion band of the fastest joint, at least 5 Hz. Position filter:
    where the spectrum of the positions meets their noise, at most 80 Hz, never less than 5 bands
    or twice the parallel filter; at most 0.4 of the sampling rate. `observe` then lowers both where
    the noise of the positions is more than that of the torques.

    Args:
        processing: what is given is kept.
        pieces: of all logs.
        noise: of the motion.
    """
    fastest = max(noise.joints, key=lambda joint: joint.band_hz)
    band = fastest.band_hz
    slowest = 1.0 / max(piece.step for piece in pieces)
    shown = (
        f"{band:.3g} Hz" if band else "of less than the pieces of motion are long enough to show"
    )
    said = [f"motion band {shown} (99 % of the velocity's energy), sampled at {noise.rate:.4g} Hz"]
    rest = [joint.joint for joint in noise.joints if not joint.moves]
    if rest and len(rest) < len(noise.joints):
        one = len(rest) == 1
        said.append(
            f"joint{'' if one else 's'} {', '.join(rest)} rest{'s' if one else ''}: not counted in "
            "the motion band"
        )
    given, highest = processing.position_cutoff, HIGHEST * slowest
    parallel = processing.parallel_cutoff
    if parallel is None:
        parallel = min(max(LEAST_PARALLEL, PARALLEL_BANDS * band), 0.5 * (given or highest))
        parallel = two_digits(parallel)
    logged = all(piece.qdd is not None for piece in pieces)
    position = given
    if position is None:
        position = two_digits(min(max(noise.cutoff, 2.0 * parallel), highest))
    if not logged and 0.0 < position < 5.0 * band:
        higher, better = "give a higher --cutoff, or leave it out", "sample faster or move slower"
        said.append(
            f"position filter {position:g} Hz is less than 5 x the motion band of joint "
            f"{fastest.joint}, {band:.3g} Hz: accelerations are damped; "
            f"{better if given is None else higher}"
        )
    own = [n for n in ("position_cutoff", "parallel_cutoff") if getattr(processing, n) is None]
    choices = {
        "position_cutoff": position,
        "parallel_cutoff": parallel,
        "speed_floors": processing.speed_floors or {},
        "chosen": tuple(dict.fromkeys((*processing.chosen, *own))),
    }
    return ChosenProcessing(**{**vars(processing), **choices}), tuple(said)


def two_digits(value: float) -> float:
    """As it is told, and used."""
    return float(f"{value:.2g}")


# Samples whose positions do not close the loops: told, and left out.
#
# Noise, a filter's start-up or a slipping encoder take a few postures beyond what the robot
# reaches. No torque belongs to them. The nearest posture that closes stands in for theirs, so
# that everything that is evaluated along a log goes through, and their rows do not count.


FEWEST = 0.1
"""Where a smaller share of the samples closes, the model is of another machine or other units."""


def nearest_closed(model: CompiledModel, *postures: np.ndarray) -> np.ndarray | None:
    """(n,) the nearest sample, in time, whose postures all close; its own place where its own do.

    Args:
        model: the compiled robot.
        postures: (n, joints) each.

    Returns:
        None if there is no such sample.
    """
    places = np.arange(len(postures[0]))
    if model.spec.closure is None:
        return places
    closes = np.all([model.closing_status(q) == 0 for q in postures], axis=0)
    good = np.flatnonzero(closes)
    if not good.size:
        return None
    after = np.minimum(np.searchsorted(good, places), len(good) - 1)
    before = np.maximum(after - 1, 0)
    nearer = places - good[before] < np.abs(good[after] - places)
    return np.asarray(np.where(nearer, good[before], good[after]))


def without_open(
    model: CompiledModel, logs: Sequence[Log], segments: Sequence[Segment]
) -> tuple[tuple[Segment, ...], tuple[tuple[float, ...], ...]]:
    """The segments with another posture where theirs does not close, and those times of each log.

    Raises:
        LoopError: fewer than a tenth of the samples close; says how many, and where the first.
    """
    times: list[tuple[float, ...]] = [() for _ in logs]
    both = [closed(model, segment) for segment in segments]
    for segment, open_ in both:
        times[segment.run] += tuple(segment.time[open_ & segment.whole].tolist())
    whole = sum(int(segment.whole.sum()) for segment in segments)
    count = sum(len(own) for own in times)
    if count > (1.0 - FEWEST) * whole:
        run = next(run for run, own in enumerate(times) if own)
        first = times[run][0]
        segment = next(s for s in segments if s.run == run and first in s.time)
        where = ", ".join(f"{value:.6g}" for value in segment.q[segment.time == first][0])
        raise LoopError(
            f"{logs[run].name}: the loops of {model.spec.robot} cannot be closed at {count} of "
            f"{whole} samples, first at {first:.6g} s; got ({where}); expected positions that the "
            "robot reaches from [home], in SI units; check units, zeros and the order of the "
            "columns"
        )
    return tuple(segment for segment, _ in both), tuple(times)


def closed(model: CompiledModel, segment: Segment) -> tuple[Segment, np.ndarray]:
    """The segment with postures that close the loops, and (n,) True where its own does not."""
    if model.spec.closure is None:
        return segment, np.zeros(segment.samples, dtype=bool)
    nearest = nearest_closed(model, segment.q)
    if nearest is None:
        home = np.asarray(model.spec.closure.home)[list(model.spec.closure.given)]
        q, open_ = np.tile(home, (segment.samples, 1)), np.ones(segment.samples, dtype=bool)
    else:
        q, open_ = segment.q[nearest], nearest != np.arange(segment.samples)
    if not open_.any():
        return segment, open_
    newly = segment.valid & open_[:, None]
    cause = np.where(newly, np.int8(CAUSES.index(OPEN)), segment.cause)
    return dataclasses.replace(segment, q=q, cause=cause), open_
