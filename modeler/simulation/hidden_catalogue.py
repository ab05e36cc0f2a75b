"""All effects that can be hidden, by id."""

from collections.abc import Mapping

from modeler.simulation.hidden_friction import FRICTION, MEMORY
from modeler.simulation.hidden_kind import HiddenKind
from modeler.simulation.hidden_machine import MACHINE, SENSORS, SPRINGS

HIDDEN: Mapping[str, HiddenKind] = {
    kind.effect: kind for kind in (*FRICTION, *MEMORY, *SPRINGS, *MACHINE, *SENSORS)
}
"""The effects that a simulated machine can have and its robot file not, by id."""
