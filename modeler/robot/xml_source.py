"""XML text as elements that know their line and their bytes.

Python's expat reads; what it forgets is kept here: at which bytes of the file the value of an
attribute stands, so that a number can be replaced and every other byte left as it is. Document
types and entities, with which a small file grows without end or reads other files, are refused,
and so is what is larger, deeper or more than any robot.
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

    def named(self, *tags: str) -> "list[Element]":
        """Its children of these tags."""
        return [child for child in self.children if child.tag in tags]

    def walk(self) -> "Iterator[Element]":
        """Itself, and all elements in it, in file order."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting += reversed(element.children)


def parse_xml(data: bytes, where: str) -> Element:
    """The root element of the text.

    Args:
        data: UTF-8, with or without a byte order mark.
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
    return _Reading(data, where).root()


@dataclass(slots=True)
class _Open:
    """An element whose end has not come."""

    element: Element
    text: list[str] = field(default_factory=list)
    children: list[Element] = field(default_factory=list)


class _Reading:
    """One pass of expat over a text."""

    def __init__(self, data: bytes, where: str) -> None:
        self._data, self._where = data, where
        self._open: list[_Open] = [_Open(Element("", {}, 0, {}, (0, 0)))]  # around the root
        self._count = 0
        self._expat = expat.ParserCreate("UTF-8")
        self._expat.buffer_text = self._expat.ordered_attributes = True
        self._expat.XmlDeclHandler = self._declared
        self._expat.StartDoctypeDeclHandler = self._doctype
        self._expat.StartElementHandler = self._start
        self._expat.EndElementHandler = self._end
        self._expat.CharacterDataHandler = lambda text: self._open[-1].text.append(text)

    def root(self) -> Element:
        try:
            for start in range(0, len(self._data), _PIECE):
                self._expat.Parse(self._data[start : start + _PIECE], False)
                if start - self._expat.CurrentByteIndex > LARGEST_TAG:
                    most = f"{LARGEST_TAG // 2**20} MiB"
                    raise self._error(f"a tag or comment of more than {most}; shorten it")
            self._expat.Parse(b"", True)
        except expat.ExpatError as error:
            raise self._malformed(error) from None
        return self._open[0].children[0]

    def _error(self, what: str, line: int = 0) -> RobotError:
        return RobotError(f"{self._where}: line {line or self._expat.CurrentLineNumber}: {what}")

    def _malformed(self, error: expat.ExpatError) -> RobotError:
        try:
            self._data.decode()
        except UnicodeDecodeError as wrong:
            line = self._data.count(b"\n", 0, wrong.start) + 1
            return self._error(f"byte {wrong.start} is not UTF-8; save the file as UTF-8", line)
        what = (expat.ErrorString(error.code) or "").removeprefix("not well-formed ").strip("()")
        for still in self._open[-1:0:-1]:
            what += f"; <{still.element.tag[:60]}> of line {still.element.line} is open"
            break
        told = f"not well-formed XML, column {error.offset + 1}: {what}"
        return self._error(f"{told}; mend the tags and quotes there", error.lineno)

    def _declared(self, _version: str, encoding: str | None, _standalone: int) -> None:
        if encoding and encoding.lower() not in ("utf-8", "utf8", "us-ascii", "ascii"):
            raise self._error(f'encoding="{encoding[:20]}"; save the file as UTF-8, and say so')

    def _doctype(self, *_parts: object) -> None:
        raise self._error(
            "<!DOCTYPE> and its entities are not read, for they can stand for any amount of text; "
            "take it out and write what its entities stand for"
        )

    def _start(self, tag: str, pairs: list[str]) -> None:
        self._count += 1
        if self._count > MOST_ELEMENTS or len(self._open) > DEEPEST:
            most = f"{MOST_ELEMENTS} elements, or than {DEEPEST} inside each other"
            raise self._error(f"more than {most}; is this a robot?")
        begin = self._expat.CurrentByteIndex
        at, spans = begin + 1 + len(tag.encode()), {}
        while found := _ATTRIBUTE.match(self._data, at):
            at = found.end()
            spans[found[1].decode()] = found.span(found.lastindex or 0)
        attributes = dict(zip(pairs[::2], pairs[1::2], strict=True))
        opening = begin, self._data.index(b">", at) + 1
        line = self._expat.CurrentLineNumber
        self._open.append(_Open(Element(tag, attributes, line, spans, opening)))

    def _end(self, _tag: str) -> None:
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


def replaced(data: bytes, changes: Mapping[Span, str]) -> bytes:
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
