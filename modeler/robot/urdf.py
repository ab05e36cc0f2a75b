"""URDF: the links and joints of a file as a `BodyTree`.

The schema is that of http://wiki.ros.org/urdf/XML, read as urdfdom reads it. The file is read here
and not by another library, for those keep neither the digits of a number, which tell a rounded
pi/2 from a measured angle, nor the line and the bytes where it stands. What becomes of every
element stands in `urdf_elements.toml`.
"""

import shlex
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeler.core.errors import RobotError
from modeler.core.toml_cells import Place, listed, near, shown
from modeler.robot.body_tree import BodyTree, Inertial, Roundings, TreeJoint, doubt, several
from modeler.robot.elements import element_table
from modeler.robot.robot import JointKind
from modeler.robot.tree_cuts import follow
from modeler.robot.urdf_ties import add_armatures, add_springs, couplings, with_loops
from modeler.robot.xml_cells import Spot, half_unit, pose_of
from modeler.robot.xml_source import parse_xml

_KINDS = {
    "revolute": JointKind.REVOLUTE,
    "continuous": JointKind.REVOLUTE,
    "prismatic": JointKind.PRISMATIC,
    "fixed": JointKind.FIXED,
}
_UNREAD = ("floating", "planar", "ball", "spherical", "universal", "screw")
_ACCELERATIONS = ("acceleration", "deceleration", "drake:acceleration")
_MOST_LINKS = 5000


def urdf_tree(data: bytes, where: str, exact_decimals: bool = False) -> BodyTree:
    """The robot of a URDF.

    Joints of kinds that we do not have stand in `unread`; `tree_cuts.cut` deals with them.

    Args:
        data: the file.
        where: its path, for messages.
        exact_decimals: True to take printed angles and lengths as they are; else 1.5708 is pi/2,
            and what is smaller than 1e-6 is 0.

    Raises:
        RobotError: not a URDF, or a mistake in it: line, element, what was got and expected.
    """
    root = Spot(parse_xml(data, where), where, "")
    _check_format(root, where)
    return _Reading(root, where, exact_decimals).tree()


def _check_format(root: "Spot", where: str) -> None:
    if root.element.tag != "robot":
        raise root.place.error(f"<{root.element.tag}> is no URDF, which begins with <robot>")
    for child in root.element.children:
        macros = child.tag in ("include", "macro", "property")
        ours = child.tag in ("link", "joint")
        for element in child.walk():
            variable = ours and any("${" in value for value in element.attributes.values())
            if macros or variable or element.tag.startswith("xacro:"):
                raise RobotError(  # whole, however long the path is
                    f"{where}: line {element.line}: <{element.tag[:60]}> is of xacro, not of URDF; "
                    f"expand it first: {_expansion(where)}"
                )


def _expansion(where: str) -> str:
    path = Path(where)
    bare = path.name.removesuffix(".xacro").removesuffix(".urdf")
    out = path.with_name(f"{bare}.urdf" if path.suffix == ".xacro" else f"{bare}_expanded.urdf")
    return f"xacro {shlex.quote(where)} > {shlex.quote(str(out))}"


class _Reading:
    """One pass over the elements of a file."""

    def __init__(self, root: Spot, where: str, exact: bool) -> None:
        self._root, self._where = root, where
        self._rounded = Roundings(exact)
        self._told: dict[str, list[str]] = {}  # what -> of which links and joints
        self._doubted: dict[str, str] = {}
        self._unread: dict[str, str] = {}

    def tree(self) -> BodyTree:
        links, spots = self._named("link"), self._named("joint")
        if not links:
            raise self._root.place.error('<robot> has no link; expected <link name="...">')
        bodies = {name: self._body(name, link) for name, link in links.items()}
        joints = {name: self._joint(name, spot, links) for name, spot in spots.items()}
        root = _first_link(self._root.place, bodies, joints, spots)
        add_armatures(self._root, joints, self._tell)
        add_springs(self._root, joints, self._tell)
        self._follow(joints, spots)
        tree = BodyTree(
            name=self._root.element.attributes.get("name", "").strip() or Path(self._where).stem,
            format="URDF",
            root=root,
            bodies=bodies,
            joints=tuple(_in_order(joints, root)),
            doubted=self._doubted,
            unread=self._unread,
        )
        tree = with_loops(self._root, tree, self._rounded)
        judged = element_table("urdf").notes([(self._where, self._root.element)])
        return replace(tree, notes=(*self._notes(), *tree.notes, *judged))

    def _named(self, tag: str) -> dict[str, Spot]:
        found: dict[str, Spot] = {}
        for element in self._root.element.named(tag, f"drake:{tag}"):
            name = Spot(element, self._where, f"<{tag}>").needed("name", f"{tag}1")
            spot = Spot(element, self._where, f"{tag} {shown(name)}")
            if name in found:
                first = f"the first is in line {found[name].element.line}"
                raise spot.place.error(f"a second {tag} of that name; {first}: rename one")
            found[name] = spot
            if len(found) > _MOST_LINKS:
                raise spot.place.error(f"more than {_MOST_LINKS} of them; is this a robot?")
        return found

    def _tell(self, what: str, name: str) -> None:
        self._told.setdefault(what, []).append(name)

    def _body(self, name: str, link: Spot) -> Inertial | None:
        inertial = link.only("inertial")
        if not inertial.given:
            return None
        mass, tensor = inertial.must("mass", 'value="1"'), inertial.must("inertia", 'ixx="0.01" ..')
        mass.needed("value", "1")
        entries = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        printed = [tensor.needed(e, "0.01") and tensor.digits(e, "0.01")[0] for e in entries]
        matrix = np.zeros((3, 3))
        matrix[np.triu_indices(3)] = [float(word) for word in printed]
        matrix = np.triu(matrix) + np.triu(matrix, 1).T
        body = Inertial(float(mass.digits("value", "1")[0]), np.zeros(3), matrix)
        reason = doubt(body, sum(half_unit(word) for word in printed if float(word)))
        if reason:
            self._doubted[name] = reason
        # Measured, and no part of the geometry: as printed.
        return body.seen_from(pose_of(inertial.only("origin"), Roundings(exact=True)))

    def _joint(self, name: str, spot: Spot, links: Mapping[str, Spot]) -> TreeJoint:
        kind = spot.needed("type", "revolute").lower()
        if kind in _UNREAD:
            self._unread[name] = f"{spot.place.file}: joint {shown(name)}: {kind}"
        elif kind not in _KINDS:
            raise spot.place.at("type", kind).mismatch(f"{listed(_KINDS)}{near(kind, _KINDS)}")
        parent, child = (spot.must(end, 'link="..."') for end in ("parent", "child"))
        for inner in (parent, child):
            if (link := inner.needed("link", "link1")) not in links:
                raise inner.place.error(f"there is no link {shown(link)}{near(link, links)}")
        ends = parent.needed("link", ""), child.needed("link", "")
        sort = _KINDS.get(kind, JointKind.FIXED)
        joint = TreeJoint(name, sort, *ends, pose_of(spot.only("origin"), self._rounded))
        if joint.kind is JointKind.FIXED:
            return joint
        limit, dynamics = spot.only("limit"), spot.only("dynamics")
        lower, upper = self._range(name, kind, limit, spot.only("safety_controller"))
        speed = abs(limit.stated("velocity") or 0.0) or None
        if speed is None and "velocity" in limit.element.attributes:
            self._tell("velocity 0 or inf is taken as not stated: {}", name)
        least = [a for key in _ACCELERATIONS if (a := abs(limit.stated(key) or 0.0))]
        return replace(
            joint,
            axis=self._axis(name, spot.only("axis")),
            lower=lower,
            upper=upper,
            speed=speed,
            acceleration=min(least, default=None),
            effort=abs(limit.stated("effort") or 0.0) or None,
            damping=self._loss(name, dynamics, "damping"),
            friction=self._loss(name, dynamics, "friction"),
        )

    def _range(
        self, name: str, kind: str, limit: Spot, soft: Spot
    ) -> tuple[float | None, float | None]:
        """The positions between which the joint may move; None where the file leaves them open."""
        lower, upper = limit.stated("lower"), limit.stated("upper")
        infinite = [k for k in ("lower", "upper") if limit.said(k) and limit.stated(k) is None]
        if kind == "continuous":
            if lower or upper:
                self._tell("type continuous has no range, lower and upper are not taken: {}", name)
            lower = upper = None
        elif infinite and (lower is not None or upper is not None):
            self._tell("a range that is infinite on one side is not taken: {}", name)
            lower = upper = None
        elif lower is not None or upper is not None:  # the schema: left out is 0
            lower, upper = lower or 0.0, upper or 0.0
            if lower >= upper:
                self._tell("limits that leave no range are not taken: {}", name)
                return lower, upper
        low, high = soft.stated("soft_lower_limit"), soft.stated("soft_upper_limit")
        if low is None or high is None or (low, high) == (lower, upper):
            return lower, upper
        low = low if lower is None else max(low, lower)
        high = high if upper is None else min(high, upper)
        if low >= high:
            self._tell("a safety_controller that leaves no range is not taken: {}", name)
            return lower, upper
        self._tell("the range is that of the safety_controller: {}", name)
        return low, high

    def _loss(self, name: str, dynamics: Spot, key: str) -> float | None:
        value = dynamics.stated(key)
        if value is not None and value < 0.0:
            self._tell(f"negative {key} is not taken: {{}}", name)
            return None
        return value

    def _axis(self, name: str, spot: Spot) -> np.ndarray:
        length = float(np.linalg.norm(spot.numbers("xyz", "1 0 0")))
        axis = self._rounded.lengths(spot.direction("xyz", "1 0 0"))
        if abs(length - 1.0) > 1e-3:
            self._tell("axes that are not of length 1 are taken as directions: {}", name)
        return np.asarray(axis / np.linalg.norm(axis) + 0.0)

    def _follow(self, joints: dict[str, TreeJoint], spots: Mapping[str, Spot]) -> None:
        """Let the mimic joints follow a joint that leads."""
        direct = couplings(self._root, joints, self._tell)
        still, circle = follow(joints, direct)
        if circle:
            raise spots[circle].place.error("follows itself by <mimic>; one of them must lead")
        for name in still:
            self._tell("what they mimic does not move, so they are fixed: {}", name)

    def _notes(self) -> Iterable[str]:
        yield from self._rounded.notes()
        for what, names in self._told.items():
            yield what.format(several(names))


def _first_link(
    place: Place, bodies: Iterable[str], joints: Mapping[str, TreeJoint], spots: Mapping[str, Spot]
) -> str:
    """The link that no joint moves; refuses what is no tree."""
    above: dict[str, TreeJoint] = {}
    for joint in joints.values():
        other = above.setdefault(joint.child, joint)
        if other is not joint:
            told = f"link {shown(joint.child)} is the child of joint {shown(other.name)} too"
            raise spots[joint.name].place.error(f"{told}; expected one parent: a URDF is a tree")
    first = [name for name in bodies if name not in above]
    if len(first) > 1:
        raise place.error(
            f"no joint leads to {len(first)} links, {several(first)}; expected one first link: "
            "join the others to it by fixed joints, or take them out"
        )
    reached = {*first, *(joint.child for name in first for joint in _in_order(joints, name))}
    for link in bodies:
        if link not in reached:
            for _ in bodies:  # so far up that it is in the circle
                link = above[link].parent
            told = f"link {shown(link)} is the parent of its own parents"
            raise spots[above[link].name].place.error(f"{told}; mend <parent> or <child>")
    return first[0]


def _in_order(joints: Mapping[str, TreeJoint], root: str) -> list[TreeJoint]:
    """Every joint after that which moves its parent, else as they come; only what root leads to."""
    waiting, here, found = list(joints.values()), {root}, list[TreeJoint]()
    while joint := next((joint for joint in waiting if joint.parent in here), None):
        waiting.remove(joint)
        found.append(joint)
        here.add(joint.child)
    return found
