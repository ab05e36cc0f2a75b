"""Logs that hold channels of joints which the robot has not: of another robot, it seems."""

from collections import Counter
from collections.abc import Sequence

from modeler.fleet.summary import Left, LogSummary


def of_another_robot(used: Sequence[LogSummary]) -> tuple[list[LogSummary], list[Left], list[str]]:
    """The logs to compare, those that are left out, and what is to be said of the others.

    A log with positions and torques of more joints than the robot has is left out where more than
    half of all logs have other joints than it; where no such half is, or it has them too, it is
    told.
    """
    kinds = Counter(each.beyond for each in used)
    kept, left, told = [], [], dict[tuple[str, ...], list[str]]()
    for each in used:
        others = max((n for joints, n in kinds.items() if joints != each.beyond), default=0)
        if each.beyond and 2 * others > len(used):
            why = (
                f"has joint{'s' * (len(each.beyond) > 1)} {', '.join(each.beyond)} besides, which "
                "most logs have not; a log of another robot? name the right one"
            )
            left.append(Left(each.named, f"{each.named.place}: {why}"))
            continue
        kept.append(each)
        if each.beyond:
            told.setdefault(each.beyond, []).append(each.named.place)
    notes = [
        f"{places[0]}{f' and {len(places) - 1} more' * (len(places) > 1)}: positions and torques "
        f"of joints besides those of the robot ({', '.join(joints)}) are not read; is the robot "
        "file that of these machines?"
        for joints, places in told.items()
    ]
    return kept, left, notes
