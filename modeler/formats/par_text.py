"""The statements of a `.par` file: `KEY = {entry, entry}` and `KEY = number`, with their lines."""

import ast
import codecs
import functools
import keyword
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from modeler.core.expression import FUNCTIONS, ExpressionError, format_tree, parse_expression
from modeler.core.toml_cells import TomlCell, join_names, quote_value, suggest_name

SCALARS = ("NF", "NL", "NJ", "Type", "is_mobile", "is_floating")
FRAMES = ("Ant", "Sigma", "b", "d", "r", "gamma", "alpha", "Mu", "theta")
"""Lists of one entry for each frame."""
INERTIA = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
FRICTION = ("IA", "FV", "FS")
FORCES = ("FX", "FY", "FZ", "CX", "CY", "CZ")
BODIES = (*INERTIA, *FRICTION, *FORCES)
"""Lists of one entry for each link."""
JOINTS = ("QP", "QDP", "GAM", "eta", "k")
BASE = ("W0", "WP0", "V0", "VP0", "Z", "G")
KEYS = (*SCALARS, *FRAMES, *BODIES, *JOINTS, *BASE)

_KEY = {key.lower(): key for key in KEYS}
_COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
_NAME = re.compile(r"Robotname\s*=\s*'([^'\n]*)'", re.IGNORECASE)
_HEAD = re.compile(r"[\s;]*([^\W\d]\w*)[ \t]*=\s*")
_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


@dataclass(frozen=True)
class Statement:
    """One statement of a .par file.

    Attributes:
        key: as `KEYS` spells it.
        entries: of the list, or the one value.
        place: file and line.
    """

    key: str
    entries: tuple[str, ...]
    place: TomlCell

    def locate_entry(self, number: int) -> TomlCell:
        """Returns where entry `number`, counted from 1, stands."""
        return self.place.enter(f"{self.key}, entry {number}")


@dataclass(frozen=True)
class Statements:
    """All statements of a .par file, by key.

    Attributes:
        name: of the robot, as a comment of the file gives it; "" without one.
        by_key: the statements.
        place: the file.
    """

    name: str
    by_key: dict[str, Statement]
    place: TomlCell

    def get_entries(self, key: str) -> tuple[str, ...]:
        """Returns the list of that key; empty if the file has none."""
        statement = self.by_key.get(key)
        return statement.entries if statement else ()

    def read_scalar(self, key: str, pattern: str, expected: str) -> str:
        """Returns the one value of that key in small letters; empty if the file has none.

        Raises:
            RobotError: it does not match the pattern.
        """
        statement = self.by_key.get(key)
        if statement is None:
            return ""
        text = statement.entries[0]
        if not re.fullmatch(pattern, text.lower()):
            raise statement.place.make_error(f'{key}: got "{text}"; expected {expected}')
        return text.lower()

    def read_formula(self, key: str, k: int, default: str) -> "ParFormula":
        """Reads entry k, counted from 0, of the list of that key; the default without a list.

        Raises:
            RobotError: it is no formula.
        """
        statement = self.by_key.get(key)
        if statement is None:
            return parse_formula(default, self.place)
        return parse_formula(statement.entries[k], statement.locate_entry(k + 1))


def scan_statements(data: bytes, where: str) -> Statements:
    """Returns the statements of a file.

    Keys may be written in capitals or not, and in any order; line ends and encoding are found.

    Raises:
        RobotError: it is no such file; an unknown key, a key twice, a list that is not closed.
    """
    place = TomlCell(where)
    text = _decode_text(data, place)
    named = _NAME.search(text)
    bare = _COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
    opened = bare.find("(*")
    if opened >= 0:
        here = _locate_line(place, bare, opened)
        raise here.make_error('the comment "(*" is not closed; end it with "*)"')
    by_key: dict[str, Statement] = {}
    at = 0
    while re.search(r"[^\s;]", bare[at:]):
        statement, at = _read_statement(bare, at, place)
        if statement.key in by_key:
            raise statement.place.make_error(
                f"{statement.key} stands twice, first on {by_key[statement.key].place.location}; "
                "remove one"
            )
        by_key[statement.key] = statement
    if "Ant" not in by_key:
        raise place.make_error(
            "is no SYMORO file: the list Ant is missing; expected Ant = {0,1,...}, the antecedent "
            "of every frame, beside Sigma, d, r, alpha, theta"
        )
    return Statements(named[1].strip() if named else "", by_key, place)


def _decode_text(data: bytes, place: TomlCell) -> str:
    """The text; comments of old files are in the encoding of Windows."""
    if data.startswith(_UTF16):
        text = data.decode("utf-16", errors="replace")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("cp1252", errors="replace")
    if "\0" in text:
        expected = "expected a SYMORO file, such as KEY = {0,1,2} line by line"
        raise place.make_error(f"is no text; {expected}")
    return text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\x1a")  # end of file in DOS


def _locate_line(place: TomlCell, text: str, at: int) -> TomlCell:
    return place.enter(f"line {text.count(chr(10), 0, at) + 1}")


def _read_statement(text: str, at: int, place: TomlCell) -> tuple[Statement, int]:
    """The statement that starts at or after `at`, and where it ends."""
    head = _HEAD.match(text, at)
    start = at + len(text[at:]) - len(re.sub(r"^[\s;]*", "", text[at:]))
    here = _locate_line(place, text, start)
    if head is None:
        got = text[start:].splitlines()[0].strip()
        raise here.make_error(f"got {quote_value(got)}; expected KEY = {{...}} or KEY = number")
    key = _KEY.get(head[1].lower())
    if key is None:
        raise here.make_error(
            f"unknown keyword {quote_value(head[1])}{suggest_name(head[1], KEYS)}; expected one of "
            f"{join_names(KEYS)}"
        )
    here = place.enter(here.location)
    if text[head.end() : head.end() + 1] != "{":
        value = re.compile(r"[^\n;]*").match(text, head.end())
        assert value is not None
        if key not in SCALARS:
            got = quote_value(value[0].strip())
            raise here.make_error(f"{key}: got {got}; expected a list in braces")
        return Statement(key, (value[0].strip(),), here), value.end()
    end = text.find("}", head.end())
    inner = text[head.end() + 1 : end]
    if end < 0 or "=" in inner or "{" in inner:
        raise here.make_error(f"{key}: the list is not closed; end it with }}")
    if key in SCALARS:
        raise here.make_error(f"{key}: got a list; expected one number, as in {key} = 6")
    return Statement(key, _parse_entries(inner, key, here), here), end + 1


def _parse_entries(inner: str, key: str, place: TomlCell) -> tuple[str, ...]:
    """The entries between commas that stand in no parentheses."""
    entries, depth = [""], 0
    for letter in inner:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            entries.append("")
        else:
            entries[-1] += letter
    entries = [" ".join(entry.split()) for entry in entries]
    if entries == [""]:
        return ()
    for number, entry in enumerate(entries, start=1):
        if not entry:
            what = "is empty; expected a number, a letter or an expression"
            raise place.enter(f"{key}, entry {number}").make_error(what)
    return tuple(entries)


# Entries of a `.par` file as formulas: read in its spelling, written in that of robot files.


INVERSE: dict[str, Callable[..., float]] = {
    name: getattr(math, name) for name in ("atan2", "atan", "acos", "asin")
}
"""Functions of `.par` files that robot files do not have."""

_FUNCTION = {name: name for name in (*FUNCTIONS, *INVERSE)}
_FUNCTION |= {f"arc{name[1:]}": name for name in INVERSE}
_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:(?:[eE]|\*\^)[+-]?\d+)?"
_TOKEN = re.compile(rf"({_NUMBER})|([^\W\d]\w*)(\s*[(\[])?|(\*\*|\^|[-+*/()\[\],])|(\s+)|(.)")
_PLAIN = re.compile(rf"[+-]?\s*{_NUMBER}")


@dataclass(frozen=True)
class ParFormula:
    """A checked formula of a .par file.

    Attributes:
        tree: of Python's arithmetic; functions are those of robot files and `INVERSE`.
        written: the entry as the file has it.
    """

    tree: ast.expr
    source_text: str

    @property
    def names(self) -> frozenset[str]:
        """Returns the letters in it; pi and functions are none."""
        called = {id(n.func) for n in ast.walk(self.tree) if isinstance(n, ast.Call)}
        names = (n for n in ast.walk(self.tree) if isinstance(n, ast.Name) and id(n) not in called)
        return frozenset(name.id for name in names if name.id != "pi")

    @property
    def literal(self) -> str | None:
        """Returns the number as its digits are written, if it is nothing but a number."""
        if not _PLAIN.fullmatch(self.source_text):
            return None
        return self.source_text.replace(" ", "").replace("*^", "e")

    @property
    def is_zero(self) -> bool:
        """Returns True of 0 in any spelling."""
        return self.literal is not None and float(self.literal) == 0

    @property
    def text(self) -> str:
        """Writes the formula as robot files spell it."""
        return format_tree(self.tree)

    def replace_tree(self, tree: ast.expr) -> "ParFormula":
        """Returns another formula in its place."""
        return ParFormula(tree, format_tree(tree))


def parse_formula(entry: str, place: TomlCell) -> ParFormula:
    """Returns the formula of an entry: `-Pi/2`, `Sqrt[b^2 + d6^2]`, `0.45`.

    Raises:
        RobotError: it is none.
    """
    try:
        tree = parse_python(_translate_spelling(entry))
        parse_expression(ast.unparse(_replace_inverse_calls(tree)))
    except (SyntaxError, ValueError, RecursionError, MemoryError, ExpressionError):
        raise place.make_error(
            f"got {quote_value(entry)}; expected a number, a letter, or arithmetic of these with "
            f"{', '.join(sorted({*FUNCTIONS, *INVERSE}))}"
        ) from None
    return ParFormula(tree, entry)


def rewrite_tree(tree: ast.expr, replace: Callable[[ast.expr], ast.expr]) -> ast.expr:
    """Returns a copy of the formula with its names and calls replaced, innermost first."""

    class Rewrite(ast.NodeTransformer):
        def visit_Name(self, node: ast.Name) -> ast.expr:
            return replace(node)

        def visit_Call(self, node: ast.Call) -> ast.expr:
            self.generic_visit(node)
            return replace(node)

    result: ast.expr = Rewrite().visit(parse_python(ast.unparse(tree)))
    return result


def parse_python(text: str) -> ast.expr:
    """Returns the tree of a formula in Python's spelling."""
    return ast.parse(text, mode="eval").body


def get_called_name(node: ast.expr) -> str:
    """Returns name of the function that is called; empty if none is."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return node.func.id
    return ""


def rename_letters(tree: ast.expr, names: Mapping[str, str]) -> ast.expr:
    """Returns the formula with other names."""
    return rewrite_tree(
        tree,
        lambda n: ast.Name(names.get(n.id, n.id), ast.Load()) if isinstance(n, ast.Name) else n,
    )


def _translate_spelling(entry: str) -> str:
    """The entry in Python's spelling."""
    parts = []
    for number, name, opened, operator, space, other in _TOKEN.findall(entry):
        if other:
            raise ValueError(other)
        if number:
            parts.append(number.replace("*^", "e"))
        elif name:
            is_pi = name.lower() == "pi"
            known = _FUNCTION.get(name.lower()) if opened else None
            letter = f"{name}_" if keyword.iskeyword(name) else name
            parts.append(("pi" if is_pi else known or letter) + ("(" if opened else ""))
        else:
            parts.append({"^": "**", "[": "(", "]": ")"}.get(operator, operator) or space)
    return _translate_arctan("".join(parts).strip())


def _translate_arctan(text: str) -> str:
    """Mathematica's ArcTan[x, y] is atan2(y, x)."""

    def swap_arguments(node: ast.expr) -> ast.expr:
        if isinstance(node, ast.Call) and get_called_name(node) == "atan" and len(node.args) == 2:
            return ast.Call(ast.Name("atan2", ast.Load()), node.args[::-1], [])
        return node

    if "atan(" not in text:
        return text
    return ast.unparse(rewrite_tree(parse_python(text), swap_arguments))


def _replace_inverse_calls(tree: ast.expr) -> ast.expr:
    """The formula with functions that robot files have: to be checked by their grammar."""

    def replace_inverse_call(node: ast.expr) -> ast.expr:
        name = get_called_name(node)
        if not isinstance(node, ast.Call) or name not in INVERSE or node.keywords:
            return node
        if len(node.args) != (2 if name == "atan2" else 1):
            raise ValueError(name)
        return functools.reduce(lambda one, other: ast.BinOp(one, ast.Add(), other), node.args)

    return rewrite_tree(tree, replace_inverse_call)
