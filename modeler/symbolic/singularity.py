"""Singular postures: which joints could move there although the actuated ones are locked."""

import numpy as np

from modeler.symbolic.closing import SINGULAR
from modeler.symbolic.linkage import Linkage

_TAKES_PART = 0.1
"""Of the largest share in a motion, from which a joint is named."""


def lost_directions(linkage: Linkage, u: np.ndarray) -> list[str]:
    """The motions that a singular posture leaves free, each as `q11 : q12 : qP = 1 : -0.5 : 0.3`.

    Travels count in sizes of the robot. Joints that move little are left out.

    Args:
        linkage: the robot.
        u: (u,) closed posture.
    """
    names = [f"q{linkage.free[k].name}" for k in linkage.closing.solved]
    _, values, turned = np.linalg.svd(linkage.closing.inner(u[None])[0])
    told = []
    for motion in turned[values <= SINGULAR]:
        motion = motion / motion[np.argmax(np.abs(motion) > (1 - 1e-6) * np.max(np.abs(motion)))]
        moved = [k for k, share in enumerate(motion) if abs(share) > _TAKES_PART]
        who = " : ".join(names[k] for k in moved)
        told.append(who + " = " + " : ".join(f"{motion[k]:.2g}" for k in moved))
    return told
