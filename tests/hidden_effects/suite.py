"""Which cases there are, and running them: made once, diagnosed once, stored in a folder."""

import json
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from tests.hidden_effects.asked import asked_once
from tests.hidden_effects.case import Case, NoArm, make_case
from tests.hidden_effects.effects import EFFECTS
from tests.hidden_effects.held_out_effects import HELD_OUT_EFFECTS
from tests.hidden_effects.score import Score, failed, score_from_json, scored

DEVELOPMENT = range(1, 100)
"""Seeds to look at, to learn from and to repair with."""

ACCEPTANCE = range(1001, 1100)
"""Seeds that nobody looks at: run, and published."""

IMPOSSIBLE = frozenset({"elasticity", "backlash"})  # one gear for both


def cases_with(effects, noises, seeds, pool=(), clean=0, two=0, withheld=0, held_out=0):
    """Every effect at every noise with every seed, and the first so many of a pool at every noise.

    Args:
        effects, noises, seeds: of single effects.
        pool: seeds of the others.
        clean: cases without any effect.
        two: pairs of effects, drawn by the seed.
        withheld: effects, drawn by the seed, that the diagnosis may not name.
        held_out: seeds of every cause outside the catalogue.
    """
    seeds, other = list(seeds), pool[:withheld]
    single = [(name, seeds) for name in effects]
    single += [(name, pool[:held_out]) for name in HELD_OUT_EFFECTS]
    return [
        *(Case((name,), noise, seed) for name, some in single for noise in noises for seed in some),
        *(Case((), noise, seed) for seed in pool[:clean] for noise in noises),
        *(Case(_pair(seed), noise, seed) for seed in pool[:two] for noise in noises),
        *(Case(_pair(seed)[:1], k, seed, withheld=True) for seed in other for k in noises),
    ]


def _pair(seed: int) -> tuple[str, ...]:
    rng = np.random.default_rng([seed, 2])
    while True:
        pair = tuple(str(name) for name in rng.choice(sorted(EFFECTS), 2, replace=False))
        if set(pair) != IMPOSSIBLE:
            return pair


def ran(case: Case, cases: Path) -> Score:
    """Make a case unless it is there, diagnose it, and only then open its truth."""
    from tests.chain import diagnose_case

    folder = cases / case.folder
    place = folder / "truth.json"
    try:
        if not place.exists():
            make_case(case, folder)
    except NoArm as problem:
        return failed(case.name, _no_truth(case), str(problem))
    said: dict[str, Any] | str
    try:
        said = diagnose_case(folder, case.effects if case.withheld else ())
        text = json.dumps(said, indent=1) + "\n"
        (folder / f"{case.name}.json").write_text(text, encoding="utf-8")
    except Exception as problem:
        said = f"{type(problem).__name__}: {problem}"
    truth = json.loads(place.read_text(encoding="utf-8"))
    made = failed if isinstance(said, str) else scored
    return made(case.name, truth, said, case.withheld)  # type: ignore[operator]


def _no_truth(case: Case) -> dict[str, Any]:
    """Of a case that could not be made: what was requested, invisible."""
    hidden: list[dict[str, Any]]
    hidden = [{"effect": name, "joint": None, "values": {}} for name in case.effects]
    robot, sensor = case.kind or "any", {"kind": case.sensor}
    return dict(hidden=hidden, visible=[0.0], noise=case.noise, robot=robot, sensor=sensor)


def run(cases, folder, jobs=1, tell=print):
    """The scores of cases, in their order; those that `folder` remembers are not run again.

    Args:
        cases: what to run.
        folder: keeps `cases/` and `results.jsonl`; remove the latter to ask a new program again.
        jobs: processes.
        tell: called with every score as it comes.
    """
    ask = partial(ran, cases=folder / "cases")
    return asked_once(cases, ask, folder / "results.jsonl", score_from_json, jobs, tell)
