"""The file that is written anew: its links on the rows of the robot, and that it is that robot."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import read_file
from modeler.estimation import parameters_of, pseudo_inertia_of
from modeler.exports.bodies import Original, carried
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
        carrier: that which gets the change.
    """

    poses: Mapping[str, Pose]
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
        inertial, tensor = first(link, "inertial"), np.zeros((3, 3))
        tensor[np.triu_indices(3)] = numbers
        body = None
        if inertial is not None:
            mass = float(text_at(inertial, "mass") or 1.0)
            tensor = tensor + np.triu(tensor, 1).T
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
    if robot.frames:
        symbols = robot.symbol_values()
        on = {name: (frame.row, frame_pose(frame, symbols)) for name, frame in robot.frames.items()}
        moved = {frame.row: name for name, frame in robot.frames.items() if frame.joint}
        _check_names(source, robot, on)
        if source.tree is not None:
            _check_tree(source, source.tree, robot, on)
        else:
            _check_sdf(source, robot, on)
    else:
        on, moved = _matched(source, robot)
    found: dict[str, dict[str, Pose]] = {}
    for name, (row, pose) in on.items():
        if name in source.links:
            found.setdefault(row, {})[name] = pose
    links = {
        row: Placed(own, _carrier(source, own, moved.get(row, "")))
        for row, own in found.items()
        if row != BASE
    }
    if source.tree is None:
        joints = {robot.frames[name].joint: row for row, name in moved.items()}
        return Placement(links, joints, ())
    row_of = {name: row for row, name in moved.items()}
    joints = {j.name: row_of[j.child] for j in source.tree.joints if j.child in row_of}
    _check_ties(source, source.tree, robot, joints)
    return Placement(links, joints, tuple(_gravity_told(source, source.tree, robot, on)))


def _check_ties(source: Source, tree: BodyTree, robot: Robot, joints: Mapping[str, str]) -> None:
    """Joints follow each other as in [relations], those that motors couple aside."""
    rng = np.random.default_rng(0)
    values = variables(robot, {joint.name: rng.uniform(-1.0, 1.0) for joint in robot.moving})
    of_motors = {f"q{motor}" for motor in robot.motors}
    for joint in tree.joints:
        row, leader = joints.get(joint.name), joints.get(joint.leader)
        relation = robot.relations.get(row or "")
        if row is None or (relation is not None and relation.names & of_motors):
            continue
        if leader and relation is None:
            what = f"follows {joint.leader} there, and is free"
        elif relation is not None and not joint.leader:
            what = "is free there, and follows"
        elif (
            leader
            and abs(joint.ratio * values[f"q{leader}"] + joint.offset - values[f"q{row}"]) > _SAME
        ):
            what = f"follows {joint.leader} otherwise"
        else:
            continue
        raise _differs(source, robot, f"joint {joint.name} {what} in the robot (row {row})")


def _gravity_told(
    source: Source, tree: BodyTree, robot: Robot, on: Mapping[str, tuple[str, Pose]]
) -> Iterator[str]:
    """Tells of another gravity in the file, in the frame 0 of the robot."""
    at = {tree.root: Pose()}
    for joint in tree.joints:
        at[joint.child] = at[joint.parent] @ joint.at(0.0)
    base = next((name for name, (row, _) in on.items() if row == BASE and name in at), None)
    if base is None:
        return
    here = gravity_of(robot)
    there = on[base][1].rotation @ at[base].rotation.T @ tree.gravity + 0.0
    if source.format == "urdf":  # which states none, and is stood upright
        there *= np.linalg.norm(here) / np.linalg.norm(there)
    if np.abs(there - here).max() > SAME_GRAVITY * np.abs([there, here]).max():
        one, other = (", ".join(f"{x:.4g}" for x in g) for g in (there, here))
        yield (
            f"gravity is [{one}] m/s2 in {source.path.name} and [{other}] in the robot, in frame "
            "0: torques differ; mend the one that is wrong (of URDF the robot's, or how it stands)"
        )


def _rows(robot: Robot) -> list[str]:
    return [joint.name for joint in robot.moving if joint.name not in robot.motors]


def _carrier(source: Source, own: Mapping[str, Pose], moved: str) -> str:
    """The link that the joint moves, or the heaviest that moves with it where that has no mass."""
    mass = {name: body.mass for name in own if (body := source.links[name]) is not None}
    if moved in own and (mass.get(moved, 0.0) > 0.0 or not any(mass.values())):
        return moved
    return max(mass, key=lambda name: mass[name]) if mass else next(iter(own))


def original_of(source: Source, links: Mapping[str, Placed]) -> Original:
    """What the file says of the links, on their rows."""
    whole, hung = {}, {}
    for row, own in links.items():
        tens = {
            name: carried(about_origin(body), pose)
            for name, pose in own.poses.items()
            if (body := source.links[name]) is not None
        }
        if tens:
            whole[row] = np.sum(list(tens.values()), axis=0)
        others = [ten for name, ten in tens.items() if name != own.carrier]
        if others:
            hung[row] = np.sum(others, axis=0)
    return Original(whole, hung)


def _differs(source: Source, robot: Robot, what: str) -> DataError:
    return DataError(
        f"--like {source.path}: is not the robot {robot.name}: {what}; give the file that it was "
        "converted from, or leave out --like"
    )


def _check_names(source: Source, robot: Robot, on: Mapping[str, tuple[str, Pose]]) -> None:
    missing = [name for name in on if name not in source.links]
    if source.format in ("sdf", "mjcf"):  # fixed joints may be lumped there, the first be the world
        moved = {name for name, frame in robot.frames.items() if frame.joint}
        missing = [name for name in missing if name in moved]
    if missing:
        raise _differs(
            source, robot, f"it has no link {missing[0]}{near(missing[0], list(source.links))}"
        )


def _check_tree(
    source: Source, tree: BodyTree, robot: Robot, on: Mapping[str, tuple[str, Pose]]
) -> None:
    """Every joint places its child as the table does, at random postures."""
    rng = np.random.default_rng(0)
    for _ in range(_POSTURES):
        q = {joint.name: rng.uniform(-1.0, 1.0) for joint in robot.moving}
        at, values = poses(robot, q), variables(robot, q)
        for joint in tree.joints:
            if joint.parent not in on or joint.child not in on:
                continue
            row, own = on[joint.child]
            frame = robot.frames[joint.child]
            if joint.kind is not JointKind.FIXED and not frame.joint:
                continue  # one that was locked
            (before, there) = on[joint.parent]
            ours = (at[before] @ there).inverse() @ at[row] @ own
            theirs = joint.at(values[f"q{row}"] if joint.kind is not JointKind.FIXED else 0.0)
            if not _alike(ours, theirs):
                raise _differs(
                    source, robot, f"link {joint.child} is placed otherwise on {joint.parent}"
                )


def _check_sdf(source: Source, robot: Robot, on: Mapping[str, tuple[str, Pose]]) -> None:
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


def _matched(source: Source, robot: Robot) -> tuple[dict[str, tuple[str, Pose]], dict[str, str]]:
    """Links of a file on the rows of a table that does not name them: joint for joint, in order."""
    if source.tree is None:
        raise _differs(source, robot, "the robot file has no [frames], and SDF is matched by names")
    links, rows = moving_links(source.tree), _rows(robot)
    if len(links) - 1 != len(rows):
        raise _differs(
            source, robot, f"it has {len(links) - 1} moving joints, and the table {len(rows)}"
        )
    for base in links[0].bodies.values():  # any of them may be frame 0
        seen = dict[int, Pose]()
        rng, wrong = np.random.default_rng(0), ""
        for _ in range(_POSTURES):
            q = {row: rng.uniform(-1.0, 1.0) for row in rows}
            at, values, own = poses(robot, q), variables(robot, q), [base.inverse()]
            for link, row in zip(links[1:], rows, strict=True):
                assert link.joint is not None
                step = link.joint.pose.inverse() @ link.joint.at(values[f"q{row}"])
                own.append(own[link.parent] @ link.pose @ step)
                there = at[row].inverse() @ own[-1]
                if not wrong and not _alike(seen.setdefault(len(own) - 2, there), there):
                    wrong = f"joint {link.joint.name} moves otherwise than row {row}"
        if not wrong:
            break
    if wrong:
        raise _differs(source, robot, wrong)
    on = {name: (BASE, pose) for name, pose in links[0].bodies.items()}
    moved = {}
    for k, link in enumerate(links[1:]):
        assert link.joint is not None
        on |= {name: (rows[k], seen[k] @ pose) for name, pose in link.bodies.items()}
        moved[rows[k]] = link.joint.child
    return on, moved


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
