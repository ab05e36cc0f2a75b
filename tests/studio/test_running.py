"""Commands as children: their progress, their one line, their end; none outlives the studio."""

import asyncio
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from modeler.studio.processes import INTERRUPTED, Outcome, RunningCommand
from modeler.studio.thresholds import Thresholds
from tests.coroutines import run_coroutine
from tests.rotation import with_cases
from tests.studio.texts import URDF

pytestmark = pytest.mark.skipif(os.name != "posix", reason="NOT CHECKED: process groups are POSIX")

LONG = ("simulate", "demo-arm", "--duration", "3000", "--out")


def run(folder: Path, *words: str) -> tuple[Outcome, list[tuple[float | None, str]]]:
    """The end of a command, and all that was reported before."""

    async def waited() -> tuple[Outcome, list[tuple[float | None, str]]]:
        running = RunningCommand(words, folder, "the work")
        seen: list[tuple[float | None, str]] = []
        outcome = await running.wait(lambda: seen.append((running.share, running.doing)))
        assert await running.wait() == outcome
        return outcome, seen

    return run_coroutine(waited())


def alive(mark: str) -> list[str]:
    """Processes with that in their words."""
    listed = subprocess.run(["ps", "-ewwo", "pid,args"], capture_output=True, text=True, check=True)
    return [line for line in listed.stdout.splitlines() if mark in line]


def gone(mark: str, seconds: float = 10.0) -> bool:
    """Whether they end in time."""
    end = time.monotonic() + seconds
    while alive(mark):
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


@pytest.mark.rotating("long tests of studio")
def test_results_progress_and_seconds(tmp_path: Path) -> None:
    words = "simulate two-link --duration 2 --rate 500 --out a.csv"
    outcome, seen = run(tmp_path, *words.split())
    assert outcome.status == 0 and outcome.error == "" and (tmp_path / "a.csv").exists()
    assert outcome.lines[0].startswith("two-link: 1000 samples")
    assert {"loading", "simulating two-link", "done"} <= {doing for _, doing in seen}
    shares = [share for share, _ in seen if share is not None]
    assert shares == sorted(shares) and 0 < outcome.seconds < 60


@with_cases(
    "words, status, text",
    (("derive", "no-such-robot"), 1, '"no-such-robot" is neither'),
    (("derive", "wrist", "--no-such-option"), 2, "unknown option --no-such-option"),
    (("dance",), 2, "unknown command dance"),
    (("derive", "a\0b"), 1, "the work: cannot be started (embedded null byte)"),
)
def test_an_error_is_the_line_that_the_command_prints(tmp_path, words, status, text) -> None:
    outcome, _ = run(tmp_path, *words)
    assert outcome.status == status and outcome.error.startswith(text)
    assert "\n" not in outcome.error and not outcome.error.startswith("modeler:")


def test_notes_are_no_errors(tmp_path: Path) -> None:
    (tmp_path / "arm.urdf").write_text(URDF)
    outcome, _ = run(tmp_path, "robots", "arm.urdf")  # which shows on stderr what it assumed
    assert outcome.status == 0 and outcome.error == ""
    assert any("[mdh]" in line for line in outcome.lines)


@pytest.fixture
def sabotage(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Lines of Python that every process begins with; a body is that of `modeler robots`."""

    def spoil(lines: str = "", body: str = "") -> None:
        if body:
            lines += "import modeler.cli.lists as l, sys\ndef run(args):\n"
            lines += "".join(f"    {line}\n" for line in body.splitlines()) + "l.run_robots = run\n"
        (tmp_path / "sitecustomize.py").write_text(lines)
        path = f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"
        monkeypatch.setenv("PYTHONPATH", path)

    return spoil


def test_a_fault_of_the_program_says_how_to_report_it(tmp_path: Path, sabotage) -> None:
    sabotage(body="raise ZeroDivisionError('by zero')")
    outcome, _ = run(tmp_path, "robots")
    assert "(ZeroDivisionError: by zero); run `modeler robots --verbose`" in outcome.error


def test_endless_lines_are_no_trouble(tmp_path: Path, sabotage) -> None:
    sabotage(
        body="print('x' * 3_000_000); print('modeler: ' + 'y' * 300_000, file=sys.stderr)\n"
        "print('\\udc80z' * 30_000); return []"
    )
    outcome, _ = run(tmp_path, "robots")
    assert outcome.status == 0 and len(outcome.lines[0]) == 3_000_000


@pytest.mark.parametrize("inputs", ["", pytest.param(os.pathsep, marks=pytest.mark.rotating)])
def test_files_of_the_project_are_no_modules(tmp_path: Path, monkeypatch, inputs) -> None:
    monkeypatch.setenv("PYTHONPATH", inputs)
    for name in ("numpy", "json", "argparse", "modeler"):
        (tmp_path / f"{name}.py").write_text("open('was-run', 'w')\n")
    assert run(tmp_path, "robots", "two-link")[0].status == 0
    assert not (tmp_path / "was-run").exists()


@pytest.mark.rotating("long tests of studio")
@with_cases(
    "groups",
    pytest.param(True, id="groups"),
    pytest.param(False, id="as on Windows", marks=pytest.mark.rotating),
)
def test_cancel_ends_all_and_leaves_nothing(tmp_path: Path, monkeypatch, sabotage, groups) -> None:
    """Where there are no groups of processes, the command ends itself when its pipe ends."""
    work = tmp_path / "work"
    work.mkdir()
    if not groups:
        sabotage("import os\ndel os.killpg\n")
        monkeypatch.delattr(os, "killpg")

    async def cancelled() -> Outcome:
        running = RunningCommand((*LONG, str(work / "cancelled.csv")), work, "simulate")
        while "simulating" not in running.doing:
            assert running.doing != "done"
            await asyncio.sleep(0.02)
        assert alive(running.words[-1])
        running.cancel()
        running.cancel()
        return await running.wait()

    begin = time.monotonic()
    outcome = run_coroutine(cancelled())
    assert outcome.status == INTERRUPTED and outcome.error == "simulate: cancelled"
    assert outcome.is_cancelled and time.monotonic() - begin < 20
    assert gone(str(work), 1.0) and not list(work.iterdir())


def test_cancel_before_it_is_started(tmp_path: Path) -> None:
    async def cancelled() -> Outcome:
        running = RunningCommand((*LONG, str(tmp_path / "early.csv")), tmp_path, "simulate")
        running.cancel()
        return await running.wait()

    assert run_coroutine(cancelled()).status == INTERRUPTED
    assert gone(str(tmp_path), 1.0) and not list(tmp_path.iterdir())


def test_what_does_not_heed_an_interrupt_is_killed(tmp_path: Path, monkeypatch, sabotage) -> None:
    """With the processes that it started."""
    sabotage(
        body="import signal, subprocess, time\n"
        "signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
        "code = 'import signal, time; signal.signal(2, 1); time.sleep(60)'\n"
        f"subprocess.Popen([sys.executable, '-S', '-c', code, {str(tmp_path / 'below')!r}])\n"
        "print('deaf', flush=True)\n"
        "time.sleep(60)"
    )
    monkeypatch.setattr("modeler.studio.processes.THRESHOLDS", Thresholds(interrupt_patience=0.3))

    async def cancelled() -> Outcome:
        running = RunningCommand(("robots",), tmp_path, "robots")
        while not running.lines:
            await asyncio.sleep(0.02)
        assert alive(str(tmp_path / "below"))
        running.cancel()
        return await running.wait()

    assert run_coroutine(cancelled()).is_cancelled and gone(str(tmp_path / "below"))


SERVER = """
import asyncio, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # tests may run where it is ignored
from pathlib import Path
from modeler.studio.processes import RunningCommand
async def main():
    folder = Path(sys.argv[1])
    running = RunningCommand(sys.argv[2:], folder, "simulate")
    while "simulating" not in running.doing:
        await asyncio.sleep(0.02)
    print("running", flush=True)
    await running.wait()
asyncio.run(main())
"""


@pytest.mark.parametrize(
    "number", [signal.SIGKILL, *(pytest.param(n, marks=pytest.mark.slow) for n in (2, 15))]
)
def test_a_command_does_not_outlive_the_studio(tmp_path: Path, number: int) -> None:
    words = [sys.executable, "-c", SERVER, str(tmp_path), *LONG, str(tmp_path / "orphan.csv")]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    server = subprocess.Popen(words, **streams, start_new_session=True)
    assert server.stdout is not None and server.stdout.readline() == b"running\n"
    assert len(alive(str(tmp_path))) > 1  # it, and the command
    server.send_signal(number)
    server.wait(20)
    server.stdout.close()
    assert gone(str(tmp_path)), alive(str(tmp_path))
    assert not list(tmp_path.iterdir())
