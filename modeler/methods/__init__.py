"""The identifications of the papers, run again in simulation, beside what was printed."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from modeler.methods.entries import *  # noqa: F403
else:

    def __getattr__(name: str) -> Any:
        """One of `entries`: `modeler --help` reads what is light here, without the rest."""
        import modeler.methods.entries as entries

        return getattr(entries, name)
