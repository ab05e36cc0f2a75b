"""Broken formulas keep their value and fit, says a reader that shares nothing with the writer."""

import numpy as np
import pytest

from modeler.core.formula import (
    DisplayedEquation,
    break_lines,
    escape_latex,
    format_display,
    format_latex_name,
    measure_width,
)
from tests.base.formulas import written_value

LETTERS = {"a": 0.7, r"\mathit{MX}_{31c}": -1.3, r"\theta_{2}": 0.4, "D_{4}": 2.1, "s_{1-2}": 0.6}


def formula(rng: np.random.Generator, depth: int, factor: bool = False) -> tuple[str, float]:
    """A random formula with its value."""
    kind = rng.integers(6) if depth else 0
    if kind in (0, 1):
        names = rng.choice(list(LETTERS), 3)
        return r"\,".join(names), float(np.prod([LETTERS[name] for name in names]))
    if kind in (2, 3):
        signs = rng.choice([1, -1], 4)
        parts = [formula(rng, depth - 1, factor=True) for _ in signs]
        pieces = zip(signs, parts, strict=True)
        text = "".join(f" {'+' if sign > 0 else '-'} {part}" for sign, (part, _) in pieces)
        value = sum(sign * value for sign, (_, value) in zip(signs, parts, strict=True))
        text = text.removeprefix(" + ")
        return (rf"\left({text}\right)" if factor else text.strip()), float(value)
    inside, value = formula(rng, depth - 1)
    if kind == 4:
        below, other = formula(rng, depth - 1)
        return rf"\frac{{{inside}}}{{{below} + 50}}", value / (other + 50)
    square = rf"\left({inside}\right)^{{2}}"
    return rf"a\,{square}\,\sqrt{{{square} + 9}}", float(0.7 * value**2 * np.sqrt(value**2 + 9))


@pytest.mark.parametrize("room", [120.0, 345.0])
def test_lines_fit_and_mean_the_same(room: float) -> None:
    rng, opened = np.random.default_rng(7), 0
    for _ in range(150):
        text, value = formula(rng, 3)
        lines = break_lines(text, room)
        joined = " ".join(lines)
        assert all(measure_width(line) <= room for line in lines), text
        assert written_value(text, LETTERS) == pytest.approx(value, rel=1e-9, abs=1e-9)
        assert written_value(joined, LETTERS) == pytest.approx(value, rel=1e-9, abs=1e-9), joined
        opened += r"\bigl(" in joined
    assert opened > 20


def test_what_fits_and_what_cannot_be_opened_stay_whole() -> None:
    """A higher root, and the bars of a size; broken before and behind them."""
    text = r"\left( a + b \right) \text{ as in } \tfrac{1}{2}"
    assert break_lines(text) == [text]
    wide = " + ".join(["a"] * 12)
    text = rf"b + \sqrt[3]{{{wide}}} + \left|{wide}\right| - \frac{{1}}{{{wide}}}"
    head = ["b", rf"+ \sqrt[3]{{{wide}}}", rf"+ \left|{wide}\right|"]
    assert break_lines(text, 100.0)[:3] == head
    assert break_lines(text, 100.0)[3].startswith(r"- 1\,\bigl(a + a")


def test_numbers_stand_at_the_last_line() -> None:
    equation = DisplayedEquation("x", (" + ".join([r"\mathit{MX}_{31}"] * 20),))
    page = format_display([equation, DisplayedEquation("y", ("1",))], numbered=True)
    assert page.count(r"\notag") == page.count(r"&\quad {}+") == page.count("\\\\\n") - 1 > 0
    assert r"\notag" not in format_display([equation])


def test_names_and_texts() -> None:
    """No text has a sign that TeX reads."""
    for name, expected in (
        ("omega_1", r"\mathit{omega\_1}"),
        ("omega1", r"\omega_{1}"),
        ("Omega", r"\Omega"),
        ("Alpha", r"\mathit{Alpha}"),
        ("PHI2", r"\mathit{PHI}_{2}"),
        ("mu2_3", r"\mu_{2\_3}"),
    ):
        assert format_latex_name(name) == expected
    assert escape_latex("R&D_1 100 % {a} ~ \\ é") == (
        r"R\&D\_1 100 \% \{a\} \textasciitilde{} \textbackslash{} é"
    )
    assert escape_latex("ń \u03b1 \u2013") == "n [U+03B1] --"
