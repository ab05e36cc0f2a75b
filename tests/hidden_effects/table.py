"""The results as a page in Markdown."""

from collections.abc import Callable, Sequence

from tests.hidden_effects.drives import NOISE
from tests.hidden_effects.score import DETECTABLE, Key, Score
from tests.hidden_effects.sensor_kinds import FINE, SENSORS

INTRODUCTION = """# Hidden effects: what the diagnosis finds

Written by `python -m tests.hidden_effects`. Every case is a random arm, simulated by a program
that shares no code with the one that is tested, with an effect that its robot file does not name.
Effects are hidden one at a time, two at a time, or not at all; the diagnosis sees the robot file
and the logs only. Joint and values are drawn; noise is {noise} of the torque.

*First*: the effect named first is the hidden one, on its joint. *Joint*: it is on that joint.
*Tie*: the hidden effect is the one named first, or one that is said to be as likely.
*Exact*: what is hidden is named, and nothing else. *Fall*: median fall of the held-out error of
the joint by the effect named first, where it is right. Where the cause is outside the catalogue, or
withheld from it, nothing may be stated as a fact. Cases where even a perfect diagnosis would have
next to nothing to see (less than {least} of the noise) are not counted; they are listed below.
"""


SENSORS_TOLD = f"""Other sensors and recorders on such arms; a slow one takes five times as long for
its way, and has motors in proportion. *First*: of what these positions can show at all: an effect
that is less than {DETECTABLE} of the noise, to which that of the positions adds, is not counted.
*Stated*: it is stated as the cause, perhaps with others that are as likely; *Fact*: alone.
*Wrong*: what is stated is not there, of all cases with a statement. *Names wrong*: something is
named that is not there; where the log is wrong, its fault may be named. *Alarms*: such names, or no
answer, where nothing is hidden. *Told*: what is wrong with the log, in words or by a name.
What is "perhaps" missing is no name.
"""


def page(scores: Sequence[Score]) -> str:
    """Counts by effect and noise, false alarms, pairs, and every case that went wrong."""
    seen = [score for score in scores if score.detectable]
    named = [s for s in seen if not s.withheld and not s.held_out and s.sensor == FINE]
    single = [score for score in named if len(score.hidden) == 1]
    noise = ", ".join(f"{100 * share:.3g} % ({name})" for name, share in NOISE.items())
    parts = [INTRODUCTION.format(noise=noise, least=DETECTABLE)]
    if single:
        parts += ["## One effect\n", _singles(single)]
    if clean := [score for score in named if not score.hidden]:
        parts += ["## Nothing hidden\n", _clean(clean)]
    if pairs := [score for score in named if len(score.hidden) == 2]:
        parts += ["## Two effects\n", _pairs(pairs)]
    if coarse := [score for score in scores if score.sensor != FINE]:
        parts += ["## Coarse encoders, noisy positions\n", SENSORS_TOLD, by_sensor(coarse)]
    if withheld := [score for score in seen if score.withheld]:
        parts += ["## The hidden effect withheld from the catalogue\n", _withheld(withheld)]
    if held_out := [score for score in seen if score.held_out]:
        parts += ["## Causes outside the catalogue\n", _held_out(held_out)]
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
        clean, faulty = ([s for s in some if good(s)] for good in (_is_clean, _is_faulty))
        rows.append([
            SENSORS[kind].told if kind else "**all**",
            count(hidden, lambda s: s.first),
            count(hidden, lambda s: s.stated and s.tied),
            count(hidden, lambda s: len(s.facts) > len(s.wrong)),
            count(stated, lambda s: s.false),
            count(some, lambda s: s.spurious > 0),
            count(clean, lambda s: s.spurious > 0 or bool(s.error)),
            count(faulty, lambda s: bool(s.told)),
        ])  # fmt: skip
    header = ["Sensor", "First", "Stated", "Fact", "Wrong", "Names wrong", "Alarms", "Told"]
    return markdown(header, rows)


def _is_clean(score: Score) -> bool:
    return not score.hidden


def _is_faulty(score: Score) -> bool:
    return score.told is not None


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
    rows = [["False alarms", *(_alarms([s for s in scores if s.noise == k]) for k in levels)]]
    rows[0].append(_alarms(scores))
    return markdown(["", *levels, "all"], rows)


def _alarms(scores: Sequence[Score]) -> str:
    return count(scores, lambda score: not score.exact)


def _pairs(scores: Sequence[Score]) -> str:
    rows = []
    for name in [*(level for level in NOISE if any(s.noise == level for s in scores)), "**all**"]:
        some = [s for s in scores if name in (s.noise, "**all**")]
        spurious = sum(s.spurious for s in some) / len(some)
        counts = [count(some, lambda s: s.first), count(some, lambda s: s.found == 2)]
        rows.append([name, *counts, count(some, lambda s: s.exact), f"{spurious:.2f}"])
    return markdown(["Noise", "First is one", "Both", "Exact", "Spurious a case"], rows)


def _withheld(scores: Sequence[Score]) -> str:
    rows = [
        ["Another effect stated as the cause", count(scores, lambda s: s.stated)],
        ["Another effect as the closest description", count(scores, _closest)],
        [
            "Systematic, and not in the catalogue",
            count(scores, lambda s: s.verdict == "unexplained"),
        ],
        ["Nothing significant", count(scores, lambda s: s.verdict == "nothing significant")],
    ]
    return markdown(["The diagnosis says", "cases"], rows)


def _held_out(scores: Sequence[Score]) -> str:
    verdicts: list[Callable[[Score], bool]] = [
        lambda s: s.stated,
        _closest,
        lambda s: s.verdict == "unexplained",
        lambda s: s.verdict == "nothing significant",
    ]
    rows = []
    for name in [*dict.fromkeys(score.effects for score in scores), "**all**"]:
        some = [score for score in scores if name in (score.effects, "**all**")]
        rows.append([name, *(count(some, verdict) for verdict in verdicts)])
    header = ["Cause", "Another effect stated", "Closest description", "Unexplained"]
    return markdown([*header, "Nothing significant"], rows)


def _closest(score: Score) -> bool:
    return score.verdict == "closest description"


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
    return f"{score.case} ({where}): {_hidden(score)}; said {said}{tied}"


def _hidden(score: Score) -> str:
    return ", ".join(map(_name, score.hidden)) or "nothing"


def _name(key: Key) -> str:
    return key[0] if key[1] is None else f"{key[0]}@{key[1]}"
