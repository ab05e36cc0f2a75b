"""Damaged files of every format: one clear line, or what is left; never a traceback."""

import random
import sys

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.logs.log_table import LogTable
from tests.logs import writers
from tests.logs.programs import sheet
from tests.logs.writers import Run, json_states
from tests.texts import read_rows

WRITTEN = {
    "mat": (writers.mat, "run.mat", ""),
    "mat 7.3": (writers.mat73, "run.mat", ""),
    "hdf5": (writers.hdf5, "run.h5", ""),
    "npz": (writers.npz, "run.npz", ""),
    "mcap": (writers.mcap, "run.mcap", ""),
    "bag": (writers.bag, "run", "run.db3"),
    "bag's metadata": (writers.bag, "run", "metadata.yaml"),
    "bag, mcap": (lambda path, table: writers.bag(path, table, "MCAP"), "run", "run.mcap"),
    "bag 1": (writers.bag1, "run.bag", ""),
    "workbook": (lambda path, table: sheet(path.parent, table), "run.xlsx", ""),
    "JSON": (lambda path, table: writers.mcap_of(path, "", json_states(table)), "run.mcap", ""),
}
MUTANTS = 20


@pytest.fixture(scope="module")
def short():
    t = 0.002 * np.arange(120)
    table = {"time": t} | {f"q{j}": np.sin(t + j) for j in (1, 2, 3)}
    return Run(table | {f"tau{j}": np.cos(3.0 * t + j) for j in (1, 2, 3)})


@pytest.mark.parametrize("kind", WRITTEN)
def test_damaged_files_end_in_one_line(kind, short, tmp_path):
    write, name, inside = WRITTEN[kind]
    path = write(tmp_path / name, short)
    file = path / inside if inside else path
    whole, chance = file.read_bytes(), random.Random(kind)
    refused = 0
    for number in range(MUTANTS):
        file.write_bytes(damaged(whole, chance, cut=number % 3 == 0))
        try:
            table = LogTable(path)
            for column in table.names:
                if table.is_numeric(column):
                    table.read_measured(column)
        except DataError as error:
            refused += 1
            assert str(error).startswith(f"{path}: "), error
            assert "\n" not in str(error) and ";" in str(error), error
    assert refused > MUTANTS // 3


def test_a_length_that_no_file_has_is_told_in_words(short, tmp_path):
    path = writers.npz(tmp_path / "run.npz", short)
    content = path.read_bytes()
    path.write_bytes(content[:-6] + b"\xff\xff\xff\x7f" + content[-2:])  # where zip's directory is
    with pytest.raises(DataError, match=r"run\.npz: cannot be read as numpy file") as result:
        LogTable(path)
    assert "Errno" not in str(result.value)


def damaged(whole: bytes, chance: random.Random, cut: bool) -> bytes:
    """Cut off somewhere, or with some bytes changed."""
    if cut:
        return whole[: chance.randrange(1, len(whole))]
    content = bytearray(whole)
    for _ in range(chance.choice((1, 3, 30))):
        near = min(len(content), 2000) if chance.random() < 0.5 else len(content)
        content[chance.randrange(near)] = chance.randrange(256)
    return bytes(content)


FALSE = [
    ("run.mat", b"no MAT file", "cannot be read as MAT file"),
    ("run.h5", b"no HDF5 file", "cannot be read as HDF5"),
    ("run.mcap", b"no MCAP file", "cannot be read as MCAP"),
    ("run.db3", b"no database", "cannot be read as ROS bag"),
    ("run.bag", b"no bag", "cannot be read as ROS bag"),
    ("run.npz", b"no arrays", "cannot be read as numpy file"),
    ("run.npy", b"", "the file is empty"),
    ("run.xlsx", b"no workbook", "cannot be read as spreadsheet"),
]


@pytest.mark.parametrize(("name", "content", "words"), FALSE)
def test_files_that_are_something_else(tmp_path, run, name, content, words):
    (tmp_path / name).write_bytes(content)
    status, out, err = run("log", tmp_path / name)
    assert (status, out) == (1, "") and words in err and err.count("\n") == 1


def test_arrays_of_objects_are_not_run(tmp_path):
    """A pickle in an .npz file would run what it says."""
    np.savez(tmp_path / "run.npz", q=np.array([{}, []], dtype=object))
    with pytest.raises(DataError, match="cannot be read as numpy file"):
        LogTable(tmp_path / "run.npz")


def test_arrays_without_a_motion(tmp_path):
    np.savez(tmp_path / "run.npz", gains=np.ones(3), pose=np.eye(4))
    words = r"no array of 10 rows or more; .* it holds gains \(3\), pose \(4 x 4\)"
    with pytest.raises(DataError, match=words):
        LogTable(tmp_path / "run.npz")


MISSING = read_rows("run.h5 h5py; run.mcap rosbags; run.bag rosbags; run.xlsx python-calamine")


@pytest.mark.parametrize(("name", "package"), MISSING)
def test_a_missing_package_is_one_line(tmp_path, monkeypatch, name, package):
    top = package.replace("-", "_")
    for module in [m for m in sys.modules if m.split(".")[0] == top]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, top, None)
    (tmp_path / name).write_bytes(b"something")
    words = rf'needs the package {package}; run: pip install "modeler-robotics\[\w+\]"$'
    with pytest.raises(DataError, match=words):
        LogTable(tmp_path / name)


@pytest.mark.parametrize("how", ["storage", "link", "virtual"])
def test_an_hdf5_file_that_reads_another_is_refused(tmp_path, how: str) -> None:
    h5py = pytest.importorskip("h5py", reason="NOT CHECKED: needs h5py; pip install h5py")
    time, other = np.arange(100.0), tmp_path / "other"
    time.tofile(other)
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["time"] = time
    with h5py.File(tmp_path / "log.h5", "w") as file:
        file["q1"] = time
        if how == "storage":
            file.create_dataset("time", (100,), "f8", external=[(str(other), 0, 800)])
        elif how == "link":
            file["time"] = h5py.ExternalLink("other.h5", "/time")
        else:
            layout = h5py.VirtualLayout((100,), "f8")
            layout[:] = h5py.VirtualSource("other.h5", "time", (100,))
            file.create_virtual_dataset("time", layout)
    with pytest.raises(DataError, match="time lies in another file"):
        LogTable(tmp_path / "log.h5")
