"""What a robot file says in `[terms]`: how a paper prints its coefficients.

Keys, all optional:

* `source`: the citation.
* `keep_sine_squares = ["J11"]`: functions printed with squares of sines, not of cosines.
* `[terms.monomials]`: function -> its monomials in the paper's order, by which coefficients are
  numbered; coefficients that the paper lacks are called by `missing = "PX"`.
* `[terms.printed]`: the print letter by letter, to be checked: `count` of coefficients,
  `independent` coefficients, `vanishing` parameters, and the tables `functions`, `definitions`,
  `solutions` (a fraction as [numerator, denominator]).
* `[terms.printed.coupling]`: an example at which a printed Coulomb friction G_ii C_i sgn(qd_i) is
  tried: `motor_from_joint` (rows of G, from joint to motor speeds), `coulomb` (C), `speed` (qd).
* `[terms.example]` and `[terms.twin]`: two sets of physical parameters, as exact fractions.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from modeler.core.errors import RobotError
from modeler.core.expression import Expression, ExpressionError, parse_expression
from modeler.robot import Robot

_KEYS = ("source", "keep_sine_squares", "missing", "monomials", "printed", "example", "twin",
         "triads")  # fmt: skip
_COUPLING = ("motor_from_joint", "coulomb", "speed")
_PRINTED = (
    "count",
    "independent",
    "vanishing",
    "functions",
    "definitions",
    "solutions",
    "coupling",
)


@dataclass(frozen=True)
class Coupling:
    """Motors that turn with several joints, and one motion.

    Attributes:
        motor_from_joint: G, rows of motors: motor speed = G qd.
        coulomb: (motors,) N m.
        speed: (joints,) rad/s.
    """

    motor_from_joint: tuple[tuple[Fraction, ...], ...]
    coulomb: tuple[Fraction, ...]
    speed: tuple[Fraction, ...]


@dataclass(frozen=True)
class PrintedTerms:
    """`[terms]` of a robot file, read.

    Attributes:
        source: citation, "" if there is none.
        missing: prefix of coefficients that the paper lacks.
        monomials: function -> monomials in printed order; empty if the file gives none.
        count: number of coefficients that the paper counts; None if it does not say.
        independent: coefficients that the paper calls independent.
        vanishing: parameters that vanish, in the paper's letters.
        functions: function -> as printed.
        definitions: coefficient -> as printed.
        solutions: physical parameter -> (numerator, denominator) as printed.
        example: physical parameters of an example.
        twin: changes to it which, the robot file claims, leave all coefficients as they are.
        coupling: an example of motors that turn with several joints.
    """

    source: str = ""
    missing: str = "PX"
    monomials: Mapping[str, tuple[Expression, ...]] = field(default_factory=dict)
    count: int | None = None
    independent: tuple[str, ...] = ()
    vanishing: tuple[str, ...] = ()
    functions: Mapping[str, Expression] = field(default_factory=dict)
    definitions: Mapping[str, Expression] = field(default_factory=dict)
    solutions: Mapping[str, tuple[Expression, Expression]] = field(default_factory=dict)
    example: Mapping[str, Fraction] = field(default_factory=dict)
    twin: Mapping[str, Fraction] = field(default_factory=dict)
    coupling: Coupling | None = None


def read_printed_terms(robot: Robot) -> PrintedTerms:
    """Reads `[terms]` of the robot.

    Raises:
        RobotError: an unknown key, or a value of the wrong kind; says where and what is expected.
    """
    where = f"robot {robot.name}, [terms]"
    terms = _check_table(robot.terms, where, _KEYS)
    printed = _check_table(terms.get("printed", {}), f"{where}, printed", _PRINTED)
    count = printed.get("count")
    if count is not None and (isinstance(count, bool) or not isinstance(count, int)):
        raise RobotError(f"{where}, printed, count: got {count!r}; expected a number such as 96")
    return PrintedTerms(
        source=_check_text(terms.get("source", ""), f"{where}, source"),
        missing=_check_text(terms.get("missing", "PX"), f"{where}, missing"),
        monomials={
            name: tuple(
                _parse_expression(x, f"{where}, monomials, {name}")
                for x in _check_list(cell, where)
            )
            for name, cell in _check_table(
                terms.get("monomials", {}), f"{where}, monomials"
            ).items()
        },
        count=count,
        independent=_parse_names(printed.get("independent", []), f"{where}, printed, independent"),
        vanishing=_parse_names(printed.get("vanishing", []), f"{where}, printed, vanishing"),
        functions=_parse_expressions(printed, "functions", where),
        definitions=_parse_expressions(printed, "definitions", where),
        solutions=_parse_solutions(printed, where),
        example=_parse_numbers(terms.get("example", {}), f"{where}, example"),
        twin=_parse_numbers(terms.get("twin", {}), f"{where}, twin"),
        coupling=_parse_coupling(printed, f"{where}, printed, coupling"),
    )


def _parse_coupling(printed: Mapping[str, Any], where: str) -> Coupling | None:
    if "coupling" not in printed:
        return None
    table = _check_table(printed["coupling"], where, _COUPLING)
    for key in _COUPLING:
        if key not in table:
            raise RobotError(f"{where}: {key} is missing; expected {', '.join(_COUPLING)}")
    speed = _parse_row(table["speed"], f"{where}, speed")
    coulomb = _parse_row(table["coulomb"], f"{where}, coulomb")
    place = f"{where}, motor_from_joint"
    rows = tuple(_parse_row(row, place) for row in _check_list(table["motor_from_joint"], place))
    if {len(rows), len(coulomb), *(len(row) for row in rows)} != {len(speed)}:
        raise RobotError(
            f"{where}: got {len(rows)} rows of {', '.join(str(len(row)) for row in rows)}, "
            f"{len(coulomb)} coulomb, {len(speed)} speed; expected as many motors as joints"
        )
    return Coupling(rows, coulomb, speed)


def _parse_row(value: Any, where: str) -> tuple[Fraction, ...]:
    cells = {f"entry {i}": cell for i, cell in enumerate(_check_list(value, where), start=1)}
    return tuple(_parse_numbers(cells, where).values())


def _check_table(value: Any, where: str, keys: tuple[str, ...] = ()) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise RobotError(f"{where}: got {value!r}; expected a table of names")
    for key in value:
        if keys and key not in keys:
            raise RobotError(f"{where}: unknown key {key}; expected {', '.join(keys)}")
    return value


def _check_list(value: Any, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise RobotError(f'{where}: got {value!r}; expected a list such as ["s1*s2", "c1"]')
    return value


def _check_text(value: Any, where: str) -> str:
    if not isinstance(value, str):
        raise RobotError(f"{where}: got {value!r}; expected text")
    return value


def _parse_names(value: Any, where: str) -> tuple[str, ...]:
    return tuple(_check_text(entry, where) for entry in _check_list(value, where))


def _parse_expression(value: Any, where: str) -> Expression:
    try:
        return parse_expression(value)
    except ExpressionError as error:
        raise RobotError(f"{where}: {error}") from None


def _parse_expressions(printed: Mapping[str, Any], key: str, where: str) -> dict[str, Expression]:
    here = f"{where}, printed, {key}"
    table = _check_table(printed.get(key, {}), here)
    return {name: _parse_expression(cell, f"{here}, {name}") for name, cell in table.items()}


def _parse_solutions(
    printed: Mapping[str, Any], where: str
) -> dict[str, tuple[Expression, Expression]]:
    here = f"{where}, printed, solutions"
    solutions = {}
    for name, cell in _check_table(printed.get("solutions", {}), here).items():
        parts = cell if isinstance(cell, list) else [cell, 1]
        if len(parts) != 2:
            raise RobotError(
                f"{here}, {name}: got {len(parts)} entries; expected [numerator, denominator]"
            )
        above, below = (_parse_expression(part, f"{here}, {name}") for part in parts)
        solutions[name] = (above, below)
    return solutions


def _parse_numbers(value: Any, where: str) -> dict[str, Fraction]:
    numbers = {}
    for name, cell in _check_table(value, where).items():
        try:
            numbers[name] = Fraction(cell if isinstance(cell, str) else repr(cell))
        except (ValueError, ZeroDivisionError):
            raise RobotError(
                f'{where}, {name}: got {cell!r}; expected a number such as 12 or "1063/52500"'
            ) from None
    return numbers
