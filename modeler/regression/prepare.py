"""From logs to segments of filtered motion, with every automatic choice made and recorded."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.core.json import ShortRepr
from modeler.core.manifest import JointSpec, ModuleSpec
from modeler.logs import Positions, is_derivative
from modeler.numerics.channels import COARSE
from modeler.numerics.least_squares import compute_weighted_median
from modeler.numerics.spectra import MotionSpectrum, compute_motion_spectrum, estimate_coherence
from modeler.regression import motion_noise
from modeler.regression.consistency import (
    DerivativeCheck,
    check_derivatives,
    discard_contradictions,
    is_position_quieter,
)
from modeler.regression.faults import (
    ChannelScales,
    Defects,
    parse_repairs,
    repair_log,
    select_confirmed,
)
from modeler.regression.log import Log, RawSegment, SplitReport, split_log
from modeler.regression.motion import (
    CAUSES,
    OPEN,
    ChosenProcessing,
    Processing,
    Segment,
    build_segment,
    compute_edge,
)
from modeler.regression.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel


@dataclass(frozen=True, eq=False)
class PreparedLog(ShortRepr):
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

    pieces: tuple[RawSegment, ...]
    cuts: SplitReport
    derivatives: str
    check: DerivativeCheck | None
    rings: tuple[str, ...]
    defects: Defects
    channel_scales: ChannelScales
    repairs: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class PreparedLogs(ShortRepr):
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
    noise: motion_noise.MotionNoise
    band: float
    lowered: motion_noise.Bands | None = None

    @property
    def pieces(self) -> tuple[RawSegment, ...]:
        """Returns the pieces of all logs."""
        return tuple(piece for log in self.logs for piece in log.pieces)

    @cached_property
    def segments(self) -> tuple[Segment, ...]:
        """Returns the pieces of all logs, filtered and differentiated, but for those all edge.

        Raises:
            DataError: all of them are.
        """
        every, chosen = self.pieces, self.processing
        filtered = [build_segment(piece, chosen) for piece in every]
        if any(filtered):
            return tuple(segment for segment in filtered if segment is not None)
        longest = max(every, key=lambda piece: len(piece.time))
        raise DataError(
            f"no more than {(len(longest.time) - 1) * longest.step:.2g} s without a gap; expected "
            f"more than {2.0 * compute_edge(longest, chosen) * longest.step:.2g} s: the ends are "
            f"lost to the {chosen.position_cutoff:g} Hz low-pass of the positions; record longer "
            "motions"
        )

    def drop_commands(self) -> "PreparedLogs":
        """Returns without commanded positions, of which rows of torques know nothing."""
        logs = tuple(
            dataclasses.replace(log, pieces=tuple(replace(p, commanded=None) for p in log.pieces))
            for log in self.logs
        )
        return dataclasses.replace(self, logs=logs)

    def set_cutoffs(self, position: float, parallel: float) -> "PreparedLogs":
        """Returns with other filters."""
        chosen = replace(self.processing, position_cutoff=position, parallel_cutoff=parallel)
        return dataclasses.replace(self, processing=chosen)


@dataclass(frozen=True, eq=False)
class LogRepair(ShortRepr):
    """Logs to be mended once, however often they are prepared: it is the same for any filters.

    Attributes:
        logs: as they were read.
        spec: the robot's manifest.
    """

    logs: Sequence[Log]
    spec: ModuleSpec

    @cached_property
    def _repaired_logs(
        self,
    ) -> "dict[tuple[int, frozenset[str]], tuple[Log, Defects, ChannelScales]]":
        return {}

    def get_repaired(self, run: int, processing: Processing) -> tuple[Log, Defects, ChannelScales]:
        """Returns what `repair_log` makes of a log, with the repairs that a fit confirmed."""
        log, spec = self.logs[run], self.spec
        key = run, select_confirmed(processing.repairs_of(log.name))
        if key not in self._repaired_logs:
            some = parse_repairs(log, spec, key[1])
            self._repaired_logs[key] = repair_log(log, spec, repairs=some)
        return self._repaired_logs[key]

    def cut_logs(self, processing: Processing) -> "CutLogs":
        """Returns the logs in pieces; what is known of them as long as nothing is filtered."""
        used = tuple(_has_speeds(log, processing) for log in self.logs)
        key = processing.keep_damaged, used, select_confirmed(processing.repairs or {})
        if key not in self._cut_by_choice:
            logs = self.logs
            if not processing.keep_damaged:
                logs = [self.get_repaired(run, processing)[0] for run in range(len(logs))]
            cut = [
                split_log(log, run, has_speeds)
                for run, (log, has_speeds) in enumerate(zip(logs, used, strict=True))
            ]
            self._cut_by_choice[key] = CutLogs(self.spec, logs, cut)
        return self._cut_by_choice[key]

    @cached_property
    def _cut_by_choice(self) -> "dict[tuple[bool, tuple[bool, ...], frozenset[str]], CutLogs]":
        return {}


@dataclass(frozen=True, eq=False)
class CutLogs(ShortRepr):
    """Logs in uniform pieces.

    Attributes:
        spec: the robot's manifest.
        logs: mended.
        cut: the pieces of each, and where it was cut into them.
    """

    spec: ModuleSpec
    logs: Sequence[Log]
    cut: Sequence[tuple[tuple[RawSegment, ...], SplitReport]]

    @cached_property
    def pieces(self) -> list[RawSegment]:
        """Returns the pieces of all logs."""
        return [piece for log_pieces, _ in self.cut for piece in log_pieces]

    @cached_property
    def spectra(self) -> list[MotionSpectrum]:
        """Returns the spectra of the positions of each piece."""
        return compute_spectra(self.pieces)

    @cached_property
    def bands(self) -> np.ndarray:
        """Returns the bands (J,) of the joints' motion, as `estimate_joint_bands` has them."""
        return estimate_joint_bands(self.pieces, self.spectra)

    @cached_property
    def noise(self) -> motion_noise.MotionNoise:
        """Returns the noise of the positions."""
        pieces = [drop_speeds(piece) for piece in self.pieces]
        return motion_noise.estimate_motion_noise(self.spec.joints, pieces, self.bands)


def prepare_logs(
    spec: ModuleSpec, logs: Sequence[Log], processing: Processing, repair: LogRepair | None = None
) -> PreparedLogs:
    """Returns mend, split and resample; the noise of the motion, and the cut-offs that it asks for.

    Args:
        spec: the robot's manifest.
        logs: read with it.
        processing: what is asked of it.
        repair: of the same logs, where it is shared.

    Raises:
        DataError: no logs, a log of another robot, a value that cannot be, nothing long enough to
            differentiate, or a logged derivative that is none.
    """
    check_logs(spec, logs, processing)
    repair = repair or LogRepair(logs, spec)
    seen = repair.cut_logs(processing)
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
    noisy = processing.derivatives == "auto" and is_position_quieter(rated, chosen.position_cutoff)
    steps, prepared = [joint.step for joint in positions.joints], []
    for run, (log, (log_pieces, cuts)) in enumerate(zip(logs, seen.cut, strict=True)):
        _, damage, scales = repair.get_repaired(run, processing)
        pushes = processing.get_pushes(log)
        log_pieces = tuple(replace(piece, pushes=pushes) for piece in log_pieces)
        used_pieces, check, source = _choose_derivatives(log, log_pieces, chosen, noisy)
        # what is left of rows that repeat comes unevenly, as it was stamped
        own_spectra = [s for p, s in zip(pieces, seen.spectra, strict=True) if p.run == run]
        rings = [] if scales.repeats else find_ringing_joints(own_spectra, steps, log_pieces)
        rings = [ring for ring in rings if not scales.channels["q"][ring.joint].is_held]
        said = tuple(ring.describe(spec.joints[ring.joint].name) for ring in rings)
        repairs = processing.repairs_of(log.name)
        entry = PreparedLog(used_pieces, cuts, source, check, said, damage, scales, repairs)
        prepared.append(entry)
    pieces = [piece for log in prepared for piece in log.pieces]
    has_logged_speeds = all(piece.qd is not None for piece in pieces)
    noise = positions
    if has_logged_speeds:
        noise = motion_noise.estimate_motion_noise(spec.joints, pieces, seen.bands)
    chosen, choices = choose_cutoffs(processing, pieces, noise)
    band = compute_visible_band(noise.band, pieces)
    return PreparedLogs(chosen, choices, tuple(prepared), noise, band)


def _has_speeds(log: Log, processing: Processing) -> bool:
    return processing.derivatives != "position" and log.qd is not None


def _choose_derivatives(
    log: Log, pieces: tuple[RawSegment, ...], processing: ChosenProcessing, noisy: bool
) -> tuple[tuple[RawSegment, ...], DerivativeCheck | None, str]:
    """Returns the pieces of a log with the velocities that are used; their check, and their source.

    Args:
        log: mended.
        pieces: of it.
        processing: of all logs.
        noisy: positions that are differentiated have less noise.
    """
    keep, check = processing.keep_contradicted, None
    if _has_speeds(log, processing):
        check = check_derivatives(log, pieces, processing.parallel_cutoff, refuse=not keep)
    auto = processing.derivatives == "auto" and not keep
    wrong = []
    if auto and check is not None and log.qd is not None:
        every = zip(log.joints, log.q.T, log.qd.T, strict=True)
        wrong = [name for name, q, qd in every if not is_derivative(q, qd, log.time)]
    late = check is not None and check.is_harmful and auto
    if check is not None and not noisy and not late and not wrong:
        source = "qd and qdd as logged" if log.qdd is not None else "qd as logged, qdd from it"
        return pieces if keep else exclude_contradicted(pieces, check), check, source
    pieces, source = tuple(map(drop_speeds, pieces)), "qd and qdd by differentiating q"
    if check is not None and late:
        check, why = discard_contradictions(check, pieces), ", as logged derivatives come late"
    else:
        why = ", whose noise is less than that of the logged qd" if check else ""
        why = f", as logged qd{wrong[0]} does not follow q{wrong[0]}" if wrong else why
        check = None
    return pieces, check, source + why


def exclude_contradicted(
    pieces: Sequence[RawSegment], check: DerivativeCheck
) -> tuple[RawSegment, ...]:
    """Returns the pieces without their contradicted samples: an acceleration enters every torque.

    Where accelerations come from the logged velocities, the filter carries a wrong velocity as far
    as its start-up reaches: like a bridge, it takes its surroundings with it.
    """
    pairs = zip(pieces, check.bad, strict=True)
    return tuple(dataclasses.replace(piece, contradicted=bad) for piece, bad in pairs)


def check_logs(spec: ModuleSpec, logs: Sequence[Log], processing: Processing) -> None:
    """Refuses what is no log of this robot.

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


def _check_nyquist(
    logs: Sequence[Log], pieces: Sequence[RawSegment], processing: Processing
) -> None:
    """Checks that the position filter is below half the sampling rate, where it is needed."""
    cutoff = processing.position_cutoff or 0.0
    for piece in pieces:
        rate = 1.0 / piece.step
        if cutoff >= 0.5 * rate and piece.qdd is None:
            log = logs[piece.run]
            raise DataError(
                f"{log.name}: position filter (--cutoff) of {cutoff:g} Hz on a log "
                f"sampled at {rate:.4g} Hz; expected less than its Nyquist frequency of "
                f"{0.5 * rate:.4g} Hz; give a lower --cutoff, or sample faster"
                + "".join(f"; {log.name}: {note}" for note in log.notes)
            )


def _check_windows(
    logs: Sequence[Log], pieces: Sequence[RawSegment], processing: Processing
) -> None:
    """Checks that no filter averages over more than the motion, which would leave one row of it.

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
    """Returns no robot has such values, and their squares overflow.

    Raises:
        DataError: names the largest.
    """
    for label in ("q", "qd", "qdd", "tau"):
        values = getattr(log, label)
        if values is None or np.abs(values).max(initial=0.0) <= THRESHOLDS.max_value:
            continue  # the usual case, which is cheap
        if not np.isfinite(values).any():
            continue
        row, j = np.unravel_index(int(np.nanargmax(np.abs(values))), values.shape)
        if abs(values[row, j]) > THRESHOLDS.max_value:
            raise DataError(
                f"{log.name}: {label} of joint {spec.joints[j].name} is {values[row, j]:.3g} at "
                f"{log.time[row]:.6g} s; expected at most "
                f"{THRESHOLDS.max_value:g} in SI units; repair the log, or leave the entry empty"
            )


def estimate_joint_bands(
    pieces: Sequence[RawSegment], spectra: Sequence[MotionSpectrum]
) -> np.ndarray:
    """Returns (J,) Hz below which 99 % of each velocity's energy lies; NaN of a joint at rest.

    The median over the pieces in which the joint moves, by their lengths.

    Args:
        pieces: of all logs.
        spectra: of their positions.
    """
    lengths = np.array([len(piece.time) * piece.step for piece in pieces])
    pairs = zip(pieces, spectra, strict=True)
    piece_bands = np.stack([motion_noise.estimate_motion_bands(*pair) for pair in pairs])
    bands = np.full(piece_bands.shape[1], np.nan)
    for j, joint_values in enumerate(piece_bands.T):
        moved = np.isfinite(joint_values)
        if moved.any():
            bands[j] = compute_weighted_median(joint_values[moved], lengths[moved])
    return bands


def estimate_position_noise(seen: Positions | None) -> motion_noise.MotionNoise | None:
    """Returns the noise of the positions of a log whose robot is not known; None without motion.

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
    pieces, _ = split_log(Log("", seen.names, time[rises], q, np.zeros_like(q)), 0, False)
    if not pieces:
        return None
    bands = estimate_joint_bands(pieces, compute_spectra(pieces))
    noise = motion_noise.estimate_motion_noise(joints, pieces, bands)
    return noise.take_last_floors(lambda joint: joint.spectral_slope > THRESHOLDS.max_noise_slope)


def compute_visible_band(band: float, pieces: Sequence[RawSegment]) -> float:
    """Returns hz of the fastest joint, as the window of a piece shows it: 2/T at least."""
    lengths = np.array([len(piece.time) * piece.step for piece in pieces])
    return float(np.hypot(band, 2.0 / compute_weighted_median(lengths, lengths)))


def drop_speeds(piece: RawSegment) -> RawSegment:
    """Returns the piece with its velocities to be taken from the positions."""
    return dataclasses.replace(piece, qd=None, qdd=None)


def compute_spectra(pieces: Sequence[RawSegment]) -> list[MotionSpectrum]:
    """Returns the spectrum of each piece's positions."""
    return [compute_motion_spectrum(piece.q, piece.step) for piece in pieces]


def find_ringing_joints(
    spectra: Sequence[MotionSpectrum], steps: Sequence[float], pieces: Sequence[RawSegment]
) -> list[motion_noise.Ringing]:
    """Returns joints that ring in the longest of some pieces, by more than their encoders' steps.

    A joint that passes count after count shows lines too, but none that are as large as a few
    counts; and torque answers to a controller that oscillates.

    Args:
        spectra: of the positions of the pieces.
        steps: (J,) resolution of each joint, rad or m; 0: none.
        pieces: of the log.
    """
    if not spectra:
        return []
    pairs = zip(spectra, pieces, strict=True)
    longest, piece = max(pairs, key=lambda pair: len(pair[0].frequency))
    speed = longest.power_above_noise * longest.frequency[:, None] ** 2
    rings = []
    for j, energy in enumerate(speed.T):
        ring, first = motion_noise.find_ringing(longest.frequency, energy, j)
        size = float(np.sqrt(longest.power_above_noise[first:, j].sum()))
        if ring is None or size <= COARSE * steps[j]:
            continue
        both = piece.q[:, j], piece.tau[:, j]
        coherence = estimate_coherence(*both, ring.frequency * piece.step)
        if coherence > THRESHOLDS.min_ringing_coherence:
            rings.append(ring)
    return rings


def choose_cutoffs(
    processing: Processing, pieces: Sequence[RawSegment], noise: motion_noise.MotionNoise
) -> tuple[ChosenProcessing, tuple[str, ...]]:
    """Returns the processing with the widest cut-offs that the motion needs, and their reasons.

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
    unseen = "of less than the pieces of motion are long enough to show"
    shown = f"{band:.3g} Hz" if band else unseen
    said = [f"motion band {shown} (99 % of the velocity's energy), sampled at {noise.rate:.4g} Hz"]
    rest = [joint.joint for joint in noise.joints if not joint.is_moving]
    if rest and len(rest) < len(noise.joints):
        one = len(rest) == 1
        said.append(
            f"joint{'' if one else 's'} {', '.join(rest)} rest{'s' if one else ''}: not counted in "
            "the motion band"
        )
    given_cutoff, highest = processing.position_cutoff, THRESHOLDS.max_cutoff_share * slowest
    parallel = processing.parallel_cutoff
    if parallel is None:
        parallel = min(
            max(THRESHOLDS.min_widest_parallel, THRESHOLDS.parallel_bands * band),
            0.5 * (given_cutoff or highest),
        )
        parallel = round_to_two_digits(parallel)
    logged = all(piece.qdd is not None for piece in pieces)
    position = given_cutoff
    if position is None:
        position = round_to_two_digits(min(max(noise.cutoff, 2.0 * parallel), highest))
    if not logged and 0.0 < position < 5.0 * band:
        higher, better = "give a higher --cutoff, or leave it out", "sample faster or move slower"
        said.append(
            f"position filter {position:g} Hz is less than 5 x the motion band of joint "
            f"{fastest.joint}, {band:.3g} Hz: accelerations are damped; "
            f"{better if given_cutoff is None else higher}"
        )
    names = ("position_cutoff", "parallel_cutoff")
    automatic = [name for name in names if getattr(processing, name) is None]
    cutoffs, floors = dict(zip(names, (position, parallel), strict=True)), processing.speed_floors
    chosen = tuple(dict.fromkeys((*processing.automatic_cutoffs, *automatic)))
    choices = {
        **vars(processing),
        **cutoffs,
        "speed_floors": floors or {},
        "automatic_cutoffs": chosen,
    }
    return ChosenProcessing(**choices), tuple(said)


def round_to_two_digits(value: float) -> float:
    """Returns as it is reported, and used."""
    return float(f"{value:.2g}")


# Samples whose positions do not close the loops: reported, and left out.
#
# Noise, a filter's start-up or a slipping encoder take a few postures beyond what the robot
# reaches. No torque belongs to them. The nearest posture that closes stands in for theirs, so
# that everything that is evaluated along a log goes through, and their rows do not count.


def find_nearest_closed(model: CompiledModel, *postures: np.ndarray) -> np.ndarray | None:
    """Returns (n,) the nearest sample, in time, whose postures all close the loops.

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


def close_segments(
    model: CompiledModel, logs: Sequence[Log], segments: Sequence[Segment]
) -> tuple[tuple[Segment, ...], tuple[tuple[float, ...], ...]]:
    """Returns the segments with another posture where theirs does not close, and those times.

    Raises:
        LoopError: fewer than a tenth of the samples close; says how many, and where the first.
    """
    times: list[tuple[float, ...]] = [() for _ in logs]
    both = [close_segment(model, segment) for segment in segments]
    for segment, open_ in both:
        times[segment.run] += tuple(segment.time[open_ & segment.whole].tolist())
    whole = sum(int(segment.whole.sum()) for segment in segments)
    count = sum(len(open_times) for open_times in times)
    if count > (1.0 - THRESHOLDS.min_closed_share) * whole:
        run = next(run for run, open_times in enumerate(times) if open_times)
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


def close_segment(model: CompiledModel, segment: Segment) -> tuple[Segment, np.ndarray]:
    """Returns the segment with postures that close the loops, and (n,) True where it changed."""
    if model.spec.closure is None:
        return segment, np.zeros(segment.samples, dtype=bool)
    nearest = find_nearest_closed(model, segment.q)
    if nearest is None:
        home = np.asarray(model.spec.closure.home)[list(model.spec.closure.actuated)]
        q, open_ = np.tile(home, (segment.samples, 1)), np.ones(segment.samples, dtype=bool)
    else:
        q, open_ = segment.q[nearest], nearest != np.arange(segment.samples)
    if not open_.any():
        return segment, open_
    newly = segment.valid & open_[:, None]
    cause = np.where(newly, np.int8(CAUSES.index(OPEN)), segment.cause)
    return dataclasses.replace(segment, q=q, cause=cause), open_
