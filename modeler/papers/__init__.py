"""The papers' printed results, beside what is derived."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from modeler.papers.entries import *  # noqa: F403
else:

    def __getattr__(name: str) -> Any:
        """One of `entries`: `modeler --help` reads what is light here, without the rest."""
        import modeler.papers.entries as entries

        return getattr(entries, name)
