"""A sheet as text that Python runs, as LaTeX, as Markdown, as JSON."""

import textwrap
from collections.abc import Callable
from typing import Any

from modeler.core.latex_lines import Equation, display
from modeler.terms.sheet import Definition, Sheet
from modeler.terms.sheet_text import SheetPrinter
from modeler.terms.text import LATEX

_WIDTH = 100


def sheet_lines(sheet: Sheet) -> list[str]:
    """The formulas as lines of Python, titles as comments."""
    lines: list[str] = []
    for title, formulas in _sections(sheet):
        lines += ["", f"# {title}", *formulas] if lines else [f"# {title}", *formulas]
    return lines


def sheet_markdown(sheet: Sheet) -> str:
    """The lines of Python under headings."""
    parts = []
    for title, formulas in _sections(sheet):
        parts += [f"## {title}", "", "```python", *formulas, "```", ""]
    return "\n".join(parts)


def _sections(sheet: Sheet) -> list[tuple[str, list[str]]]:
    """(title, lines of Python)."""
    printer = SheetPrinter(sheet)
    angles = _angle_lines(sheet)
    found = [("sines and cosines", angles)] if angles else []
    section = None
    for definition in sheet.definitions:
        if definition.section != section:
            section = definition.section
            found.append((section, []))
        line = f"{printer.name(definition)} = {printer.value(definition)}"
        found[-1][1].extend(_wrapped(line))
    return found


def _angle_lines(sheet: Sheet) -> list[str]:
    printer, lines, line = SheetPrinter(sheet), list[str](), ""
    known = set(sheet.trig.values())
    for label, ref in sheet.angles.items():
        for letter, function in (("s", "sin"), ("c", "cos")):
            if letter + label in known:
                piece = f"{letter}{label} = {function}({printer.sum(ref)})"
                if line and len(line) + len(piece) + 2 > _WIDTH:
                    lines.append(line)
                    line = ""
                line += f"; {piece}" if line else piece
    return [*lines, line] if line else lines


def _wrapped(line: str) -> list[str]:
    if len(line) <= _WIDTH:
        return [line]
    head, right = line.split(" = ", 1)
    return textwrap.wrap(
        f"{head} = ({right})", _WIDTH, subsequent_indent="    ", break_on_hyphens=False
    )


def sheet_latex(sheet: Sheet, heading: Callable[[str], str] | None = None) -> str:
    """One `align*` per section.

    Args:
        sheet: what to write.
        heading: how titles are written; None for comments.
    """
    heading = heading or _comment
    printer, known = SheetPrinter(sheet, LATEX), set(sheet.trig.values())
    blocks: dict[str, list[Equation]] = {"sines and cosines": []}
    for label, ref in sheet.angles.items():
        for letter, function in (("s", r"\sin"), ("c", r"\cos")):
            if letter + label in known:
                name = printer.style.trig(letter + label)
                right = f"{function}({printer.sum(ref)})"
                blocks["sines and cosines"].append(Equation(name, (right,)))
    for definition in sheet.definitions:
        line = Equation(printer.name(definition), (printer.value(definition),))
        blocks.setdefault(definition.section, []).append(line)
    return "".join(
        f"{heading(title)}\n{display(lines)}\n" for title, lines in blocks.items() if lines
    )


def _comment(title: str) -> str:
    return f"% {title}"


def sheet_json(sheet: Sheet) -> dict[str, Any]:
    """{"angles", "definitions": [{"section", "name", "formula", "result"}]}."""
    printer = SheetPrinter(sheet)

    def entry(definition: Definition) -> dict[str, Any]:
        return {
            "section": definition.section,
            "name": definition.name,
            "formula": printer.value(definition),
            "result": definition.result,
        }

    return {
        "angles": {label: printer.sum(ref) for label, ref in sheet.angles.items()},
        "definitions": [entry(definition) for definition in sheet.definitions],
    }
