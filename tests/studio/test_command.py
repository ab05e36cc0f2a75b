"""`modeler studio`: what it prints, writes and refuses, and how it ends."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from modeler.cli import main
from tests.json_schemas import check_schema
from tests.rotation import with_cases
from tests.studio.requests import ask, let_in, port_of, websocket_request
from tests.studio.test_dropped import wait_until
from tests.studio.window import Served

WORDS = [sys.executable, "-m", "modeler", "studio", "--no-open"]


@pytest.mark.rotating("ways to start a studio")
@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="finds the processes in /proc")
def test_json_alone_on_stdout_and_ctrl_c_of_a_terminal_goes_to_all(tmp_path: Path) -> None:
    """While a browser is connected; the process that draws logs says nothing of it."""
    with subprocess.Popen(
        [*WORDS, str(tmp_path), "--json", "-"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        assert process.stdout is not None and process.stderr is not None
        raw = json.loads("".join(iter(process.stdout.readline, "}\n")) + "}")
        studio = Served(tmp_path, raw["address"], process)
        cookie, host = let_in(studio), f"127.0.0.1:{port_of(studio)}"
        assert (ask(studio).status, ask(studio, cookie=cookie).status) == (403, 200)
        begun, end = False, time.monotonic() + 20
        while not begun and time.monotonic() < end:
            lists = Path(f"/proc/{process.pid}/task").glob("*/children")
            children = [name for text in lists for name in text.read_text().split()]
            words = (Path(f"/proc/{name}/cmdline").read_bytes() for name in children)
            begun = any(b"spawn_main" in one for one in words)
            time.sleep(0.3)
        assert begun
        with socket.create_connection(("127.0.0.1", port_of(studio))) as line:
            line.sendall(websocket_request({"Host": host, "Cookie": cookie}))
            assert line.recv(12) == b"HTTP/1.1 101"
            os.killpg(process.pid, signal.SIGINT)
            assert process.wait(10) == 130
        assert process.stdout.read() == "" and process.stderr.read() == "modeler: interrupted\n"


@with_cases(
    "words, expected",
    (("--port", "99999"), "--port: got 99999; expected 1 to 65535, 0 for a free one"),
    (("--allow", "{}/none"), "no such folder; expected one that holds logs"),
    (("{}/file",), "cannot be used as a project folder"),
    (("{}/file/below",), "cannot be used as a project folder"),
    (("{}/p", "--port", "{port}"), "cannot be opened (Address already in use); choose another"),
    (("{}",), "project.toml: is not valid UTF-8 (byte 12); put the file back"),
)
def test_what_it_cannot_do_is_one_line(tmp_path, capsys, words, expected) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "project.toml").write_bytes(b'without = "\xe9"')
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        assert main(["studio", "--no-open", *(w.format(tmp_path, port=port) for w in words)]) == 1
    err = capsys.readouterr().err
    assert expected in err and err.count("\n") == 1


@pytest.mark.parametrize("package", ["nicegui", "fastapi"])
def test_where_it_is_not_installed_it_says_what_to_install(tmp_path: Path, package: str) -> None:
    lines = f"import sys\nsys.modules[{package!r}] = None\nfrom modeler.cli import main\n"
    code = f"{lines}sys.exit(main(['studio', {str(tmp_path)!r}, '--no-open']))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and done.stderr.count("\n") == 1
    assert f"needs the package {package}, which is not installed" in done.stderr
    assert 'run: pip install "modeler-robotics[studio]"' in done.stderr


@pytest.mark.rotating("ways to start a studio")
def test_the_browser_gets_an_address_that_is_good_once(tmp_path: Path, monkeypatch) -> None:
    """What a browser is started with stands in the list of processes; what is printed does not."""
    opener, place, folder = (tmp_path / name for name in ("opener", "address.json", "p"))
    opener.write_text(
        f'#!/bin/sh\necho "$1" > {tmp_path}/opened.part\n'
        f"mv {tmp_path}/opened.part {tmp_path}/opened\n"
    )
    opener.chmod(0o755)
    environment = os.environ | {"BROWSER": f"{opener} %s"}
    environment.pop("SSH_CONNECTION", None)
    words = [word for word in WORDS if word != "--no-open"]
    with subprocess.Popen(
        [*words, str(folder), "--json", str(place)],
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
    ) as process:
        assert process.stdout is not None
        first, second = process.stdout.readline(), process.stdout.readline()
        raw = json.loads(place.read_text())
        check_schema("studio", raw)
        assert (raw["folder"], raw["pid"]) == (str(folder), process.pid)
        assert place.stat().st_mode & 0o077 == 0  # who has the token is let in
        port = first.partition("127.0.0.1:")[2].partition("/")[0]
        assert raw["address"].startswith(f"http://127.0.0.1:{port}/?token=")
        assert f"studio of {folder}: {raw['address']}\n" in first
        assert f"ssh -L {port}:127.0.0.1:{port} HOST" in second
        wait_until((tmp_path / "opened").exists)
        studio = Served(tmp_path, (tmp_path / "opened").read_text().strip(), process)
        path = studio.address.removeprefix(studio.root)
        assert studio.address != raw["address"]
        assert [ask(studio, path).status for _ in range(2)] == [303, 403]
        assert studio.end() == 130
