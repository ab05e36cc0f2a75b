"""LaTeX as the commands print it: TeX takes it, lines fit, and it says what the text says."""

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from modeler.api import load
from modeler.cli import main
from modeler.derivation.relations import as_latex
from modeler.formulas.function_sheet import SheetPrinter, sheet_latex, sheet_lines
from modeler.formulas.regressor_form import regressor_form, short_form
from modeler.formulas.text import LATEX
from tests.base.formulas import written_value
from tests.effects.test_effects_in_c import REFERENCE, SHAPES, written
from tests.terms.printed_lines import derived, known, run_lines

FRAGMENT = "\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\n%s\\end{document}\n"
ALL_FORMS = ("--closed-form", "--regressor", "--terms")


def text_with_every_effect() -> str:
    """The demonstration arm with all that a robot file may put on a joint, and awkward names."""
    entries = []
    for effect, form in written():
        if form == 0:
            shapes = "".join(f", {s.name} = {SHAPES[s.name]}" for s in effect.forms[0].free)
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


@pytest.mark.parametrize(
    "words",
    [
        ("wrist", "--closed-form", "--terms", "--expanded", "--kane", "--energy", "--document"),
        ("orthoglide-2003", "--closed-form", "--regressor"),
        pytest.param(("stewart", "--document"), marks=pytest.mark.slow),
        ("every", *ALL_FORMS, "--document"),
    ],
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
    page = as_latex(derived("orthoglide-2003").base).replace(" \\notag \\\\\n&\\quad {}", " ")
    with pytest.raises(AssertionError):
        check_log(typeset(FRAGMENT % page, tmp_path))


def equations(page: str) -> list[tuple[str, str]]:
    """Left and right sides, continued lines joined."""
    blocks = re.findall(r"\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", page, re.DOTALL)
    lines = [line for block in blocks for line in block.replace(" \\\\\n& ", " ").split(" \\\\\n")]
    return [tuple(line.split(" ={}& ")) for line in lines]


@pytest.mark.parametrize("name", ["orthoglide-2003", "every"])
@pytest.mark.parametrize("form", [short_form, regressor_form])
def test_latex_has_the_values_of_the_text(every, name, form) -> None:
    """Both are evaluated line after line; names of LaTeX stay apart."""
    derivation = derived(every if name == "every" else name)
    free, rng = len(derivation.model.robot.free), np.random.default_rng(5)
    numbers = rng.uniform(0.2, 1.4, (3, free))
    start = known(derivation, *numbers, rng.uniform(0.2, 1.4, derivation.base.rank))
    sheet = form(derivation.model, derivation.base).sheet
    start |= {f"{signal}{j}": 0.5 for signal in "tTz" for j in "123"}
    text = run_lines(sheet_lines(sheet), start | {"exp": np.exp, "tanh": np.tanh})
    latex = {SheetPrinter(sheet, LATEX).letter(key): value for key, value in start.items()}
    assert len(latex) == len(start)
    sides = equations(sheet_latex(sheet))
    assert len({left for left, _ in sides}) == len(sides)
    for left, right in sides:
        latex[left] = float(written_value(right, latex))
    values = [latex[left] for left, _ in sides][-len(sheet.definitions) :]
    expected = [text[definition.name] for definition in sheet.definitions]
    np.testing.assert_allclose(values, expected, rtol=1e-9, atol=1e-12)


def test_a_document_is_latex(capsys) -> None:
    assert main(["derive", "two-link", "--document"]) == 1
    assert "add --format latex" in capsys.readouterr().err
