"""Rigid bodies and the joints between them, as URDF, MJCF and SDF state a robot.

A file's robot is a tree of bodies, each with a frame that the file has chosen. The readers of these
formats make a `BodyTree` of it; `collect_moving_links` puts together what fixed joints hold
together; the rows of the MDH table follow from the axes (`modeler.formats.mdh_rows`).
"""

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from functools import cache

import numpy as np

from modeler.core.toml_cells import quote_value
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import (
    JointKind,
    compute_cosine_sine,
    count_twelfths,
    describe_rounded_angles,
    format_pi_multiple,
)


def summarise_names(names: Iterable[str]) -> str:
    """Returns `"a", "b" and 12 more`."""
    unique_names = list(dict.fromkeys(names))
    return ", ".join(
        quote_value(name) for name in unique_names[: THRESHOLDS.max_names_in_note]
    ) + _format_remainder(len(unique_names))


def _format_remainder(count: int) -> str:
    most = THRESHOLDS.max_names_in_note
    return f" and {count - most} more" if count > most else ""


@dataclass
class Roundings:
    """What the printed numbers of a file are roundings of.

    Attributes:
        exact: True to take numbers as printed.
        angles: printed -> multiple of pi/12.
        zeros: numbers below `THRESHOLDS.max_rounded_zero`.
    """

    exact: bool
    angles: dict[str, str] = field(default_factory=dict)
    zeros: int = 0

    def snap_angle(self, digits: str) -> float:
        """Returns what the printed angle means, rad: a multiple of pi/12 if near one."""
        value = float(digits)
        if self.exact:
            return value
        count, nearest = count_twelfths(digits), round(value * 12 / math.pi)
        if count is None and abs(value - nearest * math.pi / 12) <= THRESHOLDS.max_rounded_zero:
            count = nearest
        if count is None or value == count * math.pi / 12:
            return value
        if count:
            self.angles[digits] = format_pi_multiple(Fraction(count, 12))
        self.zeros += not count
        return count * math.pi / 12

    def snap_lengths(self, values: np.ndarray) -> np.ndarray:
        """Returns what printed lengths, or parts of a unit axis, mean."""
        dust = (values != 0.0) & (abs(values) < THRESHOLDS.max_rounded_zero)
        if self.exact:
            return values
        self.zeros += int(dust.sum())
        return np.where(dust, 0.0, values)

    def describe_roundings(self) -> Iterator[str]:
        """Yields what to show of them."""
        if self.angles:
            first = list(self.angles.items())[: THRESHOLDS.max_names_in_note]
            most = describe_rounded_angles(dict(first))
            yield f"{most}{_format_remainder(len(self.angles))}; --exact-decimals keeps them"
        if self.zeros:
            most = f"{THRESHOLDS.max_rounded_zero:g}"
            yield f"{self.zeros} lengths, angles and parts of axes below {most} are 0 here"


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a frame b is in a frame a: x_a = rotation x_b + position.

    Attributes:
        position: (3,) origin of b in a, m.
        rotation: (3, 3) the axes of b in a, as columns.
    """

    position: np.ndarray = field(default_factory=lambda: np.zeros(3))
    rotation: np.ndarray = field(default_factory=lambda: np.eye(3))

    def __matmul__(self, other: "Pose") -> "Pose":
        """The pose of c in a, from that of b in a and that of c in b."""
        return Pose(self.transform_point(other.position), self.rotation @ other.rotation)

    def transform_point(self, point: np.ndarray) -> np.ndarray:
        """Returns a point of b, in a."""
        return self.rotation @ point + self.position

    def inverse(self) -> "Pose":
        """Returns the pose of a in b."""
        return Pose(-self.rotation.T @ self.position, self.rotation.T)


@dataclass(frozen=True, eq=False)
class Inertial:
    """Mass, mass centre and inertia of a body, as files state them.

    Attributes:
        mass: kg.
        centre: (3,) mass centre in the body's frame, m.
        inertia: (3, 3) about the mass centre, along the axes of the body's frame, kg m2.
    """

    mass: float
    centre: np.ndarray
    inertia: np.ndarray

    def express_in(self, pose: Pose) -> "Inertial":
        """Returns the inertial in the frame a, in which the body's frame b has that pose."""
        turn = pose.rotation
        return Inertial(self.mass, pose.transform_point(self.centre), turn @ self.inertia @ turn.T)


def compute_axis_rotation(axis: np.ndarray, angle: float) -> np.ndarray:
    """Computes the (3, 3) rotation about a unit axis (Rodrigues), exact for right angles."""
    cosine, sine = compute_cosine_sine(angle)
    along = np.outer(axis, axis)
    x, y, z = axis
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    # + 0.0: no matrix has a -0.
    return np.asarray(along + cosine * (np.eye(3) - along) + sine * across + 0.0)


def find_inertia_defect(body: Inertial, slack: float = 0.0) -> str:
    """Says why no body can have these values; "" if one can.

    The principal moments of a body are not negative, and none is larger than the sum of the others
    (Wensing et al. 2018, equation 6).

    Args:
        body: as the file states it.
        slack: what rounding of the printed digits may have moved the sum of the three by, kg m2.
    """
    if body.mass < 0.0:
        return f"mass {body.mass:g} kg is negative"
    if body.mass == 0.0:
        return "mass 0"
    if abs(body.inertia).max() <= 1e-12 * body.mass:  # a sphere of a micrometre
        return "a mass with inertia 0"
    if np.array_equal(body.inertia, np.eye(3)):
        return "the identity as inertia"
    small, middle, large = (float(x) for x in np.linalg.eigvalsh(body.inertia))
    printed = f"principal moments {small:.4g}, {middle:.4g}, {large:.4g} kg m2"
    slack += 1e-9 * abs(large)
    if small < -slack / 3:
        return f"{printed}: one is negative"
    if small + middle < large - slack:
        return f"{printed}: one is larger than the sum of the others"
    return ""


def compute_standard_parameters(body: Inertial) -> np.ndarray:
    """Computes (10,) XX XY XZ YY YZ ZZ about the origin of the frame, MX MY MZ, M."""
    c, m = body.centre, body.mass
    tensor = body.inertia + m * (c @ c * np.eye(3) - np.outer(c, c))
    return np.array([*tensor[np.triu_indices(3)], *(m * c), m])


@dataclass(frozen=True, eq=False)
class TreeJoint:
    """A joint between two bodies.

    The frame of `child` in that of `parent` is pose for q = zero; it turns about, or slides along,
    `axis` through `point` by q - zero.

    Attributes:
        name: as the file has it.
        kind: revolute, prismatic or fixed.
        parent, child: names of bodies.
        pose: of the child's frame in the parent's at q = zero.
        axis: (3,) of length one, in the child's frame.
        point: (3,) on the axis, in the child's frame, m.
        zero: position at which `pose` holds, rad or m.
        lower, upper, speed, acceleration, effort: limits; None where the file states none.
        damping: N m s/rad, N s/m. friction: dry, N m, N. armature: rotor inertia as the joint
            is subject to it, kg m2, kg. stiffness: of a spring, about `rest`. None: not stated.
        leader: joint that it follows, q = ratio q_leader + offset; "" if it follows none.
        actuated: True if a motor drives it.
    """

    name: str
    kind: JointKind
    parent: str
    child: str
    pose: Pose = field(default_factory=Pose)
    axis: np.ndarray = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    point: np.ndarray = field(default_factory=lambda: np.zeros(3))
    zero: float = 0.0
    lower: float | None = None
    upper: float | None = None
    speed: float | None = None
    acceleration: float | None = None
    effort: float | None = None
    damping: float | None = None
    friction: float | None = None
    armature: float | None = None
    stiffness: float | None = None
    rest: float = 0.0
    leader: str = ""
    ratio: float = 1.0
    offset: float = 0.0
    actuated: bool = True

    def compute_pose(self, position: float) -> Pose:
        """Returns the frame of the child in that of the parent, at a joint position."""
        step = position - self.zero
        if self.kind is JointKind.FIXED or step == 0.0:
            return self.pose
        if self.kind is JointKind.PRISMATIC:
            return self.pose @ Pose(step * self.axis)
        turn = compute_axis_rotation(self.axis, step)
        return self.pose @ Pose(self.point - turn @ self.point, turn)


Couplings = dict[str, tuple[str, float, float]]
"""Joint -> that which it follows, "" for none, ratio and offset."""


@dataclass(frozen=True, eq=False)
class LoopClosure:
    """A joint that closes a loop: a frame on one body meets a frame on another.

    Attributes:
        name: for messages.
        body, other: names of bodies.
        pose, other_pose: of the frames on them.
        kind: of `robot.LOOP_KINDS`; the axis of the joint is z of both frames.
    """

    name: str
    body: str
    pose: Pose
    other: str
    other_pose: Pose
    kind: str = "spherical"


@dataclass(frozen=True, eq=False)
class BodyTree:
    """The robot of a file.

    Attributes:
        name: as the file has it.
        format: "URDF", "MJCF".
        root: the body that stands still; its frame is frame 0.
        bodies: name -> what it weighs; None where the file says nothing.
        joints: every one after that which moves its parent; in file order but for that.
        meetings: points that close loops.
        gravity: (3,) acceleration of gravity in frame 0, m/s2.
        hidden: bodies that the reader made up, between several joints of one body.
        doubted: body -> why its values are no measurement (`find_inertia_defect`): they make no
            prior.
        unread: joint -> "file: line: joint: kind" of those of a kind that we do not have, ball,
            free, planar; `fixed` among `joints` until `tree_cuts.cut_tree` has cut them off, locked
            them, or refuses.
        home: posture near which the meetings are closed, joint -> position; empty: every joint at
            its `zero`.
        notes: what was decided or left out, a line each.
    """

    name: str
    format: str
    root: str
    bodies: Mapping[str, Inertial | None]
    joints: tuple[TreeJoint, ...]
    loop_closures: tuple[LoopClosure, ...] = ()
    gravity: np.ndarray = field(default_factory=lambda: np.array([0.0, 0.0, -9.81]))
    auxiliary_bodies: frozenset[str] = frozenset()
    unreliable_bodies: Mapping[str, str] = field(default_factory=dict)
    unsupported_joints: Mapping[str, str] = field(default_factory=dict)
    home: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def compute_body_poses(tree: BodyTree, positions: Mapping[str, float]) -> dict[str, Pose]:
    """Computes the pose of every body's frame in frame 0; leaders stand at 0 by default."""
    poses = {tree.root: Pose()}
    for joint in tree.joints:
        at = positions.get(joint.leader or joint.name, 0.0)
        if joint.leader:
            at = joint.ratio * at + joint.offset
        poses[joint.child] = poses[joint.parent] @ joint.compute_pose(at)
    return poses


@dataclass(frozen=True, eq=False)
class MovingLink:
    """Bodies that move as one: what a joint moves, and what fixed joints hold to it.

    Its frame is that of the child of its joint; of the first link, which stands still, the root's.

    Attributes:
        joint: that moves it; None of the first.
        parent: place of the link before it in the list; -1 of the first.
        pose: of its frame in that of the link before it at q = zero.
        bodies: name -> pose of the body's frame in the link's.
        inertial: of all of them together, in the link's frame; None if no body states any.
    """

    joint: TreeJoint | None
    parent: int
    pose: Pose
    bodies: Mapping[str, Pose]
    inertial: Inertial | None


def collect_moving_links(tree: BodyTree) -> list[MovingLink]:
    """Returns the links of the tree, bodies on fixed joints lumped; the first stands still.

    The order of the others is that of the joints that move.
    """
    members: list[dict[str, Pose]] = [{tree.root: Pose()}]
    joints: list[tuple[TreeJoint | None, int, Pose]] = [(None, -1, Pose())]
    link_of = {tree.root: 0}
    for joint in tree.joints:
        at = link_of[joint.parent]
        pose = members[at][joint.parent] @ joint.pose
        if joint.kind is JointKind.FIXED:
            members[at][joint.child] = pose
        else:
            joints.append((joint, at, pose))
            members.append({joint.child: Pose()})
            at = len(members) - 1
        link_of[joint.child] = at
    inertials = [combine_inertials(_collect_inertials(tree, bodies)) for bodies in members]
    parts = zip(joints, members, inertials, strict=True)
    return [MovingLink(*joint, bodies, inertial) for joint, bodies, inertial in parts]


def _collect_inertials(tree: BodyTree, members: Mapping[str, Pose]) -> Iterator[Inertial]:
    for name, pose in members.items():
        body = tree.bodies[name]
        if body is not None:
            yield body.express_in(pose)


def combine_inertials(bodies: Iterator[Inertial]) -> Inertial | None:
    """Returns one body of several in the same frame; None of none."""
    parts = list(bodies)
    if len(parts) < 2:
        return parts[0] if parts else None
    mass = sum(part.mass for part in parts)
    if mass == 0.0:
        return Inertial(0.0, np.zeros(3), np.sum([part.inertia for part in parts], axis=0))
    centre = np.sum([part.mass * part.centre for part in parts], axis=0) / mass
    inertia = np.zeros((3, 3))
    for part in parts:
        arm = part.centre - centre
        inertia += part.inertia + part.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return Inertial(mass, centre, inertia)


# Printed quaternions and axes, and the turns by multiples of pi/12 that they round.


ALIKE, EXACT = 1e-9, 1e-15


def snap_quaternion(quaternion: np.ndarray, rounded: Roundings) -> np.ndarray:
    """Returns quaternion of a turn by multiples of pi/12 that the printed one rounds, or itself."""
    return _snap_to_known(quaternion, _build_known_rotations(), rounded)


def snap_direction(direction: np.ndarray, rounded: Roundings) -> np.ndarray:
    """Returns the direction in a coordinate plane that the printed axis rounds, or itself."""
    return _snap_to_known(direction, _build_known_directions(), rounded)


def compute_quaternion_rotation(quaternion: np.ndarray) -> np.ndarray:
    """Returns (3, 3) of a quaternion of any length; what ought to be 0 or 1 is."""
    w, v = quaternion[0], quaternion[1:]
    across = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    turn = (w * w - v @ v) * np.eye(3) + 2.0 * (np.outer(v, v) + w * across)
    turn /= quaternion @ quaternion
    whole = np.round(turn)
    return np.where(np.abs(turn - whole) < EXACT, whole, turn) + 0.0


def _snap_to_known(vector: np.ndarray, known: np.ndarray, rounded: Roundings) -> np.ndarray:
    """The unit vector among the known ones that the printed one rounds; itself if there is none."""
    length = float(np.linalg.norm(vector))
    if not 0.99 < length < 1.01:
        return vector
    digits = max(-int(Decimal(repr(float(x))).as_tuple().exponent) for x in vector)
    if digits < 3:
        return vector
    most = THRESHOLDS.max_quaternion_rounding
    allowed = 0.51 * 10.0**-digits if digits < 5 else max(10.0**-digits, most)
    best: np.ndarray = known[np.argmax(known @ vector)]
    if np.max(np.abs(best - vector)) > allowed:
        return vector
    if np.max(np.abs(best - vector / length)) > ALIKE:
        rounded.angles[" ".join(f"{x:g}" for x in vector)] = "of multiples of pi/12"
    return best


@cache
def _build_known_rotations() -> np.ndarray:
    """(n, 4) quaternions of turns about three different axes by multiples of pi/12, both signs."""
    turns = np.zeros((3, 48, 4))
    for count, axis in itertools.product(range(48), range(3)):
        cosine, sine = compute_cosine_sine(count * math.pi / 24)
        turns[axis, count, 0], turns[axis, count, axis + 1] = cosine, sine
    middle = [*range(7), *range(42, 48)]  # to a right angle

    def turn_thrice(i: int, j: int, k: int) -> np.ndarray:
        two = _multiply_quaternions(turns[i][:, None], turns[j][None, middle])
        return _multiply_quaternions(two.reshape(-1, 1, 4), turns[k][None, :24]).reshape(-1, 4)

    return np.concatenate([turn_thrice(*axes) for axes in itertools.permutations(range(3))])


def _multiply_quaternions(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Quaternions a b, along the last axis."""
    head = a[..., :1] * b[..., :1] - np.sum(a[..., 1:] * b[..., 1:], axis=-1, keepdims=True)
    tail = a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] + np.cross(a[..., 1:], b[..., 1:])
    return np.concatenate([head, tail], axis=-1)


@cache
def _build_known_directions() -> np.ndarray:
    """(72, 3) unit vectors in the coordinate planes at multiples of pi/12."""
    plane = np.array([[*compute_cosine_sine(count * math.pi / 12), 0.0] for count in range(24)])
    return np.concatenate([np.roll(plane, k, axis=1) for k in range(3)])
