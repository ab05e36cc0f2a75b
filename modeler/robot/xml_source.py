"""XML text as elements that know their line and their bytes.

Python's expat reads; what it forgets is kept here: at which bytes of the file the value of an
attribute stands, so that a number can be replaced and every other byte left as it is. Document
types and entities, with which a small file grows without end or reads other files, are refused,
and so is what is larger, deeper or more than any robot. Comments and the declaration are blanked
before, byte for byte: a `--` inside a comment, a blank first line, and accents of another encoding
in comments are then no mistakes, as they are none to ROS, Pinocchio and MuJoCo.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from xml.parsers import expat

from modeler.core.errors import RobotError

Span = tuple[int, int]
"""First byte, and that behind the last, in the bytes that were read."""

LARGEST_FILE = 64 * 2**20  # bytes
LARGEST_TAG = 8 * 2**20  # bytes of one tag, comment or declaration
DEEPEST = 256
MOST_ELEMENTS = 200_000
_PIECE = 2**20  # bytes that expat gets at a time
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
        """Its children of these tags."""
        return [child for child in self.children if child.tag in tags]

    def iterate_elements(self) -> "Iterator[Element]":
        """Itself, and all elements in it, in file order."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting += reversed(element.children)


def parse_xml(data: bytes, where: str) -> Element:
    """The root element of the text.

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
            for start in range(0, len(text), _PIECE):
                self._expat.Parse(text[start : start + _PIECE], False)
                if start - self._expat.CurrentByteIndex > LARGEST_TAG:
                    most = f"{LARGEST_TAG // 2**20} MiB"
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
        if self._count > MOST_ELEMENTS or len(self._open) > DEEPEST:
            most = f"{MOST_ELEMENTS} elements, or than {DEEPEST} inside each other"
            raise self._build_error(f"more than {most}; is this a robot?")
        begin = self._expat.CurrentByteIndex
        at, spans = begin + 1 + len(tag.encode(self._encoding)), {}
        while attribute_match := _ATTRIBUTE.match(self._data, at):
            at = attribute_match.end()
            spans[attribute_match[1].decode(self._encoding)] = attribute_match.span(
                attribute_match.lastindex or 0
            )
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
    """The bytes with others in place of some spans; all else stays as it is.

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
