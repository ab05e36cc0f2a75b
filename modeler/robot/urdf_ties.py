"""What a URDF states between joints: couplings, loops, gears and springs, wherever it stands.

Couplings are `<mimic>`, Drake's, that of Gazebo's plugin, of ros2_control and of URDF+; loops those
of Gazebo (a `<joint>` of SDF), URDF+, Drake, Isaac Sim, and of urdfdom's proposed `<constraint>`.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from modeler.core.toml_cells import quote_value, suggest_name
from modeler.robot.body_tree import (
    BodyTree,
    LoopClosure,
    Pose,
    Roundings,
    TreeJoint,
    collect_moving_links,
    compute_body_poses,
    summarise_names,
)  # fmt: skip
from modeler.robot.robot import LOOP_KINDS, JointKind
from modeler.robot.xml_cells import Spot, compute_rpy_rotation, read_pose

Joints = dict[str, TreeJoint]
Tell = Callable[[str, str], None]
"""Adds a name to a sentence with {} that is told."""

_COUPLED = (
    ("joint", "mimic", "name", "joint"), ("joint", "drake:mimic", "name", "joint"),
    ("gazebo", "plugin", "mimicJoint", "joint"), ("ros2_control", "joint", "name", "mimic"),
)  # fmt: skip
"""Element, element in it, and which of their values name the joint that follows and its leader."""
_LOOPS = {kind: kind for kind in LOOP_KINDS} | {
    "continuous": "revolute", "ball": "spherical", "fixed": "rigid", "weld": "rigid",
}  # fmt: skip
_SIDES = ("link1", "link2", "predecessor", "successor", "parent", "child")
_GEARS = ("drake:rotor_inertia", "motorInertia", "drake:gear_ratio", "mechanicalReduction")
_SPRING = ("springStiffness", "springReference")
_START = "initial_joint_position"
_BALL = ("body_A", "body_B", "p_AP", "p_BQ")
_SEVERAL = "transmissions of several joints are left out, rotors too; [motors] states such: {}"


# Joints that follow others.


def read_couplings(root: Spot, joints: Joints, tell: Tell) -> dict[str, tuple[str, float, float]]:
    """Joint -> that which it follows, ratio and offset.

    Raises:
        RobotError: two statements that differ, a coupling of no two joints.
    """
    couplings: dict[str, tuple[str, float, float]] = {}
    for spot, follower, leader in _find_couplings(root, joints, tell):
        if follower not in joints:
            raise spot.place.make_error(
                f"there is no joint {quote_value(follower)}{suggest_name(follower, joints)}"
            )
        key = "ratio" if spot.element.tag == "coupling" else "multiplier"
        ratio, offset = (
            float(spot.read_numbers(k, d)[0]) for k, d in ((key, "1"), ("offset", "0"))
        )
        if joints[follower].kind is JointKind.FIXED:
            continue
        if leader not in joints:
            message = "the file lacks the joint to mimic, it moves freely: {}"
            tell(message, f"{follower} of {leader}")
        elif couplings.setdefault(follower, (leader, ratio, offset)) != (leader, ratio, offset):
            message = (
                f"joint {quote_value(follower)} follows in two ways; keep the one that is meant"
            )
            raise spot.place.make_error(message)
    return couplings


def _find_couplings(root: Spot, joints: Joints, tell: Tell) -> Iterator[tuple[Spot, str, str]]:
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
        one, two = (above.get(spot.require_child(tag, 'link="a"').require_attribute("link", "a"))
                    for tag in ("predecessor", "successor"))  # fmt: skip
        line = spot.merge_children("ratio")
        line.require_attribute("ratio", "1")
        if one is None or two is None or one is two or one.parent != two.parent:
            raise spot.place.make_error(
                "expected two links whose joints stand on one link; or write a mimic tag"
            )
        yield line, two.name, one.name


# Joints that close loops.


def add_loops(root: Spot, tree: BodyTree, rounded: Roundings) -> BodyTree:
    """The tree with the loops that the file closes, the motors that it names, and its posture.

    Raises:
        RobotError: a loop of a kind that robot files do not have, links that are not there.
    """
    link_of = {body: k for k, link in enumerate(collect_moving_links(tree)) for body in link.bodies}
    closures = list(_read_loop_closures(root, tree, rounded))
    internal_closures = [m for m in closures if link_of[m.body] == link_of[m.other]]
    notes = [
        f"loops within one body are left out: {summarise_names(m.name for m in internal_closures)}"
    ] * bool(internal_closures)
    closures = [meeting for meeting in closures if meeting not in internal_closures]
    joints, home = tree.joints, dict[str, float]()
    if closures:
        motors = {
            j.name
            for j in root.find_children("joint")
            if j.get_text("independent").lower() == "true"
        }
        for outer in root.find_children("transmission", "ros2_control"):
            driven = bool(outer.find_children("actuator"))
            motors |= {
                j.name
                for j in outer.find_children("joint")
                if driven or j.find_children("command_interface")
            }
        joints = tuple(replace(j, actuated=j.name in motors and not j.leader) for j in joints)
        for gazebo in (spot.merge_children(_START) for spot in root.find_children("gazebo")):
            if gazebo.get_text(_START):
                home[gazebo.get_text("reference")] = float(gazebo.read_numbers(_START, "0")[0])
    return replace(
        tree, loop_closures=tuple(closures), joints=joints, home=home, notes=(*tree.notes, *notes)
    )


def _read_loop_closures(root: Spot, tree: BodyTree, rounded: Roundings) -> Iterator[LoopClosure]:
    for spot in root.find_children("loop", "loop_joint", "constraint"):
        kind, links, poses = _read_loop_kind(spot), list[str](), list[Pose]()
        for side in spot.find_children(*_SIDES):
            inside, side_origin = (
                side.find_child("origin"),
                spot.find_child(f"{side.element.tag}_origin"),
            )
            origin = next((o for o in (inside, side_origin) if o.is_given), side)
            axis = spot.find_child(f"{side.element.tag}_axis")
            turn = _compute_axis_frame(
                axis if axis.is_given else spot.find_child("axis"), "xyz", kind
            )
            links.append(_read_link(side, "link", tree))
            poses.append(read_pose(origin, rounded) @ Pose(rotation=turn))
        if len(links) != 2:
            raise spot.place.make_error(f"expected the two links that meet, got {len(links)}")
        yield LoopClosure(spot.name, links[0], poses[0], links[1], poses[1], kind)
    for spot in root.find_children("drake:ball_constraint"):
        inner = [spot.find_child(f"drake:ball_constraint_{key}") for key in _BALL]
        bodies = [_read_link(body, "name", tree) for body in inner[:2]]
        places = [Pose(rounded.snap_lengths(at.read_numbers("value", "0 0 0"))) for at in inner[2:]]
        yield LoopClosure("ball_constraint", bodies[0], places[0], bodies[1], places[1])
    at_zero = compute_body_poses(tree, {})
    for spot in (
        j for gazebo in root.find_children("gazebo") for j in gazebo.find_children("joint")
    ):
        flat, kind = spot.merge_children("parent", "child", "pose"), _read_loop_kind(spot)
        axis = spot.find_child("axis").merge_children("xyz")
        seen = [
            *spot.find_child("pose").element.attributes,
            *axis.find_child("xyz").element.attributes,
        ]
        if seen or axis.find_child("use_parent_model_frame").is_given:
            message = "its pose or axis is seen from another frame; expected that of the child"
            raise spot.place.make_error(message)
        world = flat.get_text("parent") == "world" and "world" not in tree.bodies
        parent = tree.root if world else _read_link(flat, "parent", tree)
        child = _read_link(flat, "child", tree)
        place = flat.read_digits("pose", "0 0 0 0 0 0")
        turn = compute_rpy_rotation(map(rounded.snap_angle, place[3:])) @ _compute_axis_frame(
            axis, "xyz", kind
        )
        frame = Pose(rounded.snap_lengths(np.array(place[:3], float)), turn)
        other = at_zero[parent].inverse() @ at_zero[child] @ frame
        yield LoopClosure(spot.name, parent, other, child, frame, kind)


def _read_link(spot: Spot, attribute: str, tree: BodyTree) -> str:
    if (link := spot.require_attribute(attribute, "link1")) not in tree.bodies:
        raise spot.place.make_error(
            f"there is no link {quote_value(link)}{suggest_name(link, tree.bodies)}"
        )
    return link


def _read_loop_kind(spot: Spot) -> str:
    if (kind := spot.get_text("type").lower()) not in _LOOPS:
        raise spot.place.enter("type", kind).make_mismatch(
            f"a joint that closes a loop: {summarise_names(_LOOPS)}"
        )
    return _LOOPS[kind]


def _compute_axis_frame(axis: Spot, attribute: str, kind: str) -> np.ndarray:
    """(3, 3) whose z is the axis of the joint; where it has none, no turn."""
    if kind in ("rigid", "spherical", "position"):
        return np.eye(3)
    if not axis.is_given:
        raise axis.place.make_error(
            f"is missing; expected the direction of the axis of a {kind} joint"
        )
    z = axis.read_direction(attribute, "1 0 0")
    if z[2] == 1.0:
        return np.eye(3)
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(z)))], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z]) + 0.0


# Rotors behind gears, and springs.


def add_armatures(root: Spot, joints: Joints, tell: Tell) -> None:
    """Gear ratio squared times rotor inertia, where transmissions state it; added for each motor.

    As `motorInertia` and `mechanicalReduction` of the actuator, the joint and the transmission, or
    as `drake:rotor_inertia` and `drake:gear_ratio` (drake.mit.edu, "Reflected inertia").
    """
    inner = (
        t
        for control in root.find_children("ros2_control")
        for t in control.find_children("transmission")
    )
    for spot in (*root.find_children("transmission"), *inner):
        motors, driven = (
            [s.merge_children(*_GEARS) for s in spot.find_children(tag)]
            for tag in ("actuator", "joint")
        )
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
            gear = float(motor.read_numbers(gear_key, "1")[0])
            for other in (driven[0], spot.merge_children(_GEARS[3])):
                gear *= float(other.read_numbers(_GEARS[3], "1")[0])
            rotor_inertia, joint = float(motor.read_numbers(rotor, "0")[0]), joints[driven[0].name]
            armature = (joint.armature or 0.0) + gear**2 * rotor_inertia
            joints[joint.name] = replace(joint, armature=armature)
            message = "armature is gear ratio squared times rotor inertia: {}"
            tell(message, f"{joint.name}: {abs(gear):g}^2 * {rotor_inertia:g}")


def add_springs(root: Spot, joints: Joints, tell: Tell) -> None:
    """Springs of joints, of `<dynamics>` and of Gazebo's `<springStiffness>`.

    Raises:
        RobotError: two that differ.
    """
    springs = [(joint.name, joint.find_child("dynamics"), "spring_stiffness", "spring_reference")
               for joint in root.find_children("joint", "drake:joint")]  # fmt: skip
    springs += [(spot.get_text("reference"), spot.merge_children(*_SPRING), *_SPRING)
                for spot in root.find_children("gazebo")]  # fmt: skip
    for name, spot, stiffness, rest in springs:
        spring_values = tuple(float(spot.read_numbers(key, "0")[0]) for key in (stiffness, rest))
        if not spot.get_text(stiffness):
            continue
        joint = joints.get(name)
        if joint is None or joint.kind is JointKind.FIXED:
            tell("springs of what does not move are left out: {}", name)
        elif joint.stiffness is not None and (joint.stiffness, joint.rest) != spring_values:
            raise spot.place.make_error(
                f"joint {quote_value(name)} has two springs that differ; keep one"
            )
        else:
            joints[name] = replace(joint, stiffness=spring_values[0], rest=spring_values[1])
