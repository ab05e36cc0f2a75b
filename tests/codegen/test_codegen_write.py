"""Writing a module into a folder: over what an earlier run wrote, never over the user's work."""

import dataclasses
import os
import re
import signal
import subprocess
from pathlib import Path

import pytest

from modeler.cli import main
from modeler.codegen.package import RECORD, hash_content, list_leftovers, write_emitted
from modeler.core.errors import ModelerError
from modeler.core.manifest import EmittedModule
from tests.modules import compiler, module
from tests.rotation import with_cases


@pytest.fixture
def emitted() -> EmittedModule:
    return module("emps").emitted


def changed(emitted: EmittedModule, *names: str) -> EmittedModule:
    """The module as the next version of the robot gives it."""
    files = {n: text + "\n" if n in names else text for n, text in emitted.files.items()}
    return dataclasses.replace(emitted, files=files)


def contents(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def test_only_changed_files_are_written_and_foreign_ones_stay(emitted, tmp_path):
    (tmp_path / "controller.c").write_text("mine")
    assert set(write_emitted(emitted, tmp_path)) == set(emitted.files)
    assert write_emitted(emitted, tmp_path) == ()
    assert write_emitted(changed(emitted, "emps.c"), tmp_path) == ("emps.c",)
    assert (tmp_path / "controller.c").read_text() == "mine"
    assert (tmp_path / "emps.c").read_text() == emitted.files["emps.c"] + "\n"


@with_cases(
    "name, mine, says",
    (
        "README.md",
        "mine",
        "README.md, not known to be of an earlier generate; choose another "
        "folder, or write over them with --force",
    ),
    (RECORD, "my notes\n", f"{RECORD}, not known to be of an earlier"),
    ("Makefile", None, "Makefile, not known"),
    ids=["a file", "one that has the name of the record", "a pipe, which is not waited for"],
)
def test_files_of_the_user_are_named_and_stay(emitted, tmp_path, name, mine, says):
    if mine is None:
        os.mkfifo(tmp_path / name)
    else:
        (tmp_path / name).write_text(mine)
    before = contents(tmp_path)
    with pytest.raises(ModelerError, match=re.escape(f"{tmp_path}: would write over {says}")):
        write_emitted(emitted, tmp_path)
    assert contents(tmp_path) == before
    if name == "README.md":
        assert set(write_emitted(emitted, tmp_path, force=True)) == set(emitted.files)
        assert write_emitted(changed(emitted, name), tmp_path) == (name,)  # now ours


def test_a_generated_file_that_was_edited_is_named_and_stays(emitted, tmp_path):
    write_emitted(emitted, tmp_path)
    (tmp_path / "emps.c").write_text("edited")
    (tmp_path / "Makefile").unlink()
    before = contents(tmp_path)
    for new in (emitted, changed(emitted, "emps.c")):
        with pytest.raises(ModelerError, match=r"over emps\.c, edited since an earlier generate;"):
            write_emitted(new, tmp_path)
        assert contents(tmp_path) == before
    assert set(write_emitted(emitted, tmp_path, force=True)) == {"emps.c", "Makefile"}
    assert write_emitted(emitted, tmp_path) == ()


def test_a_folder_without_a_record_is_taken_where_it_says_the_same(emitted, tmp_path):
    """As after it was copied without its record."""
    write_emitted(emitted, tmp_path)
    (tmp_path / RECORD).unlink()
    with pytest.raises(ModelerError, match=r"over emps\.h, not known to be of an earlier"):
        write_emitted(changed(emitted, "emps.h"), tmp_path)
    assert not (tmp_path / RECORD).exists()
    assert write_emitted(emitted, tmp_path) == ()
    assert write_emitted(changed(emitted, "emps.h"), tmp_path) == ("emps.h",)


EXAMPLE = "programs/example_residual_observer.c"


def test_what_is_no_longer_emitted_goes_unless_it_was_edited(emitted, tmp_path):
    """As the functions with fitted values do, where the robot without a model comes after it."""
    more = {"emps_fitted.c": "old", "emps_fitted.h": "old", EXAMPLE: "old"}
    with_values = dataclasses.replace(emitted, files={**emitted.files, **more})
    (tmp_path / "controller.c").write_text("mine")
    write_emitted(with_values, tmp_path)
    (tmp_path / EXAMPLE).write_text("edited")
    assert write_emitted(emitted, tmp_path) == ()
    assert set(contents(tmp_path)) == {*emitted.files, RECORD, "controller.c", EXAMPLE}
    assert list_leftovers(emitted, tmp_path) == [EXAMPLE]
    with pytest.raises(ModelerError, match=f"over {EXAMPLE}, edited since"):
        write_emitted(with_values, tmp_path)
    (tmp_path / EXAMPLE).write_text("old")  # as it was: ours again
    write_emitted(emitted, tmp_path)
    assert list_leftovers(emitted, tmp_path) == [] and not (tmp_path / EXAMPLE).exists()


def test_what_cannot_be_removed_stays_and_is_told(emitted, tmp_path, monkeypatch):
    with_values = dataclasses.replace(emitted, files=emitted.files | {EXAMPLE: "old"})
    write_emitted(with_values, tmp_path)
    remove = Path.unlink

    def refused(path: Path, missing_ok: bool = False) -> None:
        if path.name == Path(EXAMPLE).name:
            raise PermissionError(13, "Permission denied", str(path))
        remove(path, missing_ok)

    monkeypatch.setattr(Path, "unlink", refused)
    assert write_emitted(emitted, tmp_path) == ()
    monkeypatch.undo()
    assert (tmp_path / EXAMPLE).read_text() == "old" and list_leftovers(emitted, tmp_path) == [
        EXAMPLE
    ]


def test_a_record_removes_nothing_outside_of_its_folder(emitted, tmp_path):
    folder, other = tmp_path / "c", tmp_path / "other.c"
    write_emitted(emitted, folder)
    other.write_text("mine")
    with (folder / RECORD).open("a") as record:
        record.write(f"{hash_content(b'mine')}  ../other.c\n{hash_content(b'mine')}  {other}\n")
    write_emitted(emitted, folder)
    assert other.read_text() == "mine"


def test_a_run_that_was_stopped_can_be_repeated(emitted, tmp_path, monkeypatch):
    write_emitted(emitted, tmp_path)
    new, calls = changed(emitted, *emitted.files), []
    replace = Path.replace

    def killed(path: Path, place: Path) -> None:
        calls.append(path)
        if len(calls) == 4:
            raise SystemExit
        replace(path, place)

    with monkeypatch.context() as patch, pytest.raises(SystemExit):
        patch.setattr(Path, "replace", killed)
        write_emitted(new, tmp_path)
    assert len(write_emitted(new, tmp_path)) == len(emitted.files) - 2
    assert write_emitted(new, tmp_path) == ()


@pytest.mark.parametrize("call", ["open", "write", "replace"])
@pytest.mark.parametrize("number", [1, 5, 12])
def test_an_interrupt_leaves_the_old_folder_or_the_new(
    emitted, tmp_path, monkeypatch, call: str, number: int
):
    """At the given call of the system; a first folder is not there at all then."""
    files = emitted.files | {EXAMPLE: "old"}
    new = changed(emitted, *emitted.files)
    real, calls = getattr(Path if call == "replace" else os, call), []

    def interrupted(*args, **more):
        calls.append(args)
        if len(calls) == number:
            os.kill(os.getpid(), signal.SIGINT)
        return real(*args, **more)

    for before in (None, dataclasses.replace(emitted, files=files)):
        folder = tmp_path / ("first" if before is None else "again")
        if before is not None:
            write_emitted(before, folder)
        old = contents(folder) if folder.exists() else {}
        calls.clear()
        handler = signal.signal(signal.SIGINT, signal.default_int_handler)
        with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
            patch.setattr(Path if call == "replace" else os, call, interrupted)
            write_emitted(new, folder)
        signal.signal(signal.SIGINT, handler)
        left = contents(folder) if folder.exists() else None
        if call == "replace":
            assert {name: left[name].decode() for name in new.files} == new.files
            assert left.keys() == {*new.files, RECORD}
        else:
            assert left == (old or None)
        assert write_emitted(new, folder) == (() if call == "replace" else tuple(new.files))


def test_the_record_can_be_checked_by_others(emitted, tmp_path):
    write_emitted(emitted, tmp_path)
    lines = (tmp_path / RECORD).read_text().splitlines()
    assert {line.split("  ")[1] for line in lines} == set(emitted.files)
    subprocess.run([compiler("sha256sum"), "-c", "--strict", RECORD], cwd=tmp_path, check=True)


@with_cases(
    "option, file, says",
    ("--cuda", "two_link.cu", "two_link_nonzeros_kernel"),
    ("--a2l", "two_link.a2l", "/end PROJECT"),
    ("--structured-text", "two_link.st", "FUNCTION_BLOCK two_link_gravity"),
)
def test_a_command_with_an_option_writes_more_and_one_without_takes_it_away(
    option, file, says, tmp_path, capsys
):
    words = ["generate", "two-link", "--out", str(tmp_path)]
    assert main([*words, option]) == 0
    assert f"  {file}" in capsys.readouterr().out
    assert says in (tmp_path / file).read_text()
    assert main(words) == 0 and not (tmp_path / file).exists()
