"""Values of physical parameters as people give them: "am=12+-0.1,bm=6", or a CAD file."""

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler.core.errors import RobotError
from modeler.core.files import read_text
from modeler.core.json_text import parse_toml
from modeler.robot import Robot
from modeler.robot.place import near
from modeler.terms.physical_system import PhysicalSystem
from modeler.terms.printed import read_print

_CAD_KEY = "relative_sigma"


@dataclass(frozen=True)
class Given:
    """Parameters that somebody knows.

    Attributes:
        names: in the order given.
        values: of those that came with one, SI units.
        sigmas: standard deviations of those that came with one.
    """

    names: tuple[str, ...]
    values: Mapping[str, float]
    sigmas: Mapping[str, float]


def given_from_text(text: str, system: PhysicalSystem, where: str = "--known") -> Given:
    """Reads "am=12,bm=6+-0.1,bl1".

    Raises:
        RobotError: an unknown or repeated name, no number, or that of no body.
    """
    values: dict[str, float] = {}
    sigmas: dict[str, float] = {}
    names: list[str] = []
    for piece in filter(None, (part.strip() for part in text.split(","))):
        name, equals, rest = (part.strip() for part in piece.partition("="))
        check_letter(name, system, where)
        if name in names:
            raise RobotError(f"{where}: {name} is given twice; expected each parameter once")
        names.append(name)
        if equals:
            value, spread, sigma = rest.replace("±", "+-").partition("+-")
            values[name] = _possible(name, _number(value, f"{where}, {name}"), system, where)
            if spread:
                sigmas[name] = _sigma(sigma, f"{where}, {name}")
    effective = tuple(name for name in names if name in system.letters)
    return Given(
        effective,
        {name: values[name] for name in effective if name in values},
        {name: sigmas[name] for name in effective if name in sigmas},
    )


def check_letter(name: str, system: PhysicalSystem, where: str) -> None:
    """Refuse what is no physical parameter or length of the robot.

    Raises:
        RobotError: tells what it may have meant.
    """
    names = (*system.letters, *system.vanishing, *system.alone, *system.constants)
    if name not in names:
        raise RobotError(
            f'{where}: got "{name}"{near(name, names)}; expected physical parameters of '
            f"{system.robot}: {', '.join(system.letters)}"
        )


def _number(text: Any, where: str) -> float:
    try:
        value = float(text)
    except (TypeError, ValueError):
        value = math.nan
    if isinstance(text, bool) or not math.isfinite(value):
        raise RobotError(f"{where}: got {text!r}; expected a finite number, SI units")
    return value


def _possible(name: str, value: float, system: PhysicalSystem, where: str) -> float:
    if name in system.masses and value <= 0.0:
        raise RobotError(f"{where}, {name}: got the mass {value:g} kg; expected more than 0")
    if name in system.moments and value < 0.0:
        raise RobotError(f"{where}, {name}: got the moment {value:g} kg m^2; expected 0 or more")
    return value


def _sigma(text: Any, where: str) -> float:
    value = _number(text, f"{where}, standard deviation")
    if value < 0.0:
        raise RobotError(f"{where}: got the standard deviation {value:g}; expected 0 or more")
    return value


def cad_from_file(path: Path, system: PhysicalSystem) -> Given:
    """Reads a TOML file: `am = 12.0`, `bm = [6.0, 0.1]` with a standard deviation.

    `relative_sigma = 0.02` gives every value without one that share of itself.

    Raises:
        RobotError: no such file, no TOML, an unknown name, no number.
    """
    try:
        raw = parse_toml(read_text(path))
    except OSError as error:
        raise RobotError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    except ValueError as error:
        raise RobotError(f"{path}: no TOML ({error}); expected lines such as am = 12.0") from None
    share = _sigma(raw.pop(_CAD_KEY, 0.0), f"{path}, {_CAD_KEY}")
    values: dict[str, float] = {}
    sigmas: dict[str, float] = {}
    for name, cell in raw.items():
        check_letter(name, system, str(path))
        where = f"{path}, {name}"
        if isinstance(cell, list):
            if len(cell) != 2:
                raise RobotError(f"{where}: got {cell}; expected [value, standard deviation]")
            values[name], sigmas[name] = _number(cell[0], where), _sigma(cell[1], where)
        else:
            values[name] = _number(cell, where)
            sigmas[name] = share * abs(values[name])
    return _among(values, sigmas, system, str(path))


def cad_from_robot(robot: Robot, system: PhysicalSystem, where: str) -> Given:
    """The example of the robot file, `[terms.example]`; lengths that it leaves out are nominal.

    Raises:
        RobotError: it has none.
    """
    example = read_print(robot).example
    if not example:
        raise RobotError(
            f"{where}: the robot file has no values of physical parameters ([terms.example]); "
            "give a file, such as --cad cad.toml"
        )
    values = robot.symbol_values() | {name: float(value) for name, value in example.items()}
    return _among(values, {}, system, where)


def _among(
    values: Mapping[str, float], sigmas: Mapping[str, float], system: PhysicalSystem, where: str
) -> Given:
    kept: Collection[str] = [name for name in values if name in system.letters]
    if not kept:
        raise RobotError(
            f"{where}: no value of a parameter with an effect on the torques; expected some of "
            f"{', '.join(system.letters)}"
        )
    return Given(
        tuple(kept),
        {name: values[name] for name in kept},
        {name: sigmas[name] for name in kept if sigmas.get(name, 0.0) > 0.0},
    )
