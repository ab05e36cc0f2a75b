"""Physics that the simulated machine has and the robot file lacks, as it is asked for."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from modeler.core.errors import DataError

_FORM = "EFFECT, EFFECT@JOINT or EFFECT@JOINT:name=value,..., as in stribeck@2:extra=3"


@dataclass(frozen=True)
class HiddenEffect:
    """One effect that the robot file does not know of.

    Attributes:
        effect: id.
        joint: name of the joint or link; None for an effect of the whole machine, and, where one
            is asked for, for a joint that is drawn.
        values: physical parameters by name, SI; those left out are drawn.
    """

    effect: str
    joint: str | None = None
    values: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))


def hidden_from_text(text: str) -> HiddenEffect:
    """The effect that a user writes as "stribeck", "stribeck@2" or "stribeck@2:extra=3,speed=0.1".

    Raises:
        DataError: the text has another form, or a value is no number.
    """
    place, colon, listed = text.partition(":")
    effect, at, joint = place.partition("@")
    if not effect or (at and not joint) or (colon and not listed):
        raise DataError(f"hidden effect: got {text!r}; expected {_FORM}")
    values: dict[str, float] = {}
    for entry in listed.split(",") if colon else []:
        name, equals, number = (part.strip() for part in entry.partition("="))
        if not (name and equals) or name in values:
            raise DataError(
                f"hidden effect {text!r}: got {entry!r}; expected each value once as name=value"
            )
        values[name] = _number(text, name, number)
    return HiddenEffect(effect.strip(), joint.strip() or None, values)


def _number(text: str, name: str, number: str) -> float:
    try:
        value = float(number)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise DataError(f"hidden effect {text!r}, {name}: got {number!r}; expected a number")
    return value
