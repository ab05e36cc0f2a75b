"""Dropped files: there as a whole or not at all, whatever their names, sizes and ends."""

import asyncio
import errno
import json
import os
import random
import resource
import signal
import socket
import threading
from collections.abc import AsyncIterator, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from modeler.core.errors import ModelerError
from modeler.studio import dropped
from modeler.studio.dropped import KINDS, receive, safe_name
from tests.studio.requests import FORM, Answer, ask, form, let_in, port_of
from tests.studio.window import Served, served


@pytest.fixture(scope="module")
def studio(tmp_path_factory) -> Iterator[Served]:
    with served(tmp_path_factory.mktemp("dropped") / "project") as one:
        yield one


@pytest.fixture(scope="module")
def cookie(studio: Served) -> str:
    return let_in(studio)


def drop(studio: Served, cookie: str, files: dict[str, bytes], kind: str = "logs") -> Answer:
    data = form(files)
    return ask(studio, f"/drop/{kind}", "POST", data, content_type=FORM, cookie=cookie)


def there(studio: Served) -> set[str]:
    return {path.name for path in (studio.folder / "logs").iterdir()}


def peak(studio: Served) -> int:
    """Bytes of memory that the server has had at most."""
    text = Path(f"/proc/{studio.process.pid}/status").read_text()
    return 1024 * int(text.partition("VmHWM:")[2].split()[0])


# Names.


@given(st.text(max_size=300), st.sampled_from([*KINDS["logs"], ".CSV"]))
def test_any_name_becomes_a_harmless_one(name: str, ending: str) -> None:
    found = safe_name(name + ending)
    assert found == safe_name(found) and found.endswith(ending)
    assert len(found.encode()) <= 125 and found[0] not in ".- @"
    assert not set(found) & set("/\\<>&\"'`$|;:*?{}#!%\n\r\t\0") and found.isprintable()


@pytest.mark.parametrize(
    ("name", "kept"),
    [
        ("run 1.csv", "run 1.csv"), ("../../etc/x.csv", "x.csv"), ("C:\\logs\\a.mat", "a.mat"),
        (".hidden.csv", "hidden.csv"), ("--out=x.csv", "out=x.csv"), (".csv", "log.csv"),
        ("<img src=x onerror=alert(1)>.csv", "_img src=x onerror=alert(1)_.csv"),
        ("Zu\u0308rich.csv", "Z\u00fcrich.csv"), ("x" * 400 + ".parquet", "x" * 112 + ".parquet"),
    ],
)  # fmt: skip
def test_names_that_mean_something_lose_it(name: str, kept: str) -> None:
    assert safe_name(name) == kept


def test_thirty_at_once_all_of_one_name(studio: Served, cookie: str) -> None:
    rng = random.Random()
    contents = {rng.randbytes(rng.randrange(200_000)) + b"%d" % i for i in range(30)}
    with ThreadPoolExecutor(30) as pool:
        answers = list(pool.map(lambda data: drop(studio, cookie, {"same.csv": data}), contents))
    assert all(answer.status == 200 for answer in answers), answers
    kept = list((studio.folder / "logs").glob("same*.csv"))
    assert len(kept) == 30 and {path.read_bytes() for path in kept} == contents
    assert {f"logs/{path.name}" for path in kept} == {
        file for answer in answers for file in json.loads(answer.body)["files"]
    }


def test_several_in_one_form_and_none_over_another(studio: Served, cookie: str) -> None:
    for _ in range(2):
        files = {"a.csv": b"t\n1\n", "a%22b.CSV": b"", "b.parquet": bytes(range(256)) * 9}
        assert drop(studio, cookie, files).status == 200
    assert {"a.csv", "a-2.csv", "a_b.CSV", "a_b-2.CSV", "b.parquet", "b-2.parquet"} <= there(studio)
    assert (studio.folder / "logs/b-2.parquet").read_bytes() == bytes(range(256)) * 9


@pytest.mark.parametrize(
    ("path", "kind", "data", "told"),
    [
        ("logs", FORM, form({"x.exe": b"MZ"}), "x.exe: cannot be taken; expected .csv, "),
        ("logs", FORM, form({"a2.csv": b"1", "numpy.py": b"x"}), "numpy.py: cannot be taken"),
        ("originals", FORM, form({"a.csv": b"x"}), "expected .toml, .par, .urdf"),
        ("models", FORM, form({"a.json": b"x"}), "got models; expected one of logs, originals"),
        ("logs", FORM, form({"cut.csv": b"x"})[:-9], "ended before its end; drop the file again"),
        ("logs", FORM, b"no form at all", "got a broken form"),
        ("logs", "text/plain", b"x", "got no form with files"),
        ("logs", "multipart/form-data", b"x", "got no form with files"),
    ],
)
def test_what_cannot_be_taken_is_one_line(studio, cookie, path, kind, data, told) -> None:
    before = there(studio) if (studio.folder / "logs").exists() else set()
    answer = ask(studio, f"/drop/{path}", "POST", data, content_type=kind, cookie=cookie)
    assert answer.status == 400 and told in answer.text and answer.text.count("error") == 1
    assert (there(studio) if (studio.folder / "logs").exists() else set()) == before


def test_a_connection_that_ends_leaves_nothing(studio: Served, cookie: str) -> None:
    head = (
        f"POST /drop/logs HTTP/1.1\r\nHost: 127.0.0.1:{port_of(studio)}\r\nCookie: {cookie}\r\n"
        f"Content-Type: {FORM}\r\nContent-Length: 90000000\r\n\r\n"
    )
    before = there(studio)
    with socket.create_connection(("127.0.0.1", port_of(studio))) as line:
        line.sendall(head.encode() + form({"half.csv": b"x" * 3_000_000})[:-20])
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
    whole = form({"large.mcap": b"@"})
    head, _, end = whole.partition(b"@")
    length = str(len(head) + len(end) + size * len(block))
    body = (head, *(block for _ in range(size)), end)
    answer = ask(
        studio, "/drop/logs", "POST", body, content_type=FORM, content_length=length, cookie=cookie
    )
    assert answer.status == 200, answer.text
    (kept,) = (studio.folder / "logs").glob("large*")
    try:
        assert kept.stat().st_size == size * 2**20
        with kept.open("rb") as file:
            file.seek(-(2**20), os.SEEK_END)
            assert file.read() == block
    finally:
        kept.unlink()
    assert peak(studio) - before < 40 * 2**20


def test_a_studio_that_only_reads_takes_nothing(studio: Served) -> None:
    with served(studio.folder) as second:
        answer = drop(second, let_in(second), {"second.csv": b"1"})
        assert answer.status == 400 and "this studio only reads" in answer.text
    assert "second.csv" not in there(studio)


def test_killed_while_receiving_is_swept_away_by_the_next(tmp_path: Path) -> None:
    with served(tmp_path / "p") as one:
        head = (
            f"POST /drop/logs HTTP/1.1\r\nHost: 127.0.0.1:{port_of(one)}\r\n"
            f"Cookie: {let_in(one)}\r\nContent-Type: {FORM}\r\nContent-Length: 90000000\r\n\r\n"
        )
        with socket.create_connection(("127.0.0.1", port_of(one))) as line:
            line.sendall(head.encode() + form({"half.csv": b"x" * 3_000_000})[:-20])
            wait_until(lambda: (one.folder / "logs").exists() and there(one))
            one.end(signal.SIGKILL)
    with served(tmp_path / "p") as two:
        assert there(two) == set() and drop(two, let_in(two), {"a.csv": b"1"}).status == 200


# A full disk.


async def stream(data: bytes) -> AsyncIterator[bytes]:
    for start in range(0, len(data), 65_536):
        yield data[start : start + 65_536]


def received(folder: Path, files: dict[str, bytes], size: int | None = None) -> list[str]:
    return asyncio.run(receive(folder, "logs", FORM, size, stream(form(files))))


def test_a_full_disk_is_one_line_and_leaves_nothing(tmp_path: Path, monkeypatch) -> None:
    """The limit of a file's size stands for it: it needs no rights, and fails in the same place."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (8 * 2**20, before[1]))
    try:
        with pytest.raises(ModelerError, match=r"cannot be kept in .*logs \(.*\); make room"):
            received(tmp_path, {"small.csv": b"1", "large.csv": b"x" * 9 * 2**20})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert not list((tmp_path / "logs").iterdir())
    assert received(tmp_path, {"small.csv": b"1"}) == ["logs/small.csv"]


def test_a_disk_that_is_full_in_the_middle(tmp_path: Path, monkeypatch) -> None:
    def full(self, data: bytes) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(dropped._Drop, "write", full)
    with pytest.raises(ModelerError, match="No space left on device"):
        received(tmp_path, {"large.csv": b"x"})
    assert not list((tmp_path / "logs").iterdir())


def test_what_cannot_fit_is_refused_before_it_comes(tmp_path: Path) -> None:
    with pytest.raises(ModelerError, match=r"1e\+03 TB to come|1000 TB to come"):
        received(tmp_path, {"large.csv": b"x"}, 10**15)
    assert not list((tmp_path / "logs").iterdir())
