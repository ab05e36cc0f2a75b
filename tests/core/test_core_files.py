"""What a write leaves behind: files whole, links and nodes as they were, permissions kept."""

import os
import socket
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from modeler.core import files
from modeler.core.errors import ModelerError
from tests.rotation import with_cases


def mode(path: Path) -> int:
    return stat.S_IMODE(path.lstat().st_mode)


def everything(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def refused_by_both(path: Path, says: str) -> None:
    for call in (lambda: files.write_atomically(path, "x"), lambda: files.check_writable(path)):
        with pytest.raises(ModelerError, match=says):
            call()


@pytest.mark.parametrize("mask", [0o022, 0o077, 0o002])
def test_a_new_file_respects_the_umask(tmp_path: Path, mask: int) -> None:
    before = os.umask(mask)
    try:
        files.write_atomically(tmp_path / "new.json", "{}")
    finally:
        os.umask(before)
    assert mode(tmp_path / "new.json") == 0o666 & ~mask


@pytest.mark.parametrize("permissions", [0o600, 0o640, 0o644, 0o755])
def test_a_file_keeps_its_permissions(tmp_path: Path, permissions: int) -> None:
    path = tmp_path / "secret.json"
    path.write_text("old")
    path.chmod(permissions)
    files.write_atomically(path, "new")
    assert (path.read_text(), mode(path)) == ("new", permissions)
    assert everything(tmp_path) == ["secret.json"]


def test_a_name_may_be_as_long_as_the_system_allows(tmp_path: Path) -> None:
    path = tmp_path / ("n" * os.pathconf(tmp_path, "PC_NAME_MAX"))
    files.check_writable(path)
    files.write_atomically(path, "text")
    assert path.read_text() == "text"
    with pytest.raises(ModelerError, match="cannot be written"):
        files.check_writable(tmp_path / ("n" * 5000))


def test_links_stay_and_what_they_name_is_written(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    target = tmp_path / "real" / "target.json"
    target.write_text("old")
    target.chmod(0o600)
    (tmp_path / "first").symlink_to("real/target.json")
    (tmp_path / "second").symlink_to("first")
    inode = target.stat().st_ino
    files.check_writable(tmp_path / "second")
    files.write_atomically(tmp_path / "second", "new")
    assert (tmp_path / "first").is_symlink() and (tmp_path / "second").is_symlink()
    assert (target.read_text(), mode(target)) == ("new", 0o600)
    assert target.stat().st_ino != inode  # replaced at once, not written over
    assert everything(tmp_path / "real") == ["target.json"]


def test_a_link_to_nothing_makes_what_it_names_and_links_in_a_circle_are_refused(tmp_path):
    for name, leads_to in (("link", "made/here.json"), ("a", "b"), ("b", "a")):
        (tmp_path / name).symlink_to(leads_to)
    files.check_writable(tmp_path / "link")
    assert not (tmp_path / "made").exists()
    files.write_atomically(tmp_path / "link", "text")
    assert (tmp_path / "made" / "here.json").read_text() == "text"
    refused_by_both(tmp_path / "a", "a: cannot be written")
    assert all((tmp_path / name).is_symlink() for name in ("link", "a", "b"))
    assert everything(tmp_path) == ["a", "b", "link", "made"]


@pytest.mark.parametrize("linked", [False, True])
def test_a_pipe_is_written_to(tmp_path: Path, linked: bool) -> None:
    pipe = place = tmp_path / "pipe"
    os.mkfifo(pipe)
    if linked:
        place = tmp_path / "link"
        place.symlink_to(pipe)
    files.check_writable(place)  # does not wait for a reader
    read: list[bytes] = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()))
    reader.start()
    data = bytes(range(256)) * 1000  # more than a pipe holds
    files.write_atomically(place, data)
    reader.join(20)
    assert read == [data]
    assert stat.S_ISFIFO(pipe.lstat().st_mode)


def test_a_device_is_written_to(tmp_path: Path) -> None:
    """A terminal of our own, through a link."""
    ours, theirs = os.openpty()
    device = Path(os.ttyname(theirs))
    (tmp_path / "tty").symlink_to(device)
    files.check_writable(tmp_path / "tty")
    files.write_atomically(tmp_path / "tty", "words\n")
    assert os.read(ours, 100).split() == [b"words"]
    assert stat.S_ISCHR(device.stat().st_mode) and (tmp_path / "tty").is_symlink()
    assert files.resolve_destination(device).identity is None
    os.close(ours)
    os.close(theirs)


def test_sockets_and_folders_are_refused(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)  # the path of a socket is short
    (tmp_path / "folder").mkdir()
    with socket.socket(socket.AF_UNIX) as ours:
        ours.bind("socket")
        for place, piece in (("socket", "is a socket"), ("folder", "is a folder")):
            refused_by_both(Path(place), f"{place}: {piece}; expected the name")
        assert stat.S_ISSOCK(Path("socket").lstat().st_mode)


def test_a_write_protected_file_stays_and_what_fails_midway_leaves_the_old_file(
    tmp_path: Path, monkeypatch
) -> None:
    path = tmp_path / "file.json"
    path.write_text("old")
    with monkeypatch.context() as patch:  # as the system shows it: to an administrator, nothing is
        patch.setattr(os, "access", lambda *_: False)
        refused_by_both(path, r"file\.json: cannot be written")

    def full(handle: int, data: bytes) -> int:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch, pytest.raises(ModelerError, match="No space left on dev"):
        patch.setattr(os, "write", full)
        files.write_atomically(path, "new")
    assert path.read_text() == "old" and everything(tmp_path) == ["file.json"]


def test_folders_are_tried_and_left_as_they_were(tmp_path: Path, monkeypatch) -> None:
    (tmp_path / "plain").write_text("a file")
    for _ in range(2):  # with files that have no name, and where the system has none
        files.check_folder_writable(tmp_path / "new" / "folder")
        files.check_folder_writable(tmp_path)
        for place in (tmp_path / "plain", tmp_path / "plain" / "below"):
            with pytest.raises(ModelerError, match="cannot be written"):
                files.check_folder_writable(place)
        monkeypatch.delattr(os, "O_TMPFILE", raising=False)
    assert everything(tmp_path) == ["plain"]


_TO_STDOUT = """
import sys
from pathlib import Path
from modeler.core.files import check_writable, write_atomically
print("before")
check_writable(Path(sys.argv[1]))
write_atomically(Path(sys.argv[1]), "between\\n")
print("after")
"""


@with_cases(
    "name",
    "/dev/stdout",
    "link",
    *(pytest.param(f"/{place}/fd/1", marks=pytest.mark.rotating) for place in ("dev", "proc/self")),
)
@pytest.mark.parametrize("into", ["pipe", "file"])
def test_our_own_stdout_is_written_to_in_order(tmp_path: Path, name: str, into: str) -> None:
    (tmp_path / "link").symlink_to("/dev/stdout")
    place = tmp_path / name  # an absolute name stays what it is
    if not os.path.lexists(place):
        pytest.skip(f"NOT CHECKED: there is no {name} here")
    command = [sys.executable, "-c", _TO_STDOUT, str(place)]
    if into == "pipe":
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    else:
        with (tmp_path / "out.txt").open("w") as stream:
            subprocess.run(command, stdout=stream, check=True)
        text = (tmp_path / "out.txt").read_text()
    assert text.split() == ["before", "between", "after"]


def test_a_closed_or_read_only_descriptor_is_told(tmp_path: Path) -> None:
    if not Path("/dev/fd").exists():
        pytest.skip("NOT CHECKED: open files have no names here")
    path = tmp_path / "file"
    path.write_text("text")
    with path.open() as stream:
        place = Path(f"/dev/fd/{stream.fileno()}")
        with pytest.raises(ModelerError, match="open for reading only"):
            files.check_writable(place)
        with pytest.raises(ModelerError, match="cannot be written"):
            files.write_atomically(place, "x")
    with pytest.raises(ModelerError, match="cannot be written"):
        files.check_writable(place)
    assert path.read_text() == "text"


def test_names_that_are_no_text_are_written_escaped(tmp_path: Path) -> None:
    files.write_atomically(tmp_path / "page.html", "log \udcff.csv")
    assert (tmp_path / "page.html").read_text() == "log \\udcff.csv"
