"""Work in many like pieces: here, in processes, or on a Dask cluster; the results do not differ."""

import logging
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from modeler import __version__
from modeler.core.errors import DataError, suggest_install
from modeler.core.files import defer_signals
from modeler.core.thresholds import THRESHOLDS

if TYPE_CHECKING:
    from distributed import Client


# Like jobs, one after the other or many at once; results do not depend on which.


S = TypeVar("S")
J = TypeVar("J")
R = TypeVar("R")

Done = Callable[[float], None]
"""Called with the share of the jobs that are done, 0 to 1."""


def ignore_progress(share: float) -> None:
    """Ignores the share of the jobs that are done."""


Progress = Callable[[str], AbstractContextManager[Done]]
"""Opens a step of this title whose share of done work can be reported."""


@dataclass(frozen=True)
class Reporter:
    """Reports the progress of work that takes long; each field by itself may be left out.

    Attributes:
        report_step: is called with the title of each step, which lasts as long as the context.
        show_progress: the same, for a step whose share of done work is known.
        print_note: takes a line on what is done otherwise than requested.
    """

    report_step: Callable[[str], AbstractContextManager[None]] = lambda title: nullcontext()
    show_progress: Progress = lambda title: nullcontext(ignore_progress)
    print_note: Callable[[str], None] = lambda line: None


SILENT = Reporter()
"""Reports nothing."""


LOCAL = "local"
"""In place of the address of a scheduler: a cluster of this machine's processors."""


class Workers:
    """Whoever carries out jobs: this process itself, unless a subclass knows others.

    Functions, what they share and jobs must be such that they can be sent to another process:
    functions of a module, dataclasses of arrays. A job may be carried out more than once.
    """

    def map_jobs(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], done: Done = ignore_progress
    ) -> list[R]:
        """Returns what `work` makes of each job, in the order of the jobs.

        Args:
            work: of what all share, and a job.
            shared: sent once to each worker, at most.
            jobs: in order.
            done: receives the share.

        Raises:
            ModelerError: the first that a job raised, or no worker could do one.
        """
        results = []
        for k, job in enumerate(jobs, start=1):
            results.append(work(shared, job))
            done(k / len(jobs))
        return results

    def start_merge(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], merge: Callable[[R, R], R]
    ) -> Callable[[], R]:
        """Begins all jobs, whose results are merged in pairs of neighbours, pairs of pairs.

        And so on.

        The pairs are the same whoever works, and so is the result, to the last bit, on machines
        that compute alike. This process does nothing before the result is requested.

        Args:
            work: of what all share, and a job.
            shared: as above.
            jobs: one at least.
            merge: of two results, the earlier first.

        Returns:
            what waits for the result; raises as `each` does.
        """
        return lambda: merge_pairwise([work(shared, job) for job in jobs], merge)


@contextmanager
def open_workers(dask: str | None = None, processes: int = 1) -> Iterator[Workers]:
    """Opens workers: a Dask cluster, processes of this machine, or this process itself.

    Args:
        dask: address of a scheduler, as tcp://host:8786, or "local"; None: no Dask.
        processes: how many, without Dask; 1: this process.

    Raises:
        DataError: Dask is not installed or does not answer, or its workers lack this package.
    """
    if dask is not None:
        with open_cluster(dask) as workers:
            yield workers
    elif processes > 1:
        with open_processes(processes) as workers:
            yield workers
    else:
        yield Workers()


def merge_pairwise(results: Sequence[R], merge: Callable[[R, R], R]) -> R:
    """Merges results in the order of `list_merge_pairs`; returns the one that is left."""
    merged = list(results)
    for left, right in list_merge_pairs(len(merged)):
        merged[left] = merge(merged[left], merged[right])
    return merged[0]


def list_merge_pairs(count: int) -> Iterator[tuple[int, int]]:
    """Yields (left, right) of neighbours to merge, in order.

    Each result stands at left, the last at 0.

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


class Cluster(Workers):
    """The workers of a scheduler.

    A job whose worker is lost is done again by another; one that has cost several workers is
    reported.
    """

    def __init__(self, client: "Client") -> None:
        self._client = client

    def map_jobs(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], done: Done = ignore_progress
    ) -> list[R]:
        """Returns the results, as `Workers.each`."""
        futures = self._submit_jobs(work, shared, jobs)
        from distributed import as_completed

        with _report_lost_workers():
            for k, future in enumerate(as_completed(futures), start=1):
                if future.status == "error":
                    future.result()
                done(k / len(futures))
            results: list[R] = self._client.gather(futures)
        return results

    def start_merge(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], merge: Callable[[R, R], R]
    ) -> Callable[[], R]:
        """Begins all jobs, as `Workers.begun`.

        Merged where the results are, only the last travels here.
        """
        futures = self._submit_jobs(work, shared, jobs)
        for left, right in list_merge_pairs(len(jobs)):
            futures[left] = self._client.submit(merge, futures[left], futures[right], pure=False)
        return partial(_wait_result, futures[0])

    def _submit_jobs(self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J]) -> list[Any]:
        """Futures; what is shared is one of them, so that it is made again if it is lost."""
        common = self._client.submit(return_same, shared, pure=False)
        return [self._client.submit(work, common, job, pure=False) for job in jobs]


@contextmanager
def open_cluster(address: str) -> Iterator[Cluster]:
    """Opens the cluster behind a scheduler, or one of this machine that ends with the work.

    Args:
        address: "local", or as tcp://host:8786.

    Raises:
        DataError: Dask is not installed, nobody answers there, or the workers lack this package.
    """
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        raise DataError(
            f"--dask {address}: Dask is not installed; {suggest_install('dask')}, or leave "
            "--dask out"
        ) from None
    for name in ("distributed", "distributed.worker", "distributed.nanny", "distributed.scheduler"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    if address == LOCAL:
        count = os.process_cpu_count() if hasattr(os, "process_cpu_count") else os.cpu_count()
        options = {"dashboard_address": ":0", "memory_limit": 0, "silence_logs": logging.CRITICAL}
        with (
            LocalCluster(n_workers=count or 1, threads_per_worker=1, **options) as cluster,
            Client(cluster) as client,
        ):
            yield _check_workers(client, address)
        return
    try:
        client = Client(address, timeout=THRESHOLDS.scheduler_timeout)
    except (OSError, ValueError, TimeoutError) as error:
        raise DataError(
            f"--dask {address}: no scheduler answers there ({error or 'timeout'}); expected an "
            "address such as tcp://host:8786, as `dask scheduler` prints it, or local"
        ) from None
    with client:
        yield _check_workers(client, address)


def _check_workers(client: "Client", address: str) -> Cluster:
    """The cluster, if it has workers and they have this version of this package."""
    try:
        client.wait_for_workers(1, timeout=THRESHOLDS.scheduler_timeout)
    except TimeoutError:
        raise DataError(
            f"--dask {address}: the scheduler has no workers; start some, as `dask worker ADDRESS`"
        ) from None
    try:
        versions = client.run(get_version)
    except ImportError as error:
        raise DataError(
            f"--dask {address}: a worker lacks a package ({error}); install version "
            f"{__version__} from its checkout where the workers run"
        ) from None
    for worker, worker_version in versions.items():
        if worker_version != __version__:
            raise DataError(
                f"--dask {address}: worker {worker} has modeler {worker_version}; expected "
                f"{__version__}; "
                "install the same where the workers run"
            )
    return Cluster(client)


def _wait_result(future: Any) -> Any:
    with _report_lost_workers():
        return future.result()


def return_same(thing: S) -> S:
    """Returns the argument, where it is called."""
    return thing


def get_version() -> str:
    """Returns the version of this package, where it is called."""
    return __version__


@contextmanager
def _report_lost_workers() -> Iterator[None]:
    from distributed import KilledWorker

    try:
        yield
    except KilledWorker as error:
        raise DataError(
            f"Dask: a job ended {error.allowed_failures + 1} workers one after the other, as when "
            "memory runs out; give the workers more memory"
        ) from None


# Jobs in processes of this machine.


_WARNINGS = "PYTHONWARNINGS"
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


class Processes(Workers):
    """A pool; each process has one thread for linear algebra."""

    def __init__(self, pool: ProcessPoolExecutor) -> None:
        self._pool = pool

    def map_jobs(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], done: Done = ignore_progress
    ) -> list[R]:
        """Returns the results, as `Workers.each`."""
        return _gather_results(self._submit_jobs(work, shared, jobs), done)

    def start_merge(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], merge: Callable[[R, R], R]
    ) -> Callable[[], R]:
        """Begins all jobs, as `Workers.begun`; merged in this process."""
        futures = self._submit_jobs(work, shared, jobs)
        return lambda: merge_pairwise(_gather_results(futures, ignore_progress), merge)

    def _submit_jobs(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J]
    ) -> "list[Future[R]]":
        with defer_signals(), block_interrupts():  # here they are started
            return [self._pool.submit(work, shared, job) for job in jobs]


def _gather_results(futures: "Sequence[Future[R]]", done: Done) -> list[R]:
    try:
        for k, future in enumerate(as_completed(futures), start=1):
            future.result()
            done(k / len(futures))
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


def exit_with_parent() -> None:
    """Ends this process when the one that started it has ended, even if that was killed."""
    parent = multiprocessing.parent_process()
    assert parent is not None

    def wait_for_parent() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=wait_for_parent, daemon=True).start()


@contextmanager
def block_interrupts() -> Iterator[None]:
    """Blocks SIGINT in what is started meanwhile: Ctrl-C reaches this process alone."""
    mask = getattr(signal, "pthread_sigmask", None)
    before = mask(signal.SIG_BLOCK, {signal.SIGINT}) if mask else ()
    try:
        yield
    finally:
        if mask:
            mask(signal.SIG_SETMASK, before)


@contextmanager
def open_processes(count: int) -> Iterator[Processes]:
    """Opens a pool of so many fresh processes; what they inherit is one thread each."""
    before = {name: os.environ.get(name) for name in (*_THREADS, _WARNINGS)}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    # Where this process is killed, a helper of Python's counts what it could not give back.
    os.environ[_WARNINGS] = f"{before[_WARNINGS] or 'default'},ignore:resource_tracker"
    try:
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(count, mp_context=context, initializer=exit_with_parent) as pool:
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


# One entry point for work that comes in many like pieces: here, in processes, or on other machines.
