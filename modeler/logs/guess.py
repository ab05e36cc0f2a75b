"""Whose column is which, guessed from names and ranges: lines for [log], to be checked."""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.contract import JointSpec
from modeler.logs.units import find_unit


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_WORDS: Mapping[str, frozenset[str]] = {
    "time": _words("t time timestamp stamp clock zeit temps sec seconds"),
    "temperature": _words("temp temperature temperatures heat"),
    "current": _words("current currents cur i iq amp amps"),
    "tau": _words("tau torque torques trq effort moment moments load force f"),
    "qdd": _words("qdd ddq acc accel acceleration accelerations"),
    "qd": _words("qd dq qdot vel velocity velocities speed speeds omega"),
    "q": _words("q pos position positions angle angles theta enc encoder x"),
}
_ASKED = _words("qc cmd command commanded desired des target ref reference set setpoint")
_LABEL = re.compile(r"\[([^\[\]]+)\]$|(\d+)(?!.*\d)")
_SPLIT = re.compile(r"[^A-Za-zµ°]+|(?<=[a-z])(?=[A-Z])")
_COUNTS = 5000.0  # span of whole numbers from which on a position is in counts
_TURNS = 7.0  # rad; a joint that goes further in either way is likely in degrees
_LONG = 3.0  # m; an axis that is longer is likely in mm
_STRONG = 200.0  # A
_HEAVY = 1e4  # N m

RATES: Mapping[str, float] = {
    "rad/s": 1.0, "deg/s": np.pi / 180.0, "rpm": np.pi / 30.0, "rev/s": 2.0 * np.pi,
}  # fmt: skip
"""Units of speeds of revolute joints, in rad/s."""


@dataclass(frozen=True)
class Guess:
    """Columns that look like one quantity of all joints.

    Attributes:
        own: our name of it: "time", "q", "tau", ...
        template: name of the columns, "{}" for what tells joints apart.
        labels: of the columns, in their order; ("",) without.
        unit: guessed or stated; "" for SI.
        why: why that unit.
    """

    own: str
    template: str
    labels: tuple[str, ...]
    unit: str = ""
    why: str = ""

    @property
    def columns(self) -> tuple[str, ...]:
        """Names in the file."""
        return tuple(self.template.replace("{}", label) for label in self.labels)


def guesses(
    columns: Mapping[str, np.ndarray], stated: Mapping[str, str], joints: Sequence[JointSpec] = ()
) -> list[Guess]:
    """What the columns of a file look like; each of ours once.

    Args:
        columns: (n,) each, as in the file.
        stated: units that the file states, by column.
        joints: of the robot, if it is known.
    """
    groups: dict[str, list[str]] = {}
    for name in columns:
        template, label = template_of(name)
        groups.setdefault(template, []).append(label)
    found: dict[str, Guess] = {}
    for template, labels in groups.items():
        own = _role(template)
        better = own in found and len(labels) > len(found[own].labels)
        if own and (own not in found or better):
            found[own] = Guess(own, template, tuple(labels))
    if "time" not in found:
        clock = next((name for name, v in columns.items() if _steady(v)), None)
        if clock is not None:
            found["time"] = Guess("time", clock, ("",))
    order = ("time", "q", "qd", "qdd", "qc", "tau", "current", "temperature")
    known = [found[own] for own in order if own in found]
    slides = bool(joints) and all(joint.unit == "m" for joint in joints)
    return [_with_unit(one, columns, stated, slides) for one in known]


def template_of(name: str) -> tuple[str, str]:
    """`pos[elbow]` -> `pos[{}]`, `elbow`; `joint3_pos` -> `joint{}_pos`, `3`."""
    match = _LABEL.search(name)
    if match is None:
        return name, ""
    place = match.start(1) if match[1] else match.start(2)
    label = match[1] or match[2]
    return f"{name[:place]}{{}}{name[place + len(label) :]}", label


def _role(template: str) -> str:
    """What a template looks like, "" for nothing of ours; the last words say most."""
    words = [word.lower() for word in _SPLIT.split(template.split("[")[0]) if word]
    asked = any(word in _ASKED for word in words)
    for word in reversed(words):
        for own, names in _WORDS.items():
            if word in names:
                return ("qc" if own == "q" else "") if asked and own != "time" else own
    return "qc" if words and words[-1] == "qc" else ""


def _steady(values: np.ndarray) -> bool:
    """True of a column that grows by about the same in every row."""
    steps = np.diff(values)
    return bool(len(steps) and np.isfinite(steps).all() and 0 < steps.max() < 3 * steps.min())


def _with_unit(
    one: Guess, columns: Mapping[str, np.ndarray], stated: Mapping[str, str], slides: bool
) -> Guess:
    """The guess with its unit: what the name or the file says, else what the range suggests."""
    for name in one.columns:
        text = stated.get(name) or _named(name)
        if text:
            return Guess(one.own, one.template, one.labels, text, "stated")
    values = [v for name in one.columns if len(v := columns[name][np.isfinite(columns[name])])]
    if not values:
        return one
    text = _ranged(one.own, values, slides)
    return Guess(one.own, one.template, one.labels, text, "by its range" if text else "")


def _named(name: str) -> str:
    """A unit at the end of a name: `t [ms]`, `pos (deg)`, `speed_rpm`."""
    match = re.search(r"[\[(]([^\[\]()]+)[\])]$|_([A-Za-z]+)\d*$", name)
    text = "" if match is None else (match[1] or match[2])
    return text if len(text) > 1 and find_unit(text) is not None else ""


def _ranged(own: str, values: Sequence[np.ndarray], slides: bool) -> str:
    span = max(float(np.ptp(v)) for v in values)
    if own == "time":
        step = float(np.median(np.diff(values[0])))
        return "" if step <= 0.2 else "ms" if step < 100 else "us" if step < 1e5 else "ns"
    if own in ("q", "qc"):
        if span > _COUNTS and all((v == np.round(v)).all() for v in values):
            return "rev/COUNTS"
        if slides:
            return "mm" if span > _LONG else ""
        return "deg" if max(float(np.abs(v).max()) for v in values) > _TURNS else ""
    if own == "tau":
        return "mN m" if span > _HEAVY and not slides else ""
    return "mA" if own == "current" and span > _STRONG else ""


def log_text(found: Sequence[Guess], joints: Sequence[JointSpec] = ()) -> str:
    """The guesses as a table [log] to paste; "" if there are none, or all is ours already."""
    count = max(len(one.labels) for one in found) if found else 0
    own = [joint.name for joint in joints] or [str(k + 1) for k in range(count)]
    lines, named = ["[log]  # guessed from names and ranges: check every line"], False
    for one in found:
        unit = f" [{one.unit}]" if one.unit else ""
        if not unit and all(c in (one.own, *(one.own + j for j in own)) for c in one.columns):
            continue  # ours already
        told = f"  # {one.why}" if one.why == "by its range" else ""
        if one.own == "time" or one.labels == ("",):
            key = one.own if one.own == "time" else f"{one.own}{own[0]}"
            written = _quoted(f"{one.columns[0]}{_once(one.columns[0], unit)}")
            lines.append(f"{key} = {written}{told}")
            continue
        mark = _mark(one.labels, own)
        if mark == "{name}" and not named:
            pairs = ", ".join(
                f"{_quoted(j) if not j.isalnum() else j} = {_quoted(n)}"
                for j, n in zip(own, one.labels, strict=False)
            )
            lines.append(f"names = {{{pairs}}}  # in the order of the log: which joint is which?")
            named = True
        column = one.template.replace("{}", mark)
        written = _quoted(f"{column}{_once(one.columns[0], unit)}")
        lines.append(f'"{one.own}<j>" = {written}{told}')
    return "\n".join(lines) + "\n" if len(lines) > 1 else ""


def _quoted(text: str) -> str:
    """A text in TOML, whatever it holds."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _once(column: str, unit: str) -> str:
    """The unit, unless the column's name ends in it already."""
    return "" if column.endswith(unit) else unit


def _mark(labels: Sequence[str], own: Sequence[str]) -> str:
    """What stands for the label in a pattern."""
    if set(own) <= set(labels):
        return "{j}"
    if all(label.isdigit() for label in labels):
        return "{n-1}" if "0" in labels else "{n}"
    return "{name}"
