"""Readers of printed formulas: plain text by Python, LaTeX by recursive descent, to numbers.

They share nothing with the program that prints. Precedence is that of mathematics and C: `a/b*c`
is (a/b) c, `-a**2` is -(a**2); in LaTeX, factors beside each other are multiplied.
"""

import re
from collections.abc import Callable, Mapping

import numpy as np

Values = Mapping[str, np.ndarray]

_FUNCTIONS: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "sqrt": np.sqrt,
    "sign": np.sign,
    "abs": np.abs,
    "exp": np.exp,
    "tanh": np.tanh,
}
_GREEK = r"\\(?:alpha|beta|gamma|delta|theta|phi|psi|omega|epsilon|mu|Omega)(?![A-Za-z])"
_DOTTED = r"\\d?dot\{(?:\\omega|[a-z])\}"
_HEAD = rf"[A-Za-z]|\\mathit\{{(?:\w|\\_)+\}}|{_GREEK}|{_DOTTED}"
_NAME = rf"(?:{_HEAD})(?:\^\{{[pt]\}})?(?:_\{{(?:\w|\\_|[-+,])+\}})?"
_LATEX = re.compile(
    r"\\(?:left|bigl)\(|\\(?:right|bigr)\)|\\operatorname\{\w+\}|\\,|"
    rf"\\(?:t?frac|sqrt|sin|cos|tanh?|exp|pi|cdot)|\d+(?:\.\d*)?|{_NAME}|[-+^{{}}()/\[\]]"
)
_OPENING, _CLOSING = (r"\left(", r"\bigl(", "("), (r"\right)", r"\bigr)", ")")


class UnreadableError(Exception):
    """Not a formula."""


class _Latex:
    def __init__(self, text: str, values: Values) -> None:
        if rest := _LATEX.sub("", text).strip():
            raise UnreadableError(f"{text}: {rest}")
        self.text, self.words, self.values = text, _LATEX.findall(text), values

    def result(self) -> np.ndarray:
        value = self.sum()
        if self.words:
            raise UnreadableError(f"{self.text}: left over {self.words}")
        return value

    @property
    def next(self) -> str:
        return self.words[0] if self.words else ""

    def take(self, *expected: str) -> str:
        if not self.words or (expected and self.next not in expected):
            raise UnreadableError(f"{self.text}: {self.next!r}, expected {expected}")
        return self.words.pop(0)

    def sum(self) -> np.ndarray:
        sign = -1.0 if self.next == "-" else 1.0
        if self.next in ("-", "+"):
            self.take()
        value = sign * self.product()
        while self.next in ("+", "-"):
            value = value + self.product() if self.take() == "+" else value - self.product()
        return value

    def product(self) -> np.ndarray:
        value = self.power()
        while self.next not in ("", "+", "-", "}", "]", *_CLOSING):
            if self.next == "/":
                self.take()
                value = value / self.power()
                continue
            if self.next in (r"\cdot", r"\,"):
                self.take()
            value = value * self.power()
        return value

    def power(self) -> np.ndarray:
        word = self.next.removeprefix("\\")
        word = word.removeprefix("operatorname{").removesuffix("}")
        if word in _FUNCTIONS and word != "sqrt":
            self.take()
            exponent = self.exponent()
            argument = self.group() if self.next == "{" else self.atom()
            return _FUNCTIONS[word](argument) ** exponent
        return self.atom() ** self.exponent()

    def exponent(self) -> np.ndarray:
        if self.next != "^":
            return np.float64(1.0)
        self.take()
        return self.group()

    def group(self) -> np.ndarray:
        self.take("{")
        value = self.sum()
        self.take("}")
        return value

    def atom(self) -> np.ndarray:
        word = self.take()
        if word in _OPENING:
            value = self.sum()
            self.take(_CLOSING[_OPENING.index(word)])
            return value
        if word == "{":
            value = self.sum()
            self.take("}")
            return value
        if word in (r"\frac", r"\tfrac"):
            above = self.group()
            return above / self.group()
        if word == r"\sqrt":
            root = np.float64(2.0)
            if self.next == "[":
                self.take()
                root = self.sum()
                self.take("]")
            return self.group() ** (1 / root)
        if word[0].isdigit():
            return np.float64(word)
        name = self.name(word)
        if word != r"\pi" and name not in self.values:
            raise UnreadableError(f"{self.text}: no {name}")
        return np.float64(np.pi) if word == r"\pi" else self.values[name]

    def name(self, word: str) -> str:
        return name_of_latex(word)


class _Written(_Latex):
    def name(self, word: str) -> str:
        return word


def text_value(text: str, values: Values) -> np.ndarray:
    """Value of `XXP + RP**2*sin(phi1)**2*M31`."""
    try:
        return eval(text, {"__builtins__": {}}, {**_FUNCTIONS, "pi": np.pi, **values})
    except (SyntaxError, NameError, TypeError) as error:
        raise UnreadableError(text) from error


def latex_value(text: str, values: Values) -> np.ndarray:
    r"""Value of `\mathit{XX} + R^{2} \sin^{2}{\left(\phi_{1} \right)} M_{31}`."""
    return _Latex(text, values).result()


def written_value(text: str, values: Values) -> np.ndarray:
    r"""Value of `2\,\dot{q}_{1}\,\left(a + b\right)`; names as LaTeX writes them."""
    return _Written(text, values).result()


def name_of_latex(text: str) -> str:
    r"""`ZZ2R` of `\mathit{ZZ}_{2R}`, `phi1` of `\phi_{1}`, `a_b` of `\mathit{a\_b}`."""
    head, _, index = text.replace(r"\_", "\0").partition("_{")
    head = head.removeprefix(r"\mathit{").removesuffix("}").removeprefix("\\")
    return (head + index.removesuffix("}")).replace("\0", "_")
