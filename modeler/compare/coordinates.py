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
    Coordinate("time", "time", "time (slow drift)"),
)


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
        "time": "s",
    }[coordinate]
