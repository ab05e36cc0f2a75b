"""The results as a page in Markdown."""

from collections.abc import Callable, Sequence

from tests.hidden_effects.drives import NOISE
from tests.hidden_effects.score import DETECTABLE, Key, Score
from tests.hidden_effects.sensor_kinds import FINE, SENSORS

INTRODUCTION = f"""# Hidden effects: what the diagnosis finds

Written by `python -m tests.hidden_effects`; `docs/explanation/hidden-effects.md` says what the
columns mean. Noise is {{noise}} of the torque. Cases where even a perfect diagnosis would have next
to nothing to see (less than {DETECTABLE} of the noise) are not counted; they are listed below.
"""


def page(scores: Sequence[Score]) -> str:
    """Counts by effect and noise, false alarms, pairs, and every case that went wrong."""
    seen = [score for score in scores if score.detectable]
    named = [s for s in seen if not s.withheld and not s.held_out and s.sensor == FINE]
    single = [score for score in named if len(score.hidden) == 1]
    noise = ", ".join(f"{100 * share:.3g} % ({name})" for name, share in NOISE.items())
    parts = [INTRODUCTION.format(noise=noise)]
    if single:
        parts += ["## One effect\n", _singles(single)]
    if clean := [score for score in named if not score.hidden]:
        parts += ["## Nothing hidden\n", _clean(clean)]
    if pairs := [score for score in named if len(score.hidden) == 2]:
        parts += ["## Two effects\n", _pairs(pairs)]
    if coarse := [score for score in scores if score.sensor != FINE]:
        parts += ["## Coarse encoders, noisy positions\n", by_sensor(coarse)]
    if withheld := [score for score in seen if score.withheld]:
        parts += ["## The hidden effect withheld from the catalogue\n", _outside(withheld)]
    if held_out := [score for score in seen if score.held_out]:
        parts += ["## Causes outside the catalogue\n", _outside(held_out)]
    missed = [score for score in seen if not score.right]
    parts += ["## Misses\n", _list(missed)]
    parts += ["## Undetectable\n", _list([s for s in scores if not s.detectable])]
    return "\n".join(parts)


def markdown(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table; all but the first column are numbers."""
    lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def count(scores: Sequence[Score], good: Callable[[Score], bool]) -> str:
    """`good/all`; empty if there are none."""
    return f"{sum(map(good, scores))}/{len(scores)}" if scores else ""


def _singles(scores: Sequence[Score]) -> str:
    names = list(dict.fromkeys(score.effects for score in scores))
    levels = [level for level in NOISE if any(s.noise == level for s in scores)]
    header = ["Effect", *(f"First, {level}" for level in levels), "First", "Joint", "Tie", "Exact"]
    rows = [_row(name, [s for s in scores if s.effects == name], levels) for name in names]
    rows.append(_row("**all**", scores, levels))
    rows.append(["**share**", *(_share(cell) for cell in rows[-1][1:-1]), rows[-1][-1]])
    return markdown([*header, "Fall"], rows)


def by_sensor(scores: Sequence[Score]) -> str:
    """Names, facts and alarms by kind of sensor."""
    rows = []
    for kind in [*(kind for kind in SENSORS if any(s.sensor == kind for s in scores)), ""]:
        some = [s for s in scores if kind in (s.sensor, "")]
        hidden = [s for s in some if s.hidden and s.detectable]
        stated = [s for s in some if s.stated]
        rows.append([
            SENSORS[kind].told if kind else "**all**",
            count(hidden, lambda s: s.first),
            count(hidden, lambda s: s.stated and s.tied),
            count(hidden, lambda s: len(s.facts) > len(s.wrong)),
            count(stated, lambda s: s.false),
            count(some, lambda s: s.spurious > 0),
            count([s for s in some if not s.hidden], lambda s: s.spurious > 0 or bool(s.error)),
            count([s for s in some if s.told is not None], lambda s: bool(s.told)),
        ])  # fmt: skip
    header = ["Sensor", "First", "Stated", "Fact", "Wrong", "Names wrong", "Alarms", "Told"]
    return markdown(header, rows)


def _row(name: str, scores: Sequence[Score], levels: Sequence[str]) -> list[str]:
    by_level = [count([s for s in scores if s.noise == k], lambda s: s.first) for k in levels]
    kinds: list[Callable[[Score], bool]] = [
        lambda s: s.first, lambda s: s.joint, lambda s: s.tied, lambda s: s.exact
    ]  # fmt: skip
    falls = sorted(s.fall for s in scores if s.first and s.fall is not None)
    fall = f"{100 * falls[len(falls) // 2]:.0f} %" if falls else ""
    return [name, *by_level, *(count(scores, kind) for kind in kinds), fall]


def _share(cell: str) -> str:
    good, _, total = cell.partition("/")
    return f"{100 * int(good) / int(total):.1f} %"


def _clean(scores: Sequence[Score]) -> str:
    levels = [level for level in NOISE if any(s.noise == level for s in scores)]
    some = [[s for s in scores if s.noise == level] for level in levels]
    alarms = [count(cases, lambda score: not score.exact) for cases in (*some, scores)]
    return markdown(["", *levels, "all"], [["False alarms", *alarms]])


def _pairs(scores: Sequence[Score]) -> str:
    rows = []
    for name in [*(level for level in NOISE if any(s.noise == level for s in scores)), "**all**"]:
        some = [s for s in scores if name in (s.noise, "**all**")]
        spurious = sum(s.spurious for s in some) / len(some)
        counts = [count(some, lambda s: s.first), count(some, lambda s: s.found == 2)]
        rows.append([name, *counts, count(some, lambda s: s.exact), f"{spurious:.2f}"])
    return markdown(["Noise", "First is one", "Both", "Exact", "Spurious a case"], rows)


def _outside(scores: Sequence[Score]) -> str:
    """By cause: what is said of one that may not be named, or that no catalogue has."""
    verdicts = ("missing", "closest description", "unexplained", "nothing significant")
    rows = []
    for name in [*dict.fromkeys(score.effects for score in scores), "**all**"]:
        some = [score for score in scores if name in (score.effects, "**all**")]
        rows.append([name, *(count(some, lambda s, v=v: s.verdict == v) for v in verdicts)])
    header = ["Cause", "Another effect stated", "Closest description", "Unexplained"]
    return markdown([*header, "Nothing significant"], rows)


def _list(scores: Sequence[Score]) -> str:
    if not scores:
        return "None.\n"
    return "\n".join(f"- {line(score)}" for score in scores) + "\n"


def line(score: Score) -> str:
    """A case in one line."""
    seen = "" if score.visible is None else f", visible {score.visible:.2f}"
    names = [*map(_name, score.said), *(f"perhaps {_name(key)}" for key in score.maybe)]
    said = score.error or f"{', '.join(names) or 'nothing'} ({score.verdict})"
    if score.wrong:
        said += f"; no fact: {', '.join(map(_name, score.wrong))}"
    if score.told is False:
        said += "; the log's fault is not told"
    tied = "; tied with what is hidden" if score.tied and not score.first else ""
    where = f"{score.robot}{seen}"
    hidden = ", ".join(map(_name, score.hidden)) or "nothing"
    return f"{score.case} ({where}): {hidden}; said {said}{tied}"


def _name(key: Key) -> str:
    return key[0] if key[1] is None else f"{key[0]}@{key[1]}"
