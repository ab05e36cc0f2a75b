"""Words around printed formulas: as they are, as comments of LaTeX, or as a whole document."""

import re

from modeler.cli.console import say
from modeler.cli.parsers.derive import Form
from modeler.core.latex import latex_text

_BEGIN = r"""\documentclass{article}
\usepackage{amsmath}
\setlength{\parindent}{0pt}
\begin{document}
\raggedright"""
_END = r"\end{document}"


class Words:
    """Prints what is said and the formulas between, so that LaTeX takes all of it.

    A fragment has its words as comments, a document as text. In both, displays may go on over the
    end of a page.
    """

    def __init__(self, form: Form, document: bool = False) -> None:
        """Begins to print.

        Args:
            form: of the formulas.
            document: with LaTeX: a whole document instead of a fragment.
        """
        self.form, self.document = form, document
        self._paragraph = False
        if document:
            say(_BEGIN)
        if form == "latex":
            say(r"\begingroup\allowdisplaybreaks")

    def title(self, text: str) -> None:
        """What all of it is about."""
        say(rf"\section*{{{latex_text(text)}}}") if self.document else self.say(text)

    def heading(self, text: str) -> str:
        """The title of a group of formulas in LaTeX."""
        return rf"\paragraph{{{_breakable(text)}}}" if self.document else f"% {text}"

    def say(self, text: str = "") -> None:
        """Lines that are no formulas; in a document one paragraph."""
        if self.document:
            self._say_paragraph(text)
        elif self.form == "latex":
            for line in text.splitlines() or [""]:
                say(f"% {line}".rstrip())
        else:
            say(text)

    def _say_paragraph(self, text: str) -> None:
        if text:
            say(("\n" if self._paragraph else "") + _breakable(" ".join(text.split())))
        self._paragraph = self._paragraph or bool(text)

    def formulas(self, text: str) -> None:
        """What is already written in the form."""
        self._paragraph = False
        say(text.rstrip("\n") if self.form == "latex" else text)

    def end(self) -> None:
        """Nothing more follows."""
        if self.form == "latex":
            say(r"\endgroup")
        if self.document:
            say(_END)


def _breakable(text: str) -> str:
    """Formulas in words have no spaces; a line may end behind their signs."""
    return re.sub(r"(\*+|\\_|/)", r"\1\\allowbreak{}", latex_text(text))
