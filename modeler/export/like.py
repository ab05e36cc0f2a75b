"""The bytes of an original with other numbers: masses, centres, inertias, what resists its joints.

All that is no such number stays as it is, byte for byte. A number that the file does not have is
put in the smallest way: an attribute, or one element.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from modeler.core.errors import DataError
from modeler.export.bodies import Physics, carried, written
from modeler.export.fresh import numbers
from modeler.export.linkage import from_rpy
from modeler.export.original import Placed, Source, first, joint_rows, sdf_pose, shared_out
from modeler.export.result import Value, body_values, drive_values, plain_values
from modeler.robot import Element, Inertial, about_origin, replaced

_SAME = 1e-10  # of a body's scale: what is nearer has not changed
_TURNED = ("quat", "axisangle", "xyaxes", "zaxis", "euler")
_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_RESCALED = ("settotalmass", "boundmass", "boundinertia")


@dataclass(eq=False)
class Edited:
    """A file, and what is going to stand in place of some of its bytes."""

    source: Source
    changes: dict[tuple[int, int], str] = field(default_factory=dict)

    def attribute(self, element: Element, name: str, text: str) -> None:
        """Puts the value of an attribute, which may not be there."""
        if name in element.spans:
            self.changes[element.spans[name]] = text
        else:
            end = element.opening[1] - 1
            end -= self.source.data[end - 1 : end] == b"/"
            while self.source.data[end - 1 : end].isspace():
                end -= 1
            self.changes[end, end] = f'{self.changes.get((end, end), "")} {name}="{text}"'

    def without(self, element: Element, name: str) -> None:
        """Takes an attribute out."""
        start, end = element.spans[name]
        head = self.source.data[element.opening[0] : start]
        found = re.search(rb"\s+[^\s=]+\s*=\s*[\"']\Z", head)
        assert found is not None
        self.changes[element.opening[0] + found.start(), end + 1] = ""

    def text(self, element: Element, text: str) -> None:
        """Puts the text of an element."""
        if element.text_span is not None:
            self.changes[element.text_span] = text
        else:
            self.child(element, text, first=True)

    def child(self, parent: Element, text: str, first: bool = False) -> None:
        """Puts an element into another, before its first child or behind its last."""
        data, end = self.source.data, parent.opening[1]
        if data[end - 2 : end] == b"/>":
            self.changes[end - 2, end] = f">{text}</{parent.tag}>"
            return
        child = parent.children[0] if parent.children else None
        at = child.opening[0] if child and first else parent.closing[0]
        line = data.rfind(b"\n", 0, at) + 1
        inner = (
            data[data.rfind(b"\n", 0, child.opening[0]) + 1 : child.opening[0]] if child else b""
        )
        own = data[line:at]
        if own.strip() or inner.strip() or not child:
            self.changes[at, at] = self.changes.get((at, at), "") + text
            return
        end_of_line = "\r\n" if data[line - 2 : line] == b"\r\n" else "\n"
        before, behind = ("", inner) if first else (inner[len(own) :].decode(), own)
        self.changes[at, at] = (
            self.changes.get((at, at), "") + before + text + end_of_line + behind.decode()
        )

    def bytes(self) -> bytes:
        """The file."""
        return replaced(self.source.data, self.changes)


@dataclass(frozen=True, eq=False)
class Body:
    """A link as it is to stand in the file.

    Attributes:
        name: of the link.
        ten: (10,) in its frame.
        was: what stood there.
    """

    name: str
    ten: np.ndarray
    was: Inertial | None


def rewritten(
    physics: Physics, source: Source, links: Mapping[str, Placed], notes: list[str]
) -> tuple[bytes, list[Value]]:
    """The file with the numbers of the physics, and these; notes grow.

    Raises:
        DataError: MJCF that states no numbers itself, or changes those that it states.
    """
    edited, values = Edited(source), list[Value]()
    kinds: dict[str, type[_Urdf] | type[_Mjcf] | type[_Sdf]]
    kinds = {"urdf": _Urdf, "mjcf": _Mjcf, "sdf": _Sdf}
    kind = kinds[source.format](edited)
    for row, own in links.items():
        ten = physics.ten(row)
        if ten is None or (physics.fit is None and row not in physics.stated):
            continue
        tens = {
            name: carried(about_origin(body), pose)
            for name, pose in own.poses.items()
            if (body := source.links[name]) is not None
        }
        whole = np.sum([np.zeros(10), *tens.values()], axis=0)
        if _alike(ten, whole):
            now = tens
        elif row in physics.released and tens:
            now = shared_out(tens, ten)
            notes.append(
                f"{own.carrier}: what hangs on it would weigh too much for the fit and is changed "
                f"with it: {', '.join(name for name in tens if name != own.carrier)}"
            )
        else:
            hung = whole - tens.get(own.carrier, np.zeros(10))
            now = {**tens, own.carrier: ten - hung}
            if len(tens) > 1 or own.carrier not in tens:
                others = ", ".join(name for name in tens if name != own.carrier)
                if others:
                    notes.append(f"{own.carrier}: what changes is on it; {others} as before")
        for name, new in now.items():
            pose, was = own.poses[name], source.links[name]
            axes = kind.axes(name)
            before = None if was is None else written(about_origin(was), axes)
            if not (name in tens and _alike(new, tens[name])):
                kind.body(Body(name, carried(new, pose.inverse()), was), axes)
            elif name != own.carrier:
                continue
            if row in physics.released:  # in part only of the link
                values += plain_values(name, before, written(carried(new, pose.inverse()), axes))
            else:
                values += body_values(physics, row, name, before, pose, ten - new, axes)
    rows = joint_rows(source, physics.robot)
    joints = {joint.name: joint for joint in source.tree.joints} if source.tree else {}
    for name, row in rows.items():
        stated = joints.get(name)
        resists = {
            quantity: float(getattr(stated, quantity) or 0.0)
            for quantity in ("damping", "friction", "armature", "stiffness")
        } if stated else kind.stated(name)  # fmt: skip
        found = list(drive_values(physics, physics.robot.joint(row), name, source.format, resists))
        moved = {
            value.quantity: value.now
            for value in found
            if abs(value.now - (value.was or 0.0)) > 1e-12 * abs(value.now)
        }
        if moved:
            kind.drive(name, moved)
        values += found
    return edited.bytes(), values


def _alike(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two bodies are the same but for rounding, in the same frame."""
    mass = max(abs(one[9]), abs(other[9]), 1e-12)
    scale = np.repeat([0.0, 0.0, 1.0], [6, 3, 1]) * mass
    scale[:6] = max(np.abs(other[:6]).max(), np.abs(one[:6]).max(), 1e-300)
    scale[6:9] = max(np.sqrt(scale[0] * mass), np.abs(other[6:9]).max())
    return bool(np.all(np.abs(one - other) <= _SAME * scale))


class _Urdf:
    """URDF: `<inertial>` of links, `<dynamics>` of joints."""

    def __init__(self, edited: Edited) -> None:
        self.edited = edited
        self.elements = {
            (child.tag, child.attributes.get("name", "").strip()): child
            for child in edited.source.root.children
            if child.tag in ("link", "joint")
        }

    def axes(self, link: str) -> np.ndarray | None:
        """(3, 3) those along which the inertia of a link is stated; None: those of its frame."""
        inertial = first(self.elements["link", link], "inertial")
        origin = first(inertial, "origin") if inertial else None
        angles = origin.attributes.get("rpy") if origin else None
        return from_rpy([float(word) for word in angles.split()]) if angles else None

    def body(self, body: Body, axes: np.ndarray | None) -> None:
        """Puts the numbers of a link."""
        new = written(body.ten, axes)
        link = self.elements["link", body.name]
        inertial = first(link, "inertial")
        if inertial is None:
            entries = " ".join(
                f'{k}="{numbers([x])}"' for k, x in zip(_TENSOR, new[4:], strict=True)
            )
            self.edited.child(
                link,
                f'<inertial><origin xyz="{numbers(new[1:4])}" rpy="0 0 0"/>'
                f'<mass value="{numbers(new[:1])}"/><inertia {entries}/></inertial>',
                first=True,
            )
            return
        assert body.was is not None
        was = written(about_origin(body.was), axes)
        mass, tensor, origin = (first(inertial, tag) for tag in ("mass", "inertia", "origin"))
        assert mass is not None and tensor is not None
        if _moved(new[:1], was[:1]):
            self.edited.attribute(mass, "value", numbers(new[:1]))
        if _moved(new[1:4], was[1:4]):
            if origin is None:
                self.edited.child(inertial, f'<origin xyz="{numbers(new[1:4])}"/>', first=True)
            else:
                self.edited.attribute(origin, "xyz", numbers(new[1:4]))
        if _moved(new[4:], was[4:]):
            for key, value in zip(_TENSOR, new[4:], strict=True):
                self.edited.attribute(tensor, key, numbers([value]))

    def stated(self, joint: str) -> dict[str, float]:
        """What a joint states; the reader tells it."""
        return {}

    def drive(self, joint: str, values: Mapping[str, float]) -> None:
        """Puts damping and friction of a joint."""
        element = self.elements["joint", joint]
        dynamics = first(element, "dynamics")
        texts = {quantity: numbers([value]) for quantity, value in values.items()}
        if dynamics is None:
            told = " ".join(f'{quantity}="{text}"' for quantity, text in texts.items())
            self.edited.child(element, f"<dynamics {told}/>")
            return
        for quantity, text in texts.items():
            self.edited.attribute(dynamics, quantity, text)


class _Mjcf:
    """MJCF: `<inertial>` of bodies, attributes of joints; what defaults say is said anew."""

    def __init__(self, edited: Edited) -> None:
        self.edited, self.bodies, self.joints = edited, dict[str, Element](), dict[str, Element]()
        root = edited.source.root
        self.compilers = [element for element in root.walk() if element.tag == "compiler"]
        bodies = [e for world in root.named("worldbody") for e in world.walk() if e.tag == "body"]
        joints = [joint for body in bodies for joint in _joints_of(body)]
        for k, body in enumerate(bodies, start=1):
            self.bodies[body.attributes.get("name") or f"body{k}"] = body
        for k, joint in enumerate(joints):
            self.joints[joint.attributes.get("name") or f"joint{k}"] = joint
        self.inner = any(
            {"armature", "damping"} & element.attributes.keys()
            for part in root.named("actuator")
            for element in part.walk()
        )

    def _check(self, compiler: Element) -> None:
        path, said = self.edited.source.path, compiler.attributes
        if said.get("inertiafromgeom") == "true":
            raise DataError(
                f'--like {path}: line {compiler.line}: inertiafromgeom="true" takes all masses '
                'from geoms; write "auto" there'
            )
        for key in _RESCALED:
            if float(said.get(key, "0")) > 0.0:
                raise DataError(
                    f"--like {path}: line {compiler.line}: {key} changes the masses that are "
                    "stated; take it out"
                )

    def _element(self, found: Mapping[str, Element], kind: str, name: str) -> Element:
        if name not in found:
            raise DataError(
                f"--like {self.edited.source.path}: {kind} {name} does not stand in the file "
                "itself (<include>, <attach>, <replicate>); save it as one file (mj_saveLastXML) "
                "and give that"
            )
        return found[name]

    def axes(self, link: str) -> np.ndarray | None:
        """Those of the frame of the body: full inertias are written."""
        return None

    def body(self, body: Body, axes: np.ndarray | None) -> None:
        """Puts the numbers of a body."""
        for compiler in self.compilers:
            self._check(compiler)
        new = written(body.ten)
        element = self._element(self.bodies, "body", body.name)
        full = numbers(new[[4, 7, 9, 5, 6, 8]])
        inertial = first(element, "inertial")
        if inertial is None:
            self.edited.child(
                element,
                f'<inertial pos="{numbers(new[1:4])}" mass="{numbers(new[:1])}" '
                f'fullinertia="{full}"/>',
                first=True,
            )
            return
        was = None if body.was is None else written(about_origin(body.was))
        if was is None or _moved(new[:1], was[:1]):
            self.edited.attribute(inertial, "mass", numbers(new[:1]))
        if was is None or _moved(new[1:4], was[1:4]):
            self.edited.attribute(inertial, "pos", numbers(new[1:4]))
        if was is None or _moved(new[4:], was[4:]):
            for name in ("diaginertia", *_TURNED):
                if name in inertial.spans:
                    self.edited.without(inertial, name)
            self.edited.attribute(inertial, "fullinertia", full)

    def stated(self, joint: str) -> dict[str, float]:
        """What a joint states; the reader tells it."""
        return {}

    def drive(self, joint: str, values: Mapping[str, float]) -> None:
        """Puts what resists a joint."""
        if self.inner and {"armature", "damping"} & values.keys():
            raise DataError(
                f"--like {self.edited.source.path}: actuators state armature or damping of their "
                f"own, and {joint} would have it twice; move it to the joints (times gear^2)"
            )
        element = self._element(self.joints, "joint", joint)
        for quantity, value in values.items():
            name = "frictionloss" if quantity == "friction" else quantity
            _, *further = element.attributes.get(name, "0").split()
            self.edited.attribute(element, name, " ".join([numbers([value]), *further]))


def _joints_of(body: Element) -> Iterator[Element]:
    """Joints of a body, those in frames too, in file order."""
    waiting = list(reversed(body.children))
    while waiting:
        element = waiting.pop()
        if element.tag in ("joint", "freejoint"):
            yield element
        elif element.tag == "frame":
            waiting += reversed(element.children)


class _Sdf:
    """SDF: texts of elements."""

    def __init__(self, edited: Edited) -> None:
        self.edited = edited
        self.elements = {
            (element.tag, element.attributes.get("name", "")): element
            for element in edited.source.root.walk()
            if element.tag in ("link", "joint")
        }

    def axes(self, link: str) -> np.ndarray | None:
        """(3, 3) of the `<pose>` of the inertial."""
        inertial = first(self.elements["link", link], "inertial")
        return sdf_pose(inertial).rotation if inertial else None

    def body(self, body: Body, axes: np.ndarray | None) -> None:
        """Puts the numbers of a link."""
        new = written(body.ten, axes)
        link = self.elements["link", body.name]
        inertial = first(link, "inertial")
        pairs = zip(_TENSOR, new[4:], strict=True)
        if inertial is None or body.was is None:
            tensor = "".join(f"<{key}>{numbers([value])}</{key}>" for key, value in pairs)
            self.edited.child(
                link,
                f"<inertial><pose>{numbers([*new[1:4], 0.0, 0.0, 0.0])}</pose>"
                f"<mass>{numbers(new[:1])}</mass><inertia>{tensor}</inertia></inertial>",
                first=True,
            )
            return
        self._put(inertial, "mass", numbers(new[:1]))
        pose = first(inertial, "pose")
        angles = pose.text.split()[3:] if pose is not None and pose.text else ["0", "0", "0"]
        was = written(about_origin(body.was), axes)
        if _moved(new[1:4], was[1:4]):
            self._put(inertial, "pose", " ".join([numbers(new[1:4]), *angles]))
        inertia = first(inertial, "inertia")
        assert inertia is not None
        for key, value in pairs:
            self._put(inertia, key, numbers([value]))

    def _put(self, parent: Element, tag: str, text: str) -> None:
        element = first(parent, tag)
        if element is None:
            self.edited.child(parent, f"<{tag}>{text}</{tag}>", first=True)
        else:
            self.edited.text(element, text)

    def _dynamics(self, joint: str) -> tuple[Element | None, Element | None]:
        element = self.elements.get(("joint", joint))
        axis = first(element, "axis") if element else None
        return axis, first(axis, "dynamics") if axis else None

    def stated(self, joint: str) -> dict[str, float]:
        """What a joint states."""
        _, dynamics = self._dynamics(joint)
        children = dynamics.children if dynamics else ()
        names = {"spring_stiffness": "stiffness"}
        return {
            names.get(child.tag, child.tag): float(child.text) for child in children if child.text
        }

    def drive(self, joint: str, values: Mapping[str, float]) -> None:
        """Puts what resists a joint."""
        axis, dynamics = self._dynamics(joint)
        names = {"stiffness": "spring_stiffness"}
        texts = {names.get(q, q): numbers([value]) for q, value in values.items()}
        if dynamics is not None:
            for tag, text in texts.items():
                self._put(dynamics, tag, text)
        elif axis is not None:
            inner = "".join(f"<{tag}>{text}</{tag}>" for tag, text in texts.items())
            self.edited.child(axis, f"<dynamics>{inner}</dynamics>")


def _moved(new: np.ndarray, was: np.ndarray) -> bool:
    scale = max(float(np.abs(was).max()), float(np.abs(new).max()), 1e-300)
    return bool(np.abs(new - was).max() > 1e-12 * scale)
