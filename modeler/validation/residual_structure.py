"""Does a residual still have structure: is it a repeatable function of something?"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from modeler.numerics.spectra import OrderSpectrum, compute_order_spectrum
from modeler.numerics.splines import (
    OWN,
    SLIPS,
    Measurements,
    NonparametricBaseline,
    assign_folds,
    build_drift_functions,
    build_friction_functions,
    build_hat_functions,
    fit_nonparametric_baseline,
    generate_function_sets,
)
from modeler.validation.prediction import Prediction, select_full_rate

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
    """Those that the logs hold of one joint; temperature only where every used row has it."""
    used = prediction.used[:, joint]
    missing = set()
    if prediction.travel is None:
        missing.add("travel")
    if prediction.temperature is None or not np.isfinite(prediction.temperature[used, joint]).all():
        missing.add("temperature")
    return tuple(coordinate for coordinate in COORDINATES if coordinate.id not in missing)


def evaluate_coordinate(prediction: Prediction, joint: int, coordinate: str) -> np.ndarray:
    """Values of a coordinate of one joint, all rows, (n,); time counts from the log's start."""
    qd = prediction.qd[:, joint]
    plain = {"position": prediction.q, "velocity": prediction.qd, "acceleration": prediction.qdd,
             "temperature": prediction.temperature}  # fmt: skip
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
    """Unit of a coordinate as it stands on an axis."""
    info = prediction.joints[joint]
    unit = next(entry.unit for entry in COORDINATES if entry.id == coordinate)
    return unit.format(unit=info.unit, effort=info.effort_unit)


ENOUGH = 200  # samples below which nothing is said about structure

NEARLY = 0.9  # a simpler function that explains this much of the best is named instead

_MOST = 3000  # samples beyond which every second, third, ... is looked at

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
class ResidualStructure:
    """Shares of the residual variance that functions predict on motion not used to fit them.

    Coordinates of one trajectory go together, so the shares overlap and do not add up.
    """

    shares: tuple[tuple[str, float], ...]  # coordinate id -> share, in the order of COORDINATES
    together: float  # by the joint's own motion: its coordinates together, or the best one alone
    across: tuple[tuple[str, float], ...]  # joint name -> share, by a function of its velocity
    follows: BestPredictor
    motors: tuple[tuple[str, float], ...] = ()  # coupled motor, "5+6" -> share, of its velocity

    def get_share(self, coordinate: str) -> float:
        """Share of one coordinate; NaN where the logs do not hold it."""
        return dict(self.shares).get(coordinate, float("nan"))


def analyse_structure(prediction: Prediction, joint: int) -> ResidualStructure | None:
    """Structure of one joint's residual; None with fewer than ENOUGH samples."""
    rows = np.flatnonzero(prediction.used[:, joint])
    if rows.size < ENOUGH:
        return None
    rows = rows[:: -(-rows.size // _MOST)]
    e = prediction.measured[rows, joint] - prediction.predicted[rows, joint]
    names = [coordinate.id for coordinate in select_coordinates(prediction, joint)]
    m = _collect_measurements(prediction, joint, rows)
    sets = {
        name: _build_curve(prediction, joint, name, rows) for name in names if name not in DRIFTS
    }
    by = {joint: (*sets, *OWN)}
    for k in range(m.q.shape[1]):
        if k != joint:
            curves = (
                build_hat_functions(m.q[:, k]),
                build_friction_functions(m.v[:, k]),
                build_hat_functions(m.a[:, k]),
            )
            sets |= {f"{name} {k}": x for name, x in zip(_ELSEWHERE, curves, strict=True)}
            by[k] = (str(k), *(f"{name} {k}" for name in _ELSEWHERE))
    for motor in prediction.motors:
        sets[motor.name] = build_friction_functions(m.v @ np.asarray(motor.coefficients))
    baseline = fit_nonparametric_baseline(
        chain(sets.items(), generate_function_sets(m)), e, assign_folds(prediction.run[rows])
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
        together=best[joint],
        across=tuple((name, alone[by[k][2] if k != joint else "velocity"]) for k, name in joints),
        follows=_find_best_predictor(baseline, best, by, prediction, joint),
        motors=tuple((motor.name, alone[motor.name]) for motor in prediction.motors),
    )


def _find_best_predictor(
    baseline: NonparametricBaseline, best: Mapping[int, float], by: Mapping[int, Sequence[str]],
    prediction: Prediction, joint: int,
) -> BestPredictor:  # fmt: skip
    """The joint, and its coordinate, that does as well as everything."""
    enough = NEARLY * baseline.share
    if not baseline.is_significant:
        return BestPredictor(0.0)
    place = max(best, key=lambda k: best[k])
    if best[place] < enough:
        return BestPredictor(baseline.share)
    single = () if place == joint else zip(_ELSEWHERE, by[place][1:], strict=True)
    coordinates = [name for name, of in single if baseline.share_by_set.get(of, 0.0) >= enough]
    return BestPredictor(baseline.share, prediction.joints[place].name, next(iter(coordinates), ""))


def _collect_measurements(prediction: Prediction, joint: int, rows: np.ndarray) -> Measurements:
    """What was measured on some rows; 0 throughout for joints that may hold anything there."""
    every = [
        np.where(np.isfinite(x[rows]).all(axis=0), x[rows], 0.0)
        for x in (prediction.q, prediction.qd, prediction.qdd, prediction.predicted)
    ]
    q, v, a, torque = every
    way, slips = np.sign(v[:, joint]), np.zeros((rows.size, 0))
    if prediction.travel is not None:
        stroke = max(float(np.ptp(q[:, joint])), 1e-12)
        turned = [np.exp(-prediction.travel[rows, joint] / (d * stroke)) for d in SLIPS]
        slips = way[:, None] * (1.0 - 2.0 * np.column_stack(turned))
    return Measurements(joint, q, v, a, torque, torque, way, slips, {})


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
        columns = build_drift_functions(values, prediction.run[rows])
        return fit_nonparametric_baseline([(name, columns)], e, fold).share
    way = np.sign(prediction.qd[rows, joint])[:, None]
    slow = build_hat_functions(values, 5)
    both = (name, np.hstack((slow, slow * way))), ("direction", way)
    share_by_set = fit_nonparametric_baseline(both, e, fold).share_by_set
    return max(0.0, share_by_set.get(name, 0.0) - share_by_set.get("direction", 0.0))


def _build_curve(
    prediction: Prediction, joint: int, coordinate: str, rows: np.ndarray
) -> np.ndarray:
    values = evaluate_coordinate(prediction, joint, coordinate)[rows]
    if coordinate == "direction":
        return values[:, None]
    return (
        build_friction_functions(values)
        if coordinate in ("velocity", "travel")
        else build_hat_functions(values)
    )


# The order spectrum of a joint's residual, seen before any filter takes the ripple away.


@dataclass(frozen=True)
class SpectralLine:
    """A wave that stands out."""

    waves: float  # per turn of a revolute joint, per m of a prismatic one
    amplitude: float  # N m or N
    share: float  # of the squared residual before filtering


def compute_ripple_spectrum(prediction: Prediction, joint: int) -> OrderSpectrum | None:
    """Of the samples that count, at full rate; None if they are few, or the joint rests."""
    full = select_full_rate(prediction)
    r, q = full.residual[:, joint], full.q[:, joint]
    counts = np.isfinite(r) & np.isfinite(q)
    if not counts.any():
        return None
    left = r[counts]
    return compute_order_spectrum(
        q[counts], left - left.mean(), prediction.joints[joint].unit, float("inf")
    )


def convert_orders(orders: OrderSpectrum, unit: str) -> tuple[np.ndarray, str]:
    """Orders of a spectrum as a user counts them, and per what.

    Args:
        orders: the spectrum.
        unit: of the joint's position, rad or m.
    """
    if unit == "rad":
        return orders.order, "turn"
    return orders.order / (2.0 * np.pi), "m"


def find_order_peaks(orders: OrderSpectrum | None, unit: str) -> tuple[SpectralLine, ...]:
    """What stands out in an order spectrum, the strongest first; see `convert_orders`."""
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
