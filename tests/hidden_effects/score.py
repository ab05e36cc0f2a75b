"""Is a diagnosis right? From the truth of a case and what was said of it, both as plain data.

What is "possible" is no name: it is no alarm, and nothing wrong. It counts as named first
only where it is listed first and nothing is named.
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from tests.hidden_effects.drives import NOISE
from tests.hidden_effects.held_out_effects import HELD_OUT_EFFECTS
from tests.hidden_effects.sensor_kinds import FINE, SENSORS

DETECTABLE = 0.25
"""Least visibility, in rms of the noise of the case: with less, the best that can be had on other
motion is an error that is 3 % smaller."""

Key = tuple[str, str | None]


@dataclass(frozen=True)
class Score:
    """One case.

    Attributes:
        case: name.
        hidden, said: effect and joint; what was hidden, and what was named, best first.
        noise: level.
        robot: kind.
        visible: of the effect that is hardest to see, in rms of the noise of the case; None if
            nothing is hidden or it was not computed.
        verdict: of the diagnosis.
        first: True if the first effect named is hidden, on its joint.
        joint: True if the first effect named is on a joint where one is hidden.
        tied: True if the first effect named or one it is tied with is hidden.
        found: how many of the hidden effects are named.
        spurious: how many effects are named that are not hidden.
        fall: of the held-out error by the first effect, as a share; None without.
        seconds: of the diagnosis.
        error: why there is none; empty if there is.
        withheld: True if what is hidden was not to be named.
        maybe: what was said to be possibly missing, and no more.
        facts: what was stated as a fact.
        wrong: those of them that are none.
        sensor: kind.
        told: True if what is wrong with the log is reported, in words or by name; None if nothing
            is.
    """

    case: str
    hidden: tuple[Key, ...]
    said: tuple[Key, ...]
    noise: str
    robot: str
    visible: float | None
    verdict: str
    first: bool
    joint: bool
    tied: bool
    found: int
    spurious: int
    fall: float | None
    seconds: float
    error: str = ""
    withheld: bool = False
    maybe: tuple[Key, ...] = ()
    facts: tuple[Key, ...] = ()
    wrong: tuple[Key, ...] = ()
    sensor: str = FINE
    told: bool | None = None

    @property
    def held_out(self) -> bool:
        """True if what is hidden is in nobody's catalogue."""
        return any(effect in HELD_OUT_EFFECTS for effect, _ in self.hidden)

    @property
    def stated(self) -> bool:
        """True if the first effect named is stated as the cause."""
        return self.verdict == "missing"

    @property
    def false(self) -> bool:
        """True if something is stated as the cause, or as a fact, that is not there.

        A statement that leaves open which of several it is, the true one among them, is not false.
        """
        return bool(self.wrong) or (self.stated and not self.tied and self.spurious > 0)

    @property
    def exact(self) -> bool:
        """True if all that is hidden is named, and nothing else."""
        return not self.error and self.found == len(self.hidden) and not self.spurious

    @property
    def right(self) -> bool:
        """One effect: named first; withheld, or in no catalogue: none stated. None or two: exact.

        A log that is wrong: reported, and nothing named that is not there.
        """
        if self.withheld or self.held_out:
            return not self.error and not self.stated
        if self.told is not None:
            return self.told and not self.spurious
        return self.first if len(self.hidden) == 1 else self.exact

    @property
    def detectable(self) -> bool:
        """False if the case is too hard for anybody."""
        return self.visible is None or self.visible >= DETECTABLE

    @property
    def effects(self) -> str:
        """Names of what is hidden."""
        return " + ".join(effect for effect, _ in self.hidden) or "none"

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)


def score_from_json(data: Mapping[str, Any]) -> Score:
    """What `to_json` gave."""
    names = ("hidden", "said", "maybe", "facts", "wrong")
    keys = {name: tuple((e, j) for e, j in data.get(name, ())) for name in names}
    return Score(**{**data, **keys})


def scored(case, truth, said, withheld=False):
    """A diagnosis (`to_json`) against the truth of its case (`truth.json`)."""
    hidden, findings = truth["hidden"], said["effects"]
    by_status = {
        status: [_key(f) for f in findings if f.get("status", "likely") in kinds]
        for status, kinds in STATUS.items()
    }
    named, facts = by_status["likely"], by_status["confirmed"]
    listed = findings[0] if findings else None  # those that are only possible come last
    first = [_key(f) for f in findings[:1]]
    tied = [*first, *map(_key, listed["ties"])] if listed else []
    visible = min(truth["visible"], default=None)
    sensor = truth.get("sensor", {"kind": FINE})
    blamed = _blamed(sensor, findings)
    true = [*hidden, *blamed]
    return Score(
        case=case,
        hidden=tuple(_key(effect) for effect in hidden),
        said=tuple(named),
        noise=truth["noise"],
        robot=truth["robot"],
        visible=None if visible is None else visible * NOISE["med"] / NOISE[truth["noise"]],
        verdict=said["verdict"],
        first=any(is_it(effect, key) for effect in hidden for key in first),
        joint=any(key[1] in joints(effect) for effect in hidden for key in first),
        tied=any(is_it(effect, key) for effect in hidden for key in tied),
        found=sum(any(is_it(effect, key) for key in named) for effect in hidden),
        spurious=len(_not_of(true, named)),
        fall=_fall(listed),
        seconds=said["seconds"],
        withheld=withheld,
        maybe=tuple(by_status["possible"]),
        facts=tuple(facts),
        wrong=tuple(_not_of(true, facts)),
        sensor=sensor["kind"],
        told=_told(sensor, said, blamed, named),
    )


STATUS = {"likely": ("confirmed", "likely"), "confirmed": ("confirmed",), "possible": ("possible",)}


def _not_of(true: Sequence[Mapping[str, Any]], keys: Sequence[Key]) -> list[Key]:
    return [key for key in keys if not any(is_it(effect, key) for effect in true)]


def _blamed(sensor, findings):
    """Names that are true on account of the sensor: its joint's, or one that is tied with that."""
    names, where = SENSORS[sensor["kind"]].names, (sensor.get("joint"), None)
    values = []
    for finding in findings:
        keys = [_key(finding), *map(_key, finding["ties"])]
        if any(effect in names and joint in where for effect, joint in keys):
            values.append({"effect": finding["effect"], "joint": finding["joint"], "values": {}})
    return values


def _told(sensor, said, blamed, named):
    """Whether a line on the data, or a name, shows what is wrong with the log."""
    words, joint = SENSORS[sensor["kind"]].words, sensor.get("joint")
    if not words:
        return None
    lines = [row for row in said.get("data_warnings", ()) if not joint or f"joint {joint}" in row]
    by_name = any(is_it(effect, key) for effect in blamed for key in named)
    return by_name or any(word in row for word in words for row in lines)


def failed(case: str, truth: Mapping[str, Any], error: str, withheld: bool = False) -> Score:
    """A case whose diagnosis ended in an error."""
    nothing = {"effects": [], "verdict": "error", "seconds": 0.0, "data": [error]}
    data = scored(case, truth, nothing, withheld).to_json()
    return score_from_json(data | {"error": error})


def joints(effect: Mapping[str, Any]) -> Sequence[str | None]:
    """Where a hidden effect may be named; friction between two joints on either."""
    other = effect["values"].get("with_joint")
    return [effect["joint"]] if other is None else [effect["joint"], other]


def is_it(effect: Mapping[str, Any], key: Key) -> bool:
    """True if this names a hidden effect."""
    return key[0] == effect["effect"] and key[1] in joints(effect)


def _key(data: Mapping[str, Any]) -> Key:
    return data["effect"], data["joint"]


def _fall(first: Mapping[str, Any] | None) -> float | None:
    if first is None or not first["error_before"] or first["error_after"] is None:
        return None
    return 1 - first["error_after"] / first["error_before"]
