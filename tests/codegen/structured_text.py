"""A reader of Structured Text (IEC 61131-3): functions and function blocks become Python functions.

Written from the standard's grammar and not from the emitter: names are the same in small letters
and in capital ones, every name must be declared, comments nest no further, constants are never
written.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field

_TOKENS = re.compile(
    r"\s+|\(\*.*?\*\)|(?P<number>\d+\.\d+(?:[Ee][+-]?\d+)?|\d+)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<sign>:=|\.\.|<=|>=|<>|[-+*/()\[\]:;,<>=])",
    re.DOTALL,
)
_STANDARD: dict[str, Callable[..., float]] = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "exp": math.exp,
    "sqrt": math.sqrt,
    "abs": abs,
    "expt": math.pow,
    "trunc": math.trunc,
    "dint_to_lreal": float,
}
_KEYWORDS = set(
    """
    function function_block end_function end_function_block var var_input var_in_out var_temp
    end_var constant if then elsif else end_if array of lreal dint and or not mod xor true false at
    by case do exit for repeat return to type until while with
""".split()
)


class TextError(Exception):
    """The text is not of the standard."""


@dataclass
class Unit:
    """A function or function block.

    Attributes:
        name: as written.
        kinds: {name in small letters: "var_in_out", "constant", ...}.
        lengths: of arrays.
        initial: values given in declarations.
        lines: Python statements.
    """

    name: str
    kinds: dict[str, str] = field(default_factory=dict)
    lengths: dict[str, int] = field(default_factory=dict)
    initial: dict[str, float | list[float]] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)


class Program:
    """All units of a text, callable."""

    def __init__(self, text: str) -> None:
        self._tokens = _tokens(text)
        self._at = 0
        self.units: dict[str, Unit] = {}
        scope = {**_STANDARD, "place": _place}
        while self._at < len(self._tokens):
            unit = self._unit()
            self.units[unit.name.lower()] = unit
            exec("\n".join(unit.lines), scope)
        self._scope = scope

    def __call__(self, name: str, **arrays: list[float]) -> None:
        """Run a function block on its arrays, which it writes into."""
        self._scope[name.lower()](**{key.lower(): value for key, value in arrays.items()})

    def _next(self) -> str:
        return self._tokens[self._at].lower() if self._at < len(self._tokens) else ""

    def _take(self, *wanted: str) -> str:
        token = self._next()
        if wanted and token not in wanted:
            raise TextError(f"got {token!r}; expected {wanted}")
        self._at += 1
        return token

    def _name(self) -> str:
        token = self._take()
        if token in _KEYWORDS or not re.fullmatch(r"[a-z_]\w*", token):
            raise TextError(f"{token!r} is no name")
        if "__" in token or token.endswith("_"):
            raise TextError(f"{token}: underscores")
        return token

    def _unit(self) -> Unit:
        kind = self._take("function", "function_block")
        unit = Unit(self._name())
        if kind == "function":
            self._take(":")
            self._take("lreal")
            unit.kinds[unit.name] = "var"
        while self._next().startswith("var"):
            self._declarations(unit)
        names = [n for n, k in unit.kinds.items() if k in ("var_input", "var_in_out")]
        inputs = [f"{n}={unit.initial[n]!r}" if n in unit.initial else n for n in names]
        inputs.sort(key=lambda word: "=" in word)
        unit.lines.append(f"def {unit.name}({', '.join(inputs)}):")
        constants = [x for x in unit.initial.items() if unit.kinds[x[0]] == "constant"]
        unit.lines += [f"    {n} = {v!r}" for n, v in constants]
        self._statements(unit, "    ", f"end_{kind}")
        self._take(f"end_{kind}")
        if kind == "function":  # its name is its value; in Python that would be itself
            unit.lines = [
                line if line.startswith("def") else re.sub(rf"\b{unit.name} =", "found =", line)
                for line in unit.lines
            ] + ["    return found"]
        return unit

    def _declarations(self, unit: Unit) -> None:
        kind = self._take("var", "var_input", "var_in_out", "var_temp")
        if self._next() == "constant":
            kind = self._take()
        while self._next() != "end_var":
            name = self._name()
            if name in unit.kinds:
                raise TextError(f"{unit.name}: {name} is declared twice")
            unit.kinds[name] = kind
            self._take(":")
            if self._take("lreal", "dint", "array") == "array":
                for sign in "[0":
                    self._take(sign)
                self._take("..")
                unit.lengths[name] = int(self._take()) + 1
                for sign in ("]", "of", "lreal"):
                    self._take(sign)
            if self._next() == ":=":
                self._take()
                unit.initial[name] = self._numbers(unit.lengths.get(name))
            elif kind == "constant":
                raise TextError(f"{name}: a constant without value")
            self._take(";")
        self._take("end_var")

    def _numbers(self, length: int | None) -> float | list[float]:
        """The initial value of a number, or of an array of that length."""
        values, brackets = list[float](), length is not None and self._take("[")
        for k in range(length or 1):
            if k:
                self._take(",")
            sign = -1.0 if self._next() == "-" and self._take() else 1.0
            values.append(sign * float(self._take()))
        if brackets:
            self._take("]")
        return values if brackets else values[0]

    def _statements(self, unit: Unit, indent: str, *ends: str) -> None:
        while self._next() not in ends:
            if self._next() == "if":
                self._if(unit, indent)
            else:
                name = self._name()
                if unit.kinds.get(name) in (None, "constant", "var_input"):
                    raise TextError(f"{unit.name} writes {name}")
                place = name + self._index(unit, name)
                self._take(":=")
                unit.lines.append(f"{indent}{place} = {self._sum(unit)}")
            self._take(";")

    def _if(self, unit: Unit, indent: str) -> None:
        word = self._take("if")
        while word in ("if", "elsif"):
            left, sign, right = self._sum(unit), self._take("<", ">"), self._sum(unit)
            unit.lines.append(f"{indent}{'if' if word == 'if' else 'elif'} {left} {sign} {right}:")
            self._take("then")
            self._statements(unit, f"{indent}    ", "elsif", "else", "end_if")
            word = self._take()
        if word == "else":
            unit.lines.append(f"{indent}else:")
            self._statements(unit, f"{indent}    ", "end_if")
            self._take("end_if")

    def _index(self, unit: Unit, name: str) -> str:
        if name not in unit.lengths:
            return ""
        self._take("[")
        if unit.kinds[name] == "constant":  # a table, read at a place that is computed
            place = self._sum(unit)
            self._take("]")
            return f"[place({place}, {unit.lengths[name]})]"
        number = int(self._take())
        self._take("]")
        if not number < unit.lengths[name]:
            raise TextError(f"{name}[{number}]")
        return f"[{number}]"

    def _sum(self, unit: Unit) -> str:
        text = self._product(unit)
        while self._next() in ("+", "-"):
            text = f"({text} {self._take()} {self._product(unit)})"
        return text

    def _product(self, unit: Unit) -> str:
        text = self._factor(unit)
        while self._next() in ("*", "/"):
            text = f"({text} {self._take()} {self._factor(unit)})"
        return text

    def _factor(self, unit: Unit) -> str:
        if self._next() == "-":
            self._take()
            return f"(-{self._factor(unit)})"
        if self._next() == "(":
            self._take()
            text = self._sum(unit)
            self._take(")")
            return f"({text})"
        if self._next()[0].isdigit():
            return repr(float(self._take()))
        name = self._name()
        if self._next() == "(":
            self._take()
            known = [self._sum(unit)]
            while self._next() == ",":
                self._take()
                known.append(self._sum(unit))
            self._take(")")
            if name not in _STANDARD and name not in self.units:
                raise TextError(f"{unit.name} calls {name}")
            return f"{name}({', '.join(known)})"
        if name not in unit.kinds:
            raise TextError(f"{unit.name} reads {name}, which is not declared")
        return name + self._index(unit, name)


def _place(at: float, length: int) -> int:
    assert at == int(at) and 0 <= at < length
    return int(at)


def _tokens(text: str) -> list[str]:
    values, at = [], 0
    while at < len(text):
        match = _TOKENS.match(text, at)
        if match is None:
            raise TextError(f"at {text[at : at + 30]!r}")
        at = match.end()
        if match.lastgroup:
            values.append(match[0])
    return values
