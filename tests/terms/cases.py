"""Robots of these tests, derived once."""

from functools import cache

from modeler.core.choices import read_builtin_robot
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.model import SymbolicModel
from modeler.derivation.relations import BaseParameters
from modeler.formulas.closed_form import ClosedForm, derive_closed_form
from modeler.formulas.coefficients import CoefficientTable, build_coefficient_table
from modeler.robot.read import parse_robot_text
from tests.modules import module

HEAD = 'name = "{name}"\ntitle = "{name}"\ngravity = {gravity}\n[symbols]\n{symbols}\n[mdh]\n'
COLUMNS = 'columns = ["j", "a", "sigma", "gamma", "b", "alpha", "d", "theta", "r"]\nrows = [\n'


def robot_text(name, rows, symbols="", gravity='[0, 0, "-g"]', rest=""):
    head = HEAD.format(name=name, gravity=gravity, symbols=f"g = 9.81\n{symbols}")
    return head + COLUMNS + "".join(f"[{row}],\n" for row in rows) + "]\n" + rest


def general(joints: int) -> str:
    """All angles and lengths general: nothing to lean on."""
    rows, symbols = [], ""
    for j in range(1, joints + 1):
        rows.append(f'"{j}", "{j - 1}", 0, 0, 0, "al{j}", "D{j}", "q{j}", "R{j}"')
        symbols += f"al{j} = 0.{j}3\nD{j} = 0.{j}1\nR{j} = 0.{j}2\n"
    return robot_text(f"general{joints}", rows, symbols)


TEXTS = {
    "general3": general(3),
    # a tree with a fixed frame, a prismatic joint, negative rates, offsets, roots of numbers,
    # gravity askew, rotor inertias
    "odd": robot_text(
        "odd",
        [
            '"1", "0", 0, 0, 0, "pi/4", 0, "-q1 + th", 0',
            '"2", "1", 1, 0, 0, "pi/3", "D2", "pi/6", "0.3 - q2"',
            '"9", "1", 2, "be", "B9", "-pi/2", "pi/8", 0, 0',
            '"3", "9", 0, 0, 0, "al", "D3", "pi - q3", "R3"',
        ],
        "th = 0.4\nD2 = 0.3\nbe = -0.7\nB9 = 0.15\nal = 1.1\nD3 = 0.2\nR3 = -0.4\nk = 0.6\n",
        gravity='["g*k", "-2", "-g"]',
        rest='[effects]\nrotor_inertia = "all"\nviscous = "all"\n',
    ),
    # parallel axes, long letters beside right angles: an angle of several, and lines without a gap
    "askew": robot_text(
        "askew",
        [
            '"1", "0", 0, 0, 0, "pi/2", 0, "q1 + elbowoffset - pi/2", 0',
            '"2", "1", 0, 0, 0, 0, "D2", "q2 - elbowoffset - wristoffsetofthemaker + pi/2", 0',
            '"3", "2", 0, 0, 0, 0, "D3", "q3 + wristoffsetofthemaker + flangeturn - pi/2", "R3"',
            '"4", "3", 0, 0, 0, "pi/2", 0, "q4 + 0.3 - pi/2", 0',
        ],
        "elbowoffset = 0.2\nwristoffsetofthemaker = 0.1\nflangeturn = 0.3\nD2 = 0.3\nD3 = 0.2\n"
        "R3 = 0.1\n",
    ),
    "weightless": robot_text(
        "weightless",
        ['"11", "0", 0, 0, 0, 0, 0, "q11", 0', '"12", "11", 0, 0, 0, 0, "L", "q12", 0'],
        "L = 0.5\n",
        gravity="[0, 0, 0]",
    ),
    "shared": robot_text(
        "shared",
        ['"1", "0", 0, 0, 0, 0, 0, "q1", 0', '"2", "1", 0, 0, 0, "pi/2", 0, "q2", 0'],
        rest='[coupling]\n2 = "q2 - 2*q1"\n[effects]\ncoupled_inertia = ["2"]\n',
    ),
}

TIED = {
    # half and double angles, a gear ratio that is an angle of its own, a screw, a rack, a sum
    "geared": robot_text(
        "geared",
        [
            '"1", "0", 0, 0, 0, "pi/2", 0, "q1", 0',
            '"2", "1", 0, 0, 0, 0, "D2", "-q2", 0',
            '"3", "2", 0, 0, 0, "al", "D3", "q3 + th", 0',
            '"4", "3", 1, 0, 0, "pi/2", 0, 0, "q4"',
            '"5", "4", 0, 0, 0, 0, "D5", "q5", 0',
            '"6", "2", 0, 0, 0, "pi/2", "D6", "q6", 0',
            '"7", "6", 0, 0, 0, 0, "D2", "q7", 0',
        ],
        "D2 = 0.3\nD3 = 0.2\nD5 = 0.25\nD6 = 0.15\nal = 1.1\nth = 0.4\n",
        rest='[relations]\nq2 = "q1/2 + pi/6"\nq4 = "0.02*q1 - 0.1"\nq5 = "1.37*q3"\n'
        'q6 = "q3 - 2*q1"\n[effects]\nrotor_inertia = "all"\nviscous = "all"\n',
    )
}
"""Robots whose joints follow others."""

SMALL = (*TEXTS, "two-link", "scara", "wrist", "emps", "demo-arm", "orthoglide-leg-tree")


@cache
def model_of(name: str) -> SymbolicModel:
    text = {**TEXTS, **TIED}.get(name)
    return derive_model(parse_robot_text(text, name)) if text else module(name).model


@cache
def base_of(name: str) -> BaseParameters:
    return (
        derive_base_parameters(model_of(name)) if name in {**TEXTS, **TIED} else module(name).base
    )


@cache
def closed_of(name: str) -> ClosedForm:
    return derive_closed_form(model_of(name))


@cache
def table_of(name: str) -> CoefficientTable:
    return build_coefficient_table(model_of(name), base_of(name))


def edited_wrist(*edits: tuple[str, str]) -> SymbolicModel:
    """The wrist's file with pieces of its text replaced."""
    text = read_builtin_robot("wrist")
    for old, new in edits:
        assert old in text
        text = text.replace(old, new)
    return derive_model(parse_robot_text(text, "wrist.toml"))
