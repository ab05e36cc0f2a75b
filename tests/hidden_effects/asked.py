"""Asking about cases in one process or several; what is answered is stored in a file."""

import json
import multiprocessing
import os
import sys
from collections.abc import Collection
from concurrent.futures import ProcessPoolExecutor, as_completed


def names_of(text: str | None, known: Collection[str]) -> list[str]:
    """Names with commas, all that are known for None; one that is not ends the program."""
    names = list(known) if text is None else text.split(",")
    if unknown := [name for name in names if name not in known]:
        sys.exit(f"unknown: {', '.join(unknown)}; expected of {', '.join(known)}")
    return names


def asked_once(cases, ask, memory, read, jobs=1, tell=print, good=bool):
    """The answers to cases, in their order; those that `memory` holds are not asked again.

    Args:
        cases: each with a `name`.
        ask: gives the answer to one, which has a `to_json`; another process must find it.
        memory: file, one answer a line; remove it to ask a new program again.
        read: what `to_json` gave, as an answer.
        jobs: processes.
        tell: called with every answer as it comes.
        good: whether an answer that is stored counts.
    """
    known = {}
    if memory and memory.exists():
        for line in memory.read_text(encoding="utf-8").splitlines():
            held = json.loads(line)
            name, answer = held.pop("asked"), read(held)
            if good(answer):
                known[name] = answer
    for name, answer in _answers([case for case in cases if case.name not in known], ask, jobs):
        known[name] = answer
        if memory:
            memory.parent.mkdir(parents=True, exist_ok=True)
            with memory.open("a", encoding="utf-8") as lines:
                lines.write(json.dumps({"asked": name} | answer.to_json()) + "\n")
        tell(answer)
    return [known[case.name] for case in cases]


def _answers(cases, ask, jobs):
    if jobs == 1:
        yield from ((case.name, ask(case)) for case in cases)
        return
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # one core a process
    fresh = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=fresh) as pool:
        names = {pool.submit(ask, case): case.name for case in cases}
        for future in as_completed(names):
            yield names[future], future.result()
