"""The guesses as lines: a [log] to paste, units that are unlike SI, columns that are missing."""

import json
from collections.abc import Sequence

from modeler.core.contract import JointSpec
from modeler.logs.guess import Guess

_SHOWN = 24  # columns of a skeleton
_MISSING = {"q": "positions", "tau": "torques"}


def absent_roles(found: Sequence[Guess]) -> list[str]:
    """Quantities that every fit needs and that no column looks like."""
    there = {one.own for one in found} | (
        {"tau"} & {"tau" for one in found if one.own == "current"}
    )
    lacking = [words for own, words in _MISSING.items() if own not in there]
    if not lacking:
        return []
    return [
        f"no columns look like {' or '.join(lacking)}: name them in [log] or with --map, such as "
        "--map 'q<j>=COLUMN{n}:deg' (several: {j}, {n} stand for the joint)"
    ]


def unlike_si(found: Sequence[Guess]) -> list[str]:
    """Columns whose range looks like another unit than SI, where nobody states one."""
    lines = []
    for one in found:
        if one.why != "by its range":
            continue
        for unit in dict.fromkeys(filter(None, one.units)):
            own = [c for c, u in zip(one.columns, one.units, strict=True) if u == unit]
            every = len(own) == len(one.columns) > 1
            columns = one.template.replace("{}", "*") if every else ", ".join(own)
            what = "counts of an encoder" if unit == "rev/COUNTS" else unit
            looks = "looks" if every or len(own) == 1 else "look"
            lines.append(
                f"{columns} {looks} like {what}, by its range; say so in [log] or with --map"
            )
    return lines


def log_text(
    found: Sequence[Guess], joints: Sequence[JointSpec] = (), columns: Sequence[str] = ()
) -> str:
    """The guesses as a table [log] to paste; "" if there are none, or all is ours already.

    Args:
        found: the guesses.
        joints: of the robot, if it is known.
        columns: of the file; listed if positions or torques are not among the guesses.
    """
    count = max(len(one.labels) for one in found) if found else 0
    own = [joint.name for joint in joints] or [str(k + 1) for k in range(count)]
    lines: list[str] = []
    for one in found:
        lines += _lines_of(one, own, any(line.startswith("names =") for line in lines))
    if absent_roles(found):
        there = {one.own for one in found}
        lines.append(f"# columns of the file: {', '.join(map(_quoted, columns[:_SHOWN]))}")
        if "q" not in there:
            lines.append('# "q<j>" = "?"  # the position of each joint, such as "COLUMN{n} [deg]"')
        if not there & {"tau", "current"}:
            lines.append(
                '# "tau<j>" = "?"  # its torque, such as "COLUMN{n} [N m]"; or "current<j>"'
            )
    head = "[log]  # guessed from names and ranges: check every line"
    return "\n".join([head, *lines]) + "\n" if lines else ""


def _lines_of(one: Guess, own: Sequence[str], named: bool) -> list[str]:
    """The lines of one quantity: a pattern, and joints of another unit by themselves."""
    ours = all(c in (one.own, *(one.own + j for j in own)) for c in one.columns)
    unit = one.units[0] if len(set(one.units)) == 1 else ""
    told = "  # by its range" if one.why == "by its range" else ""
    lines: list[str] = []
    if one.own == "time" or one.labels == ("",):
        key = one.own if one.own == "time" else f"{one.own}{own[0]}"
        if not ours or unit:
            lines.append(f"{_key(key)} = {_column(one.columns[0], unit)}{told}")
        return lines
    mark = _mark(one.labels, own)
    if not ours or unit:
        if mark == "{name}" and not named:
            pairs = ", ".join(
                f"{_key(j)} = {_quoted(n)}" for j, n in zip(own, one.labels, strict=False)
            )
            lines.append(f"names = {{{pairs}}}  # in the order of the log: which joint is which?")
        pattern = one.template.replace("{}", mark)
        written = _quoted(f"{pattern}{_once(one.columns[0], unit)}")
        lines.append(f'"{one.own}<j>" = {written}{told * bool(unit)}')
    if not unit:
        lines += [
            f"{_key(one.own + joint)} = {_column(column, one_unit)}{told}"
            for joint, column, one_unit in _by_joint(one, own, mark)
            if one_unit
        ]
    return lines


def _by_joint(one: Guess, own: Sequence[str], mark: str) -> list[tuple[str, str, str]]:
    """Joint, column and unit of each column that a joint has."""
    if mark == "{j}":
        places = {joint: label for joint, label in zip(own, own, strict=True)}
    elif mark == "{name}":
        places = dict(zip(own, one.labels, strict=False))
    else:
        places = {j: str(k + (mark == "{n}")) for k, j in enumerate(own)}
    by = dict(zip(one.labels, zip(one.columns, one.units, strict=True), strict=True))
    return [(joint, *by[label]) for joint, label in places.items() if label in by]


def _column(name: str, unit: str) -> str:
    return _quoted(f"{name}{_once(name, unit)}")


def _key(name: str) -> str:
    """A bare key where TOML allows it."""
    return name if name.isascii() and name.isalnum() else _quoted(name)


def _quoted(text: str) -> str:
    """A text in TOML, whatever it holds."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _once(column: str, unit: str) -> str:
    """The unit in brackets, unless the column's name has it already."""
    return "" if not unit or column.endswith((f" [{unit}]",)) else f" [{unit}]"


def _mark(labels: Sequence[str], own: Sequence[str]) -> str:
    """What stands for the label in a pattern."""
    if set(own) <= set(labels):
        return "{j}"
    if all(label.isdigit() for label in labels):
        return "{n-1}" if "0" in labels else "{n}"
    return "{name}"
