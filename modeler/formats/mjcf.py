"""MJCF as a tree of bodies: MuJoCo itself reads it, so that defaults and rules are its own.

What is read is the model as MuJoCo compiles it: default classes, frames, included and attached
files, replicas, inertia from geoms. Before that, what no robot model needs is taken out (pictures,
meshes of bodies whose inertia is stated), so that files that are not there do not matter.
"""

import math
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import RobotError, flatten_message, suggest_install
from modeler.core.files import read_file
from modeler.core.toml_cells import quote_value
from modeler.formats.body_tree import (
    ALIKE,
    EXACT,
    BodyTree,
    Couplings,
    Inertial,
    LoopClosure,
    Pose,
    Roundings,
    TreeJoint,
    compute_quaternion_rotation,
    find_inertia_defect,
    snap_direction,
    snap_quaternion,
    summarise_names,
)
from modeler.formats.thresholds import THRESHOLDS
from modeler.formats.tree_cuts import resolve_leaders
from modeler.formats.xml_source import LARGEST_FILE, Element, load_element_table, parse_xml
from modeler.robot import JointKind

_COUNTS = {"replicate": ("count", 1e3), "hfield": ("nrow ncol", 1e6), "mesh": ("params", 1e3)}
"""Element -> attributes whose product makes bodies or numbers, and how many at most."""
_FREE, _BALL, _SLIDE, _HINGE = range(4)  # mjtJoint
_WRAP_JOINT = 1  # mjtWrap
_LEFT_OUT = """
    cameras lights hfields sensors pairs excludes skins tuples numerics texts materials textures
"""
_NUMBERS = """
    body_pos body_mass body_ipos body_inertia jnt_pos qpos0 eq_data dof_damping dof_armature
    actuator_gear actuator_damping actuator_armature
"""
_NUMBER = re.compile(r"\d+\.?\d*(?:[eE]\+?\d+)?")
_ALWAYS = 1  # inertiafromgeom="true"


def read_mjcf_tree(path: Path, exact_decimals: bool = False) -> BodyTree:
    """Returns the robot of an MJCF file; the world is the root.

    Ball joints are in `unread`; what floats stands still where the file has it.

    Args:
        path: the file; what it includes stands beside it.
        exact_decimals: take rounded angles (1.5708, 0.707107) and lengths below 1 um as printed.

    Raises:
        RobotError: MuJoCo is not installed or refuses the file; a constraint that has no place in
            a robot file. One line.
    """
    mujoco = _import_mujoco(path)
    sources = _read_sources(path)
    texts = ((str(file), root) for file, root in sources)
    element_notes = load_element_table("mjcf").collect_notes(texts)
    with _suppress_warnings(mujoco, path):
        spec = mujoco.MjSpec.from_file(str(path))
        notes = _remove_irrelevant_parts(spec, path)
        notes += [] if exact_decimals else _snap_decimals(spec)
        model = spec.compile()
    reading = _ModelReader(mujoco, path, model, [*notes, *element_notes])
    return reading.read_tree(sources[0][1].attributes.get("model") or path.stem)


def _import_mujoco(path: Path) -> Any:
    try:
        import mujoco  # type: ignore[import-untyped]
    except ImportError as error:
        what = "is not installed" if error.name == "mujoco" else f"does not load ({error})"
        raise RobotError(
            flatten_message(
                f"{path}: MJCF is read by MuJoCo, which {what}; run: {suggest_install('mjcf')}"
            )
        ) from None
    return mujoco


@contextmanager
def _suppress_warnings(mujoco: Any, path: Path) -> Iterator[None]:
    """MuJoCo's warnings go nowhere (else to the screen and MUJOCO_LOG.TXT), refusals are a line."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _text: None)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    except (
        ValueError,
        TypeError,
        RuntimeError,
        MemoryError,
        mujoco.FatalError,
        mujoco.UnexpectedError,
    ) as error:
        message = " ".join(str(error).split()).replace("XML Error: ", "").replace("Error: ", "")
        what = f"{path}: MuJoCo does not take it: {message}; correct it there"
        raise RobotError(flatten_message(what)) from None
    finally:
        mujoco.set_mju_user_warning(before)


# The text: everything that MuJoCo is going to read is looked at first.


def _read_sources(path: Path) -> list[tuple[Path, Element]]:
    """The file and models that it attaches, XML of bounded size; what they include stands there."""
    root = _parse_source(path, "")
    if root.tag != "mujoco":
        raise RobotError(f"{path}: line {root.line}: got <{root.tag[:20]}>; expected <mujoco>")
    waiting, seen, roots = [(path, root)], {path.resolve()}, [(path, root)]
    while waiting:
        place, element = waiting.pop()
        _check_counts(place, element)
        for part in list(element.iterate_elements()):
            file = part.attributes.get("file", "")
            if not file or part.tag not in ("include", "model"):
                continue
            beside = [path.parent / file, place.parent / file]
            included_path = next((one for one in beside if one.is_file()), beside[0])
            if included_path.resolve() not in seen:
                seen.add(included_path.resolve())
                inner = _parse_source(included_path, f"{place}: line {part.line}: includes ")
                waiting.append((included_path, inner))
                if part.tag == "include":
                    part.children = inner.children
                else:
                    roots.append((included_path, inner))
            if len(seen) > THRESHOLDS.max_included_files:
                most = THRESHOLDS.max_included_files
                raise RobotError(f"{path}: expected at most {most} included files")
    return roots


def _parse_source(path: Path, included: str) -> Element:
    try:
        data = read_file(path, LARGEST_FILE)
    except (OSError, ValueError) as error:
        what = getattr(error, "strerror", None) or str(error)
        todo = "; put it there or take the line out" if included else ""
        message = f"{included}{path}{', which' if included else ':'} cannot be read ({what}){todo}"
        raise RobotError(flatten_message(message)) from None
    return parse_xml(data, str(path))


def _check_counts(path: Path, root: Element) -> None:
    """Refuse what makes many bodies or numbers of few letters."""
    waiting = [(root, 1.0)]
    while waiting:
        element, times = waiting.pop()
        where = f"{path}: line {element.line}: <{element.tag[:20]}>"
        key, most = _COUNTS.get(element.tag, ("", math.inf))
        stated_text = " ".join(element.attributes.get(name, "") for name in key.split())
        count = math.prod(max(float(number), 1.0) for number in _NUMBER.findall(stated_text))
        if element.tag == "replicate":
            count = times = times * count
        if count > most:
            got = f"{key}: got {quote_value(stated_text)}"
            raise RobotError(f"{where}: {got}; expected at most {most:g} in all")
        waiting += [(child, times) for child in element.children]


# What is taken out before MuJoCo compiles.


def _remove_irrelevant_parts(spec: Any, path: Path) -> list[str]:
    """Take out what no robot needs, and say what of it weighs: pictures, and bodies of a scene."""
    for name in dir(spec):
        if name.startswith("nuser_"):
            setattr(spec, name, -1)
    spec.compiler.discardvisual = spec.compiler.fusestatic = False
    spec.memory, spec.nkey, spec.nuserdata = -1, 0, 0  # as much as MuJoCo finds necessary
    notes, removed_bodies = list[str](), []
    for body in spec.worldbody.bodies:
        floats = any(joint.type == _FREE for joint in body.joints)
        if not floats and not body.mocap:
            continue
        what = "floats" if floats else "is dragged by the simulator (mocap)"
        note = "here it stands still where the file has it"
        if len(body.find_all("joint")) == floats:
            note = "it is left out with what ties it, for it has no joint"
            removed_bodies.append(body)
        notes.append(f"{body.name or 'a body'} {what}; {note}")
    total = spec.compiler.settotalmass
    for body in [] if total > 0.0 else removed_bodies:
        spec.delete(body)
    without = _remove_shapes(spec)
    if without and total > 0.0:
        raise RobotError(
            flatten_message(
                f"{path}: settotalmass shares {total:g} kg by masses of meshes that are not there, "
                f"of {summarise_names(without)}; put them there, or take settotalmass out"
            )
        )
    if total > 0.0 and removed_bodies:
        scaled = spec.compile().body_mass
        removed_ids = [b.id for body in removed_bodies for b in (body, *body.find_all("body"))]
        spec.compiler.settotalmass = total - float(np.sum(scaled[removed_ids]))
        for body in removed_bodies:
            spec.delete(body)
    note = f"no values of {summarise_names(without)}: they follow from meshes that are not there"
    return [*notes, note] if without else notes


def _remove_shapes(spec: Any) -> list[str]:
    """Take out what neither moves nor weighs; bodies that state nothing get next to nothing.

    Returns:
        Those whose inertia follows from a mesh that is not there.
    """
    without, used, here = [], set(), spec.modelfiledir
    for body in spec.bodies:
        shapes = [geom for geom in body.geoms if geom.meshname or geom.hfieldname]
        stated = body.explicitinertial and body.compiler.inertiafromgeom != _ALWAYS
        absent = False
        for geom in shapes:
            mesh = spec.mesh(geom.meshname) if geom.meshname else None
            if stated or mesh is None or not _has_mass(body, geom):
                spec.delete(geom)
            elif mesh.file and not Path(here, mesh.compiler.meshdir, mesh.file).is_file():
                without.append(f"{body.name} ({Path(mesh.file).name})")
                absent = True
            else:
                used.add(mesh.name)
                geom.contype = geom.conaffinity = 0  # it needs no hull then
        if body.name != "world" and (absent or not (stated or body.geoms)):
            for geom in body.geoms:
                spec.delete(geom)
            body.explicitinertial = True
            body.mass = THRESHOLDS.placeholder_inertia
            body.inertia = [THRESHOLDS.placeholder_inertia] * 3
    for part in [*spec.geoms, *spec.sites]:
        part.material = ""
    idle = [part for name in _LEFT_OUT.split() for part in getattr(spec, name)]
    for part in [*idle, *(mesh for mesh in spec.meshes if mesh.name not in used)]:
        spec.delete(part)
    return without


def _has_mass(body: Any, geom: Any) -> bool:
    low, high = body.compiler.inertiagrouprange
    weight = geom.density if math.isnan(geom.mass) else geom.mass
    return bool(weight != 0 and low <= geom.group <= high)


# Decimals that round something: taken for it before MuJoCo compiles.


def _snap_decimals(spec: Any) -> list[str]:
    """Put multiples of pi/12 for their roundings, 0 for lengths below 1 um; says so."""
    rounded = Roundings(exact=False)

    def snap_angle(value: float, degree: bool) -> float:
        return value if degree else rounded.snap_angle(repr(float(value)))

    for part in [*spec.bodies, *spec.frames]:
        orientation_kind, degree = part.alt.type.name, part.compiler.degree
        if orientation_kind == "mjORIENTATION_QUAT":
            part.quat = snap_quaternion(np.array(part.quat), rounded)
        elif orientation_kind == "mjORIENTATION_EULER":
            part.alt.euler = [snap_angle(x, degree) for x in part.alt.euler]
        elif orientation_kind == "mjORIENTATION_AXISANGLE":
            *axis, turn = part.alt.axisangle
            axis = snap_direction(np.array(axis), rounded)
            part.alt.axisangle = [*axis, snap_angle(turn, degree)]
    for joint in spec.joints:
        joint.axis = snap_direction(np.array(joint.axis), rounded)
        if joint.type == _HINGE:
            joint.ref = snap_angle(joint.ref, joint.compiler.degree)
    for part in [*spec.bodies, *spec.frames, *spec.joints, *spec.sites]:
        part.pos = rounded.snap_lengths(np.array(part.pos))
    return list(rounded.describe_roundings())


# What MuJoCo has compiled.


class _ModelReader:
    """A compiled model, and what has been decided about it."""

    def __init__(self, mujoco: Any, path: Path, model: Any, notes: list[str]) -> None:
        self._mujoco, self._path, self._model, self._notes = mujoco, path, model, notes
        self._bodies = _fill_names("body", [model.body(i).name for i in range(model.nbody)])
        self._joints = _fill_names("joint", [model.joint(i).name for i in range(model.njnt)])
        self._single = np.isin(model.jnt_type, [_HINGE, _SLIDE])
        self._actuated = self._find_driven_joints()

    def read_tree(self, name: str) -> BodyTree:
        """Returns all of the compiled model as a tree of bodies."""
        model, hidden, unread = self._model, set[str](), dict[str, str]()
        for numbers in _NUMBERS.split():
            if not np.all(np.abs(getattr(model, numbers)) < THRESHOLDS.max_mjcf_number):
                most = f"{THRESHOLDS.max_mjcf_number:g}"
                raise self._build_error(f"{numbers}: got more than {most}; expected SI units")
        if np.all(model.jnt_type == _FREE):
            raise self._build_error("no hinge or slide moves anything; expected a robot")
        joints = tuple(self._read_tree_joints(hidden, unread))
        joints, meetings = self._couple_joints(joints), tuple(self._read_loop_closures())
        self._add_notes()
        bodies = {n: self._read_inertial(i) for i, n in enumerate(self._bodies)}
        return BodyTree(
            name,
            "MJCF",
            self._bodies[0],
            bodies | dict.fromkeys(hidden),
            joints,
            meetings,
            gravity=np.zeros(3) if self._is_disabled("GRAVITY") else np.array(model.opt.gravity),
            auxiliary_bodies=frozenset(hidden),
            unreliable_bodies={
                n: why for n, body in bodies.items() if body and (why := find_inertia_defect(body))
            },
            unsupported_joints=unread,
            home=self._read_home() if meetings else {},
            notes=tuple(self._notes),
        )

    # Bodies.

    def _read_inertial(self, body: int) -> Inertial | None:
        model = self._model
        mass, moments = float(model.body_mass[body]), model.body_inertia[body]
        if mass < THRESHOLDS.min_stated_mass and np.all(moments < THRESHOLDS.min_stated_mass):
            return None
        turn = compute_quaternion_rotation(model.body_iquat[body])
        inertia = turn @ np.diag(moments) @ turn.T
        inertia[np.abs(inertia) < 10 * EXACT * np.max(moments)] = 0.0
        return Inertial(mass, np.array(model.body_ipos[body]), inertia)

    # Joints.

    def _read_tree_joints(self, hidden: set[str], unread: dict[str, str]) -> Iterator[TreeJoint]:
        """Of the bodies that are kept; of several in a body, each turns those behind it."""
        model, taken = self._model, {*self._joints}
        for body, name in enumerate(self._bodies):
            if body == 0:
                continue
            parent = self._bodies[model.body_parentid[body]]
            turn = compute_quaternion_rotation(model.body_quat[body])
            pose = Pose(np.array(model.body_pos[body]), turn)
            body_joints = np.flatnonzero(model.jnt_bodyid == body).tolist()
            if not body_joints:
                label = _make_unique(name, taken)
                yield TreeJoint(label, JointKind.FIXED, parent, name, pose)
            for j in body_joints:
                child = name
                if j != body_joints[-1]:
                    child = _make_unique(f"{name}.{self._joints[j]}", {*self._bodies, *hidden})
                    hidden.add(child)
                joint = TreeJoint(self._joints[j], JointKind.FIXED, parent, child, pose)
                if model.jnt_type[j] == _BALL:
                    unread[joint.name] = f"{self._path}: joint {joint.name}: ball"
                yield self._read_moving_joint(joint, j) if self._single[j] else joint
                parent, pose = child, Pose()

    def _read_moving_joint(self, joint: TreeJoint, j: int) -> TreeJoint:
        """The joint with axis, limits and what resists it."""
        model = self._model
        dof, place = model.jnt_dofadr[j], model.jnt_qposadr[j]
        armature, damping = float(model.dof_armature[dof]), float(model.dof_damping[dof])
        for i in self._find_joint_actuators(j):  # on the motor's side: seen through the gear
            square = float(model.actuator_gear[i, 0]) ** 2
            armature += square * float(model.actuator_armature[i])
            damping += square * float(model.actuator_damping[i])
        lower, upper = map(float, model.jnt_range[j])
        stiffness, friction = float(model.jnt_stiffness[j]), float(model.dof_frictionloss[dof])
        return replace(
            joint,
            kind=JointKind.PRISMATIC if model.jnt_type[j] == _SLIDE else JointKind.REVOLUTE,
            axis=np.array(model.jnt_axis[j]),
            point=np.array(model.jnt_pos[j]),
            zero=float(model.qpos0[place]),
            lower=lower if model.jnt_limited[j] else None,
            upper=upper if model.jnt_limited[j] else None,
            effort=float(model.jnt_actfrcrange[j, 1]) if model.jnt_actfrclimited[j] else None,
            damping=None if self._is_disabled("DAMPER") else damping or None,
            friction=None if self._is_disabled("FRICTIONLOSS", "CONSTRAINT") else friction or None,
            armature=armature or None,
            stiffness=None if self._is_disabled("SPRING") else stiffness or None,
            rest=float(model.qpos_spring[place]),
            actuated=j in self._actuated,
        )

    def _find_joint_actuators(self, joint: int) -> np.ndarray:
        """Actuators that act on that joint alone."""
        model = self._model
        return np.flatnonzero((model.actuator_trntype < 2) & (model.actuator_trnid[:, 0] == joint))

    def _find_driven_joints(self) -> set[int]:
        """Joints that an actuator moves, through whatever transmission."""
        mujoco, model = self._mujoco, self._model
        data = mujoco.MjData(model)
        for j in np.flatnonzero(self._single):  # no posture in which a lever happens to vanish
            data.qpos[model.jnt_qposadr[j]] += 0.1 * math.sin(j + 1)
        for step in ("mj_kinematics", "mj_comPos", "mj_tendon", "mj_transmission"):
            getattr(mujoco, step)(model, data)
        acting = np.abs(np.ravel(data.actuator_moment)) > ALIKE
        dofs = np.ravel(data.moment_colind)[: acting.size][acting]
        return {int(model.dof_jntid[dof]) for dof in dofs}

    # Constraints.

    def _iterate_equalities(self) -> Iterator[tuple[str, int, str]]:
        """Active ones: kind, number, and a name."""
        model = self._model
        off = self._is_disabled("EQUALITY", "CONSTRAINT")
        for i in [] if off else np.flatnonzero(model.eq_active0).tolist():
            kind = self._mujoco.mjtEq(model.eq_type[i]).name.removeprefix("mjEQ_").lower()
            yield kind, i, model.equality(i).name or f"{kind} equality {i + 1}"

    def _couple_joints(self, joints: tuple[TreeJoint, ...]) -> tuple[TreeJoint, ...]:
        """Joints that equalities tie follow the one that has a motor, or stand still."""
        joints_by_name = {joint.name: joint for joint in joints}
        fixed_names, circle = resolve_leaders(joints_by_name, self._read_couplings())
        if circle:
            raise self._build_error(f"equalities let joint {circle} follow itself; take one out")
        self._notes += [f"joint {name} stands still: an equality holds it" for name in fixed_names]
        return tuple(joints_by_name.values())

    def _read_couplings(self) -> Couplings:
        """Joint -> that which it follows, "" for none, ratio and offset."""
        model, ties = self._model, dict[int, tuple[int, float, float]]()
        for kind, i, name in self._iterate_equalities():
            if kind not in ("joint", "tendon"):
                continue
            one, two = int(model.eq_obj1id[i]), int(model.eq_obj2id[i])
            constant, ratio, *others = map(float, model.eq_data[i, :5])
            if kind == "tendon":
                one, two, ratio, constant = self._read_tendon_pair(name, one, two, constant)
            elif two >= 0 and any(others):
                raise self._build_error(
                    f"{name} lets {self._joints[one]} follow {self._joints[two]} by a polynomial; "
                    "expected a straight line, polycoef 0 from the third on"
                )
            ratio = ratio if two >= 0 else 0.0
            zero = [float(model.qpos0[model.jnt_qposadr[j]]) for j in (one, two)]
            offset = zero[0] + constant - ratio * zero[1]
            if ratio and two not in {*self._actuated, *ties} and one in {*self._actuated, *ties}:
                one, two, ratio, offset = two, one, 1 / ratio, -offset / ratio
            if one in ties:
                follower = self._joints[one]
                raise self._build_error(f"{name}: {follower} follows another joint already")
            ties[one] = (two, ratio, offset)
        return {
            self._joints[one]: (self._joints[two] if ratio else "", ratio, offset)
            for one, (two, ratio, offset) in ties.items()
        }

    def _read_tendon_pair(
        self, name: str, tendon: int, other: int, constant: float
    ) -> tuple[int, int, float, float]:
        """Joint, leader, ratio, constant of a fixed tendon over two joints whose length is held."""
        model, first = self._model, int(self._model.tendon_adr[tendon])
        parts = range(first, first + int(model.tendon_num[tendon]))
        joints = [int(model.wrap_objid[p]) for p in parts]
        shares = [float(model.wrap_prm[p]) for p in parts]
        fixed = all(model.wrap_type[p] == _WRAP_JOINT for p in parts) and other < 0
        if not fixed or len(joints) != 2 or not all(shares):
            raise self._build_error(f"{name} holds a tendon; expected a fixed one over two joints")
        return joints[0], joints[1], -shares[1] / shares[0], constant / shares[0]

    def _read_loop_closures(self) -> Iterator[LoopClosure]:
        """Points that `connect` holds together."""
        model = self._model
        for kind, i, name in self._iterate_equalities():
            if kind in ("joint", "tendon"):
                continue
            if kind not in ("connect", "weld"):
                raise self._build_error(f"{name} is not read; expected joint, connect or weld")
            ends = [int(model.eq_obj1id[i]), int(model.eq_obj2id[i])]
            points = [np.array(model.eq_data[i, k : k + 3]) for k in (0, 3)]
            if model.eq_objtype[i] == int(self._mujoco.mjtObj.mjOBJ_SITE):
                points = [np.array(model.site_pos[site]) for site in ends]
                ends = [int(model.site_bodyid[site]) for site in ends]
            one, two = (self._bodies[end] for end in ends)
            if self._find_moving_body(ends[0]) == self._find_moving_body(ends[1]):
                self._notes.append(f"{name} of {one} and {two} is left out: they move as one")
            elif kind == "weld":
                raise self._build_error(f"{name} holds {one} and {two} rigidly; expected connect")
            else:
                points = [np.where(np.abs(point) < 10 * EXACT, 0.0, point) for point in points]
                yield LoopClosure(name, one, Pose(points[0]), two, Pose(points[1]))

    def _find_moving_body(self, body: int) -> int:
        """The body that has the joint which moves that one; 0 if none does."""
        model = self._model
        while body and not np.any(self._single[model.jnt_bodyid == body]):
            body = int(model.body_parentid[body])
        return body

    def _read_home(self) -> dict[str, float]:
        """Positions of the keyframe `home`; without one, where the file draws the robot."""
        model = self._model
        keys = {model.key(k).name: model.key_qpos[k] for k in range(model.nkey)}
        posture = keys.get("home", model.qpos0)[model.jnt_qposadr]
        return {self._joints[j]: float(posture[j]) for j in np.flatnonzero(self._single)}

    # What is reported.

    def _is_disabled(self, *flags: str) -> bool:
        """Whether an `<option><flag>` switches something off."""
        bits = [int(getattr(self._mujoco.mjtDisableBit, f"mjDSBL_{flag}")) for flag in flags]
        return any(self._model.opt.disableflags & bit for bit in bits)

    def _build_error(self, what: str) -> RobotError:
        return RobotError(flatten_message(f"{self._path}: {what}"))

    def _add_notes(self) -> None:
        model = self._model
        idle = model.neq - len(list(self._iterate_equalities()))
        curved = np.any(model.jnt_stiffnesspoly) or np.any(model.dof_dampingpoly)
        driven = [i for j in range(model.njnt) for i in self._find_joint_actuators(j)]
        gear = np.any(model.actuator_gear[driven, 0] != 1) and np.any(model.dof_armature)
        is_remote = np.any(np.delete(model.actuator_armature + model.actuator_damping, driven))
        inner = np.any(model.actuator_armature[driven]) or np.any(model.actuator_damping[driven])
        notes = {
            f"{idle} inactive equalities are left out": idle,
            "armature and damping of actuators on tendons, sites or bodies are left out": is_remote,
            "of polynomial springs and damping the linear term is taken": curved,
            "armature and damping of actuators are the motor's: gear^2 as much at a joint": inner,
            "armature of joints is taken at the joint; gear scales commands alone": gear,
        }
        self._notes += [what for what, is_so in notes.items() if is_so]


def _fill_names(kind: str, names: list[str]) -> list[str]:
    """The names, with `body3`, `joint2` for those that there are not."""
    taken = set(names)
    return [name or _make_unique(f"{kind}{i}", taken) for i, name in enumerate(names)]


def _make_unique(name: str, taken: set[str]) -> str:
    """The name, or one like it, that nothing has; taken from then on."""
    while name in taken:
        name += "_"
    taken.add(name)
    return name
