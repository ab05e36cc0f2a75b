"""Formulas: names as LaTeX, trees for MathML, displayed equations in lines."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

from modeler.core.json import ShortRepr

_GREEK_NAME = re.compile(
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|iota|kappa|lambda|mu|nu|xi|rho|sigma|tau|upsilon"
    "|phi|chi|psi|omega|Gamma|Delta|Theta|Lambda|Xi|Sigma|Upsilon|Phi|Psi|Omega"
)
_SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': "''",
    **{sign: f"\\{sign}" for sign in "#$%&_{}"},
    "\u2013": "--",
    "\u2014": "---",
    "\u2018": "`",
    "\u2019": "'",
    "\u201c": "``",
    "\u201d": "''",
    "\u00b1": r"$\pm$",
    "\u00b0": r"$^\circ$",
    "\u00b7": r"$\cdot$",
}


def format_latex_name(name: str) -> str:
    r"""Returns `ZZ2R` as `\mathit{ZZ}_{2R}`, `D4` as `D_{4}`, `phi1` as `\phi_{1}`.

    An underscore is a letter of the name, so that different names stay different.
    """
    head, index = _split_index(name)
    if _GREEK_NAME.fullmatch(head):
        head = f"\\{head}"
    elif len(head) > 1:
        head = f"\\mathit{{{_escape_underscores(head)}}}"
    return f"{head}_{{{_escape_underscores(index)}}}" if index else head


def _split_index(name: str) -> tuple[str, str | None]:
    """`ZZ2R` as ZZ and 2R."""
    split = re.fullmatch(r"([A-Za-z]+)(\d\w*)?", name)
    return (split[1], split[2]) if split else (name, None)


def escape_latex(text: str) -> str:
    r"""Returns text between formulas: `R&D_1` as `R\&D\_1`.

    A letter that pdfTeX lacks as its code.
    """
    return "".join(_SPECIAL.get(letter) or _encode_letter(letter) for letter in text)


def _encode_letter(letter: str) -> str:
    """Letters of Latin-1 as they are; else the same letter without its accents, or its code."""
    if letter.isascii() or (letter.isalpha() and ord(letter) < 0x100):
        return letter
    plain = unicodedata.normalize("NFKD", letter).encode("ascii", "ignore").decode()
    return escape_latex(plain) or f"[U+{ord(letter):04X}]"


def _escape_underscores(text: str) -> str:
    return text.replace("_", r"\_")


# A formula as a tree of plain data, for whoever sets it: pages do, as MathML.


Kind = Literal["row", "name", "number", "operator", "sub", "sup", "fraction", "fenced"]

_GREEK = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "theta": "θ",
    "phi": "φ",
    "psi": "ψ",
    "pi": "π",
}


@dataclass(frozen=True)
class Formula:
    """A node of the tree of a formula.

    Attributes:
        kind: "name", "number" and "operator" have a text; "row" stands in a line, "fenced" in
            brackets; "sub", "sup" and "fraction" have two parts.
        text: of a leaf.
        parts: of the others.
    """

    kind: Kind
    text: str = ""
    parts: tuple[Formula, ...] = ()


def make_name(text: str) -> Formula:
    """Returns `ZZ2R` as ZZ with the index 2R, `alpha` as its letter."""
    head, index = _split_index(text)
    letter = Formula("name", _GREEK.get(head, head))
    return letter if not index else Formula("sub", parts=(letter, Formula("name", index)))


def make_number(text: str) -> Formula:
    """Returns a number without a sign."""
    return Formula("number", text)


def make_operator(text: str) -> Formula:
    """Returns an operator, between two others or before one; a minus as long as a minus."""
    return Formula("operator", "\u2212" if text == "-" else text)


def make_row(*parts: Formula) -> Formula:
    """Returns formulas one after the other; a single one as it is."""
    return parts[0] if len(parts) == 1 else Formula("row", parts=parts)


# Formulas as plain text and as LaTeX, which a notebook typesets.


@dataclass(frozen=True)
class Formulas(ShortRepr):
    """Formulas of a robot.

    Attributes:
        title: what they are, plain text.
        text: one a line.
        latex: an environment of LaTeX, without dollars.
        markdown: for a page.
    """

    title: str
    text: str
    latex: str
    markdown: str

    def __str__(self) -> str:
        return self.text

    def _repr_latex_(self) -> str:
        lines = self.latex.splitlines()
        return "\n".join(_format_heading(line) if line.startswith("% ") else line for line in lines)


def _format_heading(comment: str) -> str:
    r"""A comment of LaTeX as words between the formulas: MathJax knows `\text`."""
    return rf"$\text{{{comment[2:]}}}$"


# Displayed formulas of LaTeX in lines that fit the page, for amsmath and nothing else.
#
# TeX does not break a display by itself. Here a sum is broken before its signs; a term that is
# wider than a line is opened: brackets become `\bigl( \bigr)`, a fraction a product with
# `( )^{-1}`, a root a power, and the sums inside are broken in turn; last of all a product is
# broken before a factor.
# Widths are bounds from above, from the widths of Computer Modern at 10 pt.


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
    inside: tuple[tuple[LatexBox, ...], ...] = ()
    after: str = ""


@dataclass(frozen=True)
class DisplayedEquation:
    """left = right; every text of `right` begins a line of its own."""

    left: str
    right: tuple[str, ...]


def format_display(equations: Sequence[DisplayedEquation], numbered: bool = False) -> str:
    """Returns an `align` (numbered) or `align*` of the equations, without a newline at its end."""
    name = "align" if numbered else "align*"
    room = TEXT_WIDTH - max(measure_width(equation.left) for equation in equations) - _BINARY - 2.0
    sign, more = (" &= ", r"&\quad {}") if numbered else (" ={}& ", "& ")
    end = r" \notag" if numbered else ""
    room -= _TAG + 10.0 if numbered else 0.0
    rows = []
    for equation in equations:
        lines = [line for text in equation.right for line in break_lines(text, room)]
        first, *others = lines
        lines = [f"{equation.left}{sign}{first}", *(f"{more}{line}" for line in others)]
        rows += [*(line + end for line in lines[:-1]), lines[-1]]
    return f"\\begin{{{name}}}\n" + " \\\\\n".join(rows) + f"\n\\end{{{name}}}"


def break_lines(text: str, room: float = TEXT_WIDTH) -> list[str]:
    """Returns the formula in lines that are at most `room` points wide; as it is if it fits."""
    boxes = _parse_boxes(text)
    if _sum_widths(boxes) <= room:
        return [text]
    lines: list[list[LatexBox]] = [[]]
    for part in _split_parts(boxes, room):
        if lines[-1] and _sum_widths(lines[-1]) + _sum_widths(part) > room:
            lines.append([])
        lines[-1] += part
    return [_join_boxes(line) for line in lines]


def measure_width(text: str) -> float:
    """Returns a bound of the width in points."""
    return _sum_widths(_parse_boxes(text))


def _sum_widths(boxes: Sequence[LatexBox]) -> float:
    return sum(box.width for box in boxes)


def _join_boxes(boxes: Sequence[LatexBox]) -> str:
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


def _split_parts(boxes: Sequence[LatexBox], room: float) -> Iterator[list[LatexBox]]:
    """Pieces between which lines may end, each as wide as it must be."""
    # before every sign, and before the factors of a product that has to be broken
    starts = [0, *(i for i, box in enumerate(boxes) if i and box.kind in _ENDS), len(boxes)]
    for part in (list(boxes[a:b]) for a, b in pairwise(starts) if a < b):
        if _sum_widths(part) <= room:
            yield part
            continue
        wide = max((box for box in part if box.inside), key=lambda box: box.width, default=None)
        if wide is not None:
            at = part.index(wide)
            yield from _split_parts([*part[:at], *_open_box(wide), *part[at + 1 :]], room)
        elif any(box.kind == "times" for box in part):
            dot = LatexBox(r"\,", 7.3, "dot")
            yield from _split_parts([dot if box.kind == "times" else box for box in part], room)
        else:
            yield part


def _open_box(box: LatexBox) -> list[LatexBox]:
    """The same value, written so that it can be broken."""
    if box.kind == "bracket":
        return _wrap_brackets(box.inside[0], box.after)
    if box.kind == "root":
        return _wrap_brackets(box.inside[0], "^{1/2}" + box.after)
    above, below = box.inside
    is_sum = any(piece.kind == "break" for piece in above) or above[0].text == "-"
    top = _wrap_brackets(above) if is_sum else list(above)
    return [*top, LatexBox(r"\,", 1.7, "times"), *_wrap_brackets(below, "^{-1}")]


def _wrap_brackets(inside: Sequence[LatexBox], after: str = "") -> list[LatexBox]:
    close = rf"\bigr){after}"
    return [LatexBox(r"\bigl(", 5.0), *inside, LatexBox(close, 5.0 + 5.0 * len(after))]


class _LatexReader:
    """The boxes of a formula, by recursive descent."""

    def __init__(self, text: str) -> None:
        self.tokens = _TOKEN.findall(text)
        self.at = 0

    def read_boxes(self, end: str = "") -> tuple[LatexBox, ...]:
        """Reads boxes up to the token `end`, which is taken, and returns them."""
        boxes: list[LatexBox] = []
        while self.at < len(self.tokens):
            token = self._take_token()
            if token == end:
                break
            if token in "^_":
                self._attach_script(boxes, token)
            elif token.isspace():
                if boxes and boxes[-1].kind in ("", "bracket"):
                    boxes[-1] = replace(boxes[-1], text=boxes[-1].text.rstrip() + " ")
            else:
                unary = not boxes or boxes[-1].kind == "break" or boxes[-1].text == r"\bigl("
                boxes.append(self._read_box(token, unary))
        return tuple(boxes)

    def _peek_token(self) -> str:
        """The token that follows, spaces skipped."""
        while self.at < len(self.tokens) and self.tokens[self.at].isspace():
            self.at += 1
        return str(self.tokens[self.at]) if self.at < len(self.tokens) else ""

    def _take_token(self) -> str:
        token = self.tokens[self.at] if self.at < len(self.tokens) else ""
        self.at += 1
        return str(token)

    def _read_box(self, token: str, unary: bool) -> LatexBox:
        if token in "+-":
            return LatexBox(token, _SIGN) if unary else LatexBox(token, _BINARY, "break")
        if token == r"\quad":
            return LatexBox(token, 10.0, "break")
        if token == r"\,":
            return LatexBox(token, 1.7, "times")
        if token == "(":
            return self._read_bracket("(", ")")
        if token == r"\left":
            return self._read_bracket(token + self._take_token(), r"\right")
        if token in (r"\bigl", r"\bigr"):
            return LatexBox(token + self._take_token(), 5.0)
        if token == "{":
            inside = self.read_boxes("}")
            return LatexBox(f"{{{_join_boxes(inside)}}}", _sum_widths(inside))
        if token.startswith("\\"):
            return self._read_command(token)
        return LatexBox(token, _estimate_letter_width(token))

    def _read_bracket(self, opening: str, end: str) -> LatexBox:
        inside = self.read_boxes(end)
        closing = end + (self._take_token() if end == r"\right" else "")
        margin = 8.0 if end == ")" else 17.0
        text = f"{opening}{_join_boxes(inside)}{closing}"
        parts = (inside,) if closing[-1] == ")" else ()
        return LatexBox(text, _sum_widths(inside) + margin, "bracket", parts)

    def _read_command(self, token: str) -> LatexBox:
        name = token[1:]
        if name in ("frac", "tfrac"):
            above, below = self._read_group(), self._read_group()
            text = f"{token}{{{_join_boxes(above)}}}{{{_join_boxes(below)}}}"
            size = max(_sum_widths(above), _sum_widths(below)) + 3.0
            return LatexBox(text, size, "fraction", (above, below) if name == "frac" else ())
        if name == "sqrt":
            return self._read_root()
        if name in ("mathit", "text", "operatorname"):
            word = self._read_word()
            return LatexBox(f"{token}{{{word}}}", sum(map(_estimate_letter_width, word)) + 3.7)
        if name in ("dot", "ddot"):
            inside = self._read_group()
            return LatexBox(f"{token}{{{_join_boxes(inside)}}}", _sum_widths(inside))
        gap = " " if name[0].isalpha() and self._peek_token()[:1].isalnum() else ""
        # names of functions are printed, of letters drawn
        drawn = 5.0 * len(name) + 3.4 if name in _PRINTED else 9.0
        return LatexBox(token + gap, _WORDS.get(name, drawn))

    def _read_root(self) -> LatexBox:
        """A square root can be opened, a higher one not."""
        degree = ""
        while self._peek_token() == "[" or (degree and degree[-1] != "]"):
            degree += self._take_token()
        inside = self._read_group()
        text = f"\\sqrt{degree}{{{_join_boxes(inside)}}}"
        return LatexBox(text, _sum_widths(inside) + 10.0, "root", () if degree else (inside,))

    def _read_group(self) -> tuple[LatexBox, ...]:
        """What is between braces, or the one token without them."""
        if self._peek_token() != "{":
            return (self._read_box(self._take_token(), True),)
        self._take_token()
        return self.read_boxes("}")

    def _read_word(self) -> str:
        """What is between braces, as it stands."""
        self._peek_token()
        self._take_token()
        word = ""
        while (token := self._take_token()) not in ("}", ""):
            word += token
        return word

    def _attach_script(self, boxes: list[LatexBox], token: str) -> None:
        """An index or exponent joins what it belongs to."""
        start = self.at
        size = _SCRIPT * _sum_widths(self._read_group()) + 0.6
        text = token + "".join(self.tokens[start : self.at])
        base = boxes.pop() if boxes else LatexBox("{}", 0.0)
        whole, after = base.text.rstrip() + text, base.after + text
        inner = base.inside if base.kind == "bracket" else ()
        boxes.append(LatexBox(whole, base.width + size, base.kind, inner, after))


def _parse_boxes(text: str) -> tuple[LatexBox, ...]:
    return _LatexReader(text).read_boxes()


def _estimate_letter_width(letter: str) -> float:
    if letter.isdigit():
        return 5.2
    if letter in "ijlt,.;:!'|/[]":
        return 4.8
    if letter in "mw":
        return 9.0
    if letter in "MW":
        return 12.0
    return 9.5 if letter.isupper() else 6.5
