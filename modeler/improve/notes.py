"""What the user should know of an effect that was added, beside its error."""

from modeler.diagnose.sentences import where
from modeler.diagnose.values import told_spread
from modeler.effects import Effect, effect_named
from modeler.fit import Addition, IdentifiedModel
from modeler.robot import robot_from_text
from modeler.scoring.score import told


def added(model: IdentifiedModel) -> list[str]:
    """Parameters that the step added last put into the model, with their units and shapes."""
    if len(model.history) < 2:
        return []
    last = model.history[-1]
    own = {p.name for p in model.spec.standard if (p.effect, p.joint) == (last.effect, last.joint)}
    base = {b.name for b in model.spec.base if b.column_of in own}
    lines = [
        f"{p.name} = {p.value:.5g}{told_spread(p.value, p.sigma or 0.0, p.interval)} {p.unit}"
        for p in model.fit.parameters if p.name in base
    ]  # fmt: skip
    if lines and last.shapes:
        units = _units(model, last)
        texts = [
            f"{k} = {v:.4g}{_spread(last, k)}{units.get(k, '')}" for k, v in last.shapes.items()
        ]
        lines.append("with " + ", ".join(texts))
    return lines


def _spread(step: Addition, name: str) -> str:
    sigma, interval = step.shape_sigmas.get(name, 0.0), step.shape_intervals.get(name)
    return told_spread(step.shapes[name], sigma, interval)


def _units(model: IdentifiedModel, step: Addition) -> dict[str, str]:
    """What stands behind the values of the shapes."""
    effect = effect_named(step.effect, robot_from_text(model.robot_text, "robot").catalogue)
    assert effect is not None
    linear = any(j.name == step.joint and j.unit == "m" for j in model.spec.joints)
    shapes = [shape for form in effect.forms for shape in form.shapes]
    units = {shape.name: shape.unit(linear) for shape in shapes}
    return {name: f" {unit}" for name, unit in units.items() if unit != "1"}


def notes(model: IdentifiedModel, since: int = -1) -> list[str]:
    """Sentences on steps that were added: which errors fall, and what is not as asked.

    Args:
        model: with its history.
        since: place of the first of them in the history.
    """
    if len(model.history) < 2:
        return []
    catalogue = robot_from_text(model.robot_text, "robot").catalogue
    found = []
    for step in model.history[since:]:
        effect = effect_named(step.effect, catalogue)
        assert effect is not None
        name = f"{effect.id}, {where(step.joint)}"
        if _stands_in(effect, step):
            found.append(
                f"{name}: the logs have no column temperature{step.joint} or temperature, so the "
                "time since their start stands for it; log it to know more"
            )
        found.append(_change(name, step))
    return found


def _change(name: str, step: Addition) -> str:
    change = told(step.joints, step.changed)
    if step.falls:
        return f"{name}: the error falls: {change}"
    return (
        f"{name}: the error does not fall ({change}); `modeler add MODEL undo` takes the effect "
        "out again"
    )


def _stands_in(effect: Effect, step: Addition) -> bool:
    """True if the effect usually reads a temperature and here does not."""
    usual = effect.forms[0]
    return "T" in usual.names and {shape.name for shape in usual.shapes} != set(step.shapes)
