"""URDFs as robot files: against Pinocchio on public robots, from the text to the torques."""

import dataclasses
import math
import re
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from modeler.codegen.emit import emit
from modeler.core.errors import RobotError
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.numeric_rank import evaluate_regressor
from modeler.formats.read import convert_robot_file
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import Robot
from tests.modules import loaded
from tests.robot.poses import link_poses
from tests.robot.public_robots import each_public_urdf, public_urdf
from tests.rotation import ROTATING, with_cases

pin = pytest.importorskip("pinocchio", reason="NOT CHECKED: Pinocchio (PyPI: pin) is not installed")

NOT_MOVING = "no joint of the robot moves"
RANKED = tuple(
    """
    panda xarm7 kinova so100 so101 talos_left_arm tiago_no_hand allegro_right_hand bolt finger_edu
    hyq_no_sensors TwoDofs b1-z1 anymal-kinova
""".split()
)
# More joints than derive in seconds: two arms, a hand of which three fingers follow others.
LOCKED = {
    "baxter": "head_pan",
    "tiago": "arm_1 arm_2 arm_3 arm_4 arm_5 arm_6 arm_7 torso_lift head_1 head_2 wheel_left "
    "wheel_right",
}


def snapped(path: Path, to: Path) -> Path:
    """A copy in which the origins of joints are what their printed digits round.

    Written apart from the reader: a multiple of pi/12 that prints as these digits, rounded or cut
    off, of which there are three behind the point (two for a right angle), or that is within 1e-6.
    """

    def angle(digits: str) -> str:
        worth = float(digits)
        twelfths = round(worth * 12 / math.pi)
        exact = twelfths * math.pi / 12
        if abs(worth) < 1e-6:
            return "0"
        plain = re.fullmatch(r"[-+]?\d*\.?(\d*)", digits)
        places = [len(plain[1]), len(plain[1].rstrip("0"))] if plain else []
        for count in places:
            if count < (2 if twelfths % 6 == 0 else 3) or twelfths == 0:
                continue
            cut = math.trunc(exact * 10**count) / 10**count
            if any(abs(worth - x) < 1e-12 for x in (round(exact, count), cut)):
                return repr(exact)
        return repr(exact) if abs(worth - exact) < 1e-6 and twelfths else digits

    def length(digits: str) -> str:
        return "0" if abs(float(digits)) < 1e-6 else digits

    tree = ElementTree.parse(path)
    for joint in tree.getroot().iter("joint"):
        for tag, name, change in (
            ("origin", "rpy", angle),
            ("origin", "xyz", length),
            ("axis", "xyz", length),
        ):
            for element in joint.findall(tag):
                if name in element.attrib:
                    words = element.attrib[name].split()
                    element.set(name, " ".join(map(change, words)))
    tree.write(to / path.name)
    return to / path.name


class PinocchioModel:
    """Pinocchio's model of a file, and which of its joints are the rows of a robot of ours."""

    def __init__(self, robot: Robot, file: Path, locked: tuple[str, ...] = ()):
        model = pin.buildModelFromUrdf(str(file))
        if locked:
            held = [model.getJointId(name) for name in locked]
            model = pin.buildReducedModel(model, held, pin.neutral(model))
        self.joints = {f.row: f.joint for f in robot.frames.values() if f.joint}
        self.rows = [joint.name for joint in robot.moving_joints]
        assert {self.joints[row] for row in self.rows} == set(model.names) - {"universe"}
        self.ids = [model.getJointId(self.joints[row]) for row in self.rows]
        self.at = [model.joints[i].idx_v for i in self.ids]
        self.model, self.data = model, model.createData()
        # By hand: q = A q_free + o, tau_free = A^T tau.
        names = [joint.name for joint in robot.coordinates]
        self.A, self.o = np.zeros((len(self.rows), len(names))), np.zeros(len(self.rows))
        for i, row in enumerate(self.rows):
            if row in names:
                self.A[i, names.index(row)] = 1.0
                continue
            mimic = ElementTree.parse(file).find(f"joint[@name='{self.joints[row]}']/mimic")
            leader = next(r for r in self.rows if self.joints[r] == mimic.get("joint"))
            self.A[i, names.index(leader)] = float(mimic.get("multiplier", 1))
            self.o[i] = float(mimic.get("offset", 0))

    def state(self, q, *others):
        full = [np.zeros(self.model.nv) for _ in range(1 + len(others))]
        full[0][self.at] = self.A @ q + self.o
        for x, entry in zip(full[1:], others, strict=True):
            x[self.at] = self.A @ entry
        return pin.integrate(self.model, pin.neutral(self.model), full[0]), *full[1:]

    def torque(self, q, qd, qdd):
        return self.A.T @ pin.rnea(self.model, self.data, *self.state(q, qd, qdd))[self.at]

    def regressor(self, q, qd, qdd):
        """(joints, 10 bodies that move)."""
        Y = pin.computeJointTorqueRegressor(self.model, self.data, *self.state(q, qd, qdd))
        return self.A.T @ np.atleast_2d(Y)[self.at]


def motion(robot: Robot, samples: int, name: str) -> np.ndarray:
    rng = np.random.default_rng(zlib.crc32(name.encode()))
    return rng.uniform(-2, 2, (3, samples, len(robot.coordinates)))


def chi_of(robot: Robot) -> np.ndarray:
    joints = [row.name for row in robot.moving_joints]
    names = [f"{p}{joint}" for joint in joints for p in robot.get_inertial_prefixes(joint)]
    return np.array([robot.parameters.get(name, 0.0) for name in names])


def read(path: Path, locked: tuple[str, ...] = ()) -> Robot:
    text = convert_robot_file(path, locks=dict.fromkeys(locked, 0.0)).text
    return dataclasses.replace(parse_robot_text(text, path.name), effects=())


@each_public_urdf()
def test_torques_and_frames_of_every_public_robot(path: Path, tmp_path: Path):
    """tau to 1e-9 and the frame of every link to 1e-12, on the same numbers."""
    if b"<link" not in path.read_bytes():
        pytest.skip("has no link")
    try:
        robot = read(path)
    except RobotError as error:
        assert NOT_MOVING in str(error)
        return
    peer = PinocchioModel(robot, snapped(path, tmp_path))
    samples = 50 if len(robot.moving_joints) < 40 else 5
    q, qd, qdd = motion(robot, samples, path.stem)
    theirs = np.array([peer.torque(*one) for one in zip(q, qd, qdd, strict=True)])
    ours = evaluate_regressor(derive_model(robot), (q, qd, qdd)) @ chi_of(robot)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * (abs(theirs).max() or 1.0))
    pin.framesForwardKinematics(peer.model, peer.data, peer.state(q[0])[0])
    for link, pose in link_poses(robot, peer.A @ q[0] + peer.o).items():
        there = peer.data.oMf[peer.model.getFrameId(link, pin.FrameType.BODY)]
        np.testing.assert_allclose(pose, there.homogeneous, rtol=0, atol=1e-12, err_msg=link)


@with_cases(
    "name",
    *("double_pendulum_continuous", "ur3_robot", "z1"),
    *(pytest.param(name, marks=pytest.mark.rotating) for name in RANKED),
    *(pytest.param(name, marks=ROTATING) for name in LOCKED),
)
def test_base_parameters_are_as_many_as_the_rank(name: str, tmp_path: Path):
    """The rank of Pinocchio's regressor on random motion, joints that follow taken out by hand."""
    path = public_urdf(f"{name}.urdf")
    locked = tuple(j if j == "head_pan" else f"{j}_joint" for j in LOCKED.get(name, "").split())
    robot = read(path, locked)
    peer = PinocchioModel(robot, snapped(path, tmp_path), locked)
    states = zip(*motion(robot, 12 * len(robot.coordinates) + 20, name), strict=True)
    W = np.vstack([peer.regressor(*one) for one in states])
    size = np.linalg.norm(W, axis=0)
    felt = size > 1e-10 * size.max()  # the others are rounding
    R = np.linalg.qr(W[:, felt] / size[felt], mode="r")
    sizes = np.linalg.svd(R, compute_uv=False)
    rank = int(np.sum(sizes > 1e-9 * sizes[0]))
    assert sizes[rank - 1] > 1e3 * (sizes[rank] if rank < len(sizes) else 0.0)
    base = derive_base_parameters(derive_model(robot))
    assert base.rank == rank
    assert base.proof.kind == "exact"


@pytest.mark.rotating("C of converted robots")
def test_emitted_c_of_a_urdf(tmp_path: Path):
    path = public_urdf("so101.urdf")
    robot = read(path)
    model = derive_model(robot)
    c = loaded(emit(model, derive_base_parameters(model)))
    peer = PinocchioModel(robot, snapped(path, tmp_path))
    q, qd, qdd = motion(robot, 50, path.stem)
    theirs = np.array([peer.torque(*one) for one in zip(q, qd, qdd, strict=True)])
    ours = c.inverse_dynamics(q, qd, qdd, c.base_parameters(chi_of(robot)))
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * abs(theirs).max())
