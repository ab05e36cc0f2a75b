"""Graph of expressions: nodes that are shared, derivatives, and the labels of what they mean."""

import hashlib
import operator
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple, Union

import numpy as np

from modeler.core.errors import DerivationError
from modeler.core.expression import FUNCTIONS, LAW, Law
from modeler.derivation.thresholds import THRESHOLDS


class Label(NamedTuple):
    """What a node of a graph is.

    Attributes:
        quantity: a letter of `codegen/quantities.toml`.
        link: name of the row whose frame it is given in.
        component: "x", "xy" of a matrix, "" of a number.
        step: "a" or "b", on the way to the quantity; empty for itself.
        of: the joint or parameter that it is for one unit of; may be empty.
        minus: True if the node is minus that.
    """

    quantity: str
    link: str
    component: str
    step: str
    of: str
    minus: bool


class Link(NamedTuple):
    """A row: name of its antecedent, "0" of the base; "turning", "sliding", or "" if fixed."""

    antecedent: str
    moves: str


# Expression graph: hash-consed, with exact constants and folding while it is built.
#
# A value is a *reference*: an integer whose sign is the sign of the value and whose magnitude is a
# node; 0 is the constant zero, 1 the constant one. So negation costs nothing, `x - x` and `0*x`
# vanish where they arise, and equal expressions are one node. A node is *static* if it holds only
# numbers and geometric symbols; products and sums collect their static factors, as a compiler would
# fold numbers, so that symbolic lengths cost no more operations than numeric ones.
#
# Two expressions are equal when they are equal as functions, however they are written: every node
# carries its value modulo the prime 2**61 - 1 at a fixed random point, with cos and sin on the unit
# circle (those of a sum are composed of those of its terms), and a new node whose value is known is
# the known node. So c*c + s*s is 1, and what vanishes identically is the zero. (Two different
# rational functions of degree d share a value with a probability of about d * 2**-61; emitted code
# is compared with other derivations anyway.)


# Values of expressions by steps that are listed once: closing loops asks hundreds of times.


_DIVIDE = {"div": operator.truediv}
OPERATIONS: Mapping[str, Callable[..., Any]] = {"add": operator.add, "mul": operator.mul, **_DIVIDE}


@dataclass(frozen=True)
class Arithmetic:
    """Numbers in which expressions are evaluated.

    Attributes:
        number: a rational number as one of them.
        pi: as one of them, with the precision of the caller.
        functions: by name, `OPERATIONS` and "pow" of two arguments, the others of one; "law" of a
            `Table` and its arguments.
    """

    number: Callable[[Fraction], Any]
    pi: Callable[[], Any]
    functions: Mapping[str, Callable[..., Any]]


_FLOATS = {name: getattr(np, name) for name in FUNCTIONS} | {"pow": np.power}
_NUMERIC = {**OPERATIONS, **_FLOATS, LAW: lambda table, *x: table(*x)}
FLOATS = Arithmetic(float, lambda: np.pi, _NUMERIC)

_ALONE = -1
"""In place of the second argument of a function of one."""


class Plan:
    """Outputs as a function of numbers, or arrays of samples, for the symbols."""

    def __init__(
        self, graph: "Graph", outputs: Sequence["Expr"], arithmetic: Arithmetic = FLOATS
    ) -> None:
        needed = graph.find_reachable(outputs)
        place = {0: 0} | {index: k for k, index in enumerate(needed, start=1)}
        self._start: list[Any] = [arithmetic.number(Fraction(0))] * len(place)
        self._inputs: list[tuple[int, str]] = []
        self._steps: list[tuple[int, Callable[..., Any], int, int]] = []
        for index in needed:
            node, at = graph.nodes[index], place[index]
            if node.op == "num":
                self._start[at] = arithmetic.number(node.args[0])
            elif node.op == "pi":
                self._start[at] = arithmetic.pi()
            elif node.op == "sym":
                self._inputs.append((at, node.args[0]))
            else:
                a, b = (*node.args, None)[:2]
                second = _ALONE if b is None else place[abs(b)]
                table = graph.tables.get(node.op)
                known = arithmetic.functions[LAW if table else node.op]
                call = _apply_signs(partial(known, table) if table else known, node.op, a, b)
                self._steps.append((at, call, place[abs(a)], second))
        self._outputs = [(place[abs(output.ref)], output.ref < 0) for output in outputs]

    def __call__(self, values: Mapping[str, Any]) -> list[Any]:
        """The outputs; `values` by name."""
        results = self._start.copy()
        for at, name in self._inputs:
            results[at] = values[name]
        for at, step, a, b in self._steps:
            results[at] = step(results[a]) if b == _ALONE else step(results[a], results[b])
        return [-results[at] if negative else results[at] for at, negative in self._outputs]


def _apply_signs(call: Callable[..., Any], op: str, a: int, b: int | None) -> Callable[..., Any]:
    """The operation on the values of the nodes of a and b, with the signs that these have."""
    if b is None:
        return call if a >= 0 else lambda x: call(-x)
    if a >= 0 and b >= 0:
        return call
    if op == "add" and a >= 0:
        return operator.sub
    if op == "add" and b >= 0:
        return lambda x, y: y - x
    return lambda x, y: call(x if a >= 0 else -x, y if b >= 0 else -y)


PRIME = 2**61 - 1
_MULTIPLIED = range(101)  # exponents of which powers are multiplied out

Number = int | Fraction
Operand = Union["Expr", int, Fraction]


@dataclass(frozen=True, slots=True)
class Node:
    """One operation of a graph.

    Attributes:
        op: "num" (args: a positive Fraction), "pi" (no args), "sym" (args: name), "add", "mul",
            "div" (args: two references), a function name (args: one reference), or that of a table
            (args: one reference for each axis).
        static: True if it depends on numbers and geometric symbols only.
    """

    op: str
    args: tuple[Any, ...]
    static: bool


@dataclass(frozen=True)
class Table:
    """A law that was learned, as an operation.

    Attributes:
        law: it.
        along: its derivative along this axis; None: itself.
    """

    law: Law
    along: int | None

    def __call__(self, *x: Any) -> Any:
        """Its value."""
        return self.law(*x, along=self.along)


class Graph:
    """Nodes in order of creation: arguments always stand before their users.

    Attributes:
        nodes: the operations.
        tables: {operation: the law that was learned, or its derivative along an axis}.
        labels: {node: what it is}, of those that were named; see `attach_labels`.
        links: {name: the row}, for those who write of them.
        called: {quantity: another}, while speeds are put in the place of accelerations.

    Args:
        apart: True for functions of different inputs: a known node is taken only where it reads no
            symbol that the new one does without. (What qdd cancels out of may be written with it.)
    """

    def __init__(self, apart: bool = False) -> None:
        one = Node("num", (Fraction(1),), True)
        self.nodes: list[Node] = [Node("num", (Fraction(0),), True), one]
        self._index: dict[tuple[str, tuple[Any, ...]], int] = {("num", one.args): 1}
        self._residue = [0, 1]
        self._by_residue = {0: 0, 1: 1}
        self._apart = apart
        self._read = [0, 0]  # symbols that a node reads, a bit for each
        self._symbols = 0
        self._plans: dict[tuple[int, ...], Plan] = {}
        self._reached: tuple[list[int], list[int]] = ([], [])
        self.tables: dict[str, Table] = {}
        self.labels: dict[int, Label] = {}
        self.links: dict[str, Link] = {}
        self.renamed_quantities: Mapping[str, str] = {}

    def symbol(self, name: str, static: bool = False) -> "Expr":
        """Returns the input of that name; `static` for geometric symbols."""
        return Expr(self, self._intern_node("sym", (name,), static))

    def constant(self, value: Number) -> "Expr":
        """Returns an exact number."""
        return Expr(self, self._intern_number(Fraction(value)))

    def lift(self, value: Operand) -> "Expr":
        """Returns `value` as an expression of this graph."""
        return value if isinstance(value, Expr) else self.constant(value)

    def pi(self) -> "Expr":
        """Returns the constant pi: a node of its own, not a rational number."""
        return Expr(self, self._intern_node("pi", (), True))

    def call(self, name: str, argument: "Expr") -> "Expr":
        """Returns a function of one argument; odd and even functions take the sign out."""
        ref = argument.ref
        sign = 1
        if ref < 0 and name in ("sin", "tan", "sign", "tanh"):
            sign, ref = -1, -ref
        elif ref < 0 and name in ("cos", "abs"):
            ref = -ref
        if ref == 0:
            return self.constant(1 if name in ("cos", "exp") else 0)
        return Expr(self, sign * self._intern_node(name, (ref,), self.nodes[abs(ref)].static))

    def law(self, law: Law, *arguments: "Expr", along: int | None = None) -> "Expr":
        """Returns a law that was learned, or its derivative along an axis."""
        table = Table(law, along)
        name = next((name for name, known in self.tables.items() if known == table), "")
        if not name:
            laws = list(dict.fromkeys(known.law for known in self.tables.values()))
            number = laws.index(law) if law in laws else len(laws)
            name = f"law{number + 1}" + ("" if along is None else "_slope" + "xy"[along])
            self.tables[name] = table
        args = tuple(argument.ref for argument in arguments)
        return Expr(self, self._intern_node(name, args, False))

    def power(self, base: "Expr", exponent: "Expr") -> "Expr":
        """Returns base**exponent for any constant exponent; the base is not negative."""
        node = self.nodes[abs(exponent.ref)]
        if exponent.ref > 0 and node.op == "num" and node.args[0] in _MULTIPLIED:
            return base ** int(node.args[0])
        static = self.nodes[abs(base.ref)].static and node.static
        return Expr(self, self._intern_node("pow", (base.ref, exponent.ref), static))

    def _intern_node(self, op: str, args: tuple[Any, ...], static: bool) -> int:
        """Reference of the operation: a known one of the same value, or a new node."""
        key = (op, args)
        ref = self._index.get(key)
        if ref is None:
            residue = self._evaluate_modulo(op, args)
            read = self._collect_symbol_bits(op, args) if self._apart else 0
            # Numbers are compared as numbers: two of them may well agree modulo the prime.
            ref = None if op == "num" else self._find_known(residue)
            if ref is None or self._read[abs(ref)] & ~read:
                ref = len(self.nodes)
                self.nodes.append(Node(op, args, static))
                self._residue.append(residue)
                self._read.append(read)
                if op == "num":
                    self._by_residue.setdefault(residue, ref)
                else:
                    if ref is not None:
                        self._by_residue.pop(PRIME - residue, None)
                    self._by_residue[residue] = ref
            self._index[key] = ref
        return ref

    def _collect_symbol_bits(self, op: str, args: tuple[Any, ...]) -> int:
        """Which symbols an operation reads."""
        if op == "sym":
            self._symbols += 1
            return 1 << self._symbols
        read = 0
        for arg in args if op not in ("num", "pi") else ():
            read |= self._read[abs(arg)]
        return read

    def _find_known(self, residue: int) -> int | None:
        if residue in self._by_residue:
            return self._by_residue[residue]
        opposite = self._by_residue.get(PRIME - residue)
        return None if opposite is None else -opposite

    def _evaluate_modulo(self, op: str, args: tuple[Any, ...]) -> int:
        """Value of an operation modulo the prime, at the graph's random point."""
        if op == "num":
            number = args[0]
            if number.numerator % PRIME == 0 or number.denominator % PRIME == 0:
                return _draw_residue(f"num {number}")
            return number.numerator * pow(number.denominator, -1, PRIME) % PRIME
        if op in ("sym", "pi"):
            return _draw_residue(f"{op} {args}")
        values = [self._residue[arg] if arg > 0 else -self._residue[-arg] for arg in args]
        if op == "add":
            return (values[0] + values[1]) % PRIME
        if op == "mul":
            return values[0] * values[1] % PRIME
        if op == "div":
            return values[0] * pow(values[1], -1, PRIME) % PRIME
        if op in ("sin", "cos"):
            c, s = self._evaluate_angle(args[0])
            return s if op == "sin" else c
        return _draw_residue(f"{op} {[value % PRIME for value in values]}")

    def _evaluate_angle(self, ref: int) -> tuple[int, int]:
        """(cos, sin) of an angle modulo the prime; those of sums and multiples are composed."""
        if ref <= 0:
            c, s = (1, 0) if ref == 0 else self._evaluate_angle(-ref)
            return c, -s % PRIME
        node = self.nodes[ref]
        if node.op == "add":
            first, second = (self._evaluate_angle(arg) for arg in node.args[:2])
            return _compose_angles(first, second)
        multiple = node.op == "mul" and self._is_number(node.args[0])
        factor = self._get_number(node.args[0]) if multiple else 0
        if factor in range(1, THRESHOLDS.max_angle_multiple):  # a small whole number
            turn, total = self._evaluate_angle(node.args[1]), (1, 0)
            for _ in range(int(factor)):
                total = _compose_angles(total, turn)
            return total
        # tan of half the angle is drawn for each angle; 1 + t*t is never 0 modulo this prime.
        t = _draw_residue(f"angle {self._residue[ref]}")
        scale = pow(1 + t * t, -1, PRIME)
        return (1 - t * t) * scale % PRIME, 2 * t * scale % PRIME

    def _intern_number(self, value: Fraction) -> int:
        if value == 0:
            return 0
        index = self._intern_node("num", (abs(value),), True)
        return index if value > 0 else -index

    def _get_number(self, ref: int) -> Fraction:
        value = self.nodes[abs(ref)].args[0]
        return value if ref > 0 else -value

    def _is_number(self, ref: int) -> bool:
        return ref == 0 or self.nodes[abs(ref)].op == "num"

    def mul(self, a: int, b: int) -> int:
        """Returns reference of a * b."""
        if a == 0 or b == 0:
            return 0
        sign = 1 if (a > 0) == (b > 0) else -1
        a, b = abs(a), abs(b)
        if a == 1 or b == 1:
            return sign * a * b
        first, second = self.nodes[a], self.nodes[b]
        if first.op == "num" and second.op == "num":
            return sign * self._intern_number(first.args[0] * second.args[0])
        if second.static and not first.static:
            a, b, first, second = b, a, second, first
        if first.static and not second.static:
            factor, rest = self._separate_static_factor(b)
            if factor != 1:
                return sign * self.mul(self.mul(a, factor), rest)
        elif a > b:
            a, b = b, a
        return sign * self._intern_node("mul", (a, b), first.static and second.static)

    def _separate_static_factor(self, ref: int) -> tuple[int, int]:
        """(static factor, dynamic rest) of a positive reference."""
        node = self.nodes[ref]
        if node.op == "mul" and self.nodes[abs(node.args[0])].static and not node.static:
            return node.args
        return 1, ref

    def add(self, a: int, b: int) -> int:
        """Returns reference of a + b."""
        if a == 0 or b == 0:
            return a + b
        if a == -b:
            return 0
        if self._is_number(a) and self._is_number(b):
            return self._intern_number(self._get_number(a) + self._get_number(b))
        merged = self._merge_terms(a, b)
        if merged is not None:
            return merged
        if abs(a) > abs(b):
            a, b = b, a
        sign = 1 if a > 0 else -1
        static = self.nodes[abs(a)].static and self.nodes[abs(b)].static
        return sign * self._intern_node("add", (sign * a, sign * b), static)

    def _merge_terms(self, a: int, b: int) -> int | None:
        """k x + l x = (k + l) x, and (x + y) - y = x."""
        if a == b:
            return self.mul(self._intern_number(Fraction(2)), a)
        if not (self.nodes[abs(a)].static or self.nodes[abs(b)].static):
            (k, x), (l, y) = (self._separate_static_factor(abs(ref)) for ref in (a, b))
            if x == y:
                return self.mul(self.add(k if a > 0 else -k, l if b > 0 else -l), x)
        for total, part in ((a, b), (b, a)):
            node = self.nodes[abs(total)]
            if node.op == "add":
                sign = 1 if total > 0 else -1
                x, y = sign * node.args[0], sign * node.args[1]
                if x == -part:
                    return y
                if y == -part:
                    return x
        return None

    def div(self, a: int, b: int) -> int:
        """Returns reference of a / b."""
        if b == 0:
            raise ZeroDivisionError("division by an expression that is exactly zero")
        if a == 0:
            return 0
        if self._is_number(b):
            return self.mul(a, self._intern_number(1 / self._get_number(b)))
        if abs(a) == abs(b):
            return 1 if a == b else -1
        sign = 1 if (a > 0) == (b > 0) else -1
        a, b = abs(a), abs(b)
        if self.nodes[b].static and a != 1:
            return sign * self.mul(self.div(1, b), a)
        static = self.nodes[a].static and self.nodes[b].static
        return sign * self._intern_node("div", (a, b), static)

    def find_reachable(self, outputs: Iterable["Expr"]) -> list[int]:
        """Returns nodes that the outputs need, arguments first; node 0 left out."""
        needed: set[int] = set()
        stack = [abs(output.ref) for output in outputs]
        asked, cached_nodes = self._reached  # Jacobians ask once for each variable
        if stack == asked:
            return cached_nodes
        asked = stack.copy()
        while stack:
            index = stack.pop()
            if index in needed or index == 0:
                continue
            needed.add(index)
            node = self.nodes[index]
            if node.op not in ("num", "pi", "sym"):
                stack.extend(abs(arg) for arg in node.args)
        self._reached = asked, sorted(needed)
        return self._reached[1]

    def count_operations(self, outputs: Sequence["Expr"]) -> tuple[int, int]:
        """Returns (additions, multiplications) per call; static parts are not counted."""
        reachable = (self.nodes[i] for i in self.find_reachable(outputs))
        dynamic = [node.op for node in reachable if not node.static]
        return dynamic.count("add"), dynamic.count("mul") + dynamic.count("div")

    def evaluate_outputs(self, outputs: Sequence["Expr"], values: Mapping[str, Any]) -> list[Any]:
        """Returns values of the outputs for numbers or arrays of the symbols."""
        refs = tuple(output.ref for output in outputs)
        plan = self._plans.pop(refs, None) or Plan(self, outputs)
        self._plans[refs] = plan  # the last that was requested is the last to go
        if len(self._plans) > THRESHOLDS.cached_plans:
            del self._plans[next(iter(self._plans))]
        return plan(values)


def _compose_angles(a: tuple[int, int], b: tuple[int, int]) -> tuple[int, int]:
    """(cos, sin) of the sum of two angles."""
    return (a[0] * b[0] - a[1] * b[1]) % PRIME, (a[1] * b[0] + a[0] * b[1]) % PRIME


def _draw_residue(name: str) -> int:
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:8], "big") % PRIME


class Expr:
    """A value of a graph, with Python operators."""

    __slots__ = ("graph", "ref")

    def __init__(self, graph: Graph, ref: int) -> None:
        self.graph = graph
        self.ref = ref

    @property
    def is_zero(self) -> bool:
        """Returns True for the structural zero."""
        return self.ref == 0

    def __add__(self, other: Operand) -> "Expr":
        return Expr(self.graph, self.graph.add(self.ref, self.graph.lift(other).ref))

    def __sub__(self, other: Operand) -> "Expr":
        return Expr(self.graph, self.graph.add(self.ref, -self.graph.lift(other).ref))

    def __mul__(self, other: Operand) -> "Expr":
        return Expr(self.graph, self.graph.mul(self.ref, self.graph.lift(other).ref))

    def __truediv__(self, other: Operand) -> "Expr":
        return Expr(self.graph, self.graph.div(self.ref, self.graph.lift(other).ref))

    def __neg__(self) -> "Expr":
        return Expr(self.graph, -self.ref)

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other: Operand) -> "Expr":
        return self.graph.lift(other) - self

    def __rtruediv__(self, other: Operand) -> "Expr":
        return self.graph.lift(other) / self

    def __pow__(self, exponent: "int | Expr") -> "Expr":
        if isinstance(exponent, Expr):
            return self.graph.power(self, exponent)
        if not isinstance(exponent, int):
            raise TypeError(f"only integer powers, got exponent {exponent!r}")
        result = self.graph.constant(1)
        for _ in range(abs(exponent)):
            result = result * self
        return result if exponent >= 0 else 1 / result


def attach_labels(
    quantity: str,
    link: str,
    values: Any,
    step: str = "",
    of: str = "",
    components: Sequence[str] = "xyz",
) -> Any:
    """Labels the values as this quantity of a link, and returns them.

    A node keeps its first label, whatever else it turns out to be, unless that is a step; other
    algebras than the graph's have none.

    Args:
        quantity: a letter; see `Label`.
        link: name of the row; without one nothing is named.
        values: one for each component.
        step: on the way to the quantity.
        of: a joint or parameter that the quantity is one unit of.
        components: their names.
    """
    for component, value in zip(components, values if link else (), strict=bool(link)):
        if isinstance(value, Expr) and abs(value.ref) > 1:
            known = value.graph.labels.get(abs(value.ref))
            if known is None or (known.step and not step):
                letter = value.graph.renamed_quantities.get(quantity, quantity)
                label = Label(letter, link, component, step, of, value.ref < 0)
                value.graph.labels[abs(value.ref)] = label
    return values


def attach_matrix_labels(quantity: str, link: str, matrix: list[Any], step: str = "") -> list[Any]:
    """Labels the rows of a 3 x 3 matrix as this quantity of a link, and returns them."""
    for line, axis in zip(matrix, "xyz", strict=True):
        attach_labels(quantity, link, line, step, components=[axis + other for other in "xyz"])
    return matrix


def combine_linearly(graph: Graph, form: Mapping[int, Fraction], values: Any) -> Expr:
    """Returns sum of coefficient * value over {place of the value: coefficient}."""
    total = graph.constant(0)
    for k, coefficient in form.items():
        total = total + values[k] * coefficient
    return total


# What the kinematics needs of the numbers it computes with.
#
# The recursions are written once with Python operators; an algebra says what a constant, a joint
# variable and its sine and cosine are: graph expressions, trigonometric polynomials, floats.


Scalar = Any
Vector = list[Scalar]
"""Three scalars."""


# Derivatives of graph expressions along a direction, by the rules of differentiation.


_EVERYWHERE = {"add", "mul", "div", "sin", "cos", "sqrt", "exp", "tan", "tanh"}
"""Operations that have a derivative wherever they have a value, for our purposes."""


def differentiate(
    values: Sequence[Expr], direction: Mapping[str, Expr], kinks: bool = False
) -> list[Expr]:
    """Returns d values / ds where each symbol of `direction` moves with that speed.

    With speeds 1 and 0 these are partial derivatives; with dq/dt they are time derivatives.

    Args:
        values: of one graph.
        direction: {symbol: speed}.
        kinks: True to take 0 for the derivative of a sign, and the sign for that of |x|.

    Raises:
        DerivationError: a function that has no derivative everywhere (sign, abs), without `kinks`.
    """
    if not values:
        return []
    graph = values[0].graph
    zero = graph.constant(0)
    slopes: dict[int, Expr] = {0: zero}
    for index in graph.find_reachable(values):
        node = graph.nodes[index]
        if node.op == "sym":
            slopes[index] = direction.get(node.args[0], zero)
        elif node.static:
            slopes[index] = zero
        elif (kinks or node.op in _EVERYWHERE) and not any(
            slopes[abs(ref)].ref for ref in node.args
        ):
            slopes[index] = zero  # most nodes depend on few symbols
        else:
            slopes[index] = _differentiate_node(index, node, values[0], slopes, kinks)
            _attach_label(graph, index, slopes[index], direction)
    return [slopes[abs(v.ref)] if v.ref >= 0 else -slopes[-v.ref] for v in values]


def _attach_label(graph: Graph, index: int, slope: Expr, direction: Mapping[str, Expr]) -> None:
    """Names it by what is derived, and by the one variable that moves, or the time."""
    if label := graph.labels.get(index):
        by = re.sub(r"\W", "", min(direction)) if len(direction) == 1 else "t"
        value = [-slope if label.minus else slope]
        step, of = f"{label.step}d", label.of + by
        attach_labels(label.quantity, label.link, value, step, of, [label.component])


def _differentiate_node(
    index: int, node: Node, like: Expr, known: Mapping[int, Expr], kinks: bool
) -> Expr:
    graph = like.graph
    args = [Expr(graph, ref) for ref in node.args]
    slopes = [known[abs(a.ref)] if a.ref >= 0 else -known[-a.ref] for a in args]
    if node.op == "add":
        return slopes[0] + slopes[1]
    if node.op == "mul":
        return slopes[0] * args[1] + args[0] * slopes[1]
    if table := graph.tables.get(node.op):
        if table.along is not None:
            raise DerivationError("a law that was learned is derived once only")
        total = graph.constant(0)
        for axis, slope in enumerate(slopes):
            total = total + (graph.law(table.law, *args, along=axis) * slope if slope.ref else 0)
        return total
    value = Expr(graph, index)
    if node.op == "div":
        return (slopes[0] - value * slopes[1]) / args[1]
    rules: dict[str, Callable[[Expr], Expr]] = {
        "sin": lambda x: graph.call("cos", x),
        "cos": lambda x: -graph.call("sin", x),
        "sqrt": lambda x: 1 / (2 * value),
        "exp": lambda x: value,
        "tan": lambda x: 1 + value * value,
        "tanh": lambda x: 1 - value * value,
    }
    if kinks:
        rules |= {
            "sign": lambda x: graph.constant(0),
            "abs": lambda x: graph.call("sign", x),
            "pow": lambda x: args[1] * graph.power(x, args[1] - 1),  # of constant exponents
        }
    if node.op not in rules:
        raise DerivationError(f"{node.op} has no derivative everywhere")
    return rules[node.op](args[0]) * slopes[0]
