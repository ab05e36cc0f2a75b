"""Running cases: each is asked once and stored in a file; errors are asked again."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from tests.hidden_effects.asked import asked_once
from tests.measured_sets.answer import Answer, answer_from_json
from tests.measured_sets.sets import Case

Ask = Callable[[Case, Path], Answer]


def answered(case: Case, data: Path, ask: Ask) -> Answer:
    """The answer, or why there is none."""
    try:
        return ask(case, data)
    except Exception as problem:
        return Answer(case, {}, error=f"{type(problem).__name__}: {problem}")


def run(cases, data, ask, memory=None, jobs=1, tell=print):
    """The answers to cases about the logs in a folder; the rest is as in `asked_once`."""
    chain = partial(answered, data=data, ask=ask)
    return asked_once(cases, chain, memory, answer_from_json, jobs, tell, lambda a: not a.error)
