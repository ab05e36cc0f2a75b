"""Runs a row and says what is wrong with how it ended: nothing, if all is as it must be."""

import contextlib
import io
import itertools
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import traceback
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import pyarrow.parquet as pq

from modeler.cli import main
from modeler.core.errors import ModelerError
from tests.bad_input.row import Process, Result, Row, missing_words
from tests.bad_input.workdir import Workdir
from tests.repository import ROOT

SECONDS = 20.0
"""In which every command must answer."""

LONGEST = 1200
"""Characters of a line that a person still reads; the longest lists every effect."""

AS_IT_IS = "as it is"
"""Value of a variable that a row leaves as the tests have it."""

OUTPUTS = "--out --json --report --picture --coefficients-out --robot-out --truth-out".split()

REMEDY = re.compile(
    r"\b(expected|write|use|choose|give|leave|check|add|remove|declare|did you mean|delete|record"
    r"|install|set|move|save|keep|close|make|state|sample|split|rename|take|lower|raise|put|fit"
    r"|needs?|pass|name (it|one)|number|correct|mend|free|try|log|drop|must|there are|takes?|again"
    r"|end it|lists|built-in are|already|go from)\b"
)
"""A word that says what to do."""


class TooLong(BaseException):
    """A command took longer than it may; no `except Exception` catches it."""


def faults(row: Row, workdir: Workdir) -> list[str]:
    """What is wrong with how a row ends."""
    if row.make is not None:
        row.make(workdir)
    if isinstance(row.run, tuple):
        workdir.take_named(row.run)
    before = workdir.state()
    result = _run(row, workdir)
    after = workdir.state()
    actual = [result.broke] if result.broke else []
    if not actual:
        actual += ending(row, result)
    actual += disturbed(row, result, before, after)
    if not actual and row.check is not None and result.status == 0:
        try:
            row.check(result)
        except AssertionError as error:
            actual.append(f"silently wrong: {error}")
    return actual


def _run(row: Row, workdir: Workdir) -> Result:
    if row.process is not None:
        assert isinstance(row.run, tuple)
        return _in_a_process(row.run, row.process, workdir)
    with inside(workdir), within(SECONDS):
        return run_here(row.run, workdir)


def run_here(run: tuple[str, ...] | Callable[[Workdir], object], workdir: Workdir) -> Result:
    """Run a command, or a call, in this process."""
    out, err = io.StringIO(), io.StringIO()
    status, broke = -1, ""
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            if isinstance(run, tuple):
                status = main(list(run))
            else:
                run(workdir)
                status = 0
        except ModelerError as error:
            status = 1
            print(f"modeler: {error}", file=sys.stderr)
        except SystemExit as stop:
            status = stop.code if isinstance(stop.code, int) else -1
        except TooLong:
            broke = f"hang: no answer within {SECONDS:g} s"
        except BaseException as error:
            broke = _traceback(error)
    return Result(status, out.getvalue(), err.getvalue(), broke, workdir)


def _traceback(error: BaseException) -> str:
    frames = traceback.extract_tb(error.__traceback__)
    place = next((f for f in reversed(frames) if "modeler" in f.filename), frames[-1])
    said = str(error).splitlines()
    where = f"{Path(place.filename).name}:{place.lineno}"
    return f"traceback: {type(error).__name__} in {where}: {said[0][:150] if said else ''}"


@contextlib.contextmanager
def inside(workdir: Workdir) -> Iterator[None]:
    """The workdir as the current folder, the temporary one, and home; warnings are errors."""
    here, stored = Path.cwd(), tempfile.tempdir
    home = os.environ.get("HOME")
    os.chdir(workdir.work)
    tempfile.tempdir = str(workdir.temporary)
    os.environ["HOME"] = str(workdir.home)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            yield
    finally:
        os.chdir(here)
        tempfile.tempdir = stored
        if home is not None:
            os.environ["HOME"] = home


@contextlib.contextmanager
def within(seconds: float) -> Iterator[None]:
    """`TooLong` in this thread after so many seconds."""

    def stop(*_: object) -> None:
        raise TooLong

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def _in_a_process(words: tuple[str, ...], how: Process, workdir: Workdir) -> Result:
    env = {**os.environ, "HOME": str(workdir.home), "TMPDIR": str(workdir.temporary)}
    env["MPLCONFIGDIR"] = str(workdir.inputs.folder / "matplotlib")  # a list of fonts takes seconds
    for name, value in how.env.items():
        if value is None:
            env.pop(name, None)
        elif value != AS_IT_IS:
            env[name] = value.replace("WORKDIR", str(workdir.work))
    if how.anew:
        env["PYTHONPATH"] = str(ROOT)
        done = subprocess.run(
            [sys.executable, "-m", "modeler", *words],
            cwd=workdir.work,
            env=env,
            check=False,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=how.seconds,
        )
    else:
        done = workdir.inputs.forks.run(words, workdir.work, env, how.seconds, how.file_limit)
    broke = ""
    if done.returncode == -signal.SIGALRM:
        broke = f"hang: no answer within {how.seconds:g} s"
    if "Traceback" in done.stderr or "Exception ignored" in done.stderr:
        broke = f"traceback: {done.stderr.strip().splitlines()[-1][:200]}"
    return Result(done.returncode, done.stdout, done.stderr, broke, workdir)


def ending(row: Row, result: Result) -> list[str]:
    """Exit status, and what was said."""
    values = []
    if row.outcome == "refused" or (row.outcome == "ends" and result.status != 0):
        if result.status not in (1, 2):
            return [f"silent: exit status {result.status}; expected 1 or 2 and a line"]
        values += clear(row.run if isinstance(row.run, tuple) else (), result)
        values += _lacking(row.words, result.err)
    else:
        if result.status != 0:
            said = result.err.strip() or result.out.strip()
            return [f"exit status {result.status}; expected 0: {said[-300:]}"]
        if row.outcome in ("works", "ends") and result.err:
            values.append(f"works, but complains: {result.err.strip()[:300]}")
        values += _lacking(row.words, result.out + result.err)
    return values


def _lacking(words: tuple[str, ...], text: str) -> list[str]:
    missing = missing_words(words, text)
    return [f"does not say {', '.join(map(repr, missing))}: {text.strip()[-400:]}"] * bool(missing)


def clear(words: tuple[str, ...], result: Result) -> list[str]:
    """Why the complaint of a command is not one clear line; nothing, if it is."""
    lines = result.err.splitlines()
    if len(lines) != 1 or not result.err.endswith("\n"):
        return [f"unclear: {len(lines)} lines on stderr; expected one: {result.err[:300]!r}"]
    line, values = lines[0], []
    if not line.startswith("modeler"):
        values.append(f"unclear: does not say who speaks: {line[:200]}")
    if len(line) > LONGEST:
        values.append(f"unclear: {len(line)} characters: {line[:200]} ...")
    if words and not _names_a_place(words, line):
        values.append(f"unclear: names no file, option or argument: {line[:300]}")
    if not REMEDY.search(line.lower()):
        values.append(f"unclear: says not what to do: {line[:300]}")
    return values


def _names_a_place(words: tuple[str, ...], line: str) -> bool:
    """Whether the line names a word of the command, or the tool that is at fault."""
    names = {_shown(Path(word.partition("@")[0]).name)[:40] for word in words[1:]} | set(words)
    names |= {".:", 'got ""'} if {".", ""} & set(words) else set()
    names |= {name.removesuffix(".toml") for name in names}
    names |= {"compiler", "MODELER_CACHE", "stdout", "argument", "unknown command", "required: "}
    options = [word for word in words if word.startswith("--")]
    names |= {option.strip("-").replace("-", "_") for option in options}
    names |= {name.partition("=")[0] for name in names}
    names |= {"decimation"} if "--decimate" in names else set()
    commands = {word for word in words[:1] if not word.startswith("--")}
    return any(name and name in line for name in names - commands - {".", "-"})


def _shown(name: str) -> str:
    """A name of a file as a line can show it."""
    return "".join(c if c.isprintable() else " " if c == "\n" else "?" for c in name)


def disturbed(row, result, before, after):
    """Inputs that were changed, things left behind, outputs that are not whole."""
    outputs = _outputs(row, result.status == 0)

    def may(name: str) -> bool:
        return any(name == out or name.startswith(f"{out}/") for out in outputs) or any(
            out.startswith(f"{name}/") for out in outputs
        )

    values = [
        f"destructive: {name} was {'changed' if name in after else 'removed'}"
        for name in before
        if after.get(name) != before[name] and not may(name)
    ]
    new = [name for name in after if name not in before]
    values += [f"left behind: {name}" for name in new if not may(name)][:3]
    for name in new:
        if may(name):
            values += _broken(result.workdir.folder / name)
    return values


def _outputs(row: Row, done: bool) -> set[str]:
    """What a command may write: only what stands beside it, if it was refused."""
    words = row.run if isinstance(row.run, tuple) and done else ()
    named = [b for a, b in itertools.pairwise(words) if a in OUTPUTS]
    pairs = [word.partition("=") for word in words]
    named += [value for option, equals, value in pairs if equals and option in OUTPUTS]
    return {os.path.normpath(f"work/{name}") for name in (*named, *row.beside)}


def _broken(path: Path) -> list[str]:
    """Why a written file is not whole."""
    try:
        if path.suffix == ".json":
            json.loads(path.read_text())
        elif path.suffix == ".parquet":
            pq.read_table(path)
        elif path.suffix == ".html":
            assert "</html>" in path.read_text()[-200:]
    except Exception as error:
        return [f"half-written: {path.name}: {error}"]
    return []
