"""What `add` is asked for, checked before any log is looked at."""

from collections.abc import Sequence

from modeler.core.errors import DataError
from modeler.effects import Acts, Effect, effect_named
from modeler.fit import IdentifiedModel
from modeler.improve.passive import passive_joints, plain
from modeler.robot.place import listed, near

_JOINTED = (Acts.JOINT, Acts.MOTOR, Acts.POSITION, Acts.PASSIVE)


def asked(
    model: IdentifiedModel, name: str, joint: str | None, catalogue: Sequence[Effect]
) -> Effect:
    """The effect of that name, if it can go into the model on that joint.

    Args:
        model: as it is.
        name: id or alias of the effect.
        joint: name; None: whichever, or the whole robot.
        catalogue: the effects there are, with those of the robot file.

    Raises:
        DataError: no such effect or joint, one that cannot be added, that is there already, or
            that acts on the whole robot while a joint is named.
    """
    effect = effect_named(name, catalogue)
    if effect is None:
        raise DataError(
            f"{name}: no such effect{near(name, [known.id for known in catalogue])}; `modeler "
            "effects` lists them, with --robot FILE those of a robot file too"
        )
    if effect.hindrance:
        raise DataError(f"{effect.id}: cannot be added ({effect.hindrance})")
    _check_loops(model, effect)
    if joint is not None:
        _check_joint(model, effect, joint)
    _check_absent(model, effect, joint)
    return effect


def _check_joint(model: IdentifiedModel, effect: Effect, joint: str) -> None:
    if effect.acts not in _JOINTED and (effect.acts is not Acts.LINK or effect.last_link):
        raise DataError(
            f"--joint {joint}: {effect.id} acts on the whole robot, not on one joint; leave "
            "--joint out"
        )
    names = _places(model, effect)
    if joint not in names and joint in passive_joints(model.spec) and effect.acts in _JOINTED:
        raise DataError(
            f"--joint {joint}: it has no motor, and there {effect.id} cannot be found from logs; "
            "write it into the robot file, or add viscous, coulomb or passive_friction"
        )
    if joint not in names:
        raise DataError(f"--joint {joint}: no such joint; expected one of {listed(names)}")


def _check_loops(model: IdentifiedModel, effect: Effect) -> None:
    """The C of a robot with loops reads speeds and accelerations of its joints, nothing else."""
    if model.spec.closure is None or effect.acts not in _JOINTED:
        return
    if effect.acts is Acts.POSITION or not effect.forms[0].names <= {"v", "a"}:
        raise DataError(
            f"{effect.id}: cannot be added ({model.spec.robot} has loops, and there effects may "
            "read speeds and accelerations only; keep it in mind as a finding)"
        )


def _check_absent(model: IdentifiedModel, effect: Effect, joint: str | None) -> None:
    """An effect stands in a model once, but for ripples: there may be several orders."""
    if effect.several or effect.acts not in _JOINTED:
        return
    present = {p.joint for p in model.spec.standard if p.effect == effect.id}
    if joint in present:
        raise DataError(f"{effect.id}: joint {joint} has it in this model already")
    motors = {joint.name for joint in model.spec.joints if joint.actuated}
    if joint is None and present and present >= motors:
        raise DataError(f"{effect.id}: every joint has it in this model already")


def _places(model: IdentifiedModel, effect: Effect) -> list[str]:
    """Where the effect may act: joints with a motor, joints that loops leave over, or links."""
    if effect.acts is Acts.LINK:
        return list(dict.fromkeys(p.joint for p in model.spec.standard if p.effect == "rigid_body"))
    passive = list(passive_joints(model.spec))
    if effect.acts is Acts.PASSIVE:
        return passive
    driven = [joint.name for joint in model.spec.joints if joint.actuated]
    return driven + passive if plain(effect) else driven
