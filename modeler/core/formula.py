"""A formula as a tree of plain data, for whoever sets it: pages do, as MathML."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

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


def name(text: str) -> Formula:
    """`ZZ2R` as ZZ with the index 2R, `alpha` as its letter."""
    split = re.fullmatch(r"([A-Za-z]+)(\d\w*)?", text)
    head, index = (split[1], split[2]) if split else (text, None)
    letter = Formula("name", _GREEK.get(head, head))
    return letter if not index else Formula("sub", parts=(letter, Formula("name", index)))


def number(text: str) -> Formula:
    """A number without a sign."""
    return Formula("number", text)


def operator(text: str) -> Formula:
    """Between two others, or before one; a minus as long as a minus."""
    return Formula("operator", "\u2212" if text == "-" else text)


def row(*parts: Formula) -> Formula:
    """One after the other; a single one as it is."""
    return parts[0] if len(parts) == 1 else Formula("row", parts=parts)
