"""The file that is written anew: its links on the rows of the robot, and that it is that robot."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import read_file
from modeler.estimation import compute_pseudo_inertia, extract_parameters
from modeler.formats.bodies import Original, build_symmetric_matrix, express_parameters
from modeler.formats.body_tree import (
    BodyTree,
    Inertial,
    Pose,
    collect_moving_links,
    compute_quaternion_rotation,
    compute_standard_parameters,
)
from modeler.formats.linkage import (
    BASE,
    compute_frame_pose,
    compute_gravity,
    compute_row_poses,
    compute_rpy_rotation,
    evaluate_variables,
)
from modeler.formats.mjcf import read_mjcf_tree
from modeler.formats.thresholds import THRESHOLDS
from modeler.formats.urdf import read_urdf_tree
from modeler.formats.xml_source import Element, parse_xml
from modeler.robot import JointKind, Robot, suggest_name

FORMATS = {"robot": "urdf", "mujoco": "mjcf", "sdf": "sdf"}
"""Of a file, by its outermost element."""

TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


@dataclass(frozen=True, eq=False)
class OriginalFile:
    """A robot file of another program, as it is.

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
class PlacedLinks:
    """Links of a file that move with one row.

    Attributes:
        poses: of their frames on the row, by name.
        tens: by name, (10,) of those that state a body, in the frame of the row.
        carrier: that which gets the change.
    """

    poses: Mapping[str, Pose]
    parameters: Mapping[str, np.ndarray]
    carrier: str


def read_original(path: Path) -> OriginalFile:
    """Reads the original.

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
        got = f"got <{root.tag[:40]}>; expected <robot> (URDF), <mujoco> (MJCF) or <sdf>"
        raise DataError(f"--like {path}: {got}")
    kind = FORMATS[root.tag]
    if kind == "sdf":
        return OriginalFile(path, data, root, kind, None, _read_sdf_links(root))
    tree = read_urdf_tree(data, str(path)) if kind == "urdf" else read_mjcf_tree(path)
    return OriginalFile(path, data, root, kind, tree, tree.bodies)


def find_first_child(element: Element, tag: str) -> Element | None:
    """Returns the first child of an element with that tag, or None."""
    return next(iter(element.find_children(tag)), None)


def get_text_at(element: Element, path: str) -> str:
    """Returns the text, or behind @ the attribute, at a path of elements; "" without."""
    element_path, _, attribute = path.partition("@")
    for tag in element_path.split("/") if element_path else ():
        child = find_first_child(element, tag)
        if child is None:
            return ""
        element = child
    return element.attributes.get(attribute, "") if attribute else element.text


def find_inertial_axes(source: OriginalFile, link: Element | None) -> np.ndarray | None:
    """Returns the (3, 3) axes of the stated inertia of a link; None: those of its frame."""
    paths = {"urdf": "inertial/origin@rpy", "sdf": "inertial/pose"}
    if link is None or source.format not in paths:
        return None
    if quaternion := get_text_at(link, "inertial/origin@quat_xyzw"):
        return compute_quaternion_rotation(np.roll([float(word) for word in quaternion.split()], 1))
    angles = get_text_at(link, paths[source.format]).split()[-3:]
    return compute_rpy_rotation([float(word) for word in angles]) if angles else None


def _read_sdf_pose(element: Element) -> Pose:
    """`<pose>` of an element: x y z roll pitch yaw."""
    words = [float(word) for word in get_text_at(element, "pose").split()] or [0.0] * 6
    return Pose(np.array(words[:3]), compute_rpy_rotation(words[3:]))


def _read_sdf_links(root: Element) -> dict[str, Inertial | None]:
    links: dict[str, Inertial | None] = {}
    for link in (element for element in root.iterate_elements() if element.tag == "link"):
        texts = [get_text_at(link, f"inertial/inertia/{key}") for key in TENSOR]
        numbers = [float(t or (k[1] == k[2])) for t, k in zip(texts, TENSOR, strict=True)]
        body, inertial = None, find_first_child(link, "inertial")
        if inertial is not None:
            mass = float(get_text_at(inertial, "mass") or 1.0)
            tensor = build_symmetric_matrix(np.array(numbers))
            body = Inertial(mass, np.zeros(3), tensor).express_in(_read_sdf_pose(inertial))
        links[link.attributes.get("name", "")] = body
    return links


@dataclass(frozen=True, eq=False)
class Placement:
    """The parts of a file on the rows of a robot.

    Attributes:
        links: that move, by row.
        joints: row by the name in the file.
        notes: what is to be reported.
    """

    links: Mapping[str, PlacedLinks]
    joints: Mapping[str, str]
    notes: tuple[str, ...]


def assign_links(source: OriginalFile, robot: Robot) -> Placement:
    """Returns the links and joints of the file by row.

    Raises:
        DataError: it is not the same robot: names the first link that differs.
    """
    if source.tree is None:
        on = _locate_by_frames(source, robot)
        _check_sdf(source, robot, on)
    else:
        if robot.frames:
            on = _locate_by_frames(source, robot)
        else:
            on = _locate_by_order(source, source.tree, robot)
    moved_links = {frame.row: name for name, frame in robot.frames.items() if frame.joint}
    if source.tree is None:
        joints = {robot.frames[name].joint: row for row, name in moved_links.items()}
        notes = list[str]()
    else:
        joints = _find_joint_rows(source.tree, robot)
        _check_tree(source, source.tree, robot, on, joints)
        _check_ties(source, source.tree, robot, joints)
        notes = list(_compare_gravity(source, source.tree, robot, on))
        if not moved_links:
            tree_joints = [joint for joint in source.tree.joints if joint.name in joints]
            moved_links = {joints[joint.name]: joint.child for joint in tree_joints}
    poses_by_row: dict[str, dict[str, Pose]] = {}
    for name, (row, pose) in on.items():
        if name in source.links and row != BASE:
            poses_by_row.setdefault(row, {})[name] = pose
    links = {
        row: _choose_carrier(source, poses, moved_links.get(row, ""))
        for row, poses in poses_by_row.items()
    }
    return Placement(links, joints, tuple(notes))


def _choose_carrier(
    source: OriginalFile, poses: Mapping[str, Pose], moved_link: str
) -> PlacedLinks:
    """The change is on the link that the joint moves; where that has no mass, on the heaviest."""
    tens = {
        name: express_parameters(compute_standard_parameters(body), pose)
        for name, pose in poses.items()
        if (body := source.links[name]) is not None
    }
    mass = {name: float(ten[9]) for name, ten in tens.items()}
    if moved_link in poses and (mass.get(moved_link, 0.0) > 0.0 or not any(mass.values())):
        return PlacedLinks(poses, tens, moved_link)
    heaviest = max(mass, key=lambda name: mass[name]) if mass else next(iter(poses))
    return PlacedLinks(poses, tens, heaviest)


def collect_original(links: Mapping[str, PlacedLinks]) -> Original:
    """Returns what the file says of the links, on their rows."""
    whole = {
        row: np.sum(list(placed_links.parameters.values()), axis=0)
        for row, placed_links in links.items()
        if placed_links.parameters
    }
    others = {
        row: [ten for name, ten in placed_links.parameters.items() if name != placed_links.carrier]
        for row, placed_links in links.items()
    }
    return Original(whole, {row: np.sum(tens, axis=0) for row, tens in others.items() if tens})


def _build_mismatch(source: OriginalFile, robot: Robot, what: str) -> DataError:
    return DataError(
        f"--like {source.path}: is not the robot {robot.name}: {what}; give the file that it was "
        "converted from, or leave out --like"
    )


Links = Mapping[str, tuple[str, Pose]]
"""By name: the row of a link, and the pose of its frame on it."""
Rows = Mapping[str, str]
"""By the name of a joint in the file: its row."""


def _locate_by_frames(source: OriginalFile, robot: Robot) -> Links:
    """As [frames] of the robot file has them."""
    if not robot.frames:
        what = "the robot file has no [frames], and SDF is matched by names"
        raise _build_mismatch(source, robot, what)
    symbols = robot.evaluate_symbols()
    missing = [name for name in robot.frames if name not in source.links]
    if source.format in ("sdf", "mjcf"):  # fixed joints may be lumped there, the first be the world
        missing = [name for name in missing if robot.frames[name].joint]
    if missing:
        near = suggest_name(missing[0], list(source.links))
        raise _build_mismatch(source, robot, f"it has no link {missing[0]}{near}")
    frames = robot.frames.items()
    return {name: (frame.row, compute_frame_pose(frame, symbols)) for name, frame in frames}


def _locate_by_order(source: OriginalFile, tree: BodyTree, robot: Robot) -> Links:
    """Links on the rows of a table that does not name them: joint for joint, as they are at 0."""
    links, rows = collect_moving_links(tree), [BASE, *_collect_moving_rows(robot)]
    if len(links) != len(rows):
        counts = f"{len(links) - 1} moving joints, and the table {len(rows) - 1}"
        raise _build_mismatch(source, robot, f"it has {counts}")
    joints = _find_joint_rows(tree, robot)
    at = compute_row_poses(robot, {})
    values = evaluate_variables(robot, {})
    positions = {name: values[f"q{row}"] for name, row in joints.items()}
    body_poses = _compute_body_poses(tree, positions)
    row_of = {name: row for link, row in zip(links, rows, strict=True) for name in link.bodies}
    wrong = None
    for base in links[0].bodies.values():  # any of them may be frame 0
        back = {name: at[row].inverse() @ base.inverse() for name, row in row_of.items()}
        on = {name: (row, back[name] @ body_poses[name]) for name, row in row_of.items()}
        try:
            _check_tree(source, tree, robot, on, joints)
        except DataError as error:
            wrong = wrong or error
        else:
            return on
    assert wrong is not None
    raise wrong


def _find_joint_rows(tree: BodyTree, robot: Robot) -> dict[str, str]:
    """Row by the name of the joint in the file; none of joints that were locked."""
    if robot.frames:
        rows = {name: frame.row for name, frame in robot.frames.items() if frame.joint}
        return {joint.name: rows[joint.child] for joint in tree.joints if joint.child in rows}
    names = [link.joint.name for link in collect_moving_links(tree) if link.joint]
    return dict(zip(names, _collect_moving_rows(robot), strict=True))


def _collect_moving_rows(robot: Robot) -> list[str]:
    return [joint.name for joint in robot.moving_joints if joint.name not in robot.motors]


def _compute_body_poses(tree: BodyTree, q: Mapping[str, float]) -> dict[str, Pose]:
    """Poses of the bodies in the first, by name; joints that are left out stand at 0."""
    at = {tree.root: Pose()}
    for joint in tree.joints:
        at[joint.child] = at[joint.parent] @ joint.compute_pose(q.get(joint.name, 0.0))
    return at


def _check_tree(
    source: OriginalFile, tree: BodyTree, robot: Robot, on: Links, joints: Rows
) -> None:
    """Every joint places its child as the table does, at random postures."""
    rng = np.random.default_rng(0)
    for _ in range(THRESHOLDS.compared_postures):
        q = {joint.name: rng.uniform(-1.0, 1.0) for joint in robot.moving_joints}
        at, values = compute_row_poses(robot, q), evaluate_variables(robot, q)
        for joint in tree.joints:
            row, fixed = joints.get(joint.name, ""), joint.kind is JointKind.FIXED
            if joint.parent not in on or joint.child not in on or not (row or fixed):
                continue
            (before, parent_frame), (after, child_frame) = on[joint.parent], on[joint.child]
            ours = (at[before] @ parent_frame).inverse() @ at[after] @ child_frame
            if not _is_same_pose(ours, joint.compute_pose(0.0 if fixed else values[f"q{row}"])):
                what = f"link {joint.child} is placed otherwise on {joint.parent}"
                raise _build_mismatch(source, robot, what)


def _check_ties(source: OriginalFile, tree: BodyTree, robot: Robot, joints: Rows) -> None:
    """Joints follow each other as in [relations], those that motors couple aside."""
    rng = np.random.default_rng(0)
    q = {joint.name: rng.uniform(-1.0, 1.0) for joint in robot.moving_joints}
    values = evaluate_variables(robot, q)
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
        elif leader and abs(led - values[f"q{row}"]) > THRESHOLDS.max_pose_difference:
            what = f"follows {joint.leader} otherwise"
        else:
            continue
        raise _build_mismatch(source, robot, f"joint {joint.name} {what} in the robot (row {row})")


def _compare_gravity(
    source: OriginalFile, tree: BodyTree, robot: Robot, on: Links
) -> Iterator[str]:
    """Reports another gravity in the file, in the frame 0 of the robot."""
    at, robot_gravity = _compute_body_poses(tree, {}), compute_gravity(robot)
    base = next((name for name, (row, _) in on.items() if row == BASE and name in at), None)
    if base is None:
        return
    file_gravity = on[base][1].rotation @ at[base].rotation.T @ tree.gravity + 0.0
    if source.format == "urdf":  # which states none, and is stood upright
        file_gravity *= np.linalg.norm(robot_gravity) / np.linalg.norm(file_gravity)
    if (
        np.abs(file_gravity - robot_gravity).max()
        > THRESHOLDS.max_gravity_difference * np.abs([file_gravity, robot_gravity]).max()
    ):
        one, other = (", ".join(f"{x:.4g}" for x in g) for g in (file_gravity, robot_gravity))
        yield (
            f"gravity is [{one}] m/s2 in {source.path.name} and [{other}] in the robot, in frame "
            "0: torques differ; mend the one that is wrong (of URDF the robot's, or how it stands)"
        )


def _check_sdf(source: OriginalFile, robot: Robot, on: Links) -> None:
    """Links are placed on the first as the table has them at 0, as far as their poses are plain."""
    at, reference = compute_row_poses(robot, {}), None
    for link in (element for element in source.root.iterate_elements() if element.tag == "link"):
        name, pose = link.attributes.get("name", ""), find_first_child(link, "pose")
        if name not in on or (pose is not None and pose.attributes.get("relative_to")):
            continue
        row, link_frame = on[name]
        base = _read_sdf_pose(link) @ (at[row] @ link_frame).inverse()
        reference = reference or base
        if not _is_same_pose(reference, base):
            raise _build_mismatch(source, robot, f"link {name} stands elsewhere at 0")


def _is_same_pose(one: Pose, other: Pose) -> bool:
    apart = np.abs(one.position - other.position).max()
    turned = np.abs(one.rotation - other.rotation).max()
    return max(float(apart), float(turned)) < THRESHOLDS.max_pose_difference


def distribute_change(bodies: Mapping[str, np.ndarray], whole: np.ndarray) -> dict[str, np.ndarray]:
    """Returns bodies that hang together, changed alike so that they come to a given whole.

    With P' = A P A^T of the wholes, every part becomes A P_k A^T: they add up, and what could be
    built can be built. A is the symmetric one (optimal transport of normal distributions).

    Args:
        bodies: by name, (10,) in one frame.
        whole: (10,) that they shall be together.
    """
    size = np.sqrt(np.maximum(np.diag(compute_pseudo_inertia(whole)), 1e-300))
    across = np.outer(size, size)
    old = compute_pseudo_inertia(np.sum(list(bodies.values()), axis=0)) / across
    root = _compute_matrix_root(old)
    inverse = np.linalg.inv(root)
    middle = _compute_matrix_root(root @ (compute_pseudo_inertia(whole) / across) @ root)
    A = inverse @ middle @ inverse
    return {
        name: extract_parameters((A @ (compute_pseudo_inertia(ten) / across) @ A.T) * across)
        for name, ten in bodies.items()
    }


def _compute_matrix_root(matrix: np.ndarray) -> np.ndarray:
    values, vectors = np.linalg.eigh(matrix)
    return np.asarray((vectors * np.sqrt(np.maximum(values, 1e-14 * values[-1]))) @ vectors.T)
