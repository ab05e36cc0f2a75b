"""A diagnosis as text."""

from modeler.diagnose.result import Diagnosis
from modeler.diagnose.sentences import blind_spots
from modeler.scoring.score import printed


def lines(diagnosis: Diagnosis) -> list[str]:
    """The verdict, what was found, the errors of all joints, and what the logs cannot show."""
    found = list(diagnosis.sentences)
    source = "held out" if diagnosis.held_out else "cross-validated"
    found.append("")
    found.append(f"{'joint':<6}{'error':>9}{'with effects':>14}  ({source}, up to "
                 f"{diagnosis.band:g} Hz)")  # fmt: skip
    for name, joint in diagnosis.joints.items():
        before, after = printed(joint.error_before, joint.error_after)
        found.append(f"{name:<6}{before:>9}{after:>14}")
    blind = [what for what, _ in blind_spots(diagnosis)]
    if blind:
        found.append(f"these logs cannot show: {', '.join(blind)}")
    return found
