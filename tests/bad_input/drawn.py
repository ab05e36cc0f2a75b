"""Mutants drawn with a seed: what a user's spoilt file or mistyped command gives.

Of the binary formats of other programs: tests/logs/test_log_damage.py.
"""

import io
import json
import random
import tempfile
import tomllib
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from modeler.core.choices import list_builtin_robots, read_builtin_robot
from tests.bad_input.judge import clear, inside, run_here, within
from tests.bad_input.mutants import NUMBERS, VALUES_DRAWN, edited_bytes, edited_structure, toml_text
from tests.bad_input.workdir import Inputs, Workdir, csv_text
from tests.robot.texts import ARM, OWN_EFFECTS
from tests.robot_texts import CRANK

SAMPLES = 400
FACTORS, PUT = (0.0, -1.0, 57.3, 1e3, 1e-3, 1e200, 1e300), (np.nan, np.inf, 1e30, 0.0, -1e300, 7.0)
LOG = "fit two-link bad{} --out f.json"
ROBOTS = (*([ARM, OWN_EFFECTS, CRANK] * 6), *map(read_builtin_robot, list_builtin_robots()))
KINDS = (
    *(pa.float32(), pa.int64(), pa.int8(), pa.string(), pa.bool_(), pa.binary(), pa.null()),
    *(pa.timestamp("ns"), pa.list_(pa.float64()), pa.dictionary(pa.int32(), pa.string())),
    *(pa.decimal128(20, 6), pa.duration("ms"), pa.float16()),
)
COMMANDS = (
    "derive wrist --no-terms",
    "simulate two-link --duration 2 --rate 100 --seed 1 --out s.csv",
    "fit two-link a.csv --cutoff 20 --out f.json",
    "compare m.json b.csv@1:6 --json c.json",
    "log a.csv --json l.json",
    "generate two-link --out c",
    "effects --robot two-link",
    "convert x.par --out x.toml",
    "add m.json offset --joint 1 a.csv --out n.json",
    "diagnose m.json b.csv --json d.json",
    "robots wrist",
    "fit two-link a.csv --map q1=q1:rad --map tau1=tau1 --out f.json",
)
WORDS = (
    *(*NUMBERS, '"', "[", "]", "{", "}", "=", ",", "\n", *"# q1 sin( ) ** pi [mdh] rows".split()),
    *("\0", "é", "\\", *"true ' time tau1 ; rad".split()),
)


DRAWN = "toml toml par csv csv parquet urdf urdf mjcf model model map motion command command"
AS_BYTES = {"par": "x.par", "urdf": "good.urdf", "mjcf": "good.xml"}
"""Formats of robots of which the bytes are spoilt: the good file."""

Mutant = tuple[str, str, dict[str, bytes], str]
"""Format, what was done, the files, the command."""


class Drawer:
    """Draws mutants; the same ones for the same seed."""

    def __init__(self, inputs: Inputs, seed: int) -> None:
        self.inputs, self.random = inputs, random.Random(seed)

    def draw(self) -> Mutant:
        """The next one."""
        kind = self.random.choice(DRAWN.split())
        return getattr(self, f"_{kind}")() if kind not in AS_BYTES else self._as_bytes(kind)

    def _as_bytes(self, kind: str) -> Mutant:
        name = AS_BYTES[kind]
        content, out = self._bytes(self._made(name))
        bad = f"bad{Path(name).suffix}"
        return kind, out, {bad: content}, f"convert {bad} --out x.toml"

    def _made(self, name: str) -> bytes:
        return (self.inputs.folder / name).read_bytes()

    def _bytes(self, data: bytes, most: int = 3) -> tuple[bytes, str]:
        kinds = ("cut", "repeat", "replace", "insert", "flip", "end", "exchange")
        pick = self.random
        made = [
            (pick.choice(kinds), pick.randrange(10**6), pick.randint(1, 40), pick.randrange(10**6))
            for _ in range(pick.randint(1, most))
        ]
        done = (f"{k}@{at % (len(data) + 1)}" for k, at, *_ in made)
        return edited_bytes(data, made, WORDS), " ".join(done)

    def _structure(self, raw: object) -> str:
        pick = self.random
        kinds = ("put", "put", "take out", "double", "rename", "copy")
        made = []
        for _ in range(pick.randint(1, 2)):
            way = [pick.randrange(10**6) for _ in range(pick.randint(1, 6))]
            made.append((way, pick.choice(kinds), pick.choice(VALUES_DRAWN)))
        edited_structure(raw, made)
        return " ".join(f"{kind} {str(value)[:20]!r}" for _, kind, value in made)

    def _toml(self) -> Mutant:
        text = self.random.choice(ROBOTS)
        command = "derive bad.toml --no-terms --json d.json"
        if self.random.random() < 0.5:
            content, message = self._bytes(text.encode())
        else:
            document = tomllib.loads(text)
            message = self._structure(document)
            content = toml_text(document).encode(errors="replace")
        return "robot TOML", message, {"bad.toml": content}, command

    def _columns(self) -> tuple[dict[str, np.ndarray], str]:
        """A log whose columns are exchanged, spoilt, gone, short."""
        pick = self.random
        table = {name: v[:SAMPLES].copy() for name, v in self.inputs.log("a.csv").items()}
        lines = []
        for _ in range(pick.randint(1, 2)):
            name, other = pick.choice(list(table)), pick.choice(list(table))
            how = pick.choice(["exchange", "gone", "times", "value", "roll", "same", "cut", "none"])
            lines.append(f"{how} {name}")
            if how == "exchange":
                table[name], table[other] = table[other], table[name]
            elif how == "gone" and len(table) > 1:
                del table[name]
            elif how == "times":
                with np.errstate(all="ignore"):
                    table[name] = table[name] * pick.choice(FACTORS)
            elif how == "value":
                at = pick.randrange(SAMPLES)
                table[name][at : at + pick.randint(1, 80)] = pick.choice(PUT)
            elif how == "roll":
                table[name] = np.roll(table[name], pick.randint(1, 100))
            elif how == "same":
                table[name] = np.full(len(table[name]), table[name][0])
            elif how == "cut":
                rows = pick.choice([0, 1, 5, 30, 150])
                table = {n: v[:rows] for n, v in table.items()}
                break
        return table, ", ".join(lines)

    def _csv(self) -> Mutant:
        if self.random.random() < 0.5:
            table, note = self._columns()
            content = csv_text(table).encode()
        else:
            short = {n: v[:SAMPLES] for n, v in self.inputs.log("a.csv").items()}
            content, note = self._bytes(csv_text(short).encode())
        return "log CSV", note, {"bad.csv": content}, LOG.format(".csv")

    def _parquet(self) -> Mutant:
        columns, stated = self._columns()
        table = {name: pa.array(values) for name, values in columns.items()}
        if self.random.random() < 0.4:
            name, kind = self.random.choice(list(table)), self.random.choice(KINDS)
            table[name] = _cast(table[name], kind)
            stated += f", {name} as {kind}"
        file = io.BytesIO()
        pq.write_table(pa.table(table), file)
        content = file.getvalue()
        if self.random.random() < 0.5:
            content, stated = self._bytes(content)
        return "log Parquet", stated, {"bad.parquet": content}, LOG.format(".parquet")

    def _model(self) -> Mutant:
        if self.random.random() < 0.5:
            content, report = self._bytes(self._made("m.json"))
        else:
            raw = self.inputs.model("added.json")
            report = self._structure(raw)
            content = json.dumps(raw).encode(errors="replace")
        return "model JSON", report, {"bad.json": content}, "compare bad.json b.csv --json c.json"

    def _map(self) -> Mutant:
        good = {
            "log": {
                "time": "time [s]",
                "q<j>": {"column": "q{j}", "unit": "rad", "sign": 1},
                "tau<j>": {"column": "tau{n}", "scale": 1.0, "offset": 0.0},
            }
        }
        if self.random.random() < 0.5:
            content, told = self._bytes(toml_text(good).encode())
        else:
            told = self._structure(good)
            content = toml_text(good).encode(errors="replace")
        return "map", told, {"bad.toml": content}, "fit two-link a.csv --map bad.toml --out f.json"

    def _motion(self) -> Mutant:
        kind, told, files, _ = self._csv() if self.random.random() < 0.6 else self._parquet()
        (name,) = files
        return f"motion {kind[4:]}", told, files, f"simulate two-link --motion {name} --out s.csv"

    def _command(self) -> Mutant:
        pick = self.random
        words = pick.choice(COMMANDS).split()
        odd = "0 -1 nan 1e9 q9 --out --joint no.csv a.csv é - 1:2:3 @ q1= wrist c_code m.json"
        odd = ["", *odd.split(" "), "x" * 300]
        for _ in range(pick.randint(1, 2)):
            at = pick.randrange(len(words))
            how = pick.choice(["out", "put", "in", "spell", "exchange"])
            if how == "out" and len(words) > 1:
                del words[at]
            elif how == "put":
                words[at] = pick.choice(odd)
            elif how == "in":
                words.insert(at, pick.choice(odd))
            elif how == "spell" and words[at]:
                k = pick.randrange(len(words[at]))
                words[at] = words[at][:k] + words[at][k + 1 :]
            else:
                other = pick.randrange(len(words))
                words[at], words[other] = words[other], words[at]
        return "command line", "words", {}, " ".join(words)


def _cast(values: pa.Array, kind: pa.DataType) -> pa.Array:
    """The values as another kind; missing ones where that cannot be."""
    try:
        return values.cast(kind, safe=False)
    except pa.ArrowException:
        return pa.array([None] * len(values), kind)


def run_mutants(count: int, seed: int, inputs: Inputs) -> list[str]:
    """Runs so many mutants; those that end as none may, and how."""
    drawer, bad = Drawer(inputs, seed), list[str]()
    for number in range(count):
        kind, done, files, command = drawer.draw()
        words = tuple(command.split(" "))
        with tempfile.TemporaryDirectory() as folder:
            workdir = Workdir(Path(folder), inputs)
            for name, content in files.items():
                workdir.write(name, content)
            workdir.take_named(words)
            with inside(workdir), within(30.0):
                result = run_here(words, workdir)
        faults = [result.broke] if result.broke else clear(words, result) if result.status else []
        bad += [f"{number} [{kind}; {done}] modeler {command[:150]}: {fault}" for fault in faults]
    return bad
