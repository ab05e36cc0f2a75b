"""Simulated measurements, by physics that share nothing with the regressor.

Rigid links in the world frame, effects as torques on shafts, a controller that sees a quantised
encoder: `simulate` gives a log as a machine would, and the truth beside it. Robots with loops carry
out the commanded motion exactly, or are driven by the controller too; they are closed by equations
that the modeling stages do not share.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from modeler.simulation.entries import *  # noqa: F403
else:

    def __getattr__(name: str) -> Any:
        """One of `entries`: `modeler --help` reads what is light here, without the rest."""
        import modeler.simulation.entries as entries

        return getattr(entries, name)
