"""The picker, the lock of a folder, the disk that a project uses."""

import errno
import os
import subprocess
import sys
import types
from pathlib import Path

import pytest

from modeler.core.errors import DataError
from modeler.studio.places import (
    ROBOT_ENDINGS,
    Roots,
    compute_disk_use,
    find_unused_files,
    format_size,
    lock_folder,
)
from modeler.studio.project import Project
from modeler.studio.tasks import Step, Task
from tests.rotation import with_cases
from tests.texts import read_rows


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A folder that may be read, and its neighbour that may not."""
    for name in ("open/run", "open/.git", "open2", "shut"):
        (tmp_path / name).mkdir(parents=True)
    for name in """
        open/b.CSV open/a.parquet open/arm.toml open/x.txt open/.h.csv open/run/c.mat
        shut/secret.csv
    """.split():
        (tmp_path / name).write_text("12345")
    (tmp_path / "open/inside.csv").symlink_to(tmp_path / "open/run/../b.CSV")
    (tmp_path / "open/out.csv").symlink_to(tmp_path / "shut/secret.csv")
    (tmp_path / "open/out").symlink_to(tmp_path / "shut")
    (tmp_path / "open/ring.csv").symlink_to(tmp_path / "open/ring.csv")
    os.mkfifo(tmp_path / "open/pipe.csv")
    return tmp_path


def test_the_picker_lists_what_may_be_chosen(tree: Path) -> None:
    roots = Roots((tree / "open",))
    entries = roots.read_entries(tree / "open")
    assert [entry.name for entry in entries] == ["run", "a.parquet", "b.CSV", "inside.csv"]
    assert [entry.size for entry in entries] == [None, 5, 5, 5] and entries[0].is_folder
    robots = roots.read_entries(tree / "open", ROBOT_ENDINGS)
    assert [entry.name for entry in robots] == ["run", "arm.toml"]
    assert [entry.name for entry in roots.read_entries(f"{tree}/open/run")] == ["c.mat"]


@with_cases(
    "place, text",
    ("shut", "outside the folders that this studio may use; start it with --allow"),
    ("shut/secret.csv", "outside"),
    ("open/..", "outside"),
    ("open/out", "outside"),
    ("open/out.csv", "outside"),
    ("open/../shut/secret.csv", "outside"),
    ("open/none", "no such file"),
    ("open/ring.csv", "no such file"),
    ("open\0", "no such file"),
    ("openx", "no such file"),
    ("open2", "outside"),
)
def test_nothing_outside_is_chosen(tree: Path, place: str, text: str) -> None:
    roots = Roots((tree / "open",))
    with pytest.raises(DataError, match=text):
        roots.resolve_inside(f"{tree}/{place}")
    with pytest.raises(DataError, match=text):
        roots.read_entries(f"{tree}/{place}")
    assert Roots((tree / "shut", tree / "open")).resolve_inside(tree / "open/out") == tree / "shut"


# The lock.

HOLD = """
import sys, time
from pathlib import Path
from modeler.studio.places import lock_folder
with lock_folder(Path(sys.argv[1])) as own:
    print(own, flush=True)
    time.sleep(60)
"""


def test_one_has_the_folder_and_a_killed_one_does_not(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "project"
    words = [sys.executable, "-c", HOLD, str(folder)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout is not None and holder.stdout.readline() == "True\n"
        with lock_folder(folder) as local:
            assert not local
        left = [folder / f".dropping-{'ab' * 8}", folder / f".modeler-{'0' * 16}"]
        mine = [folder / ".modeler-notes", folder / "project.toml"]
        for path in left + mine:
            path.write_text("x")
        with lock_folder(folder) as local:
            assert not local and left[0].exists()  # it may be in use
        holder.kill()
        holder.wait()
        with lock_folder(folder) as local:
            assert local and all(path.exists() for path in mine)
            assert not any(path.exists() for path in left)
            with lock_folder(folder) as second:
                assert not second


def test_a_folder_that_may_not_be_written_is_read(tmp_path: Path, monkeypatch) -> None:
    def refused(self: Path, mode: str):
        raise PermissionError(errno.EACCES, "Permission denied")  # as anybody but root would get

    monkeypatch.setattr(Path, "open", refused)
    with lock_folder(tmp_path) as local:
        assert not local


# Disk.


def test_disk_is_counted_by_what_it_is_for(tmp_path: Path) -> None:
    for name, size in (("logs/a.csv", 7), ("logs/bag/b.db3", 5), ("models/1.json", 3), ("x", 2)):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(b"x" * size)
    (tmp_path / "far").symlink_to("/usr")
    used = compute_disk_use(tmp_path)
    assert (used["logs"], used["models"], used["results"]) == (12, 3, 0)
    assert used["other"] == 2 and sum(used.values()) == 17
    sizes = ["999 B", "1.5 kB", "2.5 GB", "3 TB"]
    assert [format_size(n) for n in (999, 1500, 2.5e9, 3e12)] == sizes


def test_tidying_takes_what_no_step_on_the_way_needs(tmp_path: Path) -> None:
    """1 fit, 2 diagnose, 3 add, then back to 1: 4 add; 5 and 6 are about models; 7 never ended."""
    rows = "1 0 fit; 2 1 diagnose; 3 1 add; 4 1 add; 5 3 compare; 6 4 compare; 8 0 simulate"
    way = tuple(read_rows(rows))
    steps = tuple(Step(number, parent, Task(verb)) for number, parent, verb in way)
    project = Project(robot="robot.toml", current=4, steps=steps)
    for folder in ("robots", "models", "results", "logs"):
        (tmp_path / folder).mkdir()
    for n in range(1, 9):
        (tmp_path / f"results/{n}.json").write_text("xx")
        (tmp_path / f"results/{n}.pictures.json").write_text("xxx")
        (tmp_path / f"models/{n}.json").write_text("x")
    mine = [tmp_path / name for name in ("models/mine.json", "results/3.txt", "logs/3.json")]
    for path in mine:
        path.write_text("mine")
    files = find_unused_files(tmp_path, project)
    assert [s.number for s in files.project.steps] == [1, 2, 4, 6, 8]
    assert files.project.current == 4 and files.project.collect_path() == project.collect_path()
    numbers = {int(Path(file).name.split(".")[0]) for file in files.files}
    assert numbers == {3, 5, 7} and files.size == 3 * (2 + 3 + 1)
    before = sum(compute_disk_use(tmp_path).values())
    files.remove(tmp_path)
    assert before - sum(compute_disk_use(tmp_path).values()) == files.size
    assert all(path.exists() for path in mine)
    again = find_unused_files(tmp_path, files.project)
    assert again.files == () and again.project == files.project


def test_what_another_step_names_stays(tmp_path: Path) -> None:
    """A comparison of the current model with one that was set aside."""
    (tmp_path / "models").mkdir()
    for n in (1, 2, 3):
        (tmp_path / f"models/{n}.json").write_text("x")
    fits = tuple(Step(n, 0, Task("fit")) for n in (1, 2, 3))
    steps = (*fits, Step(4, 1, Task("contest", models=(1, 2))))
    assert find_unused_files(tmp_path, Project(current=1, steps=steps)).files == ("models/3.json",)


def test_the_lock_of_windows(tmp_path: Path, monkeypatch) -> None:
    """As its module `msvcrt` has it: the first byte, without waiting."""
    asked = []

    def locking(descriptor: int, mode: int, count: int) -> None:
        asked.append((os.lseek(descriptor, 0, os.SEEK_CUR), mode, count))
        if len(asked) > 1:
            raise OSError(13, "Permission denied")

    fake = types.SimpleNamespace(LK_NBLCK=2, locking=locking)
    monkeypatch.setitem(sys.modules, "msvcrt", fake)
    monkeypatch.setattr("modeler.studio.places.os", types.SimpleNamespace(name="nt"))
    with lock_folder(tmp_path) as first, lock_folder(tmp_path) as second:
        assert (first, second) == (True, False)
    assert asked == [(0, 2, 1)] * 2
