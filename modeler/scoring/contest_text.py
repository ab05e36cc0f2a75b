"""Models side by side in words and as a table of text."""

from modeler.compare.table import aligned
from modeler.scoring.contest import Contest, JointContest
from modeler.scoring.score import percent

MARK = "*"


def contest_lines(found: Contest) -> list[str]:
    """Errors by joint and model, the best beyond doubt marked; then who is better where."""
    names = [name.removesuffix(".json").removesuffix(".model") for name in found.names]
    rows = [["joint", *names, "unit", "rms", *[""] * (len(names) - 1)]]
    for item in found.joints:
        errors = [
            percent(error) + (MARK if item.best == k else " ")
            for k, error in enumerate(item.errors)
        ]
        sizes = [f"{rms:.3g}" for rms in item.rms]
        rows.append([item.joint.name, *errors, item.joint.effort_unit, *sizes])
    for unit in found.by_unit[0]:
        errors = [percent(own[unit]) + " " for own in found.by_unit]
        rows.append(["all", *errors, unit, *[""] * len(names)])
    lines = [line.rstrip() for line in aligned(rows, (0, len(names) + 1))]
    lines.append(f"{found.samples} samples; {MARK} better than every other beyond doubt")
    return [*lines, "", *contest_sentences(found)]


def contest_sentences(found: Contest) -> list[str]:
    """Who predicts which joints best; what remains open."""
    said = []
    for k, name in enumerate(found.names):
        won = found.wins(k)
        if won:
            said.append(f"{name} predicts {_joints(won)} best, beyond doubt.")
    open_ = [item for item in found.joints if item.best is None]
    if open_:
        told = ", ".join(f"joint {item.joint.name} ({_open(item)})" for item in open_)
        said.append(f"No model is the best beyond doubt on {told}.")
    return said


def headline_of(found: Contest) -> tuple[str, str]:
    """Who wins on how many joints."""
    wins = [len(found.wins(k)) for k in range(len(found.names))]
    top = max(range(len(wins)), key=wins.__getitem__)
    if not wins[top]:
        return "no winner", "no model is better than the others beyond doubt on any joint"
    count = f"{wins[top]} of {len(found.joints)}"
    if wins.count(wins[top]) > 1:
        tied = " and ".join(n for n, w in zip(found.names, wins, strict=True) if w == wins[top])
        return f"{count} each", f"joints that {tied} predict best, beyond doubt"
    lost = sum(wins) - wins[top]
    rest = f"; others on {lost}" if lost else "; no other on any"
    return count, f"joints that {found.names[top]} predicts best, beyond doubt{rest}"


def _open(item: JointContest) -> str:
    if item.chance >= 1.0 or item.chance < 1e-3:  # too short, or too small a difference
        return "as good as alike" if item.chance < 1e-3 else "cannot be told"
    return f"chance alone makes such a difference in {100.0 * item.chance:.2g} % of cases"


def _joints(names: list[str]) -> str:
    if len(names) == 1:
        return f"joint {names[0]}"
    return f"joints {', '.join(names[:-1])} and {names[-1]}"
