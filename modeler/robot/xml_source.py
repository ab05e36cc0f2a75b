"""XML text as elements that know their line and their bytes.

Python's expat reads; what it forgets is kept here: at which bytes of the file the value of an
attribute stands, so that a number can be replaced and every other byte left as it is. Document
types and entities, with which a small file grows without end or reads other files, are refused,
and so is what is larger, deeper or more than any robot.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from xml.parsers import expat

from modeler.core.errors import RobotError
from modeler.core.toml_cells import shown

Span = tuple[int, int]
"""First byte, and that behind the last, in the bytes that were read."""

LARGEST_FILE = 64 * 2**20  # bytes
LARGEST_TAG = 8 * 2**20  # bytes of one tag, comment or declaration
DEEPEST = 256
MOST_ELEMENTS = 200_000
_PIECE = 2**20  # bytes that expat gets at a time
_SPACE = rb"[ \t\r\n]"
_NAME = re.compile(rb"<[^ \t\r\n/>]+")
_ATTRIBUTE = re.compile(
    _SPACE + rb"+([^ \t\r\n=/>]+)" + _SPACE + rb"*=" + _SPACE + rb"*(?:\"([^\"]*)\"|'([^']*)')"
)
_TAG_END = re.compile(_SPACE + rb"*(/?)>")
_END_TAG = re.compile(rb"</[^>]*>")


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """An element of the file.

    Attributes:
        tag: its name, with the prefix that the file writes.
        attributes: name -> value, entities such as `&quot;` resolved.
        text: its own characters, without space around them.
        line: of its start tag, from 1.
        children: in file order.
        spans: name -> bytes of the attribute's value, between its quotes.
        text_span: bytes of `text`; None where there is none, or where it is mixed with elements,
            comments and the like.
        opening: bytes of the start tag.
        closing: bytes of the end tag; empty behind a tag that ends in `/>`.
    """

    tag: str
    attributes: Mapping[str, str]
    text: str
    line: int
    children: "tuple[Element, ...]"
    spans: Mapping[str, Span]
    text_span: Span | None
    opening: Span
    closing: Span

    def named(self, *tags: str) -> "Iterator[Element]":
        """Its children of these tags."""
        return (child for child in self.children if child.tag in tags)

    def first(self, tag: str) -> "Element | None":
        """Its first child of that tag."""
        return next(self.named(tag), None)

    def walk(self) -> "Iterator[Element]":
        """Itself, and all elements in it, in file order."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting += reversed(element.children)


@dataclass(slots=True)
class _Open:
    """An element whose end has not come."""

    tag: str
    attributes: dict[str, str]
    line: int
    spans: dict[str, Span]
    opening: Span
    text: list[str] = field(default_factory=list)
    children: list[Element] = field(default_factory=list)


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
        raise RobotError(
            f"{where}: has {len(data) / 2**20:.0f} MiB; expected at most "
            f"{LARGEST_FILE // 2**20} MiB: meshes belong into files of their own"
        )
    if data[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\0" in data[:4]:
        raise RobotError(f"{where}: is UTF-16 or UTF-32 text; save the file as UTF-8")
    if not data.strip():
        raise RobotError(f"{where}: is empty; expected XML")
    return _Reading(data, where).root()


class _Reading:
    """One pass of expat over a text."""

    def __init__(self, data: bytes, where: str) -> None:
        self._data, self._where = data, where
        self._open: list[_Open] = []
        self._count = 0
        self._root: Element | None = None
        self._expat = expat.ParserCreate("UTF-8")
        self._expat.buffer_text = True
        self._expat.ordered_attributes = True
        self._expat.XmlDeclHandler = self._declared
        self._expat.StartDoctypeDeclHandler = self._doctype
        self._expat.StartElementHandler = self._start
        self._expat.EndElementHandler = self._end
        self._expat.CharacterDataHandler = self._characters

    def root(self) -> Element:
        view = memoryview(self._data)
        try:
            for start in range(0, len(view), _PIECE):
                piece = view[start : start + _PIECE]
                self._expat.Parse(piece, False)
                if start + len(piece) - self._expat.CurrentByteIndex > LARGEST_TAG + _PIECE:
                    raise self._error(
                        f"a tag or comment of more than {LARGEST_TAG // 2**20} MiB; shorten it"
                    )
            self._expat.Parse(b"", True)
        except expat.ExpatError as error:
            raise self._malformed(error) from None
        finally:
            self._expat.StartElementHandler = self._expat.EndElementHandler = None
        assert self._root is not None
        return self._root

    def _error(self, what: str, line: int = 0) -> RobotError:
        return RobotError(f"{self._where}: line {line or self._expat.CurrentLineNumber}: {what}")

    def _malformed(self, error: expat.ExpatError) -> RobotError:
        try:
            self._data.decode()
        except UnicodeDecodeError as wrong:
            line = self._data.count(b"\n", 0, wrong.start) + 1
            return self._error(
                f"byte {wrong.start} is not UTF-8 text; save the file as UTF-8", line
            )
        what = (expat.ErrorString(error.code) or "").removeprefix("not well-formed ").strip("()")
        still = self._open[-1] if self._open else None
        unclosed = f"; <{still.tag[:60]}> of line {still.line} is open" if still else ""
        return self._error(
            f"not well-formed XML, column {error.offset + 1}: {what}{unclosed}; "
            "mend the tags and quotes there",
            error.lineno,
        )

    def _declared(self, _version: str, encoding: str | None, _standalone: int) -> None:
        if encoding and encoding.lower() not in ("utf-8", "utf8", "us-ascii", "ascii"):
            raise self._error(
                f'encoding="{encoding[:20]}"; expected UTF-8: save the file so and say so there'
            )

    def _doctype(self, *_parts: object) -> None:
        raise self._error(
            "<!DOCTYPE> and its entities are not read, for they can stand for any amount of text; "
            "take the declaration out and write what its entities stand for"
        )

    def _start(self, tag: str, pairs: list[str]) -> None:
        self._count += 1
        if self._count > MOST_ELEMENTS:
            raise self._error(f"more than {MOST_ELEMENTS} elements; is this a robot?")
        if len(self._open) >= DEEPEST:
            raise self._error(f"elements nested deeper than {DEEPEST}; is this a robot?")
        begin = self._expat.CurrentByteIndex
        name = _NAME.match(self._data, begin)
        assert name is not None
        at, spans = name.end(), {}
        while found := _ATTRIBUTE.match(self._data, at):
            at = found.end()
            spans[found[1].decode()] = found.span(2 if found[2] is not None else 3)
        end = _TAG_END.match(self._data, at)
        assert end is not None
        attributes = dict(zip(pairs[::2], pairs[1::2], strict=True))
        self._open.append(
            _Open(tag, attributes, self._expat.CurrentLineNumber, spans, (begin, end.end()))
        )

    def _characters(self, text: str) -> None:
        self._open[-1].text.append(text)

    def _end(self, tag: str) -> None:
        done = self._open.pop()
        behind = done.opening[1]
        if self._data[behind - 2 : behind] == b"/>":
            closing = (behind, behind)
        else:
            found = _END_TAG.match(self._data, self._expat.CurrentByteIndex)
            assert found is not None
            closing = found.span()
        element = Element(
            tag=tag,
            attributes=done.attributes,
            text="".join(done.text).strip(),
            line=done.line,
            children=tuple(done.children),
            spans=done.spans,
            text_span=self._text_span(behind, closing[0]),
            opening=done.opening,
            closing=closing,
        )
        if self._open:
            self._open[-1].children.append(element)
        else:
            self._root = element

    def _text_span(self, start: int, end: int) -> Span | None:
        if self._data.find(b"<", start, end) >= 0:
            return None
        raw = self._data[start:end]
        left = len(raw) - len(raw.lstrip())
        return (start + left, start + len(raw.rstrip())) if raw.strip() else None


def replaced(data: bytes, changes: Mapping[Span, str]) -> bytes:
    """The bytes with others in place of some spans; all else stays as it is.

    Args:
        data: that was read.
        changes: span -> XML text to stand there; what is empty is an insertion.
    """
    parts, at = [], 0
    for (start, end), text in sorted(changes.items()):
        assert at <= start <= end <= len(data), shown((start, end))
        parts += [data[at:start], text.encode()]
        at = end
    return b"".join([*parts, data[at:]])
