"""The bytes of an original with other numbers: masses, centres, inertias, joint resistance.

All that is no such number stays as it is, byte for byte. A number that the file does not have is
put in the smallest way: an attribute, or one element.
"""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain

import numpy as np

from modeler.core.errors import DataError
from modeler.formats.bodies import ExportParameters, compute_central_parameters, express_parameters
from modeler.formats.body_tree import compute_standard_parameters
from modeler.formats.original import (
    TENSOR,
    OriginalFile,
    PlacedLinks,
    Placement,
    distribute_change,
    find_first_child,
    find_inertial_axes,
    get_text_at,
)
from modeler.formats.result import (
    Value,
    build_body_values,
    build_drive_values,
    compute_sigmas,
    format_numbers,
    keep_unchanged,
)
from modeler.formats.thresholds import THRESHOLDS
from modeler.formats.xml_source import Element, replace_spans

_TURNED = ("diaginertia", "quat", "axisangle", "xyaxes", "zaxis", "euler")
_RESCALED = ("settotalmass", "boundmass", "boundinertia")
_RESISTS = ("damping", "friction", "armature", "stiffness")
_PATHS = {
    "urdf": {
        "mass": "inertial/mass@value",
        "centre": "inertial/origin@xyz",
        "tensor": "inertial/inertia@{}",
        "damping": "dynamics@damping",
        "friction": "dynamics@friction",
    },
    "sdf": {
        "mass": "inertial/mass",
        "centre": "inertial/pose",
        "tensor": "inertial/inertia/{}",
        "damping": "axis/dynamics/damping",
        "friction": "axis/dynamics/friction",
        "stiffness": "axis/dynamics/spring_stiffness",
    },
    "mjcf": {
        "mass": "inertial@mass",
        "centre": "inertial@pos",
        "tensor": "inertial@fullinertia",
        "damping": "@damping",
        "friction": "@frictionloss",
        "armature": "@armature",
        "stiffness": "@stiffness",
    },
}
"""Where numbers stand in a link or a joint: elements, and behind @ an attribute."""


@dataclass(eq=False)
class FileEdits:
    """A file, and what is going to stand in place of some of its bytes."""

    source: OriginalFile
    changes: dict[tuple[int, int], str] = field(default_factory=dict)
    new: dict[int, tuple[Element, ET.Element]] = field(default_factory=dict)

    def set_number(self, element: Element, path: str, text: str) -> None:
        """Puts a number at a path, of which parts may not be there."""
        element_path, _, attribute = path.partition("@")
        tags = [tag for tag in element_path.split("/") if tag]
        while tags and (child := find_first_child(element, tags[0])) is not None:
            element = child
            tags.pop(0)
        if tags:
            new_element = self.new.setdefault(id(element), (element, ET.Element("new")))[1]
            for tag in tags:
                inner = new_element.find(tag)
                new_element = ET.SubElement(new_element, tag) if inner is None else inner
            new_element.attrib |= {attribute: text} if attribute else {}
            new_element.text = None if attribute else text
        elif attribute:
            self._set_attribute(element, attribute, text)
        elif element.text_span is not None:
            self.changes[element.text_span] = text
        else:
            self._insert_child_text(element, text)

    def _set_attribute(self, element: Element, name: str, text: str) -> None:
        if name in element.spans:
            self.changes[element.spans[name]] = text
            return
        end = element.opening[1] - 1
        end -= self.source.data[end - 1 : end] == b"/"
        while self.source.data[end - 1 : end].isspace():
            end -= 1
        self.changes[end, end] = f'{self.changes.get((end, end), "")} {name}="{text}"'

    def remove_attribute(self, element: Element, name: str) -> None:
        """Takes an attribute out."""
        start, end = element.spans[name]
        head = self.source.data[element.opening[0] : start]
        attribute_match = re.search(rb"\s+[^\s=]+\s*=\s*[\"']\Z", head)
        assert attribute_match is not None
        self.changes[element.opening[0] + attribute_match.start(), end + 1] = ""

    def _insert_child_text(self, parent: Element, text: str) -> None:
        """Puts text before the first child, in a line of its own where that has one."""
        data, end = self.source.data, parent.opening[1]
        if data[end - 2 : end] == b"/>":
            self.changes[end - 2, end] = f">{text}</{parent.tag}>"
            return
        at = parent.children[0].opening[0] if parent.children else parent.closing[0]
        line = data.rfind(b"\n", 0, at) + 1
        if parent.children and not data[line:at].strip():
            text += "\r\n" if data[line - 2 : line] == b"\r\n" else "\n"
            text += data[line:at].decode()
        self.changes[at, at] = text

    def render_bytes(self) -> bytes:
        """Returns the file."""
        for element, new_root in self.new.values():
            text = "".join(ET.tostring(child, "unicode") for child in new_root)
            self._insert_child_text(element, text.replace(" />", "/>"))
        return replace_spans(self.source.data, self.changes)


def rewrite_file(
    physics: ExportParameters, source: OriginalFile, placement: Placement, notes: list[str]
) -> tuple[bytes, list[Value]]:
    """Returns the file with the numbers of the physics, and these; notes grow.

    Raises:
        DataError: MJCF that states no numbers itself, or changes those that it states.
    """
    edited = _NumberEditor(source)
    values = [
        value
        for row, placed_links in placement.links.items()
        for value in edited.edit_link(physics, row, placed_links, notes)
    ]
    for name, row in placement.joints.items():
        if source.tree is not None or ("joint", name) in edited.elements:
            values += edited.edit_joint(physics, row, name)
    return edited.file.render_bytes(), values


class _NumberEditor:
    """Links and joints of a file, and their new numbers."""

    def __init__(self, source: OriginalFile) -> None:
        self.source, self.file, self.paths = source, FileEdits(source), _PATHS[source.format]
        named = _collect_mjcf_elements if source.format == "mjcf" else _collect_elements
        self.elements = named(source.root)
        self.joints = {joint.name: joint for joint in source.tree.joints} if source.tree else {}
        self.checked = source.format != "mjcf"

    def edit_link(
        self, physics: ExportParameters, row: str, placed_links: PlacedLinks, notes: list[str]
    ) -> Iterator[Value]:
        """Puts the numbers of the links of a row."""
        ten = physics.get_link_parameters(row)
        if ten is None or (physics.fit is None and row not in physics.stated_links):
            return
        tens = placed_links.parameters
        others = ", ".join(name for name in tens if name != placed_links.carrier)
        whole = np.sum([np.zeros(10), *tens.values()], axis=0)
        if _is_same_body(ten, whole):
            now = tens
        elif row in physics.released_links and tens:
            now = distribute_change(tens, ten)
            notes.append(f"{placed_links.carrier}: what hangs on it is changed with it: {others}")
        else:
            carried = tens.get(placed_links.carrier, np.zeros(10))
            now = {**tens, placed_links.carrier: ten - whole + carried}
            if others:
                notes.append(f"{placed_links.carrier}: what changes is on it; {others} as before")
        for name, new in now.items():
            pose, was = placed_links.poses[name], self.source.links[name]
            axes = find_inertial_axes(self.source, self.elements.get(("link", name)))
            before = None
            if was is not None:
                before = compute_central_parameters(compute_standard_parameters(was), axes)
            own = express_parameters(new, pose.inverse())
            fresh = keep_unchanged(compute_central_parameters(own, axes), before)
            if before is not None and now is tens:
                fresh = before
            if before is None or np.any(fresh != before):
                self._edit_body(self._find_element("link", name), fresh, before)
            elif name != placed_links.carrier:
                continue
            in_part = row in physics.released_links  # only of the link
            sigma = None if in_part else compute_sigmas(physics, row, pose, ten - new, axes)
            yield from build_body_values(name, before, fresh, sigma)

    def _edit_body(self, link: Element, new: np.ndarray, was: np.ndarray | None) -> None:
        bare = was is None or find_first_child(link, "inertial") is None
        other = np.full(10, True) if bare else new != was
        if not self.checked:
            _check_mjcf(self.source)
            self.checked = True
        sdf, mjcf = (self.source.format == name for name in ("sdf", "mjcf"))
        if other[0]:
            self.file.set_number(link, self.paths["mass"], format_numbers(new[:1]))
        if other[1:4].any():
            words = get_text_at(link, self.paths["centre"]).split()
            angles = (words[3:] or ["0 0 0"]) if sdf else []
            text = " ".join([format_numbers(new[1:4]), *angles])
            self.file.set_number(link, self.paths["centre"], text)
        if mjcf and other[4:].any():
            inertial = find_first_child(link, "inertial")
            for name in _TURNED if inertial is not None else ():
                if inertial is not None and name in inertial.spans:
                    self.file.remove_attribute(inertial, name)
            text = format_numbers(new[[4, 7, 9, 5, 6, 8]])
            self.file.set_number(link, self.paths["tensor"], text)
        for k, key in enumerate(() if mjcf or not other[4:].any() else TENSOR, 4):
            path = self.paths["tensor"].format(key)
            if other[k] or not get_text_at(link, path):
                self.file.set_number(link, path, format_numbers(new[[k]]))

    def edit_joint(self, physics: ExportParameters, row: str, name: str) -> list[Value]:
        """Writes what resists a joint, and returns the values of it."""
        stated = self.joints.get(name)
        if stated is None:
            paths = {
                quantity: path for quantity, path in self.paths.items() if quantity in _RESISTS
            }
            element = self._find_element("joint", name)
            texts = {quantity: get_text_at(element, path) for quantity, path in paths.items()}
            was = {quantity: float(text or 0.0) for quantity, text in texts.items()}
        else:
            was = {quantity: float(getattr(stated, quantity) or 0.0) for quantity in _RESISTS}
        joint = physics.robot.get_joint(row)
        values = list(build_drive_values(physics, joint, name, self.source.format, was))
        for value in values:
            if value.is_changed:
                self._edit_resistance(name, value)
        return values

    def _edit_resistance(self, name: str, value: Value) -> None:
        if value.quantity in ("armature", "damping") and _has_actuator_terms(self.source.root):
            raise DataError(
                f"--like {self.source.path}: actuators state armature or damping of their own, and "
                f"{name} would have it twice; move it to the joints (times gear^2)"
            )
        element, path = self._find_element("joint", name), self.paths[value.quantity]
        _, *further = get_text_at(element, path).split() or [""]  # of a polynomial
        self.file.set_number(element, path, " ".join([format_numbers([value.after]), *further]))

    def _find_element(self, kind: str, name: str) -> Element:
        if (kind, name) not in self.elements:
            raise DataError(
                f"--like {self.source.path}: {kind} {name} does not stand in the file itself "
                "(<include>, <attach>, <replicate>); save it as one file (mj_saveLastXML), and "
                "give that"
            )
        return self.elements[kind, name]


def _collect_elements(root: Element) -> dict[tuple[str, str], Element]:
    """Links and joints of URDF (<transmission> names joints too) and SDF."""
    parts = root.children if root.tag == "robot" else root.iterate_elements()
    named = [element for element in parts if element.tag in ("link", "joint")]
    return {(e.tag, e.attributes.get("name", "").strip()): e for e in named}


def _collect_mjcf_elements(root: Element) -> dict[tuple[str, str], Element]:
    """Bodies and joints, those without a name by their number, as the reader calls them."""
    inside = (world.iterate_elements() for world in root.find_children("worldbody"))
    bodies = [element for element in chain(*inside) if element.tag == "body"]
    joints = [joint for body in bodies for joint in _iterate_joints(body)]
    links = {("link", e.attributes.get("name") or f"body{k}"): e for k, e in enumerate(bodies, 1)}
    names = [e.attributes.get("name") or f"joint{k}" for k, e in enumerate(joints)]
    return links | {("joint", name): e for name, e in zip(names, joints, strict=True)}


def _iterate_joints(element: Element) -> Iterator[Element]:
    """Joints of a body, those in frames too, in file order."""
    for child in element.children:
        if child.tag in ("joint", "freejoint"):
            yield child
        elif child.tag == "frame":
            yield from _iterate_joints(child)


def _has_actuator_terms(root: Element) -> bool:
    """Whether actuators of MJCF have armature or damping."""
    parts = chain(*(part.iterate_elements() for part in root.find_children("actuator")))
    return any({"armature", "damping"} & element.attributes.keys() for element in parts)


def _check_mjcf(source: OriginalFile) -> None:
    """Refuse files of which MuJoCo changes the numbers that they state."""
    for element in source.root.iterate_elements():
        stated = element.attributes
        wrong = [
            f"{key} changes the masses that are stated; take it out"
            for key in _RESCALED
            if float(stated.get(key, "0")) > 0.0
        ]
        if stated.get("inertiafromgeom") == "true":
            wrong.append('inertiafromgeom="true" takes all masses from geoms; write "auto" there')
        if "springdamper" in stated:
            todo = "write stiffness and damping instead"
            wrong.append(f"springdamper makes damping of masses; {todo}")
        if wrong:
            raise DataError(f"--like {source.path}: line {element.line}: {wrong[0]}")


def _is_same_body(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two bodies are the same but for rounding, in the same frame."""
    size, mass = max(np.abs([one[:6], other[:6]]).max(), 1e-300), max(abs(one[9]), abs(other[9]))
    moment = max(np.sqrt(size * mass), np.abs(other[6:9]).max())
    scale = np.repeat([size, moment, mass], [6, 3, 1])
    return bool(np.all(np.abs(one - other) <= THRESHOLDS.max_same_body_difference * scale))
