"""URDF: the links and joints of a file as a `BodyTree`.

The schema is that of http://wiki.ros.org/urdf/XML, read as urdfdom reads it. The file is read here
and not by another library, for those keep neither the digits of a number, which tell a rounded
pi/2 from a measured angle, nor the line and the bytes where it stands. Meshes, colours and what
belongs to Gazebo are passed over.
"""

import heapq
import math
import re
import shlex
from collections.abc import Iterable, Mapping
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np

from modeler.core.toml_cells import LARGEST, Place, listed, near, shown
from modeler.robot.angles import pi_multiple, told_angles, twelfths
from modeler.robot.body_tree import BodyTree, Inertial, Pose, TreeJoint, doubt, turned
from modeler.robot.cells import LARGEST_LENGTH
from modeler.robot.robot import JointKind
from modeler.robot.tree_cuts import held
from modeler.robot.xml_source import Element, parse_xml

_KINDS = {
    "revolute": JointKind.REVOLUTE,
    "continuous": JointKind.REVOLUTE,
    "prismatic": JointKind.PRISMATIC,
    "fixed": JointKind.FIXED,
}
_UNREAD = ("floating", "planar", "ball", "spherical", "universal", "screw")
_DECIMAL = re.compile(r"[+-]?(?:\d+\.?(\d*)|\.(\d+))(?:[eE]([+-]?\d{1,4}))?", re.ASCII)
_ZERO = 1e-6
"""m, rad, and of a unit axis: smaller is what an exporter's arithmetic left of 0."""
_MOST_NAMED = 12


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
    root = parse_xml(data, where)
    _check_format(root, where)
    return _Reading(root, where, exact_decimals).tree()


def _check_format(root: Element, where: str) -> None:
    place = Place(f"{where}: line {root.line}")
    if root.tag in ("sdf", "mujoco", "mujocoinclude"):
        told = "SDF; convert it to URDF" if root.tag == "sdf" else "MJCF; call it .xml"
        raise place.error(f"<{root.tag}> is {told}; a URDF begins with <robot>")
    if root.tag != "robot":
        raise place.error(f"got <{root.tag[:40]}>; expected a URDF, which begins with <robot>")
    for child in root.children:
        macros = child.tag in ("include", "macro", "property")
        for element in child.walk():
            read = child.tag in ("link", "joint") and any(
                "${" in value or "$(arg" in value for value in element.attributes.values()
            )
            if macros or read or element.tag.startswith("xacro:"):
                raise Place(f"{where}: line {element.line}").error(
                    f"<{element.tag[:40]}> is of xacro, not URDF; expand it first: "
                    f"{_expansion(where)}"
                )


def _expansion(where: str) -> str:
    path = Path(where)
    bare = path.name.removesuffix(".xacro").removesuffix(".urdf")
    out = path.with_name(f"{bare}.urdf" if path.suffix == ".xacro" else f"{bare}_expanded.urdf")
    return f"xacro {shlex.quote(where)} > {shlex.quote(str(out))}"


class _Spot:
    """An element, and its place for messages."""

    def __init__(self, element: Element, where: str, spot: str) -> None:
        self.element = element
        self.place = Place(f"{where}: line {element.line}", spot)
        self._where = where

    def only(self, tag: str) -> "_Spot | None":
        """Its child of that tag, of which it may have one."""
        found = list(self.element.named(tag))
        if len(found) > 1:
            spot = _Spot(found[1], self._where, self.place.spot)
            raise spot.place.error(f"a second <{tag}>; expected one: take out what is not meant")
        return _Spot(found[0], self._where, f"{self.place.spot} <{tag}>") if found else None

    def needed(self, attribute: str, example: str) -> str:
        """An attribute that must be there."""
        value = self.element.attributes.get(attribute, "").strip()
        if not value:
            raise self.place.error(f'{attribute} is missing; write {attribute}="{example}"')
        return value

    def digits(self, attribute: str, default: str, most: float = LARGEST) -> list[str]:
        """The numbers of an attribute as printed, as many as those of the default."""
        text = self.element.attributes.get(attribute, default)
        words, count = text.split(), len(default.split())
        numbers = "a number" if count == 1 else f"{count} numbers"
        place = self.place.at(attribute, text)
        if len(words) != count:
            raise place.mismatch(f'{numbers} such as "{default}"')
        for word in words:
            if len(word) > 100 or not _DECIMAL.fullmatch(word):
                raise place.holding(word).mismatch(f'{numbers} such as "{default}"')
            if abs(float(word)) > most:
                raise place.holding(word).mismatch(f"at most {most:g} in SI units")
        return words

    def value(self, attribute: str, default: str = "0") -> float:
        return float(self.digits(attribute, default)[0])

    def stated(self, attribute: str) -> float | None:
        """A number that may be missing; of a limit, inf says that there is none."""
        text = self.element.attributes.get(attribute, "").strip()
        if not text or text.lower().lstrip("+-") in ("inf", "infinity", ".inf"):
            return None
        return self.value(attribute)


class _Reading:
    """One pass over the elements of a file."""

    def __init__(self, root: Element, where: str, exact: bool) -> None:
        self._root, self._where, self._exact = root, where, exact
        self._rounded: dict[str, str] = {}
        self._zeros = 0
        self._told: dict[str, list[str]] = {}  # what -> of which links and joints
        self._bodies: dict[str, Inertial | None] = {}
        self._doubted: dict[str, str] = {}
        self._unread: dict[str, str] = {}

    def tree(self) -> BodyTree:
        links = self._named("link")
        for name, link in links.items():
            self._bodies[name] = self._body(name, link)
        spots = self._named("joint")
        joints = {name: self._joint(name, spot) for name, spot in spots.items()}
        root = self._first_link(joints, spots)
        joints = self._followers(joints, spots)
        joints = self._motors(joints)
        return BodyTree(
            name=self._root.attributes.get("name", "").strip() or Path(self._where).stem,
            format="URDF",
            root=root,
            bodies=self._bodies,
            joints=tuple(_in_order(joints, root)),
            doubted=self._doubted,
            unread=self._unread,
            notes=tuple(self._notes()),
        )

    def _named(self, tag: str) -> dict[str, _Spot]:
        found: dict[str, _Spot] = {}
        for element in self._root.named(tag):
            name = _Spot(element, self._where, f"<{tag}>").needed("name", f"{tag}1")
            spot = _Spot(element, self._where, f"{tag} {shown(name)}")
            if name in found:
                raise spot.place.error(
                    f"a second {tag} of that name; the first is in line "
                    f"{found[name].element.line}: rename one"
                )
            found[name] = spot
        if tag == "link" and not found:
            raise Place(f"{self._where}: line {self._root.line}").error(
                '<robot> has no link; expected <link name="..."> and <joint name="...">'
            )
        return found

    def _tell(self, what: str, name: str) -> None:
        self._told.setdefault(what, []).append(name)

    # Numbers.

    def _lengths(self, spot: _Spot, attribute: str, default: str, most: float) -> np.ndarray:
        values = np.array([float(word) for word in spot.digits(attribute, default, most)])
        small = (values != 0.0) & (abs(values) < _ZERO)
        if not self._exact and small.any():
            self._zeros += int(small.sum())
            values[small] = 0.0
        return values

    def _angle(self, digits: str) -> float:
        value = float(digits)
        if self._exact or value == 0.0:
            return value
        if abs(value) < _ZERO:
            self._zeros += 1
            return 0.0
        count = twelfths(digits) if 0.2 < abs(value) < 7.0 else None
        if count is None:  # what an exporter's arithmetic left beside a multiple
            count = round(value * 12 / math.pi)
            if count == 0 or abs(value - count * math.pi / 12) > _ZERO:
                return value
        exact = count * math.pi / 12
        if value != exact:
            self._rounded[digits] = pi_multiple(Fraction(count, 12))
        return exact

    def _origin(self, spot: _Spot) -> Pose:
        origin = spot.only("origin")
        if origin is None:
            return Pose()
        xyz = self._lengths(origin, "xyz", "0 0 0", LARGEST_LENGTH)
        return Pose(xyz, _turn(self._angle(word) for word in origin.digits("rpy", "0 0 0")))

    # Links.

    def _body(self, name: str, link: _Spot) -> Inertial | None:
        inertial = link.only("inertial")
        if inertial is None:
            self._tell("no <inertial>: {}; they weigh nothing here", name)
            return None
        mass, tensor = inertial.only("mass"), inertial.only("inertia")
        if mass is None or tensor is None:
            missing = "mass" if mass is None else "inertia"
            raise inertial.place.error(f"<{missing}> is missing; write it, or no <inertial>")
        mass.needed("value", "1.0")
        printed = {}
        for entry in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"):
            tensor.needed(entry, "0.01")
            printed[entry] = tensor.digits(entry, "0.01")[0]
        xx, xy, xz, yy, yz, zz = (float(word) for word in printed.values())
        matrix = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        body = Inertial(mass.value("value"), np.zeros(3), matrix)
        reason = doubt(body, sum(_half_unit(word) for word in printed.values()))
        if reason:
            self._doubted[name] = reason
            self._tell(f"{reason}: {{}}; no prior is made of it", name)
        origin = inertial.only("origin")
        if origin is None:
            return body
        # Measured, and no part of the geometry: as printed.
        centre = [float(word) for word in origin.digits("xyz", "0 0 0", LARGEST_LENGTH)]
        turn = _turn(float(word) for word in origin.digits("rpy", "0 0 0"))
        return body.seen_from(Pose(np.array(centre), turn))

    # Joints.

    def _joint(self, name: str, spot: _Spot) -> TreeJoint:
        kind = spot.needed("type", "revolute").lower()
        if kind in _UNREAD:
            self._unread[name] = f"{spot.place.file}: joint {shown(name)}: {kind}"
        elif kind not in _KINDS:
            raise spot.place.at("type", kind).mismatch(f"{listed(_KINDS)}{near(kind, _KINDS)}")
        joint = TreeJoint(
            name=name,
            kind=_KINDS.get(kind, JointKind.FIXED),
            parent=self._end(spot, "parent"),
            child=self._end(spot, "child"),
            pose=self._origin(spot),
        )
        if joint.kind is JointKind.FIXED:
            return joint
        return self._moving(joint, spot, bounded=kind != "continuous")

    def _end(self, spot: _Spot, end: str) -> str:
        """The link at the end of a joint."""
        inner = spot.only(end)
        if inner is None:
            raise spot.place.error(f'<{end}> is missing; write <{end} link="..."/>')
        link = inner.needed("link", "link1")
        if link not in self._bodies:
            raise inner.place.error(
                f"there is no link {shown(link)}{near(link, self._bodies)}; expected one of the "
                f"{len(self._bodies)} links of the file"
            )
        return link

    def _moving(self, joint: TreeJoint, spot: _Spot, bounded: bool) -> TreeJoint:
        limit, dynamics = spot.only("limit"), spot.only("dynamics")
        lower = upper = speed = effort = None
        if limit is not None:
            lower, upper, speed, effort = (
                limit.stated(key) for key in ("lower", "upper", "velocity", "effort")
            )
            if lower is not None or upper is not None:  # the schema: what is left out is 0
                lower, upper = lower or 0.0, upper or 0.0
        if not bounded:
            lower = upper = None
        elif lower is not None and upper is not None and lower >= upper:
            self._tell("limits that leave no range are not taken: {}", joint.name)
            lower = upper = None
        return replace(
            joint,
            axis=self._axis(joint.name, spot),
            lower=lower,
            upper=upper,
            speed=abs(speed) if speed else None,
            effort=abs(effort) if effort else None,
            damping=self._loss(joint.name, dynamics, "damping"),
            friction=self._loss(joint.name, dynamics, "friction"),
        )

    def _loss(self, name: str, dynamics: _Spot | None, key: str) -> float | None:
        value = None if dynamics is None else dynamics.stated(key)
        if value is not None and value < 0.0:
            self._tell(f"negative {key} is not taken: {{}}", name)
            return None
        return value

    def _axis(self, name: str, spot: _Spot) -> np.ndarray:
        inner = spot.only("axis")
        if inner is None:
            return np.array([1.0, 0.0, 0.0])
        inner.needed("xyz", "0 0 1")
        axis = np.array([float(word) for word in inner.digits("xyz", "1 0 0")])
        length = float(np.linalg.norm(axis))
        if length < _ZERO:
            raise inner.place.at("xyz", inner.element.attributes["xyz"]).mismatch(
                'a direction such as "0 0 1"'
            )
        if abs(length - 1.0) > 1e-3:
            self._tell("axes that are not of length 1 are taken as directions: {}", name)
        axis /= length
        small = (axis != 0.0) & (abs(axis) < _ZERO)
        if not self._exact and small.any():
            self._zeros += int(small.sum())
            axis[small] = 0.0
        return np.asarray(axis / np.linalg.norm(axis) + 0.0)

    def _first_link(self, joints: Mapping[str, TreeJoint], spots: Mapping[str, _Spot]) -> str:
        """The link that no joint moves; the only one, or it is told what is wrong."""
        above: dict[str, TreeJoint] = {}
        for joint in joints.values():
            other = above.setdefault(joint.child, joint)
            if other is not joint:
                raise spots[joint.name].place.error(
                    f"link {shown(joint.child)} is the child of joint {shown(other.name)} too; "
                    "expected one parent: a URDF is a tree, close loops in the robot file"
                )
        first = [name for name in self._bodies if name not in above]
        if len(first) > 1:
            line = self._root.line
            raise Place(f"{self._where}: line {line}").error(
                f"no joint leads to {len(first)} links, {_several(first)}; expected one first "
                "link: join the others to it by fixed joints, or take them out"
            )
        reached = set(first)
        for joint in _in_order(joints, first[0]) if first else ():
            reached.add(joint.child)
        if len(reached) < len(self._bodies):
            link = next(name for name in self._bodies if name not in reached)
            way: list[str] = []
            while link not in way:
                way.append(link)
                link = above[link].parent
            circle = way[way.index(link) :]
            raise spots[above[circle[0]].name].place.error(
                f"links are parents of each other in a circle: {_several(circle)}; mend the parent "
                "of one"
            )
        return first[0]

    def _followers(
        self, joints: Mapping[str, TreeJoint], spots: Mapping[str, _Spot]
    ) -> dict[str, TreeJoint]:
        """With the mimic joints following one that is not led itself."""
        direct: dict[str, tuple[str, float, float]] = {}
        for name, joint in joints.items():
            mimic = spots[name].only("mimic")
            if mimic is None or (joint.kind is JointKind.FIXED and name not in self._unread):
                continue
            leader = mimic.needed("joint", "joint1")
            if leader not in joints:
                raise mimic.place.error(f"there is no joint {shown(leader)}{near(leader, joints)}")
            direct[name] = leader, mimic.value("multiplier", "1"), mimic.value("offset")
        found = dict(joints)
        for name in direct:
            leader, ratio, offset, seen = name, 1.0, 0.0, {name}
            while leader in direct:
                above, times, plus = direct[leader]
                ratio, offset, leader = ratio * times, ratio * plus + offset, above
                if leader in seen:
                    raise spots[name].place.error(
                        "follows itself by <mimic>; let one of the joints lead"
                    )
                seen.add(leader)
            if ratio == 0.0 or joints[leader].kind is JointKind.FIXED:
                found[name] = held(joints[name], offset)
                self._tell("what they mimic does not move, so they are fixed: {}", name)
            else:
                found[name] = replace(
                    joints[name], leader=leader, ratio=ratio, offset=offset, actuated=False
                )
        return found

    def _motors(self, joints: dict[str, TreeJoint]) -> dict[str, TreeJoint]:
        """With armature = gear ratio squared times rotor inertia, where transmissions state both.

        The gear ratio is `mechanicalReduction`; the inertia Drake's `drake:rotor_inertia` with
        `drake:gear_ratio` (drake.mit.edu, "Reflected inertia"), or a `motorInertia`.
        """
        for element in self._root.named("transmission"):
            spot = _Spot(element, self._where, "<transmission>")
            tags = {inner.tag: inner for inner in element.walk()}
            rotor = tags.get("drake:rotor_inertia") or tags.get("motorInertia")
            names = [inner.attributes.get("name", "") for inner in element.named("joint")]
            if rotor is None or len(names) != 1 or names[0] not in joints:
                continue
            gear = tags.get("drake:gear_ratio") or tags.get("mechanicalReduction")
            inertia = _transmitted(spot, rotor)
            armature = inertia * (1.0 if gear is None else _transmitted(spot, gear)) ** 2
            joint = joints[names[0]]
            joints[joint.name] = replace(joint, armature=armature + (joint.armature or 0.0))
            self._tell("armature is gear ratio squared times rotor inertia: {}", joint.name)
        return joints

    def _notes(self) -> Iterable[str]:
        if self._rounded:
            most = dict(list(self._rounded.items())[:_MOST_NAMED])
            rest = len(self._rounded) - len(most)
            yield told_angles(most) + (f" and {rest} more" if rest else "")
        if self._zeros:
            yield f"{self._zeros} lengths, angles and parts of axes below {_ZERO:g} are 0 here"
        for what, names in self._told.items():
            yield what.format(_several(names))


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


def _transmitted(spot: _Spot, element: Element) -> float:
    text = element.attributes.get("value", element.text)
    if not _DECIMAL.fullmatch(text):
        raise spot.place.at(f"<{element.tag}>", text).mismatch("a number such as 100")
    return float(text)


def _in_order(joints: Mapping[str, TreeJoint], root: str) -> list[TreeJoint]:
    """Every joint after that which moves its parent, else as they come; only what root leads to."""
    after: dict[str, list[int]] = {}
    every = list(joints.values())
    for place, joint in enumerate(every):
        after.setdefault(joint.parent, []).append(place)
    waiting, found = list(after.get(root, ())), []
    while waiting:
        joint = every[heapq.heappop(waiting)]
        found.append(joint)
        for place in after.get(joint.child, ()):
            heapq.heappush(waiting, place)
    return found


def _several(names: Iterable[str]) -> str:
    """`"a", "b" and 12 more`: each once, and not more than anybody reads."""
    each = list(dict.fromkeys(names))
    rest = f" and {len(each) - _MOST_NAMED} more" if len(each) > _MOST_NAMED else ""
    return ", ".join(shown(name) for name in each[:_MOST_NAMED]) + rest
