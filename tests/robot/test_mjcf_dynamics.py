"""MJCFs that others publish, through table and derivation, against MuJoCo on the same file.

MuJoCo reads the file by itself, moves it, and gives masses and inertias; from those, and from where
`[frames]` says that the links are, the standard parameters follow here. Nothing of the reader's
lumping, and nothing of MuJoCo's dynamics, is in what is compared.
"""

import warnings
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.emit import emit
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.numeric_rank import evaluate_regressor
from modeler.formats.body_tree import compute_body_poses
from modeler.formats.mjcf import read_mjcf_tree
from modeler.formats.tree_cuts import cut_tree
from modeler.formats.tree_text import convert_tree
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import INERTIAL, JointKind
from tests.elementary_motions import frames
from tests.modules import loaded
from tests.robot.poses import place_on_row
from tests.rotation import with_cases

mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: mujoco-core is not installed")

GYM, DM, SUITE = "gymnasium_robotics/envs", "dm_control", "robosuite/models/assets"
FILES = [
    *(
        f"{GYM}/mujoco/assets/{n}.xml"
        for n in ("ant", "half_cheetah", "humanoid", "pusher", "reacher", "swimmer", "walker2d")
    ),
    f"{GYM}/assets/fetch/reach.xml",
    f"{GYM}/assets/hand/reach.xml",
    f"{GYM}/assets/adroit_hand/adroit_pen.xml",
    f"{GYM}/assets/kitchen_franka/kitchen_assets/kitchen_env_model.xml",
    *(f"{DM}/suite/{n}.xml" for n in ("manipulator", "fish", "hopper", "humanoid_CMU", "finger")),
    f"{DM}/third_party/kinova/jaco_arm.xml",
    *(
        f"{SUITE}/robots/{n}/robot.xml"
        for n in ("panda", "sawyer", "ur5e", "iiwa", "kinova3", "baxter")
    ),
    f"{SUITE}/grippers/robotiq_gripper_s.xml",
]


KINDS = ("ant.xml", "walker2d.xml", "pusher.xml", "fetch/reach.xml")
"""A tree, a chain whose base moves in a plane, an arm, one on slides with fixed bodies."""


def there(file):
    """The file in the folder of its package, which is not imported for it; None without."""
    package, _, inside = file.partition("/")
    spec = find_spec(package)
    return Path(spec.submodule_search_locations[0]) / inside if spec else None


def each_of(files, always):
    """The test for every one of the files, as `path`; what is not installed is skipped, loudly.

    Args:
        files: of `FILES`.
        always: ends of the names of those that do not rotate.
    """
    packages = sorted({file.split("/")[0] for file in files if there(file) is None})
    name = "{0[0]}-{0[1]}".format
    return with_cases(
        "path",
        *(
            pytest.param(
                there(f),
                id=name(f.removesuffix("/robot.xml").split("/")[-2:]),
                marks=() if f.endswith(always) else pytest.mark.rotating,
            )
            for f in files
            if there(f)
        ),
        *(
            pytest.param(
                None, id=p, marks=pytest.mark.skip(f"NOT CHECKED: {p}, which is not installed")
            )
            for p in packages
        ),
    )


@contextmanager
def quiet():
    """MuJoCo's own words about others' files are not ours to judge."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _text: None)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield
    mujoco.set_mju_user_warning(before)


def rigid_model(path):
    """The file as MuJoCo has it, with nothing but rigid bodies, rotors and gravity."""
    with quiet():
        model = mujoco.MjModel.from_xml_path(str(path))
    off = mujoco.mjtDisableBit
    model.opt.disableflags |= int(off.mjDSBL_CONSTRAINT | off.mjDSBL_SPRING | off.mjDSBL_DAMPER)
    model.opt.density = model.opt.viscosity = 0.0
    model.body_gravcomp[:] = 0.0
    model.tendon_armature[:] = 0.0
    return model


class Both:
    """A file as MuJoCo and as we have it."""

    def __init__(self, path, exact=False):
        self.tree = cut_tree(read_mjcf_tree(path, exact_decimals=exact))
        self.robot = parse_robot_text(convert_tree(self.tree, str(path)).text, "robot.toml")
        self.model = m = rigid_model(path)
        self.data = mujoco.MjData(m)
        self.names = [m.joint(i).name or f"joint{i}" for i in range(m.njnt)]
        self.bodies = [m.body(i).name or f"body{i}" for i in range(m.nbody)]
        self.moving = [j for j in self.tree.joints if j.kind is not JointKind.FIXED]
        numbers = [self.names.index(j.name) for j in self.moving]
        self.places, self.dofs = m.jnt_qposadr[numbers], m.jnt_dofadr[numbers]
        # q = G q_free + offset, so tau_free = G' tau.
        free = [j.name for j in self.moving if not j.leader]
        self.G, self.offset = np.zeros((len(self.moving), len(free))), np.zeros(len(self.moving))
        for k, joint in enumerate(self.moving):
            self.G[k, free.index(joint.leader or joint.name)] = joint.ratio
            self.offset[k] = joint.offset
        if not exact:
            self.put_our_decimals()

    def put_our_decimals(self):
        """Give MuJoCo's bodies the poses and axes that ours have, where roundings are made good."""
        below = {joint.parent: joint.child for joint in self.tree.joints}
        for joint in self.tree.joints:
            child = joint.child
            while child in self.tree.auxiliary_bodies:
                child = below[child]
            body = self.bodies.index(child)
            if joint.parent not in self.tree.auxiliary_bodies:
                self.model.body_pos[body] = joint.pose.position
                mujoco.mju_mat2Quat(self.model.body_quat[body], joint.pose.rotation.ravel())
            if joint.kind is not JointKind.FIXED:
                place = self.names.index(joint.name)
                self.model.jnt_axis[place], self.model.jnt_pos[place] = joint.axis, joint.point
                self.model.qpos0[self.model.jnt_qposadr[place]] = joint.zero

    def states(self, count):
        rng, n = np.random.default_rng(), self.G.shape[1]
        return rng.uniform(-2, 2, (count, n)), *rng.normal(0, 1.5, (2, count, n))

    def torques(self, states):
        """(samples, free joints) of MuJoCo."""
        d, samples = self.data, []
        for q, qd, qdd in zip(*states, strict=True):
            d.qpos[:] = self.model.qpos0
            d.qvel[:], d.qacc[:] = 0.0, 0.0
            d.qpos[self.places] = self.G @ q + self.offset
            d.qvel[self.dofs], d.qacc[self.dofs] = self.G @ qd, self.G @ qdd
            mujoco.mj_inverse(self.model, d)
            samples.append(self.G.T @ d.qfrc_inverse[self.dofs])
        return np.array(samples)

    def links(self):
        """MuJoCo's number of every body on a row, with its row and its place there."""
        values = self.robot.evaluate_symbols()
        for link, frame in self.robot.frames.items():
            if link in self.bodies:
                yield self.bodies.index(link), frame.row, place_on_row(self.robot, link, values)
            else:
                assert link in self.tree.auxiliary_bodies

    def standard(self):
        """Standard parameters of MuJoCo's bodies, and the rotors of the file."""
        rows = [joint.name for joint in self.robot.moving_joints]
        chi = {f"{prefix}{row}": 0.0 for row in rows for prefix in INERTIAL}
        for i, row, pose in self.links():
            if row == "0":
                continue
            actual = np.zeros(9)
            mujoco.mju_quat2Mat(actual, self.model.body_iquat[i])
            rotation = pose[:3, :3] @ actual.reshape(3, 3)
            mass, c = self.model.body_mass[i], pose[:3, :3] @ self.model.body_ipos[i] + pose[:3, 3]
            tensor = rotation @ np.diag(self.model.body_inertia[i]) @ rotation.T
            tensor += mass * (c @ c * np.eye(3) - np.outer(c, c))
            ten = [*tensor[np.triu_indices(3)], *(mass * c), mass]
            for prefix, worth in zip(INERTIAL, ten, strict=True):
                chi[f"{prefix}{row}"] += worth
        rotors = self.model.dof_armature[self.dofs]
        return chi | {f"Ia{row}": worth for row, worth in zip(rows, rotors, strict=True)}


def alike(ours, theirs, tolerance):
    """Relative to what each joint has to give."""
    size = np.sqrt(np.mean(theirs**2, axis=0)) + 1e-9 * np.max(np.abs(theirs))
    return np.max(np.abs(ours - theirs) / size) < tolerance


each_file = each_of(FILES, KINDS)


@each_file
@pytest.mark.parametrize("exact", [False, True], ids=["table", "as printed"])
def test_every_body_is_where_mujoco_has_it(path, exact):
    """By the rows and `[frames]`, roundings made good; along the joints, with the file's decimals.

    At ten postures.
    """
    both = Both(path, exact)
    names = [joint.name for joint in (both.moving if exact else both.robot.moving_joints)]
    states = both.states(10)
    for k in range(10):
        both.torques([part[k : k + 1] for part in states])
        q = dict(zip(names, both.G @ states[0][k] + both.offset, strict=True))
        if exact:
            ways = compute_body_poses(both.tree, q).items()
            places = {
                both.bodies.index(body): (pose.position, pose.rotation)
                for body, pose in ways
                if body not in both.tree.auxiliary_bodies
            }
        else:
            rows = frames(both.robot, q)
            poses = {i: rows[row] @ place for i, row, place in both.links()}
            places = {i: (pose[:3, 3], pose[:3, :3]) for i, pose in poses.items()}
        assert len(places) > both.model.nbody / 2
        for i, (position, rotation) in places.items():
            size = max(1.0, np.abs(both.data.xpos[i]).max())
            assert np.abs(position - both.data.xpos[i]).max() < 1e-12 * size, both.bodies[i]
            assert np.abs(rotation.ravel() - both.data.xmat[i]).max() < 1e-12, both.bodies[i]


@each_file
def test_torques_are_mujocos(path):
    both = Both(path)
    model, chi = derive_model(both.robot), both.standard()
    states = both.states(50)
    values = np.array([chi.get(name, 0.0) for name in model.names])
    assert alike(evaluate_regressor(model, states) @ values, both.torques(states), 1e-9)
    for name, worth in both.robot.parameters.items():  # as the robot file states them
        if name in chi:
            assert abs(worth - chi[name]) < 1e-12 * max(abs(x) for x in chi.values()), name


@pytest.mark.rotating("C of converted robots")
@each_of([FILES[3]], FILES[3])
def test_torques_of_the_c_are_mujocos(path):
    both = Both(path)
    model, chi = derive_model(both.robot), both.standard()
    c = loaded(emit(model, derive_base_parameters(model)))
    beta = c.base_parameters(np.array([chi.get(name, 0.0) for name in model.names]))
    states = both.states(50)
    assert alike(c.inverse_dynamics(*states, beta), both.torques(states), 1e-9)


@each_of(FILES, ("reacher.xml", "walker2d.xml", "ant.xml"))
def test_there_are_as_many_base_parameters_as_mujoco_feels(path):
    """Rank of MuJoCo's torques with one body at a time, of ten different sets of values."""
    both = Both(path)
    base = derive_base_parameters(derive_model(both.robot)).count_by_kind()
    m, states = both.model, both.states(30)
    m.body_mass[:], m.body_inertia[:] = 0.0, 0.0
    m.dof_armature[:] = 0.0
    m.actuator_armature[:] = 0.0
    m.body_sameframe[:], m.body_simple[:], m.dof_simplenum[:] = 0, 0, 0  # values may be any
    last = {row: i for i, row, _ in both.links() if row != "0"}
    half = np.sqrt(0.5)
    turns = [(1, 0, 0, 0), (half, 0, 0, half), (half, 0, half, 0), (half, half, 0, 0)]
    eighths = [(np.cos(np.pi / 8), *(np.sin(np.pi / 8) * np.eye(3)[k])) for k in range(3)]
    sets = [(0, (0, 0, 0), e, turns[0]) for e in np.eye(3)]
    sets += [(0, (0, 0, 0), e, t) for e, t in zip(np.eye(3)[[1, 2, 0]], eighths, strict=True)]
    sets += [(1, p, (0, 0, 0), turns[0]) for p in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))]
    columns = []
    with quiet():  # about inertia matrices that are singular, as they are meant to be
        for i in last.values():
            for m.body_mass[i], m.body_ipos[i], m.body_inertia[i], m.body_iquat[i] in sets:
                columns.append(both.torques(states).ravel())
            m.body_mass[i], m.body_inertia[i] = 0.0, 0.0
        for dof, joint in zip(both.dofs, both.robot.moving_joints, strict=True):
            if not both.robot.has_effect("rotor_inertia", joint.name):
                continue
            m.dof_armature[dof] = 1.0
            columns.append(both.torques(states).ravel())
            m.dof_armature[dof] = 0.0
    matrix = np.array(columns).T
    lengths = np.linalg.norm(matrix, axis=0)
    matrix = matrix[:, lengths > 1e-9] / lengths[lengths > 1e-9]
    singular = np.linalg.svd(matrix, compute_uv=False)
    rank = int(np.sum(singular > 1e-9 * singular[0]))
    assert rank == base["inertial"] + base["rotor_inertia"]
