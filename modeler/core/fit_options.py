"""Options of a fit, declared once: for Python, `[fit]` of a robot file, and `modeler fit`."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, get_args

from modeler.core.choices import (
    ABOUT,
    APART,
    GAIN_METHOD,
    LOW_SPEED,
    TWO_STEPS,
    Derivatives,
    Method,
    ModelKind,
)

METHODS = (*get_args(Method), GAIN_METHOD, TWO_STEPS)
"""Ids of all estimators of `modeler fit`."""

PARALLEL_FILTER = "the one low-pass of torques and all columns"


def _about(help: str, unit: str = "", group: str = "processing") -> Mapping[str, str]:
    return {"help": help, "unit": unit, "group": group}


@dataclass(frozen=True)
class FitOptions:
    """Describes how a fit is made; None lets the fit choose from the logs.

    Every field is an option of `modeler fit` and an entry of `[fit]`; its metadata say what it
    means, in which unit.
    """

    method: str = field(
        default="weighted",
        metadata=_about(
            "; ".join(f"{about.id}: {about.title}" for about in (*ABOUT.values(), *APART)), group=""
        ),
    )
    model: ModelKind = field(
        default="torque",
        metadata=_about(
            "one equation a joint and sample, or the energy balance of windows (default "
            "%(default)s)",
            group="",
        ),
    )
    window: float | None = field(
        default=None,
        metadata=_about(
            "length of a window of --model energy; left out: the spacing of the torque model's "
            "rows",
            "S",
            "",
        ),
    )
    essential_below: float | None = field(
        default=None,
        metadata=_about(
            "keep in the reduced model what has a sigma below this share of its value (papers: "
            "15); left out: what an F-test misses",
            "PERCENT",
            "",
        ),
    )
    cutoff: float | None = field(
        default=None,
        metadata=_about("low-pass of the positions (zero phase, Butterworth order 4)", "HZ"),
    )
    parallel_cutoff: float | None = field(default=None, metadata=_about(PARALLEL_FILTER, "HZ"))
    decimate: int | None = field(default=None, metadata=_about("keep every N-th row after it", "N"))
    derivatives: Derivatives = field(
        default="auto",
        metadata=_about("logged velocities, or positions differentiated; auto: the quieter"),
    )
    low_speed: float = field(
        default=LOW_SPEED,
        metadata=_about(
            "leave out rows below this share of the joint's top speed, where the sign of the "
            "speed is doubtful",
            "SHARE",
        ),
    )
    keep_saturated: bool = field(
        default=False, metadata=_about("use rows whose torque is stuck at its limit")
    )
    keep_contradicted: bool = field(
        default=False,
        metadata=_about("use rows whose logged derivatives contradict the signals below them"),
    )
    keep_damaged: bool = field(
        default=False,
        metadata=_about(
            "use leaps, spikes and repeated values, which no robot can have made, as logged"
        ),
    )

    @classmethod
    def from_names(cls, values: Mapping[str, Any]) -> "FitOptions":
        """Returns the options among these values, by their names; others are ignored."""
        names = {each.name for each in fields(cls)}
        return cls(**{name: value for name, value in values.items() if name in names})
