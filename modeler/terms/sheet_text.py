"""A sheet's formulas as text that Python understands, and as LaTeX."""

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from modeler.core.latex import latex_name
from modeler.terms.sheet import Definition, Sheet
from modeler.terms.text import TEXT, Style, signed_sum

Factor = tuple[int, str, int]
"""(where it stands in a product, text, node of a sum in brackets or 0)."""
Term = tuple[Fraction, tuple[Factor, ...]]

_LETTER, _NAMED, _TRIG, _BRACKET = range(4)
_LATEX_NAMES = (
    (r"qdd(\w+)", r"\\ddot{q}_{\1}"),
    (r"qd(\w+)", r"\\dot{q}_{\1}"),
    (r"q([A-Za-z]\w*)", r"q_{\1}"),
    (r"w([xyz])_(\w+)", r"\\omega_{\1,\2}"),
    (r"wd([xyz])_(\w+)", r"\\dot{\\omega}_{\1,\2}"),
    (r"vd([xyz])_(\w+)", r"\\dot{v}_{\1,\2}"),
    (r"([Ug])([xyz]+)_(\w+)", r"\1_{\2,\3}"),
    (r"J([pt])(\w+)_(\w+)", r"J^{\1}_{\2,\3}"),
    (r"J([A-Z][A-Za-z0-9]*)_([A-Za-z0-9]+)", r"J_{\1,\2}"),
    (r"S([A-Z][A-Za-z0-9]*)_([A-Za-z0-9]+)_([A-Za-z0-9]+)", r"S_{\1,\2,\3}"),
    (r"([Jgbe])([A-Z][A-Za-z0-9]*)", r"\1_{\2}"),
)
"""Names of speeds and of vectors, by frame."""


@dataclass(frozen=True)
class SheetStyle:
    """How a sheet is written.

    Attributes:
        style: of products, powers and numbers.
    """

    style: Style

    @property
    def latex(self) -> bool:
        """True for LaTeX."""
        return self.style.latex

    def name(self, name: str) -> str:
        """A letter: q, qd, qdd with dots, an underscore as a comma of the index."""
        if not self.latex:
            return name
        for pattern, latex in _LATEX_NAMES:
            if re.fullmatch(pattern, name):
                return re.sub(pattern, latex, name)
        split = re.fullmatch(r"([A-Za-z]+)(\d\w*)", name)
        if split:
            return f"{latex_name(split[1])}_{{{_index(split[2])}}}"
        return latex_name(name)

    def trig(self, name: str) -> str:
        """A sine or cosine, m and p of its angle as signs."""
        if self.latex:
            signs = re.sub(r"(?<=\d)p(?=\d)", "+", re.sub(r"(?<=\d)m(?=\d)", "-", name[1:]))
            return f"{name[0]}_{{{signs}}}"
        return name

    def call(self, function: str, argument: str) -> str:
        """A function of one argument."""
        if not self.latex:
            return f"{function}({argument})"
        known = function in ("sin", "cos", "tan", "exp", "tanh")
        head = f"\\{function}" if known else f"\\operatorname{{{function}}}"
        if function == "sqrt":
            return f"\\sqrt{{{argument}}}"
        return f"{head}({argument})"

    def bracket(self, text: str) -> str:
        """A sum as a factor."""
        return rf"\left({text}\right)" if self.latex else f"({text})"

    def quotient(self, above: str, below: str) -> str:
        """above / below."""
        if self.latex:
            return rf"\frac{{{above}}}{{{below}}}"
        return f"{_closed(above)}/{_closed(below)}"

    def power(self, base: str, exponent: int) -> str:
        """base ** exponent."""
        if exponent == 1:
            return base
        return f"{base}^{{{exponent}}}" if self.latex else f"{base}**{exponent}"


def _index(text: str) -> str:
    return text.replace("_", ",")


def _closed(text: str) -> str:
    return text if re.fullmatch(r"\w+(\([^()]*\))?", text) else f"({text})"


def _collected(terms: Iterable[Term]) -> dict[tuple[Factor, ...], Term]:
    """{factors in one order: term}, terms alike together."""
    found: dict[tuple[Factor, ...], Term] = {}
    for number, factors in terms:
        before, first = found.get(key := tuple(sorted(factors)), (Fraction(0), factors))
        found[key] = (before + number, first)
    return found


class SheetPrinter:
    """Writes the values of one sheet in one style."""

    def __init__(self, sheet: Sheet, style: Style = TEXT) -> None:
        self.sheet = sheet
        self.style = SheetStyle(style)

    def name(self, definition: Definition) -> str:
        """The left side."""
        return self.style.name(definition.name)

    def value(self, definition: Definition) -> str:
        """The right side."""
        node = abs(definition.ref)
        own = self.sheet.names.get(node)
        if own is not None and own[0] != definition.name:  # the same as another quantity
            return self.sum(definition.ref)
        return self.sum(definition.ref, opened=node)

    def sum(self, ref: int, opened: int = 0) -> str:
        """The value; the node `opened` is written out even if it has a name."""
        terms = _collected(self._cancelled(self._terms(ref, Fraction(1), opened)))
        kept = [(number, self._product(factors)) for number, factors in terms.values() if number]
        kept.sort(key=lambda term: (term[0] < 0, not term[1]))
        return signed_sum(kept, self.style.style)

    def _cancelled(self, terms: list[Term]) -> list[Term]:
        """Brackets are opened where what is in them cancels: a (x + y) - a (x - y) is 2 a y."""
        opened = [self._opened(term) for term in terms]
        total = _collected(term for each in opened for term in each)
        gone = {key for key, (number, _) in total.items() if not number}
        return [
            term
            for whole, each in zip(terms, opened, strict=True)
            for term in (each if gone & {*_collected(each)} else [whole])
        ]

    def _opened(self, term: Term) -> list[Term]:
        """The term multiplied out if it has one bracket."""
        number, factors = term
        brackets = [factor for factor in factors if factor[2]]
        if len(brackets) != 1:
            return [term]
        rest = [factor for factor in factors if not factor[2]]
        inside = self._terms(brackets[0][2], number, brackets[0][2])
        return [(value, (*rest, *more)) for value, more in inside]

    def _terms(self, ref: int, factor: Fraction, opened: int) -> list[Term]:
        node, number = abs(ref), factor if ref > 0 else -factor
        found = self.sheet.graph.nodes[node]
        if node == 0:
            return []
        if node in self.sheet.names and node != opened:
            name, sign = self.sheet.names[node]
            return [(number * sign, ((_NAMED, self.style.name(name), 0),))]
        if found.op == "add":
            return [term for arg in found.args for term in self._terms(arg, number, opened)]
        value, factors = self._factors(node, opened)
        return [(number * value, tuple(factors))]

    def _factors(self, node: int, opened: int) -> tuple[Fraction, list[Factor]]:
        """(number, factors) of a value that is no sum."""
        found = self.sheet.graph.nodes[node]
        if node in self.sheet.names and node != opened:
            name, sign = self.sheet.names[node]
            return Fraction(sign), [(_NAMED, self.style.name(name), 0)]
        if found.op == "num":
            return found.args[0], []
        if found.op == "mul":
            parts = [self._factors(abs(arg), opened) for arg in found.args]
            sign = 1 if (found.args[0] > 0) == (found.args[1] > 0) else -1
            return sign * parts[0][0] * parts[1][0], parts[0][1] + parts[1][1]
        if found.op == "div":
            return self._quotient(found.args[0], found.args[1])
        if found.op == "add":
            return Fraction(1), [(_BRACKET, self.style.bracket(self.sum(node, opened)), node)]
        rank = _LETTER if found.static else _TRIG if node in self.sheet.trig else _NAMED
        return Fraction(1), [(rank, self._atom(node), 0)]

    def _quotient(self, above: int, below: int) -> tuple[Fraction, list[Factor]]:
        """A fraction with the number in front of its numerator taken out."""
        number = Fraction(1 if above > 0 else -1)
        is_sum = self.sheet.graph.nodes[abs(above)].op == "add" and (
            abs(above) not in self.sheet.names
        )
        if is_sum:
            text = self.sum(abs(above))
        else:
            value, factors = self._factors(abs(above), 0)
            number, text = number * value, self._product(factors) or "1"
        return number, [(_NAMED, self.style.quotient(text, self.sum(below)), 0)]

    def _atom(self, node: int) -> str:
        found = self.sheet.graph.nodes[node]
        if found.op == "sym":
            return self.style.name(self.sheet.letters.get(found.args[0], found.args[0]))
        if node in self.sheet.trig:
            return self.style.trig(self.sheet.trig[node])
        if found.op == "pi":
            return r"\pi" if self.style.latex else "pi"
        if found.op == "pow":
            base, exponent = (self.sum(arg) for arg in found.args)
            if self.style.latex:
                return f"{self.style.bracket(base)}^{{{exponent}}}"
            return f"({base})**({exponent})"
        return self.style.call(found.op, self.sum(found.args[0]))

    def _product(self, factors: Sequence[Factor]) -> str:
        order = sorted(Counter(factors).items(), key=lambda item: item[0][0])
        return self.style.style.times.join(self.style.power(at[1], n) for at, n in order)
