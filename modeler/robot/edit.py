"""Edits of a robot file: effects, parameters, limits, home, and nothing else in it."""

import math
import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from modeler.core.errors import RobotError
from modeler.core.json import ShortRepr
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

if TYPE_CHECKING:
    from tomlkit import TOMLDocument
    from tomlkit.items import Item

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
        RobotError: the joint has the effect already.
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
    return _append_table(text, f"[own_effects.{format_toml_key(name)}]", definition)


def _read_catalogue(text: str) -> tuple[Effect, ...]:
    """The effects that the robot of the file may have."""
    definitions = tomllib.loads(text).get("own_effects", {})
    return (*CATALOGUE, *read_own_effects(definitions, TomlCell("robot file")))


def replace_parameters(text: str, values: Mapping[str, float]) -> str:
    """Returns robot file with these nominal values, and others only for what they leave open."""
    return _write_entries(text, "parameters", values)


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
    return _write_table(text, "reference", values)


def replace_drive_gains(text: str, gains: Mapping[str, float]) -> str:
    """Returns the robot file with other gains, in [drives] or [drive_gains] as it has them."""
    document = _parse_document(text)
    drives = document.get("drives", {})
    for name, drive in drives.items():
        if gains.get(name, drive["gain"]) != drive["gain"]:
            drive["gain"] = gains[name]
    others = {name: gain for name, gain in gains.items() if name not in drives}
    if not others and "drive_gains" not in document:
        return document.as_string()
    return _write_table(document.as_string(), "drive_gains", others)


def replace_log_table(text: str, table: Mapping[str, Any]) -> str:
    """Returns the robot file with another table [log], where the old one stood, or at the end."""
    return _write_table(text, "log", table)


def replace_gravity(text: str, gravity: Sequence[float]) -> str:
    """Returns the robot file with another gravity, m/s^2 in frame 0."""
    document = _parse_document(text)
    _replace_entry(document, "gravity", [float(f"{g:.8g}") for g in gravity])
    return document.as_string()


def insert_coupling(text: str, joint: str, speed: str) -> str:
    """Returns the robot file with one motor more that turns with several joints."""
    return _write_entries(text, "coupling", {joint: speed})


def replace_effects(text: str, effects: Effects) -> str:
    """Returns the robot file with another `[effects]` table.

    Nominal values of effects that are gone leave `[parameters]` with them: they would be values
    of parameters that the robot does not have.
    """
    catalogue, motors = _read_catalogue(text), tomllib.loads(text).get("motors", {})
    document = _parse_document(text)
    parameters = _find_table(document, "parameters")
    for name in list(parameters or ()):
        if not _has_owner(name, effects, catalogue, motors):
            del parameters[name]
    return _write_table(document.as_string(), "effects", effects)


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
            got = f"got {name}{suggest_name(name, known)}"
            raise RobotError(f"{where}: {got}; expected some of {', '.join(known)}")
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
    """
    limits = dict(_read_expanded_table(text, "limits"))
    limits[joint] = [_parse_cell(cell) for cell in cells]
    if not any(cell.strip() for cell in cells):
        del limits[joint]
    return _write_table(text, "limits", limits)


def replace_symbol(text: str, name: str, value: str) -> str:
    """Returns the robot file with another value of a letter; its comment stays.

    Args:
        text: of the file.
        name: of the letter.
        value: a number, or an expression as text.

    Raises:
        RobotError: [symbols] has no line of that letter.
    """
    document = _parse_document(text)
    symbols = _find_table(document, "symbols")
    if symbols is None or name not in symbols:
        raise RobotError(f"[symbols], {name}: its line is not found; edit the file as text")
    _replace_entry(symbols, name, _parse_cell(value))
    return document.as_string()


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


def replace_home(text: str, stated: Mapping[str, float], home: Mapping[str, float]) -> str:
    """Returns robot file with that `[home]`; comments, and values that stay, as they were written.

    Args:
        text: of the file.
        stated: what its [home] says now, by row.
        home: what it is to say, by row.
    """
    document, missing = _parse_document(text), dict(home)
    legs = read_leg_names(TomlCell("robot file", "[home]", document.get("legs")))
    table = _find_table(document, "home")
    for key in list(table or ()):
        keys = [key.replace(MARK, leg) for leg in legs] if MARK in key else [key]
        values = {n: missing.pop(n) for k in keys if (n := k.removeprefix("q")) in missing}
        changes = [abs(stated.get(name, math.inf) - value) for name, value in values.items()]
        if all(change < THRESHOLDS.max_home_change for change in changes):
            continue
        entries = {_express_angle(value) for value in values.values()}
        if len(values) == len(keys) and len(entries) == 1:
            _replace_entry(table, key, entries.pop())
        else:  # legs that differ
            del table[key]
            missing |= values
    lacking = {f"q{name}": _express_angle(value) for name, value in missing.items()}
    return _write_entries(document.as_string(), "home", lacking)


def format_home_lines(home: Mapping[str, float]) -> list[str]:
    """Returns `q2 = -1.2` for every row."""
    return _format_entries({f"q{name}": _express_angle(value) for name, value in home.items()})


def _express_angle(value: float) -> float | str:
    """Returns a multiple of pi/6 or pi/4 as text, another angle or length as a short number."""
    whole = round(value / (math.pi / 12))
    is_multiple = abs(value - whole * math.pi / 12) < THRESHOLDS.max_home_change
    if whole and (whole % 2 == 0 or whole % 3 == 0) and is_multiple:
        return format_pi_multiple(Fraction(whole, 12))
    return float(f"{value:.12g}") + 0.0


# Tables in the text of a file: what does not change stays as it was written.


def _parse_document(text: str) -> "TOMLDocument":
    import tomlkit  # 0.05 s, for edits only

    return tomlkit.parse(text)


def _make_item(entry: Any) -> "Item":
    import tomlkit

    return tomlkit.value(format_toml(entry))


def _find_table(document: "TOMLDocument", name: str) -> Any:
    """Returns the table with that head, without tables in it that have heads of their own.

    Raises:
        RobotError: its entries are dotted keys, `home.q2 = 0.1`.
    """
    for key, item in document.body:
        if key is not None and key.key == name:
            if key.is_dotted():
                todo = f"write them as a table [{name}]"
                raise RobotError(f"the dotted keys of {name} cannot be replaced; {todo}")
            if not getattr(item, "is_super_table", bool)():
                return item
    return None


def _replace_entry(table: Any, key: str, entry: Any) -> None:
    """Puts another entry into its line; a comment stays in its column where there is room."""
    before, item = table[key], _make_item(entry)
    width = len(before.as_string()) + len(before.trivia.comment_ws)
    table[key] = item
    if item.trivia.comment:
        item.trivia.comment_ws = " " * max(1, width - len(item.as_string()))


def _write_table(text: str, name: str, entries: Mapping[str, Any]) -> str:
    """Returns the text with these entries of a table and no others."""
    document = _parse_document(text)
    table = _find_table(document, name)
    for key in [key for key in table or () if key not in entries]:
        del table[key]
    return _write_entries(document.as_string(), name, entries)


def _write_entries(text: str, name: str, entries: Mapping[str, Any]) -> str:
    """Returns the text with these entries of a table; it is added where there is none."""
    document = _parse_document(text)
    table = _find_table(document, name)
    if table is None:
        return _append_table(text, f"[{name}]", entries)
    for key in [key for key in entries if key in table and table[key] != entries[key]]:
        _replace_entry(table, key, entries[key])
    new, body = [key for key in entries if key not in table], table.value.body
    heads = (k for k, (_, item) in enumerate(body) if hasattr(item, "is_super_table"))
    end = next(heads, len(body))
    while end and body[end - 1][0] is None:  # blank lines and comments belong to the next table
        end -= 1
    body[end:], rest = [], body[end:]
    for key in new:
        table.append(key, _make_item(entries[key]))
    body += rest
    return document.as_string()


def _append_table(text: str, head: str, entries: Mapping[str, Any]) -> str:
    """Returns the text with a table after one blank line."""
    return "\n".join([text.rstrip(), "", head, *_format_entries(entries)]) + "\n"


def _format_entries(entries: Mapping[str, Any]) -> list[str]:
    return [f"{format_toml_key(key)} = {format_toml(entry)}" for key, entry in entries.items()]


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
        expected = f"expected one that {robot.name} defines: {join_names(names)}"
        raise RobotError(f"{name}: {why}; {expected}")
    definition = tomllib.loads(robot.text)["own_effects"][name]
    uses = [at for use in robot.effects if use.effect == name for at in use.instances]
    used_values = [at.nonlinear_parameters for at in uses]
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
                here, what = place.enter(f"[own_effects.{name}]"), f"defined otherwise in {owner}"
                raise here.make_error(f"{what}; rename one of the two")
            others_read = sorted(effect.forms[0].other_joint_names)
            if lacks := [name for name in others_read if name[1:] not in joints]:
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
    names = {shape.name for shape in form.nonlinear_parameters}
    return effect.acts, form.columns, form.internal_state, names
