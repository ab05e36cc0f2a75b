"""Jobs on a Dask cluster: other machines, or the processors of this one."""

import logging
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

from modeler import __version__
from modeler.core.errors import DataError, installing
from modeler.jobs.run import LOCAL, Done, J, R, S, pairs, tell

if TYPE_CHECKING:
    from distributed import Client

_ANSWER = 10.0  # s, in which a scheduler must answer and have a worker


class Cluster:
    """The workers of a scheduler.

    A job whose worker is lost is done again by another; one that has cost several workers is told.
    """

    def __init__(self, client: "Client") -> None:
        self._client = client

    def each(
        self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J], done: Done | None = None
    ) -> list[R]:
        """See `Workers`."""
        futures = self._sent(work, shared, jobs)
        with _lost_told():
            self._watched(futures, done)
            found: list[R] = self._client.gather(futures)
        return found

    def begun(
        self,
        work: Callable[[S, J], R],
        shared: S,
        jobs: Sequence[J],
        merge: Callable[[R, R], R],
    ) -> Callable[[], R]:
        """See `Workers`; merged where the results are, only the last one travels here."""
        own = self._sent(work, shared, jobs)
        for left, right in pairs(len(jobs)):
            own[left] = self._client.submit(merge, own[left], own[right], pure=False)
        return partial(_result, own[0])

    def _sent(self, work: Callable[[S, J], R], shared: S, jobs: Sequence[J]) -> list[Any]:
        """Futures; what is shared is one of them, so that it is made again if it is lost."""
        common = self._client.submit(same, shared, pure=False)
        return [self._client.submit(work, common, job, pure=False) for job in jobs]

    def _watched(self, futures: Sequence[Any], done: Done | None) -> None:
        from distributed import as_completed

        for k, future in enumerate(as_completed(futures), start=1):
            if future.status == "error":
                future.result()
            tell(done, k, len(futures))


@contextmanager
def open_cluster(address: str) -> Iterator[Cluster]:
    """The cluster behind a scheduler, or one of this machine that ends with the work.

    Args:
        address: "local", or as tcp://host:8786.

    Raises:
        DataError: Dask is not installed, nobody answers there, or the workers lack this package.
    """
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        raise DataError(
            f"--dask {address}: Dask is not installed; {installing('dask')}, or leave --dask out"
        ) from None
    for name in ("distributed", "distributed.worker", "distributed.nanny", "distributed.scheduler"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    if address == LOCAL:
        count = os.process_cpu_count() if hasattr(os, "process_cpu_count") else os.cpu_count()
        with (
            LocalCluster(
                n_workers=count or 1, threads_per_worker=1, dashboard_address=":0",
                memory_limit=0, silence_logs=logging.CRITICAL,
            ) as cluster,
            Client(cluster) as client,
        ):  # fmt: skip
            yield _checked(client, address)
        return
    try:
        client = Client(address, timeout=_ANSWER)
    except (OSError, ValueError, TimeoutError) as error:
        raise DataError(
            f"--dask {address}: no scheduler answers there ({error or 'time is up'}); expected an "
            "address such as tcp://host:8786, as `dask scheduler` prints it, or local"
        ) from None
    with client:
        yield _checked(client, address)


def _checked(client: "Client", address: str) -> Cluster:
    """The cluster, if it has workers and they have this version of this package."""
    try:
        client.wait_for_workers(1, timeout=_ANSWER)
    except TimeoutError:
        raise DataError(
            f"--dask {address}: the scheduler has no workers; start some, as `dask worker ADDRESS`"
        ) from None
    try:
        versions = client.run(version)
    except ImportError as error:
        raise DataError(
            f"--dask {address}: a worker lacks a package ({error}); install version "
            f"{__version__} from its checkout where the workers run"
        ) from None
    for worker, found in versions.items():
        if found != __version__:
            raise DataError(
                f"--dask {address}: worker {worker} has modeler {found}; expected {__version__}; "
                "install the same where the workers run"
            )
    return Cluster(client)


def _result(future: Any) -> Any:
    with _lost_told():
        return future.result()


def same(thing: S) -> S:
    """That thing, where it is called."""
    return thing


def version() -> str:
    """That of this package, where it is called."""
    return __version__


@contextmanager
def _lost_told() -> Iterator[None]:
    from distributed import KilledWorker

    try:
        yield
    except KilledWorker as error:
        raise DataError(
            f"Dask: a job ended {error.allowed_failures + 1} workers one after the other, as when "
            "memory runs out; give the workers more memory"
        ) from None
