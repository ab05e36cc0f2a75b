"""XML text as elements that know their line and their bytes.

Python's expat reads; what it forgets is kept here: at which bytes of the file the value of an
attribute stands, so that a number can be replaced and every other byte left as it is. Document
types and entities, with which a small file grows without end or reads other files, are refused,
and so is what is larger, deeper or more than any robot. Comments and the declaration are blanked
before, byte for byte: a `--` inside a comment, a blank first line, and accents of another encoding
in comments are then no mistakes, as they are none to ROS, Pinocchio and MuJoCo.
"""

import math
import re
import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from xml.parsers import expat

import numpy as np

from modeler.core.errors import RobotError, flatten_message
from modeler.core.toml_cells import LARGEST, TomlCell, quote_value, suggest_name
from modeler.formats.body_tree import (
    Pose,
    Roundings,
    compute_axis_rotation,
    compute_quaternion_rotation,
    snap_quaternion,
    summarise_names,
)
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import LARGEST_LENGTH

Span = tuple[int, int]
"""First byte, and that behind the last, in the bytes that were read."""

LARGEST_FILE = 64 * 2**20  # bytes
_ENCODINGS = ("utf-8", "iso-8859-1", "latin1", "iso-8859-15", "windows-1252", "cp1252")
_DECLARATION = re.compile(rb"(?:\xef\xbb\xbf)?\s*(<\?xml\s[^<>]*\?>)")
_STATED_ENCODING = re.compile(rb"\sencoding\s*=\s*[\"']([^\"']*)[\"']")
_BLANK = bytes(byte if byte in b"\r\n" else 0x20 for byte in range(256))
_ENDS = {b"<!--": b"-->", b"<![CDATA[": b"]]>", b"<?": b"?>"}
_ATTRIBUTE = re.compile(rb"\s+([^\s=/>]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")


@dataclass(slots=True, eq=False)
class Element:
    """An element of the file.

    Attributes:
        tag: its name, with the prefix that the file writes.
        attributes: name -> value, entities such as `&quot;` resolved.
        line: of its start tag, from 1.
        spans: name -> bytes of the attribute's value, between its quotes.
        opening: bytes of the start tag.
        closing: bytes of the end tag; empty behind a tag that ends in `/>`.
        children: in file order.
        text: its own characters, without space around them.
        text_span: bytes of `text`; None where there is none, or where it is mixed with elements,
            comments and the like.
    """

    tag: str
    attributes: Mapping[str, str]
    line: int
    spans: Mapping[str, Span]
    opening: Span
    closing: Span = (0, 0)
    children: "Sequence[Element]" = ()
    text: str = ""
    text_span: Span | None = None

    def find_children(self, *tags: str) -> "list[Element]":
        """Returns the children of the element with these tags."""
        return [child for child in self.children if child.tag in tags]

    def iterate_elements(self) -> "Iterator[Element]":
        """Yields itself, and all elements in it, in file order."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting += reversed(element.children)


def parse_xml(data: bytes, where: str) -> Element:
    """Returns the root element of the text.

    Args:
        data: UTF-8, with or without a byte order mark, or the encoding of western Europe that it
            declares.
        where: name of the file, for messages.

    Raises:
        RobotError: not well-formed, another encoding, a document type, too large or too deep;
            one line that says where and what to do.
    """
    if len(data) > LARGEST_FILE:
        most = f"{LARGEST_FILE // 2**20} MiB"
        raise RobotError(f"{where}: more than {most}; meshes belong into files of their own")
    if data[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\0" in data[:4]:
        raise RobotError(f"{where}: is UTF-16 or UTF-32 text; save the file as UTF-8")
    if not data.strip():
        raise RobotError(f"{where}: is empty; expected XML")
    return _XmlReader(data, where).read_root()


def _read_encoding(data: bytes, where: str) -> str:
    """The codec that the declaration names; UTF-8 without one."""
    declared = _DECLARATION.match(data)
    stated = _STATED_ENCODING.search(declared[1]) if declared else None
    name = stated[1].decode("latin-1") if stated else "utf-8"
    codec = "utf-8" if name.lower() in ("utf8", "ascii", "us-ascii") else name.lower()
    if codec in _ENCODINGS:
        return codec
    line = data.count(b"\n", 0, declared.start(1) if declared else 0) + 1
    raise RobotError(f'{where}: line {line}: encoding="{name[:20]}"; save the file as UTF-8')


def _erase_comments(data: bytes) -> bytes:
    """The data without declaration and comments: spaces, and as many lines and bytes as before."""
    parts, at = [], 0
    if declared := _DECLARATION.match(data):
        parts, at = [data[: declared.start(1)], b" " * len(declared[1])], declared.end()
    for opening in re.finditer(rb"<!--|<!\[CDATA\[|<\?", data):
        start = opening.start()
        if start < at:
            continue
        end = data.find(_ENDS[opening[0]], opening.end())
        if end < 0:
            break
        end += len(_ENDS[opening[0]])
        inner = data[start:end]
        if opening[0] == b"<!--":
            inner = inner.translate(_BLANK)
        parts += [data[at:start], inner]
        at = end
    return b"".join([*parts, data[at:]])


@dataclass(slots=True)
class _OpenElement:
    """An element whose end has not come."""

    element: Element
    text: list[str] = field(default_factory=list)
    children: list[Element] = field(default_factory=list)


class _XmlReader:
    """One pass of expat over a text."""

    def __init__(self, data: bytes, where: str) -> None:
        self._data, self._where, self._encoding = data, where, _read_encoding(data, where)
        self._open: list[_OpenElement] = [
            _OpenElement(Element("", {}, 0, {}, (0, 0)))
        ]  # around the root
        self._count = 0
        self._expat = expat.ParserCreate(self._encoding)
        self._expat.buffer_text = self._expat.ordered_attributes = True
        self._expat.StartDoctypeDeclHandler = self._refuse_doctype
        self._expat.StartElementHandler = self._open_element
        self._expat.EndElementHandler = self._close_element
        self._expat.CharacterDataHandler = lambda text: self._open[-1].text.append(text)

    def read_root(self) -> Element:
        text = _erase_comments(self._data)
        try:
            for start in range(0, len(text), THRESHOLDS.parsed_bytes):
                self._expat.Parse(text[start : start + THRESHOLDS.parsed_bytes], False)
                if start - self._expat.CurrentByteIndex > THRESHOLDS.max_tag_bytes:
                    most = f"{THRESHOLDS.max_tag_bytes // 2**20} MiB"
                    raise self._build_error(f"a tag or comment of more than {most}; shorten it")
            self._expat.Parse(b"", True)
        except expat.ExpatError as error:
            raise self._explain_malformed(error) from None
        return self._open[0].children[0]

    def _build_error(self, what: str, line: int = 0) -> RobotError:
        return RobotError(f"{self._where}: line {line or self._expat.CurrentLineNumber}: {what}")

    def _explain_malformed(self, error: expat.ExpatError) -> RobotError:
        try:
            _erase_comments(self._data).decode(self._encoding)
        except UnicodeDecodeError as wrong:
            line = self._data.count(b"\n", 0, wrong.start) + 1
            problem = f"byte {wrong.start} is not {self._encoding.upper()}"
            return self._build_error(f"{problem}; save the file as UTF-8", line)
        what = (expat.ErrorString(error.code) or "").removeprefix("not well-formed ").strip("()")
        for open_element in self._open[-1:0:-1]:
            what += (
                f"; <{open_element.element.tag[:60]}> of line {open_element.element.line} is open"
            )
            break
        problem = f"not well-formed XML, column {error.offset + 1}: {what}"
        return self._build_error(f"{problem}; mend the tags and quotes there", error.lineno)

    def _refuse_doctype(self, *_parts: object) -> None:
        raise self._build_error(
            "<!DOCTYPE> and its entities are not read, for they can stand for any amount of text; "
            "take it out and write what its entities stand for"
        )

    def _open_element(self, tag: str, pairs: list[str]) -> None:
        self._count += 1
        if self._count > THRESHOLDS.max_elements or len(self._open) > THRESHOLDS.max_element_depth:
            most = f"{THRESHOLDS.max_elements} elements, "
            most += f"or than {THRESHOLDS.max_element_depth} inside each other"
            raise self._build_error(f"more than {most}; is this a robot?")
        begin = self._expat.CurrentByteIndex
        at, spans = begin + 1 + len(tag.encode(self._encoding)), {}
        while attribute_match := _ATTRIBUTE.match(self._data, at):
            at = attribute_match.end()
            name, place = attribute_match[1], attribute_match.lastindex or 0
            spans[name.decode(self._encoding)] = attribute_match.span(place)
        attributes = dict(zip(pairs[::2], pairs[1::2], strict=True))
        opening = begin, self._data.index(b">", at) + 1
        line = self._expat.CurrentLineNumber
        self._open.append(_OpenElement(Element(tag, attributes, line, spans, opening)))

    def _close_element(self, _tag: str) -> None:
        ended = self._open.pop()
        done, behind = ended.element, ended.element.opening[1]
        done.children, done.text = tuple(ended.children), "".join(ended.text).strip()
        done.closing = behind, behind
        if self._data[behind - 2 : behind] != b"/>":
            begin = self._expat.CurrentByteIndex
            done.closing = begin, self._data.index(b">", begin) + 1
        raw = b"" if ended.children else self._data[behind : done.closing[0]]
        if raw.strip() and b"<" not in raw:
            left = behind + len(raw) - len(raw.lstrip())
            done.text_span = left, left + len(raw.strip())
        self._open[-1].children.append(done)


def replace_spans(data: bytes, changes: Mapping[Span, str]) -> bytes:
    """Returns the bytes with others in place of some spans; all else stays as it is.

    Args:
        data: that was read.
        changes: span -> XML text to stand there; what is empty is an insertion.
    """
    parts, at = [], 0
    for (start, end), text in sorted(changes.items()):
        assert at <= start <= end <= len(data), (start, end)
        parts += [data[at:start], text.encode()]
        at = end
    return b"".join([*parts, data[at:]])


# What a reader makes of every element and attribute of a format, by a table, and what it shows.


_NOTHING = ("", "false", "no", "none")
_UNKNOWN = "{} is not known here and is passed over: {{}}"


@dataclass(frozen=True)
class ElementTable:
    """The table of a format.

    Attributes:
        read, idle: path -> attributes.
        reported, refused: path, or path@attribute -> sentence.
        default: the same -> values that change nothing.
        same: tag -> that under which it stands in paths.
    """

    read: Mapping[str, str]
    idle: Mapping[str, str]
    reported: Mapping[str, str]
    refused: Mapping[str, str]
    default: Mapping[str, str]
    same: Mapping[str, str]

    def classify_path(self, path: str, attribute: str = "") -> str:
        """Returns read, idle, reported or refused; "" for what the table does not know."""
        name = f"{path}@{attribute}" if attribute else path
        for part in ("refused", "reported"):
            if name in getattr(self, part):
                return part
        if self.idle.get(path) == "*":
            return "idle"
        if not attribute:
            return "read" if path in self.read else ""
        known = {part: getattr(self, part).get(path, "").split() for part in ("read", "idle")}
        return next((p for p, names in known.items() if attribute in names or "**" in names), "")

    def extend_path(self, parent: str, tag: str) -> str:
        """Returns the path of a child; bodies in bodies, and defaults in defaults, count once."""
        path_name = self.same.get(tag, tag)
        known = tag in self.same
        if known and (not path_name or parent.endswith(f"/{path_name}")):
            return parent
        return f"{parent}/{path_name}"

    def collect_notes(self, roots: Iterable[tuple[str, Element]]) -> list[str]:
        """Returns what to show of files, those that are included behind their own.

        Raises:
            RobotError: the first that is refused.
        """
        names_by_sentence: dict[str, list[str]] = {}
        for where, root in roots:
            for element, name, key, sentence in self._find_reported(root):
                called = name or f"line {element.line}"
                if key in self.refused:
                    line = f"{where}: line {element.line}: {sentence}"
                    raise RobotError(flatten_message(line.format(called)))
                is_full = len(names_by_sentence) >= THRESHOLDS.max_element_notes
                if sentence not in names_by_sentence and is_full:
                    sentence = "other elements are not known here and are passed over: {}"
                names_by_sentence.setdefault(sentence, []).append(called)
        names = {text: summarise_names(each) for text, each in names_by_sentence.items()}
        return [sentence.format(each) for sentence, each in names.items()]

    def _find_reported(self, root: Element) -> Iterator[tuple[Element, str, str, str]]:
        """What is reported or refused: element, what it belongs to, key in the table, sentence."""
        waiting = [(root, self.same.get(root.tag, root.tag), "")]
        while waiting:
            element, path, name = waiting.pop()
            attributes = element.attributes
            name = (attributes.get("name") or attributes.get("reference") or name).strip()
            for attribute, value in (("", _get_value_text(element)), *attributes.items()):
                key = f"{path}@{attribute}" if attribute else path
                verdict = self.classify_path(path, attribute)
                if not verdict and not attribute.startswith("xmlns"):
                    unknown = f"{attribute[:60]} of " * bool(attribute) + f"<{element.tag[:60]}>"
                    yield element, name, "", _UNKNOWN.format(unknown)
                elif verdict in ("reported", "refused") and not self._is_default(key, value):
                    yield element, name, key, getattr(self, verdict)[key]
                if not attribute and (verdict != "read" or self.read[path] == "**"):
                    break
            else:
                name = name if "/" in path else ""
                children = reversed(element.children)
                waiting += [(child, self.extend_path(path, child.tag), name) for child in children]

    def _is_default(self, name: str, value: str | None) -> bool:
        if value is None:
            return False
        if name in self.default:
            return value in self.default[name].split()
        return all(map(_is_nothing, value.lower().split()))


@cache
def load_element_table(format: str) -> ElementTable:
    """Loads the table of "urdf" or "mjcf"."""
    text = Path(__file__).with_name(f"{format}_elements.toml").read_text(encoding="utf-8")
    parts = tomllib.loads(text)
    return ElementTable(**{key: parts.get(key, {}) for key in ElementTable.__annotations__})


def _is_nothing(word: str) -> bool:
    try:
        return float(word) == 0.0
    except ValueError:
        return word in _NOTHING


def _get_value_text(element: Element) -> str | None:
    """Its value, where it is a value and nothing else."""
    if element.children:
        return None
    attributes = {key: value for key, value in element.attributes.items() if key != "name"}
    return attributes.get("value") if attributes else element.text or None


# Elements with their place in messages: numbers, names, children.

_DECIMAL = re.compile(r"[+-]?(?:\d+\.?(\d*)|\.(\d+))(?:[eE]([+-]?\d{1,4}))?", re.ASCII)


class LocatedElement:
    """An XML element, or one that is not given, and its place for messages."""

    def __init__(self, element: Element, where: str, spot: str, is_given: bool = True) -> None:
        self.element, self.is_given, self._where = element, is_given, where
        self.place = TomlCell(f"{where}: line {element.line}", spot)

    def find_child(self, tag: str) -> "LocatedElement":
        """Returns the child of that tag, of which the element may have one."""
        children = self.element.find_children(tag)
        if len(children) > 1:
            self.place = TomlCell(f"{self._where}: line {children[1].line}", self.place.location)
            what = "expected one: take out what is not meant"
            raise self.make_error(f"a second <{tag}>; {what}")
        inner = children[0] if children else Element(tag, {}, self.element.line, {}, (0, 0))
        return LocatedElement(inner, self._where, f"{self.place.location} <{tag}>", bool(children))

    def find_children(self, *tags: str) -> "list[LocatedElement]":
        """Returns the children of the element with these tags."""
        children = self.element.find_children(*tags)
        spots = [
            f"{e.tag} {quote_value(_get_name(e))}" if _get_name(e) else f"<{e.tag}>"
            for e in children
        ]
        return [LocatedElement(e, self._where, s) for e, s in zip(children, spots, strict=True)]

    def find_grandchildren(self, outer: str, inner: str) -> "list[LocatedElement]":
        """Returns the elements `inner` in all children `outer`."""
        around = self.find_children(outer)
        return [each for element in around for each in element.find_children(inner)]

    @property
    def name(self) -> str:
        """Returns the name of the element; "" without one."""
        return _get_name(self.element)

    def make_error(self, what: str) -> RobotError:
        """Returns the error to raise: the place of the element and `what`, as one line."""
        return self.place.make_error(what)

    def require_known(self, what: str, name: str, known: Collection[str]) -> str:
        """Returns the name of a link or joint that must be there."""
        if name not in known:
            near = suggest_name(name, known)
            raise self.make_error(f"there is no {what} {quote_value(name)}{near}")
        return name

    def get_text(self, attribute: str) -> str:
        """Returns an attribute; "" without it."""
        return self.element.attributes.get(attribute, "").strip()

    def merge_children(self, *keys: str) -> "LocatedElement":
        """Returns the element with what children of these names say as attributes.

        Raises:
            RobotError: two children that say different things under one name.
        """
        values = dict[str, str]()
        for child in self.element.children:
            key = _get_name(child) if child.tag == "param" else child.tag
            text = child.attributes.get("value", child.text).strip()
            if key in keys and values.setdefault(key, text) != text:
                raise self.make_error(f"a second <{child.tag}>; take out what is not meant")
        values = {**{key: text for key, text in values.items() if text}, **self.element.attributes}
        element = replace(self.element, attributes=values)
        return LocatedElement(element, self._where, self.place.location, self.is_given)

    def require_child(self, tag: str, example: str) -> "LocatedElement":
        """Returns the child of that tag, which the element must have."""
        if not (child := self.find_child(tag)).is_given:
            raise self.make_error(f"<{tag}> is missing; write <{tag} {example}/>")
        return child

    def require_attribute(self, attribute: str, example: str) -> str:
        """Returns an attribute that must be there."""
        if not (value := self.element.attributes.get(attribute, "").strip()):
            raise self.make_error(f'{attribute} is missing; write {attribute}="{example}"')
        return value

    def read_digits(self, attribute: str, default: str, most: float = LARGEST) -> list[str]:
        """Returns the numbers of an attribute as printed, as many as those of the default."""
        text = self.element.attributes.get(attribute, default)
        place, words, count = self.place.enter(attribute, text), text.split(), len(default.split())
        expected = f'{"a number" if count == 1 else f"{count} numbers"} such as "{default}"'
        if len(words) != count:
            raise place.make_mismatch(expected)
        for word in words:
            check_number(place.with_value(word), expected, most)
        return words

    def read_numbers(self, attribute: str, default: str, most: float = LARGEST) -> np.ndarray:
        """Returns the words of an attribute as numbers."""
        return np.array([float(word) for word in self.read_digits(attribute, default, most)])

    def read_number(self, attribute: str, default: str) -> float:
        """Returns the one number of an attribute."""
        return float(self.read_digits(attribute, default)[0])

    def read_optional_number(self, attribute: str) -> float | None:
        """Reads a number that may be missing or infinite: None then."""
        text = self.element.attributes.get(attribute, "").strip()
        if not text or text.lower().lstrip("+-") in ("inf", "infinity", ".inf"):
            return None
        value = float(self.read_digits(attribute, "0", math.inf)[0])
        return value if abs(value) <= LARGEST else None

    def read_direction(self, attribute: str, default: str) -> np.ndarray:
        """Returns (3,) a direction, of length one."""
        axis = self.read_numbers(attribute, default)
        length = float(np.linalg.norm(axis))
        if length < THRESHOLDS.max_rounded_zero:
            place = self.place.enter(attribute, self.element.attributes.get(attribute, ""))
            raise place.make_mismatch('a direction such as "0 0 1"')
        return axis / length


def _get_name(element: Element) -> str:
    return element.attributes.get("name", "").strip()


def read_pose(origin: LocatedElement, rounded: Roundings) -> Pose:
    """Reads a pose of xyz, and of rpy or of quat_xyzw.

    Raises:
        RobotError: both, or a quaternion 0.
    """
    xyz = rounded.snap_lengths(origin.read_numbers("xyz", "0 0 0", LARGEST_LENGTH))
    if "quat_xyzw" not in origin.element.attributes:
        angles = map(rounded.snap_angle, origin.read_digits("rpy", "0 0 0"))
        return Pose(xyz, compute_rpy_rotation(angles))
    if "rpy" in origin.element.attributes:
        raise origin.place.make_error("states rpy and quat_xyzw; keep the one that is meant")
    turn = np.roll(origin.read_numbers("quat_xyzw", "0 0 0 1"), 1)
    if float(np.linalg.norm(turn)) < THRESHOLDS.max_rounded_zero:
        place = origin.place.enter("quat_xyzw", origin.element.attributes["quat_xyzw"])
        raise place.make_mismatch('a quaternion such as "0 0 0 1"')
    turn = turn if rounded.exact else snap_quaternion(turn, rounded)
    return Pose(xyz, compute_quaternion_rotation(turn))


def compute_rpy_rotation(angles: Iterable[float]) -> np.ndarray:
    """Returns (3, 3) of roll, pitch, yaw about fixed axes: Rz(yaw) Ry(pitch) Rx(roll)."""
    rotation = np.eye(3)
    for axis, angle in zip(np.eye(3), angles, strict=True):
        rotation = compute_axis_rotation(axis, angle) @ rotation
    return np.asarray(rotation + 0.0)


def check_number(place: TomlCell, expected: str, most: float = LARGEST) -> None:
    """Refuses what is no decimal number, or one that is too large."""
    if len(place.value) > 100 or not _DECIMAL.fullmatch(place.value):
        raise place.make_mismatch(expected)
    if abs(float(place.value)) > most:
        raise place.make_mismatch(f"at most {most:g} in SI units")


def compute_half_unit(digits: str) -> float:
    """Returns half a unit of the last printed digit."""
    number_match = _DECIMAL.fullmatch(digits)
    assert number_match is not None
    decimals = len(number_match[1] or number_match[2] or "")
    return 0.5 * 10.0 ** (max(int(number_match[3] or 0), -300) - decimals)
