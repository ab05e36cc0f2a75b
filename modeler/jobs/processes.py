"""Jobs in processes of this machine."""

import multiprocessing
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager

from modeler.core.errors import DataError
from modeler.jobs.run import Done, J, R, S, in_pairs, tell

_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


class Processes:
    """A pool; each process has one thread for linear algebra."""

    def __init__(self, pool: ProcessPoolExecutor) -> None:
        self._pool = pool

    def each(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], done: Done | None = None
    ) -> list[R]:
        """See `Workers`."""
        return _gathered(self._sent(work, shared, jobs), done)

    def begun(
        self,
        work: Callable[[S, J], R],
        shared: S,
        jobs: Sequence[J],
        merge: Callable[[R, R], R],
    ) -> Callable[[], R]:
        """See `Workers`; merged in this process."""
        futures = self._sent(work, shared, jobs)
        return lambda: in_pairs(_gathered(futures, None), merge)

    def _sent(self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J]) -> "list[Future[R]]":
        return [self._pool.submit(work, shared, job) for job in jobs]


def _gathered(futures: "Sequence[Future[R]]", done: Done | None) -> list[R]:
    try:
        for k, future in enumerate(as_completed(futures), start=1):
            future.result()
            tell(done, k, len(futures))
        return [future.result() for future in futures]
    except BrokenProcessPool:
        raise DataError(
            "a process ended in the middle of its work, as when memory runs out; use fewer "
            "--workers"
        ) from None
    finally:
        for future in futures:
            future.cancel()


@contextmanager
def open_processes(count: int) -> Iterator[Processes]:
    """A pool of so many fresh processes; what they inherit is one thread each."""
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(count, mp_context=context) as pool:
            yield Processes(pool)
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
