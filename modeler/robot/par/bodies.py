"""What a `.par` file says of the links: which parameters they have, values, friction, rotors."""

from dataclasses import dataclass, field

from modeler.robot.par.formula import Formula, formula
from modeler.robot.par.frames import Counts, Frame
from modeler.robot.par.scan import BASE, FORCES, FRICTION, INERTIA, JOINTS, Statements
from modeler.robot.place import listed

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
    """

    links: dict[str, list[str]] = field(default_factory=dict)
    parameters: dict[str, float] = field(default_factory=dict)
    effects: dict[str, list[str]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def bodies(statements: Statements, found: Counts, made: list[Frame]) -> Bodies:
    """The parameters of links 1 .. NL, and what is left out.

    A parameter that is 0 beside letters is one that the link has not; beside numbers only, a
    value. Cut joints carry nothing.

    Raises:
        RobotError: an entry is no formula.
    """
    result = Bodies()
    others = []
    for k in range(found.links):
        cells = {key: _cell(statements, key, k, found) for key in INERTIA}
        if made[k].home is None:
            if any(key in statements.by_key and not cells[key].is_zero for key in INERTIA):
                result.notes.append(
                    f"parameters of frame {k + 1} are left out: it is fixed (Sigma 2), count them "
                    f"to link {made[k].antecedent}"
                )
            continue
        has = [key for key, cell in cells.items() if not cell.is_zero]
        if has and all(cell.literal is not None for cell in cells.values()):
            has = list(INERTIA)
        if len(has) < len(INERTIA):
            result.links[f"{k + 1}"] = has
        for key in has:
            others += _parameter(f"{key}{k + 1}", cells[key], result)
    for j in range(found.links, found.joints):
        if made[j].home is not None:
            result.links[f"{j + 1}"] = []
    others += _effects(statements, found, made, result)
    if others:
        result.notes.append(f"parameters that are not letters of their own: {listed(others)}")
    _left_out(statements, found, result)
    return result


def _cell(statements: Statements, key: str, k: int, found: Counts) -> Formula:
    statement = statements.by_key.get(key)
    if statement is None:
        return formula(f"{key}{k + 1}", statements.place)
    k += found.floating
    return formula(statement.entries[k], statement.entry_place(k + 1))


def _parameter(name: str, cell: Formula, result: Bodies) -> list[str]:
    """Keep the value; the name with what the file has for it, if that is another letter."""
    if cell.literal is not None:
        result.parameters[name] = float(cell.literal)
        return []
    same = cell.text.lower() == name.lower()
    return [] if same else [f"{name} (there {cell.written})"]


def _effects(statements: Statements, found: Counts, made: list[Frame], result: Bodies) -> list[str]:
    others: list[str] = []
    without = []
    for key in FRICTION:
        effect, prefix = _EFFECT[key]
        if key not in statements.by_key:
            continue
        for k in range(found.links):
            cell = _cell(statements, key, k, found)
            if cell.is_zero or made[k].home is None:
                continue
            if effect == "rotor_inertia" and not made[k].mu:
                without.append(cell.written)
                continue
            result.effects.setdefault(effect, []).append(f"{k + 1}")
            others += _parameter(f"{prefix}{k + 1}", cell, result)
    if without:
        result.notes.append(
            f"{listed(without)}: left out, rotor inertias of joints without a motor (Mu 0)"
        )
    return others


def _left_out(statements: Statements, found: Counts, result: Bodies) -> None:
    """Say what of the file has no place in a robot file."""
    if found.floating:
        result.notes.append(
            "is_mobile, is_floating: the base stands still here, its own parameters are left out"
        )
    forces = [key for key in FORCES if any(e != "0" for e in statements.entries(key))]
    if forces:
        result.notes.append(
            f"{listed(forces)} are left out: a robot file states no forces on links; see "
            "modeler effects external_force"
        )
    springs = [key for key in ("eta", "k") if any(e != "0" for e in statements.entries(key))]
    if springs:
        result.notes.append(f"{listed(springs)} are left out: joints are rigid here")
    states = [key for key in JOINTS[:3] if _has_numbers(statements.entries(key))]
    if states:
        result.notes.append(f"{listed(states)} are left out: they are a state, no robot")
    moves = [key for key in BASE[:4] if any(not _zero(e) for e in statements.entries(key))]
    moves = [key for key in moves if key != "VP0" or _states_gravity(statements)]
    if moves:
        result.notes.append(f"{listed(moves)} are left out: the base stands still here")
    if statements.entries("Z") and list(statements.entries("Z")) != _IDENTITY:
        result.notes.append("Z is left out: frame 0 is where the robot starts")


def _has_numbers(entries: tuple[str, ...]) -> bool:
    return any(entry[:1] in "0123456789.+-" and not _zero(entry) for entry in entries)


def _zero(entry: str) -> bool:
    try:
        return float(entry) == 0
    except ValueError:
        return False


def _states_gravity(statements: Statements) -> bool:
    return any(not _zero(entry) for entry in statements.entries("G"))


def gravity_entries(statements: Statements, notes: list[str]) -> tuple[str, ...]:
    """G; -VP0 where the file has gravity as an acceleration of the base; downwards without both."""
    if _states_gravity(statements):
        return statements.entries("G")
    base = statements.entries("VP0")
    if any(not _zero(entry) for entry in base):
        notes.append("gravity is -VP0: the file has it as an acceleration of the base")
        return tuple("0" if _zero(entry) else f"-({entry})" for entry in base)
    if statements.entries("G"):
        return statements.entries("G")
    notes.append("the file has no G: gravity is taken along -z0")
    return ("0", "0", "-9.81")
