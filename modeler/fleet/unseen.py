"""What a fleet cannot see: quantities that one machine's logs do not tell, and too few changes."""

from collections.abc import Sequence

import numpy as np

from modeler.fleet.joint_fit import LOAD
from modeler.fleet.judge import JudgedQuantity
from modeler.fleet.summary import LogSummary

FAR = 5.0
"""Times by which a machine's sigmas exceed those of the others, from which it is told."""

FEW = 5
"""Changes from period to period below which the scatter of a quantity is not known by them."""


def not_seen(found: JudgedQuantity, logs: Sequence[LogSummary]) -> list[str]:
    """A sentence on each machine that would hide a drift which the others would show."""
    names = list(dict.fromkeys(each.named.machine for each in logs))
    sigmas = np.array([[_sigma(found, m, i) for i in range(len(found.quantities))]
                       for m in range(found.machines)])  # fmt: skip
    said = []
    for m, name in enumerate(names):
        hidden = []
        for i, quantity in enumerate(found.quantities):
            others = np.delete(sigmas[:, i], m)
            others = others[np.isfinite(others)]
            if quantity.effect == LOAD or not others.size:
                continue
            times = sigmas[m, i] / float(np.median(others))
            if times > FAR:
                count = f"{times:.2g} times" if np.isfinite(times) else "not at all"
                hidden.append(f"{quantity.parameter} ({count})")
        if hidden:
            said.append(
                f"machine {name}: its logs tell {', '.join(hidden)} far worse than those of the "
                "others do (times their sigma): a drift that would be found there may hide here; "
                "record a motion like theirs"
            )
    return said


def _sigma(found: JudgedQuantity, m: int, i: int) -> float:
    """Usual sigma of one log; infinite if none tells it, NaN of gains that a load stands for."""
    own = found.known(m, i)
    if own.size:
        return float(np.median(found.sigmas[own, i]))
    load = found.quantities[i].column < 0 and found.loaded is not None and m in found.loaded
    return float("nan") if load else float("inf")


def scatter_known(found: JudgedQuantity, logs: int) -> list[str]:
    """A sentence if the scatter from period to period comes from few changes."""
    count = max(sum(len(found.series(m, i).changes) for m in range(found.machines))
                for i in range(len(found.quantities)))  # fmt: skip
    if count >= FEW or logs == found.machines:
        return []
    return [
        f"{logs} logs: too few to know how values scatter from one period to the next; a drift "
        "must be large to be told, and that nothing drifts says little; record more periods"
    ]
