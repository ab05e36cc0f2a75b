"""Self-standing URDF, MJCF and SDF of any table: link frames are its frames, links are capsules.

A joint turns about, or slides along, the z axis of its row, or its opposite where the table has
the variable with a minus. MJCF is written in a posture in which the loops are closed (`ref`), and
closes them by points that meet.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.exports.bodies import LEAST, Physics, rest_of, written
from modeler.exports.capsules import Capsule, capsules
from modeler.exports.linkage import BASE, closed, gravity_of, row_pose, sense, variables
from modeler.exports.original import TENSOR
from modeler.exports.result import numbers
from modeler.robot import Joint, JointKind, Pose, Robot, linear_form, roll_pitch_yaw, turned

_TINY = {"mjcf": 1e-13, "urdf": 1e-9, "sdf": 1e-9}
"""Of all mass: a link that has none, which MuJoCo and SDF refuse; ODE divides by it."""

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


@dataclass(frozen=True)
class Names:
    """What rows are called, no name being that of two things: SDF and MuJoCo refuse such.

    Attributes:
        joints: by row: as in the file that the robot came from, where it has them.
        links: by row, and of the base.
        upright: the joint that turns the base.
    """

    joints: dict[str, str]
    links: dict[str, str]
    upright: str

    @classmethod
    def of(cls, robot: Robot) -> "Names":
        """Of a table."""
        taken = {"world", *(frame.joint for frame in robot.frames.values())}

        def free(name: str) -> str:
            while name in taken:
                name += "_"
            taken.add(name)
            return name

        rows = [joint.name for joint in robot.joints]
        given = {f.row: f.joint for f in robot.frames.values() if f.joint not in ("", "world")}
        joints = {row: given.get(row) or free(f"joint_{row}") for row in rows}
        links = {BASE: free("base")} | {row: free(f"link_{row}") for row in rows}
        return cls(joints, links, free("upright"))


def fresh(physics: Physics, to: str, notes: list[str]) -> bytes:
    """The text of the file; notes grow.

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
    names = Names.of(robot)
    parts = _parts(physics, to, at, names, notes)
    root = {"urdf": _urdf, "mjcf": _mjcf, "sdf": _sdf}[to](physics, parts, names)
    ET.indent(root)
    return b'<?xml version="1.0"?>\n' + ET.tostring(root) + b"\n"


def _parts(
    physics: Physics, to: str, at: Mapping[str, float], names: Names, notes: list[str]
) -> list[Part]:
    robot, light = physics.robot, list[str]()
    values = variables(robot, at) | {f"q{row}": q for row, q in at.items()}
    if not at:
        values |= {joint.variable: 0.0 for joint in robot.moving}
    symbols, drawn = robot.symbol_values(), capsules(robot, at)
    heavy = sum(float(t[9]) for j in robot.moving if (t := physics.ten(j.name)) is not None)
    found, moment, tiny = [], LEAST, _TINY[to]
    for row in robot.joints:
        if row.name in robot.motors:
            continue
        ten = physics.ten(row.name)
        body = None if ten is None or not ten[9] else written(ten)
        if body is None and row.moves:
            light.append(names.links[row.name])
            moment = heavy * drawn[row.name][0].radius ** 2
            moment = float(np.clip(2.0 * LEAST, tiny * moment, 1e3 * tiny * moment))
            body = np.array([tiny * heavy, 0, 0, 0, moment, 0, 0, moment, 0, moment])
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
                row, names.links[row.name], names.joints[row.name], names.links[row.antecedent],
                row_pose(row, values), values[row.variable] if row.moves else 0.0,
                np.array([0.0, 0.0, sense(row, symbols) if row.moves else 1.0]), body, drive,
                {names.joints[name[1:]]: c for name, c in leaders.items()},
                form.constant if form else 0.0, drawn[row.name],
            )
        )  # fmt: skip
    if light:
        who = "SDF refuses" if moment < LEAST else "MuJoCo and SDF refuse"
        still = "; it is too small for MuJoCo" if moment < LEAST else ""
        notes.append(
            f"{', '.join(light)}: no body, and {tiny:g} of the mass of all is written, for {who} "
            f"a moving link without mass{still}"
        )
    return found


Number = float | np.ndarray


def _node(tag: str, *children: ET.Element | str | Number, **attributes: str | Number) -> ET.Element:
    """An element; of numbers and texts among the children its text."""
    made = ET.Element(tag, {key: _written(value) for key, value in attributes.items()})
    for child in children:
        if isinstance(child, ET.Element):
            made.append(child)
        else:
            made.text = _written(child)
    return made


def _written(value: str | Number) -> str:
    return value if isinstance(value, str) else numbers(np.ravel(value))


def _upright(gravity: np.ndarray) -> np.ndarray:
    """(3, 3) axes of frame 0 in a world whose gravity points along -z."""
    size = float(np.linalg.norm(gravity))
    down = gravity / size if size else np.array([0.0, 0.0, -1.0])
    axis = np.cross(down, [0.0, 0.0, -1.0])
    sine = float(np.linalg.norm(axis))
    if sine < 1e-12:
        return np.eye(3) if down[2] < 0.0 else turned(np.array([1.0, 0.0, 0.0]), np.pi)
    return turned(axis / sine, float(np.arctan2(sine, -down[2])))


def _limits(physics: Physics, row: Joint) -> dict[str, float]:
    limits = physics.robot.limits.get(row.name)
    if limits is None:
        far = {"lower": -_FAR, "upper": _FAR, "velocity": _FAR}
        return far if row.kind is JointKind.PRISMATIC else {}
    return {"lower": limits.lower, "upper": limits.upper, "velocity": limits.speed}


def _along(capsule: Capsule) -> Pose:
    """The middle of a capsule, z along it."""
    middle = 0.5 * (capsule.start + capsule.end)
    return Pose(middle, _upright(-capsule.way).T if capsule.length else np.eye(3))


# URDF.


def _urdf(physics: Physics, parts: list[Part], names: Names) -> ET.Element:
    root, lift = _node("robot", name=physics.robot.name), _upright(gravity_of(physics.robot))
    if not np.allclose(lift, np.eye(3), atol=1e-12):
        ends = _node("parent", link="world"), _node("child", link=names.links[BASE])
        upright = _origin(Pose(np.zeros(3), lift)), *ends
        root.append(_node("link", name="world"))
        root.append(_node("joint", *upright, name=names.upright, type="fixed"))
    root.append(_node("link", name=names.links[BASE]))
    for part in parts:
        moves, link = part.row.moves, _node("link", name=part.link)
        if part.body is not None:
            tensor = _node("inertia", **dict(zip(TENSOR, part.body[4:], strict=True)))
            mass = _node("mass", value=part.body[0])
            link.append(_node("inertial", _origin(Pose(part.body[1:4])), mass, tensor))
        link.extend(shape for capsule in part.drawn if moves for shape in _visuals(capsule))
        limits = _limits(physics, part.row) if moves else {}
        kind = "prismatic" if part.row.kind is JointKind.PRISMATIC else "revolute"
        kind = "fixed" if not moves else kind if limits else "continuous"
        ends = _node("parent", link=part.parent), _node("child", link=part.link)
        joint = _node("joint", _origin(part.pose), *ends, name=part.joint, type=kind)
        if moves:
            joint.append(_node("axis", xyz=part.axis))
        if limits:
            joint.append(_node("limit", **limits, effort=_EFFORT))
        if part.drive:
            joint.append(_node("dynamics", **part.drive))
        for leader, ratio in part.leaders.items():
            joint.append(_node("mimic", joint=leader, multiplier=ratio, offset=part.offset))
        root.extend([link, joint])
    return root


def _origin(pose: Pose) -> ET.Element:
    return _node("origin", xyz=pose.position, rpy=np.array(roll_pitch_yaw(pose.rotation)))


def _visuals(capsule: Capsule) -> Iterator[ET.Element]:
    def shape(pose: Pose, tag: str, **sizes: float) -> ET.Element:
        return _node("visual", _origin(pose), _node("geometry", _node(tag, **sizes)))

    yield shape(Pose(capsule.start), "sphere", radius=capsule.radius)
    if capsule.length:
        yield shape(Pose(capsule.end), "sphere", radius=capsule.radius)
        sizes = {"radius": capsule.radius, "length": capsule.length}
        yield shape(_along(capsule), "cylinder", **sizes)


# MJCF.


def _mjcf(physics: Physics, parts: list[Part], names: Names) -> ET.Element:
    robot, base = physics.robot, _node("body", name=names.links[BASE])
    bodies, zero = {names.links[BASE]: base}, {part.joint: part.zero for part in parts}
    equality, tendons, motors = (ET.Element(x) for x in ("equality", "tendon", "actuator"))
    for part in parts:
        place = {"pos": part.pose.position, "euler": np.array(roll_pitch_yaw(part.pose.rotation))}
        bodies[part.link] = body = _node("body", name=part.link, **place)
        bodies[part.parent].append(body)
        if not part.row.moves:
            continue
        assert part.body is not None
        full = part.body[[4, 7, 9, 5, 6, 8]]
        body.append(_node("inertial", pos=part.body[1:4], mass=part.body[0], fullinertia=full))
        keys = {"friction": "frictionloss", "rest": "springref"}
        more: dict[str, Number] = {keys.get(q, q): x for q, x in part.drive.items()}
        if limits := robot.limits.get(part.row.name):
            more["range"] = np.array([limits.lower, limits.upper])
        more |= {"ref": part.zero} if part.zero else {}
        kind = "slide" if part.row.kind is JointKind.PRISMATIC else "hinge"
        body.append(_node("joint", name=part.joint, type=kind, axis=part.axis, **more))
        for capsule in part.drawn:
            shape: dict[str, str | Number] = {"type": "sphere", "size": capsule.radius}
            if capsule.start.any():
                shape["pos"] = capsule.start
            if capsule.length:
                way = np.concatenate([capsule.start, capsule.end])
                shape = {"type": "capsule", "size": capsule.radius, "fromto": way}
            body.append(_node("geom", **shape, mass=0.0, contype="0", conaffinity="0"))
        if part.leaders:
            _follow(part, zero, equality, tendons)
        elif part.row.actuated or part.row.name in robot.relations:
            motors.append(_node("motor", name=part.joint, joint=part.joint))
    for loop in robot.loops:
        ends = {"body1": names.links[loop.frame], "body2": names.links[loop.meets]}
        if loop.kind == "rigid":
            equality.append(_node("weld", **ends))
            continue
        size = parts[0].drawn[0].radius  # a second point of the axis
        for z in (0.0, size) if loop.kind == "revolute" else (0.0,):
            equality.append(_node("connect", anchor=np.array([0.0, 0.0, z]), **ends))
    further = [element for element in (tendons, equality, motors) if len(element)]
    option = _node("option", gravity=gravity_of(physics.robot))
    head = _node("compiler", angle="radian", eulerseq="XYZ"), option, _node("worldbody", base)
    return _node("mujoco", *head, *further, model=robot.name)


def _follow(
    part: Part, zero: Mapping[str, float], equality: ET.Element, tendons: ET.Element
) -> None:
    """q = offset + sum ratio q_leader; MuJoCo counts from the positions of `ref`."""
    if len(part.leaders) == 1:
        ((leader, ratio),) = part.leaders.items()
        line = np.array([part.offset + ratio * zero[leader] - part.zero, ratio, 0, 0, 0])
        equality.append(_node("joint", joint1=part.joint, joint2=leader, polycoef=line))
        return
    name, shares = f"{part.joint}_follows", {part.joint: -1.0, **part.leaders}
    joints = [_node("joint", joint=joint, coef=ratio) for joint, ratio in shares.items()]
    tendons.append(_node("fixed", *joints, name=name))
    equality.append(_node("tendon", tendon1=name, polycoef="0 1 0 0 0"))


# SDF.


def _sdf(physics: Physics, parts: list[Part], names: Names) -> ET.Element:
    lift = Pose(np.zeros(3), _upright(gravity_of(physics.robot)))
    base, keys = names.links[BASE], {"stiffness": "spring_stiffness", "rest": "spring_reference"}
    ends = _node("parent", "world"), _node("child", base)
    model = _node(
        "model", _node("link", _pose(lift), name=base),
        _node("joint", *ends, name=names.upright, type="fixed"), name=physics.robot.name,
    )  # fmt: skip
    for part in parts:
        if part.body is None or not part.row.moves:
            there = {"name": part.link, "attached_to": part.parent}
            model.append(_node("frame", _pose(part.pose), **there))
            continue
        entries = (_node(k, x) for k, x in zip(TENSOR, part.body[4:], strict=True))
        mass, tensor = _node("mass", part.body[0]), _node("inertia", *entries)
        link = _node("link", _pose(part.pose, relative_to=part.parent), name=part.link)
        link.append(_node("inertial", _pose(Pose(part.body[1:4])), mass, tensor))
        for k, capsule in enumerate(part.drawn):
            sizes = {"radius": capsule.radius} | (
                {"length": capsule.length} if capsule.length else {}
            )
            shape = _node("capsule" if capsule.length else "sphere", *_texts(sizes))
            visual = _pose(_along(capsule)), _node("geometry", shape)
            link.append(_node("visual", *visual, name=f"capsule{k}"))
        axis = _node("axis", _node("xyz", part.axis))
        if limits := _limits(physics, part.row):
            axis.append(_node("limit", *_texts(limits)))
        if part.drive:
            drive = {keys.get(quantity, quantity): x for quantity, x in part.drive.items()}
            axis.append(_node("dynamics", *_texts(drive)))
        for leader, ratio in part.leaders.items():
            law = {"multiplier": ratio, "offset": part.offset, "reference": 0.0}
            axis.append(_node("mimic", *_texts(law), joint=leader))
        kind = "prismatic" if part.row.kind is JointKind.PRISMATIC else "revolute"
        ends = _node("parent", part.parent), _node("child", part.link)
        model.extend([link, _node("joint", *ends, axis, name=part.joint, type=kind)])
    return _node("sdf", model, version="1.9")


def _texts(values: Mapping[str, float]) -> list[ET.Element]:
    return [_node(key, value) for key, value in values.items()]


def _pose(pose: Pose, **attributes: str) -> ET.Element:
    place = np.array([*pose.position, *roll_pitch_yaw(pose.rotation)])
    return _node("pose", place, **attributes)
