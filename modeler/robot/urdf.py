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
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name
from modeler.robot.body_tree import (
    BodyTree,
    Inertial,
    Roundings,
    TreeJoint,
    find_inertia_defect,
    summarise_names,
)
from modeler.robot.elements import load_element_table
from modeler.robot.robot import JointKind
from modeler.robot.tree_cuts import resolve_leaders
from modeler.robot.urdf_ties import add_armatures, add_loops, add_springs, read_couplings
from modeler.robot.xml_cells import Spot, compute_half_unit, read_pose
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


def read_urdf_tree(data: bytes, where: str, exact_decimals: bool = False) -> BodyTree:
    """The robot of a URDF.

    Joints of kinds that we do not have stand in `unread`; `tree_cuts.cut_tree` deals with them.

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
    return _UrdfReader(root, where, exact_decimals).read_tree()


def _check_format(root: "Spot", where: str) -> None:
    if root.element.tag != "robot":
        raise root.place.make_error(f"<{root.element.tag}> is no URDF, which begins with <robot>")
    for child in root.element.children:
        macros = child.tag in ("include", "macro", "property")
        ours = child.tag in ("link", "joint")
        for element in child.iterate_elements():
            variable = ours and any("${" in value for value in element.attributes.values())
            if macros or variable or element.tag.startswith("xacro:"):
                raise RobotError(  # whole, however long the path is
                    f"{where}: line {element.line}: <{element.tag[:60]}> is of xacro, not of URDF; "
                    f"expand it first: {_suggest_expansion(where)}"
                )


def _suggest_expansion(where: str) -> str:
    path = Path(where)
    bare = path.name.removesuffix(".xacro").removesuffix(".urdf")
    out = path.with_name(f"{bare}.urdf" if path.suffix == ".xacro" else f"{bare}_expanded.urdf")
    return f"xacro {shlex.quote(where)} > {shlex.quote(str(out))}"


class _UrdfReader:
    """One pass over the elements of a file."""

    def __init__(self, root: Spot, where: str, exact: bool) -> None:
        self._root, self._where = root, where
        self._rounded = Roundings(exact)
        self._told: dict[str, list[str]] = {}  # what -> of which links and joints
        self._doubted: dict[str, str] = {}
        self._unread: dict[str, str] = {}

    def read_tree(self) -> BodyTree:
        links, spots = self._collect_elements("link"), self._collect_elements("joint")
        if not links:
            raise self._root.place.make_error('<robot> has no link; expected <link name="...">')
        bodies = {name: self._read_body(name, link) for name, link in links.items()}
        joints = {name: self._read_joint(name, spot, links) for name, spot in spots.items()}
        root = _find_first_link(self._root.place, bodies, joints, spots)
        add_armatures(self._root, joints, self._add_note)
        add_springs(self._root, joints, self._add_note)
        self._couple_joints(joints, spots)
        tree = BodyTree(
            name=self._root.element.attributes.get("name", "").strip() or Path(self._where).stem,
            format="URDF",
            root=root,
            bodies=bodies,
            joints=tuple(_arrange_joints(joints, root)),
            unreliable_bodies=self._doubted,
            unsupported_joints=self._unread,
        )
        tree = add_loops(self._root, tree, self._rounded)
        element_notes = load_element_table("urdf").collect_notes(
            [(self._where, self._root.element)]
        )
        return replace(tree, notes=(*self._collect_notes(), *tree.notes, *element_notes))

    def _collect_elements(self, tag: str) -> dict[str, Spot]:
        spots: dict[str, Spot] = {}
        for element in self._root.element.find_children(tag, f"drake:{tag}"):
            name = Spot(element, self._where, f"<{tag}>").require_attribute("name", f"{tag}1")
            spot = Spot(element, self._where, f"{tag} {quote_value(name)}")
            if name in spots:
                first = f"the first is in line {spots[name].element.line}"
                raise spot.place.make_error(f"a second {tag} of that name; {first}: rename one")
            spots[name] = spot
            if len(spots) > _MOST_LINKS:
                raise spot.place.make_error(f"more than {_MOST_LINKS} of them; is this a robot?")
        return spots

    def _add_note(self, what: str, name: str) -> None:
        self._told.setdefault(what, []).append(name)

    def _read_body(self, name: str, link: Spot) -> Inertial | None:
        inertial = link.find_child("inertial")
        if not inertial.is_given:
            return None
        mass, tensor = (
            inertial.require_child("mass", 'value="1"'),
            inertial.require_child("inertia", 'ixx="0.01" ..'),
        )
        mass.require_attribute("value", "1")
        entries = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        printed = [
            tensor.require_attribute(e, "0.01") and tensor.read_digits(e, "0.01")[0]
            for e in entries
        ]
        matrix = np.zeros((3, 3))
        matrix[np.triu_indices(3)] = [float(word) for word in printed]
        matrix = np.triu(matrix) + np.triu(matrix, 1).T
        body = Inertial(float(mass.read_digits("value", "1")[0]), np.zeros(3), matrix)
        reason = find_inertia_defect(
            body, sum(compute_half_unit(word) for word in printed if float(word))
        )
        if reason:
            self._doubted[name] = reason
        # Measured, and no part of the geometry: as printed.
        return body.express_in(read_pose(inertial.find_child("origin"), Roundings(exact=True)))

    def _read_joint(self, name: str, spot: Spot, links: Mapping[str, Spot]) -> TreeJoint:
        kind = spot.require_attribute("type", "revolute").lower()
        if kind in _UNREAD:
            self._unread[name] = f"{spot.place.file}: joint {quote_value(name)}: {kind}"
        elif kind not in _KINDS:
            raise spot.place.enter("type", kind).make_mismatch(
                f"{join_names(_KINDS)}{suggest_name(kind, _KINDS)}"
            )
        parent, child = (spot.require_child(end, 'link="..."') for end in ("parent", "child"))
        for inner in (parent, child):
            if (link := inner.require_attribute("link", "link1")) not in links:
                raise inner.place.make_error(
                    f"there is no link {quote_value(link)}{suggest_name(link, links)}"
                )
        ends = parent.require_attribute("link", ""), child.require_attribute("link", "")
        joint_kind = _KINDS.get(kind, JointKind.FIXED)
        joint = TreeJoint(
            name, joint_kind, *ends, read_pose(spot.find_child("origin"), self._rounded)
        )
        if joint.kind is JointKind.FIXED:
            return joint
        limit, dynamics = spot.find_child("limit"), spot.find_child("dynamics")
        lower, upper = self._read_range(name, kind, limit, spot.find_child("safety_controller"))
        speed = abs(limit.read_optional_number("velocity") or 0.0) or None
        if speed is None and "velocity" in limit.element.attributes:
            self._add_note("velocity 0 or inf is taken as not stated: {}", name)
        least = [a for key in _ACCELERATIONS if (a := abs(limit.read_optional_number(key) or 0.0))]
        return replace(
            joint,
            axis=self._read_axis(name, spot.find_child("axis")),
            lower=lower,
            upper=upper,
            speed=speed,
            acceleration=min(least, default=None),
            effort=abs(limit.read_optional_number("effort") or 0.0) or None,
            damping=self._read_loss(name, dynamics, "damping"),
            friction=self._read_loss(name, dynamics, "friction"),
        )

    def _read_range(
        self, name: str, kind: str, limit: Spot, soft: Spot
    ) -> tuple[float | None, float | None]:
        """The positions between which the joint may move; None where the file leaves them open."""
        lower, upper = limit.read_optional_number("lower"), limit.read_optional_number("upper")
        infinite = [
            k
            for k in ("lower", "upper")
            if limit.get_text(k) and limit.read_optional_number(k) is None
        ]
        if kind == "continuous":
            if lower or upper:
                self._add_note(
                    "type continuous has no range, lower and upper are not taken: {}", name
                )
            lower = upper = None
        elif infinite and (lower is not None or upper is not None):
            self._add_note("a range that is infinite on one side is not taken: {}", name)
            lower = upper = None
        elif lower is not None or upper is not None:  # the schema: left out is 0
            lower, upper = lower or 0.0, upper or 0.0
            if lower >= upper:
                self._add_note("limits that leave no range are not taken: {}", name)
                return lower, upper
        low, high = (
            soft.read_optional_number("soft_lower_limit"),
            soft.read_optional_number("soft_upper_limit"),
        )
        if low is None or high is None or (low, high) == (lower, upper):
            return lower, upper
        low = low if lower is None else max(low, lower)
        high = high if upper is None else min(high, upper)
        if low >= high:
            self._add_note("a safety_controller that leaves no range is not taken: {}", name)
            return lower, upper
        self._add_note("the range is that of the safety_controller: {}", name)
        return low, high

    def _read_loss(self, name: str, dynamics: Spot, key: str) -> float | None:
        value = dynamics.read_optional_number(key)
        if value is not None and value < 0.0:
            self._add_note(f"negative {key} is not taken: {{}}", name)
            return None
        return value

    def _read_axis(self, name: str, spot: Spot) -> np.ndarray:
        length = float(np.linalg.norm(spot.read_numbers("xyz", "1 0 0")))
        axis = self._rounded.snap_lengths(spot.read_direction("xyz", "1 0 0"))
        if abs(length - 1.0) > 1e-3:
            self._add_note("axes that are not of length 1 are taken as directions: {}", name)
        return np.asarray(axis / np.linalg.norm(axis) + 0.0)

    def _couple_joints(self, joints: dict[str, TreeJoint], spots: Mapping[str, Spot]) -> None:
        """Let the mimic joints follow a joint that leads."""
        direct = read_couplings(self._root, joints, self._add_note)
        fixed_names, circle = resolve_leaders(joints, direct)
        if circle:
            raise spots[circle].place.make_error("follows itself by <mimic>; one of them must lead")
        for name in fixed_names:
            self._add_note("what they mimic does not move, so they are fixed: {}", name)

    def _collect_notes(self) -> Iterable[str]:
        yield from self._rounded.describe_roundings()
        for what, names in self._told.items():
            yield what.format(summarise_names(names))


def _find_first_link(
    place: TomlCell,
    bodies: Iterable[str],
    joints: Mapping[str, TreeJoint],
    spots: Mapping[str, Spot],
) -> str:
    """The link that no joint moves; refuses what is no tree."""
    above: dict[str, TreeJoint] = {}
    for joint in joints.values():
        other = above.setdefault(joint.child, joint)
        if other is not joint:
            problem = (
                f"link {quote_value(joint.child)} is the child of joint "
                f"{quote_value(other.name)} too"
            )
            raise spots[joint.name].place.make_error(
                f"{problem}; expected one parent: a URDF is a tree"
            )
    first = [name for name in bodies if name not in above]
    if len(first) > 1:
        raise place.make_error(
            f"no joint leads to {len(first)} links, {summarise_names(first)}; expected one first "
            "link: "
            "join the others to it by fixed joints, or take them out"
        )
    reached = {*first, *(joint.child for name in first for joint in _arrange_joints(joints, name))}
    for link in bodies:
        if link not in reached:
            for _ in bodies:  # so far up that it is in the circle
                link = above[link].parent
            problem = f"link {quote_value(link)} is the parent of its own parents"
            raise spots[above[link].name].place.make_error(f"{problem}; mend <parent> or <child>")
    return first[0]


def _arrange_joints(joints: Mapping[str, TreeJoint], root: str) -> list[TreeJoint]:
    """Every joint after that which moves its parent, else as they come; only what root leads to."""
    waiting, here, ordered_joints = list(joints.values()), {root}, list[TreeJoint]()
    while joint := next((joint for joint in waiting if joint.parent in here), None):
        waiting.remove(joint)
        ordered_joints.append(joint)
        here.add(joint.child)
    return ordered_joints
