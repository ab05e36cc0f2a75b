"""One page: headline, facts, sections, how it was made; one HTML file, no network."""

import html
from collections.abc import Sequence
from pathlib import Path
from string import Template

from modeler.compare.report import page_assets

_HERE = Path(__file__).parent


def page(
    title: str, headline: tuple[str, str], facts: Sequence[tuple[str, str]], sections: str,
    provenance: Sequence[str],
) -> str:  # fmt: skip
    """The page as text.

    Args:
        title: plain text.
        headline: a figure, and what it is.
        facts: names and what stands below them.
        sections: HTML.
        provenance: lines of plain text.
    """
    return Template((_HERE / "page.html").read_text(encoding="utf-8")).substitute(
        title=html.escape(title),
        figure=html.escape(headline[0]),
        headline=html.escape(headline[1]),
        facts="\n".join(f"<li><b>{html.escape(a)}</b>{html.escape(b)}</li>" for a, b in facts),
        sections=sections,
        provenance="\n".join(f"<li>{html.escape(line)}</li>" for line in provenance),
        **page_assets(),
    )


def section(title: str, body: str) -> str:
    """A section of HTML under a title of plain text."""
    return f"<section>\n<h2>{html.escape(title)}</h2>\n{body}\n</section>"
