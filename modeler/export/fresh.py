"""Self-standing URDF, MJCF and SDF of any table: link frames are its frames, links are capsules.

A joint turns about, or slides along, the z axis of its row, or its opposite where the table has
the variable with a minus. MJCF is written in a posture in which the loops are closed (`ref`), and
closes them by points that meet.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.export.bodies import Physics, rest_of, written
from modeler.export.capsules import Capsule, capsules
from modeler.export.linkage import BASE, closed, row_pose, sense, to_quaternion, variables
from modeler.robot import Joint, JointKind, Pose, linear_form, roll_pitch_yaw, turned

LINK, JOINT = "link_", "joint_"
"""Before the name of a row."""

_TINY = 1e-9  # of all mass: a link that has none, where a format asks for some
_EFFORT = 1e3  # N m, N: of a file that must state one
_FAR = 1e3  # m, of a prismatic joint without limits, where it must have some


@dataclass(frozen=True, eq=False)
class Part:
    """A row of the table as a link and its joint.

    Attributes:
        row: it.
        link, joint, parent: names in the file.
        pose: in the frame of the parent, at `zero`.
        zero: position of the joint there.
        axis: (3,) in its own frame.
        body: (10,) mass, centre, inertia about it; None without.
        drive: damping, friction, armature, stiffness, rest; those it has.
        leaders: joints that it follows, and how many times; offset: what is added.
    """

    row: Joint
    link: str
    joint: str
    parent: str
    pose: Pose
    zero: float
    axis: np.ndarray
    body: np.ndarray | None
    drive: Mapping[str, float]
    leaders: Mapping[str, float]
    offset: float
    drawn: tuple[Capsule, ...]


def fresh(physics: Physics, to: str) -> bytes:
    """The text of the file.

    Raises:
        DataError: loops, or couplings of several joints, that the format cannot state.
    """
    robot = physics.robot
    if to != "mjcf" and robot.loops:
        raise DataError(
            f"{robot.name}: {to.upper()} has no loops, and this robot has "
            f"{', '.join(loop.name for loop in robot.loops)}; write MJCF (--to mjcf), or cut the "
            "loops in the robot file"
        )
    at = closed(robot) if to == "mjcf" and (robot.loops or robot.relations) else {}
    parts = _parts(physics, to, at)
    root = {"urdf": _urdf, "mjcf": _mjcf, "sdf": _sdf}[to](physics, parts)
    ET.indent(root)
    return b'<?xml version="1.0"?>\n' + ET.tostring(root) + b"\n"


def _parts(physics: Physics, to: str, at: Mapping[str, float]) -> list[Part]:
    robot = physics.robot
    values = variables(robot, at) | {f"q{row}": q for row, q in at.items()}
    if not at:
        values |= {joint.variable: 0.0 for joint in robot.moving}
    symbols, drawn = robot.symbol_values(), capsules(robot, at)
    named = {frame.row: frame.joint for frame in robot.frames.values() if frame.joint}
    joints = {joint.name: named.get(joint.name, JOINT + joint.name) for joint in robot.joints}
    heavy = sum(float(t[9]) for j in robot.moving if (t := physics.ten(j.name)) is not None)
    found = []
    for row in robot.joints:
        if row.name in robot.motors:
            continue
        ten = physics.ten(row.name)
        body = None if ten is None else written(ten)
        if body is None and row.moves and to != "urdf":
            size = drawn[row.name][0].radius ** 2
            body = _TINY * heavy * np.array([1.0, 0, 0, 0, size, 0, 0, size, 0, size])
        relation = robot.relations.get(row.name)
        form = None if relation is None else linear_form(relation, symbols)
        leaders = {} if form is None else dict(form.coefficients)
        if any(name[1:] in robot.motors for name in leaders):
            leaders = {}
        if len(leaders) > 1 and to != "mjcf":
            raise DataError(
                f"{robot.name}: joint {row.name} follows {', '.join(leaders)}, and {to.upper()} "
                "lets a joint follow one; write MJCF (--to mjcf)"
            )
        drive = {q: physics.value(t)[0] for q, t in physics.drive(row.name, to).items()}
        if "stiffness" in drive:
            drive["rest"] = rest_of(robot, row.name)
        found.append(
            Part(
                row, LINK + row.name, joints[row.name], _link(row.antecedent),
                row_pose(row, values), values[row.variable] if row.moves else 0.0,
                np.array([0.0, 0.0, sense(row, symbols) if row.moves else 1.0]), body, drive,
                {joints[name[1:]]: c for name, c in leaders.items()},
                form.constant if form else 0.0, drawn[row.name],
            )
        )  # fmt: skip
    return found


def _link(row: str) -> str:
    return "base" if row == BASE else LINK + row


def numbers(values: Iterable[float]) -> str:
    """Shortest decimals that read as the same numbers."""
    return " ".join(repr(float(x) + 0.0).removesuffix(".0") for x in values)


Number = float | np.ndarray


def _add(parent: ET.Element, tag: str, **attributes: str | Number) -> ET.Element:
    return ET.SubElement(parent, tag, {key: _written(x) for key, x in attributes.items()})


def _written(value: str | Number) -> str:
    return value if isinstance(value, str) else numbers(np.ravel(value))


def _upright(gravity: np.ndarray) -> np.ndarray:
    """(3, 3) axes of frame 0 in a world whose gravity points along -z."""
    size = float(np.linalg.norm(gravity))
    if not size:
        return np.eye(3)
    down = gravity / size
    axis = np.cross(down, [0.0, 0.0, -1.0])
    sine = float(np.linalg.norm(axis))
    if sine < 1e-12:
        return np.eye(3) if down[2] < 0.0 else turned(np.array([1.0, 0.0, 0.0]), np.pi)
    return turned(axis / sine, float(np.arctan2(sine, -down[2])))


def gravity_of(physics: Physics) -> np.ndarray:
    """(3,) acceleration of gravity in frame 0."""
    symbols = physics.robot.symbol_values()
    return np.array([cell.number(symbols) for cell in physics.robot.gravity])


# URDF.


def _urdf(physics: Physics, parts: list[Part]) -> ET.Element:
    root = ET.Element("robot", name=physics.robot.name)
    lift = _upright(gravity_of(physics))
    if not np.allclose(lift, np.eye(3), atol=1e-12):
        _add(root, "link", name="world")
        joint = _add(root, "joint", name="upright", type="fixed")
        _origin(joint, Pose(np.zeros(3), lift))
        _add(joint, "parent", link="world")
        _add(joint, "child", link="base")
    _add(root, "link", name="base")
    for part in parts:
        link = _add(root, "link", name=part.link)
        if part.body is not None:
            inertial = _add(link, "inertial")
            _add(inertial, "origin", xyz=part.body[1:4], rpy="0 0 0")
            _add(inertial, "mass", value=part.body[0])
            keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
            _add(inertial, "inertia", **dict(zip(keys, part.body[4:], strict=True)))
        for capsule in part.drawn if part.row.moves else ():
            _drawn_urdf(link, capsule)
        limits = physics.robot.limits.get(part.row.name)
        slides = part.row.kind is JointKind.PRISMATIC
        kind = "prismatic" if slides else "revolute" if limits else "continuous"
        joint = _add(root, "joint", name=part.joint, type=kind if part.row.moves else "fixed")
        _origin(joint, part.pose)
        _add(joint, "parent", link=part.parent)
        _add(joint, "child", link=part.link)
        if not part.row.moves:
            continue
        _add(joint, "axis", xyz=part.axis)
        if slides or limits:
            low, high, speed = (
                (limits.lower, limits.upper, limits.speed) if limits else (-_FAR, _FAR, _FAR)
            )
            _add(joint, "limit", lower=low, upper=high, velocity=speed, effort=_EFFORT)
        if part.drive:
            _add(joint, "dynamics", **part.drive)
        for leader, ratio in part.leaders.items():
            _add(joint, "mimic", joint=leader, multiplier=ratio, offset=part.offset)
    return root


def _origin(parent: ET.Element, pose: Pose) -> None:
    _add(parent, "origin", xyz=pose.position, rpy=np.array(roll_pitch_yaw(pose.rotation)))


def _along(capsule: Capsule) -> Pose:
    """The middle of a capsule, z along it."""
    if not capsule.length:
        return Pose()
    z = capsule.end / capsule.length
    return Pose(0.5 * capsule.end, _upright(-z).T)


def _drawn_urdf(link: ET.Element, capsule: Capsule) -> None:
    for end in (np.zeros(3), capsule.end) if capsule.length else (np.zeros(3),):
        visual = _add(link, "visual")
        _origin(visual, Pose(end))
        _add(_add(visual, "geometry"), "sphere", radius=capsule.radius)
    if capsule.length:
        visual = _add(link, "visual")
        _origin(visual, _along(capsule))
        _add(_add(visual, "geometry"), "cylinder", radius=capsule.radius, length=capsule.length)


# MJCF.


def _mjcf(physics: Physics, parts: list[Part]) -> ET.Element:
    robot = physics.robot
    root = ET.Element("mujoco", model=robot.name)
    _add(root, "compiler", angle="radian")
    _add(root, "option", gravity=gravity_of(physics))
    bodies = {"base": _add(_add(root, "worldbody"), "body", name="base")}
    equality, tendons, motors = (ET.Element(x) for x in ("equality", "tendon", "actuator"))
    zero = {part.joint: part.zero for part in parts}
    for part in parts:
        body = _add(
            bodies[part.parent], "body", name=part.link, pos=part.pose.position,
            quat=to_quaternion(part.pose.rotation),
        )  # fmt: skip
        bodies[part.link] = body
        if not part.row.moves:
            continue
        if part.body is not None:
            full = part.body[[4, 7, 9, 5, 6, 8]]
            _add(body, "inertial", pos=part.body[1:4], mass=part.body[0], fullinertia=full)
        kind = "slide" if part.row.kind is JointKind.PRISMATIC else "hinge"
        keys = {"friction": "frictionloss", "rest": "springref"}
        more: dict[str, str | Number] = {keys.get(q, q): x for q, x in part.drive.items()}
        if limits := robot.limits.get(part.row.name):
            more["range"] = np.array([limits.lower, limits.upper])
        if part.zero:
            more["ref"] = part.zero
        _add(body, "joint", name=part.joint, type=kind, axis=part.axis, **more)
        for capsule in part.drawn:
            if capsule.length:
                ends = np.array([*np.zeros(3), *capsule.end])
                shape: dict[str, str | Number] = {"type": "capsule", "fromto": ends}
            else:
                shape = {"type": "sphere"}
            _add(body, "geom", **shape, size=capsule.radius, mass=0.0, contype="0", conaffinity="0")
        follows = part.row.name in robot.relations
        if part.leaders:
            _follow(part, zero, equality, tendons)
        elif part.row.actuated or follows:
            _add(motors, "motor", name=part.joint, joint=part.joint)
    for loop in robot.loops:
        _close(loop.kind, _link(loop.frame), _link(loop.meets), parts[0].drawn[0].radius, equality)
    root.extend(element for element in (tendons, equality, motors) if len(element))
    return root


def _follow(
    part: Part, zero: Mapping[str, float], equality: ET.Element, tendons: ET.Element
) -> None:
    """q = offset + sum ratio q_leader; MuJoCo counts from the positions of `ref`."""
    if len(part.leaders) == 1:
        ((leader, ratio),) = part.leaders.items()
        start = part.offset + ratio * zero[leader] - part.zero
        _add(
            equality, "joint", joint1=part.joint, joint2=leader,
            polycoef=np.array([start, ratio, 0, 0, 0]),
        )  # fmt: skip
        return
    name = f"{part.joint}_follows"
    fixed = _add(tendons, "fixed", name=name)
    for joint, ratio in {part.joint: -1.0, **part.leaders}.items():
        _add(fixed, "joint", joint=joint, coef=ratio)
    _add(equality, "tendon", tendon1=name, polycoef="0 1 0 0 0")


def _close(kind: str, one: str, other: str, size: float, equality: ET.Element) -> None:
    bodies = {"body1": one, "body2": other}
    if kind == "rigid":
        _add(equality, "weld", **bodies)
        return
    _add(equality, "connect", anchor="0 0 0", **bodies)
    if kind == "revolute":
        _add(equality, "connect", anchor=np.array([0.0, 0.0, size]), **bodies)


# SDF.


def _sdf(physics: Physics, parts: list[Part]) -> ET.Element:
    root = ET.Element("sdf", version="1.9")
    model = _add(root, "model", name=physics.robot.name)
    base = _add(model, "link", name="base")
    _pose(base, Pose(np.zeros(3), _upright(gravity_of(physics))))
    world = _add(model, "joint", name="upright", type="fixed")
    _text(world, "parent", "world")
    _text(world, "child", "base")
    for part in parts:
        if not part.row.moves:
            frame = _add(model, "frame", name=part.link, attached_to=part.parent)
            _pose(frame, part.pose)
            continue
        link = _add(model, "link", name=part.link)
        _pose(link, part.pose, relative_to=part.parent)
        assert part.body is not None
        inertial = _add(link, "inertial")
        _pose(inertial, Pose(part.body[1:4]))
        _text(inertial, "mass", part.body[0])
        tensor = _add(inertial, "inertia")
        for key, value in zip(
            ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), part.body[4:], strict=True
        ):
            _text(tensor, key, value)
        for k, capsule in enumerate(part.drawn):
            visual = _add(link, "visual", name=f"capsule{k}")
            _pose(visual, _along(capsule))
            shape = _add(_add(visual, "geometry"), "capsule" if capsule.length else "sphere")
            _text(shape, "radius", capsule.radius)
            if capsule.length:
                _text(shape, "length", capsule.length)
        slides = part.row.kind is JointKind.PRISMATIC
        joint = _add(model, "joint", name=part.joint, type="prismatic" if slides else "revolute")
        _text(joint, "parent", part.parent)
        _text(joint, "child", part.link)
        axis = _add(joint, "axis")
        _text(axis, "xyz", part.axis)
        if limits := physics.robot.limits.get(part.row.name):
            limit = _add(axis, "limit")
            _text(limit, "lower", limits.lower)
            _text(limit, "upper", limits.upper)
            _text(limit, "velocity", limits.speed)
        if part.drive:
            dynamics = _add(axis, "dynamics")
            keys = {"stiffness": "spring_stiffness", "rest": "spring_reference"}
            for quantity, value in part.drive.items():
                _text(dynamics, keys.get(quantity, quantity), value)
        for leader, ratio in part.leaders.items():
            mimic = _add(axis, "mimic", joint=leader)
            _text(mimic, "multiplier", ratio)
            _text(mimic, "offset", part.offset)
            _text(mimic, "reference", 0.0)
    return root


def _pose(parent: ET.Element, pose: Pose, **attributes: str) -> None:
    place = [*pose.position, *roll_pitch_yaw(pose.rotation)]
    _add(parent, "pose", **attributes).text = numbers(place)


def _text(parent: ET.Element, tag: str, value: str | Number) -> None:
    _add(parent, tag).text = _written(value)
