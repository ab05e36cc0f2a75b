"""What the logs cannot show, whatever is missing in the model."""

from modeler.diagnose.data_checks import one_speed
from modeler.diagnose.result import Key
from modeler.diagnose.search import Search
from modeler.effects import Acts, effect_named
from modeler.scoring.gram import VISIBLE
from modeler.scoring.propose import proposals, ruled_out
from modeler.scoring.state import State


def blind_spots(found: Search) -> tuple[Key, ...]:
    """Effects that these data cannot show: hidden by the model, or on joints that do not move."""
    ranked = found.steps[0].rivals if found.steps else found.last.ranked
    spec = found.start.data.compiled.spec
    has = {(p.effect, p.joint) for p in spec.standard}
    judged = [j for j in ranked if j.candidate.key not in has]
    seen = {j.candidate.key for j in judged}
    hidden: list[Key] = [j.candidate.key for j in judged if j.visible < 2.0 * VISIBLE]

    def ruled(effect: str, joint: str | None) -> bool:
        return ruled_out(effect, joint, found.without)

    catalogue = found.start.data.known.catalogue
    for joint in spec.joints:
        for name in [effect.id for effect in catalogue if effect.whole_axis]:
            if joint.actuated and (name, joint.name) not in seen and not ruled(name, joint.name):
                hidden.append((name, joint.name))
    for name in [effect.id for effect in catalogue if effect.last_link]:
        if found.start.data.kept is None and not ruled(name, None):
            hidden.append((name, None))
    hidden += [key for key in _unmoved(found.start) if not ruled(*key)]
    named = {step.pick.key for step in found.steps}
    named |= {tie.candidate.key for step in found.steps for tie in step.ties}
    kept = [key for key in dict.fromkeys(hidden) if key not in named]
    assert all(effect_named(name, found.start.data.known.catalogue) is not None for name, _ in kept)
    return tuple(kept)


def _unmoved(state: State) -> list[Key]:
    """All that could be on joints of which no row can be used, or that have one speed only.

    At one speed, functions of the speed are one column: only the moments of reversal differ.
    """
    own = (Acts.JOINT, Acts.MOTOR, Acts.POSITION)
    steady = [one_speed(state, j) is not None for j in range(state.rows.joints)]
    if not any(steady) and all(y.size for y in state.rows.y):
        return []
    return [
        candidate.key for candidate in proposals(state)
        if candidate.effect.acts in own
        and (
            not state.rows.y[candidate.index].size
            or (steady[candidate.index] and candidate.form.names == {"v"})
        )
    ]  # fmt: skip
