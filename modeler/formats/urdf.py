"""URDF: the links and joints of a file as a `BodyTree`.

The schema is that of http://wiki.ros.org/urdf/XML, read as urdfdom reads it. The file is read here
and not by another library, for those keep neither the digits of a number, which show a rounded
pi/2 from a measured angle, nor the line and the bytes where it stands. What becomes of every
element stands in `urdf_elements.toml`.
"""

import shlex
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeler.core.errors import RobotError
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.formats.body_tree import (
    BodyTree,
    Couplings,
    Inertial,
    LoopClosure,
    Pose,
    Roundings,
    TreeJoint,
    collect_moving_links,
    compute_body_poses,
    find_inertia_defect,
    summarise_names,
)
from modeler.formats.thresholds import THRESHOLDS
from modeler.formats.tree_cuts import resolve_leaders
from modeler.formats.xml_source import (
    LocatedElement,
    compute_half_unit,
    compute_rpy_rotation,
    load_element_table,
    parse_xml,
    read_pose,
)
from modeler.robot import LOOP_KINDS, JointKind

# What a URDF states between joints: couplings, loops, gears and springs, wherever it stands.


Joints = dict[str, TreeJoint]
Tell = Callable[[str, str], None]
"""Adds a name to a sentence with {} that is reported."""
Spots = Mapping[str, LocatedElement]

_COUPLED = (
    ("joint", "mimic", "name", "joint"),
    ("joint", "drake:mimic", "name", "joint"),
    ("gazebo", "plugin", "mimicJoint", "joint"),
    ("ros2_control", "joint", "name", "mimic"),
)
"""Element, element in it, and which of their values name the joint that follows and its leader."""
_LOOPS = {kind: kind for kind in LOOP_KINDS} | {
    "continuous": "revolute",
    "ball": "spherical",
    "fixed": "rigid",
    "weld": "rigid",
}
_SIDES = ("link1", "link2", "predecessor", "successor", "parent", "child")
_GEARS = ("drake:rotor_inertia", "motorInertia", "drake:gear_ratio", "mechanicalReduction")
_SPRING = ("springStiffness", "springReference")
_START = "initial_joint_position"
_BALL = ("body_A", "body_B", "p_AP", "p_BQ")
_SEVERAL = "transmissions of several joints are left out, rotors too; [motors] states such: {}"


# Joints that follow others.


def read_couplings(root: LocatedElement, joints: Joints, tell: Tell) -> Couplings:
    """Returns joint -> that which it follows, ratio and offset.

    Raises:
        RobotError: two statements that differ, a coupling of no two joints.
    """
    couplings: Couplings = {}
    for spot, follower, leader in _find_couplings(root, joints, tell):
        spot.require_known("joint", follower, joints)
        key = "ratio" if spot.element.tag == "coupling" else "multiplier"
        ratio, offset = (spot.read_number(k, d) for k, d in ((key, "1"), ("offset", "0")))
        if joints[follower].kind is JointKind.FIXED:
            continue
        if leader not in joints:
            message = "the file lacks the joint to mimic, it moves freely: {}"
            tell(message, f"{follower} of {leader}")
        elif couplings.setdefault(follower, (leader, ratio, offset)) != (leader, ratio, offset):
            name = quote_value(follower)
            message = f"joint {name} follows in two ways; keep the one that is meant"
            raise spot.make_error(message)
    return couplings


def _find_couplings(
    root: LocatedElement, joints: Joints, tell: Tell
) -> Iterator[tuple[LocatedElement, str, str]]:
    """Where it is stated, follower and leader."""
    for outer, inner, follower, leader in _COUPLED:
        for around in root.find_children(outer, f"drake:{outer}"):
            for spot in around.find_children(inner):
                spot = spot.merge_children(follower, leader, "multiplier", "offset")
                attributes = {"name": around.name, **spot.element.attributes}
                if inner.endswith("mimic") or (attributes.get(follower) and attributes.get(leader)):
                    yield spot, attributes[follower], spot.require_attribute(leader, "joint1")
                elif inner == "plugin":
                    tell("plugins of Gazebo are left out: {}", spot.get_text("filename"))
    above = {joint.child: joint for joint in joints.values()}
    for spot in root.find_children("coupling"):
        one, two = (
            above.get(spot.require_child(tag, 'link="a"').require_attribute("link", "a"))
            for tag in ("predecessor", "successor")
        )
        line = spot.merge_children("ratio")
        line.require_attribute("ratio", "1")
        if one is None or two is None or one is two or one.parent != two.parent:
            expected = "expected two links whose joints stand on one link"
            raise spot.make_error(f"{expected}; or write a mimic tag")
        yield line, two.name, one.name


# Joints that close loops.


def add_loops(root: LocatedElement, tree: BodyTree, rounded: Roundings) -> BodyTree:
    """Returns tree with the loops that the file closes, the motors that it names, and its posture.

    Raises:
        RobotError: a loop of a kind that robot files do not have, links that are not there.
    """
    link_of = {body: k for k, link in enumerate(collect_moving_links(tree)) for body in link.bodies}
    closures = list(_read_loops(root, tree, rounded))
    internal_closures = [m for m in closures if link_of[m.body] == link_of[m.other]]
    notes = [
        f"loops within one body are left out: {summarise_names(m.name for m in internal_closures)}"
    ] * bool(internal_closures)
    closures = [meeting for meeting in closures if meeting not in internal_closures]
    joints, home = tree.joints, dict[str, float]()
    if closures:
        elements = root.find_children("joint")
        motors = {j.name for j in elements if j.get_text("independent").lower() == "true"}
        for outer in root.find_children("transmission", "ros2_control"):
            driven = bool(outer.find_children("actuator"))
            for joint in outer.find_children("joint"):
                if driven or joint.find_children("command_interface"):
                    motors.add(joint.name)
        joints = tuple(replace(j, actuated=j.name in motors and not j.leader) for j in joints)
        for gazebo in (spot.merge_children(_START) for spot in root.find_children("gazebo")):
            if gazebo.get_text(_START):
                home[gazebo.get_text("reference")] = gazebo.read_number(_START, "0")
    tree = replace(tree, loop_closures=tuple(closures), joints=joints, home=home)
    return replace(tree, notes=(*tree.notes, *notes))


def _read_loops(root: LocatedElement, tree: BodyTree, rounded: Roundings) -> Iterator[LoopClosure]:
    for spot in root.find_children("loop", "loop_joint", "constraint"):
        kind, links, poses = _read_loop_kind(spot), list[str](), list[Pose]()
        for side in spot.find_children(*_SIDES):
            inside = side.find_child("origin")
            side_origin = spot.find_child(f"{side.element.tag}_origin")
            origin = next((o for o in (inside, side_origin) if o.is_given), side)
            axis = spot.find_child(f"{side.element.tag}_axis")
            axis = axis if axis.is_given else spot.find_child("axis")
            turn = _compute_axis_frame(axis, "xyz", kind)
            links.append(_read_link(side, "link", tree.bodies))
            poses.append(read_pose(origin, rounded) @ Pose(rotation=turn))
        if len(links) != 2:
            raise spot.make_error(f"expected the two links that meet, got {len(links)}")
        yield LoopClosure(spot.name, links[0], poses[0], links[1], poses[1], kind)
    for spot in root.find_children("drake:ball_constraint"):
        inner = [spot.find_child(f"drake:ball_constraint_{key}") for key in _BALL]
        bodies = [_read_link(body, "name", tree.bodies) for body in inner[:2]]
        places = [Pose(rounded.snap_lengths(at.read_numbers("value", "0 0 0"))) for at in inner[2:]]
        yield LoopClosure("ball_constraint", bodies[0], places[0], bodies[1], places[1])
    at_zero = compute_body_poses(tree, {})
    for spot in root.find_grandchildren("gazebo", "joint"):
        flat, kind = spot.merge_children("parent", "child", "pose"), _read_loop_kind(spot)
        axis = spot.find_child("axis").merge_children("xyz")
        parts = spot.find_child("pose"), axis.find_child("xyz")
        seen = any(each.element.attributes for each in parts)
        if seen or axis.find_child("use_parent_model_frame").is_given:
            message = "its pose or axis is seen from another frame; expected that of the child"
            raise spot.make_error(message)
        world = flat.get_text("parent") == "world" and "world" not in tree.bodies
        parent = tree.root if world else _read_link(flat, "parent", tree.bodies)
        child = _read_link(flat, "child", tree.bodies)
        place = flat.read_digits("pose", "0 0 0 0 0 0")
        turn = compute_rpy_rotation(map(rounded.snap_angle, place[3:]))
        turn = turn @ _compute_axis_frame(axis, "xyz", kind)
        frame = Pose(rounded.snap_lengths(np.array(place[:3], float)), turn)
        other = at_zero[parent].inverse() @ at_zero[child] @ frame
        yield LoopClosure(spot.name, parent, other, child, frame, kind)


def _read_link(spot: LocatedElement, attribute: str, links: Collection[str]) -> str:
    return spot.require_known("link", spot.require_attribute(attribute, "link1"), links)


def _read_loop_kind(spot: LocatedElement) -> str:
    if (kind := spot.get_text("type").lower()) not in _LOOPS:
        expected = f"a joint that closes a loop: {summarise_names(_LOOPS)}"
        raise spot.place.enter("type", kind).make_mismatch(expected)
    return _LOOPS[kind]


def _compute_axis_frame(axis: LocatedElement, attribute: str, kind: str) -> np.ndarray:
    """(3, 3) whose z is the axis of the joint; where it has none, no turn."""
    if kind in ("rigid", "spherical", "position"):
        return np.eye(3)
    if not axis.is_given:
        raise axis.make_error(f"is missing; expected the direction of the axis of a {kind} joint")
    z = axis.read_direction(attribute, "1 0 0")
    if z[2] == 1.0:
        return np.eye(3)
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(z)))], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z]) + 0.0


# Rotors behind gears, and springs.


def add_armatures(root: LocatedElement, joints: Joints, tell: Tell) -> None:
    """Adds gear ratio squared times rotor inertia to the joints of stated transmissions.

    As `motorInertia` and `mechanicalReduction` of the actuator, the joint and the transmission, or
    as `drake:rotor_inertia` and `drake:gear_ratio` (drake.mit.edu, "Reflected inertia").
    """
    inner = root.find_grandchildren("ros2_control", "transmission")
    for spot in (*root.find_children("transmission"), *inner):
        motors = [s.merge_children(*_GEARS) for s in spot.find_children("actuator")]
        driven = [s.merge_children(*_GEARS) for s in spot.find_children("joint")]
        if len(motors) > 1 or len(driven) > 1:
            tell(_SEVERAL, spot.name)
            continue
        for motor in motors:
            rotor = next((key for key in _GEARS[:2] if motor.get_text(key)), "")
            if not rotor:
                continue
            if not driven or driven[0].name not in joints:
                tell("rotors on joints that are not there are left out: {}", spot.name)
                continue
            gear_key = next((key for key in _GEARS[2:] if motor.get_text(key)), "")
            gear = motor.read_number(gear_key, "1")
            for other in (driven[0], spot.merge_children(_GEARS[3])):
                gear *= other.read_number(_GEARS[3], "1")
            rotor_inertia, joint = motor.read_number(rotor, "0"), joints[driven[0].name]
            armature = (joint.armature or 0.0) + gear**2 * rotor_inertia
            joints[joint.name] = replace(joint, armature=armature)
            message = "armature is gear ratio squared times rotor inertia: {}"
            tell(message, f"{joint.name}: {abs(gear):g}^2 * {rotor_inertia:g}")


def add_springs(root: LocatedElement, joints: Joints, tell: Tell) -> None:
    """Returns springs of joints, of `<dynamics>` and of Gazebo's `<springStiffness>`.

    Raises:
        RobotError: two that differ.
    """
    springs = [
        (joint.name, joint.find_child("dynamics"), "spring_stiffness", "spring_reference")
        for joint in root.find_children("joint", "drake:joint")
    ]
    springs += [
        (spot.get_text("reference"), spot.merge_children(*_SPRING), *_SPRING)
        for spot in root.find_children("gazebo")
    ]
    for name, spot, stiffness, rest in springs:
        spring_values = tuple(spot.read_number(key, "0") for key in (stiffness, rest))
        if not spot.get_text(stiffness):
            continue
        joint = joints.get(name)
        if joint is None or joint.kind is JointKind.FIXED:
            tell("springs of what does not move are left out: {}", name)
        elif joint.stiffness is not None and (joint.stiffness, joint.rest) != spring_values:
            what = f"joint {quote_value(name)} has two springs that differ"
            raise spot.make_error(f"{what}; keep one")
        else:
            joints[name] = replace(joint, stiffness=spring_values[0], rest=spring_values[1])


# URDF: the links and joints of a file as a `BodyTree`.


_KINDS = {
    "revolute": JointKind.REVOLUTE,
    "continuous": JointKind.REVOLUTE,
    "prismatic": JointKind.PRISMATIC,
    "fixed": JointKind.FIXED,
}
_UNREAD = ("floating", "planar", "ball", "spherical", "universal", "screw")
_ACCELERATIONS = ("acceleration", "deceleration", "drake:acceleration")


def read_urdf_tree(data: bytes, where: str, exact_decimals: bool = False) -> BodyTree:
    """Returns the robot of a URDF.

    Joints of kinds that we do not have stand in `unread`; `tree_cuts.cut_tree` deals with them.

    Args:
        data: the file.
        where: its path, for messages.
        exact_decimals: True to take printed angles and lengths as they are; else 1.5708 is pi/2,
            and what is smaller than 1e-6 is 0.

    Raises:
        RobotError: not a URDF, or a mistake in it: line, element, what was got and expected.
    """
    root = LocatedElement(parse_xml(data, where), where, "")
    _check_format(root, where)
    return _UrdfReader(root, where, exact_decimals).read_tree()


def _check_format(root: LocatedElement, where: str) -> None:
    if root.element.tag != "robot":
        raise root.make_error(f"<{root.element.tag}> is no URDF, which begins with <robot>")
    for child in root.element.children:
        macros = child.tag in ("include", "macro", "property")
        ours = child.tag in ("link", "joint")
        for element in child.iterate_elements():
            variable = ours and any("${" in value for value in element.attributes.values())
            if macros or variable or element.tag.startswith("xacro:"):
                raise RobotError(  # whole, however long the path is
                    f"{where}: line {element.line}: <{element.tag[:60]}> is of xacro, not of URDF; "
                    f"expand it first: {_suggest_expansion(where)}"
                )


def _suggest_expansion(where: str) -> str:
    path = Path(where)
    bare = path.name.removesuffix(".xacro").removesuffix(".urdf")
    out = path.with_name(f"{bare}.urdf" if path.suffix == ".xacro" else f"{bare}_expanded.urdf")
    return f"xacro {shlex.quote(where)} > {shlex.quote(str(out))}"


class _UrdfReader:
    """One pass over the elements of a file."""

    def __init__(self, root: LocatedElement, where: str, exact: bool) -> None:
        self._root, self._where = root, where
        self._rounded = Roundings(exact)
        self._told: dict[str, list[str]] = {}  # what -> of which links and joints
        self._doubted: dict[str, str] = {}
        self._unread: dict[str, str] = {}

    def read_tree(self) -> BodyTree:
        links, spots = self._collect_elements("link"), self._collect_elements("joint")
        if not links:
            raise self._root.make_error('<robot> has no link; expected <link name="...">')
        bodies = {name: self._read_body(name, link) for name, link in links.items()}
        joints = {name: self._read_joint(name, spot, links) for name, spot in spots.items()}
        root = _find_first_link(self._root.place, bodies, joints, spots)
        add_armatures(self._root, joints, self._add_note)
        add_springs(self._root, joints, self._add_note)
        self._couple_joints(joints, spots)
        tree = BodyTree(
            name=self._root.element.attributes.get("name", "").strip() or Path(self._where).stem,
            format="URDF",
            root=root,
            bodies=bodies,
            joints=tuple(_arrange_joints(joints, root)),
            unreliable_bodies=self._doubted,
            unsupported_joints=self._unread,
        )
        tree = add_loops(self._root, tree, self._rounded)
        files = [(self._where, self._root.element)]
        element_notes = load_element_table("urdf").collect_notes(files)
        return replace(tree, notes=(*self._collect_notes(), *tree.notes, *element_notes))

    def _collect_elements(self, tag: str) -> dict[str, LocatedElement]:
        spots: dict[str, LocatedElement] = {}
        for element in self._root.element.find_children(tag, f"drake:{tag}"):
            named = LocatedElement(element, self._where, f"<{tag}>")
            name = named.require_attribute("name", f"{tag}1")
            spot = LocatedElement(element, self._where, f"{tag} {quote_value(name)}")
            if name in spots:
                first = f"the first is in line {spots[name].element.line}"
                raise spot.make_error(f"a second {tag} of that name; {first}: rename one")
            spots[name] = spot
            if len(spots) > THRESHOLDS.max_links:
                raise spot.make_error(f"more than {THRESHOLDS.max_links} of them; is this a robot?")
        return spots

    def _add_note(self, what: str, name: str) -> None:
        self._told.setdefault(what, []).append(name)

    def _read_body(self, name: str, link: LocatedElement) -> Inertial | None:
        inertial = link.find_child("inertial")
        if not inertial.is_given:
            return None
        mass = inertial.require_child("mass", 'value="1"')
        tensor = inertial.require_child("inertia", 'ixx="0.01" ..')
        mass.require_attribute("value", "1")
        entries = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        for entry in entries:
            tensor.require_attribute(entry, "0.01")
        printed = [tensor.read_digits(entry, "0.01")[0] for entry in entries]
        matrix = np.zeros((3, 3))
        matrix[np.triu_indices(3)] = [float(word) for word in printed]
        matrix = np.triu(matrix) + np.triu(matrix, 1).T
        body = Inertial(float(mass.read_digits("value", "1")[0]), np.zeros(3), matrix)
        slack = sum(compute_half_unit(word) for word in printed if float(word))
        reason = find_inertia_defect(body, slack)
        if reason:
            self._doubted[name] = reason
        # Measured, and no part of the geometry: as printed.
        return body.express_in(read_pose(inertial.find_child("origin"), Roundings(exact=True)))

    def _read_joint(self, name: str, spot: LocatedElement, links: Spots) -> TreeJoint:
        kind = spot.require_attribute("type", "revolute").lower()
        if kind in _UNREAD:
            self._unread[name] = f"{spot.place.file}: joint {quote_value(name)}: {kind}"
        elif kind not in _KINDS:
            expected = f"{join_names(_KINDS)}{suggest_name(kind, _KINDS)}"
            raise spot.place.enter("type", kind).make_mismatch(expected)
        parent, child = (spot.require_child(end, 'link="..."') for end in ("parent", "child"))
        ends = [_read_link(inner, "link", links) for inner in (parent, child)]
        joint_kind = _KINDS.get(kind, JointKind.FIXED)
        pose = read_pose(spot.find_child("origin"), self._rounded)
        joint = TreeJoint(name, joint_kind, ends[0], ends[1], pose)
        if joint.kind is JointKind.FIXED:
            return joint
        limit, dynamics = spot.find_child("limit"), spot.find_child("dynamics")
        lower, upper = self._read_range(name, kind, limit, spot.find_child("safety_controller"))
        speed = abs(limit.read_optional_number("velocity") or 0.0) or None
        if speed is None and "velocity" in limit.element.attributes:
            self._add_note("velocity 0 or inf is taken as not stated: {}", name)
        least = [a for key in _ACCELERATIONS if (a := abs(limit.read_optional_number(key) or 0.0))]
        return replace(
            joint,
            axis=self._read_axis(name, spot.find_child("axis")),
            lower=lower,
            upper=upper,
            speed=speed,
            acceleration=min(least, default=None),
            effort=abs(limit.read_optional_number("effort") or 0.0) or None,
            damping=self._read_loss(name, dynamics, "damping"),
            friction=self._read_loss(name, dynamics, "friction"),
        )

    def _read_range(
        self, name: str, kind: str, limit: LocatedElement, soft: LocatedElement
    ) -> tuple[float | None, float | None]:
        """The positions between which the joint may move; None where the file leaves them open."""
        lower, upper = limit.read_optional_number("lower"), limit.read_optional_number("upper")
        stated = [key for key in ("lower", "upper") if limit.get_text(key)]
        infinite = [key for key in stated if limit.read_optional_number(key) is None]
        if kind == "continuous":
            if lower or upper:
                note = "type continuous has no range, lower and upper are not taken: {}"
                self._add_note(note, name)
            lower = upper = None
        elif infinite and (lower is not None or upper is not None):
            self._add_note("a range that is infinite on one side is not taken: {}", name)
            lower = upper = None
        elif lower is not None or upper is not None:  # the schema: left out is 0
            lower, upper = lower or 0.0, upper or 0.0
            if lower >= upper:
                self._add_note("limits that leave no range are not taken: {}", name)
                return lower, upper
        low = soft.read_optional_number("soft_lower_limit")
        high = soft.read_optional_number("soft_upper_limit")
        if low is None or high is None or (low, high) == (lower, upper):
            return lower, upper
        low = low if lower is None else max(low, lower)
        high = high if upper is None else min(high, upper)
        if low >= high:
            self._add_note("a safety_controller that leaves no range is not taken: {}", name)
            return lower, upper
        self._add_note("the range is that of the safety_controller: {}", name)
        return low, high

    def _read_loss(self, name: str, dynamics: LocatedElement, key: str) -> float | None:
        value = dynamics.read_optional_number(key)
        if value is not None and value < 0.0:
            self._add_note(f"negative {key} is not taken: {{}}", name)
            return None
        return value

    def _read_axis(self, name: str, spot: LocatedElement) -> np.ndarray:
        length = float(np.linalg.norm(spot.read_numbers("xyz", "1 0 0")))
        axis = self._rounded.snap_lengths(spot.read_direction("xyz", "1 0 0"))
        if abs(length - 1.0) > 1e-3:
            self._add_note("axes that are not of length 1 are taken as directions: {}", name)
        return np.asarray(axis / np.linalg.norm(axis) + 0.0)

    def _couple_joints(self, joints: Joints, spots: Spots) -> None:
        """Let the mimic joints follow a joint that leads."""
        direct = read_couplings(self._root, joints, self._add_note)
        fixed_names, circle = resolve_leaders(joints, direct)
        if circle:
            raise spots[circle].make_error("follows itself by <mimic>; one of them must lead")
        for name in fixed_names:
            self._add_note("what they mimic does not move, so they are fixed: {}", name)

    def _collect_notes(self) -> Iterable[str]:
        yield from self._rounded.describe_roundings()
        for what, names in self._told.items():
            yield what.format(summarise_names(names))


def _find_first_link(
    place: TomlCell, bodies: Iterable[str], joints: Mapping[str, TreeJoint], spots: Spots
) -> str:
    """The link that no joint moves; refuses what is no tree."""
    above: dict[str, TreeJoint] = {}
    for joint in joints.values():
        other = above.setdefault(joint.child, joint)
        if other is not joint:
            child, above_it = quote_value(joint.child), quote_value(other.name)
            problem = f"link {child} is the child of joint {above_it} too"
            raise spots[joint.name].make_error(f"{problem}; expected one parent: a URDF is a tree")
    first = [name for name in bodies if name not in above]
    if len(first) > 1:
        raise place.make_error(
            f"no joint leads to {len(first)} links, {summarise_names(first)}; expected one first "
            "link: join the others to it by fixed joints, or take them out"
        )
    reached = {*first, *(joint.child for name in first for joint in _arrange_joints(joints, name))}
    for link in bodies:
        if link not in reached:
            for _ in bodies:  # so far up that it is in the circle
                link = above[link].parent
            problem = f"link {quote_value(link)} is the parent of its own parents"
            raise spots[above[link].name].make_error(f"{problem}; mend <parent> or <child>")
    return first[0]


def _arrange_joints(joints: Mapping[str, TreeJoint], root: str) -> list[TreeJoint]:
    """Every joint after that which moves its parent, else as they come; only what root leads to."""
    waiting, here, ordered_joints = list(joints.values()), {root}, list[TreeJoint]()
    while joint := next((joint for joint in waiting if joint.parent in here), None):
        waiting.remove(joint)
        ordered_joints.append(joint)
        here.add(joint.child)
    return ordered_joints
