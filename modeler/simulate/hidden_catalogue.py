"""All effects that can be hidden, by id."""

from collections.abc import Mapping

from modeler.simulate.hidden_friction import FRICTION
from modeler.simulate.hidden_kind import HiddenKind
from modeler.simulate.hidden_machine import MACHINE, SENSORS
from modeler.simulate.hidden_memory import MEMORY
from modeler.simulate.hidden_springs import SPRINGS

HIDDEN: Mapping[str, HiddenKind] = {
    kind.effect: kind for kind in (*FRICTION, *MEMORY, *SPRINGS, *MACHINE, *SENSORS)
}
"""The effects that a simulated machine can have and its robot file not, by id."""
