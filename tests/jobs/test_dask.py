"""Work on a Dask cluster: equal to that of this process, also where workers are lost."""

import dataclasses
import os
import signal
from collections.abc import Iterator
from functools import reduce
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

from modeler import __version__
from modeler.api.chunk_workers import make_worker_reducer, merge_in_time
from modeler.cli import main
from modeler.core import jobs as cluster
from modeler.core.errors import DataError
from modeler.core.jobs import Workers, open_workers
from modeler.estimation.long_logs import PartialFit, identify_long, reduce_by_threads, stream_logs
from modeler.regression.log import Log
from modeler.regression.read import open_source
from modeler.regression.survey import KnownFacts, choose_from_windows
from tests.fleet.machines import PROCESSING, Scene, compiled, emitted, logs
from tests.jobs.work import added, ends_always, refused, third

ROWS = 256  # of a chunk


def written(path: Path, log: Log, group: int = 900) -> Path:
    columns = {"time": log.time}
    for j, name in enumerate(log.joints):
        columns |= {f"q{name}": log.q[:, j], f"tau{name}": log.tau[:, j]}
    path.parent.mkdir(parents=True, exist_ok=True)
    pq.write_table(pa.table(columns), path, row_group_size=group)
    return path


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A fleet of logs in row groups that no chunk ends with."""
    folder = tmp_path_factory.mktemp("logs")
    for named, log in logs(Scene(machines=2, periods=2, duration=40.0), 1):
        written(folder / named.machine / f"{named.period}.parquet", log)
    return folder


def sources(folder: Path) -> list:
    return [open_source(path, compiled().spec) for path in sorted(folder.glob("*/*.parquet"))]


def chunks_of(source: Any, rows: int = ROWS) -> Any:
    """How that source is read."""
    return choose_from_windows(compiled(), [source], PROCESSING, KnownFacts(), rows).chosen[0]


def test_chunks_from_the_middle_of_a_file_are_those_of_the_whole(place: Path) -> None:
    """To the bit where they are merged in the same order, by workers of this process."""
    model, [source, *_] = compiled(), sources(place)
    chosen = chunks_of(source, 300)
    one = reduce(PartialFit.merged_with, reduce_by_threads(model, source, chosen))
    other = reduce(
        PartialFit.merged_with, make_worker_reducer(Workers(), emitted())(model, source, chosen)
    )
    counts = one.facts.tally.sums
    assert counts["chunks"] > 2
    for name, count in counts.items():
        assert np.array_equal(count, other.facts.tally.sums[name]), name
    assert one.facts.block_hashes == other.facts.block_hashes and one.facts.span == other.facts.span
    turned = [np.einsum("jki,jkl->jil", p.data.triangles, p.data.triangles) for p in (one, other)]
    scale = np.sqrt(np.einsum("jii->ji", turned[0]))
    outer = np.where(scale > 0.0, scale, 1.0)
    close = (turned[1] - turned[0]) / outer[:, :, None] / outer[:, None, :]
    assert np.abs(close).max() < 1e-13


def test_time_increases_from_job_to_job(place: Path) -> None:
    [source, *_] = sources(place)
    first, later, *_ = reduce_by_threads(compiled(), source, chunks_of(source))
    assert merge_in_time(first, later).facts.span == (first.facts.span[0], later.facts.span[1])
    with pytest.raises(DataError, match="s; expected increasing time; sort and split the file"):
        merge_in_time(later, first)


def test_logs_that_cannot_be_read_from_the_middle_are_read_here(place: Path) -> None:
    """CSV: its rows have no places."""
    file = place / "same.csv"
    pyarrow.csv.write_csv(pq.read_table(place / "r1" / "day1.parquet"), file)
    source = open_source(file, compiled().spec)
    partials = make_worker_reducer(Workers(), emitted())(compiled(), source, chunks_of(source))
    assert reduce(PartialFit.merged_with, partials).facts.tally.count("rows") == 4000


@pytest.fixture(scope="module")
def distributed() -> Any:
    return pytest.importorskip(
        "distributed", reason='NOT CHECKED: no Dask; pip install "modeler-robotics[dask]"'
    )


@pytest.fixture(scope="module")
def in_threads(distributed: Any) -> Iterator[str]:
    """Two workers in this process."""
    with distributed.LocalCluster(
        n_workers=2, processes=False, dashboard_address=":0", silence_logs=50
    ) as cluster_:
        yield cluster_.scheduler_address


@pytest.fixture(scope="module")
def address(distributed: Any) -> Iterator[str]:
    """Two workers, each a process that a nanny starts again."""
    __import__("dask").config.set({"distributed.scheduler.allowed-failures": 1})
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50, memory_limit=0
    ) as cluster_:
        yield cluster_.scheduler_address


def test_a_cluster_gives_what_this_process_gives(in_threads: str) -> None:
    jobs, shares, here = range(9), list[float](), Workers()
    with open_workers(in_threads) as workers:
        waiting = workers.start_merge(third, 0.1, jobs, added)
        results = workers.map_jobs(third, 0.1, jobs, shares.append)
        assert np.array_equal(results, here.map_jobs(third, 0.1, jobs))
        assert np.array_equal(waiting(), here.start_merge(third, 0.1, jobs, added)())
        assert shares == [k / 9 for k in range(1, 10)]
        with pytest.raises(DataError, match="log: job 2 cannot be done"):
            workers.map_jobs(refused, "log", range(4))
        with pytest.raises(DataError, match="log: job 2 cannot be done"):
            workers.start_merge(refused, "log", range(4), max)()


@pytest.mark.rotating("long tests of jobs")
def test_a_fit_is_the_local_one(address: str, place: Path) -> None:
    """To 1e-10 of the values, all logs at once, chunk after chunk; a worker is lost on the way."""
    model, inputs = compiled(), sources(place)
    here = identify_long(stream_logs(model, inputs, PROCESSING, rows=ROWS))
    with open_workers(address) as workers:
        there, struck = fitted_without_one(workers, inputs)
    np.testing.assert_allclose(there.beta, here.beta, rtol=1e-10)
    np.testing.assert_allclose(there.covariance, here.covariance, rtol=1e-9, atol=1e-18)
    assert struck and there.rows == here.rows and there.reading == here.reading
    assert there.processing == here.processing and there.sentences == here.sentences


def fitted_without_one(workers: cluster.Cluster, inputs: list) -> tuple[Any, list[int]]:
    """The fit, and the process that ended while the first log was on its way."""
    plain, struck = make_worker_reducer(workers, emitted()), list[int]()

    def reducer(*each):  # type: ignore[no-untyped-def]
        begun = plain(*each)
        if not struck:
            struck.append(next(iter(workers._client.run(os.getpid).values())))
            os.kill(struck[0], signal.SIGKILL)
        return begun

    long = stream_logs(compiled(), inputs, PROCESSING, rows=ROWS, reducer=reducer)
    return identify_long(long), struck


def test_workers_must_see_the_same_file(in_threads: str, tmp_path: Path) -> None:
    file = written(tmp_path / "a.parquet", logs(Scene(machines=1, periods=1), 2)[0][1])
    source = open_source(file, compiled().spec)
    chosen = chunks_of(source)
    file.unlink()
    with (
        open_workers(in_threads) as workers,
        pytest.raises(DataError, match="a worker sees none, expected a file of 1200 rows; work"),
    ):
        list(make_worker_reducer(workers, emitted())(compiled(), source, chosen))


@pytest.mark.rotating("long tests of jobs")
def test_commands_on_a_cluster(address: str, place: Path, tmp_path: Path, capsys) -> None:
    """A fleet to the letter; a fit of many files; what needs all rows in one memory is refused."""
    words = ["fleet", "two-link", *(str(place / name) for name in ("r1", "r2"))]
    assert main(words) == 0
    here = capsys.readouterr().out
    assert main([*words, "--dask", address]) == 0
    assert capsys.readouterr().out == here
    inputs = [str(path) for path in sorted((place / "r1").iterdir())]
    fit = ["fit", "two-link", *inputs, "--out", str(tmp_path / "m.json"), "--dask", address]
    assert main(fit) == 0
    assert capsys.readouterr().err == ""
    text = tmp_path / "same.csv"
    pyarrow.csv.write_csv(pq.read_table(inputs[0]), text)
    assert main(["fit", "two-link", str(text), *fit[3:]]) == 0
    assert (
        "same.csv: read and reduced by this process; workers of dask can begin in the middle"
        in (capsys.readouterr().err)
    )
    assert main([*fit, "--method", "iv"]) == 1
    message = f"--dask {address}: got --method iv, which needs all rows in one memory"
    assert message in capsys.readouterr().err


def test_what_does_not_answer_is_one_line(monkeypatch, distributed: Any) -> None:
    short = dataclasses.replace(cluster.THRESHOLDS, scheduler_timeout=0.3)
    monkeypatch.setattr(cluster, "THRESHOLDS", short)
    for address in ("tcp://127.0.0.1:9", "nonsense://here"):
        with pytest.raises(DataError) as error, open_workers(address):
            pass
        assert str(error.value).startswith(f"--dask {address}: no scheduler answers there (")
    message = "the scheduler has no workers; start some, as `dask worker ADDRESS`"
    with (
        distributed.LocalCluster(
            n_workers=0, processes=False, dashboard_address=":0", silence_logs=50
        ) as empty,
        pytest.raises(DataError, match=message),
        open_workers(empty.scheduler_address),
    ):
        pass


@pytest.mark.rotating("long tests of jobs")
def test_workers_of_another_version_are_told(address: str, monkeypatch) -> None:
    monkeypatch.setattr(cluster, "__version__", "0.0")
    message = f"has modeler {__version__}; expected 0.0; install the same where the workers run"
    with pytest.raises(DataError, match=message), open_workers(address):
        pass


@pytest.mark.slow
def test_a_job_that_ends_all_its_workers_is_told(address: str) -> None:
    """Last of all: it costs the cluster its workers, which nannies start again."""
    message = "Dask: a job ended 2 workers one after the other, as when"
    with open_workers(address) as workers, pytest.raises(DataError, match=message):
        workers.map_jobs(ends_always, "", [0])
