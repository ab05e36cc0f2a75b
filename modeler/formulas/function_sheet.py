"""Formulas with named intermediate quantities, each written once: a sheet.

A sheet is filled from expressions of a graph. Quantities are proposed with a name, results are
requested; which of the proposed names are worth their line is decided by how often a quantity is
read and by how long it is. What is read more than once and has no name gets one. The graph knows
equal functions, so that c3*s2 + s3*c2 is sin(q2 + q3) wherever that angle is among its nodes.
"""

import re
import sys
import textwrap
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Literal

from modeler.core.formula import DisplayedEquation, format_display, format_latex_name
from modeler.derivation import Expr, Graph, Node
from modeler.formulas.ring import LATEX, TEXT, TextStyle, format_signed_sum
from modeler.formulas.thresholds import THRESHOLDS

VECTOR = "vector:"
"""Begins the symbols of unit vectors."""

ATOMS = ("num", "pi", "sym", "sin", "cos")


@dataclass(frozen=True)
class Definition:
    """One line: name = expression.

    Attributes:
        section: title under which it stands.
        name: of the quantity.
        ref: reference of its value in the graph.
        result: True for what was requested, False for an intermediate quantity.
    """

    section: str
    name: str
    ref: int
    result: bool


@dataclass(frozen=True)
class Sheet:
    """Definitions in an order in which each reads only those before it.

    Attributes:
        graph: of the expressions.
        letters: {symbol of the graph: how it is written}.
        names: {node: (name, sign)}: the node's value is sign * name.
        definitions: in order.
        trig: {node of a sine or cosine: its name}.
        angles: {label: reference of the angle}: s23 is the sine of the angle labelled 23.
        halves: True to write 1/2 as 0.5: so the robot file writes its numbers.
    """

    graph: Graph
    letters: Mapping[str, str]
    names: Mapping[int, tuple[str, int]]
    definitions: tuple[Definition, ...]
    trig: Mapping[int, str]
    angles: Mapping[str, int]
    halves: bool


class SheetWriter:
    """Collects proposals and results; `build_sheet` decides which names stay."""

    def __init__(
        self,
        graph: Graph,
        letters: Mapping[str, str],
        halves: bool = False,
        abbreviate: bool = True,
    ) -> None:
        self.graph, self.halves = graph, halves
        self._unnamed = THRESHOLDS.unnamed_length if abbreviate else sys.maxsize
        self.letters = dict(letters)
        self._taken = set(self.letters.values())
        self._generated: set[str] = set()
        self._section = ""
        self._lines: list[Definition] = []
        self._first: dict[int, Definition] = {}

    def open_section(self, title: str) -> None:
        """Sets the title under which the next lines stand."""
        self._section = title

    def propose_quantity(self, name: str, value: Expr) -> None:
        """Proposes a name for a quantity; the first name of a value stays."""
        node = abs(value.ref)
        if node not in self._first and not self._is_atom(node):
            self._add_definition(name, value, False)

    def add_result(self, name: str, value: Expr, read: bool = True) -> None:
        """Adds a requested quantity; zeros are left out.

        Args:
            name: of the quantity.
            value: of the quantity.
            read: False if no other formula is to be written by its name.
        """
        if value.ref:
            self._add_definition(name, value, True, read)

    def _add_definition(self, name: str, value: Expr, result: bool, read: bool = True) -> None:
        while name in self._taken:
            name += "_"
        self._taken.add(name)
        definition = Definition(self._section, name, value.ref, result)
        self._lines.append(definition)
        if read and not self._is_atom(abs(value.ref)):
            self._first.setdefault(abs(value.ref), definition)

    def build_sheet(self) -> Sheet:
        """Builds the sheet of all results and of what they need."""
        results = [Expr(self.graph, line.ref) for line in self._lines if line.result]
        nodes = self.graph.find_reachable(results)
        turning = [n for n in nodes if self.graph.nodes[n].op in ("sin", "cos")]
        trig, angles = assign_angle_names(self.graph, turning, self.letters, self._taken)
        read = self._find_read_nodes(results)
        nodes = [node for node in nodes if node in read]
        names = self._choose_names(nodes, trig)
        lines = self._arrange_definitions(names)
        if self._replace_early_names(lines):
            names = self._choose_names(nodes, trig)
            lines = self._arrange_definitions(names)
        generated = [line.name for line in lines if line.name in self._generated]
        self._taken -= self._generated
        new = {name: self._generate_name() for name in generated}
        lines = tuple(replace(line, name=new.get(line.name, line.name)) for line in lines)
        names = {node: (new.get(name, name), sign) for node, (name, sign) in names.items()}
        return Sheet(self.graph, self.letters, names, lines, trig, angles, self.halves)

    def _replace_early_names(self, lines: Sequence[Definition]) -> bool:
        """Another name for values that are read before the section of their name."""
        homes = {line.name: line.section for line in self._lines}
        early = [d for d in lines if d.section != homes.get(d.name, d.section)]
        for line in early:
            self._first[abs(line.ref)] = Definition("", self._generate_name(), line.ref, False)
        return bool(early)

    def _is_atom(self, node: int) -> bool:
        return node == 0 or self.graph.nodes[node].op in ATOMS

    def _choose_names(
        self, nodes: Sequence[int], trig: Mapping[int, str]
    ) -> dict[int, tuple[str, int]]:
        """Names that are worth their line, by node; arguments before their users."""
        edges = Counter(abs(arg) for node in nodes for arg in self._get_arguments(node))
        edges.update(abs(line.ref) for line in self._lines if line.result)
        length = {0: 1}
        chosen: dict[int, tuple[str, int]] = {}
        for node in nodes:
            length[node] = self._estimate_length(node, length, trig)
            if self._is_atom(node):
                continue
            proposed = self._first.get(node)
            if proposed is None and edges[node] > 1 and length[node] > self._unnamed:
                proposed = Definition("", self._generate_name(), node, False)
                self._first[node] = proposed
            least = THRESHOLDS.short_length if edges[node] > 1 else THRESHOLDS.single_use_length
            if proposed is not None and (proposed.result or length[node] > least):
                chosen[node] = (proposed.name, 1 if proposed.ref > 0 else -1)
                length[node] = len(proposed.name)
        return chosen

    def _generate_name(self) -> str:
        count = 1
        while f"k{count}" in self._taken:
            count += 1
        self._taken.add(f"k{count}")
        self._generated.add(f"k{count}")
        return f"k{count}"

    def _estimate_length(
        self, node: int, length: Mapping[int, int], trig: Mapping[int, str]
    ) -> int:
        """Characters that the node takes, about."""
        operation = self.graph.nodes[node]
        if operation.op == "num":
            return len(str(operation.args[0]))
        if operation.op == "sym":
            return len(self.letters.get(operation.args[0], operation.args[0]))
        if node in trig:
            return len(trig[node])
        return sum(length[abs(arg)] for arg in operation.args) + (3 if operation.op == "add" else 1)

    def _arrange_definitions(self, names: Mapping[int, tuple[str, int]]) -> tuple[Definition, ...]:
        """Definitions as they were proposed; what is read stands before who reads it."""
        done: set[int] = set()
        lines: list[Definition] = []

        def write_definition(node: int, section: str) -> None:
            if node in done:
                return
            done.add(node)
            for read in self._find_named_arguments(node, names):
                write_definition(read, section)
            lines.append(replace(self._first[node], section=section))

        for line in self._lines:
            node = abs(line.ref)
            if self._first.get(node) is line:
                if node in names:
                    write_definition(node, line.section)
            elif line.result:
                for read in [node] if node in names else self._find_named_arguments(node, names):
                    write_definition(read, line.section)
                lines.append(line)
        return tuple(lines)

    def _find_named_arguments(self, node: int, names: Mapping[int, tuple[str, int]]) -> list[int]:
        """Named nodes that the definition of a node reads, in order."""
        named_nodes: set[int] = set()
        stack = [abs(arg) for arg in self._get_arguments(node)]
        while stack:
            at = stack.pop()
            if at in names:
                named_nodes.add(at)
            else:
                stack += [abs(arg) for arg in self._get_arguments(at)]
        return sorted(named_nodes)

    def _find_read_nodes(self, results: Sequence[Expr]) -> set[int]:
        """Nodes that lines are made of, not those of angles alone."""
        read_nodes, stack = set[int](), [abs(result.ref) for result in results]
        while stack:
            if (at := stack.pop()) not in read_nodes:
                read_nodes.add(at)
                node = self.graph.nodes[at]
                if not _is_turning(node) and node.op not in ("num", "sym"):
                    stack += [abs(arg) for arg in node.args]
        return read_nodes

    def _get_arguments(self, node: int) -> tuple[int, ...]:
        """Sines and cosines have a line of their own, in which their angles stand in full."""
        operation = self.graph.nodes[node]
        return () if _is_turning(operation) or self._is_atom(node) else operation.args


def _is_turning(node: Node) -> bool:
    """True of the sine or cosine of an angle that moves."""
    return node.op in ("sin", "cos") and not node.static


def assign_angle_names(
    graph: Graph, nodes: Iterable[int], letters: Mapping[str, str], taken: set[str]
) -> tuple[dict[int, str], dict[str, int]]:
    """Returns names of sines and cosines, and the angles that they belong to.

    Args:
        graph: of the nodes.
        nodes: of sines and cosines; those of constants keep their function.
        letters: how symbols are written.
        taken: names that are given away; those found are added.

    Returns:
        {node: name} and {label: reference of the angle}, the label being the name without s or c.
    """
    trig: dict[int, str] = {}
    labels: dict[int, str] = {}
    for node in nodes:
        operation = graph.nodes[node]
        if operation.static:
            continue
        angle = operation.args[0]
        if angle not in labels:
            label = _format_angle_label(graph, angle, letters)
            while {f"s{label}", f"c{label}"} & taken:
                label += "_"
            labels[angle] = label
            taken |= {f"s{label}", f"c{label}"}
        trig[node] = operation.op[0] + labels[angle]
    order = sorted(labels, key=lambda ref: (len(labels[ref]), labels[ref]))
    return trig, {labels[ref]: ref for ref in order}


def _format_angle_label(graph: Graph, angle: int, letters: Mapping[str, str]) -> str:
    parts = sorted(_collect_angle_terms(graph, angle, letters), key=lambda part: part[0] < 0)
    if all(sign > 0 and len(text) == 1 for sign, text in parts):
        return "".join(sorted(text for _, text in parts))
    return "".join(("m" if sign < 0 else "p") + text for sign, text in parts).removeprefix("p")


def _collect_angle_terms(
    graph: Graph, ref: int, letters: Mapping[str, str]
) -> list[tuple[int, str]]:
    """The terms of an angle: (sign, letters)."""
    node, sign = graph.nodes[abs(ref)], 1 if ref > 0 else -1
    if node.op == "add":
        parts = (part for arg in node.args for part in _collect_angle_terms(graph, arg, letters))
        return [(sign * s, t) for s, t in parts]
    if node.op == "sym":
        return [(sign, letters.get(node.args[0], node.args[0]).removeprefix("q"))]
    if node.op == "mul" and graph.nodes[abs(node.args[0])].op == "num":
        number = str(graph.nodes[abs(node.args[0])].args[0]).replace("/", "by")
        terms = _collect_angle_terms(graph, node.args[1], letters)
        return [(sign * s, f"{number}x{t}") for s, t in terms]
    return [(sign, f"n{abs(ref)}")]


# A sheet's formulas as text that Python understands, and as LaTeX.


Factor = tuple[int, str, int]
"""(where it stands in a product, text, node of a sum in brackets or 0)."""
Term = tuple[Fraction, tuple[Factor, ...]]

_LETTER, _NAMED, _TRIG, _BRACKET, _UNIT = range(5)
_LATEX_NAMES = (
    (r"qdd(\w+)", r"\\ddot{q}_{\1}"),
    (r"qd(\w+)", r"\\dot{q}_{\1}"),
    (r"q([A-Za-z]\w*)", r"q_{\1}"),
    (r"w([xyz])_(\w+)", r"\\omega_{\1,\2}"),
    (r"wd([xyz])_(\w+)", r"\\dot{\\omega}_{\1,\2}"),
    (r"vd([xyz])_(\w+)", r"\\dot{v}_{\1,\2}"),
    (r"([Ug])([xyz]+)_(\w+)", r"\1_{\2,\3}"),
    (r"J(\w+)inv_(\w+)_(\w+)", r"J^{-1}_{\1;\2,\3}"),
    (r"([WD])(P|[mL]\w+)_(\w+)_(\w+)", r"\1^{\2}_{\3,\4}"),
    (r"J([pt])_?(\w+)_(\w+)", r"J^{\1}_{\2,\3}"),
    (r"J([A-Z][A-Za-z0-9]*)_([A-Za-z0-9]+)", r"J_{\1,\2}"),
    (r"S([A-Z][A-Za-z0-9]*)_([A-Za-z0-9]+)_([A-Za-z0-9]+)", r"S_{\1,\2,\3}"),
    (r"h([A-Z]+)_(\w+)", r"h_{\1,\2}"),
    (r"vCM(\w+)", r"\\mathbf{v}^{CM\1}"),
    (r"omega([A-Z]\w*)", r"\\boldsymbol{\\omega}^{\1}"),
    (r"([Jgbe])([A-Z][A-Za-z0-9]*)", r"\1_{\2}"),
)
"""Names of speeds and of vectors, by frame."""


def _combine_terms(terms: Iterable[Term]) -> dict[tuple[Factor, ...], Term]:
    """{factors in one order: term}, terms alike together."""
    combined: dict[tuple[Factor, ...], Term] = {}
    for number, factors in terms:
        before, first = combined.get(key := tuple(sorted(factors)), (Fraction(0), factors))
        combined[key] = (before + number, first)
    return combined


class SheetPrinter:
    """Writes the values of one sheet in one style."""

    def __init__(self, sheet: Sheet, style: TextStyle = TEXT) -> None:
        self.sheet, self.style = sheet, replace(style, halves=sheet.halves)

    def format_letter(self, name: str) -> str:
        """Returns a name: q, qd, qdd with dots, an underscore as a comma of the index."""
        if not self.style.latex:
            return name
        for pattern, latex in _LATEX_NAMES:
            if re.fullmatch(pattern, name):
                return re.sub(pattern, latex, name)
        split = re.fullmatch(r"([A-Za-z]+)(\d\w*)", name)
        if split:
            return f"{format_latex_name(split[1])}_{{{split[2].replace('_', ',')}}}"
        return format_latex_name(name)

    def format_trig(self, name: str) -> str:
        """Returns a sine or cosine with the signs in its angle."""
        if self.style.latex:
            signs = re.sub(r"(?<=\d)p(?=\d)", "+", re.sub(r"(?<=\d)m(?=\d)", "-", name[1:]))
            return f"{name[0]}_{{{signs}}}"
        return name

    def format_value(self, definition: Definition) -> str:
        """Returns the right side of a definition."""
        node = abs(definition.ref)
        named_value = self.sheet.names.get(node)
        if named_value is not None and named_value[0] != definition.name:
            return self.format_sum(definition.ref)
        return self.format_sum(definition.ref, opened=node)

    def format_sum(self, ref: int, opened: int = 0) -> str:
        """Returns the text of a value; the node `opened` is written out even if it has a name."""
        terms = _combine_terms(self._cancel_terms(self._collect_terms(ref, Fraction(1), opened)))
        units, signed_terms = dict[str, str](), list[tuple[Fraction, str]]()
        for number, factors in terms.values():
            if number:
                signed_terms.append((number, self._format_product(factors)))
                units[signed_terms[-1][1]] = next((f[1] for f in factors if f[0] == _UNIT), "")
        signed_terms.sort(key=lambda term: (units[term[1]], term[0] < 0, not term[1]))
        return format_signed_sum(signed_terms, self.style)

    def _cancel_terms(self, terms: list[Term]) -> list[Term]:
        """Brackets are opened where what is in them cancels: a (x + y) - a (x - y) is 2 a y."""
        opened = [self._expand_bracket(term) for term in terms]
        total = _combine_terms(term for each in opened for term in each)
        gone = {key for key, (number, _) in total.items() if not number}
        return [
            term
            for whole, each in zip(terms, opened, strict=True)
            for term in (each if gone & {*_combine_terms(each)} else [whole])
        ]

    def _expand_bracket(self, term: Term) -> list[Term]:
        """The term multiplied out if it has one bracket."""
        number, factors = term
        brackets = [factor for factor in factors if factor[2]]
        if len(brackets) != 1:
            return [term]
        rest = [factor for factor in factors if not factor[2]]
        inside = self._collect_terms(brackets[0][2], number, brackets[0][2])
        return [(value, (*rest, *more)) for value, more in inside]

    def _collect_terms(self, ref: int, factor: Fraction, opened: int) -> list[Term]:
        node, number = abs(ref), factor if ref > 0 else -factor
        operation = self.sheet.graph.nodes[node]
        if node == 0:
            return []
        if operation.op == "add" and (node == opened or node not in self.sheet.names):
            terms = (self._collect_terms(arg, number, opened) for arg in operation.args)
            return [term for part in terms for term in part]
        value, factors = self._collect_factors(node, opened)
        return [(number * value, tuple(factors))]

    def _collect_factors(self, node: int, opened: int) -> tuple[Fraction, list[Factor]]:
        """(number, factors) of a value that is no sum."""
        operation = self.sheet.graph.nodes[node]
        if node in self.sheet.names and node != opened:
            name, sign = self.sheet.names[node]
            return Fraction(sign), [(_NAMED, self.format_letter(name), 0)]
        if operation.op == "num":
            return operation.args[0], []
        if operation.op == "mul":
            parts = [self._collect_factors(abs(arg), opened) for arg in operation.args]
            sign = 1 if (operation.args[0] > 0) == (operation.args[1] > 0) else -1
            return sign * parts[0][0] * parts[1][0], parts[0][1] + parts[1][1]
        if operation.op == "div":
            return self._format_quotient(operation.args[0], operation.args[1])
        if operation.op == "add":
            text = self.style.add_brackets(self.format_sum(node, opened))
            return Fraction(1), [(_BRACKET, text, node)]
        rank = _LETTER if operation.static else _TRIG if node in self.sheet.trig else _NAMED
        if operation.op == "sym" and operation.args[0].startswith(VECTOR):
            rank = _UNIT
        return Fraction(1), [(rank, self._format_atom(node), 0)]

    def _format_quotient(self, above: int, below: int) -> tuple[Fraction, list[Factor]]:
        """A fraction with the number in front of its numerator taken out."""
        number = Fraction(1 if above > 0 else -1)
        is_sum = (
            self.sheet.graph.nodes[abs(above)].op == "add" and abs(above) not in self.sheet.names
        )
        if is_sum:
            text = self.format_sum(abs(above))
        else:
            value, factors = self._collect_factors(abs(above), 0)
            number, text = number * value, self._format_product(factors) or "1"
        lower = self.format_sum(below)
        if self.style.latex:
            return number, [(_NAMED, rf"\frac{{{text}}}{{{lower}}}", 0)]
        atom = re.compile(r"\w+(\([^()]*\))?")
        closed = (each if atom.fullmatch(each) else f"({each})" for each in (text, lower))
        return number, [(_NAMED, "/".join(closed), 0)]

    def _format_atom(self, node: int) -> str:
        operation = self.sheet.graph.nodes[node]
        if operation.op == "sym":
            letter = self.sheet.letters.get(operation.args[0], operation.args[0])
            if self.style.latex and operation.args[0].startswith(VECTOR):
                return re.sub("(.+?)_(.*)", r"\\mathbf{\1}_{\2}", letter)
            return self.format_letter(letter)
        if node in self.sheet.trig:
            return self.format_trig(self.sheet.trig[node])
        if operation.op == "pi":
            return r"\pi" if self.style.latex else "pi"
        if operation.op == "pow":
            base, exponent = (self.format_sum(arg) for arg in operation.args)
            power = f"^{{{exponent}}}" if self.style.latex else f"**({exponent})"
            return self.style.add_brackets(base) + power
        argument = ", ".join(map(self.format_sum, operation.args))
        if not self.style.latex:
            return f"{operation.op}({argument})"
        if operation.op == "sqrt":
            return f"\\sqrt{{{argument}}}"
        known = operation.op in ("sin", "cos", "tan", "exp", "tanh")
        name = re.sub(r"(\D+)(\d*)", r"\\operatorname{\1}_{\2}", operation.op).removesuffix("_{}")
        return f"\\{operation.op}({argument})" if known else f"{name}({argument})"

    def _format_product(self, factors: Sequence[Factor]) -> str:
        order = sorted(Counter(factors).items(), key=lambda item: item[0][0])
        power = "{}^{{{}}}" if self.style.latex else "{}**{}"
        texts = (at[1] if n == 1 else power.format(at[1], n) for at, n in order)
        return self.style.times.join(texts)


# A sheet as text that Python runs, as LaTeX, as Markdown, as JSON.


_WIDTH = 100
FormulaForm = Literal["text", "latex", "markdown"]
"""How formulas are printed."""


def format_sheet(
    sheet: Sheet, form: FormulaForm = "text", heading: Callable[[str], str] = "% {}".format
) -> str:
    """Returns the formulas as lines of Python, an `align*` a section, or Markdown.

    Args:
        sheet: what to write.
        form: how.
        heading: how titles are written in LaTeX.
    """
    if form == "latex":
        return _format_latex(sheet, heading)
    pattern = "## {}\n\n```python\n{}\n```\n" if form == "markdown" else "# {}\n{}\n"
    sections = (pattern.format(t, "\n".join(lines)) for t, lines in _format_sections(sheet))
    text = "\n".join(sections)
    return text if form == "markdown" else text.removesuffix("\n")


def _format_sections(sheet: Sheet) -> list[tuple[str, list[str]]]:
    """(title, lines of Python)."""
    printer, angles, section = SheetPrinter(sheet), list[str](), None
    for name, function, angle in _collect_trig(printer):
        piece = f"{name} = {function}({angle})"
        if angles and len(angles[-1]) + len(piece) + 2 <= _WIDTH:
            angles[-1] += f"; {piece}"
        else:
            angles.append(piece)
    sections = [("sines and cosines", angles)] if angles else []
    for definition in sheet.definitions:
        if definition.section != section:
            section = definition.section
            sections.append((section, []))
        line = f"{definition.name} = {printer.format_value(definition)}"
        if len(line) > _WIDTH:
            right = f"{definition.name} = ({printer.format_value(definition)})"
            options: Any = {"break_on_hyphens": False, "break_long_words": False}
            more = textwrap.wrap(right, _WIDTH, subsequent_indent="    ", **options)
            sections[-1][1].extend(more)
        else:
            sections[-1][1].append(line)
    return sections


def _collect_trig(printer: SheetPrinter) -> list[tuple[str, str, str]]:
    """(name, "sin" or "cos", angle) of every sine and cosine that is read."""
    sheet, known = printer.sheet, set(printer.sheet.trig.values())
    return [
        (letter + label, function, printer.format_sum(ref))
        for label, ref in sheet.angles.items()
        for letter, function in (("s", "sin"), ("c", "cos"))
        if letter + label in known
    ]


def _format_latex(sheet: Sheet, heading: Callable[[str], str]) -> str:
    printer = SheetPrinter(sheet, LATEX)
    angles = []
    for name, function, angle in _collect_trig(printer):
        angles.append(DisplayedEquation(printer.format_trig(name), (f"\\{function}({angle})",)))
    blocks = {"sines and cosines": angles}
    for definition in sheet.definitions:
        values = (printer.format_value(definition),)
        line = DisplayedEquation(printer.format_letter(definition.name), values)
        blocks.setdefault(definition.section, []).append(line)
    parts = (
        f"{heading(title)}\n{format_display(lines)}\n" for title, lines in blocks.items() if lines
    )
    return "".join(parts)


def serialise_sheet(sheet: Sheet) -> dict[str, Any]:
    """Returns the JSON of a sheet: its angles and its definitions."""
    printer = SheetPrinter(sheet)
    values = [(d, printer.format_value(d)) for d in sheet.definitions]
    return {
        "angles": {label: printer.format_sum(ref) for label, ref in sheet.angles.items()},
        "definitions": [
            {"section": d.section, "name": d.name, "formula": value, "result": d.result}
            for d, value in values
        ],
    }
