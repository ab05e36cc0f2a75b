"""Segments of filtered motion: slow samples of dry friction, bristle states, signals."""

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.sparse import csr_array

from modeler.core.errors import DataError, LoopError
from modeler.core.json import ShortRepr
from modeler.core.manifest import ModuleSpec
from modeler.numerics import filters
from modeler.regression.motion import CAUSES, UNSETTLED, ChosenProcessing, Segment, dilate_flags
from modeler.regression.motion_noise import MotionNoise
from modeler.regression.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel, average_rows

REST_TRAVEL = {"rad": 5e-3, "m": 2e-4}  # a joint that rests in a log, its encoder's steps included
IDLE_TRAVEL = {"rad": 1e-3, "m": 1e-4}  # less than this over all logs counts as standing still


@dataclass(frozen=True)
class FrictionShaft:
    """A rotating part whose friction leaps when its speed changes sign.

    Attributes:
        name: "3", or "5+6" for a motor that turns with two joints.
        coefficients: (joints,) its speed is coefficients . qd.
        joints: rows whose torque leaps.
        unit: "rad" or "m".
    """

    name: str
    coefficients: tuple[float, ...]
    joints: tuple[int, ...]
    unit: str

    def compute_speed(self, qd: np.ndarray) -> np.ndarray:
        """Returns (n,) from joint velocities (n, joints)."""
        return qd @ np.asarray(self.coefficients)


Shafts = Sequence[FrictionShaft]


def find_shafts(model: CompiledModel) -> tuple[FrictionShaft, ...]:
    """Returns the shafts whose columns leap at standstill, found by creeping both ways past it.

    Each base column's leap is measured while one joint after the other creeps forwards and
    backwards at 1e-9 rad/s: smooth columns do not leap, whatever effect they belong to. A column
    leaps for the joints its shaft turns with, by the shaft's coefficient on the rows it acts on.
    """
    joints = len(model.spec.joints)
    state = np.tile(_choose_posture(model), (joints, 1))
    creep = THRESHOLDS.creep_speed * np.eye(joints)
    still = np.zeros((joints, joints))
    signals = np.full((joints, len(model.spec.signals)), 0.5) if model.spec.signals else None
    forwards = model.base_regressor(state, creep, still, signals)
    backwards = model.base_regressor(state, -creep, still, signals)
    leap = 0.5 * (forwards - backwards)  # (moved, row, column)
    shafts: dict[tuple[float, ...], FrictionShaft] = {}
    scale = np.max(np.abs(leap), axis=(0, 1))
    for column in np.flatnonzero(scale > 1e-3):
        share = leap[:, :, column] / scale[column]
        rows = tuple(int(j) for j in np.flatnonzero(np.max(np.abs(share), axis=0) > 1e-6))
        moved = np.flatnonzero(np.max(np.abs(share), axis=1) > 1e-6)
        coefficients = np.zeros(joints)
        if len(moved) == 1:
            coefficients[moved] = 1.0
        else:  # E^T sign(E qd): the leap on the rows is the shaft's coefficient
            coefficients[moved] = share[moved[0], moved]
        key = tuple(round(float(c), 9) for c in coefficients)
        acted = sorted({*rows, *(shafts[key].joints if key in shafts else ())})
        names = "+".join(model.spec.joints[j].name for j in moved)
        unit = model.spec.joints[moved[0]].unit
        shafts[key] = FrictionShaft(names, key, tuple(acted), unit)
    return tuple(shafts.values())


def _choose_posture(model: CompiledModel) -> np.ndarray:
    """Returns (joints,) positions, none of them special; with loops as near home as they close."""
    joints, closure = len(model.spec.joints), model.spec.closure
    state = np.random.default_rng(1).uniform(0.2, 1.0, joints)
    if closure is None:
        return state
    home = np.asarray(closure.home)[list(closure.actuated)]
    for halved in range(THRESHOLDS.home_halvings):
        near = home + 0.5**halved * (state - home)
        try:
            model.coupling(near[None])
        except LoopError:
            continue
        return near
    return home


def find_all_shafts(model: CompiledModel) -> tuple[FrictionShaft, ...]:
    """Returns the shafts, and every joint with a motor that is none of them.

    For looking at dry friction that the model lacks.
    """
    all_shafts, joints = list(find_shafts(model)), model.spec.joints
    names = {part.name for part in all_shafts}
    for j, joint in enumerate(joints):
        if joint.actuated and joint.name not in names:
            coefficients = tuple(float(i == j) for i in range(len(joints)))
            all_shafts.append(FrictionShaft(joint.name, coefficients, (j,), joint.unit))
    return tuple(all_shafts)


def compute_speed_floors(
    processing: ChosenProcessing, parts: Shafts, segments: Sequence[Segment], noise: MotionNoise
) -> dict[str, float]:
    """Returns the speed of each shaft below which its rows are masked; infinite at standstill.

    `low_speed` times the shaft's top speed over all logs, which is its 98 % quantile: a short
    transient (an axis that slams into its first position) must not mask the motion after it. And a
    step of logged speeds, which are 0 or a step at lower ones.
    """
    floors, low = {}, processing.low_speed
    for part, top in zip(parts, compute_top_speeds(parts, segments, noise), strict=True):
        step = noise.compute_speed_step(part.coefficients) if low else 0.0
        floor = max(low * top, min(step, THRESHOLDS.max_reversal_share * top))
        floors[part.name] = processing.speed_floors.get(part.name, floor if top else float("inf"))
    return floors


def compute_top_speeds(
    parts: Shafts,
    segments: Sequence[Segment],
    noise: MotionNoise | None = None,
    least: Mapping[str, float] = IDLE_TRAVEL,
) -> list[float]:
    """Returns 98 % quantile of the speed of each shaft; 0 of one that stands still."""
    tops = []
    for part in parts:
        turned = np.flatnonzero(part.coefficients)
        if noise is not None and not any(noise.joints[j].is_moving for j in turned):
            tops.append(0.0)
            continue
        speeds = np.concatenate([np.abs(part.compute_speed(s.qd)[s.whole]) for s in segments])
        travel = np.concatenate([part.compute_speed(s.q)[s.whole] for s in segments])
        idle = not travel.size or np.ptp(travel) < least[part.unit]
        tops.append(0.0 if idle else float(np.quantile(speeds, THRESHOLDS.top_speed_quantile)))
    return tops


def compute_wide_floors(
    processing: ChosenProcessing, parts: Shafts, segments: Sequence[Segment], noise: MotionNoise
) -> dict[str, float]:
    """Returns speed of each shaft below which it is near a reversal.

    Whoever leaves that out must find the same parameters; a position filter smears the reversal
    itself over `PERIODS` of its cut-off.
    """
    floors, cutoff = {}, processing.position_cutoff
    for part, top in zip(parts, compute_top_speeds(parts, segments, noise), strict=True):
        doubtful = noise.compute_speed_noise(part.coefficients, cutoff)
        doubtful *= THRESHOLDS.reversal_speed_sigmas
        floor = max(THRESHOLDS.reversal_speed_share * top, doubtful)
        floors[part.name] = min(floor, THRESHOLDS.max_reversal_share * top) or float("inf")
    return floors


def find_moving_samples(
    segment: Segment, parts: Shafts, floors: Mapping[str, float], margin: float = 0.0
) -> np.ndarray:
    """Returns (n, joints) False where a shaft that acts on the joint is slower than its floor.

    With a margin, s, also so near to such a sample or to a reversal. One that rests has neither.
    """
    fast = np.ones(segment.qd.shape, dtype=bool)
    reach = round(margin / segment.step)
    for part in parts:
        if segment.rests and {*np.flatnonzero(part.coefficients)} <= {*segment.rests}:
            continue  # gravity on it counts
        speed = part.compute_speed(segment.qd)
        slow = np.abs(speed) < floors[part.name]
        if reach:
            slow[1:] |= np.diff(np.sign(speed)) != 0.0
            slow = dilate_flags(slow, reach)
        fast[np.ix_(slow, list(part.joints))] = False
    return fast


def clear_resting_speeds(
    segments: Sequence[Segment], parts: Shafts, still: Sequence[str] = ()
) -> tuple[Segment, ...]:
    """Returns the segments without speeds of joints that rest all along a log: noise has no sign.

    Args:
        segments: of all logs.
        parts: shafts; those of several joints are left as they are.
        still: names of those that move in no log.
    """
    if not segments:
        return ()
    turned = {part.name: np.flatnonzero(part.coefficients) for part in parts}
    ends = [(s.run, np.stack([s.q.min(axis=0), s.q.max(axis=0)])) for s in segments]
    whole = np.ptp(np.concatenate([ends_of for _, ends_of in ends]), axis=0)
    cleared_segments = []
    for segment in segments:
        logged = [ends_of for run, ends_of in ends if run == segment.run]
        travel = np.ptp(np.concatenate(logged), axis=0)
        joints = tuple(
            int(j[0])
            for part in parts
            if len(j := turned[part.name]) == 1
            and travel[j[0]] < REST_TRAVEL[part.unit]
            and (part.name in still or travel[j[0]] < THRESHOLDS.rest_travel_share * whole[j[0]])
        )
        if joints:
            qd, qdd = segment.qd.copy(), segment.qdd.copy()
            qd[:, joints] = qdd[:, joints] = 0.0
            segment = dataclasses.replace(segment, qd=qd, qdd=qdd, rests=joints)
        cleared_segments.append(segment)
    return tuple(cleared_segments)


# Inner states along measured positions, as `advance` of the C steps them.


def compute_bristle_state(
    q: np.ndarray, distance: float, share: float = 1.0, start: float = 0.0
) -> np.ndarray:
    """Returns (n,) the state z of a Bouc-Wen loop along positions q (n,).

    z' = (v - b |v| z - (1 - b) v |z|)/d. Between reversals w = z sign v grows with the travel x in
    units of d: with y = ln(1 + k w)/k, k = 1 - 2 b, where w < 0, else y = -ln(1 - w), y' = 1.

    Args:
        q: positions.
        distance: d.
        share: b; 1 is Dahl's bristle.
        start: z of the first.
    """
    step = np.diff(q)
    if not step.any():
        return np.full(len(q), start)
    known = np.flatnonzero(step)
    place = np.searchsorted(known, np.arange(len(step)), side="right") - 1
    direction = np.sign(step)[known[np.maximum(place, 0)]]  # the last before a rest, or the first
    begins = np.concatenate([[0], np.flatnonzero(np.diff(direction)) + 1])
    lengths = np.diff(np.append(begins, len(step)))
    travel = np.abs(q[1:] - np.repeat(q[begins], lengths))
    travel = travel / distance
    way, last = direction[begins], travel[begins + lengths - 1]
    k = (1.0 - 2.0 * share) or 1e-12
    first, z = np.empty(len(begins)), start  # y at each turn
    for i, (s, stroke) in enumerate(zip(way.tolist(), last.tolist(), strict=True)):
        w = s * z
        first[i] = math.log1p(k * w) / k if w < 0.0 else -math.log(max(1.0 - w, 1e-300))
        y = first[i] + stroke
        z = s * (math.expm1(k * y) / k if y < 0.0 else -math.expm1(-y))
    y = np.repeat(first, lengths) + travel
    ahead = np.expm1(k * np.minimum(y, 0.0)) / k - np.expm1(-np.maximum(y, 0.0))
    return np.concatenate([[start], direction * ahead])


def count_unsettled_samples(q: np.ndarray, distance: float, share: float) -> int:
    """Returns how many samples of positions q (n,) the state at the first of them still counts in.

    Nobody knows it: until z from -1 and z from 1 have come together; a state that is not forgotten
    within a share of the whole travel does not count from there on.
    """
    travel = np.cumsum(np.abs(np.diff(q, prepend=q[:1])))
    most = int(np.searchsorted(travel, THRESHOLDS.max_unsettled_share * travel[-1]))
    if not most:
        return 0
    first = q[:most], distance, share
    low, high = (compute_bristle_state(*first, start) for start in (-1.0, 1.0))
    unsettled = np.flatnonzero(high - low > THRESHOLDS.max_state_doubt)
    return int(unsettled[-1]) + 1 if unsettled.size else 0


def mask_unsettled_samples(spec: ModuleSpec, segment: Segment) -> Segment:
    """Returns the segment without samples of joints in which an inner state is unknown."""
    cause, names = segment.cause.copy(), [joint.name for joint in spec.joints]
    for signal in spec.signals:
        if signal.kind in ("slip", "bouc_wen"):
            j = names.index(signal.joint)
            count = count_unsettled_samples(segment.q[:, j], signal.value, signal.share)
            here = cause[:count, j]
            here[here < 0] = CAUSES.index(UNSETTLED)
    return dataclasses.replace(segment, cause=cause)


def compute_time_since_reversal(
    q: np.ndarray, step: float, back: float
) -> tuple[np.ndarray, np.ndarray]:
    """Returns direction and s since the joint last turned back, along positions q (n,); each (n,).

    It has turned once it has come back by more than `back`, which takes twice as long at constant
    acceleration as at the speed that it has then; before the first time, s since the start. The
    sign of the direction is the way it goes; its size is 1 less the share of `back` come back.
    """
    way, since = np.zeros(len(q)), step * np.arange(len(q))
    far = np.flatnonzero(np.abs(q - q[0]) > back)
    if not len(far):
        return way, since
    way[0] = direction = float(np.sign(q[far[0]] - q[0]))
    ago = 0.0
    for k, share in enumerate((np.diff(q) / back).tolist(), start=1):
        moved, ago = direction + share, ago + step
        if moved * direction < 0.0:
            ago = min(ago, 2.0 * (1.0 + abs(moved)) * step / abs(share))
            direction = math.copysign(1.0, moved)
        else:
            direction = min(1.0, max(-1.0, moved))
        way[k], since[k] = direction, ago
    return way, since


def apply_lag(x: np.ndarray, step: float, tau: float) -> np.ndarray:
    """Returns (n,) z of z' = (x - z)/tau along x (n,) at even steps, s; at rest at first."""
    decay = math.exp(-step / tau)
    driven = np.append(0.0, (1.0 - decay) * (0.5 * (x[1:] + x[:-1]) - x[0]))
    forward, back = np.array([1.0, 0, 0]), np.array([1.0, -decay, 0])
    return np.asarray(x[0] + filters.apply_biquad(driven, forward, back))


# What effects of a model read besides the motion, over the samples of a segment.


Temperature = Callable[[str], np.ndarray]
"""(n,) of the joint of that name."""


def compute_signals(model: CompiledModel, segment: Segment) -> np.ndarray | None:
    """Returns (n, m) the input `s` of the model's functions; None if it has none.

    Raises:
        DataError: a temperature that an effect reads was not logged.
    """
    if segment.read is not None:
        return segment.read
    motion = segment.q, segment.qd, segment.qdd
    return compute_signals_along(model, motion, segment.time, partial(_read_temperature, segment))


def compute_signals_along(
    model: CompiledModel, motion: Sequence[np.ndarray], time: np.ndarray, temperature: Temperature
) -> np.ndarray | None:
    """Returns (n, m) the same along q, qd, qdd (n, joints) at even times (n,)."""
    spec = model.spec
    if not spec.signals:
        return None
    names, read = [joint.name for joint in spec.joints], np.zeros((len(time), len(spec.signals)))
    step = (time[-1] - time[0]) / max(1, len(time) - 1)
    if model.windup_values is not None and step > 0.0:  # else states that are no motion
        q, qd, qdd = motion
        read = model.compute_windup(q, qd, qdd, step, *model.windup_values)
    for k, signal in enumerate(spec.signals):
        if signal.kind == "time":
            read[:, k] = time
        elif signal.kind == "temperature":
            read[:, k] = temperature(signal.joint)
        elif signal.kind in ("slip", "bouc_wen"):
            q = motion[0][:, names.index(signal.joint)]
            read[:, k] = compute_bristle_state(q, signal.value, signal.share)
        elif signal.kind == "direction":  # the time since it changed stands after it
            q = motion[0][:, names.index(signal.joint)]
            pair = compute_time_since_reversal(q, step, signal.value)
            read[:, [k, k + 1]] = np.stack(pair, axis=1)
        elif signal.kind == "followed":  # a step of no length gives it
            read[:, k] = model.advance(0.0 * motion[0], 0.0, read, *motion)[:, k]
        elif signal.kind == "lag":
            read[:, k] = apply_lag(read[:, k - 1], step, signal.value)
    return read


def _read_temperature(segment: Segment, joint: str) -> np.ndarray:
    for name in (f"temperature{joint}", "temperature"):
        if name in segment.extra:
            return segment.extra[name]
    raise DataError(
        f"no column temperature{joint} or temperature: an effect of the model on joint {joint} "
        "depends on it; log it, or take that effect out of the robot file"
    )


@dataclass(frozen=True, eq=False)
class FilteredSegment(ShortRepr):
    """A segment, its usable samples and its filter.

    Attributes:
        segment: full-rate motion and torque.
        usable: (samples, joints) samples that count.
        rows: the parallel filter.
        used: (rows, joints) rows with enough usable samples.
    """

    segment: Segment
    usable: np.ndarray
    rows: filters.RowFilter
    used: np.ndarray

    def thin_samples(self, every: int, read: np.ndarray | None) -> "FilteredSegment":
        """Returns the same rows by every n-th sample; `read` (samples, m) is what effects read."""
        weights = csr_array(self.rows.weights[:, ::every])
        rows = filters.RowFilter(weights, self.rows.centres // every)
        usable = self.usable[::every].copy()
        return FilteredSegment(self.segment.thin_samples(every, read), usable, rows, self.used)

    @property
    def decimation(self) -> int:
        """Returns the number of samples from one row to the next; 1 where there are no two."""
        centres = self.rows.centres
        return int(centres[1] - centres[0]) if len(centres) > 1 else 1

    def filter_columns(self, evaluate: Callable[[slice], np.ndarray]) -> np.ndarray:
        """Returns filtered columns (rows, joints, ...) of evaluate(window).

        Evaluated in blocks, so that a long log needs no more memory than a short one.
        """
        return np.concatenate([values for _, values in self.iterate_blocks(evaluate)])

    def iterate_blocks(
        self,
        evaluate: Callable[[slice], np.ndarray],
        samples: int = THRESHOLDS.filter_block_samples,
        spans: Sequence[slice] | None = None,
    ) -> Iterator[tuple[slice, np.ndarray]]:
        """Yields filtered columns, about so many samples at a time: which rows, and their values.

        Args:
            evaluate: as of `filter_columns`.
            samples: of a block.
            spans: of each joint, the columns that are not 0; None: all.
        """
        for part, window, rows in self.iterate_parts(samples):
            yield rows, self._compute_means(part, evaluate(window), window, self.used[rows], spans)

    def filter_rows(
        self, rows: np.ndarray, evaluate: Callable[[np.ndarray], np.ndarray]
    ) -> np.ndarray:
        """Returns (m, joints, ...) the same of some rows (m,), of the samples that they reach."""
        blocks, most = list[np.ndarray](), max(1, int(np.diff(self.rows.weights.indptr).max()))
        for some in np.array_split(rows, -(-len(rows) * most // THRESHOLDS.filter_block_samples)):
            weights = self.rows.weights[some]
            reached = np.unique(weights.indices)
            part = filters.RowFilter(csr_array(weights[:, reached]), self.rows.centres[some])
            blocks.append(self._compute_means(part, evaluate(reached), reached, self.used[some]))
        return np.concatenate(blocks)

    def filter_torque(self) -> np.ndarray:
        """Returns (rows, joints) filtered torque."""
        s = self.segment
        return average_rows(self.rows.kernels, s.tau, self.usable, self.used, s.whole)

    def iterate_parts(
        self, samples: int = THRESHOLDS.filter_block_samples
    ) -> Iterator[tuple[filters.RowFilter, slice, slice]]:
        """Yields filters of a few rows each, the samples they reach, and which rows they are."""
        total, count = len(self.rows.centres), max(1, samples // self.decimation)
        if 0 < total <= count:
            yield self.rows, slice(0, self.segment.samples), slice(0, total)
            return
        for first in range(0, total, count):
            rows = slice(first, min(first + count, total))
            window = self.rows.find_sample_range(rows)
            yield self.rows.extract_rows(rows, window), window, rows

    def _compute_means(
        self,
        part: filters.RowFilter,
        values: np.ndarray,
        window: slice | np.ndarray,
        used: np.ndarray,
        spans: Sequence[slice] | None = None,
    ) -> np.ndarray:
        """Returns means over usable samples where the row counts, over whole samples elsewhere."""
        usable, whole = self.usable[window], self.segment.whole[window]
        return average_rows(part.kernels, values, usable, used, whole, spans)


def filter_segment(
    segment: Segment,
    shafts: Shafts,
    processing: ChosenProcessing,
    centres: np.ndarray | None = None,
) -> FilteredSegment:
    """Returns the segment with its filter; rows with half of their weight on usable samples count.

    Args:
        segment: of a log, or of a chunk of one.
        shafts: whose low speeds do not count.
        processing: of it.
        centres: (rows,) samples in the middle of the rows; None: as of a whole log.
    """
    cutoff = processing.parallel_cutoff
    usable = segment.valid & find_moving_samples(segment, shafts, processing.speed_floors)
    if centres is None:
        every = filters.choose_row_spacing(segment.step, cutoff, processing.decimation)
        centres = choose_row_centres(segment, every)
    rows = filters.build_row_filter(centres, segment.samples, segment.step, cutoff)
    return FilteredSegment(
        segment, usable, rows, rows.compute_usable_share(usable) >= filters.LEAST_WEIGHT
    )


def choose_row_centres(segment: Segment, every: int) -> np.ndarray:
    """Returns (rows,) samples in the middle of the rows of a segment, so many samples apart."""
    inside = np.flatnonzero(segment.whole)
    return inside[(len(inside) - 1) % every // 2 :: every]
