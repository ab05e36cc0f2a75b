"""Effects on joints without motor: robot files may have them there."""

import dataclasses

from modeler.core.contract import ModuleSpec
from modeler.effects import Acts, Effect
from modeler.hypotheses.candidates import Candidate


def passive_joints(spec: ModuleSpec) -> dict[str, int]:
    """Joints without motor by name, and their places among the variables of the loops.

    In a robot without loops, their places among the joints.
    """
    if spec.closure is None:
        return {joint.name: j for j, joint in enumerate(spec.joints) if not joint.actuated}
    driven = {*spec.closure.given, *spec.closure.platform}
    return {name: i for i, name in enumerate(spec.closure.variables) if i not in driven}


def plain(effect: Effect) -> bool:
    """True for effects of a joint that read its speed and have no shapes."""
    form = effect.forms[0]
    return effect.acts is Acts.JOINT and not form.shapes and form.names <= {"v"}


def on_passive(spec: ModuleSpec, effect: Effect, joint: str | None) -> Candidate | None:
    """The effect on a joint without motor; None on others.

    Args:
        spec: of the robot.
        effect: `plain`.
        joint: name.
    """
    place = passive_joints(spec).get(joint or "")
    if place is None or not plain(effect):
        return None
    if spec.closure is not None:  # felt by all motors, by the speed that the loops give it
        effect = dataclasses.replace(effect, acts=Acts.PASSIVE)
    return Candidate(effect, effect.forms[0], joint, place)
