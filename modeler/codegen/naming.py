"""Names of the temporaries of a function, and the comments between them, from the graph's labels.

A name shows quantity, link and component: `wd3_z`, `f3_MXx` of one unit of MX3, `w3b_x` on the way
to w3, `minus_U3_xx` of minus that. Names are unique however their letters are written, as some
languages do not distinguish `U3_x` from `u3_x`. What has no label keeps a number: `t7`.
"""

import re
import textwrap
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from modeler.derivation import Graph, Label

Letters = tuple[str, str, str]
"""Letter of a quantity, "meaning" or of one "unit" of something, and its step."""

_WIDTH = 96  # of a line without its indent
_SHORT = re.compile(r"\b[tk]\d+\b")
_GIVEN = re.compile(r"(?:const \w+ )?(\w+) :?= ")


@cache
def _read_quantities() -> Mapping[str, Any]:
    return tomllib.loads(Path(__file__).with_name("quantities.toml").read_text("utf-8"))


class Naming:
    """The names in the lines of one function.

    Attributes:
        letters: those that occur.
    """

    def __init__(
        self,
        graph: Graph,
        labels: Mapping[int, Label],
        nodes: Mapping[str, int],
        lines: Iterable[str],
    ) -> None:
        """Names them.

        Args:
            graph: of the nodes.
            labels: of nodes.
            nodes: {short name, `t7`: its node}.
            lines: of the function, with short names.
        """
        self._links = graph.links
        self._labels = {s: labels[k] for s, k in nodes.items() if k in labels}
        self.letters = frozenset((e.quantity, _find_kind(e), e.step) for e in self._labels.values())
        self._names: dict[str, str] = {}
        self._announced: set[Letters] = set()
        taken = set(re.findall(r"[a-z_]\w*", "\n".join(lines).lower()))
        for short, label in self._labels.items():
            name = first = _format_name(label)
            while name.lower() in taken:
                number = name[len(first) + 1 :] or "1"
                name = f"{first}_{int(number) + 1}"
            taken.add(name.lower())
            self._names[short] = name

    def write_names(self, lines: Sequence[str], remark: str) -> tuple[str, ...]:
        """Returns the lines with the names, a comment before the first of each quantity of a link.

        As many as before: a comment, and what a line is too long for, stand within the line.

        Args:
            lines: some of the function.
            remark: a comment, around `{}`.
        """
        named_lines = []
        for line in lines:
            assignment = _GIVEN.match(line)
            label = self._labels.get(assignment[1]) if assignment else None
            text = _wrap_line(_SHORT.sub(lambda match: self._names.get(match[0], match[0]), line))
            comment = "" if label is None else self._format_comment(label)
            named_lines.append(f"{_wrap_line(remark.format(comment))}\n{text}" if comment else text)
        return tuple(named_lines)

    def _format_comment(self, label: Label) -> str:
        """What is announced before the first value of a quantity of a link; may be empty."""
        quantity, link = _read_quantities()[label.quantity], self._links[label.link]
        key = (label.quantity, _find_kind(label), label.link)
        if "equation" not in quantity or "d" in label.step or key in self._announced:
            return ""
        self._announced.add(key)
        equation = quantity["equation"] + quantity.get(link.moves, "")
        text = f"{quantity[key[1]]}, {label.quantity}{{j}} = {equation}"
        return f"link {label.link}: " + text.format(
            i=_format_link(link.antecedent), j=_format_link(label.link)
        )


def _find_kind(label: Label) -> str:
    """Which text of its quantity shows what it is, or what it is a derivative of."""
    derived = "d" in label.step and "meaning" in _read_quantities()[label.quantity]
    return "unit" if label.of and not derived else "meaning"


def _format_link(name: str) -> str:
    """A link's name behind the letter of a quantity."""
    word = re.sub(r"\W", "", name)
    return word if word[:1].isdigit() else f"_{word}"


def _format_name(label: Label) -> str:
    component = re.sub(r"\W", "", label.of) + label.component
    name = f"{label.quantity}{_format_link(label.link)}{label.step}"
    name = "minus_" * label.minus + name + f"_{component}" * bool(component)
    return re.sub("__+", "_", name)  # which compilers keep for themselves


def _wrap_line(line: str, width: int = _WIDTH) -> str:
    """The statement in lines of readable length."""
    if len(line) <= width:
        return line
    return textwrap.fill(
        line, width, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False
    )


def format_legend(letters: Iterable[Letters]) -> list[str]:
    """Returns what the letters are, a line for each that occurs; none where nothing is named.

    Args:
        letters: of the functions of a file.
    """
    letter_set, lines, table = set(letters), [], dict(_read_quantities())
    for step, meaning in table.pop("steps").items():
        owners = sorted({each[0] for each in letter_set if step in each[2]}, key=str.lower)
        line = f"...{step}   {meaning}: {', '.join(owners)}"
        lines += _wrap_line(line, 90).split("\n") if owners else []
    rows = [
        f"{letter + '_1' * (kind == 'unit'):<7}{quantity[kind]}"
        for letter, quantity in table.items()
        for kind in ("meaning", "unit")
        if any(each[:2] == (letter, kind) for each in letter_set)
    ]
    return rows + lines
