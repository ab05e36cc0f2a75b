"""The tables of a robot file that name joints: effects, coupling, drives, limits, links."""

import math
from collections.abc import Collection, Iterator, Mapping
from typing import Any, get_args

from modeler.core.choices import GAIN_METHOD, TWO_STEPS, Derivatives, Method
from modeler.core.expression import Expression
from modeler.core.manifest import DriveSpec
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.robot.cells import Values, normalise_row_name, read_joint_sum, read_number
from modeler.robot.robot import Joint, Limits, LinkCapsule, LinkFrame, PhysicalLink, Robot
from modeler.robot.thresholds import THRESHOLDS

Coupling = dict[str, dict[str, float]]
Joints = Mapping[str, Joint]
"""Moving joints by name."""
_Three = tuple[Expression, Expression, Expression]

INERTIAL_UNCERTAINTY = "inertial"
"""What stands for every body in `[parameters.uncertainty]`."""


def find_joint(name: Any, moving: Joints, place: TomlCell) -> Joint:
    """Returns the moving joint of that name.

    Raises:
        RobotError: no such joint; lists those there are.
    """
    key = normalise_row_name(name)
    if not isinstance(key, str) or key not in moving:
        raise place.make_error(
            f"there is no moving joint {quote_value(name)}{suggest_name(key, moving)}; expected "
            f"one of {join_names(moving)}"
        )
    return moving[key]


def _iterate_joints(
    place: TomlCell, moving: Joints, example: str
) -> Iterator[tuple[Joint, TomlCell]]:
    """The joints that a table names, each with its cell.

    Raises:
        RobotError: no table, or a name of no moving joint.
    """
    for name, here in place.read_items(example):
        yield find_joint(name, moving, here), here


def read_coupling(place: TomlCell, moving: Joints, symbols: Values) -> Coupling:
    """Returns motors that turn with several joints: {joint of the motor: {joint: coefficient}}.

    Raises:
        RobotError: unknown joints, or a speed that is not a sum of joint variables.
    """
    coupling: Coupling = {}
    for motor, here in _iterate_joints(place, moving, '[coupling] "6" = "q5 + q6"'):
        expression = here.read_expression()
        variables = {joint.variable: joint for joint in moving.values()}
        only = ', such as "q5 + q6"'
        form = read_joint_sum(expression, symbols, variables, here, "q5 + q6", only)
        if motor.variable not in form.coefficients:
            raise here.make_error(
                f"got {quote_value(expression.text)}, without {motor.variable}; the motor of joint "
                f"{motor.name} must turn with its own joint"
            )
        coupling[motor.name] = {
            joint.name: form.coefficients[variable]
            for variable, joint in variables.items()
            if variable in form.coefficients
        }
    return coupling


def read_numbers(
    place: TomlCell, known: Collection[str], table: str, expected: str
) -> dict[str, float]:
    """Returns values of standard parameters: `[parameters]` or `[reference]`.

    Args:
        place: the table.
        known: names of the parameters that the robot has.
        table: its head.
        expected: what to write for a name that is unknown.

    Raises:
        RobotError: an unknown parameter, or no number.
    """
    values = {}
    for name, cell in place.read_table(f"{table} ZZ1 = 0.5").items():
        if name not in known:
            raise place.make_error(
                f"there is no parameter {quote_value(name)}{suggest_name(name, known)}; expected "
                f"{expected}"
            )
        values[name] = place.enter(name, cell).read_number("0.5")
    return values


def read_parameters(
    place: TomlCell, known: Collection[str], expected: str
) -> tuple[dict[str, float], dict[str, float]]:
    """Returns values of standard parameters, and their uncertainty: `[parameters]`.

    Args:
        place: the table.
        known: names of the parameters that the robot has.
        expected: what to write for a name that is unknown.

    Returns:
        Values, and standard deviations by name: 0 of those that are held; under "inertial" that of
        every body, over its scale.

    Raises:
        RobotError: an unknown parameter, no number, or a warning about a value that is not stated.
    """
    table = dict(place.read_table("[parameters] ZZ1 = 0.5"))
    inner = place.enter("uncertainty").with_value(table.pop("uncertainty", {}))
    inner = TomlCell(place.file, "[parameters.uncertainty]", inner.value)
    uncertainty_table = dict(inner.read_table("[parameters.uncertainty] inertial = 0.10"))
    entries = [(place, table.pop("held", [])), (inner, uncertainty_table.pop("held", []))]
    held = {
        here.enter("held").with_value(name).read_text('"Ia3"'): here
        for here, names in entries
        for name in here.enter("held").with_value(names).read_list('held = ["Ia3"]')
    }
    values = read_numbers(place.with_value(table), known, "[parameters]", expected)
    uncertainty = {}
    for name, cell in uncertainty_table.items():
        here = inner.enter(name, cell)
        uncertainty[name] = here.read_number("0.1")
        if uncertainty[name] <= 0.0:
            expected = "a standard deviation above 0; a value that is certain is held"
            raise here.make_mismatch(expected)
        if name != INERTIAL_UNCERTAINTY:
            _check_stated(name, values, known, here)
        elif uncertainty[name] > 1.0:
            raise here.make_mismatch("a share of 1 at most, such as 0.10 for 10 %")
        elif not any(name.startswith("M") for name in values):
            raise here.make_error(
                "got no body to which it applies; state masses, first moments and inertias in "
                "[parameters], such as M1 = 4.0"
            )
    for name, here in held.items():
        _check_stated(name, values, known, here.enter("held"))
        if name in uncertainty:
            raise here.enter("held").make_error(
                f"{quote_value(name)} has an uncertainty too; expected one of both: leave one out"
            )
    return values, uncertainty | dict.fromkeys(held, 0.0)


def _check_stated(name: str, values: Values, known: Collection[str], place: TomlCell) -> None:
    """Refuse a name without a value."""
    if name not in known:
        raise place.make_error(
            "there is no parameter "
            f"{quote_value(name)}{suggest_name(name, [*known, INERTIAL_UNCERTAINTY])}; "
            f"expected names of [parameters], or {INERTIAL_UNCERTAINTY} for every body"
        )
    if name not in values:
        raise place.make_error(f"{name} has no value; write {name} = ... in [parameters]")


def read_drive_gains(place: TomlCell, moving: Joints) -> dict[str, float]:
    """Returns joint torque per unit of the logged current, by joint.

    Raises:
        RobotError: unknown joint, or a gain that is no number or zero.
    """
    gains = {}
    for joint, here in _iterate_joints(place, moving, '[drive_gains] "1" = 12.5'):
        gains[joint.name] = _read_gain(here)
    return gains


def _read_gain(place: TomlCell) -> float:
    gain = place.read_number("12.5")
    if gain == 0.0:
        raise place.make_error(
            "got 0; expected joint torque per unit of logged current, not zero; leave the "
            "joint out if its gain is unknown"
        )
    return gain


_DRIVE_KEYS = ("voltage", "resistance", "k_e", "gain")
_DRIVE = "1 = {voltage = 12, resistance = 4.4, k_e = 2.4, gain = 1.1}"


def read_drives(
    place: TomlCell, moving: Joints, gains: Values, readings: list[str]
) -> tuple[dict[str, float], dict[str, DriveSpec]]:
    """Returns gains and voltage models: `[drives]`.

    Args:
        place: the table.
        moving: joints.
        gains: of `[drive_gains]`.
        readings: grows by what is reported about gains that no motor has.

    Returns:
        All gains, those given too, and the voltage models, by joint.

    Raises:
        RobotError: unknown joint or key, a gain that is missing, zero, or stated twice, a voltage
            without a resistance or the other way round, or numbers that no motor has.
    """
    all_gains, drives = dict(gains), dict[str, DriveSpec]()
    for joint, here in _iterate_joints(place, moving, f"[drives] {_DRIVE}"):
        table = here.read_checked_table(_DRIVE_KEYS, f"[drives] {_DRIVE}")
        numbers = {key: here.enter(key, value).read_number("1.1") for key, value in table.items()}
        if joint.name in gains:
            raise here.make_error(
                f"joint {joint.name} stands in [drive_gains] too; expected one of both: move its "
                "number here, as gain"
            )
        if "gain" not in numbers:
            raise here.make_error(
                f"gain is missing; write joint torque per unit of current, as in {_DRIVE}; 1 if it "
                "is unknown: torques are in units of the drive then"
            )
        gain = all_gains[joint.name] = _read_gain(here.enter("gain", table["gain"]))
        if set(numbers) == {"gain"}:
            continue
        for key in ("voltage", "resistance"):
            if numbers.get(key, 0.0) <= 0.0:
                raise here.enter(key, table.get(key, 0)).make_mismatch(
                    f"a number above 0, as in {_DRIVE}; a drive that logs currents has gain alone"
                )
        voltage, resistance, k_e = (numbers.get(key, 0.0) for key in _DRIVE_KEYS[:3])
        drive = drives[joint.name] = DriveSpec(voltage, resistance, k_e)
        if drive.k_e * gain < 0.0:
            raise here.enter("k_e", table["k_e"]).make_mismatch(
                f"the sign of gain ({gain:g}): what a motor induces brakes it"
            )
        if abs(gain) > THRESHOLDS.max_gain_over_k_e * abs(drive.k_e) > 0.0:
            readings.append(
                f"{here.location}: a gain of {gain:g} is {gain / drive.k_e:.3g} times k_e; without "
                "losses both are one number: is k_e that of the joint (times the gear ratio)?"
            )
    return all_gains, drives


_SHARE, _POSITIVE = "a share from 0 to 1, such as 0.05", "a number of 0 or more, such as 20"
FIT_OPTIONS: Mapping[str, str | tuple[str, ...]] = {
    "cutoff": _POSITIVE,
    "parallel_cutoff": _POSITIVE,
    "decimate": "a whole number from 1",
    "derivatives": get_args(Derivatives),
    "low_speed": _SHARE,
    "method": (*get_args(Method), GAIN_METHOD, TWO_STEPS),
    "model": ("torque", "energy"),
    "window": _POSITIVE,
    "essential_below": _POSITIVE,
    "keep_saturated": "true or false",
    "keep_contradicted": "true or false",
    "keep_damaged": "true or false",
}
"""What `[fit]` may hold, by names of options of `modeler fit`: words, or what is expected."""


def read_fit(place: TomlCell) -> dict[str, Any]:
    """Returns options of `modeler fit` that this robot needs always: `[fit]`.

    Raises:
        RobotError: an unknown option, or a value that it cannot have.
    """
    table = place.read_checked_table(FIT_OPTIONS, "[fit] cutoff = 20")
    for name, value in table.items():
        here, expected = place.enter(name, value), FIT_OPTIONS[name]
        number = isinstance(value, int | float) and not isinstance(value, bool)
        is_valid = {
            "true or false": isinstance(value, bool),
            _POSITIVE: number and 0.0 <= value < math.inf,
            _SHARE: number and 0.0 <= value < 1.0,
        }.get(expected, isinstance(value, int) and number and value >= 1)  # type: ignore[arg-type]
        if isinstance(expected, tuple):
            is_valid, known = value in expected, expected
            expected = f"one of {join_names(known)}{suggest_name(str(value), known)}"
        if not is_valid:
            raise here.make_mismatch(expected)
    return table


def read_diagnose(place: TomlCell) -> dict[str, Any]:
    """Returns options of `modeler diagnose` that this robot needs always: `[diagnose]`.

    Raises:
        RobotError: an unknown option, or no list of effects.
    """
    table = place.read_checked_table(("without",), '[diagnose] without = ["spring@2"]')
    here = place.enter("without", table.get("without", []))
    for entry in here.read_list('["spring@2"]'):
        here.with_value(entry).read_text('"spring@2"')
    return table


def read_limits(place: TomlCell, moving: Joints, symbols: Values) -> dict[str, Limits]:
    """Returns range of motion by joint.

    Raises:
        RobotError: unknown joint, wrong entries, an empty range.
    """
    limits = {}
    for joint, here in _iterate_joints(place, moving, '[limits] "1" = [-2, 2, 3, 10]'):
        cells = here.read_list("[lower, upper, speed, acceleration]", length=4)
        lower, upper, speed, acceleration = (
            read_number(here.enter(f"entry {k}", e), symbols, joint.unit)
            for k, e in enumerate(cells, 1)
        )
        if lower >= upper:
            got = f"got lower {lower:g} and upper {upper:g} {joint.unit}"
            raise here.make_error(f"{got}; expected lower < upper")
        if speed <= 0.0 or acceleration <= 0.0:
            got = f"got speed {speed:g} and acceleration {acceleration:g}"
            raise here.make_error(f"{got}; expected both positive")
        limits[joint.name] = Limits(lower, upper, speed, acceleration)
    return limits


def read_physical(place: TomlCell, moving: Joints) -> dict[str, PhysicalLink]:
    """Returns the letters of a paper for the links, by joint; letters need not be declared.

    Raises:
        RobotError: unknown joint, missing or unknown keys, joint variables in an entry.
    """
    links = {}
    variables = {joint.variable for joint in moving.values()}
    keys = ("mass", "centre", "inertia")
    example = 'mass = "m1", centre = [x, y, z], inertia = [XX, ..., ZZ]'
    for joint, here in _iterate_joints(place, moving, "[physical.1]"):
        table = here.read_checked_table(keys, example, missing=f"expected {join_names(keys)}")
        mass, centre, inertia = (here.enter(key, table[key]) for key in keys)
        (m,) = _read_letters([mass.value], variables, mass)
        x, y, z = _read_letters(centre.read_list("[x, y, z]", 3), variables, centre)
        six = _read_letters(inertia.read_list("[XX, XY, XZ, YY, YZ, ZZ]", 6), variables, inertia)
        links[joint.name] = PhysicalLink(m, (x, y, z), tuple(six))
    return links


def _read_letters(entries: list[Any], variables: set[str], place: TomlCell) -> list[Expression]:
    """The entries, which hold no joint variable."""
    expressions = [place.with_value(entry).read_expression() for entry in entries]
    for expression in expressions:
        if expression.names & variables:
            raise place.make_error(
                f"got {quote_value(expression.text)}, which uses the joint variable "
                f"{min(expression.names & variables)}; links are rigid: expected letters and "
                "numbers"
            )
    return expressions


FRAME_COLUMNS = ("link", "row", "joint", "x", "y", "z", "roll", "pitch", "yaw")
"""Of `[frames]`."""
_FRAMES = 'columns = ["link", "row", "x"], rows = [["hand", "6", 0.1]]'


def read_frames(place: TomlCell, rows: Collection[str], symbols: Values) -> dict[str, LinkFrame]:
    """Returns links of another program's file on the rows of the table: `[frames]`.

    Raises:
        RobotError: columns, names of links or rows, or numbers are wrong.
    """
    if place.value is None:
        return {}
    keys, advice = ("columns", "rows"), f"write {_FRAMES}"
    table = place.read_checked_table(keys, f"[frames] {_FRAMES}", missing=advice)
    frames: dict[str, LinkFrame] = {}
    lines = _iterate_rows(place, table, ("link", "row"), FRAME_COLUMNS, _FRAMES)
    for k, (line, cells) in enumerate(lines, start=1):
        link = line.enter("column link", cells["link"]).read_text('"hand"')
        spot = place.enter(f"row {k} ({quote_value(link)})")
        if link in frames:
            raise spot.make_error("the link stands there twice; keep one of the rows")
        row = _read_carrier_row(cells["row"], rows, spot)
        joint = cells.get("joint", "")
        if not isinstance(joint, str):
            raise spot.enter("column joint", joint).make_mismatch('a name, or "" for none')
        frames[link] = LinkFrame(row, joint, *_read_pose_cells(spot, "column ", cells, symbols))
    return frames


def _iterate_rows(
    place: TomlCell,
    table: Mapping[str, Any],
    needed: tuple[str, ...],
    known: tuple[str, ...],
    example: str,
) -> Iterator[tuple[TomlCell, dict[str, Any]]]:
    """The rows of a table with columns, each with its cells by column."""
    here = place.enter("columns", table["columns"])
    columns = here.read_list(example)
    if {*needed} - {*columns} or {*columns} - {*known} or len({*columns}) < len(columns):
        rest = join_names([name for name in known if name not in needed])
        raise here.make_mismatch(f"{', '.join(needed)} and any of {rest}, each once")
    for k, entry in enumerate(place.enter("rows", table["rows"]).read_list(example), start=1):
        line = place.enter(f"row {k}", entry)
        yield line, dict(zip(columns, line.read_list(example, len(columns)), strict=True))


def _read_carrier_row(name: Any, rows: Collection[str], place: TomlCell) -> str:
    """A row of the table, or "0"."""
    row = normalise_row_name(name)
    if row not in ("0", *rows):
        raise place.enter("column row", row).make_mismatch(
            f'the name of a row, or "0" for the base{suggest_name(row, rows)}'
        )
    return str(row)


_ENDS = ("x0", "y0", "z0", "x1", "y1", "z1")
_CAPSULES = 'columns = ["row", "radius"], rows = [["1", 0.05]]'


def read_capsules(
    place: TomlCell, rows: Collection[str], symbols: Values
) -> tuple[tuple[LinkCapsule, ...], dict[str, tuple[float, ...]]]:
    """Returns what links fill, and planes of the surroundings: `[capsules]`.

    Raises:
        RobotError: columns, names of rows, or numbers are wrong.
    """
    table = dict(place.read_table(f"[capsules] {_CAPSULES}"))
    planes, capsules = {}, []
    flat = place.enter("planes", table.pop("planes", {}))
    for name, here in flat.read_items("planes = {floor = [0, 0, 1, 0]}"):
        four = here.read_list("[x, y, z, offset], the normal that points to where is room", 4)
        planes[name] = tuple(read_number(here.with_value(cell), symbols, "m") for cell in four)
        if not any(planes[name][:3]):
            expected = "expected a direction, such as [0, 0, 1, 0]"
            raise here.make_error(f"got the normal (0, 0, 0); {expected}")
    stated_table = place.with_value(table)
    if table:
        keys, advice = ("columns", "rows"), f"write {_CAPSULES}"
        stated_table.read_checked_table(keys, f"[capsules] {_CAPSULES}", missing=advice)
    known = ("row", "radius", *_ENDS)
    for line, cells in _iterate_rows(place, table, known[:2], known, _CAPSULES) if table else ():
        row = _read_carrier_row(cells.pop("row"), rows, line)
        places = {name: line.enter(f"column {name}", cell) for name, cell in cells.items()}
        sizes = {name: read_number(here, symbols, "m") for name, here in places.items()}
        if sizes["radius"] <= 0.0:
            raise places["radius"].make_mismatch("a length above 0, in m")
        ends = [sizes.get(name, 0.0) for name in _ENDS]
        both = (tuple(ends[:3]), tuple(ends[3:])) if len(sizes) > 1 else None
        capsules.append(LinkCapsule(row, sizes["radius"], both))
    return tuple(capsules), planes


def _read_pose_cells(
    place: TomlCell, kind: str, cells: Mapping[str, Any], symbols: Values
) -> tuple[_Three, _Three]:
    """Position x, y, z and angles roll, pitch, yaw; what is left out is 0."""
    numbers = []
    for name in FRAME_COLUMNS[3:]:
        here = place.enter(f"{kind}{name}", cells.get(name, 0))
        read_number(here, symbols, "m" if len(name) == 1 else "rad")
        numbers.append(here.read_expression())
    x, y, z, roll, pitch, yaw = numbers
    return (x, y, z), (roll, pitch, yaw)


_TOOL = '[tool] with x, y, z, roll, pitch, yaw, and row = "6" or link = "flange"'


def read_tool(place: TomlCell, robot: Robot, symbols: Values) -> LinkFrame | None:
    """Returns the frame whose motion a controller commands: `[tool]`.

    It stands on a row of the table, or on a link of `[frames]`, in whose frame it is placed; on the
    last moving row where it names neither and the robot has one end.

    Raises:
        RobotError: unknown keys, rows or links, or no one end.
    """
    if place.value is None:
        return None
    table = place.read_checked_table(("row", "link", *FRAME_COLUMNS[3:]), _TOOL)
    if "row" in table and "link" in table:
        raise place.make_error("both row and link are given; keep one of them")
    row, under = table.get("row"), None
    if "link" in table:
        here = place.enter("link", table["link"])
        if here.read_text('"flange"') not in robot.frames:
            raise here.make_mismatch(f"a link of [frames]{suggest_name(here.value, robot.frames)}")
        under = robot.frames[here.value]
        row = under.row
    elif row is None:
        ends = _find_ends(robot)
        if len(ends) != 1:
            raise place.make_error(
                f"the robot has {len(ends)} ends, {join_names(ends)}; say which row carries the "
                f'tool, as row = "{ends[-1]}"'
            )
        (row,) = ends
    rows = [joint.name for joint in robot.joints]
    if normalise_row_name(row) not in rows:
        raise place.enter("row", row).make_mismatch(f"the name of a row{suggest_name(row, rows)}")
    pose = _read_pose_cells(place, "", table, symbols)
    return LinkFrame(normalise_row_name(row), "", *pose, on=under)


def _find_ends(robot: Robot) -> list[str]:
    """Moving rows that carry no other; of a robot with a platform, that which carries it."""
    if robot.platform:
        return [robot.platform[-1]]
    before = {joint.name: joint.antecedent for joint in robot.joints}
    carrying = set[str]()
    for joint in robot.moving_joints:
        row = joint.antecedent
        while row in before and row not in carrying:
            carrying.add(row)
            row = before[row]
    return [j.name for j in robot.moving_joints if j.name not in carrying | {*robot.motors}]
