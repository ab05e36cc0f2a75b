"""The printed forms of the base parameters taken apart: (name, right side) of every relation."""

import json
import re
from collections.abc import Callable, Sequence

import numpy as np
import sympy

from modeler.derivation import relations
from tests.base.formulas import Values, latex_value, name_of_latex, text_value

Read = Callable[[str, Values], np.ndarray]
Relations = list[tuple[str, str]]

_DIGITS = 40  # decimal digits of the exact coefficients' values


def of_text(page: str) -> Relations:
    """Lines `ZZ2R = ZZ2 + D4**2*M4` up to the blank one."""
    return [_sides(line) for line in page.split("\n\n")[0].splitlines()]


def of_markdown(page: str) -> Relations:
    """Rows `| ZZ2R | `ZZ2 + D4**2*M4` | kg m2 |`."""
    return re.findall(r"^\| (\w+) \| `(.*)` \| [^|]* \|$", page, re.M)


def of_latex(page: str) -> Relations:
    """Lines of the align environment."""
    body = page.removeprefix("\\begin{align}\n").removesuffix("\n\\end{align}")
    body = body.replace(" \\notag \\\\\n&\\quad {}", " ")
    pairs = [line.split(" &= ") for line in body.split(" \\\\\n")]
    return [(name_of_latex(name), right) for name, right in pairs]


def of_terms(bases: list[dict]) -> Relations:
    """Terms of `derive --json` or of a manifest as sums of (coefficient)*parameter."""
    return [
        (base["name"], " + ".join(f"({t['coefficient']})*{t['parameter']}" for t in base["terms"]))
        for base in bases
    ]


def of_header(page: str) -> Relations:
    """The comment about beta in the emitted header, continued lines joined."""
    block = page.split("/* beta: ")[1].split("*/")[0]
    joined = re.sub(r"\n \* {9,}", " ", block)
    matches = re.findall(r"^ \* +\d+  (.*?) +\[[^]]*\]$", joined, re.M)
    return [_sides(line) for line in matches]


def of_table(page: str) -> Relations:
    """The first two columns of the emitted base_parameters.md."""
    return [_sides(line) for line in re.findall(r"^\| \d+ \| `(.*?)` \|", page, re.M)]


def _sides(line: str) -> tuple[str, str]:
    name, _, right = line.partition(" = ")
    return name, right or name


def printed_forms(robot, base, emitted):
    """(form, relations as printed, reader) of every form in which they are printed."""
    files = emitted.files
    raw = json.loads(json.dumps(relations.serialise_base_parameters(robot, base)))
    yield "text", of_text(relations.format_base_parameters(base)), text_value
    yield "Markdown", of_markdown(relations.format_base_parameters(base, "markdown")), text_value
    yield "LaTeX", of_latex(relations.format_base_parameters(base, "latex")), latex_value
    yield "JSON", of_terms(raw["base"]), text_value
    yield "manifest", of_terms(json.loads(files["manifest.json"])["base"]), text_value
    yield "header", of_header(files[f"{emitted.spec.prefix}.h"]), text_value
    yield "base_parameters.md", of_table(files["base_parameters.md"]), text_value


class Exact:
    """Exact coefficients at random values of the symbols."""

    def __init__(self, parameters: Sequence[relations.BaseParameter], seed: int) -> None:
        self.random = np.random.default_rng(seed)
        terms = [term for parameter in parameters for term in parameter.terms]
        symbols = {s for term in terms for s in term.coefficient.free_symbols}
        self.values = {s.name: self.random.uniform(0.3, 1.4) for s in sorted(symbols, key=str)}
        at = {s: sympy.Float(float(self.values[s.name]), _DIGITS) for s in symbols}
        every = {term.coefficient for term in terms}
        self.coefficients = {c: float(c.xreplace(at).evalf(_DIGITS)) for c in every}

    def differences(self, parameter: relations.BaseParameter, printed: str, read: Read) -> float:
        """Largest difference of printed and exact coefficients, relative to 1e-2 at least.

        Each parameter has a random value in its own entry and is 0 elsewhere; in the last entry
        all are 0.
        """
        count = len(parameter.terms)
        size = self.random.uniform(0.3, 1.4, count)
        values = dict(self.values)
        for i, term in enumerate(parameter.terms):
            values[term.parameter] = size[i] * np.eye(count + 1)[i]
        exact = np.array([self.coefficients[term.coefficient] for term in parameter.terms] + [0.0])
        error = np.abs(read(printed, values) / np.append(size, 1.0) - exact)
        return float(np.max(error / np.maximum(np.abs(exact), 1e-2)))
