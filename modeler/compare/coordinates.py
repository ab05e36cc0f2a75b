"""The coordinates against which a residual is looked at."""

from dataclasses import dataclass

import numpy as np

from modeler.compare.prediction import Prediction


@dataclass(frozen=True)
class Coordinate:
    """One way to look at a residual: id, axis label, and how a sentence names it."""

    id: str
    label: str
    phrase: str  # "41 % of that is a repeatable function of <phrase>"


# In the order in which a simpler explanation is preferred to one that is hardly better.
COORDINATES = (
    Coordinate("direction", "direction of motion", "the direction of motion alone"),
    Coordinate("velocity", "velocity", "velocity"),
    Coordinate("position", "position", "position"),
    Coordinate("acceleration", "acceleration", "acceleration"),
    Coordinate("load", "|predicted| x direction of motion", "load and direction of motion"),
    Coordinate("travel", "travel x direction of motion", "travel since the last reversal"),
    Coordinate("temperature", "temperature", "temperature"),
    Coordinate("time", "time", "time (slow drift)"),
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
    if coordinate == "direction":
        return np.sign(qd)
    if coordinate == "velocity":
        return qd
    if coordinate == "position":
        return prediction.q[:, joint]
    if coordinate == "acceleration":
        return prediction.qdd[:, joint]
    if coordinate == "load":
        return np.abs(prediction.predicted[:, joint]) * np.sign(qd)
    if coordinate == "travel":
        assert prediction.travel is not None
        return prediction.travel[:, joint] * np.sign(qd)
    if coordinate == "temperature":
        assert prediction.temperature is not None
        return prediction.temperature[:, joint]
    assert coordinate == "time", coordinate
    starts = [prediction.time[prediction.run == run] for run in range(len(prediction.logs))]
    first = np.array([times[0] if times.size else 0.0 for times in starts])
    return prediction.time - first[prediction.run]


def coordinate_unit(prediction: Prediction, joint: int, coordinate: str) -> str:
    """Unit of a coordinate as it stands on an axis."""
    info = prediction.joints[joint]
    return {
        "direction": "-",
        "velocity": f"{info.unit}/s",
        "position": info.unit,
        "acceleration": f"{info.unit}/s^2",
        "load": info.effort_unit,
        "travel": info.unit,
        "temperature": "as logged",
        "time": "s",
    }[coordinate]
