"""Dropped files: there as a whole or not at all, whatever their names, sizes and ends."""

import json
import os
import random
import signal
import socket
import threading
from collections.abc import AsyncIterator, Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
from hypothesis import given, settings, strategies as st

from modeler.core.errors import ModelerError
from tests.coroutines import run_coroutine
from tests.rotation import with_cases
from tests.studio.hubs import full_disk
from tests.studio.requests import Answer, ask, let_in, port_of
from tests.studio.window import Served, served


@pytest.fixture(scope="module")
def dropped() -> Any:
    """The module, which imports NiceGUI."""
    from modeler.studio import file_inputs

    return file_inputs


def drop(studio: Served, cookie: str, name: str, data: bytes, kind: str = "logs") -> Answer:
    return ask(studio, f"/drop/{kind}", "POST", data, x_name=quote(name), cookie=cookie)


def begun(studio: Served, cookie: str) -> bytes:
    """A file of which a part comes."""
    return (
        f"POST /drop/logs HTTP/1.1\r\nHost: 127.0.0.1:{port_of(studio)}\r\nCookie: {cookie}\r\n"
        "X-Name: half.csv\r\nContent-Length: 90000000\r\n\r\n"
    ).encode() + b"x" * 3_000_000


def there(studio: Served) -> set[str]:
    return {path.name for path in (studio.folder / "logs").iterdir()}


def peak(studio: Served) -> int:
    """Bytes of memory that the server has had at most."""
    text = Path(f"/proc/{studio.process.pid}/status").read_text()
    return 1024 * int(text.partition("VmHWM:")[2].split()[0])


# Names.


@settings(max_examples=30)
@given(st.text(max_size=150), st.sampled_from([".csv", ".parquet", ".mcap", ".CSV"]))
def test_any_name_becomes_a_harmless_one(dropped: Any, name: str, ending: str) -> None:
    result = dropped.safe_name(name + ending)
    assert result == dropped.safe_name(result) and result.endswith(ending)
    assert len(result.encode()) <= 125 and result[0] not in ".- @"
    assert not set(result) & set("/\\<>&\"'`$|;:*?{}#!%\n\r\t\0") and result.isprintable()


@with_cases(
    "name, stored",
    ("run 1.csv", "run 1.csv"),
    ("../../etc/x.csv", "x.csv"),
    ("C:\\logs\\a.mat", "a.mat"),
    (".hidden.csv", "hidden.csv"),
    ("--out=x.csv", "out=x.csv"),
    (".csv", "log.csv"),
    ("<img src=x onerror=alert(1)>.csv", "_img src=x onerror=alert(1)_.csv"),
    ("Zu\u0308rich.csv", "Z\u00fcrich.csv"),
    ("x" * 400 + ".parquet", "x" * 112 + ".parquet"),
)
def test_names_that_mean_something_lose_it(dropped: Any, name: str, stored: str) -> None:
    assert dropped.safe_name(name) == stored


def test_thirty_at_once_all_of_one_name(studio: Served, cookie: str) -> None:
    rng = random.Random()
    contents = {rng.randbytes(rng.randrange(200_000)) + b"%d" % i for i in range(30)}
    with ThreadPoolExecutor(30) as pool:
        answers = list(pool.map(lambda data: drop(studio, cookie, "same.csv", data), contents))
    assert all(answer.status == 200 for answer in answers), answers
    rest = list((studio.folder / "logs").glob("same*.csv"))
    assert len(rest) == 30 and {path.read_bytes() for path in rest} == contents
    lines = {json.loads(answer.body)["file"] for answer in answers}
    assert lines == {f"logs/{path.name}" for path in rest}


def test_none_is_written_over_another(studio: Served, cookie: str) -> None:
    for _ in range(2):
        for name in ("a.csv", 'a"b.CSV', "\u00fc.csv"):
            assert drop(studio, cookie, name, name.encode()).status == 200
    assert {"a.csv", "a-2.csv", "a_b.CSV", "a_b-2.CSV", "\u00fc-2.csv"} <= there(studio)
    assert (studio.folder / "logs/\u00fc-2.csv").read_bytes() == "\u00fc.csv".encode()


@with_cases(
    "kind, name, text",
    ("logs", "x.exe", "x.exe: cannot be taken; expected .csv, "),
    ("logs", "numpy.py", "numpy.py: cannot be taken"),
    ("logs", "", "cannot be taken"),
    ("originals", "a.csv", "expected .toml, .par, .urdf"),
    ("models", "a.json", "got models; expected one of logs, originals"),
)
def test_what_cannot_be_taken_is_one_line(studio, cookie, kind, name, text) -> None:
    answer = drop(studio, cookie, name, b"x", kind)
    assert answer.status == 400 and text in answer.text and answer.text.count("error") == 1
    assert not list(studio.folder.rglob("*numpy*")) and not list(studio.folder.rglob("*.exe"))


def test_a_connection_that_ends_leaves_nothing(studio: Served, cookie: str) -> None:
    before = there(studio)
    with socket.create_connection(("127.0.0.1", port_of(studio))) as line:
        line.sendall(begun(studio, cookie))
        wait_until(lambda: there(studio) > before)
    wait_until(lambda: there(studio) == before)


def wait_until(holds) -> None:
    end = threading.Event()
    for _ in range(200):
        if holds():
            return
        end.wait(0.05)
    raise AssertionError("it did not come to that")


@pytest.mark.parametrize("size", [300, pytest.param(2_000, marks=pytest.mark.slow)])
def test_a_large_log_is_never_in_memory(studio: Served, cookie: str, size: int) -> None:
    """Megabytes, not known before: in pieces."""
    before = peak(studio)
    block = bytes(range(256)) * 4096
    cells = {"content_length": str(size * len(block)), "x_name": "large.mcap", "cookie": cookie}
    body = (block for _ in range(size))
    answer = ask(studio, "/drop/logs", "POST", body, **cells)
    assert answer.status == 200, answer.text
    (stored,) = (studio.folder / "logs").glob("large*")
    try:
        assert stored.stat().st_size == size * 2**20
        with stored.open("rb") as file:
            file.seek(-(2**20), os.SEEK_END)
            assert file.read() == block
    finally:
        stored.unlink()
    assert peak(studio) - before < 40 * 2**20


@pytest.mark.rotating("long tests of studio")
def test_a_studio_that_only_reads_takes_nothing(studio: Served) -> None:
    with served(studio.folder) as second:
        answer = drop(second, let_in(second), "second.csv", b"1")
        assert answer.status == 400 and "this studio only reads" in answer.text
    assert "second.csv" not in there(studio)


@pytest.mark.rotating("long tests of studio")
def test_killed_while_receiving_is_swept_away_by_the_next(tmp_path: Path) -> None:
    with (
        served(tmp_path / "p") as one,
        socket.create_connection(("127.0.0.1", port_of(one))) as line,
    ):
        line.sendall(begun(one, let_in(one)))
        wait_until(lambda: (one.folder / "logs").exists() and there(one))
        one.end(signal.SIGKILL)
    with served(tmp_path / "p") as two:
        assert there(two) == set() and drop(two, let_in(two), "a.csv", b"1").status == 200


# A full disk.


@pytest.fixture
def receive(dropped: Any, tmp_path: Path) -> Callable[..., str]:
    """Takes a log of which so many bytes come, and possibly more are said to come."""

    async def stream(data: bytes) -> AsyncIterator[bytes]:
        for start in range(0, len(data), 65_536):
            yield data[start : start + 65_536]

    return lambda data, size=None: run_coroutine(
        dropped.receive_file(tmp_path, "logs", "large.csv", size, stream(data))
    )


def test_a_full_disk_is_one_line_and_leaves_nothing(receive, tmp_path: Path) -> None:
    refused = pytest.raises(ModelerError, match=r"large.csv: cannot be kept in .*logs \(.*\); make")
    with full_disk(8 * 2**20), refused:
        receive(b"x" * 9 * 2**20)
    assert not list((tmp_path / "logs").iterdir())
    with pytest.raises(ModelerError, match=r"1e\+03 TB to come|1000 TB to come"):
        receive(b"x", 10**15)  # refused before it comes
    assert not list((tmp_path / "logs").iterdir())
    assert receive(b"1") == "logs/large.csv"
