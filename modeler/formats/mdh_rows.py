"""The links of a tree as rows of Khalil and Kleinfinger's table.

A row places the frame of link j in that of the link before it,

    T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r),

with z_j along the axis of joint j. Axes are given; free are the place of the frame along its axis
and the direction of x_j. They are chosen so that few cells are not 0: x_j along the common normal
with the axis of a joint that link j carries, its origin at the foot, unless another choice saves a
cell. Where axes are parallel but for a little, that foot would be far away, and with it the origin
about which masses and inertias are counted: a fixed row stands between them instead. Joints of one
loop that stand on the same link stand on a fixed row at the first of them: the length of the link
between them is then a cell, and a parallelogram one by its symbols and not by its values only.

Source: W. Khalil, J.-F. Kleinfinger, A new geometric notation for open and closed-loop robots,
    1986; S. Hayati, Robot arm geometric link parameter estimation, 1983 (nearly parallel axes).
"""

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from modeler.formats.body_tree import MovingLink, Pose, TreeJoint
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import GEOMETRY, JointKind, compute_cosine_sine

_TWELFTH = math.pi / 12


@dataclass(frozen=True, eq=False)
class MdhRow:
    """A row of a modified Denavit-Hartenberg table.

    Attributes:
        name, antecedent: of rows; "0" is the base.
        cells: gamma b alpha d theta r, rad and m; what is left out is 0. The variable is to be
            added to theta (revolute) or r (prismatic).
        joint: that moves it; None of a fixed row.
    """

    name: str
    antecedent: str
    cells: Mapping[str, float]
    joint: TreeJoint | None = None

    @property
    def kind(self) -> JointKind:
        """Returns the kind, sigma of the table."""
        return self.joint.kind if self.joint else JointKind.FIXED


@dataclass(frozen=True, eq=False)
class MdhTable:
    """The rows of a modified Denavit-Hartenberg table of a tree.

    Attributes:
        rows: each after its antecedent.
        names: (links,) row that carries the link; "0" for the first.
        places: (links,) pose of the link's frame on that row.
        ends: of every loop, the rows that carry its two frames, and where on them.
    """

    rows: tuple[MdhRow, ...]
    names: tuple[str, ...]
    places: tuple[Pose, ...]
    ends: tuple[tuple["End", "End"], ...] = ()


End = tuple[str, Pose]
"""Row, and the pose of a frame on it."""


Loop = tuple[tuple[int, Pose], tuple[int, Pose]]
"""Two links, and of each the frame, in its file frame, that meets the other."""


def snap_length(length: float) -> float:
    """Returns the decimal that it is but for rounding, else the length itself."""
    for digits in range(THRESHOLDS.max_length_decimals + 1):
        if abs(length - (short := round(length, digits))) <= THRESHOLDS.max_length_rounding * max(
            1.0, abs(length)
        ):
            return short + 0.0  # no -0.0
    return length


def snap_angle(angle: float) -> float:
    """Returns the angle in (-pi, pi], as a multiple of pi/12 or a decimal if near one."""
    angle = math.remainder(angle, math.tau)
    twelfths = round(angle / _TWELFTH)
    if abs(angle - twelfths * _TWELFTH) < THRESHOLDS.max_parallel_angle:
        return math.pi if twelfths == -12 else twelfths * _TWELFTH
    return snap_length(angle)


def compute_cells_pose(cells: Mapping[str, float]) -> Pose:
    """Returns Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r)."""
    gamma, b, alpha, d, theta, r = (cells.get(column, 0.0) for column in GEOMETRY)
    c, s = compute_cosine_sine(alpha)
    middle = Pose(np.array([d, 0.0, 0.0]), np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]))
    return _compute_screw(gamma, b) @ middle @ _compute_screw(theta, r)


def _compute_screw(angle: float, length: float) -> Pose:
    c, s = compute_cosine_sine(angle)
    turn = np.array([[c, 0.0 - s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return Pose(np.array([0.0, 0.0, length]), turn)


@dataclass(frozen=True, eq=False)
class _Axis:
    """The axis of a joint.

    Attributes:
        along: (3,) of length one.
        through: (3,) a point of it; None if it may be anywhere, as that of a sliding joint.
    """

    along: np.ndarray
    through: np.ndarray | None

    def express_in(self, pose: Pose) -> "_Axis":
        """Returns the axis in the frame a, in which the frame b has that pose."""
        through = None if self.through is None else pose.transform_point(self.through)
        return _Axis(pose.rotation @ self.along, through)


@dataclass(frozen=True)
class _Normal:
    """The common normal of the z axis of a frame and another axis.

    Attributes:
        gamma: from x to it, about z; None if it may have any direction.
        b: its foot on z; None if it may be anywhere.
        d: along it, to the other axis.
        tilt: None; where the axes are parallel but for a little, `gamma` and `d` lead to where the
            other axis meets the xy plane, and this is the direction about which it is tilted.
    """

    gamma: float | None = None
    b: float | None = None
    d: float = 0.0
    tilt: float | None = None


def _compute_common_normal(axis: _Axis, reach: float) -> _Normal:
    x, y, z = axis.along
    point = axis.through
    if math.hypot(x, y) < THRESHOLDS.max_parallel_angle:
        return _Normal() if point is None else _compute_point_normal(point[:2])
    gamma = math.atan2(x, -y)
    if point is None:
        return _Normal(gamma)
    along = np.array([math.cos(gamma), math.sin(gamma)])
    across = np.array([-along[1], along[0]])
    distance = -(across @ point[:2]) / (across @ axis.along[:2])
    b = float(point[2] + distance * z)
    if max(abs(b), abs(distance)) <= THRESHOLDS.max_foot_distance_ratio * reach:
        return _Normal(gamma, b, float(along @ point[:2]))
    meets = point - point[2] / z * axis.along
    near = _compute_point_normal(meets[:2])
    return _Normal(near.gamma, None, near.d, gamma)


def _compute_point_normal(point: np.ndarray) -> _Normal:
    d = math.hypot(*point)
    return _Normal(math.atan2(point[1], point[0]), None, d) if snap_length(d) else _Normal()


def _fold_angle(angle: float) -> float:
    """The angle or its opposite direction, exact, in (-pi/2, pi/2]."""
    angle = snap_angle(angle)
    slack = THRESHOLDS.max_parallel_angle
    if -math.pi / 2 + slack < angle <= math.pi / 2 + slack:
        return angle
    return snap_angle(angle + math.pi)


def _compute_cell_cost(number: float, angle: bool = False) -> float:
    """What a cell costs."""
    if number == 0.0:
        return 0.0
    apart = abs(number / _TWELFTH - round(number / _TWELFTH))
    plain = not angle or apart < THRESHOLDS.max_parallel_angle
    return 1.0 if plain else 1.5


@dataclass
class _RowBuilder:
    """The rows as they are made, link by link.

    Attributes:
        links: of the tree.
        reach: distance of neighbouring joints, m.
        axes: of every link's joint, in its file frame.
        points: of links, in their file frames, that close loops.
        leads: link -> the first of those of its loop that stand on the same one.
        frames: pose of every link's row, in its file frame.
    """

    links: Sequence[MovingLink]
    reach: float
    axes: list[_Axis]
    points: Mapping[int, Sequence[np.ndarray]]
    loop_leaders: Mapping[int, int]
    base_rows: dict[int, tuple[str, Pose]] = field(default_factory=dict)
    frames: list[Pose] = field(default_factory=lambda: [Pose()])
    rows: list[MdhRow] = field(default_factory=list)

    def compute_normals(self, link: int, frame: Pose) -> list[_Normal]:
        """Computes the common normals of a frame and the axes and points that its link carries."""
        back = frame.inverse()
        carried = [k for k, other in enumerate(self.links) if other.parent == link]
        axes = [self.axes[k].express_in(back @ self.links[k].pose) for k in carried]
        points = [back.transform_point(point) for point in self.points.get(link, ())]
        normals = [_compute_common_normal(axis, self.reach) for axis in axes]
        return normals + [replace(_compute_point_normal(p[:2]), b=float(p[2])) for p in points]

    def add_row(self, k: int) -> None:
        """Returns the row of link k, and the fixed one before it where that is needed."""
        link = self.links[k]
        joint, name = link.joint, f"{k}"
        assert joint is not None
        antecedent, before = self.get_base_row(k)
        before = before.inverse() @ link.pose  # file frame k on the row before
        axis = self.axes[k].express_in(before)
        normal = _compute_common_normal(axis, self.reach)
        cells, start = _compute_foot_cells(normal), Pose()
        if normal.tilt is not None:
            d = snap_length(normal.d * _get_fold_sign(cells["gamma"], normal.gamma))
            cells |= {"d": d, "theta": _fold_angle(normal.tilt - cells["gamma"])}
            self.rows.append(MdhRow(f"{name}f", antecedent, cells))
            antecedent, start, cells = f"{name}f", compute_cells_pose(cells), {}
        axis = axis.express_in((start @ compute_cells_pose(cells)).inverse())
        cells |= _compute_axis_cells(axis)
        placed = before.inverse() @ start @ compute_cells_pose(cells)  # in file frame k
        revolute = joint.kind is JointKind.REVOLUTE
        zero = joint.zero
        theta, r = self._choose_theta_r(k, placed, (zero, 0.0) if revolute else (0.0, zero))
        cells |= {"theta": theta, "r": r}
        self.rows.append(MdhRow(name, antecedent, cells, joint))
        at_zero = _compute_screw(theta + zero, r) if revolute else _compute_screw(theta, r + zero)
        self.frames.append(placed @ at_zero)

    def get_base_row(self, k: int) -> tuple[str, Pose]:
        """Returns row before that of link k, and its pose in the file frame of the link before."""
        parent, lead = self.links[k].parent, self.loop_leaders.get(k)
        if lead in self.base_rows:
            return self.base_rows[lead]
        frame, name = self.frames[parent], f"{parent}"
        if lead is None:
            return name, frame
        axis = self.axes[k].express_in(frame.inverse() @ self.links[k].pose)
        normal = _compute_common_normal(axis, self.reach)
        if axis.through is not None and normal.tilt is None:
            cells = _compute_foot_cells(normal)
            cells |= _compute_axis_cells(axis.express_in(compute_cells_pose(cells).inverse()))
            if any(cells.values()):
                name, frame = f"{k}s", frame @ compute_cells_pose(cells)
                self.rows.append(MdhRow(name, f"{parent}", cells))
        self.base_rows[lead] = name, frame
        return name, frame

    def locate_end(self, link: int, pose: Pose, other: int) -> End:
        """Returns the row that carries a frame of a link, which meets one of another."""
        while other and self.links[other].parent != link:
            other = self.links[other].parent
        link_row = f"{link}", self.frames[link]
        name, frame = self.base_rows.get(self.loop_leaders.get(other, 0), link_row)
        return name, frame.inverse() @ pose

    def _choose_theta_r(
        self, k: int, placed: Pose, plain: tuple[float, float]
    ) -> tuple[float, float]:
        """theta and r of the row of link k, without its variable.

        Args:
            k: place of the link.
            placed: its axis, as the row has it before theta and r, in its file frame.
            plain: turn and shift from there that make both 0.
        """
        normals = self.compute_normals(k, placed)
        feet = [n.b for n in normals if n.b is not None]

        def compute_shift_cost(h: float) -> float:
            others = (_compute_cell_cost(snap_length(b - h)) for b in feet)
            cost = _compute_cell_cost(snap_length(h - plain[1]))
            return cost + THRESHOLDS.gamma_or_b_cost * sum(others)

        r = snap_length(min([plain[1], *feet], key=compute_shift_cost) - plain[1])
        at = placed @ _compute_screw(0.0, r + plain[1])
        normals = self.compute_normals(k, at)
        angles = [n.gamma for n in normals if n.gamma is not None]

        def compute_turn_cost(phi: float) -> float:
            others = (_compute_cell_cost(_fold_angle(gamma - phi), angle=True) for gamma in angles)
            cost = _compute_cell_cost(snap_angle(phi - plain[0]), True)
            return cost + THRESHOLDS.gamma_or_b_cost * sum(others)

        both = [gamma + half for gamma in angles for half in (0.0, math.pi)]
        return snap_angle(min([plain[0], *both], key=compute_turn_cost) - plain[0]), r


def _compute_foot_cells(normal: _Normal) -> dict[str, float]:
    """gamma and b: to the foot of the common normal, x along it."""
    return {"gamma": _fold_angle(normal.gamma or 0.0), "b": snap_length(normal.b or 0.0)}


def _compute_axis_cells(axis: _Axis) -> dict[str, float]:
    """alpha and d: from the foot to the axis."""
    cells = {"alpha": snap_angle(math.atan2(-axis.along[1], axis.along[2]))}
    if axis.through is not None:
        cells["d"] = snap_length(float(axis.through[0]))
    return cells


def _find_loop_leaders(links: Sequence[MovingLink], loops: Sequence[Loop]) -> dict[int, int]:
    """Link -> the first of those that stand on the same one, and are of one loop."""
    leads: dict[int, int] = {}
    for loop in loops:
        chains: list[list[int]] = []
        for link, _ in loop:
            chains.append([link])
            while chains[-1][-1] > 0:
                chains[-1].append(links[chains[-1][-1]].parent)
        common = next(link for link in chains[0] if link in chains[1])
        branch_links = [chain[chain.index(common) - 1] for chain in chains if chain[0] != common]
        olds = {leads.get(k, k) for k in branch_links}
        branch_links += [k for k, lead in leads.items() if lead in olds]
        leads |= dict.fromkeys(branch_links, min(olds))
    return leads


def _get_fold_sign(folded: float, angle: float | None) -> int:
    """-1 if the direction was turned round."""
    return 1 if angle is None or math.cos(folded - angle) > 0.0 else -1


def _collect_axes(links: Sequence[MovingLink]) -> list[_Axis]:
    """The axes of the joints; that of a sliding joint where it makes the table simplest.

    On the axis of the only joint that the link carries, if they are parallel; else it may be
    anywhere, and goes through the origin of the frame before.
    """
    axes = [_Axis(np.array([0.0, 0.0, 1.0]), np.zeros(3)) for _ in links]
    for k in reversed(range(1, len(links))):
        joint = links[k].joint
        assert joint is not None
        through = joint.point if joint.kind is JointKind.REVOLUTE else None
        if through is None:
            carried = [i for i, link in enumerate(links) if link.parent == k]
            if len(carried) == 1:
                other = axes[carried[0]].express_in(links[carried[0]].pose)
                apart = np.linalg.norm(np.cross(other.along, joint.axis))
                if apart < THRESHOLDS.max_parallel_angle:
                    through = other.through
        axes[k] = _Axis(joint.axis, through)
    return axes


def build_mdh_table(links: Sequence[MovingLink], loops: Sequence[Loop] = ()) -> MdhTable:
    """Returns rows of a tree; row j, counted from 1, moves link j, and q_j is the file's position.

    Args:
        links: as `moving_links` gives them.
        loops: frames that meet.
    """
    link_lengths = [float(np.linalg.norm(link.pose.position)) for link in links]
    points: dict[int, list[np.ndarray]] = {}
    for k, pose in itertools.chain(*loops):
        points.setdefault(k, []).append(pose.position)
    reach, leaders = max(link_lengths) or 1.0, _find_loop_leaders(links, loops)
    builder = _RowBuilder(links, reach, _collect_axes(links), points, leaders)
    for k in range(1, len(links)):
        builder.add_row(k)
    names = tuple(f"{k}" for k in range(len(links)))
    places = tuple(frame.inverse() for frame in builder.frames)
    locate = builder.locate_end
    ends = tuple((locate(*one, two[0]), locate(*two, one[0])) for one, two in loops)
    return MdhTable(tuple(builder.rows), names, places, ends)


def compute_roll_pitch_yaw(rotation: np.ndarray) -> tuple[float, float, float]:
    """Computes the angles of R = Rz(yaw) Ry(pitch) Rx(roll); roll is 0 where it is free."""
    level = math.hypot(rotation[0, 0], rotation[1, 0])
    pitch = math.atan2(-rotation[2, 0], level)
    if level < THRESHOLDS.max_parallel_angle:
        roll, yaw = 0.0, math.atan2(-rotation[0, 1], rotation[1, 1])
    else:
        yaw = math.atan2(rotation[1, 0], rotation[0, 0])
        left = _compute_screw(-yaw, 0.0).rotation @ rotation
        roll = math.atan2(-left[1, 2], left[1, 1])
    return snap_angle(roll), snap_angle(pitch), snap_angle(yaw)


def compute_point_row(point: np.ndarray) -> dict[str, float]:
    """Returns gamma, b and d of a fixed row whose origin is at a point of the frame before it."""
    normal = _compute_point_normal(point[:2])
    gamma = _fold_angle(normal.gamma or 0.0)
    d = snap_length(normal.d * _get_fold_sign(gamma, normal.gamma))
    return {"gamma": gamma, "b": snap_length(float(point[2])), "d": d}


def compute_fixed_row(pose: Pose, free_about_z: bool) -> dict[str, float]:
    """Returns the cells of a fixed row that stands as a frame does in the one before it.

    Args:
        pose: of that frame.
        free_about_z: True if only its origin and z axis matter: theta is 0 then.
    """
    along, place = pose.rotation[:, 2].tolist(), pose.position.tolist()
    parallel = math.hypot(*along[:2]) < THRESHOLDS.max_parallel_angle
    gamma = math.atan2(place[1], place[0]) if parallel else math.atan2(along[0], -along[1])
    gamma = _fold_angle(gamma)
    rest = _compute_screw(-gamma, 0.0) @ pose
    x, y, z = rest.position.tolist()
    alpha = snap_angle(math.atan2(-rest.rotation[1, 2], rest.rotation[2, 2]))
    r = 0.0 if parallel else -y / math.sin(alpha)
    back = compute_cells_pose({"alpha": -alpha}).rotation @ rest.rotation
    theta = 0.0 if free_about_z else snap_angle(math.atan2(back[1, 0], back[0, 0]))
    b = snap_length(z - r * math.cos(alpha))
    cells = (gamma, b, alpha, snap_length(x), theta, snap_length(r))
    return dict(zip(GEOMETRY, cells, strict=True))
