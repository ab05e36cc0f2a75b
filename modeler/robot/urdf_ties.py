"""What a URDF states between joints: couplings, loops, gears and springs, wherever it stands.

Couplings are `<mimic>`, Drake's, that of Gazebo's plugin, of ros2_control and of URDF+; loops those
of Gazebo (a `<joint>` of SDF), URDF+, Drake, Isaac Sim, and of urdfdom's proposed `<constraint>`.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from modeler.core.toml_cells import near, shown
from modeler.robot.body_tree import (
    BodyTree,
    Meeting,
    Pose,
    Roundings,
    TreeJoint,
    moving_links,
    poses_at,
    several,
)  # fmt: skip
from modeler.robot.robot import LOOP_KINDS, JointKind
from modeler.robot.xml_cells import Spot, pose_of, rotation_of

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


def couplings(root: Spot, joints: Joints, tell: Tell) -> dict[str, tuple[str, float, float]]:
    """Joint -> that which it follows, ratio and offset.

    Raises:
        RobotError: two statements that differ, a coupling of no two joints.
    """
    found: dict[str, tuple[str, float, float]] = {}
    for spot, follower, leader in _coupled(root, joints, tell):
        if follower not in joints:
            raise spot.place.error(f"there is no joint {shown(follower)}{near(follower, joints)}")
        key = "ratio" if spot.element.tag == "coupling" else "multiplier"
        ratio, offset = (float(spot.numbers(k, d)[0]) for k, d in ((key, "1"), ("offset", "0")))
        if joints[follower].kind is JointKind.FIXED:
            continue
        if leader not in joints:
            told = "the file lacks the joint to mimic, it moves freely: {}"
            tell(told, f"{follower} of {leader}")
        elif found.setdefault(follower, (leader, ratio, offset)) != (leader, ratio, offset):
            told = f"joint {shown(follower)} follows in two ways; keep the one that is meant"
            raise spot.place.error(told)
    return found


def _coupled(root: Spot, joints: Joints, tell: Tell) -> Iterator[tuple[Spot, str, str]]:
    """Where it is stated, follower and leader."""
    for outer, inner, follower, leader in _COUPLED:
        for around in root.all(outer, f"drake:{outer}"):
            for spot in around.all(inner):
                spot = spot.flat(follower, leader, "multiplier", "offset")
                given = {"name": around.name, **spot.element.attributes}
                if inner.endswith("mimic") or (given.get(follower) and given.get(leader)):
                    yield spot, given[follower], spot.needed(leader, "joint1")
                elif inner == "plugin":
                    tell("plugins of Gazebo are left out: {}", spot.said("filename"))
    above = {joint.child: joint for joint in joints.values()}
    for spot in root.all("coupling"):
        one, two = (above.get(spot.must(tag, 'link="a"').needed("link", "a"))
                    for tag in ("predecessor", "successor"))  # fmt: skip
        line = spot.flat("ratio")
        line.needed("ratio", "1")
        if one is None or two is None or one is two or one.parent != two.parent:
            raise spot.place.error(
                "expected two links whose joints stand on one link; or write a mimic tag"
            )
        yield line, two.name, one.name


# Joints that close loops.


def with_loops(root: Spot, tree: BodyTree, rounded: Roundings) -> BodyTree:
    """The tree with the loops that the file closes, the motors that it names, and its posture.

    Raises:
        RobotError: a loop of a kind that robot files do not have, links that are not there.
    """
    link_of = {body: k for k, link in enumerate(moving_links(tree)) for body in link.bodies}
    made = list(_meetings(root, tree, rounded))
    still = [m for m in made if link_of[m.body] == link_of[m.other]]
    notes = [f"loops within one body are left out: {several(m.name for m in still)}"] * bool(still)
    made = [meeting for meeting in made if meeting not in still]
    joints, home = tree.joints, dict[str, float]()
    if made:
        motors = {j.name for j in root.all("joint") if j.said("independent").lower() == "true"}
        for outer in root.all("transmission", "ros2_control"):
            driven = bool(outer.all("actuator"))
            motors |= {j.name for j in outer.all("joint") if driven or j.all("command_interface")}
        joints = tuple(replace(j, actuated=j.name in motors and not j.leader) for j in joints)
        for gazebo in (spot.flat(_START) for spot in root.all("gazebo")):
            if gazebo.said(_START):
                home[gazebo.said("reference")] = float(gazebo.numbers(_START, "0")[0])
    return replace(
        tree, meetings=tuple(made), joints=joints, home=home, notes=(*tree.notes, *notes)
    )


def _meetings(root: Spot, tree: BodyTree, rounded: Roundings) -> Iterator[Meeting]:
    for spot in root.all("loop", "loop_joint", "constraint"):
        kind, links, poses = _kind(spot), list[str](), list[Pose]()
        for side in spot.all(*_SIDES):
            inside, own = side.only("origin"), spot.only(f"{side.element.tag}_origin")
            origin = next((o for o in (inside, own) if o.given), side)
            axis = spot.only(f"{side.element.tag}_axis")
            turn = _turn_to(axis if axis.given else spot.only("axis"), "xyz", kind)
            links.append(_known(side, "link", tree))
            poses.append(pose_of(origin, rounded) @ Pose(rotation=turn))
        if len(links) != 2:
            raise spot.place.error(f"expected the two links that meet, got {len(links)}")
        yield Meeting(spot.name, links[0], poses[0], links[1], poses[1], kind)
    for spot in root.all("drake:ball_constraint"):
        inner = [spot.only(f"drake:ball_constraint_{key}") for key in _BALL]
        bodies = [_known(body, "name", tree) for body in inner[:2]]
        places = [Pose(rounded.lengths(at.numbers("value", "0 0 0"))) for at in inner[2:]]
        yield Meeting("ball_constraint", bodies[0], places[0], bodies[1], places[1])
    at_zero = poses_at(tree, {})
    for spot in (j for gazebo in root.all("gazebo") for j in gazebo.all("joint")):
        flat, kind = spot.flat("parent", "child", "pose"), _kind(spot)
        axis = spot.only("axis").flat("xyz")
        seen = [*spot.only("pose").element.attributes, *axis.only("xyz").element.attributes]
        if seen or axis.only("use_parent_model_frame").given:
            told = "its pose or axis is seen from another frame; expected that of the child"
            raise spot.place.error(told)
        world = flat.said("parent") == "world" and "world" not in tree.bodies
        parent = tree.root if world else _known(flat, "parent", tree)
        child = _known(flat, "child", tree)
        place = flat.digits("pose", "0 0 0 0 0 0")
        turn = rotation_of(map(rounded.angle, place[3:])) @ _turn_to(axis, "xyz", kind)
        frame = Pose(rounded.lengths(np.array(place[:3], float)), turn)
        other = at_zero[parent].inverse() @ at_zero[child] @ frame
        yield Meeting(spot.name, parent, other, child, frame, kind)


def _known(spot: Spot, attribute: str, tree: BodyTree) -> str:
    if (link := spot.needed(attribute, "link1")) not in tree.bodies:
        raise spot.place.error(f"there is no link {shown(link)}{near(link, tree.bodies)}")
    return link


def _kind(spot: Spot) -> str:
    if (kind := spot.said("type").lower()) not in _LOOPS:
        raise spot.place.at("type", kind).mismatch(f"a joint that closes a loop: {several(_LOOPS)}")
    return _LOOPS[kind]


def _turn_to(axis: Spot, attribute: str, kind: str) -> np.ndarray:
    """(3, 3) whose z is the axis of the joint; where it has none, no turn."""
    if kind in ("rigid", "spherical", "position"):
        return np.eye(3)
    if not axis.given:
        raise axis.place.error(f"is missing; expected the direction of the axis of a {kind} joint")
    z = axis.direction(attribute, "1 0 0")
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
    inner = (t for control in root.all("ros2_control") for t in control.all("transmission"))
    for spot in (*root.all("transmission"), *inner):
        motors, driven = ([s.flat(*_GEARS) for s in spot.all(tag)] for tag in ("actuator", "joint"))
        if len(motors) > 1 or len(driven) > 1:
            tell(_SEVERAL, spot.name)
            continue
        for motor in motors:
            rotor = next((key for key in _GEARS[:2] if motor.said(key)), "")
            if not rotor:
                continue
            if not driven or driven[0].name not in joints:
                tell("rotors on joints that are not there are left out: {}", spot.name)
                continue
            own = next((key for key in _GEARS[2:] if motor.said(key)), "")
            gear = float(motor.numbers(own, "1")[0])
            for other in (driven[0], spot.flat(_GEARS[3])):
                gear *= float(other.numbers(_GEARS[3], "1")[0])
            worth, joint = float(motor.numbers(rotor, "0")[0]), joints[driven[0].name]
            armature = (joint.armature or 0.0) + gear**2 * worth
            joints[joint.name] = replace(joint, armature=armature)
            told = "armature is gear ratio squared times rotor inertia: {}"
            tell(told, f"{joint.name}: {abs(gear):g}^2 * {worth:g}")


def add_springs(root: Spot, joints: Joints, tell: Tell) -> None:
    """Springs of joints, of `<dynamics>` and of Gazebo's `<springStiffness>`.

    Raises:
        RobotError: two that differ.
    """
    springs = [(joint.name, joint.only("dynamics"), "spring_stiffness", "spring_reference")
               for joint in root.all("joint", "drake:joint")]  # fmt: skip
    springs += [(spot.said("reference"), spot.flat(*_SPRING), *_SPRING)
                for spot in root.all("gazebo")]  # fmt: skip
    for name, spot, stiffness, rest in springs:
        worth = tuple(float(spot.numbers(key, "0")[0]) for key in (stiffness, rest))
        if not spot.said(stiffness):
            continue
        joint = joints.get(name)
        if joint is None or joint.kind is JointKind.FIXED:
            tell("springs of what does not move are left out: {}", name)
        elif joint.stiffness is not None and (joint.stiffness, joint.rest) != worth:
            raise spot.place.error(f"joint {shown(name)} has two springs that differ; keep one")
        else:
            joints[name] = replace(joint, stiffness=worth[0], rest=worth[1])
