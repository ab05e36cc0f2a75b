"""Parts of a body tree: its base, its tip, joints that are held.

What is cut off by `base` stands still before the new first link, and what is cut off by `tip` is
gone with its weight; bodies that hang on by fixed joints stay. A joint that is held keeps its
bodies, on what moves before it.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from modeler.core.errors import RobotError
from modeler.core.expression import ExpressionError, parse_expression
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.formats.body_tree import BodyTree, Couplings, TreeJoint, compute_body_poses
from modeler.robot import LARGEST_LENGTH, JointKind


def cut_tree(
    tree: BodyTree, base: str = "", tip: str = "", locks: Mapping[str, str | float] | None = None
) -> BodyTree:
    """Returns the part of a robot that is meant, every joint of it of a kind that we have.

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
        tree = _apply_lock(tree, name, value)
    if base:
        tree = _cut_to_base(tree, base)
    if tip:
        tree = _cut_to_tip(tree, tip)
    return _check_supported(tree)


def parse_lock_values(texts: Iterable[str]) -> dict[str, str]:
    """Returns `elbow=30 deg` of the command line, as joint -> position.

    Raises:
        RobotError: no `=`, or a joint twice.
    """
    positions: dict[str, str] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.rpartition("="))
        if not (name and equals and value):
            raise TomlCell("--lock", "", text).make_mismatch('joint=position such as "elbow=0.3"')
        if name in positions:
            what = f"joint {quote_value(name)} is locked twice"
            raise TomlCell("--lock", "", text).make_error(what)
        positions[name] = value
    return positions


def fix_joint(joint: TreeJoint, position: float) -> TreeJoint:
    """Returns the joint as one that is fixed at a position."""
    pose = joint.compute_pose(position)
    kind, parent, child = JointKind.FIXED, joint.parent, joint.child
    return TreeJoint(joint.name, kind, parent, child, pose, actuated=False)


def resolve_leaders(joints: dict[str, TreeJoint], direct: Couplings) -> tuple[list[str], str]:
    """Lets joints follow the one that leads, through those that follow it themselves.

    Args:
        joints: by name; changed in place.
        direct: joint -> that which it follows, "" for none, ratio and offset.

    Returns:
        Those that stand still, for what they follow does; one that follows itself, "" if none does.
    """
    fixed_names = list[str]()
    for name in direct:
        leader, ratio, offset = name, 1.0, 0.0
        for _ in range(len(direct) + 1):
            if leader not in direct:
                break
            leader, times, plus = direct[leader]
            ratio, offset = ratio * times, ratio * plus + offset
        else:
            return fixed_names, name
        if ratio == 0.0 or joints[leader].kind is JointKind.FIXED:
            joints[name] = fix_joint(joints[name], offset)
            fixed_names.append(name)
        else:
            joint = replace(joints[name], leader=leader, ratio=ratio, offset=offset)
            joints[name] = replace(joint, actuated=False)
    return fixed_names, ""


def _apply_lock(tree: BodyTree, name: str, value: str | float) -> BodyTree:
    place = TomlCell("--lock", quote_value(name))
    joints = {joint.name: joint for joint in tree.joints}
    joint = joints.get(name)
    if joint is None:
        near = suggest_name(name, joints)
        raise place.make_error(f"no joint of that name{near}; expected one of {join_names(joints)}")
    if joint.leader:
        leader = quote_value(joint.leader)
        raise place.make_error(f"it follows joint {leader}; lock that one, both stop then")
    position = _read_position(place.with_value(value), joint)
    if joint.kind is JointKind.FIXED and position != 0.0:
        kind = tree.unsupported_joints.get(name, ": fixed").rsplit(": ", 1)[1]
        expected = f"0: a {kind} joint is held where the file has it"
        raise place.with_value(value).make_mismatch(expected)
    notes = list(tree.notes)
    if (joint.lower is not None and position < joint.lower - 1e-9) or (
        joint.upper is not None and position > joint.upper + 1e-9
    ):
        notes.append(f"joint {quote_value(name)} is locked at {position:g}, outside of its limits")
    stops = {name: position} | {
        other.name: other.ratio * position + other.offset
        for other in tree.joints
        if other.leader == name
    }
    locked = tuple(fix_joint(j, stops[j.name]) if j.name in stops else j for j in tree.joints)
    unsupported = {key: kind for key, kind in tree.unsupported_joints.items() if key != name}
    return replace(tree, joints=locked, unsupported_joints=unsupported, notes=tuple(notes))


def _read_position(place: TomlCell, joint: TreeJoint) -> float:
    try:
        read = parse_expression(place.value)
        units, position = read.infer_units({}), read.evaluate()
    except (ExpressionError, ArithmeticError, KeyError, ValueError):
        raise place.make_mismatch('a position in rad or m, such as 0.3 or "30 deg"') from None
    unit = "m" if joint.kind is JointKind.PRISMATIC else "rad"
    if units - {unit} or not abs(position) < LARGEST_LENGTH:
        kind = joint.kind.name.lower()
        raise place.make_mismatch(f"a position in {unit}, for the joint is {kind}")
    return position


def _check_link(tree: BodyTree, option: str, name: str) -> str:
    if name not in tree.bodies or name in tree.auxiliary_bodies:
        known = [body for body in tree.bodies if body not in tree.auxiliary_bodies]
        is_joint = any(joint.name == name for joint in tree.joints)
        lacking = f"no link of that name in {tree.name}"
        problem = "is a joint; expected a link" if is_joint else lacking
        raise RobotError(f"{option}: {quote_value(name)}: {problem}{suggest_name(name, known)}")
    return name


def _cut_to_base(tree: BodyTree, name: str) -> BodyTree:
    base = _check_link(tree, "--base", name)
    if base == tree.root:
        return tree
    poses = compute_body_poses(tree, {})
    part = _extract_subtree(tree, base, lambda _: True, "before --base")
    gravity = poses[base].rotation.T @ tree.gravity + 0.0
    entries = ", ".join(f"{entry:.6g}" for entry in gravity)
    where = f"in the frame of {quote_value(base)}"
    note = f"gravity {where}, with all joints before it at 0: [{entries}]"
    return replace(part, gravity=gravity, notes=(*part.notes, note))


def _cut_to_tip(tree: BodyTree, name: str) -> BodyTree:
    tip = _check_link(tree, "--tip", name)
    above = {joint.child: joint for joint in tree.joints}
    chain = {tip}
    while tip != tree.root:
        chain.add(tip := above[tip].parent)
    where = "off the way to --tip"
    return _extract_subtree(
        tree, tree.root, lambda j: j.child in chain or _is_fixed(tree, j), where
    )


def _is_fixed(tree: BodyTree, joint: TreeJoint) -> bool:
    return joint.kind is JointKind.FIXED and joint.name not in tree.unsupported_joints


def _extract_subtree(
    tree: BodyTree, root: str, keep: Callable[[TreeJoint], bool], where: str
) -> BodyTree:
    """The tree from `root` on, by the joints to keep."""
    bodies = {root}
    joints = []
    for joint in tree.joints:
        if joint.parent in bodies and keep(joint):
            joints.append(joint)
            bodies.add(joint.child)
    names = {joint.name for joint in joints}
    notes = list(tree.notes)
    visible = [name for name in tree.bodies if name not in tree.auxiliary_bodies]
    removed_bodies = [name for name in visible if name not in bodies]
    weight = sum(body.mass for name in removed_bodies if (body := tree.bodies[name]) is not None)
    if removed_bodies:
        advice = "; --lock their joints to keep their weight" if weight and "tip" in where else ""
        notes.append(f"left out, {where}: {len(removed_bodies)} links of {weight:.4g} kg{advice}")
    for place, joint in enumerate(joints):
        if joint.leader and joint.leader not in names:
            joints[place] = fix_joint(joint, joint.offset)
            leader = quote_value(joint.leader)
            description = f"follows {leader}, which is left out: held at {joint.offset:g}"
            notes.append(f"joint {quote_value(joint.name)} {description}")
    meetings = tuple(m for m in tree.loop_closures if m.body in bodies and m.other in bodies)
    notes += [f"left out with its body: {m.name}" for m in tree.loop_closures if m not in meetings]
    remaining = {name: body for name, body in tree.bodies.items() if name in bodies}
    unsupported = {key: kind for key, kind in tree.unsupported_joints.items() if key in names}
    tree = replace(tree, root=root, bodies=remaining, joints=tuple(joints), notes=tuple(notes))
    return replace(tree, loop_closures=meetings, unsupported_joints=unsupported)


def _check_supported(tree: BodyTree) -> BodyTree:
    """With a floating base standing still; refuses what else is not read."""
    fixed_bodies = {tree.root}
    for joint in tree.joints:
        if joint.parent in fixed_bodies and _is_fixed(tree, joint):
            fixed_bodies.add(joint.child)
    moving = [j for j in tree.joints if j.parent in fixed_bodies and not _is_fixed(tree, j)]
    notes, unread = list(tree.notes), dict(tree.unsupported_joints)
    if len(moving) == 1 and moving[0].name in unread:
        first = moving[0]
        kind = unread.pop(first.name).rsplit(": ", 1)[1]
        description = f"({kind}) is held: link {quote_value(first.child)} stands still"
        notes.append(f"joint {quote_value(first.name)} {description}")
    for name, description in unread.items():
        advice = f"cut it off with --base LINK or --tip LINK, or hold it with --lock {name}=0"
        raise RobotError(f"{description} joints are not read; {advice}")
    return replace(tree, unsupported_joints=unread, notes=tuple(notes))
