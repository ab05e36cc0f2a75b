"""Which physical effect a model lacks, what it would gain, and the model with it."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from modeler.diagnosis.entries import *  # noqa: F403
else:

    def __getattr__(name: str) -> Any:
        """One of `entries`: a fit's page reads what is light here, without the rest."""
        import modeler.diagnosis.entries as entries

        return getattr(entries, name)
