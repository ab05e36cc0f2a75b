"""Names as LaTeX, in relations and in closed forms alike, and text around them."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from typing import Literal

from modeler.core.brief import ShortRepr

_GREEK_NAME = re.compile(
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|iota|kappa|lambda|mu|nu|xi|rho|sigma|tau|upsilon"
    "|phi|chi|psi|omega|Gamma|Delta|Theta|Lambda|Xi|Sigma|Upsilon|Phi|Psi|Omega"
)
_SPECIAL = {
    "\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
    "<": r"\textless{}", ">": r"\textgreater{}", "|": r"\textbar{}", '"': "''",
    **{sign: f"\\{sign}" for sign in "#$%&_{}"},
    "\u2013": "--", "\u2014": "---", "\u2018": "`", "\u2019": "'", "\u201c": "``", "\u201d": "''",
    "\u00b1": r"$\pm$", "\u00b0": r"$^\circ$", "\u00b7": r"$\cdot$",
}  # fmt: skip


def format_latex_name(name: str) -> str:
    r"""`ZZ2R` as `\mathit{ZZ}_{2R}`, `D4` as `D_{4}`, `phi1` as `\phi_{1}`.

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
    r"""Text between formulas: `R&D_1` as `R\&D\_1`; a letter that pdfTeX lacks as its code."""
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

_GREEK = {"alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "theta": "θ", "phi": "φ",
          "psi": "ψ", "pi": "π"}  # fmt: skip


@dataclass(frozen=True)
class Formula:
    """A node.

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
    """`ZZ2R` as ZZ with the index 2R, `alpha` as its letter."""
    head, index = _split_index(text)
    letter = Formula("name", _GREEK.get(head, head))
    return letter if not index else Formula("sub", parts=(letter, Formula("name", index)))


def make_number(text: str) -> Formula:
    """A number without a sign."""
    return Formula("number", text)


def make_operator(text: str) -> Formula:
    """Between two others, or before one; a minus as long as a minus."""
    return Formula("operator", "\u2212" if text == "-" else text)


def make_row(*parts: Formula) -> Formula:
    """One after the other; a single one as it is."""
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
