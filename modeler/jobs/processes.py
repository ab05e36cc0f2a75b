"""Jobs in processes of this machine."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager

from modeler.core.errors import DataError
from modeler.core.files import undisturbed
from modeler.jobs.run import Done, J, R, S, in_pairs, tell

_WARNINGS = "PYTHONWARNINGS"
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
        with undisturbed(), _deaf_to_interrupts():  # here they are started
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
    except Exception:
        for future in futures:
            future.cancel()
        raise


def _attend() -> None:
    """A process ends, without a word, when the one that started it has: even if that was killed."""
    parent = multiprocessing.parent_process()
    assert parent is not None

    def attend() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=attend, daemon=True).start()


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """What is started meanwhile leaves Ctrl-C, which a terminal sends to all, to this process."""
    mask = getattr(signal, "pthread_sigmask", None)
    before = mask(signal.SIG_BLOCK, {signal.SIGINT}) if mask else ()
    try:
        yield
    finally:
        if mask:
            mask(signal.SIG_SETMASK, before)


@contextmanager
def open_processes(count: int) -> Iterator[Processes]:
    """A pool of so many fresh processes; what they inherit is one thread each."""
    before = {name: os.environ.get(name) for name in (*_THREADS, _WARNINGS)}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    # Where this process is killed, a helper of Python's counts what it could not give back.
    os.environ[_WARNINGS] = f"{before[_WARNINGS] or 'default'},ignore:resource_tracker"
    try:
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(count, mp_context=context, initializer=_attend) as pool:
            try:
                yield Processes(pool)
            except KeyboardInterrupt:
                for process in multiprocessing.active_children():
                    process.terminate()
                pool._call_queue.cancel_join_thread()  # type: ignore[attr-defined]  # nobody reads what waits
                raise
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
