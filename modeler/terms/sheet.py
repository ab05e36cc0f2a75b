"""Formulas with named intermediate quantities, each written once: a sheet.

A sheet is filled from expressions of a graph. Quantities are proposed with a name, results are
asked for; which of the proposed names are worth their line is decided by how often a quantity is
read and by how long it is. What is read more than once and has no name gets one. The graph knows
equal functions, so that c3*s2 + s3*c2 is sin(q2 + q3) wherever that angle is among its nodes.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from modeler.symbolic import Expr, Graph

SHORT = 7
"""Characters up to which a quantity is written wherever it is read."""
ONCE = 40
"""Characters up to which a quantity that is read once is written where it is read."""
UNNAMED = 14
"""Characters from which a quantity without a proposed name, read more than once, gets one."""

ATOMS = ("num", "pi", "sym", "sin", "cos")


@dataclass(frozen=True)
class Definition:
    """One line: name = expression.

    Attributes:
        section: title under which it stands.
        name: of the quantity.
        ref: reference of its value in the graph.
        result: True for what was asked for, False for an intermediate quantity.
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
    """

    graph: Graph
    letters: Mapping[str, str]
    names: Mapping[int, tuple[str, int]]
    definitions: tuple[Definition, ...]
    trig: Mapping[int, str]
    angles: Mapping[str, int]

    @property
    def results(self) -> Mapping[str, Expr]:
        """The results by name."""
        return {d.name: Expr(self.graph, d.ref) for d in self.definitions if d.result}


class SheetWriter:
    """Collects proposals and results; `finished` decides which names stay."""

    def __init__(self, graph: Graph, letters: Mapping[str, str]) -> None:
        self.graph = graph
        self.letters = dict(letters)
        self._taken = set(self.letters.values())
        self._own: set[str] = set()
        self._section = ""
        self._lines: list[Definition] = []
        self._first: dict[int, Definition] = {}

    def section(self, title: str) -> None:
        """What follows stands under that title."""
        self._section = title

    def propose(self, name: str, value: Expr) -> None:
        """A quantity that may get this name; the first name of a value stays."""
        node = abs(value.ref)
        if node not in self._first and not self._is_atom(node):
            self._add(name, value, False)

    def result(self, name: str, value: Expr) -> None:
        """A quantity that is asked for; zeros are left out."""
        if value.ref:
            self._add(name, value, True)

    def _add(self, name: str, value: Expr, result: bool) -> None:
        while name in self._taken:
            name += "_"
        self._taken.add(name)
        definition = Definition(self._section, name, value.ref, result)
        self._lines.append(definition)
        if not self._is_atom(abs(value.ref)):
            self._first.setdefault(abs(value.ref), definition)

    def finished(self) -> Sheet:
        """The sheet of all results and of what they need."""
        results = [Expr(self.graph, line.ref) for line in self._lines if line.result]
        nodes = self.graph.reachable(results)
        turning = [n for n in nodes if self.graph.nodes[n].op in ("sin", "cos")]
        trig, angles = angle_names(self.graph, turning, self.letters, self._taken)
        names = self._chosen(nodes, trig)
        lines = self._ordered(names)
        if self._replaced(lines):
            names = self._chosen(nodes, trig)
            lines = self._ordered(names)
        new = self._renumbered(lines)
        lines = tuple(replace(line, name=new.get(line.name, line.name)) for line in lines)
        names = {node: (new.get(name, name), sign) for node, (name, sign) in names.items()}
        return Sheet(self.graph, self.letters, names, lines, trig, angles)

    def _renumbered(self, lines: Sequence[Definition]) -> dict[str, str]:
        """Own names in the order in which they are read."""
        given = [line.name for line in lines if line.name in self._own]
        self._taken -= self._own
        return {name: self._own_name() for name in given}

    def _replaced(self, lines: Sequence[Definition]) -> bool:
        """Another name for values that are read before the section of their name."""
        homes = {line.name: line.section for line in self._lines}
        early = [d for d in lines if d.section != homes.get(d.name, d.section)]
        for line in early:
            self._first[abs(line.ref)] = Definition("", self._own_name(), line.ref, False)
        return bool(early)

    def _is_atom(self, node: int) -> bool:
        return node == 0 or self.graph.nodes[node].op in ATOMS

    def _chosen(self, nodes: Sequence[int], trig: Mapping[int, str]) -> dict[int, tuple[str, int]]:
        """Names that are worth their line, by node; arguments before their users."""
        edges, length = self._edges(nodes), {0: 1}
        chosen: dict[int, tuple[str, int]] = {}
        for node in nodes:
            length[node] = self._length(node, length, trig)
            if self._is_atom(node):
                continue
            proposed = self._first.get(node)
            if proposed is None and edges.get(node, 0) > 1 and length[node] > UNNAMED:
                proposed = Definition("", self._own_name(), node, False)
                self._first[node] = proposed
            least = SHORT if edges.get(node, 0) > 1 else ONCE
            if proposed is not None and (proposed.result or length[node] > least):
                chosen[node] = (proposed.name, 1 if proposed.ref > 0 else -1)
                length[node] = len(proposed.name)
        return chosen

    def _own_name(self) -> str:
        count = 1
        while f"k{count}" in self._taken:
            count += 1
        self._taken.add(f"k{count}")
        self._own.add(f"k{count}")
        return f"k{count}"

    def _edges(self, nodes: Iterable[int]) -> dict[int, int]:
        """How often each node is read, by others and as a result."""
        read = [abs(arg) for node in nodes for arg in self._args(node)]
        read += [abs(line.ref) for line in self._lines if line.result]
        found: dict[int, int] = {}
        for node in read:
            found[node] = found.get(node, 0) + 1
        return found

    def _length(self, node: int, length: Mapping[int, int], trig: Mapping[int, str]) -> int:
        """Characters that the node takes, about."""
        found = self.graph.nodes[node]
        if found.op == "num":
            return len(str(found.args[0]))
        if found.op == "sym":
            return len(self.letters.get(found.args[0], found.args[0]))
        if node in trig:
            return len(trig[node])
        return sum(length[abs(arg)] for arg in found.args) + (3 if found.op == "add" else 1)

    def _ordered(self, names: Mapping[int, tuple[str, int]]) -> tuple[Definition, ...]:
        """Definitions as they were proposed; what is read stands before who reads it."""
        done: set[int] = set()
        lines: list[Definition] = []

        def write(node: int, section: str) -> None:
            if node in done:
                return
            done.add(node)
            for read in self._reads(node, names):
                write(read, section)
            lines.append(replace(self._first[node], section=section))

        for line in self._lines:
            node = abs(line.ref)
            if self._first.get(node) is line:
                if node in names:
                    write(node, line.section)
            elif line.result:
                for read in [node] if node in names else self._reads(node, names):
                    write(read, line.section)
                lines.append(line)
        return tuple(lines)

    def _reads(self, node: int, names: Mapping[int, tuple[str, int]]) -> list[int]:
        """Named nodes that the definition of a node reads, in order."""
        found: set[int] = set()
        stack = [abs(arg) for arg in self._args(node)]
        while stack:
            at = stack.pop()
            if at in names:
                found.add(at)
            else:
                stack += [abs(arg) for arg in self._args(at)]
        return sorted(found)

    def _args(self, node: int) -> tuple[int, ...]:
        return () if self._is_atom(node) else self.graph.nodes[node].args


def angle_names(
    graph: Graph, nodes: Iterable[int], letters: Mapping[str, str], taken: set[str]
) -> tuple[dict[int, str], dict[str, int]]:
    """Names of sines and cosines, and the angles that they belong to.

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
        found = graph.nodes[node]
        if found.static:
            continue
        angle = found.args[0]
        if angle not in labels:
            label = _label(graph, angle, letters)
            while {f"s{label}", f"c{label}"} & taken:
                label += "_"
            labels[angle] = label
            taken |= {f"s{label}", f"c{label}"}
        trig[node] = found.op[0] + labels[angle]
    order = sorted(labels, key=lambda ref: (len(labels[ref]), labels[ref]))
    return trig, {labels[ref]: ref for ref in order}


def _label(graph: Graph, angle: int, letters: Mapping[str, str]) -> str:
    parts = sorted(_summed(graph, angle, letters), key=lambda part: part[0] < 0)
    if all(sign > 0 and len(text) == 1 for sign, text in parts):
        return "".join(sorted(text for _, text in parts))
    return "".join(("m" if sign < 0 else "p") + text for sign, text in parts).removeprefix("p")


def _summed(graph: Graph, ref: int, letters: Mapping[str, str]) -> list[tuple[int, str]]:
    """The terms of an angle: (sign, letters)."""
    node, sign = graph.nodes[abs(ref)], 1 if ref > 0 else -1
    if node.op == "add":
        return [(sign * s, t) for arg in node.args for s, t in _summed(graph, arg, letters)]
    if node.op == "sym":
        return [(sign, letters.get(node.args[0], node.args[0]).removeprefix("q"))]
    if node.op == "mul" and graph.nodes[abs(node.args[0])].op == "num":
        number = str(graph.nodes[abs(node.args[0])].args[0]).replace("/", "by")
        return [(sign * s, f"{number}x{t}") for s, t in _summed(graph, node.args[1], letters)]
    return [(sign, f"n{abs(ref)}")]
