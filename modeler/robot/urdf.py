"""URDF: the links and joints of a file as a `BodyTree`.

The schema is that of http://wiki.ros.org/urdf/XML, read as urdfdom reads it. The file is read here
and not by another library, for those keep neither the digits of a number, which tell a rounded
pi/2 from a measured angle, nor the line and the bytes where it stands. Meshes, colours and what
belongs to Gazebo are passed over.
"""

import math
import re
import shlex
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeler.core.errors import RobotError
from modeler.core.toml_cells import LARGEST, Place, listed, near, shown
from modeler.robot.body_tree import (
    NOUGHT,
    BodyTree,
    Inertial,
    Pose,
    Roundings,
    TreeJoint,
    doubt,
    several,
    turned,
)
from modeler.robot.cells import LARGEST_LENGTH
from modeler.robot.robot import JointKind
from modeler.robot.tree_cuts import follow
from modeler.robot.xml_source import Element, parse_xml

_KINDS = {
    "revolute": JointKind.REVOLUTE,
    "continuous": JointKind.REVOLUTE,
    "prismatic": JointKind.PRISMATIC,
    "fixed": JointKind.FIXED,
}
_UNREAD = ("floating", "planar", "ball", "spherical", "universal", "screw")
_DECIMAL = re.compile(r"[+-]?(?:\d+\.?(\d*)|\.(\d+))(?:[eE]([+-]?\d{1,4}))?", re.ASCII)
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
    root = _Spot(parse_xml(data, where), where, "")
    _check_format(root, where)
    return _Reading(root, where, exact_decimals).tree()


def _check_format(root: "_Spot", where: str) -> None:
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


class _Spot:
    """An element, or one that is not given, and its place for messages."""

    def __init__(self, element: Element, where: str, spot: str, given: bool = True) -> None:
        self.element, self.given, self._where = element, given, where
        self.place = Place(f"{where}: line {element.line}", spot)

    def only(self, tag: str) -> "_Spot":
        """Its child of that tag, of which it may have one."""
        found = self.element.named(tag)
        if len(found) > 1:
            self.place = Place(f"{self._where}: line {found[1].line}", self.place.spot)
            raise self.place.error(f"a second <{tag}>; expected one: take out what is not meant")
        inner = found[0] if found else Element(tag, {}, self.element.line, {}, (0, 0))
        return _Spot(inner, self._where, f"{self.place.spot} <{tag}>", bool(found))

    def must(self, tag: str, example: str) -> "_Spot":
        """Its child of that tag, which it must have."""
        if not (found := self.only(tag)).given:
            raise self.place.error(f"<{tag}> is missing; write <{tag} {example}/>")
        return found

    def needed(self, attribute: str, example: str) -> str:
        """An attribute that must be there."""
        if not (value := self.element.attributes.get(attribute, "").strip()):
            raise self.place.error(f'{attribute} is missing; write {attribute}="{example}"')
        return value

    def digits(self, attribute: str, default: str, most: float = LARGEST) -> list[str]:
        """The numbers of an attribute as printed, as many as those of the default."""
        text = self.element.attributes.get(attribute, default)
        place, words, count = self.place.at(attribute, text), text.split(), len(default.split())
        expected = f'{"a number" if count == 1 else f"{count} numbers"} such as "{default}"'
        if len(words) != count:
            raise place.mismatch(expected)
        for word in words:
            _check_number(place.holding(word), expected, most)
        return words

    def numbers(self, attribute: str, default: str, most: float = LARGEST) -> np.ndarray:
        """The same as numbers."""
        return np.array([float(word) for word in self.digits(attribute, default, most)])

    def stated(self, attribute: str) -> float | None:
        """A number that may be missing; what is infinite, or as good as that, sets no limit."""
        text = self.element.attributes.get(attribute, "").strip()
        if not text or text.lower().lstrip("+-") in ("inf", "infinity", ".inf"):
            return None
        value = float(self.digits(attribute, "0", math.inf)[0])
        return value if abs(value) <= LARGEST else None


def _check_number(place: Place, expected: str, most: float = LARGEST) -> None:
    if len(place.value) > 100 or not _DECIMAL.fullmatch(place.value):
        raise place.mismatch(expected)
    if abs(float(place.value)) > most:
        raise place.mismatch(f"at most {most:g} in SI units")


class _Reading:
    """One pass over the elements of a file."""

    def __init__(self, root: _Spot, where: str, exact: bool) -> None:
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
        self._follow(joints, spots)
        self._add_armatures(joints)
        return BodyTree(
            name=self._root.element.attributes.get("name", "").strip() or Path(self._where).stem,
            format="URDF",
            root=root,
            bodies=bodies,
            joints=tuple(_in_order(joints, root)),
            doubted=self._doubted,
            unread=self._unread,
            notes=tuple(self._notes()),
        )

    def _named(self, tag: str) -> dict[str, _Spot]:
        found: dict[str, _Spot] = {}
        for element in self._root.element.named(tag):
            name = _Spot(element, self._where, f"<{tag}>").needed("name", f"{tag}1")
            spot = _Spot(element, self._where, f"{tag} {shown(name)}")
            if name in found:
                first = f"the first is in line {found[name].element.line}"
                raise spot.place.error(f"a second {tag} of that name; {first}: rename one")
            found[name] = spot
            if len(found) > _MOST_LINKS:
                raise spot.place.error(f"more than {_MOST_LINKS} of them; is this a robot?")
        return found

    def _tell(self, what: str, name: str) -> None:
        self._told.setdefault(what, []).append(name)

    def _origin(self, spot: _Spot) -> Pose:
        origin = spot.only("origin")
        xyz = self._rounded.lengths(origin.numbers("xyz", "0 0 0", LARGEST_LENGTH))
        return Pose(xyz, _turn(self._rounded.angle(word) for word in origin.digits("rpy", "0 0 0")))

    def _body(self, name: str, link: _Spot) -> Inertial | None:
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
        reason = doubt(body, sum(_half_unit(word) for word in printed if float(word)))
        if reason:
            self._doubted[name] = reason
        origin = inertial.only("origin")  # measured, and no part of the geometry: as printed
        turn = _turn(origin.numbers("rpy", "0 0 0"))
        return body.seen_from(Pose(origin.numbers("xyz", "0 0 0", LARGEST_LENGTH), turn))

    def _joint(self, name: str, spot: _Spot, links: Mapping[str, _Spot]) -> TreeJoint:
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
        joint = TreeJoint(name, sort, ends[0], ends[1], self._origin(spot))
        if joint.kind is JointKind.FIXED:
            return joint
        limit, dynamics = spot.only("limit"), spot.only("dynamics")
        lower, upper = limit.stated("lower"), limit.stated("upper")
        if kind == "continuous" or (lower is None and upper is None):
            lower = upper = None
        elif (lower := lower or 0.0) >= (upper := upper or 0.0):  # the schema: left out is 0
            self._tell("limits that leave no range are not taken: {}", name)
            lower = upper = None
        return replace(
            joint,
            axis=self._axis(name, spot.only("axis")),
            lower=lower,
            upper=upper,
            speed=abs(limit.stated("velocity") or 0.0) or None,
            effort=abs(limit.stated("effort") or 0.0) or None,
            damping=self._loss(name, dynamics, "damping"),
            friction=self._loss(name, dynamics, "friction"),
        )

    def _loss(self, name: str, dynamics: _Spot, key: str) -> float | None:
        value = dynamics.stated(key)
        if value is not None and value < 0.0:
            self._tell(f"negative {key} is not taken: {{}}", name)
            return None
        return value

    def _axis(self, name: str, spot: _Spot) -> np.ndarray:
        axis = spot.numbers("xyz", "1 0 0")
        length = float(np.linalg.norm(axis))
        if length < NOUGHT:
            place = spot.place.at("xyz", spot.element.attributes["xyz"])
            raise place.mismatch('a direction such as "0 0 1"')
        if abs(length - 1.0) > 1e-3:
            self._tell("axes that are not of length 1 are taken as directions: {}", name)
        axis = self._rounded.lengths(axis / length)
        return np.asarray(axis / np.linalg.norm(axis) + 0.0)

    def _follow(self, joints: dict[str, TreeJoint], spots: Mapping[str, _Spot]) -> None:
        """Let the mimic joints follow a joint that leads."""
        direct: dict[str, tuple[str, float, float]] = {}
        for name, joint in joints.items():
            mimic = spots[name].only("mimic")
            if not mimic.given or joint.kind is JointKind.FIXED:
                continue
            ratio, offset = mimic.numbers("multiplier", "1")[0], mimic.numbers("offset", "0")[0]
            direct[name] = mimic.needed("joint", "joint1"), float(ratio), float(offset)
            if direct[name][0] not in joints:
                told = "the file lacks the joint to mimic, it moves freely: {}"
                self._tell(told, f"{name} of {direct.pop(name)[0]}")
        still, circle = follow(joints, direct)
        if circle:
            raise spots[circle].place.error("follows itself by <mimic>; one of them must lead")
        for name in still:
            self._tell("what they mimic does not move, so they are fixed: {}", name)

    def _add_armatures(self, joints: dict[str, TreeJoint]) -> None:
        """Gear ratio squared times rotor inertia, where a transmission states it.

        As `drake:rotor_inertia` and `drake:gear_ratio` (drake.mit.edu, "Reflected inertia"), or as
        `motorInertia` and `mechanicalReduction`.
        """
        for element in self._root.element.named("transmission"):
            stated = {e.tag: e.attributes.get("value", e.text) for e in element.walk()}
            rotor = stated.get("drake:rotor_inertia", stated.get("motorInertia"))
            gear = stated.get("drake:gear_ratio", stated.get("mechanicalReduction", "1"))
            names = [inner.attributes.get("name", "") for inner in element.named("joint")]
            if rotor is None or len(names) != 1 or names[0] not in joints:
                continue
            for text in (rotor, gear):
                place = _Spot(element, self._where, "<transmission>").place
                _check_number(place.holding(text), "a number such as 100")
            armature = float(gear) ** 2 * float(rotor)
            joints[names[0]] = replace(joints[names[0]], armature=armature)
            self._tell("armature is gear ratio squared times rotor inertia: {}", names[0])

    def _notes(self) -> Iterable[str]:
        yield from self._rounded.notes()
        for what, names in self._told.items():
            yield what.format(several(names))


def _first_link(
    place: Place, bodies: Iterable[str], joints: Mapping[str, TreeJoint], spots: Mapping[str, _Spot]
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


def _turn(angles: Iterable[float]) -> np.ndarray:
    """(3, 3) of roll, pitch, yaw about fixed axes: Rz(yaw) Ry(pitch) Rx(roll)."""
    found = np.eye(3)
    for axis, angle in zip(np.eye(3), angles, strict=True):
        found = turned(axis, angle) @ found
    return np.asarray(found + 0.0)


def _half_unit(digits: str) -> float:
    """Half a unit of the last printed digit."""
    found = _DECIMAL.fullmatch(digits)
    assert found is not None
    return 0.5 * 10.0 ** (max(int(found[3] or 0), -300) - len(found[1] or found[2] or ""))


def _in_order(joints: Mapping[str, TreeJoint], root: str) -> list[TreeJoint]:
    """Every joint after that which moves its parent, else as they come; only what root leads to."""
    waiting, here, found = list(joints.values()), {root}, list[TreeJoint]()
    while joint := next((joint for joint in waiting if joint.parent in here), None):
        waiting.remove(joint)
        found.append(joint)
        here.add(joint.child)
    return found
