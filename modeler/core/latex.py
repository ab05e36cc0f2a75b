"""Names as LaTeX, in relations and in closed forms alike, and text around them."""

import re
import unicodedata

_GREEK = re.compile(
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|iota|kappa|lambda|mu|nu|xi|rho|sigma|tau|upsilon"
    "|phi|chi|psi|omega|Gamma|Delta|Theta|Lambda|Xi|Sigma|Upsilon|Phi|Psi|Omega"
)
_SPECIAL = {
    "\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
    "<": r"\textless{}", ">": r"\textgreater{}", "|": r"\textbar{}", '"': "''",
    **{sign: f"\\{sign}" for sign in "#$%&_{}"},
    "\u2013": "--", "\u2014": "---", "\u2018": "`", "\u2019": "'", "\u201c": "``", "\u201d": "''",
    "\u00b1": r"$\pm$", "\u00b0": r"$^\circ$", "\u00b7": r"$\cdot$",
}  # fmt: skip


def latex_name(name: str) -> str:
    r"""`ZZ2R` as `\mathit{ZZ}_{2R}`, `D4` as `D_{4}`, `phi1` as `\phi_{1}`.

    An underscore is a letter of the name, so that different names stay different.
    """
    split = re.fullmatch(r"([A-Za-z]+)(\d\w*)?", name)
    head, index = (split[1], split[2]) if split else (name, None)
    if _GREEK.fullmatch(head):
        head = f"\\{head}"
    elif len(head) > 1:
        head = f"\\mathit{{{_escaped(head)}}}"
    return f"{head}_{{{_escaped(index)}}}" if index else head


def latex_text(text: str) -> str:
    r"""Text between formulas: `R&D_1` as `R\&D\_1`; a letter that pdfTeX lacks as its code."""
    return "".join(_SPECIAL.get(letter) or _letter(letter) for letter in text)


def _letter(letter: str) -> str:
    """Letters of Latin-1 as they are; else the same letter without its accents, or its code."""
    if letter.isascii() or (letter.isalpha() and ord(letter) < 0x100):
        return letter
    plain = unicodedata.normalize("NFKD", letter).encode("ascii", "ignore").decode()
    return latex_text(plain) or f"[U+{ord(letter):04X}]"


def _escaped(text: str) -> str:
    return text.replace("_", r"\_")
