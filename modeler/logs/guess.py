"""Whose column is which, guessed from names and ranges: lines for [log], to be checked."""

import dataclasses
import json
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from modeler.core.manifest import JointSpec
from modeler.logs.mapping import ANGLE, CURRENT, FORCE, LENGTH, TIME, TORQUE, Powers, find_unit
from modeler.logs.rates import RatePair, infer_units, pair_rates
from modeler.logs.thresholds import THRESHOLDS

_WORDS: Mapping[str, str] = {
    "time": "t time timestamp stamp clock zeit temps sec seconds",
    "temperature": "temp temperature temperatures heat",
    "current": "strom current currents cur i iq amp amps",
    "duty": "duty pwm",
    "tau": "tau torque torques drehmoment kraft trq effort moment moments load force f",
    "qdd": "qdd ddq acc accel acceleration accelerations",
    "qd": "qd dq qdot geschwindigkeit drehzahl vel velocity velocities speed speeds omega",
    "q": "q winkel pos position positions angle angles theta enc encoder x state",
}
_KIND_OF = {word: quantity for quantity, words in _WORDS.items() for word in words.split()}
_KINDS: Mapping[Powers, str] = {
    TIME: "time",
    ANGLE: "q",
    LENGTH: "q",
    (0, 0, -1, 1, 0, 0): "qd",
    (1, 0, -1, 0, 0, 0): "qd",
    TORQUE: "tau",
    FORCE: "tau",
    CURRENT: "current",
}
_ASKED = (
    "qc cmd cmds command commands commanded cmptd computed desired des target targets ref "
    "reference set setpoint setpoints goal action planned plan points nominal demand soll"
)
_MEASURED = "actual act measured meas feedback fbk ist"
_FALSE = "error errors err"  # of a controller: neither measured nor commanded
_QUANTITY = "q qd dq qdd ddq pos position vel velocity acc tau torque current joint axis"
_FUSED = re.compile(
    "(?:({0})({1})|({1})({0}))".format(
        _QUANTITY.replace(" ", "|"), "cmd|command|des|desired|target|ref|set|goal"
    )
)
"""What is commanded, in one word: `qdes`, `refpos`."""
_BESIDE = re.compile(r"\[([^\[\]]*)\{\}([^\[\]]*)\]")  # what stands beside a joint: `[{}.load]`
_LABEL = re.compile(r"\[([^\[\]]+)\]$|(\d+)(?!.*\d)|(?<=[ _.])([A-Z])$")
_UNIT = re.compile(r"\s+[\[(]([^\[\]()]+)[\])]$")
_SPLIT = re.compile(r"[^A-Za-zµ°]+|(?<=[a-z])(?=[A-Z])")
_WORD = re.compile(r"[A-Za-z\u00c0-\u024f]+")


@dataclass(frozen=True)
class Guess:
    """Columns that look like one quantity of all joints.

    Attributes:
        quantity: our name of it: "time", "q", "tau", ...
        template: name of the columns, "{}" for what distinguishes joints.
        labels: of the columns, in their order; ("",) without.
        units: of the columns, guessed or stated; "" for SI.
        why: why those units.
        others: columns with another unit in their names than the template has, by label.
    """

    quantity: str
    template: str
    labels: tuple[str, ...]
    units: tuple[str, ...] = ()
    why: str = ""
    others: Mapping[str, str] = dataclasses.field(default_factory=dict)

    @property
    def columns(self) -> tuple[str, ...]:
        """Returns the names of the columns in the file."""
        return tuple(self.others.get(x) or self.template.replace("{}", x) for x in self.labels)

    def drop_range_units(self) -> "Guess":
        """Returns the guess, without units that rest on a range."""
        if self.why != "by its range":
            return self
        return dataclasses.replace(self, units=("",) * len(self.labels), why="")


def guess_columns(
    columns: Mapping[str, np.ndarray],
    stated: Mapping[str, str],
    joints: Sequence[JointSpec] = (),
    names: Mapping[str, str] = MappingProxyType({}),
) -> list[Guess]:
    """Returns what the columns of a file look like; each of ours once.

    Args:
        columns: (n,) each, as in the file.
        stated: units that the file states, by column.
        joints: of the robot, if it is known.
        names: joint -> its name in logs, where that is known.
    """
    groups: dict[str, list[tuple[str, str, str]]] = {}
    worded = _split_by_words([name for name in columns if not split_label(name, names.values())[1]])
    for name in columns:
        template, label = worded.get(name) or split_label(name, names.values())
        groups.setdefault(_generalise_unit(template) if label else template, []).append(
            (template, label, name)
        )
    guesses, ranks = dict[str, Guess](), dict[str, tuple[int, int]]()
    by_duty = bool(joints) and any(joint.drive for joint in joints)
    for group in groups.values():
        template, *_ = Counter(each for each, _, _ in group).most_common(1)[0]
        labels, own_columns = [label for _, label, _ in group], [name for *_, name in group]
        others = {label: name for each, label, name in group if each != template}
        unit = find_unit(stated.get(own_columns[0]) or _find_unit_in_name(own_columns[0]) or "?")
        quantity = _guess_template_role(template) or (
            "" if unit is None else _KINDS.get(unit.powers, "")
        )
        words = _split_words(template)
        is_order = _is_commanded(words) or {*_FALSE.split()} & {*words}
        if quantity not in ("qc", "time") and is_order:
            quantity = "qc" if quantity == "q" and _is_commanded(words) else ""
        if by_duty and quantity == "tau" and re.search(r"load(?![a-z])", template.lower()):
            quantity = "duty"  # what such drives call their load is a share of the voltage
        if quantity == "time" and not all(_is_increasing(columns[name]) for name in own_columns):
            quantity = "tau" if template.lower().split()[:1] == ["t"] else ""
        if quantity and (
            quantity not in guesses or _rank_columns(quantity, template, labels) > ranks[quantity]
        ):
            ranks[quantity] = _rank_columns(quantity, template, labels)
            units = ("",) * len(labels)
            guesses[quantity] = Guess(quantity, template, tuple(labels), units, others=others)
    if "time" not in guesses:
        taken = {name for one in guesses.values() for name in one.columns}
        free = (name for name in columns if name not in taken)
        for name in free:
            steps = np.diff(columns[name])  # of a clock they are all about the same
            if len(steps) and np.isfinite(steps).all() and 0 < steps.max() < 3 * steps.min():
                guesses["time"] = Guess("time", name, ("",), ("",))
                break
    order = ("time", "q", "qd", "qdd", "qc", "tau", "current", "duty", "voltage", "temperature")
    known = [guesses[quantity] for quantity in order if quantity in guesses]
    rates = _compute_rates(guesses, columns, stated)
    slides = (flag_prismatic_columns(one.labels, joints, names) for one in known)
    return [
        _add_units(one, columns, stated, x, rates) for one, x in zip(known, slides, strict=True)
    ]


def flag_prismatic_columns(
    labels: Sequence[str],
    joints: Sequence[JointSpec],
    names: Mapping[str, str] = MappingProxyType({}),
) -> list[bool]:
    """Returns whether each column is of a prismatic joint; by name, else by its place."""
    named = bool(names) and {*names.values()} <= {*labels}
    by = {
        names[j.name] if named else j.name: j.unit == "m"
        for j in joints
        if not named or j.name in names
    }
    if not set(by) <= set(labels):
        by = {label: joint.unit == "m" for label, joint in zip(labels, joints, strict=False)}
    return [by.get(label, False) for label in labels]


def _compute_rates(
    guesses: Mapping[str, Guess], columns: Mapping[str, np.ndarray], stated: Mapping[str, str]
) -> dict[str, RatePair]:
    """Positions with the speed of their joint, by the name of the position."""
    if not {"time", "q", "qd"} <= set(guesses):
        return {}
    clock = guesses["time"].columns[0]
    time = columns[clock]
    named = (
        ""
        if clock in stated
        else _find_unit_in_name(clock)
        or _guess_unit_by_range("time", time[np.isfinite(time)], False)
    )
    unit = find_unit(named) if named else None
    time = time * (1.0 if unit is None else unit.factor)
    pairs = pair_rates(pair_speeds(guesses.values()), columns, time)
    return {pair.position: pair for pair in pairs}


def pair_speeds(guesses: Iterable[Guess]) -> list[tuple[str, str]]:
    """Returns columns of position and speed of the joints that have both."""
    by = {one.quantity: dict(zip(one.labels, one.columns, strict=True)) for one in guesses}
    positions, speeds = by.get("q", {}), by.get("qd", {})
    return [(q, speeds[label]) for label, q in positions.items() if label in speeds]


def split_label(name: str, joints: Iterable[str] = ()) -> tuple[str, str]:
    """Returns `pos[elbow]` -> `pos[{}]`, `elbow`; `joint3_pos` -> `joint{}_pos`, `3`.

    Names of joints that are known go before, the longest first: `elbow_effort` -> `{}_effort`.
    """
    for joint in sorted(joints, key=len, reverse=True):
        joint_match = re.search(rf"(?<![A-Za-z0-9]){re.escape(joint)}(?![A-Za-z0-9])", name)
        if joint_match is not None:
            return f"{name[: joint_match.start()]}{{}}{name[joint_match.end() :]}", joint
    end = _UNIT.search(name)
    head = name[: end.start()] if end is not None and find_unit(end[1]) is not None else name
    match = _LABEL.search(head)
    if match is None or head[: match.start()].strip() == "":
        return name, ""
    group = match.lastindex or 1
    return f"{name[: match.start(group)]}{{}}{name[match.end(group) :]}", match[group]


def _generalise_unit(template: str) -> str:
    """The template with the kind in place of the unit: `axis{} [deg]` and `axis{} [mm]` are one."""
    end = _UNIT.search(template)
    unit = None if end is None else find_unit(end[1])
    kind = "" if unit is None else _KINDS.get(unit.powers, "")
    return f"{template[: end.start()]} [{kind}]" if end and kind else template


def _split_by_words(names: Sequence[str]) -> dict[str, tuple[str, str]]:
    """Name -> template and label, of names of several joints: `elbow angle`, `shoulder angle`.

    The label is what stands before the word for the quantity, or after it.
    """
    groups: dict[str, dict[str, str]] = {}
    for name in names:
        end = _UNIT.search(name)
        head = name if end is None else name[: end.start()]
        for word in reversed([*_WORD.finditer(head)]):
            if _guess_template_role(word[0]):
                before, after = head[: word.start()].rstrip(" _.-"), head[word.end() :]
                label = before or after.strip(" _.-")
                if label and not any(c.isdigit() for c in label):
                    groups.setdefault(name.replace(label, "{}", 1), {})[name] = label
                break
    return {
        name: (template, label)
        for template, labels in groups.items()
        if len(labels) > 1
        for name, label in labels.items()
    }


def _guess_template_role(template: str) -> str:
    """What a template looks like, "" for nothing of ours; the last words say most.

    The bare name of a joint is its position.
    """
    if template == "{}":
        return "q"
    words = _split_words(template)
    if {*_FALSE.split()} & {*words}:
        return ""
    commanded = _is_commanded(words)
    for word in reversed(words):
        if quantity := _KIND_OF.get(word, ""):
            if commanded and quantity != "time":
                return "qc" if quantity == "q" else ""
            return quantity
    return "qc" if words and words[-1] in ("qc", "action") else ""


def _split_words(template: str) -> list[str]:
    """The words of a name, in lower case; of what stands in brackets, those beside a joint."""
    beside = _BESIDE.search(template)
    text = f"{template.split('[')[0]} {' '.join(beside.groups()) if beside else ''}"
    words = [word.lower() for word in _SPLIT.split(text) if word]
    fused = [_FUSED.fullmatch(word) for word in words]
    pairs = zip(words, fused, strict=True)
    parts = (filter(None, two.groups()) if two else (word,) for word, two in pairs)
    return [part for some in parts for part in some]


def _is_commanded(words: Sequence[str]) -> bool:
    """True of what a controller needs, not of what was measured: the last such word decides."""
    if words[1:] and words[-1] == "d":  # as libfranka calls what is desired: q_d, tau_J_d
        return True
    for word in reversed(words):
        if word in _MEASURED.split():
            return False
        if word in _ASKED.split():
            return True
    return False


def _rank_columns(quantity: str, template: str, labels: Sequence[str]) -> tuple[int, int]:
    """How well columns serve as a quantity: the clock of a header, of others the most joints.

    A name of two quantities, such as `TorqueCur`, comes after one of a single quantity.
    """
    words = _split_words(template)
    if quantity == "time":
        return int("header" in words), 0
    return len(labels), -len({_KIND_OF[word] for word in words if word in _KIND_OF})


def guess_role(name: str) -> str:
    """Returns what a column of that name looks like: "time", "q", "tau" ....

    "" for nothing of ours.
    """
    return _guess_template_role(split_label(name)[0])


def _is_increasing(values: np.ndarray) -> bool:
    """True of a column that goes up, as a time does, but for a few rows; not of a constant."""
    steps = np.diff(values[np.isfinite(values)])
    return bool(len(steps) == 0 or (np.mean(steps >= 0.0) > 0.9 and steps.any()))


def _add_units(
    one: Guess,
    columns: Mapping[str, np.ndarray],
    stated: Mapping[str, str],
    slides: Sequence[bool],
    rates: Mapping[str, RatePair],
) -> Guess:
    """The guess with its units: what names or the file say, else what speeds or ranges suggest."""
    stated_units = tuple(stated.get(name) or _find_unit_in_name(name) for name in one.columns)
    if any(stated_units):
        return dataclasses.replace(one, units=stated_units, why="stated")
    known = [columns[name][np.isfinite(columns[name])] for name in one.columns]
    pairs = zip(known, slides, strict=True)
    units = [_guess_unit_by_range(one.quantity, v, slide) for v, slide in pairs]
    if one.quantity == "q":
        triples = zip(one.columns, units, known, strict=True)
        units = [_choose_unit_by_rate(rates.get(name), unit, v) for name, unit, v in triples]
    pairs = zip(one.columns, slides, strict=True)
    is_position = one.quantity in ("q", "qc")
    free = [not (is_position and (slide or _is_settled(rates.get(name)))) for name, slide in pairs]
    units = _unify_units(units, free, slides)
    return dataclasses.replace(one, units=tuple(units), why="by its range" if any(units) else "")


def _is_settled(pair: RatePair | None) -> bool:
    """True if a speed says what its position is in."""
    return (
        pair is not None and bool(infer_units(pair.ratio)) and infer_units(pair.ratio) != ("", "")
    )


def _choose_unit_by_rate(pair: RatePair | None, unit: str, values: np.ndarray) -> str:
    """The unit of a position, where its speed decides; where it agrees, only a far way does."""
    units = None if pair is None else infer_units(pair.ratio)
    if units is None or unit in ("mm", "rev/COUNTS"):
        return unit
    if units == ("", ""):
        return unit if float(np.ptp(values)) > THRESHOLDS.max_agreeing_angle else ""
    return "" if units[0] == "rad" else units[0]


def _unify_units(units: Sequence[str], free: Sequence[bool], slides: Sequence[bool]) -> list[str]:
    """Columns that say nothing of their own follow the others, if most of them have one unit."""
    for unit in sorted(set(units) - {""}):
        if 2 * sum(u == unit for u in units) > sum(free):
            common_units = ["mN" if unit == "mN m" and s else unit for s in slides]
            parts = zip(units, common_units, free, strict=True)
            return [u or (o if f else "") for u, o, f in parts]
    return [*units]


def _find_unit_in_name(name: str) -> str:
    """A unit at the end of a name: `t [ms]`, `pos (deg)`, `Joint A [°]`, `speed_rpm`."""
    match = re.search(r"(\s?)[\[(]([^\[\]()]+)[\])]$|_([A-Za-z]+)\d*$", name)
    text = "" if match is None else (match[2] or match[3])
    sure = len(text) > 1 or text == "°" or (match is not None and match[1])
    return text if text and sure and find_unit(text) is not None else ""


def _guess_unit_by_range(quantity: str, values: np.ndarray, slides: bool) -> str:
    if not len(values):
        return ""
    span = float(np.ptp(values))
    if quantity == "time":
        step = float(np.median(np.diff(values))) if len(values) > 1 else 0.0
        return "" if step <= 0.2 else "ms" if step < 100 else "us" if step < 1e5 else "ns"
    if quantity in ("q", "qc"):
        if span > THRESHOLDS.min_count_span and (values == np.round(values)).all():
            return "rev/COUNTS"
        if slides:
            return "mm" if span > THRESHOLDS.max_axis_length else ""
        return "deg" if float(np.abs(values).max()) > THRESHOLDS.max_revolute_angle else ""
    if quantity == "tau":
        if span > (THRESHOLDS.max_force if slides else THRESHOLDS.max_torque):
            return "mN" if slides else "mN m"
        return ""
    if quantity == "duty":
        if span <= THRESHOLDS.max_duty_span:
            return ""
        return "%" if span <= 100.0 * THRESHOLDS.max_duty_span else "0.1 %"
    return "mA" if quantity == "current" and span > THRESHOLDS.max_current else ""


# The guesses as lines: a [log] to paste, units that are unlike SI, columns that are missing.


_MISSING = {"q": "positions", "tau": "torques"}


def find_absent_roles(guesses: Sequence[Guess]) -> list[str]:
    """Returns a line on the quantities that every fit needs and that no column looks like."""
    there = {"tau" if one.quantity in ("current", "duty") else one.quantity for one in guesses}
    lacking = [words for quantity, words in _MISSING.items() if quantity not in there]
    if not lacking:
        return []
    return [
        f"no columns look like {' or '.join(lacking)}: name them in [log] or with --map, such as "
        "--map 'q<j>=COLUMN{n}:deg' (several: {j}, {n} stand for the joint)"
    ]


def describe_non_si_columns(guesses: Sequence[Guess]) -> list[str]:
    """Returns columns whose range looks like another unit than SI, where nobody states one."""
    lines = []
    for one in (one for one in guesses if one.why == "by its range"):
        for unit in dict.fromkeys(filter(None, one.units)):
            unit_columns = [c for c, u in zip(one.columns, one.units, strict=True) if u == unit]
            every = len(unit_columns) == len(one.columns) > 1
            columns = one.template.replace("{}", "*") if every else ", ".join(unit_columns)
            what = "counts of an encoder" if unit == "rev/COUNTS" else unit
            looks = "looks" if every or len(unit_columns) == 1 else "look"
            looked = f"{columns} {looks} like {what}, by its range"
            lines.append(f"{looked}; say so in [log] or with --map")
    return lines


EITHER = "degrees, or -100..100 of each joint's calibrated range"
"""What a data set of LeRobot does not say of its positions."""


def describe_doubtful_degrees(
    guesses: Sequence[Guess], columns: Mapping[str, np.ndarray]
) -> list[str]:
    """Returns positions of LeRobot that look like degrees and never leave -100..100."""
    return [
        f"{one.template.replace('{}', '*')} may be {EITHER}: the data set does not say which; for "
        "the latter, one of 200 parts is (range_max - range_min) / 200 of a unit rev/4096"
        for one in guesses
        if one.quantity == "q"
        and one.template.startswith("observation.state")
        and "deg" in one.units
        and one.why == "by its range"
        and max(np.nanmax(np.abs(columns[name])) for name in one.columns)
        <= THRESHOLDS.max_normalised
    ]


def format_log_table(
    guesses: Sequence[Guess],
    joints: Sequence[JointSpec] = (),
    columns: Sequence[str] = (),
    names: Mapping[str, str] = MappingProxyType({}),
) -> str:
    """Returns the guesses as a table [log] to paste; "" if there are none, or all is ours already.

    Args:
        guesses: the guesses.
        joints: of the robot, if it is known.
        columns: of the file; listed if positions or torques are not among the guesses.
        names: joint -> its name in logs, where that is known.
    """
    count = max(len(one.labels) for one in guesses) if guesses else 0
    joint_names = [joint.name for joint in joints] or [str(k + 1) for k in range(count)]
    lines: list[str] = []
    for one in guesses:
        is_named = any(line.startswith("names =") for line in lines)
        lines += _format_lines(one, joint_names, is_named, names)
    if find_absent_roles(guesses):
        there = {one.quantity for one in guesses}
        listed = map(_quote_text, columns[: THRESHOLDS.max_listed_columns])
        lines.append(f"# columns of the file: {', '.join(listed)}")
        if "q" not in there:
            lines.append('# "q<j>" = "?"  # the position of each joint, such as "COLUMN{n} [deg]"')
        if not there & {"tau", "current", "duty"}:
            lines.append(
                '# "tau<j>" = "?"  # its torque, such as "COLUMN{n} [N m]"; or "current<j>"'
            )
    head = "[log]  # guessed from names and ranges: check every line"
    return "\n".join([head, *lines]) + "\n" if lines else ""


def _format_lines(
    one: Guess, joint_names: Sequence[str], named: bool, names: Mapping[str, str]
) -> list[str]:
    """The lines of one quantity: a pattern, and joints of another unit by themselves."""
    ours = all(c in (one.quantity, *(one.quantity + j for j in joint_names)) for c in one.columns)
    unit = one.units[0] if len(set(one.units)) == 1 else ""
    comment = "  # by its range" if one.why == "by its range" else ""
    lines: list[str] = []
    if one.quantity == "time" or one.labels == ("",):
        key = one.quantity if one.quantity == "time" else f"{one.quantity}{joint_names[0]}"
        if not ours or unit:
            lines.append(f"{_format_key(key)} = {_format_column(one.columns[0], unit)}{comment}")
        return lines
    known = bool(names) and {*names.values()} <= {*one.labels}
    mark = "{name}" if known else _choose_mark(one.labels, joint_names)
    if not ours or unit:
        if mark == "{name}" and not named:
            ordered = names.items() if known else zip(joint_names, one.labels, strict=False)
            pairs = ", ".join(f"{_format_key(j)} = {_quote_text(n)}" for j, n in ordered)
            comment = "" if known else "  # in the order of the log: which joint is which?"
            lines.append(f"names = {{{pairs}}}{comment}")
        pattern = one.template.replace("{}", mark)
        written = _quote_text(f"{pattern}{_format_unit(one.columns[0], unit)}")
        lines.append(f'"{one.quantity}<j>" = {written}{comment * bool(unit)}')
    if unit:
        return lines
    counted = [str(k + (mark == "{n}")) for k in range(len(joint_names))]
    called = [names.get(j, j) for j in joint_names] if known else one.labels
    labels = {"{j}": joint_names, "{name}": called}.get(mark, counted)
    by = dict(zip(one.labels, zip(one.columns, one.units, strict=True), strict=True))
    for joint, label in zip(joint_names, labels, strict=False):
        column, own_unit = by.get(label, ("", ""))
        if own_unit and (label in one.others or not one.others):
            key = _format_key(one.quantity + joint)
            lines.append(f"{key} = {_format_column(column, own_unit)}{comment}")
    return lines


def _format_column(name: str, unit: str) -> str:
    return _quote_text(f"{name}{_format_unit(name, unit)}")


def _format_key(name: str) -> str:
    """A bare key where TOML allows it."""
    return name if name.isascii() and name.isalnum() else _quote_text(name)


def _quote_text(text: str) -> str:
    """A text in TOML, whatever it holds."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _format_unit(column: str, unit: str) -> str:
    """The unit in brackets, unless the column's name has it already."""
    return "" if not unit or column.endswith(f" [{unit}]") else f" [{unit}]"


def _choose_mark(labels: Sequence[str], joint_names: Sequence[str]) -> str:
    """What stands for the label in a pattern."""
    if set(joint_names) <= set(labels):
        return "{j}"
    if all(label.isdigit() for label in labels):
        return "{n-1}" if "0" in labels else "{n}"
    return "{name}"
