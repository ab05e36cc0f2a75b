"""Does a residual still have structure: is it a repeatable function of something?"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from modeler.numerics.spectra import OrderSpectrum, order_spectrum
from modeler.numerics.splines import (
    OWN,
    SLIPS,
    Flexible,
    Measurements,
    curve,
    drift_curve,
    flexible,
    friction_curve,
    functions,
    stretches,
)
from modeler.validation.prediction import Prediction, full_rate

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


def coordinates_of(prediction: Prediction, joint: int) -> tuple[Coordinate, ...]:
    """Those that the logs hold of one joint; temperature only where every used row has it."""
    used = prediction.used[:, joint]
    missing = set()
    if prediction.travel is None:
        missing.add("travel")
    if prediction.temperature is None or not np.isfinite(prediction.temperature[used, joint]).all():
        missing.add("temperature")
    return tuple(coordinate for coordinate in COORDINATES if coordinate.id not in missing)


def coordinate_values(prediction: Prediction, joint: int, coordinate: str) -> np.ndarray:
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


def coordinate_unit(prediction: Prediction, joint: int, coordinate: str) -> str:
    """Unit of a coordinate as it stands on an axis."""
    info = prediction.joints[joint]
    unit = next(own.unit for own in COORDINATES if own.id == coordinate)
    return unit.format(unit=info.unit, effort=info.effort_unit)


ENOUGH = 200  # samples below which nothing is said about structure

NEARLY = 0.9  # a simpler function that explains this much of the best is named instead

_MOST = 3000  # samples beyond which every second, third, ... is looked at

# Drift: many short blocks, because a slow function of time can only be judged between its knots.
_DRIFT = (40, 5)  # blocks, folds

_ELSEWHERE = ("position", "velocity", "acceleration")  # of other joints


@dataclass(frozen=True)
class Follows:
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
class Structure:
    """Shares of the residual variance that functions predict on motion not used to fit them.

    Coordinates of one trajectory go together, so the shares overlap and do not add up.
    """

    shares: tuple[tuple[str, float], ...]  # coordinate id -> share, in the order of COORDINATES
    together: float  # by the joint's own motion: its coordinates together, or the best one alone
    across: tuple[tuple[str, float], ...]  # joint name -> share, by a function of its velocity
    follows: Follows
    motors: tuple[tuple[str, float], ...] = ()  # coupled motor, "5+6" -> share, of its velocity

    def share(self, coordinate: str) -> float:
        """Share of one coordinate; NaN where the logs do not hold it."""
        return dict(self.shares).get(coordinate, float("nan"))


def structure(prediction: Prediction, joint: int) -> Structure | None:
    """Structure of one joint's residual; None with fewer than ENOUGH samples."""
    rows = np.flatnonzero(prediction.used[:, joint])
    if rows.size < ENOUGH:
        return None
    rows = rows[:: -(-rows.size // _MOST)]
    e = prediction.measured[rows, joint] - prediction.predicted[rows, joint]
    names = [coordinate.id for coordinate in coordinates_of(prediction, joint)]
    m = _measured(prediction, joint, rows)
    sets = {name: _curve(prediction, joint, name, rows) for name in names if name not in DRIFTS}
    by = {joint: (*sets, *OWN)}
    for k in range(m.q.shape[1]):
        if k != joint:
            curves = curve(m.q[:, k]), friction_curve(m.v[:, k]), curve(m.a[:, k])
            sets |= {f"{name} {k}": x for name, x in zip(_ELSEWHERE, curves, strict=True)}
            by[k] = (str(k), *(f"{name} {k}" for name in _ELSEWHERE))
    for motor in prediction.motors:
        sets[motor.name] = friction_curve(m.v @ np.asarray(motor.coefficients))
    said = flexible(chain(sets.items(), functions(m)), e, stretches(prediction.run[rows]))
    alone = {name: said.alone.get(name, 0.0) for name in sets} | said.alone
    drifts = {name: _drift(prediction, joint, name, rows, e) for name in names if name in DRIFTS}
    joints = tuple(enumerate(info.name for info in prediction.joints))
    best = {k: max(alone.get(name, 0.0) for name in by[k]) for k, _ in joints}
    return Structure(
        shares=tuple((name, (alone | drifts)[name]) for name in names),
        together=best[joint],
        across=tuple((name, alone[by[k][2] if k != joint else "velocity"]) for k, name in joints),
        follows=_follows(said, best, by, prediction, joint),
        motors=tuple((motor.name, alone[motor.name]) for motor in prediction.motors),
    )


def _follows(
    said: Flexible, best: Mapping[int, float], by: Mapping[int, Sequence[str]],
    prediction: Prediction, joint: int,
) -> Follows:  # fmt: skip
    """The joint, and its coordinate, that does as well as everything."""
    enough = NEARLY * said.share
    if not said.sure:
        return Follows(0.0)
    place = max(best, key=lambda k: best[k])
    if best[place] < enough:
        return Follows(said.share)
    single = () if place == joint else zip(_ELSEWHERE, by[place][1:], strict=True)
    coordinates = [name for name, of in single if said.alone.get(of, 0.0) >= enough]
    return Follows(said.share, prediction.joints[place].name, next(iter(coordinates), ""))


def _measured(prediction: Prediction, joint: int, rows: np.ndarray) -> Measurements:
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


def _drift(prediction: Prediction, joint: int, name: str, rows: np.ndarray, e: np.ndarray) -> float:
    """Share by slow functions; of a temperature, what it adds to the direction of motion alone.

    Friction changes with temperature, gravity does not: another function for either direction.
    """
    blocks, folds = _DRIFT
    fold = (np.arange(e.size) * blocks // e.size) % folds
    values = coordinate_values(prediction, joint, name)[rows]
    if name == "time":
        columns = drift_curve(values, prediction.run[rows])
        return flexible([(name, columns)], e, fold).share
    way = np.sign(prediction.qd[rows, joint])[:, None]
    slow = curve(values, 5)
    both = (name, np.hstack((slow, slow * way))), ("direction", way)
    said = flexible(both, e, fold).alone
    return max(0.0, said.get(name, 0.0) - said.get("direction", 0.0))


def _curve(prediction: Prediction, joint: int, coordinate: str, rows: np.ndarray) -> np.ndarray:
    values = coordinate_values(prediction, joint, coordinate)[rows]
    if coordinate == "direction":
        return values[:, None]
    return friction_curve(values) if coordinate in ("velocity", "travel") else curve(values)


# The order spectrum of a joint's residual, seen before any filter takes the ripple away.


@dataclass(frozen=True)
class SpectralLine:
    """A wave that stands out."""

    waves: float  # per turn of a revolute joint, per m of a prismatic one
    amplitude: float  # N m or N
    share: float  # of the squared residual before filtering


def ripple(prediction: Prediction, joint: int) -> OrderSpectrum | None:
    """Of the samples that count, at full rate; None if they are few, or the joint rests."""
    full = full_rate(prediction)
    r, q = full.residual[:, joint], full.q[:, joint]
    counts = np.isfinite(r) & np.isfinite(q)
    if not counts.any():
        return None
    left = r[counts]
    return order_spectrum(
        q[counts], left - left.mean(), prediction.joints[joint].unit, float("inf")
    )


def waves(orders: OrderSpectrum, unit: str) -> tuple[np.ndarray, str]:
    """Orders of a spectrum as a user counts them, and per what.

    Args:
        orders: the spectrum.
        unit: of the joint's position, rad or m.
    """
    if unit == "rad":
        return orders.order, "turn"
    return orders.order / (2.0 * np.pi), "m"


def order_lines(orders: OrderSpectrum | None, unit: str) -> tuple[SpectralLine, ...]:
    """What stands out in an order spectrum, the strongest first; see `waves`."""
    if orders is None:
        return ()
    found, (counted, _) = orders, waves(orders, unit)
    places = [int(np.argmin(np.abs(found.order - order))) for order in found.peaks]
    return tuple(
        SpectralLine(
            waves=float(counted[k]),
            amplitude=float(found.amplitude[k]),
            share=0.5 * float(found.amplitude[k]) ** 2 / found.power,
        )
        for k in places
    )
