"""Robots in MuJoCo, built from the table alone: bodies, rotors, relations and loops of points.

It gets the opened tree, loops as equality constraints between sites, and relations as tendons of
fixed length; it solves for constraint forces itself. Its constraints are springs, as stiff here as
its steps allow.
"""

from collections.abc import Mapping

import numpy as np
import pytest

from modeler.robot.robot import INERTIAL, Robot
from modeler.simulation.rigid import compute_body
from tests.elementary_motions import placed

mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: MuJoCo (PyPI: mujoco) is not installed")

STEP = 2e-4
STIFF = f'solref="{2 * STEP:g} 1" solimp="0.99999 0.99999 0.001 0.5 2"'
LIGHT = 1e-6  # kg and kg m2 of rows without a body: MuJoCo needs some


def numbers(values) -> str:
    return " ".join(f"{x:.17g}" for x in np.ravel(values))


def body_text(robot: Robot, standard: Mapping[str, float], on: str, light: float) -> str:
    """The rows on that row, as nested bodies and sites."""
    text, values = "", robot.evaluate_symbols()
    for row in robot.joints:
        if row.antecedent != on:
            continue
        rotation, origin, sign = placed(row, values)
        axes = numbers([rotation[:, 0], rotation[:, 1]])
        text += f'<body name="{row.name}" pos="{numbers(origin)}" xyaxes="{axes}">'
        text += f'<site name="{row.name}"/>'
        if row.is_moving:
            kind = "hinge" if row.is_revolute else "slide"
            rotor = standard.get(f"Ia{row.name}", 0.0)
            text += f'<joint name="{row.name}" type="{kind}" axis="0 0 {sign:g}" '
            text += f'armature="{rotor:.17g}"/>'
            body = compute_body({p: standard.get(p + row.name, 0.0) for p in INERTIAL})
            mass, inertia = max(body.mass, light), body.inertia + light * np.eye(3)
            full = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
            text += f'<inertial pos="{numbers(body.centre)}" mass="{mass:.17g}" '
            text += f'fullinertia="{numbers(full)}"/>'
        text += body_text(robot, standard, row.name, light) + "</body>"
    return text


def tie_text(robot: Robot) -> str:
    """Relations as tendons of fixed length, loops of points as connected sites."""
    tendons = equalities = ""
    values = robot.evaluate_symbols()
    variables = {joint.variable: 0.0 for joint in robot.moving_joints}
    for name, relation in robot.relations.items():
        constant = relation.evaluate(values | variables)
        tendons += f'<fixed name="{name}"><joint joint="{name}" coef="1"/>'
        for variable in sorted(relation.names & variables.keys()):
            slope = relation.evaluate(values | variables | {variable: 1.0}) - constant
            tendons += f'<joint joint="{variable[1:]}" coef="{-slope:.17g}"/>'
        tendons += "</fixed>"
        equalities += f'<tendon tendon1="{name}" polycoef="{constant:.17g} 0 0 0 0" {STIFF}/>'
    for loop in robot.loops:
        equalities += f'<connect site1="{loop.frame}" site2="{loop.meets}" {STIFF}/>'
    return f"<tendon>{tendons}</tendon><equality>{equalities}</equality>"


def mujoco_model(robot: Robot, standard: Mapping[str, float], light: float = LIGHT):
    """The robot with these standard parameters.

    Args:
        robot: its joints are named as in the table.
        standard: of bodies and rotors; those of friction have no effect.
        light: kg and kg m2 that every body has besides, so that none has nothing.
    """
    values = robot.evaluate_symbols()
    gravity = numbers([component.evaluate(values) for component in robot.gravity])
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian" boundmass="0" inertiafromgeom="false"/>'
        f'<option timestep="{STEP}" gravity="{gravity}" integrator="RK4" solver="Newton" '
        f'iterations="200" tolerance="1e-14" jacobian="dense"/>'
        f"<worldbody>{body_text(robot, standard, '0', light)}</worldbody>"
        f"{tie_text(robot)}</mujoco>"
    )
