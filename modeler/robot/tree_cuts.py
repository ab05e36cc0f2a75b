"""Parts of a body tree: its base, its tip, joints that are held.

What is cut off by `base` stands still before the new first link, and what is cut off by `tip` is
gone with its weight; bodies that hang on by fixed joints stay. A joint that is held keeps its
bodies, on what moves before it.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from modeler.core.errors import RobotError
from modeler.core.expression import ExpressionError, parse
from modeler.core.toml_cells import Place, listed, near, shown
from modeler.robot.body_tree import BodyTree, TreeJoint, poses_at
from modeler.robot.cells import LARGEST_LENGTH
from modeler.robot.robot import JointKind


def cut(
    tree: BodyTree, base: str = "", tip: str = "", locks: Mapping[str, str | float] | None = None
) -> BodyTree:
    """The part of a robot that is meant, every joint of it of a kind that we have.

    Joints are locked first, then what is before `base` is left out, then what is not on the way to
    `tip`. A joint of another kind is held where it carries the first link (a floating base); it may
    be cut off or locked too.

    Args:
        tree: of a reader.
        base: link that stands still, and whose frame is frame 0; "" for the first.
        tip: last link of the chain; "" for all branches.
        locks: joint -> position at which it is held: rad, m, or text such as "30 deg".

    Raises:
        RobotError: no such link or joint, or a joint of a kind that we do not have.
    """
    for name, value in (locks or {}).items():
        tree = _locked(tree, name, value)
    if base:
        tree = _from_base(tree, base)
    if tip:
        tree = _to_tip(tree, tip)
    return _all_read(tree)


def lock_values(texts: Iterable[str]) -> dict[str, str]:
    """`elbow=30 deg` of the command line, as joint -> position.

    Raises:
        RobotError: no `=`, or a joint twice.
    """
    found: dict[str, str] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.rpartition("="))
        if not (name and equals and value):
            raise Place("--lock", "", text).mismatch('joint=position such as "elbow=0.3"')
        if name in found:
            raise Place("--lock", "", text).error(f"joint {shown(name)} is locked twice")
        found[name] = value
    return found


def held(joint: TreeJoint, position: float) -> TreeJoint:
    """The joint as one that is fixed at a position."""
    return TreeJoint(
        joint.name, JointKind.FIXED, joint.parent, joint.child, joint.at(position), actuated=False
    )


def follow(
    joints: dict[str, TreeJoint], direct: Mapping[str, tuple[str, float, float]]
) -> tuple[list[str], str]:
    """Let joints follow the one that leads, through those that follow it themselves.

    Args:
        joints: by name; changed in place.
        direct: joint -> that which it follows, "" for none, ratio and offset.

    Returns:
        Those that stand still, for what they follow does; one that follows itself, "" if none does.
    """
    still = list[str]()
    for name in direct:
        leader, ratio, offset = name, 1.0, 0.0
        for _ in range(len(direct) + 1):
            if leader not in direct:
                break
            leader, times, plus = direct[leader]
            ratio, offset = ratio * times, ratio * plus + offset
        else:
            return still, name
        if ratio == 0.0 or joints[leader].kind is JointKind.FIXED:
            joints[name] = held(joints[name], offset)
            still.append(name)
        else:
            joints[name] = replace(
                joints[name], leader=leader, ratio=ratio, offset=offset, actuated=False
            )
    return still, ""


def _locked(tree: BodyTree, name: str, value: str | float) -> BodyTree:
    place = Place("--lock", shown(name))
    joints = {joint.name: joint for joint in tree.joints}
    joint = joints.get(name)
    if joint is None:
        raise place.error(
            f"no joint of that name{near(name, joints)}; expected one of {listed(joints)}"
        )
    if joint.leader:
        raise place.error(f"it follows joint {shown(joint.leader)}; lock that one, both stop then")
    position = _position(place.holding(value), joint)
    if joint.kind is JointKind.FIXED and position != 0.0:
        kind = tree.unread.get(name, ": fixed").rsplit(": ", 1)[1]
        raise place.holding(value).mismatch(f"0: a {kind} joint is held where the file has it")
    notes = list(tree.notes)
    if (joint.lower is not None and position < joint.lower - 1e-9) or (
        joint.upper is not None and position > joint.upper + 1e-9
    ):
        notes.append(f"joint {shown(name)} is locked at {position:g}, outside of its limits")
    stops = {name: position} | {
        other.name: other.ratio * position + other.offset
        for other in tree.joints
        if other.leader == name
    }
    return replace(
        tree,
        joints=tuple(held(j, stops[j.name]) if j.name in stops else j for j in tree.joints),
        unread={key: told for key, told in tree.unread.items() if key != name},
        notes=tuple(notes),
    )


def _position(place: Place, joint: TreeJoint) -> float:
    try:
        read = parse(place.value)
        units, position = read.units({}), read.number()
    except (ExpressionError, ArithmeticError, KeyError, ValueError):
        raise place.mismatch('a position in rad or m, such as 0.3 or "30 deg"') from None
    unit = "m" if joint.kind is JointKind.PRISMATIC else "rad"
    if units - {unit} or not abs(position) < LARGEST_LENGTH:
        raise place.mismatch(f"a position in {unit}, for the joint is {joint.kind.name.lower()}")
    return position


def _link(tree: BodyTree, option: str, name: str) -> str:
    if name not in tree.bodies or name in tree.hidden:
        known = [body for body in tree.bodies if body not in tree.hidden]
        is_joint = any(joint.name == name for joint in tree.joints)
        told = "is a joint; expected a link" if is_joint else f"no link of that name in {tree.name}"
        raise RobotError(f"{option}: {shown(name)}: {told}{near(name, known)}")
    return name


def _from_base(tree: BodyTree, name: str) -> BodyTree:
    base = _link(tree, "--base", name)
    if base == tree.root:
        return tree
    poses = poses_at(tree, {})
    part = _kept(tree, base, lambda _: True, "before --base")
    gravity = poses[base].rotation.T @ tree.gravity + 0.0
    entries = ", ".join(f"{entry:.6g}" for entry in gravity)
    told = f"gravity in the frame of {shown(base)}, with all joints before it at 0: [{entries}]"
    return replace(part, gravity=gravity, notes=(*part.notes, told))


def _to_tip(tree: BodyTree, name: str) -> BodyTree:
    tip = _link(tree, "--tip", name)
    above = {joint.child: joint for joint in tree.joints}
    way = {tip}
    while tip != tree.root:
        way.add(tip := above[tip].parent)
    where = "off the way to --tip"
    return _kept(tree, tree.root, lambda j: j.child in way or _fixed(tree, j), where)


def _fixed(tree: BodyTree, joint: TreeJoint) -> bool:
    return joint.kind is JointKind.FIXED and joint.name not in tree.unread


def _kept(tree: BodyTree, root: str, keep: Callable[[TreeJoint], bool], where: str) -> BodyTree:
    """The tree from `root` on, by the joints to keep."""
    bodies = {root}
    joints = []
    for joint in tree.joints:
        if joint.parent in bodies and keep(joint):
            joints.append(joint)
            bodies.add(joint.child)
    names = {joint.name for joint in joints}
    notes = list(tree.notes)
    gone = [name for name in tree.bodies if name not in bodies and name not in tree.hidden]
    weight = sum(body.mass for name in gone if (body := tree.bodies[name]) is not None)
    if gone:
        advice = "; --lock their joints to keep their weight" if weight and "tip" in where else ""
        notes.append(f"left out, {where}: {len(gone)} links of {weight:.4g} kg{advice}")
    for place, joint in enumerate(joints):
        if joint.leader and joint.leader not in names:
            joints[place] = held(joint, joint.offset)
            told = f"follows {shown(joint.leader)}, which is left out: held at {joint.offset:g}"
            notes.append(f"joint {shown(joint.name)} {told}")
    meetings = tuple(m for m in tree.meetings if m.body in bodies and m.other in bodies)
    notes += [f"left out with its body: {m.name}" for m in tree.meetings if m not in meetings]
    return replace(
        tree,
        root=root,
        bodies={name: body for name, body in tree.bodies.items() if name in bodies},
        joints=tuple(joints),
        meetings=meetings,
        unread={name: told for name, told in tree.unread.items() if name in names},
        notes=tuple(notes),
    )


def _all_read(tree: BodyTree) -> BodyTree:
    """With a floating base standing still; refuses what else is not read."""
    still = {tree.root}
    for joint in tree.joints:
        if joint.parent in still and _fixed(tree, joint):
            still.add(joint.child)
    moving = [j for j in tree.joints if j.parent in still and not _fixed(tree, j)]
    notes, unread = list(tree.notes), dict(tree.unread)
    if len(moving) == 1 and moving[0].name in unread:
        first = moving[0]
        kind = unread.pop(first.name).rsplit(": ", 1)[1]
        told = f"({kind}) is held: link {shown(first.child)} stands still"
        notes.append(f"joint {shown(first.name)} {told}")
    for name, told in unread.items():
        instead = f"cut it off with --base LINK or --tip LINK, or hold it with --lock {name}=0"
        raise RobotError(f"{told} joints are not read; {instead}")
    return replace(tree, unread=unread, notes=tuple(notes))
