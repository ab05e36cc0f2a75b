"""Formulas as plain text and as LaTeX, which a notebook typesets."""

from dataclasses import dataclass

from modeler.core.brief import Brief


@dataclass(frozen=True)
class Formulas(Brief):
    """Formulas of a robot.

    Attributes:
        title: what they are, plain text.
        text: one a line.
        latex: an environment of LaTeX, without dollars.
        markdown: for a page.
    """

    title: str
    text: str
    latex: str
    markdown: str

    def __str__(self) -> str:
        return self.text

    def _repr_latex_(self) -> str:
        lines = self.latex.splitlines()
        return "\n".join(_heading(line) if line.startswith("% ") else line for line in lines)


def _heading(comment: str) -> str:
    r"""A comment of LaTeX as words between the formulas: MathJax knows `\text`."""
    return rf"$\text{{{comment[2:]}}}$"
