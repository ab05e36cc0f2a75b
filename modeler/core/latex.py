"""Names as LaTeX, in relations and in closed forms alike."""

import re

_GREEK = {"alpha", "beta", "gamma", "delta", "theta", "phi", "psi"}


def latex_name(name: str) -> str:
    r"""`ZZ2R` as `\mathit{ZZ}_{2R}`, `D4` as `D_{4}`, `phi1` as `\phi_{1}`.

    An underscore is a letter of the name, so that different names stay different.
    """
    split = re.fullmatch(r"([A-Za-z]+)(\d\w*)?", name)
    head, index = (split[1], split[2]) if split else (name, None)
    if head.lower() in _GREEK:
        head = f"\\{head}"
    elif len(head) > 1:
        head = f"\\mathit{{{_escaped(head)}}}"
    return f"{head}_{{{_escaped(index)}}}" if index else head


def _escaped(text: str) -> str:
    return text.replace("_", r"\_")
