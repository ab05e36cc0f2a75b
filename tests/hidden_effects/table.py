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


Column = Callable[[Sequence[Score]], str]
"""A cell from the scores of its row."""


def count(good: Callable[[Score], bool], of: Callable[[Score], bool] = lambda s: True) -> Column:
    """`good/all`; empty if there are none."""

    def cell(scores: Sequence[Score]) -> str:
        counted = [score for score in scores if of(score)]
        return f"{sum(map(good, counted))}/{len(counted)}" if counted else ""

    return cell


def _fall(scores: Sequence[Score]) -> str:
    falls = sorted(s.fall for s in scores if s.first and s.fall is not None)
    return f"{100 * falls[len(falls) // 2]:.0f} %" if falls else ""


def _to_name(score: Score) -> bool:
    return bool(score.hidden) and score.detectable


SINGLE = {
    **{
        f"First, {level}": count(lambda s: s.first, lambda s, level=level: s.noise == level)
        for level in NOISE
    },
    "First": count(lambda s: s.first),
    "Joint": count(lambda s: s.joint),
    "Tie": count(lambda s: s.tied),
    "Exact": count(lambda s: s.exact),
    "Fall": _fall,
}
CLEAN = {"False alarms": count(lambda s: not s.exact)}
PAIRS = {
    "First is one": SINGLE["First"],
    "Both": count(lambda s: s.found == 2),
    "Exact": SINGLE["Exact"],
    "Spurious a case": lambda some: f"{sum(s.spurious for s in some) / len(some):.2f}",
}
BY_SENSOR = {
    "First": count(lambda s: s.first, _to_name),
    "Stated": count(lambda s: s.stated and s.tied, _to_name),
    "Fact": count(lambda s: len(s.facts) > len(s.wrong), _to_name),
    "Wrong": count(lambda s: s.false, lambda s: s.stated),
    "Names wrong": count(lambda s: s.spurious > 0),
    "Alarms": count(lambda s: s.spurious > 0 or bool(s.error), lambda s: not s.hidden),
    "Told": count(lambda s: bool(s.told), lambda s: s.told is not None),
}
OUTSIDE = {
    "Another effect stated": count(lambda s: s.stated),
    "Closest description": count(lambda s: s.verdict == "closest description"),
    "Unexplained": count(lambda s: s.verdict == "unexplained"),
    "Nothing significant": count(lambda s: s.verdict == "nothing significant"),
}


def page(scores: Sequence[Score]) -> str:
    """Counts by effect, noise and sensor, and every case that went wrong."""
    seen = [score for score in scores if score.detectable]
    named = [s for s in seen if not s.withheld and not s.held_out and s.sensor == FINE]
    noise = ", ".join(f"{100 * share:.3g} % ({name})" for name, share in NOISE.items())
    parts = [INTRODUCTION.format(noise=noise)]
    for title, some, row, columns in (
        ("One effect", [s for s in named if len(s.hidden) == 1], _effects, SINGLE),
        ("Nothing hidden", [s for s in named if not s.hidden], _noise, CLEAN),
        ("Two effects", [s for s in named if len(s.hidden) == 2], _noise, PAIRS),
        (
            "Coarse encoders, noisy positions",
            [s for s in scores if s.sensor != FINE],
            lambda s: SENSORS[s.sensor].told,
            BY_SENSOR,
        ),
        (
            "The hidden effect withheld from the catalogue",
            [s for s in seen if s.withheld],
            _effects,
            OUTSIDE,
        ),
        ("Causes outside the catalogue", [s for s in seen if s.held_out], _effects, OUTSIDE),
    ):
        if some:
            parts += [f"## {title}\n", table(some, row, columns)]
    parts += ["## Misses\n", _list([score for score in seen if not score.right])]
    parts += ["## Undetectable\n", _list([s for s in scores if not s.detectable])]
    return "\n".join(parts)


def table(scores, row, columns):
    """A row for all scores of which `row` gives the same name, and one for all."""
    by_name: dict[str, list[Score]] = {}
    for score in scores:
        by_name.setdefault(row(score), []).append(score)
    by_name["**all**"] = list(scores)
    rows = [[name, *(cell(some) for cell in columns.values())] for name, some in by_name.items()]
    return markdown(["", *columns], rows)


def _effects(score: Score) -> str:
    return score.effects


def _noise(score: Score) -> str:
    return score.noise


def markdown(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table; all but the first column are numbers."""
    lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def _list(scores: Sequence[Score]) -> str:
    if not scores:
        return "None.\n"
    return "\n".join(f"- {line(score)}" for score in scores) + "\n"


def line(score: Score) -> str:
    """A case in one line."""
    seen = "" if score.visible is None else f", visible {score.visible:.2f}"
    names = [*map(_name, score.said), *(f"possibly {_name(key)}" for key in score.maybe)]
    said = score.error or f"{', '.join(names) or 'nothing'} ({score.verdict})"
    if score.wrong:
        said += f"; no fact: {', '.join(map(_name, score.wrong))}"
    if score.told is False:
        said += "; the log's fault is not reported"
    tied = "; tied with what is hidden" if score.tied and not score.first else ""
    where = f"{score.robot}{seen}"
    hidden = ", ".join(map(_name, score.hidden)) or "nothing"
    return f"{score.case} ({where}): {hidden}; said {said}{tied}"


def _name(key: Key) -> str:
    return key[0] if key[1] is None else f"{key[0]}@{key[1]}"
