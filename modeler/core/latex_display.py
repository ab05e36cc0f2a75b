r"""Displayed formulas of LaTeX in lines that fit the page, for amsmath and nothing else.

TeX does not break a display by itself. Here a sum is broken before its signs; a term that is wider
than a line is opened: brackets become `\bigl( \bigr)`, a fraction a product with `( )^{-1}`, a root
a power, and the sums inside are broken in turn; last of all a product is broken before a factor.
Widths are bounds from above, from the widths of Computer Modern at 10 pt.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

TEXT_WIDTH = 345.0
"""Points of a line: article at 10 pt, the narrowest of the usual classes with one column."""

_TAG = 40.0  # points that the number of an equation takes, its gap included
_SIGN, _BINARY = 7.8, 12.3  # a sign alone, and with the space around it
_ENDS = ("break", "dot")
_SCRIPT = 0.85  # an index against a letter of full size
_WORDS = {"cdot": 7.3, "_": 6.0, "{": 5.0, "}": 5.0}
_PRINTED = ("sin", "cos", "tan", "exp", "tanh", "sinh", "cosh", "log")
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\s+|.", re.DOTALL)


@dataclass(frozen=True)
class LatexBox:
    """A piece of a formula.

    Attributes:
        text: as it is written.
        width: a bound in points.
        kind: "" of what stays whole; "break" before which a line may end; "times" between factors,
            "dot" where a line may end there; "bracket", "fraction" and "root" can be opened.
        inside: what is between the brackets, above and below the line, or under the root.
        after: the exponent behind a bracket.
    """

    text: str
    width: float
    kind: str = ""
    inside: tuple[tuple["LatexBox", ...], ...] = ()
    after: str = ""


@dataclass(frozen=True)
class DisplayedEquation:
    """left = right; every text of `right` begins a line of its own."""

    left: str
    right: tuple[str, ...]


def display(equations: Sequence[DisplayedEquation], numbered: bool = False) -> str:
    """An `align` (numbered) or `align*` of the equations, without a newline at its end."""
    name = "align" if numbered else "align*"
    room = TEXT_WIDTH - max(width(equation.left) for equation in equations) - _BINARY - 2.0
    sign, more = (" &= ", r"&\quad {}") if numbered else (" ={}& ", "& ")
    end = r" \notag" if numbered else ""
    room -= _TAG + 10.0 if numbered else 0.0
    rows = []
    for equation in equations:
        lines = [line for text in equation.right for line in broken(text, room)]
        first, *others = lines
        lines = [f"{equation.left}{sign}{first}", *(f"{more}{line}" for line in others)]
        rows += [*(line + end for line in lines[:-1]), lines[-1]]
    return f"\\begin{{{name}}}\n" + " \\\\\n".join(rows) + f"\n\\end{{{name}}}"


def broken(text: str, room: float = TEXT_WIDTH) -> list[str]:
    """The formula in lines that are at most `room` points wide; as it is if it fits."""
    boxes = _parsed(text)
    if _total(boxes) <= room:
        return [text]
    lines: list[list[LatexBox]] = [[]]
    for part in _parts(boxes, room):
        if lines[-1] and _total(lines[-1]) + _total(part) > room:
            lines.append([])
        lines[-1] += part
    return [_joined(line) for line in lines]


def width(text: str) -> float:
    """A bound of the width in points."""
    return _total(_parsed(text))


def _total(boxes: Sequence[LatexBox]) -> float:
    return sum(box.width for box in boxes)


def _joined(boxes: Sequence[LatexBox]) -> str:
    """The texts, signs between spaces; a line that begins with a factor has a dot before it."""
    text = ""
    for box in boxes:
        if box.kind == "break":
            text = f"{text.rstrip()} {box.text} "
        elif box.kind == "dot" and not text:
            text = r"\cdot "
        else:
            text += box.text
    return text.strip()


def _parts(boxes: Sequence[LatexBox], room: float) -> Iterator[list[LatexBox]]:
    """Pieces between which lines may end, each as wide as it must be."""
    # before every sign, and before the factors of a product that has to be broken
    starts = [0, *(i for i, box in enumerate(boxes) if i and box.kind in _ENDS), len(boxes)]
    for part in (list(boxes[a:b]) for a, b in pairwise(starts) if a < b):
        if _total(part) <= room:
            yield part
            continue
        wide = max((box for box in part if box.inside), key=lambda box: box.width, default=None)
        if wide is not None:
            at = part.index(wide)
            yield from _parts([*part[:at], *_opened(wide), *part[at + 1 :]], room)
        elif any(box.kind == "times" for box in part):
            dot = LatexBox(r"\,", 7.3, "dot")
            yield from _parts([dot if box.kind == "times" else box for box in part], room)
        else:
            yield part


def _opened(box: LatexBox) -> list[LatexBox]:
    """The same value, written so that it can be broken."""
    if box.kind == "bracket":
        return _bracketed(box.inside[0], box.after)
    if box.kind == "root":
        return _bracketed(box.inside[0], "^{1/2}" + box.after)
    above, below = box.inside
    is_sum = any(piece.kind == "break" for piece in above) or above[0].text == "-"
    top = _bracketed(above) if is_sum else list(above)
    return [*top, LatexBox(r"\,", 1.7, "times"), *_bracketed(below, "^{-1}")]


def _bracketed(inside: Sequence[LatexBox], after: str = "") -> list[LatexBox]:
    close = rf"\bigr){after}"
    return [LatexBox(r"\bigl(", 5.0), *inside, LatexBox(close, 5.0 + 5.0 * len(after))]


class _LatexReader:
    """The boxes of a formula, by recursive descent."""

    def __init__(self, text: str) -> None:
        self.tokens = _TOKEN.findall(text)
        self.at = 0

    def boxes(self, end: str = "") -> tuple[LatexBox, ...]:
        """Up to the token `end`, which is taken."""
        found: list[LatexBox] = []
        while self.at < len(self.tokens):
            token = self._take()
            if token == end:
                break
            if token in "^_":
                self._script(found, token)
            elif token.isspace():
                if found and found[-1].kind in ("", "bracket"):
                    found[-1] = replace(found[-1], text=found[-1].text.rstrip() + " ")
            else:
                unary = not found or found[-1].kind == "break" or found[-1].text == r"\bigl("
                found.append(self._box(token, unary))
        return tuple(found)

    def _next(self) -> str:
        """The token that follows, spaces skipped."""
        while self.at < len(self.tokens) and self.tokens[self.at].isspace():
            self.at += 1
        return str(self.tokens[self.at]) if self.at < len(self.tokens) else ""

    def _take(self) -> str:
        token = self.tokens[self.at] if self.at < len(self.tokens) else ""
        self.at += 1
        return str(token)

    def _box(self, token: str, unary: bool) -> LatexBox:
        if token in "+-":
            return LatexBox(token, _SIGN) if unary else LatexBox(token, _BINARY, "break")
        if token == r"\quad":
            return LatexBox(token, 10.0, "break")
        if token == r"\,":
            return LatexBox(token, 1.7, "times")
        if token == "(":
            return self._bracket("(", ")")
        if token == r"\left":
            return self._bracket(token + self._take(), r"\right")
        if token in (r"\bigl", r"\bigr"):
            return LatexBox(token + self._take(), 5.0)
        if token == "{":
            inside = self.boxes("}")
            return LatexBox(f"{{{_joined(inside)}}}", _total(inside))
        if token.startswith("\\"):
            return self._command(token)
        return LatexBox(token, _letter(token))

    def _bracket(self, opening: str, end: str) -> LatexBox:
        inside = self.boxes(end)
        closing = end + (self._take() if end == r"\right" else "")
        margin = 8.0 if end == ")" else 17.0
        text = f"{opening}{_joined(inside)}{closing}"
        parts = (inside,) if closing[-1] == ")" else ()
        return LatexBox(text, _total(inside) + margin, "bracket", parts)

    def _command(self, token: str) -> LatexBox:
        name = token[1:]
        if name in ("frac", "tfrac"):
            above, below = self._group(), self._group()
            text = f"{token}{{{_joined(above)}}}{{{_joined(below)}}}"
            size = max(_total(above), _total(below)) + 3.0
            return LatexBox(text, size, "fraction", (above, below) if name == "frac" else ())
        if name == "sqrt":
            return self._root()
        if name in ("mathit", "text", "operatorname"):
            word = self._word()
            return LatexBox(f"{token}{{{word}}}", sum(map(_letter, word)) + 3.7)
        if name in ("dot", "ddot"):
            inside = self._group()
            return LatexBox(f"{token}{{{_joined(inside)}}}", _total(inside))
        gap = " " if name[0].isalpha() and self._next()[:1].isalnum() else ""
        # names of functions are printed, of letters drawn
        drawn = 5.0 * len(name) + 3.4 if name in _PRINTED else 9.0
        return LatexBox(token + gap, _WORDS.get(name, drawn))

    def _root(self) -> LatexBox:
        """A square root can be opened, a higher one not."""
        degree = ""
        while self._next() == "[" or (degree and degree[-1] != "]"):
            degree += self._take()
        inside = self._group()
        text = f"\\sqrt{degree}{{{_joined(inside)}}}"
        return LatexBox(text, _total(inside) + 10.0, "root", () if degree else (inside,))

    def _group(self) -> tuple[LatexBox, ...]:
        """What is between braces, or the one token without them."""
        if self._next() != "{":
            return (self._box(self._take(), True),)
        self._take()
        return self.boxes("}")

    def _word(self) -> str:
        """What is between braces, as it stands."""
        self._next()
        self._take()
        word = ""
        while (token := self._take()) not in ("}", ""):
            word += token
        return word

    def _script(self, found: list[LatexBox], token: str) -> None:
        """An index or exponent joins what it belongs to."""
        start = self.at
        size = _SCRIPT * _total(self._group()) + 0.6
        text = token + "".join(self.tokens[start : self.at])
        base = found.pop() if found else LatexBox("{}", 0.0)
        whole, after = base.text.rstrip() + text, base.after + text
        inner = base.inside if base.kind == "bracket" else ()
        found.append(LatexBox(whole, base.width + size, base.kind, inner, after))


def _parsed(text: str) -> tuple[LatexBox, ...]:
    return _LatexReader(text).boxes()


def _letter(letter: str) -> float:
    if letter.isdigit():
        return 5.2
    if letter in "ijlt,.;:!'|/[]":
        return 4.8
    if letter in "mw":
        return 9.0
    if letter in "MW":
        return 12.0
    return 9.5 if letter.isupper() else 6.5
