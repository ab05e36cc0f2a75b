"""Pictures of a long log in the studio: the first one, and a zoom, of ten minutes at 1 kHz."""

import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from benchmarks.line import Key, Line

_ROWS, _JOINTS = 600_000, 7
_NAMES = [f"{kind}{j}" for kind in ("q", "qd", "tau") for j in range(1, _JOINTS + 1)]
_ZOOMS = ((100.0, 400.0), (120.0, 180.0), (150.0, 151.0), (500.0, 505.0))  # s
_TIMES = 3


def _write(place: Path, rows: int) -> None:
    """Positions, speeds and torques with noise."""
    rng = np.random.default_rng(1)
    clock = 1e-3 * np.arange(rows)
    columns = {"time": clock}
    for k, name in enumerate(_NAMES):
        columns[name] = np.sin(0.3 * clock + k) + 1e-3 * rng.normal(size=rows)
    pq.write_table(pa.table(columns), place, row_group_size=65_536)


def _measure(quick: bool) -> Mapping[str, float]:
    from modeler.studio import viewing

    firsts, readings, zooms = [], [], []
    with tempfile.TemporaryDirectory() as scratch:
        log = Path(scratch) / "log.parquet"
        _write(log, _ROWS // 10 if quick else _ROWS)
        for _ in range(_TIMES):
            begun = time.perf_counter()
            table = pq.read_table(log)
            for name in table.column_names:
                table[name].to_numpy()
            readings.append(time.perf_counter() - begun)
            viewing.forget()
            begun = time.perf_counter()
            viewing.log_window(str(log), _NAMES, -np.inf, np.inf)
            firsts.append(time.perf_counter() - begun)
            for start, end in _ZOOMS:
                begun = time.perf_counter()
                viewing.log_window(str(log), _NAMES, start, end)
                zooms.append(time.perf_counter() - begun)
        viewing.forget()
    return {
        "first_picture_vs_reading": min(firsts) / min(readings),
        "zoom_seconds": float(np.max(np.min(np.reshape(zooms, (_TIMES, -1)), axis=0))),
    }


LINES = (
    Line(
        (
            Key(
                "first_picture_vs_reading",
                "x",
                "All 21 channels of a log of 600 000 rows in the "
                "studio, thinned, over reading the Parquet file.",
                3.0,
                1.5,
            ),
            Key("zoom_seconds", "s", "The slowest of four windows of it, all channels.", 0.2, 0.05),
        ),
        _measure,
        10,
    ),
)
