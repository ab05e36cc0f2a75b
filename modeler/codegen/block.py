"""The body of one C function: straight-line code as finished strings.

Order: geometric constants, then sines and cosines (calls between arithmetic make the compiler
spill every register: 144 against 112 ns for a 6R regressor), then output by output, depth first, so
that a value is computed shortly before it is used. A value used once is written into the expression
that uses it, as long as the line stays readable.
"""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from types import MappingProxyType

from modeler.codegen.naming import Letters, Naming
from modeler.codegen.targets import DOUBLE, FUNCTIONS, Target
from modeler.codegen.thresholds import THRESHOLDS
from modeler.core.errors import EmitError
from modeler.core.expression import Law
from modeler.derivation import Expr, Graph, Label

# One operation as C99 text.
#
# Texts are combined from the texts of their operands; a level shows where parentheses are needed.
# Sums and products keep the order of evaluation of the graph: floating point is not associative.


SUM, PRODUCT, ATOM = 1, 2, 3

PI = "3.14159265358979323846"


@dataclass(frozen=True, slots=True)
class CText:
    """C text of a value and its outermost operation: SUM, PRODUCT (or quotient), ATOM."""

    text: str
    level: int

    def parenthesise(self, level: int) -> str:
        """Returns the text, in parentheses if its outermost operation binds less than `level`."""
        return self.text if self.level >= level else f"({self.text})"


def format_number(value: Fraction, target: Target = DOUBLE) -> CText:
    """Returns text of a number that is not negative: the one of the target nearest to it.

    A decimal literal where that is exact (`9.81`), else a quotient (`(1.0/3.0)`), which is rounded
    once as well.

    Raises:
        EmitError: too large or too small for the target.
    """
    assert value >= 0
    nearest = target.round_number(value)
    if Fraction(repr(nearest)) == value or max(value.numerator, value.denominator) > target.exact:
        return CText(target.format_literal(nearest), ATOM)
    end = target.suffix
    return CText(f"({value.numerator}.0{end}/{value.denominator}.0{end})", ATOM)


def format_float(value: float, target: Target = DOUBLE) -> str:
    """Returns text of a number, of either sign, as what a macro stands for: `0.2`, `(-0.1)`."""
    return target.format_literal(value) if value >= 0 else f"({target.format_literal(value)})"


def negate(value: CText) -> CText:
    """Returns the text of -value."""
    return CText(f"-{value.parenthesise(PRODUCT)}", SUM)


def format_sum(a: CText, a_positive: bool, b: CText, b_positive: bool) -> CText:
    """Returns (+-a) + (+-b); the positive one stands first, and a sum on the left."""
    if not a_positive and b_positive:
        return format_sum(b, True, a, False)
    if a_positive and b_positive and b.level == SUM and a.level != SUM:
        a, b = b, a
    first = a.text if a_positive else negate(a).text
    return CText(f"{first} {'+' if b_positive else '-'} {b.parenthesise(PRODUCT)}", SUM)


def format_product(a: CText, b: CText) -> CText:
    """Returns a * b; the one that is a product itself stands first."""
    if b.level == PRODUCT and a.level != PRODUCT:
        a, b = b, a
    return CText(f"{a.parenthesise(PRODUCT)}*{b.parenthesise(ATOM)}", PRODUCT)


_LEAVES = ("num", "pi", "sym")  # nodes without arguments of their own
_PAIR = {"sin": "s", "cos": "c"}
_HOISTED = (*_PAIR, "tan", "exp", "tanh", "pow")


@dataclass(frozen=True)
class Block:
    """Finished C statements.

    Attributes:
        constants: of the geometry; a compiler computes them.
        calls: trigonometry.
        body: arithmetic and outputs.
        symbols: names of the graph's symbols that are read.
        additions: per call of the function; constants are not counted.
        multiplications: the same, divisions included.
        letters: of the names of temporaries.
        laws: tables that are read, by name.
    """

    constants: tuple[str, ...]
    calls: tuple[str, ...]
    body: tuple[str, ...]
    symbols: frozenset[str]
    additions: int
    multiplications: int
    letters: frozenset[Letters] = frozenset()
    laws: Mapping[str, Law] = field(default_factory=dict)


def make_block(
    outputs: Sequence[tuple[str, Expr]],
    places: Mapping[str, str],
    widths: Mapping[int, str] = MappingProxyType({}),
    target: Target = DOUBLE,
    labels: Mapping[int, Label] | None = None,
) -> Block:
    """Returns statements that write every output.

    Args:
        outputs: (C place, value), e.g. ("phi[3]", ...), all of one graph.
        places: C text of every symbol of the graph, e.g. {"q[0]": "q[0]", "D4": "PUMA560_GEO_D4"}.
        widths: {speed: C text of the width over which its sign turns}; other signs leap.
        target: the number type, and what its functions are called.
        labels: what nodes are called; None: as the graph says.

    Raises:
        EmitError: a function or a symbol has no C form.
    """
    if not outputs:
        return Block((), (), (), frozenset(), 0, 0)
    graph = outputs[0][1].graph
    values = [value for _, value in outputs]
    reachable = graph.find_reachable(values)
    inner = [graph.nodes[i] for i in reachable if graph.nodes[i].op not in _LEAVES]
    uses = Counter(abs(arg) for node in inner for arg in node.args)
    uses.update(abs(value.ref) for value in values)
    # What is read more than once gets a name, and what is constant within something variable.
    named = {i for i in reachable if uses[i] > 1}
    for node in inner:
        if not node.static:
            named |= {abs(arg) for arg in node.args if graph.nodes[abs(arg)].static}
    forced = {i for i in named if graph.nodes[i].op not in _LEAVES}
    writer = _Writer(graph, places, widths, target, forced)
    writer.texts[0] = format_number(Fraction(0), target.constant_target)
    hoisted = [i for i in reachable if writer.is_call(i) and not graph.nodes[i].static]
    writer.forced |= set(hoisted)
    for index in reachable:
        if graph.nodes[index].static and index in writer.forced:
            writer.visit_node(index)
    constants = writer.take_lines()
    for index in hoisted:
        writer.visit_node(index)
    calls = writer.take_lines()
    for place, value in outputs:
        writer.lines.append(target.stored.format(place=place, text=writer.format_output(value)))
    additions, multiplications = graph.count_operations(values)
    symbols = frozenset(graph.nodes[i].args[0] for i in reachable if graph.nodes[i].op == "sym")
    parts = constants, calls, writer.take_lines()
    lines = [line for part in parts for line in part]
    labels = graph.labels if labels is None else labels
    naming = Naming(graph, labels, writer.temporaries, lines)
    constants, calls, body = (naming.write_names(part, target.remark) for part in parts)
    tables = {node.op: graph.tables[node.op] for node in inner if node.op in graph.tables}
    laws = {name.partition("_")[0]: tables[name].law for name in sorted(tables)}
    return Block(constants, calls, body, symbols, additions, multiplications, naming.letters, laws)


@dataclass
class _Writer:
    """Texts of the nodes written so far."""

    graph: Graph
    places: Mapping[str, str]
    widths: Mapping[int, str]
    target: Target
    forced: set[int]
    texts: dict[int, CText] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)
    pairs: dict[int, str] = field(default_factory=dict)
    count: dict[str, int] = field(default_factory=lambda: {"k": 0, "t": 0})
    temporaries: dict[str, int] = field(default_factory=dict)

    def is_call(self, index: int) -> bool:
        """Returns True if C calls a function for the node, which stands before the arithmetic."""
        node = self.graph.nodes[index]
        has_width = node.op == "sign" and node.args[0] in self.widths
        return has_width or node.op in (*_HOISTED, *self.graph.tables)

    def take_lines(self) -> tuple[str, ...]:
        """Returns the lines written since the last call, and forgets them."""
        lines, self.lines = tuple(self.lines), []
        return lines

    def format_output(self, value: Expr) -> str:
        """Returns the C text of an output."""
        if value.is_zero:
            zero = format_number(Fraction(0), self.target.constant_target)
            return self._spread_constant(0, zero).text
        self.visit_node(abs(value.ref))
        text = self.texts[abs(value.ref)]
        if value.ref < 0:
            text = self._reverse_difference(value.ref) or negate(text)
        return self._spread_constant(abs(value.ref), text).text

    def _spread_constant(self, index: int, text: CText) -> CText:
        """The text of a node as one of the target's type: constants are single numbers."""
        if not self.graph.nodes[index].static or self.target.constant_target is self.target:
            return text
        return CText(self.target.spread.format(text.text), ATOM)

    def _reverse_difference(self, ref: int) -> CText | None:
        """Text of a negative reference if it can do without a leading minus: -(a - b) = b - a."""
        node = self.graph.nodes[abs(ref)]
        if ref > 0 or node.op != "add" or self.texts[abs(ref)].level != SUM:
            return None
        first, second = (-arg for arg in node.args)
        if first < 0 and second < 0:
            return None
        return format_sum(self.texts[abs(first)], first > 0, self.texts[abs(second)], second > 0)

    def visit_node(self, root: int) -> None:
        """Writes `root` and what it needs, arguments first; no recursion, graphs are deep."""
        stack = [(root, False)]
        while stack:
            index, ready = stack.pop()
            if index in self.texts or index == 0:
                continue
            node = self.graph.nodes[index]
            if ready or node.op in _LEAVES:
                self._write_node(index)
            else:
                stack.append((index, True))
                stack.extend((abs(arg), False) for arg in reversed(node.args))

    def _write_node(self, index: int) -> None:
        node = self.graph.nodes[index]
        if node.op in _PAIR and not node.static:
            self.texts[index] = self._format_turn(node.op, node.args[0])
            return
        self.texts[index] = self._format_node(index)
        if index in self.forced:
            self._name_node(index)

    def _format_turn(self, op: str, angle: int) -> CText:
        """The name of one of them; the first to be read computes both."""
        assert angle > 0, "the graph takes signs out of sines and cosines"
        if angle not in self.pairs:
            # The number of the joint, s0 = sin(q[0]), or one that no joint has.
            node = self.graph.nodes[angle]
            place = self.places[node.args[0]] if node.op == "sym" else ""
            joint = re.fullmatch(r"q(?:\[|_)(\d+)\]?", place)
            name = joint[1] if joint else f"a{len(self.pairs) + 1}"
            self.pairs[angle] = name
            argument = self.texts[angle].text
            words = {"number": self.target.number, "sincos": self.target.sincos}
            texts = (each.format(name=name, angle=argument, **words) for each in self.target.turn)
            self.lines += texts
        return CText(_PAIR[op] + self.pairs[angle], ATOM)

    def _format_node(self, index: int) -> CText:
        text = self._combine_operands(index)
        if self.graph.nodes[index].op in _LEAVES:
            return text  # nothing in it could get a name of its own
        while len(text.text) > THRESHOLDS.max_expression_length:
            args = [abs(a) for a in self.graph.nodes[index].args]
            args = [a for a in args if self.texts[a].level != ATOM]
            if not args:
                break
            self._name_node(max(args, key=lambda a: len(self.texts[a].text)))
            text = self._combine_operands(index)
        return text

    def _combine_operands(self, index: int) -> CText:
        node = self.graph.nodes[index]
        target = self.target.constant_target if node.static else self.target
        if node.op == "num":
            return format_number(node.args[0], target)
        if node.op == "pi":
            return CText(f"{PI}{target.suffix}", ATOM)
        if node.op == "sym":
            if node.args[0] not in self.places:
                raise EmitError(f"symbol {node.args[0]} has no place in the emitted function")
            return CText(self.places[node.args[0]], ATOM)
        args = [self.texts[abs(arg)] for arg in node.args]
        if node.op == "add":
            turned = [self._reverse_difference(arg) for arg in node.args]
            return format_sum(
                turned[0] or args[0],
                turned[0] is not None or node.args[0] > 0,
                turned[1] or args[1],
                turned[1] is not None or node.args[1] > 0,
            )
        if node.op in ("mul", "div"):
            assert all(arg > 0 for arg in node.args), "the graph takes signs out of products"
            if node.op == "mul":
                return format_product(*args)
            return CText(f"{args[0].parenthesise(PRODUCT)}/{args[1].parenthesise(ATOM)}", PRODUCT)
        signed = [a if arg >= 0 else negate(a) for arg, a in zip(node.args, args, strict=True)]
        if not node.static:
            pairs = zip(node.args, signed, strict=True)
            signed = [self._spread_constant(abs(arg), text) for arg, text in pairs]
        if node.op in self.graph.tables:
            name, _, slope = node.op.partition("_slope")
            arguments = ", ".join(each.text for each in signed)
            form = {"axes": len(signed), "along": slope, "name": name, "arguments": arguments}
            return CText(target.law.format(**form), ATOM)
        if node.op == "pow":
            base, exponent = signed
            return CText(f"{target.functions['pow']}({base.text}, {exponent.text})", ATOM)
        if node.op == "sign" and node.args[0] in self.widths:
            width = self.widths[node.args[0]]
            return CText(f"{target.smooth_sign}({signed[0].text}, {width})", ATOM)
        if node.op not in target.functions:
            expected = ", ".join(f for f in FUNCTIONS if f != "pow")
            raise EmitError(f"function {node.op} has no C99 form here; expected {expected}")
        return CText(f"{target.functions[node.op]}({signed[0].text})", ATOM)

    def _name_node(self, index: int) -> None:
        """Give the value a name, and from now on read that."""
        letter, number = "t", self.target.number
        if self.graph.nodes[index].static:
            letter, number = "k", self.target.constant_target.number
        self.count[letter] += 1
        name = f"{letter}{self.count[letter]}"
        self.temporaries[name] = index
        text = self.texts[index].text
        self.lines.append(self.target.temporary.format(number=number, name=name, text=text))
        self.texts[index] = CText(name, ATOM)
