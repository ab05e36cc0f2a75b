"""How logs become rows of y = W beta: every number that may be chosen."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, get_args

from modeler.core.brief import ShortRepr
from modeler.core.choices import LOW_SPEED, Derivatives
from modeler.core.errors import DataError


@dataclass(frozen=True)
class Processing(ShortRepr):
    """Choices of the processing; None is chosen from the logs and stated in the report.

    Attributes:
        position_cutoff: low-pass of measured positions before they are differentiated, Hz;
            zero-phase Butterworth, order 4, forwards and backwards. 0: none.
        parallel_cutoff: the one low-pass that y and all columns of W go through alike, Hz at
            -3 dB. 0: none.
        decimation: samples per row after the parallel filter; None: rows at 2.5 times
            `parallel_cutoff`, where neighbouring rows are all but independent.
        derivatives: "log" takes logged qd (and qdd); "position" differentiates q; "auto" takes
            what is logged.
        low_speed: rows below this fraction of a shaft's top speed are left out where the shaft
            has dry friction: sign(qd) means nothing there.
        speed_floors: those speeds, rad/s or m/s, by shaft; None: `low_speed` times the top speed
            over the logs.
        keep_saturated: use rows whose torque is stuck at the drive's limit.
        keep_contradicted: use samples whose logged qd or qdd is not the derivative of q or qd,
            and do not refuse columns that are wrong throughout.
        keep_damaged: use values that no robot can have made (leaps, spikes, repeated positions) as
            they were logged.
        repairs: held-out error of a fit to a mended log over that to the log as it is, by log,
            column and kind of the defect; None: not tried yet.
        delay: s by which torques are logged before the motion that they belong to; they are moved
            later by it.
        edge: seconds left out at both ends of a differentiated piece; None: 2.5 periods of
            `position_cutoff`, where the filter's start-up has faded below 1 %.
        chosen: names of the cut-offs that were chosen from the logs; what is given rules all that
            is made of a model.
    """

    position_cutoff: float | None = None
    parallel_cutoff: float | None = None
    decimation: int | None = None
    derivatives: Derivatives = "auto"
    low_speed: float = LOW_SPEED
    speed_floors: Mapping[str, float] | None = None
    keep_saturated: bool = False
    edge: float | None = None
    keep_contradicted: bool = False
    keep_damaged: bool = False
    delay: float = 0.0
    chosen: tuple[str, ...] = ()
    repairs: Mapping[str, float] | None = None

    def __post_init__(self) -> None:
        for name in ("position_cutoff", "parallel_cutoff", "edge", "low_speed"):
            value = getattr(self, name)
            if value is not None and not (_is_number(value) and 0.0 <= value < float("inf")):
                raise DataError(f"{name} is {value}; expected a number that is not negative")
        if not (_is_number(self.delay) and abs(self.delay) < 1.0):
            raise DataError(f"delay is {self.delay}; expected less than 1 s either way")
        if self.low_speed >= 1.0:
            raise DataError(f"low_speed is {self.low_speed}; expected a fraction below 1")
        if self.decimation is not None and not (
            isinstance(self.decimation, int) and self.decimation >= 1
        ):
            raise DataError(f"decimation is {self.decimation}; expected a whole number from 1")
        if not isinstance(self.speed_floors, Mapping | None):
            raise DataError(
                f"speed_floors is {self.speed_floors}; expected a speed by joint, as in "
                '{"1": 0.1}'
            )
        if not isinstance(self.repairs, Mapping | None):
            raise DataError(f"repairs is {self.repairs}; expected a ratio by column and defect")
        if self.derivatives not in get_args(Derivatives):
            raise DataError(
                f'derivatives is "{self.derivatives}"; expected {", ".join(get_args(Derivatives))}'
            )

    def repairs_of(self, log: str) -> dict[str, float]:
        """Those of a log, by column and kind of the defect; a channel is held in all alike."""
        return {
            key.rpartition(": ")[2]: score
            for key, score in (self.repairs or {}).items()
            if key.startswith(f"{log}: ") or key.endswith(" held")
        }

    def to_json(self) -> dict[str, Any]:
        """Plain data for a model file."""
        raw = dataclasses.asdict(self)
        if self.speed_floors is not None:  # JSON has no infinity: null is a shaft that stood still
            raw["speed_floors"] = {
                name: None if floor == float("inf") else floor
                for name, floor in self.speed_floors.items()
            }
        return raw


@dataclass(frozen=True)
class ChosenProcessing(Processing):
    """A processing with every choice made: both cut-offs, and the speed floors of all shafts."""

    position_cutoff: float = 0.0
    parallel_cutoff: float = 0.0
    speed_floors: Mapping[str, float] = field(default_factory=dict)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def read_processing(raw: Mapping[str, Any]) -> Processing:
    """Read `Processing.to_json` back.

    Raises:
        DataError: an unknown or impossible entry.
    """
    names = sorted(entry.name for entry in dataclasses.fields(Processing))
    unknown = sorted(set(raw) - set(names))
    if unknown:
        raise DataError(f"processing has no setting {unknown[0]}; there are {', '.join(names)}")
    values = dict(raw)
    choices = ("position_cutoff", "parallel_cutoff", "speed_floors")
    open_ = any(values.get(name) is None for name in choices)
    try:
        values["chosen"] = tuple(str(name) for name in values.get("chosen", ()))
        if values.get("speed_floors") is not None:
            values["speed_floors"] = {
                name: float("inf") if floor is None else float(floor)
                for name, floor in values["speed_floors"].items()
            }
        return Processing(**values) if open_ else ChosenProcessing(**values)
    except (TypeError, ValueError, AttributeError) as error:
        raise DataError(f"processing: {error}; expected numbers") from None
