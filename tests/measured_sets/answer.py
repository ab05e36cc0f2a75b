"""What was said of a case, as plain data that a file holds."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from tests.measured_sets.sets import Case

Key = tuple[str, str | None]
"""Effect and joint; the joint of an effect of the whole robot is None."""


@dataclass(frozen=True)
class Answer:
    """One case.

    Attributes:
        case: the question.
        said: the diagnosis as `--json` gives it; or what `add auto` did.
        seconds: of each part.
        faults: of the values that are stated.
        error: why there is no answer; empty if there is.
    """

    case: Case
    said: Mapping[str, Any]
    seconds: Mapping[str, float] = field(default_factory=dict)
    faults: tuple[str, ...] = ()
    error: str = ""

    @property
    def verdict(self) -> str:
        """Of the diagnosis."""
        return "error" if self.error else str(self.said["verdict"])

    @property
    def stated(self) -> Key | None:
        """What is stated as the cause; None if nothing is."""
        return self.first if self.verdict == "missing" else None

    @property
    def first(self) -> Key | None:
        """What is named first, with a warning or without; None if nothing is."""
        effects = self.said.get("effects")
        return key(effects[0]) if effects else None

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)


def answer_from_json(data: Mapping[str, Any]) -> Answer:
    """What `to_json` gave."""
    return Answer(**{**data, "case": Case(**data["case"]), "faults": tuple(data["faults"])})


def key(finding: Mapping[str, Any]) -> Key:
    """Effect and joint of a finding."""
    return finding["effect"], finding["joint"]


def named(pair: Key) -> str:
    """As in "spring@2"."""
    return pair[0] if pair[1] is None else f"{pair[0]}@{pair[1]}"
