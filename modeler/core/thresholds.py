"""Limits of texts, files, expressions and messages."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Limits of texts, files, expressions and messages."""

    # brief
    max_repr_length: int = 160
    """Characters of a line, the name of the class aside."""
    max_repr_text: int = 40
    """Characters of a text, or of a tuple, in that line; a longer text is cut."""
    max_repr_items: int = 4
    """Entries of a tuple that are shown."""
    # files
    max_links: int = 40
    """Symbolic links that are followed, as in Linux."""
    # jobs
    scheduler_timeout: float = 10.0
    """s, in which a scheduler must answer and have a worker. No study."""
    # table
    max_page_rows: int = 60
    """Rows of a long table on a page: half of them from each end."""
    # toml_cells
    max_quoted_letters: int = 60
    """Letters of the text of a user that are quoted."""


THRESHOLDS = Thresholds()
