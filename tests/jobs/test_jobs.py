"""Jobs here and in processes: the same results to the bit, and a report of those that fail."""

import os
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.core.jobs import Workers, list_merge_pairs, merge_pairwise, open_workers
from tests.jobs.work import added, ends_always, refused, third


@pytest.mark.rotating("long tests of jobs")
@pytest.mark.parametrize("count", [1, 2, 3, 5, 8, 13, 64])
def test_pairs_make_one_of_all_in_order(count: int) -> None:
    """Each merge takes neighbours, earlier first; no branch is higher than a binary tree's."""
    spans, heights = [(k, k + 1) for k in range(count)], [0] * count
    for left, right in list_merge_pairs(count):
        assert spans[left][1] == spans[right][0]
        spans[left] = (spans[left][0], spans[right][1])
        heights[left] = 1 + max(heights[left], heights[right])
    assert spans[0] == (0, count) and heights[0] == int(np.ceil(np.log2(count)))
    assert merge_pairwise([[k] for k in range(count)], lambda a, b: a + b) == [*range(count)]


def test_processes_give_what_this_one_gives() -> None:
    jobs, shares = range(7), []
    here = Workers()
    with open_workers(processes=2) as others:
        waiting = others.start_merge(third, 0.1, jobs, added)
        result = others.map_jobs(third, 0.1, jobs, shares.append)
        assert np.array_equal(waiting(), here.start_merge(third, 0.1, jobs, added)())
        assert np.array_equal(result, here.map_jobs(third, 0.1, jobs))
        with pytest.raises(DataError, match="log: job 2 cannot be done"):
            others.map_jobs(refused, "log", range(4))
    assert shares == [k / 7 for k in range(1, 8)]


def test_a_process_that_ends_is_told() -> None:
    with open_workers(processes=2) as others, pytest.raises(DataError, match="a process ended in"):
        others.map_jobs(ends_always, "", range(2))


@pytest.mark.parametrize("killed", [False, True])
def test_an_interrupt_or_a_kill_while_they_start_leaves_no_word(killed: bool) -> None:
    """Ctrl-C goes to all processes of a terminal; a kill to the first alone."""
    program = (
        "from modeler.core.jobs import open_workers\n"
        "from tests.jobs.work import third\n"
        "if __name__ == '__main__':\n"
        "    with open_workers(processes=3) as workers:\n"
        "        waiting = workers.start_merge(third, 'x' * 10**6, range(9), None)\n"
        "        print('begun', flush=True)\n"
        "        import time; time.sleep(20)\n"
    )
    running = subprocess.Popen(
        [sys.executable, "-c", program],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        cwd=Path(__file__).parents[2],
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),  # a shell's & ignores it
    )
    assert running.stdout is not None and running.stdout.readline() == "begun\n"
    (os.kill if killed else os.killpg)(running.pid, signal.SIGKILL if killed else signal.SIGINT)
    err = running.communicate(timeout=60)[1]  # which all processes hold, so that all have ended
    assert err.count("Traceback") == (0 if killed else 1), err
    assert "resource_tracker" not in err


def test_this_process_does_what_it_is_given() -> None:
    shares: list[float] = []
    with open_workers() as workers:
        assert workers.map_jobs(refused, "log", [0, 1], shares.append) == [0, 1]
        with pytest.raises(DataError, match="log: job 2 cannot be done"):
            workers.map_jobs(refused, "log", range(4))
        assert workers.map_jobs(third, 0.1, []) == []
        with pytest.raises(DataError, match="no jobs; expected one at least"):
            workers.start_merge(third, 0.1, [], added)()
    assert shares == [0.5, 1.0]


def test_without_dask_one_line_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(DataError) as error, open_workers("local"):
        pass
    text = '--dask local: Dask is not installed; pip install "modeler-robotics[dask]", or leave'
    assert str(error.value) == f"{text} --dask out"
