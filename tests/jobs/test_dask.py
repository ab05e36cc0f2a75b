"""Work on a Dask cluster: equal to that of this process, also where workers are lost."""

import os
import signal
from collections.abc import Iterator
from functools import reduce
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

from modeler import __version__
from modeler.api.long_logs import by_workers, merged_in_time
from modeler.cli import main
from modeler.core import jobs as cluster
from modeler.core.errors import DataError
from modeler.core.jobs import Workers, open_workers
from modeler.estimation.long_logs import Partial, by_threads, identify_long, stream
from modeler.observation.log import Log
from modeler.observation.read import source_of
from modeler.observation.survey import FactsSoFar, survey
from modeler.runtime.model import CompiledModel
from tests.fleet.machines import PROCESSING, Scene, compiled, emitted, logs
from tests.jobs.work import added, ends_always, refused, third

WHY = 'NOT CHECKED: no Dask; pip install "modeler-robotics[dask]"'
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


def sources(folder: Path, model: CompiledModel) -> list:
    places = sorted(folder.glob("*/*.parquet"))
    return [source_of(path, model.spec) for path in places]


@pytest.mark.parametrize("rows", [300, pytest.param(100, marks=pytest.mark.rotating)])
def test_chunks_from_the_middle_of_a_file_are_those_of_the_whole(place: Path, rows: int) -> None:
    """To the bit where they are merged in the same order, by workers of this process."""
    model = compiled()
    given = sources(place, model)
    chosen = survey(model, given, PROCESSING, FactsSoFar(), rows).chosen[0]
    one = reduce(Partial.merged_with, by_threads(model, given[0], chosen))
    other = reduce(Partial.merged_with, by_workers(Workers(), emitted())(model, given[0], chosen))
    counts = one.facts.tally.sums
    assert counts["chunks"] > 2
    for name, count in counts.items():
        assert np.array_equal(count, other.facts.tally.sums[name]), name
    assert one.facts.fingers == other.facts.fingers and one.facts.span == other.facts.span
    turned = [np.einsum("jki,jkl->jil", p.data.triangles, p.data.triangles) for p in (one, other)]
    scale = np.sqrt(np.einsum("jii->ji", turned[0]))
    outer = np.where(scale > 0.0, scale, 1.0)
    close = (turned[1] - turned[0]) / outer[:, :, None] / outer[:, None, :]
    assert np.abs(close).max() < 1e-13


def test_time_increases_from_job_to_job(place: Path) -> None:
    model = compiled()
    [source, *_] = sources(place, model)
    chosen = survey(model, [source], PROCESSING, FactsSoFar(), ROWS).chosen[0]
    first, later, *_ = by_threads(model, source, chosen)
    assert merged_in_time(first, later).facts.span == (first.facts.span[0], later.facts.span[1])
    with pytest.raises(DataError, match="s; expected increasing time; sort and split the file"):
        merged_in_time(later, first)


def test_logs_that_cannot_be_read_from_the_middle_are_read_here(place: Path) -> None:
    """CSV: its rows have no places."""
    model = compiled()
    file = place / "same.csv"
    pyarrow.csv.write_csv(pq.read_table(place / "r1" / "day1.parquet"), file)
    source = source_of(file, model.spec)
    assert source is not None
    chosen = survey(model, [source], PROCESSING, FactsSoFar(), ROWS).chosen[0]
    partials = by_workers(Workers(), emitted())(model, source, chosen)
    assert reduce(Partial.merged_with, partials).facts.tally.count("rows") == 4000


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """Two workers, each a process that a nanny starts again."""
    distributed = pytest.importorskip("distributed", reason=WHY)
    dask = pytest.importorskip("dask", reason=WHY)
    dask.config.set({"distributed.scheduler.allowed-failures": 1})
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50, memory_limit=0
    ) as found:
        yield found.scheduler_address


@pytest.fixture
def workers(address: str) -> Iterator[cluster.Cluster]:
    with open_workers(address) as found:
        yield found


def test_a_cluster_gives_what_this_process_gives(workers: cluster.Cluster) -> None:
    jobs, shares, here = range(9), list[float](), Workers()
    waiting = workers.begun(third, 0.1, jobs, added)
    assert np.array_equal(
        workers.each(third, 0.1, jobs, shares.append), here.each(third, 0.1, jobs)
    )
    assert np.array_equal(waiting(), here.begun(third, 0.1, jobs, added)())
    assert shares == [k / 9 for k in range(1, 10)]
    with pytest.raises(DataError, match="log: job 2 cannot be done"):
        workers.each(refused, "log", range(4))
    with pytest.raises(DataError, match="log: job 2 cannot be done"):
        workers.begun(refused, "log", range(4), max)()


@pytest.mark.rotating("long tests of jobs")
def test_a_fit_is_the_local_one(workers: cluster.Cluster, place: Path) -> None:
    """To 1e-10 of the values, all logs at once, chunk after chunk; a worker is lost on the way."""
    model = compiled()
    given = sources(place, model)
    here = identify_long(stream(model, given, PROCESSING, rows=ROWS))
    plain, struck = by_workers(workers, emitted()), list[int]()

    def reducer(*each):  # type: ignore[no-untyped-def]
        begun = plain(*each)
        if not struck:  # the first log is on its way: one of the two workers ends
            struck.append(next(iter(workers._client.run(os.getpid).values())))
            os.kill(struck[0], signal.SIGKILL)
        return begun

    there = identify_long(stream(model, given, PROCESSING, rows=ROWS, reducer=reducer))
    np.testing.assert_allclose(there.beta, here.beta, rtol=1e-10)
    np.testing.assert_allclose(there.covariance, here.covariance, rtol=1e-9, atol=1e-18)
    assert struck and there.rows == here.rows and there.reading == here.reading
    assert there.processing == here.processing and there.sentences == here.sentences


def test_workers_must_see_the_same_file(workers: cluster.Cluster, place: Path, tmp_path) -> None:
    model = compiled()
    file = written(tmp_path / "a.parquet", logs(Scene(machines=1, periods=1), 2)[0][1])
    source = source_of(file, model.spec)
    assert source is not None
    chosen = survey(model, [source], PROCESSING, FactsSoFar(), ROWS).chosen[0]
    file.unlink()
    with pytest.raises(DataError, match="a worker sees none, expected a file of 1200 rows; work"):
        list(by_workers(workers, emitted())(model, source, chosen))


@pytest.mark.rotating("long tests of jobs")
def test_commands_on_a_cluster(address: str, place: Path, tmp_path: Path, capsys) -> None:
    """A fleet to the letter; a fit of many files; what needs all rows in one memory is refused."""
    words = ["fleet", "two-link", *(str(place / name) for name in ("r1", "r2"))]
    assert main(words) == 0
    here = capsys.readouterr().out
    assert main([*words, "--dask", address]) == 0
    assert capsys.readouterr().out == here
    given = [str(path) for path in sorted((place / "r1").iterdir())]
    fit = ["fit", "two-link", *given, "--out", str(tmp_path / "m.json"), "--dask", address]
    assert main(fit) == 0
    assert capsys.readouterr().err == ""
    text = tmp_path / "same.csv"
    pyarrow.csv.write_csv(pq.read_table(given[0]), text)
    assert main(["fit", "two-link", str(text), *fit[3:]]) == 0
    assert (
        "--dask: same.csv: read and reduced by this process; workers can begin in the middle"
        in (capsys.readouterr().err)
    )
    assert main([*fit, "--method", "iv"]) == 1
    told = f"--dask {address}: got --method iv, which needs all rows in one memory; expected --meth"
    assert told in capsys.readouterr().err


@pytest.mark.rotating("long tests of jobs")
def test_what_does_not_answer_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed", reason=WHY)
    monkeypatch.setattr(cluster, "_ANSWER", 0.3)
    for address in ("tcp://127.0.0.1:9", "nonsense://here"):
        with pytest.raises(DataError) as error, open_workers(address):
            pass
        assert str(error.value).startswith(f"--dask {address}: no scheduler answers there (")
    with distributed.LocalCluster(
        n_workers=0, processes=False, dashboard_address=":0", silence_logs=50
    ) as empty:
        address = empty.scheduler_address
        told = "the scheduler has no workers; start some, as `dask worker ADDRESS`"
        with pytest.raises(DataError, match=told), open_workers(address):
            pass


def test_workers_of_another_version_are_told(address: str, monkeypatch) -> None:
    monkeypatch.setattr(cluster, "__version__", "0.0")
    told = f"has modeler {__version__}; expected 0.0; install the same where the workers run"
    with pytest.raises(DataError, match=told), open_workers(address):
        pass


@pytest.mark.slow
def test_a_job_that_ends_all_its_workers_is_told(workers: cluster.Cluster) -> None:
    """Last of all: it costs the cluster its workers, which nannies start again."""
    with pytest.raises(DataError, match="Dask: a job ended 2 workers one after the other, as when"):
        workers.each(ends_always, "", [0])
