"""The body of one C function: straight-line code as finished strings.

Order: geometric constants, then sines and cosines (calls between arithmetic make the compiler
spill every register: 144 against 112 ns for a 6R regressor), then output by output, depth first, so
that a value is computed shortly before it is used. A value used once is written into the expression
that uses it, as long as the line stays readable.
"""

import dataclasses
import re
import textwrap
import tomllib
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from modeler.codegen.thresholds import THRESHOLDS
from modeler.core.choices import Precision
from modeler.core.errors import EmitError
from modeler.core.expression import Law
from modeler.derivation import Expr, Graph, Label

# What emitted arithmetic is made of: number type, literals, functions.
#
# One emitter writes a function for doubles, for floats, and for a vector whose lanes are samples.
# Templates are given the words of the target of their module (`words`). The hand-written runtime is
# the same text for both precisions: there `modeler_real.h` says what a number is, and names the
# external functions of floats `modelerf_...`, since a program may hold robots of both kinds.


FUNCTIONS = ("sin", "cos", "tan", "sqrt", "exp", "tanh", "abs", "pow", "sign")
"""Functions of the graph: those of math.h, and the sign of modeler_runtime.h."""

_MATH = {name: name for name in FUNCTIONS} | {"abs": "fabs"}


@dataclass(frozen=True)
class Target:
    """How a value is written.

    Attributes:
        number: C type of a value that depends on the motion.
        suffix: of a literal.
        precision: "double" or "single", for messages.
        exact: integers up to here are exact, so a quotient of two such literals is rounded once.
        smallest: least positive number with all its digits.
        largest: greatest finite number.
        functions: {function of the graph: C name}, all of `FUNCTIONS`.
        sincos: C name of the function that gives sine and cosine at once.
        smooth_sign: C name of the sign that turns over a width.
        law: call of a law that was learned, of `{name}`, `{axes}`, `{along}` (which derivative,
            "", "x" or "y") and `{arguments}`.
        spread: C text of a value of all lanes that are alike, of `{0}`, one number.
        constant: target of values that do not depend on the motion; None: this one.
        point: True if a literal has a point before its exponent, 1.0E-05.
        temporary: statement that names a value.
        stored: statement that writes an output.
        turn: statements that make sine and cosine of an angle.
        remark: comment.
    """

    number: str
    suffix: str
    precision: Precision
    exact: int
    smallest: Fraction
    largest: Fraction
    functions: Mapping[str, str]
    sincos: str
    smooth_sign: str
    law: str = "modeler_law_{axes}{along}(&{name}, {arguments})"
    spread: str = "{0}"
    constant: "Target | None" = None
    point: bool = False
    temporary: str = "const {number} {name} = {text};"
    stored: str = "{place} = {text};"
    turn: tuple[str, str] = ("{number} s{name}, c{name};", "{sincos}({angle}, &s{name}, &c{name});")
    remark: str = "/* {} */"

    @property
    def constant_target(self) -> "Target":
        """Returns the target of constants of the geometry."""
        return self.constant or self

    def round_number(self, value: Fraction) -> float:
        """Returns the double next to a number that this target can hold.

        Raises:
            EmitError: it is too large or too small; says what the target holds.
        """
        size = abs(value)
        if size > self.largest or (0 < size < self.smallest and self.precision == "single"):
            number = str(value) if size > DOUBLE.largest else repr(float(value))
            raise EmitError(
                f"number {number} is too {'large' if size > 1 else 'small'} for {self.precision} "
                f"precision, which has {float(self.smallest):.2g} to {float(self.largest):.2g}; "
                f"rescale it{', or generate in double precision' * (self.precision == 'single')}"
            )
        return float(value)

    def format_literal(self, value: float) -> str:
        """Returns a number as C has it.

        Raises:
            EmitError: it is too large or too small.
        """
        self.round_number(Fraction(value))
        digits, power, exponent = repr(value).partition("e")
        if power and self.point:
            digits, power = digits if "." in digits else f"{digits}.0", "E"
        return f"{digits}{power}{exponent}{self.suffix}"

    @property
    def template_words(self) -> dict[str, Any]:
        """Returns what templates write numbers with."""
        single = self.precision == "single"
        return {
            "single": single,
            "real": self.number,  # the type
            "f": self.suffix,  # of literals, and of the functions of <math.h>
            "literal": self.format_literal,
            "wide": "(double)" if single else "",  # before what printf prints
        }


DOUBLE = Target(
    number="double",
    suffix="",
    precision="double",
    exact=2**53,
    smallest=Fraction(1, 2**1022),
    largest=Fraction(2**53 - 1) * 2 ** (1024 - 53),
    functions=MappingProxyType(_MATH | {"sign": "modeler_sign"}),
    sincos="modeler_sincos",
    smooth_sign="smooth_sign",
)

SINGLE = Target(
    number="float",
    suffix="f",
    precision="single",
    exact=2**24,
    smallest=Fraction(1, 2**126),
    largest=Fraction(2**24 - 1) * 2 ** (128 - 24),
    functions=MappingProxyType(
        {name: f"{c}f" for name, c in _MATH.items()} | {"sign": "modeler_sign"}
    ),
    sincos="modeler_sincos",
    smooth_sign="smooth_sign",
)

OF_PRECISION: Mapping[Precision, Target] = MappingProxyType({"double": DOUBLE, "single": SINGLE})
"""Targets of one sample."""

CUDA = dataclasses.replace(DOUBLE, sincos="sincos")
"""CUDA has all functions of math.h, and one of its own for both."""

TILES: Mapping[Precision, Target] = MappingProxyType(
    {
        precision: dataclasses.replace(
            target,
            number="modeler_lanes",
            functions=MappingProxyType({name: f"modeler_lanes_{c}" for name, c in _MATH.items()}),
            sincos="modeler_lanes_sincos",
            smooth_sign="modeler_lanes_smooth_sign",
            law="modeler_lanes_law_{axes}{along}(&{name}, {arguments})",
            spread="modeler_lanes_spread({0})",
            constant=target,
        )
        for precision, target in OF_PRECISION.items()
    }
)
"""Targets of vectors whose lanes are samples."""


# Names of the temporaries of a function, and the comments between them, from the graph's labels.
#
# A name shows quantity, link and component: `wd3_z`, `f3_MXx` of one unit of MX3, `w3b_x` on the
# way to w3, `minus_U3_xx` of minus that. Names are unique however their letters are written, as
# some languages do not distinguish `U3_x` from `u3_x`. What has no label keeps a number: `t7`.


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
