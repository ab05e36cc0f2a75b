"""Robot files: TOML text to a checked `Robot`.

Every mistake is a `RobotError` of one line: file, place, what was got, what was expected, what to
do. Nothing is guessed except what the format says may be left out.
"""

import dataclasses
import fnmatch
import re
import string
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from modeler.core.choices import TEMPLATES, list_builtin_robots, read_builtin_robot, read_template
from modeler.core.errors import DataError, RobotError
from modeler.core.files import DestinationKind, read_text, resolve_destination, write_atomically
from modeler.core.json import TomlError, parse_toml
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.robot.cells import (
    Values,
    check_name_length,
    choose_robot_name,
    describe_rounded_angles,
    read_gravity,
    read_symbols,
)
from modeler.robot.effects import (
    check_elastic_joints,
    needs_reference,
    read_effects,
    read_own_effects,
)
from modeler.robot.mechanism import (
    build_motor_rows,
    check_driven,
    expand_legs,
    merge_shared_names,
    read_home,
    read_leg_names,
    read_links,
    read_loops,
    read_motors,
    read_platform,
    read_relations,
    read_shared,
)
from modeler.robot.robot import Robot
from modeler.robot.sections import (
    Joints,
    read_capsules,
    read_coupling,
    read_diagnose,
    read_drive_gains,
    read_drives,
    read_fit,
    read_frames,
    read_limits,
    read_numbers,
    read_parameters,
    read_physical,
    read_tool,
)
from modeler.robot.table import (
    CONVENTIONS,
    GEOMETRY,
    STEPS,
    Rows,
    build_joints,
    check_units,
    read_convention,
    read_table_rows,
)
from modeler.robot.thresholds import THRESHOLDS

_KEYS = """
    name title notes gravity priority legs shared symbols mdh relations platform loops home frames
    tool links effects own_effects coupling motors parameters reference drive_gains drives limits
    physical terms log fit diagnose capsules
"""
_NEEDED = {
    "name": 'write a first line such as name = "arm"',
    "gravity": 'write the acceleration of gravity in frame 0, such as [0, 0, "-g"] with g among '
    "[symbols], or [0, 0, 0] if there is none",
    "mdh": "add the table [mdh] with columns and rows",
}
_ROUNDED = "{}; a measured angle keeps its value as a symbol of [symbols]"
_ROBOT_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")


def read_robot(robot: str | Path) -> Robot:
    """Reads the robot of a robot file (TOML), or the built-in one of that name.

    A text that is the name of a built-in robot means that one; write `./wrist` for a file `wrist`.

    Raises:
        RobotError: no such file or name, or a mistake in the file.
    """
    if isinstance(robot, str) and robot in list_builtin_robots():
        return parse_robot_text(read_builtin_robot(robot), robot)
    if not str(robot).strip():
        raise RobotError(
            'robot: got ""; expected a robot file or a built-in robot '
            f"({join_names(list_builtin_robots())})"
        )
    path = Path(robot)
    text = read_file_text(path)
    if text.lstrip().startswith("{"):  # as JSON does and a robot file never
        what = "a model file" if '"modeler model"' in text else "JSON"
        raise RobotError(
            f"{path}: is {what}; expected a robot: give its robot file (TOML) or the name of a "
            "built-in one; models are taken by `modeler compare`, `add` and others"
        )
    return parse_robot_text(text, str(path))


def read_file_text(path: Path) -> str:
    """Returns what a file says.

    Raises:
        RobotError: it is not there, cannot be read, or is no text.
    """
    try:
        if path.exists() and not path.is_dir():
            return read_text(path)
    except UnicodeDecodeError as error:
        what = f"byte {error.start} is not UTF-8 text; save the file as UTF-8"
        raise RobotError(f"{path}: {what}") from None
    except OSError as error:
        raise RobotError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    raise RobotError(_describe_missing_file(path))


def parse_robot_text(text: str, where: str) -> Robot:
    """Returns the robot that the TOML text describes.

    Args:
        text: contents of a robot file.
        where: name of the file, for messages.

    Raises:
        RobotError: a mistake in the text.
    """
    place = TomlCell(where)
    document = expand_legs(_read_document(text, place), place)

    def locate_section(key: str, otherwise: Any = None) -> TomlCell:
        return place.enter(f"[{key}]", document.get(key, otherwise))

    platform_rows, platform = read_platform(locate_section("platform"))
    convention = read_convention(locate_section("mdh"), document)
    rows = read_table_rows(locate_section("mdh"), platform_rows, convention)
    rows += build_motor_rows(locate_section("motors", {}), rows)
    variables = _collect_joint_columns(rows)
    symbols, values = read_symbols(locate_section("symbols", {}), variables)
    motors, driven = read_motors(locate_section("motors", {}), rows, values)
    rounded, readings = dict[str, str](), list[str]()
    here = locate_section("relations", {})
    relations = read_relations(here, driven, rows, values, rounded, readings)
    title = place.enter("title", document.get("title", document["name"])).read_text('"my robot"')
    if len(title.splitlines()) > 1:
        raise place.enter("title", title).make_mismatch("one line; put the rest into notes")
    robot = Robot(
        name=document["name"],
        title=title,
        gravity=read_gravity(place.enter("gravity", document["gravity"]), variables, values),
        symbols=symbols,
        joints=build_joints(rows, values, rounded),
        relations=relations,
        motors={m: {j: float(c) for j, c in row.items()} for m, row in motors.items()},
        platform=platform,
        convention=convention,
        text=text,
    )
    readings += [_ROUNDED.format(describe_rounded_angles(rounded))] if rounded else []
    readings += check_units(robot, values, locate_section("mdh"))
    robot = dataclasses.replace(robot, readings=tuple(readings))
    if "notes" in document:
        notes = place.enter("notes", document["notes"]).read_text('"my robot"')
        robot = dataclasses.replace(robot, notes=notes)
    check_driven(robot, place.enter("[motors]"))
    return _read_tables(robot, document, values, place)


def _read_tables(
    robot: Robot, document: Mapping[str, Any], values: Values, place: TomlCell
) -> Robot:
    """The robot with what the tables say that name its joints."""

    def locate_section(key: str) -> TomlCell:
        return place.enter(f"[{key}]", document.get(key, {}))

    moving = {joint.name: joint for joint in robot.moving_joints}
    coupling = read_coupling(locate_section("coupling"), moving, values)
    own_effects = read_own_effects(document.get("own_effects", {}), place, moving)
    robot = dataclasses.replace(robot, own_effects=own_effects)
    here = locate_section("effects")
    effects = read_effects(here, moving, coupling, robot.catalogue, robot.platform)
    links: dict[str, tuple[str, ...]] = dict.fromkeys(robot.platform[:-1], ())
    links |= dict.fromkeys(robot.motors, ())
    links |= read_links(locate_section("links"), moving)
    robot = dataclasses.replace(robot, links=links, effects=effects)
    parameter_names = _collect_parameter_names(robot, moving, place)
    legs = read_leg_names(place.enter("legs", document.get("legs")))
    shared = read_shared(place.enter("shared", document.get("shared", [])), parameter_names, legs)
    known = merge_shared_names(parameter_names, shared)
    loops = read_loops(place.enter("[loops]", document.get("loops")), robot.joints)
    if loops and not any(joint.actuated for joint in robot.free_joints):
        what = "no joint is actuated; write mu 1 in the rows that have a motor"
        raise place.enter("[loops]").make_error(what)
    home = read_home(locate_section("home"), moving, values)
    for joint in robot.moving_joints:
        for effect, _, instance in robot.find_joint_effects(joint.name):
            if needs_reference(effect, instance) and "reference" not in document:
                raise locate_section("reference").make_error(
                    f"is missing; {effect.id} depends on the torques of the links: state their "
                    "parameters there, as `modeler add` does"
                )
    standard = "names of standard parameters, such as ZZ1"
    rows = [joint.name for joint in robot.joints]
    names = f"names such as {join_names(known[:12])}"
    names += " (friction and rotors only where [effects] has them)"
    parameters, uncertainty = read_parameters(locate_section("parameters"), known, names)
    readings = [*robot.readings]
    drive_gains = read_drive_gains(locate_section("drive_gains"), moving)
    drive_gains, drives = read_drives(locate_section("drives"), moving, drive_gains, readings)
    robot = dataclasses.replace(
        robot,
        readings=tuple(readings),
        loops=loops,
        home=home,
        shared=shared,
        reference=read_numbers(locate_section("reference"), known, "[reference]", standard),
        coupling=coupling,
        priority=_read_priority(
            place.enter("priority", document.get("priority", [])), known, robot
        ),
        parameters=parameters,
        uncertainty=uncertainty,
        drive_gains=drive_gains,
        drives=drives,
        limits=read_limits(locate_section("limits"), moving, values),
        physical=read_physical(locate_section("physical"), moving),
        terms=locate_section("terms").read_table("[terms]"),
        log=locate_section("log").read_table('"q<j>" = "position_{j} [deg]"'),
        fit=read_fit(locate_section("fit")),
        diagnose=read_diagnose(locate_section("diagnose")),
        frames=read_frames(place.enter("[frames]", document.get("frames")), rows, values),
    )
    check_elastic_joints(robot, here)
    tool = read_tool(place.enter("[tool]", document.get("tool")), robot, values)
    capsules, planes = read_capsules(locate_section("capsules"), rows, values)
    return dataclasses.replace(robot, tool=tool, capsules=capsules, planes=planes)


def _describe_missing_file(path: Path) -> str:
    names = list_builtin_robots()
    if path.is_dir():
        expected = f"expected a robot file or a built-in robot ({join_names(names)})"
        return f"{path}: is a folder; {expected}"
    if path.suffix or len(path.parts) > 1:
        return (
            f"{path}: there is no such file{suggest_name(path.stem, names)}; expected a robot file "
            f"(`modeler new {path.with_suffix('.toml')}` begins one) or a built-in robot "
            f"({join_names(names)})"
        )
    return (
        f"{quote_value(str(path))} is neither a file nor a built-in "
        f"robot{suggest_name(str(path), names)}; built-in are {join_names(names)}"
    )


def parse_toml_document(text: str, place: TomlCell) -> dict[str, Any]:
    """Returns what a TOML text says.

    Raises:
        RobotError: it is no TOML; says in which line.
    """
    try:
        return parse_toml(text)
    except TomlError as error:
        match = re.fullmatch(r"(.*) \(at line (\d+), column (\d+)\)", str(error), re.DOTALL)
        if str(error).endswith("(at end of document)"):
            marks = [mark for mark in ('"""', "'''") if text.count(mark) % 2]
            end = max((text.rfind(mark) for mark in marks), default=len(text))
            what = "a string opened by three quotes" if marks else "the last string or list"
            raise place.enter(f"line {text.count(chr(10), 0, end) + 1}").make_error(
                f"not TOML ({error}); {what} is never closed: close it"
            ) from None
        if match is None:
            raise place.make_error(f"cannot be read as TOML: {error}") from None
        raise place.enter(f"line {match[2]}, column {match[3]}").make_error(
            f"not TOML ({match[1]}); correct that line (texts stand in quotes, entries are "
            "separated by commas)"
        ) from None


def _read_document(text: str, place: TomlCell) -> dict[str, Any]:
    document = parse_toml_document(text, place)
    place.with_value(document).read_checked_table(_KEYS.split(), "")
    for key, advice in _NEEDED.items():
        if key not in document:
            raise place.enter(key).make_error(f"is missing; {advice}")
    name = place.enter("name", document["name"])
    if not isinstance(name.value, str) or not _ROBOT_NAME.fullmatch(name.value):
        expected = 'letters, digits, - and _ such as "arm-2"'
        raise name.make_mismatch(f"{expected} (it becomes part of names in the C code)")
    check_name_length(name.value, name)
    return document


def _collect_joint_columns(rows: Rows) -> dict[str, str]:
    """Names of positions, speeds and accelerations of all rows -> row.

    Raises:
        RobotError: row names whose logged columns would have the same name.
    """
    columns: dict[str, str] = {}
    for row, place in rows:
        for prefix in ("q", "qc", "qd", "qdd"):
            column = f"{prefix}{row['j']}"
            if column in columns:
                raise place.make_error(
                    f"the name makes {column} mean two things, with row "
                    f"{quote_value(columns[column])}; choose another name"
                )
            columns[column] = row["j"]
    return columns


def _collect_parameter_names(robot: Robot, moving: Joints, place: TomlCell) -> tuple[str, ...]:
    """Names of the standard parameters.

    Raises:
        RobotError: two of them are the same, or one is also a symbol.
    """
    names: dict[str, str] = {}
    for name in moving:
        prefixes = list(robot.get_inertial_prefixes(name))
        joint_parameters = [f"{prefix}{name}" for prefix in prefixes]
        for _, form, instance in robot.find_joint_effects(name):
            columns = [column.prefix for column in form.columns]
            joint_parameters += [f"{prefix}{name}{instance.label}" for prefix in columns]
        for parameter in joint_parameters:
            if parameter in robot.symbols:
                raise place.enter("[symbols]").make_error(
                    f"{quote_value(parameter)} is the name of a standard parameter; choose another "
                    "name"
                )
            if parameter in names:
                raise place.enter(f'[mdh] row "{name}"').make_error(
                    f"the name makes {parameter} mean two parameters, with row "
                    f"{quote_value(names[parameter])}; choose another name"
                )
            names[parameter] = name
    for parameter, name in names.items():
        if parameter.endswith("R") and parameter[:-1] in names:
            raise place.enter(f'[mdh] row "{name}"').make_error(
                f"the name makes {parameter} a parameter, which is also how {parameter[:-1]} is "
                "called when others group into it; choose a name that does not end in R"
            )
    return tuple(names)


def _read_priority(place: TomlCell, known: tuple[str, ...], robot: Robot) -> tuple[str, ...]:
    """The patterns that match a parameter; those of effects that the robot lacks are left out."""
    patterns = place.read_list('["ZZ*", "Ia?"]')
    prefixes = [c.prefix for e in robot.catalogue for form in e.forms for c in form.columns]
    rows = [joint.name for joint in robot.moving_joints]
    possible = [*known, *(prefix + row for prefix in prefixes for row in rows)]
    for entry in patterns:
        pattern = place.with_value(entry).read_text('"ZZ*"')
        if not any(fnmatch.fnmatchcase(name, pattern) for name in possible):
            raise place.make_error(
                f"{quote_value(pattern)} matches no parameter{suggest_name(pattern, known)}; "
                f"expected names or patterns of {join_names(known[:12])} ..."
            )
    return tuple(p for p in patterns if any(fnmatch.fnmatchcase(name, p) for name in known))


# Robot files to start from: templates that derive as they are, and files of other programs.


SERIAL = "serial"
_TITLES = {
    SERIAL: "a serial robot",
    "parallelogram": "an arm with a parallelogram",
    "parallel": "a planar parallel robot of three legs",
}
_WORDS = str.maketrans({"\u03b1": "alpha", "\u03b3": "gamma", "\u03b8": "theta", "\u2192": "->"})
_ALPHA = ("0", "-pi/2", "0", "pi/2", "-pi/2", "pi/2")  # shoulder, elbow, wrist


def new_robot(
    path: str | Path,
    template: str = "serial",
    joints: str = "RRR",
    convention: str = "khalil",
    force: bool = False,
) -> Robot:
    """Writes a commented robot file to start from, which derives as it is.

    >>> derive(new_robot("six.toml", joints="RRP")).base.proof.kind
    'exact'

    Args:
        path: of the file, ending in .toml; the robot is called as it is.
        template: `serial`, `parallelogram` or `parallel`.
        joints: of a serial robot, from the base: R revolute, P prismatic.
        convention: whose table a serial robot gets: `khalil`, `craig` or `classical`.
        force: write over a file that is there.

    Raises:
        RobotError: an unknown template or convention, or other letters for joints.
        DataError: another ending, or a file that is there.
    """
    place = Path(path)
    check_new_robot(place, force)
    text = fill_template(choose_robot_name(place.stem), template, joints, convention)
    robot = parse_robot_text(text, str(place))
    write_atomically(place, text)
    return robot


def check_new_robot(place: Path, force: bool) -> None:
    """Refuses what `new_robot` would: another ending, or a file that is there."""
    if place.suffix.lower() != ".toml":
        ending = place.suffix or "no ending"
        raise DataError(f"{place}: got {ending}; expected a name such as arm.toml")
    if resolve_destination(place).kind is DestinationKind.FILE and not force:
        todo = "choose another name, or write over it with --force (force=True)"
        raise DataError(f"{place}: there is such a file; {todo}")


def fill_template(
    name: str, template: str = SERIAL, joints: str = "RRR", convention: str = "khalil"
) -> str:
    """Returns the text of a robot file that derives as it is, with comments on what to change.

    Args:
        name: of the robot.
        template: one of `TEMPLATES`.
        joints: of a serial robot, from the base: R revolute, P prismatic.
        convention: in whose letters the table of a serial robot is.

    Raises:
        RobotError: an unknown template or convention, or other letters for joints.
    """
    if template not in TEMPLATES:
        raise RobotError(f"template: got {template}; expected one of {', '.join(TEMPLATES)}")
    if convention not in CONVENTIONS:
        raise RobotError(f"convention: got {convention}; expected one of {', '.join(CONVENTIONS)}")
    kinds = joints.upper()
    if not re.fullmatch(rf"[RP]{{1,{THRESHOLDS.max_template_joints}}}", kinds):
        raise RobotError(
            f"joints: got {joints!r}; expected R (revolute) or P (prismatic) for each joint from "
            f"the base, {THRESHOLDS.max_template_joints} at most, such as RRPRRR"
        )
    if template != SERIAL and (kinds != "RRR" or convention != "khalil"):
        raise RobotError(
            f"joints, convention: got {joints}, {convention} with the template {template}, which "
            "has its own; leave them out, or take the template serial"
        )
    values = {"name": name, "title": f"{name}, {_TITLES[template]}"}
    values |= _build_serial_values(kinds, convention)
    return string.Template(read_template(template)).substitute(values)


def _build_serial_values(kinds: str, convention: str) -> dict[str, str]:
    """What stands in the template of a serial robot."""
    rows, lengths = [], dict[str, str]()
    for j, kind in enumerate(kinds, start=1):
        row = dict.fromkeys(GEOMETRY, "0") | {"alpha": _ALPHA[(j - 1) % len(_ALPHA)]}
        row |= {"j": f"{j}", "sigma": "1" if kind == "P" else "0"}
        if j > 1 and row["alpha"] == "0":
            row["d"], lengths[f"D{j}"] = f"D{j}", f"{0.25 + 0.03 * j:.2f}"
        if kind == "R" and j % 3 == 1:
            row["r"], lengths[f"R{j}"] = f"R{j}", f"{0.2 + 0.03 * j:.2f}"
        row["r" if kind == "P" else "theta"] = f"q{j}"
        rows.append(row)
    if convention == "classical":  # alpha and d stand in the row before
        for row, after in zip(rows, [*rows[1:], {"alpha": "0", "d": "0"}], strict=True):
            row |= {"alpha": after["alpha"], "d": after["d"]}
    letters = CONVENTIONS[convention]
    columns = [c for c in letters if c in ("j", "sigma", "alpha", "d", "theta", "r")]
    cells = [[f'"{letters[c]}"' for c in columns]]
    cells += [
        [row[c] if c != "j" and row[c] in "01" else f'"{row[c]}"' for c in columns] for row in rows
    ]
    from modeler.robot.robot_text import align_cells  # reading writes none

    head, *lines = align_cells(cells)
    stated = f'convention = "{convention}"\n' if convention != "khalil" else ""
    body = "".join(f"          [{line}],\n" for line in lines)
    symbols = [f"{name} = {length}".ljust(38) + "# m" for name, length in lengths.items()]
    ranges = {
        "R": ('["-90 deg", "90 deg", 2, 8]', "rad, rad/s, rad/s^2"),
        "P": ("[-0.3, 0.3, 0.5, 3]", "m, m/s, m/s^2"),
    }
    limits = [
        f"{j} = {ranges[kind][0]}".ljust(38) + f"# {ranges[kind][1]}"
        for j, kind in enumerate(kinds, 1)
    ]
    return {
        "symbols": "\n".join(symbols),
        "limits": "\n".join(limits),
        "table": f"{stated}columns = [{head}]\nrows = [\n{body}]",
        "step": STEPS[convention].translate(_WORDS).replace("; ", "\n# "),
    }
