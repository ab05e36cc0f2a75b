"""A fleet's logs reduced by the workers of a local Dask cluster: seconds, and bytes that travel."""

import contextlib
import pickle
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks.line import Key, Line, Missing
from modeler.api import compile_model, derive, generate, load, simulate
from modeler.api.fleets import reduce_logs
from modeler.core.jobs import Cluster, Workers, ignore_progress
from modeler.simulation import write_log
from modeler.validation import analyse_fleet, name_logs

ROBOT = "panda"
LOGS, _FEW, _SECONDS, _TIMES = 16, 4, 40.0, 2
CLUSTERS = (2, 4)
_THOUSAND = 1e3


class _Weighed(Workers):
    """Other workers, and what they are sent and send back, pickled as Dask does."""

    def __init__(self, workers: Workers, count: int) -> None:
        self._workers, self._count, self.moved = workers, count, 0

    def map_jobs(
        self, work: Any, shared: Any, jobs: Sequence[Any], done: Any = ignore_progress
    ) -> list[Any]:
        result = self._workers.map_jobs(work, shared, jobs, done)
        weights = [len(pickle.dumps(thing, 5)) for thing in (shared, *jobs, *result)]
        self.moved = self._count * weights[0] + sum(weights[1:])
        return result


@contextlib.contextmanager
def _workers(count: int) -> Iterator[Workers]:
    """Those of a cluster; this process itself for 0."""
    if not count:
        yield Workers()
        return
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        raise Missing("Dask is not installed") from None
    local = {"threads_per_worker": 1, "dashboard_address": ":0"}
    with LocalCluster(n_workers=count, **local) as cluster, Client(cluster) as client:
        yield Cluster(client)


def _measure(quick: bool) -> Mapping[str, float]:
    robot = load(ROBOT)
    emitted = generate(derive(robot))
    compiled, values, fleets = compile_model(emitted), dict[str, float](), []
    with tempfile.TemporaryDirectory() as folder:
        places = [Path(folder) / f"r{k % 2}" / f"day{k // 2}.parquet" for k in range(LOGS)]
        for seed, place in enumerate(places[:_FEW] if quick else places):
            place.parent.mkdir(exist_ok=True)
            write_log(place, simulate(robot, duration=_SECONDS, seed=seed, parameter_seed=1))
        named = name_logs([(str(place), "") for place in places if place.exists()], None)
        size = sum(Path(each.place).stat().st_size for each in named)
        values["fleet_log_kb"] = size / _THOUSAND / len(named)
        for count in (0, *CLUSTERS):
            name = f"dask{count}" if count else "here"
            with _workers(count) as workers:
                weighed, taken = _Weighed(workers, count), []
                for _ in range(_TIMES):  # the first time workers load the package
                    begun = time.perf_counter()
                    inputs = reduce_logs(compiled, emitted, named, weighed)
                    taken.append(time.perf_counter() - begun)
            fleets.append(analyse_fleet(emitted.spec, inputs).findings)
            values[f"fleet_seconds.{name}"] = min(taken) / len(named)
            if count:
                values[f"fleet_first_seconds.{name}"] = taken[0] / len(named)
                values[f"fleet_moved_kb.{name}"] = weighed.moved / _THOUSAND / len(named)
    if any(one != fleets[0] for one in fleets):
        raise Missing("results depend on who works")
    return values


def _keys() -> Iterator[Key]:
    what = f"a log of {_SECONDS:g} s of {ROBOT} in a fleet of {LOGS}"
    yield Key("fleet_log_kb", "kB", f"The Parquet file of {what}.")
    yield Key("fleet_seconds.here", "s", f"Reading and reducing {what}, by one process.")
    for count in CLUSTERS:
        who = f"by local Dask workers (dask{count})"
        yield Key(f"fleet_seconds.dask{count}", "s", f"The same {who}: wall seconds over logs.")
        yield Key(f"fleet_first_seconds.dask{count}", "s", f"The same {who} that load the package.")
        yield Key(f"fleet_moved_kb.dask{count}", "kB", "Sent to and from them, a log.")


LINES = (Line(tuple(_keys()), _measure, 120),)
