"""The folder in which a row runs, and the good inputs that bad ones are made from."""

import hashlib
import json
import math
import os
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from modeler.cli import main
from modeler.formats import read_robot
from tests.forked import Forks
from tests.robot.par_files import par_of

Table = dict[str, Any]
"""Columns of a log by name: arrays or lists."""

_MADE = (
    "simulate two-link --duration 8 --rate 200 --seed 1 --out a.csv",
    "simulate two-link --duration 8 --rate 200 --seed 2 --out b.csv",
    "simulate two-link --duration 8 --rate 200 --seed 3 --out c.parquet",
    "simulate emps --duration 8 --rate 200 --seed 1 --out e.csv",
    "simulate demo-arm --duration 8 --rate 200 --seed 1 --out d.csv",
    "fit two-link a.csv --out m.json",
    "fit emps e.csv --out e.json",
    "add m.json offset --joint 1 a.csv --out added.json",
    "export m.json --to urdf --out good.urdf",
    "export m.json --to mjcf --out good.xml",
)
"""The good inputs: two logs to fit and to hold out, logs of other robots, models."""


class Inputs:
    """The good inputs, made once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        here = Path.cwd()
        os.chdir(folder)
        try:
            for command in _MADE:
                assert main(command.split()) == 0, command
        finally:
            os.chdir(here)
        (folder / "x.par").write_text(par_of(read_robot("two-link"), False))
        self._logs: dict[str, Table] = {}
        self._forks: Forks | None = None

    @property
    def forks(self) -> Forks:
        """Processes for commands; the first one loads the program."""
        self._forks = self._forks or Forks()
        return self._forks

    def close(self) -> None:
        """End what was started."""
        if self._forks is not None:
            self._forks.close()

    def log(self, name: str) -> Table:
        """The columns of a log that was simulated; a copy."""
        if name not in self._logs:
            self._logs[name] = read_csv(self.folder / name)
        return {column: values.copy() for column, values in self._logs[name].items()}

    def model(self, name: str = "m.json") -> dict[str, Any]:
        """The content of a model file; a copy."""
        return json.loads((self.folder / name).read_text())


class Workdir:
    """One row's own folder: `work` to run in, `home`, `temporary` and nothing else."""

    def __init__(self, folder: Path, inputs: Inputs) -> None:
        self.folder, self.inputs = folder, inputs
        self.work, self.home, self.temporary = (folder / n for n in ("work", "home", "temporary"))
        for path in (self.work, self.home, self.temporary):
            path.mkdir()

    def path(self, name: str) -> Path:
        """A path in the folder where the command runs; its folders are made."""
        path = self.work / name
        path.parent.mkdir(parents=True, exist_ok=True)
        return path

    def write(self, name: str, content: str | bytes) -> Path:
        """A file of that content."""
        path = self.path(name)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def take(self, name: str, to: str | None = None) -> Path:
        """A good input, copied."""
        source, target = self.inputs.folder / name, self.path(to or name)
        (shutil.copytree if source.is_dir() else shutil.copy)(source, target)
        return target

    def take_named(self, words: tuple[str, ...]) -> None:
        """The good inputs that a command names and that the row did not make itself."""
        for word in words:
            name = word.partition("@")[0]
            plain = name and "/" not in name and name not in (".", "..")
            good = plain and len(name) < 100 and (self.inputs.folder / name).exists()
            if good and not os.path.lexists(self.work / name):
                self.take(name)

    def log(self, name, edit, of="a.csv", **how):
        """A log made from a good one by `edit`, as CSV or Parquet."""
        table = self.inputs.log(of)
        table = edit(table) or table
        path = self.path(name)
        if path.suffix == ".parquet":
            pq.write_table(pa.table(table), path, **how)
        else:
            path.write_text(csv_text(table), encoding="utf-8")
        return path

    def model(self, name, edit, of="m.json"):
        """A model file made from a good one by `edit`, in place; or the text that it returns."""
        raw = self.inputs.model(of)
        text = edit(raw)
        return self.write(name, text if isinstance(text, str | bytes) else json.dumps(raw))

    def state(self) -> dict[str, str]:
        """What stands in the workdir: relative path to kind and fingerprint."""
        values: dict[str, str] = {}
        for path in sorted(self.folder.rglob("*")):
            name = path.relative_to(self.folder).as_posix()
            if path.is_symlink():
                values[name] = f"link {path.readlink()}"
            elif path.is_file():
                values[name] = hashlib.sha256(path.read_bytes()).hexdigest()
            else:
                values[name] = "folder" if path.is_dir() else f"node {path.stat().st_mode:o}"
        return values


def read_csv(path: Path) -> Table:
    """The columns of a CSV file of numbers."""
    table = np.genfromtxt(path, delimiter=",", names=True)
    return {name: table[name].copy() for name in table.dtype.names}


def csv_text(table: Mapping[str, Any]) -> str:
    """Columns as CSV; NaN is an empty entry."""
    columns = [_cells(values) for values in table.values()]
    lines = [",".join(table), *(",".join(cells) for cells in zip(*columns, strict=True))]
    return "\n".join(lines) + "\n"


def _cells(values: Any) -> list[str]:
    values = values.tolist() if isinstance(values, np.ndarray) else values
    return ["" if isinstance(v, float) and math.isnan(v) else str(v) for v in values]
