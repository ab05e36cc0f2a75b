"""The file that is written anew: its links on the rows of the robot, and that it is that robot."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import read_file
from modeler.estimation import parameters_of, pseudo_inertia_of
from modeler.exports.bodies import Original, carried, symmetric
from modeler.exports.linkage import (
    BASE,
    SAME_GRAVITY,
    frame_pose,
    from_rpy,
    gravity_of,
    poses,
    variables,
)
from modeler.robot import (
    BodyTree,
    Element,
    Inertial,
    JointKind,
    Pose,
    Robot,
    about_origin,
    mjcf_tree,
    moving_links,
    near,
    parse_xml,
    rotation_matrix,
    urdf_tree,
)

FORMATS = {"robot": "urdf", "mujoco": "mjcf", "sdf": "sdf"}
"""Of a file, by its outermost element."""

TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")

_SAME = 1e-4  # m, rad: rounded angles of a file are exact in the robot file
_POSTURES = 5


@dataclass(frozen=True, eq=False)
class Source:
    """A file.

    Attributes:
        path: where it is.
        data: its bytes.
        root: its outermost element.
        format: "urdf", "mjcf" or "sdf".
        tree: its robot; None of SDF.
        links: bodies by name, in their frames; None for those that state nothing.
    """

    path: Path
    data: bytes
    root: Element
    format: str
    tree: BodyTree | None
    links: Mapping[str, Inertial | None]


@dataclass(frozen=True, eq=False)
class Placed:
    """Links of a file that move with one row.

    Attributes:
        poses: of their frames on the row, by name.
        tens: by name, (10,) of those that state a body, in the frame of the row.
        carrier: that which gets the change.
    """

    poses: Mapping[str, Pose]
    tens: Mapping[str, np.ndarray]
    carrier: str


def source_of(path: Path) -> Source:
    """Read the original.

    Raises:
        DataError: no such file, or none of the formats.
        RobotError: a mistake in it.
    """
    try:
        data = read_file(path)
    except OSError as error:
        raise DataError(f"--like {path}: cannot be read ({error.strerror})") from None
    root = parse_xml(data, str(path))
    if root.tag not in FORMATS:
        raise DataError(
            f"--like {path}: got <{root.tag[:40]}>; expected <robot> (URDF), <mujoco> (MJCF) or "
            "<sdf>"
        )
    kind = FORMATS[root.tag]
    if kind == "sdf":
        return Source(path, data, root, kind, None, _sdf_links(root))
    tree = urdf_tree(data, str(path)) if kind == "urdf" else mjcf_tree(path)
    return Source(path, data, root, kind, tree, tree.bodies)


def first(element: Element, tag: str) -> Element | None:
    """Its first child of that tag."""
    return next(iter(element.named(tag)), None)


def text_at(element: Element, path: str) -> str:
    """The text, or behind @ the attribute, at a path of elements; "" without."""
    way, _, attribute = path.partition("@")
    for tag in way.split("/") if way else ():
        child = first(element, tag)
        if child is None:
            return ""
        element = child
    return element.attributes.get(attribute, "") if attribute else element.text


def inertial_axes(source: Source, link: Element | None) -> np.ndarray | None:
    """(3, 3) along which the inertia of a link is written; None: along those of its frame."""
    paths = {"urdf": "inertial/origin@rpy", "sdf": "inertial/pose"}
    if link is None or source.format not in paths:
        return None
    if quaternion := text_at(link, "inertial/origin@quat_xyzw"):
        return rotation_matrix(np.roll([float(word) for word in quaternion.split()], 1))
    angles = text_at(link, paths[source.format]).split()[-3:]
    return from_rpy([float(word) for word in angles]) if angles else None


def _sdf_pose(element: Element) -> Pose:
    """`<pose>` of an element: x y z roll pitch yaw."""
    words = [float(word) for word in text_at(element, "pose").split()] or [0.0] * 6
    return Pose(np.array(words[:3]), from_rpy(words[3:]))


def _sdf_links(root: Element) -> dict[str, Inertial | None]:
    found: dict[str, Inertial | None] = {}
    for link in (element for element in root.walk() if element.tag == "link"):
        texts = [text_at(link, f"inertial/inertia/{key}") for key in TENSOR]
        numbers = [float(t or (k[1] == k[2])) for t, k in zip(texts, TENSOR, strict=True)]
        body, inertial = None, first(link, "inertial")
        if inertial is not None:
            mass, tensor = float(text_at(inertial, "mass") or 1.0), symmetric(np.array(numbers))
            body = Inertial(mass, np.zeros(3), tensor).seen_from(_sdf_pose(inertial))
        found[link.attributes.get("name", "")] = body
    return found


@dataclass(frozen=True, eq=False)
class Placement:
    """The parts of a file on the rows of a robot.

    Attributes:
        links: that move, by row.
        joints: row by the name in the file.
        notes: what is to be told.
    """

    links: Mapping[str, Placed]
    joints: Mapping[str, str]
    notes: tuple[str, ...]


def placed(source: Source, robot: Robot) -> Placement:
    """The links and joints of the file by row.

    Raises:
        DataError: it is not the same robot: names the first link that differs.
    """
    if source.tree is None:
        on = _by_frames(source, robot)
        _check_sdf(source, robot, on)
    else:
        on = _by_frames(source, robot) if robot.frames else _by_order(source, source.tree, robot)
    moved = {frame.row: name for name, frame in robot.frames.items() if frame.joint}
    if source.tree is None:
        joints, notes = {robot.frames[name].joint: row for row, name in moved.items()}, list[str]()
    else:
        joints = _joint_rows(source.tree, robot)
        _check_tree(source, source.tree, robot, on, joints)
        _check_ties(source, source.tree, robot, joints)
        notes = list(_gravity_told(source, source.tree, robot, on))
        moved = moved or {joints[j.name]: j.child for j in source.tree.joints if j.name in joints}
    found: dict[str, dict[str, Pose]] = {}
    for name, (row, pose) in on.items():
        if name in source.links and row != BASE:
            found.setdefault(row, {})[name] = pose
    links = {row: _placed(source, own, moved.get(row, "")) for row, own in found.items()}
    return Placement(links, joints, tuple(notes))


def _placed(source: Source, poses: Mapping[str, Pose], moved: str) -> Placed:
    """The change is on the link that the joint moves; where that has no mass, on the heaviest."""
    tens = {
        name: carried(about_origin(body), pose)
        for name, pose in poses.items()
        if (body := source.links[name]) is not None
    }
    mass = {name: float(ten[9]) for name, ten in tens.items()}
    if moved in poses and (mass.get(moved, 0.0) > 0.0 or not any(mass.values())):
        return Placed(poses, tens, moved)
    return Placed(
        poses, tens, max(mass, key=lambda name: mass[name]) if mass else next(iter(poses))
    )


def original_of(links: Mapping[str, Placed]) -> Original:
    """What the file says of the links, on their rows."""
    whole = {row: np.sum(list(own.tens.values()), axis=0) for row, own in links.items() if own.tens}
    others = {row: [ten for name, ten in own.tens.items() if name != own.carrier]
              for row, own in links.items()}  # fmt: skip
    return Original(whole, {row: np.sum(tens, axis=0) for row, tens in others.items() if tens})


def _differs(source: Source, robot: Robot, what: str) -> DataError:
    return DataError(
        f"--like {source.path}: is not the robot {robot.name}: {what}; give the file that it was "
        "converted from, or leave out --like"
    )


Links = Mapping[str, tuple[str, Pose]]
"""By name: the row of a link, and the pose of its frame on it."""


def _by_frames(source: Source, robot: Robot) -> Links:
    """As [frames] of the robot file has them."""
    if not robot.frames:
        raise _differs(source, robot, "the robot file has no [frames], and SDF is matched by names")
    symbols = robot.symbol_values()
    missing = [name for name in robot.frames if name not in source.links]
    if source.format in ("sdf", "mjcf"):  # fixed joints may be lumped there, the first be the world
        missing = [name for name in missing if robot.frames[name].joint]
    if missing:
        raise _differs(
            source, robot, f"it has no link {missing[0]}{near(missing[0], list(source.links))}"
        )
    return {name: (frame.row, frame_pose(frame, symbols)) for name, frame in robot.frames.items()}


def _by_order(source: Source, tree: BodyTree, robot: Robot) -> Links:
    """Links on the rows of a table that does not name them: joint for joint, as they are at 0."""
    links, rows = moving_links(tree), [BASE, *_rows(robot)]
    if len(links) != len(rows):
        raise _differs(
            source, robot, f"it has {len(links) - 1} moving joints, and the table {len(rows) - 1}"
        )
    joints, at, values = _joint_rows(tree, robot), poses(robot, {}), variables(robot, {})
    there = _stands(tree, {name: values[f"q{row}"] for name, row in joints.items()})
    row_of = {name: row for link, row in zip(links, rows, strict=True) for name in link.bodies}
    wrong = None
    for base in links[0].bodies.values():  # any of them may be frame 0
        on = {name: (row, at[row].inverse() @ base.inverse() @ there[name])
              for name, row in row_of.items()}  # fmt: skip
        try:
            _check_tree(source, tree, robot, on, joints)
        except DataError as error:
            wrong = wrong or error
        else:
            return on
    assert wrong is not None
    raise wrong


def _joint_rows(tree: BodyTree, robot: Robot) -> dict[str, str]:
    """Row by the name of the joint in the file; none of joints that were locked."""
    if robot.frames:
        rows = {name: frame.row for name, frame in robot.frames.items() if frame.joint}
        return {joint.name: rows[joint.child] for joint in tree.joints if joint.child in rows}
    names = [link.joint.name for link in moving_links(tree) if link.joint]
    return dict(zip(names, _rows(robot), strict=True))


def _rows(robot: Robot) -> list[str]:
    return [joint.name for joint in robot.moving if joint.name not in robot.motors]


def _stands(tree: BodyTree, q: Mapping[str, float]) -> dict[str, Pose]:
    """Poses of the bodies in the first, by name; joints that are left out stand at 0."""
    at = {tree.root: Pose()}
    for joint in tree.joints:
        at[joint.child] = at[joint.parent] @ joint.at(q.get(joint.name, 0.0))
    return at


def _check_tree(
    source: Source, tree: BodyTree, robot: Robot, on: Links, joints: Mapping[str, str]
) -> None:
    """Every joint places its child as the table does, at random postures."""
    rng = np.random.default_rng(0)
    for _ in range(_POSTURES):
        q = {joint.name: rng.uniform(-1.0, 1.0) for joint in robot.moving}
        at, values = poses(robot, q), variables(robot, q)
        for joint in tree.joints:
            row, fixed = joints.get(joint.name, ""), joint.kind is JointKind.FIXED
            if joint.parent not in on or joint.child not in on or not (row or fixed):
                continue
            (before, there), (after, own) = on[joint.parent], on[joint.child]
            ours = (at[before] @ there).inverse() @ at[after] @ own
            if not _alike(ours, joint.at(0.0 if fixed else values[f"q{row}"])):
                raise _differs(
                    source, robot, f"link {joint.child} is placed otherwise on {joint.parent}"
                )


def _check_ties(source: Source, tree: BodyTree, robot: Robot, joints: Mapping[str, str]) -> None:
    """Joints follow each other as in [relations], those that motors couple aside."""
    rng = np.random.default_rng(0)
    values = variables(robot, {joint.name: rng.uniform(-1.0, 1.0) for joint in robot.moving})
    of_motors = {f"q{motor}" for motor in robot.motors}
    for joint in tree.joints:
        row, leader = joints.get(joint.name, ""), joints.get(joint.leader)
        relation = robot.relations.get(row)
        if not row or (relation is not None and relation.names & of_motors):
            continue
        led = joint.ratio * values[f"q{leader}"] + joint.offset if leader else 0.0
        if leader and relation is None:
            what = f"follows {joint.leader} there, and is free"
        elif relation is not None and not joint.leader:
            what = "is free there, and follows"
        elif leader and abs(led - values[f"q{row}"]) > _SAME:
            what = f"follows {joint.leader} otherwise"
        else:
            continue
        raise _differs(source, robot, f"joint {joint.name} {what} in the robot (row {row})")


def _gravity_told(source: Source, tree: BodyTree, robot: Robot, on: Links) -> Iterator[str]:
    """Tells of another gravity in the file, in the frame 0 of the robot."""
    at, here = _stands(tree, {}), gravity_of(robot)
    base = next((name for name, (row, _) in on.items() if row == BASE and name in at), None)
    if base is None:
        return
    there = on[base][1].rotation @ at[base].rotation.T @ tree.gravity + 0.0
    if source.format == "urdf":  # which states none, and is stood upright
        there *= np.linalg.norm(here) / np.linalg.norm(there)
    if np.abs(there - here).max() > SAME_GRAVITY * np.abs([there, here]).max():
        one, other = (", ".join(f"{x:.4g}" for x in g) for g in (there, here))
        yield (
            f"gravity is [{one}] m/s2 in {source.path.name} and [{other}] in the robot, in frame "
            "0: torques differ; mend the one that is wrong (of URDF the robot's, or how it stands)"
        )


def _check_sdf(source: Source, robot: Robot, on: Links) -> None:
    """Links are placed on the first as the table has them at 0, as far as their poses are plain."""
    at, reference = poses(robot, {}), None
    for link in (element for element in source.root.walk() if element.tag == "link"):
        name, pose = link.attributes.get("name", ""), first(link, "pose")
        if name not in on or (pose is not None and pose.attributes.get("relative_to")):
            continue
        row, own = on[name]
        base = _sdf_pose(link) @ (at[row] @ own).inverse()
        reference = reference or base
        if not _alike(reference, base):
            raise _differs(source, robot, f"link {name} stands elsewhere at 0")


def _alike(one: Pose, other: Pose) -> bool:
    apart = np.abs(one.position - other.position).max()
    return max(float(apart), float(np.abs(one.rotation - other.rotation).max())) < _SAME


def shared_out(bodies: Mapping[str, np.ndarray], whole: np.ndarray) -> dict[str, np.ndarray]:
    """Bodies that hang together, changed alike so that they come to a given whole.

    With P' = A P A^T of the wholes, every part becomes A P_k A^T: they add up, and what could be
    built can be built. A is the symmetric one (optimal transport of normal distributions).

    Args:
        bodies: by name, (10,) in one frame.
        whole: (10,) that they shall be together.
    """
    size = np.sqrt(np.maximum(np.diag(pseudo_inertia_of(whole)), 1e-300))
    across = np.outer(size, size)
    old = pseudo_inertia_of(np.sum(list(bodies.values()), axis=0)) / across
    root = _root(old)
    inverse = np.linalg.inv(root)
    A = inverse @ _root(root @ (pseudo_inertia_of(whole) / across) @ root) @ inverse
    return {
        name: parameters_of((A @ (pseudo_inertia_of(ten) / across) @ A.T) * across)
        for name, ten in bodies.items()
    }


def _root(matrix: np.ndarray) -> np.ndarray:
    values, vectors = np.linalg.eigh(matrix)
    return np.asarray((vectors * np.sqrt(np.maximum(values, 1e-14 * values[-1]))) @ vectors.T)
