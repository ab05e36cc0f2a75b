"""A `.par` file as the text of a robot file, with what had to be decided or left out."""

import itertools
from dataclasses import dataclass, field
from pathlib import PurePath

from modeler.core.toml_cells import join_names
from modeler.formats.par_table import (
    Counts,
    Frames,
    Symbols,
    convert_gravity,
    convert_table_cells,
    find_joint_variables,
    read_counts,
    read_par_frames,
)
from modeler.formats.par_text import (
    BASE,
    FORCES,
    INERTIA,
    JOINTS,
    ParFormula,
    Statements,
    scan_statements,
)
from modeler.robot import (
    GEOMETRY,
    LINKS,
    PARAMETERS,
    ConvertedRobot,
    TextRow,
    choose_robot_name,
    format_effects,
    format_head,
    format_loops,
    format_mdh,
    format_name_list,
    format_section,
    format_symbols,
    join_lines,
)

# What a `.par` file says of the links: which parameters they have, values, friction, rotors.


_EFFECT = {"IA": ("rotor_inertia", "Ia"), "FV": ("viscous", "Fv"), "FS": ("coulomb", "Fs")}
_IDENTITY = ["1" if k % 5 == 0 else "0" for k in range(16)]


@dataclass
class Bodies:
    """What becomes of the lists of the links.

    Attributes:
        links: link -> the parameters it has, where it has not all ten.
        parameters: nominal values.
        effects: effect id -> its joints.
        notes: what was not carried over.
        others: parameters that the file has under another letter.
    """

    links: dict[str, list[str]] = field(default_factory=dict)
    parameters: dict[str, float] = field(default_factory=dict)
    effects: dict[str, list[str]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    others: list[str] = field(default_factory=list)

    def add_parameter(self, name: str, cell: ParFormula) -> None:
        """Keeps the value of a parameter, or its letter if that is another."""
        if cell.literal is not None:
            self.parameters[name] = float(cell.literal)
        elif cell.text.lower() != name.lower():
            self.others.append(f"{name} (there {cell.source_text})")


def read_bodies(statements: Statements, counts: Counts, frames: Frames) -> Bodies:
    """Returns the parameters of links 1 .. NL, and what is left out.

    A parameter that is 0 beside letters is one that the link has not; beside numbers only, a
    value. Cut joints carry nothing.

    Raises:
        RobotError: an entry is no formula.
    """
    result = Bodies()

    for k in range(counts.links):
        places = {key: (k + counts.floating, f"{key}{k + 1}") for key in INERTIA}
        cells = {key: statements.read_formula(key, *place) for key, place in places.items()}
        if frames[k].variable_column is None:
            if any(key in statements.by_key and not cells[key].is_zero for key in INERTIA):
                result.notes.append(
                    f"parameters of frame {k + 1} are left out: it is fixed (Sigma 2), count them "
                    f"to link {frames[k].antecedent}"
                )
            continue
        has = [key for key, entry in cells.items() if not entry.is_zero]
        if has and all(entry.literal is not None for entry in cells.values()):
            has = list(INERTIA)
        if len(has) < len(INERTIA):
            result.links[f"{k + 1}"] = has
        for key in has:
            result.add_parameter(f"{key}{k + 1}", cells[key])
    for j in range(counts.links, counts.joints):
        if frames[j].variable_column is not None:
            result.links[f"{j + 1}"] = []
    _read_effects(statements, counts, frames, result)
    if result.others:
        others = join_names(result.others)
        result.notes.append(f"parameters that are not letters of their own: {others}")
    _describe_omissions(statements, counts, result)
    return result


def _read_effects(statements: Statements, counts: Counts, frames: Frames, result: Bodies) -> None:
    """Adds friction and rotor inertias of the joints, and offsets where there is friction."""
    without = []
    for key, (effect, prefix) in _EFFECT.items():
        if key not in statements.by_key:
            continue
        for k in range(counts.links):
            entry = statements.read_formula(key, k + counts.floating, f"{key}{k + 1}")
            if entry.is_zero or frames[k].variable_column is None:
                continue
            if effect == "rotor_inertia" and not frames[k].mu:
                without.append(entry.source_text)
                continue
            result.effects.setdefault(effect, []).append(f"{k + 1}")
            result.add_parameter(f"{prefix}{k + 1}", entry)
    effects = [result.effects.get(effect, []) for effect in ("viscous", "coulomb")]
    friction_joints = {*itertools.chain(*effects)}
    actuated = [f"{k + 1}" for k in range(counts.links) if frames[k].mu]
    if offset := [name for name in actuated if name in friction_joints]:
        result.effects["offset"] = offset
        result.notes.append(f"added to the joints with friction: offset ({join_names(offset)})")
    if without:
        note = "left out, rotor inertias of joints without a motor (Mu 0)"
        result.notes.append(f"{join_names(without)}: {note}")


def _describe_omissions(statements: Statements, counts: Counts, result: Bodies) -> None:
    """Say what of the file has no place in a robot file."""
    if counts.floating:
        note = "the base stands still here, its own parameters are left out"
        result.notes.append(f"is_mobile, is_floating: {note}")
    forces = [key for key in FORCES if any(e != "0" for e in statements.get_entries(key))]
    springs = [key for key in ("eta", "k") if any(e != "0" for e in statements.get_entries(key))]
    states = [key for key in JOINTS[:3] if _has_numbers(statements.get_entries(key))]
    moves = [key for key in BASE[:4] if any(not _is_zero(e) for e in statements.get_entries(key))]
    if not _has_gravity(statements):  # VP0 is gravity then
        moves = [key for key in moves if key != "VP0"]
    for why, keys in (
        ("a robot file states no forces on links; see modeler effects external_force", forces),
        ("joints are rigid here", springs),
        ("they are a state, no robot", states),
        ("the base stands still here", moves),
    ):
        if keys:
            result.notes.append(f"{join_names(keys)} are left out: {why}")
    if statements.get_entries("Z") and list(statements.get_entries("Z")) != _IDENTITY:
        result.notes.append("Z is left out: frame 0 is where the robot starts")


def _has_numbers(entries: tuple[str, ...]) -> bool:
    return any(entry[:1] in "0123456789.+-" and not _is_zero(entry) for entry in entries)


def _is_zero(entry: str) -> bool:
    try:
        return float(entry) == 0
    except ValueError:
        return False


def _has_gravity(statements: Statements) -> bool:
    return any(not _is_zero(entry) for entry in statements.get_entries("G"))


def read_gravity_entries(statements: Statements, notes: list[str]) -> tuple[str, ...]:
    """Reads the entries of G; without it -VP0, and without both gravity along -z0."""
    if _has_gravity(statements):
        return statements.get_entries("G")
    base = statements.get_entries("VP0")
    if any(not _is_zero(entry) for entry in base):
        notes.append("gravity is -VP0: the file has it as an acceleration of the base")
        return tuple("0" if _is_zero(entry) else f"-({entry})" for entry in base)
    if statements.get_entries("G"):
        return statements.get_entries("G")
    notes.append("the file has no G: gravity is taken along -z0")
    return ("0", "0", "-9.81")


_NO_HOME = (
    "a .par file states no posture: [home] says near which one the loops are closed, and so which "
    "assembly mode is meant"
)


def convert_par_file(data: bytes, where: str) -> ConvertedRobot:
    """Returns the robot file that says what the SYMORO file says.

    Frames 1 .. NL are rows; frames NL + 1 .. NJ are rows without a body, each tied rigidly to its
    second frame NJ + 1 .. NF by a row of `[loops]`.

    Args:
        data: contents of the file.
        where: its name, for messages and the name of a robot that has none.

    Raises:
        RobotError: the file is wrong; says line, key, entry, what was got, what was expected.

    Source: W. Khalil, D. Creusot, SYMORO+: a system for the symbolic modelling of robots,
        Robotica 15, 1997; W. Khalil, E. Dombre, Modeling, identification and control of robots,
        2002, section 7.3 (closed chains).
    """
    statements = scan_statements(data, where)
    counts = read_counts(statements)
    frames = read_par_frames(statements, counts)
    symbols = Symbols()
    if not counts.loops and not any(frame.mu for frame in frames):  # it says nothing of motors
        for frame in frames:
            frame.mu = int(frame.variable_column is not None)
        symbols.notes.append("Mu is 0 for every joint: all are taken as actuated")
    names = find_joint_variables(frames, statements)
    other = [theirs for theirs, ours in names.items() if theirs != ours]
    if other:
        symbols.notes.append(f"joint variables are called q<row> here: {join_names(other)}")
    convert_table_cells(frames, counts, names, symbols, statements.place)
    links = read_bodies(statements, counts, frames)
    entries = read_gravity_entries(statements, symbols.notes)
    pull = convert_gravity(entries, symbols, statements.place)
    notes = [*symbols.notes, *links.notes, *([_NO_HOME] if counts.loops else [])]
    kind = statements.read_scalar("Type", "[012]", "0 (simple), 1 (tree) or 2 (closed)")
    if kind and (kind == "2") != bool(counts.loops):
        stated = f"Type is {kind}, but NJ - NL says"
        notes.append(f"{stated} that {counts.loops} joints are cut, which counts")
    name = choose_robot_name(statements.name, PurePath(where).stem)
    source = f"SYMORO file {PurePath(where).name}"
    head = format_head(name, statements.name, source, notes, pull)
    tables = _format_tables(symbols, counts, links, frames)
    return ConvertedRobot(join_lines([*head, *tables]), tuple(notes))


def _format_tables(symbols: Symbols, counts: Counts, links: Bodies, frames: Frames) -> list[str]:
    """`[symbols]` and all below."""
    rows = [
        TextRow(
            f"{frame.number}",
            f"{frame.antecedent}",
            frame.mu,
            frame.sigma,
            {c: "0" if frame.cells[c].is_zero else frame.cells[c].text for c in GEOMETRY},
        )
        for frame in frames
    ]
    loops = [  # every cut joint meets its second frame
        (f"cut{k + 1}", f"{counts.links + k + 1}", f"{counts.joints + k + 1}", "rigid")
        for k in range(counts.loops)
    ]
    has = [f"{name} = {format_name_list(keys)}" for name, keys in links.links.items()]
    actuated = [f"{frame.number}" for frame in frames if frame.mu]
    numbers = [f"{name} = {value!r}" for name, value in links.parameters.items()]
    return [
        *format_section("[symbols]", format_symbols(symbols.values, symbols.comments)),
        *format_mdh(rows),
        *format_loops(loops),
        *format_section(LINKS, has),
        *format_section("[effects]", format_effects(links.effects, actuated)),
        *format_section(PARAMETERS, numbers),
    ]
