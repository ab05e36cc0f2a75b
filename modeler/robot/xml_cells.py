"""Elements of a URDF with their place: numbers, names and children, each refused in one line."""

import math
import re
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from modeler.core.toml_cells import LARGEST, Place, shown
from modeler.robot.body_tree import NOUGHT, Pose, Roundings, turned
from modeler.robot.cells import LARGEST_LENGTH
from modeler.robot.quaternions import exact_quaternion, rotation_matrix
from modeler.robot.xml_source import Element

_DECIMAL = re.compile(r"[+-]?(?:\d+\.?(\d*)|\.(\d+))(?:[eE]([+-]?\d{1,4}))?", re.ASCII)


class Spot:
    """An element, or one that is not given, and its place for messages."""

    def __init__(self, element: Element, where: str, spot: str, given: bool = True) -> None:
        self.element, self.given, self._where = element, given, where
        self.place = Place(f"{where}: line {element.line}", spot)

    def only(self, tag: str) -> "Spot":
        """Its child of that tag, of which it may have one."""
        found = self.element.named(tag)
        if len(found) > 1:
            self.place = Place(f"{self._where}: line {found[1].line}", self.place.spot)
            raise self.place.error(f"a second <{tag}>; expected one: take out what is not meant")
        inner = found[0] if found else Element(tag, {}, self.element.line, {}, (0, 0))
        return Spot(inner, self._where, f"{self.place.spot} <{tag}>", bool(found))

    def all(self, *tags: str) -> "list[Spot]":
        """Its children of these tags."""
        return [
            Spot(e, self._where, f"{e.tag} {shown(name)}" if (name := _name(e)) else f"<{e.tag}>")
            for e in self.element.named(*tags)
        ]

    @property
    def name(self) -> str:
        """Of the element; "" without one."""
        return _name(self.element)

    def said(self, attribute: str) -> str:
        """An attribute; "" without it."""
        return self.element.attributes.get(attribute, "").strip()

    def flat(self, *keys: str) -> "Spot":
        """Itself, with what children of these tags, or params of these names, say as attributes.

        Raises:
            RobotError: two children that say different things under one name.
        """
        own = dict[str, str]()
        for child in self.element.children:
            key = _name(child) if child.tag == "param" else child.tag
            text = child.attributes.get("value", child.text).strip()
            if key in keys and own.setdefault(key, text) != text:
                raise self.place.error(f"a second <{child.tag}>; take out what is not meant")
        own = {**{key: text for key, text in own.items() if text}, **self.element.attributes}
        return Spot(replace(self.element, attributes=own), self._where, self.place.spot, self.given)

    def must(self, tag: str, example: str) -> "Spot":
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
            check_number(place.holding(word), expected, most)
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

    def direction(self, attribute: str, default: str) -> np.ndarray:
        """(3,) a direction, of length one."""
        axis = self.numbers(attribute, default)
        length = float(np.linalg.norm(axis))
        if length < NOUGHT:
            place = self.place.at(attribute, self.element.attributes.get(attribute, ""))
            raise place.mismatch('a direction such as "0 0 1"')
        return axis / length


def _name(element: Element) -> str:
    return element.attributes.get("name", "").strip()


def pose_of(origin: Spot, rounded: Roundings) -> Pose:
    """Of xyz, and of rpy or of quat_xyzw.

    Raises:
        RobotError: both, or a quaternion 0.
    """
    xyz = rounded.lengths(origin.numbers("xyz", "0 0 0", LARGEST_LENGTH))
    if "quat_xyzw" not in origin.element.attributes:
        return Pose(xyz, rotation_of(map(rounded.angle, origin.digits("rpy", "0 0 0"))))
    if "rpy" in origin.element.attributes:
        raise origin.place.error("states rpy and quat_xyzw; keep the one that is meant")
    turn = np.roll(origin.numbers("quat_xyzw", "0 0 0 1"), 1)
    if float(np.linalg.norm(turn)) < NOUGHT:
        place = origin.place.at("quat_xyzw", origin.element.attributes["quat_xyzw"])
        raise place.mismatch('a quaternion such as "0 0 0 1"')
    return Pose(xyz, rotation_matrix(turn if rounded.exact else exact_quaternion(turn, rounded)))


def rotation_of(angles: Iterable[float]) -> np.ndarray:
    """(3, 3) of roll, pitch, yaw about fixed axes: Rz(yaw) Ry(pitch) Rx(roll)."""
    found = np.eye(3)
    for axis, angle in zip(np.eye(3), angles, strict=True):
        found = turned(axis, angle) @ found
    return np.asarray(found + 0.0)


def check_number(place: Place, expected: str, most: float = LARGEST) -> None:
    """Refuse what is no decimal number, or one that is too large."""
    if len(place.value) > 100 or not _DECIMAL.fullmatch(place.value):
        raise place.mismatch(expected)
    if abs(float(place.value)) > most:
        raise place.mismatch(f"at most {most:g} in SI units")


def half_unit(digits: str) -> float:
    """Half a unit of the last printed digit."""
    found = _DECIMAL.fullmatch(digits)
    assert found is not None
    return 0.5 * 10.0 ** (max(int(found[3] or 0), -300) - len(found[1] or found[2] or ""))
