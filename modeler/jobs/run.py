"""Like jobs, one after the other or many at once; results do not depend on which."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Protocol, TypeVar

from modeler.core.errors import DataError

J = TypeVar("J")
R = TypeVar("R")

Done = Callable[[float], None]
"""Called with the share of the jobs that are done, 0 to 1."""

LOCAL = "local"
"""In place of the address of a scheduler: a cluster of this machine's processors."""


class Workers(Protocol):
    """Whoever carries out jobs.

    Functions and jobs must be such that they can be sent to another process: functions of a module,
    dataclasses of arrays. A job may be carried out more than once.
    """

    def each(self, work: Callable[[J], R], jobs: Sequence[J], done: Done | None = None) -> list[R]:
        """What `work` makes of each job, in the order of the jobs.

        Raises:
            ModelerError: the first that a job raised, or no worker could do one.
        """

    def total(
        self,
        work: Callable[[J], R],
        jobs: Sequence[J],
        merge: Callable[[R, R], R],
        done: Done | None = None,
    ) -> R:
        """All results merged in pairs of neighbours, pairs of pairs, and so on.

        The pairs are the same whoever works, and so is the result, to the last bit, on machines
        that compute alike.

        Args:
            work: of one job.
            jobs: one at least.
            merge: of two results, the earlier first.
            done: is told the share.
        """


@contextmanager
def open_workers(dask: str | None = None, processes: int = 1) -> Iterator[Workers]:
    """Workers: a Dask cluster, processes of this machine, or this process itself.

    Args:
        dask: address of a scheduler, as tcp://host:8786, or "local"; None: no Dask.
        processes: how many, without Dask; 1: this process.

    Raises:
        DataError: Dask is not installed or does not answer, or its workers lack this package.
    """
    if dask is not None:
        from modeler.jobs.cluster import open_cluster

        with open_cluster(dask) as workers:
            yield workers
    elif processes > 1:
        from modeler.jobs.processes import open_processes

        with open_processes(processes) as workers:
            yield workers
    else:
        yield Here()


class Here:
    """This process."""

    def each(self, work: Callable[[J], R], jobs: Sequence[J], done: Done | None = None) -> list[R]:
        """See `Workers`."""
        found = []
        for k, job in enumerate(jobs, start=1):
            found.append(work(job))
            tell(done, k, len(jobs))
        return found

    def total(
        self,
        work: Callable[[J], R],
        jobs: Sequence[J],
        merge: Callable[[R, R], R],
        done: Done | None = None,
    ) -> R:
        """See `Workers`; holds no more results than the tree is high."""
        return in_pairs((self.each(work, [job])[0] for job in told(jobs, done)), merge)


def told(jobs: Sequence[J], done: Done | None) -> Iterator[J]:
    """The jobs, telling after each that it is done."""
    for k, job in enumerate(jobs, start=1):
        yield job
        tell(done, k, len(jobs))


def tell(done: Done | None, count: int, all_: int) -> None:
    """The share, to who wants it."""
    if done is not None:
        done(count / all_)


def in_pairs(results: Iterator[R], merge: Callable[[R, R], R]) -> R:
    """Neighbours merged, then pairs of pairs: the tree over all results, kept low.

    Two subtrees of one height are merged as soon as both are there; the rest at the end, the last
    first. `levels` gives the same tree.

    Raises:
        DataError: no results.
    """
    waiting: list[tuple[int, R]] = []
    for result in results:
        waiting.append((0, result))
        while len(waiting) > 1 and waiting[-1][0] == waiting[-2][0]:
            (height, left), (_, right) = waiting[-2:]
            waiting[-2:] = [(height + 1, merge(left, right))]
    if not waiting:
        raise DataError("no jobs; expected one at least")
    _, found = waiting.pop()
    while waiting:
        found = merge(waiting.pop()[1], found)
    return found


def levels(count: int) -> Iterator[tuple[int, int]]:
    """Pairs (left, right) in the order in which `in_pairs` merges; the result stands at left."""
    waiting: list[tuple[int, int]] = []
    for place in range(count):
        waiting.append((0, place))
        while len(waiting) > 1 and waiting[-1][0] == waiting[-2][0]:
            (height, left), (_, right) = waiting[-2:]
            yield left, right
            waiting[-2:] = [(height + 1, left)]
    while len(waiting) > 1:
        _, right = waiting.pop()
        yield waiting[-1][1], right
