"""Like jobs, one after the other or many at once; results do not depend on which."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Protocol, TypeVar

from modeler.core.errors import DataError

S = TypeVar("S")
J = TypeVar("J")
R = TypeVar("R")

Done = Callable[[float], None]
"""Called with the share of the jobs that are done, 0 to 1."""

LOCAL = "local"
"""In place of the address of a scheduler: a cluster of this machine's processors."""


class Workers(Protocol):
    """Whoever carries out jobs.

    Functions, what they share and jobs must be such that they can be sent to another process:
    functions of a module, dataclasses of arrays. A job may be carried out more than once.
    """

    def each(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], done: Done | None = None
    ) -> list[R]:
        """What `work` makes of each job, in the order of the jobs.

        Args:
            work: of what all share, and a job.
            shared: sent once to each worker, at most.
            jobs: in order.
            done: is told the share.

        Raises:
            ModelerError: the first that a job raised, or no worker could do one.
        """

    def begun(
        self,
        work: Callable[[S, J], R],
        shared: S,
        jobs: Sequence[J],
        merge: Callable[[R, R], R],
    ) -> Callable[[], R]:
        """All results merged in pairs of neighbours, pairs of pairs, and so on: begun.

        The pairs are the same whoever works, and so is the result, to the last bit, on machines
        that compute alike.

        Args:
            work: of what all share, and a job.
            shared: as above.
            jobs: one at least.
            merge: of two results, the earlier first.

        Returns:
            what waits for the result; raises as `each` does.
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

    def each(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], done: Done | None = None
    ) -> list[R]:
        """See `Workers`."""
        found = []
        for k, job in enumerate(jobs, start=1):
            found.append(work(shared, job))
            tell(done, k, len(jobs))
        return found

    def begun(
        self,
        work: Callable[[S, J], R],
        shared: S,
        jobs: Sequence[J],
        merge: Callable[[R, R], R],
    ) -> Callable[[], R]:
        """See `Workers`; nothing is done before its result is asked for."""
        return lambda: in_pairs([work(shared, job) for job in jobs], merge)


def tell(done: Done | None, count: int, all_: int) -> None:
    """The share, to who wants it."""
    if done is not None:
        done(count / all_)


def in_pairs(results: Sequence[R], merge: Callable[[R, R], R]) -> R:
    """Results merged as `pairs` says."""
    own = list(results)
    for left, right in pairs(len(own)):
        own[left] = merge(own[left], own[right])
    return own[0]


def pairs(count: int) -> Iterator[tuple[int, int]]:
    """(left, right) of neighbours to merge, in order; each result stands at left, the last at 0.

    Two subtrees of one height as soon as both are there; the rest at the end, the last first.

    Raises:
        DataError: nothing to merge.
    """
    if count < 1:
        raise DataError("no jobs; expected one at least")
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
