"""What the user should know of an effect that was added, beside its error."""

from modeler.diagnose.sentences import percent, where
from modeler.diagnose.values import told_spread
from modeler.effects import Effect, effect_named
from modeler.fit import Addition, IdentifiedModel
from modeler.robot import robot_from_text

_FALLS = 0.99  # of the error before: anything above is no fall


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


def notes(model: IdentifiedModel) -> list[str]:
    """Sentences on the step that was added last; empty where all is as asked."""
    if len(model.history) < 2:
        return []
    before, last = model.history[-2:]
    effect = effect_named(last.effect, robot_from_text(model.robot_text, "robot").catalogue)
    assert effect is not None
    found = []
    if _stands_in(effect, last):
        found.append(
            f"{effect.id}, {where(last.joint)}: the logs have no column temperature{last.joint} or "
            "temperature, so the time since their start stands for it; log it to know more"
        )
    if last.error > _FALLS * before.error:
        found.append(
            f"{effect.id}, {where(last.joint)}: the error does not fall "
            f"({percent(before.error)} -> {percent(last.error)}); `modeler add MODEL undo` takes "
            "the effect out again"
        )
    return found


def _stands_in(effect: Effect, step: Addition) -> bool:
    """True if the effect usually reads a temperature and here does not."""
    usual = effect.forms[0]
    return "T" in usual.names and {shape.name for shape in usual.shapes} != set(step.shapes)
