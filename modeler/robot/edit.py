"""Edits of a robot file: effects, parameters, limits, home, and nothing else in it."""

import json
import math
import re
import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

from modeler.core.brief import ShortRepr
from modeler.core.errors import RobotError
from modeler.core.toml_cells import TomlCell, format_toml, format_toml_key, join_names, suggest_name
from modeler.effects import (
    CATALOGUE,
    EXAMPLE,
    PASSIVE_FRICTION,
    PASSIVE_FRICTION_IS,
    Effect,
    NonlinearParameter,
    find_effect,
)
from modeler.robot.cells import format_pi_multiple
from modeler.robot.effects import collect_parameter_owners, read_own_effects
from modeler.robot.mechanism import MARK, expand_legs, read_leg_names
from modeler.robot.read import parse_robot_text, parse_toml_document, read_file_text
from modeler.robot.robot import INERTIAL, Robot
from modeler.robot.thresholds import THRESHOLDS

Effects = Mapping[str, str | list]
"""Effect id or alias -> "all", the names of the joints that have it, or tables with shapes."""


def insert_effect(
    text: str, effect: str, joint: str, shapes: Mapping[str, float], everyone: Sequence[str] = ()
) -> str:
    """Returns the robot file with an effect on one joint more.

    Args:
        text: of the file.
        effect: id.
        joint: name.
        shapes: of the effect there.
        everyone: the joints that "all" means.

    Raises:
        RobotError: see `replace_effects`.
    """
    effects: dict[str, str | list] = dict(tomllib.loads(text).get("effects", {}))
    known = find_effect(effect, _read_catalogue(text))
    assert known is not None
    ids = (known.id, *known.aliases)
    name = next((n for n in effects if n in ids), effect)
    before = effects.get(name, [])
    entry = {"joint": joint, **{k: float(f"{v:.6g}") for k, v in shapes.items()}}
    if before == "all" and joint not in everyone and everyone:
        before = list(everyone)
    if before == "all":
        raise RobotError(f"[effects], {effect}: every joint has it already")
    if joint in before:
        raise RobotError(f"[effects], {effect}: joint {joint} has it already")
    if shapes:  # tables and names do not mix
        before = [{"joint": b} if isinstance(b, str) else b for b in before]
    effects[name] = [*before, entry if shapes else joint]
    return replace_effects(text, effects)


def insert_own_effect(text: str, name: str, definition: Mapping[str, Any]) -> str:
    """Returns the robot file with the definition of one effect more.

    Args:
        text: of the file.
        name: id of the effect.
        definition: its table, as in [own_effects.<id>].

    Raises:
        RobotError: the file defines it already.
    """
    if name in tomllib.loads(text).get("own_effects", {}):
        raise RobotError(f"[own_effects.{name}]: the robot has it already; choose another name")
    lines = [f"{format_toml_key(key)} = {format_toml(value)}" for key, value in definition.items()]
    return _append_table([text], f"[own_effects.{format_toml_key(name)}]", *lines)


def _read_catalogue(text: str) -> tuple[Effect, ...]:
    """The effects that the robot of the file may have."""
    definitions = tomllib.loads(text).get("own_effects", {})
    return (*CATALOGUE, *read_own_effects(definitions, TomlCell("robot file")))


def replace_parameters(text: str, values: Mapping[str, float]) -> str:
    """Returns robot file with these nominal values, and others only for what they leave open."""
    before = dict(tomllib.loads(text).get("parameters", {}))
    uncertainty = before.pop("uncertainty", None)
    if uncertainty is not None:
        text = _replace_numbers(text, "parameters.uncertainty", uncertainty)
    return _replace_numbers(text, "parameters", {**before, **values})


def replace_fitted_values(text: str, values: Mapping[str, float]) -> str:
    """Returns the robot file with fitted values; inertial ones only where it may state them."""
    robot = parse_robot_text(text, "robot of the model")
    stateable = {
        f"{prefix}{joint.name}": prefix in robot.get_inertial_prefixes(joint.name)
        for joint in robot.moving_joints
        for prefix in INERTIAL
    }
    stated = {name: value for name, value in values.items() if stateable.get(name, True)}
    return replace_parameters(text, stated) if stated else text


def replace_reference(text: str, values: Mapping[str, float]) -> str:
    """Returns the robot file with another table [reference]."""
    return _replace_numbers(text, "reference", values)


def replace_drive_gains(text: str, gains: Mapping[str, float]) -> str:
    """Returns the robot file with other gains, in [drives] or [drive_gains] as it has them.

    Raises:
        RobotError: the file's own table is written in a way that cannot be replaced line by line.
    """
    drives = tomllib.loads(text).get("drives", {})
    known = {
        name: drive | {"gain": gains.get(name, drive["gain"])} for name, drive in drives.items()
    }
    if known != drives:
        text = _replace_table(text, "drives", known, "one joint a line")
    others = {name: gain for name, gain in gains.items() if name not in drives}
    if not others and "drive_gains" not in tomllib.loads(text):
        return text
    changed = _replace_numbers(text, "drive_gains", others)
    return _check_change(changed, text, "drive_gains", others, "one joint a line")


def replace_log_table(text: str, table: Mapping[str, Any]) -> str:
    """Returns the robot file with another table [log], where the old one stood, or at the end.

    Raises:
        RobotError: the file's own table is written in a way that cannot be replaced line by line.
    """
    return _replace_table(text, "log", table, "one entry a line")


def _replace_table(text: str, name: str, table: Mapping[str, Any], how: str) -> str:
    """The text with another table, where the old one stood, or at the end; `how` to write it."""
    head = rf"\[\s*{name}\s*[].]"
    old_lines = [k for k, (line, _) in enumerate(_iterate_lines(text)) if re.match(head, line)]
    lines = text.rstrip("\n").split("\n")
    new = [
        f"[{name}]",
        *(f"{format_toml_key(key)} = {format_toml(entry)}" for key, entry in table.items()),
        "",
    ]
    other_lines = [line for k, line in enumerate(lines) if k not in old_lines]
    at = old_lines[0] if old_lines else len(other_lines)
    before = other_lines[:at] if old_lines else [*other_lines, ""]
    changed = "\n".join([*before, *new, *other_lines[at:]]).rstrip("\n") + "\n"
    return _check_change(changed, text, name, dict(table), how)


def _check_change(changed: str, text: str, table: str, entries: dict[str, Any], how: str) -> str:
    """The changed text, if all that differs is what that table says."""
    if _parse_document(changed) != {**tomllib.loads(text), table: entries}:
        raise RobotError(
            f"the [{table}] table cannot be replaced; write it as a table of its own, {how}"
        )
    return changed


def _replace_numbers(text: str, table: str, values: Mapping[str, float]) -> str:
    """The text with another table of numbers, at its end."""
    other_lines = [line for head, line in _iterate_lines(text) if head != f"[{table}]"]
    return _append_table(
        other_lines, f"[{table}]", *(f'"{name}" = {value!r}' for name, value in values.items())
    )


def _append_table(lines: Sequence[str], *table: str) -> str:
    """The text with a table after one blank line."""
    return "\n".join(["\n".join(lines).rstrip(), "", *table]) + "\n"


def _iterate_lines(text: str) -> Iterator[tuple[str, str]]:
    """Every line with the head of the table that it belongs to: its own, or the last before it."""
    head = ""
    for line in text.splitlines():
        if line.startswith("["):
            head = line.split("#")[0].strip()
        yield head, line


def _parse_document(text: str) -> dict[str, Any] | None:
    """What the text says; None if it is no TOML any more."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return None


def replace_gravity(text: str, gravity: Sequence[float]) -> str:
    """Returns the robot file with another gravity, m/s^2 in frame 0.

    Raises:
        RobotError: the file's own entry does not stand on one line.
    """
    entry = f"gravity = [{', '.join(repr(float(f'{g:.8g}')) for g in gravity)}]"
    changed, count = re.subn(r"(?m)^gravity\s*=\s*\[[^\]\n]*\]", entry, text, count=1)
    if count != 1:
        raise RobotError("gravity cannot be replaced; write it on one line, as in [0, 0, -9.81]")
    return changed


def insert_coupling(text: str, joint: str, speed: str) -> str:
    """Returns the robot file with one motor more that turns with several joints."""
    lines = text.splitlines()
    entry = f'"{joint}" = "{speed}"'
    for place, line in enumerate(lines):
        if line.split("#")[0].strip() == "[coupling]":
            return "\n".join([*lines[: place + 1], entry, *lines[place + 1 :]]) + "\n"
    return _append_table(lines, "[coupling]", entry)


def replace_effects(text: str, effects: Effects) -> str:
    """Returns the robot file with another `[effects]` table.

    Nominal values of effects that are gone leave `[parameters]` with them: they would be values
    of parameters that the robot does not have.

    Raises:
        RobotError: the file's own table is written in a way that cannot be replaced line by line.
    """
    catalogue, motors = _read_catalogue(text), tomllib.loads(text).get("motors", {})

    def is_retained(parameter: str) -> bool:
        return _has_owner(parameter, effects, catalogue, motors)

    def strip_effects(document: dict[str, Any] | None) -> dict[str, Any] | None:
        """Returns the document without its effects and the values of effects that are gone."""
        if document is None:
            return None
        values = {n: v for n, v in document.get("parameters", {}).items() if is_retained(n)}
        return {**document, "effects": None, "parameters": values}

    remaining_lines = []
    for head, line in _iterate_lines(text):
        entry = re.match(r"\s*[\"']?([\w{}]+)[\"']?\s*=", line)
        is_removed = head == "[parameters]" and entry is not None and not is_retained(entry[1])
        if head != "[effects]" and not is_removed:
            remaining_lines.append(line)
    lines = ["[effects]", *(f"{name} = {format_toml(joints)}" for name, joints in effects.items())]
    changed = _append_table(remaining_lines, *lines)
    if strip_effects(tomllib.loads(text)) != strip_effects(_parse_document(changed)):
        raise RobotError(
            "the [effects] table cannot be replaced; write it as a table of its own, one effect a "
            "line, each with its joints on the same line"
        )
    return changed


def replace_robot_effects(
    robot: Robot, effects: str | Sequence[str] | Mapping[str, Any], where: str
) -> Robot:
    """Returns the robot with other effects.

    Args:
        robot: as it is.
        effects: ids of those that every joint has, in a text with commas between; or a table as
            [effects].
        where: begins the message.

    Raises:
        RobotError: no such effect.
    """
    if isinstance(effects, str):
        effects = [name.strip() for name in effects.split(",") if name.strip()]
    effect_table = dict(effects) if isinstance(effects, Mapping) else dict.fromkeys(effects, "all")
    known = [effect.id for effect in robot.catalogue]
    for name in effect_table:
        if find_effect(name, robot.catalogue) is None:
            raise RobotError(
                f"{where}: got {name}{suggest_name(name, known)}; expected some of "
                f"{', '.join(known)}"
            )
    return parse_robot_text(replace_effects(robot.text, effect_table), f"{robot.name} with {where}")


def _has_owner(
    parameter: str, effects: Effects, catalogue: Sequence[Effect], motors: Collection[str]
) -> bool:
    """True if the parameter is a link's, or one of these effects'.

    Its prefix is the longest, or one that a motor's name follows: Fvm1 is Fv of a motor m1.
    """
    owners = collect_parameter_owners(catalogue)
    prefixes = [p for p in (*INERTIAL, *owners) if parameter.startswith(p)]
    prefix = max(prefixes, key=lambda p: (parameter[len(p) :] in motors, len(p)), default="")
    if prefix not in owners:
        return True
    for name, joints in effects.items():
        effect = find_effect(name, catalogue)
        if effect is None:
            continue
        parts = PASSIVE_FRICTION_IS if effect.id == PASSIVE_FRICTION else (effect.id,)
        named = [entry["joint"] if isinstance(entry, dict) else entry for entry in joints]
        if owners[prefix] in parts and (joints == "all" or parameter[len(prefix) :] in named):
            return True
    return False


def set_joint_effect(
    text: str, effect: str, joint: str, is_present: bool, everyone: Sequence[str]
) -> str:
    """Returns the robot file where a joint has a plain effect, or has it no more.

    Args:
        text: of the file.
        effect: id.
        joint: name.
        is_present: True: it has it.
        everyone: the joints that "all" means.

    Raises:
        RobotError: see `replace_effects`.
    """
    effects: dict[str, Any] = dict(_read_expanded_table(text, "effects"))
    known = find_effect(effect, _read_catalogue(text))
    ids = (effect,) if known is None else (known.id, *known.aliases)
    name = next((n for n in effects if n in ids), effect)
    before = effects.get(name, [])
    has = list(everyone) if before == "all" else list(before)
    entries = [e for e in has if (e["joint"] if isinstance(e, dict) else e) != joint]
    entries += [joint] if is_present else []
    is_everywhere = sorted(map(str, entries)) == sorted(everyone)
    effects[name] = (
        "all"
        if is_everywhere
        else [e for e in everyone if e in entries] + [e for e in entries if e not in everyone]
    )
    return replace_effects(text, {n: joints for n, joints in effects.items() if joints})


def replace_limits(text: str, joint: str, cells: Sequence[str]) -> str:
    """Returns the robot file with other limits of a joint; without them where all cells are empty.

    Args:
        text: of the file.
        joint: name.
        cells: lower, upper, speed, acceleration, as a robot file may write them.

    Raises:
        RobotError: the file's own table is written in a way that cannot be replaced line by line.
    """
    limits = dict(_read_expanded_table(text, "limits"))
    limits[joint] = [_parse_cell(cell) for cell in cells]
    if not any(cell.strip() for cell in cells):
        del limits[joint]
    return _replace_table(text, "limits", limits, "one joint a line")


def replace_symbol(text: str, name: str, value: str) -> str:
    """Returns the robot file with another value of a letter; its comment stays.

    Args:
        text: of the file.
        name: of the letter.
        value: a number, or an expression as text.

    Raises:
        RobotError: [symbols] has no line of that letter.
    """
    lines = text.splitlines()
    for place, (head, line) in enumerate(_iterate_lines(text)):
        entry = _ENTRY.fullmatch(line)
        if head == "[symbols]" and entry is not None and entry["name"].strip("\"'") == name:
            start = f"{entry['key']}{format_toml(_parse_cell(value))}"
            comment = entry["rest"].lstrip()
            lines[place] = f"{start.ljust(len(line) - len(comment))}{comment}".rstrip()
            if comment and not lines[place].startswith(f"{start} "):
                lines[place] = f"{start} {comment}"
            return "\n".join(lines) + "\n"
    raise RobotError(f"[symbols], {name}: its line is not found; edit the file as text")


def read_symbol_texts(text: str) -> dict[str, str]:
    """Returns the letters of a robot file and their values, as it has them."""
    stated = tomllib.loads(text).get("symbols", {})
    return {name: v if isinstance(v, str) else f"{v:.15g}" for name, v in stated.items()}


def read_limit_texts(text: str) -> dict[str, tuple[str, ...]]:
    """Returns lower, upper, speed, acceleration by joint, as a robot file has them."""
    stated = _read_expanded_table(text, "limits")
    return {
        joint: tuple(e if isinstance(e, str) else f"{e:.15g}" for e in cells)
        for joint, cells in stated.items()
    }


def _read_expanded_table(text: str, table: str) -> Mapping[str, Any]:
    """A table with its entries for every leg."""
    document = tomllib.loads(text)
    entries: Mapping[str, Any] = expand_legs(document, TomlCell("robot file")).get(table, {})
    return entries


def _parse_cell(text: str) -> str | float:
    """A number as such, all else as text."""
    plain = text.strip()
    try:
        return float(plain)
    except ValueError:
        return plain


# Writing `[home]` into a robot file, and changing nothing else in it.


_HEADER = re.compile(r"\s*\[\s*(?:[\w.-]+|\"[^\"]*\")\s*\]\s*(?:#.*)?")
_ENTRY = re.compile(
    r"(?P<key>\s*(?P<name>[\w.-]+|\"[^\"]*\"|'[^']*')\s*=\s*)"
    r"(?P<value>\"[^\"]*\"|'[^']*'|[^#\s\"']+)(?P<rest>\s*(?:#.*)?)"
)
_WHERE = TomlCell("robot file").enter("[home]")


def replace_home(text: str, stated: Mapping[str, float], home: Mapping[str, float]) -> str:
    """Returns robot file with that `[home]`; comments, and values that stay, as they were written.

    Args:
        text: of the file.
        stated: what its [home] says now, by row.
        home: what it is to say, by row.

    Raises:
        RobotError: the file's own [home] is written in a way that cannot be replaced line by line.
    """
    legs = read_leg_names(_WHERE.with_value(tomllib.loads(text).get("legs")))
    for lines in _generate_home_edits(text.splitlines(), stated, home, legs):
        changed = "\n".join(lines) + "\n"
        if _is_home_stated(changed, text, home):
            return changed
    raise RobotError(
        "[home] cannot be replaced; write it as a table of its own, one joint a line, such as "
        'q2 = "-pi/2"'
    )


def format_home_lines(home: Mapping[str, float]) -> list[str]:
    """Returns `q2 = -1.2` for every row."""
    return [
        f"{format_toml_key(f'q{name}')} = {_format_number(value)}" for name, value in home.items()
    ]


def _generate_home_edits(
    lines: Sequence[str],
    stated: Mapping[str, float],
    home: Mapping[str, float],
    legs: Sequence[str],
) -> Iterator[list[str]]:
    """The lines as they are to be; where the first do not say so, the next may.

    What looks like the head of a table may stand in a text.
    """
    heads = [i for i, line in enumerate(lines) if _HEADER.fullmatch(line)]
    names = {i: lines[i].split("#")[0].strip(" []\t\"'") for i in heads}

    def find_table_span(name: str) -> tuple[int, int] | None:
        """Returns where the first table of that name begins and where the next does, or None."""
        begin = next((i for i in heads if names[i] == name), None)
        if begin is None:
            return None
        return begin, next((i for i in heads if i > begin), len(lines))

    if table_span := find_table_span("home"):
        begin, end = table_span
        while end > begin + 1 and (not lines[end - 1].strip() or _is_comment(lines[end - 1])):
            end -= 1  # blank lines and comments after the entries belong to the next table
        body = _edit_home_entries(lines[begin + 1 : end], stated, home, legs)
        yield [*lines[: begin + 1], *body, *lines[end:]]
    table = ["[home]", *format_home_lines(home), ""]
    if table_span := find_table_span("loops"):
        begin, end = table_span
        while end > begin and _is_comment(lines[end - 1]):
            end -= 1  # a comment above a table belongs to it
        gap = [] if not lines[end - 1].strip() else [""]
        yield [*lines[:end], *gap, *table, *lines[end:]]
    yield [*lines, "", *table[:-1]]


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith("#")


def _edit_home_entries(
    lines: Sequence[str],
    stated: Mapping[str, float],
    home: Mapping[str, float],
    legs: Sequence[str],
) -> list[str]:
    """The entries of the table: changed in place, then those that it lacks."""
    left, body = dict(home), list[str]()
    for line in lines:
        entry = _ENTRY.fullmatch(line)
        if entry is None:
            body.append(line)
            continue
        pattern = entry["name"].strip("\"'")
        filled = [pattern.replace(MARK, leg) for leg in legs] if MARK in pattern else [pattern]
        names = [name.removeprefix("q") for name in filled]
        values = {name: left.pop(name) for name in names if name in left}
        if all(
            abs(stated.get(name, math.inf) - value) < THRESHOLDS.max_home_change
            for name, value in values.items()
        ):
            body.append(line)
        elif len(values) == len(names) and len({_format_number(v) for v in values.values()}) == 1:
            body.append(entry["key"] + _format_number(values[names[0]]) + entry["rest"])
        else:
            first, *others = format_home_lines(values)
            body += [first + entry["rest"], *others]
    return body + format_home_lines(left)


def _format_number(value: float) -> str:
    """As short as it may be; multiples of pi/6 and pi/4 as such."""
    twelfths = value / (math.pi / 12)
    whole = round(twelfths)
    if (
        whole
        and (whole % 2 == 0 or whole % 3 == 0)
        and abs(value - whole * math.pi / 12) < THRESHOLDS.max_home_change
    ):
        return json.dumps(format_pi_multiple(Fraction(whole, 12)))
    return repr(float(f"{value:.12g}") + 0.0)


def _is_home_stated(changed: str, text: str, home: Mapping[str, float]) -> bool:
    """True if the changed text states that home, and else what the text states."""
    try:
        after, before = tomllib.loads(changed), tomllib.loads(text)
        stated = expand_legs(after, _WHERE).get("home", {})
    except (tomllib.TOMLDecodeError, RobotError):
        return False
    others = [{k: v for k, v in document.items() if k != "home"} for document in (after, before)]
    same = json.dumps(others[0], default=str) == json.dumps(others[1], default=str)
    return same and {f"q{name}" for name in home} <= stated.keys()


# Effects of robot files that go from one robot to the next: each in a file, read by the folder.


def export_effect(robot: Robot, name: str) -> str:
    """Returns a file that defines an effect of the robot, and nothing else.

    Its shapes are first tried at the values that they have in the robot, and beside these.

    Args:
        robot: it; `[effects]` says where it has the effect.
        name: id of the effect.

    Raises:
        RobotError: the robot defines no such effect.
    """
    names = [effect.id for effect in robot.own_effects]
    if name not in names:
        known = find_effect(name)
        why = "every robot may have it" if known else f"no such effect{suggest_name(name, names)}"
        raise RobotError(
            f"{name}: {why}; expected one that {robot.name} defines: {join_names(names)}"
        )
    definition = tomllib.loads(robot.text)["own_effects"][name]
    used_values = [
        at.nonlinear_parameters
        for use in robot.effects
        if use.effect == name
        for at in use.instances
    ]
    shapes = robot.own_effects[names.index(name)].forms[0].nonlinear_parameters
    about = {s.name: _build_grid(s, [at[s.name] for at in used_values]) for s in shapes}
    try:
        text = insert_own_effect("", name, definition | ({"shapes": about} if about else {}))
        read_own_effects(tomllib.loads(text)["own_effects"], TomlCell("file"))
    except RobotError:  # too many values, or one at which an equation has none
        text = insert_own_effect("", name, definition)
    return text.lstrip()


def _build_grid(shape: NonlinearParameter, used_values: Sequence[float]) -> list[float]:
    """First values of a shape about those that were found, four digits; one value stays fixed."""
    if not used_values or not shape.is_continuous:
        return list(shape.grid)
    low, high = min(used_values), max(used_values)
    step = min(b - a for a, b in pairwise(shape.grid))
    ends = (low / 2.0, high * 2.0) if shape.grid[0] > 0.0 else (low - step, high + step)
    return sorted({float(f"{x:.4g}") for x in (*ends, *used_values)})


@dataclass(frozen=True)
class SharedEffects(ShortRepr):
    """Effects of a folder that a robot may have too.

    Attributes:
        effects: those that it does not define itself.
        definitions: of each, its table of `[own_effects]` by id.
        left_out: id of an effect that it cannot have -> in which file it is, and why.
    """

    effects: tuple[Effect, ...] = ()
    definitions: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    left_out: Mapping[str, str] = field(default_factory=dict)

    def insert_definitions(self, text: str, names: Collection[str]) -> str:
        """Returns a robot file with the definitions of those among the names."""
        for name in [effect_id for effect_id in self.definitions if effect_id in names]:
            text = insert_own_effect(text, name, self.definitions[name])
        return text


def collect_shared_effects(robot: Robot, folder: str | Path) -> SharedEffects:
    """Returns own effects of every *.toml file of a folder, as far as the robot has what they read.

    What the robot, or a file before, defines alike counts once.

    Args:
        robot: that may have them.
        folder: of files as `export_effect` gives them, or of robot files.

    Raises:
        RobotError: a file that cannot be read, a mistake in it, a name or a parameter that another
            effect has; or the folder has no effect.
    """
    known = {effect.id: (effect, f"the file of {robot.name}") for effect in robot.own_effects}
    joints = [joint.name for joint in robot.moving_joints]
    definitions, left_out, some = dict[str, Mapping[str, Any]](), dict[str, str](), False
    for path in sorted(Path(folder).glob("*.toml")):
        place = TomlCell(str(path))
        table = parse_toml_document(read_file_text(path), place).get("own_effects", {})
        for name, cell in place.enter("[own_effects]", table).read_table(EXAMPLE).items():
            some, others = True, [effect for effect, _ in known.values() if effect.id != name]
            (effect,) = read_own_effects({name: cell}, place, before=others)
            before, owner = known.get(name, (effect, ""))
            if _build_law_key(before) != _build_law_key(effect):
                raise place.enter(f"[own_effects.{name}]").make_error(
                    f"defined otherwise in {owner}; rename one of the two"
                )
            if lacks := [
                n for n in sorted(effect.forms[0].other_joint_names) if n[1:] not in joints
            ]:
                left_out[name] = f"{path}: it reads {join_names(lacks)}, no joint of {robot.name}"
            elif name not in known:
                read_own_effects({name: cell}, place, joints, others)
                known[name], definitions[name] = (effect, str(path)), cell
    if not some:
        raise RobotError(
            f"{folder}: no effects there; expected a folder with files that `modeler effects "
            "--export` wrote, or with robot files that have [own_effects]"
        )
    return SharedEffects(tuple(known[name][0] for name in definitions), definitions, left_out)


def _build_law_key(effect: Effect) -> tuple[object, ...]:
    """All that a joint could show; where its shapes are tried first is no part of it."""
    form = effect.forms[0]
    return (
        effect.acts,
        form.columns,
        form.internal_state,
        {shape.name for shape in form.nonlinear_parameters},
    )
