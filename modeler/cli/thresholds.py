"""The numbers that decide in `modeler.cli`: unit, reason and source of each."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Holds all limits, counts and delays of the package."""

    clock_interval: float = 0.5
    """s between updates of the time that the console shows while a command runs."""
    progress_interval: float = 0.1
    """s at least between two lines of progress."""
    max_listed_coefficients: int = 200
    """Coefficients up to which all are listed; of more, the independent ones."""
    max_unrequested_coefficients: int = 40
    """Coefficients that are listed without --terms: a page."""
    interrupt_patience: float = 3.0
    """s from the interrupt to the end by force."""
    curve_points: int = 366
    """Points at which the curve of an effect is computed for `modeler` lists."""
    max_unremarked_error: float = 0.2
    """Relative error of a fit above which `modeler log` warns; no study."""
    listed_sets: int = 10
    """Sets of known parameters that are printed."""
    listed_joints: int = 6
    """Joints by which an assembly mode is printed."""


THRESHOLDS = Thresholds()
