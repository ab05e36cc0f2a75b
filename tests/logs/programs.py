"""One run as the programs of robot people write it: text of many dialects, sheets, folders."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import scipy.io

from tests.logs import writers
from tests.logs.writers import START, Table, joined
from tests.when_used import WhenUsed

pd = WhenUsed("pandas")

AUTO = ("auto",)


@dataclass(frozen=True)
class Kind:
    """A kind of log.

    Attributes:
        write: into a folder; gives what `modeler fit` is given as LOG.
        words: of `--map`.
        digits: relative, that a value keeps.
    """

    write: Callable[[Path, Table], Path]
    words: tuple[str, ...] = AUTO
    digits: float = 1e-9


def rows_of(table: Table, q: float = 1.0, tau: float = 1.0, time: float = 1.0) -> np.ndarray:
    """(n, 7) time, positions, torques, each times a factor."""
    return np.column_stack(
        [table["time"] * time, joined(table, "q") * q, joined(table, "tau") * tau]
    )


def text_of(rows: np.ndarray, delimiter: str, decimal: str = ".", digits: int = 13) -> str:
    lines = (delimiter.join(f"{x:.{digits}g}" for x in row) for row in rows)
    return "\n".join(lines).replace(".", decimal) + "\n"


def written(path: Path, text: str, encoding: str = "utf-8", ends: str = "\n") -> Path:
    path.write_bytes(text.replace("\n", ends).encode(encoding))
    return path


DEG = 180.0 / np.pi


def german_excel(folder: Path, table: Table) -> Path:
    """ "CSV (Trennzeichen-getrennt)" of a German Excel: Windows letters and line ends."""
    names = ["Zeit [s]", *(f"Winkel {j} [°]" for j in "123"), *(f"Moment {j} [Nm]" for j in "123")]
    body = text_of(rows_of(table, q=DEG), ";", ",")
    return written(folder / "messung.csv", ";".join(names) + "\n" + body, "cp1252", "\r\n")


def labview(folder: Path, table: Table) -> Path:
    """An .lvm file: two headers, no name of its own for the time, a column of comments."""
    n, x = len(table["time"]), "\t".join
    first = [
        *("LabVIEW Measurement\t", "Writer_Version\t2", "Reader_Version\t2", "Separator\tTab"),
        *("Decimal_Separator\t.", "Multi_Headings\tNo", "X_Columns\tOne", "Time_Pref\tAbsolute"),
        *("Operator\tme", "Date\t2024/05/01", "Time\t12:00:00.1234567890123456789"),
        *("***End_of_Header***\t", "\t"),
    ]
    second = [
        "Channels\t6\t\t\t\t\t\t",
        f"Samples\t{x([str(n)] * 6)}\t",
        f"Date\t{x(['2024/05/01'] * 6)}\t",
        f"Time\t{x(['12:00:00.12345'] * 6)}\t",
        f"Y_Unit_Label\t{x(['deg'] * 3 + ['N m'] * 3)}\t",
        f"X_Dimension\t{x(['Time'] * 6)}\t",
        f"X0\t{x(['0.0000000000000000E+0'] * 6)}\t",
        f"Delta_X\t{x(['0.001000'] * 6)}\t",
        "***End_of_Header***\t\t\t\t\t\t\t",
    ]
    names = [f"pos {j}" for j in "123"] + [f"torque {j}" for j in "123"]
    head = "\n".join([*first, *second, f"X_Value\t{x(names)}\tComment"])
    return written(
        folder / "run.lvm", f"{head}\n{text_of(rows_of(table, q=DEG), chr(9))}", ends="\r\n"
    )


def controller(folder: Path, table: Table) -> Path:
    """Columns of blanks without any names, as many robot controllers trace."""
    rows = rows_of(table)
    text = "\n".join("".join(f"{x:>22.13e}" for x in row) for row in rows) + "\n"
    return written(folder / "trace.dat", text)


def twincat(folder: Path, table: Table) -> Path:
    """An export of TwinCAT Scope: who recorded it, then names, types, cycle, units."""
    symbols = [f"MAIN.axis{j}.{kind}" for kind in ("ActPos", "ActTorque") for j in (1, 2, 3)]
    head = [
        "Name\tYT Scope Project",
        "File\tC:\\Scope\\run.tcscopex",
        "Starttime of export\t133590384000000000\tWednesday, May 1, 2024",
        "Endtime of export\t133590384060000000\tWednesday, May 1, 2024",
        "",
        "Name\t" + "\t".join(symbols),
        "Data-Type" + "\tREAL64" * 6,
        "SampleTime[ms]" + "\t1" * 6,
        "Unit\t" + "\t".join(["°"] * 3 + ["Nm"] * 3),
    ]
    return written(
        folder / "scope.csv",
        "\n".join(head) + "\n" + text_of(rows_of(table, q=DEG, time=1e3), "\t"),
    )


def instrument(folder: Path, table: Table) -> Path:
    """No column of time: a line before the names shows the rate."""
    head = "# Data recorder 3000\n# Sample rate: 1000 Hz\n# pos1, pos2, pos3, trq1, trq2, trq3\n"
    return written(folder / "run.asc", head + text_of(rows_of(table)[:, 1:], ", "))


def rtde(folder: Path, table: Table) -> Path:
    """As `record.py` of Universal Robots' RTDE client writes it."""
    kinds = ("target_q", "actual_q", "actual_current_as_torque")
    names = ["timestamp", *(f"{kind}_{j}" for kind in kinds for j in range(3))]
    rows = rows_of(table)
    rows = np.column_stack([rows[:, :1] + 4711.5, np.round(rows[:, 1:4], 3), rows[:, 1:]])
    return written(folder / "robot_data.csv", " ".join(names) + "\n" + text_of(rows, " "))


def iso_index(folder: Path, table: Table) -> Path:
    """A frame with an index of times, by `to_csv`."""
    nanoseconds = np.round(table["time"] * 1e9).astype("int64") + START
    index = pd.to_datetime(nanoseconds, unit="ns", utc=True)
    columns = {k: v for k, v in table.items() if k != "time"}
    pd.DataFrame(columns, index=index.rename("stamp")).to_csv(folder / "run.csv")
    return folder / "run.csv"


def clock_of_day(folder: Path, table: Table) -> Path:
    """Times of a day in America, after noon."""
    clock = [(1, 59, 59.8 + t) if t < 0.2 else (2, 0, t - 0.2) for t in table["time"]]
    stamps = [f"5/1/2024 {h}:{m:02d}:{s:012.9f} PM" for h, m, s in clock]
    body = text_of(rows_of(table)[:, 1:], ",").splitlines()
    lines = [f"{s},{line}" for s, line in zip(stamps, body, strict=True)]
    head = "Clock,pos1,pos2,pos3,torque1,torque2,torque3"
    return written(folder / "run.log", "\n".join([head, *lines]) + "\n")


def timestamps(folder: Path, table: Table) -> Path:
    """A frame with an index of times, as Parquet."""
    nanoseconds = np.round(table["time"] * 1e9).astype("int64") + START
    stamp = pa.array(nanoseconds, pa.timestamp("ns", "UTC"))
    columns = {k: v for k, v in table.items() if k != "time"}
    pq.write_table(pa.table({**columns, "stamp": stamp}), folder / "run.parquet")
    return folder / "run.parquet"


def sheet(folder: Path, table: Table) -> Path:
    """A workbook whose second sheet has a title, names, units and the numbers."""
    import openpyxl

    book = openpyxl.Workbook()
    book.active.append(["Robot 3, run of May"])
    data = book.create_sheet("data")
    data.append(["measured by me"])
    data.append(["t", *(f"pos {j}" for j in "123"), *(f"torque {j}" for j in "123")])
    data.append(["ms", *["deg"] * 3, *["Nm"] * 3])
    for row in rows_of(table, q=DEG, time=1e3).tolist():
        data.append(row)
    book.save(folder / "run.xlsx")
    return folder / "run.xlsx"


def by_quantity_mat(folder: Path, table: Table) -> Path:
    """`save` of one variable each."""
    for name, value in (
        ("t", table["time"][:, None]),
        ("q", joined(table, "q")),
        ("tau", joined(table, "tau")),
    ):
        scipy.io.savemat(folder / f"{name}.mat", {name: value})
    return folder


def by_quantity_csv(folder: Path, table: Table) -> Path:
    """Each with its own time and the names of the joints."""
    rows, head = rows_of(table), "time;shoulder;elbow;wrist\n"
    written(folder / "q.csv", head + text_of(rows[:, [0, 1, 2, 3]], ";"))
    written(folder / "tau.csv", head + text_of(rows[:, [0, 4, 5, 6]], ";"))
    return folder


def by_joint(folder: Path, table: Table) -> Path:
    rows = rows_of(table, q=DEG)
    for j in (1, 2, 3):
        local = text_of(rows[:, [0, j, 3 + j]], "\t")
        written(folder / f"joint{j}.tsv", f"time\tangle [deg]\ttorque [Nm]\n{local}")
    return folder


def lerobot(folder: Path, table: Table) -> Path:
    """A dataset of two episodes: lists of single precision, a clock that restarts."""
    n = len(table["time"])
    episode = (np.arange(n) >= n // 2).astype(int)
    frame = np.arange(n) - episode * (n // 2)
    names = ["shoulder_pan", "shoulder_lift", "elbow_flex"]
    lists = {
        "observation.state": joined(table, "q") * DEG,
        "action": joined(table, "q") * DEG,
        "observation.effort": joined(table, "tau"),
    }
    columns = {
        k: pa.array([*v.astype("float32")], pa.list_(pa.float32())) for k, v in lists.items()
    }
    columns["timestamp"] = pa.array((frame / 1000).astype("float32"))
    columns |= {"frame_index": pa.array(frame), "episode_index": pa.array(episode)}
    columns["index"] = pa.array(np.arange(n) + 5000)
    (folder / "data" / "chunk-000").mkdir(parents=True)
    (folder / "meta").mkdir()
    features = {k: {"dtype": "float32", "shape": [3], "names": names} for k in lists}
    features["action"]["names"] = {"motors": names}  # type: ignore[assignment]
    info = {"codebase_version": "v3.0", "fps": 1000, "features": features}
    (folder / "meta" / "info.json").write_text(json.dumps(info))
    path = folder / "data" / "chunk-000" / "file-000.parquet"
    pq.write_table(pa.table(columns), path)
    return path


def mcap(folder: Path, table: Table) -> Path:
    return writers.mcap(folder / "run.mcap", table)  # type: ignore[arg-type]


PLACES = ("time=c1", "q<j>=c{n+1}", "tau<j>=c{n+4}")
KINDS = {
    "German Excel": Kind(german_excel),
    "LabVIEW": Kind(labview),
    "a controller without names": Kind(controller, PLACES),
    "TwinCAT Scope": Kind(twincat),
    "a recorder without time": Kind(instrument),
    "RTDE of Universal Robots": Kind(rtde),
    "pandas with an ISO index": Kind(iso_index),
    "times of the day": Kind(clock_of_day),
    "Parquet with timestamps": Kind(timestamps),
    "a workbook": Kind(sheet),
    "a folder of MAT files": Kind(by_quantity_mat),
    "a folder of quantities": Kind(by_quantity_csv),
    "a folder of joints": Kind(by_joint),
    "LeRobot": Kind(lerobot, digits=1e-6),
    "a bag": Kind(mcap),
}
