"""Small files that would fill the memory, and logs whose clock spans far more than their rows."""

import gzip
import io
import struct
import subprocess
import sys
import warnings
import zipfile

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import scipy.io

from modeler.core.errors import DataError, FitWarning
from modeler.logs.columns import ColumnRequest
from modeler.logs.readers import read_columns
from modeler.numerics.spectra import estimate_lap_period, find_longest_stretch
from tests.logs.test_log_clocks import csv

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
RELATED = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006/relationships"
HEAD = "".join(
    f'<c r="{c}1" t="inlineStr"><is><t>{n}</t></is></c>' for c, n in (("A", "time"), ("B", "q1"))
)
ROWS = "".join(
    f'<row r="{i}"><c r="A{i}"><v>{i}</v></c><c r="B{i}"><v>2</v></c></row>' for i in range(2, 30)
)


def workbook(path, rows, shared=""):
    """The parts that a reader asks for, one sheet."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as book:
        for name, content in {
            "_rels/.rels": f'<Relationships xmlns="{PACKAGE}"><Relationship Id="r" Type='
            f'"{RELATED}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
            "xl/workbook.xml": f'<workbook xmlns="{MAIN}" xmlns:r="{RELATED}"><sheets>'
            '<sheet name="S" sheetId="1" r:id="r"/></sheets></workbook>',
            "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{PACKAGE}">'
            f'<Relationship Id="r" Type="{RELATED}/worksheet" Target="worksheets/sheet1.xml"/>'
            f'<Relationship Id="t" Type="{RELATED}/sharedStrings" Target="sharedStrings.xml"/>'
            "</Relationships>",
            "xl/sharedStrings.xml": f'<sst xmlns="{MAIN}"><si><t>{shared}</t></si></sst>',
            "xl/worksheets/sheet1.xml": f'<worksheet xmlns="{MAIN}"><sheetData><row r="1">{HEAD}'
            f"</row>{ROWS}{rows}</sheetData></worksheet>",
        }.items():
            book.writestr(name, '<?xml version="1.0"?>' + content)
    return path


def far_cell(path):
    return workbook(path, '<row r="1048576"><c r="XFD1048576"><v>1</v></c></row>')


def cells_without_places(path):
    wide, late = "<row>" + "<c><v>1</v></c>" * 16000 + "</row>", '<row r="900000">'
    return workbook(path, f"{wide}<row/><row/>{late}<c><v>1</v></c></row>")


def long_text(path):
    cells = "".join(f'<row r="{i}"><c r="C{i}" t="s"><v>0</v></c></row>' for i in range(30, 9000))
    return workbook(path, cells, "x" * 10**5)


def understated(path):
    """A part of a zip archive whose directory and header state 100 bytes."""
    far = workbook(path, "<row/>" * 5 * 10**6)  # 30 MB
    raw = bytearray(far.read_bytes())
    with zipfile.ZipFile(far) as book:
        part = book.getinfo("xl/worksheets/sheet1.xml")
        size = part.file_size.to_bytes(4, "little")
    while (at := raw.find(size)) >= 0:
        raw[at : at + 4] = (100).to_bytes(4, "little")
    path.write_bytes(raw)
    return path


def long_list(path):
    cells = pa.ListArray.from_arrays([0, 4_000_000], np.zeros(4_000_000))
    pq.write_table(pa.table({"q": cells}), path, use_dictionary=True)
    return path


def same_text(path):
    pq.write_table(pa.table({"note": ["x" * 10**5] * 500}), path)
    return path


def many_columns(path):
    pq.write_table(pa.table({f"c{k}": pa.array(np.zeros(100_000)) for k in range(40)}), path)
    return path


def zeros(path):
    if path.suffix == ".npz":
        np.savez_compressed(path, time=np.zeros(4_000_000))
    else:
        scipy.io.savemat(path, {"time": np.zeros(4_000_000)}, do_compression=True)
    return path


def stated_mcap(path):
    chunk = struct.pack("<QQQ", 0, 0, 10**9)
    path.write_bytes(b"\x89MCAP0\r\n" + struct.pack("<BQ", 6, len(chunk)) + chunk)
    return path


def stated_bag(path):
    fields = b"".join(struct.pack("<I", len(f)) + f for f in (b"op=\x05", b"size=\0\0\0\x40"))
    path.write_bytes(b"#ROSBAG V2.0\n" + struct.pack("<I", len(fields)) + fields + bytes(4))
    return path


def large_chunk(path):
    h5py = pytest.importorskip("h5py", reason="NOT CHECKED: needs h5py; pip install h5py")
    with h5py.File(path, "w") as file:
        file.create_dataset("q", (100,), "f8", maxshape=(None,), chunks=(10_000_000,))
        file.create_dataset("time", (10**12,), "f8", chunks=(1000,))
    return path


def swollen_chunk(path):
    """A chunk of 800 bytes, as it says, that unpacks to 60 MB."""
    h5py = pytest.importorskip("h5py", reason="NOT CHECKED: needs h5py; pip install h5py")
    packed = io.BytesIO()
    with gzip.GzipFile(fileobj=packed, mode="wb", mtime=0) as file:
        for _ in range(60):
            file.write(bytes(10**6))
    import zlib

    bare, check = packed.getvalue()[10:-8], zlib.adler32(b"").to_bytes(4, "big")
    with h5py.File(path, "w") as file:
        item = file.create_dataset("q", (100,), "f8", chunks=(100,), compression="gzip")
        item.id.write_direct_chunk((0,), b"\x78\x9c" + bare + check)
    return path


BOMBS = {
    "far.xlsx": far_cell,
    "bare.xlsx": cells_without_places,
    "text.xlsx": long_text,
    "understated.xlsx": understated,
    "list.parquet": long_list,
    "text.parquet": same_text,
    "columns.parquet": many_columns,
    "chunk.h5": large_chunk,
    "swollen.h5": swollen_chunk,
    "zeros.npz": zeros,
    "zeros.mat": zeros,
    "stated.mcap": stated_mcap,
    "stated.bag": stated_bag,
}
SAID = ("expected at most 100 times the file", "more than it states", "read as spreadsheet")
READ = """
import resource, sys
from pathlib import Path
from modeler.core.errors import DataError
from modeler.logs.columns import ColumnRequest
from modeler.logs.readers import read_columns
import h5py, python_calamine, pyarrow.parquet, rosbags.highlevel, scipy.io
import modeler.core.files, modeler.logs.arrays
modeler.core.files.UNPACKED = modeler.logs.arrays.UNPACKED = 2**24
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for place in sys.argv[1:]:
    try:
        for name, column in read_columns(Path(place), ColumnRequest()).columns:
            column.read_numbers()
        print("read", place)
    except DataError as error:
        print(error)
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) // 1024)
"""


def test_no_small_file_fills_the_memory(tmp_path):
    """In a process of its own, whose memory is measured."""
    places = [str(make(tmp_path / name)) for name, make in BOMBS.items()]
    done = subprocess.run(
        [sys.executable, "-c", READ, *places],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    *lines, peak = done.stdout.splitlines()
    for place, line in zip(places, lines, strict=True):
        assert line.startswith(f"{place}: "), line
        assert any(words in line for words in SAID), line
    assert int(peak) < 150  # MiB


def test_a_formatted_cell_far_out_is_no_bomb(tmp_path):
    """Spreadsheets keep the format of empty cells; nothing is read of them."""
    path = workbook(tmp_path / "a.xlsx", '<row r="1048576"><c r="XFD1048576" s="1"/></row>')
    assert [name for name, _ in read_columns(path, ColumnRequest()).columns] == ["time", "q1"]


def test_a_pause_of_days_costs_nothing(case, tmp_path):
    """The clock spans 10^8 s; time and memory go by the rows."""
    from modeler.api import identify

    time = case.table["time"].copy()
    time[len(time) // 2 :] += 1e8
    path = csv(tmp_path / "run.csv", {**case.table, "time": time})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FitWarning)  # of one second
        model = identify("demo-arm", [f"{path}@:1"])
    assert model.compare([f"{path}@1:"]).to_json()["samples"] > 0
    assert model.missing([f"{path}@1:"]) is not None


def test_a_lap_is_found_beside_a_pause():
    t = np.arange(6000) * 0.005
    q = np.sin(2.0 * np.pi * t / 5.0)[:, None]
    assert estimate_lap_period(t, q) == pytest.approx(5.0, abs=0.01)
    late = np.where(np.arange(6000) < 5000, t, t + 1e9)
    assert estimate_lap_period(late, q) == pytest.approx(5.0, abs=0.01)
    assert find_longest_stretch(late, 0.005) == slice(0, 5000)
    assert find_longest_stretch(t, 0.005) == slice(0, 6000)


def test_a_motion_that_lasts_for_days_or_goes_to_the_stars_is_refused(tmp_path):
    from modeler.simulation.trajectory import read_motion, resample_motion

    t = np.arange(50) * 0.01
    late = np.where(t > 0.2, t + 1e6, t)
    path = csv(tmp_path / "a.csv", {"time": late, "q1": np.sin(t)})
    with pytest.raises(DataError, match=r"lasts 1e\+06 s, 1e\+09 samples; .*take out its pauses"):
        resample_motion(read_motion(path, ["1"]), 1000.0)
    csv(path, {"time": t, "q1": 1e200 * np.sin(t)})
    with pytest.raises(DataError, match=r"row 3: q1 is empty, or not below 1e\+12"):
        read_motion(path, ["1"])
