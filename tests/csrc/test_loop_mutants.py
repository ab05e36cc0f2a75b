"""`make check` of a robot with loops notices mutants of all that computes: 57 of 60 at least."""

import random
from itertools import cycle
from pathlib import Path

import numpy as np
import pytest

from modeler.core.errors import ModelerError
from modeler.core.manifest import EmittedModule
from tests.csrc.loop_mutants import mutants_of
from tests.csrc.test_mutants import Folder, Mutant, changed, same_results, told
from tests.modules import loaded, module

ROBOTS = ("five-bar", "orthoglide-2003", "3rrr")
COUNT, CAUGHT, SEED = 60, 57, 7

ESCAPED = (
    # the fallback: rows exchanged, and the regressor that is made there
    ("modeler_closure_factor.c", "lu[i * m + k] -= share", "lu[i * m + k] += share"),
    (
        "modeler_closure_factor.c",
        "k < loops->nonzeros; k++) {\n        const int place",
        "k < loops->nonzeros - 1; k++) {\n        const int place",
    ),
    ("five_bar_base_regressor.c", "phi[2] = -", "phi[2] = "),
    # the proof that the assembly mode stays
    ("five_bar.c", "fabs(J[5] - K[5])", "fabs(J[5] + K[5])"),
    ("modeler_closure.c", "both += x * y", "both -= x * y"),
    # where a step starts
    ("modeler_closure.c", "w->right[loops->row[k]] -= J[k]", "w->right[loops->row[k]] += J[k]"),
    # motion that is carried over
    ("modeler_closure_motion.c", "= -J[k];", "= J[k];"),
    ("modeler_closure_motion.c", "udd[k] += gamma[k];", ""),
    # tiles
    ("modeler_tile.c", "evaluated(all, p.values + k * length)", "evaluated(all, p.values)"),
    ("modeler_tile.c", "row * columns + column :", "row * columns :"),
    ("modeler_closing.h", "+ (a[j] - a[j])", ""),
    ("five_bar_tile.c", "+ o31d_q1y;", ";"),
)
"""Wrong signs, terms and bounds that a check of stored states alone did not notice."""


def same_ways(emitted: EmittedModule, other: EmittedModule) -> bool:
    """Whether a mutant is the same function: long paths in tiles, and targets near and far.

    It may take other steps, or take samples one by one that could go together: how many evaluations
    that takes is all that differs.
    """
    home = np.array([emitted.spec.closure.home[k] for k in emitted.spec.closure.actuated])
    values = []
    for files in (emitted, other):
        robot, rng, items = loaded(files), np.random.default_rng(11), []
        for size in (1e-3, 3e-2):
            t = np.linspace(0.0, 6.0, 301)[:, None]
            q = home + size * np.sin(t * rng.uniform(0.5, 2.0, len(home)))
            qd, qdd = rng.normal(size=(2, *q.shape))
            try:
                items.append(robot.observation(q, qd, qdd))
            except ModelerError:
                items.append(np.full(1, np.nan))
        far = home + np.outer(np.logspace(-3, 3, 40), rng.normal(size=len(home)))
        items.append(robot.closing_status(far) == 0)
        values.append(items)
    return all(
        a.shape == b.shape and np.all(np.abs(a * 1.0 - b) <= 1e-9 * np.abs(a * 1.0).max())
        for a, b in zip(*values, strict=True)
    )


def equivalent(emitted: EmittedModule, mutant: Mutant, name: str) -> bool:
    """Whether no number that a user sees can reveal the mutant."""
    other = changed(emitted, mutant)
    return same_results(emitted, other, name) and same_ways(emitted, other)


@pytest.fixture(scope="module")
def five_bar(tmp_path_factory) -> Folder:
    return Folder(module("five-bar").emitted, tmp_path_factory.mktemp("five-bar"))


@pytest.mark.rotating
@pytest.mark.parametrize("place", range(0, len(ESCAPED), 2))
def test_the_check_reaches_fallback_proof_and_tiles(place: int, five_bar) -> None:
    survived = []
    for file, old, new in ESCAPED[place : place + 2]:
        text = five_bar.emitted.files[file]
        assert old in text, (file, old)
        start = text.index(old)
        if five_bar.survives(Mutant(file, start, start + len(old), new)):
            survived.append(f"{file}: {old} -> {new}")
    assert not survived


@pytest.mark.slow
def test_of_60_mutants_57_are_noticed(tmp_path: Path) -> None:
    """Of each robot as many of every kind; those that change no number are drawn anew."""
    rng, noticed, survived = random.Random(SEED), 0, list[str]()
    folders, queues = {}, []
    for name in ROBOTS:
        emitted = module(name).emitted
        (tmp_path / name).mkdir()
        folders[name] = Folder(emitted, tmp_path / name)
        for kind in mutants_of(emitted).values():
            queues.append((name, iter(rng.sample(kind, len(kind)))))
    for name, queue in cycle(queues):
        if noticed + len(survived) == COUNT:
            break
        mutant, folder = next(queue), folders[name]
        if not folder.survives(mutant):
            noticed += 1
        elif not equivalent(folder.emitted, mutant, name):
            survived.append(told(folder.emitted, mutant))
    print(f"{noticed} of {COUNT} mutants noticed")
    assert noticed >= CAUGHT, "\n".join(survived)
