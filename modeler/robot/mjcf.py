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

from modeler.core.errors import RobotError, installing, on_one_line
from modeler.core.files import read_file
from modeler.core.toml_cells import shown
from modeler.robot.body_tree import (
    BodyTree,
    Inertial,
    Meeting,
    Pose,
    Roundings,
    TreeJoint,
    doubt,
    several,
)
from modeler.robot.elements import element_table
from modeler.robot.quaternions import (
    ALIKE,
    EXACT,
    exact_direction,
    exact_quaternion,
    rotation_matrix,
)
from modeler.robot.robot import JointKind
from modeler.robot.tree_cuts import follow
from modeler.robot.xml_source import LARGEST_FILE, Element, parse_xml

MOST_FILES = 200
_COUNTS = {"replicate": ("count", 1e3), "hfield": ("nrow ncol", 1e6), "mesh": ("params", 1e3)}
"""Element -> attributes whose product makes bodies or numbers, and how many at most."""
LIGHT = 1e-12
"""Of bodies that state nothing, kg and kg m2, for MuJoCo compiles no moving body without."""
NOTHING = 1e-9
"""kg; what weighs less states nothing."""
_FREE, _BALL, _SLIDE, _HINGE = range(4)  # mjtJoint
_WRAP_JOINT = 1  # mjtWrap
_LEFT_OUT = ("cameras", "lights", "hfields", "sensors", "pairs", "excludes", "skins", "tuples",
             "numerics", "texts", "materials", "textures")  # fmt: skip
_NUMBERS = ("body_pos", "body_mass", "body_ipos", "body_inertia", "jnt_pos", "qpos0", "eq_data",
            "dof_damping", "dof_armature", "actuator_gear", "actuator_damping", "actuator_armature",
            )  # fmt: skip
LARGEST = 1e12
_NUMBER = re.compile(r"\d+\.?\d*(?:[eE]\+?\d+)?")
_ALWAYS = 1  # inertiafromgeom="true"


def mjcf_tree(path: Path, exact_decimals: bool = False) -> BodyTree:
    """The robot of an MJCF file; the world is the root.

    Ball joints are in `unread`; what floats stands still where the file has it.

    Args:
        path: the file; what it includes stands beside it.
        exact_decimals: take rounded angles (1.5708, 0.707107) and lengths below 1 um as printed.

    Raises:
        RobotError: MuJoCo is not installed or refuses the file; a constraint that has no place in
            a robot file. One line.
    """
    mujoco = _mujoco(path)
    sources = _sources(path)
    judged = element_table("mjcf").notes((str(file), root) for file, root in sources)
    with _quiet(mujoco, path):
        spec = mujoco.MjSpec.from_file(str(path))
        notes = _lighten(spec, path) + ([] if exact_decimals else _unround(spec))
        model = spec.compile()
    reading = _Reading(mujoco, path, model, [*notes, *judged])
    return reading.tree(sources[0][1].attributes.get("model") or path.stem)


def _mujoco(path: Path) -> Any:
    try:
        import mujoco  # type: ignore[import-untyped]
    except ImportError as error:
        what = "is not installed" if error.name == "mujoco" else f"does not load ({error})"
        raise RobotError(
            on_one_line(f"{path}: MJCF is read by MuJoCo, which {what}; run: {installing('mjcf')}")
        ) from None
    return mujoco


@contextmanager
def _quiet(mujoco: Any, path: Path) -> Iterator[None]:
    """MuJoCo's warnings go nowhere (else to the screen and MUJOCO_LOG.TXT), refusals are a line."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _text: None)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    except (
        ValueError, TypeError, RuntimeError, MemoryError, mujoco.FatalError, mujoco.UnexpectedError,
    ) as error:  # fmt: skip
        said = " ".join(str(error).split()).replace("XML Error: ", "").replace("Error: ", "")
        raise RobotError(
            on_one_line(f"{path}: MuJoCo does not take it: {said}; correct it there")
        ) from None
    finally:
        mujoco.set_mju_user_warning(before)


# The text: everything that MuJoCo is going to read is looked at first.


def _sources(path: Path) -> list[tuple[Path, Element]]:
    """The file and models that it attaches, XML of bounded size; what they include stands there."""
    root = _parsed(path, "")
    if root.tag != "mujoco":
        raise RobotError(f"{path}: line {root.line}: got <{root.tag[:20]}>; expected <mujoco>")
    waiting, seen, roots = [(path, root)], {path.resolve()}, [(path, root)]
    while waiting:
        place, element = waiting.pop()
        _check_counts(place, element)
        for part in list(element.walk()):
            file = part.attributes.get("file", "")
            if not file or part.tag not in ("include", "model"):
                continue
            beside = [path.parent / file, place.parent / file]
            found = next((one for one in beside if one.is_file()), beside[0])
            if found.resolve() not in seen:
                seen.add(found.resolve())
                inner = _parsed(found, f"{place}: line {part.line}: includes ")
                waiting.append((found, inner))
                if part.tag == "include":
                    part.children = inner.children
                else:
                    roots.append((found, inner))
            if len(seen) > MOST_FILES:
                raise RobotError(f"{path}: expected at most {MOST_FILES} included files")
    return roots


def _parsed(path: Path, included: str) -> Element:
    try:
        data = read_file(path, LARGEST_FILE)
    except (OSError, ValueError) as error:
        what = getattr(error, "strerror", None) or str(error)
        todo = "; put it there or take the line out" if included else ""
        told = f"{included}{path}{', which' if included else ':'} cannot be read ({what}){todo}"
        raise RobotError(on_one_line(told)) from None
    return parse_xml(data, str(path))


def _check_counts(path: Path, root: Element) -> None:
    """Refuse what makes many bodies or numbers of few letters."""
    waiting = [(root, 1.0)]
    while waiting:
        element, times = waiting.pop()
        where = f"{path}: line {element.line}: <{element.tag[:20]}>"
        key, most = _COUNTS.get(element.tag, ("", math.inf))
        told = " ".join(element.attributes.get(name, "") for name in key.split())
        count = math.prod(max(float(number), 1.0) for number in _NUMBER.findall(told))
        if element.tag == "replicate":
            count = times = times * count
        if count > most:
            raise RobotError(f"{where}: {key}: got {shown(told)}; expected at most {most:g} in all")
        waiting += [(child, times) for child in element.children]


# What is taken out before MuJoCo compiles.


def _lighten(spec: Any, path: Path) -> list[str]:
    """Take out what no robot needs, and say what of it weighs: pictures, and bodies of a scene."""
    for name in dir(spec):
        if name.startswith("nuser_"):
            setattr(spec, name, -1)
    spec.compiler.discardvisual = spec.compiler.fusestatic = False
    spec.memory, spec.nkey, spec.nuserdata = -1, 0, 0  # as much as MuJoCo finds necessary
    notes, gone = list[str](), []
    for body in spec.worldbody.bodies:
        floats = any(joint.type == _FREE for joint in body.joints)
        if not floats and not body.mocap:
            continue
        what = "floats" if floats else "is dragged by the simulator (mocap)"
        told = "here it stands still where the file has it"
        if len(body.find_all("joint")) == floats:
            told = "it is left out with what ties it, for it has no joint"
            gone.append(body)
        notes.append(f"{body.name or 'a body'} {what}; {told}")
    total = spec.compiler.settotalmass
    for body in [] if total > 0.0 else gone:
        spec.delete(body)
    without = _take_out_shapes(spec)
    if without and total > 0.0:
        raise RobotError(on_one_line(
            f"{path}: settotalmass shares {total:g} kg by masses of meshes that are not there, of "
            f"{several(without)}; put them there, or take settotalmass out"
        ))  # fmt: skip
    if total > 0.0 and gone:
        scaled = spec.compile().body_mass
        away = [b.id for body in gone for b in (body, *body.find_all("body"))]
        spec.compiler.settotalmass = total - float(np.sum(scaled[away]))
        for body in gone:
            spec.delete(body)
    told = f"no values of {several(without)}: they follow from meshes that are not there"
    return [*notes, told] if without else notes


def _take_out_shapes(spec: Any) -> list[str]:
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
            if stated or mesh is None or not _weighs(body, geom):
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
            body.explicitinertial, body.mass, body.inertia = True, LIGHT, [LIGHT] * 3
    for part in [*spec.geoms, *spec.sites]:
        part.material = ""
    idle = [part for name in _LEFT_OUT for part in getattr(spec, name)]
    for part in [*idle, *(mesh for mesh in spec.meshes if mesh.name not in used)]:
        spec.delete(part)
    return without


def _weighs(body: Any, geom: Any) -> bool:
    low, high = body.compiler.inertiagrouprange
    weight = geom.density if math.isnan(geom.mass) else geom.mass
    return bool(weight != 0 and low <= geom.group <= high)


# Decimals that round something: taken for it before MuJoCo compiles.


def _unround(spec: Any) -> list[str]:
    """Put multiples of pi/12 for their roundings, 0 for lengths below 1 um; says so."""
    rounded = Roundings(exact=False)

    def angle(value: float, degree: bool) -> float:
        return value if degree else rounded.angle(repr(float(value)))

    for part in [*spec.bodies, *spec.frames]:
        way, degree = part.alt.type.name, part.compiler.degree
        if way == "mjORIENTATION_QUAT":
            part.quat = exact_quaternion(np.array(part.quat), rounded)
        elif way == "mjORIENTATION_EULER":
            part.alt.euler = [angle(x, degree) for x in part.alt.euler]
        elif way == "mjORIENTATION_AXISANGLE":
            *axis, turn = part.alt.axisangle
            axis = exact_direction(np.array(axis), rounded)
            part.alt.axisangle = [*axis, angle(turn, degree)]
    for joint in spec.joints:
        joint.axis = exact_direction(np.array(joint.axis), rounded)
        if joint.type == _HINGE:
            joint.ref = angle(joint.ref, joint.compiler.degree)
    for part in [*spec.bodies, *spec.frames, *spec.joints, *spec.sites]:
        part.pos = rounded.lengths(np.array(part.pos))
    return list(rounded.notes())


# What MuJoCo has compiled.


class _Reading:
    """A compiled model, and what has been decided about it."""

    def __init__(self, mujoco: Any, path: Path, model: Any, notes: list[str]) -> None:
        self._mujoco, self._path, self._model, self._notes = mujoco, path, model, notes
        self._bodies = _named("body", [model.body(i).name for i in range(model.nbody)])
        self._joints = _named("joint", [model.joint(i).name for i in range(model.njnt)])
        self._single = np.isin(model.jnt_type, [_HINGE, _SLIDE])
        self._actuated = self._driven()

    def tree(self, name: str) -> BodyTree:
        """All of it."""
        model, hidden, unread = self._model, set[str](), dict[str, str]()
        for numbers in _NUMBERS:
            if not np.all(np.abs(getattr(model, numbers)) < LARGEST):
                raise self._refused(f"{numbers}: got more than {LARGEST:g}; expected SI units")
        if np.all(model.jnt_type == _FREE):
            raise self._refused("no hinge or slide moves anything; expected a robot")
        joints = tuple(self._tree_joints(hidden, unread))
        joints, meetings = self._tied(joints), tuple(self._meetings())
        self._tell()
        bodies = {n: self._inertial(i) for i, n in enumerate(self._bodies)}
        return BodyTree(
            name, "MJCF", self._bodies[0], bodies | dict.fromkeys(hidden), joints, meetings,
            gravity=np.zeros(3) if self._off("GRAVITY") else np.array(model.opt.gravity),
            hidden=frozenset(hidden),
            doubted={n: why for n, body in bodies.items() if body and (why := doubt(body))},
            unread=unread,
            home=self._home() if meetings else {},
            notes=tuple(self._notes),
        )  # fmt: skip

    # Bodies.

    def _inertial(self, body: int) -> Inertial | None:
        model = self._model
        mass, moments = float(model.body_mass[body]), model.body_inertia[body]
        if mass < NOTHING and np.all(moments < NOTHING):
            return None
        turn = rotation_matrix(model.body_iquat[body])
        inertia = turn @ np.diag(moments) @ turn.T
        inertia[np.abs(inertia) < 10 * EXACT * np.max(moments)] = 0.0
        return Inertial(mass, np.array(model.body_ipos[body]), inertia)

    # Joints.

    def _tree_joints(self, hidden: set[str], unread: dict[str, str]) -> Iterator[TreeJoint]:
        """Of the bodies that are kept; of several in a body, each turns those behind it."""
        model, taken = self._model, {*self._joints}
        for body, name in enumerate(self._bodies):
            if body == 0:
                continue
            parent = self._bodies[model.body_parentid[body]]
            pose = Pose(np.array(model.body_pos[body]), rotation_matrix(model.body_quat[body]))
            own = np.flatnonzero(model.jnt_bodyid == body).tolist()
            if not own:
                label = _other(name, taken)
                yield TreeJoint(label, JointKind.FIXED, parent, name, pose)
            for j in own:
                child = name
                if j != own[-1]:
                    child = _other(f"{name}.{self._joints[j]}", {*self._bodies, *hidden})
                    hidden.add(child)
                joint = TreeJoint(self._joints[j], JointKind.FIXED, parent, child, pose)
                if model.jnt_type[j] == _BALL:
                    unread[joint.name] = f"{self._path}: joint {joint.name}: ball"
                yield self._moving(joint, j) if self._single[j] else joint
                parent, pose = child, Pose()

    def _moving(self, joint: TreeJoint, j: int) -> TreeJoint:
        """The joint with axis, limits and what resists it."""
        model = self._model
        dof, place = model.jnt_dofadr[j], model.jnt_qposadr[j]
        armature, damping = float(model.dof_armature[dof]), float(model.dof_damping[dof])
        for i in self._motors(j):  # on the motor's side: seen through the gear
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
            damping=None if self._off("DAMPER") else damping or None,
            friction=None if self._off("FRICTIONLOSS", "CONSTRAINT") else friction or None,
            armature=armature or None,
            stiffness=None if self._off("SPRING") else stiffness or None,
            rest=float(model.qpos_spring[place]),
            actuated=j in self._actuated,
        )

    def _motors(self, joint: int) -> np.ndarray:
        """Actuators that act on that joint alone."""
        model = self._model
        return np.flatnonzero((model.actuator_trntype < 2) & (model.actuator_trnid[:, 0] == joint))

    def _driven(self) -> set[int]:
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

    def _equalities(self) -> Iterator[tuple[str, int, str]]:
        """Active ones: kind, number, and a name."""
        model = self._model
        off = self._off("EQUALITY", "CONSTRAINT")
        for i in [] if off else np.flatnonzero(model.eq_active0).tolist():
            kind = self._mujoco.mjtEq(model.eq_type[i]).name.removeprefix("mjEQ_").lower()
            yield kind, i, model.equality(i).name or f"{kind} equality {i + 1}"

    def _tied(self, joints: tuple[TreeJoint, ...]) -> tuple[TreeJoint, ...]:
        """Joints that equalities tie follow the one that has a motor, or stand still."""
        made = {joint.name: joint for joint in joints}
        still, circle = follow(made, self._ties())
        if circle:
            raise self._refused(f"equalities let joint {circle} follow itself; take one out")
        self._notes += [f"joint {name} stands still: an equality holds it" for name in still]
        return tuple(made.values())

    def _ties(self) -> dict[str, tuple[str, float, float]]:
        """Joint -> that which it follows, "" for none, ratio and offset."""
        model, ties = self._model, dict[int, tuple[int, float, float]]()
        for kind, i, name in self._equalities():
            if kind not in ("joint", "tendon"):
                continue
            one, two = int(model.eq_obj1id[i]), int(model.eq_obj2id[i])
            constant, ratio, *others = map(float, model.eq_data[i, :5])
            if kind == "tendon":
                one, two, ratio, constant = self._pair(name, one, two, constant)
            elif two >= 0 and any(others):
                raise self._refused(
                    f"{name} lets {self._joints[one]} follow {self._joints[two]} by a polynomial; "
                    "expected a straight line, polycoef 0 from the third on"
                )
            ratio = ratio if two >= 0 else 0.0
            zero = [float(model.qpos0[model.jnt_qposadr[j]]) for j in (one, two)]
            offset = zero[0] + constant - ratio * zero[1]
            if ratio and two not in {*self._actuated, *ties} and one in {*self._actuated, *ties}:
                one, two, ratio, offset = two, one, 1 / ratio, -offset / ratio
            if one in ties:
                raise self._refused(f"{name}: {self._joints[one]} follows another joint already")
            ties[one] = (two, ratio, offset)
        return {
            self._joints[one]: (self._joints[two] if ratio else "", ratio, offset)
            for one, (two, ratio, offset) in ties.items()
        }

    def _pair(
        self, name: str, tendon: int, other: int, constant: float
    ) -> tuple[int, int, float, float]:
        """Joint, leader, ratio, constant of a fixed tendon over two joints whose length is held."""
        model, first = self._model, int(self._model.tendon_adr[tendon])
        parts = range(first, first + int(model.tendon_num[tendon]))
        joints = [int(model.wrap_objid[p]) for p in parts]
        shares = [float(model.wrap_prm[p]) for p in parts]
        fixed = all(model.wrap_type[p] == _WRAP_JOINT for p in parts) and other < 0
        if not fixed or len(joints) != 2 or not all(shares):
            raise self._refused(f"{name} holds a tendon; expected a fixed one over two joints")
        return joints[0], joints[1], -shares[1] / shares[0], constant / shares[0]

    def _meetings(self) -> Iterator[Meeting]:
        """Points that `connect` holds together."""
        model = self._model
        for kind, i, name in self._equalities():
            if kind in ("joint", "tendon"):
                continue
            if kind not in ("connect", "weld"):
                raise self._refused(f"{name} is not read; expected joint, connect or weld")
            ends = [int(model.eq_obj1id[i]), int(model.eq_obj2id[i])]
            points = [np.array(model.eq_data[i, k : k + 3]) for k in (0, 3)]
            if model.eq_objtype[i] == int(self._mujoco.mjtObj.mjOBJ_SITE):
                points = [np.array(model.site_pos[site]) for site in ends]
                ends = [int(model.site_bodyid[site]) for site in ends]
            one, two = (self._bodies[end] for end in ends)
            if self._carrier(ends[0]) == self._carrier(ends[1]):
                self._notes.append(f"{name} of {one} and {two} is left out: they move as one")
            elif kind == "weld":
                raise self._refused(f"{name} holds {one} and {two} rigidly; expected connect")
            else:
                points = [np.where(np.abs(point) < 10 * EXACT, 0.0, point) for point in points]
                yield Meeting(name, one, Pose(points[0]), two, Pose(points[1]))

    def _carrier(self, body: int) -> int:
        """The body that has the joint which moves that one; 0 if none does."""
        model = self._model
        while body and not np.any(self._single[model.jnt_bodyid == body]):
            body = int(model.body_parentid[body])
        return body

    def _home(self) -> dict[str, float]:
        """Positions of the keyframe `home`; without one, where the file draws the robot."""
        model = self._model
        keys = {model.key(k).name: model.key_qpos[k] for k in range(model.nkey)}
        posture = keys.get("home", model.qpos0)[model.jnt_qposadr]
        return {self._joints[j]: float(posture[j]) for j in np.flatnonzero(self._single)}

    # What is told.

    def _off(self, *flags: str) -> bool:
        """Whether an `<option><flag>` switches something off."""
        bits = [int(getattr(self._mujoco.mjtDisableBit, f"mjDSBL_{flag}")) for flag in flags]
        return any(self._model.opt.disableflags & bit for bit in bits)

    def _refused(self, what: str) -> RobotError:
        return RobotError(on_one_line(f"{self._path}: {what}"))

    def _tell(self) -> None:
        model = self._model
        idle = model.neq - len(list(self._equalities()))
        curved = np.any(model.jnt_stiffnesspoly) or np.any(model.dof_dampingpoly)
        driven = [i for j in range(model.njnt) for i in self._motors(j)]
        gear = np.any(model.actuator_gear[driven, 0] != 1) and np.any(model.dof_armature)
        away = np.any(np.delete(model.actuator_armature + model.actuator_damping, driven))
        inner = np.any(model.actuator_armature[driven]) or np.any(model.actuator_damping[driven])
        notes = {
            f"{idle} inactive equalities are left out": idle,
            "armature and damping of actuators on tendons, sites or bodies are left out": away,
            "of polynomial springs and damping the linear term is taken": curved,
            "armature and damping of actuators are the motor's: gear^2 as much at a joint": inner,
            "armature of joints is taken at the joint; gear scales commands alone": gear,
        }
        self._notes += [what for what, is_so in notes.items() if is_so]


def _named(kind: str, names: list[str]) -> list[str]:
    """The names, with `body3`, `joint2` for those that there are not."""
    taken = set(names)
    return [name or _other(f"{kind}{i}", taken) for i, name in enumerate(names)]


def _other(name: str, taken: set[str]) -> str:
    """The name, or one like it, that nothing has; taken from then on."""
    while name in taken:
        name += "_"
    taken.add(name)
    return name
