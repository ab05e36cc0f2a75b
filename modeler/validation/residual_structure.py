"""Does a residual still have structure: is it a repeatable function of something?"""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Literal

import numpy as np

from modeler.core.json import Document
from modeler.numerics import spectra, splines
from modeler.numerics.noise import interpolate_between_gaps
from modeler.validation.prediction import Prediction, select_full_rate
from modeler.validation.thresholds import THRESHOLDS

# The coordinates against which a residual is looked at.


@dataclass(frozen=True)
class Coordinate:
    """One way to look at a residual: id, axis label, and how a sentence names it."""

    id: str
    label: str
    phrase: str  # "41 % of that is a repeatable function of <phrase>"
    unit: str  # on an axis, {unit} that of the position, {effort} that of the torque


# In the order in which a simpler explanation is preferred to one that is hardly better.
COORDINATES = (
    Coordinate("direction", "direction of motion", "the direction of motion alone", "-"),
    Coordinate("velocity", "velocity", "velocity", "{unit}/s"),
    Coordinate("position", "position", "position", "{unit}"),
    Coordinate("acceleration", "acceleration", "acceleration", "{unit}/s^2"),
    Coordinate(
        "load", "|predicted| x direction of motion", "load and direction of motion", "{effort}"
    ),
    Coordinate(
        "travel", "travel x direction of motion", "travel since the last reversal", "{unit}"
    ),
    Coordinate("temperature", "temperature", "temperature", "as logged"),
    Coordinate("time", "time", "time (slow drift)", "s"),
)

DRIFTS = ("temperature", "time")
"""Coordinates that are not the joint's motion, and change once in a log, slowly."""


def select_coordinates(prediction: Prediction, joint: int) -> tuple[Coordinate, ...]:
    """Selects the logged coordinates of one joint; temperature only where every used row has it."""
    used = prediction.used[:, joint]
    missing = set()
    if prediction.travel is None:
        missing.add("travel")
    if prediction.temperature is None or not np.isfinite(prediction.temperature[used, joint]).all():
        missing.add("temperature")
    return tuple(coordinate for coordinate in COORDINATES if coordinate.id not in missing)


def evaluate_coordinate(prediction: Prediction, joint: int, coordinate: str) -> np.ndarray:
    """Returns a coordinate of one joint, all rows, (n,); time counts from the log's start."""
    qd = prediction.qd[:, joint]
    plain = {
        "position": prediction.q,
        "velocity": prediction.qd,
        "acceleration": prediction.qdd,
        "temperature": prediction.temperature,
    }
    turned = {"load": np.abs(prediction.predicted), "travel": prediction.travel}
    if coordinate == "direction":
        return np.sign(qd)
    if (values := plain.get(coordinate)) is not None:
        return values[:, joint]
    if (values := turned.get(coordinate)) is not None:
        return values[:, joint] * np.sign(qd)
    assert coordinate == "time", coordinate
    starts = [prediction.time[prediction.run == run] for run in range(len(prediction.logs))]
    first = np.array([times[0] if times.size else 0.0 for times in starts])
    return prediction.time - first[prediction.run]


def format_coordinate_unit(prediction: Prediction, joint: int, coordinate: str) -> str:
    """Formats the unit of a coordinate for an axis."""
    info = prediction.joints[joint]
    unit = next(entry.unit for entry in COORDINATES if entry.id == coordinate)
    return unit.format(unit=info.unit, effort=info.effort_unit)


# Drift: many short blocks, because a slow function of time can only be judged between its knots.
_DRIFT = (40, 5)  # blocks, folds

_ELSEWHERE = ("position", "velocity", "acceleration")  # of other joints


@dataclass(frozen=True)
class BestPredictor:
    """What all that was measured predicts.

    Attributes:
        share: of the residual's variance; 0 if it is within two standard errors of 0.
        joint: whose motion alone predicts nearly as much; None: no single joint's.
        coordinate: id of the one of another joint that does; "": none alone.
    """

    share: float
    joint: str | None = None
    coordinate: str = ""


@dataclass(frozen=True)
class ResidualStructure(Document):
    """Shares of the residual variance that functions predict on motion not used to fit them.

    Coordinates of one trajectory go together, so the shares overlap and do not add up.
    """

    KEYS = """
        shares=coordinate_shares other_joints=joint_shares motors=motor_shares own_motion
        best_predictor
    """

    shares: tuple[tuple[str, float], ...]  # coordinate id -> share, in the order of COORDINATES
    own_motion: float  # by the joint's own motion: its coordinates together, or the best one alone
    other_joints: tuple[
        tuple[str, float], ...
    ]  # joint name -> share, by a function of its velocity
    best_predictor: BestPredictor
    motors: tuple[tuple[str, float], ...] = ()  # coupled motor, "5+6" -> share, of its velocity

    def get_share(self, coordinate: str) -> float:
        """Returns the share of one coordinate; NaN where the logs do not hold it."""
        return dict(self.shares).get(coordinate, float("nan"))

    @property
    def coordinate_shares(self) -> dict[str, float]:
        """Returns the shares by coordinate."""
        return dict(self.shares)

    @property
    def joint_shares(self) -> dict[str, float]:
        """Returns the shares by a function of the velocity of a joint, by its name."""
        return dict(self.other_joints)

    @property
    def motor_shares(self) -> dict[str, float]:
        """Returns the shares by a function of the velocity of a coupled motor."""
        return dict(self.motors)


def analyse_structure(prediction: Prediction, joint: int) -> ResidualStructure | None:
    """Analyses the structure of one joint's residual; None with too few samples."""
    rows = np.flatnonzero(prediction.used[:, joint])
    if rows.size < THRESHOLDS.min_samples:
        return None
    rows = rows[:: -(-rows.size // THRESHOLDS.max_structure_samples)]
    e = prediction.measured[rows, joint] - prediction.predicted[rows, joint]
    names = [coordinate.id for coordinate in select_coordinates(prediction, joint)]
    m = _collect_measurements(prediction, joint, rows)
    sets = {
        name: _build_curve(prediction, joint, name, rows) for name in names if name not in DRIFTS
    }
    by = {joint: (*sets, *splines.OWN)}
    for k in range(m.q.shape[1]):
        if k != joint:
            curves = (
                splines.build_hat_functions(m.q[:, k]),
                splines.build_friction_functions(m.v[:, k]),
                splines.build_hat_functions(m.a[:, k]),
            )
            sets |= {f"{name} {k}": x for name, x in zip(_ELSEWHERE, curves, strict=True)}
            by[k] = (str(k), *(f"{name} {k}" for name in _ELSEWHERE))
    for motor in prediction.motors:
        sets[motor.name] = splines.build_friction_functions(m.v @ np.asarray(motor.coefficients))
    baseline = splines.fit_nonparametric_baseline(
        chain(sets.items(), splines.generate_function_sets(m)),
        e,
        splines.assign_folds(prediction.run[rows]),
    )
    alone = {name: baseline.share_by_set.get(name, 0.0) for name in sets} | baseline.share_by_set
    drifts = {
        name: _estimate_drift_share(prediction, joint, name, rows, e)
        for name in names
        if name in DRIFTS
    }
    joints = tuple(enumerate(info.name for info in prediction.joints))
    best = {k: max(alone.get(name, 0.0) for name in by[k]) for k, _ in joints}
    return ResidualStructure(
        shares=tuple((name, (alone | drifts)[name]) for name in names),
        own_motion=best[joint],
        other_joints=tuple(
            (name, alone[by[k][2] if k != joint else "velocity"]) for k, name in joints
        ),
        best_predictor=_find_best_predictor(baseline, best, by, prediction, joint),
        motors=tuple((motor.name, alone[motor.name]) for motor in prediction.motors),
    )


def _find_best_predictor(
    baseline: splines.NonparametricBaseline,
    best: Mapping[int, float],
    by: Mapping[int, Sequence[str]],
    prediction: Prediction,
    joint: int,
) -> BestPredictor:
    """The joint, and its coordinate, that does as well as everything."""
    enough = THRESHOLDS.parsimony_share * baseline.share
    if not baseline.is_significant:
        return BestPredictor(0.0)
    place = max(best, key=lambda k: best[k])
    if best[place] < enough:
        return BestPredictor(baseline.share)
    single = () if place == joint else zip(_ELSEWHERE, by[place][1:], strict=True)
    coordinates = [name for name, of in single if baseline.share_by_set.get(of, 0.0) >= enough]
    return BestPredictor(baseline.share, prediction.joints[place].name, next(iter(coordinates), ""))


def _collect_measurements(
    prediction: Prediction, joint: int, rows: np.ndarray
) -> splines.Measurements:
    """What was measured on some rows; 0 throughout for joints that may hold anything there."""
    every = [
        np.where(np.isfinite(x[rows]).all(axis=0), x[rows], 0.0)
        for x in (prediction.q, prediction.qd, prediction.qdd, prediction.predicted)
    ]
    q, v, a, torque = every
    way, slips = np.sign(v[:, joint]), np.zeros((rows.size, 0))
    if prediction.travel is not None:
        stroke = max(float(np.ptp(q[:, joint])), 1e-12)
        turned = [np.exp(-prediction.travel[rows, joint] / (d * stroke)) for d in splines.SLIPS]
        slips = way[:, None] * (1.0 - 2.0 * np.column_stack(turned))
    return splines.Measurements(joint, q, v, a, torque, torque, way, slips, {})


def _estimate_drift_share(
    prediction: Prediction, joint: int, name: str, rows: np.ndarray, e: np.ndarray
) -> float:
    """Share by slow functions; of a temperature, what it adds to the direction of motion alone.

    Friction changes with temperature, gravity does not: another function for either direction.
    """
    blocks, folds = _DRIFT
    fold = (np.arange(e.size) * blocks // e.size) % folds
    values = evaluate_coordinate(prediction, joint, name)[rows]
    if name == "time":
        columns = splines.build_drift_functions(values, prediction.run[rows])
        return splines.fit_nonparametric_baseline([(name, columns)], e, fold).share
    way = np.sign(prediction.qd[rows, joint])[:, None]
    slow = splines.build_hat_functions(values, 5)
    both = (name, np.hstack((slow, slow * way))), ("direction", way)
    share_by_set = splines.fit_nonparametric_baseline(both, e, fold).share_by_set
    return max(0.0, share_by_set.get(name, 0.0) - share_by_set.get("direction", 0.0))


def _build_curve(
    prediction: Prediction, joint: int, coordinate: str, rows: np.ndarray
) -> np.ndarray:
    values = evaluate_coordinate(prediction, joint, coordinate)[rows]
    if coordinate == "direction":
        return values[:, None]
    return (
        splines.build_friction_functions(values)
        if coordinate in ("velocity", "travel")
        else splines.build_hat_functions(values)
    )


# The order spectrum of a joint's residual, seen before any filter takes the ripple away.


@dataclass(frozen=True)
class SpectralLine:
    """A wave that stands out."""

    waves: float  # per turn of a revolute joint, per m of a prismatic one
    amplitude: float  # N m or N
    share: float  # of the squared residual before filtering


def compute_ripple_spectrum(prediction: Prediction, joint: int) -> spectra.OrderSpectrum | None:
    """Computes the order spectrum of the samples that count; None of few, or if the joint rests."""
    full = select_full_rate(prediction)
    r, q = full.residual[:, joint], full.q[:, joint]
    counts = np.isfinite(r) & np.isfinite(q)
    if not counts.any():
        return None
    left = r[counts]
    return spectra.compute_order_spectrum(
        q[counts], left - left.mean(), prediction.joints[joint].unit, float("inf")
    )


def convert_orders(orders: spectra.OrderSpectrum, unit: str) -> tuple[np.ndarray, str]:
    """Returns the orders of a spectrum per turn or per m, and which.

    Args:
        orders: the spectrum.
        unit: of the joint's position, rad or m.
    """
    if unit == "rad":
        return orders.order, "turn"
    return orders.order / (2.0 * np.pi), "m"


def find_order_peaks(orders: spectra.OrderSpectrum | None, unit: str) -> tuple[SpectralLine, ...]:
    """Finds the peaks of an order spectrum, the strongest first; see `convert_orders`."""
    if orders is None:
        return ()
    spectrum, (counted, _) = orders, convert_orders(orders, unit)
    places = [int(np.argmin(np.abs(spectrum.order - order))) for order in spectrum.peaks]
    return tuple(
        SpectralLine(
            waves=float(counted[k]),
            amplitude=float(spectrum.amplitude[k]),
            share=0.5 * float(spectrum.amplitude[k]) ** 2 / spectrum.power,
        )
        for k in places
    )


# What the variance of a joint's torque is made of: explained, repeatable, noise.


Method = Literal["laps", "logs", "smooth"]


@dataclass(frozen=True)
class Partner:
    """At t in log `run` and at t + shift in log `other` the robot did the same."""

    run: int
    other: int
    shift: float  # s


@dataclass(frozen=True)
class Repetition(Document):
    """The partners of all logs: times at which the robot did the same."""

    KEYS = "method=kind periods"

    kind: Literal["laps", "logs"]
    partners: tuple[Partner, ...]
    periods: tuple[float, ...]  # s, of the logs that have laps


def find_repetitions(prediction: Prediction) -> tuple[Repetition, ...]:
    """Finds laps, then logs of the same motion; empty if no motion was repeated."""
    motions = _collect_motions(prediction)
    candidates = [_find_laps(motions), _find_same_motions(motions)]
    return tuple(item for item in candidates if item.partners)


@dataclass(frozen=True, eq=False)
class _RepeatedMotion:
    run: int
    step: float  # s, between rows
    time: np.ndarray  # (m,) s, full rate
    q: np.ndarray  # (m, moving joints) rad or m
    size: np.ndarray  # (moving joints,) standard deviations of q
    ends: np.ndarray  # (2, joints) lowest and highest position


def _collect_motions(prediction: Prediction) -> list[_RepeatedMotion]:
    full, motions = select_full_rate(prediction), []
    strokes = np.nanmax(prediction.q, axis=0) - np.nanmin(prediction.q, axis=0)
    moving = strokes > THRESHOLDS.min_stroke * strokes.max()
    for run in range(len(prediction.logs)):
        rows, times = full.run == run, prediction.time[prediction.run == run]
        rows &= np.isfinite(full.q).all(axis=1)
        if times.size > 2 and rows.sum() > 2 and moving.any():
            q, time = full.q[rows], full.time[rows]
            every = max(1, time.size // (10 * THRESHOLDS.motion_points))
            size = np.maximum(q[:, moving].std(axis=0), 1e-12)
            ends = np.array([q.min(axis=0), q.max(axis=0)])
            step = float(np.median(np.diff(times)))
            motions.append(
                _RepeatedMotion(run, step, time[::every], q[::every, moving], size, ends)
            )
    return motions


def _find_laps(motions: list[_RepeatedMotion]) -> Repetition:
    partners, periods = [], []
    for whole in motions:
        rows = spectra.find_longest_stretch(whole.time, whole.step)
        motion = dataclasses.replace(whole, time=whole.time[rows], q=whole.q[rows])
        length = float(np.ptp(motion.time))
        even = np.arange(0.0, length, motion.step)
        rough = spectra.estimate_lap_period(
            even, _interpolate_positions(motion, motion.time[0] + even)
        )
        if rough == 0.0:
            continue
        period = _refine_period(motion, rough)
        periods.append(period)
        for k in range(1, min(THRESHOLDS.max_laps, int(length / period)) + 1):
            partners += [
                Partner(motion.run, motion.run, k * period),
                Partner(motion.run, motion.run, -k * period),
            ]
    return Repetition("laps", tuple(partners), tuple(periods))


def _refine_period(motion: _RepeatedMotion, period: float) -> float:
    """The period from laps farther and farther apart: an error of it grows with their number."""
    half, laps = motion.step, 1
    most = max(1, int(np.ptp(motion.time) / period) - 1)
    while True:
        period = _refine_shift(motion, motion, laps * period, laps * half) / laps
        if laps == most:
            return period
        laps, half = min(2 * laps, most), half / 10


def _find_same_motions(motions: list[_RepeatedMotion]) -> Repetition:
    """Each log beside the first one of the same motion, in groups."""
    groups: list[list[tuple[_RepeatedMotion, float]]] = []
    for motion in motions:
        for group in groups:
            shift = _estimate_shift(group[0][0], motion)
            if shift is not None:
                group.append((motion, shift))
                break
        else:
            groups.append([(motion, 0.0)])
    partners = [
        Partner(a.run, b.run, later - sooner)
        for group in groups
        for a, sooner in group
        for b, later in group
        if a is not b
    ]
    return Repetition("logs", tuple(partners), ())


def _estimate_shift(first: _RepeatedMotion, other: _RepeatedMotion) -> float | None:
    """s by which the clock of `other` is ahead for the same motion; None for another motion."""
    stroke = float(np.ptp(first.ends, axis=0).max())
    if np.abs(first.ends - other.ends).max() > THRESHOLDS.max_stroke_difference * stroke:
        return None
    lengths = [float(np.ptp(m.time)) for m in (first, other)]
    if min(lengths) < 4 * first.step:
        return None
    start = other.time[0] - first.time[0]
    reach = min(int(0.25 * min(lengths) / first.step), THRESHOLDS.max_shift_rows)
    candidates = start + first.step * np.arange(-reach, reach + 1)
    apart = [
        _compute_distance(first, other, shift, THRESHOLDS.min_overlap * min(lengths))
        for shift in candidates
    ]
    best = _refine_shift(first, other, float(candidates[int(np.argmin(apart))]), first.step)
    # twice the variance, which is one: the mean squared difference of motions that are not alike
    alike = (
        1.0
        - _compute_distance(first, other, best, 0.9 * THRESHOLDS.min_overlap * min(lengths)) / 2.0
    )
    return best if alike > spectra.THRESHOLDS.min_repeat_correlation else None


def _refine_shift(
    first: _RepeatedMotion, other: _RepeatedMotion, around: float, half: float
) -> float:
    """The shift near `around` at which the motions are least apart; a parabola between the grid."""
    grid = around + half * np.linspace(-1.0, 1.0, 2 * THRESHOLDS.shift_grid + 1)
    apart = np.array([_compute_distance(first, other, shift, 0.0) for shift in grid])
    best = int(np.argmin(apart))
    if not 0 < best < grid.size - 1:
        return float(grid[best])
    before, here, after = apart[best - 1 : best + 2]
    bend = before - 2.0 * here + after
    part = 0.5 * (before - after) / bend if bend > 0.0 else 0.0
    return float(grid[best] + part * (grid[1] - grid[0]))


def _compute_distance(
    first: _RepeatedMotion, other: _RepeatedMotion, shift: float, overlap: float
) -> float:
    """Mean squared difference of the joint that differs most; infinite with less overlap."""
    begin = max(first.time[0], other.time[0] - shift)
    end = min(first.time[-1], other.time[-1] - shift)
    if end - begin < max(overlap, 2 * first.step):
        return float("inf")
    times = np.linspace(
        begin, end, int(min(THRESHOLDS.motion_points, (end - begin) / first.step + 2))
    )
    apart = (
        _interpolate_positions(first, times) - _interpolate_positions(other, times + shift)
    ) / first.size
    return float(np.mean(apart**2, axis=0).max())


def _interpolate_positions(motion: _RepeatedMotion, times: np.ndarray) -> np.ndarray:
    return np.column_stack([np.interp(times, motion.time, column) for column in motion.q.T])


@dataclass(frozen=True)
class VarianceShares:
    """Shares of sum (measured - mean)^2; the three sum to one.

    Explained is R^2, and negative for a prediction that is worse than the best constant.
    """

    explained_share: float
    systematic_share: float  # repeatable, and not in the model
    noise_share: float  # noise, as far as these logs can show
    method: Method  # how the last two were distinguished
    sigma: float | None  # standard error of both; None by the method "smooth"

    @property
    def repeatable_share(self) -> float:
        """Returns the repeatable share of what is not explained; 0 if nothing is left."""
        left = self.systematic_share + self.noise_share
        return self.systematic_share / left if left > 0.0 else 0.0


def split_variance(
    prediction: Prediction,
    joint: int,
    e: np.ndarray,
    repeated: tuple[Repetition, ...],
    structure: ResidualStructure | None,
) -> VarianceShares | None:
    """Splits the variance of one joint; None for a constant torque, or too few samples.

    Where the motion was repeated, the repeatable part is the mean product of the residual and that
    of the same moment in another lap (or log): noise of different laps has mean product zero.
    Otherwise it is the squared mean and what smooth functions of the motion predict of the rest on
    blocks of time that were held out.

    Args:
        prediction: the rows.
        joint: which one.
        e: (n,) its residual, NaN where a row does not count.
        repeated: laps, logs of one motion.
        structure: structure of the residual.
    """
    rows = np.flatnonzero(prediction.used[:, joint])
    y = prediction.measured[rows, joint]
    spread, energy = float(np.sum((y - y.mean()) ** 2)), float(e[rows] @ e[rows])
    if spread <= 0.0:
        return None
    left = energy / spread
    for repetition in repeated:
        returning = _estimate_recurring_share(prediction, joint, e, repetition)
        if returning is not None:
            again, error = returning
            kind = repetition.kind
            return VarianceShares(
                1.0 - left, again * left, (1.0 - again) * left, kind, error * left
            )
    if structure is None or energy == 0.0:
        return None if energy else VarianceShares(1.0, 0.0, 0.0, "smooth", None)
    offset = rows.size * float(e[rows].mean()) ** 2 / energy
    smooth = max(structure.own_motion, structure.best_predictor.share)
    again = offset + (1.0 - offset) * smooth
    return VarianceShares(1.0 - left, again * left, (1.0 - again) * left, "smooth", None)


def _estimate_recurring_share(
    prediction: Prediction, joint: int, e: np.ndarray, repetition: Repetition
) -> tuple[float, float] | None:
    """Share of the squared residual that laps have in common, and its standard error.

    The error comes from sums over half a dozen neighbouring rows, which may share their noise.
    None with too few rows repeated.
    """
    full = select_full_rate(prediction)
    products, squares, scatter = 0.0, 0.0, 0.0
    repeated = np.zeros(e.size, dtype=bool)
    for partner in repetition.partners:
        rows = np.flatnonzero((prediction.run == partner.run) & np.isfinite(e))
        there = full.run == partner.other
        then = prediction.time[rows] + partner.shift
        other = interpolate_between_gaps(full.time[there], full.filtered[there, joint], then)
        there = np.isfinite(other)
        if not there.any():
            continue
        residuals, other = e[rows][there], other[there]
        if np.median(np.abs(residuals - other) > 1e-3 * np.abs(residuals)) < 0.5:
            continue  # the same measurements given twice: their noise is alike, too
        product = residuals * other
        parts = np.add.reduceat(product, np.arange(0, residuals.size, THRESHOLDS.neighbour_rows))
        products += float(product.sum())
        squares += float(residuals @ residuals)
        # every pair of moments stands here twice, once from either side
        scatter += 2.0 * float(parts @ parts)
        repeated[rows[there]] = True
    if repeated.sum() < max(
        THRESHOLDS.min_repeated_rows, THRESHOLDS.min_repeated_share * np.isfinite(e).sum()
    ):
        return None
    if squares == 0.0:
        return 0.0, 0.0
    return float(np.clip(products / squares, 0.0, 1.0)), float(np.sqrt(scatter)) / squares
