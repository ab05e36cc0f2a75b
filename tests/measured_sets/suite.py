"""Running cases: each is asked once and remembered in a file."""

import json
import multiprocessing
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from tests.measured_sets.answer import Answer, answer_from_json
from tests.measured_sets.sets import Case

Ask = Callable[[Case, Path], Answer]


def answered(case: Case, data: Path, ask: Ask) -> Answer:
    """The answer, or why there is none."""
    try:
        return ask(case, data)
    except Exception as problem:
        return Answer(case, {}, error=f"{type(problem).__name__}: {problem}")


def run(
    cases: Sequence[Case], data: Path, ask: Ask, memory: Path | None = None, jobs: int = 1,
    tell: Callable[[Answer], None] = print,
) -> list[Answer]:  # fmt: skip
    """The answers to cases, in their order; those that `memory` holds are not asked again.

    Args:
        cases: to ask.
        data: folder of the measured logs.
        ask: gives the answer to one.
        memory: file, one answer a line; remove it to ask a new program again.
        jobs: processes.
        tell: called with every answer as it comes.
    """
    known = _remembered(memory) if memory else {}
    left = [case for case in cases if case.name not in known]
    for answer in _answers(left, data, ask, jobs):
        known[answer.case.name] = answer
        if memory:
            memory.parent.mkdir(parents=True, exist_ok=True)
            with memory.open("a", encoding="utf-8") as lines:
                lines.write(json.dumps(answer.to_json()) + "\n")
        tell(answer)
    return [known[case.name] for case in cases]


def _remembered(memory: Path) -> dict[str, Answer]:
    """What has an answer; errors are asked again."""
    lines = memory.read_text(encoding="utf-8").splitlines() if memory.exists() else []
    found = [answer_from_json(json.loads(line)) for line in lines]
    return {answer.case.name: answer for answer in found if not answer.error}


def _answers(cases: Sequence[Case], data: Path, ask: Ask, jobs: int) -> Iterator[Answer]:
    if jobs == 1:
        yield from (answered(case, data, ask) for case in cases)
        return
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # one core a process
    fresh = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=fresh) as pool:
        for future in as_completed([pool.submit(answered, c, data, ask) for c in cases]):
            yield future.result()
