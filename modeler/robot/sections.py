"""The tables of a robot file that name joints: effects, coupling, drives, limits, links."""

from collections.abc import Collection, Mapping
from typing import Any

from modeler.core.expression import Expression
from modeler.robot.cells import (
    LARGEST_RATIO,
    check_declared,
    check_size,
    expression_at,
    form_at,
    list_at,
    name_of,
    number_at,
    plain_number,
    table_at,
)
from modeler.robot.joint import Joint
from modeler.robot.place import Place, listed, near, shown
from modeler.robot.robot import Limits, PhysicalLink

Coupling = dict[str, dict[str, float]]


def joint_at(name: Any, moving: Mapping[str, Joint], place: Place) -> Joint:
    """The moving joint of that name.

    Raises:
        RobotError: no such joint; lists those there are.
    """
    key = name_of(name)
    if not isinstance(key, str) or key not in moving:
        hint = near(key, moving) if isinstance(key, str) else ""
        raise place.error(
            f"there is no moving joint {shown(name)}{hint}; expected one of {listed(moving)}"
        )
    return moving[key]


def read_coupling(
    value: Any, moving: Mapping[str, Joint], symbols: Mapping[str, float], place: Place
) -> Coupling:
    """Motors that turn with several joints: {joint of the motor: {joint: coefficient}}.

    Raises:
        RobotError: unknown joints, or a speed that is not a sum of joint variables.
    """
    coupling: Coupling = {}
    for name, cell in table_at(value, place, '[coupling] "6" = "q5 + q6"').items():
        here = place.at(shown(name))
        motor = joint_at(name, moving, here)
        expression = expression_at(cell, here)
        variables = {joint.variable: joint for joint in moving.values()}
        known = {**symbols, **dict.fromkeys(variables, 0.0)}
        check_declared(expression, known, here)
        form = form_at(expression, symbols, here)
        check_size(expression, form.coefficients.values(), LARGEST_RATIO, here)
        if form.constant != 0.0:
            raise here.error(
                f"got {shown(expression.text)}, with the constant {form.constant:g}; expected a "
                'sum of joint variables only, such as "q5 + q6"'
            )
        if motor.variable not in form.coefficients:
            raise here.error(
                f"got {shown(expression.text)}, without {motor.variable}; the motor of joint "
                f"{motor.name} must turn with its own joint"
            )
        coupling[motor.name] = {
            joint.name: form.coefficients[variable]
            for variable, joint in variables.items()
            if variable in form.coefficients
        }
    return coupling


def read_reference(value: Any, known: Collection[str], place: Place) -> dict[str, float]:
    """Standard parameters about which effects that depend on the load are linearised.

    Raises:
        RobotError: an unknown parameter, or no number.
    """
    found = {}
    for name, cell in table_at(value, place, "[reference] ZZ1 = 0.5").items():
        if name not in known:
            raise place.error(
                f"there is no parameter {shown(name)}{near(name, known)}; expected names of "
                "standard parameters, such as ZZ1"
            )
        found[name] = plain_number(cell, place.at(name), "0.5")
    return found


def read_drive_gains(value: Any, moving: Mapping[str, Joint], place: Place) -> dict[str, float]:
    """Joint torque per unit of the logged current, by joint.

    Raises:
        RobotError: unknown joint, or a gain that is no number or zero.
    """
    gains = {}
    for name, cell in table_at(value, place, '[drive_gains] "1" = 12.5').items():
        here = place.at(shown(name))
        joint = joint_at(name, moving, here)
        gains[joint.name] = plain_number(cell, here, "12.5")
        if gains[joint.name] == 0.0:
            raise here.error(
                "got 0; expected joint torque per unit of logged current, not zero; leave the "
                "joint out if its gain is unknown"
            )
    return gains


def read_limits(
    value: Any, moving: Mapping[str, Joint], symbols: Mapping[str, float], place: Place
) -> dict[str, Limits]:
    """Range of motion by joint.

    Raises:
        RobotError: unknown joint, wrong entries, an empty range.
    """
    limits = {}
    for name, cell in table_at(value, place, '[limits] "1" = [-2, 2, 3, 10]').items():
        here = place.at(shown(name))
        joint = joint_at(name, moving, here)
        cells = list_at(cell, here, "[lower, upper, speed, acceleration]", length=4)
        lower, upper, speed, acceleration = (
            number_at(entry, symbols, here.at(f"entry {k}")) for k, entry in enumerate(cells, 1)
        )
        if lower >= upper:
            raise here.error(
                f"got lower {lower:g} and upper {upper:g} {joint.unit}; expected lower < upper"
            )
        if speed <= 0.0 or acceleration <= 0.0:
            raise here.error(
                f"got speed {speed:g} and acceleration {acceleration:g}; expected both positive"
            )
        limits[joint.name] = Limits(lower, upper, speed, acceleration)
    return limits


def read_physical(value: Any, moving: Mapping[str, Joint], place: Place) -> dict[str, PhysicalLink]:
    """The letters of a paper for the links, by joint; letters need not be declared.

    Raises:
        RobotError: unknown joint, missing or unknown keys, joint variables in an entry.
    """
    links = {}
    variables = {joint.variable for joint in moving.values()}
    for name, cell in table_at(value, place, "[physical.1]").items():
        here = place.at(shown(name))
        joint = joint_at(name, moving, here)
        links[joint.name] = _physical_link(cell, variables, here)
    return links


def _physical_link(value: Any, variables: Collection[str], place: Place) -> PhysicalLink:
    table = table_at(value, place, 'mass = "m1", centre = [x, y, z], inertia = [XX, ..., ZZ]')
    keys = ("mass", "centre", "inertia")
    for key in table:
        if key not in keys:
            raise place.error(f"unknown key {shown(key)}{near(key, keys)}; expected {listed(keys)}")
    for key in keys:
        if key not in table:
            raise place.error(f"{key} is missing; expected {listed(keys)}")

    def letters(key: str, entries: list[Any]) -> list[Expression]:
        here = place.at(key)
        expressions = [expression_at(entry, here) for entry in entries]
        for expression in expressions:
            if expression.names & set(variables):
                raise here.error(
                    f"got {shown(expression.text)}, which uses the joint variable "
                    f"{min(expression.names & set(variables))}; links are rigid: expected letters "
                    "and numbers"
                )
        return expressions

    example = "[XX, XY, XZ, YY, YZ, ZZ]"
    (mass,) = letters("mass", [table["mass"]])
    x, y, z = letters("centre", list_at(table["centre"], place.at("centre"), "[x, y, z]", 3))
    inertia = letters("inertia", list_at(table["inertia"], place.at("inertia"), example, 6))
    return PhysicalLink(mass, (x, y, z), tuple(inertia))
