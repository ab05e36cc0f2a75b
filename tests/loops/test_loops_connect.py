"""Loops that MJCF closes by `connect`, against MuJoCo's masses, forces and Jacobians.

MuJoCo solves such constraints as stiff springs. Here its pieces are put together without: at
postures closed by Newton's method on its own points, M qdd + h = S' tau + J' lambda is solved for
the torques of the motors, with J and dJ/dt of the two points that meet.
"""

from functools import cache

import numpy as np
import pytest

from modeler.codegen.workflow import derive
from modeler.formats.mjcf import read_mjcf_tree
from modeler.formats.tree_text import convert_tree
from modeler.robot.read import parse_robot_text
from tests.loops.derived import compiled_plainly

mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: mujoco-core is not installed")

PLANAR = '<joint axis="0 1 0"/>'
CRANK = """<body name="crank"><joint name="crank" armature="0.02"/>
  <geom fromto="0 0 0 0 0 0.2"/><body name="coupler" pos="0 0 0.2"><joint name="coupler"/>
  <geom fromto="0 0 0 0.45 0 0.1"/><geom type="box" size=".02 .05 .03" pos="0.2 0.02 0.1"/>
  </body></body>"""
ROCKER = """<body name="rocker" pos="0.4 0 0"><joint name="rocker"/>
  <geom fromto="0 0 0 0.05 0 0.3"/><body name="rod" pos="0.1 0 0.5"><joint name="rod"/>
  <geom fromto="0 0 0 0.4 0 -0.1"/></body></body>
  <body name="out" pos="0.8 0 0"><joint name="out"/><geom fromto="0 0 0 0.1 0 0.4"/></body>"""
TEXTS = {
    "two loops": (PLANAR, CRANK + ROCKER, "coupler rocker 0.45 0 0.1; rod out 0.4 0 -0.1", "crank"),
    "slider in space": (
        "<joint/>",
        """<body name="arm" pos="0 0 0.1"><joint name="arm"/><geom fromto="0 0 0 0.2 0 0"/>
        <body name="rod" pos="0.2 0 0"><joint name="u1" axis="0 1 0"/>
        <joint name="u2" axis="1 0 0"/><geom fromto="0 0 0 0.1 0.05 0.4"/></body></body>
        <body name="slider" pos="0.3 0.05 0.5" euler="0.3 0 0"><geom fromto="-0.05 0 0 0.05 0 0"/>
        <joint name="slider" type="slide" axis="0 0.6 0.8"/></body>""",
        "rod slider 0.1 0.05 0.4",
        "arm",
    ),
    "pinned to the world": (
        PLANAR,
        CRANK.replace(
            "</body></body>",
            """<body name="last" pos="0.45 0 0.1"><joint name="last"/>
        <geom fromto="0 0 0 0.02 0 -0.35"/></body></body></body>""",
        ),
        "last - 0.02 0 -0.35",
        "crank",
    ),
}


def parallelograms() -> tuple[str, str, str, str]:
    """Two, of which the second stands on the first; numbers of four digits.

    No frame has its origin on its joint, and no bar is along an axis of a frame.
    """
    rng = np.random.default_rng()
    offs = rng.uniform(-0.1, 0.1, (6, 3)).round(4)

    def steep():
        return np.array([*rng.uniform((-0.05, 0), (0.05, 0)), rng.uniform(0.15, 0.3)]).round(4)

    def level():
        return np.array([rng.uniform(0.25, 0.4), 0, rng.uniform(-0.05, 0.05)]).round(4)

    def text(numbers):
        return " ".join(f"{x:.4f}" for x in numbers)

    def bar(name, at, k, way, inner=""):
        return (
            f'<body name="{name}" pos="{text(at - offs[k])}"><joint name="{name}" pos='
            f'"{text(offs[k])}"/><geom fromto="{text(offs[k])} {text(offs[k] + way)}"/>{inner}'
            "</body>"
        )

    foot = rng.uniform(-0.3, 0.3, 3).round(4)
    (base, arm), (crank, seat, gap) = (level(), level()), (steep(), steep(), steep())
    hand = bar("hand", offs[3] + arm, 4, gap)
    inner = bar("arm", offs[1] + seat, 3, arm, hand) + bar("rod", offs[1] + seat + gap, 5, arm)
    both = bar("crank", foot, 0, crank, bar("coupler", offs[0] + crank, 1, base, inner))
    both += bar("rocker", foot + base, 2, crank)
    meetings = f"coupler rocker {text(offs[1] + base)}; hand rod {text(offs[4] + gap)}"
    return PLANAR, both, meetings, "crank arm"


TEXTS["one on another"] = parallelograms()
NAMES = list(TEXTS)


def mjcf(name):
    joint, bodies, meetings, motors = TEXTS[name]
    ties = ""
    for crossover in meetings.split("; "):
        one, two, *anchor = crossover.split()
        other = "" if two == "-" else f'body2="{two}"'
        ties += f'<connect body1="{one}" {other} anchor="{" ".join(anchor)}"/>'
    motors = "".join(f'<motor joint="{motor}"/>' for motor in motors.split())
    return (
        f'<mujoco model="{name}"><compiler angle="radian"/><option gravity="0.4 0.2 -9.81"/>'
        f'<default><geom type="capsule" size="0.02"/>{joint}</default>'
        f"<worldbody>{bodies}</worldbody><equality>{ties}</equality><actuator>{motors}</actuator>"
        "</mujoco>"
    )


class Loop:
    """A file as MuJoCo has it; motions that its loops allow, and the torques for them."""

    def __init__(self, text):
        self.model = m = mujoco.MjModel.from_xml_string(text)
        m.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
        self.data = mujoco.MjData(m)
        self.driven = sorted(m.actuator_trnid[:, 0])
        self.passive = [j for j in range(m.nv) if j not in self.driven]

    def points(self):
        """Body and place of the two points of every loop."""
        m, d = self.model, self.data
        for i in range(m.neq):
            for part, body in enumerate((m.eq_obj1id[i], m.eq_obj2id[i])):
                anchor = m.eq_data[i, 3 * part : 3 * part + 3]
                yield body, d.xpos[body] + d.xmat[body].reshape(3, 3) @ anchor

    def gap(self, q):
        """What is between the points, and its Jacobian."""
        m, d = self.model, self.data
        d.qpos[:] = q
        mujoco.mj_kinematics(m, d)
        mujoco.mj_comPos(m, d)
        places, slopes = [], []
        for body, place in self.points():
            slope = np.zeros((3, m.nv))
            mujoco.mj_jac(m, d, slope, None, place, body)
            places, slopes = [*places, place], [*slopes, slope]
        return np.ravel(np.subtract(places[::2], places[1::2])), np.vstack(
            [one - two for one, two in zip(slopes[::2], slopes[1::2], strict=True)]
        )

    def closed(self, goal):
        """The posture with the motors at `goal`, on the way from where the file is drawn."""
        q = self.model.qpos0.copy()
        start = q[self.driven].copy()
        for step in np.linspace(0, 1, 40)[1:]:
            q[self.driven] = start + step * (goal - start)
            for _ in range(12):
                gap, J = self.gap(q)
                q[self.passive] -= np.linalg.lstsq(J[:, self.passive], gap, rcond=1e-9)[0]
        assert np.abs(self.gap(q)[0]).max() < 1e-13
        return q

    def motion(self, q, speeds, accelerations):
        """qd and qdd of all joints: J qd = 0, J qdd + dJ/dt qd = 0."""
        m, d, J = self.model, self.data, self.gap(q)[1]

        def carried(inputs, drift):
            full = np.zeros(m.nv)
            full[self.driven] = inputs
            right = -drift - J @ full
            full[self.passive] = np.linalg.lstsq(J[:, self.passive], right, rcond=1e-9)[0]
            return full

        qd = carried(speeds, 0.0)
        d.qvel[:] = qd
        mujoco.mj_comVel(m, d)
        drifts = []
        for body, place in self.points():
            slope = np.zeros((3, m.nv))
            mujoco.mj_jacDot(m, d, slope, None, place, body)
            drifts.append(slope @ qd)
        return qd, carried(accelerations, np.ravel(np.subtract(drifts[::2], drifts[1::2])))

    def torques(self, q, speeds, accelerations):
        """Of the motors, from M qdd + h = S' tau + J' lambda."""
        m, d = self.model, self.data
        qd, qdd = self.motion(q, speeds, accelerations)
        J = self.gap(q)[1]
        d.qpos[:], d.qvel[:], d.qacc[:] = q, qd, qdd
        mujoco.mj_inverse(m, d)
        table = np.hstack([np.eye(m.nv)[:, self.driven], J.T])
        right = d.qfrc_inverse.copy()  # M qdd + h: constraints are off
        solved = np.linalg.lstsq(table, right, rcond=1e-9)[0]
        assert np.abs(table @ solved - right).max() <= 1e-9 * np.abs(right).max()
        return solved[: len(self.driven)]


@cache
def derivation_of(name, folder):
    path = folder / f"{name}.xml"
    path.write_text(mjcf(name))
    return derive(parse_robot_text(convert_tree(read_mjcf_tree(path), str(path)).text, "loop.toml"))


@pytest.fixture(autouse=True)
def _quiet():
    """Bodies without mass make MuJoCo warn, on the console and in a file."""
    mujoco.set_mju_user_warning(lambda _text: None)
    yield
    mujoco.set_mju_user_warning(None)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("loops")


def states(loop, count):
    """Postures that the motors reach near to that of the file, speeds, accelerations."""
    rng, n = np.random.default_rng(), len(loop.driven)
    goals = loop.model.qpos0[loop.driven] + rng.uniform(-0.35, 0.35, (count, n))
    return [loop.closed(goal) for goal in goals], *rng.normal(0, 2, (2, count, n))


@pytest.mark.rotating("loops in MuJoCo")
@pytest.mark.parametrize("name", NAMES)
def test_torques_are_those_of_mujocos_equations(name, folder):
    derivation, loop = derivation_of(name, folder), Loop(mjcf(name))
    robot, c = derivation.model.robot, compiled_plainly(derivation)
    postures, qd, qdd = states(loop, 20)
    motors = np.array(postures)[:, loop.driven]
    assert [joint.name for joint in robot.coordinates] == [f"{j + 1}" for j in loop.driven]
    theirs = np.array(postures)[:, [int(joint.name) - 1 for joint in robot.free_joints]]
    assert np.abs(c.close(motors) - theirs).max() < 1e-9
    chi = np.array([robot.parameters.get(p.name, 0.0) for p in c.spec.standard])
    tau = c.inverse_dynamics(motors, qd, qdd, c.base_parameters(chi))
    theirs = np.array([loop.torques(*state) for state in zip(postures, qd, qdd, strict=True)])
    assert np.abs(tau - theirs).max() < 1e-8 * np.abs(theirs).max()


def basis(m, body):
    """Ten sets of a body's values whose torques span those of all."""
    half, eye = np.sqrt(0.5), np.eye(3)
    skew = [(np.cos(np.pi / 8), *(np.sin(np.pi / 8) * eye[k])) for k in range(3)]
    sets = [(0, np.zeros(3), e, (1, 0, 0, 0)) for e in eye]
    sets += [(0, np.zeros(3), e, s) for e, s in zip(eye[[1, 2, 0]], skew, strict=True)]
    sets += [(1, p, np.zeros(3), (half, half, 0, 0)) for p in (np.zeros(3), *eye)]
    for m.body_mass[body], m.body_ipos[body], m.body_inertia[body], m.body_iquat[body] in sets:
        yield
    m.body_mass[body], m.body_inertia[body] = 0.0, 0.0


@pytest.mark.rotating("loops in MuJoCo")
@pytest.mark.parametrize("name", NAMES)
def test_there_are_as_many_base_parameters_as_mujoco_feels(name, folder):
    """tau is linear in each body's values and rotor; columns of one at a time."""
    loop = Loop(mjcf(name))
    m = loop.model
    motions = list(zip(*states(loop, 30), strict=True))
    m.body_mass[:], m.body_inertia[:], m.dof_armature[:] = 0.0, 0.0, 0.0
    m.body_sameframe[:], m.body_simple[:], m.dof_simplenum[:] = 0, 0, 0
    columns = []
    for body in range(1, m.nbody):
        for _ in basis(m, body):
            columns.append(np.ravel([loop.torques(*motion) for motion in motions]))
    for dof in loop.driven:
        m.dof_armature[dof] = 1.0
        columns.append(np.ravel([loop.torques(*motion) for motion in motions]))
        m.dof_armature[dof] = 0.0
    matrix = np.array(columns).T
    lengths = np.linalg.norm(matrix, axis=0)
    matrix = matrix[:, lengths > 1e-9] / lengths[lengths > 1e-9]
    singular = np.linalg.svd(matrix, compute_uv=False)
    rank = int(np.sum(singular > 1e-9 * singular[0]))
    counts = derivation_of(name, folder).base.count_by_kind()
    assert rank == counts["inertial"] + counts["rotor_inertia"]


def test_parallelograms_are_ones_by_their_symbols(folder):
    """Equal lengths are one symbol, that of the link between two joints too: the proof is exact."""
    base = derivation_of("one on another", folder).base
    assert base.proof.kind == "exact" and "seemed to follow" not in base.proof.statement
