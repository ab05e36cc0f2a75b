"""Closed robots against MuJoCo: our torques, replayed open loop, carry out our motion there.

MuJoCo gets the opened tree from the table, loops as equality constraints between sites, and
relations as tendons of fixed length; it solves for constraint forces itself. It knows neither our
projection nor our closing. Its constraints are springs, as stiff here as its steps allow.
"""

import numpy as np
import pytest

from modeler.robot.read import read_robot
from modeler.robot.robot import INERTIAL
from modeler.simulation import motion_limits, plant_parameters
from modeler.simulation.closing import constraints_of, followed
from modeler.simulation.rigid import body_from_standard
from tests.elementary_motions import placed
from tests.modules import module, plain
from tests.rotation import ROTATING

mujoco = pytest.importorskip("mujoco", reason="MuJoCo (PyPI: mujoco-core) is not installed")

STEP, STEPS = 2e-4, 1500
STIFF = f'solref="{2 * STEP:g} 1" solimp="0.99999 0.99999 0.001 0.5 2"'
LIGHT = 1e-6  # kg and kg m2 of rows without a body: MuJoCo wants some
ROBOTS = [
    "five-bar", "sr400", "orthoglide-2003",
    *(pytest.param(name, marks=ROTATING) for name in ("3rrr", "delta", "stewart", "evra")),
]  # fmt: skip


def numbers(values):
    return " ".join(f"{x:.17g}" for x in np.ravel(values))


def body_text(robot, standard, name, values):
    """The rows on that row, as nested bodies and sites."""
    text = ""
    for row in robot.joints:
        if row.antecedent != name:
            continue
        rotation, origin, sign = placed(row, values)
        axes = numbers([rotation[:, 0], rotation[:, 1]])
        text += f'<body name="{row.name}" pos="{numbers(origin)}" xyaxes="{axes}">'
        text += f'<site name="{row.name}"/>'
        if row.moves:
            kind = "hinge" if row.angular else "slide"
            text += f'<joint name="{row.name}" type="{kind}" axis="0 0 {sign:g}"/>'
            ten = {p: standard.get(p + row.name, 0.0) for p in INERTIAL}
            body = body_from_standard(ten)
            mass, inertia = max(body.mass, LIGHT), body.inertia + LIGHT * np.eye(3)
            full = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
            text += f'<inertial pos="{numbers(body.centre)}" mass="{mass:.17g}" '
            text += f'fullinertia="{numbers(full)}"/>'
        text += body_text(robot, standard, row.name, values) + "</body>"
    return text


def tie_text(robot, values):
    """Relations as tendons of fixed length, loops of points as connected sites."""
    tendons = equalities = ""
    variables = {joint.variable: 0.0 for joint in robot.moving}
    for name, relation in robot.relations.items():
        constant = relation.number(values | variables)
        tendons += f'<fixed name="{name}"><joint joint="{name}" coef="1"/>'
        for variable in sorted(relation.names & variables.keys()):
            slope = relation.number(values | variables | {variable: 1.0}) - constant
            tendons += f'<joint joint="{variable[1:]}" coef="{-slope:.17g}"/>'
        tendons += "</fixed>"
        equalities += f'<tendon tendon1="{name}" polycoef="{constant:.17g} 0 0 0 0" {STIFF}/>'
    for loop in robot.loops:
        equalities += f'<connect site1="{loop.frame}" site2="{loop.meets}" {STIFF}/>'
    return f"<tendon>{tendons}</tendon><equality>{equalities}</equality>"


def mujoco_model(robot, standard):
    values = robot.symbol_values()
    gravity = numbers([component.number(values) for component in robot.gravity])
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian" boundmass="0" inertiafromgeom="false"/>'
        f'<option timestep="{STEP}" gravity="{gravity}" integrator="RK4" solver="Newton" '
        f'iterations="200" tolerance="1e-14" jacobian="dense"/>'
        f"<worldbody>{body_text(robot, standard, '0', values)}</worldbody>"
        f"{tie_text(robot, values)}</mujoco>"
    )


def smooth_motion(robot, time):
    """q, qd, qdd that start at rest at home; other joints, other frequencies and ways."""
    reach = np.array([0.4 if joint.angular else 0.04 for joint in robot.coordinates])
    omega = 2 * np.pi * (1.5 + 0.5 * np.arange(len(reach)))
    way = reach * np.resize([1.0, -0.7, 0.5], len(reach))
    home = np.array([robot.home.get(joint.name, 0.0) for joint in robot.coordinates])
    phase = time[:, None] * omega
    return (
        home + way * (phase - np.sin(phase)) / np.pi,
        way * omega * (1 - np.cos(phase)) / np.pi,
        way * omega**2 * np.sin(phase) / np.pi,
    )


def replayed(robot, standard, tau, start):
    """(STEPS + 1, moving rows) positions under torques held over each step."""
    model = mujoco_model(robot, standard)
    data = mujoco.MjData(model)
    places = [model.joint(joint.name).qposadr[0] for joint in robot.moving]
    motors = [model.joint(joint.name).dofadr[0] for joint in robot.coordinates]
    data.qpos[places] = start
    found = [start]
    for torque in tau:
        data.qfrc_applied[motors] = torque
        mujoco.mj_step(model, data)
        found.append(data.qpos[places].copy())
    return np.array(found)


@pytest.mark.parametrize("name", ROBOTS)
def test_our_torques_carry_out_our_motion(name):
    robot, c = read_robot(name), plain(name)
    standard = plant_parameters(robot, motion_limits(robot)).standard
    columns = module(name).model.names
    chi = np.array([standard[n] if n.startswith(INERTIAL) else 0.0 for n in columns])
    time = STEP * np.arange(STEPS + 1)
    q, _, _ = smooth_motion(robot, time)
    middle = smooth_motion(robot, time[:-1] + STEP / 2)
    tau = c.inverse_dynamics(*middle, c.base_parameters(chi))
    start = followed(robot, constraints_of(robot), q[:1])[0]
    names = [joint.name for joint in robot.moving]
    given = [names.index(joint.name) for joint in robot.coordinates]
    right = replayed(robot, standard, tau, start)[:, given]
    moved = np.ptp(q, axis=0)
    assert np.all(moved > 0.02)
    error = np.abs(right - q).max(axis=0) / moved
    assert np.all(error < 2e-4)  # falls with the square of the step: 1e-6 to 1e-4 here
    if name == "five-bar":  # what is compared is sharp: a hundredth of the torque shows
        wrong = replayed(robot, standard, 1.01 * tau, start)[:, given]
        assert np.max(np.abs(wrong - q).max(axis=0) / moved) > 2e-3
