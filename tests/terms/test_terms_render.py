"""What people, machines and TeX read says the same as the formulas."""

import re
import shutil
import subprocess
from math import cos, sin
from pathlib import Path

import numpy as np
import pytest

from modeler.api import load
from modeler.cli import main
from modeler.derivation.relations import format_base_parameters
from modeler.formulas import coefficients
from modeler.formulas.function_sheet import SheetPrinter, format_sheet
from modeler.formulas.regressor_form import derive_regressor_form, derive_short_form
from modeler.formulas.ring import LATEX, format_latex_symbol
from tests.base.formulas import text_value, written_value
from tests.effects.test_effects_in_c import REFERENCE, SHAPES, written
from tests.rotation import with_cases
from tests.terms.cases import closed_of, model_of, table_of
from tests.terms.closed_form_values import evaluate
from tests.terms.printed_lines import derived, known, run_lines


def numbers_of(name: str) -> tuple[dict[str, float], list[float], dict[str, float]]:
    """(all names that a printed formula may use, q, parameters)."""
    model = model_of(name)
    q = [0.4, -0.7, 1.3][: model.geometry.joint_count]
    values = dict(model.geometry.values)
    for joint, angle in zip(model.robot.moving_joints, q, strict=True):
        label = joint.name
        values |= {f"s{label}": sin(angle), f"c{label}": cos(angle), f"q{label}": angle}
    chi = {column: 0.1 * (i % 7) - 0.25 for i, column in enumerate(model.names)}
    return {**values, **chi}, q, chi


def printed_functions(text: str) -> dict[str, str]:
    blocks = text.split("\n\n")[1:]
    parts = [b.split(" =\n") for b in blocks]
    return {b[0].strip(): " ".join(b[1].split()) for b in parts if len(b) > 1}


def expected(name: str) -> dict[str, float]:
    """{function: value}, gravity with its letter taken out."""
    closed, (_, q, chi) = closed_of(name), numbers_of(name)
    at = evaluate(closed, q, chi)
    factor = closed.algebra.geometry.values.get(closed.gravity_factor, 1.0)
    values = {("gravity", (i,)): value / factor for i, value in at.gravity.items()}
    values |= {("inertia", place): value for place, value in at.inertia.items()}
    values |= {("christoffel", place): value for place, value in at.christoffel.items()}
    return {f.name: values[f.kind, f.joints] for f in closed.functions}


def test_a_closed_form_can_be_read_back_from_text_and_latex():
    closed, message, names = closed_of("odd"), expected("odd"), numbers_of("odd")[0]
    printed = printed_functions(coefficients.format_closed_form(closed))
    for function, text in list(printed.items())[::8]:
        assert text_value(text, names) == pytest.approx(message[function], rel=1e-9)
    letters = {format_latex_symbol(key): value for key, value in names.items()}
    blocks = coefficients.format_closed_form(closed, "latex").split("\\begin{align*}\n")[1:]
    assert len(blocks) >= len(closed.functions) == len(message)
    for block, function in list(zip(blocks, message, strict=False))[::4]:
        _, right = block.split("\n\\end{align*}")[0].split(" ={}& ")
        result = written_value(right.replace(" \\\\\n& ", " "), letters)
        assert result == pytest.approx(message[function], rel=1e-9, abs=1e-12)


def test_tables_of_the_wrist():
    closed, table = closed_of("wrist"), table_of("wrist")
    page = coefficients.format_closed_form(closed, "markdown")
    assert page.count("\n| `") == closed.monomial_count == 101
    assert "| `s2**2*s3**2` | `-XX3 + YY3` |" in page
    assert "+ g*g_i" in coefficients.format_closed_form(
        closed
    ) and "+ g_i" in coefficients.format_closed_form(closed_of("odd"))
    assert coefficients.format_determinant(table) == "-16"
    lines = coefficients.format_coefficients(table).splitlines()
    assert len(lines) == 102 and lines[0].split()[:3] == ["name", "in", "monomial"]
    assert re.search(r"^PS3 +S112 +c2\*s2 +2\*PJ1 \+ 2\*PJ3 ", "\n".join(lines), re.M)
    page = coefficients.format_coefficients(table, "markdown")
    assert page.count("\n") == 103 and page.count("| independent |") == 17
    latex = coefficients.format_coefficients(table, "latex")
    assert latex.count(" ={}& ") == latex.count(r"\text{ in }") == 101
    assert r"\mathit{PS}_{3} ={}& 2\,\mathit{PJ}_{1} + 2\,\mathit{PJ}_{3} \quad" in latex


FRAGMENT = "\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\n%s\\end{document}\n"
ALL_FORMS = ("--closed-form", "--regressor", "--terms")


def text_with_every_effect() -> str:
    """The demonstration arm with all that a robot file may put on a joint, and awkward names."""
    entries = []
    for effect, form in written():
        if form == 0:
            shapes = "".join(
                f", {s.name} = {SHAPES[s.name]}" for s in effect.forms[0].free_parameters
            )
            entries.append(f'{effect.id} = [{{joint = "2"{shapes}}}]')
    text = load("demo-arm").text
    text = text[: text.index("[effects]")].replace("D2", "upper_arm_2").replace("D3", "Omega3")
    text = text.replace("Demonstration arm, 3R:", "100 % R&D_3 \u2013 #1 \u03b1 {~^}:")
    return text + "\n".join(["[effects]", *entries]) + REFERENCE


@pytest.fixture(scope="module")
def every(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("robot") / "every.toml"
    path.write_text(text_with_every_effect())
    return path


def typeset(text: str, folder: Path) -> str:
    """The log of pdfTeX."""
    if shutil.which("pdflatex") is None:
        pytest.skip("NOT CHECKED: no pdflatex (Debian: apt install texlive-latex-base)")
    (folder / "page.tex").write_text(text)
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "page.tex"]
    done = subprocess.run(command, cwd=folder, capture_output=True, timeout=120)
    log = (folder / "page.log").read_text(errors="replace")
    assert done.returncode == 0, log[-3000:]
    return log


def check_log(log: str) -> None:
    wide = [float(points) for points in re.findall(r"Overfull \\hbox \((.*?)pt too wide", log)]
    assert max(wide, default=0.0) <= 1.0
    for complaint in ("Missing character", "\n!", "Undefined", "Overfull \\vbox"):
        assert complaint not in log


@with_cases(
    "words",
    ("wrist", "--closed-form", "--terms", "--expanded", "--kane", "--energy", "--document"),
    pytest.param(("orthoglide-2003", "--closed-form", "--regressor"), marks=pytest.mark.rotating),
    pytest.param(("stewart", "--document"), marks=pytest.mark.slow),
    ("every", *ALL_FORMS, "--document"),
    ids="".join,
)
def test_what_derive_prints_compiles(capsys, tmp_path, every, words) -> None:
    robot = str(every) if words[0] == "every" else words[0]
    assert main(["derive", robot, *words[1:], "--format", "latex"]) == 0
    printed = capsys.readouterr().out
    check_log(typeset(printed if "--document" in words else FRAGMENT % printed, tmp_path))


def test_what_physical_prints_compiles(capsys, tmp_path) -> None:
    known = "am,bm,bl1,bt2,ct1,bJ33,cJ33,cm"
    assert main(["physical", "wrist", "--known", known, "--format", "latex"]) == 0
    check_log(typeset(FRAGMENT % capsys.readouterr().out, tmp_path))


def test_a_line_too_wide_would_be_seen(tmp_path) -> None:
    """The relations of the Orthoglide without breaks are wider than the page."""
    page = format_base_parameters(derived("orthoglide-2003").base, "latex").replace(
        " \\notag \\\\\n&\\quad {}", " "
    )
    with pytest.raises(AssertionError):
        check_log(typeset(FRAGMENT % page, tmp_path))


def equations(page: str) -> list[tuple[str, str]]:
    """Left and right sides, continued lines joined."""
    blocks = re.findall(r"\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", page, re.DOTALL)
    lines = [line for block in blocks for line in block.replace(" \\\\\n& ", " ").split(" \\\\\n")]
    return [tuple(line.split(" ={}& ")) for line in lines]


@pytest.mark.parametrize(
    "name", ["every", pytest.param("orthoglide-2003", marks=pytest.mark.rotating)]
)
@pytest.mark.parametrize("form", [derive_short_form, derive_regressor_form])
def test_latex_has_the_values_of_the_text(every, name, form) -> None:
    """Both are evaluated line after line; names of LaTeX stay apart."""
    derivation = derived(every if name == "every" else name)
    free, rng = len(derivation.model.robot.free_joints), np.random.default_rng(5)
    numbers = rng.uniform(0.2, 1.4, (3, free))
    start = known(derivation, *numbers, rng.uniform(0.2, 1.4, derivation.base.rank))
    sheet = form(derivation.model, derivation.base).sheet
    start |= {f"{signal}{j}": 0.5 for signal in "tTz" for j in "1234"}
    text = run_lines(format_sheet(sheet).splitlines(), start | {"exp": np.exp, "tanh": np.tanh})
    latex = {SheetPrinter(sheet, LATEX).format_letter(key): value for key, value in start.items()}
    assert len(latex) == len(start)
    sides = equations(format_sheet(sheet, "latex"))
    assert len({left for left, _ in sides}) == len(sides)
    for left, right in sides:
        latex[left] = float(written_value(right, latex))
    values = [latex[left] for left, _ in sides][-len(sheet.definitions) :]
    expected = [text[definition.name] for definition in sheet.definitions]
    np.testing.assert_allclose(values, expected, rtol=1e-9, atol=1e-12)


def test_a_document_is_latex(capsys) -> None:
    assert main(["derive", "two-link", "--document"]) == 1
    assert "add --format latex" in capsys.readouterr().err
