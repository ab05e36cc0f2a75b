"""Motors that drive the joints through a coupling: `[motors]`, for logs of the motor side.

Every motor is a row of its own, without a link, and the joints follow the motors: q_m = G q_a, so
q_a = G^-1 q_m, and by virtual work tau_m = G^-T tau_a (Hanssen, Hovland and Brogardh 2000, section
5). Variables, torques, friction and rotor inertias of the robot are then those of the motors.
"""

import fnmatch
from collections.abc import Mapping, Sequence
from fractions import Fraction

from modeler.core.expression import format_decimal
from modeler.core.toml_cells import TomlCell, join_names, quote_value
from modeler.robot.cells import LARGEST_RATIO, check_name_length, normalise_row_name, read_joint_sum
from modeler.robot.conventions import Row, RowPlace
from modeler.robot.loops import MARK
from modeler.robot.robot import INERTIAL, Joint, JointKind, Robot, SharedParameter
from modeler.robot.sections import find_joint
from modeler.robot.table import HOME, ROW_NAME, Rows, read_row_kind

_EXAMPLE = '[motors] m1 = "q1", m2 = "q2 - 0.4*q1"'
_SIMPLE = 10**6  # largest denominator of a ratio that is taken as a fraction, such as 1/3

Ratios = Mapping[str, Mapping[str, Fraction]]
"""{motor: {joint: coefficient}}, the rows of G."""


def build_motor_rows(place: TomlCell, rows: Rows) -> Rows:
    """The rows of the motors, to stand below the table; the joints that they drive get mu 0.

    Raises:
        RobotError: a name that is taken or no name, a motor that drives no joint of the table.
    """
    taken = {row["j"]: (row, spot) for row, spot in rows}
    new_rows = []
    for name, here in place.read_items(_EXAMPLE):
        if not ROW_NAME.fullmatch(name) or name == "0":
            raise here.make_error('expected a name of letters and digits such as "m1"')
        check_name_length(name, here)
        if name in taken:
            raise here.make_error(
                f"row {quote_value(name)} of [mdh] has that name; call the motor m{name}: its "
                "columns "
                f"are then qm{name} and taum{name}"
            )
        expression = here.read_expression()
        joints = [
            taken[variable[1:]]
            for variable in sorted(expression.names)
            if variable.startswith("q") and variable[1:] in taken
        ]
        if not joints:
            raise here.make_error(
                f"got {quote_value(expression.text)}, without a joint variable; expected the "
                "position of "
                f"the motor as a sum of {join_names(f'q{row}' for row in taken)}"
            )
        sliding = all(read_row_kind(*joint) is JointKind.PRISMATIC for joint in joints)
        kind = JointKind.PRISMATIC if sliding else JointKind.REVOLUTE
        motor: Row = {
            "j": name, "a": "0", "mu": 1, "sigma": kind.value, HOME[kind]: f"q{name}",
        }  # fmt: skip
        new_rows.append((motor, RowPlace(here.file, here.location, row=name)))
        for joint, _ in joints:
            joint["mu"] = 0
    return tuple(new_rows)


def read_motors(
    place: TomlCell, rows: Rows, symbols: Mapping[str, float]
) -> tuple[Ratios, dict[str, str]]:
    """G, and the relations of the joints to the motors, as cells of `[relations]`.

    Args:
        place: the table `[motors]`.
        rows: of the table, those of the motors included.
        symbols: values of the declared symbols.

    Raises:
        RobotError: no sum of joint variables, not as many motors as joints, or a singular G.
    """
    table = place.read_table(_EXAMPLE)
    if not table:
        return {}, {}
    names = [row["j"] for row, _ in rows if row["j"] not in table]
    variables = {f"q{name}": name for name in names}
    ratios: dict[str, dict[str, Fraction]] = {}
    for motor, here in place.read_items(_EXAMPLE):
        expression = here.read_expression()
        only = ": the motor reads 0 where the joints do"
        form = read_joint_sum(expression, symbols, variables, here, "q2 - 0.4*q1", only)
        ratios[motor] = {
            variables[name]: _recover_fraction(c) for name, c in form.coefficients.items()
        }
    joints = [name for name in names if any(name in row for row in ratios.values())]
    if len(ratios) != len(joints):
        raise place.make_error(
            f"got {len(ratios)} motors ({join_names(list(ratios))}) for the {len(joints)} joints "
            f"{join_names(joints)}; expected one motor for each joint"
        )
    inverse = _compute_checked_inverse(ratios, joints, place)
    return ratios, {
        f"q{joint}": _format_sum({f"q{motor}": c for motor, c in zip(ratios, row, strict=True)})
        for joint, row in zip(joints, inverse, strict=True)
    }


def check_driven(robot: Robot, place: TomlCell) -> None:
    """Refuse joints with a motor of their own beside those of `[motors]`.

    Raises:
        RobotError: names the first.
    """
    others = [j.name for j in robot.free_joints if j.actuated and j.name not in robot.motors]
    if robot.motors and others:
        raise place.make_error(
            f"no motor turns with q{others[0]}, which has one; expected every joint with a motor "
            f'in some sum; add m{others[0]} = "q{others[0]}", or write mu 0 in its row'
        )


def compute_joint_directions(robot: Robot) -> dict[str, tuple[float, ...]]:
    """How fast the coordinates move when one joint moves alone at speed 1: columns of G.

    Unit vectors where the coordinates are the joints themselves. Joints in table order, entries in
    the order of `robot.coordinates`.
    """
    coordinates = [joint.name for joint in robot.coordinates]
    if not robot.motors:
        return {name: tuple(float(name == other) for other in coordinates) for name in coordinates}
    joints = [j.name for j in robot.joints if any(j.name in row for row in robot.motors.values())]
    return {
        joint: tuple(robot.motors[motor].get(joint, 0.0) for motor in coordinates)
        for joint in joints
    }


def _recover_fraction(value: float) -> Fraction:
    """1/3 as it was meant, 0.4 as it was written."""
    simple = Fraction(value).limit_denominator(_SIMPLE)
    return simple if float(simple) == value else Fraction(repr(value))


def _compute_checked_inverse(
    ratios: Ratios, joints: Sequence[str], place: TomlCell
) -> list[list[Fraction]]:
    """G^-1.

    Raises:
        RobotError: G is singular, or so nearly that joints outrun the motors.
    """
    rows = [[row.get(joint, Fraction(0)) for joint in joints] for row in ratios.values()]
    inverse = _invert_exactly(rows)
    if inverse is None:
        raise place.make_error(
            f"{_format_ratios(ratios)}: singular, some motion of {join_names(joints)} turns no "
            "motor; "
            "expected motors whose positions tell those of all joints; correct the coefficients"
        )
    largest = max(abs(c) for row in inverse for c in row)
    if largest > LARGEST_RATIO:
        raise place.make_error(
            f"{_format_ratios(ratios)}: nearly singular, a joint moves {float(largest):.3g} times "
            "as far "
            f"as a motor; expected at most {LARGEST_RATIO:g}; correct the coefficients"
        )
    return inverse


def _invert_exactly(matrix: Sequence[Sequence[Fraction]]) -> list[list[Fraction]] | None:
    """The exact inverse by Gauss and Jordan; None of a singular matrix."""
    n = len(matrix)
    work = [[*row, *(Fraction(i == j) for j in range(n))] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if work[i][k] != 0), None)
        if pivot is None:
            return None
        work[k], work[pivot] = work[pivot], work[k]
        work[k] = [entry / work[k][k] for entry in work[k]]
        for i in range(n):
            if i != k and work[i][k] != 0:
                work[i] = [a - work[i][k] * b for a, b in zip(work[i], work[k], strict=True)]
    return [row[n:] for row in work]


def _format_sum(terms: Mapping[str, Fraction]) -> str:
    """`0.4*qm1 + qm2`."""
    text = " + ".join(
        name if c == 1 else f"-{name}" if c == -1 else f"{format_decimal(c) or c}*{name}"
        for name, c in terms.items()
        if c
    )
    return text.replace("+ -", "- ")


def _format_ratios(ratios: Ratios) -> str:
    return ", ".join(
        f"{motor} = {_format_sum({f'q{joint}': c for joint, c in row.items()})}"
        for motor, row in ratios.items()
    )


# Links that have not all ten parameters, and parameters that similar legs share.


def read_links(place: TomlCell, moving: Mapping[str, Joint]) -> dict[str, tuple[str, ...]]:
    """Inertial parameters of the rows that have not all ten: `[links] 5 = []`, `P = ["M"]`.

    Raises:
        RobotError: unknown rows or parameters.
    """
    links = {}
    for name, here in place.read_items('[links] 5 = [], P = ["M"]'):
        find_joint(name, moving, here)
        entries = here.read_list('["M"]')
        for entry in entries:
            if entry not in INERTIAL:
                raise here.make_error(
                    f"got {quote_value(entry)}; expected some of {join_names(INERTIAL)}"
                )
        links[name] = tuple(prefix for prefix in INERTIAL if prefix in entries)
    return links


def read_shared(
    place: TomlCell, known: Sequence[str], legs: Sequence[str]
) -> tuple[SharedParameter, ...]:
    """Parameters that the legs have in common: `shared = ["*2{i}"]` makes XX2 of XX21, XX22, XX23.

    Raises:
        RobotError: patterns without {i} or without a parameter, a name that is taken.
    """
    shared_parameters: dict[str, SharedParameter] = {}
    for entry in place.read_list('["*2{i}", "*3{i}"]'):
        pattern = place.with_value(normalise_row_name(entry)).read_text('"*2{i}"')
        if MARK not in pattern or not legs:
            raise place.make_error(
                f'got {quote_value(pattern)}; expected {MARK} in it and legs = ["1", "2"] at the '
                "top"
            )
        first = pattern.replace(MARK, legs[0])
        stem = pattern.split(MARK)[0].rsplit("*", 1)[-1]
        matching = [name for name in known if fnmatch.fnmatchcase(name, first)]
        if not matching:
            raise place.make_error(
                f"{quote_value(pattern)} matches no parameter of leg {legs[0]}; expected names or "
                f"patterns of {join_names(known[:12])} ..."
            )
        for name in matching:
            head = name[: len(name) - len(first.rsplit("*", 1)[-1])]
            shared_name = head + stem + pattern.split(MARK)[1]
            members = tuple(head + stem + leg + pattern.split(MARK)[1] for leg in legs)
            for member in members:
                if member not in known:
                    raise place.make_error(
                        f"{quote_value(members[0])} has no counterpart {quote_value(member)}; "
                        "share what all "
                        "legs have"
                    )
            if shared_name in known:
                raise place.make_error(
                    f"{quote_value(shared_name)} would be shared by the legs and is a parameter "
                    "already; rename "
                    "that row"
                )
            shared_parameters[shared_name] = SharedParameter(shared_name, members)
    return tuple(shared_parameters.values())


def merge_shared_names(known: Sequence[str], shared: Sequence[SharedParameter]) -> tuple[str, ...]:
    """The parameters' names with shared ones once, where their first member stood."""
    first = {parameter.members[0]: parameter.name for parameter in shared}
    merged_names = {member for parameter in shared for member in parameter.members[1:]}
    return tuple(first.get(name, name) for name in known if name not in merged_names)
