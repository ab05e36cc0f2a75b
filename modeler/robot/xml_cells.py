"""Elements of a URDF with their place: numbers, names and children, each refused in one line."""

import math
import re
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from modeler.core.toml_cells import LARGEST, TomlCell, quote_value
from modeler.robot.body_tree import NOUGHT, Pose, Roundings, compute_axis_rotation
from modeler.robot.cells import LARGEST_LENGTH
from modeler.robot.quaternions import compute_quaternion_rotation, snap_quaternion
from modeler.robot.xml_source import Element

_DECIMAL = re.compile(r"[+-]?(?:\d+\.?(\d*)|\.(\d+))(?:[eE]([+-]?\d{1,4}))?", re.ASCII)


class Spot:
    """An element, or one that is not given, and its place for messages."""

    def __init__(self, element: Element, where: str, spot: str, is_given: bool = True) -> None:
        self.element, self.is_given, self._where = element, is_given, where
        self.place = TomlCell(f"{where}: line {element.line}", spot)

    def find_child(self, tag: str) -> "Spot":
        """Its child of that tag, of which it may have one."""
        children = self.element.find_children(tag)
        if len(children) > 1:
            self.place = TomlCell(f"{self._where}: line {children[1].line}", self.place.location)
            raise self.place.make_error(
                f"a second <{tag}>; expected one: take out what is not meant"
            )
        inner = children[0] if children else Element(tag, {}, self.element.line, {}, (0, 0))
        return Spot(inner, self._where, f"{self.place.location} <{tag}>", bool(children))

    def find_children(self, *tags: str) -> "list[Spot]":
        """Its children of these tags."""
        return [
            Spot(
                e,
                self._where,
                f"{e.tag} {quote_value(name)}" if (name := _get_name(e)) else f"<{e.tag}>",
            )
            for e in self.element.find_children(*tags)
        ]

    @property
    def name(self) -> str:
        """Of the element; "" without one."""
        return _get_name(self.element)

    def get_text(self, attribute: str) -> str:
        """An attribute; "" without it."""
        return self.element.attributes.get(attribute, "").strip()

    def merge_children(self, *keys: str) -> "Spot":
        """Itself, with what children of these tags, or params of these names, say as attributes.

        Raises:
            RobotError: two children that say different things under one name.
        """
        values = dict[str, str]()
        for child in self.element.children:
            key = _get_name(child) if child.tag == "param" else child.tag
            text = child.attributes.get("value", child.text).strip()
            if key in keys and values.setdefault(key, text) != text:
                raise self.place.make_error(f"a second <{child.tag}>; take out what is not meant")
        values = {**{key: text for key, text in values.items() if text}, **self.element.attributes}
        return Spot(
            replace(self.element, attributes=values),
            self._where,
            self.place.location,
            self.is_given,
        )

    def require_child(self, tag: str, example: str) -> "Spot":
        """Its child of that tag, which it must have."""
        if not (child := self.find_child(tag)).is_given:
            raise self.place.make_error(f"<{tag}> is missing; write <{tag} {example}/>")
        return child

    def require_attribute(self, attribute: str, example: str) -> str:
        """An attribute that must be there."""
        if not (value := self.element.attributes.get(attribute, "").strip()):
            raise self.place.make_error(f'{attribute} is missing; write {attribute}="{example}"')
        return value

    def read_digits(self, attribute: str, default: str, most: float = LARGEST) -> list[str]:
        """The numbers of an attribute as printed, as many as those of the default."""
        text = self.element.attributes.get(attribute, default)
        place, words, count = self.place.enter(attribute, text), text.split(), len(default.split())
        expected = f'{"a number" if count == 1 else f"{count} numbers"} such as "{default}"'
        if len(words) != count:
            raise place.make_mismatch(expected)
        for word in words:
            check_number(place.with_value(word), expected, most)
        return words

    def read_numbers(self, attribute: str, default: str, most: float = LARGEST) -> np.ndarray:
        """The same as numbers."""
        return np.array([float(word) for word in self.read_digits(attribute, default, most)])

    def read_optional_number(self, attribute: str) -> float | None:
        """A number that may be missing; what is infinite, or as good as that, sets no limit."""
        text = self.element.attributes.get(attribute, "").strip()
        if not text or text.lower().lstrip("+-") in ("inf", "infinity", ".inf"):
            return None
        value = float(self.read_digits(attribute, "0", math.inf)[0])
        return value if abs(value) <= LARGEST else None

    def read_direction(self, attribute: str, default: str) -> np.ndarray:
        """(3,) a direction, of length one."""
        axis = self.read_numbers(attribute, default)
        length = float(np.linalg.norm(axis))
        if length < NOUGHT:
            place = self.place.enter(attribute, self.element.attributes.get(attribute, ""))
            raise place.make_mismatch('a direction such as "0 0 1"')
        return axis / length


def _get_name(element: Element) -> str:
    return element.attributes.get("name", "").strip()


def read_pose(origin: Spot, rounded: Roundings) -> Pose:
    """Of xyz, and of rpy or of quat_xyzw.

    Raises:
        RobotError: both, or a quaternion 0.
    """
    xyz = rounded.snap_lengths(origin.read_numbers("xyz", "0 0 0", LARGEST_LENGTH))
    if "quat_xyzw" not in origin.element.attributes:
        return Pose(
            xyz, compute_rpy_rotation(map(rounded.snap_angle, origin.read_digits("rpy", "0 0 0")))
        )
    if "rpy" in origin.element.attributes:
        raise origin.place.make_error("states rpy and quat_xyzw; keep the one that is meant")
    turn = np.roll(origin.read_numbers("quat_xyzw", "0 0 0 1"), 1)
    if float(np.linalg.norm(turn)) < NOUGHT:
        place = origin.place.enter("quat_xyzw", origin.element.attributes["quat_xyzw"])
        raise place.make_mismatch('a quaternion such as "0 0 0 1"')
    return Pose(
        xyz, compute_quaternion_rotation(turn if rounded.exact else snap_quaternion(turn, rounded))
    )


def compute_rpy_rotation(angles: Iterable[float]) -> np.ndarray:
    """(3, 3) of roll, pitch, yaw about fixed axes: Rz(yaw) Ry(pitch) Rx(roll)."""
    rotation = np.eye(3)
    for axis, angle in zip(np.eye(3), angles, strict=True):
        rotation = compute_axis_rotation(axis, angle) @ rotation
    return np.asarray(rotation + 0.0)


def check_number(place: TomlCell, expected: str, most: float = LARGEST) -> None:
    """Refuse what is no decimal number, or one that is too large."""
    if len(place.value) > 100 or not _DECIMAL.fullmatch(place.value):
        raise place.make_mismatch(expected)
    if abs(float(place.value)) > most:
        raise place.make_mismatch(f"at most {most:g} in SI units")


def compute_half_unit(digits: str) -> float:
    """Half a unit of the last printed digit."""
    number_match = _DECIMAL.fullmatch(digits)
    assert number_match is not None
    return 0.5 * 10.0 ** (
        max(int(number_match[3] or 0), -300) - len(number_match[1] or number_match[2] or "")
    )
